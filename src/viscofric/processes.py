"""Independent calls distributed over processes, with the same digits as in one process.

Starting a process takes most of a second, mainly for imports: `Workers` stay for several sets of calls.

The processes are plain children that read calls from their standard input. Unlike with `multiprocessing`, the user's
script needs no guard of its first lines, and a notebook need not be importable.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from types import TracebackType
from typing import Any, Self, TypeAlias

from viscofric.arguments import whole_number
from viscofric.errors import InputError, ViscofricError
from viscofric.threads import usable_threads

Child: TypeAlias = subprocess.Popen[bytes]


_SERVE = "from viscofric.serving import serve; serve({parent}, {needed!r}, {memory})"
_ENDED = "a process ended before its contact was solved, usually for lack of memory; use fewer workers."
# Waiting without a limit cannot be interrupted everywhere (Windows).
_LONGEST_WAIT = 1.0  # s


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
        try:
            while len(lent) < count:
                child = self._idle.pop() if self._idle else self._start()
                if child.poll() is None:
                    lent.append(child)
            yield lent
        except BaseException:
            for child in lent:
                end(child)
            raise
        self._idle += lent

    def _start(self) -> Child:
        assert self._started is not None
        child = started(self._needed, VISCOFRIC_FFT_THREADS=str(max(1, usable_threads() // self.number)))
        self._started.callback(end, child)
        return child


def started(needed: str, memory: int = 0, **environment: str) -> Child:
    """Start a process that serves calls; with a limit of its address space in bytes, unless it is zero."""
    program = _SERVE.format(parent=os.getpid(), needed=needed, memory=memory)
    path = os.pathsep.join(path for path in sys.path if path)
    with _interrupts_wait():
        return subprocess.Popen(
            # -P: modules in the working folder must not replace those of this process
            [sys.executable, "-P", "-c", program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # what libraries print as the memory of their process ends is said by the error of the call
            stderr=subprocess.DEVNULL if memory else None,
            env={**os.environ, **environment, "PYTHONPATH": path},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),  # no window under Windows
        )


def reply_of(child: Child, message: bytes) -> tuple[str, Any]:
    """Send a call to a process, and return the kind of its end and the value."""
    assert child.stdin is not None
    assert child.stdout is not None
    try:
        pickle.dump(message, child.stdin)
        child.stdin.flush()
        return pickle.loads(pickle.load(child.stdout))  # type: ignore[no-any-return]
    except (OSError, EOFError, ValueError, TypeError, AttributeError, ImportError, pickle.UnpicklingError):
        return "ended", ViscofricError(_ENDED, code="process-ended")


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
    if not isinstance(workers, Workers):
        with Workers(workers) as alone:
            return call_all(function, calls, workers=alone, progress=progress)
    count = min(workers.number, len(calls))
    if count <= 1:
        results = []
        for call in calls:
            results.append(function(**call))
            if progress is not None:
                progress(len(results))
        return results
    shared = _SharedCalls(function, calls, workers)
    found: dict[int, Any] = {}
    failures: dict[int, BaseException] = {}
    with workers._children(count) as children:
        for index, kind, value in shared.replies(children):
            if kind == "result":
                found[index] = value
                if progress is not None:
                    progress(len(found))
            elif kind == "error":
                failures[index] = value
    if failures:
        raise failures[min(failures)]
    return [found[index] for index in range(len(calls))]


def as_they_come(
    function: Callable[..., Any], calls: Sequence[dict[str, Any]], *, workers: Workers, tries: int = 3
) -> Generator[tuple[int, str, Any]]:
    """Yield index of the call, kind and value at the begin and the end of each call, see `call_all`.

    Kinds are ``"begun"``, ``"result"``, ``"error"`` (its exception) and ``"ended"`` (given up after `tries` processes
    ended during it; an exception that states this).  Unlike in `call_all`, an error of one call does not stop the
    others, and a process that ended is replaced by another, which repeats its call.  An interrupt, or closing the
    iterator, ends the processes at once.
    """
    count = min(workers.number, len(calls))
    if count <= 1:
        for index, call in enumerate(calls):
            yield index, "begun", None
            try:
                value = function(**call)
            except Exception as error:  # noqa: BLE001 - it is yielded
                yield index, "error", error
            else:
                yield index, "result", value
        return
    shared = _SharedCalls(function, calls, workers, tries=tries, stops=False)
    with workers._children(count) as children:
        yield from shared.replies(children)


class _SharedCalls:
    """Calls given to some processes one after the other, by one thread for each process.

    A call whose process ended is repeated by another one, until `tries` ended.  With `stops`, none is begun after
    one that failed.
    """

    def __init__(
        self,
        function: Callable[..., Any],
        calls: Sequence[dict[str, Any]],
        workers: Workers,
        tries: int = 1,
        stops: bool = True,
    ) -> None:
        name = f"{function.__module__}:{function.__qualname__}"
        try:
            self.messages = [pickle.dumps((name, call)) for call in calls]
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
        threads = [threading.Thread(target=self._keep_busy, args=(child,), daemon=True) for child in children]
        outstanding = len(self.messages)
        try:
            for thread in threads:
                thread.start()
            while outstanding and (any(thread.is_alive() for thread in threads) or not self.events.empty()):
                with contextlib.suppress(queue.Empty):
                    index, kind, value = self.events.get(timeout=_LONGEST_WAIT)
                    outstanding -= kind != "begun"
                    yield index, "error" if kind == "ended" and self.stops else kind, value
            if outstanding and not self.stops:
                raise ViscofricError(_ENDED, code="process-ended")
        finally:
            with self.lock:
                self.closed = True

    def _next(self) -> int | None:
        with self.lock:
            return self.waiting.popleft() if self.waiting and not self.closed else None

    def _keep_busy(self, child: Child | None) -> None:
        while child is not None and (index := self._next()) is not None:
            self.events.put((index, "begun", None))
            kind, value = self._ask(child, index)
            if kind == "ended":
                self.tries_left[index] -= 1
                child = self._replaced(child)
                if self.tries_left[index] and child is not None:
                    self.waiting.appendleft(index)
                    continue
            self._stop_after(kind)
            self.events.put((index, kind, value))

    def _stop_after(self, kind: str) -> None:
        if self.stops and kind != "result":
            with self.lock:
                self.waiting.clear()

    def _ask(self, child: Child, index: int) -> tuple[str, Any]:
        kind, value = reply_of(child, self.messages[index])
        if kind == "not understood":
            return "error", _not_sent(self.workers.number, value)
        return kind, value

    def _replaced(self, child: Child) -> Child | None:
        """Return another process in place of one that ended; None if none can be started or is needed."""
        child.kill()
        child.wait()
        with self.lock:
            if self.closed or self.stops:
                return None
            try:
                self.children[self.children.index(child)] = fresh = self.workers._start()
            except OSError:
                return None
            return fresh


def _not_sent(workers: int, reason: object) -> InputError:
    return InputError(
        f"workers = {workers}: the calls cannot be sent to another process ({reason}); use one worker.",
        code="not-picklable",
    )


def end(child: Child) -> None:
    """Kill a process, and wait for its end."""
    child.kill()
    child.wait()
    for pipe in (child.stdin, child.stdout):
        with contextlib.suppress(OSError):
            pipe.close()  # type: ignore[union-attr]
