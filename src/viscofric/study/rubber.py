"""A material model of a study with everything it was made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viscofric.data import IsothermalSweeps, MasterCurve
from viscofric.errors import StudyError
from viscofric.notes import Note
from viscofric.rheology.material import Material, known_at
from viscofric.rheology.payne.kraus_fit import PayneFit
from viscofric.rheology.ramps.result import RampSuperposition
from viscofric.rheology.shifts.law_comparison import LawComparison
from viscofric.rheology.shifts.laws import ParametricLaw
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.superposition.joint import JointSuperposition
from viscofric.rheology.superposition.result import StepSuperposition, Superposition
from viscofric.step_tests import StepMasterCurve, StepTests


@dataclass(frozen=True, eq=False)
class Rubber:
    """A material with everything it was made from."""

    material: Material  # with a shift, about the reference temperature
    source: str = ""  # origin of a predefined material
    synthetic: bool = False  # whether the catalogue, or a file that it is made of, calls it synthetic
    sweeps: IsothermalSweeps | None = None  # sweeps, fit: None for a predefined material
    fit: Superposition | None = None
    #: step_tests, step_fit: Creep or relaxation tests, instead of sweeps or together with them
    step_tests: StepTests | None = None
    step_fit: StepSuperposition | None = None
    step_curve: StepMasterCurve | None = None  # their master curve, or the only one of them
    joint: JointSuperposition | None = None  # of sweeps and step tests together; `fit` and `step_fit` are its parts
    master_curve: MasterCurve | None = None  # given instead of sweeps, or made of ramps
    ramps: RampSuperposition | None = None  # of temperature ramps, given instead of sweeps
    laws: LawComparison[ParametricLaw] | None = None  # shift laws fitted to the measured shift factors
    shift_used: str = ""  # ``"measured"``, or the name of the law in use
    #: Shift factors found from the sweeps, read from a file, or found with some held fixed
    shift_origin: str = "found"
    payne: PayneFit | None = None  # of an amplitude sweep
    strain: float | None = None  # tensile strain that the moduli were scaled to by it, a fraction
    linear: Material | None = None  # the material at small strain then, as it was fitted
    notes: tuple[str, ...] = ()  # warnings, changes and omissions, one sentence each

    @property
    def law(self) -> ParametricLaw | None:
        """The law in use, else the one that describes the measured shift factors best, if any."""
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
        if self.strain is not None:
            said["tensile_strain"] = self.strain
        if self.material.citation:
            said["citation"] = self.material.citation
        if self.material.reference is not None:
            said["reference_temperature"] = self.material.reference
        return said


def rubber_at(rubber: Rubber, temperatures: Sequence[float]) -> Rubber:
    """Return a material for contacts at temperatures, K, with notes on what is assumed of it.

    Raises `StudyError` if it has no spectrum, and `InputError` if it is not known at one of the temperatures.
    """
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
    known, kelvins, assumed = known_at(material, np.array(temperatures, dtype=float))
    if known.shift is not None:
        known.shift(kelvins)
    return replace(rubber, material=known, notes=(*rubber.notes, *assumed)) if assumed else rubber
