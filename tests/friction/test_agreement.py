"""Predicted friction against measured friction: bias, root mean square, share within the standard error."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.made_runs import friction_curves
from refusals import refused
from viscofric.friction.agreement import compare
from viscofric.notes import Note

SPEED = np.tile([0.05, 0.1], 2)
TEMPERATURE = np.repeat([303.15, 333.15], 2)


def test_a_prediction_too_high_everywhere_has_that_bias() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.array([0.01, 0.02, 0.03, 0.04]), error=1e-5)
    predicted = friction_curves(SPEED, TEMPERATURE, 1.1 * measured.viscoelastic)
    agreement = compare(measured, predicted)
    assert agreement.bias == pytest.approx(0.1)
    assert agreement.rms == pytest.approx(0.1)
    assert agreement.share_within_error == 0.0


def test_each_temperature_is_distinguished() -> None:
    """±10 % at 30 °C has no bias but a root mean square; −5 % at 60 °C is within twice the combined error."""
    measured = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.02), error=4e-4)
    predicted = friction_curves(SPEED, TEMPERATURE, 0.02 * np.array([1.1, 0.9, 0.95, 0.95]), error=3e-4)
    agreement = compare(measured, predicted)
    np.testing.assert_allclose(agreement.temperature, [303.15, 333.15])
    np.testing.assert_allclose(agreement.bias_at, [0.0, -0.05], atol=1e-12)
    np.testing.assert_allclose(agreement.rms_at, [0.1, 0.05])
    # 2·√(4² + 3²)·1e-4 = 1e-3 = 5 % of 0.02, a hair above the difference by rounding of neither: use 4.9 %.
    nearly = friction_curves(SPEED, TEMPERATURE, 0.02 * np.array([1.1, 0.9, 0.951, 0.951]), error=3e-4)
    np.testing.assert_array_equal(compare(measured, nearly).share_within_error_at, [0.0, 1.0])
    np.testing.assert_array_equal(agreement.points_at, [2, 2])
    assert agreement.rms == pytest.approx(np.sqrt((2 * 0.01 + 2 * 0.0025) / 4))


def test_temperatures_that_scatter_are_one_temperature() -> None:
    kelvin = TEMPERATURE + np.array([0.2, -0.1, -0.3, 0.1])
    measured = friction_curves(SPEED, kelvin, np.full(4, 0.02))
    agreement = compare(measured, friction_curves(SPEED, kelvin, np.full(4, 0.021)))
    np.testing.assert_allclose(agreement.temperature, [303.2, 333.05])
    np.testing.assert_array_equal(agreement.points_at, [2, 2])


def test_the_error_of_an_assumed_coulomb_friction_is_not_averaged_away() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.02), error=0.002)
    predicted = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.02))
    assert compare(measured, predicted).bias_error == pytest.approx(0.05)  # 10 % over the root of 4 points
    assert compare(replace(measured, assumption="Coulomb friction is 0.05 ± 0.002."), predicted).bias_error == (
        pytest.approx(0.1)
    )


def test_points_find_their_predictions_in_any_order() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.array([0.01, 0.02, 0.03, 0.04]))
    backwards = friction_curves(SPEED[::-1], TEMPERATURE[::-1], measured.viscoelastic[::-1], load=25.3)
    agreement = compare(measured, backwards)
    assert agreement.rms == 0.0
    assert agreement.share_within_error == 1.0


@pytest.mark.parametrize("replicates", [1, 3])
def test_honest_errors_hold_95_percent_of_the_points(replicates: int) -> None:
    """Of the mean of three replicates, as of one with a known error."""
    count = 2000
    speed, temperature = np.geomspace(0.01, 1.0, count), np.full(count, 303.15)
    noise = np.random.default_rng(3).standard_normal((replicates, count))
    error = noise.std(axis=0, ddof=1) / np.sqrt(3.0) if replicates > 1 else 1.0
    measured = friction_curves(speed, temperature, 0.03 * (1 + 0.02 * noise.mean(axis=0)), error=6e-4 * error)
    measured = replace(measured, replicates=np.full(count, replicates))
    agreement = compare(measured, friction_curves(speed, temperature, np.full(count, 0.03)))
    # Five standard deviations of the count: √(0.954·0.046/2000) = 0.0047.
    assert agreement.share_within_error == pytest.approx(0.9545, abs=0.024)
    assert agreement.rms == pytest.approx(0.02 / np.sqrt(replicates), rel=0.1)


@pytest.mark.parametrize(
    ("speed", "temperature", "load"), [(0.0501, 303.15, 25.0), (0.05, 303.65, 25.0), (0.05, 303.15, 30.0)]
)
def test_a_point_without_its_prediction_is_an_error(speed: float, temperature: float, load: float) -> None:
    measured = friction_curves(np.array([0.05]), np.array([303.15]), np.array([0.03]))
    elsewhere = friction_curves(np.array([speed]), np.array([temperature]), np.array([0.03]), load=load)
    with refused("no-prediction"):
        compare(measured, elsewhere)


def test_relative_differences_need_friction_above_zero() -> None:
    measured = friction_curves(np.array([0.05]), np.array([303.15]), np.array([-0.001]))
    with refused("friction-not-positive"):
        compare(measured, measured)


def test_the_materials_own_error_counts_as_one_error_of_all_points() -> None:
    """Nine independent errors of 1 % leave 1/3 % on the mean; one of 2 % that all share leaves 2 %."""
    speed, temperature = np.geomspace(0.01, 1.0, 9), np.full(9, 303.15)
    measured = friction_curves(speed, temperature, np.full(9, 0.02), error=2e-4)
    predicted = friction_curves(speed, temperature, np.full(9, 0.0208))
    alone = compare(measured, predicted)
    assert (alone.share_within_error, alone.material_counted) == (0.0, False)
    assert alone.bias_error == pytest.approx(0.01 / 3.0)
    assert alone.bias == pytest.approx(0.04)
    counted = compare(measured, replace(predicted, material_error=np.full(9, 4e-4)))
    # 2 √(2² + 4²) 1e-4 = 8.9e-4, above the difference of 8e-4
    assert (counted.share_within_error, counted.material_counted) == (1.0, True)
    assert counted.bias_error == pytest.approx(np.hypot(0.01 / 3.0, 0.02))
    np.testing.assert_allclose(counted.bias_error_at, counted.bias_error)
    assert counted.material_counted


def test_what_the_speeds_of_a_temperature_share_counts_once_for_each_temperature() -> None:
    """Of errors of 5 % nine speeds share 4 %, which their mean does not make smaller; the other 3 % differ."""
    speed, temperature = np.tile(np.geomspace(0.01, 1.0, 9), 2), np.repeat([303.15, 333.15], 9)
    noted = Note("errors-shared-by-speeds", "", values={"level_error": 0.04})
    measured = friction_curves(speed, temperature, np.full(18, 0.02), error=1e-3)
    predicted = friction_curves(speed, temperature, np.full(18, 0.02))
    shared = compare(replace(measured, notes=(noted,)), predicted)
    np.testing.assert_allclose(shared.bias_error_at, np.hypot(0.03 / 3.0, 0.04))
    assert shared.bias_error == pytest.approx(np.hypot(0.03 / 3.0, 0.04) / np.sqrt(2.0))
    master = vf.shift_friction(measured, shift=vf.WLF(10.0, 100.0, 303.15), level_error=0.04)
    by_master = compare(master, vf.shift_friction(predicted, shift=vf.WLF(10.0, 100.0, 303.15)))
    # the smoothed prediction has 1e-5 of its own
    assert by_master.bias_error == pytest.approx(shared.bias_error, rel=1e-2)
    exact = replace(measured, viscoelastic_error=np.full(18, 2e-4))  # 1 %, less than is shared, as by the force cell
    beside = compare(
        vf.shift_friction(exact, shift=master.shift, level_error=0.04), vf.shift_friction(predicted, shift=master.shift)
    )
    assert beside.bias_error == pytest.approx(0.04 / np.sqrt(2.0), rel=1e-2)


def test_the_bias_scatters_as_its_standard_error_says() -> None:
    """Measured means with 3 % noise and a prediction that is 2 % off as a whole, 400 times: both standard errors."""
    random, count = np.random.default_rng(8), 12
    speed, temperature, truth = np.geomspace(0.01, 1.0, count), np.full(count, 303.15), np.full(count, 0.03)
    found = []
    for _ in range(400):
        measured = friction_curves(speed, temperature, truth * (1 + 0.03 * random.standard_normal(count)), error=9e-4)
        predicted = friction_curves(speed, temperature, truth * (1 + 0.02 * random.standard_normal()))
        found.append(compare(measured, replace(predicted, material_error=0.02 * truth)))
    reported = np.mean([one.bias_error for one in found])
    # A standard deviation from 400 values is good to 1/√800 = 3.5 %; three times that.
    assert np.std([one.bias for one in found]) == pytest.approx(reported, rel=0.11)


def test_an_unknown_error_is_said_to_be_unknown() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.02), error=np.array([np.inf, 1e-4, 1e-4, 1e-4]))
    agreement = compare(measured, friction_curves(SPEED, TEMPERATURE, np.full(4, 0.021)))
    # 1e-3 is ten of the three known errors; the infinite one does not count.
    assert (agreement.share_within_error, agreement.with_error) == (0.0, 3)
    assert agreement.bias_error == np.inf


def test_the_scatter_of_replicates_is_reported_where_there_are_any() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.02))
    assert compare(measured, measured).share_within_scatter is None
    repeated = replace(
        measured, viscoelastic_scatter=np.array([2e-3, 2e-3, 0.0, 2e-3]), replicates=np.array([8, 8, 1, 8])
    )
    predicted = friction_curves(SPEED, TEMPERATURE, np.array([0.0215, 0.0225, 0.02, 0.019]))
    agreement = compare(repeated, predicted)
    assert (agreement.share_within_scatter, agreement.repeated) == (pytest.approx(2 / 3), 3)
    np.testing.assert_array_equal(agreement.share_within_scatter_at, [0.5, 1.0])
    half = compare(replace(repeated, replicates=np.array([8, 8, 1, 1])), predicted)
    np.testing.assert_array_equal(half.share_within_scatter_at, [0.5, np.nan])


WLF = vf.WLF(C1=8.0, C2=110.0, reference="30 degC")
WRONG = vf.WLF(C1=7.0, C2=110.0, reference="30 degC")


def friction_of(law: vf.WLF, factor: float = 1.0):
    """Curves at five temperatures on one bell of width 2 decades, shifted by a law."""
    kelvin, speeds = np.array([293.15, 303.15, 313.15, 323.15, 333.15]), np.geomspace(0.02, 0.5, 12)
    speed, temperature = np.tile(speeds, 5), np.repeat(kelvin, 12)
    decades = np.log10(speed) + law.log10(temperature)
    return friction_curves(speed, temperature, factor * 0.03 * np.exp(-0.5 * ((decades + 1.0) / 2.0) ** 2), error=1e-5)


def test_a_wrong_alpha_shows_between_the_curves_but_not_between_the_master_curves() -> None:
    """The bell falls by up to 35 % in a decade, so that smoothing is good to 1e-3; α is 0.2 to 0.4 decades off."""
    measured, predicted = friction_of(WLF), friction_of(WRONG, 1.02)
    at_points = compare(measured, predicted)
    shifted = vf.shift_friction(measured, shift=WLF), vf.shift_friction(predicted, shift=WRONG)
    along = compare(*shifted)
    assert at_points.rms > 0.05
    assert along.along_reduced_speed
    np.testing.assert_allclose(along.relative_difference, 0.02, atol=2e-3)
    assert along.bias == pytest.approx(0.02, abs=1e-3)
    assert along.not_covered == len(measured) - along.points > 0  # the wrong α reaches less far


def test_the_materials_error_is_read_along_the_master_curve() -> None:
    """3 % of friction at every point is 3 % of friction between them."""
    measured, predicted = friction_of(WLF), friction_of(WLF)
    predicted = replace(predicted, material_error=0.03 * predicted.viscoelastic)
    along = compare(vf.shift_friction(measured, shift=WLF), vf.shift_friction(predicted, shift=WLF))
    assert along.material_counted
    assert along.bias_error == pytest.approx(0.03, rel=1e-2)  # smoothing and the points' own 1e-5 beside it
    assert (along.not_covered, along.share_within_error) == (0, 1.0)


def test_master_curves_that_cannot_be_compared_are_refused() -> None:
    curves = friction_of(WLF)
    master = vf.shift_friction(curves, shift=WLF)
    with refused("one-master-curve"):
        compare(master, curves)  # type: ignore[call-overload]
    with refused("different-references"):
        compare(master, vf.shift_friction(curves, shift=WLF, reference="40 degC"))
    heavier = replace(curves, load=np.full(len(curves), 30.0))
    with refused("different-loads"):
        compare(master, vf.shift_friction(heavier, shift=WLF))
    faster = replace(curves, speed=1e4 * curves.speed)
    with refused("no-overlap"):
        compare(master, vf.shift_friction(faster, shift=WLF))
    sparse = curves.select(np.array([0, len(curves) - 1]))
    with refused("sparse-prediction"):
        compare(
            vf.shift_friction(curves.select(np.arange(1, len(curves) - 1)), shift=WLF),
            vf.shift_friction(sparse, shift=WLF),
        )


def test_errors_that_are_not_known_show_no_share() -> None:
    """Else every prediction, however wrong, would be within twice an infinite error."""
    measured = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.02), error=np.full(4, np.inf))
    predicted = friction_curves(SPEED, TEMPERATURE, np.full(4, 0.03))
    none = compare(measured, predicted)
    assert none.share_within_error is None
    assert np.all(np.isnan(none.share_within_error_at))
    assert none.bias_error == np.inf
    some = compare(replace(measured, viscoelastic_error=np.array([np.inf, 1e-2, 1e-3, np.inf])), predicted)
    assert (some.share_within_error, some.with_error) == (0.5, 2)
    scattered = replace(measured, replicates=np.full(4, 3), viscoelastic_scatter=np.full(4, np.inf))
    assert compare(scattered, predicted).share_within_scatter is None


def test_data_set_holds_the_numbers_of_each_temperature() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.array([0.01, 0.02, 0.04, 0.04]), error=1e-3)
    agreement = compare(measured, friction_curves(SPEED, TEMPERATURE, np.array([0.011, 0.022, 0.04, 0.04])))
    data = agreement.to_dataset()
    np.testing.assert_allclose(data["temperature"], [303.15, 333.15])
    np.testing.assert_allclose(data["bias"], [0.1, 0.0])
    np.testing.assert_array_equal(data["points"], [2, 2])
    np.testing.assert_array_equal(data["bias_error"], agreement.bias_error_at)
    assert data["share_within_error"].attrs["units"] == "1"
    assert data.attrs["bias"] == pytest.approx(0.05)
    assert data.attrs["material_counted"] == 0
    assert json.loads(data.attrs["sentences"]) == [str(agreement)]
