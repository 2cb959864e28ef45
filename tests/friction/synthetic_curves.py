"""Friction of the synthetic fluoroelastomer at nine temperatures, solved once, and measurements made from it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.curves import FrictionCurves
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.shifts.laws import ShiftLaw

PATH = Path(__file__).parents[1] / "data" / "synthetic_friction_curves.csv"
REPLICATES = 8
LOAD = 25.0  # N


def planted_law() -> ShiftLaw:
    shift = synthetic_fluoroelastomer().shift
    assert shift is not None
    return shift


def synthetic_curves(*celsius: float, noise: float = 0.0, seed: int = 0) -> FrictionCurves:
    """Friction at all nine or some temperatures; with noise, means of replicates whose friction scatters by so much."""
    temperature, speed, friction, error = np.loadtxt(PATH, delimiter=",", skiprows=3).T
    if celsius:
        rows = np.isin(np.round(temperature - 273.15, 2), celsius)
        temperature, speed, friction, error = temperature[rows], speed[rows], friction[rows], error[rows]
    if noise == 0.0:
        return curves_of(speed, temperature, friction, error)
    return noisy(speed, temperature, friction, noise, np.random.default_rng(seed))


def noisy(
    speed: Array,
    temperature: Array,
    friction: Array,
    noise: float,
    random: np.random.Generator,
) -> FrictionCurves:
    """Mean and standard error of replicates with multiplicative scatter."""
    values = friction[:, None] * (1.0 + noise * random.standard_normal((friction.size, REPLICATES)))
    error = values.std(axis=1, ddof=1) / np.sqrt(REPLICATES)
    return curves_of(speed, temperature, values.mean(axis=1), error, replicates=REPLICATES)


def curves_of(
    speed: Array,
    temperature: Array,
    friction: Array,
    error: float | Array,
    *,
    replicates: int = 1,
    load: float | Array = LOAD,
) -> FrictionCurves:
    shape = friction.shape
    errors = np.broadcast_to(error, shape)
    return FrictionCurves(
        speed=speed,
        temperature=temperature,
        load=np.broadcast_to(load, shape),
        viscoelastic=friction,
        viscoelastic_error=errors,
        viscoelastic_scatter=errors * np.sqrt(replicates),
        replicates=np.full(shape, replicates),
    )
