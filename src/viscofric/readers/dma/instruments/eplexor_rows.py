"""Which isotherm each row of a Netzsch Eplexor master curve was measured in, by the programme of the sweeps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.readers.dma.instruments.eplexor_master import AS_IT_IS, SHIFT_LIST

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.arrays import Array, Indices, Mask
    from viscofric.readers.dma.instruments.eplexor_master import Rows


HEADER = "Data header"

#: Programmed frequencies are printed to six digits; false ones lie some thousandths of a decade off.
SAME_FREQUENCY = 1e-3  # decades
#: A sweep has tens of frequencies, a list tens of temperatures; a damaged file may claim any number.
MOST_FREQUENCIES = 1000
MOST_CANDIDATES = 5_000_000


def programmed_frequencies(tables: Mapping[str, Rows]) -> Array | None:
    """Return the frequencies of the sweep, Hz, as the sheet 'Data header' gives them, or None if it does not.

    Parameters
    ----------
    tables : mapping of str to rows
        Sheets of the workbook.
    """
    rows = tables.get(HEADER, ())
    for place, row in enumerate(rows):
        titles = [str(cell).strip() for cell in row]
        if "Frequency range:" not in titles or "Frequency increment:" not in titles:
            continue
        values = next((below for below in rows[place + 1 :] if below and str(below[0]).startswith("Values")), ())
        low, per_decade = titles.index("Frequency range:"), titles.index("Frequency increment:")
        try:
            first, last, density = (float(values[place]) for place in (low, low + 1, per_decade))
            steps = density * math.log10(last / first)
        except (IndexError, TypeError, ValueError, ZeroDivisionError):
            return None
        if not (0.0 < steps < MOST_FREQUENCIES and first > 0.0 and density > 0.0):
            return None
        # Ten to a whole number of steps; the printed bounds carry the rounding of single precision.
        inside = first * 10.0 ** (np.arange(np.floor(steps + SAME_FREQUENCY) + 1) / density)
        ends_short = steps - np.floor(steps + SAME_FREQUENCY) > SAME_FREQUENCY
        return np.append(inside, last) if ends_short else inside
    return None


def isotherm_of_each_row(
    frequency: Array, time: Array | None, shifts: Array, programmed: Array, path: str, places: Sequence[str]
) -> Indices:
    """Find the isotherm that each row of a master curve was measured in.

    A row belongs to the isotherm whose shift takes its frequency back to one of the programme.  Where two shifts
    do so (they differ by a whole number of steps), the row belongs with those measured next to it in time.

    Parameters
    ----------
    frequency : (n,) array
        Shifted, Hz.
    time : (n,) array or None
        Of measurement, s.
    shifts : (m,) array
        log10 α of the isotherms.
    programmed : (k,) array
        Frequencies of the sweep, Hz, ascending.
    path, places
        The file, and where each row stands, for error messages.

    Returns
    -------
    (n,) array of int
        Places in `shifts`.

    Raises
    ------
    DataFileError
        If a row fits no isotherm, or several and cannot be told apart: for want of times, or because an isotherm would
        be left without rows or hold a frequency twice.
    """
    if frequency.size * shifts.size > MOST_CANDIDATES:
        raise DataFileError(path, f"{frequency.size} rows and {shifts.size} shifts are more than any sweep has.")
    measured = np.log10(frequency)[:, None] - shifts[None, :]
    grid = np.log10(programmed)
    after = np.clip(np.searchsorted(grid, measured), 1, max(grid.size - 1, 1))
    below = after - 1
    after = np.minimum(after, grid.size - 1)
    place = np.where(np.abs(measured - grid[below]) <= np.abs(measured - grid[after]), below, after)
    fits = np.abs(measured - grid[place]) < SAME_FREQUENCY
    count = fits.sum(axis=1)
    if np.any(count == 0):
        first = int(np.argmin(count))
        raise DataFileError(
            path,
            f"{places[first]}: no shift of the list takes {frequency[first]:.6g} Hz back to a frequency of the "
            f"programme, so that the master curve cannot be taken apart; {AS_IT_IS}.",
        )
    chosen: Indices = np.argmax(fits, axis=1)
    for row in np.flatnonzero(count > 1):
        chosen[row] = _next_in_time(int(row), time, fits[row], chosen, count == 1, path, places)
    _insist_on_one_row_each(chosen, place[np.arange(chosen.size), chosen], fits, path)
    return chosen


def _insist_on_one_row_each(chosen: Indices, place: Indices, fits: Mask, path: str) -> None:
    """Refuse isotherms that lost all their rows to others, or took such of others.

    Both happen where shifts lie whole steps of the programme apart, so that all rows of an isotherm fit another too.
    """
    lost = fits.any(axis=0) & ~np.isin(np.arange(fits.shape[1]), chosen)
    doubtful = fits.sum(axis=1) > 1
    _, which, count = np.unique(np.stack([chosen, place]), axis=1, return_inverse=True, return_counts=True)
    if lost.any() or np.any(doubtful & (count[np.ravel(which)] > 1)):
        problem = f"the shifts in sheet {SHIFT_LIST!r} lie whole steps of the frequency programme apart, so that the "
        raise DataFileError(path, problem + f"rows of the master curve cannot be told apart; {AS_IT_IS}.")


def _next_in_time(
    row: int,
    time: Array | None,
    candidates: Mask,
    chosen: Indices,
    settled: Mask,
    path: str,
    places: Sequence[str],
) -> int:
    near = settled & candidates[chosen]
    if time is None or not np.any(near):
        raise DataFileError(
            path,
            f"{places[row]} could belong to several isotherms, and no column 'Time' tells which; {AS_IT_IS}.",
        )
    distance = np.where(near, np.abs(time - time[row]), np.inf)
    return int(chosen[np.argmin(distance)])
