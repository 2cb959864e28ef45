"""Fits of the spectrum under every roughness that the prior may have, and the evidence for each."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import ConvergenceError
from viscofric.friction.identification.posterior import Minimum, descend, log_evidence
from viscofric.friction.identification.smoothness import ROUGHNESS

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.identification.problem import Problem


class Weighed(NamedTuple):
    """A fit under one roughness of the prior, and the logarithm of the evidence for it."""

    problem: Problem
    minimum: Minimum
    log_evidence: float


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


def most_evident(fits: list[Weighed]) -> Weighed:
    """Return the fit of the roughness for which there is most evidence."""
    return max(fits, key=lambda fit: fit.log_evidence)
