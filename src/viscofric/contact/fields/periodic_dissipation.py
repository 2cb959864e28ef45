"""Where the loss of a periodic contact is released: power in layers below the surface.

A wave q of a frictionless pressure p on a half-space of constant Poisson's ratio makes, along its own direction n in
the plane, across it, t, and down from the face, z ::

    σ_nn = −p (1 − qz) e^(−qz),  σ_zz = −p (1 + qz) e^(−qz),  σ_nz = i p qz e^(−qz),  σ_tt = −2ν p e^(−qz)

The loss per volume follows from these stresses as below a free contact (`viscofric.contact.fields.dissipation`).  Over
all depths a wave loses 2(1−ν²)/q (q·v) Im S |p|², the work of friction.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.fields.dissipation import Modes
from viscofric.heat.layers import LayeredHeat, Waves

#: Waves of pressure that are so much smaller than the largest one are none: contacts are not solved better.
_ROUNDING = 1e-9
#: Step of ln z from depth to depth: that of temperatures below is 2 %, of the heat of each wave below 1e-4.
_STEP = 0.6
#: First and last depth, times the wave number of the shortest and of the longest wave.
_FIRST, _LAST = 0.2, 7.0
#: Waves place the loss down to this qz, below which they lose 1/100 of their part.
_FADED = 4.0
#: Modes with which the loss is placed: the ratio of their times, and how far these go beyond the periods of the waves.
_TOGETHER, _MARGIN = 6.0, 4.0
#: Largest share of the loss in the first layer.
_TOP = 0.01
#: Heat of a layer over that of the waves that place it: the largest by which all is placed like theirs.
_PLACED = 2.0
#: Width in ln q of groups of waves that count as one for how much is lost, and frequencies of the loss compliance.
_GROUP, _POINTS = 0.01, 500


def periodic_dissipation(
    pressure: Array,
    waves: Waves,
    modes: Modes,
    poisson_ratio: float,
    velocity: tuple[float, float],
    step: float = _STEP,
) -> LayeredHeat:
    """Return where the loss is released below a pressure (nx, ny), Pa, that moves at a velocity, m/s.

    `waves` are those of its grid; `step` is that of the logarithm of the depth.  How much is lost in a layer follows
    from all waves, where from those that have not faded there, and from few modes.  The first layer has a
    hundredth of the loss at most.
    """
    loads, ahead = waves.of(pressure), waves.q.T @ np.asarray(velocity)
    loads[np.abs(loads) < _ROUNDING * np.abs(loads).max()] = 0.0
    longest, shortest, rate = float(waves.magnitude[0]), float(waves.magnitude[-1]), np.abs(ahead)
    fastest, slowest = float(rate.max()), float(rate[rate > 1e-12 * rate.max()].min())
    lost = _Lost.of(waves.magnitude, np.square(np.abs(loads)) * _loss_rate(rate, slowest, modes), poisson_ratio)
    count = 1 + math.ceil(math.log(_LAST / _FIRST * shortest / longest) / step)
    depths = _FIRST / shortest * np.exp(step * np.arange(count))
    below = np.array([lost.below(edge) for edge in (0.0, *(depths * math.exp(0.5 * step)).tolist())])
    first = max(0, int(np.searchsorted(-below, -(1.0 - _TOP) * below[0])) - 2)
    depths, below = depths[first:], np.delete(below, np.s_[1 : first + 1])
    few = modes.merged(1.0 / (_MARGIN * fastest), _MARGIN / slowest, _TOGETHER)
    powers, thickness = [], np.diff(depths * math.exp(0.5 * step), prepend=0.0)
    for depth, thick, mean in zip(depths.tolist(), thickness.tolist(), (-np.diff(below)).tolist(), strict=True):
        points = _grid_of(waves, _FADED / depth)
        grid = waves.on(points)
        some = slice(grid.held)
        stress = _components(_stress(waves.q[:, some], loads[some], depth, poisson_ratio), poisson_ratio)
        spread, turned = grid.spread(stress).astype(np.complex64), grid.spread(1j * ahead[some]).astype(np.complex64)
        power: Any = sum(
            C / tau * _squares(spread, turned * np.float32(tau), points) for C, tau in zip(*few, strict=True)
        )
        released = scipy.fft.rfft2(power.astype(float), norm="forward")
        # Where it is mostly that of waves that have faded, such as the shorter ones of a surface that repeats itself
        # within its period, it is nearly even.
        placed = max(thick * float(released[0, 0].real), mean / _PLACED, 1e-300)
        powers.append(thick * mean / placed * grid.gathered(released))
    return LayeredHeat(thickness, -np.diff(below), powers)


class _Lost(NamedTuple):
    """Loss of waves (n,) in groups of nearly equal length, as one wave each.

    At the depth d/q a wave loses (1 + ν) [2(1 − 2ν) + 4d²] e^(−2d) times |p|² ω Im S, and so does its opposite.
    """

    magnitude: Array
    power: Array  # |p|² ω Im S
    poisson_ratio: float

    @classmethod
    def of(cls, magnitude: Array, power: Array, poisson_ratio: float) -> _Lost:
        """Group waves that ascend by magnitude, with their |p|² ω Im S."""
        group = np.floor(np.log(magnitude / magnitude[0]) / _GROUP)
        starts = np.flatnonzero(np.diff(group, prepend=-1.0))
        total = np.add.reduceat(power, starts)
        mean = np.add.reduceat(power * magnitude, starts) / np.maximum(total, 1e-300)
        return cls(np.where(total > 0.0, mean, magnitude[starts]), total, poisson_ratio)

    def below(self, depth: float) -> float:
        """Return the mean loss below a depth."""
        d, ratio = self.magnitude * depth, self.poisson_ratio
        left = 2.0 * (1.0 + ratio) * (2.0 * (1.0 - ratio) + 2.0 * d + 2.0 * np.square(d)) * np.exp(-2.0 * d)
        return float(self.power @ (left / self.magnitude))


def _loss_rate(rate: Array, slowest: float, modes: Modes) -> Array:
    """Return ω Im S of waves (n,), 1/(Pa s)."""
    table = np.geomspace(0.5 * slowest, 2.0 * float(rate.max()), _POINTS)
    x = np.multiply.outer(table, modes.tau)
    logs = np.log(table * ((x / (1.0 + np.square(x))) @ modes.C))
    return np.where(rate < slowest, 0.0, np.exp(np.interp(np.log(np.maximum(rate, slowest)), np.log(table), logs)))


def _squares(stress: NDArray[np.complex64], turned: NDArray[np.complex64], points: tuple[int, int]) -> Array:
    """Return the sum of squares of what waves of components leave on the dashpot of a mode; `turned` are i q·v τ."""
    on_dashpot = scipy.fft.irfft2(stress * (turned / (turned - 1.0)), points, norm="forward")
    return np.asarray(np.einsum("ixy,ixy->xy", on_dashpot, on_dashpot))


def _components(stress: ComplexArray, poisson_ratio: float) -> ComplexArray:
    """Return five or six components whose squares sum up to (1 + ν) s:s − ν (tr s)² of stresses (6, n)."""
    xx, yy, zz = stress[:3]
    parts = [(xx - yy) / math.sqrt(2.0), (xx + yy - 2.0 * zz) / math.sqrt(6.0), *(math.sqrt(2.0) * stress[3:])]
    found = [math.sqrt(1.0 + poisson_ratio) * one for one in parts]
    trace = (1.0 - 2.0 * poisson_ratio) / 3.0
    return np.stack(found + ([math.sqrt(trace) * (xx + yy + zz)] if trace > 0.0 else []))


def _stress(q: Array, loads: ComplexArray, depth: float, poisson_ratio: float) -> ComplexArray:
    """Return the stresses xx, yy, zz, yz, xz and xy (6, n) at a depth below waves q (2, n) of pressure (n,)."""
    magnitude = np.hypot(*q)
    (along, across), down = q / magnitude, magnitude * depth
    faded = loads * np.exp(-down)
    nn, tt, nz = -(1.0 - down) * faded, -2.0 * poisson_ratio * faded, 1j * down * faded
    return np.stack(
        [
            along**2 * nn + across**2 * tt,
            across**2 * nn + along**2 * tt,
            -(1.0 + down) * faded,
            across * nz,
            along * nz,
            along * across * (nn - tt),
        ]
    )


def _grid_of(waves: Waves, highest: float) -> tuple[int, int]:
    """Return points of a grid of the same period that holds waves up to a wave number, no more than are there."""
    found = []
    for points, size in zip(waves.shape, waves.period, strict=True):
        needed = scipy.fft.next_fast_len(2 * math.ceil(highest * size / (2.0 * math.pi)) + 1, real=True)
        found.append(needed if needed < 0.8 * points else points)
    return found[0], found[1]
