"""From sweeps to a rubber: shift factors, master curve, retardation spectrum, material."""

from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.material import Material
from viscofric.rheology.shift_factors import ShiftFactors
from viscofric.rheology.shift_laws import WLF, Arrhenius, ShiftLaw, WLFArrhenius
from viscofric.rheology.spectrum import RetardationSpectrum, SpectrumFit
from viscofric.rheology.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition import Superposition, superpose

__all__ = [
    "WLF",
    "Arrhenius",
    "Material",
    "RetardationSpectrum",
    "ShiftFactors",
    "ShiftLaw",
    "SpectrumFit",
    "Superposition",
    "WLFArrhenius",
    "fit_retardation_spectrum",
    "superpose",
    "synthetic_fluoroelastomer",
]
