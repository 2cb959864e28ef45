"""Separate viscoelastic from Coulomb friction in the signed traction runs of a mini-traction machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.conditions import Condition, conditions, where
from viscofric.friction.curves import FrictionCurves
from viscofric.units import Quantity, positive, to_si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import TractionRuns

    Array: TypeAlias = NDArray[np.float64]

# A deviation is worth a note if chance makes it so large once in 370 times: three standard errors where
# they are well known, more (Student's t) where few replicates stand behind them.
_CHANCE = 0.00135  # on either side
_ROUNDING = 1e-9  # relative; smaller deviations come from rounding
_OUTLIER = 5.0  # robust standard deviations
_FEWEST_FOR_OUTLIERS = 4  # readings of a configuration

# (sgn u_disc, sgn(u_disc − u_ball)) in words
_WORDS = {
    (sign, slip): f"u_disc {'<' if sign < 0 else '>'} 0 with u_disc − u_ball {'<' if slip < 0 else '>'} 0"
    for sign in (-1, 1)
    for slip in (-1, 1)
}


def separate(
    runs: TractionRuns,
    *,
    zero: Quantity | None = None,
    speed_tolerance: float = 0.05,
    temperature_tolerance: Quantity = 1.0,
) -> FrictionCurves:
    """Separate viscoelastic friction from Coulomb friction and from the force cell's zero.

    Parameters
    ----------
    runs : TractionRuns
        Readings with signed surface velocities.
    zero : float, str or pint.Quantity, optional
        Zero reading O of the force cell where it is known, N; fitted at each condition if left out.
    tolerance : float
        Relative gap that parts nominal speeds, slips and loads from each other; measured ones scatter by
        less.
    temperature_tolerance : float, str or pint.Quantity
        Gap that parts nominal temperatures, K.

    Returns
    -------
    FrictionCurves
        One entry per temperature, load, magnitude of disc speed and magnitude of slip, in that order.
        Temperatures and speeds are the means over all readings of the same nominal value.

    Raises
    ------
    InputError
        If there are no readings, conditions cannot be told apart, or the sign configurations measured at
        one of them do not suffice.

    Notes
    -----
    The force on the cell is

        F = O + F_N [μ_c sgn(u_disc − u_ball) + μ_v sgn(u_disc)],

    which is the paper's Eqs. 9a–d whatever the names of the configurations.  It is fitted by least squares
    with each reading's own measured load F_N.  Where every replicate of a condition has all configurations
    that the condition has, each replicate is fitted by itself: coefficients are means over the replicates,
    scatter their standard deviation s, standard errors s/√n with n − 1 degrees of freedom.  Otherwise all
    readings are fitted together and standard errors come from the scatter of the residuals; the scatter
    given is then the standard error times √n.  Both are infinite where nothing is left over to tell them
    from.

    With four configurations a fourth coefficient, of −sgn(u_disc) sgn(u_disc − u_ball) F_N, is fitted as
    well: the
    consistency, (F_I − F_II + F_III − F_IV)/4F_N, zero in the model.

    No reading is dropped.  One is noted that differs from the median of its configuration by more than five
    standard deviations (1.4826 × the median absolute deviation), of its condition and of the whole test.

    Examples
    --------
    >>> import numpy as np, viscofric as vf
    >>> runs = vf.TractionRuns(
    ...     disc_speed=np.array([-0.1, -0.1, 0.1, 0.1]),
    ...     ball_speed=np.array([-0.15, -0.05, 0.15, 0.05]),
    ...     traction_force=np.array([0.6, -1.4, -0.4, 1.6]),
    ...     load=np.full(4, 25.0),
    ...     temperature=np.full(4, 303.15),
    ...     replicate=np.ones(4),
    ... )
    >>> curves = vf.separate(runs)
    >>> curves.offset.round(6), curves.viscoelastic.round(6), curves.coulomb.round(6)
    (array([0.1]), array([0.02]), array([0.04]))
    """
    if not 0.0 < speed_tolerance < 1.0:
        raise InputError(f"speed_tolerance = {speed_tolerance!r}: must lie between 0 and 1, such as 0.05.")
    known = None if zero is None else to_si(zero, "N", "zero")
    kelvin = positive(temperature_tolerance, "delta_degC", "temperature_tolerance")
    groups, notes = conditions(runs, speed_tolerance, kelvin)
    if not groups:
        raise InputError("traction runs hold no reading with the disc in motion: nothing to separate.")
    _insist_on_configurations(groups, known)
    entries = [_Entry.of(runs, group, known) for group in groups]
    sliding = any(entry.slides for entry in entries)
    checked = any(entry.checks for entry in entries)

    def column(number: int, kind: str) -> Array:
        return np.array([getattr(entry, kind)[number] for entry in entries])

    return FrictionCurves(
        speed=np.array([group.speed for group in groups]),
        temperature=np.array([group.temperature for group in groups]),
        load=np.array([group.load for group in groups]),
        viscoelastic=column(1, "value"),
        viscoelastic_error=column(1, "error"),
        viscoelastic_scatter=column(1, "scatter"),
        replicates=np.array([entry.replicates for entry in entries]),
        coulomb=column(2, "value") if sliding else None,
        coulomb_error=column(2, "error") if sliding else None,
        coulomb_scatter=column(2, "scatter") if sliding else None,
        consistency=column(3, "value") if checked else None,
        consistency_error=column(3, "error") if checked else None,
        source=runs.source,
        notes=(*runs.notes, *notes, *_doubts(groups, entries), *_outliers(runs, groups, entries)),
        slip=np.array([group.slip for group in groups]),
        offset=column(0, "value"),
    )


def _insist_on_configurations(groups: list[Condition], zero: float | None) -> None:
    """Raise where the signs alone, whatever the jitter of the loads, do not tell the unknowns apart."""
    poor = [g for g in groups if np.linalg.matrix_rank(_regressors(g, zero)) < _unknowns(g, zero)]
    if not poor:
        return
    first = poor[0]
    there = set(zip(first.disc_sign.astype(int), first.slip_sign.astype(int), strict=True))
    missing = [words for signs, words in _WORDS.items() if signs not in there]
    advice = f"measure also {' or '.join(missing)}"
    if not np.any(first.slip_sign):
        advice = "measure also with the disc's velocity reversed"
    if zero is None:
        unknowns = "the force cell's zero, viscoelastic and Coulomb friction"
        advice += ", or pass zero= if the force cell's zero is known"
    else:
        unknowns = "viscoelastic and Coulomb friction"
    raise InputError(f"{where(poor, len(groups))} the signs of the velocities do not tell {unknowns} apart; {advice}.")


def _unknowns(group: Condition, zero: float | None) -> int:
    return 1 + (zero is None) + bool(np.any(group.slip_sign))


def _regressors(group: Condition, zero: float | None) -> Array:
    """Signs that go with zero, viscoelastic and Coulomb friction."""
    offset = np.full(group.rows.size, float(zero is None))
    return np.stack([offset, group.disc_sign, group.slip_sign], axis=1)


@dataclass(frozen=True, eq=False)
class _Entry:
    """Zero (N), viscoelastic and Coulomb coefficient and consistency of a condition, in this order.

    `freedom` is the number of degrees of freedom behind the errors; what cannot be known has an infinite
    error.
    """

    value: Array
    error: Array
    scatter: Array
    replicates: int
    freedom: tuple[int, int]
    together: bool
    slides: bool
    checks: bool

    @classmethod
    def of(cls, runs: TractionRuns, group: Condition, zero: float | None) -> _Entry:
        numbers = np.unique(runs.replicate[group.rows])
        mine = [runs.replicate[group.rows] == number for number in numbers]
        configurations = [set(group.configurations[rows].tolist()) for rows in mine]
        complete = all(these == set(group.configurations.tolist()) for these in configurations)
        count = numbers.size
        slides, checks = bool(np.any(group.slip_sign)), _has_all_four(group)
        if complete and count > 1:
            each = np.array([_fit(runs, group, rows, zero)[0] for rows in mine])
            value, scatter = each.mean(axis=0), each.std(axis=0, ddof=1)
            error, freedom = scatter / np.sqrt(count), (count - 1, count - 1)
        else:
            value, error, freedom = _fit(runs, group, np.full(group.rows.size, True), zero)
            scatter = error * np.sqrt(count)
        unknown = np.array([False, False, not slides, not checks])
        error, scatter = (np.where(unknown, np.inf, spread) for spread in (error, scatter))
        return cls(value, error, scatter, count, freedom, not complete, slides, checks)


def _has_all_four(group: Condition) -> bool:
    return {-4, -2, 2, 4} <= set(group.configurations.tolist())


def _fit(
    runs: TractionRuns, group: Condition, rows: NDArray[np.bool_], zero: float | None
) -> tuple[Array, Array, tuple[int, int]]:
    """Fit readings of a condition: values, standard errors, degrees of freedom without and with the check."""
    force = runs.traction_force[group.rows][rows] - (zero or 0.0)
    load = runs.load[group.rows][rows] / group.load
    signs = _regressors(group, zero)[rows] * np.stack([np.ones(load.size), load, load], axis=1)
    crossed = -(group.disc_sign * group.slip_sign)[rows] * load
    used = np.any(signs != 0.0, axis=0)
    value, error = np.zeros(4), np.zeros(4)
    value[:3][used], error[:3][used], freedom = _least_squares(signs[:, used], force)
    checked_freedom = 0
    if _has_all_four(group):
        coefficients, errors, checked_freedom = _least_squares(np.column_stack([signs[:, used], crossed]), force)
        value[3], error[3] = coefficients[-1], errors[-1]
    value[1:] /= group.load
    error[1:] /= group.load
    if zero is not None:
        value[0] = zero
    return value, error, (freedom, checked_freedom)


def _least_squares(design: Array, force: Array) -> tuple[Array, Array, int]:
    coefficients: Array = np.asarray(np.linalg.lstsq(design, force, rcond=None)[0], dtype=float)
    freedom = len(force) - design.shape[1]
    if freedom < 1:
        return coefficients, np.full(coefficients.shape, np.inf), 0
    variance = float(np.sum((force - design @ coefficients) ** 2)) / freedom
    covariance: Array = variance * np.linalg.inv(design.T @ design)
    return coefficients, np.sqrt(np.diag(covariance)), freedom


def _threshold(freedom: int) -> float:
    """How many standard errors chance reaches once in 370 times."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 1.0 - _CHANCE)) if freedom > 0 else np.inf


def _doubts(groups: list[Condition], entries: list[_Entry]) -> list[str]:
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
    if together:
        notes.append(
            f"{where(together, total)} not every replicate has all sign configurations, so all readings "
            "are fitted together."
        )
    alone = [group for group, entry in zip(groups, entries, strict=True) if not np.isfinite(entry.error[1])]
    if alone:
        notes.append(
            f"{where(alone, total)} there are too few readings to tell the scatter, so standard errors are "
            "given as infinite; repeat the test."
        )
    return notes


def _outliers(runs: TractionRuns, groups: list[Condition], entries: list[_Entry]) -> list[str]:
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
