"""Steady viscoelastic contact: indenters, influence coefficients, the solver and its solution."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
