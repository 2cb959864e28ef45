"""The common part of all material cards: settings, contents, and conversion between shear, bulk and tension."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.notes import Note, Remedy
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.showing import Rows, Shown
from viscofric.units import CELSIUS_ZERO, conversion

#: Unit systems of a card: SI, or tonne, mm, s, N and so MPa, in which density is in t/mm³.
UnitSystem: TypeAlias = Literal["Pa", "MPa"]
_PASCAL = {"Pa": 1.0, "MPa": 1e6}
_DENSITY = {"Pa": 1.0, "MPa": 1e12}  # kg/m³ in one kg/m³ or t/mm³
_ENERGY = {"Pa": 1.0, "MPa": 1e-3}  # J in one J or N mm

#: A temperature without unit below this is in °C: no rubber has a reference of −73 °C, nor of 200 °C.
_KELVIN_FROM = 200.0
#: A card whose absolute zero lies below this is in degrees Fahrenheit, where it is −459.67.
_FAHRENHEIT_BELOW = -400.0


@dataclass(frozen=True)
class Writing:
    """Options for writing a card."""

    poisson_ratio: float | None = None  # where a program cannot take the material's own ν = 0.5
    density: float | None = None  # kg/m³
    temperature_unit: Literal["K", "degC"] = "K"  # of the card's temperatures
    domain: Literal["time", "frequency"] = "time"  # of an Abaqus card
    material_id: int = 1  # number of the material in ANSYS and LS-DYNA
    modulus_unit: UnitSystem = "Pa"  # "Pa": SI; "MPa": tonne, mm, s

    def modulus(self, pascal: float) -> float:
        """Return a modulus in the card's unit."""
        return pascal / _PASCAL[self.modulus_unit]

    def energy(self, joule: float) -> float:
        """Return an energy in the card's unit."""
        return joule / _ENERGY[self.modulus_unit]

    @property
    def written_density(self) -> float | None:
        """Density in the card's unit."""
        return None if self.density is None else self.density / _DENSITY[self.modulus_unit]

    def temperature(self, kelvin: float) -> float:
        """Return a temperature in the card's unit."""
        return kelvin - CELSIUS_ZERO if self.temperature_unit == "degC" else kelvin


#: Units of a card that states none.
_ASSUMED = {"modulus_unit": "Pa", "time_unit": "s"}
#: A glassy modulus below this is that of no solid but the softest gels, Pa; 10 GPa in MPa.
SOFTEST = 1e4


def give_units(names: Iterable[str]) -> Remedy:
    """Return how the units of a card are given: commands, run files and the page read a material file made of it."""
    example = {"modulus_unit": "MPa", "time_unit": "ms"}
    said = ", ".join(f"{name}='{example[name]}'" for name in names)
    typed = " ".join(f"--read-{name.replace('_', '-')} {example[name]}" for name in names)
    made = f"by making a material file: viscofric material convert CARD rubber.json --format json {typed}"
    return Remedy(f"with {said}", made, page=made)


@dataclass(frozen=True)
class Reading:
    """Units of a card; Pa and s by default, with a note, and temperatures judged by their size."""

    modulus_unit: str | None = None
    time_unit: str | None = None
    temperature_unit: str | None = None

    @property
    def pascal(self) -> float:
        """Pa in one unit of modulus."""
        return conversion(self.modulus_unit, "Pa", "modulus_unit")[0] if self.modulus_unit else 1.0

    @property
    def second(self) -> float:
        """Seconds in one unit of time."""
        return conversion(self.time_unit, "s", "time_unit")[0] if self.time_unit else 1.0

    def degree(self, zero: float | None = None) -> float:
        """K in one degree of a card, of which `zero` is absolute zero, if the card gives it."""
        if self.temperature_unit:
            return conversion(self.temperature_unit, "K", "temperature_unit")[0]
        return 5.0 / 9.0 if zero is not None and zero < _FAHRENHEIT_BELOW else 1.0

    def kelvin(self, temperature: float, notes: list[str], zero: float | None = None) -> float:
        """Return a card's temperature in K; `zero` is absolute zero on the card's scale, if the card gives it."""
        if self.temperature_unit:
            factor, offset = conversion(self.temperature_unit, "K", "temperature_unit")
            return factor * temperature + offset
        if zero is not None:
            return self.degree(zero) * (temperature - zero)
        if temperature >= _KELVIN_FROM:
            notes.append(Note("unit-assumed", f"The reference temperature {temperature:g} has no unit; K was assumed."))
            return temperature
        notes.append(Note("unit-assumed", f"The reference temperature {temperature:g} has no unit; °C was assumed."))
        return temperature + CELSIUS_ZERO

    def unit_note(self) -> list[str]:
        """Return a sentence on the units that were assumed, if any."""
        stated = {"modulus_unit": self.modulus_unit, "time_unit": self.time_unit}
        assumed = {name: _ASSUMED[name] for name, unit in stated.items() if not unit}
        if not assumed:
            return []
        note = Note(
            "unit-assumed",
            f"The card does not state its units; {' and '.join(assumed.values())} were assumed",
            remedy=" (give others " + give_units(assumed) + ").",
            values={"assumed": assumed},
        )
        return [note]


@dataclass(frozen=True, eq=False)
class Card(Shown):
    """A material card as it was read.

    Parameters
    ----------
    material : Material
        What it holds, in tension and SI units.
    format : str
        Format as which the file was read.
    notes : tuple of str
        What was assumed, left out or approximated, one sentence each.
    """

    material: Material
    format: str
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("material", self.material.name or "without a name"),
            ("format", self.format),
            ("notes", self.notes),
        )


@dataclass(frozen=True, eq=False)
class Solid:
    """Content of a card, as the card states it: tensile modulus, Poisson ratio, shift."""

    spectrum: RetardationSpectrum
    poisson_ratio: float  # of the long-term moduli
    shift: Any = None  # WLF, Arrhenius or None
    name: str = ""
    notes: tuple[str, ...] = ()  # what was assumed or left out


_FORTRAN = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))[dD]([+-]?\d+)", re.ASCII)
_BARE = re.compile(r"([+-]?(?:\d+\.\d*|\.\d+))([+-]\d+)", re.ASCII)


def number_in(text: str, *, bare: bool = True) -> float:
    """Return a number, whose exponent may be Fortran's: ``60.D6`` or, if `bare`, ``2.0+3``; else raise ValueError."""
    found = _FORTRAN.fullmatch(text.strip()) or (_BARE.fullmatch(text.strip()) if bare else None)
    return float(text if found is None else f"{found[1]}e{found[2]}")


def number_text(value: float, longest: int) -> str:
    """Return a finite number as text of at most `longest` (≥ 19) characters, with a decimal point."""
    # All digits are kept where they fit: 20 characters hold 16 of the 17 digits, 19 hold 15 (two fewer where the
    # exponent has three digits).
    for text in (repr(float(value)), *(f"{value:.{digits}g}" for digits in (17, 16, 15, 14, 13, 12))):
        mantissa, _, exponent = text.partition("e")
        mantissa += "" if "." in mantissa else ".0"
        short = mantissa + (f"e{int(exponent)}" if exponent else "")
        for one in (short, re.sub(r"^(-?)0\.", r"\1.", short)):
            if len(one) <= longest:
                return one
    raise InputError(f"{value!r} does not fit into {longest} characters.", code="too-long")


def card_law(law: Any) -> WLF | Arrhenius | None:
    """Return a shift law that programs have: WLF (VFT is the same curve) or Arrhenius; None for all others."""
    if isinstance(law, VFT):
        return law.to_wlf()
    return law if isinstance(law, (WLF, Arrhenius)) else None


def first_of_several(count: int, read: str, shown: str) -> Note:
    """Return the note on a file with several viscoelastic materials, of which `read`, shown as such, was read."""
    return Note(
        "first-of-several",
        f"The file holds {count} viscoelastic materials; the first, {shown}, was read.",
        values={"materials": count, "read": read},
    )


def not_read(what: str, names: Sequence[str], mark: str = "") -> list[Note]:
    """Return a note on what of a card was not read, such as "Keywords", none without names; `mark` precedes each."""
    if not names:
        return []
    said = f"{what} that were not read: {', '.join(mark + name for name in names)}."
    return [Note("not-read", said, values={"names": list(names)})]


def unread_shift(command: str, option: str, constants: Sequence[float] = ()) -> Note:
    """Return the note on a shift that is a subroutine of the user, or of a kind that is not read."""
    user = option == "USER"
    why = "is a subroutine outside the card" if user else "is not read"
    given = f" (constants {', '.join(f'{value:g}' for value in constants)})" if constants else ""
    return Note(
        "shift-in-subroutine" if user else "shift-not-read",
        f"{command} {why}{given}; the material holds at its reference temperature only.",
        values={"option": option, **({"constants": [float(value) for value in constants]} if constants else {})},
    )


def poisson_ratio_of(shear: float, bulk: float) -> float:
    """Return ν = (3K − 2G)/(2(3K + G)), without the digits that it has by rounding."""
    return round((3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)), 12)


#: Shear and bulk modes of a card whose times and ratios agree within this are one relaxation.
_ALIKE = 1e-9


def tensile(shear: RelaxationSpectrum, bulk: RelaxationSpectrum | None) -> tuple[RetardationSpectrum, float, list[str]]:
    """Return tensile spectrum, Poisson ratio of the long-term moduli, and notes, of G(t) and K(t) in Pa, exactly."""
    # 1/E = 1/(3G) + 1/(9K) holds at every frequency, so that the retardation modes of E are those of G and of K
    # together. Where K relaxes as G does, or is infinite (`bulk` is None), the Poisson ratio is constant and E =
    # 2(1+ν)G; elsewhere a note says that it is not.
    if shear.E0 <= 0.0:
        raise InputError(
            "the long-term shear modulus is zero (the relative moduli add up to 1, or no term is constant): a liquid "
            "has no rubber plateau, which a Material needs.",
            code="relative-moduli",
        )
    if bulk is None:
        return RelaxationSpectrum(3.0 * shear.E0, 3.0 * shear.E, shear.tau).to_retardation(), 0.5, []
    if bulk.E0 <= 0.0:
        raise InputError("the long-term bulk modulus is zero; a solid needs one above zero.", code="not-positive")
    poisson = [poisson_ratio_of(G, K) for G, K in ((shear.E0, bulk.E0), (shear.E_inf, bulk.E_inf))]
    if not all(0.0 <= ratio <= 0.5 for ratio in poisson):
        raise InputError(
            f"shear and bulk moduli give Poisson ratios of {poisson[0]:.4g} (long-term) and {poisson[1]:.4g} "
            "(instantaneous); both must lie between 0 and 0.5.",
            code="out-of-range",
        )
    if _alike(shear, bulk):
        factor = 2.0 * (1.0 + poisson[0])
        return RelaxationSpectrum(factor * shear.E0, factor * shear.E, shear.tau).to_retardation(), poisson[0], []
    of_shear, of_bulk = shear.to_retardation(), bulk.to_retardation()
    compliance = 1.0 / (3.0 * shear.E_inf) + 1.0 / (9.0 * bulk.E_inf)
    spectrum = RetardationSpectrum(
        1.0 / (1.0 / (3.0 * shear.E0) + 1.0 / (9.0 * bulk.E0)),
        1.0 / compliance,
        np.concatenate([of_shear.C / 3.0, of_bulk.C / 9.0]),
        np.concatenate([of_shear.tau, of_bulk.tau]),
    )
    note = Note(
        "ratio-of-rubber",
        f"Bulk does not relax as shear does, so that the Poisson ratio runs from {poisson[1]:.4g} (glass) to "
        f"{poisson[0]:.4g} (rubber); E(ω) is exact, the material's constant ratio is that of the rubber.",
        values={"glass": float(poisson[1]), "rubber": float(poisson[0])},
    )
    return spectrum, poisson[0], [note]


def _alike(shear: RelaxationSpectrum, bulk: RelaxationSpectrum) -> bool:
    if len(shear) != len(bulk):
        return False
    ratio = bulk.E0 / shear.E0
    return bool(
        np.allclose(bulk.tau, shear.tau, rtol=_ALIKE, atol=0.0)
        and np.allclose(bulk.E, ratio * shear.E, rtol=_ALIKE, atol=_ALIKE * shear.E_inf * ratio)
    )


def long_term_share(ratios: Any, stated: float | None) -> float:
    """Return the long-term modulus over the instantaneous one, 1 − Σg; as `stated` where that is the same number."""
    share = 1.0 - float(np.sum(ratios))  # loses digits
    if stated is not None and abs(stated - share) <= _ALIKE:
        return stated
    return 0.0 if abs(share) < 1e-12 else share


def relative_series(modulus: float, ratios: Any, times: Any, stated: float | None = None) -> RelaxationSpectrum:
    """Return a Prony series from its instantaneous modulus (Pa), relative moduli g_i and relaxation times (s)."""
    # Abaqus and ANSYS store it so.
    share = long_term_share(ratios, stated)
    if share < 0.0:
        raise InputError(
            f"the relative moduli add up to {1.0 - share:.6g}; they must stay below 1.", code="relative-moduli"
        )
    return RelaxationSpectrum(modulus * share, modulus * np.asarray(ratios, dtype=float), times)
