"""A process that computes, as the server sees it: started, sent jobs, listened to, ended."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

_PROGRAM = "from viscofric.web.child import main; main({parent})"
_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_LONGEST_END = 1.0  # s that its last words may take
_ENDED = "The process that computed this ended, for want of memory as a rule; ask for less accuracy or fewer points."


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
            loop.call_soon_threadsafe(self._take, None, Message("ended", line("error", message=_ENDED, field=None)))

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
        with contextlib.suppress(OSError, ValueError):  # it ended, which is told by its output
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
