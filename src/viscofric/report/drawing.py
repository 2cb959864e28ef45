"""Which figures a study's results afford, and their files: PNG and SVG, the same bytes every time."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
import numpy as np

from viscofric.files import write_atomically
from viscofric.report.consistency_figures import plot_cole_cole, plot_van_gurp_palmen
from viscofric.report.figure_data import law_of, vertical_shift_of
from viscofric.report.friction_drawing import (
    contacts,
    convergence,
    coulomb_friction,
    friction_against_speed,
    friction_map,
    friction_master_curve,
    friction_sweep,
    recovery_trail,
)
from viscofric.report.house_style import STYLE, mark_synthetic, new_figure, temperature_bar
from viscofric.report.inverse_figures import plot_shift_comparison
from viscofric.report.results import group, is_synthetic, reference_temperature, rubbers, values
from viscofric.report.rubber_figures import plot_isotherms, plot_master_curve, plot_residuals
from viscofric.report.shift_figures import plot_shift_factors, plot_vertical_shift
from viscofric.report.spectrum_figures import plot_retardation_spectrum

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
    temperature_bar(figure, plot_isotherms(right, sweeps, "loss"), [left, right])
    return figure


def _superposition(tree: xr.DataTree) -> Figure | None:
    sweeps = group(tree, "isotherms")
    if sweeps is None:
        return None
    figure = new_figure(9.0, 4.3)
    left, right = figure.subplots(1, 2)
    plot_van_gurp_palmen(left, sweeps)
    temperature_bar(figure, plot_cole_cole(right, sweeps), [left, right])
    return figure


def _master_curve(tree: xr.DataTree) -> Figure | None:
    curve, spectrum = group(tree, "master_curve"), group(tree, "spectrum_curve")
    if curve is None:
        return None
    figure = new_figure(6.2, 5.6)
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[2.6, 1.0])
    reference = reference_temperature(tree)
    band = spectrum if spectrum is not None and "storage_modulus_lower" in spectrum else None
    plot_master_curve(top, curve, spectrum, reference_temperature=reference, band=band)
    plot_residuals(bottom, curve, reference_temperature=reference)
    top.set_xlabel("")
    return figure


def _shift_factors(tree: xr.DataTree) -> Figure | None:
    factors = group(tree, "shift_factors")
    if factors is None:
        return None
    figure = new_figure()
    plot_shift_factors(figure.subplots(), factors, law_of(group(tree, "shift_law")))
    return figure


def _vertical_shift(tree: xr.DataTree) -> Figure | None:
    factors = group(tree, "shift_factors")
    shift = vertical_shift_of(factors)
    if factors is None or shift is None:
        return None
    figure = new_figure()
    plot_vertical_shift(figure.subplots(), shift, values(factors, "temperature"))
    return figure


def _spectrum(tree: xr.DataTree) -> Figure | None:
    spectrum = group(tree, "spectrum")
    if spectrum is None:
        return None
    figure = new_figure()
    plot_retardation_spectrum(figure.subplots(), spectrum)
    return figure


def _friction_shift_factors(tree: xr.DataTree) -> Figure | None:
    found = group(tree, "friction_shift_factors")
    if found is None:
        return None
    # Friction may reach beyond the sweeps.
    both = found.isel(temperature=np.isfinite(values(found, "known_log10_shift_factor")))
    names = {f"known_{name}": name for name in ("log10_shift_factor", "standard_error")}
    figure = new_figure()
    plot_shift_comparison(figure.subplots(), found, both.drop_vars(names.values()).rename(names))
    return figure


#: Name of the files -> what draws the figure, or gives None if the results lack it: of friction …
FRICTION_FIGURES: dict[str, Callable[[xr.DataTree], Figure | None]] = {
    "friction_against_speed": friction_against_speed,
    "friction_sweep": friction_sweep,
    "friction_map": friction_map,
    "friction_master_curve": friction_master_curve,
    "coulomb_friction": coulomb_friction,
    "friction_shift_factors": _friction_shift_factors,
    "contacts": contacts,
    "recovery_trail": recovery_trail,
    "convergence": convergence,
}
#: … and of the rubber, or of each of several.
RUBBER_FIGURES: dict[str, Callable[[xr.DataTree], Figure | None]] = {
    "master_curve": _master_curve,
    "spectrum": _spectrum,
    "shift_factors": _shift_factors,
    "vertical_shift": _vertical_shift,
    "superposition": _superposition,
    "isotherms": _isotherms,
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
        Name of the figure -> format -> bytes; the same bytes for the same results.  Figures of the second of several
        rubbers end in ``_2``, and so on.
    """
    images = _drawn(FRICTION_FIGURES, tree, formats) | _drawn(RUBBER_FIGURES, tree, formats)
    for place, (_, branch) in enumerate(rubbers(tree), 1):
        images |= {f"{name}_{place}": image for name, image in _drawn(RUBBER_FIGURES, branch, formats).items()}
    return images


def _drawn(
    figures: dict[str, Callable[[xr.DataTree], Figure | None]], tree: xr.DataTree, formats: tuple[str, ...]
) -> dict[str, dict[str, bytes]]:
    images: dict[str, dict[str, bytes]] = {}
    for name, draw in figures.items():
        with matplotlib.rc_context({**STYLE, "svg.hashsalt": f"viscofric {name}"}):
            figure = draw(tree)
            if figure is None:
                continue
            if is_synthetic(tree):
                mark_synthetic([axes for axes in figure.axes if axes.get_label() != "<colorbar>"])
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
        One for each figure, with ``.png`` and ``.svg``; without those that the results lack.

    Raises
    ------
    DataFileError
        If the folder or a file cannot be written.
    """
    return save_images(figure_images(tree), Path(folder))


def save_images(images: dict[str, dict[str, bytes]], folder: Path) -> list[Path]:
    """Write what `figure_images` returned into a folder; see `draw_figures`."""
    written = []
    for name, forms in images.items():
        for form, content in forms.items():
            path = folder / f"{name}.{form}"
            write_atomically(path, content)
            written.append(path)
    return written
