"""Rows that name the columns of a table: by the words of a vocabulary, by the user's headings, or above numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.readers.headings import is_place, place_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.readers.headings import Vocabulary
    from viscofric.readers.table import NumberedRow

#: Tables by people and instruments begin above this line.
DEEPEST_HEADER = 300
_LONGEST_NAME = 100
#: First characters of names that begin with no letter: "|E*|", " f (Hz)", '"f"'.
_BEFORE_LETTERS = ("|", " ", '"', "'")


@dataclass(frozen=True)
class Found:
    """Rows of cells that are not blank, and the place of their header."""

    rows: list[NumberedRow]
    header: int


def named(cells: Sequence[str], words: Vocabulary) -> set[str]:
    """Return the quantities that the cells of one row name."""
    if not any(cell[:1].isalpha() or cell[:1] in _BEFORE_LETTERS for cell in cells):
        return set()
    if not words.user_columns:
        cells = [cell if len(cell) < _LONGEST_NAME else "" for cell in cells]
    return {column.quantity for column in words.columns(cells)} - {""}


def header_of(rows: Sequence[NumberedRow], words: Vocabulary) -> Found | None:
    """Return rows with the place of their header, None without one; a missing header is put in where places suffice."""
    # It is the first row with all headings that the user names; without these the first that names what is needed;
    # without such a row the first that names two quantities.
    if words.user_columns:
        return _header_with(rows, words)
    second_best = None
    if words.constants:  # less is needed, so that a word above the table may do: the row that names most counts
        counts = [len(named(cells, words)) for _, cells in rows[:DEEPEST_HEADER]]
        return Found(list(rows), counts.index(max(counts))) if any(counts) else None
    for place, (_, cells) in enumerate(rows[:DEEPEST_HEADER]):
        found = named(cells, words)
        if found and not words.missing(found):
            return Found(list(rows), place)
        if second_best is None and len(found) > 1:
            second_best = place
    return None if second_best is None else Found(list(rows), second_best)


def _header_with(rows: Sequence[NumberedRow], words: Vocabulary) -> Found | None:
    names = words.user_columns.values()
    if not all(map(is_place, names)):
        for place, (_, cells) in enumerate(rows[:DEEPEST_HEADER]):
            if all(place_of(said, cells)[0] is not None for said in names):
                return Found(list(rows), place)
        return None
    first = _first_numbers(rows)
    if first is None or any(place_of(said, rows[first][1])[0] is None for said in names):
        return None
    top = _top_of_header(rows, first)
    if top is not None:
        return Found(list(rows), top)
    number, cells = rows[first]
    places = [f"#{place}" for place in range(1, len(cells) + 1)]
    return Found([*rows[:first], (number, places), *rows[first:]], first)


def _first_numbers(rows: Sequence[NumberedRow]) -> int | None:
    """Return the place of the first row of numbers, at least two and most of its cells."""
    for place, (_, cells) in enumerate(rows[: DEEPEST_HEADER + 3]):
        count = sum(map(is_number, cells))
        if count > 1 and 2 * count >= len([cell for cell in cells if cell.strip()]):
            return place
    return None


def _top_of_header(rows: Sequence[NumberedRow], first: int) -> int | None:
    """Return the highest of the rows of text, at most three, that stand above numbers and have as many cells."""
    width, top = len(rows[first][1]), None
    for place in range(first - 1, max(-1, first - 4), -1):
        cells = [cell for cell in rows[place][1] if cell.strip()]
        fits = 2 * len(cells) > width >= len(cells) - 1
        if not fits or any(map(is_number, cells)):
            break
        top = place
    return top


def guessed(rows: Sequence[NumberedRow]) -> list[str]:
    """Return the headings above the first row of numbers, or the numbers of its columns; none without numbers."""
    first = _first_numbers(rows)
    if first is None:
        return []
    top = _top_of_header(rows, first)
    if top is None:
        return [f"#{place}" for place in range(1, len(rows[first][1]) + 1)]
    return [cell.strip() for cell in rows[top][1]]


def is_number(cell: str) -> bool:
    """Return whether a cell is a number, with a decimal point or comma, perhaps in per cent."""
    try:
        float(cell.strip().removesuffix("%").replace(",", ".").replace("−", "-"))
    except ValueError:
        return False
    return True
