"""The steady viscoelastic half-space as a linear operator: pressure to displacement by FFT, zero-padded."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import scipy.fft

from viscofric.contact.influence import cell_potential, cell_potential_xx, memory_influence

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.grids import Window

    Array: TypeAlias = NDArray[np.float64]
    ComplexArray: TypeAlias = NDArray[np.complex128]

# A mode with a memory shorter than this (in cells) dissipates by its leading term, λ² ∂²/∂x²: the next one
# is λ² = 1e-6 smaller, while the difference of its two potentials would have lost that much to rounding.
_SHORT_MEMORY = 1e-3


@dataclass(frozen=True)
class SteadyMaterial:
    """What a steady contact needs to know of its material at one speed and temperature.

    Parameters
    ----------
    glassy : float
        (1−ν²)/E∞, the compliance without memory.
    compliances : (m,) array
        (1−ν²) C_k.
    memory_lengths : (m,) array
        v τ_k > 0: how far behind the indenter a mode still feels the load.
    """

    glassy: float
    compliances: Array
    memory_lengths: Array

    def symbol(self, qx: Array) -> ComplexArray:
        """(1−ν²) S(−q_x v): the compliance that a sinusoidal load meets at the wavenumber q_x."""
        result = np.full(np.shape(qx), complex(self.glassy))
        for compliance, length in zip(self.compliances, self.memory_lengths, strict=True):
            result += compliance / (1.0 - 1j * qx * length)
        return result


@dataclass
class HalfSpaceOperator:
    """Displacement of the free half-space under pressures on the cells of a window (paper Eqs. 7 and 8).

    Linear and positive definite, but *not* symmetric: the solid remembers the load that lies ahead.

    Parameters
    ----------
    window : Window
    material : SteadyMaterial

    Attributes
    ----------
    products : int
        Applications so far; each costs one forward and one inverse FFT of the padded window.
    """

    window: Window
    material: SteadyMaterial
    products: int = 0
    _transfer: ComplexArray = field(init=False, repr=False)
    _dissipation: ComplexArray = field(init=False, repr=False)
    _inverse_symbol: ComplexArray = field(init=False, repr=False)
    _padded: tuple[int, int] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        nx, ny = self.window.shape
        self._padded = (
            scipy.fft.next_fast_len(2 * nx - 1, real=False),
            scipy.fft.next_fast_len(2 * ny - 1, real=True),
        )
        displacement, dissipation = self._influence()
        self._transfer = self._spectrum(displacement)
        self._dissipation = self._spectrum(dissipation)
        self._inverse_symbol = self._preconditioner_symbol()

    def _influence(self) -> tuple[Array, Array]:
        """Influence coefficients of the displacement, and of the part of its slope that dissipates."""
        nx, ny = self.window.shape
        h = self.window.spacing
        compliances = self.material.compliances
        lengths = self.material.memory_lengths / h
        x, y = np.arange(-(nx - 1.0), nx)[:, None], np.arange(float(ny))
        elastic = cell_potential(x, y)
        # ∂K/∂x = (K − L)/λ for each mode, and ∂L/∂x does no work on any pressure (it is odd).
        long = lengths > _SHORT_MEMORY
        rates = np.zeros_like(compliances)
        rates[long] = compliances[long] / lengths[long]
        displacement, slope = memory_influence((nx, ny), np.stack([compliances, rates]), lengths)
        displacement += self.material.glassy * elastic
        slope -= rates.sum() * elastic
        slope += (compliances[~long] * lengths[~long]).sum() * cell_potential_xx(x, y)
        return displacement * h / np.pi, slope / np.pi

    def _spectrum(self, influence: Array) -> ComplexArray:
        nx, ny = self.window.shape
        px, py = self._padded
        circulant = np.zeros(self._padded)
        rows = np.arange(-(nx - 1), nx) % px
        circulant[rows, :ny] = influence
        if ny > 1:
            circulant[rows, py - ny + 1 :] = influence[:, :0:-1]
        return np.asarray(scipy.fft.rfft2(circulant))

    def _preconditioner_symbol(self) -> ComplexArray:
        nx, ny = self.window.shape
        qx = 2.0 * np.pi * scipy.fft.fftfreq(nx, self.window.spacing)[:, None]
        qy = 2.0 * np.pi * scipy.fft.rfftfreq(ny, self.window.spacing)
        q = np.hypot(qx, qy)
        q[0, 0] = 0.5 * np.pi / (max(nx, ny) * self.window.spacing)
        return np.asarray(q / (2.0 * self.material.symbol(qx)))

    def __call__(self, pressure: Array) -> Array:
        """Displacement (positive into the solid) at the cell centres under a pressure, both (nx, ny)."""
        self.products += 1
        return self._convolve(self._transfer, pressure)

    def _convolve(self, spectrum: ComplexArray, values: Array) -> Array:
        # One axis at a time: the padding's empty lines need not be transformed along y.
        nx, ny = self.window.shape
        px, py = self._padded
        lines = scipy.fft.fft(scipy.fft.rfft(values, py, axis=1), px, axis=0, overwrite_x=True)
        lines *= spectrum
        lines = scipy.fft.ifft(lines, axis=0, overwrite_x=True)[:nx]
        return np.asarray(scipy.fft.irfft(lines, py, axis=1)[:, :ny])

    def precondition(self, residual: Array) -> Array:
        """Pressure that would cause a displacement, nearly: the inverse symbol |q|/2S on the bare window."""
        return np.asarray(scipy.fft.irfft2(self._inverse_symbol * scipy.fft.rfft2(residual), residual.shape))

    def dissipated_force(self, pressure: Array) -> float:
        """Friction force from the energy that the material dissipates, per unit of distance slid.

        F_t = −∫ p ∂u/∂x dA, in which only the memory does work; in Fourier space the integral over q of
        2 q_x |p̂|² (−Im S)/|q| (see the theory page).
        """
        slope = self._convolve(self._dissipation, pressure)
        return -self.window.cell_area * float(np.vdot(pressure, slope))
