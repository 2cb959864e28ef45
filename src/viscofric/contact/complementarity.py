"""The contact problem on a grid: pressures and gaps that are never negative and never both positive.

Find p and the indentation δ with ::

    w = K p + h − δ,      w ≥ 0,  p ≥ 0,  w p = 0,      Σ p dA = F

for a positive definite but nonsymmetric K.  Conjugate gradients do not apply.  The method is an active set
whose linear problems are solved inexactly by truncated generalised conjugate residuals (GCR) [1]_, with the
inverse symbol |q|/S(−q·v), restricted to the contact, as preconditioner.  The indentation is eliminated by
projecting the mean out of residuals and search directions, so that the load never changes within a linear
solve.  The linear problems are solved to a tenth of their initial residual at first, and ten times more
tightly whenever the number of wrongly classified cells fails to halve: loose solves alone can make the set
cycle.

.. [1] S. C. Eisenstat, H. C. Elman, M. H. Schultz, SIAM J. Numer. Anal. 20 (1983) 345.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]
    Indices: TypeAlias = NDArray[np.intp]

_FIRST_REDUCTION = 1e-1
_LEAST_REDUCTION = 1e-7
_DIRECTIONS = 40  # search directions that GCR keeps
_LINEAR_ITERATIONS = 100  # between two looks at the contact set


class ContactOperator(Protocol):
    """What the solver asks of an influence operator."""

    products: int

    def __call__(self, pressure: Array) -> Array:
        """Displacement under a pressure."""

    def precondition(self, residual: Array) -> Array:
        """Approximate inverse of the operator."""


@dataclass(frozen=True, eq=False)
class ComplementaritySolution:
    """Pressure and indentation with the residuals they leave.

    Attributes
    ----------
    pressure, displacement : (nx, ny) array
    indentation : float
    converged : bool
        Whether `complementarity` came below the tolerance.
    complementarity : float
        Largest gap under pressure or overlap without it, relative to the indentation.
    load : float
        Relative error of the load.
    set_changes, linear_iterations, products : int
        Looks at the contact set, GCR steps, and products with the operator.
    """

    pressure: Array
    displacement: Array
    indentation: float
    converged: bool
    complementarity: float
    load: float
    set_changes: int
    linear_iterations: int
    products: int


def solve_complementarity(
    operator: ContactOperator,
    height: Array,
    load: float,
    guess: Array,
    *,
    tolerance: float = 1e-8,
    most_products: int = 800,
) -> ComplementaritySolution:
    """Solve the contact problem for a given load.

    Parameters
    ----------
    operator : ContactOperator
        Pressure to displacement; positive definite, symmetric or not.
    height : (nx, ny) array
        Indenter's height above its lowest point.
    load : float
        Sum of the pressures (that is F/dA), above zero.
    guess : (nx, ny) array
        Pressures to start from; negative ones count as zero, some must be positive.
    tolerance : float
        Largest violation of the gap conditions, relative to the indentation.
    most_products : int
        Products with the operator after which the solver gives up.

    Returns
    -------
    ComplementaritySolution
        Look at ``converged``: this function does not raise.
    """
    start = operator.products
    pressure = np.maximum(guess, 0.0)
    pressure *= load / pressure.sum()
    displacement = operator(pressure)
    reduction, wrong_before = _FIRST_REDUCTION, None
    set_changes = linear_iterations = 0
    while True:
        set_changes += 1
        loaded = pressure > 0.0
        surface = displacement + height
        indentation = float(surface[loaded].mean())
        gap = surface - indentation
        overlapping = ~loaded & (gap < 0.0)
        worst = max(float(np.abs(gap[loaded]).max()), -float(gap.min()))
        complementarity = worst / abs(indentation)
        converged = complementarity <= tolerance
        products = operator.products - start
        if converged or products >= most_products or not np.isfinite(complementarity):
            return ComplementaritySolution(
                pressure=pressure,
                displacement=displacement,
                indentation=indentation,
                converged=converged,
                complementarity=complementarity,
                load=abs(float(pressure.sum()) / load - 1.0),
                set_changes=set_changes,
                linear_iterations=linear_iterations,
                products=products,
            )
        contact = np.flatnonzero(loaded | overlapping)
        floor = 0.5 * tolerance * abs(indentation)
        correction, steps = _solve_on_contact(operator, surface, contact, reduction, floor)
        linear_iterations += steps
        pressure = pressure.copy()
        pressure.flat[contact] += correction
        negative = pressure < 0.0
        pressure[negative] = 0.0
        pressure *= load / pressure.sum()
        displacement = operator(pressure)
        wrong = int(np.count_nonzero(overlapping)) + int(np.count_nonzero(negative))
        if wrong_before is not None and wrong > 0.5 * wrong_before:
            reduction = max(0.1 * reduction, _LEAST_REDUCTION)
        wrong_before = wrong


def _solve_on_contact(
    operator: ContactOperator, surface: Array, contact: Indices, reduction: float, floor: float
) -> tuple[Array, int]:
    """Correct the pressures on a fixed contact set until its surface is flat, without changing the load.

    Returns the corrections at the cells of the set, and the number of steps.
    """

    def scattered(values: Array) -> Array:
        field = np.zeros_like(surface)
        field.flat[contact] = values
        return field

    def gathered(field: Array) -> Array:
        values = field.ravel()[contact]
        return np.asarray(values - values.mean())

    residual = gathered(-surface)
    target = reduction * float(np.linalg.norm(residual))
    correction = np.zeros_like(residual)
    # Directions z and their images A z, orthonormal among themselves, in a ring that forgets the oldest.
    directions = np.empty((_DIRECTIONS, len(contact)))
    images = np.empty_like(directions)
    steps = 0
    while steps == 0 or (
        steps < _LINEAR_ITERATIONS and np.linalg.norm(residual) > target and np.abs(residual).max() > floor
    ):
        direction = gathered(operator.precondition(scattered(residual)))
        image = gathered(operator(scattered(direction)))
        kept = min(steps, _DIRECTIONS)
        overlaps = images[:kept] @ image
        image -= overlaps @ images[:kept]
        direction -= overlaps @ directions[:kept]
        length = float(np.linalg.norm(image))
        if length == 0.0:
            break
        place = steps % _DIRECTIONS
        directions[place], images[place] = direction / length, image / length
        step = float(images[place] @ residual)
        correction += step * directions[place]
        residual -= step * images[place]
        steps += 1
    return correction, steps
