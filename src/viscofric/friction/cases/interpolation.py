"""Interpolation between solved contacts: local polynomials and their errors, of dimensionless numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from viscofric.arrays import Array, Mask, lagrange

#: Column of friction in the values of a node.
FRICTION = 0
#: Largest error of friction due to interpolation, as a part of the accuracy.
SHARE = 0.25
#: Nodes that a polynomial goes through, and on either side of its interval.
MOST, BESIDE = 6, 3
# Factor on their differences, for an error that holds in 95 % of all places also on steep curves.
_CAUTION = 2.0
#: Largest distance of connected nodes, in steps.
FURTHEST = 64
# Where polynomials are compared, from one end of an interval to the other.
_WITHIN = np.array([0.15, 0.35, 0.5, 0.65, 0.85])


class Stencil(NamedTuple):
    """Nodes of the polynomials of one interval."""

    interval: tuple[int, int]  # its ends
    nodes: tuple[int, ...]  # ascending
    fewer: tuple[tuple[int, ...], ...]  # rows of the polynomials of lower degree, which estimate the truncation error


def stencil(low: int, high: int, known: Sequence[int]) -> Stencil:
    """Choose the nodes of the polynomial over an interval whose two ends are known."""
    # Their distances are not below the length of the interval, where a curve was refined nearby: closer nodes would add
    # little and magnify their errors.
    least = high - low
    below = _walk([node for node in reversed(known) if node < low], low, -1, least)
    above = _walk([node for node in known if node > high], high, 1, least)
    # If there are few on one side, take more on the other.
    left = min(len(below), max(BESIDE, MOST - len(above)))
    right = min(len(above), MOST - left)
    nodes = (*reversed(below[:left]), *above[:right])
    centre = 0.5 * (low + high)
    near = sorted(range(len(nodes)), key=lambda row: (abs(nodes[row] - centre), row))
    inner = tuple(sorted(near[: max(1, len(nodes) - 2)]))
    every = tuple(range(len(nodes)))
    return Stencil((low, high), nodes, (inner, every[1:], every[:-1]))


def _walk(beyond: list[int], first: int, toward: int, least: int) -> list[int]:
    found = [first]
    for node in beyond:
        away = toward * (node - found[-1])
        if away > FURTHEST or len(found) == MOST - 1:
            break
        if away >= least:
            found.append(node)
    return found


class Interpolated(NamedTuple):
    """Values between nodes, each array (places, columns)."""

    values: Array
    from_nodes: Array  # errors due to those of the nodes
    between: Array  # largest difference from polynomials of lower degree within the interval, not at the place alone


def interpolate(
    chosen: Stencil, step: float, places: Array, values: Array, errors: Array, logarithmic: Mask
) -> Interpolated:
    """Interpolate several quantities at places (places,) within the stencil's interval."""
    # `values` and `errors` are (nodes, columns); `step` is the length of one step between integers. `logarithmic`
    # columns are interpolated by their logarithms if all values are positive.
    nodes = step * np.array(chosen.nodes, dtype=float)
    logarithmic = logarithmic & np.all(values > 0.0, axis=0)
    unit = np.where(logarithmic, values, 1.0)
    shown = np.where(logarithmic, np.log(unit), values)
    low, high = (step * end for end in chosen.interval)
    looked_at = low + (high - low) * _WITHIN
    inside = lagrange(nodes, looked_at) @ shown
    fewer = [list(rows) for rows in chosen.fewer]
    differences = [inside - lagrange(nodes[rows], looked_at) @ shown[rows] for rows in fewer]
    apart = _CAUTION * np.abs(differences).max(axis=(0, 1))
    full = lagrange(nodes, places)
    found = full @ shown
    found = np.where(logarithmic, np.exp(found), found)
    # A difference of logarithms is a relative one.
    size = np.where(logarithmic, found, 1.0)
    return Interpolated(found, size * np.sqrt(full**2 @ (errors / unit) ** 2), size * apart)


@dataclass(frozen=True, eq=False)
class Node:
    """A solved contact of a curve."""

    record: Any  # the same kind in all nodes of a curve
    values: Array  # (columns,), in the units of its contact
    errors: Array  # (columns,)


class Between(NamedTuple):
    """The cases between two neighbouring nodes of a curve, interpolated."""

    cases: list[int]  # their numbers in the family
    nodes: list[tuple[float, Any]]  # s and record of each node of the polynomial
    ends: tuple[Any, Any]  # records of the two neighbouring nodes
    found: Interpolated  # a row for each case

    @property
    def shared(self) -> dict[str, Any]:
        """What records of the cases have in common: the largest residuals of the ends, and no cells and products."""
        energy = max((end.energy_balance for end in self.ends), key=abs)
        complementarity = max(end.complementarity for end in self.ends)
        residuals = {"energy_balance": energy, "complementarity": complementarity}
        return residuals | {"cells": 0, "products": 0, "interpolated": True}
