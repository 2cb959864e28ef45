"""What the contact benchmarks solve, stated once for viscofric and its peers."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

import viscofric as vf
from contact.made_surfaces import refined, self_affine
from gallery import (
    BALL_RADIUS,
    HERTZ_RADIUS,
    LOAD,
    POISSON_RATIO,
    RUBBER_MODULUS,
)

PRESSURE = 0.05
VISCOELASTIC_PRESSURE = 0.1  # that of about a tenth of the area
TOLERANCE = 1e-8
#: E* = 1 for all rough contacts at rest.
ELASTIC = vf.Material(vf.RetardationSpectrum(1.0, 2.0, [0.5], [1.0]), poisson_ratio=0.0)
#: E_inf/E0 = 100, memory lengths of 1e-4 to 10 periods at unit speed.
VISCOELASTIC = vf.Material(
    vf.RetardationSpectrum(1.0, 100.0, np.full(20, 0.99 / 20), np.logspace(-4, 1, 20)), poisson_ratio=0.0
)


def rough_surface(points: int) -> vf.contact.PeriodicSurface:
    """H = 0.8, eight points per shortest wave, rms slope 1, period 1."""
    return vf.contact.PeriodicSurface(self_affine(points), 1.0 / points)


def refined_surface(points: int) -> vf.contact.PeriodicSurface:
    """Return that of 256 x 256 points on a finer grid."""
    return vf.contact.PeriodicSurface(refined(self_affine(256), points), 1.0 / points)


def elastic_rough(surface: vf.contact.PeriodicSurface, tolerance: float = TOLERANCE) -> vf.contact.PeriodicSolution:
    """Press the surface against an elastic half-space."""
    return vf.solve_periodic(ELASTIC, surface, speed=0.0, pressure=PRESSURE, tolerance=tolerance)


def viscoelastic_rough(
    surface: vf.contact.PeriodicSurface, tolerance: float = TOLERANCE
) -> vf.contact.PeriodicSolution:
    """Slide the surface over a viscoelastic half-space."""
    return vf.solve_periodic(VISCOELASTIC, surface, speed=1.0, pressure=VISCOELASTIC_PRESSURE, tolerance=tolerance)


#: The friction curve: 40 modes, three a decade over thirteen decades, C_k ∝ τ_k^(1/4), E_inf/E0 = 1000, under a load
#: at which the Hertz radius at E0 is 0.5 mm.
_DECADES = np.arange(40) / 3.0 - 13.0
_SHARES = 10.0 ** (_DECADES / 4.0)
_LONGEST = 1e3  # s
CURVE_RUBBER = vf.Material(
    vf.RetardationSpectrum(
        RUBBER_MODULUS,
        1e3 * RUBBER_MODULUS,
        0.999 / RUBBER_MODULUS * _SHARES / _SHARES.sum(),
        _LONGEST * 10.0**_DECADES,
    ),
    shift=vf.WLF(C1=17.44, C2=51.6, reference=293.15),
    poisson_ratio=POISSON_RATIO,
)
CURVE_BALL, CURVE_LOAD = vf.Ball(radius=BALL_RADIUS), LOAD


def curve_speeds(slowest: float, decades: float, count: int) -> NDArray[np.float64]:
    """Speeds, m/s, from that at which the longest memory is so many Hertz radii."""
    return slowest * HERTZ_RADIUS / _LONGEST * np.logspace(0.0, decades, count)
