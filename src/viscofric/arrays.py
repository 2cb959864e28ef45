"""Names of NumPy's arrays for annotations, the line of a field through the axis, and a fit of numbers above zero."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
Mask: TypeAlias = NDArray[np.bool_]
Integers: TypeAlias = NDArray[np.int64]
Indices: TypeAlias = NDArray[np.intp]


def centre_line(y: Array, field: Array) -> Array:
    """Return the line of a field (nx, ny) through the axis: the mean of the rows of cells beside it."""
    middle = np.flatnonzero(np.isclose(np.abs(y), np.abs(y).min(), rtol=1e-6))
    return np.asarray(field[:, middle].mean(axis=1))


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
