"""Parts of the delayed displacement around a loaded cell: a lattice, finer rules near the cell, and a tail.

`viscofric.contact.influence.mixtures` sums it up over modes, `viscofric.contact.influence.moments` over cells.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.influence.memory_rules import (
    applied,
    faded,
    lattice_interpolation,
    panel_points,
    panel_rule,
    product_weights,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from viscofric.arrays import Array
    from viscofric.contact.influence.memory_rules import Inexact

    Potential: TypeAlias = Callable[[Array, Array], Array]

# Longest exponent that still leaves a trace in double precision.
_FADED = 45.0
# Points on the lattice through which L is interpolated.  The error falls as the product of their distances from the
# middle of the cell, 2.6e4, over the twelfth power of the distance from the loaded cell: below 1e-12 from here on.
NODES = 12
_SMOOTH = 24
# Nearer rows (distance from the edge of the loaded cell, in cells) share a rule: the nearer, the finer.  With Gauss
# order n on a panel the error falls as ρ^(−n), ρ the Bernstein ellipse through the nearest singularity, the edge of the
# loaded cell; the orders below leave less than 1e-11.
_WHOLE = np.array([0.0, 1.0])
_HALVES = np.array([0.0, 0.5, 1.0])
_ROW_RULES: tuple[tuple[float, Array, int], ...] = (
    (-math.inf, _HALVES, 16),
    (2.4, _WHOLE, 12),
    (15.4, _WHOLE, 7),
    (_SMOOTH - 0.6, _WHOLE, 0),
)
# Rows so near that the edge's logarithm needs panels that halve towards it: to a tenth of the shortest memory.
_GRADED_ROWS = 0.4
_HALVINGS = 0.5 ** np.arange(1.0, 31.0)
# Rows that are transformed in one go: few enough for the cache.
ROWS_AT_ONCE = 48
# Digits that are kept of what comes from beyond the window, as a function of y.
_TAIL_ACCURACY = 1e-13
FIRST = int(lattice_interpolation(NODES)[0][0])
_LAST = int(lattice_interpolation(NODES)[0][-1])


@dataclass(frozen=True)
class Around:
    """The potential around the loaded cell, at places along x that are looked at."""

    potential: Potential
    nx: int
    shift: float
    even: bool = True  # whether the potential is even in x

    def at(self, x: Array, y: Array) -> Array:
        """Values at places x, in cells from the loaded one, and rows y: (len(x), len(y))."""
        return self.potential(x[:, None] - self.shift, y)

    def lattice(self, y: Array) -> Array:
        """Values at x = −(nx−1) + first … nx−1 + last node, for each row: (rows, 2 nx + 10)."""
        end = self.nx + _LAST
        if self.shift != 0.0 or not self.even:
            return self.potential(np.arange(-(self.nx - 1.0) + FIRST, end) - self.shift, y[:, None])
        half = self.potential(np.arange(float(end)), y[:, None])
        return np.concatenate([half[:, end - 2 : 0 : -1], half], axis=1)


@dataclass(frozen=True)
class Modes:
    """Rates at which modes fade per cell, real or with imaginary parts that stand for a change."""

    rate: Inexact

    @cached_property
    def interpolated(self) -> Inexact:
        """Weights (m, nodes) of the lattice points around a cell in the integral over that cell."""
        return applied(product_weights(NODES, self.rate), lattice_interpolation(NODES)[1])

    def fading(self, cells: Array) -> Inexact:
        """Return what is left of each mode so many cells ahead: (m, cells)."""
        return faded(self.rate[:, None] * cells)


def beyond(around: Around, modes: Modes, rows: Array) -> tuple[Inexact, Array]:
    """Return the part of the memory from beyond the window, in place of the lattice's own end there.

    K at x = nx, (m, n), decays farther behind.  As a function of y it is smooth, since its sources are at least a
    window away: it is computed at n rows, and returned with the interpolation (n, ny) from these to all.
    """
    nx = around.nx
    nodes, interpolation = _smooth_rows(rows, nx + FIRST - 1.0)
    start = np.array([float(nx)])
    end = _FADED / modes.rate.real.min()
    edges = [0.0, float(nx)]
    while edges[-1] < end:
        edges.append(2.0 * edges[-1] + nx)
    points, weights = panel_rule(np.array(edges), 16, modes.rate)
    tail = applied(weights, around.at(start + points, nodes))
    # The convolution knows the lattice up to nx − 1 + last node, and interpolates there in a few cells of its own.
    places = np.arange(nx + FIRST, nx + _LAST)
    spurious = np.zeros((len(modes.rate), len(places)), modes.rate.dtype)
    for cell in range(nx, nx + _LAST - FIRST):
        known = (places >= cell + FIRST) & (places <= cell + _LAST)
        left = faded(modes.rate * (cell - nx))[:, None]
        spurious[:, known] += left * modes.interpolated[:, places[known] - cell - FIRST]
    return tail - applied(spurious, around.at(places.astype(float), nodes)), interpolation


def _smooth_rows(rows: Array, distance: float) -> tuple[Array, Array]:
    """Few rows and the matrix from them to all, for functions that are smooth on the scale of a distance."""
    length = rows[-1]
    if distance <= 0.0 or length == 0.0:
        return rows, np.eye(len(rows))
    singular = -1.0 + 2.0j * distance / length
    ellipse = abs(singular - np.sqrt(singular**2 - 1.0))
    count = math.ceil(-math.log(_TAIL_ACCURACY) / math.log(ellipse))
    if count >= len(rows):
        return rows, np.eye(len(rows))
    nodes = np.polynomial.chebyshev.chebpts1(count)
    to_coefficients = np.polynomial.chebyshev.chebvander(nodes, count - 1).T * (2.0 / count)
    to_coefficients[0] *= 0.5
    matrix = np.polynomial.chebyshev.chebvander(2.0 * rows / length - 1.0, count - 1) @ to_coefficients
    return 0.5 * length * (nodes + 1.0), np.asarray(matrix.T)


def near_cells(nx: int) -> tuple[int, int]:
    """Return the first and the last distance along x at which the interpolation needs a correction."""
    return max(-(nx - 1), -_SMOOTH - 1), min(nx - 1, _SMOOTH)


def near_memory(around: Around, modes: Modes, rows: Array, edge: float) -> Iterator[tuple[slice, Inexact]]:
    """Yield the corrections by finer rules near the loaded cell, whose edge is at `edge` in y.

    Rows that share a rule, and the memory (cells, m, n) at the distances `near_cells` along x for these rows; it decays
    farther behind the first of them.
    """
    first, last = near_cells(around.nx)
    starts = np.searchsorted(rows - edge, [start for start, _, _ in _ROW_RULES])
    graded = int(np.searchsorted(rows - edge, _GRADED_ROWS))
    decay = faded(modes.rate)[:, None]
    for rule, (start, stop) in enumerate(pairwise(starts)):
        if stop == start:
            continue
        y = tuple(rows[start:stop])
        fine = panel_rule(*_ROW_RULES[rule][1:], modes.rate)[1]
        lattice, potential = _near_potentials(around.potential, around.shift, first, last, y, rule)
        singular = _missed_by_edge(around, modes.rate, fine, y[:graded]) if start == 0 else {}
        around_cells = np.lib.stride_tricks.sliding_window_view(lattice, NODES, axis=0)[: len(potential)]
        # What each cell adds, then, cell by cell from the front, what fades from the one before.
        memory = applied(fine, potential)
        memory -= applied(modes.interpolated, around_cells.swapaxes(1, 2))
        for cell, missed in singular.items():
            if first <= cell <= last:
                memory[cell - first, :, :graded] += missed
        for place in range(last - first - 1, -1, -1):
            memory[place] += decay * memory[place + 1]
        yield slice(start, stop), memory


def _missed_by_edge(around: Around, rate: Inexact, coarse: Inexact, y: tuple[float, ...]) -> dict[int, Inexact]:
    """Return what the nearest rows' rule misses from a cell's centre to the next.

    At the edges x = ±1/2 L has a logarithm in its slope; panels halve towards it from both sides.
    """
    fine = panel_rule(_graded_panels(around.shift), 16, rate)[1]
    values = _edge_potentials(around.potential, around.shift, y)
    return {cell: applied(fine, there) - applied(coarse, here) for cell, (there, here) in values.items()}


# Potentials near the loaded cell do not depend on the memory: the speeds of a curve share them.
@lru_cache(maxsize=32)
def _near_potentials(
    potential: Potential, shift: float, first: int, last: int, y: tuple[float, ...], rule: int
) -> tuple[Array, Array]:
    """On the lattice around the cells first … last, (cells + nodes − 1, rows), and at a rule's points in each of them.

    The latter (cells, points, rows).
    """
    rows, cells = np.array(y), np.arange(first, last + 1.0)
    points = panel_points(*_ROW_RULES[rule][1:])
    lattice = potential(np.arange(first + FIRST, last + _LAST + 1.0)[:, None] - shift, rows)
    within = potential((cells[:, None] + points).reshape(-1, 1) - shift, rows)
    return lattice, within.reshape(len(cells), len(points), len(rows))


@lru_cache(maxsize=32)
def _edge_potentials(potential: Potential, shift: float, y: tuple[float, ...]) -> dict[int, tuple[Array, Array]]:
    """At the points of the graded rule and of the nearest rows' rule, in the cells around the loaded one's edges."""
    rules = panel_points(_graded_panels(shift), 16), panel_points(*_ROW_RULES[0][1:])
    rows = np.array(y)
    cells = (-2, -1, 0, 1)
    return {cell: tuple(potential((cell + points)[:, None] - shift, rows) for points in rules) for cell in cells}  # type: ignore[misc]


def _graded_panels(shift: float) -> Array:
    edge = (0.5 + shift) % 1.0
    near = np.concatenate([[0.0, 1.0, edge], edge - _HALVINGS, edge + _HALVINGS, edge + 1.0 - _HALVINGS])
    return np.unique(near[(near >= 0.0) & (near <= 1.0)])
