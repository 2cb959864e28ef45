"""Steady viscoelastic contact: indenters, influence coefficients, the solver and what it gives back."""
