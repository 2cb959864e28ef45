"""Errors stated for contacts over time: of merged modes, soon after a jump and a start, and the balance of energy."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import viscofric as vf
from marks import apart
from viscofric.motion.chains import Moment
from viscofric.motion.free.solve import _compared
from viscofric.motion.march import march
from viscofric.motion.memory import Modes
from viscofric.motion.mover import Observation, Sizes
from viscofric.motion.periodic import PeriodicMover
from viscofric.motion.schedule import Instant, Reading
from viscofric.motion.solve import checked_problem

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
CYLINDER = vf.Cylinder("10 mm")
SPACING = 1e-5
TIMES = [0.05, 0.15, 0.25, 0.5, 1.0]


def ridges(points: int = 64, spacing: float = SPACING) -> vf.contact.PeriodicSurface:
    x = 2.0 * np.pi * np.arange(points) / points
    return vf.contact.PeriodicSurface(2e-6 * (np.cos(x) + 0.3 * np.cos(2.0 * x + 1.0)), spacing)


def of_many_modes(seed: int, ratio: float, fastest: float) -> vf.Material:
    chance = np.random.default_rng(seed)
    tau = np.sort(10.0 ** chance.uniform(fastest, -0.5, 19))
    share = chance.exponential(size=19)
    return vf.Material(vf.RetardationSpectrum(1e6, 1e6 * ratio, (1e-6 - 1e-6 / ratio) * share / share.sum(), tau))


def with_and_without_merging(material, history, accuracy, times):
    problem = checked_problem(material, ridges(), history, accuracy, None, None, 0.3)
    every = Modes.of(problem.schedule.spectrum)
    movers = PeriodicMover(problem), PeriodicMover(problem, every)
    assert len(movers[0].modes) < len(every)
    tracks = [march(one, problem.schedule, accuracy=accuracy, times=times) for one in movers]
    return zip(*(track.moments for track in tracks), strict=True)


@pytest.mark.parametrize(
    ("tau", "end", "pressures", "points"),
    [
        (0.8, 0.3, (0.0, 3e3), 16),
        (0.015, 0.4, (0.0, 2.2e3), 16),
        *apart((0.8, 0.3, (0.0, 8e4), 16)),
        (0.02, 0.8, (1.2e4, 1.2e3), 16),
        *apart((0.0022, 0.8, (1.2e4, 1.2e3), 32)),
    ],
)
def test_friction_of_ridges_at_rest_is_within_its_error_when_a_point_touches_or_leaves(tau, end, pressures, points):
    """Errors of single pressures cancel in the friction by chance; a point that comes or goes late changes rates."""
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="200 MPa", tau=tau)
    ramp = vf.motion.History([0.0, end], pressure=pressures, before="at rest" if pressures[0] else "untouched")
    surface, pressure = ridges(points, 64 * SPACING / points), max(pressures)
    one = vf.motion.solve_transient(rubber, surface, ramp, accuracy=1e-2)
    two = vf.motion.solve_transient(rubber, surface, ramp, accuracy=1e-3, times=one.time)
    off = np.abs(one.friction_force - two.friction_force)
    assert np.all(off <= one.errors.friction_force + two.errors.friction_force)
    # Relative to a tenth of pressure times slope, which is more than the friction (`PeriodicMover.scales`).
    assert one.errors.friction_force.max() <= 1e-2 * 0.1 * surface.slope((1.0, 0.0)).std() * pressure


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_stated_friction_includes_that_of_merged_modes_where_it_is_small_against_the_slopes(seed):
    """A slow motion, of small loss: the part of the friction that cancels is far larger than what remains."""
    speed = 64 * SPACING / 8.0
    history = vf.motion.History(
        [0.0, 0.6, 0.6, 1.0], pressure=5e3, speed=[speed, speed, -speed, -speed], before="at rest"
    )
    for one, two in with_and_without_merging(of_many_modes(seed, 4.0, -5.5), history, 2e-2, [0.1, 0.6, 0.7, 1.0]):
        assert abs(one.seen.friction_force[0] - two.seen.friction_force[0]) < one.errors.friction


@pytest.mark.apart
def test_stated_errors_soon_after_a_jump_include_those_of_modes_merged_for_later_times():
    """A hundred times earlier than the shortest time that the modes are merged for, and later."""
    history = vf.motion.History([0.0, 1.0], pressure=5e3)
    times = [1e-7, 1e-6, 1e-3, 1.0]
    off = []
    for one, two in with_and_without_merging(of_many_modes(1, 100.0, -8.0), history, 2e-2, times):
        off.append(abs(one.seen.depth - two.seen.depth) / two.seen.depth)
        assert abs(one.seen.depth - two.seen.depth) < one.errors.depth
    assert off[0] > 0.02  # more than the accuracy: there is an error to be stated


@pytest.mark.parametrize("relaxations", [1.0, 10.0])
def test_friction_of_a_start_within_one_cell_relaxes(relaxations):
    """F = F∞ (1 − e^(−t E∞/(τE0))) over paths far shorter than the contact, the first time within a hundredth cell."""
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="100 MPa", tau="10 ms")
    first = relaxations * 1e-4
    history = vf.motion.History([0.0, 0.3], load=10.0, speed=1e-4, before="at rest")
    run = vf.motion.solve_transient(rubber, CYLINDER, history, times=[first, 0.3], accuracy=1e-2)
    expected = run.friction_force[1] * -np.expm1(-relaxations)
    assert abs(run.friction_force[0] - expected) < run.errors.friction_force.sum() < 0.02 * run.friction_force[1]


@pytest.mark.parametrize(("indenter", "power"), [(vf.Ball("10 mm"), 2.0 / 3.0), (vf.Cone(0.1), 0.5)])
def test_the_first_steps_of_a_ramp_from_zero_load_are_within_their_errors(indenter, power):
    """δ ∝ (r ∫J dt)^(2/3 or 1/2) of a growing contact (Lee–Radok)."""
    spectrum = vf.RetardationSpectrum(1e6, 4e7, [0.975e-6 / 2] * 2, [1e-4, 1.0])
    history = vf.motion.History([0.0, 1.0], load=[0.0, 0.05])
    run = vf.motion.solve_transient(vf.Material(spectrum), indenter, history, accuracy=3e-3)
    time, C, tau = run.time[1:, None], spectrum.C, spectrum.tau
    creep = (time[:, 0] / 4e7) + (time - tau * -np.expm1(-time / tau)) @ C
    depth = run.indentation[-1] * (creep / creep[-1]) ** power
    off = np.abs(run.indentation[1:] - depth)
    assert depth[0] < 1e-2 * depth[-1]
    assert np.all(off <= run.errors.indentation[1:] + run.errors.indentation[-1] * depth / depth[-1])
    assert np.all(off <= 5e-3 * depth)


def test_a_contact_that_returns_into_its_dent_is_within_its_errors():
    """Steps were long while the contact shrank: the dent around it must not depend on them."""
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="343 MPa", tau=0.2)
    history = vf.motion.History([0.0, 0.13, 0.13, 0.8, 1.0], indentation=[0.0, 2.2e-5, 2.2e-5, 1.2e-5, 3.2e-5])
    times = [0.801, 0.803, 0.81]
    one, two = (
        vf.motion.solve_transient(rubber, vf.Cone(0.1), history, times=times, accuracy=accuracy)
        for accuracy in (2.5e-2, 1e-3)
    )
    assert np.all(np.abs(one.load - two.load) <= one.errors.load + two.errors.load)


def test_the_stated_error_of_an_energy_is_not_below_its_imbalance():
    """Springs touched within steps that are longer than they relax in: errors of the loss of first order."""
    rubber = vf.Material(vf.RetardationSpectrum(1e6, 1e8, [0.5e-6, 0.49e-6], [0.24, 0.56]))
    one, two = (
        vf.motion.solve_transient(
            rubber, vf.Ball("10 mm"), vf.motion.History([0.0, 1.0], load=0.08), times=TIMES, accuracy=accuracy
        )
        for accuracy in (5e-3, 2e-4)
    )
    assert np.all(one.errors.energy >= np.abs(one.errors.balance))
    assert np.all(np.abs(one.dissipated - two.dissipated) <= one.errors.energy + two.errors.energy)


def test_friction_of_the_memory_and_of_the_slopes_differ_by_no_more_than_their_error_by_cells():
    """Both are the same without cells; one of them may be unchanged from grid to grid by chance."""

    def level(memory, slopes):
        seen = Observation(1.0, 1e-4, (memory, 0.0), 1e-6, 0.0, 0.0, {}, force_on_slopes=(slopes, 0.0))
        moments = [
            Moment(
                Instant(time, Reading(time, 0.0), np.array([time, 0.0]), load=1.0), seen, 0.0, Sizes(*[0.0] * 4), None
            )
            for time in (0.0, 0.5, 1.0)
        ]
        kinks, scale = SimpleNamespace(kinks=np.array([0.0, 1.0])), SimpleNamespace(length=1.0)
        setting, grid = SimpleNamespace(schedule=kinks, scale=scale), SimpleNamespace(spacing=0.01)
        mover = SimpleNamespace(setting=setting, grid=grid)
        return SimpleNamespace(track=SimpleNamespace(moments=moments), mover=mover, cells=100.0)

    for one in _compared(level(0.30, 0.32), level(0.30, 0.33), [0, 1, 2]):
        assert one.errors.friction >= 0.02


@pytest.mark.slow
@pytest.mark.parametrize(
    ("indenter", "history"),
    [
        (vf.Ball("10 mm"), vf.motion.History([0.0, 0.05, 0.1], load=[0.0, 1.0, 0.0])),
        (vf.Cone(0.1), vf.motion.History([0.0, 0.01, 0.01, 0.1], indentation=[1e-4, 1e-4, 5e-5, 8e-5])),
        *apart((ridges(), vf.motion.History([0.0, 0.1], pressure=5e3, speed=64e-5 / 0.05))),
        (
            ridges(),
            vf.motion.History([0.0, 0.1, 0.1, 0.2], pressure=5e3, speed=[5e-3, 5e-3, -5e-3, -5e-3], before="sliding"),
        ),
        *apart((CYLINDER, vf.motion.History([0.0, 0.01], load=500.0, speed=0.2, before="at rest"))),
        (CYLINDER, vf.motion.History([0.0, 0.02], load=[100.0, 500.0], speed=0.1)),
    ],
    ids=["ball", "cone", "ridges", "ridges there and back", "cylinder", "cylinder under a growing load"],
)
def test_energy_is_balanced_at_the_default_accuracy(indenter, history):
    run = vf.motion.solve_transient(RUBBER, indenter, history, times=np.linspace(0.2, 1.0, 5) * history.time[-1])
    assert run.dissipated[-1] > 0.0
    assert run.energy_imbalance < 1e-4


def test_the_stated_error_of_a_pressure_covers_the_marks_of_steps_at_an_advancing_edge():
    """Against steps for a tenth of the accuracy, on the same springs."""
    history, times = vf.motion.History([0.0, 0.02], indentation=[0.0, 1e-4]), [0.005, 0.01, 0.02]
    one, two = (
        vf.motion.solve_transient(RUBBER, vf.Ball("10 mm"), history, times=times, accuracy=accuracy)
        for accuracy in (1e-2, 1e-3)
    )
    for time in times:
        coarse, fine = one.pressure_at(time), two.pressure_at(time)
        off = float(abs(coarse - fine).max())
        assert 0.01 * float(fine.max()) < off < coarse.attrs["error"] < 0.5 * float(fine.max())
        assert fine.attrs["error"] < 0.5 * coarse.attrs["error"]  # of first order in the steps


def test_a_lower_tolerance_has_its_memory_in_double_precision():
    """E∞/E0 times the rounding of single precision is more than a step may add to the friction."""
    history = vf.motion.History([0.0, 0.1], pressure=5e3, speed=0.01)
    mover = PeriodicMover(checked_problem(RUBBER, ridges(), history, 1e-2, None, None, 0.3))
    before = mover.floor(mover.scales)
    assert mover.begin().memory.dtype == np.complex64
    mover.tighten()
    assert mover.begin().memory.dtype == np.complex128
    assert mover.floor(mover.scales) == pytest.approx(0.1 * np.array(before))


@pytest.mark.apart
def test_friction_of_ridges_at_rest_is_within_its_error_when_both_chains_touch_a_point_too_late():
    """A point that had left is touched again: no difference shows a common delay until the first chain touches."""
    chance, waves = np.random.default_rng(13), np.arange(1, 24)
    chance.choice(4)
    size = waves ** (-chance.uniform(0.5, 1.0) - 0.5)
    angle = 2.0 * np.pi * np.outer(waves, np.arange(96) / 96)
    z = (size * chance.normal(size=23)) @ np.cos(angle) + (size * chance.normal(size=23)) @ np.sin(angle)
    surface = vf.contact.PeriodicSurface(1e-6 / z.std() * (z - z.mean()), 1e-3 / 96)
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="41.58 MPa", tau=2.07417e-3)
    pressure = [47.34660587, 99.55567399, 15.34573728, 30.0]
    history = vf.motion.History([0.0, 3.89828e-3, 1.318243e-2, 1.386e-2], pressure=pressure, before="at rest")
    one = vf.motion.solve_transient(rubber, surface, history)
    two = vf.motion.solve_transient(rubber, surface, history, accuracy=3e-4, times=one.time)
    assert np.all(np.abs(one.friction_force - two.friction_force) <= one.errors.friction_force)


def test_friction_soon_after_steady_sliding_is_that_of_it_within_its_error():
    """On cells that stay where they are the pressure is not quite that of cells that slide along."""
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="100 MPa", tau="10 ms")
    contact = {"speed": 0.1143, "load": 500.0}
    steady = vf.solve_steady(rubber, CYLINDER, **contact, accuracy=1e-3)
    history = vf.motion.History([0.0, 1e-2], **contact, before="sliding")
    run = vf.motion.solve_transient(rubber, CYLINDER, history, times=[1e-7, 1e-6, 1e-5], accuracy=3e-2)
    off = np.abs(run.friction_force - steady.load * steady.friction_coefficient)
    assert np.all(off < run.errors.friction_force - steady.load * steady.friction_error)


@pytest.mark.slow
def test_errors_of_the_first_steps_after_a_start_hold() -> None:
    """The first step of a whole cell is of first order: its error was 1.6 times the stated one."""
    tau, C = np.array([2.54, 0.295, 1.63e-3, 7.79e-4, 4.45e-6]), np.array([4.96e-7, 4.46e-7, 2.7e-9, 5.2e-8, 4e-10])
    C *= (1e-6 - 1.0 / 345.7e6) / C.sum()
    rubber = vf.Material(vf.RetardationSpectrum(1e6, 345.7e6, C, tau))
    start = vf.motion.History([0.0, 0.6], load=10.0, speed=2.337e-4, before="at rest")
    settings = {"layer": "0.457 mm", "accuracy": 3.9e-3}
    run = vf.motion.solve_transient(rubber, CYLINDER, start, **settings)
    first = slice(0, 12)
    finer = vf.motion.solve_transient(rubber, CYLINDER, start, times=run.time[first], **settings)  # shorter steps there
    assert np.all(np.abs(run.friction_force[first] - finer.friction_force) <= run.errors.friction_force[first])
