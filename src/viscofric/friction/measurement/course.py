"""Speed and slip by which the readings of a traction test are grouped."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers, Mask
    from viscofric.traction import TractionRuns


@dataclass(frozen=True, eq=False)
class Course:
    """Speed and slip by which readings are grouped."""

    speed: Array  # (n,), magnitude, m/s; the same for all readings of one point
    slip: Array  # (n,), slip over that speed, above zero where the disc is faster than the ball
    notes: tuple[str, ...] = ()
    # scatter of the slip over that of `speed`, where disc and ball jitter equally and independently
    slip_scatter: float = math.sqrt(2.0)


def of_the_disc(runs: TractionRuns) -> Course:
    """Return the disc's speed of each reading; for those of one point of a test, the mean.

    A machine that reverses slip at a constant mean speed of disc and ball moves its disc faster with one
    direction of slip than with the other; readings of one step and time are nevertheless one point.  Where such a
    machine fails to reverse the slip, the slip is below its error and is taken as zero.
    """
    speed = np.abs(runs.disc_speed)
    sense = np.sign(runs.disc_speed)
    slip = sense * (runs.disc_speed - runs.ball_speed)
    notes: tuple[str, ...] = ()
    if runs.step is not None and runs.time is not None:
        timed = np.flatnonzero(np.isfinite(runs.time) & (sense != 0.0))
        _, point = np.unique(np.stack([runs.step[timed], runs.time[timed]], axis=1), axis=0, return_inverse=True)
        point = point.reshape(-1)
        opposed = np.bincount(point, slip[timed] > 0.0) * np.bincount(point, slip[timed] < 0.0) > 0.0
        unclear = timed[_unreversed(runs.step[timed], point, opposed, slip[timed] / speed[timed])]
        if unclear.size:
            largest = 1e3 * float(np.abs(slip[unclear]).max())
            note = Note(
                "slip-not-reversed",
                f"In {unclear.size} of {len(runs)} readings the slip, at most {largest:.2g} mm/s, is not reversed "
                "within the point of the test, unlike at the other points of the step; it is below its error there and "
                "is taken as zero.",
            )
            notes = (note,)
            slip[unclear] = 0.0
        for values in (speed, slip):
            size = np.abs(values[timed])
            mean = (np.bincount(point, size) / np.bincount(point))[point]
            values[timed] = np.where(opposed[point], np.copysign(mean, values[timed]), values[timed])
    return Course(speed, slip / np.where(speed > 0.0, speed, 1.0), notes)


def _unreversed(step: Integers, point: Integers, opposed: Mask, slip: Array) -> Mask:
    """Return the readings of points where small slip is not reversed though most points of the step reverse theirs."""
    several = np.bincount(point) > 1
    _, number = np.unique(step, return_inverse=True)
    step_of = np.zeros(opposed.size, dtype=np.intp)
    step_of[point] = number.reshape(-1)
    reverses = 2 * np.bincount(step_of, opposed & several) > np.bincount(step_of, several)
    size = np.abs(slip)
    largest = np.zeros(opposed.size)
    np.maximum.at(largest, point, size)
    usual = float(np.median(size[opposed[point]])) if np.any(opposed) else 0.0
    return np.asarray((several & ~opposed & reverses[step_of] & (largest < usual))[point])


def of_both(runs: TractionRuns) -> Course:
    """Return the mean speed of disc and ball of each reading, which some tests keep where slip is reversed."""
    speed = 0.5 * np.abs(runs.disc_speed + runs.ball_speed)
    slip = np.sign(runs.disc_speed) * (runs.disc_speed - runs.ball_speed)
    # The slip is a difference of two speeds, `speed` their mean.
    return Course(speed, slip / np.where(speed > 0.0, speed, 1.0), slip_scatter=2.0)
