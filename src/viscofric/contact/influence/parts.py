"""Parts of the delayed displacement around a loaded cell: a lattice, finer rules near the cell, and a tail.

`viscofric.contact.influence.mixtures` sums it up over modes, `viscofric.contact.influence.moments` over cells.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.influence.memory_rules import (
    FADED,
    Inexact,
    applied,
    faded,
    lattice_interpolation,
    panel_points,
    panel_weights,
    product_weights,
)
from viscofric.contact.influence.potentials import CellPotential

# Distance from the loaded cell from which on L is interpolated through 16 points on the lattice.  The error falls as
# the product of their distances from the middle of the cell, 6.3e7, over the distance's 16th power: below 1e-12 here.
_SMOOTH = 18
# Nearer rows share a rule: the first up to a distance (in cells, from the edge of the loaded cell), the second beyond.
# The error of a panel falls as ρ^(−16), ρ the Bernstein ellipse through the nearest singularity, the edge of the loaded
# cell: below 1e-11.
_ROW_PANELS = np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0])
_ROW_STARTS = -math.inf, 2.4, _SMOOTH - 0.6
# In rows so near, the edge's logarithm needs panels that halve towards it until they are 2^-_HALVINGS of the distance
# of the nearest point at which L is evaluated, taken as at least _NEAREST cells.
_GRADED_ROWS = 0.4
_HALVINGS = 10
_NEAREST = 1e-6
_EDGE_CELLS = -2, 1  # first and last that have an edge of the loaded one in them
# Rows that are transformed in one go: few enough for the cache.
ROWS_AT_ONCE = 48
# Digits that are kept of what comes from beyond the window, as a function of y.
_TAIL_ACCURACY = 1e-13
FIRST = int(lattice_interpolation()[0][0])
_LAST = int(lattice_interpolation()[0][-1])


@dataclass(frozen=True)
class Around:
    """The potential around the loaded cell, at places along x that are looked at."""

    potential: CellPotential
    nx: int
    shift: float

    def at(self, x: Array, y: Array) -> Array:
        """Values at places x, in cells from the loaded one, and rows y: (len(x), len(y))."""
        return self.potential(x[:, None] - self.shift, y)

    def lattice(self, y: Array) -> Array:
        """Values at x = −(nx−1) + first … nx−1 + last node, for each row: (rows, 2 nx + nodes − 2)."""
        end = self.nx + _LAST
        if self.shift != 0.0 or self.potential.drag != 0.0:  # else it is even in x
            return self.potential(np.arange(-(self.nx - 1.0) + FIRST, end) - self.shift, y[:, None])
        half = self.potential(np.arange(float(end)), y[:, None])
        return np.concatenate([half[:, end - 2 : 0 : -1], half], axis=1)


@dataclass(frozen=True)
class Modes:
    """Rates at which modes fade per cell, real or with imaginary parts that stand for a change; on so many cells."""

    rate: Inexact
    cells: int

    @cached_property
    def whole(self) -> Inexact:
        """Weights (m, points) of the points within a cell in the integral over it."""
        return product_weights(self.rate)

    @cached_property
    def interpolated(self) -> Inexact:
        """Weights (m, nodes) of the lattice points around a cell in the integral over that cell."""
        return applied(self.whole, lattice_interpolation()[1])

    @cached_property
    def fading(self) -> Inexact:
        """What is left of each mode 0, 1, 2 … cells ahead: (m, cells)."""
        return faded(self.rate[:, None] * np.arange(float(self.cells)))


def beyond(around: Around, modes: Modes, rows: Array) -> tuple[Inexact, Array]:
    """Return the part of the memory from beyond the window, in place of the lattice's own end there.

    K at x = nx, (m, n), decays farther behind.  As a function of y it is smooth, since its sources are at least a
    window away: it is computed at n rows, and returned with the interpolation (n, ny) from these to all.
    """
    nx = around.nx
    nodes, interpolation = _smooth_rows(len(rows), float(rows[-1]), nx + FIRST - 1.0)
    start = np.array([float(nx)])
    end = FADED / modes.rate.real.min()
    edges = [0.0, float(nx)]
    while edges[-1] < end:
        edges.append(2.0 * edges[-1] + nx)
    panels = np.array(edges)
    tail = applied(panel_weights(panels, modes.rate), around.at(start + panel_points(panels), nodes))
    # The convolution knows the lattice up to nx − 1 + last node, and interpolates there in a few cells of its own.
    places = np.arange(nx + FIRST, nx + float(_LAST))
    spurious, decay = modes.interpolated[:, : len(places)].copy(), faded(modes.rate)
    for before, here in pairwise(spurious.T):
        here += decay * before
    return tail - applied(spurious, around.at(places, nodes)), interpolation


@lru_cache(maxsize=32)
def _smooth_rows(count: int, length: float, distance: float) -> tuple[Array, Array]:
    """Few of the rows 0 … length, and the matrix from them to all, for functions smooth on the scale of a distance."""
    rows = np.linspace(0.0, length, count)
    if distance <= 0.0 or length == 0.0:
        return rows, np.eye(count)
    singular = -1.0 + 2.0j * distance / length
    ellipse = abs(singular - np.sqrt(singular**2 - 1.0))
    few = math.ceil(-math.log(_TAIL_ACCURACY) / math.log(ellipse))
    if few >= count:
        return rows, np.eye(count)
    nodes = np.polynomial.chebyshev.chebpts1(few)
    to_coefficients = np.polynomial.chebyshev.chebvander(nodes, few - 1).T * (2.0 / few)
    to_coefficients[0] *= 0.5
    matrix = np.polynomial.chebyshev.chebvander(2.0 * rows / length - 1.0, few - 1) @ to_coefficients
    return 0.5 * length * (nodes + 1.0), np.asarray(matrix.T)


def near_cells(nx: int) -> tuple[int, int]:
    """Return the first and the last distance along x at which the interpolation needs a correction."""
    return max(-(nx - 1), -_SMOOTH - 1), min(nx - 1, _SMOOTH)


def near_memory(around: Around, modes: Modes, rows: Array) -> Inexact:
    """Return the corrections by finer rules near the loaded cell: (cells, n, m).

    At the distances `near_cells` along x and in the first n rows; farther behind the first of these cells it decays.
    """
    (first, last), edge = near_cells(around.nx), 0.5 * around.potential.aspect
    starts = np.searchsorted(rows - edge, _ROW_STARTS)
    memory = np.empty((last - first + 1, starts[-1], len(modes.rate)), modes.rate.dtype)
    halves = panel_weights(_ROW_PANELS[0], modes.rate)
    for rule, (weights, (start, stop)) in enumerate(zip((halves, modes.whole), pairwise(starts), strict=True)):
        values = _near_potentials(around.potential, around.shift, first, last, tuple(rows[start:stop]), rule)
        memory[:, start:stop] = _summed(values, np.hstack([weights, -modes.interpolated]))
    # What the nearest rows' rule misses where L has a logarithm in its slope; panels halve towards it from both sides.
    graded = int(np.searchsorted(rows - edge, _GRADED_ROWS))
    fine = panel_weights(_graded_panels(around.shift), modes.rate)
    cells = slice(max(first, _EDGE_CELLS[0]), min(last, _EDGE_CELLS[-1]) + 1)
    values = _edge_potentials(around.potential, around.shift, cells.start, cells.stop - 1, tuple(rows[:graded]))
    memory[cells.start - first : cells.stop - first, :graded] += _summed(values, np.hstack([fine, -halves]))
    # That is what each cell adds; cell by cell from the front, what fades from the one before.
    decay = faded(modes.rate)
    for ahead, here in pairwise(memory[::-1]):
        here += decay * ahead
    return memory


def _summed(values: Array, weights: Inexact) -> Inexact:
    """Return the sums over g of values (g, cells, rows) times weights (m, g): (cells, rows, m)."""
    found = applied(weights, values.reshape(len(values), -1))
    return np.moveaxis(found.reshape(len(weights), *values.shape[1:]), 0, 2)


# Potentials near the loaded cell do not depend on the memory: the speeds of a curve share them.
@lru_cache(maxsize=32)
def _near_potentials(
    potential: CellPotential, shift: float, first: int, last: int, y: tuple[float, ...], rule: int
) -> Array:
    """At a rule's points in the cells first … last, then on the lattice around each: (points + nodes, cells, rows)."""
    points = [panel_points(_ROW_PANELS[rule]), lattice_interpolation()[0].astype(float)]
    return _at_cells(potential, shift, points, (first, last), y)


@lru_cache(maxsize=32)
def _edge_potentials(potential: CellPotential, shift: float, first: int, last: int, y: tuple[float, ...]) -> Array:
    """At the points of the graded and of the nearest rows' rule in the cells first … last: (points, cells, rows)."""
    points = [panel_points(_graded_panels(shift)), panel_points(_ROW_PANELS[0])]
    return _at_cells(potential, shift, points, (first, last), y)


def _at_cells(
    potential: CellPotential, shift: float, points: list[Array], cells: tuple[int, int], y: tuple[float, ...]
) -> Array:
    x, start = np.concatenate(points), np.arange(cells[0], cells[1] + 1.0)
    return potential((x[:, None] + start).reshape(-1, 1) - shift, np.array(y)).reshape(len(x), len(start), len(y))


def _graded_panels(shift: float) -> Array:
    edge = (0.5 + shift) % 1.0
    sizes = 0.5 ** np.arange(1.0, _HALVINGS - math.log2(max(0.5 - shift, _NEAREST)))
    near = np.concatenate([[0.0, 1.0, edge], edge - sizes, edge + sizes, edge + 1.0 - sizes])
    return np.unique(near[(near >= 0.0) & (near <= 1.0)])
