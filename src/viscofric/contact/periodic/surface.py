"""Periodic rough surfaces, their copies on coarser grids, and wave numbers of these grids."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol, TypeVar, runtime_checkable

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike

from viscofric.arguments import LARGEST, SMALLEST
from viscofric.arrays import Array, ComplexArray
from viscofric.errors import InputError
from viscofric.showing import Rows, Shown
from viscofric.threads import in_parts, threads_for
from viscofric.units import Quantity, in_si, two_lengths

Result = TypeVar("Result")

# Largest mean pressure, over that which flattens a surface: the heights are lost in the rounding of larger ones.
_LARGEST_MEAN = 1e14


@runtime_checkable
class Topographic(Protocol):
    """What becomes a periodic surface, such as a topography."""

    def to_surface(self) -> PeriodicSurface:
        """Return it as a periodic surface."""


class Coarser(NamedTuple):
    """Heights of a surface on fewer points, (mx, my), m, and the distances between these along x and y, m."""

    z: Array
    spacing: tuple[float, float]


@dataclass(frozen=True, eq=False)
class PeriodicSurface(Shown):
    """A rigid surface given by its heights on a grid, periodic along both axes.

    Parameters
    ----------
    z : (nx, ny) or (nx,) array
        Heights above any level, m, positive towards the material: summits touch first.  A row stands for a profile that
        is the same everywhere along y (plane strain).
    spacing : float, str, pint.Quantity, or two of them
        Distance between neighbouring points, m; of x and y where they differ.

    Raises
    ------
    InputError
        If a height is not finite, there are fewer than two points, all heights are equal, or the spacing is no length
        above zero.

    Notes
    -----
    The value that follows the last one is the first: the period is ``nx * spacing``, not ``(nx - 1) * spacing``.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> wave = vf.contact.PeriodicSurface(1e-6 * np.cos(2.0 * np.pi * np.arange(64) / 64), spacing=1e-3 / 64)
    >>> wave.z.shape
    (64, 1)
    """

    z: Array
    spacing: tuple[float, float]

    def __init__(self, z: ArrayLike, spacing: Quantity | tuple[Quantity, Quantity]) -> None:
        heights = np.array(in_si(z, "m", "z of a periodic surface"))
        if heights.ndim == 1:
            heights = heights[:, None]
        if heights.ndim != 2 or heights.size < 2:
            raise InputError(
                f"z of a periodic surface must be heights on (nx, ny) points or on a row of them, two at least; it has "
                f"the shape {np.shape(z)}.",
                code="not-heights",
            )
        if np.ptp(heights) == 0.0:
            raise InputError(
                "z of a periodic surface is flat: all its heights are equal; a contact needs roughness.", code="flat"
            )
        heights.flags.writeable = False
        object.__setattr__(self, "z", heights)
        object.__setattr__(self, "spacing", two_lengths(spacing))

    def _shown(self) -> Rows:
        return (
            ("heights", self.z, "m"),
            ("period", " × ".join(f"{1e3 * one:.4g}" for one in self.period) + " mm"),
            ("rms height", self.rms_height, "m"),
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Number of points along x and y."""
        return self.z.shape[0], self.z.shape[1]

    @property
    def period(self) -> tuple[float, float]:
        """Lengths after which the surface repeats itself, m."""
        return self.shape[0] * self.spacing[0], self.shape[1] * self.spacing[1]

    @property
    def x(self) -> Array:
        """Positions of the points along x, m."""
        return np.asarray(self.spacing[0] * np.arange(self.shape[0]), dtype=np.float64)

    @property
    def y(self) -> Array:
        """Positions of the points along y, m."""
        return np.asarray(self.spacing[1] * np.arange(self.shape[1]), dtype=np.float64)

    @property
    def rms_height(self) -> float:
        """Root mean square of the heights about their mean, m."""
        return float(self.z.std())

    def slope(self, direction: tuple[float, float]) -> Array:
        """Return the derivative of the heights along a unit vector, by their Fourier series; (nx, ny) array."""
        found = np.zeros(self.shape)
        for axis, part in enumerate(direction):
            if part != 0.0:

                def add(slope: Array, found: Array, part: float = part) -> None:
                    found += part * slope

                self.on_slopes(axis, add, found)
        return found

    def on_slopes(self, axis: int, function: Callable[..., Result], *fields: Array) -> list[Result]:
        """Call a function with the slopes along an axis, and with fields (nx, ny), of some lines along it at a time."""
        points, spacing = self.shape[axis], self.spacing[axis]
        q: Array = 2.0 * np.pi * np.fft.rfftfreq(points, spacing).astype(np.float64)
        factor = 1j * without_nyquist(q, points)

        def called(z: Array, *fields: Array) -> Result:
            return function(scipy.fft.irfft(scipy.fft.rfft(z, axis=1) * factor, points, axis=1), *fields)

        return in_parts(called, *(np.moveaxis(each, axis, 1) for each in (self.z, *fields)))

    def coarser(self, shapes: Sequence[tuple[int, int]]) -> list[Coarser]:
        """Return the surface on fewer points of the same period, without its shortest waves."""
        if not shapes:
            return []
        fine = scipy.fft.rfft2(self.z, workers=threads_for(self.z.size))
        fine /= self.z.size
        return [self._on_points(fine, shape) for shape in shapes]

    def _on_points(self, fine: ComplexArray, shape: tuple[int, int]) -> Coarser:
        mx, my = shape
        coarse = np.zeros((mx, my // 2 + 1), complex)
        # The Nyquist waves of the coarse grid, which have no direction, are left out as well.
        ahead, behind, across = (mx + 1) // 2, (mx - 1) // 2, (my + 1) // 2
        coarse[:ahead, :across] = fine[:ahead, :across]
        if behind:
            coarse[-behind:, :across] = fine[-behind:, :across]
        coarse *= mx * my
        heights = scipy.fft.irfft2(coarse, shape, overwrite_x=True, workers=threads_for(mx * my))
        return Coarser(heights, (self.period[0] / mx, self.period[1] / my))


def flattening_pressure(height: float, compliance: float, largest: float = 0.0) -> float:
    """Return about the pressure that flattens a surface, Pa, of a height (m) and the compliance of a wave (m/Pa).

    InputError if it is too large or too small for computations, or too small for the `largest` mean pressure.
    """
    found = height / compliance
    if not SMALLEST <= found <= LARGEST:
        raise InputError(
            f"the pressure that flattens the surface is about {found:.2g} Pa, which must lie within {SMALLEST:g} and "
            f"{LARGEST:g} Pa; check the units of heights, spacing and moduli.",
            code="out-of-range",
        )
    if largest > _LARGEST_MEAN * found:
        raise InputError(
            f"pressure: {largest:g} Pa is too large for a surface that {found:.2g} Pa flattens; check its unit.",
            code="out-of-range",
        )
    return found


def interpolated(values: Array, shape: tuple[int, int]) -> Array:
    """Interpolate values on a grid of other points in the same period, cubically along each axis."""
    for axis, points in enumerate(shape):
        given = values.shape[axis]
        if given == points:
            continue
        if points == 2 * given:
            values = _doubled(values, axis)
            continue
        place = np.arange(points) * (given / points)
        before = np.floor(place).astype(int)
        t = (place - before).reshape((-1, 1) if axis == 0 else (1, -1)).astype(values.dtype)
        weights = t * (t - 1) * (2 - t) / 6, (t * t - 1) * (t - 2) / 2, t * (t + 1) * (2 - t) / 2, t * (t * t - 1) / 6
        around = (np.take(values, (before + step) % given, axis) for step in (-1, 0, 1, 2))
        values = np.sum([weight * each for weight, each in zip(weights, around, strict=True)], axis=0)
    return values


def _doubled(values: Array, axis: int) -> Array:
    """Insert the value of the cubic through four neighbours between the middle two, along one axis."""
    nx, ny = values.shape
    found = np.empty((nx, 2, ny) if axis == 0 else (nx, ny, 2), values.dtype)

    def around(values: Array) -> list[Array]:
        return [np.roll(values, -step, axis) for step in (-1, 1, 2)]

    def insert(found: Array, values: Array, *others: Array) -> None:
        before, after, behind = others or around(values)
        given, between = np.moveaxis(found, axis + 1, 0)
        given[...] = values
        between[...] = 0.5625 * (values + after) - 0.0625 * (before + behind)

    in_parts(insert, found, values, *(around(values) if axis == 0 else ()))
    return found.reshape((2 * nx, ny) if axis == 0 else (nx, 2 * ny))


def wave_number(shape: tuple[int, int], spacing: tuple[float, float]) -> tuple[Array, Array]:
    """Return q_x as a column and q_y as a row, 1/m, in the order of `scipy.fft.rfft2`.

    The Nyquist waves, where there are any, have positive wave numbers.
    """
    qx = 2.0 * np.pi * np.abs(np.fft.fftfreq(shape[0], spacing[0])) * _signs(shape[0])
    qy: Array = 2.0 * np.pi * np.fft.rfftfreq(shape[1], spacing[1]).astype(np.float64)
    return qx[:, None], qy[None, :]


def _signs(points: int) -> Array:
    index = np.arange(points)
    return np.where(index > points // 2, -1.0, 1.0)


def without_nyquist(wave_numbers: Array, points: int) -> Array:
    """Return wave numbers with the Nyquist wave's set to zero, as for the derivative of a real series."""
    found = wave_numbers.copy()
    if points % 2 == 0:
        found.reshape(-1)[points // 2] = 0.0
    return found


def hermitian_factor(points: int) -> Array:
    """Return how often each wave of a real transform stands for one of the full one: once or twice."""
    factor = np.full(points // 2 + 1, 2.0)
    factor[0] = 1.0
    if points % 2 == 0:
        factor[-1] = 1.0
    return factor
