"""Figures of friction drawn from friction curves, and their bands: the numbers on the axes are those given."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.container import ErrorbarContainer

import viscofric as vf
from refusals import refused
from viscofric import report
from viscofric.datasets import dataset

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

ZERO = 273.15
SPEEDS = np.geomspace(0.02, 0.2, 6)
KELVIN = np.array([30.0, 60.0]) + ZERO


def curves(coulomb: bool = True) -> vf.FrictionCurves:
    """Return friction of a formula at two temperatures."""
    temperature, speed = (grid.ravel() for grid in np.meshgrid(KELVIN, SPEEDS, indexing="ij"))
    friction = 0.01 + 1e-4 * (temperature - ZERO) - 0.002 * np.log10(speed)
    found = vf.FrictionCurves(
        speed=speed,
        temperature=temperature,
        load=np.full(speed.shape, 25.0),
        viscoelastic=friction,
        viscoelastic_error=0.01 * friction,
        viscoelastic_scatter=0.03 * friction,
        replicates=np.full(speed.shape, 8),
    )
    if not coulomb:
        return found
    level = 0.04 + 0.001 * np.log10(speed)
    return replace(found, coulomb=level, coulomb_error=0.01 * level, coulomb_scatter=0.02 * level)


def with_band(found: vf.FrictionCurves) -> vf.FrictionCurves:
    return replace(found, viscoelastic_lower=0.9 * found.viscoelastic, viscoelastic_upper=1.2 * found.viscoelastic)


def bars(axes: Axes) -> list[ErrorbarContainer]:
    return [container for container in axes.containers if isinstance(container, ErrorbarContainer)]


def bands(axes: Axes) -> list[PolyCollection]:
    return [found for found in axes.collections if isinstance(found, PolyCollection)]


def ends(band: PolyCollection) -> np.ndarray:
    """Corners of a band, without repeats, lowest first at each place."""
    corners = np.unique(np.round(band.get_paths()[0].vertices, 12), axis=0)
    return corners[np.lexsort((corners[:, 1], corners[:, 0]))]


def legend_of(axes: Axes) -> tuple[str, list[str]]:
    legend = axes.get_legend()
    assert legend is not None
    return legend.get_title().get_text(), [text.get_text() for text in legend.get_texts()]


def test_friction_of_a_surface_under_a_mean_pressure_is_drawn(axes: Axes) -> None:
    found = curves()  # as of a study: without a load
    given = {"speed": found.speed, "temperature": found.temperature, "friction_coefficient": found.viscoelastic}
    report.plot_friction_curves(axes, dataset("case", {name: (one, "", name) for name, one in given.items()}))
    for kelvin, line in zip(KELVIN, axes.lines, strict=True):
        np.testing.assert_array_equal(line.get_ydata(), found.at_temperature(kelvin).viscoelastic)


def test_measured_curves_are_drawn_without_any_prediction(axes: Axes) -> None:
    found = curves()
    report.plot_friction_curves(axes, measurement=found)
    assert legend_of(axes) == ("points: measured ± scatter", ["60 °C", "30 °C"])
    for kelvin, points in zip(KELVIN, bars(axes), strict=True):
        here = found.at_temperature(kelvin)
        np.testing.assert_allclose(points.lines[0].get_xdata(), 1e3 * here.speed)
        np.testing.assert_allclose(points.lines[0].get_ydata(), here.viscoelastic)
        (segments,) = points.lines[2]
        heights = [np.ptp(segment[:, 1]) for segment in segments.get_segments()]
        np.testing.assert_allclose(heights, 2.0 * here.viscoelastic_scatter)


def test_band_of_each_temperature_is_that_of_the_prediction(axes: Axes) -> None:
    found = with_band(curves(coulomb=False))
    report.plot_friction_curves(axes, found, found)
    assert legend_of(axes)[0].endswith("lines: predicted, 95 % bands")
    assert len(bands(axes)) == 2
    for kelvin, band in zip(KELVIN, bands(axes), strict=True):
        friction = found.at_temperature(kelvin).viscoelastic
        limits = ends(band)[:, 1].reshape(-1, 2)
        np.testing.assert_allclose(limits, np.stack([0.9 * friction, 1.2 * friction], axis=1), rtol=1e-9)


def test_lines_and_bands_are_faint_at_frequencies_that_were_not_measured(axes: Axes) -> None:
    banded = with_band(curves(coulomb=False)).at_temperature(KELVIN[0])
    found = replace(banded, within_measured_frequencies=np.array([1.0, 1.0, 1.0, 1.0, 0.0, 0.0]))
    report.plot_friction_curves(axes, found)
    assert legend_of(axes)[0].endswith("thin: frequencies not measured")
    faint, full = (line for line in axes.lines if len(line.get_xdata()))
    assert faint.get_linewidth() < full.get_linewidth()
    np.testing.assert_array_equal(np.isfinite(full.get_ydata()), found.within_measured_frequencies == 1.0)
    right = sorted(band.get_paths()[0].vertices[:, 0].max() for band in bands(axes))
    np.testing.assert_allclose(right, 1e3 * found.speed[[3, 5]])


def test_bands_of_results_are_drawn_and_those_without_are_not(axes: Axes, tree: xr.DataTree) -> None:
    prediction = tree["prediction_master"].to_dataset()
    report.plot_friction_master_curve(axes, prediction)
    assert bands(axes) == []
    friction = prediction["friction_coefficient"]
    banded = prediction.assign(friction_lower=0.9 * friction, friction_upper=1.1 * friction)
    report.plot_friction_master_curve(axes, banded)
    (band,) = bands(axes)
    np.testing.assert_allclose(ends(band)[0::2, 1], 0.9 * friction.values, rtol=1e-9)
    assert legend_of(axes)[1] == ["predicted", "its 95 % band"]


def test_coulomb_friction_is_drawn_with_its_own_scatter(axes: Axes) -> None:
    found = curves()
    report.plot_coulomb_friction(axes, found)
    assert "Coulomb" in axes.get_ylabel()
    assert found.coulomb is not None
    drawn = np.concatenate([points.lines[0].get_ydata() for points in bars(axes)])
    np.testing.assert_allclose(drawn, found.coulomb)
    assert axes.get_ylim()[0] == 0.0


def test_coulomb_friction_that_was_not_measured_is_refused(axes: Axes) -> None:
    with refused("no-coulomb"):
        report.plot_coulomb_friction(axes, curves(coulomb=False))


def test_nothing_to_draw_is_reported(axes: Axes) -> None:
    for plot in (report.plot_friction_curves, report.plot_friction_master_curve):
        with refused("nothing-to-draw"):
            plot(axes)


def test_points_of_unknown_scatter_have_no_bars(axes: Axes) -> None:
    found = replace(curves(), viscoelastic_scatter=np.full(12, np.inf))
    report.plot_friction_curves(axes, measurement=found)
    for points in bars(axes):
        (segments,) = points.lines[2]
        assert all(np.ptp(segment[:, 1]) == 0.0 for segment in segments.get_segments())
    assert np.all(np.isfinite(axes.get_ylim()))


def test_smooth_line_of_a_master_curve_bridges_no_gap(axes: Axes) -> None:
    # α moves the warm curve by two decades, so that one decade lies between the two.
    shift = vf.ShiftFactors(KELVIN, np.array([0.0, -2.0]), KELVIN[0])
    master = vf.shift_friction(curves(), shift=shift)
    assert len(master.stretches) == 2
    report.plot_friction_master_curve(axes, measurement=master)
    (smooth,) = [line for line in axes.lines if len(np.asarray(line.get_xdata())) > 100]
    speed, friction = (np.asarray(part, dtype=float) for part in smooth.get_data())
    for low, high in master.stretches:
        inside = (speed >= 1e3 * low) & (speed <= 1e3 * high) & np.isfinite(friction)
        np.testing.assert_allclose(friction[inside], master(1e-3 * speed[inside]), rtol=1e-12)
    assert np.isnan(friction).sum() == 1
    assert "at 30 °C" in axes.get_xlabel()
    assert legend_of(axes)[1] == ["smoothed", "its 95 % band", "60 °C", "30 °C"]


def shift_factors(noise: float = 0.0) -> vf.ShiftFactors:
    kelvin = np.array([30.0, 40.0, 52.0, 68.0, 90.0]) + ZERO
    law = vf.WLF(C1=10.04, C2=89.6, reference="30 degC")
    errors = np.array([0.0, 0.02, 0.03, 0.05, 0.08])
    return vf.ShiftFactors(kelvin, law.log10(kelvin) + noise * errors, "30 degC", np.diag(errors**2))


def test_shift_factors_of_friction_stand_beside_those_of_the_modulus(axes: Axes) -> None:
    found, known = shift_factors(noise=1.0), shift_factors()
    report.plot_shift_comparison(axes, found, known)
    assert (axes.get_xscale(), axes.get_yscale()) == ("linear", "log")
    drawn = {str(points.get_label()): points for points in bars(axes)}
    for label, factors in (("from friction", found), ("of the modulus", known)):
        (points,) = [one for name, one in drawn.items() if name.startswith(label)]
        np.testing.assert_allclose(np.log10(points.lines[0].get_ydata()), factors.log10_values, atol=1e-12)
        (segments,) = points.lines[2]
        lengths = [np.ptp(np.log10(segment[:, 1])) for segment in segments.get_segments()]
        np.testing.assert_allclose(lengths, 2.0 * factors.standard_errors, atol=1e-12)


def test_a_modulus_with_another_reference_is_brought_to_that_of_friction(axes: Axes) -> None:
    found = shift_factors()
    report.plot_shift_comparison(axes, found, vf.WLF(C1=10.04, C2=89.6, reference="30 degC").at_reference("60 degC"))
    (line,) = [line for line in axes.lines if "WLF" in str(line.get_label())]
    np.testing.assert_allclose(np.asarray(line.get_ydata())[[0, -1]], 10.0 ** found.log10_values[[0, -1]], rtol=1e-9)


def test_results_of_another_reference_are_not_drawn_together(axes: Axes, tree: xr.DataTree) -> None:
    warm = shift_factors().at_reference("40 degC")
    with refused("other-reference"):
        report.plot_shift_comparison(axes, warm, tree["shift_factors"].to_dataset())
