"""Runs of a tribometer and friction curves of a formula, as files for the command line."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

import viscofric as vf

COULOMB, ZERO_FORCE = 0.05, 0.3

HEADER = "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)"


def viscoelastic(celsius: float, speed: float) -> float:
    """Friction of a formula; mm/s."""
    return 0.01 + 2e-4 * celsius - 0.002 * float(np.log10(speed))


def runs(
    path: Path,
    signs: tuple[int, ...] = (-1, 1),
    slips: tuple[int, ...] = (-1, 1),
    replicates: int = 2,
    noise: float = 0.0,
    load: float = 25.0,
) -> Path:
    """Write runs of the formula: both slips for each of the signs of the disc speed."""
    random = np.random.default_rng(3)
    rows = [HEADER]
    for celsius, speed, replicate, sign, slip in product(
        (30.0, 60.0), (20.0, 60.0, 200.0), range(1, replicates + 1), signs, slips
    ):
        force = ZERO_FORCE + load * (COULOMB * slip + viscoelastic(celsius, speed) * sign)
        force += noise * random.standard_normal()
        rows.append(f"{celsius},{replicate},{sign * speed},{sign * speed - 0.1 * slip * speed},{load},{force!r}")
    path.write_text("\n".join(rows), encoding="utf-8")
    return path


LAW = vf.WLF(C1=9.0, C2=100.0, reference="30 degC")

TEMPERATURES = np.array([30.0, 35.0, 40.0, 46.0]) + 273.15


def curves(path: Path, temperatures: Any = TEMPERATURES, noise: float = 0.01, load: float = 25.0) -> Path:
    """Write friction curves of one formula over the reduced speed, with shift factors of the law."""
    kelvin, speed = (grid.ravel() for grid in np.meshgrid(temperatures, np.geomspace(0.02, 0.2, 8), indexing="ij"))
    friction = 0.01 * (1.0 + (LAW(kelvin) * speed / 0.02) ** -0.4)
    error = noise * friction
    moved = friction + error * np.random.default_rng(5).standard_normal(error.size)
    same = np.full(error.size, load)
    vf.write_friction_curves(
        vf.FrictionCurves(speed, kelvin, same, moved, error, 3.0 * error, np.full(error.size, 9)), path
    )
    return path
