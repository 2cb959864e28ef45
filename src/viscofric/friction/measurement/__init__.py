"""Tribometer runs taken apart: viscoelastic friction, Coulomb friction and the zero of the force cell."""
