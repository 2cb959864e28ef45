"""Derivatives of a contact's friction coefficient by material and load: one adjoint solve on the contact found.

On the contact set c a small change leaves ``K p − δ = −h``, ``Σ p dA = F`` (or δ given).  With the friction coefficient
a function μ(p) of the pressure, explicitly of the parameters too where it is found from the dissipated energy, the
adjoint field λ on the same cells solves ::

    Kᵀ λ + η = ∂μ/∂p,   Σ λ = 0        for a given load,      dμ = −λᵀ dK p + η dF/A + (dμ)_p,
    Kᵀ λ     = ∂μ/∂p                   for a given indentation,  dμ = −λᵀ dK p + dδ Σ λ + (dμ)_p,

(dμ)_p the change at fixed pressure.  Kᵀ is the influence mirrored along the motion.  λᵀ dK p = Σ W dK with the
correlation W of λ and p, so that any number of modes costs one pass through their influence coefficients.
At the edges of a contact the pressure is zero, so that cells that enter or leave it with a change have no effect to
first order.  The collocation points (`viscofric.contact.operators.convolution.collocation_shift`) are fixed.

A part of the balanced energy is Λ r, r = Σ q (K p + h − δ)/h² over free cells, q being the pressures of the cells next
to each (see `viscofric.contact.free.balance`).  With λ = −Λ q/h² there, and what Λ itself changes with the two sides of
the contact, the same equations include the change of the gap.

M. B. Giles, N. A. Pierce, Flow Turbul. Combust. 65 (2000) 393, on adjoints.

Everything here is in the units of the problem.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.contact.complementarity import solve_on_contact
from viscofric.contact.free.balance import free_gap, neighbours
from viscofric.contact.free.estimates import Way, friction_way
from viscofric.contact.free.stage import Stage
from viscofric.contact.influence.moments import correlation, memory_moments
from viscofric.contact.operators.convolution import ConvolutionOperator, bent_share, both_halves, is_even, upper_half
from viscofric.errors import ConvergenceError

# Residual of the adjoint problem, relative to its right-hand side, and how often it is computed again.
_TOLERANCE = 1e-8
_MOST_RESTARTS = 20
# Number of search directions kept.
_DIRECTIONS = 40


class Gradient(NamedTuple):
    """Derivatives of the friction coefficient, or of another number."""

    glassy: float  # with respect to the compliance without memory
    compliances: Array  # (m,), with respect to each mode's compliance at fixed glassy compliance
    memory_lengths: Array  # (m,), with respect to each mode's memory length
    held: float  # with respect to the load or to the indentation, whichever is given

    def plus(self, other: Gradient, times: float) -> Gradient:
        """Return the sum with a multiple of another one."""
        return Gradient(
            self.glassy + times * other.glassy,
            self.compliances + times * other.compliances,
            self.memory_lengths + times * other.memory_lengths,
            self.held + times * other.held,
        )


class Adjoint(NamedTuple):
    """Derivatives of a number, and the adjoint field that they follow from."""

    gradient: Gradient
    field: Array  # (nx, ny), λ, also where it is held
    by_load: float  # change with the logarithm of the load; zero where the indentation is given


def differentiated(stages: list[Stage]) -> Way:
    """Return which expression of the friction coefficient is to be differentiated, for nested grids, coarsest first.

    That which `viscofric.contact.free.estimates` uses.  Where the gap is evaluated behind the cell centres it is the
    asymmetry of the pressure: for a layer at the leading edge that is thinner than a cell, the balance has its value
    right, by its last share Λ r, but not the change of that share.
    """
    return "pressure" if stages[-1].operator.shift > 0.0 else friction_way(stages)


def friction_adjoint(stage: Stage, way: Way) -> Adjoint:
    """Differentiate the friction coefficient on one grid of fixed cells; ConvergenceError if the problem is not solved.

    By the asymmetry of the pressure ("pressure"), or by the dissipated energy plus the part that cells leave out of it
    ("balance").
    """
    operator, window, pressure = stage.operator, stage.window, stage.result.pressure
    material, total = operator.material, float(pressure.sum())
    held = np.zeros(window.shape)
    if way == "pressure":
        value = stage.pressure_friction
        by_pressure = stage.problem.shape.slope(window.x[:, None], window.y) / total
    else:
        value = stage.energy_friction
        by_pressure = operator.dissipated_force_gradient(pressure) / (window.cell_area * total)
        late, scale = stage.lag_changes, 1.0 / (window.spacing**2 * total)
        ahead = scale * (stage.lag - stage.rear_share * late.rear)
        behind = ahead + scale * late.rear
        gap = free_gap(pressure, stage.gap)
        by_pressure += neighbours(gap, behind, ahead)
        held = -np.where(gap > 0.0, neighbours(pressure, ahead, behind), 0.0)
    field, by_load, by_held = _adjoint_field(stage, by_pressure, value, held)
    box = _box((pressure > 0.0) | (field != 0.0))
    moved = correlation(field[box], pressure[box])
    if way == "pressure":
        (sums,) = _sums(operator, moved[None], operator.shift)
        return Adjoint(_change(operator, sums, by_held), field, by_load)
    # Second differences of K, summed over a correlation, are second differences of the correlation.
    moved, energy = (np.pad(one, ((1, 1), (0, 0))) for one in (moved, correlation(pressure[box], pressure[box])))
    bends = neighbours(energy) - 2.0 * energy
    if operator.shift == 0.0:
        work, slope, bend = _sums(operator, np.stack([moved, energy, bends]), 0.0)
    else:
        (work,) = _sums(operator, moved[None], operator.shift)
        slope, bend = _sums(operator, np.stack([energy, bends]), 0.0)
    gradient = _change(operator, work, by_held)
    lost, change = _lost(slope, bend, material.memory_lengths / window.spacing)
    by_length = material.compliances * change / material.memory_lengths
    gradient = gradient.plus(Gradient(0.0, lost, by_length, 0.0), -operator.unit / total)
    gradient = gradient.plus(Gradient(*late[1:], 0.0), stage.opening)
    return Adjoint(gradient, field, by_load)


def mean_gradients(stage: Stage, fields: list[Array]) -> list[Gradient]:
    """Differentiate the means of fields (nx, ny) over the load; ConvergenceError if a problem is not solved."""
    pressure, none = stage.result.pressure, np.zeros(stage.window.shape)
    total, box, shift = float(pressure.sum()), _box(pressure > 0.0), stage.operator.shift
    solved = [_adjoint_field(stage, one / total, float(np.vdot(one, pressure)) / total, none) for one in fields]
    sums = _sums(stage.operator, np.stack([correlation(one[box], pressure[box]) for one, _, _ in solved]), shift)
    return [_change(stage.operator, one, by_held) for one, (_, _, by_held) in zip(sums, solved, strict=True)]


def _box(mask: Mask) -> tuple[slice, slice]:
    """Smallest rectangle of cells that holds a set of them."""
    rows, columns = (np.flatnonzero(mask.any(axis=1 - axis)) for axis in (0, 1))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _adjoint_field(stage: Stage, by_pressure: Array, value: float, held: Array) -> tuple[Array, float, float]:
    """Solve for λ (nx, ny) of a number that is homogeneous in the pressures, except for its change at fixed ones.

    `by_pressure` (nx, ny) is its change with the pressure of each cell, times the load, over the load; `held` (nx, ny)
    is λ outside the contact.  Returns also the change with the logarithm of the load (zero where the indentation is
    given), and that with the load or the indentation, whichever is given.
    """
    total = float(stage.result.pressure.sum())
    each = value / total
    if stage.problem.control.load is None:
        field, _ = _field_and_level(stage, by_pressure - each, held, fixed_load=False)
        return field, 0.0, float(field.sum())
    field, level = _field_and_level(stage, by_pressure, held, fixed_load=True)
    return field, (level - each) * total, (level - each) / stage.window.cell_area


def _field_and_level(stage: Stage, by_pressure: Array, held: Array, *, fixed_load: bool) -> tuple[Array, float]:
    """Return λ, as held outside the contact, and η."""
    operator, given = stage.operator.transposed(), (stage.result.pressure, by_pressure, held)
    if not (operator.backend.is_numpy and all(is_even(each) for each in given)):
        return _solved(operator, *given, fixed_load=fixed_load)
    field, level = _solved(operator.even, *(upper_half(each) for each in given), fixed_load=fixed_load)
    return both_halves(field), level


def _solved(
    operator: ConvolutionOperator, pressure: Array, by_pressure: Array, held: Array, *, fixed_load: bool
) -> tuple[Array, float]:
    """Return the same with the transposed operator given, on all cells or on those of one side."""
    backend, loaded = operator.backend, pressure > 0.0
    contact = backend.cells(backend.asarray(loaded))
    field = held.copy()
    if fixed_load:
        field[loaded] -= held.sum() / np.count_nonzero(loaded)
    first = 0.0
    for _ in range(_MOST_RESTARTS):
        residual = by_pressure - backend.to_numpy(operator(field)) if field.any() else by_pressure
        level = float(residual[loaded].mean()) if fixed_load else 0.0
        size = float(np.linalg.norm(residual[loaded] - level))
        first = first or size
        if size <= _TOLERANCE * first:
            return field, level
        reduction = 0.5 * _TOLERANCE * first / size
        wanted = contact.gathered(backend.asarray(-residual))
        correction, _, _ = solve_on_contact(
            operator, wanted, contact, reduction=reduction, floor=0.0, directions=_DIRECTIONS, fixed_load=fixed_load
        )
        field += backend.to_numpy(contact.scattered(correction))
    raise ConvergenceError(
        f"the derivatives of the friction coefficient did not converge: their linear problem was solved to "
        f"{size / first:.1e} where {_TOLERANCE:.0e} was needed; request less accuracy, which needs a coarser grid.",
        code="not-converged",
    )


class _Sums(NamedTuple):
    """A correlation summed up with the potential of a cell, and with each mode's delayed one and its change by ln λ."""

    instant: float
    delayed: Array
    change: Array


def _sums(operator: ConvolutionOperator, correlations: Array, shift: float) -> list[_Sums]:
    """Return those of correlations (k, 2 n − 1, ny), looked at so many cells behind the centres."""
    cell, lengths = operator.cell, operator.material.memory_lengths / operator.window.spacing
    potential = _around(lambda x, y: cell(x - shift, y), correlations[0], cell.aspect)
    delayed, changes = memory_moments(correlations, lengths, shift, cell)
    return [
        _Sums(float(np.vdot(one, potential)), sums, change)
        for one, sums, change in zip(correlations, delayed, changes, strict=True)
    ]


def _around(function: Callable[[Array, Array], Array], correlation: Array, aspect: float) -> Array:
    """Values at the distances of a correlation (2 n − 1, ny), in cells."""
    (n, ny) = correlation.shape[0] // 2 + 1, correlation.shape[1]
    return function(np.arange(-(n - 1.0), n)[:, None], aspect * np.arange(float(ny)))


def _change(operator: ConvolutionOperator, sums: _Sums, by_held: float) -> Gradient:
    """Return −λᵀ dK p by glassy compliance, compliances and memory lengths, from the sums of λ and p."""
    material, scale = operator.material, -operator.unit * operator.window.spacing
    by_logarithm = scale * material.compliances * sums.change
    return Gradient(scale * sums.instant, scale * sums.delayed, by_logarithm / material.memory_lengths, by_held)


def _lost(energy: _Sums, bends: _Sums, lengths: Array) -> tuple[Array, Array]:
    """Return the dissipation of each mode per compliance, negative, and its change with ln λ.

    By its slope, (K − L)/λ, and partly by the bends λ ∂²K/∂x²; see
    `viscofric.contact.operators.convolution.cell_influence`.
    """
    lost = (energy.delayed - energy.instant) / lengths
    change = energy.change / lengths - lost
    share = bent_share(lengths)
    shift = -2.0 * share * (1.0 - share)  # ∂ share/∂ ln λ
    bend, bend_change = lengths * bends.delayed, lengths * (bends.delayed + bends.change)
    return lost + share * (bend - lost), change + share * (bend_change - change) + shift * (bend - lost)
