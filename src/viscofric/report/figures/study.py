"""The figures of a study's results, each drawn from the tree of results, or None where these lack its data."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure

from viscofric.datasets import Dataset, DataTree
from viscofric.files import write_atomically
from viscofric.report.data import law_of, predicted
from viscofric.report.figures import saving
from viscofric.report.figures.contacts import contacts_figure, rough_contacts_figure, shown_contacts
from viscofric.report.figures.convergence import convergence_figure
from viscofric.report.figures.friction import (
    plot_coulomb_friction,
    plot_friction_curves,
    plot_friction_master_curve,
    plot_friction_master_curves,
)
from viscofric.report.figures.heating import heated_parts_figure, heating_figure, temperature_map_figure
from viscofric.report.figures.histories import histories_figure, impacts_figure
from viscofric.report.figures.interface import parts_figure, stress_figure
from viscofric.report.figures.maps import known_shifts, map_figure
from viscofric.report.figures.ramps import plot_temperature_ramps
from viscofric.report.figures.rubber import (
    plot_isotherms,
    plot_master_curve,
    plot_residuals,
    plot_retardation_spectrum,
    plot_step_master_curve,
)
from viscofric.report.figures.shift_factors import plot_shift_comparison, plot_shift_factors, plot_vertical_shift
from viscofric.report.figures.style import WIDE, new_figure, one_panel, temperature_bar
from viscofric.report.figures.superposition import plot_cole_cole, plot_van_gurp_palmen
from viscofric.report.figures.sweeps import sweep_figure
from viscofric.report.results import (
    group,
    is_rough,
    is_synthetic,
    nearest,
    nominal_temperatures,
    number,
    on_group,
    reference_temperature,
    rubbers,
    values,
)
from viscofric.report.sweeps import MOST_LINES, has_curves_only, predicted_axes, solved_cases, thinned


def _of(name: str, draw: Callable[..., None], *size: float) -> Callable[[DataTree], Figure | None]:
    """Return what draws a group of the results on a figure of a size, given the figure, the group and the tree."""

    @on_group(name)
    def drawn(data: Dataset, tree: DataTree) -> Figure | None:
        figure = new_figure(*size)
        draw(figure, data, tree)
        return figure

    return drawn


_PAIR = (9.0, 4.3)


def _by_temperature(*draws: Callable[..., ScalarMappable]) -> Callable[..., None]:
    """Return what draws panels beside each other with one colour bar of the temperatures."""

    def drawn(figure: Figure, sweeps: Dataset, tree: DataTree) -> None:
        panels = list(figure.subplots(1, len(draws)))
        scales = [draw(panel, sweeps) for draw, panel in zip(draws, panels, strict=True)]
        temperature_bar(figure, scales[-1], panels)

    return drawn


def _ramps(figure: Figure, ramps: Dataset, tree: DataTree) -> None:
    left, right = figure.subplots(1, 2)
    plot_temperature_ramps(left, ramps)
    plot_temperature_ramps(right, ramps, "tan delta")


def _master_curve(figure: Figure, curve: Dataset, tree: DataTree) -> None:
    spectrum = group(tree, "spectrum_curve")
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[2.6, 1.0])
    reference = reference_temperature(tree)
    band = spectrum if spectrum is not None and "storage_modulus_lower" in spectrum else None
    plot_master_curve(top, curve, spectrum, reference_temperature=reference, band=band, synthetic=is_synthetic(tree))
    plot_residuals(bottom, curve, reference_temperature=reference)
    top.set_xlabel("")


def _step_master_curve(figure: Figure, curve: Dataset, tree: DataTree) -> None:
    axes = figure.subplots()
    temperature_bar(figure, plot_step_master_curve(axes, curve, synthetic=is_synthetic(tree)), [axes])


@on_group("shift_factors")
def _vertical_shift(factors: Dataset, _: DataTree) -> Figure | None:
    return one_panel(plot_vertical_shift, factors) if "log10_vertical_shift" in factors else None


def _friction_shift_factors(figure: Figure, found: Dataset, tree: DataTree) -> None:
    # Friction may reach beyond the sweeps.
    both = found.isel(temperature=np.isfinite(values(found, "known_log10_shift_factor")))
    names = {f"known_{name}": name for name in ("log10_shift_factor", "standard_error")}
    plot_shift_comparison(figure.subplots(), found, both.drop_vars(names.values()).rename(names))


def friction_against_speed(tree: DataTree) -> Figure | None:
    """Friction at a few temperatures, beside what was measured; where nothing else varies, or friction was measured."""
    prediction, measurement = solved_cases(tree), group(tree, "measurement")
    if measurement is None and (prediction is None or not has_curves_only(tree)):
        return None
    few = None if prediction is None else _few_curves(prediction, measurement)
    return one_panel(plot_friction_curves, few, measurement, size=WIDE, synthetic=is_synthetic(tree))


@on_group("prediction")
def friction_sweep(friction: Dataset, tree: DataTree) -> Figure | None:
    """Friction over the axes of a study: where more than speed and temperature varies, or the speed does not."""
    few = {axis.name for axis in predicted_axes(tree)} <= {"speed", "temperature"}
    drawn_as_curves = has_curves_only(tree) or (few and group(tree, "measurement") is not None)
    return None if drawn_as_curves else sweep_figure(friction)


def _few_curves(prediction: Dataset, measurement: Dataset | None) -> Dataset:
    """Leave out temperatures where there are too many lines to distinguish, and loads other than the measured."""
    temperature, load = values(prediction, "temperature"), predicted(prediction).load
    nominal = nominal_temperatures(temperature)
    kept, shown = set(thinned(nominal.size, MOST_LINES)), np.ones(temperature.size, dtype=bool)
    if measurement is not None:
        shown = load == load[np.abs(load - np.nanmedian(values(measurement, "load"))).argmin()]
        if nominal.size > MOST_LINES:
            kept = set(nearest(nominal, values(measurement, "temperature")).tolist())
    return prediction.isel(case=np.flatnonzero(shown & np.isin(nearest(nominal, temperature), sorted(kept))))


@on_group("prediction")
def friction_map(friction: Dataset, tree: DataTree) -> Figure | None:
    """Friction over speed and temperature."""
    measurement = group(tree, "measurement")
    points = None if measurement is None else (values(measurement, "speed"), values(measurement, "temperature"))
    return map_figure(friction, points, known_shifts(tree))


def friction_master_curve(tree: DataTree) -> Figure | None:
    """Friction of all temperatures over the reduced speed, a line for each of several rubbers."""
    reference = reference_temperature(tree)
    found = [(name, part) for name, branch in rubbers(tree) if (part := solved_cases(branch, _MASTER)) is not None]
    if found:
        several = dict(found[:MOST_LINES])
        return one_panel(plot_friction_master_curves, several, size=WIDE, reference_temperature=reference)
    prediction = solved_cases(tree, _MASTER)
    measured = group(tree, "measurement_master")
    measured = group(tree, "measurement") if measured is None else measured
    if group(tree, _MASTER) is None or (prediction is None and measured is None):
        return None
    about: dict[str, Any] = {"reference_temperature": reference, "synthetic": is_synthetic(tree)}
    return one_panel(plot_friction_master_curve, prediction, measured, size=WIDE, **about)


_MASTER = "prediction_master"


@on_group("measurement")
def coulomb_friction(measurement: Dataset, tree: DataTree) -> Figure | None:
    """Measured Coulomb friction."""
    if not np.isfinite(values(measurement, "coulomb")).any():
        return None
    return one_panel(plot_coulomb_friction, measurement, size=(7.4, 4.0), synthetic=is_synthetic(tree))


def contacts(tree: DataTree) -> Figure | None:
    """Pressure of the slowest contact, of that with the most friction and of the fastest."""
    shown = shown_contacts(tree)
    if not shown:
        return None
    return rough_contacts_figure(shown) if is_rough(tree) else contacts_figure(shown)


def convergence(tree: DataTree) -> Figure | None:
    """Errors and grids of the requested cases."""
    cases = solved_cases(tree)
    return None if cases is None else convergence_figure(cases, accuracy=number(tree.attrs, "accuracy"))


#: Name of the files -> what draws the figure, or gives None if the results lack it: of friction …
FRICTION_FIGURES: dict[str, Callable[[DataTree], Figure | None]] = {
    "friction_against_speed": friction_against_speed,
    "friction_sweep": friction_sweep,
    "friction_map": friction_map,
    "friction_master_curve": friction_master_curve,
    "coulomb_friction": coulomb_friction,
    "shear_stress": stress_figure,
    "friction_parts": parts_figure,
    "heated_friction": heating_figure,
    "heated_parts": heated_parts_figure,
    "temperature_map": temperature_map_figure,
    "friction_shift_factors": _of("friction_shift_factors", _friction_shift_factors),
    "contacts_over_time": histories_figure,
    "impacts": impacts_figure,
    "contacts": contacts,
    "convergence": convergence,
}
#: … and of the rubber, or of each of several.
RUBBER_FIGURES: dict[str, Callable[[DataTree], Figure | None]] = {
    "master_curve": _of("master_curve", _master_curve, 6.2, 5.6),
    "step_master_curve": _of("step_master_curve", _step_master_curve),
    "spectrum": _of("spectrum", lambda figure, modes, _: plot_retardation_spectrum(figure.subplots(), modes)),
    "shift_factors": _of(
        "shift_factors",
        lambda figure, found, tree: plot_shift_factors(figure.subplots(), found, law_of(group(tree, "shift_law"))),
    ),
    "vertical_shift": _vertical_shift,
    "superposition": _of("isotherms", _by_temperature(plot_van_gurp_palmen, plot_cole_cole), *_PAIR),
    "isotherms": _of("isotherms", _by_temperature(plot_isotherms, partial(plot_isotherms, modulus="loss")), *_PAIR),
    "ramps": _of("ramps", _ramps, *_PAIR),
}


def figure_images(tree: DataTree, formats: tuple[str, ...] = ("png", "svg")) -> dict[str, dict[str, bytes]]:
    """Draw every figure that the results afford: name -> format -> bytes, those of a second rubber with ``_2``."""
    images = _drawn(FRICTION_FIGURES, tree, formats) | _drawn(RUBBER_FIGURES, tree, formats)
    for place, (_, branch) in enumerate(rubbers(tree), 1):
        images |= {f"{name}_{place}": image for name, image in _drawn(RUBBER_FIGURES, branch, formats).items()}
    return images


def _drawn(
    figures: dict[str, Callable[[DataTree], Figure | None]], tree: DataTree, formats: tuple[str, ...]
) -> dict[str, dict[str, bytes]]:
    found = {
        name: saving.images(partial(draw, tree), formats, name=name, synthetic=is_synthetic(tree))
        for name, draw in figures.items()
    }
    return {name: image for name, image in found.items() if image}


def draw_figures(tree: DataTree, folder: str | Path) -> list[Path]:
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
