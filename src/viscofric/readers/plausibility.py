"""Notes on values of a DMA table that look as if their heading named the wrong unit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.readers.table import Table

    Array = NDArray[np.float64]

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
        Its columns by what they hold; temperature and storage modulus are looked at.
    temperature : (n,) array
        As the heading says it, K.
    storage_modulus : (n,) array
        As the heading says it, Pa.
    """
    notes = []
    place = places["temperature"]
    printed, heading = table.numbers(place), table.columns[place].heading
    low, high = float(printed.min()), float(printed.max())
    span = f"The temperatures in column {heading!r} run from {low:g} to {high:g}"
    in_celsius = np.allclose(temperature - printed, 273.15, rtol=0.0, atol=1e-6)
    in_kelvin = np.allclose(temperature, printed, rtol=1e-9, atol=0.0)
    if in_celsius and low >= LIKE_KELVIN[0] and high <= LIKE_KELVIN[1]:
        notes.append(f"{span} and look like kelvin; they were read as °C, as the heading says.")
    if in_kelvin and high < COLDEST:
        notes.append(f"{span} and look like °C; they were read as kelvin, as the heading says.")
    outside = (storage_modulus < PLAUSIBLE_MODULUS[0]) | (storage_modulus > PLAUSIBLE_MODULUS[1])
    if np.any(outside):
        row = int(np.argmax(outside))
        heading = table.columns[places["storage modulus"]].heading
        notes.append(
            f"A storage modulus of {storage_modulus[row]:.3g} Pa (line {table.lines[row]}) is not one of a solid; "
            f"the unit in column {heading!r} is probably wrong."
        )
    return notes
