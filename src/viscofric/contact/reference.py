"""Closed forms that the numerical contact is held against."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class HertzContact:
    """Hertz's contact of a ball with an elastic half-space.

    Attributes
    ----------
    radius : float
        Contact radius a, m.
    indentation : float
        δ = a²/R, m.
    max_pressure : float
        p0 = 3F/(2πa²), Pa.
    """

    radius: float
    indentation: float
    max_pressure: float


def hertz_ball(load: float, ball_radius: float, modulus: float, poisson_ratio: float) -> HertzContact:
    """Hertz's solution for a rigid ball on an elastic half-space.

    Parameters
    ----------
    load, ball_radius, modulus, poisson_ratio : float
        N, m, Pa and dimensionless.

    References
    ----------
    K. L. Johnson, Contact Mechanics (1985), Eqs. 4.22-4.24.
    """
    radius = (3.0 * load * ball_radius * (1.0 - poisson_ratio**2) / (4.0 * modulus)) ** (1.0 / 3.0)
    return HertzContact(radius, radius**2 / ball_radius, 1.5 * load / (math.pi * radius**2))
