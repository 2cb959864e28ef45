"""Figures of the dry interface: shear stress against reduced slip speed with its laws, and the parts of friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from viscofric.errors import InputError
from viscofric.report.figures.style import (
    BLUE,
    GREY,
    INK,
    ORANGE,
    at_temperature,
    looks,
    origin,
    plain_numbers,
    speed_ticks,
)
from viscofric.report.results import nearest, nominal_temperatures
from viscofric.report.texts.numbers import degrees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.interface.shear_stress import ShearStress
    from viscofric.rheology.interface.law import InterfaceLaw


_MEGA, _MILLIMETRES = 1e-6, 1e3
_DASHES: tuple[Any, ...] = ("-", "--", ":", "-.")
_BEYOND = 0.2  # decades that lines reach beyond the points


def plot_shear_stress(
    axes: Axes, stress: ShearStress, laws: Sequence[InterfaceLaw] = (), *, synthetic: bool = False
) -> None:
    """Draw shear stress of all temperatures against the reduced slip speed, and laws fitted to it.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    stress : ShearStress
        Points with bars of one standard error, shifted by the first law's α(T), or by the stress's own without laws;
        points whose α is not known are not drawn.
    laws : sequence of InterfaceLaw
        Lines at the reference temperature; the first one with its 95 % band where that is known.
    synthetic : bool
        Whether to call the points synthetic instead of measured.

    Raises
    ------
    InputError
        If there is nothing to draw: several temperatures without shift factors and without a law.
    """
    drawn = stress.to_dataset(*laws[:1])
    reduced = drawn["reduced_speed"].values
    known = np.isfinite(reduced)
    if not np.any(known):
        raise InputError("the shear stress has no shift factors; give a law fitted to it.", code="nothing-to-draw")
    nominal = nominal_temperatures(stress.temperature)
    handles = []
    for index, look in enumerate(looks(nominal.size)):
        rows = known & (nearest(nominal, stress.temperature) == index)
        if not np.any(rows):
            continue
        axes.errorbar(
            _MILLIMETRES * reduced[rows],
            _MEGA * stress.shear_stress[rows],
            yerr=_MEGA * stress.error[rows],
            fmt=look.marker,
            color=look.colour,
            elinewidth=1.0,
        )
        named = {"marker": look.marker, "linestyle": "none", "label": degrees(float(nominal[index]))}
        handles.append(Line2D([], [], color=look.colour, **named))  # type: ignore[arg-type]
    handles.reverse()
    decades = np.log10(reduced[known])
    speeds = np.logspace(decades.min() - _BEYOND, decades.max() + _BEYOND, 101)
    reference = drawn.attrs["reference_temperature"]
    for law, dashes in zip(laws, _DASHES, strict=False):
        first = law is laws[0]
        colour = INK if first else GREY
        axes.plot(_MILLIMETRES * speeds, _MEGA * law(speeds, reference), color=colour, linestyle=dashes)
        handles.append(Line2D([], [], color=colour, linestyle=dashes, label=law.title))
        if first and law.has_standard_error:
            lower, upper = law.interval(speeds, reference)
            axes.fill_between(_MILLIMETRES * speeds, _MEGA * lower, _MEGA * upper, color=GREY, alpha=0.3, linewidth=0)
    axes.set(xscale="log", yscale="log", ylabel=r"shear stress of the interface $\tau_\mathrm{s}$ (MPa)")
    axes.set_xlabel(r"reduced slip speed $\alpha_T\,v$ (mm/s)" + at_temperature(reference))
    speed_ticks(axes.xaxis)
    speed_ticks(axes.yaxis)
    title = f"points: {origin(synthetic)} ± standard error" + ("\nlines: fitted" if laws else "")
    axes.legend(handles=handles, title=title, alignment="left", loc="upper left", bbox_to_anchor=(1.0, 1.0))


def plot_friction_parts(axes: Axes, curves: FrictionCurves) -> None:
    """Draw predicted friction against speed with its parts, hysteresis and interface, stacked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    curves : FrictionCurves
        Of `predict_friction` with an interface, at one temperature and load (`FrictionCurves.at_temperature`); the
        total has its 95 % interval.

    Raises
    ------
    InputError
        If there is no interfacial part, or are several temperatures.
    """
    if curves.coulomb is None or curves.total_error is None:
        raise InputError("the friction curves have no interfacial part; predict with interface=….", code="no-coulomb")
    if curves.temperatures.size != 1:
        raise InputError(
            f"the friction curves have {curves.temperatures.size} temperatures; choose one with at_temperature().",
            code="several-temperatures",
        )
    order = np.argsort(curves.speed, kind="stable")
    speed, hysteresis, total = (
        column[order] for column in (_MILLIMETRES * curves.speed, curves.viscoelastic, curves.total)
    )
    half = 1.96 * curves.total_error[order]
    axes.fill_between(speed, 0.0, hysteresis, color=BLUE, alpha=0.6, linewidth=0, label="hysteresis")
    axes.fill_between(speed, hysteresis, total, color=ORANGE, alpha=0.6, linewidth=0, label="interface")
    axes.errorbar(speed, total, yerr=half, color=INK, marker="o", markersize=3, elinewidth=1.0, label="total, 95 %")
    axes.set(xscale="log", ylabel=r"friction coefficient $\mu$", ylim=(0.0, 1.08 * float((total + half).max())))
    axes.set_xlabel(r"speed $v$ (mm/s)" + at_temperature(float(curves.temperatures[0])))
    speed_ticks(axes.xaxis)
    plain_numbers(axes, "y")
    axes.legend(title="predicted", alignment="left", loc="upper left", bbox_to_anchor=(1.0, 1.0))
