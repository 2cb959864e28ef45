"""First states of a contact: of an untouched body, and of one that has rested under the indenter for ever."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import ConvergenceError
from viscofric.motion.free.energy import Products
from viscofric.motion.free.state import FreeState

if TYPE_CHECKING:
    from viscofric.motion.free.cells import Cells
    from viscofric.motion.schedule import Instant

_MOST_WINDOWS = 30


def untouched(cells: Cells, instant: Instant) -> FreeState:
    """Return the state of an untouched body, the indenter at its place, just touching."""
    place = cells.placed(instant)
    window = cells.window(place)
    zero = np.zeros(window.shape)
    count = len(cells.setting.body.times)
    return FreeState(
        place=place,
        window=window,
        pressure=zero,
        trend=zero,
        duration=0.0,
        box=window,
        memory=np.zeros((count, *window.shape)),
        products=Products(0.0, np.zeros(count), np.zeros(count)),
        faced=0.0,
        depth=0.0,
        dissipated=0.0,
        force=(0.0, 0.0),
    )


def rested(cells: Cells, instant: Instant) -> FreeState:
    """Return the state of a contact that has rested for ever."""
    body, place = cells.setting.body, cells.placed(instant)
    load, depth = cells.setting.control(instant)
    relaxed = body.instant + float(body.compliances.sum())
    for _ in range(_MOST_WINDOWS):
        guess = np.sqrt(np.maximum(0.0, 1.0 - cells.grid.x[:, None] ** 2 - cells.grid.y**2))
        (pressure, _, reached), found = cells.solved(relaxed, cells.height(place), load, depth, guess)
        if found is None or not cells.widened(found.pressure > 0.0):
            break
    else:
        raise ConvergenceError("no window was found that holds the contact.", code="no-window")
    window, count = cells.window(place), len(body.times)
    product = float(np.vdot(pressure, cells.response(pressure)))
    facing = cells.facing or cells.response
    return FreeState(
        place=place,
        window=window,
        pressure=pressure,
        trend=np.zeros_like(pressure),
        duration=0.0,
        box=window,
        memory=np.repeat(pressure[None], count, axis=0),
        products=Products(product, np.full(count, product), np.full(count, product)),
        faced=float(np.vdot(pressure, facing(pressure))),
        depth=reached,
        dissipated=0.0,
        force=(0.0, 0.0),
    )
