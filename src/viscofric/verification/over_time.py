"""Contacts over time: a ball that is pressed on, and one that falls, against their closed forms."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viscofric.motion.history import History
from viscofric.motion.impact import solve_impact
from viscofric.motion.solve import solve_transient
from viscofric.rheology.material import Material
from viscofric.verification.check import Comparison, checks
from viscofric.verification.model_problems import BALL, POISSON_RATIO, RADIUS, RUBBER_MODULUS, one_time, rising_modes

check = checks("closed forms")

_LOAD, _DEPTH = 1.0, 2e-4  # N, m
_PLANE_STRAIN = 1.0 - POISSON_RATIO**2
_MASS, _SPEED = 0.03, 0.1  # kg, m/s
_ACCURACY, _IMPACT_ACCURACY = 1e-3, 3e-6


@check(
    "lee-radok",
    "Ball on which a load or a depth is put at once",
    "a³ = (3/4)(1 − ν²) R F J(t), and F = (4/3) √R δ^1.5 E(t)/(1 − ν²) (E. H. Lee, J. R. M. Radok 1960)",
    "The requested accuracy, of the largest depth and load.",
)
def _lee_radok() -> Iterator[Comparison]:
    for name, rubber in (("one time", one_time(10.0, 1.0)), ("37 modes", rising_modes(1e6))):
        spectrum = rubber.modes_at()
        tau = float(np.exp(np.mean(np.log(spectrum.tau))))
        times = [0.01 * tau, 0.3 * tau, 3.0 * tau]
        history = History([0.0, 10.0 * tau], load=_LOAD)
        run = solve_transient(rubber, BALL, history, times=times, accuracy=_ACCURACY)
        radii = np.cbrt(0.75 * _PLANE_STRAIN * RADIUS * _LOAD * spectrum.creep_compliance(times))
        for time, depth, radius in zip(times, run.indentation, radii, strict=True):
            case = f"{name}, load step, t = {time:.2g} s"
            yield Comparison(case, "indentation (m)", float(depth), float(radius**2 / RADIUS), _ACCURACY)
        history = History([0.0, 10.0 * tau], indentation=_DEPTH)
        run = solve_transient(rubber, BALL, history, times=times, accuracy=_ACCURACY)
        stiffness = 4.0 / 3.0 * math.sqrt(RADIUS) * _DEPTH**1.5 / _PLANE_STRAIN
        forces = stiffness * spectrum.relaxation_modulus(times)
        first = stiffness * spectrum.E_inf
        for time, load, force in zip(times, run.load, forces, strict=True):
            case = f"{name}, depth step, t = {time:.2g} s"
            computed, expected = float(load) / first, float(force) / first
            yield Comparison(case, "load over the first load", computed, expected, _ACCURACY, "absolute")


@check(
    "impact",
    "Ball that rebounds",
    "loss to first order in the retardation times (R. Ramírez, T. Pöschel, N. V. Brilliantov, T. Schwager 1999); "
    "contact time and depth of H. Hertz; energy balance",
    "The next order of the loss is τ over the contact time, 1e-4 and its square; a restitution known to 3e-6, of a "
    "loss of 5e-4, makes 0.6 %.",
)
def _impact() -> Iterator[Comparison]:
    kappa = 4.0 * math.sqrt(RADIUS) / (3.0 * _PLANE_STRAIN)
    depth = (1.25 * _MASS * _SPEED**2 / (kappa * RUBBER_MODULUS)) ** 0.4
    tau = 1e-6
    soft = Material.standard_linear_solid(RUBBER_MODULUS, 10.0 * RUBBER_MODULUS, tau, POISSON_RATIO)
    hit = solve_impact(soft, BALL, mass=_MASS, speed=_SPEED, accuracy=_IMPACT_ACCURACY)
    beta = math.gamma(0.6) * math.gamma(1.5) / math.gamma(2.1)
    spent = RUBBER_MODULUS * float(soft.modes_at().C @ soft.modes_at().tau)
    loss = 1.2 * kappa * RUBBER_MODULUS * spent * depth**1.5 * beta / (_MASS * _SPEED)
    yield Comparison("contact of 10⁴ times τ", "1 − restitution", 1.0 - hit.restitution, loss, 0.01)
    duration = 2.0 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9) * depth / _SPEED
    yield Comparison("contact of 10⁴ times τ", "contact time (s)", hit.contact_time, duration, 2e-3)
    yield Comparison("contact of 10⁴ times τ", "indentation (m)", hit.largest_indentation, depth, 2e-3)
    hit = solve_impact(rising_modes(1e6), BALL, mass=_MASS, speed=_SPEED)
    yield Comparison("37 modes", "work less stored and dissipated", hit.run.energy_imbalance, 0.0, 1e-4, "absolute")
