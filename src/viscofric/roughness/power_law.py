"""Curves that are power laws between their points: values, integrals and cut-outs in closed form."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import numbers
from viscofric.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array


def checked(q: ArrayLike, density: ArrayLike, unit: str) -> tuple[Array, Array]:
    """Return wave numbers and densities as read-only rows: positive, finite, increasing; two at least."""
    found = (
        np.atleast_1d(np.array(numbers(q, "wave_number", infinite=True))),
        np.atleast_1d(np.array(numbers(density, "density", infinite=True))),
    )
    if found[0].ndim != 1 or found[0].shape != found[1].shape or found[0].size < 2:
        raise InputError(
            f"a power spectrum must be two rows of equal length, two points at least, not {np.shape(q)} wave numbers "
            f"and {np.shape(density)} densities."
        )
    for values, name in zip(found, ("wave numbers (rad/m)", f"densities ({unit})"), strict=True):
        if not np.all(np.isfinite(values) & (values > 0.0)):
            raise InputError(f"a power spectrum's {name} must be finite and above zero.")
        values.flags.writeable = False
    if not np.all(np.diff(found[0]) > 0.0):
        raise InputError("a power spectrum's wave numbers must increase from point to point.")
    return found


def value(q: Array, density: Array, at: ArrayLike) -> Array:
    """Return the density at any wave numbers; zero outside the points (up to rounding)."""
    where = numbers(at, "wave_number")
    inside = (where >= q[0] * (1.0 - 1e-12)) & (where <= q[-1] * (1.0 + 1e-12))
    logs = np.interp(np.log(np.where(inside, where, q[0])), np.log(q), np.log(density))
    return np.asarray(np.where(inside, np.exp(logs), 0.0))


def integral(q: Array, density: Array, power: float) -> float:
    """Return ∫ q^power C(q) dq from the first to the last point."""
    # C q^power dq = C q^(power+1) d ln q: an exponential in ln q within each segment.
    logs = np.log(density) + (power + 1.0) * np.log(q)
    width = np.diff(np.log(q))
    rise = np.diff(logs)
    # (e^r − 1)/r, which is one where nothing rises
    mean = np.where(np.abs(rise) < 1e-12, 1.0, np.expm1(rise) / np.where(rise == 0.0, 1.0, rise))
    return float(np.sum(width * np.exp(logs[:-1]) * mean))


def cut_out(q: Array, density: Array, first: float, last: float) -> tuple[Array, Array]:
    """Return the points between two wave numbers, with new ones at these."""
    first, last = max(first, float(q[0])), min(last, float(q[-1]))
    if not first < last:
        raise InputError(
            f"the power spectrum reaches from wavelength {2.0 * np.pi / q[-1]:.4g} to {2.0 * np.pi / q[0]:.4g} m; "
            "nothing of it lies between the cut-offs."
        )
    within = q[(q > first) & (q < last)]
    kept = np.concatenate([[first], within, [last]])
    return kept, value(q, density, kept)
