"""From [material] to a rubber: sweeps read, superposed and fitted, or a rubber that is ready."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.errors import InputError, StudyError
from viscofric.readers import deformation_is_told, read_dma
from viscofric.rheology.cards import open_card
from viscofric.rheology.catalogue import catalogue_material
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_files import read_shift_factors
from viscofric.rheology.spectra.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition.superpose import superpose

if TYPE_CHECKING:
    from viscofric.data import IsothermalSweeps
    from viscofric.rheology.shifts.law_comparison import LawComparison
    from viscofric.rheology.shifts.laws import ParametricLaw, ShiftLaw
    from viscofric.rheology.superposition.superpose import Superposition
    from viscofric.study.material_table import MaterialTable


@dataclass(frozen=True, eq=False)
class Rubber:
    """A material with everything that it was made from.

    Parameters
    ----------
    material : Material
        With a shift, about the reference temperature.
    sweeps : IsothermalSweeps, optional
        As read; none for a rubber that was ready.
    fit : Superposition, optional
        Of the sweeps.
    laws : LawComparison, optional
        The shift laws that were tried on the measured shift factors.
    shift_used : str
        What α(T) of the material is: ``"measured"``, or the name of a law.
    notes : tuple of str
        What was doubtful, changed or left out on the way: one sentence each.
    """

    material: Material
    sweeps: IsothermalSweeps | None = None
    fit: Superposition | None = None
    laws: LawComparison | None = None
    shift_used: str = ""
    notes: tuple[str, ...] = ()

    @property
    def law(self) -> ParametricLaw | None:
        """The law that is used, else the one that describes the measured shift factors best, if any does."""
        from viscofric.rheology.shifts.laws import ParametricLaw

        if isinstance(self.material.shift, ParametricLaw):
            return self.material.shift
        return None if self.laws is None else self.laws.best

    @property
    def attributes(self) -> dict[str, str | float]:
        """What results say of the rubber as a whole."""
        said: dict[str, str | float] = {"poisson_ratio": self.material.poisson_ratio}
        if self.sweeps is not None:
            said |= {"deformation": self.sweeps.deformation, "dma_format": self.sweeps.format}
        if self.material.name:
            said["material"] = self.material.name
        if self.material.citation:
            said["citation"] = self.material.citation
        if self.material.reference is not None:
            said["reference_temperature"] = self.material.reference
        return said


def make_rubber(wanted: MaterialTable) -> Rubber:
    """Make the rubber that [material] of a run file asks for.

    Parameters
    ----------
    wanted : MaterialTable
        With its paths resolved.

    Raises
    ------
    StudyError
        If sweeps do not say whether they were taken in tension or in shear.
    DataFileError, SuperpositionError, InputError
        If a file cannot be used, or the sweeps do not give what is asked for.
    """
    return _ready(wanted) if wanted.dma is None else _from_sweeps(wanted)


def _ready(wanted: MaterialTable) -> Rubber:
    notes: tuple[str, ...] = ()
    if wanted.file is None:
        material = catalogue_material(str(wanted.catalogue))
    else:
        card = open_card(wanted.file)
        material, notes = card.material, tuple(card.notes)
    if wanted.reference_temperature is not None:
        material = material.at_reference(wanted.reference_temperature)
    return Rubber(material, notes=notes)


def _from_sweeps(wanted: MaterialTable) -> Rubber:
    files = wanted.dma or ()
    name = str(files[0]) if len(files) == 1 else f"{files[0]} and {len(files) - 1} more"
    sweeps = read_dma(
        *files,
        deformation=wanted.deformation,
        temperature=wanted.temperature,
        modulus_unit=wanted.modulus_unit,
    )
    if not deformation_is_told(sweeps):
        raise StudyError(
            f"{name}: does not say whether it was measured in tension or in shear, a factor of 3 in the modulus; "
            'write deformation = "tension" or "shear" below [material].'
        )
    try:
        fit = _superposed(wanted, sweeps)
        shift, laws, used = _shift(wanted.shift, fit)
    except InputError as error:
        raise type(error)(f"{name}: {error}") from error
    spectrum = fit_retardation_spectrum(
        fit.master_curve, tau_ratio=wanted.tau_ratio, method=wanted.spectrum, modes=wanted.modes
    )
    material = Material(spectrum, shift=shift, poisson_ratio=wanted.poisson_ratio, vertical_shift=fit.vertical_shift)
    return Rubber(material, sweeps, fit, laws, used, fit.notes)


def _superposed(wanted: MaterialTable, sweeps: IsothermalSweeps) -> Superposition:
    reference = wanted.reference_temperature
    if reference is None:
        raise StudyError("material.reference_temperature: is missing.")
    given = None if wanted.shift_factors is None else read_shift_factors(wanted.shift_factors)
    return superpose(
        sweeps,
        reference,
        poisson_ratio=wanted.poisson_ratio,
        vertical=None if wanted.vertical_shift == "none" else wanted.vertical_shift,
        shift=given,
        fixed=wanted.fixed_shift_factors or None,
    )


def _shift(wanted: str, fit: Superposition) -> tuple[ShiftLaw, LawComparison | None, str]:
    """Return α(T) as wanted, the laws that were tried, and what was taken."""
    factors = fit.shift_factors
    try:
        laws = factors.compare_laws()
    except InputError:  # no law describes the factors
        laws = None
        if wanted == "best":
            raise
    if wanted == "measured":
        return factors, laws, wanted
    if wanted == "best" and laws is not None:
        return laws.best, laws, laws.chosen.kind
    return factors.law(wanted), laws, wanted
