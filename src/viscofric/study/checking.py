"""A study checked without solving it: its run file, data and rubber, and the effort; or its stored results."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import DataFileError, InputError, StudyError
from viscofric.notes import Note
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.study.cases.case import moved
from viscofric.study.measurement import read_measurement
from viscofric.study.planning.estimates import estimate
from viscofric.study.results_file import DIGEST, RESULTS_FILE, open_tree
from viscofric.study.rubber import make_rubber
from viscofric.study.running.folder import CASES_FOLDER
from viscofric.study.store import CaseStore
from viscofric.study.surface_source import surface_of
from viscofric.study.surface_words import surface_notes, uncertainty_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from viscofric.arrays import Array
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.study.planning.estimates import Expectation
    from viscofric.study.rubber import Rubber
    from viscofric.study.run_file import Study
    from viscofric.study.sweep import Sweep


@dataclass(frozen=True, eq=False)
class CheckedStudy:
    """A study in which nothing is wrong.

    Parameters
    ----------
    study : Study
    sweep : Sweep
        The cases that it asks for.
    rubbers : tuple of Rubber
        One for each material.
    measured : FrictionCurves, optional
        Friction that was measured.
    """

    study: Study
    sweep: Sweep
    rubbers: tuple[Rubber, ...]
    measured: FrictionCurves | None = None

    @cached_property
    def expected(self) -> Expectation:
        """What solving will take, roughly: the cases asked for and the measured points."""
        study, cases = self.study, [*self.sweep.cases]
        first = cases[0]
        if self.measured is not None:
            points = zip(self.measured.temperature, self.measured.speed, self.measured.load, strict=True)
            cases += [moved(first, temperature=T, speed=v, load=F) for T, v, F in points]
        return estimate(
            cases,
            [rubber.material for rubber in self.rubbers],
            accuracy=study.solver.accuracy,
            sensitive=uncertainty_of(study).draws > 0 and any(rubber.fit is not None for rubber in self.rubbers),
            fields=study.outputs.fields == "all",
            each=study.solver.cases == "each",
        )

    @property
    def master_curve_points(self) -> int:
        """Points along the friction master curve; 0 where there is none."""
        varied = {name for axis in self.sweep.axes if len(axis) > 1 for name in axis.columns} - {"sample"}
        alone = self.measured is None and (not varied or not varied <= {"temperature", "speed"})
        if self.study.indenter is None or alone:
            return 0
        return self.study.solver.points_along(measured=self.measured is not None)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was doubtful, changed or left out in reading the data, and what jobs may lack: one sentence each."""
        said = [note for rubber in self.rubbers for note in rubber.notes]
        said += self.measured.notes if self.measured is not None else ()
        said += surface_notes(self.study)
        return tuple(dict.fromkeys([*said, *self._of_jobs()]))

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
        together = self.expected.seconds / (cluster.jobs * cluster.cores)
        if together > cluster.walltime:
            yield (
                f"All jobs together may take {together / 3600.0:.2g} hours, longer than the walltime; what a job did "
                "not finish is taken up by the next one that starts."
            )


def check_study(study: Study, path: Path) -> CheckedStudy:
    """Read the data files of a study and make its rubbers, without solving any case.

    Parameters
    ----------
    study : Study
    path : Path
        Its run file, for messages.

    Raises
    ------
    StudyError
        With all that is wrong with its data: one sentence for each material, and one for the measurement.
    """
    rubbers, measured = [], None
    wrong: list[Note] = []
    field = ""  # of the first that is wrong
    for number, material in enumerate(study.materials):
        try:
            rubber = make_rubber(material)
            _check_temperatures(rubber, np.array(study.conditions.temperature))
        except InputError as error:
            wrong.append(error.note.at(f"material[{number}]" if len(study.materials) > 1 else ""))
            field = field or error.field or "material"
        else:
            rubbers.append(rubber)
    if study.measurement is not None:
        try:
            measured = read_measurement(study.measurement)
        except InputError as error:
            wrong.append(error.note)
            field = field or error.field or "measurement"
    try:
        sweep = study.sweep()
        if study.surface is not None:
            first: Any = sweep.cases[0]
            surface_of(first.surface)
    except InputError as error:
        wrong.append(error.note.at("surface"))
        field = field or "surface"
    if wrong:
        raise StudyError(f"{path}: its data cannot be used:", wrong, field=field)
    return CheckedStudy(study, sweep, tuple(rubbers), measured)


@dataclass(frozen=True)
class CheckedResults:
    """Whether a folder of results holds what was stored in it.

    Attributes
    ----------
    cases : int
        Stored contacts.
    finished : bool
        Whether the results were put together, too.
    damaged : dict of Path to str
        Files that do not hold what was stored, and what is wrong with each.
    unverified : tuple of Path
        Files without a checksum, which older versions of viscofric wrote: nothing is known of them.
    """

    cases: int
    finished: bool
    damaged: dict[Path, str]
    unverified: tuple[Path, ...]


def check_results(folder: Path) -> CheckedResults:
    """Compare every file of a study's results with its checksum.

    Raises
    ------
    DataFileError
        If the folder holds no results.
    """
    store, target = CaseStore(folder / CASES_FOLDER), folder / RESULTS_FILE
    cases, finished = sum(1 for _ in store.stored()), target.exists()
    if not cases and not finished:
        raise DataFileError(folder, f"holds no results of a study (no {RESULTS_FILE}, no {CASES_FOLDER}).")
    damaged, unverified = {}, []
    for key, found in store.damaged().items():
        file = store.folder / f"{key}.json"
        if found.older:
            unverified.append(file)
        else:
            damaged[file] = found.reason
    if finished:
        try:
            if DIGEST not in open_tree(folder)[0].attrs:
                unverified.append(target)
        except DataFileError as error:
            damaged[target] = error.problem
    return CheckedResults(cases, finished, damaged, tuple(unverified))


def _check_temperatures(rubber: Rubber, temperatures: Array) -> None:
    """Raise `InputError` where the rubber has no shift factor at a temperature that is asked for."""
    shift_of(rubber)(temperatures)


def shift_of(rubber: Rubber) -> ShiftLaw:
    """Return α(T) of a rubber that contacts can be solved with.

    Raises
    ------
    StudyError
        If it has no spectrum, or no shift factors.
    """
    material = rubber.material
    if not isinstance(material.spectrum, RetardationSpectrum):
        raise StudyError(
            Note(
                "no-spectrum",
                f"{material.name or 'the rubber'} is a table of moduli without a spectrum; the contact of a ball needs "
                "retardation modes, which fitting a spectrum to the table gives (viscofric material fit).",
                "material",
            )
        )
    if material.shift is None:
        raise StudyError(
            Note(
                "no-shift",
                f"{material.name or 'the rubber'} has no shift factors, so that its temperature cannot be chosen; give "
                "a rubber that has, or sweeps at several temperatures.",
                "material",
            )
        )
    return material.shift
