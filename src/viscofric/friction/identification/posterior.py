"""Least squares with a prior: the minimum, the evidence for the prior, and samples around the minimum."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.notes import Note, Remedy

#: Returns residuals (r,) at unknowns (p,), and their derivatives (r, p).
Residuals: TypeAlias = Callable[[Array], tuple[Array, Array]]
ITERATIONS = 100
CONVERGED = 1e-5  # relative fall of the sum of squares, beside one
LARGEST_DAMPING, LEAST_DAMPING = 1e12, 1e-9
TINY = 1e-300
#: … with which a draw ends: its place need not be known better than to a hundredth of its scatter.
DRAW_CONVERGED = 1e-4
#: Probability of residuals as small as those that are noted, and the smallest ratio to the errors that is written.
TOO_GOOD, LEAST_RATIO = 1e-3, 1e-3


class Minimum(NamedTuple):
    """The point of the least sum of squares."""

    place: Array  # (p,)
    squares: float  # that sum
    normal: Array  # (p, p), matrix of the normal equations there
    settled: bool  # whether the search converged


def descend(residuals: Residuals, start: Array, converged: float = CONVERGED, metric: Array | None = None) -> Minimum:
    """Minimise a sum of squares by the method of Levenberg and Marquardt, in 100 steps at most."""
    # Steps are damped in a metric (p, p), positive definite; that of the prior takes few steps along directions that
    # the measurement does not determine. The damping follows H. B. Nielsen, Report IMM-REP-1999-05, DTU 1999.
    place, damping, growth = np.array(start), 1.0, 2.0
    metric = np.eye(len(place)) if metric is None else metric
    values, jacobian = residuals(place)
    squares = float(values @ values)
    for _ in range(ITERATIONS):
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ values
        while True:
            step = -np.linalg.solve(normal + damping * metric, gradient)
            tried = place + step
            with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # too far a step is tried in vain
                tried_values, tried_jacobian = residuals(tried)
            found = float(tried_values @ tried_values)
            if np.isfinite(found) and found <= squares:
                break
            damping, growth = growth * damping, 2.0 * growth
            if damping > LARGEST_DAMPING:
                return Minimum(place, squares, normal, True)
        fall = squares - found
        gained = fall / max(-float(step @ (2.0 * gradient + normal @ step)), TINY)
        damping = max(damping * max(1.0 / 3.0, 1.0 - (2.0 * gained - 1.0) ** 3), LEAST_DAMPING)
        growth = 2.0
        place, values, jacobian, squares = tried, tried_values, tried_jacobian, found
        if fall <= converged * (1.0 + squares):
            return Minimum(place, squares, jacobian.T @ jacobian, True)
    return Minimum(place, squares, jacobian.T @ jacobian, False)


def log_evidence(minimum: Minimum, log_volume: float) -> float:
    """Return ln of the marginal likelihood (Laplace), up to a constant; `log_volume` is that of the prior's norm."""
    return log_volume - 0.5 * minimum.squares - 0.5 * float(np.linalg.slogdet(minimum.normal)[1])


def draws(
    residuals: Residuals, minimum: Minimum, count: int, random: np.random.Generator, metric: Array | None = None
) -> Array:
    """Draw from the density exp(−|r|²/2), (count, p): each sample is the minimum for other errors of all inputs."""
    # Measurements and prior means are changed by errors of their own size, and fitted again. This is exact for linear
    # residuals, and for as many residuals as unknowns up to the change of |∂r/∂x|; samples are independent. Randomised
    # maximum likelihood: Y. Chen, D. S. Oliver, Math. Geosci. 44 (2012) 1; J. M. Bardsley et al., SIAM J. Sci. Comput.
    # 36 (2014) A1895.
    size = len(residuals(minimum.place)[0])
    found = []
    for _ in range(count):
        error = random.standard_normal(size)

        def moved(place: Array, error: Array = error) -> tuple[Array, Array]:
            values, jacobian = residuals(place)
            return values - error, jacobian

        found.append(descend(moved, minimum.place, DRAW_CONVERGED, metric).place)
    return np.array(found)


def correlation(residuals: Array) -> float:
    """Return by how many standard deviations successive residuals are more alike than independent ones."""
    # J. von Neumann et al., Annals of Mathematical Statistics 12 (1941) 153.
    n = len(residuals)
    ratio = float(np.sum(np.diff(residuals) ** 2) / (residuals @ residuals))
    return float((1.0 - 0.5 * ratio) * np.sqrt((n**2 - 1.0) / (n - 2.0)))


def too_small(residuals: Array, freedom: float, example: str, remedy: Remedy | None = None) -> tuple[Note, ...]:
    """Return a note if residuals over given standard errors are smaller than chance explains: errors are shared."""
    # `example` is a clause about a shared error, `remedy` the end of the sentence.
    from scipy.special import chdtr

    chi2 = float(residuals @ residuals)
    if freedom < 1.0 or chdtr(freedom, chi2) > TOO_GOOD:
        return ()
    ratio = max(float(np.sqrt(chi2 / freedom)), LEAST_RATIO)
    note = Note(
        "errors-not-scatter",
        f"The residuals are {1.0 / ratio:.2g} times smaller than the given standard errors: these are too large, or "
        f"shared by the points, {example}; the bands, which take them as independent, are then too narrow"
        + ("." if remedy is None else ""),
        remedy=remedy,
        values={"factor": ratio},
    )
    return (note,)
