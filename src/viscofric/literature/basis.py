"""The references of each kind of result, with the reasons."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import singledispatch
from typing import TYPE_CHECKING, Any, TypeAlias

from viscofric.contact.bodies import Layer
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.solution import ContactSolution
from viscofric.errors import InputError
from viscofric.files import parse_toml
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.identification.indentation.result import MaterialFromIndentation
from viscofric.friction.identification.result import IdentifiedMaterial
from viscofric.friction.interface.shear_stress import ShearStress
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.literature.references import PAPER, REFERENCES, Reference
from viscofric.rheology.catalogue import catalogue_material
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.material import Material
from viscofric.rheology.payne.kraus import KrausLaw
from viscofric.rheology.payne.kraus_fit import PayneFit
from viscofric.rheology.ramps.result import RampSuperposition
from viscofric.rheology.shifts.law_comparison import LawComparison
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, ParametricLaw, ShiftLaw, WLFArrhenius
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.quality import FROM_FRICTION, FROM_INDENTATION
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.rheology.superposition.joint import JointSuperposition
from viscofric.rheology.superposition.result import Superposition
from viscofric.rheology.superposition.step_result import StepSuperposition
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.roughness.measured_spectrum import LineSpectrum
from viscofric.roughness.patches import ContactStatistics
from viscofric.roughness.persson_result import PerssonTheory
from viscofric.roughness.rough_friction import RoughFriction
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.study.results.results import StudyResults

if TYPE_CHECKING:
    import xarray

Basis: TypeAlias = Iterator[tuple[Reference, str]]

_LAWS: tuple[type[ParametricLaw], ...] = (WLF, Arrhenius, VFT, WLFArrhenius, InversePolynomial)


@singledispatch
def basis(result: object) -> Basis:
    """Yield the references of a result, each with the reason."""
    raise InputError(
        f"citations() has no references for a {type(result).__name__}; give a material, a contact, friction "
        "curves, a master curve, Persson's theory or results of a study.",
        code="no-references",
    )


def _for(reason: str, *keys: str) -> Basis:
    for key in keys:
        yield REFERENCES[key], reason


#: Kinds of results with the same references whatever they hold: the reason and the keys.
_ALWAYS: dict[type, tuple[str, ...]] = {
    RelaxationSpectrum: ("relaxation out of retardation, and back", "park1999"),
    ModulusTable: ("interpolation of the moduli", "fritsch1984"),
    KrausLaw: ("dependence of the moduli on the strain amplitude", "kraus1984"),
    Layer: ("the layer", "carbone2008", "putignano2015", "johnson1985"),
    ContactStatistics: ("the corrected contact area", "yastrebov2017"),
    PowerSpectrum: ("power spectra of surfaces", "persson2005", "jacobs2017"),
    LineSpectrum: ("power spectra of surfaces", "persson2005", "jacobs2017"),
}


def _of_kind(result: object) -> Basis:
    yield from next(_for(*found) for kind, found in _ALWAYS.items() if isinstance(result, kind))


for _kind in _ALWAYS:
    basis.register(_kind, _of_kind)


@basis.register
def _of_material(rubber: Material) -> Basis:
    yield from basis(rubber.spectrum)
    if rubber.shift is not None:
        yield from basis(rubber.shift)
    if rubber.citation:
        key = re.sub(r"\W+", "_", rubber.name.lower()).strip("_") or "rubber"
        yield Reference(key, note=rubber.citation), f"data of the rubber {rubber.name}".rstrip()


@basis.register
def _of_spectrum(spectrum: RetardationSpectrum) -> Basis:
    yield from modes("" if spectrum.fit is None else spectrum.fit.method)


def modes(method: str = "") -> Basis:
    """Yield the references of a retardation spectrum, given or fitted by a method of `fit_retardation_spectrum`."""
    yield PAPER, "the rubber as a sum of retardation modes (Eqs. 3 and 5)"
    if method == FROM_FRICTION:
        yield from _identification()
    elif method == FROM_INDENTATION:
        yield from _from_indentation()
    elif method:
        yield from _for("non-negative least squares", "lawson1974")
    if method == "regularised":
        yield from _for("how smooth the spectrum is", "hansen1993")


@basis.register
def _of_shift(shift: ShiftLaw) -> Basis:
    yield from shifted_by(type(shift))


def shifted_by(law: type[ShiftLaw]) -> Basis:
    """Yield the references of shift factors of a kind."""
    yield PAPER, "time-temperature superposition (Eq. 4)"
    if issubclass(law, (WLF, WLFArrhenius)):
        yield from _for("law of the shift factors", "williams1955")
    elif issubclass(law, VFT):
        yield from _for("law of the shift factors", "vogel1921", "fulcher1925", "tammann1926")


@basis.register(LawComparison)
def _of_laws(laws: LawComparison[ParametricLaw]) -> Basis:
    yield from basis(laws.best)
    yield from compared_laws()


def compared_laws() -> Basis:
    """Yield the references of the choice of a shift law."""
    yield from _for("choice of the law", "akaike1974")


@basis.register
def _of_ramps(fit: RampSuperposition) -> Basis:
    yield from basis(fit.shift)
    yield from superposed_ramps(assumed=bool(fit.assumption))


def superposed_ramps(*, assumed: bool) -> Basis:
    """Yield the references of the superposition of temperature ramps."""
    if not assumed:
        yield from _for("constants of the law and common curves sought together", "golub1973")
        yield from _for("how smooth the common curves are", "wood2011")


@basis.register
def _of_payne(fit: PayneFit) -> Basis:
    yield from basis(fit.law)


@basis.register
def _of_superposition(fit: Superposition) -> Basis:
    yield from superposed_sweeps()


@basis.register
def _of_step_superposition(fit: StepSuperposition) -> Basis:
    yield from superposed_steps()


@basis.register
def _of_joint_superposition(fit: JointSuperposition) -> Basis:
    for part in fit.parts:
        yield from basis(part)


def superposed_sweeps() -> Basis:
    """Yield the references of the superposition of sweeps."""
    yield from superposed_steps()
    yield from _for("check of the superposition", "vangurp1998")


def superposed_steps() -> Basis:
    """Yield the references of the superposition of creep or relaxation tests."""
    yield PAPER, "time-temperature superposition (Eq. 4)"
    yield from _for("shift factors and common curves sought together", "golub1973")
    yield from _for("how smooth the common curves are", "wood2011")


@basis.register
def _of_samples(samples: MaterialSamples) -> Basis:
    first = samples.materials[0].spectrum
    method = first.fit.method if isinstance(first, RetardationSpectrum) and first.fit is not None else ""
    if method == FROM_FRICTION:
        yield from _identification()
    elif method == FROM_INDENTATION:
        yield from _from_indentation()
    else:
        yield from _for("uncertainty of the rubber", "efron1993")


@basis.register
def _of_contact(solution: ContactSolution) -> Basis:
    yield from solved_contact(line=solution.geometry == "line")
    if solution.derivatives is not None:
        yield from _adjoint()


def solved_contact(*, line: bool) -> Basis:
    """Yield the references of a solved contact of a single indenter."""
    yield PAPER, "the contact problem and its Green's function (Eq. 8)"
    yield from _for("the method of boundary elements for steady viscoelastic contact", "carbone2013")
    if not line:
        yield from _for("displacement under a loaded rectangle", "love1929")
    yield from _for("the elastic limits", "hertz1882", "johnson1985")
    if line:
        yield from _for("the exact solution that line contacts are held against", "hunter1961")
    yield from _for("the linear solver", "eisenstat1983")


def _adjoint() -> Basis:
    yield from _for("derivatives of friction by an adjoint solve", "giles2000")


@basis.register
def _of_periodic(solution: PeriodicSolution) -> Basis:
    yield from solved_surface()


def solved_surface() -> Basis:
    """Yield the references of a solved contact of a periodic surface."""
    yield PAPER, "the contact problem, here in Fourier space"
    yield from _for("operator splitting and its acceleration", "lions1979", "anderson1965")
    yield from _for("the linear solver", "eisenstat1983")


@basis.register
def _of_rough_friction(friction: RoughFriction) -> Basis:
    yield from solved_surface()
    yield from _for(*_ALWAYS[ContactStatistics])


@basis.register
def _of_persson(theory: PerssonTheory) -> Basis:
    yield from _for("theory of contact area and friction", "persson2001")
    yield from _for("the factor S for partial contact", "lorenz2015")
    if theory.flash_temperature.any():
        yield from _for("flash temperature", "persson2006")


@basis.register
def _of_curves(curves: FrictionCurves) -> Basis:
    if curves.source == "predicted":
        yield from solved_contact(line=curves.load_unit == "N/m")
    elif curves.coulomb is not None:
        yield from separated_friction()
    if curves.material_error is not None:
        yield from banded_friction()


def separated_friction() -> Basis:
    """Yield the references of viscoelastic friction separated from Coulomb friction."""
    yield PAPER, "separation of viscoelastic from Coulomb friction (Eq. 9)"


def banded_friction() -> Basis:
    """Yield the references of the uncertainty band of predicted friction."""
    yield from _for("uncertainty of the rubber", "efron1993")
    yield from _adjoint()


@basis.register
def _of_shear_stress(stress: ShearStress) -> Basis:
    yield from separated_friction()
    yield from solved_contact(line=stress.curves.load_unit == "N/m")


@basis.register
def _of_interface(law: InterfaceLaw) -> Basis:
    if law.kind == "eyring":
        yield from _for("law of the interface's shear stress", "eyring1936")
    elif law.kind == "gaussian":
        yield from _for("law of the interface's shear stress", "lorenz2015")


@basis.register
def _of_master(master: FrictionMasterCurve) -> Basis:
    yield from basis(master.curves)
    yield from basis(master.shift)
    yield from shifted_friction(found=master.found)


def shifted_friction(*, found: bool) -> Basis:
    """Yield the references of a friction master curve, with given or found shift factors."""
    yield from one_curve()
    yield from _for("the smooth curve through the points", "cleveland1979")
    if found:
        yield from _for("shift factors and the common curve sought together", "golub1973")


def one_curve() -> Basis:
    """Yield the references of one friction curve for all temperatures."""
    yield PAPER, "one friction curve for all temperatures (Eq. 10)"


@basis.register
def _of_identified(found: IdentifiedMaterial) -> Basis:
    yield PAPER, "shift factors and modulus from friction (section 4.2)"
    yield from solved_contact(line=found.friction.load_unit == "N/m")
    yield from _identification()


def _identification() -> Basis:
    yield from _adjoint()
    yield from _uncertainty()


def _uncertainty() -> Basis:
    yield from _for("uncertainty of what was identified", "chen2012", "bardsley2014")


@basis.register
def _of_indentation(found: MaterialFromIndentation) -> Basis:
    yield PAPER, "the rubber as a sum of retardation modes (Eqs. 3 and 5)"
    yield from _from_indentation()
    if found.shift_found:
        yield from superposed_steps()


def _from_indentation() -> Basis:
    yield from _for("modulus from growing contacts", "lee1960")
    yield from _uncertainty()


@basis.register
def _of_study(results: StudyResults) -> Basis:
    tables = parse_toml(str(results.tree.attrs.get("study_text", "")))
    given = tables.get("material", {})
    rubbers = given if isinstance(given, list) else [given]
    for rubber, found in zip(rubbers, results.materials.values(), strict=True):
        yield from _study_rubber(rubber, found)
    if "indenter" in tables:
        yield from solved_contact(line=tables["indenter"].get("shape") == "cylinder")
    if "surface" in tables:
        yield from solved_surface()
    if "layer" in tables:
        yield from basis(Layer(1.0))
    yield from _study_friction(results.tree)


def _study_rubber(table: dict[str, Any], found: xarray.DataTree) -> Basis:
    if "catalogue" in table:
        yield from basis(catalogue_material(table["catalogue"]))
        return
    steps = "step_master_curve" in found.children
    if "superposition" in found.children:
        yield from superposed_steps() if steps else superposed_sweeps()
    ramps = "ramps" in found.children
    if ramps:
        yield from superposed_ramps(assumed="assumed_shift" in table)
    fitted = steps or "master_curve" in found.children
    yield from modes(table.get("spectrum", "non-negative") if fitted else "")
    if "shift_law" in found.children and (ramps or table.get("shift", "measured") != "measured"):
        used = found["shift_law"].attrs["law"]
        yield from shifted_by(next(law for law in _LAWS if law.title == used))
    if table.get("shift") == "best":
        yield from compared_laws()


def _study_friction(tree: xarray.DataTree) -> Basis:
    groups = tree.children
    if "prediction" in groups and "friction_lower" in groups["prediction"].data_vars:
        yield from banded_friction()
    if "measurement" in groups and "coulomb" in groups["measurement"].data_vars:
        yield from separated_friction()
    if "measurement_master" in groups:
        yield from shifted_friction(found="friction_shift_factors" in groups)
    elif "prediction_master" in groups:
        yield from one_curve()
