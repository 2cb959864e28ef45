"""A small dense contact solver that shares nothing with viscofric.contact: a second opinion for the tests.

Its own influence coefficients (Eq. 8 by panel-wise Gauss quadrature, 1/r over a cell by logarithms near and
by a product Gauss rule far away) and its own complementarity algorithm (block principal pivoting with LU
factorisations of the bordered matrix, symmetric half in y).  Made for 16 to 40 cells across; not quick.

`dense_friction` is the function for everyday use.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

Array = NDArray[np.float64]

_GAUSS_POINTS, _GAUSS_WEIGHTS = leggauss(12)
_FADED = 42.0  # e^-42 is nothing in double precision
_SQUARE_POINTS, _SQUARE_WEIGHTS = leggauss(4)


def square_potential(x: Array, y: Array) -> Array:
    """∫∫ 1/r over the unit square around the origin, at (x, y) in its plane."""
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    # 4 × 4 Gauss points are right to better than 1e-10 from ten sides on; logarithms lose digits there.
    far = x * x + y * y > 100.0
    result = np.empty(x.shape)
    xf, yf = x[far], y[far]
    total = np.zeros(xf.shape)
    for s, a in zip(_SQUARE_POINTS, _SQUARE_WEIGHTS, strict=True):
        for t, b in zip(_SQUARE_POINTS, _SQUARE_WEIGHTS, strict=True):
            total += 0.25 * a * b / np.sqrt(np.square(xf - 0.5 * s) + np.square(yf - 0.5 * t))
    result[far] = total
    result[~far] = _square_potential_by_logarithms(x[~far], y[~far])
    return result


def _square_potential_by_logarithms(x: Array, y: Array) -> Array:
    def along(a: Array, low: Array, high: Array) -> Array:
        # a ∫ db/√(a² + b²) = a ln[(high + r_high)/(low + r_low)], both signs of b without cancellation
        with np.errstate(divide="ignore", invalid="ignore"):
            both = 2.0 * np.log(np.abs(a))
            ends = [
                np.where(b >= 0.0, log_sum, both - log_sum)
                for b in (low, high)
                for log_sum in [np.log(np.abs(b) + np.sqrt(a * a + b * b))]
            ]
            return np.where(a == 0.0, 0.0, a * (ends[1] - ends[0]))

    east, west, north, south = x + 0.5, x - 0.5, y + 0.5, y - 0.5
    return along(east, south, north) - along(west, south, north) + along(north, west, east) - along(south, west, east)


def memory_coefficients(nx: int, ny: int, strengths: Array, memory_lengths: Array) -> Array:
    """Σ c_m ∫_0^∞ e^(−z) L(x + λ_m z, y) dz at x = −(nx−1) … nx−1 and y = 0 … ny−1 in cells, λ in cells."""
    rows = np.arange(float(ny))
    result = np.zeros((2 * nx - 1, ny))
    if len(memory_lengths) == 0:
        return result
    for i, x in enumerate(np.arange(-(nx - 1.0), nx)):
        edges = memory_panels(x, float(np.min(memory_lengths)), float(np.max(memory_lengths)))
        half = 0.5 * np.diff(edges)[:, None]
        s = (edges[:-1, None] + half * (1.0 + _GAUSS_POINTS)).ravel()
        memory = (strengths / memory_lengths) @ np.exp(-s / memory_lengths[:, None])
        result[i] = ((half * _GAUSS_WEIGHTS).ravel() * memory) @ square_potential(x + s[:, None], rows)
    return result


def memory_panels(x: float, shortest: float, longest: float) -> Array:
    """Break points in s = λz, for all modes: they crowd at zero and at the loaded cell's edges.

    A panel is no longer than 0.8 times its distance from zero, so that a mode has either not faded much along it or
    has faded before it.
    """
    end = _FADED * longest
    # Gauss's points miss 1e-4 h² of h ln h over the panels of h = 1e-6 that end at a singular point.
    graded = min(0.5, shortest) * 1.8 ** np.arange(-24.0, np.log(2.0 * end / min(0.5, shortest)) / np.log(1.8) + 2.0)
    edges = [np.array([0.0, end])]
    for singular in (0.0, -x - 0.5, -x + 0.5):
        edges += [np.array([singular]), singular + graded, singular - graded]
    points = np.unique(np.concatenate(edges))
    return np.concatenate([[0.0], points[(points > 0.0) & (points < end)], [end]])


def displacement_coefficients(
    nx: int, ny: int, spacing: float, glassy: float, compliances: Array, memory_lengths: Array
) -> Array:
    """Displacement at offset (i, j) cells from a cell under unit pressure; compliances include (1 − ν²)."""
    x, y = np.arange(-(nx - 1.0), nx)[:, None], np.arange(float(ny))
    total = glassy * square_potential(x, y)
    total += memory_coefficients(nx, ny, np.asarray(compliances), np.asarray(memory_lengths) / spacing)
    return total * spacing / np.pi


def displacement_matrix(coefficients: Array, nx: int, ny: int) -> Array:
    """Full matrix (nx ny, nx ny) of displacements at cells (rows) under pressures on cells (columns)."""
    i, j = (index.ravel() for index in np.indices((nx, ny)))
    return coefficients[i[:, None] - i + nx - 1, np.abs(j[:, None] - j)]


@dataclass(frozen=True, eq=False)
class DenseContact:
    """Pressure on the grid, indentation, and the largest violation of the conditions (both signs)."""

    pressure: Array
    indentation: float
    violation: float


def solve_dense_contact(matrix: Array, height: Array, total: float) -> DenseContact:
    """Find p ≥ 0, w = A p + h − δ ≥ 0, p·w = 0, Σ p = total by block principal pivoting.

    All wrongly classified cells change sides at once; where that does not help ten times in a row, only the
    last of them does (Murty), which cannot cycle.
    """
    size = len(height)
    loaded = height <= np.quantile(height, 0.3)
    fewest, patience = size + 1, 10
    for _ in range(20 * size):
        inside = np.flatnonzero(loaded)
        bordered = np.ones((len(inside) + 1, len(inside) + 1))
        bordered[:-1, :-1] = matrix[np.ix_(inside, inside)]
        bordered[:-1, -1] = -1.0
        bordered[-1, -1] = 0.0
        answer = np.linalg.solve(bordered, np.append(-height[inside], total))
        pressure = np.zeros(size)
        pressure[inside], indentation = answer[:-1], float(answer[-1])
        gap = matrix @ pressure + height - indentation
        gap[inside] = 0.0
        wrong = np.flatnonzero((loaded & (pressure < 0.0)) | (~loaded & (gap < -1e-13 * abs(indentation))))
        if len(wrong) == 0:
            return DenseContact(pressure, indentation, max(0.0, -float(gap.min())))
        if len(wrong) < fewest:
            fewest, patience = len(wrong), 10
        elif patience > 0:
            patience -= 1
        else:
            wrong = wrong[-1:]
        loaded[wrong] = ~loaded[wrong]
        if not loaded.any():
            loaded[np.argmin(height)] = True
    raise RuntimeError("block pivoting did not end")


def _half_matrix(coefficients: Array, nx: int, half: int) -> Array:
    """Matrix on the half y > 0 of a window symmetric in y: each cell carries its mirror image along."""
    i, j = (index.ravel() for index in np.indices((nx, half)))
    along = i[:, None] - i + nx - 1
    return coefficients[along, np.abs(j[:, None] - j)] + coefficients[along, j[:, None] + j + 1]


@dataclass(frozen=True, eq=False)
class DenseBall:
    """A dense ball contact in Hertz units of E0: μR/a0 and δR/a0²."""

    friction: float
    indentation: float


def _solve_ball(
    rear: float, front: float, side: float, cells: int, material: tuple[float, Array, Array]
) -> tuple[DenseBall, tuple[float, float, float]]:
    spacing = max(rear + front, 2.0 * side) / cells
    behind, ahead, half = (int(np.ceil(edge / spacing - 1e-9)) for edge in (rear, front, side))
    nx = behind + ahead
    x = spacing * (np.arange(-behind, ahead) + 0.5)
    y = spacing * (np.arange(half) + 0.5)
    matrix = _half_matrix(displacement_coefficients(nx, 2 * half, spacing, *material), nx, half)
    height = 0.5 * (x[:, None] ** 2 + y**2).ravel()
    load = 4.0 / 3.0
    contact = solve_dense_contact(matrix, height, 0.5 * load / spacing**2)
    pressure = contact.pressure.reshape(nx, half)
    friction = 2.0 * spacing**2 * float(x @ pressure.sum(axis=1)) / load
    along, across = x[pressure.any(axis=1)], y[pressure.any(axis=0)]
    extent = (
        0.5 * spacing - float(along.min()),
        0.5 * spacing + float(along.max()),
        0.5 * spacing + float(across.max()),
    )
    touches = pressure[0].any() or pressure[-1].any() or pressure[:, -1].any()
    if touches:
        grown = 0.2 * max(rear + front, 2.0 * side)
        return _solve_ball(rear + grown, front + grown, side + grown, cells, material)
    return DenseBall(friction, contact.indentation), extent


def dense_friction(
    E0: float,
    E_inf: float,
    C: Array,
    tau: Array,
    poisson_ratio: float,
    ball_radius: float,
    load: float,
    speed: float,
    cells: int = 32,
) -> tuple[float, float]:
    """Friction coefficient and indentation (m) of a ball in steady motion, all arguments in SI units.

    With 32 cells along the contact, expect an error of about 1 % where the memory lengths are comparable with
    the contact or longer, and more at low speed.
    """
    a0 = (3.0 * load * ball_radius * (1.0 - poisson_ratio**2) / (4.0 * E0)) ** (1.0 / 3.0)
    material = (E0 / E_inf, E0 * np.asarray(C), speed * np.asarray(tau) / a0)
    rear = front = side = 1.3
    coarse = 16
    for _ in range(12):
        ball, extent = _solve_ball(rear, front, side, coarse, material)
        margin = 1.5 / coarse * max(extent[0] + extent[1], 2.0 * extent[2])
        smaller = tuple(edge + margin for edge in extent)
        settled = max(smaller[0] + smaller[1], 2.0 * smaller[2]) > 0.8 * max(rear + front, 2.0 * side)
        rear, front, side = smaller
        if settled:
            break
    ball, _ = _solve_ball(rear, front, side, cells, material)
    return ball.friction * a0 / ball_radius, ball.indentation * a0**2 / ball_radius
