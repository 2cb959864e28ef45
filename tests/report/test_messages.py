"""What reports say: failures, doubts, what was asked, captions and remarks."""

from __future__ import annotations

import json
from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from report.test_friction_results import column, with_friction_shifts
from report.test_studies import STUDIES, rough
from viscofric.notes import Note, Remedy, records
from viscofric.report.captions import captions
from viscofric.report.texts.friction_tables import agreement_table, detail_tables, friction_at_a_glance
from viscofric.report.texts.study import grouped_failures, inputs, key_numbers, scope
from viscofric.report.texts.tables import shift_factor_table


def test_failures_of_one_code_are_one_line() -> None:
    failures = [
        Note("accuracy-not-reached", f"the error is {speed * 1e-5:.3g}, not 0.001.", f"−30 °C, {speed} mm/s")
        for speed in range(20, 40)
    ]
    (line,) = grouped_failures(failures, 5)
    assert line.startswith("20 cases (−30 °C, 20 mm/s; −30 °C, 21 mm/s; ")
    assert "and 14 more), the first: the error is 0.0002, not 0.001." in line  # the others' errors are larger


def test_few_failures_are_reported_one_by_one() -> None:
    assert grouped_failures([], 5) == []
    assert grouped_failures([Note("", "Something else."), Note("", "no.", "30 °C, 20 mm/s")], 5) == [
        "Something else.",
        "30 °C, 20 mm/s: no.",
    ]
    assert grouped_failures([Note("", "no."), Note("", "no.")], 5) == ["2 times: no."]


@pytest.mark.parametrize("count", [1, 2])
def test_remedies_of_failures_are_those_of_who_reads_them(count: int) -> None:
    failures = [Note("sharp-edge", "has a sharp edge; ", "30 °C", Remedy("python.", run_file="file.", page="page."))]
    (of_run_file,), (of_page,) = (grouped_failures(count * failures, 5, reader) for reader in ("run_file", "page"))
    assert (of_run_file[-5:], of_page[-5:]) == ("file.", "page.")
    assert grouped_failures(count * failures, 5) == [of_run_file]


def test_different_reasons_of_one_code_are_different_lines() -> None:
    failures = [Note("unexpected-error", f"unexpectedly, {error}: no.", "30 °C") for error in ("KeyError", "OSError")]
    assert grouped_failures([*failures, failures[0]], 5) == [
        "2 cases (30 °C; 30 °C): unexpectedly, KeyError: no.",
        "30 °C: unexpectedly, OSError: no.",
    ]


def test_many_kinds_of_failure_end_with_the_number_of_the_rest() -> None:
    lines = grouped_failures([Note("", f"reason {letter}.", "30 °C, 20 mm/s") for letter in "abcdefg"], 5)
    assert len(lines) == 5
    assert lines[-1] == "3 more cases, for other reasons: see the report."


def change(tree: xr.DataTree, name: str, variable: str, row: int, value: float) -> None:
    part = tree[name].to_dataset()
    values = part[variable].values.copy()
    values.flat[row] = value
    part[variable] = (part[variable].dims, values, part[variable].attrs)
    tree[name].dataset = part


def test_doubtful_rows_are_marked_and_counted_in_the_headline(tree: xr.DataTree) -> None:
    change(tree, "prediction", "front", 0, 3e-3)
    change(tree, "prediction", "within_measured_frequencies", 1, 0)
    change(tree, "measurement", "within_measured_frequencies", 2, 0)
    tables = {table.key: table for table in detail_tables(tree)}
    assert [row[-1] for row in tables["prediction"].rows[:3]] == ["wide contact", "extrapolated", ""]
    assert [row[-1] for row in tables["measured-and-predicted"].rows[:3]] == ["", "", "extrapolated"]
    assert "remark" not in tables["prediction-master"].headings
    glance = friction_at_a_glance(tree)
    assert glance is not None
    assert [row[1].endswith(" *") for row in glance.rows[:3]] == [True, True, False]
    assert "extends beyond 0.3 of the indenter's radius from its axis" in glance.note
    remark = key_numbers(tree)[0].remark
    assert "doubtful in 1 of 21" in remark
    assert "extrapolated beyond the measured frequencies in 1 of 21" in remark


def test_numerical_errors_that_can_be_seen_are_in_the_headline(tree: xr.DataTree) -> None:
    assert "numerical error" not in key_numbers(tree)[0].remark
    friction = tree["prediction"]["friction_coefficient"].values.flat[2]
    change(tree, "prediction", "friction_error", 2, 0.03 * friction)
    assert "numerical error up to 3.0\N{NO-BREAK SPACE}%" in key_numbers(tree)[0].remark
    change(tree, "prediction", "friction_coefficient", 2, 0.0)
    assert "numerical error as large as friction" in key_numbers(tree)[0].remark


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
    change(tree, "prediction", "speed", -1, 10.0)
    assert "0.1 mm/s to 10 m/s" in scope(tree)[0].replace("\xa0", " ")


def test_scope_says_whether_the_prediction_uses_the_friction(tree: xr.DataTree) -> None:
    assert "The prediction does not use this friction" in " ".join(scope(tree))
    tree = with_friction_shifts(tree)
    tree.attrs["identified_from_friction"] = 1
    asked = " ".join(scope(tree))
    assert "does not use this friction" not in asked
    assert "tests no prediction" in asked


def test_captions_say_what_bands_are(tree: xr.DataTree) -> None:
    assert "95 % band" not in captions(tree)["friction_against_speed"]
    for name in ("prediction", "prediction_master"):
        found = tree[name].to_dataset()
        friction = found["friction_coefficient"]
        tree[name] = xr.DataTree(found.assign(friction_lower=0.98 * friction, friction_upper=1.02 * friction))
    for name in ("friction_against_speed", "friction_master_curve"):
        assert "95 % band from the uncertainty of the material" in captions(tree)[name]


def test_a_thinned_table_names_the_whole_one(make_tree: Callable[..., xr.DataTree]) -> None:
    glance = friction_at_a_glance(make_tree(speeds=30))
    assert glance is not None
    assert "more of them are in the tables below" in glance.caption


def test_scope_says_what_varies(make_study: Callable[..., xr.DataTree]) -> None:
    asked = " ".join(scope(make_study(STUDIES["loads"]))).replace("\N{NO-BREAK SPACE}", " ")
    assert "under 5 to 50 N" in asked
    asked = " ".join(scope(make_study(STUDIES["rubbers"])))
    assert "Varied as well: material (NBR 70 and FKM 75)." in asked


def test_scope_of_a_rough_surface_mentions_no_ball(tree: xr.DataTree, make_sweep: Callable[..., xr.Dataset]) -> None:
    asked = " ".join(scope(rough(make_sweep, tree, 0.01))).replace("\N{NO-BREAK SPACE}", " ")
    assert "under a mean pressure of 50 kPa" in asked
    assert "from the ball" not in asked


def test_agreement_says_whether_the_material_is_counted(tree: xr.DataTree) -> None:
    found = tree["agreement"].to_dataset()
    more = {"bias_error": [0.004, 0.005, 0.006], "share_within_scatter": [1.0, np.nan, 0.5]}
    full = found.assign({name: column(values, "temperature") for name, values in more.items()})
    attributes = {"material_counted": 1, "bias_error": 0.0037, "sentences": json.dumps(["Over 18 points it agrees."])}
    tree["agreement"] = xr.DataTree(full.assign_attrs(attributes))
    table = agreement_table(tree)
    assert table is not None
    assert ", and the uncertainty of the material" in table.note
    row = dict(zip(table.headings, table.rows[1], strict=True))
    assert row["its standard error"] == "0.50\N{NO-BREAK SPACE}%"
    assert row["within the scatter"] == "–"
    (number,) = [item for item in key_numbers(tree) if item.name == "Prediction minus measurement"]
    assert "+0.4\N{NO-BREAK SPACE}% ± 0.37\N{NO-BREAK SPACE}%" in number.remark
    assert "including the material's" in number.remark


def test_scope_and_inputs_say_what_the_material_is_fitted_to(make_tree: Callable[..., xr.DataTree]) -> None:
    tree = make_tree(measurement=False, step_tests_format="delimited text")
    sweeps = tree["isotherms"].to_dataset()
    times = sweeps.rename(angular_frequency="time").assign_attrs(kind="creep")
    for name, group, fitted in (
        ("ramps", sweeps, "temperature ramps in tension: 14 temperatures from −30 °C to 100 °C, 0.63 to 63 rad/s;"),
        ("step_tests", times, "creep tests in tension, read as delimited text: 14 temperatures from −30 °C to 100 °C"),
        ("master_curve", tree["master_curve"].to_dataset(), "a master curve in tension: 14 temperatures"),
    ):
        other = tree.copy()
        del other["isotherms"]
        other[name] = xr.DataTree(group)
        said = scope(other)[1].replace("\N{NO-BREAK SPACE}", " ")
        assert said.startswith(f"The material is fitted to {fitted}")
        assert inputs(other)[0].value.startswith("fitted to ")


def test_logarithms_at_the_reference_are_zero(tree: xr.DataTree) -> None:
    change(tree, "shift_factors", "log10_shift_factor", 6, -7e-18)
    table = shift_factor_table(tree)
    assert table is not None
    assert table.rows[6][table.headings.index("log₁₀ α")] == "0.0000"
