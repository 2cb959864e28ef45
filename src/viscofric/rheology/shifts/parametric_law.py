"""Shift laws of a few constants: their uncertainty at any temperature, and the limits of extrapolation."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from viscofric.arguments import flag, numbers
from viscofric.arrays import Array, Mask
from viscofric.datasets import plain
from viscofric.errors import InputError, wrong_argument
from viscofric.rheology.shifts.shift_law import ShiftLaw, as_record, checked_covariance
from viscofric.showing import Rows, with_error
from viscofric.units import kelvin_hint, positive, shown_celsius, shown_number, to_si_array

#: A law is extrapolated no farther than this beyond the hottest temperature of its fit.  WLF and Arrhenius laws fitted
#: to the same hundred kelvin (C2 of 90 to 130 K) differ by 0.3 to 1.2 decades over the next fifty; and WLF is a law of
#: the hundred kelvin above Tg (Williams, Landel & Ferry 1955), of which fifty are a half.
HOTTEST_EXTRAPOLATION = 50.0  # K
#: Towards the glass α changes fastest, by up to a decade every three kelvin, and below Tg another law holds: the
#: two laws above differ as much over twenty kelvin as over fifty on the hot side.
COLDEST_EXTRAPOLATION = 20.0  # K
#: No extrapolation towards a pole comes closer than this.  About Tg, C2 (the distance of the pole from Tg) is
#: 30 to 100 K for most rubbers (J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed. 1980, Table 11-II), so
#: that nearer to the pole the material is a glass, which does not follow the law.
POLE_MARGIN = 30.0  # K
#: … and only while the law's 95 % uncertainty, from the nearest temperature of the fit, is below this.
LARGEST_UNCERTAINTY = 0.5  # decades
LEVEL_95 = 1.959963984540054
#: Two temperatures closer than this are the same one, to rounding of °C.
SAME_TEMPERATURE = 1e-9  # relative
#: A law that stands for measured factors lies this close to them.
LARGEST_MISFIT = 0.1  # decades of α, rms


class Constant(NamedTuple):
    """A constant of a law: its symbol, its unit in SI, and the unit in which it is shown (SI × factor + offset)."""

    symbol: str
    unit: str = "dimensionless"
    shown: str = ""
    factor: float = 1.0
    offset: float = 0.0


class Reach(NamedTuple):
    """Limit of extrapolation of a law on one side (K), and the reason for it."""

    limit: float
    reason: str


@dataclass(frozen=True, kw_only=True)
class ParametricLaw(ShiftLaw):
    """A shift law of a few constants, fitted or typed in.

    Subclasses are frozen dataclasses with the constants and `reference`; their constructors call `_set`.

    Parameters
    ----------
    covariance : (n, n) array, optional
        Of the constants in the order of `parameters`, where the law was fitted.
    fitted_range : (lowest, highest), optional
        The temperatures that the law was fitted on, K; None where it was typed in.
    bounded : bool
        Whether a law with a fitted range is refused far outside it; see `extrapolation_limits`.

    Notes
    -----
    Two laws are equal if their constants and references are; how they were found does not count.
    """

    covariance: Array | None = field(default=None, compare=False, repr=False)
    fitted_range: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    bounded: bool = field(default=True, compare=False, repr=False)

    #: As `ShiftFactors.law` calls it.
    kind: ClassVar[str]
    #: As it is called in a sentence.
    title: ClassVar[str]
    _constants: ClassVar[dict[str, Constant]]

    def _shown(self) -> Rows:
        return (
            *((name, value) for name, _, value in (one.partition(" = ") for one in self._shown_constants())),
            ("reference", self.reference, "°C"),
            ("fitted range", self.fitted_range, "°C"),
        )

    def _set(
        self, constants: tuple[Any, ...], reference: Any, covariance: Any, fitted_range: Any, bounded: bool
    ) -> None:
        """Validate and set the constants, in the order of `_constants`, and the rest; for subclasses."""
        for (name, constant), value in zip(self._constants.items(), constants, strict=True):
            object.__setattr__(self, name, positive(value, constant.unit, name))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        self._set_fit(covariance, fitted_range, bounded)

    def _set_fit(self, covariance: Any, fitted_range: Any, bounded: bool) -> None:
        """Validate and set the fit's covariance and range; called by the constructors of subclasses."""
        if covariance is not None:
            covariance = checked_covariance(covariance, len(self.parameters), "a shift law")
            covariance.flags.writeable = False
        object.__setattr__(self, "covariance", covariance)
        if fitted_range is not None:
            ends = to_si_array(fitted_range, "K", "fitted_range")
            if ends.size != 2:
                raise wrong_argument("fitted_range", fitted_range, "must be two temperatures.", "wrong-count")
            low, high = (positive(end, "K", "fitted_range") for end in ends.tolist())
            if not low < high:
                raise InputError(
                    f"fitted_range = {low:g} to {high:g} K: the first must lie below the second.", code="not-ascending"
                )
            fitted_range = (low, high)
        object.__setattr__(self, "fitted_range", fitted_range)
        object.__setattr__(self, "bounded", flag(bounded, "bounded"))

    def __str__(self) -> str:
        """Return name, constants with standard errors, and reference, as for a report."""
        return f"{self.title}: {self.described}"

    @property
    def described(self) -> str:
        """The constants with their standard errors, and the reference."""
        return f"{', '.join(self._shown_constants())} about {shown_celsius(self.reference)} °C"

    def _shown_constants(self) -> list[str]:
        errors = self.standard_errors or (0.0,) * len(self.parameters)
        rows = zip(self._constants.values(), self.parameters, errors, strict=True)
        return [shown_constant(constant, float(value), error) for constant, value, error in rows]

    # --- constants -------------------------------------------------------------------------------------------

    @property
    def parameters(self) -> Array:
        """The constants that a fit adjusts, in SI units and in the order of `covariance`."""
        return np.array([getattr(self, name) for name in self._constants], dtype=float)

    def with_parameters(self, parameters: Any) -> Self:
        """Return a law of this kind with other constants at the same reference, as if typed in (not fitted)."""
        values = numbers(parameters, "parameters")
        if values.shape != (len(self._constants),):
            raise wrong_argument("parameters", parameters, f"must be {', '.join(self._constants)}.", "wrong-choice")
        constants = dict(zip(self._constants, values.tolist(), strict=True))
        return replace(self, **constants, covariance=None, fitted_range=None)

    @property
    def has_standard_error(self) -> bool:
        """Whether the uncertainty of α(T) is known: the law was fitted, or its constants have a covariance."""
        return self.covariance is not None

    @property
    def standard_errors(self) -> tuple[float, ...] | None:
        """Standard errors of the constants in the order of `parameters`, SI; None where the law was not fitted."""
        if self.covariance is None:
            return None
        return tuple(float(error) for error in np.sqrt(np.diag(self.covariance)))

    # --- uncertainty -----------------------------------------------------------------------------------------

    def gradient(self, temperature: Any) -> Array:
        """Return the derivatives of log10 α(T) by the constants.

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them
            Plain numbers are in K.

        Returns
        -------
        (..., n) array
            In the shape of `temperature`, then one for each of `parameters`; zero at the reference.

        Raises
        ------
        InputError
            Where `log10` raises it.
        """
        return self._gradient(self._accepted(temperature))

    def _gradient(self, kelvin: Array) -> Array:
        raise NotImplementedError

    def _standard_error(self, kelvin: Array) -> Array:
        """Return the standard error by the delta method, from the constants' covariance."""
        if self.covariance is None:
            raise InputError(
                f"the uncertainty of this {self.title} law is not known, because its constants have no covariance; fit "
                "the law to measured shift factors, or give the covariance.",
                code="no-covariance",
            )
        return _spread(self._gradient(kelvin), self.covariance, self._departures(kelvin))

    def _departures(self, kelvin: Array) -> Array:
        """Return what log10 α may differ by beyond the constants' covariance, (..., m): independent standard errors."""
        return np.zeros((*np.shape(kelvin), 0))

    def _covariance(self, kelvin: Array) -> Array:
        if self.covariance is None:
            return super()._covariance(kelvin)
        gradient, departures = self._gradient(kelvin), self._departures(kelvin)
        return np.asarray(gradient @ self.covariance @ gradient.T + departures @ departures.T)

    def _transformed(self, slope: list[list[float]]) -> Array | None:
        """Return the covariance of new constants (rows) from their derivatives by those of this law (columns)."""
        return None if self.covariance is None else np.array(slope) @ self.covariance @ np.array(slope).T

    # --- extrapolation ---------------------------------------------------------------------------------------

    @property
    def extrapolation_limits(self) -> tuple[float, float]:
        """Lowest and highest temperature at which the law is valid, K.

        A fitted law goes beyond the temperatures of its fit as far as it is known to half a decade (95 %,
        relative to the nearest of them), but no more than 50 K above them and 20 K below, and not closer than
        30 K to a pole.  A law that was typed in, or is `unbounded`, has its pole for its only limit.
        """
        return self._cold().limit, self._hot().limit

    def unbounded(self) -> Self:
        """Return the same law without limits of extrapolation (but its pole): for those who know it to hold."""
        return replace(self, bounded=False)

    def _cold(self) -> Reach:
        if self.fitted_range is None or not self.bounded:
            return Reach(self._divergence, "it diverges there")
        low = self.fitted_range[0]
        reach = self._known(low, -COLDEST_EXTRAPOLATION)
        nearest = min(self._divergence + POLE_MARGIN, low)
        if self._divergence > 0.0 and reach.limit < nearest:
            pole = f"{shown_celsius(self._divergence)} °C"
            return Reach(nearest, f"within {POLE_MARGIN:g} K of its pole at {pole} the material is a glass")
        return reach

    def _hot(self) -> Reach:
        if self.fitted_range is None or not self.bounded:
            return Reach(math.inf, "")
        return self._known(self.fitted_range[1], HOTTEST_EXTRAPOLATION)

    def _known(self, end: float, farthest: float) -> Reach:
        """Return the distance from an end of the fit over which the law is known to half a decade, within a limit."""
        reach = Reach(end + farthest, f"it is used no more than {abs(farthest):g} K beyond its data")
        if self.covariance is None:
            return reach
        steps = np.linspace(0.0, farthest, 101)
        steps = steps[end + steps > self._divergence]
        gradient, departures = (of(end + steps) - of(np.asarray(end)) for of in (self._gradient, self._departures))
        doubt = LEVEL_95 * _spread(gradient, self.covariance, departures)
        beyond = np.flatnonzero(~(doubt <= LARGEST_UNCERTAINTY))
        if not beyond.size:
            return reach
        first = int(beyond[0])  # at least 1: the uncertainty relative to the end itself is zero
        limit = end + float(np.interp(LARGEST_UNCERTAINTY, doubt[first - 1 : first + 1], steps[first - 1 : first + 1]))
        return Reach(limit, f"its 95 % uncertainty beyond its data grows to {LARGEST_UNCERTAINTY:g} decades there")

    def _outside(self, kelvin: Array) -> Mask:
        if self.fitted_range is None:
            return super()._outside(kelvin)
        low, high = self.fitted_range
        outside: Mask = (kelvin < low * (1 - SAME_TEMPERATURE)) | (kelvin > high * (1 + SAME_TEMPERATURE))
        return outside

    def _valid(self, kelvin: Array) -> Mask:
        valid = kelvin > self._divergence
        if self.bounded and self.fitted_range is not None:
            lowest, highest = self.extrapolation_limits
            low, high = min(lowest, self.fitted_range[0]), max(highest, self.fitted_range[1])
            valid &= (kelvin >= low * (1 - SAME_TEMPERATURE)) & (kelvin <= high * (1 + SAME_TEMPERATURE))
        return np.asarray(valid)

    def _attributes(self) -> dict[str, Any]:
        constants = json.dumps(plain(as_record(self), None))
        return {"law": self.title, "constants": constants, "description": str(self)}

    def _refuse(self, kelvin: Array) -> None:
        if np.any(kelvin <= self._divergence):
            coldest = float(kelvin.min())
            raise InputError(
                f"temperature = {shown_celsius(coldest)} °C: the {self.title} law diverges at "
                f"{shown_celsius(self._divergence)} °C and is valid above it only",
                code="below-pole",
                remedy=kelvin_hint(coldest),
            )
        if not self.bounded or self.fitted_range is None or not np.any(self._outside(kelvin)):
            return
        low, high = self.fitted_range
        for end, side, direction, sign in ((low, "below", "down", -1.0), (high, "above", "up", 1.0)):
            wanted = sign * float(np.max(sign * kelvin))
            if sign * wanted <= sign * end * (1.0 + sign * SAME_TEMPERATURE):
                continue
            reach = self._cold() if sign < 0.0 else self._hot()
            if sign * wanted > sign * reach.limit * (1.0 + sign * SAME_TEMPERATURE):
                raise InputError(
                    f"temperature = {shown_celsius(wanted)} °C lies {abs(wanted - end):.3g} K {side} the "
                    f"{shown_celsius(low)} to {shown_celsius(high)} °C that this {self.title} law was fitted on. It is "
                    f"valid {direction} to {shown_celsius(reach.limit)} °C only, because {reach.reason}; "
                    f"{self._remedy()}",
                    code="outside-fitted",
                    remedy=kelvin_hint(wanted),
                )

    def _remedy(self) -> str:
        return "measure isotherms there, or lift the limit with unbounded() of the law, in Python"


def student_factor(freedom: float) -> float:
    """Return the factor on standard errors with which normal 95 % intervals are those of Student's t."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 0.975)) / LEVEL_95


def shown_constant(constant: Constant, value: float, error: float) -> str:
    """Return a constant as text, its standard error to two digits: ``C2 = 126.6 ± 1.2 K``; an error of 0 is unknown."""
    symbol, unit = constant.symbol, f" {constant.shown}" if constant.shown else ""
    value, error = value * constant.factor + constant.offset, error * constant.factor
    if not 0.0 < error < math.inf:
        return f"{symbol} = {shown_number(value, '.4g')}{unit}"
    power = math.floor(math.log10(max(abs(value), error)))
    power = power if power >= 6 else 0
    value, error = value / 10.0**power, error / 10.0**power
    both = with_error(value, error)
    return f"{symbol} = ({both})e{power}{unit}" if power else f"{symbol} = {both}{unit}"


def _spread(gradient: Array, covariance: Array, departures: Array) -> Array:
    variance = np.einsum("...i,ij,...j->...", gradient, covariance, gradient) + np.sum(departures**2, axis=-1)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def law_misfit(law: ParametricLaw, temperatures: Array, log10_values: Array) -> dict[str, float]:
    """Return how far measured log10 α (n,) at temperatures (n,) in K lie from a law, as attributes of data sets."""
    rms = float(np.sqrt(np.mean((log10_values - np.asarray(law.log10(temperatures))) ** 2)))
    return {"rms": rms, "misfit_holds": int(rms <= LARGEST_MISFIT), "misfit_limit": LARGEST_MISFIT}
