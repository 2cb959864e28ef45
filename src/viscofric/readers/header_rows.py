"""Rows that name the columns of a table: by the words of a vocabulary, by the user's headings, or above numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from viscofric.readers.headings import Column, Vocabulary, is_place, place_of
from viscofric.readers.source import plain_number, same_unit
from viscofric.readers.table import NumberedRow

#: Tables by people and instruments begin above this line.
DEEPEST_HEADER = 300
_LONGEST_NAME = 100
_MOST_HEADER_ROWS = 3
#: In place of the unit of a number.
_NO_UNIT = ("-", "–", "—")
#: First characters of names that begin with no letter: "|E*|", " f (Hz)", '"f"'.
_BEFORE_LETTERS = ("|", " ", '"', "'")


@dataclass(frozen=True)
class Found:
    """Rows of cells that are not blank, and the place of their header."""

    rows: list[NumberedRow]
    header: int
    delimiter: str = ""  # "" of a workbook


def named(cells: Sequence[str], words: Vocabulary) -> set[str]:
    """Return the quantities that the cells of one row name."""
    if not any(cell[:1].isalpha() or cell[:1] in _BEFORE_LETTERS for cell in cells):
        return set()
    if not words.user_columns:
        cells = [cell if len(cell) < _LONGEST_NAME else "" for cell in cells]
    columns = words.columns(cells)
    return {what for one in columns for what in (one.quantity, *(stated for stated, _ in one.stated))} - {""}


def header_of(rows: Sequence[NumberedRow], words: Vocabulary) -> Found | None:
    """Return rows with the place of their header, of up to three rows as one; None without any."""
    found = _header_of_one_row(rows, words)
    held = named(found.rows[found.header][1], words) if found else set()
    if found and not words.missing(held) and not _repeats(found.rows[found.header][1], words):
        return found
    # The last rows of a header are those above the numbers, or the row found; the rows that name most together count.
    first = _first_numbers(rows, words) or 0
    bottoms = {*range(max(0, first - _MOST_HEADER_ROWS), first), *([found.header] if found else [])}
    most = max(1, len(held))
    for bottom in sorted(bottoms):
        for top in reversed(range(max(0, bottom - _MOST_HEADER_ROWS + 1), bottom)):
            cells = joined([row for _, row in rows[top : bottom + 1]], words)
            if any(place_of(said, cells)[0] is None for said in words.user_columns.values()):
                continue
            count = len(named(cells, words))
            if count > most and _keeps(cells, rows[bottom][1], words):
                above = [row for row in rows[top:bottom] if not any(map(is_number, row[1]))]
                header = (rows[bottom][0], cells)
                found = Found([*rows[:top], *above, header, *rows[bottom + 1 :]], top + len(above))
                most = count
    return found


def _keeps(cells: Sequence[str], lowest: Sequence[str], words: Vocabulary) -> bool:
    """Return whether joined headings still name and state what the lowest of their rows does, column by column."""
    # A line above a table ("Load;10 N") is none of its headings: "10 N temperature (°C)" would be no temperature.
    return all(
        not below.quantity or (below.quantity == one.quantity and {*below.stated} <= {*one.stated})
        for one, below in zip(words.columns(cells), words.columns(lowest), strict=False)
    )


def _repeats(cells: Sequence[str], words: Vocabulary) -> bool:
    """Return whether columns of one quantity are not told apart by what their headings state."""
    each = [(column.quantity, column.stated) for column in words.columns(cells) if column.quantity]
    return len(set(each)) < len(each)


def joined(band: Sequence[Sequence[str]], words: Vocabulary) -> list[str]:
    """Return the headings that rows above each other make: ``COF`` above ``5 N`` and ``10 N``, or units below names."""
    # The blank cells behind one belong to it, as those of a merged cell do.
    *above, lowest = [[*cells, *[""] * (max(map(len, band)) - len(cells))] for cells in band]
    texts = [" ".join(cell.split()) for cell in lowest]
    first = [next((cell for cell in cells if cell.strip()), "") for cells in above]
    for row in reversed(range(len(above))):
        labels = [cell for cell in reversed(first[: row + 1]) if not is_number(cell)]
        label, left = words.column(labels[0] if labels else ""), ""
        for place, cell in enumerate(_without_values_of_others(above[row], words)):
            own = " ".join(cell.split())
            left = own or left
            texts[place] = _under(left if texts[place] else own, texts[place], label, words)
    return texts


def _without_values_of_others(cells: Sequence[str], words: Vocabulary) -> list[str]:
    """Return cells without values behind other words, such as ``7 N`` behind ``Preload``."""
    found, others = [], False
    for cell in cells:
        rest, stated = words.stated_in(cell)
        found.append("" if others and stated and not rest.strip() else cell)
        of = words.quantity_of_rest(rest) or words.quantity_of_rest(rest.rstrip(":= "))
        others = bool(rest.strip()) and not is_number(cell) and not of
    return found


def _under(upper: str, text: str, label: Column, words: Vocabulary) -> str:
    """Return a heading with the cell above it, in a row that begins with a label."""
    unit = text.strip("()[]")
    if unit in _NO_UNIT:
        return upper
    if not upper or not text or upper.casefold() in text.casefold() or _is_of_user(text, words):
        return text or upper
    if is_number(upper) and label.quantity in words.conditions:  # under "load (N)", with 5 and 10 beside it
        upper = f"{upper} {label.unit}"
    over = words.column(upper)
    if is_number(text) and over.quantity in words.conditions:  # 5 and 10 below "load (N)"
        return f"{over.name} {text} {over.unit}".strip()
    (above, stated), (below, own) = words.stated_in(upper), words.stated_in(text)
    of_above, of_below = words.quantity_of_rest(above), words.quantity_of_rest(below)
    if of_below:  # a name of its own, to which only values above it belong: "COF" below "20 °C" or "COF 20 °C"
        if is_number(upper):
            return f"{upper} {text}"
        belongs = not above.strip() or of_above == of_below
        return " ".join([*(value for _, value in stated if belongs), text])
    if own and not below.strip():  # values alone: "5 N" below "load", "COF" or "20 °C"
        if of_above in words.conditions:
            return f"{over.name} {text}"
        return f"{upper} {text}" if of_above or is_number(upper) or (stated and not above.strip()) else text
    if over.unit and same_unit(over.unit, unit):  # "Hz" below "f (Hz)"
        return upper
    # "mm/s" below "speed", or the second half of a name
    return f"{upper} ({unit})" if over.quantity and not over.unit else f"{upper} {text}"


def _is_of_user(text: str, words: Vocabulary) -> bool:
    """Return whether the user names a column by this heading."""
    return any(place_of(said, [text])[0] == 0 and not is_place(said) for said in words.user_columns.values())


def _header_of_one_row(rows: Sequence[NumberedRow], words: Vocabulary) -> Found | None:
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
    first = _first_numbers(rows, words)
    if first is None or any(place_of(said, rows[first][1])[0] is None for said in names):
        return None
    top = _top_of_header(rows, first)
    if top is not None:
        return Found(list(rows), top)
    number, cells = rows[first]
    places = [f"#{place}" for place in range(1, len(cells) + 1)]
    return Found([*rows[:first], (number, places), *rows[first:]], first)


def _first_numbers(rows: Sequence[NumberedRow], words: Vocabulary) -> int | None:
    """Return the place of the first row of numbers, at least two and most of its cells."""
    for place, (_, cells) in enumerate(rows[: DEEPEST_HEADER + 3]):
        count = sum(map(is_number, cells))
        if (
            count > 1
            and 2 * count >= len([cell for cell in cells if cell.strip()])
            and not _is_label(rows, place, words)
        ):
            return place
    return None


def _is_label(rows: Sequence[NumberedRow], row: int, words: Vocabulary) -> bool:
    """Return whether a row begins with the name of a quantity, above numbers: values of it, or of what is below."""
    cells = rows[row][1]
    place, label = next(((place, cell) for place, cell in enumerate(cells) if cell.strip()), (0, ""))
    if not any(words.column(part).quantity for part in label.split("\\")):
        return False
    below = next((cells for _, cells in rows[row + 1 : row + 4] if any(map(is_number, cells))), [])
    return len(below) > place and is_number(below[place])


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


def guessed(rows: Sequence[NumberedRow], words: Vocabulary) -> list[str]:
    """Return the headings above the first row of numbers, or the numbers of its columns; none without numbers."""
    first = _first_numbers(rows, words)
    if first is None:
        return []
    top = _top_of_header(rows, first)
    if top is None and first and _is_label(rows, first - 1, words):
        top = first - 1
    if top is None:
        return [f"#{place}" for place in range(1, len(rows[first][1]) + 1)]
    return [cell.strip() for cell in rows[top][1]]


def is_number(cell: str) -> bool:
    """Return whether a cell is a number, with a decimal point or comma, perhaps in per cent."""
    plain = plain_number(cell).removesuffix("%").replace(",", ".")
    try:
        float(plain)
    except ValueError:
        return False
    return "_" not in plain
