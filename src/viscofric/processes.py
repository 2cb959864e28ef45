"""Independent calls shared out among processes, which give the same digits as one process would.

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
from typing import TYPE_CHECKING, Any

from viscofric.errors import InputError, ViscofricError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

_SERVE = "from viscofric.processes import serve; serve()"
_ENDED = "a process ended before its contact was solved, for want of memory as a rule; use fewer workers."
# Waiting without an end cannot be interrupted everywhere (Windows).
_LONGEST_WAIT = 1.0  # s


def call_all(
    function: Callable[..., Any],
    calls: Sequence[dict[str, Any]],
    *,
    workers: int = 1,
    progress: Callable[[int], object] | None = None,
) -> list[Any]:
    """Call a function with each of several sets of arguments.

    Parameters
    ----------
    function : callable
        Importable by its name, if there is more than one worker.
    calls : sequence of dict
        Keyword arguments; what they hold can be pickled, if there is more than one worker.
    workers : int
        Processes.  One: everything is done in this one.
    progress : callable, optional
        Called in this process with the number of finished calls, after each.

    Returns
    -------
    list
        In the order of the calls.

    Raises
    ------
    InputError
        If the number of workers is not a whole one above zero, or a call cannot be handed to another process.
    ViscofricError
        If a process ends before its call is finished.
    Exception
        What a call raises; the first in order of those that were begun, if there are several.  No more are begun then.

    Notes
    -----
    An interrupt ends the processes at once.
    """
    if type(workers) is not int or workers < 1:
        raise InputError(f"workers = {workers!r}: must be a whole number of processes above zero, such as 2.")
    workers = min(workers, len(calls))
    if workers <= 1:
        results = []
        for call in calls:
            results.append(function(**call))
            if progress is not None:
                progress(len(results))
        return results
    return _Team(f"{function.__module__}:{function.__qualname__}", calls, workers).results(progress)


class _Team:
    """Some processes, each with a thread here that hands it one call after the other."""

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

    def results(self, progress: Callable[[int], object] | None) -> list[Any]:
        found: dict[int, Any] = {}
        failures: dict[int, BaseException] = {}
        with contextlib.ExitStack() as stack:
            threads = []
            for _ in range(self.workers):
                child = stack.enter_context(_child())
                threads.append(threading.Thread(target=self._keep_busy, args=(child,), daemon=True))
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
        if failures:
            raise failures[min(failures)]
        return [found[index] for index in range(len(self.messages))]

    def _next(self) -> int | None:
        with self.lock:
            return None if self.failed else next(self.waiting, None)

    def _keep_busy(self, child: subprocess.Popen[bytes]) -> None:
        assert child.stdin is not None
        assert child.stdout is not None
        while (index := self._next()) is not None:
            try:
                pickle.dump(self.messages[index], child.stdin)
                child.stdin.flush()
                kind, value = pickle.load(child.stdout)
            except (OSError, EOFError, ValueError, TypeError, AttributeError, pickle.UnpicklingError):
                kind, value = "error", ViscofricError(_ENDED)
            if kind == "not understood":
                value = _not_handed_over(self.workers, value)
            self.failed = self.failed or kind != "result"
            self.answers.put((index, kind == "result", value))


def _not_handed_over(workers: int, reason: object) -> InputError:
    return InputError(
        f"workers = {workers}: what is to be solved cannot be handed to another process ({reason}); use one worker."
    )


@contextlib.contextmanager
def _child() -> Any:
    # -P: modules in the working folder must not stand in for those of this process
    child = subprocess.Popen(
        [sys.executable, "-P", "-c", _SERVE],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),  # none flashes up under Windows
    )
    try:
        yield child
    finally:
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
        try:
            name, call = pickle.loads(message)
            module, _, function = name.partition(":")
            called = getattr(import_module(module), function)
        except (AttributeError, ImportError) as error:
            answer: tuple[str, Any] = ("not understood", str(error))
        else:
            try:
                answer = ("result", called(**call))
            except Exception as error:  # noqa: BLE001 - it is raised again by the process that asked
                answer = ("error", error)
        pickle.dump(answer, answers)
        answers.flush()
