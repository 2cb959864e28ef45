"""From sweeps to a material: shift factors, master curve, retardation spectrum; material cards of other programs."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
