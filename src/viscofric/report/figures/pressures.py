"""Pressures of a contact at several times: profiles, a strip of maps; figures of a whole history and of impacts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure

from viscofric.datasets import DataArray
from viscofric.motion.impact_solution import ImpactSolution, RestitutionCurve
from viscofric.motion.solution import TransientSolution
from viscofric.report.data import moves, pressure_along, returns
from viscofric.report.figures.contact import draw_profile, pressure_mesh
from viscofric.report.figures.motion import plot_force_depth, plot_friction_loop, plot_restitution, plot_transient
from viscofric.report.figures.style import INK, Unit, new_figure, sequential_looks, slender_bar, unit_for
from viscofric.report.texts.numbers import prefixed
from viscofric.units import Quantities, to_si_array

#: Pressures that are drawn without times of the user's choice.
_FRAMES = 5
#: Share of the touched length that is shown beside it.
_MARGIN = 0.15
#: Relative change of a load that is constant up to rounding and the solver's tolerance.
_CONSTANT = 1e-3


class Frames(NamedTuple):
    """Pressures at several times, with the scales that all have in common."""

    times: list[float]
    fields: list[DataArray]
    length: Unit
    pressure: Unit
    highest: float  # in its unit
    reach: tuple[tuple[float, float], tuple[float, float]]  # along x and y, in the unit of length
    has_axis: bool  # that of an indenter, which a periodic surface does not have

    @property
    def label(self) -> str:
        """Label of an axis or of colours of the pressure."""
        return f"pressure $p$ ({self.pressure.name})"

    @property
    def are_maps(self) -> bool:
        """Whether the pressure lies along two axes."""
        return self.fields[0].ndim == 2


def frames_of(run: TransientSolution, times: Quantities | None = None, count: int = _FRAMES) -> Frames:
    """Return the pressures of a solution at times, or at as many of its own, evenly spread."""
    shown = spread_times(run, count) if times is None else [float(one) for one in to_si_array(times, "s", "times")]
    fields = [run.pressure_at(time) for time in shown]
    largest = max(float(field.max()) for field in fields)
    reach = _whole(fields[0]) if run.geometry == "periodic" else _reach(fields)
    size = unit_for(max(abs(end) for ends in reach for end in ends))
    unit = unit_for(largest, "Pa")
    (left, right), (low, high) = reach
    scaled = ((left / size.size, right / size.size), (low / size.size, high / size.size))
    return Frames(shown, fields, size, unit, largest / unit.size or 1.0, scaled, run.geometry != "periodic")


def spread_times(run: TransientSolution, count: int) -> list[float]:
    """Return at most so many times, evenly spread, without the first: its pressure is none, or dwarfs the others."""
    first, last = float(run.time[0]), float(run.time[-1])
    later = run.time[run.time > first] if last > first else run.time
    wanted = np.linspace(first, last, count + 1)[1:]
    return sorted({float(later[int(np.abs(later - time).argmin())]) for time in wanted})


def plot_pressure_profiles(axes: Axes, run: TransientSolution, times: Quantities | None = None) -> None:
    """Draw the pressure along x through the indenter's axis at several times, from dark (early) to light.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    run : TransientSolution
    times : (m,) array of float, str or pint.Quantity, optional
        Of those that the solution has; five of them without.

    Raises
    ------
    InputError
        If the pressure of a time was not kept.
    """
    frames = frames_of(run, times)
    for time, field, look in zip(frames.times, frames.fields, sequential_looks(len(frames.times)), strict=True):
        x, pressure = pressure_along(field)
        words = prefixed(time, None, "s")
        axes.plot(x / frames.length.size, pressure / frames.pressure.size, color=look.colour, label=words)
    axes.set_xlim(*frames.reach[0])
    axes.set_ylim(0.0, 1.05 * frames.highest)
    axes.set(xlabel=f"$x$ ({frames.length.name})", ylabel=frames.label)
    axes.legend(loc="best", title="time")


def plot_pressure_frame(axes: Axes, frames: Frames, place: int) -> QuadMesh | None:
    """Draw the pressure at one of several times, on their common scales; return the colours of a map."""
    field = frames.fields[place]
    axes.set(xlim=frames.reach[0], xlabel=f"$x$ ({frames.length.name})")
    if not frames.are_maps:
        x, pressure = pressure_along(field)
        draw_profile(axes, x / frames.length.size, pressure / frames.pressure.size)
        axes.set(ylim=(0.0, 1.05 * frames.highest), ylabel=frames.label)
        return None
    x, y = (np.asarray(field[name]) / frames.length.size for name in field.dims)
    mesh = pressure_mesh(axes, x, y, np.asarray(field) / frames.pressure.size, frames.highest)
    if frames.has_axis:
        axes.plot([0.0], [0.0], marker="+", color=INK, markersize=9, linestyle="none")
    axes.set(ylim=frames.reach[1], ylabel=f"$y$ ({frames.length.name})")
    return mesh


def pressure_strip(run: TransientSolution, times: Quantities | None = None, title: str = "") -> Figure:
    """Return a figure with the pressure at several times side by side: maps, or profiles of line and round contacts.

    Parameters
    ----------
    run : TransientSolution
    times : (m,) array of float, str or pint.Quantity, optional
        Of those that the solution has; five of them without.
    title : str

    Raises
    ------
    InputError
        If the pressure of a time was not kept.
    """
    frames = frames_of(run, times)
    (left, right), (low, high) = frames.reach
    across = min((high - low) / (right - left), 2.0) if frames.are_maps else 0.9
    figure = new_figure(2.2 * len(frames.times) + 1.2, 2.0 * across + (1.15 if title else 0.9), title=title)
    panels = figure.subplots(1, len(frames.times), squeeze=False, sharey=True)[0]
    mesh = None
    for place, panel in enumerate(panels):
        mesh = plot_pressure_frame(panel, frames, place)
        panel.set_title(prefixed(frames.times[place], None, "s"), fontsize=9.5)
        panel.set(xlabel="", **({"ylabel": ""} if place else {}))
    figure.supxlabel(f"$x$ ({frames.length.name})", fontsize=10.5)
    if mesh is not None:
        slender_bar(figure, mesh, panels, frames.label)
    return figure


def transient_figure(run: TransientSolution, title: str = "") -> Figure:
    """Return a figure of a contact over time: load, indentation, friction, contact, pressures, and the loop.

    Parameters
    ----------
    run : TransientSolution
    title : str
    """
    data = run.to_dataset()
    slides = moves(data)
    rows = ["load", "indentation", *(["friction_coefficient"] if slides else []), "contact"]
    figure = new_figure(9.6, 1.7 * len(rows) + 0.6, title=title)
    left, right = figure.subfigures(1, 2, width_ratios=[1.15, 1.0], squeeze=False)[0]
    panels: Any = left.subplots(len(rows), 1, sharex=True)
    for panel, quantity in zip(panels, rows, strict=True):
        plot_transient(panel, data, quantity)
        panel.set_xlabel(panel.get_xlabel() if quantity == rows[-1] else "")
    above, below = right.subplots(2, 1)
    loop = slides and returns(data)
    if run.has_pressures:
        _plot_pressures(above, run)
    elif loop and np.ptp(run.load) <= _CONSTANT * float(run.load.max()):
        plot_transient(above, data, "energy")
    else:
        plot_force_depth(above, data)
    if slides:  # also one way: after a long dwell the start takes no room over the time
        plot_friction_loop(below, data)
    else:
        plot_transient(below, data, "energy")
    return figure


def _plot_pressures(axes: Axes, run: TransientSolution) -> None:
    """Draw the pressures of an indenter along a line, or those of a rough surface at the last time."""
    frames = frames_of(run, count=1)
    if run.geometry != "periodic" or not frames.are_maps:
        plot_pressure_profiles(axes, run)
        return
    mesh = plot_pressure_frame(axes, frames, 0)
    assert mesh is not None  # of a map
    axes.set_title(prefixed(frames.times[0], None, "s"), fontsize=9.5)
    slender_bar(axes.figure, mesh, [axes], frames.label)


def impact_figure(found: ImpactSolution | RestitutionCurve, title: str = "") -> Figure:
    """Return a figure of an impact over time, or of the restitution of several."""
    if isinstance(found, ImpactSolution):
        return transient_figure(found.run, title)
    figure = new_figure(title=title)
    plot_restitution(figure.subplots(), found.to_dataset())
    return figure


def _reach(fields: Sequence[DataArray]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the ends along x and y of what is loaded at any of the times, with a margin."""
    ends = []
    for name in ("x", "y"):
        loaded = [_loaded(field, name) for field in fields]
        low, high = min(one[0] for one in loaded), max(one[1] for one in loaded)
        margin = _MARGIN * ((high - low) or 1.0)
        ends.append((low - margin, high + margin))
    return ends[0], ends[1]


def _whole(field: DataArray) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the ends along x and y of all cells of a periodic surface."""
    ends = [(0.0, 0.0), (0.0, 0.0)]
    for axis, name in enumerate(field.dims):
        places = np.asarray(field[name])
        half = 0.5 * float(places[1] - places[0]) if len(places) > 1 else 0.5
        ends[axis] = (float(places[0]) - half, float(places[-1]) + half)
    return ends[0], ends[1]


def _loaded(field: DataArray, name: str) -> tuple[float, float]:
    """Return the ends of the loaded part along x or y, of a round contact along either; zeros without a load."""
    name = "r" if field.dims == ("r",) else name
    if name not in field.dims or not (field > 0.0).any():
        return 0.0, 0.0
    places = field[name].values[(field > 0.0).any([other for other in field.dims if other != name]).values]
    low, high = float(places.min()), float(places.max())
    return (-high, high) if name == "r" else (low, high)
