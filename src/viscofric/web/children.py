"""The processes that compute for the page: kept warm, handed jobs, cancelled, replaced when they end."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import threading
import time
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

from viscofric.processes import ONE_BLAS_THREAD, Child, Reply, message_of
from viscofric.web.jobs import KINDS, LATER, WARM, Kind

_ENDED = "The process that computed this ended, usually for lack of memory; request less accuracy or fewer points."
_NO_MEMORY = "There was not enough memory for this; request less accuracy or fewer points."
_PREPARING = 0  # number of the call in which a process loads what jobs need


def line(event: str, **more: Any) -> bytes:
    """Return a message of the server itself, as a line of JSON."""
    return json.dumps({"event": event, **more}).encode() + b"\n"


def _error(message: str, code: str) -> bytes:
    return line("error", message=message, code=code, field=None)


class JobProcess(Child):
    """A process that does jobs, as seen by the server."""

    def __init__(self) -> None:
        super().__init__(ONE_BLAS_THREAD, later=LATER, group=True)
        self.send(_PREPARING, message_of("viscofric.web.child:prepare", {"modules": WARM}))
        self.key: str | None = None  # of the workspace that it served last
        self.used = 0.0
        self.number = _PREPARING
        self.ready = False
        self.messages: asyncio.Queue[Reply] = asyncio.Queue()
        self._reader: threading.Thread | None = None

    def attach(self, loop: asyncio.AbstractEventLoop, is_ready: Callable[[], object]) -> None:
        """Begin to hand on its replies; call something once it has loaded what jobs need."""
        if self._reader is None:
            self._is_ready = is_ready
            self._reader = threading.Thread(target=self._read, args=(loop,), daemon=True)
            self._reader.start()

    def _read(self, loop: asyncio.AbstractEventLoop) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed
            for reply in self.replies():
                loop.call_soon_threadsafe(self._take, reply)

    def _take(self, reply: Reply) -> None:
        if reply.number == _PREPARING:
            self.ready = True
            self._is_ready()
        elif reply.number in (None, self.number):
            self.messages.put_nowait(reply)


MOST_CHILDREN = 4
_FROM_THE_BEGINNING = 2
_SOFT = 1.0  # s that a cancelled job has to end by itself
_LONGEST_START = 20.0  # s
_LONGEST_REST = 900.0  # s without a job, after which a process gives its memory back
_BEFORE_SPARE = 2.0  # s before another process is started in store: those that have work go first
_STOPPED = "The program was stopped."


class Children:
    """Processes that compute, at most `most` at once; further jobs wait for their turn."""

    def __init__(self, most: int = MOST_CHILDREN) -> None:
        self.most = most
        self._all: list[JobProcess] = []
        self._idle: list[JobProcess] = []
        self._waiting = 0
        self._turn = asyncio.Lock()  # of the job that waited longest
        self._one_is_free = asyncio.Event()
        self._numbers = itertools.count(1)
        self._cancelling: set[asyncio.Task[None]] = set()
        self._looking: asyncio.TimerHandle | None = None
        self._closed = False

    @property
    def running(self) -> int:
        """Jobs that are at work or wait."""
        return len(self._all) - len(self._idle) + self._waiting

    def start(self) -> None:
        """Start a process for the first job to find, if there is none (one loads at a time); needs no event loop."""
        if not self._closed and len(self._all) < self.most and all(child.ready for child in self._all if child.alive):
            child = JobProcess()
            self._all.append(child)
            self._idle.append(child)

    def attach(self) -> None:
        """Begin to hear from the processes; within the event loop."""
        for child in self._all:
            child.attach(asyncio.get_running_loop(), self._one_is_ready)

    def _one_is_ready(self) -> None:
        self._one_is_free.set()
        self._keep_spare()

    async def run(
        self, kind: str, study: dict[str, Any], options: dict[str, Any], folder: Path
    ) -> AsyncIterator[bytes]:
        """Have a job done in a workspace's folder; yield its messages, a JSON object a line; closing cancels it."""
        yield line("queued")
        if self._closed:
            yield _error(_STOPPED, "stopped")
            return
        self.attach()
        child = await self._lend(str(folder))
        number = child.number = next(self._numbers)
        child.messages = asyncio.Queue()
        finished, doing = False, KINDS[kind]
        latest = time.monotonic() + doing.seconds
        alarm = asyncio.get_running_loop().call_later(doing.seconds, child.kill)
        try:
            yield line("started", job=number)
            job = {"kind": doing, "study": study, "options": options, "folder": folder}
            order = message_of("viscofric.web.child:do", job, in_parts=True)
            sending = asyncio.get_running_loop().run_in_executor(None, child.send, number, order)
            await asyncio.shield(sending)  # a job that is cancelled must be sent all the same: its end is reported
            while not finished:
                reply = await child.messages.get()
                finished = reply.kind != "part"
                late = doing if time.monotonic() >= latest else None
                yield self._last_words(reply, late) if finished else reply.value
        finally:
            alarm.cancel()
            if finished:
                self._give_back(child)
            else:
                self._cancel(child)

    def _last_words(self, reply: Reply, late: Kind | None) -> bytes:
        if self._closed:
            return _error(_STOPPED, "stopped")
        if reply.kind == "result":
            return reply.value
        if reply.kind == "interrupted":
            return line("cancelled")
        if reply.kind == "error":  # the others, jobs put into words
            return _error(_NO_MEMORY, "no-memory")
        if late:
            words = f"This took longer than {late.seconds:.0f} s and was stopped"
            return _error(f"{words}; request less accuracy or fewer points.", "took-too-long")
        return _error(_ENDED, "process-ended")

    async def _lend(self, key: str) -> JobProcess:
        self._waiting += 1
        try:
            async with self._turn:
                while (child := self._free(key)) is None:
                    self._one_is_free.clear()
                    await self._one_is_free.wait()
        finally:
            self._waiting -= 1
        child.key, child.used = key, time.monotonic()
        asyncio.get_running_loop().call_later(_BEFORE_SPARE, self._keep_spare)
        return child

    def _free(self, key: str) -> JobProcess | None:
        """Take a process that has nothing to do: the one that served the workspace, a new one, or any."""
        for child in [child for child in self._idle if not child.alive]:
            self._idle.remove(child)
            self._bury(child)
        if not any(child.key in (key, None) for child in self._idle):
            self.start()
            self.attach()
        if not self._idle:
            return None
        child = min(self._idle, key=lambda one: (one.key != key, one.key is not None, one.used))
        self._idle.remove(child)
        return child

    def _give_back(self, child: JobProcess) -> None:
        child.used = time.monotonic()
        if self._looking is None:
            self._looking = asyncio.get_running_loop().call_later(_LONGEST_REST, self._end_resting)
        if child.alive and not self._closed:
            self._idle.append(child)
        else:
            self._bury(child)
        self._one_is_free.set()

    def _end_resting(self) -> None:
        """End processes that had nothing to do for long, but for as many as there are from the beginning."""
        self._looking = None
        for child in sorted(self._idle, key=lambda child: child.used):
            rested = child.key is not None and time.monotonic() - child.used >= _LONGEST_REST
            if rested and len(self._all) > _FROM_THE_BEGINNING:
                self._idle.remove(child)
                self._bury(child)
        if len(self._all) > _FROM_THE_BEGINNING:
            self._looking = asyncio.get_running_loop().call_later(_LONGEST_REST, self._end_resting)

    def _bury(self, child: JobProcess) -> None:
        child.close()
        self._all = [one for one in self._all if one is not child]

    def _keep_spare(self) -> None:
        """Have a process in store that nobody has used yet, so that the next job need not wait for one to start."""
        if len(self._all) < _FROM_THE_BEGINNING or not any(child.key is None for child in self._idle):
            self.start()
            self.attach()

    def interrupt(self, number: int, folder: Path) -> bool:
        """Interrupt a workspace's job, which may still send what it has found; return whether there is such a job."""
        busy = [one for one in self._all if one not in self._idle]
        at_work = [one for one in busy if (one.number, one.key) == (number, str(folder))]
        for child in at_work:
            asyncio.get_running_loop().run_in_executor(None, child.send, number, None)
        return bool(at_work)

    def _cancel(self, child: JobProcess) -> None:
        task = asyncio.get_running_loop().create_task(self._stop(child))
        self._cancelling.add(task)
        task.add_done_callback(self._cancelling.discard)

    async def _stop(self, child: JobProcess) -> None:
        """Have a process give up its job; end it if it does not."""
        try:
            asyncio.get_running_loop().run_in_executor(None, child.send, child.number, None)
            # one that is still loading replies once it has loaded
            async with asyncio.timeout(_SOFT if child.ready else _LONGEST_START):
                while (await child.messages.get()).kind == "part":
                    pass
        except TimeoutError:
            child.kill()
        finally:
            self._give_back(child)

    def stop(self) -> None:
        """End all processes; what they were at ends with a sentence."""
        self._closed = True
        if self._looking is not None:
            self._looking.cancel()
        for child in self._all:
            child.kill()

    def close(self) -> None:
        """End all processes and wait for their end."""
        self.stop()
        for child in self._all:
            child.close()
        self._all.clear()
        self._idle.clear()
