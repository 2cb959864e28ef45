"""Power spectrum of line scans, and the isotropic surface that it belongs to."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from viscofric.arrays import non_negative_fit
from viscofric.roughness.spectrum import NODES, Density, PowerSpectrum, integral
from viscofric.units import to_si

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.showing import Rows


#: Weight of the second differences of the surface's density, which matter only where the lines leave it open.
_SMOOTHNESS = 0.03
#: Least density, as a share of the median.
_FLOOR = 1e-2


@dataclass(frozen=True, eq=False)
class LineSpectrum(Density):
    """Power spectrum of line scans: a power law between its points, nothing beyond; ⟨h²⟩ = 2 ∫₀ C(q) dq, C in m³.

    Parameters
    ----------
    wave_number : (n,) array
        q = 2π/wavelength, rad/m, increasing.
    density : (n,) array
        C(q), m³, above zero.

    Raises
    ------
    InputError
        If these are not two rows of equal length, positive and finite, with increasing wave numbers.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> q = np.geomspace(1e3, 1e5, 200)
    >>> line = vf.LineSpectrum(q, 1e-10 * q**-1.6)
    >>> f"{line.moment(0) ** 0.5:.1e} m rms"
    '2.2e-06 m rms'
    """

    _unit: ClassVar[str] = "m**3"
    _name: ClassVar[str] = "power spectral density of lines"

    def _shown(self) -> Rows:
        return *super()._shown(), ("rms height", self.rms_height(), "m"), ("rms slope", self.rms_slope())

    def moment(self, order: float) -> float:
        """Return 2 ∫ q^order C(q) dq: ⟨h²⟩ for 0, ⟨(dh/dx)²⟩ for 2, ⟨(d²h/dx²)²⟩ for 4."""
        return 2.0 * integral(self.wave_number, self.density, to_si(order, "dimensionless", "order"))

    def rms_height(self) -> float:
        """Return the rms height, m."""
        return math.sqrt(self.moment(0.0))

    def rms_slope(self) -> float:
        """Return the rms slope along the line."""
        return math.sqrt(self.moment(2.0))

    def isotropic(self) -> PowerSpectrum:
        """Return the power spectrum of the surface, if it is isotropic, that such lines run across.

        Returns
        -------
        PowerSpectrum
            C of C₁(q) = ∫ dp C(√(q² + p²)), by non-negative least squares.

        Notes
        -----
        A line crosses waves obliquely, so that long wavelengths of a line are in part short waves of the surface.  What
        waves there are beyond the shortest of the lines is not known and taken to be none.
        """
        return PowerSpectrum(self.wave_number, _isotropic_density(self.wave_number, self))


def _isotropic_density(q: Array, line: Callable[[Array], Array]) -> Array:
    """Solve C₁(q) = ∫ dp C(√(q² + p²)) for the density C of a surface at the points of that of its lines, C₁.

    C is sought as C₁(k)/k times a factor that is linear in ln k between the points, not below zero, by least squares of
    the relative misfit.  For C ∝ k^(−s) the factor is constant, Γ(s/2)/(√π Γ((s−1)/2)).
    """
    logs, count = np.log(q), len(q)
    place, weight = np.polynomial.legendre.leggauss(NODES)
    rows = np.zeros((count - 1, count))
    for row in range(count - 1):
        # Ends of the segments of ln k, as distances p along the other axis, in which the integrand is smooth.
        ends = np.sqrt(np.maximum(np.square(q[row:]) - q[row] ** 2, 0.0))
        half = 0.5 * np.diff(ends)
        p = (0.5 * (ends[:-1] + ends[1:]))[:, None] + half[:, None] * place
        k = np.sqrt(q[row] ** 2 + np.square(p))
        values = 2.0 * half[:, None] * weight * line(k) / k
        segment = row + np.arange(len(half))[:, None]
        part = (np.log(k) - logs[segment]) / (logs[segment + 1] - logs[segment])
        np.add.at(rows[row], segment + np.zeros(k.shape, int), (1.0 - part) * values)
        np.add.at(rows[row], segment + 1 + np.zeros(k.shape, int), part * values)
    rows /= line(q[:-1])[:, None]
    bends = _SMOOTHNESS * np.diff(np.eye(count), 2, axis=0)
    right = np.concatenate([np.ones(count - 1), np.zeros(len(bends))])
    factor = non_negative_fit(np.concatenate([rows, bends]), right)
    factor = np.maximum(factor, _FLOOR * float(np.median(factor)))
    return np.asarray(factor * line(q) / q)
