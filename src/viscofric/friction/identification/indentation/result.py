"""Result of an identification from indentation: the material, its uncertainty, and the fit of every record."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import numbers
from viscofric.datasets import dataset
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array
    from viscofric.friction.identification.indentation.record import IndentationRecord
    from viscofric.friction.identification.result import IdentifiedBand
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.shift_law import ShiftLaw
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples


#: Factor to which the modulus is given beyond the measured times, and number of frequencies.
_BEYOND = 10.0
_FREQUENCIES = 300
#: Prescribed quantity -> unit and long name of what is fitted: X(δ), the load over E/(1−ν²), or the load.
_FITTED = {"load": ("m2", "load over the plane-strain modulus, X(δ)"), "indentation": ("N", "normal load")}


@dataclass(frozen=True, eq=False)
class FittedRecord:
    """The averaged rows of a record, and their fit.

    Attributes
    ----------
    record : IndentationRecord
        As given.
    time : (n,) array
        Since its start, s.
    response : (n,) array
        Measured response.  If the load was prescribed, X(δ), m², which is (4/3) √R δ^{3/2} for a ball; if the depth
        was, the load, N.
    fitted, lower, upper : (n,) array
        Response of the identified material, and its 95 % limits from the samples.
    error : (n,) array
        Relative standard error of the response: as given, or as found from the residuals.
    count : (n,) array
        Rows averaged.
    """

    record: IndentationRecord
    time: Array
    response: Array
    fitted: Array
    lower: Array
    upper: Array
    error: Array
    count: Array

    @property
    def residuals(self) -> Array:
        """Measured minus fitted logarithms, over the standard errors, (n,)."""
        return np.asarray(np.log(self.response / self.fitted) / self.error)

    def to_dataset(self) -> xarray.Dataset:
        """Return the averaged rows and their fit as a labelled data set along ``point``.

        Returns
        -------
        xarray.Dataset
            ``time`` (s), ``response``, ``fitted_response``, ``fitted_response_lower`` and ``fitted_response_upper`` (m²
            or N), ``response_error`` and ``residual``; the attributes are ``control``, ``temperature`` (K) and
            ``source``.
        """
        unit, words = _FITTED[self.record.control]
        return dataset(
            "point",
            {
                "time": (self.time, "s", "time since the start"),
                "response": (self.response, unit, words),
                "fitted_response": (self.fitted, unit, f"{words}, of the identified material"),
                "fitted_response_lower": (self.lower, unit, "lower end of its 95 % band"),
                "fitted_response_upper": (self.upper, unit, "upper end of its 95 % band"),
                "response_error": (self.error, "1", "relative standard error of the response"),
                "residual": (self.residuals, "1", "measured less fitted response over the standard error"),
            },
            attributes={
                "control": self.record.control,
                "temperature": self.record.temperature,
                "source": self.record.source,
            },
        )


@dataclass(frozen=True, eq=False)
class MaterialFromIndentation:
    """A material identified from indentation.

    Samples, bands and standard errors assume a smooth spectrum, which may end within half a decade of the first or the
    last of the measured times.

    Attributes
    ----------
    material : Material
        Material of the greatest posterior density, at the reference.
    samples : MaterialSamples
        Materials drawn from the posterior density: their spread is the uncertainty.
    shift_factors : ShiftLaw or None
        α(T), found with its covariance (ShiftFactors), or as given; None for one temperature.
    shift_found : bool
        Whether α(T) was found from the records.
    identified : IdentifiedBand
        Of |E(ω)|.
    identified_storage, identified_loss : IdentifiedBand
        Of E' and of E''.
    middle : float
        Middle of `frequency_range`, rad/s.
    frequency_range : (float, float)
        Reduced angular frequencies that the records determine, rad/s: from one over the longest time up to 0.1 over
        the shortest one of creep, and 0.01 over that of relaxation; faster processes are part of E''(ω), but no longer
        of the response.
    records : tuple of FittedRecord
        In the order of the records; without those at temperatures that were left out.
    chi2, freedom : float
        Sum of the squared residuals, and their degrees of freedom.
    rms : float
        Root mean square of the relative residuals of the responses.
    error_scale : float
        Factor by which given standard errors were multiplied because the residuals are larger.
    roughness : float
        Standard deviation of d ln C/d ln τ over an e-fold of τ, at the greatest evidence.
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
    middle: float
    frequency_range: tuple[float, float]
    records: tuple[FittedRecord, ...]
    chi2: float
    freedom: float
    rms: float
    error_scale: float
    roughness: float
    notes: tuple[str, ...] = ()

    @property
    def frequencies(self) -> Array:
        """Angular frequencies (300,) of `frequency_range`, and a decade beyond on both sides, rad/s."""
        low, high = self.frequency_range
        return np.geomspace(low / _BEYOND, high * _BEYOND, _FREQUENCIES)

    def to_dataset(self, angular_frequency: ArrayLike | None = None) -> xarray.Dataset:
        """Return the modulus at the reference with its 95 % limits as a labelled data set.

        Parameters
        ----------
        angular_frequency : (n,) array_like, optional
            rad/s; if not given, `frequencies`.

        Returns
        -------
        xarray.Dataset
            Along ``angular_frequency``: ``storage_modulus`` and ``loss_modulus`` with ``_lower`` and ``_upper`` (Pa);
            the other results, in SI units, are its attributes.
        """
        wanted = self.frequencies if angular_frequency is None else numbers(angular_frequency, "angular_frequency")
        omega = np.ravel(wanted)
        modulus = np.asarray(self.material.complex_modulus(omega))
        columns = {
            f"{name}_modulus": (getattr(modulus, part), "Pa", f"{name} modulus")
            for name, part in (("storage", "real"), ("loss", "imag"))
        }
        found = dataset(
            "angular_frequency",
            columns,
            coordinates={"angular_frequency": (omega, "rad/s", "angular frequency")},
            attributes={
                "reference_temperature": self.material.reference,
                "identified_low": self.identified.low,
                "identified_high": self.identified.high,
                "identified_limit": self.identified.limit,
                "chi2": self.chi2,
                "freedom": self.freedom,
                "rms": self.rms,
                "error_scale": self.error_scale,
                "sentences": json.dumps(self.sentences, ensure_ascii=False),
            },
        )
        return found.assign(self.samples.to_dataset(omega).data_vars)

    @property
    def known(self) -> tuple[str, ...]:
        """The identified parts of the modulus, one sentence each; they are stored with the material."""
        band = self.identified
        if band.high <= band.low:
            return (f"Nowhere is the standard error of |E(ω)| {100.0 * band.limit:g} % or less.",)
        about = "" if self.shift_factors is None else f" at {shown_celsius(float(self.shift_factors.reference))} °C"
        sentence = (
            f"The standard error of |E(ω)| is {100.0 * band.limit:g} % or less from {band.low:.2g} to {band.high:.2g} "
            f"rad/s{about}, {band.decades:.1f} decades, that of E'' over {self.identified_loss.decades:.1f} of them; "
            "beyond, the material is extrapolated, with the band of a smooth spectrum. Errors of the radius and of the "
            "depth's zero are not included."
        )
        return (sentence,)

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        points = sum(len(one.time) for one in self.records)
        fit = (
            f"{points} averaged rows of {len(self.records)} records are fitted to {100.0 * self.rms:.2g} % (root mean "
            f"square); χ² = {self.chi2:.3g} with {self.freedom:.3g} degrees of freedom."
        )
        return (fit, *self.known, *self.notes)

    def __repr__(self) -> str:
        low, high = self.frequency_range
        return f"MaterialFromIndentation({len(self.records)} records, {low:.3g} to {high:.3g} rad/s)"

    def __str__(self) -> str:
        return "\n".join((repr(self.material.at()), *self.sentences))
