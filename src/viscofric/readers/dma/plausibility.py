"""Notes on values of a DMA table that look as if their heading named the wrong unit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note
from viscofric.units import CELSIUS_ZERO

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.table import Table


#: Sweeps of a rubber, printed in kelvin, lie within this.
LIKE_KELVIN = (200.0, 400.0)
#: No rubber is swept below this many kelvin.
COLDEST = 150.0
#: From the thinnest gel to ten times diamond.
PLAUSIBLE_MODULUS = (1.0, 1e13)  # Pa


def doubts(table: Table, places: dict[str, int], temperature: Array, storage_modulus: Array) -> list[str]:
    """Say what looks like a wrong unit; nothing is changed.

    Parameters
    ----------
    table : Table
        The file.
    places : dict
        Its columns by what they hold; temperature and moduli are looked at.
    temperature : (n,) array
        As the heading says it, K; NaN where there is none.
    storage_modulus : (n,) array
        As the heading says it, Pa; NaN where there is none.
    """
    notes = _of_temperature(table, places["temperature"], temperature) if "temperature" in places else []
    solid = (storage_modulus >= PLAUSIBLE_MODULUS[0]) & (storage_modulus <= PLAUSIBLE_MODULUS[1])
    # what is not above zero is noise of the instrument, told elsewhere
    outside = ~solid & (storage_modulus > 0.0)
    if np.any(outside):
        row = int(np.argmax(outside))
        place = next(places[m] for m in ("storage modulus", "loss modulus", "complex modulus") if m in places)
        notes.append(
            Note(
                "implausible-modulus",
                f"A storage modulus of {storage_modulus[row]:.3g} Pa (line {table.lines[row]}) is not one of a solid; "
                f"the unit in column {table.columns[place].heading!r} is probably wrong.",
            )
        )
    return notes


def _of_temperature(table: Table, place: int, temperature: Array) -> list[str]:
    known = np.isfinite(temperature)
    if not known.any():
        return []
    printed, heading = table.numbers_or_missing(place)[known], table.columns[place].heading
    low, high = float(printed.min()), float(printed.max())
    span = f"The temperatures in column {heading!r} run from {low:g} to {high:g}"
    in_celsius = np.allclose(temperature[known] - printed, CELSIUS_ZERO, rtol=0.0, atol=1e-6)
    in_kelvin = np.allclose(temperature[known], printed, rtol=1e-9, atol=0.0)
    if in_celsius and low >= LIKE_KELVIN[0] and high <= LIKE_KELVIN[1]:
        return [
            Note("implausible-temperature", f"{span} and look like kelvin; they were read as °C, as the heading says.")
        ]
    if in_kelvin and high < COLDEST:
        return [
            Note("implausible-temperature", f"{span} and look like °C; they were read as kelvin, as the heading says.")
        ]
    return []
