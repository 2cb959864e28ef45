"""Tables of the report, and those of the material."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.solution import ERRORS
from viscofric.datasets import Dataset, DataTree
from viscofric.notes import table_in
from viscofric.report.results import on_group, values
from viscofric.report.texts.numbers import ABSENT, degrees, percent, significant, with_error
from viscofric.showing import aligned
from viscofric.units import shown_celsius, shown_number


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
    text: Callable[..., str]
    error: str = ""  # the variable of their errors, which stand after ± and end the numbers, where they are known


def times(factor: float, digits: int = 4) -> Callable[..., str]:
    """Return what writes a number times a factor to so many digits, or to those that its error leaves."""

    def text(value: float, error: float = math.nan) -> str:
        if math.isfinite(error):
            return with_error(factor * value, factor * error)
        return significant(factor * value, digits)

    return text


def logarithm(value: float, error: float = math.nan) -> str:
    """Write a decadic logarithm, whose rounding is zero."""
    if error > 0.0:
        return with_error(value, error)
    return shown_number(value, "z.4f") if np.isfinite(value) else ABSENT


def whole(value: float) -> str:
    """Write a whole number."""
    return f"{value:.0f}" if np.isfinite(value) else ABSENT


def number_column(data: Dataset, name: str) -> Column:
    """Return the column of a number: its name and unit are the heading, and whole numbers are written as such."""
    found, unit = values(data, name), str(data[name].attrs.get("units", "1"))
    known = np.abs(found[np.isfinite(found)])
    if unit == "m" and known.max(initial=0.0) < _FINE:
        shown, factor = "µm", 1e6
    else:
        shown, factor = _UNITS.get(unit, ("" if unit == "1" else unit, 1.0))
    spoken = name.replace("_", " ")
    write = whole if unit == "1" and np.all(known == np.rint(known)) else times(factor)
    return Column(f"{spoken} ({shown})" if shown else spoken, name, write, ERRORS.get(name, ""))


#: SI unit -> the unit of tables, and its number for 1 in SI; lengths up to `_FINE`, m, are in µm.
_UNITS = {"m": ("mm", 1e3), "m**2": ("mm²", 1e6), "m/s": ("mm/s", 1e3), "Pa": ("MPa", 1e-6)}
_FINE = 1e-4


def made_table(
    key: str, caption: str, dataset: Dataset, columns: list[Column], is_open: bool = True, note: str = ""
) -> Table:
    """Write down those columns that the dataset has."""
    columns = [column for column in columns if column.variable in dataset.variables]
    texts = [_cells(dataset, column) for column in columns]
    rows = [list(row) for row in zip(*texts, strict=True)]
    return Table(key, caption, [column.heading for column in columns], rows, is_open, note)


def _cells(dataset: Dataset, column: Column) -> list[str]:
    if dataset[column.variable].dtype.kind in "OU":
        return [str(value) for value in dataset[column.variable].values]
    columns = [values(dataset, name) for name in (column.variable, column.error) if name in dataset.variables]
    return [column.text(*map(float, row)) for row in zip(*columns, strict=True)]


@on_group("shift_factors")
def shift_factor_table(factors: Dataset, _: DataTree) -> Table | None:
    """Shift factors of the isotherms."""
    columns = [
        Column("temperature", "temperature", degrees),
        Column("log₁₀ α", "log10_shift_factor", logarithm, "standard_error"),
        Column("α", "alpha", times(1.0, 2)),
        Column("log₁₀ b", "log10_vertical_shift", logarithm, "vertical_standard_error"),
    ]
    full = factors.assign(alpha=10.0 ** factors["log10_shift_factor"])
    return made_table(
        "shift-factors", "Shift factors of the isotherms, with their standard errors.", full, columns, is_open=False
    )


def law_table(laws: Dataset) -> Table:
    """Shift laws with their constants, compared by AIC."""
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


@on_group("spectrum")
def spectrum_table(spectrum: Dataset, _: DataTree) -> Table | None:
    """Modes of the retardation spectrum."""
    columns = [
        Column("retardation time τ (s)", "retardation_time", times(1.0)),
        Column("compliance C (1/GPa)", "creep_coefficient", times(1e9)),
    ]
    caption = "Retardation spectrum at the reference temperature: 1/E(ω) = 1/E∞ + Σ C/(1 + iωτ)."
    return made_table("spectrum", caption, spectrum, columns, is_open=False)


def text_table(data: Dataset, *columns: tuple[str, str] | tuple[str, str, str]) -> list[str]:
    """Return columns of a data set, (name, heading) or with the name of the error, as lines of text.

    Those that are missing are left out; those that have a scatter or 95 % limits are followed by these; with limits
    they have the digits of these, and no numerical error.
    """
    cells: list[list[str]] = []
    for name, heading, *other in columns:
        if name not in data.variables:
            continue
        if data[name].dtype.kind in "OU":
            cells.append([heading, *data[name].values])
            continue
        unit = data[name].attrs.get("units", "1")
        write, factor = _SHOWN.get(name) or (times(1.0), _UNITS[unit][1] if unit in ("m/s", "Pa") else 1.0)
        found, error = factor * values(data, name), other[0] if other else f"{name}_error"
        if is_limited := f"{name}_lower" in data:
            write, error = significant, ""
        texts = _pairs(found, factor * values(data, error), write) if error in data else map(write, found.tolist())
        cells.append([heading, *texts])
        if np.any(values(data, f"{name}_scatter") > 0.0):
            shares = zip(values(data, f"{name}_scatter"), found, strict=True)
            cells.append(["scatter", *(_share(one, of) for one, of in shares)])
        if is_limited:
            ends = zip(*(factor * values(data, f"{name}_{end}") for end in ("lower", "upper")), strict=True)
            cells.append(["95 % limits", *(f"{significant(low)} to {significant(high)}" for low, high in ends)])
    return aligned(zip(*cells, strict=True))


def _decimals(value: float) -> str:
    return shown_number(value, "z.3f") if math.isfinite(value) else ABSENT


#: How numbers of a name or a unit are written, with a factor.
_SHOWN: dict[str, tuple[Callable[[float], str], float]] = {
    "temperature": (shown_celsius, 1.0),
    "replicates": (whole, 1.0),
    "slip": (significant, 1e3),
    "angular_frequency": (times(1.0, 1), 1.0),
    "log10_shift_factor": (_decimals, 1.0),
    "known": (_decimals, 1.0),
    "difference": (_decimals, 1.0),
}


def _share(part: float, whole: float) -> str:
    """Return a scatter as a percentage of its mean."""
    return percent(part / abs(whole)) if whole != 0.0 and math.isfinite(part) else ABSENT


def _pairs(values: Array, errors: Array, write: Callable[[float], str]) -> list[str]:
    """Return values with their errors, all with the decimals that the usual error leaves; as `write` does without."""
    known = errors[np.isfinite(errors) & (errors > 0.0)]
    if not known.size:
        return [
            (write(value) + (" ± ?" if unknown else "")) if value or not unknown else ABSENT
            for value, unknown in zip(values.tolist(), np.isinf(errors).tolist(), strict=True)
        ]
    decimals = int(np.clip(1 - math.floor(math.log10(float(np.median(known)))), 0, 9))
    written = []
    for value, error in zip(values, errors, strict=True):
        if not math.isfinite(value) or (value == 0.0 and math.isinf(error)):  # not found at all
            written.append(ABSENT)
            continue
        doubt = f" ± {max(error, 10.0**-decimals):.{decimals}f}" if math.isfinite(error) else " ± ?"
        written.append(f"{shown_number(value, f'z.{decimals}f')}{doubt if error else ''}")
    return written
