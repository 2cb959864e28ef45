"""The objective of every fit of a spectrum: the errors of ln E' and ln E'', and their derivatives by the modes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array, ComplexArray


#: Modes lie between retardation times (1/ω_max) / EDGE and EDGE / ω_min.  A mode further out cannot be separated from
#: a plateau, nor from the flow of a liquid: its compliance could grow without bound.
EDGE = math.e
#: Largest stiffness of the glass.  Where the sweeps end in the middle of the transition nothing else bounds it: its
#: compliance is too small a part of the measured one.
STIFFEST = 30.0  # times the largest measured storage modulus


@dataclass(frozen=True, eq=False)
class Modes:
    """A glass compliance 1/E_inf (1/Pa), and compliances C (n,) (1/Pa) and retardation times tau (n,) (s)."""

    glass: float
    C: Array
    tau: Array


class ModulusMisfit:
    """Differences of ln E' and ln E'', without unit, between modes and a measurement.

    `angular_frequency` (N,) ascends, in rad/s; `measured` (N,) is E' + iE'' in Pa.
    """

    def __init__(self, angular_frequency: Array, measured: ComplexArray) -> None:
        self.angular_frequency = angular_frequency
        self.measured = measured
        self.target = np.concatenate([np.log(measured.real), np.log(measured.imag)])
        self.least_glass = 1.0 / (STIFFEST * float(np.max(measured.real)))

    @property
    def ends(self) -> tuple[float, float]:
        """Logarithms of the shortest and the longest retardation time that a mode may have."""
        edge = math.log(EDGE)
        return -math.log(self.angular_frequency[-1]) - edge, edge - math.log(self.angular_frequency[0])

    def relaxed(self, tau: Array) -> ComplexArray:
        """Return 1/(1 + iωτ), the compliance of modes of strength one, (N, n)."""
        return np.asarray(1.0 / (1.0 + 1j * np.outer(self.angular_frequency, tau)))

    def columns(self, tau: Array) -> ComplexArray:
        """Return the compliance of a glass and of modes, each of strength one, (N, 1 + n)."""
        return np.concatenate([np.ones((len(self.measured), 1), dtype=complex), self.relaxed(tau)], axis=1)

    def residual(self, compliance: ComplexArray) -> Array:
        """Return measured minus computed ln E' and ln E'', (2N,); infinite where a modulus is not above zero."""
        modulus = 1.0 / compliance
        if not np.all((modulus.imag > 0.0) & (modulus.real > 0.0)):  # no mode at all
            return np.full(len(self.target), np.inf)
        return np.asarray(self.target - np.concatenate([np.log(modulus.real), np.log(modulus.imag)]))

    def jacobian(self, compliance: ComplexArray, change: ComplexArray) -> Array:
        """Return the change of ln E' and ln E'', (2N, m), for changes of the compliance, (N, m)."""
        modulus = 1.0 / compliance
        moved = -(modulus**2)[:, None] * change
        return np.concatenate([moved.real / modulus.real[:, None], moved.imag / modulus.imag[:, None]])


def descend(
    residual: Callable[[Array], Array],
    normal: Callable[[Array, Array], tuple[Array, Array]],
    start: Array,
    *,
    iterations: int,
    tolerance: float,
) -> Array:
    """Minimise a sum of squares over logarithms (n,) of parameters by Levenberg–Marquardt steps.

    `residual` returns the residuals r at a point, infinite outside the domain; `normal`, at a point and its residuals,
    JᵀJ and Jᵀr.  The search stops when the sum of squares falls by less than the relative `tolerance`.
    D. W. Marquardt, J. Soc. Indust. Appl. Math. 11 (1963) 431.
    """
    point, now = start, residual(start)
    damping = 1e-3
    for _ in range(iterations):
        matrix, gradient = normal(point, now)
        scale = np.diag(matrix) + 1e-12 * float(np.max(np.diag(matrix)))
        before = float(now @ now)
        while damping < 1e9:
            step = np.clip(np.linalg.solve(matrix + damping * np.diag(scale), gradient), -2.0, 2.0)
            trial = residual(point + step)
            if trial @ trial < before:
                break
            damping = 10.0 * damping
        else:
            break
        point, now, damping = point + step, trial, 0.1 * damping
        if before - float(now @ now) < tolerance * before:
            break
    return point
