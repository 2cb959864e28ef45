"""Refusals of the command line by what they are about."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from click.testing import CliRunner

from viscofric.cli import main
from viscofric.errors import ViscofricError

if TYPE_CHECKING:
    from click.testing import Result


class Refusal(NamedTuple):
    """What a command that failed says.

    Attributes
    ----------
    status : int
        Exit status: 2 of options that do not belong together, 1 of anything else.
    code, field : str
        Of viscofric's error behind it; empty if there is none.
    sentence : str
        On standard error, after ``Error:``.
    """

    status: int
    code: str
    field: str
    sentence: str


def refusal(*words: object, given: str | bytes | None = None) -> Refusal:
    """Call the program, which must refuse in one sentence, without a traceback."""
    return refusal_of(CliRunner().invoke(main, [*map(str, words)], input=given))


def refusal_of(result: Result) -> Refusal:
    """Return the refusal of a call, which must be one sentence, without a traceback."""
    assert result.exit_code in (1, 2), result.output
    assert "Traceback" not in result.output
    _, *more = result.stderr.split("Error: ")
    assert len(more) == 1, result.output
    error: BaseException | None = result.exception
    while error is not None and not isinstance(error, ViscofricError):
        error = error.__cause__ or error.__context__
    code, field = ("", "") if error is None else (error.code, error.field or "")
    return Refusal(result.exit_code, code, field, more[0].removesuffix("\n"))
