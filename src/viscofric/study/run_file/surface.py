"""[surface] of a run file: a rough surface that slides over the rubber, generated or measured."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, BeforeValidator, Field

from viscofric.errors import InputError
from viscofric.friction.cases.case import Case
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import MadeSurface, ScannedSurface, SurfaceSource, file_digest, step_of
from viscofric.study.run_file import tables
from viscofric.units import conversion

_MOST_POINTS, _MOST_STEPS = 16_384, 50
_FEWEST_POINTS = 4
_ROUNDING = 1e-9
#: Keys of a surface read from a file, and of that and a generated one.
_READ = ("unit", "channel", "missing", "lines", "prepare")
_OF_BOTH = ("file", "spacing", "modulus", "poisson_ratio")
#: Keys that are arguments of a `MadeSurface` as they stand.
_AS_GIVEN = ("longest", "rms_height", "rms_slope", "aspect", "angle", "exact")

_Points = Annotated[int, Field(strict=True, ge=1, le=_MOST_POINTS)]
Points = Annotated[
    tuple[_Points, ...],
    BeforeValidator(tables.listed),
    Field(min_length=1, max_length=2),
    tables.one_or_more({"type": "integer", "minimum": 1, "maximum": _MOST_POINTS}, 2),
]


def _known(words: str) -> str:
    try:
        step_of(words)
    except InputError as error:
        raise ValueError(str(error)) from None
    return " ".join(words.split())


Step = Annotated[tables.Words, AfterValidator(_known)]


def _unit_of_length(value: str) -> str:
    conversion(value, "m", tables.VALUE)
    return value


class SurfaceTable(tables.Table):
    """[surface]: a periodic rough surface, generated as self-affine or read from a file."""

    shape: ClassVar[str] = "rough surface"
    #: Class of its cases, and the keys of [conditions] that they take.
    CASE: ClassVar[type[Case]] = SurfaceCase
    CONDITIONS: ClassVar[tuple[str, ...]] = ("pressure", "direction")
    #: Whether its load is per length.
    LINE: ClassVar[bool] = False
    FILES = ("file",)

    hurst: tables.Number | None = Field(None, gt=0.0, le=1.0, description="Hurst exponent of a generated surface.")
    rms_height: tables.Length | None = Field(None, description="Rms height; or give rms_slope.")
    rms_slope: tables.Number | None = Field(None, gt=0.0, description="Rms slope; or give rms_height.")
    longest: tables.Length | None = Field(None, description="Longest wavelength; default: the period.")
    rolloff: tables.Length | None = Field(
        None, description="Wavelength above which the spectrum is flat; default: the longest."
    )
    shortest: tables.Length | None = Field(None, description="Shortest wavelength; at least eight points of the grid.")
    points: Points = Field(
        default_factory=tuple,
        description="Number of points along both axes, or [along, across]; [512, 1] is a profile.",
    )
    spacing: tables.Length | None = Field(
        None, description="Spacing of points; for a file, only if it does not state it."
    )
    period: tables.Length | None = Field(None, description="Period along x, instead of spacing.")
    seed: tables.Seeds = Field(
        default_factory=tuple, description="Seed of the random numbers; each seed gives a different surface."
    )
    aspect: tables.Number = Field(1.0, gt=0.0, description="Ratio of correlation lengths along and across the lay.")
    angle: tables.Direction = Field(0.0, description="Direction of the lay, from x towards y.")
    exact: bool = Field(True, description="Whether each surface has exactly the rms value, or only their mean.")

    file: tables.FileName | None = Field(None, description="Instead: file of a measured surface.")
    unit: Annotated[tables.Words, AfterValidator(_unit_of_length)] | None = Field(
        None, description="Unit of heights in files that do not state it."
    )
    channel: tables.Words | tables.Count | None = Field(
        None, description="Name or number of one of several maps in the file."
    )
    missing: tables.Number | None = Field(None, description="Number that marks a missing height, such as -9999.0.")
    lines: Literal["x", "y"] = Field("x", description="Axis along which the lines of a text matrix follow each other.")
    prepare: Annotated[tuple[Step, ...], BeforeValidator(tables.listed)] = Field(
        (),
        max_length=_MOST_STEPS,
        description="Preparation steps in their order: 'fill', 'remove tilt', 'window', 'shortest 40 um' …",
    )

    modulus: tables.Modulus | None = Field(None, description="Young's modulus of an elastic surface; rigid without it.")
    poisson_ratio: tables.Number = Field(0.3, ge=0.0, le=0.5, description="Poisson's ratio of an elastic surface.")

    def _problems(self) -> Iterator[tables.Problem]:
        if "poisson_ratio" in self.model_fields_set and self.modulus is None:
            yield "poisson_ratio", "is for an elastic surface, but modulus is not given; a rigid one has none"
        given = self.model_fields_set
        if self.file is None and self.hurst is None:
            yield "", 'has no source; give file = "scan.csv", or the hurst exponent of a generated surface'
            return
        made = [name for name in type(self).model_fields if name not in (*_READ, *_OF_BOTH)]
        wrong, kind = (
            (made, "a generated surface, but there is a file") if self.file else (_READ, "a surface read from a file")
        )
        found = [name for name in wrong if name in given]
        for name in found:
            yield name, f"is for {kind}; leave it out"
        if self.file is None and not found:
            missing = list(self._missing())
            yield from missing
            if not missing:
                yield from self._cannot_be_made()

    def _missing(self) -> Iterator[tables.Problem]:
        """Yield the keys that are missing to generate a surface."""
        for name, example in (("shortest", '"40 um"'), ("points", "256"), ("seed", "1")):
            if name not in self.model_fields_set:
                yield name, f"is missing; a generated surface needs it, e.g. {name} = {example}"
        for one, other in (("rms_height", "rms_slope"), ("spacing", "period")):
            both = [getattr(self, one), getattr(self, other)]
            if both.count(None) != 1:
                yield one, f"give {one} or {other}, {'one of them' if None in both else 'not both'}"

    def _cannot_be_made(self) -> Iterator[tables.Problem]:
        """Yield why no surface can be generated from the numbers."""
        nx, ny = self.shape_of_grid
        period = max(nx, ny) * self.step
        longest, shortest = self.longest or period, self.shortest or 0.0
        rolloff = self._rolloff or longest
        least = 2.0 * self.step * max(self.aspect, 1.0 / self.aspect) ** 0.5
        if nx < _FEWEST_POINTS:
            yield "points", f"{nx} along x are too few; {_FEWEST_POINTS} are the least"
        elif not shortest < rolloff <= longest:
            words = f"{shortest:g} m, rolloff {rolloff:g} m and longest {longest:g} m must increase in this order"
            yield "shortest", words if self.longest else f"{words}; the longest is the period by default"
        elif shortest <= least:
            yield "shortest", f"{shortest:g} m is not above two points of the grid, {least:.4g} m; use about eight"
        elif period < shortest:
            yield "shortest", f"{shortest:g} m is longer than the period, {period:g} m"
        if ny == 1 and self.aspect != 1.0:
            yield "aspect", "is of a lay, which a profile does not have"

    @property
    def axes(self) -> dict[str, tuple[Any, ...]]:
        """The seeds of a generated surface."""
        return {} if self.file is not None else {"seed": self.seed}

    @property
    def shape_of_grid(self) -> tuple[int, int]:
        """Points along x and y of a generated surface."""
        return self.points[0], self.points[-1]

    @property
    def _rolloff(self) -> float | None:
        """The roll-off, m: no longer than the longest wavelength, apart from rounding."""
        longest = self.longest or max(self.points) * self.step
        near = self.rolloff is not None and 0.0 < self.rolloff - longest < _ROUNDING * longest
        return longest if near else self.rolloff

    @property
    def step(self) -> float:
        """Spacing of the points of a generated surface, m."""
        return self.spacing if self.spacing is not None else (self.period or math.nan) / self.points[0]

    def made(self, *seed: int) -> SurfaceSource:
        """Return the surface for one value of each axis; raise `DataFileError` if its file cannot be read."""
        if self.file is not None:
            steps = None if self.spacing is None else (self.spacing, self.spacing)
            return ScannedSurface(
                self.file,
                file_digest(self.file),
                self.prepare,
                self.unit or "",
                steps,
                self.channel,
                self.missing,
                self.lines,
            )
        return MadeSurface(
            hurst=self.hurst or math.nan,
            points=self.shape_of_grid,
            spacing=(self.step, self.step),
            seed=seed[0],
            shortest=self.shortest or math.nan,
            rolloff=self._rolloff,
            **{name: getattr(self, name) for name in _AS_GIVEN},
        )
