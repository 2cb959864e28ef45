"""Figures of contacts that their own friction heats: friction, rise of temperature with its parts, and one map."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscofric.datasets import Dataset, DataTree
from viscofric.errors import InputError
from viscofric.report.data import as_dataset
from viscofric.report.figures import style
from viscofric.report.figures.interface import plot_friction_parts
from viscofric.report.results import group, is_extrapolated, nominal_temperatures, number, on_group, values
from viscofric.report.sweeps import axis_of, best_estimate, thinned
from viscofric.report.texts.numbers import short

if TYPE_CHECKING:
    from viscofric.friction.heating import HeatedFrictionCurves

_MILLIMETRES = 1e3
#: Curves that a study's figures show.
MOST_PANELS = 3
#: A rise that is everywhere below this share of the largest is not drawn; two that differ by less than a share are one.
_LEAST, _SAME = 1e-6, 0.02
_RISES = (
    ("temperature_rise", "that the rubber responds to", style.INK, "-"),
    ("coulomb_rise", "by Coulomb friction", style.ORANGE, "--"),
    ("loss_rise", "by the viscoelastic loss", style.BLUE, "--"),
    ("track_rise", "of it by earlier passes", style.PURPLE, ":"),
    ("face_rise", "of the face", style.VERMILION, "-."),
    ("loss_weighted_rise", "where the loss is released", style.GREEN, "-."),
)


_MEANS = {"face_rise": ": of the face", "loss_weighted_rise": ": where the loss is released"}


def plot_heated_friction(axes: Axes, curves: HeatedFrictionCurves | Dataset) -> None:
    """Draw viscoelastic friction with heating against speed, beside the isothermal one.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    curves : HeatedFrictionCurves or xarray.Dataset
        Of `viscofric.predict_friction` with heating, at one temperature (`FrictionCurves.at_temperature`).  Where
        contacts have a cold and a hot state, both are drawn, and the hysteresis between them is shaded.  A dataset has
        the columns of the group ``heating`` of a study along `case`.

    Raises
    ------
    InputError
        If there is no heating, or are several temperatures.
    """
    data, kelvin = _one_curve(curves)
    mu = "friction_coefficient" if "friction_coefficient" in data else "viscoelastic"  # of a study, or of curves
    names = ("speed", mu, "isothermal_friction", "cold_friction", "hot_friction")
    speed, warm, isothermal, cold, hot = (values(data, name) for name in names)
    speed = _MILLIMETRES * speed
    axes.plot(speed, isothermal, color=style.GREY, linestyle="--", label="isothermal")
    two = hot != cold
    if np.any(two):
        axes.fill_between(speed, cold, hot, color=style.VERMILION, alpha=0.2, linewidth=0.0, label="hysteresis")
        axes.plot(speed, cold, color=style.BLUE, marker="o", markersize=3, label="heated, speed rising")
        axes.plot(speed, hot, color=style.VERMILION, marker="s", markersize=3, label="heated, speed falling")
    else:
        axes.plot(speed, warm, color=style.INK, marker="o", markersize=3, label="heated")
    if np.any(beyond := is_extrapolated(data)):
        ring: dict[str, Any] = {"color": style.GREY, "markersize": 7, "fillstyle": "none"}
        axes.plot(speed[beyond], warm[beyond], "o", label="frequencies not measured", **ring)
    axes.set(xscale="log", ylabel=r"viscoelastic friction $\mu$")
    axes.set_ylim(0.0, 1.08 * float(np.nanmax(np.concatenate([isothermal, cold, hot]))))
    axes.set_xlabel(r"speed $v$ (mm/s)" + style.at_temperature(kelvin))
    style.speed_ticks(axes.xaxis)
    style.plain_numbers(axes, "y")
    axes.legend(title="predicted", alignment="left")


def plot_temperature_rise(axes: Axes, curves: HeatedFrictionCurves | Dataset) -> None:
    """Draw the rise of temperature of contacts against speed, with its parts; see `plot_heated_friction`.

    The rise that the rubber responds to is that of the face, or that weighted with the loss (`Heating.average`); both
    are drawn.  Its parts are those by Coulomb friction and by the loss, and what of both is due to earlier passes.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    curves : HeatedFrictionCurves or xarray.Dataset

    Raises
    ------
    InputError
        If there is no heating, or are several temperatures.
    """
    data, kelvin = _one_curve(curves)
    speed = _MILLIMETRES * values(data, "speed")
    largest = max(float(np.nanmax(values(data, name))) for name, *_ in _RISES)
    response = values(data, "temperature_rise")
    for name, words, colour, dashes in _RISES:
        rise = values(data, name)
        is_response = name in _MEANS and np.allclose(rise, response, rtol=_SAME, atol=0.0)
        if np.nanmax(rise) > _LEAST * largest and not is_response:
            named = next((_MEANS[one] for one in _MEANS if np.allclose(values(data, one), response, rtol=_SAME)), "")
            said = f"{words}{named}" if name == "temperature_rise" else words
            shown = np.where(rise > 0.0, rise, math.nan)
            axes.plot(speed, shown, color=colour, linestyle=dashes, marker=".", label=said)
    axes.set(xscale="log", yscale="log", ylabel=r"rise of temperature $\Delta T$ (K)")
    axes.set_xlabel(r"speed $v$ (mm/s)" + style.at_temperature(kelvin))
    style.speed_ticks(axes.xaxis)
    style.legend_beside(axes, title="predicted mean rise")


def _one_curve(curves: HeatedFrictionCurves | Dataset) -> tuple[Dataset, float]:
    """Return the data set of one temperature in ascending speed, and the temperature; raise `InputError` for others."""
    data = as_dataset(curves)
    if "temperature_rise" not in data:
        raise InputError("the friction curves have no heating; predict with heating=….", code="no-heating")
    nominal = nominal_temperatures(values(data, "temperature"))
    if nominal.size != 1:
        raise InputError(
            f"the friction curves have {nominal.size} temperatures; choose one with at_temperature().",
            code="several-temperatures",
        )
    (along,) = data["temperature_rise"].dims
    return data.isel({along: np.argsort(values(data, "speed"), kind="stable")}), float(nominal[0])


def heated_curves_figure(curves: HeatedFrictionCurves) -> Figure:
    """Return heated friction beside the isothermal one, and the rise of temperature, at three temperatures at most."""
    nominal = nominal_temperatures(curves.temperature)
    shown = nominal[thinned(nominal.size, MOST_PANELS)]
    return _pairs([("", as_dataset(curves.at_temperature(float(kelvin)))) for kelvin in shown])


def heating_figure(tree: DataTree) -> Figure | None:
    """Return heated friction beside the isothermal one, and the rise of temperature, of at most three curves."""
    curves = _shown(tree)
    return _pairs(curves) if curves else None


def _pairs(curves: Sequence[tuple[str, Dataset]]) -> Figure:
    figure = style.new_figure(11.0, 3.4 * len(curves))
    for (left, right), (words, curve) in zip(figure.subplots(len(curves), 2, squeeze=False), curves, strict=True):
        plot_heated_friction(left, curve)
        plot_temperature_rise(right, curve)
        left.set_title(words)
    return figure


def heated_parts_figure(tree: DataTree) -> Figure | None:
    """Return the parts of heated friction, hysteresis and Coulomb friction or interface, of at most three curves."""
    curves = [(words, rubbed) for words, one in _shown(tree) if (rubbed := _with_coulomb(one)) is not None]
    if not curves:
        return None
    figure = style.new_figure(7.4, 3.2 * len(curves))
    for axes, (words, curve) in zip(figure.subplots(len(curves), 1, squeeze=False)[:, 0], curves, strict=True):
        plot_friction_parts(axes, curve)
        axes.set_title(words)
    return figure


def _with_coulomb(curve: Dataset) -> Dataset | None:
    """Return a curve whose given Coulomb friction, if any, is its interface; None without either."""
    if "interface_friction" in curve:
        return curve
    if "coulomb" not in curve or not np.any(values(curve, "coulomb") > 0.0):
        return None
    given = curve["friction_coefficient"] * 0.0 + values(curve, "coulomb")
    return curve.assign(interface_friction=given, interface_error=0.0 * given)


def _shown(tree: DataTree) -> list[tuple[str, Dataset]]:
    """Return at most three curves over speed along `case`, each with what tells it apart from the others."""
    data = group(tree, "heating")
    if data is None or "speed" not in data.dims:
        return []
    best = best_estimate(data)
    others = [str(name) for name, size in best.sizes.items() if name != "speed" and size > 1]
    axes = [axis_of(best, name) for name in others]
    shape = tuple(len(axis) for axis in axes)
    found = []
    for place in thinned(math.prod(shape), MOST_PANELS):
        at = [int(one) for one in np.unravel_index(place, shape)] if shape else []
        words = ", ".join(axis.labels[index] for axis, index in zip(axes, at, strict=True))
        words = words.replace("coulomb", "Coulomb friction")
        curve = best.isel(dict(zip(others, at, strict=True))).reset_coords()
        curve = curve.broadcast_like(curve["friction_coefficient"]).rename(speed="case")
        curve = curve.assign(speed=("case", best["speed"].values)).drop_vars("case", errors="ignore")
        solved = np.isfinite(values(curve, "friction_coefficient"))
        if solved.sum() > 1:
            found.append((words, curve.isel(case=np.flatnonzero(solved))))
    return found


@on_group("temperature_map")
def temperature_map_figure(data: Dataset, _: DataTree) -> Figure | None:
    """Return the rise of temperature of the rubber's face at the warmest contact: seen from above, and along it."""
    if data.sizes["y"] == 1:
        return style.one_panel(_plot_centre_line, data, size=(6.2, 3.2))
    figure = style.new_figure(6.2, 5.6)
    above, below = figure.subplots(2, 1, height_ratios=[1.6, 1.0])
    x, y = _MILLIMETRES * values(data, "x"), _MILLIMETRES * values(data, "y")
    mesh = style.heat_map(above, x, y, data["rise"].values, "inferno")
    above.contour(x, y, data["contact"].values.T, levels=[0.5], colors=["white"], linewidths=0.9)
    above.set(xlabel="along the motion $x$ (mm) →", ylabel="across $y$ (mm)")
    style.slender_bar(figure, mesh, [above], r"rise of temperature $\Delta T$ (K)")
    _plot_centre_line(below, data)
    below.set_xlim(above.get_xlim())
    return figure


def _plot_centre_line(axes: Axes, data: Dataset) -> None:
    middle = data.sizes["y"] // 2
    x, rise = values(data, "x"), data["rise"].values[:, middle]
    inside = data["contact"].values[:, middle] > 0.5
    unit = style.unit_for(float(np.abs(x).max())) if data.sizes["y"] == 1 else style.Unit(1.0 / _MILLIMETRES, "mm")
    axes.axvspan(x[inside][0] / unit.size, x[inside][-1] / unit.size, color=style.GREY, alpha=0.2, linewidth=0.0)
    axes.plot(x / unit.size, rise, color=style.VERMILION, label="centre line")
    mean = number(data.attrs, "face_rise")
    axes.axhline(mean, color=style.INK, linewidth=0.8, linestyle="--", label=f"mean of the contact, {short(mean, 3)} K")
    axes.set(xlabel=f"along the motion $x$ ({unit.name}) →", ylabel=r"$\Delta T$ (K)", ylim=(0.0, None))
    axes.legend(loc="best")
