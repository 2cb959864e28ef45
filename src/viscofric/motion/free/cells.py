"""Cells of one grid that are fixed to the body, and the contact problem of one step on those around the indenter."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.contact.complementarity import ComplementaritySolution
from viscofric.contact.free.grids import Grid
from viscofric.contact.operators.convolution import SteadyMaterial, solve_on_cells
from viscofric.errors import ConvergenceError
from viscofric.motion.free.box import Box
from viscofric.motion.free.response import Response, StepOperator
from viscofric.motion.free.setting import Setting
from viscofric.motion.free.state import Place
from viscofric.motion.schedule import Instant

# Space by which a window is widened where the contact comes so many cells near its edge, as a part; how many times.
_WIDER, _LEAST_MARGIN, _MOST_WINDOWS = 0.2, 2, 30
# Operators that are kept; limits of the solver.
_KEPT, _PATIENCE, _MOST_PRODUCTS = 8, 40, 2000
_OF_UNIT_COMPLIANCE = SteadyMaterial(1.0, np.empty(0), np.empty(0))


@dataclass(eq=False)
class Cells:
    """The cells, and the contact problem on a window of them."""

    setting: Setting
    grid: Grid  # the window that is tried first; it becomes wider where the contact is
    # Of the contact conditions, in the depth that the unit of pressure causes in a step: the change of the pressure by
    # a gap that is left grows with the stiffness of the body in the step, and the memory keeps it.
    tolerance: float
    products: int = field(default=0, init=False)
    _operators: dict[tuple[tuple[int, int], float], StepOperator] = field(default_factory=dict, init=False)
    response: Response = field(init=False)
    facing: Response | None = field(init=False)

    def __post_init__(self) -> None:
        self.response, self.facing = self.setting.responses(self.grid)

    def placed(self, instant: Instant) -> Place:
        """Return the place of an indenter on the lattice."""
        along, across = self.setting.turned(instant.position)
        i, j = round(along / self.grid.spacing), round(across / self.grid.width)
        return Place(i, j, along - i * self.grid.spacing, across - j * self.grid.width)

    def window(self, place: Place) -> Box:
        """Return the cells around a place."""
        nx, ny = self.grid.shape
        beside = ny // 2
        return Box(place.i - self.grid.behind, place.j - beside, nx, ny)

    def height(self, place: Place) -> Array:
        """Return the height of the indenter over the cells around it."""
        return self.setting.shape.height(self.grid.x[:, None] - place.x, self.grid.y - place.y)

    def force(self, pressure: Array, remembered: Array) -> tuple[float, float]:
        """Return the friction force along and across the lattice, −∫ p ∇u dA."""
        # Only what the body remembers counts, the displacement `remembered`: that under the pressure itself does no
        # work when it is moved along, whatever the place of the contact's edges in their cells.
        cell = self.grid.cell_area
        along = np.gradient(remembered, self.grid.spacing, axis=0)
        across = np.gradient(remembered, self.grid.width, axis=1) if pressure.shape[1] > 1 else np.zeros_like(pressure)
        return -cell * float(np.vdot(pressure, along)), -cell * float(np.vdot(pressure, across))

    def solved(
        self, compliance: float, shape: Array, load: float | None, depth: float | None, guess: Array
    ) -> tuple[tuple[Array, float, float], ComplementaritySolution | None]:
        """Return pressure, its compliance and the depth, on the present window."""
        whole = compliance if self.facing is not None else compliance + self.setting.body.counterface
        if load is not None and load <= 0.0:
            return (np.zeros(self.grid.shape), whole, float(shape.min())), None
        operator = self._operator(self.setting.body.counterface / compliance if self.facing is not None else 0.0)
        found = solve_on_cells(
            operator, shape / whole, None if load is None else load / self.grid.cell_area,
            np.where(np.isfinite(shape), guess, 0.0),
            indentation=None if depth is None else depth / whole,
            tolerance=self.tolerance, depth=1.0, most_products=_MOST_PRODUCTS, patience=_PATIENCE,
        )  # fmt: skip
        self.products += found.products
        if not found.converged:
            raise ConvergenceError(
                f"a step did not converge on {self.grid.shape[0]} x {self.grid.shape[1]} cells: a gap of "
                f"{found.complementarity * whole:.1e} of the indentation was left.",
                code="not-converged",
            )
        return (np.asarray(found.pressure), whole, whole * found.indentation), found

    def _operator(self, share: float) -> StepOperator:
        key = (self.grid.shape, share)
        if key not in self._operators:
            if len(self._operators) > _KEPT:
                self._operators.clear()
            quarter = self.response.quarter(*self.grid.shape)
            if self.facing is not None:
                quarter = quarter + share * self.facing.quarter(*self.grid.shape)
            self._operators[key] = StepOperator(self.grid, _OF_UNIT_COMPLIANCE, quarter=quarter)
        return self._operators[key]

    def attempts(self) -> Iterator[int]:
        """Count attempts to solve in windows that become wider; ConvergenceError after too many."""
        yield from range(_MOST_WINDOWS)
        shape = " x ".join(map(str, self.grid.shape))
        raise ConvergenceError(
            f"no window of up to {shape} cells holds the contact; it may be too slender for a contact over time.",
            code="no-window",
        )

    def widened(self, loaded: Mask) -> bool:
        """Widen the window where the contact comes near its edges; return whether it did."""
        margin = min(_LEAST_MARGIN, min(loaded.shape) // 4)
        rows, columns = np.asarray(loaded.any(axis=1)), np.asarray(loaded.any(axis=0))
        behind, ahead = bool(rows[: margin + 1].any()), bool(rows[-margin - 1 :].any())
        more = math.ceil(_WIDER * len(rows))
        grid = replace(self.grid, behind=self.grid.behind + more * behind, ahead=self.grid.ahead + more * ahead)
        if not grid.is_strip and (columns[: margin + 1].any() or columns[-margin - 1 :].any()):
            grid = replace(grid, beside=grid.beside + math.ceil(0.5 * _WIDER * len(columns)))
        changed = grid != self.grid
        self.grid = grid
        return changed
