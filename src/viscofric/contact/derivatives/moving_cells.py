"""Derivatives of the friction coefficient on cells that move with the contact: its edges are fixed within their cells.

The position of an edge within its cell is random, and the friction coefficient of a grid depends on it a little.  A
derivative on fixed cells includes this random part: an error ε that changes from cell to cell becomes ε a/h.  Cells
that grow and shift with the contact avoid it.  With a change θ of the material or the load,

    dμ/dθ = ∂μ/∂θ + (∂ ln a/∂θ) ∂μ/∂ ln h + (∂s/∂θ) ∂μ/∂s,

∂μ/∂ ln h and ∂μ/∂s being the effects of stretching the cells about the axis and of shifting them on the solution on a
grid.  Both are discretisation errors, and vanish with the cells, so that growth and shift of the contact need not be
accurate: they follow from the spread of the pressure along the motion and its centre, on a coarse grid.

A tip, where the slope jumps, is such an edge too, and must be fixed within its cells as well: it lies on the axis, so
that the cells of an indenter with a tip grow about the axis but do not shift.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.derivatives.adjoint import Gradient, friction_adjoint, mean_gradients
from viscofric.contact.free.estimates import Way
from viscofric.contact.free.stage import Stage

# Part of itself, or of a cell, by which the grid is stretched and shifted: rounding and curvature both cost 1e-5.
_STEP = 1e-5


@dataclass(frozen=True)
class Motion:
    """Growth and shift of a contact with its material and its load."""

    growth: Gradient  # of the logarithm of its length along the motion
    shift: Gradient  # of its position, beyond the effect of growth about the axis

    @classmethod
    def of(cls, stage: Stage) -> Motion:
        """Return the motion found from the centre and the spread of the pressure on a grid.

        Raises ConvergenceError if an adjoint problem is not solved.
        """
        pressure = stage.result.pressure
        x = np.broadcast_to(stage.window.x[:, None], stage.window.shape)
        centre = float(np.vdot(x, pressure)) / float(pressure.sum())
        square = (x - centre) ** 2
        spread = float(np.vdot(square, pressure)) / float(pressure.sum())
        by_centre, by_spread = mean_gradients(stage, [x, square])
        growth = by_spread.plus(by_spread, 0.5 / spread - 1.0)
        shift = by_centre.plus(growth, -centre)
        return cls(growth, shift.plus(shift, -1.0) if stage.problem.shape.has_tip else shift)


def friction_gradient(stage: Stage, way: Way, motion: Motion) -> tuple[Gradient, Gradient]:
    """Differentiate the friction coefficient on one grid whose cells move, and on fixed cells.

    `way` is that of `viscofric.contact.derivatives.adjoint.friction_adjoint`, `motion` that of the cells.  Raises
    ConvergenceError if the adjoint problem is not solved.
    """
    gradient, field, by_load = friction_adjoint(stage, way)
    # The load is fixed, so that on larger cells the sum of the pressures is smaller.
    by_stretch = _stretched(stage, way, field, gradient) - stage.problem.geometry.dimension * by_load
    by_shift = _elsewhere(stage, way, field, shift=_STEP) / stage.window.spacing
    if not math.isfinite(by_stretch + by_shift):
        return gradient, gradient  # the grid's last step leads beyond a height map's edge
    return gradient.plus(motion.growth, by_stretch).plus(motion.shift, by_shift), gradient


def _stretched(stage: Stage, way: Way, field: Array, gradient: Gradient) -> float:
    """Change with ln h of the friction coefficient of the same pressures, less what λ makes of the gap.

    Displacements go with the cell's length times a function of memory lengths, and of a layer's thickness, over it: to
    stretch the cells is to shorten the memories.
    """
    operator, pressure = stage.operator, stage.result.pressure
    shortened = float(gradient.memory_lengths @ operator.material.memory_lengths)
    known = field != 0.0
    change = _elsewhere(stage, way, field, stretch=1.0 + _STEP) - shortened
    change -= float(np.vdot(field[known], stage.result.displacement[known]))
    layer = stage.problem.layer
    if way == "balance":
        # Gaps are in λ already; what is left out goes with Λ, which is a length, and the inverse square of the cell.
        change -= stage.lag * stage.opening
    if layer is None:
        return change
    thicker = replace(operator, layer=replace(layer, thickness=(1.0 + _STEP) * layer.thickness))  # type: ignore[call-arg]
    displacement = operator.backend.to_numpy(thicker(pressure)) - stage.result.displacement
    thickened = -float(np.vdot(field[known], displacement[known]))
    if way == "balance":
        force = thicker.dissipated_force(pressure) - operator.dissipated_force(pressure)
        thickened += force / (stage.window.cell_area * float(pressure.sum()))
    return change - thickened / _STEP


def _elsewhere(stage: Stage, way: Way, field: Array, *, stretch: float = 1.0, shift: float = 0.0) -> float:
    """Change per step of what the indenter's height on cells elsewhere makes of the same number."""
    window, shape, pressure = stage.window, stage.problem.shape, stage.result.pressure
    there = replace(window, spacing=stretch * window.spacing)
    x, y = there.x + shift * window.spacing, there.y
    known = field != 0.0
    behind = stage.operator.shift * there.spacing
    risen = shape.height((x - behind)[:, None], y)[known] - stage.problem.height_on(window, stage.operator.shift)[known]
    change = -float(np.vdot(field[known], risen))
    if way == "pressure":
        steeper = shape.slope(x[:, None], y) - shape.slope(window.x[:, None], window.y)
        change += float(np.vdot(pressure, steeper)) / float(pressure.sum())
    return change / _STEP
