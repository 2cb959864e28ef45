"""A table of the report: rows of finished texts, from the columns of a dataset."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.report.numbers import ABSENT, significant
from viscofric.report.results import values

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import xarray as xr


@dataclass(frozen=True)
class Table:
    """A table: what it shows, its headings and its cells, and a line below that explains them."""

    key: str
    caption: str
    headings: list[str]
    rows: list[list[str]]
    open: bool = True
    note: str = ""


class Column(NamedTuple):
    """A column: its heading, the variable of the dataset, and how its numbers are written."""

    heading: str
    variable: str
    text: Callable[[float], str]


def times(factor: float, digits: int = 4) -> Callable[[float], str]:
    """Return what writes a number times a factor to so many digits."""
    return lambda value: significant(factor * value, digits)


def whole(value: float) -> str:
    """Write a whole number."""
    return f"{value:.0f}" if np.isfinite(value) else ABSENT


def aligned(rows: Iterable[Iterable[str]]) -> list[str]:
    """Return rows as lines of text whose columns stand flush right."""
    cells = [list(row) for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells]


def made_table(
    key: str, caption: str, dataset: xr.Dataset, columns: list[Column], is_open: bool = True, note: str = ""
) -> Table:
    """Write down those columns that the dataset has."""
    columns = [column for column in columns if column.variable in dataset.variables]
    texts = [_cells(dataset, column) for column in columns]
    return Table(
        key,
        caption,
        [column.heading for column in columns],
        [list(row) for row in zip(*texts, strict=True)],
        is_open,
        note,
    )


def _cells(dataset: xr.Dataset, column: Column) -> list[str]:
    if dataset[column.variable].dtype.kind in "OU":
        return [str(value) for value in dataset[column.variable].values]
    return [column.text(float(value)) for value in values(dataset, column.variable)]
