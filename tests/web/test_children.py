"""Processes that compute for the page: told of, cancelled, bounded, replaced, and never left behind."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import time
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import aclosing, contextmanager
from pathlib import Path
from typing import Any

import pytest

from viscofric.web import children as module
from viscofric.web.children import Children
from viscofric.web.jobs import Kind
from web.own_loop import run_apart
from web.processes_left import alive, ended, started_by

MB = 2**20
LONG = 20.0  # s, on a machine that does other work; what is waited for takes two at most on one that does not


@pytest.fixture(autouse=True)
def odd_jobs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(module.KINDS, "odd", Kind("web.odd_jobs", seconds=60.0, memory=2048 * MB))
    monkeypatch.setitem(module.KINDS, "short", Kind("web.odd_jobs", seconds=0.5))
    monkeypatch.setitem(module.KINDS, "narrow", Kind("web.odd_jobs", memory=1024 * MB))
    # without what contacts need, which takes most of a second to load
    monkeypatch.setattr(module, "WARM", ())
    (tmp_path / "a" / "downloads").mkdir(parents=True)


class Bench:
    """Processes, asked as the page would ask them."""

    def __init__(self, children: Children, folder: Path) -> None:
        self.children, self.folder = children, folder

    def run(self, do: str, amount: float = 0.0, kind: str = "odd", key: str = "a") -> AsyncIterator[bytes]:
        options = {"do": do, "amount": amount}
        return self.children.run(kind, {}, options, self.folder / key)

    async def all(self, *arguments: Any, **more: Any) -> list[dict[str, Any]]:
        return [json.loads(line) async for line in self.run(*arguments, **more)]

    async def last(self, *arguments: Any, **more: Any) -> dict[str, Any]:
        return (await self.all(*arguments, **more))[-1]

    async def cancelled(self, *arguments: Any, after: float = 0.1, **more: Any) -> int:
        """Begin a job and let go of it; return the process that had it."""
        async with aclosing(self.run(*arguments, **more)) as lines:
            async for line in lines:
                reported = json.loads(line)
                if reported["event"] == "part":
                    await asyncio.sleep(after)
                    return int(reported["part"]["process"])
        raise AssertionError("the job did not begin")

    async def idle(self, within: float) -> float:
        """Wait until no job is at work; return how long that took."""
        begun = time.monotonic()
        while self.children.running:
            assert time.monotonic() - begun < within
            await asyncio.sleep(0.01)
        return time.monotonic() - begun


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Callable[..., Any]]:
    """Run something with processes at hand; none is left afterwards."""

    @contextmanager
    def closed(children: Children) -> Iterator[Children]:
        try:
            yield children
        finally:
            children.close()

    def run(work: Callable[[Bench], Awaitable[Any]], most: int = 1) -> Any:
        async def all_of_it() -> Any:
            with closed(Children(most)) as children:
                children.start()
                return await work(Bench(children, tmp_path))

        return run_apart(all_of_it())

    yield run
    assert ended(started_by(os.getpid(), "viscofric.serving"), within=LONG)


def test_job_is_queued_started_reported_and_answered(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        reported = await bench.all("report", 10)
        assert [one["event"] for one in reported[:3]] == ["queued", "started", "part"]
        expected = {"text": "x" * 10, "not a number": None, "numbers": [1, 2.5]}
        assert reported[-1]["result"] == {**expected, "note": "sweeps.csv, line 3"}  # as the user named the file
        progress = [one for one in reported if one["event"] == "progress"]
        assert progress[0] == {"event": "progress", "done": 0, "total": 1_000, "label": "0"}
        assert len(progress) < 100  # of a thousand: a browser could not show more

    bench(work)


@pytest.mark.parametrize(("do", "last"), [("keep", "result"), ("rest", "cancelled")])
def test_a_stopped_job_sends_what_it_has_found(bench: Callable[..., Any], do: str, last: str) -> None:
    async def work(bench: Bench) -> None:
        number, found = 0, {}
        async for line in bench.run(do, LONG):
            found = json.loads(line)
            number = found.get("job", number)
            if found["event"] == "part":
                assert not bench.children.interrupt(number + 1, bench.folder / "a")
                assert not bench.children.interrupt(number, bench.folder / "b")  # of another tab
                assert bench.children.interrupt(number, bench.folder / "a")
        assert found == {"event": last, **({"result": {"kept": True}} if last == "result" else {})}
        assert not bench.children.interrupt(number, bench.folder / "a")  # it has ended
        assert (await bench.last("rest"))["event"] == "result"  # its process goes on

    bench(work)


def test_what_goes_wrong_is_one_sentence_and_the_next_job_is_done(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        refused = await bench.last("refuse")
        assert bench.folder.name not in refused["message"]  # no place on this machine
        assert refused["field"] == "conditions.load"
        failed = await bench.last("fail")
        assert failed["code"] == "internal-error"
        assert "KeyError" in failed["message"]
        leaked = await bench.last("leak")
        assert leaked["code"] == "internal-error"
        assert str(bench.folder) not in leaked["message"]
        assert "'cache/kept and sweeps.csv are odd'" in leaked["message"]
        died = await bench.last("die")
        assert died["code"] == "process-ended"
        unknown = await bench.last("nothing")
        assert unknown["field"] == "options.do"
        assert (await bench.last("rest"))["event"] == "result"

    bench(work)


def test_no_job_is_begun_with_files_that_are_not_the_pages(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        for table, key, name in [("surface", "file", "..\\x"), ("measurement", "mtm", "/x"), ("material", "dma", "**")]:
            lines = bench.children.run("odd", {table: {key: name}}, {"do": "rest"}, bench.folder / "a")
            reported = [json.loads(line) async for line in lines]
            assert [one["event"] for one in reported] == ["queued", "started", "error"]
            assert reported[-1]["field"] == f"{table}.{key}"

    bench(work)


def test_job_gets_neither_the_servers_input_nor_its_output(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        assert (await bench.last("print"))["result"] == {"read": None}

    bench(work)


def test_memory_time_files_and_answers_have_bounds(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        assert (await bench.last("grow", 1100 * MB, kind="narrow"))["code"] == "no-memory"
        begun = time.monotonic()
        reported = await bench.all("rest", 30.0, kind="short")
        assert reported[-1]["code"] == "took-too-long"
        assert time.monotonic() - begun < LONG
        assert ended([one["part"]["process"] for one in reported if one["event"] == "part"], within=LONG)
        assert "File too large" in (await bench.last("write", 201))["message"]
        assert (await bench.last("report", 60e6))["code"] == "too-large"
        assert (await bench.last("grow", 100 * MB, kind="narrow"))["event"] == "result"

    bench(work)


def test_cancelled_job_frees_its_process_for_the_next(
    bench: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_SOFT", 25.0)  # on a busy machine, too, it is not ended but interrupted

    async def work(bench: Bench) -> None:
        process = await bench.cancelled("rest", 60.0)
        await bench.idle(within=LONG)  # far below what it would have rested
        assert (await bench.last("rest"))["result"]["process"] == process

    bench(work)


def test_job_cancelled_while_it_imports_ends_its_process(
    bench: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A module that was imported by half, such as pandas, fails whoever imports it next."""
    monkeypatch.setattr(module, "_SOFT", 25.0)  # it is interrupted in time, and ends by itself

    async def work(bench: Bench) -> None:
        process = await bench.cancelled("load", after=0.5)
        await bench.idle(within=LONG)
        assert ended([process], within=LONG)
        assert (await bench.last("rest"))["result"]["process"] != process

    bench(work)


@pytest.mark.apart
def test_job_that_does_not_let_itself_be_cancelled_is_ended(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        for do, amount in [("insist", 50.0), ("hold", 2e9)]:
            process = await bench.cancelled(do, amount)
            await bench.idle(within=LONG)
            assert ended([process], within=LONG)
        assert (await bench.last("rest"))["event"] == "result"

    bench(work)


def test_big_solve_is_cancelled(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        await bench.cancelled("solve", 1_000, after=1.0)
        await bench.idle(within=LONG)
        assert (await bench.last("rest"))["event"] == "result"

    bench(work)


def test_more_jobs_than_processes_wait_for_their_turn(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        finished: deque[int] = deque()

        async def one(number: int) -> dict[str, Any]:
            last = await bench.last("rest", 0.2, key=f"tab {number}")
            finished.append(number)
            return last

        found = await asyncio.gather(*map(one, range(5)))
        assert {one["event"] for one in found} == {"result"}
        assert len({one["result"]["process"] for one in found}) == 2
        assert set(finished) == set(range(5))
        # one that waits gives its place up when it is let go of
        long = asyncio.create_task(bench.last("rest", 0.5)), asyncio.create_task(bench.last("rest", 0.5))
        await asyncio.sleep(0.1)
        waiting = asyncio.create_task(bench.last("rest", 0.0))
        await asyncio.sleep(0.1)
        assert bench.children.running == 3
        waiting.cancel()
        await asyncio.wait([waiting])
        assert bench.children.running == 2
        await asyncio.gather(*long)
        await bench.idle(within=LONG)

    bench(work, most=2)


def test_workspace_comes_back_to_the_process_that_served_it(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        both = [bench.last("rest", 0.2, key=key) for key in "ab"]
        a, b = [one["result"]["process"] for one in await asyncio.gather(*both)]
        assert a != b
        for key, process in [("b", b), ("a", a), ("b", b)]:
            assert (await bench.last("rest", key=key))["result"]["process"] == process

    bench(work, most=2)


@pytest.mark.apart
def test_processes_without_work_are_ended_after_a_while(
    bench: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_LONGEST_REST", 0.5)

    async def work(bench: Bench) -> None:
        used = await asyncio.gather(*(bench.last("rest", 4.0, key=key) for key in "abcd"))
        processes = {one["result"]["process"] for one in used}
        assert len(processes) == 4
        long = asyncio.create_task(bench.last("rest", 2.5, key="a"))  # one that has work stays
        end = time.monotonic() + 10.0
        while len(bench.children._all) > 2:  # as many as from the beginning
            assert time.monotonic() < end
            await asyncio.sleep(0.05)
        assert sum(map(alive, processes)) <= 2
        assert (await long)["event"] == "result"
        assert (await bench.last("rest"))["event"] == "result"

    bench(work, most=4)


def test_end_of_the_server_ends_jobs_with_a_sentence(bench: Callable[..., Any]) -> None:
    async def work(bench: Bench) -> None:
        job = asyncio.create_task(bench.last("insist", 30.0))
        await asyncio.sleep(0.4)
        bench.children.stop()
        assert (await asyncio.wait_for(job, LONG))["code"] == "stopped"
        assert (await bench.last("rest"))["code"] == "stopped"

    bench(work)


@pytest.mark.parametrize("how", ["killed", "input closed"])
def test_a_process_ends_with_those_that_it_started(bench: Callable[..., Any], how: str) -> None:
    async def work(bench: Bench) -> None:
        async with aclosing(bench.run("share", 30.0)) as lines:
            async for line in lines:
                reported = json.loads(line)
                if reported["event"] == "part":
                    break
            process = reported["part"]["process"]
            while len(started_by(process)) < 2:
                await asyncio.sleep(0.02)
            own = started_by(process)
            assert os.getpgid(process) == process  # an interrupt of the terminal does not reach it
            if how == "killed":
                os.kill(process, signal.SIGKILL)
            else:
                (child,) = (one for one in bench.children._all if one.process.pid == process)
                child.process.stdin.close()  # type: ignore[union-attr]
            assert [json.loads(line)["event"] async for line in lines] == ["error"]
        assert ended([process, *own], within=LONG)

    bench(work)
