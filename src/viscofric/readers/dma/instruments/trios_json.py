"""JSON exports of TA Instruments TRIOS (schema ``TRIOSJSONExportSchema``): original or processed results of all steps.

No genuine frequency sweep was available: the reader was tested on the vendor's sample of a strain sweep and on files
written after it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from viscofric.errors import DataFileError
from viscofric.files import parse_json
from viscofric.notes import Note
from viscofric.readers.dma.instruments.ta_steps import StepText, readings_of, steps_of
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import Source

NAME = "TA Instruments TRIOS JSON"

#: Sections of the results, in the order in which they are preferred: as measured first.
_SECTIONS = ("Original", "Raw", "Processed")
_STEP_ID = "Results Step Id"
_NAMELESS = "(without a name)"
_HEAD = 20000  # characters that show the layout
#: Names of the classification of unmodified results.
_AS_MEASURED = frozenset({"Unmodified", ""})


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
        problem = f"has no results under any of {', '.join(_SECTIONS)}; export the file with results."
        raise DataFileError(source.path, problem, code="no-points")
    section = held[name]
    steps = steps_of(source.path, _steps(section), where=f"{name.lower()} results, row")
    return readings_of(source, NAME, steps, list(_geometry(document)), _notes(name, section))


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


def _steps(section: Mapping[str, Any]) -> list[StepText]:
    """Return the rows by their step, in the order of the list of steps; headers and rows are held by key."""
    headers = {key: header for key, header in section["ColumnHeaders"].items() if isinstance(header, dict)}
    listed, named = (held if isinstance(held := section.get(key), list) else [] for key in ("Rows", "ResultsSteps"))
    names = {str(one.get("Id")): str(one.get("Name", "")) for one in named if isinstance(one, dict)}
    headings = [str(header.get("DisplayName", key)) for key, header in headers.items()]
    units = [str(_part(header, "Unit").get("Name") or "") for header in headers.values()]
    steps = {one: StepText(name or _NAMELESS, headings, units) for one, name in names.items()}
    for number, row in enumerate((row for row in listed if isinstance(row, dict)), start=1):
        step = steps.setdefault(str(row.get(_STEP_ID)), StepText(_NAMELESS, headings, units))
        step.rows.append((number, [_number(row.get(key)) for key in headers]))
    return list(steps.values())


def _number(cell: object) -> str:
    """Return a number as an export would print it, empty for what is none."""
    try:
        return repr(float(cell)) if isinstance(cell, (int, float)) and not isinstance(cell, bool) else ""
    except OverflowError:
        return ""


def _geometry(document: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Return labels and values that name the sample holder."""
    listed = _part(_part(document, "Procedure"), "Configuration").get("InstrumentConfigurations")
    for instrument in listed if isinstance(listed, list) else []:
        for part in ("Geometry", "Clamp"):
            for key in ("Type", "Name"):
                value = _part(instrument, part).get(key)
                if isinstance(value, str):
                    yield f"{part} {key}", value
