"""Steps of a TA Instruments file: tables of the columns that a sweep needs, and the points of all sweeps among them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.names import DMA, is_load
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_export
from viscofric.readers.headings import Column, with_primes
from viscofric.readers.source import Decimals, Source, Test
from viscofric.readers.table import Table
from viscofric.showing import several

#: Tests in words.
TESTS = {"frequency": "frequency sweep", "temperature": "temperature ramp", "amplitude": "amplitude sweep"}
#: Quantities of columns that are read.
_READ = frozenset(
    {"temperature", "angular frequency", "frequency", "storage modulus", "loss modulus", "tan delta"}
    | {"strain amplitude"}
)

#: Steps that vary the amplitude are not frequency sweeps, even at several frequencies.
_AMPLITUDE = re.compile(r"amplitude|(strain|stress|force|displacement) sweep", re.IGNORECASE)
#: Relative range of the measured values of one set frequency; every sweep is wider.
_SAME_FREQUENCY = 0.05
#: Number of names that are listed.
_NAMED = 6
#: A temperature ramp ranges over more than this (K or °C), an amplitude sweep over more than this factor.
RAMP, SWEPT = 5.0, 2.0


@dataclass(frozen=True, eq=False)
class Step:
    """One step of an instrument's programme: its columns by role, and what the numbers of its rows count.

    `named_by_instrument`: the name is that of a technique; names by users carry no information.
    """

    name: str
    table: Table
    where: str = "line"
    named_by_instrument: bool = True

    def values(self, *roles: str) -> Array | None:
        """Return the first of some columns that there is, as printed; NaN for a cell without a finite number."""
        return next((self._numbers[role] for role in roles if role in self._numbers), None)

    @cached_property
    def _numbers(self) -> dict[str, Array]:
        columns = enumerate(self.table.columns)
        return {column.quantity: self.table.numbers_or_missing(place) for place, column in columns}

    @property
    def needed(self) -> list[Array | None]:
        """Frequency, storage modulus, and loss modulus or tan δ, as printed."""
        wanted = (("angular frequency", "frequency"), ("storage modulus",), ("loss modulus", "tan delta"))
        return [self.values(*roles) for roles in wanted]

    @property
    def has_moduli(self) -> bool:
        """Whether there are E' and E'' (or tan δ) and a frequency."""
        return all(values is not None for values in self.needed)

    def is_of(self, test: Test) -> bool:
        """Whether the step sweeps the frequency, the temperature or the strain amplitude, with moduli."""
        if test == "frequency":
            return self.is_frequency_sweep
        technique = self.name.lower() if self.named_by_instrument else ""
        values = self.values("strain amplitude" if test == "amplitude" else "temperature")
        if values is None or not self.has_moduli:
            return False
        values = values[np.isfinite(values)]
        if test == "temperature":
            return bool(values.size and np.ptp(values) > RAMP and not _AMPLITUDE.search(technique))
        values = values[values > 0.0]
        return bool(values.size and values.max() > SWEPT * values.min())

    @property
    def is_frequency_sweep(self) -> bool:
        """Whether the step holds moduli at several frequencies, or is named a frequency sweep."""
        technique = self.name.lower() if self.named_by_instrument else ""
        frequency = self.needed[0]
        if frequency is None or not self.has_moduli or _AMPLITUDE.search(technique):
            return False
        values = frequency[frequency > 0]
        several = values.size > 0 and values.max() > (1.0 + _SAME_FREQUENCY) * values.min()
        return bool(several or (values.size and "frequency" in technique))

    @property
    def usable(self) -> Mask:
        """Which rows have numbers for temperature and moduli, and a frequency above zero."""
        columns = [values for values in (*self.needed, self.values("temperature")) if values is not None]
        return np.asarray(np.all(np.isfinite(columns), axis=0) & (columns[0] > 0.0))

    def taken(self, rows: Mask) -> Step:
        """Return the step with some of its rows."""
        kept = np.flatnonzero(rows)
        table = replace(self.table, rows=tuple(self.table.rows[row] for row in kept), lines=self.table.lines[kept])
        return replace(self, table=table)

    @property
    def places(self) -> list[str]:
        """The place of each row in words: ``"line 18"``."""
        return [f"{self.where} {line}" for line in self.table.lines]


def roles(names: Sequence[str]) -> dict[str, int]:
    """Return the first column of each quantity that is read, and of torque and force; "oscillation …" come first."""
    places: dict[str, int] = {}
    for place, name in sorted(enumerate(names), key=lambda one: not one[1].strip().lower().startswith("oscillation")):
        plain = " ".join(with_primes(name).split())
        what = DMA.quantity(plain)
        if what in _READ or is_load(plain):
            places.setdefault(what or plain, place)
    return places


_NUMBER = re.compile(r"\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?\s*")


@dataclass
class StepText:
    """One step as printed; rows have a line number from 1, and may be shorter than the list of names."""

    name: str
    names: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    rows: list[tuple[int, list[str]]] = field(default_factory=list)


def steps_of(path: str, texts: Sequence[StepText], where: str = "line") -> list[Step]:
    """Return the steps of a file, which share one decimal mark; rows count `where`."""
    found = []
    for text in texts:
        places = roles(text.names)
        if "storage modulus" in places:
            _insist_on_columns(path, text)
        found.append((text, places))
    numbers = [
        (row[place], line)
        for text, places in found
        for line, row in text.rows
        for place in places.values()
        if place < len(row)
    ]
    decimals = Decimals.of(path, numbers)
    return [Step(text.name, _table(path, text, places, decimals), where) for text, places in found]


def _insist_on_columns(path: str, table: StepText) -> None:
    """Refuse rows that are longer than their header: columns and names no longer belong together."""
    columns = max(len(table.names), len(table.units))
    for line, cells in table.rows:
        if len(cells) > columns and any(cell.strip() for cell in cells[columns:]):
            problem = f"the row has {len(cells)} cells where step {table.name!r} names {columns} columns."
            raise DataFileError(path, problem, line, code="row-length")


def _table(path: str, text: StepText, places: Mapping[str, int], decimals: Decimals) -> Table:
    """Return the columns that have a number; a cell that is no number of an instrument, such as ``1_000``, is empty."""
    cells = {
        role: [_plain(row[place], decimals) if place < len(row) else "" for _, row in text.rows]
        for role, place in places.items()
    }
    columns = []
    for role in (held := [role for role in cells if any(cells[role]) or not text.rows]):
        name = text.names[places[role]].strip()
        unit = text.units[places[role]].strip() if places[role] < len(text.units) and role != "tan delta" else ""
        columns.append(Column(name, name, unit, role))
    rows = tuple(zip(*(cells[role] for role in held), strict=True)) if held else ((),) * len(text.rows)
    lines = np.array([line for line, _ in text.rows], dtype=np.int64)
    return Table(f"{path}, step {text.name!r}", tuple(columns), rows, lines, vocabulary=DMA)


def _plain(cell: str, decimals: Decimals) -> str:
    plain = decimals.plain(cell.replace("−", "-"))
    return plain if _NUMBER.fullmatch(plain) and np.isfinite(float(plain)) else ""


def readings_of(
    source: Source, kind: str, steps: Sequence[Step], tools: Sequence[tuple[str, str]], notes: Sequence[str]
) -> Readings:
    """Return the points of all sweeps, of what the source says, among the steps of a file."""
    swept = [step.is_of(source.test) for step in steps]
    sweeps = [(number, step) for number, (step, one) in enumerate(zip(steps, swept, strict=True), start=1) if one]
    if not sweeps:
        problem = f"contains no {TESTS[source.test]} of an oscillation; {_contents(steps)}."
        raise DataFileError(source.path, problem, code=f"no-{TESTS[source.test].replace(' ', '-')}")
    notes = [*notes, *_passed_over([step for step, one in zip(steps, swept, strict=True) if not one], source.test)]
    left_out = [place for _, step in sweeps for place in step.taken(~step.usable).places]
    if left_out:
        points = "1 point was" if len(left_out) == 1 else f"{len(left_out)} points were"
        want = "without a number for temperature, modulus or frequency (above zero)"
        notes.append(Note("points-left-out", f"{points} left out, {want}: {several(left_out, _NAMED)}."))
    used = [(number, step.taken(step.usable)) for number, step in sweeps if step.usable.any()]
    if not used:
        problem = "no point of its frequency sweeps has all of temperature, frequency and moduli."
        raise DataFileError(source.path, problem, code="no-points")
    tables = [step.table for _, step in used]
    with np.errstate(all="ignore"):  # of products that overflow
        whole = read_export(tables, source, kind, "the steps", used[0][1].where, tools)
    step = np.repeat([number for number, _ in used], [len(table.rows) for table in tables]).astype(np.int64)
    whole = replace(whole, step=step, notes=tuple(dict.fromkeys((*notes, *whole.notes))))
    return whole.taken(np.flatnonzero(whole.complete))


def _contents(steps: Sequence[Step]) -> str:
    """Return in words what there is instead of a frequency sweep."""
    if not steps:
        return "it has no steps with data"
    names = [repr(step.name) for step in steps]
    have = [repr(step.name) for step in steps if step.has_moduli]
    listed = f"its step{' is' if len(steps) == 1 else 's are'} {several(names, _NAMED)}"
    if not have:
        return f"{listed}, without moduli"
    which = "" if have == names else f" of which {several(have, _NAMED)}"
    return f"{listed},{which} with moduli, but not over frequency"


def _passed_over(steps: Sequence[Step], test: Test) -> list[str]:
    others = [repr(step.name) for step in steps]
    if not others:
        return []
    what = f"1 step that is not {'an' if test == 'amplitude' else 'a'} {TESTS[test]} was"
    if len(others) > 1:
        what = f"{len(others)} steps that are not {TESTS[test]}s were"
    values = {"steps": [step.name for step in steps]}
    return [Note(f"no-{TESTS[test].replace(' ', '-')}", f"{what} skipped: {several(others, _NAMED)}.", values=values)]
