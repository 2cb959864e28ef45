"""The constants of a shift law that bring ramps at several frequencies onto one curve of log E' and one of log E''.

As for isotherms (`superposition.common_shifts`) the curves follow by linear least squares from given shifts (variable
projection: G. H. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413), and every measured point counts once.  Here
each point has its own temperature, and all shifts are those of one law, so that only its constants are unknown.

A drift of the oven, of the clamping or of the static load gives neighbouring points of a ramp similar errors: an
autoregression of first order along each ramp, for E' and for E''.  Its coefficient and the smoothing of the curve
follow together from the restricted likelihood: if smoothing is chosen as for independent errors, the curve follows the
correlated ones, and the residuals do not show them (J. D. Opsomer, Y. Wang, Y. Yang, Statist. Sci. 16 (2001) 134).

All moduli of a ramp may be too large or too small by one factor, as from clamping anew for each frequency.  Where the
ramps show such offsets, errors of the constants include them; their size is found as that of isotherms.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array, Indices, Mask, Squares, descend
from viscofric.errors import SuperpositionError
from viscofric.rheology.shifts.law_fitting import LARGEST_RELATIVE_ERROR, TITLES, Family, family_of
from viscofric.rheology.shifts.laws import ParametricLaw
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10
from viscofric.rheology.superposition.common_curve import (
    KNOT_SPACING,
    Basis,
    Curves,
    Smoother,
    restricted_likelihood,
)
from viscofric.rheology.superposition.isotherm_offsets import BEFORE, TRENDS, LeftOut, Offsets, estimated
from viscofric.rheology.superposition.shift_problem import inverse_curvature

#: Points per knot.  Near the pole of a law neighbouring points of a ramp are up to a decade apart: with five points per
#: knot, as for isotherms, curves cut the corner of E'' in the glass, and log10 α at the cold end was wrong by 1.6
#: standard errors at 1 % of noise.
POINTS_PER_KNOT = 2
#: Correlations of neighbours that are tried, at equal distances of artanh …
CORRELATIONS = np.tanh(np.linspace(0.0, 2.0, 13))
#: … and their prior weights, equally likely, by the trapezoidal rule.
EQUALLY_LIKELY = np.array([0.5, *np.ones(11), 0.5])


@dataclass(frozen=True, eq=False)
class CorrelatedSmoother(Smoother):
    """Splines through ramps, of m quantities (log E' and log E'') with correlated errors."""

    same: Mask  # (n - 1,), whether a point and the next belong to one ramp
    alike: Array  # (m,), correlation of the errors of neighbouring points

    @classmethod
    def along(
        cls, frequency: Array, moduli: Array, same: Mask, prior: Array = EQUALLY_LIKELY, points: int = POINTS_PER_KNOT
    ) -> CorrelatedSmoother:
        """Place knots for points, ramp by ramp, and choose smoothing and correlation of each quantity."""
        basis = Basis.of(frequency, points)
        criteria = np.array([_likelihood(basis, moduli, same, alike)[2] for alike in CORRELATIONS])
        alike = np.array([expected_correlation(one, prior) for one in criteria.T])
        chosen = [_likelihood(basis, moduli[:, [number]], same, float(one)) for number, one in enumerate(alike)]
        smoothing, scatter = (np.array([one[place][0] for one in chosen]) for place in (0, 1))
        return cls(basis, smoothing, scatter, same, alike)

    def curve(self, modulus: int, frequency: Array, values: Array) -> tuple[Curves, Array, Array]:
        """Draw the curve of one quantity through its values (n,), whitened; return its slopes, and values minus it."""
        found = self.basis.at(frequency)
        alike = float(self.alike[modulus])
        own = Smoother(self.basis, self.smoothing[[modulus]], self.scatter[[modulus]])
        lifted = np.array([whitened(one, self.same, alike) for one in found])
        curves = own.drawn(lifted, whitened(values, self.same, alike)[:, None], None)
        coefficients = curves.coefficients[:, 0]
        return curves, found[1] @ coefficients, values - found[0] @ coefficients


def whitened(values: Array, same: Mask, alike: float) -> Array:
    """Return values (n, …) whitened: the autoregression along each ramp is removed, and variances are equal."""
    found = np.array(values, dtype=float)
    after = np.flatnonzero(same) + 1
    found[after] = (values[after] - alike * values[after - 1]) / np.sqrt(1.0 - alike**2)
    return found


def _likelihood(basis: Basis, moduli: Array, same: Mask, alike: float) -> tuple[Array, Array, Array]:
    """Return smoothing, scatter and −2 log of the restricted likelihood of each quantity at a correlation."""
    smoothing, scatter, criterion = restricted_likelihood(
        whitened(basis.splines[0], same, alike), basis.penalty, whitened(moduli, same, alike)
    )
    return smoothing, scatter, criterion + np.count_nonzero(same) * np.log1p(-(alike**2))


def expected_correlation(criterion: Array, prior: Array) -> float:
    """Return the correlation, given −2 log of the likelihood at `CORRELATIONS`, and their prior weights."""
    # The variance of fitted parameters grows by (1 + ρ)/(1 − ρ), so ρ is chosen by the mean of this factor over the
    # likelihood: for 250 points with ρ = 0.7, the most likely ρ is 0.68, which made standard errors 4 % too small.
    weight = prior * np.exp(0.5 * (criterion.min() - criterion))
    growth = float(np.average((1.0 + CORRELATIONS) / (1.0 - CORRELATIONS), weights=weight))
    return (growth - 1.0) / (growth + 1.0)


def correlation(design: Array, residual: Array, prior: Array) -> float:
    """Return the correlation of neighbours in m series of n residuals (m, n) of least squares, (m, n, p) its design.

    Each series has its own variance; the likelihood is restricted to what no p parameters fit.
    """
    same = np.ones(residual.shape[1] - 1, dtype=bool)
    criteria = np.zeros(len(CORRELATIONS))
    for columns, values in zip(design, residual, strict=True):
        for place, alike in enumerate(CORRELATIONS.tolist()):
            orthogonal, sizes, _ = np.linalg.svd(whitened(columns, same, alike), full_matrices=False)
            used = sizes > _RANK * sizes[0]
            left = whitened(values, same, alike)
            left = left - orthogonal[:, used] @ (orthogonal[:, used].T @ left)
            likelihood = (len(left) - used.sum()) * np.log(np.sum(left**2) + np.finfo(float).tiny)
            criteria[place] += likelihood + 2.0 * np.sum(np.log(sizes[used])) + len(same) * np.log1p(-(alike**2))
    return expected_correlation(criteria, prior)


#: Singular values of a design below this part of the largest are rounding of its differences.
_RANK = 1e-6
#: Activation energies that are tried first, J/mol …
ENERGIES = np.geomspace(3e4, 2e6, 50)
#: … and distances of the pole from the reference, beyond what the coldest point needs, K.
POLES = np.geomspace(1.0, 3e3, 40)
#: Where WLF passes into an Arrhenius law: shares of colder points; and distances of the pole from there, K.
MEETINGS = (0.1, 0.2, 0.3, 0.45, 0.6)
NEAR_POLES = np.geomspace(10.0, 1e3, 15)
#: At least this part of the points lies over others, of temperatures that differ by more than so many K.
SHARED, DIFFERENT = 0.4, 0.05
#: Each pass has knots and smoothing chosen anew.
PASSES, STEPS = 12, 8
#: Changes of the logarithms of the constants: the largest in one step, and in a pass where the search ends.
LARGEST_STEP, CONVERGED = 0.3, 1e-5
#: Relative fall of the cost at which a pass ends.
FALL = 1e-12
#: Passes for offsets; each chooses correlation and smoothing again, which take offsets for correlated errors.
OFFSET_PASSES = 4
#: Offsets are shown where the probability of none falls to this part of what it was before the ramps were seen.
SHOWN = 0.05
#: Smallest part of a vertical shift for differences.
PART = 0.1
#: Step of the logarithm of a constant for differences of the gradient.
DIFFERENCE = 1e-4


@dataclass(frozen=True, eq=False)
class RampPoints:
    """All points of some ramps, ramp by ramp, each in ascending temperature."""

    log_frequency: Array  # (n,), log10 of rad/s
    temperature: Array  # (n,), K
    moduli: Array  # (n, 2), log10 of E' and E'' in Pa, less a vertical shift
    ramp: Array  # (n,), number of the ramp

    @property
    def same(self) -> Mask:
        """Whether each point and the next belong to one ramp."""
        return np.asarray(self.ramp[1:] == self.ramp[:-1])

    def shared(self, reduced: Array) -> float:
        """Return the part of the points that lie over others of another temperature and another ramp."""
        # Points that are pulled apart, each on a piece of curve of its own, would have no scatter.
        place = np.unique(np.floor(reduced / KNOT_SPACING), return_inverse=True)[1]
        size = int(place.max()) + 1
        spans = []
        for values in (self.temperature, self.ramp.astype(float)):
            low, high = np.full(size, np.inf), np.full(size, -np.inf)
            np.minimum.at(low, place, values)
            np.maximum.at(high, place, values)
            spans.append(high - low)
        return float(np.mean(((spans[0] > DIFFERENT) & (spans[1] > 0.0))[place]))


@dataclass(frozen=True, eq=False)
class CommonLaw:
    """The law found, with the covariance of its constants, and the curves that the points fall on."""

    law: ParametricLaw
    residual: Array  # (n, 2), decades
    scatter: Array  # (2,), standard deviation of log E' and log E'' about the curves, decades
    offsets: Array  # (2,), standard deviation of offsets of log E' and log E'' of ramps; zero where none are shown
    left_out: LeftOut | None  # a vertical shift at the points, where none was requested


@dataclass(frozen=True, eq=False)
class _State:
    """Cost and its derivatives by the logarithms of the constants, and by offsets."""

    cost: float
    gradient: Array
    normal: Array
    residual: Array  # (n, 2), decades
    freedom: float


def common_law(points: RampPoints, kind: str, reference: float, *, left_out: bool) -> CommonLaw:
    """Find the constants of a law of a kind ("wlf", "arrhenius" or "wlf+arrhenius") about a reference (K).

    With `left_out` there may be a vertical shift, in proportion to temperature, that was not taken off.
    """
    order = np.argsort(points.temperature, kind="stable")
    family = family_of(kind, points.temperature[order], reference)
    problem = _Problem(points, family, np.argsort(order, kind="stable"), left_out)
    logs = problem.start(kind)
    for _ in range(PASSES):
        before = logs
        smoother = problem.smoother(logs)
        logs = problem.descend(logs, smoother)
        if np.max(np.abs(logs - before)) < CONVERGED:
            break
    smoother = problem.smoother(logs)
    state = problem.state(logs, smoother)
    # Not by the covariance: where the constants are not fixed, rounding decides on its differences.
    if np.linalg.eigvalsh(state.normal)[0] < LARGEST_RELATIVE_ERROR**-2:
        raise SuperpositionError(
            f"the ramps do not fix the constants of the {TITLES[kind]} law; take another law, or ramps over a wider "
            "range of temperatures.",
            code="no-law",
        )
    offsets = problem.offsets(logs)
    constants = np.exp(logs)
    covariance, vertical = _covariance(problem, logs, smoother, state, offsets), None
    if left_out:
        follow = problem.follow(logs, offsets)
        vertical = LeftOut(offsets.trend, problem.trend, follow)
        covariance = covariance + vertical.size**2 * np.outer(follow, follow)
    spread = constants[:, None] * covariance * constants
    sizes = np.sqrt(np.diag(offsets.covariance))
    return CommonLaw(family.law(constants, spread), state.residual, smoother.scatter, sizes, vertical)


class _Problem:
    """What constants of a law are judged by: the curves through points moved by it."""

    def __init__(self, points: RampPoints, family: Family, back: Indices, left_out: bool = False) -> None:
        self.points, self.family, self.back, self.left_out = points, family, back, left_out
        self.trend = np.log10(points.temperature / family.reference)  # of a vertical shift

    def reduced(self, logs: Array) -> Array:
        """Return log10 of the reduced frequencies; their mean does not depend on the law."""
        shifts = self.family.values(np.exp(logs))[self.back]
        reduced = np.asarray(self.points.log_frequency + shifts - shifts.mean())
        if self.points.shared(reduced) < SHARED:
            raise SuperpositionError("the law pulls the points apart, so that hardly any lie over each other.")
        return reduced

    def smoother(self, logs: Array) -> CorrelatedSmoother:
        """Choose knots, smoothing and the correlation of errors again."""
        return CorrelatedSmoother.along(self.reduced(logs), self.points.moduli, self.points.same)

    def misfit(self, logs: Array) -> float:
        """Return the sum of the logarithms of both scatters, infinite where the law does not hold."""
        try:
            return float(np.sum(np.log(Basis.of(self.reduced(logs)).smoother(self.points.moduli).scatter)))
        except (ValueError, np.linalg.LinAlgError):  # `InputError` is one: below the pole
            return np.inf

    def start(self, kind: str) -> Array:
        """Scan activation energies, then the distance of a pole, then the temperature where two laws meet."""
        kelvin, reference = self.points.temperature, self.family.reference
        arrhenius = _Problem(self.points, family_of("arrhenius", np.sort(kelvin), reference), self.back)
        energy = min(ENERGIES, key=lambda one: arrhenius.misfit(np.log([one])))
        if kind == "arrhenius":
            return np.log([energy])
        middle = self._middle()
        slope = energy / (GAS_CONSTANT * LN10 * middle**2)  # decades per kelvin
        coldest = float(kelvin.min())
        trials: list[tuple[float, ...]] = []
        if kind == "wlf":
            for C2 in reference - coldest + POLES:
                trials += [(slope * (C2 + middle - reference) ** 2 / C2, C2)] if C2 > 0.0 else []
        else:
            for place in np.quantile(kelvin, MEETINGS):
                beyond = max(middle - float(place), 0.0)
                trials += [(slope * (C2 + beyond) ** 2 / C2, C2, float(place)) for C2 in NEAR_POLES]
        logs = np.log(np.array(trials))
        misfits = [self.misfit(one) for one in logs]
        if not np.isfinite(np.min(misfits)):
            raise SuperpositionError("no shift law of this kind describes the ramps.", code="no-law")
        return np.asarray(logs[int(np.argmin(misfits))])

    def _middle(self) -> float:
        """Return the temperature about which the frequencies differ most: there the shift is known best."""
        loss = self.points.moduli[:, 1] - self.points.moduli[:, 0]
        return float(self.points.temperature[np.argmax(loss)])

    @property
    def ramps(self) -> int:
        """Number of ramps."""
        return int(self.points.ramp[-1]) + 1

    @property
    def levels(self) -> Array:
        """Columns (n, r + 1) of levels of the ramps, and of a vertical shift."""
        return np.column_stack([np.eye(self.ramps)[self.points.ramp], self.trend])

    def _onto_levels(self, count: int) -> Array:
        """Return rows for constants, levels of E', levels of E'', and a vertical shift of both, if there may be one."""
        every = np.eye(count + 2 * self.ramps + 2)
        first, second = count + self.ramps, count + 2 * self.ramps + 1  # of the vertical shift
        rows = np.delete(every, [first, second], axis=0)
        return np.vstack([rows, every[first] + every[second]]) if self.left_out else rows

    def offsets(self, logs: Array) -> Offsets:
        """Return offsets of the ramps, of variance zero where none are shown."""
        count = len(logs)
        smoother = replace(self.smoother(logs), alike=np.zeros(2))  # else correlation hides the offsets at once
        onto = self._onto_levels(count)
        for _ in range(OFFSET_PASSES):
            state = self.state(logs, smoother, self.levels)
            information, score = onto @ state.normal @ onto.T, onto @ state.gradient
            found = estimated(information, score, np.zeros((count, count)), tied=False, trend=self.left_out)
            expected = found.expected.reshape(2, self.ramps).T[self.points.ramp]
            expected = expected + found.trend @ TRENDS * self.trend[:, None]
            less = _Problem(replace(self.points, moduli=self.points.moduli - expected), self.family, self.back)
            # Constants that have followed offsets leave residuals that look correlated.
            logs = less.descend(logs, replace(smoother, alike=np.zeros(2)))
            smoother = less.smoother(logs)
        if found.sizes.probability[0] > SHOWN * (BEFORE[0] / BEFORE.sum()) ** 2:
            found = replace(found, covariance=np.zeros((2, 2)))
        return found

    def follow(self, logs: Array, offsets: Offsets) -> Array:
        """Return what a vertical shift that was left out adds to the logarithms of the constants found, per part."""
        # By differences, not by the information: as far as there is one, points looked correlated when it was left out.
        part = float(offsets.trend @ TRENDS)
        part = part if abs(part) > PART else PART
        less = _Problem(
            replace(self.points, moduli=self.points.moduli - part * self.trend[:, None]), self.family, self.back
        )
        found = logs
        for _ in range(2):
            found = less.descend(found, less.smoother(found))
        return np.asarray((logs - found) / part)

    def state(self, logs: Array, smoother: CorrelatedSmoother, levels: Array | None = None) -> _State:
        """Draw the curves at these constants and differentiate; both derivatives are those of variable projection.

        With `levels` (n, r), also by offsets of the first modulus and then of the second.
        """
        constants, count = np.exp(logs), len(logs)
        moved = self.family.gradient(constants)[self.back] * constants
        moved = moved - moved.mean(axis=0)
        beside = np.zeros((len(moved), 0)) if levels is None else levels
        reduced, more = self.reduced(logs), beside.shape[1]
        cost, freedom, away = 0.0, 0.0, np.zeros_like(self.points.moduli)
        gradient, normal = np.zeros(count + 2 * more), np.zeros((count + 2 * more, count + 2 * more))
        for modulus, scatter in enumerate(smoother.scatter):
            curves, slope, away[:, modulus] = smoother.curve(modulus, reduced, self.points.moduli[:, modulus])
            columns = np.concatenate([slope[:, None] * moved, beside], axis=1)
            columns = whitened(columns, smoother.same, float(smoother.alike[modulus]))
            onto = curves.basis.T @ columns
            places = np.append(np.arange(count), count + modulus * more + np.arange(more))
            gradient[places] += columns.T @ curves.residual[:, 0] / scatter**2
            normal[np.ix_(places, places)] += (columns.T @ columns - onto.T @ curves.inverse[0] @ onto) / scatter**2
            cost += curves.cost(np.ones(1)) / scatter**2
            freedom += curves.freedom
        return _State(cost, gradient, normal, away, freedom)

    def descend(self, logs: Array, smoother: CorrelatedSmoother) -> Array:
        """Minimise the cost with knots and smoothing held."""

        def at(point: Array) -> Squares:
            try:
                state = self.state(point, smoother)
            except ValueError:  # `InputError` is one: beyond the pole
                return np.inf, lambda: (np.zeros(0), np.zeros((0, 0)))
            return state.cost, lambda: (state.gradient, state.normal)

        return descend(at, logs, iterations=STEPS, tolerance=FALL, largest=LARGEST_STEP, damping=0.0)


def _covariance(
    problem: _Problem,
    logs: Array,
    smoother: CorrelatedSmoother,
    state: _State,
    offsets: Offsets,
) -> Array:
    """Return the covariance of the logarithms of the constants: score about exact curvature, as for isotherms."""
    count = len(logs)
    curvature = np.zeros((count, count))
    for place, way in enumerate(np.eye(count)):
        ahead, behind = (problem.state(logs + sign * DIFFERENCE * way, smoother).gradient for sign in (1.0, -1.0))
        curvature[place] = (behind - ahead) / (2.0 * DIFFERENCE)
    inverse = inverse_curvature(state.normal, 0.5 * (curvature + curvature.T))
    left = max(state.freedom - count, 1.0)
    scattered = state.freedom / left * inverse @ state.normal @ inverse
    if not np.any(offsets.covariance):
        return np.asarray(scattered)
    # The constants found follow offsets as the information of this smoother, which takes them for correlated errors.
    gain = inverse @ problem.state(logs, smoother, np.eye(problem.ramps)[problem.points.ramp]).normal[:count, count:]
    return np.asarray(scattered + gain @ np.kron(offsets.covariance, np.eye(problem.ramps)) @ gain.T)
