"""Finished cases on disk, one small file each: an interrupted study takes up where it stopped."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.files import write_atomically
from viscofric.study.record import CaseRecord

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True)
class CaseStore:
    """A folder of finished cases.

    Parameters
    ----------
    folder : Path
        Made when the first case is put into it.
    """

    folder: Path

    def get(self, key: str) -> CaseRecord | None:
        """Return a finished case, or None if there is none (or its file was damaged, by a crash or otherwise)."""
        try:
            return CaseRecord.from_json(self._path(key).read_text(encoding="utf-8"))
        except (OSError, ValueError, TypeError, KeyError):
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

    def put(self, key: str, record: CaseRecord) -> None:
        """Store a finished case; it is either there whole or not at all."""
        write_atomically(self._path(key), record.to_json().encode())

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.json"
