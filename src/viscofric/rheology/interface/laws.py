"""Laws of the shear stress of a dry interface: constant, power of speed, Eyring, Gaussian."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from viscofric.arrays import Array
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.shifts.parametric_law import Constant
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.units import Quantity

BOLTZMANN = 1.380649e-23  # J/K
LOG10_E = 1.0 / LN10


@dataclass(frozen=True)
class ConstantShearStress(InterfaceLaw):
    """Shear stress that depends neither on speed nor on temperature.

    Parameters
    ----------
    stress : float, str or pint.Quantity
        Pa.
    shift, covariance, fitted_speeds, fitted_temperatures, fitted_pressures, notes
        See `InterfaceLaw`; a shift has no effect.

    Examples
    --------
    >>> import viscofric as vf
    >>> round(vf.friction.ConstantShearStress("0.4 MPa")("1 mm/s"))
    400000
    """

    stress: Quantity

    kind: ClassVar[str] = "constant"
    title: ClassVar[str] = "constant"
    _constants: ClassVar[dict[str, Constant]] = {"stress": Constant("τ", "Pa", "MPa", 1e-6)}
    _adjusted: ClassVar[tuple[str, ...]] = ("stress",)
    _of_speed: ClassVar[bool] = False

    def _log10(self, x: Array, kelvin: Array) -> Array:
        return np.full(x.shape, np.log10(float(self.stress)))

    def _slope(self, x: Array) -> Array:
        return np.zeros(x.shape)

    def _gradient(self, x: Array) -> Array:
        return np.full((*x.shape, 1), LOG10_E / float(self.stress))


@dataclass(frozen=True)
class PowerShearStress(InterfaceLaw):
    """Shear stress as a power of the reduced slip speed, τ_s = τ (α(T) v/v₀)ⁿ.

    Parameters
    ----------
    stress : float, str or pint.Quantity
        τ at the speed v₀, Pa.
    exponent : float
        n.
    speed : float, str or pint.Quantity
        v₀, m/s; chosen, not fitted.
    shift, covariance, fitted_speeds, fitted_temperatures, fitted_pressures, notes
        See `InterfaceLaw`.

    Examples
    --------
    >>> import viscofric as vf
    >>> round(vf.friction.PowerShearStress("0.4 MPa", 0.5, "1 mm/s")("100 mm/s"))
    4000000
    """

    stress: Quantity
    exponent: float
    speed: Quantity

    kind: ClassVar[str] = "power"
    title: ClassVar[str] = "power of speed"
    _constants: ClassVar[dict[str, Constant]] = {
        "stress": Constant("τ", "Pa", "MPa", 1e-6),
        "exponent": Constant("n"),
        "speed": Constant("v₀", "m/s", "mm/s", 1e3),
    }
    _adjusted: ClassVar[tuple[str, ...]] = ("stress", "exponent")

    def _log10(self, x: Array, kelvin: Array) -> Array:
        return np.asarray(np.log10(float(self.stress)) + self.exponent * (x - np.log10(float(self.speed))))

    def _slope(self, x: Array) -> Array:
        return np.full(x.shape, self.exponent)

    def _gradient(self, x: Array) -> Array:
        return np.stack([np.full(x.shape, LOG10_E / float(self.stress)), x - np.log10(float(self.speed))], axis=-1)


@dataclass(frozen=True)
class EyringShearStress(InterfaceLaw):
    """Thermally activated slip, τ_s = (kT/φ) arsinh(α(T) v/v₀).

    Parameters
    ----------
    activation_volume : float, str or pint.Quantity
        φ, m³.
    speed : float, str or pint.Quantity
        v₀, up to which the stress is proportional to the speed, m/s at the reference of the shift.
    shift, covariance, fitted_speeds, fitted_temperatures, fitted_pressures, notes
        See `InterfaceLaw`.

    References
    ----------
    H. Eyring, J. Chem. Phys. 4 (1936) 283, doi:10.1063/1.1749836; of friction, B. J. Briscoe, D. C. B. Evans, Proc. R.
    Soc. Lond. A 380 (1982) 389.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.friction.EyringShearStress("20 nm**3", "1 um/s", shift=vf.Arrhenius("90 kJ/mol", reference="20 degC"))
    >>> round(1e-6 * law("1 mm/s", "20 degC"), 3)
    1.538
    """

    activation_volume: Quantity
    speed: Quantity

    kind: ClassVar[str] = "eyring"
    title: ClassVar[str] = "Eyring"
    _constants: ClassVar[dict[str, Constant]] = {
        "activation_volume": Constant("φ", "m**3", "nm³", 1e27),
        "speed": Constant("v₀", "m/s", "mm/s", 1e3),
    }
    _adjusted: ClassVar[tuple[str, ...]] = ("activation_volume", "speed")
    _of_temperature: ClassVar[bool] = True

    def _log10(self, x: Array, kelvin: Array) -> Array:
        stress = np.log10(BOLTZMANN / float(self.activation_volume)) + np.log10(kelvin)
        _, arsinh, below = self._arsinh(x)
        return np.asarray(stress + np.log10(arsinh) + below)

    def _arsinh(self, x: Array) -> tuple[Array, Array, Array]:
        """Return r = v/v₀ within 150 decades of 1, arsinh v/v₀ not below those, and the decades below them."""
        decades = x - np.log10(float(self.speed))
        near = np.clip(decades, -150.0, 150.0)  # beyond, arsinh r is r or ln 2r to rounding
        ratio = 10.0**near
        return ratio, np.arcsinh(ratio) + LN10 * np.maximum(decades - near, 0.0), np.minimum(decades - near, 0.0)

    def _slope(self, x: Array) -> Array:
        ratio, arsinh, _ = self._arsinh(x)
        return np.asarray(ratio / (np.hypot(1.0, ratio) * arsinh))

    def _gradient(self, x: Array) -> Array:
        volume = np.full(x.shape, -LOG10_E / float(self.activation_volume))
        return np.stack([volume, -LOG10_E / float(self.speed) * self._slope(x)], axis=-1)


@dataclass(frozen=True)
class GaussianShearStress(InterfaceLaw):
    """A maximum over the logarithm of speed, τ_s = τ_p exp(−½ (log10(α(T) v/v_p)/w)²).

    Persson and co-workers write exp(−c (log10(v/v_p))²): c = 1/(2w²).

    Parameters
    ----------
    peak : float, str or pint.Quantity
        τ_p, Pa.
    speed : float, str or pint.Quantity
        v_p of the maximum, m/s at the reference of the shift.
    width : float
        w, decades of speed.
    shift, covariance, fitted_speeds, fitted_temperatures, fitted_pressures, notes
        See `InterfaceLaw`.

    References
    ----------
    B. Lorenz, Y. R. Oh, S. K. Nam, S. H. Jeon, B. N. J. Persson, J. Chem. Phys. 142 (2015) 194701.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.friction.GaussianShearStress(
    ...     "6 MPa", "6 mm/s", 2.0, shift=vf.Arrhenius("90 kJ/mol", reference="20 degC")
    ... )
    >>> round(1e-6 * law("600 mm/s", "20 degC"), 3)
    3.639
    """

    peak: Quantity
    speed: Quantity
    width: float

    kind: ClassVar[str] = "gaussian"
    title: ClassVar[str] = "Gaussian"
    _constants: ClassVar[dict[str, Constant]] = {
        "peak": Constant("τ_p", "Pa", "MPa", 1e-6),
        "speed": Constant("v_p", "m/s", "mm/s", 1e3),
        "width": Constant("w", shown="decades"),
    }
    _adjusted: ClassVar[tuple[str, ...]] = ("peak", "speed", "width")

    def _log10(self, x: Array, kelvin: Array) -> Array:
        away = (x - np.log10(float(self.speed))) / self.width
        return np.asarray(np.log10(float(self.peak)) - 0.5 * LOG10_E * away**2)

    def _slope(self, x: Array) -> Array:
        return np.asarray(-LOG10_E * (x - np.log10(float(self.speed))) / self.width**2)

    def _gradient(self, x: Array) -> Array:
        away = x - np.log10(float(self.speed))
        peak = np.full(x.shape, LOG10_E / float(self.peak))
        speed = -LOG10_E / float(self.speed) * self._slope(x)
        return np.stack([peak, speed, LOG10_E * away**2 / self.width**3], axis=-1)
