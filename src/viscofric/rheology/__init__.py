"""From sweeps to a rubber: shift factors, master curve, retardation spectrum, material; and to other programs."""

from viscofric.rheology.cards import Card, open_card, read_card, write_card
from viscofric.rheology.catalogue import CatalogueEntry, catalogue, catalogue_material, synthetic_fluoroelastomer
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.law_comparison import LawComparison
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, ShiftLaw, WLFArrhenius
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_files import read_shift_factors, read_vendor_law
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShift, VerticalShiftFactors
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.relaxation import RelaxationSpectrum
from viscofric.rheology.spectra.retardation import RetardationSpectrum, SpectrumFit
from viscofric.rheology.spectra.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition.consistency import SuperpositionCheck, check_superposition
from viscofric.rheology.superposition.superpose import Superposition, superpose
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.rheology.uncertainty.sampling import sample_materials

__all__ = [
    "VFT",
    "WLF",
    "Arrhenius",
    "Card",
    "CatalogueEntry",
    "DensityShift",
    "InversePolynomial",
    "LawComparison",
    "Material",
    "MaterialSamples",
    "ModulusTable",
    "RelaxationSpectrum",
    "RetardationSpectrum",
    "ShiftFactors",
    "ShiftLaw",
    "SpectrumFit",
    "Superposition",
    "SuperpositionCheck",
    "VerticalShift",
    "VerticalShiftFactors",
    "WLFArrhenius",
    "catalogue",
    "catalogue_material",
    "check_superposition",
    "fit_retardation_spectrum",
    "open_card",
    "read_card",
    "read_shift_factors",
    "read_vendor_law",
    "sample_materials",
    "superpose",
    "synthetic_fluoroelastomer",
    "write_card",
]
