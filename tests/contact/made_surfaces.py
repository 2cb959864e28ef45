"""Self-affine periodic surfaces from fixed seeds, for tests and benchmarks of rough contact."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def self_affine(
    points: int, *, hurst: float = 0.8, points_per_shortest_wave: float = 8.0, slope: float = 1.0, seed: int = 0
) -> NDArray[np.float64]:
    """Return heights of period 1 with a power spectrum q^(−2−2H) between the period and the shortest wave.

    `slope` is the rms of the gradient's length.
    """
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((points, points)))
    kx = np.fft.fftfreq(points, 1.0 / points)[:, None]
    ky = np.fft.rfftfreq(points, 1.0 / points)[None, :]
    k = np.hypot(kx, ky)
    k[0, 0] = 1.0
    noise *= np.where(k <= points / points_per_shortest_wave, k ** (-1.0 - hurst), 0.0)
    noise[0, 0] = 0.0
    slopes = [np.fft.irfft2(2j * np.pi * one * noise, (points, points)) for one in (kx, ky)]
    gradient = np.sqrt(np.mean(slopes[0] ** 2 + slopes[1] ** 2))
    return np.fft.irfft2(noise, (points, points)) * (slope / gradient)


def refined(z: NDArray[np.float64], points: int) -> NDArray[np.float64]:
    """Return the same square surface on more points, by its Fourier series."""
    waves = np.fft.fft2(z)
    k = np.fft.fftfreq(len(z), 1.0 / len(z)).astype(int)
    found = np.zeros((points, points), complex)
    found[np.ix_(k, k)] = waves
    return np.fft.ifft2(found).real * (points / len(z)) ** 2
