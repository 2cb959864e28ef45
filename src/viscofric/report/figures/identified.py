"""Figure of the modulus identified from friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.report.data import Moduli, as_dataset, moduli, moduli_of_master_curve, modulus_band
from viscofric.report.figures.style import (
    BLUE,
    GREY,
    INK,
    VERMILION,
    at_temperature,
    decade_ticks,
    legend_above,
    new_figure,
)
from viscofric.report.results import number, values
from viscofric.rheology.material import Material

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from viscofric.arrays import Array
    from viscofric.friction.identification.result import IdentifiedMaterial
    from viscofric.report.data import Master


_MEGAPASCAL = 1e6


def plot_identified_modulus(
    axes: Axes, found: IdentifiedMaterial | xr.Dataset, known: Material | Master | None = None
) -> None:
    """Draw the modulus identified from friction with its 95 % band, the identified frequencies marked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    found : IdentifiedMaterial or xarray.Dataset
        From `viscofric.identify_material`, or its `to_dataset`.
    known : Material, MasterCurve, Superposition or xarray.Dataset, optional
        The same material from a DMA, at the same reference temperature: a line, or points.
    """
    data = as_dataset(found)
    bounds, modulus = modulus_band(data, values(data, "angular_frequency")), moduli(data)
    frequency = bounds.angular_frequency
    low, high, limit = (number(data.attrs, f"identified_{name}") for name in ("low", "high", "limit"))
    inside = (frequency >= low) & (frequency <= high)
    handles: list[Any] = []
    if high > low:
        relative = number(data.attrs, "anchored") == 0.0
        known_to = f"known to {100.0 * limit:g} %" + (" except for its magnitude" if relative else "")
        handles.append(axes.axvspan(low, high, color=GREY, alpha=0.15, linewidth=0.0, zorder=0, label=known_to))
    for symbol, value, limits, colour in (
        ("$E'$", modulus.storage, bounds.storage, BLUE),
        ("$E''$", modulus.loss, bounds.loss, VERMILION),
    ):
        value, limits = value / _MEGAPASCAL, limits / _MEGAPASCAL
        shade: dict[str, Any] = {"color": colour, "alpha": 0.22, "linewidth": 0.0, "zorder": 1}
        axes.plot(frequency, value, color=colour, linewidth=0.7)
        handles += axes.plot(frequency, np.where(inside, value, np.nan), color=colour, label=f"{symbol} identified")
        handles.append(axes.fill_between(frequency, *limits, **shade, label=f"{symbol}, 95 %"))
    if known is not None:
        handles += _plot_known(axes, known, frequency)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(frequency[0], frequency[-1])
    axes.set_xlabel(r"reduced angular frequency $\alpha_T\,\omega$ (rad/s)" + at_temperature(modulus.reference))
    axes.set_ylabel("modulus (MPa)")
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)
    legend_above(axes, handles, columns=3)


def _plot_known(axes: Axes, known: Material | Master, frequency: Array) -> list[Any]:
    if isinstance(known, Material):
        modulus = np.asarray(known.complex_modulus(frequency)) / _MEGAPASCAL
        handles = axes.plot(frequency, modulus.real, color=INK, linestyle=(0, (5, 1.5)), linewidth=1.0)
        axes.plot(frequency, modulus.imag, color=INK, linestyle=(0, (5, 1.5)), linewidth=1.0)
        handles[0].set_label(known.name or "for comparison")
        return list(handles)
    points: Moduli = moduli_of_master_curve(known)
    near = (points.angular_frequency >= frequency[0]) & (points.angular_frequency <= frequency[-1])
    look: dict[str, Any] = {"color": INK, "markersize": 3.0, "fillstyle": "none", "markeredgewidth": 0.7, "zorder": 2}
    handles = axes.plot(points.angular_frequency[near], points.storage[near] / _MEGAPASCAL, "s", **look)
    axes.plot(points.angular_frequency[near], points.loss[near] / _MEGAPASCAL, "o", **look)
    handles[0].set_label("DMA")
    return list(handles)


def identified_figure(found: IdentifiedMaterial, known: Material | None = None) -> Figure:
    """Return a figure of the modulus identified from friction.

    Parameters
    ----------
    found : IdentifiedMaterial
    known : Material, optional
        To compare with, at the reference temperature of the other.
    """
    if known is not None and known.shift is not None and found.material.reference is not None:
        known = known.at_reference(found.material.reference)
    figure = new_figure()
    plot_identified_modulus(figure.subplots(), found, known)
    return figure
