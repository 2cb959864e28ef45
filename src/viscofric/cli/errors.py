"""Errors, warnings and notes on the command line: one sentence each, no traceback."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from viscofric.cli.files import plainly

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import xarray

    from viscofric.notes import Reader


@contextmanager
def reported_errors(reader: Reader = "shell") -> Iterator[None]:
    """Turn what viscofric raises on purpose into a message and exit status 1.

    Parameters
    ----------
    reader : str
        In whose words remedies are: ``"run_file"`` where what is wrong is mended there.
    """
    from viscofric.errors import ViscofricError

    try:
        yield
    except ViscofricError as error:
        raise click.ClickException(plainly(error.listing(reader))) from error


def print_doubtful_checks(tree: xarray.DataTree, but: Iterable[str] = ()) -> None:
    """Print every check of results that did not pass, as a warning; the report has them all.

    Parameters
    ----------
    tree : xarray.DataTree
        The results.
    but : iterable of str
        Checks that are left out, by their names; of several rubbers, that of each follows the name.
    """
    from viscofric.report.texts.checks import all_checks

    left_out = tuple(but)
    for check in all_checks(tree):
        if check.verdict in ("warning", "failed") and not check.name.startswith(left_out):
            click.echo(f"Warning: {check.name}: {check.sentence}", err=True)


def print_notes(notes: Iterable[str], reader: Reader = "shell") -> None:
    """Print notes on the data, on standard error, in the words of a reader."""
    from viscofric.notes import note_of

    for note in notes:
        click.echo(f"Note: {plainly(note_of(note).words(reader))}", err=True)
