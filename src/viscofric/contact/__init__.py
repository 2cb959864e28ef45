"""Steady viscoelastic contact: indenters, influence coefficients, the solver and its solution."""
