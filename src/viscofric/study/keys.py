"""Names of contacts that change with anything that could change their answer, and with any line of the solver."""

from __future__ import annotations

import functools
import hashlib
import json
from dataclasses import fields
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator
    from importlib.resources.abc import Traversable

    from viscofric.rheology.spectra.retardation import RetardationSpectrum


def case_key(description: dict[str, object]) -> str:
    """Return a name for a case that changes with anything that could change its answer."""
    text = json.dumps({"solver": solver_fingerprint(), **description}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@functools.lru_cache(maxsize=64)  # many tasks have the same modes
def modes_written(modes: RetardationSpectrum) -> str:
    """Return what changes with any of the modes."""
    digest = hashlib.sha256(np.array([modes.E0, modes.E_inf]).tobytes())
    for column in (modes.C, modes.tau):
        digest.update(np.ascontiguousarray(column).tobytes())
    return digest.hexdigest()


def written(shape: Any) -> list[object]:
    """Write an indenter or a layer down, whatever its kind."""
    values = ((entry.name, getattr(shape, entry.name)) for entry in fields(shape))
    return [type(shape).__name__, *((name, _digest(value)) for name, value in values)]


def _digest(value: Any) -> object:
    """Return a number as it is, and of an array what changes with any of its entries."""
    if isinstance(value, np.ndarray):
        return [value.shape, hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()]
    return value.item() if isinstance(value, np.generic) else value


#: Files of other rooms that decide what is kept of a contact.
_OWN = {
    "friction": ("sensitivity.py",),
    "study": (
        "keys.py",
        "solving.py",
        "record.py",
        "surface_solving.py",
        "surface_record.py",
        "surface_source.py",
        "surface_steps.py",
    ),
}


@functools.cache
def solver_fingerprint() -> str:
    """Return what changes with any line of the solver, so that cases of an older one are not taken for new."""
    digest = hashlib.sha256()
    for room in ("contact", "roughness", "readers/topography"):
        for name, source in _sources(files("viscofric") / room):
            digest.update(name.encode() + b"\0" + source)
    for room, names in _OWN.items():
        for name in names:
            digest.update((files("viscofric") / room / name).read_bytes())
    return digest.hexdigest()


def _sources(folder: Traversable, path: str = "") -> Iterator[tuple[str, bytes]]:
    """Yield names and texts of the Python files in a folder of a package and in those below it."""
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        name = f"{path}/{entry.name}"
        if entry.is_dir():
            yield from _sources(entry, name)
        elif entry.name.endswith(".py"):
            yield name, entry.read_bytes()
