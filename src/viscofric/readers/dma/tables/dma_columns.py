"""Which column of a DMA table is what, and the frequencies and moduli that follow from them, in SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note, setting
from viscofric.readers.dma.agreement import insist_on_agreement
from viscofric.readers.dma.deformation import deformation_of, said_by_columns
from viscofric.readers.dma.names import (
    ANGULAR_FREQUENCY,
    COMPLEX_MODULUS,
    FREQUENCY,
    ISOTHERM,
    LOSS_MODULUS,
    LOSS_TANGENT,
    REDUCED_ANGULAR_FREQUENCY,
    REDUCED_FREQUENCY,
    SET_TEMPERATURE,
    STORAGE_MODULUS,
    TEMPERATURE,
    quantity,
)
from viscofric.readers.printed import PRINTED_FREQUENCY, to_rad_per_second, unit_conversion
from viscofric.readers.table import MISSING

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.dma.deformation import Said
    from viscofric.readers.source import Source
    from viscofric.readers.table import Table


_HINT = ", or give it by " + setting("material.modulus_unit", "Unit of the moduli", "'MPa'")
_MODULI = ("storage modulus", "loss modulus", "complex modulus")


def find_columns(table: Table, *, master_curve: bool = False) -> dict[str, int]:
    """Return the places of the columns by quantity.

    Reduced frequencies count before measured ones in a master curve; `is_reduced` tells which of the two was found.

    Raises
    ------
    DataFileError
        If there is no frequency, or the columns do not give both moduli.
    """
    found = {
        "temperature": table.find(TEMPERATURE, "temperature"),
        "frequency": _frequency_place(table, master_curve=master_curve),
        "storage modulus": table.find(STORAGE_MODULUS, "storage modulus"),
        "loss modulus": table.find(LOSS_MODULUS, "loss modulus"),
        "complex modulus": table.find(COMPLEX_MODULUS, "complex modulus"),
        "tan delta": table.find(LOSS_TANGENT, "tan delta"),
    }
    if found["temperature"] is None:
        found["temperature"] = table.find(ISOTHERM if master_curve else SET_TEMPERATURE, "temperature")
    places = {what: place for what, place in found.items() if place is not None}
    tangent = places.get("tan delta")
    if tangent is not None and table.columns[tangent].unit not in ("", "1"):  # a tangent has no unit
        del places["tan delta"]
    missing = [] if "frequency" in places else ["frequency"]
    if "tan delta" not in places or not any(modulus in places for modulus in _MODULI):
        missing += [modulus for modulus in _MODULI[:2] if modulus not in places]
    if missing and "temperature" not in places:
        missing.insert(0, "temperature")
    if missing:
        raise DataFileError(
            table.path,
            f"no column for {' or '.join(missing)}; a DMA table has e.g. 'temperature (degC)', 'frequency (Hz)', "
            f"'storage modulus (MPa)', 'loss modulus (MPa)', this one has {table.headings()}.",
        )
    return places


def _frequency_place(table: Table, *, master_curve: bool) -> int | None:
    measured = (ANGULAR_FREQUENCY, "angular frequency"), (FREQUENCY, "frequency")
    reduced = (REDUCED_ANGULAR_FREQUENCY, "reduced angular frequency"), (REDUCED_FREQUENCY, "reduced frequency")
    for names, what in (*reduced, *measured) if master_curve else (*measured, *reduced):
        place = table.find(names, what)
        if place is not None:
            return place
    return None


def is_reduced(table: Table, places: dict[str, int]) -> bool:
    """Return whether the frequencies are reduced ones, those of a master curve."""
    return "reduced" in (quantity(table.columns[places["frequency"]].name) or "")


def angular_frequency(table: Table, places: dict[str, int], notes: list[str]) -> Array:
    """Return rad/s, NaN where a cell is missing; adds a note where the unit follows from the name only."""
    place = places["frequency"]
    if not table.columns[place].unit and _is_angular(table, place):
        shown = table.columns[place].heading
        notes.append(
            Note(
                "frequency-without-unit",
                f"The column {shown!r} has no unit; it was read in rad/s, as its name implies.",
            )
        )
        return table.numbers_or_missing(place)
    return _in_rad_per_second(table, place)


def _is_angular(table: Table, place: int) -> bool:
    return "angular" in (quantity(table.columns[place].name) or "")


def _in_rad_per_second(table: Table, place: int) -> Array:
    """Return rad/s, or raise `DataFileError` where the unit tells neither hertz nor rad/s."""
    column = table.columns[place]
    named_angular = _is_angular(table, place)
    factor = to_rad_per_second(column.unit, angular=named_angular)
    if factor is not None:
        return factor * table.numbers_or_missing(place)
    right = "'rad/s'" if named_angular else "'Hz' or 'rad/s'"
    shown = f"the unit {column.unit!r}" if column.unit else "no unit"
    raise DataFileError(table.path, f"column {column.heading!r} has {shown}; it must be {right}.")


def insist_on_one_frequency(table: Table, places: dict[str, int], angular: Array) -> None:
    """Raise `DataFileError` where a second column of frequency contradicts the first."""
    used, other = places["frequency"], table.find(FREQUENCY, "frequency")
    if other is None or other == used or is_reduced(table, places):
        return
    apart = np.abs(_in_rad_per_second(table, other) - angular) > PRINTED_FREQUENCY * np.abs(angular)
    if np.any(apart):
        row = int(np.argmax(apart))
        told = [
            f"{table.rows[row][place].strip()} in column {table.columns[place].heading!r}" for place in (other, used)
        ]
        problem = f"{' and '.join(told)} contradict each other (ω = 2πf); correct or leave out one of them."
        raise DataFileError(table.path, problem, int(table.lines[row]))


def moduli(table: Table, places: dict[str, int], source: Source, notes: list[str]) -> tuple[Array, Array]:
    """Return storage and loss modulus, Pa, as printed or from tan δ; adds notes on what was computed.

    With E'' = E' tan δ and |E*|² = E'² + E''², one modulus and tan δ give the others exactly; where more is printed
    than is needed, `DataFileError` is raised if it contradicts.
    """
    values = {what: _modulus(table, places[what], source, notes) for what in _MODULI if what in places}
    if "storage modulus" in values and "loss modulus" in values:
        storage, loss = values["storage modulus"], values["loss modulus"]
        insist_on_agreement(table.path, storage, loss, _tangent_beside(table, places), values.get("complex modulus"))
        return storage, loss
    tangent = table.numbers_or_missing(places["tan delta"])
    if "storage modulus" in values:
        notes.append(Note("loss-computed", "The loss moduli were computed as storage modulus times tan δ."))
        return values["storage modulus"], values["storage modulus"] * tangent
    if "loss modulus" in values:
        notes.append(Note("storage-computed", "The storage moduli were computed as loss modulus over tan δ."))
        tangent = np.where(tangent == 0.0, np.nan, tangent)
        return values["loss modulus"] / tangent, values["loss modulus"]
    notes.append(
        Note(
            "moduli-computed",
            "Storage and loss moduli were computed from the absolute value of the complex modulus and tan δ.",
        )
    )
    storage = values["complex modulus"] / np.hypot(1.0, tangent)
    return storage, storage * tangent


def _tangent_beside(table: Table, places: dict[str, int]) -> Array | None:
    """Return tan δ where both moduli are printed too, None if its column holds no numbers: it is not needed."""
    try:
        return table.numbers_or_missing(places["tan delta"]) if "tan delta" in places else None
    except DataFileError:
        return None


def unit_is_asked(table: Table, places: dict[str, int], source: Source) -> bool:
    """Return whether a modulus has no unit but the one that the user gave."""
    return bool(source.modulus_unit) and any(not table.columns[places[m]].unit for m in _MODULI if m in places)


def _modulus(table: Table, place: int, source: Source, notes: list[str]) -> Array:
    """Return a column in Pa, by its own unit or by the one that the user gave."""
    column = table.columns[place]
    if source.modulus_unit and not column.unit:
        factor, offset = unit_conversion(source.modulus_unit, "Pa", "modulus_unit")
        note = Note(
            "modulus-unit-given",
            f"The moduli have no unit in the file; they were read in {source.modulus_unit}, as asked.",
        )
        if note not in notes:
            notes.append(note)
    else:
        factor, offset = table.conversion(column, "Pa", _HINT)
    return factor * table.numbers_or_missing(place) + offset


def deformation(table: Table, places: dict[str, int]) -> Said:
    """Return what headings and tool say of the deformation, and by which words.

    Raises
    ------
    DataFileError
        If one modulus is called tensile and another one shear.
    """
    said = [(deformation_of(table.columns[places[m]].name), places[m]) for m in _MODULI if m in places]
    if {"tension", "shear"} <= {kind for kind, _ in said}:
        raise DataFileError(table.path, "one modulus is headed as tensile (E), the other as shear (G).")
    for kind, place in said:
        if kind is not None:
            return kind, f"the heading {table.columns[place].heading!r}"
    filled = [
        column.name
        for place, column in enumerate(table.columns)
        if any(row[place].strip().lower() not in MISSING for row in table.rows)
    ]
    return said_by_columns((), filled, table.tools)
