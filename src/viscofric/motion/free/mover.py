"""A free contact on cells that are fixed to the body, on one grid.

The displacement at the end of a step is u = G [s p + Σ C_k (e_k q_k + α_k p₀)], s = 1/E∞ + Σ C_k β_k: an elastic
contact problem whose surface was deformed before.  It is solved on a window of cells around the indenter.  The memory,
one delayed pressure q_k for each mode, is kept on the cells around the window; farther away, it is kept in pieces that
only fade.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.free.stage import Footprint
from viscofric.errors import ConvergenceError
from viscofric.motion.free.box import Box, Lattice
from viscofric.motion.free.cells import Cells
from viscofric.motion.free.first_states import rested, slid, untouched
from viscofric.motion.free.past import NO_PAST, Far, Past, Wake, parted
from viscofric.motion.free.state import FreeState, Place, Products
from viscofric.motion.memory import Modes, StepCoefficients, recovery_at_depth
from viscofric.motion.mover import Field, Mover, Observation, Sizes
from viscofric.motion.schedule import Instant

# Space by which the box of the memory is wider than it must be, as a part of it.
_SPARE = 0.3
MOST_BYTES = 2**32  # of the memory of one state; a few states are held at a time
_TICK = 1.0  # distance between times at which steps may end, in cells


@dataclass(eq=False)
class FreeMover(Cells, Mover[FreeState]):
    """Steps of a free contact; see `viscofric.motion.mover.Mover`."""

    reach: Extent = field(default=Extent(-math.inf, -math.inf, -math.inf), init=False)  # of all contacts so far
    longest: float = field(default=0.0, init=False)  # the longest of them
    datum: float = field(default=0.0, init=False)  # depth at the start, where depths have no level

    _swept: Box | None = field(default=None, init=False)  # cells of all memories that were read

    @property
    def scales(self) -> Sizes:
        """Sizes that errors are compared with, SI."""
        return self.setting.scales

    def floor(self, largest: Sizes) -> Sizes:
        """Return the errors by the contact conditions: a part of the largest values, of the load of a relaxed one."""
        # Gaps are closed to a part of what the body yields in a step, so that a glassy load leaves no error behind.
        relaxed = self.setting.scale.force * self.setting.geometry.parabolic_load
        return Sizes(*(self.tolerance * one for one in largest._replace(load=min(largest.load, relaxed))))

    @property
    def quickest(self) -> float:
        """Time in which the response to a jump changes noticeably, s of the clock."""
        return self.setting.body.quickest

    def begin(self) -> FreeState:
        """Return the state before the start."""
        schedule = self.setting.schedule
        first = schedule.at(schedule.start, after=False)
        if schedule.before == "untouched":
            state = untouched(self, first)
        elif schedule.before == "at rest":
            state = rested(self, first)
        else:
            state = self._unsettled(slid(self, first, self.setting.first_speed), first)
        self.datum = 0.0 if self.setting.is_levelled else state.depth
        return state

    def _unsettled(self, state: FreeState, instant: Instant) -> FreeState:
        """Return a state of steady sliding with the change of its friction if it meets its contact conditions again."""
        # Its pressure is that of cells that move with the indenter, its memory that of cells fixed to the body, which
        # responds at first as a stiffer solid.
        both = state, self.step(state, instant, instant)
        forces = np.array([(*one.force, *self._on_slopes(one, self._grid_of(one))) for one in both])
        return replace(state, unsettled=float(np.hypot(*(forces[1] - forces[0]).reshape(2, 2).T).max()))

    def step(self, state: FreeState, start: Instant, end: Instant) -> FreeState:
        """Return the state at the end of a step."""
        return self._stepped(state, start, end, self.setting.body.at_once if end.clock - start.clock == 0.0 else 0.0)

    def settle(self, state: FreeState, instant: Instant, shortest: float) -> FreeState:
        """Return the state soon after a jump; what is not stored of the work at a constant load has been dissipated."""
        if state.lagging == 0.0:
            return state
        found = self._stepped(state, instant, instant, 0.0)
        work = self.grid.cell_area * float(found.pressure.sum()) * (found.depth - state.depth)
        lost = work - (self._stored(found) - self._stored(state))
        return replace(found, dissipated=state.dissipated + lost)

    def _stepped(self, state: FreeState, start: Instant, end: Instant, lagging: float) -> FreeState:
        """Return the state at the end of a step; compliances that lag behind remember the pressure before it."""
        setting, body = self.setting, self.setting.body
        duration = end.clock - start.clock
        coefficients = body.over(duration)
        place = self.placed(end)
        load, depth = setting.control(end)
        compliance = body.compliance(coefficients) - lagging
        for _ in self.attempts():
            window = self.window(place)
            box, memory, past = self._near(state, window)
            held = state.window.carried(state.pressure, box)
            left = np.tensordot(body.compliances * coefficients.decay, memory, 1)
            left += (float(body.compliances @ coefficients.start) + lagging) * held
            known = self.response.seen_from(left, box, window)
            far = past.under(self.response, window) if past.pieces else None
            if far is not None:
                known = known + far.weighted(body.compliances * coefficients.decay)
            if state.wake is not None:
                known = known + self._of_wake(state.wake, coefficients, window, end)
            shape = self.height(place) + known
            solved, found = self.solved(compliance, shape, load, depth, self._guess(state, window, place, duration))
            if found is None or not self.widened(found.pressure > 0.0):
                break
        force = self.force(solved[0], known)
        after = self._after(state, coefficients, duration, place, window, box, held, memory, past, far, solved, force)
        change = state.products.pressure - after.products.pressure
        moved = math.hypot(*np.subtract(setting.turned(end.position), setting.turned(start.position)))
        unsettled = state.unsettled * math.exp(-moved / self.grid.spacing)
        return replace(after, lagging=0.5 * self.grid.cell_area * lagging * change, unsettled=unsettled)

    def _near(self, state: FreeState, window: Box) -> tuple[Box, Array, Past]:
        """Return the memory on cells that hold the window and all pieces near it, and the rest."""
        past, near = state.past.split(window)
        box = state.box if state.box.holds(window) else state.box.grown(window, _SPARE)
        for piece, _ in near:
            box = box.joined(piece)
        self._check_size(box, past)
        memory = state.box.carried(state.memory, box)
        for piece, values in near:
            memory = memory + piece.carried(values, box)
        return box, memory, past

    def _check_size(self, box: Box, past: Past) -> None:
        """Refuse a path whose cells do not fit into memory."""
        cells = box.nx * box.ny + sum(piece.box.nx * piece.box.ny for piece in past.pieces)
        size = 8 * len(self.setting.body.times) * cells
        if size > MOST_BYTES:
            raise ConvergenceError(
                f"the path has covered {cells} cells, whose memory needs {size / 2**30:.1f} GiB; shorten the path, or "
                "ask for less accuracy.",
                code="too-long-path",
                values={"gibibytes": size / 2**30},
            )

    def _of_wake(self, wake: Wake, coefficients: StepCoefficients, window: Box, end: Instant) -> Array:
        """Return the displacement by the far wake on a window after a step."""
        if wake.holds_near(window):
            raise ConvergenceError(
                f"at time {end.time:.4g} s the contact returns to where it slid long before the start, which is not "
                "known; give that motion as a part of the history.",
                code="beyond-wake",
            )
        far = wake.faded(coefficients.decay).at(self.response, window)
        return np.asarray((self.setting.body.compliances @ far)[:, None])

    def accept(self, state: FreeState, instant: Instant) -> None:
        """Note how far a contact reaches that the march has accepted."""
        if not state.pressure.any():
            return
        grid = self._grid_of(state)
        loaded = state.pressure > 0.0
        here = grid.extent(loaded)
        place = state.place
        reach = Extent(here.rear + place.x, here.front - place.x, here.side + abs(place.y) * (here.side > 0.0))
        self.reach = Extent(*(max(one, two) for one, two in zip(self.reach, reach, strict=True)))
        self.longest = max(self.longest, here.rear + here.front, 2.0 * here.side)

    def observe(self, state: FreeState) -> Observation:
        """Return what is seen of a state, SI."""
        setting, window = self.setting, self._grid_of(state)
        scale, cell = setting.scale, window.cell_area
        load = cell * float(state.pressure.sum())
        force = scale.force * scale.slope
        along, across = state.force
        area, extents = self._footprint(state, window)
        work, stored = scale.force * scale.depth, self._stored(state)
        friction, energy = force * self._sheared(state, window), work * (stored + state.dissipated)
        # Without a level, what all points share is in the change of the depth; the rest is as large as the unit.
        deep = abs(state.depth) if setting.is_levelled else abs(state.depth - self.datum) + 1.0
        left_out = Sizes(scale.force * load, scale.depth * deep, friction, energy)
        left_out = Sizes(*(setting.body.merged * one for one in left_out))
        if state.duration > 0.0:
            left_out = left_out._replace(friction=left_out.friction + force * state.unsettled)
        return Observation(
            load=scale.force * load,
            depth=scale.depth * (state.depth - self.datum),
            friction_force=setting.unturned(force * along, force * across),
            area=area,
            stored=work * stored,
            dissipated=work * state.dissipated,
            extents=extents,
            left_out=left_out,
            force_on_slopes=setting.unturned(*(force * one for one in self._on_slopes(state, window))),
        )

    def _on_slopes(self, state: FreeState, window: Grid) -> tuple[float, float]:
        """Return the friction force along and across the lattice, ∫ p ∇h dA."""
        i, j = np.nonzero(state.pressure)
        x, y, pressure = window.x[i] - state.place.x, window.y[j] - state.place.y, state.pressure[i, j]
        along = window.cell_area * float(pressure @ self.setting.shape.slope(x, y))
        if self.setting.is_line:
            return along, 0.0
        return along, window.cell_area * float(pressure @ self.setting.shape.slope_across(x, y))

    def _sheared(self, state: FreeState, window: Grid) -> float:
        """Return ∫ p |∇h| dA, the friction of a displacement that does not cancel over the contact; zero at rest."""
        if self.setting.path_length == 0.0:
            return 0.0
        i, j = np.nonzero(state.pressure)
        x, y = window.x[i] - state.place.x, window.y[j] - state.place.y
        steep = self.setting.shape.slope(x, y)
        if not self.setting.is_line:
            steep = np.hypot(steep, self.setting.shape.slope_across(x, y))
        return window.cell_area * float(state.pressure[i, j] @ np.abs(steep))

    def _stored(self, state: FreeState) -> float:
        body, products = self.setting.body, state.products
        twice = body.instant * products.pressure + float(body.compliances @ products.modes)
        return 0.5 * self.grid.cell_area * (twice + body.counterface * state.faced) + state.lagging

    def pressure(self, state: FreeState) -> Field:
        """Return the pressure of a state, from the indenter's axis, SI."""
        window, scale = self._grid_of(state), self.setting.scale
        axes = {"x": scale.length * (window.x - state.place.x)}
        values = scale.pressure * state.pressure
        if window.shape[1] == 1:
            return Field(axes, values[:, 0])
        return Field({**axes, "y": scale.length * (window.y - state.place.y)}, values)

    def early(self, since: float) -> float:
        """Return how many times as large the error of merged modes is so soon after a jump, s of the clock."""
        return self.setting.modes.growth_of_error(Modes.of(self.setting.schedule.spectrum), since)

    def ticks(self, start: Instant, end: Instant) -> Array:
        """Return times since a start at which steps may end: the indenter is a whole number of cells away."""
        return self.setting.ticks(start, end, _TICK * self.grid.spacing)

    def memory_of(self, state: FreeState) -> Array:
        """Return the memory on the cells of all memories so far, scaled by the root of its compliances."""
        box, memory = state.box, state.memory
        for piece, left in zip(state.past.pieces, state.past.left, strict=True):
            whole = box.joined(piece.box)
            memory = box.carried(memory, whole) + piece.box.carried(left[:, None, None] * piece.memory, whole)
            box = whole
        self._swept = box if self._swept is None else self._swept.joined(box)
        return np.asarray(self._roots * box.carried(memory, self._swept))

    def with_memory(self, state: FreeState, memory: Array) -> FreeState:
        """Return a state with another memory, which has not dissipated anything yet."""
        box = self._swept or state.box
        fields = memory / self._roots
        own = np.array([float(np.vdot(one, self.response(one))) for one in fields])
        products = state.products
        # The products with the pressure are those after the next step, a jump.
        return replace(
            state,
            box=box,
            memory=fields,
            past=NO_PAST,
            dissipated=0.0,
            unsettled=0.0,
            products=Products(products.pressure, products.mixed, own),
        )

    def recovered(self, change: Array, touched: Array, start: Instant, end: Instant) -> Array:
        """Return the change of a memory over a period, over 1 − e^(−T/τ) or, at a given depth, over its like."""
        body, period = self.setting.body, end.clock - start.clock
        if self.setting.schedule.is_held:
            instantaneous = body.instant + body.counterface
            matrix = recovery_at_depth(instantaneous, body.compliances, body.times, period)
            return np.tensordot(matrix, change, 1)
        return np.asarray(change / -np.expm1(-period / body.times)[:, None, None])

    def memory_from(self, coarser: FreeMover, memory: Array) -> Array:
        """Return the memory of a mover with other cells on the cells of this one."""
        assert coarser._swept is not None
        times, theirs = self.setting.body.times, coarser.setting.body.times
        here = Lattice(coarser._swept, coarser.grid.spacing, coarser.grid.width, theirs)
        there = here.finer(self.grid.spacing, self.grid.width, times)
        self._swept = there.box
        return np.asarray(self._roots * here.carried(memory / coarser._roots, there))

    @property
    def _roots(self) -> Array:
        return np.asarray(np.sqrt(self.setting.body.compliances)[:, None, None])

    def _grid_of(self, state: FreeState) -> Grid:
        behind = state.place.i - state.window.i
        sized = replace(self.grid, behind=behind, ahead=state.window.nx - behind)
        return sized if sized.is_strip else replace(sized, beside=state.window.ny // 2)

    def _guess(self, state: FreeState, window: Box, place: Place, duration: float) -> Array:
        """Return the last pressure with its trend, moved with the indenter."""
        ratio = min(1.0, duration / state.duration) if state.duration > 0.0 else 0.0
        moved = Box(
            state.window.i + place.i - state.place.i, state.window.j + place.j - state.place.j, *state.window.shape
        )
        guess = moved.carried(state.pressure + ratio * state.trend, window)
        shift = (place.x - state.place.x) / self.grid.spacing
        if abs(shift) > 1e-6:
            guess = _shifted(guess, shift)
        return np.maximum(guess, 0.0)

    def _after(
        self,
        state: FreeState,
        coefficients: StepCoefficients,
        duration: float,
        place: Place,
        window: Box,
        box: Box,
        held: Array,
        memory: Array,
        past: Past,
        far: Far | None,
        solved: tuple[Array, float, float],
        force: tuple[float, float],
    ) -> FreeState:
        pressure, _, depth = solved
        body, cell = self.setting.body, self.grid.cell_area
        now = window.carried(pressure, box)
        spread = self.response(now)
        end, with_end = float(np.vdot(now, spread)), float(np.vdot(held, spread))
        flat = memory.reshape(len(memory), spread.size)
        modes_with_end = flat @ spread.ravel()
        if far is not None:
            modes_with_end = modes_with_end + far.with_pressure(pressure)
        wake = state.wake
        if wake is not None:
            modes_with_end = modes_with_end + wake.at(self.response, window) @ pressure.sum(axis=1)
            wake = wake.faded(coefficients.decay)
        lost = 0.0
        if duration > 0.0:
            each = state.products.dissipated(duration / body.times, with_end, modes_with_end, end)
            lost = cell * float(body.compliances @ each)
        decay, first, last = (one[:, None, None] for one in coefficients)
        advanced = memory if duration == 0.0 else decay * memory
        if duration > 0.0:
            advanced[(..., *window.within(box))] += last * pressure
            advanced[(..., *state.window.within(box))] += first * state.pressure
        box, advanced, cut = parted(box, advanced, window)
        faced = 0.0
        if body.counterface > 0.0:
            facing = self.facing or self.response
            faced = float(np.vdot(pressure, facing(pressure)))
        same = (window.shape == state.window.shape) and duration > 0.0
        return FreeState(
            place=place,
            window=window,
            pressure=pressure,
            trend=pressure - state.pressure if same else np.zeros_like(pressure),
            duration=duration,
            box=box,
            memory=advanced,
            products=state.products.after(coefficients, with_end, modes_with_end, end),
            faced=faced,
            depth=depth,
            dissipated=state.dissipated + lost,
            force=force,
            past=past.faded(coefficients.decay).joined(cut),
            wake=wake,
        )

    def _footprint(self, state: FreeState, window: Grid) -> tuple[float, dict[str, float]]:
        scale, line = self.setting.scale, window.shape[1] == 1
        if not state.pressure.any():
            names = ("front", "rear") if line else ("front", "rear", "half_width")
            return 0.0, dict.fromkeys(names, 0.0)
        print_ = Footprint.of(window, state.pressure)
        extents = {
            "front": scale.length * (print_.front - state.place.x),
            "rear": scale.length * (print_.rear + state.place.x),
        }
        if not line:
            extents["half_width"] = scale.length * print_.side
        return scale.area * print_.area, extents


def _shifted(values: Array, shift: float) -> Array:
    """Return values moved by a part of a cell along x."""
    moved = np.zeros_like(values)
    share = abs(shift)
    if shift > 0.0:
        moved[1:] = values[:-1]
    else:
        moved[:-1] = values[1:]
    return np.asarray((1.0 - share) * values + share * moved)
