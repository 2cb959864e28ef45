"""Separation of tribometer runs into viscoelastic friction, Coulomb friction and the zero of the force cell."""
