"""Predicted friction against measured friction: bias, root mean square, share within the standard error."""

from __future__ import annotations

import numpy as np
import pytest

from friction.made_runs import friction_curves
from viscofric.errors import InputError
from viscofric.friction.agreement import compare

SPEED = np.tile([0.05, 0.1], 2)
TEMPERATURE = np.repeat([303.15, 333.15], 2)


def test_a_prediction_too_high_everywhere_has_that_bias() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.array([0.01, 0.02, 0.03, 0.04]), error=1e-5)
    predicted = friction_curves(SPEED, TEMPERATURE, 1.1 * measured.viscoelastic)
    agreement = compare(measured, predicted)
    assert agreement.bias == pytest.approx(0.1)
    assert agreement.rms == pytest.approx(0.1)
    assert agreement.share_within_error == 0.0
    assert "10.0 % above" in str(agreement)


def test_each_temperature_is_told_apart() -> None:
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


def test_points_find_their_predictions_in_any_order() -> None:
    measured = friction_curves(SPEED, TEMPERATURE, np.array([0.01, 0.02, 0.03, 0.04]))
    backwards = friction_curves(SPEED[::-1], TEMPERATURE[::-1], measured.viscoelastic[::-1], load=25.3)
    agreement = compare(measured, backwards)
    assert agreement.rms == 0.0
    assert agreement.share_within_error == 1.0


def test_honest_errors_hold_95_percent_of_the_points() -> None:
    """Normal noise lies within twice its standard error at 95.4 % of the points."""
    count = 2000
    speed, temperature = np.geomspace(0.01, 1.0, count), np.full(count, 303.15)
    noise = np.random.default_rng(3).standard_normal(count)
    measured = friction_curves(speed, temperature, 0.03 * (1 + 0.02 * noise), error=6e-4)
    agreement = compare(measured, friction_curves(speed, temperature, np.full(count, 0.03)))
    # Five standard deviations of the count: √(0.954·0.046/2000) = 0.0047.
    assert agreement.share_within_error == pytest.approx(0.9545, abs=0.024)
    assert agreement.rms == pytest.approx(0.02, rel=0.1)


@pytest.mark.parametrize(
    ("speed", "temperature", "load"), [(0.0501, 303.15, 25.0), (0.05, 303.65, 25.0), (0.05, 303.15, 30.0)]
)
def test_a_point_without_its_prediction_is_an_error(speed: float, temperature: float, load: float) -> None:
    measured = friction_curves(np.array([0.05]), np.array([303.15]), np.array([0.03]))
    elsewhere = friction_curves(np.array([speed]), np.array([temperature]), np.array([0.03]), load=load)
    with pytest.raises(InputError, match=r"measured at 30\.00 °C, 50 mm/s and 25 N has no prediction"):
        compare(measured, elsewhere)


def test_relative_differences_need_friction_above_zero() -> None:
    measured = friction_curves(np.array([0.05]), np.array([303.15]), np.array([-0.001]))
    with pytest.raises(InputError, match="must be above zero everywhere"):
        compare(measured, measured)
