"""Springs with memory over given steps, with derivatives by every mode, the glass and the shift factor.

Load, depth, or the mass of a falling indenter is given; in each case the depth follows at the end of a step without
iteration (`normal`, `bounce`), so that it is differentiated along with the steps: with thresholds b of the springs that
touch and the compliance c of a step, f = (δ − b)/c and F = Σ w f give dF = (Σ w dδ − Σ w db − F dc)/c.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.motion.memory import step_coefficients
from viscofric.motion.springs import Springs


@dataclass(frozen=True)
class Falling:
    """An indenter that touches with a speed (m/s) under gravity (m/s²); its mass in kg."""

    mass: float
    speed: float
    gravity: float = 0.0


class Followed(NamedTuple):
    """Values (T,) at the given times, and their derivatives (T, p).

    The derivatives are by the instantaneous compliance, ln of each mode's compliance, and ln of the factor of all
    retardation times.  `overlap` is by how much the indenter is deeper than the surface without it would be.
    """

    depth: Array
    load: Array
    velocity: Array
    overlap: Array
    depth_change: Array
    load_change: Array
    velocity_change: Array
    overlap_change: Array


class _Coefficients(NamedTuple):
    """Coefficients of all steps (T − 1, modes), and their derivatives by ln of the factor of all retardation times."""

    decay: Array
    start: Array
    end: Array
    later_decay: Array
    later_start: Array

    @classmethod
    def of(cls, steps: Array, tau: Array) -> _Coefficients:
        x = steps[:, None] / tau
        decay, start, end = step_coefficients(x)
        slower = x * decay
        return cls(decay, start, end, slower, start - slower)  # that of the end is −start


class _Point(NamedTuple):
    """Depth, velocity and load at one time, and their derivatives (p,)."""

    depth: float
    velocity: float
    load: float
    depth_change: Array
    velocity_change: Array
    load_change: Array


def follow(
    springs: Springs, time: Array, given: Array | Falling, control: str = "fall", *, derivatives: bool = True
) -> Followed:
    """Return the motion at times (T,), ascending, one given twice being a jump."""
    # `control` says what was given at these times: "load", "indentation", or nothing but a `Falling` indenter. Nothing
    # has happened before the first time, at which nothing touches.
    steps, count = np.diff(time), len(springs.tau)
    parts, c = _Coefficients.of(steps, springs.tau), springs.compliances
    force, memory = np.zeros(len(springs.g)), np.zeros((count, len(springs.g)))
    size = count + 2 if derivatives else 0
    moved, remembered, still = (
        np.zeros((size, len(springs.g))),
        np.zeros((count, size * len(springs.g))),
        np.zeros(size),
    )
    begun = float(springs.g[0])
    now = _Point(given[0] if control == "indentation" else begun, 0.0, 0.0, still, still, still)  # type: ignore[index]
    if isinstance(given, Falling):
        now = now._replace(velocity=given.speed)
    rows = [(now, now.depth - begun, still)]
    for number, step in enumerate(steps):
        decay, start, end, later_decay, later_start = (part[number] for part in parts)
        compliance = springs.instantaneous + float(c @ end)
        stiffer = np.concatenate([[1.0], c * end, [-float(c @ start)]])[:size]
        own = (c * decay)[:, None] * memory + np.outer(c * start, force)
        threshold = springs.g + own.sum(axis=0)
        change = ((c * decay) @ remembered).reshape(moved.shape) + float(c @ start) * moved
        if derivatives:
            change[1:-1] += own
            change[-1] += (c * later_decay) @ memory + float(c @ later_start) * force
        now, touching = _moved(springs, now, step, threshold, change, compliance, stiffer, given, control, number + 1)
        pressed = np.where(touching, now.depth - threshold, 0.0) / compliance
        follows = (now.depth_change[:, None] - change - np.outer(stiffer, pressed)) / compliance * touching
        if derivatives:
            remembered *= decay[:, None]
            remembered += np.stack([start, end], axis=1) @ np.stack([moved.ravel(), follows.ravel()])
            later = later_decay[:, None] * memory + np.outer(later_start, force) - np.outer(start, pressed)
            remembered.reshape(count, size, -1)[:, -1] += later
        memory = decay[:, None] * memory + np.outer(start, force) + np.outer(end, pressed)
        force, moved = pressed, follows
        first = int(np.argmin(threshold))
        rows.append((now, now.depth - float(threshold[first]), now.depth_change - change[:, first]))
    points = [one for one, _, _ in rows]
    depth, velocity, load, *changes = (np.array(column) for column in zip(*points, strict=True))
    overlap, widened = (np.array([row[place] for row in rows]) for place in (1, 2))
    return Followed(depth, load, velocity, overlap, changes[0], changes[2], changes[1], widened)


def _moved(
    springs: Springs,
    now: _Point,
    step: float,
    threshold: Array,
    change: Array,
    compliance: float,
    stiffer: Array,
    given: Array | Falling,
    control: str,
    number: int,
) -> tuple[_Point, Mask]:
    """Return depth, velocity and load at the end of a step, and which springs touch then."""
    moved, freed, wanted, share, held = np.zeros(len(stiffer)), np.zeros(len(stiffer)), 0.0, 1.0, 0.0
    if isinstance(given, Falling):
        a, moved_a = given.gravity - now.load / given.mass, -now.load_change / given.mass
        free = now.depth + now.velocity * step + step**2 * (2.0 * a + given.gravity) / 6.0
        freed = now.depth_change + now.velocity_change * step + step**2 * moved_a / 3.0
        share, held = step**2 / (6.0 * given.mass * compliance), 1.0
    else:
        wanted = float(given[number])
        free = wanted * compliance
    depth = wanted if control == "indentation" else springs.balance(threshold, free, share, held).depth
    touching = threshold < depth
    w = springs.weights * touching
    W, pushed = float(w.sum()), change @ w
    load = float(w @ (depth - threshold)) / compliance
    if W == 0.0 and control == "load":
        moved = change[:, int(np.argmin(threshold))]
    elif control != "indentation":
        moved = (freed + share * (pushed + load * stiffer)) / (held + share * W)
    loaded = (W * moved - pushed - load * stiffer) / compliance
    if isinstance(given, Falling):
        velocity = now.velocity + step * (given.gravity - 0.5 * (now.load + load) / given.mass)
        faster = now.velocity_change - 0.5 * step * (now.load_change + loaded) / given.mass
        return _Point(depth, velocity, load, moved, faster, loaded), touching
    return _Point(depth, 0.0, load, moved, freed, loaded), touching
