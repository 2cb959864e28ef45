"""The other end of `viscofric.processes`: a process that carries out the calls of another, one at a time.

Each order on the standard input is a pair, pickled: the number of a call, and the call or, to interrupt it, None.  Each
reply is a line with the number, the kind, whether this process stays, and a number of bytes, and then as many bytes.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import pickle
import queue
import signal
import sys
import threading
import traceback
from importlib import import_module
from typing import TYPE_CHECKING, BinaryIO, Literal

from viscofric.errors import ViscofricError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from types import TracebackType

_IDLE = 2.0  # s without a call, after which what later calls need is imported


def serve(parent: int, needed: str = "", later: Sequence[str] = (), memory: int = 0) -> None:
    """Carry out calls until the standard input closes, in a process of its own that `parent` started."""
    if memory:
        limit("AS", memory)
    # those of the terminal do not come here, see `viscofric.processes`; the calling process may ignore them
    signal.signal(signal.SIGINT, signal.default_int_handler)
    desk = _Desk(*_taken_pipes())
    if needed:
        import_module(needed)
    left = list(later)
    while True:
        # an interrupt that came as its call ended reaches the loop; there is nothing left to interrupt then
        with contextlib.suppress(KeyboardInterrupt):
            try:
                number, message = desk.calls.get(timeout=_IDLE)
            except queue.Empty:
                if sys.platform != "win32" and os.getppid() != parent:  # also where a fork keeps its pipes open
                    _end()
                if left:
                    with contextlib.suppress(ImportError, MemoryError):  # the call that needs it says so
                        import_module(left.pop(0))
            else:
                desk.carry_out(number, message)


def _taken_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Return what orders and replies pass through; calls get an empty input, and what they print goes with errors."""
    orders, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nowhere, 0)
    os.close(nowhere)
    os.dup2(2, 1)
    return orders, replies


class _Desk:
    """Where calls come in and replies go out, each by its own thread, so that an interrupt splits no reply."""

    def __init__(self, orders: BinaryIO, replies: BinaryIO) -> None:
        self.calls: queue.SimpleQueue[tuple[int, bytes]] = queue.SimpleQueue()
        self._replies: queue.SimpleQueue[tuple[bytes, bytes]] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._at_work: int | None = None  # number of the call that may be interrupted
        self._interrupted: int | None = None
        for work, pipe in ((self._listen, orders), (self._write, replies)):
            threading.Thread(target=work, args=(pipe,), daemon=True).start()

    def _listen(self, orders: BinaryIO) -> None:
        """Take in calls and requests to interrupt them; end this process when the input closes."""
        try:
            while True:
                number, message = pickle.load(orders)
                if message is not None:
                    self.calls.put((number, message))
                    continue
                with self._lock:
                    self._interrupted = number
                    if self._at_work == number:
                        _thread.interrupt_main()
        finally:
            _end()

    def _write(self, replies: BinaryIO) -> None:
        try:
            while True:
                replies.writelines(self._replies.get())
                replies.flush()
        finally:  # nobody reads any more
            _end()

    def carry_out(self, number: int, message: bytes) -> None:
        """Make the call of a message and send its end."""
        try:
            with self._interruptible(number):
                reply = _reply(message, lambda part: self._send(number, "part", True, part))
        except KeyboardInterrupt as stop:
            reply = "interrupted", not _was_importing(stop.__traceback__), pickle.dumps(KeyboardInterrupt())
        self._send(number, *reply)

    def _send(self, number: int, kind: str, stays: bool, value: bytes) -> None:
        self._replies.put((f"{number} {kind} {'stays' if stays else 'ends'} {len(value)}\n".encode(), value))

    @contextlib.contextmanager
    def _interruptible(self, number: int) -> Iterator[None]:
        with self._lock:
            if number == self._interrupted:
                raise KeyboardInterrupt
            self._at_work = number
        try:
            yield
        finally:
            with self._lock:  # an interrupt on its way comes here, not to the next call
                self._at_work = None


def _reply(message: bytes, send: Callable[[bytes], None]) -> tuple[str, bool, bytes]:
    """Make the call of a message; return the kind of its end, whether this process stays, and the value in bytes."""
    try:
        name, call, in_parts = pickle.loads(message)
        module, _, function = name.partition(":")
        called = getattr(import_module(module), function)
    except (AttributeError, ImportError) as error:
        return "unfit", True, pickle.dumps(str(error))
    try:
        result = called(**call, send=send) if in_parts else called(**call)
    except Exception as error:  # noqa: BLE001 - it is raised again in the calling process
        # one that lacked memory may be damaged
        return "error", not isinstance(error, MemoryError), _pickled(error)
    try:
        return "result", True, result if in_parts else pickle.dumps(result)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        return "unfit", True, pickle.dumps(str(error))


def _pickled(error: Exception) -> bytes:
    """Return an exception pickled, or its sentence if its class cannot be pickled and restored."""
    try:
        reply = pickle.dumps(error)
        pickle.loads(reply)
    except Exception:  # noqa: BLE001 - restoring it may raise anything
        return pickle.dumps(ViscofricError(f"{type(error).__name__}: {error}"))
    return reply


def _was_importing(trace: TracebackType | None) -> bool:
    """Whether an interrupt came while a module was loaded, which may be left half done."""
    codes = [frame.f_code for frame, _ in traceback.walk_tb(trace)]
    return any(code.co_name == "<module>" or "importlib._bootstrap" in code.co_filename for code in codes)


def _end() -> None:
    """End this process at once, and those that it started if it leads their group."""
    if sys.platform != "win32" and os.getpgrp() == os.getpid():
        os.killpg(os.getpgrp(), signal.SIGKILL)
    os._exit(1)


def limit(what: Literal["AS", "FSIZE"], most: int) -> None:
    """Limit this process's address space or each of its files, in bytes, if the system can; what needs more fails."""
    if sys.platform == "win32":
        return
    import resource

    kind = getattr(resource, f"RLIMIT_{what}")
    _, hard = resource.getrlimit(kind)
    with contextlib.suppress(OSError, ValueError):
        # the system, which may have a lower limit already, accepts no higher one; below zero: there is none
        resource.setrlimit(kind, (most if hard < 0 else min(most, hard), hard))
