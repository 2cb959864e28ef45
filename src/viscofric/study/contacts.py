"""All contacts of a study in one plan: those asked for, those at measured points, those along the master curve."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from viscofric.study.planning.plan import plan_cases
from viscofric.study.record import CaseRecord, Failure
from viscofric.study.sweep import Case, Sweep
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.study.measurement import Measurement
    from viscofric.study.planning.plan import Plan
    from viscofric.study.run_file import Study
    from viscofric.study.study_rubber import StudyRubber

# A little beyond the speeds asked for, so that rounding leaves no point outside the master curve.
_ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class Solved:
    """Some cases of a study, and what became of each.

    Attributes
    ----------
    cases : tuple of Case
    outcomes : tuple of CaseRecord or Failure
    """

    cases: tuple[Case, ...]
    outcomes: tuple[CaseRecord | Failure, ...]

    @property
    def records(self) -> list[CaseRecord]:
        """Those that have one, in their order."""
        return [outcome for outcome in self.outcomes if isinstance(outcome, CaseRecord)]

    @property
    def of_records(self) -> list[Case]:
        """The cases of `records`."""
        pairs = zip(self.cases, self.outcomes, strict=True)
        return [case for case, outcome in pairs if isinstance(outcome, CaseRecord)]

    @property
    def failures(self) -> list[Failure]:
        """The others."""
        return [outcome for outcome in self.outcomes if isinstance(outcome, Failure)]


@dataclass(frozen=True, eq=False)
class Contacts:
    """The contacts of a study.

    Parameters
    ----------
    study : Study
    rubbers : sequence of StudyRubber
        Its materials.
    measured : Measurement, optional

    Attributes
    ----------
    sweep : Sweep
        The cases asked for.
    at_points : tuple of Case
        At each measured point.
    along : tuple of Case
        Along the friction master curve; none where there is more than one, as of several loads.
    plan : Plan
        Of all of them, so that what is solved for the ones serves the others.
    """

    study: Study
    rubbers: Sequence[StudyRubber]
    measured: Measurement | None
    sweep: Sweep = field(init=False)
    at_points: tuple[Case, ...] = field(init=False)
    along: tuple[Case, ...] = field(init=False)
    plan: Plan = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "sweep", self.study.sweep())
        object.__setattr__(self, "at_points", self._at_points())
        object.__setattr__(self, "along", self._along())
        object.__setattr__(self, "plan", self._plan())

    def results(self) -> tuple[Solved, Solved, Solved]:
        """Return the cases asked for, those at measured points and those along the master curve, with their outcomes.

        Raises
        ------
        InputError
            If the plan has not been carried out.
        """
        found, parts = list(self.plan.found()), []
        for cases in (self.sweep.cases, self.at_points, self.along):
            parts.append(Solved(cases, tuple(found[: len(cases)])))
            del found[: len(cases)]
        asked, at_points, along = parts
        return asked, at_points, along

    def _plan(self) -> Plan:
        solver, kept = self.study.solver, self.study.outputs.fields
        return plan_cases(
            [*self.sweep.cases, *self.at_points, *self.along],
            [rubber.material for rubber in self.rubbers],
            members={number: rubber.members for number, rubber in enumerate(self.rubbers)},
            accuracy=solver.accuracy,
            sensitive=any(rubber.bands.samples is not None for rubber in self.rubbers),
            fields=range(len(self.sweep.cases)) if kept == "all" else self._few() if kept == "few" else False,
            each=solver.cases == "each",
        )

    def _at_points(self) -> tuple[Case, ...]:
        if self.measured is None:
            return ()
        curves, ball = self.measured.curves, self.sweep.cases[0].indenter
        points = zip(curves.temperature.tolist(), curves.speed.tolist(), curves.load.tolist(), strict=True)
        return tuple(Case(0, ball, *point) for point in points)

    def _reduced(self, case: Case) -> float:
        return case.speed * float(self.rubbers[case.material].shift(case.temperature))

    def _along(self) -> tuple[Case, ...]:
        """Return the master curve's contacts, all of them at the reference temperature."""
        ones = {
            (case.material, case.indenter, case.load, case.layer) for case in self.sweep.cases if case.sample is None
        }
        if len(ones) > 1:
            return ()
        one = self.sweep.cases[0]
        reduced = np.array([self._reduced(case) for case in self.sweep.cases])
        if self.measured is not None:
            reduced = np.concatenate([reduced, self.measured.reduced_speed])
        ends = reduced.min() * (1.0 - _ROUNDING), reduced.max() * (1.0 + _ROUNDING)
        speeds = np.geomspace(*ends, self.study.solver.master_curve_points)
        rubber = self.rubbers[one.material]
        return tuple(
            Case(
                one.material,
                one.indenter,
                rubber.shift.reference,
                speed,
                one.load,
                one.layer,
                one.indenter_modulus,
                one.indenter_poisson_ratio,
            )
            for speed in speeds.tolist()
        )

    def _few(self) -> list[int]:
        """Choose cases whose fields are kept: of the first load, shape … the slowest, middle and fastest, reduced."""
        first = self.sweep.cases[0]
        numbers = [number for number, case in enumerate(self.sweep.cases) if _differs_in_rate(case, first)]
        numbers.sort(key=lambda number: self._reduced(self.sweep.cases[number]))
        return sorted({numbers[0], numbers[len(numbers) // 2], numbers[-1]})


def _differs_in_rate(case: Case, other: Case) -> bool:
    """Whether two cases differ by temperature and speed at most."""
    same = ("material", "indenter", "load", "layer", "sample")
    return all(getattr(case, name) == getattr(other, name) for name in same)


def doubts(parts: Sequence[Solved], rubbers: Sequence[StudyRubber]) -> list[str]:
    """Tell which assumptions do not hold well, each with the number of contacts that it concerns."""
    pairs = [pair for part in parts for pair in zip(part.of_records, part.records, strict=True)]
    sentences = []
    wide = [(case, record) for case, record in pairs if record.warnings]
    if wide:
        worst, record = max(wide, key=lambda pair: pair[1].front + pair[1].rear)
        said = " ".join(record.warnings)
        sentences.append(f"In {len(wide)} of all {len(pairs)} contacts, most of all at {place(worst)}: {said}")
    beyond = [case for case, record in pairs if not rubbers[case.material].is_within(record)]
    if beyond:
        sentences.append(
            f"In {len(beyond)} of all {len(pairs)} contacts, such as {place(beyond[0])}, the contact's frequency v/a "
            "lies beyond the reduced frequencies at which the rubber is known: their friction rests on the "
            "extrapolated spectrum."
        )
    return sentences


def place(case: Case) -> str:
    """Say where a case lies, for people."""
    return f"{celsius(case.temperature):.4g} °C, {1e3 * case.speed:.4g} mm/s"
