"""Files of the states of runs: named arrays (.npz of NumPy) without executable content."""

from __future__ import annotations

import dataclasses
import io
import zipfile
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import DataFileError, InputError
from viscofric.files import LARGEST_FILE, file_path, insist_on_size, read_bytes, write_atomically
from viscofric.motion.chains import Difference, Errors, Link, Moment, Pair, Reached, Track
from viscofric.motion.history import History
from viscofric.motion.mover import Field, Observation, Scales
from viscofric.motion.restart import Restart
from viscofric.motion.schedule import Instant

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    from viscofric.arrays import Array

_FORMAT = "viscofric state 2"
_DAMAGED = (KeyError, ValueError, TypeError, IndexError, OSError, EOFError, zipfile.BadZipFile, InputError)
_REACHED = ("time", "jumped", "told", "pace", "share", "stored")
_SEEN = ("load", "depth", "friction_force", "area", "stored", "dissipated")


def reached(restart: Restart | None) -> Restart:
    """Return the state of a run; InputError if its contact was solved on cells."""
    if restart is None:
        raise InputError(
            "resume: a contact on cells does not go on from its end, since its grids depend on the whole history; "
            "solve that from its start.",
            code="not-available",
        )
    return restart


def write_restart(path: str | PathLike[str], restart: Restart) -> None:
    """Write the state of a run, atomically."""
    history, track = restart.history, restart.track
    named: dict[str, Any] = {"format": _FORMAT, "method": restart.method}
    named |= {f"same/{name}": value for name, value in restart.same.items()}
    named |= {f"basis/{name}": value for name, value in restart.basis.items()}
    named |= {
        "history/time": history.time,
        "history/control": history.control,
        "history/value": getattr(history, history.control),
        "history/position": history.position,
        "history/speed": history.speed,
        "history/temperature": history.temperature,
        "history/before": history.before,
        "history/direction": history.direction,
    }
    last = track.reached
    named |= {f"reached/{name}": getattr(last, name) for name in _REACHED}
    named |= {
        "reached/scales": last.scales,
        "reached/spread": last.spread,
        "counts": (track.steps, track.rejected, track.stored),
    }
    for name, link in zip(Pair._fields, last.pair, strict=True):
        named[f"{name}/work"] = link.work
        named |= {f"{name}/seen/{one}": getattr(link.seen, one) for one in _SEEN}
        named |= {f"{name}/extents/{one}": value for one, value in link.seen.extents.items()}
        for part in dataclasses.fields(link.state):
            named[f"{name}/state/{part.name}"] = getattr(link.state, part.name)
    moments = track.moments
    named["moments/time"] = [one.instant.time for one in moments]
    named["moments/clock"] = [one.instant.clock for one in moments]
    named["moments/position"] = [one.instant.position for one in moments]
    named["moments/work"] = [one.work for one in moments]
    named["moments/errors"] = [one.errors for one in moments]
    named |= {f"moments/{name}": [getattr(one.seen, name) for one in moments] for name in _SEEN}
    for name in moments[0].seen.extents if moments else ():
        named[f"moments/extents/{name}"] = [one.seen.extents[name] for one in moments]
    for place, one in enumerate(moments):
        if one.field is not None:
            named[f"field/{place}/pressure"] = one.field.pressure
            named |= {f"field/{place}/axes/{name}": values for name, values in one.field.axes.items()}
    packed = io.BytesIO()
    arrays: dict[str, Any] = {name: np.asarray(value) for name, value in named.items() if value is not None}
    np.savez_compressed(packed, **arrays)
    write_atomically(file_path(path), packed.getvalue())


def read_restart(path: str | PathLike[str]) -> Restart:
    """Return the state of a run in a file; `DataFileError` for any other file."""
    data = read_bytes(path, LARGEST_FILE)
    insist_on_size(data, path)
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            named = {name: stored[name] for name in stored.files}
        if str(named["format"]) != _FORMAT:
            raise ValueError("of another kind")
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
    pair = Pair(*(_link(named, name, method) for name in Pair._fields))
    values: dict[str, Any] = {name: named[f"reached/{name}"].item() for name in _REACHED if f"reached/{name}" in named}
    values |= {"scales": Scales(*named["reached/scales"]), "spread": Difference(*named["reached/spread"])}
    last = Reached(pair, **values)
    steps, rejected, begun = named["counts"].tolist()
    track = Track(_moments(named), int(steps), int(rejected), True, last, begun)
    return Restart(method, history, track, _below(named, "same/"), _below(named, "basis/"))


def _below(named: Mapping[str, Any], start: str) -> dict[str, Array]:
    return {name.removeprefix(start): value for name, value in named.items() if name.startswith(start)}


def _link(named: Mapping[str, Any], name: str, method: str) -> Link[Any]:
    if method == "springs":
        from viscofric.motion.normal import SpringState as Kind
    else:
        from viscofric.motion.periodic import PeriodicState as Kind  # type: ignore[assignment]
    parts = _below(named, f"{name}/state/")
    values: dict[str, Any] = {}
    for part in dataclasses.fields(Kind):
        value = parts.get(part.name)
        if value is None and part.default is dataclasses.MISSING:
            raise KeyError(part.name)
        if value is not None:
            kind = str(part.type)
            values[part.name] = tuple(value.tolist()) if kind.startswith("tuple") else value
            if kind == "float":
                values[part.name] = float(value)
    seen = _observation({one: named[f"{name}/seen/{one}"] for one in _SEEN}, _below(named, f"{name}/extents/"))
    return Link(Kind(**values), seen, float(named[f"{name}/work"]))


def _observation(values: Mapping[str, Any], extents: Mapping[str, Any]) -> Observation:
    x, y = values["friction_force"].tolist()
    numbers: dict[str, Any] = {one: float(values[one]) for one in _SEEN if one != "friction_force"}
    return Observation(**numbers, friction_force=(x, y), extents={one: float(value) for one, value in extents.items()})


def _moments(named: Mapping[str, Any]) -> list[Moment[Any]]:
    columns, extents = {one: named[f"moments/{one}"] for one in _SEEN}, _below(named, "moments/extents/")
    moments: list[Moment[Any]] = []
    for place, time in enumerate(named["moments/time"].tolist()):
        axes, field = _below(named, f"field/{place}/axes/"), None
        if f"field/{place}/pressure" in named:
            field = Field(axes, named[f"field/{place}/pressure"])
        instant = Instant(time, float(named["moments/clock"][place]), named["moments/position"][place])
        seen = _observation(
            {one: value[place] for one, value in columns.items()},
            {one: value[place] for one, value in extents.items()},
        )
        errors = Errors(*named["moments/errors"][place].tolist())
        moments.append(Moment(instant, seen, float(named["moments/work"][place]), errors, field))
    return moments
