"""Rise of temperature by moving sources of heat: discs and strips, maps on a grid, repeated passes on a track."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
