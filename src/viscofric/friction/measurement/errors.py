"""Standard errors of separated friction: the pass over a condition is the repetition, not the reading."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Indices, Integers, Mask
from viscofric.friction.curve_checks import SHARED_BY_SPEEDS
from viscofric.friction.measurement.conditions import where
from viscofric.friction.measurement.doubts import CHANCE
from viscofric.friction.measurement.fit import WEAR, Fit
from viscofric.friction.measurement.zeros import ROUNDING
from viscofric.notes import Note
from viscofric.units import shown_number

#: Degrees of freedom from which the scatter of a condition is used alone: Student's t is then 2.8, not 12.7.
_ENOUGH = 4.0
_VISCOELASTIC, _COULOMB, _CONSISTENCY = 1, 2, 3
_AUTOCORRELATIONS = np.linspace(0.0, 0.99, 200)


@dataclass(frozen=True, eq=False)
class Scatter:
    """Deviations between the m repetitions of one condition."""

    deviations: Array  # (m,), from their mean or from the fit
    run: Integers  # (m,), number of the run of the test that each belongs to, the same at all speeds
    freedom: float  # degrees of freedom of the sum of their squares
    factor: float  # variance of the coefficient over that of one repetition

    @property
    def variance(self) -> float:
        """Of the coefficient; infinite without degrees of freedom."""
        if self.freedom <= 0.0:
            return np.inf
        return self.factor * float(np.sum(self.deviations**2)) / self.freedom


def between_runs(fits: list[Fit], weights: Array) -> tuple[Array, Array, list[Note]]:
    """Return standard errors and degrees of freedom (k, 4) of the four values of an `Entry`, and notes on them.

    Errors are infinite where they are not known, their freedom is then zero; `weights` (4,) are those of force and
    corrections.
    """
    scatters = [_scatters(fit, weights) for fit in fits]
    variance = np.array([[one.variance for one in several] for several in scatters])
    freedom = np.array([[one.freedom for one in several] for several in scatters], dtype=np.float64)
    sizes = np.array([_size(fit, weights) for fit in fits])
    alike: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for place, fit in enumerate(fits):
        if sizes[place] > 0.0:
            alike[fit.paired, fit.by_steps, fit.fits_offset, fit.slides, fit.coulomb is None].append(place)
    common: dict[int, float] = {}
    shared = False  # whether the speeds of a run share a part of their residuals
    for places in alike.values():
        isotherms = np.array([fits[place].group.temperature for place in places])
        for number in (_VISCOELASTIC, _COULOMB, _CONSISTENCY):
            some = [scatters[place][number] for place in places]
            pool = Pool.of(some, sizes[places], isotherms)
            shared |= number == _CONSISTENCY and pool.common > 0.0
            for place, one in zip(places, some, strict=True):
                if number == _VISCOELASTIC and pool.common:
                    level = sizes[place] * np.sqrt(one.factor * pool.common)
                    common[place] = float(level / abs(fits[place].mean(weights)[number]))
                if one.freedom < _ENOUGH and one.freedom < pool.freedom:
                    own = variance[place, number] if one.freedom else 0.0
                    variance[place, number] = max(own, one.factor * pool.variance * sizes[place] ** 2)
                    freedom[place, number] = pool.freedom
    # Not for the consistency: it also varies from run to run, which readings within a run do not show.
    lacking = (freedom <= 0.0) & (np.arange(4) != _CONSISTENCY)
    found, autocorrelation = of_readings(fits, weights, lacking)
    for at, (some_variance, some_freedom) in found.items():
        variance[at], freedom[at] = some_variance, some_freedom
    residual = _with_residual(fits, weights, variance, freedom, shared)
    unrepeated = [place for place, number in found if number == _VISCOELASTIC]
    # Exact forces, such as made ones, leave a residual of their rounding.
    rounding = [ROUNDING * np.abs(fit.mean(weights) / [fit.group.load, 1.0, 1.0, 1.0]).sum() for fit in fits]
    error = np.sqrt(variance[:, _VISCOELASTIC])
    left_over = np.isfinite(error) & (error > rounding)
    alone = (not fit.paired and int(fit.passes.max()) + 1 == len(fit.group.signs) for fit in fits)
    once = [at for at, one in enumerate(alone) if one and left_over[at] and at not in unrepeated]
    notes = [
        *_on_residual(fits, residual),
        *_on_few(fits, unrepeated, autocorrelation, once, freedom),
        *_on_runs(fits, common),
    ]
    return np.sqrt(variance), freedom, notes


def _where(fits: list[Fit], places: list[int]) -> str:
    return where([fits[place].group for place in places], len(fits))


@dataclass(frozen=True)
class Pool:
    """Variance of repetitions over many conditions, relative to the square of their friction."""

    variance: float  # of one repetition
    freedom: float  # degrees of freedom of the variance
    common: float  # the part of the variance that all speeds of a run share, zero where it is not significant

    @classmethod
    def of(cls, some: list[Scatter], sizes: Array, isotherms: Array) -> Pool:
        """Analyse the variance, in which the speeds of one run may share a part."""
        # Sums of squares of the means of runs over speeds, and of the rest, each have their own degrees of freedom;
        # those of their sum follow from F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110. They are few where all
        # speeds of a run deviate together, and those of all conditions where they deviate independently.
        between, within = np.zeros((0, 2)), np.zeros((0, 2))
        speeds = 1.0
        for kelvin in np.unique(isotherms):
            here = [(one, size) for one, size, other in zip(some, sizes, isotherms, strict=True) if other == kelvin]
            freedoms = np.array([one.freedom for one, _ in here])
            if not np.any(freedoms > 0.0):
                continue
            deviations = np.concatenate([one.deviations / size for one, size in here if one.freedom > 0.0])
            _, run = np.unique(np.concatenate([one.run for one, _ in here if one.freedom > 0.0]), return_inverse=True)
            count = np.bincount(run)
            shared = float(np.sum(np.bincount(run, deviations) ** 2 / count))
            rest = max(float(np.sum(deviations**2)) - shared, 0.0)
            between = np.vstack([between, [shared, freedoms.max()]])
            within = np.vstack([within, [rest, freedoms.sum() - freedoms.max()]])
            speeds = max(speeds, float(np.mean(count)))
        strata = np.vstack([between, within])
        strata = strata[strata[:, 1] > 0.0]
        squares, freedom = strata.sum(axis=0)
        if squares <= 0.0:
            return cls(0.0, float(freedom), 0.0)
        behind = float(squares**2 / np.sum(strata[:, 0] ** 2 / strata[:, 1]))
        return cls(float(squares / freedom), behind, _common(between.sum(axis=0), within.sum(axis=0), speeds))


def _common(between: Array, within: Array, speeds: float) -> float:
    """Return the variance that the speeds of a run share, from the squares and freedom of means and of the rest."""
    from scipy.special import fdtrc

    if min(between[1], within[1]) <= 0.0 or within[0] <= 0.0:
        return 0.0
    large, small = between[0] / between[1], within[0] / within[1]
    if large <= ROUNDING**2 or fdtrc(between[1], within[1], large / small) > CHANCE:
        return 0.0
    return float((large - small) / speeds)


def _with_residual(fits: list[Fit], weights: Array, variance: Array, freedom: Array, shared: bool) -> list[int]:
    """Add the expected squares of what residuals of the configurations have beyond scatter; return where there are any.

    `variance` and `freedom` (k, 4) are changed.
    """
    # What makes configurations inconsistent, such as wear from one to the next, changes the coefficients by as much as
    # the residual: half of it for even wear in the order of the paper. Replicates measured in one go share it, and do
    # not show it in their scatter. It is taken to be normal with a variance that is a part of that of the scatter, the
    # same at all conditions, and zero unless the residuals are larger than by chance. Their errors, of few degrees of
    # freedom each, are independent, unless they are those of all conditions together, or speeds share them, which are
    # then one. Degrees of freedom of the sums are those after Welch and Satterthwaite, infinite for the residual.
    from scipy.special import chdtrc, fdtrc, ndtri, stdtr

    known = np.all((variance[:, 1:] > 0.0) & np.isfinite(variance[:, 1:]), axis=1)
    some = [place for place, fit in enumerate(fits) if fit.paired and fit.checks and known[place]]
    values = np.array([fits[place].mean(weights) for place in some]).reshape(-1, 4)
    values[:, 0] /= np.array([fits[place].group.load for place in some])
    squares, own = values[:, _CONSISTENCY] ** 2, variance[some, _CONSISTENCY]
    if not some or np.mean(squares) <= (ROUNDING * np.abs(values).max()) ** 2:
        return []
    behind = freedom[some, _CONSISTENCY]
    ratio = float(np.mean(squares / own))
    independent = len({fits[place].group.temperature for place in some}) if shared else len(some)
    by_chance = float(fdtrc(independent, behind.min(), ratio))
    if not shared and all(fits[place].replicates > _ENOUGH for place in some):
        # As normal deviates; the tails of Student's distribution would count those far off for too much.
        normal = ndtri(np.maximum(stdtr(behind, -np.sqrt(squares / own)), np.finfo(float).tiny))
        by_chance = float(chdtrc(len(some), np.sum(normal**2)))
    if ratio <= 1.0 or by_chance >= CHANCE:
        return []
    share = 1.0 - 1.0 / ratio
    more = share**2 * squares + share * own
    for number in (_VISCOELASTIC, _COULOMB):
        freedom[some, number] *= (1.0 + more / variance[some, number]) ** 2
        variance[some, number] += more
    return some


def _on_residual(fits: list[Fit], places: list[int]) -> Iterator[Note]:
    if places:
        yield Note(
            "residual-in-errors",
            f"{_where(fits, places)} the residuals of the four sign configurations are larger than the scatter of "
            "replicates explains, as by wear or a drift from one configuration to the next; the standard errors "
            "include them.",
            values={"conditions": len(places), "of": len(fits)},
        )


def _on_few(
    fits: list[Fit], unrepeated: list[int], autocorrelation: float, once: list[int], freedom: Array
) -> Iterator[Note]:
    if unrepeated:
        yield Note(
            "steps-not-repeated",
            f"{_where(fits, unrepeated)} no step was repeated: the standard errors follow from the scatter within "
            f"steps, whose readings have an autocorrelation of {shown_number(autocorrelation, '.2g')}, and do not "
            "include what varies from run to run; repeat the runs.",
        )
    if once:
        yield Note(
            "errors-from-left-over",
            f"{_where(fits, once)} each configuration was measured once: the standard errors follow from the "
            f"residual of the configurations, with {freedom[once, _VISCOELASTIC].min():.2g} degrees of freedom; "
            "repeat the runs.",
        )


def _on_runs(fits: list[Fit], common: dict[int, float]) -> Iterator[Note]:
    if common:
        level = float(np.median(list(common.values())))
        yield Note(
            SHARED_BY_SPEEDS,
            f"{_where(fits, list(common))} runs differ by the same amount at all speeds, so that the errors of the "
            f"speeds of one temperature are not independent: they have a common error of {100.0 * level:.2g} % of "
            f"viscoelastic friction (level_error = {level:.2g} in shift_friction and identify_material).",
            values={"level_error": level},
        )


def _size(fit: Fit, weights: Array) -> float:
    """Return the friction that deviations are compared with: a coefficient, or a force where they are forces."""
    value = fit.mean(weights)
    size = float(np.hypot(value[_VISCOELASTIC], value[_COULOMB]))
    return size if fit.paired or fit.by_steps else size * fit.group.load


def _scatters(fit: Fit, weights: Array) -> list[Scatter]:
    """Return the deviations between repetitions of a condition, for each of the four numbers."""
    # A change of Coulomb friction in the course of the test is scatter of Coulomb friction.
    unchanged = np.where(np.arange(4) == WEAR, 0.0, weights)
    if fit.paired:
        each = fit.each @ weights
        each[:, _COULOMB] = fit.each[:, _COULOMB] @ unchanged
        run = np.arange(len(each))
        return [Scatter(column - column.mean(), run, len(each) - 1.0, 1.0 / len(each)) for column in each.T]
    found = []
    for number, operator in enumerate(fit.operator):
        left, unknowns = fit.residual @ (unchanged if number == _COULOMB else weights), fit.unknowns
        if number == _CONSISTENCY:
            left, unknowns = fit.checked @ weights, fit.unknowns + 1
        if fit.by_steps:
            # K.-Y. Liang, S. L. Zeger, Biometrika 73, 13–22, 1986.
            sums = np.bincount(fit.step, operator * left).astype(np.float64)
            found.append(Scatter(sums, np.arange(sums.size), sums.size - unknowns, float(sums.size)))
            continue
        means = np.bincount(fit.passes, left) / np.bincount(fit.passes)
        factor = float(np.sum(np.bincount(fit.passes, operator) ** 2))
        found.append(Scatter(means, fit.runs_of_passes, max(means.size - unknowns, 0.0), factor))
    return found


def of_readings(
    fits: list[Fit], weights: Array, lacking: Mask
) -> tuple[dict[tuple[int, int], tuple[float, float]], float]:
    """Estimate the variance of coefficients whose passes leave no residual, from the scatter within the passes."""
    # Readings of a pass are an autoregressive series of first order. Its autocorrelation is that of all passes
    # together, with which the mean products of deviations from means agree in expectation. `weights` (4,) are those of
    # force and corrections; `lacking` (k, 4) marks the numbers of each condition without an error.
    # Returns variance and degrees of freedom by condition and number, where there are several readings in a pass, and
    # the autocorrelation.
    places = [
        place
        for place in np.flatnonzero(np.any(lacking, axis=1)).tolist()
        if fits[place].group.rows.size > int(fits[place].passes.max()) + 1
    ]
    if not places:
        return {}, 0.0
    deviations = {place: _deviations(fits[place], weights) for place in places}
    sizes = np.concatenate([np.bincount(fits[place].passes) for place in places])
    squares = sum(float(np.sum(one**2)) for one in deviations.values())
    products = sum(_products(one, fits[place].passes) for place, one in deviations.items())
    rho = _autocorrelation(products / squares if squares else 0.0, sizes)
    readings = float(np.sum(sizes - 1))
    found = {}
    for place in places:
        fit, size = fits[place], np.bincount(fits[place].passes)
        spread = _of_sums(rho, size) / size  # variance of a mean over that of one independent reading
        scatter = float(np.sum(deviations[place] ** 2)) / float(np.sum(size - _of_sums(rho, size)))
        freedom = (1.0 + rho**2) / (1.0 - rho**2) / float(np.sum(size - 1))
        # Of the logarithm of (1 + ρ)/(1 − ρ), where ρ has the variance (1 − ρ²)/n.
        freedom += 2.0 / (1.0 - rho**2) / readings if rho else 0.0
        for number in np.flatnonzero(lacking[place]).tolist():
            passes = np.bincount(fit.passes, fit.operator[number])
            found[place, number] = (scatter * float(np.sum(passes**2 * spread)), 1.0 / freedom)
    return found, rho


def _deviations(fit: Fit, weights: Array) -> Array:
    """Return the readings minus the means of their passes, N."""
    left = fit.residual @ weights
    return np.asarray(left - (np.bincount(fit.passes, left) / np.bincount(fit.passes))[fit.passes])


def _products(deviations: Array, passes: Indices) -> float:
    order = np.argsort(passes, kind="stable")
    same = passes[order][1:] == passes[order][:-1]
    return float(np.sum((deviations[order][1:] * deviations[order][:-1])[same]))


def _of_sums(rho: float | Array, size: Integers) -> Array:
    """Return the variance of the sum of n readings over n times that of one: 1 + 2 Σ (1 − k/n) ρᵏ over the lags k."""
    n = np.asarray(size, dtype=float)
    return np.asarray((1.0 + rho) / (1.0 - rho) - 2.0 * rho * (1.0 - rho**n) / (n * (1.0 - rho) ** 2))


def _autocorrelation(ratio: float, sizes: Integers) -> float:
    """Return the autocorrelation, not below zero, at which products over squares have this expected ratio."""
    rho = _AUTOCORRELATIONS[:, None]
    size, count = np.unique(sizes, return_counts=True)
    sums = _of_sums(rho, size)
    first = (1.0 - rho**size) / (size * (1.0 - rho))  # mean correlation of the first reading with all
    products = (size - 1) * rho - 2.0 * sums + 2.0 * first + (size - 1) * sums / size
    expected = (products @ count) / ((size - sums) @ count)
    return float(np.interp(ratio, expected, _AUTOCORRELATIONS))
