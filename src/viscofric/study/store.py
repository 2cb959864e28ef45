"""Finished cases on disk, one small file each: an interrupted study takes up where it stopped."""

from __future__ import annotations

import functools
import hashlib
import json
import math
from dataclasses import dataclass, fields
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

from viscofric.files import write_atomically
from viscofric.friction.sensitivity import ComplianceSensitivity

if TYPE_CHECKING:
    from collections.abc import Iterator
    from importlib.resources.abc import Traversable
    from pathlib import Path

    from viscofric.contact.solution import ContactSolution


@dataclass(frozen=True)
class CaseRecord:
    """The numbers of one solved contact, all SI; see `ContactSolution` and `Diagnostics`.

    `sensitivity` tells how friction answers to the rubber's compliance, where bands are wanted.
    """

    speed: float
    temperature: float
    load: float
    friction_coefficient: float
    friction_error: float
    indentation: float
    contact_area: float
    front: float
    rear: float
    half_width: float
    max_pressure: float
    energy_balance: float
    complementarity: float
    cells: int
    products: int
    warnings: tuple[str, ...]
    sensitivity: ComplianceSensitivity | None = None

    @classmethod
    def of(
        cls, solution: ContactSolution, temperature: float, sensitivity: ComplianceSensitivity | None = None
    ) -> CaseRecord:
        """Take the numbers out of a solution."""
        diagnostics = solution.diagnostics
        return cls(
            speed=solution.speed,
            temperature=temperature,
            load=solution.load,
            friction_coefficient=solution.friction_coefficient,
            friction_error=diagnostics.friction_error,
            indentation=solution.indentation,
            contact_area=solution.contact_area,
            front=solution.front,
            rear=solution.rear,
            half_width=solution.half_width,
            max_pressure=solution.max_pressure,
            energy_balance=diagnostics.energy,
            complementarity=diagnostics.complementarity,
            cells=max(diagnostics.shape),
            products=diagnostics.products,
            warnings=solution.warnings,
            sensitivity=sensitivity,
        )

    @classmethod
    def from_json(cls, text: str) -> CaseRecord:
        """Read what `to_json` wrote.

        Raises
        ------
        ValueError, TypeError, KeyError
            If it is something else.
        """
        values = json.loads(text)
        sensitivity = values["sensitivity"]
        if sensitivity is not None:
            columns = {name: np.array(sensitivity[name], dtype=float) for name in _COLUMNS}
            sensitivity = ComplianceSensitivity(**{**sensitivity, **columns})
        record = cls(**{**values, "warnings": tuple(values["warnings"]), "sensitivity": sensitivity})
        if not all(isinstance(text, str) for text in record.warnings):
            raise TypeError("warnings are no texts.")
        if not all(_is_number(getattr(record, name)) for name in NUMBERS) or not _is_sound(sensitivity):
            raise ValueError("a number is none.")
        return record

    def to_json(self) -> str:
        """Write the record down, to the last digit."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        if self.sensitivity is not None:
            told = {field.name: getattr(self.sensitivity, field.name) for field in fields(self.sensitivity)}
            values["sensitivity"] = told | {name: told[name].tolist() for name in _COLUMNS}
        return json.dumps(values)


def case_key(description: dict[str, object]) -> str:
    """Return a name for a case that changes with anything that could change its answer."""
    text = json.dumps({"solver": _solver_fingerprint(), **description}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@functools.cache
def _solver_fingerprint() -> str:
    """Return what changes with any line of the solver, so that cases of an older one are not taken for new."""
    digest = hashlib.sha256()
    for name, source in _sources(files("viscofric.contact")):
        digest.update(name.encode() + b"\0" + source)
    digest.update((files("viscofric.friction") / "sensitivity.py").read_bytes())
    return digest.hexdigest()


def _sources(folder: Traversable, path: str = "") -> Iterator[tuple[str, bytes]]:
    """Yield names and texts of the Python files in a folder of a package and in those below it."""
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        name = f"{path}/{entry.name}"
        if entry.is_dir():
            yield from _sources(entry, name)
        elif entry.name.endswith(".py"):
            yield name, entry.read_bytes()


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


NUMBERS = tuple(field.name for field in fields(CaseRecord) if field.name not in ("warnings", "sensitivity"))
# Arrays of a sensitivity.
_COLUMNS = ("log_tau", "slope")


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _is_sound(sensitivity: ComplianceSensitivity | None) -> bool:
    """Whether all numbers of a sensitivity are finite, and its columns belong together."""
    if sensitivity is None:
        return True
    single = [field.name for field in fields(sensitivity) if field.name not in _COLUMNS]
    columns = [getattr(sensitivity, name) for name in _COLUMNS]
    return all(_is_number(getattr(sensitivity, name)) for name in single) and all(
        column.ndim == 1 and column.size > 1 and column.size == columns[0].size and np.all(np.isfinite(column))
        for column in columns
    )
