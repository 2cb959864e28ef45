"""COMSOL Multiphysics: a text of parameters, and the three-column table of branches of Linear Viscoelasticity.

Parameters are lines of name, expression with unit, description (Parameters > Load from file); the table holds the
number of the branch, its shear modulus and its relaxation time (Linear Viscoelasticity > Load from file, COMSOL
Structural Mechanics Module User's Guide, Viscoelasticity).  Generalised Maxwell model: G(t) = G + Σ G_m exp(−t/τ_m);
log10 aT = −C1 (T − Tref)/(C2 + T − Tref), or ln aT = (Q/R)(1/T − 1/Tref).  In COMSOL 6.0 all branches are deviatoric
and the bulk modulus is one constant; in 6.2 they may be "Volumetric and deviatoric", K(t) = K + Σ K_m exp(−t/τ_m).
Only these have a constant Poisson ratio: with the long-term bulk modulus alone the glass would be far too soft.
"""

from __future__ import annotations

import re
from dataclasses import fields
from typing import Any

from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.cards.card import Reading, Solid, Writing, not_read
from viscofric.rheology.cards.native import Contents, contents_of, number_of
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF, Arrhenius
from viscofric.rheology.shifts.parametric_law import ParametricLaw
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.spectra.retardation import RelaxationSpectrum
from viscofric.units import to_si

NAME = "COMSOL"
#: Bulk moduli within this of those that follow from nu and the shear moduli agree with them.
_SAME = 1e-9
_LINE = re.compile(r"(?P<name>[A-Za-z]\w*)\s+(?P<value>[-+0-9.eE]+)(?:\s*\[(?P<unit>[^\]]*)\])?(?:\s+.*)?")


def recognises(text: str) -> bool:
    """Return whether a text is a list of such parameters, by their names."""
    return bool(re.search(r"(?m)^G_long_term\s", text) and re.search(r"(?m)^G_1\s", text))


def recognises_branches(text: str) -> bool:
    """Return whether a text is a table of branches (only viscofric's own states its long-term modulus)."""
    rows = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("%")]
    try:
        return bool(rows) and all(
            len(row) == 3 and int(row[0]) == number and float(row[1]) >= 0.0 < float(row[2])
            for number, row in enumerate(rows, start=1)
        )
    except ValueError:
        return False


def _head(material: Material, writing: Writing, parameters: bool) -> tuple[Contents, list[str]]:
    """Return contents (only parameters can hold a shift law) and comment lines."""
    contents = contents_of(material, writing, NAME, with_shift=parameters)
    ratio = contents.poisson_ratio
    return contents, contents.comments(
        "%", *(_bulk_remarks(contents.relaxation, ratio, parameters) if ratio < 0.5 else [])
    )


def _bulk_remarks(relaxation: RelaxationSpectrum, ratio: float, parameters: bool) -> list[str]:
    """Return the choices in the program that give the material's E."""
    bulk = 1.0 / (3.0 * (1.0 - 2.0 * ratio))
    constant, long_term = bulk * relaxation.E_inf, bulk * relaxation.E0
    # 1/E = 1/(3G) + 1/(9K) with the relaxed G and the glassy K: the largest error of E.
    excess = 1.0 / ((2.0 + 2.0 * ratio) / 3.0 + (1.0 - 2.0 * ratio) / 3.0 * relaxation.E0 / relaxation.E_inf) - 1.0
    names = (
        ("G_long_term and K_long_term", "its G_m, K_m and tau_m", "K_constant")
        if parameters
        else (
            f"the long-term shear modulus below and bulk modulus {long_term!r} Pa",
            f"a bulk modulus of {bulk * 2.0 * (1.0 + ratio)!r} times its shear modulus",
            f"{constant!r} Pa",
        )
    )
    exact = (
        f"Linear Elastic Material: enter {names[0]}, not E and nu. Viscoelasticity: Generalized Maxwell, Viscoelastic "
        f'strains "Volumetric and deviatoric" (in COMSOL 6.2), each branch with {names[1]}. Only so has the model '
        "the E and the Poisson ratio of the material."
    )
    otherwise = (
        f"Where branches are deviatoric only (COMSOL 6.0), the bulk modulus is one constant: enter {names[2]}, that of "
        f"the glass, instead of the long-term one. E is then right in the glass and at most {100.0 * excess:.2g} "
        "percent too stiff in the rubber. With the long-term bulk modulus the glass would be far too soft."
    )
    return [exact, otherwise]


def write(material: Material, writing: Writing) -> str:
    """Return the parameters as text."""
    contents, lines = _head(material, writing, True)
    relaxation, ratio, law = contents[:3]
    shear = 1.0 / (2.0 * (1.0 + ratio))
    lines += [
        f'nu {ratio!r} "Poisson ratio"',
        f'G_long_term {relaxation.E0 * shear!r}[Pa] "long-term shear modulus"',
    ]
    bulk = 0.0 if ratio == 0.5 else 1.0 / (3.0 * (1.0 - 2.0 * ratio))
    if bulk:
        lines += [
            f'K_long_term {relaxation.E0 * bulk!r}[Pa] "long-term bulk modulus, for branches with K_m"',
            f'K_constant {relaxation.E_inf * bulk!r}[Pa] "bulk modulus of the glass, for branches without K_m"',
        ]
    if writing.density is not None:
        lines.append(f'rho {writing.density!r}[kg/m^3] "density"')
    for number, (modulus, time) in enumerate(contents.modes, start=1):
        lines.append(f'G_{number} {modulus * shear!r}[Pa] "shear modulus of branch {number}"')
        if bulk:
            lines.append(f'K_{number} {modulus * bulk!r}[Pa] "bulk modulus of branch {number}"')
        lines.append(f'tau_{number} {time!r}[s] "relaxation time of branch {number}"')
    if law is not None:
        lines.append(f'T_reference {law.reference!r}[K] "reference temperature of the shift"')
    if isinstance(law, WLF):
        lines += [f'C1_WLF {law.C1!r} "WLF constant"', f'C2_WLF {law.C2!r}[K] "WLF constant"']
    elif law is not None:
        lines.append(f'Q_arrhenius {law.activation_energy!r}[J/mol] "activation energy"')
    return "\n".join([*lines, ""])


def _exact(shift: ShiftLaw) -> str:
    """Return a law with all digits of its constants, in SI units; other shifts as they show themselves."""
    if not isinstance(shift, ParametricLaw):
        return " ".join(str(shift).split())
    constants = (f"{one.name}={getattr(shift, one.name)!r}" for one in fields(shift) if one.repr)
    return f"{type(shift).__name__}({', '.join(constants)})"


def write_branches(material: Material, writing: Writing) -> str:
    """Return the table of branches as text; long-term moduli and shift are in its comments."""
    contents, lines = _head(material, writing, False)
    relaxation, ratio = contents[:2]
    shear = 1.0 / (2.0 * (1.0 + ratio))
    lines.append(f"% Long-term shear modulus {relaxation.E0 * shear!r} Pa, Poisson ratio {ratio!r}.")
    if material.shift is not None and material.has_shift_factors:
        lines.append(f"% Shift: {_exact(material.shift)[:200]}".encode("ascii", "replace").decode())
    lines.append("% branch, shear modulus (Pa), relaxation time (s)")
    for number, (modulus, time) in enumerate(contents.modes, start=1):
        lines.append(f"{number} {modulus * shear!r} {time!r}")
    return "\n".join([*lines, ""])


def read(text: str, reading: Reading, content: dict[str, Any] | None) -> Solid:
    """Return the material of a list of parameters."""
    del reading  # every parameter has its unit
    values: dict[str, str] = {}
    ignored = []
    for row, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.startswith("%"):
            continue
        match = _LINE.fullmatch(line.strip())
        if match is None:
            raise InputError(
                f"line {row}: {line.strip()[:40]!r} is not a name, a number with [unit] and a description.",
                code="not-a-number",
            )
        if not re.fullmatch(
            r"nu|rho|[GK]_long_term|K_constant|([GK]|tau)_\d{1,4}|T_reference|C[12]_WLF|Q_arrhenius",
            match["name"],
        ):
            ignored.append(match["name"])
        values[match["name"]] = f"{match['value']} {match['unit']}" if match["unit"] else match["value"]
    notes = not_read("Parameters", ignored)
    branches = sorted(int(name[2:]) for name in values if re.fullmatch(r"G_\d{1,4}", name))
    ratio = _value(values, "nu", "dimensionless")
    factor = 2.0 * (1.0 + ratio)
    notes += _bulk_note(values, ratio)
    spectrum = RelaxationSpectrum(
        factor * _value(values, "G_long_term", "Pa"),
        [factor * _value(values, f"G_{number}", "Pa") for number in branches],
        [_value(values, f"tau_{number}", "s") for number in branches],
    ).to_retardation()
    shift: WLF | Arrhenius | None = None
    if "C1_WLF" in values:
        C1, C2 = _value(values, "C1_WLF", "dimensionless"), _value(values, "C2_WLF", "delta_degC")
        shift = WLF(C1, C2, _value(values, "T_reference", "K"))
    elif "Q_arrhenius" in values:
        shift = Arrhenius(_value(values, "Q_arrhenius", "J/mol"), _value(values, "T_reference", "K"))
    return Solid(spectrum, ratio, shift, "", tuple(notes))


def read_branches(text: str, reading: Reading, content: dict[str, Any] | None) -> Solid:
    """Return the material of a table of branches, with the long-term modulus of its comments."""
    E0, ratio = number_of(content, "E0"), number_of(content, "poisson_ratio")
    if content is None or E0 is None or ratio is None:
        raise InputError(
            "is a table of branches without a long-term modulus, which a rubber needs; write the parameters "
            "(format='comsol') instead, or build RelaxationSpectrum(E0, E, tau).to_retardation() in Python.",
            code="no-modulus",
        )
    del reading
    rows = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("%")]
    factor = 2.0 * (1.0 + ratio)
    moduli, times = ([float(row[column]) for row in rows] for column in (1, 2))
    spectrum = RelaxationSpectrum(E0, [factor * modulus for modulus in moduli], times).to_retardation()
    return Solid(spectrum, ratio)


def _bulk_note(values: dict[str, str], ratio: float) -> list[Note]:
    """Return a sentence if bulk moduli do not agree with nu and the shear moduli."""
    odd = []
    for name in (one for one in values if re.fullmatch(r"K_long_term|K_\d+", one)):
        bulk, shear = _value(values, name, "Pa"), _value(values, f"G{name[1:]}", "Pa")
        expected = 2.0 * (1.0 + ratio) * shear
        if not abs(3.0 * (1.0 - 2.0 * ratio) * bulk - expected) <= _SAME * expected:
            odd.append(name)
    if not odd:
        return []
    said = f"The bulk moduli {', '.join(odd)} do not belong to nu = {ratio:g}, which counts."
    return [Note("bulk-contradicts", said, values={"parameters": odd})]


def _value(values: dict[str, str], name: str, unit: str) -> float:
    if name not in values:
        raise InputError(f"lacks the parameter {name}.", code="missing-constants")
    given = values[name]
    if " " in given:
        return to_si(given, unit, name)
    if unit not in ("dimensionless", "delta_degC"):  # a difference is the same in K
        raise InputError(
            f"{name} = {given}: has no unit; write it behind the number, as in {given}[{unit}].", code="no-unit"
        )
    try:
        return to_si(float(given), unit, name)
    except ValueError:
        raise InputError(f"{name} = {given!r}: is not a number.", code="not-a-number") from None
