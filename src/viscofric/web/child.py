"""A process that computes for the page: jobs come on its standard input, and it ends when that closes.

Each line of the input is a JSON object: a job, or the wish to have one cancelled.  Each reply is a line with the job's
number, the event, whether this process stays after it, and a number of bytes, and then as many bytes of JSON.
`viscofric.web.children` is the other end.
"""

from __future__ import annotations

import _thread
import contextlib
import json
import os
import queue
import signal
import sys
import threading
import time
import traceback
from collections.abc import Iterable
from functools import partial
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO

from viscofric.datasets import plain
from viscofric.errors import ViscofricError, brief
from viscofric.serving import at_most, limit_memory
from viscofric.web.jobs import LATER, WARM
from viscofric.web.jobs.context import Context, beside_field
from viscofric.web.study_files import check_confined

#: What is sent at once may have this many bytes: a browser is not to be handed more.
LARGEST_MESSAGE = 48_000_000
_LARGEST_FILE = 200_000_000  # bytes, of one that a job writes
_NO_MEMORY = "There was not enough memory for this; request less accuracy or fewer points."
_DIES_WITH_PARENT = 1  # PR_SET_PDEATHSIG of Linux
_NICE = 5  # the server and the browser go first
_IDLE = 2.0  # s without a job, after which what later jobs need is imported


def main(parent: int, warm: Iterable[str] = WARM) -> None:
    """Do jobs until the standard input closes, in a process of its own whose `parent` hands them out."""
    _end_with(parent)
    orders, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    _keep_from_jobs()
    desk = Desk(replies)
    threading.Thread(target=desk.listen, args=(orders,), daemon=True).start()
    for module in warm:
        import_module(module)
    desk.send(0, "ready", {})
    later = list(LATER)
    while True:
        # an interrupt that came as its job ended reaches the loop; there is nothing left to interrupt then
        with contextlib.suppress(KeyboardInterrupt):
            try:
                job = desk.jobs.get(timeout=_IDLE if later else None)
            except queue.Empty:
                with contextlib.suppress(ImportError, MemoryError):  # the job that needs it says so
                    import_module(later.pop(0))
            else:
                desk.work(job)


def _end_with(parent: int) -> None:
    """Have the system end this process with its parent, even where a long call keeps all threads waiting."""
    if sys.platform == "win32":
        return
    with contextlib.suppress(OSError, AttributeError):
        os.nice(_NICE)
    if sys.platform == "linux":
        import ctypes

        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(_DIES_WITH_PARENT, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)


def _keep_from_jobs() -> None:
    """Leave jobs an empty standard input; what they print goes where errors go."""
    nowhere = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nowhere, 0)
    os.close(nowhere)
    os.dup2(2, 1)
    if sys.platform != "win32":
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (at_most(_LARGEST_FILE, most), most))


class Desk:
    """Where jobs come in and replies go out, each by a thread of its own, so that an interrupt splits no reply."""

    def __init__(self, replies: BinaryIO) -> None:
        self.jobs: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._replies: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._at_work: int | None = None  # number of the job that may be interrupted
        self._cancelled: set[int] = set()
        threading.Thread(target=self._write, args=(replies,), daemon=True).start()

    def listen(self, orders: BinaryIO) -> None:
        """Take in jobs and wishes to cancel them; end everything once nobody can wish any more."""
        for line in orders:
            order = json.loads(line)
            if "cancel" not in order:
                self.jobs.put(order)
                continue
            with self._lock:
                self._cancelled = {order["cancel"]}
                if self._at_work == order["cancel"]:
                    _thread.interrupt_main()
        end_all()

    def _write(self, replies: BinaryIO) -> None:
        while True:
            message = self._replies.get()
            try:
                replies.write(message)
                replies.flush()
            except OSError:  # nobody reads any more
                end_all()
            if not message:
                os._exit(0)

    def send(
        self, number: int, event: str, message: dict[str, Any], stays: bool = True, files: Path | None = None
    ) -> None:
        """Send a message of a job, in which its files are named without their folder."""
        body = _json({"event": event, **message}, files)
        if len(body) > LARGEST_MESSAGE:
            raise ViscofricError(
                f"The reply has {len(body) / 1e6:.0f} MB, more than is sent to a browser "
                f"({LARGEST_MESSAGE / 1e6:.0f} MB); request fewer points.",
                code="too-large",
            )
        self._replies.put(f"{number} {event} {'stays' if stays else 'ends'} {len(body)}\n".encode() + body)

    def work(self, job: dict[str, Any]) -> None:
        """Do a job and send its result or its error."""
        number, files = job["job"], Path(job["folder"]) / "files"
        send = partial(self.send, number, files=files)
        stays = True
        try:
            with self._interruptible(number):
                send("result", {"result": _result(job, send)})
        except KeyboardInterrupt as stop:
            stays = not _was_importing(stop.__traceback__)
            send("cancelled", {}, stays)
        except BaseException as error:  # noqa: BLE001 - the page shows it
            stays = not isinstance(error, MemoryError)
            send("error", _error_of(error, files), stays)
        if not stays:
            self._replies.put(b"")
            threading.Event().wait()

    @contextlib.contextmanager
    def _interruptible(self, number: int) -> Any:
        with self._lock:
            if number in self._cancelled:
                raise KeyboardInterrupt
            self._at_work = number
        try:
            yield
        finally:
            with self._lock:  # an interrupt on its way comes here, not to the next job
                self._at_work = None


def _result(job: dict[str, Any], send: Any) -> Any:
    limit_memory(job["memory"])
    module = import_module(job["module"])
    check_confined(job["study"])
    folder = Path(job["folder"])
    look_after(folder / "cache")
    context = Context(folder / "files", folder / "downloads", folder / "cache", send)
    return module.run(job["study"], module.Options.model_validate(job["options"]), context)


def _json(message: dict[str, Any], files: Path | None) -> bytes:
    try:
        text = json.dumps(message, allow_nan=False, separators=(",", ":"))
    except (TypeError, ValueError):
        text = json.dumps(plain(message, digits=None), allow_nan=False, separators=(",", ":"))
    return (text if files is None else _without_folder(text, files)).encode() + b"\n"


def _was_importing(trace: TracebackType | None) -> bool:
    """Whether an interrupt came while a module was loaded, which may be left half done."""
    codes = [frame.f_code for frame, _ in traceback.walk_tb(trace)]
    return any(code.co_name == "<module>" or "importlib._bootstrap" in code.co_filename for code in codes)


def _error_of(error: BaseException, files: Path) -> dict[str, Any]:
    """Return what the page says of an error: a sentence, and the field of the study that it is about."""
    if isinstance(error, ViscofricError):
        words, problems = error.words("page"), [beside_field(one) for one in getattr(error, "mistakes", ())]
        return {
            "message": words,
            "code": error.code,
            "field": error.field,
            "problems": problems or [{"field": error.field, "message": words}],
            "values": dict(error.note.values),
        }
    if isinstance(error, MemoryError):
        return {"message": _NO_MEMORY, "code": "no-memory", "field": None}
    if type(error).__name__ == "ValidationError" and hasattr(error, "errors"):
        first = error.errors()[0]
        place = ".".join(["options", *map(str, first["loc"])])
        return {"message": f"{place}: {first['msg']}.", "code": "wrong-option", "field": place}
    traceback.print_exception(error)
    words = brief(_without_folder(str(error), files))
    said = f"This is an error of viscofric, {type(error).__name__}: {words}."
    return {"message": said, "code": "internal-error", "field": None}


def _without_folder(text: str, files: Path) -> str:
    """Name files as the user named them, in words or in JSON."""
    for folder in (files, files.resolve(), files.parent):
        beginning = f"{folder}{os.sep}"
        text = text.replace(json.dumps(beginning)[1:-1], "").replace(beginning, "")
    return text


def end_all() -> None:
    """End this process at once, and those that it started."""
    if sys.platform != "win32" and os.getpgrp() == os.getpid():
        os.killpg(os.getpgrp(), signal.SIGKILL)
    os._exit(1)


_MOST_BYTES = 300_000_000  # of a workspace
_YOUNG = 600.0  # s; what is younger may be of a job at work
_BETWEEN_LOOKS = 60.0  # s; jobs follow each other quickly while somebody moves a slider
_KINDS = (".pickle", ".json", ".npz")

_looked: dict[Path, float] = {}


def look_after(cache: Path) -> None:
    """Make room where nobody has looked for a while."""
    now = time.monotonic()
    if now - _looked.get(cache, -_BETWEEN_LOOKS) >= _BETWEEN_LOOKS:
        _looked[cache] = now
        make_room(cache)


def make_room(cache: Path, most: int = _MOST_BYTES, young: float = _YOUNG) -> None:
    """Remove the oldest rubbers and solved contacts beyond so many bytes, but none younger than so many seconds."""
    stays, before = 0, time.time() - young
    folders = [cache, *cache.glob("*cases"), *cache.glob("study/*.results/cases")]  # rubbers, contacts, whole studies
    files = [entry for folder in folders for entry in _kept_files(folder)]
    for modified, size, path in sorted(files, reverse=True):
        stays += size
        if stays > most and modified < before:
            with contextlib.suppress(OSError):
                path.unlink()


def _kept_files(folder: Path) -> list[tuple[float, int, Path]]:
    found = []
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.endswith(_KINDS):
                with contextlib.suppress(OSError):
                    status = entry.stat()
                    found.append((status.st_mtime, status.st_size, folder / entry.name))
    return found
