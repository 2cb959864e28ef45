"""The few exceptions that users of viscofric meet; every message is one clear sentence."""

from __future__ import annotations

_LONGEST = 80
#: Of a sentence of an error or note; what is longer quotes a file, and is cut in its middle.
LONGEST_SENTENCE = 500
_LONGEST_END = 200  # of it, kept from the end, where the sentence says what to do
#: Of one error, where it lists all that is wrong.
_MOST_SENTENCES = 20


def brief(value: object) -> str:
    """Return how Python writes a value, on one line and cut where it is too long for a sentence."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def shortened(text: str) -> str:
    """Return a sentence of bearable length, and of a list of sentences, one to a line, a bearable number."""
    if len(text) <= LONGEST_SENTENCE and text.count("\n") < _MOST_SENTENCES:
        return text
    lines = text.split("\n", _MOST_SENTENCES)
    if len(lines) > _MOST_SENTENCES:
        lines[-1] = f"  … and {lines[-1].count(chr(10)) + 1} more."
    cut = [
        line
        if len(line) <= LONGEST_SENTENCE
        else f"{line[: LONGEST_SENTENCE - _LONGEST_END - 3]} … {line[-_LONGEST_END:]}"
        for line in lines
    ]
    return "\n".join(cut)


def not_imported(package: str, error: Exception, install: str = "") -> str:
    """Return a clause on a package that is not there, or that cannot be imported, which is another matter.

    Parameters
    ----------
    package : str
    error : Exception
        That importing it raised.
    install : str
        What installs it.
    """
    if isinstance(error, ModuleNotFoundError) and (error.name or "").partition(".")[0] == package:
        return f"{package} is not installed" + (f": {install}" if install else "")
    why = f"{type(error).__name__}: {error}"
    hint = "a file of yours may have the name of a package, such as dask.py, and stand in for it"
    return f"{package} is installed, but cannot be imported ({why}); {hint}"


def check_choice(value: object, name: str, *choices: str) -> None:
    """Raise `InputError` unless a value is one of the choices."""
    if not isinstance(value, str) or value not in choices:
        *others, last = map(repr, choices)
        raise InputError(f"{name} = {brief(value)}: must be {', '.join(others)} or {last}.")


class ViscofricError(Exception):
    """Base of all errors that viscofric raises on purpose."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*(shortened(one) if isinstance(one, str) else one for one in arguments))


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
        self.problem = shortened(problem)
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
