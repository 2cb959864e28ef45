"""Least squares on the readings of one condition: zero, viscoelastic and Coulomb friction, and their errors."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.friction.measurement.entry import Entry
from viscofric.friction.measurement.least_squares import operators, residuals

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.friction.measurement.conditions import Condition
    from viscofric.friction.measurement.growth import Growth
    from viscofric.friction.measurement.zeros import Zeros
    from viscofric.traction import TractionRuns

    Array: TypeAlias = NDArray[np.float64]

_OFFSET, _VISCOELASTIC, _COULOMB, _CONSISTENCY = range(4)
# Degrees of freedom that steps leave, for their sums to tell errors.
_FEWEST_STEPS = 3
_FOUR = {(-1, -1), (-1, 1), (1, -1), (1, 1)}
#: The force as it is read, and what may be taken from it: drift (per N/s) and changes of the recorded zero.
FORCE, DRIFT, ZERO_CHANGES = range(3)


def regressors(group: Condition, *, offset: bool, coulomb: bool) -> Array:
    """Signs that go with zero, viscoelastic and Coulomb friction; zeros for what is not fitted."""
    return np.stack(
        [np.full(group.rows.size, float(offset)), group.disc_sign, group.slip_sign * float(coulomb)], axis=1
    )


def told_apart(group: Condition, *, offset: bool, coulomb: bool) -> bool:
    """Whether the signs alone, whatever the jitter of the loads, tell the unknowns apart."""
    return _full_rank(group.signs, offset, coulomb)


@lru_cache(maxsize=512)
def _full_rank(signs: frozenset[tuple[int, int]], offset: bool, coulomb: bool) -> bool:
    unknowns = 1 + offset + (coulomb and any(slip for _, slip in signs))
    columns = [(float(offset), disc, slip * coulomb) for disc, slip in signs]
    return int(np.linalg.matrix_rank(np.array(columns))) == unknowns


@dataclass(frozen=True, eq=False)
class Fit:
    """Least squares on the readings of a condition, of the force and of what may be taken from it.

    The fit is linear in the force, so that a drift is taken out of its coefficients as well as out of the readings.

    Attributes
    ----------
    each : (r, 4, 3) array
        Zero, viscoelastic and Coulomb coefficient and consistency of each replicate (of all readings where they are
        fitted together), of the force, of time and of the changes of the recorded zero.
    time : float
        Mean time of the readings, s; NaN where it was not recorded.
    residual, checked : (n, 3) array
        What the fits without and with the consistency leave over.
    operator : (4, n) array
        Makes the coefficients of the readings.
    first_rows : (r,) array of int
        First row of the readings behind each entry of `each`.
    step : (n,) array of int
        Number of the step of the test that each reading belongs to, among those of the condition.
    freedom : (2,) tuple
        Degrees of freedom of the residuals without and with the consistency.
    log_speed : (n,) array
        ln of the disc's speed over the condition's.
    viscoelastic_force : (n,) array
        What each reading's force holds of viscoelastic friction of coefficient 1 at the condition's speed, N.
    zero_variance, coulomb_variance : (4,) array
        Left by the errors of a zero and of a Coulomb coefficient that are not fitted, where scatter does not show them.
    """

    group: Condition
    each: Array
    time: float
    replicates: int
    together: bool
    fits_offset: bool
    coulomb: tuple[float, float] | None
    slides: bool
    checks: bool
    residual: Array = field(repr=False)
    checked: Array = field(repr=False)
    operator: Array = field(repr=False)
    first_rows: NDArray[np.int64] = field(repr=False)
    step: NDArray[np.intp] = field(repr=False)
    freedom: tuple[int, int]
    log_speed: Array = field(repr=False)
    viscoelastic_force: Array = field(repr=False)
    zero_variance: Array
    coulomb_variance: Array

    @classmethod
    def of(
        cls,
        runs: TractionRuns,
        group: Condition,
        zeros: Zeros,
        coulomb: tuple[float, float] | None = None,
        growth: Growth | None = None,
    ) -> Fit:
        """Fit a condition's readings, each replicate by itself where all are complete.

        Parameters
        ----------
        runs : TractionRuns
        group : Condition
        zeros : Zeros
            Used where the signs do not tell the zero.
        coulomb : (float, float), optional
            Coulomb coefficient and its standard error where they are assumed.
        growth : Growth, optional
            How viscoelastic friction follows speed within the condition; constant if left out.
        """
        slides = bool(np.any(group.slip_sign))
        checks = coulomb is None and group.signs >= _FOUR
        offset = zeros.fitted(group, coulomb=coulomb is None)
        load = runs.load[group.rows] / group.load
        design = regressors(group, offset=offset, coulomb=coulomb is None)
        design[:, 1:] *= load[:, None]
        log_speed = np.log(np.abs(runs.disc_speed[group.rows]) / group.speed)
        if growth is not None:
            design[:, _VISCOELASTIC] *= np.exp(growth.log_change(log_speed))
        crossed = -(group.disc_sign * group.slip_sign) * load
        pattern = group.load * group.slip_sign * load
        target = _parts(runs, group, zeros, offset)
        if coulomb is not None:
            target[:, FORCE] -= coulomb[0] * pattern
        replicate, step = _replicates(runs, group)
        count = int(replicate.max()) + 1
        complete = _complete(group, replicate)
        parts = _parted(replicate) if complete and count > 1 else [np.arange(load.size)]
        scale = np.array([1.0, *[group.load] * 3])
        fourth = crossed if checks else None
        operator = operators(design, fourth, parts) / scale[:, None]
        each = np.stack([operator[:, rows] @ target[rows] for rows in parts])
        residual, checked = residuals(design, fourth, operator * scale[:, None], target)
        unknowns = int(np.count_nonzero(np.any(design != 0.0, axis=0)))
        operator /= len(parts)
        independent = replicate if len(parts) > 1 else step if step.max() > _FEWEST_STEPS else None
        return cls(
            group=group,
            each=each,
            time=float(_times(runs, group).mean()),
            replicates=count,
            together=not complete,
            fits_offset=offset,
            coulomb=coulomb,
            slides=slides,
            checks=checks,
            residual=residual,
            checked=checked,
            operator=operator,
            first_rows=np.array([group.rows[rows].min() for rows in parts]),
            step=step,
            freedom=(load.size - unknowns, load.size - unknowns - 1 if checks else 0),
            log_speed=log_speed,
            viscoelastic_force=group.load * design[:, _VISCOELASTIC],
            zero_variance=np.zeros(4) if offset else zeros.variance(group, operator, independent),
            coulomb_variance=np.zeros(4) if coulomb is None else (coulomb[1] * (operator @ pattern)) ** 2,
        )

    def offset(self, weights: Array) -> Array:
        """Zero of each replicate, N."""
        return np.asarray(self.each[:, _OFFSET] @ weights)

    def entry(self, weights: Array, zeros: Zeros) -> Entry:
        """Put the replicates together; `weights` (3,) are those of force, drift and changes of the zero."""
        each = self.each @ weights
        value = each.mean(axis=0)
        count = self.replicates
        if len(each) > 1:
            scatter = each.std(axis=0, ddof=1)
            error, freedom = scatter / np.sqrt(count), np.full(4, count - 1.0)
        else:
            error, freedom = self._errors_together(weights)
            scatter = error * np.sqrt(count)
        unknown = np.array([False, False, not self.slides, not self.checks])
        error, scatter = (np.where(unknown, np.inf, spread) for spread in (error, scatter))
        if not self.fits_offset:
            value[_OFFSET] = zeros.mean(self.group)
        found = Entry(value, error, scatter, freedom, count, self.together, self.slides, self.checks)
        if self.coulomb is not None and self.slides:
            value[_COULOMB], error[_COULOMB] = self.coulomb
            freedom[_COULOMB], scatter[_COULOMB] = np.inf, 0.0
            found = found.widened(self.coulomb_variance * (np.arange(4) == _VISCOELASTIC), np.inf)
        return found.widened(np.where(np.arange(4) == _OFFSET, 0.0, self.zero_variance), zeros.freedom)

    def _errors_together(self, weights: Array) -> tuple[Array, Array]:
        """Return standard errors (4,) and their degrees of freedom from the residuals of all readings.

        Readings of one step share what goes wrong with it: with enough steps the errors are those of sums over steps
        (K.-Y. Liang, S. L. Zeger, Biometrika 73, 13–22, 1986), else readings count each by itself.
        """
        error, freedom = np.full(4, np.inf), np.zeros(4)
        steps = int(self.step.max()) + 1
        for residual, behind, numbers in (
            (self.residual, self.freedom[0], slice(0, 3)),
            (self.checked, self.freedom[1], slice(3, 4)),
        ):
            left, operator = residual @ weights, self.operator[numbers]
            unknowns = left.size - behind
            if behind > 0 and _FEWEST_STEPS <= steps - unknowns < behind:
                sums = np.stack([np.bincount(self.step, row * left) for row in operator])
                freedom[numbers] = steps - unknowns
                error[numbers] = np.sqrt(np.sum(sums**2, axis=1) * steps / (steps - unknowns))
            elif behind > 0:
                freedom[numbers] = behind
                error[numbers] = np.sqrt(np.sum(left**2) / behind * np.sum(operator**2, axis=1))
        return error, freedom


def _parts(runs: TractionRuns, group: Condition, zeros: Zeros, offset: bool) -> Array:
    force = runs.traction_force[group.rows]
    target = np.zeros((force.size, 3))
    time = _times(runs, group)
    if np.all(np.isfinite(time)):
        target[:, DRIFT] = -(time - time.mean())
    known = zeros.of(group)
    if offset:
        target[:, FORCE] = force
        if np.all(np.isfinite(known)):
            target[:, ZERO_CHANGES] = -(known - known.mean())
    else:
        target[:, FORCE] = force - known
        # The zeros that were recorded hold their own drift.
        target[:, DRIFT] = 0.0
    return target


def _times(runs: TractionRuns, group: Condition) -> Array:
    return np.full(group.rows.size, np.nan) if runs.time is None else runs.time[group.rows]


def _replicates(runs: TractionRuns, group: Condition) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Give numbers to the replicates, and to the steps, of a condition's readings.

    The steps are the replicates where there are several, fewer than replicates, each with all configurations: the
    readings of one step are no repetitions of the test.
    """
    _, replicate = np.unique(runs.replicate[group.rows], return_inverse=True)
    if runs.step is None:
        return replicate, np.zeros(replicate.size, dtype=np.intp)
    _, step = np.unique(runs.step[group.rows], return_inverse=True)
    steps_repeat = 0 < step.max() < replicate.max() and _complete(group, step)
    return (step if steps_repeat else replicate), step


def _complete(group: Condition, replicate: NDArray[np.intp]) -> bool:
    """Whether every replicate has all the configurations that there are."""
    pairs = np.unique(10 * replicate.astype(np.int64) + group.configurations)
    return pairs.size == (int(replicate.max()) + 1) * len(group.signs)


def _parted(replicate: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    order = np.argsort(replicate, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(replicate[order])) + 1)
