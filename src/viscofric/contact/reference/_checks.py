"""Checks of the closed forms' arguments: SI numbers (or text with units) in the range of the theory."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.errors import InputError
from viscofric.units import positive, to_si

if TYPE_CHECKING:
    from viscofric.units import Quantity


def poisson(value: float) -> float:
    """Return Poisson's ratio; InputError if it is not between 0 and 0.5."""
    ratio = to_si(value, "dimensionless", "poisson_ratio")
    if not 0.0 <= ratio <= 0.5:
        raise InputError(f"poisson_ratio = {ratio:g}: must lie between 0 and 0.5.", code="poisson-ratio")
    return ratio


def plane_strain_modulus(modulus: Quantity, poisson_ratio: float, name: str = "modulus") -> float:
    """Return E* = E/(1 − ν²), Pa: the modulus of a half-space under a rigid indenter."""
    return positive(modulus, "Pa", name) / (1.0 - poisson(poisson_ratio) ** 2)
