"""Result of an identification from indentation: the material, its uncertainty, and the fit of every record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.friction.identification.indentation.setting_up import Record
from viscofric.friction.identification.indentation.tables import OF_IMPACTS, STIFFNESSES
from viscofric.friction.identification.result import Identified
from viscofric.rheology.spectra.quality import FROM_INDENTATION
from viscofric.showing import Plotted, Rows, with_error

#: Quantity -> unit and long name.
_FITTED = {
    "X": ("m2", "load over the plane-strain modulus, X(δ)"),
    "load": ("N", "normal load"),
    **STIFFNESSES,
    **OF_IMPACTS,
    "magnitude_modulus": ("Pa", "|E|"),
    "storage_modulus": ("Pa", "storage modulus"),
    "loss_modulus": ("Pa", "loss modulus"),
}
_TIME = ("time", "s", "time since the start")
_FREQUENCY = ("angular_frequency", "rad/s", "angular frequency")
_SPEED = ("speed", "m/s", "speed of the impact")


@dataclass(frozen=True, eq=False)
class FittedRecord(Plotted):
    """One measured quantity of a record, its rows averaged over time, and its fit.

    Attributes
    ----------
    record : IndentationRecord, OscillationRecord, ReboundRecord or ModulusAnchor
        As given.
    quantity : str
        ``"X"``, if the load was prescribed over time: X(δ), m², which is (4/3) √R δ^{3/2} for a ball; ``"load"``, if
        the depth was, N; or the name of a column of the record.
    along : (n,) array
        Time since the start, s; angular frequency, rad/s; speed of the impact, m/s.
    response : (n,) array
        Measured values.
    fitted, lower, upper : (n,) array
        Those of the identified material, and their 95 % limits from the samples.
    error : (n,) array
        Relative standard errors: as given, or as found from the residuals.
    count : (n,) array
        Rows averaged.
    """

    record: Record
    quantity: str
    along: Array
    response: Array
    fitted: Array
    lower: Array
    upper: Array
    error: Array
    count: Array

    def _shown(self) -> Rows:
        return (
            ("record", type(self.record).__name__),
            ("quantity", self.words),
            ("temperature", self.record.temperature, "°C"),
            (self._axis[2], self.along, self._axis[1]),
            ("residuals", self.residuals),
            ("rows averaged", int(self.count.sum())),
        )

    @property
    def residuals(self) -> Array:
        """Measured minus fitted logarithms, over the standard errors, (n,)."""
        return np.asarray(np.log(self.response / self.fitted) / self.error)

    @property
    def words(self) -> str:
        """The quantity in words."""
        return _FITTED[self.quantity][1]

    def to_dataset(self) -> Dataset:
        """Return the measured values and their fit as a labelled data set along ``point``.

        ``time`` (s), ``angular_frequency`` (rad/s) or ``speed`` (m/s); ``response``, ``fitted_response``,
        ``fitted_response_lower`` and ``fitted_response_upper``, ``response_error`` and ``residual``; the attributes are
        ``quantity``, ``temperature`` (K) and ``source``.
        """
        unit, words = _FITTED[self.quantity]
        name, along_unit, along = self._axis
        return dataset(
            "point",
            {
                name: (self.along, along_unit, along),
                "response": (self.response, unit, words),
                "fitted_response": (self.fitted, unit, f"{words}, of the identified material"),
                "fitted_response_lower": (self.lower, unit, "lower end of its 95 % band"),
                "fitted_response_upper": (self.upper, unit, "upper end of its 95 % band"),
                "response_error": (self.error, "1", "relative standard error of the response"),
                "residual": (self.residuals, "1", "measured less fitted response over the standard error"),
            },
            attributes={
                "quantity": self.quantity,
                "temperature": float(self.record.temperature),
                "source": getattr(self.record, "source", ""),
            },
        )

    @property
    def _axis(self) -> tuple[str, str, str]:
        """Name, unit and long name of `along`."""
        if self.quantity in ("X", "load"):
            return _TIME
        return _FREQUENCY if self.quantity.endswith(("stiffness", "modulus")) else _SPEED


@dataclass(frozen=True, eq=False, kw_only=True)
class MaterialFromIndentation(Identified):
    """A material identified from indentation; the attributes of `Identified`, and these.

    `frequency_range` reaches from one over the longest time up to 0.1 over the shortest one of creep, and 0.01 over
    that of relaxation; faster processes are part of E''(ω), but no longer of the response.  The spectrum may end
    within half a decade of the first or the last of the measured times.

    Attributes
    ----------
    records : tuple of FittedRecord
        In the order of the records, each measured quantity; without those at temperatures that were left out.
    common_errors : mapping
        Errors that rows have in common and that were given a standard deviation: the found error and its standard
        error, of the ``radius`` and the ``load``, relative, and of the depth's zero of every record, ``zero 1`` …, m;
        the true value is the measured one plus the error.
    """

    METHOD: ClassVar[str] = FROM_INDENTATION
    UNMEASURED: ClassVar[str] = " in a homogeneous test"

    records: tuple[FittedRecord, ...]
    common_errors: Mapping[str, tuple[float, float]]

    def _shown(self) -> Rows:
        return (
            ("records", len({id(one.record) for one in self.records})),
            *super()._shown(),
        )

    def _attributes(self) -> dict[str, Any]:
        errors = {
            f"{name.replace(' ', '_')}_error{end}": one
            for name, both in self.common_errors.items()
            for end, one in zip(("", "_standard_error"), both, strict=True)
        }
        return super()._attributes() | errors

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        points = sum(len(one.along) for one in self.records)
        fit = (
            f"{points} points of {len({id(one.record) for one in self.records})} records are fitted to "
            f"{100.0 * self.rms:.2g} % (root mean square); χ² = {self.chi2:.3g} with {self.freedom:.3g} degrees of "
            "freedom."
        )
        return (fit, *super().sentences, *self._error_words())

    def _error_words(self) -> tuple[str, ...]:
        """Return the errors in common, in words."""
        said = []
        for name, both in self.common_errors.items():
            found, error = (one * (1e6 if name.startswith("zero") else 100.0) for one in both)
            unit = "µm" if name.startswith("zero") else "%"
            said.append(f"Found error of the {name}: {with_error(found, error)} {unit}.")
        return tuple(said)

    def _band_words(self) -> str:
        missing = [
            words
            for name, words in (("radius", "the radius"), ("load", "the load cell"), ("zero", "the depth's zero"))
            if not any(one.startswith(name) for one in self.common_errors)
        ]
        left = f" Errors of {' and '.join(missing)} are not included." if missing else ""
        return super()._band_words() + left
