"""The dissipated energy that the cells of a grid leave out, from a second balance.

Within the contact the surface follows the indenter, u = δ − h, so that besides the friction force

    F_t = −∫ p ∂u/∂x dA = Σ_k l_k B_k,      B_k = −∫ p ∂²y_k/∂x² dA

(y_k the displacement of mode k with its memory length l_k; see `ConvolutionOperator.dissipated_force`) there is
a sum of the same terms that is known beforehand,

    ∫ p ∂²h/∂x² dA = −∫ p ∂²u/∂x² dA = Σ_k B_k + B_∞ :

the load over the radius, for a ball.  On a grid it does not hold: at the rim, where pressures fall to zero like square
roots, waves shorter than a cell are missing from both sums.  The missing part follows from the gap.  With second
differences in place of the derivatives, only the gap that opens between the last loaded cell and the next remains:

    r = Σ_i p_i (g_{i+1} + g_{i−1}) / h²,      summed over loaded cells i next to free ones.

A mode's part of r contributes to the friction in proportion to its memory length l_k = λ_k h.  Of an edge where the
pressure rises like a square root, cells leave out the waves beyond about their own size: with a weight of
1/(q_c² + q²h²), q_c about 3, the part 1/(1 + q_c λ) of the bends of a mode, and for long memories a hundredth less, as
in Hertz's contact on cells to three percent for λ from 0.1 to 6, the mean over the places of an edge in a cell.  The
pressure's spectrum is that of a square root at the trailing edge, and over |S|² at the leading edge: the memory extends
behind (Wiener's and Hopf's factors of the compliance S).  The integrals over these waves are residues.  With

    s = S∞ + Σ_k C_k/(1 + q_c λ_k),      N = Σ_k N_k,      N_k = C_k l_k/(1 + q_c λ_k)

the friction and r are as N to s at the trailing edge, and as M to 1/s at the leading one, M = Σ_k N_k/(S_k S_{k−1}).
S_k is s where the modes up to k, from the shortest on, have all of C_k; the terms are nearly each mode's integrals.  (A
mode that is found from slopes has none.)  How strong the edges are follows from the parts f and b of r where the gap
opens ahead and behind, which are those of pressures on cells: with S_c the compliance that these find, the squares of
their strengths are as f S_c² to b, and

    Λ r = (f + b) (f S_c² M + b N)/(f S_c²/s + b s).

Where all memories are short against the cell, Λ is their mean and F_t = Λ ∫ p ∂²h/∂x² dA holds exactly, on any grid.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.contact.free.grids import Grid
from viscofric.contact.operators.convolution import SteadyMaterial, bent_share

# Wavenumber times the cell of the waves that decide how strong the pressure at either edge is on cells.
_RESOLVED = 0.4
# Part of the bends of a long memory that waves left out do not have after all, from Hertz's contact on cells.
_LESS = 0.008
_STEP = 1e-50


def openings(window: Grid, pressure: Array, gap: Array) -> tuple[float, float]:
    """Return f and b, of which r is the sum; the gap (nx, ny) is that of the contact conditions."""
    free, scale = free_gap(pressure, gap), window.cell_area / window.spacing**2
    return scale * float(np.vdot(pressure[:-1], free[1:])), scale * float(np.vdot(pressure[1:], free[:-1]))


def free_gap(pressure: Array, gap: Array) -> Array:
    """Return the gap at free cells, zero in the contact."""
    # Beyond the edge of a height map the gap is infinite; a contact that reaches it is refused.
    return np.where((pressure > 0.0) | np.isinf(gap), 0.0, np.maximum(gap, 0.0))


def neighbours(values: Array, lower: float = 1.0, upper: float = 1.0) -> Array:
    """Sum of the values in the cells at lower and at upper x beside each, times factors."""
    found = np.zeros_like(values)
    found[1:] += lower * values[:-1]
    found[:-1] += upper * values[1:]
    return found


def lag(material: SteadyMaterial, spacing: float, wave: float, rear: float) -> float:
    """Return Λ, the friction force per unit of r that is left out, where `rear` is b/(f + b).

    `spacing` is the length of a cell along the motion, `wave` the wavenumber q_c of about the longest waves left out,
    times the spacing.
    """
    order = np.argsort(material.memory_lengths)
    return float(_lag(_numbers(material, rear, order)[None], spacing, wave)[0])


class LagChanges(NamedTuple):
    """Derivatives of Λ."""

    rear: float  # with respect to b/(f + b)
    glassy: float  # to the compliance without memory
    compliances: Array  # (m,)
    memory_lengths: Array  # (m,)


def lag_changes(material: SteadyMaterial, spacing: float, wave: float, rear: float) -> LagChanges:
    """Return how Λ changes, by complex steps, which are exact to rounding; arguments as of `lag`."""
    order = np.argsort(material.memory_lengths)
    given, back = _numbers(material, rear, order), np.argsort(order)
    scale = np.concatenate([np.ones(2 + len(order)), material.memory_lengths[order]])  # lengths may be tiny
    changes = _lag(given + 1j * _STEP * np.diag(scale), spacing, wave).imag / (_STEP * scale)
    by_compliance, by_length = np.split(changes[2:], 2)
    return LagChanges(float(changes[0]), float(changes[1]), by_compliance[back], by_length[back])


def _numbers(material: SteadyMaterial, rear: float, order: NDArray[np.intp]) -> Array:
    glassy = material.glassy + material.counterface
    return np.concatenate([[rear, glassy], material.compliances[order], material.memory_lengths[order]])


def _lag(given: NDArray[Any], spacing: float, wave: float) -> NDArray[Any]:
    """Return Λ of rows (n, 2 + 2 m): b/(f + b), S∞, compliances, and memory lengths in ascending order."""
    rear, glassy = given[:, 0], given[:, 1]
    compliances, lengths = np.split(given[:, 2:], 2, axis=1)
    left, resolved = (1.0 / (1.0 + q / spacing * lengths) for q in (wave, _RESOLVED))
    bent = bent_share(lengths / spacing)
    force = bent * compliances * lengths * (left - _LESS * bent * (1.0 - left))
    s = glassy + (compliances * left).sum(axis=1)
    after = s[:, None] + np.cumsum(compliances * (1.0 - left), axis=1)
    before = after - compliances * (1.0 - left)
    strength = (1.0 - rear) * (glassy + (compliances * resolved).sum(axis=1)) ** 2
    lost = strength * (force / (before * after)).sum(axis=1) + rear * force.sum(axis=1)
    return np.asarray(lost / (strength / s + rear * s))
