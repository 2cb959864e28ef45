"""How a contact's friction coefficient changes with its material and its load: one adjoint solve on the contact found.

On the contact set c a small change leaves ``K p − δ = −h``, ``Σ p dA = F`` (or δ given).  With the friction coefficient
a function μ(p) of the pressure, explicitly of the parameters too where it is told by the dissipated energy, the adjoint
field λ on the same cells solves ::

    Kᵀ λ + η = ∂μ/∂p,   Σ λ = 0        for a given load,      dμ = −λᵀ dK p + η dF/dA + (dμ)_p,
    Kᵀ λ     = ∂μ/∂p                   for a given indentation,  dμ = −λᵀ dK p + dδ Σ λ + (dμ)_p,

(dμ)_p the change at fixed pressure.  Kᵀ is the influence mirrored along the motion.  λᵀ dK p = Σ W dK with the
correlation W of λ and p, so that any number of modes costs one pass through their influence coefficients.
At the edges of a contact the pressure is zero, so that the cells that a change wins or loses count for nothing to first
order.  The place where the gap is looked at (`viscofric.contact.operator.collocation_shift`) is held.

M. B. Giles, N. A. Pierce, Flow Turbul. Combust. 65 (2000) 393, on adjoints.

Everything here is in the units of the problem.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np

from viscofric.contact.complementarity import solve_on_contact
from viscofric.contact.control import GivenLoad
from viscofric.contact.estimates import friction_estimate
from viscofric.contact.influence_moments import correlation, memory_moments
from viscofric.contact.line_influence import line_memory_changes, line_memory_influence, strip_potential
from viscofric.contact.line_operator import LineOperator
from viscofric.contact.operator import _SHORT_MEMORY, HalfSpaceOperator
from viscofric.contact.potentials import cell_potential, cell_potential_xx
from viscofric.errors import ConvergenceError, InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.contact.operator import SteadyMaterial
    from viscofric.contact.problem import Stage

    Array: TypeAlias = NDArray[np.float64]

Way: TypeAlias = Literal["pressure", "energy"]

# Residual of the adjoint problem, relative to its right-hand side, and how often it is formed anew on the way.
_TOLERANCE = 1e-8
_MOST_RESTARTS = 20
# Search directions that are kept on the way.
_DIRECTIONS = 40


class Gradient(NamedTuple):
    """Derivatives of the friction coefficient.

    Attributes
    ----------
    glassy : float
        With respect to the compliance without memory.
    compliances, memory_lengths : (m,) array
        With respect to each mode's compliance at fixed glassy compliance, and to its memory length.
    held : float
        With respect to the load or to the indentation, whichever is given.
    """

    glassy: float
    compliances: Array
    memory_lengths: Array
    held: float


def friction_way(stages: list[Stage]) -> Way:
    """Return which expression of the friction coefficient is to be differentiated.

    That which `viscofric.contact.estimates.friction_estimate` trusts.  Where it extrapolates the energy, the energy
    itself: extrapolated, the scatter of derivatives from grid to grid would grow threefold.

    Parameters
    ----------
    stages : list of Stage
        Solutions on nested grids, coarsest first.
    """
    chosen, fine = friction_estimate(stages).value, stages[-1]
    return "pressure" if chosen == fine.pressure_friction else "energy"


def friction_gradient(stage: Stage, way: Way) -> Gradient:
    """Differentiate the friction coefficient on one grid, by the lean of the pressure or by the dissipated energy.

    Parameters
    ----------
    stage : Stage
    way : {"pressure", "energy"}

    Raises
    ------
    ConvergenceError
        If the adjoint problem is not solved.
    InputError
        If the solid is not a half-space.
    """
    operator, window, pressure = stage.operator, stage.window, stage.result.pressure
    if type(operator) not in _CHANGES:
        raise InputError("derivatives = True: known for half-spaces only, not for layers; leave them out.")
    total = float(pressure.sum())
    if way == "pressure":
        value = stage.pressure_friction
        by_pressure = stage.problem.shape.slope(window.x[:, None], window.y) / total
    else:
        value = stage.energy_friction
        by_pressure = operator.dissipated_force_gradient(pressure) / (window.cell_area * total)
    fixed_load = isinstance(stage.problem.control, GivenLoad)
    if not fixed_load:
        by_pressure = by_pressure - value / total
    field, level = _adjoint_field(stage, by_pressure, fixed_load=fixed_load)
    box = _box(pressure > 0.0)
    loaded = pressure[box]
    changes = _CHANGES[type(operator)](
        operator.material,
        window.spacing,
        operator.shift,
        correlation(field[box], loaded),
        correlation(loaded, loaded) / total if way == "energy" else None,
    )
    return Gradient(*changes, (level - value / total) / window.cell_area if fixed_load else float(field.sum()))


def _box(mask: NDArray[np.bool_]) -> tuple[slice, slice]:
    """Smallest rectangle of cells that holds a set of them."""
    rows, columns = (np.flatnonzero(mask.any(axis=1 - axis)) for axis in (0, 1))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _adjoint_field(stage: Stage, by_pressure: Array, *, fixed_load: bool) -> tuple[Array, float]:
    """Return λ, zero outside the contact, and η."""
    mirrored, loaded = stage.operator.transposed(), stage.result.pressure > 0.0
    backend = mirrored.backend
    contact = backend.cells(backend.asarray(loaded))
    field, residual = np.zeros(stage.window.shape), by_pressure
    first = 0.0
    for _ in range(_MOST_RESTARTS):
        level = float(residual[loaded].mean()) if fixed_load else 0.0
        size = float(np.linalg.norm(residual[loaded] - level))
        first = first or size
        if size <= _TOLERANCE * first:
            return field, level
        reduction = 0.5 * _TOLERANCE * first / size
        wanted = contact.gathered(backend.asarray(-residual))
        correction, _, _ = solve_on_contact(
            mirrored, wanted, contact, reduction=reduction, floor=0.0, directions=_DIRECTIONS, fixed_load=fixed_load
        )
        field += backend.to_numpy(contact.scattered(correction))
        residual = by_pressure - backend.to_numpy(mirrored(field))
    raise ConvergenceError(
        f"the derivatives of the friction coefficient did not converge: their linear problem was solved to "
        f"{size / first:.1e} where {_TOLERANCE:.0e} was needed; ask for less accuracy, which needs a coarser grid."
    )


def _half_space_changes(
    material: SteadyMaterial, spacing: float, shift: float, adjoint: Array, energy: Array | None
) -> tuple[float, Array, Array]:
    """Change of the friction coefficient with glassy compliance, compliances and memory lengths; point contact.

    Parameters
    ----------
    material : SteadyMaterial
    spacing, shift : float
        Side of a cell, and how far behind the centres the gap is looked at, in cells.
    adjoint : (2 nx − 1, ny) array
        Correlation of the adjoint field with the pressure.
    energy : (2 nx − 1, ny) array or None
        Correlation of the pressure with itself over its sum, if the friction is that of the energy.
    """
    lengths, compliances = material.memory_lengths / spacing, material.compliances
    (nx, ny) = adjoint.shape[0] // 2 + 1, adjoint.shape[1]
    x, y = np.arange(-(nx - 1.0), nx)[:, None], np.arange(float(ny))
    together = [adjoint] if energy is None or shift > 0.0 else [adjoint, energy]
    moments, sensitivities = memory_moments(np.stack(together), lengths, shift)
    unit = -spacing / np.pi
    glassy = unit * float(np.vdot(adjoint, cell_potential(x - shift, y)))
    by_compliance = unit * moments[0]
    by_logarithm = unit * compliances * sensitivities[0]
    if energy is not None:
        if shift > 0.0:
            moments, sensitivities = memory_moments(energy[None], lengths)
        # What dissipates of a mode's slope is (K − L)/λ, or λ ∂²L/∂x² of a short memory (see `HalfSpaceOperator`).
        lost = (moments[-1] - float(np.vdot(energy, cell_potential(x, y)))) / lengths
        change = sensitivities[-1] / lengths - lost
        short = lengths <= _SHORT_MEMORY
        lost[short] = lengths[short] * float(np.vdot(energy, cell_potential_xx(x, y)))
        change[short] = lost[short]
        by_compliance -= lost / np.pi
        by_logarithm -= compliances * change / np.pi
    return glassy, by_compliance, by_logarithm / material.memory_lengths


def _line_changes(
    material: SteadyMaterial, spacing: float, shift: float, adjoint: Array, energy: Array | None
) -> tuple[float, Array, Array]:
    """Change of the friction coefficient with glassy compliance, compliances and memory lengths; line contact.

    The level of the displacement, which changes too, does nothing to an adjoint field whose sum is zero.
    """
    weights = adjoint[:, 0]
    x = np.arange(len(weights), dtype=np.float64) - len(weights) // 2
    unit = -2.0 / np.pi
    glassy = unit * spacing * float(weights @ strip_potential(x - shift))
    by_compliance, by_logarithm = np.zeros_like(material.compliances), np.zeros_like(material.compliances)
    for k, length in enumerate(material.memory_lengths / spacing):
        by_compliance[k] = spacing * float(weights @ line_memory_influence(x - shift, length)[0])
        by_logarithm[k] = spacing * float(weights @ line_memory_changes(x - shift, length)[0])
        if energy is not None:
            by_compliance[k] += float(energy[:, 0] @ line_memory_influence(x, length)[1])
            by_logarithm[k] += float(energy[:, 0] @ line_memory_changes(x, length)[1])
    return glassy, unit * by_compliance, unit * material.compliances * by_logarithm / material.memory_lengths


_CHANGES: dict[type, Callable[..., tuple[float, Array, Array]]] = {
    HalfSpaceOperator: _half_space_changes,
    LineOperator: _line_changes,
}
