"""Least squares on the readings of one condition: zero, viscoelastic and Coulomb friction, and their errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import TractionRuns
    from viscofric.friction.measurement.conditions import Condition

    Array: TypeAlias = NDArray[np.float64]


def regressors(group: Condition, zero: float | None) -> Array:
    """Signs that go with zero, viscoelastic and Coulomb friction."""
    offset = np.full(group.rows.size, float(zero is None))
    return np.stack([offset, group.disc_sign, group.slip_sign], axis=1)


@dataclass(frozen=True, eq=False)
class Entry:
    """Zero (N), viscoelastic and Coulomb coefficient and consistency of a condition, in this order.

    `freedom` is the number of degrees of freedom behind the errors; what cannot be known has an infinite
    error.
    """

    value: Array
    error: Array
    scatter: Array
    replicates: int
    freedom: tuple[int, int]
    together: bool
    slides: bool
    checks: bool

    @classmethod
    def of(cls, runs: TractionRuns, group: Condition, zero: float | None) -> Entry:
        """Fit a condition's readings, each replicate by itself where all are complete."""
        numbers = np.unique(runs.replicate[group.rows])
        mine = [runs.replicate[group.rows] == number for number in numbers]
        configurations = [set(group.configurations[rows].tolist()) for rows in mine]
        complete = all(these == set(group.configurations.tolist()) for these in configurations)
        count = numbers.size
        slides, checks = bool(np.any(group.slip_sign)), _has_all_four(group)
        if complete and count > 1:
            each = np.array([_fit(runs, group, rows, zero)[0] for rows in mine])
            value, scatter = each.mean(axis=0), each.std(axis=0, ddof=1)
            error, freedom = scatter / np.sqrt(count), (count - 1, count - 1)
        else:
            value, error, freedom = _fit(runs, group, np.full(group.rows.size, True), zero)
            scatter = error * np.sqrt(count)
        unknown = np.array([False, False, not slides, not checks])
        error, scatter = (np.where(unknown, np.inf, spread) for spread in (error, scatter))
        return cls(value, error, scatter, count, freedom, not complete, slides, checks)


def _has_all_four(group: Condition) -> bool:
    return {-4, -2, 2, 4} <= set(group.configurations.tolist())


def _fit(
    runs: TractionRuns, group: Condition, rows: NDArray[np.bool_], zero: float | None
) -> tuple[Array, Array, tuple[int, int]]:
    """Fit readings of a condition: values, standard errors, degrees of freedom without and with the check."""
    force = runs.traction_force[group.rows][rows] - (zero or 0.0)
    load = runs.load[group.rows][rows] / group.load
    signs = regressors(group, zero)[rows] * np.stack([np.ones(load.size), load, load], axis=1)
    crossed = -(group.disc_sign * group.slip_sign)[rows] * load
    used = np.any(signs != 0.0, axis=0)
    value, error = np.zeros(4), np.zeros(4)
    value[:3][used], error[:3][used], freedom = _least_squares(signs[:, used], force)
    checked_freedom = 0
    if _has_all_four(group):
        coefficients, errors, checked_freedom = _least_squares(np.column_stack([signs[:, used], crossed]), force)
        value[3], error[3] = coefficients[-1], errors[-1]
    value[1:] /= group.load
    error[1:] /= group.load
    if zero is not None:
        value[0] = zero
    return value, error, (freedom, checked_freedom)


def _least_squares(design: Array, force: Array) -> tuple[Array, Array, int]:
    coefficients: Array = np.asarray(np.linalg.lstsq(design, force, rcond=None)[0], dtype=float)
    freedom = len(force) - design.shape[1]
    if freedom < 1:
        return coefficients, np.full(coefficients.shape, np.inf), 0
    variance = float(np.sum((force - design @ coefficients) ** 2)) / freedom
    covariance: Array = variance * np.linalg.inv(design.T @ design)
    return coefficients, np.sqrt(np.diag(covariance)), freedom
