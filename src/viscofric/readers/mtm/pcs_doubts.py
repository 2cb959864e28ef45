"""What is to be said of an export that was read: what it holds, what was passed over, assumed or does not agree."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note
from viscofric.readers.mtm.pcs_rows import SIGNALS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from viscofric.arrays import Array, Integers
    from viscofric.readers.mtm.pcs_rows import Rows
    from viscofric.readers.mtm.pcs_steps import Export

_ABORTED = re.compile(r"abort|stopped|terminat|interrupt|suspend|fail|error|incomplete", re.IGNORECASE)
#: More than the rounding of printed forces (N) and coefficients of friction.
_FORCE_AGREES = 2e-3
_COEFFICIENT_AGREES = 1e-4
#: More than that of printed speeds, m/s and relative.
_SPEED_AGREES, _SPEEDS_AGREE = 5e-5, 1e-3


def notes(rows: Rows, row: Integers, signal: Integers, load: Array) -> Iterator[str]:
    """Say what an export holds and what is doubtful about it, one sentence each."""
    yield from _contents(rows.export, np.unique(rows.step[row]))
    yield from _kinds_of_rows(row, signal)
    yield from _disagreements(rows, load)
    yield from _unfinished(rows.export)


def _contents(export: Export, used: Integers) -> Iterator[str]:
    told = [
        f"{what} {export.told[key]!r}"
        for key, what in (
            ("profile description", "profile"),
            ("lubricant name", "lubricant"),
            ("test started", "test started"),
            ("comments", "comments"),
        )
        if export.told.get(key)
    ]
    yield Note("format", f"A text export of PCS Instruments' MTM or ETM{''.join(f'; {one}' for one in told)}.")
    without = [step for place, step in enumerate(export.steps) if place not in set(used.tolist())]
    if without:
        kinds = Counter(step.word("step type") or "of no named type" for step in without)
        listed = ", ".join(f"{count} {kind}" for kind, count in kinds.most_common(8))
        yield Note(
            "steps-without-traction",
            f"{len(without)} of {len(export.steps)} steps hold no traction readings and are passed over: {listed}.",
        )


def _kinds_of_rows(row: Integers, signal: Integers) -> Iterator[str]:
    _, readings = np.unique(row, return_counts=True)
    single = int(np.sum(signal == len(SIGNALS)))
    pairs = int(np.sum(readings > 1))
    if pairs:
        yield (
            Note(
                "doubtful-rows",
                f"{pairs} rows hold TF1 and TF2, each a reading of its own with the ball and disc speeds of its "
                "number; "
                "their time is that of the row.",
            )
        )
    if np.any((signal >= 2) & (signal < len(SIGNALS))):
        yield (
            Note(
                "doubtful-rows",
                "In TF3 and TF4 disc and ball are assumed to run backwards, and forces to be those of the force cell; "
                "no sample has shown it.",
            )
        )
    if single:
        yield (
            Note(
                "doubtful-rows",
                f"{single} rows hold only a Traction Force and are one reading each; the export does not say whether "
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
                "doubtful-rows",
                f"In {int(off.sum())} rows the printed Traction Force is not half of TF1 - TF2, the first being "
                f"{rows.at(int(np.argmax(off))).removesuffix(': ')}; readings are those of TF1 and TF2.",
            )
        )
    loaded = np.where(load > 0.0, load, np.nan)
    allowed = _COEFFICIENT_AGREES + (_FORCE_AGREES + 1e-3 * np.abs(coefficient)) / loaded
    off = np.abs(np.abs(force) / loaded - coefficient) > allowed
    if off.any():
        yield (
            Note(
                "doubtful-rows",
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
                "doubtful-rows",
                f"In {int(off.sum())} rows the printed Sliding Speed is not the difference of disc and ball speed, the "
                f"first being {rows.at(int(np.argmax(off))).removesuffix(': ')}; readings are those of disc and ball.",
            )
        )


def _unfinished(export: Export) -> Iterator[str]:
    if export.cut:
        yield Note("cut-short", f"The last row of the file ({export.cut}) is cut short and left out.")
    planned, completed = (export.told.get(f"number of steps {what}", "") for what in ("in profile", "completed"))
    if completed.isdecimal() and planned.isdecimal() and planned != completed:
        yield Note("steps-missing", f"{completed} of the {planned} steps of the profile were completed.")
    if completed.isdecimal() and completed.lstrip("0") != str(len(export.steps)):
        yield Note("steps-missing", f"The file tells of {completed} completed steps, but holds {len(export.steps)}.")
    for remark in export.remarks:
        if _ABORTED.search(remark) and "completed normally" not in remark:
            yield Note("aborted", f"The file says {remark[:120]!r}.")
            break
