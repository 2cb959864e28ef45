"""The few exceptions that users of viscofric meet; every message is one clear sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

_LONGEST = 80
#: Of the message of an error, or of a note; what is longer quotes a file or lists many mistakes.
LONGEST_SENTENCE = 500
_LONGEST_LINE = 160  # of a list, where there are too many for longer ones
#: Of a list that is printed with a line for each.
_MOST_SENTENCES = 20


def brief(value: object) -> str:
    """Return how Python writes a value, on one line and cut where it is too long for a sentence."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def shortened(text: str) -> str:
    """Return a text of bearable length.

    A long sentence is cut in its middle, as it says at its end what to do.  Of a list with a sentence on each line, the
    first ones are kept, and the others counted.
    """
    if len(text) <= LONGEST_SENTENCE:
        return text
    head, *lines = text.split("\n")
    if not lines:
        return _cut(head, LONGEST_SENTENCE)
    kept = [_cut(head, LONGEST_SENTENCE // 2)]
    left = LONGEST_SENTENCE - len(kept[0]) - len(_and_more(len(lines)))
    longest = max(_LONGEST_LINE, left // len(lines) - 1)
    for number, line in enumerate(lines):
        shown = _cut(line, longest)
        left -= len(shown) + 1
        if left < 0:
            return "\n".join([*kept, _and_more(len(lines) - number)])
        kept.append(shown)
    return "\n".join(kept)


def _cut(line: str, longest: int) -> str:
    end = 2 * longest // 5
    return line if len(line) <= longest else f"{line[: longest - end - 3]} … {line[-end:]}"


def _and_more(count: int) -> str:
    return f"  … and {count} more."


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

    @property
    def listing(self) -> str:
        """The message; where it lists mistakes, with more of them than a message holds, one to a line."""
        return str(self)


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
    """A run file asks for something that cannot be done; names the file and the field.

    Parameters
    ----------
    problem : str
        One sentence; of several mistakes, the file and their number.
    mistakes : sequence of str
        One sentence each.  All are kept here; the message has as many lines as it has room for.
    """

    def __init__(self, problem: str, mistakes: Sequence[str] = ()) -> None:
        self.mistakes = tuple(_cut(mistake, LONGEST_SENTENCE) for mistake in mistakes)
        self._problem = problem
        super().__init__("\n  ".join([problem, *mistakes]))

    @property
    def listing(self) -> str:
        """The message with its mistakes, one to a line, as many as can be read at once."""
        if not self.mistakes:
            return str(self)
        more = len(self.mistakes) - _MOST_SENTENCES
        lines = [f"  {mistake}" for mistake in self.mistakes[:_MOST_SENTENCES]]
        return "\n".join([self._problem, *lines, *([_and_more(more)] if more > 0 else [])])


class SuperpositionError(InputError):
    """The isotherms cannot be joined into one master curve."""


class LiquidError(InputError):
    """A material flows where a solid, with a relaxed modulus E0 above zero, is needed."""


class ConvergenceError(ViscofricError, RuntimeError):
    """An iterative solution did not reach its tolerance; it is never returned as if it had."""
