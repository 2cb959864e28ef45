"""Mettler-Toledo DMA text exports: columns of fixed width under a row of names and a row of units in brackets.

Ts is the temperature of the sample, Tr that of the programme; f, x and Phase belong to the oscillation.  One file
holds one temperature or several blocks, each numbered from 0 anew.  Tried on genuine files in tension and shear.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Deformation
from viscofric.errors import DataFileError, InputError
from viscofric.notes import Note
from viscofric.readers.dma.checks import insist_on_agreement
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import LARGEST_FACTOR, Source, decimal_comma, unit_conversion

NAME = "Mettler-Toledo DMA text"

_UNIT = re.compile(r"\[[^\[\]]*\]")
_WORD = re.compile(r"\S+")
#: Names and units stand within the first lines; what comes before is empty.
_FIRST_LINES = 10


@dataclass
class _Block:
    """Rows of numbers under one pair of header lines."""

    names: list[str]
    ends: list[int]
    units: list[str]
    rows: list[list[str]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)
    steps: list[int] = field(default_factory=list)


def recognises(source: Source) -> bool:
    """Return whether names such as Index, Ts and f precede units in brackets."""
    if source.text is None:
        return False
    first = [line for line in source.text[:5000].splitlines()[:_FIRST_LINES] if line.strip()]
    return len(first) > 1 and _is_header(first[0]) and len(_UNIT.findall(first[1])) == len(first[0].split())


def _is_header(line: str) -> bool:
    names = _primes(line).split()
    return names[:1] == ["Index"] and {"Ts", "f"} <= set(names) and bool({"E'", "G'"} & set(names))


def _primes(text: str) -> str:
    return re.sub(r"[’′‘`´]", "'", text).replace('"', "''").replace("″", "''").replace("”", "''")


def read(source: Source) -> Readings:
    """Return the points, or raise `DataFileError` for a missing column, a wrong unit or a damaged row."""
    blocks = _blocks(source)
    letters = {letter for block in blocks for letter in "EG" if f"{letter}'" in block.names}
    if len(letters) != 1:
        raise DataFileError(
            source.path,
            "some blocks hold E', others G'; split the file by deformation.",
            code="deformation-contradicts",
        )
    letter = letters.pop()
    deformation: Deformation = "tension" if letter == "E" else "shear"
    columns = [
        np.concatenate([_column(source.path, block, name, unit) for block in blocks])
        for name, unit in (("Ts", "K"), ("f", "Hz"), (f"{letter}'", "Pa"), (f"{letter}''", "Pa"))
    ]
    temperature, frequency, storage, loss = columns
    printed = {
        name: np.concatenate([_column(source.path, block, name, unit) for block in blocks])
        for name, unit in (("tan_delta", ""), (f"{letter}*", "Pa"))
        if all(name in block.names for block in blocks)
    }
    insist_on_agreement(source.path, storage, loss, printed.get("tan_delta"), printed.get(f"{letter}*"))
    lines = [line for block in blocks for line in block.lines]
    for values, name in ((temperature, "Ts"), (frequency, "f")):
        if np.any(values <= 0.0):
            bound = "absolute zero" if name == "Ts" else "zero"
            row = int(np.argmax(values <= 0.0))
            raise DataFileError(
                source.path, f"the number in column {name!r} must be above {bound}.", lines[row], code="not-positive"
            )
    notes = []
    if "x" in blocks[0].names:
        said = "The amplitude x is a displacement and the sample's length is missing, so the strain is unknown."
        notes.append(Note("strain-unknown", said))
    return Readings(
        source.path,
        NAME,
        tuple(f"line {line}" for line in lines),
        temperature,
        2.0 * math.pi * frequency,
        storage,
        loss,
        deformation,
        f"the heading {letter}' {blocks[0].units[blocks[0].names.index(letter + chr(39))]}",
        None,
        np.array([step for block in blocks for step in block.steps], dtype=np.int64),
        tuple(notes),
    )


def _blocks(source: Source) -> list[_Block]:
    """Split the text into blocks; lines below a table (the method's name) are not rows of numbers."""
    blocks: list[_Block] = []
    step, previous = -1, -1
    lines = iter(enumerate((source.text or "").splitlines(), start=1))
    for number, line in lines:
        if not line.strip():
            continue
        if _is_header(line):
            units = _UNIT.findall(next(lines, (0, ""))[1])
            names = _primes(line).split()
            if len(units) != len(names):
                raise DataFileError(
                    source.path, "each name must have a unit in brackets below it.", number + 1, code="wrong-unit"
                )
            blocks.append(_Block(names, [word.end() for word in _WORD.finditer(line)], units))
            previous = -1
            step += 1
        elif blocks and re.fullmatch(r"\d+", line.split()[0]):
            cells = _cells(line, blocks[-1], source.path, number)
            if not re.fullmatch(r"\d{1,9}", cells[0]):
                raise DataFileError(
                    source.path, f"{cells[0]!r} in column 'Index' is not a whole number.", number, code="not-a-number"
                )
            index = int(cells[0])
            step, previous = step + (index <= previous), index
            blocks[-1].rows.append(cells)
            blocks[-1].lines.append(number)
            blocks[-1].steps.append(step)
    blocks = [block for block in blocks if block.rows]
    if not blocks:
        raise DataFileError(source.path, "there is a header, but no row of numbers under it.", code="no-points")
    numbered = [one for block in blocks for one in zip(block.rows, block.lines, strict=True)]
    decimal_comma(source.path, ((cell, line) for row, line in numbered for cell in row))
    return blocks


def _cells(line: str, block: _Block, path: str, number: int) -> list[str]:
    cells = line.split()
    if len(cells) != len(block.names) and len(line.rstrip()) == block.ends[-1]:
        # A cell is blank: columns end with their names.
        cells = [line[start:end].strip() for start, end in zip([0, *block.ends], block.ends, strict=False)]
    if len(cells) != len(block.names):
        problem = f"the row has {len(cells)} cells where the header names {len(block.names)} columns."
        raise DataFileError(path, problem, number, code="row-length")
    return cells


def _column(path: str, block: _Block, name: str, unit: str) -> Array:
    if name not in block.names:
        raise DataFileError(
            path, f"there is no column {name!r}, only {', '.join(block.names)}.", code="missing-columns"
        )
    place = block.names.index(name)
    values = []
    for row, line in zip(block.rows, block.lines, strict=True):
        try:
            value = float(row[place].replace(",", "."))
        except ValueError:
            value = math.nan
        if not math.isfinite(value * LARGEST_FACTOR) or "_" in row[place]:
            raise DataFileError(
                path, f"{row[place]!r} in column {name!r} is not a finite number.", line, code="not-a-number"
            )
        values.append(value)
    text = block.units[place].strip("[] ")
    if not unit:
        return np.array(values)
    try:
        factor, offset = unit_conversion(text, unit, name)
    except InputError:
        example = {"K": "°C", "Pa": "MPa"}.get(unit, unit)
        raise DataFileError(
            path, f"column {name!r} has the unit {text!r}; it must be like {example!r}.", code="wrong-unit"
        ) from None
    return np.asarray(factor * np.array(values) + offset)
