"""Figures of the verification pages: line contact, errors against the cell, large windows, published results."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from viscofric.arrays import Array
from viscofric.report.figures.style import BLUE, GREY, INK, decade_ticks, legend_above, looks
from viscofric.units import shown_number
from viscofric.verification.refinement import Refinement, Windows

_LEAST_SHOWN = 1e-8


def plot_hunter(
    axes: Axes, exact: Mapping[float, tuple[Array, Array]], found: Mapping[float, tuple[Array, Array]]
) -> None:
    """Draw the friction of line contacts against speed: closed forms as lines, solutions as points."""
    handles = []
    for (ratio, (memory, friction)), look in zip(exact.items(), looks(len(exact)), strict=True):
        axes.plot(memory, friction, color=look.colour, linewidth=1.2)
        label = rf"$E_\infty/E_0$ = {ratio:g}"
        handles += axes.plot(*found[ratio], color=look.colour, marker=look.marker, linestyle="none", label=label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)
    axes.set_ylabel(r"friction $\mu R/a_0$")
    axes.set_xlabel(r"speed $v\tau/a_0$")
    legend_above(axes, handles, columns=4)


def plot_errors(axes: Axes, memory: Mapping[float, Array], errors: Mapping[float, Array], bound: float) -> None:
    """Draw relative errors of friction against speed, with the accuracy that was requested."""
    for (ratio, sizes), look in zip(errors.items(), looks(len(errors)), strict=True):
        shown = np.maximum(sizes, _LEAST_SHOWN)
        axes.plot(memory[ratio], shown, color=look.colour, marker=look.marker, linestyle="none")
    axes.axhline(bound, color=INK, linewidth=1.0, linestyle=(0, (6, 1.5)))
    axes.annotate(
        "requested accuracy",
        (0.99, bound),
        xytext=(0, 3),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        fontsize=8,
        ha="right",
    )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(bottom=0.5 * min(float(sizes.min()) for sizes in errors.values()), top=5.0 * bound)
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)
    axes.set_ylabel("relative error")
    axes.set_xlabel(r"speed $v\tau/a_0$")


def plot_orders(axes: Axes, found: Refinement) -> None:
    """Draw errors against the cells across the window, and the slopes of first and second order."""
    for (quantity, errors), look in zip(found.errors.items(), looks(len(found.errors)), strict=True):
        size = np.maximum(np.abs(errors), _LEAST_SHOWN)
        axes.plot(found.cells, size, color=look.colour, marker=look.marker, linestyle=look.dashes, label=quantity)
    floor = max(found.floor.values())
    if floor > _LEAST_SHOWN:
        axes.axhspan(_LEAST_SHOWN, floor, color=GREY, alpha=0.25, linewidth=0.0, label="error of the reference")
    start = max(float(np.abs(errors[0])) for errors in found.errors.values())
    for order in (1, 2):
        line = 1.5 * start * (found.cells[0] / found.cells) ** order
        axes.plot(found.cells, line, color=GREY, linewidth=0.8)
        end = float(found.cells[-1]), float(line[-1])
        offset = {"xytext": (6.0, 0.0), "textcoords": "offset points"}
        axes.annotate(f"$h^{order}$", end, **offset, color=GREY, va="center", fontsize=8)  # type: ignore[arg-type]
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    decade_ticks(axes.yaxis)
    axes.set_xticks(found.cells, [str(count) for count in found.cells], fontsize=8)
    axes.minorticks_off()
    # Room for the names of the slopes, whatever the number of grids.
    octaves = math.log2(found.cells[-1] / found.cells[0])
    axes.set_xlim(found.cells[0] * 2.0 ** (-0.06 * octaves), found.cells[-1] * 2.0 ** (0.13 * octaves))
    axes.set_xlabel("cells across the window")
    axes.set_ylabel("relative error")
    axes.set_title(found.name, fontsize=9.5)
    axes.legend(loc="lower left", fontsize=7.5)


def plot_windows(axes: Axes, found: Windows) -> None:
    """Draw by how much the friction of a ball among its images falls short of that of one alone."""
    (look,) = looks(1)
    axes.plot(found.periods, 100.0 * np.abs(found.deviations), color=look.colour, marker=look.marker)
    for period, deviation in zip(found.periods, found.deviations, strict=True):
        text = f"{shown_number(100.0 * deviation, '.0f' if abs(deviation) > 0.02 else '.1f')} %"
        axes.annotate(text, (period, 100.0 * abs(deviation)), xytext=(6, 4), textcoords="offset points", fontsize=9)
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    decade_ticks(axes.yaxis)
    axes.set_xticks(found.periods, [f"{period:g}" for period in found.periods])
    axes.minorticks_off()
    axes.set_xlim(found.periods[0] / math.sqrt(2.0), found.periods[-1] * 2.0)
    axes.set_ylim(top=100.0)
    axes.set_xlabel(r"period $L/a_0$")
    axes.set_ylabel("friction missing (%)")


def plot_sliding_ball(axes: Axes, memory: Array, friction: Array, points: Array) -> None:
    """Draw the friction of a ball against speed, and published points (vτ/a0, μ, relative tolerance) on it."""
    axes.plot(memory, friction, color=BLUE, linewidth=1.2, label="viscofric")
    bars = points[:, 1] * points[:, 2]
    axes.errorbar(points[:, 0], points[:, 1], yerr=bars, color=INK, marker="o", linestyle="none", label="published")
    axes.set_xscale("log")
    axes.set_ylim(bottom=0.0)
    decade_ticks(axes.xaxis)
    axes.set_xlabel(r"speed $v\tau/a_0$")
    axes.set_ylabel("friction coefficient")
    legend_above(axes, axes.get_legend_handles_labels()[0], columns=2)


def plot_deviations(axes: Axes, deviations: Mapping[str, tuple[Array, Array]]) -> None:
    """Draw, for each check, the relative differences of all its comparisons, and their bounds."""
    for place, (errors, bounds) in enumerate(deviations.values()):
        shown = np.maximum(errors, _LEAST_SHOWN)
        axes.plot(bounds, np.full(len(bounds), place), color=GREY, marker="|", markersize=11, linestyle="none")
        axes.plot(shown, np.full(len(shown), place), color=BLUE, marker="o", markersize=4, linestyle="none")
    axes.set_xscale("log")
    decade_ticks(axes.xaxis)
    axes.set_yticks(range(len(deviations)), list(deviations))
    axes.invert_yaxis()
    axes.set_xlabel("relative difference (bars: bounds)")
