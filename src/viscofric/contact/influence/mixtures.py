"""Influence coefficients of the free viscoelastic solid under steady motion.

The displacement that a uniform pressure on one rectangular cell causes at the centre of another is the cell's potential
L, for a half-space Love's closed form of 1/r over a rectangle, convolved along the direction of motion with the fading
memory of each retardation mode (C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338,
Eq. 8).  In units of the cell's length along the motion, one mode of memory length ``λ = v τ / h`` contributes ::

    K(x, y; λ) = ∫_0^∞ e^(−z) L(x + λ z, y) dz = ∫_0^∞ ε e^(−ε s) L(x + s, y) ds,      ε = 1/λ.

Away from the loaded cell L is so smooth that within each cell it is interpolated from its values at whole numbers
x, the exponential being integrated exactly.  K is then a sum over those values, with weights in which all modes are
summed up beforehand ::

    Σ_m c_m K(i, y; λ_m) = Σ_n V(n) L(i + n, y),      V = Σ_m c_m V_m

one convolution along x, done by FFT whatever the number of modes.  Two corrections make it exact.  Near the loaded
cell, where L is not smooth enough, finer rules take the interpolation's place; what they change is carried on from cell
to cell by K(x) = ∫_0^1 ε e^(−ε s) L(x + s) ds + e^(−ε) K(x + 1).  And beyond the window the memory goes on.
"""

from __future__ import annotations

import numpy as np
import scipy.fft

from viscofric.arrays import Array
from viscofric.contact.influence.memory_rules import ORDER
from viscofric.contact.influence.parts import (
    FIRST,
    ROWS_AT_ONCE,
    Around,
    Modes,
    beyond,
    near_cells,
    near_memory,
)
from viscofric.contact.influence.potentials import CellPotential, HalfSpaceCell

_HALF_SPACE = HalfSpaceCell()


def memory_influence(
    shape: tuple[int, int],
    mixtures: Array,
    memory_lengths: Array,
    shift: float = 0.0,
    *,
    instant: Array | None = None,
    potential: CellPotential = _HALF_SPACE,
) -> Array:
    """Return delayed displacements (k, 2 nx − 1, ny) around one loaded cell, for k mixtures of m modes.

    ``instant L(x, y) + Σ c_m K(x, y; λ_m)`` at x + shift = −(nx−1) … nx−1 and y = 0 … ny−1, in cells; even in y.
    Accurate to about 1e-11 of the largest value for memory lengths from 1e-8 to 1e10 cells.

    `shape` (nx, ny) is the number of cells of the window, x the direction of motion.  Each row of `mixtures` (k, m) has
    the coefficients c_m; `memory_lengths` (m,) are λ_m = v τ_m / h > 0, in cells, for motion towards +x.  Displacements
    are taken `shift` cells (0 to 0.5) behind the cell centres.  `instant` (k,), zero by default, is each mixture's
    factor of the displacement without memory, L; `potential` is L(x, y) of a cell as long as the unit of length, by
    default of the half-space under a square cell.

    The cost hardly depends on the number of modes: for each row of cells and each two mixtures, three FFTs along x,
    twice as long as the rows of the result.
    """
    nx, ny = shape
    around = Around(potential, nx, shift)
    result = np.zeros((len(mixtures), 2 * nx - 1, ny))
    modes = Modes(1.0 / np.asarray(memory_lengths, dtype=float), 2 * nx + ORDER - 2)
    mixtures = np.asarray(mixtures, dtype=float)
    weights = _lattice_weights(modes, mixtures)
    if instant is not None:
        weights[:, -FIRST] += instant
    length = scipy.fft.next_fast_len(4 * nx + ORDER - 4, real=True)
    spectra = np.conj(scipy.fft.rfft(weights, length, axis=1))
    rows = potential.aspect * np.arange(float(ny))
    for start in range(0, ny, ROWS_AT_ONCE):
        piece = slice(start, min(start + ROWS_AT_ONCE, ny))
        lattice = scipy.fft.rfft(around.lattice(rows[piece]), length, axis=1)
        for k, spectrum in enumerate(spectra):
            result[k, :, piece] = scipy.fft.irfft(lattice * spectrum, length, axis=1)[:, : 2 * nx - 1].T
    if len(memory_lengths):
        _add_tail(result, around, modes, mixtures, rows)
        _correct_near(result, around, modes, mixtures, rows)
    return result


def _lattice_weights(modes: Modes, mixtures: Array) -> Array:
    """V(n) of each mixture from the first node on, for a memory without an end: (k, cells)."""
    # c_m w_(m, node), summed over modes cell by cell, then over the cells that use a lattice point.
    cells = (mixtures[:, None] * modes.interpolated.T) @ modes.fading
    weights = np.zeros((len(mixtures), modes.cells))
    for place in range(ORDER):
        weights[:, place:] += cells[:, place, : modes.cells - place]
    return weights


def _add_tail(result: Array, around: Around, modes: Modes, mixtures: Array, rows: Array) -> None:
    tail, interpolation = beyond(around, modes, rows)
    fading = modes.fading[:, 2 * around.nx - 1 : 0 : -1]
    for mixture, found in zip(mixtures, result, strict=True):
        found += ((mixture[:, None] * fading).T @ tail) @ interpolation


def _correct_near(result: Array, around: Around, modes: Modes, mixtures: Array, rows: Array) -> None:
    begin, end = (distance + around.nx - 1 for distance in near_cells(around.nx))
    memory = near_memory(around, modes, rows)
    near = memory.shape[1]
    result[:, begin : end + 1, :near] += np.moveaxis(memory @ mixtures.T, 2, 0)
    before = modes.fading[:, begin:0:-1]
    for mixture, found in zip(mixtures, result, strict=True):
        found[:begin, :near] += (mixture[:, None] * before).T @ memory[0].T
