"""[measurement] of a run file: traction runs or friction curves to compare with the prediction."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from viscofric.errors import brief
from viscofric.study.run_file import tables


def _number_or_word(value: object) -> object:
    """Accept a Coulomb friction coefficient, or the word 'constant' for the same one at all speeds."""
    if value is None or value == "constant":
        return value
    if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
        return float(value)
    raise ValueError(f"{brief(value)} is neither a friction coefficient, such as 0.05, nor the word 'constant'")


class MeasurementTable(tables.Table):
    """[measurement]: tribometer files and how their friction is separated, or separated friction curves."""

    FILES = ("mtm", "curves")

    mtm: tables.FileNames = Field((), description="Traction runs: a file, a list, or a pattern such as 'run*.txt'.")
    curves: tables.FileName | None = Field(None, description="Instead: separated friction curves.")
    columns: tables.Headings = Field({}, description="Headings that are not understood: { disc_speed = 'V1 (mm/s)' }.")
    sheet: tables.Words | None = Field(None, description="Name of the sheet of a workbook.")
    zero: tables.SignedForce | None = Field(None, description="Reading of the force cell without traction, if known.")
    zero_error: tables.Force | None = Field(None, description="Standard error of zero.")
    coulomb: Annotated[
        Any, BeforeValidator(_number_or_word), WithJsonSchema({"anyOf": [{"type": "number"}, {"const": "constant"}]})
    ] = Field(None, description="Coulomb friction for slip in one direction only: a coefficient, or 'constant'.")
    coulomb_error: Annotated[tables.Number, Field(gt=0.0)] | None = Field(
        None, description="Standard error of coulomb."
    )
    except_steps: Annotated[
        tuple[tables.Count, ...],
        BeforeValidator(tables.listed),
        tables.one_or_more({"type": "integer"}),
        Field(max_length=tables.MOST_POINTS),
    ] = Field((), description="Steps of the test to leave out: a number or a list.")
    outliers: Literal["keep", "leave out"] = Field(
        "keep", description="Readings far from others at the same conditions."
    )
    speed_tolerance: tables.Number = Field(
        0.05, gt=0.0, lt=1.0, description="Relative gap that separates nominal speeds and slips."
    )
    temperature_tolerance: tables.TemperatureStep = Field(
        1.0, description="Gap that separates nominal temperatures.", json_schema_extra={"default": "1 K"}
    )

    def _problems(self) -> Iterator[str]:
        if not self.mtm and self.curves is None:
            yield 'has no data; give mtm = "runs.txt" (or friction curves, curves = "curves.csv")'
        if self.mtm and self.curves is not None:
            yield "mtm and curves are both given; give one of them"
        useless = sorted(self.model_fields_set - {"mtm", "curves", "columns", "sheet"})
        if self.curves is not None and useless:
            yield f"{' and '.join(useless)} cannot be chosen for friction curves, which are already separated"
            return
        if self.zero_error is not None and self.zero is None:
            yield "zero_error is the standard error of `zero`, which is not given"
        if self.coulomb_error is not None and not isinstance(self.coulomb, float):
            yield "coulomb_error is the standard error of `coulomb`, for which no number is given"

    @property
    def settings(self) -> dict[str, Any]:
        """Arguments of `viscofric.friction.measurement.tribometry.separate`."""
        return {
            "zero": self.zero if self.zero_error is None else (self.zero, self.zero_error),
            "coulomb": self.coulomb if self.coulomb_error is None else (self.coulomb, self.coulomb_error),
            "outliers": self.outliers,
            "speed_tolerance": self.speed_tolerance,
            "temperature_tolerance": self.temperature_tolerance,
        }
