"""Names of NumPy's arrays for annotations, and what several rooms compute with: quadrature, polynomials, fits."""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
Mask: TypeAlias = NDArray[np.bool_]
Integers: TypeAlias = NDArray[np.int64]
Indices: TypeAlias = NDArray[np.intp]

# At ±3.1 the last node is 1e-15 from its end.
_REACH = 3.1


def centre_line(y: Array, field: Array) -> Array:
    """Return the line of a field (nx, ny) through the axis: the mean of the rows of cells beside it."""
    middle = np.flatnonzero(np.isclose(np.abs(y), np.abs(y).min(), rtol=1e-6))
    return np.asarray(field[:, middle].mean(axis=1))


def scatter(values: Array) -> float:
    """Return the scatter of points about a smooth curve from the median of their second differences."""
    return float(1.4826 * np.median(np.abs(np.diff(values, 2))) / np.sqrt(6.0))


def gauss(count: int, edges: ArrayLike = (0.0, 1.0)) -> tuple[Array, Array]:
    """Return nodes and weights of Gauss's rule between all neighbouring edges (m,), ((m − 1) n,) each."""
    node, weight = _gauss_rule(count)
    ends = np.asarray(edges)
    width = np.diff(ends)[:, None]
    return (ends[:-1, None] + 0.5 * width * (1.0 + node)).ravel(), (0.5 * width * weight).ravel()


@lru_cache(maxsize=64)
def _gauss_rule(count: int) -> tuple[Array, Array]:
    """Return nodes and weights on [−1, 1], which take half a millisecond to find."""
    return np.polynomial.legendre.leggauss(count)


class UnitNodes(NamedTuple):
    """Places in (0, 1), their distances from 1 without cancellation, and weights, (n,) each."""

    place: Array
    rest: Array
    weight: Array


@lru_cache(maxsize=8)
def unit_nodes(count: int) -> UnitNodes:
    """Return the nodes of the tanh-sinh rule, which singular ends, and layers next to them, do not disturb."""
    # H. Takahasi, M. Mori, Publ. RIMS 9 (1974) 721, doi:10.2977/prims/1195192451.
    t = np.linspace(-_REACH, _REACH, count)
    e = np.exp(-np.pi * np.sinh(np.abs(t)))
    near = e / (1.0 + e)
    place, rest = np.where(t < 0.0, near, 1.0 - near), np.where(t < 0.0, 1.0 - near, near)
    return UnitNodes(place, rest, (t[1] - t[0]) * np.pi * np.cosh(t) * place * rest)


def lagrange(nodes: Array, places: Array) -> Array:
    """Return Lagrange's weights, (places, nodes), of nodes (nodes,) at places (places,)."""
    away, apart = places[:, None] - nodes, nodes[:, None] - nodes
    result = np.ones((len(places), len(nodes)))
    for row in range(len(nodes)):
        others = np.arange(len(nodes)) != row
        result[:, row] = np.prod(away[:, others] / apart[row, others], axis=1)
    return result


def convolved(half: Array, values: Array) -> Array:
    """Return Σ half(i − i′, |j − j′|) values(i′, j′) on a grid (nx, ny), by FFT.

    `half` (2 nx − 1, ny) is at offsets from −(nx − 1) to nx − 1 and from 0 to ny − 1; several of them, each of its own
    values, are summed.
    """
    import scipy.fft

    nx, ny = values.shape[-2:]
    both = np.concatenate([half[..., :0:-1], half], axis=-1)
    # Circular in a period as long as both sides: only offsets that are not needed wrap around.
    padded = [scipy.fft.next_fast_len(size, real=True) for size in both.shape[-2:]]
    spectrum = scipy.fft.rfft2(both, padded) * scipy.fft.rfft2(values, padded)
    summed = spectrum.reshape(-1, *spectrum.shape[-2:]).sum(axis=0)
    return np.asarray(scipy.fft.irfft2(summed, padded)[nx - 1 : 2 * nx - 1, ny - 1 : 2 * ny - 1])


def non_negative_fit(matrix: Array, aim: Array) -> Array:
    """Return the x ≥ 0, (m,), that minimises |matrix x − aim|, for a matrix (n, m).

    Columns are scaled to equal norms.  SciPy's active set may exchange few columns back and forth for more steps than
    its own limit, or for ever where columns are nearly alike; a slower one goes on then.
    """
    from scipy.optimize import lsq_linear, nnls

    scale = np.linalg.norm(matrix, axis=0) + 1e-300
    try:
        found = nnls(matrix / scale, aim, maxiter=50 * matrix.shape[1])[0]
    except RuntimeError:
        found = np.maximum(0.0, lsq_linear(matrix / scale, aim, (0.0, np.inf), method="bvls").x)
    return np.asarray(found / scale)


#: Half of the decrease of a sum of squares with the parameters, (n,), and half of its second derivatives, (n, n).
Slopes: TypeAlias = tuple[Array, Array]
#: A sum of squares at a point, and what computes its slopes there.
Squares: TypeAlias = tuple[float, Callable[[], Slopes]]


def descend(
    at: Callable[[Array], Squares],
    start: Array,
    *,
    iterations: int,
    tolerance: float,
    largest: float | Array = 2.0,
    damping: float = 1e-3,
) -> Array:
    """Minimise a sum of squares over parameters (n,) by Levenberg–Marquardt steps, none of them above `largest`.

    The sum is infinite outside the domain; slopes are those of Gauss and Newton, or exact.  The search stops when the
    sum falls by less than the relative `tolerance`.  Without `damping`, steps are undamped until one is in vain.
    D. W. Marquardt, J. Soc. Indust. Appl. Math. 11 (1963) 431.
    """
    point, (least, slopes) = start, at(start)
    for _ in range(iterations):
        gradient, matrix = slopes()
        scale = np.diag(matrix) + 1e-12 * float(np.max(np.diag(matrix), initial=0.0))
        before = least
        while damping < 1e9:
            whole = np.linalg.solve(matrix + damping * np.diag(scale), gradient)
            step = np.clip(whole, -largest, largest)
            trial, slopes = at(point + step)
            if trial < before:
                break
            if whole @ gradient <= np.finfo(float).eps * abs(before):
                return point
            damping = 10.0 * damping or 1e-3
        else:
            break
        point, least, damping = point + step, trial, 0.1 * damping
        if before - least < tolerance * abs(before):
            break
    return point
