"""Least squares with a prior: where it is least, how much evidence there is for the prior, and draws around it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    #: Residuals (r,) of standard deviation one, and their derivatives (r, p).
    Residuals = Callable[[Array], tuple[Array, Array]]

ITERATIONS = 60
CONVERGED = 1e-7  # relative fall of the sum of squares, beside one
LARGEST_DAMPING = 1e12
#: Draws of a chain that lie between two that are kept; elliptical slices forget in a few.
THINNING = 2


class Minimum(NamedTuple):
    """Where the sum of squares is least (p,), that sum, and the matrix of normal equations there (p, p).

    `settled` says whether it fell no more in the end.
    """

    place: Array
    squares: float
    normal: Array
    settled: bool


def descend(residuals: Residuals, start: Array) -> Minimum:
    """Minimise a sum of squares by the method of Levenberg and Marquardt, in 60 steps at most."""
    place, damping = np.array(start), 1e-3
    values, jacobian = residuals(place)
    squares = float(values @ values)
    for _ in range(ITERATIONS):
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ values
        while True:
            damped = normal + damping * np.diag(np.diag(normal))
            step = -np.linalg.solve(damped, gradient)
            tried = place + step
            tried_values, tried_jacobian = residuals(tried)
            found = float(tried_values @ tried_values)
            if np.isfinite(found) and found <= squares:
                break
            damping *= 8.0
            if damping > LARGEST_DAMPING:
                return Minimum(place, squares, normal, True)
        fall = squares - found
        place, values, jacobian, squares = tried, tried_values, tried_jacobian, found
        damping = max(0.1 * damping, 1e-9)
        if fall <= CONVERGED * (1.0 + squares):
            return Minimum(place, squares, jacobian.T @ jacobian, True)
    return Minimum(place, squares, jacobian.T @ jacobian, False)


def log_evidence(minimum: Minimum, log_volume: float) -> float:
    """Return the logarithm of the marginal likelihood by Laplace's approximation, up to a constant.

    `log_volume` is that of the prior's normalisation, as far as it differs between what is compared.
    """
    return log_volume - 0.5 * minimum.squares - 0.5 * float(np.linalg.slogdet(minimum.normal)[1])


def draws(residuals: Residuals, minimum: Minimum, count: int, random: np.random.Generator) -> Array:
    """Draw from the density exp(−|r|²/2), (count, p).

    Elliptical slices about the normal density of the minimum, which need no tuning and are exact for any residuals.

    References
    ----------
    I. Murray, R. P. Adams, D. J. C. MacKay, JMLR W&CP 9 (2010) 541; about a normal density other than the prior:
    R. Nishihara, I. Murray, R. P. Adams, JMLR 15 (2014) 2087.
    """
    factor = np.linalg.cholesky(minimum.normal)
    size = len(minimum.place)

    def beyond_normal(whitened: Array) -> float:
        values, _ = residuals(minimum.place + np.linalg.solve(factor.T, whitened))
        return 0.5 * float(whitened @ whitened) - 0.5 * float(values @ values)

    now = random.standard_normal(size)
    level = beyond_normal(now)
    found = np.empty((count, size))
    for number in range(THINNING * (count + 1)):
        other = random.standard_normal(size)
        slice_at = level + float(np.log(random.uniform()))
        angle = random.uniform(0.0, 2.0 * np.pi)
        low, high = angle - 2.0 * np.pi, angle
        while True:
            tried = now * np.cos(angle) + other * np.sin(angle)
            tried_level = beyond_normal(tried)
            if tried_level > slice_at:
                break
            low, high = (angle, high) if angle < 0.0 else (low, angle)
            angle = random.uniform(low, high)
        now, level = tried, tried_level
        if number >= THINNING and number % THINNING == 0:
            found[number // THINNING - 1] = now
    return minimum.place + np.linalg.solve(factor.T, found.T).T
