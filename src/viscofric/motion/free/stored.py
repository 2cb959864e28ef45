"""Marches on cells that are continued: all that a grid needs to go on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.operators.layer import ScaledLayer
from viscofric.motion.chains import Track
from viscofric.motion.free.mover import FreeMover
from viscofric.motion.free.setting import Setting
from viscofric.motion.memory import Modes
from viscofric.motion.mover import Problem, Sizes


@dataclass(frozen=True, eq=False)
class Basis:
    """Units, modes and grid of a march."""

    units: tuple[float, float, float]  # length, depth and stiffness
    toward: tuple[float, float]
    level: float
    known: Sizes | None
    modes: Modes
    grid: Grid
    size: float | None
    reach: Extent
    longest: float
    datum: float
    tolerance: float
    steps: float


@dataclass(frozen=True, eq=False)
class Level:
    """A march on one grid."""

    mover: FreeMover
    track: Track[Any]
    steps: float  # accuracy of its steps
    size: float | None = None  # half the contact that a first grid is made for

    @property
    def cells(self) -> float:
        """Number of cells along the longest contact."""
        return self.mover.longest / self.mover.grid.spacing

    @property
    def basis(self) -> Basis:
        """Units, modes and grid."""
        mover, setting = self.mover, self.mover.setting
        scale = setting.scale
        return Basis(
            (scale.length, scale.depth, scale.stiffness),
            setting.toward,
            setting.level,
            setting.known,
            setting.modes,
            mover.grid,
            self.size,
            mover.reach,
            mover.longest,
            mover.datum,
            mover.tolerance,
            self.steps,
        )


def level_of(problem: Problem, setting: Setting, basis: Basis, track: Track[Any]) -> Level:
    """Return a march that is to be continued; `setting` is that of the longer history."""
    scale, toward, layer = Scale(setting.geometry, *basis.units), basis.toward, None
    if problem.layer is not None:
        layer = ScaledLayer.of(problem.layer, scale.length, problem.material.poisson_ratio)
    shape = ScaledIndenter(setting.indenter, scale, toward)
    setting = replace(
        setting, scale=scale, shape=shape, toward=toward, layer=layer, known=basis.known, distance=basis.level
    ).with_modes(basis.modes, problem)
    mover = FreeMover(setting, basis.grid, basis.tolerance)
    mover.reach, mover.longest, mover.datum = basis.reach, basis.longest, basis.datum
    return Level(mover, track, basis.steps, basis.size)
