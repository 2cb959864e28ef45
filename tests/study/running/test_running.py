"""Plans carried out: the same bits wherever, each case stored as it comes in, and none of them solved twice."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from refusals import refused
from study.running.tasks import TwoWaves, solve_or_end, solve_some, task
from viscofric.errors import DataFileError, ViscofricError
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import key_of, solve, solve_indenter
from viscofric.study.heating import Heatings
from viscofric.study.histories import Histories, Impacts
from viscofric.study.running.executors import Processes, take
from viscofric.study.running.running import STAGES, Event, run_plan
from viscofric.study.running.store import CaseStore, Damaged


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> tuple[TwoWaves, CaseStore]:
    """Return a plan carried out in this process, and its store."""
    plan, store = TwoWaves(), CaseStore(tmp_path_factory.mktemp("alone"))
    run_plan(plan, store, Processes())
    return plan, store


@pytest.fixture(scope="module")
def pair() -> Iterator[Processes]:
    """Return two processes, which take most of a second to start."""
    with Processes(2) as executor:
        yield executor


@pytest.mark.apart
def test_processes_find_the_same_bits_and_one_may_be_killed(
    alone: tuple[TwoWaves, CaseStore], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    children: list[subprocess.Popen[bytes]] = []

    class Recorded(subprocess.Popen):  # type: ignore[type-arg]
        def __init__(self, *arguments: Any, **settings: Any) -> None:
            super().__init__(*arguments, **settings)
            children.append(self)

    monkeypatch.setattr(subprocess, "Popen", Recorded)
    heard: list[Event] = []

    def hear(event: Event) -> None:
        if event.event == "solved" and "solved" not in (one.event for one in heard):
            children[0].kill()
        heard.append(event)

    plan = TwoWaves()
    with Processes(2) as executor:
        run_plan(plan, CaseStore(tmp_path), executor, hear)
    assert plan.bits() == alone[0].bits()
    assert len([event for event in heard if event.event == "solved"]) == 8
    assert heard[-1].as_dict() == {"event": "stage", "stage": "contacts", "done": 8, "total": 8, "solves": 8}
    assert len(children) == 3
    assert all(child.returncode is not None for child in children)


def test_every_stage_that_solves_contacts_has_words() -> None:
    assert {"contacts", Heatings.STAGE, Histories.STAGE, Impacts.STAGE} < set(STAGES)


def test_what_is_stored_is_not_solved_again(alone: tuple[TwoWaves, CaseStore]) -> None:
    def refuse(**_: object) -> Record:
        raise AssertionError("a stored case was solved again")

    plan, heard = TwoWaves(refuse), []
    run_plan(plan, alone[1], Processes(), heard.append)
    assert plan.bits() == alone[0].bits()
    assert [event.event for event in heard] == ["stage", *["stored"] * 8, "stage"]


@pytest.mark.parametrize("processes", [False, pytest.param(True, marks=pytest.mark.slow)], ids=["serial", "processes"])
def test_failed_cases_leave_the_others_alone(request: pytest.FixtureRequest, processes: bool, tmp_path: Path) -> None:
    plan, store = TwoWaves(solve_some), CaseStore(tmp_path)
    heard: list[Event] = []
    executor = request.getfixturevalue("pair") if processes else Processes()
    run_plan(plan, store, executor, heard.append)
    failures = [one for one in plan.known.values() if isinstance(one, Failure)]
    assert [str(one) for one in failures] == [
        "0.1 m/s: it does not converge.",
        "5 m/s: unexpectedly, MemoryError: nobody thought of that",
    ]
    assert [one.code for one in failures] == ["", "unexpected-error"]
    assert {event.reason for event in heard if event.event == "failed"} == {one.reason for one in failures}
    # What was unexpected may go another time; what does not converge will not.
    assert store.get(plan.first[0].key) == failures[0]
    assert store.get(plan.first[-1].key) is None
    assert len(list(store.stored())) == 7


@pytest.mark.apart
def test_case_that_ends_one_process_after_the_other_is_lost_alone(pair: Processes, tmp_path: Path) -> None:
    plan, store = TwoWaves(solve_or_end), CaseStore(tmp_path)
    run_plan(plan, store, pair)
    (failure,) = (one for one in plan.known.values() if isinstance(one, Failure))
    assert (failure.label, failure.code) == ("0.1 m/s", "process-ended")
    assert store.get(plan.first[0].key) is None
    assert len(list(store.stored())) == 7


@pytest.mark.slow
def test_interrupt_loses_no_more_than_what_is_worked_on(tmp_path: Path) -> None:
    store, solved = CaseStore(tmp_path), []

    def interrupted(**contact: Any) -> Record:
        if len(solved) == 3:
            raise KeyboardInterrupt
        return counted(**contact)

    def counted(**contact: Any) -> Record:
        solved.append(key_of(contact))
        return solve_indenter(**contact)

    with pytest.raises(KeyboardInterrupt):
        run_plan(TwoWaves(interrupted), store, Processes())
    assert sorted(store.stored()) == sorted(solved)
    plan = TwoWaves(counted)
    run_plan(plan, store, Processes())
    assert sorted(solved) == sorted(plan.known)  # each of them once


def test_full_disk_ends_a_run_and_leaves_the_finished_cases(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written, sync = [], os.fsync

    def fill_up(handle: int) -> None:
        written.append(handle)
        if len(written) > 4:  # a file and its folder each
            raise OSError(28, "No space left on device")
        sync(handle)

    monkeypatch.setattr("viscofric.files.os.fsync", fill_up)
    store = CaseStore(tmp_path)
    with refused("not-written", DataFileError):
        run_plan(TwoWaves(), store, Processes())
    assert len(list(tmp_path.iterdir())) == 2
    assert all(isinstance(store.get(key), Record) for key in store.stored())


def test_fields_are_kept_beside_the_numbers(tmp_path: Path) -> None:
    asked, store = task(1.0, fields=True), CaseStore(tmp_path)
    record = solve(asked)
    store.put(asked.key, record)
    again = store.get(asked.key, with_fields=True)
    assert isinstance(again, Record)
    assert again == store.get(asked.key) == record
    assert record.fields is not None
    assert again.fields is not None
    for one, other in zip(record.fields, again.fields, strict=True):
        assert one.tobytes() == other.tobytes()
    # Without its fields, a case whose fields are wanted is not there.
    whole = (tmp_path / f"{asked.key}.npz").read_bytes()
    for size in (0, 2, len(whole) // 2, len(whole) - 1):
        (tmp_path / f"{asked.key}.npz").write_bytes(whole[:size])
        assert isinstance(store.get(asked.key, with_fields=True), Damaged)
    # Nor are fields of another contact those of this one.
    other = solve(task(2.0, fields=True))
    store.put("other", other)
    (tmp_path / f"{asked.key}.npz").write_bytes((tmp_path / "other.npz").read_bytes())
    assert set(store.damaged()) == {asked.key}
    assert store.get(asked.key) == record


@pytest.mark.slow
def test_worker_with_another_solver_is_refused(
    pair: Processes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with refused("other-solver", ViscofricError):
        take(task(1.0), "another")
    monkeypatch.setattr("viscofric.study.running.executors.solver_fingerprint", lambda: "another")
    with refused("other-solver", ViscofricError):
        run_plan(TwoWaves(), CaseStore(tmp_path), pair)
    assert not list(tmp_path.iterdir())
