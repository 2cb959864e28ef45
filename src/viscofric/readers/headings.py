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

# "E' (MPa)", "T [degC]", "v / (mm/s)", then "E' / MPa", then "T_C", "f in Hz", "Temperature, °C": tried in this order.
_BRACKETED = re.compile(
    r"^(?P<name>.*?)\s*(?:(?<!\d)/\s*)?[(\[{<]\s*(?P<unit>[^()\[\]{}<>]*?|l(?:o?g(?:10)?|n)\([^()]*\))\s*[)\]}>]$"
)
#: "E' / 10^6 Pa", "E' in 10⁶ Pa": a power of ten before the unit.
_POWERED = re.compile(
    r"^(?P<name>.*?[^\s/_,])(?:\s*[/,]\s*|\s+in\s+|\s+)(?P<unit>[x×]?\s?10(?:(?:\^|\*\*)[+−-]?\d+|[⁺⁻]?[⁰¹²³⁴-⁹]+)\s?\S.*)$"
)
_SLASHED = re.compile(r"^(?P<name>[^/]*?)\s*/\s*(?P<unit>\S.*)$")
_UNIT = (
    r"(?i:°[CKFС]|℃|deg\.? ?[CFK]|[mkM]?Hz|Гц|rad[/_]?s(?:ec)?|[kMG]?Pa|[кМГ]?Па|[kM]?psi|bar|[mkM]?N/[mc]?m(?:\^?2|²)"
    r"|dynes?/cm(?:\^?2|²)|dyn/cm(?:\^?2|²)|kgf?/[mc]m(?:\^?2|²)|[mcµμu]?m/s|1/s|rpm|1/[kMG]?Pa|mm|[µun]m|ms|min|cpm"
    r"|Cel|%)|mN"
)
_SEPARATED = re.compile(
    rf"^(?P<name>.*?[^\s/_,])(?:(?:\s+in\s+|_in_|\s*[,:]\s*|_|\s+)(?P<unit>{_UNIT})"
    r"|(?:\s+in\s+|_in_|\s*,\s*|_)(?P<letter>[CKFNsm])"
    r"|(?:\s+in\s+|\s*,\s*)(?P<rarer>[ckd]N|daN|kgf|kp|gf|lbf|kg|g|mm?/min|km/h|°|deg|rad|-))$"
)
#: "COF min" is a minimum, "t min" and "duration, min" are times.
_LEAST = re.compile(
    r"(?!(Δ ?)?t |.*(time|zeit|dauer|temps|durée|tiempo|tempo|tijd|duration|czas|čas|время|时间|時間|시간))"
    r".*[^\s,:] min",
    re.IGNORECASE,
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
#: "storage modulus E'", "貯蔵弾性率E'": words and the symbol behind them, or, with a blank, the other way round.
_CJK = r"[\u3040-\u9fff\uac00-\ud7a3]"
_WITH_SYMBOL = re.compile(rf"(?P<words>.*\S(?=\s)|{_CJK}+(?!{_CJK}))\s*\(?(?P<symbol>[^\s()]+(?:\([^\s()]*\))?)\)?")
_A_MODULUS = re.compile(
    r"(elastic |young('s)? )?modulus|module( d'(young|élasticité))?|modul|m[oó]dulo|модуль( упругости)?|弹性模量"
    r"|弾性率",
    re.IGNORECASE,
)
_CELSIUS = re.compile(r"°?[CF]|deg[CF]|℃", re.IGNORECASE)
_NUMBERED = re.compile(r"(?P<name>.*[^\d\s#.])[\s#.]*\d{1,3}")
#: "#3": the third column of a table, whatever its heading.
_PLACE = re.compile(r"#\s*(?P<number>\d{1,4})")
#: "= 20 N": what the user gives in place of a heading where all rows have the same value.
CONSTANT = re.compile(r"=\s*(?P<number>[+−-]?(\d+[.,]?\d*|[.,]\d+)([eE][+−-]?\d+)?)\s*(?P<unit>.*)")
#: "1,000": a thousand or one.
_THOUSANDS = re.compile(r"[+−-]?\d{1,3},\d{3}")
#: Letters and marks of Chinese and Japanese text, as wide as its characters: "（℃）", "（ＭＰａ）".
_FULL_WIDTH = {code: code - 0xFEE0 for code in range(0xFF01, 0xFF5F)}
#: A longer heading is not parsed.
_LONGEST_HEADING = 200
#: A column of means, such as "E' mean", is one of the quantity where there is no other.
_MEAN = re.compile(r"\b(mean|average|avg)\b\.?", re.IGNORECASE)
#: Names of columns that are read only where no other column holds their quantity.
_RATHER_OTHERS = frozenset(
    {"rotational speed", "applied load", "|cof|", "test temperature", "elastic modulus", "peak strain", "dyn. strain"}
)
# "foam_-25C", "T 25 °C": a number and its unit, separate from other letters and digits.  A minus sign follows no letter
# or digit: in "foam-25C" it may be a dash.  Between blanks it is one ("NR - 25 °C"), except in "T = - 25 °C".
_OF_A_RATE = r"(?![^\W_]|\s*/\s*(?i:min\w*|s|sec\w*|h|hr|hours?|steps?)\b)"
TEMPERATURE_IN_NAME = re.compile(
    r"(?:(?P<mark>^|[\s_=(,;@[]|(?<=[^\W\d])/)(?P<sign>[+−–-]?)|[=:(](?P<minus>\s*[-−–]\s+)|(?P<dash>[-−–]))"
    r"(?P<number>\d+(?:[.,]\d+)?)\s?_?"
    rf"(?P<unit>°C|degC|deg_C|C|K|°F|degF){_OF_A_RATE}"
)
#: Likewise "E' 10 Hz", "E'_0.1Hz".
FREQUENCY_IN_NAME = re.compile(
    r"(?:^|(?<=[\s_=(,;@[]))(?P<sign>)(?P<minus>)(?P<dash>)(?P<number>\d+(?:[.,]\d+)?)\s?_?"
    rf"(?P<unit>[mk]?Hz|rad/s){_OF_A_RATE}"
)
#: "0 - 5" of "0 - 5 °C": a range or a tolerance, but not the number of a sweep or sample ("Sweep 3 - 25 °C", "#3 - …").
_RANGE = re.compile(
    r"(?:^|(?P<word>[^\W\d_]+)[.\s]+|[^\w.,:/#-]\s*)[+−–-]?\d{1,3}(?:[.,]\d+)?\s*"
    r"(?:(?P<tolerance>±|\+/?[-−–])|[-–−—~…]|\.{2,3}|to|bis|à|до|and|und|et)\s*[+−–-]?$"
)
#: Words before a number that counts; "NR" is natural rubber.
_COUNTING = frozenset(
    {"sweep", "step", "interval", "segment", "run", "set", "part", "no", "nr", "sample", "specimen", "test", "probe"}
    | {"batch", "lot", "mix", "compound", "page", "cycle", "day", "file", "version", "position", "film", "ramp"}
    | {"coupon", "measurement", "experiment", "exp", "series", "isotherm", "trial"}
    | {"repeat", "replicate", "point", "block"}
    | {"schritt", "messung", "mischung", "charge", "échantillon", "essai", "muestra", "versuch", "lauf", "zyklus"}
    | {"serie", "prüfung", "mesure", "ensayo", "prova"}
)


def ends_range(text: str, start: int) -> bool:
    """Return whether the number that begins there is the second one of a range, of which neither may be meant."""
    found = _RANGE.search(text[:start])
    word = (found["word"] or "") if found else ""
    return found is not None and (bool(found["tolerance"]) or word == "NR" or word.lower() not in _COUNTING)


def _positive_in_name(units: str) -> re.Pattern[str]:
    return re.compile(
        r"(?:^|(?<=[\s_=:(,;@[])|(?<=[^\W\d]/))(?P<sign>)(?P<minus>)(?P<dash>)(?P<number>\d+(?:[.,]\d+)?(?:[eE][+-]?\d+)?)\s?_?"
        rf"(?P<unit>{units})(?![^\W_]|\s*[/·*-]\s*[^\W\d]|[\^²³])"
    )


#: Quantity -> a value of it with its unit in the name of another: "COF 5 N", "µ @ 20 °C", "10 mm/s".
_IN_NAMES = {
    "temperature": TEMPERATURE_IN_NAME,
    "frequency": FREQUENCY_IN_NAME,
    "load": _positive_in_name(r"[cdmk]?N/[mc]?m|(?:[cmk]|da)?N|kgf|kp|gf|lbf|kg|g"),
    "speed": _positive_in_name(r"[mcµμu]?m/(?:s|min)|km/h"),
}
#: Headings of the columns of what stood in the headings of others.
OF_HEADINGS = {
    "temperature": "temperatures of headings",
    "frequency": "frequencies of headings",
    "load": "loads of headings",
    "speed": "speeds of headings",
}
_DASH_AT_END = re.compile(r"[-−–]\s*$")
#: What a value that is cut from a heading leaves behind.
_LEFT_BEHIND = re.compile(
    r"[(\[]\s*[,;:=@|]?\s*[)\]]|(\b(at|bei|à|for|für|and|und|et|[Tf]\s*=)|[@,;:=_|])\s*(?=$|[()\[\]/])|_(?=_)|^\s*[:;,=@|/]|/\s*$",
    re.IGNORECASE,
)
#: The name of a quantity before its value, of two words or one: "load" of "COF, load = 5 N".
_LABELS = tuple(
    re.compile(rf"(?:^|(?<=[\s,;(\[_@:]))(?P<label>[^\W\d_]+[.']?{more})\s*[=:]?\s*$")
    for more in (r"[\s_][^\W\d_]+", "")
)
#: "10.00 [cm/s]" at the end of a line: a value with its unit in brackets.
_BRACKETED_VALUE = re.compile(r"(?<=\d)\s*[(\[]\s*(?P<unit>[^\s()\[\]]+)\s*[)\]]\s*$")
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
    assumed_decadic: bool = False  # whether the base is not stated: "log f (Hz)"
    is_mean: bool = False  # "E' mean (MPa)", where no column is of the quantity itself
    stated: tuple[tuple[str, str], ...] = ()  # in the heading: ("temperature", "25 °C") of "E' 25 °C (MPa)"
    above: bool = False  # the heading is a line above the table, which states the value of all rows: "Load: 20 N"
    spread: bool = False  # values stand only in the first of the rows that they hold for
    alone: bool = False  # the heading states values of other quantities, and none of its own: "25 °C, 10 N"

    @property
    def unnumbered(self) -> str:
        """The name without the number at its end: "traction force" of "traction force 2"; empty if it has none."""
        match = _NUMBERED.fullmatch(self.name)
        return match["name"] if match else ""

    def is_like(self, other: Column) -> bool:
        """Return whether its heading is that of another column, but for a number at the end of a name."""
        one, same = (heading(column.heading) for column in (self, other))
        named = (one.unnumbered or one.name) == (same.unnumbered or same.name) != "" or self.heading == other.heading
        return named and bool(self.heading) and self.quantity in ("", other.quantity) and self.unit in ("", other.unit)

    def with_unit(self, unit: str, *, logarithms: bool = False) -> Column:
        """Return the column with a unit, of logarithms where these are known and it is written so: ``log Hz``."""
        of = _logarithm(unit) if logarithms and not self.base else None
        if of is None or not of.name or of.unit:
            return replace(self, unit=unit)
        return replace(self, unit=of.name, base=of.base, assumed_decadic=of.assumed_decadic)


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
    # What headings may state of the numbers below them (``COF 20 °C, 5 N``), and the quantity of headings that state
    # nothing else.
    conditions: tuple[str, ...] = ()
    alone: str = ""
    from_above: tuple[str, ...] = ()  # conditions that a line above a table may state for all its rows: "Load: 20 N"
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
        found = next((what for one in spellings if (what := self._meaning.get(one))), "")
        both = None if found or len(plain) > _LONGEST_HEADING else _WITH_SYMBOL.fullmatch(plain)
        what = self.quantity(both["symbol"]) if both else ""  # "modulus E'", or "storage modulus E'"
        if both is None or not what:
            return found
        return what if _A_MODULUS.fullmatch(both["words"]) or what == self.quantity(both["words"]) else ""

    def column(self, text: str) -> Column:
        """Return the column under a heading, with the quantity that it names, or of which it names the logarithm."""
        found = heading(text)
        what = self.quantity(found.name)
        of = None if what or not self.logarithms else _logarithm(found.heading)
        if of and (inner := self.quantity(of.name)):
            return replace(of, quantity=inner)
        return replace(found, quantity=what).with_unit(found.unit, logarithms=self.logarithms)

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
        plain = {column.quantity for column in found if not column.base} & {*(self.needed[0] if self.needed else ())}
        found = [
            replace(one, quantity="", base=0.0, assumed_decadic=False) if one.base and one.quantity in plain else one
            for one in found
        ]
        first = {column.quantity for column in found if column.name.lower() not in _RATHER_OTHERS}
        doubled = [one.quantity in first and one.name.lower() in _RATHER_OTHERS for one in found]
        found = [replace(one, quantity="") if other else one for one, other in zip(found, doubled, strict=True)]
        held = {column.quantity for column in found} | {*self.user_columns, *self.constants}
        for n, column in enumerate(found):
            what = "" if column.quantity else self.quantity(_MEAN.sub("", column.name).strip())
            if what in self.means and what not in held:
                found[n] = replace(column, quantity=what, is_mean=True)
        if self.conditions:
            found = self._with_conditions(found, held)
        places = {what: place_of(said, cells) for what, said in self.user_columns.items()}
        alike = {what: self._as_headed(self.user_columns[what], at, cells) for what, (at, _) in places.items()}
        often = len({len(some) for some in alike.values()}) == 1  # as in tables beside each other
        for what, (_, unit) in places.items():
            for place in alike[what] if often else alike[what][:1]:
                column = found[place]
                if _SAID_LOGARITHM.match(column.heading) and not _OF_LOGARITHMS.fullmatch(what):
                    column = _logarithm(column.heading) or column
                named = replace(column, quantity=what, unit=unit or column.unit, given=True)
                found[place] = replace(named, stated=(), alone=False)
        return tuple(found)

    @staticmethod
    def _as_headed(said: str, place: int | None, cells: Sequence[str]) -> list[int]:
        """Return the places of all columns with the heading that the user names, only that of its number."""
        if place is None or is_place(said):
            return [] if place is None else [place]
        return [n for n, cell in enumerate(cells) if " ".join(cell.split()) == " ".join(cells[place].split())]

    def _with_conditions(self, columns: list[Column], held: set[str]) -> list[Column]:
        """Return columns with what their headings state of quantities that no column holds: ``COF 20 °C, 5 N``."""
        # Those that state something without any quantity that a header needs are left as they are, and all where
        # another column holds one of their quantities, or a temperature may be below or above zero.
        lacks = {what: _IN_NAMES[what] for what in self.conditions if not any(what in one for one in held)}
        found = [self._conditioned(column, lacks) for column in columns]
        signed = [pattern for what, pattern in lacks.items() if what == "temperature"]
        if any(one.stated for one in found) and any(_doubtful(one.heading, signed) for one in found if not one.stated):
            return columns
        named = any(one.quantity == self.alone and not one.alone for one in found) or self.alone in self.user_columns
        if named or held.isdisjoint(self.conditions):
            found = [before if one.alone else one for one, before in zip(found, columns, strict=True)]
        single = {column.quantity for column in found if not column.stated} | {*self.user_columns}
        of_values: dict[tuple[tuple[str, str], ...], set[str]] = {}
        for column in found:
            if column.stated:
                of_values.setdefault(column.stated, set()).add(column.quantity)
        needed = {what for some in self.needed for what in some} - {*self.conditions}
        if any(own & single for own in of_values.values()):
            return columns
        bare = {stated for stated, own in of_values.items() if not own & needed}
        return [before if one.stated in bare else one for one, before in zip(found, columns, strict=True)]

    def _conditioned(self, column: Column, lacks: Mapping[str, re.Pattern[str]]) -> Column:
        """Return the column with what its heading states, one value of each quantity, or as it is."""
        rest, stated = self._parted(column.heading, lacks)
        if not stated or len({what for what, _ in stated}) < len(stated):
            return column
        of = self.column(rest)
        if not of.quantity and (what := self.quantity(_MEAN.sub("", of.name).strip())) in self.means:
            of = replace(of, quantity=what, is_mean=True)
        alone = bool(self.alone) and not rest.strip()
        if alone:
            of = replace(of, quantity=self.alone)
        own = of.quantity.split()
        if not own or "isotherm" in own or any(what in own for what, _ in stated):
            return column
        if column.quantity and column.quantity != of.quantity:
            return column
        return replace(of, heading=column.heading, stated=stated, alone=alone)

    def _parted(self, text: str, lacks: Mapping[str, re.Pattern[str]]) -> tuple[str, tuple[tuple[str, str], ...]]:
        """Return a heading without the values that it states, and these with their quantities; none where doubtful."""
        found = [(what, one) for what, pattern in lacks.items() for one in pattern.finditer(text)]
        rest, stated = text, []
        for what, one in sorted(found, key=lambda value: value[1].start(), reverse=True):
            start = one.start("minus" if one["minus"] else "dash" if one["dash"] else "sign")
            is_dash = one["dash"] or (what == "temperature" and _DASH_AT_END.search(text[:start]))  # or a minus sign
            if is_dash or ends_range(text, one.start("number")):
                return text, ()
            labels = [label for pattern in _LABELS if (label := pattern.search(rest[:start]))]
            start = next((one.start("label") for one in labels if self.quantity(one["label"]) == what), start)
            rest = rest[:start] + rest[one.end() :]
            below_zero = one["minus"] or one["sign"] in ("-", "−", "–")
            stated.append((what, f"{'-' if below_zero else ''}{one['number']} {one['unit'].strip('_')}"))
        while (shorter := _LEFT_BEHIND.sub("", rest)) != rest:
            rest = shorter
        return rest, tuple(sorted(stated))

    def has_value(self, text: str) -> bool:
        """Return whether a text holds values of the conditions of headings, perhaps with a dash before one."""
        return any(_IN_NAMES[what].search(text) for what in self.conditions)

    def is_doubtful(self, text: str) -> bool:
        """Return whether a measured value has a temperature behind a dash, which may be a minus sign."""
        return "temperature" in self.conditions and _doubtful(text, [TEMPERATURE_IN_NAME])

    def quantity_of_rest(self, text: str) -> str:
        """Return the quantity that is left of a heading without the values that it states, "" for none."""
        return self.column(text).quantity if text.strip() else ""

    def stated_in(self, text: str) -> tuple[str, tuple[tuple[str, str], ...]]:
        """Return what a text says besides values of the conditions of headings, and these with their quantities."""
        return self._parted(" ".join(text.split()), {what: _IN_NAMES[what] for what in self.conditions})


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
    kind = log["kind"].lower()
    return replace(of, heading=text, base=math.e if kind == "ln" else 10.0, assumed_decadic=kind == "log")


#: The vocabulary of a table whose columns are found by names alone.
NO_WORDS = Vocabulary("a table", {}, (), key="")


def quantity_of(key: object) -> str:
    """Return a quantity as vocabularies have it: ``"storage modulus"`` of ``storage_modulus``."""
    return " ".join(re.split(r"[\s_-]+", str(key).strip().lower()))


def place_of(said: str, cells: Sequence[str]) -> tuple[int | None, str]:
    """Return the place of the column that the user means, None if there is none, and the unit added to it, or ""."""
    # `said` is a heading as printed, without regard to case, or the number of a column (``"#3"``); a unit may follow in
    # brackets, which then counts instead of that of the file. Of several equal headings the first counts,
    # but for tables beside each other (`Vocabulary.columns`).
    bracketed = _BRACKETED.match(said)
    for words, unit in ((said, ""), (bracketed["name"], bracketed["unit"]) if bracketed else ("", "")):
        numbered = _PLACE.fullmatch(words)
        if numbered and 0 < int(numbered["number"]) <= len(cells):
            return int(numbered["number"]) - 1, unit
        for place, cell in enumerate(cells):
            if words and " ".join(cell.split()).casefold() == words.casefold():
                return place, unit
    return None, ""


def plain_value(text: str) -> str:
    """Return a line with the unit at its end without brackets: ``Load : 5.00 N`` of ``Load : 5.00 [N]``."""
    return _BRACKETED_VALUE.sub(r" \g<unit>", text)


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
    plain = re.sub("[º˚]", "°", with_primes(text.translate(_FULL_WIDTH)))
    name, unit = plain, ""
    has_none = _FUNCTION.fullmatch(plain) or _LEAST.fullmatch(plain)
    for pattern in () if has_none else (_BRACKETED, _POWERED, _SEPARATED, _SLASHED, _LETTER):
        match = pattern.match(plain)
        if match:
            groups = match.groupdict()
            name, unit = match["name"], match["unit"] or groups.get("letter") or groups.get("rarer") or ""
            break
    if name.strip() in ("t", "T") and (_CELSIUS.fullmatch(unit) or unit in ("s", "min")):  # whatever its case
        name = "t" if unit in ("s", "min") else "T"
    return Column(text, " ".join(name.replace("_", " ").split()), unit)
