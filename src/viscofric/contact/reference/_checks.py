"""Checks of the closed forms' arguments: SI numbers (or text with units) in the range of the theory."""

from __future__ import annotations

from viscofric.units import Quantity, checked_poisson_ratio, positive


def plane_strain_modulus(modulus: Quantity, poisson_ratio: float, name: str = "modulus") -> float:
    """Return E* = E/(1 − ν²), Pa: the modulus of a half-space under a rigid indenter."""
    return positive(modulus, "Pa", name) / (1.0 - checked_poisson_ratio(poisson_ratio) ** 2)


def load_and_lengths(
    load: Quantity, unit: str, radius: Quantity, thickness: Quantity, modulus: Quantity, name: str = "modulus"
) -> tuple[float, float, float, float]:
    """Return load (N, or N/m), radius, thickness (m) and modulus (Pa) of a contact with a thin layer."""
    return (
        positive(load, unit, "load" if unit == "N" else "load_per_length"),
        positive(radius, "m", "radius"),
        positive(thickness, "m", "thickness"),
        positive(modulus, "Pa", name),
    )
