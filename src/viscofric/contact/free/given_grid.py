"""A window and a grid that the user gives instead of an accuracy."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import check_cost, whole_number
from viscofric.contact.free.grids import Extent
from viscofric.errors import InputError, brief
from viscofric.units import Quantity, to_si

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.contact.free.scale import Scale

COARSEST = 32  # cells along the longer edge of the window on the coarsest grid
LEAST_FINEST = 128  # three grids, so that the friction has an error estimate


@dataclass(frozen=True)
class GivenGrid:
    """What the user says of the window and the cells; what is None is found.

    Attributes
    ----------
    window : Extent or None
        In the units of the problem.
    cells : int or None
        Along the window's longer edge on the finest grid.
    """

    window: Extent | None = None
    cells: int | None = None

    @classmethod
    def of(cls, window: Sequence[Quantity] | None, cells: int | None, scale: Scale) -> GivenGrid:
        """Check what a user gives, in SI units or with its own."""
        if cells is not None:
            right = f"the number of cells along the window's longer edge, {LEAST_FINEST} or more"
            whole_number(cells, "grid", LEAST_FINEST, right=right)
            check_cost([cells] * scale.geometry.dimension, f"grid = {brief(cells)}: the window")
        return cls(None if window is None else _extent(window, scale), cells)

    def halvings(self, coarsest: int) -> int:
        """How often cells are halved from a grid of about so many along the longer edge; at least twice."""
        return 0 if self.cells is None else max(2, int(math.log2(self.cells / coarsest)))

    def start(self, coarsest: int) -> int:
        """Cells along the window's longer edge of the first grid, where one would start from so many."""
        return coarsest if self.cells is None else math.ceil(self.cells / 2 ** self.halvings(coarsest))

    def check(self, contact: Extent, cell: float, unit: float) -> None:
        """Refuse a window that a contact reaches beyond, as a coarse grid saw it (in the units of the problem)."""
        if self.window is None:
            return
        beyond = [there - edge for there, edge in zip(contact, self.window, strict=True)]
        if max(beyond) > cell:
            rear, front, side = (1e3 * unit * distance for distance in contact)
            sides = f" and {side:.4g} mm to either side" if self.window.side > 0.0 else ""
            raise InputError(
                f"window: the contact reaches about {rear:.4g} mm behind the axis, {front:.4g} mm ahead of it{sides}; "
                "give a window that leaves some space around it."
            )


def _extent(window: Sequence[Quantity], scale: Scale) -> Extent:
    names = ("rear", "front", "side")[: scale.geometry.dimension + 1]
    each = list(window) if isinstance(window, (list, tuple)) or np.ndim(window) == 1 else []
    if len(each) != len(names):
        raise InputError(f"window = {brief(window)}: must be {len(names)} lengths ({', '.join(names)}).")
    lengths = [
        to_si(length, "m", f"{name} of the window") / scale.length for length, name in zip(each, names, strict=True)
    ]
    found = Extent(*lengths, *([0.0] if len(lengths) == 2 else []))
    if not (found.rear + found.front > 0.0 and (len(lengths) == 2 or found.side > 0.0)):
        raise InputError(f"window = {brief(window)}: is empty; the front must lie ahead of the rear, the sides apart.")
    return found
