"""Mettler-Toledo DMA text exports: columns of fixed width under a row of names and a row of units in brackets.

Ts is the temperature of the sample, Tr that of the programme; f, x and Phase belong to the oscillation.  One file
holds one temperature or several blocks, each numbered from 0 anew.  Tried on genuine files in tension and shear.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.names import DMA, quantity
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_export
from viscofric.readers.headings import with_primes
from viscofric.readers.source import Source, decimal_comma
from viscofric.readers.table import Table, instrument_table

NAME = "Mettler-Toledo DMA text"

_UNIT = re.compile(r"\[[^\[\]]*\]")
_WORD = re.compile(r"\S+")
_QUANTITIES = {"Ts": "temperature", "tan_delta": "tan delta"}
_KNOWN = (*_QUANTITIES, "f", "E'", "G'", "E''", "G''", "E*", "G*")
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
    names = with_primes(line).split()
    return names[:1] == ["Index"] and {"Ts", "f"} <= set(names) and bool({"E'", "G'"} & set(names))


def read(source: Source) -> Readings:
    """Return the points, or raise `DataFileError` for a missing column, a wrong unit or a damaged row."""
    blocks = _blocks(source)
    numbered = [one for block in blocks for one in zip(block.rows, block.lines, strict=True)]
    comma = decimal_comma(source.path, ((cell, line) for row, line in numbered for cell in row))
    tables = [_table(source.path, block, comma) for block in blocks]
    whole = read_export(tables, source, NAME, "some blocks")
    notes = whole.notes
    if "x" in blocks[0].names:
        said = "The amplitude x is a displacement and the sample's length is missing, so the strain is unknown."
        notes = (*notes, Note("strain-unknown", said))
    steps = np.array([step for block in blocks for step in block.steps], dtype=np.int64)
    return replace(whole, step=steps, notes=notes)


def _table(path: str, block: _Block, comma: bool) -> Table:
    known = {name: _QUANTITIES.get(name) or quantity(name) or "" for name in _KNOWN}
    columns = [
        (name, unit.strip("[] ") if name != "tan_delta" else "", known.get(name, ""))
        for name, unit in zip(block.names, block.units, strict=True)
    ]
    return instrument_table(path, columns, list(zip(block.lines, block.rows, strict=True)), DMA, comma)


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
            names = with_primes(line).split()
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
