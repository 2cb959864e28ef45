"""Periodic contact on nested grids: a coarse approximation of the surface is solved first, then finer ones.

Everything here is dimensionless: depths in rms heights of the surface, compliances relative to the largest.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.contact.arrays.backend import AnyArray, Backend
from viscofric.contact.complementarity import ComplementaritySolution
from viscofric.contact.periodic.one_grid import OneGrid, Stage
from viscofric.contact.periodic.surface import interpolated
from viscofric.errors import ConvergenceError
from viscofric.notes import Remedy
from viscofric.threads import in_parts

logger = logging.getLogger(__name__)

COARSEST = 32  # points along the longer edge of the coarsest grid, about
_FEWEST = 4  # along an edge that has more
COARSE_TOLERANCE = 2e-4  # a coarser surface differs anyway: more accuracy would be wasted

_MOST_COARSE_PRODUCTS = 2000  # on a grid that only provides the start of the next one


@dataclass(frozen=True)
class Work:
    """Work on the finest grid, unless stated otherwise."""

    products: int  # with the influence matrix
    ffts: int  # two-dimensional real FFTs
    single_ffts: int  # those in single precision
    splitting_steps: int
    set_changes: int
    linear_iterations: int
    grids: tuple[tuple[int, int, int], ...]  # points along x and y, and FFTs, of every grid, coarsest first
    coarser_pressure: Array | None  # (mx, my), on the grid before the finest one, if any


def coarser_shapes(shape: tuple[int, int]) -> list[tuple[int, int]]:
    """Return the shapes of the grids below one, finest first: half as many points; at least one, for errors."""
    found: list[tuple[int, int]] = []
    while max(shape) >= 2 * (_FEWEST if not found else COARSEST):
        shape = tuple(max(points // 2, min(points, _FEWEST)) for points in shape)  # type: ignore[assignment]
        found.append(shape)
    return found


def solve_on_levels(
    stages: Iterator[Stage],
    *,
    mean_pressure: float | None,
    offset: float | None,
    tolerance: float,
    most_products: int,
    backend: Backend,
) -> tuple[ComplementaritySolution, Work]:
    """Solve the contact on each grid in turn, coarsest first; ConvergenceError if the finest grid does not converge.

    `stages` are made when needed; `offset` is the mean gap, where no pressure is given; `tolerance` that of the
    complementarity on the finest grid, relative to the rms height; `most_products` applies to each grid.  Arguments and
    results are NumPy's on any backend.
    """
    coarser: ComplementaritySolution | None = None
    height: Array | None = None
    grids: list[tuple[int, int, int]] = []
    stage = next(stages)
    while True:
        finer = next(stages, None)
        if finer is not None:
            wanted, most = COARSE_TOLERANCE, min(most_products, _MOST_COARSE_PRODUCTS)
        else:
            wanted, most = tolerance, most_products
        level = OneGrid(stage, mean_pressure, offset, wanted, most, backend)
        start: AnyArray = None
        if coarser is not None and height is not None:
            start = backend.asarray(_refined(coarser, height, level))
            height = None
        result = level.solve(start).on_numpy(backend)
        ffts = level.exact.ffts + level.single.ffts
        grids.append((*level.shape, ffts))
        logger.debug("%s points: %s FFTs, residual %.1e", level.shape, ffts, result.complementarity)
        if finer is not None:
            coarser, height, stage = result, stage.height, finer
            continue
        if not result.converged:
            fewer = "take fewer points, or a smoother surface."
            raise ConvergenceError(
                f"the contact did not converge on a grid of {level.shape[0]} x {level.shape[1]} points: a gap of "
                f"{result.complementarity:.2g} rms heights was left, with tolerance = {tolerance:.2g}; ",
                code="not-converged",
                remedy=Remedy("allow more products (most_products=).", fewer, fewer, fewer),
            )
        return result, Work(
            products=level.products,
            ffts=ffts,
            single_ffts=level.single.ffts if level.single.precision is np.float32 else 0,
            splitting_steps=level.splitting_steps,
            set_changes=level.set_changes,
            linear_iterations=level.linear_iterations,
            grids=tuple(grids),
            coarser_pressure=None if coarser is None else coarser.pressure,
        )


def _refined(coarser: ComplementaritySolution, height: Array, level: OneGrid) -> NDArray[Any]:
    """Interpolate pressures less gaps over ρ of a coarser grid, whose heights are given; in precision of corrections.

    Pressure and gap have a kink at the edges of the contact; p − gap/ρ is smooth there.
    """
    signed = np.empty(height.shape, level.single.precision)

    def subtract(signed: NDArray[Any], pressure: Array, displacement: Array, height: Array) -> None:
        gap = np.maximum(displacement + height - coarser.indentation, 0.0)
        signed[...] = np.where(pressure > 0.0, pressure, gap / -level.quick_rho)

    in_parts(subtract, signed, coarser.pressure, coarser.displacement, height)
    return interpolated(signed, level.shape)
