"""Files of the states of runs: named arrays (.npz of NumPy) without executable content."""

from __future__ import annotations

import dataclasses
import hashlib
import io
import math
import zipfile
from collections.abc import Callable, Mapping
from functools import partial
from os import PathLike
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError
from viscofric.files import LARGEST_FILE, LARGEST_UNPACKED, file_path, insist_on_size, read_bytes, write_atomically
from viscofric.motion.chains import Difference, Link, Moment, Pair, Reached, Track
from viscofric.motion.free.state import FreeState
from viscofric.motion.free.stored import packed, unpacked
from viscofric.motion.history import History
from viscofric.motion.mover import Field, Observation, Sizes
from viscofric.motion.normal import SpringState
from viscofric.motion.periodic import PeriodicState
from viscofric.motion.restart import NUMBERS, Begun, Restart
from viscofric.motion.schedule import Instant, Reading

_FORMAT, _DIGEST = "viscofric state 2", "sha256"
#: Beginnings of the names of a march, and of that on the coarser grid of cells.
_MARCHES = "", "coarser/"
_DAMAGED = (KeyError, ValueError, TypeError, IndexError, OSError, EOFError, zipfile.BadZipFile, InputError)
_REACHED = ("time", "since", "jumped", "told", "pace", "share", "stored", "limited")
_HISTORY = ("time", "control", "position", "speed", "temperature", "before", "direction")
_INSTANT, _MOMENT = ("time", "clock", "position"), ("work", "rubbed", "slopes", "errors")
_FORCES = "friction_force", "force_on_slopes"
_SEEN = ("load", "depth", *_FORCES, "area", "stored", "dissipated")


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
    history = restart.history
    named: dict[str, Any] = {"format": _FORMAT, "method": restart.method}
    named |= {f"same/{name}": value for name, value in restart.same.items()}
    named |= {f"history/{name}": getattr(history, name) for name in _HISTORY}
    named["history/value"] = getattr(history, history.control)
    for begin, march in zip(_MARCHES, reversed(restart.marches), strict=False):
        named |= {f"{begin}{name}": value for name, value in _march(march).items()}
    file = io.BytesIO()
    arrays: dict[str, Any] = {name: np.asarray(value) for name, value in named.items() if value is not None}
    arrays[_DIGEST] = np.asarray(_digest(arrays))
    np.savez_compressed(file, **arrays)
    if file.tell() > LARGEST_FILE or sum(one.nbytes for one in arrays.values()) > LARGEST_UNPACKED:
        size, right = math.ceil(file.tell() / 1e6), LARGEST_FILE / 1e6
        raise DataFileError(
            str(path), f"would hold {size} MB, the state of a run at most {right:.0f} MB; solve with less accuracy.",
            code="too-large",
        )  # fmt: skip
    write_atomically(file_path(path), file.getvalue())


def _digest(arrays: Mapping[str, Array]) -> str:
    """Return the SHA-256 of all names, types, shapes and numbers."""
    found = hashlib.sha256()
    for name in sorted(set(arrays) - {_DIGEST}):
        one = np.ascontiguousarray(arrays[name])
        found.update(f"{name} {one.dtype.str} {one.shape}\0".encode() + one.tobytes())
    return found.hexdigest()


def _march(march: Begun) -> dict[str, Any]:
    """Return a march as named arrays; None for what it does not have."""
    track, last = march.track, march.track.reached
    named: dict[str, Any] = {f"basis/{name}": value for name, value in march.basis.items()}
    named |= {f"reached/{name}": getattr(last, name) for name in _REACHED}
    named |= {
        "reached/scales": last.scales,
        "reached/spread": last.spread,
        "counts": (track.steps, track.rejected, track.stored),
    }
    for name, link in zip(Pair._fields, last.pair, strict=True):
        named |= {f"{name}/work": link.work, f"{name}/rubbed": link.rubbed}
        named |= {f"{name}/seen/{one}": getattr(link.seen, one) for one in _SEEN}
        named |= {f"{name}/extents/{one}": value for one, value in link.seen.extents.items()}
        parts = packed(link.state) if isinstance(link.state, FreeState) else vars(link.state)
        named |= {f"{name}/state/{part}": value for part, value in parts.items()}
    moments = track.moments
    for names, rows in (
        (_INSTANT, [one.instant for one in moments]),
        (_MOMENT, moments),
        ((*_SEEN, "left_out"), [one.seen for one in moments]),
    ):
        named |= {f"moments/{name}": [getattr(row, name) for row in rows] for name in names}
    for name in moments[0].seen.extents if moments else ():
        named[f"moments/extents/{name}"] = [one.seen.extents[name] for one in moments]
    for place, one in enumerate(moments):
        if one.field is not None:
            named[f"field/{place}/pressure"] = one.field.pressure
            named[f"field/{place}/error"] = one.field.error
            named |= {f"field/{place}/axes/{name}": values for name, values in one.field.axes.items()}
    return named


def read_restart(path: str | PathLike[str]) -> Restart:
    """Return the state of a run in a file; `DataFileError` for any other file."""
    data = read_bytes(path, LARGEST_FILE)
    insist_on_size(data, path)
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            named = {name: stored[name] for name in stored.files}
        if str(named["format"]) != _FORMAT:
            raise ValueError("of another kind")
        if str(named[_DIGEST]) != _digest(named):
            raise ValueError("other numbers than were stored")
        return _restart(named)
    except _DAMAGED:
        raise DataFileError(
            str(path), "is not the state of a run, as TransientSolution.save_state writes it.", code="not-a-state"
        ) from None


def _restart(named: Mapping[str, Any]) -> Restart:
    speed = named.get("history/speed")
    path = {"position": named["history/position"]} if speed is None else {"speed": speed}
    history = History(
        named["history/time"], **{str(named["history/control"]): named["history/value"]}, **path,
        temperature=named.get("history/temperature"), before=str(named["history/before"]),
        direction=tuple(named["history/direction"].tolist()),
    )  # fmt: skip
    method = str(named["method"])
    marches = [_begun(one, method) for one in (_below(named, start) for start in _MARCHES) if "counts" in one]
    return Restart(method, history, tuple(reversed(marches)), _below(named, "same/"))


def _begun(named: Mapping[str, Any], method: str) -> Begun:
    if not _BASES[method] <= set(_below(named, "basis/")):
        raise KeyError("basis")
    pair = Pair(*(_link(named, name, method) for name in Pair._fields))
    values: dict[str, Any] = {name: named[f"reached/{name}"].item() for name in _REACHED if f"reached/{name}" in named}
    values |= {"scales": Sizes(*named["reached/scales"]), "spread": Difference(*named["reached/spread"])}
    last = Reached(pair, **values)
    steps, rejected, begun = named["counts"].tolist()
    track = Track(_moments(named), int(steps), int(rejected), True, last, begun)
    return Begun(track, _below(named, "basis/"))


def _below(named: Mapping[str, Any], start: str) -> dict[str, Array]:
    return {name.removeprefix(start): value for name, value in named.items() if name.startswith(start)}


def _link(named: Mapping[str, Any], name: str, method: str) -> Link[Any]:
    parts = _below(named, f"{name}/state/")
    seen = _observation({one: named[f"{name}/seen/{one}"] for one in _SEEN}, _below(named, f"{name}/extents/"))
    return Link(_STATES[method](parts), seen, float(named[f"{name}/work"]), float(named[f"{name}/rubbed"]))


def _state(kind: Any, parts: Mapping[str, Any]) -> Any:
    """Return a state whose parts are numbers, arrays and tuples."""
    values: dict[str, Any] = {}
    for part in dataclasses.fields(kind):
        value = parts.get(part.name)
        if value is None and part.default is dataclasses.MISSING:
            raise KeyError(part.name)
        if value is not None:
            values[part.name] = tuple(value.tolist()) if str(part.type).startswith("tuple") else value
            if part.type == "float":
                values[part.name] = float(value)
    return kind(**values)


#: Method -> what makes a state of its parts; parts of the basis that are required.
_STATES: dict[str, Callable[[Mapping[str, Any]], Any]] = {
    "springs": partial(_state, SpringState),
    "waves": partial(_state, PeriodicState),
    "grid": unpacked,
}
_BASES = {
    "springs": {"s"},
    "waves": {"C", "tau", *NUMBERS},
    "grid": {"scale", "toward", "level", "known", "grid", "numbers"},
}


def _observation(values: Mapping[str, Any], extents: Mapping[str, Any]) -> Observation:
    seen: dict[str, Any] = {one: tuple(values[one].tolist()) if one in _FORCES else float(values[one]) for one in _SEEN}
    return Observation(**seen, extents={one: float(value) for one, value in extents.items()})


def _moments(named: Mapping[str, Any]) -> list[Moment[Any]]:
    columns, extents = {one: named[f"moments/{one}"] for one in _SEEN}, _below(named, "moments/extents/")
    rubbed, slopes, left_out = (named[f"moments/{one}"] for one in ("rubbed", "slopes", "left_out"))
    moments: list[Moment[Any]] = []
    for place, time in enumerate(named["moments/time"].tolist()):
        axes, field = _below(named, f"field/{place}/axes/"), None
        if f"field/{place}/pressure" in named:
            field = Field(axes, named[f"field/{place}/pressure"], float(named[f"field/{place}/error"]))
        instant = Instant(time, Reading(float(named["moments/clock"][place]), 0.0), named["moments/position"][place])
        seen = _observation(
            {one: value[place] for one, value in columns.items()},
            {one: value[place] for one, value in extents.items()},
        )
        seen = seen._replace(left_out=Sizes(*left_out[place].tolist()))
        errors = Sizes(*named["moments/errors"][place].tolist())
        work = float(named["moments/work"][place])
        moments.append(Moment(instant, seen, work, errors, field, float(rubbed[place]), float(slopes[place])))
    return moments
