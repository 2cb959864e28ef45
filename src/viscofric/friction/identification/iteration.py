"""Identification step by step: contacts are solved for a rubber, then the rubber is moved to fit what was measured."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import ConvergenceError, InputError
from viscofric.friction.identification.contacts import SolvedContact
from viscofric.friction.identification.corrected import CorrectedFriction, Solved
from viscofric.friction.identification.posterior import Minimum, descend, log_evidence
from viscofric.friction.identification.response import friction_response
from viscofric.friction.identification.smoothness import ROUGHNESS
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.identification.anchors import ContactAnchor
    from viscofric.friction.identification.problem import Problem
    from viscofric.processes import Workers

    Array = NDArray[np.float64]

#: Contacts that are solved per decade of reduced speed, and how far beyond the points, decades.  What the closed form
#: misses changes so slowly that four per decade carry it to 1e-4 of the friction.
NODES_PER_DECADE = 4
BEYOND = 0.15
FEWEST_NODES = 5
ITERATIONS = 15
#: Root mean square change of the friction in a step, in standard errors of the points, with which it ends.
SETTLED = 0.1
HALVINGS = 4
#: Errors of ln μ with which the first fits are made.
TEMPERED = (1.0, 0.3, 0.1, 0.05)
#: … and standard deviation about the first guess that ln α has in them.
HELD = 0.2
#: Errors of ln μ with which the first steps from solved contacts are made at the least: small ones would ask the
#: neighbourhood of those contacts for more than it tells.
FIRST_STEPS = (0.01, 0.003, 0.001)
LN10 = float(np.log(10.0))


class Weighed(NamedTuple):
    """A fit under one roughness of the prior, and the logarithm of the evidence for it."""

    problem: Problem
    minimum: Minimum
    log_evidence: float


@dataclass(frozen=True, eq=False)
class Contacts:
    """How contacts are solved.

    Attributes
    ----------
    indenter : Indenter
    poisson_ratio : float
    load : float
        N or N/m.
    accuracy : float
    workers : int or Workers
    anchors : tuple of ContactAnchor
        Contacts whose size was measured.
    progress : callable or None
        Called with the number of the step, and how many of how many contacts are solved in it.
    """

    indenter: Indenter
    poisson_ratio: float
    load: float
    accuracy: float
    workers: int | Workers
    anchors: tuple[ContactAnchor, ...] = ()
    progress: Callable[[int, int, int], object] | None = None

    def solved(self, problem: Problem, unknowns: Array, step: int) -> Problem:
        """Return the problem with contacts solved for the rubber that the unknowns describe.

        Raises
        ------
        ConvergenceError
            If a contact is not solved.
        """
        compliances, log_alpha = problem.split(unknowns)
        spectrum = spectrum_of(compliances, problem.smoothness.tau)
        points = problem.observations.points
        reduced = points.log_speed + log_alpha[points.number]
        low, high = reduced.min() - BEYOND * LN10, reduced.max() + BEYOND * LN10
        count = max(FEWEST_NODES, int(np.ceil(NODES_PER_DECADE * (high - low) / LN10)) + 1)
        nodes = np.linspace(low, high, count)
        response = friction_response(
            spectrum,
            self.poisson_ratio,
            self.indenter,
            np.exp(nodes),
            self.load,
            accuracy=self.accuracy,
            workers=self.workers,
            progress=lambda done, total: None if self.progress is None else self.progress(step, done, total),
        )
        friction = response.friction
        if not np.all(friction > 0.0):
            raise ConvergenceError("the friction of a contact came out negative; solve more accurately.")
        by_glass = np.column_stack([-response.log_E_inf, response.log_C])
        solved = Solved(
            compliances,
            nodes,
            np.log(friction),
            response.error / friction,
            by_glass / friction[:, None],
            response.log_load / friction,
        )
        sizes = tuple(
            SolvedContact.of(
                anchor,
                self.indenter,
                spectrum,
                self.poisson_ratio,
                self.accuracy,
                compliances,
                float(problem.shifts.row(float(anchor.temperature)) @ log_alpha),
            )
            for anchor in self.anchors
        )
        return replace(problem, friction=CorrectedFriction(problem.friction.first, solved), contacts=sizes)


def spectrum_of(compliances: Array, tau: Array) -> RetardationSpectrum:
    """Return the spectrum of ln(1/E_inf) and every ln C."""
    values = np.exp(compliances)
    return RetardationSpectrum(1.0 / float(values.sum()), 1.0 / float(values[0]), values[1:], tau)


def weighed(problem: Problem, start: Array) -> list[Weighed]:
    """Fit under every roughness of the prior, outward from that of the problem; the smoothest comes first.

    Raises
    ------
    ConvergenceError
        If no fit settles.
    """
    middle = int(np.argmin(np.abs(np.log(ROUGHNESS / problem.smoothness.roughness))))
    found: dict[int, Weighed] = {}
    for way in (range(middle, len(ROUGHNESS)), range(middle - 1, -1, -1)):
        place = start if middle not in found else found[middle].minimum.place
        for number in way:
            tried = replace(problem, smoothness=replace(problem.smoothness, roughness=float(ROUGHNESS[number])))
            minimum = descend(tried, place, metric=tried.metric)
            found[number] = Weighed(tried, minimum, log_evidence(minimum, tried.smoothness.log_volume))
            place = minimum.place
    settled = [found[number] for number in sorted(found) if found[number].minimum.settled]
    if not settled:
        raise ConvergenceError("the fit of the spectrum to the friction does not settle; give an anchor or a prior.")
    return settled


def first_fit(problem: Problem, start: Array) -> Array:
    """Return unknowns that fit roughly, found with errors that are large at first and then smaller.

    A fit to small errors from far away would end where some points are met and others given up, with shifts that have
    run away from each other; they are held near their first guess meanwhile.
    """
    if problem.shifts.found:
        held = np.eye(len(problem.shifts.middle)) / HELD
        problem = replace(problem, shifts=replace(problem.shifts, whitening=held))
    for error in TEMPERED:
        start = descend(problem.blurred(error), start, metric=problem.metric).place
    return start


def most_evident(fits: list[Weighed]) -> Weighed:
    """Return the fit of the roughness for which there is most evidence."""
    return max(fits, key=lambda fit: fit.log_evidence)


def identify(problem: Problem, contacts: Contacts, start: Array) -> tuple[list[Weighed], int]:
    """Iterate until the friction settles; return the fits under every roughness, and the number of iterations.

    Raises
    ------
    ConvergenceError
        If it does not settle, or contacts fail wherever it is tried.
    """
    here = first_fit(problem, start)
    before, least = start, np.inf
    typical = float(np.median(problem.observations.points.error))
    floors = iter([error for error in FIRST_STEPS if error > typical])
    for iteration in range(1, ITERATIONS + 1):
        for halving in range(HALVINGS + 1):
            try:
                solved = contacts.solved(problem, here, iteration)
            except (ConvergenceError, InputError):  # the latter: wider than the indenter
                if halving == HALVINGS:
                    raise
            else:
                values, _ = solved(here)
                squares = float(values @ values)
                if squares < 1.5 * least + 1.0 or halving == HALVINGS:
                    break
            here = 0.5 * (here + before)
        points = problem.observations.points
        floor = next(floors, 0.0)
        fits = weighed(solved.blurred(floor), here)
        best = most_evident(fits)
        moved = (solved.log_friction(best.minimum.place)[0] - solved.log_friction(here)[0]) / points.error
        problem, before, least = replace(best.problem, observations=problem.observations), here, squares
        here = best.minimum.place
        if floor == 0.0 and float(np.sqrt(np.mean(moved**2))) < SETTLED:
            return fits, iteration
    raise ConvergenceError(
        f"the identification did not settle in {ITERATIONS} steps: the friction still changes by "
        f"{100.0 * float(np.sqrt(np.mean((moved * points.error) ** 2))):.2g} %; give an anchor, a prior or fewer modes."
    )
