"""Exact steps of the memory, and modes that are merged."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from viscofric.motion import wave_memory
from viscofric.motion.memory import Modes, StepCoefficients, phi, step_coefficients, step_parts

NODES, WEIGHTS = (0.5 * (part + [1.0, 0.0][i]) for i, part in enumerate(np.polynomial.legendre.leggauss(60)))


@pytest.mark.parametrize("angle", [0.0, 0.5, -1.2, math.pi / 2])
@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-5, 0.02, 0.299, 0.301, 1.0, 10.0])
def test_phi_equal_their_integrals(size: float, angle: float) -> None:
    z = -size * np.exp(1j * angle)
    first, second = phi(z)
    kernel = np.exp((1.0 - NODES) * z)  # Gauss's rule of 60 points is exact to rounding here
    assert first == pytest.approx(WEIGHTS @ kernel, abs=3e-15)
    assert second == pytest.approx(WEIGHTS @ (kernel * NODES), abs=3e-15)


def test_phi_of_large_decay() -> None:
    first, second = phi(np.array([-1e3, -1e12, -1e300]))
    assert first * [1e3, 1e12, 1e300] == pytest.approx(1.0)
    assert second == pytest.approx([(1.0 - 1e-3) / 1e3, 1e-12, 1e-300])


@pytest.mark.parametrize("kappa", [1e-9, 1e-3, 0.4, 3.0, 200.0])
def test_step_under_a_linear_pressure_is_exact(kappa: float) -> None:
    # q(t) = p0 + r (t − τ) + (q0 − p0 + r τ) exp(−t/τ) solves τ q' = p0 + r t − q.
    q0, p0, p1 = 0.3, 1.0, 2.5
    rate = (p1 - p0) / kappa
    exact = p1 - rate + (q0 - p0 + rate) * math.exp(-kappa) if kappa > 1e-2 else None
    decay, start, end = step_coefficients(kappa)
    found = decay * q0 + start * p0 + end * p1
    if exact is None:  # its power series, the next term below κ³
        exact = q0 + kappa * (0.5 * (p0 + p1) - q0) + kappa**2 * (0.5 * q0 - p0 / 3.0 - p1 / 6.0)
    assert found == pytest.approx(exact, rel=max(1e-14, kappa**3))
    assert decay.dtype == np.float64


def of_waves(kappa: list[float], turn: list[float]) -> StepCoefficients:
    """Return the coefficients (steps, 1, waves) of steps in the indenter's frame, where waves turn by an angle."""
    steps = np.array(kappa)
    decay, functions = wave_memory._functions(steps, np.broadcast_to(turn, (len(kappa), 1, len(turn))), 2)
    return wave_memory._coefficients(steps, decay, functions)


def test_steps_divide() -> None:
    # A step is the same as two, with the pressure between them; in the indenter's frame as well.
    kappa, turn = np.array([1e-4, 0.2, 5.0]), np.array([0.0, 0.01, 1.0, 40.0])
    whole, half = of_waves(list(kappa), list(turn)), of_waves(list(0.5 * kappa), list(0.5 * turn))
    q0, p0, p1 = 0.4 - 0.1j, 1.0 + 0.5j, -0.7 + 0.2j
    between = half.decay * q0 + half.start * p0 + half.end * 0.5 * (p0 + p1)
    assert half.decay * between + half.start * 0.5 * (p0 + p1) + half.end * p1 == pytest.approx(
        whole.decay * q0 + whole.start * p0 + whole.end * p1, rel=1e-13
    )


@pytest.mark.parametrize("step", [1e-4, 0.3, 20.0])
def test_steady_sliding_is_a_fixed_point_of_any_step(step: float) -> None:
    # A steady wave has q = p/(1 − i τ q·v), whatever the step.
    turn = np.array([0.0, 1e-6, 0.4, 7.0]) * step
    decay, start, end = of_waves([step], list(turn))
    steady = 1.0 / (1.0 - 1j * turn / step)
    assert decay * steady + start + end == pytest.approx(np.broadcast_to(steady, decay.shape), rel=1e-12)


def test_jump_moves_the_memory_only() -> None:
    decay, start, end = of_waves([0.0], [0.0, 0.3, -2.0])
    assert decay.ravel() == pytest.approx(np.exp(1j * np.array([0.0, 0.3, -2.0])))
    assert not start.any()
    assert not end.any()


def _rubber() -> vf.RetardationSpectrum:
    tau = np.geomspace(1e-9, 1e7, 40)
    C = tau**0.1 / (tau**0.1).sum() * (1e-6 - 1e-9)
    return vf.RetardationSpectrum("1 MPa", "1 GPa", C, tau)


def test_merged_modes_keep_creep_and_loss_to_the_error_asked() -> None:
    spectrum = _rubber()
    for error in (1e-3, 1e-5):
        modes = Modes.for_history(spectrum, 1e-3, 1.0, error)
        times = np.geomspace(1e-3, 1.0, 500)  # not those that merging looks at
        assert modes.error <= error
        assert modes.creep_compliance(times) == pytest.approx(spectrum.creep_compliance(times), rel=1.05 * error)
        seen = np.abs(modes.compliance(1.0 / times) / spectrum.compliance(1.0 / times) - 1.0)
        assert seen.max() <= 1.05 * error
        assert modes.relaxed == pytest.approx(1.0 / spectrum.E0, rel=1e-9)
    assert len(modes) <= 20
    few = Modes.for_history(spectrum, 1e-3, 1.0, 1e-3)
    assert len(few) <= 12
    # Compliances not below zero at other times store energies not below zero.
    assert few.C.min() > 0.0
    assert few.at_once > 0.0
    assert few.difference(Modes.of(spectrum), 1e-3, 1.0) == few.error


def test_nothing_is_merged_where_every_mode_acts() -> None:
    spectrum = _rubber()
    modes = Modes.for_history(spectrum, 1e-12, 1e10, 1e-6)
    assert np.array_equal(modes.tau, spectrum.tau)
    assert np.array_equal(modes.C, spectrum.C)
    assert modes.instantaneous == pytest.approx(1e-9)


def test_elastic_solid_has_no_modes() -> None:
    elastic = vf.RetardationSpectrum("1 MPa", "1 MPa", [0.0], [1.0])
    modes = Modes.for_history(elastic, 1e-3, 1.0)
    assert len(modes) == 0
    assert modes.creep_compliance([0.0, 2.0]) == pytest.approx(1e-6)
    assert modes.compliance(3.0) == pytest.approx(1e-6)


@pytest.mark.parametrize("steps", [1e-3, 0.049, 0.051, 0.5, 3.0, 30.0])
def test_energies_of_a_step_are_integrals_of_the_relaxation_over_it(steps):
    lag, change = np.exp(-steps * NODES), -np.expm1(-steps * NODES) / steps
    expected = [steps * WEIGHTS @ one for one in (lag**2, lag * change, change**2)]
    assert step_parts(np.array([steps]))[3:] == pytest.approx(np.array(expected)[:, None], rel=1e-10)  # of the series
