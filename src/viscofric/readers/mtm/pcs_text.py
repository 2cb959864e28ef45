"""Traction readings from text exports of PCS Instruments' MTM and ETM, with notes on what disagrees."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import NoReturn

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy
from viscofric.readers.headings import heading
from viscofric.readers.mtm.pcs_steps import (
    UNITS,
    Export,
    at,
    parse,
    start_times,
    table_of,
)
from viscofric.readers.mtm.readings import Thermometer, TractionReadings
from viscofric.readers.source import Source
from viscofric.readers.table import Table
from viscofric.traction import TractionStep
from viscofric.units import shown_celsius

SIGNALS = ("tf1", "tf2", "tf3", "tf4")


@dataclass(frozen=True, eq=False)
class Rows:
    """The rows of an export: columns by name (NaN where empty), and step (its place), row and line of each."""

    export: Export
    columns: dict[str, Array]
    step: Integers
    row: Integers
    line: Integers

    def __len__(self) -> int:
        return len(self.step)

    def stacked(self, *names: str) -> Array:
        """Return columns below each other, (len(names), n)."""
        return np.stack([self.columns[name] for name in names])

    def at(self, place: int) -> str:
        """Return the place of a row, as the beginning of a sentence."""
        return at(self.export.steps[self.step[place]], int(self.row[place]))

    def first(self, some: Mask) -> str:
        """Return the place of the first of some rows."""
        return self.at(int(np.argmax(some))).removesuffix(": ")

    def insist(self, good: Mask, problem: str, row: Integers | None = None) -> None:
        """Refuse the file for the first row, or the row of the first reading, that is not good."""
        bad = np.flatnonzero(~good)
        if bad.size:
            self.refuse(int(bad[0] if row is None else row[bad[0]]), problem)

    def refuse(self, place: int, problem: str) -> NoReturn:
        """Refuse the file for a row."""
        raise DataFileError(
            self.export.path, self.at(place) + problem, int(self.line[place]), code="reading-incomplete"
        )


def rows_of(export: Export) -> Rows:
    """Convert the cells of an export to numbers, or raise `DataFileError` for the first that is none."""
    blocks = [(place, step, block) for place, step in enumerate(export.steps) for block in step.blocks if block.rows]
    tables = [table_of(export, step, block.columns, block.rows, block.lines) for _, step, block in blocks]
    empty = np.empty(0)

    def joined(parts: list[Array]) -> Array:
        return np.concatenate(parts) if parts else empty

    return Rows(
        export,
        {name: joined([_column(table, name, unit) for table in tables]) for name, unit in UNITS.items()},
        joined([np.full(len(block.rows), float(place)) for place, _, block in blocks]).astype(np.int64),
        joined([block.first + np.arange(float(len(block.rows))) for _, _, block in blocks]).astype(np.int64),
        joined([np.array(block.lines, dtype=float) for _, _, block in blocks]).astype(np.int64),
    )


def _column(table: Table, name: str, unit: str) -> Array:
    place = table.place(name)
    if place is None or not any(row[place] for row in table.rows):
        return np.full(len(table.rows), np.nan)
    values = table.values(place, unit, or_missing=True)
    table.insist(~(np.abs(values) > _LARGEST), place, f"at most {_LARGEST:g}", "too-large")
    return values


#: Above every force, speed, temperature or time of a tribometer, in SI units.
_LARGEST = 1e9
_ABORTED = re.compile(r"abort|stopped|terminat|interrupt|suspend|fail|error|incomplete", re.IGNORECASE)
#: Above the rounding of printed forces (N) and coefficients of friction.
_FORCE_AGREES = 2e-3
_COEFFICIENT_AGREES = 1e-4
#: Above that of printed speeds, m/s and relative.
_SPEED_AGREES, _SPEEDS_AGREE = 5e-5, 1e-3


def notes(rows: Rows, row: Integers, signal: Integers, load: Array) -> Iterator[str]:
    """Yield notes on the contents of an export and on what is doubtful."""
    yield from _contents(rows.export, np.unique(rows.step[row]))
    yield from _kinds_of_rows(row, signal)
    yield from _disagreements(rows, load)
    yield from _unfinished(rows.export)


def _contents(export: Export, used: Integers) -> Iterator[str]:
    found = {
        what: export.header[key]
        for key, what in (
            ("profile description", "profile"),
            ("lubricant name", "lubricant"),
            ("test started", "test started"),
            ("comments", "comments"),
        )
        if export.header.get(key)
    }
    said = "".join(f"; {what} {value!r}" for what, value in found.items())
    yield Note("format", f"A text export of PCS Instruments' MTM or ETM{said}.", values=found)
    without = [step for place, step in enumerate(export.steps) if place not in set(used.tolist())]
    if without:
        kinds = Counter(step.word("step type") or "of no named type" for step in without)
        listed = ", ".join(f"{count} {kind}" for kind, count in kinds.most_common(8))
        yield Note(
            "steps-without-traction",
            f"{len(without)} of {len(export.steps)} steps contain no traction readings and are skipped: {listed}.",
            values={"steps": len(without), "kinds": dict(kinds)},
        )


def _kinds_of_rows(row: Integers, signal: Integers) -> Iterator[str]:
    _, readings = np.unique(row, return_counts=True)
    single = int(np.sum(signal == len(SIGNALS)))
    pairs = int(np.sum(readings > 1))
    if pairs:
        yield Note(
            "both-forces",
            f"{pairs} rows hold TF1 and TF2, each a reading of its own with the ball and disc speeds of its number; "
            "their time is that of the row.",
            values={"rows": pairs},
        )
    if np.any((signal >= 2) & (signal < len(SIGNALS))):
        yield Note(
            "reversal-assumed",
            "In TF3 and TF4 disc and ball are assumed to run backwards, and forces to be those of the force cell; no "
            "sample has shown it.",
        )
    if single:
        yield Note(
            "zero-assumed",
            f"{single} rows hold only a Traction Force and are one reading each; the export does not state whether the "
            "zero traction force is still in it, and it is assumed to be.",
            values={"rows": single},
        )
    odd = int(np.sum(readings % 2 == 1)) - single
    if odd:
        yield Note(
            "odd-readings",
            f"{odd} rows hold an odd number of TF1 to TF4, so that not every reading has one with the slip reversed.",
            values={"rows": odd},
        )


def _disagreements(rows: Rows, load: Array) -> Iterator[str]:
    def contradiction(off: Mask, code: str, what: str, used: str = "") -> Iterator[Note]:
        if off.any():
            values = {"rows": int(off.sum()), "first": rows.first(off)}
            said = f"In {values['rows']} rows the printed {what}, the first being {values['first']}{used}."
            yield Note(code, said, values=values)

    first, second, third, fourth = rows.stacked(*SIGNALS)
    force, coefficient = rows.columns["traction force"], rows.columns["traction coeff"]
    two = np.isnan(third) & np.isnan(fourth)
    off = two & (np.abs(force - 0.5 * (first - second)) > _FORCE_AGREES)
    used = "; readings are those of TF1 and TF2"
    yield from contradiction(off, "force-contradicts", "Traction Force is not half of TF1 - TF2", used)
    loaded = np.where(load > 0.0, load, np.nan)
    allowed = _COEFFICIENT_AGREES + (_FORCE_AGREES + 1e-3 * np.abs(coefficient)) / loaded
    off = np.abs(np.abs(force) / loaded - coefficient) > allowed
    yield from contradiction(off, "coefficient-contradicts", "Traction Coeff is not the Traction Force over the load")
    disc = rows.stacked("disc speed 1", "disc speed 2")
    ball = rows.stacked("ball speed 1", "ball speed 2")
    slip = np.abs(disc - ball)
    slip = np.where(np.isnan(slip[1]), slip[0], np.abs(0.5 * (disc[0] - ball[0] - disc[1] + ball[1])))
    off = two & (np.abs(slip - np.abs(rows.columns["sliding speed"])) > _SPEED_AGREES + _SPEEDS_AGREE * np.abs(disc[0]))
    used = "; readings are those of disc and ball"
    yield from contradiction(
        off, "sliding-speed-contradicts", "Sliding Speed is not the difference of disc and ball speed", used
    )


def _unfinished(export: Export) -> Iterator[str]:
    if export.cut:
        said = f"The last row of the file ({export.cut}) is cut short and left out."
        yield Note("cut-short", said, values={"row": export.cut})
    planned, completed = (export.header.get(f"number of steps {what}", "") for what in ("in profile", "completed"))
    if completed.isdecimal() and planned.isdecimal() and planned != completed:
        said = f"{completed} of the {planned} steps of the profile were completed."
        yield Note("steps-missing", said, values={"completed": int(completed), "planned": int(planned)})
    if completed.isdecimal() and completed.lstrip("0") != str(len(export.steps)):
        said = f"The file states {completed} completed steps, but contains {len(export.steps)}."
        yield Note("steps-missing", said, values={"completed": int(completed), "contained": len(export.steps)})
    for remark in export.remarks:
        if _ABORTED.search(remark) and "completed normally" not in remark:
            yield Note("aborted", f"The file contains the remark {remark[:120]!r}.", values={"remark": remark[:120]})
            break


NAME = "a text export of PCS Instruments' MTM or ETM"

_SIGNATURE = re.compile(
    r'(?:\A|[\r\n])[ \t]*Step[ \t]+\d+[ \t]+(?:"[^"\r\n]{0,200}"[ \t]+)?started[ \t]+at\b', re.IGNORECASE
)
#: With a larger difference, not both thermometers of a pot are in their places.
_THERMOMETERS_AGREE = 10.0  # K
#: Slip over speed above which its sign is certain.
_CLEAR_SLIP = 0.01


def recognises(source: Source) -> bool:
    """Return whether the file is such an export."""
    return source.text is not None and _SIGNATURE.search(source.text) is not None


def read(source: Source, thermometer: Thermometer) -> TractionReadings:
    """Return the readings of an export, two (or four) for each row in which the slip was reversed."""
    export = parse(source.path, source.text or "")
    rows = rows_of(export)
    load, where = _load(rows)
    row, signal, left_out = _readings(rows, load)
    if not row.size:
        problem = (
            f"none of its {len(export.steps)} steps holds a row with a traction force (in a column "
            "'Traction Force (N)' or 'TF1 (N)') under load."
        )
        raise DataFileError(source.path, problem, code="no-points")
    disc, ball = _speeds(rows, row, signal)
    temperature, thermal = _temperature(rows, row, thermometer)
    force = np.concatenate([rows.stacked(*SIGNALS), [rows.columns["traction force"]]])[signal, row]
    sense, sensed = _sense_of_force(force, disc, ball, row, signal)
    time, began, timed = _times(rows, row)
    zero, radius = (
        _header_values(export, *what) for what in (("zero traction force", "N"), ("disc track radius", "m"))
    )
    number, numbering = _step_numbers(export)
    own = rows.step[row]
    return TractionReadings(
        source=source.path,
        disc_speed=disc,
        ball_speed=ball,
        traction_force=sense * force,
        load=load[row],
        temperature=temperature,
        row=row,
        zero_force=sense * zero[own],
        time=time,
        track_radius=radius[own],
        step=number[own],
        steps=tuple(
            TractionStep(int(count), source.path, step.word("step type"), step.word("step description"), step.started)
            for count, step in zip(number, export.steps, strict=True)
        ),
        began=began,
        notes=(*notes(rows, row, signal, load), *left_out, *where, *thermal, *sensed, *timed, *numbering),
    )


def _load(rows: Rows) -> tuple[Array, tuple[str, ...]]:
    """Return the load of each row: the ball's, else the pin's, NaN if neither is there."""
    ball, pin = rows.columns["ball load"], rows.columns["pin load"]
    pinned = int(np.sum(np.isnan(ball) & ~np.isnan(pin)))
    note = Note(
        "rows-of-a-pin",
        f"{pinned} rows are of a pin, which is at rest: their load is the pin's and the ball's speed is zero.",
        values={"rows": pinned},
    )
    return np.where(np.isnan(ball), pin, ball), (note,) if pinned else ()


def _readings(rows: Rows, load: Array) -> tuple[Integers, Integers, tuple[str, ...]]:
    """Return row and signal number of each reading (4: rows with only the traction force), and notes."""
    signals = rows.stacked(*SIGNALS)
    there = ~np.isnan(signals)
    single = ~there.any(axis=0) & ~np.isnan(rows.columns["traction force"])
    there = np.concatenate([there, [single]])
    forced = np.asarray(there.any(axis=0))
    rows.insist(~forced | ~np.isnan(load), "there is a traction force, but neither a ball load nor a pin load.")
    loaded = load > 0.0
    out = []
    for some, what in ((~forced, "hold no traction force"), (forced & ~loaded, "were taken without load")):
        if some.any():
            values = {"rows": int(some.sum()), "first": rows.first(some)}
            said = f"{values['rows']} rows {what} and are left out; the first is {values['first']}."
            out.append(Note("rows-left-out", said, values=values))
    row, signal = np.nonzero((there & loaded).T)
    return row, signal, tuple(out)


def _speeds(rows: Rows, row: Integers, signal: Integers) -> tuple[Array, Array]:
    """Return the signed speeds of disc and ball that go with each reading."""
    speeds = []
    for body in ("disc", "ball"):
        names = [f"{body} speed {place}" for place in (1, 2, 3, 4, 1)]
        speed = rows.stacked(*names)[signal, row]
        if body == "ball":
            at_rest = np.isnan(rows.columns["ball load"]) & ~np.isnan(rows.columns["pin load"])
            speed = np.where(np.isnan(speed) & at_rest[row], 0.0, speed)
        lacking = np.flatnonzero(np.isnan(speed))
        if lacking.size:
            first = lacking[0]
            rows.refuse(int(row[first]), f"there is a traction force, but no {names[signal[first]].title()}.")
        speeds.append(speed)
    disc, ball = speeds
    # TF3 and TF4 are taken with the rolling direction reversed, also where speeds are printed without sign.
    reverse = np.where((signal >= 2) & (signal < 4) & (disc > 0.0), -1.0, 1.0)
    return reverse * disc, reverse * ball


def _temperature(rows: Rows, row: Integers, thermometer: Thermometer) -> tuple[Array, tuple[str, ...]]:
    """Return the temperature of each reading, K."""
    own, other = (rows.columns[f"{name} rtd temp"][row] for name in (thermometer, _OTHER[thermometer]))
    remarks = []
    if np.isnan(own).all() and not np.isnan(other).all():
        remarks.append(
            Note(
                "thermometer-missing",
                f"The {thermometer} RTD was not recorded; temperatures are those of the {_OTHER[thermometer]} RTD.",
                values={"missing": thermometer, "used": _OTHER[thermometer]},
            )
        )
        own, other = other, own
    else:
        gap = np.abs(own - other)
        far = gap[~np.isnan(gap)]
        if far.size and far.mean() > _THERMOMETERS_AGREE:
            means: dict[str, float] = {
                thermometer: float(np.nanmean(own)),
                _OTHER[thermometer]: float(np.nanmean(other)),
            }
            words = (
                f"Temperatures are those of the {thermometer} RTD, {shown_celsius(means[thermometer])} °C on "
                f"average, but the {_OTHER[thermometer]} RTD reads {shown_celsius(means[_OTHER[thermometer]])} °C"
            )
            choice = Remedy(f"; thermometer={_OTHER[thermometer]!r} takes that one.", ".", page=".")
            remarks.append(Note("thermometers-differ", words, remedy=choice, values=means))
        else:
            remarks.append(Note("thermometer", f"Temperatures are those of the {thermometer} RTD."))
    rows.insist(~np.isnan(own), "there is a traction force, but no temperature.", row)
    rows.insist(own > 0.0, "the temperature must be above absolute zero.", row)
    return own, tuple(remarks)


_OTHER: dict[Thermometer, Thermometer] = {"lube": "pot", "pot": "lube"}


def _sense_of_force(
    force: Array, disc: Array, ball: Array, row: Integers, signal: Integers
) -> tuple[float, tuple[str, ...]]:
    """Return -1 if forces are positive where the ball is faster, so that Coulomb friction follows the disc's slip."""
    first = np.flatnonzero((signal[:-1] % 2 == 0) & (signal[1:] == signal[:-1] + 1) & (row[1:] == row[:-1]))
    first = first[signal[first] < 3]
    slip = disc - ball
    clear = _CLEAR_SLIP * (np.abs(disc) + np.abs(ball))
    first = first[np.abs(slip[first] - slip[first + 1]) > clear[first]]
    if first.size:
        agrees = float(np.median((force[first] - force[first + 1]) * np.sign(slip[first] - slip[first + 1]))) >= 0.0
        if agrees:
            return 1.0, ()
        note = Note("force-signs-turned", "Forces are positive where the ball is faster; their signs are reversed.")
        return -1.0, (note,)
    alone = (signal == 4) & (np.abs(slip) > clear)
    if alone.any() and float(np.median(force[alone] * np.sign(slip[alone]))) < 0.0:
        note = Note(
            "force-signs-kept",
            "Most forces point against the slip of the disc on the ball; their signs are kept as printed.",
        )
        return 1.0, (note,)
    return 1.0, ()


def _times(rows: Rows, row: Integers) -> tuple[Array, datetime | None, tuple[str, ...]]:
    """Return the time of each reading since the first, s, and when that was by the clock."""
    starts = start_times([step.started for step in rows.export.steps])
    clock = next((start for start in starts if start is not None), None)
    own = rows.columns["step time"][row]
    time = np.full(row.shape, np.nan)
    undated, latest = 0, 0.0
    for place in np.unique(rows.step[row]):
        here = rows.step[row] == place
        start, clocked = latest, starts[place]
        if clocked is None or clock is None:
            undated += 1
        else:
            start = (clocked - clock).total_seconds()
        time[here] = start + own[here]
        if not np.isnan(time[here]).all():
            latest = float(np.nanmax(time[here]))
    if np.isnan(time).all():
        return time, None, (Note("no-time", "There is no step time, so the times of the readings are unknown."),)
    first = float(np.nanmin(time))
    note = Note(
        "date-unread",
        f"The date of {undated} steps cannot be read; they are assumed to follow the one before at once.",
        values={"steps": int(undated)},
    )
    began = clock + timedelta(seconds=first) if clock is not None and not undated else None
    return time - first, began, (note,) if undated else ()


def _header_values(export: Export, key: str, unit: str) -> Array:
    """Return a header value of each step, NaN without it."""
    values = np.full(len(export.steps), np.nan)
    for place, step in enumerate(export.steps):
        if key not in step.header:
            continue
        printed, cell, line = step.header[key]
        table = table_of(export, step, [heading(printed)], [[cell]], [line])
        values[place : place + 1] = table.values(0, unit, or_missing=True)
        table.insist(~((unit == "m") & (values[place : place + 1] <= 0.0)), 0, "above zero")
    return values


def _step_numbers(export: Export) -> tuple[Integers, tuple[str, ...]]:
    """Return the numbers of the steps as printed, or counted where these do not ascend."""
    printed = np.array([step.number for step in export.steps], dtype=np.int64)
    if np.all(np.diff(printed) > 0):
        return printed, ()
    note = Note(
        "steps-renumbered", "The numbers of the steps do not ascend in the file, so that steps are counted from 1."
    )
    return np.arange(1, printed.size + 1), (note,)
