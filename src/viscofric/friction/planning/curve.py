"""A curve solved as finely as its friction requires, in waves.

Nodes lie on a grid in s that is the same for all studies, halved where a solved midpoint differs too much from the
value predicted by the nodes around it.  The nodes of a wave are independent of each other, and the next wave depends
on whole waves only, so that timing and order do not matter.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.contact.free.estimates import FRICTION_FLOOR
from viscofric.friction.cases.interpolation import (
    FRICTION,
    SHARE,
    Between,
    Interpolated,
    Node,
    Stencil,
    interpolate,
    stencil,
)

#: Length in s of the smallest interval; others are multiples by powers of two.
STEP = 1.0 / 32.0
# Length of the first intervals, in steps, at accuracies up to and above the limit.
_FINE_START, _COARSE_START, _COARSE_FROM = 32, 64, 1e-2
# Least factor by which halving an interval reduces the error, by the number of nodes of its polynomial: in the limit it
# is 2 to the power of their number.  Between nodes further apart than the first ones at high accuracy, where peaks of
# single modes fit between, no reduction is certain.
_GAIN = (1.0, 1.0, 1.0, 2.0, 4.0, 4.0, 8.0)
# Midpoints solved for each first interval, including later ones: as for three materials over twelve decades at 1e-3.
_REFINED = 1.1
#: Up to this number, cases are solved individually instead of refining their interval.
_FEW = 2


class Interval(NamedTuple):
    """Two neighbouring nodes and the cases between them."""

    low: int
    high: int
    cases: Indices

    @property
    def middle(self) -> int:
        """The node that halves it."""
        return (self.low + self.high) // 2


class Curve:
    """The nodes of one family of cases.

    `places` (cases,) are their s, `accuracy` is that of the friction, relative; `logarithmic` (columns,) columns of the
    nodes, friction first, are interpolated by their logarithms.
    """

    def __init__(self, places: Array, accuracy: float, logarithmic: Mask) -> None:
        self._places, self._accuracy, self._logarithmic = places, accuracy, logarithmic
        self._nodes: dict[int, Node] = {}
        self._failed: set[int] = set()
        self.alone: list[int] = []  # cases that are better solved individually
        self.closed: list[Interval] = []  # intervals that need no refinement
        self._open = self._worth_a_curve()
        # Nodes of this wave; none when the curve is known well enough.
        self.wanted = tuple(sorted({end for one in self._open for end in (one.low, one.high)}))

    @property
    def expected(self) -> float:
        """Estimated number of contacts to solve, from the places of the cases."""
        few = [len(one.cases) for one in self._open if len(one.cases) <= _FEW]
        return len(self.alone) + len(self.wanted) + sum(few) + _REFINED * (len(self._open) - len(few))

    def _worth_a_curve(self) -> list[Interval]:
        """Return the first intervals, where neighbours have more cases than a curve needs nodes."""
        length = _COARSE_START if self._accuracy > _COARSE_FROM else _FINE_START
        number = np.floor(self._places / (STEP * length)).astype(np.int64)
        worth: list[Interval] = []
        ascending = np.unique(number)
        for run in np.split(ascending, np.flatnonzero(np.diff(ascending) > 1) + 1):
            inside = [np.flatnonzero(number == one) for one in run]
            if sum(map(len, inside)) <= 2 * len(run) + 1:
                self._leave_alone(np.concatenate(inside))
            else:
                worth += [
                    Interval(one * length, (one + 1) * length, rows)
                    for one, rows in zip(run.tolist(), inside, strict=True)
                ]
        return worth

    def advance(self, found: Mapping[int, Node | None]) -> None:
        """Take the nodes of the whole wave; None for those that failed."""
        before = sorted(self._nodes)
        self._nodes |= {place: node for place, node in found.items() if node is not None}
        self._failed |= {place for place, node in found.items() if node is None}
        halves: list[tuple[Interval, bool]] = []
        for one in self._open:
            if self._failed & {one.low, one.high, one.middle}:
                self._leave_alone(one.cases)
            elif one.middle in self._nodes:
                predicted = self._predicts(one, before)
                halves += [(half, predicted) for half in self._halves(one)]
            else:
                halves.append((one, False))
        known = sorted(self._nodes)
        self._open = []
        for one, predicted in halves:
            if predicted and self._agrees(one, known):
                self.closed.append(one)
            else:
                self._refine(one, one.cases)
        if not self._open:
            self._reopen()
        self.wanted = tuple(one.middle for one in self._open)

    def _refine(self, one: Interval, missed: Indices) -> None:
        """Halve an interval for the cases that are not known well enough, or solve these individually."""
        if len(missed) <= _FEW or one.high - one.low < 2:
            self._leave_alone(missed)
            left = np.setdiff1d(one.cases, missed)
            if len(left):
                self.closed.append(one._replace(cases=left))
        else:
            self._open.append(one)

    def _reopen(self) -> None:
        """Check the errors of the cases themselves, and refine where one is above the accuracy."""
        closed, self.closed = self.closed, []
        for one in closed:
            found = self.between(one).found
            errors = np.hypot(found.from_nodes[:, FRICTION], found.between[:, FRICTION])
            allowed = self._accuracy * np.maximum(np.abs(found.values[:, FRICTION]), FRICTION_FLOOR)
            missed = one.cases[errors > allowed]
            if len(missed):
                self._refine(one, missed)
            else:
                self.closed.append(one)

    def drafted(self, found: Mapping[int, Node | None]) -> Curve:
        """Return the curve as known so far, with part of the nodes wanted now."""
        drafted = copy.copy(self)
        drafted._nodes = self._nodes | {place: node for place, node in found.items() if node is not None}
        drafted.closed = [*self.closed, *(one for one in self._open if {one.low, one.high} <= drafted._nodes.keys())]
        drafted.wanted = ()
        return drafted

    def between(self, one: Interval) -> Between:
        """Interpolate the cases of a closed interval."""
        chosen = stencil(one.low, one.high, sorted(self._nodes))
        nodes = [(STEP * node, self._nodes[node].record) for node in chosen.nodes]
        ends = self._nodes[one.low].record, self._nodes[one.high].record
        return Between(one.cases.tolist(), nodes, ends, self._at(chosen, self._places[one.cases]))

    def _leave_alone(self, cases: Indices) -> None:
        self.alone += cases.tolist()

    def _halves(self, one: Interval) -> list[Interval]:
        lower = self._places[one.cases] < STEP * one.middle
        parts = (one.low, one.middle, one.cases[lower]), (one.middle, one.high, one.cases[~lower])
        return [Interval(*part) for part in parts if len(part[2])]

    def _at(self, chosen: Stencil, places: Array) -> Interpolated:
        values = np.array([self._nodes[node].values for node in chosen.nodes])
        errors = np.array([self._nodes[node].errors for node in chosen.nodes])
        return interpolate(chosen, STEP, places, values, errors, self._logarithmic)

    def _predicts(self, one: Interval, known: list[int]) -> bool:
        """Whether friction at the midpoint agrees with the value predicted by the earlier nodes."""
        chosen = stencil(one.low, one.high, known)
        expected = self._at(chosen, np.array([STEP * one.middle]))
        solved = self._nodes[one.middle]
        value, error = solved.values[FRICTION], solved.errors[FRICTION]
        # Differences below the errors of the solutions are not significant.
        noise = np.hypot(error, expected.from_nodes[0, FRICTION])
        gain = 1.0 if one.high - one.low > _FINE_START else _GAIN[len(chosen.nodes)]
        allowed = gain * self._allowed(value)
        return bool(abs(expected.values[0, FRICTION] - value) <= max(allowed, noise))

    def _agrees(self, one: Interval, known: list[int]) -> bool:
        """Whether polynomials of different degree agree on friction in the middle of an interval."""
        chosen = stencil(one.low, one.high, known)
        middle = self._at(chosen, np.array([0.5 * STEP * (one.low + one.high)]))
        noise = middle.from_nodes[0, FRICTION]
        allowed = _GAIN[len(chosen.nodes) - 1] * self._allowed(middle.values[0, FRICTION])
        return bool(middle.between[0, FRICTION] <= max(allowed, noise))

    def _allowed(self, friction: float) -> float:
        return SHARE * self._accuracy * max(abs(friction), FRICTION_FLOOR)
