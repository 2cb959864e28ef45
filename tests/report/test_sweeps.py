"""Axes of a study are named, thinned and laid out so that a figure of them can be read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import xarray as xr

from viscofric.report.figures.sweeps import panel_count, panel_points
from viscofric.report.sweeps import (
    axis_of,
    best_estimate,
    cases_of,
    layout_of,
    solved_cases,
    sweep_axes,
    thinned,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    Make = Callable[..., xr.Dataset]

SPEEDS, TEMPERATURES = np.geomspace(1e-3, 1.0, 5), np.array([303.15, 333.15, 363.15])


def test_points_are_named_with_their_units(make_sweep: Make) -> None:
    friction = make_sweep({"material": ["NBR", "FKM"], "load": [5.0, 25.0], "radius": [0.002, 0.01], "speed": SPEEDS})
    labels = {axis.name: axis.labels for axis in sweep_axes(friction)}
    assert labels["material"] == ("NBR", "FKM")
    assert labels["load"] == ("5 N", "25 N")
    assert labels["radius"] == ("2 mm", "10 mm")
    assert labels["speed"][0] == "1 mm/s"
    assert labels["speed"][-1] == "1 m/s"


def test_what_is_stepped_together_is_named_together(make_sweep: Make) -> None:
    friction = make_sweep({"load": [5.0, 25.0], "speed": SPEEDS}).rename_dims(load="load_radius")
    friction = friction.assign_coords(radius=("load_radius", [0.002, 0.01], {"units": "m"}))
    axis = axis_of(friction, "load_radius")
    assert axis.title == "load and radius"
    assert axis.labels == ("5 N, 2 mm", "25 N, 10 mm")
    assert axis.axis_label == "load $F$ (N), with radius"


@pytest.mark.parametrize(
    ("axes", "along", "lines", "panels"),
    [
        ({"temperature": TEMPERATURES, "speed": SPEEDS}, "speed", "temperature", []),
        ({"load": [5.0, 25.0], "temperature": TEMPERATURES, "speed": SPEEDS}, "speed", "temperature", ["load"]),
        ({"load": [5.0, 25.0], "speed": SPEEDS}, "speed", "load", []),
        ({"load": [5.0, 25.0]}, "load", None, []),
        ({"radius": [0.002, 0.005, 0.01], "load": [5.0, 25.0]}, "radius", "load", []),
        ({"material": ["NBR", "FKM"]}, "material", None, []),
        ({"material": ["NBR", "FKM"], "load": [5.0, 25.0]}, "load", "material", []),
    ],
)
def test_speed_runs_along_the_axis_and_temperatures_are_lines(
    make_sweep: Make, axes: dict[str, Any], along: str, lines: str | None, panels: list[str]
) -> None:
    layout = layout_of(make_sweep(axes))
    assert layout is not None
    assert layout.along.name == along
    assert (None if layout.lines is None else layout.lines.name) == lines
    assert [axis.name for axis in layout.panels] == panels


def test_a_single_case_has_no_layout(make_sweep: Make) -> None:
    assert layout_of(make_sweep({"speed": SPEEDS}).isel(speed=0)) is None


def test_thinned_points_keep_both_ends() -> None:
    assert thinned(3, 8) == [0, 1, 2]
    some = thinned(20, 8)
    assert len(some) == 8
    assert (some[0], some[-1]) == (0, 19)


def test_panels_are_thinned_along_their_longest_axis(make_sweep: Make) -> None:
    friction = make_sweep({"load": [1.0, 2.0, 3.0, 4.0], "radius": [0.01, 0.02, 0.03, 0.04], "speed": SPEEDS})
    panels = [axis_of(friction, name) for name in ("load", "radius")]
    points = panel_points(panels, 9)
    assert panel_count(panels, 9) == (9, 16)
    assert {place["load"] for place in points} == {place["radius"] for place in points}
    assert {"load": 0, "radius": 0} in points
    assert {"load": 3, "radius": 3} in points


def test_cases_stand_in_the_order_of_the_axes(make_sweep: Make) -> None:
    friction = make_sweep({"load": [5.0, 25.0], "temperature": TEMPERATURES, "speed": SPEEDS}, thickness=0.01)
    cases = cases_of(friction)
    assert dict(cases.sizes) == {"case": 30}
    np.testing.assert_allclose(cases["speed"].values[:5], SPEEDS)
    assert cases["load"].values.tolist() == [5.0] * 15 + [25.0] * 15
    assert set(cases["thickness"].values) == {0.01}
    np.testing.assert_array_equal(cases["friction_coefficient"], friction["friction_coefficient"].values.ravel())
    assert cases["load"].attrs["units"] == "N"


def test_one_case_is_a_row(make_sweep: Make) -> None:
    cases = cases_of(make_sweep({"speed": SPEEDS}).isel(speed=2))
    assert dict(cases.sizes) == {"case": 1}
    np.testing.assert_allclose(cases["speed"], SPEEDS[2])


def test_failed_cases_and_samples_do_not_count_as_solved(make_sweep: Make) -> None:
    friction = make_sweep({"sample": [0, 1, 2], "speed": SPEEDS}, failed=(1,))
    tree = xr.DataTree.from_dict({"/prediction": friction})
    cases = solved_cases(tree)
    assert cases is not None
    np.testing.assert_allclose(cases["speed"], SPEEDS[[0, 2, 3, 4]])
    assert dict(best_estimate(friction).sizes) == {"speed": 5}
    nothing = xr.DataTree.from_dict({"/prediction": make_sweep({"speed": SPEEDS}, failed=tuple(range(5)))})
    assert solved_cases(nothing) is None
