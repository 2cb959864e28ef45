"""The other end of `viscofric.processes`: what a process does that answers calls from another."""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import sys
import threading
import time
from importlib import import_module

from viscofric.errors import ViscofricError

_BETWEEN_LOOKS = 0.5  # s


def serve(parent: int, needed: str = "", memory: int = 0) -> None:
    """Answer calls from standard input on standard output until there are no more; run in a process of its own.

    Parameters
    ----------
    parent : int
        Number of the process that asks; without it, this one ends at once, whatever it is doing.
    needed : str
        Module that the calls need, imported before the first of them comes.
    memory : int
        Address space that it may have in bytes; 0 for no limit.
    """
    if memory:
        limit_memory(memory)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is the business of the process that asks
    if sys.platform != "win32":  # where a process that lost its parent gets another
        threading.Thread(target=_end_with, args=(parent,), daemon=True).start()
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever is printed must not get between the answers
    if needed:
        import_module(needed)
    while True:
        try:
            message = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        try:
            pickle.dump(_answer(message), answers)
            answers.flush()
        except BrokenPipeError:  # nobody asks any more
            os._exit(1)


def limit_memory(most: int) -> None:
    """Let this process have no more address space, in bytes, where the system knows how; calls that want more fail."""
    if sys.platform == "win32":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_AS, (at_most(most, hard), hard))


def at_most(wanted: int, hard: int) -> int:
    """Return a limit that the system, which may set one already, lets a process have."""
    return wanted if hard < 0 else min(wanted, hard)  # below zero: there is none


def _end_with(parent: int) -> None:
    """End this process soon after another one, its parent, was killed."""
    while os.getppid() == parent:
        time.sleep(_BETWEEN_LOOKS)
    os._exit(1)


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
