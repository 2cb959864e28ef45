"""Figures of the material: isotherms, master curve with the residuals of the fit, and spectra."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.errors import InputError, check_choice
from viscofric.report.data import (
    Master,
    Moduli,
    Sweeps,
    as_dataset,
    moduli,
    moduli_of_master_curve,
    moduli_of_sweeps,
    modulus_band,
)
from viscofric.report.figures import style
from viscofric.report.results import nearest, nominal_temperatures, number, values
from viscofric.report.texts.numbers import degrees
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.rheology.superposition.consistency import SuperpositionCheck
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.units import celsius

Fitted: TypeAlias = "RetardationSpectrum | ModulusTable | Dataset"


_PASCAL_PER_MEGAPASCAL = 1e6
#: Of the fitted storage and loss modulus.
_DASHES: tuple[Any, Any] = ("-", (0, (5, 1.5)))
#: The fitted line goes so far beyond the measured frequencies, as a factor.
_BEYOND = 10.0


def plot_isotherms(axes: Axes, isotherms: Sweeps, modulus: Literal["storage", "loss"] = "storage") -> ScalarMappable:
    """Draw the storage or the loss modulus of every sweep as measured, coloured by temperature.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    isotherms : IsothermalSweeps, Superposition, sequence of Isotherm, or xarray.Dataset
        A dataset has `temperature`, `angular_frequency`, `storage_modulus`, `loss_modulus` along `reading`.
    modulus : {"storage", "loss"}

    Returns
    -------
    matplotlib.cm.ScalarMappable
        Temperatures in °C to colours, for a colour bar (`style.temperature_bar`).
    """
    check_choice(modulus, "modulus", "storage", "loss")
    return draw_diagram(axes, isotherms, "frequency", modulus, marker="s" if modulus == "storage" else "o")


def draw_diagram(axes: Axes, sweeps: Sweeps | SuperpositionCheck, x: str, y: str, **look: Any) -> ScalarMappable:
    """Draw one quantity of every sweep over another; those with a unit, and tan δ, in decades."""
    measured = moduli_of_sweeps(sweeps)
    storage, loss, letter = measured.storage, measured.loss, measured.symbol
    quantities = {
        "frequency": (measured.angular_frequency, r"angular frequency $\omega$ (rad/s)"),
        "storage": (storage, f"storage modulus ${letter}'$ (MPa)"),
        "loss": (loss, f"loss modulus ${letter}''$ (MPa)"),
        "magnitude": (np.hypot(storage, loss), rf"modulus $|{letter}^*|$ (MPa)"),
        "tangent": (measured.loss_tangent, r"loss tangent $\tan\delta$"),
        "angle": (np.degrees(np.arctan2(loss, storage)), r"loss angle $\delta$ (°)"),
    }
    (across, x_label), (upwards, y_label) = quantities[x], quantities[y]
    order = np.argsort(measured.angular_frequency, kind="stable")
    scale = draw_by_temperature(axes, measured.temperature[order], across[order], upwards[order], **look)
    axes.set(xlabel=x_label, ylabel=y_label)
    style.logarithmic(axes, "x" if y == "angle" else "xy")
    if y == "angle":
        style.plain_numbers(axes, "y")
    return scale


def draw_by_temperature(axes: Axes, temperature: Array, x: Array, y: Array, **look: Any) -> ScalarMappable:
    """Draw points of each temperature (K) in their order, with marks and a line if `look` says nothing else."""
    nominal = nominal_temperatures(temperature)
    if not nominal.size:
        nominal = np.array([293.15])  # a scale for the colour bar of an empty figure
    scale = style.temperature_scale(nominal)
    which = nearest(nominal, temperature)
    look = {"marker": "o", "markersize": 3, "linewidth": 0.8, **look}
    for index, kelvin in enumerate(nominal):
        rows = np.flatnonzero(which == index)
        if not rows.size:
            continue
        colour = scale.to_rgba(np.array(celsius(float(kelvin))))
        axes.plot(x[rows], y[rows], color=colour, label=degrees(float(kelvin)), **look)
    return scale


def plot_master_curve(
    axes: Axes,
    master_curve: Master,
    spectrum_curve: Fitted | None = None,
    *,
    reference_temperature: float | None = None,
    band: Any = None,
    synthetic: bool = False,
) -> None:
    """Draw the measured master curve with the fitted retardation spectrum.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    master_curve : MasterCurve, Superposition or xarray.Dataset
        A dataset has `angular_frequency` (reduced), `storage_modulus`, `loss_modulus` and, for the fit,
        `fitted_storage_modulus` and `fitted_loss_modulus` along `reading`.
    spectrum_curve : RetardationSpectrum, ModulusTable or xarray.Dataset, optional
        The fit; a dataset has `storage_modulus` and `loss_modulus` along `angular_frequency`.
    reference_temperature : float, optional
        K, for the label; known already where a master curve is given as an object.
    band : MaterialSamples or xarray.Dataset, optional
        Bounds of E' and E''; a dataset has `storage_modulus_lower`, `storage_modulus_upper`, `loss_modulus_lower`
        and `loss_modulus_upper` along `angular_frequency`.  Frequencies beyond the points lie on grey then: the bounds
        there are those of an extrapolated spectrum.
    synthetic : bool
        Whether to call the points synthetic instead of measured.
    """
    measured = moduli_of_master_curve(master_curve)
    frequency = measured.angular_frequency
    wide = np.geomspace(frequency.min() / _BEYOND, frequency.max() * _BEYOND, 300)
    fitted = _fitted(master_curve, spectrum_curve, wide)
    bounds = None if band is None else modulus_band(band, wide)
    handles: list[Any] = []
    bands: list[Any] = []
    for (name, symbol, marker, colour), dashes in zip(style.MODULI, _DASHES, strict=True):
        dots: dict[str, Any] = {"color": colour, "markersize": 3.5, "markeredgewidth": 0.8, "fillstyle": "none"}
        handles += axes.plot(
            frequency, getattr(measured, name), marker, label=f"{symbol} {style.origin(synthetic)}", **dots
        )
        if fitted is not None:
            order = np.argsort(fitted.angular_frequency, kind="stable")
            line, part = fitted.angular_frequency[order], getattr(fitted, name)[order]
            handles += axes.plot(line, part, color=style.INK, linestyle=dashes, linewidth=1.2, label=f"{symbol} fitted")
        if bounds is not None:
            lower, upper = getattr(bounds, name)
            look: dict[str, Any] = {"color": colour, "alpha": 0.25, "linewidth": 0, "zorder": 1}
            bands.append(axes.fill_between(bounds.angular_frequency, lower, upper, label=f"{symbol}, 95 %", **look))
    axes.set(xscale="log", yscale="log")
    if bands and frequency.size:
        bands += _shade_beyond(axes, float(frequency.min()), float(frequency.max()))
    at = measured.reference if reference_temperature is None else reference_temperature
    axes.set(xlabel=style.reduced_frequency(at), ylabel="modulus (MPa)")
    style.logarithmic(axes)
    style.legend_above(axes, handles + bands, columns=3 if bands else 2)


def plot_residuals(
    axes: Axes, master_curve: Master, spectrum: Fitted | None = None, *, reference_temperature: float | None = None
) -> None:
    """Draw log10 of measured over fitted E' and E'' against reduced frequency: the panel below a master curve.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    master_curve, spectrum, reference_temperature
        See `plot_master_curve`; of a dataset the columns `fitted_storage_modulus` and `fitted_loss_modulus`.
    """
    measured = moduli_of_master_curve(master_curve)
    frequency = measured.angular_frequency
    at_readings = None if hasattr(spectrum, "data_vars") else spectrum  # a dataset has frequencies of its own
    fitted = _fitted(master_curve, at_readings, frequency)
    if fitted is None:
        raise InputError("there is no fit to compare with: give a spectrum.", code="no-fit")
    handles: list[Any] = []
    largest = 0.01
    for name, symbol, marker, colour in style.MODULI:
        left = np.log10(getattr(measured, name) / getattr(fitted, name))
        rms = float(np.sqrt(np.mean(left**2))) if left.size else 0.0
        largest = max(largest, float(np.max(np.abs(left), initial=0.0)))
        dots: dict[str, Any] = {"color": colour, "markersize": 3, "markeredgewidth": 0.7, "fillstyle": "none"}
        handles += axes.plot(frequency, left, marker, label=f"{symbol}, rms {rms:#.3g}", **dots)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=0)
    axes.set_ylim(-1.12 * largest, 1.12 * largest)
    at = measured.reference if reference_temperature is None else reference_temperature
    axes.set_xlabel(style.reduced_frequency(at))
    axes.set_ylabel(r"$\log_{10}\,\frac{\mathrm{measured}}{\mathrm{fit}}$")
    style.logarithmic(axes, "x")
    style.legend_above(axes, handles)


def _fitted(master_curve: Master, spectrum: Fitted | None, frequency: Array) -> Moduli | None:
    """Return the fit: of an object at some frequencies (n,), rad/s, else where a dataset has it; None without one."""
    if spectrum is not None:
        return moduli(spectrum if hasattr(spectrum, "data_vars") else spectrum.modulus_dataset(frequency))
    found = getattr(master_curve, "data_vars", {})
    return moduli(cast("Dataset", master_curve), "fitted_") if "fitted_storage_modulus" in found else None


_RESPONSES = {
    "creep_compliance": (1e6, "creep compliance $D$ (1/MPa)"),
    "relaxation_modulus": (1e-6, "relaxation modulus $E$ (MPa)"),
}


def plot_step_master_curve(axes: Axes, curve: Dataset, *, synthetic: bool = False) -> ScalarMappable:
    """Draw a creep compliance or relaxation modulus over reduced time, with the fit; return the colours."""
    name = next(one for one in _RESPONSES if one in curve)
    factor, label = _RESPONSES[name]
    time, kelvin = np.asarray(curve["time"]), np.asarray(curve["temperature"])
    response = factor * np.asarray(curve[name])
    points: dict[str, Any] = {"marker": "o", "linestyle": "none", "markersize": 3, "fillstyle": "none"}
    scale = draw_by_temperature(axes, kelvin, time, response, **points)
    handles = axes.plot([], [], color=style.INK, label=style.origin(synthetic), **points)
    if f"fitted_{name}" in curve:
        fitted = factor * np.asarray(curve[f"fitted_{name}"])
        order = np.argsort(time, kind="stable")
        handles += axes.plot(time[order], fitted[order], color=style.INK, linewidth=1.2, label="fitted")
    axes.set_xlabel(
        r"reduced time $t/\alpha_T$ (s)" + style.at_temperature(number(curve.attrs, "reference_temperature"))
    )
    axes.set_ylabel(label)
    style.logarithmic(axes)
    style.legend_above(axes, handles, columns=2)
    return scale


#: Modes weaker than the strongest by more than this are left below the axis: they change nothing that can be seen.
_DECADES_SHOWN = 10.0


def plot_retardation_spectrum(
    axes: Axes, spectrum: RetardationSpectrum | Dataset, samples: MaterialSamples | None = None
) -> None:
    """Draw the compliance C_k of each retardation mode over its time τ_k.

    Times that no measured frequency reaches (τ beyond 1/ω) lie on grey: the modes there are extrapolated.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    spectrum : RetardationSpectrum or xarray.Dataset
        A dataset has `retardation_time` and `creep_coefficient` along `mode`.
    samples : MaterialSamples, optional
        For the 95 % band of each C_k, drawn where all samples share their retardation times.
    """
    modes, fit = as_dataset(spectrum), getattr(spectrum, "fit", None)
    frequencies = None if fit is None else fit.frequency_range
    tau, C = values(modes, "retardation_time"), values(modes, "creep_coefficient")
    _draw_modes(axes, tau, C * _PASCAL_PER_MEGAPASCAL, style.BLUE, "o")
    handles = [] if samples is None else _draw_band(axes, samples)
    if frequencies is not None:
        handles += _shade_beyond(axes, 1.0 / frequencies[1], 1.0 / frequencies[0])
    if handles:
        style.legend_above(axes, handles)
    axes.set(xlabel=r"retardation time $\tau_k$ (s)", ylabel=r"compliance of a mode $C_k$ (1/MPa)")


def plot_relaxation_spectrum(axes: Axes, spectrum: RelaxationSpectrum | RetardationSpectrum) -> None:
    """Draw the modulus E_k of each relaxation (Prony) mode over its time τ_k.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    spectrum : RelaxationSpectrum or RetardationSpectrum
        The latter is converted, exactly.
    """
    series = as_dataset(spectrum.to_relaxation() if isinstance(spectrum, RetardationSpectrum) else spectrum)
    modulus = values(series, "modulus") / _PASCAL_PER_MEGAPASCAL
    _draw_modes(axes, values(series, "relaxation_time"), modulus, style.VERMILION, "s")
    axes.set(xlabel=r"relaxation time $\tau_k$ (s)", ylabel=r"modulus of a mode $E_k$ (MPa)")


def _draw_modes(axes: Axes, tau: Array, strength: Array, colour: str, marker: str) -> None:
    """Draw a stem for each mode above zero, on logarithmic axes."""
    shown = np.flatnonzero(strength > 10.0**-_DECADES_SHOWN * np.max(strength, initial=0.0))
    axes.set(xscale="log", yscale="log")
    if not shown.size:
        return
    low, high = np.log10(strength[shown].min()), np.log10(strength[shown].max())
    room = 0.05 * max(high - low, 1.0)
    axes.set_ylim(10.0 ** (low - 2.0 * room), 10.0 ** (high + room))
    axes.set_xlim(tau[shown].min() / 3.0, tau[shown].max() * 3.0)
    axes.vlines(tau[shown], axes.get_ylim()[0], strength[shown], color=colour, linewidth=1.1)
    axes.plot(tau[shown], strength[shown], marker, color=colour, markersize=4)
    style.logarithmic(axes)


def _draw_band(axes: Axes, samples: MaterialSamples) -> list[Any]:
    if np.any(np.ptp(samples.tau, axis=0) > 0.0):
        return []
    limits, band = axes.axis(), samples.spectrum_band()
    lower, upper = (np.maximum(side * _PASCAL_PER_MEGAPASCAL, limits[2]) for side in (band.lower, band.upper))
    filled = axes.fill_between(
        samples.tau[0], lower, upper, color=style.BLUE, alpha=0.2, linewidth=0, zorder=1, label="95 % band"
    )
    axes.axis(limits)
    return [filled]


def _shade_beyond(axes: Axes, first: float, last: float) -> list[Any]:
    """Put grey behind what lies below the first and above the last measured place."""
    left, right = axes.get_xlim()
    spans = [
        axes.axvspan(start, end, color=style.GREY, alpha=0.18, linewidth=0, zorder=0, label="extrapolated")
        for start, end in ((left, min(first, right)), (max(last, left), right))
        if start < end
    ]
    axes.set_xlim(left, right)
    return spans[:1]
