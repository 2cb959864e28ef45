"""ANSYS Mechanical APDL material commands: MP,EX and MP,PRXY, TB,PRONY (SHEAR, BULK), TB,SHIFT (WLF, TN).

As in the Mechanical APDL Material Reference (Viscoelasticity) and Command Reference (TB): relative moduli of the
instantaneous shear and bulk modulus, each followed by its relaxation time; the shift multiplies time, so that
A = 1/α.  WLF: log10 A = C1 (T − Tr)/(C2 + T − Tr), constants Tr, C1, C2.  TN (Tool–Narayanaswamy without fictive
temperature): ln A = (H/R) (1/Tr − 1/T), constants Tr, H/R with temperatures in K.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.cards.card import (
    Reading,
    Solid,
    Writing,
    first_of_several,
    not_read,
    number_in,
    relative_series,
    tensile,
    unread_shift,
)
from viscofric.rheology.cards.native import contents_of, number_of, share_of
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF, Arrhenius
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT

NAME = "ANSYS"
_MOST_CONSTANTS = 10_000
_PROPERTIES = ("EX", "PRXY", "NUXY", "DENS")
#: TB labels by the four letters that count.
_LABELS = {"PRON": "PRONY", "SHIF": "SHIFT"}
#: Unit of stress of the systems of /UNITS in which time is in s.
_UNIT_SYSTEMS = {"SI": "Pa", "MKS": "Pa", "MPA": "MPa"}
_PAIRS = 3  # of modulus and time on one TBDATA, which takes six constants
#: "MATID=1"
_PARAMETER = re.compile(r"(?P<name>[A-Z_]\w*\s*)=\s*(?P<value>\d+)")
#: Fields of a command, and its line.
_Command: TypeAlias = tuple[list[str], int]
_ARITHMETIC: dict[type, Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def recognises(text: str) -> bool:
    """Return whether a text has the commands of an ANSYS card."""
    return bool(re.search(r"(?im)^\s*TB\s*,\s*PRON", text))


def write(material: Material, writing: Writing) -> str:
    """Return the commands as text."""
    contents = contents_of(material, writing, NAME, "needs a Poisson ratio below 0.5 (MP,PRXY)")
    relaxation, ratio, law = contents[:3]
    number = writing.material_id
    kelvin = "TN counts temperatures in K: set TOFFST if the model counts them otherwise."
    lines = contents.comments("!", *([kelvin] if isinstance(law, Arrhenius) else []))
    lines += [f"MP,EX,{number},{writing.modulus(relaxation.E_inf)!r}", f"MP,PRXY,{number},{ratio!r}"]
    if writing.written_density is not None:
        lines.append(f"MP,DENS,{number},{writing.written_density!r}")
    pairs = [f"{modulus / relaxation.E_inf!r},{time!r}" for modulus, time in contents.modes]
    for kind in ("SHEAR", "BULK"):
        lines.append(f"TB,PRONY,{number},1,{len(pairs)},{kind}")
        for start in range(0, len(pairs), _PAIRS):
            lines.append(f"TBDATA,{2 * start + 1},{','.join(pairs[start : start + _PAIRS])}")
    if isinstance(law, WLF):
        constants = f"{writing.temperature(law.reference)!r},{law.C1!r},{law.C2!r}"
        lines += [f"TB,SHIFT,{number},1,3,WLF", f"TBDATA,1,{constants}"]
    elif law is not None:
        constants = f"{law.reference!r},{law.activation_energy / GAS_CONSTANT!r}"
        lines += [f"TB,SHIFT,{number},1,2,TN", f"TBDATA,1,{constants}"]
    return "\n".join([*lines, ""])


@dataclass
class _Table:
    """One TB command and the constants of its TBDATA, by their number."""

    name: str
    material: str
    option: str
    row: int
    values: dict[int, float] = field(default_factory=dict)
    last: int = 0  # number of the constant filled last, after which a TBDATA without a number goes on
    tables: int = 1  # one for each TBTEMP

    def fill(self, fields: list[str], row: int) -> None:
        """Take the constants of a TBDATA: the number of the first, and their values."""
        first = _number(fields[0], row) if fields[0] else self.last + 1.0
        if not 1 <= first <= _MOST_CONSTANTS:
            raise InputError(
                f"line {row}: TBDATA begins at constant {first:g}; expected 1 or above.", code="out-of-range"
            )
        for place, value in enumerate(fields[1:], start=int(first)):
            if value:
                self.values[place] = _number(value, row)
                self.last = place

    def constants(self) -> list[float]:
        """All constants from the first; missing ones are an error, and so are those of several temperatures."""
        if self.tables > 1:
            raise InputError(
                f"line {self.row}: TB,{self.name},…,{self.option} has constants at several temperatures (TBTEMP); keep "
                "those of one.",
                code="several-temperatures",
            )
        count = max(self.values, default=0)
        missing = [place for place in range(1, count + 1) if place not in self.values]
        if missing:
            raise InputError(
                f"line {self.row}: TB,{self.name},…,{self.option} lacks constant {missing[0]} of {count}.",
                code="missing-constants",
            )
        return [self.values[place] for place in range(1, count + 1)]


def read(text: str, reading: Reading, content: dict[str, Any] | None) -> Solid:
    """Return the material of the commands."""
    found_properties, tables, ignored, stated_unit = _commands(text)
    if reading.modulus_unit is None and stated_unit:
        reading = replace(reading, modulus_unit=stated_unit, time_unit=reading.time_unit or "s")
    notes: list[str] = [] if content else reading.unit_note()
    if stated_unit and reading.pascal != Reading(stated_unit).pascal:
        said = f"/UNITS of the card states {stated_unit}; its moduli were read in {reading.modulus_unit}, as given."
        notes.append(Note("unit-contradicted", said, values={"stated": stated_unit, "given": reading.modulus_unit}))
    materials = list(dict.fromkeys(table.material for table in tables if table.name == "PRONY"))
    first = materials[0] if materials else ""
    others = [table for table in tables if table.material != first and table.name == "SHIFT"]
    tables = [table for table in tables if table.material == first]
    if len(materials) == 1 and others:
        said = f"TB,SHIFT of material {others[0].material} was not read; the viscoelastic material is {first}."
        notes.append(Note("shift-not-read", said))
    if len(materials) > 1:
        notes.append(first_of_several(len(materials), first, first))
    ignored |= {f"TB,{table.name}" for table in tables if table.name not in ("PRONY", "SHIFT")}
    notes += not_read("Commands", sorted(ignored))
    properties = found_properties.get(first, {})
    modulus, major, minor = (
        _property(*properties[one]) if one in properties else None for one in ("EX", "PRXY", "NUXY")
    )
    ratio = minor if major is None else major
    if modulus is None or ratio is None:
        raise InputError(
            f"contains no MP,EX or no MP,PRXY (nor NUXY) of material {first}, so that its instantaneous moduli are not "
            "known.",
            code="no-modulus",
        )
    if not (modulus > 0.0 and 0.0 <= ratio < 0.5):
        raise InputError(
            f"MP,EX = {modulus:g} must be above zero and MP,PRXY = {ratio:g} from 0 to below 0.5.", code="not-positive"
        )
    modulus *= reading.pascal
    series = {table.option: _pairs(table, reading) for table in tables if table.name == "PRONY"}
    unknown = sorted(set(series) - {"SHEAR", "BULK"})
    if unknown or "SHEAR" not in series:
        raise InputError("needs TB,PRONY,…,SHEAR (and BULK); other options of TB,PRONY are not read.", code="no-terms")
    stated = share_of(content)
    shear = modulus / (2.0 * (1.0 + ratio))
    bulk = modulus / (3.0 * (1.0 - 2.0 * ratio))
    shear_series = relative_series(shear, *series["SHEAR"], stated)
    bulk_series = relative_series(bulk, *series.get("BULK", ([], [])), stated)
    spectrum, poisson, found = tensile(shear_series, bulk_series)
    shift = _shift(next((table for table in tables if table.name == "SHIFT"), None), reading, content, notes)
    return Solid(spectrum, poisson, shift, "", (*notes, *found))


def _commands(text: str) -> tuple[dict[str, dict[str, _Command]], list[_Table], set[str], str | None]:
    """Return properties (MP) by material, tables (TB with TBDATA), ignored commands, and the unit of /UNITS, if any."""
    properties: dict[str, dict[str, _Command]] = {}
    numbers: dict[str, str] = {}  # of materials, by the parameters that stand for them
    tables: list[_Table] = []
    ignored: set[str] = set()
    unit: str | None = None
    for row, line in enumerate(text.splitlines(), start=1):
        for command in line.partition("!")[0].split("$"):
            head, *fields = (part.strip() for part in command.split(","))
            head = head.upper()
            if head == "MP" and len(fields) >= 3 and fields[0].upper() in _PROPERTIES:
                properties.setdefault(_material(fields, numbers), {})[fields[0].upper()] = (fields, row)
            elif head == "TB" and fields:
                option = fields[4].upper() if len(fields) > 4 else ""
                tables.append(
                    _Table(
                        _LABELS.get(fields[0].upper()[:4], fields[0].upper()), _material(fields, numbers), option, row
                    )
                )
            elif head == "TBTEMP" and tables:
                tables[-1].tables += bool(tables[-1].values)
                tables[-1].last = 0
            elif head == "TBDATA" and tables and fields:
                tables[-1].fill(fields, row)
            elif head == "*SET" and len(fields) == 2 and fields[1].isdecimal():
                numbers[fields[0].upper()] = fields[1]
            elif (set_to := _PARAMETER.fullmatch(head)) and not fields:
                numbers[set_to["name"].rstrip()] = set_to["value"]
            elif head == "/UNITS" and fields and fields[0].upper() in _UNIT_SYSTEMS:
                unit = _UNIT_SYSTEMS[fields[0].upper()]
            elif head == "/UNITS" or (head and not head.startswith("/")):
                ignored.add(f"{head},{fields[0]}" if head in ("MP", "/UNITS") and fields else head)
    return properties, tables, ignored, unit


def _material(fields: list[str], numbers: dict[str, str]) -> str:
    """Return the number, or the parameter, of the material that a command is about."""
    given = (fields[1].upper() if len(fields) > 1 else "") or "1"
    return numbers.get(given, given)


def _property(fields: list[str], row: int) -> float:
    """Return the value of an MP command; a polynomial in the temperature is refused."""
    if any(one and _number(one, row) != 0.0 for one in fields[3:]):
        raise InputError(
            f"line {row}: MP,{fields[0].upper()} depends on temperature; give one value.", code="several-temperatures"
        )
    return _number(fields[2], row)


def _number(field_text: str, row: int) -> float:
    """Return the value of a field, which may be an arithmetic expression such as 273-5."""
    try:
        return number_in(field_text, bare=False)  # 2.0+3 is 5
    except ValueError:
        pass
    try:
        if len(field_text) > 60:
            raise ValueError
        return _value(ast.parse(field_text, mode="eval").body)
    except (ValueError, SyntaxError, ZeroDivisionError, OverflowError, MemoryError, RecursionError):
        raise InputError(
            f"line {row}: {field_text[:40]!r} is neither a number nor simple arithmetic.", code="not-a-number"
        ) from None


def _value(node: ast.expr) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)) and not isinstance(node.value, bool):
        return float(node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
        return _value(node.operand) * (-1.0 if isinstance(node.op, ast.USub) else 1.0)
    if isinstance(node, ast.BinOp) and type(node.op) in _ARITHMETIC:
        return _ARITHMETIC[type(node.op)](_value(node.left), _value(node.right))
    raise ValueError


def _pairs(table: _Table, reading: Reading) -> tuple[list[float], list[float]]:
    values = table.constants()
    if not values or len(values) % 2 or any(time <= 0.0 for time in values[1::2]):
        raise InputError(
            f"line {table.row}: TB,PRONY,…,{table.option} needs pairs of relative modulus and relaxation time > 0.",
            code="row-length",
        )
    return values[0::2], [time * reading.second for time in values[1::2]]


def _shift(
    table: _Table | None, reading: Reading, content: dict[str, Any] | None, notes: list[str]
) -> WLF | Arrhenius | None:
    if table is None:
        return None
    values = table.constants()
    if table.option == "WLF" and len(values) >= 3:
        reference = reading.kelvin(values[0], notes, number_of(content, "absolute_zero"))
        return WLF(values[1], values[2] * reading.degree(), reference)
    if table.option == "TN" and len(values) >= 2:
        # The law itself needs K.
        reference = values[0] if content else reading.kelvin(values[0], notes)
        return Arrhenius(values[1] * reading.degree() * GAS_CONSTANT, reference)
    if table.option in ("WLF", "TN"):
        raise InputError(
            f"line {table.row}: TB,SHIFT,…,{table.option} needs {3 if table.option == 'WLF' else 2} constants.",
            code="missing-constants",
        )
    notes.append(unread_shift(f"TB,SHIFT,…,{table.option or 'without option'}", table.option, values))
    return None
