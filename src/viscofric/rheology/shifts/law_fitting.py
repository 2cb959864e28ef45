"""Fitting of shift laws to measured shift factors by generalised least squares, with an honest misfit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple, overload

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.shifts.law_families import LAWS, TITLES, Family, family_of
from viscofric.units import celsius

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.rheology.shifts.laws import WLF, ParametricLaw

    Array = NDArray[np.float64]

#: Rounding of tabulated values; keeps exact tables from dividing by zero.
SMALLEST_ERROR = 1e-7  # decades
LARGEST_SCATTER = 10.0  # decades; explains anything
#: A constant that may as well be a hundred times itself is not one that the data know of.
LARGEST_RELATIVE_ERROR = 100.0
ITERATIONS = 50
CONVERGED = 1e-7  # relative fall of the squared misfit


@dataclass(frozen=True, eq=False)
class FactorTable:
    """Shift factors with differences taken, and made independent of each other.

    Only differences between neighbouring temperatures enter, so that the error of the reference's own value,
    common to all, does no harm.  They are turned so that their measured covariance becomes diagonal, and stays
    so when independent scatter of one size is added to every value.

    Parameters
    ----------
    temperatures, values : (n,) array
        Ascending, K, and log10 α.
    reference : float
        Where a law is to be 1, K.
    turn : (n − 1, n) array
        Turns values into independent differences.
    variance : (n − 1,) array
        Of the differences, as measured.
    log_volume : float
        ln det of what `turn` divides the covariance by, which a likelihood needs.
    """

    temperatures: Array
    values: Array
    reference: float
    turn: Array
    variance: Array
    log_volume: float

    @classmethod
    def of(cls, temperatures: Array, values: Array, covariance: Array, reference: float) -> FactorTable:
        """Prepare values (n,) at temperatures (n,), K, with their covariance (n, n)."""
        differences = np.diff(np.eye(len(temperatures)), axis=0)
        scatter = np.linalg.cholesky(differences @ differences.T)
        turn = np.linalg.solve(scatter, differences)
        variance, axes = np.linalg.eigh(turn @ covariance @ turn.T)
        floor = np.maximum(variance, 0.0) + SMALLEST_ERROR**2
        log_volume = 2.0 * float(np.sum(np.log(np.diag(scatter))))
        return cls(temperatures, values, reference, axes.T @ turn, floor, log_volume)

    def __len__(self) -> int:
        return len(self.variance)

    def whitening(self, scatter: float) -> Array:
        """Return the matrix that makes differences of variance one, with independent scatter² in every value."""
        return np.asarray(self.turn / np.sqrt(self.variance + scatter)[:, None])


class Solution(NamedTuple):
    """Constants, their covariance, and χ²."""

    parameters: Array
    covariance: Array
    chi2: float


class Likelihood(NamedTuple):
    """The greatest likelihood of a law: −2 ln L, and the extra scatter (decades) that makes it greatest."""

    deviance: float
    scatter: float


@overload
def fit(kind: Literal["wlf"], table: FactorTable) -> WLF: ...
@overload
def fit(kind: str, table: FactorTable, degree: int | None = None) -> ParametricLaw: ...
def fit(kind: str, table: FactorTable, degree: int | None = None) -> ParametricLaw:
    """Fit a law by generalised least squares; see `ShiftFactors.law`."""
    if kind not in LAWS:
        raise InputError(f"law = {kind!r}: must be {', '.join(repr(one) for one in LAWS[:-1])} or {LAWS[-1]!r}.")
    if kind == "vft":  # the same curve, whose constants and covariance follow exactly
        return fit("wlf", table).to_vft()
    family = family_of(kind, table.temperatures, table.reference, degree)
    if len(table) < family.size:
        raise InputError(f"{len(table) + 1} temperatures are too few to fit {kind!r}; give {family.size + 1} or more.")
    try:
        found = _with_misfit(family, table, family.start(table.values))
    except np.linalg.LinAlgError:
        raise _not_described(table, kind) from None
    errors = np.diag(found.covariance)
    if not np.all(np.isfinite(found.covariance)) or not np.all(errors > 0.0):
        raise _not_described(table, kind)
    if family.positive and np.any(errors > (LARGEST_RELATIVE_ERROR * found.parameters) ** 2):
        raise _not_described(table, kind)
    return family.law(found.parameters, found.covariance)


def likelihood(law: ParametricLaw, table: FactorTable) -> Likelihood:
    """Maximise the Gaussian likelihood of a table over a law's constants and over extra scatter.

    Parameters
    ----------
    law : ParametricLaw
        As fitted, where the search starts.
    table : FactorTable
        What it was fitted to.

    Returns
    -------
    Likelihood
        −2 ln L of the differences of neighbouring values, n − 1 in number, whose covariance is the measured one
        and that of independent scatter, of one variance not below zero, in every value.
    """
    from scipy.optimize import minimize_scalar

    degree = len(law.parameters) if law.kind == "polynomial" else None
    family = family_of(law.kind, table.temperatures, table.reference, degree)
    start = law.parameters

    def deviance(scatter: float) -> float:
        found = _least_squares(family, table, start, scatter)
        logarithms = float(np.sum(np.log(2.0 * np.pi * (table.variance + scatter))))
        return found.chi2 + logarithms + table.log_volume

    decades = np.linspace(np.log(SMALLEST_ERROR), np.log(LARGEST_SCATTER), 19)
    trials = [deviance(float(np.exp(2.0 * step))) for step in decades]
    best = int(np.argmin(trials))
    bounds = decades[max(best - 1, 0)], decades[min(best + 1, len(decades) - 1)]
    search = minimize_scalar(
        lambda step: deviance(float(np.exp(2.0 * step))), bounds=bounds, method="bounded", options={"xatol": 1e-2}
    )
    none = deviance(0.0)
    if none <= search.fun:
        return Likelihood(none, 0.0)
    return Likelihood(float(search.fun), float(np.exp(search.x)))


def chi_squared(law: ParametricLaw, table: FactorTable) -> float:
    """Return the χ² of a law of this kind when the measured uncertainties are all there is."""
    degree = len(law.parameters) if law.kind == "polynomial" else None
    family = family_of(law.kind, table.temperatures, table.reference, degree)
    return _least_squares(family, table, law.parameters, 0.0).chi2


def _not_described(table: FactorTable, kind: str) -> InputError:
    low, high = celsius(float(table.temperatures[0])), celsius(float(table.temperatures[-1]))
    return InputError(
        f"the shift factors from {low:z.1f} to {high:z.1f} °C do not fix the constants of the {TITLES[kind]} law; "
        "take the measured ones, another law, or the factors of a narrower range of temperatures."
    )


def _with_misfit(family: Family, table: FactorTable, start: Array) -> Solution:
    """Fit, adding just as much independent scatter per temperature as makes the misfit plausible.

    The scatter σ² solves χ²(σ²) = degrees of freedom (R. C. Paule, J. Mandel, J. Res. Natl. Bur. Stand. 87 (1982)
    377); it is zero where the uncertainties explain the misfit.
    """
    freedom = len(table) - family.size
    found = _least_squares(family, table, start, 0.0)
    if freedom == 0 or found.chi2 <= freedom:
        return found
    low, high = 2 * np.log(SMALLEST_ERROR), 2 * np.log(LARGEST_SCATTER)
    for _ in range(40):
        middle = 0.5 * (low + high)
        found = _least_squares(family, table, found.parameters, float(np.exp(middle)))
        low, high = (middle, high) if found.chi2 > freedom else (low, middle)
        if high - low < 1e-2:
            break
    return found


def _least_squares(family: Family, table: FactorTable, start: Array, scatter: float) -> Solution:
    """Minimise the whitened misfit over the constants."""
    whiten = table.whitening(scatter)
    if not family.positive:
        return _linear(whiten @ family.gradient(start), whiten @ table.values)
    return _positive(family, whiten, whiten @ table.values, start)


def _linear(matrix: Array, target: Array) -> Solution:
    """Minimise |matrix p − target|², columns brought to one size first."""
    size = np.linalg.norm(matrix, axis=0)
    left, upper = np.linalg.qr(matrix / size)
    inverse = np.linalg.inv(upper) / size[:, None]
    parameters = inverse @ (left.T @ target)
    misfit = target - matrix @ parameters
    return Solution(parameters, inverse @ inverse.T, float(misfit @ misfit))


def _positive(family: Family, whiten: Array, target: Array, start: Array) -> Solution:
    """Minimise by damped Gauss–Newton steps in the logarithms of the constants.

    That keeps them positive and free of units.
    """

    def misfit(logarithm: Array) -> Array:
        try:
            return np.asarray(target - whiten @ family.values(np.exp(logarithm)))
        except InputError:  # beyond the law's pole: no step leads there
            return np.full(len(target), np.inf)

    point = np.log(start)
    now = misfit(point)
    damping = 1e-3
    for _ in range(ITERATIONS):
        parameters = np.exp(point)
        jacobian = whiten @ (family.gradient(parameters) * parameters)
        normal = jacobian.T @ jacobian
        while damping < 1e12:
            damped = normal + damping * np.diag(np.diag(normal) + 1e-300)
            step = np.linalg.lstsq(damped, jacobian.T @ now, rcond=None)[0]
            trial = misfit(point + np.clip(step, -1.0, 1.0))
            if trial @ trial <= now @ now:
                break
            damping *= 10.0
        else:
            break
        fall = now @ now - trial @ trial
        point, now, damping = point + np.clip(step, -1.0, 1.0), trial, damping * 0.1
        if np.max(np.abs(step)) < 1e-8 or fall < CONVERGED * (now @ now):
            break
    parameters = np.exp(point)
    return Solution(parameters, _inverse(normal) * np.outer(parameters, parameters), float(now @ now))


def _inverse(normal: Array) -> Array:
    """Invert, or return infinities where the data say nothing of some combination of constants."""
    try:
        return np.asarray(np.linalg.inv(normal))
    except np.linalg.LinAlgError:
        return np.full(normal.shape, np.inf)
