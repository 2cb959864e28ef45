"""A note: a sentence about a result, with a code by which programs and tests recognise it."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


class Note(str):
    """One sentence for people, with a code for programs.

    A note is text, so it prints, joins and is stored as its sentence; nothing needs to read the sentence to know what
    it is about.

    Parameters
    ----------
    code : str
        What the note is about, in lower case with hyphens, such as ``"few-replicates"``. Codes stay the same when a
        sentence is reworded.
    text : str
        The sentence.

    Attributes
    ----------
    code : str
        As given.
    """

    code: str

    def __new__(cls, code: str, text: str) -> Note:
        """Return the sentence with its code."""
        note = super().__new__(cls, text)
        note.code = code
        return note

    def __getnewargs__(self) -> tuple[str, str]:  # type: ignore[override]  # pickled with its code
        return self.code, str(self)


def codes(notes: Iterable[str]) -> set[str]:
    """Return the codes of those notes that have one.

    Parameters
    ----------
    notes : iterable of str
        Notes, and sentences without a code, which are passed over.
    """
    return {note.code for note in notes if isinstance(note, Note)}


@contextmanager
def warned() -> Iterator[list[Note]]:
    """Collect the notes that are warned of inside, for those who show them in their own way; other warnings go on."""
    found: list[Note] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield found
    for one in caught:
        said = one.message.args[0] if isinstance(one.message, Warning) and one.message.args else None
        if isinstance(said, Note):
            found.append(said)
        else:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
