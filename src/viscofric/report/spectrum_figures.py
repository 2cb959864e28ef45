"""Figures of the spectrum: the compliance of each retardation mode, the modulus of each relaxation mode."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.report.house_style import BLUE, GREY, VERMILION, decade_ticks, legend_above
from viscofric.report.results import values
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from viscofric.arrays import Array
    from viscofric.rheology.spectra.retardation import RelaxationSpectrum
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples


_PASCAL_PER_MEGAPASCAL = 1e6
#: Modes weaker than the strongest by more than this are left below the axis: they change nothing that can be seen.
_DECADES_SHOWN = 10.0


def plot_retardation_spectrum(
    axes: Axes, spectrum: RetardationSpectrum | xr.Dataset, samples: MaterialSamples | None = None
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
    frequencies = None
    if isinstance(spectrum, RetardationSpectrum):
        tau, C = spectrum.tau, spectrum.C
        frequencies = None if spectrum.fit is None else spectrum.fit.frequency_range
    else:
        tau, C = values(spectrum, "retardation_time"), values(spectrum, "creep_coefficient")
    _draw_modes(axes, tau, C * _PASCAL_PER_MEGAPASCAL, BLUE, "o")
    handles = [] if samples is None else _draw_band(axes, samples)
    if frequencies is not None:
        handles += _shade_extrapolated(axes, frequencies)
    if handles:
        legend_above(axes, handles)
    axes.set_xlabel(r"retardation time $\tau_k$ (s)")
    axes.set_ylabel(r"compliance of a mode $C_k$ (1/MPa)")


def plot_relaxation_spectrum(axes: Axes, spectrum: RelaxationSpectrum | RetardationSpectrum) -> None:
    """Draw the modulus E_k of each relaxation (Prony) mode over its time τ_k.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    spectrum : RelaxationSpectrum or RetardationSpectrum
        The latter is converted, exactly.
    """
    series = spectrum.to_relaxation() if isinstance(spectrum, RetardationSpectrum) else spectrum
    _draw_modes(axes, series.tau, series.E / _PASCAL_PER_MEGAPASCAL, VERMILION, "s")
    axes.set_xlabel(r"relaxation time $\tau_k$ (s)")
    axes.set_ylabel(r"modulus of a mode $E_k$ (MPa)")


def _draw_modes(axes: Axes, tau: Array, strength: Array, colour: str, marker: str) -> None:
    """Draw a stem for each mode above zero, on logarithmic axes."""
    shown = np.flatnonzero(strength > 10.0**-_DECADES_SHOWN * np.max(strength, initial=0.0))
    axes.set_xscale("log")
    axes.set_yscale("log")
    if not shown.size:
        return
    low, high = np.log10(strength[shown].min()), np.log10(strength[shown].max())
    room = 0.05 * max(high - low, 1.0)
    axes.set_ylim(10.0 ** (low - 2.0 * room), 10.0 ** (high + room))
    axes.set_xlim(tau[shown].min() / 3.0, tau[shown].max() * 3.0)
    axes.vlines(tau[shown], axes.get_ylim()[0], strength[shown], color=colour, linewidth=1.1)
    axes.plot(tau[shown], strength[shown], marker, color=colour, markersize=4)
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)


def _draw_band(axes: Axes, samples: MaterialSamples) -> list[Any]:
    if np.any(np.ptp(samples.tau, axis=0) > 0.0):
        return []
    limits, band = axes.axis(), samples.spectrum_band()
    lower, upper = (np.maximum(side * _PASCAL_PER_MEGAPASCAL, limits[2]) for side in (band.lower, band.upper))
    filled = axes.fill_between(
        samples.tau[0], lower, upper, color=BLUE, alpha=0.2, linewidth=0, zorder=1, label="95 % band"
    )
    axes.axis(limits)
    return [filled]


def _shade_extrapolated(axes: Axes, frequencies: tuple[float, float]) -> list[Any]:
    left, right = axes.get_xlim()
    shortest, longest = 1.0 / frequencies[1], 1.0 / frequencies[0]
    spans = [
        axes.axvspan(start, end, color=GREY, alpha=0.18, linewidth=0, zorder=0, label="extrapolated")
        for start, end in ((left, min(shortest, right)), (max(longest, left), right))
        if start < end
    ]
    axes.set_xlim(left, right)
    return spans[:1]
