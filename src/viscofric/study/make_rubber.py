"""From [material] to a material model: sweeps read, superposed and fitted, or a predefined material."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np

from viscofric.data import IsothermalSweeps, MasterCurve
from viscofric.errors import DataFileError, InputError, LiquidError, StudyError
from viscofric.files import says_synthetic
from viscofric.notes import Note, note_of
from viscofric.ramps import TemperatureRamps
from viscofric.readers.dma.master_curves import read_master_curve
from viscofric.readers.dma.ramps import read_ramps
from viscofric.readers.dma.read import read_dma
from viscofric.readers.steps.read import read_step_tests
from viscofric.rheology.cards import open_card
from viscofric.rheology.catalogue import catalogue_material, is_synthetic
from viscofric.rheology.material import Material
from viscofric.rheology.ramps.superpose import RampLaw, assumed_of, superpose_ramps
from viscofric.rheology.shifts.law_comparison import LawComparison
from viscofric.rheology.shifts.laws import OneTemperature, ParametricLaw, ShiftLaw
from viscofric.rheology.shifts.parametric_law import law_misfit
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_files import read_shift_factors
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition.joint import JointSuperposition
from viscofric.rheology.superposition.result import PER_DECADE, StepSuperposition, Superposition, flowing
from viscofric.rheology.superposition.superpose import superpose
from viscofric.step_tests import StepMasterCurve, StepTests
from viscofric.study.at_strain import at_strain
from viscofric.study.rubber import Rubber
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.tables import with_options
from viscofric.units import kelvin_hint, plain, shown_celsius


def make_rubber(table: MaterialTable, *, liquids: bool = False, temperatures: Sequence[float] = ()) -> Rubber:
    """Return the material of [material]; a liquid is its master curve with `liquids`, else a `LiquidError`.

    `temperatures` (K) at which it will be used are refused outside the isotherms, before these are superposed, unless a
    law extrapolates.
    """
    made = at_strain(_at_small_strain(table, liquids, temperatures), table)
    return called_synthetic(made) if made.synthetic or any(map(says_synthetic, table.inputs)) else made


def called_synthetic(rubber: Rubber) -> Rubber:
    """Return a material that is called synthetic, and its results too."""
    return replace(rubber, synthetic=True, material=replace(rubber.material, synthetic=True))


def _at_small_strain(table: MaterialTable, liquids: bool, temperatures: Sequence[float]) -> Rubber:
    if table.dma is not None or table.steps:
        return _from_tests(table, liquids, temperatures)
    if table.ramps is not None:
        return _from_ramps(table, liquids)
    return _predefined(table) if table.master_curve is None else _from_master_curve(table, table.master_curve, liquids)


def _predefined(table: MaterialTable) -> Rubber:
    notes: tuple[str, ...] = ()
    if table.file is None:
        material, source = catalogue_material(str(table.catalogue)), "the catalogue"
    else:
        card = open_card(table.file)
        material, notes, source = card.material, tuple(card.notes), f"the file {table.file.name}"
    synthetic = is_synthetic(material)
    if table.reference_temperature is not None:
        material = material.at_reference(table.reference_temperature)
    if table.name:
        material = replace(material, name=table.name)
    return Rubber(material, notes=notes, source=source, synthetic=synthetic)


@contextmanager
def _errors_of(files: tuple[Path, ...]) -> Iterator[None]:
    """Name the files in errors about their data; those about a file name it already."""
    try:
        yield
    except DataFileError:
        raise
    except InputError as error:
        more = f" and {len(files) - 1} more" if len(files) > 1 else ""
        raise error.at(f"{files[0]}{more}") from error


def _material(
    table: MaterialTable,
    spectrum: RetardationSpectrum | ModulusTable,
    shift: ShiftLaw | None,
    vertical: VerticalShift | None = None,
) -> Material:
    return Material(spectrum, shift=shift, poisson_ratio=table.poisson_ratio, name=table.name, vertical_shift=vertical)


def _from_tests(table: MaterialTable, liquids: bool, temperatures: Sequence[float]) -> Rubber:
    """Superpose sweeps, creep or relaxation tests, or both together, and fit one spectrum."""
    sweeps = None if table.dma is None else read_dma(*table.dma, **how_read(table))
    tests = read_steps_of(table) if table.steps else None
    if sweeps is None and tests is not None and len(tests.tests) == 1:
        return _from_one_test(table, tests)
    given: list[Any] = [one for one in (sweeps, tests) if one is not None]
    reference, taken = _reference(table, *given)
    measured = sorted(set().union(*map(_temperatures, given)))
    if table.shift == "measured" and table.shift_factors is None and len(measured) > 1:
        ShiftFactors(measured, np.zeros(len(measured)), reference).log10(list(temperatures))
    with _errors_of((*(table.dma or ()), *table.steps)):
        whole: Any = superpose(given if len(given) > 1 else given[0], reference, **_how(table))
        shift, laws, used = _law_or_table(table.shift, whole.shift_factors)
        liquids = liquids and sweeps is not None
        spectrum, flowing = _spectrum(table, whole, _off(shift, whole.shift_factors), liquids)
    joint = whole if isinstance(whole, JointSuperposition) else None
    parts: Any = (whole,) if joint is None else joint.parts
    step_fit = next((one for one in parts if isinstance(one, StepSuperposition)), None)
    return Rubber(
        _material(table, spectrum, shift, whole.vertical_shift),
        sweeps=sweeps,
        fit=next((one for one in parts if isinstance(one, Superposition)), None),
        step_tests=tests,
        step_fit=step_fit,
        step_curve=None if step_fit is None else step_fit.master_curve,
        joint=joint,
        laws=laws,
        shift_used=used,
        shift_origin="given" if table.shift_factors else "held" if table.fixed_shift_factors else "found",
        notes=(*taken, *whole.notes, *flowing, *_undecided(laws, table.shift)),
    )


def _from_one_test(table: MaterialTable, tests: StepTests) -> Rubber:
    """Take a test at one temperature for the master curve there, with its shift factors if they are given."""
    tensile = tests.in_tension(table.poisson_ratio).thinned(PER_DECADE)
    (test,), (reference, _) = tensile.tests, _reference(table, tensile)
    for words in table.doubts_of_curve("for a test at one temperature"):
        raise StudyError(with_options(words, MaterialTable.model_fields).at("material"))
    with _errors_of(table.steps):
        if abs(reference - test.temperature) > NOMINAL:
            raise InputError(
                f"reference = {shown_celsius(reference)} °C is not the temperature of the only test, "
                f"{shown_celsius(test.temperature)} °C",
                code="reference-outside",
                remedy=kelvin_hint(reference),
            )
        kelvin = np.full(len(test), test.temperature)
        curve = StepMasterCurve(test.time, test.response, kelvin, reference, tests.kind)
        made = _from_curve(table, curve, liquids=False)
    flow = flowing(tensile.tests) if tests.kind == "creep" else ()
    return replace(made, step_tests=tests, step_curve=curve, notes=(*tensile.notes, *flow, *made.notes))


def _columns(table: MaterialTable) -> dict[str, Any]:
    """Return what every reader of a test takes of the table: the deformation, and where its columns are."""
    return {"deformation": table.deformation, "columns": table.columns, "sheet": table.sheet}


def how_read(table: MaterialTable) -> dict[str, Any]:
    """Return what a reader of sweeps takes of the table besides the files."""
    names = ("temperature", "modulus_unit", "leave_out_temperatures")
    return {name: getattr(table, name) for name in names} | _columns(table)


def read_steps_of(table: MaterialTable) -> StepTests:
    """Read the creep or relaxation tests of [material]."""
    return read_step_tests(
        *table.steps,
        kind="creep" if table.creep is not None else "relaxation",
        temperature=table.temperature,
        response_unit=table.modulus_unit,
        **_columns(table),
    )


def read_ramps_of(table: MaterialTable) -> TemperatureRamps:
    """Read the temperature ramps of [material]."""
    return read_ramps(*(table.ramps or ()), modulus_unit=table.modulus_unit, **_columns(table))


def _from_ramps(table: MaterialTable, liquids: bool) -> Rubber:
    """Superpose temperature ramps by a law, fitted or assumed, and fit the spectrum."""
    files, (reference, _) = table.ramps or (), _reference(table)
    ramps = read_ramps_of(table)
    with _errors_of(files[:1]):
        fit = superpose_ramps(
            ramps,
            reference,
            cast("RampLaw", "wlf" if table.shift == "measured" else table.shift),
            assumed=None if table.assumed_shift is None else assumed_of(table.assumed_shift, reference),
            poisson_ratio=table.poisson_ratio,
            vertical="density" if table.vertical_shift == "density" else None,
        )
    verdict = tuple(note for note in fit.notes if note_of(note).code in _DOUBTS_OF_RAMPS)
    spectrum, flowing = _spectrum(table, fit.master_curve, verdict, liquids)
    material = _material(table, spectrum, fit.shift, fit.vertical_shift)
    used = "assumed" if fit.assumption else getattr(fit.shift, "kind", "")
    return Rubber(material, master_curve=fit.master_curve, ramps=fit, shift_used=used, notes=(*fit.notes, *flowing))


#: Notes on ramps that stay with the spectrum.
_DOUBTS_OF_RAMPS = {"ramps-do-not-superpose", "shift-assumed", "assumption-contradicted"}


def _from_master_curve(table: MaterialTable, path: Path, liquids: bool) -> Rubber:
    """Use a given master curve, with its shift factors if they are given."""
    reference, _ = _reference(table)
    curve = read_master_curve(
        path, reference, poisson_ratio=table.poisson_ratio, modulus_unit=table.modulus_unit, **_columns(table)
    )
    return replace(_from_curve(table, curve, liquids), master_curve=curve)


def _from_curve(table: MaterialTable, curve: MasterCurve | StepMasterCurve, liquids: bool) -> Rubber:
    shift: ShiftLaw = OneTemperature(curve.reference)
    off: tuple[Note, ...] = ()
    laws, used = None, ""
    if table.shift_factors is not None:
        factors = _given_factors(table, table.shift_factors, curve.reference)
        shift, laws, used = _law_or_table(table.shift, factors)
        off = _off(shift, factors)
    spectrum, flowing = _spectrum(table, curve, off, liquids)
    notes = (*flowing, *_undecided(laws, table.shift))
    return Rubber(_material(table, spectrum, shift), laws=laws, shift_used=used, notes=notes)


def _undecided(laws: LawComparison[ParametricLaw] | None, choice: str) -> tuple[str, ...]:
    """Return notes about an undecided choice among laws, if the best law is used."""
    if laws is None or choice != "best":
        return ()
    return tuple(note for note in laws.notes if note.code == "laws-undecided")


def _spectrum(
    table: MaterialTable,
    curve: MasterCurve | StepMasterCurve | Superposition | StepSuperposition | JointSuperposition,
    verdict: tuple[str, ...],
    liquids: bool,
) -> tuple[RetardationSpectrum | ModulusTable, tuple[str, ...]]:
    """Fit the spectrum, which keeps warnings about the master curve; a liquid becomes a table, or is refused."""
    try:
        spectrum = fit_retardation_spectrum(curve, tau_ratio=table.tau_ratio, method=table.spectrum, modes=table.modes)
    except LiquidError as error:
        if not liquids:
            raise
        first = curve.parts[0] if isinstance(curve, JointSuperposition) else curve
        moduli = first.master_curve if isinstance(first, (Superposition, StepSuperposition)) else first
        assert not isinstance(moduli, StepMasterCurve)  # sweeps come first
        return ModulusTable.from_master_curve(moduli), (Note("liquid", f"No spectrum: {error}"),)
    return spectrum.noted(*verdict), ()


def _off(law: ShiftLaw | None, factors: ShiftFactors) -> tuple[Note, ...]:
    """Return a note, which stays with the spectrum, on a law that is used though it lies far from the factors."""
    if not isinstance(law, ParametricLaw):
        return ()
    misfit = law_misfit(law, factors.temperatures, factors.log10_values)
    if misfit["misfit_holds"]:
        return ()
    said = f"The shift factors lie {plain(misfit['rms'], 2)} decades (rms) from the law that is used "
    return (Note("law-misfit", f"{said}(good if ≤ {misfit['misfit_limit']:g}).", values={"rms": misfit["rms"]}),)


def _reference(table: MaterialTable, *given: IsothermalSweeps | StepTests) -> tuple[float, tuple[Note, ...]]:
    """Return the reference temperature (K), else the middle one of those within all tests given, with a note."""
    if table.reference_temperature is not None:
        return table.reference_temperature, ()
    each = list(map(_temperatures, given))
    low, high = max(map(min, each), default=0.0), min(map(max, each), default=0.0)
    if inside := sorted(kelvin for kelvin in set().union(*each) if low <= kelvin <= high):
        middle = inside[(len(inside) - 1) // 2]
        said = f"The reference temperature is {shown_celsius(middle)} °C, the middle one of the tests; none was given."
        return middle, (Note("reference-taken", said, values={"temperature": middle}),)
    raise StudyError(Note("missing", "is missing.", "material.reference_temperature"))


def _temperatures(given: IsothermalSweeps | StepTests) -> set[float]:
    return {one.temperature for one in (given.tests if isinstance(given, StepTests) else given.isotherms)}


def _how(table: MaterialTable) -> dict[str, Any]:
    """Return how tests are superposed."""
    return {
        "poisson_ratio": table.poisson_ratio,
        "vertical": None if table.vertical_shift == "none" else table.vertical_shift,
        "by": table.shift_by,
        "weights": table.shift_weights,
        "shift": None if table.shift_factors is None else _given_factors(table, table.shift_factors),
        "fixed": table.fixed_shift_factors or None,
    }


def _given_factors(table: MaterialTable, path: Path, reference: float | None = None) -> ShiftFactors:
    return read_shift_factors(path, reference, columns=table.shift_factor_columns, sheet=table.shift_factor_sheet)


def _law_or_table(choice: str, factors: ShiftFactors) -> tuple[ShiftLaw, LawComparison[ParametricLaw] | None, str]:
    """Return α(T) as requested, the comparison of laws, and the choice."""
    try:
        laws = factors.compare_laws()
    except InputError:  # no law describes the factors
        laws = None
        if choice == "best":
            raise
    if choice == "measured":
        return factors, laws, choice
    if choice == "best" and laws is not None:
        return laws.best, laws, laws.chosen.kind
    return factors.law(choice), laws, choice
