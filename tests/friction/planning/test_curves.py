"""Many cases on one curve: how few contacts are solved for them, and how right the others are."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.planning.made_up_contacts import SLS, carry_out, case_of, made_up
from viscofric.friction.cases.case import Rubbers, Settings
from viscofric.friction.cases.indenter_case import ERRORS, NAMES, IndenterCase, units_of
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import Task, solve
from viscofric.friction.planning.plan import Outcome, Plan

TEMPERATURES = np.linspace(283.15, 383.15, 8).tolist()
SPEEDS = np.geomspace(1e-3, 1.0, 30).tolist()
CASES = [case_of(speed, temperature) for temperature in TEMPERATURES for speed in SPEEDS]


def records(outcomes: list[Outcome]) -> list[Record]:
    """All of them, none of which may have failed."""
    assert not [outcome for outcome in outcomes if isinstance(outcome, Failure)]
    return [outcome for outcome in outcomes if isinstance(outcome, Record)]


def alone(case: IndenterCase) -> Task:
    """Return what solving a case by itself takes."""
    (task,) = Plan([case], [SLS], each=True).wanted()
    return task


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3, 1e-4])
@pytest.mark.slow
def test_cases_on_one_curve_are_interpolated_within_the_accuracy(accuracy: float) -> None:
    plan = Plan(CASES, [SLS], accuracy=accuracy)
    tasks = sum(map(len, carry_out(plan)))
    assert tasks < len(CASES) / 2
    for case, record in zip(CASES, records(plan.found()), strict=True):
        true = made_up(alone(case))
        assert (record.speed, record.temperature, record.load) == (case.speed, case.temperature, case.load)
        apart = abs(record.friction_coefficient - true.friction_coefficient)
        # What is claimed is as much as is allowed to interpolation, and what the contacts themselves may be off.
        assert apart <= record.friction_error <= (0.25 * 8.0 + 1.0) * accuracy * true.friction_coefficient
        assert apart <= 0.5 * accuracy * true.friction_coefficient
        for name, error in zip(NAMES, ERRORS, strict=True):
            if error is not None:
                assert abs(getattr(record, name) - getattr(true, name)) <= getattr(record, error), name


def test_progress_goes_from_none_to_all_and_never_back() -> None:
    plan, seen = Plan(CASES, [SLS]), [0]
    assert (plan.done, plan.total) == (0, len(CASES))
    while tasks := plan.wanted():
        for task in tasks:
            plan.receive(task.key, made_up(task))
            seen.append(plan.done)
    assert seen == sorted(seen)
    assert len(set(seen)) > 2
    assert plan.done == plan.total


@pytest.mark.slow
def test_more_accuracy_takes_more_contacts() -> None:
    counts = []
    for accuracy in (1e-2, 1e-3, 1e-4):
        plan = Plan(CASES, [SLS], accuracy=accuracy)
        counts.append(sum(map(len, carry_out(plan))))
    assert counts[0] <= counts[1] < counts[2]


@pytest.mark.slow
def test_scatter_of_the_contacts_does_not_refine_without_end() -> None:
    def scattered(task: Task) -> Record:
        record = made_up(task)
        noise = np.random.default_rng(int(1e9 * task.arguments["speed"])).uniform(-1.0, 1.0)
        error = 1e-3 * record.friction_coefficient
        friction = record.friction_coefficient + noise * error
        return replace(record, numbers={**record.numbers, "friction_coefficient": friction, "friction_error": error})

    smooth, rough = Plan(CASES, [SLS]), Plan(CASES, [SLS])
    few = sum(map(len, carry_out(smooth)))
    # The contacts' own errors are all of the accuracy: where interpolating adds to them, cases are solved themselves.
    assert sum(map(len, carry_out(rough, scattered))) <= 1.6 * few
    between = [record for record in records(rough.found()) if record.interpolated]
    assert all(record.friction_error <= 1e-3 * record.friction_coefficient for record in between)
    off = [
        (record.friction_coefficient - made_up(alone(case)).friction_coefficient) / record.friction_error
        for case, record in zip(CASES, records(rough.found()), strict=True)
    ]
    # The scatter is uniform up to the error that is claimed, which is √3 of its standard deviations: between nodes, as
    # of a normal distribution, 92 % lie within it.  Cases between the same nodes share their scatter: 240 are some 40.
    assert np.mean(np.abs(off) <= 1.0) >= 0.85


@pytest.mark.parametrize("seed", [1, 2])
def test_order_of_the_answers_does_not_matter(seed: int) -> None:
    first, second = Plan(CASES, [SLS]), Plan(CASES, [SLS])
    assert carry_out(first) == carry_out(second, order=np.random.default_rng(seed))
    assert first.found() == second.found()


def test_order_of_the_cases_does_not_matter() -> None:
    shuffled = np.random.default_rng(5).permutation(len(CASES))
    first, second = Plan(CASES, [SLS]), Plan([CASES[row] for row in shuffled], [SLS])
    assert carry_out(first) == carry_out(second)
    found = first.found()
    assert [found[row] for row in shuffled] == second.found()


def test_a_study_that_gains_cases_uses_the_nodes_it_had() -> None:
    grown = [*CASES, *(replace(case, load=4.0 * case.load, indenter=vf.Ball(0.02)) for case in CASES)]
    old, new = Plan(CASES, [SLS]), Plan(grown, [SLS])
    before = {key for wave in carry_out(old) for key in wave}
    after = {key for wave in carry_out(new) for key in wave}
    assert before <= after
    assert len(after) < 1.2 * len(before)
    for one, other in zip(records(old.found()), records(new.found()[: len(CASES)]), strict=True):
        assert other.friction_coefficient == pytest.approx(one.friction_coefficient, rel=1e-3)  # the accuracy


def test_fewer_cases_than_nodes_are_solved_by_themselves() -> None:
    cases = [case_of(speed) for speed in (1e-3, 1e-2, 1e-1, 1.0)]
    plan = Plan(cases, [SLS])
    assert [task.arguments["speed"] for task in plan.wanted()] == [case.speed for case in cases]
    carry_out(plan)
    assert not any(record.interpolated for record in records(plan.found()))


def test_no_value_is_found_beyond_the_nodes() -> None:
    plan = Plan(CASES, [SLS])
    speeds = []

    def noted(task: Task) -> Record:
        speeds.append(task.arguments["speed"] * float(task.arguments["modes"].tau[0]))
        return made_up(task)

    carry_out(plan, noted)
    asked = [case.speed * float(alone(case).arguments["modes"].tau[0]) for case in CASES]
    # Nodes are contacts of a unit length of 10 mm, cases of another.
    length = CASES[0].place(Rubbers([SLS], {})).units.length
    assert min(speeds) / 0.01 <= min(asked) / length
    assert max(speeds) / 0.01 >= max(asked) / length


def test_a_failed_node_leaves_only_its_neighbours_to_be_solved_by_themselves() -> None:
    plan = Plan(CASES, [SLS])
    bad = {task.key for task in plan.wanted()[4:5]}

    def failing(task: Task) -> Outcome:
        return Failure("did not converge.", task.label) if task.key in bad else made_up(task)

    carry_out(plan, failing)
    found = records(plan.found())
    by_themselves = [record for record in found if not record.interpolated]
    assert 0 < len(by_themselves) < len(CASES) / 3
    for case, record in zip(CASES, found, strict=True):
        true = made_up(alone(case)).friction_coefficient
        assert record.friction_coefficient == pytest.approx(true, rel=1e-3)  # the accuracy


def test_where_all_fails_every_case_says_so() -> None:
    plan = Plan(CASES, [SLS])
    carry_out(plan, lambda task: Failure("did not converge.", task.label))
    found = [outcome for outcome in plan.found() if isinstance(outcome, Failure)]
    assert {outcome.reason for outcome in found} == {"did not converge."}
    assert len({outcome.label for outcome in found}) == len(CASES)


def test_fields_are_kept_of_cases_that_are_solved_by_themselves() -> None:
    plan = Plan(CASES, [SLS], fields=[3, 5])
    assert [task.arguments["speed"] for task in plan.wanted() if task.fields] == [CASES[3].speed, CASES[5].speed]
    everywhere = Plan(CASES[:5], [SLS], fields=True)
    assert [task.fields for task in everywhere.wanted()] == [True] * 5


def test_speed_zero_and_other_impossible_cases_fail_alone() -> None:
    plan = Plan([*CASES, case_of(0.0), case_of(0.1, temperature=100.0)], [SLS])
    carry_out(plan)
    *good, still, cold = plan.found()
    assert len(records(good)) == len(CASES)
    assert isinstance(still, Failure)
    assert still.code == "not-positive"
    assert isinstance(cold, Failure)
    assert "WLF" in cold.reason


VERTICAL = replace(
    SLS, vertical_shift=vf.rheology.VerticalShiftFactors([283.15, 303.15, 343.15], [-0.05, 0.0, 0.08], reference=303.15)
)


@pytest.mark.parametrize(
    "case",
    [
        case_of(1.0, load=3.0, indenter=vf.Ball(0.03)),
        case_of(1.0, load=30.0, indenter=vf.Cylinder(0.02)),
        case_of(1.0, load=0.1, indenter=vf.Cone(0.1)),
        case_of(1.0, load=0.1, indenter=vf.Ellipsoid(0.01, 0.03)),
        case_of(1.0, modulus=5e6, poisson_ratio=0.4),
        case_of(1.0, layer=vf.Layer(1e-3)),
        case_of(1.0, layer=vf.Layer(1e-3), modulus=5e6),
    ],
    ids=lambda case: f"{case.indenter.noun}{'-layer' * (case.layer is not None)}{'-elastic' * bool(case.modulus)}",
)
def test_the_contact_that_stands_for_a_case_is_the_same_in_other_units(case: IndenterCase) -> None:
    rubbers, settings = Rubbers([VERTICAL], {}), Settings(0.02, False, frozenset())
    case = replace(case, temperature=343.15)
    place = case.place(rubbers)
    node = 40
    case = replace(case, speed=math.exp(node / 32.0 - place.s))
    place = case.place(rubbers)
    assert place.s == pytest.approx(node / 32.0, abs=1e-12)
    stands_for = rubbers.node_task(place.family, math.exp(node / 32.0), settings)
    theirs = place.family.node(solve(stands_for), rubbers, settings.accuracy).values * units_of(place.units, place.b)
    task = rubbers.task(case, settings, fields=False)
    assert isinstance(task, Task)
    one, other = ((asked.arguments["modes"].E0, asked.arguments["load"]) for asked in (task, stands_for))
    assert one != other
    own = solve(task)
    for name, value in zip(NAMES, theirs, strict=True):
        if math.isfinite(getattr(own, name)):
            # Rounding alone differs; it moves cells at the edge, hence what depends on single ones, a little.
            assert value == pytest.approx(getattr(own, name), rel=1e-5), name
