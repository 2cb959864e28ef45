"""Figures of friction against speed and against reduced speed, each drawn on an Axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from viscofric.report.doubts import is_extrapolated
from viscofric.report.house_style import INK, at_temperature, degrees, looks, plain_numbers, speed_ticks
from viscofric.report.results import nearest, nominal_temperatures, values

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


def plot_friction_curves(axes: Axes, prediction: xr.Dataset, measurement: xr.Dataset | None = None) -> None:
    """Draw viscoelastic friction against speed at each temperature (the paper's Figure 6).

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    prediction : xarray.Dataset
        `speed`, `temperature`, `load`, `friction_coefficient` along `case`: lines.
    measurement : xarray.Dataset, optional
        `speed`, `temperature`, `viscoelastic`, `viscoelastic_scatter` along `point`: points with bars of one
        standard deviation.
    """
    temperature = values(prediction, "temperature")
    speed, friction = 1e3 * values(prediction, "speed"), values(prediction, "friction_coefficient")
    loads = np.unique(values(prediction, "load"))
    measured_at = values(measurement, "temperature") if measurement is not None else np.empty(0)
    nominal = nominal_temperatures(temperature, measured_at)
    which = nearest(nominal, temperature)
    handles = []
    for index, look in enumerate(looks(nominal.size)):
        for load in loads:
            rows = np.flatnonzero((which == index) & (values(prediction, "load") == load))
            rows = rows[np.argsort(speed[rows], kind="stable")]
            lone = look.marker if measurement is None or np.isfinite(friction[rows]).sum() == 1 else "none"
            _plot_predicted(
                axes,
                speed[rows],
                friction[rows],
                is_extrapolated(prediction)[rows],
                color=look.colour,
                linestyle=look.dashes,
                marker=lone,
                markersize=4,
                alpha=1.0 if load == loads[0] else 0.55,
            )
        marker = look.marker if measurement is None or np.any(nearest(nominal, measured_at) == index) else "none"
        line: Any = look.dashes if np.any(which == index) else "none"
        handles.append(
            Line2D([], [], color=look.colour, marker=marker, linestyle=line, label=degrees(float(nominal[index])))
        )
    if measurement is not None:
        _plot_measured(axes, measurement, 1e3 * values(measurement, "speed"), nominal)
    axes.set_xlabel(r"speed $v$ (mm/s)")
    title = "predicted" if measurement is None else "points: measured ± scatter\nlines: predicted"
    _finish_friction(axes, handles[::-1], title)


def plot_friction_master_curve(
    axes: Axes,
    prediction: xr.Dataset,
    measurement: xr.Dataset | None = None,
    *,
    reference_temperature: float | None = None,
) -> None:
    """Draw viscoelastic friction of all temperatures against the reduced speed αv (the paper's Figure 7).

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    prediction : xarray.Dataset
        `speed` (reduced) and `friction_coefficient` along `case`, at the reference temperature: one line.
    measurement : xarray.Dataset, optional
        `reduced_speed`, `temperature`, `viscoelastic`, `viscoelastic_scatter` along `point`.
    reference_temperature : float, optional
        K, for the label.
    """
    speed = 1e3 * values(prediction, "speed")
    order = np.argsort(speed, kind="stable")
    friction = values(prediction, "friction_coefficient")[order]
    alone = {"marker": "o", "markersize": 4} if np.isfinite(friction).sum() == 1 else {}
    _plot_predicted(axes, speed[order], friction, is_extrapolated(prediction)[order], color=INK, **alone)
    handles = [Line2D([], [], color=INK, label="predicted", **alone)]  # type: ignore[arg-type]
    if measurement is not None:
        nominal = nominal_temperatures(values(measurement, "temperature"))
        handles += [
            Line2D([], [], color=look.colour, marker=look.marker, linestyle="none", label=degrees(float(kelvin)))
            for look, kelvin in zip(looks(nominal.size), nominal, strict=True)
        ][::-1]
        _plot_measured(axes, measurement, 1e3 * values(measurement, "reduced_speed"), nominal)
    axes.set_xlabel(r"reduced speed $\alpha_T\,v$ (mm/s)" + at_temperature(reference_temperature))
    _finish_friction(axes, handles, None if measurement is None else "points: measured ± scatter")


def _plot_predicted(axes: Axes, speed: Array, friction: Array, extrapolated: NDArray[np.bool_], **look: Any) -> None:
    """Draw a predicted line, thin where it rests on frequencies that were not measured."""
    if not extrapolated.any():
        axes.plot(speed, friction, **look)
        return
    axes.plot(speed, friction, linewidth=0.7, **look)
    axes.plot(speed, np.where(extrapolated, np.nan, friction), **look)


def _plot_measured(axes: Axes, measurement: xr.Dataset, speed: Array, nominal: Array) -> None:
    which = nearest(nominal, values(measurement, "temperature"))
    friction = values(measurement, "viscoelastic")
    scatter = np.nan_to_num(values(measurement, "viscoelastic_scatter"))
    for index, look in enumerate(looks(nominal.size)):
        rows = np.flatnonzero((which == index) & np.isfinite(speed) & np.isfinite(friction))
        if rows.size:
            axes.errorbar(
                speed[rows],
                friction[rows],
                yerr=scatter[rows],
                fmt=look.marker,
                color=look.colour,
                elinewidth=1.0,
            )


def _finish_friction(axes: Axes, handles: list[Any], title: str | None) -> None:
    axes.set_xscale("log")
    axes.set_ylabel(r"viscoelastic friction coefficient $\mu$")
    if axes.get_ylim()[1] > 0.0 and axes.dataLim.y0 >= 0.0:
        axes.set_ylim(bottom=0.0)
    speed_ticks(axes.xaxis)
    plain_numbers(axes, "y")
    axes.legend(
        handles=handles,
        title=title,
        alignment="left",
        loc="upper left",
        bbox_to_anchor=(1.0, 1.0),
        ncols=1 + len(handles) // 18,
    )
