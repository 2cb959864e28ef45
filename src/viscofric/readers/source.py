"""The content of one file for all formats, as users name it; numbers and units as people and instruments print them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Literal, TypeAlias, cast

import numpy as np

from viscofric.arguments import insist_on
from viscofric.errors import DataFileError, InputError, wrong_argument
from viscofric.files import decoded, read_bytes
from viscofric.notes import Remedy
from viscofric.readers.headings import Vocabulary
from viscofric.units import COLDEST_PLAUSIBLE, Quantity, conversion, kelvin_hint, positive, shown_celsius

#: What a test sweeps: the frequency, the temperature or the strain amplitude.
Test: TypeAlias = Literal["frequency", "temperature", "amplitude"]


@dataclass(frozen=True, eq=False)
class Source:
    """The content of a file, opened once for all formats, with what the user stated about it."""

    path: str  # as the user named it
    data: bytes
    temperature: float | None = None  # of all points, K, if the file does not hold it
    modulus_unit: str = ""  # of the moduli, if the file does not name it
    columns: Mapping[str, str] = field(default_factory=dict)  # quantity -> heading, in the user's words
    sheet: str = ""  # of a workbook, the only one to read
    test: Test = "frequency"  # what was swept in the steps to be read, where the file tells steps apart

    @cached_property
    def text(self) -> str | None:
        """The file as text, or None if it is a binary file."""
        try:
            return decoded(_marked(self.data), self.path)
        except DataFileError:
            return None

    @property
    def stem(self) -> str:
        """The file's name without folder and ending."""
        return Path(self.path).stem


def insist_on_content(source: Source) -> None:
    """Raise `DataFileError` if the file is empty."""
    if not source.data.strip(b"\0 \t\r\n\xef\xbb\xbf\xff\xfe"):
        raise DataFileError(source.path, "the file is empty; it must hold a header and rows of numbers.", code="empty")


def checked_sheet(sheet: object) -> str:
    """Return the name of a sheet that the user asks for, "" for none, or raise `InputError`."""
    if sheet is not None and not isinstance(sheet, str):
        raise wrong_argument("sheet", sheet, "must be the name of a sheet as text.", "wrong-sheet")
    return sheet or ""


def _marked(data: bytes) -> bytes:
    """Add the missing byte-order mark to UTF-16, in which every second byte of the first ones is zero."""
    first, second = data[:200:2], data[1:200:2]
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data
    for mark, zeros, letters in ((b"\xff\xfe", second, first), (b"\xfe\xff", first, second)):
        if len(data) > 20 and 0 not in letters and zeros.count(0) > 0.8 * len(zeros):
            return mark + data[: len(data) - len(data) % 2]
    return data


#: Marks of lines that are no part of a table: "# Operator", "% NR, film", "// 2020", "! cooled"; but "%" is a unit too,
#: alone in its cell, before a strain, or before other units that blanks part.
_REMARK = re.compile(
    r"(?:%(?! ?(?:strain|dehnung|deform|défor)|(?: +(?:°?[CFK]|[mk]?Hz|rad/s|[kMG]?Pa|[kmµun]?m|[km]?N|m?s|min|-))+$)"
    r"|//|!)(?= ?[^\W\d_]| ?[\"'(\[|°])|(?:%|//|!)+[-=*_ ]*$",
    re.IGNORECASE,
)
#: Two numbers beside each other: such a line is a row, of which a word ("!bad") marks the first cell.
_NUMBERS = re.compile(r"(?:[\t;, ]\s*[+-]?\d[\d.]*(?:e[+-]?\d+)?\s*(?=[\t;, ]|$)){2}", re.IGNORECASE)
#: "End of data", "*** Ende ***": what closes a table, but not headings ("End; T (°C)").
_END = re.compile(
    r"\W*(?:(?:end|ende|fin|fine|einde|slut|konec|koniec|конец|结束|終了)\b[^\d:=;,\t('\"]{0,40}"
    r"|eof|datenende|dateiende)\W*",
    re.IGNORECASE,
)
_LONGEST_END = 60


def remark(line: str) -> str | None:
    """Return what a line says behind the mark of a remark, "" if it only closes a table, None if it is of a table."""
    plain = line.strip()
    if plain.startswith("#"):
        return plain.lstrip("# ")
    if _REMARK.match(plain) and not _NUMBERS.search(plain):
        return plain.lstrip("%/! ")
    return "" if len(plain) < _LONGEST_END and _END.fullmatch(plain) else None


COMMA_NUMBER = re.compile(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*%?\s*")
_GROUPED = re.compile(r"[+-]?\d{1,3}(?:[ \u00a0\u2009\u202f'’]\d{3})+(?:[.,]\d+)?\s*%?")
LIKE_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}\s*%?")
#: Relative agreement of Hz and rad/s in one row, both printed with about two digits.
PRINTED_FREQUENCY = 0.05

#: Units of temperature as instruments print them, which pint would read as coulomb, farad or nothing.
_TEMPERATURE_UNITS = dict.fromkeys(
    ("c", "с", "cel", "degc", "gradc", "celsius", "degreescelsius", "oc", "øc", ">c", "âc", "\ufffdc"), "degC"
)  # the second one Russian, the last ones damaged
_TEMPERATURE_UNITS |= {"f": "degF", "degf": "degF", "fahrenheit": "degF", "degreesfahrenheit": "degF", "k": "K"}
#: Units of angles as instruments print them; pint would read "grad" as gradians and "%" as a part of a radian.
_ANGLES = dict.fromkeys(
    ("°", "º", "˚", "deg", "deg.", "degree", "degrees", "grad", "degré", "degrés", "grados", "gradi"), "deg"
)
_ANGLES |= {"rad": "rad", "radian": "rad", "radians": "rad", "mrad": "mrad"}
#: Units as people and instruments print them, in lower case -> as pint knows them.
_SPELLINGS = {
    one.casefold(): one
    for one in (
        *("Pa", "kPa", "MPa", "GPa", "psi", "ksi", "N", "kN", "1/Pa", "1/kPa", "1/MPa", "1/GPa", "Hz", "kHz"),
        *("mm/s", "cm/s", "m/s", "um/s", "s", "ms", "min", "um", "mm", "cm", "m"),
    )
} | {
    "kpsi": "ksi",
    "pascal": "Pa",
    "megapascals": "MPa",
    "newton": "N",
    "newtons": "N",
    "sec": "s",
    "std": "h",
    "秒": "s",
    "па": "Pa",
    "кпа": "kPa",
    "мпа": "MPa",
    "н": "N",
    "с": "s",
    "мм/с": "mm/s",
    "м/с": "m/s",
    "rpm": "revolutions_per_minute",
    "n/mm²": "MPa",
    "mn/m²": "MPa",
    "kn/m²": "kPa",
    "n/m²": "Pa",
    "dyn/cm²": "dyn/cm²",
    "dynes/cm²": "dyn/cm²",
    "dyne/cm²": "dyn/cm²",
    **{f"{force}/{length}²": f"kgf/{length}²" for force in ("kgf", "kp") for length in ("cm", "mm")},
    "kp": "kgf",
}
#: Units of mass in which loads are given -> their weight, N.
MASSES = {"kg": 9.80665, "g": 9.80665e-3, "lb": 4.4482216152605}
_PREFIXES = {"m": 1e-3, "k": 1e3, "K": 1e3, "M": 1e6}


#: Units of ratios and strains -> factor to the number itself.
_FRACTIONS = dict.fromkeys(
    ("", "1", "-", "–", "N/N", "m/m", "mm/mm", "µm/µm", "dimensionless", "unitless", "no unit"), 1.0
)
_FRACTIONS |= {"no units": 1.0, "%": 0.01, "‰": 1e-3, "mm/m": 1e-3, "µm/m": 1e-6, "µε": 1e-6, "microstrain": 1e-6}
#: "10^6 Pa", "×10⁶ Pa", "E+06 Pa", "10⁻³": a power of ten before a unit, or in place of one.
_POWER = re.compile(
    r"[x×]?\s*(?:10(?:\s*(?:\^|\*\*)\s*|(?=[+−-]))(?P<plain>[+−-]?\d{1,2})|10(?P<raised>[⁺⁻]?[⁰¹²³⁴-⁹]{1,2})"
    r"|1?[eE](?P<printed>[+-]?\d{1,2}))\s*[·*.×]?\s*(?P<of>(?!\d\d|[.,]).*)"
)
_LONGEST_UNIT = 40
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻−", "0123456789+--")


def _power_of_ten(text: str) -> tuple[int, str]:
    """Return the exponent of a power of ten before a unit, 0 without one, and the unit."""
    found = _POWER.fullmatch(text.strip()) if len(text) < _LONGEST_UNIT else None
    if found is None:
        return 0, text
    exponent = found["plain"] or found["raised"] or found["printed"]
    return int(exponent.translate(_RAISED)), f"1{found['of']}" if found["of"].startswith("/") else found["of"]


def fraction_of(unit: str) -> float | None:
    """Return the factor from a ratio or strain as printed to the number itself, None for the unit of anything else."""
    exponent, rest = _power_of_ten(unit)
    factor = _FRACTIONS.get(rest.strip().replace("μ", "µ"))
    # "(×10³)" may mean that the numbers were multiplied.
    return None if factor is None or exponent > 0 else factor * 10.0**exponent


def plain_number(cell: str) -> str:
    """Return a cell with a plain minus sign, and without blanks or apostrophes between thousands."""
    text = cell.strip()
    if text.isascii() and " " not in text and "'" not in text:
        return text
    text = text.replace("−", "-")
    if text[:1] in ("–", "‒") and text[1:2].isdigit():
        text = f"-{text[1:]}"
    return re.sub("[^0-9.,%+-]", "", text) if _GROUPED.fullmatch(text) else text


def decimal_comma(path: str, cells: Iterable[tuple[str, int | None]]) -> bool:
    """Return whether decimals have a comma, from the numbers of a file as printed, each with its row."""
    commas = [(cell.strip(), row) for cell, row in cells if COMMA_NUMBER.fullmatch(cell)]
    if commas and all(LIKE_THOUSANDS.fullmatch(cell) for cell, _ in commas):
        cell, row = commas[0]
        as_decimal, as_thousands = cell.replace(",", "."), cell.replace(",", "")
        problem = f"{cell!r} may be {as_decimal} or {as_thousands}, since every comma precedes three digits; "
        raise DataFileError(
            path, problem + "write decimals with a point, without thousands separators.", row, code="ambiguous-decimals"
        )
    return bool(commas)


#: A number with points or commas, and one whose marks between thousands are these.
_PRINTED = re.compile(r"[+-]?\d*[.,][\d.,]*([eE][+-]?\d+)?\s*%?")
_THOUSANDS = {
    ",": re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+(\.\d*)?\s*%?"),
    ".": re.compile(r"[+-]?[1-9]\d{0,2}(\.\d{3})+(,\d*)?\s*%?"),
}


def decides(cell: str, mark: str) -> bool:
    """Return whether a mark can only part thousands in a number: it does so twice, or has the other one behind it."""
    return bool(_THOUSANDS[mark].fullmatch(cell)) and (cell.count(mark) > 1 or ("." if mark == "," else ",") in cell)


@dataclass(frozen=True)
class Decimals:
    """The separators of thousands (usually none) and decimals in one file."""

    thousands: str = ""
    point: str = "."

    @classmethod
    def of(cls, path: str, cells: Iterable[tuple[str, int]], beside: Iterable[tuple[str, int]] = ()) -> Decimals:
        """Return those of all numbers among cells, each with its row, or raise `DataFileError` if they contradict.

        Cells `beside` them may contradict; they only show that commas are those of decimals.
        """
        marked = [(cell.strip(), row) for cell, row in cells if "," in cell or "." in cell]
        if not any("," in cell or cell.count(".") > 1 for cell, _ in marked):
            return cls()
        numbers = [(cell, row) for cell, row in marked if _PRINTED.fullmatch(cell)]
        commas, points = ([one for one in numbers if mark in one[0]] for mark in ",.")
        for mark, point, own in ((",", ".", commas), (".", ",", points)):
            # one number decides; without it, "1.500" beside "2,5" may be 1500 or 1.5
            if any(decides(cell, mark) for cell, _ in own) and all(_THOUSANDS[mark].fullmatch(cell) for cell, _ in own):
                return cls(mark, point)
        if not commas or not points:
            return cls("", "," if decimal_comma(path, [*commas, *(beside if commas else ())]) else ".")
        problem = (
            f"{points[0][0]!r} has a point, but other numbers of the file have a comma, so that decimals and "
            "thousands cannot be distinguished; write all decimals in one way."
        )
        raise DataFileError(path, problem, points[0][1], code="mixed-decimals")

    def plain(self, cell: str) -> str:
        """Return a number with a decimal point and without separators of thousands, any other cell as it is."""
        if self == Decimals() or not _PRINTED.fullmatch(cell.strip()):
            return cell
        plain = cell.replace(self.thousands, "") if self.thousands else cell
        plain = plain.replace(",", ".") if self.point == "," else plain
        return plain if plain.count(".") < 2 else cell


def unit_conversion(text: str, unit: str, name: str = "unit") -> tuple[float, float]:
    """Return ``(factor, offset)`` to an SI unit as `viscofric.units.conversion`, also for plain powers (``N/mm2``)."""
    # A unit that is none as it is written is read without regard to case: ``Mpa`` and ``mpa`` are MPa, ``mPa`` is not.
    insist_on(text, name, str, right="the text of a unit, such as 'MPa'")
    exponent, rest = _power_of_ten(text)
    # "10^-6 Pa" may mean that the numbers were multiplied by it: no solid is so soft.
    if exponent and unit != "K" and not (exponent < 0 and unit == "Pa") and not (exponent > 0 and unit == "1/Pa"):
        factor, offset = unit_conversion(rest, unit, name)
        return factor * 10.0**exponent, offset
    if unit == "K":
        text = _TEMPERATURE_UNITS.get(
            re.sub(r"[°º˚.^*\s]", "", text.replace("â„ƒ", "C").replace("℃", "C")).lower(), text
        )
    if unit == "rad":
        text = _ANGLES.get(text.strip().lower(), "an unknown unit")
    if unit == "N" and text.strip() in MASSES:
        return MASSES[text.strip()], 0.0
    plain = re.sub(
        r"(?<=\w)[ .·*]+(?P<per>m|mm|cm|s|min)\^?[-−](1|(?P<two>2))$", r"/\g<per>\g<two>", text.strip()
    )  # mm s-1
    plain = re.sub(r"(?<=m)\s?(\^|\*\*)?2(?=$|/)", "²", plain)
    folded = plain.replace(" ", "").casefold()
    try:
        return conversion(plain, unit, name)
    except InputError:
        if folded not in _SPELLINGS:
            raise
        return conversion(_SPELLINGS[folded], unit, name)


def converted(number: str, unit: str, si: str) -> float | None:
    """Return a number as printed in an SI unit, None if its unit is of another kind."""
    try:
        factor, offset = unit_conversion(unit, si)
        return factor * float(plain_number(number).replace(",", ".")) + offset
    except (InputError, ValueError):
        return None


def is_revolutions(unit: str) -> bool:
    """Return whether a unit is that of revolutions per minute."""
    return bool(re.fullmatch(r"rpm|(1|u|r|tr|rev|umdr?\.?)/min\.?|min(\^?-1|⁻¹)", unit.replace(" ", ""), re.IGNORECASE))


def to_rad_per_second(unit: str, *, angular: bool) -> float | None:
    """Return the factor from a printed frequency to rad/s, None if the unit does not determine it."""
    # pint treats the radian as a pure number, so Hz and rad/s are distinguished here. A frequency in 1/s may be either;
    # an angular frequency in 1/s is in rad/s.
    plain = unit.replace(" ", "")
    if re.fullmatch(r"rad(/s|/sec|_s|s\^?-1|·s⁻¹|s⁻¹|[*.·]s\^?-1)", plain, re.IGNORECASE):
        return 1.0
    if re.fullmatch(r"1/s|s\^?-1|s⁻¹", plain):
        return 1.0 if angular else None
    if re.fullmatch(r"[mkM]?Hz|hertz|Гц|cps|cycles?/s(ec)?", plain, re.IGNORECASE) and not angular:
        if plain in ("MHZ", "mhz"):  # of either case
            return None
        return 2.0 * math.pi * (_PREFIXES[plain[0]] if plain[1:].lower() == "hz" else 1.0)
    if re.fullmatch(r"cpm|cyc(les?)?/min", plain, re.IGNORECASE) and not angular:  # of rubber process analysers
        return 2.0 * math.pi / 60.0
    return None


#: Units that are told apart by their kind; `to_rad_per_second` knows those of frequencies.
_KINDS = ("K", "Pa", "N", "m/s", "m", "s", "1/Pa")


def same_unit(one: str, other: str) -> bool:
    """Return whether two units as printed are the same, however spelt: ``°C`` and ``degC``, ``N/mm²`` and ``MPa``."""
    if one == other:
        return True
    angular = to_rad_per_second(one, angular=False)
    if angular is not None:
        return angular == to_rad_per_second(other, angular=False)
    for kind in _KINDS:
        try:
            factors, offsets = zip(unit_conversion(one, kind), unit_conversion(other, kind), strict=True)
        except InputError:
            continue
        return math.isclose(*factors, rel_tol=1e-9) and math.isclose(*offsets, abs_tol=1e-6)
    return False


#: What to do with a folder, where files make one set.
_ITS_FILES = Remedy("*sorted(Path(folder).glob('*')).", "FOLDER/*.csv.", '["a.csv", "b.csv"].')


def files_of(paths: Sequence[str | PathLike[str] | Sequence[str | PathLike[str]]], reader: str) -> list[str]:
    """Return the names of files given one by one or as lists."""
    files: list[str] = []
    for path in paths:
        # names of columns are what iterates over a table in memory
        if isinstance(path, Iterable) and not isinstance(path, (str, Mapping)) and getattr(path, "ndim", 1) == 1:
            names: list[object] = list(path)
        else:
            names = [path]
        wrong = [one for one in names if not isinstance(one, (str, PathLike))]
        if wrong:
            raise InputError(
                f"{reader} needs the name of a file or a list of names, got {type(wrong[0]).__name__}; write data in "
                "memory to a file (CSV).",
                code="not-a-name",
            )
        files += map(str, names)
    if not files:
        raise InputError(f"{reader} needs at least one file.", code="no-files")
    return files


def temperatures_of(given: Quantity | Sequence[Quantity | None] | None, count: int) -> list[float | None]:
    """Return one temperature, K, or None per file, of one for all or one for each."""
    several = isinstance(given, (list, tuple, np.ndarray)) and getattr(given, "ndim", 1) > 0
    values = list(cast("Sequence[Quantity | None]", given)) if several else [cast("Quantity | None", given)]
    if len(values) not in (1, count):
        raise InputError(
            f"temperature holds {len(values)} values for {count} files; give one for all, or one for each.",
            code="wrong-count",
        )
    return [None if one is None else _kelvin(one) for one in values] * (count // len(values))


def _kelvin(value: Quantity) -> float:
    kelvin = positive(value, "K", "temperature")
    if isinstance(value, (int, float)) and kelvin < COLDEST_PLAUSIBLE:
        problem = f"is {shown_celsius(kelvin, 'z.4g')} °C{kelvin_hint(kelvin).python}"
        raise wrong_argument("temperature", value, problem, "looks-like-celsius")
    return kelvin


def bytes_of(path: str) -> bytes:
    """Return the content of a file, or raise `DataFileError`."""
    if "\0" not in path and Path(path).is_dir():
        raise DataFileError(
            path, "is a folder, not a data file; give its files, e.g. ", code="folder", remedy=_ITS_FILES
        )
    return read_bytes(path)


def sources_of(
    paths: Sequence[str | PathLike[str] | Sequence[str | PathLike[str]]],
    reader: str,
    vocabulary: Vocabulary,
    temperature: Quantity | Sequence[Quantity | None] | None,
    unit: str | None,
    columns: Mapping[str, str] | None,
    sheet: str | None,
    test: Test = "frequency",
) -> list[Source]:
    """Return the content of files given one by one or as lists, with what the user says of them; no file twice."""
    files = files_of(paths, reader)
    given = temperatures_of(temperature, len(files))
    named, one_sheet = vocabulary.checked(columns), checked_sheet(sheet)
    sources = [
        Source(path, bytes_of(path), kelvin, unit or "", named, one_sheet, test)
        for path, kelvin in zip(files, given, strict=True)
    ]
    _insist_on_different(sources)
    return sources


def _insist_on_different(sources: Sequence[Source]) -> None:
    """Refuse files that would count twice."""
    seen: dict[object, Source] = {}
    for source in sources:
        for key, problem in (
            (Path(source.path).resolve(), "is given twice; name each file once."),
            (source.data, "has the same content as {}; give only one of them."),
        ):
            if key in seen:
                raise DataFileError(source.path, problem.format(seen[key].path), code="given-twice")
            seen[key] = source
