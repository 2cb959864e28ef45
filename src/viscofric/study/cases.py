"""Solving the cases of a study one by one: each is stored at once, failures and warnings are kept account of."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol, TypeAlias

from viscofric.study.record import Failure
from viscofric.study.running.task import attempt
from viscofric.study.solving import Task, solve
from viscofric.units import celsius

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from viscofric.contact.indenters.indenter import Ball
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.study.record import CaseRecord
    from viscofric.study.store import CaseStore

    Array: TypeAlias = NDArray[np.float64]


class Progress(Protocol):
    """What a study tells of its progress."""

    def __call__(self, stage: str, done: int, total: int) -> None:
        """Hear of a stage that begins (done = 0) and of each of its steps."""


class CaseSolver:
    """Solves contacts of one material and one ball, from the store where it has them.

    A `sensitive` one also finds how friction answers to the rubber's compliance, for the bands.

    Attributes
    ----------
    failures : list of str
        Cases that could not be solved, one sentence each.
    frequency_range : tuple of float or None
        Reduced angular frequencies between which the material's spectrum was measured, rad/s; None where that is not
        known.
    """

    def __init__(
        self,
        material: Material,
        shift: ShiftLaw,
        ball: Ball,
        accuracy: float,
        store: CaseStore,
        progress: Progress,
        sensitive: bool = False,
    ) -> None:
        self.material, self.shift, self.ball, self.accuracy = material, shift, ball, accuracy
        self.store, self.progress, self.sensitive = store, progress, sensitive
        fit = getattr(material.spectrum, "fit", None)
        self.frequency_range: tuple[float, float] | None = None if fit is None else fit.frequency_range
        self.failures: list[str] = []
        self._solved: list[CaseRecord] = []
        store.prepare()

    def solve(self, stage: str, temperatures: Array, speeds: Array, loads: Array) -> list[CaseRecord | None]:
        """Solve cases given entry by entry; None where one failed."""
        records: list[CaseRecord | None] = []
        self.progress(stage, 0, len(speeds))
        for temperature, speed, load in zip(temperatures.tolist(), speeds.tolist(), loads.tolist(), strict=True):
            task = self._task(temperature, speed, load)
            outcome = self.store.get(task.key)
            if outcome is None:
                outcome = attempt(solve, task)
                self.store.put(task.key, outcome)
            if isinstance(outcome, Failure):
                self.failures.append(str(outcome))
            records.append(None if isinstance(outcome, Failure) else outcome)
            self.progress(stage, len(records), len(speeds))
        self._solved += kept(records)
        return records

    def _task(self, temperature: float, speed: float, load: float) -> Task:
        return Task(
            self.material.modes_at(temperature),
            self.material.poisson_ratio,
            self.ball,
            speed=speed,
            load=load,
            temperature=temperature,
            accuracy=self.accuracy,
            sensitive=self.sensitive,
            label=_where(temperature, speed),
        )

    def within_measured_frequencies(self, record: CaseRecord) -> bool:
        """Whether the contact's frequency v/a, reduced by α(T), lies within the master curve's, as far as is known."""
        low, high = self.frequency_range or (0.0, math.inf)
        return low <= self.shift(record.temperature) * record.frequency <= high

    @property
    def warnings(self) -> tuple[str, ...]:
        """Assumptions that do not hold well, each with the number of cases that it concerns."""
        count = len(self._solved)
        sentences = []
        wide = [record for record in self._solved if record.warnings]
        if wide:
            worst = max(wide, key=lambda record: record.half_width)
            place = _where(worst.temperature, worst.speed)
            sentences.append(
                f"In {len(wide)} of all {count} contacts, most of all at {place}: {' '.join(worst.warnings)}"
            )
        beyond = [record for record in self._solved if not self.within_measured_frequencies(record)]
        if beyond:
            example = _where(beyond[0].temperature, beyond[0].speed)
            sentences.append(
                f"In {len(beyond)} of all {count} contacts, such as {example}, the contact's frequency v/a lies beyond "
                "the reduced frequencies at which the rubber is known: their friction rests on the extrapolated "
                "spectrum."
            )
        return tuple(sentences)


def kept(records: list[CaseRecord | None]) -> list[CaseRecord]:
    """Return the cases that were solved."""
    return [record for record in records if record is not None]


def _where(temperature: float, speed: float) -> str:
    return f"{celsius(temperature):.4g} °C, {1e3 * speed:.4g} mm/s"
