"""Marches of movers whose errors do not fall with shorter steps: each has an end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.errors import ConvergenceError
from viscofric.motion.march import march
from viscofric.motion.mover import Field, Observation, Sizes

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")


@dataclass(frozen=True)
class Unsteady:
    """A depth of 1 m with an error that depends on anything but the length of steps; the state is (steps, time)."""

    alternating: float = 0.0  # error after every other step
    jump: float = 0.0  # of the depth at 0.3 s
    marked: tuple[float, ...] | None = None  # ticks

    scales = Sizes(1.0, 1.0, 1.0, 1.0)
    share, quickest, can_tighten = 0.05, 1e-2, False

    def floor(self, largest):
        return Sizes(0.0, 0.0, 0.0, 0.0)

    def begin(self):
        return 0, 0.0

    def step(self, state, start, end):
        return state[0] + (end.time > start.time), end.time

    def settle(self, state, instant, shortest):
        return state

    def accept(self, state, instant):
        pass

    def observe(self, state):
        depth = 1.0 + self.alternating * (state[0] % 2) + self.jump * (state[1] > 0.3)
        return Observation(1.0, depth, (0.0, 0.0), 1.0, 0.0, 0.0, {})

    def pressure(self, state):
        return Field({"x": np.zeros(1)}, np.zeros(1))

    def pointwise_difference(self, one, other):
        return 0.0

    def rate_change(self, first, middle, last, start, end):
        return 0.0

    def early(self, since):
        return 1.0

    def ticks(self, start, end):
        return self.marked


SCHEDULE = vf.motion.History([0.0, 1.0], load=1.0).schedule(RUBBER, "point")


@pytest.mark.parametrize("error", [6e-5, 2e-4])
def test_a_march_whose_errors_never_fall_has_an_end(error):
    """A step may add 5e-5; the difference of the chains remains far below the accuracy, so that nothing adds up."""
    with refused("steps-not-converged", ConvergenceError):
        march(Unsteady(alternating=error), SCHEDULE, accuracy=1e-3)


def test_a_contact_that_changes_by_much_within_the_shortest_step_is_refused_at_once():
    """Each step adds five times the accuracy, however short it is."""
    with pytest.raises(ConvergenceError) as caught:
        march(Unsteady(alternating=5e-3), SCHEDULE, accuracy=1e-3)
    assert caught.value.code == "steps-not-converged"
    assert caught.value.note.values["time"] == 0.0
    assert 0.0 < caught.value.note.values["step"] <= 1e-10


def test_a_march_by_ticks_whose_errors_never_fall_takes_every_tick():
    """A step of two ticks cannot be shorter: it is accepted, and the stated error shows it."""
    marked = tuple(np.linspace(0.0, 1.0, 101)[1:])
    track = march(Unsteady(alternating=2e-4, marked=marked), SCHEDULE, accuracy=1e-3)
    assert (track.steps, track.rejected) == (50, 0)
    assert max(one.errors.depth for one in track.moments) == pytest.approx(0.8 * 2e-4)


def test_a_tolerance_whose_noise_shorter_steps_do_not_reduce_is_lowered():
    class Loose(Unsteady):
        noise = 2e-4

        @property
        def can_tighten(self):
            return self.noise > 1e-6

        def tighten(self):
            Loose.noise *= 0.1

        def observe(self, state):
            depth = 1.0 + self.noise * (state[0] % 2)
            return Observation(1.0, depth, (0.0, 0.0), 1.0, 0.0, 0.0, {})

    march(Loose(), SCHEDULE, accuracy=1e-3)
    assert Loose.noise == pytest.approx(2e-6)  # energies count three times: 2e-5 is too much


def test_a_jump_of_the_response_takes_one_least_step():
    track = march(Unsteady(jump=2e-4), SCHEDULE, accuracy=1e-3, times=[0.2, 0.4])
    assert [one.seen.depth for one in track.moments] == [1.0, 1.0002]
    assert track.steps + track.rejected < 200
