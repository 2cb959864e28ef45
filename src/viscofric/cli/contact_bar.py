"""A bar that shows on a terminal how many contacts are solved; nothing where nobody looks."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator


class Bar(Protocol):
    """Shows how far things are."""

    def __call__(self, done: int, total: int, words: str = "") -> None:
        """Show that so many contacts of all are solved, and if given what is done."""


@contextmanager
def contact_bar(words: str, *, quiet: bool) -> Iterator[Bar]:
    """Show a bar on standard error as long as the block runs, if that is a terminal.

    Parameters
    ----------
    words : str
        What is done.
    quiet : bool
        Show none anyway.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(bar_width=24), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True, disable=quiet or not console.is_terminal) as bars:
        task = bars.add_task(words, total=None)

        def tell(done: int, total: int, words: str = words) -> None:
            bars.update(task, description=words, completed=done, total=total)

        yield tell
