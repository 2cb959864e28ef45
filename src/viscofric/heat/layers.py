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
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy.fft

if TYPE_CHECKING:
    from viscofric.arrays import Array, ComplexArray, Indices
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
        """The same distribution of a heat of 1 W/m² in all."""
        total = float(self.mean.sum())
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
        return sum(share * _mean(face[chosen], flux[chosen] / root) for chosen, root, share in self._roots()) / float(
            self.body.conductivity
        )

    def rises(self, flux: ComplexArray, face: ComplexArray, layers: LayeredHeat) -> Rises:
        """Return all mean rises by heat on the face and in layers, with the weights of the face; mean 1 of each."""
        total = np.zeros(4)
        counts = np.array([len(one) for one in layers.waves])
        for chosen, root, share in self._roots():
            ends = np.searchsorted(chosen, counts)
            below = [one[chosen[:end]] for one, end in zip(layers.waves, ends, strict=True)]
            on_face, met = _rises(root, layers.thickness, flux[chosen], below, released=False)
            from_layers, met_layers = _rises(root, layers.thickness, None, below, released=True)
            total += share * np.array(
                [
                    _mean(face[chosen], on_face),
                    _mean(face[chosen], from_layers),
                    sum(map(_mean, below, met)),
                    sum(map(_mean, below, met_layers)),
                ]
            )
        return Rises(*(total / float(self.body.conductivity)).tolist())

    def _roots(self) -> list[tuple[Indices, ComplexArray, float]]:
        """Return which waves have the roots s that follow, 1/m, and their share in the average."""
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

        def roots(chosen: Indices, offset: float) -> ComplexArray:
            return np.asarray(np.sqrt(square[chosen] - 1j * (ahead[chosen] + offset) / diffusivity))

        every, averaged = np.flatnonzero(~near), np.flatnonzero(near)
        found = [(every, roots(every, 0.0), 1.0)] if len(every) else []
        if interval == 0.0:
            return [*found, (averaged, roots(averaged, 0.0), 1.0)]
        node, weight = np.polynomial.legendre.leggauss(_NODES)
        place = 0.5 * (1.0 + node)
        shares = 0.25 * weight * _POWER * place ** (_POWER - 1)
        for offset, share in zip(0.5 * interval * place**_POWER, shares, strict=True):
            found += [(averaged, roots(averaged, sense * offset), float(share)) for sense in (-1.0, 1.0)]
        return found


def _rises(
    root: ComplexArray, thickness: Array, flux: ComplexArray | None, layers: list[ComplexArray], *, released: bool
) -> tuple[ComplexArray, list[ComplexArray]]:
    """Return k times the waves of the rise of the face, and of its mean over each layer, of as many as it has.

    By heat on the face, or by that `released` in layers.
    """
    passed = [np.exp(-root[: len(one)] * thick) for one, thick in zip(layers, thickness, strict=True)]
    mean = [(1.0 - one) / (root[: len(one)] * thick) for one, thick in zip(passed, thickness, strict=True)]
    met: list[ComplexArray] = []
    up = np.zeros(0, complex)
    for row in reversed(range(len(layers))):
        up = np.pad(up, (0, len(layers[row]) - len(up)))
        met.insert(0, up)
        if released:
            up = up * passed[row] + layers[row] * mean[row]
    up = np.pad(up, (0, len(root) - len(up)))
    down = up if flux is None else up + 2.0 * flux
    face = 0.5 * (up + down) / root
    for row, thick in enumerate(thickness):
        down, some = down[: len(layers[row])], root[: len(layers[row])]
        found = (down + met[row]) * mean[row]
        down = down * passed[row]
        if released:
            found = found + 2.0 * layers[row] * (1.0 - mean[row]) / (some * thick)
            down = down + layers[row] * mean[row]
        met[row] = 0.5 * found / some
    return face, met


def _mean(one: ComplexArray, other: ComplexArray) -> float:
    """Return the mean over the plane of the product of two maps, given by their waves."""
    return 2.0 * float(np.vdot(one, other).real)
