"""The report's tables of friction: predicted, measured, how well both agree, and what friction says of α(T)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.steady import SMALL_STRAIN
from viscofric.report.doubts import EXTRAPOLATED, WIDE, remarks
from viscofric.report.house_style import degrees
from viscofric.report.numbers import ABSENT, percent, signed_percent, significant, with_error
from viscofric.report.results import group, nearest, nominal_temperatures, number, values
from viscofric.report.table import Column, Table, made_table, times, whole

if TYPE_CHECKING:
    import xarray as xr

_MOST_ROWS_AT_A_GLANCE = 12
_DOUBTFUL = (
    f"{WIDE}: reaching beyond {SMALL_STRAIN:g} ball radii from the axis; "
    f"{EXTRAPOLATED}: at frequencies that were not measured"
)
_MEANINGS = (
    "95 %: the band that the uncertainty of the rubber leaves; "
    "front and rear: from the ball's axis to the leading and to the trailing edge of the contact; half-width: across "
    "the motion; energy balance: friction from the pressure less friction from the dissipation, relative; "
    "complementarity: largest violation of the contact conditions, over the indentation; cells: along the longer "
    "edge of the finest grid; products: with the influence matrix, the solver's work."
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
    counted = number(agreement.attrs, "material_counted") == 1.0
    material = "the material's own (sweeps, shift factors, spectrum)"
    return made_table(
        "agreement",
        "Predicted less measured friction, over the measured one, temperature by temperature.",
        agreement,
        [
            Column("temperature", "temperature", degrees),
            Column("points", "points", whole),
            Column("mean", "bias", signed_percent),
            Column("its standard error", "bias_error", percent),
            Column("rms", "rms", percent),
            Column("within 2 standard errors", "share_within_error", lambda share: percent(share, 3)),
            Column("within the scatter", "share_within_scatter", lambda share: percent(share, 3)),
        ],
        note="Standard error: of the measured mean, with the numerical error of the prediction"
        + (f" and {material}" if counted else f"; {material} is not counted")
        + f".{left}",
    )


def prediction_table(tree: xr.DataTree, name: str, key: str, caption: str, is_open: bool) -> Table | None:
    """Every case of a group of predictions: friction, its band and errors, and the size of the contact."""
    prediction = group(tree, name)
    if prediction is None:
        return None
    friction = prediction["friction_coefficient"]
    full = prediction.assign(relative_error=prediction["friction_error"] / abs(friction).where(friction != 0.0))
    table = made_table(
        key,
        caption,
        full,
        [
            Column("temperature", "temperature", degrees),
            Column("speed (mm/s)" if name == "prediction" else "reduced speed (mm/s)", "speed", times(1e3)),
            Column("load (N)", "load", significant),
            Column("friction coefficient", "friction_coefficient", times(1.0)),
            Column("95 % from", "friction_lower", times(1.0)),
            Column("to", "friction_upper", times(1.0)),
            Column("numerical error", "relative_error", percent),
            Column("energy balance", "energy_balance", percent),
            Column("indentation (mm)", "indentation", times(1e3)),
            Column("area (mm²)", "contact_area", times(1e6, 3)),
            Column("front (mm)", "front", times(1e3)),
            Column("rear (mm)", "rear", times(1e3)),
            Column("half-width (mm)", "half_width", times(1e3)),
            Column("largest pressure (MPa)", "max_pressure", times(1e-6)),
            Column("complementarity", "complementarity", times(1.0, 2)),
            Column("cells", "cells", whole),
            Column("products", "products", whole),
        ],
        is_open,
        _MEANINGS,
    )
    return _with_remarks(table, remarks(tree, prediction))


def measurement_table(tree: xr.DataTree) -> Table | None:
    """Every measured point beside its prediction."""
    measurement = group(tree, "measurement")
    if measurement is None:
        return None
    full = measurement.assign(difference=measurement["predicted"] / measurement["viscoelastic"] - 1.0)
    table = made_table(
        "measured-and-predicted",
        "Measured and predicted friction coefficients (scatter: standard deviation over the repetitions; "
        "standard error: of their mean).",
        full,
        [
            Column("temperature", "temperature", degrees),
            Column("speed (mm/s)", "speed", times(1e3)),
            Column("reduced speed (mm/s)", "reduced_speed", times(1e3)),
            Column("load (N)", "load", times(1.0)),
            Column("repetitions", "replicates", whole),
            Column("viscoelastic, measured", "viscoelastic", times(1.0)),
            Column("scatter", "viscoelastic_scatter", times(1.0, 2)),
            Column("standard error", "viscoelastic_error", times(1.0, 2)),
            Column("predicted", "predicted", times(1.0)),
            Column("95 % from", "predicted_lower", times(1.0)),
            Column("to", "predicted_upper", times(1.0)),
            Column("numerical error", "predicted_error", times(1.0, 2)),
            Column("predicted less measured", "difference", signed_percent),
        ],
    )
    for heading, name in (("Coulomb, measured", "coulomb"), ("left over (consistency)", "consistency")):
        if name in measurement.variables:
            table.headings.append(heading)
            pairs = zip(values(measurement, name), values(measurement, f"{name}_error"), strict=True)
            for row, (value, error) in zip(table.rows, pairs, strict=True):
                row.append(with_error(float(value), float(error)))
    return _with_remarks(table, remarks(tree, measurement))


def friction_shift_table(tree: xr.DataTree) -> Table | None:
    """Shift factors from friction beside those of the modulus."""
    found = group(tree, "friction_shift_factors")
    if found is None:
        return None
    columns = [
        Column("temperature", "temperature", degrees),
        Column("log₁₀ α from friction", "log10_shift_factor", times(1.0)),
        Column("standard error", "standard_error", times(1.0, 2)),
        Column("log₁₀ α of the modulus", "known_log10_shift_factor", times(1.0)),
        Column("its standard error", "known_standard_error", times(1.0, 2)),
        Column("difference", "difference", times(1.0, 2)),
    ]
    full = found.assign(difference=found["log10_shift_factor"] - found["known_log10_shift_factor"])
    at = degrees(number(found.attrs, "reference_temperature"))
    caption = f"Shift factors from friction alone beside those of the modulus, 1 at {at}."
    return made_table("friction-shift-factors", caption, full, columns, is_open=False)
