"""Nested grids: the window found on a coarse one, then cells halved until the friction is known well enough.

Everything here is in units of the Hertz contact at E0 (lengths a0, depths a0²/R; see `viscofric.contact.free.scale`),
so that neither the user's units nor the material's modulus matter.  Whether it is a point or a line contact, and
whether the load or the indentation is given, is a part of the problem.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from viscofric.arguments import check_cost
from viscofric.arrays import Array
from viscofric.contact.free.estimates import FEWEST_GRIDS, LEAST_SHARE, friction_estimate, least_error
from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.free.problem import Problem
from viscofric.contact.free.proximal import proximal_points
from viscofric.contact.free.scale import Scale
from viscofric.contact.free.stage import Stage
from viscofric.contact.operators.convolution import collocation_shift
from viscofric.errors import ConvergenceError, InputError, brief, wrong_argument
from viscofric.units import Quantity, to_si

logger = logging.getLogger(__name__)

# Free space left around the contact, relative to its size, on the coarsest grid and on finer ones; on these at least so
# many cells of the grid before.
MARGIN, _FREE, _FEWEST_FREE = 0.15, 0.05, 2

_PATIENCE = 4  # updates of the contact set without progress that end an attempt
# A contact n times longer than wide has n/2 times the cells along it, up to this many times.
_MOST_SLENDER = 4
# A contact that is wider than long has cells as slender as half of that, in powers of two up to this one.
_WIDE, _WIDEST = math.sqrt(2.0), 4
# The coarsest grid has cells no longer than twice the thickness of a thin layer, if this many cells are sufficient.
_LAYER_CELLS, _FINEST_START = 0.5, 256
# First windows tried, in units of the guess of the contact's size.
_FIRST_WINDOWS = (1.0, 2.5, 5.0, 1.6, 0.6)
_MOST_WINDOWS = 20
# Largest factor by which the error of the friction falls when cells are halved: more than before where they begin to
# resolve a memory or a layer.
_LEAST_FALL, _FALL = 5.0, 8.0
_MOST_RESTARTS = 5
_NO_WINDOW = "no window was found that holds the contact; the indenter may be too blunt."
_TOUCHES = "window: the contact touches its edge; give one that leaves some space around the contact."


def refine(first: Stage, accuracy: float, finest: int, given: GivenGrid | None = None) -> list[Stage]:
    """Halve the cells until the friction coefficient has a relative accuracy, or down to given cells; coarsest first.

    `first` is in a window that fits the contact; `finest` is the largest number of cells along its longer edge; a
    `given` window is kept, and with given cells neither the accuracy nor `finest` counts.  Returns at least
    `FEWEST_GRIDS` stages; those before the last of them may be solved to `Problem.coarse_tolerance` only.

    Raises ConvergenceError if a grid does not converge, the accuracy is not reached with `finest` cells along the
    longer edge or, by the errors so far, cannot be, or the friction is not a number; InputError if the contact touches
    the edge of the window given.
    """
    given = GivenGrid() if given is None else given
    halvings = given.halvings(_coarsest(first.problem))
    stages, restarts, goal = [_start(first, given)], 0, _Goal(accuracy, finest)
    while True:
        coarse = stages[-1]
        whole = halvings or given.window is not None or restarts
        window = (coarse.window if whole else _close_to(coarse)).refined()
        if not halvings:
            goal.allow(window, stages)
        try:
            stage = _solve_in_window(window, coarse, last=len(stages) + 1 >= FEWEST_GRIDS)
        except ConvergenceError as failure:
            if halvings or not goal.errors:
                raise
            raise goal.missed("the finest grid that could be solved", max(coarse.window.shape)) from failure
        if window.cuts(stage.result.pressure > 0.0):
            # The coarse contact was a little too small: start again from a window around the finer one.
            if given.window is not None:
                raise InputError(_TOUCHES, code="touches-window")
            if restarts == _MOST_RESTARTS:
                raise ConvergenceError(_NO_WINDOW, code="no-window")
            stages, restarts = [_start(_solve_in_window(_around(stage), stage), given)], restarts + 1
            goal = _Goal(accuracy, finest)
            continue
        stages.append(stage)
        error = _logged_error(stages)
        if len(stages) > halvings if halvings else error <= accuracy:
            return stages
        if len(stages) >= FEWEST_GRIDS:
            goal.errors.append(error)


def _logged_error(stages: list[Stage]) -> float:
    """Log the result on the last grid, and return the relative error of the friction."""
    estimate, (length, width) = friction_estimate(stages), stages[-1].window.shape
    if math.isnan(estimate.value) or math.isnan(estimate.error):
        raise ConvergenceError(
            f"the friction coefficient on a grid of {length} x {width} cells is not a number.", code="not-finite"
        )
    message = "grid of %d x %d cells: friction coefficient %.6g, known to %.1g of itself, %d products"
    products = stages[-1].result.products
    logger.info(message, length, width, estimate.value, estimate.relative_error, products)
    return estimate.relative_error


@dataclass
class _Goal:
    """Accuracy to be reached, and the errors of the friction so far, from the first grid with an estimate."""

    accuracy: float
    finest: int
    errors: list[float] = field(default_factory=list)

    def allow(self, window: Grid, stages: list[Stage]) -> None:
        """Raise ConvergenceError where a grid is too fine, or the accuracy cannot be reached even on the finest."""
        cells = max(window.shape)
        if cells > self.finest:
            raise self.missed(f"the finest grid allowed ({self.finest} cells)", self.finest)
        halvings = 1 + int(math.log2(self.finest / cells))
        if self.errors and max(self._expected_error(halvings), least_error(stages, halvings)) > self.accuracy:
            words = f"a grid of {cells // 2} cells, and {self.finest} cells will not be enough"
            raise self.missed(words, cells // 2)

    def missed(self, where: str, cells: int) -> ConvergenceError:
        """Return the error to raise."""
        known = self.errors[-1] if self.errors else math.inf
        return ConvergenceError(
            f"the relative error of the friction coefficient is {known:.1e} on {where}; request less accuracy than "
            f"{self.accuracy:g}, or a finer grid.",
            code="accuracy-not-reached",
            values={"error": known, "accuracy": self.accuracy, "cells": cells},
        )

    def _expected_error(self, halvings: int) -> float:
        """Return an optimistic error after a number of further halvings of the cells.

        It falls half as much again as at best in the last two steps, and on the fourth grid to what a limit has.
        """
        falls = [before / after for before, after in pairwise(self.errors[-3:])]
        fall = _FALL if len(falls) < 2 else min(_FALL, max(_LEAST_FALL, 1.5 * max(falls)))
        share = LEAST_SHARE if len(self.errors) == 1 else 1.0
        return float(share * self.errors[-1] / fall**halvings)


def _start(found: Stage, given: GivenGrid) -> Stage:
    """Solve on the coarsest of the nested grids of the given one; without a given grid, on the one found."""
    if given.window is None and given.cells is None:
        return found
    kept = found.window.whole if given.window is None else given.window
    aspect = found.window.width / found.window.spacing
    cells = given.start(_coarsest(found.problem))
    stage = _solve_in_window(found.problem.geometry.around(*kept, cells, aspect), found)
    if given.window is not None and stage.window.cuts(stage.result.pressure > 0.0):
        raise InputError(_TOUCHES, code="touches-window")
    return stage


def find_window(problem: Problem, size: float) -> Stage:
    """Solve on coarse grids until the window fits the contact: nothing cut off, little space wasted.

    `size` is a first guess of the contact's radius.  Raises ConvergenceError if no window is found, or no grid
    converges.
    """
    failure = ConvergenceError(_NO_WINDOW, code="no-window")
    for wider in _FIRST_WINDOWS:
        try:
            return _fitted_window(problem, wider * size)
        except ConvergenceError as error:
            # A window that cuts the contact can be harder to solve in than one that holds it.
            failure = error
    raise failure


def _fitted_window(problem: Problem, size: float) -> Stage:
    window = problem.geometry.around(1.5 * size, 1.5 * size, 1.5 * size, _coarsest(problem))
    guess = np.sqrt(np.maximum(0.0, 1.0 - (window.x[:, None] ** 2 + window.y**2) / size**2))
    stage = _touching(solve_on(window, problem, guess))
    for _ in range(_MOST_WINDOWS):
        old = stage.window
        if old.cuts(stage.result.pressure > 0.0):
            wider = old.whole.widened(0.3 * old.spacing * max(old.shape))
            window = problem.geometry.around(*wider, _coarsest(problem))
        else:
            window = _around(stage)
            if window.spacing > 0.8 * old.spacing:
                return stage
        stage = _solve_in_window(window, stage)
    raise ConvergenceError(_NO_WINDOW, code="no-window")


def _coarsest(problem: Problem) -> int:
    """Cells along the longer edge of the coarsest window: so many that they resolve a thin layer, if there is one."""
    cells = problem.coarsest
    while problem.layer is not None and cells < _FINEST_START:
        spacing = 3.0 * problem.first_size / cells
        if problem.layer.thickness >= _LAYER_CELLS * spacing:
            break
        cells *= 2
    return cells


def _around(stage: Stage) -> Grid:
    contact, geometry, cells = stage.extent, stage.problem.geometry, _coarsest(stage.problem)
    length, width = contact.rear + contact.front, 2.0 * contact.side
    if (wide := 0.5 * width / length) > _WIDE:
        # Along the motion much changes within the contact's length, across it little within the same distance.
        margins = contact.widened(MARGIN * length)._replace(side=(1.0 + 2.0 * MARGIN) * contact.side)
        return geometry.around(*margins, cells, 2.0 ** min(round(math.log2(wide)), _WIDEST))
    narrow = min(length, width) or contact.longest
    slender = min(_MOST_SLENDER, max(1, int(0.5 * contact.longest / narrow)))
    return geometry.around(*contact.widened(MARGIN * contact.longest), cells * slender)


def _close_to(stage: Stage) -> Grid:
    """Return the window with less free space around the contact, whose size is known by now.

    All of it under shapes that may touch elsewhere on finer cells.
    """
    if stage.problem.shape.similar() is None:
        return stage.window
    contact = stage.result.pressure > 0.0
    length = max(np.count_nonzero(contact.any(axis=axis)) for axis in (0, 1))
    return stage.window.trimmed(contact, max(_FEWEST_FREE, math.ceil(_FREE * length)))


def _solve_in_window(window: Grid, before: Stage, *, last: bool = False) -> Stage:
    guess = before.window.resample(before.result.pressure, window)
    return _touching(solve_on(window, before.problem, guess, last=last))


def _touching(stage: Stage) -> Stage:
    if stage.result.pressure.any():
        return stage
    cells = " x ".join(map(str, stage.window.shape))
    raise ConvergenceError(
        f"the contact is narrower than a cell of a grid of {cells} cells; the indenter may be too slender, or the "
        "window too large.",
        code="no-window",
    )


def solve_on(window: Grid, problem: Problem, guess: Array, *, last: bool = False) -> Stage:
    """Solve on one grid: by the active set, and where that makes no progress, by proximal points.

    `last` says whether it may be the last one.  A contact narrower than a cell may have no pressure.
    """
    tolerance = problem.tolerance if last else max(problem.tolerance, problem.coarse_tolerance)
    shift = collocation_shift(problem.solid, window.spacing)
    operator = problem.geometry.operator(window, problem.solid, shift, problem.backend)
    height = problem.height_on(window, shift)
    start = np.where(np.isfinite(height), guess, 0.0)  # no pressure beyond the indenter's walls
    result = problem.control.solve(operator, height, start, tolerance, _PATIENCE)
    if not result.converged:
        result = proximal_points(problem.control, operator, height, result, tolerance)
    if result.converged:
        return Stage(problem, window, operator, result)
    raise ConvergenceError(
        f"the contact did not converge on a grid of {window.shape[0]} x {window.shape[1]} cells: a gap of "
        f"{result.complementarity:.1e} of the indentation was left, with tolerance = {tolerance:.0e}.",
        code="not-converged",
    )


@dataclass(frozen=True)
class GivenGrid:
    """A window and cells that the user gives instead of an accuracy; what is None is found."""

    window: Extent | None = None  # in the units of the problem
    cells: int | None = None  # along the window's longer edge on the finest grid

    @classmethod
    def of(cls, window: Sequence[Quantity] | None, cells: int | None, scale: Scale) -> GivenGrid:
        """Return a user's window (three lengths, m, or two) and cells in the units of the problem."""
        if cells is not None:
            check_cost([cells] * scale.geometry.dimension, f"grid = {brief(cells)}: the window")
        return cls(None if window is None else _extent(window, scale), cells)

    def halvings(self, coarsest: int) -> int:
        """Return the number of halvings from a grid of about so many cells along the longer edge; at least two."""
        return 0 if self.cells is None else max(2, int(math.log2(self.cells / coarsest)))

    def start(self, coarsest: int) -> int:
        """Cells along the window's longer edge of the first grid, where one would start from so many."""
        return coarsest if self.cells is None else math.ceil(self.cells / 2 ** self.halvings(coarsest))

    def check(self, contact: Extent, cell: float, unit: float) -> None:
        """Refuse a window that a contact reaches beyond, as a coarse grid saw it (in the units of the problem)."""
        if self.window is None:
            return
        beyond = [there - edge for there, edge in zip(contact, self.window, strict=True)]
        if max(beyond) > cell:
            rear, front, side = (1e3 * unit * distance for distance in contact)
            sides = f" and {side:.4g} mm to either side" if self.window.side > 0.0 else ""
            raise InputError(
                f"window: the contact reaches about {rear:.4g} mm behind the axis, {front:.4g} mm ahead of it{sides}; "
                "give a window that leaves some space around it.",
                code="beyond-window",
                values={"argument": "window"},
            )


def _extent(window: Sequence[Quantity], scale: Scale) -> Extent:
    names = ("rear", "front", "side")[: scale.geometry.dimension + 1]
    each = list(window) if isinstance(window, (list, tuple)) or np.ndim(window) == 1 else []
    if len(each) != len(names):
        words = f"must be {len(names)} lengths ({', '.join(names)})."
        raise wrong_argument("window", window, words, "not-a-window")
    lengths = [
        to_si(length, "m", f"{name} of the window") / scale.length for length, name in zip(each, names, strict=True)
    ]
    found = Extent(*lengths, *([0.0] if len(lengths) == 2 else []))
    if not (found.rear + found.front > 0.0 and (len(lengths) == 2 or found.side > 0.0)):
        raise InputError(
            f"window = {brief(window)}: is empty; the front must lie ahead of the rear, the sides apart.",
            code="not-a-window",
        )
    return found
