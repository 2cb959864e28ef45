"""Predictions at many speeds: interpolated between few contacts, within their errors of those that are solved."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.friction.planning import shared
from viscofric.notes import codes

SOLID = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="20 MPa", tau="5 ms")
RUBBER = replace(SOLID, shift=vf.WLF(C1=8.86, C2=101.6, reference="50 degC"))
CYLINDER = {"indenter": vf.Cylinder("10 mm"), "load": "200 N/m", "accuracy": 1e-2}
SPEEDS = np.geomspace(0.02, 2.0, 200)


@pytest.fixture
def counted(monkeypatch):
    """Contacts that are solved for curves."""
    solved = []
    solve = shared.solve
    monkeypatch.setattr(shared, "solve", lambda task: solved.append(task) or solve(task))
    return solved


def test_many_speeds_take_few_contacts_and_are_within_their_errors(counted):
    curves = vf.predict_friction(RUBBER, **CYLINDER, speeds=SPEEDS, temperatures="60 degC")
    assert 0 < len(counted) < 20
    rows = [3, 50, 101, 148, 199]
    each = vf.predict_friction(RUBBER, **CYLINDER, speeds=SPEEDS[rows], temperatures="60 degC", exact=True)
    allowed = curves.viscoelastic_error[rows] + each.viscoelastic_error
    assert np.all(np.abs(curves.viscoelastic[rows] - each.viscoelastic) <= allowed)
    assert np.all(curves.viscoelastic_error <= 1e-2 * curves.viscoelastic)
    # An area has an error of one part in a hundred here.
    assert curves.mean_pressure[rows] == pytest.approx(each.mean_pressure, rel=2e-2)
    assert curves.load_unit == "N/m"


def test_temperatures_share_the_contacts_of_one_curve(counted):
    """Ten kelvin shift this curve by a part of its length: both need little more than one."""
    vf.predict_friction(RUBBER, **CYLINDER, speeds=SPEEDS, temperatures="60 degC")
    one = len(counted)
    both = vf.predict_friction(RUBBER, **CYLINDER, speeds=SPEEDS, temperatures=["60 degC", "70 degC"])
    assert len(both) == 2 * len(SPEEDS)
    assert len(counted) - one < 1.5 * one


def test_every_contact_is_solved_where_it_is_asked_for_or_has_settings_of_its_own(counted):
    few = {"speeds": np.geomspace(0.1, 0.12, 6), "temperatures": "60 degC"}
    vf.predict_friction(RUBBER, **CYLINDER, **few, exact=True)
    vf.predict_friction(RUBBER, **CYLINDER, **few, direction=(-1.0, 0.0))
    assert not counted
    shared_out = vf.predict_friction(RUBBER, **CYLINDER, **few, indenter_modulus="210 GPa", layer=vf.Layer("20 mm"))
    assert counted
    alone = vf.predict_friction(
        RUBBER, **CYLINDER, **few, exact=True, indenter_modulus="210 GPa", layer=vf.Layer("20 mm")
    )
    allowed = shared_out.viscoelastic_error + alone.viscoelastic_error
    assert np.all(np.abs(shared_out.viscoelastic - alone.viscoelastic) <= allowed)


def test_progress_grows_to_the_number_of_speeds():
    calls: list[tuple[int, int]] = []
    vf.predict_friction(
        RUBBER, **CYLINDER, speeds=SPEEDS, temperatures="60 degC", progress=lambda *one: calls.append(one)
    )
    done = [one for one, _ in calls]
    assert done[0] == 0
    assert done[-1] == len(SPEEDS)
    assert done == sorted(done)
    assert len(set(done)) > 5
    assert {total for _, total in calls} == {len(SPEEDS)}


def test_a_contact_wider_than_its_indenter_is_refused_as_alone():
    narrow = vf.Profile(np.linspace(-1e-3, 1e-3, 81) ** 2 / 0.02, spacing=2.5e-5)
    wanted = {"load": "5 kN/m", "speeds": np.geomspace(0.1, 0.12, 10), "temperatures": "60 degC", "accuracy": 1e-2}
    with pytest.raises(vf.InputError) as alone:
        vf.predict_friction(RUBBER, narrow, **wanted, exact=True)
    with refused(alone.value.code):
        vf.predict_friction(RUBBER, narrow, **wanted)


@pytest.mark.parametrize("exact", [False, True])
def test_an_error_of_some_contacts_names_its_conditions_and_has_the_curve_of_the_others(exact):
    narrow = vf.Profile(np.linspace(-1e-3, 1e-3, 81) ** 2 / 0.02, spacing=2.5e-5)
    speeds = np.array([1e-3, 2e-3, 20.0, 40.0, 80.0])  # the rubber is twenty times as stiff at the last three
    wanted = {"temperatures": "60 degC", "accuracy": 1e-2, "exact": exact}
    with refused("beyond-indenter") as info:
        vf.predict_friction(RUBBER, narrow, loads=["200 N/m", "250 N/m"], speeds=speeds, **wanted)
    solved = info.value.solved
    np.testing.assert_allclose(solved.speed, [*speeds[2:], *speeds[2:]])
    np.testing.assert_allclose(solved.load, [200.0] * 3 + [250.0] * 3)
    first = vf.predict_friction(RUBBER, narrow, load="200 N/m", speeds=speeds[2:], **wanted)
    np.testing.assert_array_equal(solved.viscoelastic[:3], first.viscoelastic)
    assert info.value.note.where == "60 °C, 1 mm/s, 200 N/m"
    assert "unsolved" in codes(solved.notes)
    assert np.all(solved.viscoelastic_error > 0.0)
