"""Shift factors found from friction curves alone: all temperatures on one smooth curve, with their covariance.

Selection of overlaps widens the errors: an overlap counts only if curves contradict each other by `CONTRADICTION` at
either end of the possible steps.  So of curves that overlap marginally those are found which chance moved together,
and their shift is off, always to the same side.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import InputError, SuperpositionError
from viscofric.friction.curve_checks import LEFT_OUT, MEAN_SQUARE, TAILS_COST, scatter_of, with_tails
from viscofric.friction.shifting.isotherms import FrictionIsotherm, distances, scatter_scale
from viscofric.friction.shifting.placement import (
    CONTRADICTION,
    FEWEST_POINTS,
    Pairs,
    arrange,
    groups,
    rivals,
    scan_pairs,
)
from viscofric.notes import Note
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.rheology.superposition.common_curve import Basis
from viscofric.rheology.superposition.common_shifts import fitted
from viscofric.rheology.superposition.overlap import Join
from viscofric.rheology.superposition.shift_problem import Gauge
from viscofric.units import kelvin_hint, shown_celsius

#: Steps that the fit moves further from where a pair coincides are not that pair's, decades.
_NEAR = 0.2
#: Variances that grow by more than this factor are noted.
NOTED = 1.5
#: Fitted curves overlap significantly if they still do after a shift by so many standard errors of their step.
SURE = 2.0
#: By which variances grow at most because the scatter is found from few points.
LARGEST_FACTOR = 5.0
#: With fewer degrees of freedom scatter below the stated errors may be chance, and these are taken, unless its variance
#: is below this part of theirs.
TOO_FEW, TOO_GOOD = 10.0, 0.01
#: Points that are nearer to the common curve do not count less: it is off exact friction by as much, decades.
BIAS = 2e-3
#: Friction whose differences chance makes more often than this may be constant; many pairs were looked at.
CONSTANT = 1e-4
#: Code of the notes on temperatures that were left out.
CURVE_LEFT_OUT = "curve-left-out"
#: More temperatures than these are given by their range.
MOST_LISTED = 9


def widening(margin: float) -> float:
    """Return the factor by which the variance of a shift grows because its overlap was selected."""
    # With D standard errors between the shift and the end where curves no longer overlap, found if D > 3, the true
    # distance δ has the likelihood φ(D − δ)/Φ(δ − 3); with any δ ≥ 0 as likely as another, this is the mean of (D −
    # δ)².
    from scipy.special import log_ndtr

    threshold = math.sqrt(CONTRADICTION)
    true = np.linspace(0.0, margin + 6.0, 400)
    logarithm = -0.5 * (margin - true) ** 2 - log_ndtr(true - threshold)
    weight = np.exp(logarithm - logarithm.max())
    return max(1.0, float(np.sum(weight * (margin - true) ** 2) / np.sum(weight)))


def widenings(members: Sequence[int], values: Array, pairs: Pairs) -> Array:
    """Return the factors of variances of steps between members, (members − 1,), by the clearest overlap across each."""
    clearest = np.full(len(members) - 1, math.sqrt(CONTRADICTION))
    for one, colder in enumerate(members):
        for other in range(one + 1, len(members)):
            pair, step = pairs[colder, members[other]], float(values[one] - values[other])
            near = [margin for candidate, margin in pair.candidates.items() if abs(candidate - step) <= _NEAR]
            if near:
                clearest[one:other] = np.maximum(clearest[one:other], max(near))
    return np.array([widening(margin) for margin in clearest.tolist()])


def widened(covariance: Array, factors: Array, at_reference: Array) -> Array:
    """Return the covariance (n, n) of shifts whose steps have variances larger by factors (n − 1,)."""
    # `at_reference` (n,) are the weights with which the shifts are zero together.
    wider = covariance.copy()
    for step, factor in enumerate(factors.tolist()):
        pair = np.array([step, step + 1])
        variance = float(np.array([-1.0, 1.0]) @ covariance[np.ix_(pair, pair)] @ np.array([-1.0, 1.0]))
        moved = (np.arange(len(covariance)) > step).astype(float)
        moved -= at_reference @ moved
        wider += (factor - 1.0) * variance * np.outer(moved, moved)
    return wider


def found_shifts(
    isotherms: Sequence[FrictionIsotherm], reference: float | None, level_error: float = 0.0
) -> tuple[ShiftFactors, list[int]]:
    """Find the shift factors that bring friction curves, in ascending temperature, onto one smooth curve."""
    # They are those of the temperatures whose curves overlap, with notes on those left out; the second value are their
    # indices among all temperatures. Pairs of temperatures are scanned for steps at which their curves coincide,
    # overlapping curves are arranged roughly (both in `placement`), and all are brought onto one penalised spline at
    # once, as moduli are (`rheology.superposition.common_shifts`). Overlaps that the fitted shifts and their errors do
    # not confirm are dropped. α is 1 at `reference` (K), by default the temperature in the middle of the largest group.
    # `level_error` is the relative standard error of friction that all points of a temperature share.
    _check(isotherms, reference)
    scale = scatter_scale(isotherms)
    pairs = scan_pairs(isotherms, scale or 1.0)
    doubts = Doubts(isotherms, pairs, reference)
    joined = [places for places, pair in pairs.items() if pair.candidates]
    members = _group(groups(range(len(isotherms)), joined), doubts)
    arrangements = arrange(members, pairs)
    doubts.elsewhere = rivals(arrangements)
    positions = arrangements[0].positions
    members = [place for place in sorted(positions) if place not in doubts.elsewhere]
    while True:
        members = _group([members], doubts)
        chosen = [isotherms[place] for place in members]
        kelvin = chosen[len(chosen) // 2].temperature if reference is None else reference
        chosen, values, covariance = _fit(chosen, np.array([positions[place] for place in members]), kelvin)
        if level_error > 0.0:
            covariance = covariance + _of_levels(chosen, values, kelvin, level_error)
        sure = [(members[one], members[other]) for one, other in _overlaps(chosen, values, covariance)]
        reaching = _group(groups(members, sure), doubts, fitted=True)
        if len(reaching) == len(members):
            break
        positions = dict(zip(members, values.tolist(), strict=True))
        members = reaching
    if _may_be_constant(chosen, isotherms, scale):
        raise SuperpositionError(too_flat(chosen))
    factors = widenings(members, values, pairs)
    covariance = widened(covariance, factors, _at_reference(chosen, kelvin)[1])
    temperatures = np.array([isotherm.temperature for isotherm in chosen])
    notes = (*doubts.left_out(members), *_marginal(chosen, factors))
    return ShiftFactors(temperatures, values, kelvin, covariance, notes), members


def _check(isotherms: Sequence[FrictionIsotherm], reference: float | None) -> None:
    if len(isotherms) < 2:
        raise SuperpositionError(
            f"friction curves at one temperature, {shown(isotherms[0])}, have no shift factor; give two or more.",
            code="one-temperature",
        )
    low, high = isotherms[0].temperature, isotherms[-1].temperature
    if reference is not None and not low - NOMINAL <= reference <= high + NOMINAL:
        raise InputError(
            f"reference = {shown_celsius(reference)} °C lies outside the friction curves, {shown(isotherms[0])} to "
            f"{shown(isotherms[-1])}",
            code="reference-outside",
            remedy=kelvin_hint(reference),
            values={"argument": "reference"},
        )


def _group(found: list[list[int]], doubts: Doubts, *, fitted: bool = False) -> list[int]:
    """Return the largest group of temperatures that covers the reference; SuperpositionError if there is none."""
    near = [group for group in found if len(group) > 1 and doubts.reached_by(group)]
    if not near:
        raise SuperpositionError(doubts.refusal(fitted=fitted))
    return max(near, key=len)


def _may_be_constant(
    chosen: Sequence[FrictionIsotherm], isotherms: Sequence[FrictionIsotherm], scale: float | None
) -> bool:
    """Whether friction of the chosen temperatures differs by no more than its scatter, or stated errors (F test)."""
    from scipy.special import chdtrc, fdtrc

    friction = np.concatenate([isotherm.friction for isotherm in chosen])
    weight = 1.0 / ((scale or 1.0) * np.concatenate([isotherm.larger * isotherm.variance for isotherm in chosen]))
    squares = np.sum(weight * (friction - np.average(friction, weights=weight)) ** 2)
    if scale is None:
        return bool(chdtrc(friction.size - 1, squares) > CONSTANT)
    ratio = squares / (friction.size - 1)
    freedom = sum(isotherm.curves.freedom for isotherm in isotherms if len(isotherm) > 3)
    return bool(fdtrc(friction.size - 1, freedom, ratio) > CONSTANT)


def _fit(
    chosen: Sequence[FrictionIsotherm], start: Array, reference: float
) -> tuple[list[FrictionIsotherm], Array, Array]:
    """Fit log10 α (n,) of all isotherms from a start, and its covariance; points far from the curve count less."""
    ends = np.cumsum([len(isotherm) for isotherm in chosen])[:-1]
    counted, values = list(chosen), start

    def fit(larger: Array, _: float) -> tuple[Array, Array, float]:
        nonlocal counted, values
        counted = [replace(one, larger=own) for one, own in zip(chosen, np.split(larger, ends), strict=True)]
        values, covariance = _fit_as_counted(counted, values, reference)
        places = np.concatenate([isotherm.speed + value for isotherm, value in zip(counted, values, strict=True)])
        friction = np.concatenate([isotherm.friction for isotherm in counted])[:, None]
        weight = 1.0 / (larger * np.concatenate([isotherm.variance for isotherm in counted]))
        curves = Basis.of(places).curves(friction, weight)
        freedom, away = curves.freedom - len(chosen) + 1.0, distances(curves, larger)
        scatter = scatter_of(float(np.sum(curves.residual**2)), freedom, larger, away)
        if freedom < TOO_FEW:
            covariance = covariance / np.clip(_student(freedom) * scatter, TOO_GOOD, 1.0)
        squares = away / scatter
        near = curves.residual[:, 0] ** 2 < weight * BIAS**2
        return covariance, np.where(near, np.minimum(squares, 1.0), squares), 1.0

    covariance, _, _ = with_tails(np.ones(sum(map(len, chosen))), fit)
    return counted, values, TAILS_COST / MEAN_SQUARE * covariance


def _fit_as_counted(chosen: Sequence[FrictionIsotherm], start: Array, reference: float) -> tuple[Array, Array]:
    temperatures, weights = _at_reference(chosen, reference)
    gauge = Gauge(1.0 / temperatures, weights, weights, {})
    joins = [Join(float(step), 0.0, 0.0) for step in -np.diff(start)]
    weight = np.median(np.concatenate([1.0 / isotherm.variance for isotherm in chosen]))
    found = fitted([isotherm.sweep(float(weight)) for isotherm in chosen], joins, gauge)
    # The scatter is found from few points: shifts in units of their errors follow Student's t, whose variance is this.
    # Those that are left out have none.
    freedom = max(found.freedom - sum(int(np.count_nonzero(one.larger >= LEFT_OUT)) for one in chosen), 1.0)
    return found.values, _student(freedom) * found.freedom / freedom * found.covariance


def _student(freedom: float) -> float:
    """Return the variance of Student's distribution, limited."""
    return min(freedom / (freedom - 2.0), LARGEST_FACTOR) if freedom > 2.5 else LARGEST_FACTOR


def _at_reference(chosen: Sequence[FrictionIsotherm], reference: float) -> tuple[Array, Array]:
    """Return the temperatures, and the weights with which their log10 α interpolate that of the reference."""
    temperatures = np.array([isotherm.temperature for isotherm in chosen])
    inside = np.clip(reference, temperatures[0], temperatures[-1])
    return temperatures, weights_between(temperatures, np.array([inside]))[0]


def _marginal(chosen: Sequence[FrictionIsotherm], factors: Array) -> Iterator[Note]:
    """Yield where curves overlap so little that their overlap was found by chance."""
    found = np.flatnonzero(factors > NOTED)
    if found.size:
        places = ", ".join(f"{shown(chosen[one])} and {shown(chosen[one + 1])}" for one in found.tolist())
        yield Note(
            "marginal-overlap",
            f"The friction curves at {places} overlap little for their errors. Such overlaps are found by chance, with "
            "shifts that err to one side; their standard errors are therefore enlarged, up to "
            f"{math.sqrt(float(factors.max())):.2g} times.",
        )


def _of_levels(chosen: Sequence[FrictionIsotherm], values: Array, reference: float, level_error: float) -> Array:
    """Return the covariance (n, n) due to errors of the isotherms' levels, by fitting again with each one changed."""
    moves = []
    for place, isotherm in enumerate(chosen):
        moved = [*chosen[:place], isotherm.raised(level_error), *chosen[place + 1 :]]
        moves.append(_fit_as_counted(moved, values, reference)[0] - values)
    return np.asarray(np.transpose(moves) @ np.array(moves))


def _overlaps(chosen: Sequence[FrictionIsotherm], values: Array, covariance: Array) -> list[tuple[int, int]]:
    """Return the pairs whose curves overlap significantly, by enough points of each."""
    found = []
    for one, other in combinations(range(len(chosen)), 2):
        colder, warmer = chosen[one].speed + values[one], chosen[other].speed + values[other]
        low, high = max(colder[0], warmer[0]), min(colder[-1], warmer[-1])
        variance = covariance[one, one] + covariance[other, other] - 2.0 * covariance[one, other]
        counts = [np.count_nonzero((part >= low) & (part <= high)) for part in (colder, warmer)]
        if min(counts) >= FEWEST_POINTS and high - low > SURE * np.sqrt(max(float(variance), 0.0)):
            found.append((one, other))
    return found


@dataclass(eq=False)
class Doubts:
    """Temperatures whose curves do not overlap, and what is known of the overlaps."""

    isotherms: Sequence[FrictionIsotherm]
    pairs: Pairs  # from `scan_pairs`
    reference: float | None  # K, where α is to be 1
    elsewhere: list[int] = field(default_factory=list)  # indices of temperatures that fit in more than one place

    def reached_by(self, group: Sequence[int]) -> bool:
        """Whether a group of temperatures, in ascending order, has the reference among or between them."""
        low, high = self.isotherms[group[0]].temperature, self.isotherms[group[-1]].temperature
        return self.reference is None or low - NOMINAL <= self.reference <= high + NOMINAL

    def refusal(self, *, fitted: bool) -> Note:
        """Return why there are no shift factors; `fitted` where the fit did not confirm overlaps."""
        curves = f"friction curves at {_listed(self.isotherms)}"
        if self.elsewhere:
            where = _listed([self.isotherms[place] for place in self.elsewhere])
            return Note(
                "curves-fit-twice",
                f"{curves} have no unique shift factors: friction at {where} fits the other curves in more than one "
                "place equally well; measure at more speeds, or at temperatures in between.",
            )
        if self.reference is not None and not fitted and any(pair.candidates for pair in self.pairs.values()):
            return Note(
                "reference-not-covered",
                f"no overlapping {curves} include the reference, {shown_celsius(self.reference)} °C; choose another "
                "reference, or measure at temperatures around it or at more speeds.",
            )
        if any(pair.verdict == "rising" for pair in self.pairs.values()):
            return Note(
                "shift-factors-rise",
                f"{curves} overlap only if their shift factors rise with temperature, which those of rubber never do; "
                "check temperatures and speeds.",
            )
        neighbours = [self.pairs[place, place + 1] for place in range(len(self.isotherms) - 1)]
        if all(pair.verdict == "flat" for pair in neighbours):
            return too_flat(self.isotherms)
        lone = [isotherm for isotherm in self.isotherms if len(isotherm) < FEWEST_POINTS]
        if len(lone) > len(self.isotherms) - 2:
            return Note(
                "one-speed",
                f"friction at {_listed(lone)} is known at one speed only; a shift factor needs two or more.",
            )
        spans = ", ".join(f"{one.range[0]:.3g} to {one.range[1]:.3g}" for one in self.isotherms[:MOST_LISTED])
        doubt = " significantly" if fitted else ""
        return Note(
            "no-overlap",
            f"{curves} do not overlap{doubt}: no shift makes {FEWEST_POINTS} or more of their points coincide "
            f"(friction coefficients: {spans}); measure at temperatures in between, or at more speeds.",
        )

    def left_out(self, members: Sequence[int]) -> tuple[Note, ...]:
        """Return why each temperature that is not among the members was left out."""
        return tuple(
            Note(
                CURVE_LEFT_OUT,
                f"The friction curve at {shown(self.isotherms[place])} was left out: {self._reason(place, members)}.",
                values={"temperature": float(self.isotherms[place].temperature)},
            )
            for place in range(len(self.isotherms))
            if place not in members
        )

    def _reason(self, place: int, members: Sequence[int]) -> str:
        own = self.isotherms[place]
        if len(own) < FEWEST_POINTS:
            return "it has only one speed"
        if place in self.elsewhere:
            return "it fits the others in more than one place equally well"
        nearest = min(members, key=lambda member: abs(self.isotherms[member].temperature - own.temperature))
        other = shown(self.isotherms[nearest])
        if self.pairs[min(place, nearest), max(place, nearest)].verdict == "flat":
            return f"it or the curve at {other} is too flat to find their overlap"
        return f"no shift makes it overlap significantly with the curve at {other} or the others"


def shown(isotherm: FrictionIsotherm) -> str:
    """Return the temperature of an isotherm in °C."""
    return f"{shown_celsius(isotherm.temperature)} °C"


def too_flat(isotherms: Sequence[FrictionIsotherm]) -> Note:
    """Return a note that friction may be constant."""
    return Note(
        "curves-too-flat",
        f"friction curves at {_listed(isotherms)} are too flat: friction changes too little with speed for its errors, "
        "so that any shift factor fits.",
        values={"temperatures": [float(one.temperature) for one in isotherms]},
    )


def _listed(isotherms: Sequence[FrictionIsotherm]) -> str:
    numbers = [shown_celsius(isotherm.temperature) for isotherm in isotherms]
    if len(numbers) > MOST_LISTED:
        return f"{len(numbers)} temperatures from {numbers[0]} to {numbers[-1]} °C"
    return f"{', '.join(numbers[:-1])} and {numbers[-1]} °C" if len(numbers) > 1 else f"{numbers[0]} °C"
