"""Frequency sweeps of a dynamic mechanical analyser from any known format, recognised by content."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike
from typing import Protocol

import numpy as np

from viscofric.data import DEFORMATIONS, Deformation, IsothermalSweeps
from viscofric.errors import DataFileError, check_choice, not_needed, wrong_argument
from viscofric.readers.dma.instruments import (
    eplexor,
    mettler,
    rheocompass,
    trios_json,
    trios_text,
    universal_analysis,
)
from viscofric.readers.dma.isotherms import TracedSweeps, traced_sweeps
from viscofric.readers.dma.names import DMA, NOT_SAID
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables import dma_table, reptate, workbook
from viscofric.readers.mtm.delimited import AS_RUNS, TRACTION
from viscofric.readers.source import Source, Test, insist_on_content, sources_of, unit_conversion
from viscofric.readers.tables import holds_table, no_header
from viscofric.showing import several
from viscofric.units import Quantities, Quantity


class Format(Protocol):
    """The module of one format; `NAME` is the format in words, such as ``"TA Instruments TRIOS text"``."""

    @property
    def NAME(self) -> str:
        """The format in words."""

    def recognises(self, source: Source) -> bool:
        """Return whether the file has this format, by its content; quick, and never raises."""

    def read(self, source: Source) -> Readings:
        """Return the points of the file, or raise `DataFileError`."""


#: In this order: workbooks and delimited tables come last, since exports of instruments may have these forms.
FORMATS: tuple[Format, ...] = (
    universal_analysis,
    trios_json,
    trios_text,
    rheocompass,
    mettler,
    eplexor,
    reptate,
    workbook,
    dma_table,
)


def format_of(source: Source) -> Format:
    """Return the format of a file, or raise `DataFileError` if the file is empty or no format recognises it."""
    insist_on_content(source)
    if source.columns or source.sheet:  # the user knows the columns of a table better than any format
        return workbook if workbook.recognises(source) else dma_table
    for one in FORMATS:
        if one.recognises(source):
            return one
    if source.text is None:
        problem = f"is a binary file of an unknown format. Supported formats: {known()}."
        raise DataFileError(source.path, problem, code="unknown-format")
    _refuse_traction(source)
    refusal = no_header(source, DMA)
    if not refusal.note.values["headings"]:
        problem = f"has no columns named as a modulus and a frequency. Supported formats: {known()}."
        raise DataFileError(source.path, problem, code="unknown-format")
    raise refusal


def _refuse_traction(source: Source) -> None:
    """Raise `DataFileError` if a text is a table of traction runs."""
    if holds_table(source, TRACTION):
        problem = "this is a table of traction runs, not of DMA sweeps"
        raise DataFileError(source.path, problem, code="traction-runs", remedy=replace(AS_RUNS, field="material.dma"))


def known() -> str:
    """Return the names of all formats in one readable list."""
    return several([one.NAME for one in FORMATS])


def read_dma(
    *paths: str | PathLike[str] | Sequence[str | PathLike[str]],
    deformation: Deformation | None = None,
    temperature: Quantity | Sequence[Quantity | None] | None = None,
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
    leave_out_temperatures: Quantities | None = None,
) -> IsothermalSweeps:
    """Read frequency sweeps at several temperatures from files of a dynamic mechanical analyser or a rheometer.

    The format is recognised by the content, never by the name: exports of instruments, Excel workbooks, and text tables
    with a header that names temperature, frequency (``f (Hz)``) or angular frequency (``omega (rad/s)``), storage
    and loss modulus, each with its unit in the same row or the row below; rows in any order.

    Parameters
    ----------
    *paths : str or path, or a list of them
        One or many files of one specimen; units may differ between them, the kind of deformation may not.
    deformation : {"tension", "compression", "bending", "shear"}, optional
        Kind of the test, if the files do not state it by headings (E' or G'), by the sample holder or by a torque.  In
        compression and bending (three points, cantilevers) the moduli are Young's moduli as the instrument reports
        them; a note says what is assumed.
    temperature : float, str or quantity, or a list with one (or None) per file, optional
        For files without temperatures, K if a plain number.  The default is the temperature in the file's name
        (``foam_-25C.csv``), with a note.
    modulus_unit : str, optional
        For files without the unit of their moduli, such as ``"MPa"``.
    columns : mapping, optional
        Headings of columns whose names are not understood, by quantity: ``{"frequency": "f in Hz"}``.  A heading is
        written as in the file, without regard to case, or as the number of a column (``"#2"``); a unit that the file
        does not state follows in brackets (``"#2 (Hz)"``) and counts instead of that of the file; ``"= 25 degC"`` is
        a value of all rows.  Quantities are
        temperature, frequency, storage_modulus, loss_modulus, complex_modulus, tan_delta, strain_amplitude and step;
        columns not named here are recognised as without it.
    sheet : str, optional
        Name of the only sheet of a workbook to read.
    leave_out_temperatures : float, str or quantity, or a list of them, optional
        Temperatures of isotherms to leave out, to 1 K; K if plain numbers.  A note says which.

    Returns
    -------
    IsothermalSweeps
        In SI units; `format` is the recognised format.  The notes name every point left out (a value missing or not
        above zero, recorded while the temperature was changing), averaged or reordered, and everything doubtful.

    Raises
    ------
    DataFileError
        If a file cannot be read or is not recognised, a column or unit is missing or wrong, a cell is no number,
        most storage moduli or frequencies are not above zero, files contradict each other or are given twice, tension
        or shear is not stated, or the temperatures form a ramp, not isotherms.
    InputError
        If no file is given, an argument is wrong, or no isotherm is at a temperature to be left out, or none is left.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic
    >>> sweeps = vf.read_dma(path, deformation="tension")
    >>> len(sweeps.isotherms), sweeps.isotherms[0].storage_modulus.shape
    (24, (17,))
    """
    readings = read_files(paths, "read_dma", "frequency", deformation, temperature, modulus_unit, columns, sheet)
    traced = traced_sweeps(readings, deformation, leave_out_temperatures)
    if not traced.deformation_known:
        raise DataFileError(traced.sweeps.source, NOT_SAID)
    return traced.sweeps


def trace_dma(
    *paths: str | PathLike[str] | Sequence[str | PathLike[str]],
    deformation: Deformation | None = None,
    temperature: Quantity | Sequence[Quantity | None] | None = None,
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
    leave_out_temperatures: Quantities | None = None,
) -> TracedSweeps:
    """Read the same as `read_dma`, and return the sweeps with every reading of the files."""
    # If nothing decides between tension and shear, this raises no error, so that the page can show the sweeps and ask.
    readings = read_files(paths, "read_dma", "frequency", deformation, temperature, modulus_unit, columns, sheet)
    return traced_sweeps(readings, deformation, leave_out_temperatures)


def read_files(
    paths: Sequence[str | PathLike[str] | Sequence[str | PathLike[str]]],
    reader: str,
    test: Test,
    deformation: Deformation | None,
    temperature: Quantity | Sequence[Quantity | None] | None,
    modulus_unit: str | None,
    columns: Mapping[str, str] | None,
    sheet: str | None,
) -> list[Readings]:
    """Read the points of a test from files of one specimen, neither sorted nor checked yet."""
    if deformation is not None:
        check_choice(deformation, "deformation", *DEFORMATIONS)
    if modulus_unit is not None:
        unit_conversion(modulus_unit, "Pa", "modulus_unit")
    sources = sources_of(paths, reader, DMA, temperature, modulus_unit, columns, sheet, test)
    readings = [_read(source) for source in sources]
    if modulus_unit is not None and not any(one.lacks_unit for one in readings):
        raise wrong_argument(
            "modulus_unit", modulus_unit, "the files state the units of their moduli; leave it out.", "unit-not-needed"
        )
    return readings


def _read(source: Source) -> Readings:
    """Read one file, and refuse a temperature that it does not need."""
    readings = format_of(source).read(source)
    given = source.temperature
    if given is not None and not np.all(np.isclose(readings.temperature, given, rtol=0.0, atol=1e-9)):
        problem = f"contains temperatures ({readings.format})"
        raise not_needed(source.path, "temperature", "temperature-not-needed", problem)
    return readings
