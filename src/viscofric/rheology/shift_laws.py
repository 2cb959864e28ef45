"""Shift laws: how the time scale of a rubber depends on temperature, all under one roof."""

from viscofric.rheology.free_volume_laws import VFT, WLF
from viscofric.rheology.inverse_polynomial import InversePolynomial
from viscofric.rheology.parametric_law import ParametricLaw
from viscofric.rheology.shift_law import GAS_CONSTANT, LN10, ShiftLaw
from viscofric.rheology.thermal_laws import Arrhenius, WLFArrhenius

__all__ = [
    "GAS_CONSTANT",
    "LN10",
    "VFT",
    "WLF",
    "Arrhenius",
    "InversePolynomial",
    "ParametricLaw",
    "ShiftLaw",
    "WLFArrhenius",
]
