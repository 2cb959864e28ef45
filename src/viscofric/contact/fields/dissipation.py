"""Where the loss of a steady contact is released: power per volume below the surface.

In a half-space of constant Poisson's ratio the stress follows from the pressure alone.  A mode of the creep compliance
is a spring 1/C in parallel with a dashpot, on which the stress s = σ − y acts, τ dy/dt = s; it turns into heat ::

    w = Σ_k C_k/τ_k [(1 + ν) s_k : s_k − ν (tr s_k)²]

Along the motion dy/dt = −v dy/dx, so that s_k = −iqvτ_k/(1 − iqvτ_k) σ for each wave q.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy.fft

from viscofric.contact.fields.subsurface import line_stress, stress_layer

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array

#: Depths in contact radii: Gauss's rule for ζ in z = ζ/(1 − ζ).
_DEPTHS = 6
#: Ratio of the times of modes that stand for a denser spectrum; and on cells, where the loss is only shared out.
_TOGETHER, _ON_CELLS = 2.5, 4.0


class Modes(NamedTuple):
    """Compliances (n,), 1/Pa, and retardation times (n,), s, at the temperature of the contact."""

    C: Array
    tau: Array

    def merged(self, shortest: float, longest: float, ratio: float = _TOGETHER) -> Modes:
        """Return few modes with the same loss at times between these, and its power laws beyond.

        Those of a spectrum denser than a ratio of times are replaced by others at it, whose loss is fitted to theirs:
        to a few parts in a thousand at 2.5, to 2 to 4 % at 4.
        """
        from scipy.optimize import nnls

        lossy = self.C > 0.0
        C, tau = self.C[lossy], self.tau[lossy]
        held = np.clip(tau, shortest, longest)
        times, place = np.unique(held, return_inverse=True)
        # Faster modes lose C τ ω², slower ones C/τ.
        weight = np.bincount(place, C * np.minimum(tau / held, held / tau)).astype(np.float64)
        found = Modes(weight, times)
        span = math.log(longest / shortest)
        few = np.geomspace(shortest, longest, 1 + math.ceil(span / math.log(ratio)))
        if len(times) <= len(few):
            return found
        frequency = np.geomspace(1.0 / longest, 1.0 / shortest, 8 * len(few))
        relative = _loss(frequency, few) / (_loss(frequency, times) @ found.C)[:, None]
        unit = float(relative.max())
        fitted = nnls(relative / unit, np.ones(len(frequency)))[0] / unit
        return Modes(fitted[fitted > 0.0], few[fitted > 0.0])


def _loss(frequency: Array, tau: Array) -> Array:
    """Return ωτ/(1 + ω²τ²), (n, m)."""
    x = np.multiply.outer(frequency, tau)
    return np.asarray(x / (1.0 + np.square(x)))


class Dissipation(NamedTuple):
    """Power of the layers at some depths.

    `power` (nz, nx, ny) is that of each cell and of the depths that a node stands for, in W (in W/m of a line contact,
    with ny = 1); `depth` and `thickness` (nz,) of these depths in m.
    """

    depth: Array
    thickness: Array
    power: Array


def dissipation(
    x: Array, y: Array, pressure: Array, modes: Modes, poisson_ratio: float, speed: float, size: float
) -> Dissipation:
    """Return where the loss is released below the cells of a contact that moves towards +x.

    `pressure` (nx, ny), Pa, on cell centres x (nx,) and y (ny,), m, should have room for the loss behind the contact;
    `speed` above zero, m/s; `size` is the contact radius or half-width, m.
    """
    node, weight = np.polynomial.legendre.leggauss(_DEPTHS)
    share = 0.5 * (1.0 + node)
    depths = size * share / (1.0 - share)
    thickness = 0.5 * weight * size / np.square(1.0 - share)
    step = x[1] - x[0]
    area = step if len(y) == 1 else step * (y[1] - y[0])
    few = modes.merged(0.05 * size / speed, 50.0 * size / speed, _ON_CELLS)
    layers = []
    for depth in depths:
        if len(y) == 1:
            found = line_stress(x, pressure, [depth], poisson_ratio)
        else:
            found = stress_layer(x, y, pressure, float(depth), poisson_ratio)
        stress = np.stack([found.xx, found.yy, found.zz, found.yz, found.xz, found.xy])
        layers.append(_density(stress, step / speed, few, poisson_ratio))
    return Dissipation(depths, thickness, np.stack(layers) * (area * thickness)[:, None, None])


def _density(stress: Array, step: float, modes: Modes, poisson_ratio: float) -> Array:
    """Return w (nx, ny) from stress components (6, nx, ny) on cells that the contact passes in steps of time.

    In single precision, whose error is far below that of the cells.
    """
    nx = stress.shape[1]
    padded = scipy.fft.next_fast_len(2 * nx, real=True)
    spectrum = scipy.fft.rfft(stress.astype(np.float32), padded, axis=1)
    rate = -2.0j * np.pi * scipy.fft.rfftfreq(padded, step)[:, None]

    def on_dashpot(tau: float) -> Array:
        response = (rate * tau / (1.0 + rate * tau)).astype(np.complex64)
        return np.asarray(scipy.fft.irfft(spectrum * response, padded, axis=1)[:, :nx])

    return power_density(on_dashpot, modes, poisson_ratio)


def power_density(on_dashpot: Callable[[float], Array], modes: Modes, poisson_ratio: float) -> Array:
    """Return w (...), W/m³, from the stress (6, ...) on the dashpot of a mode with a retardation time."""
    total: Array | float = 0.0
    for C, tau in zip(*modes, strict=True):
        stress = on_dashpot(float(tau))
        normal, shear = stress[:3], stress[3:]
        squares = np.square(normal).sum(0) + 2.0 * np.square(shear).sum(0)
        total = total + C / tau * ((1.0 + poisson_ratio) * squares - poisson_ratio * np.square(normal.sum(0)))
    return np.asarray(total)
