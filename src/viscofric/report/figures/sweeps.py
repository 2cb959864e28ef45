"""Figures of friction over the axes of a study: curves in one panel, or in small multiples."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.report.figures import style
from viscofric.report.results import shown_error
from viscofric.report.sweeps import (
    MOST_LINES,
    MOST_PANELS,
    SAMPLE,
    SEED,
    Layout,
    SweepAxis,
    band_of_samples,
    best_estimate,
    layout_of,
    seeds_averaged,
    thinned,
    words_of_band,
)

FRICTION = r"viscoelastic friction coefficient $\mu$"
_COEFFICIENT = "friction_coefficient"
_BAND = 0.18
_THIN: dict[str, Any] = {"linewidth": 0.7, "alpha": 0.45, "zorder": 1.5}  # of one surface among several
_HEADROOM = 1.06


def plot_sweep(axes: Axes, friction: Dataset, layout: Layout, shown: Sequence[int] = (0,)) -> None:
    """Draw friction along one axis of a study, a line for each point of another.

    Where there are members of the rubber's posterior (`sample`), the line is the best estimate, and the band holds 95 %
    of them.  Where there are surfaces that differ by chance (`seed`), each is a thin line behind their mean, and the
    band is the mean's 95 % interval; points at which one of them was not solved have no mean.  Bars are numerical
    errors that can be seen.

    `friction`: `friction_coefficient`, and perhaps `friction_lower` and `friction_upper`, over the axes of the
    layout (and `sample` and `seed`) only; `shown`: which points of the layout's lines are drawn.
    """
    along, lines = layout.along, layout.lines
    x = along.position
    for index, look in zip(shown, line_looks(lines, shown), strict=True):
        part = friction if lines is None else friction.isel({lines.name: index})
        mu, lower, upper = _middle_and_band(part, along.name)
        marks: dict[str, Any] = {"color": look.colour, "linestyle": look.dashes}
        if not along.is_ordered:
            marks["linestyle"] = "none"
        if np.isfinite(mu).sum() <= 15 or not along.is_ordered:
            marks |= {"marker": look.marker, "markersize": 4}
        if np.isfinite(lower).any():
            axes.fill_between(x, lower, upper, color=look.colour, alpha=_BAND, linewidth=0.0, zorder=1)
        style.error_bars(axes, x, mu, numerical_error(part, along.name), look.colour)
        axes.plot(x, mu, **marks)
        if (each := _of_seeds(part, along.name)) is not None:
            axes.plot(x, each, **(marks | {"markersize": 2}), **_THIN)
        missing = x[~np.isfinite(mu)]
        axes.plot(
            missing, np.full(missing.size, 0.03), "x", color=style.VERMILION, transform=axes.get_xaxis_transform()
        )


def plot_study(axes: Axes, friction: Dataset) -> None:
    """Draw friction over the first panel of a study's results (`StudyResults.dataset`), with its labels."""
    layout = layout_of(friction)
    if layout is None:
        raise InputError("these results have one case only: there is no curve to draw.", code="one-case")
    shown = thinned(1 if layout.lines is None else len(layout.lines), MOST_LINES)
    plot_sweep(axes, friction.isel({panel.name: 0 for panel in layout.panels}), layout, shown)
    _finish(axes, layout.along, narrow=False)
    axes.set(xlabel=layout.along.axis_label if layout.along.is_ordered else "", ylabel=FRICTION)
    _legend_beside(axes, friction, layout, shown)


def _middle_and_band(part: Dataset, along: str) -> tuple[Array, Array, Array]:
    """Return friction along an axis and the limits of its band, NaN where there is none."""
    each = _of_seeds(part, along)
    if each is not None:
        from viscofric.roughness.rough_friction import interval_of_mean

        return each.mean(axis=-1), *interval_of_mean(each)
    mu = np.asarray(best_estimate(part)[_COEFFICIENT].values, dtype=float)
    if SAMPLE in part[_COEFFICIENT].dims:
        members = part[_COEFFICIENT].transpose(SAMPLE, along).values
        known = np.isfinite(members).any(axis=0)
        ends = np.full((2, members.shape[1]), np.nan)
        ends[:, known] = band_of_samples(members[:, known])
        return mu, ends[0], ends[1]
    none = np.full(mu.shape, np.nan)
    names = ("friction_lower", "friction_upper")
    lower, upper = (np.asarray(part[name].values, dtype=float) if name in part else none for name in names)
    return mu, lower, upper


def numerical_error(part: Dataset, along: str = "") -> Array:
    """Return the numerical error of friction (along an axis) where it can be seen, the mean over surfaces."""
    if "friction_error" not in part:
        return np.full(part.sizes.get(along, 1), np.nan)
    best = best_estimate(part)[[_COEFFICIENT, "friction_error"]]
    best = best.mean(SEED) if SEED in best.dims and along != SEED else best
    return shown_error(best[_COEFFICIENT].values, best["friction_error"].values)


def _of_seeds(part: Dataset, along: str) -> Array | None:
    """Return friction along an axis on each of several surfaces, best estimate of the rubber; None without them."""
    best = best_estimate(part)[_COEFFICIENT]
    if SEED not in best.dims or along == SEED:
        return None
    return np.asarray(best.transpose(along, SEED).values, dtype=float)


def line_looks(lines: SweepAxis | None, shown: Sequence[int]) -> list[style.Look]:
    """Return a look for each line: colours apart where they are few or have no order, a scale where they have one."""
    if lines is None or not lines.is_ordered or lines.name == "temperature":
        return style.looks(len(shown))
    return style.sequential_looks(len(shown))


def sweep_figure(friction: Dataset) -> Figure | None:
    """Return labelled friction over all axes of a study: curves in one panel, or in small multiples with one scale."""
    layout = layout_of(friction)
    if layout is None or not np.isfinite(friction[_COEFFICIENT].values).any():
        return None
    chosen = panel_points(layout.panels, MOST_PANELS)
    shown = thinned(1 if layout.lines is None else len(layout.lines), MOST_LINES)
    figure, panels = small_multiples(len(chosen))
    for axes, place in zip(panels, chosen, strict=True):
        plot_sweep(axes, friction.isel(place), layout, shown)
        axes.set_title(panel_title(layout.panels, place), fontsize=9.5)
    for axes in panels:
        _finish(axes, layout.along, narrow=len(panels) > 1)
    _label_outside(figure, layout.along, panels)
    _legend_beside(panels[columns_of(len(panels)) - 1], friction, layout, shown)
    return figure


def _finish(axes: Axes, along: SweepAxis, narrow: bool) -> None:
    if along.is_logarithmic:
        axes.set_xscale("log")
        if along.name == "speed":
            style.speed_ticks(axes.xaxis, narrow)
        else:
            style.decade_ticks(axes.xaxis)
    elif not along.is_ordered:
        axes.set_xticks(along.position, along.labels, rotation=30, ha="right")
        axes.set_xlim(along.position[0] - 0.5, along.position[-1] + 0.5)
        axes.tick_params(axis="x", top=False)
    if axes.get_ylim()[1] > 0.0 and axes.dataLim.y0 >= 0.0:
        axes.set_ylim(0.0, max(axes.get_ylim()[1], _HEADROOM * axes.dataLim.y1))
    style.plain_numbers(axes, "y")


def _label_outside(figure: Figure, along: SweepAxis, panels: Sequence[Axes]) -> None:
    label = along.axis_label if along.is_ordered else ""
    if len(panels) == 1:
        panels[0].set_xlabel(label)
        panels[0].set_ylabel(FRICTION)
    else:
        figure.supxlabel(label, fontsize=10.5)
        figure.supylabel(FRICTION, fontsize=10.5)


def _legend_beside(axes: Axes, friction: Dataset, layout: Layout, shown: Sequence[int]) -> None:
    """Put one legend beside the panels: what the colours mean, what bands and crosses are."""
    handles: list[Any] = []
    if layout.lines is not None:
        for index, look in zip(shown, line_looks(layout.lines, shown), strict=True):
            marks: dict[str, Any] = {"color": look.colour, "linestyle": look.dashes}
            if not layout.along.is_ordered or len(layout.along) <= 15:
                marks |= {"marker": look.marker, "markersize": 4}
            handles.append(Line2D([], [], label=layout.lines.labels[index], **marks))
        if layout.lines.is_ordered:
            handles.reverse()
    if seeds := seeds_averaged(friction):
        handles.append(Patch(facecolor=style.GREY, alpha=2.0 * _BAND, label="95 % interval\nof the mean"))
        handles.append(Line2D([], [], color=style.GREY, label=f"{seeds} seeds", **_THIN))
    elif SAMPLE in friction[_COEFFICIENT].dims:
        band = f"{words_of_band(friction, _COEFFICIENT)} of samples"
        handles.append(Patch(facecolor=style.GREY, alpha=2.0 * _BAND, label=band))
    elif "friction_lower" in friction and np.isfinite(friction["friction_lower"].values).any():
        handles.append(Patch(facecolor=style.GREY, alpha=2.0 * _BAND, label="95 % band"))
    if np.isfinite(numerical_error(friction)).any():
        handles.append(Line2D([], [], color=style.GREY, marker="|", linestyle="none", label="numerical error"))
    if not np.isfinite(friction[_COEFFICIENT].values).all():
        handles.append(Line2D([], [], color=style.VERMILION, marker="x", linestyle="none", label="not solved"))
    if handles:
        style.legend_beside(axes, handles, "" if layout.lines is None else layout.lines.title)


def columns_of(count: int) -> int:
    """Return how many of so many panels stand beside each other."""
    return 2 if count == 4 else min(count, 3)


def panel_points(panels: Sequence[SweepAxis], most: int) -> list[dict[str, int]]:
    """Return the places of the panels along their axes, the longest axis thinned first where there are too many."""
    counts = [len(axis) for axis in panels]
    while math.prod(counts) > most and max(counts) > 2:
        longest = counts.index(max(counts))
        counts[longest] -= 1
    shown = [thinned(len(axis), count) for axis, count in zip(panels, counts, strict=True)]
    return [dict(zip([axis.name for axis in panels], place, strict=True)) for place in itertools.product(*shown)][:most]


def panel_count(panels: Sequence[SweepAxis], most: int) -> tuple[int, int]:
    """Return how many panels are drawn, and of how many."""
    return len(panel_points(panels, most)), math.prod(len(axis) for axis in panels)


def panel_title(panels: Sequence[SweepAxis], place: dict[str, int]) -> str:
    """Return what a panel shows: its point along each of its axes."""
    return ", ".join(axis.labels[place[axis.name]] for axis in panels)


def small_multiples(count: int) -> tuple[Figure, list[Axes]]:
    """Return a figure with so many panels on common scales, those inside without numbers on their axes."""
    columns = columns_of(count)
    rows = math.ceil(count / columns)
    figure = style.new_figure(*style.WIDE) if count == 1 else style.new_figure(1.7 + 2.75 * columns, 0.8 + 2.5 * rows)
    grid = list(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel())
    for axes in grid[count:]:
        axes.remove()
    panels = grid[:count]
    for place, axes in enumerate(panels):
        axes.tick_params(labelbottom=place + columns >= count)
    return figure, panels
