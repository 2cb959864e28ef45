"""Two results beside each other: the same is found to be the same, and every kind of difference is found."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import viscofric as vf
from refusals import refused
from study.sweeps import made_results, made_sweep
from viscofric.errors import DataFileError
from viscofric.notes import codes
from viscofric.study.results.case_table import CaseTable, common_cases
from viscofric.study.results.results import StudyResults

#: Comparisons need no files.
made = partial(made_results, stored=False)


def changed(results: StudyResults, folder: Path, name: str, factor: float, case: int | slice) -> StudyResults:
    """Return results with one number of them, or all of a slice, changed."""
    tree = results.tree.copy(deep=True)
    tree["prediction"][name].values.reshape(-1)[case] *= factor
    return StudyResults(tree, folder)


def difference(found: vf.study.ResultsComparison, name: str) -> Any:
    return next(one for one in found.differences if one.name == name)


@pytest.mark.slow
def test_results_are_the_same_as_themselves(tmp_path: Path) -> None:
    results = made_results(tmp_path, failed=[3])
    found = vf.compare_results(results, tmp_path, tolerance=0.0)
    assert found.equal
    assert (found.cases, found.only_first, found.only_second, found.solved_once) == (18, 0, 0, 0)
    assert found.axes == found.provenance == ()
    assert {one.points for one in found.differences} == {17}
    assert {one.largest for one in found.differences} == {0.0}
    assert results.compare(results).equal


def test_line_contacts_are_the_same_as_themselves_and_no_point_contacts(tmp_path: Path) -> None:
    points = made(tmp_path / "a")
    lines = changed(points, tmp_path / "b", "half_width", np.inf, slice(None))  # as a line contact is stored
    found = vf.compare_results(lines, lines)
    assert found.equal
    assert "half_width" not in {one.name for one in found.differences}
    ends = difference(vf.compare_results(points, lines), "half_width")
    assert not ends.equal
    assert ends.largest == ends.rms == 1.0


@pytest.mark.parametrize("name", ["contact_area_fraction", "corrected_area_fraction", "mean_gap"])
def test_numbers_of_rough_contacts_are_compared(tmp_path: Path, name: str) -> None:
    results = made(tmp_path / "a")
    cases = results.tree["prediction"]
    cases[name] = cases["indentation"].copy(deep=True)
    found = vf.compare_results(results, changed(results, tmp_path / "b", name, 1.05, 7))
    assert [one.name for one in found.differences if not one.equal] == [name]
    assert difference(found, name).in_errors is None  # on their grid, without a stated error


def with_heat(folder: Path, rises: tuple[float, ...] = (2.0, 5.0), coulomb: tuple[float, ...] = (0.2, 0.5)) -> Any:
    """Return results whose cases also have heat, for each Coulomb friction a rise of temperature with its error."""
    results = made(folder)
    tree = results.tree.copy(deep=True)
    cases = tree["prediction"].to_dataset()
    rise = cases["friction_coefficient"].expand_dims(coulomb=list(coulomb)) * 0.0 + np.array(rises).reshape(2, 1, 1, 1)
    group = {"temperature_rise": rise, "temperature_rise_error": 0.0 * rise + 0.1}
    tree["heating"] = xarray.DataTree(xarray.Dataset(group))
    return StudyResults(tree, folder)


@pytest.mark.parametrize(
    ("rises", "coulomb", "equal"),
    [((2.0, 5.0), (0.2, 0.5), True), ((2.0, 5.5), (0.2, 0.5), False), ((2.0, 5.0), (0.2, 0.6), False)],
)
def test_results_of_another_heat_are_different_though_their_isothermal_friction_is_the_same(
    tmp_path: Path, rises: tuple[float, ...], coulomb: tuple[float, ...], equal: bool
) -> None:
    found = vf.compare_results(with_heat(tmp_path / "a"), with_heat(tmp_path / "b", rises, coulomb))
    assert found.equal == equal
    assert found.same_cases == (coulomb == (0.2, 0.5))
    assert difference(found, "friction_coefficient").equal
    assert difference(found, "heating/temperature_rise").equal == (rises == (2.0, 5.0))


def test_results_that_alone_have_heat_are_different(tmp_path: Path) -> None:
    found = vf.compare_results(made(tmp_path / "a"), with_heat(tmp_path / "b"))
    assert (found.equal, found.same_cases) == (False, False)
    assert len(found.axes) == 1


def test_the_largest_difference_is_found_where_it_is(tmp_path: Path) -> None:
    results = made(tmp_path / "a")
    sweep = made_sweep()
    other = changed(results, tmp_path / "b", "friction_coefficient", 1.01, 7)
    found = vf.compare_results(results, other, tolerance=1e-3)
    assert not found.equal
    friction = difference(found, "friction_coefficient")
    assert friction.largest == pytest.approx(0.01 / 1.01)
    assert friction.rms == pytest.approx(0.01 / 1.01 / np.sqrt(18))
    case = sweep.cases[7]
    assert friction.where == {
        "load": case.load,
        "radius": case.indenter.radius,  # type: ignore[attr-defined]
        "temperature": case.temperature,
        "speed": case.speed,
    }
    assert friction.second == pytest.approx(1.01 * friction.first)
    assert difference(found, "max_pressure").equal
    assert vf.compare_results(results, other, tolerance=0.011).equal


@pytest.mark.parametrize(("in_errors", "equal"), [(1.9, True), (2.1, False)])
def test_without_a_tolerance_the_stated_errors_count(tmp_path: Path, in_errors: float, equal: bool) -> None:
    results = made(tmp_path / "a")
    # Both state 1e3 Pa of 1e6 Pa: together √2 times as much.
    other = changed(results, tmp_path / "b", "max_pressure", 1.0 + in_errors * np.sqrt(2.0) * 1e-3, 4)
    found = vf.compare_results(results, other)
    assert found.equal is equal
    assert difference(found, "max_pressure").in_errors == pytest.approx(in_errors)


def test_what_has_no_error_of_its_own_agrees_within_the_accuracy(tmp_path: Path) -> None:
    results = made(tmp_path / "a")
    for factor, equal in ((1.0019, True), (1.0021, False)):
        other = changed(results, tmp_path / "b", "centre_of_pressure", factor, 0)
        assert vf.compare_results(results, other).equal is equal


def test_a_beyond_small_error_is_pointed_at_rather_than_a_larger_one_within(tmp_path: Path) -> None:
    results = made(tmp_path / "a")
    tree = results.tree.copy(deep=True)
    prediction = tree["prediction"]
    prediction["indentation_error"].values.reshape(-1)[2] = 1.0
    prediction["indentation"].values.reshape(-1)[2] *= 1.5
    prediction["indentation"].values.reshape(-1)[11] *= 1.01
    other = StudyResults(tree, tmp_path / "b")
    indentation = difference(vf.compare_results(results, other), "indentation")
    assert indentation.largest == pytest.approx(1 / 3)
    assert indentation.second / indentation.first == pytest.approx(1.01)
    assert not indentation.equal


def test_order_and_extent_of_axes_do_not_matter_to_cases_in_common(tmp_path: Path) -> None:
    whole = made(tmp_path / "a", made_sweep(together=False))
    turned = made_sweep(
        loads=[25.0], radii=[0.01], speeds=(0.2, 0.1, 0.4), temperatures=(363.15, 303.15), together=False
    )
    found = vf.compare_results(whole, made(tmp_path / "b", turned), tolerance=0.0)
    assert not found.equal
    assert (found.cases, found.only_first, found.only_second) == (4, 32, 2)
    assert all(one.equal for one in found.differences)
    assert any("speed" in sentence and "400 mm/s" in sentence for sentence in found.axes)


def test_coordinates_that_differ_by_rounding_are_the_same(tmp_path: Path) -> None:
    speeds = (0.1, 0.2)
    other = made_sweep(speeds=[speed * (1.0 + 1e-14) for speed in speeds])
    pair = [made(tmp_path / name, sweep) for name, sweep in (("a", made_sweep(speeds=speeds)), ("b", other))]
    assert vf.compare_results(*pair).cases == 12


@pytest.mark.parametrize(
    ("name", "one", "other", "line"),
    [
        ("speed", 0.02, 0.0200001, False),
        ("speed", 2.0, 2.0000001, False),
        ("temperature", 303.15, 303.150001, False),
        ("load", 10.0, 10.0000001, False),
        ("load", 1000.0, 1000.00001, True),
        ("radius", 0.01, 0.01000001, False),
        ("seed", 1234567.0, 1234568.0, False),
    ],
)
def test_values_that_count_as_different_are_shown_as_different(name: str, one: float, other: float, line: bool) -> None:
    tables = [
        CaseTable(
            name, (name,), {name: np.array([1.5 * one, value])}, {name: "N/m" if line else "1"}, np.ones(2, dtype=bool)
        )
        for value in (one, other)
    ]
    (remark,) = common_cases(*tables).remarks
    first, second = re.findall(r"such as ([^)]*)", remark)
    assert first != second
    assert all(("N/mm" in words) == line for words in (first, second))


def test_cases_that_one_only_solved_are_counted(tmp_path: Path) -> None:
    found = vf.compare_results(made(tmp_path / "a", failed=[1]), made(tmp_path / "b", failed=[2]))
    assert found.solved_once == 2
    assert not found.equal


def test_other_provenance_is_named(tmp_path: Path) -> None:
    text = 'title = "made-up cases"\n[conditions]\nload = "30 N"\n'
    other = made_results(
        tmp_path / "b",
        accuracy=1e-2,
        study_text=text,
        input_hashes=json.dumps({"elsewhere/dma.csv": "1" * 64, "mtm.csv": "2" * 64}),
        viscofric_version="0.0.1",
        software=json.dumps({"numpy": "1.0"}),
    )
    said = vf.compare_results(made(tmp_path / "a"), other).provenance
    for named in (
        ("0.001", "0.01"),
        ("dma.csv",),
        ("mtm.csv",),
        ("conditions.load", "25 N", "30 N"),
        ("viscofric", "numpy"),
    ):
        assert sum(all(name in sentence for name in named) for sentence in said) == 1, named


def test_the_same_input_elsewhere_is_the_same(tmp_path: Path) -> None:
    moved = made(tmp_path / "b", input_hashes=json.dumps({"another/folder/dma.csv": "0" * 64}))
    assert vf.compare_results(made(tmp_path / "a"), moved).provenance == ()


def test_friction_curves_are_compared_with_results(tmp_path: Path) -> None:
    results = made(tmp_path, made_sweep(loads=[25.0], radii=[0.01]))
    cases = results.dataset.stack(case=["temperature", "speed"])
    friction = cases["friction_coefficient"].values
    curves = vf.FrictionCurves(
        speed=cases["speed"].values,
        temperature=cases["temperature"].values,
        load=np.full(9, 25.0),
        viscoelastic=friction,
        viscoelastic_error=1e-6 * np.ones(9),
        viscoelastic_scatter=np.zeros(9),
        replicates=np.ones(9, dtype=np.int64),
    )
    vf.write_friction_curves(curves, tmp_path / "curves.csv")
    for given in (curves, tmp_path / "curves.csv"):
        found = vf.compare_results(results, given)
        assert found.equal
        assert [one.name for one in found.differences] == ["friction_coefficient"]
        assert any("radius" in sentence for sentence in found.axes)
        assert codes(found.provenance) == {"no-provenance"}
    off = replace(curves, viscoelastic=1.001 * friction)
    assert not vf.compare_results(off, results).equal


def test_what_cannot_be_paired_is_reported(tmp_path: Path) -> None:
    one = made_results(tmp_path / "a")
    cold = made(tmp_path / "b", made_sweep(temperatures=[253.15]))
    with refused("no-common-cases"):
        vf.compare_results(one, cold)
    several = made(tmp_path / "c", made_sweep(materials=("NBR", "EPDM")))
    with refused("no-common-cases"):
        vf.compare_results(one, several)
    with refused("tolerance"):
        vf.compare_results(one, one, tolerance=-1.0)
    with refused("no-results", DataFileError):
        vf.compare_results(one, tmp_path)


def test_an_exported_table_of_one_load_is_one_of_friction_curves(tmp_path: Path) -> None:
    results = made(tmp_path, made_sweep(loads=[25.0], radii=[0.01]))
    curves = vf.read_friction_curves(results.to_csv(tmp_path / "cases.csv"))
    np.testing.assert_array_equal(curves.viscoelastic, results.dataset["friction_coefficient"].values.ravel())
    np.testing.assert_array_equal(curves.viscoelastic_error, results.dataset["friction_error"].values.ravel())
