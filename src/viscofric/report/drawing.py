"""Which figures a study's results afford, and their files: PNG and SVG, the same bytes every time."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib

from viscofric.report.friction_figures import plot_friction_curves, plot_friction_master_curve
from viscofric.report.house_style import STYLE, mark_synthetic, new_figure
from viscofric.report.results import group, is_synthetic, reference_temperature
from viscofric.report.rubber_figures import plot_isotherms, plot_master_curve, plot_shift_factors
from viscofric.study.store import write_atomically

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from matplotlib.figure import Figure

_DOTS_PER_INCH = 180


def _isotherms(tree: xr.DataTree) -> Figure | None:
    sweeps = group(tree, "isotherms")
    if sweeps is None:
        return None
    figure = new_figure(9.0, 4.3)
    left, right = figure.subplots(1, 2)
    plot_isotherms(left, sweeps, "storage")
    scale = plot_isotherms(right, sweeps, "loss")
    bar = figure.colorbar(scale, ax=[left, right], label="temperature (°C)", pad=0.015, aspect=30)
    bar.ax.tick_params(top=False, bottom=False, left=False)
    return figure


def _master_curve(tree: xr.DataTree) -> Figure | None:
    curve = group(tree, "master_curve")
    if curve is None:
        return None
    figure = new_figure()
    plot_master_curve(
        figure.subplots(),
        curve,
        group(tree, "spectrum_curve"),
        reference_temperature=reference_temperature(tree),
    )
    return figure


def _shift_factors(tree: xr.DataTree) -> Figure | None:
    factors = group(tree, "shift_factors")
    if factors is None:
        return None
    figure = new_figure()
    plot_shift_factors(figure.subplots(), factors)
    return figure


def _friction_against_speed(tree: xr.DataTree) -> Figure | None:
    prediction = group(tree, "prediction")
    if prediction is None:
        return None
    figure = new_figure(7.4, 4.3)
    plot_friction_curves(figure.subplots(), prediction, group(tree, "measurement"))
    return figure


def _friction_master_curve(tree: xr.DataTree) -> Figure | None:
    prediction = group(tree, "prediction_master")
    if prediction is None:
        return None
    figure = new_figure(7.4, 4.3)
    plot_friction_master_curve(
        figure.subplots(),
        prediction,
        group(tree, "measurement"),
        reference_temperature=reference_temperature(tree),
    )
    return figure


#: Name of the files -> what draws the figure, or gives None if the results lack it.
FIGURES: dict[str, Callable[[xr.DataTree], Figure | None]] = {
    "isotherms": _isotherms,
    "shift_factors": _shift_factors,
    "master_curve": _master_curve,
    "friction_against_speed": _friction_against_speed,
    "friction_master_curve": _friction_master_curve,
}


def figure_images(tree: xr.DataTree, formats: tuple[str, ...] = ("png", "svg")) -> dict[str, dict[str, bytes]]:
    """Draw every figure that the results afford and return it as the content of image files.

    Parameters
    ----------
    tree : xarray.DataTree
        Results of a study.
    formats : tuple of {"png", "svg"}

    Returns
    -------
    dict
        Name of the figure -> format -> bytes; the same bytes for the same results.
    """
    images: dict[str, dict[str, bytes]] = {}
    for name, draw in FIGURES.items():
        with matplotlib.rc_context({**STYLE, "svg.hashsalt": f"viscofric {name}"}):
            figure = draw(tree)
            if figure is None:
                continue
            if is_synthetic(tree):
                panels = [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
                mark_synthetic(panels[-1])
            images[name] = {form: _image(figure, form) for form in formats}
    return images


def _image(figure: Figure, form: str) -> bytes:
    target = io.BytesIO()
    undated = {"Software": "viscofric"} if form == "png" else {"Creator": "viscofric", "Date": None}
    figure.savefig(target, format=form, dpi=_DOTS_PER_INCH, metadata=undated)
    return target.getvalue()


def draw_figures(tree: xr.DataTree, folder: str | Path) -> list[Path]:
    """Draw every figure that a study's results afford, as PNG and SVG.

    Parameters
    ----------
    tree : xarray.DataTree
        Results of a study.
    folder : str or Path
        Where the files go; made if need be.  Files of the same names are replaced.

    Returns
    -------
    list of Path
        ``isotherms``, ``shift_factors``, ``master_curve``, ``friction_against_speed`` and
        ``friction_master_curve``, each with ``.png`` and ``.svg``; without those that the results lack.

    Raises
    ------
    DataFileError
        If the folder or a file cannot be written.
    """
    folder = Path(folder)
    written = []
    for name, images in figure_images(tree).items():
        for form, content in images.items():
            path = folder / f"{name}.{form}"
            write_atomically(path, content)
            written.append(path)
    return written
