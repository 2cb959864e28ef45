"""Persson's theory against its limits, another quadrature, and solved contacts where it is exact."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erf

import viscofric as vf
from refusals import refused
from viscofric.notes import codes
from viscofric.roughness.flash import Flash

RUBBER = vf.Material.standard_linear_solid("1 MPa", "30 MPa", "1 ms", poisson_ratio=0.4)
ROAD = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", rolloff="0.3 mm", shortest="5 um", rms_slope=0.4)
FLUOROELASTOMER = vf.synthetic_fluoroelastomer()
THERMAL = vf.ThermalProperties(0.25, 1200.0, 1500.0, "rubber")


def test_small_loads_on_an_elastic_solid_give_an_area_that_grows_with_the_load():
    for pressure in (1.0, 10.0):
        found = vf.persson_theory(RUBBER, ROAD, speeds=0.0, pressure=pressure)
        wanted = math.sqrt(8.0 / math.pi) * pressure * (1.0 - 0.4**2) / (1e6 * ROAD.rms_slope())
        assert found.contact_area_fraction[0, 0] == pytest.approx(wanted, rel=1e-4)
        assert found.friction_coefficient[0, 0] == 0.0


def test_fast_and_slow_sliding_are_elastic_contacts_of_glass_and_rubber():
    slow = vf.persson_theory(RUBBER, ROAD, speeds=[0.0, 1e-9], pressure=1e5)
    fast = vf.persson_theory(RUBBER, ROAD, speeds=1e9, pressure=1e5)
    glass = vf.Material.standard_linear_solid("29.999999 MPa", "30 MPa", "1 ms", poisson_ratio=0.4)
    assert slow.contact_area_fraction[0, 1] == pytest.approx(slow.contact_area_fraction[0, 0], rel=1e-6)
    stiff = vf.persson_theory(glass, ROAD, speeds=0.0, pressure=1e5).contact_area_fraction
    assert fast.contact_area_fraction == pytest.approx(stiff, rel=1e-4)
    assert fast.friction_coefficient[0, 0] < 1e-6


def test_all_is_in_contact_under_a_high_pressure_and_friction_is_that_of_the_solved_contact():
    """In full contact the theory is exact, up to the difference between an integral and a sum over waves."""
    period, points = 1e-3, 128
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=period / 6, shortest=period / 30, rms_slope=0.05)
    surface = vf.roughness.surface_from_spectrum(spectrum, shape=(points, points), spacing=period / points, seed=1)
    for speed in (1e-3, 0.05):
        solved = vf.solve_periodic(RUBBER, surface.to_surface(), speed=speed, pressure="60 MPa")
        theory = vf.persson_theory(RUBBER, spectrum, speeds=speed, pressure="60 MPa")
        assert solved.diagnostics.full_contact
        assert theory.contact_area_fraction[0, 0] == pytest.approx(1.0, abs=1e-12)
        # rms slopes of sum and integral differ by some tenths of a per cent.
        scale = (surface.rms_slope / spectrum.rms_slope()) ** 2
        assert theory.friction_coefficient[0, 0] * scale == pytest.approx(solved.friction_coefficient, rel=0.02)


def test_on_an_anisotropic_surface_the_theory_is_the_mean_of_all_directions_and_says_so():
    period, aspect = 1e-3, 2.0
    surface = vf.self_affine(
        0.8, shape=(96, 96), spacing=period / 96, shortest=period / 16, rms_slope=0.02, aspect=aspect, seed=1
    )
    spectrum = vf.roughness.power_spectrum(surface)
    # The lay stretches waves by the root of the aspect along itself, and compresses those across.
    anisotropy = (aspect**2 - 1.0) / (aspect**2 + 1.0)
    assert spectrum.anisotropy == pytest.approx(anisotropy, abs=0.02)  # of the sum over waves
    assert spectrum.scaled(rms_slope=0.01).limited(shortest=1e-4).anisotropy == spectrum.anisotropy
    along, across = (
        vf.solve_periodic(RUBBER, surface.to_surface(), speed=0.01, pressure="60 MPa", direction=way)
        for way in ((1.0, 0.0), (0.0, 1.0))
    )
    assert all(one.diagnostics.full_contact for one in (along, across))
    theory = vf.persson_theory(RUBBER, spectrum, speeds=0.01, pressure="60 MPa")
    assert codes(theory.notes) == {"anisotropic-surface", "frequencies-unknown", "cut-off"}
    mean = 0.5 * (along.friction_coefficient + across.friction_coefficient)
    # Harmonics beyond the second are left out of the mean of two directions, and a power law lies between points.
    assert theory.friction_coefficient[0, 0] == pytest.approx(mean, rel=0.05)
    # E'' grows with frequency here, and short waves, which count more than for the slope, are the ones across the lay.
    assert 0.5 * (across.friction_coefficient - along.friction_coefficient) / mean == pytest.approx(anisotropy, rel=0.2)


SPEED, PRESSURE = 0.02, 2e5  # of the quadrature below


@pytest.fixture(scope="module")
def over_directions():
    """Wave numbers, and the integrals of |E/p|² and of cos φ Im E/p over all directions at each."""
    q = np.exp(np.linspace(math.log(2e3 * math.pi), math.log(4e5 * math.pi), 1201))

    def integral(one: float, kind: str) -> float:
        def part(phi: float) -> float:
            modulus = complex(RUBBER.complex_modulus(one * SPEED * math.cos(phi))) / (1.0 - 0.4**2) / PRESSURE
            return abs(modulus) ** 2 if kind == "square" else math.cos(phi) * modulus.imag

        return 4.0 * quad(part, 0.0, 0.5 * math.pi, epsabs=0.0, epsrel=1e-6)[0]

    return q, *(np.array([integral(one, kind) for one in q]) for kind in ("square", "loss"))


@pytest.mark.slow
@pytest.mark.parametrize("gamma", [1.0, 0.5, 0.0])
def test_another_quadrature_finds_the_same(over_directions, gamma):
    q, square, loss = over_directions
    density = ROAD(q)
    integrand = 0.125 * q**4 * density * square
    step = math.log(q[1] / q[0])
    spread = np.concatenate([[0.0], np.cumsum(0.5 * step * (integrand[1:] + integrand[:-1]))])
    area = erf(0.5 / np.sqrt(np.maximum(spread, 1e-300)))
    follows = gamma + (1.0 - gamma) * area**2
    wanted = 0.5 * np.trapezoid(q**4 * density * follows * area * loss, dx=step)
    found = vf.persson_theory(RUBBER, ROAD, speeds=SPEED, pressure=PRESSURE, gamma=gamma, accuracy=1e-6)
    # Trapezoids of 1/226 of the logarithm.
    assert found.contact_area_fraction[0, 0] == pytest.approx(area[-1], rel=2e-4)
    assert found.friction_coefficient[0, 0] == pytest.approx(wanted, rel=5e-4)


@pytest.mark.parametrize("speed", [1e-4, 100.0])
def test_friction_under_vanishing_loads_does_not_depend_on_them(speed):
    """P falls from one within 1e-24 of the longest wave; grids that miss that make up any friction."""
    road = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="10 um", rms_slope=0.3)

    def friction(pressure: float, accuracy: float) -> float:
        reported = vf.persson_theory(
            FLUOROELASTOMER,
            road,
            speeds=speed,
            pressure=pressure,
            temperatures="30 degC",
            gamma=1.0,
            accuracy=accuracy,
        )
        return float(reported.friction_coefficient[0, 0])

    exact = friction(1e-4, 1e-6)
    for pressure in (1e-4, 1.0):  # the second is 3e-6 from the limit
        assert friction(pressure, 1e-4) == pytest.approx(exact, rel=1e-4)


def test_what_each_scale_adds_sums_to_the_whole_and_area_falls_from_scale_to_scale():
    found = vf.persson_theory(RUBBER, ROAD, speeds=[0.001, 0.01, 0.1], pressure=1e5)
    assert found.area_by_scale.shape == (1, 3, len(found.wave_number))
    assert np.all(found.area_by_scale[..., 0] == 1.0)
    assert np.all(np.diff(found.area_by_scale) <= 0.0)
    assert np.all(np.diff(found.friction_by_scale) >= 0.0)
    np.testing.assert_array_equal(found.friction_by_scale[..., -1], found.friction_coefficient)
    labelled = found.to_dataset()
    assert labelled["friction_coefficient"].dims == ("temperature", "speed")
    assert labelled["area_by_scale"].sizes == {"temperature": 1, "speed": 3, "wave_number": len(found.wave_number)}
    shorter = vf.persson_theory(RUBBER, ROAD.limited(shortest="50 um"), speeds=0.01, pressure=1e5)
    place = np.log(found.wave_number)
    at = np.interp(math.log(2.0 * math.pi / 50e-6), place, found.friction_by_scale[0, 1])
    # Linear interpolation between scales a sixteenth of a decade apart.
    assert shorter.friction_coefficient[0, 0] == pytest.approx(at, rel=3e-3)


def test_what_the_shortest_octave_of_waves_does_is_noted():
    found = vf.persson_theory(RUBBER, ROAD, speeds=[0.0, 0.01], pressure=1e5)
    (note,) = [one for one in found.notes if one.code == "cut-off"]
    before = vf.persson_theory(RUBBER, ROAD.limited(shortest="10 um"), speeds=[0.0, 0.01], pressure=1e5)
    larger = (before.contact_area_fraction / found.contact_area_fraction).max() - 1.0
    share = 1.0 - before.friction_coefficient[0, 1] / found.friction_coefficient[0, 1]
    # The grid's point next below the octave is up to a sixteenth of a decade longer: 0.05 of an octave of 0.3 decades.
    assert note.values["area"] == pytest.approx(larger, rel=0.2)
    assert note.values["friction"] == pytest.approx(share, rel=0.2)
    smooth = replace(ROAD, density=ROAD.density * (ROAD.wave_number / ROAD.wave_number[0]) ** -6.0)
    assert "cut-off" not in codes(vf.persson_theory(RUBBER, smooth, speeds=0.01, pressure=1e5).notes)


def test_temperature_shifts_speed():
    shift = FLUOROELASTOMER.shift(333.15) / FLUOROELASTOMER.shift(303.15)
    warm = vf.persson_theory(FLUOROELASTOMER, ROAD, speeds=[0.01, 0.1], pressure=1e5, temperatures="60 degC")
    cold = vf.persson_theory(
        FLUOROELASTOMER, ROAD, speeds=[0.01 * shift, 0.1 * shift], pressure=1e5, temperatures="30 degC"
    )
    np.testing.assert_allclose(warm.friction_coefficient, cold.friction_coefficient, rtol=1e-10)


def test_other_units_give_the_same_answer():
    length, force, time = 1e-3, 1e5, 1e6
    stress = force / length**2
    other = vf.Material.standard_linear_solid(1e6 * stress, 30e6 * stress, 1e-3 * time, poisson_ratio=0.4)
    road = vf.roughness.PowerSpectrum(ROAD.wave_number / length, ROAD.density * length**4)
    one = vf.persson_theory(RUBBER, ROAD, speeds=0.01, pressure=1e5)
    two = vf.persson_theory(other, road, speeds=0.01 * length / time, pressure=1e5 * stress)
    np.testing.assert_allclose(two.friction_coefficient, one.friction_coefficient, rtol=1e-10)
    np.testing.assert_allclose(two.contact_area_fraction, one.contact_area_fraction, rtol=1e-10)


def test_partial_contact_lies_between_no_and_all_of_the_dissipation_of_the_theory_of_2001():
    frictions = [
        vf.persson_theory(RUBBER, ROAD, speeds=0.01, pressure=1e5, gamma=gamma).friction_coefficient[0, 0]
        for gamma in (0.0, 0.5, 1.0)
    ]
    assert frictions[0] < frictions[1] < frictions[2]
    assert frictions[1] == pytest.approx(0.5 * (frictions[0] + frictions[2]), rel=2e-4)


SCALES = np.geomspace(1e3, 1e6, 301)
LOG_WEIGHTS = np.full(301, math.log(1e3) / 300)


def test_short_contacts_keep_the_heat_where_it_was_made():
    """Without conduction T_q = t0 ∫ f q/(q + q') dq'."""
    insulator = vf.ThermalProperties(1e-9, 1000.0, 2000.0, "insulator")
    area, dissipated = np.linspace(1.0, 0.1, 301), 1e3 * np.exp(-(np.log(SCALES / 3e4) ** 2))
    found = Flash(insulator, 0.3).rises(SCALES, LOG_WEIGHTS, (0.5, 300.0), area, dissipated)[0][:-1]
    q_m = np.interp(-0.3, -area, SCALES)
    source = 0.5 / 2e6 * SCALES * dissipated * area / 0.3
    kernel = SCALES[:, None] / (SCALES[:, None] + SCALES)
    wanted = (math.pi / q_m / 0.5) * kernel @ (LOG_WEIGHTS * SCALES * source)
    np.testing.assert_allclose(found, wanted, rtol=1e-3)


def test_long_contacts_warm_the_surface_as_a_flux_of_heat_does():
    """What is dissipated close to the surface of a half-space: ΔT = 2 Q √(t0/(π k ρ c))."""
    area = np.where(SCALES < 2e3, 1.0, 0.2)
    dissipated = np.where(SCALES > 3e5, 1e3, 0.0)
    conductor = vf.ThermalProperties(1.0, 1000.0, 1000.0, "conductor")
    q_m = float(SCALES[np.argmax(SCALES >= 2e3)])
    speed = 1e-3  # 1.6 s, in which heat goes 1 mm deep, thousands of times the depth of its sources
    found = Flash(conductor, 0.3).rises(SCALES, LOG_WEIGHTS, (speed, 300.0), area, dissipated)[0]
    flux = speed * float(LOG_WEIGHTS @ (0.5 * SCALES * dissipated * area / 0.3))
    wanted = 2.0 * flux * math.sqrt(math.pi / q_m / speed / (math.pi * 1e6))
    # The shortest waves see the surface; q_m lies between two scales, some per cent apart.
    assert found[-1] == pytest.approx(wanted, rel=0.02)


def test_coulomb_heat_is_a_flux_that_both_bodies_share():
    """ΔT = 2 j √(t0/(π k ρ c)) by j = μ σ0 u/P(q_m), half of it if the counterface is alike and moves as fast."""
    area, speed, pressure = np.where(SCALES < 2e3, 1.0, 0.2), 1e-3, 2e4
    conductor = vf.ThermalProperties(1.0, 1000.0, 1000.0, "conductor")
    insulator = vf.ThermalProperties(1e-9, 1000.0, 2000.0, "insulator")
    t0 = math.pi / float(SCALES[np.argmax(SCALES >= 2e3)]) / speed
    alone = 2.0 * 0.4 * pressure * 2.0 * speed / 0.3 * math.sqrt(t0 / (math.pi * 1e6))
    for counterface, part in ((insulator, 1.0), (conductor, 0.5)):
        heating = vf.Heating(rubber=conductor, counterface=counterface, coulomb=0.4, slip=2.0 * speed)
        flash = Flash(conductor, 0.3, heating, pressure)
        _, rise = flash.rises(SCALES, LOG_WEIGHTS, (speed, 300.0), area, np.zeros(len(SCALES)))
        # The shortest waves see the surface; q_m lies between two scales, some per cent apart.
        assert rise[-1] == pytest.approx(part * alone, rel=0.02)
        assert np.all(np.diff(rise) > 0.0)


def test_heating_without_coulomb_heat_is_the_theory_of_the_rubber_alone():
    asked = {"speeds": 0.1, "pressure": "0.1 MPa", "temperatures": "30 degC"}
    other = vf.ThermalProperties(46.0, 7810.0, 475.0, "steel")
    heating = vf.Heating(rubber=THERMAL, counterface=other)
    plain = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, thermal=THERMAL)
    same = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=heating)
    rubbed = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=replace(heating, coulomb=0.5))
    assert same.friction_coefficient == plain.friction_coefficient
    assert rubbed.flash_temperature[0, 0] > plain.flash_temperature[0, 0]
    with refused("not-with-heating"):
        vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=heating, thermal=THERMAL)


def test_an_interface_rubs_with_its_stress_on_the_real_contact_area():
    law = vf.friction.PowerShearStress("0.2 MPa", 0.1, "0.1 m/s", shift=vf.Arrhenius("50 kJ/mol", "30 degC"))
    asked = {"speeds": [0.01, 1.0], "pressure": "0.1 MPa", "temperatures": ["30 degC", "60 degC"]}
    plain = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked)
    rubbed = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, interface=law)
    stress = np.array([[float(law(v, T)) for v in (0.01, 1.0)] for T in (303.15, 333.15)])
    assert rubbed.interface_friction == pytest.approx(stress * plain.contact_area_fraction / 1e5, rel=1e-12)
    assert rubbed.total == pytest.approx(plain.friction_coefficient + rubbed.interface_friction, rel=1e-12)
    assert {"interface-law", "interface-without-error"} <= codes(rubbed.notes)
    assert rubbed.to_dataset().interface_friction.dims == ("temperature", "speed")
    pressed = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked | {"pressure": "1 GPa"}, interface=law)
    assert pressed.interface_friction == pytest.approx(stress / 1e9, rel=1e-3)  # full contact
    with refused("no-interface"):
        _ = plain.total


def test_the_heat_of_an_interface_is_that_of_as_much_coulomb_friction():
    """And its stress is that at the temperature of the surface that this heat warms."""
    law = vf.friction.GaussianShearStress("20 MPa", "6 mm/s", 2.0, shift=vf.Arrhenius("90 kJ/mol", "30 degC"))
    asked = {"speeds": 2.0, "pressure": "0.2 MPa", "temperatures": "30 degC", "accuracy": 1e-2}
    heating = vf.Heating(rubber=THERMAL, counterface=vf.ThermalProperties(2.0, 2500.0, 800.0, "stone"))
    found = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=heating, interface=law)
    assert isinstance(found, vf.roughness.HeatedPerssonTheory)
    friction, face = float(found.interface_friction[0, 0]), float(found.face_rise[0, 0])
    assert face > 10.0
    stress = float(law(2.0, 303.15 + face))
    assert friction == pytest.approx(stress * found.contact_area_fraction[0, 0] / 2e5, rel=1e-12)
    same = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=replace(heating, coulomb=friction))
    # Both settle to 1e-5 of the rise on the same grid of waves.
    assert same.face_rise[0, 0] == pytest.approx(face, rel=1e-4)
    assert same.friction_coefficient[0, 0] == pytest.approx(found.friction_coefficient[0, 0], rel=1e-4)
    with refused("not-with-heating"):
        vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=replace(heating, coulomb=0.1), interface=law)
    with refused("not-with-heating"):
        vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, thermal=THERMAL, interface=law)
    ends = vf.InversePolynomial([5000.0, 1e6], 303.15, fitted_range=(293.15, 305.0))
    with refused("beyond-interface"):
        limited = replace(law, shift=ends)
        vf.persson_theory(FLUOROELASTOMER, ROAD, **asked, heating=heating, interface=limited)


def test_the_theory_has_a_cold_and_a_hot_state_on_the_glassy_side_of_its_peak():
    """As the speed rises friction stays cold, as it falls hot: the hysteresis of a ramp, with the isothermal beside."""
    glassy = vf.Material.standard_linear_solid("1 MPa", "1 GPa", "1 s")
    rubber = vf.Material(glassy.spectrum, shift=vf.WLF(C1=15.0, C2=60.0, reference="0 degC"))
    road = vf.roughness.PowerSpectrum.self_affine(0.8, longest="10 mm", shortest="30 um", rms_slope=0.5)
    heating = vf.Heating(rubber=THERMAL, counterface=THERMAL)
    asked = {"speeds": [0.1, 4.0, 10.0], "pressure": "0.5 MPa", "temperatures": "0 degC", "accuracy": 1e-3}
    cold, hot = (
        vf.persson_theory(rubber, road, **asked, heating=replace(heating, branch=one)) for one in ("cold", "hot")
    )
    assert isinstance(cold, vf.roughness.HeatedPerssonTheory)
    assert isinstance(hot, vf.roughness.HeatedPerssonTheory)
    assert (cold.hot_rise > cold.cold_rise + 1.0).tolist() == [[False, True, True]]
    assert np.all(cold.hot_friction[0, 1:] > 2.0 * cold.cold_friction[0, 1:])
    assert cold.friction_coefficient == pytest.approx(cold.cold_friction)
    assert hot.friction_coefficient == pytest.approx(cold.hot_friction, rel=1e-3)
    assert hot.temperature_rise == pytest.approx(hot.loss_rise)
    assert np.all(hot.face_rise >= hot.temperature_rise)
    alone = vf.persson_theory(rubber, road, **asked)
    assert cold.isothermal_friction == pytest.approx(alone.friction_coefficient, rel=1e-12)
    assert cold.to_dataset().hot_rise.dims == ("temperature", "speed")
    with refused("not-with-heating"):
        vf.persson_theory(rubber, road, **asked, heating=replace(heating, nominal_radius="5 mm"))


def test_a_rubber_that_hardly_warms_rubs_as_one_of_one_temperature_with_its_vertical_shift():
    shifted = vf.Material(
        FLUOROELASTOMER.spectrum,
        shift=FLUOROELASTOMER.shift,
        vertical_shift=vf.rheology.DensityShift(reference="30 degC"),
    )
    asked = {"speeds": 0.1, "pressure": "0.1 MPa", "temperatures": "90 degC"}
    cold = vf.persson_theory(shifted, ROAD, **asked)
    sink = vf.ThermalProperties(1e6, 1e6, 1e6, "sink")
    warm = vf.persson_theory(shifted, ROAD, **asked, thermal=sink)
    assert warm.flash_temperature[0, 0] < 1e-6
    np.testing.assert_allclose(warm.friction_coefficient, cold.friction_coefficient, rtol=1e-6)
    plain = vf.persson_theory(FLUOROELASTOMER, ROAD, **asked)
    # b = 363/303, but for the expansion, makes E larger, and the contact area smaller.
    assert cold.contact_area_fraction[0, 0] < 0.95 * plain.contact_area_fraction[0, 0]


def test_flash_temperature_lowers_the_friction_of_fast_sliding_and_not_that_of_slow():
    road = vf.roughness.PowerSpectrum.self_affine(0.8, longest="5 mm", rolloff="3 mm", shortest="5 um", rms_slope=1.0)
    asked = {"speeds": [1e-6, 1.0], "pressure": "0.1 MPa", "temperatures": "30 degC"}
    cold = vf.persson_theory(FLUOROELASTOMER, road, **asked)
    hot = vf.persson_theory(FLUOROELASTOMER, road, **asked, thermal=THERMAL)
    assert hot.friction_coefficient[0, 0] == pytest.approx(cold.friction_coefficient[0, 0], rel=1e-3)
    assert hot.friction_coefficient[0, 1] < 0.9 * cold.friction_coefficient[0, 1]
    assert hot.contact_area_fraction[0, 1] > cold.contact_area_fraction[0, 1]
    assert 1.0 < hot.flash_temperature[0, 1] < 100.0
    assert np.all(cold.flash_temperature == 0.0)
    # Friction and heat answer one another: the rubber at the mean temperature of its scales rubs alike.
    rise = hot.temperature_rise_by_scale[0, 1]
    ends = vf.persson_theory(
        FLUOROELASTOMER, road, speeds=1.0, pressure="0.1 MPa", temperatures=[303.15 + rise.min(), 303.15 + rise.max()]
    ).friction_coefficient[:, 0]
    assert ends.min() < hot.friction_coefficient[0, 1] < ends.max()


@pytest.mark.parametrize(
    ("arguments", "about"),
    [
        ({"speeds": []}, "speeds"),
        ({"temperatures": []}, "temperatures"),
        ({"speeds": -1.0}, "negative"),
        ({"pressure": 0.0}, "pressure"),
        ({"gamma": 1.5}, "gamma"),
        ({"accuracy": 1.0}, "accuracy"),
        ({"thermal": THERMAL}, "no-shift"),
        ({"temperatures": 300.0}, "temperature"),
    ],
)
def test_what_cannot_be_predicted_is_refused(arguments, about):
    asked = {"material": RUBBER, "spectrum": ROAD, "speeds": 1.0, "pressure": 1e5, **arguments}
    with refused(about):
        vf.persson_theory(asked.pop("material"), asked.pop("spectrum"), **asked)
