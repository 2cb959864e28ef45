"""Waves of a periodic contact: response of a solid of unit compliance to each, and the turn of each.

Fields are multiplied wave by wave in the order of `scipy.fft.rfft2`, with one row more where the number of points along
x is even: the Nyquist wave along x stands for two that run opposite ways, and their memories differ.  Along y the real
transform adds the two senses by itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.bodies import Layer
from viscofric.contact.periodic.surface import hermitian_factor, wave_number
from viscofric.threads import threads_for


@dataclass(frozen=True, eq=False)
class Waves:
    """Waves of one grid on one solid."""

    shape: tuple[int, int]
    spacing: tuple[float, float]  # m
    poisson_ratio: float
    layer: Layer | None = None  # None for a half-space

    @cached_property
    def numbers(self) -> tuple[Array, Array]:
        """q_x as a column and q_y as a row, 1/m."""
        qx, qy = wave_number(self.shape, self.spacing)
        if self._has_two_senses:
            qx = np.concatenate([qx, -qx[self.shape[0] // 2, None]])
        return qx, qy

    @property
    def _has_two_senses(self) -> bool:
        return self.shape[0] % 2 == 0

    @property
    def response(self) -> Array:
        """Displacement under each wave of pressure for E = 1: 2(1−ν²)Θ(qH)/|q|, m; the mean that of a layer."""
        qx, qy = self.numbers
        magnitude = np.hypot(qx, qy)
        magnitude[0, 0] = 1.0
        found = 2.0 * (1.0 - self.poisson_ratio**2) / magnitude
        if self.layer is not None:
            found = found * self.layer.yielding(magnitude, self.poisson_ratio)
        found[0, 0] = 0.0 if self.layer is None else self.layer.mean_compression(self.poisson_ratio)
        return np.asarray(found)

    @property
    def rigid_factor(self) -> Array:
        """2/|q|, m: displacement of an elastic indenter for (1−ν²)/E = 1; zero for the mean."""
        magnitude = np.hypot(*self.numbers)
        magnitude[0, 0] = 1.0
        found = 2.0 / magnitude
        found[0, 0] = 0.0
        return np.asarray(found)

    @cached_property
    def weights(self) -> Array:
        """Weight of each wave in means over the grid of a product of two fields, |p̂|²."""
        nx, ny = self.shape
        found = np.broadcast_to(hermitian_factor(ny), (self.numbers[0].shape[0], ny // 2 + 1)).copy()
        if self._has_two_senses:
            found[[nx // 2, -1]] *= 0.5
        return np.asarray(found / float(nx * ny) ** 2)

    def turn(self, path: Array) -> Array:
        """Angle q·Δs by which each wave turns over a path (2,), m; one column or row where it is along an axis."""
        qx, qy = self.numbers
        if path[1] == 0.0:
            return np.asarray(path[0] * qx)
        return np.asarray(path[1] * qy + path[0] * qx if path[0] else path[1] * qy)

    def of(self, field: Array) -> ComplexArray:
        """Waves of a field (nx, ny)."""
        found = scipy.fft.rfft2(field, workers=threads_for(field.size))
        if self._has_two_senses:
            found = np.concatenate([found, found[self.shape[0] // 2, None]])
        return np.asarray(found)

    def folded(self, waves: NDArray[Any]) -> NDArray[Any]:
        """Waves with the two senses of a Nyquist wave joined: (nx, ny//2 + 1), of real and complex values."""
        if not self._has_two_senses:
            return waves
        nx = self.shape[0]
        found = waves[:nx].copy()
        found[nx // 2] = 0.5 * (waves[nx // 2] + waves[nx])
        return found

    def unfolded_field(self, waves: ComplexArray) -> Array:
        """Field (nx, ny) of folded waves, which are overwritten."""
        # One axis after the other: irfft2 would take a copy.
        threads = threads_for(2 * waves.size)
        lines = scipy.fft.ifft(waves, axis=0, overwrite_x=True, workers=threads)
        return np.asarray(scipy.fft.irfft(lines, self.shape[1], axis=1, workers=threads))
