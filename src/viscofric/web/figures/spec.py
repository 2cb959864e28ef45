"""Figures, numbers and tables as data, SI; `static/js/figures.js` and `views.js` show them in the user's units.

A column is an array, or the path of a column of the result that is shown ("profile.x").  Texts may hold quantities,
"{0.02|speed}", and, of the chosen unit of frequency, its name {frequency} and the symbols {omega} and {v/a}.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.datasets import Dataset, plain

#: Of a figure, a trace, a number or a table.
Spec = dict[str, Any]
_DIGITS = 6


def axis(label: str, kind: str | None = None, **look: Any) -> Spec:
    """Return an axis of a quantity of some kind (`units.js`); `look` has log, range, zero or equal."""
    return {"label": label, "kind": kind, **look}


#: Kinds of quantities by their SI units; a pressure may be a modulus.
_KINDS = {
    "s": "time",
    "m": "length",
    "m**2": "area",
    "m/s": "speed",
    "K": "temperature",
    "N": "load",
    "N/m": "line_load",
    "Pa": "pressure",
    "rad/s": "angular_frequency",
}


def kind_of(data: Dataset, name: str) -> str:
    """Return the kind of a column, "plain" of one without a unit."""
    return _KINDS.get(data[name].attrs.get("units", "1"), "plain")


def axis_in(unit: str, label: str) -> Spec:
    """Return the axis of a number with a unit and a long name."""
    return axis(label, _KINDS.get(unit))


def axis_of(data: Dataset, name: str, **look: Any) -> Spec:
    """Return the axis of a column, with its long name."""
    return axis(data[name].attrs["long_name"], kind_of(data, name), **look)


SPEED = axis("speed", "speed", log=True)
TEMPERATURE = axis("temperature", "temperature")
FREQUENCY = axis("{frequency} {omega}", "angular_frequency", log=True)
REDUCED_FREQUENCY = axis("reduced {frequency} α {omega}", "angular_frequency", log=True)
MODULUS = axis("modulus", "modulus", log=True)


def line(x: Any, y: Any, name: str | None = None, *, band: Any = None, **look: Any) -> Spec:
    """Return a line with a band around it, (lower, upper); a line of one `temperature` is named after it."""
    columns = {"x": x, "y": y, **({} if band is None else dict(zip(("lower", "upper"), band, strict=True)))}
    return {name: entry for name, entry in {"name": name, **_columns(columns), **look}.items() if entry is not None}


def points(x: Any, y: Any, name: str | None = None, *, error: Any = None, **look: Any) -> Spec:
    """Return points with error bars."""
    return line(x, y, name, mode="markers", **({} if error is None else _columns({"error": error})), **look)


def _columns(columns: Spec) -> Spec:
    return {name: entry if isinstance(entry, str) else plain(entry, _DIGITS) for name, entry in columns.items()}


def around(values: Any, error: Any) -> tuple[Any, Any]:
    """Return the edges of a band of this half-width."""
    middle, half = np.asarray(values, dtype=float), np.asarray(error, dtype=float)
    return middle - half, middle + half


def figure(title: str, x: Spec, y: Spec, traces: list[Spec], caption: str = "", **more: Any) -> Spec:
    """Return a figure; `more` has marks, map, z, the `look` of all traces, or `temperatures` that share colours."""
    return {"title": title, "x": x, "y": y, "traces": traces, "caption": caption, **more}


def number(label: str, value: Any, kind: str = "plain", **more: Any) -> Spec:
    """Return a number, or a text; `more` has digits (3), its error, a remark, or the unit of a plain number."""
    return {"label": label, "value": value, "kind": kind, **more}


def number_of(row: tuple[str, float, str, float | None]) -> Spec:
    """Return a number of a result with its long name, unit and error."""
    label, value, unit, error = plain(row, _DIGITS)
    kind = _KINDS.get(unit, "plain")
    other = unit.replace("**2", "²") if kind == "plain" and unit != "1" else ""
    return number(label[0].upper() + label[1:], value, kind, digits=4, error=error, unit=other)


def quantity(value: float | None, kind: str = "plain", digits: int = 3) -> str:
    """Return a quantity within a text."""
    return "–" if value is None else f"{{{value:.9g}|{kind}|{digits}}}"


def table(caption: str, head: list[str], rows: list[list[Any]]) -> Spec:
    """Return a table; a cell is text or a plain number."""
    return {"caption": caption, "head": head, "rows": rows}


#: Look of measured curves at one temperature each.
ISOTHERMS: Spec = {"mode": "lines+markers", "dash": "solid", "symbol": "circle", "size": 5, "width": 1.2}


def isotherms(path: str, curves: list[dict[str, Any]], x: str, y: str) -> list[Spec]:
    """Return columns of curves at one temperature each; `path` is where the result has the curves."""
    return [
        line(f"{path}[{at}].{x}", f"{path}[{at}].{y}", temperature=one["temperature"]) for at, one in enumerate(curves)
    ]
