"""Friction of viscoelastic solids: separated from measurements, predicted, shifted and compared."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
