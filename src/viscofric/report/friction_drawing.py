"""Whole figures of friction and of its contacts, each from a study's results, or None where these lack it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.report.between_temperatures import known_shifts
from viscofric.report.contacts import shown_contacts, trails
from viscofric.report.convergence_figures import convergence_figure
from viscofric.report.field_figures import contacts_figure, trail_figure
from viscofric.report.friction_figures import (
    plot_coulomb_friction,
    plot_friction_curves,
    plot_friction_master_curve,
    plot_friction_master_curves,
)
from viscofric.report.house_style import new_figure
from viscofric.report.map_figures import map_figure
from viscofric.report.results import (
    group,
    is_rough,
    nearest,
    nominal_temperatures,
    number,
    reference_temperature,
    rubbers,
    values,
)
from viscofric.report.rough_contacts import rough_contacts_figure
from viscofric.report.sweep_figures import sweep_figure
from viscofric.report.sweeps import MOST_LINES, SAMPLE, labelled, solved_cases, sweep_axes, thinned

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def friction_against_speed(tree: xr.DataTree) -> Figure | None:
    """Friction at a few temperatures, beside what was measured; where nothing else varies, or friction was measured."""
    prediction, measurement = solved_cases(tree), group(tree, "measurement")
    if measurement is None and (prediction is None or not _is_plain(tree)):
        return None
    figure = new_figure(7.4, 4.3)
    few = None if prediction is None else _few_curves(prediction, measurement)
    plot_friction_curves(figure.subplots(), few, measurement)
    return figure


def friction_sweep(tree: xr.DataTree) -> Figure | None:
    """Friction over the axes of a study: where more than speed and temperature varies, or the speed does not."""
    friction = labelled(tree)
    told = group(tree, "measurement") is not None and varied(tree) <= _CURVES
    return None if friction is None or told or _is_plain(tree) else sweep_figure(friction)


def _is_plain(tree: xr.DataTree) -> bool:
    """Whether curves over the speed, one for each temperature, are all there is."""
    names, friction = varied(tree), labelled(tree)
    return "speed" in names and names <= _CURVES and friction is not None and SAMPLE not in friction.dims


def varied(tree: xr.DataTree) -> set[str]:
    """Return the names of the axes along which friction was predicted at more than one point."""
    friction = labelled(tree)
    return set() if friction is None else {axis.name for axis in sweep_axes(friction)}


_CURVES = {"speed", "temperature"}


def _few_curves(prediction: xr.Dataset, measurement: xr.Dataset | None) -> xr.Dataset:
    """Leave out temperatures where there are more lines than can be told apart, and loads other than the measured."""
    temperature, load = (values(prediction, name) for name in ("temperature", "load"))
    nominal = nominal_temperatures(temperature)
    kept, shown = set(thinned(nominal.size, MOST_LINES)), np.ones(temperature.size, dtype=bool)
    if measurement is not None:
        shown = load == load[np.abs(load - np.nanmedian(values(measurement, "load"))).argmin()]
        if nominal.size > MOST_LINES:
            kept = set(nearest(nominal, values(measurement, "temperature")).tolist())
    return prediction.isel(case=np.flatnonzero(shown & np.isin(nearest(nominal, temperature), sorted(kept))))


def friction_map(tree: xr.DataTree) -> Figure | None:
    """Friction over speed and temperature."""
    friction, measurement = labelled(tree), group(tree, "measurement")
    points = None if measurement is None else (values(measurement, "speed"), values(measurement, "temperature"))
    return None if friction is None else map_figure(friction, points, known_shifts(tree))


def friction_master_curve(tree: xr.DataTree) -> Figure | None:
    """Friction of all temperatures over the reduced speed, a line for each of several rubbers."""
    reference = reference_temperature(tree)
    found = [(name, part) for name, branch in rubbers(tree) if (part := solved_cases(branch, _MASTER)) is not None]
    if found:
        figure = new_figure(7.4, 4.3)
        plot_friction_master_curves(figure.subplots(), dict(found[:MOST_LINES]), reference_temperature=reference)
        return figure
    prediction = solved_cases(tree, _MASTER)
    measured = group(tree, "measurement_master")
    measured = group(tree, "measurement") if measured is None else measured
    if group(tree, _MASTER) is None or (prediction is None and measured is None):
        return None
    figure = new_figure(7.4, 4.3)
    plot_friction_master_curve(figure.subplots(), prediction, measured, reference_temperature=reference)
    return figure


_MASTER = "prediction_master"


def coulomb_friction(tree: xr.DataTree) -> Figure | None:
    """Measured Coulomb friction."""
    measurement = group(tree, "measurement")
    if measurement is None or not np.isfinite(values(measurement, "coulomb")).any():
        return None
    figure = new_figure(7.4, 4.0)
    plot_coulomb_friction(figure.subplots(), measurement)
    return figure


def contacts(tree: xr.DataTree) -> Figure | None:
    """Pressure of the slowest contact, of that with the most friction and of the fastest."""
    shown = shown_contacts(tree)
    if not shown:
        return None
    each = [contact for contact, _ in shown]
    if is_rough(tree):
        return rough_contacts_figure(each, [float(told.get("direction", 0.0)) for _, told in shown])
    return contacts_figure(each)


def recovery_trail(tree: xr.DataTree) -> Figure | None:
    """Draw the surface behind those contacts; a rough surface has no behind."""
    shown = [] if is_rough(tree) else shown_contacts(tree)
    found = trails(tree, shown)
    return trail_figure([contact for contact, _ in shown], found) if found and len(found) == len(shown) else None


def convergence(tree: xr.DataTree) -> Figure | None:
    """Errors and grids of the cases asked for."""
    cases = solved_cases(tree)
    return None if cases is None else convergence_figure(cases, accuracy=number(tree.attrs, "accuracy"))
