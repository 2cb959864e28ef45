"""The change of friction by Coulomb friction: its estimate against contacts solved with shear both ways."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.bodies import half_space_coupling
from viscofric.contact.coupling import ShearedContact, SurfaceCoupling, coupling_notes, sheared_compliance
from viscofric.notes import codes

COULOMB = 0.5
#: Estimates are right to this factor, and to the larger one on layers on which X changes its sign with the wave.
FACTOR, FACTOR_OF_CANCELLING = 2.0, 2.5
RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")


def material(poisson_ratio: float) -> vf.Material:
    return replace(RUBBER, poisson_ratio=poisson_ratio)


def solved_change(solve: Any, **given: Any) -> float:
    """Half the difference of friction between slip with and against the motion."""
    both = [solve(coulomb=one, **given).friction_coefficient for one in (COULOMB, -COULOMB)]
    return 0.5 * abs(both[0] - both[1])


def free_contact(
    solution: vf.contact.ContactSolution, one: vf.Material, layer: vf.Layer | None, line: bool
) -> ShearedContact:
    radius = 0.5 * solution.contact_area if line else math.sqrt(solution.contact_area / math.pi)
    modes, ratio = one.modes_at(), one.poisson_ratio
    return ShearedContact(
        stress=COULOMB * solution.mean_pressure,
        friction=solution.friction_coefficient,
        compliance=sheared_compliance(modes, ratio, layer, radius, solution.speed, line=line),
        line=line,
    )


BODIES = [
    (0.3, None),
    *((0.5, vf.Layer(thickness)) for thickness in ("0.3 mm", "1 mm", "3 mm")),
    *((0.5, vf.Layer(thickness, bonded=False)) for thickness in ("0.3 mm", "3 mm")),
    *((0.3, vf.Layer(thickness)) for thickness in ("0.3 mm", "1 mm")),
    *((0.3, vf.Layer(thickness, bonded=False)) for thickness in ("0.3 mm", "1 mm")),
]


def contacts() -> Iterator[Any]:
    """Yield two contacts on each body, of a line at any speed or a ball; other balls apart, all others exhaustive."""
    for place, body in enumerate(BODIES):
        speed = (1.0, 0.0, 10.0)[place % 3]
        usual = {(True, speed), (place % 3 > 0, 1.0)}
        for one in product((True, False), (0.0, 1.0, 10.0)):
            rarer = pytest.mark.apart if one == (False, speed) else pytest.mark.exhaustive
            yield pytest.param(*body, *one, marks=() if one in usual else rarer)


@pytest.mark.parametrize(("poisson_ratio", "layer", "line", "speed"), contacts())
def test_the_change_of_a_free_contact_is_that_of_contacts_solved_with_shear(
    poisson_ratio: float, layer: vf.Layer | None, speed: float, line: bool
) -> None:
    """Memory of 1 to 8 contact radii; layers from 1/4 to 8 of them thick, on either base."""
    one = material(poisson_ratio)
    indenter, load = (vf.Cylinder("10 mm"), 100.0) if line else (vf.Ball("10 mm"), 0.5)

    def solve(coulomb: float = 0.0) -> vf.contact.ContactSolution:
        return vf.solve_steady(one, indenter, speed=speed, load=load, accuracy=1e-2, layer=layer, coulomb=coulomb)

    found, cancels = free_contact(solve(), one, layer, line).change, layer is not None and poisson_ratio < 0.5
    factor = FACTOR_OF_CANCELLING if cancels else FACTOR
    assert 1.0 / factor < solved_change(solve) / found < factor


@pytest.mark.slow
@pytest.mark.parametrize(
    ("poisson_ratio", "layer", "speeds", "pressures"),
    [
        (0.3, None, (1e-3, 1.0), (2e4, 2e6)),  # area fractions from 0.01 to 0.9
        (0.45, None, (0.1,), (2e4, 2e6)),
        (0.5, vf.Layer("0.1 mm"), (1e-3, 1.0), (1e5,)),  # a tenth of the longest wave
        (0.5, vf.Layer("0.3 mm"), (1e-3, 1.0), (1e5,)),
        (0.5, vf.Layer("0.1 mm", bonded=False), (1e-3, 1.0), (1e5,)),
    ],
)
def test_the_change_on_a_rough_surface_is_that_of_contacts_solved_with_shear(
    poisson_ratio: float, layer: vf.Layer | None, speeds: tuple[float, ...], pressures: tuple[float, ...]
) -> None:
    rubber = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=poisson_ratio)
    surface = vf.self_affine(0.8, shape=(64, 64), spacing=1e-3 / 64, shortest=1.25e-4, rms_slope=0.2, seed=1)
    coupled = SurfaceCoupling.of(surface.to_surface(), poisson_ratio, layer)
    assert coupled.slope == pytest.approx(0.2, rel=1e-6)
    for speed in speeds:
        for pressure in pressures:
            given = {"speed": speed, "pressure": pressure, "temperature": "30 degC", "layer": layer}

            def solve(coulomb: float = 0.0, given: dict[str, Any] = given) -> vf.contact.PeriodicSolution:
                return vf.solve_periodic(rubber, surface.to_surface(), coulomb=coulomb, **given)

            plain = solve()
            area = vf.roughness.contact_statistics(plain).corrected_area_fraction
            found = coupled.contact(COULOMB, plain.friction_coefficient, area, pressure).change
            assert 1.0 / FACTOR < solved_change(solve) / found < FACTOR


def test_a_thick_layer_is_sheared_like_a_half_space() -> None:
    one = material(0.3)
    half_space, *layers = (
        sheared_compliance(one.modes_at(), 0.3, layer, 1e-3, 1.0)
        for layer in (None, vf.Layer("0.1 m"), vf.Layer("0.1 m", bonded=False))
    )
    # Hundred radii: the waves that reach the base are a hundredth of those of the pressure.
    assert layers == pytest.approx([half_space, half_space], rel=1e-2)


def test_both_directions_of_slip_have_the_same_mean() -> None:
    """What the note advises: the part of the change that does not reverse is second order in the coupling."""
    one = material(0.3)

    def solve(coulomb: float) -> float:
        case = {"speed": 1.0, "load": 100.0, "accuracy": 1e-3}
        return vf.solve_steady(one, vf.Cylinder("10 mm"), coulomb=coulomb, **case).friction_coefficient

    plain, both = solve(0.0), [solve(one) for one in (COULOMB, -COULOMB)]
    assert abs(np.mean(both) - plain) < 0.02 * abs(both[0] - plain)


def test_a_note_has_the_largest_relative_change() -> None:
    """Of shear stresses over E/(1 − ν²): 2c X (5/4 − A) τ (1 − ν²)/E, by hand."""
    contacts = [ShearedContact(stress, 0.1, 0.25e-6, line=True) for stress in (1e4, -4e4)]
    (note,) = coupling_notes(contacts)
    assert note.code == "tangential-coupling"
    assert note.values["change"] == pytest.approx(2.0 * 0.25 * 1.25 * 0.04)
    assert note.values["share"] == pytest.approx(0.25)
    assert coupling_notes(contacts[:0]) == coupling_notes([replace(contacts[0], stress=7e3)]) == ()
    # Solved with another shear: by the difference, whatever the direction of slip.
    (other,) = coupling_notes([replace(contacts[1], solved=1e4)])
    assert other.code == "other-shear"
    assert other.values["share"] == pytest.approx(0.75 * 0.25)
    assert coupling_notes([replace(contacts[1], solved=4e4)]) == ()


HEATING = vf.Heating(
    rubber=vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber"),
    counterface=vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel"),
    coulomb=0.3,
)


@pytest.mark.apart
def test_contacts_that_coulomb_friction_heats_have_the_note_of_their_shear() -> None:
    """Steady, in a curve and over time, the same change: 0.477 μ_c β a/R of Hertz's ball, to the factor stated."""
    ball = vf.Ball("9.525 mm")

    def steady(poisson_ratio: float) -> vf.contact.ContactSolution:
        rubber = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=poisson_ratio)
        return vf.solve_steady(rubber, ball, speed=0.1, load=5.0, temperature="60 degC", heating=HEATING, accuracy=1e-2)

    assert "tangential-coupling" not in codes(steady(0.5).warnings)
    rubber, one = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=0.45), steady(0.45)
    curve = vf.predict_friction(
        rubber, ball, speeds=0.1, load=5.0, temperatures="60 degC", heating=HEATING, accuracy=1e-2
    )
    history = vf.motion.History(time=[0.0, 1e-3, 0.05], load=5.0, speed=0.1, temperature="60 degC")
    run = vf.motion.solve_transient(rubber, ball, history, heating=HEATING, accuracy=5e-2)
    changes = [
        note.values["change"]
        for said in (one.warnings, curve.notes, run.warnings)
        for note in said
        if note.code == "tangential-coupling"
    ]
    assert len(changes) == 3
    expected = 0.477 * 0.3 * half_space_coupling(0.45) * one.half_width / 9.525e-3
    assert np.allclose(changes, expected, rtol=0.3)  # of the mean square of pressures, and E at v/a


def test_rough_surfaces_have_the_note_whatever_makes_their_coulomb_friction() -> None:
    rubber = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=0.4)
    surface = vf.self_affine(0.8, shape=(32, 32), spacing="20 um", shortest="160 um", rms_slope=0.2, seed=1)
    case: dict[str, Any] = {"speeds": 0.01, "pressure": "0.1 MPa", "temperatures": "60 degC"}
    heated = vf.predict_rough_friction(rubber, surface, heating=replace(HEATING, nominal_radius="5 mm"), **case)
    # The friction of this interface is the Coulomb friction above, on the area of the same contact.
    law = vf.friction.ConstantShearStress(0.3 * 1e5 / float(heated.corrected_area_fraction[0, 0, 0]))
    rubbed = vf.predict_rough_friction(rubber, surface, interface=law, **case)
    sheared = vf.predict_rough_friction(rubber, surface, coulomb=0.3, interface=law, **case)
    other = vf.predict_rough_friction(rubber, surface, coulomb=0.6, interface=law, **case)
    theory = vf.persson_theory(rubber, vf.roughness.power_spectrum(surface), heating=HEATING, **case)
    found = [
        note.values["change"]
        for one in (heated, rubbed, theory)
        for note in one.notes
        if note.code == "tangential-coupling"
    ]
    assert len(found) == 3
    assert np.allclose(found, found[0], rtol=0.1)  # areas differ by warming and between theory and contact
    assert not {"tangential-coupling", "other-shear"} & set(codes(sheared.notes))
    (doubt,) = (note for note in other.notes if note.code == "other-shear")
    assert doubt.values["change"] == pytest.approx(found[1], rel=0.2)  # as much too much as was left out
