"""The contacts that are solved for a family, and the records of its cases, each as if it had been solved."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self, TypeAlias

import numpy as np

from viscofric.contact.free.grids import Extent
from viscofric.contact.free.scale import Scale
from viscofric.errors import InputError
from viscofric.friction.sensitivity import ROUNDING, ComplianceSensitivity, log_times
from viscofric.study.planning.conditions import label_of
from viscofric.study.planning.curve import STEP, Curve
from viscofric.study.planning.families import LOW_SLOPE, stiffness_of
from viscofric.study.planning.numbers import ERRORS, FRICTION, NAMES, Node, units_of
from viscofric.study.planning.stencils import weights
from viscofric.study.record import CaseRecord, Failure
from viscofric.study.solving import Task

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from viscofric.rheology.material import Material
    from viscofric.study.planning.conditions import Settings
    from viscofric.study.planning.curve import Interval
    from viscofric.study.planning.families import Family, Place
    from viscofric.study.planning.stencils import Interpolated
    from viscofric.study.sweep import Case

    Array: TypeAlias = NDArray[np.float64]

_NONE = 0.0  # temperature that is written down for rubbers without a shift, K


@dataclass(frozen=True, eq=False)
class Representative:
    """The contacts that are solved for a family: those of its rubber at the reference temperature.

    Attributes
    ----------
    family : Family
    material : Material
    settings : Settings
    """

    family: Family
    material: Material
    settings: Settings

    @cached_property
    def load(self) -> float:
        """N, or N/m."""
        if self.family.load is not None:
            return self.family.load
        indenter = self.family.indenter
        stiffness = stiffness_of(self.material, self.family)
        scale = Scale.for_indentation(indenter, stiffness, LOW_SLOPE**2)
        return indenter.geometry.parabolic_load * scale.force

    @cached_property
    def scale(self) -> Scale:
        """Units of these contacts."""
        return Scale.for_load(self.family.indenter, stiffness_of(self.material, self.family), self.load)

    @cached_property
    def _unplaced(self) -> Task:
        reference = self.material.reference
        return Task(
            self.material.modes_at(None),
            self.material.poisson_ratio,
            self.family.indenter,
            speed=self.scale.length,
            load=self.load,
            temperature=_NONE if reference is None else reference,
            accuracy=self.settings.accuracy,
            layer=self.family.layer,
            indenter_modulus=self.family.indenter_modulus,
            indenter_poisson_ratio=self.family.indenter_poisson_ratio,
            sensitive=self.settings.sensitive and self.family.rubber[1] is None,
        )

    def curve(self, places: Array) -> Curve:
        """Return the curve on which cases lie, given s of each."""
        return Curve(places, self.settings.accuracy)

    def node(self, record: CaseRecord) -> Node:
        """Return what was solved as a node of the curve."""
        return Node.of(record, self.scale)

    def between(
        self, curve: Curve, one: Interval, cases: Sequence[Case], places: Sequence[Place]
    ) -> Iterator[tuple[int, CaseRecord | Failure]]:
        """Yield the records of the cases of a closed interval; see `records_between`."""
        yield from records_between(curve, one, cases, places, self)

    def task(self, node: int) -> Task:
        """Return what is to be solved at a node of the curve."""
        frequency = math.exp(STEP * node)
        return replace(
            self._unplaced, speed=self.scale.length * frequency, label=f"friction curve at αv/a = {frequency:.3g} 1/s"
        )


def records_between(
    curve: Curve, one: Interval, cases: Sequence[Case], places: Sequence[Place], solved: Representative
) -> Iterator[tuple[int, CaseRecord | Failure]]:
    """Yield number and record of every case of a closed interval.

    Parameters
    ----------
    curve : Curve
    one : Interval
        Of the curve.
    cases, places : sequence of Case and Place
        Of the whole family.
    solved : Representative
        What the nodes are contacts of.

    Yields
    ------
    int
    CaseRecord or Failure
        A failure where the contact would be wider than the indenter.
    """
    chosen, found = curve.between(one)
    nodes = [(node, curve.node(node).record) for node in chosen.nodes]
    ends = [curve.node(end).record for end in (one.low, one.high)]
    numbers = one.cases.tolist()
    here = [places[number] for number in numbers]
    sensitivities = Sensitivities.between(nodes, here, solved)
    shared: dict[str, Any] = {
        "energy_balance": max((end.energy_balance for end in ends), key=abs),
        "complementarity": max(end.complementarity for end in ends),
        "cells": 0,
        "products": 0,
        "interpolated": True,
    }
    for row, (number, place) in enumerate(zip(numbers, here, strict=True)):
        case, told = cases[number], _told(found, row, place)
        if math.isinf(ends[0].half_width):
            told["half_width"] = math.inf
        try:
            doubts = _doubts(case, _extent(told), told["indentation"])
        except InputError as error:
            yield number, Failure(str(error), label_of(case))
            continue
        known: dict[str, Any] = {
            "speed": case.speed,
            "temperature": case.temperature,
            "load": case.load,
            "warnings": doubts,
        }
        record = CaseRecord(**(known | told | shared))
        yield number, record if sensitivities is None else sensitivities.complete(record, row)


def _told(found: Interpolated, row: int, place: Place) -> dict[str, float]:
    """Give a case's numbers and their errors their units."""
    units = units_of(place.scale, place.b)
    told = dict(zip(NAMES, (units * found.values[row]).tolist(), strict=True))
    errors = units * np.hypot(found.from_nodes[row], found.between[row])
    for name, error in zip(ERRORS, errors.tolist(), strict=True):
        if name is not None:
            told[name] = max(told.get(name, 0.0), error)
    return told | {"interpolation_error": float(units[FRICTION] * found.between[row, FRICTION])}


def _extent(told: dict[str, float]) -> Extent:
    side = told["half_width"]
    return Extent(told["rear"], told["front"], 0.0 if math.isinf(side) else side)


def _doubts(case: Case, contact: Extent, indentation: float) -> tuple[str, ...]:
    """Tell what is doubtful about a contact, as `solve_steady` does.

    Raises
    ------
    InputError
        If it would be wider than the indenter.
    """
    case.indenter.check(contact, f"under {case.load:g} {case.indenter.geometry.load_unit}")
    doubts = [case.indenter.doubt(contact, indentation)]
    if case.layer is not None:
        doubts.append(case.layer.doubt(indentation))
    return tuple(doubt for doubt in doubts if doubt)


@dataclass(frozen=True, eq=False)
class Sensitivities:
    """How the friction of the cases of one interval answers to the rubber's compliance.

    Without units, g is a function of vτ over the length of the contact that changes smoothly along the curve.

    Attributes
    ----------
    solved : Representative
        What the nodes are contacts of.
    places : sequence of Place
        Of the cases.
    log_tau : tuple of (times,) array
        Of each case, at its temperature, τ in s.
    slope : tuple of (times,) array
        g at these, Pa.
    glass, load : (cases,) array
        See `ComplianceSensitivity`.
    """

    solved: Representative
    places: Sequence[Place]
    log_tau: tuple[Array, ...]
    slope: tuple[Array, ...]
    glass: Array
    load: Array

    @classmethod
    def between(
        cls, nodes: Sequence[tuple[int, CaseRecord]], places: Sequence[Place], solved: Representative
    ) -> Self | None:
        """Interpolate; None where a node has none.

        Parameters
        ----------
        nodes : sequence of int and CaseRecord
            Of the polynomial.
        places : sequence of Place
            Of the cases.
        solved : Representative
        """
        known = [record.sensitivity for _, record in nodes]
        found = [one for one in known if one is not None]
        if len(found) < len(known):
            return None
        at = STEP * np.array([node for node, _ in nodes], dtype=float)
        shares = weights(at, np.array([place.s for place in places]))
        modes = solved.material.modes_at(None)
        # At the reference temperature, where all nodes are.
        log_tau = [log_times(modes, np.exp(-place.s)) for place in places]
        # vτ over the length is the same in the case and in the node.
        contact = np.concatenate([one + place.s for one, place in zip(log_tau, places, strict=True)])
        table = np.array([one.at(contact - s) for one, s in zip(found, at, strict=True)])
        ends = np.cumsum([len(one) for one in log_tau])[:-1]
        unit = solved.scale.slope * solved.scale.stiffness
        per_case = np.array([place.scale.slope * place.scale.stiffness * place.b for place in places]) / unit
        slopes = [
            factor * (share @ part)
            for factor, share, part in zip(per_case, shares, np.split(table, ends, axis=1), strict=True)
        ]
        lean = np.array([place.scale.slope for place in places]) / solved.scale.slope
        return cls(
            solved,
            places,
            tuple(one + place.log_alpha for one, place in zip(log_tau, places, strict=True)),
            tuple(slopes),
            per_case * (shares @ np.array([one.glass for one in found])),
            lean * (shares @ np.array([one.load for one in found])),
        )

    def complete(self, record: CaseRecord, row: int) -> CaseRecord:
        """Return the record of a case with its sensitivity."""
        modes, place = self.solved.material.modes_at(None), self.places[row]
        sensitivity = ComplianceSensitivity(
            friction=record.friction_coefficient,
            compliance_part=0.0,
            log_tau=self.log_tau[row],
            slope=self.slope[row],
            glass=float(self.glass[row]),
            load=float(self.load[row]),
            frequency=record.frequency,
        )
        # As the sensitivity itself tells it, so that the rubber's own modes change nothing.
        own = _values_at(np.log(modes.tau) + place.log_alpha, sensitivity)
        part = (float(own @ modes.C) + sensitivity.glass / modes.E_inf) / place.b
        return replace(record, sensitivity=replace(sensitivity, compliance_part=part))


def _values_at(log_tau: Array, sensitivity: ComplianceSensitivity) -> Array:
    """Return g where it mostly is told already, so that nothing need be interpolated."""
    rows = np.minimum(np.searchsorted(sensitivity.log_tau, log_tau - ROUNDING), len(sensitivity.log_tau) - 1)
    if np.all(np.abs(sensitivity.log_tau[rows] - log_tau) <= ROUNDING):
        return sensitivity.slope[rows]
    return sensitivity.at(log_tau)
