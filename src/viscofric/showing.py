"""How objects behave in a session and in a notebook: their numbers as text, table or figure, and their items."""

from __future__ import annotations

import importlib
import math
from collections.abc import Iterable, Mapping, Sized
from dataclasses import Field, fields, is_dataclass
from html import escape
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar, cast, overload

import numpy as np

from viscofric.units import celsius, shown_number

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import pandas
    from matplotlib.axes import Axes

Item = TypeVar("Item")

#: Label and value, and where they are known the unit and the standard error or error estimate.  Values are SI; the unit
#: "°C" is that of temperatures, given in kelvin as everywhere, and "%" that of shares.
Row: TypeAlias = tuple[str, Any] | tuple[str, Any, str] | tuple[str, Any, str, float | None]
Rows: TypeAlias = Iterable[Row]

ABSENT = "–"
_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
#: Units that take a prefix; seconds do below one only.
_PREFIXED = {"m", "m²", "m/s", "N", "N/m", "Pa", "J", "J/m", "W", "Hz", "s"}
#: Units of data sets, as people write them.
_WRITTEN = {"1": "", "m2": "m²", "m**2": "m²", "W/m**2": "W/m²"}
#: A relative error below it is rounding.
_ROUND_OFF = 1e-12
_SPACE = "\N{NO-BREAK SPACE}"
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_LONGEST_VALUE = 80
_LONGEST_LINE = 100


class Shown:
    """An object that shows what it is, its size and its main numbers in a few lines, or in a table of a notebook.

    Subclasses list their numbers in `_shown`; dataclasses without it show their fields.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in cls.__dict__:  # dataclasses add their own to classes that have none
            cls.__repr__ = Shown.__repr__  # type: ignore[method-assign]

    def __post_init__(self) -> None:
        """Keep read-only views of arrays, so that results stay what was computed."""
        own: Any = self
        for name in [one.name for one in fields(own)] if is_dataclass(own) else []:
            value: object = getattr(self, name)
            if isinstance(value, np.ndarray) and value.flags.writeable:
                kept = value.view()
                kept.flags.writeable = False
                object.__setattr__(self, name, kept)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Keep arrays of a copy, or from another process, as those of the original."""
        if is_dataclass(self):
            vars(self).update(state)
            Shown.__post_init__(self)
        else:  # models of pydantic have states of their own
            cast("Any", super()).__setstate__(state)

    def _shown(self) -> Rows:
        """Return the rows to show; those whose value is None are left out."""
        if not is_dataclass(self):
            return ()
        return [(one.name.replace("_", " "), getattr(self, one.name)) for one in fields(self) if one.repr]

    def __repr__(self) -> str:
        return shown_as_text(type(self).__name__, self._shown())

    def __eq__(self, other: object) -> bool:
        """Whether all public fields are the same, arrays with all their numbers; some dataclasses have their own."""
        if not is_dataclass(self):  # models of pydantic compare their fields themselves
            return super().__eq__(other)
        return (self is other or _same_fields(self, other)) if type(self) is type(other) else NotImplemented

    def __hash__(self) -> int:
        if not is_dataclass(self):
            return super().__hash__()
        return hash((type(self), *(_hashed(getattr(self, one.name)) for one in _compared(self))))

    def _repr_html_(self) -> str:
        return shown_as_html(type(self).__name__, self._shown())


class Plotted(Shown):
    """A result that also draws itself."""

    def plot(self, axes: Axes | None = None, **options: Any) -> Axes:
        """Draw the result with its function in `viscofric.report`.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.
        **options
            Further arguments of the function, such as `law` of `viscofric.report.plot_shift_factors`.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        InputError
            If the result has nothing to draw.
        """
        drawing = importlib.import_module("viscofric.report.plotting")
        found: Axes = drawing.plot(self, axes, **options)
        return found

    def to_dataframe(self, *arguments: Any) -> pandas.DataFrame:
        """Return the labelled data set as a table of pandas, its coordinates as index or columns.

        Parameters
        ----------
        *arguments
            Those of `to_dataset`, such as the temperatures of a shift law.

        Returns
        -------
        pandas.DataFrame
            In SI units; those of each column are known to the data set alone.
        """
        found: pandas.DataFrame = cast("Any", self).to_dataset(*arguments).to_dataframe()
        return found


class Items(Generic[Item]):
    """A collection with a length, iteration and indices, those of `_items`."""

    def _items(self) -> Sequence[Item]:
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self._items())

    def __iter__(self) -> Iterator[Item]:
        return iter(self._items())

    @overload
    def __getitem__(self, place: int) -> Item: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Item]: ...
    def __getitem__(self, place: int | slice) -> Item | Sequence[Item]:
        return self._items()[place]


def same(one: Any, other: Any) -> bool:
    """Return whether two values are the same: arrays with all their numbers, NaN where the other has one."""
    if one is other:
        return True
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        first, second = np.asarray(one), np.asarray(other)
        return np.array_equal(first, second, equal_nan=first.dtype.kind in "fc" and second.dtype.kind in "fc")
    if type(one) is not type(other):
        return bool(one == other)
    if isinstance(one, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    if isinstance(one, (tuple, list)):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, Mapping):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if hasattr(one, "identical"):  # of xarray
        return bool(one.identical(other))
    if is_dataclass(one) and type(one).__eq__ is object.__eq__:
        return _same_fields(one, other)
    return bool(one == other)


def _same_fields(one: Any, other: Any) -> bool:
    return all(same(getattr(one, each.name), getattr(other, each.name)) for each in _compared(one))


def _compared(one: Any) -> list[Field[Any]]:
    return [each for each in fields(one) if each.compare and not each.name.startswith("_")]


def _hashed(value: Any) -> Any:
    """Return what the hash of an object takes of a field: equal for all that `same` calls the same."""
    if isinstance(value, np.ndarray):
        value = float(value.sum()) if value.dtype.kind in "fiu" else value.shape
    if isinstance(value, float):
        return 0.0 if math.isnan(value) else value
    if isinstance(value, (str, int)) or getattr(type(value), "__hash__", None) is Shown.__hash__:
        return value
    return None


def rows_of(*columns: np.ndarray[Any, np.dtype[Any]]) -> list[Any]:
    """Return the rows of columns, as tuples of numbers."""
    return list(zip(*(column.tolist() for column in columns), strict=True))


def shown_as_text(name: str, rows: Rows) -> str:
    """Return an object as text: on one line where it fits, and else one line for each row."""
    shown = texts(rows)
    line = f"{name}({'; '.join(f'{label}: {text}' for label, text in shown)})"
    if len(line) <= _LONGEST_LINE:
        return line
    width = max(len(label) for label, _ in shown)
    return "\n".join([name, *(f"  {label:{width}}  {text}" for label, text in shown)])


def aligned(rows: Iterable[Iterable[str]]) -> list[str]:
    """Return rows as lines of text whose columns stand flush right."""
    cells = [list(row) for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells]


def shown_as_html(name: str, rows: Rows) -> str:
    """Return an object as a table of HTML, which is well-formed XML."""
    lines = (f"<tr><th>{escape(label)}</th><td>{escape(text)}</td></tr>" for label, text in texts(rows))
    return f"<table><caption>{escape(name)}</caption><tbody>{''.join(lines)}</tbody></table>"


def texts(rows: Rows) -> list[tuple[str, str]]:
    """Return rows as pairs of label and text, without those whose value is None."""
    return [(row[0], shown_value(*row[1:]).replace(_SPACE, " ")) for row in rows if row[1] is not None]


def shown_value(value: Any, unit: str = "", error: float | None = None) -> str:
    """Return a value as a short text.

    Numbers have their unit, arrays are shown as size and range, other collections as their length; a tuple of numbers
    is a range.
    """
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, np.ndarray) and value.ndim > 0:
        return _array(value, unit)
    if isinstance(value, (int, float, np.number, np.ndarray)):
        return _amount(float(value), unit, error)
    if isinstance(value, (tuple, list)) and value and all(isinstance(one, (int, float)) for one in value):
        return " to ".join(_amount(float(one), unit) for one in value)
    if isinstance(value, Sized) and not isinstance(value, (str, Mapping, Shown)):
        return str(len(value)) if len(value) else "none"
    if isinstance(value, Shown) and type(value).__str__ is object.__str__:
        text = ", ".join(" ".join(row) for row in texts(value._shown()))
    else:
        text = " ".join(str(value).split())
    if len(text) <= _LONGEST_VALUE:
        return text
    words = text[:_LONGEST_VALUE].rpartition(" ")[0].rstrip(",=")  # a number that is cut would be another one
    return f"{words} …" if words else f"{text[: _LONGEST_VALUE - 1]}…"


def _array(values: np.ndarray[Any, np.dtype[Any]], unit: str) -> str:
    """Return the size of an array and the range of its numbers."""
    size = " × ".join(map(str, values.shape))
    if values.dtype.kind not in "fiu":
        return size
    known = values[np.isfinite(values)].astype(float)
    missing = values.size - known.size
    unknown = [f"{missing} unknown" if known.size else "unknown"] if missing else []
    if not known.size:
        return ", ".join([size, *unknown]) if size != "1" else "unknown"
    low, high = _amount(float(known.min()), unit), _amount(float(known.max()), unit)
    if low == high:
        return ", ".join([low if size == "1" else f"{size} of {low}", *unknown])
    number, _, ending = low.partition(" ")
    low = number if high.endswith(f" {ending}") else low
    return ", ".join([f"{size} from {low} to {high}", *unknown])


def _amount(value: float, unit: str, error: float | None = None) -> str:
    """Return a number with its unit and its error; an infinite one is no number of any unit."""
    unit = _WRITTEN.get(unit, unit)
    if not math.isfinite(value):
        return "unknown" if math.isnan(value) else ("∞" if value > 0.0 else "−∞")
    if unit == "%":
        value, error = 100.0 * value, None if error is None else 100.0 * error
    if unit == "°C":
        value = celsius(value)
        if error is None or not math.isfinite(error):
            return f"{shown_number(value, 'z.1f').removesuffix('.0')} °C"
    if unit in _PREFIXED and not (unit == "s" and abs(value) >= 1.0):
        power = 2 if unit.endswith("²") else 1
        return prefixed(value, error, unit.removesuffix("²"), power)
    text = with_error(value, error)
    return f"{text} {unit}" if unit else text


def significant(value: float, digits: int = 3) -> str:
    """Return a number with so many significant digits; very large and very small ones as 1.23 × 10⁻⁵."""
    if not math.isfinite(value):
        return ABSENT
    if value == 0.0:
        return "0"
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    exponent = int(power)
    if -4 <= exponent < 6:
        return shown_number(float(f"{value:.{digits - 1}e}"), f".{max(0, digits - 1 - exponent)}f")
    mantissa = shown_number(float(mantissa), f".{digits - 1}f")
    return f"{mantissa}{_SPACE}×{_SPACE}10{str(exponent).translate(_RAISED)}"


def short(value: float, digits: int = 4) -> str:
    """Return a number for running text: at most so many digits, no zeros at the end."""
    text = significant(value, digits)
    return text.rstrip("0").rstrip(".") if "." in text and "×" not in text else text


def with_error(value: float, error: float | None) -> str:
    """Return a value to the digits that its error leaves: 10.04 ± 0.05; to four at most if that is not known."""
    if error is None or not _ROUND_OFF * abs(value) < error < math.inf:
        return short(value)
    if not math.isfinite(value):
        return ABSENT
    decimals = max(0, 1 - math.floor(math.log10(error)))
    if decimals > 9:
        return f"{significant(value, 6)} ± {significant(error, 2)}"
    return f"{shown_number(value, f'z.{decimals}f')} ± {error:.{decimals}f}"


def several(texts: Sequence[str], most: int = 1000) -> str:
    """Join texts in words: a, b and c; of more than so many the first: a, b and 3 more."""
    more = len(texts) - most
    first, last = (texts[:most], f"{more} more") if more > 0 else (texts[:-1], "".join(texts[-1:]))
    return f"{', '.join(first)} and {last}" if first else last


def prefixed(value: float, error: float | None, unit: str, power: int = 1) -> str:
    """Return a number with its error and its unit, in the prefix that suits its size."""
    size = abs(value)
    # An area is written with decimals rather than in hundred thousands of a smaller unit.
    least = 1.0 if power == 1 else 0.1
    fits = ((factor, prefix) for factor, prefix in _PREFIXES if size >= least * factor**power)
    factor, prefix = next(fits, (1.0, "") if size == 0.0 else _PREFIXES[-1])
    scale = factor**power
    raised = {1: "", 2: "²"}[power]
    error = None if error is None else error / scale
    return f"{with_error(value / scale, error)} {prefix}{unit}{raised}"
