"""Figures of shift factors: measured ones, laws and their residuals, vertical shifts, and those from friction."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.report.data import Shifts, ShiftTable, as_dataset, beside_friction, law_line, law_residuals, shift_table
from viscofric.report.figures import style
from viscofric.report.results import SHOWN_AS_ONE, values
from viscofric.report.texts.numbers import degrees
from viscofric.rheology.shifts.laws import WLF, Arrhenius, WLFArrhenius
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.rheology.superposition.result import Superposition
from viscofric.units import CELSIUS_ZERO

#: 10 to this power is still a float, and beyond any axis.
_LARGEST = 100.0


def plot_shift_factors(axes: Axes, shift_factors: Shifts, law: ShiftLaw | str | None = None) -> None:
    """Draw measured shift factors with their standard errors, and a law with its 95 % band.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    shift_factors : ShiftFactors, Superposition or xarray.Dataset
        A dataset has `log10_shift_factor` and `standard_error` (of log10) along `temperature` (K), and the attribute
        `reference_temperature`.
    law : ShiftLaw or str, optional
        A law, or the kind of one to be fitted here (see `ShiftFactors.law`).
    """
    table = shift_table(shift_factors)
    if isinstance(law, str):
        law = _fitted(shift_factors, law)
    handles = [_points(axes, table, style.BLUE, "o", "isotherms, ± standard error")]
    if law is not None:
        handles += draw_law(axes, law, table.temperature)
    low, high = np.nanmin(table.log10), np.nanmax(table.log10)
    _finish(axes, low, high, 0.06 * max(high - low, 1.0), handles)


def plot_vertical_shift(
    axes: Axes, vertical_shift: VerticalShift | Superposition | Dataset, temperatures: Array | None = None
) -> None:
    """Draw the vertical shift b(T): a table with its standard errors, or a law.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    vertical_shift : VerticalShift, Superposition or xarray.Dataset
        A dataset has `log10_vertical_shift` along `temperature` (K) and, of a table, its `vertical_standard_error`.
    temperatures : (n,) array, optional
        K; where to draw a law.  By default 100 K about its reference.
    """
    data = _vertical(vertical_shift, temperatures)
    warm, b = values(data, "temperature") - CELSIUS_ZERO, 10.0 ** values(data, "log10_vertical_shift")
    if "vertical_standard_error" in data:
        error = np.log(10.0) * b * values(data, "vertical_standard_error")
        axes.errorbar(warm, b, yerr=error, fmt="o", color=style.BLUE, markersize=4.5, elinewidth=1.0)
    else:
        axes.plot(warm, b, color=style.VERMILION)
    axes.axhline(1.0, color=style.GREY, linewidth=0.8, zorder=0)
    axes.set(xlabel="temperature (°C)", ylabel=r"vertical shift $b_T$")
    style.plain_numbers(axes, "x")
    style.plain_numbers(axes, "y")


def _vertical(source: Any, temperatures: Array | None) -> Dataset:
    """Return a vertical shift as a dataset; that of a law at many temperatures."""
    if hasattr(source, "data_vars") or not hasattr(source, "reference") or hasattr(source, "temperatures"):
        return as_dataset(source)
    near = source.reference + np.array([-50.0, 50.0]) if temperatures is None else temperatures
    return as_dataset(source, np.linspace(float(near.min()), float(near.max()), 200))


def plot_law_residuals(axes: Axes, shift_factors: Shifts, laws: Sequence[ShiftLaw]) -> None:
    """Draw what each law leaves unexplained, log10 of measured over predicted α, in the measurement's 95 % band.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    shift_factors : ShiftFactors, Superposition or xarray.Dataset
        See `plot_shift_factors`.
    laws : sequence of ShiftLaw
        With the same reference.  One that is far worse than the two best runs out of the axes.
    """
    table = shift_table(shift_factors)
    warm = table.temperature - CELSIUS_ZERO
    doubt = LEVEL_95 * table.error
    handles: list[Any] = [
        axes.fill_between(warm, -doubt, doubt, color=style.GREY, alpha=0.3, linewidth=0, label="95 % of the factors")
    ]
    axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    every = []
    for law, look in zip(laws, style.looks(len(laws)), strict=True):
        residuals = law_residuals(law, table)
        left = values(residuals, "log10_residual")
        line: dict[str, Any] = {"color": look.colour, "marker": look.marker, "linestyle": look.dashes, "markersize": 4}
        warm_there, title = values(residuals, "temperature") - CELSIUS_ZERO, getattr(law, "title", type(law).__name__)
        handles += axes.plot(warm_there, left, linewidth=1.0, label=title, **line)
        every.append(left)
    axes.set_ylim(*_limits_of_residuals(every, doubt))
    axes.set(xlabel="temperature (°C)", ylabel=r"$\log_{10}$ of measured over law's $\alpha_T$")
    style.plain_numbers(axes, "x")
    style.legend_above(axes, handles, columns=2)


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
        other = shift_table(beside_friction(as_dataset(known), table.temperature))
        if abs(other.reference - table.reference) > SHOWN_AS_ONE:
            raise InputError(
                f"shift factors of friction are 1 at {degrees(table.reference)}, those of the modulus at "
                f"{degrees(other.reference)}: must be the same to be drawn together.",
                code="other-reference",
            )
        handles.append(_points(axes, other, style.INK, "s", "of the modulus, ± standard error"))
        lowest, highest = float(np.min(other.log10)), float(np.max(other.log10))
    handles.append(_points(axes, table, style.BLUE, "o", "from friction, ± standard error"))
    low, high = min(lowest, float(table.log10.min())), max(highest, float(table.log10.max()))
    _finish(axes, low, high, 0.08 * max(high - low, 0.5), handles, style.at_temperature(table.reference, ", 1"))


def _finish(axes: Axes, low: float, high: float, room: float, handles: list[Any], at: str = "") -> None:
    """Give axes of shift factors their limits (log10), with room beyond them, and their labels."""
    axes.set_ylim(10.0 ** (low - room), 10.0 ** (high + room))
    axes.set(xlabel="temperature (°C)", ylabel=r"shift factor $\alpha_T$" + at)
    style.plain_numbers(axes, "x")
    style.logarithmic(axes, "y")
    style.legend_above(axes, handles, columns=1)


def _points(axes: Axes, table: ShiftTable, colour: str, marker: str, label: str) -> Any:
    small: dict[str, Any] = {"markersize": 4.5, "fillstyle": "full", "zorder": 3}
    look = small if marker == "o" else {"markersize": 6.5, "fillstyle": "none", "zorder": 2}
    warm, error = table.temperature - CELSIUS_ZERO, bars(table.log10, table.error)
    return axes.errorbar(warm, 10.0**table.log10, error, fmt=marker, color=colour, elinewidth=1.0, label=label, **look)


def _limits_of_residuals(every: list[Array], doubt: Array) -> tuple[float, float]:
    # The band of a plateau may be endless: the laws set the scale, with the usual doubt.
    usual = min(float(np.median(doubt)), 1.0)
    largest = [float(np.max(np.abs(left), initial=0.0)) for left in every]
    scale = max(usual, *sorted(largest)[:2], 1e-3)
    near = [left for left, most in zip(every, largest, strict=True) if most <= 3.0 * scale]
    shown = np.concatenate([np.array([-usual, usual]), *near])
    low, high = float(shown.min()), float(shown.max())
    room = 0.08 * max(high - low, 1e-3)
    return low - room, high + room


def bars(log10: Array, error: Array) -> Array:
    """Lengths of error bars of 10**log10 for a standard error of log10; endless ones end beyond any axis."""
    factor, error = 10.0**log10, np.minimum(error, _LARGEST)
    return np.array([factor * (1.0 - 10.0**-error), factor * (10.0**error - 1.0)])


def draw_law(axes: Axes, law: ShiftLaw, temperatures: Array, whose: str = "") -> list[Any]:
    """Draw a law with its 95 % band over a range of temperatures (K), and return what the legend shows of them."""
    line = law_line(law, float(temperatures.min()), float(temperatures.max()), 400)
    if not line.sizes["temperature"]:
        return []
    warm, log10 = values(line, "temperature") - CELSIUS_ZERO, values(line, "log10_shift_factor")
    handles: list[Any] = axes.plot(
        warm, 10.0 ** np.clip(log10, -_LARGEST, _LARGEST), color=style.VERMILION, label=f"{whose}{_described(law)}"
    )
    if "standard_error" in line:
        doubt = LEVEL_95 * values(line, "standard_error")
        lower, upper = (10.0 ** np.clip(log10 + side * doubt, -_LARGEST, _LARGEST) for side in (-1.0, 1.0))
        handles.append(
            axes.fill_between(warm, lower, upper, color=style.VERMILION, alpha=0.25, linewidth=0, label="its 95 % band")
        )
    return handles


def _described(law: ShiftLaw) -> str:
    """Name a law with its constants, where they are two that everybody quotes."""
    at = f"at {degrees(law.reference)}"
    if isinstance(law, WLFArrhenius):
        return f"WLF above {degrees(law.glass_transition)}, Arrhenius below"
    if isinstance(law, WLF | Arrhenius):
        return str(law)
    return f"{getattr(law, 'title', type(law).__name__)} {at}"


def _fitted(shift_factors: Shifts, kind: str) -> ShiftLaw:
    factors: Any = getattr(shift_factors, "shift_factors", shift_factors)
    fitted: ShiftLaw = factors.law(kind)
    return fitted
