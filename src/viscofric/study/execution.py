"""Running a study: from its files to the material, every contact solved, measurement laid beside."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.indenters.indenter import Ball
from viscofric.errors import InputError, StudyError
from viscofric.friction.agreement import compare
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.measurement.tribometry import separate
from viscofric.friction.shifting.shift import shift_friction
from viscofric.readers import read_mtm
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.study import labels
from viscofric.study.cases import CaseSolver, Progress, kept
from viscofric.study.results import StudyResults, input_hashes, provenance, save_results
from viscofric.study.rubber import Rubber, make_rubber
from viscofric.study.rubber_labels import rubber_data
from viscofric.study.run_file import Study, parse_study, read_study_text
from viscofric.study.store import CaseRecord, CaseStore
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray
    from numpy.typing import NDArray

    from viscofric.rheology.shifts.laws import ShiftLaw

    Array: TypeAlias = NDArray[np.float64]

CASES_FOLDER = "cases"


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

    hashes = input_hashes(study.inputs)
    measured = None
    if study.measurement is not None:
        progress("measurement", 0, 1)
        measured = separate(read_mtm(*study.measurement.mtm))
        progress("measurement", 1, 1)
    progress("material", 0, 1)
    rubber = make_rubber(study.material)
    progress("material", 1, 1)
    shift = _shift(rubber)
    # Temperatures without a shift factor are told now, not case by case.
    shift(np.array(study.conditions.temperature))

    solver = CaseSolver(
        rubber.material,
        shift,
        Ball(study.indenter.radius),
        study.solver.accuracy,
        CaseStore(folder / CASES_FOLDER),
        progress,
    )
    tree = _tree(study, rubber, shift, measured, solver)
    tree.attrs = {
        "title": study.title,
        "data_origin": "synthetic" if rubber.synthetic else study.data_origin,
        "study_file": path.name,
        "study_text": text,
        "notes": _listed([*rubber.notes, *(_measurement_notes(measured, shift) if measured else ())]),
        "warnings": _listed([*_doubts(study, rubber, shift), *solver.warnings]),
        "failures": _listed(solver.failures),
        **rubber.attributes,
        "indenter": f"ball of radius {1e3 * study.indenter.radius:.6g} mm",
        "indenter_radius": study.indenter.radius,
        **({} if solver.frequency_range is None else {"frequency_range": solver.frequency_range}),
        "load": study.conditions.load,
        "accuracy": study.solver.accuracy,
        "input_hashes": hashes,
        **provenance(),
    }
    save_results(tree, folder)
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


def _shift(rubber: Rubber) -> ShiftLaw:
    """Return α(T) of a rubber that contacts can be solved with."""
    material = rubber.material
    if not isinstance(material.spectrum, RetardationSpectrum):
        raise StudyError(
            f"material: {material.name or 'the rubber'} is a table of moduli without a spectrum; the contact of a ball "
            "needs retardation modes, which fitting a spectrum to the table gives (viscofric material fit)."
        )
    if material.shift is None:
        raise StudyError(
            f"material: {material.name or 'the rubber'} has no shift factors, so that its temperature cannot be "
            "chosen; give a rubber that has, or sweeps at several temperatures."
        )
    return material.shift


def _doubts(study: Study, rubber: Rubber, shift: ShiftLaw) -> list[str]:
    """Tell what of the prediction rests on more than was measured, or does not lie on one curve."""
    asked = np.array(study.conditions.temperature)
    beyond = asked[np.asarray(shift.extrapolates(asked))]
    spectrum = rubber.material.spectrum
    fit = spectrum.fit if isinstance(spectrum, RetardationSpectrum) else None
    # What is wrong with a ready rubber is told by nothing else.
    said = list(fit.notes) if rubber.fit is None and fit is not None else []
    if fit is None:
        said.append(
            "At which frequencies the rubber was measured is not known, so that nothing tells where it is extrapolated."
        )
    if beyond.size:
        at = ", ".join(f"{celsius(float(kelvin)):z.4g}" for kelvin in np.unique(beyond))
        said.append(f"At {at} °C the shift factor is extrapolated beyond the temperatures of the sweeps, by its law.")
    if rubber.material.vertical_shift is not None:
        said.append(
            "The modulus has a vertical shift b(T), so that curves of other temperatures fall on the friction master "
            "curve only at the load F/b; at one load they lie beside it."
        )
    return said


def _tree(
    study: Study, rubber: Rubber, shift: ShiftLaw, measured: FrictionCurves | None, solver: CaseSolver
) -> xarray.DataTree:
    import xarray

    conditions = study.conditions
    temperature, speed = (
        grid.ravel() for grid in np.meshgrid(conditions.temperature, conditions.speeds(), indexing="ij")
    )
    records = kept(solver.solve("friction", temperature, speed, np.full(len(speed), conditions.load)))
    if not records:
        raise StudyError(f"no case could be solved; the first one failed: {solver.failures[0]}")
    reduced = speed * shift(temperature)
    groups: dict[str, xarray.Dataset] = {
        **rubber_data(rubber),
        "/prediction": _prediction(records, solver),
    }
    if measured is not None:
        at_points = solver.solve("measured points", measured.temperature, measured.speed, measured.load)
        reduced_measured = measured.speed * shift(measured.temperature)
        reduced = np.concatenate([reduced, reduced_measured])
        groups["/measurement"] = labels.measurement_data(
            measured,
            reduced_measured,
            at_points,
            None
            if solver.frequency_range is None
            else [record is not None and solver.within_measured_frequencies(record) for record in at_points],
        )
        groups |= _agreement(measured, at_points)
    master_speeds = np.geomspace(reduced.min(), reduced.max(), study.solver.master_curve_points)
    reference = np.full(len(master_speeds), shift.reference)
    loads = np.full(len(master_speeds), conditions.load)
    groups["/prediction_master"] = _prediction(
        kept(solver.solve("master curve", reference, master_speeds, loads)), solver
    )
    return xarray.DataTree.from_dict(groups)


def _prediction(records: list[CaseRecord], solver: CaseSolver) -> xarray.Dataset:
    if solver.frequency_range is None:
        return labels.prediction_data(records, None)
    return labels.prediction_data(records, [solver.within_measured_frequencies(record) for record in records])


def _agreement(measured: FrictionCurves, at_points: list[CaseRecord | None]) -> dict[str, xarray.Dataset]:
    """Compare where there is a prediction, and a friction above zero to relate the difference to."""
    comparable = np.array([record is not None for record in at_points]) & (measured.viscoelastic > 0.0)
    if not comparable.any():
        return {}
    records = [record for record, good in zip(at_points, comparable, strict=True) if good and record is not None]
    predicted = FrictionCurves(
        speed=np.array([record.speed for record in records]),
        temperature=np.array([record.temperature for record in records]),
        load=np.array([record.load for record in records]),
        viscoelastic=np.array([record.friction_coefficient for record in records]),
        viscoelastic_error=np.array([record.friction_error for record in records]),
        viscoelastic_scatter=np.zeros(len(records)),
        replicates=np.ones(len(records), dtype=np.int64),
        source="prediction",
    )
    found = compare(measured.select(comparable), predicted)
    return {"/agreement": labels.agreement_data(found, left_out=int(np.count_nonzero(~comparable)))}
