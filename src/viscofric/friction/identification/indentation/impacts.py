"""Impacts at several speeds: restitution, contact time, largest force and depth, by springs with memory."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import ConvergenceError
from viscofric.friction.identification.indentation.contact import (
    EXACT,
    Answer,
    Contact,
    Shared,
    Trial,
    columns,
    logarithm,
    wider,
)
from viscofric.friction.identification.indentation.tables import ReboundRecord
from viscofric.motion.bounce import Bounce
from viscofric.motion.springs import elastic_radius, elastic_work, impact_radius, profile
from viscofric.motion.tangents import Falling, Followed, follow

#: Springs, and their margin beyond the radius on an elastic half-space of the compliance after the impact.
_SPRINGS, _MARGIN = 64, 1.1
#: First step over the time to the depth on an elastic half-space of E∞; parts of each step of the first run.
_FIRST, _DIVISION = 0.015, 4
#: Contact time of an elastic impact over depth by speed: 2.94 of a ball; contact times are resolved to this part.
_ELASTIC_TIME, _SETTLED, _PASSES = 2.94, 0.05, 20
#: Angular frequency of a half-sine as long as the contact, times its duration.
_HALF_SINE = math.pi
#: Plane-strain modulus of a rubber, Pa, for a first guess of contact times where only the restitution was measured.
_NOMINAL = 5e6


@dataclass(frozen=True, eq=False, kw_only=True)
class Impacts(Contact):
    """The impacts of one record: each measured quantity at every speed, one after the other."""

    by_springs: ClassVar[bool] = True

    record: ReboundRecord
    indenter: Indenter
    shared: Shared = EXACT

    @classmethod
    def of(cls, record: ReboundRecord, indenter: Indenter, shared: Shared = EXACT) -> Impacts:
        """Return the impacts of a record; the lags are contact times over π, measured or of similar elastic ones."""
        times = record.contact_time
        if times is None:
            depths = [_depth(record, indenter, place) for place in range(len(record))]
            times = _ELASTIC_TIME * np.array(depths) / record.speed
        values = {name: (getattr(record, name), record.error[name]) for name in record.quantities}
        points = columns(record.speed, values, times / _HALF_SINE)
        return cls(**points, record=record, indenter=indenter, shared=shared)

    def ends(self, trial: Trial) -> tuple[float, float, float]:
        """Return angular frequencies of half-sines as long as the contacts with a material, rad/s."""
        record = self.record
        reached = [_reach(trial, self.indenter, record.mass, float(v), record.gravity) for v in record.speed]
        times = [time for _, _, time in reached]
        return _HALF_SINE / max(times), _HALF_SINE / min(times), _HALF_SINE / min(times)

    @property
    def log_elastic(self) -> float | None:
        """Ln of the plane-strain compliance of a similar elastic impact, of the same energy and depth."""
        if self.record.quantities == ("restitution",):
            return None
        found = []
        for place, speed in enumerate(self.record.speed):
            depth = _depth(self.record, self.indenter, place)
            radius = elastic_radius(self.indenter, depth, None, 1.0)
            found.append(elastic_work(self.indenter, radius, depth) / (0.5 * self.record.mass * speed**2))
        return float(np.median(np.log(found)))

    def answer(self, trial: Trial) -> Answer:
        """Return the measured quantities for a material, solved by springs."""
        solved = [self._impact(trial, float(speed)) for speed in self.record.speed]
        value, change, moved = (np.concatenate(list(zip(*column, strict=True))) for column in zip(*solved, strict=True))
        log_value, change = trial.logarithm(value, change, self.response)
        columns = np.zeros((len(self), 3))
        if self.shared.radius > 0.0:
            columns[:, 0] = logarithm(moved, self.response)[0] - log_value
        for name, rows in self.parts:
            if name == "peak_force":
                columns[rows, 1] = -self.shared.gain
        return Answer(log_value, change[:, :-1], change[:, -1], columns)

    def _impact(self, trial: Trial, speed: float) -> tuple[list[float], list[Array], list[float]]:
        """Return the quantities of one impact, their derivatives, and the quantities with another radius."""
        mass, gravity = self.record.mass, self.record.gravity
        edge, first, _ = _reach(trial, self.indenter, mass, speed, gravity)
        springs = trial.springs(self.indenter, edge, _SPRINGS, 1.0)
        rough = Bounce(springs, mass, gravity, first).run(speed, 1)
        if not rough.contacts[0].separates:
            raise ConvergenceError("the indenter of a rebound does not leave the surface again.", code="no-rebound")
        steps = np.array([*rough.taken[0], rough.taken[0][-1]])
        time = np.append(0.0, np.cumsum(np.repeat(steps / _DIVISION, _DIVISION)))
        falling = Falling(mass, speed, gravity)
        features = _features(follow(springs, time, falling), time, falling)
        moved = features
        if self.shared.radius > 0.0:
            others = trial.springs(wider(self.indenter, self.shared.radius), edge, _SPRINGS, 1.0)
            moved = _features(follow(others, time, falling, derivatives=False), time, falling)
        names = self.record.quantities
        return [features[n][0] for n in names], [features[n][1] for n in names], [moved[n][0] for n in names]


def _depth(record: ReboundRecord, indenter: Indenter, place: int) -> float:
    """Return the largest depth of an impact, m, measured, or as follows from contact time or force."""
    speed = float(record.speed[place])
    if record.indentation is not None:
        return float(record.indentation[place])
    if record.contact_time is not None:
        return float(record.contact_time[place]) * speed / _ELASTIC_TIME
    if record.peak_force is not None:  # E = ∫F dδ = (2/5) F δ of a ball
        return 1.25 * record.mass * speed**2 / float(record.peak_force[place])
    radius = impact_radius(indenter, 0.5 * record.mass * speed**2, 0.0, _NOMINAL)
    return float(profile(indenter, np.array(radius))) or 0.1 * radius


def _reach(trial: Trial, indenter: Indenter, mass: float, speed: float, gravity: float) -> tuple[float, float, float]:
    """Return the largest contact radius with a margin, m, a first step, s, and about the contact time, s."""
    energy, weight, time = 0.5 * mass * speed**2, mass * gravity, 0.0
    radius = depth = 0.0
    first = 0.0
    for _ in range(_PASSES):
        compliance = trial.creep(time)
        radius = impact_radius(indenter, energy, weight, 1.0 / compliance)
        depth = float(profile(indenter, np.array(radius))) or speed * math.sqrt(0.5 * mass * compliance / radius)
        first = first or _FIRST * depth / speed
        before, time = time, _ELASTIC_TIME * depth / speed
        if time - before < _SETTLED * time:
            break
    return radius if indenter.has_walls else _MARGIN * radius, first, time


def _features(found: Followed, time: Array, falling: Falling) -> dict[str, tuple[float, Array]]:
    """Return restitution, contact time, largest force and depth of one contact, with their derivatives."""
    free = np.flatnonzero((found.load[1:] <= 0.0) & (found.load[:-1] > 0.0))
    if not len(free):
        raise ConvergenceError("the indenter of a rebound does not leave the surface again.", code="no-rebound")
    last = int(free[-1]) + 1
    step = time[last] - time[last - 1]
    before, after = found.overlap[last - 1], found.overlap[last]
    share = before / (before - after)
    moved = (before * found.overlap_change[last] - after * found.overlap_change[last - 1]) / (before - after) ** 2
    flown = (1.0 - share) * step
    out = -(found.velocity[last] - falling.gravity * flown) / falling.speed
    gone = -(found.velocity_change[last] + falling.gravity * step * moved) / falling.speed
    return {
        "restitution": (float(out), gone),
        "contact_time": (float(time[last - 1] + share * step), step * moved),
        "peak_force": _top(time, found.load, found.load_change),
        "indentation": _top(time, found.depth, found.depth_change),
    }


def _top(time: Array, values: Array, changes: Array) -> tuple[float, Array]:
    """Return the top of the parabola through the largest value and its neighbours, with its derivative."""
    place = min(max(int(np.argmax(values)), 1), len(values) - 2)
    t, y = time[place - 1 : place + 2] - time[place], values[place - 1 : place + 2]
    bend, slope, _ = np.polyfit(t, y, 2)
    top = float(np.clip(-0.5 * slope / bend, t[0], t[2])) if bend < 0.0 else 0.0
    weights = np.array([(top - t[1]) * (top - t[2]), 0.0, (top - t[0]) * (top - t[1])])
    weights /= np.array([(t[0] - t[1]) * (t[0] - t[2]), 1.0, (t[2] - t[0]) * (t[2] - t[1])])
    weights[1] = 1.0 - weights[0] - weights[2]
    return float(weights @ y), weights @ changes[place - 1 : place + 2]
