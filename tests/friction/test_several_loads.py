"""Predictions at several loads, and without a temperature."""

import numpy as np
import pytest

import viscofric as vf
from refusals import refused

RUBBER = vf.synthetic_fluoroelastomer()
CASE = {"speeds": ["0.1 m/s", "1 m/s"], "accuracy": 1e-2}
CYLINDER = vf.Cylinder("10 mm")


def test_several_loads_are_those_of_single_predictions() -> None:
    steps: list[tuple[int, int]] = []
    law = vf.friction.ConstantShearStress("10 kPa")
    two = {"temperatures": ["30 degC", "60 degC"], "interface": law, "layer": "5 mm"}
    found = vf.predict_friction(
        RUBBER, CYLINDER, **CASE, **two, loads=["500 N/m", "1 N/mm"], progress=lambda *now: steps.append(now)
    )
    alone = [vf.predict_friction(RUBBER, CYLINDER, **CASE, **two, load=load) for load in (500.0, 1000.0)]
    for name in ("viscoelastic", "coulomb", "load", "temperature", "speed", "mean_pressure"):
        assert np.array_equal(getattr(found, name), np.concatenate([getattr(one, name) for one in alone])), name
    assert set(found.notes) == {note for one in alone for note in one.notes}
    assert found.to_dataset()["viscoelastic"].dims == ("load", "temperature", "speed")
    assert steps[0] == (0, 8)
    assert steps[-1] == (8, 8)
    assert [done for done, _ in steps] == sorted(done for done, _ in steps)


def test_one_load_or_several_must_be_given() -> None:
    for loads in ({}, {"load": 1.0, "loads": [1.0]}):
        with refused("give-one"):
            vf.predict_friction(RUBBER, CYLINDER, **CASE, temperatures=300.0, **loads)
    with refused("empty-list"):
        vf.predict_friction(RUBBER, CYLINDER, **CASE, temperatures=300.0, loads=[])
    with refused("wrong-unit"):
        vf.predict_friction(RUBBER, CYLINDER, **CASE, temperatures=300.0, loads=["5 N"])


def test_temperature_left_out_is_the_reference_of_the_material() -> None:
    found = vf.predict_friction(RUBBER, CYLINDER, **CASE, load=500.0)
    assert found.temperature == pytest.approx(RUBBER.reference)
    one = vf.solve_steady(RUBBER, CYLINDER, speed="1 m/s", load=500.0, accuracy=1e-2)
    assert found.friction_coefficient[1] == pytest.approx(one.friction_coefficient, rel=1e-2)
    with refused("no-shift"):
        vf.predict_friction(vf.Material(RUBBER.spectrum), CYLINDER, **CASE, load=500.0)
