"""The processes that compute for the page: kept warm, handed jobs, cancelled, replaced when they end."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any, NamedTuple

from viscofric.web.jobs import KINDS

_PROGRAM = "from viscofric.web.child import main; main({parent})"
_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_LONGEST_END = 1.0  # s that its last words may take
_ENDED = "The process that computed this ended, usually for lack of memory; request less accuracy or fewer points."


class Message(NamedTuple):
    """What a process says of a job: the event, and all of it as a line of JSON."""

    event: str
    line: bytes


def line(event: str, **more: Any) -> bytes:
    """Return a message of the server itself, as a line of JSON."""
    return json.dumps({"event": event, **more}).encode() + b"\n"


class Child:
    """A process that computes, as seen by the server."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            # -P: modules in the working folder must not stand in for those of this process
            [sys.executable, "-P", "-c", _PROGRAM.format(parent=os.getpid())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **_ONE_THREAD, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            start_new_session=True,  # an interrupt of the terminal is the server's business
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self.key: str | None = None  # of the workspace that it served last
        self.used = 0.0
        self.number = 0
        self.ready = False
        self.stays = True
        self.messages: asyncio.Queue[Message] = asyncio.Queue()
        self._reader: threading.Thread | None = None

    @property
    def alive(self) -> bool:
        """Whether it runs still, and stays."""
        return self.stays and self.process.poll() is None

    def attach(self, loop: asyncio.AbstractEventLoop, is_ready: Callable[[], object]) -> None:
        """Begin to hand on what it says; call something once it has loaded what jobs need."""
        if self._reader is None:
            self._is_ready = is_ready
            self._reader = threading.Thread(target=self._read, args=(loop,), daemon=True)
            self._reader.start()

    def _read(self, loop: asyncio.AbstractEventLoop) -> None:
        pipe = self.process.stdout
        assert pipe is not None
        with contextlib.suppress(OSError, ValueError, RuntimeError):  # RuntimeError: the loop is closed
            for head in pipe:
                number, event, stays, size = head.decode().split()
                self.stays = stays == "stays"
                loop.call_soon_threadsafe(self._take, int(number), Message(event, pipe.read(int(size))))
        self.kill()
        self.process.wait()
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(
                self._take, None, Message("ended", line("error", message=_ENDED, code="process-ended", field=None))
            )

    def _take(self, number: int | None, message: Message) -> None:
        if message.event == "ready":
            self.ready = True
            self._is_ready()
        elif number in (None, self.number):
            self.messages.put_nowait(message)

    def order(self, order: dict[str, Any]) -> None:
        """Send a job, or the wish to cancel one."""
        pipe = self.process.stdin
        assert pipe is not None
        with contextlib.suppress(OSError, ValueError):  # it ended, which its output shows
            pipe.write(json.dumps(order).encode() + b"\n")
            pipe.flush()

    def kill(self) -> None:
        """End it, and what it started, at once."""
        self.stays = False
        with contextlib.suppress(OSError):
            if sys.platform != "win32" and self.process.poll() is None:
                os.killpg(self.process.pid, signal.SIGKILL)
        with contextlib.suppress(OSError):
            self.process.kill()

    def close(self) -> None:
        """End it and wait for its end."""
        self.kill()
        self.process.wait()
        if self._reader is not None:
            self._reader.join(_LONGEST_END)
        for pipe in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError):
                pipe.close()  # type: ignore[union-attr]


MOST_CHILDREN = 4
_FROM_THE_BEGINNING = 2
_SOFT = 1.0  # s that a cancelled job has to end by itself
_LONGEST_START = 20.0  # s
_LONGEST_REST = 900.0  # s without a job, after which a process gives its memory back
_BEFORE_SPARE = 2.0  # s before another process is started in store: those that have work go first
_LAST = {"result", "error", "cancelled", "ended"}
_STOPPED = "The program was stopped."


class Children:
    """Processes that compute, at most `most` at once; further jobs wait for their turn."""

    def __init__(self, most: int = MOST_CHILDREN) -> None:
        self.most = most
        self._all: list[Child] = []
        self._idle: list[Child] = []
        self._waiting: deque[tuple[str, asyncio.Future[Child]]] = deque()
        self._numbers = itertools.count(1)
        self._cancelling: set[asyncio.Task[None]] = set()
        self._looking: asyncio.TimerHandle | None = None
        self._closed = False

    @property
    def running(self) -> int:
        """Jobs that are at work or wait."""
        return len(self._all) - len(self._idle) + len(self._waiting)

    def start(self) -> None:
        """Start a process for the first job to find, if there is none (one loads at a time); needs no event loop."""
        if not self._closed and len(self._all) < self.most and all(child.ready for child in self._all if child.alive):
            child = Child()
            self._all.append(child)
            self._idle.append(child)

    def attach(self) -> None:
        """Begin to hear from the processes; within the event loop."""
        for child in self._all:
            child.attach(asyncio.get_running_loop(), self._one_is_ready)

    def _one_is_ready(self) -> None:
        self._serve_waiting()
        self._keep_spare()

    async def run(
        self, kind: str, study: dict[str, Any], options: dict[str, Any], folder: Path
    ) -> AsyncIterator[bytes]:
        """Have a job done in a workspace's folder; yield its messages, a JSON object a line; closing cancels it."""
        yield line("queued")
        if self._closed:
            yield line("error", message=_STOPPED, code="stopped", field=None)
            return
        self.attach()
        child = await self._lend(str(folder))
        number = child.number = next(self._numbers)
        child.messages = asyncio.Queue()
        finished = False
        try:
            yield line("started", job=number)
            doing = KINDS[kind]
            order = {
                "job": number,
                "module": doing.module,
                "memory": doing.memory,
                "study": study,
                "options": options,
                "folder": str(folder),
            }
            sending = asyncio.get_running_loop().run_in_executor(None, child.order, order)
            async for message in _until(child, sending, doing.seconds):
                finished = message.event in _LAST
                yield self._last_words(message) if finished else message.line
        finally:
            if finished:
                self._give_back(child)
            else:
                self._cancel(child)

    def _last_words(self, message: Message) -> bytes:
        return line("error", message=_STOPPED, code="stopped", field=None) if self._closed else message.line

    async def _lend(self, key: str) -> Child:
        child = None if self._waiting else self._free(key)
        if child is None:
            place: asyncio.Future[Child] = asyncio.get_running_loop().create_future()
            self._waiting.append((key, place))
            try:
                child = await place
            except asyncio.CancelledError:
                if place.done() and not place.cancelled():
                    self._give_back(place.result())
                else:
                    self._waiting = deque(one for one in self._waiting if one[1] is not place)
                raise
        child.key, child.used = key, time.monotonic()
        asyncio.get_running_loop().call_later(_BEFORE_SPARE, self._keep_spare)
        return child

    def _free(self, key: str) -> Child | None:
        """Take a process that has nothing to do: the one that served the workspace, a new one, or any."""
        for child in [child for child in self._idle if not child.alive]:
            self._idle.remove(child)
            self._bury(child)
        known = [child for child in self._idle if child.key == key] or [
            child for child in self._idle if child.key is None
        ]
        if not known:
            self.start()
            self.attach()
            known = [child for child in self._idle if child.key is None]
        if not known:
            known = sorted(self._idle, key=lambda child: child.used)
        if not known:
            return None
        child = known[0]
        self._idle.remove(child)
        return child

    def _give_back(self, child: Child) -> None:
        child.used = time.monotonic()
        if self._looking is None:
            self._looking = asyncio.get_running_loop().call_later(_LONGEST_REST, self._end_resting)
        if child.alive and not self._closed:
            self._idle.append(child)
        else:
            self._bury(child)
        self._serve_waiting()

    def _serve_waiting(self) -> None:
        while self._waiting and (free := self._free(self._waiting[0][0])) is not None:
            _, place = self._waiting.popleft()
            if place.done():
                self._give_back(free)
            else:
                place.set_result(free)

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

    def _bury(self, child: Child) -> None:
        child.close()
        self._all = [one for one in self._all if one is not child]

    def _keep_spare(self) -> None:
        """Have a process in store that nobody has used yet, so that the next job need not wait for one to start."""
        if len(self._all) < _FROM_THE_BEGINNING or not any(child.key is None for child in self._idle):
            self.start()
            self.attach()

    def interrupt(self, number: int, folder: Path) -> bool:
        """Interrupt a workspace's job, which may still send what it has found; return whether there is such a job."""
        at_work = [
            one for one in self._all if one.number == number and one.key == str(folder) and one not in self._idle
        ]
        for child in at_work:
            asyncio.get_running_loop().run_in_executor(None, child.order, {"cancel": number})
        return bool(at_work)

    def _cancel(self, child: Child) -> None:
        task = asyncio.get_running_loop().create_task(self._stop(child))
        self._cancelling.add(task)
        task.add_done_callback(self._cancelling.discard)

    async def _stop(self, child: Child) -> None:
        """Have a process give up its job; end it if it does not."""
        try:
            asyncio.get_running_loop().run_in_executor(None, child.order, {"cancel": child.number})
            # one that is still loading replies once it has loaded
            async with asyncio.timeout(_SOFT if child.ready else _LONGEST_START):
                while (await child.messages.get()).event not in _LAST:
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


async def _until(child: Child, sending: asyncio.Future[None], seconds: float) -> AsyncIterator[Message]:
    """Yield what a process says of its job, to the end of that or of the time for it."""
    end = asyncio.get_running_loop().time() + seconds
    await asyncio.shield(sending)  # a job that is cancelled must be sent all the same, so that its end is reported
    while True:
        try:
            async with asyncio.timeout_at(end):
                message = await child.messages.get()
        except TimeoutError:
            child.kill()
            words = f"This took longer than {seconds:.0f} s and was stopped; request less accuracy or fewer points."
            yield Message("ended", line("error", message=words, code="took-too-long", field=None))
            return
        yield message
        if message.event in _LAST:
            return
