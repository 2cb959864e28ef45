"""The result of a superposition of temperature ramps: whether they fall on one curve, and their peaks."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from viscofric.arguments import insist_on
from viscofric.data import MasterCurve
from viscofric.datasets import Dataset, dataset
from viscofric.errors import check_choice
from viscofric.ramps import TemperatureRamp, TemperatureRamps
from viscofric.rheology.ramps.common_law import CorrelatedSmoother
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.rheology.superposition.consistency import REPRODUCIBILITY
from viscofric.rheology.superposition.kramers_kronig import KramersKronig
from viscofric.showing import Plotted, Rows, Shown, with_error
from viscofric.threads import one_blas_thread
from viscofric.units import celsius

PeakOf: TypeAlias = Literal["tan delta", "loss modulus"]
#: A peak has so many points on either side at least; and most of the curves that the errors allow have it inside.
EITHER_SIDE, MOST = 3, 0.95
#: Temperatures are counted in this unit for the curve, K: shift factors change by a decade within a few of them.
DECADE = 5.0
#: Places between the ends that are tried, and curves that the errors allow.
PLACES, DRAWN = 2001, 200


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
        return f"{name} at {hertz:.3g} Hz: {with_error(celsius(self.temperature), self.standard_error)} °C"

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


@one_blas_thread
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

    Raises
    ------
    InputError
        If `ramp` is no ramp, or `by` is another word.

    Notes
    -----
    The temperature of a peak depends on the frequency (by some 3 to 7 K a decade) and on the heating rate; a value
    without its frequency says little.  A smoothing spline is drawn through the logarithm of all points, of which
    neighbours may share errors, as in `superpose_ramps`; the standard error is the root mean square of distances to the
    peaks of curves that these errors allow.  95 % intervals held 94 to 98 % of planted peaks of random rubbers, with
    points 0.3 to 5 K apart and 0.3 to 3 % of noise.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> kelvin = np.arange(253.0, 323.0, 2.0)
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> modulus = rubber.spectrum.complex_modulus(2 * np.pi * 1.0 * rubber.shift(kelvin))  # at 1 Hz
    >>> ramp = vf.readers.TemperatureRamp("1 Hz", kelvin, modulus.real, modulus.imag)
    >>> print(vf.rheology.glass_transition(ramp, "loss modulus"))
    loss modulus at 1 Hz: −13.146 ± 0.039 °C
    """
    insist_on(ramp, "ramp", TemperatureRamp)
    check_choice(by, "by", "tan delta", "loss modulus")
    values = ramp.loss_tangent if by == "tan delta" else ramp.loss_modulus
    logarithm, x = np.log(values)[:, None], (ramp.temperature - ramp.temperature[0]) / DECADE
    top = int(np.argmax(values))
    if min(top, len(x) - 1 - top) < EITHER_SIDE or x[-1] == 0.0:
        return None
    smoother = CorrelatedSmoother.along(x, logarithm, np.ones(len(x) - 1, dtype=bool), points=1)
    curve, _, _ = smoother.curve(0, x, logarithm[:, 0])
    variances, ways = np.linalg.eigh(curve.inverse[0])
    ways = smoother.scatter[0] * np.sqrt(np.maximum(variances, 0.0)) * ways
    random = np.random.default_rng(0)
    drawn = curve.coefficients + ways @ random.standard_normal((len(ways), DRAWN))
    at = np.linspace(0.0, x[-1], PLACES)
    splines = smoother.basis.at(at, 1)[0]
    found = splines @ curve.coefficients[:, 0]
    highest, others = int(np.argmax(found)), np.argmax(splines @ drawn, axis=0)
    if highest in (0, PLACES - 1) or np.mean((others > 0) & (others < PLACES - 1)) < MOST:
        return None
    error = DECADE * np.hypot(np.sqrt(np.mean((at[others] - at[highest]) ** 2)), at[1])
    temperature = float(ramp.temperature[0] + DECADE * at[highest])
    return GlassTransition(ramp.angular_frequency, by, temperature, float(error), float(np.exp(found[highest])))


@dataclass(frozen=True)
class RampCheck(Shown):
    """Whether ramps at several frequencies fall on one curve.

    Parameters
    ----------
    between : float
        Scatter of log10 E' and log10 E'' about the curves that all ramps share, decades (rms).
    within : float
        Scatter of each ramp about its own curves, decades (rms).
    offsets : tuple of float
        Mean distance of each ramp from the common curves, decades, positive where its moduli are larger; the larger one
        of log10 E' and log10 E''.
    """

    between: float
    within: float
    offsets: tuple[float, ...]

    def _shown(self) -> Rows:
        return (
            ("holds", self.holds),
            ("scatter about common curves", self.between, "decades"),
            ("about own curves", self.within, "decades"),
            ("ramps", len(self.offsets)),
        )

    @property
    def holds(self) -> bool:
        """Whether the ramps miss each other by no more than moduli usually repeat to, 0.02 decades."""
        return self.between**2 - self.within**2 <= REPRODUCIBILITY**2

    @property
    def sentence(self) -> str:
        """The verdict in a plain sentence."""
        verdict = "fall on one curve" if self.holds else "do not fall on one curve"
        own = f", and by {self.within:.2g} about curves of their own" if self.within < self.between else ""
        return (
            f"The ramps of {len(self.offsets)} frequencies {verdict}: they scatter by {self.between:.2g} decades about "
            f"common curves of E' and E''{own} (good up to {REPRODUCIBILITY:g} on top of their own)."
        )

    def to_dataset(self) -> Dataset:
        """Return the distances along the dimension ``ramp``, with the verdict as attributes.

        ``offset``, ``between`` and ``within`` (decades); the attributes ``holds`` (1 or 0) and ``sentence``.
        """
        return dataset(
            "ramp",
            {
                "offset": (self.offsets, "1", "mean distance of log10 of the moduli from the common curves"),
                "between": (self.between, "1", "scatter of log10 of the moduli about the common curves"),
                "within": (self.within, "1", "scatter of log10 of the moduli about the curves of each ramp"),
            },
            attributes=self._verdict,
        )

    @property
    def _verdict(self) -> dict[str, Any]:
        return {"holds": int(self.holds), "sentence": self.sentence}


@dataclass(frozen=True, eq=False)
class RampSuperposition(Plotted):
    """The result of `superpose_ramps`.

    Parameters
    ----------
    shift : ShiftLaw
        α(T) about the reference: fitted, with the covariance of its constants, or assumed.
    shift_factors : ShiftFactors
        The same as a table over the temperatures of the ramps, with the covariance that follows.
    master_curve : MasterCurve
        Tensile, at the reference: E(ω, T)/b(T) against α(T) ω, with the temperature of every point.
    ramps : TemperatureRamps
        What was superposed, tensile and as measured.
    glass_transitions : tuple of GlassTransition
        Peaks of tan δ and of E'' of every ramp that has them.
    assumption : str
        Where α(T) was assumed: what it is, in words; empty where it was found from the ramps.
    check : RampCheck or None
        Whether the ramps fall on one curve; None for one frequency.
    causality : KramersKronig or None
        Agreement of E' with E'' on the master curve: the only test of an assumed law at one frequency.
    vertical_shift : VerticalShift or None
        b(T), where one was requested.
    notes : tuple of str
        What the reader noted, what was left out or assumed, and what is doubtful: one sentence each.
    """

    shift: ShiftLaw
    shift_factors: ShiftFactors
    master_curve: MasterCurve
    ramps: TemperatureRamps
    glass_transitions: tuple[GlassTransition, ...] = ()
    assumption: str = ""
    check: RampCheck | None = None
    causality: KramersKronig | None = None
    vertical_shift: VerticalShift | None = None
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("ramps", len(self.ramps.ramps)),
            ("temperature", self.ramps.temperature_range, "°C"),
            ("shift", self.assumption or str(self.shift)),
            ("shift is", "assumed" if self.assumption else "measured"),
            ("reference", self.shift_factors.reference, "°C"),
            ("notes", self.notes),
        )

    def to_dataset(self) -> Dataset:
        """Return the points along ``reading`` as `TemperatureRamps.to_dataset` does, with α(T).

        ``log10_shift_factor`` in addition; among the attributes the reference (K), the assumption, the verdict of the
        check, and the peaks (JSON).
        """
        found = self.ramps.to_dataset()
        peaks = [{"by": one.by, **vars(one)} for one in self.glass_transitions]
        values = dataset(
            "reading",
            {"log10_shift_factor": (self.shift.log10(found["temperature"].values), "1", "log10 of the shift factor")},
        )
        return found.assign(values.data_vars).assign_attrs(
            {
                "reference_temperature": self.master_curve.reference,
                "assumption": self.assumption,
                "law": str(self.shift),
                "glass_transitions": json.dumps(peaks),
                **({} if self.check is None else self.check._verdict),
            }
        )
