"""Shift laws: how the time scale of a rubber depends on temperature, all under one roof."""

from viscofric.rheology.shifts.free_volume_laws import VFT, WLF
from viscofric.rheology.shifts.inverse_polynomial import InversePolynomial
from viscofric.rheology.shifts.parametric_law import ParametricLaw
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10, ShiftLaw
from viscofric.rheology.shifts.thermal_laws import Arrhenius, WLFArrhenius

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
