"""Independent calls shared out among processes, which give the same digits as one process would.

Starting a process takes most of a second, importing above all: `Workers` live on from one set of calls to the next.

The processes are plain children that read calls from their standard input, so that, unlike with `multiprocessing`, the
user's script need not guard its first lines against being run again, nor a notebook be importable.
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
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeAlias

from viscofric.errors import InputError, ViscofricError, brief

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from types import TracebackType
    from typing import Self

    Child: TypeAlias = subprocess.Popen[bytes]

_SERVE = "from viscofric.processes import serve; serve()"
_ENDED = "a process ended before its contact was solved, for want of memory as a rule; use fewer workers."
# Waiting without an end cannot be interrupted everywhere (Windows).
_LONGEST_WAIT = 1.0  # s


class Workers:
    """Processes that share out one set of calls after another among them, until the end of a ``with`` block.

    They are started when there are first calls for them; `call_all` and what rests on it take them for a number.

    Parameters
    ----------
    number : int
        Processes.  One: everything is done in this one.

    Raises
    ------
    InputError
        If the number is not a whole one above zero.

    Notes
    -----
    Processes that ended or were interrupted are started anew for the next calls.  While they are at work, further
    calls, from another thread or from `progress`, get further processes.

    Examples
    --------
    >>> from statistics import fmean
    >>> with Workers(2) as workers:
    ...     halves = call_all(fmean, [{"data": [0, 1]}, {"data": [1, 2]}], workers=workers)
    ...     call_all(fmean, [{"data": [0, half]} for half in halves], workers=workers)
    [0.25, 0.75]
    """

    def __init__(self, number: int) -> None:
        if type(number) is not int or number < 1:
            raise InputError(f"workers = {brief(number)}: must be a whole number of processes above zero, such as 2.")
        self.number = number
        self._idle: list[Child] = []
        self._started: contextlib.ExitStack | None = None

    def __enter__(self) -> Self:
        self._started = contextlib.ExitStack()
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
        """Lend processes; an exception ends them, as they may be at work still."""
        if self._started is None:
            raise InputError("workers: must be used within their block, with Workers(2) as workers: ...")
        lent: list[Child] = []
        try:
            while len(lent) < count:
                child = self._idle.pop() if self._idle else self._start(self._started)
                if child.poll() is None:
                    lent.append(child)
            yield lent
        except BaseException:
            for child in lent:
                _end(child)
            raise
        self._idle += lent

    def _start(self, started: contextlib.ExitStack) -> Child:
        child = subprocess.Popen(
            # -P: modules in the working folder must not stand in for those of this process
            [sys.executable, "-P", "-c", _SERVE],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),  # none flashes up under Windows
        )
        started.callback(_end, child)
        return child


def call_all(
    function: Callable[..., Any],
    calls: Sequence[dict[str, Any]],
    *,
    workers: int | Workers = 1,
    progress: Callable[[int], object] | None = None,
) -> list[Any]:
    """Call a function with each of several sets of arguments.

    Parameters
    ----------
    function : callable
        Importable by its name, if there is more than one worker.
    calls : sequence of dict
        Keyword arguments; what they hold can be pickled, if there is more than one worker.
    workers : int or Workers
        Processes: a number of them for these calls alone, or those that are kept for more.  One: everything is done
        in this one.
    progress : callable, optional
        Called in this process with the number of finished calls, after each.

    Returns
    -------
    list
        In the order of the calls.

    Raises
    ------
    InputError
        If the number of workers is not a whole one above zero, they are used outside their block, or a call cannot be
        handed to another process.
    ViscofricError
        If a process ends before its call is finished.
    Exception
        What a call raises; the first in order of those that were begun, if there are several.  No more are begun then.

    Notes
    -----
    An interrupt ends the processes at once.
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
    shared = _SharedCalls(f"{function.__module__}:{function.__qualname__}", calls, workers.number)
    with workers._children(count) as children:
        found, failures = shared.results(children, progress)
    if failures:
        raise failures[min(failures)]
    return [found[index] for index in range(len(calls))]


class _SharedCalls:
    """Calls handed out one after the other to some processes, by a thread for each of these."""

    def __init__(self, name: str, calls: Sequence[dict[str, Any]], workers: int) -> None:
        try:
            self.messages = [pickle.dumps((name, call)) for call in calls]
        except (pickle.PicklingError, AttributeError, TypeError) as error:
            raise _not_handed_over(workers, error) from None
        self.workers = workers
        self.answers: queue.SimpleQueue[tuple[int, bool, Any]] = queue.SimpleQueue()
        self.waiting = iter(range(len(calls)))
        self.lock = threading.Lock()
        self.failed = False

    def results(
        self, children: list[Child], progress: Callable[[int], object] | None
    ) -> tuple[dict[int, Any], dict[int, BaseException]]:
        """Return what was found and what failed, when none of the processes is at work any more."""
        found: dict[int, Any] = {}
        failures: dict[int, BaseException] = {}
        threads = [threading.Thread(target=self._keep_busy, args=(child,), daemon=True) for child in children]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads) or not self.answers.empty():
            with contextlib.suppress(queue.Empty):
                index, succeeded, value = self.answers.get(timeout=_LONGEST_WAIT)
                (found if succeeded else failures)[index] = value
                if succeeded and progress is not None:
                    progress(len(found))
            if len(found) == len(self.messages):
                break
        return found, failures

    def _next(self) -> int | None:
        with self.lock:
            return None if self.failed else next(self.waiting, None)

    def _keep_busy(self, child: Child) -> None:
        assert child.stdin is not None
        assert child.stdout is not None
        while (index := self._next()) is not None:
            try:
                pickle.dump(self.messages[index], child.stdin)
                child.stdin.flush()
                kind, value = pickle.loads(pickle.load(child.stdout))
            except (OSError, EOFError, ValueError, TypeError, AttributeError, ImportError, pickle.UnpicklingError):
                child.kill()
                child.wait()
                kind, value = "error", ViscofricError(_ENDED)
            if kind == "not understood":
                value = _not_handed_over(self.workers, value)
            self.failed = self.failed or kind != "result"
            self.answers.put((index, kind == "result", value))


def _not_handed_over(workers: int, reason: object) -> InputError:
    return InputError(
        f"workers = {workers}: what is to be solved cannot be handed to another process ({reason}); use one worker."
    )


def _end(child: Child) -> None:
    child.kill()
    child.wait()
    for pipe in (child.stdin, child.stdout):
        with contextlib.suppress(OSError):
            pipe.close()  # type: ignore[union-attr]


def serve() -> None:
    """Answer calls from standard input on standard output until there are no more; run in a process of its own."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is the business of the process that asks
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever is printed must not get between the answers
    while True:
        try:
            message = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        pickle.dump(_answer(message), answers)
        answers.flush()


def _answer(message: bytes) -> bytes:
    """Call what a message names; return what became of it, pickled."""
    try:
        name, call = pickle.loads(message)
        module, _, function = name.partition(":")
        called = getattr(import_module(module), function)
    except (AttributeError, ImportError) as error:
        return pickle.dumps(("not understood", str(error)))
    try:
        result = called(**call)
    except Exception as error:  # noqa: BLE001 - it is raised again by the process that asked
        return _told(error)
    try:
        return pickle.dumps(("result", result))
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        return pickle.dumps(("not understood", str(error)))


def _told(error: Exception) -> bytes:
    """Return an exception pickled; one that cannot be, or not be had back, in words."""
    try:
        answer = pickle.dumps(("error", error))
        pickle.loads(answer)
    except Exception:  # noqa: BLE001 - whatever its class does when it is made again
        return pickle.dumps(("error", ViscofricError(f"{type(error).__name__}: {error}")))
    return answer
