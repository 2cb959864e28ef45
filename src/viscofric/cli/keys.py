"""Options that give keys of a run file: their choices, defaults and help are those of its tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.notes import Note

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

#: Table of a run file -> its module, if that has another name.
_HOMES = {"impact": "history", "solver": "settings"}


class Key(click.types.StringParamType):
    """A key of a run file, such as ``material.shift_by``, as the type of an option.

    Its table is imported when a value or the help needs it: that takes longer than all else of a command's start.
    """

    def __init__(self, place: str) -> None:
        self.table, _, self.key = place.partition(".")

    @cached_property
    def about(self) -> dict[str, Any]:
        """The key in the JSON schema of its table."""
        # One module: importing all tables takes a second.
        home = import_module(f"viscofric.study.run_file.{_HOMES.get(self.table, self.table)}")
        table = getattr(home, f"{self.table.capitalize()}Table")
        found: dict[str, Any] = table.model_json_schema()["properties"][self.key]
        return {**found, **found.get("anyOf", [{}])[0]}

    @property
    def _kind(self) -> click.ParamType[Any]:
        """What is checked of a value here; the table checks the rest."""
        if "enum" in self.about:
            return click.Choice(self.about["enum"])
        kinds: dict[str, click.ParamType[Any]] = {"number": click.FLOAT, "integer": click.INT}
        return kinds.get(self.about.get("type", ""), click.STRING)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the value for the table."""
        return self._kind.convert(value, param, ctx)

    def get_metavar(self, param: click.Parameter, ctx: click.Context) -> str:
        """Return the choices, or the kind of the value."""
        return self._kind.get_metavar(param, ctx) or self._kind.name.upper()

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the choices that begin so."""
        return self._kind.shell_complete(ctx, param, incomplete)


class KeyOption(click.Option):
    """An option that gives a key of a run file, whose description and default its help has, unless it has its own."""

    def __init__(self, *args: Any, place: str, condition: str = "", **extra: Any) -> None:
        self.key, self.condition = Key(place), condition
        super().__init__(*args, **{"type": self.key, **extra})

    def get_help_record(self, ctx: click.Context) -> tuple[str, str] | None:
        """Return how the option is typed, and its help."""
        if self.help is None:
            about = self.key.about
            words, default = str(about["description"]).removesuffix("."), about.get("default")
            words = self.condition + words[0].lower() + words[1:] if self.condition else words
            example = next(iter(about.get("examples", ())), default)
            self.help = words + ("." if example == default else f", e.g. '{example}'.")
            if default and isinstance(default, (int, float, str)):
                self.help += f" [default: {default if isinstance(default, str) else format(default, '.4g')}]"
        return super().get_help_record(ctx)


def key(place: str, *names: str, **extra: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds an option of a key of a run file, of its name unless others are given."""
    typed = f"--{place.partition('.')[2].replace('_', '-')}"
    return click.option(*(names or (typed,)), cls=KeyOption, place=place, **extra)


def keys_given(table: str, parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a table of a run file that parameters of the running command give."""
    given = {name: parameters.get(parameter) for name, parameter in _parameters(table).items()}
    return {name: _in_file(value) for name, value in given.items() if value is not None and value not in ((), {})}


def table_of(table: str, parameters: Mapping[str, Any], **others: Any) -> Any:
    """Return the table of a run file that parameters of the running command give, with other keys, validated."""
    from viscofric.errors import StudyError
    from viscofric.study.run_file.study import TABLES, validated

    names = _parameters(table)

    def of_option(note: Note) -> Note:
        """Say which option a note is about: another one may have the name of the key."""
        return note.valued(parameter=names.get(note.where.partition("[")[0]))

    try:
        return validated(TABLES[table], keys_given(table, parameters) | others)
    except StudyError as error:
        wrong = error.with_note(of_option(error.note))
        wrong.mistakes = tuple(map(of_option, error.mistakes))
        raise wrong from None


def _parameters(table: str) -> dict[str, str]:
    """Return the parameters of the running command that give keys of a table, by these keys."""
    options = [one for one in click.get_current_context().command.params if isinstance(one, KeyOption)]
    return {one.key.key: one.name or "" for one in options if one.key.table == table}


def _in_file(value: Any) -> Any:
    """Return a value as a run file holds it."""
    return list(map(_in_file, value)) if isinstance(value, tuple) else str(value) if isinstance(value, Path) else value
