"""Finished cases on disk, one small file each: an interrupted study takes up where it stopped."""

from __future__ import annotations

import functools
import hashlib
import json
import math
from dataclasses import asdict, dataclass, fields
from importlib.resources import files
from typing import TYPE_CHECKING

from viscofric.files import write_atomically

if TYPE_CHECKING:
    from collections.abc import Iterator
    from importlib.resources.abc import Traversable
    from pathlib import Path

    from viscofric.contact.solution import ContactSolution


@dataclass(frozen=True)
class CaseRecord:
    """The numbers of one solved contact, all SI; see `ContactSolution` and `Diagnostics`."""

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

    @classmethod
    def of(cls, solution: ContactSolution, temperature: float) -> CaseRecord:
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
        )


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
            values = json.loads(self._path(key).read_text(encoding="utf-8"))
            record = CaseRecord(**{**values, "warnings": tuple(values["warnings"])})
        except (OSError, ValueError, TypeError, KeyError):
            return None
        sound = all(_is_number(getattr(record, name)) for name in NUMBERS)
        return record if sound and all(isinstance(text, str) for text in record.warnings) else None

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
        write_atomically(self._path(key), json.dumps(asdict(record)).encode())

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.json"


NUMBERS = tuple(field.name for field in fields(CaseRecord) if field.name != "warnings")


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
