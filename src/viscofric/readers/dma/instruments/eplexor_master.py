"""The shift list of a Netzsch Eplexor workbook, by which `eplexor_rows` takes a master curve apart again.

The software joins isotherms by hand or by fit, writes the shifts into the sheet 'Shiftlist', multiplies every
frequency by ``10**shift``, puts the temperature of the isotherm without shift into all rows and sorts them by
frequency.  Moduli stay as measured.  The sign is that of α: above zero below the reference temperature.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import DataFileError
from viscofric.units import CELSIUS_ZERO, celsius, conversion

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.arrays import Array

    Rows = Sequence[Sequence[Any]]

SHIFT_LIST = "Shiftlist"

#: The rows of a master curve carry the measured temperature of the isotherm without shift, digit by digit.
SAME_TEMPERATURE = 0.5  # K
#: Beyond this α is no number that a computer holds.
LARGEST_SHIFT = 300.0  # decades

#: What remains to do with a master curve that cannot be taken apart.
AS_IT_IS = "save its columns of f and the moduli as CSV and read that with read_master_curve"

_NUMBER = r"([+-]?\d+(?:[.,]\d+)?(?:[eE][+-]?\d+)?)"
_TEMPERATURE = re.compile(_NUMBER + r"\s*(°\s*C|C|K|°\s*F|F)", re.IGNORECASE)
_C1 = re.compile(r"C1\s*:?\s*" + _NUMBER)
_C2 = re.compile(r"C2\s*:?\s*" + _NUMBER + r"\s*K?")


@dataclass(frozen=True, eq=False)
class ShiftList:
    """What the sheet 'Shiftlist' holds.

    Parameters
    ----------
    temperatures : (n,) array
        Of the isotherms, in the order of the sheet, K.
    log10_shifts : (n,) array
        log10 α.
    reference : float or None
        Reference temperature as the sheet states it (a programmed one, such as 25.0 °C), K.
    wlf : (float, float) or None
        The software's own WLF fit about the reference: C1 and C2 (K).
    """

    temperatures: Array
    log10_shifts: Array
    reference: float | None
    wlf: tuple[float, float] | None

    @property
    def measured_reference(self) -> float | None:
        """Measured temperature of the isotherm that was not shifted, K, or None if every one was."""
        still = np.flatnonzero(self.log10_shifts == 0.0)
        return float(self.temperatures[still[0]]) if still.size == 1 else None


def shift_list(tables: Mapping[str, Rows], path: str) -> ShiftList | None:
    """Return the shift list of a workbook, or None where it has none.

    Parameters
    ----------
    tables : mapping of str to rows
        Sheets of the workbook.
    path : str
        The file, for error messages.

    Raises
    ------
    DataFileError
        If the sheet is there but holds no rows of a temperature and a shift.
    """
    rows = tables.get(SHIFT_LIST)
    if rows is None:
        return None
    reference, wlf, numbers = None, None, []
    factor, offset = 1.0, CELSIUS_ZERO
    in_table = False
    for place, row in enumerate(rows, start=1):
        label = str(row[0]).strip() if row else ""
        words = " ".join(str(cell) for cell in row[1:])
        if label.startswith("Ref"):
            reference = _kelvin(words)
        elif label.startswith("WLF"):
            wlf = _constants(words)
        elif label.startswith("Temp"):
            in_table = True
            factor, offset = _unit_beside(label)
        elif in_table and label:
            temperature, shift = _pair(row, place, path)
            numbers.append((_above_zero(factor * temperature + offset, place, path), shift))
    if len(numbers) < 2:
        problem = f"sheet {SHIFT_LIST!r} must list a temperature and a shift for each of two isotherms or more."
        raise DataFileError(path, problem)
    temperatures, shifts = np.array(numbers).T
    return ShiftList(temperatures, shifts, reference, wlf)


def _pair(row: Sequence[Any], place: int, path: str) -> tuple[float, float]:
    cells = [cell for cell in row[:2] if isinstance(cell, (int, float)) and math.isfinite(cell)]
    if len(cells) != 2 or abs(cells[1]) > LARGEST_SHIFT:
        raise DataFileError(path, f"sheet {SHIFT_LIST!r}, row {place} must hold a temperature and a shift.")
    return float(cells[0]), float(cells[1])


def _unit_beside(label: str) -> tuple[float, float]:
    """Return factor and offset to kelvin by the unit in "Temp. [K]"; °C where there is none."""
    match = re.search(r"[\[(]\s*°?\s*([CKF])\s*[\])]", label, re.IGNORECASE)
    return conversion({"C": "degC", "K": "K", "F": "degF"}[match[1].upper()] if match else "degC", "K")


def _above_zero(kelvin: float, place: int, path: str) -> float:
    if not kelvin > 0.0:
        raise DataFileError(path, f"sheet {SHIFT_LIST!r}, row {place}: the temperature is not above absolute zero.")
    return kelvin


def insist_on_sense(shifts: ShiftList, reference: float, path: str) -> None:
    """Refuse a shift list that contradicts the rows' own temperature, or whose shifts rise with temperature.

    Parameters
    ----------
    shifts : ShiftList
        Of the workbook.
    reference : float
        Temperature that the rows of its master curve carry, K.
    path : str
        The file, for error messages.

    Raises
    ------
    DataFileError
        If the isotherm without shift has another temperature, as a list in another unit would show; or if shifts
        rise with temperature, so that hot and cold isotherms would change places.
    """
    still = shifts.measured_reference
    if still is not None and abs(still - reference) > SAME_TEMPERATURE:
        told = f"{celsius(still):z.1f} °C, but the rows are of {celsius(reference):z.1f} °C"
        problem = f"the isotherm without shift in sheet {SHIFT_LIST!r} is of {told}; is the list in another unit?"
        raise DataFileError(path, problem)
    about = shifts.temperatures - shifts.temperatures.mean()
    if about @ shifts.log10_shifts > 0.0:
        problem = (
            f"the shifts in sheet {SHIFT_LIST!r} rise with temperature; above the reference they must be negative."
        )
        raise DataFileError(path, problem)


def _kelvin(words: str) -> float | None:
    match = _TEMPERATURE.search(words)
    if match is None:
        return None
    unit = {"c": "degC", "k": "K", "f": "degF"}[match[2].strip("°").strip().lower()]
    factor, offset = conversion(unit, "K")
    return factor * float(match[1].replace(",", ".")) + offset


def _constants(words: str) -> tuple[float, float] | None:
    first, second = _C1.search(words), _C2.search(words)
    if first is None or second is None:
        return None
    return float(first[1].replace(",", ".")), float(second[1].replace(",", "."))
