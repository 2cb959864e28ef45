"""Commands: an error is one sentence, and the help has its options under headings."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.errors import words_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from viscofric.notes import Reader

#: Exit statuses of studies of which some cases failed, and of results that are not to the requested accuracy.
SOME_CASES_FAILED, NOT_ACCURATE = 3, 4

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]

#: Options that stand under a heading of their own in the help.
_HEADINGS: dict[click.Parameter, str] = {}
_OTHERS = "Options"  # heading of all others
#: Headings that several commands have.
CONDITIONS, CONTACT = "Conditions", "Contact"


class _NotAccurateError(click.ClickException):
    """What did not converge to the requested accuracy."""

    exit_code = NOT_ACCURATE


class Command(click.Command):
    """A command whose errors are printed in the words of its reader: of options, or of run files."""

    def __init__(self, *args: Any, reader: Reader = "shell", **extra: Any) -> None:
        super().__init__(*args, **extra)
        self.reader: Reader = reader

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the words of the command line; an option with one value that is given twice is an error."""
        if not ctx.resilient_parsing:
            _, _, order = self.make_parser(ctx).parse_args(args=list(args))
            for one in self.params:
                single = isinstance(one, click.Option) and not (one.is_flag or one.multiple)
                if single and (times := order.count(one)) > 1:
                    said = f"{' / '.join(one.opts)} is given {times} times; give it once"
                    raise click.UsageError(f"{said} (several values as one list, where --help says so).", ctx)
        try:
            return super().parse_args(ctx, args)
        except click.MissingParameter as error:
            if not isinstance(error.param, click.Option):
                raise
            raise click.MissingParameter(error.param.help, ctx, error.param) from None  # what it is, with an example

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; what viscofric raises on purpose becomes a message, and exit status 1 or `NOT_ACCURATE`."""
        from viscofric.errors import ConvergenceError, ViscofricError

        try:
            return super().invoke(ctx)
        except ViscofricError as error:
            notes = getattr(error, "mistakes", ()) or (error.note,)
            if all(one.code == "contradiction" and "parameter" in one.values for one in notes):  # of options
                raise click.UsageError(words_of(error, self.reader), ctx) from error
            kind = _NotAccurateError if isinstance(error, ConvergenceError) else click.ClickException
            raise kind(words_of(error, self.reader)) from error

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options under their headings: first those with required ones, last those of no heading."""
        sections: dict[str, list[click.Option]] = {}
        for one in self.get_params(ctx):
            if isinstance(one, click.Option):
                sections.setdefault(_HEADINGS.get(one, _OTHERS), []).append(one)

        def place(heading: str) -> tuple[bool, bool]:
            return not any(one.required for one in sections[heading]), heading == _OTHERS

        for heading in sorted(sections, key=place):
            ordered = sorted(sections[heading], key=lambda one: not one.required)
            with formatter.section(heading):
                formatter.write_dl([row for one in ordered if (row := one.get_help_record(ctx)) is not None])


def exit_if_beyond(accuracy: float, friction: ArrayLike, error: ArrayLike) -> None:
    """Warn of friction whose estimated error exceeds the accuracy, and end the command with `NOT_ACCURATE`."""
    from viscofric.contact.free.estimates import beyond_accuracy

    beyond = beyond_accuracy(friction, error, accuracy)
    if beyond.any():
        points = f"{beyond.sum()} of {beyond.size} points have" if beyond.size > 1 else "The result has"
        click.echo(f"Warning: {points} an estimated error beyond --accuracy {accuracy:g}.", err=True)
        click.get_current_context().exit(NOT_ACCURATE)


def as_command(
    name: str, *, epilog: str | None = None, reader: Reader = "shell"
) -> Callable[[Callable[..., Any]], Command]:
    """Return a decorator that makes a function a `Command`."""
    return click.command(name=name, cls=Command, epilog=epilog, reader=reader)


def quantity(typed: str, metavar: str, words: str, **how: Any) -> Decorator:
    """Return a decorator that adds an option of a quantity: text with a unit."""
    return click.option(typed, metavar=metavar, help=words, **how)


def together(*options: Decorator, heading: str = "") -> Decorator:
    """Return a decorator that adds several options, in the order of the help, under a heading if one is given."""

    def add(function: Callable[..., Any]) -> Callable[..., Any]:
        before = len(getattr(function, "__click_params__", ()))
        for option in reversed(options):
            function = option(function)
        if heading:
            _HEADINGS.update(dict.fromkeys(getattr(function, "__click_params__", ())[before:], heading))
        return function

    return add
