"""The numbers of a contact without units, as they are interpolated, and with those of a case again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.free.scale import Scale
    from viscofric.study.record import Record


# Name, that of its error (none is told of the centre of pressure, which is the friction's), and whether it is
# interpolated by its logarithm: front and rear may change their sign.
_COLUMNS = (
    ("friction_coefficient", "friction_error", True),
    ("indentation", "indentation_error", True),
    ("contact_area", "contact_area_error", True),
    ("max_pressure", "max_pressure_error", True),
    ("half_width", "edge_error", True),
    ("centre_of_pressure", None, True),
    ("front", "edge_error", False),
    ("rear", "edge_error", False),
)
NAMES = tuple(name for name, _, _ in _COLUMNS)
ERRORS = tuple(error for _, error, _ in _COLUMNS)
FRICTION = NAMES.index("friction_coefficient")
LOGARITHMIC = np.array([logarithmic for *_, logarithmic in _COLUMNS])


@dataclass(frozen=True, eq=False)
class Node:
    """A solved contact of a curve.

    Attributes
    ----------
    record : Record
    values, errors : (columns,) array
        In the units of its contact.
    """

    record: Any  # the same kind in all nodes of a curve
    values: Array
    errors: Array

    @classmethod
    def of(cls, record: Record, scale: Scale) -> Node:
        """Take the units off a record."""
        units = units_of(scale)
        values = np.array([getattr(record, name) for name in NAMES]) / units
        errors = np.array([0.0 if name is None else getattr(record, name) for name in ERRORS]) / units
        # A line contact has no width, and no error of it.
        return cls(record, np.where(np.isfinite(values), values, 1.0), errors)


def units_of(scale: Scale, b: float = 1.0) -> Array:
    """Units of all columns, (columns,), those of pressures b times as large."""
    length = scale.length
    return np.array(
        [scale.slope, scale.depth, scale.area, b * scale.pressure, length, length, length, length], dtype=float
    )
