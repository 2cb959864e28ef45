"""Measured or computed indenters: heights on a grid, interpolated by splines."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array, Indices
from viscofric.contact.free.geometry import LINE, Geometry
from viscofric.contact.free.grids import Extent
from viscofric.contact.indenters.indenter import Indenter, too_steep
from viscofric.errors import InputError
from viscofric.notes import Note, Remedy
from viscofric.showing import Rows
from viscofric.units import Quantity, in_si, positive, two_lengths

if TYPE_CHECKING:
    from scipy.interpolate import PPoly, RectBivariateSpline


_FEWEST = 4  # points that a cubic spline needs
# Rms curvature between neighbouring points over that between every second one: 1 of smooth surfaces, 1.2 with eight
# points in the shortest wave, 1.6 at a kink, 4 of noise.  On a ball of 10 mm measured every 0.1 mm, noise of 0.5 µm
# (1.5) makes the friction 2 % too large at E∞/E0 = 10, noise of 1 µm (2.2) 5 %, and up to 50 % at larger ratios.
_UNRESOLVED = 2.0
_BENT = 9  # points along a line in contact from which on curvatures are compared


class _Heights(Indenter):
    """A surface through heights at points along x, and along y where it varies; the lowest one is the origin."""

    z: ArrayLike

    @property
    @abstractmethod
    def _steps(self) -> tuple[float, ...]:
        """Distances of neighbouring points along each axis, m."""

    @abstractmethod
    def _derivative(self, along: int, across: int, x: Array, y: Array) -> Array:
        """Return a derivative of the spline through the heights at (x, y), within the points."""

    @cached_property
    def _points(self) -> tuple[Array, ...]:
        """Positions of the points along each axis, from the lowest one, m."""
        z = np.asarray(self.z)
        lowest = np.unravel_index(int(np.argmin(z)), z.shape)
        axes = zip(self._steps, z.shape, lowest, strict=True)
        return tuple(np.asarray(step * (np.arange(count) - start)) for step, count, start in axes)

    def _at(self, along: int, across: int, x: Array, y: Array, beyond: float) -> Array:
        places = list(np.broadcast_arrays(x, y))
        inside = np.full(places[0].shape, True)
        for axis, points in enumerate(self._points):
            inside &= (places[axis] >= points[0]) & (places[axis] <= points[-1])
            places[axis] = np.clip(places[axis], points[0], points[-1])
        return np.where(inside, self._derivative(along, across, *places), beyond)

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m; infinite beyond the points."""
        return self._at(0, 0, x, y, np.inf)

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y); zero beyond the points."""
        return self._at(1, 0, x, y, 0.0)

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y); zero beyond the points."""
        return self._at(0, 1, x, y, 0.0)

    def check(self, contact: Extent, held: str, reduce: str = "load") -> None:
        """Raise an error for a contact (m) that reaches the outermost points; `held` begins its message."""
        far = (contact.rear, contact.front), (contact.side, contact.side)
        axes = zip(self._points, self._steps, far, strict=False)
        if any(back > -points[0] - step or ahead > points[-1] - step for points, step, (back, ahead) in axes):
            raise InputError(
                f"{held} the contact reaches the edge of the {self.noun}; ",
                code="beyond-indenter",
                remedy=Remedy(f"give the heights of a larger piece of the surface, or reduce the {reduce}."),
            )

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        x, *y = (points[places] for points, places in zip(self._points, self._within(contact), strict=True))
        along, across = (slope(x, y[0] if y else np.zeros(())) for slope in (self.slope, self.slope_across))
        return too_steep(float(np.hypot(along, across).max(initial=0.0)))

    def resolution_warning(self, contact: Extent) -> Note | None:
        """Return a note where noise, or roughness that the points do not resolve, bends the surface."""
        z = np.asarray(self.z)[self._within(contact)]
        return _unresolved(max(_sharpening(np.moveaxis(z, axis, 0)) for axis in range(z.ndim)), self.noun)

    def _within(self, contact: Extent) -> tuple[Indices, ...]:
        """Return the index of the points within a contact."""
        x, *y = self._points
        inside = (x >= -contact.rear) & (x <= contact.front), *(np.abs(one) <= contact.side for one in y)
        return np.ix_(*(np.flatnonzero(one) for one in inside))


@dataclass(frozen=True, eq=False)
class HeightMap(_Heights):
    """A free surface given by its heights on a rectangular grid, x along the first axis, y along the second.

    Between the points it is the bicubic spline through them (no smoothing), beyond the outermost ones there is no
    surface; a contact that reaches them is refused.  The lowest point given is the origin of x, y and of heights, and
    what the indentation is counted from.

    Parameters
    ----------
    z : (nx, ny) array
        Heights, m, from any level, growing away from the solid.  At least four points each way.
    spacing : float, str, pint.Quantity, or a pair of them
        Distance of neighbouring points along both axes, or along x and y, m.

    Raises
    ------
    InputError
        If the heights are not a finite two-dimensional array, or a spacing is not a length above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> x = np.linspace(-2e-3, 2e-3, 81)
    >>> bowl = vf.HeightMap((x[:, None] ** 2 + x**2) / 20e-3, spacing="50 um")
    >>> round(float(bowl.height(1e-3, 0.0)), 12)
    5e-05
    """

    noun: ClassVar[str] = "height map"
    z: ArrayLike
    spacing: Quantity | tuple[Quantity, Quantity]

    def __post_init__(self) -> None:
        object.__setattr__(self, "z", _heights(self.z, 2))
        object.__setattr__(self, "spacing", two_lengths(self.spacing))

    def _shown(self) -> Rows:
        return (
            ("heights", self.z, "m"),
            ("spacing", self._steps[0], "m"),
        )

    @property
    def _steps(self) -> tuple[float, ...]:
        return self.spacing  # type: ignore[return-value]

    @cached_property
    def _spline(self) -> RectBivariateSpline:
        from scipy.interpolate import RectBivariateSpline

        (x, y), z = self._points, np.asarray(self.z)
        return RectBivariateSpline(x, y, z - z.min(), kx=3, ky=3, s=0)

    def _derivative(self, along: int, across: int, x: Array, y: Array) -> Array:
        return np.asarray(self._spline(x, y, along, across, grid=False))


@dataclass(frozen=True, eq=False)
class Profile(_Heights):
    """A free surface that is the same all along y, given by heights along x: a line contact in plane strain.

    Between the points it is the cubic spline through them, beyond the outermost ones there is no surface; a contact
    that reaches them is refused.  The lowest point given is the origin.  Its load is per unit of length (N/m).

    Parameters
    ----------
    z : (n,) array
        Heights, m, from any level, growing away from the solid.  At least four.
    spacing : float, str or pint.Quantity
        Distance of neighbouring points, m.

    Raises
    ------
    InputError
        If the heights are not a finite one-dimensional array, or the spacing is not a length above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> x = np.linspace(-2e-3, 2e-3, 81)
    >>> round(float(vf.Profile(x**2 / 20e-3, spacing="50 um").height(1e-3, 0.0)), 12)
    5e-05
    """

    geometry: ClassVar[Geometry] = LINE
    noun: ClassVar[str] = "profile"
    z: ArrayLike
    spacing: Quantity

    def __post_init__(self) -> None:
        object.__setattr__(self, "z", _heights(self.z, 1))
        object.__setattr__(self, "spacing", positive(self.spacing, "m", "spacing"))

    def _shown(self) -> Rows:
        return (
            ("heights", self.z, "m"),
            ("spacing", self.spacing, "m"),
        )

    @property
    def _steps(self) -> tuple[float, ...]:
        return (float(self.spacing),)

    @cached_property
    def _spline(self) -> PPoly:
        from scipy.interpolate import CubicSpline

        z = np.asarray(self.z)
        return CubicSpline(self._points[0], z - z.min())

    def _derivative(self, along: int, across: int, x: Array, y: Array) -> Array:
        return np.zeros(x.shape) if across else np.asarray(self._spline(x, along))


def _sharpening(z: Array) -> float:
    """Return the rms curvature along the first axis between neighbouring points over that between every second one."""
    if len(z) < _BENT:
        return 1.0
    near, far = z[2:] - 2.0 * z[1:-1] + z[:-2], 0.25 * (z[4:] - 2.0 * z[2:-2] + z[:-4])
    sizes = [float(np.sqrt(np.mean(np.square(one)))) for one in (near, far)]
    rounding = 8.0 * float(np.finfo(float).eps * np.abs(z).max(initial=0.0))
    return sizes[0] / sizes[1] if min(sizes) > rounding else 1.0


def _unresolved(ratio: float, noun: str) -> Note | None:
    if ratio <= _UNRESOLVED:
        return None
    return Note(
        "heights-unresolved",
        f"The {noun} is {ratio:.1f} times as strongly curved between neighbouring points as between every second one: "
        "noise, or roughness that its points do not resolve, which friction and pressure depend on and their errors do "
        "not include. Smooth the heights, or measure them at a smaller spacing.",
        values={"ratio": ratio, "limit": _UNRESOLVED},
    )


def _heights(z: ArrayLike, dimensions: int) -> Array:
    """Return heights as a finite array of so many dimensions, or refuse them."""
    heights = np.array(in_si(z, "m", "z"))
    if heights.ndim != dimensions or min(heights.shape, default=0) < _FEWEST:
        shape = " x ".join(str(count) for count in heights.shape) or "a single number"
        raise InputError(
            f"z: the heights are {shape}, but must be a {dimensions}-dimensional array of at least {_FEWEST} points "
            "along each axis.",
            code="not-heights",
        )
    heights.setflags(write=False)
    return heights
