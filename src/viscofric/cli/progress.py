"""Progress on the terminal: a bar for people, plain lines when the output goes to a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeRemainingColumn

if TYPE_CHECKING:
    from types import TracebackType

_WORDS = {
    "material": "Material: shift factors, master curve, spectrum",
    "measurement": "Measurement: Coulomb and viscoelastic friction",
    "shift": "Measurement: one friction curve of all temperatures",
    "friction": "Contacts at the speeds and temperatures asked for",
    "measured points": "Contacts at the measured points",
    "master curve": "Contacts along the friction master curve",
    "report": "Figures and report",
}


class TerminalProgress:
    """Shows the stages of a study on standard error; a context manager and a `Progress` callback."""

    def __init__(self) -> None:
        self._console = Console(stderr=True)
        self._tasks: dict[str, TaskID] = {}
        self._bars = Progress(
            TextColumn("{task.description}"),
            BarColumn(bar_width=24),
            MofNCompleteColumn(),
            TimeRemainingColumn(elapsed_when_finished=True),
            console=self._console,
        )

    def __enter__(self) -> Self:
        if self._console.is_terminal:
            self._bars.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._console.is_terminal:  # stopping bars that never started prints an empty line
            self._bars.stop()

    def __call__(self, stage: str, done: int, total: int) -> None:
        """Show that `done` of `total` steps of a stage are finished."""
        words = _WORDS.get(stage, stage)
        if not self._console.is_terminal:
            if done == 0:
                self._console.print(f"{words} ({total}) ..." if total > 1 else f"{words} ...", highlight=False)
            return
        if stage not in self._tasks:
            self._tasks[stage] = self._bars.add_task(words, total=total)
        self._bars.update(self._tasks[stage], completed=done)
