"""Laws of a dry interface: shear stress on the real contact area over slip speed and temperature."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from statistics import NormalDist
from typing import Any, ClassVar

import numpy as np

from viscofric.arguments import LARGEST, insist_on, numbers, sentences
from viscofric.arrays import Array, Mask
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, brief
from viscofric.nominal import SAME_TEMPERATURE
from viscofric.rheology.shifts.parametric_law import Constant, ParametricLaw, shown_constant
from viscofric.rheology.shifts.shift_law import LN10, ShiftLaw, checked_covariance, in_kelvin, in_shape
from viscofric.showing import Rows, Shown
from viscofric.units import Quantities, Quantity, number, positive, share, shown_celsius, to_si_array, to_si_in_shape

#: Decades on either side of a law's speed, where it was not fitted, in a data set.
_DRAWN = 3.0
_POINTS = 101


@dataclass(frozen=True, kw_only=True)
class InterfaceLaw(Shown, ABC):
    """Shear stress τ_s(v, T) of an interface, a function of the reduced slip speed α(T) v.

    The base of `ConstantShearStress`, `PowerShearStress`, `EyringShearStress` and `GaussianShearStress`, which
    `ShearStress.law` fits.

    Parameters
    ----------
    shift : ShiftLaw, optional
        α(T) of the interface, which is not that of the material; without it the law depends on temperature as its
        formula does.
    covariance : (n, n) array, optional
        Of the fitted constants in SI units, and of those of `shift` after them where they were fitted together.
    fitted_speeds : (lowest, highest), optional
        Reduced slip speeds of the fit, m/s.
    fitted_temperatures : (lowest, highest), optional
        Temperatures of the fit, K.
    fitted_pressures : (lowest, highest), optional
        Mean contact pressures of the fit, Pa, on which no law depends.
    notes : tuple of str
        How the points miss a fitted law by more than their stated errors, which widens its covariance.
    """

    shift: ShiftLaw | None = None
    covariance: Array | None = field(default=None, compare=False, repr=False)
    fitted_speeds: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    fitted_temperatures: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    fitted_pressures: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    notes: tuple[str, ...] = field(default=(), compare=False, repr=False)

    #: As `ShearStress.law` calls it, and as it is called in a sentence.
    kind: ClassVar[str]
    title: ClassVar[str]
    _constants: ClassVar[dict[str, Constant]]
    #: The constants that a fit adjusts, in the order of the covariance.
    _adjusted: ClassVar[tuple[str, ...]]
    #: Whether speed has an effect, and temperature apart from the shift.
    _of_speed: ClassVar[bool] = True
    _of_temperature: ClassVar[bool] = False

    def __post_init__(self) -> None:
        for name, constant in self._constants.items():
            given = getattr(self, name)
            value = number(given, name) if name == "exponent" else positive(given, constant.unit, name)
            object.__setattr__(self, name, value)
        if self.shift is not None:
            insist_on(self.shift, "shift", ShiftLaw)
        if self.covariance is not None:
            given = numbers(self.covariance, "covariance of a law of shear stress")
            own = len(self._adjusted)
            size = own if given.shape == (own, own) else len(self.parameters)
            object.__setattr__(self, "covariance", checked_covariance(self.covariance, size, "a law of shear stress"))
        object.__setattr__(self, "notes", sentences(self.notes, "notes"))
        super().__post_init__()
        for name, unit in (("fitted_speeds", "m/s"), ("fitted_temperatures", "K"), ("fitted_pressures", "Pa")):
            if (ends := getattr(self, name)) is not None:
                low_high = to_si_array(ends, unit, name)
                if low_high.size != 2 or not 0.0 < low_high[0] <= low_high[1]:
                    raise InputError(
                        f"{name} = {brief(ends)}: must be two values above zero, the smaller one first.",
                        code="not-ascending",
                    )
                object.__setattr__(self, name, tuple(low_high.tolist()))

    def _shown(self) -> Rows:
        return (
            *((name, value) for name, _, value in (one.partition(" = ") for one in self._shown_constants())),
            ("shift", None if self.shift is None else str(self.shift)),
            ("fitted speeds", self.fitted_speeds, "m/s"),
            ("fitted temperatures", self.fitted_temperatures, "°C"),
            ("notes", self.notes),
        )

    def __str__(self) -> str:
        """Return name, constants with standard errors, and shift, as for a report."""
        return f"{self.title}: {self.described}"

    @property
    def described(self) -> str:
        """The constants with their standard errors, and the shift."""
        shift = "" if self.shift is None else f"; {self.shift if isinstance(self.shift, ParametricLaw) else 'shifted'}"
        return ", ".join(self._shown_constants()) + shift

    def _shown_constants(self) -> list[str]:
        errors = {} if self.covariance is None else dict(zip(self._adjusted, self.standard_errors, strict=False))
        return [
            shown_constant(constant, getattr(self, name), errors.get(name, 0.0))
            for name, constant in self._constants.items()
        ]

    @property
    def parameters(self) -> Array:
        """The fitted constants, SI, and those of the shift law after them."""
        own = [float(getattr(self, name)) for name in self._adjusted]
        return np.array([*own, *(self.shift.parameters if isinstance(self.shift, ParametricLaw) else ())])

    @property
    def standard_errors(self) -> Array:
        """Standard errors in the order of `covariance`; empty where there is none."""
        return np.empty(0) if self.covariance is None else np.sqrt(np.diag(self.covariance))

    @property
    def has_standard_error(self) -> bool:
        """Whether the uncertainty of τ_s is known; False for constants that were typed in without a covariance."""
        return self.covariance is not None

    def __call__(self, speed: Quantities, temperature: Quantities | None = None) -> Any:
        """Return the shear stress, Pa, at slip speeds above zero, m/s, and temperatures, K, broadcast together.

        Without temperature it is that at the reference of the shift law.  InputError if a speed is not above zero, the
        law is not known at a temperature, or the stress is too large for computations.
        """
        return in_shape(self._in_pascal(self._log10(*self._arguments(speed, temperature))))

    def _in_pascal(self, decades: Array) -> Array:
        if np.any(decades > np.log10(LARGEST)):
            raise InputError(
                f"this {self.title} law gives a shear stress beyond {LARGEST:g} Pa: its speed or temperature is far "
                "from those that the law describes; leave it out.",
                code="too-large",
            )
        return np.asarray(10.0**decades)

    def standard_error(self, speed: Quantities, temperature: Quantities | None = None) -> Any:
        """Return the standard error of log10 τ_s, decades, by the delta method; arguments as of a call.

        Raises
        ------
        InputError
            As a call, or if the law has no covariance.
        """
        if self.covariance is None:
            raise InputError(
                f"the uncertainty of this {self.title} law of shear stress is not known, because its constants have no "
                "covariance; fit it to measured shear stress, or give the covariance.",
                code="no-covariance",
            )
        decades, kelvin = self._arguments(speed, temperature)
        gradient = self._gradient(decades)
        slope, variance = self._slope(decades), np.zeros(decades.shape)
        if gradient.shape[-1] < len(self.covariance):
            assert isinstance(self.shift, ParametricLaw)
            gradient = np.concatenate([gradient, slope[..., None] * self.shift._gradient(kelvin)], axis=-1)
        elif self.shift is not None and self.shift.has_standard_error:
            variance = (slope * self.shift._standard_error(kelvin)) ** 2
        variance = variance + np.einsum("...i,ij,...j->...", gradient, self.covariance, gradient)
        return in_shape(np.sqrt(np.maximum(variance, 0.0)))

    def interval(self, speed: Quantities, temperature: Quantities | None = None, *, level: float = 0.95) -> Any:
        """Return the confidence limits of the shear stress.

        Parameters
        ----------
        speed, temperature
            As of a call.
        level : float
            Probability between the limits.

        Returns
        -------
        lower, upper : float or array
            Pa.

        Raises
        ------
        InputError
            As `standard_error` raises it, or if the level is not between 0 and 1.
        """
        half = NormalDist().inv_cdf(0.5 + 0.5 * share(level, "level", example=0.95))
        middle = self._log10(*self._arguments(speed, temperature))
        away = half * self.standard_error(speed, temperature)
        return in_shape(self._in_pascal(middle - away)), in_shape(self._in_pascal(middle + away))

    def extrapolates(self, speed: Quantities, temperature: Quantities | None = None) -> Any:
        """Return whether reduced speed or temperature, as of a call, lie outside those of a fit; else False."""
        decades, kelvin = self._arguments(speed, temperature)
        outside: Mask = np.zeros(decades.shape, dtype=bool)
        if self.fitted_speeds is not None:
            low, high = np.log10(self.fitted_speeds)
            outside |= (decades < low - 1e-6) | (decades > high + 1e-6)
        if self.fitted_temperatures is not None:
            low, high = self.fitted_temperatures
            outside |= (kelvin < low - SAME_TEMPERATURE) | (kelvin > high + SAME_TEMPERATURE)
        return bool(outside) if outside.ndim == 0 else outside

    def to_dataset(self, speeds: Quantities | None = None, temperatures: Quantities | None = None) -> Dataset:
        """Return τ_s over temperature and slip speed as a labelled data set.

        Parameters
        ----------
        speeds : float, str, pint.Quantity, or an array or list of them, optional
            m/s; those of the fit if left out.
        temperatures : the same, optional
            K; the reference of the shift law if left out.

        Returns
        -------
        xarray.Dataset
            ``shear_stress`` (Pa) and, where it is known, ``standard_error`` of its logarithm.  Attributes: ``law`` and
            ``description``.

        Raises
        ------
        InputError
            As of a call.
        """
        if speeds is None:
            middle = float(getattr(self, "speed", 1.0))
            ends = self.fitted_speeds or (middle * 10.0**-_DRAWN, middle * 10.0**_DRAWN)
            speeds = np.geomspace(ends[0], ends[1], _POINTS)
        velocity = to_si_array(speeds, "m/s", "speeds")
        kelvin = np.ravel(self._kelvin(temperatures))
        grid = velocity[None, :], kelvin[:, None]
        error = None
        if self.has_standard_error:
            error = self.standard_error(*grid), "1", "standard error of log10 of the shear stress"
        return dataset(
            ("temperature", "speed"),
            {"shear_stress": (self(*grid), "Pa", "shear stress of the interface"), "standard_error": error},
            coordinates={"temperature": (kelvin, "K", "temperature"), "speed": (velocity, "m/s", "slip speed")},
            attributes={"law": self.title, "description": str(self)},
        )

    # --- of each law: x is log10 of the reduced speed in m/s -------------------------------------------------

    @abstractmethod
    def _log10(self, x: Array, kelvin: Array) -> Array:
        """Return log10 τ_s, Pa."""

    @abstractmethod
    def _slope(self, x: Array) -> Array:
        """Return ∂log10 τ_s/∂x."""

    @abstractmethod
    def _gradient(self, x: Array) -> Array:
        """Return ∂log10 τ_s by the law's own fitted constants, (..., n)."""

    def _kelvin(self, temperature: Quantities | None) -> Array:
        if temperature is not None:
            return in_kelvin(temperature)
        if self.shift is not None:
            return np.array(self.shift.reference)
        if self.fitted_temperatures is not None:
            return np.array(0.5 * sum(self.fitted_temperatures))
        if self._of_temperature:
            raise InputError("temperature must be given to this law, which has no reference.", code="no-temperature")
        return np.array(293.15)  # the law is the same at all temperatures

    def _arguments(self, speed: Quantities, temperature: Quantities | None) -> tuple[Array, Array]:
        """Return log10 of the reduced speed, and temperatures, of one shape."""
        velocity, kelvin = to_si_in_shape(speed, "m/s", "speed"), self._kelvin(temperature)
        if not np.all(velocity > 0.0):
            raise InputError("speed of slip must be above zero everywhere.", code="not-positive")
        if self.shift is None and self.fitted_temperatures is not None and self._of_speed:
            low, high = self.fitted_temperatures
            if np.any(kelvin < low - SAME_TEMPERATURE) or np.any(kelvin > high + SAME_TEMPERATURE):
                raise InputError(
                    f"the law of shear stress was fitted at {shown_celsius(low)} °C only, and its dependence on "
                    "temperature is not known; measure at other temperatures too, or give the law a shift.",
                    code="outside-fitted",
                )
        decades = np.log10(velocity)
        if self.shift is not None:
            decades = decades + np.asarray(self.shift.log10(kelvin))
        try:
            x, kelvin = np.broadcast_arrays(decades, kelvin)
        except ValueError:
            raise InputError(
                "speed and temperature must have as many values, or one of them one.", code="different-lengths"
            ) from None
        return x, kelvin


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
