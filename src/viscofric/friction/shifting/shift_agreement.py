"""Agreement of shift factors found in two ways, such as from friction and from a DMA."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.notes import Note
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import ParametricLaw, ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.superposition.result import Superposition
from viscofric.showing import Plotted, Rows, with_error
from viscofric.units import shown_celsius

#: A temperature closer than this to the reference is the reference, K.
AT_REFERENCE = 1e-6
#: Combinations whose variance is below this part of the largest one result from the interpolation of the reference.
INTERPOLATED = 1e-9
#: Rounding of tabulated values, decades; keeps exact ones from dividing by zero.
ROUNDING = 1e-6
CONVERGED = 1e-10
ITERATIONS = 100


#: Shift factors agree if differences as large as theirs have this probability or more.
LIKELY = 0.05


@dataclass(frozen=True, eq=False)
class ShiftAgreement(Plotted):
    """Agreement of two sets of shift factors about the same reference.

    Attributes
    ----------
    reference : float
        Where both are 1, K.
    temperature : (n,) array
        At which they are compared, K; without the reference.
    difference : (n,) array
        log10 α found minus log10 α of the other.
    error : (n,) array
        Its standard error, from both.
    chi2 : float
        Squared differences in units of their covariance, that of both.
    freedom : int
        Number of independent differences.
    p_value : float
        Probability of a χ² as large, if both are the same and their errors are right.
    slope, slope_error : float
        k and its standard error in log10 α_found = k log10 α_other, including errors of both; 1 where they are equal.
    rms : float
        Root mean square difference, decades.
    found : ShiftFactors
        Those found, at all of their temperatures.
    other : ShiftFactors or ShiftLaw
        The other ones, about the same reference.
    """

    reference: float
    temperature: Array
    difference: Array
    error: Array
    chi2: float
    freedom: int
    p_value: float
    slope: float
    slope_error: float
    rms: float
    found: ShiftFactors = field(repr=False)
    other: ShiftLaw = field(repr=False)

    def _shown(self) -> Rows:
        return (
            ("rms difference", self.rms, "decades"),
            ("slope", self.slope, "", self.slope_error),
            ("χ²", self.chi2),
            ("degrees of freedom", self.freedom),
            ("p value", self.p_value),
            ("temperature", self.temperature, "°C"),
            ("reference", self.reference, "°C"),
        )

    def to_dataset(self) -> Dataset:
        """Return both sets of shift factors as a labelled data set along ``temperature``.

        The other ones are NaN where they are not known, their error zero where they are exact.  The agreement is in the
        attributes.
        """
        factors = self.found
        known, known_error = self.other.values_at(factors.temperatures)
        return dataset(
            "temperature",
            {
                "log10_shift_factor": (factors.log10_values, "1", "decadic logarithm of the shift factor"),
                "standard_error": (factors.standard_errors, "1", "standard error of log10 of the shift factor"),
                "known_log10_shift_factor": (known, "1", "decadic logarithm of the modulus's shift factor"),
                "known_standard_error": (known_error, "1", "standard error of log10 of the modulus's shift factor"),
            },
            coordinates={"temperature": (factors.temperatures, "K", "temperature")},
            attributes={
                "reference_temperature": self.reference,
                "sentence": self.sentence,
                "slope": self.slope,
                "slope_error": self.slope_error,
                "chi2": self.chi2,
                "freedom": self.freedom,
                "p_value": self.p_value,
                "rms": self.rms,
            },
        )

    @property
    def sentence(self) -> str:
        """The agreement in one sentence."""
        where = f"{shown_celsius(float(self.temperature.min()))} to {shown_celsius(float(self.temperature.max()))} °C"
        if self.temperature.size == 1:
            where = f"{shown_celsius(float(self.temperature[0]))} °C"
        verdict = "agree within" if self.p_value >= LIKELY else "differ by more than"
        return (
            f"The shift factors at {where}, relative to {shown_celsius(self.reference)} °C, differ by {self.rms:.2g} "
            f"decades (root mean square) and {verdict} their errors "
            f"(χ² = {self.chi2:.3g} for {self.freedom}, p = {self.p_value:.2g}): log10 α found is "
            f"{with_error(self.slope, self.slope_error)} times log10 α of the comparison."
        )

    def __str__(self) -> str:
        return self.sentence


def compare_shift_factors(
    found: FrictionMasterCurve | ShiftFactors, other: ShiftLaw | Superposition | Material | FrictionMasterCurve
) -> ShiftAgreement:
    """Compare shift factors, such as those found from friction with those of a DMA.

    Parameters
    ----------
    found : FrictionMasterCurve or ShiftFactors
        With its covariance; its reference and temperatures are used.
    other : ShiftFactors, a law (WLF, …), Superposition, Material or FrictionMasterCurve
        Independent of `found`, such as the superposition of a DMA or a law fitted to it.  It is brought to the
        reference of `found` and evaluated at its temperatures; a law without covariance is taken as exact.

    Returns
    -------
    ShiftAgreement

    Raises
    ------
    InputError
        If they have no temperature in common besides the reference, or `found` is not a table of shift factors.

    Notes
    -----
    k is the straight line through the reference that lies nearest to both in units of their errors (total least
    squares with full covariances), so that errors of the other do not pull it towards zero.  Its standard error grows
    with √(χ²/(n − 1)) where the factors scatter about that line by more than their errors say.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.WLF(C1=9.0, C2=100.0, reference=303.15)
    >>> kelvin = [303.15, 313.15, 323.15]
    >>> found = vf.ShiftFactors(kelvin, law.log10(kelvin), 303.15, [[0, 0, 0], [0, 1e-4, 1e-4], [0, 1e-4, 4e-4]])
    >>> agreement = vf.friction.compare_shift_factors(found, law)
    >>> round(agreement.p_value, 3), round(agreement.slope, 3), round(agreement.slope_error, 3)
    (1.0, 1.0, 0.011)
    """
    from scipy.special import gammaincc

    table: Any = getattr(found, "shift_factors", found)
    insist_on(table, "found", ShiftFactors, right="ShiftFactors or a FrictionMasterCurve")
    reference = table.reference
    keep = np.abs(table.temperatures - reference) > AT_REFERENCE
    law: Any = getattr(other, "shift", None)
    if law is None:
        law = getattr(other, "shift_factors", other)
    insist_on(law, "other", ShiftLaw, right="ShiftFactors, a law, or a result that has shift factors")
    law = law.at_reference(reference)
    keep &= law.valid_at(table.temperatures)
    if not np.any(keep):
        raise InputError(
            f"the shift factors to compare have no temperature in common besides the reference, "
            f"{shown_celsius(reference)} °C.",
            code="nothing-to-compare",
        )
    kelvin = table.temperatures[keep]
    y, y_spread = table.log10_values[keep], table.covariance[np.ix_(keep, keep)]
    x, x_spread = np.asarray(law.log10(kelvin)), law.covariance_at(kelvin)
    difference, spread = y - x, x_spread + y_spread
    mix = _independent(spread)
    mixed, freedom = mix @ difference, len(mix)
    chi2 = float(mixed @ np.linalg.solve(mix @ spread @ mix.T + ROUNDING**2 * np.eye(freedom), mixed))
    slope, slope_error = _slope(mix @ x, mix @ y, mix @ x_spread @ mix.T, mix @ y_spread @ mix.T)
    return ShiftAgreement(
        reference=reference,
        temperature=kelvin,
        difference=difference,
        error=np.sqrt(np.maximum(np.diag(spread), 0.0)),
        chi2=chi2,
        freedom=freedom,
        p_value=float(gammaincc(0.5 * freedom, 0.5 * chi2)),
        slope=slope,
        slope_error=slope_error,
        rms=float(np.sqrt(np.mean(difference**2))),
        found=table,
        other=law,
    )


def _independent(spread: Array) -> Array:
    """Return the independent combinations (m, n) of values."""
    # With a reference between temperatures the values around it are related by interpolation, and there is one less.
    variance, axes = np.linalg.eigh(spread)
    keep = variance > INTERPOLATED * variance[-1]
    return np.asarray(axes[:, keep].T if keep.any() else np.eye(len(spread)))


def _slope(x: Array, y: Array, x_spread: Array, y_spread: Array) -> tuple[float, float]:
    """Return k of y = k x, and its standard error, by generalised total least squares."""
    # χ²(k) = (y − kx)ᵀ (V_y + k² V_x)⁻¹ (y − kx) with the true x on the line; found by repeated generalised least
    # squares on the x that lies nearest.
    slope = float(x @ y / (x @ x)) if np.any(x) else math.nan
    if not math.isfinite(slope):
        raise InputError("the other shift factors are all 1: there is no slope against them.", code="no-slope")
    floor = ROUNDING**2 * np.eye(x.size)
    for _ in range(ITERATIONS):
        inverse = np.linalg.inv(y_spread + slope**2 * x_spread + floor)
        residual = inverse @ (y - slope * x)
        nearest = x + slope * x_spread @ residual  # the true x, given the line
        change = float(nearest @ residual) / float(nearest @ inverse @ nearest)
        if abs(change) < CONVERGED:
            break
        slope += change
    chi2 = float((y - slope * x) @ residual)
    excess = max(1.0, chi2 / (x.size - 1)) if x.size > 1 else 1.0
    return slope, float(np.sqrt(excess / (nearest @ inverse @ nearest)))


class Conclusions(NamedTuple):
    """What follows from shift factors that were found from friction, and why something does not."""

    law: ParametricLaw | None = None
    why: str = ""  # this law
    agreement: ShiftAgreement | None = None
    notes: tuple[Note, ...] = ()


def concluded(master: FrictionMasterCurve, kind: str, known: ShiftLaw | None) -> Conclusions:
    """Fit a law ("best" chooses one, "none" fits none), and compare with known shift factors."""
    if not master.found:
        return Conclusions()
    law: ParametricLaw | None = None
    why, agreement, notes = "", None, []
    if kind == "best":
        try:
            compared = master.shift_factors.compare_laws()
            law, why = compared.best, compared.explanation
        except InputError as error:
            notes.append(Note("no-law", f"No law is fitted: {error}"))
    elif kind != "none":
        law = master.shift_factors.law(kind)
    if known is not None:
        try:
            agreement = compare_shift_factors(master, known)
        except InputError as error:
            notes.append(error.note)
    return Conclusions(law, why, agreement, tuple(notes))
