"""The glass transition of a ramp: the temperature where tan δ, or the loss modulus, has its peak."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array, Mask
from viscofric.datasets import Dataset, dataset
from viscofric.errors import check_choice
from viscofric.ramps import TemperatureRamp
from viscofric.rheology.superposition.shift_problem import inflation
from viscofric.showing import Rows, Shown
from viscofric.units import shown_celsius

PeakOf: TypeAlias = Literal["tan delta", "loss modulus"]
#: The peak is drawn through points that are higher than this part of the highest one …
PART = 0.8
#: … as a polynomial of this degree in the logarithm.
DEGREE = 4
#: … and through so many on either side at least; without them there is no peak.
EITHER_SIDE = 3
#: Places between the ends that are tried.
PLACES = 2001


@dataclass(frozen=True)
class GlassTransition(Shown):
    """A peak of a temperature ramp.

    Parameters
    ----------
    angular_frequency : float
        Of the ramp, rad/s.
    by : {"tan delta", "loss modulus"}
        What has its peak there.
    temperature : float
        K.
    standard_error : float
        From the scatter of the points, K; an error of the thermometer, and its lag, come on top.
    height : float
        tan δ, or E'' (G'') in Pa, at the peak.
    """

    angular_frequency: float
    by: PeakOf
    temperature: float
    standard_error: float
    height: float

    def _shown(self) -> Rows:
        return (
            ("peak of", self.by),
            ("frequency", self.angular_frequency / (2.0 * np.pi), "Hz"),
            ("temperature", self.temperature, "°C", self.standard_error),
            ("height", self.height, "Pa" if self.by == "loss modulus" else ""),
        )

    def __str__(self) -> str:
        """Return the peak as a line of text."""
        hertz = self.angular_frequency / (2.0 * np.pi)
        name = "tan δ" if self.by == "tan delta" else "loss modulus"
        return f"{name} at {hertz:.3g} Hz: {shown_celsius(self.temperature)} ± {self.standard_error:.2g} °C"

    def to_dataset(self) -> Dataset:
        """Return the peak as single numbers.

        ``angular_frequency`` (rad/s), ``temperature`` and ``standard_error`` (K), ``height`` (1 or Pa); the attribute
        ``by``.
        """
        return dataset(
            (),
            {
                "angular_frequency": (self.angular_frequency, "rad/s", "angular frequency"),
                "temperature": (self.temperature, "K", "temperature of the peak"),
                "standard_error": (self.standard_error, "K", "standard error of the temperature of the peak"),
                "height": (self.height, "1" if self.by == "tan delta" else "Pa", f"{self.by} at the peak"),
            },
            attributes={"by": self.by},
        )


def glass_transition(ramp: TemperatureRamp, by: PeakOf = "tan delta") -> GlassTransition | None:
    """Return the peak of tan δ, or of the loss modulus, of a ramp; None if it has no peak inside its temperatures.

    Parameters
    ----------
    ramp : TemperatureRamp
        One frequency.
    by : {"tan delta", "loss modulus"}
        The peak of the loss modulus lies lower than that of tan δ, by 5 to 20 K for rubbers.

    Returns
    -------
    GlassTransition or None

    Notes
    -----
    The temperature of a peak depends on the frequency (by some 3 to 7 K a decade) and on the heating rate; a value
    without its frequency says little.  A polynomial of fourth degree is fitted to the logarithm of the points above
    80 % of the highest one, about it, and of the next three on either side; the standard error follows from their
    scatter, alike neighbours counting for fewer.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> kelvin = np.arange(253.0, 323.0, 2.0)
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> modulus = rubber.spectrum.complex_modulus(2 * np.pi * 1.0 * rubber.shift(kelvin))  # at 1 Hz
    >>> ramp = vf.readers.TemperatureRamp("1 Hz", kelvin, modulus.real, modulus.imag)
    >>> print(vf.rheology.glass_transition(ramp, "loss modulus"))
    loss modulus at 1 Hz: −12.9 ± 0.14 °C
    """
    insist_on(ramp, "ramp", TemperatureRamp)
    check_choice(by, "by", "tan delta", "loss modulus")
    values = ramp.loss_tangent if by == "tan delta" else ramp.loss_modulus
    inside = _about_the_peak(values)
    kelvin, logarithm = ramp.temperature[inside], np.log(values[inside])
    top = int(np.argmax(logarithm))
    if min(top, len(kelvin) - 1 - top) < EITHER_SIDE or np.ptp(kelvin) == 0.0:
        return None
    half = 0.5 * float(np.ptp(kelvin))
    x = (kelvin - kelvin[0]) / half - 1.0
    basis = np.polynomial.legendre.legvander(x, DEGREE)
    inverse = np.linalg.inv(basis.T @ basis)
    coefficients = inverse @ (basis.T @ logarithm)
    residual = logarithm - basis @ coefficients
    curve = np.polynomial.Legendre(coefficients)
    places = np.linspace(-1.0, 1.0, PLACES)
    highest = int(np.argmax(curve(places)))
    if highest in (0, PLACES - 1):
        return None
    slope, bend = curve.deriv(1), curve.deriv(2)
    place = float(places[highest])
    for _ in range(5):
        place -= float(slope(place) / bend(place))
    slopes = np.array([np.polynomial.Legendre.basis(n).deriv(1)(place) for n in range(DEGREE + 1)])
    variance = float(residual @ residual) / max(len(x) - DEGREE - 1, 1)
    variance *= inflation(residual, np.ones(len(x) - 1, dtype=bool))
    error = float(np.sqrt(variance * slopes @ inverse @ slopes)) / abs(float(bend(place)))
    temperature = float(kelvin[0] + half * (place + 1.0))
    return GlassTransition(ramp.angular_frequency, by, temperature, half * error, float(np.exp(curve(place))))


def _about_the_peak(values: Array) -> Mask:
    """Return which points belong to the highest peak: the run about it above a part of it, or the nearest ones."""
    high = values >= PART * values.max()
    top = int(np.argmax(values))
    below = np.flatnonzero(~high)
    first = int(below[below < top].max(initial=-1)) + 1
    last = int(below[below > top].min(initial=len(values)))
    found = np.zeros(len(values), dtype=bool)
    found[max(min(first, top - EITHER_SIDE), 0) : max(last, top + EITHER_SIDE + 1)] = True
    return found
