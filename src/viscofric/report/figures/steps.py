"""Figures of creep and relaxation tests: the response over reduced time, by temperature, with the fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.report.figures.style import INK, at_temperature, legend_above, logarithmic, temperature_scale
from viscofric.report.results import nearest, nominal_temperatures, number
from viscofric.units import celsius

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable

_RESPONSES = {
    "creep_compliance": (1e6, "creep compliance $D$ (1/MPa)"),
    "relaxation_modulus": (1e-6, "relaxation modulus $E$ (MPa)"),
}


def plot_step_master_curve(axes: Axes, curve: xr.Dataset, *, synthetic: bool = False) -> ScalarMappable:
    """Draw a creep compliance or relaxation modulus over reduced time, coloured by temperature, with the fit.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    curve : xarray.Dataset
        As `StepMasterCurve.to_dataset` or `RetardationSpectrum.step_curve_dataset` return it.
    synthetic : bool
        Whether to call the points synthetic instead of measured.

    Returns
    -------
    matplotlib.cm.ScalarMappable
        Temperatures in °C to colours, for a colour bar (`style.temperature_bar`).
    """
    name = next(one for one in _RESPONSES if one in curve)
    factor, label = _RESPONSES[name]
    time, kelvin = np.asarray(curve["time"]), np.asarray(curve["temperature"])
    response = factor * np.asarray(curve[name])
    nominal = nominal_temperatures(kelvin)
    scale = temperature_scale(nominal)
    which = nearest(nominal, kelvin)
    for index, one in enumerate(nominal):
        rows = which == index
        colour = scale.to_rgba(np.array(celsius(float(one))))
        axes.plot(time[rows], response[rows], "o", color=colour, markersize=3, fillstyle="none")
    said = "synthetic" if synthetic else "measured"
    handles = axes.plot([], [], "o", color=INK, markersize=3, fillstyle="none", label=said)
    if f"fitted_{name}" in curve:
        fitted = factor * np.asarray(curve[f"fitted_{name}"])
        order = np.argsort(time, kind="stable")
        handles += axes.plot(time[order], fitted[order], color=INK, linewidth=1.2, label="fitted")
    axes.set_xlabel(r"reduced time $t/\alpha_T$ (s)" + at_temperature(number(curve.attrs, "reference_temperature")))
    axes.set_ylabel(label)
    logarithmic(axes)
    legend_above(axes, handles, columns=2)
    return scale
