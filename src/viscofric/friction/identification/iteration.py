"""Identification step by step: contacts are solved for a material, which is then fitted to the measurement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.errors import ConvergenceError, InputError
from viscofric.friction.identification.posterior import Minimum, Residuals, descend, log_evidence
from viscofric.friction.identification.problem import ROUGHNESS, SpectrumProblem

#: Largest number of materials for which contacts are solved.
STEPS = 20
#: Root mean square change of the friction in the last step, in standard errors of the points.
SETTLED = 0.1
#: Usual error of solved contacts, as a part of the requested accuracy: no step can determine the friction any better.
KNOWN_TO = 0.25
#: Errors of ln μ in the first fits.
TEMPERED = (1.0, 0.3, 0.1, 0.05)
#: … and standard deviation of ln α about the first guess in them.
HELD = 0.2
#: Least errors of ln μ in the first steps from solved contacts: with smaller ones the steps would leave the
#: neighbourhood in which those contacts describe friction.
FIRST_STEPS = (0.01, 0.003, 0.001)
#: Relative error of the contacts of the first, intermediate materials.
FIRST_ACCURACY = 1e-2
#: A step is accepted if the misfit falls by the first part of the prediction; the damping is released at the second.
LEAST_GAIN, GOOD_GAIN = 0.1, 0.7
#: Least factor of the damping if a step is rejected.
GROWTH = 4.0
HALVINGS = 4
#: Residuals whose χ² is this many standard deviations above its expectation enlarge the errors.
DOUBTFUL = 3.0


#: What to do where a fit does not settle.
CONTRADICTING = "check whether given moduli contradict the measurement, or give an anchor or a prior if there is none"
AnyProblem = TypeVar("AnyProblem", bound=SpectrumProblem)
#: Returns a problem with its contacts solved for unknowns (p,), from the number of the step, for progress,
#: and the relative error of the solved contacts that is aimed at.
Solver: TypeAlias = "Callable[[AnyProblem, Array, int, float], AnyProblem]"


class Weighed(NamedTuple, Generic[AnyProblem]):
    """A fit under one roughness of the prior, and the logarithm of the evidence for it."""

    problem: AnyProblem
    minimum: Minimum
    log_evidence: float


def weighed(problem: AnyProblem, start: Array) -> list[Weighed[AnyProblem]]:
    """Fit under every roughness of the prior, the smoothest first; ConvergenceError if no fit converges."""
    middle = int(np.argmin(np.abs(np.log(ROUGHNESS / problem.smoothness.roughness))))
    found: dict[int, Weighed[AnyProblem]] = {}
    for way in (range(middle, len(ROUGHNESS)), range(middle - 1, -1, -1)):
        place = start if middle not in found else found[middle].minimum.place
        for number in way:
            tried = replace(problem, smoothness=replace(problem.smoothness, roughness=float(ROUGHNESS[number])))
            minimum = descend(tried, place, metric=tried.metric)
            found[number] = Weighed(tried, minimum, log_evidence(minimum, tried.smoothness.log_volume))
            place = minimum.place
    settled = [found[number] for number in sorted(found) if found[number].minimum.settled]
    if not settled:
        raise ConvergenceError(f"the fit of the spectrum does not settle; {CONTRADICTING}.", code="not-converged")
    return settled


def most_evident(fits: list[Weighed[AnyProblem]]) -> Weighed[AnyProblem]:
    """Return the fit of the roughness for which there is most evidence."""
    return max(fits, key=lambda fit: fit.log_evidence)


def freedom_of(best: Weighed[Any], count: int, points: Mask | None = None) -> float:
    """Return the number of points, the first `count` residuals, minus the trace of the hat matrix.

    Of some of the points (count,), their number minus their part of the trace.
    """
    return float(np.sum(1.0 - leverage_of(best, count), where=True if points is None else points))


def misfit(best: Weighed[Any], residuals: Array, points: Mask | None = None) -> tuple[float, bool]:
    """Return the mean square of residuals (n,) of points over its expectation, and whether that is beyond chance."""
    freedom = max(freedom_of(best, len(residuals), points), 1.0)
    ratio = float(np.sum(residuals**2, where=True if points is None else points)) / freedom
    return ratio, ratio > 1.0 + DOUBTFUL * np.sqrt(2.0 / freedom)


def leverage_of(best: Weighed[Any], count: int) -> Array:
    """Return the diagonal of the hat matrix of the points, the first `count` residuals."""
    part = best.problem.measured(best.minimum.place)[1][:count]
    return np.asarray(np.sum(part * np.linalg.solve(best.minimum.normal, part.T).T, axis=1))


class Here(NamedTuple, Generic[AnyProblem]):
    """Unknowns (p,), the problem with contacts solved for their material, and the accuracy of these."""

    place: Array
    problem: AnyProblem
    accuracy: float


def identify(
    problem: AnyProblem,
    solver: Solver[AnyProblem],
    start: Array,
    accuracy: float,
    first_accuracy: float = FIRST_ACCURACY,
) -> tuple[list[Weighed[AnyProblem]], int]:
    """Iterate until the modelled points converge; return the fits under every roughness, and the number of steps."""
    # Each step leads to the predicted minimum in the neighbourhood of the solved contacts. Where contacts solved there
    # do not confirm the prediction, a shorter step is tried: a trust region, with the step damped in the metric of the
    # prior (A. R. Conn, N. I. M. Gould, P. L. Toint, Trust-Region Methods, SIAM 2000). The roughness with most evidence
    # is chosen before a step and compared with itself, so that the misfit is one function during a step.
    errors = problem.point_errors
    typical = float(np.median(errors))
    floors = iter([error for error in FIRST_STEPS if error > typical])
    now = max(first_accuracy, accuracy)
    here, number, damping = _first_solved(problem, solver, start, now), 1, 0.0
    while True:
        floor = next(floors, 0.0)
        fits = weighed(here.problem.blurred(floor), here.place)
        best = most_evident(fits)
        before, after = (here.problem.measured(place)[0][: len(errors)] for place in (here.place, best.minimum.place))
        change = errors * (after - before)
        small = np.hypot(SETTLED * errors, KNOWN_TO * here.accuracy)
        settled = floor == 0.0 and float(np.sqrt(np.mean((change / small) ** 2))) < 1.0
        if settled and here.accuracy == accuracy:
            return fits, number
        if settled or number >= len(FIRST_STEPS):
            now = accuracy
        moved, number, damping = _stepped(here, best, solver, now, number, damping)
        if moved is None:
            raise ConvergenceError(
                f"the identification did not settle with contacts solved for {number} rubbers: the fit should still "
                f"change by {100.0 * float(np.sqrt(np.mean(change**2))):.2g} %; {CONTRADICTING}, or fewer modes.",
                code="not-converged",
            )
        here = moved._replace(problem=moved.problem.with_errors(errors))


def _stepped(
    here: Here[AnyProblem],
    best: Weighed[AnyProblem],
    solver: Solver[AnyProblem],
    accuracy: float,
    number: int,
    damping: float,
) -> tuple[Here[AnyProblem] | None, int, float]:
    """Return the result of a step (None without one), the number of materials solved so far, and the next damping."""
    target, near = best.problem, here.place
    before = _squares(target, near)
    allowed = _allowance(target, near, here.accuracy)
    while number < STEPS:
        number += 1
        place = best.minimum.place
        if damping > 0.0:
            place = descend(_damped(target, near, damping), near, metric=target.metric).place
        promised = before - _squares(target, place)
        try:
            solved = solver(target, place, number, accuracy)
            gained = before - _squares(solved, place)
        except (ConvergenceError, InputError):  # the latter: wider than the indenter
            if number == STEPS:
                raise
            gained = -np.inf
        if gained + allowed > LEAST_GAIN * promised:
            next_damping = 0.0 if gained > GOOD_GAIN * promised else damping
            return Here(place, solved, accuracy), number, next_damping
        # The damping at which the penalty of the rejected step equals its predicted gain.
        away = place - near
        damping = max(GROWTH * damping, promised / float(away @ target.metric @ away))
    return None, number, damping


def _squares(residuals: Residuals, place: Array) -> float:
    values, _ = residuals(place)
    return float(values @ values)


def _allowance(problem: SpectrumProblem, place: Array, accuracy: float) -> float:
    """Return the error of the misfit due to the accuracy of the contacts."""
    error = problem.point_errors
    away = problem.measured(place)[0][: len(error)]
    return 2.0 * KNOWN_TO * accuracy * float(np.linalg.norm(away) * np.linalg.norm(1.0 / error))


def _damped(problem: SpectrumProblem, near: Array, damping: float) -> Residuals:
    """Return the residuals of a problem, with the distance from a point added as residuals."""
    root = np.sqrt(damping) * np.linalg.cholesky(problem.metric).T

    def together(place: Array) -> tuple[Array, Array]:
        values, jacobian = problem(place)
        return np.concatenate([values, root @ (place - near)]), np.concatenate([jacobian, root])

    return together


def _first_solved(problem: AnyProblem, solver: Solver[AnyProblem], start: Array, accuracy: float) -> Here[AnyProblem]:
    """Return the roughly fitted material with its contacts solved, or a solvable one between it and the start."""
    place = first_fit(problem, start)
    for halving in range(HALVINGS + 1):
        try:
            return Here(place, solver(problem, place, 1, accuracy), accuracy)
        except (ConvergenceError, InputError):
            if halving == HALVINGS:
                raise
        place = 0.5 * (place + start)
    raise AssertionError


def first_fit(problem: SpectrumProblem, start: Array) -> Array:
    """Return unknowns that fit roughly, found with errors that are large at first and then smaller."""
    # A fit with small errors from a distant start would end in a local minimum, where some points fit and others do
    # not, with shifts far apart; so shifts are held near their first guess meanwhile.
    shifts = problem.shifts
    if shifts.found:
        held = np.concatenate([shifts.whitening, np.eye(len(shifts.middle)) / HELD])
        problem = replace(problem, shifts=replace(shifts, whitening=held))
    for error in TEMPERED:
        start = descend(problem.blurred(error), start, metric=problem.metric).place
    return start
