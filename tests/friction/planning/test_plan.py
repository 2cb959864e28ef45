"""What a plan asks to be solved, and what it makes of the answers."""

from __future__ import annotations

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.planning.made_up_contacts import SLS, carry_out, case_of, made_up
from refusals import refused
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import solve
from viscofric.friction.planning.plan import Plan


def test_equal_cases_are_solved_once() -> None:
    plan = Plan([case_of(0.1), case_of(0.2), case_of(0.1)], [SLS], each=True)
    assert [task.arguments["speed"] for task in plan.wanted()] == [0.1, 0.2]
    for task in reversed(plan.wanted()):
        plan.receive(task.key, made_up(task))
    assert plan.wanted() == []
    assert [outcome.speed for outcome in plan.found()] == [0.1, 0.2, 0.1]


def test_nothing_is_found_before_everything_is_known() -> None:
    plan = Plan([case_of(0.1), case_of(0.2)], [SLS])
    assert (plan.done, plan.total) == (0, 2)
    plan.receive(plan.wanted()[0].key, made_up(plan.wanted()[0]))
    assert (plan.done, plan.total) == (1, 2)
    with refused("unfinished"):
        plan.found()


def test_a_case_that_cannot_be_is_a_failure_and_the_others_go_on() -> None:
    plan = Plan([case_of(0.1, temperature=100.0), case_of(0.1), case_of(0.1, sample=3)], [SLS])
    assert len(plan.wanted()) == 1
    plan.receive(plan.wanted()[0].key, Failure("the solver failed.", "here"))
    cold, failed, unknown = plan.found()
    assert isinstance(cold, Failure)
    assert "−173.1 °C, 100 mm/s" in str(cold)
    assert str(failed) == "here: the solver failed."
    assert isinstance(unknown, Failure)
    assert unknown.code == "no-sample"


def test_key_changes_with_all_that_decides_the_answer() -> None:
    (task,) = Plan([case_of(0.1)], [SLS]).wanted()
    others = [
        replace(task, arguments=task.arguments | change)
        for change in (
            {"modes": task.arguments["modes"].shifted(2.0)},
            {"poisson_ratio": 0.4},
            {"indenter": vf.Ball(0.02)},
            {"indenter": vf.Cylinder(0.01)},
            {"indenter": vf.HeightMap(np.outer(np.arange(5.0), np.ones(5)), 1e-3)},
            {"indenter": vf.HeightMap(np.outer(np.arange(5.0), np.ones(5)) * 2, 1e-3)},
            {"speed": 0.2},
            {"load": 2.0},
            {"temperature": 300.0},
            {"accuracy": 1e-2},
            {"layer": vf.Layer(1e-3)},
            {"layer": vf.Layer(1e-3, bonded=False)},
            {"indenter_modulus": 1e9},
            {"indenter_poisson_ratio": 0.2},
            {"sensitive": True},
            {"fields": True},
        )
    ]
    keys = {task.key, *(other.key for other in others)}
    assert len(keys) == 1 + len(others)
    assert replace(task, label="another name").key == task.key


def test_a_task_that_travelled_gives_the_same_bits() -> None:
    (task,) = Plan([case_of(0.1)], [SLS], accuracy=1e-2, fields=True).wanted()
    here, there = solve(task), solve(pickle.loads(pickle.dumps(task)))
    assert here == there
    assert here.fields is not None
    assert there.fields is not None
    np.testing.assert_array_equal(here.fields.pressure, there.fields.pressure)
    # The fields hold what the numbers tell: the load, to what the solver promises of it.
    cell = np.ptp(here.fields.x[:2]) * np.ptp(here.fields.y[:2])
    assert here.fields.pressure.sum() * cell == pytest.approx(task.arguments["load"], rel=1e-6)


def test_members_of_the_posterior_are_solved_with_their_own_modes() -> None:
    softer = replace(SLS, spectrum=SLS.at().shifted(1.0, 0.5))  # type: ignore[union-attr]
    plan = Plan([case_of(0.1), case_of(0.1, sample=1)], [SLS], members={0: [softer]}, sensitive=True)
    best, drawn = (task.arguments for task in plan.wanted())
    assert (best["sensitive"], drawn["sensitive"]) == (True, False)  # bands are those of the best estimate
    assert (best["modes"].E0, drawn["modes"].E0) == (1e6, 0.5e6)


def test_line_contacts_are_recorded_too() -> None:
    (task,) = Plan([case_of(0.1, load=100.0, indenter=vf.Cylinder(0.01))], [SLS], accuracy=1e-2).wanted()
    record = solve(task)
    assert Record.from_values(json.loads(json.dumps(record.values()))) == record


def test_what_lies_between_solved_contacts_is_reported_before_the_end() -> None:
    speeds = np.geomspace(1e-3, 10.0, 60)
    plan = Plan([case_of(float(speed)) for speed in speeds], [SLS], accuracy=1e-2)
    first, second, *others = plan.wanted()
    assert list(plan.so_far()) == []
    plan.receive(first.key, made_up(first))
    assert list(plan.so_far()) == []
    plan.receive(second.key, made_up(second))
    drafts = list(plan.so_far())
    # Slowest first, and nothing beyond the two contacts.
    assert [number for number, _, _ in drafts] == list(range(len(drafts)))
    assert 0 < len(drafts) < len(speeds) / 4
    assert not any(known for _, _, known in drafts)
    for task in others:
        plan.receive(task.key, made_up(task))
    half_way = {number: (outcome, known) for number, outcome, known in plan.so_far()}
    assert len(half_way) == len(speeds)
    assert not all(known for _, known in half_way.values())
    carry_out(plan)
    end = list(plan.so_far())
    assert [outcome for _, outcome, _ in end] == plan.found()
    assert all(known for _, _, known in end)
    for number, outcome, _ in end:
        drafted, known = half_way[number]
        assert isinstance(outcome, Record)
        assert isinstance(drafted, Record)
        # What counts as known is so within the accuracy; drafts between contacts a factor of e apart are near it.
        allowed = 1e-2 if known else 0.1
        assert drafted.friction_coefficient == pytest.approx(outcome.friction_coefficient, rel=allowed)
