"""Progress of a study and of single contacts: bars on a terminal, lines elsewhere, or JSON."""

from __future__ import annotations

import contextlib
import json
import time
from contextlib import contextmanager
from functools import partial
from typing import IO, TYPE_CHECKING, Any, Protocol

from rich.console import Console
from rich.markup import escape
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    TaskID,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Column

from viscofric.datasets import plain

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Self

    from viscofric.study.running.running import Event


#: What is not watched gets a line so often.
_BETWEEN_LINES = 60.0  # s
#: Text beside the bar of a contact over time.
_OF_TIME = "t = {:.4g} of {:.4g} s"


class Silent(contextlib.AbstractContextManager["Silent"]):
    """Shows nothing; the base of the others."""

    def __exit__(self, *error: object) -> None:
        pass

    def __call__(self, event: Event) -> None:
        """Receive an event."""

    def write(self, event: str, **values: Any) -> None:
        """Receive an event that is for programs only."""


class TerminalProgress(Silent):
    """Shows a study on standard error: a bar for each stage on a terminal, plain lines elsewhere."""

    def __init__(self) -> None:
        self._console = Console(stderr=True)
        self._tasks: dict[str, TaskID] = {}
        self._at_work: dict[str, str] = {}
        self._failed = 0
        self._began = self._last_line = time.monotonic()
        self._bars = Progress(
            TextColumn("{task.description}"),
            BarColumn(bar_width=12),
            MofNCompleteColumn(),
            TimeRemainingColumn(elapsed_when_finished=True),
            # what does not fit is cut off here, not from the numbers
            TextColumn("{task.fields[doing]}", table_column=Column(ratio=1, no_wrap=True)),
            console=self._console,
            expand=True,
        )

    def __enter__(self) -> Self:
        if self._console.is_terminal:
            self._bars.start()
        return self

    def __exit__(self, *error: object) -> None:
        if self._console.is_terminal:  # stopping bars that never started prints an empty line
            self._bars.stop()

    def __call__(self, event: Event) -> None:
        """Show an event."""
        from viscofric.study.running.running import STAGES

        stage = event.stage or event.event
        words = STAGES.get(stage, stage).capitalize()
        if event.event == "waiting":
            self._console.print(f"Waiting: {event.reason}", highlight=False, markup=False, soft_wrap=True)
        if self._console.is_terminal:
            self._draw(event, stage, words)
        else:
            self._write(event, words)

    def _draw(self, event: Event, stage: str, words: str) -> None:
        if stage not in self._tasks:
            self._tasks[stage] = self._bars.add_task(words, total=event.total, doing="")
        doing = escape(self._doing(event))  # the last event of a stage, too, has the time from its beginning
        if event.event == "stage":
            self._began = time.monotonic()
        self._bars.update(self._tasks[stage], completed=event.done, total=event.total, doing=doing)

    def _doing(self, event: Event) -> str:
        """Say how fast contacts are solved, and which."""
        if event.key is not None and event.event == "solving":
            self._at_work[event.key] = event.label or ""
        elif event.key is not None:
            self._at_work.pop(event.key, None)
        self._failed += event.event == "failed"
        if not event.solves:
            return ""
        rate = event.solves / max(time.monotonic() - self._began, 1e-3)
        speed = f"{rate:.2g}/s" if rate >= 1.0 else f"{1.0 / rate:.2g} s each"
        failed = [f"{self._failed} failed"] if self._failed else []
        return ", ".join([f"{event.solves} solved", speed, *failed, *list(self._at_work.values())[:1]])

    def _write(self, event: Event, words: str) -> None:
        now = time.monotonic()
        if event.event == "stage" and event.done != event.total:
            many = f" ({event.total})" if event.total and event.total > 1 else ""
            self._console.print(f"{words}{many} ...", highlight=False)
            self._last_line = now
        elif event.event != "stage" and now > self._last_line + _BETWEEN_LINES:
            self._last_line = now
            self._console.print(
                f"  {event.done} of {event.total} cases known, {event.solves} contacts solved", highlight=False
            )


class JsonProgress(Silent):
    """Writes one JSON object a line for each event."""

    def __init__(self, output: IO[str]) -> None:
        self._output = output

    def __call__(self, event: Event) -> None:
        """Write an event."""
        self.write(**event.as_dict())

    def write(self, event: str, **values: Any) -> None:
        """Write an event that is for programs only."""
        record = plain({"event": event, **values}, digits=None)
        self._output.write(json.dumps(record, ensure_ascii=False, allow_nan=False) + "\n")
        self._output.flush()


@contextmanager
def _bar(words: str, quiet: bool, *beside: ProgressColumn, **fields: Any) -> Iterator[Callable[..., None]]:
    """Show a bar on standard error as long as the block runs, if that is a terminal; yield what moves it."""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(bar_width=24), *beside)
    with Progress(*columns, console=console, transient=True, disable=quiet or not console.is_terminal) as bars:
        yield partial(bars.update, bars.add_task(words, total=None, **fields))


@contextmanager
def time_bar(words: str, *, quiet: bool, shown: str = _OF_TIME) -> Iterator[Callable[[float, float], None]]:
    """Show the time reached, see `_bar`; without the last time, the second place of `shown`, the bar has no end."""
    beside = TextColumn("{task.fields[reached]}"), TimeRemainingColumn(elapsed_when_finished=True)
    with _bar(words, quiet, *beside, reached="") as move:

        def show(reached: float, last: float) -> None:
            move(completed=reached, total=last if shown == _OF_TIME else None, reached=shown.format(reached, last))

        yield show


class Bar(Protocol):
    """Shows how far things are."""

    def __call__(self, done: int, total: int, words: str = "") -> None:
        """Show that so many contacts of all are solved, and if given what is done."""


@contextmanager
def contact_bar(words: str, *, quiet: bool) -> Iterator[Bar]:
    """Show how many contacts are solved, see `_bar`."""
    with _bar(words, quiet, MofNCompleteColumn(), TimeElapsedColumn()) as move:

        def show(done: int, total: int, words: str = words) -> None:
            move(description=words, completed=done, total=total)

        yield show
