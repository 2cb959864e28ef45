"""Wave numbers of the discrete real Fourier transform of a periodic grid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array


def wave_number(shape: tuple[int, int], spacing: tuple[float, float]) -> tuple[Array, Array]:
    """Return q_x as a column and q_y as a row, 1/m, in the order of `scipy.fft.rfft2`.

    The Nyquist waves, where there are any, have positive wave numbers.
    """
    qx = 2.0 * np.pi * np.abs(np.fft.fftfreq(shape[0], spacing[0])) * _signs(shape[0])
    qy: Array = 2.0 * np.pi * np.fft.rfftfreq(shape[1], spacing[1]).astype(np.float64)
    return qx[:, None], qy[None, :]


def _signs(points: int) -> Array:
    index = np.arange(points)
    return np.where(index > points // 2, -1.0, 1.0)


def without_nyquist(wave_numbers: Array, points: int) -> Array:
    """Return wave numbers with the Nyquist wave's set to zero, as the derivative of a real series wants it."""
    found = wave_numbers.copy()
    if points % 2 == 0:
        found.reshape(-1)[points // 2] = 0.0
    return found


def hermitian_factor(points: int) -> Array:
    """Return how often each wave of a real transform stands for one of the full one: once or twice."""
    factor = np.full(points // 2 + 1, 2.0)
    factor[0] = 1.0
    if points % 2 == 0:
        factor[-1] = 1.0
    return factor
