"""Calls shared out among processes: the same results in the same order, and nothing left running."""

from __future__ import annotations

import os
import pprint
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from refusals import refused
from viscofric.errors import ViscofricError
from viscofric.processes import LimitedProcess, Workers, call_all

ONES: list[dict[str, Any]] = [{"data": [1.0]}] * 4


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


def test_call_gets_no_input() -> None:
    with pytest.raises(EOFError):
        call_all(input, [{}] * 2, workers=2)


def test_error_of_a_call_is_raised_here() -> None:
    calls = [{"data": [1.0]}, {"data": []}, {"data": [2.0]}]
    with pytest.raises(statistics.StatisticsError, match="at least one data point"):
        call_all(statistics.fmean, calls, workers=2)


def interrupt(done: int) -> None:
    raise KeyboardInterrupt


def test_interrupt_ends_the_processes(children: list[subprocess.Popen[bytes]]) -> None:
    with pytest.raises(KeyboardInterrupt):
        call_all(statistics.fmean, ONES, workers=2, progress=interrupt)
    assert len(children) == 2
    assert all(child.returncode is not None for child in children)


def test_process_that_ends_too_early_is_reported() -> None:
    with refused("process-ended", ViscofricError):
        call_all(os._exit, [{"status": 1}] * 2, workers=2)


@pytest.mark.slow
def test_what_cannot_be_handed_over_is_reported() -> None:
    with refused("not-picklable", naming="workers = 2"):
        call_all(statistics.fmean, [{"data": lambda: 1.0}] * 2, workers=2)

    def local(data: object) -> object:
        return data

    with refused("not-picklable"):
        call_all(local, [{"data": 1}] * 2, workers=2)


def test_same_processes_answer_one_set_of_calls_after_another(children: list[subprocess.Popen[bytes]]) -> None:
    with Workers(3) as workers:
        assert not children  # none is started for nothing
        assert call_all(os.getpid, [{}], workers=workers) == [os.getpid()]
        for count, started in ((2, 2), (4, 3), (6, 3), (2, 3)):
            calls: list[dict[str, Any]] = [{"data": [0.1 * n, 0.3]} for n in range(count)]
            counted: list[int] = []
            shared = call_all(statistics.fmean, calls, workers=workers, progress=counted.append)
            assert shared == [statistics.fmean(**call) for call in calls]
            assert counted == list(range(1, count + 1))
            assert len(children) == started
        assert set(call_all(os.getpid, [{}] * 9, workers=workers)) <= {child.pid for child in children}
        assert all(child.poll() is None for child in children)
    assert all(child.returncode is not None for child in children)


def test_workers_outlive_a_call_that_failed(children: list[subprocess.Popen[bytes]]) -> None:
    """Nor does what was begun along with it get among later results."""
    with Workers(2) as workers:
        for _ in range(3):
            with pytest.raises(statistics.StatisticsError, match="at least one data point"):
                call_all(statistics.fmean, [{"data": []}, *ONES], workers=workers)
            assert call_all(statistics.fmean, [{"data": [n]} for n in range(5)], workers=workers) == [0, 1, 2, 3, 4]
        assert len(children) == 2


@pytest.mark.slow
def test_workers_that_ended_are_reported_and_replaced(children: list[subprocess.Popen[bytes]]) -> None:
    with Workers(2) as workers:
        with refused("process-ended", ViscofricError):
            call_all(os._exit, [{"status": 1}] * 2, workers=workers)
        assert call_all(statistics.fmean, ONES, workers=workers) == [1.0] * 4
        alive = [child for child in children if child.poll() is None]
        assert len(alive) == 2
        alive[0].kill()
        alive[0].wait()
        # Killed while it had nothing to do: nothing is lost.
        assert call_all(statistics.fmean, ONES, workers=workers) == [1.0] * 4
        assert sum(child.poll() is None for child in children) == 2
    assert all(child.returncode is not None for child in children)


def test_worker_that_lacked_memory_is_replaced(children: list[subprocess.Popen[bytes]]) -> None:
    with Workers(2) as workers:
        with pytest.raises(MemoryError):
            call_all(bytearray, [{"source": sys.maxsize}] * 2, workers=workers)
        used = set(call_all(os.getpid, [{}] * 9, workers=workers))
        ended = {child.pid for child in children if child.poll() is not None}
        assert ended
        assert used.isdisjoint(ended)


@pytest.mark.slow
def test_interrupted_workers_end_at_once_and_start_anew(children: list[subprocess.Popen[bytes]]) -> None:
    with Workers(2) as workers:
        with pytest.raises(KeyboardInterrupt):
            call_all(statistics.fmean, ONES, workers=workers, progress=interrupt)
        assert all(child.returncode is not None for child in children)
        assert call_all(statistics.fmean, ONES, workers=workers) == [1.0] * 4
        assert len(children) == 4
    assert all(child.returncode is not None for child in children)


def test_calls_from_progress_do_not_get_between_those_that_are_at_work() -> None:
    within: list[list[float]] = []
    with Workers(2) as workers:

        def call_more(done: int) -> None:
            if done == 1:
                within.append(call_all(statistics.fmean, [{"data": [n]} for n in (7, 8)], workers=workers))

        assert call_all(statistics.fmean, ONES, workers=workers, progress=call_more) == [1.0] * 4
    assert within == [[7.0, 8.0]]


def test_workers_serve_within_their_block_only() -> None:
    with Workers(2) as workers:
        pass
    with refused("workers-closed"):
        call_all(statistics.fmean, ONES, workers=workers)
    assert call_all(statistics.fmean, ONES, workers=Workers(1)) == [1.0] * 4  # no process is needed


def test_exception_that_cannot_be_handed_back_keeps_its_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "faulty_calls.py").write_text(
        "class WornError(Exception):\n"
        "    def __init__(self, part, depth):\n"
        "        super().__init__(f'{part} is worn by {depth} mm')\n"
        "def worn(depth):\n"
        "    raise WornError('ball', depth)\n"
        "def opened(path):\n"
        "    return open(path)\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    import faulty_calls

    with Workers(2) as workers:
        with pytest.raises(ViscofricError, match="WornError: ball is worn by 2 mm"):  # of another library
            call_all(faulty_calls.worn, [{"depth": 2}, {"depth": 3}], workers=workers)
        with refused("not-picklable", naming="TextIOWrapper"):
            call_all(faulty_calls.opened, [{"path": os.devnull}] * 2, workers=workers)
        assert call_all(statistics.fmean, ONES, workers=workers) == [1.0] * 4


def test_result_that_cannot_be_restored_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "odd_results.py").write_text(
        "class Odd:\n    def __reduce__(self):\n        return divmod, (1, 0)\n", encoding="utf-8"
    )
    monkeypatch.syspath_prepend(tmp_path)
    from odd_results import Odd

    with refused("process-ended", ViscofricError):
        call_all(Odd, [{}] * 2, workers=2)


@pytest.mark.slow
def test_script_need_not_guard_its_first_lines(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(
        "import statistics\n"
        "from viscofric.processes import Workers, call_all\n"
        "with Workers(2) as workers:\n"
        "    for _ in range(2):\n"
        "        print(call_all(statistics.fmean, [{'data': [1.0]}, {'data': [2.0]}], workers=workers))\n"
    )
    path = os.pathsep.join(sys.path)
    said = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, check=True, env={**os.environ, "PYTHONPATH": path}
    )
    assert said.stdout == "[1.0, 2.0]\n" * 2


@pytest.mark.parametrize("workers", [0, -1, 1.5, True, "2"])
def test_senseless_numbers_of_workers_are_refused(workers: Any) -> None:
    with refused("not-a-whole-number"):
        call_all(statistics.fmean, [], workers=workers)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="processes that lost their parent keep it there")
def test_processes_end_with_the_one_that_started_them(tmp_path: Path) -> None:
    """Also where that is killed, and they are at work."""
    (tmp_path / "slow_calls.py").write_text("import time\ndef rest(seconds):\n    time.sleep(seconds)\n")
    (tmp_path / "script.py").write_text(
        "from slow_calls import rest\n"
        "from viscofric.processes import Workers, as_they_come\n"
        "with Workers(2) as workers:\n"
        "    for _, kind, _ in as_they_come(rest, [{'seconds': 100.0}] * 2, workers=workers):\n"
        "        print(kind, flush=True)\n"
    )
    program = subprocess.Popen(
        [sys.executable, tmp_path / "script.py"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert program.stdout is not None
    assert [program.stdout.readline() for _ in range(2)] == ["begun\n"] * 2
    program.kill()
    # All of them write to one standard error, which comes to its end with the last of them.
    _, said = program.communicate(timeout=60.0)
    assert said == ""


def test_what_calls_need_is_imported_before_the_first_of_them(
    children: list[subprocess.Popen[bytes]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = "import os, pathlib\npathlib.Path(os.environ['TOLD']).write_text('here')\n"
    (tmp_path / "needed_calls.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("TOLD", str(tmp_path / "told"))
    with Workers(2, needed="needed_calls") as workers:
        assert len(children) == 2
        assert call_all(statistics.fmean, ONES, workers=workers) == [1.0] * 4
        assert len(children) == 2
    assert (tmp_path / "told").read_text() == "here"
    with Workers(1, needed="needed_calls"):
        assert len(children) == 2


ROOM = 10**9  # bytes; Python with its modules takes a tenth


@pytest.fixture
def limited(children: list[subprocess.Popen[bytes]]) -> Any:
    process = LimitedProcess(seconds=30.0, memory=ROOM)
    yield process
    process.close()
    assert all(child.returncode is not None for child in children)


def test_calls_with_limits_share_one_process_that_stays(limited: LimitedProcess, children: list[Any]) -> None:
    assert limited.call(statistics.fmean, data=[1.0, 3.0]) == 2.0
    with pytest.raises(statistics.StatisticsError):
        limited.call(statistics.fmean, data=[])
    assert limited.call(os.getpid) == children[0].pid
    assert len(children) == 1


def test_a_call_beyond_its_time_is_ended(children: list[Any]) -> None:
    limited = LimitedProcess(seconds=0.5, memory=ROOM)
    before = time.monotonic()
    with pytest.raises(TimeoutError):
        limited.call(subprocess.check_call, args=[sys.executable, "-c", "import time; time.sleep(60)"])
    assert time.monotonic() - before < 10.0  # the limit, and what a busy machine adds
    assert children[0].returncode is not None


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems may have no limit of address space")
def test_a_call_beyond_its_memory_fails_and_the_next_one_works(limited: LimitedProcess, children: list[Any]) -> None:
    with pytest.raises(MemoryError):
        limited.call(repeated, times=3 * ROOM)
    with pytest.raises(MemoryError):  # as where a library ends its process
        limited.call(os._exit, status=1)
    assert limited.call(statistics.fmean, data=[1.0]) == 1.0
    assert len(children) == 3


def repeated(times: int) -> int:
    return len(b"a" * times)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks on this system")
@pytest.mark.filterwarnings("ignore:.*multi-threaded, use of fork:DeprecationWarning")
def test_a_fork_has_a_process_of_its_own(limited: LimitedProcess) -> None:
    first = limited.call(os.getpid)
    fork = os.fork()
    if fork == 0:
        own = limited.call(os.getpid)
        limited.close()
        os._exit(0 if own != first else 1)
    assert os.waitpid(fork, 0)[1] == 0
    assert limited.call(os.getpid) == first
