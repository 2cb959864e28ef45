"""A material model of a study with everything it was made from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.errors import StudyError
from viscofric.notes import Note
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from viscofric.data import IsothermalSweeps, MasterCurve
    from viscofric.rheology.material import Material
    from viscofric.rheology.payne.kraus_fit import PayneFit
    from viscofric.rheology.ramps.result import RampSuperposition
    from viscofric.rheology.shifts.law_comparison import LawComparison
    from viscofric.rheology.shifts.laws import ParametricLaw, ShiftLaw
    from viscofric.rheology.superposition.joint import JointSuperposition
    from viscofric.rheology.superposition.result import Superposition
    from viscofric.rheology.superposition.step_result import StepSuperposition
    from viscofric.step_tests import StepTests


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
    payne : PayneFit or None
        Of an amplitude sweep.
    strain : float or None
        Tensile strain that the moduli were scaled to by it, a fraction.
    linear : Material or None
        The material at small strain then, as it was fitted.
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
    laws: LawComparison[ParametricLaw] | None = None
    shift_used: str = ""
    shift_origin: str = "found"
    payne: PayneFit | None = None
    strain: float | None = None
    linear: Material | None = None
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
        if self.strain is not None:
            said["tensile_strain"] = self.strain
        if self.material.citation:
            said["citation"] = self.material.citation
        if self.material.reference is not None:
            said["reference_temperature"] = self.material.reference
        return said


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
