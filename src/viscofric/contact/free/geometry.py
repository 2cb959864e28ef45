"""The two free contacts: a point contact on rectangular cells, a line contact in plane strain on one row of cells."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from viscofric.contact.free.grids import Grid
from viscofric.contact.operators.convolution import ConvolutionOperator
from viscofric.contact.operators.half_space import HalfSpaceOperator, LineOperator


@dataclass(frozen=True)
class Geometry:
    """Properties of point and line contacts."""

    name: str
    dimension: int  # of the surface that the contact covers: loads are pressures times lengths to this power
    operator: Callable[..., ConvolutionOperator]  # grid, material and collocation shift to the influence operator
    # Load on an elastic half-space under the paraboloid or the parabolic cylinder, in units of Hertz's contact (K. L.
    # Johnson, Contact Mechanics (1985), Eqs. 4.22 and 4.43).
    parabolic_load: float
    load_unit: str
    has_far_field: bool  # whether displacements are measured from the surface far away, which is fixed
    # Factor on errors estimated from changes between grids.  The position of an edge within its cell is random; the
    # many cells of a rim average it, but not the two at the ends of a strip.
    scatter: float
    finest: int  # default limit of the cells along the longer edge
    # Wavenumber times the cell of waves that cells leave out (see `viscofric.contact.free.balance`), and how far its
    # logarithm may be off where little is lost: of strips from Hunter's contact, of point contacts from Hertz's.
    cut: float
    doubt: float

    def around(self, rear: float, front: float, side: float, cells: int, aspect: float = 1.0) -> Grid:
        """Return the grid over −rear … front and ±side, without sides for a line contact; see `Grid.around`."""
        return Grid.around(rear, front, side if self.dimension > 1 else 0.0, cells, aspect)


POINT: Final = Geometry("point", 2, HalfSpaceOperator, 4.0 / 3.0, "N", True, 1.0, 2048, 3.4, 0.1)
LINE: Final = Geometry("line", 1, LineOperator, 0.25 * math.pi, "N/m", False, 2.0, 65536, 2.5, 0.4)
