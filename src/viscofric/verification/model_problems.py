"""Contacts given by dimensionless numbers: a ball or a cylinder, E∞/E0, and memory lengths over Hertz's a0.

They have ordinary units (1 MPa, 10 mm, 0.1 m/s), and their results are in those of Hertz's contact at E0 under the
same load: lengths in a0, depths in a0²/R, friction in a0/R, pressures in p0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.solution import ContactSolution
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification.engine import solve_steady

RUBBER_MODULUS = 1e6  # Pa
POISSON_RATIO = 0.5
STIFFNESS = RUBBER_MODULUS / (1.0 - POISSON_RATIO**2)  # Pa
RADIUS = 10e-3  # m
HERTZ_RADIUS = 0.5e-3  # m: a0/R = 0.05, well within small strain
SLOPE = HERTZ_RADIUS / RADIUS
SPEED = 0.1  # m/s
BALL_LOAD = 4.0 * STIFFNESS * HERTZ_RADIUS**3 / (3.0 * RADIUS)  # N
CYLINDER_LOAD = np.pi * STIFFNESS * HERTZ_RADIUS**2 / (4.0 * RADIUS)  # N/m
BALL_PRESSURE = 1.5 * BALL_LOAD / (np.pi * HERTZ_RADIUS**2)  # Pa
BALL, CYLINDER = Ball(radius=RADIUS), Cylinder(radius=RADIUS)


def rubber(modulus_ratio: float, shares: Sequence[float], memory_lengths: Sequence[float]) -> Material:
    """Return a material from dimensionless numbers.

    `modulus_ratio` is k = E∞/E0; `shares` (m,) are C_k in any common unit, scaled to add up to 1/E0 − 1/E∞;
    `memory_lengths` (m,) are vτ_k/a0 at `SPEED`.
    """
    parts = np.asarray(shares, dtype=float)
    spectrum = RetardationSpectrum(
        E0=RUBBER_MODULUS,
        E_inf=modulus_ratio * RUBBER_MODULUS,
        C=(1.0 - 1.0 / modulus_ratio) / RUBBER_MODULUS * parts / parts.sum(),
        tau=np.asarray(memory_lengths, dtype=float) * HERTZ_RADIUS / SPEED,
    )
    return Material(spectrum, poisson_ratio=POISSON_RATIO)


def one_time(modulus_ratio: float, memory_length: float) -> Material:
    """Return a rubber with one retardation time: k = E∞/E0 and vτ/a0."""
    return rubber(modulus_ratio, [1.0], [memory_length])


def equal_modes(memory_length: float) -> Material:
    """Return a rubber with 25 equal modes, two a decade over twelve decades up to vτ/a0, and k = 10."""
    return rubber(10.0, np.ones(25).tolist(), (memory_length * 10.0 ** (np.arange(25) / 2.0 - 12.0)).tolist())


def rising_modes(memory_length: float) -> Material:
    """Return a rubber with 37 modes, C_k ∝ τ_k^(1/4), three a decade up to vτ/a0, and k = 1000."""
    decades = np.arange(37) / 3.0 - 12.0
    return rubber(1000.0, (10.0 ** (decades / 4.0)).tolist(), (memory_length * 10.0**decades).tolist())


#: Rules of spectra by name: of one number each, the longest memory (of one retardation time also k).
SPECTRA = {"25 modes": equal_modes, "37 modes": rising_modes}


@dataclass(frozen=True)
class InHertzUnits:
    """A solution in pure numbers: μR/a0, δR/a0², edges over a0, area over πa0² (width over 2a0), pressure over p0."""

    friction: float
    energy_friction: float
    indentation: float
    front: float
    rear: float
    half_width: float
    area: float
    max_pressure: float

    @classmethod
    def of(cls, solution: ContactSolution) -> InHertzUnits:
        """Express the solution of a model problem so."""
        line = solution.geometry == "line"
        whole = 2.0 * HERTZ_RADIUS if line else np.pi * HERTZ_RADIUS**2
        pressure = 2.0 * CYLINDER_LOAD / (np.pi * HERTZ_RADIUS) if line else BALL_PRESSURE
        return cls(
            friction=solution.friction_coefficient / SLOPE,
            energy_friction=solution.energy_friction_coefficient / SLOPE,
            indentation=solution.indentation / (SLOPE * HERTZ_RADIUS),
            front=solution.front / HERTZ_RADIUS,
            rear=solution.rear / HERTZ_RADIUS,
            half_width=solution.half_width / HERTZ_RADIUS,
            area=solution.contact_area / whole,
            max_pressure=solution.max_pressure / pressure,
        )


def solve_ball(material: Material, speed: float = SPEED, **settings: Any) -> ContactSolution:
    """Solve the model ball on a rubber."""
    return solve_steady(material, BALL, speed=speed, **{"load": BALL_LOAD, **settings})


def solve_cylinder(material: Material, speed: float = SPEED, **settings: Any) -> ContactSolution:
    """Solve the model cylinder on a rubber."""
    return solve_steady(material, CYLINDER, speed=speed, **{"load": CYLINDER_LOAD, **settings})
