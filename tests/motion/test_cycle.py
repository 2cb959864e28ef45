"""States that repeat themselves: closed forms, reference values, and the same state by waiting."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from marks import apart, slow
from refusals import refused
from viscofric.errors import ConvergenceError
from viscofric.motion.free.box import Box, Lattice
from viscofric.notes import Note, note_of

SLS = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
BALL = vf.Ball("10 mm")


def sine(points: int, mean: float, amplitude: float) -> tuple[np.ndarray, np.ndarray]:
    """Phases, and a polygon whose first harmonic has the amplitude: sampling takes (π/n)²/3 of it."""
    phase = np.linspace(0.0, 2.0 * np.pi, points + 1)
    values = mean + amplitude / np.sinc(1.0 / points) ** 2 * np.sin(phase)
    values[-1] = values[0]
    return phase, values


@pytest.mark.slow
def test_small_oscillation_has_the_stiffness_of_the_complex_modulus() -> None:
    # dF/dδ = 2a E(ω)/(1 − ν²) with a² = Rδ.  Springs at the edge are touched for a part of the period only, which
    # lowers the loss by an eighth of the relative amplitude, 2.5e-3.
    omega, depth = 100.0, 1e-4
    phase, values = sine(24, depth, 0.02 * depth)
    cycle = vf.motion.solve_cycle(SLS, BALL, vf.motion.History(phase / omega, indentation=values), accuracy=1e-4)
    modulus = complex(SLS.spectrum.complex_modulus(omega))
    radius = np.sqrt(1e-2 * depth)
    stiffness = 2.0 * radius * modulus / 0.75
    assert cycle.storage_stiffness == pytest.approx(stiffness.real, rel=2e-3)
    assert cycle.loss_stiffness == pytest.approx(stiffness.imag, rel=4e-3)
    assert cycle.loss_tangent == pytest.approx(modulus.imag / modulus.real, rel=4e-3)
    assert cycle.energy_per_cycle == pytest.approx(np.pi * stiffness.imag * (0.02 * depth) ** 2, rel=5e-3)
    assert cycle.mean_friction_coefficient is None


def test_errors_of_small_oscillations_are_those_of_periods_that_repeat() -> None:
    """Not the difference from a period that begins with an extrapolated memory, which was 9 times the stiffness."""
    rubber, omega, depth = vf.synthetic_fluoroelastomer(), 250.0, 2e-4
    phase, values = sine(64, depth, 1e-3 * depth)
    period = vf.motion.History(phase / omega, indentation=values, temperature="29 degC")
    cycle = vf.motion.solve_cycle(rubber, vf.Ball("5 mm"), period, accuracy=4e-3)
    modulus = complex(rubber.modes_at("29 degC").complex_modulus(omega))
    stiffness = 2.0 * np.sqrt(5e-3 * depth) * modulus / 0.75
    for found, error, value in (
        (cycle.storage_stiffness, cycle.storage_stiffness_error, stiffness.real),
        (cycle.loss_stiffness, cycle.loss_stiffness_error, stiffness.imag),
        (cycle.loss_tangent, cycle.loss_tangent_error, stiffness.imag / stiffness.real),
    ):
        assert abs(found - value) <= error <= 0.02 * value


@pytest.mark.slow
@pytest.mark.parametrize("place", ["start", "end", "inside"])
@pytest.mark.parametrize(("control", "low"), [("load", 1.0), ("indentation", 1e-4)])
def test_a_punch_under_a_square_wave_has_the_complex_modulus_of_its_frequency(
    place: str, control: str, low: float
) -> None:
    """A punch is linear: harmonics are in the ratio 2 a E(ω)/(1 − ν²), wherever in the period the jumps are."""
    half, high = 0.01, 1.02 * low  # a step of the depth ten times as large would lift the punch
    time, value = {
        "start": ([0.0, 0.0, half, half, 2.0 * half], [low, high, high, low, low]),
        "end": ([0.0, half, half, 2.0 * half, 2.0 * half], [low, low, high, high, low]),
        "inside": (half * np.array([0.0, 0.4, 0.4, 1.4, 1.4, 2.0]), [low, low, high, high, low, low]),
    }[place]
    period = vf.motion.History(time, **{control: value})
    cycle = vf.motion.solve_cycle(SLS, vf.FlatPunch("1 mm"), period)
    modulus = complex(SLS.spectrum.complex_modulus(np.pi / half))
    exact = 2.0 * 1e-3 * modulus / 0.75
    assert cycle.storage_stiffness == pytest.approx(exact.real, rel=1e-3)  # the accuracy
    assert cycle.loss_tangent == pytest.approx(modulus.imag / modulus.real, rel=1e-3)


def test_contact_that_is_lost_in_every_period() -> None:
    # Independent solution: MDR, three refinements, extrapolated; 3e-6.  The rest is the sampling of the sine.
    phase, values = sine(128, 1.0, 1.5)
    cycle = vf.motion.solve_cycle(SLS, BALL, vf.motion.History(phase / 100.0, load=np.maximum(values, 0.0)))
    assert cycle.energy_per_cycle == pytest.approx(0.0005514448777747074, rel=1e-3)
    assert cycle.run.indentation.max() == pytest.approx(0.0005149900095594225, rel=5e-3)
    assert cycle.run.load[-1] == pytest.approx(cycle.run.load[0])
    assert cycle.run.indentation[-1] == pytest.approx(cycle.run.indentation[0], rel=1e-4)
    assert cycle.run.energy_imbalance < 1e-4
    assert cycle.periods <= 6


def test_modes_a_million_times_slower_than_the_period_do_not_wait() -> None:
    # The slow mode ends as if the mean of the load had acted for ever: waiting would take a million periods.
    slow = vf.Material(vf.RetardationSpectrum("1 MPa", "10 MPa", [4e-7, 5e-7], [1e-2, 1e4]))
    history = vf.motion.History([0.0, 0.01], indentation=[1e-4, 1e-4], before="untouched")
    cycle = vf.motion.solve_cycle(slow, BALL, history)
    force = 4.0 / 3.0 * 1e6 / 0.75 * 0.1 * 1e-4**1.5  # at rest for ever: Hertz with E0
    assert cycle.run.load == pytest.approx(force, rel=1e-3)
    assert cycle.energy_per_cycle == pytest.approx(0.0, abs=1e-4 * force * 1e-4)
    assert cycle.storage_stiffness is None
    assert cycle.periods <= 8


def wave(points: int = 24) -> vf.contact.PeriodicSurface:
    x = 2.0 * np.pi * np.arange(points) / points
    return vf.contact.PeriodicSurface(1e-6 * (np.cos(x) + 0.3 * np.cos(2.0 * x + 1.0)), 1e-3 / points)


@pytest.mark.slow
def test_constant_sliding_is_the_steady_state() -> None:
    speed = 0.05
    history = vf.motion.History([0.0, 4e-3], pressure=1e3, speed=speed)
    cycle = vf.motion.solve_cycle(SLS, wave(25), history, accuracy=1e-2)
    steady = vf.solve_periodic(SLS, wave(25), speed=speed, pressure=1e3)
    assert cycle.mean_friction_coefficient == pytest.approx(steady.friction_coefficient, rel=3e-3)
    assert cycle.energy_per_cycle == pytest.approx(steady.friction_coefficient * 1e3 * speed * 4e-3, rel=1e-2)


@pytest.mark.slow
def test_reciprocation_is_reached_by_waiting_too() -> None:
    # In full contact, where few steps are enough.
    there, back, pressure = 2e-4, 2e-3, 2e5  # m, s, Pa
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    one = vf.motion.History([0.0, back, 2.0 * back], pressure=pressure, position=[0.0, there, 0.0])
    cycle = vf.motion.solve_cycle(rubber, wave(), one)
    path = there * (np.arange(7) % 2)
    longer = vf.motion.History(back * np.arange(7), pressure=pressure, position=path)
    waited = vf.motion.solve_transient(rubber, wave(), longer, times=longer.time[-3:])
    assert cycle.run.contact_area.min() == 1.0
    assert cycle.energy_per_cycle == pytest.approx(waited.dissipated[-1] - waited.dissipated[0], rel=3e-3)
    assert cycle.run.friction_force[[0, -1]] == pytest.approx(
        waited.friction_force[-1], abs=3e-3 * np.abs(waited.friction_force).max()
    )
    assert cycle.run.work[-1] == pytest.approx(cycle.energy_per_cycle, rel=1e-3)
    # both are extrapolated over steps, by which they would be 6e-5 off
    assert cycle.mean_friction_coefficient == pytest.approx(cycle.energy_per_cycle / (2.0 * there * pressure), rel=1e-5)
    assert cycle.to_dataset().attrs["periods"] == cycle.periods
    assert cycle.to_dataset().attrs["mean_friction_coefficient_error"] == cycle.mean_friction_coefficient_error


@pytest.mark.slow
def test_a_note_has_the_change_of_friction_by_shear_that_is_left_out() -> None:
    """Of constant sliding, that between steady contacts with slip both ways, to the factor of two that is stated."""
    history, coulomb = vf.motion.History([0.0, 4e-3], pressure=1e3, speed=0.05), 0.3

    def notes(poisson_ratio: float) -> list[Note]:
        rubber = replace(SLS, poisson_ratio=poisson_ratio)
        cycle = vf.motion.solve_cycle(rubber, wave(25), history, times=[0.0, 4e-3], accuracy=1e-2, coulomb=coulomb)
        assert cycle.warnings == cycle.run.warnings
        return [note_of(one) for one in cycle.warnings]

    assert not notes(0.5)
    (said,) = notes(0.3)
    against, along = (
        vf.solve_periodic(
            replace(SLS, poisson_ratio=0.3), wave(25), speed=0.05, pressure=1e3, coulomb=one
        ).friction_coefficient
        for one in (-coulomb, coulomb)
    )
    assert said.code == "tangential-coupling"
    assert 0.5 < said.values["change"] / (0.5 * (against - along)) < 2.0
    with refused("out-of-range", naming="coulomb"):
        vf.motion.solve_cycle(SLS, wave(25), history, coulomb=20.0)


@pytest.mark.apart
@pytest.mark.parametrize(
    ("amplitude", "omega", "accuracy", "energy", "force"),
    [
        (1.0, 100.0, 2e-3, 0.3836871665069123, (0.09031212282, 0.01992105313, -0.07847207229, -0.10382697186)),
        (0.2, 10.0, 2e-3, 0.002674515869600682, (0.00278352002, 3.930963e-05, -0.00273373273, -0.00389052053)),
    ],
    ids=["as far as the contact is long", "short and slow"],
)
def test_reciprocation_of_a_cylinder(amplitude, omega, accuracy, energy, force) -> None:
    """Independent solution (cells fixed to the body), energy known to 2e-5, force over load to 8e-6 and 2e-6."""
    phase = np.linspace(0.0, 2.0 * np.pi, 513)
    path = amplitude * 0.0021850968611841584 * np.sin(phase)
    path[-1] = path[0]
    history = vf.motion.History(phase / omega, load=500.0, position=path, before="at rest")
    cycle = vf.motion.solve_cycle(SLS, vf.Cylinder("10 mm"), history, accuracy=accuracy)
    # The polygon of the path is shorter by 2e-5; the energy counts a third of the accuracy.
    assert cycle.energy_per_cycle == pytest.approx(energy, rel=accuracy / 3.0)
    eighths = np.arange(1, 9) / 8.0
    found = np.interp(eighths, cycle.run.time * omega / (2.0 * np.pi), cycle.run.friction_coefficient)
    wanted = np.array([*force, *(-one for one in force)])
    assert found == pytest.approx(wanted, abs=accuracy * np.abs(wanted).max())
    assert cycle.run.work[-1] == pytest.approx(cycle.energy_per_cycle, rel=accuracy)
    assert cycle.run.friction_force[-1] == pytest.approx(cycle.run.friction_force[0], rel=2.0 * accuracy)


def warming(period: float) -> tuple[vf.Material, np.ndarray, np.ndarray]:
    """Return a material, times, and temperatures over which its retardation times change by a factor of 5."""
    shift = vf.Arrhenius("100 kJ/mol", reference="30 degC")
    phase = np.linspace(0.0, 2.0 * np.pi, 49)
    kelvin = 303.15 + 6.0 * np.sin(phase)
    kelvin[-1] = kelvin[0]
    return vf.Material(SLS.spectrum, shift=shift), period * phase / (2.0 * np.pi), kelvin


@pytest.mark.parametrize(
    ("indenter", "load", "warm"),
    [
        *apart((BALL, 1.0, False), (vf.Cylinder("10 mm"), 500.0, True)),
        pytest.param(BALL, 1.0, True, marks=pytest.mark.exhaustive),
    ],
    ids=["ball", "cylinder at changing temperature", "ball at changing temperature"],
)
def test_reciprocation_on_cells_is_reached_by_waiting_too(indenter, load, warm) -> None:
    material, time, kelvin = warming(0.06)
    path = 1.8e-3 * np.sin(2.0 * np.pi * time / time[-1])
    path[-1] = path[0]
    one = vf.motion.History(time, load=load, position=path, temperature=kelvin if warm else "30 degC", before="at rest")
    cycle = vf.motion.solve_cycle(material, indenter, one, accuracy=2e-2)
    rounds = 4
    longer = vf.motion.History(
        np.append(np.add.outer(time[-1] * np.arange(rounds), time[:-1]).ravel(), rounds * time[-1]),
        load=load, position=np.append(np.tile(path[:-1], rounds), path[-1]),
        temperature=np.append(np.tile(kelvin[:-1], rounds), kelvin[-1]) if warm else "30 degC", before="at rest",
    )  # fmt: skip
    times = (rounds - 1.0 + np.arange(0.0, 1.01, 0.125)) * time[-1]
    waited = vf.motion.solve_transient(material, indenter, longer, times=times, accuracy=2e-2)
    assert cycle.run.method == "grid"
    # Memory of the start that is left after three periods: e^(−18) at the mean temperature.
    assert cycle.energy_per_cycle == pytest.approx(waited.dissipated[-1] - waited.dissipated[0], rel=1e-2)
    force = np.interp(times - times[0], cycle.run.time, cycle.run.friction_force)
    assert force == pytest.approx(waited.friction_force, abs=4e-2 * np.abs(force).max())
    assert cycle.run.energy_imbalance < 4e-3  # a fifth of the accuracy; 2.9e-3 on the coarsest cells


def test_a_period_of_given_depth_begins_as_it_ends() -> None:
    # Of a broad spectrum, whose fast modes answer a memory that does not fit by many times the load.
    phase = np.linspace(0.0, 2.0 * np.pi, 13)
    period = vf.motion.History(phase / 100.0, indentation=1e-4 + 5e-6 * np.sin(phase), temperature="30 degC")
    rubber = vf.synthetic_fluoroelastomer()
    cycle = vf.motion.solve_cycle(rubber, BALL, period, accuracy=0.1)
    assert cycle.run.load[0] == pytest.approx(cycle.run.load[-1], rel=1e-2)
    # The storage stiffness of a small oscillation, 2 a E*, is that of the modulus within the amplitude.
    radius = float(np.mean(cycle.run.contact_radius))
    modulus = complex(rubber.complex_modulus(2.0 * np.pi * 100.0, temperature="30 degC")).real
    assert cycle.storage_stiffness == pytest.approx(2.0 * radius * modulus / 0.75, rel=0.1)
    few = vf.motion.solve_cycle(rubber, BALL, period, times=[0.0, 2.5e-3, 0.01], accuracy=0.1)
    assert few.run.time.tolist() == [0.0, 2.5e-3, 0.01]
    assert few.run.pressure_at(2.5e-3).max() > 0.0
    assert few.loss_stiffness == cycle.loss_stiffness  # of every step


def test_what_does_not_repeat_itself_is_refused() -> None:
    with refused("not-a-period"):
        vf.motion.solve_cycle(SLS, BALL, vf.motion.History([0.0, 1.0], load=[1.0, 2.0]))
    with refused("not-repeating", ConvergenceError) as caught:
        vf.motion.solve_cycle(SLS, BALL, vf.motion.History([0.0, 1e-3], load=1.0), most_periods=1)
    assert "most_periods" in caught.value.words("python")
    assert not any("most_periods" in caught.value.words(reader) for reader in ("shell", "run_file", "page"))


@pytest.mark.parametrize("control", [*slow("load"), *apart("indentation")])
def test_stated_errors_cover_those_of_random_oscillations(control: str) -> None:
    """At a tenth of the accuracy; all of 48 in benchmarks/motion/stated_cycles.py hold, to 0.7 of the errors."""
    chance = np.random.default_rng(5)
    for amplitude in (0.01, 0.8):
        weight, ratio = chance.random(3), chance.uniform(3.0, 300.0)
        rubber = vf.Material(
            vf.RetardationSpectrum(
                1e6, 1e6 * ratio, 1e-6 * (1.0 - 1.0 / ratio) * weight / weight.sum(), 10.0 ** chance.uniform(-5, -1, 3)
            )
        )
        phase, values = sine(16, 1.0, amplitude)
        period = vf.motion.History(phase / 100.0, **{control: (0.1 if control == "load" else 1e-4) * values})
        rough, fine = (vf.motion.solve_cycle(rubber, BALL, period, accuracy=one) for one in (1e-2, 1e-3))
        for name in ("energy_per_cycle", "storage_stiffness", "loss_stiffness", "loss_tangent"):
            error = getattr(rough, f"{name}_error") + getattr(fine, f"{name}_error")
            assert abs(getattr(rough, name) - getattr(fine, name)) <= error, name
        assert fine.storage_stiffness_error < 4e-3 * fine.storage_stiffness
        assert fine.loss_stiffness_error < 4e-3 * fine.storage_stiffness


@pytest.mark.parametrize(
    ("control", "mean", "amplitude", "warmth"),
    [("indentation", 1e-4, 2e-6, "0 degC"), ("load", 1.0, 0.3, "0 degC"), ("load", 1.0, 0.3, "10 degC")],
)
def test_broad_spectra_repeat_themselves_after_a_few_periods(control, mean, amplitude, warmth) -> None:
    """The edge is lost in every period; retardation times are from nanoseconds to years."""
    phase, values = sine(24, mean, amplitude)
    period = vf.motion.History(phase / 628.0, **{control: values}, temperature=warmth, before="at rest")
    cycle = vf.motion.solve_cycle(vf.synthetic_fluoroelastomer(), BALL, period, accuracy=1e-2)
    assert cycle.periods <= 6
    assert cycle.run.energy_imbalance < 1e-3
    # The work over a period is that of the first harmonics: of a given depth ∮F dδ = π K'' |δ₁|².
    moved = (
        amplitude if control == "indentation" else amplitude / abs(cycle.storage_stiffness + 1j * cycle.loss_stiffness)
    )
    work = np.pi * cycle.loss_stiffness * moved**2
    assert cycle.energy_per_cycle == pytest.approx(work, abs=cycle.energy_per_cycle_error, rel=1e-2)


def test_memory_is_carried_to_finer_cells_and_other_modes() -> None:
    # Linear interpolation is exact on planes, and of fields that are linear in ln τ; beyond the box there is nothing.
    times = np.array([1e-3, 1e-1])
    coarse = Lattice(Box(-4, -2, 9, 5), 0.3, 0.6, times)
    x, y = 0.3 * (np.arange(-4, 5) + 0.5), 0.6 * (np.arange(-2, 3) + 0.5)
    plane = 2.0 + x[:, None] + 0.5 * y
    fine = coarse.finer(0.2, 0.4, np.array([1e-4, 1e-2, 1e-1]))
    found = coarse.carried(np.stack([plane, 3.0 * plane]), fine)
    assert found.shape == (3, *fine.box.shape)
    x, y = 0.2 * (np.arange(fine.box.nx) + fine.box.i + 0.5), 0.4 * (np.arange(fine.box.ny) + fine.box.j + 0.5)
    inside = np.ix_((x > -1.05) & (x < 1.35), (y > -0.9) & (y < 1.5))
    wanted = (2.0 + x[:, None] + 0.5 * y)[inside]
    assert inside[0].size == 12
    for field, factor in zip(found, (1.0, 2.0, 3.0), strict=True):
        assert field[inside] == pytest.approx(factor * wanted)
    assert x[0] <= -1.2 + 0.1
    assert np.all(np.abs(found[0][0]) < np.abs(found[0][1]))


@pytest.mark.apart
def test_finer_cells_begin_with_the_memory_of_coarser_ones() -> None:
    """Four periods on the first grid, three on the next one."""
    time = 2.0 * np.pi * np.arange(97) / 9600.0
    path = 1.8e-3 * np.sin(100.0 * time)
    path[-1] = path[0]
    cycle = vf.motion.solve_cycle(
        SLS, BALL, vf.motion.History(time, load=1.0, position=path, before="at rest"), accuracy=0.1
    )
    assert cycle.periods == 7
