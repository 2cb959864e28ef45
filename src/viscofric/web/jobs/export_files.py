"""What is taken away: a study's folder with its data, and archives of files."""

from __future__ import annotations

import io
import shutil
import zipfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from viscofric.errors import DataFileError, not_written
from viscofric.files import write_atomically
from viscofric.study.run_file.study import Study
from viscofric.web.study_text import RUN_FILE

_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date of an archive: the same files give the same bytes


def missing_files(study: Study) -> list[str]:
    """Return the names of data files that a study names and that are not there."""
    return [path.name for path in study.inputs if not path.is_file()]


def lay_out(text: str, study: Study, folder: Path) -> Path:
    """Put a run file and copies of its data files alone into a folder; return the run file's path."""
    if missing := missing_files(study):
        raise DataFileError(missing[0], "is not one of the page's files; drop it on the page first.", code="no-file")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.iterdir():
            if old.is_file():
                old.unlink()
        for path in study.inputs:
            shutil.copyfile(path, folder / path.name)
        (folder / RUN_FILE).write_text(text, encoding="utf-8")
    except OSError as error:
        raise not_written(folder.name, error) from None
    return folder / RUN_FILE


def archive(target: Path, files: Iterable[tuple[str, Path | str]]) -> Path:
    """Write and return a zip archive of files, or texts, by their names in it."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in files:
            data = content.encode() if isinstance(content, str) else content.read_bytes()
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            packed.writestr(entry, data)
    write_atomically(target, buffer.getvalue())
    return target


def offered(path: Path, title: str) -> dict[str, Any]:
    """Return a file as the page offers it: ``name``, ``title`` and ``size`` (bytes)."""
    return {"name": path.name, "title": title, "size": path.stat().st_size}
