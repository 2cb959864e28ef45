"""Files of the states of runs: records as JSON beside their arrays (.npz of NumPy), without executable content."""

from __future__ import annotations

import dataclasses
import hashlib
import io
import json
import math
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from os import PathLike
from typing import Any, get_args, get_origin, get_type_hints

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError
from viscofric.files import LARGEST_FILE, LARGEST_UNPACKED, file_path, insist_on_size, read_bytes, write_atomically
from viscofric.motion.chains import Track
from viscofric.motion.free.state import FreeState
from viscofric.motion.free.stored import Basis
from viscofric.motion.history import History
from viscofric.motion.memory import Modes
from viscofric.motion.mover import State
from viscofric.motion.normal import SpringState
from viscofric.motion.periodic import PeriodicState
from viscofric.motion.restart import Begun, Restart
from viscofric.motion.schedule import Reading

_STATE, _RECORDS, _DIGEST = "viscofric state ", "records", "sha256"
_FORMAT = _STATE + "3"
_DAMAGED = (
    *(KeyError, ValueError, TypeError, IndexError, OSError, EOFError, RecursionError),
    *(zipfile.BadZipFile, InputError),
)
_HISTORY = ("time", "temperature", "before", "direction")
#: Method -> kind of its states, and of what they are made on.
_KINDS: dict[str, tuple[Any, Any]] = {
    "springs": (SpringState, Array),
    "waves": (PeriodicState, Modes),
    "grid": (FreeState, Basis),
}
#: Longest row that stands among the records.
_SHORT = 8


def reached(restart: Restart | None) -> Restart:
    """Return the state of a run; InputError if it has none: its contact was heated, or is one of a cycle."""
    if restart is None:
        raise InputError(
            "resume: a heated contact, or the period of a cycle, does not go on from its end; solve the whole history "
            "from its start.",
            code="not-available",
        )
    return restart


def write_restart(path: str | PathLike[str], restart: Restart) -> None:
    """Write the state of a run, atomically."""
    history, every = restart.history, list[Array]()
    names = (*_HISTORY, "position" if history.speed is None else "speed", history.control)
    given = {name: value for name in names if (value := getattr(history, name)) is not None}
    records = {"method": restart.method, "history": given, "marches": restart.marches, "same": restart.same}
    text = json.dumps(_packed(records, every)).encode()
    arrays = {"format": np.asarray(_FORMAT), _RECORDS: np.frombuffer(text, np.uint8)}
    arrays |= {str(place): one for place, one in enumerate(every)}
    arrays[_DIGEST] = np.asarray(_digest(arrays))
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]
    if file.tell() > LARGEST_FILE or sum(one.nbytes for one in arrays.values()) > LARGEST_UNPACKED:
        size, right = math.ceil(file.tell() / 1e6), LARGEST_FILE / 1e6
        raise DataFileError(
            str(path), f"would hold {size} MB, the state of a run at most {right:.0f} MB; solve with less accuracy.",
            code="too-large",
        )  # fmt: skip
    write_atomically(file_path(path), file.getvalue())


def read_restart(path: str | PathLike[str]) -> Restart:
    """Return the state of a run in a file; `DataFileError` for any other file."""
    data = read_bytes(path, LARGEST_FILE)
    insist_on_size(data, path)
    kind = ""
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            named = {name: stored[name] for name in stored.files}
        kind = str(named["format"])
        if kind != _FORMAT:
            raise ValueError("of another kind")
        if str(named[_DIGEST]) != _digest(named):
            raise ValueError("other numbers than were stored")
        return _restart(json.loads(named[_RECORDS].tobytes()), named)
    except _DAMAGED:
        problem, code = "is not the state of a run, as TransientSolution.save_state writes it.", "not-a-state"
        if kind.startswith(_STATE) and kind != _FORMAT:
            problem, code = "is the state of a run of another version; solve the history again.", "other-version"
        raise DataFileError(str(path), problem, code=code) from None


def _restart(records: Mapping[str, Any], arrays: Mapping[str, Array]) -> Restart:
    state, basis = _KINDS[records["method"]]
    read = _Reader(arrays, state)
    given: dict[str, Any] = {
        name: value if isinstance(value, str) else read.array(value) for name, value in records["history"].items()
    }
    marches = [
        Begun(read.of(Track, one["track"]), read.of(basis, one["basis"]), read.of(bool, one["all_steps"]))
        for one in records["marches"]
    ]
    same = read.of(Mapping[str, Array], records["same"])
    return Restart(records["method"], History(**given), tuple(marches), same)


def _digest(arrays: Mapping[str, Any]) -> str:
    """Return the SHA-256 of all names, types, shapes and numbers."""
    found = hashlib.sha256()
    for name in sorted(set(arrays) - {_DIGEST}):
        one = np.ascontiguousarray(arrays[name])
        found.update(f"{name} {one.dtype.str} {one.shape}\0".encode() + one.tobytes())
    return found.hexdigest()


def _parts(kind: Any) -> tuple[str, ...]:
    """Return the names by which a record is made: those of a dataclass or a named tuple."""
    if dataclasses.is_dataclass(kind):
        return tuple(one.name for one in dataclasses.fields(kind) if one.init)
    return getattr(kind, "_fields", ())


def _packed(value: Any, arrays: list[Array]) -> Any:
    """Return a value for JSON; arrays are numbers of those that it appends."""
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0):
        return value.item()
    if isinstance(value, np.ndarray):
        if value.ndim == 1 and 0 < value.size <= _SHORT and value.dtype == float:
            return value.tolist()
        arrays.append(value)
        return len(arrays) - 1
    if isinstance(value, Mapping):
        return {name: _packed(one, arrays) for name, one in value.items()}
    if parts := _parts(type(value)):
        return _packed({name: getattr(value, name) for name in parts}, arrays)
    if isinstance(value, (tuple, list)):
        return [_packed(one, arrays) for one in value]
    return value


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind)


@dataclass(frozen=True)
class _Reader:
    """Makes values of given kinds, those of `State` being states of one method."""

    arrays: Mapping[str, Array]
    state: Any

    def of(self, kind: Any, found: Any) -> Any:
        """Return a value of a kind; KeyError, TypeError or ValueError if it is none."""
        kind = self.state if kind is State else kind
        origin, inner = get_origin(kind), get_args(kind)
        if type(None) in inner:
            return None if found is None else self.of(inner[0], found)
        if origin is np.ndarray:
            return self.array(found)
        if origin is Mapping or origin is dict:
            return {name: self.of(inner[1], one) for name, one in dict(found).items()}
        if origin in (tuple, list):
            return origin(self.of(inner[0], one) for one in found)
        if parts := _parts(origin or kind):
            hints, record = _hints(origin or kind), dict(found)
            return (origin or kind)(**{name: self.of(hints[name], record[name]) for name in parts if name in record})
        return Reading(found, 0.0) if kind is Reading else kind(found)

    def array(self, found: Any) -> Array:
        """Return an array that is written out, or one by its number."""
        return np.array(found, dtype=float) if isinstance(found, list) else self.arrays[str(found)]
