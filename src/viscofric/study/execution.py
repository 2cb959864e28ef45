"""Running a study: from its files to the material, every contact solved, measurement laid beside."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.indenters.indenter import Ball
from viscofric.errors import StudyError
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.study import labels
from viscofric.study.assumptions import assumptions
from viscofric.study.bands import FrictionBands
from viscofric.study.cases import CaseSolver, Progress, kept
from viscofric.study.checking import shift_of
from viscofric.study.measurement import Measurement, read_measurement
from viscofric.study.results import StudyResults, input_hashes, provenance, save_results
from viscofric.study.rubber import Rubber, make_rubber
from viscofric.study.rubber_labels import rubber_data
from viscofric.study.run_file import Study, parse_study, read_study_text
from viscofric.study.store import CaseStore
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray
    from numpy.typing import NDArray

    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.study.record import CaseRecord

    Array: TypeAlias = NDArray[np.float64]

CASES_FOLDER = "cases"
_ROUNDING = 1e-6


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
    import xarray

    path = Path(path)
    text = read_study_text(path)
    study = parse_study(text, path)
    _refuse_what_is_not_solved_yet(study, path)
    (radius,), (load,) = study.indenter.axes["radius"], study.conditions.load
    folder = path.with_suffix(".results") if output is None else Path(output)

    hashes = input_hashes(study.inputs)
    curves = None
    if study.measurement is not None:
        progress("measurement", 0, 1)
        curves = read_measurement(study.measurement)
        progress("measurement", 1, 1)
    progress("material", 0, 1)
    rubber = make_rubber(study.material)
    bands = FrictionBands(rubber, study.uncertainty.draws)
    progress("material", 1, 1)
    shift = shift_of(rubber)
    # Temperatures without a shift factor are told now, not case by case.
    shift(np.array(study.conditions.temperature))
    ball = Ball(radius)
    measured = None
    if curves is not None:
        progress("shift", 0, 1)
        measured = Measurement(curves, rubber.material, ball, load)
        progress("shift", 1, 1)

    store = CaseStore(folder / CASES_FOLDER)
    sensitive = bands.samples is not None
    solver = CaseSolver(rubber.material, shift, ball, study.solver.accuracy, store, progress, sensitive=sensitive)
    groups = _solved(study, shift, measured, solver, bands)
    tree = xarray.DataTree.from_dict({**rubber_data(rubber, bands.samples), **groups})
    tree.attrs = {
        "title": study.title,
        "data_origin": "synthetic" if rubber.synthetic else study.data_origin,
        "study_file": path.name,
        "study_text": text,
        "notes": _listed([*rubber.notes, *bands.notes, *(measured.notes if measured else ())]),
        "warnings": _listed([*_doubts(study, rubber, shift), *solver.warnings]),
        "failures": _listed(solver.failures),
        **rubber.attributes,
        "indenter": f"ball of radius {1e3 * radius:.6g} mm",
        "indenter_radius": radius,
        **({} if solver.frequency_range is None else {"frequency_range": solver.frequency_range}),
        "load": load,
        "accuracy": study.solver.accuracy,
        "input_hashes": hashes,
        **provenance(),
    }
    save_results(tree, folder)
    return StudyResults(tree, folder)


def _refuse_what_is_not_solved_yet(study: Study, path: Path) -> None:
    """Raise `StudyError` where a run file asks for more than the cases of one ball at one load."""
    asked = {
        "several materials": len(study.materials) > 1,
        f'shape = "{study.indenter.shape}"': study.indenter.shape != "ball",
        "several radii": len(next(iter(study.indenter.axes.values()))) > 1,
        "an elastic indenter": study.indenter.modulus is not None,
        "[layer]": study.layer is not None,
        "several loads": len(study.conditions.load) > 1,
        "uncertainty.members": study.uncertainty.members > 0,
        "uncertainty.seed": study.uncertainty.seed > 0,
        "outputs.fields": "fields" in study.outputs.model_fields_set,
        "outputs.formats": bool(study.outputs.formats),
        "[cluster]": study.cluster is not None,
        "solver.cases": "cases" in study.solver.model_fields_set,
    }
    wanted = [name for name, is_asked in asked.items() if is_asked]
    if wanted:
        raise StudyError(f"{path}: {' and '.join(wanted)} can be checked, but not be run yet.")


def _listed(sentences: Iterable[str]) -> str:
    return json.dumps(list(sentences), ensure_ascii=False)


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
        behind = "of the friction that it was identified from" if rubber.from_friction else "of the sweeps"
        said.append(f"At {at} °C the shift factor is extrapolated beyond the temperatures {behind}, by its law.")
    if rubber.material.vertical_shift is not None:
        said.append(
            "The modulus has a vertical shift b(T), so that curves of other temperatures fall on the friction master "
            "curve only at the load F/b; measured points are brought to it by the similarity of contacts."
        )
    return said


def _solved(
    study: Study, shift: ShiftLaw, measured: Measurement | None, solver: CaseSolver, bands: FrictionBands
) -> dict[str, xarray.Dataset]:
    """Solve all cases: those asked for, those measured, and those along the friction master curve."""
    conditions, groups = study.conditions, {}
    (load,) = conditions.load
    temperature, speed = (grid.ravel() for grid in np.meshgrid(conditions.temperature, conditions.speed, indexing="ij"))
    records = kept(solver.solve("friction", temperature, speed, np.full(len(speed), load)))
    if not records:
        raise StudyError(f"no case could be solved; the first one failed: {solver.failures[0]}")
    groups["/prediction"] = _prediction(records, solver, bands)
    reduced, at_points = speed * shift(temperature), []
    if measured is not None:
        curves = measured.curves
        at_points = solver.solve("measured points", curves.temperature, curves.speed, curves.load)
        reduced = np.concatenate([reduced, measured.reduced_speed])
    # A little beyond, so that rounding leaves no point outside.
    ends = reduced.min() * (1.0 - _ROUNDING), reduced.max() * (1.0 + _ROUNDING)
    master_speeds = np.geomspace(*ends, study.solver.master_curve_points)
    same = np.full(len(master_speeds), shift.reference), master_speeds, np.full(len(master_speeds), load)
    at_reference = kept(solver.solve("master curve", *same))
    groups["/prediction_master"] = _prediction(at_reference, solver, bands)
    if measured is not None:
        within = [record is not None and solver.within_measured_frequencies(record) for record in at_points]
        known = None if solver.frequency_range is None else within
        groups |= measured.groups(at_points, known, bands.curves(at_reference), bands)
    return groups | assumptions(study, solver, measured, records, at_points)


def _prediction(records: list[CaseRecord], solver: CaseSolver, bands: FrictionBands) -> xarray.Dataset:
    within = None
    if solver.frequency_range is not None:
        within = [solver.within_measured_frequencies(record) for record in records]
    return labels.prediction_data(records, within, bands.curves(records))
