"""Shift factors measured at the temperatures of the sweeps, with their uncertainty and fitted laws."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, overload

import numpy as np

from viscofric.arguments import sentences, whole_number
from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.files import file_path, write_atomically
from viscofric.notes import Remedy
from viscofric.rheology.shifts import law_fitting
from viscofric.rheology.shifts.law_comparison import LawComparison, compare_laws, polynomial
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, ParametricLaw, WLFArrhenius
from viscofric.rheology.shifts.shift_law import ShiftLaw, ShiftTable
from viscofric.showing import Items, Rows, rows_of
from viscofric.units import (
    CELSIUS_ZERO,
    Quantities,
    Quantity,
    positive,
)


@dataclass(frozen=True, eq=False)
class ShiftFactors(ShiftTable, ShiftLaw, Items[tuple[float, float]]):
    """A table of shift factors, read between its temperatures by monotone interpolation in 1/T.

    Up to half a kelvin beyond its ends, the difference of a nominal temperature from a measured one, it is continued
    straight in 1/T.

    Parameters
    ----------
    temperatures : (n,) array or quantities
        Ascending, at least two, K.
    log10_values : (n,) array
        log10 α.  They are moved as a whole so that the interpolated value at the reference is zero.
    reference : float or quantity
        Temperature where α = 1, inside the measured range (or at most half a kelvin beyond); K.
    covariance : (n, n) array, optional
        Of the values, given that the one at the reference is exactly zero; zero if not given.
    notes : tuple of str
        What was corrected by hand, and that data are synthetic: one sentence each.

    Examples
    --------
    >>> import viscofric as vf
    >>> factors = vf.ShiftFactors(["30 degC", "60 degC", "90 degC"], [0.0, -1.5, -2.5], "30 degC")
    >>> round(float(factors("60 degC")), 5), factors.at_reference("60 degC").log10_values.round(3)
    (0.03162, array([ 1.5,  0. , -1. ]))
    """

    temperatures: Array
    log10_values: Array
    reference: float
    covariance: Array
    notes: tuple[str, ...] = ()

    def __init__(
        self,
        temperatures: Quantities,
        log10_values: Any,
        reference: Quantity,
        covariance: Any = None,
        notes: Iterable[str] = (),
    ) -> None:
        self._set_table("shift factors", temperatures, log10_values, reference, covariance)
        object.__setattr__(self, "notes", sentences(notes, "notes of shift factors"))

    def _items(self) -> Sequence[tuple[float, float]]:
        return rows_of(self.temperatures, self.log10_values)

    def _shown(self) -> Rows:
        return (
            ("temperatures", self.temperatures, "°C"),
            ("log10 α", self.log10_values),
            ("reference", self.reference, "°C"),
            ("standard error", self.standard_errors),
            ("notes", self.notes),
        )

    @property
    def has_standard_error(self) -> bool:
        """True: a table without a covariance is treated as exact."""
        return True

    def to_dataset(self, temperatures: Any = None) -> Dataset:
        """Return the factors as a labelled data set.

        Parameters
        ----------
        temperatures : (n,) array or list of float, str or quantity, optional
            Plain numbers are in K; None: those of the table.

        Returns
        -------
        xarray.Dataset
            ``log10_shift_factor`` and its ``standard_error`` along ``temperature`` (K), NaN outside the table.
            Attribute ``reference_temperature`` (K).
        """
        if temperatures is None:
            return self._dataset(self.temperatures, self.log10_values, self.standard_errors)
        return super().to_dataset(temperatures)

    _beyond = (
        "the shift factors, {} to {} °C",
        Remedy(
            "; fit a law (such as WLF or Arrhenius) to extrapolate",
            "; leave it out, or, with sweeps, fit a law by --shift wlf, which extrapolates",
            "; leave it out, or, with sweeps, give a law, shift = 'wlf' under [material], to extrapolate",
            page="; leave it out, or, with sweeps, use a law under “Shift” to extrapolate",
            field="conditions.temperature",
        ),
    )

    def _log10(self, kelvin: Array) -> Array:
        from scipy.interpolate import PchipInterpolator

        # An Arrhenius law is straight in 1/T, so little curvature is left to interpolate.
        hottest, coldest = 1.0 / self.temperatures[-1], 1.0 / self.temperatures[0]
        curve = PchipInterpolator(1.0 / self.temperatures[::-1], self.log10_values[::-1])
        inverse = np.clip(1.0 / kelvin, hottest, coldest)
        return np.asarray(curve(inverse) + curve(inverse, 1) * (1.0 / kelvin - inverse))

    def _weights(self, kelvin: Array) -> Array:
        return weights_between(self.temperatures, kelvin)

    def _covariance(self, kelvin: Array) -> Array:
        """Return the covariance by the same interpolation, relative to a reference between temperatures."""
        weights = self._weights(kelvin)
        return np.asarray(weights @ self._referenced(self.covariance, self.reference) @ weights.T)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the factors with their covariance to a CSV file that `read_shift_factors` reads back unchanged.

        Parameters
        ----------
        path : str or path
            An existing file is overwritten.

        Raises
        ------
        DataFileError
            If the file cannot be written.
        """
        text = io.StringIO()
        text.write(f"# viscofric shift factors\n# reference (degC): {_in_celsius(self.reference)}\n")
        text.writelines(f"# note: {' '.join(note.split())}\n" for note in self.notes)
        rows = csv.writer(text, lineterminator="\n")
        numbered = [f"cov {place}" for place in range(1, len(self) + 1)]
        rows.writerow(["temperature (degC)", "log10 shift factor", "standard error", *numbered])
        columns = (self.temperatures, self.log10_values, self.standard_errors, self.covariance)
        for kelvin, value, error, covariance in zip(*columns, strict=True):
            rows.writerow([_in_celsius(kelvin), *(repr(float(number)) for number in (value, error, *covariance))])
        write_atomically(file_path(path), text.getvalue().encode(), make_folder=False)

    @overload
    def law(self, kind: Literal["wlf"], *, above: Quantity | None = None) -> WLF: ...
    @overload
    def law(self, kind: Literal["arrhenius"], *, above: Quantity | None = None) -> Arrhenius: ...
    @overload
    def law(self, kind: Literal["vft"], *, above: Quantity | None = None) -> VFT: ...
    @overload
    def law(self, kind: Literal["wlf+arrhenius"], *, above: Quantity | None = None) -> WLFArrhenius: ...
    @overload
    def law(
        self, kind: Literal["polynomial"], *, above: Quantity | None = None, degree: int | None = None
    ) -> InversePolynomial: ...
    @overload
    def law(self, kind: str, *, above: Quantity | None = None, degree: int | None = None) -> ParametricLaw: ...
    def law(self, kind: str, *, above: Quantity | None = None, degree: int | None = None) -> ParametricLaw:
        """Fit a law to the table, with α = 1 at the same reference.

        Every value counts by its uncertainty.  Where the table scatters about the law by more than that, the
        excess is added to it as independent scatter of one size.  The law's standard errors include what the values
        have beyond the law: scatter, deviations that bend along temperature, or stated errors that are too small,
        each with a size that agrees with the residuals (restricted likelihood, averaged over shape and size).  So
        they hold the constants that other temperatures of the same table give.

        Parameters
        ----------
        kind : {"wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial"}
            VFT is the WLF curve in other constants; "wlf+arrhenius" is WLF above a glass transition that is found
            too, Arrhenius below it; the polynomial is one in 1/T.
        above : float or quantity, optional
            Leave out measured temperatures below this one, such as those below the glass transition.
        degree : int, optional
            Of the polynomial, 1 to 4; without it, that from 2 to 4 of the lowest AIC.

        Returns
        -------
        WLF, Arrhenius, VFT, WLFArrhenius or InversePolynomial
            With `covariance`, standard errors and `fitted_range`, which bounds its extrapolation.

        Raises
        ------
        InputError
            If the kind is unknown, the temperatures are too few, or the law does not describe them.
        """
        if degree is not None:
            whole_number(degree, "degree", 1)
        table = self._table(above)
        if kind == "polynomial" and degree is None:
            return polynomial(table)
        return law_fitting.fitted(kind, table, degree).law

    def compare_laws(self, *, above: Quantity | None = None) -> LawComparison[ParametricLaw]:
        """Fit every law and choose the one that the table supports best; see `LawComparison`.

        Parameters
        ----------
        above : float or quantity, optional
            Leave out measured temperatures below this one.

        Raises
        ------
        InputError
            If no law describes the table.
        """
        return compare_laws(self._table(above))

    def _table(self, above: Quantity | None) -> law_fitting.FactorTable:
        keep = np.full(self.temperatures.shape, True)
        if above is not None:
            keep = self.temperatures >= positive(above, "K", "above")
        if np.count_nonzero(keep) < 2:
            raise InputError(
                f"{np.count_nonzero(keep)} temperatures are too few to fit a law; give 2 or more.",
                code="too-few-temperatures",
            )
        return law_fitting.FactorTable.of(
            self.temperatures[keep], self.log10_values[keep], self.covariance[np.ix_(keep, keep)], self.reference
        )


def _in_celsius(kelvin: float) -> str:
    # The difference and its inverse are exact between half and double of 273.15 (Sterbenz).
    return repr(float(kelvin) - CELSIUS_ZERO)


def weights_between(temperatures: Array, kelvin: Array) -> Array:
    """Return the weights (m, n) of values at (n,) temperatures in values between them, linear in 1/T."""
    inverse = 1.0 / temperatures[::-1]
    return np.stack([np.interp(1.0 / kelvin, inverse, unit) for unit in np.eye(len(inverse))[::-1]], axis=-1)
