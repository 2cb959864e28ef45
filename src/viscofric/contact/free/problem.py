"""One contact problem in units of the Hertz contact at E0."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.complementarity import ComplementaritySolution
from viscofric.contact.free.geometry import Geometry
from viscofric.contact.free.grids import Grid
from viscofric.contact.free.scale import ScaledIndenter, root
from viscofric.contact.operators.convolution import ConvolutionOperator, SteadyMaterial, solve_on_cells
from viscofric.contact.operators.layer import ScaledLayer

# Between which the first guess of the contact's size lies, but for extreme solids; compliances below the last number
# count as it.
_LOG_SIZES, _LEAST_COMPLIANCE = (-50.0, 1.0), 1e-300
COARSEST = 32  # cells along the longer edge of the window on the coarsest grid


@dataclass(frozen=True)
class Control:
    """A given load or a given indentation; the other is None."""

    load: float | None = None
    indentation: float | None = None

    def solve(
        self, operator: ConvolutionOperator, height: Array, guess: Array, tolerance: float, patience: int | None = None
    ) -> ComplementaritySolution:
        """Solve on one grid from a guess of the pressure; `patience` as of `solve_complementarity`."""
        load = None if self.load is None else self.load / operator.window.cell_area
        return solve_on_cells(
            operator, height, load, guess, indentation=self.indentation, tolerance=tolerance, patience=patience
        )


@dataclass(frozen=True, eq=False)
class Problem:
    """A contact problem, the same on every grid."""

    geometry: Geometry
    solid: SteadyMaterial
    shape: ScaledIndenter
    control: Control
    tolerance: float  # of the contact conditions
    backend: Backend = field(default_factory=Backend)
    layer: ScaledLayer | None = None  # to which the geometry's operator belongs; None for a half-space
    coarsest: int = COARSEST  # cells along the longer edge of the window on the coarsest grid
    coarse_tolerance: float = 0.0  # likewise, of grids that are refined in any case, if it is larger
    axis: tuple[float, float] = (0.0, 0.0)  # place of the indenter's axis on the grids

    @cached_property
    def first_size(self) -> float:
        """First guess of the contact's size.

        Under a given load, the radius a of Hertz's contact with the compliance of waves e^(ix/a); a given indentation
        almost determines the size.
        """
        if self.control.load is None:
            return 1.0
        power = 1.0 / (self.geometry.dimension + 1.0)

        def beyond(log_size: float) -> float:
            wave = np.array([math.exp(-log_size)])
            yielding = 1.0 if self.layer is None else self.layer.yielding(wave)
            return log_size - power * math.log(max(abs(self.solid.symbol(wave, yielding)[0]), _LEAST_COMPLIANCE))

        least, largest = _LOG_SIZES
        while beyond(least) > 0.0:
            least *= 2.0
        return math.exp(root(beyond, least, largest))

    def height_on(self, window: Grid, shift: float) -> Array:
        """Height of the indenter at the collocation points, `shift` cells behind the cell centres."""
        x, y = self.axis
        return self.shape.height((window.x - x - shift * window.spacing)[:, None], window.y - y)
