"""First states of a contact: of an untouched body, of one that has rested under the indenter, or slid, for ever."""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.geometry import LINE, POINT
from viscofric.contact.free.nested import solve_on
from viscofric.contact.free.problem import Control, Problem
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.motion.free.box import Box
from viscofric.motion.free.cells import Cells
from viscofric.motion.free.past import Wake
from viscofric.motion.free.state import FreeState, Place, Products
from viscofric.motion.memory import step_coefficients
from viscofric.motion.schedule import Instant

# Distance behind the contact up to which its memory is kept on cells: in memory lengths, and in windows.
_FADED, _WINDOWS = 20.0, 12.0


def untouched(cells: Cells, instant: Instant) -> FreeState:
    """Return the state of an untouched body, the indenter at its place, just touching."""
    place = cells.placed(instant)
    return _resting(cells, place, np.zeros(cells.window(place).shape), 0.0)


def rested(cells: Cells, instant: Instant) -> FreeState:
    """Return the state of a contact that has rested for ever."""
    body, place = cells.setting.body, cells.placed(instant)
    load, depth = cells.setting.control(instant)
    relaxed = body.instant + float(body.compliances.sum())
    for _ in cells.attempts():
        guess = np.sqrt(np.maximum(0.0, 1.0 - cells.grid.x[:, None] ** 2 - cells.grid.y**2))
        (pressure, _, reached), found = cells.solved(relaxed, cells.height(place), load, depth, guess)
        if found is None or not cells.widened(found.pressure > 0.0):
            break
    return _resting(cells, place, pressure, reached)


def _resting(cells: Cells, place: Place, pressure: Array, depth: float) -> FreeState:
    """Return the state whose memory is the pressure itself."""
    window, count = cells.window(place), len(cells.setting.body.times)
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
        depth=depth,
        dissipated=0.0,
        force=(0.0, 0.0),
    )


def slid(cells: Cells, instant: Instant, speed: float) -> FreeState:
    """Return the state of a contact that slides along the lattice's x at a speed, lengths per second of the clock."""
    body, place = cells.setting.body, cells.placed(instant)
    pressure = _steady_pressure(cells, instant, speed)
    window = cells.window(place)
    nx, ny = window.shape
    spacing = cells.grid.spacing
    faded = _FADED * speed * float(body.times.max(initial=0.0)) / spacing
    behind = int(min(faded, _WINDOWS * nx)) + 1
    box = Box(window.i - behind, window.j, nx + behind, ny)
    steps = spacing / speed / body.times
    decay, first, last = (one[:, None] for one in step_coefficients(steps))
    here = window.carried(pressure, box)
    memory = np.zeros((len(body.times), *box.shape))
    # From the front backwards: a cell that is farther behind has seen all that the next one has, one step later.
    before, ahead = np.zeros((len(body.times), ny)), np.zeros(ny)
    for row in range(box.nx - 1, -1, -1):
        before = decay * before + first * ahead + last * here[row]
        ahead = here[row]
        memory[:, row] = before
    response = cells.response
    spread = response(here)
    each = [response(one) for one in memory]
    mixed = memory.reshape(len(memory), spread.size) @ spread.ravel()
    modes = np.array([float(np.vdot(a, b)) for a, b in zip(memory, each, strict=True)])
    wake, far = None, np.zeros((1, nx))
    if behind < faded:
        wake = Wake.of(box.i - 1, behind, (decay * before + first * ahead).sum(axis=1), steps)
        far = wake.at(response, window)
        mixed = mixed + far @ pressure.sum(axis=1)
        # In steady motion ⟨q, q⟩ does not change, so that ⟨q, p − q⟩ is zero.
        modes = np.where(behind < faded * steps.min() / steps, mixed, modes)
    products = Products(float(np.vdot(here, spread)), mixed, modes)
    facing = cells.facing or response
    opposite = facing(pressure)
    remembered = np.tensordot(body.compliances, np.array(each).reshape(len(each), *box.shape), 1)
    remembered[window.within(box)] += (body.compliances @ far)[:, None] if wake is not None else 0.0
    surface = body.instant * spread + remembered
    loaded = pressure > 0.0
    level = surface[window.within(box)] + body.counterface * opposite + cells.height(place)
    _, depth = cells.setting.control(instant)
    if depth is None:
        depth = float(level[loaded].mean()) if loaded.any() else float(level.min())
    faced = float(np.vdot(pressure, opposite))
    zero = np.zeros_like(pressure)
    force = cells.force(pressure, remembered[window.within(box)])
    return FreeState(place, window, pressure, zero, 0.0, box, memory, products, faced, depth, 0.0, force, wake=wake)


def _steady_pressure(cells: Cells, instant: Instant, speed: float) -> Array:
    setting = cells.setting
    load, depth = setting.control(instant)
    if max(one for one in (load, depth) if one is not None) <= 0.0:
        return np.zeros(cells.grid.shape)
    solid = SteadyMaterial(
        setting.body.instant, setting.body.compliances, speed * setting.body.times, setting.body.counterface
    )
    geometry = LINE if setting.is_line else POINT
    if setting.layer is not None:
        geometry = setting.layer.geometry(geometry, setting.body.counterface)
    place = cells.placed(instant)
    problem = Problem(
        geometry, solid, setting.shape, Control(load, depth), 0.1 * cells.tolerance, layer=setting.layer,
        axis=(place.x, place.y),
    )  # fmt: skip
    for _ in cells.attempts():
        guess = np.sqrt(np.maximum(0.0, 1.0 - cells.grid.x[:, None] ** 2 - cells.grid.y**2))
        found = solve_on(cells.grid, problem, guess, last=True).result.pressure
        if not cells.widened(found > 0.0):
            break
    return np.asarray(found)
