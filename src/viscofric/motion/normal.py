"""Normal motion of a body of revolution: a row of springs with the memory of the material.

Each spring at s carries the force f per length; its end moves by

    u = c∞ f + Σ c_k y_k,    ẏ_k = (f − y_k)/τ_k,    c∞ = (1−ν²)/E∞ + (1−ν_i²)/E_i,  c_k = (1−ν²) C_k

The indenter requires u ≥ δ − g(s) and f ≥ 0, and at each spring one of the two is an equality.  Within a step
f is linear and the memory exact, so that a spring at the end of the step has the force
(δ − g − known)/c, or none.  The load is F = 2∫f ds.

This solves the contact of the body exactly if g grows outwards: the springs that touch are then one disc, and f does
not rise outwards, at any time of any history (`springs`).  The pressure p(r) = −(1/π) ∫ᵣᵃ f'(s) ds/√(s² − r²) is
therefore nowhere below zero.  Neither is the gap, since it is a mean of the gaps of the springs.  Only errors of single
steps let the force of springs just touched rise outwards.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import ConvergenceError
from viscofric.motion.memory import StepParts, quickest_time, recovery_at_depth, step_parts
from viscofric.motion.mover import QUICK, Field, Mover, Observation, Problem, Sizes
from viscofric.motion.schedule import Instant, Schedule
from viscofric.motion.springs import Springs, both_sides, elastic_radius, graded_row, quadrature_error

#: Springs from the axis to the largest edge for an accuracy of 1e-3, and their maximum number.
SPRINGS, MOST_SPRINGS = 400, 2000
#: Margin beyond the edge of the elastic contact at E0.
_MARGIN = 1.05
#: Points of a pressure, roughly.
_POINTS = 230
#: Parts of a period in contact that are distinguished.
_LEVELS = 16


@dataclass(frozen=True, eq=False)
class SpringState:
    """Forces and memory of the springs, and the energy dissipated so far."""

    depth: float
    load: float
    force: Array  # (n,) N/m
    memory: Array  # (n, modes) N/m
    dissipated: float
    threshold: Array = field(repr=False)  # (n,) depth at which each spring is touched: g + known, m
    lost_error: float = 0.0  # of the dissipated energy by the distance of springs, J


@dataclass(frozen=True, eq=False, kw_only=True)
class NormalMotion(Springs, Mover[SpringState]):
    """Mover of a body of revolution that moves along its axis; see the module."""

    indenter: Indenter
    schedule: Schedule
    radius: float  # largest edge, m
    spacing: float  # largest distance of springs up to the edge, m

    @classmethod
    def of(cls, problem: Problem) -> NormalMotion:
        """Return the mover of a checked problem; InputError as from `disc_profile`."""
        indenter, schedule = problem.indenter, problem.schedule
        assert isinstance(indenter, Indenter)
        spectrum = schedule.spectrum
        glassy = problem.plane_strain / spectrum.E_inf + problem.counterface
        keep = spectrum.C > 0.0
        compliances = problem.plane_strain * spectrum.C[keep]
        soft = 1.0 / (glassy + float(compliances.sum()))
        largest = schedule.largest
        if largest <= 0.0:
            radius = 1.0
        elif schedule.control == "load":
            radius = elastic_radius(indenter, None, largest, soft)
        else:
            radius = elastic_radius(indenter, largest, None, soft)
        edge = _MARGIN * radius if not indenter.has_walls else radius
        count = min(max(SPRINGS, round(SPRINGS * math.sqrt(1e-3 / problem.accuracy))), MOST_SPRINGS)
        s, g, weights = graded_row(indenter, edge, count)
        return cls(
            g, s, weights, glassy, compliances, spectrum.tau[keep], indenter.has_walls, indenter=indenter,
            schedule=schedule, radius=radius, spacing=edge / count,
        )  # fmt: skip

    @cached_property
    def quickest(self) -> float:
        """Time in which the response to a jump changes noticeably, s of the clock."""
        return quickest_time(self.instantaneous, self.compliances, self.tau)

    @cached_property
    def scales(self) -> Sizes:
        """Load at E0 of the largest depth, depth at E∞ of the largest load."""
        largest = self.schedule.largest
        if largest <= 0.0:
            return Sizes(1.0, 1.0, 1.0, 1.0)
        if self.schedule.control == "load":
            depth, load = self.balance(self.g, largest * self.instantaneous).depth, largest
        else:
            depth, load = largest, self._load(self._force(self.g, self.relaxed, largest))
        return Sizes(load, depth, load, load * depth)

    def begin(self) -> SpringState:
        """Return untouched springs, or springs at equilibrium under the first load or depth."""
        still = np.zeros(len(self.s))
        untouched = SpringState(0.0, 0.0, still, np.zeros((len(self.s), len(self.tau))), 0.0, self.g)
        if self.schedule.before == "untouched":
            return untouched
        first = self.schedule.at(self.schedule.start, after=False)
        depth, force = self._pressed(self.g, self.relaxed, first)
        memory = np.repeat(force[:, None], len(self.tau), axis=1)
        return SpringState(depth, self._carried(force, first), force, memory, 0.0, self.g)

    def step(self, state: SpringState, start: Instant, end: Instant) -> SpringState:
        """Return the springs after a step in which their forces are linear, up to where springs are left."""
        steps, c = (end.clock - start.clock) / self.tau, self.compliances
        parts = step_parts(steps)
        known = state.memory @ (c * parts.decay) + state.force * float(c @ parts.start)
        compliance = self.instantaneous + float(c @ parts.end)
        threshold = self.g + known
        depth, force = self._pressed(threshold, compliance, end)
        memory = state.memory * parts.decay + state.force[:, None] * parts.start + force[:, None] * parts.end
        away, change = state.force[:, None] - state.memory, force - state.force
        lost = np.square(away) @ (c * parts.own) + float(c @ parts.new) * np.square(change)
        lost += 2.0 * change * (away @ (c * parts.mixed))
        left = np.flatnonzero((state.force > 0.0) & (force == 0.0))
        if len(left) and end.clock - start.clock > 0.0:
            # Else the dent outside a shrinking contact would have errors of first order, seen only on its return.
            first, none = state.force[left], np.zeros(len(left))
            until = (first / (first + (threshold[left] - depth) / compliance))[:, None]
            both = step_parts(np.stack([until, 1.0 - until]) * steps)
            early, late = (StepParts(*(one[place] for one in both)) for place in (0, 1))
            held = state.memory[left] * early.decay + first[:, None] * early.start
            memory[left] = held * late.decay
            lost[left] = _lost(first, none, state.memory[left], early, c) + _lost(none, none, held, late, c)
        dissipated = state.dissipated + float(self.weights @ lost)
        lost_error = state.lost_error + quadrature_error(lost, self.s)
        return SpringState(depth, self._carried(force, end), force, memory, dissipated, threshold, lost_error)

    def settle(self, state: SpringState, instant: Instant, shortest: float) -> SpringState:
        """Return the state soon after a jump; what is not stored of the work at a constant load has been dissipated."""
        quick = self.tau < QUICK * shortest * self.schedule.rates(instant.time, instant.time)[0]
        if not quick.any():
            return state
        known = state.memory[:, ~quick] @ self.compliances[~quick]
        depth, force = self._pressed(self.g + known, self.instantaneous + float(self.compliances[quick].sum()), instant)
        memory = np.where(quick, force[:, None], state.memory)
        found = SpringState(depth, self._carried(force, instant), force, memory, state.dissipated, self.g + known)
        lost = found.load * (depth - state.depth) - (self._stored(found) - self._stored(state))
        lost_error = state.lost_error + quadrature_error(force * (depth - state.depth), self.s)
        return replace(found, dissipated=state.dissipated + lost, lost_error=lost_error)

    def observe(self, state: SpringState) -> Observation:
        """Return load, depth, radius and energies."""
        radius = self.edge(state.force, state.threshold, state.depth)
        extents = {"contact_radius": radius, "dent": float(state.memory[0] @ self.compliances)}
        if state.force[0] > 0.0:
            extents["dent"] = float(state.depth)
        return Observation(
            state.load, state.depth, (0.0, 0.0), np.pi * radius**2, self._stored(state), state.dissipated, extents,
            self._left_out(state),
        )  # fmt: skip

    def _stored(self, state: SpringState) -> float:
        squares = self.instantaneous * np.square(state.force) + np.square(state.memory) @ self.compliances
        return 0.5 * float(self.weights @ squares)

    def _left_out(self, state: SpringState) -> Sizes:
        """Return the discretisation errors of the springs, caused by a force that is not smooth at the contact edge."""
        if self.walled:
            return Sizes(0.0, 0.0, 0.0, 0.0)
        least = (self.spacing / self.radius) ** 2
        load = quadrature_error(state.force, self.s)
        energy = 2.0 * least * state.dissipated + state.lost_error
        depth = least * abs(state.depth)
        if load > 0.0 and state.load > 0.0:
            # Where a load has nearly gone, its error moves only the few springs that touch.
            now = load * self.relaxed / float(self.weights @ (state.force > 0.0))
            depth = max(depth, min(load / state.load * abs(state.depth), now))
        return Sizes(load, depth, 0.0, energy)

    def pressure(self, state: SpringState) -> Field:
        """Return p(r) between the springs, of forces that nowhere rise outwards."""
        from scipy.optimize import isotonic_regression

        r, transform = self._transform
        weights = np.maximum(self.weights, 1e-12 * self.weights.max())
        force = isotonic_regression(state.force, weights=weights, increasing=False).x
        return Field({"r": r}, transform @ np.diff(force, append=0.0))

    def accept(self, state: SpringState, instant: Instant) -> None:
        """Raise `ConvergenceError` where the contact is wider than the row."""
        if state.force[-1] > 0.0 and not self.walled:
            raise ConvergenceError(
                f"at time {instant.time:.4g} s the contact is wider than the row of springs.", code="beyond-springs"
            )

    def memory_of(self, state: SpringState) -> Array:
        """Return the memory, scaled so that half the square of its norm is the energy that it stores."""
        return self._energy_scale * state.memory

    def with_memory(self, state: SpringState, memory: Array) -> SpringState:
        """Return a state with another memory, with its dissipated energy set to zero."""
        return replace(state, memory=memory / self._energy_scale, dissipated=0.0)

    def recovered(self, change: Array, touched: Array, start: Instant, end: Instant) -> Array:
        """Return the change of a memory over a period, divided by 1 − e^(−T/τ), or its like for springs that touch."""
        # Where the load is prescribed, it determines the mean of the springs that touch, as if they were free; relative
        # to each other they stay where they are.
        period = end.clock - start.clock
        freely = -np.expm1(-period / self.tau)
        common = np.zeros_like(change)
        if self.schedule.control == "load" and touched.any():
            shares = np.sqrt(self.weights)
            common = np.outer(shares, (shares * touched) @ change / ((shares * touched) @ shares))
            common[touched == 0.0] = 0.0
        found = (change - common) / freely
        levels = np.ceil(touched * _LEVELS) / _LEVELS
        for level in np.unique(levels[levels > 0.0]):
            these = levels == level
            matrix = recovery_at_depth(self.instantaneous / level, self.compliances, self.tau, period)
            found[these] = (change - common)[these] @ matrix.T
        return np.asarray(found + common / freely)

    def touching(self, state: SpringState) -> Array:
        """Return 1 for each spring that touches, 0 for the others."""
        return np.asarray(state.force > 0.0, dtype=float)

    def coarser_load(self, state: SpringState) -> float:
        """Return the load by every other spring."""
        return float(self._coarser @ state.force[::2])

    @cached_property
    def _coarser(self) -> Array:
        return both_sides(self.s[::2])

    @cached_property
    def _energy_scale(self) -> Array:
        """√(c w) of each spring and mode; its value for a spring of zero weight is arbitrary."""
        weights = np.maximum(self.weights, 1e-12 * self.weights.max())
        return np.asarray(np.sqrt(weights[:, None] * self.compliances))

    @cached_property
    def _transform(self) -> tuple[Array, Array]:
        """Return points r and the matrix from differences of f to p(r): f' is constant between springs."""
        edges = np.append(self.s, self.s[-1] + (self.s[-1] - self.s[-2]))
        r = (0.5 * (edges[:-1] + edges[1:]))[:: max(1, len(self.s) // _POINTS)]
        length = np.diff(edges)
        angle = np.arccosh(np.maximum(edges[None, :] / r[:, None], 1.0))
        return r, -np.diff(angle, axis=1) / (np.pi * length)

    def _pressed(self, threshold: Array, compliance: float, instant: Instant) -> tuple[float, Array]:
        """Return the depth, and the forces of springs with these thresholds and this compliance."""
        if instant.depth is not None:
            return instant.depth, self._force(threshold, compliance, instant.depth)
        depth = self.balance(threshold, float(instant.load) * compliance).depth  # type: ignore[arg-type]
        return depth, self._force(threshold, compliance, depth)

    @staticmethod
    def _force(threshold: Array, compliance: float, depth: float) -> Array:
        return np.maximum(depth - threshold, 0.0) / compliance

    def _carried(self, force: Array, instant: Instant) -> float:
        """Return the load: the prescribed one, without rounding of sums, or else that carried by the springs."""
        return self._load(force) if instant.load is None else instant.load

    def _load(self, force: Array) -> float:
        return float(self.weights @ force)


def _lost(first: Array, last: Array, memory: Array, parts: StepParts, compliances: Array) -> Array:
    """Return the energy that springs (n,) dissipate in a step in which their forces are linear, J/m."""
    away, change = first[:, None] - memory, (last - first)[:, None]
    return np.asarray((parts.own * away**2 + 2.0 * parts.mixed * away * change + parts.new * change**2) @ compliances)
