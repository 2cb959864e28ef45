"""Predefined materials: published parameters with their source, and two synthetic rubbers."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import wrong_argument
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF, WLFArrhenius
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.showing import Rows, Shown

#: The half-Gaussians end this many standard deviations from their centres, where their compliance is negligible.
WIDTH = 4.5


@dataclass(frozen=True)
class CatalogueEntry(Shown):
    """One material of the catalogue.

    Parameters
    ----------
    name : str
        As `catalogue_material` takes it.
    kind : {"published", "SYNTHETIC"}
        Whether the numbers stand in a publication, or were made up for tests and examples.
    holds : str
        What is known of it: kind of spectrum, number of modes, shift.
    citation : str
        Where the numbers come from; for a synthetic material, what it is.
    remarks : str
        In which deformation, at which temperature and over which times it was measured.
    make : callable
        Returns the material.
    """

    name: str
    kind: Literal["published", "SYNTHETIC"]
    holds: str
    citation: str
    remarks: str
    make: Callable[[], Material]

    def _shown(self) -> Rows:
        return (
            ("name", self.name),
            ("kind", self.kind),
            ("holds", self.holds),
        )


def catalogue() -> tuple[CatalogueEntry, ...]:
    """Return the entries of the catalogue: what there is, where it comes from, and how far it holds.

    Returns
    -------
    tuple of CatalogueEntry

    Examples
    --------
    >>> import viscofric as vf
    >>> [entry.name for entry in vf.catalogue() if entry.kind == "SYNTHETIC"][:1]
    ['synthetic fluoroelastomer']
    """
    return _ENTRIES


def catalogue_entry(name: str) -> CatalogueEntry:
    """Return an entry of `catalogue()`; capitals, hyphens and underscores do not matter."""
    known = {_plain(entry.name): entry for entry in _ENTRIES}
    entry = known.get(_plain(name))
    if entry is None:
        near = difflib.get_close_matches(_plain(name), known, n=1, cutoff=0.5)
        hint = f"did you mean {known[near[0]].name!r}?" if near else "the names are"
        names = "" if near else f" {', '.join(repr(one.name) for one in _ENTRIES)}."
        raise wrong_argument("name", name, f"the catalogue has no such material; {hint}{names}", "unknown-material")
    return entry


def catalogue_material(name: str) -> Material:
    """Return a material of the catalogue.

    Parameters
    ----------
    name : str
        One of the names in `catalogue()`; capitals, hyphens and underscores do not matter.

    Returns
    -------
    Material

    Raises
    ------
    InputError
        If there is none of that name; the sentence names the nearest.

    Examples
    --------
    >>> import viscofric as vf
    >>> vf.catalogue_material("synthetic fluoroelastomer").poisson_ratio
    0.5
    """
    entry = catalogue_entry(name)
    material = entry.make()
    return replace(material, citation=entry.citation) if entry.kind == "published" else material


def is_synthetic(material: Material) -> bool:
    """Whether a material is synthetic, as it says itself or as one of the catalogue that has its name."""
    return material.synthetic or any(
        _plain(entry.name) == _plain(material.name) for entry in _ENTRIES if entry.kind == "SYNTHETIC"
    )


def _plain(name: str) -> str:
    return " ".join(str(name).lower().replace("-", " ").replace("_", " ").split())


def _vhb_4910() -> Material:
    """Return the small-strain limit: equilibrium shear modulus and three Maxwell branches, incompressible (E = 3G)."""
    # The equilibrium is a chain law of Arruda and Boyce (1993, doi:10.1016/0022-5096(93)90013-6): the deviatoric stress
    # is G0 ζ dev(B), ζ = β(z)/(3z), z = λ/λL, with λ = 1 at small strain. β is the inverse Langevin function, in the
    # source's code by the Padé approximation of Cohen (1991), β = z (3 − z²)/(1 − z²), which is kept here. The branches
    # are G_i dev(F A Fᵀ) with dA/dt = (C⁻¹ − A)/τ_i: neo-Hookean, so that G_i and τ_i are those of a linear Maxwell
    # model.
    z = 1.0 / 5.99  # locking stretch λL = 5.99
    equilibrium = 15.36e3 * (3.0 - z**2) / (3.0 * (1.0 - z**2))  # Pa
    shear = np.array([26.06e3, 26.53e3, 10.83e3])  # Pa
    relaxation = RelaxationSpectrum(3.0 * equilibrium, 3.0 * shear, [0.6074, 6.56, 61.25])
    return Material(relaxation.to_retardation(), None, 0.5, "VHB 4910 acrylic elastomer")


def _pvb() -> Material:
    """Return shear relaxation in 11 relative moduli of G0 = 471 MPa, taken as incompressible (E = 3G)."""
    glass = 3.0 * 471e6  # Pa
    share = np.array(
        [0.1606, 0.07877, 0.2912, 0.071155, 0.2688, 0.089568, 0.030183, 0.0076056, 0.0009634, 0.0004059, 0.0006143]
    )
    tau = [3.2557e-11, 4.9491e-9, 7.2427e-8, 9.8635e-6, 2.8059e-3, 0.16441, 2.2648, 35.364, 9367.5, 6.4141e5, 4.1347e7]
    relaxation = RelaxationSpectrum(glass * (1.0 - share.sum()), glass * share, tau)
    shift = WLF(C1=20.7, C2=91.1, reference="20 degC")
    return Material(relaxation.to_retardation(), shift, 0.5, "PVB interlayer (plasticised polyvinyl butyral)")


def synthetic_fluoroelastomer() -> Material:
    """Return a SYNTHETIC rubber that behaves like a fluoroelastomer; it was assumed, not measured.

    At 30 °C its compliance is spread over log10 τ in two half-Gaussian pairs: the glass transition (12 MPa to
    1.5 GPa) and a slow relaxation below the rubber plateau (12 MPa to 3 MPa), which makes the loss modulus
    fall with frequency where friction tests are made.  WLF above Tg = −18 °C (17.44, 51.6 K), Arrhenius
    below it; ν = 0.5.  tan δ peaks at 1.33 near 5e6 rad/s.

    Returns
    -------
    Material
        With E0 = 3 MPa, E_inf = 1.5 GPa, τ in geometric progression of ratio e, reference 30 °C.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> f"{rubber.spectrum.E0 / 1e6:.1f} MPa to {rubber.spectrum.E_inf / 1e9:.1f} GPa"
    '3.0 MPa to 1.5 GPa'
    """
    spectrum = _two_transitions(
        (3e6, 12e6, 1.5e9),
        fast={"centre": -3.85, "long": 0.3, "short": 1.2},
        slow={"centre": 4.5, "long": 0.5, "short": 2.5},
    )
    shift = WLFArrhenius(C1=17.44, C2=51.6, glass_transition="-18 degC", reference="30 degC")
    return Material(spectrum, shift, name="synthetic fluoroelastomer", synthetic=True)


def _synthetic_tread_rubber() -> Material:
    """Return a SYNTHETIC rubber with the loss of a tread compound of high wet grip; it was assumed, not measured."""
    # At 20 °C: a broad glass transition (12 MPa to 1.6 GPa) whose tan δ peaks at 1.1 near 1e6 rad/s, and a very broad
    # relaxation below it (12 MPa to 4 MPa), tan δ of about 0.1, as of a filled rubber at small strain.
    spectrum = _two_transitions(
        (4e6, 12e6, 1.6e9),
        fast={"centre": -3.0, "long": 0.6, "short": 1.3},
        slow={"centre": 0.5, "long": 2.5, "short": 2.5},
    )
    shift = WLFArrhenius(C1=17.44, C2=51.6, glass_transition="-15 degC", reference="20 degC")
    return Material(spectrum, shift, name="synthetic tread rubber", synthetic=True)


def _two_transitions(
    moduli: tuple[float, float, float], fast: dict[str, float], slow: dict[str, float]
) -> RetardationSpectrum:
    """Return half-Gaussian pairs over log10 τ (s), of the moduli of the rubber, between the two, and of the glass."""
    rubber, between, glass = moduli
    ends = [(peak["centre"] - WIDTH * peak["short"], peak["centre"] + WIDTH * peak["long"]) for peak in (fast, slow)]
    first = math.ceil(min(low for low, _ in ends) * math.log(10.0))
    last = math.floor(max(high for _, high in ends) * math.log(10.0))
    tau = np.exp(np.arange(first, last + 1, dtype=float))
    glass_transition = _half_gaussians(np.log10(tau), **fast)
    relaxation = _half_gaussians(np.log10(tau), **slow)
    C = glass_transition * (1 / between - 1 / glass) + relaxation * (1 / rubber - 1 / between)
    return RetardationSpectrum(rubber, glass, C, tau)


def _half_gaussians(log10_tau: Array, centre: float, long: float, short: float) -> Array:
    """Return two half-Gaussians joined at their centre, of total 1 over the given retardation times."""
    away = log10_tau - centre
    weight = np.exp(-0.5 * (away / np.where(away > 0.0, long, short)) ** 2)
    return np.asarray(weight / weight.sum())


_ENTRIES = (
    CatalogueEntry(
        "VHB 4910",
        "published",
        "Prony series, 3 modes; no shift with temperature: valid at one temperature only.",
        "S. Wang, M. Decker, D. L. Henann, S. A. Chester, Modeling of dielectric viscoelastomers with application to "
        "electromechanical instabilities, J. Mech. Phys. Solids (2016); numbers as quoted in the example codes of "
        "SolidMechanicsCoupledTheories (finite viscoelasticity, VE05).",
        "Acrylic elastomer. Shear moduli and relaxation times of a finite-strain model, here at small strain and "
        "incompressible, E = 3G. The equilibrium shear modulus is 15.36 kPa times 1.0191, the small-strain factor of "
        "its chain law (locking stretch 5.99; inverse Langevin function as approximated in the code, 1.0172 without "
        "approximation). Times of 0.6 to 61 s: the loss above about 5 rad/s and below 0.01 rad/s, and the glass "
        "transition, are not included. Valid at the temperature of the tests only.",
        _vhb_4910,
    ),
    CatalogueEntry(
        "PVB interlayer",
        "published",
        "Prony series, 11 modes over 18 decades; WLF about 20 °C.",
        "A. Van Duser, A. Jagota, S. J. Bennison, Analysis of glass/polyvinyl butyral laminates subjected to uniform "
        "pressure, J. Eng. Mech. 125 (1999) 435; relative moduli, times and WLF constants as quoted in public "
        "finite-element scripts for laminated glass.",
        "Plasticised polyvinyl butyral of laminated glass, shear relaxation with G0 = 471 MPa. Taken as "
        "incompressible, E = 3G, which makes the glass some 8 % stiffer than with the published bulk modulus of 2 GPa. "
        "Its long-term modulus, 0.19 MPa, is reached after a year at 20 °C.",
        _pvb,
    ),
    CatalogueEntry(
        "synthetic fluoroelastomer",
        "SYNTHETIC",
        "Retardation spectrum, 37 modes; WLF above and Arrhenius below the glass transition.",
        "Assumed for tests and examples; not a measurement.",
        "A glass transition and a slow relaxation below the rubber plateau, at 30 °C.",
        synthetic_fluoroelastomer,
    ),
    CatalogueEntry(
        "synthetic tread rubber",
        "SYNTHETIC",
        "Retardation spectrum, 52 modes; WLF above and Arrhenius below the glass transition.",
        "Assumed for examples of rough surfaces; not a measurement.",
        "tan δ peaks at 1.1 near 1e6 rad/s at 20 °C, and is about 0.1 up to 10 rad/s: that of a tread compound of high "
        "wet grip at small strain.",
        _synthetic_tread_rubber,
    ),
)
