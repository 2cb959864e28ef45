"""Names of NumPy's arrays for annotations, and the fit of numbers that are not negative."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
Mask: TypeAlias = NDArray[np.bool_]
Integers: TypeAlias = NDArray[np.int64]
Indices: TypeAlias = NDArray[np.intp]


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
