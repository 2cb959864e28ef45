"""Figures of contacts: the pressure leans ahead."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscofric as vf
from viscofric.report.figures.contacts import contacts_figure, shown_contacts
from viscofric.report.figures.convergence import convergence_figure
from viscofric.report.sweeps import cases_of

RUBBER = vf.Material.standard_linear_solid("3 MPa", "30 MPa", "1 ms")
SPEEDS = (1e-3, 1.0, 1e3)  # m/s: slow, about the maximum, fast


def fields_of(solution: Any, **reported: Any) -> xr.Dataset:
    fields = solution.to_dataset()[["pressure", "displacement"]]
    fields.attrs = {}
    units = {"speed": "m/s", "temperature": "K", "load": "N"}
    reported = {"speed": solution.speed, "temperature": 303.15, "load": solution.load, **reported}
    return fields.assign_coords(
        {name: ((), value, {"units": units.get(name, "1")}) for name, value in reported.items()}
    )


@pytest.fixture(scope="module")
def solutions() -> list[Any]:
    solve = {"load": "25 N", "accuracy": 0.03}
    return [vf.solve_steady(RUBBER, vf.Ball("9.525 mm"), speed=speed, **solve) for speed in SPEEDS]


@pytest.fixture
def tree(solutions: list[Any]) -> xr.DataTree:
    friction = [solution.friction_coefficient for solution in solutions]
    prediction = xr.Dataset(
        {"friction_coefficient": ("speed", friction), "friction_error": ("speed", [1e-4 * mu for mu in friction])},
        {"speed": ("speed", list(SPEEDS)), "temperature": 303.15, "load": 25.0},
    )
    fields = {f"/fields/{number}": fields_of(solution) for number, solution in enumerate(solutions, 1)}
    found = xr.DataTree.from_dict({"/prediction": prediction, **fields})
    found.attrs = {"accuracy": 1e-3, "data_origin": "measured"}
    return found


def test_slowest_fastest_and_most_friction_are_shown(tree: xr.DataTree, solutions: list[Any]) -> None:
    shown = shown_contacts(tree)
    assert [contact.title for contact in shown] == ["slowest", "most friction", "fastest"]
    assert [contact.conditions for contact in shown] == ["30 °C, 1 mm/s", "30 °C, 1 m/s", "30 °C, 1000 m/s"]
    for contact, solution in zip(shown, solutions, strict=True):
        assert contact.friction == solution.friction_coefficient
        assert contact.centre_of_pressure == pytest.approx(solution.centre_of_pressure)


def test_contacts_that_coincide_are_shown_once(tree: xr.DataTree) -> None:
    del tree["fields"]["3"]
    assert [contact.title for contact in shown_contacts(tree)] == ["slowest", "most friction, fastest"]
    del tree["fields"]["1"]
    assert [contact.title for contact in shown_contacts(tree)] == [""]


def test_more_friction_than_in_the_kept_contacts_is_not_denied(tree: xr.DataTree) -> None:
    del tree["fields"]["2"]
    titles = [contact.title for contact in shown_contacts(tree)]
    assert titles == ["slowest", "most friction of those shown, fastest"]


@pytest.mark.parametrize("missing", ["prediction", "fields"])
def test_no_group_is_needed(tree: xr.DataTree, missing: str) -> None:
    del tree[missing]
    shown = shown_contacts(tree)
    assert len(shown) == (0 if missing == "fields" else 3 if missing != "prediction" else 2)


def test_friction_is_the_lean_of_the_pressure(tree: xr.DataTree) -> None:
    contact = shown_contacts(tree)[1]
    figure = contacts_figure([contact])
    profile = figure.axes[1]
    centre = next(line for line in profile.lines if line.get_label() == "centre of pressure")
    # μ = x_c / R of a ball (the paraboloid), to what the cells at the edge leave out.
    assert float(centre.get_xdata()[0]) == pytest.approx(9.525 * contact.friction, rel=0.05)


def test_pressures_that_differ_much_are_shown_over_their_means(tree: xr.DataTree) -> None:
    contacts = shown_contacts(tree)
    apart = contacts_figure(contacts)
    assert apart.axes[3].get_ylabel().startswith("pressure over its mean")
    assert "mean pressure" in apart.axes[0].get_title()
    alike = contacts_figure(contacts[:2])
    assert alike.axes[2].get_ylabel() == "pressure $p$ (MPa)"


def test_line_contacts_have_profiles_only() -> None:
    solution = vf.solve_steady(RUBBER, vf.Cylinder("10 mm"), speed="1 m/s", load="1 kN/m", accuracy=0.03)
    fields = fields_of(solution)
    for kept in (fields, fields.isel(y=0, drop=True)):
        tree = xr.DataTree.from_dict({"/fields/1": kept})
        (shown,) = shown_contacts(tree)
        assert shown.is_line
        assert len(contacts_figure([shown]).axes) == 1
        assert math.isnan(shown.friction)


def test_errors_are_drawn_below_the_accuracy_that_was_asked_for(make_sweep: Callable[..., xr.Dataset]) -> None:
    cases = cases_of(make_sweep({"temperature": [303.15, 333.15], "speed": np.geomspace(1e-3, 1.0, 9)}))
    figure = convergence_figure(cases, accuracy=1e-3)
    assert figure is not None
    errors, cells = figure.axes
    shown = {str(line.get_label()): line for line in errors.lines}
    assert set(shown) == {"error estimate", "error estimate, interpolated", "requested accuracy"}
    # The maker of sweeps takes 4e-4 of the friction for its error.
    np.testing.assert_allclose(shown["error estimate"].get_ydata(), 4e-4)
    np.testing.assert_allclose(cells.lines[0].get_ydata(), 256.0)
    assert convergence_figure(cases.isel(case=[0])) is None
