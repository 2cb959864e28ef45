"""A process for calls within limits of time and memory."""

from __future__ import annotations

import atexit
import contextlib
import os
import pickle
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from viscofric.errors import InputError
from viscofric.processes import end, reply_of, started

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.processes import Child


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
        message = pickle.dumps((f"{function.__module__}:{function.__qualname__}", arguments))
        child = self._free() or started(
            self.needed,
            self.memory,
            OMP_NUM_THREADS="1",
            OPENBLAS_NUM_THREADS="1",  # each thread takes address space
        )
        latest = time.monotonic() + self.seconds
        alarm = threading.Timer(self.seconds, child.kill)
        alarm.daemon = True
        alarm.start()
        try:
            kind, value = reply_of(child, message)
        except BaseException:
            end(child)
            raise
        finally:
            alarm.cancel()
        if kind == "ended" or isinstance(value, MemoryError):  # its state may be damaged
            end(child)
            raise TimeoutError if time.monotonic() >= latest else MemoryError
        self._keep(child)
        if kind != "result":
            raise value if kind == "error" else InputError(value, code="not-picklable")
        return value

    def _free(self) -> Child | None:
        if self._owner != os.getpid():  # a fork must not use the process of its parent
            for child in self._idle:
                child.returncode = 0
            self._idle.clear()
            self._owner = os.getpid()
            atexit.register(self.close)
        with contextlib.suppress(IndexError):
            child = self._idle.pop()
            if child.poll() is None:
                return child
        return None

    def _keep(self, child: Child) -> None:
        if self._idle:
            end(child)
        else:
            self._idle.append(child)

    def close(self) -> None:
        """End the idle process."""
        while self._idle:
            end(self._idle.pop())
