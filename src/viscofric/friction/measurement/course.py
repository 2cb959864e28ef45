"""How fast each reading of a traction test was taken, as far as that tells which readings belong together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import TractionRuns

    Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Course:
    """Speed and slip by which readings are put together.

    Attributes
    ----------
    speed : (n,) array
        Magnitude, m/s: one for all readings that belong together.
    slip : (n,) array
        Slip over that speed, above zero where the disc is faster than the ball.
    """

    speed: Array
    slip: Array


def of_the_disc(runs: TractionRuns) -> Course:
    """Take each reading at the disc's speed; those of one point of a test at their mean.

    A machine that reverses slip at a constant mean speed of disc and ball moves its disc faster with one
    direction of slip than with the other; readings of one step and time are nevertheless one point.
    """
    speed = np.abs(runs.disc_speed)
    sense = np.sign(runs.disc_speed)
    slip = sense * (runs.disc_speed - runs.ball_speed)
    if runs.step is not None and runs.time is not None:
        timed = np.flatnonzero(np.isfinite(runs.time) & (sense != 0.0))
        _, point = np.unique(np.stack([runs.step[timed], runs.time[timed]], axis=1), axis=0, return_inverse=True)
        point = point.reshape(-1)
        opposed = np.bincount(point, slip[timed] > 0.0) * np.bincount(point, slip[timed] < 0.0) > 0.0
        for values in (speed, slip):
            size = np.abs(values[timed])
            mean = (np.bincount(point, size) / np.bincount(point))[point]
            values[timed] = np.where(opposed[point], np.copysign(mean, values[timed]), values[timed])
    return Course(speed, slip / np.where(speed > 0.0, speed, 1.0))


def of_both(runs: TractionRuns) -> Course:
    """Take each reading at the mean speed of disc and ball, which some tests keep where slip is reversed."""
    speed = 0.5 * np.abs(runs.disc_speed + runs.ball_speed)
    slip = np.sign(runs.disc_speed) * (runs.disc_speed - runs.ball_speed)
    return Course(speed, slip / np.where(speed > 0.0, speed, 1.0))
