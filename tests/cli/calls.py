"""Calls of the command line: what it prints, and its refusals by what they are about."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import pytest
from click.testing import CliRunner, Result

from viscofric.cli import main
from viscofric.errors import ViscofricError


def call(*words: object, given: str | bytes | None = None) -> Result:
    """Call the program, however it ends; `given` is its standard input."""
    return CliRunner().invoke(main, [*map(str, words)], input=given)


def succeed(*words: object, given: str | bytes | None = None) -> Result:
    """Call the program, which must succeed."""
    done = call(*words, given=given)
    assert done.exit_code == 0, done.output
    return done


def record(*words: object) -> dict[str, Any]:
    """Return what the program prints as JSON, in which there is no NaN."""
    found: dict[str, Any] = json.loads(
        succeed(*words, "--json").stdout, parse_constant=lambda name: pytest.fail(f"{name} is no JSON")
    )
    return found


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
    return refusal_of(call(*words, given=given))


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
