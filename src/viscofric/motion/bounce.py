"""An indenter of some mass on a row of springs with memory: contact, flight, and contact again.

The equation of motion m δ̈ = m g − F(δ, memory) is advanced by the linear-acceleration method: the force of every
spring is linear within a step, the memory exact, and

    δ₁ = δ₀ + v₀ h + h² (2a₀ + a₁)/6,    v₁ = v₀ + h (a₀ + a₁)/2

(N. M. Newmark, J. Eng. Mech. Div. 85 (1959) 67, with β = 1/6).  With the thresholds b of the springs in order, the
first n of which touch, F = Σ w (δ₁ − b)/c: δ₁ follows without iteration.  In flight the memory fades by itself; the
next contact begins where the surface and the indenter meet.

A first run chooses the steps by the stiffness of the contact at each time; the others divide them, so that their errors
fall with the square of the division and can be extrapolated.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import ConvergenceError
from viscofric.motion.history import dense_parts
from viscofric.motion.memory import StepParts, step_parts
from viscofric.motion.springs import Springs, quadrature_error

#: Steps of the first run, by the time of the contact's own oscillation, and their growth.
_BY_STIFFNESS, _GROWTH = 0.14, 1.4
#: Steps of one contact after which the indenter is taken to rest, and reversals of its motion.
_MOST_STEPS, _MOST_REVERSALS = 20_000, 4
#: Under gravity, the same after so many steps of the first run at a part of the first speed.
_RESTING, _SLOW = 500, 0.01
_SECANTS = 60
#: Times of a flight that are recorded.
_IN_FLIGHT = 40
#: Parts of the time in which the indenter would fall back to where it left, at which the gap is looked at.
_PARTS_OF_FLIGHT = np.geomspace(1e-6, 1.0, 100).tolist()


class _Step(NamedTuple):
    """Coefficients of a step, of all modes together where they are needed so."""

    fading: Array  # (modes,) c decay
    start: float  # Σ c start
    compliance: float
    decay: Array  # (modes, 1)
    ends: Array  # (modes, 2): start, end
    own: Array  # (modes,), with c
    mixed: Array
    new: float

    @classmethod
    def of(cls, springs: Springs, parts: StepParts) -> _Step:
        c = springs.compliances
        compliance = springs.instantaneous + float(c @ parts.end)
        ends = np.stack([parts.start, parts.end], axis=1)
        own, mixed, new = c * parts.own, 2.0 * c * parts.mixed, float(c @ parts.new)
        return cls(c * parts.decay, float(c @ parts.start), compliance, parts.decay[:, None], ends, own, mixed, new)


class Contact(NamedTuple):
    """One contact: its times, speeds and largest values; `separation` is None if the indenter stays."""

    start: float
    duration: float
    speed_in: float
    speed_out: float
    peak_force: float
    largest_depth: float
    time_of_largest: float
    separation_depth: float
    separates: bool
    #: Least indentation into the surface that is left after the first turn; after a separation, the largest gap before
    #: the surface or the indenter comes back; m
    margin: float = math.inf
    leaving: float = 0.0  # speed upwards at that indentation, or after the separation, m/s


@dataclass(eq=False)
class Bounce:
    """A run of one or several contacts; `meshes` are the steps of each contact of an earlier run."""

    springs: Springs
    mass: float
    gravity: float
    first_step: float
    meshes: list[list[float]] | None = None
    division: int = 1
    recorded: bool = False
    contacts: list[Contact] = field(default_factory=list)
    taken: list[list[float]] = field(default_factory=list)
    #: Of each step: time, depth, speed, force, radius, stored and dissipated energy, error of the force by springs
    rows: list[tuple[float, ...]] = field(default_factory=list)

    def run(self, speed: float, rebounds: int) -> Bounce:
        """Let the indenter touch with a speed, and follow it through so many contacts."""
        springs = self.springs
        self._step = -1.0
        self._planned = self._parts_of_meshes()
        self._force = np.zeros(len(springs.g))
        self._memory = np.zeros((len(springs.tau), len(springs.g)))
        self._lost = 0.0
        time, depth = 0.0, float(springs.g[0])
        for number in range(rebounds):
            contact, depth = self._contact(number, time, depth, speed)
            self.contacts.append(contact)
            if not contact.separates or number + 1 == rebounds:
                break
            flight = self._flight(contact.start + contact.duration, depth, contact.speed_out)
            if flight is None:
                break
            time, depth, speed = flight
        return self

    def _contact(self, number: int, start: float, depth: float, speed: float) -> tuple[Contact, float]:
        """Follow one contact; return it, and the depth at its end."""
        m, g = self.mass, self.gravity
        mesh = None if self.meshes is None or number >= len(self.meshes) else self.meshes[number]
        planned = iter(() if mesh is None else [one / self.division for one in mesh for _ in range(self.division)])
        time, v, force = 0.0, speed, 0.0
        taken: list[float] = []
        deepest, deepest_time, peak, last_forces = depth, 0.0, 0.0, ((0.0, 0.0), (0.0, 0.0))
        step, stiffness, reversals, margin, leaving = self.first_step, 0.0, 0, math.inf, 0.0
        self._record(start, depth, v, 0.0, 0.0)
        for _ in range(_MOST_STEPS):
            step = next(planned, None) or self._next_step(step, stiffness, mesh is not None)
            a = g - force / m
            threshold, compliance = self._predict(step)
            free = depth + v * step + step**2 * (2.0 * a + g) / 6.0
            found = self.springs.balance(threshold, free, step**2 / (6.0 * m * compliance), held=1.0)
            if not found.touched:  # any more
                taken.append(step)
                step = self._separation(depth, v, a, step)
                self._predict(step)
                final = depth + v * step + step**2 * (2.0 * a + g) / 6.0
                self._complete(np.zeros_like(threshold))
                out = v + 0.5 * step * (a + g)
                time += step
                self._record(start + time, final, out, 0.0, 0.0)
                self.taken.append(taken)
                margin = self._largest_gap(final, -out)
                return Contact(start, time, speed, -out, peak, deepest, deepest_time, final, True, margin, -out), final
            if found.touched == len(threshold) and not self.springs.walled:
                raise ConvergenceError("the contact is wider than the row of springs.", code="beyond-springs")
            new, stiffness = found.depth, found.weight / compliance
            spring_forces = np.maximum(new - threshold, 0.0) / compliance
            force = float(self.springs.weights @ spring_forces)
            self._complete(spring_forces)
            a1 = g - force / m
            v1 = v + 0.5 * step * (a + a1)
            if v > 0.0 >= v1:
                # v is a parabola through both accelerations
                part = _root_of_speed(v, a * step, a1 * step)
                at_most = depth + step * part * (v + step * part * (3.0 * a + part * (a1 - a)) / 6.0)
                if at_most > deepest:
                    deepest, deepest_time = at_most, time + part * step
            if v * v1 < 0.0:
                reversals += 1
            if reversals and new - found.first < margin:
                margin, leaving = new - found.first, max(-v1, 0.0)
            depth, v, time = new, v1, time + step
            peak = max(peak, _top(last_forces, (time, force))) if force >= 0.5 * peak else peak
            last_forces = (last_forces[1], (time, force))
            taken.append(step)
            if self.recorded:
                self._record(start + time, depth, v, force, self.springs.edge(spring_forces, threshold, new))
            resting = self.gravity > 0.0 and len(taken) >= _RESTING * self.division and abs(v) < _SLOW * speed
            if reversals >= _MOST_REVERSALS or resting:
                self.taken.append(taken)
                if depth > deepest:
                    deepest, deepest_time = depth, time
                return Contact(
                    start, math.inf, speed, 0.0, peak, deepest, deepest_time, depth, False, margin, leaving
                ), depth
        raise ConvergenceError("the indenter neither leaves the surface nor comes to rest.", code="endless-contact")

    def _next_step(self, step: float, stiffness: float, planned: bool) -> float:
        if planned or stiffness == 0.0:
            return step
        return min(_GROWTH * step, _BY_STIFFNESS * math.sqrt(self.mass / stiffness))

    def _parts_of_meshes(self) -> dict[float, _Step]:
        """Return the coefficients of all steps that are planned, computed at once."""
        steps = sorted({one / self.division for mesh in self.meshes or () for one in mesh})
        if not steps:
            return {}
        every = step_parts(np.array(steps)[:, None] / self.springs.tau)
        each = (StepParts(*(part[place] for part in every)) for place in range(len(steps)))
        return {step: _Step.of(self.springs, parts) for step, parts in zip(steps, each, strict=True)}

    def _predict(self, step: float) -> tuple[Array, float]:
        """Return the depths at which springs touch at the end of a step, and by how much they give way."""
        if step != self._step:
            self._step = step
            found = self._planned.get(step)
            self._now = found or _Step.of(self.springs, step_parts(step / self.springs.tau))
        threshold = self._now.fading @ self._memory
        threshold += self._now.start * self._force
        threshold += self.springs.g
        return threshold, self._now.compliance

    def _complete(self, force: Array) -> None:
        """Advance memory and dissipated energy over the step that was predicted."""
        now = self._now
        if self.recorded:
            weights = self.springs.weights
            away, change = self._force - self._memory, force - self._force
            weighted = weights * change
            self._lost += float(
                (now.own @ np.square(away)) @ weights + (now.mixed @ away) @ weighted + now.new * (weighted @ change)
            )
        # decay q₀ + start f₀ + end f₁
        self._memory *= now.decay
        self._memory += now.ends @ np.stack([self._force, force])
        self._force = force

    def _separation(self, depth: float, v: float, a: float, step: float) -> float:
        """Return the part of a step after which the indenter only just touches, found by regula falsi."""

        def gap(part: float) -> float:
            threshold, _ = self._predict(part)
            return float(threshold.min()) - (depth + v * part + part**2 * (2.0 * a + self.gravity) / 6.0)

        return _zero(gap, 0.0, step)

    def _flight(self, left: float, depth: float, speed_out: float) -> tuple[float, float, float] | None:
        """Fly until the indenter meets the surface; return time, depth and speed, or None if it never does."""
        g = self.gravity
        if g == 0.0:
            return None

        def overlap(time: float) -> float:
            return self._overlap(time, depth, speed_out)

        # The surface rises, and slower than the indenter at first: they meet once, before the parabola ends.
        end = 2.0 * speed_out / g
        start = 1e-9 * end
        if overlap(start) >= 0.0:
            return None
        duration = _zero(overlap, start, end)
        before = 0.0
        for part in (*dense_parts(_IN_FLIGHT if self.recorded else 0).tolist(), 1.0):
            time = part * duration
            self._predict(time - before)
            self._complete(np.zeros_like(self._force))
            place, speed, before = depth - speed_out * time + 0.5 * g * time**2, g * time - speed_out, time
            if part < 1.0:
                self._record(left + time, place, speed, 0.0, 0.0)
        return left + duration, place, speed

    def _overlap(self, time: float, depth: float, speed_out: float) -> float:
        """Return the indentation into the surface so long after a separation."""
        springs = self.springs
        surface = springs.g + (springs.compliances * np.exp(-time / springs.tau)) @ self._memory
        return depth - speed_out * time + 0.5 * self.gravity * time * time - float(surface.min())

    def _largest_gap(self, depth: float, speed_out: float) -> float:
        """Return the largest gap after a separation, up to which it only grows; without gravity it has no end."""
        if self.gravity == 0.0:
            return math.inf
        largest = 0.0
        for part in _PARTS_OF_FLIGHT:
            gap = -self._overlap(part * 2.0 * speed_out / self.gravity, depth, speed_out)
            if gap < largest:
                break
            largest = gap
        return largest

    def _record(self, time: float, depth: float, speed: float, force: float, radius: float) -> None:
        if self.recorded:
            springs = self.springs
            stored = 0.5 * float(
                springs.weights
                @ (springs.instantaneous * np.square(self._force) + springs.compliances @ np.square(self._memory))
            )
            error = quadrature_error(self._force, springs.s)
            self.rows.append((time, depth, speed, force, radius, stored, self._lost, error))


def _root_of_speed(v: float, start: float, end: float) -> float:
    """Return x in [0, 1] with v + start x + (end − start) x²/2 = 0, where v is above zero and the sum at 1 below."""
    bend = 0.5 * (end - start)
    root = math.sqrt(max(start**2 - 4.0 * bend * v, 0.0))
    return min(max(2.0 * v / (root - start), 0.0), 1.0) if root > start else 1.0


def _top(before: tuple[tuple[float, float], tuple[float, float]], last: tuple[float, float]) -> float:
    """Return the last value, or the top of the parabola through three points where it lies among them."""
    ((x0, y0), (x1, y1)), (x2, y2) = before, last
    if not x0 < x1:
        return y2
    first, second = (y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1)
    if not first > 0.0 > second:
        return y2
    bend = (second - first) / (x2 - x0)
    slope = first + bend * (x1 - x0)  # at x1
    return y1 - 0.25 * slope * (slope / bend)


def _zero(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function changes its sign from below zero to above it (regula falsi, Illinois)."""
    at_low, at_high = function(low), function(high)
    if at_low >= 0.0:
        return low
    x, side = low, 0
    for _ in range(_SECANTS):
        before, x = x, high - at_high * (high - low) / (at_high - at_low)
        value = function(x)
        if value >= 0.0:
            high, at_high = x, value
            at_low *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            low, at_low = x, value
            at_high *= 0.5 if side < 0 else 1.0
            side = -1
        if value == 0.0 or abs(x - before) <= 1e-13 * high:
            break
    return x
