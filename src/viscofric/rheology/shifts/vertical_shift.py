"""Vertical shifts b(T): the effect of temperature on the modulus itself, besides the time scale."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset, plain
from viscofric.errors import InputError, brief, wrong_argument
from viscofric.notes import Remedy
from viscofric.rheology.shifts.shift_law import Shift, ShiftTable, as_record
from viscofric.showing import Rows
from viscofric.units import Quantities, Quantity, positive, to_si, to_si_array

#: Volume expansivity of a pure-gum vulcanizate of natural rubber at 25 °C, 1/K.
NATURAL_RUBBER_EXPANSION = 6.6e-4


class VerticalShift(Shift):
    """Vertical shift b(T), 1 at the reference, such that E(ω, T) = b(T) E(α(T) ω, reference).

    Subclasses define log10 b.
    """

    def _standard_error(self, kelvin: Array) -> Array | None:
        """Return the standard error of log10 b at temperatures that `_refuse` accepts; None where it is not known."""
        return None

    def to_dataset(self, temperatures: Any) -> Dataset:
        """Return log10 b over temperature as a labelled data set.

        Parameters
        ----------
        temperatures : (n,) array or list of float, str or quantity
            Plain numbers are in K.

        Returns
        -------
        xarray.Dataset
            ``log10_vertical_shift`` and, where it is known, its ``vertical_standard_error``, along ``temperature`` (K).
            Attributes: ``reference_temperature`` (K) and ``vertical_shift``, all of the shift as JSON.

        Raises
        ------
        InputError
            Where `log10` raises it.
        """
        kelvin = to_si_array(temperatures, "K", "temperatures")
        values = self.log10(kelvin)
        errors = self._standard_error(kelvin)
        return dataset(
            "temperature",
            {
                "log10_vertical_shift": (values, "1", "decadic logarithm of the vertical shift b"),
                "vertical_standard_error": None
                if errors is None
                else (errors, "1", "standard error of log10 of the vertical shift"),
            },
            coordinates={"temperature": (kelvin, "K", "temperature")},
            attributes={
                "reference_temperature": self.reference,
                "vertical_shift": json.dumps(plain(as_record(self), None)),
            },
        )


@dataclass(frozen=True)
class DensityShift(VerticalShift):
    """The vertical shift of rubber elasticity, b = ρT/(ρ0 T0), with ρ/ρ0 = exp(−β(T − T0)).

    The modulus of a rubber network is proportional to its density and to absolute temperature (J. D. Ferry,
    Viscoelastic Properties of Polymers, 3rd ed., Wiley 1980, ch. 11).  In the glass it is not; there this
    shift is a convention.

    Parameters
    ----------
    reference : float or quantity
        T0, where b = 1; K, or text such as ``"30 degC"``.
    expansion : float
        Volume expansivity β, not below zero, 1/K.  The default is that of unfilled natural rubber; 0 leaves
        b = T/T0.

    References
    ----------
    L. A. Wood, Rubber Chem. Technol. 49 (1976) 189 (the expansivity, 660e-6 1/K).

    Examples
    --------
    >>> import viscofric as vf
    >>> round(float(vf.rheology.DensityShift(303.15)(333.15)), 4)  # ρT/ρ₀T₀
    1.0774
    """

    reference: float
    expansion: float = NATURAL_RUBBER_EXPANSION

    def __post_init__(self) -> None:
        object.__setattr__(self, "reference", positive(self.reference, "K", "reference"))
        expansion = to_si(self.expansion, "1/K", "expansion")
        if expansion < 0.0:
            raise wrong_argument(
                "expansion", self.expansion, "must not be below zero (1/K); 0 leaves b = T/T0.", "not-positive"
            )
        object.__setattr__(self, "expansion", expansion)

    def _shown(self) -> Rows:
        return (
            ("reference", self.reference, "°C"),
            ("expansion", f"{self.expansion:.3g} 1/K"),
        )

    def _log10(self, kelvin: Array) -> Array:
        warmer = kelvin - self.reference
        return np.asarray(np.log10(kelvin / self.reference) - self.expansion * warmer / math.log(10.0))


@dataclass(frozen=True, eq=False)
class VerticalShiftFactors(ShiftTable, VerticalShift):
    """A table of vertical shifts, read between its temperatures by linear interpolation of log10 b in T.

    Up to half a kelvin beyond its ends it keeps the value there.

    Parameters
    ----------
    temperatures : (n,) array or quantities
        Ascending, at least two, K.
    log10_values : (n,) array
        log10 b.  They are moved as a whole so that the interpolated value at the reference is zero.
    reference : float or quantity
        Temperature where b = 1, inside the measured range; K.
    covariance : (n, n) array, optional
        Of the values, given that the one at the reference is exactly zero; zero if not given.

    Raises
    ------
    InputError
        If the columns do not fit each other or the reference lies outside them.

    Examples
    --------
    >>> import viscofric as vf
    >>> b = vf.rheology.VerticalShiftFactors(["30 degC", "60 degC"], [0.0, 0.04], "30 degC")
    >>> round(float(b("60 degC")), 4)
    1.0965
    """

    temperatures: Array
    log10_values: Array
    reference: float
    covariance: Array

    def __init__(
        self, temperatures: Quantities, log10_values: Any, reference: Quantity, covariance: Any = None
    ) -> None:
        self._set_table("vertical shifts", temperatures, log10_values, reference, covariance)

    def _shown(self) -> Rows:
        return (
            ("temperatures", self.temperatures, "°C"),
            ("log10 b", self.log10_values),
            ("reference", self.reference, "°C"),
            ("standard error", self.standard_errors),
        )

    _beyond = (
        "{} to {} °C, where the vertical shift was measured",
        Remedy("; a density shift, ρT/(ρ0 T0), is valid beyond"),
    )

    def to_dataset(self, temperatures: Any = None) -> Dataset:
        """Return log10 b as a labelled data set, at the temperatures of the table unless others are given."""
        return super().to_dataset(self.temperatures if temperatures is None else temperatures)

    def _log10(self, kelvin: Array) -> Array:
        return np.asarray(np.interp(kelvin, self.temperatures, self.log10_values))

    def _weights(self, kelvin: Array) -> Array:
        return np.stack([np.interp(kelvin, self.temperatures, unit) for unit in np.eye(self.temperatures.size)], -1)


def with_vertical_shift(factors: Dataset, vertical: VerticalShift | None, temperatures: Array) -> Dataset:
    """Return a data set of shift factors with b(T) at the same temperatures (K), where there is a vertical shift."""
    if vertical is None:
        return factors
    found = vertical.to_dataset(temperatures)
    return factors.assign(found.data_vars).assign_attrs(vertical_shift=found.attrs["vertical_shift"])


def known_vertical(vertical: object, kelvin: float, *, free: bool = False) -> VerticalShift | None:
    """Return b(T) about a temperature, K, as users choose it; None where there is none, or, if `free`, it is fitted."""
    if isinstance(vertical, VerticalShift):
        return vertical.at_reference(kelvin)
    if vertical == "density":
        return DensityShift(kelvin)
    if vertical is None or (free and vertical == "free"):
        return None
    choices = "'free', 'density'" if free else "'density'"
    raise InputError(
        f"vertical shift {brief(vertical)}: must be {choices}, a VerticalShift or None.", code="wrong-choice"
    )
