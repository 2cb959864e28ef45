"""What is doubtful, left out, extrapolated or synthetic is said where the numbers stand."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
import pytest

from viscofric.notes import Note, records
from viscofric.report.captions import captions
from viscofric.report.texts.friction_tables import agreement_table, detail_tables, friction_at_a_glance
from viscofric.report.texts.study import key_numbers, scope

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr


def change(tree: xr.DataTree, name: str, variable: str, row: int, value: float) -> None:
    part = tree[name].to_dataset()
    part[variable][row] = value
    tree[name].dataset = part


def test_doubtful_rows_are_marked_and_counted_in_the_headline(tree: xr.DataTree) -> None:
    change(tree, "prediction", "front", 0, 3e-3)
    change(tree, "prediction", "within_measured_frequencies", 1, 0)
    change(tree, "measurement", "within_measured_frequencies", 2, 0)
    tables = {table.key: table for table in detail_tables(tree)}
    assert [row[-1] for row in tables["prediction"].rows[:3]] == ["wide contact", "beyond the sweeps", ""]
    assert [row[-1] for row in tables["measured-and-predicted"].rows[:3]] == ["", "", "beyond the sweeps"]
    assert "remark" not in tables["prediction-master"].headings
    glance = friction_at_a_glance(tree)
    assert glance is not None
    assert [row[1].endswith(" *") for row in glance.rows[:3]] == [True, True, False]
    assert "extends beyond 0.3 ball radii from the axis" in glance.note
    remark = key_numbers(tree)[0].remark
    assert "doubtful in 1 of 21" in remark
    assert "extrapolated beyond the measured frequencies in 1 of 21" in remark


def test_measured_point_without_a_prediction_keeps_its_row(tree: xr.DataTree) -> None:
    change(tree, "measurement", "predicted", 0, np.nan)
    change(tree, "measurement", "predicted_error", 0, np.nan)
    change(tree, "measurement", "within_measured_frequencies", 0, 0)
    tree["agreement"].attrs["left_out"] = 1
    (table,) = [table for table in detail_tables(tree) if table.key == "measured-and-predicted"]
    row = dict(zip(table.headings, table.rows[0], strict=True))
    assert (row["predicted"], row["predicted minus measured"]) == ("–", "–")
    assert "remark" not in row
    agreement = agreement_table(tree)
    assert agreement is not None
    assert "1 measured point is left out" in agreement.note
    assert "but not the uncertainty of the material (sweeps, shift factors, spectrum)" in agreement.note


def test_isotherms_left_out_are_said_in_what_was_asked(tree: xr.DataTree) -> None:
    tree["shift_factors"].attrs["isotherms_used"] = 11
    assert "11 of 14 isotherms used" in scope(tree)[1]


def test_caption_claims_one_curve_only_as_far_as_it_was_tested(make_tree: Callable[..., xr.DataTree]) -> None:
    assert "one curve" not in captions(make_tree())["friction_master_curve"]
    note = Note("curves-apart", "The curves do not overlap.")
    reported = captions(make_tree(notes=json.dumps(records(["Else.", note]))))["friction_master_curve"]
    assert reported.endswith(note)


@pytest.mark.parametrize(("origin", "said"), [("synthetic", True), ("measured", False)])
def test_synthetic_points_are_not_called_measured(
    make_tree: Callable[..., xr.DataTree], origin: str, said: bool
) -> None:
    tree = make_tree(data_origin=origin)
    assert ("synthetic measurement" in captions(tree)["friction_against_speed"]) == said
    assert ("18 synthetic (calculated, not measured) points" in scope(tree)[2].replace("\xa0", " ")) == said


def test_speeds_of_metres_per_second_are_written_so(tree: xr.DataTree) -> None:
    change(tree, "prediction", "speed", 0, 1e-4)
    change(tree, "prediction", "speed", 1, 10.0)
    assert "0.1 mm/s to 10 m/s" in scope(tree)[0].replace("\xa0", " ")
