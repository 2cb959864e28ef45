"""Result of an identification: the material, the uncertainty of each part of it, and its limits."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import flag, numbers
from viscofric.notes import codes
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.shift_law import ShiftLaw
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples


#: Factor to which the modulus is given beyond the frequencies of the contacts, and number of frequencies.
_BEYOND = 10.0
_FREQUENCIES = 300
#: Notes with which nothing counts as identified: the friction is not that of one rubber, or of no known rubber.
NOTHING_IDENTIFIED = frozenset({"not-one-rubber", "too-steep", "constant-friction"})


@dataclass(frozen=True)
class IdentifiedBand:
    """Angular frequencies at the reference over which friction determines a modulus.

    Attributes
    ----------
    low, high : float
        rad/s; equal where there is none.
    limit : float
        Largest relative standard error of the modulus between them.
    relative : bool
        Whether it is the modulus over that at the middle frequency, as its magnitude is not known.
    """

    low: float
    high: float
    limit: float
    relative: bool

    @property
    def decades(self) -> float:
        """Its width."""
        return float(np.log10(self.high / self.low))


@dataclass(frozen=True, eq=False)
class LevelFit:
    """The best-fitting material of a given magnitude of the modulus.

    Attributes
    ----------
    factor : float
        |E| at the middle frequency over that of the identified material.
    modulus : float
        That |E|, Pa.
    material : Material
    chi2 : float
        Sum of the squared residuals of the friction, in standard errors.
    rms : float
        Root mean square of the relative residuals.
    penalty : float
        Rise of chi2, including the prior of the spectrum, over the best level; 3.84 is the 95 % limit.
    """

    factor: float
    modulus: float
    material: Material = field(repr=False)
    chi2: float
    rms: float
    penalty: float


@dataclass(frozen=True, eq=False)
class IdentifiedMaterial:
    """A material identified from its friction.

    Samples, bands and standard errors assume a smooth spectrum; it may end, or rise to the glass transition, within a
    decade of the first or the last of the contact's frequencies.  Friction cannot show that this fails: a spectrum of
    one mode per decade ripples E'' by about 6 %, which contacts average out, and fits as well as a smooth one.

    Attributes
    ----------
    material : Material
        Of the greatest posterior density, at the reference.
    samples : MaterialSamples
        Materials drawn from the posterior density: their spread is the uncertainty.
    shift_factors : ShiftLaw or None
        α(T), found with its covariance (ShiftFactors), or as given; None for one temperature.
    shift_found : bool
        Whether α(T) was found from the friction.
    identified : IdentifiedBand
        Of |E(ω)|.
    identified_storage, identified_loss : IdentifiedBand
        Of E' and of E''.
    anchored : bool
        Whether the level of the modulus was given by an anchor or a prior.
    middle : float
        Middle of the contact's frequencies at the reference, rad/s.
    frequency_range : (float, float)
        Lowest and highest frequency v/a of the contacts at the reference, rad/s.
    level_range : (float, float)
        95 % limits of |E| at the middle frequency from the samples, Pa.  Without an anchor they depend on the prior of
        the spectrum, and hold less often.
    family : tuple of LevelFit
        Without an anchor: materials with nearly the same friction; empty with one.
    friction : FrictionCurves
        Of the identified material at the measured points, with 95 % limits.
    residuals : (n,) array
        Measured minus fitted, over the standard error, in the order of `friction`.
    chi2, freedom : float
        Sum of their squares, and their degrees of freedom.
    rms : float
        Root mean square of the relative residuals.
    error_scale : float
        Factor by which the standard errors of the measurement were multiplied, as the residuals are larger.
    roughness : float
        Standard deviation of d ln C/d ln τ over an e-fold of τ for which there is most evidence.
    iterations : int
        Steps made, with contacts solved in each.
    notes : tuple of str
        One sentence each.
    """

    material: Material
    samples: MaterialSamples
    shift_factors: ShiftLaw | None
    shift_found: bool
    identified: IdentifiedBand
    identified_storage: IdentifiedBand
    identified_loss: IdentifiedBand
    anchored: bool
    middle: float
    frequency_range: tuple[float, float]
    level_range: tuple[float, float]
    family: tuple[LevelFit, ...]
    friction: FrictionCurves
    residuals: Array
    chi2: float
    freedom: float
    rms: float
    error_scale: float
    roughness: float
    iterations: int
    notes: tuple[str, ...] = ()

    def standard_error(self, angular_frequency: ArrayLike, *, relative: bool | None = None) -> Array:
        """Return the relative standard error of |E(ω)| at the reference.

        Parameters
        ----------
        angular_frequency : array_like
            rad/s.
        relative : bool, optional
            Whether of |E(ω)| over that at the middle frequency; if not given, without an anchor.
        """
        omega = numbers(angular_frequency, "angular_frequency")
        rows = np.array([np.log(np.abs(one.complex_modulus(omega))) for one in self.samples.materials])
        if not self.anchored if relative is None else flag(relative, "relative"):
            level = self._levels
            rows = rows - level.reshape((-1,) + (1,) * omega.ndim)
        return np.asarray(rows.std(axis=0, ddof=1))

    @property
    def frequencies(self) -> Array:
        """Angular frequencies (300,) of the contacts and of `identified`, and a decade beyond on both sides, rad/s."""
        (first, last), band = self.frequency_range, self.identified
        return np.geomspace(min(first, band.low) / _BEYOND, max(last, band.high) * _BEYOND, _FREQUENCIES)

    def to_dataset(self, angular_frequency: ArrayLike | None = None) -> xarray.Dataset:
        """Return the modulus at the reference with its 95 % limits as a labelled data set.

        Parameters
        ----------
        angular_frequency : (n,) array_like, optional
            rad/s; if not given, `frequencies`.

        Returns
        -------
        xarray.Dataset
            Along ``angular_frequency``; what was found besides, in SI units, in its attributes.
        """
        from viscofric.datasets import dataset

        wanted = self.frequencies if angular_frequency is None else numbers(angular_frequency, "angular_frequency")
        omega = np.ravel(wanted)
        modulus, band = np.asarray(self.material.complex_modulus(omega)), self.samples.modulus_band(omega)
        columns = {"modulus_error": (self.standard_error(omega), "1", "relative standard error of |E|")}
        if not self.anchored:
            columns["modulus_error"] = (*columns["modulus_error"][:2], "relative standard error of |E| over its level")
        for name, part in (("storage", "real"), ("loss", "imag")):
            columns[f"{name}_modulus"] = (getattr(modulus, part), "Pa", f"{name} modulus")
            for side in ("lower", "upper"):
                limit, words = getattr(getattr(band, side), part), f"{side} end of the 95 % band of the {name} modulus"
                columns[f"{name}_modulus_{side}"] = (limit, "Pa", words)
        return dataset(
            "angular_frequency",
            columns,
            coordinates={"angular_frequency": (omega, "rad/s", "angular frequency")},
            attributes={
                "reference_temperature": self.material.reference,
                "identified_low": self.identified.low,
                "identified_high": self.identified.high,
                "identified_limit": self.identified.limit,
                "middle": self.middle,
                "level_lower": self.level_range[0],
                "level_upper": self.level_range[1],
                "anchored": int(self.anchored),
                "chi2": self.chi2,
                "freedom": self.freedom,
                "rms": self.rms,
                "error_scale": self.error_scale,
                "sentences": json.dumps(self.sentences, ensure_ascii=False),
            },
        )

    def friction_dataset(self) -> xarray.Dataset:
        """Return `friction` as a labelled data set along ``point``, with the residuals as ``residual``."""
        label = {"units": "1", "long_name": "measured less fitted friction over the standard error"}
        return self.friction.to_dataset().assign(residual=("point", self.residuals, label))

    def shift_dataset(self) -> xarray.Dataset | None:
        """Return α(T) at the temperatures of the friction as a labelled data set; None for one temperature."""
        from viscofric.datasets import dataset

        law = self.shift_factors
        if law is None:
            return None
        kelvin = getattr(law, "temperatures", self.friction.temperatures)
        log10, error = law.values_at(kelvin)
        return dataset(
            "temperature",
            {
                "log10_shift_factor": (log10, "1", "decadic logarithm of the shift factor"),
                "standard_error": (error, "1", "standard error of log10 of the shift factor"),
            },
            coordinates={"temperature": (kelvin, "K", "temperature")},
            attributes={"reference_temperature": law.reference, "found": int(self.shift_found)},
        )

    @cached_property
    def _levels(self) -> Array:
        return np.array([np.log(np.abs(one.complex_modulus(self.middle))) for one in self.samples.materials])

    @property
    def known(self) -> tuple[str, ...]:
        """The identified parts of the modulus, one sentence each; they are stored with the material."""
        return (*self._level_words(), self._band_words())

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        return (self._fit_words(), *self.known, *self._shift_words(), *self.notes)

    def _fit_words(self) -> str:
        return (
            f"The friction of {len(self.friction)} points is fitted to {100.0 * self.rms:.2g} % (root mean square); χ² "
            f"= {self.chi2:.3g} with {self.freedom:.3g} degrees of freedom."
        )

    def _level_words(self) -> tuple[str, ...]:
        low, high = self.level_range
        if self.anchored:
            return ()
        sentence = (
            "The level of the modulus is not identified: friction alone hardly determines it, and no anchor or prior "
            f"was given. |E| at {self.middle:.2g} rad/s, {low / 1e6:.3g} to {high / 1e6:.3g} MPa, follows from the "
            "prior of the spectrum and not from the friction, so that every modulus is known up to a factor; the "
            "family has materials with nearly the same friction."
        )
        return (sentence,)

    def _band_words(self) -> str:
        band = self.identified
        about = "" if self.shift_factors is None else f" at {shown_celsius(float(self.shift_factors.reference))} °C"
        of = "|E(ω)| over its level" if band.relative else "|E(ω)|"
        if codes(self.notes) & NOTHING_IDENTIFIED:
            return "Nothing of the modulus is identified: the friction may not come from the loss of a rubber."
        if band.high <= band.low:
            return f"Nowhere is the standard error of {of} {100.0 * band.limit:g} % or less."
        return (
            f"The standard error of {of} is {100.0 * band.limit:g} % or less from {band.low:.2g} to {band.high:.2g} "
            f"rad/s{about}, {band.decades:.1f} decades, that of E'' over {self.identified_loss.decades:.1f} of them; "
            "beyond, the material is extrapolated, with the band of a smooth spectrum. All bands assume a smooth "
            "spectrum: one mode per decade makes E'' oscillate by about 6 %, which friction averages and no band has."
        )

    def _shift_words(self) -> tuple[str, ...]:
        from viscofric.rheology.shifts.shift_factors import ShiftFactors

        if not self.shift_found or not isinstance(self.shift_factors, ShiftFactors):
            return ()
        largest = float(self.shift_factors.standard_errors.max())
        sentence = (
            f"α(T) was found from the friction at {len(self.shift_factors.temperatures)} temperatures, each factor to "
            f"{largest:.2g} decades or better."
        )
        return (sentence,)

    def __str__(self) -> str:
        return "\n".join((repr(self.material.at()), *self.sentences))
