"""Rough periodic surfaces under a pressure or a gap, along any path: steps in the indenter's frame, wave by wave.

Each step is the contact problem of an elastic or steadily sliding solid with another transfer function and a height to
which the displacement left by the past is added.  The memory is exact for every wave, so that steady sliding is solved
exactly with steps of any length, and speed and direction may change from step to step.

Inside, depths are in rms heights and compliances in that of the most compliant wave after an infinite time.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, ComplexArray, Mask
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.extension import Extension
from viscofric.contact.periodic.operator import PeriodicOperator
from viscofric.contact.periodic.surface import PeriodicSurface, flattening_pressure
from viscofric.motion.memory import Modes, quickest_time, recovery_at_depth
from viscofric.motion.mover import QUICK, Field, Mover, Observation, Problem, Sizes
from viscofric.motion.schedule import Instant
from viscofric.motion.wave_contact import StepContact, Target
from viscofric.motion.wave_memory import StepResponse, advance, merged_modes, stored_energy
from viscofric.motion.waves import Waves

# Gap that is left by a step, as a part of what the step may add to the error, over the displacement at once
# (from the least one on, in rms heights); of the first contact, a part of that.
_TIGHTNESS, _LEAST_DISPLACEMENT, _FIRST = 0.25, 1e-5, 0.1
# Factor of the tolerance where it causes errors that steps do not reduce, and the smallest one, above rounding.
_TIGHTER, _TIGHTEST = 0.1, 1e-8
# Friction coefficient, over the rms slope of the surface, that is resolved to the accuracy.
_LEAST_FRICTION = 0.1
# Steps whose transfer functions are kept: one, and its halves.
_KEPT = 2
# Points from which on residuals are extended, which saves products but costs time; blocks and reach, in cells.
_EXTENDED, _BLOCK, _REACH = 10_000, 4, 1.0
_SHARES = (0.05, 0.3)  # see `march`: for ridges, and for spots, where errors of steps that come and go nearly cancel
_FOLLOWED = 1e30  # step of a mode that has followed, in its time
_SAME = 1e-12  # relative difference up to which steps are the same
_SINGLE = 1e-4  # accuracy from which on memory is in single precision: each step rounds it to 6e-8 of itself


@dataclass(frozen=True, eq=False)
class PeriodicState:
    """Contact at one time, without units."""

    pressure: Array  # (nx, ny)
    waves: ComplexArray  # (rows, columns) of the pressure
    memory: ComplexArray = field(repr=False)  # (n, rows, columns) delayed pressure of each mode times √(w G)
    depth: float
    friction: tuple[float, float]  # per area, along x and y
    stored: float  # per area
    dissipated: float
    trend: Array | None = None  # (nx, ny) rate of change of the pressure in the step before, 1/s
    lagging: float = 0.0  # after a jump: energy of the modes without a field minus that after they have followed


class _Step(NamedTuple):
    """Quantities common to steps of one length along one path."""

    response: StepResponse
    contact: StepContact


class PeriodicMover(Mover[PeriodicState]):
    """A periodic surface that moves through a schedule."""

    def __init__(self, problem: Problem, modes: Modes | None = None, times: Iterable[float] = ()) -> None:
        surface, schedule = problem.indenter, problem.schedule
        assert isinstance(surface, PeriodicSurface)
        self.schedule, self.surface = schedule, surface
        self.grid = Waves(surface.shape, surface.spacing, problem.material.poisson_ratio, problem.layer)
        self.backend = Backend()
        self.merged = spectrum = merged_modes(problem, times) if modes is None else modes
        self.depth_unit = surface.rms_height  # m; the others: m/Pa, Pa
        response = self.grid.response
        self.response_unit = float(response.max())
        self.compliance_unit = self.response_unit * spectrum.relaxed
        largest = 0.0 if schedule.control == "gap" else schedule.insist_on_contact()
        self.pressure_unit = flattening_pressure(self.depth_unit, self.compliance_unit, largest)
        unit = 1.0 / spectrum.relaxed
        self.modes = Modes(
            unit * spectrum.instantaneous, unit * spectrum.C, spectrum.tau, spectrum.error, unit * spectrum.at_once
        )
        self._shape = response / self.response_unit
        self._scale = np.sqrt(self.grid.weights * self._shape)  # √(w G), a factor of the memory
        self._unscaled = np.sqrt(self._shape / self.grid.weights)
        self._softness = np.sqrt(self.grid.weights) * self._shape
        self._softness[0, 0] = 0.0
        self._rigid = np.zeros((1, 1))
        if problem.counterface:
            self._rigid = self.grid.rigid_factor * (problem.counterface / self.compliance_unit)
        self.height = (surface.z.max() - surface.z) / self.depth_unit
        self.mean_height = float(self.height.mean())
        self._steepness = np.hypot(*(surface.slope(axis) for axis in ((1.0, 0.0), (0.0, 1.0)))) / surface.z.size
        self.precision = np.complex64 if problem.accuracy >= _SINGLE else np.complex128
        self.share = _SHARES[min(surface.shape) > 1]
        self._tightness = _TIGHTNESS * self.share * problem.accuracy
        self._extension = None
        if math.prod(surface.shape) >= _EXTENDED:
            # Without the lag behind edges, which costs more than it saves where few iterations are left.
            self._extension = Extension(self.backend, surface.shape, np.float32, block=_BLOCK, reach=_REACH)
        self.products = 0
        self._steps: dict[tuple[float, ...], _Step] = {}

    @property
    def scales(self) -> Sizes:
        """Sizes that errors are compared with."""
        highest = self.schedule.largest
        pressure = self.pressure_unit if self.schedule.control == "gap" else highest
        slope = max(float(self.surface.slope(axis).std()) for axis in ((1.0, 0.0), (0.0, 1.0)))
        return Sizes(pressure, self.depth_unit, _LEAST_FRICTION * slope * pressure, pressure * self.depth_unit)

    def floor(self, largest: Sizes) -> Sizes:
        """Return the errors by the contact conditions: a part of the largest values."""
        return Sizes(*(self._tightness * one for one in largest))

    @property
    def can_tighten(self) -> bool:
        """Whether the tolerance is above that of rounding."""
        return _TIGHTER * self._tightness >= _TIGHTEST

    def tighten(self) -> None:
        """Lower the tolerance of the contact conditions, and keep the memory in double precision."""
        # A stiff response multiplies rounding errors of the memory by E_inf/E0.
        self._tightness *= _TIGHTER
        self.precision = np.complex128

    @property
    def quickest(self) -> float:
        """Time in which the response to a jump changes noticeably, s of the clock."""
        return quickest_time(self.modes.instantaneous, self.modes.C, self.modes.tau)

    def begin(self) -> PeriodicState:
        """Return the state just before the start."""
        schedule, modes = self.schedule, self.modes
        nothing = np.zeros(self.surface.shape)
        waves = self.grid.of(nothing)
        first = schedule.at(schedule.start, after=False)
        if schedule.before == "untouched":
            memory = np.zeros((len(modes), *waves.shape), self.precision)
            depth = 0.0 if first.gap is None else self.mean_height - first.gap / self.depth_unit
            return PeriodicState(nothing, waves, memory, depth, (0.0, 0.0), 0.0, 0.0)
        moving = schedule.velocity(schedule.start, after=False)
        turn = self.grid.turn(moving)
        # A steady wave has q = p/(1 − iτ q·v).
        shares = [1.0 / (1.0 - 1j * time * turn) if moving.any() else np.ones((1, 1)) for time in modes.tau]
        parts = (C * share for C, share in zip(modes.C, shares, strict=True))
        compliance = sum(parts, np.full((1, 1), modes.instantaneous))
        problem = self._made(StepResponse.steady(turn, compliance), moving)
        past = np.zeros(turn.shape, complex)
        pressure, depth = self._solved(problem, past, first, None)
        waves = self.grid.of(pressure)
        if pressure.any():
            # Once more, to the tolerance of the steps that follow, which respond at first as a stiffer solid.
            guess = PeriodicState(pressure, waves, past, depth, (0.0, 0.0), 0.0, 0.0)
            pressure, depth = self._solved(problem, past, first, guess)
            waves = self.grid.of(pressure)
        scaled = self._scale * waves
        memory = np.empty((len(modes), *waves.shape), self.precision)
        for each, share in zip(memory, shares, strict=True):
            each[...] = share * scaled
        energies = stored_energy(modes, memory), 0.0
        return self._state(pressure, (waves, scaled), memory, problem.response, past, depth, energies, None)

    def step(self, state: PeriodicState, start: Instant, end: Instant) -> PeriodicState:
        """Return the state at the end of a step or jump."""
        lagging = self.modes.at_once if end.clock - start.clock == 0.0 else 0.0
        found = self._stepped(state, start, end, lagging)
        if lagging == 0.0:
            return found
        change = np.linalg.norm(self._scale * state.waves) ** 2 - np.linalg.norm(self._scale * found.waves) ** 2
        return replace(found, lagging=0.5 * lagging * float(change))

    def settle(self, state: PeriodicState, instant: Instant, shortest: float) -> PeriodicState:
        """Return the state soon after a jump; what is not stored of the work at a constant load has been dissipated."""
        quick = self.modes.tau < QUICK * shortest * self.schedule.rates(instant.time, instant.time)[0]
        if state.lagging == 0.0 and not quick.any():
            return state
        found = self._stepped(state, instant, instant, 0.0, quick=quick)
        work = float(found.pressure.mean()) * (found.depth - state.depth)
        lost = work - (found.stored - state.stored - state.lagging)
        return replace(found, dissipated=state.dissipated + lost)

    def _stepped(
        self, state: PeriodicState, start: Instant, end: Instant, lagging: float, quick: Mask | None = None
    ) -> PeriodicState:
        """Return the state at the end of a step; compliances that lag behind remember the pressure before it."""
        # Quick modes follow in no time.
        path = np.asarray(end.position) - np.asarray(start.position)
        clock_step = end.clock - start.clock
        if quick is not None and quick.any():
            problem = self._made(StepResponse.of(self.modes, np.where(quick, _FOLLOWED, 0.0), np.zeros((1, 1))), path)
        else:
            problem = self._step_of(clock_step, path, lagging)
        past = problem.response.known(self.modes, state.memory, self._scale * state.waves)
        pressure, depth = self._solved(problem, past, end, state, clock_step)
        waves = self.grid.of(pressure)
        begun, scaled = self._scale * state.waves, self._scale * waves
        held = state.stored - self._elastic_energy(state.waves, begun)
        after = advance(problem.response, self.modes, state.memory, (begun, scaled), held)
        trend = (pressure - state.pressure) / clock_step if clock_step > 0.0 else None
        done = after.stored, state.dissipated + after.dissipated
        return self._state(pressure, (waves, scaled), after.memory, problem.response, past, depth, done, trend)

    def observe(self, state: PeriodicState) -> Observation:
        """Return the observed quantities of a state, per area."""
        work = self.pressure_unit * self.depth_unit
        loaded = np.count_nonzero(state.pressure > 0.0)
        load, depth = self.pressure_unit * float(state.pressure.mean()), self.depth_unit * abs(state.depth)
        part = self.modes.error
        # Errors of the displacement need not cancel over a contact as those of an elastic one do.
        friction = self.pressure_unit * float(np.vdot(state.pressure, self._steepness))
        energy = work * (state.stored + state.dissipated)
        left_out = Sizes(part * load, part * depth, part * friction, part * energy)
        return Observation(
            load=load,
            depth=self.depth_unit * state.depth,
            friction_force=(work * state.friction[0], work * state.friction[1]),
            area=float(loaded) / state.pressure.size,
            stored=work * (state.stored + state.lagging),
            dissipated=work * state.dissipated,
            extents={},
            left_out=left_out,
        )

    def pressure(self, state: PeriodicState) -> Field:
        """Return the pressure of a state, Pa, on the surface's own points."""
        return Field({"x": self.surface.x, "y": self.surface.y}, self.pressure_unit * state.pressure)

    def pointwise_difference(self, one: PeriodicState, other: PeriodicState) -> float:
        """Return the root of the sum of the squares by which the friction of each point differs between two states."""
        return self.pressure_unit * float(np.linalg.norm((one.pressure - other.pressure) * self._steepness))

    def rate_change(
        self, first: PeriodicState, middle: PeriodicState, last: PeriodicState, start: Instant, end: Instant
    ) -> float:
        """Return how much more friction changes in another step like the last one, if points touch or leave at rest.

        A point that touches or leaves late in a step hardly changes the friction yet, but alters the rates at which all
        pressures change.
        """
        loaded = [one.pressure > 0.0 for one in (first, middle, last)]
        changed = any(np.any(one != other) for one, other in itertools.pairwise(loaded))
        if not changed or not loaded[0].any() or not np.array_equal(end.position, start.position):
            return 0.0
        following = end
        if start.pressure is not None and end.pressure is not None:
            following = end._replace(pressure=max(0.0, 2.0 * end.pressure - start.pressure))
        elif start.gap is not None and end.gap is not None:
            following = end._replace(gap=2.0 * end.gap - start.gap)
        later = self._stepped(last, start, following, 0.0)
        forces = np.array([one.friction for one in (middle, last, later)])
        return self.pressure_unit * self.depth_unit * math.hypot(*np.diff(forces, 2, axis=0)[0])

    def early(self, since: float) -> float:
        """Return how many times as large the error of merged modes is so soon after a jump, s of the clock."""
        return self.merged.growth_of_error(Modes.of(self.schedule.spectrum), since)

    def memory_of(self, state: PeriodicState) -> NDArray[Any]:
        """Return the memory, scaled so that half the square of its norm is the energy that it stores."""
        return np.asarray(self._roots * state.memory)

    def with_memory(self, state: PeriodicState, memory: NDArray[Any]) -> PeriodicState:
        """Return a state with another memory, with its dissipated energy set to zero."""
        change = float(np.linalg.norm(memory) ** 2 - np.linalg.norm(self.memory_of(state)) ** 2)
        found = np.asarray(memory / self._roots, dtype=complex)
        return replace(state, memory=found, stored=state.stored + 0.5 * change, dissipated=0.0)

    def recovered(self, change: NDArray[Any], touched: Array, start: Instant, end: Instant) -> NDArray[Any]:
        """Return the change of a memory over a period, divided by 1 − e^z or, at a given gap, by its like."""
        modes = self.modes
        if self.schedule.is_held:
            matrix = recovery_at_depth(modes.instantaneous, modes.C, modes.tau, end.clock - start.clock)
            return np.tensordot(matrix, change, 1)
        turn = self.grid.turn(np.asarray(end.position) - np.asarray(start.position))
        steps = ((end.clock - start.clock) / self.modes.tau)[:, None, None]
        return change / -np.expm1(-steps + 1j * turn)

    @cached_property
    def _roots(self) -> Array:
        """√C of each mode."""
        return np.asarray(np.sqrt(self.modes.C)[:, None, None])

    def _state(
        self,
        pressure: Array,
        both: tuple[ComplexArray, ComplexArray],
        memory: ComplexArray,
        response: StepResponse,
        past: ComplexArray,
        depth: float,
        energies: tuple[float, float],
        trend: Array | None,
    ) -> PeriodicState:
        """Return a solved state, given the energy that its modes store and all that has been dissipated."""
        # `both` are the waves of the pressure, and those scaled as the memory is.
        waves, scaled = both
        mean = self._shape[0, 0] * response.end[0, 0] * waves[0, 0] + self._unscaled[0, 0] * past[0, 0]
        depth += float(mean.real) / pressure.size
        # The mean of −p ∂u/∂x, to which an elastic indenter adds nothing.
        work = response.end * scaled
        work += past
        work *= np.conj(scaled)
        qx, qy = self.grid.numbers
        friction = float(work.imag.sum(axis=1) @ qx[:, 0]), float(work.imag.sum(axis=0) @ qy[0])
        stored = self._elastic_energy(waves, scaled) + energies[0]
        return PeriodicState(pressure, waves, memory, depth, friction, stored, energies[1], trend)

    def _elastic_energy(self, waves: ComplexArray, scaled: ComplexArray) -> float:
        """Return the energy that is stored in no mode, given the waves of the pressure, and scaled ones."""
        found = self.modes.instantaneous * float(np.vdot(scaled, scaled).real)
        if self._rigid.any():
            found += float(np.vdot(waves, self.grid.weights * self._rigid * waves).real)
        return 0.5 * found

    def _step_of(self, clock_step: float, path: Array, lagging: float) -> _Step:
        """Return the problem of a step, kept from one that differs by rounding only."""
        for (step, x, y, late), problem in self._steps.items():
            far = math.hypot(x - path[0], y - path[1])
            if abs(step - clock_step) <= _SAME * step and far <= _SAME * math.hypot(x, y) and late == lagging:
                return problem
        response = StepResponse.of(self.modes, clock_step / self.modes.tau, self.grid.turn(path))
        if lagging > 0.0:
            response = replace(response, start=response.start + lagging, end=response.end - lagging)
        while len(self._steps) >= _KEPT:
            del self._steps[next(iter(self._steps))]
        problem = self._made(response, path)
        self._steps[clock_step, float(path[0]), float(path[1]), lagging] = problem
        return problem

    def _made(self, response: StepResponse, path: Array) -> _Step:
        transfer = self.grid.folded(self._shape * response.end + self._rigid)
        transfer[0, 0] = 0.0  # the mean displaces all points equally
        shape, spacing = self.surface.shape, self.surface.spacing
        exact = PeriodicOperator(transfer, shape, backend=self.backend)
        toward = (path[0] / spacing[0], path[1] / spacing[1]) if path.any() else (1.0, 0.0)
        return _Step(response, StepContact(exact, exact.for_corrections(), self._extension, toward, self._elastic))

    def _solved(
        self, problem: _Step, past: ComplexArray, end: Instant, state: PeriodicState | None, clock_step: float = 0.0
    ) -> tuple[Array, float]:
        """Return the pressure and the depth, without the mean displacement, at the end of a step."""
        known = self.grid.folded(self._unscaled * past)
        known[0, 0] = 0.0  # a mean displacement is added to the depth afterwards
        load = indentation = before = None
        if end.gap is None:
            load = end.pressure / self.pressure_unit * self.height.size  # type: ignore[operator]
        else:
            indentation = self.mean_height - end.gap / self.depth_unit
        if state is not None and load != 0.0 and state.pressure.any():
            before = self._continued(state, load, clock_step)
            added = self.backend.transforms.forward(before)
            added *= problem.contact.exact.transfer
            known += added
            del added
            before = before if before.any() else None
        gap = self.grid.unfolded_field(known) + self.height
        del known  # large
        if before is None and (load == 0.0 or (indentation is not None and indentation <= float(gap.min()))):
            return np.zeros(gap.shape), float(gap.min()) if indentation is None else indentation
        if load is not None and before is not None and before.min() > 0.0:
            # Full contact that persists is a linear problem.
            level = float(gap.mean())
            pressure = before + problem.contact.exact.precondition(level - gap)
            pressure += load / gap.size - float(pressure.mean())
            if float(pressure.min()) >= 0.0:
                self.products += 1
                return pressure, level
        target = Target(load, indentation, self._tolerance(None if state is None else state.waves))
        pressure, depth, products = problem.contact.solved(gap, before, target)
        self.products += products
        return pressure, depth

    def _continued(self, state: PeriodicState, load: float | None, clock_step: float) -> Array:
        """Return the pressure of a state changed as in the step before, for a given load (the sum of all points)."""
        found = state.pressure.copy()
        if state.trend is not None:
            found += clock_step * state.trend
            np.maximum(found, 0.0, out=found)
        # Also of a state without a trend: the contact conditions of a steady one are met by the old load.
        total = float(found.sum())
        if load is not None and total > 0.0:
            found *= load / total
        return found

    def _tolerance(self, waves: ComplexArray | None) -> float:
        """Return a tolerance of the gap in rms heights, tighter for light pressures (waves of the last one)."""
        if waves is None:
            return _FIRST * self._tightness
        rms = self.modes.instantaneous * float(np.linalg.norm(self._softness * waves))
        return self._tightness * min(1.0, max(_LEAST_DISPLACEMENT, rms))

    def _elastic(self) -> Array:
        """Transfer function of an elastic solid, with the mean at zero and the largest value one."""
        found = self.grid.folded(self._shape).copy()
        found[0, 0] = 0.0
        return np.asarray(found / found.max())
