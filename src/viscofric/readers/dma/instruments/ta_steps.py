"""Steps of a TA Instruments file: its tables as text, their signals as numbers, and which are frequency sweeps."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.readers.source import COMMA_NUMBER, Test, decimal_comma

#: What a column holds -> its names, in small letters.
ROLES = {
    "temperature": re.compile(r"(sample )?temperature"),
    "angular frequency": re.compile(r"ang(ular|\.)? frequency"),
    "frequency": re.compile(r"frequency"),
    "storage modulus": re.compile(r"((tensile|shear|young's) )?storage modulus( [eg]')?|[eg]'"),
    "loss modulus": re.compile(r"((tensile|shear|young's) )?loss modulus( [eg](''|\"))?|[eg](''|\")"),
    "tan delta": re.compile(r"tan ?\(?(delta|δ)\)?"),
    "strain": re.compile(r"oscillation strain"),
    "oscillation torque": re.compile(r"oscillation torque"),
    "oscillation force": re.compile(r"oscillation force"),
}

#: Steps that vary the amplitude are not frequency sweeps, even at several frequencies.
_AMPLITUDE = re.compile(r"amplitude|(strain|stress|force|displacement) sweep", re.IGNORECASE)
#: Relative range of the measured values of one set frequency; every sweep is wider.
_SAME_FREQUENCY = 0.05
#: A temperature ramp ranges over more than this (K or °C), an amplitude sweep over more than this factor.
RAMP, SWEPT = 5.0, 2.0


@dataclass(frozen=True, eq=False)
class Signal:
    """One column of a step as printed; NaN for an empty cell, or one without a finite number."""

    heading: str
    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class Step:
    """One step of an instrument's programme: its signals by role, and the place of each point (``"line 18"``).

    `named_by_instrument`: the name is that of a technique; names by users carry no information.
    """

    name: str
    signals: Mapping[str, Signal]
    places: tuple[str, ...]
    named_by_instrument: bool = True

    @property
    def frequency(self) -> Signal | None:
        """The angular frequency, or where there is none the frequency."""
        return self.signals.get("angular frequency") or self.signals.get("frequency")

    @property
    def has_moduli(self) -> bool:
        """Whether there are E' and E'' (or tan δ) and a frequency."""
        return (
            self.frequency is not None
            and "storage modulus" in self.signals
            and ("loss modulus" in self.signals or "tan delta" in self.signals)
        )

    def is_of(self, test: Test) -> bool:
        """Whether the step sweeps the frequency, the temperature or the strain amplitude, with moduli."""
        if test == "frequency":
            return self.is_frequency_sweep
        technique = self.name.lower() if self.named_by_instrument else ""
        signal = self.signals.get("strain" if test == "amplitude" else "temperature")
        if signal is None or not self.has_moduli:
            return False
        values = signal.values[np.isfinite(signal.values)]
        if test == "temperature":
            return bool(values.size and np.ptp(values) > RAMP and not _AMPLITUDE.search(technique))
        values = values[values > 0.0]
        return bool(values.size and values.max() > SWEPT * values.min())

    @property
    def is_frequency_sweep(self) -> bool:
        """Whether the step holds moduli at several frequencies, or is named a frequency sweep."""
        technique = self.name.lower() if self.named_by_instrument else ""
        if self.frequency is None or not self.has_moduli or _AMPLITUDE.search(technique):
            return False
        values = self.frequency.values[self.frequency.values > 0]
        several = values.size > 0 and values.max() > (1.0 + _SAME_FREQUENCY) * values.min()
        return bool(several or (values.size and "frequency" in technique))


def roles(names: Sequence[str]) -> dict[str, int]:
    """Return the place of the first column of each role in `ROLES`."""
    places: dict[str, int] = {}
    for place, name in enumerate(names):
        plain = " ".join(re.sub(r"[’′‘`´]", "'", name).replace("″", "''").lower().split())
        for role, pattern in ROLES.items():
            if pattern.fullmatch(plain):
                places.setdefault(role, place)
    return places


_NUMBER = re.compile(r"\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?\s*")


@dataclass
class Table:
    """One step as printed; rows have a line number from 1, and may be shorter than the list of names."""

    name: str
    names: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    rows: list[tuple[int, list[str]]] = field(default_factory=list)


def steps_of(path: str, tables: Sequence[Table], also: Mapping[str, str] | None = None) -> list[Step]:
    """Return steps of numbers from all tables of a file, which share one decimal mark."""
    found = []
    for table in tables:
        places = roles([(also or {}).get(name.strip().lower(), name) for name in table.names])
        if "storage modulus" in places:
            _insist_on_columns(path, table)
        found.append((table, places))
    comma = _decimal_comma(path, found)
    return [_step(table, places, comma) for table, places in found]


def _insist_on_columns(path: str, table: Table) -> None:
    """Refuse rows that are longer than their header: columns and names no longer belong together."""
    columns = max(len(table.names), len(table.units))
    for line, cells in table.rows:
        if len(cells) > columns and any(cell.strip() for cell in cells[columns:]):
            problem = f"the row has {len(cells)} cells where step {table.name!r} names {columns} columns."
            raise DataFileError(path, problem, line, code="row-length")


def _decimal_comma(path: str, found: Sequence[tuple[Table, dict[str, int]]]) -> bool:
    numbers = [
        (cells[place], line)
        for table, places in found
        for line, cells in table.rows
        for place in places.values()
        if place < len(cells)
    ]
    comma = next((line for cell, line in numbers if COMMA_NUMBER.fullmatch(cell)), None)
    point = next((line for cell, line in numbers if "." in cell), None)
    if comma and point:
        problem = f"decimals have a comma here and a point in line {point}; write all of them in one way."
        raise DataFileError(path, problem, comma, code="mixed-decimals")
    return decimal_comma(path, numbers)


def _step(table: Table, places: Mapping[str, int], comma: bool) -> Step:
    signals = {}
    for role, place in places.items():
        values = np.array([_number(cells[place] if place < len(cells) else "", comma) for _, cells in table.rows])
        unit = table.units[place].strip() if place < len(table.units) else ""
        signals[role] = Signal(table.names[place].strip(), unit, values.astype(float))
    return Step(table.name, signals, tuple(f"line {line}" for line, _ in table.rows))


def _number(cell: str, comma: bool) -> float:
    """Return a finite number, or NaN; ``inf``, ``nan`` and ``1_000`` are no numbers of an instrument."""
    plain = cell.replace("−", "-")
    if comma:
        plain = plain.replace(",", ".")
    number = float(plain) if _NUMBER.fullmatch(plain) else math.nan
    return number if math.isfinite(number) else math.nan
