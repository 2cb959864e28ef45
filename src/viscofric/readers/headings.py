"""Headings of columns: name, unit, and the quantity that a vocabulary, or the user, sees in them."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, Literal

from viscofric.errors import InputError, brief, wrong_argument

# "E' (MPa)", "T [degC]", then "E' / MPa", then "T_C", "f in Hz", "Temperature, °C": tried in this order.
_BRACKETED = re.compile(r"^(?P<name>.*?)\s*[(\[]\s*(?P<unit>[^()\[\]]*?)\s*[)\]]$")
_SLASHED = re.compile(r"^(?P<name>[^/]*?)\s*/\s*(?P<unit>\S.*)$")
_UNIT = (
    r"(?i:°[CKF]|℃|deg[CFK]|[mkM]?Hz|rad[/_]?s(?:ec)?|[kMG]?Pa|[kM]?psi|bar|[mkM]?N/[mc]?m(?:\^?2|²)|dynes?/cm(?:\^?2|²)"
    r"|dyn/cm(?:\^?2|²)|kgf?/[mc]m(?:\^?2|²)|[mcµu]?m/s|1/s|rpm|1/[kMG]?Pa|mm|[µun]m|ms|min|cpm|Cel|%)|mN"
)
_SEPARATED = re.compile(
    rf"^(?P<name>.*?[^\s/_,])(?:(?:\s+in\s+|_in_|\s*,\s*|_|\s+)(?P<unit>{_UNIT})"
    r"|(?:\s+in\s+|_in_|\s*,\s*|_)(?P<letter>[CKFNsm]))$"
)
_LETTER = re.compile(r"^(?P<name>.*temp[^\s_]*|T)[\s_]+(?P<unit>[ckf])$", re.IGNORECASE)
#: "log10(aT)", "tan(δ)", "a(T)", "compliance J(t)": brackets that hold an argument, not a unit.
_FUNCTION = re.compile(
    r"((log[\s_]*10|log|lg|ln|tan)[\s_]*[(\[][^()\[\]]*"
    r"|((log[\s_]*10|log|lg|ln)?[\s_]*(a|α|alpha)\s*[(\[]\s*T\s*)|(.*[\s_])?[JDEG]\s*\(\s*t\s*)[)\]]",
    re.IGNORECASE,
)
#: "log f (Hz)", "log10(E'/Pa)", "ln(ω) (rad/s)": a logarithm, and what it is of.
_LOGARITHM = re.compile(r"(?P<kind>log[\s_]*10|log|lg|ln)[\s_]*(?P<of>\S.*)", re.IGNORECASE)
#: Of a column that the user names, the beginning has to be a word of its own: "logger time" and "LN2 bath" are none.
_SAID_LOGARITHM = re.compile(r"(log[\s_]*10|log|lg|ln)(?=[\s_(\[]|[eg]['*])", re.IGNORECASE)
#: Quantities that are of logarithms already, by the beginning or the end of their names.
_OF_LOGARITHMS = re.compile(r"log.*|.*(error|scatter)")
_ARGUMENT = re.compile(r"\((?P<first>[^()]*)\)(?P<rest>.*)|\((?P<whole>.*)\)")
_CELSIUS = re.compile(r"°?[CF]|deg[CF]|℃", re.IGNORECASE)
_NUMBERED = re.compile(r"(?P<name>.*[^\d\s#.])[\s#.]*\d{1,3}")
#: "#3": the third column of a table, whatever its heading.
_PLACE = re.compile(r"#\s*(?P<number>\d{1,4})")
#: "= 20 N": what the user gives in place of a heading where all rows have the same value.
CONSTANT = re.compile(r"=\s*(?P<number>[+−-]?(\d+[.,]?\d*|[.,]\d+)([eE][+−-]?\d+)?)\s*(?P<unit>.*)")
#: "1,000": a thousand or one.
_THOUSANDS = re.compile(r"[+−-]?\d{1,3},\d{3}")
#: A longer heading is not parsed.
_LONGEST_HEADING = 200
#: A column of means, such as "E' mean", is one of the quantity where there is no other.
_MEAN = re.compile(r"\b(mean|average|avg)\b\.?", re.IGNORECASE)
# "foam_-25C", "T 25 °C": a number and its unit, separate from other letters and digits.  A minus sign follows no letter
# or digit: in "foam-25C" it may be a dash.  Between blanks it is one ("NR - 25 °C"), except in "T = - 25 °C".
_OF_A_RATE = r"(?![^\W_]|\s*/\s*(?i:min\w*|s|sec\w*|h|hr|hours?|steps?)\b)"
TEMPERATURE_IN_NAME = re.compile(
    r"(?:(?P<mark>^|[\s_=(,;@[])(?P<sign>[+−–-]?)|[=:(](?P<minus>\s*[-−–]\s+)|(?P<dash>[-−–]))"
    r"(?P<number>\d+(?:[.,]\d+)?)\s?_?"
    rf"(?P<unit>°C|degC|deg_C|C|K|°F|degF){_OF_A_RATE}"
)
#: Likewise "E' 10 Hz", "E'_0.1Hz".
FREQUENCY_IN_NAME = re.compile(
    r"(?:^|(?<=[\s_=(,;@[]))(?P<sign>)(?P<minus>)(?P<dash>)(?P<number>\d+(?:[.,]\d+)?)\s?_?"
    rf"(?P<unit>[mk]?Hz|rad/s){_OF_A_RATE}"
)
#: Heading of the column of frequencies that stood in the headings of others.
FREQUENCIES_OF_HEADINGS = "frequencies of headings"
_DASH_AT_END = re.compile(r"[-−–]\s*$")
#: What a temperature or frequency that is cut from a heading leaves behind.
_LEFT_BEHIND = re.compile(
    r"[(\[]\s*[)\]]|(\b(at|bei|à|[Tf]\s*=)|[@,;=_])\s*(?=$|[()\[\]/])|_(?=_)|^\s*[:;,=]", re.IGNORECASE
)
#: Names are the same with and without these: "a_T", "a(T)", "aT".
_MARKS = re.compile(r"[\s_().·\[\]-]")


@dataclass(frozen=True)
class Column:
    """One column's heading as printed, its name (single-spaced, all primes as ``'`` and ``''``) and its unit, or ""."""

    heading: str
    name: str
    unit: str
    quantity: str = ""  # of the vocabulary
    given: bool = False  # named by the user, not recognised
    base: float = 0.0  # of the logarithm that the numbers are, 0 where they are none
    is_mean: bool = False  # "E' mean (MPa)", where no column is of the quantity itself
    title: str = ""  # the temperature or frequency in the heading: "25 °C" of "E' 25 °C (MPa)"

    @property
    def unnumbered(self) -> str:
        """The name without the number at its end: "traction force" of "traction force 2"; empty if it has none."""
        match = _NUMBERED.fullmatch(self.name)
        return match["name"] if match else ""

    @property
    def assumed_decadic(self) -> bool:
        """Whether the numbers are logarithms of a base that the heading does not state: "log f (Hz)"."""
        return self.base == 10.0 and not re.match(r"lg|log[\s_]*10", self.heading.strip(), re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """The words that one kind of table is recognised by."""

    kind: str  # of the table, in words, such as ``"a DMA table"``
    # Quantity, such as ``"storage modulus"`` -> names of its columns, as printed or in lower case.
    quantities: Mapping[str, frozenset[str]]
    needed: tuple[tuple[str, ...], ...]  # a header names at least one quantity of each
    example: str = ""  # headings of such a table, for errors
    key: str = "material.columns"  # path of the run file's key with the user's own headings
    offered: tuple[tuple[str, str], ...] = ()  # quantities that a form offers, each with an example of its unit
    user_columns: Mapping[str, str] = field(default_factory=dict)  # quantity -> heading, see `checked`
    constants: Mapping[str, str] = field(default_factory=dict)  # quantity -> "= 20 N", the value in all rows
    logarithms: bool = False  # whether columns may hold logarithms of the quantities
    means: frozenset[str] = frozenset()  # quantities of which columns of means are read where there are no others
    # Whether several tables below each other are one, all rows alike, or of the temperatures in the lines above each.
    several: Literal["refused", "rows", "titled"] = "refused"

    @cached_property
    def _meaning(self) -> dict[str, str]:
        found: dict[str, str] = {}
        for what, names in self.quantities.items():
            for name in names:
                found.setdefault(name, what)
        for name, what in list(found.items()):
            found.setdefault(_MARKS.sub("", name), what)
        return found

    def quantity(self, name: str) -> str:
        """Return the quantity that a heading without its unit names, or ""."""
        plain = unicodedata.normalize("NFC", name)
        lower = plain.lower()
        spellings = (plain, *(one for one in (lower, _MARKS.sub("", lower)) if len(one) > 1))
        return next((what for one in spellings if (what := self._meaning.get(one))), "")

    def column(self, text: str) -> Column:
        """Return the column under a heading, with the quantity that it names, or of which it names the logarithm."""
        found = heading(text)
        what = self.quantity(found.name)
        of = None if what or not self.logarithms else _logarithm(found.heading)
        if of and (inner := self.quantity(of.name)):
            return replace(of, quantity=inner)
        return replace(found, quantity=what)

    def missing(self, found: Iterable[str]) -> list[str]:
        """Return what a header of these quantities lacks, one word for each of `needed`."""
        named = {*found, *self.constants}
        return [one[0] for one in self.needed if not named & set(one)]

    def checked(self, columns: Mapping[Any, Any] | None) -> dict[str, str]:
        """Return the user's own headings by quantity, which may be written with underscores, or raise `InputError`."""
        named: dict[str, str] = {}
        if columns is not None and not isinstance(columns, Mapping):
            raise wrong_argument(
                "columns",
                columns,
                "must map quantities to headings, such as {'frequency': 'f in Hz'}.",
                "wrong-columns",
                self.key,
            )
        given = columns or {}
        for key, said in given.items():
            what = quantity_of(key)
            if what not in self.quantities:
                known = ", ".join(one.replace(" ", "_") for one in self.quantities)
                problem = f"columns: {brief(key)} is not a quantity of {self.kind}; known are {known}."
                raise InputError(problem, code="unknown-quantity", field=self.key)
            if not isinstance(said, str) or not said.strip():
                problem = f"columns: {what} = {brief(said)}: must be a heading as text."
                raise InputError(problem, code="wrong-columns", field=self.key)
            named[what] = " ".join(said.split())
            value = CONSTANT.fullmatch(named[what])
            if said.lstrip().startswith("=") and (not value or _THOUSANDS.fullmatch(value["number"])):
                right = "must be a number with its unit, as in '= 20 N', without a mark for thousands"
                problem = f"columns: {what} = {brief(said)}: after '=' {right}."
                raise InputError(problem, code="wrong-columns", field=self.key)
        return named

    def with_columns(self, columns: Mapping[str, str]) -> Vocabulary:
        """Return the vocabulary with the user's own headings and values of all rows, as `checked` returns them."""
        constants = {what: said for what, said in columns.items() if said.startswith("=")}
        headings = {what: said for what, said in columns.items() if what not in constants}
        return replace(self, user_columns=headings, constants=constants)

    def header_values(self, columns: Sequence[Column], missing: Iterable[str]) -> dict[str, Any]:
        """Return the values of an error about a header, from which a form can ask for the columns."""
        # ``headings`` found, quantities ``missing``, those ``known`` with their headings, what a form ``offered`` to
        # name with examples of units, and the ``key`` of the run file.
        return {
            "headings": [column.heading for column in columns],
            "missing": list(missing),
            "known": {column.quantity: column.heading for column in columns if column.quantity},
            "offered": [list(one) for one in self.offered],
            "key": self.key,
        }

    def columns(self, cells: Sequence[str]) -> tuple[Column, ...]:
        """Return the columns under a row of headings, each with the quantity that it names or that the user says."""
        found = []
        for cell in cells:
            column = self.column(cell)
            given = column.quantity in self.user_columns or column.quantity in self.constants
            found.append(replace(column, quantity="" if given else column.quantity))
        held = {column.quantity for column in found} | {*self.user_columns, *self.constants}
        for n, column in enumerate(found):
            what = "" if column.quantity else self.quantity(_MEAN.sub("", column.name).strip())
            if what in self.means and what not in held:
                found[n] = replace(column, quantity=what, is_mean=True)
        if self.several == "titled":
            found = self._with_titles(found, held)
        for what, said in self.user_columns.items():
            place, unit = place_of(said, cells)
            if place is not None:
                column = found[place]
                if _SAID_LOGARITHM.match(column.heading) and not _OF_LOGARITHMS.fullmatch(what):
                    column = _logarithm(column.heading) or column
                found[place] = replace(column, quantity=what, unit=unit or column.unit, given=True, title="")
        return tuple(found)

    def _with_titles(self, columns: list[Column], held: set[str]) -> list[Column]:
        """Return columns with the temperatures or frequencies of their headings, where no column holds these."""
        # Those of a temperature without any quantity that a header needs are left as they are, and all where another
        # column holds one of their quantities, or a temperature may be below or above zero.
        lacks = [
            pattern
            for pattern, has in ((TEMPERATURE_IN_NAME, "temperature"), (FREQUENCY_IN_NAME, "frequency"))
            if has in self.quantities and not any(has in what for what in held)
        ]
        found = [self._titled(column, lacks) for column in columns]
        if any(one.title for one in found) and any(_doubtful(one.heading, lacks) for one in found if not one.title):
            return columns
        single = {column.quantity for column in found if not column.title} | {*self.user_columns}
        of_titles: dict[str, set[str]] = {}
        for column in found:
            if column.title:
                of_titles.setdefault(column.title, set()).add(column.quantity)
        needed = {what for some in self.needed for what in some}
        if any(own & single for own in of_titles.values()):
            return columns
        bare = {title for title, own in of_titles.items() if not own & needed}
        return [before if one.title in bare else one for one, before in zip(found, columns, strict=True)]

    def _titled(self, column: Column, patterns: Sequence[re.Pattern[str]]) -> Column:
        """Return the column with the temperature or frequency that its heading states as its title, or as it is."""
        found = [one for pattern in patterns for one in pattern.finditer(column.heading)]
        if len(found) != 1 or (column.quantity and column.unit != found[0][0].strip("( [")):
            return column
        (one,) = found
        start = one.start("minus" if one["minus"] else "dash" if one["dash"] else "sign")
        if one["dash"] or _DASH_AT_END.search(column.heading[:start]):  # or a minus sign
            return column
        rest = column.heading[:start] + column.heading[one.end() :]
        of = self.column(_LEFT_BEHIND.sub("", _LEFT_BEHIND.sub("", rest)))  # what is left of brackets is removed last
        if not of.quantity or any(what in of.quantity for what in ("temperature", "isotherm", "frequency")):
            return column
        below_zero = one["minus"] or one["sign"] in ("-", "−", "–")
        title = f"{'-' if below_zero else ''}{one['number']} {one['unit'].strip('_')}"
        return replace(of, heading=column.heading, title=title)


def _doubtful(text: str, patterns: Sequence[re.Pattern[str]]) -> bool:
    """Return whether a heading states a temperature behind a dash, which may be a minus sign."""
    found = [one for pattern in patterns for one in pattern.finditer(text)]
    return any(one["dash"] or _DASH_AT_END.search(text[: one.start("number")]) for one in found)


def _logarithm(text: str) -> Column | None:
    """Return the column under the heading of a logarithm, with name and unit of what it is of; None for any other."""
    log = _LOGARITHM.fullmatch(text)
    if log is None:
        return None
    argument = _ARGUMENT.fullmatch(log["of"])
    of = heading((argument["whole"] or f"{argument['first']} {argument['rest']}") if argument else log["of"])
    return replace(of, heading=text, base=math.e if log["kind"].lower() == "ln" else 10.0)


#: The vocabulary of a table whose columns are found by names alone.
NO_WORDS = Vocabulary("a table", {}, (), key="")


def quantity_of(key: object) -> str:
    """Return a quantity as vocabularies have it: ``"storage modulus"`` of ``storage_modulus``."""
    return " ".join(re.split(r"[\s_-]+", str(key).strip().lower()))


def place_of(said: str, cells: Sequence[str]) -> tuple[int | None, str]:
    """Return the place of the column that the user means, None if there is none, and the unit added to it, or ""."""
    # `said` is a heading as printed, without regard to case, or the number of a column (``"#3"``); a unit may follow in
    # brackets, which then counts instead of that of the file. Of several equal headings the first counts.
    bracketed = _BRACKETED.match(said)
    for words, unit in ((said, ""), (bracketed["name"], bracketed["unit"]) if bracketed else ("", "")):
        numbered = _PLACE.fullmatch(words)
        if numbered and 0 < int(numbered["number"]) <= len(cells):
            return int(numbered["number"]) - 1, unit
        for place, cell in enumerate(cells):
            if words and " ".join(cell.split()).casefold() == words.casefold():
                return place, unit
    return None, ""


def option_of(key: str) -> str:
    """Return the command-line option of a key with the user's own headings, or with the sheet, without its plural."""
    table, _, own = key.partition(".")
    prefix = "history-" if table == "history" else ""
    return f"--{prefix}{own.replace('_', '-').removesuffix('s')}"


def is_place(said: str) -> bool:
    """Return whether the user names a column by its number."""
    bracketed = _BRACKETED.match(said)
    return bool(_PLACE.fullmatch(bracketed["name"] if bracketed else said))


def with_primes(text: str) -> str:
    """Return text with all primes as ``'`` and ``''``."""
    return re.sub('[″”"]', "''", re.sub("[’′‘`´]", "'", text))


@lru_cache(maxsize=4096)
def heading(text: str) -> Column:
    """Split a heading into name and unit: ``"E' (MPa)"``, ``"T [degC]"``, ``"E' / MPa"``, ``"T_C"``, ``"f in Hz"``."""
    text = " ".join(text.split())
    if len(text) > _LONGEST_HEADING:
        return Column(text, text, "")
    plain = re.sub("[º˚]", "°", with_primes(text))
    name, unit = plain, ""
    for pattern in () if _FUNCTION.fullmatch(plain) else (_BRACKETED, _SEPARATED, _SLASHED, _LETTER):
        match = pattern.match(plain)
        if match:
            name, unit = match["name"], match["unit"] or match.groupdict().get("letter") or ""
            break
    if name.strip() == "t" and _CELSIUS.fullmatch(unit):  # not a time
        name = "T"
    return Column(text, " ".join(name.replace("_", " ").split()), unit)
