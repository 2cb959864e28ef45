"""Figures of friction against speed and against reduced speed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.report.data import (
    Friction,
    Measured,
    Predicted,
    ReducedFriction,
    as_dataset,
    measured,
    measured_line,
    predicted,
)
from viscofric.report.figures import style
from viscofric.report.figures.shift_factors import plot_shift_comparison, plot_shift_factors
from viscofric.report.results import nearest, nominal_temperatures, number
from viscofric.report.texts.numbers import degrees
from viscofric.rheology.shifts.shift_law import ShiftLaw

_BAND = 0.18  # how much of a band's colour covers what lies below it
_MILLIMETRES = 1e3
_WIDTH, _HEIGHT = 7.4, 4.0
_HEADROOM = 1.08  # over the highest number, where the axis begins at zero
_BARS, _THIN = "bars: numerical error", "thin: frequencies not measured"


def plot_friction_curves(
    axes: Axes, prediction: Friction | None = None, measurement: Friction | None = None, *, synthetic: bool = False
) -> None:
    """Draw viscoelastic friction against speed at each temperature.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    prediction : FrictionCurves or xarray.Dataset, optional
        Lines, and the 95 % bands where there are any.  A dataset has `speed`, `temperature`, `load`,
        `friction_coefficient` and perhaps `friction_lower` and `friction_upper` along `case`.
    measurement : FrictionCurves or xarray.Dataset, optional
        Points with bars of one standard deviation.  A dataset has `speed`, `temperature`, `viscoelastic` and
        `viscoelastic_scatter` along `point`.
    synthetic : bool
        Whether to call the points synthetic instead of measured.

    Raises
    ------
    InputError
        If there is neither.
    """
    _insist_on_any(prediction, measurement)
    lines = None if prediction is None else predicted(prediction)
    points = None if measurement is None else measured(measurement)
    nominal = nominal_temperatures(*(part.temperature for part in (lines, points) if part is not None))
    handles = []
    for index, look in enumerate(style.looks(nominal.size)):
        marker, line = "none", "none"
        if lines is not None and np.any(here := nearest(nominal, lines.temperature) == index):
            _plot_loads(axes, lines.rows(here), look, alone=points is None)
            line = look.dashes
        if points is None or np.any(nearest(nominal, points.temperature) == index):
            marker = look.marker
        named: Any = {"marker": marker, "linestyle": line, "label": degrees(float(nominal[index]))}
        handles.append(Line2D([], [], color=look.colour, **named))
    if points is not None:
        plot_measured(axes, points, nominal)
    axes.set_xlabel(r"speed $v$ (mm/s)")
    title = [] if points is None else [f"points: {style.origin(synthetic)} ± scatter"]
    if lines is not None:
        title.append(("lines: predicted" if title else "predicted") + (", 95 % bands" if lines.has_band else ""))
        title += [_BARS] if np.isfinite(lines.error).any() else []
        title += [_THIN] if lines.extrapolated.any() else []
    _finish(axes, handles[::-1], "\n".join(title))


def plot_friction_master_curve(
    axes: Axes,
    prediction: Friction | None = None,
    measurement: ReducedFriction | None = None,
    *,
    reference_temperature: float | None = None,
    synthetic: bool = False,
) -> None:
    """Draw viscoelastic friction of all temperatures against the reduced speed αv.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    prediction : FrictionCurves or xarray.Dataset, optional
        At the reference temperature, over the reduced speed: one line, and its 95 % band where there is one.  See
        `plot_friction_curves`.
    measurement : FrictionMasterCurve or xarray.Dataset, optional
        Points with bars of one standard deviation; without a prediction also the smooth line through a
        `viscofric.friction.FrictionMasterCurve`, with the 95 % band that the points' errors leave.  A dataset has
        `reduced_speed`, `temperature`, `viscoelastic` and `viscoelastic_scatter` along `point`.
    reference_temperature : float, optional
        K, for the label; that of a `viscofric.friction.FrictionMasterCurve` if not given.
    synthetic : bool
        Whether to call the points synthetic instead of measured.

    Raises
    ------
    InputError
        If there is neither.
    """
    _insist_on_any(prediction, measurement)
    handles: list[Any] = []
    if prediction is not None:
        handles += _plot_line(axes, predicted(prediction), "predicted")
    elif measurement is not None and (smooth := measured_line(measurement)) is not None:
        handles += _plot_line(axes, smooth, "smoothed")
    if measurement is not None:
        points = measured(measurement, speed="reduced_speed")
        nominal = nominal_temperatures(points.temperature)
        handles += style.temperature_handles(nominal)[::-1]
        plot_measured(axes, points, nominal)
    at = reference_temperature
    if at is None and measurement is not None:
        at = number(as_dataset(measurement).attrs, "reference_temperature")
    axes.set_xlabel(r"reduced speed $\alpha_T\,v$ (mm/s)" + style.at_temperature(at))
    title = "" if measurement is None else f"points: {style.origin(synthetic)} ± scatter"
    _finish(axes, handles, title)


def plot_friction_master_curves(
    axes: Axes, predictions: Mapping[str, Friction], *, reference_temperature: float | None = None
) -> None:
    """Draw predicted friction of several rubbers (by name) against the reduced speed αv."""
    handles: list[Any] = []
    for look, (name, prediction) in zip(style.looks(len(predictions)), predictions.items(), strict=True):
        _plot_predicted(axes, predicted(prediction).rows(), color=look.colour, linestyle=look.dashes)
        handles.append(Line2D([], [], color=look.colour, linestyle=look.dashes, label=name))
    axes.set_xlabel(r"reduced speed $\alpha_T\,v$ (mm/s)" + style.at_temperature(reference_temperature))
    _finish(axes, handles, "predicted")


def plot_coulomb_friction(axes: Axes, measurement: Friction, *, synthetic: bool = False) -> None:
    """Draw measured Coulomb friction against speed at each temperature.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    measurement : FrictionCurves or xarray.Dataset
        A dataset has `speed`, `temperature`, `coulomb` and `coulomb_scatter` along `point`.
    synthetic : bool
        Whether to call the points synthetic instead of measured.

    Raises
    ------
    InputError
        If it holds no Coulomb friction.
    """
    points = measured(measurement, "coulomb")
    if not np.isfinite(points.friction).any():
        raise InputError(
            "the friction curves contain no Coulomb friction: measure with slip, in both directions.", code="no-coulomb"
        )
    nominal = nominal_temperatures(points.temperature)
    plot_measured(axes, points, nominal)
    axes.set_xlabel(r"speed $v$ (mm/s)")
    title, label = f"{style.origin(synthetic)} ± scatter", r"Coulomb friction coefficient $\mu_\mathrm{c}$"
    _finish(axes, style.temperature_handles(nominal)[::-1], title, label)


def _insist_on_any(*given: object) -> None:
    if all(one is None for one in given):
        raise InputError(
            "there is no friction to draw: give a prediction, a measurement or both.", code="nothing-to-draw"
        )


def _plot_loads(axes: Axes, lines: Predicted, look: Any, *, alone: bool) -> None:
    """Draw the predicted lines of one temperature, one for each load, fainter from the second on."""
    loads = np.unique(lines.load)
    for load in loads:
        line = lines.rows(lines.load == load)
        marker = look.marker if alone or np.isfinite(line.friction).sum() == 1 else "none"
        alpha = 1.0 if load == loads[0] else 0.55
        marks = {"linestyle": look.dashes, "marker": marker, "markersize": 4, "alpha": alpha}
        _plot_predicted(axes, line, color=look.colour, **marks)


def _plot_line(axes: Axes, lines: Predicted, label: str) -> list[Any]:
    """Draw one line over the reduced speed, with its band, and return what the legend shows of them."""
    alone = {"marker": "o", "markersize": 4} if np.isfinite(lines.friction).sum() == 1 else {}
    _plot_predicted(axes, lines.rows(), color=style.INK, **alone)
    handles: list[Any] = [Line2D([], [], color=style.INK, label=label, **alone)]  # type: ignore[arg-type]
    if lines.has_band:
        handles.append(Patch(facecolor=style.GREY, alpha=2.0 * _BAND, label="its 95 % band"))
    return handles


def _plot_predicted(axes: Axes, lines: Predicted, **look: Any) -> None:
    """Draw a predicted line and its band, thin and pale where they rest on frequencies that were not measured."""
    speed = _MILLIMETRES * lines.speed
    if lines.has_band:
        colour, dark = (style.GREY, 2.0 * _BAND) if look["color"] == style.INK else (look["color"], _BAND)
        shade = {"color": colour, "alpha": look.get("alpha", 1.0) * dark, "linewidth": 0.0, "zorder": 1}
        if lines.extrapolated.any():  # half as dark there
            shade["alpha"] *= 0.5
            axes.fill_between(speed, np.where(lines.extrapolated, np.nan, lines.lower), lines.upper, **shade)
        axes.fill_between(speed, lines.lower, lines.upper, **shade)
    look["zorder"] = 3.0  # above the points
    style.error_bars(axes, speed, lines.friction, lines.error, look["color"])
    if not lines.extrapolated.any():
        axes.plot(speed, lines.friction, **look)
        return
    axes.plot(speed, lines.friction, linewidth=0.7, **look)
    axes.plot(speed, np.where(lines.extrapolated, np.nan, lines.friction), **look)


def plot_measured(axes: Axes, points: Measured, nominal: Array) -> None:
    """Draw points with their bars over the speed, with the look of each nominal temperature."""
    which = nearest(nominal, points.temperature)
    speed = _MILLIMETRES * points.speed
    for index, look in enumerate(style.looks(nominal.size)):
        rows = np.flatnonzero((which == index) & np.isfinite(speed) & np.isfinite(points.friction))
        if rows.size:
            bars: dict[str, Any] = {"fmt": look.marker, "color": look.colour, "elinewidth": 1.0}
            axes.errorbar(speed[rows], points.friction[rows], points.scatter[rows], **bars)


def _finish(
    axes: Axes, handles: list[Any], title: str, label: str = r"viscoelastic friction coefficient $\mu$"
) -> None:
    axes.set(xscale="log", ylabel=label)
    if axes.get_ylim()[1] > 0.0 and axes.dataLim.y0 >= 0.0:
        axes.set_ylim(0.0, max(axes.get_ylim()[1], _HEADROOM * axes.dataLim.y1))
    style.speed_ticks(axes.xaxis)
    style.plain_numbers(axes, "y")
    style.legend_beside(axes, handles, title, ncols=1 + len(handles) // 18)


def friction_figure(curves: FrictionCurves, *, synthetic: bool = False) -> Figure:
    """Return a figure of measured viscoelastic friction, and of Coulomb friction where there is any below it."""
    if curves.coulomb is None:
        return style.one_panel(plot_friction_curves, measurement=curves, size=(_WIDTH, _HEIGHT), synthetic=synthetic)
    figure = style.new_figure(_WIDTH, 1.8 * _HEIGHT)
    top, bottom = figure.subplots(2, 1, sharex=True)
    plot_friction_curves(top, measurement=curves, synthetic=synthetic)
    plot_coulomb_friction(bottom, curves, synthetic=synthetic)
    top.set_xlabel("")
    return figure


def predicted_figure(curves: FrictionCurves) -> Figure:
    """Return a figure of predicted friction against speed, with its bands where it has any."""
    return style.one_panel(plot_friction_curves, curves, size=(_WIDTH, _HEIGHT))


def shifted_figure(master: FrictionMasterCurve, known: ShiftLaw | None = None, *, synthetic: bool = False) -> Figure:
    """Return a figure of a friction master curve, and of its shift factors below it where they were found from it."""
    if not master.found:
        drawn: dict[str, Any] = {"measurement": master, "synthetic": synthetic}
        return style.one_panel(plot_friction_master_curve, size=(_WIDTH, _HEIGHT), **drawn)
    figure = style.new_figure(_WIDTH, 2.0 * _HEIGHT)
    top, bottom = figure.subplots(2, 1)
    plot_friction_master_curve(top, measurement=master, synthetic=synthetic)
    if known is None:
        plot_shift_factors(bottom, master.shift_factors)
    else:
        plot_shift_comparison(bottom, master.shift_factors, known)
    return figure
