"""Finished master curves, from a text table, a workbook or RepTate."""

from __future__ import annotations

import re
from collections.abc import Mapping
from os import PathLike

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.data import DEFORMATIONS, Deformation, MasterCurve
from viscofric.errors import DataFileError, check_choice
from viscofric.files import on_synthetic, read_bytes
from viscofric.nominal import parted
from viscofric.readers.dma.names import DMA, decided, insist_on_one_specimen, temperatures_above
from viscofric.readers.dma.read import format_of
from viscofric.readers.dma.readings import AS_SWEEPS
from viscofric.readers.dma.tables import dma_table, reptate, workbook
from viscofric.readers.one_table import only_table
from viscofric.readers.source import Source, checked_sheet, converted, unit_conversion
from viscofric.readers.table import MILLIPASCAL, Table, on_doubtful_point
from viscofric.units import Quantity, checked_poisson_ratio, positive, shown_celsius

#: Reference temperatures are printed with few digits.
_SAME_REFERENCE = 0.01  # K
#: Relative difference of frequencies that are printed alike, K that span several isotherms, and relative difference of
#: moduli that exceeds the scatter of isotherms on one curve.
_SAME_FREQUENCY, _OTHER_TEMPERATURE, _OTHER_MODULUS = 1e-4, 1.0, 0.2
_REMARKS, _LONGEST_REMARK = 20, 200  # lines, characters
#: As `viscofric material fit` writes it above a master curve, and as others do.
_REFERENCE = re.compile(
    r"[\W_]*(master ?curve\W+)?((reference|ref\.?) ?temp(erature|\.)?|t[_ ]?ref|t_?0|referenztemperatur"
    r"|température de référence)(\W*\b(?P<before>degC|C|K|degF|F)\b)?"
    r"\W*?(?P<number>[+−–-]?\d+([.,]\d*)?)(\W*(?P<unit>degC|C|K|degF|F))?\W*",
    re.IGNORECASE,
)


def read_master_curve(
    path: str | PathLike[str],
    reference: Quantity,
    deformation: Deformation | None = None,
    poisson_ratio: float = 0.5,
    *,
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> MasterCurve:
    r"""Read a master curve: moduli over reduced frequency at one reference temperature.

    Parameters
    ----------
    path : str or path
        Text table or workbook with (reduced) frequency, storage and loss modulus and their units, as for `read_dma`,
        such as the ``master_curve.csv`` that ``viscofric material fit`` writes, or a .tts file of RepTate.
    reference : float, str or quantity
        Reference temperature of the curve, K if a plain number.
    deformation : {"tension", "compression", "bending", "shear"}, optional
        Kind of the moduli, if the file does not state it.
    poisson_ratio : float
        ν of E = 2(1+ν)G, for moduli in shear.
    modulus_unit : str, optional
        Of the moduli, where the headings have none.
    columns : mapping, optional
        Headings that are not understood, by quantity, as for `read_dma`: ``{"frequency": "w (rad/s)"}``.
    sheet : str, optional
        Name of the sheet of a workbook.

    Returns
    -------
    MasterCurve
        Tensile, in SI units, ascending in frequency.  Its `temperature`, that of the isotherm that each point comes
        from (a column "isotherm" or "temperature"), is `reference` for all points without such a column.

    Raises
    ------
    DataFileError
        If the file cannot be read or holds sweeps, columns contradict each other, a value is missing or not above zero,
        tension or shear is not stated, or the file states another reference temperature.
    InputError
        If an argument is wrong.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> _ = Path("curve.csv").write_text("frequency (Hz),E' (MPa),E'' (MPa)\n0.01,3.1,0.2\n1,3.6,0.5\n100,5.2,1.6\n")
    >>> curve = vf.read_master_curve("curve.csv", reference="30 degC", deformation="tension")
    >>> curve.storage_modulus
    array([3100000., 3600000., 5200000.])
    """
    kelvin = positive(reference, "K", "reference")
    if deformation is not None:
        check_choice(deformation, "deformation", *DEFORMATIONS)
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    if modulus_unit is not None:
        unit_conversion(modulus_unit, "Pa", "modulus_unit")
    source = Source(str(path), read_bytes(path), None, modulus_unit or "", DMA.checked(columns), checked_sheet(sheet))
    table, stated = _table(source)
    _insist_on_reference(source, stated, kelvin)
    notes: list[str] = [*on_synthetic([path])]
    frequency, storage, loss, temperature = _of_table(table, source, kelvin, notes)
    kind = decided(source.path, dma_table.deformation([table]), deformation)
    factor = 1.0 if kind != "shear" else 2.0 * (1.0 + ratio)
    order = np.argsort(frequency, kind="stable")
    return MasterCurve(
        frequency[order], factor * storage[order], factor * loss[order], temperature[order], kelvin, tuple(notes)
    )


def _table(source: Source) -> tuple[Table, float]:
    """Return the one table of a text file or a workbook, and the reference temperature that it states, K, else NaN."""
    if not source.columns and reptate.recognises(source):
        table, parameters = reptate.table_of(source)
        if not table.has("reduced frequency"):
            problem = "is a sweep at one temperature (RepTate .osc), no master curve"
            raise DataFileError(source.path, problem, code="dma-sweeps", remedy=AS_SWEEPS)
        return table, reptate.temperature_of(parameters)
    found = format_of(source)
    if found.NAME not in (dma_table.NAME, workbook.NAME):
        problem = f"is a file of an instrument ({found.NAME}), not a table of a master curve"
        raise DataFileError(source.path, problem, code="dma-sweeps", remedy=AS_SWEEPS)
    return only_table(source, DMA), _stated_reference(source)


def _of_table(table: Table, source: Source, reference: float, notes: list[str]) -> tuple[Array, Array, Array, Array]:
    titled = [kelvin for kelvin in temperatures_above(table) if kelvin is not None]
    if table.block is not None and any(abs(kelvin - reference) > _SAME_REFERENCE for kelvin in titled):
        problem = "holds tables with temperatures of their own, no master curve"
        raise DataFileError(table.path, problem, code="dma-sweeps", remedy=AS_SWEEPS)
    if table.block is not None and any(cell.strip() for title in table.titles[1:] for line in title for cell in line):
        problem = "holds several tables below each other; give each a file of its own."
        raise DataFileError(table.path, problem, code="several-tables")
    insist_on_one_specimen(table, np.zeros((len(table.rows), 1)), "reference temperature")
    table = dma_table.with_one_abscissa(table, "frequency", notes)
    places = dma_table.find_columns(table, master_curve=True)
    doubts: list[str] = []
    frequency = dma_table.angular_frequency(table, places, doubts)
    for column in (table.columns[place] for place in places.values()):
        if column.assumed_decadic:
            problem = f"column {column.heading!r} may be decadic or natural logarithms; write 'log10' or 'ln' there."
            raise table.refused("logarithm-unknown", problem)
        if MILLIPASCAL in column.unit:
            problem = f"column {column.heading!r} has the unit {column.unit!r}, millipascal; write MPa if it is meant."
            raise table.refused("wrong-unit", problem)
    if doubts:  # a master curve carries no notes
        heading = table.columns[places["frequency"]].heading
        raise table.refused("no-unit", f"column {heading!r} has no unit; write it as {f'{heading} (rad/s)'!r}.")
    dma_table.insist_on_one_frequency(table, places, frequency)
    notes += [on_doubtful_point(table.pointed)] if table.pointed else []
    storage, loss = dma_table.moduli(table, places, source, [])
    temperature = np.full(len(frequency), reference)
    if "temperature" in places:
        temperature = table.values(places["temperature"], "K")
    named = {"frequency": frequency, "storage modulus": storage, "loss modulus": loss, "temperature": temperature}
    _insist_on_positive(table.path, table.lines, named)
    if _are_sweeps(frequency, storage, temperature):
        problem = "has other moduli at the same frequencies for each temperature: sweeps that are not shifted"
        raise DataFileError(table.path, problem, code="dma-sweeps", remedy=AS_SWEEPS)
    return frequency, storage, loss, temperature


def _are_sweeps(frequency: Array, storage: Array, temperature: Array) -> bool:
    """Return whether moduli at equal frequencies and different temperatures differ, as those of no master curve."""
    # Neighbouring isotherms of a glass, or of the rubber plateau, hardly differ; the coldest and the warmest one do.
    groups = parted(np.log(frequency), _SAME_FREQUENCY)
    several = [rows for rows in groups if np.ptp(temperature[rows]) > _OTHER_TEMPERATURE]
    if 3 * sum(map(len, several)) < 2 * len(frequency):
        return False
    return float(np.median([np.ptp(np.log(storage[rows])) for rows in several])) > _OTHER_MODULUS


def _stated_reference(source: Source) -> float:
    """Return the reference temperature that a remark of a text table states, K, NaN without one."""
    for line in (source.text or "").splitlines()[:_REMARKS]:
        found = _REFERENCE.fullmatch(line) if len(line) < _LONGEST_REMARK else None
        kelvin = found and converted(found["number"], found["unit"] or found["before"] or "", "K")
        if kelvin:
            return kelvin
    return float("nan")


def _insist_on_reference(source: Source, stated: float, reference: float) -> None:
    if np.isfinite(stated) and abs(stated - reference) > _SAME_REFERENCE:
        problem = f"states the reference temperature {shown_celsius(stated, 'z.4g')} °C, not "
        raise DataFileError(source.path, f"{problem}{shown_celsius(reference, 'z.4g')} °C.", code="other-reference")


def _insist_on_positive(path: str, lines: Integers, named: dict[str, Array]) -> None:
    for name, values in named.items():
        bad = np.flatnonzero(~(values > 0.0))
        if bad.size:
            problem = f"the {name} is missing or not above zero; correct or leave out the row."
            raise DataFileError(path, problem, int(lines[bad[0]]), code="not-positive")
