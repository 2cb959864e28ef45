"""Results of identifications: the material, its samples, and the frequencies over which its moduli are known."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import flag
from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.files import SYNTHETIC, of_synthetic, on_source
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.identification.anchors import Known
from viscofric.notes import Note, codes
from viscofric.rheology.catalogue import is_synthetic
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import LN10, ShiftLaw
from viscofric.rheology.spectra.quality import FROM_FRICTION, FROM_INDENTATION, SpectrumFit
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.showing import Plotted, Rows
from viscofric.units import in_si, plain, shown_celsius

#: Factor to which the modulus is given beyond the measured frequencies, and number of frequencies.
_BEYOND = 10.0
_FREQUENCIES = 300
#: Change of friction from the half-space to a layer that is named, relative.
LAYER = 0.02


def log_magnitudes(samples: MaterialSamples, angular_frequency: Array | float) -> Array:
    """Return ln |E| of every sample (samples, …) at angular frequencies, rad/s."""
    return np.array([np.log(np.abs(one.complex_modulus(angular_frequency))) for one in samples.materials])


@dataclass(frozen=True)
class IdentifiedBand:
    """Angular frequencies at the reference over which a modulus is determined."""

    low: float  # rad/s
    high: float  # equal to `low` where there is none
    limit: float  # largest relative standard error of the modulus between them
    relative: bool  # whether it is the modulus over that at the middle frequency, as its magnitude is not known

    @property
    def decades(self) -> float:
        """Its width."""
        return float(np.log10(self.high / self.low))


@dataclass(frozen=True, eq=False, kw_only=True)
class Identified(Plotted):
    """A material identified from a measurement: what results from friction and from indentation have in common.

    Samples, bands and standard errors assume a smooth spectrum; it may end, or rise to the glass transition, near the
    first and the last of the measured frequencies.

    Attributes
    ----------
    material : Material
        Of the greatest posterior density, at the reference.
    samples : MaterialSamples
        Materials drawn from the posterior density: their spread is the uncertainty.
    shift_factors : ShiftLaw or None
        α(T), found with its covariance (ShiftFactors), or as given; None for one temperature.
    shift_found : bool
        Whether α(T) was found from the measurement.
    identified : IdentifiedBand
        Of |E(ω)|.
    identified_storage, identified_loss : IdentifiedBand
        Of E' and of E''.
    anchored : bool
        Whether the level of the modulus is known: from the measurement, an anchor or a prior.
    middle : float
        Middle of `frequency_range`, rad/s.
    frequency_range : (float, float)
        Lowest and highest angular frequency at the reference that the measurement covers, rad/s.
    chi2, freedom : float
        Sum of the squared residuals, and their degrees of freedom.
    rms : float
        Root mean square of the relative residuals.
    error_scale : float
        Factor by which given standard errors were multiplied because the residuals are larger.
    roughness : float
        Standard deviation of d ln C/d ln τ over an e-fold of τ for which there is most evidence.
    notes : tuple of str
        One sentence each.
    """

    #: What it is identified from (`SpectrumFit.method`), and the end of the sentence on unmeasured moduli.
    METHOD: ClassVar[str]
    UNMEASURED: ClassVar[str] = ""

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
    chi2: float
    freedom: float
    rms: float
    error_scale: float
    roughness: float
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("material", self.material.name or None),
            ("spectrum", self.material.spectrum),
            ("frequencies", self.frequency_range, "rad/s"),
            ("determined E", f"{self.identified.decades:.2g} decades"),
            ("magnitude known", self.anchored),
            ("misfit (rms)", self.rms, "%"),
            ("samples", len(self.samples)),
            ("notes", self.notes),
        )

    def standard_error(self, angular_frequency: ArrayLike, *, relative: bool | None = None) -> Array:
        """Return the relative standard error of |E(ω)| at the reference.

        Parameters
        ----------
        angular_frequency : array_like
            rad/s.
        relative : bool, optional
            Whether of |E(ω)| over that at the middle frequency; if not given, without an anchor.
        """
        omega = in_si(angular_frequency, "rad/s", "angular_frequency")
        rows = log_magnitudes(self.samples, omega)
        if not self.anchored if relative is None else flag(relative, "relative"):
            rows = rows - log_magnitudes(self.samples, self.middle).reshape((-1,) + (1,) * omega.ndim)
        return np.asarray(rows.std(axis=0, ddof=1))

    @property
    def frequencies(self) -> Array:
        """Angular frequencies (300,) of `frequency_range` and `identified`, a decade beyond on both sides, rad/s."""
        (first, last), band = self.frequency_range, self.identified
        return np.geomspace(min(first, band.low) / _BEYOND, max(last, band.high) * _BEYOND, _FREQUENCIES)

    def to_dataset(self, angular_frequency: ArrayLike | None = None) -> Dataset:
        """Return the modulus at the reference with its 95 % limits as a labelled data set.

        Parameters
        ----------
        angular_frequency : (n,) array_like, optional
            rad/s; if not given, `frequencies`.

        Returns
        -------
        xarray.Dataset
            Along ``angular_frequency``: ``storage_modulus`` and ``loss_modulus`` with ``_lower`` and ``_upper`` (Pa),
            and ``modulus_error``, relative; the other results, in SI units, are its attributes.
        """
        wanted = (
            self.frequencies if angular_frequency is None else in_si(angular_frequency, "rad/s", "angular_frequency")
        )
        omega = np.ravel(in_si(wanted, "rad/s", "angular_frequency"))
        modulus, band = np.asarray(self.material.complex_modulus(omega)), self.samples.modulus_band(omega)
        columns = {}
        for name, part in (("storage", "real"), ("loss", "imag")):
            columns[f"{name}_modulus"] = (getattr(modulus, part), "Pa", f"{name} modulus")
            for side in ("lower", "upper"):
                limit, words = getattr(getattr(band, side), part), f"{side} end of the 95 % band of the {name} modulus"
                columns[f"{name}_modulus_{side}"] = (limit, "Pa", words)
        of = "|E|" if self.anchored else "|E| over that at the middle frequency"
        columns["modulus_error"] = (self.standard_error(omega), "1", f"relative standard error of {of}")
        return dataset(
            "angular_frequency",
            columns,
            coordinates={"angular_frequency": (omega, "rad/s", "angular frequency")},
            attributes=self._attributes(),
        )

    def _attributes(self) -> dict[str, Any]:
        """Return the attributes of the data set."""
        ends = {f"identified_{name}": getattr(self.identified, name) for name in ("low", "high", "limit")}
        found = {"reference_temperature": self.material.reference, **ends, "middle": self.middle}
        found |= {"anchored": int(self.anchored)}
        found |= {name: getattr(self, name) for name in ("chi2", "freedom", "rms", "error_scale")}
        return found | {"sentences": json.dumps(self.sentences, ensure_ascii=False)}

    @property
    def known(self) -> tuple[str, ...]:
        """The identified parts of the modulus, one sentence each; they are stored with the material."""
        return (self._band_words(),)

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        return (*self.known, *self.notes)

    def _band_words(self) -> str:
        band = self.identified
        about = "" if self.shift_factors is None else f" at {shown_celsius(float(self.shift_factors.reference))} °C"
        of = f"|E(ω)| over |E| at {self.middle:.2g} rad/s" if band.relative else "|E(ω)|"
        if band.high <= band.low:
            return f"Nowhere is the standard error of {of} {100.0 * band.limit:g} % or less."
        loss = self.identified_loss.decades
        of_loss = f"over {loss:.1f} of them" if loss >= 0.05 else "nowhere"  # 0.05 is written as 0.1
        return (
            f"The standard error of {of} is {100.0 * band.limit:g} % or less from {band.low:.2g} to {band.high:.2g} "
            f"rad/s{about}, {band.decades:.1f} decades, that of E'' {of_loss}; "
            "beyond, the material is extrapolated, with the band of a smooth spectrum."
        )

    def __str__(self) -> str:
        return "\n".join((repr(self.material.at()), *self.sentences))


#: Notes with which nothing counts as identified: the friction is not that of one rubber, or of no known rubber.
NOTHING_IDENTIFIED = frozenset({"not-one-rubber", "too-steep", "constant-friction"})


@dataclass(frozen=True, eq=False)
class LevelFit:
    """The best-fitting material of a given magnitude of the modulus."""

    factor: float  # |E| at the middle frequency over that of the identified material
    modulus: float  # that |E|, Pa
    material: Material = field(repr=False)
    chi2: float  # sum of the squared residuals of the friction, in standard errors
    rms: float  # root mean square of the relative residuals
    penalty: float  # rise of chi2, including the prior of the spectrum, over the best level; 3.84 is the 95 % limit


@dataclass(frozen=True, eq=False, kw_only=True)
class IdentifiedMaterial(Identified):
    """A material identified from its friction; the attributes of `Identified`, and these.

    `frequency_range` are the lowest and highest frequency v/a of the contacts; the spectrum may end, or rise to the
    glass transition, within a decade of them.  Friction cannot show that the smooth spectrum fails: one mode per decade
    ripples E'' by about 6 %, which contacts average out, and fits as well as a smooth one.

    Attributes
    ----------
    level_range : (float, float)
        95 % limits of |E| at the middle frequency from the samples, Pa.  Without an anchor they depend on the prior of
        the spectrum, and hold less often.
    family : tuple of LevelFit
        Without an anchor: materials with nearly the same friction; empty with one.
    friction : FrictionCurves
        Of the identified material at the measured points, with 95 % limits.
    residuals : (n,) array
        Measured minus fitted, over the standard error, in the order of `friction`.
    iterations : int
        Steps made, with contacts solved in each.
    half_space_thickness : float
        Thickness of the rubber, which is taken to be a half-space, of whose layer friction differs by 2 %, m; estimated
        as in `check_assumptions`.
    """

    METHOD: ClassVar[str] = FROM_FRICTION

    level_range: tuple[float, float]
    family: tuple[LevelFit, ...]
    friction: FrictionCurves
    residuals: Array
    iterations: int
    half_space_thickness: float

    def _attributes(self) -> dict[str, Any]:
        low, high = self.level_range
        return super()._attributes() | {"level_lower": low, "level_upper": high}

    def friction_dataset(self) -> Dataset:
        """Return `friction` as a labelled data set along ``point``, with the residuals as ``residual``."""
        label = {"units": "1", "long_name": "measured less fitted friction over the standard error"}
        return self.friction.points_dataset().assign(residual=("point", self.residuals, label))

    def shift_dataset(self) -> Dataset | None:
        """Return α(T) at the temperatures of the friction as a labelled data set; None for one temperature."""
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

    @property
    def known(self) -> tuple[str, ...]:
        """The identified parts of the modulus, one sentence each; they are stored with the material."""
        return (*self._level_words(), self._band_words())

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        fit = (
            f"The friction of {len(self.friction)} points is fitted to {100.0 * self.rms:.2g} % (root mean square); χ² "
            f"= {self.chi2:.3g} with {self.freedom:.3g} degrees of freedom."
        )
        body = (
            f"The rubber is taken to be a half-space: on a layer of {plain(1e3 * self.half_space_thickness, 2)} mm, "
            f"bonded to a rigid base, friction differs by {100.0 * LAYER:g} %, on a thinner one by more, so that "
            "another modulus is found."
        )
        return (fit, *self.known, *self._shift_words(), body, *self.notes)

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
        if codes(self.notes) & NOTHING_IDENTIFIED:
            return "Nothing of the modulus is identified: the friction may not come from the loss of a rubber."
        if self.identified.high <= self.identified.low:
            return super()._band_words()
        return (
            f"{super()._band_words()} All bands assume a smooth spectrum: one mode per decade makes E'' oscillate by "
            "about 6 % and changes friction by a few per cent, which no band has."
        )

    def _shift_words(self) -> tuple[str, ...]:
        if not self.shift_found or not isinstance(self.shift_factors, ShiftFactors):
            return ()
        factors = self.shift_factors
        largest = float(factors.standard_errors.max())
        steepest = float(np.abs(np.gradient(factors.log10_values, factors.temperatures)).max())
        sentence = (
            f"α(T) was found from the friction at {len(factors.temperatures)} temperatures, each factor to "
            f"{largest:.2g} decades or better; an error of 1 K in temperature is worth up to {steepest:.2g} decades."
        )
        return (sentence,)


def synthetic_notes(source: str, *known: Known | ShiftLaw | None) -> tuple[Note, ...]:
    """Return notes on what is synthetic behind an identification: the measurement, a prior, or given shift factors."""
    notes = on_source(source)
    for one in known:
        materials = one.materials[:1] if isinstance(one, MaterialSamples) else (one,)
        named = [material.name for material in materials if isinstance(material, Material) and is_synthetic(material)]
        notes += [Note(SYNTHETIC, f"The prior is synthetic ({name}).") for name in named]
        notes += of_synthetic(getattr(one, "notes", ()))
    return tuple(notes)


def with_origin(found: Identified, source: str) -> Material:
    """Return the identified material with its origin, for its file; `source` of the measurement may be empty."""
    spectrum, band = found.material.spectrum, found.identified
    assert isinstance(spectrum, RetardationSpectrum)
    # Known nowhere: everything but the middle is extrapolated.
    ends = (band.low, band.high) if band.high > band.low else (found.middle, found.middle)
    behind = f" ({source})" if source else ""
    origin = Note(
        f"identified-from-{found.METHOD}",
        f"The material was identified from {found.METHOD}{behind}; none of its moduli was measured{found.UNMEASURED}.",
        values={"source": source},
    )
    fit = SpectrumFit(
        None,
        None,
        E0_extrapolated=True,
        E_inf_extrapolated=True,
        frequency_range=(float(ends[0]), float(ends[1])),
        notes=(origin, *of_synthetic(found.notes), *found.known),
        method=found.METHOD,
        modes=len(spectrum),
        rms_step=found.rms / LN10 if found.METHOD == FROM_INDENTATION else None,
    )
    return replace(found.material, spectrum=replace(spectrum, fit=fit))
