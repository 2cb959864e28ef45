"""Real two-dimensional FFTs of several libraries behind one face, zero-padded ones without their empty lines."""

from __future__ import annotations

import math
from functools import lru_cache, partial
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from viscofric.threads import threads_for

AnyArray: TypeAlias = NDArray[Any]


Shape: TypeAlias = tuple[int, int]


# Bytes of a spectrum from which on it is worked through in blocks, and bytes of a block: about a half of the cache
# that a core has to itself.
_LARGE, _BLOCK = 2**22, 2**19
# Cosines up to which a product of matrices is as quick as a fast transform, and lets lines along x lie together.
_FEW_COSINES = 128


class Transforms:
    """FFTs of the array standard's ``fft`` namespace: PyTorch, CuPy and whatever else has one.

    Spectra are (nx, ny//2 + 1).  What is transformed back may be overwritten.
    """

    def __init__(self, fft: Any) -> None:
        self._fft = fft

    def forward(self, values: Any) -> Any:
        """Spectrum of real values."""
        return self._fft.rfftn(values, axes=(0, 1))

    def inverse(self, spectrum: Any, shape: Shape) -> Any:
        """Real values of the given shape."""
        return self._fft.irfftn(spectrum, s=shape, axes=(0, 1))

    def forward_padded(self, values: Any, padded: Shape) -> Any:
        """Spectrum of real values with zeros behind them up to a shape; zeros are not transformed along y."""
        return self._fft.fft(self._fft.rfft(values, n=padded[1], axis=1), n=padded[0], axis=0)

    def inverse_cropped(self, spectrum: Any, padded: Shape, shape: Shape) -> Any:
        """First `shape` of the real values whose spectrum, of the padded shape, is given."""
        lines = self._fft.ifft(spectrum, axis=0)[: shape[0], :]
        return self._fft.irfft(lines, n=padded[1], axis=1)[:, : shape[1]]

    def convolved(self, values: Any, factor: Any, padded: Shape) -> Any:
        """First of the real values, as many as are given, whose spectrum is the factor times that of those given."""
        waves = self.forward_padded(values, padded)
        waves *= factor
        return self.inverse_cropped(waves, padded, values.shape)


class ScipyTransforms(Transforms):
    """SciPy's FFTs."""

    def __init__(self, fft: Any, threads: int) -> None:
        self._fft, self._threads = fft, partial(threads_for, threads=threads)

    def forward(self, values: AnyArray) -> AnyArray:
        """Spectrum of real values."""
        return self._fft.rfft2(values, workers=self._threads(values.size))  # type: ignore[no-any-return]

    def inverse(self, spectrum: AnyArray, shape: Shape) -> AnyArray:
        """Real values of the given shape."""
        # One axis after the other: irfft2 would take a copy of the spectrum, whose pages cost as much as the transform.
        return self.inverse_cropped(spectrum, shape, shape)

    def forward_padded(self, values: AnyArray, padded: Shape) -> AnyArray:
        """Spectrum of real values with zeros behind them up to a shape."""
        threads = self._threads(math.prod(padded))
        lines = self._fft.rfft(values, padded[1], axis=1, workers=threads)
        return self._fft.fft(lines, padded[0], axis=0, overwrite_x=True, workers=threads)  # type: ignore[no-any-return]

    def inverse_cropped(self, spectrum: AnyArray, padded: Shape, shape: Shape) -> AnyArray:
        """First `shape` of the real values whose spectrum, of the padded shape, is given."""
        threads = self._threads(math.prod(padded))
        lines = self._fft.ifft(spectrum, axis=0, overwrite_x=True, workers=threads)[: shape[0]]
        return self._fft.irfft(lines, padded[1], axis=1, workers=threads)[:, : shape[1]]  # type: ignore[no-any-return]

    def convolved(self, values: AnyArray, factor: AnyArray, padded: Shape) -> AnyArray:
        """First of the real values, as many as are given, whose spectrum is the factor times that of those given.

        Of large arrays the padded spectrum is never there as a whole: all that happens along x is done with some
        columns at a time, which stay in the processor's cache.
        """
        if factor.nbytes < _LARGE:
            return super().convolved(values, factor, padded)  # type: ignore[no-any-return]
        (nx, ny), (px, py), waves = values.shape, padded, factor.shape[1]
        threads = self._threads(px * py)
        rows = max(1, threads * _BLOCK // (py * values.itemsize))
        columns = max(4, threads * _BLOCK // (px * factor.itemsize))
        lines = np.empty((nx, waves), factor.dtype)
        for i in range(0, nx, rows):
            lines[i : i + rows] = self._fft.rfft(values[i : i + rows], py, axis=1, workers=threads)
        block = np.empty((px, columns), factor.dtype)
        for j in range(0, waves, columns):
            part = lines[:, j : j + columns]
            some = block[:, : part.shape[1]]
            some[:nx], some[nx:] = part, 0.0
            some = self._fft.fft(some, axis=0, overwrite_x=True, workers=threads)
            some *= factor[:, j : j + columns]
            part[...] = self._fft.ifft(some, axis=0, overwrite_x=True, workers=threads)[:nx]
        found = np.empty_like(values)
        for i in range(0, nx, rows):
            found[i : i + rows] = self._fft.irfft(lines[i : i + rows], py, axis=1, workers=threads)[:, :ny]
        return found

    def convolved_even(self, values: AnyArray, factor: AnyArray, padded: Shape) -> AnyArray:
        """Convolve values that are even in y, of which only those at y > 0 are given and returned.

        `padded` has the points at y > 0 only, `factor` (padded[0]//2 + 1, padded[1]) the spectrum without the wave that
        alternates along y.  With cosines along y this takes half of what `convolved` takes.
        """
        (nx, ny), (px, py) = values.shape, padded
        threads = self._threads(px * py)
        if py <= _FEW_COSINES:
            forth, back = _cosines(ny, py, values.dtype.char)
            waves = self._fft.rfft(forth.T @ values.T, px, axis=1, workers=threads)
            waves *= factor.T
            lines = self._fft.irfft(waves, px, axis=1, overwrite_x=True, workers=threads)
            return lines[:, :nx].T @ back  # type: ignore[no-any-return]
        rows = max(1, threads * _BLOCK // (py * values.itemsize))
        columns = max(8, threads * _BLOCK // (px * values.itemsize))
        lines, found = np.empty((nx, py), values.dtype), np.empty_like(values)
        for i in range(0, nx, rows):
            lines[i : i + rows] = self._fft.dct(values[i : i + rows], 2, py, axis=1, workers=threads)
        for j in range(0, py, columns):
            part = lines[:, j : j + columns]
            some = self._fft.rfft(part, px, axis=0, workers=threads)
            some *= factor[:, j : j + columns]
            part[...] = self._fft.irfft(some, px, axis=0, overwrite_x=True, workers=threads)[:nx]
        for i in range(0, nx, rows):
            found[i : i + rows] = self._fft.idct(lines[i : i + rows], 2, axis=1, workers=threads)[:, :ny]
        return found


class DuccTransforms(Transforms):
    """FFTs of ducc0, which pad nothing by themselves but write into given arrays."""

    def __init__(self, fft: Any, threads: int) -> None:
        self._fft, self._threads = fft, partial(threads_for, threads=threads)

    def forward(self, values: AnyArray) -> AnyArray:
        """Spectrum of real values."""
        return self._fft.r2c(values, axes=(0, 1), nthreads=self._threads(values.size))  # type: ignore[no-any-return]

    def inverse(self, spectrum: AnyArray, shape: Shape) -> AnyArray:
        """Real values of the given shape."""
        return self._fft.c2r(  # type: ignore[no-any-return]
            spectrum, axes=(0, 1), lastsize=shape[1], forward=False, inorm=2,
            nthreads=self._threads(math.prod(shape)), allow_overwriting_input=True,
        )  # fmt: skip

    def forward_padded(self, values: AnyArray, padded: Shape) -> AnyArray:
        """Spectrum of real values with zeros behind them up to a shape."""
        (nx, ny), threads = values.shape, self._threads(math.prod(padded))
        lines = np.zeros((nx, padded[1]), values.dtype)
        lines[:, :ny] = values
        spectrum = np.zeros((padded[0], padded[1] // 2 + 1), np.result_type(values.dtype, np.complex64))
        self._fft.r2c(lines, axes=(1,), nthreads=threads, out=spectrum[:nx])
        return self._fft.c2c(spectrum, axes=(0,), nthreads=threads, out=spectrum)  # type: ignore[no-any-return]

    def inverse_cropped(self, spectrum: AnyArray, padded: Shape, shape: Shape) -> AnyArray:
        """First `shape` of the real values whose spectrum, of the padded shape, is given."""
        threads = self._threads(math.prod(padded))
        self._fft.c2c(spectrum, axes=(0,), forward=False, inorm=2, nthreads=threads, out=spectrum)
        values = self._fft.c2r(
            spectrum[: shape[0]], axes=(1,), lastsize=padded[1], forward=False, inorm=2, nthreads=threads
        )
        return values[:, : shape[1]]  # type: ignore[no-any-return]

    def convolved_even(self, values: AnyArray, factor: AnyArray, padded: Shape) -> AnyArray:
        """Convolve values that are even in y, of which only those at y > 0 are given and returned."""
        (nx, ny), threads = values.shape, self._threads(math.prod(padded))
        lines = np.zeros(padded, values.dtype)
        lines[:nx, :ny] = values
        self._fft.dct(lines[:nx], 2, axes=(1,), nthreads=threads, out=lines[:nx])
        waves = self._fft.r2c(lines, axes=(0,), nthreads=threads)
        waves *= factor
        self._fft.c2r(
            waves, axes=(0,), lastsize=padded[0], forward=False, inorm=2, nthreads=threads,
            out=lines, allow_overwriting_input=True,
        )  # fmt: skip
        self._fft.dct(lines[:nx], 3, axes=(1,), inorm=2, nthreads=threads, out=lines[:nx])
        return lines[:nx, :ny].copy()


def along_x(factor: AnyArray) -> AnyArray:
    """Return a factor of `convolved_even` in the order of memory in which it is quickest."""
    return np.asfortranarray(factor) if factor.shape[1] <= _FEW_COSINES else np.ascontiguousarray(factor)


@lru_cache(maxsize=32)
def _cosines(points: int, cosines: int, kind: str) -> tuple[AnyArray, AnyArray]:
    """Return the matrices from values at the first points to cosines, (points, cosines), and back."""
    order = np.arange(cosines)
    forth = 2.0 * np.cos(np.pi / (2.0 * cosines) * np.outer(2 * np.arange(points) + 1, order))
    back = forth.T * (np.where(order > 0, 1.0, 0.5) / cosines)[:, None] * 0.5
    return forth.astype(kind), np.ascontiguousarray(back, kind)
