"""Running a study: from its files to the material, every contact solved, measurement laid beside."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np

from viscofric.contact.indenters import Ball
from viscofric.contact.steady import solve_steady
from viscofric.errors import ConvergenceError, InputError, StudyError
from viscofric.friction.agreement import compare
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.master_curve import shift_friction
from viscofric.friction.tribometry import separate
from viscofric.readers import read_dma, read_mtm
from viscofric.rheology.material import Material
from viscofric.rheology.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition import superpose
from viscofric.study import results as labelled
from viscofric.study.results import StudyResults
from viscofric.study.run_file import Study, parse_study, read_study_text
from viscofric.study.store import CaseRecord, CaseStore, case_key
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray
    from numpy.typing import NDArray

    from viscofric.rheology.shift_laws import WLF, ShiftLaw
    from viscofric.rheology.superposition import Superposition

    Array: TypeAlias = NDArray[np.float64]

CASES_FOLDER = "cases"


class Progress(Protocol):
    """What a study tells of its progress."""

    def __call__(self, stage: str, done: int, total: int) -> None:
        """Hear of a stage that begins (done = 0) and of each of its steps."""


def _silent(stage: str, done: int, total: int) -> None:
    pass


def run_study(path: str | Path, *, output: str | Path | None = None, progress: Progress = _silent) -> StudyResults:
    """Run a study: material from DMA, friction at every speed and temperature, measurement beside it.

    Parameters
    ----------
    path : str or Path
        The run file (TOML).
    output : str or Path, optional
        Folder for the results; ``<run file>.results`` beside the run file if not given.  Cases that are
        already solved there are taken as they are.
    progress : callable, optional
        ``progress(stage, done, total)``.

    Returns
    -------
    StudyResults
        Also stored in the folder, as ``results.nc``.  Cases that could not be solved are listed in
        ``failures``.

    Raises
    ------
    StudyError
        If the run file is wrong, or no case at all could be solved.
    DataFileError, SuperpositionError, InputError
        If a data file cannot be used.
    """
    path = Path(path)
    text = read_study_text(path)
    study = parse_study(text, path)
    folder = path.with_suffix(".results") if output is None else Path(output)

    progress("material", 0, 1)
    rubber = _material(study)
    progress("material", 1, 1)
    measured = None
    if study.measurement is not None:
        progress("measurement", 0, 1)
        measured = separate(read_mtm(*study.measurement.mtm))
        progress("measurement", 1, 1)

    solver = _Solver(study, rubber.material, CaseStore(folder / CASES_FOLDER), progress)
    tree = _tree(study, rubber, measured, solver)
    tree.attrs = {
        "title": study.title,
        "data_origin": study.data_origin,
        "study_file": path.name,
        "study_text": text,
        "notes": _listed([*rubber.fit.notes, *(_measurement_notes(measured, rubber.shift) if measured else ())]),
        "warnings": _listed(solver.warnings),
        "failures": _listed(solver.failures),
        "deformation": rubber.deformation,
        "poisson_ratio": study.material.poisson_ratio,
        "indenter": f"ball of radius {1e3 * study.indenter.radius:.6g} mm",
        "load": study.conditions.load,
        "accuracy": study.solver.accuracy,
        **labelled.provenance(_inputs(study)),
    }
    labelled.save_results(tree, folder)
    return StudyResults(tree, folder)


def _measurement_notes(measured: FrictionCurves, shift: ShiftLaw) -> tuple[str, ...]:
    """Tell what was noted of a measurement, and how its temperatures fall on one friction master curve."""
    try:
        master = shift_friction(measured, shift=shift).overlap_sentence
    except InputError as error:
        master = f"The measured friction was not joined into one master curve: {error}"
    return (*measured.notes, master)


def _listed(sentences: Iterable[str]) -> str:
    return json.dumps(list(sentences), ensure_ascii=False)


def _inputs(study: Study) -> tuple[Path, ...]:
    return (study.material.dma, *(study.measurement.mtm if study.measurement else ()))


@dataclass(frozen=True, eq=False)
class _Rubber:
    """The material of a study with everything it was made from."""

    material: Material
    shift: ShiftLaw
    fit: Superposition
    law: WLF | None
    isotherms: xarray.Dataset
    deformation: str


def _material(study: Study) -> _Rubber:
    wanted = study.material
    sweeps = read_dma(wanted.dma, deformation=wanted.deformation)
    try:
        fit = superpose(sweeps, wanted.reference_temperature, poisson_ratio=wanted.poisson_ratio)
    except InputError as error:
        raise type(error)(f"{wanted.dma}: {error}") from error
    spectrum = fit_retardation_spectrum(fit.master_curve, tau_ratio=wanted.tau_ratio)
    try:
        law = fit.shift_factors.law("wlf")
    except InputError:
        if wanted.shift == "wlf":
            raise
        law = None
    shift: ShiftLaw = law if wanted.shift == "wlf" and law is not None else fit.shift_factors
    material = Material(spectrum, shift=shift, poisson_ratio=wanted.poisson_ratio)
    isotherms = labelled.isotherm_data(sweeps.in_tension(wanted.poisson_ratio))
    return _Rubber(material, shift, fit, law, isotherms, sweeps.deformation)


class _Solver:
    """Solves cases one by one, stores each at once, and keeps account of failures and warnings."""

    def __init__(self, study: Study, material: Material, store: CaseStore, progress: Progress) -> None:
        self.study, self.material, self.store, self.progress = study, material, store, progress
        self.ball = Ball(study.indenter.radius)
        self.failures: list[str] = []
        self._warned: list[CaseRecord] = []
        self._solved = 0

    def solve(self, stage: str, temperatures: Array, speeds: Array, loads: Array) -> list[CaseRecord | None]:
        """Solve cases given entry by entry; None where one failed."""
        records: list[CaseRecord | None] = []
        self.progress(stage, 0, len(speeds))
        for temperature, speed, load in zip(temperatures, speeds, loads, strict=True):
            try:
                records.append(self._case(float(temperature), float(speed), float(load)))
            except (ConvergenceError, InputError) as error:
                records.append(None)
                self.failures.append(f"{celsius(temperature):.6g} °C, {1e3 * speed:.6g} mm/s: {error}")
            self.progress(stage, len(records), len(speeds))
        solved = [record for record in records if record is not None]
        self._warned += [record for record in solved if record.warnings]
        self._solved += len(solved)
        return records

    def _case(self, temperature: float, speed: float, load: float) -> CaseRecord:
        spectrum = self.material.at(temperature)
        accuracy = self.study.solver.accuracy
        key = case_key(
            {
                "E0": spectrum.E0,
                "E_inf": spectrum.E_inf,
                "C": list(map(float, spectrum.C)),
                "tau": list(map(float, spectrum.tau)),
                "poisson_ratio": self.material.poisson_ratio,
                "radius": self.ball.radius,
                "load": load,
                "speed": speed,
                "temperature": temperature,
                "accuracy": accuracy,
            }
        )
        record = self.store.get(key)
        if record is None:
            solution = solve_steady(
                self.material, self.ball, speed=speed, load=load, temperature=temperature, accuracy=accuracy
            )
            record = CaseRecord.of(solution, temperature)
            self.store.put(key, record)
        return record

    @property
    def warnings(self) -> tuple[str, ...]:
        """The worst warning, with the number of cases that carry one."""
        if not self._warned:
            return ()
        worst = max(self._warned, key=lambda record: record.half_width)
        where = f"{celsius(worst.temperature):.6g} °C, {1e3 * worst.speed:.6g} mm/s"
        return (f"In {len(self._warned)} of {self._solved} cases, most of all at {where}: {' '.join(worst.warnings)}",)


def _tree(study: Study, rubber: _Rubber, measured: FrictionCurves | None, solver: _Solver) -> xarray.DataTree:
    import xarray

    conditions = study.conditions
    temperature, speed = (
        grid.ravel() for grid in np.meshgrid(conditions.temperature, conditions.speeds(), indexing="ij")
    )
    shift = rubber.shift
    predicted = _kept(solver.solve("friction", temperature, speed, np.full(len(speed), conditions.load)))
    if not predicted:
        raise StudyError(f"no case could be solved; the first one failed: {solver.failures[0]}")
    reduced = np.array([record.speed * shift(record.temperature) for record in predicted])

    groups: dict[str, xarray.Dataset] = {
        "/isotherms": rubber.isotherms,
        "/shift_factors": labelled.shift_factor_data(rubber.fit, rubber.law, study.material.shift),
        **labelled.spectrum_data(rubber.fit, rubber.material.spectrum),
        "/prediction": labelled.prediction_data(predicted),
    }
    if measured is not None:
        at_points = solver.solve("measured points", measured.temperature, measured.speed, measured.load)
        solved = np.array([record is not None for record in at_points])
        measured = measured.select(solved)
        reduced_measured = measured.speed * shift(measured.temperature)
        reduced = np.concatenate([reduced, reduced_measured])
        records = _kept(at_points)
        groups["/measurement"] = labelled.measurement_data(measured, reduced_measured, records)
        comparable = measured.select(measured.viscoelastic > 0.0)
        if len(comparable):
            groups["/agreement"] = labelled.agreement_data(compare(comparable, _curves(records)))
    master_speeds = np.geomspace(reduced.min(), reduced.max(), study.solver.master_curve_points)
    reference = np.full(len(master_speeds), study.material.reference_temperature)
    loads = np.full(len(master_speeds), conditions.load)
    groups["/prediction_master"] = labelled.prediction_data(
        _kept(solver.solve("master curve", reference, master_speeds, loads))
    )
    return xarray.DataTree.from_dict(groups)


def _kept(records: list[CaseRecord | None]) -> list[CaseRecord]:
    return [record for record in records if record is not None]


def _curves(records: list[CaseRecord]) -> FrictionCurves:
    return FrictionCurves(
        speed=np.array([record.speed for record in records]),
        temperature=np.array([record.temperature for record in records]),
        load=np.array([record.load for record in records]),
        viscoelastic=np.array([record.friction_coefficient for record in records]),
        viscoelastic_error=np.array([record.friction_error for record in records]),
        viscoelastic_scatter=np.zeros(len(records)),
        replicates=np.ones(len(records), dtype=np.int64),
        source="prediction",
    )
