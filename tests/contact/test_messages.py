"""What contacts say to people: the sentences of their errors and notes."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.coupling import ShearedContact, coupling_notes

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
BALL, CYLINDER = vf.Ball("10 mm"), vf.Cylinder("10 mm")
BOWL = vf.HeightMap(np.square(np.linspace(-1e-4, 1e-4, 9))[:, None] + np.square(np.linspace(-1e-4, 1e-4, 9)), 25e-6)
WAVE = vf.contact.PeriodicSurface(1e-6 * np.cos(2.0 * np.pi * np.arange(16) / 16), spacing=1e-4)


def solve(indenter: vf.Ball | vf.Cylinder | vf.FlatPunch | vf.HeightMap = BALL, **settings: object) -> None:
    vf.solve_steady(RUBBER, indenter, **{"speed": 1.0, "load": 1.0, "accuracy": 0.1, **settings})  # type: ignore[arg-type]


SENTENCES: list[tuple[Callable[[], object], str, str]] = [
    (
        lambda: solve(load="1 MN", speed=0.0),
        "beyond-indenter",
        ("under 1e+06 N the contact would be about 333 mm wide, wider than the ball (20 mm); reduce the load."),
    ),
    (
        lambda: solve(BOWL),
        "beyond-indenter",
        (
            "under 1 N the contact reaches the edge of the height map; give the heights of a larger piece of the "
            "surface, or reduce the load."
        ),
    ),
    (
        lambda: solve(indentation="1 mm"),
        "give-one",
        "load and indentation: both given; give exactly one of them.",
    ),
    (
        lambda: solve(CYLINDER, load=None, indentation=1e-5),
        "no-level",
        (
            "indentation = 1e-05: has no meaning in plane strain, where the surface far away is infinitely high above "
            "the contact; give the load (N/m)."
        ),
    ),
    (
        lambda: solve(CYLINDER, direction=(1.0, 1.0)),
        "line-direction",
        (
            "direction = (1.0, 1.0): a cylinder makes a line contact, which moves along x only; give (1.0, 0.0) or "
            "(-1.0, 0.0)."
        ),
    ),
    (
        lambda: solve(vf.FlatPunch("1 mm")),
        "sharp-edge",
        (
            "indenter: a punch has a sharp edge; in motion its friction depends on the actual edge radius, at any "
            "speed; give the rounded face as a HeightMap, or a speed of zero or infinity, at which the solid is "
            "elastic."
        ),
    ),
    (
        lambda: solve(speed=math.inf, derivatives=True),
        "elastic-limit",
        (
            "derivatives = True: an elastic limit, speed = inf, has no friction to differentiate; give a speed other "
            "than zero and infinity."
        ),
    ),
    (
        lambda: solve(layer=vf.Layer("1 nm")),
        "layer-too-thin",
        "the layer is thinner than the grid resolves",
    ),
    (
        lambda: solve(accuracy=1e-3, tolerance=1e-3),
        "out-of-range",
        (
            "tolerance = 0.001: must be a number from 1e-13 to 0.001 times the accuracy, which is 1e-06 for accuracy = "
            "0.001."
        ),
    ),
    (
        lambda: vf.solve_periodic(RUBBER, WAVE, speed=1.0, gap="1 m"),
        "no-contact",
        "gap = '1 m': the surfaces do not touch; give a mean gap below that at the first touch, 1e-06 m.",
    ),
    (
        lambda: vf.contact.Backend("jax"),
        "unknown-backend",
        "backend = 'jax': not known; give 'scipy'",
    ),
]


@pytest.mark.parametrize(("act", "code", "sentence"), SENTENCES, ids=[code or "plain" for _, code, _ in SENTENCES])
def test_errors_say_what_is_wrong_and_what_to_do(act: Callable[[], object], code: str, sentence: str) -> None:
    with pytest.raises(vf.ViscofricError) as caught:
        act()
    assert caught.value.code == code
    assert str(caught.value).startswith(sentence)


def test_notes_of_shear_say_how_much_friction_changes_and_what_to_do() -> None:
    (note,) = coupling_notes([ShearedContact(2e5, 0.02, 3e-8, where="at 0.1 m/s")])
    assert note == (
        "Coulomb friction, a shear stress of 0.2 MPa, also displaces the surface in the normal direction, which "
        "changes the friction coefficient by about 0.0075 (37 % of viscoelastic friction; at 0.1 m/s), with the "
        "opposite sign where the slip is reversed. Contacts were solved without this effect; solve contacts with it "
        "(coulomb=, without heating), or take the mean of friction over both directions of slip."
    )
    assert "(viscofric solve --coulomb)" in note.words("run_file")
