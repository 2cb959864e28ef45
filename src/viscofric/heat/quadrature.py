"""Quadrature over the unit interval that singular ends, and layers next to them, do not disturb."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array

# At ±3.1 the last node is 1e-15 from its end.
_REACH = 3.1


class Nodes(NamedTuple):
    """Places in (0, 1), their distances from 1 without cancellation, and weights, (n,) each."""

    place: Array
    rest: Array
    weight: Array


@lru_cache(maxsize=8)
def unit_nodes(count: int) -> Nodes:
    """Return the nodes of the tanh-sinh rule."""
    # H. Takahasi, M. Mori, Publ. RIMS 9 (1974) 721, doi:10.2977/prims/1195192451.
    t = np.linspace(-_REACH, _REACH, count)
    e = np.exp(-np.pi * np.sinh(np.abs(t)))
    near = e / (1.0 + e)
    place, rest = np.where(t < 0.0, near, 1.0 - near), np.where(t < 0.0, 1.0 - near, near)
    return Nodes(place, rest, (t[1] - t[0]) * np.pi * np.cosh(t) * place * rest)
