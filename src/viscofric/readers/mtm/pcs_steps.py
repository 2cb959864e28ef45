"""Text exports of PCS Instruments' MTM and ETM: their steps, header lines, times and tables of cells."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

import numpy as np

from viscofric.errors import DataFileError
from viscofric.readers.header_rows import is_number
from viscofric.readers.headings import Column, Vocabulary, heading
from viscofric.readers.source import Decimals
from viscofric.readers.table import Table

_START = re.compile(r"\s*Step\s+(\d{1,6})(?:\s+\"[^\"]{0,200}\")?\s+started\s+at\b(.*)", re.IGNORECASE)
#: Column -> SI unit, "" of a number.
UNITS = {
    "step time": "s",
    "pot rtd temp": "K",
    "lube rtd temp": "K",
    "ball load": "N",
    "pin load": "N",
    **{f"{body} speed {place}": "m/s" for body in ("ball", "disc") for place in (1, 2, 3, 4)},
    "sliding speed": "m/s",
    **dict.fromkeys(("tf1", "tf2", "tf3", "tf4"), "N"),
    "traction force": "N",
    "traction coeff": "",
}
_ALSO = {
    "lube rtd temp": {"lube temp", "lubricant temp"},
    "pot rtd temp": {"pot temp"},
    **{f"tf{place}": {f"traction force {place}"} for place in (1, 2, 3, 4)},  # as an EHD rig names them
    "ball speed 1": {"ball speed"},
    "disc speed 1": {"disc speed"},
    "rolling speed": set(),
}


def _spelt(names: set[str]) -> frozenset[str]:
    return frozenset(
        one.replace("disc", disc).replace("temp", temp)
        for one in names
        for disc in ("disc", "disk")
        for temp in ("temp", "temperature")
    )


_WORDS = Vocabulary(
    "a traction test", {one: _spelt({one, *_ALSO.get(one, ())}) for one in (*UNITS, "rolling speed")}, ()
)


@dataclass(eq=False)
class Block:
    """One table of a step, still as text; `first` is the number of its first row within the step."""

    columns: tuple[Column, ...]
    first: int
    rows: list[list[str]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)


@dataclass(eq=False)
class Step:
    """One step: number and start as printed, its header (label, value, line by key) and its tables."""

    number: int
    started: str
    line: int
    header: dict[str, tuple[str, str, int]] = field(default_factory=dict)
    blocks: list[Block] = field(default_factory=list)

    def word(self, key: str) -> str:
        """Return the value of a header line, or an empty text."""
        return self.header[key][1] if key in self.header else ""

    @property
    def rows(self) -> int:
        """Number of rows of its tables."""
        return sum(len(block.rows) for block in self.blocks)


@dataclass(eq=False)
class Export:
    """One export: its header, its steps, remarks between them, and the place of a last row that is cut off."""

    path: str
    header: dict[str, str] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    cut: str = ""
    decimals: Decimals = field(default_factory=Decimals)


def parse(path: str, text: str) -> Export:
    """Return the parts of an export, or raise `DataFileError`."""
    export = Export(path)
    layouts: dict[str, tuple[Column, ...] | None] = {}
    lines = text.splitlines()
    for number, line in enumerate(lines, start=1):
        if not line.strip():
            continue
        start = _START.fullmatch(line) if "\t" not in line else None
        if start:
            export.steps.append(Step(int(start[1]), start[2].strip(), number))
            continue
        cells = line.split("\t")
        if not export.steps:
            export.header[_key(cells[0])] = next((cell.strip() for cell in cells[1:] if cell.strip()), "")
            if line.lower().startswith("test started at"):
                export.header["test started"] = line[len("test started at") :].strip()
            continue
        step = export.steps[-1]
        if len(cells) > 2 and line.lstrip()[:1].isalpha():
            if line not in layouts:
                layouts[line] = _columns(cells)
            layout = layouts[line]
            if layout is not None:
                if not step.blocks or step.blocks[-1].columns is not layout:  # else headings are repeated
                    step.blocks.append(Block(layout, step.rows + 1))
                continue
        if not _is_header_line(path, step, number, cells):
            _take_row(export, step, number, cells, last=number == len(lines))
    _insist_on_width(export)
    numbers = (
        (cell, line)
        for step in export.steps
        for block in step.blocks
        for row, line in zip(block.rows, block.lines, strict=True)
        for cell, column in zip(row, block.columns, strict=False)
        if column.quantity
    )
    export.decimals = Decimals.of(path, numbers)
    return export


def at(step: Step, row: int) -> str:
    """Return the place of a row, counted from 1 within its step, as the beginning of a sentence."""
    return f"step {step.number}, row {row}: "


def table_of(export: Export, step: Step, columns: Sequence[Column], rows: list[list[str]], lines: list[int]) -> Table:
    """Return rows of a step under their columns."""
    path, cells = f"{export.path}, step {step.number}", tuple(tuple(map(export.decimals.plain, row)) for row in rows)
    return Table(path, tuple(columns), cells, np.array(lines, dtype=np.int64), vocabulary=_WORDS)


def _key(cell: str) -> str:
    return " ".join(cell.strip().rstrip(":").lower().split())


def _is_header_line(path: str, step: Step, line: int, cells: list[str]) -> bool:
    """Store a header line of the step (``Step type``, zero force, track radius), and return whether it is one."""
    named = len(cells) > 1 and cells[0].lstrip()[:1].isalpha()
    key = heading(cells[0]).name.lower() if named else ""
    if key != "step type" and not key.startswith(("zero traction force", "disc track radius", "disk track radius")):
        return False
    if key == "step type" and (step.blocks or key in step.header):
        problem = f"step {step.number}: a second step type; is the line 'Step … started at' before it missing?"
        raise DataFileError(path, problem, line, code="step-type-twice")
    step.header[key.replace("disk", "disc").split(" used for")[0]] = (cells[0], cells[1].strip(), line)
    if key == "step type":
        for name, value in zip(cells[2::2], cells[3::2], strict=False):
            step.header[_key(name)] = (name, value.strip(), line)
    return True


def _columns(cells: list[str]) -> tuple[Column, ...] | None:
    """Return the columns of a row of headings, None for another row."""
    found = [_WORDS.column(cell) for cell in cells]
    # The first column repeats one of the others: the last of a name is the one in its own place.
    last = {column.quantity: place for place, column in enumerate(found)}
    if len(last.keys() & UNITS.keys()) < 2:
        return None
    speeds = [column.unit for name in ("sliding speed", "rolling speed") for column in found if column.quantity == name]
    speed = next(filter(None, reversed(speeds)), "mm/s")
    for place, column in enumerate(found):
        unit = column.unit or (speed if UNITS.get(column.quantity) == "m/s" else "")
        found[place] = replace(column, unit=unit, quantity=column.quantity if last[column.quantity] == place else "")
    return tuple(found)


def _take_row(export: Export, step: Step, number: int, cells: list[str], *, last: bool) -> None:
    """Store a row of cells, or a remark."""
    if not step.blocks or (len(cells) == 1 and not is_number(cells[0])):
        export.remarks.append("\t".join(cells).strip())
        return
    block = step.blocks[-1]
    if len(cells) > len(block.columns):
        problem = f"{at(step, step.rows + 1)}{len(cells)} cells where the header names {len(block.columns)} columns."
        raise DataFileError(export.path, problem, number, code="row-length")
    width = len(block.rows[-1]) if block.rows else len(block.columns)
    if last and len(cells) < width:
        export.cut = f"step {step.number}, row {step.rows + 1}"
        return
    block.rows.append(cells)
    block.lines.append(number)


def _insist_on_width(export: Export) -> None:
    """Refuse rows that are cut short; empty last cells may be missing in all rows alike."""
    for step in export.steps:
        for block in step.blocks:
            widths = [len(row) for row in block.rows]
            common = max(set(widths), key=widths.count, default=0)
            needed = max(place for place, column in enumerate(block.columns) if column.quantity)
            short = next((i for i, width in enumerate(widths) if width != common or width <= needed), None)
            if short is not None:
                problem = (
                    f"{at(step, block.first + short)}{widths[short]} cells where the header names "
                    f"{len(block.columns)} columns."
                )
                raise DataFileError(export.path, problem, block.lines[short], code="row-length")


_PRINTED = re.compile(
    r"(\d{1,4})[/.-](\d{1,2})[/.-](\d{1,4})[ T]+(\d{1,2}):(\d{2})(?::(\d{2}))?(?:[.,]\d+)?\s*([AP]M)?", re.IGNORECASE
)
_FIRST_YEAR, _LAST_YEAR = 1970, 2200


def start_times(printed: Sequence[str]) -> list[datetime | None]:
    """Return when steps began, from date and time as printed (``"23/03/2018 10:12:01"``), None if unreadable."""
    # The day precedes the month, as in all samples, unless only the other order makes dates of all of them.
    day_first = [_moment(text, 0, 1) for text in printed]
    month_first = [_moment(text, 1, 0) for text in printed]
    return month_first if month_first.count(None) < day_first.count(None) else day_first


def _moment(text: str, day: int, month: int) -> datetime | None:
    found = _PRINTED.fullmatch(text.strip())
    if not found:
        return None
    date = [int(found[place]) for place in (1, 2, 3)]
    if len(found[1]) == 4:  # 2018-03-23
        year, parts = date[0], [date[2], date[1]]
    else:
        year, parts = date[2] + (2000 if date[2] < 100 else 0), date[:2]
    hour = int(found[4])
    if found[7]:
        if not 1 <= hour <= 12:
            return None
        hour = hour % 12 + (12 if found[7].upper() == "PM" else 0)
    if not _FIRST_YEAR <= year <= _LAST_YEAR:
        return None
    try:
        return datetime(year, parts[month], parts[day], hour, int(found[5]), int(found[6] or 0))
    except ValueError:
        return None
