"""Finished cases on disk, one small file each: an interrupted study takes up where it stopped."""

from __future__ import annotations

import io
import json
import zipfile
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.files import write_atomically
from viscofric.study.record import ContactFields, Failure, Record
from viscofric.study.surface_record import read_record

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_DAMAGED = (OSError, ValueError, TypeError, KeyError, EOFError, zipfile.BadZipFile)


@dataclass(frozen=True)
class CaseStore:
    """A folder of finished cases: ``KEY.json`` for each, and ``KEY.npz`` where its fields are kept.

    Parameters
    ----------
    folder : Path
        Made when the first case is put into it.
    """

    folder: Path

    def get(self, key: str, with_fields: bool = False) -> Record | Failure | None:
        """Return what became of a case; None if it is not known (or its file was damaged, by a crash or otherwise).

        Parameters
        ----------
        key : str
        with_fields : bool
            Whether a record without its fields counts as none.
        """
        try:
            text = self._path(key).read_text(encoding="utf-8")
            failure = _failure(text)
            if failure is not None:
                return failure
            record = read_record(text)
            return replace(record, fields=self._fields(key)) if with_fields else record
        except _DAMAGED:
            return None

    def prepare(self) -> None:
        """Make the folder and see that it can be written, before time is spent on solving.

        Raises
        ------
        DataFileError
            If it cannot.
        """
        probe = self.folder / ".writable"
        write_atomically(probe, b"")
        probe.unlink(missing_ok=True)

    def sweep(self) -> None:
        """Remove what a run that was killed had begun to write; for who has the folder for themselves."""
        for path in self.folder.glob(".*"):
            path.unlink(missing_ok=True)

    def put(self, key: str, outcome: Record | Failure) -> None:
        """Store what became of a case; it is either there whole or not at all.

        Raises
        ------
        DataFileError
            If it cannot be written: the disk is full, the folder read-only …
        """
        if isinstance(outcome, Failure):
            text = json.dumps({"failed": outcome.reason, "label": outcome.label}, ensure_ascii=False)
        else:
            text = outcome.to_json()
            if outcome.fields is not None:
                # First, so that a case whose numbers are there has its fields as well.
                packed = io.BytesIO()
                np.savez_compressed(packed, **outcome.fields._asdict())
                write_atomically(self._path(key, "npz"), packed.getvalue())
        write_atomically(self._path(key), text.encode())

    def stored(self) -> Iterator[str]:
        """Yield the keys of all cases in the folder, damaged ones too, in no order."""
        return (path.stem for path in self.folder.glob("*.json") if not path.name.startswith("."))

    def _fields(self, key: str) -> ContactFields:
        packed = io.BytesIO(self._path(key, "npz").read_bytes())  # a file would stay open where it is damaged
        with np.load(packed, allow_pickle=False) as stored:
            found = ContactFields(**{name: stored[name] for name in ContactFields._fields})
        x, y, *fields = found
        if not all(field.shape == (*x.shape, *y.shape) and np.all(np.isfinite(field)) for field in fields):
            raise ValueError("fields do not fit their grid.")
        return found

    def _path(self, key: str, kind: str = "json") -> Path:
        return self.folder / f"{key}.{kind}"


def _failure(text: str) -> Failure | None:
    """Return the failure that a file tells of, if it does."""
    values = json.loads(text)
    if not isinstance(values, dict):
        raise TypeError("no case.")
    reason, label = values.get("failed"), values.get("label")
    return Failure(reason, label) if isinstance(reason, str) and isinstance(label, str) else None
