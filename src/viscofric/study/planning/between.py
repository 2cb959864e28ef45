"""Records of cases that lie between solved contacts, each as if it had been solved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from viscofric.contact.free.grids import Extent
from viscofric.errors import InputError
from viscofric.study.planning.conditions import label_of
from viscofric.study.planning.numbers import ERRORS, FRICTION, NAMES, units_of
from viscofric.study.planning.sensitivities import Sensitivities
from viscofric.study.record import CaseRecord, Failure

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from viscofric.study.planning.curve import Curve, Interval
    from viscofric.study.planning.families import Place, Representative
    from viscofric.study.planning.stencils import Interpolated
    from viscofric.study.sweep import Case

    Array: TypeAlias = NDArray[np.float64]


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
