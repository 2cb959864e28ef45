"""Where the loss of a periodic contact is released: power in layers below the surface.

A wave q of a frictionless pressure p on a half-space of constant Poisson's ratio makes, along its own direction n in
the plane, across it, t, and down from the face, z ::

    σ_nn = −p (1 − qz) e^(−qz),  σ_zz = −p (1 + qz) e^(−qz),  σ_nz = i p qz e^(−qz),  σ_tt = −2ν p e^(−qz)

The loss per volume follows from these stresses as below a free contact (`viscofric.contact.fields.dissipation`).  Over
all depths a wave loses 2(1−ν²)/q (q·v) Im S |p|², the work of friction.
"""

from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING

import numpy as np
import scipy.fft

from viscofric.contact.fields.dissipation import power_density
from viscofric.heat.layers import LayeredHeat

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.arrays import Array, ComplexArray
    from viscofric.contact.fields.dissipation import Modes
    from viscofric.heat.layers import Waves


#: Step of ln z from depth to depth: that of temperatures below is 2 %, of the heat of each wave below 1e-4.
_STEP = 0.6
#: First and last depth, times the wave number of the shortest and of the longest wave.
_FIRST, _LAST = 0.2, 7.0
#: Waves are followed down to this qz, at which their stress is 3e-3 of the pressure: the loss changes by 1e-5.
_FADED = 8.0


def periodic_dissipation(
    pressure: Array,
    waves: Waves,
    modes: Modes,
    poisson_ratio: float,
    velocity: tuple[float, float],
    step: float = _STEP,
) -> LayeredHeat:
    """Return where the loss is released below a pressure (nx, ny), Pa, that moves at a velocity, m/s.

    `waves` are those of its grid; `step` is that of the logarithm of the depth.
    """
    loads, longest, shortest = waves.of(pressure), float(waves.magnitude[0]), float(waves.magnitude[-1])
    ahead = waves.q.T @ np.asarray(velocity)
    rate = np.abs(ahead)
    few = modes.merged(0.05 / float(rate.max()), 50.0 / float(rate[rate > 1e-12 * rate.max()].min()))
    count = 1 + math.ceil(math.log(_LAST / _FIRST * shortest / longest) / step)
    depths = _FIRST / shortest * np.exp(step * np.arange(count))
    weights = step * depths
    weights[0] *= 1.0 + 1.0 / math.expm1(step)  # all depths above, at which nothing has changed
    means, powers = [], []
    for depth, weight in zip(depths.tolist(), weights.tolist(), strict=True):
        points = _grid_of(waves, _FADED / depth)
        grid = waves.on(points)
        some = slice(grid.held)
        stress = grid.spread(_stress(waves.q[:, some], loads[some], depth, poisson_ratio)).astype(np.complex64)
        on_dashpot = functools.partial(_on_dashpot, stress, grid.spread(1j * ahead[some]), points)
        released = weight * scipy.fft.rfft2(power_density(on_dashpot, few, poisson_ratio).astype(float), norm="forward")
        means.append(released[0, 0].real)
        powers.append(grid.gathered(released))
    edges = np.concatenate([[0.0], depths * math.exp(0.5 * step)])
    return LayeredHeat(np.diff(edges), np.array(means), powers)


def _on_dashpot(stress: NDArray[np.complex64], ahead: ComplexArray, points: tuple[int, int], tau: float) -> Array:
    """Return the stress (6, nx, ny) that waves of stress leave on the dashpot of a mode; `ahead` are i q·v."""
    on_dashpot = stress * (ahead * tau / (ahead * tau - 1.0)).astype(stress.dtype)
    return np.asarray(scipy.fft.irfft2(on_dashpot, points, norm="forward"))


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
