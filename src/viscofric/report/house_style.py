"""How every figure looks: colours and marks that also read in grey, sane log ticks, an honest label."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import matplotlib
from matplotlib.figure import Figure
from matplotlib.ticker import (
    FixedFormatter,
    FixedLocator,
    LogLocator,
    MaxNLocator,
    NullFormatter,
    NullLocator,
)

from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

# Okabe and Ito's colours, which colour-blind readers tell apart
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
INK = "#222222"

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


class Look(NamedTuple):
    """Colour, mark and dashes of one temperature."""

    colour: Any
    marker: str
    dashes: Any


def looks(count: int) -> list[Look]:
    """Return a look for each of so many temperatures; many ones run from dark (cold) to light."""
    if count <= len(_COLOURS):
        colours: list[Any] = list(_COLOURS[:count])
    else:
        scale = matplotlib.colormaps["viridis"]
        colours = [scale(0.9 * index / (count - 1)) for index in range(count)]
    return [
        Look(colour, _MARKERS[index % len(_MARKERS)], _DASHES[index % len(_DASHES)])
        for index, colour in enumerate(colours)
    ]


def new_figure(width: float = 6.2, height: float = 4.3) -> Figure:
    """Return an empty figure of a size in inches, without pyplot's global state."""
    return Figure(figsize=(width, height))


def degrees(kelvin: float) -> str:
    """Return a temperature as figures and report print it: −30 °C, 22.5 °C."""
    text = f"{round(celsius(kelvin), 1) + 0.0:.1f}".removesuffix(".0")
    return f"{text} °C".replace("-", "−")


def decade_ticks(axis: Axis) -> None:
    """Label a log axis at whole powers of ten, not too many, and tick each decade between."""
    low, high = sorted(axis.get_view_interval())
    decades = math.log10(high / low)
    axis.set_major_locator(LogLocator(base=10.0, numticks=9))
    subs = [1.0] if decades > 6 else [float(digit) for digit in range(1, 10)]
    axis.set_minor_locator(LogLocator(base=10.0, subs=subs, numticks=200))
    axis.set_minor_formatter(NullFormatter())


def speed_ticks(axis: Axis) -> None:
    """Tick a short log axis in plain numbers (20, 50, 100, 200), a long one in powers of ten."""
    low, high = sorted(axis.get_view_interval())
    if math.log10(high / low) > 3.2:
        decade_ticks(axis)
        return
    shown = _preferred_numbers(low, high)
    axis.set_major_locator(FixedLocator(shown))
    axis.set_major_formatter(FixedFormatter([f"{number:.4g}" for number in shown]))
    if len(shown) > 2:
        axis.set_minor_locator(LogLocator(base=10.0, subs=[float(digit) for digit in range(1, 10)], numticks=50))
    else:
        axis.set_minor_locator(NullLocator())
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


def mark_synthetic(axes: Axes) -> None:
    """Say within the figure that its data are synthetic, and call nothing in its legend measured."""
    legend = axes.get_legend()
    if legend is not None:
        for text in (legend.get_title(), *legend.get_texts()):
            text.set_text(text.get_text().replace("measured", "synthetic"))
    axes.text(
        1.0,
        1.012,
        "synthetic data",
        transform=axes.transAxes,
        ha="right",
        va="bottom",
        fontsize=9,
        color=VERMILION,
    )


def at_temperature(kelvin: float | None) -> str:
    """Return the end of an axis's label that names its reference temperature, if that is known."""
    return "" if kelvin is None else f" at {degrees(kelvin)}"
