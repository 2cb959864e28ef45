"""Processes that carry out calls: several that share a set of calls, or one with limits of time and memory.

A `Child` is such a process, and `viscofric.serving` its other end.  Starting one takes most of a second, mainly for
imports: `Workers` stay for several sets of calls, with the same digits as in one process, and a `LimitedProcess` for
calls that may never end; those of the page are in `viscofric.web.children`.

The processes are plain children that read calls from their standard input. Unlike with `multiprocessing`, the user's
script needs no guard of its first lines, and a notebook need not be importable.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from types import TracebackType
from typing import Any, NamedTuple, Self

from viscofric.arguments import whole_number
from viscofric.errors import InputError, ViscofricError
from viscofric.threads import THREADS_VARIABLE, usable_threads

_SERVE = "from viscofric.serving import serve; serve({parent}, {needed!r}, {later!r}, {memory})"
_ENDED = "a process ended before its contact was solved, usually for lack of memory; use fewer workers."
#: Environment of a process whose BLAS has one thread.
ONE_BLAS_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
# Waiting without a limit cannot be interrupted everywhere (Windows).
_LONGEST_WAIT = 1.0  # s
#: Processes that may end during a call of `as_they_come`.
_TRIES = 3


class Reply(NamedTuple):
    """What a process says of a call."""

    number: int | None  # of the call; None where the process ended
    #: ``"part"`` before the end of the call, ``"result"``, ``"error"``, ``"interrupted"``, ``"ended"``, or ``"unfit"``
    #: where the call or its result cannot be sent
    kind: str
    value: bytes  # pickled, unless the call sends parts; of an error, the exception


def message_of(function: Callable[..., Any] | str, call: dict[str, Any], in_parts: bool = False) -> bytes:
    """Return a call as a process gets it.

    The function, or its ``"module:name"``, is importable.  With `in_parts` it also gets an argument ``send``, a
    function that sends a part of the result; what it sends and returns is then bytes, which are not pickled.
    """
    name = function if isinstance(function, str) else f"{function.__module__}:{function.__qualname__}"
    return pickle.dumps((name, call, in_parts))


class Child:
    """A process that carries out calls, one at a time.

    It imports the module `needed` at once and those of `later` while it is idle.  `memory` limits its
    address space in bytes, unless it is zero.  With `group`, what it started ends with it.
    """

    def __init__(
        self,
        environment: Mapping[str, str],
        needed: str = "",
        later: Sequence[str] = (),
        memory: int = 0,
        group: bool = False,
    ) -> None:
        program = _SERVE.format(parent=os.getpid(), needed=needed, later=later, memory=memory)
        path = os.pathsep.join(path for path in sys.path if path)
        with _interrupts_wait():
            self.process = subprocess.Popen(
                # -P: modules in the working folder must not replace those of this process
                [sys.executable, "-P", "-c", program],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                # what libraries print as the memory of their process ends is said by the error of the call
                stderr=subprocess.DEVNULL if memory else None,
                env={**os.environ, **environment, "PYTHONPATH": path},
                start_new_session=group,
                creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),  # no window under Windows
            )
        self._group = group
        self.stays = True

    @property
    def alive(self) -> bool:
        """Whether it still runs and can be used further."""
        return self.stays and self.process.poll() is None

    def send(self, number: int, message: bytes | None) -> None:
        """Send a call, or None to interrupt it; if the process ended, its replies say so."""
        assert self.process.stdin is not None
        with contextlib.suppress(OSError, ValueError):
            self.process.stdin.write(pickle.dumps((number, message)))
            self.process.stdin.flush()

    def replies(self) -> Iterator[Reply]:
        """Yield its replies until it ended."""
        assert self.process.stdout is not None
        with contextlib.suppress(OSError, ValueError):
            for head in self.process.stdout:
                number, kind, stays, size = head.decode().split()
                value = self.process.stdout.read(int(size))
                if len(value) < int(size):
                    break
                self.stays = self.stays and stays == "stays"
                yield Reply(int(number), kind, value)
        self.kill()
        self.process.wait()
        yield Reply(None, "ended", b"")

    def call(self, message: bytes) -> tuple[str, Any]:
        """Have it carry out a call, wait for the end of it, and return the kind of that and the value or exception."""
        self.send(0, message)
        _, kind, value = next(self.replies())
        with contextlib.suppress(Exception):  # nothing where it ended; restoring a result may raise anything
            return kind, pickle.loads(value)
        self.kill()
        return "ended", ViscofricError(_ENDED, code="process-ended")

    def kill(self) -> None:
        """End it at once."""
        self.stays = False
        with contextlib.suppress(OSError):
            if self._group and sys.platform != "win32" and self.process.poll() is None:
                os.killpg(self.process.pid, signal.SIGKILL)
        with contextlib.suppress(OSError):
            self.process.kill()

    def close(self) -> None:
        """End it, and wait for its end."""
        self.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError):
                pipe.close()  # type: ignore[union-attr]


@contextlib.contextmanager
def _interrupts_wait() -> Iterator[None]:
    """Delay an interrupt, and hide it from a process that is being started: only this process handles it.

    A terminal sends it to all of them, including those that cannot ignore it yet.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Workers:
    """Processes that share one set of calls after another, until the end of a ``with`` block.

    They are usually started for their first calls; `call_all` and its callers accept them in place of a number.

    With one, everything is done in this process.  If the calls need a module (`needed`), processes are started at the
    beginning of the block and import it while this process prepares the calls.  Processes that ended or were
    interrupted are restarted for the next calls.  While they are busy, further calls, from another thread or from
    `progress`, get further processes.

    Examples
    --------
    >>> from statistics import fmean
    >>> with Workers(2) as workers:
    ...     halves = call_all(fmean, [{"data": [0, 1]}, {"data": [1, 2]}], workers=workers)
    ...     call_all(fmean, [{"data": [0, half]} for half in halves], workers=workers)
    [0.25, 0.75]
    """

    def __init__(self, number: int, needed: str = "") -> None:
        whole_number(number, "workers", 1, right="a whole number of processes above zero, such as 2")
        self.number, self._needed = number, needed
        self._idle: list[Child] = []
        self._started: contextlib.ExitStack | None = None

    def __enter__(self) -> Self:
        self._started = contextlib.ExitStack()
        if self._needed and self.number > 1:
            try:
                while len(self._idle) < self.number:
                    self._idle.append(self._start())
            except BaseException as error:
                self.__exit__(type(error), error, None)
                raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        started, self._started = self._started, None
        self._idle.clear()
        if started is not None:
            started.close()

    @contextlib.contextmanager
    def _children(self, count: int) -> Iterator[list[Child]]:
        """Lend processes; an exception ends them, since they may still be busy."""
        if self._started is None:
            raise InputError(
                "workers: must be used within their block, with Workers(2) as workers: ...", code="workers-closed"
            )
        lent: list[Child] = []
        at_rest = False
        try:
            while len(lent) < count:
                child = self._idle.pop() if self._idle else self._start()
                if child.alive:
                    lent.append(child)
            yield lent
            at_rest = True
        finally:
            for child in lent:
                if at_rest and child.alive:
                    self._idle.append(child)
                else:
                    child.close()

    def _start(self) -> Child:
        assert self._started is not None
        child = Child({THREADS_VARIABLE: str(max(1, usable_threads() // self.number))}, self._needed)
        self._started.callback(child.close)
        return child


def at_work(workers: int | Workers) -> contextlib.AbstractContextManager[Workers]:
    """Return processes for a ``with`` block: those given, which are kept after it, or so many for the block alone."""
    return contextlib.nullcontext(workers) if isinstance(workers, Workers) else Workers(workers)


def call_all(
    function: Callable[..., Any],
    calls: Sequence[dict[str, Any]],
    *,
    workers: int | Workers = 1,
    progress: Callable[[int], object] | None = None,
) -> list[Any]:
    """Call a function with each of several sets of keyword arguments, and return the results in their order.

    With more than one worker, the function is importable by its name and the arguments can be pickled; `progress` is
    called in this process with the number of finished calls.  Of the errors of several calls the first in order is
    raised, and no further calls are begun.  An interrupt ends the processes at once.
    """
    found: dict[int, Any] = {}
    failures: dict[int, BaseException] = {}
    with (
        at_work(workers) as processes,
        contextlib.closing(_replies(function, calls, processes, tries=1, stops=True)) as replies,
    ):
        for index, kind, value in replies:
            if kind == "result":
                found[index] = value
                if progress is not None:
                    progress(len(found))
            elif kind != "begun":
                failures[index] = value
    if failures:
        raise failures[min(failures)]
    return [found[index] for index in range(len(calls))]


def counted_from(before: int, report: Callable[[int], object]) -> Callable[[int], None]:
    """Return what reports a number of finished calls after as many `before` them."""

    def add(done: int) -> None:
        report(before + done)

    return add


def as_they_come(
    function: Callable[..., Any], calls: Sequence[dict[str, Any]], *, workers: Workers
) -> Generator[tuple[int, str, Any]]:
    """Yield index of the call, kind and value at the begin and the end of each call, see `call_all`.

    Kinds are ``"begun"``, ``"result"``, ``"error"`` (its exception) and ``"ended"`` (given up after three processes
    ended during it; an exception that states this).  Unlike in `call_all`, an error of one call does not stop the
    others, and a process that ended is replaced by another, which repeats its call.  An interrupt, or closing the
    iterator, ends the processes at once.
    """
    return _replies(function, calls, workers, _TRIES, stops=False)


def _replies(
    function: Callable[..., Any], calls: Sequence[dict[str, Any]], workers: Workers, tries: int, stops: bool
) -> Generator[tuple[int, str, Any]]:
    """Yield begin and end of calls, see `as_they_come`; with `stops`, none is begun after one that failed."""
    count = min(workers.number, len(calls))
    if count > 1:
        shared = _SharedCalls(function, calls, workers, tries, stops)
        with workers._children(count) as children:
            yield from shared.replies(children)
        return
    for index, call in enumerate(calls):
        yield index, "begun", None
        try:
            value = function(**call)
        except Exception as error:  # noqa: BLE001 - it is yielded
            yield index, "error", error
            if stops:
                return
        else:
            yield index, "result", value


class _SharedCalls:
    """Calls given to some processes one after the other, by one thread for each process."""

    def __init__(
        self, function: Callable[..., Any], calls: Sequence[dict[str, Any]], workers: Workers, tries: int, stops: bool
    ) -> None:
        try:
            self.messages = [message_of(function, call) for call in calls]
        except (pickle.PicklingError, AttributeError, TypeError) as error:
            raise _not_sent(workers.number, error) from None
        self.workers, self.stops = workers, stops
        self.events: queue.SimpleQueue[tuple[int, str, Any]] = queue.SimpleQueue()
        self.waiting = deque(range(len(calls)))
        self.tries_left = [tries] * len(calls)
        self.lock = threading.Lock()
        self.closed = False

    def replies(self, children: list[Child]) -> Iterator[tuple[int, str, Any]]:
        """Yield begin and end of the calls, until no process is busy any more."""
        self.children = children
        threads = [threading.Thread(target=self._keep_busy, args=(n,), daemon=True) for n in range(len(children))]
        outstanding = len(self.messages)
        try:
            for thread in threads:
                thread.start()
            while outstanding and (any(thread.is_alive() for thread in threads) or not self.events.empty()):
                with contextlib.suppress(queue.Empty):
                    index, kind, value = self.events.get(timeout=_LONGEST_WAIT)
                    outstanding -= kind != "begun"
                    yield index, kind, value
            if self.waiting:
                raise ViscofricError(_ENDED, code="process-ended")
        finally:
            with self.lock:
                self.closed = True

    def _next(self, place: int) -> int | None:
        """Take a call for a process, which is replaced if it ended; None if there is no call or no process."""
        with self.lock:
            if not self.waiting or self.closed:
                return None
            if not self.children[place].alive:
                self.children[place].close()
                try:
                    self.children[place] = self.workers._start()
                except OSError:
                    return None
            return self.waiting.popleft()

    def _keep_busy(self, place: int) -> None:
        while (index := self._next(place)) is not None:
            self.events.put((index, "begun", None))
            kind, value = self.children[place].call(self.messages[index])
            if kind == "unfit":
                value = _not_sent(self.workers.number, value)
            if kind in ("unfit", "interrupted"):
                kind = "error"
            with self.lock:
                self.tries_left[index] -= kind == "ended"
                if kind == "ended" and self.tries_left[index]:
                    self.waiting.appendleft(index)
                    continue
                if self.stops and kind != "result":
                    self.waiting.clear()
            self.events.put((index, kind, value))


def _not_sent(workers: int, reason: object) -> InputError:
    return InputError(
        f"workers = {workers}: the calls cannot be sent to another process ({reason}); use one worker.",
        code="not-picklable",
    )


class LimitedProcess:
    """A process for calls that may never end or fill the memory; it starts with the first call and is kept.

    A call has limits of time in `seconds` and, if the system has it (Windows has not), of `memory` in bytes of address
    space; the module `needed` is imported when the process starts.  Calls from several threads each get their own
    process; one of these is kept.
    """

    def __init__(self, seconds: float, memory: int, needed: str = "") -> None:
        self.seconds, self.memory, self.needed = seconds, memory, needed
        self._idle: deque[Child] = deque(maxlen=1)
        self._owner = 0

    def call(self, function: Callable[..., Any], **arguments: Any) -> Any:
        """Call a function, which is importable by its name, with arguments that can be pickled.

        Raises TimeoutError beyond the limit of time; MemoryError beyond that of memory, or if the process ends for
        another reason; OSError if it cannot be started; and what the call raises.
        """
        message = message_of(function, arguments)
        # of several threads, each takes address space
        child = self._free() or Child(ONE_BLAS_THREAD, self.needed, memory=self.memory)
        latest = time.monotonic() + self.seconds
        alarm = threading.Timer(self.seconds, child.kill)
        alarm.daemon = True
        alarm.start()
        try:
            kind, value = child.call(message)
        except BaseException:
            child.close()
            raise
        finally:
            alarm.cancel()
        if not child.stays:
            child.close()
            raise TimeoutError if time.monotonic() >= latest else MemoryError
        self._keep(child)
        if kind != "result":
            raise InputError(value, code="not-picklable") if kind == "unfit" else value
        return value

    def _free(self) -> Child | None:
        if self._owner != os.getpid():  # a fork must not use the process of its parent
            for child in self._idle:
                child.process.returncode = 0
            self._idle.clear()
            self._owner = os.getpid()
            atexit.register(self.close)
        with contextlib.suppress(IndexError):
            child = self._idle.pop()
            if child.alive:
                return child
        return None

    def _keep(self, child: Child) -> None:
        if self._idle:
            child.close()
        else:
            self._idle.append(child)

    def close(self) -> None:
        """End the idle process."""
        while self._idle:
            self._idle.pop().close()
