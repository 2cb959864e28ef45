"""Marches on cells that are continued: all that a grid needs to go on, as named arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple, dataclass, fields, replace
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.operators.layer import ScaledLayer
from viscofric.motion.chains import Track
from viscofric.motion.free.box import Box
from viscofric.motion.free.mover import FreeMover
from viscofric.motion.free.past import Past, Piece
from viscofric.motion.free.setting import Setting
from viscofric.motion.free.state import FreeState, Place, Products
from viscofric.motion.free.wake import Wake
from viscofric.motion.memory import Modes
from viscofric.motion.mover import Sizes
from viscofric.motion.problem import Problem


@dataclass(frozen=True, eq=False)
class Level:
    """A march on one grid."""

    mover: FreeMover
    track: Track[Any]
    steps: float  # accuracy of its steps
    size: float | None = None  # half the contact that a first grid is made for

    @property
    def cells(self) -> float:
        """Number of cells along the longest contact."""
        return self.mover.longest / self.mover.grid.spacing

    @property
    def basis(self) -> dict[str, Array]:
        """Units, modes and grid."""
        mover, setting = self.mover, self.mover.setting
        scale, modes = setting.scale, setting.modes
        named: dict[str, Any] = {
            "scale": (scale.length, scale.depth, scale.stiffness),
            "toward": setting.toward,
            "level": setting.level,
            "known": setting.known or (),
            "grid": astuple(mover.grid),
            "size": () if self.size is None else (self.size,),
            "reach": mover.reach,
            "numbers": (mover.tolerance, mover.longest, mover.datum, self.steps),
        }
        named |= {f"modes/{one.name}": getattr(modes, one.name) for one in fields(modes)}
        return {name: np.asarray(value, dtype=float) for name, value in named.items()}


def level_of(problem: Problem, setting: Setting, basis: Mapping[str, Array], track: Track[Any]) -> Level:
    """Return a march that is to be continued; `setting` is that of the longer history."""
    scale = Scale(setting.geometry, *basis["scale"].tolist())
    toward = basis["toward"][0].item(), basis["toward"][1].item()
    modes = Modes(**{one.name: _plain(basis[f"modes/{one.name}"]) for one in fields(Modes)})
    ratio, layer = problem.material.poisson_ratio, None
    if problem.layer is not None:
        layer = ScaledLayer.of(problem.layer, scale.length, ratio)
    known = Sizes(*basis["known"].tolist()) if basis["known"].size else None
    shape = ScaledIndenter(setting.indenter, scale, toward)
    setting = replace(
        setting, scale=scale, shape=shape, toward=toward, layer=layer, known=known, distance=basis["level"].item()
    ).with_modes(modes, problem)
    spacing, *counts = basis["grid"].tolist()
    # Cells behind, ahead and beside, and the shape of a cell.
    grid = Grid(spacing, *map(int, counts[:3]), *counts[3:])
    tolerance, longest, datum, steps = basis["numbers"].tolist()
    mover = FreeMover(setting, grid, tolerance)
    mover.reach, mover.longest, mover.datum = Extent(*basis["reach"].tolist()), longest, datum
    return Level(mover, track, steps, basis["size"][0].item() if basis["size"].size else None)


def packed(state: FreeState) -> dict[str, Any]:
    """Return a state as named arrays."""
    found = {one.name: getattr(state, one.name) for one in fields(state)}
    products, past, wake = (found.pop(name) for name in ("products", "past", "wake"))
    found |= {f"products/{one.name}": getattr(products, one.name) for one in fields(products)}
    if wake is not None:
        found |= {f"wake/{one.name}": getattr(wake, one.name) for one in fields(wake)}
    found["pieces"] = np.array([one.box for one in past.pieces], dtype=int).reshape(-1, 4)
    for place, (piece, left) in enumerate(zip(past.pieces, past.left, strict=True)):
        found |= {f"piece/{place}/memory": piece.memory, f"piece/{place}/left": left}
    return found


def unpacked(parts: Mapping[str, Any]) -> FreeState:
    """Return the state of named arrays; KeyError, TypeError or ValueError for those of no state."""
    i, j, x, y = parts["place"].tolist()
    values: dict[str, Any] = {name: Box(*map(int, parts[name].tolist())) for name in ("window", "box")}
    values |= {name: parts[name] for name in ("pressure", "trend", "memory")}
    values |= {name: parts[name].item() for name in ("duration", "faced", "depth", "dissipated", "lagging")}
    along, across = parts["force"].tolist()
    wake = None
    if "wake/row" in parts:
        wake = Wake(**{one.name: _plain(parts[f"wake/{one.name}"]) for one in fields(Wake)})
    pieces, left = [], []
    for place, box in enumerate(parts["pieces"].tolist()):
        pieces.append(Piece(Box(*box), parts[f"piece/{place}/memory"]))
        left.append(parts[f"piece/{place}/left"])
    return FreeState(
        place=Place(int(i), int(j), x, y),
        products=Products(**{one.name: _plain(parts[f"products/{one.name}"]) for one in fields(Products)}),
        force=(along, across),
        past=Past(tuple(pieces), tuple(left)),
        wake=wake,
        **values,
    )


def _plain(value: Array) -> Any:
    return value if value.ndim else value.item()
