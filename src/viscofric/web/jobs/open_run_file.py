"""A run file that the user brings, as the page's document: its tables, in which files have plain names."""

from __future__ import annotations

import io
import zipfile
import zlib
from fnmatch import fnmatchcase
from pathlib import Path, PureWindowsPath
from typing import Any

from pydantic import Field

from viscofric.datasets import plain
from viscofric.errors import DataFileError, StudyError
from viscofric.files import parse_toml, read_bytes
from viscofric.study.run_file.study import LONGEST_RUN_FILE, parse_study
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.study_files import named_files
from viscofric.web.study_text import RUN_FILE
from viscofric.web.workspace import LARGEST_UPLOAD, Workspace, checked_name


class Options(JobOptions):
    """What is opened."""

    text: str = Field("", max_length=LONGEST_RUN_FILE)  # of a run file
    #: Name of an uploaded zip file instead, of a run file with its data files, as the page packs it
    archive: str = Field("", max_length=1_000)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Read a run file; what is wrong with its values is left for the page to show beside its fields."""
    text, files = _unpacked(options.archive, context) if options.archive else (options.text, [])
    text = text.removeprefix("\ufeff")
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
        return {"study": plain(document, digits=None), "missing": missing, "files": files}
    except RecursionError:
        raise StudyError(
            f"{RUN_FILE}: lists or tables lie within each other too deeply for a run file.", code="too-deep"
        ) from None


def _unpacked(name: str, context: Context) -> tuple[str, list[str]]:
    """Put an archive's data files among the page's own, in its place; return the run file's text and their names."""
    path = context.files / checked_name(name)
    workspace = Workspace(context.files.parent)  # its limits hold here, too
    text, files = None, []
    try:
        packed = zipfile.ZipFile(io.BytesIO(read_bytes(path)))
        path.unlink()
        for entry in packed.infolist():
            plain_name = PureWindowsPath(entry.filename).name  # folders stay behind
            if entry.is_dir():
                continue
            with packed.open(entry) as stream:
                content = stream.read(LARGEST_UPLOAD + 1)  # whatever size it states
            if plain_name.lower().endswith(".toml"):
                text = content[: 4 * LONGEST_RUN_FILE].decode()
            else:
                files.append(checked_name(plain_name))
                workspace.store(files[-1], content)
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, UnicodeDecodeError):
        problem = "is damaged, encrypted, or no zip file; unpack it, and drop the run file with its data files."
        raise DataFileError(name, problem, code="damaged") from None
    if text is None:
        raise DataFileError(name, "contains no run file, whose name ends with .toml.", code="no-run-file")
    return text, files


def _is_there(name: str, folder: Path) -> bool:
    """Whether a name, or a pattern, stands for any of the page's own files."""
    return any(name == one.name or fnmatchcase(one.name, name) for one in folder.iterdir())
