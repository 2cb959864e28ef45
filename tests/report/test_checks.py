"""Checks pass where the numbers are sound and do not where they are not."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from viscofric.report.texts.checks import all_checks

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import xarray as xr


def verdicts(tree: xr.DataTree) -> dict[str, str]:
    return {check.name: check.verdict for check in all_checks(tree)}


def test_sound_results_pass(tree: xr.DataTree) -> None:
    found = verdicts(tree)
    assert found.pop("Shift law") == "noted"
    assert set(found.values()) == {"passed"}
    assert list(found) == [
        "Isotherms used",
        "Overlap of the isotherms",
        "Fit of the spectrum",
        "Energy balance",
        "Contact conditions",
        "Small strain",
        "Measured frequency range",
        "Consistency of the four configurations",
        "All cases solved",
        "Accuracy",
    ]


@pytest.mark.parametrize(
    ("group", "attribute", "value", "check"),
    [
        ("shift_factors", "overlap_holds", 0, "Overlap of the isotherms"),
        ("master_curve", "misfit_holds", 0, "Fit of the spectrum"),
        ("shift_factors", "shift_used", "wlf", "Shift law"),
    ],
)
def test_unsound_rheology_is_pointed_out(
    tree: xr.DataTree, group: str, attribute: str, value: float | str, check: str
) -> None:
    tree[group].attrs[attribute] = value
    assert verdicts(tree)[check] == "warning"


@pytest.mark.parametrize(
    ("group", "variable", "value", "check"),
    [
        ("prediction", "energy_balance", -1e-2, "Energy balance"),
        ("prediction_master", "energy_balance", 1e-2, "Energy balance"),
        ("prediction", "complementarity", 1e-3, "Contact conditions"),
        ("prediction", "half_width", 3e-3, "Small strain"),
        ("prediction", "front", 3e-3, "Small strain"),
        ("prediction_master", "rear", 3e-3, "Small strain"),
        ("prediction", "within_measured_frequencies", 0, "Measured frequency range"),
        ("measurement", "within_measured_frequencies", 0, "Measured frequency range"),
        ("measurement", "consistency", 1e-3, "Consistency of the four configurations"),
    ],
)
def test_unsound_numbers_are_pointed_out(
    tree: xr.DataTree, group: str, variable: str, value: float, check: str
) -> None:
    part = tree[group].to_dataset()
    part[variable] = part[variable] * 0.0 + value
    tree[group].dataset = part
    assert verdicts(tree)[check] == "warning"


def test_failures_fail(make_tree: Callable[..., xr.DataTree]) -> None:
    tree = make_tree(failures=json.dumps(["30 °C: no.", "60 °C: no."]))
    assert verdicts(tree)["All cases solved"] == "failed"
    assert numbers(tree, "All cases solved") == {"cases": 2}


def numbers(tree: xr.DataTree, name: str) -> Mapping[str, Any]:
    (check,) = [check for check in all_checks(tree) if check.name == name]
    return check.values


def test_ball_of_unknown_radius_has_its_strain_unchecked_and_says_so(tree: xr.DataTree) -> None:
    del tree.attrs["indenter_radius"]
    assert verdicts(tree)["Small strain"] == "noted"


def test_isotherms_left_out_are_counted_and_named(tree: xr.DataTree) -> None:
    tree["shift_factors"].attrs |= {"isotherms_given": 16, "temperatures_given": json.dumps([233.15, 243.15, 500.0])}
    assert verdicts(tree)["Isotherms used"] == "warning"
    assert numbers(tree, "Isotherms used") == {"used": 14, "given": 16, "left_out": [233.15, 500.0]}


def test_cases_beyond_the_measured_frequencies_are_counted(tree: xr.DataTree) -> None:
    part = tree["prediction"].to_dataset()
    part["within_measured_frequencies"].values.flat[:3] = 0
    tree["prediction"].dataset = part
    assert numbers(tree, "Measured frequency range") == {
        "prediction": [3, 21],
        "measurement": [0, 18],
        "prediction_master": [0, 41],
        "range": [1e-4, 1e6],
    }
    tree.attrs["frequency_gaps"] = [1.0, 100.0, 1e3, 1e5]
    assert numbers(tree, "Measured frequency range")["gaps"] == [1.0, 100.0, 1e3, 1e5]


def test_results_of_an_older_viscofric_lack_the_newer_checks(tree: xr.DataTree) -> None:
    for name in ("prediction", "prediction_master", "measurement"):
        tree[name].dataset = tree[name].to_dataset().drop_vars("within_measured_frequencies")
    for name in ("isotherms_given", "isotherms_used", "temperatures_given"):
        del tree["shift_factors"].attrs[name]
    del tree.attrs["frequency_range"]
    assert not {"Isotherms used", "Measured frequency range"} & set(verdicts(tree))


def test_without_measurement_there_is_no_consistency(make_tree: Callable[..., xr.DataTree]) -> None:
    assert "Consistency of the four configurations" not in verdicts(make_tree(measurement=False))
