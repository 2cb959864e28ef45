"""Notes on what does not look like a sound traction test: signs, inconsistency, another zero, missing runs."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.measurement.conditions import Condition, where
from viscofric.nominal import SAME_LOAD
from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.measurement.entry import Entry
    from viscofric.friction.measurement.separation import Fit
    from viscofric.friction.measurement.zeros import Zeros


#: How often a sound test, of however many conditions, is noted for one kind of deviation: once in 370 times.  The
#: threshold in standard errors is Student's t, larger where few replicates or many conditions stand behind them.
CHANCE = 0.0027
ROUNDING = 1e-9  # relative; smaller deviations come from rounding


def threshold(freedom: float, chance: float) -> float:
    """How many standard errors a deviation of either sign reaches by chance, that often."""
    from scipy.special import ndtri, stdtrit

    if freedom <= 0.0:
        return np.inf
    return float(stdtrit(freedom, 1.0 - 0.5 * chance) if np.isfinite(freedom) else -ndtri(0.5 * chance))


def doubts(fits: list[Fit], entries: list[Entry], zeros: Zeros) -> list[Note]:
    """Note what does not look like a sound measurement."""
    groups = [fit.group for fit in fits]
    return [
        *_negative(fits, entries),
        *_inconsistent(groups, entries),
        *_another_zero(fits, entries, zeros),
        *_incomplete(groups, entries),
    ]


def _negative(fits: list[Fit], entries: list[Entry]) -> list[Note]:
    """Note negative coefficients, by what can be the reason for each."""
    groups = [fit.group for fit in fits]
    notes = []
    for number, name, reason in ((1, "viscoelastic", _why_viscoelastic), (2, "Coulomb", _why_coulomb)):
        deviation = np.array([-entry.value[number] for entry in entries])
        reasons = defaultdict(list)
        for place in _significant(groups, entries, number, deviation):
            reasons[reason(fits[place], entries[place])].append(place)
        notes += [
            Note(
                "negative-friction",
                f"{where([groups[place] for place in places], len(groups))} the {name} friction coefficient is "
                "negative "
                f"({_shown(entries[places[0]], number)}): {why}.",
            )
            for why, places in reasons.items()
        ]
    return notes


def _why_viscoelastic(fit: Fit, entry: Entry) -> str:
    """Say what can make viscoelastic friction negative: not the sign of a force with positive Coulomb friction."""
    measured = entry.slides and fit.coulomb is None
    reasons = []
    if not measured or entry.value[2] <= 0.0:
        reasons.append("the sign of the force, or of the velocities, is reversed")
    elif fit.fits_offset:
        reasons.append("the zero of the force cell differs between the directions of the disc")
    if not fit.fits_offset:
        reasons.append("the zero of the force cell is another one at these readings than the one that is used")
    if fit.coulomb is not None and entry.slides:
        reasons.append("Coulomb friction is not the one assumed")
    if measured and entry.value[2] > 0.0:
        reasons.append("the disc turns against the sign of its speed")
    sound = "Coulomb friction is positive as it should be, so that probably " if len(reasons) > 1 and measured else ""
    return f"{sound or 'probably '}{', or '.join(reasons)}"


def _why_coulomb(fit: Fit, entry: Entry) -> str:
    """Say what can make Coulomb friction negative."""
    if entry.value[1] > 0.0 and fit.fits_offset:
        return "probably the speeds of disc and ball are exchanged"
    return "probably the sign of the force, or of the velocities, is reversed"


def _inconsistent(groups: list[Condition], entries: list[Entry]) -> list[Note]:
    found = _significant(groups, entries, 3, np.array([abs(entry.value[3]) for entry in entries]))
    if not found:
        return []
    told = Note(
        "inconsistent",
        f"{where([groups[one] for one in found], len(groups))} the four sign configurations do not fit together: the "
        f"consistency is {_shown(entries[found[0]], 3)} of the load where scatter alone would give zero.",
    )
    return [told]


def _another_zero(fits: list[Fit], entries: list[Entry], zeros: Zeros) -> list[Note]:
    """Compare the zero that is fitted with the one that was recorded."""
    groups = [fit.group for fit in fits]
    recorded = np.array([zeros.mean(fit.group) if fit.fits_offset else np.nan for fit in fits])
    deviation = np.abs([entry.value[0] for entry in entries] - recorded)
    found = _significant(groups, entries, 0, np.where(np.isfinite(deviation), deviation, 0.0), zeros.error)
    if not found:
        return []
    first = found[0]
    told = Note(
        "another-zero",
        f"{where([groups[one] for one in found], len(groups))} the zero of the force cell told by the configurations, "
        f"{_shown(entries[first], 0)} N, is not the recorded one, {recorded[first]:.2g} N; the former is used.",
    )
    return [told]


def _incomplete(groups: list[Condition], entries: list[Entry]) -> list[Note]:
    """Name the conditions where replicates lack configurations, or are too few."""
    total = len(groups)
    notes = []
    together = [group for group, entry in zip(groups, entries, strict=True) if entry.together]
    beside = _rolling_beside(together, groups)
    rolled = [(group, readings) for group, readings in zip(together, beside, strict=True) if readings]
    if rolled:
        readings = rolled[0][1]
        notes.append(
            Note(
                "pure-rolling",
                f"{where([group for group, _ in rolled], total)} slip is zero (pure rolling) in {readings} "
                f"reading{'s' if readings > 1 else ''}, so that not every replicate has all configurations and all "
                "readings are fitted together.",
            )
        )
    missing = [group for group, readings in zip(together, beside, strict=True) if not readings]
    if missing:
        notes.append(
            Note(
                "incomplete-replicates",
                f"{where(missing, total)} not every replicate has all sign configurations, so all readings "
                "are fitted together.",
            )
        )
    alone = [group for group, entry in zip(groups, entries, strict=True) if not np.isfinite(entry.error[1])]
    if alone:
        notes.append(
            Note(
                "few-readings",
                f"{where(alone, total)} there are too few readings to tell the scatter, so standard errors are "
                "given as infinite; repeat the test.",
            )
        )
    return notes


def _significant(
    groups: list[Condition], entries: list[Entry], number: int, deviation: Array, more_error: float = 0.0
) -> list[int]:
    """Find the conditions where one of the four values deviates by more than chance and rounding make it."""
    chance = CHANCE / len(groups)
    found = []
    for place, (group, entry) in enumerate(zip(groups, entries, strict=True)):
        size = (abs(entry.value[0]) / group.load + abs(entry.value[1]) + abs(entry.value[2])) * (
            group.load if number == 0 else 1.0
        )
        error = np.hypot(entry.error[number], more_error)
        if deviation[place] <= ROUNDING * size or not np.isfinite(error):
            continue
        if deviation[place] > threshold(entry.freedom[number], chance) * error:
            found.append(place)
    return found


def _shown(entry: Entry, number: int) -> str:
    return f"{entry.value[number]:.2g} ± {entry.error[number]:.2g}"


def _rolling_beside(some: list[Condition], groups: list[Condition]) -> list[int]:
    """Count the readings in pure rolling at each condition's temperature and speed, whatever its own slip."""
    rolling = defaultdict(list)
    for group in groups:
        if not np.any(group.slip_sign):
            rolling[group.temperature, group.speed].append(group)
    return [
        sum(
            one.rows.size
            for one in rolling[group.temperature, group.speed]
            if abs(one.load - group.load) <= SAME_LOAD * group.load
        )
        for group in some
    ]
