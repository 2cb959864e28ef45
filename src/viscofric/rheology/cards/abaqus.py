"""Abaqus material cards: *ELASTIC or *HYPERELASTIC, *VISCOELASTIC with a Prony series, *TRS.

Keywords and data lines as in the Abaqus Keywords Guide (*ELASTIC, *HYPERELASTIC, *VISCOELASTIC, *TRS,
*PHYSICAL CONSTANTS) and the Analysis Guide, Time domain viscoelasticity: g_R(t) = 1 − Σ g_i (1 − exp(−t/τ_i)),
k_R likewise, both of the instantaneous moduli, though *ELASTIC must hold the long-term ones in the frequency domain;
−log10 A = C1 (θ − θ0)/(C2 + θ − θ0), with A our α, or ln A = E0/R (1/(θ − θZ) − 1/(θ0 − θZ)).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.cards.card import (
    Reading,
    Solid,
    Writing,
    first_of_several,
    long_term_share,
    not_read,
    number_in,
    number_text,
    relative_series,
    tensile,
    unread_shift,
)
from viscofric.rheology.cards.native import contents_of, number_of, share_of
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF, Arrhenius
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT
from viscofric.rheology.spectra.retardation import RelaxationSpectrum
from viscofric.units import CELSIUS_ZERO

NAME = "Abaqus"
_LONGEST_NAME = 80
_LONGEST_NUMBER = 20  # characters
_UNDERSTOOD = {"MATERIAL", "ELASTIC", "HYPERELASTIC", "VISCOELASTIC", "TRS", "DENSITY", "PHYSICALCONSTANTS"}
#: Keywords without effect on the properties read here.
_IMMATERIAL = {
    "HEADING",
    "EXPANSION",
    "CONDUCTIVITY",
    "SPECIFICHEAT",
    "DAMPING",
    "PREPRINT",
    "DEPVAR",
    "USEROUTPUTVARIABLES",
}


def recognises(text: str) -> bool:
    """Return whether a text has the keywords of an Abaqus card."""
    return bool(re.search(r"(?im)^\s*\*\s*(VISCOELASTIC\s*,|MATERIAL\s*,\s*NAME)", text))


def card_name(name: str) -> str:
    """Return a valid Abaqus name: at most 80 characters, a letter first."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", name.encode("ascii", "ignore").decode()).strip("_") or "rubber"
    return (plain if plain[0].isalpha() else f"M_{plain}")[:_LONGEST_NAME]


def write(material: Material, writing: Writing) -> str:
    """Return the card as text."""
    # *TRS belongs to *VISCOELASTIC, TIME=…; in the frequency domain there is none.
    contents = contents_of(material, writing, NAME, with_shift=writing.domain == "time")
    relaxation, ratio, law = contents[:3]
    lines = contents.comments("**")
    if isinstance(law, Arrhenius):
        zero = 0.0 if writing.temperature_unit == "K" else -CELSIUS_ZERO
        gas = number_text(writing.energy(GAS_CONSTANT), _LONGEST_NUMBER)
        lines.append(f"*PHYSICAL CONSTANTS, ABSOLUTE ZERO={zero!r}, UNIVERSAL GAS CONSTANT={gas}")
    lines.append(f"*MATERIAL, NAME={card_name(material.name)}")
    if writing.written_density is not None:
        lines += ["*DENSITY", f"{_row(writing.written_density)},"]
    # Abaqus/Standard takes no instantaneous moduli in the frequency domain.
    kind, modulus = ("INSTANTANEOUS", relaxation.E_inf) if writing.domain == "time" else ("LONG TERM", relaxation.E0)
    lines += [f"*ELASTIC, MODULI={kind}", _row(writing.modulus(modulus), ratio)]
    lines.append(f"*VISCOELASTIC, {writing.domain.upper()}=PRONY")
    bulk = 1.0 if ratio < 0.5 else 0.0
    for modulus, time in contents.modes:
        share = modulus / relaxation.E_inf
        lines.append(_row(share, bulk * share, time))
    if isinstance(law, WLF):
        lines += ["*TRS, DEFINITION=WLF", _row(writing.temperature(law.reference), law.C1, law.C2)]
    elif law is not None:
        values = _row(writing.temperature(law.reference), writing.energy(law.activation_energy))
        lines += ["*TRS, DEFINITION=ARRHENIUS", values]
    return "\n".join([*lines, ""])


def _row(*values: float) -> str:
    """Return a data line."""
    return ", ".join(number_text(value, _LONGEST_NUMBER) for value in values)


_NUMBER = re.compile(r"[+-]?\.?\d")  # at the beginning of a row of numbers


@dataclass
class _Block:
    """One keyword with its parameters and the numbers of its data lines."""

    keyword: str
    options: dict[str, str]
    row: int
    data: list[list[float]] = field(default_factory=list)


def read(text: str, reading: Reading, content: dict[str, Any] | None) -> Solid:
    """Return the first viscoelastic material in the text."""
    blocks = _blocks(text)
    notes: list[str] = [] if content else reading.unit_note()
    chosen, name = _material(blocks, notes)
    viscoelastic = _only(chosen, "VISCOELASTIC")
    if viscoelastic is None:
        raise InputError(
            "contains no *VISCOELASTIC; expected *VISCOELASTIC, TIME=PRONY with lines g, k, tau.", code="no-terms"
        )
    if "PRONY" not in (viscoelastic.options.get("TIME", "").upper(), viscoelastic.options.get("FREQUENCY", "").upper()):
        raise InputError(
            f"line {viscoelastic.row}: *VISCOELASTIC must have TIME=PRONY or FREQUENCY=PRONY; other ways of giving it "
            "are not read.",
            code="not-prony",
        )
    rows = [(*row, 0.0, 0.0, 0.0)[:3] for row in viscoelastic.data if row]
    if not rows or any(row[2] <= 0.0 for row in rows):
        raise InputError(
            f"line {viscoelastic.row}: *VISCOELASTIC needs lines of g, k, tau with tau above zero.", code="no-terms"
        )
    shares = [row[0] for row in rows], [row[1] for row in rows]
    times = [row[2] * reading.second for row in rows]
    shear, bulk, instantaneous = _elasticity(chosen, reading, notes)
    stated = share_of(content)
    if not instantaneous:
        shear = shear / _left(shares[0], viscoelastic.row, stated)
        bulk = None if bulk is None else bulk / _left(shares[1], viscoelastic.row, stated)
    series = relative_series(shear, shares[0], times, stated)
    bulk_series = None
    if bulk is not None:
        bulk_series = relative_series(bulk, shares[1], times, stated)
        kept = bulk_series.E > 0.0
        bulk_series = RelaxationSpectrum(bulk_series.E0, bulk_series.E[kept], bulk_series.tau[kept])
    spectrum, ratio, found = tensile(series, bulk_series)
    shift = _shift(_only(chosen, "TRS"), blocks, reading, content, notes)
    return Solid(spectrum, ratio, shift, name, (*notes, *found))


def _blocks(text: str) -> list[_Block]:
    blocks: list[_Block] = []
    continued = False  # a keyword line that ends in a comma goes on in the next one
    for row, line in enumerate(text.splitlines(), start=1):
        line = line.strip()
        if not line or line.startswith("**"):
            continue
        if continued and (line.startswith("*") or _NUMBER.match(line)):
            continued = False  # after all
        if line.startswith("*") or continued:
            options = line
            if not continued:
                head, _, options = line[1:].partition(",")
                blocks.append(_Block(head.strip().upper().replace(" ", ""), {}, row))
            pairs = (option.partition("=") for option in options.split(",") if option.strip())
            blocks[-1].options.update({key.strip().upper(): value.strip() for key, _, value in pairs})
            continued = line.endswith(",")
        elif blocks and blocks[-1].keyword in _UNDERSTOOD:
            try:
                numbers = [number_in(part) if part.strip() else 0.0 for part in line.rstrip(",").split(",")]
            except ValueError:
                raise InputError(
                    f"line {row}: {line[:40]!r} is not a row of numbers parted by commas.", code="not-a-number"
                ) from None
            blocks[-1].data.append(numbers)
    return blocks


def _material(blocks: list[_Block], notes: list[str]) -> tuple[list[_Block], str]:
    """Return the blocks of the first viscoelastic material, and its name."""
    materials: list[list[_Block]] = [[]]
    for block in blocks:
        if block.keyword == "MATERIAL":
            materials.append([])
        materials[-1].append(block)
    viscoelastic = [one for one in materials if any(block.keyword == "VISCOELASTIC" for block in one)]
    if not viscoelastic:
        return [], ""
    chosen = viscoelastic[0]
    name = chosen[0].options.get("NAME", "") if chosen[0].keyword == "MATERIAL" else ""
    if len(viscoelastic) > 1:
        notes.append(first_of_several(len(viscoelastic), name, repr(name)))
    notes += not_read("Keywords", sorted({block.keyword for block in chosen} - _UNDERSTOOD - _IMMATERIAL), "*")
    return chosen, name


def _only(blocks: list[_Block], keyword: str) -> _Block | None:
    return next((block for block in blocks if block.keyword == keyword), None)


def _left(shares: list[float], row: int, stated: float | None) -> float:
    """Return the long-term modulus over the instantaneous one."""
    left = long_term_share(shares, stated)
    if left <= 0.0:
        raise InputError(
            f"line {row}: the relative moduli add up to {1.0 - left:.6g}; with long-term moduli given they must stay "
            "below 1.",
            code="relative-moduli",
        )
    return left


def _elasticity(blocks: list[_Block], reading: Reading, notes: list[str]) -> tuple[float, float | None, bool]:
    """Return shear and bulk modulus (None if infinite), Pa, and whether they are instantaneous."""
    elastic, hyperelastic = _only(blocks, "ELASTIC"), _only(blocks, "HYPERELASTIC")
    block = elastic or hyperelastic
    if block is None or not block.data:
        raise InputError(
            "contains no *ELASTIC or *HYPERELASTIC with numbers, so that its moduli are not known.", code="no-modulus"
        )
    if len(block.data) > 1:
        notes.append(
            Note("first-line-taken", f"Line {block.row}: elasticity depends on temperature; its first line was taken.")
        )
    instantaneous = block.options.get("MODULI", "LONG TERM").upper().replace(" ", "") == "INSTANTANEOUS"
    values = block.data[0]
    if elastic is not None:
        if elastic.options.get("TYPE", "ISOTROPIC").upper() not in ("ISOTROPIC", "ISO"):
            raise InputError(f"line {block.row}: *ELASTIC must be isotropic.", code="not-isotropic")
        modulus, ratio = (*values, 0.0)[:2]
        if not (modulus > 0.0 and 0.0 <= ratio <= 0.5):
            raise InputError(
                f"line {block.row}: *ELASTIC needs a modulus above zero, a Poisson ratio from 0 to 0.5.",
                code="no-modulus",
            )
        shear = modulus * reading.pascal / (2.0 * (1.0 + ratio))
        return shear, None if ratio == 0.5 else modulus * reading.pascal / (3.0 * (1.0 - 2.0 * ratio)), instantaneous
    notes.append(Note("hyperelastic", "The card is hyperelastic; the material is its small-strain limit."))
    shear, softness = _hyperelastic(block)
    bulk = None if softness == 0.0 else 2.0 / softness * reading.pascal
    return shear * reading.pascal, bulk, instantaneous


def _hyperelastic(block: _Block) -> tuple[float, float]:
    """Return the shear modulus at small strain and D1 = 2/K, in the card's unit."""
    values = block.data[0]  # of one temperature
    options = {option.upper().replace("-", " ") for option in block.options}
    # number of constants, indices of those whose doubled sum is the shear modulus, and index of D1
    known = {"NEO HOOKE": ((0,), 1), "MOONEY RIVLIN": ((0, 1), 2), "YEOH": ((0,), 3)}
    for model, (stiff, place) in known.items():
        if model in options:
            shear = 2.0 * sum(values[index] for index in stiff if index < len(values))
            if shear <= 0.0:
                raise InputError(
                    f"line {block.row}: *HYPERELASTIC gives no shear modulus above zero.", code="no-modulus"
                )
            return shear, values[place] if place < len(values) else 0.0
    raise InputError(
        f"line {block.row}: *HYPERELASTIC is read as NEO HOOKE, MOONEY-RIVLIN or YEOH with constants, not with test "
        "data or another model.",
        code="other-model",
    )


def _number(block: _Block, option: str) -> float:
    try:
        return number_in(block.options[option])
    except ValueError:
        raise InputError(
            f"line {block.row}: {option} = {block.options[option]!r} is not a number.", code="not-a-number"
        ) from None


def _shift(
    block: _Block | None, blocks: list[_Block], reading: Reading, content: dict[str, Any] | None, notes: list[str]
) -> WLF | Arrhenius | None:
    if block is None:
        return None
    kind = block.options.get("DEFINITION", "WLF").upper()
    values = block.data[0] if block.data else []
    constants = _only(blocks, "PHYSICALCONSTANTS")
    zero = number_of(content, "absolute_zero")
    if constants is not None and "ABSOLUTE ZERO" in constants.options:
        zero = _number(constants, "ABSOLUTE ZERO")
    if kind == "WLF" and len(values) >= 3:
        return WLF(values[1], values[2] * reading.degree(zero), reading.kelvin(values[0], notes, zero))
    if kind == "ARRHENIUS" and len(values) >= 2:
        energy = values[1]
        if constants is not None and "UNIVERSAL GAS CONSTANT" in constants.options:
            # Only E0/R matters, whatever the unit of energy.
            degrees = energy / _number(constants, "UNIVERSAL GAS CONSTANT")
            energy = degrees * reading.degree(zero) * GAS_CONSTANT
        else:
            said = f"The card has no universal gas constant; the activation energy {values[1]:g} was read in J/mol."
            notes.append(Note("unit-assumed", said))
        return Arrhenius(energy, reading.kelvin(values[0], notes, zero))
    if kind in ("WLF", "ARRHENIUS"):
        raise InputError(
            f"line {block.row}: *TRS, DEFINITION={kind} lacks numbers; WLF has 3, ARRHENIUS 2.",
            code="missing-constants",
        )
    notes.append(unread_shift(f"*TRS, DEFINITION={kind}", kind))
    return None
