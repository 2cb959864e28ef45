"""The page's prediction beside a measurement, and friction on one curve."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viscofric as vf
from friction.synthetic_curves import planted_law, synthetic_curves
from refusals import refused
from viscofric.errors import StudyError, SuperpositionError
from viscofric.web.jobs.context import Context
from web.friction_workspace import NOISE, STUDY, column, done, workspace

CURVES = {**STUDY, "measurement": {"curves": "curves.csv"}}
APART = {**STUDY, "measurement": {"curves": "apart.csv"}}


@pytest.fixture(scope="module")
def context(tmp_path_factory: pytest.TempPathFactory) -> Context:
    made = workspace(tmp_path_factory.mktemp("agreement") / "workspace")
    vf.write_friction_curves(synthetic_curves(30, 90, noise=NOISE, seed=6), made.files / "apart.csv")
    return made


@pytest.fixture(scope="module")
def agreement(context: Context) -> dict[str, Any]:
    return done("agreement", context, APART)


def test_the_prediction_meets_the_friction_that_it_was_planted_with(agreement: dict[str, Any]) -> None:
    planted = synthetic_curves(30, 90)
    predicted = column(agreement["points"], "predicted")
    # Solved and interpolated to 1 %.
    np.testing.assert_allclose(predicted, planted.viscoelastic, rtol=1e-2)
    noise = column(agreement["points"], "measured") / predicted - 1.0
    np.testing.assert_allclose(column(agreement["points"], "difference"), 1.0 / (1.0 + noise) - 1.0, atol=1e-5)
    assert predicted.size == 20
    assert agreement["key_numbers"][0]["label"] == "Prediction minus measurement"
    assert [row[0] for row in agreement["table"]["rows"]] == ["30 °C", "90 °C"]
    assert {word for points in agreement["points"] for word in points["remark"]} == {""}  # none is doubtful


def test_predicted_lines_run_through_all_measured_speeds(agreement: dict[str, Any]) -> None:
    for line, points in zip(agreement["lines"], agreement["points"], strict=True):
        assert line["temperature"] == points["temperature"]
        assert line["speed"][0] < points["speed"][0] < points["speed"][-1] < line["speed"][-1]
        between = np.exp(np.interp(np.log(points["speed"]), np.log(line["speed"]), np.log(line["friction"])))
        np.testing.assert_allclose(between, points["predicted"], rtol=5e-3)  # 25 points over 1.2 decades


def test_all_temperatures_fall_on_the_predicted_master_curve(agreement: dict[str, Any]) -> None:
    along = agreement["along"]
    assert along["reference"] == pytest.approx(303.15)
    reduced = column(agreement["points"], "reduced_speed")
    between = np.exp(np.interp(np.log(reduced), np.log(along["speed"]), np.log(along["friction"])))
    np.testing.assert_allclose(between, column(agreement["points"], "predicted"), rtol=2e-2)


def test_a_ready_rubber_has_no_band_and_the_page_says_why(agreement: dict[str, Any]) -> None:
    assert not agreement["band"]
    assert agreement["notes"] != []


def test_nothing_is_solved_twice(context: Context, agreement: dict[str, Any]) -> None:
    cases = {path: path.stat().st_mtime_ns for path in context.cache.rglob("*.json")}
    assert cases
    assert done("agreement", context, APART) == agreement
    assert {path: path.stat().st_mtime_ns for path in context.cache.rglob("*.json")} == cases


@pytest.mark.parametrize(
    ("more", "refusal"),
    [
        ({"layer": {"thickness": "2 mm"}}, ("contradiction",)),
        ({"indenter": {"shape": "cone", "angle": "5 deg"}}, ("contradiction",)),
        ({"measurement": {"curves": "none.csv"}}, ("file-not-here", "'none.csv'")),
    ],
)
def test_what_cannot_be_compared_is_refused(context: Context, more: dict[str, Any], refusal: tuple[str, ...]) -> None:
    with refused(refusal[0], StudyError, naming=refusal[1:]):
        done("agreement", context, {**CURVES, **more})


def test_friction_alone_shows_the_planted_shift_factors(context: Context) -> None:
    found = done("master", context, {"measurement": {"curves": "curves.csv"}}, beside=False)
    assert found["by_rubber"] is None
    assert found["known"] is None
    factors = found["found"]["factors"]
    expected = np.asarray(
        planted_law().at_reference(found["found"]["reference"]).log10(np.array(factors["temperature"]))
    )
    away = np.array(factors["log10_shift_factor"]) - expected
    # Four independent factors: one in a thousand is more than 3.3 standard errors off.
    assert np.all(np.abs(away) <= 3.5 * np.maximum(factors["standard_error"], 1e-6))
    assert max(factors["standard_error"]) < 0.1
    fetched = vf.read_shift_factors(context.downloads / found["found"]["download"])
    np.testing.assert_allclose(fetched.log10_values, factors["log10_shift_factor"], atol=1e-5)


def test_friction_and_rubber_shift_alike(context: Context) -> None:
    found = done("master", context, CURVES, law="wlf")
    assert found["refusal"] is None
    assert found["found"]["reference"] == found["by_rubber"]["reference"] == pytest.approx(303.15)
    assert {one["name"] for one in found["found"]["words"]} >= {"reference", "law", "overlap", "comparison"}
    by_rubber, points = found["by_rubber"], column(found["by_rubber"]["points"], "speed")
    line = np.interp(np.log(points), np.log(by_rubber["line"]["speed"]), by_rubber["line"]["friction"])
    # The smoothed line runs through means of eight repetitions with 1.5 % of scatter each.
    assert np.sqrt(np.mean((column(by_rubber["points"], "friction") / line - 1.0) ** 2)) < NOISE


def test_curves_that_do_not_overlap_are_shifted_by_the_rubber_alone(context: Context) -> None:
    found = done("master", context, APART)
    assert found["found"] is None
    assert found["refusal"]
    assert len(found["by_rubber"]["points"]) == 2
    with refused("no-overlap", SuperpositionError):
        done("master", context, APART, beside=False)
