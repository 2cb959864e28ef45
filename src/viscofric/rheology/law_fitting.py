"""Fitting of shift laws to measured shift factors by generalised least squares, with an honest misfit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.shift_laws import GAS_CONSTANT, LN10, WLF, Arrhenius, ShiftLaw, WLFArrhenius
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Model = Callable[[Array], Array]

#: Beyond this the WLF law is straight over any measured range and C1 and C2 are not told apart.
LARGEST_C2 = 1e4  # K
#: Rounding of tabulated values; keeps exact tables from dividing by zero.
SMALLEST_ERROR = 1e-7  # decades

_PARAMETERS = {"wlf": 2, "arrhenius": 1, "wlf+arrhenius": 3}


def fit(kind: str, temperatures: Array, values: Array, covariance: Array, reference: float) -> ShiftLaw:
    """Fit a law by generalised least squares; see `ShiftFactors.law`.

    Only differences between neighbouring temperatures enter, so that the error of the reference's own value,
    common to all, does no harm.

    Parameters
    ----------
    kind : {"wlf", "arrhenius", "wlf+arrhenius"}
        Which law.
    temperatures, values : (n,) array
        Ascending, K, and log10 α.
    covariance : (n, n) array
        Of the values.
    reference : float
        Where the law is to be 1, K.
    """
    if kind not in _PARAMETERS:
        raise InputError(f"law = {kind!r}: must be 'wlf', 'arrhenius' or 'wlf+arrhenius'.")
    if len(temperatures) < _PARAMETERS[kind] + 1:
        raise InputError(
            f"{len(temperatures)} temperatures are too few to fit {kind!r}; give {_PARAMETERS[kind] + 1} or more."
        )
    differences = np.diff(np.eye(len(temperatures)), axis=0)
    errors = differences @ covariance @ differences.T
    scatter = differences @ differences.T
    target = differences @ values

    def model(parameters: Array) -> Array:
        return np.asarray(differences @ _law(kind, parameters, reference).log10(temperatures))

    start = _start(kind, temperatures, values, reference)
    try:
        parameters, spread = _with_misfit(model, start, target, errors, scatter)
    except np.linalg.LinAlgError:
        parameters = spread = np.full((1, 1), np.inf)
    # A parameter that may as well be a hundred times itself is not one that the data know of.
    if (
        not np.all(np.isfinite(spread))
        or not np.all((variance := np.diag(spread)) > 0)
        or np.any(variance > 1e4 * parameters**2)
    ):
        raise _not_described(temperatures, kind)
    return _law(kind, parameters, reference, spread)


def _law(kind: str, parameters: Array, reference: float, covariance: Array | None = None) -> ShiftLaw:
    numbers = [float(number) for number in parameters]
    if kind == "wlf":
        return WLF(numbers[0], numbers[1], reference, covariance)
    if kind == "arrhenius":
        return Arrhenius(numbers[0], reference, covariance)
    return WLFArrhenius(numbers[0], numbers[1], numbers[2], reference, covariance)


def _start(kind: str, temperatures: Array, values: Array, reference: float) -> Array:
    """Scan the parameters that enter nonlinearly; the factor in front follows by plain least squares."""
    if kind == "arrhenius":
        shape = Arrhenius(GAS_CONSTANT * LN10, reference).log10(temperatures)
        factor, _ = _scaled(shape, values)
        if factor <= 0.0:
            raise InputError("the shift factors rise with temperature: no Arrhenius law describes them.")
        return np.array([factor * GAS_CONSTANT * LN10])
    if kind == "wlf":
        candidates = [
            (C2, WLF(1.0, C2, reference).log10(temperatures))
            for C2 in reference - temperatures[0] + np.geomspace(1.0, LARGEST_C2, 80)
            if C2 > 0.0
        ]
        trials = [(*_scaled(shape, values), C2) for C2, shape in candidates]
        factor, _, C2 = min(trials, key=lambda trial: trial[1])
        _insist_on_curvature(factor, C2, temperatures)
        return np.array([factor, C2])
    joined = [
        (*_scaled(WLFArrhenius(1.0, C2, Tg, reference).log10(temperatures), values), C2, Tg)
        for Tg in 0.5 * (temperatures[1:] + temperatures[:-1])
        for C2 in np.geomspace(3.0, 1e3, 25)
    ]
    factor, _, C2, Tg = min(joined, key=lambda trial: trial[1])
    _insist_on_curvature(factor, C2, temperatures)
    return np.array([factor, C2, Tg])


def _scaled(shape: Array, values: Array) -> tuple[float, float]:
    """Return the factor of `shape` that meets `values` best up to a constant, and the squared misfit."""
    shape, values = shape - shape.mean(), values - values.mean()
    factor = float(shape @ values / (shape @ shape))
    return factor, float(np.sum((values - factor * shape) ** 2))


def _insist_on_curvature(factor: float, C2: float, temperatures: Array) -> None:
    if factor <= 0.0 or C2 > 0.5 * LARGEST_C2:
        raise _not_described(temperatures, "wlf")


def _not_described(temperatures: Array, kind: str) -> InputError:
    low, high = celsius(float(temperatures[0])), celsius(float(temperatures[-1]))
    return InputError(
        f"the shift factors from {low:z.1f} to {high:z.1f} °C do not fix the constants of the {kind!r} law; "
        "take the measured ones ([material] shift = \"measured\" in a run file), or in Python try law('arrhenius'), "
        "law('wlf'), or a narrower range with above=."
    )


def _with_misfit(model: Model, start: Array, target: Array, errors: Array, scatter: Array) -> tuple[Array, Array]:
    """Fit, adding just as much independent scatter per temperature as makes the misfit plausible.

    The scatter σ² solves χ²(σ²) = degrees of freedom (the estimator of Mandel and Paule); it is zero where
    the uncertainties explain the misfit.
    """
    freedom = len(target) - len(start)
    parameters, spread, chi2 = _least_squares(model, start, target, errors + SMALLEST_ERROR**2 * scatter)
    if freedom == 0 or chi2 <= freedom:
        return parameters, spread
    low, high = 2 * np.log(SMALLEST_ERROR), 2 * np.log(10.0)  # 10 decades of scatter explain anything
    for _ in range(40):
        middle = 0.5 * (low + high)
        parameters, spread, chi2 = _least_squares(model, parameters, target, errors + np.exp(middle) * scatter)
        low, high = (middle, high) if chi2 > freedom else (low, middle)
        if high - low < 1e-2:
            break
    return parameters, spread


def _least_squares(model: Model, start: Array, target: Array, variance: Array) -> tuple[Array, Array, float]:
    """Minimise (target − model)ᵀ variance⁻¹ (target − model) over positive parameters by Gauss–Newton.

    The steps are taken in the logarithms of the parameters, which keeps them positive and free of units.

    Returns
    -------
    parameters, their covariance, and the minimum.
    """
    whiten = np.linalg.inv(np.linalg.cholesky(variance))

    def residual(logarithm: Array) -> Array:
        try:
            return np.asarray(whiten @ (target - model(np.exp(logarithm))))
        except InputError:  # beyond the law's pole: no step leads there
            return np.full(len(target), np.inf)

    step_size = 1e-6
    point = np.log(start)
    now = residual(point)
    damping = 1e-3
    jacobian = np.empty((len(target), len(point)))
    for _ in range(100):
        for column in range(len(point)):
            change = np.zeros(len(point))
            change[column] = step_size
            jacobian[:, column] = (residual(point + change) - residual(point - change)) / (2.0 * step_size)
        normal = jacobian.T @ jacobian
        while damping < 1e12:
            step = -np.linalg.solve(normal + damping * np.diag(np.diag(normal)), jacobian.T @ now)
            trial = residual(point + np.clip(step, -1.0, 1.0))
            if trial @ trial <= now @ now:
                break
            damping *= 10.0
        else:
            break
        point, now, damping = point + np.clip(step, -1.0, 1.0), trial, damping * 0.1
        if np.max(np.abs(step)) < 1e-8:
            break
    parameters = np.exp(point)
    spread = np.linalg.inv(normal) * np.outer(parameters, parameters)
    return parameters, spread, float(now @ now)
