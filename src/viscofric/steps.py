"""Steps of a traction test: what its file says of each, and what its readings are on average."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterable

    from viscofric.data import TractionRuns


@dataclass(frozen=True)
class TractionStep:
    """One step of a traction test.

    Attributes
    ----------
    number : int
        As in `TractionRuns.step`: that of the file, counted on through all files.
    source : str
        The file that holds the step.
    kind, description, started : str
        As the file has them: ``"BOD_TIMED"``, ``"running-in"``, ``"23/03/2018 10:12:01"``; empty if it does not.
    readings : int
        Number of its readings.
    load, temperature, speed : float
        Means over its readings: N, K and the magnitude of the disc's speed, m/s.
    slip_ratio : float
        Mean of ``|u_disc - u_ball|`` over the mean of the two speeds' magnitudes.
    """

    number: int
    source: str = ""
    kind: str = ""
    description: str = ""
    started: str = ""
    readings: int = 0
    load: float = math.nan
    temperature: float = math.nan
    speed: float = math.nan
    slip_ratio: float = math.nan

    def __str__(self) -> str:
        words = ", ".join(word for word in (self.kind, self.description and repr(self.description)) if word)
        what = f"step {self.number}" + (f" ({words})" if words else "")
        means = f"{self.load:.4g} N, {celsius(self.temperature):z.1f} °C, {1e3 * self.speed:.4g} mm/s"
        return f"{what}: {self.readings} readings at {means}, slip {100 * self.slip_ratio:.3g} %"


def summarised(runs: TractionRuns, known: Iterable[TractionStep]) -> tuple[TractionStep, ...]:
    """Return the steps that have readings, in the order of their numbers, with counts and means of these."""
    if runs.step is None or not len(runs):
        return ()
    numbers, place, counts = np.unique(runs.step, return_inverse=True, return_counts=True)
    told = {step.number: step for step in known}

    def mean(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[float]:
        return [float(value) for value in np.bincount(place, values) / counts]

    disc, ball = np.abs(runs.disc_speed), np.abs(runs.ball_speed)
    slip = np.bincount(place, np.abs(runs.disc_speed - runs.ball_speed))
    rolling = np.bincount(place, 0.5 * (disc + ball))
    ratio = np.divide(slip, rolling, out=np.zeros(slip.shape), where=rolling > 0.0)
    columns = zip(numbers, counts, mean(runs.load), mean(runs.temperature), mean(disc), ratio, strict=True)
    return tuple(
        replace(
            told.get(int(number), TractionStep(int(number))),
            readings=int(count),
            load=load,
            temperature=temperature,
            speed=speed,
            slip_ratio=float(slip_ratio),
        )
        for number, count, load, temperature, speed, slip_ratio in columns
    )
