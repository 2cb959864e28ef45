"""Figures of contacts over time: forces, depth, contact against time or distance, friction loops, restitution."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.errors import check_choice
from viscofric.report.data import ENERGIES, SIZES, distance, position_along
from viscofric.report.figures import style
from viscofric.report.texts.numbers import degrees, prefixed
from viscofric.units import CELSIUS_ZERO


class _Line(NamedTuple):
    """A column of the data set, its entry in the legend and its colour."""

    column: str
    words: str
    colour: str


def _lines(columns: dict[str, str], *colours: str) -> tuple[_Line, ...]:
    return tuple(_Line(*one, colour) for one, colour in zip(columns.items(), colours, strict=True))


#: Quantity -> label of its axis, and what is drawn of it where the data set has it.
_QUANTITIES: dict[str, tuple[str, tuple[_Line, ...]]] = {
    "load": ("normal load $F$", (_Line("load", "", style.INK),)),
    "indentation": (r"indentation $\delta$", (_Line("indentation", "", style.GREEN),)),
    "friction_force": ("friction force $T$", (_Line("friction_force", "", style.VERMILION),)),
    "friction_coefficient": (r"friction coefficient $\mu$", (_Line("friction_coefficient", "", style.VERMILION),)),
    "contact": ("contact", _lines(SIZES, style.BLUE, style.BLUE, style.ORANGE, style.PURPLE)),
    "energy": ("energy", _lines(ENERGIES, style.INK, style.BLUE, style.VERMILION)),
}
_AREA = (_Line("contact_area", "", style.BLUE),)
#: Labels of a periodic contact, whose loads are mean pressures.
_PER_AREA = {
    "load": r"mean pressure $\bar p$",
    "friction_force": r"mean traction $\bar\tau$",
    "contact": "contact area fraction",
}
QUANTITIES = tuple(_QUANTITIES)
AGAINST = ("time", "distance")
#: Arrows along a friction loop.
_ARROWS = 4
#: Part of the range beside it.
_BESIDE = 0.05


def plot_transient(axes: Axes, data: Dataset, quantity: str = "friction_coefficient", against: str = "time") -> None:
    """Draw one quantity of a contact against time or distance.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    data : xarray.Dataset
        As `TransientSolution.to_dataset` returns it.
    quantity : str
        ``"load"``, ``"indentation"``, ``"friction_force"``, ``"friction_coefficient"``, ``"contact"`` (its radius, or
        its edges; the area of a periodic contact) or ``"energy"``.
    against : str
        ``"time"``, or ``"distance"`` along the path.

    Raises
    ------
    InputError
        If `quantity` or `against` is none of these.
    """
    check_choice(quantity, "quantity", *QUANTITIES)
    check_choice(against, "against", *AGAINST)
    along, label = _along(data, against)
    title, lines = _drawn(data, quantity)
    unit = _unit_of(data, [line.column for line in lines])
    for line in lines:
        values = np.asarray(data[line.column]) / unit.size
        error = data.get(f"{line.column}_error")
        if error is not None:
            bound = np.asarray(error) / unit.size
            axes.fill_between(along, values - bound, values + bound, color=line.colour, alpha=0.2, linewidth=0.0)
        axes.plot(along, values, color=line.colour, label=line.words)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.set(xlabel=label, ylabel=f"{title} ({unit.name})" if unit.name else title)
    if len(lines) > 1:
        axes.legend(loc="best")


def plot_force_depth(axes: Axes, data: Dataset) -> None:
    """Draw the load against the indentation; the area below the way down less that of the way back is lost.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    data : xarray.Dataset
        As `TransientSolution.to_dataset` returns it.
    """
    inside = data.where(data["load"] > 0.0, 0.0)
    depth, load = _unit_of(inside, ["indentation"]), _unit_of(data, ["load"])
    x, y = np.asarray(data["indentation"]) / depth.size, np.asarray(data["load"]) / load.size
    axes.plot(x, y, color=style.INK)
    if np.any(y > 0.0):  # flights between contacts reach far above the surface
        low, high = min(0.0, float(x[y > 0.0].min())), float(x[y > 0.0].max())
        axes.set_xlim(low - _BESIDE * (high - low), high + _BESIDE * (high - low))
    axes.set(xlabel=f"{_title(data, 'indentation')} ({depth.name})", ylabel=f"{_title(data, 'load')} ({load.name})")


def plot_friction_loop(axes: Axes, data: Dataset) -> None:
    """Draw the friction force against the position along its direction, with arrows in the order of time.

    The area of a closed loop is the work of friction.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    data : xarray.Dataset
        As `TransientSolution.to_dataset` returns it.
    """
    position = position_along(data)
    where = style.unit_for(float(np.abs(position).max()))
    unit = _unit_of(data, ["friction_force"])
    x, y = position / where.size, np.asarray(data["friction_force"]) / unit.size
    axes.plot(x, y, color=style.VERMILION)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    for place in _arrow_places(x):
        start, end = ((float(x[one]), float(y[one])) for one in (place, place + 1))
        axes.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": style.VERMILION, "linewidth": 1.2})
    axes.set_xlabel(f"position along the motion ({where.name})")
    axes.set_ylabel(f"{_title(data, 'friction_force')} ({unit.name})")


def plot_restitution(axes: Axes, data: Dataset) -> None:
    """Draw the restitution of an impact against speed, a line for each temperature, or against temperature if longer.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    data : xarray.Dataset
        As `RestitutionCurve.to_dataset` returns it.
    """
    curve = data["restitution"]
    if "temperature" not in curve.dims:
        curve = curve.expand_dims("temperature")
    speeds, values = np.asarray(data["speed"]), np.asarray(curve.transpose("temperature", "speed"))
    kelvins = np.atleast_1d(np.asarray(data["temperature"])) if "temperature" in data.coords else None
    if kelvins is not None and len(kelvins) > len(speeds):
        x, values, names = kelvins - CELSIUS_ZERO, values.T, [prefixed(float(one), None, "m/s") for one in speeds]
    else:
        x, names = speeds, [""] if kelvins is None else [degrees(float(one)) for one in kelvins]
    for words, row, look in zip(names, values, style.looks(len(values)), strict=True):
        axes.plot(x, row, color=look.colour, marker=look.marker, label=words)
    label_restitution(axes, len(speeds) if x is speeds else 0)
    if kelvins is not None:
        axes.legend(loc="best")


def label_restitution(axes: Axes, speeds: int) -> None:
    """Label axes of restitution over so many speeds of the impact, or over the temperature for none of them."""
    if speeds > 1:
        axes.set_xscale("log")
        style.speed_ticks(axes.xaxis)
    axes.set_xlabel("speed of the impact (m/s)" if speeds else "temperature (°C)")
    axes.set_ylim(0.0, 1.05)
    axes.set_ylabel("coefficient of restitution $e$")


def _along(data: Dataset, against: str) -> tuple[Array, str]:
    """Return the values of the axis across, and its label."""
    values, base = (np.asarray(data["time"]), "s") if against == "time" else (distance(data), "m")
    unit = style.unit_for(float(np.abs(values).max()), base)
    return values / unit.size, f"{against} {'$t$' if against == 'time' else '$s$'} ({unit.name})"


def _drawn(data: Dataset, quantity: str) -> tuple[str, tuple[_Line, ...]]:
    """Return the label of a quantity and the columns that there are."""
    _, lines = _QUANTITIES[quantity]
    found = tuple(line for line in lines if line.column in data)
    if not found:
        return _PER_AREA["contact"] if data.attrs.get("geometry") == "periodic" else "contact area", _AREA
    return _title(data, quantity), found


def _title(data: Dataset, quantity: str) -> str:
    titles = _PER_AREA if data.attrs.get("geometry") == "periodic" else {}
    return titles.get(quantity, _QUANTITIES[quantity][0])


def _unit_of(data: Dataset, columns: list[str]) -> style.Unit:
    """Return the unit in which some columns are drawn."""
    base = str(data[columns[0]].attrs["units"])
    if base == "1":
        return style.Unit(1.0, "")
    largest = max(float(np.abs(np.asarray(data[name])).max(initial=0.0)) for name in columns)
    if base == "m2":
        return style.Unit(1e-6, "mm²") if largest < 1e-2 else style.Unit(1.0, "m²")
    return style.unit_for(largest, base.replace("m2", "m²"))


def _arrow_places(x: Array) -> list[int]:
    """Return intervals spread evenly over the distance, in each of which the position changes."""
    steps = np.abs(np.diff(x))
    if not np.any(steps > 0.0):
        return []
    way = np.cumsum(steps)
    marks = (np.arange(_ARROWS) + 0.5) / _ARROWS * way[-1]
    return sorted({int(np.searchsorted(way, mark)) for mark in marks})
