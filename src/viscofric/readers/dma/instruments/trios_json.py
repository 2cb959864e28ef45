"""JSON exports of TA Instruments TRIOS (schema ``TRIOSJSONExportSchema``): original or processed results of all steps.

No genuine frequency sweep was available: the reader was tested on the vendor's sample of a strain sweep and on files
written after it.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscofric.errors import DataFileError
from viscofric.files import parse_json
from viscofric.notes import Note
from viscofric.readers.dma.instruments.ta_steps import Signal, Step, roles
from viscofric.readers.dma.instruments.ta_sweeps import readings_of
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import Source

NAME = "TA Instruments TRIOS JSON"

#: Sections of the results, in the order in which they are preferred: as measured first.
_SECTIONS = ("Original", "Raw", "Processed")
_STEP_ID = "Results Step Id"
_HEAD = 20000  # characters that show the layout
#: Names of the classification of unmodified results.
_AS_MEASURED = frozenset({"Unmodified", ""})


@dataclass(frozen=True)
class _Results:
    """One section of the results: names and units of the columns, cells by column, and the name of each row's step."""

    headings: list[str]
    units: list[str]
    columns: list[Sequence[Any]]
    step_ids: list[str]
    step_names: dict[str, str]


def recognises(source: Source) -> bool:
    """Return whether the file is JSON that names the vendor's schema or has its results."""
    text = source.text or ""
    if not text[:_HEAD].lstrip().startswith("{"):
        return False
    return "TRIOSJSONExportSchema" in text[:_HEAD] or ('"ResultsSteps"' in text and '"ColumnHeaders"' in text)


def read(source: Source) -> Readings:
    """Return the points of all frequency sweeps, or raise `DataFileError`, which names what the file holds instead."""
    try:
        document = parse_json(source.text or "")
    except json.JSONDecodeError as error:
        problem = f"is incomplete JSON ({error.msg}); the file may have been cut short."
        raise DataFileError(source.path, problem, error.lineno, code="damaged") from None
    except ValueError as error:  # nested too deeply, or with numbers of thousands of digits
        raise DataFileError(source.path, f"is not JSON of an instrument ({error}).", code="damaged") from None
    held = _part(document, "Results")
    name = next((one for one in _SECTIONS if _part(_part(held, one), "ColumnHeaders")), None)
    if name is None:
        raise DataFileError(
            source.path,
            f"has no results under any of {', '.join(_SECTIONS)}; export the file with results.",
            code="no-points",
        )
    section = held[name]
    steps = _steps(_results(section), f"{name.lower()} results")
    return readings_of(source, NAME, steps, _geometry(document), _notes(name, section))


def _part(parent: Any, key: str) -> Any:
    """Return a part that is itself an object, else an empty one."""
    part = parent.get(key) if isinstance(parent, dict) else None
    return part if isinstance(part, dict) else {}


def _notes(name: str, section: Mapping[str, Any]) -> list[str]:
    classification = _part(section, "Classification")
    if name == "Processed":
        return [
            Note("processed-results", "The file holds processed results only, which may not be as they were measured.")
        ]
    if str(classification.get("Id") or "") in _AS_MEASURED:
        return []
    return [
        Note(
            "processed-results",
            f"The results may not be as they were measured: {str(classification.get('Description', ''))!r}.",
            values={"description": str(classification.get("Description", ""))},
        )
    ]


def _results(section: Mapping[str, Any]) -> _Results:
    """Return headers and rows, which the file holds by key, and the names of the steps by their id."""
    headers = {key: header for key, header in section["ColumnHeaders"].items() if isinstance(header, dict)}
    listed = section.get("Rows")
    rows = [row for row in listed if isinstance(row, dict)] if isinstance(listed, list) else []
    steps = section.get("ResultsSteps")
    names = {
        str(step.get("Id")): str(step.get("Name", ""))
        for step in (steps if isinstance(steps, list) else [])
        if isinstance(step, dict)
    }
    return _Results(
        [str(header.get("DisplayName", key)) for key, header in headers.items()],
        [str(_part(header, "Unit").get("Name") or "") for header in headers.values()],
        [[row.get(key) for row in rows] for key in headers],
        [str(row.get(_STEP_ID)) for row in rows],
        names,
    )


def _steps(results: _Results, where: str) -> list[Step]:
    """Part the rows by their step, in the order of the list of steps."""
    places = roles(results.headings)
    values = {role: np.array([_number(cell) for cell in results.columns[place]]) for role, place in places.items()}
    order = list(dict.fromkeys([*results.step_names, *results.step_ids]))
    rows_of: dict[str, list[int]] = {one: [] for one in order}
    for row, one in enumerate(results.step_ids):
        rows_of[one].append(row)
    steps = []
    for one, rows in rows_of.items():
        signals = {
            role: Signal(results.headings[place], results.units[place], values[role][rows])
            for role, place in places.items()
            if np.any(np.isfinite(values[role][rows]))  # the headers are those of all steps together
        }
        name = results.step_names.get(one) or "(without a name)"
        steps.append(Step(name, signals, tuple(f"row {row + 1} of the {where}" for row in rows)))
    return steps


def _number(cell: object) -> float:
    """Return a finite number, or NaN."""
    try:
        number = float(cell) if isinstance(cell, (int, float)) and not isinstance(cell, bool) else math.nan
    except OverflowError:
        return math.nan
    return number if math.isfinite(number) else math.nan


def _geometry(document: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Return labels and values that name the sample holder."""
    listed = _part(_part(document, "Procedure"), "Configuration").get("InstrumentConfigurations")
    for instrument in listed if isinstance(listed, list) else []:
        for part in ("Geometry", "Clamp"):
            for key in ("Type", "Name"):
                value = _part(instrument, part).get(key)
                if isinstance(value, str):
                    yield f"{part} {key}", value
