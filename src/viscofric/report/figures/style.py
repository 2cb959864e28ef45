"""Style of every figure: colours and markers that also read in grey, ticks of log axes, label of synthetic data."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Literal, NamedTuple

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.collections import QuadMesh
from matplotlib.colorbar import Colorbar
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure, FigureBase
from matplotlib.lines import Line2D
from matplotlib.ticker import (
    FixedFormatter,
    FixedLocator,
    LogFormatterSciNotation,
    LogLocator,
    MaxNLocator,
    NullFormatter,
    NullLocator,
)

from viscofric.arrays import Array
from viscofric.report.texts.numbers import degrees
from viscofric.units import celsius

# Okabe and Ito's colours, which colour-blind readers can distinguish
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
INK, GREY = "#222222", "#8a8a8a"
#: White of marks inside a map.
WHITE = "#fefefe"

_COLOURS = (BLUE, GREEN, VERMILION, PURPLE, ORANGE, SKY)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_DASHES: tuple[Any, ...] = ("-", (0, (6, 1.5)), (0, (1.5, 1.2)), (0, (6, 1.5, 1.5, 1.5)))

#: matplotlib's settings while a figure is drawn and written.
STYLE: Mapping[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 10.0,
    "axes.labelsize": 10.5,
    "axes.linewidth": 0.8,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.fontsize": 9.0,
    "legend.title_fontsize": 9.0,
    "legend.frameon": True,
    "legend.framealpha": 0.9,
    "legend.edgecolor": "none",
    "lines.linewidth": 1.6,
    "lines.markersize": 5.5,
    "errorbar.capsize": 2.5,
    "figure.constrained_layout.use": True,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "mathtext.fontset": "dejavusans",
    "svg.fonttype": "path",
}


#: Size of a figure with a legend beside it, inches.
WIDE = (7.4, 4.3)


class Unit(NamedTuple):
    """A unit of an axis: its size in SI, and what it is called."""

    size: float
    name: str


def unit_for(largest: float, base: str = "m") -> Unit:
    """Return the unit in which the largest of some numbers is neither very small nor very large."""
    for size, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ")):
        if largest >= 0.5 * size:
            return Unit(size, prefix + base)
    return Unit(1e-9, "n" + base)


class ModulusPart(NamedTuple):
    """Name, symbol and look of the storage or the loss modulus."""

    name: Literal["storage", "loss"]
    symbol: str
    marker: str
    colour: str


MODULI = (ModulusPart("storage", "$E'$", "s", BLUE), ModulusPart("loss", "$E''$", "o", VERMILION))


class Look(NamedTuple):
    """Colour, mark and dashes of one temperature."""

    colour: Any
    marker: str
    dashes: Any


def looks(count: int) -> list[Look]:
    """Return a look for each of so many temperatures; many ones run from dark (cold) to light."""
    return _marked(_COLOURS[:count]) if count <= len(_COLOURS) else sequential_looks(count)


def _marked(colours: Sequence[Any]) -> list[Look]:
    return list(map(Look, colours, itertools.cycle(_MARKERS), itertools.cycle(_DASHES)))


def sequential_looks(count: int) -> list[Look]:
    """Return a look for each of so many values of an ordered quantity, from dark (low) to light."""
    scale = matplotlib.colormaps["viridis"]
    return _marked([scale(0.88 * index / max(count - 1, 1)) for index in range(count)])


def new_figure(width: float = 6.2, height: float = 4.3, *, title: str = "") -> Figure:
    """Return an empty figure of a size in inches, without pyplot's global state."""
    figure = Figure(figsize=(width, height))
    if title:
        figure.suptitle(title, fontsize=10.5)
    return figure


def one_panel(draw: Callable[..., object], *arguments: Any, size: tuple[float, ...] = (), **settings: Any) -> Figure:
    """Return a figure of a size in inches with what `draw` draws on its one Axes."""
    figure = new_figure(*size)
    draw(figure.subplots(), *arguments, **settings)
    return figure


def heat_map(axes: Axes, x: Array, y: Array, field: Any, colours: str, **limits: Any) -> QuadMesh:
    """Draw a field (nx, ny) seen from above in named colours, blank where it is masked."""
    scale = matplotlib.colormaps[colours]
    mesh: QuadMesh = axes.pcolormesh(x, y, field.T, cmap=scale, shading="nearest", rasterized=True, **limits)
    axes.set_aspect("equal")
    axes.grid(visible=False)
    return mesh


#: Axes of fewer decades than this have 2s and 5s labelled too, in plain numbers …
_FEW_DECADES = 2.0
#: … or, where those would be too long, as multiples of powers of ten, for which there is less room.
_FEWER_DECADES = 1.0


def decade_ticks(axis: Axis) -> None:
    """Label a log axis at whole powers of ten, as many as have room, and tick each decade between.

    An axis of up to two decades is labelled at 1, 2 and 5 of each, a shorter one at round numbers.
    """
    low, high = sorted(axis.get_view_interval())
    decades = math.log10(high / low)
    axis.set_minor_formatter(NullFormatter())
    plain = low >= 1e-3 and high < 1e4
    if decades < (_FEW_DECADES if plain else _FEWER_DECADES):
        _short_log_ticks(axis, low, high, plain)
        return
    axis.set_major_locator(LogLocator(base=10.0, numticks="auto"))  # type: ignore[arg-type]
    axis.set_major_formatter(LogFormatterSciNotation(base=10.0))
    subs = [1.0] if decades > 6 else [float(digit) for digit in range(1, 10)]
    axis.set_minor_locator(LogLocator(base=10.0, subs=subs, numticks=200))


def logarithmic(axes: Axes, which: Literal["x", "y", "xy"] = "xy") -> None:
    """Make axes logarithmic, with ticks of decades; what is drawn afterwards does not move these."""
    for axis in which:
        axes.set(**{f"{axis}scale": "log"})
        decade_ticks(getattr(axes, f"{axis}axis"))


def error_bars(axes: Axes, x: Array, y: Array, error: Array, colour: Any) -> None:
    """Draw bars of numerical errors where there are any, on a line that is drawn by others."""
    if np.isfinite(error).any():
        axes.errorbar(x, y, yerr=error, fmt="none", ecolor=colour, elinewidth=1.0)


def legend_beside(axes: Axes, handles: Sequence[Any] | None = None, title: str = "", **style: Any) -> None:
    """Put a legend to the right of the axes."""
    style |= {} if handles is None else {"handles": list(handles)}
    axes.legend(title=title or None, loc="upper left", bbox_to_anchor=(1.0, 1.0), alignment="left", **style)


def temperature_handles(nominal: Array) -> list[Any]:
    """Return what a legend shows of the points of some temperatures (K)."""
    return [
        Line2D([], [], color=look.colour, marker=look.marker, linestyle="none", label=degrees(float(kelvin)))
        for look, kelvin in zip(looks(nominal.size), nominal, strict=True)
    ]


def _short_log_ticks(axis: Axis, low: float, high: float, plain: bool) -> None:
    shown = _preferred_numbers(low, high)
    axis.set_major_locator(FixedLocator(shown))
    axis.set_major_formatter(FixedFormatter([f"{number:.4g}" if plain else _scientific(number) for number in shown]))
    ticks = [float(digit) for digit in range(1, 10)]
    axis.set_minor_locator(LogLocator(base=10.0, subs=ticks, numticks=50) if len(shown) > 2 else NullLocator())


def _scientific(number: float) -> str:
    power = math.floor(math.log10(number) + 1e-9)
    digits = f"{number / 10.0**power:.3g}"
    return rf"$10^{{{power}}}$" if digits == "1" else rf"${digits}\times10^{{{power}}}$"


def speed_ticks(axis: Axis, narrow: bool = False) -> None:
    """Tick a short log axis in plain numbers (20, 50, 100, 200), a long one, or a narrow panel's, in powers of ten."""
    low, high = sorted(axis.get_view_interval())
    if math.log10(high / low) > (1.6 if narrow else 3.2):
        decade_ticks(axis)
        return
    _short_log_ticks(axis, low, high, plain=True)
    axis.set_minor_formatter(NullFormatter())


def _preferred_numbers(low: float, high: float) -> list[float]:
    """Return round numbers within a range: 1–2–5, finer ones if they are too few, evenly spaced at last."""
    powers = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)
    series: tuple[tuple[float, ...], ...] = ((1, 2, 5), (1, 1.5, 2, 3, 4, 5, 6, 8))
    for digits in series:
        shown = [digit * 10.0**power for power in powers for digit in digits]
        shown = [number for number in shown if low <= number <= high]
        if len(shown) >= 3:
            return shown
    even = MaxNLocator(nbins=5).tick_values(low, high)
    return [float(number) for number in even if low <= number <= high]


def plain_numbers(axes: Axes, axis: Literal["x", "y"]) -> None:
    """Write a linear axis's numbers without offset or power of ten."""
    axes.ticklabel_format(axis=axis, style="plain", useOffset=False)


def legend_above(axes: Axes, handles: Sequence[Any], columns: int = 2) -> None:
    """Put a legend above the axes, where it covers no data."""
    style: dict[str, Any] = {"ncols": columns, "borderaxespad": 0.2, "columnspacing": 1.2}
    legend = axes.legend(handles=list(handles), loc="lower left", bbox_to_anchor=(0.0, 1.0), **style)
    legend.set_gid(_ABOVE)


_ABOVE = "legend above"


def origin(synthetic: bool) -> str:
    """Return what a label calls data that were measured, or calculated instead."""
    return "synthetic" if synthetic else "measured"


def mark_synthetic(panels: Sequence[Axes]) -> None:
    """Write beside the last panel that the data are synthetic.

    Parameters
    ----------
    panels : sequence of matplotlib.axes.Axes
    """
    last = panels[-1]
    figure = last.figure.figure  # that which holds all subfigures
    if last.get_title() and figure.get_supxlabel():  # small multiples: their titles are above
        figure.text(0.995, 0.005, "synthetic data", fontsize=9, color=VERMILION, ha="right", va="bottom")
        return
    legend = last.get_legend()
    # Beside the axes where the legend stands above them, for neither may hide the other.
    place: dict[str, Any] = {"x": 1.01, "y": 1.0, "rotation": 270, "ha": "left", "va": "top"}
    if legend is None or legend.get_gid() != _ABOVE:
        place = {"x": 1.0, "y": 1.012, "ha": "right", "va": "bottom"}
    last.text(s="synthetic data", transform=last.transAxes, fontsize=9, color=VERMILION, **place)


def temperature_scale(nominal: Array) -> ScalarMappable:
    """Return colours of temperatures (K in, °C on the scale), dark where cold, none too light for paper."""
    cold, hot = (celsius(float(kelvin)) for kelvin in (nominal.min(), nominal.max()))
    if cold == hot:
        cold, hot = cold - 1.0, hot + 1.0
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.92, 256))
    return ScalarMappable(Normalize(cold, hot), ListedColormap(colours))


_BAR_WIDTH = 0.13  # inches


def slender_bar(
    figure: FigureBase, scale: ScalarMappable, panels: Sequence[Axes], label: str, **style: Any
) -> Colorbar:
    """Add a slender colour bar to the right of panels."""
    whole: Any = figure.figure
    slender = max(whole.get_figheight() / _BAR_WIDTH, 15.0)
    bar = figure.colorbar(scale, ax=list(panels), label=label, pad=0.015, aspect=slender, **style)
    bar.ax.tick_params(top=False, bottom=False, left=False)
    return bar


#: Add the colour bar of a temperature scale to the right of panels.
temperature_bar = partial(slender_bar, label="temperature (°C)")


def reduced_frequency(kelvin: float | None = None) -> str:
    """Return the label of an axis of reduced frequencies, with the reference temperature if that is known."""
    return r"reduced angular frequency $\alpha_T\,\omega$ (rad/s)" + at_temperature(kelvin)


def at_temperature(kelvin: float | None, before: str = "") -> str:
    """Return the end of an axis's label that names its reference temperature, if that is known."""
    return "" if kelvin is None or math.isnan(kelvin) else f"{before} at {degrees(kelvin)}"
