"""Friction as the page's figures draw it: columns in ascending speed, temperature after temperature."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import note_of
from viscofric.report.data import Predicted
from viscofric.report.results import nearest, nominal_temperatures
from viscofric.report.texts.tables import Table


def by_temperature(temperature: Array, speed: Array, **columns: Any) -> list[dict[str, Any]]:
    """Sort points (n,) of temperatures (K) and speeds (m/s) into isotherms, their columns in ascending speed."""
    nominal = nominal_temperatures(temperature)
    which = nearest(nominal, temperature) if nominal.size else np.zeros(0, dtype=np.int64)
    found = []
    for place, kelvin in enumerate(nominal.tolist()):
        rows = np.flatnonzero(which == place)
        rows = rows[np.argsort(speed[rows], kind="stable")]
        sorted_columns = {name: np.asarray(column)[rows] for name, column in columns.items()}
        found.append({"temperature": kelvin, "speed": speed[rows], **sorted_columns})
    return found


def measured_points(curves: FrictionCurves) -> list[dict[str, Any]]:
    """Return measured friction by temperature; NaN where it is not determined."""
    data = curves.points_dataset().reset_coords()
    columns = {str(name): column.values for name, column in data.items() if name not in ("speed", "temperature")}
    for name in ("viscoelastic", "coulomb"):
        if name in columns:
            not_found = (columns[name] == 0.0) & np.isinf(columns[f"{name}_error"])
            columns[name] = np.where(not_found, np.nan, columns[name])
    return by_temperature(curves.temperature, curves.speed, **columns)


def drawn_line(line: Predicted | None) -> dict[str, Any] | None:
    """Return a line over the speed with its 95 % band; NaN where it has a gap."""
    if line is None:
        return None
    names, rows = ("speed", "friction", "lower", "upper", "extrapolated"), line.rows()
    return {name: getattr(rows, name) for name in names}


def table_record(table: Table | None) -> dict[str, Any] | None:
    """Return a table of the report in plain texts."""
    if table is None:
        return None
    return {"caption": table.caption, "head": table.headings, "rows": table.rows, "note": table.note}


def pairs(lines: Iterable[tuple[str, str]]) -> list[dict[str, str]]:
    """Return pairs of name and value as the page lists them."""
    return [{"name": name, "value": value} for name, value in lines]


def texts(sentences: Sequence[str]) -> list[str]:
    """Return sentences ready for readers, each once."""
    return [one.words("page") for one in dict.fromkeys(map(note_of, sentences))]
