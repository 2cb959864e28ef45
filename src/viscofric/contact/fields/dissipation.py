"""Where the loss of a steady contact is released: power per volume below the surface.

In a half-space of constant Poisson's ratio the stress follows from the pressure alone.  A mode of the creep compliance
is a spring 1/C in parallel with a dashpot, on which the stress s = σ − y acts, τ dy/dt = s; it turns into heat ::

    w = Σ_k C_k/τ_k [(1 + ν) s_k : s_k − ν (tr s_k)²]

Along the motion dy/dt = −v dy/dx: from the front to the rear s_k follows the stress step by step, as exactly as the
stress is linear between two cells.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy.fft

from viscofric.arrays import Array, gauss, non_negative_fit
from viscofric.contact.fields.stress import rectangle_corners, strip_ends
from viscofric.contact.fields.subsurface import line_stress, stress_layer

#: Depths in contact radii: Gauss's rule for ζ in z = ζ/(1 − ζ).
_DEPTHS = 6
#: Ratio of the times of modes that stand for a denser spectrum; and on cells, where the loss is only shared out.
_TOGETHER, _ON_CELLS = 2.5, 4.0
#: Places ahead of the cells, whose distance grows from step to step by this factor.
_AHEAD, _GROWTH = 10, 1.8


class Modes(NamedTuple):
    """Compliances (n,), 1/Pa, and retardation times (n,), s, at the temperature of the contact."""

    C: Array
    tau: Array

    def merged(self, shortest: float, longest: float, ratio: float = _TOGETHER) -> Modes:
        """Return few modes with the same loss at times between these, and its power laws beyond.

        Those of a spectrum denser than a ratio of times are replaced by others at it, whose loss is fitted to theirs:
        to a few parts in a thousand at 2.5, to 2 to 4 % at 4.
        """
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
        fitted = non_negative_fit(relative, np.ones(len(frequency)))
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

    `pressure` (nx, ny), Pa, on cell centres x (nx,) and y (ny,), m; `speed` above zero, m/s; `size` is the contact
    radius or half-width, m.  The memory of the stress ahead of the cells is included, but not the loss released ahead
    of, beside or behind them: the sum is less than the work of friction.
    """
    share, weight = gauss(_DEPTHS)
    depths = size * share / (1.0 - share)
    thickness = weight * size / np.square(1.0 - share)
    step, width = float(x[1] - x[0]), float(y[1] - y[0]) if len(y) > 1 else 1.0
    few = modes.merged(0.05 * size / speed, 50.0 * size / speed, _ON_CELLS)
    ahead = x[-1] + step * (_GROWTH ** np.arange(_AHEAD + 1.0) - 1.0)[::-1]
    layers = []
    for depth in depths.tolist():
        if len(y) == 1:
            found = line_stress(x, pressure, [depth], poisson_ratio)
        else:
            found = stress_layer(x, y, pressure, depth, poisson_ratio)
        stress = _components(np.stack([found.xx, found.yy, found.zz, found.yz, found.xz, found.xy]), poisson_ratio)
        farther = _components(_stress_ahead(ahead[:-1], x, y, pressure, depth, poisson_ratio), poisson_ratio)
        ending = np.concatenate([farther, stress[:, -1:]], axis=1)
        layers.append(_passing(stress[:, ::-1], ending, step / speed, -np.diff(ahead) / speed, few)[::-1])
    power = np.stack(layers) * (step * width * thickness)[:, None, None]
    return Dissipation(depths, thickness, power)


def _stress_ahead(ahead: Array, x: Array, y: Array, pressure: Array, depth: float, poisson_ratio: float) -> Array:
    """Return the stress components (6, n, ny) at places ahead of the contact, by its load on one rectangle."""
    edges = []
    for places, loads in ((x, pressure.sum(1)), (y, pressure.sum(0))):
        middle = float(loads @ places / loads.sum())
        half = math.sqrt(3.0 * float(loads @ np.square(places - middle) / loads.sum()))
        edges.append(middle + np.array([half, -half]))
    along = ahead[:, None] - edges[0]
    if len(y) == 1:
        step = float(x[1] - x[0])
        ends = strip_ends(along, depth, poisson_ratio)
        load = float(pressure.sum()) * step
        return np.asarray(load / np.ptp(edges[0]) * (ends[..., 1] - ends[..., 0])[..., None])
    across = y[:, None] - edges[1]
    corners = rectangle_corners(along[:, None, :, None], across[:, None, :], depth, poisson_ratio)
    load = float(pressure.sum()) * float(x[1] - x[0]) * float(y[1] - y[0])
    return np.asarray(
        load / (np.ptp(edges[0]) * np.ptp(edges[1])) * np.diff(np.diff(corners, axis=3), axis=4)[..., 0, 0]
    )


def _components(stress: Array, poisson_ratio: float) -> Array:
    """Return components (6, …) of stresses (6, …), the sum of whose squares is (1 + ν) s:s − ν (tr s)²."""
    share = (1.0 - math.sqrt((1.0 - 2.0 * poisson_ratio) / (1.0 + poisson_ratio))) / 3.0
    normal = stress[:3] - share * stress[:3].sum(0)
    return np.asarray(math.sqrt(1.0 + poisson_ratio) * np.concatenate([normal, math.sqrt(2.0) * stress[3:]]))


def _passing(stress: Array, before: Array, step: float, steps: Array, modes: Modes) -> Array:
    """Return w (nx, ny) of the components (6, nx, ny) that follow one another at a step of time, linearly in between.

    `before` (6, n, ny) came first, at the `steps` (n − 1,), and ends with the first of `stress`.  Each mode follows
    exactly: in a step h, s = a + (s₀ − a) e^(−t/τ), a = τ dσ/dt.
    """
    change = np.diff(stress, axis=1)
    even = np.square(change).sum(0)
    energy = np.zeros(stress.shape[1:])
    count = change.shape[1]
    length = scipy.fft.next_fast_len(2 * count, real=True)
    waves = scipy.fft.rfft(change, length, axis=1)  # what follows a change of the stress fades, by convolution
    for C, tau in zip(*modes, strict=True):
        on = np.zeros_like(stress[:, 0])
        for row, time in enumerate(steps.tolist()):
            left = math.exp(-time / tau)
            on = left * on + tau / time * (1.0 - left) * (before[:, row + 1] - before[:, row])
        left, ratio = math.exp(-step / tau), tau / step
        rest = 1.0 - left
        fading = left ** np.arange(count)
        kernel = scipy.fft.rfft(ratio * rest * np.append(0.0, fading[:-1]), length)
        later = scipy.fft.irfft(kernel[:, None] * waves, length, axis=1)[:, :count]
        first = fading[:, None] * on[:, None] + later
        twice = 0.5 * tau * (1.0 - left**2)
        each = (
            np.square(ratio) * even * (step - 2.0 * tau * rest + twice)
            + 2.0 * ratio * (change * first).sum(0) * (tau * rest - twice)
            + np.square(first).sum(0) * twice
        )
        energy[:-1] += 0.5 * C / tau * each
        energy[1:] += 0.5 * C / tau * each
    return energy / step
