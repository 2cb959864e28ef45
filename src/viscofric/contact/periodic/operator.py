"""The periodic solid as a linear operator: one product with the transfer function between two real FFTs."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import scipy.fft

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]
    AnyArray: TypeAlias = NDArray[Any]


@dataclass
class PeriodicOperator:
    """Displacement of a periodic solid, of zero mean, under pressures on the points of a grid.

    Linear and positive semidefinite (a uniform pressure moves nothing); symmetric at rest only.

    Parameters
    ----------
    transfer : (nx, ny//2 + 1) array
        û/p̂ for each wave, zero for the mean; real for an elastic solid.
    shape : (int, int)
        Points along x and y.
    precision : type
        `numpy.float64`, or `numpy.float32` for corrections.

    Attributes
    ----------
    products, ffts : int
        Products with the operator, and two-dimensional FFTs of it and its inverse, so far.
    """

    transfer: AnyArray
    shape: tuple[int, int]
    precision: Any = np.float64
    products: int = field(default=0, init=False)
    ffts: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        kind = np.result_type(self.precision, np.complex64) if np.iscomplexobj(self.transfer) else self.precision
        self.transfer = self.transfer.astype(kind, copy=False)

    def in_precision(self, precision: Any) -> PeriodicOperator:
        """Return the same operator in another precision."""
        return PeriodicOperator(self.transfer, self.shape, precision)

    def __call__(self, pressure: AnyArray) -> Any:
        """Displacement under a pressure."""
        self.products += 1
        return self.filtered(self.transfer, pressure)

    def precondition(self, residual: AnyArray) -> Any:
        """Pressure that causes a displacement: the exact inverse where everything is in contact."""
        return self.filtered(self.inverse, residual)

    def filtered(self, factor: AnyArray, values: AnyArray) -> Any:
        """Multiply each wave of a field by its factor."""
        self.ffts += 2
        waves = scipy.fft.rfft2(values)
        waves *= factor
        return scipy.fft.irfft2(waves, self.shape, overwrite_x=True)

    @cached_property
    def inverse(self) -> AnyArray:
        """Inverse of the transfer function.

        A uniform pressure, which moves nothing, is answered like the most compliant wave: where the load is given that
        makes no difference, where the indentation is, it must not be zero.
        """
        found = self.transfer.copy()
        found[0, 0] = np.abs(found).max()
        np.divide(1.0, found, out=found)
        return found

    @cached_property
    def compliance_range(self) -> tuple[float, float]:
        """Smallest and largest modulus of the transfer function, the mean left out."""
        magnitude = np.abs(self.transfer).ravel()[1:]
        return float(magnitude.min()), float(magnitude.max())
