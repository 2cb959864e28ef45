"""Figures that show whether superposition holds (isotherms then fall on one line), and whether E' fits E''."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable

from viscofric.report.data import Sweeps
from viscofric.report.figures.rubber import draw_diagram
from viscofric.report.figures.style import GREY, MODULI, legend_above, logarithmic, reduced_frequency
from viscofric.rheology.superposition.consistency import SuperpositionCheck
from viscofric.rheology.superposition.kramers_kronig import KramersKronig


def plot_wicket(axes: Axes, sweeps: Sweeps | SuperpositionCheck) -> ScalarMappable:
    """Draw the loss tangent against the storage modulus of every sweep, coloured by temperature.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    sweeps : IsothermalSweeps, Superposition, sequence of Isotherm, xarray.Dataset, or SuperpositionCheck
        See `plot_isotherms`; the points of a check are without their vertical shift.

    Returns
    -------
    matplotlib.cm.ScalarMappable
        Temperatures in °C to colours, for a colour bar.
    """
    return draw_diagram(axes, sweeps, "storage", "tangent")


def plot_cole_cole(axes: Axes, sweeps: Sweeps | SuperpositionCheck) -> ScalarMappable:
    """Draw the loss against the storage modulus of every sweep, both in decades, coloured by temperature.

    Arguments and value are those of `plot_wicket`.
    """
    return draw_diagram(axes, sweeps, "storage", "loss")


def plot_booij_thoone_palmen(axes: Axes, sweeps: Sweeps | SuperpositionCheck) -> ScalarMappable:
    """Draw the loss tangent against the magnitude of the modulus of every sweep, coloured by temperature.

    Arguments and value are those of `plot_wicket`.

    References
    ----------
    H. C. Booij, J. H. M. Palmen, Theoretical and Applied Rheology (1992) 321.
    """
    return draw_diagram(axes, sweeps, "magnitude", "tangent")


def plot_van_gurp_palmen(axes: Axes, sweeps: Sweeps | SuperpositionCheck) -> ScalarMappable:
    """Draw the loss angle δ against the magnitude of the modulus of every sweep, coloured by temperature.

    Arguments and value are those of `plot_wicket`.

    References
    ----------
    M. van Gurp, J. Palmen, Rheol. Bull. 67 (1998) 5.
    """
    return draw_diagram(axes, sweeps, "magnitude", "angle")


def plot_kramers_kronig(axes: Axes, agreement: KramersKronig) -> None:
    """Draw how far E' and E'' of a master curve are from what each demands of the other, log10, with what is allowed.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    agreement : KramersKronig
        As ``check_superposition(fit).kramers_kronig``.  Points at the ends, which are not judged, are open.
    """
    from viscofric.rheology.superposition.kramers_kronig import LARGEST_RMS

    judged = agreement.judged
    handles: list[Any] = []
    for part, other in zip(MODULI, MODULI[::-1], strict=True):
        deviation = getattr(agreement, f"{part.name}_deviation")
        label = f"{part.symbol} that {other.symbol} demands"
        look: dict[str, Any] = {"color": part.colour, "markersize": 3.5, "markeredgewidth": 0.8}
        handles += axes.plot(agreement.angular_frequency[judged], deviation[judged], part.marker, label=label, **look)
        axes.plot(agreement.angular_frequency[~judged], deviation[~judged], part.marker, fillstyle="none", **look)
    handles.append(
        axes.axhspan(-LARGEST_RMS, LARGEST_RMS, color=GREY, alpha=0.2, linewidth=0, label="allowed rms of $E'$")
    )
    axes.axhline(0.0, color=GREY, linewidth=0.8, zorder=0)
    shown = np.concatenate([agreement.storage_deviation[judged], agreement.loss_deviation[judged]])
    largest = 1.15 * max(float(np.max(np.abs(shown), initial=0.0)), 1.5 * LARGEST_RMS)
    axes.set_ylim(-largest, largest)
    axes.set_xlabel(reduced_frequency())
    axes.set_ylabel(r"$\log_{10}$ of demanded over measured")
    logarithmic(axes, "x")
    legend_above(axes, handles)
