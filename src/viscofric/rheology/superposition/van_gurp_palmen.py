"""Distances of neighbouring isotherms in plots without frequency, independent of the shift factors.

Plotted as tan δ against |E*| (H. C. Booij, J. H. M. Palmen, Theoretical and Applied Rheology, 1992, 321; M. van
Gurp, J. Palmen, Rheol. Bull. 67 (1998) 5, with δ instead), isotherms that superpose lie on one curve, whatever their
shift factors are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Isotherm

#: Degree of the curve of an isotherm of two or three decades, by its number of points.
_DEGREE = ((8, 3), (5, 2), (2, 1))  # (points, degree)
#: Number of segments of the curve for distances from it; their length causes an error below 1e-4 decades.
_SEGMENTS = 40
_KNOTS = np.linspace(-1.0, 1.0, _SEGMENTS + 1)
#: Isotherms drift apart if at least this many neighbours lie to the same side of each other on the whole …
RUN = 3
#: … by more than this in sum, the difference of two isotherms that repeat to 0.02 decades …
DRIFT = 0.045  # decades
#: … and by more than this many standard errors.  A single distance counts at most as this part of the above: one faulty
#: sweep is no drift.
SURE = 6.0
LARGEST_PART = 2.0 / 3.0


@dataclass(frozen=True)
class Drift:
    """A run of isotherms that move apart to one side, which errors of single isotherms do not explain."""

    colder: float  # ends of the run, K
    warmer: float
    # Sum of the signed distances of neighbours, decades; above zero where tan δ falls with temperature at the same
    # |E*|.
    distance: float
    standard_error: float  # of the sum, decades
    neighbours: int  # pairs of neighbours in the run


@dataclass(frozen=True)
class NeighbourDistance:
    """Distance of two neighbouring isotherms in log tan δ against log |E*|."""

    colder: float  # their temperatures, K
    warmer: float
    # Mean distance at right angles to the curve, decades; above zero where the colder one has the greater tan δ.
    distance: float
    standard_error: float  # of the distance, from the scatter of each isotherm about its own smooth curve; decades
    points: int  # measured points of both isotherms within the range of the other's curve


@dataclass(frozen=True, eq=False)
class _Curve:
    """One isotherm as a smooth curve (log |E*|, log tan δ) of a parameter from −1 to 1."""

    temperature: float
    basis: Array  # (n, m)
    coefficients: Array  # (m, 2)
    inverse: Array  # (m, m)
    scatter: Array  # (2,)

    @cached_property
    def points(self) -> Array:
        """The curve at the measured parameters (n, 2)."""
        return np.asarray(self.basis @ self.coefficients)

    @cached_property
    def line(self) -> Array:
        """The curve at the ends of its segments."""
        return np.asarray(self.rows(_KNOTS) @ self.coefficients)

    @classmethod
    def of(cls, isotherm: Isotherm, log10_b: float) -> _Curve:
        decades = np.log10(isotherm.angular_frequency)
        parameter = 2.0 * (decades - decades[0]) / np.ptp(decades) - 1.0
        count = len(decades)
        degree = next(degree for points, degree in _DEGREE if count >= points)
        basis = _legendre(parameter, degree)
        size = np.log10(np.hypot(isotherm.storage_modulus, isotherm.loss_modulus)) - log10_b
        points = np.stack([size, np.log10(isotherm.loss_modulus / isotherm.storage_modulus)], axis=1)
        inverse = np.asarray(np.linalg.inv(basis.T @ basis), dtype=float)
        coefficients = inverse @ (basis.T @ points)
        freedom = max(count - degree - 1, 1)
        scatter = np.sqrt(np.sum((points - basis @ coefficients) ** 2, axis=0) / freedom)
        return cls(isotherm.temperature, basis, coefficients, inverse, scatter)

    def rows(self, parameter: Array) -> Array:
        """Return the basis at other parameters."""
        return _legendre(parameter, self.basis.shape[1] - 1)

    def variance(self, normals: Array, rows: Array) -> float:
        """Return the variance of the mean of the curve's components along normals (k, 2) at basis rows (k, m)."""
        weights = (normals[:, :, None] * rows[:, None, :]).mean(axis=0)
        return float(np.einsum("c,ci,ij,cj->", self.scatter**2, weights, self.inverse, weights))


def _legendre(x: Array, degree: int) -> Array:
    """Return Legendre polynomials up to a degree, 3 at most, in columns."""
    every = [np.ones_like(x), x, 1.5 * x**2 - 0.5, (2.5 * x**2 - 1.5) * x]
    return np.asarray(np.stack(every[: degree + 1], axis=1), dtype=float)


def neighbour_distances(isotherms: Sequence[Isotherm], log10_b: Array) -> tuple[NeighbourDistance, ...]:
    """Compare each isotherm, moduli over b, with its next warmer neighbour where they have a common range."""
    curves = [_Curve.of(isotherm, float(b)) for isotherm, b in zip(isotherms, log10_b, strict=True)]
    found = []
    for colder, warmer in pairwise(curves):
        forth, back = _distances(colder, warmer), _distances(warmer, colder)
        both = [(forth[0], forth[1]), (-back[0], back[1])]
        seen = [one for one, points in zip(both, (forth[2], back[2]), strict=True) if points]
        if seen:
            distance, error = np.mean(seen, axis=0)  # of the same noise: the two errors do not average out
            points = forth[2] + back[2]
            found.append(
                NeighbourDistance(colder.temperature, warmer.temperature, float(distance), float(error), points)
            )
    return tuple(found)


def drift(neighbours: Sequence[NeighbourDistance]) -> Drift | None:
    """Return the largest drift, or None where there is none."""
    # Errors of single isotherms cancel in the sum over a run, except for its two ends; changes with temperature add up:
    # a missing vertical shift, a second relaxation, a sample that changes. All runs are evaluated. Errors σ of single
    # isotherms make the differences of consecutive distances scatter by √6 σ, and a sum over a run by √2 σ.
    distances = np.array([pair.distance for pair in neighbours])
    single = float(np.mean(np.diff(distances) ** 2)) / 6.0 if len(distances) > 1 else 0.0
    found = None
    for first in range(len(neighbours)):
        total, distance, variance = 0.0, 0.0, 0.0
        for count, pair in enumerate(neighbours[first:], 1):
            if count > 1 and pair.colder != neighbours[first + count - 2].warmer:
                break
            total += float(np.clip(pair.distance, -LARGEST_PART * DRIFT, LARGEST_PART * DRIFT))
            distance += pair.distance
            variance += pair.standard_error**2
            largest = DRIFT if found is None else abs(found.distance)
            error = float(np.sqrt(max(variance, 2.0 * single)))
            if count >= RUN and abs(total) > DRIFT and abs(distance) > max(largest, SURE * error):
                found = Drift(neighbours[first].colder, pair.warmer, distance, error, count)
    return found


def _distances(one: _Curve, other: _Curve) -> tuple[float, float, int]:
    """Return the mean distance of one smoothed isotherm from the other, its standard error, and number of points."""
    line, points = other.line, one.points
    along = np.diff(line, axis=0)
    length = np.sum(along**2, axis=1) + 1e-300
    away = points[:, None, :] - line[None, :-1, :]
    place = np.sum(away * along, axis=2) / length
    offset = away - np.minimum(np.maximum(place, 0.0), 1.0)[..., None] * along
    nearest = np.argmin(np.sum(offset**2, axis=2), axis=1)
    each = np.arange(len(points))
    place = place[each, nearest]
    # A foot beyond an end of the other curve: no comparison.
    beside = ~(((nearest == 0) & (place < 0.0)) | ((nearest == _SEGMENTS - 1) & (place > 1.0)))
    if np.count_nonzero(beside) < 2:
        return 0.0, 0.0, 0
    tangent = along[nearest] / np.sqrt(length[nearest])[:, None]
    normals = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    normals = (normals * np.where(normals[:, 1:] < 0.0, -1.0, 1.0))[beside]
    distance = float(np.mean(np.sum(offset[each, nearest][beside] * normals, axis=1)))
    feet = other.rows((_KNOTS[nearest] + place * (_KNOTS[1] - _KNOTS[0]))[beside])
    variance = one.variance(normals, one.basis[beside]) + other.variance(normals, feet)
    return distance, float(np.sqrt(variance)), int(np.count_nonzero(beside))
