"""Figures of how well the cases of a study were solved: error estimates, energy balance, cells."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from viscofric.arrays import Array, Mask
from viscofric.datasets import Dataset
from viscofric.report.figures.style import BLUE, GREEN, ORANGE, VERMILION, decade_ticks, new_figure, speed_ticks
from viscofric.report.results import interpolated, values

_SMALLEST = 1e-9  # relative errors below are drawn there
_FEW = 4.0  # points
_MANY = 2_000  # points that are drawn as an image within the figure


def plot_errors(axes: Axes, cases: Dataset, *, accuracy: float | None = None) -> None:
    """Draw the error estimate and the energy balance along `case`, over friction, with a line at the accuracy."""
    x = _along(cases)
    friction = np.abs(values(cases, "friction_coefficient"))
    between = interpolated(cases)
    with np.errstate(divide="ignore", invalid="ignore"):
        error = values(cases, "friction_error") / friction
    _points(axes, x, error, ~between, BLUE, "o", "error estimate")
    _points(axes, x, error, between, BLUE, "o", "error estimate, interpolated", markerfacecolor="none")
    balance = np.abs(values(cases, "energy_balance"))
    _points(axes, x, balance, ~between, ORANGE, "^", "energy balance")
    if accuracy is not None and np.isfinite(accuracy):
        axes.axhline(accuracy, color=VERMILION, linewidth=1.2, linestyle=(0, (4, 2)), label="requested accuracy")
    axes.set_yscale("log")
    _finish(axes, cases, "relative to friction")
    decade_ticks(axes.yaxis)


def plot_cells(axes: Axes, cases: Dataset) -> None:
    """Draw how many cells along the longer edge the finest grid of every solved case has."""
    cells = values(cases, "cells")
    _points(axes, _along(cases), cells, ~interpolated(cases), GREEN, "s", "cells")
    axes.set_yscale("log", base=2)
    axes.yaxis.set_major_formatter(lambda number, _: f"{number:.0f}")
    axes.minorticks_off()
    _finish(axes, cases, "cells along an edge")


def convergence_figure(cases: Dataset, *, accuracy: float | None = None) -> Figure | None:
    """Return errors and grids of all cases, or None where nothing is known of them."""
    if not np.isfinite(values(cases, "friction_error")).any() or cases.sizes["case"] < 2:
        return None
    has_cells = bool((np.isfinite(values(cases, "cells")) & ~interpolated(cases)).any())
    figure = new_figure(7.4, 5.0 if has_cells else 3.4)
    heights = [2.0, 1.0][: 1 + has_cells]
    panels = figure.subplots(1 + has_cells, 1, squeeze=False, sharex=True, height_ratios=heights)[:, 0]
    plot_errors(panels[0], cases, accuracy=accuracy)
    if has_cells:
        plot_cells(panels[1], cases)
        panels[0].set_xlabel("")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4, fontsize=8.5)
    return figure


def _has_speeds(cases: Dataset) -> bool:
    return np.unique(values(cases, "speed")).size > 1


def _along(cases: Dataset) -> Array:
    return np.asarray(1e3 * values(cases, "speed") if _has_speeds(cases) else 1.0 + np.arange(cases.sizes["case"]))


def _points(axes: Axes, x: Array, y: Array, mask: Mask, colour: str, marker: str, label: str, **look: Any) -> None:
    shown = mask & np.isfinite(y) & (y >= 0.0)
    if shown.any():
        look |= {"color": colour, "marker": marker, "markersize": _FEW, "linestyle": "none", "alpha": 0.75}
        y = np.maximum(y[shown], _SMALLEST)
        axes.plot(x[shown], y, label=label, rasterized=int(shown.sum()) > _MANY, **look)


def _finish(axes: Axes, cases: Dataset, label: str) -> None:
    if _has_speeds(cases):
        axes.set_xscale("log")
        speed_ticks(axes.xaxis)
        axes.set_xlabel("speed $v$ (mm/s)")
    else:
        axes.set_xlabel("case")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(label)
