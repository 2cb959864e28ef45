"""Mettler-Toledo DMA text exports: columns of fixed width under a row of names and a row of units in brackets.

Ts is the temperature of the sample, Tr that of the programme; f, x and Phase belong to the oscillation.  One file
holds one temperature or several blocks, each numbered from 0 anew.  Tried on genuine files in tension and shear.
"""

from __future__ import annotations

import re
from dataclasses import replace

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.names import DMA
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.headings import with_primes
from viscofric.readers.source import Source
from viscofric.readers.tables import find_tables

NAME = "Mettler-Toledo DMA text"

_WORDS = {"temperature": frozenset({"Ts"}), "frequency": frozenset({"f"}), "step": frozenset({"Index"})}
_METTLER = replace(DMA, quantities={**DMA.quantities, **_WORDS})
_UNIT = re.compile(r"\[[^\[\]]*\]")
#: Names and units stand within the first lines; what comes before is empty.
_FIRST_LINES = 10


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
    table = find_tables(_delimited(source), _METTLER)[""]
    whole = read_points(table, source, NAME, "", exported=True)
    if all(column.name != "x" for column in table.columns):
        return whole
    said = "The amplitude x is a displacement and the sample's length is missing, so the strain is unknown."
    return replace(whole, notes=(*whole.notes, Note("strain-unknown", said)))


def _delimited(source: Source) -> Source:
    """Return the file with tabs between its cells, and the number of its step in place of the index of each point."""
    # Lines below a table (the method's name) become empty, so that all keep their numbers.
    lines: list[str] = []
    ends: list[int] = []
    step, previous = -1, -1
    for number, line in enumerate((source.text or "").splitlines(), start=1):
        cells = with_primes(line).split()
        if _is_header(line):
            ends = [word.end() for word in re.finditer(r"\S+", line)]
            step, previous = step + 1, -1
        elif ends and cells and cells[0].isdecimal():
            if len(cells) != len(ends) and len(line.rstrip()) == ends[-1]:
                # A cell is blank: columns end with their names.
                cells = [line[start:end].strip() for start, end in zip([0, *ends], ends, strict=False)]
            if not re.fullmatch(r"\d{1,9}", cells[0]):
                problem = f"{cells[0]!r} in column 'Index' is not a whole number."
                raise DataFileError(source.path, problem, number, code="not-a-number")
            step, previous = step + (int(cells[0]) <= previous), int(cells[0])
            cells[0] = str(step)
        elif not line.lstrip().startswith("["):
            cells = []
        lines.append("\t".join(cells))
    return replace(source, data="\n".join(lines).encode(), columns={})
