"""The rows of a PCS export as columns in SI units, and notes on what they contain and what disagrees."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.mtm.pcs_steps import LARGEST, NUMBER, UNITS, Block, Export, Step, at, number_of

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

    def insist(self, good: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], problem: str) -> None:
        """Refuse the file for the first row that is not good."""
        bad = np.flatnonzero(~good)
        if bad.size:
            self.refuse(int(bad[0]), problem)

    def refuse(self, place: int, problem: str) -> NoReturn:
        """Refuse the file for a row."""
        raise DataFileError(
            self.export.path, self.at(place) + problem, int(self.line[place]), code="reading-incomplete"
        )


def rows_of(export: Export) -> Rows:
    """Convert the cells of an export to numbers, or raise `DataFileError` for the first that is none."""
    blocks = [(place, step, block) for place, step in enumerate(export.steps) for block in step.blocks if block.rows]
    empty = np.empty(0)

    def joined(parts: list[Array]) -> Array:
        return np.concatenate(parts) if parts else empty

    return Rows(
        export,
        {name: joined([_column(export, step, block, name) for _, step, block in blocks]) for name in UNITS},
        joined([np.full(len(block.rows), float(place)) for place, _, block in blocks]).astype(np.int64),
        joined([block.first + np.arange(float(len(block.rows))) for _, _, block in blocks]).astype(np.int64),
        joined([np.array(block.lines, dtype=float) for _, _, block in blocks]).astype(np.int64),
    )


def _column(export: Export, step: Step, block: Block, name: str) -> Array:
    place = block.layout.places.get(name)
    cells = [] if place is None else [row[place.place] for row in block.rows]
    if place is None or not any(cells):
        return np.full(len(block.rows), np.nan)

    def checked(row: int) -> float:
        where = f"{at(step, block.first + row)}column {place.heading!r}"
        value = number_of(export, cells[row], where, block.lines[row])
        return np.nan if value is None else value

    if export.decimal_comma:
        values = np.array([checked(row) for row in range(len(cells))])
    else:
        plain = NUMBER.fullmatch
        values = np.array([float(cell) if plain(cell) else checked(row) for row, cell in enumerate(cells)])
        for row in np.flatnonzero(np.abs(values) > LARGEST):
            checked(int(row))
    return np.asarray(place.factor * values + place.offset)


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
        yield (
            Note(
                "both-forces",
                f"{pairs} rows hold TF1 and TF2, each a reading of its own with the ball and disc speeds of its "
                "number; "
                "their time is that of the row.",
            )
        )
    if np.any((signal >= 2) & (signal < len(SIGNALS))):
        yield (
            Note(
                "reversal-assumed",
                "In TF3 and TF4 disc and ball are assumed to run backwards, and forces to be those of the force cell; "
                "no sample has shown it.",
            )
        )
    if single:
        yield (
            Note(
                "zero-assumed",
                f"{single} rows hold only a Traction Force and are one reading each; the export does not state whether "
                "the "
                "zero traction force is still in it, and it is assumed to be.",
            )
        )
    odd = int(np.sum(readings % 2 == 1)) - single
    if odd:
        yield Note(
            "odd-readings",
            f"{odd} rows hold an odd number of TF1 to TF4, so that not every reading has one with the slip reversed.",
        )


def _disagreements(rows: Rows, load: Array) -> Iterator[str]:
    first, second, third, fourth = rows.stacked(*SIGNALS)
    force, coefficient = rows.columns["traction force"], rows.columns["traction coeff"]
    two = np.isnan(third) & np.isnan(fourth)
    off = two & (np.abs(force - 0.5 * (first - second)) > _FORCE_AGREES)
    if off.any():
        yield (
            Note(
                "force-contradicts",
                f"In {int(off.sum())} rows the printed Traction Force is not half of TF1 - TF2, the first being "
                f"{rows.at(int(np.argmax(off))).removesuffix(': ')}; readings are those of TF1 and TF2.",
                values={"rows": int(off.sum()), "first": rows.at(int(np.argmax(off))).removesuffix(": ")},
            )
        )
    loaded = np.where(load > 0.0, load, np.nan)
    allowed = _COEFFICIENT_AGREES + (_FORCE_AGREES + 1e-3 * np.abs(coefficient)) / loaded
    off = np.abs(np.abs(force) / loaded - coefficient) > allowed
    if off.any():
        yield (
            Note(
                "coefficient-contradicts",
                f"In {int(off.sum())} rows the printed Traction Coeff is not the Traction Force over the load, the "
                "first "
                f"being {rows.at(int(np.argmax(off))).removesuffix(': ')}.",
            )
        )
    disc = rows.stacked("disc speed 1", "disc speed 2")
    ball = rows.stacked("ball speed 1", "ball speed 2")
    slip = np.abs(disc - ball)
    slip = np.where(np.isnan(slip[1]), slip[0], np.abs(0.5 * (disc[0] - ball[0] - disc[1] + ball[1])))
    off = two & (np.abs(slip - np.abs(rows.columns["sliding speed"])) > _SPEED_AGREES + _SPEEDS_AGREE * np.abs(disc[0]))
    if off.any():
        yield (
            Note(
                "sliding-speed-contradicts",
                f"In {int(off.sum())} rows the printed Sliding Speed is not the difference of disc and ball speed, the "
                f"first being {rows.at(int(np.argmax(off))).removesuffix(': ')}; readings are those of disc and ball.",
                values={"rows": int(off.sum()), "first": rows.at(int(np.argmax(off))).removesuffix(": ")},
            )
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
