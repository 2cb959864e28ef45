"""Shift factors in files: viscofric's own, tables of other programs, the shift list of an Eplexor workbook.

The sign is that of E(ω, T) = E(α(T) ω, T0): α falls as the temperature rises, log10 α is above zero below T0.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike

import numpy as np

from viscofric.arguments import flag
from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError
from viscofric.files import read_bytes
from viscofric.notes import Note
from viscofric.readers.dma.instruments.eplexor_master import SHIFT_LIST, ShiftList, shift_list
from viscofric.readers.headings import heading
from viscofric.readers.one_table import SHIFT_FACTORS, shift_columns
from viscofric.readers.source import Source, checked_sheet
from viscofric.readers.tables import name_columns
from viscofric.readers.workbook import is_workbook, sheets
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_table import ShiftTable, logarithms, read_shift_table
from viscofric.units import Quantity, positive, shown_celsius


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
        ``shift_factor``, ``ln_shift_factor`` and ``standard_error`` (of log10 α) are the others.
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
    if given or source.sheet:
        found = _from_columns(source)
    else:
        found = _from_workbook(source) if is_workbook(source) else _from_text(source)
    order = np.argsort(found.temperatures)
    kelvin, values = found.temperatures[order], found.log10_values[order]
    spread = None if found.covariance is None else found.covariance[np.ix_(order, order)]
    if kelvin.size < 2 or np.any(np.diff(kelvin) <= 0.0) or kelvin[0] <= 0.0:
        problem = "shift factors need at least two temperatures, none twice, all above absolute zero."
        raise DataFileError(source.path, problem, code="wrong-length")
    values = _falling(source.path, kelvin, values, flag(inverse, "inverse"))
    notes = found.notes
    if spread is None:
        notes += (
            Note("factors-exact", "The file of shift factors gives no uncertainty; the factors are taken as exact."),
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


def _from_workbook(source: Source) -> ShiftTable:
    found = _eplexor_list(source)
    if found is None:
        try:
            return _from_columns(source)
        except DataFileError as error:
            if error.code != "missing-columns":
                raise
            problem = f"is a workbook without a sheet {SHIFT_LIST!r}, and no sheet has a table of shift factors"
            remedy = name_columns(SHIFT_FACTORS.key, ("temperature",))
            note = Note("no-shift-list", problem, remedy=remedy, values=error.note.values)
            raise DataFileError(source.path, note) from None
    # The stated reference is the programmed temperature; α is 1 at the measured one.
    measured = found.measured_reference
    return ShiftTable(found.temperatures, found.log10_shifts, found.reference if measured is None else measured)


def _from_text(source: Source) -> ShiftTable:
    if source.text is None:
        raise DataFileError(
            source.path, "is a binary file; a table of shift factors is text, or an Eplexor workbook.", code="binary"
        )
    try:
        return read_shift_table(source.text, source.path)
    except DataFileError as error:
        found = error.note
        if not found.values:
            raise
        missing = found.values["missing"]
        values = SHIFT_FACTORS.header_values([heading(one) for one in found.values["headings"]], missing)
        note = Note(found.code, found.text, "", name_columns(SHIFT_FACTORS.key, missing), values)
        raise DataFileError(source.path, note) from None


def _from_columns(source: Source) -> ShiftTable:
    found = shift_columns(source)
    log10 = logarithms(source.path, found.values, found.scale, found.lines)
    covariance = None if found.standard_error is None else np.diag(found.standard_error**2)
    return ShiftTable(found.temperatures, log10, None, covariance)


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
        raise DataFileError(
            path,
            "the shift factors rise with temperature, but α must fall, E(ω, T) = E(α(T) ω, T0); flip the sign of the "
            "logarithm, or give inverse=True.",
            code="factors-rise",
        )
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
