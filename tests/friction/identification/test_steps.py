"""An identification finds its way where the neighbourhood of solved contacts promises too much."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.identification.planted import BALL, REFERENCE, RUBBER, closed_form_curves, planted_anchor
from refusals import refused
from viscofric.errors import ConvergenceError
from viscofric.friction.identification import iteration
from viscofric.friction.identification.forward import CorrectedFriction, Solved
from viscofric.friction.identification.problem import Problem
from viscofric.friction.identification.solving import Contacts

SETTINGS = {"indenter": BALL, "samples": 20, "modes": 15, "shift": RUBBER.shift, "anchor": planted_anchor(1e8)}
#: How steeply friction changes with the relaxed compliance about that of the planted rubber.
STEEP = 20.0


class Bent:
    """Contacts whose friction also tells the relaxed compliance, by an arc tangent of STEEP times its logarithm.

    Newton's steps from where that is beyond 1.39 overshoot further each time: only damped ones arrive.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch, failing: int = 0) -> None:
        self.failing = failing
        self.squares: list[float] = []
        monkeypatch.setattr(Contacts, "solved", lambda contacts, *given: self.solved(*given))

    def solved(self, problem: Problem, unknowns: np.ndarray, step: int, accuracy: float) -> Problem:
        assert step == len(self.squares) + 1  # each rubber is counted
        if self.failing and step > 1:
            self.failing -= 1
            self.squares.append(np.inf)
            raise ConvergenceError("not solved.", code="test-not-solved")
        compliances, _ = problem.split(unknowns)
        nodes = problem.points.log_speed.min() + np.linspace(-6.0, 6.0, 13)
        shares = np.exp(compliances)
        away = STEEP * np.log(shares.sum() * RUBBER.modes_at().E0)
        first = problem.friction.first(compliances, nodes)
        friction = Solved(
            compliances,
            nodes,
            first.log_friction + np.arctan(away),
            np.full(len(nodes), 1e-5),
            first.change + STEEP / (1.0 + away**2) * shares / shares.sum(),
            np.zeros(len(nodes)),
        )
        result = replace(problem, friction=CorrectedFriction(problem.friction.first, friction))
        values, _ = result(unknowns)
        self.squares.append(float(values @ values))
        return result


def known_to_a_hundredth() -> vf.FrictionCurves:
    curves = closed_form_curves(REFERENCE)
    return replace(curves, viscoelastic_error=0.01 * curves.viscoelastic)


@pytest.mark.parametrize("failing", [0, 2])
@pytest.mark.slow
def test_steps_that_promise_too_much_are_tried_nearer_by(monkeypatch: pytest.MonkeyPatch, failing: int) -> None:
    bent = Bent(monkeypatch, failing)
    found = vf.identify_material(known_to_a_hundredth(), **SETTINGS)
    assert found.iterations == len(bent.squares)
    assert max(bent.squares[1:]) > bent.squares[0]  # the first step led astray, and was not made
    assert bent.squares[-1] == min(bent.squares) < 1.0
    # Friction known to a hundredth tells it to a hundredth of an e-fold over STEEP, and its level alone to 5 %.
    ratio = found.material.modes_at().E0 / RUBBER.modes_at().E0
    assert ratio == pytest.approx(1.0, rel=0.05)


def test_what_does_not_settle_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    bent = Bent(monkeypatch)
    monkeypatch.setattr(iteration, "STEPS", 3)
    with refused("not-converged", ConvergenceError):
        vf.identify_material(known_to_a_hundredth(), **SETTINGS)
    assert len(bent.squares) == 3


def test_contacts_that_fail_everywhere_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    Bent(monkeypatch, failing=100)
    with pytest.raises(ConvergenceError) as caught:
        vf.identify_material(known_to_a_hundredth(), **SETTINGS)
    assert caught.value.code == "test-not-solved"  # as the solver raised it
