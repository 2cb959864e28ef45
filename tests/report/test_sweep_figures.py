"""Figures of sweeps show their own numbers, few enough to be read, and say what is missing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from viscofric.report.figures.maps import filled_in, map_figure, maximum_ridge, plot_friction_map
from viscofric.report.figures.sweeps import plot_sweep, sweep_figure
from viscofric.report.sweeps import band_of_samples, layout_of, words_of_band

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from matplotlib.axes import Axes

    Make = Callable[..., xr.Dataset]

SPEEDS, TEMPERATURES = np.geomspace(1e-3, 1.0, 7), np.linspace(303.15, 363.15, 4)
CURVES = {"temperature": TEMPERATURES, "speed": SPEEDS}


def legend_texts(figure: Figure) -> list[str]:
    legends = [legend for axes in figure.axes if (legend := axes.get_legend()) is not None]
    assert len(legends) == 1
    return [text.get_text() for text in legends[0].get_texts()]


def test_lines_are_the_numbers_of_the_results(axes: Axes, make_sweep: Make) -> None:
    friction = make_sweep(CURVES)
    layout = layout_of(friction)
    assert layout is not None
    plot_sweep(axes, friction, layout, (0, 3))
    curves = [line for line in axes.lines if np.size(line.get_xdata()) == 7]
    for line, kelvin in zip(curves, (303.15, 363.15), strict=True):
        np.testing.assert_allclose(line.get_xdata(), 1e3 * SPEEDS)
        np.testing.assert_allclose(line.get_ydata(), friction["friction_coefficient"].sel(temperature=kelvin))


def test_samples_are_a_band_about_the_best_estimate(axes: Axes, make_sweep: Make) -> None:
    friction = make_sweep({"sample": list(range(21)), "speed": SPEEDS})
    layout = layout_of(friction)
    assert layout is not None
    assert layout.lines is None
    plot_sweep(axes, friction, layout)
    best = friction["friction_coefficient"].sel(sample=0).values
    np.testing.assert_allclose(axes.lines[0].get_ydata(), best)
    corners = axes.collections[0].get_paths()[0].vertices
    # The formula adds 1 % a sample: the 2.5th and the 97.5th percentile of 0 … 20 are 0.5 and 19.5.
    at_first = np.unique(corners[np.isclose(corners[:, 0], 1.0), 1])
    np.testing.assert_allclose([at_first[0], at_first[-1]], best[0] * np.array([1.005, 1.195]), rtol=1e-9)


def test_few_samples_have_a_band_of_their_range_which_is_not_called_95_percent(make_sweep: Make) -> None:
    friction = make_sweep({"sample": list(range(5)), "speed": SPEEDS})
    figure = sweep_figure(friction)
    assert figure is not None
    assert not any("95" in text for text in legend_texts(figure))
    corners = figure.axes[0].collections[0].get_paths()[0].vertices
    at_first = np.unique(corners[np.isclose(corners[:, 0], 1.0), 1])
    best = friction["friction_coefficient"].values[0, 0]
    np.testing.assert_allclose([at_first[0], at_first[-1]], best * np.array([1.0, 1.04]), rtol=1e-9)  # 1 % a sample


@pytest.mark.parametrize(("failed", "words"), [((), "95 %"), ((7,), "95 % (range where"), (range(7, 28), "range")])
def test_bands_are_called_what_they_hold_of_the_solved_samples(make_sweep: Make, failed: Any, words: str) -> None:
    """Of 21 samples none, one at the first speed, or three at all speeds are not solved; 20 are few."""
    friction = make_sweep({"sample": list(range(21)), "speed": SPEEDS}, tuple(failed))
    assert words_of_band(friction, "friction_coefficient").startswith(words)
    members = friction["friction_coefficient"].values
    low, high = band_of_samples(members)
    few = np.isfinite(members).sum(axis=0) <= 20
    np.testing.assert_array_equal((low == np.nanmin(members, axis=0)) & (high == np.nanmax(members, axis=0)), few)


@pytest.mark.parametrize("axis", [{"sample": [0, 1, 2]}, {"seed": [1, 2, 3]}])
def test_numerical_errors_that_can_be_seen_are_bars(make_sweep: Make, axis: dict[str, list[int]]) -> None:
    friction = make_sweep({**axis, "speed": SPEEDS})
    share = np.where(SPEEDS > 0.5, 0.3, 0.009)  # the last speed alone: bars of 1 % are as small as a mark
    friction["friction_error"] = friction["friction_coefficient"] * share
    figure = sweep_figure(friction)
    assert figure is not None
    (bars,) = [one for one in figure.axes[0].containers if hasattr(one, "has_yerr")]
    ends = np.array([bar[:, 1] for bar in bars[2][0].get_segments() if len(bar)])
    middle = friction["friction_coefficient"]
    middle = middle.mean("seed") if "seed" in axis else middle.sel(sample=0)
    np.testing.assert_allclose(ends, [middle.values[-1] * np.array([0.7, 1.3])])
    assert "numerical error" in legend_texts(figure)


def test_seeds_of_a_surface_are_thin_lines_behind_their_mean_and_its_interval(axes: Axes, make_sweep: Make) -> None:
    friction = make_sweep({"seed": [1, 2, 3, 4], "speed": SPEEDS})
    each = friction["friction_coefficient"].values * np.array([0.9, 1.0, 1.2, 1.3])[:, None]
    each[2, 5] = np.nan
    friction["friction_coefficient"] = (("seed", "speed"), each)
    layout = layout_of(friction)
    assert layout is not None
    assert (layout.along.name, layout.lines, layout.panels) == ("speed", None, ())
    plot_sweep(axes, friction, layout)
    mean, *seeds, missing = axes.lines
    assert all(seed.get_linewidth() < 0.5 * mean.get_linewidth() for seed in seeds)
    np.testing.assert_allclose([seed.get_ydata() for seed in seeds], each)
    # By hand: the mean of the factors is 1.1, their squared deviations add up to 0.04 + 0.01 + 0.01 + 0.04 = 0.1;
    # Student's t of three degrees of freedom at 97.5 % is 3.182446 (tables).
    at_first = make_sweep({"speed": SPEEDS})["friction_coefficient"].values[0]
    assert mean.get_ydata()[0] == pytest.approx(1.1 * at_first)
    reach = 3.182446 * (0.1 / 3.0 / 4.0) ** 0.5
    corners = axes.collections[0].get_paths()[0].vertices
    band = np.unique(corners[np.isclose(corners[:, 0], 1.0), 1])
    np.testing.assert_allclose([band[0], band[-1]], at_first * np.array([1.1 - reach, 1.1 + reach]), rtol=1e-6)
    # Without one of its seeds a mean would be of other surfaces than its neighbours.
    assert np.flatnonzero(np.isnan(mean.get_ydata())).tolist() == [5]
    np.testing.assert_allclose(missing.get_xdata(), 1e3 * SPEEDS[5])


def test_maps_of_several_seeds_are_one_of_their_mean(make_sweep: Make) -> None:
    whole = make_sweep({"seed": [1, 2], **CURVES})
    figure, single = map_figure(whole), map_figure(whole.isel(seed=0))
    assert figure is not None
    assert single is not None
    assert len(figure.axes) == len(single.axes)
    assert figure.axes[0].get_title() == ""


@pytest.mark.parametrize(
    ("points", "panels", "lines"),
    [
        ({"load": [5.0, 25.0], **CURVES}, 2, 4),
        ({"load": [1.0, 2.0, 3.0, 4.0, 5.0], "radius": [0.01, 0.02, 0.05], **CURVES}, 9, 4),
        ({"temperature": np.linspace(273.15, 373.15, 30), "speed": SPEEDS}, 1, 8),
        ({"load": [5.0, 25.0]}, 1, 0),
        ({"seed": [1, 2, 3], **CURVES}, 1, 6),
        ({"seed": [1, 2, 3], "pressure": [1e4, 5e4], **CURVES}, 2, 6),
        ({"seed": [1, 2, 3]}, 1, 0),
        ({"material": ["NBR 70", "FKM 75"], "speed": SPEEDS}, 1, 2),
    ],
)
def test_no_panel_has_more_lines_than_are_read(
    make_sweep: Make, points: dict[str, Any], panels: int, lines: int
) -> None:
    figure = sweep_figure(make_sweep(points))
    assert figure is not None
    assert len(figure.axes) == panels
    if lines:
        assert len(legend_texts(figure)) == lines
    titles = [axes.get_title() for axes in figure.axes]
    assert len(set(titles)) == panels
    assert all(axes.get_ylim() == figure.axes[0].get_ylim() for axes in figure.axes)


def test_cases_that_were_not_solved_are_crossed_not_made_up(make_sweep: Make) -> None:
    figure = sweep_figure(make_sweep(CURVES, failed=(2,)))
    assert figure is not None
    assert legend_texts(figure)[-1] == "not solved"
    crosses = [line for line in figure.axes[0].lines if line.get_marker() == "x" and np.size(line.get_xdata())]
    np.testing.assert_allclose(crosses[0].get_xdata(), 1e3 * SPEEDS[2])


def test_nothing_to_draw_is_no_figure(make_sweep: Make) -> None:
    assert sweep_figure(make_sweep(CURVES).isel(speed=0, temperature=0)) is None
    assert sweep_figure(make_sweep(CURVES, failed=tuple(range(28)))) is None
    assert map_figure(make_sweep({"temperature": TEMPERATURES, "speed": SPEEDS[:3]})) is None
    assert map_figure(make_sweep({"speed": SPEEDS})) is None


def test_ridge_lies_at_the_maximum_of_each_temperature() -> None:
    speed, kelvin = np.geomspace(1e-4, 1e2, 25), np.array([300.0, 310.0, 320.0])
    highest = np.array([2e-3, 0.1, 5.0])
    parabolas = 0.03 - 0.001 * np.log(speed / highest[:, None]) ** 2
    ridge = maximum_ridge(speed, kelvin, parabolas)
    np.testing.assert_allclose(ridge[:, 1], kelvin)
    # A parabola over the logarithm of the speed is met exactly.
    np.testing.assert_allclose(ridge[:, 0], highest, rtol=1e-9)
    parabolas[0] = np.linspace(0.1, 0.2, 25)  # highest at the end of the range
    parabolas[1] = np.nan
    np.testing.assert_allclose(maximum_ridge(speed, kelvin, parabolas)[:, 1], [np.nan, np.nan, 320.0])


def test_map_spans_what_was_asked(axes: Axes, make_sweep: Make) -> None:
    friction = make_sweep(CURVES)["friction_coefficient"].values
    filled = plot_friction_map(axes, SPEEDS, TEMPERATURES, friction)
    assert axes.get_xscale() == "log"
    np.testing.assert_allclose(axes.get_xlim(), (1.0, 1e3))
    np.testing.assert_allclose(axes.get_ylim(), (30.0, 90.0))
    assert filled.levels[0] <= friction.min()
    assert filled.levels[-1] >= friction.max()


def test_maps_of_several_loads_share_their_colours(make_sweep: Make) -> None:
    figure = map_figure(make_sweep({"load": [5.0, 25.0], **CURVES}), (np.array([0.1]), np.array([333.15])))
    assert figure is not None
    assert [axes.get_title() for axes in figure.axes[:2]] == ["5 N", "25 N"]
    first, second = (next(area for area in axes.collections if hasattr(area, "levels")) for axes in figure.axes[:2])
    np.testing.assert_allclose(first.levels, second.levels)
    assert len(figure.axes) == 3  # with one colour bar


def test_maps_follow_the_shift_between_temperatures() -> None:
    # A ridge that moves two decades from one temperature to the next, of a friction that has one height everywhere.
    kelvins, known = np.array([293.15, 333.15, 373.15]), np.linspace(253.15, 393.15, 30)
    log = 2000.0 * (1.0 / known - 1.0 / 293.15)
    speed = np.geomspace(1e-3, 1e3, 61)

    def friction(kelvin: float) -> Any:
        return 0.1 / (1.0 + (np.log10(speed) + 2000.0 * (1.0 / kelvin - 1.0 / 293.15)) ** 2)

    given = np.array([friction(kelvin) for kelvin in kelvins.tolist()])
    at, whole = filled_in(speed, kelvins, given, (known, log))
    for kelvin, row in zip(kelvins, given, strict=True):
        np.testing.assert_allclose(whole[np.flatnonzero(at == kelvin)[0]], row)
    middle = int(np.argmin(np.abs(at - 313.15)))
    # Straight lines between points a tenth of a decade apart miss the peak by its curvature, 0.1 · 2 · 0.05²/2 at most.
    np.testing.assert_allclose(whole[middle], friction(float(at[middle])), atol=3e-4)
    straight = 0.5 * (given[0] + given[1])
    assert np.abs(straight - friction(313.15)).max() > 5e-3  # what the islands along a ridge were made of
    assert filled_in(speed, kelvins, given, None)[1] is given


def test_contours_have_no_steps_where_a_curve_ends_between_temperatures() -> None:
    # Temperatures so far apart that half a decade lies between their curves; friction rises along the reduced speed.
    kelvins, known = np.array([293.15, 313.15, 333.15]), np.linspace(283.15, 343.15, 30)
    log = -3.5 * (known - 293.15) / 20.0
    speed = np.geomspace(1e-3, 1.0, 13)

    def friction(kelvin: float) -> Any:
        return 0.05 + 0.02 * np.tanh(0.5 * (np.log10(speed) - 3.5 * (kelvin - 293.15) / 20.0 + 3.0))

    given = np.array([friction(kelvin) for kelvin in kelvins.tolist()])
    at, whole = filled_in(speed, kelvins, given, (known, log))
    exact = np.array([friction(float(kelvin)) for kelvin in at])
    np.testing.assert_allclose(whole, exact, atol=5e-4)
    # from row to row friction changes by no more than it does exactly
    assert np.abs(np.diff(whole, axis=0)).max() < 1.5 * np.abs(np.diff(exact, axis=0)).max()


def test_a_case_that_failed_stays_white_in_a_map() -> None:
    speed, kelvins = np.geomspace(1e-3, 1e3, 13), np.array([293.15, 333.15, 373.15])
    friction = np.full((3, 13), 0.1)
    friction[1, :3] = np.nan
    at, whole = filled_in(speed, kelvins, friction, (kelvins, np.array([0.0, -1.0, -1.8])))
    near = np.abs(at - 333.15) < 15.0
    assert np.isnan(whole[np.ix_(near, range(3))]).all()
    assert np.isfinite(whole[:, 3:]).all()
