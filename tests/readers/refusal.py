"""Refusals and notes by code, place and numbers; their wording is tested in `test_messages`."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from viscofric.errors import InputError
from viscofric.notes import Note, note_of


def refused(code: str, row: int | None = None, *names: str, file: str = "") -> pytest.RaisesExc[InputError]:
    """Expect an `InputError` with a code, and with a row of the file where it is given.

    Parameters
    ----------
    code : str
        Of the error.
    row : int, optional
        Line of the file.
    *names : str
        Columns, sheets, places or numbers that the sentence must name.
    file : str
        End of the file's path.
    """

    def fits(error: InputError) -> bool:
        place = row is None or getattr(error, "row", None) == row
        named: Iterable[bool] = (name in str(error) for name in names)
        return error.code == code and place and all(named) and getattr(error, "path", "").endswith(file)

    return pytest.raises(InputError, check=fits)


def noted(notes: Iterable[str], code: str, *names: str) -> list[Note]:
    """Return the notes with a code that name columns, places or numbers."""
    found = [note_of(note) for note in notes]
    return [note for note in found if note.code == code and all(name in note for name in names)]
