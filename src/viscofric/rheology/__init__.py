"""From sweeps to a material: shift factors, master curve, retardation spectrum; material cards of other programs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.lazy import loaded_when_used

if TYPE_CHECKING:
    from viscofric.rheology.cards import Card as Card
    from viscofric.rheology.cards import open_card as open_card
    from viscofric.rheology.cards import read_card as read_card
    from viscofric.rheology.cards import write_card as write_card
    from viscofric.rheology.catalogue import CatalogueEntry as CatalogueEntry
    from viscofric.rheology.catalogue import catalogue_material as catalogue_material
    from viscofric.rheology.catalogue import synthetic_fluoroelastomer as synthetic_fluoroelastomer
    from viscofric.rheology.material import Material as Material
    from viscofric.rheology.shifts.law_comparison import LawComparison as LawComparison
    from viscofric.rheology.shifts.laws import VFT as VFT
    from viscofric.rheology.shifts.laws import WLF as WLF
    from viscofric.rheology.shifts.laws import Arrhenius as Arrhenius
    from viscofric.rheology.shifts.laws import InversePolynomial as InversePolynomial
    from viscofric.rheology.shifts.laws import ShiftLaw as ShiftLaw
    from viscofric.rheology.shifts.laws import WLFArrhenius as WLFArrhenius
    from viscofric.rheology.shifts.shift_factors import ShiftFactors as ShiftFactors
    from viscofric.rheology.shifts.shift_files import read_shift_factors as read_shift_factors
    from viscofric.rheology.shifts.shift_files import read_vendor_law as read_vendor_law
    from viscofric.rheology.shifts.vertical_shift import DensityShift as DensityShift
    from viscofric.rheology.shifts.vertical_shift import VerticalShift as VerticalShift
    from viscofric.rheology.shifts.vertical_shift import VerticalShiftFactors as VerticalShiftFactors
    from viscofric.rheology.spectra.modulus_table import ModulusTable as ModulusTable
    from viscofric.rheology.spectra.quality import SpectrumFit as SpectrumFit
    from viscofric.rheology.spectra.retardation import RelaxationSpectrum as RelaxationSpectrum
    from viscofric.rheology.spectra.retardation import RetardationSpectrum as RetardationSpectrum
    from viscofric.rheology.spectra.spectrum_fit import fit_retardation_spectrum as fit_retardation_spectrum
    from viscofric.rheology.superposition.consistency import SuperpositionCheck as SuperpositionCheck
    from viscofric.rheology.superposition.joint import JointSuperposition as JointSuperposition
    from viscofric.rheology.superposition.result import Superposition as Superposition
    from viscofric.rheology.superposition.result import check_superposition as check_superposition
    from viscofric.rheology.superposition.step_result import StepCheck as StepCheck
    from viscofric.rheology.superposition.step_result import StepSuperposition as StepSuperposition
    from viscofric.rheology.superposition.superpose import superpose as superpose
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples as MaterialSamples
    from viscofric.rheology.uncertainty.sampling import sample_materials as sample_materials

# public name -> the module that defines it
_HOME = {
    "Card": "viscofric.rheology.cards",
    "open_card": "viscofric.rheology.cards",
    "read_card": "viscofric.rheology.cards",
    "write_card": "viscofric.rheology.cards",
    "CatalogueEntry": "viscofric.rheology.catalogue",
    "catalogue_material": "viscofric.rheology.catalogue",
    "synthetic_fluoroelastomer": "viscofric.rheology.catalogue",
    "Material": "viscofric.rheology.material",
    "LawComparison": "viscofric.rheology.shifts.law_comparison",
    "Arrhenius": "viscofric.rheology.shifts.laws",
    "InversePolynomial": "viscofric.rheology.shifts.laws",
    "ShiftLaw": "viscofric.rheology.shifts.laws",
    "VFT": "viscofric.rheology.shifts.laws",
    "WLF": "viscofric.rheology.shifts.laws",
    "WLFArrhenius": "viscofric.rheology.shifts.laws",
    "ShiftFactors": "viscofric.rheology.shifts.shift_factors",
    "read_shift_factors": "viscofric.rheology.shifts.shift_files",
    "read_vendor_law": "viscofric.rheology.shifts.shift_files",
    "DensityShift": "viscofric.rheology.shifts.vertical_shift",
    "VerticalShift": "viscofric.rheology.shifts.vertical_shift",
    "VerticalShiftFactors": "viscofric.rheology.shifts.vertical_shift",
    "ModulusTable": "viscofric.rheology.spectra.modulus_table",
    "RelaxationSpectrum": "viscofric.rheology.spectra.retardation",
    "RetardationSpectrum": "viscofric.rheology.spectra.retardation",
    "SpectrumFit": "viscofric.rheology.spectra.quality",
    "fit_retardation_spectrum": "viscofric.rheology.spectra.spectrum_fit",
    "SuperpositionCheck": "viscofric.rheology.superposition.consistency",
    "check_superposition": "viscofric.rheology.superposition.result",
    "Superposition": "viscofric.rheology.superposition.result",
    "JointSuperposition": "viscofric.rheology.superposition.joint",
    "StepCheck": "viscofric.rheology.superposition.step_result",
    "StepSuperposition": "viscofric.rheology.superposition.step_result",
    "superpose": "viscofric.rheology.superposition.superpose",
    "MaterialSamples": "viscofric.rheology.uncertainty.material_samples",
    "sample_materials": "viscofric.rheology.uncertainty.sampling",
}

__all__ = [*_HOME]  # noqa: PLE0604
__getattr__ = loaded_when_used(__name__, _HOME)
