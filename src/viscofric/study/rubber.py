"""From [material] to a material model: sweeps read, superposed and fitted, or a predefined material."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, cast, overload

import numpy as np

from viscofric.data import IsothermalSweeps
from viscofric.errors import DataFileError, InputError, LiquidError, StudyError
from viscofric.notes import Note, note_of
from viscofric.readers import read_dma, read_step_tests
from viscofric.readers.dma.master_curves import read_master_curve
from viscofric.readers.dma.ramps import read_ramps
from viscofric.rheology.cards import open_card
from viscofric.rheology.catalogue import catalogue_entry, catalogue_material
from viscofric.rheology.material import Material
from viscofric.rheology.ramps.assumed import assumed_of
from viscofric.rheology.ramps.superpose import superpose_ramps
from viscofric.rheology.shifts.shift_files import read_shift_factors
from viscofric.rheology.shifts.vertical_shift import with_vertical_shift
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition.joint import JointSuperposition, of_all_kinds
from viscofric.rheology.superposition.result import Superposition
from viscofric.rheology.superposition.step_result import PER_DECADE, StepSuperposition
from viscofric.rheology.superposition.superpose import superpose
from viscofric.step_tests import StepMasterCurve

if TYPE_CHECKING:
    from pathlib import Path

    import xarray

    from viscofric.data import MasterCurve
    from viscofric.rheology.ramps.result import RampSuperposition
    from viscofric.rheology.ramps.superpose import RampLaw
    from viscofric.rheology.shifts.law_comparison import LawComparison
    from viscofric.rheology.shifts.laws import ParametricLaw, ShiftLaw
    from viscofric.rheology.shifts.shift_factors import ShiftFactors
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples
    from viscofric.step_tests import StepTests
    from viscofric.study.run_file.material import MaterialTable


@dataclass(frozen=True, eq=False)
class Rubber:
    """A material with everything it was made from.

    Attributes
    ----------
    material : Material
        With a shift, about the reference temperature.
    source : str
        Origin of a predefined material.
    synthetic : bool
        Whether it is synthetic, from the catalogue.
    sweeps, fit : IsothermalSweeps, Superposition or None
        None for a predefined material.
    step_tests, step_fit : StepTests, StepSuperposition or None
        Creep or relaxation tests, instead of sweeps or together with them.
    joint : JointSuperposition or None
        Of sweeps and step tests together; `fit` and `step_fit` are its parts.
    master_curve : MasterCurve or None
        Given instead of sweeps, or made of ramps.
    ramps : RampSuperposition or None
        Of temperature ramps, given instead of sweeps.
    laws : LawComparison or None
        Shift laws fitted to the measured shift factors.
    shift_used : str
        ``"measured"``, or the name of the law in use.
    shift_origin : {"found", "given", "held"}
        Shift factors found from the sweeps, read from a file, or found with some held fixed.
    notes : tuple of str
        Warnings, changes and omissions, one sentence each.
    """

    material: Material
    source: str = ""
    synthetic: bool = False
    sweeps: IsothermalSweeps | None = None
    fit: Superposition | None = None
    step_tests: StepTests | None = None
    step_fit: StepSuperposition | None = None
    joint: JointSuperposition | None = None
    master_curve: MasterCurve | None = None
    ramps: RampSuperposition | None = None
    laws: LawComparison | None = None
    shift_used: str = ""
    shift_origin: str = "found"
    notes: tuple[str, ...] = ()

    @property
    def law(self) -> ParametricLaw | None:
        """The law in use, else the one that describes the measured shift factors best, if any."""
        from viscofric.rheology.shifts.laws import ParametricLaw

        if isinstance(self.material.shift, ParametricLaw):
            return self.material.shift
        return None if self.laws is None else self.laws.best

    @property
    def superposed(self) -> JointSuperposition | Superposition | StepSuperposition | None:
        """The superposition of all tests, None for a predefined material, a master curve, or ramps."""
        return self.joint or self.fit or self.step_fit

    @property
    def from_friction(self) -> bool:
        """Whether it was identified from friction, which then does not test predictions from it."""
        spectrum = self.material.spectrum
        fit = spectrum.fit if isinstance(spectrum, RetardationSpectrum) else None
        return fit is not None and fit.from_friction

    @property
    def attributes(self) -> dict[str, str | float]:
        """Attributes of the material in results."""
        said: dict[str, str | float] = {"poisson_ratio": self.material.poisson_ratio}
        if self.ramps is not None:
            said |= {"deformation": self.ramps.ramps.deformation, "dma_format": self.ramps.ramps.format}
        if self.sweeps is not None:
            said |= {"deformation": self.sweeps.deformation, "dma_format": self.sweeps.format}
        if self.step_tests is not None:
            tests = self.step_tests
            said |= {"deformation": tests.deformation, "step_tests": tests.kind, "step_tests_format": tests.format}
        if self.material.name or self.source:
            name = f"“{self.material.name}”" if self.material.name else "one"
            said["material"] = " of ".join(part for part in (name, self.source) if part)
        if self.from_friction:
            said["identified_from_friction"] = 1
        if self.material.citation:
            said["citation"] = self.material.citation
        if self.material.reference is not None:
            said["reference_temperature"] = self.material.reference
        return said


def make_rubber(table: MaterialTable, *, liquids: bool = False) -> Rubber:
    """Return the material of [material] of a run file, whose paths are resolved.

    With `liquids`, a liquid, which has no spectrum for contacts, becomes a table of its master curve, with a note.

    Raises
    ------
    LiquidError
        If it is a liquid, unless `liquids` is true.
    DataFileError, SuperpositionError, InputError
        If a file cannot be used or does not state tension or shear, or the fit fails.
    """
    if table.dma is not None:
        return _from_both(table, liquids) if table.steps else _from_sweeps(table, liquids)
    if table.steps:
        return _from_step_tests(table)
    if table.ramps is not None:
        return _from_ramps(table, liquids)
    return _predefined(table) if table.master_curve is None else _from_master_curve(table, liquids)


def _predefined(table: MaterialTable) -> Rubber:
    notes: tuple[str, ...] = ()
    synthetic = False
    if table.file is None:
        entry = catalogue_entry(str(table.catalogue))
        material, synthetic, source = catalogue_material(entry.name), entry.kind != "published", "the catalogue"
    else:
        card = open_card(table.file)
        material, notes, source = card.material, tuple(card.notes), f"the file {table.file.name}"
    if table.reference_temperature is not None:
        material = material.at_reference(table.reference_temperature)
    if table.name:
        material = replace(material, name=table.name)
    return Rubber(material, notes=notes, source=source, synthetic=synthetic)


def _name_of(files: tuple[Path, ...]) -> str:
    return str(files[0]) if len(files) == 1 else f"{files[0]} and {len(files) - 1} more"


def _from_step_tests(table: MaterialTable) -> Rubber:
    """Superpose creep or relaxation tests, and fit their spectrum."""
    tests = _read_steps(table)
    try:
        fit = _superposed(table, tests)
        shift, laws, used = _law_or_table(table.shift, fit.shift_factors)
        spectrum = fit_retardation_spectrum(fit, tau_ratio=table.tau_ratio, method=table.spectrum, modes=table.modes)
    except DataFileError:
        raise  # it names its file
    except InputError as error:
        raise error.at(_name_of(table.steps)) from error
    if spectrum.fit is not None and not fit.check.holds:
        doubts = (fit.check.sentences[0], *spectrum.fit.notes)
        spectrum = replace(spectrum, fit=replace(spectrum.fit, notes=doubts))
    material = Material(
        spectrum, shift=shift, poisson_ratio=table.poisson_ratio, name=table.name, vertical_shift=fit.vertical_shift
    )
    return Rubber(
        material,
        step_tests=tests,
        step_fit=fit,
        laws=laws,
        shift_used=used,
        shift_origin=_origin(table),
        notes=(*fit.notes, *_undecided(laws, table.shift)),
    )


def _read_steps(table: MaterialTable) -> StepTests:
    return read_step_tests(
        *table.steps,
        kind="creep" if table.creep is not None else "relaxation",
        deformation=table.deformation,
        temperature=table.temperature,
        response_unit=table.modulus_unit,
        columns=table.columns,
        sheet=table.sheet,
    )


def _from_both(table: MaterialTable, liquids: bool) -> Rubber:
    """Superpose sweeps and step tests together, and fit one spectrum to both."""
    sweeps, tests = _read_sweeps(table), _read_steps(table)
    try:
        joint = superpose(
            [sweeps, tests], _reference(table), by=table.shift_by, weights=table.shift_weights, **_how(table)
        )
        shift, laws, used = _law_or_table(table.shift, joint.shift_factors)
    except InputError as error:
        raise error.at(_name_of((*(table.dma or ()), *table.steps))) from error
    fit, step_fit = joint.parts
    assert isinstance(fit, Superposition)
    assert isinstance(step_fit, StepSuperposition)
    verdict = (*_verdict(fit), *(() if step_fit.check.holds else step_fit.check.sentences[:1]))
    spectrum, flowing = _spectrum(table, joint, verdict, liquids)
    material = Material(
        spectrum, shift=shift, poisson_ratio=table.poisson_ratio, name=table.name, vertical_shift=joint.vertical_shift
    )
    return Rubber(
        material,
        sweeps=sweeps,
        fit=fit,
        step_tests=tests,
        step_fit=step_fit,
        joint=joint,
        laws=laws,
        shift_used=used,
        notes=(*joint.notes, *flowing, *_undecided(laws, table.shift)),
    )


def _origin(table: MaterialTable) -> str:
    return "given" if table.shift_factors else "held" if table.fixed_shift_factors else "found"


def _read_sweeps(table: MaterialTable) -> IsothermalSweeps:
    return read_dma(
        *(table.dma or ()),
        deformation=table.deformation,
        temperature=table.temperature,
        modulus_unit=table.modulus_unit,
        columns=table.columns,
        sheet=table.sheet,
    )


def _from_sweeps(table: MaterialTable, liquids: bool) -> Rubber:
    sweeps = _read_sweeps(table)
    try:
        fit = _superposed(table, sweeps)
        shift, laws, used = _law_or_table(table.shift, fit.shift_factors)
    except DataFileError:
        raise  # it names its file
    except InputError as error:
        raise error.at(_name_of(table.dma or ())) from error
    spectrum, flowing = _spectrum(table, fit.master_curve, _verdict(fit), liquids)
    material = Material(
        spectrum,
        shift=shift,
        poisson_ratio=table.poisson_ratio,
        name=table.name,
        vertical_shift=fit.vertical_shift,
    )
    notes = (*fit.notes, *flowing, *_undecided(laws, table.shift))
    origin = _origin(table)
    return Rubber(material, sweeps=sweeps, fit=fit, laws=laws, shift_used=used, shift_origin=origin, notes=notes)


def _from_ramps(table: MaterialTable, liquids: bool) -> Rubber:
    """Superpose temperature ramps by a law, fitted or assumed, and fit the spectrum."""
    files, reference = table.ramps or (), table.reference_temperature
    if reference is None:
        raise StudyError(Note("missing", "is missing.", "material.reference_temperature"))
    ramps = read_ramps(
        *files,
        deformation=table.deformation,
        modulus_unit=table.modulus_unit,
        columns=table.columns,
        sheet=table.sheet,
    )
    try:
        fit = superpose_ramps(
            ramps,
            reference,
            cast("RampLaw", "wlf" if table.shift == "measured" else table.shift),
            assumed=None if table.assumed_shift is None else assumed_of(table.assumed_shift, reference),
            poisson_ratio=table.poisson_ratio,
            vertical="density" if table.vertical_shift == "density" else None,
        )
    except InputError as error:
        raise error.at(str(files[0])) from error
    verdict = tuple(note for note in fit.notes if note_of(note).code in _DOUBTS_OF_RAMPS)
    spectrum, flowing = _spectrum(table, fit.master_curve, verdict, liquids)
    material = Material(
        spectrum,
        shift=fit.shift,
        poisson_ratio=table.poisson_ratio,
        name=table.name,
        vertical_shift=fit.vertical_shift,
    )
    used = "assumed" if fit.assumption else getattr(fit.shift, "kind", "")
    return Rubber(material, master_curve=fit.master_curve, ramps=fit, shift_used=used, notes=(*fit.notes, *flowing))


#: Notes on ramps that stay with the spectrum.
_DOUBTS_OF_RAMPS = {"ramps-do-not-superpose", "shift-assumed", "assumption-contradicted"}


def _from_master_curve(table: MaterialTable, liquids: bool) -> Rubber:
    """Use a given master curve, with its shift factors if they are given."""
    path, reference = table.master_curve, table.reference_temperature
    if path is None or reference is None:
        raise StudyError(Note("missing", "is missing.", "material.reference_temperature"))
    curve = read_master_curve(
        path,
        reference,
        deformation=table.deformation,
        poisson_ratio=table.poisson_ratio,
        modulus_unit=table.modulus_unit,
        columns=table.columns,
        sheet=table.sheet,
    )
    shift: ShiftLaw | None = None
    if table.shift_factors is not None:
        factors = _given_factors(table, table.shift_factors, reference)
        shift, laws, used = _law_or_table(table.shift, factors)
    else:
        laws, used = None, ""
    spectrum, flowing = _spectrum(table, curve, (), liquids)
    material = Material(spectrum, shift=shift, poisson_ratio=table.poisson_ratio, name=table.name)
    notes = (*flowing, *_undecided(laws, table.shift))
    return Rubber(material, master_curve=curve, laws=laws, shift_used=used, notes=notes)


def _undecided(laws: LawComparison | None, choice: str) -> tuple[str, ...]:
    """Return notes about an undecided choice among laws, if the best law is used."""
    if laws is None or choice != "best":
        return ()
    return tuple(note for note in laws.notes if note.code == "laws-undecided")


def _spectrum(
    table: MaterialTable, curve: MasterCurve | JointSuperposition, verdict: tuple[str, ...], liquids: bool
) -> tuple[RetardationSpectrum | ModulusTable, tuple[str, ...]]:
    """Fit the spectrum; warnings about the master curve go into it, so that they stay in its file.

    A liquid becomes a table, with a note, or is refused.
    """
    try:
        spectrum = fit_retardation_spectrum(curve, tau_ratio=table.tau_ratio, method=table.spectrum, modes=table.modes)
    except LiquidError as error:
        if not liquids:
            raise
        moduli = curve.parts[0].master_curve if isinstance(curve, JointSuperposition) else curve
        assert not isinstance(moduli, StepMasterCurve)  # sweeps come first
        return ModulusTable.from_master_curve(moduli), (Note("liquid", f"No spectrum: {error}"),)
    if spectrum.fit is None or not verdict:
        return spectrum, ()
    return replace(spectrum, fit=replace(spectrum.fit, notes=(*verdict, *spectrum.fit.notes))), ()


def _verdict(fit: Superposition) -> tuple[str, ...]:
    check = fit.check
    failed = [] if check.holds else [check.sentences[0]]
    return tuple(failed if check.consistent else [*failed, check.sentences[-1]])


@overload
def _superposed(table: MaterialTable, tests: IsothermalSweeps) -> Superposition: ...
@overload
def _superposed(table: MaterialTable, tests: StepTests) -> StepSuperposition: ...
def _superposed(table: MaterialTable, tests: IsothermalSweeps | StepTests) -> Superposition | StepSuperposition:
    reference = _reference(table)
    common = _how(table) | {
        "shift": None if table.shift_factors is None else _given_factors(table, table.shift_factors),
        "fixed": table.fixed_shift_factors or None,
    }
    if isinstance(tests, IsothermalSweeps):
        return superpose(tests, reference, by=table.shift_by, weights=table.shift_weights, **common)
    return superpose(tests, reference, **common)


def _reference(table: MaterialTable) -> float:
    if table.reference_temperature is None:
        raise StudyError(Note("missing", "is missing.", "material.reference_temperature"))
    return table.reference_temperature


def _how(table: MaterialTable) -> dict[str, Any]:
    vertical = None if table.vertical_shift == "none" else table.vertical_shift
    return {"poisson_ratio": table.poisson_ratio, "vertical": vertical}


def _given_factors(table: MaterialTable, path: Path, reference: float | None = None) -> ShiftFactors:
    return read_shift_factors(path, reference, columns=table.shift_factor_columns, sheet=table.shift_factor_sheet)


def _law_or_table(choice: str, factors: ShiftFactors) -> tuple[ShiftLaw, LawComparison | None, str]:
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


def shift_of(rubber: Rubber) -> ShiftLaw:
    """Return α(T) of a material for contacts; raise `StudyError` if it has no spectrum or no shift factors."""
    material = rubber.material
    if not isinstance(material.spectrum, RetardationSpectrum):
        raise StudyError(
            Note(
                "no-spectrum",
                f"{material.name or 'the rubber'} is a table of moduli without a spectrum, and contacts need one; "
                "fit it to the table (viscofric material fit).",
                "material",
            )
        )
    if material.shift is None:
        raise StudyError(
            Note(
                "no-shift",
                f"{material.name or 'the rubber'} has no shift factors, and cannot be used at other temperatures; give "
                "a material that has them, or sweeps at several temperatures.",
                "material",
            )
        )
    return material.shift


def rubber_groups(rubber: Rubber, samples: MaterialSamples | None = None) -> dict[str, xarray.Dataset]:
    """Return the data sets of a material; `samples` give the bands of its moduli."""
    groups: dict[str, xarray.Dataset] = {}
    fit, spectrum = rubber.fit, rubber.material.spectrum
    if fit is not None and rubber.sweeps is not None:
        isotherms = rubber.sweeps.in_tension(rubber.material.poisson_ratio).to_dataset()
        groups["/isotherms"] = isotherms.drop_attrs(deep=False).drop_vars("strain_amplitude", errors="ignore")
        groups["/shift_factors"] = _factors(rubber, fit, rubber.sweeps.temperatures)
        groups["/superposition"] = fit.check.to_dataset()
    if rubber.step_fit is not None and rubber.step_tests is not None:
        groups = _step_groups(rubber, rubber.step_tests, rubber.step_fit) | groups
    if rubber.ramps is not None:
        groups["/ramps"] = rubber.ramps.to_dataset()
    curve = rubber.master_curve if fit is None else fit.master_curve
    if curve is not None and isinstance(spectrum, RetardationSpectrum) and spectrum.fit is not None:
        groups["/master_curve"] = spectrum.master_curve_dataset(curve)
    elif curve is not None:  # of a liquid, which has no spectrum
        groups["/master_curve"] = curve.to_dataset()
    if rubber.laws is not None:
        groups["/laws"] = rubber.laws.to_dataset()
    if rubber.law is not None:
        groups["/shift_law"] = _shift_law(rubber)
    if isinstance(spectrum, RetardationSpectrum):
        wide = _wide(spectrum)
        groups["/spectrum"] = spectrum.to_dataset()
        moduli = spectrum.modulus_dataset(wide)
        groups["/spectrum_curve"] = moduli if samples is None else moduli.assign(samples.to_dataset(wide).data_vars)
    return groups


def _step_groups(rubber: Rubber, tests: StepTests, fit: StepSuperposition) -> dict[str, xarray.Dataset]:
    """Return the data sets of creep or relaxation tests: tensile points, shift factors, check, master curve."""
    used = tests.in_tension(rubber.material.poisson_ratio).thinned(PER_DECADE)
    spectrum, curve = rubber.material.spectrum, fit.master_curve
    return {
        "/step_tests": used.to_dataset(),
        "/shift_factors": _factors(rubber, fit, tests.temperatures),
        "/superposition": fit.check.to_dataset(),
        "/step_master_curve": spectrum.step_curve_dataset(curve)
        if isinstance(spectrum, RetardationSpectrum)
        else curve.to_dataset(),
    }


def _factors(rubber: Rubber, fit: Superposition | StepSuperposition, temperatures: Any) -> xarray.Dataset:
    """Return shift factors, of all tests where there are several kinds, with the overlap of one kind."""
    found = fit.to_dataset()
    if (joint := rubber.joint) is not None:
        common = with_vertical_shift(joint.to_dataset(), joint.vertical_shift, joint.shift_factors.temperatures)
        found = common.assign_attrs(found.attrs | {"isotherms_used": len(joint.shift_factors.temperatures)})
        assert rubber.sweeps is not None
        assert rubber.step_tests is not None
        temperatures = of_all_kinds([rubber.sweeps.temperatures, rubber.step_tests.temperatures])
    given = np.unique(temperatures)
    return found.assign_attrs(
        shift_used=rubber.shift_used,
        shift_origin=rubber.shift_origin,
        isotherms_given=len(given),
        temperatures_given=json.dumps(given.tolist()),
    )


def _shift_law(rubber: Rubber) -> xarray.Dataset:
    """Return the law over the temperatures that it was fitted to, or 50 K about its reference."""
    law = rubber.law
    assert law is not None
    ends = law.fitted_range or (law.reference - 50.0, law.reference + 50.0)
    rms: dict[str, float] = {}
    if (fit := rubber.superposed) is not None:
        factors = fit.shift_factors
        ends = float(factors.temperatures[0]), float(factors.temperatures[-1])
        residual = factors.log10_values - law.log10(factors.temperatures)
        rms["rms"] = float(np.sqrt(np.mean(residual**2)))
    kelvin = np.linspace(max(ends[0], law.extrapolation_limits[0] + 1.0), ends[1], 201)
    return law.to_dataset(kelvin).assign_attrs(rms)


def _wide(spectrum: RetardationSpectrum) -> Any:
    """Return angular frequencies to two decades beyond the measured ones, or beyond the modes."""
    low, high = (1.0 / spectrum.tau.max(), 1.0 / spectrum.tau.min()) if len(spectrum) else (1.0, 1.0)
    if spectrum.fit is not None:
        low, high = spectrum.fit.frequency_range
    return np.geomspace(low / 100.0, high * 100.0, 600)
