"""Notes on what does not look like a sound traction test: signs, inconsistency, missing runs, outliers."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.friction.measurement.conditions import Condition, where
from viscofric.nominal import SAME_LOAD

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import TractionRuns
    from viscofric.friction.measurement.separation import Entry

    Array: TypeAlias = NDArray[np.float64]

# A deviation is worth a note if chance makes it so large once in 370 times: three standard errors where
# they are well known, more (Student's t) where few replicates stand behind them.
_CHANCE = 0.00135  # on either side
_ROUNDING = 1e-9  # relative; smaller deviations come from rounding
_OUTLIER = 5.0  # robust standard deviations
_FEWEST_FOR_OUTLIERS = 4  # readings of a configuration


def _threshold(freedom: int) -> float:
    """How many standard errors chance reaches once in 370 times."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 1.0 - _CHANCE)) if freedom > 0 else np.inf


def doubts(groups: list[Condition], entries: list[Entry]) -> list[str]:
    """Note what does not look like a sound measurement."""
    total = len(groups)
    notes = []

    def those(number: int, sign: float | None) -> tuple[list[Condition], str]:
        """Find where a value is significantly negative (or other than zero), and show the first."""
        found = []
        for group, entry in zip(groups, entries, strict=True):
            value = abs(entry.value[number]) if sign is None else sign * entry.value[number]
            size = abs(entry.value[0]) / group.load + abs(entry.value[1]) + abs(entry.value[2])
            chance = _threshold(entry.freedom[number == 3])
            known = np.isfinite(entry.error[number])
            if known and value > max(chance * entry.error[number], _ROUNDING * size):
                found.append((group, f"{entry.value[number]:.2g} ± {entry.error[number]:.2g}"))
        return [group for group, _ in found], found[0][1] if found else ""

    for number, name in ((1, "viscoelastic"), (2, "Coulomb")):
        negative, shown = those(number, -1.0)
        if negative:
            notes.append(
                f"{where(negative, total)} the {name} friction coefficient is negative ({shown}): the sign "
                "of the force or of a velocity is probably reversed."
            )
    inconsistent, shown = those(3, None)
    if inconsistent:
        notes.append(
            f"{where(inconsistent, total)} the four sign configurations do not fit together: the "
            f"consistency is {shown} of the load where scatter alone would give zero."
        )
    together = [group for group, entry in zip(groups, entries, strict=True) if entry.together]
    rolled = [group for group in together if _rolling_beside(group, groups)]
    if rolled:
        readings = _rolling_beside(rolled[0], groups)
        notes.append(
            f"{where(rolled, total)} slip is zero (pure rolling) in {readings} reading{'s' if readings > 1 else ''}, "
            "so that not every replicate has all configurations and all readings are fitted together."
        )
    missing = [group for group in together if group not in rolled]
    if missing:
        notes.append(
            f"{where(missing, total)} not every replicate has all sign configurations, so all readings "
            "are fitted together."
        )
    alone = [group for group, entry in zip(groups, entries, strict=True) if not np.isfinite(entry.error[1])]
    if alone:
        notes.append(
            f"{where(alone, total)} there are too few readings to tell the scatter, so standard errors are "
            "given as infinite; repeat the test."
        )
    return notes


def _rolling_beside(group: Condition, groups: list[Condition]) -> int:
    """Count the readings in pure rolling at a condition's temperature and speed, whatever its own slip."""
    return sum(
        one.rows.size
        for one in groups
        if not np.any(one.slip_sign)
        and one.temperature == group.temperature
        and one.speed == group.speed
        and abs(one.load - group.load) <= SAME_LOAD * group.load
    )


def outliers(runs: TractionRuns, groups: list[Condition], entries: list[Entry]) -> list[str]:
    """Note the readings far from the others of their configuration."""
    deviations = [_deviations(runs, group, entry.value[0]) for group, entry in zip(groups, entries, strict=True)]
    whole = _robust_deviation(np.concatenate(deviations))
    found: list[tuple[Condition, int]] = []
    for group, deviation in zip(groups, deviations, strict=True):
        # Few readings tell a scale badly; the whole test tells what it may be at least.
        rounding = _ROUNDING * float(np.abs(runs.traction_force[group.rows]).max())
        scale = max(_robust_deviation(deviation), whole, rounding)
        far = np.flatnonzero(np.abs(deviation) > _OUTLIER * scale)
        found += [(group, int(group.rows[row])) for row in far]
    if not found:
        return []
    group, row = found[0]
    count = "One reading deviates" if len(found) == 1 else f"{len(found)} readings deviate"
    note = (
        f"{count} from the others of the same configuration by more than {_OUTLIER:g} robust standard "
        f"deviations and {'was' if len(found) == 1 else 'were'} kept; "
        f"{'it is' if len(found) == 1 else 'the first is'} at {group}, replicate {runs.replicate[row]}, "
        f"with {runs.traction_force[row]:.4g} N."
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


def _robust_deviation(deviation: Array) -> float:
    """Return the standard deviation told by the median, or by the mean where more than half are equal."""
    size = np.abs(deviation[np.isfinite(deviation)])
    if not size.size:
        return 0.0
    return 1.4826 * float(np.median(size)) or 1.2533 * float(np.mean(size))
