"""Shifts of all isotherms together onto one smooth curve of E' and one of E'', with their covariance.

For given shifts the common curves follow by linear least squares (`common_curve`), so only the shifts are sought
(variable projection: G. H. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413).  Every measured point is used once,
so that the covariance of the shifts is meaningful; pairwise overlaps would use it repeatedly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array
from viscofric.rheology.superposition.common_curve import Smoother
from viscofric.rheology.superposition.isotherm_offsets import (
    LARGEST,
    TRENDS,
    USUAL,
    IsothermOffsets,
    LeftOut,
    Offsets,
    OffsetSizes,
    estimated,
)
from viscofric.rheology.superposition.joined_isotherms import BOTH, Quantities
from viscofric.rheology.superposition.overlap import PAIR_UNCERTAINTY, SMALLEST_NOISE, Join, LogSweep, join, parted
from viscofric.rheology.superposition.shift_problem import (
    Gauge,
    ShiftProblem,
    continued,
    continued_covariance,
    identified,
    inverse_curvature,
)
from viscofric.rheology.superposition.step_profiles import StepProfiles, most_likely

OFFSET_PASSES = 3  # each smooths the curves again, with the offsets found
#: Sizes of offsets of step tests that are averaged over, decades, and their probabilities before any test is seen, by a
#: half-Cauchy density half as wide as that of sweeps.  Many sets say little of the size, so that this choice matters:
#: with the density of sweeps, errors where curves are steep are a fifth larger.
TEST_SIZES = np.array([0.0, 0.0025, 0.0063, 0.016, 0.04])
BEFORE_TESTS = np.diff(np.arctan(np.array([0.0, 0.0008, 0.004, 0.01, 0.025, 0.1]) / (0.5 * USUAL)))
NEGLIGIBLE = 0.01  # probability of a size that is left out
#: With a smaller probability of a vertical shift above half of T/T0, a linear step to that of T/T0 suffices.
SMALL_CHANCE = 0.05
LARGEST_STEP = 0.3  # decades, in one iteration
PASSES = 8  # each chooses knots and smoothing again
CONVERGED = 1e-5  # decades
FINEST = 3e-4  # decades; moduli that scatter less were not measured


@dataclass(frozen=True, eq=False)
class CommonShifts:
    """Shifts of n isotherms, zero at the reference, and their covariances (n, n), in decades."""

    values: Array  # (n,), log10 α
    covariance: Array
    vertical: Array  # (n,), log10 b
    vertical_covariance: Array
    cross_covariance: Array  # of log10 α (rows) with log10 b (columns)
    parted: tuple[int, ...] = ()  # neighbours joined pair by pair because a common curve moved them apart
    freedom: float = np.inf  # of the scatter of the points
    offsets: IsothermOffsets | None = None  # of whole isotherms, where fitted


def common_shifts(
    sweeps: list[LogSweep], joins: list[Join], gauge: Gauge, quantities: Quantities = BOTH
) -> CommonShifts:
    """Shift isotherms (ascending in temperature, two points or more each) onto one curve of log E' and of log E''."""
    # Where a vertical shift may have been left out, errors include what b = T/T0 would make of α, in proportion to the
    # part of it; and with the probability that it is more than half of that, errors are those beside it, as where it
    # turns what looks like a slope into a plateau.
    found = _with_plateaus(sweeps, joins, gauge, quantities)
    if gauge.trend is None or found.offsets is None or found.offsets.left_out is None:
        return found
    left_out, covariance = found.offsets.left_out, found.covariance
    large = float(left_out.probability @ (TRENDS > 0.5))
    if large > SMALL_CHANCE:
        lowered = [replace(one, moduli=one.moduli - by) for one, by in zip(sweeps, gauge.trend, strict=True)]
        other = _with_plateaus(lowered, joins, replace(gauge, left_out=False), quantities)
        left_out = replace(left_out, follow=found.values - other.values)
        covariance = covariance + large * (other.covariance - covariance)
    return replace(
        found,
        covariance=covariance + np.outer(left_out.errors[0], left_out.errors[0]),
        offsets=replace(found.offsets, left_out=left_out),
    )


def _with_plateaus(sweeps: list[LogSweep], joins: list[Join], gauge: Gauge, quantities: Quantities) -> CommonShifts:
    """Shift isotherms, and continue the shifts over plateaus at both ends."""
    # E' and E'' have equal weights; the covariance follows from the scatter of each. `joins` of each isotherm with the
    # next are the start of the search. Plateaus at the cold and the hot end, where the slope of the curves is noise,
    # are left out of the fit; their shifts continue the trend of the others (`continued`). With vertical shifts
    # they are kept, since plateaus determine these. Where neighbours disagree by many times the typical misfit,
    # superposition itself fails, and one flexible curve would hide that by moving them apart. There each side gets its
    # own curve, and the two are joined where the two neighbours overlap best, with that join's uncertainty. The same is
    # done, with an uncertainty of at least half a decade, where a common curve moves neighbours apart
    # (`overlap.parted`): sweeps that overlap little, that disagree in E'' alone, as at a resonance of the instrument,
    # or that show noise alone, as on a plateau, do not increase the misfit of a flexible curve once they are apart,
    # where nothing tests their shift. `sweeps` contain the moduli
    # measured. The `quantities` shifted may be one of them or tan δ, or have other weights; `joins` are those of the
    # quantities.
    search, apart = _torn_apart(sweeps, joins, gauge, quantities)
    inside = identified(search.signal, gauge)
    if inside is None:
        return replace(_with_offsets(search, sweeps, quantities), parted=tuple(sorted(apart)))
    first, last = inside
    part = sweeps[first:last]
    search, apart = _torn_apart(part, joins[first : last - 1], gauge.within(first, last), quantities)
    found = _with_offsets(search, part, quantities)
    nothing = np.zeros(len(sweeps))
    return replace(
        found,
        values=continued(found.values, gauge, first, last),
        covariance=continued_covariance(found.covariance, found.values, gauge, first, last),
        vertical=nothing,
        vertical_covariance=np.diag(nothing),
        cross_covariance=np.diag(nothing),
        parted=tuple(sorted(place + first for place in apart)),
        offsets=None if found.offsets is None else found.offsets.continued(gauge, first, last),
    )


def fitted(sweeps: list[LogSweep], joins: list[Join], gauge: Gauge) -> CommonShifts:
    """Fit all isotherms of any quantities without offsets; errors follow from the scatter of the points."""
    search = _search(ShiftProblem(sweeps, joins, gauge), joins)
    covariance, freedom, _ = _covariance(search)
    return _result(search, covariance, freedom)


@dataclass(frozen=True, eq=False)
class _Search:
    """State of a search for the shifts: parameters, curves, and the scatter about them."""

    problem: ShiftProblem
    parameters: Array
    smoothers: list[Smoother]
    noise: float

    @property
    def signal(self) -> Array:
        """Squared slope of the curves at each isotherm, in units of its noise, (n,)."""
        return self.problem.signal(self.parameters, self.smoothers)


def _torn_apart(
    sweeps: list[LogSweep], joins: list[Join], gauge: Gauge, quantities: Quantities
) -> tuple[_Search, set[int]]:
    """Fit all isotherms, join those pair by pair that the fit moves apart, and return their indices too."""
    apart: set[int] = set()
    held = {place for place in gauge.held if place + 1 in gauge.held}
    shifted = quantities.of(sweeps)
    while True:
        search = _search(ShiftProblem(shifted, joins, gauge, apart, quantities.weights), joins)
        values, _ = search.problem.split(search.parameters)
        more = set(parted(sweeps, values)) - apart - held
        if not more:
            return search, apart
        apart |= more
        joins = list(joins)
        for place in more:
            one = join(shifted[place], shifted[place + 1], search.noise)
            joins[place] = replace(one, uncertainty=max(one.uncertainty, PAIR_UNCERTAINTY))


def _search(problem: ShiftProblem, joins: list[Join]) -> _Search:
    """Find the shifts, starting from the joins of neighbours."""
    shifts = problem.gauge.brought_to(-np.concatenate([[0.0], np.cumsum([found.step for found in joins])]))
    parameters = np.concatenate([shifts, np.zeros(len(problem.start) - problem.size)])
    for _ in range(PASSES):
        smoothers = problem.smoothers(parameters)
        noise = _noise(problem, smoothers)
        before = parameters
        parameters = _descend(problem, parameters, smoothers, noise)
        if np.max(np.abs(parameters - before)) < 10 * CONVERGED:
            break
    return _Search(problem, parameters, smoothers, noise)


def _with_offsets(search: _Search, sweeps: list[LogSweep], quantities: Quantities) -> CommonShifts:
    """Continue with offsets of whole isotherms; errors include these, and the profiles of the steps."""
    # A curve of one modulus hardly shows offsets, since a shift takes most of each. Where one quantity is shifted, both
    # moduli, with shifts of their own, show the offsets that its errors include; the shifts found depend on it alone.
    search, own, gradient = _beside_offsets(search)
    if search.problem.moduli == 1 and not quantities.alone and not search.problem.gauge.free_vertical:
        return _with_offsets_of_tests(search, own, quantities.of(sweeps), quantities.onto_moduli)
    problem, offsets, seen, onto = search.problem, own, np.eye(len(own.covariance)), quantities.onto_moduli
    if quantities.alone:
        both = _of_both(sweeps, problem.gauge)
        if both.sizes.probability @ (np.mean(both.sizes.deviations**2, axis=1) > LARGEST**2) <= 0.5:
            offsets, seen, onto = both, quantities.seen, np.eye(2)
    covariance, freedom, inverse = _covariance(search, own.expected)
    size, moduli = problem.size, problem.moduli
    gain = inverse @ gradient / search.noise**2
    follow = np.zeros((2 * size, seen.shape[1] * size))
    follow[: len(gain)] = gain @ np.kron(seen @ offsets.covariance, np.eye(size))
    spread = np.kron(seen @ offsets.covariance @ seen.T, np.eye(size))
    levels = spread + np.kron(np.ones((moduli, moduli)), problem.vertical_prior())
    profiles = StepProfiles(problem, search.smoothers, quantities.of(sweeps), levels)
    covariance = profiles.widened(search.parameters, inverse, covariance, covariance + gain @ spread @ gain.T)
    left_out = _left_out(problem, offsets, gain)
    found = IsothermOffsets(offsets.covariance, follow, offsets.sizes, onto, left_out)
    return replace(_result(search, covariance, freedom), offsets=found)


def _left_out(problem: ShiftProblem, offsets: Offsets, gain: Array) -> LeftOut | None:
    """Return a vertical shift that may have been left out, for shifts that follow levels by `gain` (n, m n)."""
    trend, both = problem.gauge.trend, problem.trend
    return None if trend is None or both is None else LeftOut(offsets.trend, trend, gain @ both)


def _with_offsets_of_tests(search: _Search, offsets: Offsets, sweeps: list[LogSweep], onto: Array) -> CommonShifts:
    """Continue to the most likely shifts of step tests, averaged over the sizes that offsets may have."""
    # The data leave the size of offsets open; without them the levels determine the shifts, beside large ones the
    # bends. So all of it is done for some sizes, with the weight of each by its likelihood, integrated over the shifts
    # as a normal distribution (D. J. C. MacKay, Neural Comput. 4 (1992) 415). Where residuals are correlated even
    # without the offsets, the variance of the points is increased.
    problem, ways, n = search.problem, search.problem.ways, search.problem.size
    freedom = _covariance(search, offsets.expected)[1]
    information, _, _ = problem.with_offsets(search.parameters, search.smoothers, None)
    across = information[:n, n:]
    excess = problem.inflations(search.parameters, search.smoothers, offsets.expected)
    parameters, tried, evidence = search.parameters, [], []
    for variance in TEST_SIZES**2:
        follow = across @ np.linalg.inv(np.eye(n) + variance * information[n:, n:])
        normal = information[:n, :n] - variance * follow @ across.T + problem.prior.T @ problem.prior
        scale = ways @ np.linalg.inv(np.linalg.cholesky(ways.T @ normal @ ways)).T
        profiles = StepProfiles(problem, search.smoothers, sweeps, variance * np.eye(n), excess)
        parameters, covariance = most_likely(profiles.in_parts, parameters, scale)
        tried.append((profiles, parameters, covariance, covariance @ follow))
        evidence.append(np.linalg.slogdet(ways.T @ covariance @ ways)[1] - profiles(parameters[None])[0])
    weights = BEFORE_TESTS * np.exp(0.5 * (np.array(evidence) - max(evidence)))
    weights *= weights > NEGLIGIBLE * weights.sum()
    weights /= weights.sum()
    mean = weights @ np.array([parameters for _, parameters, *_ in tried])
    total, gain, with_shifts = np.zeros((n, n)), np.zeros((n, n)), np.zeros((2 * n, n))
    for weight, size, (profiles, parameters, covariance, follow) in zip(weights, TEST_SIZES, tried, strict=True):
        if weight > 0.0:
            total += weight * (profiles.errors(parameters, covariance) + np.outer(parameters - mean, parameters - mean))
            gain += weight * follow
            with_shifts[:n] += weight * size**2 * follow
    shared, sizes = np.array([[weights @ TEST_SIZES**2]]), OffsetSizes(TEST_SIZES[:, None], weights)
    return replace(
        _result(replace(search, parameters=mean), total, freedom),
        offsets=IsothermOffsets(shared, with_shifts, sizes, onto, _left_out(problem, offsets, gain)),
    )


def _beside_offsets(search: _Search) -> tuple[_Search, Offsets, Array]:
    """Continue with offsets of the quantities shifted; return these, and their effect on the gradient."""
    problem = search.problem
    offsets, gradient = _offsets(search, None)
    for _ in range(OFFSET_PASSES):
        smoothers = problem.smoothers(search.parameters, offsets.expected)
        noise = _noise(problem, smoothers)
        search = _Search(problem, _descend(problem, search.parameters, smoothers, noise), smoothers, noise)
        offsets, gradient = _offsets(search, offsets.expected)
    return search, offsets, gradient


def _of_both(sweeps: list[LogSweep], gauge: Gauge) -> Offsets:
    """Return the offsets of isotherms that E' and E'' show together."""
    joins = [join(colder, warmer) for colder, warmer in pairwise(sweeps)]
    return _beside_offsets(_torn_apart(sweeps, joins, gauge, BOTH)[0])[1]


def _result(search: _Search, covariance: Array, freedom: float) -> CommonShifts:
    """Separate horizontal from vertical shifts."""
    problem, size = search.problem, search.problem.size
    values, vertical = problem.split(search.parameters)
    nothing = np.zeros((size, size))
    free = problem.gauge.free_vertical
    spread, cross = (covariance[size:, size:], covariance[:size, size:]) if free else (nothing, nothing)
    return CommonShifts(values, covariance[:size, :size], vertical, spread, cross, freedom=freedom)


def _noise(problem: ShiftProblem, smoothers: list[Smoother]) -> float:
    """Return the scatter of the moduli about the curves, decades."""
    weights = np.array([len(piece.frequency) for piece in problem.pieces], dtype=float)
    squares = np.array([np.average(smoother.scatter**2, weights=problem.weights) for smoother in smoothers])
    return float(np.sqrt(weights @ squares / weights.sum())) + SMALLEST_NOISE


def _descend(problem: ShiftProblem, parameters: Array, smoothers: list[Smoother], noise: float) -> Array:
    """Take damped Gauss–Newton steps with knots and smoothing held."""
    ways = problem.ways
    state = problem.state(parameters, smoothers, noise)
    for _ in range(5):
        step = ways @ np.linalg.solve(ways.T @ state.normal @ ways, ways.T @ state.gradient)
        largest = float(np.max(np.abs(np.diff(step))))
        step *= min(1.0, LARGEST_STEP / max(largest, 1e-300))
        trial = problem.state(parameters + step, smoothers, noise)
        while trial.cost > state.cost and np.max(np.abs(step)) > CONVERGED:
            step *= 0.5
            trial = problem.state(parameters + step, smoothers, noise)
        parameters, state = parameters + step, trial
        if np.max(np.abs(step)) < CONVERGED:
            break
    return parameters


def _covariance(search: _Search, expected: Array | None = None) -> tuple[Array, float, Array]:
    """Return the covariance of the shifts, the degrees of freedom of the scatter, and the inverse of the curvature."""
    # The exact second derivatives are taken, not those of Gauss and Newton, which take the noise in the slope of the
    # curves for information. Where they are small or negative (a plateau, far from quadratic), a part of the latter is
    # kept.
    problem, ways = search.problem, search.problem.ways
    state = problem.state(search.parameters, search.smoothers, search.noise, expected, exact=True)
    normal, curvature, score = (ways.T @ matrix @ ways for matrix in (state.normal, state.curvature, state.score))
    inverse = inverse_curvature(normal, curvature)
    prior = ways.T @ problem.prior.T @ problem.prior @ ways
    # The shifts reduce the scatter by more than one degree of freedom each, as they follow noise in slopes.
    taken = float(np.trace(inverse @ (normal - prior)))
    left = max(state.freedom - taken, 1.0)
    score = state.freedom / left * score
    return np.asarray(ways @ inverse @ (score + prior) @ inverse @ ways.T), left, np.asarray(ways @ inverse @ ways.T)


def _offsets(search: _Search, expected: Array | None) -> tuple[Offsets, Array]:
    """Return the variance of offsets of whole isotherms, and the effect of each on the gradient by the shifts."""
    problem, ways, trend = search.problem, search.problem.ways, search.problem.trend
    information, score, gradient = problem.with_offsets(search.parameters, search.smoothers, expected)
    turned = np.eye(len(score))[:, len(ways) - ways.shape[1] :]
    turned[: len(ways), : ways.shape[1]] = ways
    if trend is not None:
        turned = np.column_stack([turned, np.append(np.zeros(len(ways)), trend)])
    prior = ways.T @ problem.prior.T @ problem.prior @ ways
    # Of computed moduli the curves' own errors would be taken for what is sought.
    certainty = 1.0 if trend is None else min(1.0, search.noise / FINEST) ** 2
    found = estimated(
        certainty * turned.T @ information @ turned,
        certainty * turned.T @ score,
        certainty * prior,
        problem.moduli,
        tied=problem.gauge.free_vertical,
        trend=trend is not None,
    )
    if trend is not None:
        found = replace(found, expected=found.expected + found.trend @ TRENDS * trend)
    return found, gradient
