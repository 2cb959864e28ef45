"""Sums of influence coefficients over a correlation, and of their changes with the memory lengths, mode by mode.

A bilinear form of the influence matrix is Σ a(x) K(x − x') b(x') = Σ W(Δ) K(Δ) with the correlation
W(Δ) = Σ a(x) b(x − Δ).  With the lattice of `viscofric.contact.influence.mixtures`, K = Σ V(n) L(i + n, y) but for
corrections near the loaded cell and beyond the window, all modes share one correlation of W with the potential,

    Σ W K = Σ_n V(n) Z(n) + …,      Z(n) = Σ W(i, y) L(i + n, y),

so that no mode's coefficients are ever stored.  K is an analytic function of the rate at which a mode fades: its change
is found by a complex step, without differences (W. Squire, G. Trapp, SIAM Rev. 40 (1998) 110).
"""

from __future__ import annotations

import numpy as np
import scipy.fft

from viscofric.arrays import Array
from viscofric.contact.influence.memory_rules import ORDER, Inexact, faded
from viscofric.contact.influence.parts import ROWS_AT_ONCE, Around, Modes, beyond, near_cells, near_memory
from viscofric.contact.influence.potentials import CellPotential

# Relative change of the rates, along the imaginary axis: its square is below rounding.
_STEP = 1e-30


def correlation(first: Array, second: Array) -> Array:
    """Return W(Δ) = Σ a(x) b(x − Δ) of two fields (nx, ny), folded about the direction of motion.

    Shape (2 nx − 1, ny), at Δx = −(nx−1) … nx−1 and Δy = 0 … ny−1; values at −Δy are added to those at Δy.
    """
    nx, ny = first.shape
    px, py = scipy.fft.next_fast_len(2 * nx - 1), scipy.fft.next_fast_len(2 * ny - 1, real=True)
    product = scipy.fft.rfft2(first, (px, py)) * scipy.fft.rfft2(second, (px, py)).conj()
    circular = scipy.fft.irfft2(product, (px, py))[np.arange(-(nx - 1), nx) % px]
    folded = circular[:, :ny].copy()
    folded[:, 1:] += circular[:, : py - ny : -1]
    return np.asarray(folded)


def memory_moments(
    weights: Array, memory_lengths: Array, shift: float, potential: CellPotential
) -> tuple[Array, Array]:
    """Return Σ W K and Σ W ∂K/∂ln λ, (k, m) each, for each mode, K as in `viscofric.contact.influence.mixtures`.

    `weights` (k, 2 nx − 1, ny) are correlations W of `correlation`; `memory_lengths` (m,) are λ_m > 0, in cells;
    displacements are taken `shift` cells (0 to 0.5) behind the cell centres.  Accurate to about 1e-11 of Σ |W| max |K|.
    """
    sets, length, ny = weights.shape
    if len(memory_lengths) == 0:
        return np.zeros((sets, 0)), np.zeros((sets, 0))
    around = Around(potential, length // 2 + 1, shift)
    modes = Modes((1.0 + 1j * _STEP) / np.asarray(memory_lengths, dtype=float), around.nx + ORDER)
    rows = potential.aspect * np.arange(float(ny))
    found = _far(weights, around, modes, rows)
    first, last = (distance + around.nx - 1 for distance in near_cells(around.nx))
    before = modes.fading[:, first:0:-1]
    memory = near_memory(around, modes, rows)
    near = weights[:, :, : memory.shape[1]]
    found += np.tensordot(near[:, first : last + 1], memory, 2)
    # Farther behind it fades.
    for one, weight in zip(found, near[:, :first], strict=True):
        one += ((before @ weight) * memory[0].T).sum(axis=1)
    # ln λ is minus the logarithm of the rate.
    return found.real.copy(), -found.imag / _STEP


def _far(weights: Array, around: Around, modes: Modes, rows: Array) -> Inexact:
    """Return sums with the interpolation on the lattice and with what comes from beyond it: (k, m)."""
    sets, length, _ = weights.shape
    shared = _on_lattice(weights, around, rows)
    nodes = modes.interpolated.shape[1]
    padded = np.concatenate([shared, np.zeros((sets, nodes - 1))], axis=1)
    windows = np.lib.stride_tricks.sliding_window_view(padded, nodes, axis=1)
    tail, interpolation = beyond(around, modes, rows)
    behind = (weights @ interpolation.T)[:, ::-1]
    found = np.zeros((sets, len(modes.rate)), modes.rate.dtype)
    # Mode by mode, since a strip may have a hundred thousand cells.
    for m, (rate, interpolated, outside) in enumerate(zip(modes.rate, modes.interpolated, tail, strict=True)):
        fading = faded(rate * np.arange(shared.shape[1]))
        for k in range(sets):
            found[k, m] = (fading @ windows[k]) @ interpolated + (fading[1 : length + 1] @ behind[k]) @ outside
    return found


def _on_lattice(weights: Array, around: Around, rows: Array) -> Array:
    """Z(n) from the first node on: (k, 2 nx + nodes − 2)."""
    count = 2 * around.nx + ORDER - 2
    size = scipy.fft.next_fast_len(4 * around.nx + ORDER - 4, real=True)
    waves = np.zeros((len(weights), size // 2 + 1), complex)
    for start in range(0, len(rows), ROWS_AT_ONCE):
        piece = slice(start, start + ROWS_AT_ONCE)
        lattice = scipy.fft.rfft(around.lattice(rows[piece]), size, axis=1).T
        waves += (lattice * scipy.fft.rfft(weights[:, :, piece], size, axis=1).conj()).sum(axis=2)
    return np.asarray(scipy.fft.irfft(waves, size, axis=1)[:, :count])
