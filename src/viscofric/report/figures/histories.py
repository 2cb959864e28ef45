"""The figure of a study's cases over time: indentation and friction of a few of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.report.figures.style import GREY, legend_above, looks, new_figure, unit_for
from viscofric.report.results import group
from viscofric.report.sweeps import axis_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

#: More lines cannot be told apart.
MOST_LINES = 6
_ALONG = "instant"


def histories_figure(tree: xr.DataTree) -> Figure | None:
    """Return indentation and, where it slides, friction against time, of at most six cases spread over the study."""
    data = group(tree, "history")
    if data is None:
        return None
    lines = _lines(data)
    slides = any(np.any(one["friction_force"].values != 0.0) for _, one in lines)
    shown = [("indentation", r"indentation $\delta$", "m"), *([_FRICTION] if slides else [])]
    figure = new_figure(6.2, 2.6 * len(shown) + 1.0)
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    seconds = unit_for(max(float(one["time"].values[-1]) for _, one in lines), "s")
    for panel, (name, label, base) in zip(panels, shown, strict=True):
        unit = unit_for(max(float(np.abs(one[name].values).max()) for _, one in lines), base)
        size = unit.size if base else 1.0
        handles = []
        for (words, one), look in zip(lines, looks(len(lines)), strict=True):
            x, y = one["time"].values / seconds.size, one[name].values / size
            handles += panel.plot(x, y, color=look.colour, linestyle=look.dashes, label=words)
        panel.axhline(0.0, color=GREY, linewidth=0.8)
        panel.set_ylabel(f"{label} ({unit.name})" if base else label)
        if panel is panels[0] and any(words for words, _ in lines):
            legend_above(panel, handles, columns=2)
    panels[-1].set_xlabel(f"time $t$ ({seconds.name})")
    return figure


_FRICTION = ("friction_coefficient", r"friction coefficient $\mu$", "")


def _lines(data: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    """Return at most six solved cases with what tells them apart, in words."""
    dimensions = [str(name) for name in data["time"].dims if name != _ALONG]
    axes = [axis_of(data, name) for name in dimensions]
    solved = np.argwhere(np.isfinite(data["time"].transpose(*dimensions, _ALONG).values).all(axis=-1))
    chosen = np.unique(np.linspace(0, len(solved) - 1, min(MOST_LINES, len(solved))).round().astype(int))
    found = []
    for place in solved[chosen].tolist():
        words = ", ".join(axis.labels[index] for axis, index in zip(axes, place, strict=True))
        found.append((words, data.isel(dict(zip(dimensions, place, strict=True)))))
    return found
