"""Figures of the modulus identified from friction or indentation, and of the records behind it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.report.data import Master, Moduli, as_dataset, moduli, moduli_of_master_curve, modulus_band
from viscofric.report.figures import style
from viscofric.report.results import number, values
from viscofric.rheology.material import Material
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from viscofric.friction.identification.indentation.result import FittedRecord, MaterialFromIndentation
    from viscofric.friction.identification.result import Identified


def plot_identified_modulus(axes: Axes, found: Identified | Dataset, known: Material | Master | None = None) -> None:
    """Draw an identified modulus with its 95 % band, the identified frequencies marked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    found : Identified or xarray.Dataset
        From `viscofric.identify_material` or `viscofric.identify_from_indentation`, or its `to_dataset`.
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
        handles.append(axes.axvspan(low, high, color=style.GREY, alpha=0.15, linewidth=0.0, zorder=0, label=known_to))
    for name, symbol, _, colour in style.MODULI:
        value, limits = getattr(modulus, name), getattr(bounds, name)
        shade: dict[str, Any] = {"color": colour, "alpha": 0.22, "linewidth": 0.0, "zorder": 1}
        axes.plot(frequency, value, color=colour, linewidth=0.7)
        handles += axes.plot(frequency, np.where(inside, value, np.nan), color=colour, label=f"{symbol} identified")
        handles.append(axes.fill_between(frequency, *limits, **shade, label=f"{symbol}, 95 %"))
    if known is not None:
        handles += _plot_known(axes, known, frequency)
    axes.set_xlim(frequency[0], frequency[-1])
    axes.set_xlabel(style.reduced_frequency(modulus.reference))
    axes.set_ylabel("modulus (MPa)")
    style.logarithmic(axes)
    style.legend_above(axes, handles, columns=2)


def _plot_known(axes: Axes, known: Material | Master, frequency: Array) -> list[Any]:
    if isinstance(known, Material):
        modulus = 1e-6 * np.asarray(known.complex_modulus(frequency))
        dashed: dict[str, Any] = {"color": style.INK, "linestyle": (0, (5, 1.5)), "linewidth": 1.0}
        axes.plot(frequency, modulus.imag, **dashed)
        return axes.plot(frequency, modulus.real, **dashed, label=known.name or "for comparison")
    points: Moduli = moduli_of_master_curve(known)
    near = (points.angular_frequency >= frequency[0]) & (points.angular_frequency <= frequency[-1])
    look: dict[str, Any] = {"color": style.INK, "markersize": 3.0, "fillstyle": "none", "markeredgewidth": 0.7}
    look["zorder"] = 2
    axes.plot(points.angular_frequency[near], points.loss[near], "o", **look)
    return axes.plot(points.angular_frequency[near], points.storage[near], "s", **look, label="DMA")


def identified_figure(found: Identified, known: Material | None = None) -> Figure:
    """Return a figure of an identified modulus, beside a known one."""
    return style.one_panel(plot_identified_modulus, found, _at_reference(known, found))


def _at_reference(known: Material | None, found: Identified) -> Material | None:
    reference = found.material.reference
    if known is None or known.shift is None or reference is None:
        return known
    return known.at_reference(reference) if known.shift.valid_at(reference) else None


def indentation_figure(found: MaterialFromIndentation, known: Material | None = None) -> Figure:
    """Return a figure of a modulus identified from indentation, the fits of its records, and their residuals."""
    kinds = list(dict.fromkeys(one.quantity for one in found.records))
    figure = style.new_figure(height=3.4 * (1 + len(kinds)))
    rows = figure.subplots(1 + len(kinds), 2, squeeze=False, width_ratios=(3, 2))
    whole = rows[0][0].get_gridspec()
    for axes in rows[0]:
        axes.remove()
    plot_identified_modulus(figure.add_subplot(whole[0, :]), found, _at_reference(known, found))
    for (fit, residuals), quantity in zip(rows[1:], kinds, strict=True):
        plot_fitted_records(fit, residuals, [one for one in found.records if one.quantity == quantity])
    return figure


def plot_fitted_record(axes: Axes, record: FittedRecord, colour: str = "C0") -> None:
    """Draw one measured quantity of a record with its fit and 95 % limits."""
    order = np.argsort(record.along, kind="stable")
    along = record.along[order]
    axes.errorbar(
        along, record.response[order], record.error[order] * record.response[order], fmt="o", color=colour,
        markersize=2.5, elinewidth=0.6, label=f"{shown_celsius(float(record.record.temperature))} °C",
    )  # fmt: skip
    axes.plot(along, record.fitted[order], color=colour, linewidth=0.9)
    axes.fill_between(along, record.lower[order], record.upper[order], color=colour, alpha=0.25, linewidth=0.0)
    data = record.to_dataset()
    unit = next(one.attrs for name, one in data.variables.items() if name in _ALONG)
    units = data["response"].attrs["units"]
    axes.set(xscale="log", yscale="log", xlabel=f"{unit['long_name']} ({unit['units']})")
    axes.set_ylabel(record.words + ("" if units == "1" else f" ({units.replace('m2', 'm²')})"))


def plot_fitted_records(axes: Axes, below: Axes, records: Sequence[FittedRecord]) -> None:
    """Draw one measured quantity of records with its fit and 95 % limits, and the residuals on other axes.

    Parameters
    ----------
    axes, below : matplotlib.axes.Axes
    records : sequence of FittedRecord
        All of one quantity.
    """
    for place, one in enumerate(records):
        plot_fitted_record(axes, one, f"C{place}")
        below.plot(one.along, one.residuals, "o", color=f"C{place}", markersize=2.5)
    label = axes.get_xlabel()
    below.axhspan(-1.96, 1.96, color=style.GREY, alpha=0.15, linewidth=0.0)
    below.set(xscale="log", xlabel=label, ylabel="residual over its error")
    for axis in (axes.xaxis, axes.yaxis, below.xaxis):
        style.decade_ticks(axis)
    axes.legend()


_ALONG = ("time", "angular_frequency", "speed")
