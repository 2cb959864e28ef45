"""The few exceptions that users of viscofric meet; every message is one clear sentence."""

from __future__ import annotations

_LONGEST = 80


def brief(value: object) -> str:
    """Return how Python writes a value, on one line and cut where it is too long for a sentence."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def check_choice(value: object, name: str, *choices: str) -> None:
    """Raise `InputError` unless a value is one of the choices."""
    if not isinstance(value, str) or value not in choices:
        *others, last = map(repr, choices)
        raise InputError(f"{name} = {brief(value)}: must be {', '.join(others)} or {last}.")


class ViscofricError(Exception):
    """Base of all errors that viscofric raises on purpose."""


class InputError(ViscofricError, ValueError):
    """A value given to viscofric cannot be used: wrong unit, sign, range or shape."""


class DataFileError(InputError):
    """A data file cannot be read as what it should be.

    Parameters
    ----------
    path : str
        The file, as the user named it.
    problem : str
        What is wrong and what would be right, without the file's name.
    row : int, optional
        Line of the file, counted from 1, where the trouble sits.
    """

    def __init__(self, path: object, problem: str, row: int | None = None) -> None:
        self.path = str(path)
        self.problem = problem
        self.row = row
        where = self.path if row is None else f"{self.path}, line {row}"
        super().__init__(f"{where}: {problem}")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.path, self.problem, self.row)


class StudyError(InputError):
    """A run file asks for something that cannot be done; names the file and the field."""


class SuperpositionError(InputError):
    """The isotherms cannot be joined into one master curve."""


class LiquidError(InputError):
    """A material flows where a solid, with a relaxed modulus E0 above zero, is needed."""


class ConvergenceError(ViscofricError, RuntimeError):
    """An iterative solution did not reach its tolerance; it is never returned as if it had."""
