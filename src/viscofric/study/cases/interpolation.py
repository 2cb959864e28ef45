"""Interpolation between solved contacts: local polynomials and their errors, of numbers without units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array, Mask
    from viscofric.contact.free.scale import Scale
    from viscofric.study.cases.record import Record


#: Nodes that a polynomial goes through, and on either side of its interval.
MOST, BESIDE = 6, 3
# By what their differences are multiplied for an error that holds in 95 % of all places of steep curves, too.
_CAUTION = 2.0
# Where polynomials are compared, from one end of an interval to the other.
_WITHIN = np.array([0.15, 0.35, 0.5, 0.65, 0.85])


class Stencil(NamedTuple):
    """Nodes of the polynomials of one interval.

    Attributes
    ----------
    interval : (int, int)
        Its ends.
    nodes : tuple of int
        Ascending.
    fewer : tuple of tuples of int
        Rows of those that polynomials of lower degree go through, whose differences tell what may be left out.
    """

    interval: tuple[int, int]
    nodes: tuple[int, ...]
    fewer: tuple[tuple[int, ...], ...]


def stencil(low: int, high: int, known: Sequence[int], furthest: int) -> Stencil:
    """Choose the nodes for an interval.

    They are no closer to each other than the interval is long, as where a curve was refined nearby: closer ones would
    tell little more of it, and their errors would be magnified.

    Parameters
    ----------
    low, high : int
        Ends of the interval, both of them known.
    known : sequence of int
        All nodes, ascending.
    furthest : int
        Distance of neighbours beyond which nothing is known between them.
    """
    least = high - low
    below = _walk([node for node in reversed(known) if node < low], low, -1, least, furthest)
    above = _walk([node for node in known if node > high], high, 1, least, furthest)
    # Where there are few on one side, there are more on the other.
    left = min(len(below), max(BESIDE, MOST - len(above)))
    right = min(len(above), MOST - left)
    nodes = (*reversed(below[:left]), *above[:right])
    centre = 0.5 * (low + high)
    near = sorted(range(len(nodes)), key=lambda row: (abs(nodes[row] - centre), row))
    inner = tuple(sorted(near[: max(1, len(nodes) - 2)]))
    every = tuple(range(len(nodes)))
    return Stencil((low, high), nodes, (inner, every[1:], every[:-1]))


def _walk(beyond: list[int], first: int, toward: int, least: int, furthest: int) -> list[int]:
    found = [first]
    for node in beyond:
        away = toward * (node - found[-1])
        if away > furthest or len(found) == MOST - 1:
            break
        if away >= least:
            found.append(node)
    return found


def weights(nodes: Array, places: Array) -> Array:
    """Lagrange's weights of nodes, (nodes,), at places, (places,): (places, nodes)."""
    away = places[:, None] - nodes
    apart = nodes[:, None] - nodes
    result = np.ones((len(places), len(nodes)))
    for row in range(len(nodes)):
        others = np.arange(len(nodes)) != row
        result[:, row] = np.prod(away[:, others] / apart[row, others], axis=1)
    return result


class Interpolated(NamedTuple):
    """Values between nodes.

    Attributes
    ----------
    values : (places, columns) array
    from_nodes : (places, columns) array
        What the errors of the nodes make of them.
    between : (places, columns) array
        How much polynomials of lower degree differ, at most within the interval: at one place they may meet.
    """

    values: Array
    from_nodes: Array
    between: Array


def interpolate(
    chosen: Stencil, step: float, places: Array, values: Array, errors: Array, logarithmic: Mask
) -> Interpolated:
    """Interpolate several quantities at once.

    Parameters
    ----------
    chosen : Stencil
    step : float
        Length of one step between integers.
    places : (places,) array
        Within the interval.
    values, errors : (nodes, columns) array
        At the stencil's nodes.
    logarithmic : (columns,) array of bool
        Which are to be interpolated by their logarithms, where all of theirs are above zero.
    """
    nodes = step * np.array(chosen.nodes, dtype=float)
    logarithmic = logarithmic & np.all(values > 0.0, axis=0)
    unit = np.where(logarithmic, values, 1.0)
    shown = np.where(logarithmic, np.log(unit), values)
    low, high = (step * end for end in chosen.interval)
    looked_at = low + (high - low) * _WITHIN
    inside = weights(nodes, looked_at) @ shown
    fewer = [list(rows) for rows in chosen.fewer]
    differences = [inside - weights(nodes[rows], looked_at) @ shown[rows] for rows in fewer]
    apart = _CAUTION * np.abs(differences).max(axis=(0, 1))
    full = weights(nodes, places)
    found = full @ shown
    found = np.where(logarithmic, np.exp(found), found)
    # A difference of logarithms is a relative one.
    size = np.where(logarithmic, found, 1.0)
    return Interpolated(found, size * np.sqrt(full**2 @ (errors / unit) ** 2), size * apart)


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
