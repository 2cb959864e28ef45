"""Nested grids: the window found on a coarse one, then cells halved until the friction is known well enough.

Everything here is in units of the Hertz contact at E0 (lengths a0, depths a0²/R; see `viscofric.contact.scale`), so
that neither the user's units nor his material's modulus matter.  Whether it is a point or a line contact, and whether
the load or the indentation is given, is a part of the problem.
"""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.estimates import friction_estimate
from viscofric.contact.given_grid import COARSEST, GivenGrid
from viscofric.contact.operator import collocation_shift
from viscofric.contact.problem import Problem, Stage
from viscofric.errors import ConvergenceError, InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.contact.grids import Grid

    Array: TypeAlias = NDArray[np.float64]

logger = logging.getLogger(__name__)

MARGIN = 0.15  # free space left around the contact, relative to its size

# Step of the continuation in the glassy compliance, which leads into the hard corner (one mode, E∞ >> E0).
_CONTINUATION = 1.4
_EASY_GLASSY = 0.1
_GROWTH = 1.15
_LONGEST_CONTINUATION = 100
_PATIENCE = 8  # looks at the contact set without headway that end one step's attempt
# A contact n times longer than wide has n/2 times the cells along it, up to so many times.
_MOST_SLENDER = 4
# A contact that is wider than long has cells as slender as half of that, in powers of two up to this one.
_WIDE, _WIDEST = math.sqrt(2.0), 4
# Of a thin layer the coarsest grid has cells no longer than twice its thickness, if that takes no more than so many.
_LAYER_CELLS, _FINEST_START = 0.5, 256
# First windows that are tried, in units of the contact's size as it is guessed.
_FIRST_WINDOWS = (1.0, 2.5, 5.0, 1.6, 0.6)
_MOST_WINDOWS = 20
_MOST_RESTARTS = 5
_NO_WINDOW = "no window was found that holds the contact; the indenter may be too blunt."
_TOUCHES = "window: the contact touches its edge; give one that leaves some space around the contact."


def refine(first: Stage, accuracy: float, finest: int, given: GivenGrid | None = None) -> list[Stage]:
    """Halve the cells until the friction coefficient is known to a relative accuracy, or down to given cells.

    Parameters
    ----------
    first : Stage
        In a window that fits the contact.
    accuracy : float
    finest : int
        Most cells along the window's longer edge.
    given : GivenGrid, optional
        Window that is kept, and cells, with which the accuracy and `finest` do not matter.

    Returns
    -------
    list of Stage
        Coarsest first, at least `FEWEST_GRIDS`.

    Raises
    ------
    ConvergenceError
        If a grid does not converge, or the accuracy is not reached with `finest` cells along the longer edge.
    InputError
        If the contact touches the edge of the window given.
    """
    given = GivenGrid() if given is None else given
    halvings = given.halvings(_coarsest(first.problem))
    stages, restarts = [_start(first, given)], 0
    while True:
        coarse = stages[-1]
        window = coarse.window.refined()
        if given.cells is None and max(window.shape) > finest:
            raise ConvergenceError(
                f"the friction coefficient is known to {friction_estimate(stages).relative_error:.1e} of itself on "
                f"the finest grid allowed ({finest} cells); ask for less accuracy than {accuracy:g} or a finer grid."
            )
        stage = _solve_in_window(window, coarse)
        if window.cuts(stage.result.pressure > 0.0):
            # The coarse contact was a little too small: start again from a window around the finer one.
            if given.window is not None:
                raise InputError(_TOUCHES)
            if restarts == _MOST_RESTARTS:
                raise ConvergenceError(_NO_WINDOW)
            stages, restarts = [_start(_solve_in_window(_around(stage), stage), given)], restarts + 1
            continue
        stages.append(stage)
        estimate = friction_estimate(stages)
        logger.debug("grid %s: friction %.6g ± %.1g, %d products", window.shape, *estimate, stage.result.products)
        if len(stages) > halvings if halvings else estimate.relative_error <= accuracy:
            return stages


def _start(found: Stage, given: GivenGrid) -> Stage:
    """Solve on the coarsest of the grids that lead to the given one; where nothing is given, it is that found."""
    if given.window is None and given.cells is None:
        return found
    kept = found.window.whole if given.window is None else given.window
    aspect = found.window.width / found.window.spacing
    cells = given.start(_coarsest(found.problem))
    stage = _solve_in_window(found.problem.geometry.grid.around(*kept, cells, aspect), found)
    if given.window is not None and stage.window.cuts(stage.result.pressure > 0.0):
        raise InputError(_TOUCHES)
    return stage


def find_window(problem: Problem, size: float) -> Stage:
    """Solve on coarse grids until the window fits the contact: nothing cut off, little space wasted.

    Parameters
    ----------
    problem : Problem
    size : float
        First guess of the contact's radius.

    Raises
    ------
    ConvergenceError
        If no window is found, or no grid converges on the way to it.
    """
    failure = ConvergenceError(_NO_WINDOW)
    for wider in _FIRST_WINDOWS:
        try:
            return _fitted_window(problem, wider * size)
        except ConvergenceError as error:
            # A window that cuts the contact can be harder to solve in than one that holds it.
            failure = error
    raise failure


def _fitted_window(problem: Problem, size: float) -> Stage:
    window = problem.geometry.grid.around(1.5 * size, 1.5 * size, 1.5 * size, _coarsest(problem))
    guess = np.sqrt(np.maximum(0.0, 1.0 - (window.x[:, None] ** 2 + window.y**2) / size**2))
    stage = _solve_on(window, problem, guess)
    for _ in range(_MOST_WINDOWS):
        old = stage.window
        if old.cuts(stage.result.pressure > 0.0):
            wider = old.whole.widened(0.3 * old.spacing * max(old.shape))
            window = problem.geometry.grid.around(*wider, _coarsest(problem))
        else:
            window = _around(stage)
            if window.spacing > 0.8 * old.spacing:
                return stage
        stage = _solve_in_window(window, stage)
    raise ConvergenceError(_NO_WINDOW)


def _coarsest(problem: Problem) -> int:
    """Cells along the longer edge of the coarsest window: so many that they resolve a thin layer, if there is one."""
    cells = COARSEST
    while problem.layer is not None and cells < _FINEST_START:
        spacing = 3.0 * problem.first_size / cells
        if problem.layer.thickness >= _LAYER_CELLS * spacing:
            break
        cells *= 2
    return cells


def _around(stage: Stage) -> Grid:
    contact, grid, cells = stage.extent, stage.problem.geometry.grid, _coarsest(stage.problem)
    length, width = contact.rear + contact.front, 2.0 * contact.side
    if (wide := 0.5 * width / length) > _WIDE:
        # Along the motion much changes within the contact's length, across it little within the same distance.
        margins = contact.widened(MARGIN * length)._replace(side=(1.0 + 2.0 * MARGIN) * contact.side)
        return grid.around(*margins, cells, 2.0 ** min(round(math.log2(wide)), _WIDEST))
    narrow = min(length, width) or contact.longest
    slender = min(_MOST_SLENDER, max(1, int(0.5 * contact.longest / narrow)))
    return grid.around(*contact.widened(MARGIN * contact.longest), cells * slender)


def _solve_in_window(window: Grid, before: Stage) -> Stage:
    return _solve_on(window, before.problem, before.window.resample(before.result.pressure, window))


def _solve_on(window: Grid, problem: Problem, guess: Array) -> Stage:
    """Solve on one grid; where that fails, come from a material with a softer glassy state."""
    solid, geometry = problem.solid, problem.geometry

    def attempt(glassy: float, start: Array, patience: int | None = None) -> Stage:
        material = replace(solid, glassy=glassy)
        shift = collocation_shift(material, window.spacing)
        operator = geometry.operator(window, material, shift, problem.backend)
        height = problem.height_on(window, shift)
        below = np.where(np.isfinite(height), start, 0.0)  # no pressure beyond the indenter's walls
        result = problem.control.solve(operator, height, below, problem.tolerance, patience)
        return Stage(problem, window, operator, result)

    stage = attempt(solid.glassy, guess)
    if stage.result.converged:
        return stage
    # On a large grid a failure is final, since a continuation would take hours.
    small = math.prod(window.shape) <= geometry.finest_continuation**geometry.dimension
    continued = _continued(attempt, guess, solid.glassy) if small else None
    if continued is not None:
        return continued
    raise ConvergenceError(
        f"the contact did not converge on a grid of {window.shape[0]} x {window.shape[1]} cells: a gap of "
        f"{stage.result.complementarity:.1e} of the indentation was left where {problem.tolerance:.0e} was asked for; "
        "ask for less accuracy of the friction, which needs a coarser grid."
    )


def _continued(attempt: Callable[[float, Array, int], Stage], guess: Array, target: float) -> Stage | None:
    """Solve for softer glassy states, step by step down to the one asked for, each from the line through the last two.

    Steps are geometric in the glassy compliance.  They grow a little where they succeed, and are halved where they do
    not.
    """
    path: list[tuple[float, Array]] = []  # logarithms of the compliance, and pressures
    place, end, step = math.log(max(_EASY_GLASSY, target)), math.log(target), math.log(_CONTINUATION)
    for _ in range(_LONGEST_CONTINUATION):
        stage = attempt(target if place <= end else math.exp(place), _ahead(path, place, guess), _PATIENCE)
        if stage.result.converged:
            if place <= end:
                return stage
            path = [*path[-1:], (place, stage.result.pressure)]
            step *= _GROWTH
        elif path:
            step = 0.5 * (path[-1][0] - place)
        else:
            return None
        place = max(end, path[-1][0] - step)
    return None


def _ahead(path: list[tuple[float, Array]], place: float, guess: Array) -> Array:
    """Continue the line through the last two pressures."""
    if len(path) < 2:
        return path[-1][1] if path else guess
    (before, one), (last, other) = path
    return np.maximum(0.0, other + (place - last) / (last - before) * (other - one))
