"""Transfer function of the periodic contact: the response of a solid to each wave of a steadily sliding pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.bodies import Layer, half_space_coupling
from viscofric.contact.periodic.surface import hermitian_factor, wave_number, without_nyquist
from viscofric.threads import in_parts

if TYPE_CHECKING:
    from viscofric.rheology.spectra.quality import KnownFrequencies


class Compliant(Protocol):
    """A material at one temperature, given by modes or as a table."""

    @property
    def E_inf(self) -> float:
        """Glass modulus, Pa."""

    @property
    def known_frequencies(self) -> KnownFrequencies | None:
        """Frequencies at which it is known; None where notes say nothing of them."""

    def compliance(self, angular_frequency: ArrayLike) -> ComplexArray:
        """S(ω) = 1/E(ω), 1/Pa."""


@dataclass(frozen=True)
class SlidingSolid:
    """A viscoelastic half-space or layer over which pressures slide at a constant velocity."""

    spectrum: Compliant  # of the material at its temperature: a RetardationSpectrum or a ModulusTable
    poisson_ratio: float
    # m/s, along x and y; where one is infinite, the limit of high speeds along `toward` is taken
    velocity: tuple[float, float]
    layer: Layer | None = None  # None for a half-space
    indenter_compliance: float = 0.0  # (1−ν²)/E of an elastic indenter, 1/Pa
    toward: tuple[float, float] = (1.0, 0.0)  # unit vector of the velocity, for infinite ones and for shear only
    drag: float = 0.0  # shear stress along `toward` over the pressure
    indenter_coupling: float = 0.0  # (1−2ν)/(2(1−ν)) of the indenter

    @property
    def _is_infinite(self) -> bool:
        return any(map(math.isinf, self.velocity))

    @property
    def is_elastic(self) -> bool:
        """Whether nothing depends on the velocity, as at rest."""
        return self.velocity == (0.0, 0.0)

    @property
    def is_symmetric(self) -> bool:
        """Whether the transfer function is real: that of an elastic solid without shear."""
        return self.is_elastic and self.drag == 0.0

    def transfer(self, shape: tuple[int, int], spacing: tuple[float, float]) -> ComplexArray | Array:
        """Return û/p̂ for each wave of a grid, m/Pa, in the order of `scipy.fft.rfft2`; zero for the mean.

        û = 2 [(1−ν²) S(−q·v) Θ(qH) + (1−ν_i²)/E_i] p̂/|q|.  A Nyquist wave stands for two that run opposite ways, and
        gets the mean of their responses, so that the displacement of a real pressure is real.  At rest the array
        is real, since the contact is elastic.  A shear of μ times the pressure along n adds −i μ X q·n/|q| p̂, with X in
        place of Θ and (1−2ν_i)/(2(1−ν_i)) in place of the indenter's one.
        """
        qx, qy = wave_number(shape, spacing)
        magnitude = np.hypot(qx, qy)
        magnitude[0, 0] = 1.0
        ratio = self.poisson_ratio
        relaxed = (1.0 - ratio**2) * self._compliance(qx, qy, shape)
        factor: Array | float = 1.0 if self.layer is None else self.layer.yielding(magnitude, ratio)
        response = relaxed * factor + self.indenter_compliance
        if self.drag:
            sheared = relaxed * self._coupling(magnitude) - self.indenter_compliance * self.indenter_coupling
            response = response - 1j * self.drag * self._obliquity(shape, spacing, magnitude) * sheared
        found: ComplexArray | Array = 2.0 * (response.real if self.is_symmetric else response) / magnitude
        found[0, 0] = 0.0
        return found

    def _coupling(self, magnitude: Array) -> Array | float:
        """X of the waves."""
        if self.layer is None:
            return half_space_coupling(self.poisson_ratio)
        return self.layer.coupling(magnitude, self.poisson_ratio)

    def _obliquity(self, shape: tuple[int, int], spacing: tuple[float, float], magnitude: Array) -> Array:
        """q·n/|q| of the waves; zero for those that stand for two of opposite ways."""
        qx, qy = (without_nyquist(one, size) for one, size in zip(wave_number(shape, spacing), shape, strict=True))
        return np.asarray((self.toward[0] * qx + self.toward[1] * qy) / magnitude)

    def relaxed_shape(self, shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
        """Return Θ(qH)/|q| over its largest value for each wave of a grid, as of an elastic solid; mean zero."""
        magnitude = np.hypot(*wave_number(shape, spacing))
        magnitude[0, 0] = 1.0
        found = 1.0 / magnitude
        if self.layer is not None:
            found *= self.layer.yielding(magnitude, self.poisson_ratio)
        found[0, 0] = 0.0
        return np.asarray(found / found.max())

    def mean_compression(self) -> float:
        """Return the displacement under a uniform pressure over that pressure, m/Pa.

        Zero for a half-space, whose displacements are counted from their mean.
        """
        if self.layer is None:
            return 0.0
        thickness = self.layer.mean_compression(self.poisson_ratio)
        return thickness * float(self.spectrum.compliance(0.0).real) if thickness else 0.0

    def _compliance(self, qx: Array, qy: Array, shape: tuple[int, int]) -> ComplexArray:
        """S(−q·v), averaged over the two senses of a Nyquist wave, in a shape that broadcasts to the grid's."""
        (nx, ny), (vx, vy) = shape, self.toward if self._is_infinite else self.velocity
        # The grid is not filled where the compliance varies along one axis only.
        still = np.zeros((1, 1))
        ahead = still if vx == 0.0 else qx * vx
        across = still if vy == 0.0 else qy * vy
        found = self._response(ahead + across, (nx, qy.shape[1]))
        if nx % 2 == 0 and vx != 0.0:
            row = self._response(across - ahead[nx // 2])[0]
            found[nx // 2] = 0.5 * (found[nx // 2] + row)
        if ny % 2 == 0 and vy != 0.0:
            column = self._response(ahead - across[:, -1:])[:, 0]
            if nx % 2 == 0 and vx != 0.0:
                # All four senses of the corner: two pairs of conjugates.
                found[nx // 2, -1] = column[nx // 2] = found[nx // 2, -1].real
            found[:, -1] = 0.5 * (found[:, -1] + column)
        return found

    def _response(self, frequency: Array, grid: tuple[int, int] | None = None) -> ComplexArray:
        """Return S(−ω), where ω is given for each wave of a grid if it has that grid's shape."""
        if self.is_elastic:
            relaxed = float(self.spectrum.compliance(0.0).real)
            return np.full((1, 1), relaxed, complex)
        # The mean needs no compliance, which a table may not have at rest.
        whole = frequency.shape == grid and frequency.size > 1
        if self._is_infinite:
            # Waves across the motion are at rest at any speed; their frequencies cancel but for rounding.
            moving = np.abs(frequency) > 1e-12 * np.abs(frequency).max(initial=0.0)
            if whole:
                moving.flat[0] = True
            at_rest = 0.0 if moving.all() else complex(self.spectrum.compliance(0.0))
            return np.where(moving, complex(1.0 / self.spectrum.E_inf), at_rest)
        if whole:
            frequency.flat[0] = frequency.flat[-1]
        return np.conj(self.spectrum.compliance(frequency))


def losses(transfer: ComplexArray | Array, shape: tuple[int, int], pressure_waves: ComplexArray) -> Array:
    """Return 2(1−ν²)/|q| (−Im S(q·v)) |p̂_q|² for each wave and its opposite, of Fourier coefficients p̂_q.

    That is what it dissipates over q·v; zeros that broadcast for an elastic solid without shear.
    """
    if not np.iscomplexobj(transfer):
        return np.zeros((1, 1))
    twice, found = hermitian_factor(shape[1]) / float(shape[0] * shape[1]) ** 2, np.empty(transfer.shape)

    def lose(found: Array, transfer: ComplexArray, waves: ComplexArray) -> None:
        found[...] = transfer.imag * (waves.real**2 + waves.imag**2) * twice

    in_parts(lose, found, transfer, pressure_waves)
    return found


def dissipation(losses: Array, shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return the friction force per area (2,), along x and y, that dissipates energy: the sum of q times `losses`."""
    qx, qy = (without_nyquist(one, size) for one, size in zip(wave_number(shape, spacing), shape, strict=True))
    return np.array([(qx[:, 0] * losses.sum(axis=1)).sum(), (qy[0] * losses.sum(axis=0)).sum()])
