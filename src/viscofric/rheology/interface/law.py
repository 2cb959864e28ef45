"""The base of laws of a dry interface: shear stress on the real contact area over slip speed and temperature."""

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
from viscofric.rheology.shifts.shift_law import ShiftLaw, checked_covariance, in_kelvin, in_shape
from viscofric.showing import Rows, Shown
from viscofric.units import Quantities, number, positive, share, shown_celsius, to_si_array, to_si_in_shape

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
