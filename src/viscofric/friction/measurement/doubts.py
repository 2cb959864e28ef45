"""Doubts about a traction test: negative friction, inconsistency, another zero, slip, outliers, missing runs."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.intervals import threshold
from viscofric.friction.measurement.conditions import Condition, where
from viscofric.friction.measurement.fit import Entry
from viscofric.friction.measurement.zeros import ROUNDING, Zeros
from viscofric.notes import Note, Remedy
from viscofric.showing import with_error
from viscofric.traction import TractionRuns
from viscofric.units import shown_number

#: Probability of a note on one kind of deviation in a sound test of any number of conditions: one in 370.  The
#: threshold in standard errors is Student's t, larger with few replicates or many conditions.
CHANCE = 0.0027
# Least significant contribution of unnoticed slip to viscoelastic friction, over Coulomb friction.
_MATTERS = 0.1
# Mean residual of configurations over friction that needs no standard error: runs that vary by 30 % leave 15 %.
_GROSS = 0.5
_OUTLIER = 5.0  # robust standard deviations
_FEWEST_FOR_OUTLIERS = 4  # readings of a configuration
_NAMED = 3  # outliers that a note names one by one
LEAVE_OUT = Remedy(
    ' With outliers="leave out" such readings are left out.',
    " With --leave-out-outliers such readings are left out.",
    ' With outliers = "leave out" under [measurement] such readings are left out.',
    " With “Outliers”: leave out, such readings are left out.",
    "measurement.outliers",
)


def doubts(entries: list[Entry], zeros: Zeros) -> list[Note]:
    """Return notes on doubts about a measurement."""
    return [*_negative(entries), *_inconsistent(entries), *_another_zero(entries, zeros), *_incomplete(entries)]


def _where(some: Iterable[Entry], entries: list[Entry]) -> str:
    return where([entry.group for entry in some], len(entries))


def _negative(entries: list[Entry]) -> Iterator[Note]:
    """Yield notes on negative coefficients, one for each possible reason."""
    sure = threshold(np.inf, CHANCE / len(entries))
    for number, name, reason in ((1, "viscoelastic", _why_viscoelastic), (2, "Coulomb", _why_coulomb)):
        deviation = np.array([-entry.value[number] for entry in entries])
        reasons = defaultdict(list)
        places = set(_significant(entries, number, deviation))
        for place, entry in enumerate(entries):
            # An assumed Coulomb friction may exceed that measured, however few the readings are.
            beyond = number == 1 and entry.fit.assumes and deviation[place] > sure * entry.error[1] + ROUNDING
            if beyond or place in places:
                reasons[reason(entry)].append(entry)
        for (causes, why), some in reasons.items():
            yield Note(
                "negative-friction",
                f"{_where(some, entries)} the {name} friction coefficient is negative ({_shown(some[0], number)}): "
                f"{why}.",
                values={"coefficient": name, "conditions": len(some), "reasons": list(causes)},
            )


_CAUSES = {
    "signs-reversed": "the sign of the force, or of the velocities, is reversed",
    "zero-differs-by-direction": "the zero of the force cell differs between the directions of the disc",
    "zero-differs": "the zero of the force cell at these readings differs from the one that is used",
    "coulomb-not-assumed": "Coulomb friction is not the one assumed",
    "disc-turns-against-sign": "the disc turns against the sign of its speed",
    "speeds-exchanged": "the speeds of disc and ball are exchanged",
}


def _why_viscoelastic(entry: Entry) -> tuple[tuple[str, ...], str]:
    """Return possible causes of negative viscoelastic friction, and their words."""
    fit = entry.fit
    measured = fit.slides and fit.coulomb is None
    reasons = []
    if not measured or entry.value[2] <= 0.0:
        reasons.append("signs-reversed")
    elif fit.fits_offset:
        reasons.append("zero-differs-by-direction")
    if not fit.fits_offset:
        reasons.append("zero-differs")
    if fit.assumes:
        reasons.append("coulomb-not-assumed")
    if measured and entry.value[2] > 0.0:
        reasons.append("disc-turns-against-sign")
    sound = "Coulomb friction is positive as it should be, so probably " if len(reasons) > 1 and measured else ""
    return tuple(reasons), f"{sound or 'probably '}{', or '.join(_CAUSES[one] for one in reasons)}"


def _why_coulomb(entry: Entry) -> tuple[tuple[str, ...], str]:
    """Return the probable cause of negative Coulomb friction, and its words."""
    cause = "speeds-exchanged" if entry.value[1] > 0.0 and entry.fit.fits_offset else "signs-reversed"
    return (cause,), f"probably {_CAUSES[cause]}"


def _inconsistent(entries: list[Entry]) -> Iterator[Note]:
    value = np.array([entry.value for entry in entries])
    # One run of each configuration tells no error of the residual.
    once = np.flatnonzero([entry.fit.checks and np.isinf(entry.error[3]) for entry in entries])
    some = [entries[place] for place in once]
    rounding = ROUNDING * sum(abs(entry.value[0]) / entry.group.load for entry in some)
    friction = sum(float(np.hypot(*entry.value[1:3])) for entry in some)
    gross = abs(np.sum(value[once, 3])) > _GROSS * friction + rounding
    for found, how in (
        (_significant(entries, 3, np.abs(value[:, 3])), "where scatter alone would give zero"),
        (once.tolist() if gross else [], "which is too large for the scatter of runs"),
    ):
        if found:
            yield Note(
                "inconsistent",
                f"{_where((entries[one] for one in found), entries)} the four sign configurations are inconsistent: "
                f"their residual is {_shown(entries[found[0]], 3)} of the load, {how}.",
                values={"conditions": len(found), "of": len(entries)},
            )


def _another_zero(entries: list[Entry], zeros: Zeros) -> Iterator[Note]:
    """Compare the fitted zero with the recorded one."""
    recorded = np.array([zeros.mean(one.group) if one.fit.fits_offset else np.nan for one in entries])
    deviation = np.abs([entry.value[0] for entry in entries] - recorded)
    found = _significant(entries, 0, np.where(np.isfinite(deviation), deviation, 0.0), zeros.error)
    if found:
        fitted, known = entries[found[0]], float(recorded[found[0]])
        yield Note(
            "another-zero",
            f"{_where((entries[one] for one in found), entries)} the zero of the force cell from the configurations, "
            f"{_shown(fitted, 0)} N, differs from the recorded one, {shown_number(known, '.2g')} N; the former is "
            "used.",
            values={"conditions": len(found), "of": len(entries), "fitted": float(fitted.value[0]), "recorded": known},
        )


def _incomplete(entries: list[Entry]) -> Iterator[Note]:
    """Yield notes on conditions where replicates lack configurations, or are too few."""
    total, together = len(entries), [entry.group for entry in entries if entry.fit.together]
    rolling = [entry.group for entry in entries if not entry.fit.slides]
    # Readings in pure rolling at each condition's temperature and speed, whatever its own slip.
    beside = [sum(one.rows.size for one in rolling if group.beside(one)) for group in together]
    rolled = [(group, readings) for group, readings in zip(together, beside, strict=True) if readings]
    if rolled:
        readings = rolled[0][1]
        yield Note(
            "pure-rolling",
            f"{where([group for group, _ in rolled], total)} slip is zero (pure rolling) in {readings} "
            f"reading{'s' if readings > 1 else ''}, so that not every replicate has all configurations and all "
            "readings are fitted together.",
            values={"readings": int(readings), "conditions": len(rolled), "of": total},
        )
    missing = [group for group, readings in zip(together, beside, strict=True) if not readings]
    if missing:
        yield Note(
            "incomplete-replicates",
            f"{where(missing, total)} not every replicate has all sign configurations, so all readings "
            "are fitted together.",
        )
    alone = [entry for entry in entries if not np.isfinite(entry.error[1])]
    if alone:
        yield Note(
            "few-readings",
            f"{_where(alone, entries)} there are too few readings to estimate the scatter; standard errors are "
            "infinite; repeat the test.",
        )


def _significant(entries: list[Entry], number: int, deviation: Array, more_error: float = 0.0) -> list[int]:
    """Return the conditions where one of the four values deviates by more than chance and rounding."""
    chance = CHANCE / len(entries)
    found = []
    for place, entry in enumerate(entries):
        load = entry.group.load
        size = abs(entry.value[0]) / load + abs(entry.value[1]) + abs(entry.value[2])
        size *= load if number == 0 else 1.0
        error = np.hypot(entry.error[number], more_error)
        if deviation[place] <= ROUNDING * size or not np.isfinite(error):
            continue
        if deviation[place] > threshold(entry.freedom[number], chance) * error:
            found.append(place)
    return found


def _shown(entry: Entry, number: int) -> str:
    return with_error(float(entry.value[number]), float(entry.error[number]))


def constant_force(runs: TractionRuns) -> Iterator[Note]:
    """Yield a note if all readings of the force are the same, as those of a force cell that was not recorded."""
    force = runs.traction_force
    if force.size >= _FEWEST_FOR_OUTLIERS and np.ptp(force) == 0.0:
        yield Note(
            "constant-force",
            f"All {force.size} readings of the traction force are the same, {shown_number(float(force[0]), '.4g')} N, "
            "so that all friction is zero; check whether the force was recorded.",
            values={"readings": int(force.size), "force": float(force[0])},
        )


def without_unnoticed_slip(entries: list[Entry]) -> tuple[list[Entry], list[Note]]:
    """Compare viscoelastic friction in pure rolling with that of the largest slip at the same speed."""
    # Slip too small to be measured can still transmit much of Coulomb friction, with one sign. Returns the conditions
    # where it does not, and notes on the others.
    sliding = [entry for entry in entries if entry.fit.slides and entry.fit.coulomb is None]
    kept, notes = [], []
    for entry in entries:
        group = entry.group
        alike = [one for one in sliding if group.beside(one.group)]
        kept.append(entry)
        if entry.fit.slides or not alike:
            continue
        other = max(alike, key=lambda one: one.group.slip)
        apart = abs(entry.value[1] - other.value[1])
        error = float(np.hypot(entry.error[1], other.error[1]))
        chance = threshold(min(entry.freedom[1], other.freedom[1]), CHANCE / len(entries))
        if apart > chance * error and apart > max(_MATTERS * abs(other.value[2]), ROUNDING):
            kept.pop()
            notes.append(
                Note(
                    "unnoticed-slip",
                    f"At {group} viscoelastic friction without slip, {_shown(entry, 1)}, differs from that with slip, "
                    f"{_shown(other, 1)}: ball and disc probably slip by less than can be measured, so that it "
                    "includes Coulomb friction; it is left out.",
                    values={
                        "temperature": group.temperature,
                        "speed": group.speed,
                        "without_slip": float(entry.value[1]),
                        "with_slip": float(other.value[1]),
                    },
                )
            )
    return kept, notes


def outliers(runs: TractionRuns, entries: list[Entry]) -> list[tuple[Condition, int]]:
    """Return the readings far from the others of their configuration, their conditions and rows."""
    if not entries:
        return []
    groups = [entry.group for entry in entries]
    deviations = [_deviations(runs, entry.group, entry.value[0]) for entry in entries]
    every = np.concatenate(deviations)
    configuration = np.concatenate([group.configurations for group in groups])
    # Few readings give a poor scale; the whole test, and all readings of equal signs, give a lower limit of it.
    least = {
        one: max(_robust_deviation(every), _robust_deviation(every[configuration == one]))
        for one in np.unique(configuration).tolist()
    }
    found: list[tuple[Condition, int]] = []
    for group, deviation in zip(groups, deviations, strict=True):
        rounding = ROUNDING * float(np.abs(runs.traction_force[group.rows]).max())
        floor = max(_robust_deviation(deviation), rounding)
        for one in set(group.configurations.tolist()):
            same = np.flatnonzero(group.configurations == one)
            if same.size >= _FEWEST_FOR_OUTLIERS:
                scale = max(floor, least[one], _robust_deviation(deviation[same]))
                far = np.abs(deviation[same]) > _OUTLIER * scale * _of_few(same.size)
                found += [(group, int(row)) for row in group.rows[same[far]]]
    return found


def outlier_notes(runs: TractionRuns, found: list[tuple[Condition, int]], *, left_out: bool) -> list[Note]:
    """Return a note that names outliers by their rows in the runs."""
    if not found:
        return []
    one = len(found) == 1
    named = [
        f"row {row + 1} (replicate {runs.replicate[row]}, {group}, "
        f"{shown_number(float(runs.traction_force[row]), '.4g')} N)"
        for group, row in found[:_NAMED]
    ]
    more = f" and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
    note = Note(
        "outliers",
        f"{'One reading deviates' if one else f'{len(found)} readings deviate'} from the others of the same "
        f"configuration by more than {_OUTLIER:g} robust standard deviations and {'was' if one else 'were'} "
        f"{'left out' if left_out else 'kept'}: {', '.join(named)}{more}.",
        remedy=None if left_out else LEAVE_OUT,
        values={"readings": len(found), "rows": [int(row) + 1 for _, row in found[:_NAMED]]},
    )
    return [note]


def _deviations(runs: TractionRuns, group: Condition, zero: float) -> Array:
    """Compare forces, brought to the mean load, with their configuration's median (not a number if few)."""
    force = (runs.traction_force[group.rows] - zero) * group.load / runs.load[group.rows]
    deviation = np.full(force.size, np.nan)
    for configuration in np.unique(group.configurations):
        same = group.configurations == configuration
        if np.count_nonzero(same) >= _FEWEST_FOR_OUTLIERS:
            deviation[same] = force[same] - np.median(force[same])
    return deviation


def _of_few(n: int) -> float:
    """Return the factor by which a reading may be farther from a median of few."""
    # The median of n readings has a variance of π/2n, and the median absolute deviation of n is too small by a factor
    # of about (n − 0.8)/n (C. Croux, P. J. Rousseeuw, Computational Statistics 1, 411–428, 1992).
    return float(np.sqrt(1.0 + 0.5 * np.pi / n)) * n / (n - 0.8)


def _robust_deviation(deviation: Array) -> float:
    """Return the standard deviation from the median, or from the mean where more than half are equal."""
    size = np.abs(deviation[np.isfinite(deviation)])
    if not size.size:
        return 0.0
    return 1.4826 * float(np.median(size)) or 1.2533 * float(np.mean(size))
