"""The report's tables: rows of finished texts, from the groups of a study's results."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.report.doubts import EXTRAPOLATED, WIDE, remarks
from viscofric.report.house_style import degrees
from viscofric.report.numbers import ABSENT, percent, signed_percent, significant, with_error
from viscofric.report.results import group, nearest, nominal_temperatures, number, values
from viscofric.report.results import table as texts

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr

_MOST_ROWS_AT_A_GLANCE = 12
_DOUBTFUL = (
    f"{WIDE}: reaching beyond {SMALL_STRAIN:g} ball radii from the axis; "
    f"{EXTRAPOLATED}: at frequencies that were not measured"
)
_MEANINGS = (
    "front and rear: from the ball's axis to the leading and to the trailing edge of the contact; half-width: across "
    "the motion; energy balance: friction from the pressure less friction from the dissipation, relative; "
    "complementarity: largest violation of the contact conditions, over the indentation; cells: along the longer "
    "edge of the finest grid; products: with the influence matrix, the solver's work."
)


@dataclass(frozen=True)
class Table:
    """A table: what it shows, its headings and its cells, and a line below that explains them."""

    key: str
    caption: str
    headings: list[str]
    rows: list[list[str]]
    open: bool = True
    note: str = ""


class _Column(NamedTuple):
    heading: str
    variable: str
    text: Callable[[float], str]


def _times(factor: float, digits: int = 4) -> Callable[[float], str]:
    return lambda value: significant(factor * value, digits)


def _whole(value: float) -> str:
    return f"{value:.0f}" if np.isfinite(value) else ABSENT


def _table(
    key: str, caption: str, dataset: xr.Dataset, columns: list[_Column], is_open: bool = True, note: str = ""
) -> Table:
    """Write down those columns that the dataset has."""
    columns = [column for column in columns if column.variable in dataset.variables]
    texts = [[column.text(float(value)) for value in values(dataset, column.variable)] for column in columns]
    return Table(
        key,
        caption,
        [column.heading for column in columns],
        [list(row) for row in zip(*texts, strict=True)],
        is_open,
        note,
    )


def _with_remarks(table: Table, doubts: list[str]) -> Table:
    """Add a column that says what is doubtful about a row, if anything is about any."""
    if not any(doubts):
        return table
    rows = [[*row, doubt] for row, doubt in zip(table.rows, doubts, strict=True)]
    note = f"{table.note} {_DOUBTFUL}.".strip()
    return replace(table, headings=[*table.headings, "remark"], rows=rows, note=note)


def friction_at_a_glance(tree: xr.DataTree) -> Table | None:
    """Predicted friction as a grid: a row for each speed, a column for each temperature (and load)."""
    prediction = group(tree, "prediction")
    if prediction is None:
        return None
    speed, load = values(prediction, "speed"), values(prediction, "load")
    friction, doubts = values(prediction, "friction_coefficient"), remarks(tree, prediction)
    nominal = nominal_temperatures(values(prediction, "temperature"))
    which = nearest(nominal, values(prediction, "temperature"))
    loads = np.unique(load)
    columns = [
        (index, force) for index in range(nominal.size) for force in loads if np.any((which == index) & (load == force))
    ]
    speeds = np.unique(speed)
    every = int(np.ceil(speeds.size / _MOST_ROWS_AT_A_GLANCE))
    chosen = speeds[::every]
    rows = []
    for row_speed in chosen:
        cells = [significant(1e3 * float(row_speed), 4)]
        for index, force in columns:
            match = np.flatnonzero((which == index) & (load == force) & (speed == row_speed))
            mark = " *" if match.size and doubts[match[0]] else ""
            cells.append(significant(float(friction[match[0]]), 3) + mark if match.size else ABSENT)
        rows.append(cells)
    headings = [
        degrees(float(nominal[index])) + (f", {significant(float(force))} N" if loads.size > 1 else "")
        for index, force in columns
    ]
    some = f" One speed in {every}; all of them are in the tables below." if every > 1 else ""
    return Table(
        "at-a-glance",
        f"Predicted viscoelastic friction coefficient.{some}",
        ["speed (mm/s)", *headings],
        rows,
        note=f"* {_or(doubts)}." if any(cell.endswith("*") for row in rows for cell in row) else "",
    )


def _or(doubts: list[str]) -> str:
    """Say which doubts the marked cells carry."""
    told = [part for part in _DOUBTFUL.split("; ") if any(part.split(":")[0] in doubt for doubt in doubts)]
    return "; ".join(told)


def agreement_table(tree: xr.DataTree) -> Table | None:
    """Prediction against measurement, temperature by temperature."""
    agreement = group(tree, "agreement")
    if agreement is None:
        return None
    left_out = number(agreement.attrs, "left_out")
    left = ""
    if left_out > 0:
        points = "1 measured point is" if left_out == 1 else f"{left_out:.0f} measured points are"
        left = f" {points} left out: without a prediction, or with friction not above zero."
    return _table(
        "agreement",
        "Predicted less measured friction, over the measured one, temperature by temperature.",
        agreement,
        [
            _Column("temperature", "temperature", degrees),
            _Column("points", "points", _whole),
            _Column("mean", "bias", signed_percent),
            _Column("rms", "rms", percent),
            _Column("within 2 standard errors", "share_within_error", lambda share: percent(share, 3)),
        ],
        note="Standard error: of the measured mean, with the numerical error of the prediction; the uncertainty of "
        f"the material (sweeps, shift factors, spectrum) is not counted.{left}",
    )


def _prediction_table(tree: xr.DataTree, name: str, key: str, caption: str, is_open: bool) -> Table | None:
    prediction = group(tree, name)
    if prediction is None:
        return None
    friction = prediction["friction_coefficient"]
    full = prediction.assign(relative_error=prediction["friction_error"] / abs(friction).where(friction != 0.0))
    table = _table(
        key,
        caption,
        full,
        [
            _Column("temperature", "temperature", degrees),
            _Column("speed (mm/s)" if name == "prediction" else "reduced speed (mm/s)", "speed", _times(1e3)),
            _Column("load (N)", "load", significant),
            _Column("friction coefficient", "friction_coefficient", _times(1.0)),
            _Column("numerical error", "relative_error", percent),
            _Column("energy balance", "energy_balance", percent),
            _Column("indentation (mm)", "indentation", _times(1e3)),
            _Column("area (mm²)", "contact_area", _times(1e6, 3)),
            _Column("front (mm)", "front", _times(1e3)),
            _Column("rear (mm)", "rear", _times(1e3)),
            _Column("half-width (mm)", "half_width", _times(1e3)),
            _Column("largest pressure (MPa)", "max_pressure", _times(1e-6)),
            _Column("complementarity", "complementarity", _times(1.0, 2)),
            _Column("cells", "cells", _whole),
            _Column("products", "products", _whole),
        ],
        is_open,
        _MEANINGS,
    )
    return _with_remarks(table, remarks(tree, prediction))


def _measurement_table(tree: xr.DataTree) -> Table | None:
    measurement = group(tree, "measurement")
    if measurement is None:
        return None
    full = measurement.assign(difference=measurement["predicted"] / measurement["viscoelastic"] - 1.0)
    table = _table(
        "measured-and-predicted",
        "Measured and predicted friction coefficients (scatter: standard deviation over the repetitions; "
        "standard error: of their mean).",
        full,
        [
            _Column("temperature", "temperature", degrees),
            _Column("speed (mm/s)", "speed", _times(1e3)),
            _Column("reduced speed (mm/s)", "reduced_speed", _times(1e3)),
            _Column("load (N)", "load", _times(1.0)),
            _Column("repetitions", "replicates", _whole),
            _Column("viscoelastic, measured", "viscoelastic", _times(1.0)),
            _Column("scatter", "viscoelastic_scatter", _times(1.0, 2)),
            _Column("standard error", "viscoelastic_error", _times(1.0, 2)),
            _Column("predicted", "predicted", _times(1.0)),
            _Column("numerical error", "predicted_error", _times(1.0, 2)),
            _Column("predicted less measured", "difference", signed_percent),
        ],
    )
    for heading, name in (("Coulomb, measured", "coulomb"), ("left over (consistency)", "consistency")):
        if name in measurement.variables:
            table.headings.append(heading)
            pairs = zip(values(measurement, name), values(measurement, f"{name}_error"), strict=True)
            for row, (value, error) in zip(table.rows, pairs, strict=True):
                row.append(with_error(float(value), float(error)))
    return _with_remarks(table, remarks(tree, measurement))


def _shift_factor_table(tree: xr.DataTree) -> Table | None:
    factors = group(tree, "shift_factors")
    if factors is None:
        return None
    columns = [
        _Column("temperature", "temperature", degrees),
        _Column("log₁₀ α", "log10_shift_factor", _times(1.0)),
        _Column("standard error", "standard_error", _times(1.0, 2)),
        _Column("α", "alpha", _times(1.0)),
        _Column("log₁₀ b", "log10_vertical_shift", _times(1.0)),
        _Column("standard error of log₁₀ b", "vertical_standard_error", _times(1.0, 2)),
    ]
    full = factors.assign(alpha=10.0 ** factors["log10_shift_factor"])
    return _table("shift-factors", "Shift factors of the isotherms.", full, columns, is_open=False)


def _law_table(tree: xr.DataTree) -> Table | None:
    laws = group(tree, "laws")
    if laws is None:
        return None
    rows = [
        [str(law), str(constants), significant(float(criterion), 3), significant(float(scatter), 2)]
        for law, constants, criterion, scatter in zip(
            *(laws[name].values for name in ("law", "constants", "information_criterion", "law_scatter")), strict=True
        )
    ]
    refused = "".join(f" {title}: {reason}" for title, reason in texts(laws.attrs, "refused").items())
    return Table(
        "laws",
        "Shift laws fitted to the shift factors, compared by the information criterion.",
        ["law", "constants", "AICc above the lowest", "scatter beyond the errors (decades)"],
        rows,
        False,
        f"{laws.attrs.get('explanation', '')}{refused}".strip(),
    )


def _spectrum_table(tree: xr.DataTree) -> Table | None:
    spectrum = group(tree, "spectrum")
    if spectrum is None:
        return None
    columns = [
        _Column("retardation time τ (s)", "retardation_time", _times(1.0)),
        _Column("creep coefficient C (1/GPa)", "creep_coefficient", _times(1e9)),
    ]
    caption = "Retardation spectrum at the reference temperature: 1/E(ω) = 1/E∞ + Σ C/(1 + iωτ)."
    return _table("spectrum", caption, spectrum, columns, is_open=False)


def detail_tables(tree: xr.DataTree) -> list[Table]:
    """Return the full tables that the results afford."""
    found = [
        _prediction_table(tree, "prediction", "prediction", "Friction predicted for each case.", True),
        _measurement_table(tree),
        _prediction_table(
            tree,
            "prediction_master",
            "prediction-master",
            "Friction predicted against the reduced speed, at the reference temperature.",
            False,
        ),
        _shift_factor_table(tree),
        _law_table(tree),
        _spectrum_table(tree),
    ]
    return [table for table in found if table is not None]
