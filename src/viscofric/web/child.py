"""What the processes that compute for the page do; `viscofric.web.children` hands them their jobs."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from viscofric.datasets import plain
from viscofric.errors import ViscofricError, brief
from viscofric.serving import limit
from viscofric.web.jobs import Kind
from viscofric.web.jobs.context import Context, beside_field
from viscofric.web.study_files import check_confined

#: What is sent at once may have this many bytes: a browser is not to be handed more.
LARGEST_MESSAGE = 48_000_000
_LARGEST_FILE = 200_000_000  # bytes, of one that a job writes
_DIES_WITH_PARENT = 1  # PR_SET_PDEATHSIG of Linux
_NICE = 5  # the server and the browser go first


def prepare(modules: Sequence[str]) -> None:
    """Prepare this process for jobs, and import what they need."""
    if sys.platform != "win32":
        with contextlib.suppress(OSError, AttributeError):
            os.nice(_NICE)
    if sys.platform == "linux":
        import ctypes

        # the system ends it with its parent, even where a long call keeps all threads waiting
        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(_DIES_WITH_PARENT, signal.SIGKILL)
    limit("FSIZE", _LARGEST_FILE)
    for module in modules:
        import_module(module)


def do(
    kind: Kind, study: dict[str, Any], options: dict[str, Any], folder: Path, send: Callable[[bytes], None]
) -> bytes:
    """Do a job and return its result or its error as a line of JSON, like its parts; files lose their folder."""
    files = folder / "files"
    try:
        limit("AS", kind.memory)
        module = import_module(kind.module)
        check_confined(study)
        look_after(folder / "cache")
        context = Context(
            files, folder / "downloads", folder / "cache", lambda event, more: send(_line(event, more, files))
        )
        result = module.run(study, module.Options.model_validate(options), context)
        return _line("result", {"result": result}, files)
    except (KeyboardInterrupt, MemoryError):
        raise
    except BaseException as error:  # noqa: BLE001 - the page shows it
        return _line("error", _error_of(error, files), files)


def _line(event: str, message: dict[str, Any], files: Path) -> bytes:
    body = _json({"event": event, **message}, files)
    if len(body) > LARGEST_MESSAGE:
        raise ViscofricError(
            f"The reply has {len(body) / 1e6:.0f} MB, more than is sent to a browser "
            f"({LARGEST_MESSAGE / 1e6:.0f} MB); request fewer points.",
            code="too-large",
        )
    return body


def _json(message: dict[str, Any], files: Path) -> bytes:
    try:
        text = json.dumps(message, allow_nan=False, separators=(",", ":"))
    except (TypeError, ValueError):
        text = json.dumps(plain(message, digits=None), allow_nan=False, separators=(",", ":"))
    return _without_folder(text, files).encode() + b"\n"


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
