"""The gradient that an identification descends by, against central differences on random rubbers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

import viscofric as vf
from marks import apart, slow
from viscofric.arrays import Array
from viscofric.contact.derivatives.adjoint import differentiated, friction_adjoint
from viscofric.contact.free.nested import find_window, refine
from viscofric.contact.free.problem import Control, Problem
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.free.stage import Stage
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.friction.identification.solving import friction_response

BALL, CYLINDER = vf.Ball(radius=10e-3), vf.Cylinder(radius=10e-3)
LOADS = {"ball": 1.0, "cylinder": 100.0}
PLANE_STRAIN = 0.75


class Contact(NamedTuple):
    """A random rubber and the speed at which it is rubbed."""

    spectrum: vf.RetardationSpectrum
    speed: float


def random_contact(seed: int) -> Contact:
    """3 to 30 modes over 2 to 12 decades, E_inf/E0 from 1.5 to 1000, at a speed at which they are felt or nearly so."""
    rng = np.random.default_rng(seed)
    modes, decades, E0 = int(rng.integers(3, 31)), rng.uniform(2.0, 12.0), 1e6
    tau = np.sort(10.0 ** (rng.uniform(-0.5, 0.5, modes) * decades - 3.0))
    E_inf = E0 * np.exp(rng.uniform(np.log(1.5), np.log(1000.0)))
    C = rng.exponential(size=modes) * 10.0 ** rng.uniform(-2.0, 0.0, modes)
    C *= (1.0 / E0 - 1.0 / E_inf) / C.sum()
    return Contact(vf.RetardationSpectrum(E0, E_inf, C, tau), 10.0 ** rng.uniform(-2.0, 2.0))


def solid(scale: Scale, logarithms: Array, contact: Contact) -> SteadyMaterial:
    """Material in units of the contact, its C_k, E_inf and speed multiplied by exponentials."""
    spectrum, unit = contact.spectrum, scale.stiffness * PLANE_STRAIN
    C = spectrum.C * np.exp(logarithms[: len(spectrum.C)])
    E_inf, speed = np.exp(logarithms[-3:-1]) * [spectrum.E_inf, contact.speed / scale.length]
    return SteadyMaterial(unit / E_inf, unit * C, speed * spectrum.tau)


def friction_on_its_cells(stage: Stage, way: str, scale: Scale, logarithms: Array, contact: Contact) -> float:
    """Friction coefficient of a neighbouring problem, found anew on the same cells, which stay in contact."""
    problem = stage.problem
    control = Control(load=problem.geometry.parabolic_load * float(np.exp(logarithms[-1])))
    operator = problem.geometry.operator(stage.window, solid(scale, logarithms, contact), stage.operator.shift)
    height = problem.height_on(stage.window, stage.operator.shift)
    result = control.solve(operator, height, stage.result.pressure, 1e-13)
    assert result.converged
    assert np.array_equal(result.pressure > 0.0, stage.result.pressure > 0.0)
    there = Stage(problem, stage.window, operator, result)
    return scale.slope * (there.pressure_friction if way == "pressure" else there.energy_friction)


@pytest.mark.parametrize("seed", [*range(5), *slow(*range(5, 10)), *apart(*range(10, 20))])
def test_adjoint_is_the_gradient_of_the_friction_on_its_cells(seed: int) -> None:
    name, contact = ("cylinder" if seed % 4 == 3 else "ball"), random_contact(seed)
    indenter, spectrum = {"ball": BALL, "cylinder": CYLINDER}[name], contact.spectrum
    scale = Scale.for_load(indenter, spectrum.E0 / PLANE_STRAIN, LOADS[name])
    none = np.zeros(len(spectrum.C) + 3)
    control = Control(load=indenter.geometry.parabolic_load)
    shape = ScaledIndenter(indenter, scale)
    problem = Problem(indenter.geometry, solid(scale, none, contact), shape, control, 1e-13, coarsest=16)
    stages = refine(find_window(problem, problem.first_size), 0.5, 512)
    way, stage = differentiated(stages), stages[1]
    found = friction_adjoint(stage, way).gradient
    C, E_inf = scale.stiffness * PLANE_STRAIN * spectrum.C, scale.stiffness * PLANE_STRAIN / spectrum.E_inf
    gradient = scale.slope * np.concatenate(
        [
            found.compliances * C,
            [-found.glassy * E_inf],
            [found.memory_lengths @ stage.operator.material.memory_lengths],
            [found.held * indenter.geometry.parabolic_load],
        ]
    )
    # The two modes that matter most, all modes at random, then E_inf, v and F one by one.
    step = 2e-5
    directions = list(np.eye(len(none))[[*np.argsort(np.abs(gradient[:-3]))[-2:], -3, -2, -1]])
    directions.append(np.append(np.random.default_rng(seed).normal(size=len(none) - 3), np.zeros(3)))
    for direction in directions:
        up, down = (friction_on_its_cells(stage, way, scale, sign * step * direction, contact) for sign in (1.0, -1.0))
        # What the solver leaves, 1e-13 of the indentation over the step, is up to 6e-6; the square of the step is less.
        size = max(abs(gradient @ direction), 1e-3 * np.abs(gradient).max())
        assert (up - down) / (2.0 * step) == pytest.approx(gradient @ direction, abs=1e-5 * size)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, *apart(7)])
def test_gradient_is_that_of_the_friction_over_finite_steps(seed: int) -> None:
    spectrum, speed = random_contact(seed)
    step = 0.1

    def friction(C: float = 0.0, E_inf: float = 0.0, v: float = 0.0, F: float = 0.0) -> tuple[float, float]:
        compliances, glass = spectrum.C * np.exp(C), spectrum.E_inf * np.exp(E_inf)
        changed = vf.RetardationSpectrum(1.0 / (1.0 / glass + compliances.sum()), glass, compliances, spectrum.tau)
        found = friction_response(changed, 0.5, BALL, speed * np.exp(v), np.exp(F))
        return found.friction[0], found.error[0]

    found = friction_response(spectrum, 0.5, BALL, speed, 1.0)
    expected = {
        "C": found.log_C[0].sum(),
        "E_inf": found.log_E_inf[0],
        "v": found.log_speed[0],
        "F": found.log_load[0],
    }
    for name, value in expected.items():
        (up, up_error), (down, down_error) = friction(**{name: step}), friction(**{name: -step})
        near = 0.5 * (up_error + down_error) / step
        # The errors of the two frictions over the step are at most 1 % of the friction here; the step's own error,
        # step²/6 of the third derivative, is a tenth of that.
        assert near <= 0.01 * found.friction[0]
        assert (up - down) / (2.0 * step) == pytest.approx(value, abs=near)
