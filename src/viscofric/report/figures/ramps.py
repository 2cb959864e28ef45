"""Figures of temperature ramps, with their glass transition, and of amplitude sweeps, with Kraus's law."""

from __future__ import annotations

import json
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscofric.arguments import insist_on
from viscofric.datasets import Dataset
from viscofric.errors import check_choice
from viscofric.ramps import TemperatureRamps
from viscofric.report.figures.style import BLUE, GREY, VERMILION, one_panel, sequential_looks
from viscofric.report.results import values
from viscofric.rheology.payne.kraus_fit import PayneFit
from viscofric.rheology.ramps.result import RampSuperposition, glass_transition
from viscofric.units import CELSIUS_ZERO

_PASCAL_PER_MEGAPASCAL = 1e6
#: So many ramps have an entry in the legend.
_NAMED = 8


def plot_temperature_ramps(
    axes: Axes,
    ramps: TemperatureRamps | RampSuperposition | Dataset,
    quantity: Literal["moduli", "tan delta"] = "moduli",
) -> None:
    """Draw temperature ramps: storage and loss modulus, or tan δ with its peaks, a colour for each frequency.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    ramps : TemperatureRamps, RampSuperposition, or xarray.Dataset
        A dataset is one of theirs.
    quantity : {"moduli", "tan delta"}
    """
    check_choice(quantity, "quantity", "moduli", "tan delta")
    found = ramps if not isinstance(ramps, (TemperatureRamps, RampSuperposition)) else _with_peaks(ramps)
    frequency = values(found, "angular_frequency")
    letter = "G" if found.attrs.get("deformation") == "shear" else "E"
    frequencies = np.unique(frequency)
    for place, (one, look) in enumerate(zip(frequencies, sequential_looks(len(frequencies)), strict=True)):
        inside = frequency == one
        celsius = values(found, "temperature")[inside] - CELSIUS_ZERO
        storage, loss = (values(found, name)[inside] for name in ("storage_modulus", "loss_modulus"))
        label = f"{one / (2.0 * np.pi):.3g} Hz" if place < _NAMED else None
        points = {"color": look.colour, "marker": ".", "linestyle": "none", "markersize": 4.0}
        if quantity == "moduli":
            axes.plot(celsius, storage / _PASCAL_PER_MEGAPASCAL, label=label, **points)
            axes.plot(celsius, loss / _PASCAL_PER_MEGAPASCAL, markerfacecolor="none", **points)
        else:
            axes.plot(celsius, loss / storage, label=label, **points)
    axes.set_xlabel("temperature (°C)")
    if quantity == "moduli":
        axes.set(yscale="log", ylabel=f"{letter}\u2032 (filled), {letter}\u2033 (open) (MPa)")
    else:
        axes.set_ylabel(r"tan $\delta$")
        for peak in json.loads(str(found.attrs.get("glass_transitions", "[]"))):
            if peak["by"] == "tan delta":
                at, error = peak["temperature"] - CELSIUS_ZERO, peak["standard_error"]
                axes.errorbar(at, peak["height"], xerr=error, color=GREY, marker="|", capsize=2.0, zorder=3)
    axes.legend(title="frequency")


def _with_peaks(ramps: TemperatureRamps | RampSuperposition) -> Dataset:
    if isinstance(ramps, RampSuperposition):
        return ramps.to_dataset()
    found = [one for ramp in ramps.ramps if (one := glass_transition(ramp)) is not None]
    peaks = [
        {"by": one.by, "temperature": one.temperature, "standard_error": one.standard_error, "height": one.height}
        for one in found
    ]
    return ramps.to_dataset().assign_attrs(glass_transitions=json.dumps(peaks))


def plot_amplitude_sweep(axes: Axes, fit: PayneFit) -> None:
    """Draw storage and loss modulus against the strain amplitude, with Kraus's law and the linear range.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    fit : PayneFit
        From `viscofric.rheology.fit_kraus`.
    """
    insist_on(fit, "fit", PayneFit)
    sweep = fit.sweep
    letter = "G" if sweep.deformation == "shear" else "E"
    strain = np.geomspace(sweep.strain_amplitude[0], sweep.strain_amplitude[-1], 300)
    law = fit.law.complex_modulus(strain) / _PASCAL_PER_MEGAPASCAL
    for measured, line, colour, mark in (
        (sweep.storage_modulus, law.real, BLUE, "\u2032"),
        (sweep.loss_modulus, law.imag, VERMILION, "\u2033"),
    ):
        points = measured / _PASCAL_PER_MEGAPASCAL
        axes.plot(100.0 * sweep.strain_amplitude, points, ".", color=colour, label=f"{letter}{mark}", markersize=5.0)
        axes.plot(100.0 * strain, line, color=colour, linewidth=1.0)
    for one in fit.linear_ranges:
        if np.isfinite(one.strain):
            axes.axvline(100.0 * one.strain, color=GREY, linewidth=0.8, linestyle=":")
    axes.set(xscale="log", yscale="log", xlabel="strain amplitude (%)", ylabel="modulus (MPa)")
    axes.legend()


def amplitude_figure(fit: PayneFit) -> Figure:
    """Return a figure of an amplitude sweep with Kraus's law."""
    return one_panel(plot_amplitude_sweep, fit)
