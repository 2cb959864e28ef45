"""What contacts over time say to people: the sentences of their errors and notes."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import viscofric as vf

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
BALL = vf.Ball("10 mm")
PRESSED = vf.motion.History([0.0, 1.0], load=1.0)

SENTENCES: list[tuple[Callable[[], object], str, str]] = [
    (
        lambda: vf.motion.History([0.0, 2.0, 1.0], load=1.0),
        "time-goes-back",
        "time: goes back from 2 s to 1 s; sort the history by time.",
    ),
    (
        lambda: vf.motion.History([0.0, 1.0]),
        "give-one",
        "load, indentation, pressure, gap: none of them given; give exactly one of them.",
    ),
    (
        lambda: vf.motion.History([0.0, 1.0], load=[1.0, -1.0]),
        "negative-load",
        "load = -1 N at time 1 s: must not be below zero; adhesion is not part of the model.",
    ),
    (
        lambda: vf.motion.History([0.0, 1.0, 2.0], load=[1.0, 2.0]),
        "wrong-length",
        "load: has the shape (2,), but there are 3 times; give one value, or one for each time.",
    ),
    (
        lambda: vf.motion.History([0.0, 1.0, 1.0], load=1.0, position=[0.0, 1.0, 2.0]),
        "position-jump",
        "position: jumps at time 1 s; only loads, depths, speeds and temperatures may jump.",
    ),
    (
        lambda: vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], pressure=1.0)),
        "wrong-control",
        "pressure: cannot be prescribed in a point contact; give load or indentation.",
    ),
    (
        lambda: vf.motion.solve_transient(RUBBER, BALL, PRESSED, times=[2.0]),
        "out-of-range",
        "times: 2 s lies outside the history, 0 to 1 s.",
    ),
    (
        lambda: vf.motion.solve_impact(RUBBER, BALL, mass=100.0, speed=10.0, accuracy=1e-2),
        "beyond-indenter",
        "at 10 m/s the contact would be about 116 mm wide, wider than the ball (20 mm); reduce the mass or the speed.",
    ),
    (
        lambda: vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], indentation=0.02), times=[0.0]),
        "beyond-indenter",
        "under 5028.31 N the contact would be about 28.3 mm wide, wider than the ball (20 mm); reduce the indentation.",
    ),
    (
        lambda: vf.motion.solve_impact(RUBBER, vf.Ellipsoid("1 mm", "2 mm"), mass=1.0, speed=1.0),
        "not-available",
        (
            "indenter: the ellipsoid is no body of revolution; available: a ball, a cone or another body of revolution "
            "that falls along its axis."
        ),
    ),
]


@pytest.mark.parametrize(
    ("call", "code", "sentence"), SENTENCES, ids=[f"{code}-{n}" for n, (_, code, _) in enumerate(SENTENCES)]
)
def test_sentence(call: Callable[[], object], code: str, sentence: str) -> None:
    with pytest.raises(vf.InputError) as caught:
        call()
    assert (caught.value.code, str(caught.value)) == (code, sentence)


def test_waves_of_an_impact_are_said_with_their_effect() -> None:
    hit = vf.motion.solve_impact(RUBBER, BALL, mass=0.033, speed=0.7)
    (note,) = (one for one in hit.notes if one.code == "quasi-static")
    assert note == (
        "Inertia of the rubber is left out. With 1150 kg/m³ shear waves run at 18 m/s, and where it is thicker than "
        "57 mm, waves take about 13 % of the energy of the rebound and lower the restitution from 0.56 to about 0.53 "
        "(good if ≤ 5 %); in slower motion it does not matter."
    )
