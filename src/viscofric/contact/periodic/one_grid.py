"""The periodic contact on one grid: some splitting, then a contact set chosen anew at every step, or the active set.

Where these fail, slower and robust methods follow.

Everything here is dimensionless: depths in rms heights of the surface, compliances relative to the largest.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.contact.arrays.backend import AnyArray, Backend
from viscofric.contact.complementarity import ComplementaritySolution, solve_complementarity, solve_many_spots
from viscofric.contact.extension import BLOCK, Extension, lag
from viscofric.contact.periodic.blocks import BlockExtension
from viscofric.contact.periodic.operator import PeriodicOperator
from viscofric.contact.periodic.splitting import split_steps

_PATIENCE = 3  # looks at the contact set without a smaller residual before another method takes over
_FEW_DIRECTIONS = (6, 12)  # changes that are kept, for elastic and viscoelastic solids; enough for most contacts
_MANY_DIRECTIONS = 40
# Part of the area in contact up to which the set is chosen anew at every step: the changes that are kept take memory on
# the contact.
_SPARSE = 0.25
# Cells from which on the contact of blocks extends residuals: steps are fewer on smaller grids, too, but not quicker.
_FEWEST_ON_BLOCKS = 2**20
_FEW_PRODUCTS = 120  # of the active set: what it cannot solve with these is left to the splitting
# Residual, in rms heights, from which on the active set continues for as long as it halves it: its set is nearly right.
_NEARLY = 1e-5
_FIRST_STEPS = 3  # of the splitting on each grid
_DOUBT = (1.0, 2.0)  # see `solve_many_spots`, for elastic and viscoelastic solids
_MORE_STEPS = 120  # of the accelerated splitting where the contact set does not converge; then twice as many, and so on
_TURNS = 4  # of it, after which the continuation is tried
# ρ of the splitting over the smallest compliance of a wave, where coarser grids have settled the long waves.
_SHORT_WAVES = (2.7, 6.5)
_ALL_WAVES = (0.2, 1.0)  # otherwise, in turn, over the geometric mean of the smallest and the largest
_GROWTH = 2.0  # of the splitting's steps from round to round
# Of the continuation through softer contacts: the part of the relaxed compliance that is added first; the largest and
# the least factor from one added compliance to the next, and how much longer its logarithm grows after a success;
# the tolerance and the products of each intermediate contact; the part of the least compliance of any wave below which
# nothing is added.
_ADDED_FIRST, _ADDED_LAST = 0.3, 0.3
_FACTOR, _LEAST_FACTOR, _LONGER = 1.8, 1.02, 1.3
_SOFTER_TOLERANCE, _SOFTER_PRODUCTS = 1e-4, 300


@dataclass(frozen=True)
class Stage:
    """The contact problem on one of the nested grids."""

    height: Array  # (nx, ny), above the lowest point
    transfer: NDArray[Any]  # (nx, ny//2 + 1)
    # real transfer function of an elastic solid of the same geometry, with the same largest value
    relaxed: Callable[[], Array]
    toward: tuple[float, float]  # direction of the motion, in cells along x and y


class OneGrid:
    """One grid: its operators, and the work that they have done."""

    def __init__(
        self,
        stage: Stage,
        mean_pressure: float | None,
        gap: float | None,
        tolerance: float,
        most_products: int,
        backend: Backend,
    ) -> None:
        self.backend = backend
        self.height = backend.asarray(stage.height)
        self.mean_height = float(stage.height.mean())
        self.shape: tuple[int, int] = stage.height.shape
        self.cells = math.prod(self.shape)
        self.exact = PeriodicOperator(stage.transfer, self.shape, backend=backend)
        self.single = self.exact.for_corrections()
        self.stage = stage
        self.elastic = not np.iscomplexobj(stage.transfer)
        self.load = None if mean_pressure is None else mean_pressure * self.cells
        self.indentation = None if gap is None else self.mean_height - gap
        self.extension = self._extension()
        self.tolerance = tolerance
        self.most_products = most_products
        self.splitting_steps = self.set_changes = self.linear_iterations = 0

    def solve(self, guess: AnyArray | None) -> ComplementaritySolution:
        """Solve from pressures less gaps over `quick_rho`, or from nothing."""
        loaded = self.cells if guess is None else self._loaded(guess)
        full = self._full_contact() if loaded > 0.9 * self.cells else None
        if full is not None:
            return full
        known = guess is not None and loaded > 0
        # These find most of the contact set, and cost half of a step of the next method each.
        kind = 0 if self.elastic else 1
        guess = guess if known else self._first_guess()
        pressure = self._split(self.single, guess, _FIRST_STEPS, self.quick_rho, less_gap=known)
        del guess
        start, result, few = pressure, None, _FEW_DIRECTIONS[kind]
        if self._loaded(pressure) <= _SPARSE * self.cells:
            result = self._many_spots(pressure, few)
        if result is None or (not result.converged and self.products < self.most_products):
            found = pressure if result is None else result.pressure
            result = self._active_set(found, 2 * _PATIENCE, _FEW_PRODUCTS, few)
        steps, turn = _MORE_STEPS, 0
        while not result.converged and self.products < self.most_products:
            if turn == _TURNS and not self.elastic:
                allowed = (self.most_products - self.products) // 2
                found, start = continued(self.exact, self.stage.relaxed(), start, self._tight_active_set, allowed)
                if found is not None:
                    return found
            # Not from the active set's result: the splitting converges only along its own steps.
            turn += 1
            allowed = min(steps, self.most_products - self.products)
            start = self._split(self.exact, start, allowed, self.rho(_ALL_WAVES[turn % 2]), accelerated=True)
            result = self._many_spots(start, _MANY_DIRECTIONS)
            if not result.converged and self.products < self.most_products:
                result = self._active_set(start, _PATIENCE, allowed // 4, _MANY_DIRECTIONS)
            steps = int(_GROWTH * steps)
        return result

    def _extension(self) -> Extension:
        stage = self.stage
        late = lag(stage.transfer, self.shape[1], stage.toward)
        if self.cells >= _FEWEST_ON_BLOCKS and not any(points % BLOCK for points in self.shape):
            return BlockExtension(self.single, stage.toward, late, fixed_load=self.load is not None)
        return Extension(self.backend, self.shape, self.single.dtype, stage.toward, late, inverse=self.single.inverse)

    @property
    def quick_rho(self) -> float:
        """ρ of the splitting for which short waves converge in a few steps."""
        return _SHORT_WAVES[0 if self.elastic else 1] * self.exact.compliance_range[0]

    def rho(self, stiffness: float) -> float:
        """ρ of the splitting that is so many times the geometric mean of the smallest and the largest compliance."""
        return stiffness * math.sqrt(math.prod(self.exact.compliance_range))

    @property
    def products(self) -> int:
        """Products with the transfer function so far."""
        return self.exact.products + self.single.products

    def _active_set(self, pressure: AnyArray, patience: int, most: int, directions: int) -> ComplementaritySolution:
        result = self._few_sets(pressure, patience, most, directions)
        residual = math.inf
        while not result.converged and result.complementarity < min(_NEARLY, 0.5 * residual):
            if self.products >= self.most_products:
                break
            residual = result.complementarity
            result = self._few_sets(result.pressure, patience, most, directions)
        return result

    def _few_sets(self, pressure: AnyArray, patience: int, most: int, directions: int) -> ComplementaritySolution:
        result = solve_complementarity(
            self.exact,
            self.height,
            self.load,
            pressure,
            most_products=max(min(most, self.most_products - self.products), 1),
            depth=1.0,
            patience=patience,
            tighten="near the end",
            directions=directions,
            **self._asked,
        )
        return self._counted(result)

    def _many_spots(self, pressure: AnyArray, directions: int) -> ComplementaritySolution:
        result = solve_many_spots(
            self.exact,
            self.height,
            self.load,
            pressure,
            most_products=self.most_products - self.products,
            patience=_PATIENCE,
            directions=directions,
            **self._asked,
        )
        return self._counted(result)

    @property
    def _asked(self) -> dict[str, Any]:
        """What both methods that choose a contact set are asked."""
        return {
            "indentation": self.indentation,
            "tolerance": self.tolerance,
            "inner": self.single,
            "extension": self.extension,
            "doubt": _DOUBT[0 if self.elastic else 1],
        }

    def _tight_active_set(
        self, operator: PeriodicOperator, pressure: AnyArray, tolerance: float | None, most: int
    ) -> ComplementaritySolution:
        result = solve_complementarity(
            operator,
            self.height,
            self.load,
            pressure,
            indentation=self.indentation,
            tolerance=self.tolerance if tolerance is None else tolerance,
            most_products=most,
            depth=1.0,
            patience=2 * _PATIENCE,
        )
        return self._counted(result)

    def _counted(self, result: ComplementaritySolution) -> ComplementaritySolution:
        self.set_changes += result.set_changes
        self.linear_iterations += result.linear_iterations
        return result

    def _split(
        self, operator: PeriodicOperator, pressure: AnyArray, steps: int, rho: float,
        *, accelerated: bool = False, less_gap: bool = False,
    ) -> AnyArray:  # fmt: skip
        self.splitting_steps += steps
        found = split_steps(
            operator, self.height, pressure, load=self.load, indentation=self.indentation, steps=steps,
            rho=rho, accelerated=accelerated, less_gap=less_gap,
        )  # fmt: skip
        if self._loaded(found):
            return found
        return self.backend.positive_part(self.backend.xp.astype(pressure, self.backend.xp.float64))

    def _loaded(self, pressure: AnyArray) -> int:
        return int(self.backend.xp.count_nonzero(pressure > 0.0))

    def _full_contact(self) -> ComplementaritySolution | None:
        """Return the linear solution if it needs no tension anywhere."""
        if self.load is None:
            return None  # a given mean gap above zero
        xp, mean = self.backend.xp, self.load / self.cells
        level = self.mean_height - self.height
        pressure = self.exact.precondition(level)
        pressure += mean - xp.mean(pressure)
        if float(xp.min(pressure)) < 0.0:
            return None
        displacement = self.exact(pressure)
        error = float(xp.max(xp.abs(displacement - level)))
        return ComplementaritySolution(
            pressure=pressure,
            displacement=displacement,
            indentation=self.mean_height,
            converged=error <= self.tolerance,
            complementarity=error,
            load=abs(float(xp.mean(pressure)) / mean - 1.0),
            set_changes=1,
            linear_iterations=0,
            products=1,
        )

    def _first_guess(self) -> AnyArray:
        """Return the pressure of full contact less what makes it meet the load (or less its mean, for a given gap)."""
        xp = self.backend.xp
        pressure = self.exact.precondition(self.mean_height - self.height)
        if self.load is None:
            return self.backend.positive_part(pressure)
        mean = self.load / self.cells
        low, high = float(xp.min(pressure)) - mean, float(xp.max(pressure))
        for _ in range(60):
            middle = 0.5 * (low + high)
            enough = float(xp.mean(self.backend.positive_part(pressure - middle))) <= mean
            low, high = (low, middle) if enough else (middle, high)
        return self.backend.positive_part(pressure - low)


class Solve(Protocol):
    """Solves a contact with another operator."""

    def __call__(
        self, operator: PeriodicOperator, pressure: AnyArray, tolerance: float | None, most: int, /
    ) -> ComplementaritySolution:
        """Solve from a pressure, to a tolerance or to that of the grid."""


def continued(
    operator: PeriodicOperator, relaxed: Array, pressure: AnyArray, solve: Solve, most_products: int
) -> tuple[ComplementaritySolution | None, AnyArray]:
    """Solve a contact whose operator is nearly skew (one retardation time, a stiff glassy state) by way of softer ones.

    The phase of each wave's response stays well below a right angle with some added elastic compliance, as of a softer
    glassy state; then the active set converges from a rough guess.  The added compliance is reduced to zero in steps,
    each contact starting from the one before.  Where a step fails, a shorter one is tried.

    `operator` is the final one, whose counters increase; `relaxed` (nx, ny//2 + 1) is the elastic transfer function of
    the same geometry, with the same largest value; `pressure` (nx, ny) is the start; no more steps are tried after
    `most_products`.  Returns the solution, None if it did not converge, and the pressure of the last contact that
    converged, otherwise that given.
    """
    transfer = operator.backend.to_numpy(operator.transfer)
    least = float((transfer.real.ravel()[1:] / relaxed.ravel()[1:]).min())
    added, good, step, start = _ADDED_FIRST, _ADDED_FIRST * _FACTOR, math.log(_FACTOR), operator.products
    while True:
        last = added < _ADDED_LAST * least
        softer = transfer if last else transfer + added * relaxed
        soft = operator if last else PeriodicOperator(softer, operator.shape, operator.precision, operator.backend)
        left = max(most_products - (operator.products - start), 1)
        result = solve(
            soft, pressure, None if last else _SOFTER_TOLERANCE, left if last else min(_SOFTER_PRODUCTS, left)
        )
        if soft is not operator:
            operator.products += soft.products
            operator.ffts += soft.ffts
        if result.converged:
            pressure, good = result.pressure, added
            step = min(_LONGER * step, math.log(_FACTOR))
        else:
            step *= 0.5
        if result.converged and last:
            return result, pressure
        if step < math.log(_LEAST_FACTOR) or operator.products - start >= most_products:
            return None, pressure
        added = good * math.exp(-step)
