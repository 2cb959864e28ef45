"""Figures of what friction says of the rubber: its shift factors beside the DMA's, the modulus that it identifies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import InputError
from viscofric.report.figure_data import Moduli, moduli_of_master_curve, modulus_band, shift_table
from viscofric.report.house_style import (
    BLUE,
    GREY,
    INK,
    VERMILION,
    at_temperature,
    decade_ticks,
    degrees,
    legend_above,
    plain_numbers,
)
from viscofric.report.results import SAME_TEMPERATURE
from viscofric.report.shift_figures import bars, draw_law
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.units import CELSIUS_ZERO

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from viscofric.arrays import Array
    from viscofric.friction.identification.result import IdentifiedMaterial
    from viscofric.report.figure_data import Master, Shifts, ShiftTable


_MEGAPASCAL = 1e6
#: The modulus is drawn so far beyond the frequencies of the contacts, as a factor.
_BEYOND = 10.0
_POINTS = 300
#: Shift factors of the modulus are drawn so far beyond those of friction, K.
FARTHER = 20.0


def plot_shift_comparison(axes: Axes, found: Shifts, known: Shifts | ShiftLaw) -> None:
    """Draw shift factors found from friction beside those of the modulus, each with its standard error.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    found : ShiftFactors, Superposition or xarray.Dataset
        From friction.  A dataset has `log10_shift_factor` and `standard_error` (of log10) along `temperature` (K), and
        the attribute `reference_temperature`.
    known : ShiftFactors, Superposition, xarray.Dataset or a law
        Of the modulus; brought to the reference of `found`, which a dataset must have already.

    Raises
    ------
    InputError
        If a dataset has another reference temperature.
    """
    table = shift_table(found)
    handles: list[Any] = []
    if isinstance(known, ShiftLaw):
        known = known.at_reference(table.reference)
    if isinstance(known, ShiftLaw) and not isinstance(known, ShiftFactors):
        ends = np.array([table.temperature.min(), table.temperature.max()])
        handles += draw_law(axes, known, ends, "of the modulus: ")
        lowest, highest = (float(part) for part in np.asarray(known.log10(ends))[[1, 0]])
    else:
        other = shift_table(known)
        if abs(other.reference - table.reference) > SAME_TEMPERATURE:
            raise InputError(
                f"shift factors of friction are 1 at {degrees(table.reference)}, those of the modulus at "
                f"{degrees(other.reference)}: must be the same to be drawn together."
            )
        other = _between(other, table.temperature)
        handles.append(_points(axes, other, INK, "s", "of the modulus, ± standard error"))
        lowest, highest = float(np.min(other.log10)), float(np.max(other.log10))
    handles.append(_points(axes, table, BLUE, "o", "from friction, ± standard error"))
    low, high = min(lowest, float(table.log10.min())), max(highest, float(table.log10.max()))
    room = 0.08 * max(high - low, 0.5)
    axes.set_yscale("log")
    axes.set_ylim(10.0 ** (low - room), 10.0 ** (high + room))
    axes.set_xlabel("temperature (°C)")
    axes.set_ylabel(r"shift factor $\alpha_T$" + at_temperature(table.reference, ", 1"))
    plain_numbers(axes, "x")
    decade_ticks(axes.yaxis)
    legend_above(axes, handles, columns=1)


def _between(table: ShiftTable, temperatures: Array) -> ShiftTable:
    """Leave out what lies far from temperatures, for a rubber's sweeps reach farther than friction."""
    low, high = temperatures.min() - FARTHER, temperatures.max() + FARTHER
    near = (table.temperature >= low) & (table.temperature <= high)
    return table._replace(temperature=table.temperature[near], log10=table.log10[near], error=table.error[near])


def _points(axes: Axes, table: ShiftTable, colour: str, marker: str, label: str) -> Any:
    return axes.errorbar(
        table.temperature - CELSIUS_ZERO,
        10.0**table.log10,
        yerr=bars(table.log10, table.error),
        fmt=marker,
        color=colour,
        markersize=4.5 if marker == "o" else 6.5,
        fillstyle="full" if marker == "o" else "none",
        elinewidth=1.0,
        zorder=3 if marker == "o" else 2,
        label=label,
    )


def drawn_frequencies(found: IdentifiedMaterial) -> Array:
    """Return the frequencies over which an identified modulus is drawn, rad/s: those of the contacts, and beyond."""
    (first, last), band = found.frequency_range, found.identified
    return np.geomspace(min(first, band.low) / _BEYOND, max(last, band.high) * _BEYOND, _POINTS)


def plot_identified_modulus(axes: Axes, found: IdentifiedMaterial, known: Material | Master | None = None) -> None:
    """Draw the modulus that friction identifies with its 95 % band, the identified frequencies marked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    found : IdentifiedMaterial
        From `viscofric.identify_material`.
    known : Material, MasterCurve, Superposition or xarray.Dataset, optional
        The same rubber as a DMA knows it, at the same reference temperature: a line, or points.
    """
    low, high = found.identified.low, found.identified.high
    frequency = drawn_frequencies(found)
    modulus = np.asarray(found.material.complex_modulus(frequency))
    bounds = modulus_band(found.samples, frequency)
    reference = found.material.reference
    inside = (frequency >= low) & (frequency <= high)
    handles: list[Any] = []
    if high > low:
        known_to = f"known to {100.0 * found.identified.limit:g} %" + (" but for the level" * found.identified.relative)
        handles.append(axes.axvspan(low, high, color=GREY, alpha=0.15, linewidth=0.0, zorder=0, label=known_to))
    for symbol, value, limits, colour in (
        ("$E'$", modulus.real, bounds.storage, BLUE),
        ("$E''$", modulus.imag, bounds.loss, VERMILION),
    ):
        value, limits = value / _MEGAPASCAL, limits / _MEGAPASCAL
        shade: dict[str, Any] = {"color": colour, "alpha": 0.22, "linewidth": 0.0, "zorder": 1}
        axes.plot(frequency, value, color=colour, linewidth=0.7)
        handles += axes.plot(frequency, np.where(inside, value, np.nan), color=colour, label=f"{symbol} from friction")
        handles.append(axes.fill_between(frequency, *limits, **shade, label=f"{symbol}, 95 %"))
    if known is not None:
        handles += _plot_known(axes, known, frequency)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(frequency[0], frequency[-1])
    axes.set_xlabel(r"reduced angular frequency $\alpha_T\,\omega$ (rad/s)" + at_temperature(reference))
    axes.set_ylabel("modulus (MPa)")
    decade_ticks(axes.xaxis)
    decade_ticks(axes.yaxis)
    legend_above(axes, handles, columns=3)


def _plot_known(axes: Axes, known: Material | Master, frequency: Array) -> list[Any]:
    if isinstance(known, Material):
        modulus = np.asarray(known.complex_modulus(frequency)) / _MEGAPASCAL
        handles = axes.plot(frequency, modulus.real, color=INK, linestyle=(0, (5, 1.5)), linewidth=1.0)
        axes.plot(frequency, modulus.imag, color=INK, linestyle=(0, (5, 1.5)), linewidth=1.0)
        handles[0].set_label(known.name or "beside it")
        return list(handles)
    points: Moduli = moduli_of_master_curve(known)
    near = (points.angular_frequency >= frequency[0]) & (points.angular_frequency <= frequency[-1])
    look: dict[str, Any] = {"color": INK, "markersize": 3.0, "fillstyle": "none", "markeredgewidth": 0.7, "zorder": 2}
    handles = axes.plot(points.angular_frequency[near], points.storage[near] / _MEGAPASCAL, "s", **look)
    axes.plot(points.angular_frequency[near], points.loss[near] / _MEGAPASCAL, "o", **look)
    handles[0].set_label("of the DMA")
    return list(handles)
