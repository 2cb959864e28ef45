"""Line contact in plane strain: its kernel, Hunter's closed form, limits, energy balance, what it cannot be asked."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from gallery import (
    BALL_RADIUS,
    CYLINDER_LOAD,
    HERTZ_RADIUS,
    POISSON_RATIO,
    RUBBER_MODULUS,
    SPEED,
    CylinderProblem,
    cylinder_on_standard_linear_solid,
    cylinder_problem,
)
from marks import apart, slow
from refusals import refused
from viscofric.contact.free.grids import Grid
from viscofric.contact.indenters.height_map import Profile
from viscofric.contact.indenters.shapes import Cylinder
from viscofric.contact.influence.line import line_memory_influence, scaled_exponential_integral, strip_potential
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.contact.operators.half_space import LineOperator
from viscofric.contact.reference import HunterContact, high_speed_line_friction, hunter_line
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.rheology.spectra.retardation import RetardationSpectrum

SLS = cylinder_on_standard_linear_solid(10.0, 1.0)
SLOPE = HERTZ_RADIUS / BALL_RADIUS  # a0/R


# --- kernel ---------------------------------------------------------------------------------------


def test_strip_potential_is_the_integral_of_the_logarithm() -> None:
    for x in (0.0, 0.3, 0.5, 1.0, -7.25):
        value, _ = quad(lambda s, x=x: -math.log(abs(x - s)), -0.5, 0.5, points=[min(max(x, -0.5), 0.5)], epsabs=1e-12)
        assert strip_potential(np.array([x]))[0] == pytest.approx(value, abs=1e-10)  # the quadrature's own error


@pytest.mark.parametrize("memory_length", [0.03, *slow(0.9, 1.1, 40.0)])
def test_memory_is_the_faded_logarithm(memory_length: float) -> None:
    """K by the integral that defines it, on both sides of the loaded cell and on its edge."""
    places = np.array([-60.0, -3.0, -1.0, -0.5, 0.0, 0.5, 1.0, 8.0])
    found, _ = line_memory_influence(places, memory_length)
    for x, value in zip(places, found, strict=True):
        kinks = sorted(z for z in ((-0.5 - x) / memory_length, (0.5 - x) / memory_length) if 0.0 < z < 45.0)
        ends = [0.0, *kinks, *(1.0 + np.arange(45.0))[1.0 + np.arange(45.0) > max([0.0, *kinks])]]
        parts = [
            quad(
                lambda z, x=x: math.exp(-z) * strip_potential(np.array([x + memory_length * z]))[0],
                *pair,
                epsabs=1e-12,
                limit=200,
            )[0]
            for pair in pairwise(ends)
        ]
        assert value == pytest.approx(sum(parts), abs=1e-8)  # quadrature across the logarithms of the kinks


@pytest.mark.parametrize("memory_length", [1e-8, 1e-4, 0.1, 1.0, 1e3, 1e6, 1e10])
def test_memory_fades_from_cell_to_cell(memory_length: float) -> None:
    """K(x) = ∫_0^1 ε e^(−εs) Λ(x + s) ds + e^(−ε) K(x + 1), over eighteen decades of memory."""
    points, weights = np.polynomial.legendre.leggauss(40)
    x = np.array([-3000.0, -500.0, -21.0, -3.0, 2.0, 40.0, 2999.0])
    rate = 1.0 / memory_length
    here, there = (line_memory_influence(place, memory_length)[0] for place in (x, x + 1.0))
    reach = min(1.0, 40.0 * memory_length)
    s = 0.5 * reach * (points + 1.0)
    fresh = (0.5 * reach * weights * rate * np.exp(-rate * s)) @ strip_potential(x + s[:, None])
    # Rounding of a difference of logarithms times the distance in cells, 3000 × 1e-15 × 20, and of the quadrature.
    np.testing.assert_allclose(here, fresh + math.exp(-rate) * there, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("memory_length", [1e-3, 0.5, 1.0, 2.0, 1e4])
def test_slope_that_dissipates_is_that_of_the_memory(memory_length: float) -> None:
    """∂K/∂x = (K − Λ)/λ but for an odd part: the even parts of the two agree."""
    x = np.arange(-300.0, 301.0)
    delayed, slope = line_memory_influence(x, memory_length)
    expected = (delayed - strip_potential(x)) / memory_length
    even = 0.5 * (slope + slope[::-1])
    # K − Λ loses digits to the division by a small λ: 300 cells × 1e-15 / λ.
    np.testing.assert_allclose(even, 0.5 * (expected + expected[::-1]), rtol=1e-8, atol=1e-11 / min(memory_length, 1.0))


def test_exponential_integrals_join_their_asymptotic_series() -> None:
    for b in (50.0, -50.0):
        below, above = scaled_exponential_integral(np.array([b * (1.0 - 1e-12), b * (1.0 + 1e-12)]))
        assert below == pytest.approx(above, rel=1e-11)  # the argument's own change


MODES = SteadyMaterial(0.01, np.array([0.3, 0.2, 0.2, 0.1, 0.19]), np.array([1e-5, 1e-2, 1.0, 30.0, 1e6]))


def test_line_product_is_the_direct_sum() -> None:
    strip = Grid(0.1, 13, 12)
    operator = LineOperator(strip, MODES)
    pressure = np.random.default_rng(1).random(strip.shape)
    offsets = (strip.x[:, None] - strip.x) / strip.spacing
    matrix = MODES.glassy * strip_potential(offsets)
    for compliance, length in zip(MODES.compliances, MODES.memory_lengths, strict=True):
        matrix += compliance * line_memory_influence(offsets, length / strip.spacing)[0]
    direct = 2.0 / np.pi * strip.spacing * matrix @ pressure
    product = operator(pressure)
    difference = product - direct
    # The level is arbitrary, the same everywhere; else round-off.
    np.testing.assert_allclose(difference, difference.mean(), atol=1e-12 * np.ptp(product) * 25)


@pytest.mark.parametrize("memory_length", [1e-6, 1e-2, 1.0, 1e2, 1e8])
def test_every_line_pressure_does_work_and_dissipates(memory_length: float) -> None:
    strip = Grid(0.05, 40, 30)
    operator = LineOperator(strip, SteadyMaterial(0.1, np.array([0.9]), np.array([memory_length])))
    generator = np.random.default_rng(2)
    alternating = (-1.0) ** np.arange(70)[:, None]
    for pressure in (alternating, np.ones(strip.shape), *generator.standard_normal((20, *strip.shape))):
        assert np.vdot(pressure, operator(pressure)) > 0.0
        assert operator.dissipated_force(pressure) > 0.0


# --- the closed form ------------------------------------------------------------------------------

# E∞/E0, vτ/a0, then μR/a0, front/a0, rear/a0, p_max/p0: an independent evaluation of Hunter's solution.
HUNTER_ROWS = (
    (10.0, 0.1, 0.0850588154, 0.99882086, 0.911300014, 1.00275263),
    (10.0, 1.0, 0.463905753, 0.918344747, 0.283492762, 2.37021987),
    (10.0, 10.0, 0.171390597, 0.480522864, 0.160699936, 3.13913948),
    (100.0, 1.0, 0.548364655, 0.916768872, 0.193778866, 7.22034401),
)


@pytest.mark.parametrize("row", HUNTER_ROWS, ids=lambda row: f"k = {row[0]:g}, l = {row[1]:g}")
def test_line_contact_reference_rows(row: tuple[float, ...]) -> None:
    modulus_ratio, memory_length, friction, front, rear, peak = row
    solution = cylinder_on_standard_linear_solid(modulus_ratio, memory_length).solve(accuracy=1e-4)
    cell = solution.diagnostics.spacing / HERTZ_RADIUS
    assert solution.friction_coefficient / SLOPE == pytest.approx(friction, rel=1e-4)  # the accuracy asked for
    # Square-root edges are found to a fifth of a cell, half a cell where the leading layer is as thin as a cell.
    assert solution.front / HERTZ_RADIUS == pytest.approx(front, abs=0.5 * cell)
    assert solution.rear / HERTZ_RADIUS == pytest.approx(rear, abs=0.2 * cell)
    p0 = 2.0 * CYLINDER_LOAD / (np.pi * HERTZ_RADIUS)
    error = solution.diagnostics.max_pressure_error
    if solution.diagnostics.peak_resolved:
        assert solution.max_pressure == pytest.approx(peak * p0, abs=error)
    else:  # the layer at the leading edge is a cell thick
        assert (modulus_ratio, memory_length) == (100.0, 1.0)


def exact(problem: CylinderProblem) -> HunterContact:
    spectrum = problem.material.spectrum
    assert isinstance(spectrum, RetardationSpectrum)
    (tau,) = spectrum.tau
    return hunter_line(
        problem.load, BALL_RADIUS, spectrum.E0, spectrum.E_inf, tau, problem.speed, problem.material.poisson_ratio
    )


@pytest.mark.parametrize("modulus_ratio", [2.0, 100.0, *apart(10.0, 1000.0)])
@pytest.mark.parametrize("memory_length", [*slow(1e-3), *apart(1e-2), 0.1, 1.0, 10.0, *apart(100.0), 1000.0])
def test_line_contact_is_hunters(modulus_ratio: float, memory_length: float) -> None:
    problem = cylinder_on_standard_linear_solid(modulus_ratio, memory_length)
    hunter, solution = exact(problem), problem.solve(accuracy=3e-4)
    diagnostics, cell = solution.diagnostics, solution.diagnostics.spacing
    assert solution.friction_coefficient == pytest.approx(hunter.friction_coefficient, rel=3e-4)  # as asked
    error = abs(solution.friction_coefficient - hunter.friction_coefficient)
    assert error <= diagnostics.friction_error
    # Edges: a fifth of a cell, twice that where the leading layer is as thin as a cell, and twice the shift more
    # where the gap is looked at behind the cell centres.
    shift = 2.0 * diagnostics.collocation_shift
    for found, known in (
        (solution.front, hunter.front),
        (solution.rear, hunter.rear),
        (solution.contact_area, 2.0 * hunter.half_width),
    ):
        assert found == pytest.approx(known, abs=(0.4 + shift) * cell)
    assert abs(solution.front - hunter.front) <= diagnostics.edge_error
    assert abs(solution.rear - hunter.rear) <= diagnostics.edge_error
    # The profile, but for the layer at the leading edge, of a thickness vτ/k, and two cells at either edge, where
    # the pressure of a cell is not the one at its centre.
    layer = 12.0 * memory_length * HERTZ_RADIUS / modulus_ratio
    clear = max(2.0 * cell, min(layer, 0.3 * hunter.half_width) if layer < 30.0 * cell else 0.0)
    inside = (solution.x > -hunter.rear + 2.0 * cell) & (solution.x < hunter.front - clear)
    pressure = hunter.pressure(solution.x[inside])
    np.testing.assert_allclose(solution.pressure[inside, 0], pressure, rtol=0.0, atol=0.02 * pressure.max())
    assert np.sqrt(np.mean((solution.pressure[inside, 0] - pressure) ** 2)) < 3e-3 * pressure.max()
    if diagnostics.peak_resolved:
        assert (
            abs(solution.max_pressure - hunter.max_pressure) <= diagnostics.max_pressure_error + 1e-6 * pressure.max()
        )


@pytest.mark.parametrize(("modulus_ratio", "memory_length"), [(169.0, 2.34), (857.0, 5.6), (3000.0, 5.6)])
def test_contact_that_lies_far_ahead_is_found(modulus_ratio: float, memory_length: float) -> None:
    """The whole contact lies ahead of the axis, and first windows cut it where it is hardest to solve."""
    problem = cylinder_on_standard_linear_solid(modulus_ratio, memory_length)
    hunter, solution = exact(problem), problem.solve()
    assert solution.rear < 0.1 * solution.front
    assert solution.friction_coefficient == pytest.approx(hunter.friction_coefficient, rel=1e-3)  # as asked
    assert solution.rear == pytest.approx(hunter.rear, abs=0.4 * solution.diagnostics.spacing)  # as above


# --- limits, many modes ---------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "modulus_ratio"), [(0.0, 1.0), (math.inf, 10.0)], ids=["v = 0", "v = ∞"])
def test_limits_of_speed_are_hertz_line_contacts(speed: float, modulus_ratio: float) -> None:
    solution = solve_steady(SLS.material, SLS.cylinder, speed=speed, load=CYLINDER_LOAD)
    half_width = HERTZ_RADIUS / math.sqrt(modulus_ratio)
    cell = solution.diagnostics.spacing
    for edge in (solution.front, solution.rear, 0.5 * solution.contact_area):
        assert edge == pytest.approx(half_width, abs=0.2 * cell)  # as for Hunter's
    peak = 2.0 * CYLINDER_LOAD / (np.pi * half_width)
    inside = np.abs(solution.x) < half_width - 2.0 * cell
    profile = peak * np.sqrt(1.0 - (solution.x[inside] / half_width) ** 2)
    # 128 cells: a few 1e-3 near the edge, where a cell's pressure is not the one at its centre.
    np.testing.assert_allclose(solution.pressure[inside, 0], profile, atol=0.005 * peak)
    assert abs(solution.friction_coefficient) < 1e-12  # symmetric about a corner of cells: round-off
    assert solution.diagnostics.peak_resolved


def test_extreme_memories_are_hertz_line_contacts() -> None:
    for memory_length, modulus_ratio in ((1e-7, 1.0), (1e9, 10.0)):
        solution = cylinder_on_standard_linear_solid(10.0, memory_length).solve(accuracy=0.1)
        assert solution.front == pytest.approx(HERTZ_RADIUS / math.sqrt(modulus_ratio), rel=3e-3)  # a fifth of a cell
        assert abs(solution.friction_coefficient) < 1e-6 * SLOPE


THREE_SHORT = cylinder_problem("three short memories", 10.0, [1.0, 2.0, 3.0], [1e-4, 5e-5, 1e-5])
THREE_LONG = cylinder_problem("three long memories", 100.0, [1.0, 2.0, 3.0], [1e7, 1e5, 1e6])


def test_line_friction_at_low_speed() -> None:
    spectrum = THREE_SHORT.material.spectrum
    law = SPEED / BALL_RADIUS * spectrum.E0 * float(np.dot(spectrum.C, spectrum.tau))
    # The accuracy asked for; the law's next term is about l log l = 1e-3.
    assert THREE_SHORT.solve(accuracy=1e-3).friction_coefficient == pytest.approx(law, rel=2e-3)


def test_line_friction_at_high_speed() -> None:
    spectrum = THREE_LONG.material.spectrum
    law = high_speed_line_friction(
        SPEED, CYLINDER_LOAD, BALL_RADIUS, spectrum.E_inf, POISSON_RATIO, spectrum.C, spectrum.tau
    )
    # The accuracy asked for; the law's next term is about k/l ln(l/k) of the shortest memory, 7e-3.
    assert THREE_LONG.solve(accuracy=1e-4).friction_coefficient == pytest.approx(law, rel=1e-2)


def broad(memory_length: float) -> CylinderProblem:
    decades = np.arange(37) / 3.0 - 12.0
    return cylinder_problem("37 modes", 1000.0, 10.0 ** (decades / 4.0), memory_length * 10.0**decades)


@pytest.mark.parametrize("memory_length", [*slow(1e-2), *apart(1.0, 1e4), *slow(1e8), 1e12])
def test_line_contact_of_a_broad_spectrum(memory_length: float) -> None:
    coarse = broad(memory_length).solve()
    fine = broad(memory_length).solve(accuracy=1e-4)
    assert coarse.friction_coefficient == pytest.approx(
        fine.friction_coefficient, rel=1e-3
    )  # the accuracy of the first
    assert abs(coarse.friction_coefficient - fine.friction_coefficient) <= coarse.diagnostics.friction_error
    assert abs(fine.diagnostics.energy) < 4e-4  # the other way to the friction, which lags a little behind
    assert abs(fine.front - coarse.front) <= coarse.diagnostics.edge_error
    assert max(coarse.diagnostics.complementarity, fine.diagnostics.complementarity) <= 1e-8


# --- similarities ---------------------------------------------------------------------------------


def test_reversing_the_motion_mirrors_the_line_contact() -> None:
    forward = SLS.solve()
    backward = solve_steady(SLS.material, SLS.cylinder, speed=-SPEED, load=CYLINDER_LOAD)
    # The same numbers in another order: nothing is rounded anew.
    assert backward.friction_coefficient == -forward.friction_coefficient
    assert (backward.front, backward.rear, backward.indentation) == (forward.front, forward.rear, forward.indentation)
    assert backward.centre_of_pressure == pytest.approx(-forward.centre_of_pressure, rel=1e-12)
    np.testing.assert_array_equal(backward.pressure, forward.pressure[::-1])
    np.testing.assert_array_equal(backward.displacement, forward.displacement[::-1])


def test_friction_is_where_the_resultant_acts() -> None:
    solution = SLS.solve()
    # μ = ∫ p x dx/(R F): the lean by its definition, summed in another order.
    assert solution.centre_of_pressure / BALL_RADIUS == pytest.approx(solution.pressure_friction_coefficient, rel=1e-12)


# --- the level of displacements, load per length --------------------------------------------------


def check_level(solution: ContactSolution) -> None:
    height = solution.x**2 / (2.0 * BALL_RADIUS)
    gap = solution.displacement[:, 0] - (solution.indentation - height)
    loaded = solution.pressure[:, 0] > 0.0
    slope = np.abs(solution.x[loaded]).max() / BALL_RADIUS
    assert np.abs(gap[loaded]).max() < slope * solution.diagnostics.spacing
    # At the leading edge the surface is at its level, to what it climbs in a cell.
    at_front = float(np.interp(solution.front, solution.x, solution.displacement[:, 0]))
    assert abs(at_front) < slope * solution.diagnostics.spacing
    assert solution.indentation == pytest.approx(solution.front**2 / (2.0 * BALL_RADIUS), rel=1e-12)  # by definition


def test_depths_of_a_line_contact_are_counted_from_the_leading_edge() -> None:
    solution = SLS.solve(accuracy=1e-5)
    check_level(solution)
    loaded = solution.pressure[:, 0] > 0.0
    gap = solution.displacement[:, 0] - solution.indentation + solution.x**2 / (2.0 * BALL_RADIUS)
    assert np.abs(gap[loaded]).max() < 1e-7 * solution.indentation  # the solver's tolerance, over a smaller depth
    assert np.all(gap[~loaded] > -1e-7 * solution.indentation)


def test_depths_are_counted_from_the_leading_edge_where_the_gap_is_looked_at_behind_the_cells() -> None:
    solution = cylinder_on_standard_linear_solid(1000.0, 0.01).solve()
    assert solution.diagnostics.collocation_shift > 0.1
    check_level(solution)


def test_line_contact_says_what_it_is() -> None:
    solution = SLS.solve()
    assert solution.geometry == "line"
    assert solution.load == pytest.approx(CYLINDER_LOAD, rel=1e-12)  # scaled to the load: round-off
    assert solution.half_width == math.inf
    assert solution.pressure.shape == (len(solution.x), 1)
    assert solution.pressure.sum() * solution.diagnostics.spacing == pytest.approx(CYLINDER_LOAD, rel=1e-12)
    data = solution.to_dataset()
    assert data.pressure.shape == solution.pressure.shape


def test_profile_of_a_cylinder_is_a_cylinder() -> None:
    x = np.linspace(-1.5e-3, 1.5e-3, 61)
    profile = Profile(x**2 / (2.0 * BALL_RADIUS) + 7.0, spacing="0.05 mm")
    solution = solve_steady(SLS.material, profile, speed=SPEED, load=CYLINDER_LOAD)
    # A cubic spline through a parabola is the parabola, but for the rounding of heights of 7 m: 1e-15/1e-5.
    assert solution.friction_coefficient == pytest.approx(SLS.solve().friction_coefficient, rel=1e-6)
    with refused("beyond-indenter"):
        solve_steady(SLS.material, profile, speed=SPEED, load=20.0 * CYLINDER_LOAD)


def test_asymmetric_profile_mirrors_with_the_motion() -> None:
    x = np.linspace(-2e-3, 2e-3, 81)
    z = x**2 / (2.0 * BALL_RADIUS) + 4e-6 * np.sin(3e3 * x)
    ahead = solve_steady(SLS.material, Profile(z, 5e-5), speed=SPEED, load=CYLINDER_LOAD)
    mirrored = solve_steady(SLS.material, Profile(z[::-1], 5e-5), speed=-SPEED, load=CYLINDER_LOAD)
    back = solve_steady(SLS.material, Profile(z, 5e-5), speed=-SPEED, load=CYLINDER_LOAD)
    # The mirrored spline is rounded differently.
    assert mirrored.friction_coefficient == pytest.approx(-ahead.friction_coefficient, rel=1e-6)
    assert abs(back.friction_coefficient / ahead.friction_coefficient + 1.0) > 0.01
    assert ahead.diagnostics.energy == pytest.approx(0.0, abs=3e-3)  # the balance, at an accuracy of 1e-3


def test_a_load_that_is_not_per_length_is_refused() -> None:
    with refused("load"):
        solve_steady(SLS.material, SLS.cylinder, speed=SPEED, load="5 N")


def test_wide_line_contact_is_a_warning() -> None:
    deep = solve_steady(SLS.material, SLS.cylinder, speed=0.0, load=CYLINDER_LOAD * (0.4 / SLOPE) ** 2)
    assert len(deep.warnings) == 1
    assert "0.40 cylinder radii" in deep.warnings[0]


def test_modulus_and_load_only_rescale_the_line_contact() -> None:
    """μ = (a0/R) Φ(v/a0), with a0² = 4 F R (1 − ν²)/(π E0)."""
    factor = 5.0
    other = solve_steady(
        SLS.material,
        Cylinder(radius=2.0 * BALL_RADIUS),
        speed=SPEED * math.sqrt(2.0 * factor),
        load=factor * CYLINDER_LOAD,
    )
    length = HERTZ_RADIUS * math.sqrt(2.0 * factor)
    assert RUBBER_MODULUS == SLS.material.spectrum.E0
    assert other.friction_coefficient * 2.0 * BALL_RADIUS / length == pytest.approx(
        SLS.solve().friction_coefficient / SLOPE, rel=1e-9
    )


def test_cycling_set_is_left_at_a_loose_tolerance_too() -> None:
    """Where the active set cycles, proximal points end as soon as the tolerance is met, however loose it is."""
    problem = cylinder_on_standard_linear_solid(129.00613719616837, 0.4912070649483007)
    spectrum = problem.material.spectrum
    hunter = hunter_line(
        problem.load, problem.cylinder.radius, spectrum.E0, spectrum.E_inf, float(spectrum.tau[0]), problem.speed, 0.5
    )
    solution = problem.solve(accuracy=5e-3, tolerance=5e-6)
    assert solution.friction_coefficient == pytest.approx(hunter.friction_coefficient, rel=5e-3)  # the accuracy
