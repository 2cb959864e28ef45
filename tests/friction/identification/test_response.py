"""Friction at many speeds and its derivatives: the forward model of an identification."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import ConvergenceError
from viscofric.friction.identification.forward import CorrectedFriction, FirstOrder, Solved
from viscofric.friction.identification.solving import FrictionResponse, friction_response

BALL, CYLINDER = vf.Ball(radius=10e-3), vf.Cylinder(radius=10e-3)
ACCURACY = 1e-2


def rubber(E0: float = 1e6, E_inf: float = 1e8, tau: tuple[float, ...] = (1e-5, 1e-4, 1e-3)) -> vf.RetardationSpectrum:
    """Modes of equal compliance."""
    times = np.array(tau)
    return vf.RetardationSpectrum(E0, E_inf, np.full(len(times), (1.0 / E0 - 1.0 / E_inf) / len(times)), times)


@pytest.fixture(scope="module")
def response() -> FrictionResponse:
    return friction_response(rubber(), 0.5, BALL, [0.1, 1.0, 3.0], [1.0, 1.0, 2.0], accuracy=ACCURACY)


@pytest.mark.slow
def test_numbers_are_those_of_the_contacts(response: FrictionResponse) -> None:
    material = vf.Material(rubber(), poisson_ratio=0.5)
    solution = vf.solve_steady(material, BALL, speed=3.0, load=2.0, derivatives=True)
    assert solution.derivatives is not None
    found = friction_response(rubber(), 0.5, BALL, 3.0, 2.0)
    assert found.friction[0] == pytest.approx(solution.friction_coefficient, rel=1e-12)
    assert found.error[0] == pytest.approx(solution.diagnostics.friction_error, rel=1e-12)
    logarithmic = solution.derivatives.logarithmic
    near = {"rel": 1e-9}  # the same operations
    assert found.C[0] == pytest.approx(solution.derivatives.C, **near)
    assert found.log_C[0] == pytest.approx(logarithmic.C, **near)
    assert [found.log_E_inf[0], found.log_speed[0], found.log_load[0]] == pytest.approx(
        [logarithmic.E_inf, logarithmic.speed, logarithmic.load], **near
    )
    # At a loose accuracy the grids are half as fine; the contact is the last of the curve.
    apart = abs(response.friction[2] - found.friction[0])
    assert 0.0 < apart <= response.error[2] + found.error[0]
    # Of the derivatives twice the largest error that forty random rubbers have: 1e-2 of the largest.
    assert np.abs(response.log_C[2] - found.log_C[0]).max() <= 0.02 * np.abs(found.log_C[0]).max()


@pytest.mark.parametrize("moved", [(0.0, -3.0, 0.0, 0.0), (0.0, 0.0, 1.5, 0.0), (1.0, -1.0, -0.5, 0.5)])
def test_solved_contacts_give_the_friction_of_other_materials(moved: tuple[float, ...]) -> None:
    """A mode twenty times weaker or four times stronger changes friction by 15 to 60 %: known to 4 % of friction."""
    speeds = np.array([0.3, 1.0, 3.0])
    spectrum = rubber(E_inf=1e7)
    here = np.log([1.0 / spectrum.E_inf, *spectrum.C])
    there = here + moved

    def solved(compliances: np.ndarray) -> FrictionResponse:
        glass, *C = np.exp(compliances)
        other = vf.RetardationSpectrum(1.0 / (glass + sum(C)), 1.0 / glass, np.array(C), spectrum.tau)
        return friction_response(other, 0.5, BALL, speeds, 1.0, accuracy=ACCURACY)

    found = solved(here)
    change = np.column_stack([-found.log_E_inf, found.log_C])
    columns = [found.error, change, found.log_load]
    by_friction = [(column.T / found.friction).T for column in columns]
    model = CorrectedFriction(
        FirstOrder(BALL, 1.0, 0.75, spectrum.tau), Solved(here, np.log(speeds), np.log(found.friction), *by_friction)
    )
    value, slopes, _ = model(there, np.log(speeds), np.zeros(3))
    # The first-order form errs by up to 20 % here, and linear extrapolation in ln C by 9 %.
    assert value == pytest.approx(np.log(solved(there).friction), abs=0.04)
    step = 1e-4
    for place, direction in enumerate(np.eye(4)):
        up, down = (model(there + sign * step * direction, np.log(speeds), np.zeros(3))[0] for sign in (1.0, -1.0))
        assert slopes[:, place] == pytest.approx((up - down) / (2.0 * step), abs=1e-5)  # second differences
    between = np.log(speeds[:2]) + 0.3
    up, down = (model(there, between + sign * step, np.zeros(2))[0] for sign in (1.0, -1.0))
    assert model(there, between, np.zeros(2))[2] == pytest.approx((up - down) / (2.0 * step), abs=1e-5)


@pytest.mark.parametrize(("indenter", "load"), [(BALL, 1.0), (CYLINDER, 100.0)])
def test_friction_of_a_hardly_viscoelastic_solid_is_the_sum_of_its_modes(indenter: Indenter, load: float) -> None:
    ratio = 1.0 + 1e-4
    found = friction_response(rubber(E_inf=ratio * 1e6), 0.5, indenter, [0.1, 1.0], load, accuracy=0.1)
    # At first order in the modes; the second is E_inf/E0 − 1 of it.
    assert found.log_C.sum(axis=1) == pytest.approx(found.friction, rel=2e-4)
    assert np.all(found.log_C > 0.0)


def test_progress_is_reported() -> None:
    reported = []
    friction_response(
        rubber(), 0.5, CYLINDER, [0.1, 1.0], 100.0, accuracy=0.1, progress=lambda *done: reported.append(done)
    )
    assert reported == [(1, 2), (2, 2)]


def test_failed_contact_is_named() -> None:
    with refused("accuracy-not-reached", ConvergenceError, naming=("0.1 m/s", "2 N")):
        friction_response(rubber(), 0.5, BALL, [0.1], 2.0, accuracy=1e-5, finest=128)
