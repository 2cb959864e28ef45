"""Tables of the report, and those of the material."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscofric.datasets import Dataset, DataTree
from viscofric.notes import table_in
from viscofric.report.results import group, values
from viscofric.report.texts.numbers import ABSENT, degrees, significant
from viscofric.units import shown_number


@dataclass(frozen=True)
class Table:
    """A table: what it shows, its headings and its cells, a line below that explains them, and rows left out of it."""

    key: str
    caption: str
    headings: list[str]
    rows: list[list[str]]
    open: bool = True
    note: str = ""
    left_out: int = 0


class Column(NamedTuple):
    """A column: its heading, the variable of the dataset, and how its numbers are written."""

    heading: str
    variable: str
    text: Callable[[float], str]


def times(factor: float, digits: int = 4) -> Callable[[float], str]:
    """Return what writes a number times a factor to so many digits."""
    return lambda value: significant(factor * value, digits)


def logarithm(value: float) -> str:
    """Write a decadic logarithm, whose rounding is zero."""
    return shown_number(value, "z.4f") if np.isfinite(value) else ABSENT


def whole(value: float) -> str:
    """Write a whole number."""
    return f"{value:.0f}" if np.isfinite(value) else ABSENT


def made_table(
    key: str, caption: str, dataset: Dataset, columns: list[Column], is_open: bool = True, note: str = ""
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


def _cells(dataset: Dataset, column: Column) -> list[str]:
    if dataset[column.variable].dtype.kind in "OU":
        return [str(value) for value in dataset[column.variable].values]
    return [column.text(float(value)) for value in values(dataset, column.variable)]


def shift_factor_table(tree: DataTree) -> Table | None:
    """Shift factors of the isotherms."""
    factors = group(tree, "shift_factors")
    if factors is None:
        return None
    columns = [
        Column("temperature", "temperature", degrees),
        Column("log₁₀ α", "log10_shift_factor", logarithm),
        Column("standard error", "standard_error", times(1.0, 2)),
        Column("α", "alpha", times(1.0)),
        Column("log₁₀ b", "log10_vertical_shift", logarithm),
        Column("standard error of log₁₀ b", "vertical_standard_error", times(1.0, 2)),
    ]
    full = factors.assign(alpha=10.0 ** factors["log10_shift_factor"])
    return made_table("shift-factors", "Shift factors of the isotherms.", full, columns, is_open=False)


def law_table(tree: DataTree) -> Table | None:
    """Shift laws with their constants, compared by AIC."""
    laws = group(tree, "laws")
    if laws is None:
        return None
    columns = [
        Column("law", "law", str),
        Column("constants", "constants", str),
        Column("AIC above the lowest", "information_criterion", times(1.0, 3)),
        Column("weight", "akaike_weight", times(1.0, 2)),
        Column("scatter beyond the errors (decades)", "law_scatter", times(1.0, 2)),
    ]
    refused = "".join(f" {title}: {reason}" for title, reason in table_in(laws.attrs, "refused").items())
    note = f"{laws.attrs.get('explanation', '')}{refused}".strip()
    return made_table("laws", "Shift laws fitted to the shift factors, compared by AIC.", laws, columns, False, note)


def spectrum_table(tree: DataTree) -> Table | None:
    """Modes of the retardation spectrum."""
    spectrum = group(tree, "spectrum")
    if spectrum is None:
        return None
    columns = [
        Column("retardation time τ (s)", "retardation_time", times(1.0)),
        Column("compliance C (1/GPa)", "creep_coefficient", times(1e9)),
    ]
    caption = "Retardation spectrum at the reference temperature: 1/E(ω) = 1/E∞ + Σ C/(1 + iωτ)."
    return made_table("spectrum", caption, spectrum, columns, is_open=False)
