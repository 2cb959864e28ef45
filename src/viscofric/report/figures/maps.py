"""Friction as a map over speed and temperature, with the ridge of its maximum."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import matplotlib
import matplotlib.patheffects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from viscofric.arrays import Array
from viscofric.datasets import Dataset, DataTree
from viscofric.report.figures.style import INK, VERMILION, WHITE, slender_bar, speed_ticks
from viscofric.report.figures.sweeps import FRICTION, panel_points, panel_title, small_multiples
from viscofric.report.results import group, rubbers, values
from viscofric.report.sweeps import SEED, best_estimate, seeds_averaged, sweep_axes

_COEFFICIENT = "friction_coefficient"
_LEVELS = 10
#: A map asks for so many speeds and temperatures.
LEAST_SPEEDS, LEAST_TEMPERATURES = 4, 3
_MOST_MAPS = 6
#: Up to so many temperatures are marked in a map.
MARKED_TEMPERATURES = 10


def plot_friction_map(
    axes: Axes,
    speed: Array,
    temperature: Array,
    friction: Array,
    *,
    levels: Array | int = _LEVELS,
    shift: tuple[Array, Array] | None = None,
) -> QuadContourSet:
    """Draw friction (m, n) over log speed (n,), m/s, and temperature (m,), K, with the ridge of its maximum."""
    x, y = 1e3 * np.asarray(speed), np.asarray(temperature) - 273.15
    kelvin, whole = filled_in(np.asarray(speed), np.asarray(temperature), np.asarray(friction), shift)
    known, rows = np.ma.masked_invalid(whole), kelvin - 273.15
    filled: QuadContourSet = axes.contourf(x, rows, known, levels=levels, cmap=matplotlib.colormaps["viridis"])
    axes.contour(x, rows, known, levels=filled.levels, colors=WHITE, linewidths=0.4, alpha=0.6)
    ridge = maximum_ridge(speed, temperature, friction)
    if ridge.size:
        around = [matplotlib.patheffects.withStroke(linewidth=3.0, foreground=WHITE)]
        look: dict[str, Any] = {"color": VERMILION, "marker": "D", "markersize": 3.5, "path_effects": around}
        axes.plot(1e3 * ridge[:, 0], ridge[:, 1] - 273.15, label="maximum", **look)
    if y.size <= MARKED_TEMPERATURES:
        axes.hlines(y, x.min(), x.max(), colors=WHITE, linewidths=0.6, linestyles=":", alpha=0.7)
    axes.set_xscale("log")
    axes.set_xlim(x.min(), x.max())
    axes.set_ylim(y.min(), y.max())
    axes.grid(visible=False)
    speed_ticks(axes.xaxis)
    return filled


def maximum_ridge(speed: Array, temperature: Array, friction: Array) -> Array:
    """Return speed (m/s) and temperature (K) of the highest friction (m, n) at each temperature, (m, 2).

    It is refined by a parabola through three points over the logarithm of the speed; NaN where it lies at an end or a
    neighbour is not solved.
    """
    found = []
    log = np.log(np.asarray(speed, dtype=float))
    for kelvin, row in zip(np.asarray(temperature).tolist(), np.asarray(friction, dtype=float), strict=True):
        if not np.isfinite(row).any():
            found.append((math.nan, math.nan))
            continue
        top = int(np.nanargmax(row))
        if not 0 < top < len(row) - 1 or not np.isfinite(row[top - 1 : top + 2]).all():
            found.append((math.nan, math.nan))
            continue
        curvature, slope, _ = np.polyfit(log[top - 1 : top + 2] - log[top], row[top - 1 : top + 2], 2)
        step = -0.5 * slope / curvature if curvature < 0.0 else 0.0
        found.append((math.exp(log[top] + step), kelvin))
    return np.array(found).reshape(-1, 2)


def map_figure(
    friction: Dataset, measurement: tuple[Array, Array] | None = None, shifts: Sequence[tuple[Array, Array] | None] = ()
) -> Figure | None:
    """Return friction as maps over speed and temperature on one scale, the mean over seeds; None of too few points.

    `measurement`: speeds (m/s) and temperatures (K) to mark; `shifts`: temperatures (K) and log10 α of each rubber.
    """
    sizes = friction.sizes
    if sizes.get("speed", 0) < LEAST_SPEEDS or sizes.get("temperature", 0) < LEAST_TEMPERATURES:
        return None
    if seeds_averaged(friction):
        friction = friction[[_COEFFICIENT]].mean(SEED, skipna=False)
    mu = best_estimate(friction)[_COEFFICIENT].sortby(["temperature", "speed"])
    if np.isfinite(mu.values).sum() < LEAST_SPEEDS * LEAST_TEMPERATURES:
        return None
    panels = [axis for axis in sweep_axes(friction) if axis.name not in ("speed", "temperature")]
    chosen = panel_points(panels, _MOST_MAPS)
    figure, grid = small_multiples(len(chosen))
    lowest, highest = np.nanquantile(mu.values, [0.0, 1.0])
    levels = np.asarray(MaxNLocator(_LEVELS).tick_values(lowest, highest))
    speed, temperature = mu["speed"].values, mu["temperature"].values
    for axes, place in zip(grid, chosen, strict=True):
        part = mu.isel(place).transpose("temperature", "speed").values
        rubber = place.get("material", 0)
        shift = shifts[rubber] if rubber < len(shifts) else None
        filled = plot_friction_map(axes, speed, temperature, part, levels=levels, shift=shift)
        axes.set_title(panel_title(panels, place), fontsize=9.5)
        speed_ticks(axes.xaxis, narrow=len(chosen) > 1)
        _mark_points(axes, speed, temperature, part, measurement)
    slender_bar(figure, filled, grid, FRICTION)
    figure.supxlabel("speed $v$ (mm/s)", fontsize=10.5)
    figure.supylabel("temperature (°C)", fontsize=10.5)
    return figure


def _mark_points(
    axes: Axes, speed: Array, temperature: Array, friction: Array, measurement: tuple[Array, Array] | None
) -> None:
    """Mark where friction was measured, and where it could not be calculated."""
    rows, columns = np.nonzero(~np.isfinite(friction))
    if rows.size:  # nothing at all, unclipped, would upset the layout
        axes.plot(1e3 * speed[columns], temperature[rows] - 273.15, "x", color=INK, markersize=4, clip_on=False)
    if measurement is not None:
        at, kelvin = measurement
        look: dict[str, Any] = {"color": "none", "markeredgecolor": WHITE, "markeredgewidth": 1.0, "markersize": 4}
        axes.plot(1e3 * at, kelvin - 273.15, "o", clip_on=False, **look)


_ROWS = 120  # of a map, about
# So far beyond the temperatures at which the shift factor is known, it goes on straight over 1/T: enough for a picture.
_BEYOND = 50.0  # K


def known_shifts(tree: DataTree) -> list[tuple[Array, Array] | None]:
    """Return temperature (K, ascending) and log10 of the shift factor of each rubber; None where it is not known."""
    return [_known_shift(branch) for _, branch in rubbers(tree) or [("", tree)]]


def _known_shift(tree: DataTree) -> tuple[Array, Array] | None:
    factors, law = group(tree, "shift_factors"), group(tree, "shift_law")
    measured = factors is not None and str(factors.attrs.get("shift_used", "measured")) == "measured"
    found = factors if measured or law is None else law
    if found is None:
        return None
    kelvin, log = values(found, "temperature"), values(found, "log10_shift_factor")
    order = np.argsort(kelvin)
    return (kelvin[order], log[order]) if len(kelvin) > 1 else None


def filled_in(
    speed: Array, temperature: Array, friction: Array, shift: tuple[Array, Array] | None
) -> tuple[Array, Array]:
    """Return more temperatures (M,), and friction (M, n) there from friction (m, n); the same without a `shift`.

    μ(v, T) = μ(α(T) v, T₀): at a temperature between two, each of the two curves is read at its own speed of the same
    α v, and the two are weighed by how near they are in 1/T.  Beyond its ends, a curve goes on with the nearest others,
    so that friction is continuous.  Log α is straight over 1/T between the temperatures at which it is known.
    """
    if shift is None or temperature[0] < shift[0][0] - _BEYOND or temperature[-1] > shift[0][-1] + _BEYOND:
        return temperature, friction
    logs = np.array([np.log(10.0) * _log_shift(shift, kelvin) for kelvin in temperature.tolist()])
    reduced = np.log(speed) + logs[:, None]
    curves = [_continued(reduced, friction, row) for row in range(len(temperature))]
    between = max(1, round(_ROWS / (len(temperature) - 1)))
    kelvins, rows = [float(temperature[0])], [friction[0]]
    for lower in range(len(temperature) - 1):
        cold, warm = float(temperature[lower]), float(temperature[lower + 1])
        for part in range(1, between + 1):
            kelvin = cold + part * (warm - cold) / between
            weight = (1.0 / cold - 1.0 / kelvin) / (1.0 / cold - 1.0 / warm)
            at = np.log(speed) + np.log(10.0) * _log_shift(shift, kelvin)
            mixed = (1.0 - weight) * curves[lower](at) + weight * curves[lower + 1](at)
            failed = ~np.isfinite(friction[lower + (weight > 0.5)])
            kelvins.append(kelvin)
            rows.append(np.where(failed, np.nan, mixed) if part < between else friction[lower + 1])
    return np.array(kelvins), np.array(rows)


def _continued(reduced: Array, friction: Array, row: int) -> Callable[[Array], Array]:
    """Return friction over the logarithm of the reduced speed at a temperature, with other curves beyond its ends."""
    from scipy.interpolate import PchipInterpolator

    known = np.isfinite(friction)
    x, y = reduced[row][known[row]], friction[row][known[row]]
    for other in sorted(range(len(reduced)), key=lambda one: abs(one - row)):
        more, value = reduced[other][known[other]], friction[other][known[other]]
        outside = (more < x.min()) | (more > x.max()) if x.size else np.full(more.shape, True)
        order = np.argsort(np.append(x, more[outside]))
        x, y = np.append(x, more[outside])[order], np.append(y, value[outside])[order]
    if x.size < 2:  # nothing to interpolate
        return lambda at: np.full(np.shape(at), np.nan)
    found: Callable[[Array], Array] = PchipInterpolator(x, y, extrapolate=False)
    return found


def _log_shift(shift: tuple[Array, Array], kelvin: float) -> float:
    at, log = -1.0 / shift[0], shift[1]
    end = 0 if kelvin < shift[0][0] else -2 if kelvin > shift[0][-1] else None
    if end is None:
        return float(np.interp(-1.0 / kelvin, at, log))
    slope = (log[end + 1] - log[end]) / (at[end + 1] - at[end])
    return float(log[end] + slope * (-1.0 / kelvin - at[end]))
