"""Standard errors from the readings within passes, for conditions at which no pass was repeated."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array, Indices, Integers, Mask
    from viscofric.friction.measurement.separation import Fit


_AUTOCORRELATIONS = np.linspace(0.0, 0.99, 200)


def of_readings(
    fits: list[Fit], weights: Array, lacking: Mask
) -> tuple[dict[tuple[int, int], tuple[float, float]], float]:
    """Estimate the variance of coefficients whose passes leave nothing over, from the scatter within the passes.

    Readings of a pass are an autoregressive series of first order.  Its autocorrelation is that of all passes together,
    with which the mean products of deviations from means agree in expectation.

    Parameters
    ----------
    fits : list of Fit
    weights : (3,) array
        Of force, drift and changes of the zero.
    lacking : (k, 4) array of bool
        Which of the numbers of each condition lack an error.

    Returns
    -------
    dict
        Variance and degrees of freedom by condition and number, where there are several readings in a pass.
    float
        The autocorrelation.
    """
    places = [
        place
        for place in np.flatnonzero(np.any(lacking, axis=1)).tolist()
        if fits[place].group.rows.size > int(fits[place].passes.max()) + 1
    ]
    if not places:
        return {}, 0.0
    deviations = {place: _deviations(fits[place], weights) for place in places}
    sizes = np.concatenate([np.bincount(fits[place].passes) for place in places])
    squares = sum(float(np.sum(one**2)) for one in deviations.values())
    products = sum(_products(one, fits[place].passes) for place, one in deviations.items())
    rho = _autocorrelation(products / squares if squares else 0.0, sizes)
    readings = float(np.sum(sizes - 1))
    found = {}
    for place in places:
        fit, size = fits[place], np.bincount(fits[place].passes)
        spread = _of_sums(rho, size) / size  # variance of a mean over that of one independent reading
        scatter = float(np.sum(deviations[place] ** 2)) / float(np.sum(size - _of_sums(rho, size)))
        freedom = (1.0 + rho**2) / (1.0 - rho**2) / float(np.sum(size - 1))
        # Of the logarithm of (1 + ρ)/(1 − ρ), where ρ has the variance (1 − ρ²)/n.
        freedom += 2.0 / (1.0 - rho**2) / readings if rho else 0.0
        for number in np.flatnonzero(lacking[place]).tolist():
            passes = np.bincount(fit.passes, fit.operator[number])
            found[place, number] = (scatter * float(np.sum(passes**2 * spread)), 1.0 / freedom)
    return found, rho


def _deviations(fit: Fit, weights: Array) -> Array:
    """Return the readings less the means of their passes, N."""
    left = fit.residual @ weights
    return np.asarray(left - (np.bincount(fit.passes, left) / np.bincount(fit.passes))[fit.passes])


def _products(deviations: Array, passes: Indices) -> float:
    order = np.argsort(passes, kind="stable")
    same = passes[order][1:] == passes[order][:-1]
    return float(np.sum((deviations[order][1:] * deviations[order][:-1])[same]))


def _of_sums(rho: float | Array, size: Integers) -> Array:
    """Variance of the sum of n readings over n times that of one: 1 + 2 Σ (1 − k/n) ρᵏ over the lags k."""
    n = np.asarray(size, dtype=float)
    return np.asarray((1.0 + rho) / (1.0 - rho) - 2.0 * rho * (1.0 - rho**n) / (n * (1.0 - rho) ** 2))


def _autocorrelation(ratio: float, sizes: Integers) -> float:
    """Return the autocorrelation, not below zero, at which products over squares have this ratio in expectation."""
    rho = _AUTOCORRELATIONS[:, None]
    size, count = np.unique(sizes, return_counts=True)
    sums = _of_sums(rho, size)
    first = (1.0 - rho**size) / (size * (1.0 - rho))  # mean correlation of the first reading with all
    products = (size - 1) * rho - 2.0 * sums + 2.0 * first + (size - 1) * sums / size
    expected = (products @ count) / ((size - sums) @ count)
    return float(np.interp(ratio, expected, _AUTOCORRELATIONS))
