"""Figures of one contact: the map of its pressure, and profiles along the motion; each drawn on an Axes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from scipy.ndimage import uniform_filter

from viscofric.arrays import Array, centre_line
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.solution import ContactSolution
from viscofric.report.figures.style import BLUE, GREY, INK, VERMILION, Unit, heat_map, new_figure, slender_bar, unit_for
from viscofric.report.texts.numbers import prefixed, significant
from viscofric.units import shown_celsius

#: More cells along an edge than this do not show; the map draws every n-th.
_MOST_CELLS = 256
#: Share of the loaded cells within the colours of a pressure whose largest value means nothing.
_SHARE_SHOWN = 0.98


def pressure_mesh(
    axes: Axes, x: Array, y: Array, pressure: Array, highest: float | None = None, *, outlined: bool = False
) -> QuadMesh:
    """Draw a pressure (nx, ny) seen from above, blank where there is none, and perhaps the edge of the contact.

    The colours end at `highest`.
    """
    every = math.ceil(max(pressure.shape) / _MOST_CELLS)
    x, y, pressure = x[::every], y[::every], pressure[::every, ::every]
    if outlined:
        # Averaged over three cells, the staircase of the loaded cells is a curve.
        loaded = uniform_filter((pressure.T > 0.0).astype(float), 3, mode="constant")
        axes.contour(x, y, loaded, levels=[0.5], colors=[INK], linewidths=0.9)
    return heat_map(axes, x, y, np.ma.masked_equal(pressure, 0.0), "viridis", vmin=0.0, vmax=highest)


def highest_shown(*pressures: Array, share: float = 0.995) -> float:
    """Return where the colours of pressures should end: one point at a sharp edge would leave all others dark."""
    return float(np.quantile(np.concatenate([each[each > 0.0] for each in pressures]), share))


def draw_profile(axes: Axes, x: Array, pressure: Array, **style: Any) -> None:
    """Draw a pressure along a line, with a faint area below it."""
    axes.fill_between(x, pressure, color=BLUE, alpha=0.15, linewidth=0.0)
    axes.plot(x, pressure, color=BLUE, **style)


def draw_arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Draw an arrow between two places, in shares of the axes."""
    arrow = {"arrowstyle": "->", "color": INK, "linewidth": 1.2}
    axes.annotate("", end, start, "axes fraction", "axes fraction", arrowprops=arrow)


def _along(solution: ContactSolution) -> Unit:
    return unit_for(float(np.abs(solution.x).max()), "m")


def _label_along(solution: ContactSolution) -> str:
    """Return the label of the axis along the motion, with an arrow that shows where the indenter goes."""
    label = f"along the motion $x$ ({_along(solution).name})"
    if solution.speed == 0.0:
        return label
    return f"{label} →" if solution.speed > 0.0 else f"← {label}"


def plot_pressure_map(axes: Axes, solution: ContactSolution) -> QuadMesh:
    """Draw the pressure of a point contact seen from above, with the outline of the contact.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    solution : ContactSolution
        Of a ball or another indenter of finite size across the motion.

    Returns
    -------
    matplotlib.collections.QuadMesh
        For a colour bar, in Pa with the prefix that suits the largest pressure.
    """
    unit, pressure_unit = _along(solution), unit_for(solution.max_pressure, "Pa")
    pressure = solution.pressure / pressure_unit.size
    # One cell at a sharp edge would leave all others dark.
    highest = None if solution.diagnostics.peak_resolved else highest_shown(pressure, share=_SHARE_SHOWN)
    mesh = pressure_mesh(axes, solution.x / unit.size, solution.y / unit.size, pressure, highest, outlined=True)
    axes.plot([0.0], [0.0], marker="+", color=INK, markersize=9, linestyle="none")
    axes.set(xlabel=_label_along(solution), ylabel=f"across $y$ ({unit.name})")
    _draw_motion(axes, solution)
    return mesh


def _draw_motion(axes: Axes, solution: ContactSolution) -> None:
    """Draw an arrow that shows where the indenter goes."""
    if solution.speed == 0.0:
        return
    start, end = ((0.03, 0.15), (0.15, 0.03))[solution.speed < 0.0]
    draw_arrow(axes, (start, 0.95), (end, 0.95))
    axes.text(0.03, 0.91, "motion", transform=axes.transAxes, fontsize=8, va="top", color=INK)


def plot_pressure_profile(axes: Axes, solution: ContactSolution) -> None:
    """Draw the pressure along the centre line of a contact.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    solution : ContactSolution
    """
    unit, pressure_unit = _along(solution), unit_for(solution.max_pressure, "Pa")
    x, pressure = solution.x / unit.size, centre_line(solution.y, solution.pressure) / pressure_unit.size
    draw_profile(axes, x, pressure)
    centre = solution.centre_of_pressure / unit.size
    axes.axvline(0.0, color=GREY, linewidth=0.8)
    axes.axvline(centre, color=VERMILION, linewidth=1.2, linestyle=(0, (4, 2)), label="centre of pressure")
    axes.set_ylim(bottom=0.0)
    axes.set(ylabel=f"pressure $p$ ({pressure_unit.name})", xlabel=_label_along(solution))
    axes.legend(loc="best")


def plot_surface_profile(axes: Axes, solution: ContactSolution, indenter: Indenter) -> None:
    """Draw the deformed surface along the centre line, with the indenter that presses on it.

    Heights are counted from the level of the indentation, upwards.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    solution : ContactSolution
    indenter : Indenter
        The one that was solved.
    """
    unit = _along(solution)
    surface = -centre_line(solution.y, solution.displacement)
    rigid = _beneath(solution, indenter)
    depth_unit = unit_for(max(float(np.abs(surface).max()), abs(solution.indentation)), "m")
    x, shown = solution.x / unit.size, np.isfinite(rigid)
    top = max(float(surface.max()), 0.35 * solution.indentation) / depth_unit.size
    bottom = min(float(surface.min()), -solution.indentation) / depth_unit.size
    reach = top - bottom
    heights = np.where(shown, rigid, math.inf) / depth_unit.size
    ceiling = top + 0.15 * reach
    axes.fill_between(x, np.minimum(heights, ceiling), ceiling, color=GREY, alpha=0.35, linewidth=0.0, label="indenter")
    axes.plot(x, surface / depth_unit.size, color=INK, label="surface")
    axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle=(0, (1.5, 1.5)))
    axes.set_ylim(bottom - 0.12 * reach, ceiling)
    axes.set_xlim(float(x[0]), float(x[-1]))
    axes.set(xlabel=_label_along(solution), ylabel=f"height ({depth_unit.name})")
    axes.legend(loc="upper center", ncols=2)


def _beneath(solution: ContactSolution, indenter: Indenter) -> Array:
    """Height of the indenter's surface along the centre line, from the level of the indentation, m."""
    # The solution's x lies along the direction, and its y to the left of it; the heights have axes of their own.
    (ahead, aside), x, y = solution.direction, solution.x[:, None], solution.y
    heights = np.asarray(indenter.height(ahead * x - aside * y, aside * x + ahead * y))
    return np.asarray(centre_line(y, heights) - solution.indentation)


def contact_figure(solution: ContactSolution, indenter: Indenter, title: str = "") -> Figure:
    """Return a figure of a contact: the map of the pressure (of a point contact) and both profiles."""
    if solution.geometry == "line":
        figure = new_figure(6.2, 6.0)
        profile, surface = figure.subplots(2, 1, sharex=True, height_ratios=[1.2, 1.0])
    else:
        figure = new_figure(9.6, 4.8)
        left, right = figure.subfigures(1, 2, width_ratios=[1.15, 1.0], squeeze=False)[0]
        above = left.subplots()
        beyond = "neither" if solution.diagnostics.peak_resolved else "max"
        label = f"pressure $p$ ({unit_for(solution.max_pressure, 'Pa').name})"
        slender_bar(left, plot_pressure_map(above, solution), [above], label, extend=beyond)
        profile, surface = right.subplots(2, 1, sharex=True, height_ratios=[1.2, 1.0])
    plot_pressure_profile(profile, solution)
    profile.set_xlabel("")
    plot_surface_profile(surface, solution, indenter)
    figure.suptitle("\n".join(line for line in (title, _conditions(solution)) if line), fontsize=10.5)
    return figure


def _conditions(solution: ContactSolution) -> str:
    """Return speed, load, temperature and what friction came of them."""
    force = "N/m" if solution.geometry == "line" else "N"
    parts = [
        "infinite speed" if math.isinf(solution.speed) else prefixed(solution.speed, None, "m/s"),
        prefixed(solution.load, None, force),
    ]
    if solution.temperature is not None:
        parts.append(f"{shown_celsius(solution.temperature, 'z.4g')} °C")
    return f"{', '.join(parts)}: $\\mu$ = {significant(solution.friction_coefficient, 4)}"
