"""All rows of an export as columns of numbers in SI units, with their places in the file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.readers.mtm.pcs_steps import LARGEST, NUMBER, UNITS, Export, at, number_of

if TYPE_CHECKING:
    from typing import NoReturn

    from viscofric.arrays import Array, Integers
    from viscofric.readers.mtm.pcs_steps import Block, Step

SIGNALS = ("tf1", "tf2", "tf3", "tf4")


@dataclass(frozen=True, eq=False)
class Rows:
    """The rows of an export: columns by name (NaN where empty), and step (its place), row and line of each."""

    export: Export
    columns: dict[str, Array]
    step: Integers
    row: Integers
    line: Integers

    def __len__(self) -> int:
        return len(self.step)

    def stacked(self, *names: str) -> Array:
        """Return columns below each other, (len(names), n)."""
        return np.stack([self.columns[name] for name in names])

    def at(self, place: int) -> str:
        """Say where a row stands, as the beginning of a sentence."""
        return at(self.export.steps[self.step[place]], int(self.row[place]))

    def insist(self, good: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], problem: str) -> None:
        """Refuse the file for the first row that is not good."""
        bad = np.flatnonzero(~good)
        if bad.size:
            self.refuse(int(bad[0]), problem)

    def refuse(self, place: int, problem: str) -> NoReturn:
        """Refuse the file for a row."""
        raise DataFileError(self.export.path, self.at(place) + problem, int(self.line[place]))


def rows_of(export: Export) -> Rows:
    """Turn the cells of an export into numbers, or raise `DataFileError` for the first that is none."""
    blocks = [(place, step, block) for place, step in enumerate(export.steps) for block in step.blocks if block.rows]
    empty = np.empty(0)

    def joined(parts: list[Array]) -> Array:
        return np.concatenate(parts) if parts else empty

    return Rows(
        export,
        {name: joined([_column(export, step, block, name) for _, step, block in blocks]) for name in UNITS},
        joined([np.full(len(block.rows), float(place)) for place, _, block in blocks]).astype(np.int64),
        joined([block.first + np.arange(float(len(block.rows))) for _, _, block in blocks]).astype(np.int64),
        joined([np.array(block.lines, dtype=float) for _, _, block in blocks]).astype(np.int64),
    )


def _column(export: Export, step: Step, block: Block, name: str) -> Array:
    place = block.layout.places.get(name)
    cells = [] if place is None else [row[place.place] for row in block.rows]
    if place is None or not any(cells):
        return np.full(len(block.rows), np.nan)

    def checked(row: int) -> float:
        where = f"{at(step, block.first + row)}column {place.heading!r}"
        value = number_of(export, cells[row], where, block.lines[row])
        return np.nan if value is None else value

    if export.decimal_comma:
        values = np.array([checked(row) for row in range(len(cells))])
    else:
        plain = NUMBER.fullmatch
        values = np.array([float(cell) if plain(cell) else checked(row) for row, cell in enumerate(cells)])
        for row in np.flatnonzero(np.abs(values) > LARGEST):
            checked(int(row))
    return np.asarray(place.factor * values + place.offset)
