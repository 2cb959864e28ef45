"""Rough surfaces: preparation, generation, power spectra, Persson's theory, and sliding on them."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
