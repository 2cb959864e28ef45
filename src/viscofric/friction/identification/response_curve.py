"""Friction at many speeds read from few: a curve over the speed's logarithm is smooth, and so are its derivatives.

The friction of a mode rises and falls over about a decade of speed to either side of its peak, as x/(1 + x²) does,
x = v τ/a: a hyperbolic secant of ln v.  Of all sums of hyperbolic secants through the nodes the one of least norm is
taken (kernel interpolation; H. Wendland, Scattered Data Approximation, Cambridge 2004, section 13), with which errors
fall some four times with every node per decade.  It is linear in the values at the nodes: what is read for the
friction coefficient is read for its derivatives by the same matrix.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias, Unpack

import numpy as np

from viscofric.contact.indenters.indenter import Ball, Cylinder, Indenter
from viscofric.errors import InputError
from viscofric.friction.identification.response import FrictionResponse, contacts, friction_response

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.friction.prediction import ContactSettings
    from viscofric.processes import Workers
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.units import Quantities

    Array: TypeAlias = NDArray[np.float64]

# Error of the interpolation, over the curve's largest value, with two nodes per decade, and by what it falls with each
# more; from the closed form of the line contact with one mode, whose curve is the sharpest there is.
_COARSE_ERROR, _FALL = 0.035, 3.5
_FEWEST, _MOST = 2, 12
_DECADE = math.log(10.0)
# Width of the kernel by which the curve is read over that of another that tells how much is left to the kernel.
_NARROWER = 1.5


@dataclass(frozen=True, eq=False)
class CurveResponse:
    """Friction at n speeds, read from contacts at k nodes.

    Attributes
    ----------
    response : FrictionResponse
        At the speeds; its errors are those of the nodes and of the interpolation, added up.
    nodes : FrictionResponse
        At the nodes.
    matrix : (n, k) array
        ``response.log_C = matrix @ nodes.log_C``, and likewise the friction coefficient and the other derivatives.
    interpolation_error : (n,) array
        Error estimate of the interpolation alone.
    """

    response: FrictionResponse
    nodes: FrictionResponse
    matrix: Array
    interpolation_error: Array


def friction_curve_response(
    spectrum: RetardationSpectrum,
    poisson_ratio: float,
    indenter: Indenter,
    speeds: Quantities,
    load: Quantities,
    *,
    accuracy: float = 1e-3,
    interpolation: float = 1e-3,
    workers: int | Workers = 1,
    progress: Callable[[int, int], object] | None = None,
    **settings: Unpack[ContactSettings],
) -> CurveResponse:
    """Read friction and its derivatives at many speeds from contacts at few, 5 to a decade for an error of 1e-3.

    Nodes lie at speeds that do not change as the speeds that are asked for move a little, so that as a material or its
    shift is fitted, the result stays a smooth function of both.

    Parameters
    ----------
    spectrum, poisson_ratio, indenter, speeds, load, accuracy, workers, progress, **settings
        As of `friction_response`.  For a ball and a cylinder on a half-space μ = (a0/R) Φ(v/a0), with a0 ∝ F^(1/3) and
        F^(1/2), makes one curve of all loads; any other contact is solved along a curve for each of its loads.
    interpolation : float
        Error of the interpolation that is aimed at, over the largest friction coefficient of the curve.

    Returns
    -------
    CurveResponse

    Raises
    ------
    InputError, ConvergenceError
        As `friction_response`.
    """
    velocities, forces = contacts(indenter, speeds, load)
    if not 1e-9 <= interpolation < 1.0:
        raise InputError(f"interpolation = {interpolation!r}: must be a number from 1e-9 to below 1, such as 1e-3.")
    exponent = _similarity(indenter, settings)
    if exponent is None:
        along, curve_loads, scale = np.log(velocities), forces, np.ones_like(forces)
    else:
        # One load for all, in whose contact length everything is measured.
        curve_loads = np.full_like(forces, math.exp(float(np.log(forces).mean())))
        scale = (forces / curve_loads) ** exponent
        along = np.log(velocities / scale)
    per_decade = _nodes_per_decade(interpolation)
    step = _DECADE / per_decade
    places, node_loads = [], []
    for one in np.unique(curve_loads):
        there = along[curve_loads == one]
        found = _needed(there / step)
        places.append(found)
        node_loads.append(np.full(len(found), one))
    at_nodes, loads_at_nodes = step * np.concatenate(places), np.concatenate(node_loads)
    nodes = friction_response(
        spectrum, poisson_ratio, indenter, np.exp(at_nodes), loads_at_nodes,
        accuracy=accuracy, workers=workers, progress=progress, **settings,
    )  # fmt: skip
    matrix = scale[:, None] * _matrix(along, at_nodes, curve_loads, loads_at_nodes, 1.0)
    rougher = scale[:, None] * _matrix(along, at_nodes, curve_loads, loads_at_nodes, _NARROWER)
    # What it is at most for one mode, or what the two kernels differ by.
    largest = (matrix != 0.0) * np.abs(scale[:, None] * nodes.friction)
    between = np.maximum(
        _COARSE_ERROR * _FALL ** (_FEWEST - per_decade) * largest.max(axis=1),
        np.abs((rougher - matrix) @ nodes.friction),
    )
    friction, log_speed = matrix @ nodes.friction, matrix @ nodes.log_speed
    C = matrix @ nodes.C
    response = FrictionResponse(
        speed=velocities,
        load=forces,
        friction=friction,
        error=np.abs(matrix) @ nodes.error + between,
        C=C,
        log_C=C * spectrum.C,
        log_E_inf=matrix @ nodes.log_E_inf,
        log_speed=log_speed,
        log_load=matrix @ nodes.log_load,
    )
    return CurveResponse(response, nodes, matrix, between)


def _similarity(indenter: Indenter, settings: ContactSettings) -> float | None:
    """Return by which power of the load lengths of the contact grow, where that is all it does."""
    if settings.get("layer") is not None or settings.get("window") is not None:
        return None
    if isinstance(indenter, Ball):
        return 1.0 / 3.0
    return 0.5 if isinstance(indenter, Cylinder) else None


def _nodes_per_decade(interpolation: float) -> int:
    return min(_MOST, max(_FEWEST, _FEWEST + math.ceil(math.log(_COARSE_ERROR / interpolation) / math.log(_FALL))))


def _needed(places: Array) -> Array:
    """Whole numbers around every place, and two more on either side of it."""
    below = np.floor(places)
    return np.unique(below[:, None] + np.arange(-2.0, 4.0))


def _matrix(along: Array, nodes: Array, loads: Array, node_loads: Array, narrower: float) -> Array:
    """Return the matrix from the nodes to the places: (n, k), each curve of one load by itself."""
    result = np.zeros((len(along), len(nodes)))
    for load in np.unique(loads):
        here, there = np.flatnonzero(loads == load), np.flatnonzero(node_loads == load)
        among = 1.0 / np.cosh(narrower * np.subtract.outer(nodes[there], nodes[there]))
        toward = 1.0 / np.cosh(narrower * np.subtract.outer(along[here], nodes[there]))
        result[np.ix_(here, there)] = np.linalg.solve(among, toward.T).T
    return result
