"""The least-squares problem of an identification from indentation: contacts, spectrum, shift factors, common errors."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Self

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.identification.indentation.contact import EXACT, Contact, Nearby, Shared, Trial
from viscofric.friction.identification.iteration import Weighed, identify
from viscofric.friction.identification.problem import SpectrumProblem

#: Relative error of contacts by springs.
ACCURACY = 1e-3


@dataclass(frozen=True, eq=False)
class IndentationProblem(SpectrumProblem):
    """Identification from contacts; the data are the logarithms of their responses."""

    contacts: tuple[Contact, ...]
    number: tuple[int, ...]  # of each contact's temperature
    errors: Array  # (n,), of ln of the responses, contact by contact
    plane_strain: float  # 1 − ν²
    extra: float = 0.0  # (1 − ν_i²)/E_i of the indenter over the plane strain of the rubber, 1/Pa
    shared: Shared = EXACT
    nearby: dict[int, Nearby] = field(default_factory=dict, repr=False)  # of contacts by springs, once solved

    @property
    def others(self) -> int:
        """Radius, gain, and the zero of every contact; none if all of them are exact."""
        return 2 + len(self.contacts) if any(self.shared) else 0

    @property
    def rows(self) -> list[slice]:
        """Points of each contact."""
        ends = np.cumsum([0, *(len(contact) for contact in self.contacts)])
        return [slice(int(first), int(last)) for first, last in pairwise(ends)]

    @property
    def point_errors(self) -> Array:
        """Standard errors of ln of the responses (n,)."""
        return self.errors

    def with_errors(self, errors: Array) -> Self:
        """Return the problem with other standard errors (n,)."""
        return replace(self, errors=errors)

    def trial(self, place: int, unknowns: Array) -> Trial:
        """Return the material of the unknowns at the temperature of a contact."""
        compliances, log_alpha = self.split(unknowns)
        alpha = float(log_alpha[self.number[place]])
        return Trial(compliances, self.smoothness.tau, alpha, self.plane_strain, self.extra)

    def modelled(self, unknowns: Array) -> tuple[Array, Array]:
        """Return ln of the modelled responses (n,), with the errors in common, and their derivatives."""
        values = np.zeros(len(self.errors))
        changes = np.zeros((len(values), len(unknowns)))
        others = unknowns[len(unknowns) - self.others :]
        for place, (contact, rows) in enumerate(zip(self.contacts, self.rows, strict=True)):
            found = self.nearby.get(place, contact.answer)(self.trial(place, unknowns))
            values[rows], changes[rows, : self.modes] = found.log_value, found.change
            changes[rows, self.modes + self.number[place]] = found.by_alpha
            if self.others:
                first = len(unknowns) - self.others
                columns = np.array([0, 1, 2 + place])
                values[rows] += found.shared @ others[columns]
                changes[rows, first + columns] = found.shared
        return values, changes

    def measured(self, unknowns: Array) -> tuple[Array, Array]:
        """Return modelled minus measured ln of the responses over their errors, and their derivatives."""
        value, change = self.modelled(unknowns)
        observed = np.log(np.concatenate([contact.response for contact in self.contacts]))
        return (value - observed) / self.errors, change / self.errors[:, None]


def solved_by_springs(
    problem: IndentationProblem, unknowns: Array, step: int = 0, accuracy: float = 0.0
) -> IndentationProblem:
    """Return the problem with its contacts that are not linear solved for the material of the unknowns (`Solver`)."""
    # Steps and springs are the same at every accuracy.
    springs = ((place, contact) for place, contact in enumerate(problem.contacts) if contact.by_springs)
    return replace(problem, nearby={at: Nearby.of(one, problem.trial(at, unknowns)) for at, one in springs})


def fitted_by_springs(problem: IndentationProblem, start: Array) -> list[Weighed[IndentationProblem]]:
    """Return the fits at every roughness, of contacts solved by springs again until the material no longer changes."""
    solved = problem if problem.nearby else solved_by_springs(problem, start)
    return identify(solved, solved_by_springs, start, ACCURACY, first_accuracy=ACCURACY)[0]
