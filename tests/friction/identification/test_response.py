"""Friction at many speeds and its derivatives: the forward model of an identification."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import ConvergenceError
from viscofric.friction.identification import solving
from viscofric.friction.identification.forward import CorrectedFriction, FirstOrder, Solved
from viscofric.friction.identification.solving import Contacts

BALL, CYLINDER = vf.Ball(radius=10e-3), vf.Cylinder(radius=10e-3)
ACCURACY = 1e-2


def rubber(E0: float = 1e6, E_inf: float = 1e8, tau: tuple[float, ...] = (1e-5, 1e-4, 1e-3)) -> vf.RetardationSpectrum:
    """Modes of equal compliance."""
    times = np.array(tau)
    return vf.RetardationSpectrum(E0, E_inf, np.full(len(times), (1.0 / E0 - 1.0 / E_inf) / len(times)), times)


def solved(
    spectrum: vf.RetardationSpectrum, indenter: Indenter, load: float, speeds: list[float], accuracy: float = ACCURACY
) -> Solved:
    compliances = np.log([1.0 / spectrum.E_inf, *spectrum.C])
    return Contacts(indenter, 0.5, load, 1).at(compliances, vf.Material(spectrum), np.log(speeds), 1, accuracy)


@pytest.mark.slow
def test_numbers_are_those_of_the_contacts() -> None:
    material = vf.Material(rubber(), poisson_ratio=0.5)
    solution = vf.solve_steady(material, BALL, speed=3.0, load=2.0, derivatives=True)
    assert solution.derivatives is not None
    found, rough = (solved(rubber(), BALL, 2.0, [3.0], accuracy) for accuracy in (1e-3, ACCURACY))
    friction, logarithmic = solution.friction_coefficient, solution.derivatives.logarithmic
    near = {"rel": 1e-9}  # the same operations
    assert found.log_friction == pytest.approx(np.log([friction]), **near)
    assert found.error == pytest.approx(solution.diagnostics.friction_error / friction, **near)
    assert friction * found.change[0] == pytest.approx([-logarithmic.E_inf, *logarithmic.C], **near)
    assert friction * found.load_slope == pytest.approx(logarithmic.load, **near)
    # At a loose accuracy the grids are half as fine.
    apart = np.abs(np.expm1(rough.log_friction - found.log_friction))
    assert 0.0 < apart <= rough.error + found.error
    # Of the derivatives twice the largest error that forty random rubbers have: 1e-2 of the largest.
    assert np.abs(rough.change - found.change)[:, 1:].max() <= 0.02 * np.abs(found.change[:, 1:]).max()


@pytest.mark.parametrize("moved", [(0.0, -3.0, 0.0, 0.0), (0.0, 0.0, 1.5, 0.0), (1.0, -1.0, -0.5, 0.5)])
def test_solved_contacts_give_the_friction_of_other_materials(moved: tuple[float, ...]) -> None:
    """A mode twenty times weaker or four times stronger changes friction by 15 to 60 %: known to 4 % of friction."""
    speeds = [0.3, 1.0, 3.0]
    spectrum = rubber(E_inf=1e7)
    here = np.log([1.0 / spectrum.E_inf, *spectrum.C])
    there = here + moved

    def of(compliances: np.ndarray) -> Solved:
        glass, *C = np.exp(compliances)
        other = vf.RetardationSpectrum(1.0 / (glass + sum(C)), 1.0 / glass, np.array(C), spectrum.tau)
        return solved(other, BALL, 1.0, speeds)

    model = CorrectedFriction(FirstOrder(BALL, 1.0, 0.75, spectrum.tau), of(here))
    value, slopes, _ = model(there, np.log(speeds), np.zeros(3))
    # The first-order form errs by up to 20 % here, and linear extrapolation in ln C by 9 %.
    assert value == pytest.approx(of(there).log_friction, abs=0.04)
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
    found = solved(rubber(E_inf=ratio * 1e6), indenter, load, [0.1, 1.0], accuracy=0.1)
    # At first order in the modes; the second is E_inf/E0 − 1 of it.
    assert found.change[:, 1:].sum(axis=1) == pytest.approx(1.0, rel=2e-4)
    assert np.all(found.change[:, 1:] > 0.0)


def test_progress_is_reported() -> None:
    reported: list[tuple[int, int, int]] = []
    contacts = Contacts(CYLINDER, 0.5, 100.0, 1, progress=lambda *done: reported.append(done))
    spectrum = rubber()
    contacts.at(np.log([1.0 / spectrum.E_inf, *spectrum.C]), vf.Material(spectrum), np.log([0.1, 1.0]), 3, 0.1)
    assert reported == [(3, 1, 2), (3, 2, 2)]


def test_failed_contact_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object, **__: object) -> None:
        raise ConvergenceError("does not settle.", code="not-converged")

    monkeypatch.setattr(solving, "friction_and_derivatives", fails)
    with refused("not-converged", ConvergenceError, naming=("0.1 m/s", "2 N")):
        solved(rubber(), BALL, 2.0, [0.1])
