"""Cases of a sweep over their axes: each number where it belongs, with its unit, and nothing made up."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
import xarray

from study.sweeps import RECORD, friction_of, made_outcomes, made_sweep
from viscofric.contact.indenters.shapes import Cylinder
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import NUMBERS, Record
from viscofric.friction.curves import FrictionCurves
from viscofric.study.cases.sweep import Axis, Sweep
from viscofric.study.results.tree import field_groups, material_groups, prediction


def test_every_case_stands_at_its_coordinates() -> None:
    sweep = made_sweep(together=False, materials=("NBR", "EPDM"))
    found = prediction(sweep, made_outcomes(sweep))
    assert found.sizes == {"material": 2, "radius": 2, "load": 2, "temperature": 3, "speed": 3}
    for case in sweep.cases:
        place = {"radius": case.indenter.radius, "load": case.load}  # type: ignore[attr-defined]
        one = found.sel(
            material=("NBR", "EPDM")[case.material], temperature=case.temperature, speed=case.speed, **place
        )
        assert float(one["friction_coefficient"]) == friction_of(case)
    assert set(NUMBERS) | {"interpolated", "failed"} == {*found.data_vars, "speed", "temperature", "load"}
    assert found["interpolated"].values.ravel().tolist() == [number % 2 for number in range(len(sweep.cases))]


def test_what_is_stepped_together_shares_a_dimension() -> None:
    sweep = made_sweep()
    found = prediction(sweep, made_outcomes(sweep))
    assert found["load"].dims == found["radius"].dims == ("load_radius",)
    assert "load_radius" not in found.coords
    for (row, load), temperature in product(enumerate((10.0, 25.0)), found["temperature"].values):
        one = found.isel(load_radius=row).sel(temperature=temperature, speed=0.1)
        assert float(one["load"]) == load
        expected = IndenterCase(0, sweep.cases[9 * row].indenter, temperature, 0.1, load)
        assert float(one["friction_coefficient"]) == friction_of(expected)


def test_axes_of_one_point_are_single_coordinates() -> None:
    sweep = made_sweep(loads=[25.0], radii=[0.01], temperatures=[303.15], together=False)
    found = prediction(sweep, made_outcomes(sweep))
    assert found["friction_coefficient"].dims == ("speed",)
    assert {name: float(found[name]) for name in ("load", "radius", "temperature")} == {
        "load": 25.0,
        "radius": 0.01,
        "temperature": 303.15,
    }
    # A rubber without a name and the best estimate alone tell nothing.
    assert not {"material", "sample"} & set(found.coords)


def test_a_failed_case_is_missing_and_says_so() -> None:
    sweep = made_sweep()
    whole, found = (prediction(sweep, made_outcomes(sweep, failed)) for failed in ((), (4, 17)))
    flat = {name: found[name].values.ravel() for name in found.data_vars}
    assert np.flatnonzero(flat["failed"]).tolist() == [4, 17]
    for name in set(NUMBERS) - {"speed", "temperature", "load"}:
        assert np.flatnonzero(np.isnan(flat[name])).tolist() == [4, 17], name
    left = np.delete(flat["friction_coefficient"], [4, 17])
    np.testing.assert_array_equal(left, np.delete(whole["friction_coefficient"].values.ravel(), [4, 17]))


def test_bands_and_frequencies_of_solved_cases_stand_beside_them() -> None:
    sweep = made_sweep()
    outcomes = made_outcomes(sweep, failed=[2])
    records = [outcome for outcome in outcomes if isinstance(outcome, Record)]
    friction = np.array([record.friction_coefficient for record in records])
    flat = np.ones_like(friction)
    curves = FrictionCurves(
        speed=flat,
        temperature=300.0 * flat,
        load=flat,
        viscoelastic=friction,
        viscoelastic_error=1e-6 * flat,
        viscoelastic_scatter=0.0 * flat,
        replicates=np.ones(len(flat), dtype=np.int64),
        material_error=0.05 * friction,
        viscoelastic_lower=0.9 * friction,
        viscoelastic_upper=1.1 * friction,
    )
    within = [number % 3 == 0 for number in range(len(records))]
    found = prediction(sweep, outcomes, within=within, curves=curves)
    lower, upper = (found[name].values.ravel() for name in ("friction_lower", "friction_upper"))
    mean = found["friction_coefficient"].values.ravel()
    np.testing.assert_array_equal(np.delete(lower, 2), np.delete(0.9 * mean, 2))
    assert np.isnan(upper[2])
    flags = found["within_measured_frequencies"].values.ravel().tolist()
    assert flags.pop(2) == -1
    assert flags == [int(one) for one in within]


def test_a_line_contact_has_a_load_per_length_and_no_half_width() -> None:
    axes = (Axis("load", {"load": (100.0,)}), Axis("speed", {"speed": (0.1, 0.2)}))
    sweep = Sweep(axes, tuple(IndenterCase(0, Cylinder(0.01), 303.15, speed, 100.0) for speed in (0.1, 0.2)))
    found = prediction(sweep, [replace(RECORD, numbers={**RECORD.numbers, "half_width": np.inf})] * 2)
    assert found["load"].attrs["units"] == "N/m"
    assert found["contact_area"].attrs["units"] == "m"
    assert "half_width" not in found


@pytest.mark.parametrize("together", [True, False])
def test_all_numbers_have_units_and_names(together: bool) -> None:
    sweep = made_sweep(materials=("NBR", "EPDM"), together=together)
    found = prediction(sweep, made_outcomes(sweep, failed=[0]))
    for variable in found.variables.values():
        assert variable.attrs["units"]
        assert variable.attrs["long_name"]


def test_fields_know_their_case() -> None:
    sweep = made_sweep(materials=("NBR", "EPDM"))
    groups = field_groups(sweep, made_outcomes(sweep, fields=[0, 13], failed=[5]))
    assert list(groups) == ["/fields/1", "/fields/14"]
    field, case = groups["/fields/14"], sweep.cases[13]
    assert field.attrs["case"] == 14
    assert float(field["load"]) == case.load
    assert float(field["radius"]) == case.indenter.radius  # type: ignore[attr-defined]
    assert (float(field["temperature"]), float(field["speed"])) == (case.temperature, case.speed)
    assert str(field["material"].values) == "NBR"
    assert float(field["pressure"].sel(x=1e-3, y=0.0)) == 1e-3 + 13
    assert field["displacement"].dims == ("x", "y")
    assert all(variable.attrs["units"] for variable in field.variables.values())


def test_groups_of_one_rubber_lie_at_the_root_and_of_several_in_branches() -> None:
    groups = {"/isotherms": xarray.Dataset({"speed": 1.0})}
    alone, about = material_groups([groups], [{"reference_temperature": 303.15}])
    assert (set(alone), about) == ({"/isotherms"}, {"reference_temperature": 303.15})
    several, about = material_groups([groups, groups], [{"name": "NBR"}, {"name": "EPDM / carbon black"}])
    assert set(several) == {f"/materials/{number}{rest}" for number in (1, 2) for rest in ("", "/isotherms")}
    tree = xarray.DataTree.from_dict({"/": xarray.Dataset(attrs=about), **several})
    assert tree["materials/2"].attrs["name"] == "EPDM / carbon black"
