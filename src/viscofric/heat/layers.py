"""Rise of temperature of a half-space by heat of a rough surface on its face and in layers below it.

Heat that moves at v over a half-space whose surface is insulated raises the temperature, for each of its waves, by ::

    T(z) = 1/(2 k s) ∫ dz' [exp(−s|z − z'|) + exp(−s(z + z'))] w(z'),    s² = q² − i q·v/κ

(H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids (1959), Sec. 10.7).  Heat of a layer is uniform across it, so
that integrals over both depths are closed forms: what passes the layers' edges upwards and downwards follows from edge
to edge.  The mean of the heat has no steady state and is left out.

A map of one period stands for a surface whose spots do not follow one another in the same tracks: its spectrum is
continuous, and each of its waves for all frequencies q·v between those of its neighbours.  Where the response changes
within such an interval, next to q·v = 0, it is averaged over it.  Strictly periodic heat would warm its tracks without
limit, as a rough surface does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import scipy.fft

from viscofric.arrays import Array, ComplexArray, Indices, gauss
from viscofric.thermal import ThermalProperties

#: Frequencies, over their interval, up to which responses are averaged.
_AVERAGED = 2.5
#: Gauss's nodes of each half of the interval, in this power of which they are: responses change as its logarithm does.
_NODES, _POWER = 16, 6


@dataclass(frozen=True)
class Waves:
    """The waves of maps of a period (lx, ly), m, on (nx, ny) points, from the longest to the shortest.

    Without the mean, those of the Nyquist frequency, and one of each pair of opposite ones.
    """

    shape: tuple[int, int]
    period: tuple[float, float]

    @cached_property
    def _sorted(self) -> tuple[Indices, Array, Array]:
        nx, ny = self.shape
        along, across = np.meshgrid(np.fft.fftfreq(nx, 1.0 / nx), np.fft.rfftfreq(ny, 1.0 / ny), indexing="ij")
        q = 2.0 * np.pi * np.stack([along / self.period[0], across / self.period[1]]).reshape(2, -1)
        twice = ((across > 0.0) | (along > 0.0)).ravel()
        kept = np.flatnonzero(twice & (2.0 * np.abs(along) < nx).ravel() & (2.0 * across < ny).ravel())
        magnitude = np.hypot(*q[:, kept])
        order = np.argsort(magnitude, kind="stable")
        return kept[order], q[:, kept[order]], magnitude[order]

    @property
    def q(self) -> Array:
        """Wave numbers along x and y (2, n), 1/m."""
        return self._sorted[1]

    @property
    def magnitude(self) -> Array:
        """Wave numbers (n,), 1/m."""
        return self._sorted[2]

    def of(self, values: Array) -> ComplexArray:
        """Return the Fourier coefficients (n,) of a map (nx, ny)."""
        return np.asarray(scipy.fft.rfft2(values, norm="forward").ravel()[self._sorted[0]])

    def on(self, points: tuple[int, int]) -> CoarserGrid:
        """Return a grid of as many points or fewer, on which it has the longest waves."""
        n = [np.rint(q * size / (2.0 * np.pi)).astype(np.intp) for q, size in zip(self.q, self.period, strict=True)]
        outside = np.flatnonzero((2 * np.abs(n[0]) >= points[0]) | (2 * n[1] >= points[1]))
        count = int(outside[0]) if len(outside) else len(self.magnitude)
        return CoarserGrid(points, count, n[0][:count], n[1][:count])


class CoarserGrid(NamedTuple):
    """The first waves, so many as are `held`, on a grid of points: how often they fit into the period along x and y."""

    points: tuple[int, int]
    held: int
    along: Indices
    across: Indices

    def spread(self, waves: ComplexArray) -> ComplexArray:
        """Return waves (..., n) in the order of `scipy.fft.rfft2`, with their opposites."""
        found = np.zeros((*waves.shape[:-1], self.points[0], self.points[1] // 2 + 1), complex)
        found[..., self.along, self.across] = waves
        level = np.flatnonzero(self.across == 0)
        found[..., -self.along[level], 0] = np.conj(waves[..., level])
        return found

    def gathered(self, spectrum: ComplexArray) -> ComplexArray:
        """Return the waves (n,) of a spectrum in the order of `scipy.fft.rfft2`."""
        return np.asarray(spectrum[self.along, self.across])


class LayeredHeat(NamedTuple):
    """Heat of layers from the face down, W/m²: their thickness (n,), m, mean heat (n,), and waves, the longest ones."""

    thickness: Array
    mean: Array
    waves: list[ComplexArray]

    @property
    def unit(self) -> LayeredHeat:
        """The same distribution of a heat of 1 W/m² in all; none remains none."""
        total = float(self.mean.sum()) or 1.0
        return LayeredHeat(self.thickness, self.mean / total, [one / total for one in self.waves])


class Rises(NamedTuple):
    """Mean rises per mean heat, K m²/W: of the face and of layers, by heat on the face and in layers.

    Each mean is weighted, that of layers with their own heat.
    """

    surface: float
    loss: float
    surface_below: float
    loss_below: float


@dataclass(frozen=True)
class MovingHeat:
    """Heat of a rough surface that moves at a velocity, m/s, over a body."""

    body: ThermalProperties
    waves: Waves
    velocity: tuple[float, float]

    def surface_rise(self, flux: ComplexArray, face: ComplexArray) -> float:
        """Return the mean rise of the face, weighted, by heat on it; waves (n,) of heat and weight of mean 1."""
        found = sum(_mean(face[chosen], shares @ (flux[chosen] / roots)) for chosen, roots, shares in self._roots())
        return found / float(self.body.conductivity)

    def rises(self, flux: ComplexArray, face: ComplexArray, layers: LayeredHeat) -> Rises:
        """Return all mean rises by heat on the face and in layers, with the weights of the face; mean 1 of each."""
        total = np.zeros(4)
        counts = np.array([len(one) for one in layers.waves])
        for chosen, roots, shares in self._roots():
            ends = np.searchsorted(chosen, counts)
            below = [one[chosen[:end]] for one, end in zip(layers.waves, ends, strict=True)]
            total += _rises(roots, shares, layers.thickness, flux[chosen], face[chosen], below)
        return Rises(*(total / float(self.body.conductivity)).tolist())

    def _roots(self) -> list[tuple[Indices, ComplexArray, Array]]:
        """Return which waves (n,) have the roots s (m, n), 1/m, that follow, and the shares (m,) in their average."""
        ahead = self.waves.q.T @ np.asarray(self.velocity)
        interval = (
            2.0
            * np.pi
            * sum(
                abs(speed) / size
                for speed, size, points in zip(self.velocity, self.waves.period, self.waves.shape, strict=True)
                if points > 1
            )
        )
        near = np.abs(ahead) <= _AVERAGED * interval
        square = np.square(self.waves.magnitude)
        diffusivity = self.body.diffusivity

        def roots(chosen: Indices, offsets: Array) -> ComplexArray:
            return np.asarray(np.sqrt(square[chosen] - 1j * (ahead[chosen] + offsets[:, None]) / diffusivity))

        once = np.zeros(1), np.ones(1)
        every, averaged = np.flatnonzero(~near), np.flatnonzero(near)
        found = [(every, roots(every, once[0]), once[1])] if len(every) else []
        if interval == 0.0:
            return [*found, (averaged, roots(averaged, once[0]), once[1])]
        place, weight = gauss(_NODES)
        shares = 0.5 * weight * _POWER * place ** (_POWER - 1)
        offsets = 0.5 * interval * place**_POWER
        return [
            *found,
            (averaged, roots(averaged, np.concatenate([-offsets, offsets])), np.concatenate([shares, shares])),
        ]


def _rises(
    roots: ComplexArray,
    shares: Array,
    thickness: Array,
    flux: ComplexArray,
    face: ComplexArray,
    layers: list[ComplexArray],
) -> Array:
    """Return k times the rises (4,) as in `Rises`, averaged over the roots (m, n) of waves with their shares (m,)."""
    # Layers have heat of the first waves only, deeper ones of fewer.
    passed = [np.exp(-roots[:, : len(one)] * thick) for one, thick in zip(layers, thickness, strict=True)]
    mean = [(1.0 - one) / (roots[:, : one.shape[1]] * thick) for one, thick in zip(passed, thickness, strict=True)]
    # What passes the lower edge of each layer upwards.
    from_below = [np.zeros((len(roots), 0), complex)]
    for one, part, heat in zip(passed[:0:-1], mean[:0:-1], layers[:0:-1], strict=True):
        risen = part * heat
        deeper = from_below[0].shape[1]
        risen[:, :deeper] += from_below[0] * one[:, :deeper]
        from_below.insert(0, risen)
    emitted = mean[0] * layers[0]
    deeper = from_below[0].shape[1]
    emitted[:, :deeper] += from_below[0] * passed[0][:, :deeper]
    held = emitted.shape[1]
    total = np.array(
        [
            _mean(face, shares @ (flux / roots)),
            _mean(face[:held], shares @ (emitted / roots[:, :held])),
            0.0,
            0.0,
        ]
    )
    # Downwards through the upper edge: heat of the face, and of layers above with that which the face reflects.
    entered, down = 2.0 * flux, emitted
    for one, part, heat, up, thick in zip(passed, mean, layers, from_below, thickness, strict=True):
        held, deeper = len(heat), up.shape[1]
        entered, down = entered[..., :held], down[:, :held]
        weighted = shares[:, None] * np.conj(heat) / roots[:, :held]
        through = weighted * part
        total[2] += float(np.sum(through * entered).real)
        own = down.copy()
        own[:, :deeper] += up
        total[3] += float(np.sum(through * own + 2.0 / thick * weighted * (1.0 - part) / roots[:, :held] * heat).real)
        entered, down = entered * one, down * one + heat * part
    return total


def _mean(one: ComplexArray, other: ComplexArray) -> float:
    """Return the mean over the plane of the product of two maps, given by their waves."""
    return 2.0 * float(np.vdot(one, other).real)
