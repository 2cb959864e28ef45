"""Fields around a solved contact: the surface beside and behind it, the power through it, stresses below."""

from viscofric.contact.fields.highest import HighestStress, highest_von_mises
from viscofric.contact.fields.stress import Stress
from viscofric.contact.fields.subsurface import (
    line_stress,
    stress_at,
    stress_layer,
    stress_plane,
)
from viscofric.contact.fields.surface import SurfaceDisplacement, surface_displacement, surface_power

__all__ = [
    "HighestStress",
    "Stress",
    "SurfaceDisplacement",
    "highest_von_mises",
    "line_stress",
    "stress_at",
    "stress_layer",
    "stress_plane",
    "surface_displacement",
    "surface_power",
]
