"""The report's tables of friction: predicted, measured, their agreement, and shift factors from friction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import chain

import numpy as np

from viscofric.contact.solution import ERRORS
from viscofric.contact.steady import SMALL_STRAIN
from viscofric.datasets import Dataset, DataTree
from viscofric.report.results import (
    EXTRAPOLATED,
    WIDE,
    group,
    interpolated,
    nearest,
    nominal_temperatures,
    number,
    on_group,
    remarks,
    rubbers,
    shown_error,
    values,
)
from viscofric.report.sweeps import (
    SAMPLE,
    SEED,
    axis_of,
    band_of_samples,
    best_estimate,
    cases_of,
    over_seeds,
    solved_cases,
    thinned,
    value_label,
    words_of_band,
)
from viscofric.report.texts.motion import largest_friction
from viscofric.report.texts.numbers import (
    ABSENT,
    degrees,
    length,
    percent,
    several,
    signed_percent,
    significant,
    with_error,
)
from viscofric.report.texts.tables import (
    Column,
    Table,
    law_table,
    logarithm,
    made_table,
    number_column,
    shift_factor_table,
    spectrum_table,
    times,
    whole,
)
from viscofric.study.cases.sweep import COORDINATES, VARIED

_MOST_ROWS, _MOST_COLUMNS = 12, 8  # of the table at a glance
# Rows of a table beyond which the results alone hold the others.
_LONGEST = 1_000
_DOUBTFUL = {
    WIDE: f"extends beyond {SMALL_STRAIN:g} of the indenter's radius from its axis",
    EXTRAPOLATED: "depends on frequencies that were not measured",
}
_BAND = "95 %: confidence band from the uncertainty of the material"
_MEANS = (
    "Means over the seeds of the surface, of which the results have each; 95 %: confidence interval of the mean "
    "friction (Student's t); errors, energy balance and complementarity are the largest of the seeds"
)
_AFTER = "after ±: numerical error, where it exceeds 1 %"
# Numbers of a case that other columns show, or its remarks.
_SHOWN_ELSEWHERE = {"friction_coefficient", "friction_lower", "friction_upper", "energy_balance", "seeds"} | {
    *("failed", "interpolated", "within_measured_frequencies")
}


def _with_remarks(table: Table, doubts: Sequence[tuple[str, ...]]) -> Table:
    """Add a column that says what is doubtful about a row, if anything is about any."""
    if not any(doubts):
        return table
    rows = [[*row, "; ".join(doubt)] for row, doubt in zip(table.rows, doubts, strict=True)]
    note = " ".join([table.note, *(f"{meaning}." for meaning in [_meaning(*chain(*doubts))] if meaning)]).strip()
    return replace(table, headings=[*table.headings, "remark"], rows=rows, note=note)


def friction_at_a_glance(tree: DataTree) -> Table | None:
    """Predicted friction in one look: over speed and temperature, or its highest value for all else that varies."""
    prediction = solved_cases(tree)
    if prediction is None:
        return None
    seeds = SEED in prediction and len(np.unique(prediction[SEED].values)) > 1
    prediction = over_seeds(prediction)
    others = [name for name in VARIED if name in prediction and len(np.unique(prediction[name].values)) > 1]
    labels = [[value_label(prediction, name, value) for value in prediction[name].values] for name in others]
    kind = list(zip(*labels, strict=True)) if others else [()] * prediction.sizes["case"]
    temperatures = nominal_temperatures(values(prediction, "temperature")).size
    if others and len(set(kind)) * temperatures > _MOST_COLUMNS:
        found = _highest_friction(tree, prediction, others, kind)
    else:
        found = _friction_grid(tree, prediction, kind)
    friction, error = (values(prediction, name) for name in ("friction_coefficient", "friction_error"))
    said = [_OF_SEEDS] if seeds else []
    said += [_WITH_ERROR] if np.isfinite(shown_error(friction, error)).any() else []
    return replace(found, note=" ".join([*said, found.note]).strip())


_OF_SEEDS = "Mean over the seeds of the surface, with half its 95 % confidence interval (Student's t)."
_WITH_ERROR = "The number after ± contains the estimated numerical error, where that exceeds 1 %."


def _friction_grid(tree: DataTree, prediction: Dataset, kind: Sequence[tuple[str, ...]]) -> Table:
    """Return a row for each speed, and a column for each temperature and all else that varies."""
    speed, friction = values(prediction, "speed"), values(prediction, "friction_coefficient")
    nominal = nominal_temperatures(values(prediction, "temperature"))
    kelvin = nominal[nearest(nominal, values(prediction, "temperature"))]
    of_case = [", ".join((*other, degrees(float(at)))) for other, at in zip(kind, kelvin, strict=True)]
    columns = list(dict.fromkeys(of_case))
    shown = [columns[place] for place in thinned(len(columns), _MOST_COLUMNS)]
    speeds = np.unique(speed)
    every = int(np.ceil(speeds.size / _MOST_ROWS))
    doubts = remarks(tree, prediction)
    cells: dict[tuple[float, str], str] = {}
    for row, column in enumerate(of_case):
        mark = " *" if doubts[row] else ""
        cells.setdefault((float(speed[row]), column), _mean(prediction, row, float(friction[row])) + mark)
    rows = [
        [significant(1e3 * float(at), 4), *(cells.get((float(at), column), ABSENT) for column in shown)]
        for at in speeds[::every]
    ]
    some = [f"one speed in {every}"] if every > 1 else []
    some += [f"{len(shown)} of {len(columns)} temperatures"] if len(shown) < len(columns) else []
    more = f" Shown: {several(some)}; more of them are in the tables below." if some else ""
    caption = f"Predicted viscoelastic friction coefficient.{more}"
    return _at_a_glance(caption, ["speed (mm/s)", *map(_together, shown)], rows, doubts)


def _at_a_glance(caption: str, headings: list[str], rows: list[list[str]], doubts: list[tuple[str, ...]]) -> Table:
    marked = any(cell.endswith("*") for row in rows for cell in row)
    note = f"* {_meaning(*chain(*doubts))}." if marked else ""
    return Table("at-a-glance", caption, headings, rows, note=note)


def _mean(cases: Dataset, row: int, friction: float) -> str:
    """Return friction with its numerical error where that can be seen, and half the interval of a mean over seeds."""
    error = float(np.nan_to_num(shown_error(np.array(friction), values(cases, "friction_error")[row])))
    if "seeds" in cases:
        half = 0.5 * (values(cases, "friction_upper")[row] - values(cases, "friction_lower")[row])
        return with_error(friction, math.hypot(half, error))
    return with_error(friction, error) if error else significant(friction, 3)


def _highest_friction(
    tree: DataTree, prediction: Dataset, others: Sequence[str], kind: Sequence[tuple[str, ...]]
) -> Table:
    """Return a row for each combination of all else that varies: its highest friction, and where that lies."""
    friction, doubts = values(prediction, "friction_coefficient"), remarks(tree, prediction)
    rows = []
    for combination in dict.fromkeys(kind):
        cases = [row for row, other in enumerate(kind) if other == combination]
        top = max(cases, key=lambda row: friction[row])
        mark = " *" if doubts[top] else ""
        where = [value_label(prediction, name, prediction[name].values[top]) for name in ("temperature", "speed")]
        lowest = significant(float(friction[cases].min()), 3)
        rows.append([*map(_together, combination), _mean(prediction, top, float(friction[top])) + mark, *where, lowest])
    shown = [rows[place] for place in thinned(len(rows), 2 * _MOST_ROWS)]
    some = f" Shown: {len(shown)} of {len(rows)} combinations." if len(shown) < len(rows) else ""
    varied = [name.replace("_", " ") for name in others]
    headings = [*varied, "highest friction", "at temperature", "and speed", "lowest friction"]
    return _at_a_glance(f"Highest predicted viscoelastic friction coefficient.{some}", headings, shown, doubts)


def _together(label: str) -> str:
    """Keep numbers and their units on one line."""
    return ", ".join(part.replace(" ", "\N{NO-BREAK SPACE}") for part in label.split(", "))


def _meaning(*doubts: str) -> str:
    """Say what the marks of doubtful cells stand for, those that there are."""
    return "; ".join(f"{doubt}: {meaning}" for doubt, meaning in _DOUBTFUL.items() if doubt in doubts)


@on_group("agreement")
def agreement_table(agreement: Dataset, _: DataTree) -> Table | None:
    """Prediction against measurement, temperature by temperature."""
    left_out = number(agreement.attrs, "left_out")
    left = ""
    if left_out > 0:
        points = "1 measured point is" if left_out == 1 else f"{left_out:.0f} measured points are"
        left = f" {points} left out: without a prediction, or with friction not above zero."
    counted = number(agreement.attrs, "material_counted") == 1.0
    numerical = "the numerical error of the prediction"
    material = "the uncertainty of the material (sweeps, shift factors, spectrum)"
    return made_table(
        "agreement",
        "Predicted minus measured friction, relative to the measured one, by temperature.",
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
        note="Standard error: includes that of the measured mean"
        + (f", {numerical}, and {material}" if counted else f" and {numerical}, but not {material}")
        + f".{left}",
    )


def prediction_table(tree: DataTree, name: str, key: str, caption: str, is_open: bool) -> Table | None:
    """Every case of a group of predictions: friction, its band and errors, and the size of the contact."""
    prediction = group(tree, name)
    if prediction is None:
        return None
    prediction = over_seeds(cases_of(prediction))
    friction, error = (values(prediction, part) for part in ("friction_coefficient", "friction_error"))
    full = prediction.assign(relative_error=("case", error / np.where(friction == 0.0, np.nan, np.abs(friction))))
    errors = {number: error for number, error in ERRORS.items() if number in full and error in full}
    shown = {error: ("case", shown_error(values(full, of), values(full, error))) for of, error in errors.items()}
    full = full.assign(shown)
    between = interpolated(full)
    for work in ("cells", "products"):  # what was not solved took none
        if work in full:
            full[work] = full[work].copy(data=np.where(between, np.nan, values(full, work)))
    load = str(full["load"].attrs.get("units", "N")) if "load" in full else "N"
    names = [
        str(name)
        for name, one in full.data_vars.items()
        if not (name in (*_SHOWN_ELSEWHERE, *COORDINATES) or str(name).endswith("_error")) and np.isfinite(one).any()
    ]
    numbers = [number_column(full, name) for name in names]
    told = {name.replace("_", " "): str(full[name].attrs.get("long_name", name)) for name in names}
    said = [_MEANS] if "seeds" in full else [_BAND] if "friction_lower" in full else []
    said += [_AFTER] if any(np.isfinite(error).any() for _, error in shown.values()) else []
    meanings = [f"{spoken}: {words}" for spoken, words in told.items() if words.replace("_", " ") != spoken]
    table = made_table(
        key,
        caption,
        full,
        [
            *_varied_columns(full),
            Column("temperature", "temperature", degrees),
            Column("speed (mm/s)" if name == "prediction" else "reduced speed (mm/s)", "speed", times(1e3)),
            Column(f"load ({load})", "load", significant),
            number_column(full, "friction_coefficient"),
            Column("95 % from", "friction_lower", times(1.0)),
            Column("to", "friction_upper", times(1.0)),
            Column("seeds", "seeds", whole),
            Column("numerical error", "relative_error", percent),
            Column("energy balance", "energy_balance", percent),
            *numbers,
        ],
        is_open,
        "; ".join([*said, *meanings]) + ".",
    )
    failed = values(full, "failed") == 1.0
    doubts = [
        (*(["not solved"] if failed[row] else []), *(["interpolated"] if between[row] else []), *doubt)
        for row, doubt in enumerate(remarks(tree, full))
    ]
    return _with_remarks(table, doubts)


def _varied_columns(cases: Dataset) -> list[Column]:
    """Return columns of the other quantities that vary; names of rubbers stand before them."""
    return [
        Column(name.replace("_", " "), name, partial(value_label, cases, name))
        for name in VARIED
        if name != "load" and name in cases and len(np.unique(cases[name].values)) > 1
    ]


@on_group("measurement")
def measurement_table(measurement: Dataset, tree: DataTree) -> Table | None:
    """Every measured point with its prediction."""
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
            Column("predicted minus measured", "difference", signed_percent),
        ],
    )
    for heading, name in (("Coulomb, measured", "coulomb"), ("residual", "consistency")):
        if name in measurement.variables:
            table.headings.append(heading)
            pairs = zip(values(measurement, name), values(measurement, f"{name}_error"), strict=True)
            for row, (value, error) in zip(table.rows, pairs, strict=True):
                row.append(with_error(float(value), float(error)))
    return _with_remarks(table, remarks(tree, measurement))


@on_group("friction_shift_factors")
def friction_shift_table(found: Dataset, _: DataTree) -> Table | None:
    """Shift factors from friction and from the modulus."""
    columns = [
        Column("temperature", "temperature", degrees),
        Column("log₁₀ α from friction", "log10_shift_factor", logarithm, "standard_error"),
        Column("log₁₀ α of the modulus", "known_log10_shift_factor", logarithm, "known_standard_error"),
        Column("difference", "difference", logarithm),
    ]
    full = found.assign(difference=found["log10_shift_factor"] - found["known_log10_shift_factor"])
    at = degrees(number(found.attrs, "reference_temperature"))
    caption = f"Shift factors from friction alone and from the modulus, 1 at {at}."
    return made_table("friction-shift-factors", caption, full, columns, is_open=False)


@on_group("history")
def start_table(data: Dataset, _: DataTree) -> Table | None:
    """Return the largest friction of each contact over time, with its time and distance, and that at the end."""
    if not np.nan_to_num(values(data, "friction_coefficient")).any():
        return None
    along = [str(name) for name in data["friction_coefficient"].dims if name not in (SAMPLE, "instant")]
    axes, rows = [axis_of(data, name) for name in along], []
    for place in np.ndindex(*map(len, axes)):
        case = data.isel(dict(zip(along, place, strict=True)))
        best = best_estimate(case)
        friction, load = values(best, "friction_coefficient"), values(best, "load_over_time")
        if not np.isfinite(friction).all():
            continue
        error = values(best, "friction_force_error") / np.where(load > 0.0, load, np.inf)
        position = np.stack([values(best, "position_x"), values(best, "position_y")], axis=1)
        largest, after, way = largest_friction(friction, error, values(best, "time"), position)
        row = [axis.labels[number] for axis, number in zip(axes, place, strict=True)] + [largest]
        if SAMPLE in case.dims:
            each = np.abs(case["friction_coefficient"].transpose(SAMPLE, ...).values).max(axis=1)
            row += [significant(float(end)) for end in band_of_samples(each)]
        rows.append([*row, after, length(way), with_error(float(friction[-1]), float(error[-1]))])
    band = [f"{words_of_band(data, 'friction_coefficient')} from", "to"] if SAMPLE in data.dims else []
    headings = [*(axis.title for axis in axes), "largest friction", *band, "after", "after sliding", "at the end"]
    caption = "Largest viscoelastic friction coefficient of each contact over time, of the times in the results."
    said = "After ±: errors of the numerical solution, of the largest friction also by what lies between the times."
    return Table("starts", caption, headings, rows, note=said) if rows else None


def detail_tables(tree: DataTree) -> list[Table]:
    """Return the full tables that the results afford."""
    found = [
        prediction_table(tree, "prediction", "prediction", "Friction predicted for each case.", True),
        start_table(tree),
        measurement_table(tree),
        *_master_and_rubber(tree),
    ]
    for place, (rubber, branch) in enumerate(rubbers(tree), 1):
        found += [
            replace(table, key=f"{table.key}-{place}", caption=f"{rubber}. {table.caption}")
            for table in _master_and_rubber(branch)
            if table is not None
        ]
    return [_within_reach(table) for table in found if table is not None]


def _within_reach(table: Table) -> Table:
    """Return a table without the rows that only a browser of much memory would show."""
    left_out = len(table.rows) - _LONGEST
    if left_out <= 0:
        return table
    note = f"{table.note} All rows are in results.nc, which viscofric export writes as CSV or Excel.".strip()
    return replace(table, rows=table.rows[:_LONGEST], note=note, left_out=left_out)


def _master_and_rubber(tree: DataTree) -> list[Table | None]:
    caption = "Friction predicted against the reduced speed, at the reference temperature."
    return [
        prediction_table(tree, "prediction_master", "prediction-master", caption, False),
        friction_shift_table(tree),
        shift_factor_table(tree),
        None if (laws := group(tree, "laws")) is None else law_table(laws),
        spectrum_table(tree),
    ]
