"""The files that a study names: kept within the page's own, and brought there from beside a run file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path, PureWindowsPath
from typing import Any, NamedTuple

from viscofric.errors import DataFileError
from viscofric.files import parse_toml
from viscofric.web.jobs.context import JobError


class Named(NamedTuple):
    """Where a study names files."""

    table: dict[str, Any]
    key: str  # of the table
    place: str  # path in the study
    names: list[str]


def named_files(document: dict[str, Any]) -> Iterator[Named]:
    """Yield each place of a study that names files; what has another shape than it should is left out."""
    from viscofric.study.run_file.study import TABLES

    for name, kind in TABLES.items():
        several = document.get(name)
        for number, table in enumerate(several if isinstance(several, list) else [several]):
            if not isinstance(table, dict):
                continue
            place = f"{name}[{number}]" if isinstance(several, list) else name
            for key in getattr(kind, "FILES", ()):
                value = table.get(key)
                names = [one for one in (value if isinstance(value, list) else [value]) if isinstance(one, str)]
                if names:
                    yield Named(table, key, f"{place}.{key}", names)


def check_confined(document: dict[str, Any]) -> None:
    """Raise `JobError` if a study names other files than the page's own."""
    for named in named_files(document):
        for name in named.names:
            # a backslash or a drive leads elsewhere under Windows
            if name != Path(name).name or name != PureWindowsPath(name).name or name == ".." or "**" in name:
                raise JobError(
                    f"{named.place}: '{name[:200]}' is no file of the page; upload it, and give its name alone.",
                    named.place,
                    code="file-not-here",
                )


def opened_study(path: Path) -> tuple[dict[str, Any], dict[str, Path]]:
    """Read a run file for the page to open with; return its tables and the file of each plain name in them."""
    from viscofric.study.run_file.study import parse_study, read_study_text
    from viscofric.study.run_file.tables import files_of

    text = read_study_text(path)
    study = parse_study(text, path)
    for one in study.inputs:
        if not one.is_file():
            raise DataFileError(one, "no such file.", code="no-file")
    document = parse_toml(text)
    files: dict[str, Path] = {}
    for named in named_files(document):
        found = [file for name in named.names for file in files_of(path.parent, Path(name))]
        names = [_free_name(file, files) for file in found]
        named.table[named.key] = names if isinstance(named.table[named.key], list) or len(names) > 1 else names[0]
    return document, files


def _free_name(file: Path, taken: dict[str, Path]) -> str:
    """Enter a file under its own name, or one like it if another file has that already."""
    file = file.resolve()
    name, number = file.name, 1
    while taken.setdefault(name, file) != file:
        number += 1
        name = f"{file.stem}-{number}{file.suffix}"
    return name
