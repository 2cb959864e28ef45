"""Files, and their temperatures, as users name them to readers of mechanical tests."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import cast

import numpy as np

from viscofric.errors import DataFileError, InputError, wrong_argument
from viscofric.files import read_bytes
from viscofric.notes import Remedy
from viscofric.readers.headings import Vocabulary
from viscofric.readers.source import Source, Test, checked_sheet
from viscofric.units import Quantity, kelvin_hint, positive, shown_celsius

#: What to do with a folder, where files make one set.
_ITS_FILES = Remedy("*sorted(Path(folder).glob('*')).", "FOLDER/*.csv.", '["a.csv", "b.csv"].')


def files_of(paths: Sequence[str | PathLike[str] | Sequence[str | PathLike[str]]], reader: str) -> list[str]:
    """Return the names of files given one by one or as lists."""
    files: list[str] = []
    for path in paths:
        # names of columns are what iterates over a table in memory
        if isinstance(path, Iterable) and not isinstance(path, (str, Mapping)) and getattr(path, "ndim", 1) == 1:
            names: list[object] = list(path)
        else:
            names = [path]
        wrong = [one for one in names if not isinstance(one, (str, PathLike))]
        if wrong:
            raise InputError(
                f"{reader} needs the name of a file or a list of names, got {type(wrong[0]).__name__}; write data in "
                "memory to a file (CSV).",
                code="not-a-name",
            )
        files += map(str, names)
    if not files:
        raise InputError(f"{reader} needs at least one file.", code="no-files")
    return files


def temperatures_of(given: Quantity | Sequence[Quantity | None] | None, count: int) -> list[float | None]:
    """Return one temperature, K, or None per file."""
    if not isinstance(given, (list, tuple, np.ndarray)) or getattr(given, "ndim", 1) == 0:
        return [None if given is None else _kelvin(cast("Quantity", given))] * count
    if len(given) != count:
        raise InputError(
            f"temperature holds {len(given)} values for {count} files; give one for all, or one for each.",
            code="wrong-count",
        )
    return [None if one is None else _kelvin(one) for one in given]


def _kelvin(value: Quantity) -> float:
    kelvin = positive(value, "K", "temperature")
    hint = kelvin_hint(kelvin) if isinstance(value, (int, float)) else ""
    if hint:
        raise wrong_argument(
            "temperature", value, f"is {shown_celsius(kelvin, 'z.4g')} °C{hint}.", "looks-like-celsius"
        )
    return kelvin


def bytes_of(path: str) -> bytes:
    """Return the content of a file, or raise `DataFileError`."""
    if "\0" not in path and Path(path).is_dir():
        raise DataFileError(
            path, "is a folder, not a data file; give its files, e.g. ", code="folder", remedy=_ITS_FILES
        )
    return read_bytes(path)


def sources_of(
    paths: Sequence[str | PathLike[str] | Sequence[str | PathLike[str]]],
    reader: str,
    vocabulary: Vocabulary,
    temperature: Quantity | Sequence[Quantity | None] | None,
    unit: str | None,
    columns: Mapping[str, str] | None,
    sheet: str | None,
    test: Test = "frequency",
) -> list[Source]:
    """Return the content of files given one by one or as lists, with what the user says of them; no file twice."""
    files = files_of(paths, reader)
    given = temperatures_of(temperature, len(files))
    named, one_sheet = vocabulary.checked(columns), checked_sheet(sheet)
    sources = [
        Source(path, bytes_of(path), kelvin, unit or "", named, one_sheet, test)
        for path, kelvin in zip(files, given, strict=True)
    ]
    _insist_on_different(sources)
    return sources


def _insist_on_different(sources: Sequence[Source]) -> None:
    """Refuse files that would count twice."""
    seen: dict[object, Source] = {}
    for source in sources:
        for key, problem in (
            (Path(source.path).resolve(), "is given twice; name each file once."),
            (source.data, "has the same content as {}; give only one of them."),
        ):
            if key in seen:
                raise DataFileError(source.path, problem.format(seen[key].path), code="given-twice")
            seen[key] = source
