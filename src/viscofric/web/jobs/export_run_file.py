"""The page's document as a run file: its text, all that is wrong with it, and how much it asks for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ConfigDict

from viscofric.errors import ViscofricError
from viscofric.web.study_text import DocumentError, study_of, study_text

if TYPE_CHECKING:
    from viscofric.web.jobs.context import Context


class Options(BaseModel):
    """There are none."""

    model_config = ConfigDict(extra="forbid")


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Write and check a run file.

    Parameters
    ----------
    study : dict
        The page's document.
    options : Options
    context : Context

    Returns
    -------
    dict
        ``text`` of the run file, ``problems`` (a list of ``field`` and ``message``), ``cases`` that it asks for and
        ``files`` that it names; the last two are None where there are problems.
    """
    try:
        text, checked = study_of(study, context.files)
        cases = len(checked.sweep().cases)
    except DocumentError as error:
        problems = [{"field": one.field, "message": one.message} for one in error.problems]
        return {"text": _text_of(study), "problems": problems, "cases": None, "files": None}
    except ViscofricError as error:
        problems = [{"field": "", "message": str(error)}]
        return {"text": _text_of(study), "problems": problems, "cases": None, "files": None}
    missing = [path.name for path in checked.inputs if not path.is_file()]
    problems = [
        {"field": _place_of(study, name), "message": f"The file {name} is not here; upload it."} for name in missing
    ]
    return {"text": text, "problems": problems, "cases": cases, "files": [path.name for path in checked.inputs]}


def _text_of(study: dict[str, Any]) -> str:
    """Return what is wrong as text, too, so that it can be looked at."""
    try:
        return study_text(study)
    except DocumentError:
        return ""


def _place_of(study: dict[str, Any], name: str) -> str:
    """Return the path in the document where a file is named."""
    for table in ("material", "surface", "measurement"):
        entries = study.get(table)
        for key, value in entries.items() if isinstance(entries, dict) else ():
            if value == name or (isinstance(value, list) and name in value):
                return f"{table}.{key}"
    return ""
