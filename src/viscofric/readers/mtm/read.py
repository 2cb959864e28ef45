"""Traction runs from any known formats, recognised by content and joined."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.errors import DataFileError, check_choice, short_notes
from viscofric.files import marked, says_synthetic
from viscofric.nominal import SAME_LOAD, SAME_SPEED, SAME_TEMPERATURE, numbered
from viscofric.notes import Note, note_of, setting
from viscofric.readers.mtm import delimited, pcs_binary, pcs_text
from viscofric.readers.mtm.readings import Thermometer, TractionReadings
from viscofric.readers.source import Source, insist_on_content, sources_of
from viscofric.readers.workbook import is_workbook, sheet_texts
from viscofric.traction import TractionRuns, TractionStep, notes_on_copies, notes_on_friction


def read_file(source: Source, thermometer: Thermometer) -> TractionReadings:
    """Return the readings of a file, or raise `DataFileError` for an empty, binary or damaged one."""
    insist_on_content(source)
    if pcs_binary.recognises(source):
        return pcs_binary.read(source, thermometer)
    export = _export(source)
    if export is not None:
        return pcs_text.read(export, thermometer)
    if source.text is None and not is_workbook(source):
        known = f"Supported formats: {pcs_text.NAME}, {pcs_binary.NAME} and {delimited.NAME}"
        problem = f"is a binary file of an unknown format; export the test as text. {known}."
        raise DataFileError(source.path, problem, code="unknown-format")
    return delimited.read(source)


def _export(source: Source) -> Source | None:
    """Return the text export of an instrument, or the one sheet of a workbook that holds it; None without any."""
    if source.columns:
        return None
    if not is_workbook(source):
        return source if pcs_text.recognises(source) else None
    found = {name: text for name, text in sheet_texts(source).items() if pcs_text.recognises(text)}
    if len(found) > 1:
        problem = f"the sheets {', '.join(map(repr, found))} each contain a traction test; choose one with "
        remedy = setting("measurement.sheet", "Sheet", repr(next(iter(found)))) + "."
        raise DataFileError(source.path, problem, code="several-tables", remedy=remedy)
    return next(iter(found.values()), None)


def format_name(source: Source) -> str:
    """Return the format of a file in words."""
    if pcs_binary.recognises(source):
        return pcs_binary.NAME
    return delimited.NAME if _export(source) is None else pcs_text.NAME


_MEASURED = ("disc_speed", "ball_speed", "traction_force", "load", "temperature")


def read_mtm(
    *paths: str | PathLike[str] | Sequence[str | PathLike[str]],
    thermometer: Thermometer = "lube",
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> TractionRuns:
    """Read signed traction readings from one or several files of a tribometer (MTM, ETM or your own tables).

    The format is recognised by the content, never by the name: text exports and binary files of PCS Instruments' MTM
    and ETM, and text tables or workbooks with a header that names disc speed, ball speed, temperature, load and
    traction force, each with its unit, and optionally replicate and step (whole numbers), zero force, time and track
    radius, in any order.  Rolling speed and slide-to-roll ratio (or sliding speed) may replace the two speeds, a
    coefficient of traction the force.

    Parameters
    ----------
    *paths : str or path, or a list of them
        The files; those of several temperatures or repetitions become one set of runs.
    thermometer : {"lube", "pot"}
        Which of an export's thermometers to use: that in the lubricant, nearer to the contact, or that of the pot.
        If a file has only one of them, that one is used, with a note.
    columns : mapping, optional
        Headings of a table that are not understood, by quantity, as for `read_dma`: ``{"disc_speed": "V1 (m/s)"}``.
        Quantities are temperature, disc_speed, ball_speed, load, traction_force, rolling_speed, sliding_speed,
        slide_to_roll_ratio, traction_coefficient, zero_force, time, track_radius, replicate and step.
    sheet : str, optional
        Name of the sheet of a workbook.

    Returns
    -------
    TractionRuns
        All readings, file after file, in SI units.  Without a replicate column the passes at equal nominal
        temperature, load, disc and ball speed are numbered 1, 2, … in their order, with a note; rows of one step in
        succession at equal values are one pass.  A file that measures conditions of an earlier one under the same
        replicate numbers holds other repetitions: its numbers are counted on from there, with a note.

    Raises
    ------
    DataFileError
        If a file cannot be read or is given twice, a column or unit is missing or wrong, a cell is not a
        finite number, or a load of a table is not above zero.
    InputError
        If no file is given, or `thermometer` is neither of the two.

    Notes
    -----
    A row of a PCS export that holds ``TF1`` and ``TF2``, the force with the slip one way and the other, becomes two
    readings, with ``Ball Speed 1``, ``Disc Speed 1`` and ``Ball Speed 2``, ``Disc Speed 2`` as their speeds; with
    ``TF3`` and ``TF4``, where the rolling direction is reversed too, four.  Any other row is one reading of its
    ``Traction Force``.

    Found in the exports of one ETM (20 500 rows with ``TF1`` and ``TF2`` in 500 steps) and one MTM: the printed
    sliding speed is that of the disc less that of the ball; forces are positive where the disc is faster, so that
    Coulomb friction follows ``sgn(u_disc - u_ball)`` as `TractionRuns` wants it (a file in which it does not is turned
    round, with a note); and the zero reading of the force cell seems not to have been taken off ``TF1`` and ``TF2``.
    The change of their half-sum from each step to the next has the slope 0.0 ± 0.2 against the change of the zero
    reading, by linear regression.  If it had been taken off, and the zero reading changes by its own errors, the slope
    would be −0.9.

    Assumed, since no sample shows it: that the zero reading is still in ``Traction Force`` where there is no ``TF1``,
    and that in ``TF3`` and ``TF4`` disc and ball run backwards although their speeds may be printed without sign.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "mtm.csv"  # synthetic
    >>> runs = vf.read_mtm(path)
    >>> sorted({round(kelvin - 273.15) for kelvin in runs.temperature.tolist()})
    [10, 20, 30, 45, 65, 90]
    """
    check_choice(thermometer, "thermometer", "lube", "pot")
    sources = sources_of(paths, "read_mtm", delimited.TRACTION, None, None, columns, sheet)
    parts = [read_file(source, thermometer) for source in sources]
    for place, part in enumerate(parts):
        for other in parts[:place]:
            if part.same_as(other):
                problem = f"contains the same readings as {other.source}; give only one of them."
                raise DataFileError(part.source, problem, code="given-twice")
    return _together(parts)


def _together(parts: Sequence[TractionReadings]) -> TractionRuns:
    columns = {name: np.concatenate([getattr(part, name) for part in parts]) for name in _MEASURED}
    time, timing = _times(parts)
    step, steps = _steps(parts)
    replicate, numbering = _replicates(parts, columns, step)
    friction = columns["traction_force"] / columns["load"]
    doubts = notes_on_friction(friction, columns["temperature"], columns["disc_speed"])
    settings = [column for name, column in columns.items() if name != "traction_force"]
    settings += [replicate, *([] if time is None else [np.nan_to_num(time)])]
    doubts += notes_on_copies(columns["traction_force"], *settings)
    several = len(parts) > 1
    own = [note_of(note).at(Path(part.source).name if several else "") for part in parts for note in part.notes]
    return TractionRuns(
        **columns,
        replicate=replicate,
        source=", ".join(marked(part.source, synthetic=says_synthetic(part.source)) for part in parts),
        notes=(*short_notes((*own, *numbering, *timing)), *doubts),
        zero_force=_optional(parts, "zero_force"),
        time=time,
        step=step,
        track_radius=_optional(parts, "track_radius"),
        steps=steps,
    )


def _optional(parts: Sequence[TractionReadings], name: str) -> Array | None:
    """Join a column, NaN for files without it; None if no file has it."""
    columns = [getattr(part, name) for part in parts]
    if all(column is None for column in columns):
        return None
    pairs = zip(parts, columns, strict=True)
    return np.concatenate([np.full(len(part), np.nan) if column is None else column for part, column in pairs])


def _times(parts: Sequence[TractionReadings]) -> tuple[Array | None, tuple[str, ...]]:
    """Join the times: since the first of all readings where the clock is known, else since each file's own."""
    time = _optional(parts, "time")
    if time is None or len(parts) == 1:
        return time, ()
    starts = [part.began for part in parts]
    known = [start for start in starts if start is not None]
    if len(known) < len(starts):
        note = "The date of some files is not known, so that time starts again with each file."
        return time, (Note("date-unknown", note),)
    later = [(start - min(known)).total_seconds() for start in known]
    return time + np.repeat(later, [len(part) for part in parts]), ()


def _steps(parts: Sequence[TractionReadings]) -> tuple[Integers | None, tuple[TractionStep, ...]]:
    """Count the steps on through all files; a file without steps among others is one step."""
    if all(part.step is None for part in parts):
        return None, ()
    numbers: list[Integers] = []
    steps: list[TractionStep] = []
    last = 0
    for part in parts:
        own = np.ones(len(part), dtype=np.int64) if part.step is None else part.step
        # The first file keeps its own numbers.
        shift = last + max(0, 1 - int(own.min())) if numbers else 0
        own = own + shift
        known = {shift + step.number: step for step in part.steps}
        for number in np.unique(own):
            step = known.get(int(number), TractionStep(int(number), part.source))
            steps.append(replace(step, number=int(number)))
        last = int(own.max())
        numbers.append(own)
    return np.concatenate(numbers), tuple(steps)


def _replicates(
    parts: Sequence[TractionReadings], columns: dict[str, Array], step: Integers | None
) -> tuple[Integers, tuple[str, ...]]:
    """Return the files' replicate numbers, or number the passes over equal conditions in their order."""
    known = [part.replicate for part in parts if part.replicate is not None]
    if len(known) == len(parts):
        return _counted_on(parts, columns)
    if known:
        without = next(part.source for part in parts if part.replicate is None)
        raise DataFileError(
            without, "has no replicate column, but another file of the same call has one.", code="no-replicates"
        )
    # Readings of one row were taken together; rows in succession at equal speeds, load and temperature are one pass.
    lengths = np.cumsum([0, *(int(part.row.max()) + 1 for part in parts)])
    row = np.concatenate([part.row + first for part, first in zip(parts, lengths[:-1], strict=True)])
    _, first, place = np.unique(row, return_index=True, return_inverse=True)
    nominal = _nominal({name: column[first] for name, column in columns.items()})
    part = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    place_in_test = np.column_stack([nominal, (part if step is None else step)[first]])
    begins = np.concatenate([[True], np.any(np.diff(place_in_test, axis=0) != 0, axis=1)])
    seen: Counter[tuple[int, ...]] = Counter()
    numbers = []
    for condition in map(tuple, nominal[begins].tolist()):
        seen[condition] += 1
        numbers.append(seen[condition])
    note = Note(
        "replicates-counted",
        "There is no replicate column; passes at equal speeds, load and temperature are numbered in their order, and "
        "rows in succession are one pass. Give a replicate column if they are repetitions.",
    )
    return np.array(numbers, dtype=np.int64)[np.cumsum(begins) - 1][place], (note,)


def _nominal(columns: dict[str, Array]) -> Integers:
    """Return numbers of the nominal temperature, load, disc and ball speed of each reading, a column each."""
    disc, ball, load, temperature = (columns[name] for name in ("disc_speed", "ball_speed", "load", "temperature"))
    nominal = [
        numbered(temperature, np.full(temperature.shape, SAME_TEMPERATURE)),
        numbered(load, SAME_LOAD * load),
        numbered(disc, SAME_SPEED * np.abs(disc)),
        numbered(ball, SAME_SPEED * np.abs(ball)),
    ]
    return np.stack(nominal, axis=1)


def _counted_on(parts: Sequence[TractionReadings], columns: dict[str, Array]) -> tuple[Integers, tuple[str, ...]]:
    """Return the replicate numbers of the files, continued where a file repeats conditions of an earlier one."""
    # Files of one repetition, such as one for each direction, share no reading; files that were each numbered from 1
    # do.
    sense = np.sign(columns["disc_speed"] - columns["ball_speed"]).astype(np.int64)
    conditions = np.column_stack([_nominal(columns), sense])
    numbers: list[Integers] = []
    taken: set[tuple[int, ...]] = set()
    notes = []
    for part, here in zip(parts, np.split(conditions, np.cumsum([len(part) for part in parts])[:-1]), strict=True):
        own = np.asarray(part.replicate)
        held = _held(here, own)
        if not taken.isdisjoint(held):
            own = own - own.min() + max(int(number.max()) for number in numbers) + 1
            held = _held(here, own)
            notes.append(
                Note(
                    "replicates-renumbered",
                    f"{Path(part.source).name}: conditions of an earlier file are measured again under the same "
                    "replicate "
                    f"numbers; they are other repetitions, numbered {own.min()} to {own.max()} here.",
                )
            )
        taken |= held
        numbers.append(own)
    return np.concatenate(numbers), tuple(notes)


def _held(conditions: Integers, replicate: Integers) -> set[tuple[int, ...]]:
    rows = np.unique(np.column_stack([conditions, replicate]), axis=0)
    return set(map(tuple, rows.tolist()))
