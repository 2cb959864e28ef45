"""Calls shared out among processes: the same results in the same order, and nothing left running."""

from __future__ import annotations

import os
import pprint
import statistics
import subprocess
from typing import Any

import pytest

from viscofric.errors import InputError, ViscofricError
from viscofric.processes import call_all


@pytest.fixture
def children(monkeypatch: pytest.MonkeyPatch) -> list[subprocess.Popen[bytes]]:
    """Return the processes that are started, as they are."""
    started: list[subprocess.Popen[bytes]] = []

    class Recorded(subprocess.Popen):  # type: ignore[type-arg]
        def __init__(self, *arguments: Any, **settings: Any) -> None:
            super().__init__(*arguments, **settings)
            started.append(self)

    monkeypatch.setattr(subprocess, "Popen", Recorded)
    return started


def test_results_come_in_the_order_of_the_calls(children: list[subprocess.Popen[bytes]]) -> None:
    calls: list[dict[str, Any]] = [{"data": [0.1 * n, 0.3]} for n in range(7)]
    counted: list[int] = []
    shared = call_all(statistics.fmean, calls, workers=3, progress=counted.append)
    assert shared == call_all(statistics.fmean, calls) == [statistics.fmean(**call) for call in calls]
    assert counted == list(range(1, 8))
    assert len(children) == 3
    assert all(child.returncode is not None for child in children)


def test_there_are_no_more_processes_than_calls(children: list[subprocess.Popen[bytes]]) -> None:
    assert call_all(statistics.fmean, [{"data": [1.0]}], workers=8) == [1.0]
    assert call_all(statistics.fmean, [], workers=8) == []
    assert not children


def test_what_a_call_prints_does_not_get_between_the_results() -> None:
    assert call_all(pprint.pprint, [{"object": "lies"}] * 2, workers=2) == [None, None]


def test_error_of_a_call_is_raised_here() -> None:
    calls = [{"data": [1.0]}, {"data": []}, {"data": [2.0]}]
    with pytest.raises(statistics.StatisticsError, match="at least one data point"):
        call_all(statistics.fmean, calls, workers=2)


def test_interrupt_ends_the_processes(children: list[subprocess.Popen[bytes]]) -> None:
    def interrupt(done: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        call_all(statistics.fmean, [{"data": [1.0]}] * 4, workers=2, progress=interrupt)
    assert len(children) == 2
    assert all(child.returncode is not None for child in children)


def test_process_that_ends_too_early_is_told() -> None:
    with pytest.raises(ViscofricError, match="use fewer workers"):
        call_all(os._exit, [{"status": 1}] * 2, workers=2)


def test_what_cannot_be_handed_over_is_told() -> None:
    with pytest.raises(InputError, match=r"workers = 2: what is to be solved cannot be handed .* use one worker"):
        call_all(statistics.fmean, [{"data": lambda: 1.0}] * 2, workers=2)

    def local(data: object) -> object:
        return data

    with pytest.raises(InputError, match="use one worker"):
        call_all(local, [{"data": 1}] * 2, workers=2)


@pytest.mark.parametrize("workers", [0, -1, 1.5, True, "2"])
def test_senseless_numbers_of_workers_are_refused(workers: Any) -> None:
    with pytest.raises(InputError, match="whole number of processes above zero"):
        call_all(statistics.fmean, [], workers=workers)
