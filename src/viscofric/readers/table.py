"""Tables of text with a unit in every heading: cells checked one by one, and columns found by what they hold."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.errors import DataFileError, InputError
from viscofric.notes import Note, Remedy
from viscofric.readers.headings import CONSTANT, NO_WORDS, OF_HEADINGS, Column, Vocabulary, option_of
from viscofric.readers.source import MASSES, Decimals, fraction_of, is_revolutions, plain_number, unit_conversion

#: Cells of one row, with its number in the file.
NumberedRow = tuple[int, Sequence[str]]


#: Printed by instruments and people in place of a number.
MISSING = frozenset(
    {"", "-", "--", "---", "----", "–", "—", "nan", "na", "n/a", "#n/a", "#nv", "n.a.", "null", "none", "*"}
    | {"***", "bad"}
    | {"-nan", "nan(ind)", "-nan(ind)", "1.#qnan", "-1.#ind"}  # of Windows
)

#: A number as printed, with a decimal point or comma.
NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?")
_PLAIN, _NEVER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,2})?", re.ASCII), re.compile(r"(?!)")
#: A number whose point may part thousands, and how many of them may be decimals with three digits by chance.
_POINTED, _MOST_BY_CHANCE = re.compile(r"[+-]?[1-9]\d{0,2}\.\d{3}"), 3
#: Written for MPa; moduli and stresses of solids are not measured in millipascals.
MILLIPASCAL = "mPa"
#: Cells of a column of lubricants in tests without one.
DRY = MISSING | {"none", "no", "dry", "0", "nein", "keiner", "ohne", "trocken", "non", "aucun", "sec", "seco", "secco"}
#: Labels of rows that summarise others: a mean, or how far the others scatter.
_OF_SUMMARIES = re.compile(
    r"(?P<mean>mean( value)?|average|avg|median|mittelwert|mittel|moyenne|media|promedio)"
    r"|(grand )?total|sum|summe|gesamt|somme|suma|min|max|minimum|maximum|range|spannweite"
    r"|std|std\.? ?dev|stdev|sd|standard deviation|standard error|sem|standardabweichung|stabw|écart[- ]type"
    r"|desviación (estándar|típica)|variance|varianz|cv|rsd"
)


@dataclass(frozen=True, eq=False)
class Table:
    """A delimited text table with cells as text, as many in each row as there are columns, and line numbers from 1."""

    path: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: Integers
    above: tuple[tuple[str, ...], ...] = ()  # cells of the rows above the header, and of other sheets
    block: Integers | None = None  # of each row, where several tables stand below each other
    titles: tuple[tuple[tuple[str, ...], ...], ...] = ()  # cells of the lines above each of these tables
    empty_rows: int = 0  # left out, with none of the quantities that make a header
    pointed: str = ""  # a number whose point may part thousands, where no number shows what points are
    vocabulary: Vocabulary = NO_WORDS

    def with_column(self, column: Column, cells: Sequence[str]) -> Table:
        """Return the table with one more column, of numbers as text with a decimal point or comma."""
        plain = (cell.replace("−", "-").replace(",", ".") for cell in cells)
        rows = tuple((*row, cell) for row, cell in zip(self.rows, plain, strict=True))
        return replace(self, columns=(*self.columns, column), rows=rows)

    def with_constants(self) -> Table:
        """Return the table with a column of each value that the user gives for all rows; none may be there already."""
        table, words = self, self.vocabulary.with_columns({})
        for what, said in self.vocabulary.constants.items():
            for place, one in enumerate(self.columns):
                if one.given or words.column(one.heading).quantity != what:
                    continue
                if any(row[place].strip().lower() not in MISSING for row in self.rows):
                    problem = f"column {one.heading!r} holds the {what}; leave out {said!r}, or delete the column."
                    raise self.refused("value-not-needed", problem)
            if match := CONSTANT.fullmatch(said):
                column = Column(said, what, match["unit"], what, given=True)
                table = table.with_column(column, [match["number"]] * len(self.rows))
        return table

    def headings(self) -> str:
        """Return the headings as one readable list, for error messages."""
        made = OF_HEADINGS.values()  # which no heading says
        return ", ".join(repr(column.heading) for column in self.columns if column.heading not in made)

    def numbers(self, column: int, *, or_missing: bool = False) -> Array:
        """Return a column as printed, NaN for a missing number where that is allowed, or raise `DataFileError`."""
        one = self._plain(column)
        quick = _NEVER.fullmatch if one.base else _PLAIN.fullmatch  # for long files

        def number(cell: str, line: int) -> float:
            is_missing = or_missing and cell.strip().lower() in MISSING
            return math.nan if is_missing else self._number(cell, one, line)

        cells = zip((row[column] for row in self.rows), self.lines.tolist(), strict=True)
        return np.array([float(cell) if quick(cell) else number(cell, line) for cell, line in cells])

    def numbers_or_missing(self, column: int) -> Array:
        """Return a column as printed, NaN for a missing number."""
        return self.numbers(column, or_missing=True)

    def _plain(self, place: int) -> Column:
        """Return a column; one of logarithms, which only the user can have named here, is refused in most tables."""
        column = self.columns[place]
        if column.base and not self.vocabulary.logarithms:
            problem = f"column {column.heading!r} holds logarithms; write the numbers themselves in a column"
            raise self.refused("logarithm-unknown", problem + ".")
        return column

    def _number(self, cell: str, column: Column, line: int) -> float:
        text, heading = cell.strip(), column.heading
        if not text:
            raise DataFileError(
                self.path, f"the cell in column {heading!r} is empty; give a number.", line, code="empty-cell"
            )
        plain, factor = text, 1.0
        if plain.endswith("%") and not column.base and (own := fraction_of(column.unit)):
            plain, factor = plain.removesuffix("%"), 0.01 / own
        try:
            value = column.base ** float(plain) if column.base else factor * float(plain)
        except (ValueError, OverflowError):
            value = math.nan
        if not math.isfinite(value) or "_" in plain:
            problem = f"{text!r} in column {heading!r} is not a finite number; correct it, or leave out the row."
            raise DataFileError(self.path, problem, line, code="not-a-number")
        return value

    def values(
        self, column: int, unit: str, hint: Remedy | None = None, *, or_missing: bool = False, assumed: str = ""
    ) -> Array:
        """Return a column, (n,), in an SI unit, or raise `DataFileError` for a wrong cell or unit."""
        # "" is the unit of a ratio; `assumed` is that of a column without one; `hint` as for `conversion`.
        one = self.columns[column]
        if unit == "m/s" and one.unit and is_revolutions(one.unit):
            return self._on_track(column)
        if assumed and not one.unit:
            factor, offset = unit_conversion(assumed, unit, one.heading)
        else:
            factor, offset = self.conversion(one, unit, hint) if unit else (self.fraction(one), 0.0)
        with np.errstate(over="ignore"):
            return factor * self.numbers(column, or_missing=or_missing) + offset

    def _on_track(self, column: int) -> Array:
        """Return the speeds, m/s, of a track whose radius a column holds, from revolutions per minute."""
        one, radius = self.columns[column], self.place("track radius")
        if radius is None or one.quantity not in ("speed", "disc speed"):
            problem = f"column {one.heading!r} holds revolutions, whose speed depends on the radius; write it as "
            add = f"'{one.name} (mm/s)', 2π · radius · revolutions/60"
            if one.quantity in ("speed", "disc speed") and "track radius" in self.vocabulary.quantities:
                add += ", or add a column 'track radius (mm)'"
            raise self.refused("revolutions", f"{problem}{add}.")
        factor, _ = unit_conversion("rpm", "rad/s", one.heading)
        return factor * self.numbers(column) * self.values(radius, "m")

    def conversion(self, column: Column, unit: str, hint: Remedy | None = None) -> tuple[float, float]:
        """Return ``(factor, offset)`` from a column as printed to an SI unit."""
        # Without a unit in the heading, the error ends with the hint; a unit of the wrong kind is an error too.
        example = {"K": "degC", "Pa": "MPa", "m/s": "mm/s", "rad": "deg"}.get(unit, unit)
        if not column.unit:
            right = f"{' '.join(filter(None, (column.name, *(value for _, value in column.stated))))} ({example})"
            constant = CONSTANT.fullmatch(column.heading)
            right = f"{column.heading} {example}" if constant else right
            problem = f"column {column.heading!r} has no unit; write it as {right!r}"
            key = "" if constant or not column.quantity else self.vocabulary.key
            raise self.refused("no-unit", problem, hint + "." if hint else or_name_it(key, column.quantity, right))
        printed = column.unit.replace(MILLIPASCAL, "MPa") if unit in ("Pa", "1/Pa") else column.unit
        try:
            return unit_conversion(printed, unit, column.heading)
        except InputError:
            problem = f"column {column.heading!r} has the unit {column.unit!r}; it must be one like {example!r}."
            raise self.refused("wrong-unit", problem) from None

    def fraction(self, column: Column) -> float:
        """Return the factor from a column of numbers without a unit, or in per cent, to the numbers themselves."""
        factor = fraction_of(column.unit)
        if factor is None:
            problem = f"column {column.heading!r} has the unit {column.unit!r}; "
            raise DataFileError(self.path, f"{problem}it is a number without a unit, or in '%'.", code="wrong-unit")
        return factor

    def ratio(self, place: int, *, or_missing: bool = False) -> Array:
        """Return a column of ratios whose unit, if only ``-``, must be stated, since it may be per cent."""
        column = self.columns[place]
        factor = fraction_of(column.unit) if column.unit else None
        if factor is None:
            shown = f"the unit {column.unit!r}" if column.unit else "no unit"
            right = f"write it as '{column.name} (%)' or '{column.name} (-)'"
            raise self.refused("wrong-unit", f"column {column.heading!r} has {shown}; {right}.")
        return factor * self.numbers(place, or_missing=or_missing)

    def load_unit(self, column: int) -> str:
        """Return the unit of a load: N, or N/m of a line contact."""
        try:
            self.conversion(self.columns[column], "N/m")
        except DataFileError:
            return "N"
        return "N/m"

    def refused(
        self, code: str, problem: str, remedy: Remedy | None = None, missing: Iterable[str] = ()
    ) -> DataFileError:
        """Return an error about the header, whose values let a program ask for the columns; see `header_values`."""
        values = self.vocabulary.header_values(self.columns, missing)
        return DataFileError(self.path, Note(code, problem, remedy=remedy, values=values))

    def lacking(self, missing: Sequence[str], more: str = "") -> DataFileError:
        """Return the error of a table without columns of some quantities, which the user may name."""
        problem = f"no column for {' or '.join(missing)}; {self.vocabulary.example}, this one has {self.headings()}"
        return self.refused("missing-columns", problem + more, name_columns(self.vocabulary.key, missing), missing)

    def insist(self, good: Mask, place: int, right: str, code: str = "not-positive") -> None:
        """Refuse the first cell of a column, which must be `right`, that is not good."""
        if np.all(good):
            return
        row = int(np.argmin(good))
        problem = f"{self.rows[row][place].strip()} in column {self.columns[place].heading!r} must be {right}."
        raise DataFileError(self.path, problem, int(self.lines[row]), code=code)

    @property
    def heading_notes(self) -> list[Note]:
        """Notes on assumed bases of logarithms, means, loads in kg, films of fluid, and on what stood in headings."""
        decadic = [repr(column.heading) for column in self.columns if column.assumed_decadic]
        means = [repr(column.heading) for column in self.columns if column.is_mean]
        alone = next((repr(column.heading) for column in self.columns if column.alone), "")
        masses = [repr(one.heading) for one in self.columns if one.quantity and one.unit in MASSES]
        above = [repr(column.heading) for column in self.columns if column.above]
        films = [place for place, column in enumerate(self.columns) if column.quantity == "lubricant"]
        wet = [repr(self.columns[place].heading) for place in films if not self._is_dry(place)]
        spread = [repr(column.heading) for column in self.columns if column.spread]
        solid = [column for place, column in enumerate(self.columns) if column.quantity and place not in films]
        milli = [repr(column.heading) for column in solid if MILLIPASCAL in column.unit]
        headings = {column.heading for column in self.columns}
        said: list[tuple[str, object, str]] = [
            ("decadic-logarithms", decadic, f"Read as decadic logarithms: {' and '.join(decadic)}."),
            ("means-read", means, f"Means were read as the values: {' and '.join(means)}."),
            (
                "quantity-assumed",
                alone,
                f"Column {alone} and those beside it name no quantity; they were read as {self.vocabulary.alone}.",
            ),
            ("value-from-above", above, f"For all rows, as lines above the table state: {', '.join(above)}."),
            (
                "lubricated",
                wet,
                f"Headings suggest a lubricated test, with friction of a film outside the model: {', '.join(wet)}.",
            ),
            ("value-spread", spread, f"Blank cells of {' and '.join(spread)} were read as the value above them."),
            ("unit-assumed", milli, f"Read in MPa, as mPa (millipascal) is no unit of solids: {', '.join(milli)}."),
            (
                "mass-as-load",
                masses,
                f"Masses in {' and '.join(masses)} were read as their weights at 9.80665 m/s²: 1 kg is 1 kgf.",
            ),
        ]
        for what, name in OF_HEADINGS.items():
            plural = name.partition(" ")[0]
            text = f"No column holds a {what}; {plural} were taken from the headings"
            other = ", or from the line above each table" if what == "temperature" else ""
            said.append((f"{what}-from-title", name in headings, f"{text}{other}."))
        notes = [Note(code, text) for code, holds, text in said if holds]
        return [*notes, on_doubtful_point(self.pointed)] if self.pointed else notes

    def _is_dry(self, place: int) -> bool:
        """Return whether all cells of a column of lubricants say that there is none."""
        return all(row[place].strip().lower() in DRY for row in self.rows)

    def unused(self, used: Collection[int | None]) -> list[Column]:
        """Return the columns with a name at all other places."""
        return [column for place, column in enumerate(self.columns) if place not in used and column.name]

    @property
    def filled(self) -> list[str]:
        """Names of the columns that have a cell."""
        cells = enumerate(self.columns)
        return [one.name for place, one in cells if any(row[place].strip().lower() not in MISSING for row in self.rows)]

    def place(self, what: str) -> int | None:
        """Return the place of the one column of a quantity, or None; several such columns are an error."""
        found = [place for place, column in enumerate(self.columns) if column.quantity == what]
        if len(found) > 1:
            both = " and ".join(repr(self.columns[place].heading) for place in found)
            problem = f"{both} could each be the {what}; keep one of them"
            headings = {self.columns[place].heading for place in found}
            first = self.columns[found[0]].heading if len(headings) == len(found) else f"#{found[0] + 1}"
            raise self.refused("ambiguous-columns", problem, or_name_it(self.vocabulary.key, what, first))
        place = found[0] if found else None
        if place is not None and self.columns[place].given:
            read = [n for n, column in enumerate(self.columns) if column.quantity]
            for n in (n for n, column in enumerate(self.columns) if column.is_like(self.columns[place])):
                within = any(place < one < n for one in read) and n < max(read)
                if within and any(row[n].strip() != row[place].strip() for row in self.rows):
                    raise self.of_others(n, place, what)
        return place

    def of_others(self, place: int, read: int, what: str) -> DataFileError:
        """Return the error of a second column of a quantity, which those behind it may belong to: ``f, E', f, E''``."""
        problem = f"column {self.columns[place].heading!r} may hold the {what} of some columns, other than "
        right = f"{self.columns[read].heading!r}; give all in the same rows, or delete it if it is something else."
        return self.refused("ambiguous-columns", problem + right)

    def has(self, what: str) -> bool:
        """Return whether a column holds a quantity."""
        return any(column.quantity == what for column in self.columns)


def make_table(
    path: str,
    columns: tuple[Column, ...],
    numbered: Sequence[NumberedRow],
    *,
    decimals: Decimals | None = None,
    vocabulary: Vocabulary = NO_WORDS,
) -> Table:
    """Return a table of numbered rows under their headings, with decimal points; `decimals` are those of the file."""
    # Rows without any cell, or with none in the columns of the quantities that make a header, are left out.
    needed = {what for some in vocabulary.needed for what in some}
    places = [place for place, column in enumerate(columns) if column.quantity in needed]
    rows, lines, empty = [], [], 0
    for number, row in numbered:
        cells = list(row)
        while len(cells) > len(columns) and not cells[-1].strip():  # delimiters that close a row
            cells.pop()
        if not any(cell.strip() for cell in cells):
            continue
        if len(cells) != len(columns):
            problem = f"the row has {len(cells)} cells where the header names {len(columns)} columns."
            if len(cells) > len(columns) and all(cell.strip().lstrip("+-").isdecimal() for cell in cells):
                problem += " If decimals have commas, separate columns by semicolons or tabs."
            elif len(cells) == 1 and cells[0][:1].isalpha():
                words = repr(cells[0][:80])
                problem += f" Write what {words} states into a column, or begin it with '#' if it is a remark."
            raise DataFileError(path, problem, number, code="row-length")
        if places and not any(cells[place].strip() for place in places):
            empty += 1
            continue
        rows.append(tuple(map(plain_number, cells)))
        lines.append(number)
    if not rows:
        raise DataFileError(path, "there is a header, but no row of numbers under it.", code="no-points")
    # a remark may contain any comma, and the numbers of a sample a point
    quantities = {place for place, column in enumerate(columns) if column.quantity}
    numeric = {place for place in range(len(columns)) if all(NUMBER.fullmatch(row[place].strip()) for row in rows)}
    measured = quantities | numeric | {place for place, column in enumerate(columns) if column.unit}
    pointed = ""
    if decimals is None:
        read = quantities or measured
        pointed = doubtful_point(path, rows, lines, read)
        printed, beside = (
            [(row[place], line) for row, line in zip(rows, lines, strict=True) for place in some]
            for some in (read, measured - read)
        )
        decimals = Decimals.of(path, printed, beside)
    if decimals != Decimals():
        rows = [tuple(decimals.plain(cell) if n in measured else cell for n, cell in enumerate(row)) for row in rows]
    numbers = np.array(lines, dtype=np.int64)
    table = Table(path, columns, tuple(rows), numbers, empty_rows=empty, pointed=pointed, vocabulary=vocabulary)
    _insist_on_no_summaries(table)
    return table


def doubtful_point(path: str, rows: Sequence[Sequence[str]], lines: Sequence[int], places: Collection[int]) -> str:
    """Return the first number whose point may part thousands if no number shows what points are; refuse "802" below it.

    The places are those of columns.
    """
    if any("." in (cell := row[place].strip()) and not _POINTED.fullmatch(cell) for row in rows for place in places):
        return ""
    first = ""
    for cells in ([row[place].strip() for row in rows] for place in places):
        pointed = [cell for cell in cells if "." in cell]
        whole = [cell for cell in cells if cell.lstrip("+-").isdecimal() and cell.lstrip("+-") != "0"]
        if len(pointed) < _MOST_BY_CHANCE:
            continue
        first, line = first or pointed[0], lines[cells.index(pointed[0])]
        if whole:
            problem = f"{pointed[0]!r} may be {pointed[0]} or {pointed[0].replace('.', '')}, as {whole[0]!r} stands in "
            right = "its column; write decimals also where they are zero, or no mark between thousands."
            raise DataFileError(path, problem + right, line, code="ambiguous-decimals")
    return first


def on_doubtful_point(number: str) -> Note:
    """Return the note on numbers that were read with decimals though all could have a mark between thousands."""
    said = f"Points were read as those of decimals ({number}), though each precedes three digits; if they part "
    said += "thousands, remove them."
    return Note("decimals-assumed", said, values={"number": number})


def _insist_on_no_summaries(table: Table) -> None:
    """Refuse rows that a column of labels calls means or standard deviations, beside rows that it calls otherwise."""
    for place, column in enumerate(table.columns):
        labels = [re.sub(r"\([^)]*\)|[.:]+$", "", row[place].strip().lower()).strip() for row in table.rows]
        found = [_OF_SUMMARIES.fullmatch(label) for label in labels]
        kinds = {match["mean"] is None if match else label for match, label in zip(found, labels, strict=True)}
        # Where all rows are summaries, the means are the measurements.
        rows = [row for row, match in enumerate(found) if match and (not all(found) or not match["mean"])]
        row = rows[0] if rows else None
        if row is not None and len(kinds) > 1:
            said = f"{table.rows[row][place].strip()!r} in column {column.heading!r} marks a summary of other rows"
            problem = f"{said}, which would count as a measurement; remove such rows, or rename labels of measurements."
            raise DataFileError(table.path, problem, int(table.lines[row]), code="summary-row")


def instrument_table(
    path: str,
    columns: Sequence[tuple[str, str, str]],
    rows: Sequence[NumberedRow],
    vocabulary: Vocabulary,
    decimals: Decimals | None = None,
) -> Table:
    """Return a table of an instrument's export: its columns are name, unit and quantity, which the format knows."""
    # `decimals` as for `make_table`: a file of several tables has one decimal mark.
    headed = tuple(Column(name, name, unit, quantity) for name, unit, quantity in columns)
    return replace(make_table(path, headed, rows, decimals=decimals), vocabulary=vocabulary)


def or_name_it(key: str, what: str, said: str) -> Remedy:
    """Return the end of a sentence: the column can be named by the user, for each reader; "." without a key for it."""
    if not key:
        return Remedy(".")
    name = what.replace(" ", "_")
    shown = repr(said)
    return Remedy(
        f", or name it: columns={{{name!r}: {shown}}}.",
        f", or name it: {option_of(key)} {name}={shown}.",
        f", or name it: {key.partition('.')[2]} = {{ {name} = {shown} }} under [{key.partition('.')[0]}].",
        ", or choose the columns in the form.",
        key or None,
    )


#: Quantities that often have one value in all rows, which tables then lack.
_FOR_ALL_ROWS = {
    "load": "20 N",
    "temperature": "25 degC",
    "frequency": "10 Hz",
    "stress": "0.3 MPa",
    "strain": "5 %",
}


def name_columns(key: str, missing: Sequence[str]) -> Remedy:
    """Return the end of a sentence: the user may name the columns, for each reader."""
    name = (missing[0] if missing else "frequency").replace(" ", "_")
    table, _, own = key.partition(".")
    value = _FOR_ALL_ROWS.get(name)
    same, typed = (f", or '{said}= {value}' for all rows" if value else "" for said in ("", f"{name}="))
    return Remedy(
        f"; name them, e.g. columns={{'{name}': 'heading'}}{same}.",
        f"; name them, e.g. {option_of(key)} {name}=HEADING{typed}.",
        f'; name them, e.g. {own} = {{ {name} = "heading" }} under [{table}]{same}.',
        "; choose the columns in the form.",
        key,
    )
