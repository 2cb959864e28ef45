"""Rough periodic surfaces in motion: steady ends, closed forms, a second solver, energies, invariances."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from motion.dense_wave import displacement_matrix, marched
from refusals import refused
from viscofric.contact.reference import westergaard
from viscofric.motion.memory import Modes
from viscofric.motion.mover import Observation, Problem
from viscofric.motion.periodic import PeriodicMover
from viscofric.motion.wave_memory import StepResponse, advance, merged_modes, stored_energy
from viscofric.notes import note_of
from viscofric.rheology.spectra.quality import SpectrumFit

LENGTH = 1e-3
SLS = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
TWO_MODES = vf.Material(vf.RetardationSpectrum("1 MPa", "10 MPa", [4e-7, 5e-7], [1e-3, 4e-3]))


def profile(points: int) -> vf.contact.PeriodicSurface:
    x = 2.0 * np.pi * np.arange(points) / points
    return vf.contact.PeriodicSurface(1e-6 * (np.cos(x) + 0.3 * np.cos(3.0 * x + 1.0)), LENGTH / points)


def crossed(points: int = 16) -> vf.contact.PeriodicSurface:
    x = 2.0 * np.pi * np.arange(points) / points
    z = np.cos(x)[:, None] + 0.7 * np.cos(x + 0.4) + 0.3 * np.cos(x[:, None] + 2.0 * x)
    return vf.contact.PeriodicSurface(1e-6 * z, LENGTH / points)


def mover(
    material: vf.Material, surface: vf.contact.PeriodicSurface, history: vf.motion.History, **more: Any
) -> PeriodicMover:
    layer = more.pop("layer", None)
    problem = Problem(material, surface, history.schedule(material, "periodic"), 1e-4, layer, 0.0)
    return PeriodicMover(problem, **more)


def stepped(one: PeriodicMover, times: list[float]) -> list[Observation]:
    """Take given steps."""
    schedule = one.schedule
    state = one.begin()
    seen = []
    if schedule.before == "untouched":
        first = schedule.at(times[0], after=False)
        state = one.step(state, first, first)
    seen.append(one.observe(state))
    for start, end in itertools.pairwise(times):
        state = one.step(state, schedule.at(start), schedule.at(end, after=False))
        seen.append(one.observe(state))
    return seen


@pytest.mark.parametrize("shape", [(1, 4), (4, 1), (2, 2)])  # waves that turn along y, along x, and aslant
@pytest.mark.parametrize("kappa", [1e-7, 1e-2, 2.0, 50.0])
def test_energy_of_a_step_is_the_integral_of_its_parts(kappa: float, shape: tuple[int, int]) -> None:
    # The closed form of what a mode dissipates, against Simpson's rule on 400 exact parts of the step.
    generator = np.random.default_rng(3)
    turn = np.array([0.0, 1e-5, 0.3, -4.0]).reshape(shape)
    q0, p0, p1 = generator.normal(size=(3, *shape)) + 1j * generator.normal(size=(3, *shape))
    modes = Modes(1.0, np.array([2.0]), np.array([1.0]))
    whole = advance(
        StepResponse.of(modes, np.array([kappa]), turn), modes, q0[None], (p0, p1), stored_energy(modes, q0[None])
    )
    parts = 400
    small = StepResponse.of(modes, np.array([kappa / parts]), turn / parts)
    q, squares = q0[None], []
    for i in range(parts + 1):
        p = p0 + (p1 - p0) * i / parts
        squares.append(float((np.abs(p - q[0]) ** 2).sum()))
        q = advance(small, modes, q, (p, p0 + (p1 - p0) * (i + 1) / parts), 0.0).memory if i < parts else q
    simpson = squares[0] + squares[-1] + 4.0 * sum(squares[1::2]) + 2.0 * sum(squares[2:-1:2])
    assert whole.memory == pytest.approx(q, rel=1e-9, abs=1e-9)
    assert whole.dissipated == pytest.approx(2.0 * kappa * simpson / (3 * parts), rel=1e-4)
    assert whole.stored == pytest.approx(float((np.abs(q[0]) ** 2).sum()), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("cells", [1, 8, 32])
def test_steady_sliding_is_met_exactly_by_coarse_steps(cells: int) -> None:
    # One wave, vτ = λ/8: 12 λ later the start is forgotten to e⁻⁹⁶; the tolerance is that of the contact solver.
    points = 128
    wave = vf.contact.PeriodicSurface(1e-6 * np.cos(2.0 * np.pi * np.arange(points) / points), LENGTH / points)
    speed, pressure = LENGTH / 8.0 / 1e-3, 1e3
    steady = vf.solve_periodic(SLS, wave, speed=speed, pressure=pressure, tolerance=1e-10)
    one = mover(SLS, wave, vf.motion.History([0.0, 12.0 * LENGTH / speed], pressure=pressure, speed=speed))
    times = np.linspace(0.0, 12.0 * LENGTH / speed, 1 + 12 * points // cells // 4 * 4)
    seen = stepped(one, times[:: 4 if cells == 1 else 1].tolist())[-1]
    assert seen.friction_force[0] / pressure == pytest.approx(steady.friction_coefficient, rel=3e-6)
    assert seen.depth == pytest.approx(steady.indentation, rel=3e-6)


@pytest.mark.parametrize("control", [{"pressure": 2e3}, {"gap": "1.1 um"}])
@pytest.mark.parametrize("layer", [None, vf.Layer("0.2 mm")])
def test_end_of_a_turn_is_steady_sliding_in_the_new_direction(control: dict[str, Any], layer: vf.Layer | None) -> None:
    material, speed = vf.Material(TWO_MODES.spectrum, poisson_ratio=0.45), 0.1
    first = [0.005 * speed, 0.0]
    path = [[0.0, 0.0], first, [first[0] + 0.6 * 0.2 * speed, 0.8 * 0.2 * speed]]
    history = vf.motion.History([0.0, 0.005, 0.205], position=path, **control)
    seen = stepped(
        mover(material, crossed(17), history, layer=layer),
        [*np.linspace(0.0, 0.005, 6), *np.linspace(0.005, 0.205, 16)[1:]],
    )[-1]
    steady = vf.solve_periodic(
        material, crossed(17), speed=speed, direction=(0.6, 0.8), layer=layer, tolerance=1e-9, **control
    )
    along, across = np.array([[0.6, 0.8], [-0.8, 0.6]]) @ seen.friction_force
    # An odd number of points has no Nyquist waves, whose friction the steady solution leaves out.
    assert along / steady.mean_pressure == pytest.approx(steady.friction_coefficient, rel=1e-5)
    assert across / steady.mean_pressure == pytest.approx(
        steady.lateral_friction_coefficient, abs=1e-5 * steady.friction_coefficient
    )
    assert seen.load == pytest.approx(steady.mean_pressure, rel=1e-5)
    assert seen.depth == pytest.approx(steady.indentation, rel=1e-5)
    assert seen.area == pytest.approx(steady.contact_area_fraction)


@pytest.mark.parametrize("before", ["at rest", "sliding"])
def test_what_was_there_before_goes_on(before: str) -> None:
    speed = 0.1 if before == "sliding" else 0.0
    one = mover(TWO_MODES, crossed(), vf.motion.History([0.0, 1.0], pressure=2e3, speed=speed, before=before))
    first, *others = stepped(one, [0.0, 1e-5, 2e-3, 1.0])
    for later in others:
        # Without friction, to 1e-5 of pressure times slope.
        assert later.friction_force == pytest.approx(first.friction_force, rel=1e-5, abs=1e-4)
        assert later.depth == pytest.approx(first.depth, rel=1e-5)
        assert later.stored == pytest.approx(first.stored, rel=1e-5)
    # Sliding dissipates friction times path, rest nothing but the rounding of a memory in single precision.
    assert others[-1].dissipated == pytest.approx(first.friction_force[0] * speed, rel=1e-4, abs=1e-7 * first.stored)


@pytest.mark.slow
@pytest.mark.parametrize("before", ["at rest", "sliding"])
def test_first_step_from_a_steady_state_bears_the_pressure_at_its_end(before: str) -> None:
    # The steady pressure meets the contact conditions of that step too, under the old load.
    history = vf.motion.History([0.0, 1e-3], pressure=[1e3, 2e3], speed=1.0, before=before)
    seen = stepped(mover(TWO_MODES, profile(32), history), [0.0, 5e-4, 1e-3])
    np.testing.assert_allclose([one.load for one in seen], [1e3, 1.5e3, 2e3], rtol=1e-12)  # rounding
    start = [0.0, 0.0, 1e-3]
    rest = mover(TWO_MODES, profile(32), vf.motion.History(start, pressure=[1e3, 2e3, 2e3], before=before, speed=1.0))
    schedule = rest.schedule
    after = rest.step(rest.begin(), schedule.at(0.0, after=False), schedule.at(0.0))
    assert rest.observe(after).load == pytest.approx(2e3, rel=1e-12)


def test_growing_contact_is_elastic_with_the_creep_compliance() -> None:
    # E. H. Lee, J. R. M. Radok, J. Appl. Mech. 27 (1960) 438: while a contact grows, depth and extent under a constant
    # load are those of an elastic solid with the modulus 1/J(t); Westergaard's wave among them.
    points, pressure = 96, 2e3
    wave = vf.contact.PeriodicSurface(1e-6 * np.cos(2.0 * np.pi * np.arange(points) / points), LENGTH / points)
    times = [1e-4, 1e-3, 1e-2]
    run = vf.motion.solve_transient(TWO_MODES, wave, vf.motion.History([0.0, 1e-2], pressure=pressure), times=times)
    for i, time in enumerate(times):
        modulus = 1.0 / float(TWO_MODES.spectrum.creep_compliance(time))
        elastic = vf.Material.standard_linear_solid(modulus, 1.001 * modulus, "1 s")
        same = vf.solve_periodic(elastic, wave, speed=0.0, pressure=pressure)
        assert run.indentation[i] == pytest.approx(same.indentation, rel=1e-3)
        closed = westergaard(pressure, "1 um", LENGTH, modulus, 0.5)
        assert run.contact_area[i] == pytest.approx(closed.area_fraction, abs=1.5 / points)  # an edge is within a point


@pytest.mark.slow
def test_sliding_of_a_second_solver() -> None:
    # There and back under a rising pressure.  The second solver moves by whole points; its error falls as their square.
    speed, errors = 0.1, []
    for points in (48, 96):
        surface = profile(points)
        step, half, count = LENGTH / points / speed, points // 2, 3 * points // 4
        time = step * np.arange(count + 1)
        shift = np.arange(count + 1)
        shift[half:] = 2 * half - shift[half:]
        pressure = 1e3 * (1.0 + np.arange(count + 1) / count)
        matrix = displacement_matrix(points, surface.spacing[0], 0.5)
        found, depth = marched(
            surface.z.max() - surface.z[:, 0], matrix, TWO_MODES.spectrum.creep_compliance, time, shift, pressure
        )
        position = LENGTH / points * shift[[0, half, -1]]
        history = vf.motion.History(time[[0, half, -1]], pressure=pressure[[0, half, -1]], position=position)
        one = mover(TWO_MODES, surface, history)
        seen = stepped(one, (0.5 * step * np.arange(2 * count + 1)).tolist())[::2]
        slope = surface.slope((1.0, 0.0))[:, 0]
        forces = -(found * slope).mean(axis=1)
        friction = np.array([each.friction_force[0] for each in seen])
        errors.append(np.abs(forces - friction)[points // 8 :].max() / np.abs(friction).max())
        assert np.abs([each.depth for each in seen] - depth).max() < (48 / points) ** 2 * 6e-3 * depth.max()
    assert errors[0] < 0.05
    assert errors[1] < 0.4 * errors[0]


def test_normal_motion_of_a_second_solver() -> None:
    # Loading, unloading to nothing and loading again, at rest: the same assumption within steps, another memory.
    points, surface = 48, profile(48)
    time = np.linspace(0.0, 6e-3, 31)
    pressure = 1e3 * np.interp(time, [0.0, 2e-3, 3e-3, 4e-3, 6e-3], [0.5, 2.0, 1e-6, 1e-6, 1.5])
    matrix = displacement_matrix(points, surface.spacing[0], 0.5)
    found, depth = marched(
        surface.z.max() - surface.z[:, 0],
        matrix,
        TWO_MODES.spectrum.creep_compliance,
        time,
        0 * np.arange(31),
        pressure,
    )
    one = mover(TWO_MODES, surface, vf.motion.History(time, pressure=pressure), modes=Modes.of(TWO_MODES.spectrum))
    seen = stepped(one, time.tolist())
    assert [each.depth for each in seen] == pytest.approx(depth, rel=2e-6, abs=2e-6 * depth.max())
    assert [each.area for each in seen] == pytest.approx((found > 0.0).mean(axis=1), abs=1e-9)


@pytest.mark.parametrize(("control", "values"), [("pressure", [400.0, 100.0]), ("gap", [5e-7, 9e-7])])
def test_errors_by_the_contact_conditions_are_as_small_as_stated(control: str, values: list[float]) -> None:
    # Against the same steps with a twentieth of the tolerance: a contact that begins to slide while it gets lighter.
    history = vf.motion.History([0.0, 2e-3], **{control: values}, speed=[1.0, 0.2], before="at rest")
    one, finer = (mover(TWO_MODES, crossed(), history) for _ in range(2))
    finer._tightness *= 0.05
    times = np.linspace(0.0, 2e-3, 13).tolist()
    scales = one.scales
    for rough, fine in zip(stepped(one, times), stepped(finer, times), strict=True):
        largest = max(scales.friction, np.abs(fine.friction_force).max())
        floor = one.floor(scales._replace(load=max(scales.load, fine.load), friction=largest))
        assert abs(rough.depth - fine.depth) <= floor.depth
        assert abs(rough.load - fine.load) <= floor.load
        friction = np.subtract(rough.friction_force, fine.friction_force)
        assert np.abs(friction).max() <= floor.friction


@pytest.mark.slow
def test_pressure_may_go_and_come_back() -> None:
    history = vf.motion.History([0.0, 1e-3, 2e-3, 3e-3, 8e-3], pressure=[1e3, 1e3, 0.0, 0.0, 1e3], speed=0.05)
    run = vf.motion.solve_transient(TWO_MODES, profile(48), history, times=[1e-3, 2.5e-3, 8e-3], accuracy=1e-2)
    assert run.contact_area[1] == 0.0
    assert run.friction_force[1] == 0.0
    assert run.friction_coefficient[[0, 2]].min() > 0.0
    assert 0.0 < run.indentation[1] < run.indentation[0]  # the dent has not recovered


def test_coulomb_friction_turns_with_the_motion_and_ends_with_it_and_with_the_load() -> None:
    """Along the direction of the history, 0.6 of the way; at both sides of jumps; the contact is as without it."""
    times = [0.0, 1e-3, 1e-3, 2e-3, 2e-3, 3e-3]
    path = np.outer([2.0, 2.0, -1.0, -1.0, 0.0, 0.0], [0.6, 0.8])
    history = vf.motion.History(times, pressure=[1e3, 1e3, 1e3, 0.0, 0.0, 1e3], speed=path, before="sliding")
    plain, run = (
        vf.motion.solve_transient(TWO_MODES, crossed(4), history, times=times, accuracy=5e-2, coulomb=coulomb)
        for coulomb in (0.0, 0.5)
    )
    assert run.interface_friction == pytest.approx([0.3, 0.3, -0.3, 0.0, 0.0, 0.0])
    assert np.array_equal(run.friction_coefficient, plain.friction_coefficient)
    assert np.array_equal(run.total, plain.friction_coefficient + run.interface_friction)
    assert np.array_equal(run.to_dataset()["total_friction"], run.total)
    with refused("no-interface"):
        _ = plain.total


@pytest.mark.slow
def test_work_is_stored_or_dissipated() -> None:
    # From rest into sliding, aside, and to rest: work, stored and dissipated energy are computed independently.
    path = [[0.0, 0.0], [2e-4, 0.0], [3e-4, 1e-4], [3e-4, 1e-4]]
    history = vf.motion.History([0.0, 2e-3, 4e-3, 6e-3], pressure=[1e3, 2e3, 1e3, 1e3], position=path, before="at rest")
    run = vf.motion.solve_transient(TWO_MODES, crossed(12), history, accuracy=3e-3, times=[0.0, 2e-3, 4e-3, 6e-3])
    assert run.energy_imbalance < 1e-4
    assert run.dissipated[-1] > 0.3 * run.work[-1] > 0.0


def test_quick_modes_dissipate_after_a_jump() -> None:
    """A wave in full contact stores E q z²/(8 (1 − ν²)) per area: with E_inf at once, soon afterwards with E0."""
    z = 1e-6 * np.cos(2.0 * np.pi * np.arange(16) / 16)[:, None]
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=1e-9)
    surface, history = vf.contact.PeriodicSurface(z, (1e-5, 1e-5)), vf.motion.History([0.0, 1.0], pressure=1e8)
    run = vf.motion.solve_transient(solid, surface, history, times=[0.0, 1.0])
    stored = np.array([1e7, 1e6]) / 0.75 * 2.0 * np.pi / 16e-5 * 1e-12 / 8.0
    assert run.stored == pytest.approx(stored, rel=2e-7)  # a memory in single precision
    assert run.dissipated == pytest.approx([0.0, stored[0] - stored[1]], rel=1e-3)


def test_temperature_sets_the_pace_of_the_material() -> None:
    # After a rise of the temperature the same path in the same time is that in a longer time without it.
    warm = vf.Material(TWO_MODES.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference="20 degC"))
    pace = 1.0 / float(warm.shift("40 degC"))
    path = [0.0, 3e-4, 3e-4, 6e-4]
    rise = vf.motion.History(
        [0.0, 1e-3, 1e-3, 3e-3], pressure=2e3, position=path, temperature=["20 degC", "20 degC", "40 degC", "40 degC"]
    )
    longer = vf.motion.History(
        [0.0, 1e-3, 1e-3, 1e-3 + 2e-3 * pace], pressure=2e3, position=path, temperature="20 degC"
    )
    seen = []
    for history, later in ((rise, 1e-3), (longer, 1e-3 * pace)):
        one = mover(warm, profile(32), history, modes=Modes.of(warm.spectrum))
        times = [0.0, 5e-4, 1e-3, 1e-3 + later, 1e-3 + 2.0 * later]
        seen.append(
            [[each.friction_force[0], each.depth, each.stored, each.dissipated] for each in stepped(one, times)]
        )
    assert pace > 2.0
    assert np.array(seen[0]) == pytest.approx(np.array(seen[1]), rel=1e-6, abs=1e-12)


def test_cooling_by_nine_decades_after_a_jump_is_solved_within_its_errors() -> None:
    """At first ten modes follow the jump in less than 1e-12 s; the last two govern the friction at the end."""
    law = vf.WLF(C1=17.44, C2=51.6, reference="280 K")
    spectrum = vf.RetardationSpectrum(1e6, 1e8, np.full(12, 0.99e-6 / 12), np.geomspace(1e-9, 1e3, 12))
    history = vf.motion.History([0.0, 1.0], pressure=2e4, speed=1e-4, temperature=[380.0, 290.0])
    z = 1e-6 * np.cos(2.0 * np.pi * np.arange(12) / 12)[:, None]
    rubber, surface = vf.Material(spectrum, shift=law), vf.contact.PeriodicSurface(z, 1e-4 / 12)
    one, finer = (
        vf.motion.solve_transient(rubber, surface, history, times=[0.0, 0.5, 1.0], accuracy=accuracy)
        for accuracy in (3e-2, 6e-3)
    )
    for name, energy in (("friction_force", False), ("indentation", False), ("dissipated", True)):
        off = np.abs(getattr(one, name) - getattr(finer, name))
        assert np.all(off <= getattr(one.errors, "energy" if energy else name)), name
    assert finer.friction_coefficient[-1] > 100.0 * finer.errors.friction_force[-1] / 2e4 > 0.0
    assert finer.energy_imbalance < 6e-3


def test_what_follows_a_jump_of_the_pressure_does_not_depend_on_how_long_it_has_rested() -> None:
    """At requested times the accuracy is met, however soon after the jump: modes that matter there are not merged."""
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=5e-8)
    later = 1e5 + np.array([1e-8, 1e-7, 1e-6])
    rested, jumped = (
        vf.motion.solve_transient(
            solid,
            profile(16),
            vf.motion.History([rest - 1.0, rest, rest, 2e5], pressure=[100.0, 100.0, 1.2e3, 1.2e3], before="at rest"),
            times=later - 1e5 + rest,
        )
        for rest in (1e5, 0.0)
    )
    assert rested.indentation == pytest.approx(jumped.indentation, rel=1e-6)
    assert rested.indentation[0] < 0.6 * rested.indentation[2]
    assert rested.errors.indentation.max() < 1e-3 * rested.indentation.max()


@pytest.mark.parametrize("speed", [[0.02, 2.0, 2.0], [0.2, 0.2, 0.2]])
def test_sliding_before_a_jump_at_the_start_is_at_the_first_speed_and_temperature(speed: list[float]) -> None:
    material = vf.Material(SLS.spectrum, shift=vf.Arrhenius("60 kJ/mol", reference="20 degC"))
    history = vf.motion.History(
        [0.0, 0.0, 1e-2], pressure=1e3, speed=speed, temperature=["20 degC", "40 degC", "40 degC"], before="sliding"
    )
    run = vf.motion.solve_transient(material, profile(32), history, times=[0.0, 0.0, 1e-2], accuracy=1e-2)
    for row, place, temperature in ((0, 0, "20 degC"), (2, 2, "40 degC")):
        steady = vf.solve_periodic(material, profile(32), speed=speed[place], pressure=1e3, temperature=temperature)
        off = steady.diagnostics.friction_error + run.friction_error[row]
        assert run.friction_coefficient[row] == pytest.approx(steady.friction_coefficient, abs=off)
    assert run.friction_coefficient[1] == run.friction_coefficient[0]  # the pressure does not jump


@pytest.mark.apart
def test_errors_just_after_a_start_given_by_positions_are_those_of_a_jump_of_the_speed() -> None:
    """Modes that matter at the times asked for after a start are kept: friction is within its errors."""
    tau = np.geomspace(1e-9, 1.0, 6)
    broad = vf.Material(vf.RetardationSpectrum("1 MPa", "10 MPa", np.full(6, 1.5e-7), tau))
    times = 1.0 + np.array([1e-9, 1e-8, 1e-7])
    by_speed = {"time": [0.0, 1.0, 1.0, 1.001], "speed": [0.0, 0.0, 10.0, 10.0]}
    by_position = {"time": [0.0, 1.0, 1.001], "position": [0.0, 0.0, 1e-2]}
    runs = [
        vf.motion.solve_transient(
            broad,
            profile(16),
            vf.motion.History(**path, pressure=1e3, before="at rest"),
            times=times,
            accuracy=accuracy,
        )
        for path, accuracy in ((by_speed, 1e-2), (by_position, 1e-2), (by_position, 3e-3))
    ]
    assert runs[1].friction_error == pytest.approx(runs[0].friction_error, rel=0.2)
    for run in runs[:2]:
        off = np.abs(run.friction_coefficient - runs[2].friction_coefficient)
        assert np.all(off <= run.friction_error + runs[2].friction_error)


def test_units_do_not_matter() -> None:
    # Another length, time and modulus: the same problem, and the same steps.
    times, seen = np.linspace(0.0, 4e-3, 9), []
    for length, second, modulus in ((1.0, 1.0, 1.0), (1e3, 1e-4, 1e2)):
        spectrum = TWO_MODES.spectrum
        scaled = vf.RetardationSpectrum(
            spectrum.E0 * modulus, spectrum.E_inf * modulus, spectrum.C / modulus, spectrum.tau * second
        )
        one = profile(32)
        surface = vf.contact.PeriodicSurface(one.z * length, (one.spacing[0] * length, one.spacing[1] * length))
        history = vf.motion.History(times[[0, -1]] * second, pressure=1e3 * modulus, speed=0.1 * length / second)
        last = stepped(mover(vf.Material(scaled), surface, history), (times * second).tolist())[-1]
        work = modulus * length
        seen.append([last.friction_force[0] / modulus, last.depth / length, last.dissipated / work, last.stored / work])
    assert seen[1] == pytest.approx(seen[0], rel=1e-6)


def test_few_modes_do_for_a_broad_spectrum() -> None:
    tau = np.geomspace(1e-9, 1e7, 40)
    C = tau**0.1 / (tau**0.1).sum() * (1e-6 - 1e-8)
    broad = vf.Material(vf.RetardationSpectrum("1 MPa", "100 MPa", C, tau))
    history = vf.motion.History([0.0, 0.05], pressure=2e3, speed=0.1, before="sliding")
    problem = Problem(broad, profile(32), history.schedule(broad, "periodic"), 1e-3, None, 0.0)
    few = merged_modes(problem)
    assert len(few) <= 20
    times = np.linspace(0.0, 0.05, 4).tolist()
    every = PeriodicMover(problem, Modes.of(broad.spectrum))
    merged = PeriodicMover(problem, few)
    for one, other in zip(stepped(every, times), stepped(merged, times), strict=True):
        assert other.friction_force[0] == pytest.approx(one.friction_force[0], rel=1e-3)
        assert other.depth == pytest.approx(one.depth, rel=1e-3)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 1e3])
def test_modes_are_merged_at_any_speed(speed: float) -> None:
    surface, creep = profile(32), TWO_MODES.spectrum.creep_compliance
    history = vf.motion.History([0.0, 0.05], pressure=2e3, speed=speed)
    problem = Problem(TWO_MODES, surface, history.schedule(TWO_MODES, "periodic"), 1e-3, None, 0.0)
    modes = merged_modes(problem)
    assert modes.error <= 1e-3
    assert modes.relaxed == pytest.approx(1e-6)
    assert modes.creep_compliance(0.05) == pytest.approx(creep(0.05), rel=1e-3)


@pytest.mark.parametrize("direction", [(0.0, 1.0), (0.6, 0.8)])
def test_memory_in_single_precision_only_rounds(direction: tuple[float, float]) -> None:
    # The memory is rounded to 6e-8 of itself in each of 12 steps.
    history = vf.motion.History([0.0, 0.01], pressure=2e3, speed=0.1, direction=direction)
    seen = []
    for precision in (np.complex64, np.complex128):
        one = mover(TWO_MODES, crossed(9), history)
        one.precision = precision
        last = stepped(one, np.linspace(0.0, 0.01, 13).tolist())[-1]
        seen.append([last.depth, *last.friction_force, last.stored, last.dissipated])
    assert seen[0] != seen[1]
    assert seen[0] == pytest.approx(seen[1], rel=2e-6)


@pytest.mark.parametrize("before", ["untouched", "at rest"])
def test_contact_without_memory_is_elastic(before: str) -> None:
    history = vf.motion.History([0.0, 0.01], pressure=2e3, speed=0.1, before=before)
    one = mover(TWO_MODES, profile(16), history, modes=Modes(1e-6, np.zeros(0), np.zeros(0)))
    first, last = stepped(one, [0.0, 0.01])
    assert last.depth == pytest.approx(first.depth)
    assert last.dissipated == pytest.approx(0.0, abs=1e-9 * last.stored)


def test_memory_is_finite_for_instant_steps() -> None:
    response = StepResponse.of(Modes(1.0, np.array([1.0]), np.array([1.0])), np.zeros(1), np.array([[0.0, 0.5]]))
    memory = np.array([[[1.0 + 0.0j, 2.0]]])
    none = np.zeros((1, 2), complex)
    found = advance(response, Modes(1.0, np.array([1.0]), np.array([1.0])), memory, (none, none), 2.5)
    assert found.memory[0, 0] == pytest.approx([1.0, 2.0 * np.exp(0.5j)])
    assert found.dissipated == 0.0
    assert math.isclose(found.stored, 2.5)


def test_sliding_at_frequencies_that_were_not_measured_is_noted_as_in_steady_motion() -> None:
    """Waves of 1 and 1/3 mm have 63 and 189 rad/s at 10 mm/s; six relaxation times after the start motion is steady."""
    surface = profile(64)
    history = vf.motion.History(time=[0.0, 0.1], pressure="20 kPa", position=[0.0, 1e-3], before="at rest")

    def shares(low: float, high: float) -> list[list[float]]:
        fit = SpectrumFit(None, None, False, False, (low, high))
        material = vf.Material(replace(SLS.modes_at(), fit=fit))
        steady = vf.solve_periodic(material, surface, speed=0.01, pressure="20 kPa")
        over_time = vf.motion.solve_transient(material, surface, history, accuracy=1e-3)
        return [
            [note.values["share"] for note in map(note_of, one.warnings) if note.code == "beyond-measured"]
            for one in (steady, over_time)
        ]

    assert shares(1e-3, 1e9) == [[], []]
    (steady,), (over_time,) = shares(100.0, 1e9)
    assert 0.05 < steady < 0.95
    assert over_time == pytest.approx(steady, rel=0.05)


@pytest.mark.filterwarnings("error")
def test_pressures_in_whose_rounding_the_heights_are_lost_are_refused() -> None:
    for first, last in ((1e3, 1e99), (1e99, 1e3)):
        history = vf.motion.History(time=[0.0, 0.01], pressure=[first, last], speed=0.1)
        with refused("out-of-range", naming="pressure"):
            vf.motion.solve_transient(SLS, profile(16), history, accuracy=0.1)


def test_inertia_of_a_surface_in_motion_is_that_of_steady_sliding_at_its_largest_speed() -> None:
    soft, surface = vf.Material.standard_linear_solid("50 kPa", "200 kPa", "1 ms"), profile(16)
    steady = vf.solve_periodic(soft, surface, speed="4 m/s", pressure="50 kPa")
    history = vf.motion.History([0.0, 1e-2, 2e-2], pressure="50 kPa", speed=[0.1, 0.1, 4.0], before="sliding")
    run = vf.motion.solve_transient(soft, surface, history, times=[1e-2, 2e-2], accuracy=1e-2)
    (found,), (known,) = (
        [note for note in map(note_of, one.warnings) if note.code == "quasi-static"] for one in (run, steady)
    )
    assert found.values["change"] == pytest.approx(known.values["change"], rel=1e-2)  # the accuracy of the run


@pytest.mark.parametrize("temperatures", [["20 degC", "60 degC"], ["60 degC", "20 degC"]])
def test_inertia_of_a_surface_in_motion_is_that_where_the_rubber_is_softest(temperatures: list[str]) -> None:
    law = vf.WLF(C1=8.0, C2="100 K", reference="20 degC")
    rubber = vf.Material(
        vf.Material.standard_linear_solid("50 kPa", "20 MPa", "1 ms").spectrum, shift=law, poisson_ratio=0.5
    )
    steady = vf.solve_periodic(rubber, profile(16), speed=4.0, pressure="5 kPa", temperature="60 degC")
    history = vf.motion.History([0.0, 1e-2], pressure="5 kPa", speed=4.0, temperature=temperatures, before="sliding")
    run = vf.motion.solve_transient(rubber, profile(16), history, times=[1e-6, 1e-2], accuracy=1e-2)
    (found,), (known,) = (
        [note for note in map(note_of, one.warnings) if note.code == "quasi-static"] for one in (run, steady)
    )
    assert found.values["change"] == pytest.approx(known.values["change"], rel=1e-2)  # the accuracy of the run


def test_a_surface_without_load_is_refused_as_other_contacts_are() -> None:
    for speed in (0.0, 1e-3):
        history = vf.motion.History([0.0, 1.0], pressure=0.0, speed=speed)
        with refused("no-contact"):
            vf.motion.solve_transient(vf.synthetic_fluoroelastomer(), profile(16), history)


def test_a_start_leaves_errors_of_energies_as_they_are() -> None:
    """Soon after it, merged modes have a larger error of what changes: of the friction, not of the energy so far."""
    rubber, heights = vf.synthetic_fluoroelastomer(), 1e-5 * np.cos(2.0 * np.pi * np.arange(64) / 64)[:, None]
    surface = vf.contact.PeriodicSurface(heights, (1e-3 / 64, 1e-3))
    pressure = 1.6e-3 * rubber.modes_at("90 degC").E0
    time, position = [0.0, 5e-3, 0.018], [0.0, 0.0, 7e-5]
    history = vf.motion.History(time, pressure=pressure, position=position, temperature="90 degC", before="untouched")
    run = vf.motion.solve_transient(rubber, surface, history, accuracy=1.5e-2)
    at_start = int(np.searchsorted(run.time, 5e-3))
    # They were ten times as large from there on.
    assert run.errors.energy[at_start + 1] < 1.1 * run.errors.energy[at_start]
    assert run.errors.friction_force[at_start + 1] > 10.0 * run.errors.friction_force[-1]
