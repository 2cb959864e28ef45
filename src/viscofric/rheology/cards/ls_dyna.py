"""LS-DYNA cards: *MAT_GENERAL_VISCOELASTIC (*MAT_076) with shear and bulk terms and the temperature shift.

As in the LS-DYNA Keyword User's Manual, volume II, *MAT_076: G(t) = Σ G_i exp(−β_i t) and K(t) = Σ K_i exp(−β_ki t)
with decay constants β = 1/τ (0 for the long-term modulus), at most 18 terms; time is multiplied by
Φ = exp(−A (1/T − 1/TREF)) if B = 0, else by Φ = exp(−A (T − TREF)/(B + T − TREF)), so that Φ = 1/α: an Arrhenius
law has A = Ea/R, a WLF law A = −C1 ln 10 and B = C2.  With the same sign of A the two formulae shift in opposite
directions, so that one of them may be wrong in the manual: check a WLF card on one element, which has to relax faster
when warm; else change the sign of A.  The second card, for fits of load curves, is left blank, since terms are used
only then.  Fields are 20 characters wide (long format, marked by a '+' directly after the keyword; after a blank,
ansys-dyna-core does not know the keyword): the 10 characters of the standard format would cut numbers to 5 or 6 digits.
"""

from __future__ import annotations

import math
import re
from typing import Any

from viscofric.errors import InputError
from viscofric.notes import Note, Remedy
from viscofric.rheology.cards.card import Reading, Solid, Writing, first_of_several, number_in, number_text, tensile
from viscofric.rheology.cards.native import contents_of, number_of
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF, Arrhenius
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10
from viscofric.rheology.spectra.retardation import RelaxationSpectrum

NAME = "LS-DYNA"
_TERMS = 18
_WIDTH = 20
_KEYWORD = re.compile(r"\*MAT_(GENERAL_VISCOELASTIC|0?76)(_TITLE)?\s*([+-]?)\s*$", re.IGNORECASE)


def recognises(text: str) -> bool:
    """Return whether a text has the keyword of an LS-DYNA card."""
    return any(_KEYWORD.match(line.strip()) for line in text.splitlines() if line.startswith("*"))


def _fields(*values: float | str) -> str:
    """Return fields of 20 characters; numbers are rounded to the digits that fit, 15 at least."""
    texts = (value if isinstance(value, str) else number_text(value, _WIDTH - 1) for value in values)
    return "".join(text.rjust(_WIDTH) for text in texts)


def write(material: Material, writing: Writing) -> str:
    """Return the card as text."""
    contents = contents_of(material, writing, NAME, "needs a finite bulk modulus")
    relaxation, ratio, law = contents[:3]
    if len(relaxation) + 1 > _TERMS:
        raise InputError(
            f"{NAME} takes at most {_TERMS} terms, one of them the long-term modulus, and this material has "
            f"{len(relaxation)} modes; fit it with at most {_TERMS - 1}.",
            code="too-many-modes",
        )
    if writing.written_density is None:
        advice = Remedy("density=1100 for 1100 kg/m³.", "--density '1100 kg/m^3'.", page="“Density”: 1100 kg/m^3.")
        raise InputError(Note("no-density", f"{NAME} needs a density, such as ", remedy=advice))
    if writing.temperature_unit != "K" and isinstance(law, Arrhenius):
        raise InputError(
            f"{NAME} counts temperatures of an Arrhenius law in K; write the card in K, the default.",
            code="temperature-unit",
        )
    sentences = ["Long format, fields of 20 characters."]
    reference, A, B = 0.0, 0.0, 0.0
    if isinstance(law, WLF):
        reference, A, B = writing.temperature(law.reference), -law.C1 * LN10, law.C2
        sentences.append(
            "A is below zero: time is multiplied by exp(-A(T-TREF)/(B+T-TREF)), and passes faster when warm. Check it "
            "on one element: if that relaxes slower when warm, change the sign of A (the manual's formulae for WLF and "
            "Arrhenius shift in opposite directions with the same sign of A)."
        )
    elif law is not None:
        reference, A = law.reference, law.activation_energy / GAS_CONSTANT
    if law is not None and reference <= 0.0:
        raise InputError(
            f"TREF = {reference:g}: {NAME} needs it above zero; write the card in K, the default.", code="not-positive"
        )
    lines = ["*KEYWORD", *contents.comments("$", *sentences), "*MAT_GENERAL_VISCOELASTIC_TITLE+"]
    title = material.name.encode("ascii", "replace").decode() or "rubber"
    lines.append(title[:80])
    lines += ["$ MID, RO, BULK, PCF, EF, TREF, A, B"]
    shear, bulk = (writing.modulus(1.0 / part) for part in (2.0 * (1.0 + ratio), 3.0 * (1.0 - 2.0 * ratio)))
    glass = relaxation.E_inf * bulk
    lines += [
        _fields(str(writing.material_id), writing.written_density, glass, "0", "0", reference, A, B),
        "$ LCID, NT, BSTART, TRAMP, LCIDK, NTK, BSTARTK, TRAMPK (blank: terms follow)",
        "",
        "$ GI, BETAI, KI, BETAKI",
        _fields(relaxation.E0 * shear, 0.0, relaxation.E0 * bulk, 0.0),
    ]
    for modulus, time in contents.modes:
        lines.append(_fields(modulus * shear, 1.0 / time, modulus * bulk, 1.0 / time))
    return "\n".join([*lines, "*END", ""])


def read(text: str, reading: Reading, content: dict[str, Any] | None) -> Solid:
    """Return the first general viscoelastic material in the text."""
    notes: list[str] = [] if content else reading.unit_note()
    name, head, terms = _cards(text, notes)
    _, _, elastic_bulk, _, elastic, reference, A, B = head
    if elastic == 1.0:
        raise InputError("EF = 1: the card makes the layer elastic, not viscoelastic.", code="elastic-card")
    pascal, per_second = reading.pascal, 1.0 / reading.second
    shear = _series([(row[0] * pascal, row[1] * per_second) for row in terms], "GI, BETAI")
    bulk_terms = [(row[2] * pascal, row[3] * per_second) for row in terms if row[2] != 0.0]
    if bulk_terms:
        bulk = _series(bulk_terms, "KI, BETAKI")
    elif elastic_bulk > 0.0:
        bulk = RelaxationSpectrum(elastic_bulk * pascal, [], [])
    else:
        raise InputError(
            "the bulk modulus BULK and all KI are zero; one of them must be above zero.", code="not-positive"
        )
    spectrum, poisson, found = tensile(shear, bulk)
    return Solid(spectrum, poisson, _shift(reference, A, B, reading, content, notes), name, (*notes, *found))


def _cards(text: str, notes: list[str]) -> tuple[str, list[float], list[list[float]]]:
    """Return title, the eight values of the first card, and the terms of the first material."""
    lines = [(row, line) for row, line in enumerate(text.splitlines(), start=1) if not line.startswith("$")]
    long_format = any(re.match(r"\*KEYWORD\b.*LONG\s*=\s*[SY]", line, re.IGNORECASE) for _, line in lines)
    start, match = next(
        (index, found) for index, (_, line) in enumerate(lines) if (found := _KEYWORD.match(line.strip()))
    )
    wide = match[3] == "+" or (long_format and match[3] != "-")
    body = []
    for row, line in lines[start + 1 :]:
        if line.startswith("*"):
            break
        body.append((row, line))
    title = body.pop(0)[1].strip() if match[2] and body else ""
    rows = [_values(line, row, 20 if wide else 10) for row, line in body]
    if len(rows) < 2:
        raise InputError(
            "*MAT_GENERAL_VISCOELASTIC is cut short; it needs two cards and terms G, BETA, K, BETAK.", code="cut-short"
        )
    head, curves = rows[:2]
    if curves[0] != 0.0 or curves[4] != 0.0:
        raise InputError(
            "the terms come from load curves (LCID, LCIDK), which are not read; give GI and BETAI.", code="load-curves"
        )
    count = sum(1 for _, line in lines if _KEYWORD.match(line.strip()))
    if count > 1:
        first = f"{head[0]:.10g}"  # MID has up to ten digits
        notes.append(first_of_several(count, first, first))
    terms = [row[:4] for row in rows[2:] if any(row[:4])]
    if not terms:
        raise InputError("*MAT_GENERAL_VISCOELASTIC contains no terms GI, BETAI.", code="no-terms")
    return title, head, terms


def _values(line: str, row: int, width: int) -> list[float]:
    """Return the eight numbers of a line in fields of fixed width, or separated by commas; empty fields are zero."""
    parts = line.split(",") if "," in line else [line[start : start + width] for start in range(0, len(line), width)]
    parts = [part.strip() for part in parts][:8]
    try:
        return [number_in(part) if part else 0.0 for part in parts] + [0.0] * (8 - len(parts))
    except ValueError:
        raise InputError(
            f"line {row}: {line.strip()[:40]!r} is not a row of numbers in fields of {width}.", code="not-a-number"
        ) from None


def _series(terms: list[tuple[float, float]], names: str) -> RelaxationSpectrum:
    if any(modulus < 0.0 or rate < 0.0 for modulus, rate in terms):
        raise InputError(f"{names} must not be below zero.", code="not-positive")
    modes = [(modulus, 1.0 / rate) for modulus, rate in terms if rate > 0.0]
    rest = math.fsum(modulus for modulus, rate in terms if rate == 0.0)
    return RelaxationSpectrum(rest, [modulus for modulus, _ in modes], [time for _, time in modes])


def _shift(
    reference: float, A: float, B: float, reading: Reading, content: dict[str, Any] | None, notes: list[str]
) -> WLF | Arrhenius | None:
    if A == 0.0 or reference == 0.0:
        return None
    if B == 0.0:
        energy = A * reading.degree() * GAS_CONSTANT
        return Arrhenius(energy, reading.kelvin(reference, notes, 0.0 if content else None))
    if A > 0.0:
        notes.append(
            Note(
                "wrong-sign",
                f"A = {A:g} with B = {B:g} would make relaxation slower as it gets warmer (time is multiplied by "
                "exp(-A(T-TREF)/(B+T-TREF))); the shift was left out, check the sign of A.",
            )
        )
        return None
    return WLF(-A / LN10, B * reading.degree(), reading.kelvin(reference, notes, number_of(content, "absolute_zero")))
