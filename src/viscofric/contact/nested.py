"""Nested grids: the window found on a coarse one, then cells halved until the friction is known well enough.

Everything here is in units of the Hertz contact at E0 (lengths a0, depths a0²/R, load 4/3), so that neither the
user's units nor his material's modulus matter.
"""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

import numpy as np

from viscofric.contact.complementarity import ComplementaritySolution, solve_complementarity
from viscofric.contact.grids import Window, touches_edge
from viscofric.contact.operator import HalfSpaceOperator, SteadyMaterial, collocation_shift
from viscofric.errors import ConvergenceError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

logger = logging.getLogger(__name__)

LOAD = 4.0 / 3.0
COARSEST = 32  # cells along the longer edge of the window on the coarsest grid
FEWEST_GRIDS = 3  # one change alone may be small by chance
MARGIN = 0.15  # free space left around the contact, relative to its size
#: Friction is resolved relative to its own value, but not below this fraction of a0/R.
FRICTION_FLOOR = 1e-6

# Step of the continuation in the glassy compliance, which leads into the hard corner (one mode, E∞ >> E0).
_CONTINUATION = 1.4
_EASY_GLASSY = 0.1
_LONGEST_CONTINUATION = 64
_LARGEST_CONTINUATION_GRID = 160  # cells: beyond, a failure is final, since a continuation would take hours
_MOST_WINDOWS = 20
_MOST_RESTARTS = 5
_NO_WINDOW = "no window was found that holds the contact; the indenter may be too blunt."


class Shape(Protocol):
    """An indenter, in these units."""

    def height(self, x: Array, y: Array) -> Array:
        """Height above the lowest point."""

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is to be solved on every grid: a solid, an indenter, and how exactly the contact conditions hold."""

    solid: SteadyMaterial
    shape: Shape
    tolerance: float


@dataclass(frozen=True, eq=False)
class Stage:
    """A converged solution on one grid."""

    problem: Problem
    window: Window
    operator: HalfSpaceOperator
    result: ComplementaritySolution

    @cached_property
    def pressure_friction(self) -> float:
        """Friction coefficient from the lean of the pressure, ∫ p ∂h/∂x dA / F."""
        slope = self.problem.shape.slope(self.window.x[:, None], self.window.y)
        return self.window.cell_area * float(np.vdot(self.result.pressure, slope)) / LOAD

    @cached_property
    def energy_friction(self) -> float:
        """Friction coefficient from the dissipated energy."""
        return self.operator.dissipated_force(self.result.pressure) / LOAD

    @property
    def displacement(self) -> Array:
        """Displacement at the cell centres, wherever the gap was looked at."""
        if self.operator.shift == 0.0:
            return self.result.displacement
        return HalfSpaceOperator(self.window, self.operator.material)(self.result.pressure)


class Estimate(NamedTuple):
    """A number and the error that its changes from grid to grid let expect."""

    value: float
    error: float

    @property
    def relative_error(self) -> float:
        """Error relative to the value, or to `FRICTION_FLOOR` for smaller ones."""
        return self.error / max(abs(self.value), FRICTION_FLOOR)


def friction_estimate(stages: list[Stage]) -> Estimate:
    """Return the friction coefficient from the quantity that has settled best on the nested grids.

    The lean of the pressure settles quickest where friction is large; the dissipated energy where it is small
    against the contact's slope a/R (at low and high speed), because it does not live on a small difference.  At low
    speed its error is of first order in the cell, so that its linear extrapolation is the third candidate.
    """
    if len(stages) < FEWEST_GRIDS:
        return Estimate(stages[-1].pressure_friction, math.inf)
    lean = np.array([stage.pressure_friction for stage in stages])
    energy = np.array([stage.energy_friction for stage in stages])
    candidates = [settled(lean), settled(energy)]
    if len(stages) > FEWEST_GRIDS:
        candidates.append(settled(2.0 * energy[1:] - energy[:-1]))
    best = min(candidates, key=lambda candidate: candidate.error)
    # However well one has settled, part of what the two ways differ by is claimed as error: most where their own
    # errors do not explain the difference, or where the gap is looked at behind the cell centres, since friction
    # then settles more slowly than its changes promise; much on three grids, whose two changes may both be small by
    # chance; little otherwise.
    difference = abs(float(lean[-1] - energy[-1]))
    explained = difference <= candidates[0].error + candidates[1].error and stages[-1].operator.shift == 0.0
    share = 0.5 if not explained else 0.35 if len(stages) == FEWEST_GRIDS else 0.1
    return Estimate(best.value, max(best.error, share * difference))


def settled(values: Array) -> Estimate:
    """Return the last of three or more values on nested grids, with an estimate of its error.

    With changes d1 (the last) and d0 before it, a geometric sequence has d1/(d0/d1 − 1) still to go.  No less than
    d1 is taken, nor than d0/4 and a sixteenth of the one before, since single changes may be small by chance.
    """
    changes = np.abs(np.diff(values))[-3:]
    before, last = changes[-2:]
    ratio = max(before / last, 1.25) if last > 0.0 else math.inf
    faded = changes * 0.25 ** np.arange(len(changes) - 1.0, -1.0, -1.0)
    return Estimate(float(values[-1]), float(max(last / (ratio - 1.0), *faded)))


def refine(first: Stage, accuracy: float, finest: int) -> list[Stage]:
    """Halve the cells until the friction coefficient is known to a relative accuracy.

    Returns
    -------
    list of Stage
        Coarsest first, at least `FEWEST_GRIDS`.

    Raises
    ------
    ConvergenceError
        If a grid does not converge, or the accuracy is not reached with `finest` cells along the longer edge.
    """
    stages, restarts = [first], 0
    while True:
        coarse = stages[-1]
        window = coarse.window.refined()
        if max(window.shape) > finest:
            raise ConvergenceError(
                f"the friction coefficient is known to {friction_estimate(stages).relative_error:.1e} of itself on "
                f"the finest grid allowed ({finest} cells); ask for less accuracy than {accuracy:g} or a finer grid."
            )
        stage = _solve_in_window(window, coarse)
        if touches_edge(stage.result.pressure > 0.0):
            # The coarse contact was a little too small: start again from a window around the finer one.
            if restarts == _MOST_RESTARTS:
                raise ConvergenceError(_NO_WINDOW)
            stages, restarts = [_solve_in_window(_around(stage), stage)], restarts + 1
            continue
        stages.append(stage)
        estimate = friction_estimate(stages)
        logger.debug("grid %s: friction %.6g ± %.1g, %d products", window.shape, *estimate, stage.result.products)
        if estimate.relative_error <= accuracy:
            return stages


def find_window(problem: Problem, modulus: float) -> Stage:
    """Solve on coarse grids until the window fits the contact: nothing cut off, little space wasted.

    Parameters
    ----------
    problem : Problem
    modulus : float
        First guess of the modulus that the contact meets, relative to E0.
    """
    radius = modulus ** (-1.0 / 3.0)
    window = Window.around(1.5 * radius, 1.5 * radius, 1.5 * radius, COARSEST)
    guess = np.sqrt(np.maximum(0.0, 1.0 - (window.x[:, None] ** 2 + window.y**2) / radius**2))
    stage = _solve_on(window, problem, guess)
    for _ in range(_MOST_WINDOWS):
        loaded = stage.result.pressure > 0.0
        if touches_edge(loaded):
            old = stage.window
            size = old.spacing * max(old.shape)
            rear, front, side = old.spacing * old.behind, old.spacing * old.ahead, old.spacing * old.beside
            window = Window.around(rear + 0.3 * size, front + 0.3 * size, side + 0.3 * size, COARSEST)
        else:
            window = _around(stage)
            if window.spacing > 0.8 * stage.window.spacing:
                return stage
        stage = _solve_in_window(window, stage)
    raise ConvergenceError(_NO_WINDOW)


def _around(stage: Stage) -> Window:
    rear, front, side = stage.window.extent(stage.result.pressure > 0.0)
    margin = MARGIN * max(rear + front, 2.0 * side)
    return Window.around(rear + margin, front + margin, side + margin, COARSEST)


def _solve_in_window(window: Window, before: Stage) -> Stage:
    return _solve_on(window, before.problem, before.window.resample(before.result.pressure, window))


def _solve_on(window: Window, problem: Problem, guess: Array) -> Stage:
    """Solve on one grid; where that fails, come from a material with a softer glassy state."""
    solid, tolerance = problem.solid, problem.tolerance
    load = LOAD / window.cell_area

    def attempt(glassy: float, start: Array) -> Stage:
        material = replace(solid, glassy=glassy)
        shift = collocation_shift(material, window.spacing)
        operator = HalfSpaceOperator(window, material, shift)
        x = window.x - shift * window.spacing
        height = problem.shape.height(x[:, None], window.y)
        result = solve_complementarity(operator, height, load, start, tolerance=tolerance)
        return Stage(problem, window, operator, result)

    stage = attempt(solid.glassy, guess)
    if stage.result.converged:
        return stage
    failed = stage
    steps = _LONGEST_CONTINUATION if max(window.shape) <= _LARGEST_CONTINUATION_GRID else 0
    glassy, factor, good = max(_EASY_GLASSY, solid.glassy), _CONTINUATION, guess
    for _ in range(steps):
        stage = attempt(glassy, good)
        if stage.result.converged:
            if glassy <= solid.glassy:
                return stage
            good = stage.result.pressure
            glassy = max(solid.glassy, glassy / factor)
        elif glassy >= _EASY_GLASSY:
            break
        else:
            factor = math.sqrt(factor)
            glassy *= factor
    raise ConvergenceError(
        f"the contact did not converge on a grid of {window.shape[0]} x {window.shape[1]} cells: a gap of "
        f"{failed.result.complementarity:.1e} of the indentation was left where {tolerance:.0e} was asked for; ask for "
        "less accuracy of the friction, which needs a coarser grid."
    )
