"""DMA frequency sweeps from a delimited text table: temperature, frequency, storage and loss modulus."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import numpy as np

from viscofric.data import Deformation, Isotherm, IsothermalSweeps
from viscofric.errors import DataFileError, InputError
from viscofric.readers.plausibility import doubts
from viscofric.readers.table import Column, Table, read_table
from viscofric.units import celsius

if TYPE_CHECKING:
    from os import PathLike

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

TEMPERATURE = frozenset({"T", "temp", "temp.", "temperature", "sample temperature"})
FREQUENCY = frozenset({"f", "freq", "freq.", "frequency"})
ANGULAR_FREQUENCY = frozenset({"ω", "w", "omega", "angular frequency", "ang. frequency", "angular freq."})
_SORTS = ("", "tensile ", "tension ", "young's ", "shear ")
STORAGE_MODULUS = frozenset({"E'", "G'", "e'", "g'", *(s + n for s in _SORTS for n in ("storage", "storage modulus"))})
LOSS_MODULUS = frozenset({"E''", "G''", "e''", "g''", *(s + n for s in _SORTS for n in ("loss", "loss modulus"))})

#: Measured temperatures of one isotherm scatter by some tenths of a kelvin, programmes step by several.
ISOTHERM_GAP = 1.0  # K
#: A group without gaps wider than this is not one temperature but a ramp.
WIDEST_ISOTHERM = 5.0  # K
#: Frequencies closer than this (relative) are the same one, printed or measured twice.
SAME_FREQUENCY = 1e-4
#: Hz and rad/s of one row, both printed with two digits or so, agree within this (relative).
PRINTED_FREQUENCY = 0.05

#: The note where neither the file nor the caller says what the moduli are; see `deformation_is_told`.
UNTOLD_DEFORMATION = "The file does not say whether its moduli are tensile or shear; taken as tensile."


def deformation_is_told(sweeps: IsothermalSweeps) -> bool:
    """Return whether the file or the caller of `read_dma` said that the moduli are tensile or shear.

    Parameters
    ----------
    sweeps : IsothermalSweeps
        As `read_dma` returned them.
    """
    return UNTOLD_DEFORMATION not in sweeps.notes


def read_dma(path: str | PathLike[str], *, deformation: Deformation | None = None) -> IsothermalSweeps:
    """Read frequency sweeps at several temperatures from a table of a dynamic mechanical analyser.

    Parameters
    ----------
    path : str or path
        Text table with a header that names temperature, frequency (``f (Hz)``) or angular frequency
        (``omega (rad/s)``), storage and loss modulus, each with its unit; rows in any order.
    deformation : {"tension", "shear"}, optional
        What the moduli are, where the header does not say it (E' or G'); tension if nobody says it, with a
        note.

    Returns
    -------
    IsothermalSweeps
        In SI units.  Its notes name every row left out (loss modulus not above zero), averaged or reordered.

    Raises
    ------
    DataFileError
        If the file cannot be read, a column or unit is missing or wrong, a cell is not a finite number, a
        storage modulus or frequency is not above zero, two columns of frequency contradict each other, or the
        temperatures form a ramp, not isotherms.
    InputError
        If `deformation` is neither "tension" nor "shear".
    """
    if deformation not in (None, "tension", "shear"):
        raise InputError(f"deformation = {deformation!r}: must be 'tension' or 'shear'.")
    table = read_table(path)
    places = _columns(table)
    kind, notes = _deformation(table, places, deformation)
    temperature = table.values(places["temperature"], "K")
    frequency = _angular_frequency(table, places["frequency"])
    _insist_on_one_frequency(table, places["frequency"], frequency)
    storage = table.values(places["storage modulus"], "Pa")
    loss = table.values(places["loss modulus"], "Pa")
    _insist_on_positive(table, places["temperature"], temperature)
    _insist_on_positive(table, places["frequency"], frequency)
    _insist_on_positive(table, places["storage modulus"], storage)

    notes += doubts(table, places, temperature, storage)
    keep = loss > 0.0
    for row in np.flatnonzero(~keep):
        notes.append(
            f"Line {table.lines[row]} left out: its loss modulus is not above zero "
            f"({loss[row]:.4g} Pa at {celsius(temperature[row]):z.1f} °C, "
            f"{frequency[row] / (2 * math.pi):.4g} Hz)."
        )
    if not keep.any():
        raise DataFileError(table.path, "no row has a loss modulus above zero.")
    temperature, frequency, storage, loss = (c[keep] for c in (temperature, frequency, storage, loss))
    isotherms, sorted_ones, averaged, repeated = [], [], [], 0
    for rows in _isotherm_rows(table, temperature):
        isotherm, reordered, repeats = _isotherm(temperature[rows], frequency[rows], storage[rows], loss[rows])
        isotherms.append(isotherm)
        sorted_ones += [isotherm.temperature] if reordered else []
        averaged += [isotherm.temperature] if repeats else []
        repeated += repeats
    if sorted_ones:
        notes.append(f"The rows {_at(sorted_ones)} were sorted by frequency.")
    if repeated:
        what = "1 repeated frequency" if repeated == 1 else f"{repeated} repeated frequencies"
        notes.append(f"{what} {_at(averaged)} {'was' if repeated == 1 else 'were'} averaged.")
    if np.any(np.diff(temperature) < -ISOTHERM_GAP):
        notes.append("The isotherms were sorted by temperature.")
    return IsothermalSweeps(tuple(isotherms), kind, table.path, tuple(notes))


def _at(temperatures: list[float]) -> str:
    """Name temperatures in ascending order, the first few of many."""
    shown = [f"{celsius(kelvin):z.1f}" for kelvin in temperatures[:3]]
    more = len(temperatures) - len(shown)
    if more:
        return f"at {', '.join(shown)} °C and {more} more temperature{'s' if more > 1 else ''}"
    return f"at {' and '.join([', '.join(shown[:-1]), shown[-1]] if shown[1:] else shown)} °C"


def _columns(table: Table) -> dict[str, int]:
    """Find the four columns, or say which are missing and what there is."""
    angular = table.find(ANGULAR_FREQUENCY, "angular frequency")
    places = {
        "temperature": table.find(TEMPERATURE, "temperature"),
        "frequency": table.find(FREQUENCY, "frequency") if angular is None else angular,
        "storage modulus": table.find(STORAGE_MODULUS, "storage modulus"),
        "loss modulus": table.find(LOSS_MODULUS, "loss modulus"),
    }
    missing = [name for name, place in places.items() if place is None]
    if missing:
        if any("traction" in column.name.lower() for column in table.columns):
            raise DataFileError(
                table.path,
                "this is a table of traction runs, not of DMA sweeps; use read_mtm, or name it as mtm under "
                "[measurement] of a run file.",
            )
        raise DataFileError(
            table.path,
            f"no column for {' or '.join(missing)}; a DMA table has e.g. 'temperature (degC)', 'frequency (Hz)', "
            f"'storage modulus (MPa)', 'loss modulus (MPa)', this one has {table.headings()}.",
        )
    return {name: place for name, place in places.items() if place is not None}


def _deformation(table: Table, places: dict[str, int], asked: Deformation | None) -> tuple[Deformation, list[str]]:
    """Decide between tension and shear: what the header says, else what the caller says, else tension."""
    said = {
        kind
        for kind in (_said_by(table.columns[places[name]]) for name in ("storage modulus", "loss modulus"))
        if kind is not None
    }
    if len(said) > 1:
        raise DataFileError(table.path, "one modulus is headed as tensile (E), the other as shear (G).")
    if said:
        kind = said.pop()
        if asked not in (None, kind):
            heading = table.columns[places["storage modulus"]].heading
            raise DataFileError(
                table.path, f"the header says {kind} ({heading!r}), but deformation={asked!r} was asked."
            )
        return kind, [f"The file's header says that the moduli were measured in {kind}."]
    if asked is not None:
        return asked, [f"The moduli are taken as measured in {asked}, as asked; the file does not say it."]
    return "tension", [UNTOLD_DEFORMATION]


def _said_by(column: Column) -> Deformation | None:
    name = column.name.lower()
    if name.startswith("g'") or "shear" in name:
        return "shear"
    return "tension" if name.startswith("e'") or "tensi" in name or "young" in name else None


def _angular_frequency(table: Table, place: int) -> Array:
    """Return rad/s.  pint holds the radian for a pure number, so hertz and rad/s are told apart here."""
    column = table.columns[place]
    named_angular = column.name in ANGULAR_FREQUENCY or column.name.lower() in ANGULAR_FREQUENCY
    unit = column.unit.replace(" ", "")
    hertz = re.fullmatch(r"[mkM]?Hz", unit, re.IGNORECASE)
    bare = re.fullmatch(r"1/s|s\^?-1|s⁻¹", unit)
    if re.fullmatch(r"rad(/s|s\^?-1|·s⁻¹|s⁻¹|\*s\^-1)", unit) or (bare and named_angular):
        return table.numbers(place)
    if (hertz and not named_angular) or bare:
        prefix = {"m": 1e-3, "k": 1e3, "K": 1e3, "M": 1e6}[unit[0]] if hertz and len(unit) == 3 else 1.0
        return 2.0 * math.pi * prefix * table.numbers(place)
    right = "'rad/s'" if named_angular else "'Hz' or 'rad/s'"
    shown = f"the unit {column.unit!r}" if column.unit else "no unit"
    raise DataFileError(table.path, f"column {column.heading!r} has {shown}; it must be {right}.")


def _insist_on_one_frequency(table: Table, used: int, angular_frequency: Array) -> None:
    """Compare with a second column of frequency, where there is one."""
    other = table.find(FREQUENCY, "frequency")
    if other is None or other == used:
        return
    apart = np.abs(_angular_frequency(table, other) - angular_frequency) > PRINTED_FREQUENCY * np.abs(angular_frequency)
    if np.any(apart):
        row = int(np.argmax(apart))
        told = [
            f"{table.rows[row][place].strip()} in column {table.columns[place].heading!r}" for place in (other, used)
        ]
        problem = f"{' and '.join(told)} contradict each other (ω = 2πf); correct or leave out one of them."
        raise DataFileError(table.path, problem, int(table.lines[row]))


def _insist_on_positive(table: Table, place: int, values: Array) -> None:
    bad = np.flatnonzero(values <= 0.0)
    if bad.size:
        row, column = int(bad[0]), table.columns[place]
        problem = f"{table.rows[row][place].strip()} in column {column.heading!r} must be above "
        problem += "absolute zero." if column.name in TEMPERATURE or column.name.lower() in TEMPERATURE else "zero."
        raise DataFileError(table.path, problem, int(table.lines[row]))


def _isotherm_rows(table: Table, temperature: Array) -> list[NDArray[np.intp]]:
    """Group rows whose measured temperatures lie together, cut where neighbours differ by more than a gap."""
    order = np.argsort(temperature, kind="stable")
    cuts = np.flatnonzero(np.diff(temperature[order]) > ISOTHERM_GAP) + 1
    groups = np.split(order, cuts)
    for rows in groups:
        low, high = float(temperature[rows].min()), float(temperature[rows].max())
        if high - low > WIDEST_ISOTHERM:
            raise DataFileError(
                table.path,
                f"the temperatures from {celsius(low):z.1f} to {celsius(high):z.1f} °C run on without a gap of "
                f"{ISOTHERM_GAP:g} K; isothermal sweeps are wanted, not a temperature ramp.",
            )
    return [np.sort(rows) for rows in groups]


def _isotherm(temperature: Array, frequency: Array, storage: Array, loss: Array) -> tuple[Isotherm, bool, int]:
    """Sort one isotherm by frequency and average repeats; say if it was out of order, and how many."""
    order = np.argsort(frequency, kind="stable")
    reordered = bool(np.any(np.diff(frequency) < 0))
    ordered = frequency[order]
    group = np.concatenate([[0], np.cumsum(np.diff(ordered) > SAME_FREQUENCY * ordered[1:])])
    count = np.bincount(group)
    averages = [np.bincount(group, column[order]) / count for column in (frequency, storage, loss)]
    isotherm = Isotherm(float(np.mean(temperature)), *averages)
    return isotherm, reordered, int(len(frequency) - len(count))
