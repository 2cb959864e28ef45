"""The figures show the results' own numbers, on the axes and in the units of the paper."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from matplotlib.container import ErrorbarContainer

from viscofric import report
from viscofric.report.data import law_of
from viscofric.report.figures import style
from viscofric.report.sweeps import cases_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from matplotlib.axes import Axes

ZERO = 273.15


def group(tree: xr.DataTree, name: str) -> xr.Dataset:
    return tree[name].to_dataset()


def error_bars(axes: Axes) -> list[ErrorbarContainer]:
    return [container for container in axes.containers if isinstance(container, ErrorbarContainer)]


def ends_of_bars(container: ErrorbarContainer) -> np.ndarray:
    (bars,) = container.lines[2]
    return np.array([segment[:, 1] for segment in bars.get_segments()])


def labels_of_ticks(axes: Axes) -> list[str]:
    axes.figure.canvas.draw()
    low, high = axes.get_xlim()
    return [
        tick.get_text()
        for tick, place in zip(axes.get_xticklabels(), axes.get_xticks(), strict=True)
        if low <= place <= high and tick.get_text()
    ]


def legend_texts(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


def test_shift_factors_fall_on_a_log_axis_with_their_errors(axes: Axes, tree: xr.DataTree) -> None:
    factors = group(tree, "shift_factors")
    report.plot_shift_factors(axes, factors)
    assert (axes.get_xscale(), axes.get_yscale()) == ("linear", "log")
    assert axes.get_xlabel() == "temperature (°C)"
    assert "shift factor" in axes.get_ylabel()
    (measured,) = error_bars(axes)
    log10, error = factors["log10_shift_factor"].values, factors["standard_error"].values
    np.testing.assert_allclose(measured.lines[0].get_xdata(), factors["temperature"].values - ZERO)
    np.testing.assert_allclose(measured.lines[0].get_ydata(), 10.0**log10)
    expected = 10.0 ** np.stack([log10 - error, log10 + error], axis=1)
    np.testing.assert_allclose(ends_of_bars(measured), expected, rtol=1e-9)


def test_wlf_line_is_the_law_of_the_results(axes: Axes, tree: xr.DataTree) -> None:
    report.plot_shift_factors(axes, group(tree, "shift_factors"), law_of(group(tree, "shift_law")))
    (line,) = [line for line in axes.lines if str(line.get_label()).startswith("WLF")]
    above = np.asarray(line.get_xdata()) - 30.0
    np.testing.assert_allclose(np.log10(line.get_ydata()), -10.04 * above / (89.6 + above), atol=1e-9)


def test_master_curve_shows_readings_and_spectrum(axes: Axes, tree: xr.DataTree) -> None:
    curve, fit = group(tree, "master_curve"), group(tree, "spectrum_curve")
    report.plot_master_curve(axes, curve, fit, reference_temperature=303.15)
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert "(rad/s) at 30 °C" in axes.get_xlabel()
    assert axes.get_ylabel() == "modulus (MPa)"
    shown = {str(line.get_label()): line for line in axes.lines}
    assert list(shown) == ["$E'$ measured", "$E'$ fitted", "$E''$ measured", "$E''$ fitted"]
    for symbol, name in (("$E'$", "storage_modulus"), ("$E''$", "loss_modulus")):
        measured, fitted = shown[f"{symbol} measured"], shown[f"{symbol} fitted"]
        np.testing.assert_allclose(measured.get_xdata(), curve["angular_frequency"].values)
        np.testing.assert_allclose(measured.get_ydata(), curve[name].values / 1e6)
        np.testing.assert_allclose(fitted.get_xdata(), fit["angular_frequency"].values)
        np.testing.assert_allclose(fitted.get_ydata(), fit[name].values / 1e6)


def test_master_curve_alone_draws_the_fit_at_its_own_frequencies(axes: Axes, tree: xr.DataTree) -> None:
    curve = group(tree, "master_curve").isel(reading=slice(None, None, -1))
    report.plot_master_curve(axes, curve)
    fitted = axes.lines[1]
    assert np.all(np.diff(np.asarray(fitted.get_xdata())) >= 0)
    np.testing.assert_allclose(fitted.get_ydata(), curve["fitted_storage_modulus"].values[::-1] / 1e6)


def test_friction_curves_show_points_with_scatter_and_predicted_lines(axes: Axes, tree: xr.DataTree) -> None:
    prediction, measurement = cases_of(group(tree, "prediction")), group(tree, "measurement")
    report.plot_friction_curves(axes, prediction, measurement)
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "linear")
    assert axes.get_xlabel() == r"speed $v$ (mm/s)"
    assert axes.get_ylim()[0] == 0.0
    assert legend_texts(axes) == ["90 °C", "60 °C", "30 °C"]
    assert len(error_bars(axes)) == 3
    for celsius, line, points in zip((30, 60, 90), axes.lines[:3], error_bars(axes), strict=True):
        cases = prediction.where(prediction["temperature"] == celsius + ZERO, drop=True)
        np.testing.assert_allclose(line.get_xdata(), 1e3 * cases["speed"].values)
        np.testing.assert_allclose(line.get_ydata(), cases["friction_coefficient"].values)
        found = measurement.where(measurement["temperature"] == celsius + ZERO, drop=True)
        np.testing.assert_allclose(points.lines[0].get_ydata(), found["viscoelastic"].values)
        mean, scatter = found["viscoelastic"].values, found["viscoelastic_scatter"].values
        np.testing.assert_allclose(ends_of_bars(points), np.stack([mean - scatter, mean + scatter], axis=1))


def test_temperatures_read_in_grey_too(axes: Axes, tree: xr.DataTree) -> None:
    report.plot_friction_curves(axes, cases_of(group(tree, "prediction")), group(tree, "measurement"))
    assert len({str(line.get_linestyle()) + str(line._unscaled_dash_pattern) for line in axes.lines[:3]}) == 3
    assert len({str(points.lines[0].get_marker()) for points in error_bars(axes)}) == 3


def test_measured_temperature_need_not_equal_the_predicted_one_exactly(axes: Axes, tree: xr.DataTree) -> None:
    measurement = group(tree, "measurement")
    measurement = measurement.assign(temperature=measurement["temperature"] + 0.2)
    report.plot_friction_curves(axes, cases_of(group(tree, "prediction")), measurement)
    assert len(legend_texts(axes)) == 3


def test_one_decade_of_speeds_has_readable_ticks(axes: Axes, tree: xr.DataTree) -> None:
    report.plot_friction_curves(axes, cases_of(group(tree, "prediction")))
    assert labels_of_ticks(axes) == ["20", "50", "100", "200"]


@pytest.mark.parametrize(("low", "high"), [(100.0, 110.0), (20.0, 30.0), (1.0, 900.0), (3e-4, 5e-3)])
def test_short_speed_ranges_have_a_few_plain_ticks(axes: Axes, low: float, high: float) -> None:
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    style.speed_ticks(axes.xaxis)
    ticks = labels_of_ticks(axes)
    assert 3 <= len(ticks) <= 10
    assert all(low <= float(tick) <= high for tick in ticks)


def test_one_case_is_visible_as_a_point(axes: Axes, make_tree: Callable[..., xr.DataTree]) -> None:
    tree = make_tree(measurement=False, speeds=1, temperatures=1)
    report.plot_friction_curves(axes, cases_of(group(tree, "prediction")))
    (line,) = axes.lines
    assert line.get_marker() == "o"


def test_failed_cases_leave_gaps_not_crashes(axes: Axes, tree: xr.DataTree) -> None:
    prediction = cases_of(group(tree, "prediction"))
    friction = prediction["friction_coefficient"].copy()
    friction[:7] = np.nan
    report.plot_friction_curves(axes, prediction.assign(friction_coefficient=friction))
    axes.figure.canvas.draw()


def test_friction_master_curve_lays_all_temperatures_on_one_line(axes: Axes, tree: xr.DataTree) -> None:
    prediction, measurement = group(tree, "prediction_master"), group(tree, "measurement")
    report.plot_friction_master_curve(axes, prediction, measurement, reference_temperature=303.15)
    assert axes.get_xscale() == "log"
    assert "(mm/s) at 30 °C" in axes.get_xlabel()
    line = axes.lines[0]
    np.testing.assert_allclose(line.get_xdata(), 1e3 * prediction["speed"].values)
    np.testing.assert_allclose(line.get_ydata(), prediction["friction_coefficient"].values)
    speeds = np.concatenate([points.lines[0].get_xdata() for points in error_bars(axes)])
    np.testing.assert_allclose(speeds, 1e3 * measurement["reduced_speed"].values)
    assert legend_texts(axes) == ["predicted", "90 °C", "60 °C", "30 °C"]


@pytest.mark.parametrize("modulus", ["storage", "loss"])
def test_isotherms_show_every_sweep(axes: Axes, tree: xr.DataTree, modulus: Any) -> None:
    sweeps = group(tree, "isotherms")
    scale = report.plot_isotherms(axes, sweeps, modulus)
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert f"{modulus} modulus" in axes.get_ylabel()
    assert "(MPa)" in axes.get_ylabel()
    assert "(rad/s)" in axes.get_xlabel()
    assert len(axes.lines) == 14
    assert scale.get_clim() == pytest.approx((-30.0, 100.0))
    shown = np.sort(np.concatenate([line.get_ydata() for line in axes.lines]))
    np.testing.assert_allclose(shown, np.sort(sweeps[f"{modulus}_modulus"].values / 1e6))


def test_many_temperatures_still_differ() -> None:
    looks = style.looks(26)
    assert len({str(look) for look in looks}) == 26


def test_prediction_beyond_the_measured_frequencies_is_thin(axes: Axes, tree: xr.DataTree) -> None:
    prediction = group(tree, "prediction_master")
    prediction["within_measured_frequencies"][:10] = 0
    report.plot_friction_master_curve(axes, prediction)
    thin, full = axes.lines
    assert thin.get_linewidth() < full.get_linewidth()
    assert np.isfinite(np.asarray(thin.get_ydata(), dtype=float)).all()
    assert np.isnan(np.asarray(full.get_ydata(), dtype=float)).sum() == 10
    assert legend_texts(axes) == ["predicted"]


@pytest.mark.slow
def test_plotting_is_imported_without_what_annotations_alone_name() -> None:
    """The first plot does not wait for motion, identification and run files."""
    script = "import sys, viscofric.report.plotting; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    unused = (
        "viscofric.motion",
        "viscofric.friction.identification",
        "viscofric.friction.heating",
        "viscofric.study.run_file",
    )
    assert not [module for module in done.stdout.split() if module.startswith(unused)]
