"""Viscoelastic friction of rubber from laboratory data, at any speed and temperature, and back.

The front door: every public name, loaded when first used, so that importing viscofric costs next to nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from viscofric.lazy import loaded_when_used

if TYPE_CHECKING:
    from viscofric.amplitudes import AmplitudeSweep as AmplitudeSweep
    from viscofric.contact.arrays.backend import Backend as Backend
    from viscofric.contact.bodies import Layer as Layer
    from viscofric.contact.derivatives.friction import FrictionDerivatives as FrictionDerivatives
    from viscofric.contact.fields import highest_von_mises as highest_von_mises
    from viscofric.contact.fields import line_stress as line_stress
    from viscofric.contact.fields import stress_at as stress_at
    from viscofric.contact.fields import stress_layer as stress_layer
    from viscofric.contact.fields import stress_plane as stress_plane
    from viscofric.contact.fields import surface_displacement as surface_displacement
    from viscofric.contact.fields import surface_power as surface_power
    from viscofric.contact.indenters.height_map import HeightMap as HeightMap
    from viscofric.contact.indenters.height_map import Profile as Profile
    from viscofric.contact.indenters.shapes import Ball as Ball
    from viscofric.contact.indenters.shapes import Cone as Cone
    from viscofric.contact.indenters.shapes import Cylinder as Cylinder
    from viscofric.contact.indenters.shapes import Ellipsoid as Ellipsoid
    from viscofric.contact.indenters.shapes import FlatPunch as FlatPunch
    from viscofric.contact.periodic.solution import PeriodicDiagnostics as PeriodicDiagnostics
    from viscofric.contact.periodic.solution import PeriodicSolution as PeriodicSolution
    from viscofric.contact.periodic.solve import solve_periodic as solve_periodic
    from viscofric.contact.periodic.surface import PeriodicSurface as PeriodicSurface
    from viscofric.contact.solution import ContactSolution as ContactSolution
    from viscofric.contact.solution import Diagnostics as Diagnostics
    from viscofric.contact.steady import solve_steady as solve_steady
    from viscofric.data import Isotherm as Isotherm
    from viscofric.data import IsothermalSweeps as IsothermalSweeps
    from viscofric.data import MasterCurve as MasterCurve
    from viscofric.errors import ConvergenceError as ConvergenceError
    from viscofric.errors import DataFileError as DataFileError
    from viscofric.errors import InputError as InputError
    from viscofric.errors import LiquidError as LiquidError
    from viscofric.errors import StudyError as StudyError
    from viscofric.errors import SuperpositionError as SuperpositionError
    from viscofric.errors import ViscofricError as ViscofricError
    from viscofric.friction.agreement import Agreement as Agreement
    from viscofric.friction.agreement import compare as compare
    from viscofric.friction.assumption_check import AssumptionCheck as AssumptionCheck
    from viscofric.friction.assumptions import check_assumptions as check_assumptions
    from viscofric.friction.contact_strain import ContactAtStrain as ContactAtStrain
    from viscofric.friction.contact_strain import solve_at_contact_strain as solve_at_contact_strain
    from viscofric.friction.curve_files import read_friction_curves as read_friction_curves
    from viscofric.friction.curve_files import write_friction_curves as write_friction_curves
    from viscofric.friction.curves import FrictionCurves as FrictionCurves
    from viscofric.friction.heating import HeatedFrictionCurves as HeatedFrictionCurves
    from viscofric.friction.identification.anchors import ContactAnchor as ContactAnchor
    from viscofric.friction.identification.anchors import ModulusAnchor as ModulusAnchor
    from viscofric.friction.identification.identified import Identified as Identified
    from viscofric.friction.identification.identify import identify_material as identify_material
    from viscofric.friction.identification.indentation.identify import (
        identify_from_indentation as identify_from_indentation,
    )
    from viscofric.friction.identification.indentation.reading import read_oscillation as read_oscillation
    from viscofric.friction.identification.indentation.reading import read_rebound as read_rebound
    from viscofric.friction.identification.indentation.record import IndentationRecord as IndentationRecord
    from viscofric.friction.identification.indentation.record import read_indentation as read_indentation
    from viscofric.friction.identification.indentation.result import FittedRecord as FittedRecord
    from viscofric.friction.identification.indentation.result import MaterialFromIndentation as MaterialFromIndentation
    from viscofric.friction.identification.indentation.tables import OscillationRecord as OscillationRecord
    from viscofric.friction.identification.indentation.tables import ReboundRecord as ReboundRecord
    from viscofric.friction.identification.result import IdentifiedMaterial as IdentifiedMaterial
    from viscofric.friction.interface.shear_stress import ShearStress as ShearStress
    from viscofric.friction.interface.shear_stress import shear_stress as shear_stress
    from viscofric.friction.measurement.tribometry import separate as separate
    from viscofric.friction.prediction import predict_friction as predict_friction
    from viscofric.friction.shifting.master_curve import FrictionMasterCurve as FrictionMasterCurve
    from viscofric.friction.shifting.shift import shift_friction as shift_friction
    from viscofric.friction.shifting.shift_agreement import ShiftAgreement as ShiftAgreement
    from viscofric.friction.shifting.shift_agreement import compare_shift_factors as compare_shift_factors
    from viscofric.heat.heating import Heating as Heating
    from viscofric.heat.maps import surface_temperature as surface_temperature
    from viscofric.heat.result import ContactHeating as ContactHeating
    from viscofric.heat.result import TransientHeating as TransientHeating
    from viscofric.heat.sources import MovingHeatSource as MovingHeatSource
    from viscofric.heat.track import track_temperature as track_temperature
    from viscofric.literature.citations import Citations as Citations
    from viscofric.literature.citations import citations as citations
    from viscofric.motion.cycle import solve_cycle as solve_cycle
    from viscofric.motion.cycle_solution import CycleSolution as CycleSolution
    from viscofric.motion.history import History as History
    from viscofric.motion.history_files import read_history as read_history
    from viscofric.motion.impact import restitution_curve as restitution_curve
    from viscofric.motion.impact import solve_impact as solve_impact
    from viscofric.motion.impact_solution import ImpactContact as ImpactContact
    from viscofric.motion.impact_solution import ImpactSolution as ImpactSolution
    from viscofric.motion.impact_solution import RestitutionCurve as RestitutionCurve
    from viscofric.motion.solution import TransientErrors as TransientErrors
    from viscofric.motion.solution import TransientSolution as TransientSolution
    from viscofric.motion.solve import solve_transient as solve_transient
    from viscofric.ramps import TemperatureRamp as TemperatureRamp
    from viscofric.ramps import TemperatureRamps as TemperatureRamps
    from viscofric.readers import read_dma as read_dma
    from viscofric.readers import read_mtm as read_mtm
    from viscofric.readers import read_step_tests as read_step_tests
    from viscofric.readers.dma.amplitudes import read_amplitude_sweep as read_amplitude_sweep
    from viscofric.readers.dma.master_curves import read_master_curve as read_master_curve
    from viscofric.readers.dma.ramps import read_ramps as read_ramps
    from viscofric.rheology.cards import Card as Card
    from viscofric.rheology.cards import open_card as open_card
    from viscofric.rheology.cards import read_card as read_card
    from viscofric.rheology.cards import write_card as write_card
    from viscofric.rheology.catalogue import CatalogueEntry as CatalogueEntry
    from viscofric.rheology.catalogue import catalogue as catalogue
    from viscofric.rheology.catalogue import catalogue_material as catalogue_material
    from viscofric.rheology.catalogue import synthetic_fluoroelastomer as synthetic_fluoroelastomer
    from viscofric.rheology.interface.law import InterfaceLaw as InterfaceLaw
    from viscofric.rheology.interface.laws import ConstantShearStress as ConstantShearStress
    from viscofric.rheology.interface.laws import EyringShearStress as EyringShearStress
    from viscofric.rheology.interface.laws import GaussianShearStress as GaussianShearStress
    from viscofric.rheology.interface.laws import PowerShearStress as PowerShearStress
    from viscofric.rheology.material import Material as Material
    from viscofric.rheology.payne.at_strain import contact_strain as contact_strain
    from viscofric.rheology.payne.at_strain import material_at_strain as material_at_strain
    from viscofric.rheology.payne.kraus import KrausLaw as KrausLaw
    from viscofric.rheology.payne.kraus_fit import LinearRange as LinearRange
    from viscofric.rheology.payne.kraus_fit import PayneFit as PayneFit
    from viscofric.rheology.payne.kraus_fit import fit_kraus as fit_kraus
    from viscofric.rheology.ramps.glass_transition import GlassTransition as GlassTransition
    from viscofric.rheology.ramps.glass_transition import glass_transition as glass_transition
    from viscofric.rheology.ramps.result import RampCheck as RampCheck
    from viscofric.rheology.ramps.result import RampSuperposition as RampSuperposition
    from viscofric.rheology.ramps.superpose import superpose_ramps as superpose_ramps
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
    from viscofric.rheology.superposition.overlap import OverlapQuality as OverlapQuality
    from viscofric.rheology.superposition.result import Superposition as Superposition
    from viscofric.rheology.superposition.result import check_superposition as check_superposition
    from viscofric.rheology.superposition.step_result import StepCheck as StepCheck
    from viscofric.rheology.superposition.step_result import StepSuperposition as StepSuperposition
    from viscofric.rheology.superposition.superpose import superpose as superpose
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples as MaterialSamples
    from viscofric.rheology.uncertainty.sampling import sample_materials as sample_materials
    from viscofric.roughness.ensemble import predict_rough_friction as predict_rough_friction
    from viscofric.roughness.made import self_affine as self_affine
    from viscofric.roughness.made import surface_from_spectrum as surface_from_spectrum
    from viscofric.roughness.measured_spectrum import LineSpectrum as LineSpectrum
    from viscofric.roughness.measured_spectrum import line_spectrum as line_spectrum
    from viscofric.roughness.measured_spectrum import power_spectrum as power_spectrum
    from viscofric.roughness.patches import ContactStatistics as ContactStatistics
    from viscofric.roughness.patches import contact_statistics as contact_statistics
    from viscofric.roughness.patches import pressure_distribution as pressure_distribution
    from viscofric.roughness.persson import persson_theory as persson_theory
    from viscofric.roughness.persson_result import HeatedPerssonTheory as HeatedPerssonTheory
    from viscofric.roughness.persson_result import PerssonTheory as PerssonTheory
    from viscofric.roughness.reading import read_topography as read_topography
    from viscofric.roughness.rough_friction import HeatedRoughFriction as HeatedRoughFriction
    from viscofric.roughness.rough_friction import RoughFriction as RoughFriction
    from viscofric.roughness.scales import FrictionByWavelength as FrictionByWavelength
    from viscofric.roughness.scales import friction_by_wavelength as friction_by_wavelength
    from viscofric.roughness.spectrum import PowerSpectrum as PowerSpectrum
    from viscofric.roughness.topography import Topography as Topography
    from viscofric.step_tests import StepMasterCurve as StepMasterCurve
    from viscofric.step_tests import StepTest as StepTest
    from viscofric.step_tests import StepTests as StepTests
    from viscofric.study import ResultsComparison as ResultsComparison
    from viscofric.study import Study as Study
    from viscofric.study import StudyResults as StudyResults
    from viscofric.study import compare_results as compare_results
    from viscofric.study import load_study as load_study
    from viscofric.study import open_results as open_results
    from viscofric.study import run_study as run_study
    from viscofric.thermal import ThermalProperties as ThermalProperties
    from viscofric.traction import TractionRuns as TractionRuns
    from viscofric.traction import TractionStep as TractionStep

__version__: str

# public name -> the module that defines it
_HOME = {
    "Backend": "viscofric.contact.arrays.backend",
    "FrictionDerivatives": "viscofric.contact.derivatives.friction",
    "highest_von_mises": "viscofric.contact.fields",
    "line_stress": "viscofric.contact.fields",
    "stress_at": "viscofric.contact.fields",
    "stress_layer": "viscofric.contact.fields",
    "stress_plane": "viscofric.contact.fields",
    "surface_displacement": "viscofric.contact.fields",
    "surface_power": "viscofric.contact.fields",
    "HeightMap": "viscofric.contact.indenters.height_map",
    "Profile": "viscofric.contact.indenters.height_map",
    "Ball": "viscofric.contact.indenters.shapes",
    "Cylinder": "viscofric.contact.indenters.shapes",
    "Layer": "viscofric.contact.bodies",
    "PeriodicDiagnostics": "viscofric.contact.periodic.solution",
    "PeriodicSolution": "viscofric.contact.periodic.solution",
    "solve_periodic": "viscofric.contact.periodic.solve",
    "PeriodicSurface": "viscofric.contact.periodic.surface",
    "Cone": "viscofric.contact.indenters.shapes",
    "Ellipsoid": "viscofric.contact.indenters.shapes",
    "FlatPunch": "viscofric.contact.indenters.shapes",
    "ContactSolution": "viscofric.contact.solution",
    "Diagnostics": "viscofric.contact.solution",
    "solve_steady": "viscofric.contact.steady",
    "CycleSolution": "viscofric.motion.cycle_solution",
    "solve_cycle": "viscofric.motion.cycle",
    "History": "viscofric.motion.history",
    "read_history": "viscofric.motion.history_files",
    "ImpactContact": "viscofric.motion.impact_solution",
    "ImpactSolution": "viscofric.motion.impact_solution",
    "RestitutionCurve": "viscofric.motion.impact_solution",
    "restitution_curve": "viscofric.motion.impact",
    "solve_impact": "viscofric.motion.impact",
    "TransientErrors": "viscofric.motion.solution",
    "TransientSolution": "viscofric.motion.solution",
    "solve_transient": "viscofric.motion.solve",
    "Isotherm": "viscofric.data",
    "IsothermalSweeps": "viscofric.data",
    "MasterCurve": "viscofric.data",
    "StepMasterCurve": "viscofric.step_tests",
    "StepTest": "viscofric.step_tests",
    "StepTests": "viscofric.step_tests",
    "TemperatureRamp": "viscofric.ramps",
    "TemperatureRamps": "viscofric.ramps",
    "AmplitudeSweep": "viscofric.amplitudes",
    "TractionRuns": "viscofric.traction",
    "ConvergenceError": "viscofric.errors",
    "DataFileError": "viscofric.errors",
    "InputError": "viscofric.errors",
    "StudyError": "viscofric.errors",
    "LiquidError": "viscofric.errors",
    "SuperpositionError": "viscofric.errors",
    "ViscofricError": "viscofric.errors",
    "Agreement": "viscofric.friction.agreement",
    "compare": "viscofric.friction.agreement",
    "ContactAtStrain": "viscofric.friction.contact_strain",
    "solve_at_contact_strain": "viscofric.friction.contact_strain",
    "read_friction_curves": "viscofric.friction.curve_files",
    "write_friction_curves": "viscofric.friction.curve_files",
    "AssumptionCheck": "viscofric.friction.assumption_check",
    "check_assumptions": "viscofric.friction.assumptions",
    "FrictionCurves": "viscofric.friction.curves",
    "ThermalProperties": "viscofric.thermal",
    "Heating": "viscofric.heat.heating",
    "ContactHeating": "viscofric.heat.result",
    "TransientHeating": "viscofric.heat.result",
    "HeatedFrictionCurves": "viscofric.friction.heating",
    "HeatedRoughFriction": "viscofric.roughness.rough_friction",
    "HeatedPerssonTheory": "viscofric.roughness.persson_result",
    "MovingHeatSource": "viscofric.heat.sources",
    "surface_temperature": "viscofric.heat.maps",
    "track_temperature": "viscofric.heat.track",
    "ContactAnchor": "viscofric.friction.identification.anchors",
    "ModulusAnchor": "viscofric.friction.identification.anchors",
    "Citations": "viscofric.literature.citations",
    "citations": "viscofric.literature.citations",
    "Identified": "viscofric.friction.identification.identified",
    "identify_material": "viscofric.friction.identification.identify",
    "IdentifiedMaterial": "viscofric.friction.identification.result",
    "identify_from_indentation": "viscofric.friction.identification.indentation.identify",
    "IndentationRecord": "viscofric.friction.identification.indentation.record",
    "read_indentation": "viscofric.friction.identification.indentation.record",
    "OscillationRecord": "viscofric.friction.identification.indentation.tables",
    "ReboundRecord": "viscofric.friction.identification.indentation.tables",
    "read_oscillation": "viscofric.friction.identification.indentation.reading",
    "read_rebound": "viscofric.friction.identification.indentation.reading",
    "FittedRecord": "viscofric.friction.identification.indentation.result",
    "MaterialFromIndentation": "viscofric.friction.identification.indentation.result",
    "ShearStress": "viscofric.friction.interface.shear_stress",
    "shear_stress": "viscofric.friction.interface.shear_stress",
    "predict_friction": "viscofric.friction.prediction",
    "FrictionMasterCurve": "viscofric.friction.shifting.master_curve",
    "shift_friction": "viscofric.friction.shifting.shift",
    "ShiftAgreement": "viscofric.friction.shifting.shift_agreement",
    "compare_shift_factors": "viscofric.friction.shifting.shift_agreement",
    "separate": "viscofric.friction.measurement.tribometry",
    "read_dma": "viscofric.readers",
    "read_mtm": "viscofric.readers",
    "read_step_tests": "viscofric.readers",
    "read_master_curve": "viscofric.readers.dma.master_curves",
    "read_ramps": "viscofric.readers.dma.ramps",
    "read_amplitude_sweep": "viscofric.readers.dma.amplitudes",
    "Card": "viscofric.rheology.cards",
    "open_card": "viscofric.rheology.cards",
    "read_card": "viscofric.rheology.cards",
    "write_card": "viscofric.rheology.cards",
    "catalogue": "viscofric.rheology.catalogue",
    "catalogue_material": "viscofric.rheology.catalogue",
    "CatalogueEntry": "viscofric.rheology.catalogue",
    "synthetic_fluoroelastomer": "viscofric.rheology.catalogue",
    "ConstantShearStress": "viscofric.rheology.interface.laws",
    "EyringShearStress": "viscofric.rheology.interface.laws",
    "GaussianShearStress": "viscofric.rheology.interface.laws",
    "InterfaceLaw": "viscofric.rheology.interface.law",
    "PowerShearStress": "viscofric.rheology.interface.laws",
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
    "check_superposition": "viscofric.rheology.superposition.result",
    "SuperpositionCheck": "viscofric.rheology.superposition.consistency",
    "OverlapQuality": "viscofric.rheology.superposition.overlap",
    "superpose": "viscofric.rheology.superposition.superpose",
    "Superposition": "viscofric.rheology.superposition.result",
    "JointSuperposition": "viscofric.rheology.superposition.joint",
    "StepCheck": "viscofric.rheology.superposition.step_result",
    "StepSuperposition": "viscofric.rheology.superposition.step_result",
    "GlassTransition": "viscofric.rheology.ramps.glass_transition",
    "glass_transition": "viscofric.rheology.ramps.glass_transition",
    "RampCheck": "viscofric.rheology.ramps.result",
    "RampSuperposition": "viscofric.rheology.ramps.result",
    "superpose_ramps": "viscofric.rheology.ramps.superpose",
    "KrausLaw": "viscofric.rheology.payne.kraus",
    "LinearRange": "viscofric.rheology.payne.kraus_fit",
    "PayneFit": "viscofric.rheology.payne.kraus_fit",
    "fit_kraus": "viscofric.rheology.payne.kraus_fit",
    "material_at_strain": "viscofric.rheology.payne.at_strain",
    "contact_strain": "viscofric.rheology.payne.at_strain",
    "MaterialSamples": "viscofric.rheology.uncertainty.material_samples",
    "sample_materials": "viscofric.rheology.uncertainty.sampling",
    "RoughFriction": "viscofric.roughness.rough_friction",
    "predict_rough_friction": "viscofric.roughness.ensemble",
    "self_affine": "viscofric.roughness.made",
    "surface_from_spectrum": "viscofric.roughness.made",
    "line_spectrum": "viscofric.roughness.measured_spectrum",
    "power_spectrum": "viscofric.roughness.measured_spectrum",
    "ContactStatistics": "viscofric.roughness.patches",
    "contact_statistics": "viscofric.roughness.patches",
    "pressure_distribution": "viscofric.roughness.patches",
    "PerssonTheory": "viscofric.roughness.persson_result",
    "persson_theory": "viscofric.roughness.persson",
    "read_topography": "viscofric.roughness.reading",
    "FrictionByWavelength": "viscofric.roughness.scales",
    "friction_by_wavelength": "viscofric.roughness.scales",
    "LineSpectrum": "viscofric.roughness.measured_spectrum",
    "PowerSpectrum": "viscofric.roughness.spectrum",
    "Topography": "viscofric.roughness.topography",
    "TractionStep": "viscofric.traction",
    "compare_results": "viscofric.study",
    "load_study": "viscofric.study",
    "open_results": "viscofric.study",
    "ResultsComparison": "viscofric.study",
    "run_study": "viscofric.study",
    "Study": "viscofric.study",
    "StudyResults": "viscofric.study",
}

__all__ = ["__version__", *_HOME]  # noqa: PLE0604

_fetched = loaded_when_used(__name__, _HOME)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        globals()[name] = version("viscofric")  # which reads files each time
        return globals()[name]
    return _fetched(name)


def __dir__() -> list[str]:
    return sorted(__all__)
