"""Whole pictures of friction for a file: what was separated, what was shifted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.report.friction_figures import plot_coulomb_friction, plot_friction_curves
from viscofric.report.house_style import new_figure
from viscofric.report.pictures import save_picture

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

    from viscofric.friction.curves import FrictionCurves

_WIDTH, _HEIGHT = 7.4, 4.0


def friction_figure(curves: FrictionCurves) -> Figure:
    """Return a figure of measured viscoelastic friction, and of Coulomb friction where there is any below it.

    Parameters
    ----------
    curves : FrictionCurves
    """
    if curves.coulomb is None:
        figure = new_figure(_WIDTH, _HEIGHT)
        plot_friction_curves(figure.subplots(), measurement=curves)
        return figure
    figure = new_figure(_WIDTH, 1.8 * _HEIGHT)
    top, bottom = figure.subplots(2, 1, sharex=True)
    plot_friction_curves(top, measurement=curves)
    plot_coulomb_friction(bottom, curves)
    top.set_xlabel("")
    return figure


def draw_friction(path: Path, curves: FrictionCurves, *, synthetic: bool = False) -> None:
    """Draw measured friction into a file.

    Parameters
    ----------
    path : Path
        Ends in ``.png``, ``.svg`` or ``.pdf``.  Replaced if it exists.
    curves : FrictionCurves
    synthetic : bool
        Whether it was made, not measured, which the figure then says.

    Raises
    ------
    DataFileError
        If the file cannot be written.
    """
    save_picture(path, lambda: friction_figure(curves), name="friction", synthetic=synthetic)
