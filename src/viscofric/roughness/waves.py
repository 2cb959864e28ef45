"""Fourier series of surfaces: slopes, cut-off wavelengths, other grids."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import scipy.fft

from viscofric.arrays import Array
from viscofric.contact.periodic.surface import wave_number, without_nyquist
from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.units import Quantity, positive

#: A wave just at a cut-off stays whatever the rounding.
_ROUNDING = 1e-9


class Gridded(Protocol):
    """A surface on a grid."""

    @property
    def spacing(self) -> tuple[float, float]:
        """Distance of neighbouring points along x and y, m."""

    @property
    def periodic(self) -> bool:
        """Whether it is periodic."""


def gradient(heights: Array, grid: Gridded) -> tuple[Array, ...]:
    """Return the slopes along the axes that have points: from the Fourier series if periodic, else differences."""
    axes = [axis for axis, points in enumerate(heights.shape) if points > 1]
    if not grid.periodic:
        return tuple(np.gradient(heights, grid.spacing[axis], axis=axis) for axis in axes)
    found = []
    for axis in axes:
        points = heights.shape[axis]
        q: Array = 2.0 * np.pi * np.fft.rfftfreq(points, grid.spacing[axis]).astype(np.float64)
        factor = 1j * without_nyquist(q, points)
        series = scipy.fft.rfft(heights, axis=axis) * (factor[:, None] if axis == 0 else factor)
        found.append(scipy.fft.irfft(series, points, axis=axis))
    return tuple(found)


def passed(
    heights: Array, spacing: tuple[float, float], shortest: Quantity | None, longest: Quantity | None
) -> tuple[Array, Note]:
    """Return the waves between two lengths, with the mean height, and what was done."""
    if shortest is None and longest is None:
        raise InputError(
            "shortest, longest: neither given; give the shortest wavelength to keep, the longest, or both.",
            code="give-one",
        )
    q = np.hypot(*wave_number((heights.shape[0], heights.shape[1]), spacing))
    keep = q > 0.0
    bounds, values = [], {}
    if longest is not None:
        length = positive(longest, "m", "longest")
        keep &= q >= 2.0 * np.pi / length * (1.0 - _ROUNDING)
        bounds.append(f"longer than {length:.4g} m")
        values["longest"] = length
    if shortest is not None:
        length = positive(shortest, "m", "shortest")
        keep &= q <= 2.0 * np.pi / length * (1.0 + _ROUNDING)
        bounds.append(f"shorter than {length:.4g} m")
        values["shortest"] = length
    if not keep.any():
        raise InputError(
            f"shortest = {shortest!r}, longest = {longest!r}: the surface has no wave in between.", code="no-wave"
        )
    keep[0, 0] = True
    series = np.where(keep, scipy.fft.rfft2(heights), 0.0)
    note = Note("waves-left-out", f"waves left out: {' and '.join(bounds)}", values=values)
    return scipy.fft.irfft2(series, heights.shape), note


def resampled(
    heights: Array, spacing: tuple[float, float], wanted: tuple[float, float]
) -> tuple[Array, tuple[float, float]]:
    """Return a periodic surface on the grid nearest to another spacing, by its Fourier series."""
    found = [*spacing]
    for axis, step in enumerate(wanted):
        points = heights.shape[axis]
        if points == 1:
            found[axis] = step
            continue
        period = points * spacing[axis]
        count = round(period / step)
        if count < 2:
            raise InputError(
                f"spacing = {step:g} m: fewer than two points would be left of {period:.4g} m.", code="too-few-points"
            )
        heights = _resampled_along(heights, axis, count)
        found[axis] = period / count
    return heights, (found[0], found[1])


def _resampled_along(heights: Array, axis: int, count: int) -> Array:
    points = heights.shape[axis]
    if count == points:
        return heights
    series = np.moveaxis(scipy.fft.rfft(heights, axis=axis), axis, 0)
    found = np.zeros((count // 2 + 1, *series.shape[1:]), complex)
    # A Nyquist wave has no direction: that of the coarser grid is left out, and halved where a finer grid parts it.
    kept = (min(points, count) + 1) // 2
    found[:kept] = series[:kept]
    if points % 2 == 0 and count > points:
        found[points // 2] = 0.5 * series[points // 2]
    return np.asarray(scipy.fft.irfft(np.moveaxis(found, 0, axis) * (count / points), count, axis=axis))
