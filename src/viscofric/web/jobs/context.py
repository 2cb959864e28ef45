"""What a job is handed besides the study: its folders, and how it sends progress and parts of its result."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

from viscofric.datasets import plain
from viscofric.errors import ViscofricError
from viscofric.notes import Note
from viscofric.study.running.running import Event

_BETWEEN_SENT = 0.05  # s, of progress: a browser shows no more


class JobOptions(BaseModel):
    """Options of a job, or a part of them: other names are refused.  A job without options takes these."""

    model_config = ConfigDict(extra="forbid")


class JobError(ViscofricError):
    """What keeps a job from being done, in one sentence, with the field of the study that it is about."""

    def __init__(self, message: str | Note, field: str | None = None, *, code: str = "") -> None:
        super().__init__(message, field=field, code=code)


def beside_field(problem: Note) -> dict[str, str]:
    """Return what the page writes beside the field that a problem is about."""
    words = Note(problem.code, problem.text, remedy=problem.remedy).words("page")
    return {"field": problem.where, "message": words[:1].upper() + words[1:]}


@dataclass
class Context:
    """What a job is handed."""

    files: Path  # folder of the uploaded files; file names in the study are relative to it
    downloads: Path  # folder for what the user may fetch, at ``/api/downloads/<name>``
    cache: Path  # folder for what later jobs of the same page can use again
    #: Called with the event (``"progress"`` or ``"part"``) and what it says
    send: Callable[[str, dict[str, Any]], object] = lambda event, message: None
    _sent: float = field(default=-math.inf, repr=False)

    def progress(self, done: float, total: float, label: str = "") -> None:
        """Say how much of the work is done; may be called as often as one likes."""
        now = time.monotonic()
        if now - self._sent >= _BETWEEN_SENT or done >= total:
            self._sent = now
            self.send("progress", {"done": plain(done), "total": plain(total), "label": label})

    def show(self, event: Event, stage: str = "") -> None:
        """Report the progress of a study from one of its events, with the stage in words if given."""
        self.progress(event.done or 0, event.total or 0, ": ".join(filter(None, (stage, event.label))))

    def part(self, part: dict[str, Any]) -> None:
        """Hand over a part of the result that can be shown already."""
        self.send("part", {"part": part})
