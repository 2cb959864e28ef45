"""The exceptions of viscofric; every message is one clear sentence."""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Self

from viscofric.notes import Note, Reader, Remedy, codes, note_of, without

_LONGEST = 80
#: Limit of the message of an error, or of a note; longer ones quote a file or list many mistakes.
LONGEST_SENTENCE = 500
_LONGEST_LINE = 160  # of a long list
#: Limit of a list that is printed with a line for each.
_MOST_SENTENCES = 20


def brief(value: object) -> str:
    """Return the representation of a value, on one line and cut if too long for a sentence."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def shortened(text: str) -> str:
    """Return a text of limited length.

    A long sentence is cut in its middle, since its end contains the remedy.  Of a list with a sentence on each line,
    the first ones are kept, and the others counted.
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


def short_notes(notes: Iterable[str]) -> tuple[Note, ...]:
    """Return notes, each of limited length."""
    return tuple(note_of(note).reworded(shortened) for note in notes)


def not_imported(package: str, error: Exception, install: str = "") -> str:
    """Return a clause on a package that is not installed (with the command that installs it), or not importable."""
    if isinstance(error, ModuleNotFoundError) and (error.name or "").partition(".")[0] == package:
        return f"{package} is not installed" + (f": {install}" if install else "")
    why = f"{type(error).__name__}: {error}"
    hint = "a file of yours may have the name of a package, such as dask.py, and replace it"
    return f"{package} is installed, but cannot be imported ({why}); {hint}"


def check_choice(value: object, name: str, *choices: str) -> None:
    """Raise `InputError` unless a value is one of the choices."""
    if not isinstance(value, str) or value not in choices:
        *others, last = map(repr, choices)
        raise wrong_argument(name, value, f"must be {', '.join(others)} or {last}.", "wrong-choice")


class ViscofricError(Exception):
    """Base of all errors that viscofric raises on purpose.

    Parameters
    ----------
    message : str or Note
        One sentence; a note brings its code and its remedy.
    code : str, optional
        For programs, where the message is no note; see `viscofric.notes.Note`.
    remedy : Remedy, optional
        Ends the sentence, in the words of each reader, where the message is no note.
    field : str, optional
        Path of the run file's key that the error is about; by default that of the remedy.
    values : mapping, optional
        For programs, where the message is no note; see `viscofric.notes.Note`.

    Attributes
    ----------
    note : Note
        The sentence with its code, place and remedy.
    solved : FrictionCurves or None
        What was solved in spite of the error, by `predict_friction`; None if nothing was.
    """

    solved: Any = None

    def __init__(
        self,
        message: str | Note = "",
        *,
        code: str = "",
        remedy: Remedy | None = None,
        field: str | None = None,
        values: Mapping[str, Any] | None = None,
    ) -> None:
        note = message if isinstance(message, Note) else Note(code, str(message), remedy=remedy, values=values)
        self.note, self._field = note.reworded(shortened), field
        super().__init__(self.words("python"))

    @property
    def code(self) -> str:
        """The kind of the error, for programs; may be empty."""
        return self.note.code

    @property
    def remedy(self) -> Remedy | None:
        """What to do, in the words of each reader."""
        return self.note.remedy

    @property
    def field(self) -> str | None:
        """Path of the run file's key that it concerns, or that the remedy changes, such as ``conditions.load``."""
        return self._field or (None if self.remedy is None else self.remedy.field)

    def words(self, reader: Reader) -> str:
        """Return the message in the words of a reader."""
        return shortened(self.note.words(reader))

    def listing(self, reader: Reader = "python") -> str:
        """Return the message; a list of mistakes is longer than in the message, one to a line."""
        return self.words(reader)

    def reworded(self, change: Callable[[str], str]) -> Self:
        """Return the error with its text changed, such as with the user's own file names."""
        return self.with_note(self.note.reworded(change))

    def at(self, where: str) -> Self:
        """Return the error with the place named before its sentence."""
        return self.with_note(self.note.at(where))

    def with_note(self, note: Note) -> Self:
        """Return the error with another note."""
        other = copy.copy(self)
        other.note = note
        other.args = (other.words("python"),)
        return other


class InputError(ViscofricError, ValueError):
    """A value given to viscofric cannot be used: wrong unit, sign, range or shape."""


def wrong_argument(name: str, value: object, problem: str, code: str, field: str | None = None) -> InputError:
    """Return the error of an argument's value; its note has the name, for readers who typed an option instead."""
    return InputError(f"{name} = {brief(value)}: {problem}", code=code, field=field, values={"argument": name})


class DataFileError(InputError):
    """A data file cannot be read.

    Parameters
    ----------
    path : str
        The file, as the user named it.
    problem : str or Note
        The problem and the remedy, without the file's name.
    row : int, optional
        Line of the file, counted from 1.
    code, remedy, values : optional
        As for `ViscofricError`.
    """

    def __init__(
        self,
        path: object,
        problem: str | Note,
        row: int | None = None,
        *,
        code: str = "",
        remedy: Remedy | None = None,
        values: Mapping[str, Any] | None = None,
    ) -> None:
        self.path, self.row = str(path), row
        note = problem if isinstance(problem, Note) else Note(code, problem, remedy=remedy, values=values)
        super().__init__(note.at(self.path if row is None else f"{self.path}, line {row}"))

    @property
    def problem(self) -> str:
        """The problem, without the file's name."""
        return str(Note(self.code, self.note.text, remedy=self.remedy))

    def reworded(self, change: Callable[[str], str]) -> Self:
        """Return the error with its path and its text changed."""
        other = super().reworded(change)
        other.path = change(self.path)
        return other

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.path, self.problem, self.row), self.__dict__


def not_needed(path: object, name: str, code: str, problem: str, after: str = "") -> DataFileError:
    """Return the error of an argument that a file does not need, with the advice to leave it out."""
    return DataFileError(path, f"{problem}; ", code=code, remedy=without(name, after), values={"argument": name})


def not_written(path: object, error: Exception) -> DataFileError:
    """Return the error of a file that cannot be written: the disk is full, the folder read-only, or removed."""
    number = getattr(error, "errno", None)
    why = os.strerror(number) if number else error
    return DataFileError(path, f"cannot be written ({why}).", code="not-written")


class StudyError(InputError):
    """A run file is wrong or cannot be run; the message names the file and the field.

    Parameters
    ----------
    problem : str or Note
        One sentence; of several mistakes, the file and their number.
    mistakes : sequence of str
        One sentence each; of notes, the place is the path of a key.  All are kept here; the message contains as many as
        fit.
    code, remedy, field : optional
        As for `ViscofricError`; the field is by default the place of the first mistake, or that of the sentence.
    """

    def __init__(
        self,
        problem: str | Note = "",
        mistakes: Sequence[str] = (),
        *,
        code: str = "",
        remedy: Remedy | None = None,
        field: str | None = None,
    ) -> None:
        self.mistakes = tuple(note_of(one).reworded(lambda text: _cut(text, LONGEST_SENTENCE)) for one in mistakes)
        super().__init__(problem, code=code, remedy=remedy, field=field)

    @property
    def code(self) -> str:
        """The kind of the error, or of its only mistake; ``"several-mistakes"`` if there are more."""
        return super().code or ("several-mistakes" if len(self.mistakes) > 1 else "".join(codes(self.mistakes)))

    @property
    def field(self) -> str | None:
        """Path of the run file's key that it is about, such as ``conditions.load``."""
        return super().field or (self.mistakes[0].where if self.mistakes else self.note.where) or None

    def words(self, reader: Reader) -> str:
        """Return the message in the words of a reader; of several mistakes, each on a line."""
        found = [self.note.words(reader), *(one.words(reader) for one in self.mistakes)]
        return shortened((" " if len(found) == 2 else "\n  ").join(found))

    def listing(self, reader: Reader = "python") -> str:
        """Return the message with its mistakes, one to a line, as many as can be read at once."""
        more = len(self.mistakes) - _MOST_SENTENCES
        if len(self.mistakes) < 2:
            return self.words(reader)
        lines = [f"  {one.words(reader)}" for one in self.mistakes[:_MOST_SENTENCES]]
        return "\n".join([self.note.words(reader), *lines, *([_and_more(more)] if more > 0 else [])])

    def reworded(self, change: Callable[[str], str]) -> Self:
        """Return the error with its text, and those of its mistakes, changed."""
        other = super().reworded(change)
        other.mistakes = tuple(one.reworded(change) for one in self.mistakes)
        other.args = (other.words("python"),)
        return other


class SuperpositionError(InputError):
    """The isotherms cannot be joined into one master curve."""


class LiquidError(InputError):
    """A material flows where a solid, with a relaxed modulus E0 above zero, is needed."""


class ConvergenceError(ViscofricError, RuntimeError):
    """An iterative solution did not reach its tolerance; it is never returned as if it had."""
