"""Names of contacts that change with anything that could change their answer, and with any line of the solver."""

from __future__ import annotations

import functools
import hashlib
import json
from dataclasses import fields, is_dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from importlib.resources.abc import Traversable


def key_of(arguments: Mapping[str, Any]) -> str:
    """Return a name for a contact that changes with any argument that could change its answer."""
    described = {name: written(value) for name, value in arguments.items()}
    text = json.dumps({"solver": solver_fingerprint(), **described}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@functools.lru_cache(maxsize=64)  # many tasks have the same modes
def modes_written(modes: RetardationSpectrum) -> str:
    """Return what changes with any of the modes."""
    digest = hashlib.sha256(np.array([modes.E0, modes.E_inf]).tobytes())
    for column in (modes.C, modes.tau):
        digest.update(np.ascontiguousarray(column).tobytes())
    return digest.hexdigest()


def written(value: Any) -> object:
    """Return a value in plain types that change with it: of modes and arrays, a digest; of shapes, all their fields."""
    if isinstance(value, RetardationSpectrum):
        return modes_written(value)
    if isinstance(value, np.ndarray):
        return [value.shape, hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()]
    if hasattr(value, "described"):  # a surface, by what its heights are made from
        return value.described()
    if is_dataclass(value):
        return [type(value).__name__, *((entry.name, written(getattr(value, entry.name))) for entry in fields(value))]
    return value.item() if isinstance(value, np.generic) else value


#: Files of other rooms that decide what is kept of a contact.
_OWN = {
    "friction": ("sensitivity.py",),
    "study": (
        "cases/keys.py",
        "solving.py",
        "record.py",
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
