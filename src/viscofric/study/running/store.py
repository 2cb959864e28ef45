"""Solved contacts on disk, one small file each, so that an interrupted study continues where it stopped."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from viscofric.datasets import plain
from viscofric.errors import DataFileError
from viscofric.files import LARGEST_FILE, insist_on_size, parse_json, read_bytes, write_atomically
from viscofric.friction.cases.record import ContactFields, Failure, Record
from viscofric.notes import note_of, records

_DAMAGED = (OSError, ValueError, TypeError, KeyError, EOFError, zipfile.BadZipFile)
# Text before the checksum of everything before it.
_SEAL = b', "sha256": "'


@dataclass(frozen=True)
class Damaged:
    """A stored contact that cannot be used."""

    reason: str  # what is wrong, without its name


@dataclass(frozen=True)
class CaseStore:
    """A folder of solved contacts, ``KEY.json`` and ``KEY.npz`` of kept fields, each with a checksum at its end."""

    folder: Path  # made with the first contact
    made: bool = False  # whether it exists already; if it is missing then, it was removed and is not made again

    def get(self, key: str, with_fields: bool = False) -> Record | Failure | Damaged | None:
        """Return the stored result of a contact, None if there is none (`with_fields`: with its fields)."""
        path = self._path(key)
        try:
            stored = read_bytes(path, LARGEST_FILE)
        except DataFileError as error:
            return Damaged(error.problem) if path.exists() else None
        if not _is_sealed(stored, key):
            return Damaged("does not match its checksum")
        try:
            values = parse_json(stored)
            if "failed" in values:
                return Failure(note_of(values["failed"]), values["label"], values.get("code", ""))
            record, fields = Record.from_values(values["case"]), values["fields"]
            if not with_fields:
                return record
            return None if fields is None else replace(record, fields=self._fields(key, fields))
        except _DAMAGED:
            return Damaged("does not hold a solved contact")

    def prepare(self) -> None:
        """Make the folder; raise `DataFileError` if it cannot be written."""
        probe = self.folder / ".writable"
        write_atomically(probe, b"")
        probe.unlink(missing_ok=True)

    def sweep(self) -> None:
        """Remove incomplete files of a killed run; the folder must be locked."""
        for path in self.folder.glob(".*"):
            path.unlink(missing_ok=True)

    def put(self, key: str, outcome: Record | Failure) -> None:
        """Store the result of a contact, whole or not at all; raise `DataFileError` if it cannot be written."""
        values: dict[str, object]
        if isinstance(outcome, Failure):
            (reason,) = plain(records([outcome.reason]), None)
            values = {"failed": reason, "label": outcome.label, "code": outcome.code}
        else:
            values = {"case": outcome.values(), "fields": None}
            if outcome.fields is not None:
                # First, so that a contact with numbers always has its fields.
                packed = io.BytesIO()
                np.savez_compressed(packed, **outcome.fields._asdict())
                values["fields"] = hashlib.sha256(packed.getvalue()).hexdigest()
                write_atomically(self._path(key, "npz"), packed.getvalue(), not self.made)
        write_atomically(self._path(key), _sealed(json.dumps(values), key), not self.made)

    def stored(self) -> Iterator[str]:
        """Yield the keys of all contacts in the folder, damaged ones too, in no order."""
        return (path.stem for path in self.folder.glob("*.json") if not path.name.startswith("."))

    def damaged(self) -> dict[str, Damaged]:
        """Read every contact with its fields, and return those that cannot be used, by key."""
        found = {}
        for key in sorted(self.stored()):
            outcome = self.get(key, with_fields=True)
            if isinstance(outcome, Damaged):
                found[key] = outcome
        return found

    def _fields(self, key: str, checksum: str) -> ContactFields:
        path = self._path(key, "npz")
        stored = read_bytes(path, LARGEST_FILE)
        if hashlib.sha256(stored).hexdigest() != checksum:
            raise ValueError("fields differ from the stored ones.")
        insist_on_size(stored, path)
        with np.load(io.BytesIO(stored), allow_pickle=False) as fields:
            return ContactFields(**{name: fields[name] for name in ContactFields._fields})

    def _path(self, key: str, kind: str = "json") -> Path:
        return self.folder / f"{key}.{kind}"


def _sealed(text: str, key: str) -> bytes:
    """Return the text of a JSON object with the checksum as its last entry."""
    body = text.encode().removesuffix(b"}")
    return body + _SEAL + _checksum(body, key).encode() + b'"}'


def _is_sealed(stored: bytes, key: str) -> bool:
    """Whether a file holds what was stored under its key."""
    body, seal, checksum = stored.rpartition(_SEAL)
    return bool(seal) and checksum == _checksum(body, key).encode() + b'"}'


def _checksum(body: bytes, key: str) -> str:
    return hashlib.sha256(key.encode() + b"\0" + body).hexdigest()
