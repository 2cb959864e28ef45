"""A rough surface or a line scan: heights on a grid, and every step that made them what they are."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import check_cost, flag, sentences, text
from viscofric.arrays import Array
from viscofric.contact.indenters.height_map import HeightMap, Profile
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, check_choice
from viscofric.notes import Note, Remedy
from viscofric.roughness import preparation
from viscofric.showing import Plotted, Rows, prefixed
from viscofric.units import Quantity, in_si, number, two_lengths

#: Of the variance of heights, of a plane through more points than this.
_MOSTLY_TILT, _FEW = 0.5, 8
_LEVEL = Remedy(
    "; remove('tilt') first.",
    "; give --prepare 'remove tilt' first.",
    "; put 'remove tilt' first in prepare.",
    field="surface.prepare",
)
_FILL = Remedy(
    "fill('harmonic') or fill('nearest').",
    "--prepare fill or --prepare 'fill nearest'.",
    "'fill' or 'fill nearest' in prepare.",
    field="surface.prepare",
)
_PERIODIC = Remedy(
    "window(), which tapers its edges to the mean, or mirror(), which appends its mirror images.",
    "--prepare window, which tapers its edges to the mean, or --prepare mirror, which appends its mirror images.",
    "'window', which tapers its edges to the mean, or 'mirror', which appends its mirror images, in prepare.",
    field="surface.prepare",
)


@dataclass(frozen=True, eq=False)
class Topography(Plotted):
    """Heights of a rough surface on a rectangular grid, or along a line, with the steps that made them.

    Every method that changes heights returns a new topography with one more step in its history.

    Parameters
    ----------
    heights : (nx, ny) or (nx,) array
        m, summits high; NaN where there is no reading.  A row is a line scan along x.
    spacing : float, str, pint.Quantity, or two of them
        Distance of neighbouring points, m; of x and y where they differ.
    periodic : bool
        Whether the surface repeats itself: the value that follows the last one is the first.
    name : str
        Shown in figures and reports.
    history : tuple of str
        What was done so far, one step each.

    Raises
    ------
    InputError
        If the heights are no array of numbers with two points at least, or the spacing is no length above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> x = np.linspace(0.0, 1.0, 65)
    >>> tilted = vf.Topography(3e-6 * x + 1e-6 * np.cos(16.0 * np.pi * x), spacing="10 um")
    >>> level = tilted.remove("tilt")
    >>> f"{level.rms_height:.1e}", level.history
    ('7.1e-07', ('tilt removed: least-squares plane',))
    """

    heights: Array
    spacing: tuple[float, float]
    periodic: bool = False
    name: str = ""
    history: tuple[str, ...] = field(default=())

    def __init__(
        self,
        heights: ArrayLike,
        spacing: Quantity | tuple[Quantity, Quantity],
        periodic: bool = False,
        name: str = "",
        history: tuple[str, ...] = (),
    ) -> None:
        z = np.array(in_si(heights, "m", "heights of a topography", infinite=True, missing=True))
        z = z[:, None] if z.ndim == 1 else z
        if z.ndim != 2 or z.shape[0] < 2 or z.size == 0:
            raise InputError(
                "heights of a topography must be (nx, ny) of them, or a row, two at least along x; they have the "
                f"shape {np.shape(heights)}.",
                code="not-heights",
            )
        if np.any(np.isinf(z)):
            raise InputError(
                f"heights of a topography: {np.count_nonzero(np.isinf(z))} are infinite; NaN is missing.",
                code="not-finite",
            )
        z.flags.writeable = False
        object.__setattr__(self, "heights", z)
        object.__setattr__(self, "spacing", two_lengths(spacing))
        object.__setattr__(self, "periodic", flag(periodic, "periodic"))
        object.__setattr__(self, "name", text(name, "name of a topography"))
        object.__setattr__(self, "history", sentences(history, "history of a topography"))

    def _shown(self) -> Rows:
        return (
            ("name", self.name or None),
            ("heights", self.heights, "m"),
            ("size", " × ".join(f"{1e3 * one:.4g}" for one in self.size) + " mm"),
            ("rms height", None if self.missing else self.rms_height, "m"),
            ("rms slope", None if self.missing else self.rms_slope),
            ("missing points", self.missing),
            ("periodic", self.periodic),
            ("steps of preparation", self.history),
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Number of points along x and y; one along y for a line scan."""
        return self.heights.shape[0], self.heights.shape[1]

    @property
    def is_line(self) -> bool:
        """Whether it is a line scan."""
        return self.shape[1] == 1

    @property
    def size(self) -> tuple[float, float]:
        """Lengths along x and y, m: points times spacing, the period of a surface that repeats itself."""
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
    def missing(self) -> int:
        """Number of points without a reading."""
        return int(np.count_nonzero(np.isnan(self.heights)))

    @property
    def rms_height(self) -> float:
        """Root mean square of the heights about their mean, m, of the points that there are."""
        return float(np.nanstd(self.heights))

    @property
    def rms_slope(self) -> float:
        """Root mean square of the gradient's length: by Fourier series if periodic, else by differences of neighbours.

        The latter are 3 % too low where the shortest waves are three points long, 0.3 % where they are eight.

        Raises
        ------
        InputError
            If heights are missing.
        """
        slopes = preparation.gradient(self.complete(), self.spacing, self.periodic)
        return math.sqrt(sum(float(np.square(one).mean()) for one in slopes))

    def complete(self) -> Array:
        """Return the heights, m.

        Raises
        ------
        InputError
            If some are missing.
        """
        if self.missing:
            raise InputError(
                f"{self._noun}: {self.missing} of its {self.heights.size} heights are missing; fill them first, with ",
                code="missing-heights",
                remedy=_FILL,
            )
        return self.heights

    @property
    def _noun(self) -> str:
        return f"topography {self.name!r}" if self.name else "topography"

    def _with(self, heights: Array, *steps: Note, **changed: object) -> Topography:
        return replace(self, heights=heights, history=(*self.history, *steps), **changed)  # type: ignore[arg-type]

    def _tilted(self) -> list[Note]:
        """Return a note where most of the variance is tilt, of which a periodic surface makes a long wave."""
        variance = float(np.var(self.heights))
        if variance == 0.0 or self.heights.size < _FEW:
            return []
        level, _ = preparation.without_trend(self.heights, "tilt")
        share = 1.0 - float(np.var(level)) / variance
        if share <= _MOSTLY_TILT:
            return []
        said = f"{100 * share:.0f} % of the variance of heights was tilt, which is a long wave now"
        return [Note("tilted", said, remedy=_LEVEL, values={"share": share})]

    def fill(self, method: Literal["harmonic", "nearest"] = "harmonic") -> Topography:
        """Fill points without a reading.

        Parameters
        ----------
        method : {"harmonic", "nearest"}
            The smoothest surface that joins what surrounds a hole (Laplace's equation: no new summits), or the height
            of the nearest point.

        Raises
        ------
        InputError
            If all heights are missing, or there is no such method.
        """
        check_choice(method, "method", "harmonic", "nearest")
        if not self.missing:
            return self
        filled = preparation.filled(self.heights, self.spacing, self.periodic, method)
        share = 100.0 * self.missing / self.heights.size
        said = f"{self.missing} missing heights ({share:.2g} %) filled: {method}"
        return self._with(filled, Note("filled", said, values={"heights": self.missing, "method": method}))

    def remove(self, what: Literal["mean", "tilt", "curvature"]) -> Topography:
        """Subtract the mean height, the least-squares plane, or the least-squares paraboloid (all terms to x², xy, y²).

        Parameters
        ----------
        what : {"mean", "tilt", "curvature"}
            Missing heights stay missing and are ignored.  But for the mean, what is left does not repeat itself.

        Raises
        ------
        InputError
            If there is no such trend, or more terms than heights.
        """
        heights, step = preparation.without_trend(self.heights, what)
        return self._with(heights, step, periodic=self.periodic and what == "mean")

    def window(self, edge: float = 0.1) -> Topography:
        """Taper the heights to their mean along all edges, so that the surface is periodic without steps.

        Parameters
        ----------
        edge : float
            Share of each length over which they fall, at either end, by half a cosine (Tukey's window): above 0, at
            most 0.5, which is Hann's window.

        Raises
        ------
        InputError
            If heights are missing, or the share is out of range.

        Notes
        -----
        Roughness is weaker near the edges, by which rms height and slope fall a little: contacts then lie mostly
        within.  `mirror` leaves the statistics as they are.
        """
        edge = number(edge, "edge")
        heights = preparation.tapered(self.complete(), edge)
        said = f"windowed: heights fall to their mean over {edge:g} of each length"
        return self._with(heights, Note("windowed", said, values={"edge": edge}), *self._tilted(), periodic=True)

    def mirror(self) -> Topography:
        """Append the mirror images of the surface, so that it is periodic without steps and without new heights.

        Raises
        ------
        InputError
            If heights are missing.
        """
        z = self.complete()
        for axis in (0,) if self.is_line else (0, 1):
            z = np.concatenate([z, np.flip(z, axis)], axis)
        step = Note("mirrored", "mirrored: extended by its mirror images")
        return self._with(z, step, *self._tilted(), periodic=True)

    def crop(
        self, x: tuple[Quantity, Quantity] | None = None, y: tuple[Quantity, Quantity] | None = None
    ) -> Topography:
        """Cut out a piece.

        Parameters
        ----------
        x, y : (float or quantity, float or quantity), optional
            From and to, m from the first point; all of it if left out.

        Raises
        ------
        InputError
            If fewer than two points along x, or none along y, are left.
        """
        heights, step = preparation.cropped(self.heights, self.spacing, x, y)
        return self._with(heights, step, periodic=False)

    def resample(self, spacing: Quantity | tuple[Quantity, Quantity]) -> Topography:
        """Interpolate the surface onto a finer or coarser grid.

        Parameters
        ----------
        spacing : float, str, pint.Quantity, or two of them
            Wanted distance of neighbouring points, m; a periodic surface gets the nearest one that divides its period.

        Raises
        ------
        InputError
            If heights are missing, or fewer than two points would be left.

        Notes
        -----
        A periodic surface is resampled by its Fourier series: waves that a coarser grid cannot hold are left out.
        Others go through the cubic spline of their heights, after waves below twice the new spacing, if it is
        coarser, have been smoothed away by averages over one new cell.
        """
        wanted = two_lengths(spacing)
        check_cost((length / step for length, step in zip(self.size, wanted, strict=True)), "spacing: the surface")
        change = preparation.resampled_series if self.periodic else preparation.resampled
        heights, found = change(self.complete(), self.spacing, wanted)
        points = " × ".join(str(n) for n in (heights.shape if heights.shape[1] > 1 else heights.shape[:1]))
        said = f"resampled to {points} points, {prefixed(found[0], None, 'm')} apart along x"
        return self._with(heights, Note("resampled", said, values={"spacing": [*found]}), spacing=found)

    def keep_wavelengths(self, shortest: Quantity | None = None, longest: Quantity | None = None) -> Topography:
        """Leave out waves that are shorter or longer (low-, high- or band-pass, sharp in Fourier space).

        Parameters
        ----------
        shortest, longest : float, str or pint.Quantity, optional
            Cut-off wavelengths, m; waves of just this length stay.  At least one of them.

        Raises
        ------
        InputError
            If the surface is not periodic (`window` or `mirror` it first), heights are missing, or no wave is left.
        """
        self._insist_on_period(", so its Fourier series would ring at the edges; first")
        heights, step = preparation.passed(self.complete(), self.spacing, shortest, longest)
        return self._with(heights, step)

    def inverted(self) -> Topography:
        """Exchange summits and valleys, as in a cast of the surface."""
        return self._with(-self.heights, Note("inverted", "inverted: summits become valleys"))

    def along_y(self) -> Topography:
        """Exchange x and y, so that the motion along x goes along what was y.

        Raises
        ------
        InputError
            For a line scan.
        """
        heights, spacing = np.array(self.heights.T), (self.spacing[1], self.spacing[0])
        if self.is_line:
            raise InputError(f"{self._noun} is a line scan; its other axis has one point only.", code="line-scan")
        return self._with(heights, Note("exchanged", "x and y exchanged"), spacing=spacing)

    def to_surface(self) -> PeriodicSurface:
        """Return it as the rigid surface of `solve_periodic`.

        Raises
        ------
        InputError
            If it is not periodic or heights are missing.
        """
        self._insist_on_period(";")
        return PeriodicSurface(self.complete(), self.spacing)

    def _insist_on_period(self, why: str) -> None:
        if not self.periodic:
            raise InputError(f"{self._noun} is not periodic{why} use ", code="not-periodic", remedy=_PERIODIC)

    def to_indenter(self, shape: Indenter | None = None) -> HeightMap | Profile:
        """Return it as the indenter of `solve_steady`: on its own, or as roughness on a smooth one.

        Parameters
        ----------
        shape : Indenter, optional
            A smooth point contact, such as a Ball, whose lowest point lies in the middle of the grid; under a line
            scan a Cylinder.

        Returns
        -------
        HeightMap or Profile
            The latter from a line scan.

        Raises
        ------
        InputError
            If heights are missing, the shape is a line contact under a map or the other way round, or the grid
            reaches beyond the shape.
        """
        return preparation.rough_indenter(self.complete(), self.spacing, shape)

    def to_dataset(self) -> Dataset:
        """Return the heights over x and y; attributes are ``name``, ``periodic`` (1 or 0) and ``history``."""
        return dataset(
            ("x", "y"),
            {"height": (self.heights, "m", "height")},
            coordinates={"x": (self.x, "m", "position along x"), "y": (self.y, "m", "position along y")},
            attributes={"name": self.name, "periodic": int(self.periodic), "history": "; ".join(self.history)},
        )
