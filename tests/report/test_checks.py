"""Checks pass where the numbers are sound and do not where they are not."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

from viscofric.report.checks import all_checks

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr


def verdicts(tree: xr.DataTree) -> dict[str, str]:
    return {check.name: check.verdict for check in all_checks(tree)}


def test_sound_results_pass(tree: xr.DataTree) -> None:
    found = verdicts(tree)
    assert found.pop("WLF law") == "noted"
    assert set(found.values()) == {"passed"}
    assert list(found) == [
        "Overlap of the isotherms",
        "Fit of the spectrum",
        "Energy balance",
        "Contact conditions",
        "Small strain",
        "Consistency of the four configurations",
        "All cases solved",
    ]


@pytest.mark.parametrize(
    ("group", "attribute", "value", "check"),
    [
        ("shift_factors", "overlap_rms_log10_loss", 0.2, "Overlap of the isotherms"),
        ("master_curve", "rms_log10_storage", 0.2, "Fit of the spectrum"),
        ("shift_factors", "shift_used", "wlf", "WLF law"),
    ],
)
def test_unsound_rheology_is_pointed_out(
    tree: xr.DataTree, group: str, attribute: str, value: float | str, check: str
) -> None:
    tree[group].attrs[attribute] = value
    assert verdicts(tree)[check] == "look at this"


@pytest.mark.parametrize(
    ("group", "variable", "value", "check"),
    [
        ("prediction", "energy_balance", -1e-2, "Energy balance"),
        ("prediction_master", "energy_balance", 1e-2, "Energy balance"),
        ("prediction", "complementarity", 1e-3, "Contact conditions"),
        ("prediction", "half_width", 3e-3, "Small strain"),
        ("measurement", "consistency", 1e-3, "Consistency of the four configurations"),
    ],
)
def test_unsound_numbers_are_pointed_out(
    tree: xr.DataTree, group: str, variable: str, value: float, check: str
) -> None:
    part = tree[group].to_dataset()
    part[variable] = part[variable] * 0.0 + value
    tree[group].dataset = part
    assert verdicts(tree)[check] == "look at this"


def test_failures_fail(make_tree: Callable[..., xr.DataTree]) -> None:
    tree = make_tree(failures=json.dumps(["30 °C: no.", "60 °C: no."]))
    assert verdicts(tree)["All cases solved"] == "failed"
    assert "2 cases" in all_checks(tree)[-1].words


def test_indenter_without_a_radius_has_no_strain_check(make_tree: Callable[..., xr.DataTree]) -> None:
    for indenter in ("a flat punch", "ball of radius unknown"):
        assert "Small strain" not in verdicts(make_tree(indenter=indenter))


def test_without_measurement_there_is_no_consistency(make_tree: Callable[..., xr.DataTree]) -> None:
    assert "Consistency of the four configurations" not in verdicts(make_tree(measurement=False))
