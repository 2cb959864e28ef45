"""Result of an identification from indentation: the material, its uncertainty, and the fit of every record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.datasets import dataset
from viscofric.friction.identification.identified import Identified

if TYPE_CHECKING:
    import xarray

    from viscofric.arrays import Array
    from viscofric.friction.identification.indentation.record import IndentationRecord


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


@dataclass(frozen=True, eq=False, kw_only=True)
class MaterialFromIndentation(Identified):
    """A material identified from indentation; the attributes of `Identified`, and these.

    `frequency_range` reaches from one over the longest time up to 0.1 over the shortest one of creep, and 0.01 over
    that of relaxation; faster processes are part of E''(ω), but no longer of the response.  The spectrum may end
    within half a decade of the first or the last of the measured times.

    Attributes
    ----------
    records : tuple of FittedRecord
        In the order of the records; without those at temperatures that were left out.
    """

    records: tuple[FittedRecord, ...]

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        points = sum(len(one.time) for one in self.records)
        fit = (
            f"{points} averaged rows of {len(self.records)} records are fitted to {100.0 * self.rms:.2g} % (root mean "
            f"square); χ² = {self.chi2:.3g} with {self.freedom:.3g} degrees of freedom."
        )
        return (fit, *super().sentences)

    def _band_words(self) -> str:
        return f"{super()._band_words()} Errors of the radius and of the depth's zero are not included."

    def __repr__(self) -> str:
        low, high = self.frequency_range
        return f"MaterialFromIndentation({len(self.records)} records, {low:.3g} to {high:.3g} rad/s)"
