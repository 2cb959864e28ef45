"""Derivatives of the friction coefficient on cells that move with the contact, whose edges stay where they are in them.

Where in its cell an edge lies is a matter of luck, and the friction coefficient of a grid depends on it a little.  A
derivative on cells that stay where they are differentiates that luck too: of an error ε that changes from cell to cell
it makes ε a/h.  Cells that grow and shift with the contact do not.  With a change θ of the material or the load,

    dμ/dθ = ∂μ/∂θ + (∂ ln a/∂θ) ∂μ/∂ ln h + (∂s/∂θ) ∂μ/∂s,

∂μ/∂ ln h and ∂μ/∂s being what it does to the solution on a grid to stretch the cells about the axis and to shift them.
Both are nothing but error, and go to zero with the cells, so that how the contact grows and where it goes need not be
known well: the spread of the pressure along the motion and its centre tell, on a coarse grid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.derivatives.adjoint import friction_adjoint, mean_gradient
from viscofric.contact.free.balance import CUTS, lag

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.derivatives.adjoint import Gradient, Way
    from viscofric.contact.free.problem import Stage

    Array: TypeAlias = NDArray[np.float64]

# Part of itself, or of a cell, by which the grid is stretched and shifted: rounding and curvature both cost 1e-5.
_STEP = 1e-5


@dataclass(frozen=True)
class Motion:
    """How a contact changes with its material and its load.

    Attributes
    ----------
    growth : Gradient
        Of the logarithm of its length along the motion.
    shift : Gradient
        Of its place, beyond what growing about the axis does.
    """

    growth: Gradient
    shift: Gradient

    @classmethod
    def of(cls, stage: Stage) -> Motion:
        """Tell from the centre and the spread of the pressure on a grid.

        Raises
        ------
        ConvergenceError
            If an adjoint problem is not solved.
        """
        x = np.broadcast_to(stage.window.x[:, None], stage.window.shape)
        centre, by_centre = mean_gradient(stage, x)
        spread, by_spread = mean_gradient(stage, (x - centre) ** 2)
        growth = by_spread.plus(by_spread, 0.5 / spread - 1.0)
        return cls(growth, by_centre.plus(growth, -centre))


def friction_gradient(stage: Stage, way: Way, motion: Motion | None) -> Gradient:
    """Differentiate the friction coefficient on one grid.

    Parameters
    ----------
    stage : Stage
    way : {"pressure", "balance", "energy"}
        As of `viscofric.contact.derivatives.adjoint.friction_adjoint`.
    motion : Motion or None
        With which cells move; they stay without, as they must for "energy", which is for indenters with walls.

    Raises
    ------
    ConvergenceError
        If the adjoint problem is not solved.
    """
    gradient, field, by_load = friction_adjoint(stage, way)
    if motion is None:
        return gradient
    start = _friction_on(stage, way, field)
    # The load is held, so that on larger cells the pressures add up to less.
    stretched = _friction_on(stage, way, field, stretch=1.0 + _STEP) - start
    by_stretch = stretched / _STEP - stage.problem.geometry.dimension * by_load
    by_shift = (_friction_on(stage, way, field, shift=_STEP) - start) / (_STEP * stage.window.spacing)
    if not math.isfinite(by_stretch + by_shift):
        return gradient  # the grid's last step leads beyond a height map's edge
    return gradient.plus(motion.growth, by_stretch).plus(motion.shift, by_shift)


def _friction_on(stage: Stage, way: Way, field: Array, *, stretch: float = 1.0, shift: float = 0.0) -> float:
    """Friction coefficient of the same pressures on cells elsewhere, less what λ makes of the gap there."""
    window, problem, pressure, operator = stage.window, stage.problem, stage.result.pressure, stage.operator
    if stretch != 1.0:
        window = replace(window, spacing=stretch * window.spacing)
        operator = problem.geometry.operator(window, operator.material, operator.shift, problem.backend)
    x = window.x + shift * window.spacing
    height = problem.shape.height((x - operator.shift * window.spacing)[:, None], window.y)
    gap = operator.backend.to_numpy(operator(pressure)) + height
    known = field != 0.0
    value = -float(np.vdot(field[known], gap[known]))
    total = float(pressure.sum())
    if way == "pressure":
        return value + float(np.vdot(pressure, problem.shape.slope(x[:, None], window.y))) / total
    force = operator.bent_dissipated_force(pressure) / (window.cell_area * total)
    # Gaps are in λ already; what is left out goes with the inverse square of the cell.
    return value + force + lag(operator.material, window.spacing, CUTS[1]) * stage.opening / stretch**2
