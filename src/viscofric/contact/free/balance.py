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

A mode's part of r contributes to the friction in proportion to its memory length.  Waves of wavenumber q, which the
indenter bends equally whatever the solid, need pressures that are inversely proportional to the compliance S(q); those
left out therefore contribute to the friction force and to r in the ratio

    Λ = ∫ Im S/|S|² w dq / ∫ q Re S/|S|² w dq     over q > q_c,      w = q^−3

(the spectrum of a square-root edge), with q_c of about one over the cell.  Where all memories are short against the
cell, Λ is their mean and F_t = Λ ∫ p ∂²h/∂x² dA holds exactly, on any grid.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.arrays import gauss
from viscofric.contact.operators.convolution import bent_share

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.arrays import Array, ComplexArray
    from viscofric.contact.free.grids import Grid
    from viscofric.contact.operators.convolution import SteadyMaterial


# Gauss's rule for the wavenumber's logarithm beyond the cut, and the range that it covers; right to 1e-7 for E∞/E0 up
# to 1e4, to 3e-7 up to 1e8.
_LOGARITHMS, _WEIGHTS = gauss(80, (0.0, math.log(1e13)))


def opening(window: Grid, pressure: Array, gap: Array) -> float:
    """Return r, the part that cells leave out of ∫ p ∂²h/∂x² dA; the gap (nx, ny) is that of the contact conditions."""
    beside = neighbours(free_gap(pressure, gap))
    return window.cell_area * float(np.vdot(pressure, beside)) / window.spacing**2


def free_gap(pressure: Array, gap: Array) -> Array:
    """Return the gap at free cells, zero in the contact."""
    # Beyond the edge of a height map the gap is infinite; a contact that reaches it is refused.
    return np.where((pressure > 0.0) | np.isinf(gap), 0.0, np.maximum(gap, 0.0))


def neighbours(values: Array) -> Array:
    """Sum of the values in the cells before and behind each."""
    found = np.zeros_like(values)
    found[1:] += values[:-1]
    found[:-1] += values[1:]
    return found


def lag(material: SteadyMaterial, spacing: float, cut: float) -> float:
    """Return Λ, the friction force per unit of r that is left out.

    `spacing` is the length of a cell along the motion, `cut` the wavenumber of the longest wave left out times the
    spacing.
    """
    wavenumber, symbol, loss, weight = _left_out(material, spacing, cut)
    return float((wavenumber * loss) @ weight) / float((wavenumber * symbol.real) @ weight)


def _left_out(material: SteadyMaterial, spacing: float, cut: float) -> tuple[Array, ComplexArray, Array, Array]:
    """Return, of the waves beyond the cut: wavenumber, S, what of the loss is found from bends, over q, and weight."""
    wavenumber = cut / spacing * np.exp(_LOGARITHMS)
    lengths, symbol = material.memory_lengths, material.symbol(wavenumber)
    loss = (bent_share(lengths / spacing) * material.compliances * lengths) @ (
        1.0 / (1.0 + np.outer(lengths, wavenumber) ** 2)
    )
    weight = _WEIGHTS * (wavenumber * np.abs(symbol)) ** -2.0  # w q Δ(ln q) / |S|², without the constant
    return wavenumber, symbol, loss, weight


def lag_changes(material: SteadyMaterial, spacing: float, cut: float) -> tuple[float, Array, Array]:
    """Return the changes of Λ (see `lag`) with the glassy compliance, the modes' compliances and memory lengths."""
    wavenumber, symbol, loss, weight = _left_out(material, spacing, cut)
    lengths, compliances = material.memory_lengths, material.compliances
    share = bent_share(lengths / spacing)
    whole = float((wavenumber * symbol.real) @ weight)
    value = float((wavenumber * loss) @ weight) / whole
    # d(ab/c) with the weight's logarithm −2 Re(dS/S): by a change of S, and by one of the loss.
    by_loss = wavenumber * weight / whole
    twice = 2.0 * by_loss * (loss - value * symbol.real) / np.abs(symbol) ** 2

    def by_symbol(change: NDArray[Any]) -> Array:
        return np.asarray(-(change * symbol.conj()).real @ twice - value * (change.real @ by_loss))

    wave = 1.0 / (1.0 - 1j * np.outer(lengths, wavenumber))
    size = np.abs(wave) ** 2
    lost = (size @ by_loss) * lengths
    by_compliance = by_symbol(wave) + share * lost
    # ∂(l/(1 + q²l²))/∂ ln l, and the change of the mode's part, both per length
    change = lengths * (size * (2.0 * size - 1.0) @ by_loss) - 2.0 * (1.0 - share) * lost
    by_length = compliances * share * change / lengths
    by_length += by_symbol((1j * wavenumber * wave**2) * compliances[:, None])
    return float(by_symbol(np.ones_like(symbol))), by_compliance, by_length
