"""The papers behind results, with the reasons: `citations`."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from importlib.metadata import version
from itertools import chain
from typing import Any, TypeAlias

from viscofric.contact.bodies import Layer
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.solution import ContactSolution
from viscofric.datasets import DataTree
from viscofric.errors import InputError
from viscofric.files import parse_toml
from viscofric.friction.curves import FrictionCurves, is_predicted
from viscofric.friction.identification.indentation.result import MaterialFromIndentation
from viscofric.friction.identification.result import IdentifiedMaterial
from viscofric.friction.interface_stress import ShearStress
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
from viscofric.rheology.superposition.result import StepSuperposition, Superposition
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.roughness.measured_spectrum import LineSpectrum
from viscofric.roughness.patches import ContactStatistics
from viscofric.roughness.persson import PerssonTheory
from viscofric.roughness.rough_friction import RoughFriction
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.showing import Rows, Shown
from viscofric.study.results.results import StudyResults

Basis: TypeAlias = Iterator[tuple[Reference, str]]
#: A reason, and the keys of its references.
Cited: TypeAlias = tuple[str, ...]

_LAWS: tuple[type[ParametricLaw], ...] = (WLF, Arrhenius, VFT, WLFArrhenius, InversePolynomial)
_PAPER = PAPER.key

_MODES = ("the rubber as a sum of retardation modes (Eqs. 3 and 5)", _PAPER)
_SHIFTED = ("time-temperature superposition (Eq. 4)", _PAPER)
_COMMON_CURVES = (
    ("shift factors and common curves sought together", "golub1973"),
    ("how smooth the common curves are", "wood2011"),
)
_SUPERPOSED_STEPS = (_SHIFTED, *_COMMON_CURVES)
_SUPERPOSED_SWEEPS = (*_SUPERPOSED_STEPS, ("check of the superposition", "vangurp1998"))
_COMPARED_LAWS = (("choice of the law", "akaike1974"),)
_ADJOINT = ("derivatives of friction by an adjoint solve", "giles2000")
_UNCERTAINTY = ("uncertainty of what was identified", "chen2012", "bardsley2014")
_IDENTIFICATION = (_ADJOINT, _UNCERTAINTY)
_FROM_INDENTATION = (("modulus from growing contacts", "lee1960"), _UNCERTAINTY)
_BOOTSTRAP = ("uncertainty of the rubber", "efron1993")
_BANDED_FRICTION = (_BOOTSTRAP, _ADJOINT)
_SEPARATED_FRICTION = (("separation of viscoelastic from Coulomb friction (Eq. 9)", _PAPER),)
_ONE_CURVE = (("one friction curve for all temperatures (Eq. 10)", _PAPER),)
_LAYER = (("the layer", "carbone2008", "putignano2015", "johnson1985"),)
_CORRECTED_AREA = ("the corrected contact area", "yastrebov2017")
_POWER_SPECTRA = (("power spectra of surfaces", "persson2005", "jacobs2017"),)
_SOLVED_SURFACE = (
    ("the contact problem, here in Fourier space", _PAPER),
    ("operator splitting and its acceleration", "lions1979", "anderson1965"),
    ("the linear solver", "eisenstat1983"),
)


def basis(result: object) -> Basis:
    """Yield the references of a result, each with the reason."""
    found = next((rule for kind, rule in _RULES.items() if isinstance(result, kind)), None)
    if found is None:
        raise InputError(
            f"citations() has no references for a {type(result).__name__}; give a material, a contact, friction "
            "curves, a master curve, Persson's theory or results of a study.",
            code="no-references",
        )
    for one in found(result):
        if isinstance(one[0], Reference):
            yield one
        else:
            reason, *keys = one
            yield from ((REFERENCES[key], reason) for key in keys)


def _of_material(rubber: Material) -> Iterator[Any]:
    yield from basis(rubber.spectrum)
    if rubber.has_shift_factors:
        yield from basis(rubber.shift)
    if rubber.citation:
        key = re.sub(r"\W+", "_", rubber.name.lower()).strip("_") or "rubber"
        yield Reference(key, note=rubber.citation), f"data of the rubber {rubber.name}".rstrip()


def _modes(method: str = "") -> Iterator[Cited]:
    """Yield the references of a retardation spectrum, given or fitted by a method of `fit_retardation_spectrum`."""
    yield _MODES
    if method in _INVERSE:
        yield from _INVERSE[method]
    elif method:
        yield "non-negative least squares", "lawson1974"
    if method == "regularised":
        yield "how smooth the spectrum is", "hansen1993"


#: What a spectrum was identified from -> the references.
_INVERSE = {FROM_FRICTION: _IDENTIFICATION, FROM_INDENTATION: _FROM_INDENTATION}


def _method(spectrum: object) -> str:
    fit = spectrum.fit if isinstance(spectrum, RetardationSpectrum) else None
    return "" if fit is None else fit.method


def _shifted_by(law: type[ShiftLaw]) -> Iterator[Cited]:
    """Yield the references of shift factors of a kind."""
    yield _SHIFTED
    if issubclass(law, (WLF, WLFArrhenius)):
        yield "law of the shift factors", "williams1955"
    elif issubclass(law, VFT):
        yield "law of the shift factors", "vogel1921", "fulcher1925", "tammann1926"


def _superposed_ramps(*, assumed: bool) -> Iterator[Cited]:
    """Yield the references of the superposition of temperature ramps."""
    if not assumed:
        yield "constants of the law and common curves sought together", "golub1973"
        yield _COMMON_CURVES[1]


def _solved_contact(*, line: bool) -> Iterator[Cited]:
    """Yield the references of a solved contact of a single indenter."""
    yield "the contact problem and its Green's function (Eq. 8)", _PAPER
    yield "the method of boundary elements for steady viscoelastic contact", "carbone2013"
    if not line:
        yield "displacement under a loaded rectangle", "love1929"
    yield "the elastic limits", "hertz1882", "johnson1985"
    if line:
        yield "the exact solution that line contacts are held against", "hunter1961"
    yield "the linear solver", "eisenstat1983"


def _of_persson(theory: PerssonTheory) -> Iterator[Cited]:
    yield "theory of contact area and friction", "persson2001"
    yield "the factor S for partial contact", "lorenz2015"
    if theory.flash_temperature.any():
        yield "flash temperature", "persson2006"


def _of_curves(curves: FrictionCurves) -> Iterator[Cited]:
    if is_predicted(curves):
        yield from _solved_contact(line=curves.load_unit == "N/m")
    elif curves.coulomb is not None:
        yield from _SEPARATED_FRICTION
    if curves.material_error is not None:
        yield from _BANDED_FRICTION


def _of_interface(law: InterfaceLaw) -> Iterator[Cited]:
    key = {"eyring": "eyring1936", "gaussian": "lorenz2015"}.get(law.kind)
    if key is not None:
        yield "law of the interface's shear stress", key


def _shifted_friction(*, found: bool) -> Iterator[Cited]:
    """Yield the references of a friction master curve, with given or found shift factors."""
    yield from _ONE_CURVE
    yield "the smooth curve through the points", "cleveland1979"
    if found:
        yield "shift factors and the common curve sought together", "golub1973"


def _of_identified(found: IdentifiedMaterial) -> Iterator[Cited]:
    yield "shift factors and modulus from friction (section 4.2)", _PAPER
    yield from _solved_contact(line=found.friction.load_unit == "N/m")
    yield from _IDENTIFICATION


def _of_study(results: StudyResults) -> Iterator[Any]:
    tables = parse_toml(str(results.tree.attrs.get("study_text", "")))
    given = tables.get("material", {})
    rubbers = given if isinstance(given, list) else [given]
    for rubber, found in zip(rubbers, results.materials.values(), strict=True):
        yield from _study_rubber(rubber, found)
    if "indenter" in tables:
        yield from _solved_contact(line=tables["indenter"].get("shape") == "cylinder")
    if "surface" in tables:
        yield from _SOLVED_SURFACE
    if "layer" in tables:
        yield from _LAYER
    yield from _study_friction(results.tree)


def _study_rubber(table: dict[str, Any], found: DataTree) -> Iterator[Any]:
    if "catalogue" in table:
        yield from basis(catalogue_material(table["catalogue"]))
        return
    steps = "step_master_curve" in found.children
    if "superposition" in found.children:
        yield from _SUPERPOSED_STEPS if steps else _SUPERPOSED_SWEEPS
    ramps = "ramps" in found.children
    if ramps:
        yield from _superposed_ramps(assumed="assumed_shift" in table)
    fitted = steps or "master_curve" in found.children
    yield from _modes(table.get("spectrum", "non-negative") if fitted else "")
    if "shift_law" in found.children and (ramps or table.get("shift", "measured") != "measured"):
        used = found["shift_law"].attrs["law"]
        yield from _shifted_by(next(law for law in _LAWS if law.title == used))
    if table.get("shift") == "best":
        yield from _COMPARED_LAWS


def _study_friction(tree: DataTree) -> Iterator[Any]:
    groups = tree.children
    if "prediction" in groups and "friction_lower" in groups["prediction"].data_vars:
        yield from _BANDED_FRICTION
    if "measurement" in groups and "coulomb" in groups["measurement"].data_vars:
        yield from _SEPARATED_FRICTION
    if "measurement_master" in groups:
        yield from _shifted_friction(found="friction_shift_factors" in groups)
    elif "prediction_master" in groups:
        yield from _ONE_CURVE


#: Kind of a result -> its references, as they are or with those of its parts; the first kind that fits counts.
_RULES: dict[type, Callable[[Any], Iterable[Any]]] = {
    Material: _of_material,
    RetardationSpectrum: lambda spectrum: _modes(_method(spectrum)),
    RelaxationSpectrum: lambda _: (("relaxation out of retardation, and back", "park1999"),),
    ModulusTable: lambda _: (("interpolation of the moduli", "fritsch1984"),),
    KrausLaw: lambda _: (("dependence of the moduli on the strain amplitude", "kraus1984"),),
    PayneFit: lambda fit: basis(fit.law),
    ShiftLaw: lambda shift: _shifted_by(type(shift)),
    LawComparison: lambda laws: (*basis(laws.best), *_COMPARED_LAWS),
    RampSuperposition: lambda fit: (*basis(fit.shift), *_superposed_ramps(assumed=bool(fit.assumption))),
    Superposition: lambda _: _SUPERPOSED_SWEEPS,
    StepSuperposition: lambda _: _SUPERPOSED_STEPS,
    JointSuperposition: lambda fit: chain.from_iterable(map(basis, fit.parts)),
    MaterialSamples: lambda samples: _INVERSE.get(_method(samples.materials[0].spectrum), (_BOOTSTRAP,)),
    Layer: lambda _: _LAYER,
    ContactSolution: lambda contact: (
        *_solved_contact(line=contact.geometry == "line"),
        *([] if contact.derivatives is None else [_ADJOINT]),
    ),
    PeriodicSolution: lambda _: _SOLVED_SURFACE,
    RoughFriction: lambda _: (*_SOLVED_SURFACE, _CORRECTED_AREA),
    ContactStatistics: lambda _: (_CORRECTED_AREA,),
    PowerSpectrum: lambda _: _POWER_SPECTRA,
    LineSpectrum: lambda _: _POWER_SPECTRA,
    PerssonTheory: _of_persson,
    FrictionCurves: _of_curves,
    ShearStress: lambda stress: (*_SEPARATED_FRICTION, *_solved_contact(line=stress.curves.load_unit == "N/m")),
    InterfaceLaw: _of_interface,
    FrictionMasterCurve: lambda master: (
        *basis(master.curves),
        *basis(master.shift),
        *_shifted_friction(found=master.found),
    ),
    IdentifiedMaterial: _of_identified,
    MaterialFromIndentation: lambda found: (
        _MODES,
        *_FROM_INDENTATION,
        *(_SUPERPOSED_STEPS if found.shift_found else ()),
    ),
    StudyResults: _of_study,
}


_WIDTH = 118


@dataclass(frozen=True)
class Citation:
    """A reference, and the reasons to cite it."""

    reference: Reference
    reasons: tuple[str, ...]  # the parts of the result that use it, a few words each

    def __str__(self) -> str:
        return f"{str(self.reference).removesuffix('.')}. Cited for: {'; '.join(self.reasons)}."


@dataclass(frozen=True)
class Citations(Shown):
    """References of results, the software first; printed as a list, or as BibTeX.

    Attributes
    ----------
    entries : tuple of Citation
        Each reference once, in the order of the work.
    """

    entries: tuple[Citation, ...]

    def __len__(self) -> int:
        return len(self.entries)

    def _shown(self) -> Rows:
        return (("references", ", ".join(self.keys)),)

    def __iter__(self) -> Iterator[Citation]:
        return iter(self.entries)

    def __str__(self) -> str:
        return "\n".join(
            textwrap.fill(
                f"[{number}] {entry}", _WIDTH, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False
            )
            for number, entry in enumerate(self.entries, 1)
        )

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the BibTeX entries, in their order."""
        return tuple(entry.reference.key for entry in self.entries)

    def bibtex(self) -> str:
        """Return all BibTeX entries, in UTF-8, one below the other."""
        return "\n\n".join(entry.reference.bibtex() for entry in self.entries) + "\n"


def citations(*results: object) -> Citations:
    """Return the papers behind results: methods, laws and data, each with the reason to cite it.

    Parameters
    ----------
    *results : Material, Superposition, ContactSolution, FrictionCurves, StudyResults and others
        One or several: a material, its spectrum, shifts, laws and samples; a `Layer`; solutions of contacts, friction
        curves and master curves; an identified material; surfaces' spectra, Persson's theory and friction on rough
        surfaces; results of a study, which contain all of these.

    Returns
    -------
    Citations
        Readable when printed; `bibtex()` for a bibliography.

    Raises
    ------
    InputError
        If nothing is given, or something that is not a result.

    Notes
    -----
    A contact does not contain its material, nor do friction curves contain the fit of theirs: give these, too, as in
    the example.  Titles and DOIs that could not be confirmed are left out of the references.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> solution = vf.solve_steady(
    ...     rubber, vf.Cylinder("10 mm"), speed="1 m/s", load="1 N/mm", temperature="30 degC", accuracy=1e-2
    ... )
    >>> cited = vf.citations(solution, rubber)
    >>> print(cited.entries[-1].reference)
    M. L. Williams, R. F. Landel, J. D. Ferry, “The temperature dependence of relaxation mechanisms in amorphous \
polymers and other glass-forming liquids”, J. Am. Chem. Soc. 77 (1955) 3701–3707, doi:10.1021/ja01619a008
    >>> "hunter1961" in cited.keys
    True
    """
    if not results:
        raise InputError(
            "citations() needs a result: a material, a contact, friction curves, results of a study …", code="no-result"
        )
    reasons: dict[Reference, list[str]] = {_software(): ["what everything here was computed with"]}
    for result in results:
        for reference, reason in basis(result):
            known = reasons.setdefault(reference, [])
            if reason not in known:
                known.append(reason)
    return Citations(tuple(Citation(reference, tuple(known)) for reference, known in reasons.items()))


def _software() -> Reference:
    return Reference("viscofric", ("viscofric developers",), title="viscofric", note=f"version {version('viscofric')}")
