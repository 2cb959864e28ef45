"""Least squares on the readings of one condition, whose disc may move faster with one direction of slip."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from viscofric.arrays import Array, Indices, Integers, lagrange
from viscofric.friction.measurement.conditions import Condition, equal_rows, where
from viscofric.friction.measurement.zeros import Zeros
from viscofric.notes import Note
from viscofric.traction import TractionRuns

#: Largest derivatives of ln μ_v by ln v, first to fourth.  Loss is a sum of x/(1 + x²) over retardation times; 4000
#: sums of up to four such terms, drawn at random, reached 1.0, 1.0, 1.54 and 3.3.  Rounded up, by half the last one:
#: a maximum of friction half a decade wide, sharper than any of those, has 0.9, 1.1, 2.1 and 5.4.
STEEPEST = (1.0, 1.2, 2.0, 5.0)
#: Standard error of an unknown derivative, over its largest value: more than the 1/√3 of a uniform distribution, since
#: sharp curves reach that value with one sign at many speeds.
_STANDARD = 0.7


@dataclass(frozen=True, eq=False)
class Growth:
    """A polynomial through ln μ_v at up to four speeds, the condition's own first.

    Its remainder is f⁽ᵏ⁾/k! ∏(L − X_j) of the k speeds X_j, with a derivative f⁽ᵏ⁾ no larger than `STEEPEST`; with the
    condition's own speed alone, the remainder is everything.

    Where a maximum of friction was half a decade wide and the disc's speeds differed by 20 or 50 %, 95 % intervals held
    92 % or more of viscoelastic and all of Coulomb friction, at 2, 3, 4 and 6 speeds; where they differed by 100 %, 96
    % and 99 % at 4 speeds, 73 % and 83 % at 6 with a quarter of the noise.  For a power of speed they are too wide,
    those of Coulomb friction three times at 20 % and seven times at 100 %.
    """

    places: Array  # (k,), ln of the speeds over the condition's; the first is zero
    values: Array  # (k,), ln μ_v there
    errors: Array  # (k,), their standard errors

    @classmethod
    def unknown(cls) -> Growth:
        """Return a constant, which uses no other speeds."""
        return cls(np.zeros(1), np.zeros(1), np.zeros(1))

    @classmethod
    def best(cls, places: Array, values: Array, errors: Array, log_speed: Array) -> Growth:
        """Use as many of the nearest speeds (k,) as give the smallest error at `log_speed` (n,)."""
        order = np.argsort(np.abs(places), kind="stable")[: len(STEEPEST)]
        several = [
            cls(places[order[:count]], values[order[:count]], errors[order[:count]])
            for count in range(1, order.size + 1)
        ]

        def uncertain(one: Growth) -> float:
            scatter, rest = one.deviations(log_speed)
            return float(np.sum(scatter**2) + np.sum(rest**2))

        return min(several, key=uncertain)

    @property
    def known(self) -> bool:
        """Whether other speeds are used."""
        return self.places.size > 1

    def log_change(self, log_speed: Array) -> Array:
        """Return ln μ_v at log speeds (n,) minus that at the condition's speed."""
        return self._weights(log_speed) @ self.values

    def deviations(self, log_speed: Array) -> tuple[Array, Array]:
        """Return the standard deviations of `log_change` due to each speed's friction (k, n), and to the rest (n,)."""
        scatter = self.errors[:, None] * self._weights(log_speed).T
        count = self.places.size
        product = np.prod(log_speed[:, None] - self.places, axis=1)
        return scatter, _STANDARD * STEEPEST[count - 1] / math.factorial(count) * product

    def _weights(self, log_speed: Array) -> Array:
        """Return Lagrange's polynomials (n, k) minus their values at the condition's speed."""
        weights = lagrange(self.places, log_speed)
        weights[:, 0] -= 1.0
        return weights


_OFFSET, _VISCOELASTIC, _COULOMB, _CONSISTENCY = range(4)
#: Fewest degrees of freedom of steps of several configurations for errors from their sums.
_FEWEST_STEPS = 3
_MOST_PASSES = 1_000_000_000
_FOUR = {(-1, -1), (-1, 1), (1, -1), (1, 1)}
#: The force as read, and its corrections: drift (per N/s), changes of the recorded zero, and change of Coulomb friction
#: (per s, of itself).
FORCE, DRIFT, ZERO_CHANGES, WEAR = range(4)


@dataclass(frozen=True, eq=False)
class Entry:
    """Zero (N), viscoelastic and Coulomb coefficient and consistency of a condition (4,), in this order."""

    fit: Fit
    value: Array
    error: Array  # infinite where the value is unknown
    scatter: Array
    freedom: Array  # degrees of freedom of each error, infinite where it is exact

    @property
    def group(self) -> Condition:
        """The condition."""
        return self.fit.group

    def widened(self, variance: Array, freedom: float) -> Entry:
        """Add an independent variance (4,) to the squared errors; degrees of freedom after Welch and Satterthwaite."""
        error = np.sqrt(self.error**2 + variance)
        finite = np.isfinite(error) & (variance > 0.0)
        squares = np.full(4, 0.0)
        for part, behind in ((self.error**2, self.freedom), (variance, np.full(4, freedom))):
            share = np.divide(part, error**2, out=np.zeros(4), where=finite)
            squares += np.divide(share**2, behind, out=np.zeros(4), where=finite & (behind > 0.0))
        freedoms = np.divide(1.0, squares, out=np.full(4, np.inf), where=squares > 0.0)
        return replace(self, error=error, freedom=np.where(finite, freedoms, self.freedom))


def operators(design: Array, crossed: Array | None, parts: list[Indices]) -> Array:
    """Return the operators (4, n) from readings to coefficients, for each of several parts separately."""
    # `design` (n, 3) are the regressors (those that are zero throughout are not fitted), `crossed` (n,) a fourth one,
    # whose coefficient is fitted without changing those of the others; each of `parts`, rows that are fitted together,
    # determines all coefficients. The columns of a part hold (XᵀX)⁻¹Xᵀ, by the QR factors of X: the fit without
    # `crossed` has the leading ones of the fit with it. The sums of squares are the diagonal of (XᵀX)⁻¹.
    used = np.flatnonzero(np.any(design != 0.0, axis=0))
    columns = design[:, used] if crossed is None else np.column_stack([design[:, used], crossed])
    operator = np.zeros((4, len(design)))
    for size in {part.size for part in parts}:
        rows = np.stack([part for part in parts if part.size == size])
        orthogonal, triangle = np.linalg.qr(columns[rows])
        inverse = np.linalg.inv(triangle)
        leading = inverse[:, : used.size, : used.size] @ np.swapaxes(orthogonal[:, :, : used.size], 1, 2)
        operator[used[:, None, None], rows] = np.swapaxes(leading, 0, 1)
        if crossed is not None:
            operator[3, rows] = np.einsum("kmp,kp->km", orthogonal, inverse[:, -1])
    return operator


def residuals(design: Array, crossed: Array | None, operator: Array, target: Array) -> tuple[Array, Array]:
    """Return the residuals of `target` (n, k) of fits of all readings, without and with the fourth regressor."""

    def left(values: Array) -> Array:
        return np.asarray(values - design @ (operator[:3] @ values))

    plain = left(target)
    if crossed is None:
        return plain, plain
    return plain, plain - left(crossed[:, None]) * (operator[3] @ target)


@dataclass(frozen=True, eq=False)
class Fit:
    """Least squares on the readings of a condition, of the force and of its corrections."""

    group: Condition
    # (r, 4, 4): zero, viscoelastic and Coulomb coefficient and consistency of each replicate (of all readings where
    # they are fitted together), of the force and of its corrections
    each: Array
    times: Array = field(repr=False)  # (n,), of the readings, s; NaN where they were not recorded
    recorded: float  # mean of the recorded zero, N; NaN where it is not known
    replicates: int
    together: bool
    fits_offset: bool
    coulomb: tuple[float, float] | None
    slides: bool
    checks: bool
    residual: Array = field(repr=False)  # (n, 4), of the fit without the consistency, N
    checked: Array = field(repr=False)  # (n, 4), of the fit with it, N
    operator: Array = field(repr=False)  # (4, n), from readings to coefficients
    first_rows: Integers = field(repr=False)  # (r,), first row of the readings behind each entry of `each`
    step: Indices = field(repr=False)  # (n,), number of each reading's step within the condition
    passes: Indices = field(repr=False)  # (n,), number of its pass in one configuration
    # (p,), number of the run of each pass, the same at all speeds: its configuration and how often that came before
    runs_of_passes: Integers = field(repr=False)
    unknowns: int  # number of fitted coefficients, without the consistency
    by_steps: bool  # whether steps of several configurations, enough of them, are the repetitions
    log_speed: Array = field(repr=False)  # (n,), ln of the disc's speed over the condition's
    # (n,), N, for a viscoelastic coefficient of 1 at the condition's speed
    viscoelastic_force: Array = field(repr=False)
    zero_variance: Array  # (4,), due to the error of a zero that is not fitted, within the limits that scatter sets
    coulomb_variance: Array  # (4,), the same of a Coulomb coefficient that is not fitted

    @classmethod
    def of(
        cls,
        runs: TractionRuns,
        group: Condition,
        zeros: Zeros,
        coulomb: tuple[float, float] | None = None,
        growth: Growth | None = None,
    ) -> Fit:
        """Fit a condition's readings, each replicate separately where all are complete."""
        # `zeros` are used where the signs do not determine the zero; `coulomb` is the coefficient and its standard
        # error where they are assumed; `growth` is the change of viscoelastic friction with speed within the condition,
        # none if None.
        slides = bool(np.any(group.slip_sign))
        checks = coulomb is None and group.signs >= _FOUR
        offset = zeros.fitted(group, coulomb=coulomb is None)
        load = runs.load[group.rows] / group.load
        design = group.regressors(offset=offset, coulomb=coulomb is None)
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
        passes, runs_of_passes = _passes(group, step)
        count = int(replicate.max()) + 1
        complete = _complete(group, replicate)
        parts = equal_rows(replicate) if complete and count > 1 else [np.arange(load.size)]
        scale = np.array([1.0, *[group.load] * 3])
        fourth = crossed if checks else None
        operator = operators(design, fourth, parts) / scale[:, None]
        if coulomb is None:
            change = pattern * float(operator[_COULOMB] @ target[:, FORCE]) / len(parts)
            target[:, WEAR] = _earlier(runs, group) * change
        each = np.stack([operator[:, rows] @ target[rows] for rows in parts])
        residual, checked = residuals(design, fourth, operator * scale[:, None], target)
        unknowns = int(np.count_nonzero(np.any(design != 0.0, axis=0)))
        operator /= len(parts)
        by_steps = len(parts) == 1 and step.max() < passes.max() and step.max() + 1 - unknowns >= _FEWEST_STEPS
        independent: Indices | None = replicate
        if len(parts) == 1:
            independent = step if by_steps else passes if passes.max() >= unknowns else None
        return cls(
            group=group,
            each=each,
            times=_times(runs, group),
            recorded=zeros.mean(group),
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
            passes=passes,
            runs_of_passes=runs_of_passes,
            unknowns=unknowns,
            by_steps=bool(by_steps),
            log_speed=log_speed,
            viscoelastic_force=group.load * design[:, _VISCOELASTIC],
            zero_variance=np.zeros(4) if offset else zeros.variance(group, operator, independent),
            coulomb_variance=np.zeros(4) if coulomb is None else (coulomb[1] * (operator @ pattern)) ** 2,
        )

    @property
    def time(self) -> float:
        """Mean time of the readings, s; NaN where it was not recorded."""
        return float(self.times.mean())

    def offset(self, weights: Array) -> Array:
        """Zero of each replicate, N; above the recorded one where its changes are followed."""
        zero = np.asarray(self.each[:, _OFFSET] @ weights)
        return zero - weights[ZERO_CHANGES] * self.recorded if weights[ZERO_CHANGES] else zero

    @property
    def assumes(self) -> bool:
        """Whether there is Coulomb friction that is not fitted."""
        return self.coulomb is not None and self.slides

    @property
    def paired(self) -> bool:
        """Whether there are several replicates, each with all configurations and fitted by itself."""
        return len(self.each) > 1

    def mean(self, weights: Array) -> Array:
        """Zero, viscoelastic and Coulomb coefficient and consistency, the means over the replicates."""
        return np.asarray((self.each @ weights).mean(axis=0))

    def entry(self, weights: Array, zeros: Zeros, error: Array, freedom: Array) -> Entry:
        """Return the result over all replicates; `weights` (4,) are those of force and corrections."""
        value, freedom = self.mean(weights), freedom.copy()
        scatter = error * np.sqrt(self.replicates)
        unknown = np.array([False, False, not self.slides, not self.checks])
        error, scatter = (np.where(unknown, np.inf, spread) for spread in (error, scatter))
        if not self.fits_offset:
            value[_OFFSET] = zeros.mean(self.group)
        found = Entry(self, value, error, scatter, freedom)
        if self.coulomb is not None and self.slides:
            value[_COULOMB], error[_COULOMB] = self.coulomb
            freedom[_COULOMB], scatter[_COULOMB] = np.inf, 0.0
            found = found.widened(self.coulomb_variance * (np.arange(4) == _VISCOELASTIC), np.inf)
        return found.widened(np.where(np.arange(4) == _OFFSET, 0.0, self.zero_variance), zeros.freedom)


def _parts(runs: TractionRuns, group: Condition, zeros: Zeros, offset: bool) -> Array:
    force = runs.traction_force[group.rows]
    target = np.zeros((force.size, 4))
    known = zeros.of(group)
    if offset:
        target[:, FORCE] = force
        target[:, DRIFT] = _earlier(runs, group)
        if np.all(np.isfinite(known)):
            target[:, ZERO_CHANGES] = -(known - known.mean())
    else:
        # Recorded zeros include their own drift.
        target[:, FORCE] = force - known
    return target


def _times(runs: TractionRuns, group: Condition) -> Array:
    return np.full(group.rows.size, np.nan) if runs.time is None else runs.time[group.rows]


def _earlier(runs: TractionRuns, group: Condition) -> Array:
    """Return by how much readings are before their mean time, s; zero where it was not recorded."""
    time = _times(runs, group)
    return np.asarray(time.mean() - time) if np.all(np.isfinite(time)) else np.zeros(time.size)


def _replicates(runs: TractionRuns, group: Condition) -> tuple[Indices, Indices]:
    """Return the indices of the replicates, and of the steps, of a condition's readings."""
    # Readings of one step are no repetitions of the test. Where their replicate numbers differ, the steps are the
    # replicates if each has all configurations; else the first step of each configuration is in the first replicate.
    _, replicate = np.unique(runs.replicate[group.rows], return_inverse=True)
    if runs.step is None:
        return replicate, replicate
    step = _steps(runs.step, group, replicate)
    if np.unique(np.column_stack([step, replicate]), axis=0).shape[0] == int(step.max()) + 1:
        return replicate, step
    if _complete(group, step):
        return step, step
    passes, run = _passes(group, step)
    return (run % _MOST_PASSES)[passes].astype(np.intp), step


def _steps(step: Integers, group: Condition, replicate: Indices) -> Indices:
    """Return indices of the steps of a condition; those that a test numbers again in each run, by their runs."""
    block = np.concatenate([[0], np.cumsum(np.diff(step) != 0)])[group.rows]
    _, block = np.unique(block, return_inverse=True)
    _, number = np.unique(step[group.rows], return_inverse=True)
    # A step whose rows are not adjacent is still one step if nothing else distinguishes them.
    parts = np.unique(np.column_stack([number, replicate, group.configurations, block]), axis=0)
    apart = len(np.unique(parts[:, :3], axis=0)) < len(parts)
    return np.asarray(number if apart else block, dtype=np.intp)


def _passes(group: Condition, step: Indices) -> tuple[Indices, Integers]:
    """Return numbers of the passes, a step in one configuration each, and of the run of each pass."""
    configuration = group.configurations - group.configurations.min()
    pairs, passes = np.unique(np.column_stack([configuration, step]), axis=0, return_inverse=True)
    first = np.searchsorted(pairs[:, 0], pairs[:, 0])
    return passes.reshape(-1), _MOST_PASSES * pairs[:, 0] + np.arange(len(pairs)) - first


def _complete(group: Condition, replicate: Indices) -> bool:
    """Whether every replicate has all the configurations that there are."""
    pairs = np.unique(10 * replicate.astype(np.int64) + group.configurations)
    return pairs.size == (int(replicate.max()) + 1) * len(group.signs)


# --- tests whose disc moves faster with one direction of slip than with the other ---------------------------


@dataclass(frozen=True, eq=False)
class Uneven:
    """Difference of the disc's speed between the directions of slip, and its effect on each condition.

    Coulomb friction, half the difference of the forces, then includes half the change of viscoelastic friction between
    the two speeds, and their mean is not the friction at the mean speed.  The change is removed where it follows from
    the other speeds of the test; its uncertainty is in the standard errors.
    """

    apart: Array  # (k,), difference of the speeds over the condition's; zero where it is within the tolerance
    growths: list[Growth | None] = field(repr=False)  # None where the speeds are the same

    @classmethod
    def of(cls, runs: TractionRuns, groups: list[Condition], tolerance: float) -> Uneven:
        """Compare the speeds of the disc where it is faster than the ball with those where it is slower."""
        apart = np.array([_apart(runs, group) for group in groups])
        apart = np.where(np.abs(apart) > tolerance, apart, 0.0)
        return cls(apart, [Growth.unknown() if one else None for one in apart.tolist()])

    def __bool__(self) -> bool:
        return bool(np.any(self.apart))

    def with_growths(self, bare: list[Entry], entries: list[Entry]) -> Uneven:
        """Return the change of friction from that at the speeds of each temperature and load."""
        # The standard errors of `entries` include the uncertainty of the change of friction, those of `bare` do not.
        growths = list(self.growths)
        for place in np.flatnonzero(self.apart).tolist():
            own = bare[place]
            growths[place] = _growth(own, [one for one in entries if own.group.alike(one.group)])
        return Uneven(self.apart, growths)

    def widened(self, place: int, entry: Entry) -> Entry:
        """Add the uncertainty of the change of friction to the standard errors of a condition."""
        growth, fit = self.growths[place], entry.fit
        if growth is None:
            return entry
        scatter, rest = growth.deviations(fit.log_speed)
        force = abs(entry.value[1]) * fit.viscoelastic_force
        by_scatter, by_rest = (
            np.sum((fit.operator @ (force * np.atleast_2d(some)).T) ** 2, axis=1) for some in (scatter, rest)
        )
        return entry.widened(by_scatter, entry.freedom[1]).widened(by_rest, np.inf)

    def notes(self, entries: list[Entry]) -> Iterator[Note]:
        """Yield notes on conditions where the speeds differ."""
        largest = 100 * float(np.abs(self.apart).max(initial=0.0))
        for taken in (True, False):
            every = zip(self.growths, entries, strict=True)
            found = [entry for growth, entry in every if growth is not None and growth.known == taken]
            if not found:
                continue
            what = (
                "is removed as far as it follows from friction at the other speeds; the rest is in the standard errors"
                if taken
                else "cannot be removed without other speeds, and half of it is in Coulomb friction; the standard "
                f"errors allow for a change as steep as speed itself{_size(found)}"
            )
            yield Note(
                "speed-differs",
                f"{where([entry.group for entry in found], len(entries))} the disc's speed differs by up to "
                f"{largest:.2g} % between directions of slip; the change of viscoelastic friction between them {what}.",
                values={
                    "conditions": len(found), "of": len(entries), "difference": 0.01 * largest, "removed": taken,
                },
            )  # fmt: skip


def _size(found: list[Entry]) -> str:
    errors = [entry.error[2] for entry in found if np.isfinite(entry.error[2])]
    return f" and are up to ±{max(errors):.2g}" if errors else ""


def _apart(runs: TractionRuns, group: Condition) -> float:
    faster = group.slip_sign == group.disc_sign
    if not np.any(group.slip_sign) or np.all(faster) or not np.any(faster):
        return 0.0
    speed = np.abs(runs.disc_speed[group.rows])
    return float(speed[faster].mean() - speed[~faster].mean()) / group.speed


def _growth(own: Entry, others: list[Entry]) -> Growth:
    """Return the change of friction about a condition's speed, from others at its temperature and load."""
    here = own.group
    # Of several slips at one speed, the nearest.
    at_speed = {here.speed: own}
    for one in others:
        group = one.group
        usable = one.value[1] > 0.0 and (np.isfinite(one.error[1]) or not np.isfinite(own.error[1]))
        if not usable or group.speed == here.speed:
            continue
        slip = abs(group.slip / group.speed - here.slip / here.speed)
        other = at_speed.get(group.speed)
        if other is None or slip < abs(other.group.slip / group.speed - here.slip / here.speed):
            at_speed[group.speed] = one
    if own.value[1] <= 0.0:
        return Growth.unknown()
    friction = np.array([one.value[1] for one in at_speed.values()])
    errors = np.array([one.error[1] for one in at_speed.values()])
    return Growth.best(
        np.log(np.array(list(at_speed)) / here.speed),
        np.log(friction),
        np.where(np.isfinite(errors), errors, 0.0) / friction,
        own.fit.log_speed,
    )
