"""Text files of RepTate: one line of parameters, then names and units, then numbers in columns.

A sweep (.osc) names its columns and has one temperature; a master curve (.tts) is columns alone, in rad/s and Pa.
Creep and relaxation files (.creep, .gt) have time, strain and stress.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from viscofric.errors import DataFileError
from viscofric.readers.dma.names import DMA
from viscofric.readers.dma.readings import AS_MASTER_CURVE, Readings
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.header_rows import is_number
from viscofric.readers.headings import heading
from viscofric.readers.source import Source, converted
from viscofric.readers.table import Table, instrument_table

NAME = "RepTate text (.osc, .tts)"
#: Lines that show whether columns have names.
_HEAD = 20
_MODULI = ("storage modulus", "loss modulus")
_UNNAMED = ("reduced angular frequency", "G'", "G''")
_PARAMETERS = re.compile(r"\s*(?:[\w ]+=[^;=]*;)+(?:[\w ]+=[^;=]*)?\s*")


def recognises(source: Source) -> bool:
    """Return whether the first line is one of parameters that name a temperature or a molar mass."""
    if source.text is None:
        return False
    first, *below = [line for line in source.text[:4000].splitlines() if line.strip()][:_HEAD] or [""]
    if not _PARAMETERS.fullmatch(first):
        return False
    columns = [line.split() for line in below if not line.lstrip().startswith("#")]
    without_names = bool(columns) and len(columns[0]) > 2 and all(map(is_number, columns[0][:3]))
    return without_names or bool({"T", "Mw"} & set(_parameters(first)))


def parameters_of(line: str) -> dict[str, str]:
    """Return the parameters of a first line such as ``T=-35;Mw=2.4;``, none if it is no such line."""
    return _parameters(line) if _PARAMETERS.fullmatch(line[:2000]) else {}


def _parameters(line: str) -> dict[str, str]:
    parts = (part.partition("=") for part in line.strip().split(";") if "=" in part)
    return {name.strip(): value.strip() for name, _, value in parts}


def read(source: Source) -> Readings:
    """Return the points of one sweep (.osc); a master curve is an error, see `read_master_curve`."""
    table, parameters = table_of(source)
    if table.has("reduced frequency"):
        problem = f"is a master curve of RepTate at {parameters.get('T', '25')} °C"
        raise DataFileError(source.path, problem, code="master-curve", remedy=AS_MASTER_CURVE)
    return read_points(table, source, NAME, "")


def table_of(source: Source) -> tuple[Table, dict[str, str]]:
    """Return the table of a sweep, or of a master curve, whose frequencies are reduced; and the parameters."""
    lines = enumerate((source.text or "").splitlines(), start=1)
    numbered = [(n, line) for n, line in lines if line.strip() and not line.lstrip().startswith("#")]
    parameters = _parameters(numbered[0][1])
    body = numbered[1:]
    names, units = _header(body)
    rows = [(number, line.split()) for number, line in body[bool(names) + bool(units) :]]
    if not rows:
        raise DataFileError(source.path, "there is no row of numbers under the line of parameters.", code="no-points")
    places = _places(source, names)
    width = max(places[what] for what in ("frequency", *_MODULI)) + 1
    short = next((number for number, cells in rows if len(cells) < width), None)
    if short is not None:
        raise DataFileError(source.path, f"the row has fewer than {width} columns.", short, code="row-length")
    places = {what: place for what, place in places.items() if all(len(cells) > place for _, cells in rows)}
    columns = [
        (
            heading(names[place]).name if names else _UNNAMED[place],
            _unit(what, units[place] if place < len(units) else ""),
            what if names or what != "frequency" else "reduced frequency",
        )
        for what, place in places.items()
    ]
    cells = [(number, [row[place] for place in places.values()]) for number, row in rows]
    held = parameters.get("T", "")
    if names and "temperature" not in places and is_number(held):
        columns.append(("T", "degC", "temperature"))
        cells = [(number, [*row, held]) for number, row in cells]
    return instrument_table(source.path, columns, cells, DMA), parameters


def temperature_of(parameters: dict[str, str]) -> float:
    """Return T of the first line, K (the file's is in °C), NaN without it."""
    return converted(parameters.get("T", ""), "degC", "K") or float("nan")


def _header(body: list[tuple[int, str]]) -> tuple[list[str], list[str]]:
    """Return the names and units of the columns, none where the first row is one of numbers."""
    if not body or is_number(body[0][1].split()[0]):
        return [], []
    rows = [re.split(r"\t", line) if "\t" in line else line.split() for _, line in body[:2]]
    names = [cell.strip() for cell in rows[0]]
    units = [] if len(rows) < 2 or is_number(rows[1][0]) else [cell.strip().strip("[]()") for cell in rows[1]]
    return names, units


def _places(source: Source, names: list[str]) -> dict[str, int]:
    """Return the places of the columns; the first of several of one name counts."""
    if not names:
        return {"frequency": 0, "storage modulus": 1, "loss modulus": 2}
    places: dict[str, int] = {}
    for place, name in enumerate(names):
        if what := DMA.quantity(heading(name).name):
            places.setdefault("frequency" if what == "angular frequency" else what, place)
    missing = [what for what in ("frequency", *_MODULI) if what not in places]
    if missing:
        problem = f"no column for {' or '.join(missing)}; this file has {', '.join(names)}."
        raise DataFileError(source.path, problem, code="missing-columns")
    return places


def _unit(what: str, unit: str) -> str:
    """Return the unit of a column; without any, RepTate means rad/s, Pa, °C and per cent."""
    if what == "strain amplitude":
        return "1" if unit in ("-", "1") else "%"
    if what == "temperature":
        return "K" if unit == "K" else "degC"
    return unit or ("rad/s" if what == "frequency" else "Pa")


#: RepTate's names of columns -> heading with the unit that it means; its tests are in shear.
_HEADINGS = {"t": "t (s)", "strain": "shear strain (-)", "stress": "shear stress (Pa)", "sxy": "shear stress (Pa)"}
_HEADINGS |= {"T": "T (degC)", "Temp": "T (degC)"}


def with_units(source: Source) -> Source:
    """Return such a file as a table with a unit in every heading, any other file as it is."""
    # The strain of a relaxation test (``gamma``, 1 if it is not given) and the temperature (``T``) are taken from the
    # parameters where there are no columns for them.
    lines = (source.text or "").splitlines()
    parameters = parameters_of(lines[0]) if lines else {}
    names = lines[1].split() if len(lines) > 1 else []
    if not parameters or names[:1] != ["t"] or not {"sxy", "strain"} & set(names):
        return source
    headings = [_HEADINGS.get(name, name) for name in names]
    strain = [] if "strain" in names else [parameters.get("gamma", "1")]
    stress = [] if {"stress", "sxy"} & set(names) else [parameters.get("stress", "")]
    kelvin = source.temperature
    if kelvin is None and not {"T", "Temp"} & set(names):
        kelvin = None if np.isnan(found := temperature_of(parameters)) else found
    more = [_HEADINGS["strain"]] * len(strain) + [_HEADINGS["stress"]] * len(stress)
    text = ["# " + lines[0], "\t".join([*headings, *more])]
    for line in lines[2:]:
        cells = line.split()
        numbers = bool(cells) and cells[0][:1] in "0123456789.+-"
        text.append("\t".join([*cells, *strain, *stress]) if numbers else "")  # a row of units is not needed
    return replace(source, data="\n".join(text).encode(), temperature=kelvin)
