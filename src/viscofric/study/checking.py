"""A study checked without solving it: run file, data, materials and effort."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from viscofric.errors import InputError, StudyError
from viscofric.friction.cases.case import moved
from viscofric.friction.cases.surfaces import notes_on, surface_of
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, Remedy
from viscofric.study.cases.estimates import (
    HEATED_CURVE,
    HEATED_RUNS,
    HEATED_SURFACE,
    HEATED_TIMES,
    SECONDS_OF_IMPACT,
    Expectation,
    contacts_beyond_indenter,
    estimate,
    seconds_over_time,
)
from viscofric.study.cases.sweep import Sweep
from viscofric.study.histories import case_histories, checked_table, impacts_of, is_heated, material_notes
from viscofric.study.make_rubber import make_rubber
from viscofric.study.measurement import read_measurement
from viscofric.study.rubber import Rubber, rubber_at
from viscofric.study.run_file.study import Study


@dataclass(frozen=True, eq=False)
class CheckedStudy:
    """A study without errors: its cases, one `Rubber` for each material, and the measured friction, if any."""

    study: Study
    sweep: Sweep
    rubbers: tuple[Rubber, ...]
    measured: FrictionCurves | None = None

    @cached_property
    def expected(self) -> Expectation:
        """Estimated effort for the cases and the measured points."""
        study, cases = self.study, [*self.sweep.cases]
        first = cases[0]
        if self.measured is not None:
            points = zip(self.measured.temperature, self.measured.speed, self.measured.load, strict=True)
            cases += [moved(first, temperature=T, speed=v, load=F) for T, v, F in points]
        return estimate(
            cases,
            [rubber.material for rubber in self.rubbers],
            accuracy=study.solver.accuracy,
            sensitive=study.applied_uncertainty.draws > 0
            and any(rubber.superposed is not None for rubber in self.rubbers),
            fields=study.outputs.fields == "all",
            each=study.solver.cases == "each",
        )

    @cached_property
    def singles(self) -> dict[str, tuple[int, float]]:
        """Number and estimated processor time, s, of the contacts over time and of the impacts, if there are any."""
        history, impact, cases = self.study.history, self.study.impact, self.sweep.cases
        found = {}
        materials = [rubber.material for rubber in self.rubbers]
        if self.study.heating is not None:
            alone = estimate(cases, materials, accuracy=self.study.solver.accuracy, each=True)
            times = len(self.study.heating.coulomb) * len(self.study.heating.slip or (0.0,))
            longer = HEATED_SURFACE if self.sweep.geometry == "rough" else HEATED_CURVE
            found["heating"] = (times * len(cases), times * longer * alone.seconds)
        if history is not None:
            each, runs, points = len(history.dwell), 1.0, history.points
            if self.study.heating is not None and is_heated(self.study, materials):
                each *= len(self.study.heating.coulomb)
                runs, points = HEATED_RUNS, points + HEATED_TIMES
            moves = case_histories(self.study, history)(cases[0], history.dwell[0]).moves
            about = {"moves": moves, "cycle": history.cycle}
            seconds = sum(seconds_over_time(one, points, **about) for one in cases)
            found["histories"] = (each * len(cases), each * runs * seconds)
        if impact is not None:
            count = impacts_of(self.sweep).size * len(impact.speed)
            found["impacts"] = (count, count * SECONDS_OF_IMPACT)
        return found

    @property
    def seconds(self) -> float:
        """Estimated processor time of all contacts, s."""
        return self.expected.seconds + sum(seconds for _, seconds in self.singles.values())

    @property
    def master_curve_points(self) -> int:
        """Points along the friction master curve; 0 if there is none."""
        varied = {name for axis in self.sweep.axes if len(axis) > 1 for name in axis.columns} - {"sample"}
        alone = self.measured is None and (not varied or not varied <= {"temperature", "speed"})
        if self.study.indenter is None or alone:
            return 0
        return self.study.solver.points_along(measured=self.measured is not None)

    @property
    def notes(self) -> tuple[str, ...]:
        """Warnings, changes and omissions in reading the data, and limits of jobs: one sentence each."""
        said = [note for rubber in self.rubbers for note in rubber.notes]
        said += self.measured.notes if self.measured is not None else ()
        said += self.study.notes
        if self.study.surface is not None:
            first: Any = self.sweep.cases[0]
            said += notes_on(first.surface)
        said += material_notes(self.study, [rubber.material for rubber in self.rubbers])
        return tuple(dict.fromkeys([*said, *self._too_soft(), *self._of_jobs()]))

    def _too_soft(self) -> Iterator[Note]:
        """Yield a warning if contacts are expected to be wider than the indenter, so that they are not solved."""
        cases = self.sweep.cases
        found = contacts_beyond_indenter(cases, [rubber.material for rubber in self.rubbers])
        if not found:
            return
        case, width = max(found, key=lambda one: one[1] / one[0].indenter.reach)
        indenter = case.indenter
        yield Note(
            "beyond-indenter",
            f"{len(found)} of {len(cases)} cases are expected to fail: the estimated contact is wider than the "
            f"{indenter.noun}, {1e3 * width:.3g} mm of {2e3 * indenter.reach:.3g} mm under {case.load:.4g} "
            f"{indenter.geometry.load_unit} ({case.label}). The material is too soft for this load; ",
            remedy=Remedy("reduce the load or take a larger indenter.", field="conditions.load"),
            values={"cases": len(found), "of": len(cases), "width": width, "reach": indenter.reach},
        )

    def _of_jobs(self) -> Iterator[str]:
        cluster = self.study.cluster
        if cluster is None:
            return
        needed = cluster.cores * self.expected.memory_per_process
        if needed > cluster.memory:
            yield (
                f"A job has {cluster.memory / 1e9:.3g} GB, but its {cluster.cores} processes may take "
                f"{needed / 1e9:.2g} GB together; give it more memory or fewer cores."
            )
        together = self.seconds / (cluster.jobs * cluster.cores)
        if together > cluster.walltime:
            yield (
                f"All jobs together may take {together / 3600.0:.2g} hours, longer than the walltime; the next "
                "job that starts continues with unfinished cases."
            )


def check_study(study: Study, path: Path) -> CheckedStudy:
    """Read the data files of a study and make its materials, without solving; raise `StudyError` with all errors."""
    rubbers, measured = [], None
    wrong: list[tuple[Note, str]] = []  # with the field that each is about
    for number, material in enumerate(study.materials):
        with _noted(wrong, "material", f"material[{number}]" if len(study.materials) > 1 else ""):
            rubbers.append(rubber_at(make_rubber(material), study.conditions.temperature))
    if study.measurement is not None:
        with _noted(wrong, "measurement"):
            measured = read_measurement(study.measurement)
    with _noted(wrong, "surface", "surface"):
        sweep = study.sweep()
        if study.surface is not None:
            first: Any = sweep.cases[0]
            surface_of(first.surface)
    if study.history is not None and study.history.file is not None:
        with _noted(wrong, "history.file"):
            checked_table(study.history, study)
    if wrong:
        raise StudyError(f"{path}: its data cannot be used:", [note for note, _ in wrong], field=wrong[0][1])
    return CheckedStudy(study, sweep, tuple(rubbers), measured)


@contextmanager
def _noted(wrong: list[tuple[Note, str]], field: str, place: str = "") -> Iterator[None]:
    """Note an error in a part of a study, and go on with the next part."""
    try:
        yield
    except InputError as error:
        wrong.append((error.note.at(place), error.field or field))
