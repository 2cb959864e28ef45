"""Tables found in text and workbooks by the words of a vocabulary, or by the headings that the user names."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viscofric.errors import DataFileError, not_needed
from viscofric.notes import Note
from viscofric.readers.dma.names import (
    TITLES_STATE,
    deformation_of,
    insist_on_same_temperature,
    names_specimen,
    states_another,
    temperature_of_title,
)
from viscofric.readers.header_rows import DEEPEST_HEADER, Found, guessed, header_of, is_number, named
from viscofric.readers.headings import (
    OF_HEADINGS,
    Column,
    Vocabulary,
    heading,
    place_of,
    plain_value,
)
from viscofric.readers.source import (
    LIKE_THOUSANDS,
    MASSES,
    Source,
    converted,
    decides,
    decimal_comma,
    plain_number,
    remark,
    same_unit,
    to_rad_per_second,
)
from viscofric.readers.table import MISSING, NumberedRow, Table, make_table, name_columns
from viscofric.readers.workbook import is_workbook, sheets

#: A line with its number in the file.
NumberedLine = tuple[int, str]
#: A number as text, and its unit.
Value = tuple[str, str]
#: Cells of the lines of words above a table.
Title = tuple[tuple[str, ...], ...]
#: Places of the columns that all tables beside each other share, those of each, the title of each, and what it states.
Sets = tuple[list[int], Sequence[Sequence[int]], list[tuple[str, ...]], list[dict[str, Value]]]


#: Characters of a text that may hold its header.
_HEAD = 1_000_000
#: A longer line names no columns.
_LONGEST_LINE = 10_000
_DELIMITERS = "\t;,"
#: Headings may contain single blanks ("f (Hz)"), so two or more separate them; numbers contain none.
_BLANKS = "blanks"
_FOR_EXCEL = re.compile(r"\s*\"?sep=[,;\t]\"?\s*", re.IGNORECASE)


#: A quoted cell that does not end with its line, and the most lines of one row.
_OPEN, _MOST_WRAPPED = re.compile(r'(?:^|[\t;,])"[^"]*$'), 20
#: Words, each with the brackets behind it: "E(t) (Pa)", but "[Hz]" and "[Pa]" of a row of units.
_WORDS = re.compile(r"[^\s(\[{<]\S*+(?:\s[(\[{<][^()\[\]{}<>]*[)\]}>](?!\S))?|\S+")
#: A number at the beginning of a cell, but not that of "1/s".
_VALUE = re.compile(r"[+−-]?[\d.,]++(?!\s*/)")


def find_tables(source: Source, vocabulary: Vocabulary) -> dict[str, Table]:
    """Return the tables of a file by the names of their sheets, ``""`` for text."""
    # Of a workbook these are all sheets with a header, or the one that `source.sheet` names. A header is the first row
    # that names what the vocabulary needs, or all headings that `source.columns` names; else the first that names two
    # of its quantities, so that the caller can say what is missing.
    words = vocabulary.with_columns(source.columns)
    if is_workbook(source):
        return _of_workbook(source, words)
    if source.sheet:
        raise not_needed(source.path, "sheet", "no-sheet", "is not a workbook")
    header = _header_of_text(source, words)
    found = header and _whole(source, words, *header)
    if found is None:
        raise no_header(source, words)
    remarks = [
        (number, tuple(re.split(r"[\t;,]", line)))
        for number, line, is_remark in lines_of((source.text or "")[:_HEAD], remarks=True)
        if is_remark
    ]
    return {"": _table_under(source.path, found, words, remarks)}


def holds_table(source: Source, vocabulary: Vocabulary) -> bool:
    """Return whether a text has a row that names columns of such a table; never raises."""
    if source.text is None:
        return False
    return bool(source.columns) or _header_of_text(source, vocabulary) is not None


def no_header(source: Source, vocabulary: Vocabulary) -> DataFileError:
    """Return the error of a file in which no row is a header; its values list the headings of what looks like one."""
    words = vocabulary.with_columns(source.columns)
    if is_workbook(source):
        return _no_header_in_workbook(source, words)
    candidates = [guessed(_split_lines(source, delimiter), words) for delimiter in (*_DELIMITERS, _BLANKS)]
    lacking = [one for one in candidates if one and words.missing(column.quantity for column in words.columns(one))]
    return _not_understood(source.path, words, max(lacking or candidates, key=len))


def _of_workbook(source: Source, words: Vocabulary) -> dict[str, Table]:
    known = sheets(source)
    if source.sheet and source.sheet not in known:
        shown = ", ".join(map(repr, known)) or "none"
        note = Note("no-sheet", f"has no sheet {source.sheet!r}; its sheets are {shown}.", values={"sheets": [*known]})
        raise DataFileError(source.path, note)
    found = {}
    for name, cells in known.items():
        if source.sheet in ("", name):
            rows = numbered_rows(f"{source.path}, sheet {name!r}", cells)
            one = header_of(rows, words)
            if one is not None:
                found[name] = one
    if not found:
        raise _no_header_in_workbook(source, words)
    # a sheet of, say, shift factors names two quantities of sweeps, but no modulus
    whole = {name: one for name, one in found.items() if not words.missing(named(one.rows[one.header][1], words))}
    taken = whole or found
    others = [
        tuple(str(cell) for cell in row)
        for name, rows in known.items()
        if name not in found
        for row in rows[:DEEPEST_HEADER]
    ]
    tables = {name: _table_under(f"{source.path}, sheet {name!r}", one, words) for name, one in taken.items()}
    return {name: replace(table, above=(*table.above, *others)) for name, table in tables.items()}


def _no_header_in_workbook(source: Source, words: Vocabulary) -> DataFileError:
    known = sheets(source)
    read = [source.sheet] if source.sheet in known else [*known]
    headings = {name: guessed(numbered_rows(f"{source.path}, sheet {name!r}", known[name]), words) for name in read}
    return _not_understood(source.path, words, max(headings.values(), key=len, default=[]), [*known])


def _not_understood(path: str, words: Vocabulary, headings: Sequence[str], sheets: Sequence[str] = ()) -> DataFileError:
    """Return the error of a header without the needed words, or without the headings that the user names."""
    columns = words.columns(headings)
    _insist_on_clear_headings(path, columns, words)
    missing = words.missing(column.quantity for column in columns)
    values = words.header_values(columns, missing)
    shown = ", ".join(map(repr, headings)) or "none"
    among = f" in any of its sheets ({', '.join(map(repr, sheets))})" if sheets else ""
    if sheets:
        values["sheets"] = list(sheets)
    absent = [said for said in words.user_columns.values() if place_of(said, headings)[0] is None]
    if absent:
        problem = f"no row has a column {' and '.join(map(repr, absent))}{among}; this file has {shown}"
        problem += "; a value of all rows has '=' before it." if _VALUE.match(absent[0]) else "."
        return DataFileError(path, Note("no-column", problem, values=values))
    if not missing:
        problem = f"its headings ({shown}) are not as many as the cells below; separate them by tabs or semicolons."
        return DataFileError(path, Note("row-length", problem, values=values))
    problem = f"no row names columns for {' or '.join(missing)}{among}; {words.example}, this file has {shown}"
    if not headings:
        return DataFileError(path, Note("missing-columns", f"{problem}.", values=values))
    return DataFileError(path, Note("missing-columns", problem, remedy=name_columns(words.key, missing), values=values))


def _table_under(path: str, found: Found, words: Vocabulary, remarks: Sequence[NumberedRow] = ()) -> Table:
    """Return the table under a header, from all rows that are not blank; remarks state what lines above it do."""
    rows, header = found.rows, found.header
    above, below = ([cells for line, cells in remarks if (line < rows[header][0]) == one] for one in (True, False))
    names = list(rows[header][1])
    repeated = len({*filter(None, names)}) < len([*filter(None, names)])  # below values of each
    _insist_on_text(path, rows[: max(0, header - repeated)], words)
    if any(len(cells) != len(names) for _, cells in rows[header + 1 :]):  # else remarks without a heading
        names = _without_end(names)
    columns = words.columns(names)
    body = list(rows[header + 1 :])
    if body and _names_again(columns, body[0][1], words):  # symbols below names
        body.pop(0)
    if body and _is_row_of_units(columns, body[0][1]):
        columns = _with_units(path, columns, *body.pop(0), logarithms=words.logarithms)
    _insist_on_clear_headings(path, columns, words)
    blocks, titles = _stacked(path, body, list(rows[header][1]), columns, words)
    most = max([1, *map(len, titles)])  # lines above a table
    titles = [tuple(tuple(cells) for _, cells in rows[max(0, header - most) : header]), *titles]
    kept = [row for block in blocks for row in block]
    table = make_table(path, columns, kept, vocabulary=words)
    table = replace(table, pointed="") if found.delimiter == "," else table  # which decimals cannot have
    first_lines = [block[0][0] for block in blocks if block]
    block = np.searchsorted(first_lines, table.lines, side="right") if len(first_lines) > 1 else None
    held = tuple(title for title, rows_of in zip(titles, blocks, strict=True) if rows_of)
    table = replace(table, above=tuple(tuple(cells) for _, cells in rows[:header]), block=block, titles=held)
    table = _spread_down(table)
    between = any(
        cell.strip() for title in titles[1:] for line in title for cell in line
    )  # may say what tells the tables apart
    if block is not None and (words.several == "refused" or (words.several == "rows" and between)):
        problem = f"holds {len(first_lines)} tables below each other, the second with its header above line "
        raise DataFileError(path, f"{problem}{first_lines[1]}; give each a file of its own.", code="several-tables")
    if words.conditions and (block is None or any(column.stated for column in columns)):
        table = _with_first_given(_below_each_other(table))
        table = _with_stated_above(table, above, below) if block is None else table
        _insist_on_no_other_column(table)
        read = {*table.lines.tolist()}
        _insist_on_nothing_between(table, [row for row in kept if row[0] not in read])
    _insist_on_words(table)
    table, given = table.with_constants(), words.constants.get("temperature")
    _insist_on_one_value(table)
    table = replace(table, above=(*table.above, *(tuple(cells) for line, cells in remarks if line <= DEEPEST_HEADER)))
    place = table.place("temperature") if given and table.rows else None
    if place is not None:
        kelvin = float(table.values(place, "K")[0])
        if states_another(table, kelvin):
            raise table.refused("value-not-needed", f"{TITLES_STATE}; leave out {given!r}.")
        insist_on_same_temperature(table, kelvin, repr(given))
    return table


def _spread_down(table: Table) -> Table:
    """Return the table with a value that stands only in the first of the rows that it holds for in all of them."""
    for place, column in enumerate(table.columns):
        cells = [row[place].strip() for row in table.rows]
        starts = [row for row, cell in enumerate(cells) if cell]
        firsts = {0, *(np.flatnonzero(np.diff(table.block)) + 1 if table.block is not None else ())}
        if column.quantity not in table.vocabulary.conditions or 2 * len(starts) > len(cells) or firsts - {*starts}:
            continue
        swept = next((n for n, one in enumerate(table.columns) if one.quantity in table.vocabulary.needed[0]), place)
        runs = [range(start, end) for start, end in pairwise([*starts, len(cells)])]
        if swept != place and any(len({table.rows[row][swept] for row in run}) < 2 for run in runs if len(run) > 1):
            continue  # a reading now and then, at one frequency
        held = {row: cells[run[0]] for run in runs for row in run}
        rows = [(*row[:place], held[n], *row[place + 1 :]) for n, row in enumerate(table.rows)]
        columns = [replace(one, spread=True) if n == place else one for n, one in enumerate(table.columns)]
        table = replace(table, rows=tuple(rows), columns=tuple(columns))
    return table


#: Of conditions, in examples.
_UNITS = {"load": "N", "temperature": "°C", "speed": "mm/s", "frequency": "Hz"}


def _insist_on_clear_headings(path: str, columns: Sequence[Column], words: Vocabulary) -> None:
    """Refuse headings of measured values with two values of one quantity, or with a number without a unit."""
    held = {column.quantity for column in columns if not column.stated} | {*words.user_columns, *words.constants}
    lacks = [what for what in words.conditions if not any(what in one for one in held)]
    needed = {what for some in words.needed for what in some} - {*words.conditions}
    for column in columns:
        number = next((_value(text)[0] for _, text in column.stated if LIKE_THOUSANDS.fullmatch(_value(text)[0])), "")
        if number:
            raise _may_be_thousands(path, number, f"heading {column.heading!r}", columns, words)
    if not lacks or not held.isdisjoint(needed):
        return
    for column in (column for column in columns if column.heading and not column.quantity):
        rest, stated = words.stated_in(column.heading)
        is_value = words.quantity(heading(rest).name) in needed or (bool(words.alone) and not rest.strip())
        twice = [what for what in lacks if sum(one == what for one, _ in stated) > 1]
        if not stated and words.is_doubtful(column.heading) and "temperature" in lacks:
            problem = f"the dash in heading {column.heading!r} may be a minus sign; write the temperature in brackets."
            raise _unclear(path, columns, words, "dash-or-minus", problem)
        if is_value and twice:
            both = " and ".join(value for what, value in stated if what == twice[0])
            problem = f"heading {column.heading!r} states two values of {twice[0]}, {both}; keep the one that holds."
            raise _unclear(path, columns, words, "two-values", problem)
    bare = [column for column in columns if _is_bare(column, words, needed)]
    if len(bare) > 1:
        shown = " and ".join(repr(column.heading) for column in bare[:2])
        forms = " or ".join(repr(f"{bare[0].name} {_UNITS[what]}") for what in lacks)
        problem = f"the numbers of the headings {shown} have no unit; write {forms}, or name repetitions in a column."
        raise _unclear(path, columns, words, "number-without-unit", problem)


def _is_bare(column: Column, words: Vocabulary, needed: set[str]) -> bool:
    """Return whether a heading is a number, or the name of a measured value with a number, without a unit."""
    if column.quantity or words.has_value(column.heading):
        return False
    return (bool(words.alone) and is_number(column.heading)) or words.quantity(column.unnumbered) in needed


def _unclear(path: str, columns: Sequence[Column], words: Vocabulary, code: str, problem: str) -> DataFileError:
    return DataFileError(path, Note(code, problem, values=words.header_values(columns, ())))


def _may_be_thousands(
    path: str, number: str, where: str, columns: Sequence[Column], words: Vocabulary
) -> DataFileError:
    problem = f"{number!r} in {where} may be {number.replace(',', '.')} or {number.replace(',', '')}; "
    right = "write it with a point, or without a mark for thousands."
    return _unclear(path, columns, words, "ambiguous-decimals", problem + right)


def _with_stated_above(table: Table, above: Sequence[Sequence[str]], below: Sequence[Sequence[str]]) -> Table:
    """Return the table with a column of each value that it needs and lacks and that one line above states alone.

    The remarks `above` its header count as lines; another value in one `below` it may hold for some of its rows.
    """
    words, lines = table.vocabulary, [*table.above, *above]
    for what in (one for one in words.conditions if one not in words.constants):
        place = next((n for n, one in enumerate(table.columns) if one.heading == OF_HEADINGS[what]), None)
        if place is not None:
            held = {_comparable(row[place], table.columns[place].unit) for row in table.rows}
            for value, line in _stated_above(table, what, lines).items():
                if _comparable(*_value(value)) not in held:
                    problem = f"{line!r} above the table contradicts the {what} in its headings; delete one of them."
                    raise table.refused("values-contradict", problem)
        elif what in words.from_above and not table.has(what):
            found = _stated_above(table, what, lines, alone=True)
            others = [one for cells in below for one in words.stated_in(" ".join(cells))[1]] if found else []
            if len(found) == 1 and {value for one, value in others if one == what} <= {*found}:
                ((value, line),) = found.items()
                number, unit = _value(value)
                if LIKE_THOUSANDS.fullmatch(number):
                    raise _may_be_thousands(table.path, number, f"{line!r} above the table", table.columns, words)
                table = table.with_column(Column(line, what, unit, what, above=True), [number] * len(table.rows))
    return table


def _insist_on_no_other_column(table: Table) -> None:
    """Refuse a speed or temperature of all rows, stated above the table, beside an unknown column of such a unit."""
    for place, one in enumerate(table.columns):
        unit = {"speed": "m/s", "temperature": "K"}.get(one.quantity)
        if unit is None or not (one.above or one.heading == OF_HEADINGS[one.quantity]):
            continue
        units = [(other, other.unit) for other in table.columns if not other.quantity and other.unit]
        other = next((other for other, its in units if _in_si("1", its, unit) is not None), None)
        if other and len({row[place] for row in table.rows}) == 1:
            stated = f"a heading or a line above the table states one {one.quantity}"
            problem = f"{stated}, but column {other.heading!r} may hold others"
            remedy = name_columns(table.vocabulary.key, [one.quantity])
            raise table.refused("ambiguous-columns", problem, remedy, [one.quantity])


def _insist_on_nothing_between(table: Table, others: Sequence[NumberedRow]) -> None:
    """Refuse rows without numbers that state values anew which all rows have by the headings or the lines above."""
    for what in table.vocabulary.conditions:
        if any(one.above or one.heading == OF_HEADINGS[what] for one in table.columns if one.quantity == what):
            for number, cells in others:
                for line in _stated_above(table, what, [cells]).values():
                    problem = (
                        f"{line!r} between the rows states another {what}; repeat the headings below it, or write "
                    )
                    problem += f"the {what} into a column."
                    raise DataFileError(table.path, problem, number, code="values-contradict")


def _stated_above(table: Table, what: str, rows: Sequence[Sequence[str]], *, alone: bool = False) -> dict[str, str]:
    """Return the values of a quantity that lines or cells above a table state by its name and nothing else.

    `alone`: only those of lines that state no other value of it.
    """
    found = {}
    for row in rows:
        parts = (plain_value(part.strip()) for cell in row for part in re.split(r";\s+", cell))
        cells = list(dict.fromkeys(filter(None, parts)))
        every = {value for one, value in table.vocabulary.stated_in(" ".join(cells))[1] if one == what}
        if alone and len(every) > 1:  # "Load: 5 N" with "10 N" beside it
            continue
        for line in _lines_of(cells, table):
            label, _, number = line.rpartition(" ")
            named = heading(label.rstrip(":= "))
            text = f"{named.name} {number} {named.unit}" if named.unit and is_number(number) else line
            rest, stated = table.vocabulary.stated_in(text)
            if not rest.strip() and len(stated) == 1 and stated[0][0] == what and text[:1].isalpha():
                found[stated[0][1]] = line
    return found


def _lines_of(cells: Sequence[str], table: Table) -> list[str]:
    """Return the cells of a row as one line, and each by itself, but no names such as ``F 5 N`` behind ``Sample``."""
    others = [cell for before, cell in pairwise(cells) if re.search("[:=]", cell) or not _says_more(before, table)]
    return [" ".join(cells), *cells[:1], *others]


#: SI units of what headings may state.
_SI_OF_CONDITIONS = ("K", "rad/s", "N", "N/m", "m/s")


def _comparable(number: str, unit: str) -> tuple[float, str]:
    """Return a value in an SI unit where there is one."""
    for si in _SI_OF_CONDITIONS:
        if (value := _in_si(number, unit, si)) is not None:
            return float(f"{value:.9g}"), si
    return float(number.replace(",", ".")), unit


#: What is measured besides a coefficient, in lines above a table.
_NO_COEFFICIENT = re.compile(
    r"force|kraft|kräfte|effort|fuerza|forza|torque|moment|wear|verschlei|usure", re.IGNORECASE
)


def _insist_on_words(table: Table) -> None:
    """Refuse headings without words of what is measured where a line above states other values: ``Friction force``."""
    alone = next((column for column in table.columns if column.alone), None)
    if alone is None:
        return
    over = next((line[1] for title in table.titles for line in title[-1:] if len(line) > 1), "")
    instead = {what for some in table.vocabulary.needed if alone.quantity in some for what in some} - {alone.quantity}
    for cell in (cell.strip() for row in table.above for cell in row if cell.strip()):
        one = table.vocabulary.column(cell.partition(":")[0])
        unit = one.unit and not table.vocabulary.has_value(cell)
        if one.quantity in ("", *instead) and (unit or cell == over or _NO_COEFFICIENT.search(cell)):
            problem = f"heading {alone.heading!r} and those beside it name no quantity, and above them is {cell!r}; "
            right = f"write the quantity into each heading, such as 'COF {alone.heading}' for coefficients of friction."
            raise table.refused("quantity-unknown", problem + right)


def _insist_on_one_value(table: Table) -> None:
    """Refuse a value of all rows where the titles of several tables state several: ``20 N, 25 °C``, ``40 N, 60 °C``."""
    words = table.vocabulary
    lines = [words.stated_in(" ".join(cell for cells in title for cell in cells))[1] for title in table.titles]
    for what, said in words.constants.items():
        each = dict.fromkeys(value for stated in lines for one, value in stated if one == what)
        if what != "temperature" and len({_comparable(*_value(value)) for value in each}) > 1:
            shown = " and ".join(map(repr, each))
            problem = f"the lines above its tables state {shown}, so that {said!r} does not hold for all rows; give "
            raise DataFileError(table.path, f"{problem}each table a file of its own.", code="several-tables")


def _below_each_other(table: Table) -> Table:
    """Return columns beside each other, such as E' and E'' of several temperatures, below each other."""
    # Columns before them belong to all. They have the same columns, and each has values of its own, in its headings or
    # above them, which become columns; else the table is returned as it is.
    found = _by_headings(table) if any(column.stated for column in table.columns) else _by_line_above(table)
    if found is None:
        return table
    shared, sets, titles, stated = found
    columns = [[table.columns[place] for place in (*shared, *one)] for one in sets]
    kinds = [[(c.quantity, c.unit, c.base, c.alone, deformation_of(c.name)) for c in one] for one in columns]
    alike = all(set(values) == set(stated[0]) for values in stated) and all(one == kinds[0] for one in kinds)
    once = all(len({table.columns[place].quantity for place in one}) == len(one) for one in sets)
    if not alike or not once:
        return table
    of_sets = {what: _in_one_unit([values[what] for values in stated]) for what in stated[0]}
    if len(set(zip(*(cells for _, cells in of_sets.values()), strict=False))) < len(sets):
        return table
    kept = [
        (number, row, one)
        for number, one in enumerate(sets, start=1)
        for row, cells in enumerate(table.rows)
        if any(cells[place].strip().lower() not in MISSING for place in one)
    ]
    held = {place for one in (shared, *sets) for place in one}
    unread = {one.heading: replace(one, quantity="", stated=()) for one in table.unused(held)}.values()  # for notes
    below = replace(
        table,
        columns=(*(replace(one, stated=()) for one in columns[0]), *unread),
        rows=tuple(
            (*(table.rows[row][place] for place in (*shared, *one)), *[""] * len(unread)) for _, row, one in kept
        ),
        lines=table.lines[[row for _, row, _ in kept]],
    )
    numbers = np.array([number for number, _, _ in kept], dtype=np.int64)
    if table.block is not None:  # tables below each other, each of such columns
        below = replace(below, block=table.block[[row for _, row, _ in kept]])
    elif "frequency" not in of_sets:
        below = replace(below, block=numbers, titles=tuple((title,) for title in titles))
    for what, (unit, cells) in of_sets.items():
        column = Column(OF_HEADINGS.get(what, what), what, unit, what)
        below = below.with_column(column, [cells[number - 1] for number in numbers])
    return below


def _with_first_given(table: Table) -> Table:
    """Return the table with the first of the columns of one heading that the user names."""
    first: dict[str, int] = {}
    for place, column in enumerate(table.columns):
        if column.given:
            first.setdefault(column.quantity, place)
    columns = [
        replace(one, quantity="") if one.given and first[one.quantity] != place else one
        for place, one in enumerate(table.columns)
    ]
    return replace(table, columns=tuple(columns))


def _in_one_unit(values: Sequence[Value]) -> tuple[str, list[str]]:
    """Return the unit of values, and their numbers as text; an SI unit where theirs differ, no numbers without one."""
    (_, first), *_ = values
    if all(unit == first for _, unit in values):
        return first, [f"{float(number.replace(',', '.')):.12g}" for number, _ in values]
    for unit in _SI_OF_CONDITIONS:
        found = [one for number, its in values if (one := _in_si(number, its, unit)) is not None]
        if len(found) == len(values):
            return unit, [f"{one:.12g}" for one in found]
    return "", []


def _in_si(number: str, unit: str, si: str) -> float | None:
    """Return a value in an SI unit, None if it is of another kind, or a mass among weights."""
    if unit in MASSES:
        return None
    if si == "rad/s":
        factor = to_rad_per_second(unit, angular=False)
        return None if factor is None else factor * float(number.replace(",", "."))
    return converted(number, unit, si)


def _by_headings(table: Table) -> Sets | None:
    """Return the columns of each set of values that headings state: ``E' 25 °C``, ``E'' 25 °C``, ``E' 40 °C`` ..."""
    each = dict.fromkeys(column.stated for column in table.columns if column.stated)
    sets = []
    for stated in each:
        places = [place for place, column in enumerate(table.columns) if column.stated == stated]
        sets.append(sorted(places, key=lambda place: table.columns[place].quantity))
    shared = [place for place, column in enumerate(table.columns) if not column.stated]
    for what in {table.columns[place].quantity for place in shared} - {""}:  # each set may have its own time before it
        own = [place for place in shared if table.columns[place].quantity == what]
        before = [-1, *(max(one) for one in sets)]
        if len(own) == len(sets) > 1 and all(a < p < min(s) for a, p, s in zip(before, own, sets, strict=False)):
            sets = [[place, *one] for place, one in zip(own, sets, strict=True)]
            shared = [place for place in shared if place not in own]
    values = [{what: _value(text) for what, text in stated} for stated in each]
    above = [*(table.above[-1] if table.above else ()), *[""] * len(table.columns)]
    said = [cell if _says_more(cell, table) else "" for cell in above]
    if said[0] and sum(map(bool, said)) == 2:  # a label and its value, such as a date
        said = [""] * len(said)
    words = [[said[place] for place in one if said[place]] for one in sets]
    titles = [
        (dict(stated).get("temperature", ""), *dict.fromkeys(one)) for stated, one in zip(each, words, strict=True)
    ]
    return shared, sets, titles, values


def _says_more(cell: str, table: Table) -> bool:
    """Return whether a cell above columns holds other words than the conditions and quantities of their headings."""
    rest = table.vocabulary.stated_in(cell)[0]
    return bool(rest.strip()) and not is_number(cell) and not table.vocabulary.quantity_of_rest(rest)


def _value(text: str) -> Value:
    number, _, unit = text.partition(" ")
    return number, unit


def _by_line_above(table: Table) -> Sets | None:
    """Return the sets of columns that begin under the temperatures in the line above the headings; None without."""
    places: dict[str, list[int]] = {}
    for place, column in enumerate(table.columns):
        if column.quantity:
            places.setdefault(column.quantity, []).append(place)
    shared = [some[0] for some in places.values() if len(some) == 1]
    repeated = [some for some in places.values() if len(some) > 1]
    once = any(table.columns[place].given for place in shared)  # a column that the user names
    if len({len(some) for some in repeated}) != 1 or not table.above or once:
        return None
    sets = list(zip(*repeated, strict=True))
    starts = [min(one) for one in sets]
    apart = all(max(one) < start for one, start in zip(sets, starts[1:], strict=False))
    if not apart or any(place >= starts[0] for place in shared):
        return None
    above = [*table.above[-1], *[""] * len(table.columns)]
    label = next((cell for cell in above[: starts[0]] if cell.strip()), "")
    ends = [*starts[1:], len(above)]
    titles = [_title(label, above[start:end]) for start, end in zip(starts, ends, strict=True)]
    stated = [_stated_by(title, table) for title in titles]
    if not any(stated) and all(is_number(title[-1]) for title in titles):
        lacks = [what for what in table.vocabulary.conditions if not table.has(what)]
        forms = " or ".join(repr(f"{titles[0][-1]} {_UNITS[what]}") for what in lacks)
        problem = f"the numbers above its headings, {titles[0][-1]!r} and so on, have no unit; write {forms}."
        raise table.refused("number-without-unit", problem)
    return (shared, sets, titles, stated) if all(stated) else None


def _stated_by(title: tuple[str, ...], table: Table) -> dict[str, Value]:
    """Return what the line above columns states of the quantities that no column holds."""
    rest, stated = table.vocabulary.stated_in(" ".join(title))
    found = {what: _value(text) for what, text in stated if what != "temperature"}
    if rest.strip():  # a frequency stands alone
        found.pop("frequency", None)
    if "frequency" not in found and (kelvin := temperature_of_title(title)):
        found["temperature"] = (repr(kelvin), "K")
    return {what: value for what, value in found.items() if what in table.vocabulary.conditions and not table.has(what)}


def _title(label: str, cells: Sequence[str]) -> tuple[str, ...]:
    """Return the first cell above a table, with the label of its row if it is a bare number."""
    cell = next((cell for cell in cells if cell.strip()), "")
    return (label, cell) if is_number(cell) else (cell,)


def _stacked(
    path: str, body: Sequence[NumberedRow], header: list[str], columns: Sequence[Column], words: Vocabulary
) -> tuple[list[list[NumberedRow]], list[Title]]:
    """Return the rows of tables below each other, and the lines of words above all but the first."""
    # Each has the header again, or, where titles count, only a line of words above it: "T = 40 °C", "Sample B".
    blocks: list[list[NumberedRow]] = [[]]
    titles: list[Title] = []
    of_header, after_header = _plain(header), False
    for number, cells in body:
        if cells and " ".join(cells[0].split()) == of_header[0] and _plain(cells) == of_header:
            above: Title = ()
            while len(blocks) > 1 or blocks[-1]:  # the words above this header, of which some began a table
                if not blocks[-1]:
                    above = (*titles.pop(), *above)
                    blocks.pop()
                elif sum(map(is_number, blocks[-1][-1][1])) < 2:
                    above = (tuple(blocks[-1].pop()[1]), *above)
                else:
                    break
            titles.append(above)
            blocks.append([])
            after_header = True
        elif words.several == "titled" and not any(one.stated for one in columns) and _is_title(cells, words):
            if len(blocks) == 1 or blocks[-1]:
                blocks.append([])
                titles.append(())
            titles[-1] = (*titles[-1], tuple(cells))
            after_header = False
        elif not after_header or not _is_row_of_units(columns, cells):
            if not any(map(is_number, cells)) and not words.missing(named(cells, words)):
                problem = "a second table with other headings begins here; give each table a file of its own, or the "
                raise DataFileError(path, f"{problem}same headings in the same order.", number, code="several-tables")
            blocks[-1].append((number, cells))
            after_header = False
    return blocks, titles


def _plain(cells: Sequence[str]) -> list[str]:
    """Return cells up to the last one that is not blank, with single blanks."""
    return [" ".join(cell.split()) for cell in _without_end(cells)] or [""]


def _is_title(cells: Sequence[str], words: Vocabulary) -> bool:
    """Return whether a row between others names a specimen, or states a temperature and nothing else."""
    filled = [cell.strip() for cell in cells if cell.strip().lower() not in MISSING]
    if not 0 < len(filled) <= 3 or is_number(filled[0]) or sum(map(is_number, filled)) > 1:
        return False
    stated = {what for what, _ in words.stated_in(" ".join(filled))[1]}
    states = stated <= {"temperature"} and temperature_of_title(filled) is not None
    return states or (len(filled) < 3 and names_specimen(filled))


def _without_end(cells: Sequence[str]) -> list[str]:
    """Return the cells of a row up to the last one that is not blank."""
    filled = [place for place, cell in enumerate(cells, start=1) if cell.strip()]
    return list(cells[: max(filled, default=0)])


def _insist_on_text(path: str, above: Sequence[NumberedRow], words: Vocabulary) -> None:
    """Refuse rows of numbers above the header, unless they have a header, or a label of the vocabulary."""
    width = 0
    for number, cells in above:
        label = next((cell for cell in cells if cell.strip()), "")
        if words.quantity(heading(label).name):
            continue
        if sum(map(is_number, cells)) <= 2:
            width = max(width, len(cells))
        elif len(cells) > width:
            problem = "a row of numbers precedes the header; put the header first."
            raise DataFileError(path, problem, number, code="numbers-above-header")


def _is_row_of_units(columns: Sequence[Column], cells: Sequence[str]) -> bool:
    """Return whether a row under headings holds units: no number, and a word under a column of the vocabulary."""
    if len(cells) > len(columns) + 1 or any(is_number(cell) for cell in cells if cell.strip() != "1"):  # of a ratio
        return False
    return any(_stated(column, cell) for column, cell in zip(columns, cells, strict=False))


def _names_again(columns: Sequence[Column], cells: Sequence[str], words: Vocabulary) -> bool:
    """Return whether a row names the quantities of the columns above it once more: ``T``, ``f``, ``E'`` below words."""
    pairs = zip(columns, cells, strict=False)
    below = [(column.quantity, words.quantity(heading(cell).name)) for column, cell in pairs if column.quantity]
    return len(below) > 1 and all(above == again for above, again in below)


def _stated(column: Column, cell: str) -> str:
    """Return the unit in a cell under a heading of the vocabulary, "" for a value or for nothing."""
    unit = "" if cell.strip() == column.heading else _unit(cell)
    return unit if column.quantity and unit.lower() not in MISSING and not _VALUE.match(unit) else ""


def _with_units(
    path: str, columns: Sequence[Column], row: int, cells: Sequence[str], *, logarithms: bool
) -> tuple[Column, ...]:
    """Return columns with the units of the row below them; a unit that the heading has too must be the same."""
    found = []
    for column, cell in zip(columns, [*cells, *[""] * len(columns)], strict=False):
        stated = _stated(column, cell)
        if stated and column.unit and not column.given and not same_unit(_unit(column.unit), stated):
            problem = f"column {column.heading!r} has {column.unit!r} in its heading, but {stated!r} in the row below; "
            raise DataFileError(path, problem + "keep the unit that is right.", row, code="units-contradict")
        whole = _unit(column.unit) or cell.strip() == column.heading  # a merged cell
        found.append(column if whole else column.with_unit(_unit(cell), logarithms=logarithms))
    return tuple(found)


def _unit(cell: str) -> str:
    plain = cell.strip()
    if re.fullmatch(r"[(\[{<][^()\[\]{}<>]*[)\]}>]?|[^()\[\]]*[)\]]", plain):
        plain = plain.strip("[](){}<>").strip()
    return plain


def _header_of_text(source: Source, words: Vocabulary) -> tuple[str, bool] | None:
    """Return the delimiter that makes most of a header, and whether the header is a remark."""
    # Where no line is a header, remarks (``# f (Hz), E' (MPa)``) are looked at too.
    for remarks in (False, True):
        best: tuple[int, str] | None = None
        for delimiter in (*_DELIMITERS, _BLANKS):
            if delimiter == _BLANKS and best is not None:
                break
            found = header_of(_split_lines(source, delimiter, remarks), words)
            if found is not None and (delimiter != _BLANKS or _fits_below(found)):
                count = len(named(found.rows[found.header][1], words))
                best = max(best or (-1, ""), (count, delimiter), key=lambda one: one[0])
        if best is not None:
            return best[1], remarks
    return None


def _whole(source: Source, words: Vocabulary, delimiter: str, remarks: bool) -> Found | None:
    """Return all rows of a text with its header; remarks below it are left out."""
    lines = lines_of(source.text or "", remarks=remarks)
    rows: list[NumberedRow] = [(number, _cells(source.path, number, line, delimiter)) for number, line, _ in lines]
    found = header_of(_filled(rows), words)
    if found is None:
        return None
    remarked = {number for number, _, is_remark in lines if is_remark}
    number, headings = found.rows[found.header]
    first = found.header + 1
    if number in remarked and any(_is_row_of_units(words.columns(headings), row) for _, row in found.rows[first:][:1]):
        first += 1  # units behind the same mark
    below = [row for row in found.rows[first:] if row[0] not in remarked]
    return Found([*found.rows[:first], *below], found.header, delimiter)


def lines_of(text: str, *, remarks: bool = False) -> list[tuple[int, str, bool]]:
    """Return the lines that are not blank, with their numbers and whether they are remarks, which may be left out."""
    found: list[tuple[int, str, bool]] = []
    for number, line in _joined(text.splitlines()):
        said = remark(line)
        if remarks and said is None and found and found[-1][2] and line.startswith("% "):  # units, as the line above
            said = line.lstrip("% ")
        if line.strip() and (remarks or said is None) and not _FOR_EXCEL.fullmatch(line):
            found.append((number, line if said is None else said, said is not None))
    return found


def _joined(lines: Sequence[str]) -> Iterator[NumberedLine]:
    """Yield lines with their numbers; those of one quoted cell, such as a wrapped heading, are one."""
    place = 0
    while place < len(lines):
        end, line = place + 1, lines[place]
        while '"' in line and _OPEN.search(line) and end < min(place + _MOST_WRAPPED, len(lines)):
            line, end = f"{line} {lines[end]}", end + 1
        if '"' in line and _OPEN.search(line):  # no end: the mark is none of quotation
            end, line = place + 1, lines[place]
        yield place + 1, line
        place = end


def _split_lines(source: Source, delimiter: str, remarks: bool = False) -> list[NumberedRow]:
    """Return the cells of the first lines that can be split."""
    head = "\n".join((source.text or "")[:_HEAD].splitlines()[: 2 * DEEPEST_HEADER])
    lines = lines_of(head, remarks=remarks)
    found: list[NumberedRow] = []
    for number, line, _ in lines:
        with suppress(DataFileError):
            found.append((number, _cells(source.path, number, line[:_LONGEST_LINE], delimiter)))
    return _filled(found)


def _filled(rows: list[NumberedRow]) -> list[NumberedRow]:
    """Return the rows that are more than delimiters."""
    return [row for row in rows if any(cell.strip() for cell in row[1])]


def _fits_below(found: Found) -> bool:
    """Return whether lines of as many cells, mostly numbers, follow; prose parted by blanks may name quantities too."""
    width = len(found.rows[found.header][1])
    below = found.rows[found.header + 1 : found.header + 3]
    return any(len(cells) == width < 2 * sum(map(is_number, cells)) for _, cells in below)


def _cells(path: str, number: int, line: str, delimiter: str) -> list[str]:
    """Split one line, quoted cells included, or raise `DataFileError`."""
    if delimiter != _BLANKS:
        try:
            return next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
        except csv.Error as error:
            problem = f"the row cannot be split into cells ({error})."
            raise DataFileError(path, problem, number, code="row-length") from None
    if line.lstrip().startswith('"') and line.count('"') % 2 == 0:  # as R writes headings
        return [quoted or bare for quoted, bare in re.findall(r'"([^"]*)"|(\S+)', line)]
    # two blanks or more, or single ones if no heading has several words but its unit in brackets
    wide = re.split(r"\s{2,}", line.strip())
    single = _WORDS.findall(line)
    return single if len(wide) == 1 or all(map(is_number, single)) else wide


def numbered_rows(path: str, cells: Sequence[Sequence[float | str]]) -> list[NumberedRow]:
    """Return the rows of a sheet that are not blank as text, with their numbers."""
    texts = [(plain_number(cell), n) for n, row in enumerate(cells, start=1) for cell in row if isinstance(cell, str)]
    comma = any(decides(cell, ".") for cell, _ in texts) or decimal_comma(path, texts)
    rows: list[NumberedRow] = []
    for number, row in enumerate(cells, start=1):
        shown = [_text(cell, comma=comma) for cell in row]
        filled = [cell for cell in shown if cell.strip()]
        is_remark = shown[0].lstrip().startswith("#") if len(filled) > 1 else remark("".join(filled)) is not None
        if filled and not is_remark:
            rows.append((number, shown))
    return rows


def _text(cell: float | str, *, comma: bool) -> str:
    """Write a cell as a text table would, with the decimal mark of the sheet's other cells."""
    if isinstance(cell, str):
        return cell.replace(".", ",") if comma and cell.endswith(" %") and is_number(cell) else cell
    shown = repr(float(cell)).removesuffix(".0").replace(".", "," if comma else ".")
    return f"{shown}0" if LIKE_THOUSANDS.fullmatch(shown) else shown  # which it is not
