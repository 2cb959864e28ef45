"""What the command line tells of errors and doubts: one sentence each, no traceback."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    import xarray


@contextmanager
def told() -> Iterator[None]:
    """Turn what viscofric raises on purpose into a message and exit status 1."""
    from viscofric.errors import ViscofricError

    try:
        yield
    except ViscofricError as error:
        raise click.ClickException(str(error)) from error


def tell_doubts(tree: xarray.DataTree, but: Iterable[str] = ()) -> None:
    """Print every check of results that did not pass, as a warning, but those named; the report has them all."""
    from viscofric.report.checks import all_checks
    from viscofric.report.messages import readable

    for check in all_checks(tree):
        if check.verdict in ("look at this", "failed") and check.name not in but:
            click.echo(f"Warning: {check.name}: {readable(check.words)}", err=True)


def refuse_to_overwrite(target: Path, inputs: Iterable[Path]) -> None:
    """Stop where a file to be written is one that is read: measurements are not to be lost."""
    if any(target.resolve() == path.resolve() for path in inputs):
        raise click.ClickException(f"{target} is an input and would be overwritten; choose another name.")
