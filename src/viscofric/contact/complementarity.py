"""The contact problem on a grid: pressures and gaps that are never negative and never both positive.

Find p and the indentation δ with ::

    w = K p + h − δ,      w ≥ 0,  p ≥ 0,  w p = 0,      Σ p dA = F,  or δ given,

for a positive definite but nonsymmetric K.  Conjugate gradients do not apply.  The method is an active set
whose linear problems are solved inexactly by truncated generalised conjugate residuals (GCR) [1]_, with the
inverse symbol |q|/S(−q·v), restricted to the contact, as preconditioner.  With the load given, the indentation is
eliminated by projecting the mean out of residuals and search directions, so that the load never changes within
a linear solve.

How tightly the linear problems are solved is the caller's choice.  "without headway": to a tenth of their initial
residual at first, and ten times more tightly whenever the number of wrongly classified cells fails to halve, since
loose solves alone can make the set cycle; right for one contact, however skew its operator.  "near the end":
loosely while many cells are wrongly classified, tightly once few are; right for rough surfaces, where tight solves
on a wrong set make all the spots overshoot.

.. [1] S. C. Eisenstat, H. C. Elman, M. H. Schultz, SIAM J. Numer. Anal. 20 (1983) 345.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]
    RealArray: TypeAlias = NDArray[np.floating[Any]]
    Indices: TypeAlias = NDArray[np.intp]

# How far a linear residual is reduced while more than the given part of the contact's cells is wrongly classified.
_REDUCTIONS = ((0.02, 0.3), (0.001, 0.1), (0.0, 1e-4))
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
        Largest gap under pressure or overlap without it, relative to the indentation (or to the given depth).
    load : float
        Relative error of the load; zero where the indentation was given.
    set_changes, linear_iterations, products : int
        Looks at the contact set, GCR steps, and products with the operator.
    linear : float
        Residual of the last linear problem, relative to its right-hand side.
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
    linear: float = 0.0


def solve_complementarity(
    operator: ContactOperator,
    height: Array,
    load: float | None,
    guess: Array,
    *,
    indentation: float | None = None,
    tolerance: float = 1e-8,
    most_products: int = 800,
    depth: float | None = None,
    inner: ContactOperator | None = None,
    patience: int | None = None,
    tighten: Literal["without headway", "near the end"] = "without headway",
    directions: int = _DIRECTIONS,
) -> ComplementaritySolution:
    """Solve the contact problem for a given load, or for a given indentation.

    Parameters
    ----------
    operator : ContactOperator
        Pressure to displacement; positive definite, symmetric or not.
    height : (nx, ny) array
        Indenter's height above its lowest point.
    load : float or None
        Sum of the pressures (that is F/dA), above zero; None where the indentation is given.
    guess : (nx, ny) array
        Pressures to start from; negative ones count as zero, some must be positive where the load is given.
    indentation : float, optional
        δ, where no load is given; above zero unless `depth` is given.
    tolerance : float
        Largest violation of the gap conditions, relative to `depth`.
    most_products : int
        Products with the operator after which the solver gives up.
    depth : float, optional
        What the gap conditions are measured in; the indentation by default.
    inner : ContactOperator, optional
        What linear problems are solved with, in the precision of the arrays that it returns; the operator itself by
        default.  Single precision costs half and no digits: residuals are formed with `operator`.
    patience : int, optional
        Looks at the contact set without a smaller residual after which the solver gives up.
    tighten : {"without headway", "near the end"}
        When linear problems are solved more tightly; see above.
    directions : int
        Search directions that are kept while a linear problem is solved: two numbers each for every cell in contact.

    Returns
    -------
    ComplementaritySolution
        Look at ``converged``: this function does not raise.  Unconverged, it is the best that was met.
    """
    inner = operator if inner is None else inner
    start, inner_start = operator.products, inner.products
    pressure = _loaded_to(np.maximum(guess, 0.0), load)
    displacement = operator(pressure)
    best: ComplementaritySolution | None = None
    set_changes = linear_iterations = since_best = 0
    linear, wrong_before = 0.0, None
    near_end = tighten == "near the end"
    reduction = _REDUCTIONS[0][1] if near_end else _FIRST_REDUCTION
    while True:
        set_changes += 1
        products = operator.products - start + (0 if inner is operator else inner.products - inner_start)
        state, gap, overlapping = _look(pressure, displacement, height, load, indentation, depth)
        state_now = ComplementaritySolution(
            **state,
            converged=state["complementarity"] <= tolerance,
            set_changes=set_changes,
            linear_iterations=linear_iterations,
            products=products,
            linear=linear,
        )
        since_best += 1
        if best is None or state_now.complementarity < best.complementarity:
            best, since_best = state_now, 0
        spent = products >= most_products or (patience is not None and since_best >= patience)
        if state_now.converged or spent or not np.isfinite(state_now.complementarity):
            return best
        contact = np.flatnonzero((pressure > 0.0) | overlapping)
        unit = abs(state_now.indentation) if depth is None else depth
        correction, steps, linear = _solve_on_contact(
            inner, gap, contact, reduction, 0.5 * tolerance * unit, directions, fixed_load=load is not None
        )
        linear_iterations += steps
        pressure = pressure.copy()
        pressure.flat[contact] += correction
        negative = pressure < 0.0
        pressure[negative] = 0.0
        pressure = _loaded_to(pressure, load)
        displacement = operator(pressure)
        wrong = int(np.count_nonzero(overlapping)) + int(np.count_nonzero(negative))
        if near_end:
            reduction = next(each for part, each in _REDUCTIONS if wrong > part * len(contact) or part == 0.0)
        elif wrong_before is not None and wrong > 0.5 * wrong_before:
            reduction = max(0.1 * reduction, _LEAST_REDUCTION)
        wrong_before = wrong


def _loaded_to(pressure: Array, load: float | None) -> Array:
    if load is not None:
        pressure *= load / pressure.sum()
    return pressure


def _look(
    pressure: Array,
    displacement: Array,
    height: Array,
    load: float | None,
    indentation: float | None,
    depth: float | None,
) -> tuple[dict[str, Any], Array, NDArray[np.bool_]]:
    """Return what a pressure comes to, its gap, and the free cells that overlap."""
    loaded = pressure > 0.0
    gap = displacement + height
    if indentation is None:
        indentation = float(gap[loaded].mean())
    gap -= indentation
    overlapping = ~loaded & (gap < 0.0)
    worst = max(float(np.abs(gap[loaded]).max(initial=0.0)), -float(gap.min()))
    state = {
        "pressure": pressure,
        "displacement": displacement,
        "indentation": indentation,
        "complementarity": worst / (abs(indentation) if depth is None else depth),
        "load": 0.0 if load is None else abs(float(pressure.sum()) / load - 1.0),
    }
    return state, gap, overlapping


def _solve_on_contact(
    operator: ContactOperator,
    gap: Array,
    contact: Indices,
    reduction: float,
    floor: float,
    most: int,
    *,
    fixed_load: bool,
) -> tuple[RealArray, int, float]:
    """Correct the pressures on a fixed contact set until its gap is closed, or level for a fixed load.

    Keeps `most` search directions.  Returns the corrections at the cells of the set, the number of steps and the
    relative residual.
    """
    unit = float(np.abs(gap.ravel()[contact]).max())
    if unit == 0.0:
        return np.zeros(len(contact)), 0, 0.0
    field: Any = None

    def scattered(values: RealArray) -> Any:
        nonlocal field
        if field is None:
            field = np.zeros(gap.shape, values.dtype)
        field.ravel()[contact] = values
        return field

    def gathered(values: RealArray) -> RealArray:
        found = values.ravel()[contact]
        if fixed_load:
            found -= found.mean()
        return found

    precision = getattr(operator, "precision", np.float64)
    residual = gathered((gap / -unit).astype(precision, copy=False))
    first = float(np.linalg.norm(residual))
    target, floor = reduction * first, floor / unit
    correction = np.zeros_like(residual)
    # Directions z and their images A z, orthonormal among themselves, in a ring that forgets the oldest.
    directions: list[RealArray] = []
    images: list[RealArray] = []
    steps = 0
    while steps == 0 or (
        steps < _LINEAR_ITERATIONS and np.linalg.norm(residual) > target and np.abs(residual).max() > floor
    ):
        direction = gathered(operator.precondition(scattered(residual)))
        image = gathered(operator(scattered(direction)))
        overlaps = [other @ image for other in images]
        for overlap, other, its_direction in zip(overlaps, images, directions, strict=True):
            image -= overlap * other
            direction -= overlap * its_direction
        length = np.linalg.norm(image)
        if length == 0.0:
            break
        image /= length
        direction /= length
        step = image @ residual
        correction += step * direction
        residual -= step * image
        if len(images) == most:
            images[steps % most], directions[steps % most] = image, direction
        else:
            images.append(image)
            directions.append(direction)
        steps += 1
    return unit * correction, steps, float(np.linalg.norm(residual)) / first if first else 0.0
