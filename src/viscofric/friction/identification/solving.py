"""Contacts solved at nodes for one rubber, about which the fit of an identification is made."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import ConvergenceError
from viscofric.friction.identification.contacts import SolvedContact
from viscofric.friction.identification.forward import CorrectedFriction, Solved
from viscofric.friction.identification.response import friction_response
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.identification.anchors import ContactAnchor
    from viscofric.friction.identification.problem import Problem
    from viscofric.processes import Workers


#: Contacts that are solved per decade of reduced speed, and how far beyond the points, decades.  What the closed form
#: misses changes so slowly that four per decade carry it to 1e-4 of the friction.
NODES_PER_DECADE = 4
BEYOND = 0.15
FEWEST_NODES = 5
LN10 = float(np.log(10.0))


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
