"""Whole pictures of friction for a file: what was separated, what was shifted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.report.friction_figures import (
    plot_coulomb_friction,
    plot_friction_curves,
    plot_friction_master_curve,
)
from viscofric.report.house_style import new_figure
from viscofric.report.inverse_figures import plot_identified_modulus, plot_shift_comparison
from viscofric.report.pictures import save_picture
from viscofric.report.shift_figures import plot_shift_factors

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.identification.result import IdentifiedMaterial
    from viscofric.friction.shifting.master_curve import FrictionMasterCurve
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.shift_law import ShiftLaw

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


def draw_predicted(path: Path, curves: FrictionCurves, *, synthetic: bool = False) -> None:
    """Draw predicted friction against speed into a file, with its bands where it has any; see `draw_friction`."""

    def figure() -> Figure:
        whole = new_figure(_WIDTH, _HEIGHT)
        plot_friction_curves(whole.subplots(), curves)
        return whole

    save_picture(path, figure, name="friction", synthetic=synthetic)


def shifted_figure(master: FrictionMasterCurve, known: ShiftLaw | None = None) -> Figure:
    """Return a figure of a friction master curve, and of its shift factors below it where they were found from it.

    Parameters
    ----------
    master : FrictionMasterCurve
    known : ShiftLaw, optional
        Shift factors of the modulus, to lay beside.
    """
    if not master.found:
        figure = new_figure(_WIDTH, _HEIGHT)
        plot_friction_master_curve(figure.subplots(), measurement=master)
        return figure
    figure = new_figure(_WIDTH, 2.0 * _HEIGHT)
    top, bottom = figure.subplots(2, 1)
    plot_friction_master_curve(top, measurement=master)
    if known is None:
        plot_shift_factors(bottom, master.shift_factors)
    else:
        plot_shift_comparison(bottom, master.shift_factors, known)
    return figure


def draw_shifted(
    path: Path, master: FrictionMasterCurve, known: ShiftLaw | None = None, *, synthetic: bool = False
) -> None:
    """Draw a friction master curve and its shift factors into a file; see `shifted_figure` and `draw_friction`."""
    save_picture(path, lambda: shifted_figure(master, known), name="friction master curve", synthetic=synthetic)


def draw_identified(
    path: Path, found: IdentifiedMaterial, known: Material | None = None, *, synthetic: bool = False
) -> None:
    """Draw the modulus of a rubber identified from friction into a file; see `draw_friction`.

    `known` is laid beside, at the temperature at which the other is described.
    """
    if known is not None and known.shift is not None and found.material.reference is not None:
        known = known.at_reference(found.material.reference)

    def draw() -> Figure:
        figure = new_figure()
        plot_identified_modulus(figure.subplots(), found, known)
        return figure

    save_picture(path, draw, name="identified modulus", synthetic=synthetic)
