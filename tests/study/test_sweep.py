"""The cases of a study: all combinations of its axes, those that go together stepped as one."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import viscofric as vf
from viscofric.errors import StudyError
from viscofric.friction.cases.indenter_case import IndenterCase as Case
from viscofric.study.cases.sweep import axes_of, count_cases
from viscofric.study.run_file.study import Study, parse_study

MATERIAL = '[material]\ncatalogue = "synthetic fluoroelastomer"\n'
TWO = (
    '[[material]]\nname = "a"\ncatalogue = "synthetic fluoroelastomer"\n'
    '[[material]]\nname = "b"\ncatalogue = "PVB interlayer"\n'
)
CONDITIONS = """
[conditions]
load = ["1 N", "4 N"]
speed = { from = "1 mm/s", to = "1 m/s", points = 4 }
temperature = ["30 degC", "60 degC", "90 degC"]
"""
BALLS = '[indenter]\nradius = ["5 mm", "10 mm"]\n'


def study(text: str) -> Study:
    return parse_study(text, Path("study.toml"))


def mistakes(text: str) -> list[str]:
    """Return the places of what is wrong in a run file."""
    with pytest.raises(StudyError) as caught:
        study(text)
    return [one.where for one in caught.value.mistakes]


def test_all_combinations_are_cases_and_speed_runs_fastest() -> None:
    sweep = study(TWO + BALLS + CONDITIONS).sweep()
    assert sweep.dimensions == ("material", "sample", "radius", "load", "temperature", "speed")
    assert sweep.shape == (2, 1, 2, 2, 3, 4)
    assert len(sweep.cases) == math.prod(sweep.shape)
    values = [axis.columns[axis.name] for axis in sweep.axes]
    expected = itertools.product(range(2), (None,), *values[2:])
    assert [_values(case) for case in sweep.cases] == list(expected)
    assert sweep.axes[0].columns == {"material": ("a", "b")}
    assert sweep.axes[5].columns["speed"] == pytest.approx((1e-3, 1e-2, 1e-1, 1.0), rel=1e-12)
    assert sweep.axes[4].columns["temperature"] == pytest.approx((303.15, 333.15, 363.15), rel=1e-15)


def _values(case: Case) -> tuple[object, ...]:
    assert isinstance(case.indenter, vf.Ball)
    return (case.material, case.sample, case.indenter.radius, case.load, case.temperature, case.speed)


def test_what_goes_together_is_one_axis_where_its_first_coordinate_stands() -> None:
    sweep = study(MATERIAL + BALLS + CONDITIONS + '[sweep]\ntogether = [["load", "radius"]]').sweep()
    assert sweep.dimensions == ("material", "sample", "load_radius", "temperature", "speed")
    (joined,) = [axis for axis in sweep.axes if axis.name == "load_radius"]
    assert joined.columns == {"load": (1.0, 4.0), "radius": (5e-3, 1e-2)}
    pairs = {(case.load, case.indenter.radius) for case in sweep.cases}  # type: ignore[attr-defined]
    assert pairs == {(1.0, 5e-3), (4.0, 1e-2)}
    assert len(sweep.cases) == 2 * 3 * 4


def test_materials_may_go_together_with_their_temperatures() -> None:
    text = TWO + BALLS + CONDITIONS.replace(', "90 degC"', "") + '[sweep]\ntogether = [["material", "temperature"]]'
    cases = study(text).sweep().cases
    assert {(case.material, case.temperature) for case in cases} == {(0, 303.15), (1, 333.15)}


def test_cylinder_layer_and_elastic_indenter_reach_every_case() -> None:
    text = MATERIAL + '[indenter]\nshape = "cylinder"\nradius = "1 cm"\nmodulus = "3 GPa"\npoisson_ratio = 0.4\n'
    text += '[layer]\nthickness = ["1 mm", "3 mm"]\nbase = "sliding"\n'
    text += CONDITIONS.replace('["1 N", "4 N"]', '"2 N/mm"')
    sweep = study(text).sweep()
    assert sweep.dimensions == ("material", "sample", "radius", "thickness", "load", "temperature", "speed")
    for case in sweep.cases:
        assert case.indenter == vf.Cylinder(1e-2)
        assert (case.load, case.modulus, case.poisson_ratio) == (2000.0, 3e9, 0.4)
        assert type(case.load) is float
        assert case.layer is not None
        assert not case.layer.bonded
    assert {case.layer.thickness for case in sweep.cases if case.layer} == {1e-3, 3e-3}


def test_other_shapes_have_axes_of_their_own() -> None:
    ellipsoid = '[indenter]\nshape = "ellipsoid"\nradius_x = "1 mm"\nradius_y = ["1 mm", "4 mm"]\n'
    sweep = study(MATERIAL + ellipsoid + CONDITIONS).sweep()
    assert sweep.dimensions[2:4] == ("radius_x", "radius_y")
    assert {case.indenter for case in sweep.cases} == {vf.Ellipsoid(1e-3, 1e-3), vf.Ellipsoid(1e-3, 4e-3)}
    cone = '[indenter]\nshape = "cone"\nangle = { from = "1 deg", to = "5 deg", points = 3, spacing = "linear" }\n'
    sweep = study(MATERIAL + cone + CONDITIONS).sweep()
    assert sweep.axes[2].columns["angle"] == pytest.approx([math.radians(degrees) for degrees in (1, 3, 5)])
    assert mistakes(MATERIAL + cone.replace('"5 deg"', '"95 deg"') + CONDITIONS) == ["indenter.angle"]


def test_members_are_an_axis_that_begins_with_the_best_estimate() -> None:
    sweeps = '[material]\ndma = "dma.csv"\nreference_temperature = "30 degC"\n'
    sweep = study(sweeps + BALLS + CONDITIONS + "[uncertainty]\nmembers = 3").sweep()
    assert sweep.axes[1].columns == {"sample": (0, 1, 2, 3)}
    assert {case.sample for case in sweep.cases} == {None, 1, 2, 3}
    assert mistakes(MATERIAL + BALLS + CONDITIONS + "[uncertainty]\nmembers = 3") == ["uncertainty.members"]


@given(
    st.lists(st.integers(1, 5), min_size=1, max_size=5),
    st.lists(st.integers(0, 4), min_size=2, max_size=3, unique=True),
)
def test_count_is_that_of_the_product(lengths: list[int], group: list[int]) -> None:
    known = {f"x{place}": tuple(float(value) for value in range(length)) for place, length in enumerate(lengths)}
    inside = [f"x{place}" for place in group if place < len(lengths)]
    for name in inside:
        known[name] = known[inside[0]]
    axes = axes_of(known, [inside] if inside else [])
    names = [name for axis in axes for name in axis.columns]
    assert sorted(names) == sorted(known)
    assert count_cases(axes) == len(list(itertools.product(*(range(len(axis)) for axis in axes))))


def test_loads_are_those_of_the_shape() -> None:
    cylinder = BALLS + 'shape = "cylinder"\n'
    assert mistakes(MATERIAL + cylinder + CONDITIONS) == ["conditions.load"]
    mixed = CONDITIONS.replace('"4 N"', '"4 N/mm"')
    assert mistakes(MATERIAL + BALLS + mixed) == ["conditions.load[1]"]


def test_too_many_cases_are_refused_before_any_is_made() -> None:
    text = (
        TWO
        + BALLS
        + CONDITIONS.replace("points = 4", "points = 10_000").replace(
            '["30 degC", "60 degC", "90 degC"]', '{ from = "0 degC", to = "90 degC", points = 10_000 }'
        )
    )
    with pytest.raises(StudyError) as caught:
        study(text)
    assert [one.code for one in caught.value.mistakes] == ["contradiction"]
    assert "800,000,000 cases" in str(caught.value)


def test_several_materials_have_different_names() -> None:
    assert mistakes(TWO.replace('name = "b"\n', "") + BALLS + CONDITIONS) == ["material[1].name"]
    assert mistakes(TWO.replace('"b"', '"a"') + BALLS + CONDITIONS) == ["material[0].name", "material[1].name"]


def test_mistakes_of_tables_and_between_tables_are_reported_together() -> None:
    text = TWO.replace('"b"', '"a"') + BALLS + CONDITIONS + '[solver]\naccuracy = "high"\n[layr]\n'
    text += '[sweep]\ntogether = [["load", "temperature"]]'
    places = ["solver.accuracy", "layr", "material[0].name", "material[1].name", "sweep.together[0]"]
    assert sorted(mistakes(text)) == sorted(places)


FEW = """
[conditions]
load = "5 N"
speed = {speed}
temperature = "60 degC"
[indenter]
radius = "9.525 mm"
[solver]
accuracy = 5e-2
cases = "{cases}"
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("speed", "cases", "contacts"),
    [
        ('"0.1 m/s"', "curves", 1),
        ('"0.1 m/s"', "each", 1),
        ('["0.1 m/s", "0.2 m/s", "0.4 m/s"]', "each", 3),
    ],
)
def test_no_more_contacts_are_solved_than_cases_asked_for(
    tmp_path: Path, speed: str, cases: str, contacts: int
) -> None:
    path, solved = tmp_path / "study.toml", []
    path.write_text(MATERIAL + FEW.format(speed=speed, cases=cases))
    results = vf.run_study(path, progress=lambda event: solved.append(event.key) if event.event == "solved" else None)
    assert len(solved) == contacts
    assert not results.dataset["interpolated"].values.any()
    assert "prediction_master" not in results.tree.children


@pytest.mark.slow
def test_a_master_curve_is_solved_where_it_is_asked_for(tmp_path: Path) -> None:
    path, solved = tmp_path / "study.toml", []
    path.write_text(MATERIAL + FEW.format(speed='["0.1 m/s", "0.2 m/s"]', cases="each") + "master_curve_points = 3\n")
    results = vf.run_study(path, progress=lambda event: solved.append(event.key) if event.event == "solved" else None)
    assert len(solved) == 2 + 3
    assert results.tree["prediction_master"].sizes == {"case": 3}
