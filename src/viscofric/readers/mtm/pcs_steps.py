"""Text exports of PCS Instruments' MTM and ETM: their steps, header lines, times and tables of cells."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from datetime import datetime

from viscofric.errors import DataFileError, InputError
from viscofric.readers.headings import heading
from viscofric.readers.source import decimal_comma, unit_conversion
from viscofric.readers.table import MISSING

_START = re.compile(r"\s*Step\s+(\d{1,6})(?:\s+\"[^\"]{0,200}\")?\s+started\s+at\b(.*)", re.IGNORECASE)
NUMBER = re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?\s*", re.ASCII)
#: Above every force, speed, temperature or time of a tribometer, in printed units.
LARGEST = 1e9
_NUMBERED = tuple(f"{what} {place}" for what in ("ball speed", "disc speed") for place in (1, 2, 3, 4))
#: Column -> SI unit.
UNITS = {
    "step time": "s",
    "pot rtd temp": "K",
    "lube rtd temp": "K",
    "ball load": "N",
    "pin load": "N",
    **dict.fromkeys(_NUMBERED, "m/s"),
    "sliding speed": "m/s",
    **dict.fromkeys(("tf1", "tf2", "tf3", "tf4"), "N"),
    "traction force": "N",
    "traction coeff": "",
}
_ALSO = {
    "lube temp": "lube rtd temp",
    "lubricant temp": "lube rtd temp",
    "pot temp": "pot rtd temp",
    **{f"traction force {place}": f"tf{place}" for place in (1, 2, 3, 4)},  # as an EHD rig names them
    "ball speed": "ball speed 1",
    "disc speed": "disc speed 1",
}
_SPEED_UNITS = ("rolling speed", "sliding speed")


@dataclass(frozen=True)
class Place:
    """A column of a table: its place, its heading, and the conversion to SI units."""

    place: int
    heading: str
    factor: float
    offset: float


@dataclass(frozen=True)
class Layout:
    """The number of columns of a table, and the known ones by name."""

    width: int
    places: dict[str, Place]


@dataclass(eq=False)
class Block:
    """One table of a step, still as text; `first` is the number of its first row within the step."""

    layout: Layout
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
    decimal_comma: bool = False


def parse(path: str, text: str) -> Export:
    """Return the parts of an export, or raise `DataFileError`."""
    export = Export(path)
    layouts: dict[str, Layout | None] = {}
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
                layouts[line] = _layout(path, step, number, cells)
            layout = layouts[line]
            if layout is not None:
                _begin(step, layout)
                continue
        if not _is_header_line(path, step, number, cells):
            _take_row(export, step, number, cells, last=number == len(lines))
    _insist_on_width(export)
    comma = any("," in cell for _, row, _ in _all_rows(export) for cell in row)
    export.decimal_comma = comma and decimal_comma(path, ((c, line) for _, row, line in _all_rows(export) for c in row))
    return export


def at(step: Step, row: int) -> str:
    """Return the place of a row, counted from 1 within its step, as the beginning of a sentence."""
    return f"step {step.number}, row {row}: "


def number_of(export: Export, cell: str, where: str, line: int) -> float | None:
    """Return a cell as a number, None if it is missing, or raise `DataFileError`."""
    if not NUMBER.fullmatch(cell):
        if cell.strip().lower() in MISSING:
            return None
        plain = cell.replace(",", ".", 1) if export.decimal_comma and "." not in cell else cell
        if not NUMBER.fullmatch(plain):
            raise DataFileError(
                export.path,
                f"{where} holds {cell.strip()[:40]!r}, which is not a finite number.",
                line,
                code="not-a-number",
            )
        cell = plain
    elif export.decimal_comma and "." in cell:
        problem = f"{where} holds {cell.strip()!r} with a point, but other numbers of the file have a comma; "
        raise DataFileError(
            export.path,
            problem + "write all decimals in one way, without thousands separators.",
            line,
            code="mixed-decimals",
        )
    value = float(cell)
    if abs(value) > LARGEST:
        raise DataFileError(
            export.path,
            f"{where} holds {cell.strip()!r}, which is too large for a measurement.",
            line,
            code="too-large",
        )
    return value


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


def _layout(path: str, step: Step, line: int, cells: list[str]) -> Layout | None:
    """Return the columns of a row of headings, None for another row."""
    found: dict[str, tuple[int, str, str]] = {}
    for place, cell in enumerate(cells):
        column = heading(cell)
        name = column.name.lower().replace("disk", "disc").replace("temperature", "temp")
        name = _ALSO.get(name, name)
        # The first column repeats one of the others: the last of a name is the one in its own place.
        found[name] = (place, cell.strip(), column.unit)
    if len(found.keys() & UNITS.keys()) < 2:
        return None
    speed = next((found[name][2] for name in _SPEED_UNITS if name in found and found[name][2]), "mm/s")
    places = {}
    for name in found.keys() & UNITS.keys():
        place, shown, unit = found[name]
        wanted = UNITS[name]
        unit = unit or (speed if wanted == "m/s" else "")
        said = f"step {step.number}: column {shown!r}"
        places[name] = Place(place, shown, *(unit_of(path, unit, wanted, said, line) if wanted else (1.0, 0.0)))
    return Layout(len(cells), places)


def unit_of(path: str, unit: str, wanted: str, said: str, line: int) -> tuple[float, float]:
    """Return factor and offset from a unit to one of SI; `said` is what has the unit."""
    try:
        return unit_conversion(unit, wanted, said)
    except InputError:
        example = {"K": "degC", "m/s": "mm/s", "m": "mm"}.get(wanted, wanted)
        problem = f"{said} must have a unit like {example!r}."
        raise DataFileError(path, problem, line, code="wrong-unit") from None


def _begin(step: Step, layout: Layout) -> None:
    """Begin a table, or continue the last one if its headings are repeated."""
    if not step.blocks or step.blocks[-1].layout is not layout:
        step.blocks.append(Block(layout, step.rows + 1))


def _take_row(export: Export, step: Step, number: int, cells: list[str], *, last: bool) -> None:
    """Store a row of cells, or a remark."""
    if not step.blocks or (len(cells) == 1 and not NUMBER.fullmatch(cells[0])):
        export.remarks.append("\t".join(cells).strip())
        return
    block = step.blocks[-1]
    if len(cells) > block.layout.width:
        problem = f"{at(step, step.rows + 1)}{len(cells)} cells where the header names {block.layout.width} columns."
        raise DataFileError(export.path, problem, number, code="row-length")
    width = len(block.rows[-1]) if block.rows else block.layout.width
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
            needed = max(place.place for place in block.layout.places.values())
            short = next((i for i, width in enumerate(widths) if width != common or width <= needed), None)
            if short is not None:
                problem = (
                    f"{at(step, block.first + short)}{widths[short]} cells where the header names "
                    f"{block.layout.width} columns."
                )
                raise DataFileError(export.path, problem, block.lines[short], code="row-length")


def _all_rows(export: Export) -> Iterator[tuple[Step, list[str], int]]:
    for step in export.steps:
        for block in step.blocks:
            for row, line in zip(block.rows, block.lines, strict=True):
                yield step, row, line


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
