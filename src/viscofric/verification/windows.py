"""The free half-space as the limit of large periodic windows, and how slowly that limit is reached."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.verification import model_problems as model
from viscofric.verification.check import Check, Comparison
from viscofric.verification.engine import solve_periodic

MODULUS_RATIO, MEMORY_LENGTH = 10.0, 10.0
PERIODS = (2.4, 4.8, 9.6, 19.2, 38.4)  # a0
_CELLS = 32  # to the shortest period


@dataclass(frozen=True)
class Windows:
    """Friction of a ball that is repeated along x and y, compared with that of one ball alone."""

    periods: Array  # (n,), over a0
    friction: Array  # (n,), μR/a0
    free: float  # μR/a0 of one ball on the free half-space

    @property
    def deviations(self) -> Array:
        """Relative differences from the free contact."""
        return self.friction / self.free - 1.0

    @property
    def orders(self) -> Array:
        """Order of the approach from each period to the next."""
        size = np.abs(self.deviations)
        return np.asarray(np.log(size[:-1] / size[1:]) / np.log(self.periods[1:] / self.periods[:-1]))


def windows() -> Windows:
    """Solve the periodic contacts and the free one."""
    material = model.one_time(MODULUS_RATIO, MEMORY_LENGTH)
    cell = PERIODS[0] * model.HERTZ_RADIUS / _CELLS
    friction = []
    for period in PERIODS:
        cells = round(period * model.HERTZ_RADIUS / cell)
        x = cell * (np.arange(cells) - 0.5 * cells + 0.5)
        surface = PeriodicSurface(-(x[:, None] ** 2 + x**2) / (2.0 * model.RADIUS), cell)
        pressure = model.BALL_LOAD / (cells * cell) ** 2
        found = solve_periodic(material, surface, speed=model.SPEED, pressure=pressure, tolerance=1e-7)
        friction.append(found.friction_coefficient / model.SLOPE)
    return Windows(np.array(PERIODS), np.array(friction), model.solve_ball(material).friction_coefficient / model.SLOPE)


def _windows() -> Iterator[Comparison]:
    found = windows()
    case = f"k = {MODULUS_RATIO:g}, vτ/a0 = {MEMORY_LENGTH:g}"
    deviations = found.deviations
    for period, before, after in zip(found.periods[1:], deviations, deviations[1:], strict=False):
        left = f"share of the deviation left at {period:.3g} a0"
        yield Comparison(case, left, abs(float(after / before)), 0.8, 0.0, "at most")
    last = f"friction μR/a0 at {found.periods[-1]:.3g} a0"
    yield Comparison(case, last, float(found.friction[-1]), found.free, 0.02)
    yield Comparison(case, "order of the last doubling", float(found.orders[-1]), 2.0, 0.0, "at least")


CHECKS = (
    Check(
        "large-windows",
        "A ball repeated in periods of 2.4 to 38.4 a0",
        "refinement",
        "one ball on the free half-space, solved without Fourier space's periodicity",
        "The memory length is 10 a0; for longer periods, the effect of the periodic images falls at least as the "
        "inverse square of the period. In the largest window it is 1 %, and the cells of 0.075 a0 add a few tenths "
        "of a per cent.",
        _windows,
    ),
)
