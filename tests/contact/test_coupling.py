"""The change of friction by Coulomb friction: its estimate against contacts solved with shear both ways."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.bodies import half_space_coupling
from viscofric.contact.coupling import ShearedContact, SurfaceCoupling, coupling_notes, mean_coupling
from viscofric.notes import codes

COULOMB = 0.5
#: Estimates are right to this factor; on layers on which |X| counts waves that cancel, they are upper bounds.
FACTOR = 2.0
RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")


def material(poisson_ratio: float) -> vf.Material:
    return replace(RUBBER, poisson_ratio=poisson_ratio)


def solved_change(solve: Any, **given: Any) -> float:
    """Half the difference of friction between slip with and against the motion."""
    both = [solve(coulomb=one, **given).friction_coefficient for one in (COULOMB, -COULOMB)]
    return 0.5 * abs(both[0] - both[1])


def free_contact(solution: vf.ContactSolution, one: vf.Material, layer: vf.Layer | None, line: bool) -> ShearedContact:
    radius = 0.5 * solution.contact_area if line else math.sqrt(solution.contact_area / math.pi)
    modulus = abs(complex(one.modes_at().complex_modulus(abs(solution.speed) / radius)))
    return ShearedContact(
        stress=COULOMB * solution.mean_pressure,
        friction=solution.friction_coefficient,
        compliance=(1.0 - one.poisson_ratio**2) / modulus,
        coupling=mean_coupling(one.poisson_ratio, layer, radius, line=line),
        line=line,
    )


@pytest.mark.parametrize("speed", [0.0, 0.1, 1.0, 10.0])
@pytest.mark.parametrize("thickness", [None, "0.3 mm", "1 mm", "3 mm"])
@pytest.mark.parametrize("line", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_the_change_of_a_free_contact_is_that_of_contacts_solved_with_shear(
    thickness: str | None, speed: float, line: bool
) -> None:
    """Memory of 1/8 to 8 contact radii; layers from 1/4 to 8 of them thick, incompressible, half-spaces not."""
    one = material(0.3 if thickness is None else 0.5)
    layer = None if thickness is None else vf.Layer(thickness)
    indenter, load = (vf.Cylinder("10 mm"), 100.0) if line else (vf.Ball("10 mm"), 0.5)

    def solve(coulomb: float = 0.0) -> vf.ContactSolution:
        return vf.solve_steady(one, indenter, speed=speed, load=load, accuracy=5e-3, layer=layer, coulomb=coulomb)

    found = free_contact(solve(), one, layer, line).change
    assert 1.0 / FACTOR < solved_change(solve) / found < FACTOR


@pytest.mark.parametrize("thickness", ["1 mm", "3 mm"])
@pytest.mark.parametrize("speed", [0.0, 1.0, 10.0])
def test_on_compressible_layers_the_change_is_an_upper_bound(thickness: str, speed: float) -> None:
    """X changes its sign with the length of the wave: its parts cancel, the more the thinner the layer is."""
    one, layer = material(0.3), vf.Layer(thickness)

    def solve(coulomb: float = 0.0) -> vf.ContactSolution:
        return vf.solve_steady(
            one, vf.Cylinder("10 mm"), speed=speed, load=100.0, accuracy=5e-3, layer=layer, coulomb=coulomb
        )

    assert 0.4 < solved_change(solve) / free_contact(solve(), one, layer, True).change < 1.1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("poisson_ratio", "thickness", "speeds", "pressures"),
    [
        (0.3, None, (1e-3, 0.1, 1.0), (2e4, 2e5, 2e6)),  # area fractions from 0.01 to 0.9
        (0.45, None, (0.1,), (2e4, 2e6)),
        (0.5, "0.1 mm", (1e-3, 1.0), (1e5,)),  # a tenth of the longest wave
        (0.5, "0.3 mm", (1e-3, 1.0), (1e5,)),
    ],
)
def test_the_change_on_a_rough_surface_is_that_of_contacts_solved_with_shear(
    poisson_ratio: float, thickness: str | None, speeds: tuple[float, ...], pressures: tuple[float, ...]
) -> None:
    rubber = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=poisson_ratio)
    surface = vf.self_affine(0.8, shape=(64, 64), spacing=1e-3 / 64, shortest=1.25e-4, rms_slope=0.2, seed=1)
    layer = None if thickness is None else vf.Layer(thickness)
    coupled = SurfaceCoupling.of(surface.to_surface(), poisson_ratio, layer)
    assert coupled.slope == pytest.approx(0.2, rel=1e-6)
    for speed in speeds:
        for pressure in pressures:
            given = {"speed": speed, "pressure": pressure, "temperature": "30 degC", "layer": layer}

            def solve(coulomb: float = 0.0, given: dict[str, Any] = given) -> vf.PeriodicSolution:
                return vf.solve_periodic(rubber, surface.to_surface(), coulomb=coulomb, **given)

            plain = solve()
            area = vf.contact_statistics(plain).corrected_area_fraction
            found = coupled.contact(COULOMB, plain.friction_coefficient, area, pressure).change
            assert 1.0 / FACTOR < solved_change(solve) / found < FACTOR


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.4999])
def test_coupling_is_that_of_an_elastic_layer_on_a_bonded_base(poisson_ratio: float) -> None:
    """Against the four constants of waves (a + b z) e^{±z}, solved for a base at rest under shear alone."""
    kappa, lame = 3.0 - 4.0 * poisson_ratio, 2.0 * poisson_ratio / (1.0 - 2.0 * poisson_ratio)

    def rows(z: float) -> np.ndarray:
        """Displacements along and across (times i e^{ix} and e^{ix}) and their slopes, of the four constants."""
        e, E = np.exp(-z), np.exp(z)
        return np.array(
            [
                [-e, -(z - kappa) * e, E, (z + kappa) * E],
                [e, z * e, E, z * E],
                [e, -(1.0 - z + kappa) * e, E, (1.0 + z + kappa) * E],
                [-e, (1.0 - z) * e, E, (1.0 + z) * E],
            ]
        )

    def moved(depth: float, load: tuple[float, float]) -> float:
        along, across, along_slope, across_slope = rows(0.0)
        normal, shear = lame * (across_slope - along) + 2.0 * across_slope, along_slope + across
        constants = np.linalg.solve(np.array([normal, shear, *rows(depth)[:2]]), [*load, 0.0, 0.0])
        return float(across @ constants)

    for thickness in (0.5, 1.0, 3.0):
        waves = np.exp(np.arange(-5.0, 5.0, 0.1))
        hertz = ((np.sin(waves) - waves * np.cos(waves)) / waves**2) ** 2
        depth = np.minimum(waves * thickness, 8.0)
        sheared = [abs(moved(one, (0.0, -1.0))) for one in depth]
        expected = float(hertz @ sheared) / hertz.sum() / moved(8.0, (-1.0, 0.0))
        # A sum over half as many waves, of which the shortest oscillate.
        assert mean_coupling(poisson_ratio, vf.Layer(thickness), 1.0) == pytest.approx(expected, rel=0.01)
    thick = mean_coupling(poisson_ratio, vf.Layer(100.0), 1.0)
    assert thick == pytest.approx((1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio)), abs=1e-3)


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
    contacts = [ShearedContact(stress, 0.1, 1e-6, 0.25, line=True) for stress in (1e4, -4e4)]
    (note,) = coupling_notes(contacts)
    assert note.code == "tangential-coupling"
    assert note.values["change"] == pytest.approx(2.0 * 0.25 * 1.25 * 0.04)
    assert note.values["share"] == pytest.approx(0.25)
    assert coupling_notes(contacts[:0]) == coupling_notes([replace(contacts[0], stress=7e3)]) == ()
    unknown = coupling_notes([replace(contacts[0], coupling=math.nan)])
    assert codes(unknown) == {"tangential-coupling"}
    assert not unknown[0].values


HEATING = vf.Heating(
    rubber=vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber"),
    counterface=vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel"),
    coulomb=0.3,
)


@pytest.mark.slow
def test_contacts_that_coulomb_friction_heats_have_the_note_of_their_shear() -> None:
    """Steady, in a curve and over time, the same change: 0.477 μ_c β a/R of Hertz's ball, to the factor stated."""
    ball = vf.Ball("9.525 mm")

    def steady(poisson_ratio: float) -> vf.ContactSolution:
        rubber = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=poisson_ratio)
        return vf.solve_steady(rubber, ball, speed=0.1, load=5.0, temperature="60 degC", heating=HEATING, accuracy=1e-2)

    assert "tangential-coupling" not in codes(steady(0.5).warnings)
    rubber, one = replace(vf.synthetic_fluoroelastomer(), poisson_ratio=0.45), steady(0.45)
    curve = vf.predict_friction(
        rubber, ball, speeds=0.1, load=5.0, temperatures="60 degC", heating=HEATING, accuracy=1e-2
    )
    history = vf.History(time=[0.0, 1e-3, 0.05], load=5.0, speed=0.1, temperature="60 degC")
    run = vf.solve_transient(rubber, ball, history, heating=HEATING, accuracy=5e-2)
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
    law = vf.ConstantShearStress(0.3 * 1e5 / float(heated.corrected_area_fraction[0, 0, 0]))
    rubbed = vf.predict_rough_friction(rubber, surface, interface=law, **case)
    sheared = vf.predict_rough_friction(rubber, surface, coulomb=0.3, interface=law, **case)
    theory = vf.persson_theory(rubber, vf.power_spectrum(surface), heating=HEATING, **case)
    found = [
        note.values["change"]
        for one in (heated, rubbed, theory)
        for note in one.notes
        if note.code == "tangential-coupling"
    ]
    assert len(found) == 3
    assert np.allclose(found, found[0], rtol=0.1)  # areas differ by warming and between theory and contact
    assert "tangential-coupling" not in codes(sheared.notes)
