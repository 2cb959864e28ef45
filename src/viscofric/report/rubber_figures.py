"""Figures of the rubber: its isotherms, their shift factors and its master curve, each drawn on an Axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from viscofric.report.house_style import (
    BLUE,
    INK,
    VERMILION,
    at_temperature,
    decade_ticks,
    degrees,
    plain_numbers,
)
from viscofric.report.results import nearest, nominal_temperatures, number, values
from viscofric.units import celsius

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_PASCAL_PER_MEGAPASCAL = 1e6


def plot_isotherms(
    axes: Axes, isotherms: xr.Dataset, modulus: Literal["storage", "loss"] = "storage"
) -> ScalarMappable:
    """Draw the storage or the loss modulus of every sweep as measured, coloured by temperature.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    isotherms : xarray.Dataset
        `temperature`, `angular_frequency`, `storage_modulus`, `loss_modulus` along `reading`.
    modulus : {"storage", "loss"}

    Returns
    -------
    matplotlib.cm.ScalarMappable
        Temperatures in °C to colours, for a colour bar.
    """
    temperature = values(isotherms, "temperature")
    frequency = values(isotherms, "angular_frequency")
    value = values(isotherms, f"{modulus}_modulus") / _PASCAL_PER_MEGAPASCAL
    nominal = nominal_temperatures(temperature)
    scale = ScalarMappable(
        Normalize(celsius(float(nominal[0])), celsius(float(nominal[-1]))),
        matplotlib.colormaps["viridis"].resampled(256),
    )
    marker = "s" if modulus == "storage" else "o"
    which = nearest(nominal, temperature)
    shades = scale.to_rgba(np.array([celsius(float(kelvin)) for kelvin in nominal]))
    for index, kelvin in enumerate(nominal):
        rows = np.flatnonzero(which == index)
        rows = rows[np.argsort(frequency[rows], kind="stable")]
        axes.plot(
            frequency[rows],
            value[rows],
            color=shades[index],
            marker=marker,
            markersize=3,
            linewidth=0.8,
            label=degrees(float(kelvin)),
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(r"angular frequency $\omega$ (rad/s)")
    axes.set_ylabel(r"storage modulus $E'$ (MPa)" if modulus == "storage" else r"loss modulus $E''$ (MPa)")
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)
    return scale


def plot_shift_factors(axes: Axes, shift_factors: xr.Dataset) -> None:
    """Draw the measured shift factors with their standard errors, and the WLF law (the paper's Figure 4).

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    shift_factors : xarray.Dataset
        `log10_shift_factor` and `standard_error` (of log10) along `temperature` (K); attributes
        `reference_temperature`, `wlf_C1` and `wlf_C2` (K).
    """
    temperature = values(shift_factors, "temperature")
    log10 = values(shift_factors, "log10_shift_factor")
    error = np.nan_to_num(values(shift_factors, "standard_error"))
    factor = 10.0**log10
    bars = np.array([factor * (1.0 - 10.0**-error), factor * (10.0**error - 1.0)])
    measured = axes.errorbar(
        celsius(temperature),  # type: ignore[arg-type]  # an array serves as well
        factor,
        yerr=bars,
        fmt="o",
        color=BLUE,
        zorder=3,
        label="from the sweeps, ± standard error",
    )
    handles: list[Any] = [measured]
    reference, C1, C2 = (number(shift_factors.attrs, name) for name in ("reference_temperature", "wlf_C1", "wlf_C2"))
    if np.all(np.isfinite([reference, C1, C2])):
        line = np.linspace(temperature.min(), temperature.max(), 400)
        line = line[C2 + line - reference > 0.02 * C2]  # WLF has a pole below
        law = 10.0 ** np.clip(-C1 * (line - reference) / (C2 + line - reference), -300, 300)
        label = f"WLF: $C_1$ = {C1:.4g}, $C_2$ = {C2:.4g} K at {degrees(reference)}"
        handles += axes.plot(celsius(line), law, color=VERMILION, label=label)  # type: ignore[arg-type]
    low, high = np.nanmin(log10), np.nanmax(log10)
    room = 0.06 * max(high - low, 1.0)
    axes.set_yscale("log")
    axes.set_ylim(10.0 ** (low - room), 10.0 ** (high + room))
    axes.set_xlabel("temperature (°C)")
    axes.set_ylabel(r"shift factor $\alpha_T$")
    plain_numbers(axes, "x")
    decade_ticks(axes.yaxis)
    axes.legend(handles=handles)


def plot_master_curve(
    axes: Axes,
    master_curve: xr.Dataset,
    spectrum_curve: xr.Dataset | None = None,
    *,
    reference_temperature: float | None = None,
) -> None:
    """Draw the measured master curve with the fitted retardation spectrum (the paper's Figure 5).

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    master_curve : xarray.Dataset
        `angular_frequency` (reduced), `storage_modulus`, `loss_modulus` and, for the fit,
        `fitted_storage_modulus` and `fitted_loss_modulus` along `reading`.
    spectrum_curve : xarray.Dataset, optional
        The fit over a wider range: `storage_modulus` and `loss_modulus` along `angular_frequency`.
    reference_temperature : float, optional
        K, for the label.
    """
    frequency = values(master_curve, "angular_frequency")
    if spectrum_curve is None:
        fit, prefix = master_curve, "fitted_"
    else:
        fit, prefix = spectrum_curve, ""
    line = values(fit, "angular_frequency")
    order = np.argsort(line, kind="stable")
    for name, symbol, marker, colour, dashes in (
        ("storage_modulus", "$E'$", "s", BLUE, "-"),
        ("loss_modulus", "$E''$", "o", VERMILION, (0, (5, 1.5))),
    ):
        value = values(master_curve, name) / _PASCAL_PER_MEGAPASCAL
        axes.plot(frequency, value, marker, color=colour, markersize=4, fillstyle="none", label=f"{symbol} measured")
        fitted = values(fit, prefix + name)[order] / _PASCAL_PER_MEGAPASCAL
        axes.plot(line[order], fitted, color=INK, linestyle=dashes, linewidth=1.3, label=f"{symbol} fitted spectrum")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(r"reduced angular frequency $\alpha_T\,\omega$ (rad/s)" + at_temperature(reference_temperature))
    axes.set_ylabel("modulus (MPa)")
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)
    axes.legend()
