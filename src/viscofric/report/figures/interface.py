"""Figures of the dry interface: shear stress against reduced slip speed with its laws, and the parts of friction."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscofric.arrays import Array
from viscofric.datasets import Dataset, DataTree
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.report.data import Measured, as_dataset
from viscofric.report.figures import style
from viscofric.report.figures.friction import plot_measured
from viscofric.report.results import group, is_synthetic, nearest, nominal_temperatures, number, on_group, values
from viscofric.report.sweeps import has_curves_only, solved_cases, thinned
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.roughness.rough_friction import RoughFriction

if TYPE_CHECKING:
    from viscofric.friction.interface_stress import ShearStress
    from viscofric.roughness.persson import PerssonTheory

_MEGA, _MILLIMETRES = 1e-6, 1e3
_DASHES: tuple[Any, ...] = ("-", "--", ":", "-.")
_BEYOND = 0.2  # decades that lines reach beyond the points
#: Temperatures whose parts of friction a study's figure shows.
MOST_PANELS = 3


def plot_shear_stress(
    axes: Axes, stress: ShearStress | Dataset, laws: Sequence[InterfaceLaw | Dataset] = (), *, synthetic: bool = False
) -> None:
    """Draw shear stress of all temperatures against the reduced slip speed, and laws fitted to it.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    stress : ShearStress or xarray.Dataset
        Points with bars of one standard error, shifted by the first law's α(T), or by the stress's own without laws;
        points whose α is not known are not drawn.  A dataset is that of `ShearStress.to_dataset` with the first law.
    laws : sequence of InterfaceLaw or xarray.Dataset
        Lines at the reference temperature; the first one with its 95 % band where that is known.
    synthetic : bool
        Whether to call the points synthetic instead of measured.

    Raises
    ------
    InputError
        If there is nothing to draw: several temperatures without shift factors and without a law.
    """
    points = as_dataset(stress, *laws[:1])
    reduced, temperature = values(points, "reduced_speed"), values(points, "temperature")
    known = np.isfinite(reduced)
    if not np.any(known):
        raise InputError("the shear stress has no shift factors; give a law fitted to it.", code="nothing-to-draw")
    nominal = nominal_temperatures(temperature[known])
    megapascals = (_MEGA * values(points, name) for name in ("shear_stress", "shear_stress_error"))
    plot_measured(axes, Measured(reduced, temperature, *megapascals), nominal)
    handles = style.temperature_handles(nominal)[::-1]
    decades = np.log10(reduced[known])
    speeds = np.logspace(decades.min() - _BEYOND, decades.max() + _BEYOND, 101)
    reference = number(points.attrs, "reference_temperature")
    for place, (law, dashes) in enumerate(zip(laws, _DASHES, strict=False)):
        handles.append(_plot_law(axes, as_dataset(law, speeds, reference), dashes, banded=place == 0))
    axes.set(xscale="log", yscale="log", ylabel=r"shear stress of the interface $\tau_\mathrm{s}$ (MPa)")
    axes.set_xlabel(r"reduced slip speed $\alpha_T\,v$ (mm/s)" + style.at_temperature(reference))
    style.speed_ticks(axes.xaxis)
    style.speed_ticks(axes.yaxis)
    title = f"points: {style.origin(synthetic)} ± standard error" + ("\nlines: fitted" if laws else "")
    style.legend_beside(axes, handles, title)


def _plot_law(axes: Axes, line: Dataset, dashes: Any, *, banded: bool) -> Line2D:
    """Draw a law at one temperature, and return what the legend shows of it."""
    speed, stress = _MILLIMETRES * values(line, "speed"), _MEGA * np.ravel(line["shear_stress"].values)
    colour = style.INK if banded else style.GREY
    axes.plot(speed, stress, color=colour, linestyle=dashes)
    if banded and "standard_error" in line:
        factor = 10.0 ** (LEVEL_95 * np.ravel(line["standard_error"].values))
        axes.fill_between(speed, stress / factor, stress * factor, color=style.GREY, alpha=0.3, linewidth=0)
    return Line2D([], [], color=colour, linestyle=dashes, label=str(line.attrs["law"]))


def plot_friction_parts(axes: Axes, curves: FrictionCurves | RoughFriction | PerssonTheory | Dataset) -> None:
    """Draw predicted friction against speed with its parts, hysteresis and interface, stacked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    curves : FrictionCurves, RoughFriction, PerssonTheory or xarray.Dataset
        Predicted with an interface or a given Coulomb friction, at one temperature and load
        (`FrictionCurves.at_temperature`, or the data set of one); the total has its 95 % interval.  Of several rough
        surfaces, the mean.  A dataset has `speed`, `temperature`, `friction_coefficient`, `friction_error`,
        `interface_friction`, `interface_error` and perhaps `friction_material_error`.

    Raises
    ------
    InputError
        If there is no interfacial part, or are several temperatures.
    """
    parts = _parts_of_mean(curves) if isinstance(curves, RoughFriction) else _parts(curves)
    if not np.isfinite(parts.interface).any():
        raise InputError("the friction curves have no interfacial part; predict with interface=….", code="no-coulomb")
    nominal = nominal_temperatures(parts.temperature)
    if nominal.size > 1:
        raise InputError(
            f"the friction has {nominal.size} temperatures; draw one, of curves with at_temperature().",
            code="several-temperatures",
        )
    order = np.argsort(parts.speed, kind="stable")
    speed, hysteresis = _MILLIMETRES * parts.speed[order], parts.hysteresis[order]
    total, half = hysteresis + parts.interface[order], LEVEL_95 * parts.error[order]
    axes.fill_between(speed, 0.0, hysteresis, color=style.BLUE, alpha=0.6, linewidth=0, label="hysteresis")
    named = "Coulomb, given" if parts.given else "interface"
    axes.fill_between(speed, hysteresis, total, color=style.ORANGE, alpha=0.6, linewidth=0, label=named)
    axes.errorbar(
        speed, total, yerr=half, color=style.INK, marker="o", markersize=3, elinewidth=1.0, label="total, 95 %"
    )
    axes.set(xscale="log", ylabel=r"friction coefficient $\mu$", ylim=(0.0, 1.08 * float(np.nanmax(total + half))))
    axes.set_xlabel(r"speed $v$ (mm/s)" + "".join(style.at_temperature(one) for one in nominal.tolist()))
    style.speed_ticks(axes.xaxis)
    style.plain_numbers(axes, "y")
    style.legend_beside(axes, title="predicted")


class _Parts(NamedTuple):
    """Parts of friction (n,), the standard error of their sum, and whether Coulomb friction is given."""

    speed: Array
    temperature: Array
    hysteresis: Array
    interface: Array
    error: Array
    given: bool = False


def _parts(curves: FrictionCurves | PerssonTheory | Dataset) -> _Parts:
    """Return the parts of friction along any dimensions, by their names."""
    data = as_dataset(curves)
    of_curves = "viscoelastic" in data
    names = ("viscoelastic", "coulomb") if of_curves else ("friction_coefficient", "interface_friction")
    errors = ("friction_error", "friction_material_error", "interface_error")
    errors = ("viscoelastic_error", "material_error", "coulomb_error") if of_curves else errors
    friction = data[names[0]]

    def column(name: str) -> Array:
        one = data[name] if name in data.variables else friction * np.nan
        return np.ravel(one.broadcast_like(friction).transpose(*friction.dims)).astype(float)

    error = np.sqrt(sum(np.nan_to_num(column(name)) ** 2 for name in errors))
    given = data.attrs.get("heat_of") == "given" or (of_curves and "coulomb_error" not in data)
    speed, kelvin, hysteresis, interface = map(column, ("speed", "temperature", *names))
    return _Parts(speed, kelvin, hysteresis, interface, error, given)


def _parts_of_mean(found: RoughFriction) -> _Parts:
    """Return the mean parts over rough surfaces; of one surface with the errors of its grid and of the law."""
    total = found.total.mean(axis=-1)
    if len(found.surfaces) > 1:
        lower, upper = found.interval(of="total")
        error = (upper - lower) / (2.0 * LEVEL_95)
    else:
        assert found.interface_error is not None
        error = np.hypot(found.friction_error, found.interface_error)[..., 0]
    kelvin, speed = np.meshgrid(found.temperature, found.speed, indexing="ij")
    mean = np.ravel(found.mean_friction_coefficient)
    return _Parts(np.ravel(speed), np.ravel(kelvin), mean, np.ravel(total) - mean, np.ravel(error))


@on_group("interface")
def stress_figure(stress: Dataset, tree: DataTree) -> Figure | None:
    """Return the figure of a study's shear stress, with the law fitted to it."""
    law = group(tree, "interface_law")
    laws = () if law is None else [law]
    return style.one_panel(plot_shear_stress, stress, laws, size=style.WIDE, synthetic=is_synthetic(tree))


def parts_figure(tree: DataTree) -> Figure | None:
    """Return the figure of hysteresis and interface at a few temperatures, where nothing but these and speed varies."""
    cases = solved_cases(tree)
    if cases is None or "interface_friction" not in cases or not has_curves_only(tree):
        return None
    temperature = values(cases, "temperature")
    nominal = nominal_temperatures(temperature)
    shown = thinned(nominal.size, MOST_PANELS)
    figure = style.new_figure(7.4, 3.0 * len(shown))
    for axes, place in zip(figure.subplots(len(shown), 1, squeeze=False)[:, 0], shown, strict=True):
        plot_friction_parts(axes, cases.isel(case=np.flatnonzero(nearest(nominal, temperature) == place)))
    return figure
