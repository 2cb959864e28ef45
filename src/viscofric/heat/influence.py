"""Influence of one heated cell on the temperature of a half-space or layer over which it moves.

Heat of 1 W/m² on a cell for a time t reaches the surface as the sum of what instantaneous sources left, each a product
of a function of x, of y and of the depth.  With the diffusion length l = √(4κt') of heat released t' ago, when the cell
was vt' behind where it is now ::

    T(X, Y) = 1/(k√π) ∫_0^{√(4κt)} dl m(l) · ½[erf(ξ/l)] · ½[erf(η/l)]

ξ = X + v l²/4κ and η = Y between the cell's edges, and m(l) = 1 on a half-space.  A layer of thickness H is a sum over
images: m = 1 + 2 Σ s^n exp(−4n²H²/l²), s = 1 if no heat leaves its base and −1 if its base stays at its temperature.
(H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids (1959), Secs. 10.3 and 14.2.)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, gauss
from viscofric.errors import InputError
from viscofric.thermal import ThermalProperties

# Gauss's rule on panels as long as l (e − 1), and as 4 widths of an edge that passes, 1/(2 sweep): exact to 1e-10.
_NODES, _PER_LOG, _PER_EDGE = 12, 1.7, 2.0
# The error function is one beyond: 1 − erf(5) = 2e-12.
_ONE = 5.0
#: At rest, the diffusion length up to which heat is summed, in sizes of the map; the rest is known to its square.
_FARTHEST = 1e4
#: Passage of the map in its size, over which heat has spread, below which a source is at rest: its error.
_AT_REST = 1e-9
#: Over the thickness, the diffusion length at which a base has taken all heat: exp(−(π l/4H)²) = 1e-32.
_THROUGH = 11.0


@dataclass(frozen=True)
class Diffusion:
    """How heat spreads in a body over which its source moves; `time` is since the heat began."""

    body: ThermalProperties
    speed: float  # m/s, not below zero
    time: float = math.inf
    thickness: float = math.inf
    insulated: bool = False  # the layer's base

    def __post_init__(self) -> None:
        if self.insulated and self.speed == 0.0 and math.isinf(self.time) and math.isfinite(self.thickness):
            raise InputError(
                "A source at rest or on a track warms a layer with an insulated base without end; give a time or a "
                "number of passes, or a base at constant temperature.",
                code="no-steady-state",
            )

    def influence(
        self, x: Array, y: Array, cell: tuple[float, float], depth: Callable[[Array], Array] | None = None
    ) -> Array:
        """Return the rise (nx, ny), K m²/W, at offsets x (nx,) and y (ny,) from a cell of the size given, all in m."""
        # With `depth`, which returns factors (k, n) of diffusion lengths (n,), such as exp(−z²/l²) for heat that is
        # released at a depth z in a half-space, the rise is (k, nx, ny). A cell of infinite width is a strip.
        half = 0.5 * cell[0], 0.5 * cell[1]
        if self.speed == 0.0 and math.isinf(half[1]):
            raise InputError("A strip of heat at rest has no steady temperature.", code="no-steady-state")
        extent = float(np.abs(x).max() + np.abs(y).max()) + 2.0 * max(one for one in half if math.isfinite(one))
        lengths, weights, last = self._lengths(half, extent)
        weights = weights * self.images(lengths)
        ahead = x[:, None] / lengths + self._sweep * lengths
        along = _between(ahead, half[0] / lengths)
        across = _between(y[:, None] / lengths, half[1] / lengths)
        rest = cell[0] * cell[1] / (math.pi * last) if math.isfinite(last) else 0.0
        if depth is None:
            summed = (along * weights) @ across.T + rest
        else:
            summed = np.stack([(along * one) @ across.T for one in weights * depth(lengths)]) + rest
        return np.asarray(summed / (float(self.body.conductivity) * math.sqrt(math.pi)))

    @property
    def _sweep(self) -> float:
        """v/(4κ), 1/m: over a diffusion length l the source moves by l² times this."""
        return self.speed / (4.0 * self.body.diffusivity)

    def _lengths(self, half: tuple[float, float], extent: float) -> tuple[Array, Array, float]:
        """Return l (n,), weights of dl, and the l from which cells at rest are points (infinite if none is)."""
        sweep, ends = self._sweep, [_FARTHEST * extent]
        if sweep * extent < _AT_REST and math.isfinite(half[1]):
            sweep = 0.0
        if sweep > 0.0:  # until all that the map sees comes from beyond it
            ends = [(_ONE + math.sqrt(_ONE**2 + 4.0 * sweep * extent)) / (2.0 * sweep)]
        rest = ends[0] if sweep == 0.0 else math.inf
        if math.isfinite(self.thickness) and not self.insulated:
            ends.append(_THROUGH * self.thickness)
        if math.isfinite(self.time):
            ends.append(math.sqrt(4.0 * self.body.diffusivity * self.time))
        last = min(ends)
        edges = [0.0, min(min(half) / (2.0 * _ONE), last)]
        while edges[-1] < last:
            step = _PER_LOG * edges[-1]
            edges.append(min(edges[-1] + (min(step, _PER_EDGE / sweep) if sweep > 0.0 else step), last))
        return *gauss(_NODES, edges), rest if last == rest else math.inf

    def images(self, lengths: Array) -> Array:
        """Return m(l) (n,); in a layer thinner than l from Poisson's sum, the same in waves across the layer."""
        found = np.ones_like(lengths)
        if math.isinf(self.thickness):
            return found
        ratio, n = self.thickness / lengths, np.arange(1, 5)
        thin = ratio < 1.0
        sign = 1.0 if self.insulated else -1.0
        found[~thin] += 2.0 * (sign**n * np.exp(-np.square(2.0 * n * ratio[~thin, None]))).sum(1)
        wave = np.pi * (np.arange(6) if self.insulated else np.arange(6) + 0.5)
        twice = np.where(wave == 0.0, 1.0, 2.0) * np.exp(-np.square(0.5 * wave / ratio[thin, None]))
        found[thin] = 0.5 * math.sqrt(math.pi) / ratio[thin] * twice.sum(1)
        return found


def _between(place: Array, half: Array) -> Array:
    """Return half the difference of the error function at both edges, from the side on which it is small."""
    from scipy.special import erf, erfc

    size = np.abs(place)
    near = 0.5 * (erf(size + half) - erf(size - half))
    return np.where(size - half > 0.5, 0.5 * (erfc(size - half) - erfc(size + half)), near)
