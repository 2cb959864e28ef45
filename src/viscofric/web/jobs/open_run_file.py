"""A run file that the user brings, as the page's document: its tables, in which files have plain names."""

from __future__ import annotations

from fnmatch import fnmatchcase
from pathlib import PureWindowsPath
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ConfigDict, Field

from viscofric.datasets import plain
from viscofric.errors import StudyError
from viscofric.files import parse_toml
from viscofric.study.run_file.study import LONGEST_RUN_FILE, parse_study
from viscofric.web.study_files import named_files
from viscofric.web.study_text import RUN_FILE

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.web.jobs.context import Context


class Options(BaseModel):
    """What is opened.

    Parameters
    ----------
    text : str
        Of a run file.
    """

    model_config = ConfigDict(extra="forbid")

    text: str = Field(max_length=LONGEST_RUN_FILE)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Read a run file; what is wrong with its values is left for the page to show beside its fields.

    Returns
    -------
    dict
        ``study``, its tables; ``missing``, names of data files that are not among the page's own.

    Raises
    ------
    StudyError
        If it is no TOML, or none that a run file can be.
    """
    text = options.text.removeprefix("\ufeff")
    try:
        document = parse_toml(text)
    except ValueError:
        parse_study(text, context.files / RUN_FILE)  # says in a sentence what is wrong, and where
        raise
    missing = []
    for named in named_files(document):
        # folders, of whichever system, stay behind
        names = [PureWindowsPath(name).name for name in named.names]
        named.table[named.key] = names if isinstance(named.table[named.key], list) else names[0]
        missing += [one for one in names if one not in missing and not _is_there(one, context.files)]
    try:
        return {"study": plain(document, digits=None), "missing": missing}
    except RecursionError:
        raise StudyError(
            f"{RUN_FILE}: lists or tables lie within each other too deeply for a run file.", code="too-deep"
        ) from None


def _is_there(name: str, folder: Path) -> bool:
    """Whether a name, or a pattern, stands for any of the page's own files."""
    return any(name == one.name or fnmatchcase(one.name, name) for one in folder.iterdir())
