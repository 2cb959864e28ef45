"""Normal motion of bodies of revolution: Lee–Radok, Ting, loss of contact and its return, energy, scales."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
import pytest

import viscofric as vf
from marks import apart
from refusals import refused
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.reference.hertz import hertz_ball
from viscofric.motion.march import march
from viscofric.motion.normal import NormalMotion
from viscofric.motion.solve import checked_problem
from viscofric.notes import codes, note_of

BALL = vf.Ball("10 mm")
E0, E_INF, TAU = 1e6, 1e7, 0.01
RUBBER = vf.Material.standard_linear_solid(E0=E0, E_inf=E_INF, tau=TAU)
TIMES = [1e-05, 0.0001, 0.001, 0.003, 0.01, 0.03, 0.1, 1.0]


def broad(count=40):
    """Return a spectrum of many modes from 10 µs to 10 s, E∞/E0 = 100."""
    tau = np.geomspace(1e-5, 1e1, count)
    weight = np.exp(-0.5 * (np.log10(tau / 1e-2) / 1.2) ** 2)
    return vf.Material(vf.RetardationSpectrum(1e6, 1e8, (1e-6 - 1e-8) * weight / weight.sum(), tau))


def test_creep_under_a_load_step_is_that_of_lee_and_radok():
    """a³ = (3/4)(1−ν²) R F J(t) at all times; errors of the edge within a spacing of springs."""
    run = vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], load=1.0), times=TIMES)
    radius = np.cbrt(0.75 * 0.75 * 0.01 * RUBBER.spectrum.creep_compliance(TIMES))
    # Independent solution, exact to 1e-12.
    assert radius[[0, 3, 7]] == pytest.approx([0.0008279496348089715, 0.001233020044283825, 0.0017784466522450314])
    assert run.contact_radius == pytest.approx(radius, rel=2e-4)
    assert run.indentation == pytest.approx(radius**2 / 0.01, rel=2e-5)
    assert run.energy_imbalance < 1e-4
    assert run.method == "springs"


def test_relaxation_after_a_depth_step_is_that_of_lee_and_radok():
    run = vf.motion.solve_transient(
        RUBBER, BALL, vf.motion.History([0.0, 1.0], indentation=2e-4), times=TIMES, accuracy=2e-4
    )
    force = 4.0 / 3.0 * math.sqrt(0.01) / 0.75 * 2e-4**1.5 * RUBBER.spectrum.relaxation_modulus(TIMES)
    assert force[[0, 3, 7]] == pytest.approx([4.983285576246332, 0.7281420402569823, 0.5028314888437672])
    assert run.load == pytest.approx(force, rel=1e-3)
    assert run.contact_radius == pytest.approx(math.sqrt(0.01 * 2e-4), rel=1e-3)


def test_depth_triangle_is_that_of_ting_until_the_contact_is_lost():
    """Independent solution, Ting's closed form (a dent from springs, to 1e-5): force, radius, then the dent."""
    times = [0.005, 0.01, 0.02, 0.021100030054028038, 0.022750075135070096, 0.025500150270140194, 0.028250225405210293]
    force = [0.21292375886848516, 0.4050487583394814, 0.8335269718455529, 0.3560896301680652, 0.1620341716762514,
             0.07397038150731819, 0.025700170640748535]  # fmt: skip
    radius = [0.0007071067811865476, 0.001, 0.0014142135623730952, 0.001258749461532855, 0.0009695630753054201,
              0.0007465521108715424, 0.0005248310384172931]  # fmt: skip
    dents = [8.143264820833617e-05, 3.310804407383914e-05, 4.480686522143278e-06]
    later = [0.032000300540280385, 0.041000300540280386, 0.06100030054028038]
    history = vf.motion.History([0.0, 0.02, 0.04, 0.1], indentation=[0.0, 2e-4, 0.0, -1e-4])
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=times + later)
    assert run.load[:7] == pytest.approx(force, rel=1e-3)
    assert run.contact_radius[:7] == pytest.approx(radius, rel=1e-3)
    assert run.dent[7:] == pytest.approx(dents, rel=1e-3)
    assert run.load[7:].tolist() == run.contact_radius[7:].tolist() == [0.0, 0.0, 0.0]
    every = vf.motion.solve_transient(RUBBER, BALL, history)
    lost = every.time[np.argmax((every.load == 0.0) & (every.time > 0.02))]
    assert lost == pytest.approx(0.031000300540280388, rel=0.05)  # within a step
    assert every.energy_imbalance < 1e-4


def test_load_triangle_is_that_of_ting_and_the_contact_grows_after_the_peak():
    times = [0.005, 0.01, 0.02, 0.025177207447404353, 0.028882905585553266, 0.03629430186185109, 0.04]
    radius = [0.0007430654023241031, 0.0010663194459865114, 0.001509029599697501, 0.001572399053834856,
              0.001462258179823218, 0.001013882258240686]  # fmt: skip
    depth = [5.521462484770873e-05, 0.00011370372179212933, 0.0002277170369035185, 0.0002472438692487943,
             0.00023977694780093003, 0.0001873009576915757, 0.0001385952660548365]  # fmt: skip
    history = vf.motion.History([0.0, 0.02, 0.04, 0.1], load=[0.0, 1.0, 0.0, 0.0])
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=[*times, 0.05, 0.07])
    assert run.contact_radius[:6] == pytest.approx(radius, rel=1e-3)
    assert run.indentation == pytest.approx([*depth, 5.0986349024894214e-05, 6.900251986484846e-06], rel=1e-3)
    assert run.contact_radius[3] > run.contact_radius[2]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("control", "mean", "amplitude", "energy", "largest", "deepest"),
    [
        ("indentation", 1e-4, 3e-5, 6.4332302583816205e-06, 0.2989555814087262, 1.3e-4),
        *apart(("load", 1.0, 0.5, 7.488136809986937e-05, 1.5, 0.00038735469814175433)),
        ("load", 1.0, 1.5, 0.0005514448777747074, 2.5, 0.0005149900095594225),
    ],
)
def test_an_oscillation_dissipates_what_the_independent_solution_does(
    control, mean, amplitude, energy, largest, deepest
):
    """Third cycle, 10 relaxation times after the start; the polygon of 144 points loses 3e-4 of the energy."""
    omega, points = 100.0, 144
    time = np.linspace(0.0, 6.0 * np.pi / omega, 3 * points + 1)
    values = mean + amplitude * np.sin(omega * time)
    history = vf.motion.History(time, **{control: np.maximum(values, 0.0)}, before="at rest")
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=time)
    assert run.work[-1] - run.work[-1 - points] == pytest.approx(energy, rel=1e-3)
    assert run.load[-points:].max() == pytest.approx(largest, rel=1e-3)
    assert run.indentation[-points:].max() == pytest.approx(deepest, rel=1e-3)


def test_forty_modes_creep_and_relax_as_they_should():
    """Lee–Radok with all modes: a load step, and a ramp of depth, F = (8/3) √R/(1−ν²) ∫E(t−t') d(δ^1.5)."""
    rubber, times = broad(), [1e-4, 1e-2, 1.0]
    run = vf.motion.solve_transient(rubber, BALL, vf.motion.History([0.0, 1.0], load=1.0), times=times)
    radius = np.cbrt(0.75 * 0.75 * 0.01 * rubber.spectrum.creep_compliance(times))
    assert run.contact_radius == pytest.approx(radius, rel=5e-4)
    run = vf.motion.solve_transient(
        rubber, BALL, vf.motion.History([0.0, 1.0], indentation=[0.0, 2e-4]), times=times[1:]
    )
    for time, load in zip(times[1:], run.load, strict=True):
        # d(δ^1.5) = 1.5 c^1.5 √t' dt', with t' = t(1 − x³) against the peak of E at t' = t
        x, w = np.polynomial.legendre.leggauss(400)
        x = 0.5 * (x + 1.0)
        past = rubber.spectrum.relaxation_modulus(time * x**3) * 1.5 * 2e-4**1.5 * np.sqrt(time * (1.0 - x**3))
        wanted = 4.0 / 3.0 * math.sqrt(0.01) / 0.75 * float((0.5 * w) @ (past * time * 3.0 * x**2))
        assert load == pytest.approx(wanted, abs=1e-3 * run.load[-1])


def test_cone_under_a_load_step():
    """F = (π/2) E* a² tan θ (I. N. Sneddon, 1965) with 1/E* → (1−ν²) J(t)."""
    angle = 0.1
    run = vf.motion.solve_transient(RUBBER, vf.Cone(angle), vf.motion.History([0.0, 1.0], load=1.0), times=TIMES)
    radius = np.sqrt(2.0 * 0.75 * RUBBER.spectrum.creep_compliance(TIMES) / (math.pi * math.tan(angle)))
    assert run.contact_radius == pytest.approx(radius, rel=5e-4)
    assert run.indentation == pytest.approx(0.5 * math.pi * math.tan(angle) * radius, rel=1e-4)


def test_punch_creeps_with_a_constant_radius():
    """F = 2 a E* δ (J. Boussinesq)."""
    run = vf.motion.solve_transient(RUBBER, vf.FlatPunch("1 mm"), vf.motion.History([0.0, 1.0], load=1.0), times=TIMES)
    assert run.contact_radius.tolist() == [1e-3] * len(TIMES)
    depth = 0.75 * RUBBER.spectrum.creep_compliance(TIMES) / (2.0 * 1e-3)
    assert run.indentation == pytest.approx(depth, rel=1e-4)


def test_an_elastic_ball_adds_its_compliance_without_memory():
    """Lee–Radok with (1−ν²) J + (1−ν_i²)/E_i."""
    run = vf.motion.solve_transient(
        RUBBER,
        BALL,
        vf.motion.History([0.0, 1.0], load=1.0),
        times=TIMES,
        indenter_modulus=2e6,
        indenter_poisson_ratio=0.3,
    )
    compliance = 0.75 * RUBBER.spectrum.creep_compliance(TIMES) + 0.91 / 2e6
    assert run.contact_radius == pytest.approx(np.cbrt(0.75 * 0.01 * compliance), rel=3e-4)


def test_at_rest_nothing_changes_and_the_pressure_is_that_of_hertz():
    run = vf.motion.solve_transient(
        RUBBER, BALL, vf.motion.History([0.0, 1.0], load=1.0, before="at rest"), times=[0.0, 0.5, 1.0]
    )
    hertz = hertz_ball(1.0, 0.01, E0, 0.5)
    assert run.indentation == pytest.approx(hertz.indentation, rel=1e-5)
    assert np.ptp(run.indentation) < 1e-12 * hertz.indentation
    pressure = run.pressure_at(0.5)
    inside = pressure.r.values < 0.95 * hertz.radius  # the last springs do not resolve the root at the edge
    shape = np.sqrt(1.0 - np.square(pressure.r.values[inside] / hertz.radius))
    assert pressure.values[inside] == pytest.approx(hertz.max_pressure * shape, rel=2e-3)
    ring = 2.0 * math.pi * float(np.trapezoid(pressure.values * pressure.r.values, pressure.r.values))
    assert ring == pytest.approx(1.0, rel=5e-3)
    assert run.dissipated[-1] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.slow
def test_contact_returns_on_the_dent_that_is_left():
    """After the separation one mode fades as e^{−t/τ}; the second touch is where the indenter meets the dent."""
    history = vf.motion.History([0.0, 0.02, 0.04, 0.06], indentation=[0.0, 2e-4, -1e-5, 2e-4])
    times = np.linspace(0.035, 0.06, 501)
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=times)
    free = run.load == 0.0
    first, last = np.flatnonzero(free)[[0, -1]]
    assert run.dent[last] == pytest.approx(run.dent[first] * math.exp(-(times[last] - times[first]) / TAU), rel=1e-6)
    assert run.indentation[last] <= run.dent[last]
    assert run.indentation[last + 1] == pytest.approx(run.dent[last], abs=1.1e-6)  # within 50 µs at 10.5 mm/s
    fresh = vf.motion.solve_transient(
        RUBBER, BALL, vf.motion.History([0.0, 0.02], indentation=[-1e-5, 2e-4]), times=[0.02]
    )
    assert run.load[-1] < fresh.load[-1]


def test_jumps_are_elastic_and_their_work_is_stored():
    history = vf.motion.History([0.0, 0.1, 0.1, 0.2], load=[1.0, 1.0, 0.5, 0.5])
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=[0.0, 0.1, 0.1, 0.2])
    hertz = hertz_ball(1.0, 0.01, E_INF, 0.5)
    assert run.indentation[0] == pytest.approx(hertz.indentation, rel=1e-5)
    assert run.work[0] == pytest.approx(0.4 * 1.0 * hertz.indentation, rel=1e-4)
    assert run.load.tolist() == [1.0, 1.0, 0.5, 0.5]
    assert run.dissipated[2] == run.dissipated[1]
    assert run.work[2] - run.work[1] == pytest.approx(run.stored[2] - run.stored[1], rel=1e-9)
    assert run.energy_imbalance < 1e-4


def test_a_mode_too_quick_for_any_step_dissipates_after_a_jump():
    """Work 0.4 F δ₀ of the glassy jump and F (δ₁ − δ₀) after it; 0.4 F δ₁ remains stored."""
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=1e-15)
    run = vf.motion.solve_transient(rubber, BALL, vf.motion.History([0.0, 1.0], load=1.0), times=[0.0, 1.0])
    first, last = run.indentation
    assert last == pytest.approx(hertz_ball(1.0, 0.01, E0, 0.5).indentation, rel=1e-4)
    assert run.dissipated == pytest.approx([0.0, 0.6 * (last - first)], rel=1e-4)
    assert run.energy_imbalance < 1e-4


@pytest.mark.parametrize(("tau", "end", "times"), [(1e-3, 1e9, [1e-4, 1e-3, 1e-2]), (1e-14, 1.0, None)])
def test_creep_at_times_much_shorter_than_the_history_is_that_of_lee_and_radok(tau, end, times):
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=tau)
    run = vf.motion.solve_transient(rubber, BALL, vf.motion.History([0.0, end], load=1.0), times=times)
    if times is not None:
        assert run.time.tolist() == times
    creep = rubber.spectrum.creep_compliance(run.time)
    exact = (0.75 * 0.75 * 0.01 * creep) ** (2.0 / 3.0) / 0.01
    assert np.all(np.abs(run.indentation - exact) <= run.errors.indentation)
    assert run.errors.indentation.max() < 2e-3 * exact[-1]


def test_temperature_runs_the_clock():
    """At another temperature a creep test is the same by the material's clock; a ramp too."""
    law = vf.WLF(C1=8.0, C2=100.0, reference=300.0)
    rubber = vf.Material(RUBBER.spectrum, shift=law)
    history = vf.motion.History([0.0, 0.2], load=1.0, temperature=[300.0, 320.0])
    times = [0.01, 0.05, 0.1]
    run = vf.motion.solve_transient(rubber, BALL, history, times=times)
    clock = [history.schedule(rubber, "point").at(time).clock for time in times]
    radius = np.cbrt(0.75 * 0.75 * 0.01 * RUBBER.spectrum.creep_compliance(clock))
    assert run.contact_radius == pytest.approx(radius, rel=5e-4)
    assert run.temperature == pytest.approx([301.0, 305.0, 310.0])


@pytest.mark.parametrize(("rest", "tau"), [(1.0, 2e-13), (1e5, 5e-8), (1.76e9, 1e-4)])  # s; the last as a date
def test_creep_just_after_a_jump_of_the_load_does_not_depend_on_how_long_it_has_rested(rest, tau):
    """Lee–Radok: a³ = (9/16) R (F/E0 + ΔF J(t)); t is a difference of times up to 1e15 times as long."""
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=tau)
    history = vf.motion.History([0.0, rest, rest, 2.0 * rest], load=[1.0, 1.0, 2.0, 2.0], before="at rest")
    times = rest + np.array([0.05, 0.5, 5.0, 50.0]) * tau
    run = vf.motion.solve_transient(solid, BALL, history, times=times)
    radius = np.cbrt(0.75 * 0.75 * 0.01 * (1e-6 + 1e-6 - 9e-7 * np.exp(-(times - rest) / tau)))
    assert run.indentation == pytest.approx(radius**2 / 0.01, rel=1e-5)  # 400 springs
    assert run.errors.indentation.max() < 1e-3 * run.indentation.min()


def test_warming_by_many_decades_is_that_of_lee_and_radok_at_any_times_asked_for():
    """δ = (9/16 F' ∫J(ξ(t) − ξ(s)) ds)^(2/3)/R^(1/3) under a growing load; α falls by 12 decades, ten of them later."""
    law, kelvin = vf.WLF(8.0, 50.0, "300 K"), [275.0, 380.0]
    tau = np.geomspace(1e-9, 10.0, 12)
    rubber = vf.Material(vf.RetardationSpectrum(1e6, 1e8, np.full(12, 0.99e-6 / 12), tau), shift=law)
    history = vf.motion.History([0.0, 1.0], load=[0.0, 0.05], temperature=kelvin)
    spectrum = rubber.modes_at(kelvin[0])
    for times in ([1e-2], [1e-4, 1e-3, 1e-2]):
        run = vf.motion.solve_transient(rubber, BALL, history, times=times, accuracy=3e-3)
        for time, depth, error in zip(times, run.indentation, run.errors.indentation, strict=True):
            edges = np.linspace(0.0, time, 4001)
            rate = 10.0 ** (law.log10(kelvin[0]) - law.log10(np.interp(edges, [0.0, 1.0], kelvin)))
            clock = np.append(0.0, np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(edges)))
            creep = spectrum.creep_compliance(clock[-1] - 0.5 * (clock[1:] + clock[:-1]))
            exact = (0.75 * 0.75 * 0.01 * 0.05 * float(creep @ np.diff(edges))) ** (2.0 / 3.0) / 0.01
            assert abs(depth - exact) < error
            assert error < 0.05 * run.indentation[-1]


def test_scales_do_not_matter():
    """Moduli by 1e6, lengths by 1e-3, times by 1e9."""
    E, L, T = 1e6, 1e-3, 1e9
    one = vf.motion.solve_transient(
        RUBBER, BALL, vf.motion.History([0.0, 0.02, 0.04], load=[0.0, 1.0, 0.0]), times=[0.01, 0.03]
    )
    scaled = vf.Material.standard_linear_solid(E0=E * E0, E_inf=E * E_INF, tau=T * TAU)
    history = vf.motion.History([0.0, 0.02 * T, 0.04 * T], load=[0.0, E * L**2, 0.0])
    other = vf.motion.solve_transient(scaled, vf.Ball(0.01 * L), history, times=[0.01 * T, 0.03 * T])
    assert other.indentation == pytest.approx(L * one.indentation, rel=1e-9)
    assert other.dissipated == pytest.approx(E * L**3 * one.dissipated, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
def test_estimated_errors_bound_the_true_ones(accuracy):
    history = vf.motion.History([0.0, 0.02, 0.04], load=[0.0, 1.0, 0.0])
    times = np.linspace(0.002, 0.04, 20)
    rough = vf.motion.solve_transient(RUBBER, BALL, history, times=times, accuracy=accuracy)
    exact = vf.motion.solve_transient(RUBBER, BALL, history, times=times, accuracy=5e-5)
    assert np.all(rough.errors.indentation <= accuracy * exact.indentation.max())
    assert np.all(np.abs(rough.indentation - exact.indentation) <= 2.0 * rough.errors.indentation)
    assert np.all(np.abs(rough.dissipated - exact.dissipated) <= 2.0 * rough.errors.energy)


@pytest.mark.parametrize(
    ("control", "indenter"),
    [
        ("load", BALL),
        ("indentation", vf.Cone(0.1)),
        *apart(("load", vf.Cone(0.1)), ("indentation", BALL)),
    ],
    ids=["load on a ball", "depth of a cone", "load on a cone", "depth of a ball"],
)
def test_stated_errors_cover_those_of_random_histories(control, indenter):
    """Each is within twice its error, against 3.2 times the springs and a tenth of the error of steps.

    Of 80 such problems 99 % of the loads and depths were within their errors, 95 % of the energies; the worst was 1.7
    and 4 times as large.
    """
    chance = np.random.default_rng(7)
    for _ in range(2):
        modes = int(chance.integers(1, 6))
        weight = chance.random(modes)
        ratio = float(chance.uniform(2.0, 20.0))
        spectrum = vf.RetardationSpectrum(
            1e6, 1e6 * ratio, (1e-6 - 1e-6 / ratio) * weight / weight.sum(), np.sort(10 ** chance.uniform(-3, 0, modes))
        )
        time = np.concatenate([[0.0], np.cumsum(10 ** chance.uniform(-3, -1, 3))])
        values = chance.random(4) * (1.0 if control == "load" else 2e-4)
        history, times = vf.motion.History(time, **{control: values}), np.sort(chance.uniform(0.0, time[-1], 8))
        rough = vf.motion.solve_transient(vf.Material(spectrum), indenter, history, times=times)
        exact = vf.motion.solve_transient(vf.Material(spectrum), indenter, history, times=times, accuracy=1e-4)
        for name, error in (("load", "load"), ("indentation", "indentation"), ("dissipated", "energy")):
            off = np.abs(getattr(rough, name) - getattr(exact, name))
            rounding = 1e-12 * float(getattr(exact, name).max())
            assert np.all(off <= 2.0 * getattr(rough.errors, error) + rounding), name


def test_the_stated_error_holds_where_a_contact_returns_to_the_dent_that_it_left():
    """Without the parts of steps before and after a spring is left, loads on the return are off by 2.5 errors."""
    material = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    history = vf.motion.History([0.0, 0.1, 0.13, 0.16], indentation=[0.0, 1e-4, 5e-5, 1e-4])
    times = np.linspace(0.1301, 0.16, 12)
    rough, exact = (
        vf.motion.solve_transient(material, BALL, history, times=times, accuracy=one) for one in (1e-2, 1e-4)
    )
    assert np.all(np.abs(rough.load - exact.load) <= rough.errors.load)


def test_the_error_of_a_small_loss_after_a_long_rest_is_not_in_proportion_to_the_loss():
    """A contact at rest stores a thousand times what a short change of its load dissipates, at its edge only."""
    stiff = vf.Material.standard_linear_solid(E0=1e6, E_inf=43e6, tau=1.236e-3)
    history = vf.motion.History([0.0, 3.51e-5, 3.72e-5], load=[0.44, 0.48, 0.74], before="at rest")
    times = np.linspace(0.0, 3.72e-5, 40)
    rough, exact = (vf.motion.solve_transient(stiff, BALL, history, times=times, accuracy=one) for one in (1e-2, 1e-4))
    assert np.all(np.abs(rough.dissipated - exact.dissipated) <= rough.errors.energy)
    assert rough.errors.energy[-1] < 0.05 * exact.dissipated[-1]


@dataclass(frozen=True)
class Rippled(Indenter):
    """A ball with rings: it touches the material in rings."""

    noun = "rippled ball"

    def height(self, x, y):
        return (x**2 + y**2) / 0.02 + 2e-5 * (1.0 - np.cos(np.hypot(x, y) / 1e-4))

    def slope(self, x, y):
        r = np.hypot(x, y)
        return x / 0.01 + 2e-1 * np.sin(r / 1e-4) * x / np.where(r > 0.0, r, 1.0)

    def slope_across(self, x, y):
        return self.slope(y, x)

    def strain_warning(self, contact, indentation):
        return None


def test_a_contact_that_is_no_disc_is_solved_on_cells():
    """At a constant depth a contact of any shape stays as it is: the load relaxes with the modulus."""
    run = vf.motion.solve_transient(
        RUBBER, Rippled(), vf.motion.History([0.0, 0.05], indentation=3e-5), times=[0.0, 0.001, 0.05], accuracy=0.05
    )
    assert "not-one-disc" in codes(run.warnings)
    assert run.method == "grid"
    assert run.load[1:] / run.load[0] == pytest.approx(RUBBER.spectrum.relaxation_modulus([1e-3, 0.05]) / 1e7, rel=0.02)


def test_a_vertical_shift_at_one_temperature_scales_the_load():
    """F of a given depth is b(T) times that without the shift; the times are the same."""
    law, shift = vf.WLF(C1=8.0, C2=100.0, reference=300.0), vf.rheology.DensityShift(300.0)
    history = vf.motion.History([0.0, 0.1], indentation=2e-4, temperature=330.0)
    loads = [
        vf.motion.solve_transient(
            vf.Material(RUBBER.spectrum, shift=law, vertical_shift=one), BALL, history, times=[0.0, 0.01]
        ).load
        for one in (None, shift)
    ]
    b = float(shift(330.0))
    assert abs(b - 1.0) > 0.02
    assert loads[1] == pytest.approx(b * loads[0], rel=1e-6)


def test_a_march_continues_from_a_stored_state():
    """In two parts with one mover, as in one; steps differ, within the accuracy."""
    whole = vf.motion.History([0.0, 0.02, 0.04], load=[0.0, 1.0, 0.2])
    problem = checked_problem(RUBBER, BALL, whole, 1e-3, None, None, 0.3)
    mover = NormalMotion.of(problem)
    first = march(mover, vf.motion.History([0.0, 0.02], load=[0.0, 1.0]).schedule(RUBBER, "point"), accuracy=1e-3)
    second = vf.motion.History([0.02, 0.04], load=[1.0, 0.2]).schedule(RUBBER, "point")
    found = march(mover, second, accuracy=1e-3, begin=first.reached).moments[-1]
    run = vf.motion.solve_transient(RUBBER, BALL, whole, times=[0.04])
    assert found.seen.depth == pytest.approx(run.indentation[-1], rel=1e-3)
    assert found.work == pytest.approx(run.work[-1], rel=1e-3)


def test_interruption_keeps_what_was_found():
    def stop(reached, end):
        assert end == 0.04
        if reached > 0.02:
            raise KeyboardInterrupt

    history = vf.motion.History([0.0, 0.02, 0.04], load=[0.0, 1.0, 0.0])
    run = vf.motion.solve_transient(RUBBER, BALL, history, progress=stop)
    assert run.interrupted
    assert 0.02 <= run.time[-1] < 0.04


def test_what_cannot_be_solved_is_refused():
    with refused("beyond-indenter"):
        vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], load=5e3))
    with refused("not-sorted"):
        vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], load=1.0), times=[1.0, 0.0])
    with refused("out-of-range"):
        vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], load=1.0), times=[2.0])
    run = vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 1.0], load=1.0), times=[0.5])
    with refused("unknown-time"):
        run.pressure_at(0.25)
    assert run.to_dataset().indentation.units == "m"


@pytest.mark.slow
def test_the_contact_is_one_disc_in_any_history():
    """Forces of springs rise outwards only by the errors of single steps: 4 % of the largest, and not at all."""
    rubber, time = broad(3), np.linspace(0.0, 1.0, 2561)
    values = 1e-4 * np.interp(time, np.linspace(0.0, 1.0, 14), np.random.default_rng(11).uniform(-0.5, 1.0, 14))
    history = vf.motion.History(time, indentation=values)
    mover = NormalMotion.of(checked_problem(rubber, BALL, history, 1e-2, None, None, 0.3))
    schedule, rises = history.schedule(rubber, "point"), []
    for stride in (16, 1):
        state, most, rise = mover.begin(), 0.0, 0.0
        for start, end in itertools.pairwise(map(schedule.at, time[::stride].tolist())):
            state = mover.step(state, start, end)
            most = max(most, state.force.max())
            rise = max(rise, np.max(state.force - np.minimum.accumulate(state.force)))
        rises.append(rise / most)
    assert 0.01 < rises[0] < 0.1
    assert rises[1] < 1e-9


@pytest.mark.parametrize("end", [1e4, 1e6])
def test_relaxation_after_a_quick_indentation_is_solved_however_long_it_is(end: float) -> None:
    """The load of Lee and Radok, long after the indentation: 4/3 √R E(t)/(1 − ν²) δ^(3/2)."""
    tau = np.geomspace(1e-6, 1e4, 11)
    rubber = vf.Material(vf.RetardationSpectrum(1e6, 1e9, np.full(11, (1e-6 - 1e-9) / 11), tau))
    history = vf.motion.History([0.0, 1e-3, end], indentation=[0.0, 1e-4, 1e-4])
    run = vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=[end], accuracy=1e-3)
    relaxed = 4.0 / 3.0 * np.sqrt(0.01) * 1e-6 / 0.75 * rubber.spectrum.relaxation_modulus(end)
    assert run.load[0] == pytest.approx(relaxed, rel=1e-3)


def test_waves_of_an_oscillation_are_those_of_a_disc_at_low_frequencies() -> None:
    a, omega, nu = 5e-3, 2.0 * np.pi * 1000.0, 1.0 / 3.0
    hard = vf.Material.standard_linear_solid(E0=1e6, E_inf=1.0001e6, tau=1.0, poisson_ratio=nu)
    time = np.linspace(0.0, 2.0 * np.pi / omega, 65)

    def notes(load):
        history = vf.motion.History(time, load=load, before="at rest")
        run = vf.motion.solve_transient(hard, vf.FlatPunch(a), history)
        return [one for one in map(note_of, run.warnings) if one.code == "quasi-static"]

    (note,) = notes(1.0 + 0.5 * np.sin(omega * time))
    waves = np.sqrt(1e6 / (2.0 * (1.0 + nu) * note.values["density"]))
    assert note.values["wave_speed"] == pytest.approx(waves, rel=1e-3)
    # J. Lysmer's analogue (University of Michigan, 1965), fitted to higher frequencies too: damping 0.85 a/c of the
    # stiffness; dF/dt is a third of ω of the largest load
    assert note.values["change"] == pytest.approx(0.85 * omega / 3.0 * a / waves, rel=0.1)
    assert not notes(1.0 + 0.01 * np.sin(omega * time))
