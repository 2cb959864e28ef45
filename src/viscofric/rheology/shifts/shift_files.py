"""Shift factors in files: viscofric's own, tables of other programs, the shift list of an Eplexor workbook.

The sign is that of E(ω, T) = E(α(T) ω, T0): α falls as the temperature rises, log10 α is above zero below T0.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from os import PathLike
from typing import NamedTuple

import numpy as np

from viscofric.arguments import flag
from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError
from viscofric.files import on_synthetic, read_bytes
from viscofric.notes import Note, Remedy
from viscofric.readers.dma.instruments.eplexor import SHIFT_LIST, ShiftList, shift_list
from viscofric.readers.dma.names import TEMPERATURE
from viscofric.readers.headings import Vocabulary
from viscofric.readers.one_table import insist_on_columns, only_table
from viscofric.readers.source import Source, checked_sheet, unit_conversion
from viscofric.readers.table import Table, name_columns
from viscofric.readers.workbook import is_workbook, sheets
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.units import Quantity, positive, shown_celsius

_NAMES = frozenset({"at", "α", "αt", "alpha", "alphat", "shift factor", "horizontal shift factor"})
_IN_LOGARITHMS = _NAMES | {"a", "shift", "horizontal shift"}
#: Quantity -> log10 α for one of its units; None for α itself.
_SCALES: dict[str, float | None] = {
    "log10 shift factor": 1.0,
    "ln shift factor": 1.0 / math.log(10.0),
    "shift factor": None,
}
#: Unit of standard errors that is not that of the column of factors -> log10 α for one of it.
_UNITS_OF_ERRORS = {
    **dict.fromkeys(("decades", "decade", "log10", "log", "lg"), 1.0),
    "ln": 1.0 / math.log(10.0),
    "%": 0.01 / math.log(10.0),  # of α
}
#: The words of tables of shift factors.
SHIFT_FACTORS = Vocabulary(
    "a table of shift factors",
    {
        "temperature": TEMPERATURE,
        "log10 shift factor": frozenset(f"{log} {name}" for log in ("log10", "log", "lg") for name in _IN_LOGARITHMS),
        "ln shift factor": frozenset(f"ln {name}" for name in _IN_LOGARITHMS),
        "shift factor": _NAMES,
        "standard error": frozenset({"standard error", "std error", "uncertainty"}),
    },
    needed=(("temperature",), ("log10 shift factor", "ln shift factor", "shift factor")),
    example="a table of shift factors has 'temperature (degC)' or 'T_C', and 'log10 aT' or 'aT'",
    key="material.shift_factor_columns",
    offered=(("temperature", "degC"), ("log10 shift factor", ""), ("shift factor", ""), ("standard error", "")),
)
#: Beyond this, α or 1/α over- or underflows.
_LARGEST_LOGARITHM = 300.0
#: Comments of a saved file.
_REFERENCE = re.compile(r"\s*#(?:.*\W)?reference\s*\((?P<unit>[^()]*)\)\s*:\s*(?P<number>[-+0-9.eE]+)\s*")
_NOTE = re.compile(r"\s*#\s*note:\s*(?P<text>.*?)\s*")
_COVARIANCE = re.compile(r"cov\s*(\d+)")


class _Factors(NamedTuple):
    """Content of a file of shift factors, in the order of its rows: K, decades, and what it states of them."""

    temperatures: Array  # (n,)
    log10_values: Array  # (n,), of α, or of 1/α where the file holds that
    reference: float | None = None
    covariance: Array | None = None  # (n, n)
    notes: tuple[str, ...] = ()


def read_shift_factors(
    path: str | PathLike[str],
    reference: Quantity | None = None,
    *,
    inverse: bool = False,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> ShiftFactors:
    """Read a table of shift factors.

    Parameters
    ----------
    path : str or path
        What `ShiftFactors.save` wrote; or a text table with a column of temperatures and one of ``log10 aT``,
        ``ln aT`` or ``aT``, units in the headings (``T_C``, ``T [K]``) or in a row of their own; or a workbook with
        such a table, or a Netzsch Eplexor one with a shift list.  Rows stand in any order.
    reference : float or quantity, optional
        Temperature where α shall be 1.  If not given, it is the one that a saved file states; else the temperature
        of the row whose log10 α is zero, or where the table, interpolated as `ShiftFactors` does, passes zero.
    inverse : bool
        The table holds 1/α, or its logarithm, and rises with temperature.
    columns : mapping, optional
        Headings that are not understood, by quantity: ``{"temperature": "Temp. / °C", "log10_shift_factor": "lg"}``;
        ``shift_factor``, ``ln_shift_factor`` and ``standard_error`` (of the column of factors) are the others.
    sheet : str, optional
        The only sheet of a workbook to read.

    Returns
    -------
    ShiftFactors
        With the covariance, or the standard errors, that the file gives; without either the factors are taken as
        exact.

    Raises
    ------
    DataFileError
        If the file cannot be read, holds no such table, or the table rises with temperature (without `inverse`) or
        passes zero nowhere and no reference is given.
    InputError
        If `reference` is not a temperature, or lies outside the table.

    Examples
    --------
    >>> import viscofric as vf
    >>> vf.ShiftFactors(["30 degC", "60 degC"], [0.0, -1.5], "30 degC").save("alpha.csv")
    >>> vf.read_shift_factors("alpha.csv").log10_values.round(3) + 0.0
    array([ 0. , -1.5])
    """
    given = SHIFT_FACTORS.checked(columns)
    source = Source(str(path), read_bytes(path), columns=given, sheet=checked_sheet(sheet))
    found = _from_workbook(source) if is_workbook(source) and not (given or source.sheet) else _from_table(source)
    order = np.argsort(found.temperatures)
    kelvin, values = found.temperatures[order], found.log10_values[order]
    spread = None if found.covariance is None else found.covariance[np.ix_(order, order)]
    if kelvin.size < 2 or np.any(np.diff(kelvin) <= 0.0) or kelvin[0] <= 0.0:
        problem = "shift factors need at least two temperatures, none twice, all above absolute zero."
        raise DataFileError(source.path, problem, code="wrong-length")
    values = _falling(source.path, kelvin, values, flag(inverse, "inverse"))
    notes = (*on_synthetic([source.path]), *found.notes)
    if spread is None:
        notes += (
            Note(
                "factors-exact",
                "No column of the file of shift factors is a standard error; the factors are taken as exact.",
            ),
        )
    stated = found.reference
    wanted = None if reference is None else positive(reference, "K", "reference")
    if stated is None:
        stated = _zero(source.path, kelvin, values, wanted)
        if wanted is None and stated not in kelvin:
            notes += (
                Note(
                    "reference-interpolated",
                    f"α is taken as 1 at {shown_celsius(stated, 'z.2f')} °C, where the table of shift factors passes "
                    "zero.",
                ),
            )
    try:
        factors = ShiftFactors(kelvin, values, stated, spread, notes)
    except InputError as error:
        raise DataFileError(
            source.path, f"the reference does not fit the table: {error}", code="no-reference"
        ) from None
    return factors if wanted is None else factors.at_reference(wanted)


def read_vendor_law(path: str | PathLike[str]) -> WLF:
    """Return the WLF law that the Eplexor software fitted to the shift list of a workbook.

    Parameters
    ----------
    path : str or path
        A Netzsch Eplexor workbook that holds a master curve.

    Returns
    -------
    WLF
        About the reference temperature that the list states.

    Raises
    ------
    DataFileError
        If the file is no such workbook, or its list states no constants or no reference.
    """
    source = Source(str(path), read_bytes(path))
    found = _eplexor_list(source) if is_workbook(source) else None
    if found is None or found.wlf is None or found.reference is None:
        problem = f"is no Eplexor workbook whose sheet {SHIFT_LIST!r} states a reference temperature, C1 and C2."
        raise DataFileError(source.path, problem, code="no-shift-list")
    try:
        return WLF(*found.wlf, found.reference)
    except InputError as error:
        raise DataFileError(
            source.path, f"the constants in sheet {SHIFT_LIST!r} are no WLF law: {error}", code="no-law"
        ) from None


def _eplexor_list(source: Source) -> ShiftList | None:
    return shift_list(sheets(source), source.path)


def _from_workbook(source: Source) -> _Factors:
    found = _eplexor_list(source)
    if found is None:
        try:
            return _from_table(source)
        except DataFileError as error:
            if error.code != "missing-columns":
                raise
            problem = f"is a workbook without a sheet {SHIFT_LIST!r}, and no sheet has a table of shift factors"
            remedy = name_columns(SHIFT_FACTORS.key, ("temperature",))
            note = Note("no-shift-list", problem, remedy=remedy, values=error.note.values)
            raise DataFileError(source.path, note) from None
    # The stated reference is the programmed temperature; α is 1 at the measured one.
    measured = found.measured_reference
    return _Factors(found.temperatures, found.log10_shifts, found.reference if measured is None else measured)


def _from_table(source: Source) -> _Factors:
    table = only_table(source, SHIFT_FACTORS)
    insist_on_columns(table, SHIFT_FACTORS)
    at = table.place("temperature")
    name, of = next((name, place) for name in _SCALES if (place := table.place(name)) is not None)
    assert at is not None  # nothing needed is missing
    log10 = _logarithms(table, table.numbers(of), _SCALES[name])
    reference, notes = _stated(source)
    error = table.place("standard error")
    used = (at, of, error)
    unused = [one.heading for one in table.unused(used) if not _COVARIANCE.match(one.name)]
    if unused:
        said = f"Columns of the file of shift factors that are not read: {', '.join(map(repr, unused))}."
        notes += (Note("unused-columns", said, values={"headings": unused}),)
    own = None if error is None else _UNITS_OF_ERRORS.get(table.columns[error].unit)
    scale = own or _SCALES[name]
    slope = np.full(len(log10), scale) if scale else 1.0 / (table.numbers(of) * math.log(10.0))
    covariance = _covariance(table, slope)
    if error is not None and own is None and scale != 1.0:
        said = f"The standard errors of the file were read as those of its column {table.columns[of].heading!r}."
        notes += (Note("errors-of-column", said, values={"heading": table.columns[of].heading}),)
    return _Factors(table.values(at, "K"), log10, reference, covariance, notes)


def _logarithms(table: Table, values: Array, scale: float | None) -> Array:
    """Return log10 α (n,) of a column: `scale` for one of its units, None where it holds α itself."""
    bad = np.flatnonzero(values <= 0.0 if scale is None else np.abs(values) > _LARGEST_LOGARITHM)
    if bad.size:
        problem, code = "a logarithm of a shift factor beyond 300 is none of a material.", "out-of-range"
        if scale is None:
            problem = "a shift factor aT must be above zero; name the column 'log10 aT' if it holds logarithms."
            code = "not-positive"
        raise DataFileError(table.path, problem, int(table.lines[bad[0]]), code=code)
    return np.log10(values) if scale is None else np.asarray(scale * values)


def _covariance(table: Table, slope: Array) -> Array | None:
    """Return the covariance that a table states, in full or by standard errors, or None."""
    # `slope` (n,) is that of log10 α with the column of factors, whose standard errors are stated.
    places = {int(match[1]): place for place, one in enumerate(table.columns) if (match := _COVARIANCE.match(one.name))}
    size = len(table.rows)
    if places:
        if set(places) != set(range(1, size + 1)):
            problem = f"the covariance must have the columns cov 1 to cov {size}, one for each row."
            raise DataFileError(table.path, problem, code="missing-columns")
        return np.column_stack([table.numbers(places[number]) for number in range(1, size + 1)])
    error = table.place("standard error")
    return None if error is None else np.diag((slope * table.numbers(error)) ** 2)


def _stated(source: Source) -> tuple[float | None, tuple[str, ...]]:
    """Return reference (K) and notes of a saved file's comments; those of other programs are ignored."""
    reference, notes = None, []
    for number, line in enumerate((source.text or "").splitlines(), start=1):
        if note := _NOTE.fullmatch(line):
            notes.append(note["text"])
        elif stated := _REFERENCE.fullmatch(line):
            try:
                factor, offset = unit_conversion(stated["unit"], "K", "reference")
                reference = factor * float(stated["number"]) + offset
            except ValueError:
                problem = "the comment states a reference that is no temperature; write it as '# reference (degC): 20'."
                raise DataFileError(source.path, problem, number, code="no-reference") from None
    return reference, tuple(notes)


def _falling(path: str, kelvin: Array, values: Array, inverse: bool) -> Array:
    """Return log10 α with the sign that falls as the temperature rises, or raise an error."""
    values = -values if inverse else values
    if np.polyfit(kelvin - kelvin.mean(), values, 1)[0] > 0.0:
        if inverse:
            raise DataFileError(
                path,
                "the shift factors fall as the temperature rises already; leave out inverse=True.",
                code="factors-fall",
            )
        rise = "the shift factors rise with temperature, but α must fall, E(ω, T) = E(α(T) ω, T0); flip the sign of "
        remedy = Remedy("the logarithm, or give inverse=True.", "the logarithm in the file.")
        raise DataFileError(path, Note("factors-rise", rise, remedy=remedy))
    return values


def _zero(path: str, kelvin: Array, values: Array, wanted: float | None) -> float:
    """Return the temperature where the table is zero; without one, the requested reference."""
    exact = np.flatnonzero(values == 0.0)
    if exact.size == 1:
        return float(kelvin[exact[0]])
    signs = np.sign(values)
    between = np.flatnonzero(signs[:-1] * signs[1:] < 0.0)
    if exact.size == 0 and between.size == 1:
        return _crossing(kelvin, values, int(between[0]))
    if wanted is not None:
        return wanted
    span = f"{shown_celsius(kelvin[0])} and {shown_celsius(kelvin[-1])} °C"
    how_often = "not zero" if exact.size + between.size == 0 else "zero at more than one temperature"
    raise DataFileError(
        path,
        f"log10 aT is {how_often} between {span}; give the temperature where α is 1 (reference=).",
        code="no-reference",
    )


def _crossing(kelvin: Array, values: Array, place: int) -> float:
    from scipy.optimize import brentq

    # The table's own interpolation, so that its values do not change.
    about_first = ShiftFactors(kelvin, values, float(kelvin[0]))
    root = brentq(lambda T: about_first.log10(T) + values[0], kelvin[place], kelvin[place + 1], xtol=1e-12)
    return float(root)
