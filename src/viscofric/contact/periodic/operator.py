"""The periodic solid as a linear operator: one product with the transfer function between two real FFTs."""

from __future__ import annotations

import operator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from viscofric.contact.arrays.backend import AnyArray, Backend


@dataclass
class PeriodicOperator:
    """Displacement of a periodic solid, of zero mean, under pressures on the points of a grid.

    Linear and positive semidefinite (a uniform pressure moves nothing); symmetric at rest only.
    """

    transfer: AnyArray  # (nx, ny//2 + 1), û/p̂ for each wave, zero for the mean; real for an elastic solid
    shape: tuple[int, int]  # points along x and y
    precision: Any = np.float64  # numpy.float64, or numpy.float32 for corrections, where the backend has them
    backend: Backend = field(default_factory=Backend)
    products: int = field(default=0, init=False)
    ffts: int = field(default=0, init=False)  # two-dimensional ones, of the operator and its inverse

    def __post_init__(self) -> None:
        if isinstance(self.transfer, np.ndarray):
            kind = np.result_type(self.precision, np.complex64) if np.iscomplexobj(self.transfer) else self.precision
            self.transfer = self.backend.asarray(self.transfer.astype(kind, copy=False))

    @property
    def dtype(self) -> Any:
        """Type of the arrays that it returns."""
        return getattr(self.backend.xp, np.dtype(self.precision).name)

    def for_corrections(self) -> PeriodicOperator:
        """Return the same operator in the precision that is enough for corrections."""
        precision = np.float32 if self.backend.is_numpy else np.float64
        return PeriodicOperator(self.transfer, self.shape, precision, self.backend)

    def __call__(self, pressure: AnyArray) -> AnyArray:
        """Displacement under a pressure."""
        self.products += 1
        return self.filtered(self.transfer, self.backend.asarray(pressure))

    def precondition(self, residual: AnyArray) -> AnyArray:
        """Pressure that causes a displacement: the exact inverse where everything is in contact."""
        return self.filtered(self.inverse, residual)

    def filtered(self, factor: AnyArray, values: AnyArray) -> AnyArray:
        """Multiply each wave of a field by its factor."""
        self.ffts += 2
        waves = self.backend.transforms.forward(values)
        self.backend.in_parts(operator.imul, waves, factor)
        return self.backend.transforms.inverse(waves, self.shape)

    @cached_property
    def inverse(self) -> AnyArray:
        """Inverse of the transfer function.

        A uniform pressure, which moves nothing, has the compliance of the most compliant wave: with a given load this
        has no effect, with a given indentation it must not be zero.
        """
        xp = self.backend.xp
        found = xp.asarray(self.transfer, copy=True)
        found[0, 0] = xp.max(xp.abs(found))
        return self.backend.reciprocal(found)

    @cached_property
    def compliance_range(self) -> tuple[float, float]:
        """Smallest and largest modulus of the transfer function, the mean left out."""
        xp = self.backend.xp
        magnitude = xp.reshape(xp.abs(self.transfer), (-1,))[1:]
        least, largest = self.backend.floats(xp.min(magnitude), xp.max(magnitude))
        return least, largest
