"""Measured or computed indenters: heights on a grid, interpolated by splines."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from viscofric.contact.free.geometry import LINE, Geometry
from viscofric.contact.indenters.indenter import Indenter, too_steep
from viscofric.errors import InputError
from viscofric.notes import Note, Remedy
from viscofric.units import Quantity, in_si, positive, two_lengths

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from scipy.interpolate import PPoly, RectBivariateSpline

    from viscofric.arrays import Array, Mask
    from viscofric.contact.free.grids import Extent
    from viscofric.showing import Rows


_FEWEST = 4  # points that a cubic spline needs
# Rms curvature between neighbouring points over that between every second one: 1 of smooth surfaces, 1.2 with eight
# points in the shortest wave, 1.6 at a kink, 4 of noise.  On a ball of 10 mm measured every 0.1 mm, noise of 0.5 µm
# (1.5) makes the friction 2 % too large at E∞/E0 = 10, noise of 1 µm (2.2) 5 %, and up to 50 % at larger ratios.
_UNRESOLVED = 2.0
_BENT = 9  # points along a line in contact from which on curvatures are compared


@dataclass(frozen=True, eq=False)
class HeightMap(Indenter):
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
    _origin: tuple[float, float] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        z = _heights(self.z, 2)
        spacing = two_lengths(self.spacing)
        lowest = np.unravel_index(int(np.argmin(z)), z.shape)
        object.__setattr__(self, "z", z)
        object.__setattr__(self, "spacing", spacing)
        object.__setattr__(self, "_origin", (spacing[0] * float(lowest[0]), spacing[1] * float(lowest[1])))

    def _shown(self) -> Rows:
        return (
            ("heights", self.z, "m"),
            ("spacing", self._steps[0], "m"),
        )

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m; infinite beyond the map."""
        return np.where(self._inside(x, y), self._spline(*self._on_map(x, y), grid=False), np.inf)

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y); zero beyond the map."""
        return np.where(self._inside(x, y), self._spline(*self._on_map(x, y), dx=1, grid=False), 0.0)

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y); zero beyond the map."""
        return np.where(self._inside(x, y), self._spline(*self._on_map(x, y), dy=1, grid=False), 0.0)

    def check(self, contact: Extent, held: str, reduce: str = "load") -> None:
        """Raise an error for a contact (m) that reaches the outermost points of the map; `held` begins its message."""
        (rear, front), side = self._ends[0], min(self._ends[1])
        if contact.rear > rear or contact.front > front or contact.side > side:
            raise InputError(
                f"{held} the contact reaches the edge of the height map; ",
                code="beyond-indenter",
                remedy=Remedy(f"give a map of a larger piece of the surface, or reduce the {reduce}."),
            )

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        x = self._points[0]
        y = self._points[1]
        within = np.ix_((x >= -contact.rear) & (x <= contact.front), np.abs(y) <= contact.side)
        steepness = np.hypot(*np.gradient(np.asarray(self.z), *self._steps))[within]
        return too_steep(float(steepness.max(initial=0.0)))

    def resolution_warning(self, contact: Extent) -> Note | None:
        """Return a note where noise, or roughness that the points do not resolve, bends the surface."""
        x, y = self._points
        z = np.asarray(self.z)[np.ix_((x >= -contact.rear) & (x <= contact.front), np.abs(y) <= contact.side)]
        return _unresolved(max(_sharpening(z), _sharpening(z.T)), self.noun)

    @property
    def _steps(self) -> tuple[float, float]:
        return self.spacing  # type: ignore[return-value]

    @cached_property
    def _points(self) -> tuple[Array, Array]:
        """Positions of the points along x and y, from the lowest one, m."""
        x, y = (
            step * np.arange(count) - start
            for step, count, start in zip(self._steps, np.shape(self.z), self._origin, strict=True)
        )
        return x, y

    @property
    def _ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Distances from the lowest point to the ends of the map, less one point, along x and along y."""
        x, y = (
            (-float(points[0]) - step, float(points[-1]) - step)
            for points, step in zip(self._points, self._steps, strict=True)
        )
        return x, y

    @cached_property
    def _spline(self) -> RectBivariateSpline:
        from scipy.interpolate import RectBivariateSpline

        z = np.asarray(self.z)
        return RectBivariateSpline(*self._points, z - z.min(), kx=3, ky=3, s=0)

    def _inside(self, x: Array, y: Array) -> Mask:
        px, py = self._points
        return np.asarray((x >= px[0]) & (x <= px[-1]) & (y >= py[0]) & (y <= py[-1]))

    def _on_map(self, x: Array, y: Array) -> tuple[Array, Array]:
        px, py = self._points
        a, b = np.broadcast_arrays(np.clip(x, px[0], px[-1]), np.clip(y, py[0], py[-1]))
        return a, b


@dataclass(frozen=True, eq=False)
class Profile(Indenter):
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

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m; infinite beyond the profile."""
        return np.where(self._inside(x), self._spline(x), np.inf) + 0.0 * y

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y); zero beyond the profile."""
        return np.where(self._inside(x), self._spline(x, 1), 0.0) + 0.0 * y

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y): zero."""
        return 0.0 * x + 0.0 * y

    def check(self, contact: Extent, held: str, reduce: str = "load") -> None:
        """Raise an error for a contact (m) that reaches the outermost points of the profile; `held` begins it."""
        x, step = self._points, float(self.spacing)
        if contact.rear > -x[0] - step or contact.front > x[-1] - step:
            raise InputError(
                f"{held} the contact reaches the end of the profile; ",
                code="beyond-indenter",
                remedy=Remedy(f"give a longer one, or reduce the {reduce}."),
            )

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        within = (self._points >= -contact.rear) & (self._points <= contact.front)
        return too_steep(float(np.abs(self._spline(self._points[within], 1)).max(initial=0.0)))

    def resolution_warning(self, contact: Extent) -> Note | None:
        """Return a note where noise, or roughness that the points do not resolve, bends the surface."""
        within = (self._points >= -contact.rear) & (self._points <= contact.front)
        return _unresolved(_sharpening(np.asarray(self.z)[within, None]), self.noun)

    @cached_property
    def _points(self) -> Array:
        z = np.asarray(self.z)
        return np.asarray(float(self.spacing) * (np.arange(len(z)) - np.argmin(z)))

    @cached_property
    def _spline(self) -> PPoly:
        from scipy.interpolate import CubicSpline

        z = np.asarray(self.z)
        return CubicSpline(self._points, z - z.min())

    def _inside(self, x: Array) -> Mask:
        return np.asarray((x >= self._points[0]) & (x <= self._points[-1]))


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
