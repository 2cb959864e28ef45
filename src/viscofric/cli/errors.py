"""Errors, warnings and notes on the command line: one sentence each, no traceback."""

from __future__ import annotations

import copy
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import click

from viscofric.cli.files import plainly
from viscofric.cli.keys import KeyOption
from viscofric.datasets import DataTree

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from viscofric.errors import ViscofricError
    from viscofric.notes import Note, Reader, Remedy


def words_of(error: ViscofricError, reader: Reader = "shell") -> str:
    """Return the message of an error; for users of commands, with their options."""
    return plainly((_with_options(error) if reader == "shell" else error).listing(reader))


@contextmanager
def typed_as(parameters: Mapping[str, str]) -> Iterator[None]:
    """Have errors name the options of this command's parameters instead of arguments: argument -> parameter."""
    from viscofric.errors import ViscofricError

    try:
        yield
    except ViscofricError as error:
        parameter = parameters.get(error.note.values.get("argument", ""))
        raise (error if parameter is None else error.with_note(error.note.valued(parameter=parameter))) from None


@contextmanager
def placed_at(option: str) -> Iterator[None]:
    """Have errors name an option as their place."""
    from viscofric.errors import ViscofricError

    try:
        yield
    except ViscofricError as error:
        raise error.at(option) from None


#: Argument of Python or key of a run file -> parameters of commands that give it, where they are named otherwise and
#: no `KeyOption` says so.
_TYPED_AS = {
    "radius": ("ball", "cylinder", "punch"),
    "radius_x": ("ellipsoid",),
    "radius_y": ("ellipsoid",),
    "angle": ("cone",),
    "thickness of the layer": ("layer",),
    "E0": ("rubber_modulus",),
    "E_inf": ("glass_modulus",),
    "heights": ("height_map", "profile"),
    "contact_area": ("anchor_area",),
    "error of the anchor": ("anchor_error",),
    "standard error of zero": ("zero_error",),
    "standard error of coulomb": ("coulomb_error",),
    "height unit": ("height_unit",),
    "sheet": ("history_sheet", "shift_factor_sheet"),
    "fixed_shift_factors": ("fix",),
    "temperatures": ("temperature",),
    **dict.fromkeys(("track_radius", "passes"), ("heating_track",)),
}


def _with_options(error: ViscofricError) -> ViscofricError:
    """Return an error with the options that were typed instead of arguments of Python and keys of run files."""
    from viscofric.errors import StudyError

    if isinstance(error, StudyError) and error.mistakes:
        other = copy.copy(error)
        other.mistakes = tuple(_of_option(one, _key(one.where)) for one in error.mistakes)
        return other
    name = error.note.values.get("argument") or (error.note.where if isinstance(error, StudyError) else "")
    return error.with_note(_of_option(error.note, _key(name)))


def _key(place: str) -> str:
    """Return the last key of a path, without the number of an item."""
    return place.rpartition(".")[2].partition("[")[0]


def _of_option(note: Note, name: str) -> Note:
    """Return a note on an argument or a key as one on the option of this command that gave it, if one did."""
    from viscofric.notes import Note

    option = typed_option(name, note.values.get("parameter"))
    renamed = _renamed() if option is None else _renamed() | {_option(name): option}
    remedy = _possible(note)
    for named, typed in renamed.items():
        if remedy is not None:
            remedy = remedy.reworded(partial(_replaced, named, typed))
    text, where = note.text, note.where
    if option is not None:
        where = option if _key(where) == name else where
        if text.startswith((f"{name} = ", f"{name}: ")):
            text = option + text.removeprefix(name)
    return Note(note.code, text, where, remedy, note.values)


def _possible(note: Note) -> Remedy | None:
    """Return the remedy of a note; where this command has no option that names columns, another one."""
    from viscofric.readers.headings import option_of

    ctx, remedy = click.get_current_context(silent=True), note.remedy
    if ctx is None or remedy is None or not (remedy.field or "").endswith("columns"):
        return remedy
    if option_of(remedy.field or "") in {typed for one in ctx.command.params for typed in one.opts}:
        return remedy
    return replace(remedy, shell="." if note.code == "ambiguous-columns" else "; rename them in the file.")


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _replaced(option: str, other: str, said: str) -> str:
    words = (word.replace(option, other) if word.rstrip(".,;:)") == option else word for word in said.split(" "))
    return " ".join(words)


def _renamed() -> dict[str, str]:
    """Return the options of this command that are named otherwise than the keys of run files that they give."""
    ctx = click.get_current_context(silent=True)
    params = [] if ctx is None else ctx.command.params
    known = {one.name: _typed(one) for one in params}
    names = {key: name for key, some in _TYPED_AS.items() for name in some if name in known}
    names |= {one.key.key: one.name or "" for one in params if isinstance(one, KeyOption)}
    return {_option(key): known[name] for key, name in names.items() if known.get(key) != _option(key)}


def typed_option(name: str, parameter: str | None = None) -> str | None:
    """Return the option of the running command that gives an argument or a key, as it was typed; None without one."""
    ctx = click.get_current_context(silent=True)
    if ctx is None:
        return None
    wanted: tuple[str | None, ...] = (parameter,)
    if parameter is None:
        keys = [one.name for one in ctx.command.params if isinstance(one, KeyOption) and one.key.key == name]
        wanted = (name, f"{name}s", *keys, *_TYPED_AS.get(name, ()))
    given = [one for one in ctx.command.params if one.name in wanted and ctx.params.get(one.name) not in (None, ())]
    return next((_typed(one) for one in given if isinstance(one, click.Option) or parameter is not None), None)


def _typed(parameter: click.Parameter) -> str:
    return max(parameter.opts, key=len) if isinstance(parameter, click.Option) else parameter.human_readable_name


def print_doubtful_checks(tree: DataTree, but: Iterable[str] = ()) -> None:
    """Print every check of results that did not pass, but for these, as a warning; the report has them all."""
    from viscofric.notes import note_of
    from viscofric.report.texts.checks import all_checks

    left_out = tuple(but)
    for check in all_checks(tree):
        if check.verdict in ("warning", "failed") and not check.name.startswith(left_out):
            click.echo(f"Warning: {check.name}: {note_of(check.sentence).words('shell')}", err=True)


def print_notes(notes: Iterable[str], reader: Reader = "shell", *, word: str = "Note") -> None:
    """Print notes on the data, on standard error, in the words of a reader; each once, doubts as warnings."""
    from viscofric.notes import note_of
    from viscofric.rheology.spectra.quality import DOUBTS

    ctx = click.get_current_context(silent=True)
    said: set[str] = set() if ctx is None else ctx.meta.setdefault(__name__, set())
    for note in map(note_of, notes):
        if note not in said:
            begun = "Warning" if note.code.startswith(DOUBTS) else word
            click.echo(f"{begun}: {plainly(note.words(reader))}", err=True)
        said.add(note)
