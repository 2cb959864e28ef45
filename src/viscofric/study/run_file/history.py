"""[history] and [impact] of a run file: every case also over time, and every indenter as a falling mass."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from viscofric.errors import brief
from viscofric.study.run_file import tables
from viscofric.units import to_si

_MOST_DWELLS = 1000


def _duration(value: object) -> float:
    found = to_si(tables.with_unit(value), "s", tables.VALUE)
    if found < 0.0:
        raise ValueError(f"{brief(value)} is below zero")
    return found


Duration = Annotated[float, BeforeValidator(_duration), tables.as_text("0.1 s")]
Durations = Annotated[
    tuple[Duration, ...],
    BeforeValidator(tables.listed),
    Field(min_length=1, max_length=_MOST_DWELLS),
    tables.one_or_more(tables.schema_of(Duration), _MOST_DWELLS),
]
#: Keys that a file replaces.
_STAGES = ("load_time", "dwell", "slide", "strokes")


class HistoryTable(tables.Table):
    """[history]: every case also over time, at its load or pressure, speed and temperature, with [heating] heated."""

    FILES = ("file",)

    load_time: Duration = Field(0.0, description="Time in which the load or pressure rises from zero; 0 s: at once.")
    dwell: Durations = Field((0.0,), description="Time at rest under the load before the sliding; several are an axis.")
    slide: tables.Length | None = Field(
        None, description="Length of the path at the speed of the case; default: no sliding."
    )
    strokes: tables.Count = Field(1, ge=1, le=10_000, description="Number of strokes along the path, back and forth.")
    before: Literal["untouched", "at rest", "sliding"] = Field(
        "untouched",
        description="State before the start: untouched, under the first load for ever, or sliding steadily.",
    )
    cycle: bool = Field(
        False,
        strict=True,
        description="Whether this is one period of a motion that repeats itself, to solve its periodic state.",
    )
    points: tables.Count = Field(
        200,
        ge=2,
        le=tables.MOST_POINTS,
        description="Number of stored times, dense after each change of load or speed.",
    )
    file: tables.FileName | None = Field(
        None,
        description="Instead: table of the history; without a load or depth in it, the load or pressure of the case.",
    )
    columns: tables.Headings = Field(
        default_factory=dict, description="Headings of the table that are not understood: { load = 'Fz (N)' }."
    )
    sheet: tables.Words | None = Field(None, description="The only sheet of a workbook to read.")

    def _problems(self) -> Iterator[tables.Problem]:
        if self.cycle:
            for name in ("before", "load_time"):
                if name in self.model_fields_set:
                    yield name, "is given besides cycle = true, whose period ends as it begins"
        if self.file is not None:
            for name in _STAGES:
                if name in self.model_fields_set:
                    said = "is given besides file, which has the whole history"
                    yield name, tables.worded(said, "is given besides a table, which has the whole history")
            return
        for name in ("columns", "sheet"):
            if getattr(self, name):
                yield name, "is for a file only"
        if self.slide is None and not self.load_time and min(self.dwell) == 0.0:
            said = "is zero, and nothing else happens; give dwell, load_time or slide"
            yield "dwell", tables.worded(said, f"{said.partition(';')[0]}; give a dwell, a time to load or a path")
        if self.slide is None and self.strokes > 1:
            yield "strokes", tables.worded("needs slide, the length of the path", "need the path of a stroke")


class ImpactTable(tables.Table):
    """[impact]: every ball or cone also falls on the rubber, at every temperature."""

    mass: tables.Mass = Field(description="Mass of the indenter.")
    speed: tables.Speeds = Field(description="Speed at the first touch; several are an axis.")
    gravity: tables.Gravity | None = Field(None, description="Acceleration towards the rubber; default: none.")
