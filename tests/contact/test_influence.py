"""Influence coefficients of one cell against brute-force quadrature, closed forms and limits."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import gammainc

from contact.dense_reference import memory_panels, square_potential
from viscofric.contact.influence.memory_rules import ORDER, lattice_interpolation, product_weights
from viscofric.contact.influence.mixtures import memory_influence
from viscofric.contact.influence.potentials import HalfSpaceCell, cell_potential

WINDOW = (32, 24)
# Where the loaded cell lies: under the point, just behind and ahead of it, beside it, near and far.
OFFSETS = [
    (0, 0), (-1, 0), (1, 0), (0, 1), (-1, 1), (-2, 0), (4, 3), (-31, 0), (-20, 16), (31, 23),
]  # fmt: skip
MEMORY_LENGTHS = [1e-8, 1e-3, 0.03, 0.4, 3.0, 100.0, 1e6, 1e10]


def potential_of_square(x: float, y: float) -> float:
    """∫∫ 1/r over the unit square by nested elementary integrals; a 6 × 6 Gauss rule far away."""
    if math.hypot(x, y) > 12.0:
        points, weights = np.polynomial.legendre.leggauss(6)
        distance = np.hypot(x - 0.5 * points[:, None], y - 0.5 * points)
        return float(0.25 * weights @ (1.0 / distance) @ weights)
    total = 0.0
    for a, b, sign in (
        (x + 0.5, y + 0.5, 1.0), (x + 0.5, y - 0.5, -1.0), (x - 0.5, y + 0.5, -1.0), (x - 0.5, y - 0.5, 1.0),
    ):  # fmt: skip
        for first, second in ((a, b), (b, a)):
            if first != 0.0:
                total += sign * first * math.asinh(second / abs(first))
    return total


def adaptively_remembered_potential(x: float, y: float, memory_length: float) -> float:
    """∫_0^∞ e^(−z) L(x + λz, y) dz by adaptive quadrature, graded to every singular point."""
    end = 40.0 * memory_length  # the rest is 4e-18 of the whole
    decades = 10.0 ** np.arange(-10.0, 12.0)
    points = {0.0, end, *decades, *(memory_length * np.array([0.01, 0.1, 1.0, 4.0, 12.0]))}
    for edge in (-x - 0.5, -x + 0.5):
        points |= {edge, *(edge + decades), *(edge - decades)}
    inside = sorted(point for point in points if 0.0 <= point <= end)
    pieces = [
        quad(
            lambda s: math.exp(-s / memory_length) / memory_length * potential_of_square(x + s, y),
            start,
            stop,
            epsabs=0.0,
            epsrel=1e-12,
        )[0]
        for start, stop in pairwise(inside)
    ]
    return math.fsum(pieces)


def remembered_potential(x: float, y: float, memory_length: float) -> float:
    """∫_0^∞ e^(−z) L(x + λz, y) dz by Gauss points on panels, graded likewise; a hundred times quicker."""
    edges = memory_panels(x, memory_length, memory_length)
    points, weights = np.polynomial.legendre.leggauss(12)
    half = 0.5 * np.diff(edges)[:, None]
    s = (edges[:-1, None] + half * (1.0 + points)).ravel()
    faded = (half * weights).ravel() * np.exp(-s / memory_length) / memory_length
    return float(faded @ square_potential(x + s, np.full_like(s, y)))


@pytest.mark.filterwarnings("ignore::scipy.integrate.IntegrationWarning")  # pieces at round-off level
@pytest.mark.parametrize(("x", "y", "memory_length"), [(0.0, 0.0, 1e-3), (-1.3, 1.0, 3.0), (4.0, 3.0, 100.0)])
def test_quadrature_by_panels_agrees_with_adaptive_quadrature(x: float, y: float, memory_length: float) -> None:
    adaptive = adaptively_remembered_potential(x, y, memory_length)
    assert remembered_potential(x, y, memory_length) == pytest.approx(adaptive, rel=1e-10)


@pytest.mark.parametrize(
    ("memory_length", "shifts"),
    [*((one, (0.0,)) for one in MEMORY_LENGTHS), *((one, (0.1, 0.37, 0.5)) for one in (1e-6, 0.1, 1.0, 1e3))],
)
def test_memory_at_and_behind_the_cell_centres_agrees_with_quadrature(
    memory_length: float, shifts: tuple[float, ...]
) -> None:
    nx, ny = WINDOW
    for shift in shifts:
        influence = memory_influence(WINDOW, np.ones((1, 1)), np.array([memory_length]), shift)[0]
        computed = np.array([influence[i + nx - 1, j] for i, j in OFFSETS])
        expected = np.array([remembered_potential(i - shift, j, memory_length) for i, j in OFFSETS])
        # The module promises 1e-11 of the largest value; 1e-9 of each value leaves room for the smallest of them.
        np.testing.assert_allclose(computed, expected, rtol=1e-9)
        assert influence.shape == (2 * nx - 1, ny)


def test_rows_with_coarser_rules_agree_with_quadrature() -> None:
    # The rules change at rows 3 and 18, those that are transformed together at row 48: look on both sides of each.
    shape = (4, 70)
    memory_lengths = np.array([0.05, 1.0, 300.0])
    for m, memory_length in enumerate(memory_lengths):
        influence = memory_influence(shape, np.eye(3), memory_lengths)[m]
        for i, j in ((0, 2), (-3, 3), (1, 17), (1, 18), (-2, 47), (-2, 48)):
            expected = remembered_potential(i, j, memory_length)
            # As above: 1e-11 promised, two digits in hand.
            assert influence[i + 3, j] == pytest.approx(expected, rel=1e-9)


def test_far_series_joins_the_closed_form() -> None:
    angle = np.linspace(0.0, 0.5 * np.pi, 181)
    inside, outside = 20.0 * (1.0 - 1e-12), 20.0 * (1.0 + 1e-12)
    closed_form = cell_potential(inside * np.cos(angle), inside * np.sin(angle))
    series = cell_potential(outside * np.cos(angle), outside * np.sin(angle))
    # The first term left out is of the order of (1/2)⁶/20⁶ ≈ 2e-10 times its small coefficient.
    np.testing.assert_allclose(series, closed_form, rtol=1e-10)


def test_potential_at_the_centre_of_a_square() -> None:
    centre = cell_potential(np.zeros(1), np.zeros(1))[0]
    assert centre == pytest.approx(4.0 * math.log(1.0 + math.sqrt(2.0)), rel=1e-15)  # round-off only


def test_potential_falls_off_like_a_point_load() -> None:
    x = np.array([1e3, 1e6, 1e12])
    # The square's second moment leaves 1/(24 r²) = 4e-8 at the nearest point.
    np.testing.assert_allclose(cell_potential(x, np.zeros(3)) * x, 1.0, rtol=5e-8)


def test_split_mode_is_one_mode() -> None:
    whole = memory_influence((12, 12), np.array([[3.0]]), np.array([2.0]))
    split = memory_influence((12, 12), np.array([[1.0, 0.5, 1.5]]), np.full(3, 2.0))
    np.testing.assert_allclose(split, whole, rtol=1e-14)  # the same sum in another order


def test_mode_without_compliance_changes_nothing() -> None:
    alone = memory_influence((12, 12), np.array([[1.0]]), np.array([2.0]))
    # A long companion mode lengthens the common tail, which is added in another order.
    joined = memory_influence((12, 12), np.array([[1.0, 0.0, 0.0]]), np.array([2.0, 1e-6, 1e6]))
    np.testing.assert_allclose(joined, alone, rtol=1e-13)


def test_mixtures_are_linear_in_the_modes() -> None:
    memory_lengths = np.array([0.1, 5.0, 1e4])
    single = memory_influence((10, 9), np.eye(3), memory_lengths)
    mixed = memory_influence((10, 9), np.array([[1.0, 2.0, 3.0], [0.5, 0.0, -1.0]]), memory_lengths)
    np.testing.assert_allclose(mixed[0], single[0] + 2.0 * single[1] + 3.0 * single[2], rtol=1e-14)
    np.testing.assert_allclose(mixed[1], 0.5 * single[0] - single[2], rtol=1e-13)  # one digit cancels


def test_slow_motion_is_relaxed() -> None:
    nx, ny = WINDOW
    elastic = cell_potential(np.arange(-(nx - 1.0), nx)[:, None], np.arange(float(ny)))
    slow = memory_influence(WINDOW, np.ones((1, 1)), np.array([1e-8]))[0]
    # K − L = λ ∂L/∂x + …, and |∂L/∂x| < 2.7 L at cell centres: 1e-8 of memory, a little more.
    np.testing.assert_allclose(slow, elastic, rtol=3e-8)


def test_fast_motion_has_no_time_to_creep() -> None:
    memory_length = 1e10
    fast = memory_influence(WINDOW, np.ones((1, 1)), np.array([memory_length]))[0]
    # From far ahead comes ∫_{1/λ} e^(−z) dz/(λz) ≈ ln(λ)/λ; the cell itself adds a few times 1/λ.
    assert fast.max() < 2.0 * math.log(memory_length) / memory_length
    assert fast.min() > 0.0


def test_memory_lies_ahead() -> None:
    nx, _ = WINDOW
    influence = memory_influence(WINDOW, np.ones((1, 1)), np.array([3.0]))[0]
    behind, ahead = influence[: nx - 1][::-1], influence[nx:]
    # A point behind the loaded cell has felt it pass, a point ahead has not felt it yet.
    assert np.all(behind > ahead)


def test_recursion_from_cell_to_cell_loses_nothing_to_the_window() -> None:
    small = memory_influence((6, 5), np.ones((1, 1)), np.array([25.0]))[0]
    large = memory_influence((40, 30), np.ones((1, 1)), np.array([25.0]))[0]
    # Two starts of the recursion, six and forty cells ahead, each right to 1e-11.
    np.testing.assert_allclose(large[40 - 6 : 40 + 5, :5], small, rtol=1e-10)


def test_wide_window_agrees_with_quadrature() -> None:
    """Rows and places on both sides of where the interpolation takes over from the finer rules, up to the corners."""
    nx, ny = 80, 60
    memory_lengths = np.array([1e-6, 0.1, 2.0, 70.0, 1e5])
    found = memory_influence((nx, ny), np.eye(5), memory_lengths)
    for m, memory_length in enumerate(memory_lengths):
        for i, j in ((-79, 0), (-40, 3), (-26, 0), (-25, 23), (-25, 24), (0, 24), (24, 0), (26, 2), (79, 0), (79, 59)):
            expected = remembered_potential(i, j, memory_length)
            assert found[m, i + nx - 1, j] == pytest.approx(expected, rel=1e-9)  # as above


def test_instant_displacement_joins_the_memory() -> None:
    nx, ny = 30, 28
    lengths, mixtures = np.array([0.3, 40.0]), np.array([[1.0, 2.0], [0.0, 0.5]])
    elastic = cell_potential(np.arange(-(nx - 1.0), nx)[:, None] - 0.2, np.arange(float(ny)))
    both = memory_influence((nx, ny), mixtures, lengths, 0.2, instant=np.array([3.0, -1.0]))
    memory = memory_influence((nx, ny), mixtures, lengths, 0.2)
    np.testing.assert_allclose(both[0], memory[0] + 3.0 * elastic, rtol=1e-13)
    np.testing.assert_allclose(both[1], memory[1] - elastic, rtol=1e-12, atol=1e-14)
    alone = memory_influence((nx, ny), np.zeros((1, 0)), np.zeros(0), 0.2, instant=np.ones(1))
    np.testing.assert_allclose(alone[0], elastic, rtol=1e-13)


def test_product_rule_integrates_fading_polynomials() -> None:
    """∫_0^1 ε e^(−ε s) s^k ds = k!/ε^k P(k + 1, ε), on both sides of where the formula changes."""
    rates = np.array([1e-12, 1e-3, 0.11, 0.12, 0.7, 1.11, 1.12, 2.87, 2.88, 5.0, 31.9, 44.9, 45.1, 1e3, 1e10])
    points = 0.5 * (np.polynomial.legendre.leggauss(ORDER)[0] + 1.0)
    for k in range(ORDER):
        found = product_weights(rates) @ points**k
        expected = math.factorial(k) / rates**k * gammainc(k + 1, rates)
        # Round-off of sums of terms as large as the integral without s^k.
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=3e-13 * rates.clip(max=1.0).max())


def test_lattice_interpolation_is_exact_for_polynomials() -> None:
    nodes, matrix = lattice_interpolation()
    points = 0.5 * (np.polynomial.legendre.leggauss(ORDER)[0] + 1.0)
    polynomial = np.polynomial.Polynomial(np.random.default_rng(5).standard_normal(ORDER) / 8.0 ** np.arange(ORDER))
    np.testing.assert_allclose(matrix @ polynomial(nodes), polynomial(points), rtol=1e-12)  # round-off


@pytest.mark.parametrize("aspect", [0.2, 0.5, 3.0])
def test_rectangle_is_a_row_of_smaller_ones(aspect: float) -> None:
    x, y = (
        np.array([0.0, 0.3, 1.0, 7.0, 40.0, -90.0, 3.0, 500.0]),
        np.array([0.0, 0.4, 2.0, 30.0, -11.0, 90.0, 70.0, 0.0]),
    )
    thirds = [cell_potential(3.0 * x + side, 3.0 * y, 3.0 * aspect) / 3.0 for side in (-1.0, 0.0, 1.0)]
    # Far away each is right to 1e-10.
    np.testing.assert_allclose(cell_potential(x, y, aspect), sum(thirds), rtol=2e-10)


@pytest.mark.parametrize("aspect", [0.2, 0.5, 3.0])
def test_memory_on_rectangles_is_the_sum_of_that_on_smaller_cells(aspect: float) -> None:
    """A cell of three by one thirds of itself, along the motion, and looked at in the middle of the middle one."""
    coarse = memory_influence((8, 30), np.ones((1, 1)), np.array([1.7]), potential=HalfSpaceCell(aspect))[0]
    fine = memory_influence(
        (26, 30),
        np.ones((1, 1)),
        np.array([5.1]),
        potential=HalfSpaceCell(3.0 * aspect),
    )[0]
    places = 3 * np.arange(-7, 8) + 25
    summed = (fine[places - 1] + fine[places] + fine[places + 1]) / 3.0
    np.testing.assert_allclose(coarse, summed, rtol=1e-9)  # as for squares
