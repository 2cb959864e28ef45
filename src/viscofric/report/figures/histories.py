"""The figures of a study's cases over time, and of its impacts: a few of them, with the band of the samples."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscofric.arrays import Array
from viscofric.datasets import Dataset, DataTree
from viscofric.report.figures.motion import label_restitution
from viscofric.report.figures.style import GREY, legend_above, looks, new_figure, unit_for
from viscofric.report.results import on_group
from viscofric.report.sweeps import SAMPLE, axis_of, band_of_samples, best_estimate, thinned
from viscofric.units import celsius

#: More lines cannot be distinguished.
MOST_LINES = 6
_ALONG = "instant"
#: Relative change of a load that is constant up to rounding and the solver's tolerance.
_CONSTANT = 1e-3


class _Line(NamedTuple):
    """One case: what distinguishes it, in words, and its results, also with samples of the material."""

    words: str
    best: Dataset
    samples: Dataset | None

    def band(self, name: str) -> tuple[Array, Array] | None:
        """Return the ends of the central 95 % of the samples, of few their range; None without samples."""
        if self.samples is None:
            return None
        values = self.samples[name].transpose(SAMPLE, ...).values
        low, high = band_of_samples(values[np.isfinite(values).all(axis=1)])
        return low, high


@on_group("history")
def histories_figure(data: Dataset, _: DataTree) -> Figure | None:
    """Return load, indentation, friction and rise of temperature of at most six cases against time."""
    lines = _lines(data, "time", _ALONG)
    slides = any(np.any(one.best["friction_force"].values != 0.0) for one in lines)
    varies = any(
        np.ptp(one.best["load_over_time"].values) > _CONSTANT * one.best["load_over_time"].max() for one in lines
    )
    load = "mean pressure $\\bar p$" if data.attrs["geometry"] == "rough" else "normal load $F$"
    force = str(data["load_over_time"].attrs["units"])
    shown = [
        *([("load_over_time", load, force)] if varies else []),
        ("indentation", r"indentation $\delta$", "m"),
        *([("friction_coefficient", r"friction coefficient $\mu$", "")] if slides else []),
        *([("temperature_rise", r"temperature rise $\Delta T$", "K")] if "temperature_rise" in data else []),
    ]
    figure = new_figure(6.2, 2.6 * len(shown) + 1.0)
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    seconds = unit_for(max(float(one.best["time"].values[-1]) for one in lines), "s")
    for panel, (name, label, base) in zip(panels, shown, strict=True):
        unit = unit_for(max(float(np.abs(one.best[name].values).max()) for one in lines), base)
        size = unit.size if base else 1.0
        _plot(panel, lines, name, [one.best["time"].values / seconds.size for one in lines], size, panel is panels[0])
        if name == "friction_coefficient" and "isothermal_friction_force" in data:
            _plot_isothermal(panel, lines, seconds.size)
        panel.axhline(0.0, color=GREY, linewidth=0.8)
        panel.set_ylabel(f"{label} ({unit.name})" if base else label)
    panels[-1].set_xlabel(f"time $t$ ({seconds.name})")
    return figure


@on_group("impact")
def impacts_figure(data: Dataset, _: DataTree) -> Figure | None:
    """Return the restitution of impacts against temperature or speed, whichever has more values."""
    along = "temperature" if data.sizes.get("temperature", 1) > data.sizes["impact_speed"] else "impact_speed"
    lines = _lines(data, "restitution", along)
    figure = new_figure()
    axes = figure.subplots()
    x = data[along].values if along == "impact_speed" else np.array([celsius(one) for one in data[along].values])
    _plot(axes, lines, "restitution", [x] * len(lines), 1.0, True, marked=True)
    label_restitution(axes, len(x) if along == "impact_speed" else 0)
    return figure


def _plot(
    axes: Axes, lines: list[_Line], name: str, x: list[Array], size: float, named: bool, *, marked: bool = False
) -> None:
    """Draw a quantity of some cases with their bands, and their legend above if it is to be `named`."""
    handles = []
    for one, places, look in zip(lines, x, looks(len(lines)), strict=True):
        dashes = {"marker": look.marker} if marked else {"linestyle": look.dashes}
        handles += axes.plot(places, one.best[name].values / size, color=look.colour, label=one.words, **dashes)
        if (band := one.band(name)) is not None:
            axes.fill_between(places, band[0] / size, band[1] / size, color=look.colour, alpha=0.2, linewidth=0.0)
    if named and any(one.words for one in lines):
        legend_above(axes, handles, columns=2)


def _plot_isothermal(axes: Axes, lines: list[_Line], second: float) -> None:
    """Draw the friction coefficients of heated contacts without heating, where there is a load."""
    for one, look in zip(lines, looks(len(lines)), strict=True):
        load = one.best["load_over_time"].values
        friction = one.best["isothermal_friction_force"].values / np.where(load > 0.0, load, np.nan)
        axes.plot(one.best["time"].values / second, friction, color=look.colour, linestyle=":", linewidth=0.8)


def _lines(data: Dataset, name: str, along: str) -> list[_Line]:
    """Return at most six solved cases, spread over all."""
    best = best_estimate(data)
    dimensions = [str(one) for one in best[name].dims if one != along]
    axes = [axis_of(best, one) for one in dimensions]
    solved = np.argwhere(np.isfinite(best[name].transpose(*dimensions, along).values).all(axis=-1))
    found = []
    for place in solved[thinned(len(solved), MOST_LINES)].tolist():
        words = ", ".join(axis.labels[index] for axis, index in zip(axes, place, strict=True))
        at = dict(zip(dimensions, place, strict=True))
        found.append(_Line(words, best.isel(at), data.isel(at) if SAMPLE in data.dims else None))
    return found
