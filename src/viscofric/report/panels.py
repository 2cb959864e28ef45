"""Small multiples: which points of the axes get a panel, and how the panels stand."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

from viscofric.report.house_style import new_figure
from viscofric.report.sweeps import thinned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from viscofric.report.sweeps import SweepAxis


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
    figure = new_figure(7.4, 4.3) if count == 1 else new_figure(1.7 + 2.75 * columns, 0.8 + 2.5 * rows)
    grid = list(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel())
    for axes in grid[count:]:
        axes.remove()
    panels = grid[:count]
    for place, axes in enumerate(panels):
        axes.tick_params(labelbottom=place + columns >= count)
    return figure, panels
