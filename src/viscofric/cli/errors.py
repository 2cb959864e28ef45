"""Errors, warnings and notes on the command line: one sentence each, no traceback."""

from __future__ import annotations

import copy
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from viscofric.cli.files import plainly

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import xarray

    from viscofric.errors import ViscofricError
    from viscofric.notes import Note, Reader


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
        shown = _with_options(error) if reader == "shell" else error
        raise click.ClickException(plainly(shown.listing(reader))) from error


#: Argument of Python or key of a run file -> parameters of commands that give it, where they are named otherwise.
_TYPED_AS = {
    "radius": ("ball", "cylinder", "punch"),
    "radius_x": ("ellipsoid",),
    "radius_y": ("ellipsoid",),
    "angle": ("cone",),
    "thickness of the layer": ("layer",),
    "reference_temperature": ("reference",),
    "E0": ("rubber_modulus",),
    "E_inf": ("glass_modulus",),
    "heights": ("height_map", "profile"),
    "contact_area": ("anchor_area",),
}


def _with_options(error: ViscofricError) -> ViscofricError:
    """Return an error with the options that were typed instead of arguments of Python and keys of run files."""
    from viscofric.errors import StudyError

    if isinstance(error, StudyError) and error.mistakes:
        other = copy.copy(error)
        other.mistakes = tuple(_of_option(one, one.where.rpartition(".")[2]) for one in error.mistakes)
        return other
    name = error.note.values.get("argument") or (error.note.where if isinstance(error, StudyError) else "")
    return error.with_note(_of_option(error.note, name.rpartition(".")[2])) if name else error


def _of_option(note: Note, name: str) -> Note:
    """Return a note on an argument or a key as one on the option of this command that gave it, if one did."""
    from viscofric.notes import Note

    option = typed_option(name)
    if option is None:
        return note
    text = f"{option} = {note.text.removeprefix(f'{name} = ')}" if note.text.startswith(f"{name} = ") else note.text
    where = option if note.where.rpartition(".")[2] == name else note.where
    return Note(note.code, text, where, note.remedy, note.values)


def typed_option(name: str) -> str | None:
    """Return the option of the running command that gives an argument or a key, as it was typed; None without one."""
    ctx = click.get_current_context(silent=True)
    if ctx is None:
        return None
    wanted = (name, f"{name}s", *_TYPED_AS.get(name, ()))
    given = [one for one in ctx.command.params if one.name in wanted and ctx.params.get(one.name) not in (None, ())]
    return next((max(one.opts, key=len) for one in given if isinstance(one, click.Option)), None)


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
