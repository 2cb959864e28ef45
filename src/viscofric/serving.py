"""The other end of `viscofric.processes`: a process that replies to the calls of another."""

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

_CHECK_INTERVAL = 0.5  # s


def serve(parent: int, needed: str = "", memory: int = 0) -> None:
    """Answer calls from standard input on standard output until there are no more, in a separate process."""
    if memory:
        limit_memory(memory)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the calling process handles interrupts
    if sys.platform != "win32":  # an orphaned process gets another parent
        threading.Thread(target=_end_with, args=(parent,), daemon=True).start()
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # printed text must not mix with the replies
    if needed:
        import_module(needed)
    while True:
        try:
            message = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        try:
            pickle.dump(_reply(message), replies)
            replies.flush()
        except BrokenPipeError:  # the calling process closed its end
            os._exit(1)


def limit_memory(most: int) -> None:
    """Limit the address space of this process, in bytes, if the system can; calls that need more fail."""
    if sys.platform == "win32":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_AS, (at_most(most, hard), hard))


def at_most(wanted: int, hard: int) -> int:
    """Return a limit that the system, which may have a lower one already, accepts."""
    return wanted if hard < 0 else min(wanted, hard)  # below zero: no limit


def _end_with(parent: int) -> None:
    """End this process soon after its parent ended."""
    while os.getppid() == parent:
        time.sleep(_CHECK_INTERVAL)
    os._exit(1)


def _reply(message: bytes) -> bytes:
    """Make the call of a message, and return the kind of its end and the value, pickled."""
    try:
        name, call = pickle.loads(message)
        module, _, function = name.partition(":")
        called = getattr(import_module(module), function)
    except (AttributeError, ImportError) as error:
        return pickle.dumps(("not understood", str(error)))
    try:
        result = called(**call)
    except Exception as error:  # noqa: BLE001 - it is raised again in the calling process
        return _pickled(error)
    try:
        return pickle.dumps(("result", result))
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        return pickle.dumps(("not understood", str(error)))


def _pickled(error: Exception) -> bytes:
    """Return an exception pickled, or its sentence if its class cannot be pickled and restored."""
    try:
        reply = pickle.dumps(("error", error))
        pickle.loads(reply)
    except Exception:  # noqa: BLE001 - restoring it may raise anything
        return pickle.dumps(("error", ViscofricError(f"{type(error).__name__}: {error}")))
    return reply
