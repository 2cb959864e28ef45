"""Text files of RepTate: one line of parameters, then names and units, then frequency, G' and G'' in columns.

A sweep (.osc) names its columns and has one temperature; a master curve (.tts) is columns alone, in rad/s and Pa.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.errors import DataFileError, not_needed
from viscofric.readers.dma.names import deformation_of, quantity
from viscofric.readers.dma.readings import AS_MASTER_CURVE, Readings
from viscofric.readers.headings import heading
from viscofric.readers.source import Source, to_rad_per_second, unit_conversion
from viscofric.units import CELSIUS_ZERO

NAME = "RepTate text (.osc, .tts)"
#: Lines that show whether columns have names.
_HEAD = 20
_PARAMETERS = re.compile(r"\s*(?:[\w ]+=[^;=]*;)+(?:[\w ]+=[^;=]*)?\s*")


@dataclass(frozen=True, eq=False)
class RepTateColumns:
    """The content of a RepTate file; without names of columns it is a master curve."""

    parameters: dict[str, str]  # of the first line, such as {"T": "-35", "Mw": "2.4"}
    is_master_curve: bool
    lines: Integers  # of the file
    angular_frequency: Array  # rad/s
    storage_modulus: Array  # Pa
    loss_modulus: Array  # Pa
    temperature: Array  # K, NaN if unknown
    strain_amplitude: Array | None  # fraction
    said_by: str  # heading of the storage modulus


def recognises(source: Source) -> bool:
    """Return whether the first line is one of parameters that name a temperature or a molar mass."""
    if source.text is None:
        return False
    first, *below = [line for line in source.text[:4000].splitlines() if line.strip()][:_HEAD] or [""]
    if not _PARAMETERS.fullmatch(first):
        return False
    columns = [line.split() for line in below if not line.lstrip().startswith("#")]
    without_names = bool(columns) and len(columns[0]) > 2 and all(map(_is_number, columns[0][:3]))
    return without_names or bool({"T", "Mw"} & set(_parameters(first)))


def parameters_of(line: str) -> dict[str, str]:
    """Return the parameters of a first line such as ``T=-35;Mw=2.4;``, none if it is no such line."""
    return _parameters(line) if _PARAMETERS.fullmatch(line[:2000]) else {}


def _parameters(line: str) -> dict[str, str]:
    parts = (part.partition("=") for part in line.strip().split(";") if "=" in part)
    return {name.strip(): value.strip() for name, _, value in parts}


def read(source: Source) -> Readings:
    """Return the points of one sweep (.osc); a master curve is an error, see `read_master_curve`."""
    found = columns(source)
    if found.is_master_curve:
        reference = found.parameters.get("T", "25")
        problem = f"is a master curve of RepTate at {reference} °C"
        raise DataFileError(source.path, problem, code="master-curve", remedy=AS_MASTER_CURVE)
    if source.temperature is not None:
        raise not_needed(
            source.path, "temperature", "temperature-not-needed", "contains its temperature", " for this file"
        )
    if not np.all(np.isfinite(found.temperature)):
        raise DataFileError(
            source.path,
            "contains no temperature, neither as T= in its first line nor in a column.",
            code="no-temperature",
        )
    return Readings(
        source=source.path,
        format=NAME,
        places=tuple(f"line {line}" for line in found.lines),
        temperature=found.temperature,
        angular_frequency=found.angular_frequency,
        storage_modulus=found.storage_modulus,
        loss_modulus=found.loss_modulus,
        deformation=deformation_of(heading(found.said_by).name),
        said_by=f"the heading {found.said_by!r}",
        strain_amplitude=found.strain_amplitude,
    )


def columns(source: Source) -> RepTateColumns:
    """Return the columns of a sweep or a master curve, or raise `DataFileError`."""
    lines = enumerate((source.text or "").splitlines(), start=1)
    numbered = [(n, line) for n, line in lines if line.strip() and not line.lstrip().startswith("#")]
    parameters = _parameters(numbered[0][1])
    body = numbered[1:]
    names, units = _header(body)
    rows = body[2:] if names and units else body[1:] if names else body
    if not rows:
        raise DataFileError(source.path, "there is no row of numbers under the line of parameters.", code="no-points")
    places = _places(source, names)
    width = max(places[what] for what in ("frequency", "storage modulus", "loss modulus")) + 1
    cells = [(number, line.split()) for number, line in rows]
    short = next((number for number, row in cells if len(row) < width), None)
    if short is not None:
        raise DataFileError(source.path, f"the row has fewer than {width} columns.", short, code="row-length")

    def column(what: str) -> Array | None:
        place = places.get(what)
        if place is None or (place >= width and any(len(row) <= place for _, row in cells)):
            return None
        factor, offset = _conversion(source, what, units[place] if place < len(units) else "")
        return factor * np.array([_number(source, row[place], number) for number, row in cells]) + offset

    frequency, storage, loss = (column(what) for what in ("frequency", "storage modulus", "loss modulus"))
    assert frequency is not None  # its place is within the width
    assert storage is not None
    assert loss is not None
    kelvin = column("temperature")
    if kelvin is None:
        kelvin = np.full(len(cells), _reference(parameters))
    strain = column("strain amplitude")
    return RepTateColumns(
        parameters=parameters,
        is_master_curve=not names,
        lines=np.array([number for number, _ in cells], dtype=np.int64),
        angular_frequency=frequency,
        storage_modulus=storage,
        loss_modulus=loss,
        temperature=kelvin,
        strain_amplitude=strain if strain is None else np.where(strain >= 0.0, strain, np.nan),
        said_by=names[places["storage modulus"]] if names else "",
    )


def _reference(parameters: dict[str, str]) -> float:
    """Return T of the first line, K (the file's is in °C), NaN without it."""
    try:
        return float(parameters.get("T", "nan")) + CELSIUS_ZERO
    except ValueError:
        return float("nan")


def _header(body: list[tuple[int, str]]) -> tuple[list[str], list[str]]:
    """Return the names and units of the columns, none where the first row is one of numbers."""
    if not body or _is_number(body[0][1].split()[0]):
        return [], []
    rows = [re.split(r"\t", line) if "\t" in line else line.split() for _, line in body[:2]]
    names = [cell.strip() for cell in rows[0]]
    units = [] if len(rows) < 2 or _is_number(rows[1][0]) else [cell.strip().strip("[]()") for cell in rows[1]]
    return names, units


def _places(source: Source, names: list[str]) -> dict[str, int]:
    """Return the places of the columns; the first of several of one name counts."""
    if not names:
        return {"frequency": 0, "storage modulus": 1, "loss modulus": 2}
    places: dict[str, int] = {}
    for place, name in enumerate(names):
        what = quantity(heading(name).name)
        if what is not None:
            places.setdefault("frequency" if what == "angular frequency" else what, place)
    missing = [what for what in ("frequency", "storage modulus", "loss modulus") if what not in places]
    if missing:
        raise DataFileError(
            source.path,
            f"no column for {' or '.join(missing)}; this file has {', '.join(names)}.",
            code="missing-columns",
        )
    return places


def _conversion(source: Source, what: str, unit: str) -> tuple[float, float]:
    """Return factor and offset to SI; without units RepTate means rad/s, Pa, °C and per cent."""
    if what == "frequency":
        factor = to_rad_per_second(unit or "rad/s", angular=False)
        if factor is None:
            raise DataFileError(
                source.path, f"the unit {unit!r} of the frequency must be 'rad/s' or 'Hz'.", code="wrong-unit"
            )
        return factor, 0.0
    if what == "strain amplitude":
        return (1.0 if unit in ("-", "1") else 0.01), 0.0
    if what == "temperature":
        return 1.0, 0.0 if unit == "K" else CELSIUS_ZERO
    try:
        return unit_conversion(unit or "Pa", "Pa")
    except ValueError:
        raise DataFileError(
            source.path, f"the unit {unit!r} of the {what} must be one like 'Pa'.", code="wrong-unit"
        ) from None


def _number(source: Source, cell: str, line: int) -> float:
    if not _is_number(cell) or not np.isfinite(float(cell)):
        raise DataFileError(source.path, f"{cell[:40]!r} is not a finite number.", line, code="not-a-number")
    return float(cell)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell
