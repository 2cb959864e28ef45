"""Friction curves in files: those that viscofric saves, and tables of coefficients from any other tribometer."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from os import PathLike

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError, short_notes
from viscofric.files import file_path, marked, says_synthetic, write_atomically
from viscofric.friction.curve_checks import CLEAR_OF_ZERO
from viscofric.friction.curve_words import COLUMNS, CURVES, DIRECTIONS, OF_DIRECTIONS
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.notes import Note, dumped, note_of
from viscofric.readers.dma.names import FROM_TITLES, insist_on_one_specimen, joined_tables, temperatures_of_titles
from viscofric.readers.headings import OF_HEADINGS, Column, quantity_of
from viscofric.readers.mtm.delimited import AS_RUNS, TRACTION
from viscofric.readers.one_table import insist_on_columns, table_of
from viscofric.readers.source import Source, bytes_of, is_revolutions, to_rad_per_second
from viscofric.readers.table import Table
from viscofric.readers.tables import find_tables
from viscofric.readers.workbook import is_workbook
from viscofric.traction import notes_on_copies, notes_on_friction
from viscofric.units import CELSIUS_ZERO

_TITLE = "viscofric friction curves"
_REMARKS = ("source", "assumption", "note")

_ABOVE_ZERO = {
    "speed": "must be above zero; give the mean friction of both directions of motion in one row",
    "temperature": "must be above absolute zero",
    "load": "must be above zero",
}
#: Fields that are infinite where not known, an empty cell in the file.
_OPEN = ("_error", "_scatter", "_freedom")
_MOST_REPLICATES = 1e9
#: Codes of errors about headings of coefficients of friction that state conditions.
_OF_HEADINGS = ("two-values", "number-without-unit", "dash-or-minus", "quantity-unknown")
#: Larger numbers under headings such as "5 N" are not taken for coefficients of friction.
_LARGEST_UNNAMED = 2.0
#: Sliding friction below zero by more than this part of the largest, and than its error, is of the other direction.
_LEAST_BACKWARDS = 0.1
#: Heading of coefficients computed here, and its beginning.
_OF_FORCES = "friction force over load"
#: As results of studies name viscoelastic friction.
_OF_RESULTS = "friction_coefficient"


def write_friction_curves(curves: FrictionCurves, path: str | PathLike[str]) -> None:
    """Write friction curves so that `read_friction_curves` returns the same ones, to the last digit.

    Parameters
    ----------
    curves : FrictionCurves
        What to write; cells of infinite standard errors, scatter and degrees of freedom stay empty.
    path : str or path
        Text table with commas, UTF-8, units in its headings; a file that is there is overwritten.

    Raises
    ------
    InputError
        If there is nothing to write.
    DataFileError
        If the file cannot be written.

    Examples
    --------
    >>> import viscofric as vf
    >>> columns = {"speed": [0.02, 0.06, 0.2], "temperature": [333.15] * 3, "load": [25.0] * 3, "replicates": [9] * 3}
    >>> columns |= {"viscoelastic": [0.025, 0.020, 0.016], "viscoelastic_error": [2e-4] * 3}
    >>> curves = vf.FrictionCurves(**columns, viscoelastic_scatter=[6e-4] * 3)
    >>> vf.write_friction_curves(curves, "curves.csv")
    >>> bool((vf.read_friction_curves("curves.csv").speed == curves.speed).all())
    True
    """
    target = file_path(path)
    if not len(insist_on_curves(curves, "curves")):
        raise InputError("friction curves without an entry make no file.", code="empty-list")
    text = io.StringIO()
    remarks = [("source", curves.source), ("assumption", curves.assumption)]
    remarks += [("note", dumped(one.record()) if one.code else one) for one in map(note_of, curves.notes)]
    text.write(f"# {_TITLE}\n")
    text.writelines(f"# {name}: {' '.join(words.split())}\n" for name, words in remarks if words.strip())
    columns = {}
    for name, (unit, heading, _) in COLUMNS.items():
        values = getattr(curves, name)
        if values is None:
            continue
        shown = curves.load_unit if name == "load" else unit
        if name == "temperature" and np.all((values - CELSIUS_ZERO) + CELSIUS_ZERO == values):  # exact in °C
            values, shown = values - CELSIUS_ZERO, "degC"
        columns[f"{heading} ({shown})" if shown else heading] = [_cell(value) for value in values.tolist()]
    table = csv.writer(text, lineterminator="\n")
    table.writerow(columns)
    table.writerows(zip(*columns.values(), strict=True))
    write_atomically(target, text.getvalue().encode("utf-8"))


def read_friction_curves(
    path: str | PathLike[str], *, columns: Mapping[str, str] | None = None, sheet: str | None = None
) -> FrictionCurves:
    """Read a table of friction coefficients, one row per speed and temperature.

    Parameters
    ----------
    path : str or path
        What `write_friction_curves` or `viscofric export` wrote; or a table, text or workbook, with the columns
        ``speed``, ``temperature``, ``load`` and ``viscoelastic friction``, and optionally ``viscoelastic friction
        standard error``, ``… scatter``, ``… degrees of freedom``, ``replicates``, ``Coulomb friction``, its standard
        error, scatter and degrees of freedom, and ``slip``.  A ``friction force`` without a coefficient is divided by
        the load.  Units stand in the headings, such as ``speed (mm/s)``; coefficients have none, or are in ``%``.  The
        load of a line contact is in N/m.  Temperature, load or speed without a column may stand in the headings of
        curves beside each other, such as ``viscoelastic friction 25 °C`` or ``COF 5 N``, or above tables.
        ``frequency`` and ``stroke`` of a motion to and fro give its mean speed, 2 · frequency · stroke, where there is
        none.  Of both directions, in columns ``COF forward`` and ``COF backward``, or in rows that a column
        ``direction`` tells apart, the mean magnitude is read, with a note.
    columns : mapping, optional
        Headings that are not understood, by quantity: ``{"viscoelastic_friction": "mu_v", "speed": "v1 (mm/s)"}``.  A
        unit in brackets counts instead of that of the file; ``"#3 (N)"`` is the third column, ``"= 20 N"`` a value of
        all rows.
    sheet : str, optional
        The only sheet of a workbook to read.

    Returns
    -------
    FrictionCurves
        Without a standard error it is the scatter over the square root of the number of replicates, and without both
        it is not known and infinite, with a note; without a number of replicates it is one.

    Raises
    ------
    DataFileError
        If the file cannot be read, a column or its unit is missing or wrong, or a cell is not a number, or not one
        that such a quantity may have.

    Examples
    --------
    >>> import viscofric as vf
    >>> columns = {"speed": [0.02, 0.06, 0.2], "temperature": [333.15] * 3, "load": [25.0] * 3, "replicates": [9] * 3}
    >>> columns |= {"viscoelastic": [0.025, 0.020, 0.016], "viscoelastic_error": [2e-4] * 3}
    >>> curves = vf.FrictionCurves(**columns, viscoelastic_scatter=[6e-4] * 3)
    >>> vf.write_friction_curves(curves, "curves.csv")
    >>> again = vf.read_friction_curves("curves.csv")
    >>> again.viscoelastic
    array([0.025, 0.02 , 0.016])
    """
    table = table_of(path, CURVES, columns, sheet)
    if _is_of_runs(table):
        problem = "this is a table of traction runs, whose friction is not separated yet"
        raise DataFileError(str(path), problem, code="traction-runs", remedy=AS_RUNS)
    table, notes = _with_temperatures(table)
    table, sides = _with_both_directions(table, notes)
    table = _with_speeds(_with_coefficients(table), notes)
    places = _places(table)
    unit = table.load_unit(places["load"])
    _insist_on_absolute_errors(table, places)
    found = {name: _read_column(table, name, place, unit) for name, place in places.items()}
    with np.errstate(divide="ignore", invalid="ignore"):
        at = [np.log(found[name]) for name in ("speed", "temperature", "load")]  # to 1 %, which is 3 K
    insist_on_one_specimen(table, np.round(np.stack(at, axis=1), 2), "speed, temperature and load")
    found = _paired(table, found, np.stack(at, axis=1), notes)
    remarks = _remarks(str(path))
    notes = [*remarks["note"], *table.heading_notes, *notes]
    if table.columns[places["viscoelastic"]].alone and np.max(np.abs(found["viscoelastic"])) > _LARGEST_UNNAMED:
        problem = f"column {table.columns[places['viscoelastic']].heading!r} and those beside it name no quantity, and "
        right = f"one is above {_LARGEST_UNNAMED:g}, as forces may be; if they are coefficients, write 'COF 5 N'."
        raise table.refused("quantity-unknown", problem + right)
    if _is_any_friction(column := table.columns[places["viscoelastic"]]):
        said = f"Column {column.heading!r} was read as viscoelastic friction; friction measured in sliding includes "
        notes.append(Note("total-friction", said + "Coulomb friction, which must be subtracted first."))
        friction, scatter = found["viscoelastic"], found.get("viscoelastic_error", np.inf)
        beyond = np.where(np.isfinite(scatter), CLEAR_OF_ZERO * scatter, 0.0)
        if np.any(-friction > np.maximum(beyond, _LEAST_BACKWARDS * np.max(np.abs(friction)))):
            problem = f"column {column.heading!r} has values below zero, as of motion in the other direction; give "
            raise table.refused("both-directions", problem + "the mean magnitude of both directions in one row.")
    radius = table.place("track radius") if is_revolutions(table.columns[places["speed"]].unit) else None
    force = table.place("friction force") if column.heading.startswith(_OF_FORCES) else None
    moved = [table.place(what) for what in _OF_STROKES if table.columns[places["speed"]].heading == _STROKES]
    moved += [table.place("direction")] * (len(found["speed"]) < len(table.rows))
    unused = [column.heading for column in table.unused([*places.values(), radius, force, *moved, *sides])]
    if unused:
        said = f"Columns of the file of friction curves that are not read: {', '.join(map(repr, unused))}."
        notes.append(Note("unused-columns", said, values={"headings": unused}))
    replicates = found.pop("replicates", np.ones(len(found["speed"])))
    for kind in ("viscoelastic", "coulomb"):
        _complete(found, kind, replicates, notes)
    coefficients = [found[name] for name in ("viscoelastic", "coulomb") if name in found]
    doubts = notes_on_friction(coefficients, found["temperature"], found["speed"])
    doubts += notes_on_copies(coefficients[0], *(column for column in found.values() if column is not coefficients[0]))
    try:
        return FrictionCurves(
            replicates=replicates.astype(np.int64),
            source=marked((remarks["source"] or [str(path)])[0], synthetic=says_synthetic(path)),
            assumption=(remarks["assumption"] or [""])[0],
            notes=(*short_notes(note for note in notes if note not in doubts), *doubts),
            load_unit=unit,
            **found,
        )
    except InputError as error:
        raise DataFileError(path, f"contains no friction curves: {error}", code="not-friction-curves") from None


def holds_friction_curves(path: str | PathLike[str], columns: Mapping[str, str] | None = None) -> bool:
    """Return whether a file has a column of friction, not of a tribometer's runs; False if unreadable."""
    # So has one of which `columns` names the friction.
    if any(quantity_of(name) in ("viscoelastic friction", "friction force") for name in columns or {}):
        return True
    try:
        tables = find_tables(Source(str(path), bytes_of(str(path))), CURVES).values()
    except DataFileError as error:
        return error.code in _OF_HEADINGS
    held = [table for table in tables if not _is_of_runs(table)]
    return any(
        table.has("viscoelastic friction")
        or table.has("viscoelastic friction forward")
        or (table.has("speed") and (table.has("friction force") or table.has("friction force forward")))
        for table in held
    )


def _is_any_friction(column: Column) -> bool:
    """Return whether a heading states a coefficient of friction, but not that it is viscoelastic."""
    return not (column.given or "viscoelastic" in column.name.lower() or column.heading.startswith(_OF_RESULTS))


def _is_of_runs(table: Table) -> bool:
    """Return whether a table has friction of any origin beside the two speeds of a tribometer with slip."""
    friction = [column for column in table.columns if column.quantity in ("viscoelastic friction", "friction force")]
    held = {TRACTION.quantity(column.name) for column in table.columns if not column.given}
    return not held.isdisjoint(("rolling speed", "ball speed")) and any(map(_is_any_friction, friction))


def _cell(value: float) -> str:
    return repr(value) if math.isfinite(value) else ""


def _with_temperatures(table: Table) -> tuple[Table, list[str]]:
    """Return the table with a column of the temperatures that its headings or titles state, and a note on it."""
    kelvin = None if table.has("temperature") else temperatures_of_titles(table)
    if kelvin is not None:
        column = Column("temperatures of headings or titles", "temperature", "K", "temperature")
        return table.with_column(column, [repr(value) for value in kelvin.tolist()]), [
            FROM_TITLES,
            *joined_tables(table),
        ]
    if any(column.heading == OF_HEADINGS["temperature"] for column in table.columns):
        return table, [*joined_tables(table)]
    if joined_tables(table):
        problem = "holds several tables below or beside each other, which may differ in more than temperature; "
        raise DataFileError(table.path, problem + "give each a file of its own.", code="several-tables")
    return table, []


def _with_coefficients(table: Table) -> Table:
    """Return the table with a column of friction forces over loads, where it has no coefficients."""
    force, load = table.place("friction force"), table.place("load")
    if table.has("viscoelastic friction") or force is None or load is None:
        return table
    unit = table.load_unit(load)
    with np.errstate(divide="ignore", invalid="ignore"):
        coefficients = table.values(force, unit) / _read_column(table, "load", load, unit)
    heading = f"{_OF_FORCES}: {table.columns[force].heading} / {table.columns[load].heading}"
    column = Column(heading, _OF_FORCES, "", "viscoelastic friction")
    return table.with_column(column, [repr(value) for value in coefficients.tolist()])


def _with_both_directions(table: Table, notes: list[str]) -> tuple[Table, list[int]]:
    """Return the table with the mean magnitude of columns of both directions, add a note, and return their places."""
    for what in OF_DIRECTIONS:
        places = [table.place(f"{what} {direction}") for direction in DIRECTIONS]
        if table.has(what) or places == [None, None]:
            continue
        lacking = [f"{what} {name}" for name, place in zip(DIRECTIONS, places, strict=True) if place is None]
        if lacking:
            raise table.lacking(lacking)
        both = [place for place in places if place is not None]
        unit = table.load_unit(both[0]) if what == "friction force" else ""
        means = _mean_magnitudes([table.values(place, unit) for place in both], notes)
        first, second = (table.columns[place] for place in both)
        column = Column(f"mean of {first.heading!r} and {second.heading!r}", first.name, unit, what)
        return table.with_column(column, [repr(value) for value in means.tolist()]), both
    return table, []


def _mean_magnitudes(friction: Sequence[Array], notes: list[str]) -> Array:
    """Return the mean magnitude of friction in both directions, each of one sign but for noise, and add a note."""
    forward, backward = (math.copysign(1.0, float(values.sum())) * values for values in friction)
    means = 0.5 * (forward + backward)
    offset = float(np.max(0.5 * np.abs(forward - backward)) / max(float(np.max(means)), np.finfo(float).tiny))
    said = (
        f"Friction is the mean magnitude of both directions of motion; half of their difference, up to {offset:.2g} of "
        "the largest friction, is an offset of the force."
    )
    notes.append(Note("both-directions-averaged", said, values={"pairs": means.size, "offset": offset}))
    return np.asarray(means)


#: Speeds and loads, temperatures are those of one point where they differ by less, of their logarithms.
_SAME_POINT = (0.03, 0.003, 0.03)


def _paired(table: Table, found: dict[str, Array], logarithms: Array, notes: list[str]) -> dict[str, Array]:
    """Return the columns with rows of both directions joined, where a column tells them; `logarithms` are (n, 3)."""
    place = table.place("direction")
    labels = [] if place is None else [row[place].strip().lower() for row in table.rows]
    forward, back = (np.flatnonzero([label in words for label in labels]) for words in DIRECTIONS.values())
    if place is None or not (forward.size and back.size):
        return found
    known = np.isin(np.arange(len(labels)), [*forward, *back])
    table.insist(known, place, "'forward' or 'backward', '+' or '-', or 1 or 2", "out-of-range")
    at, lone, partners = logarithms / _SAME_POINT, [], []
    for row in forward:
        near = np.flatnonzero(np.all(np.abs(at[back] - at[row]) <= 1.0, axis=1))[:1]
        lone += [row] * (not near.size)
        partners += [(row, one) for one in back[near]]
        back = np.delete(back, near)
    if lone := [*lone, *back]:
        problem = f"direction {table.rows[lone[0]][place].strip()!r} has no row of the other direction at its speed, "
        right = "temperature and load; add it, or remove this row."
        raise DataFileError(table.path, problem + right, int(table.lines[lone[0]]), code="no-partner")
    joined = {}
    for name, values in found.items():
        pair = values[np.array(partners).T]
        if name == "viscoelastic":
            joined[name] = _mean_magnitudes(pair, notes)
        elif name.endswith(("_error", "_scatter")):  # of two directions that err independently
            joined[name] = 0.5 * np.hypot(*pair)
        else:
            joined[name] = pair.min(axis=0) if name.endswith(("freedom", "replicates")) else pair.mean(axis=0)
    return joined


#: Heading of the column of speeds, and the quantities that gave them.
_STROKES, _OF_STROKES = "speeds of strokes", ("frequency", "stroke")


def _with_speeds(table: Table, notes: list[str]) -> Table:
    """Return the table with the mean speed of a motion to and fro where it has frequency and stroke, and add a note."""
    frequency, stroke = (None if table.has("speed") else table.place(what) for what in _OF_STROKES)
    if stroke is None:
        return table
    if frequency is None:
        raise table.lacking(["speed", "frequency"])
    angular = to_rad_per_second(table.columns[frequency].unit, angular=False)
    if angular is None:
        raise table.refused("wrong-unit", f"column {table.columns[frequency].heading!r} must be in 'Hz'.")
    speeds = angular / math.pi * table.numbers(frequency) * table.values(stroke, "m")
    said = (
        "Speeds are means over a stroke, 2 · frequency · stroke; at the middle of a sinusoidal one it is π/2 of that."
    )
    notes.append(Note("speed-of-stroke", said))
    return table.with_column(Column(_STROKES, "speed", "m/s", "speed"), [repr(value) for value in speeds.tolist()])


def _places(table: Table) -> dict[str, int]:
    """Return the index of each column; raise an error if a required one is missing."""
    found = {name: table.place(heading.lower()) for name, (_, heading, _) in COLUMNS.items()}
    insist_on_columns(table, CURVES)
    return {name: place for name, place in found.items() if place is not None}


def _insist_on_absolute_errors(table: Table, places: dict[str, int]) -> None:
    """Raise an error where an error in per cent may be one of the value, or of a friction coefficient of 1."""
    for name, place in places.items():
        value, _, kind = name.rpartition("_")
        own, of = table.columns[place], table.columns[places.get(value, place)]
        if kind in ("error", "scatter") and own.unit == "%" != of.unit:
            problem = (
                f"column {own.heading!r} is in per cent, perhaps relative, and {of.heading!r} is not; give both alike."
            )
            raise table.refused("wrong-unit", problem)


def _read_column(table: Table, name: str, place: int, load_unit: str) -> Array:
    unit = load_unit if name == "load" else COLUMNS[name][0]
    column = table.columns[place]
    values = table.values(place, unit, or_missing=name.endswith(_OPEN))
    if name in ("speed", "temperature", "load"):
        bad, right = values <= 0.0, _ABOVE_ZERO[name]
    elif name == "replicates":
        bad = (values < 1.0) | (values != np.round(values)) | (values > _MOST_REPLICATES)
        right = "must be a whole number above zero"
    elif name.endswith(_OPEN):
        bad, right = values < 0.0, "must be zero or above, or the cell empty where it is not known"
        values = np.where(np.isnan(values), np.inf, values)
    else:
        bad, right = np.full(values.size, False), ""
    if np.any(bad):
        row = int(np.argmax(bad))
        problem = f"{table.rows[row][place].strip()!r} in column {column.heading!r} {right}."
        raise DataFileError(table.path, problem, int(table.lines[row]), code="out-of-range")
    return np.asarray(values)


def _complete(columns: dict[str, Array], kind: str, replicates: Array, notes: list[str]) -> None:
    """Compute standard error and scatter from each other."""
    if kind not in columns:
        return
    error, scatter = columns.get(f"{kind}_error"), columns.get(f"{kind}_scatter")
    if error is None and scatter is None and kind == "viscoelastic":
        error = scatter = np.full(replicates.size, np.inf)
        notes.append(
            Note(
                "errors-unknown",
                "The file of friction curves gives neither standard errors nor scatter: neither is known, and both are "
                "infinite.",
            )
        )
    if error is None and scatter is not None:
        error = scatter / np.sqrt(replicates)
    if scatter is None and error is not None:
        scatter = error * np.sqrt(replicates)
    if error is not None and scatter is not None:
        columns[f"{kind}_error"], columns[f"{kind}_scatter"] = error, scatter


def _remarks(path: str) -> dict[str, list[str]]:
    """Return the remarks of a file that viscofric saved."""
    found: dict[str, list[str]] = {name: [] for name in _REMARKS}
    source = Source(path, bytes_of(path))
    if is_workbook(source):
        return found
    lines = [line[1:].strip() for line in (source.text or "").splitlines() if line.startswith("#")]
    if not lines or lines[0] != _TITLE:
        return found
    for line in lines[1:]:
        name, colon, words = line.partition(": ")
        if colon and name in found:
            found[name].append(_note(words) if name == "note" else words)
    return found


def _note(words: str) -> str:
    """Return a note with its code, or the sentence alone where it has none."""
    try:
        return note_of(json.loads(words)) if words.startswith("{") else words
    except (ValueError, TypeError, KeyError):
        return words
