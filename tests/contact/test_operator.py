"""The influence operator: FFT products, sign and direction of memory, dissipated energy, preconditioner."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viscofric as vf
from contact.dense_reference import displacement_coefficients, displacement_matrix
from marks import apart, slow
from viscofric.arrays import Array
from viscofric.contact.complementarity import solve_complementarity
from viscofric.contact.free.grids import Grid
from viscofric.contact.operators import convolution
from viscofric.contact.operators.convolution import (
    SteadyMaterial,
    bent_share,
    both_halves,
    collocation_shift,
    is_even,
    solve_on_cells,
)
from viscofric.contact.operators.half_space import HalfSpaceOperator

WINDOW = Grid(spacing=0.25, behind=6, ahead=5, beside=4)
ONE_MODE = SteadyMaterial(0.1, np.array([0.9]), np.array([0.7]))
SIX_MODES = SteadyMaterial(0.01, np.array([0.3, 0.2, 0.2, 0.1, 0.1, 0.09]), np.array([1e-5, 1e-3, 0.1, 1.0, 30.0, 1e4]))


@pytest.mark.parametrize("material", [ONE_MODE, SIX_MODES], ids=["one mode", "six modes"])
def test_product_is_the_direct_sum(material: SteadyMaterial) -> None:
    nx, ny = WINDOW.shape
    coefficients = displacement_coefficients(
        nx, ny, WINDOW.spacing, material.glassy, material.compliances, material.memory_lengths
    )
    pressure = np.random.default_rng(1).random(WINDOW.shape)
    direct = displacement_matrix(coefficients, nx, ny) @ pressure.ravel()
    product = HalfSpaceOperator(WINDOW, material)(pressure).ravel()
    # Both kernels are right to about 1e-11 of the largest coefficient.
    np.testing.assert_allclose(product, direct, rtol=1e-9)


def test_shift_looks_behind_the_cell_centres() -> None:
    """On a smooth pressure, displacements half a cell behind lie between those at the centres."""
    window = Grid(spacing=0.02, behind=60, ahead=60, beside=60)
    pressure = np.exp(-8.0 * (window.x[:, None] ** 2 + window.y**2))
    centred, behind = (HalfSpaceOperator(window, SIX_MODES, shift=shift)(pressure) for shift in (0.0, 0.5))
    between = (-centred[:-3] + 9.0 * centred[1:-2] + 9.0 * centred[2:-1] - centred[3:]) / 16.0
    # Cubic interpolation over cells of 1/12 of the pressure's width: (1/12)^4, and a cell's own error.
    np.testing.assert_allclose(behind[2:-1], between, atol=1e-4 * centred.max())


def test_symbol_is_the_compliance_at_the_frequency_of_a_sinusoid() -> None:
    """S(ω) at ω = −q v, with S(ω) = 1/E∞ + C/(1 + iωτ): its imaginary part is positive for q above zero."""
    value = SteadyMaterial(0.1, np.array([0.9]), np.array([2.0])).symbol(np.array([1.5]))[0]
    assert value == pytest.approx(0.1 + 0.9 / (1.0 - 3.0j), rel=1e-14)
    assert value.imag > 0.0


def test_shift_is_for_nearly_skew_operators_alone_and_vanishes_with_refinement() -> None:
    resolved = SteadyMaterial(0.1, np.array([0.9]), np.array([1.0]))
    stiff_glass = SteadyMaterial(1e-4, np.array([1.0 - 1e-4]), np.array([1.0]))
    assert collocation_shift(resolved, 0.05) == 0.0
    shifts = [collocation_shift(stiff_glass, spacing) for spacing in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)]
    assert 0.4 < max(shifts) < 0.5
    assert shifts[-1] == 0.0


@pytest.mark.parametrize("material", [ONE_MODE, SIX_MODES], ids=["one mode", "six modes"])
def test_every_pressure_does_positive_work(material: SteadyMaterial) -> None:
    operator = HalfSpaceOperator(WINDOW, material)
    generator = np.random.default_rng(2)
    nx, ny = WINDOW.shape
    checkerboard = (-1.0) ** (np.arange(nx)[:, None] + np.arange(ny))
    for pressure in (checkerboard, *generator.standard_normal((20, nx, ny))):
        assert np.vdot(pressure, operator(pressure)) > 0.0


@pytest.mark.parametrize("memory_length", [1e-6, 1e-3, 0.1, 1.0, 100.0])
def test_every_pressure_dissipates(memory_length: float) -> None:
    operator = HalfSpaceOperator(WINDOW, SteadyMaterial(0.1, np.array([0.9]), np.array([memory_length])))
    for pressure in np.random.default_rng(3).random((5, *WINDOW.shape)):
        assert operator.dissipated_force(pressure) > 0.0


def test_displacement_is_greater_behind_the_load() -> None:
    window = Grid(0.1, 10, 10, 5)
    pressure = np.zeros(window.shape)
    pressure[9:11, 4:6] = 1.0
    displacement = HalfSpaceOperator(window, ONE_MODE)(pressure)
    behind, ahead = displacement[:9], displacement[11:][::-1]
    assert np.all(behind > ahead)
    np.testing.assert_allclose(displacement, displacement[:, ::-1], rtol=1e-12)  # even across, to round-off


def test_memory_at_a_point_comes_from_the_load_ahead() -> None:
    """Just one load, far ahead: the displacement of a mode is Eq. 8 for a point load, u(ξ) from ξ + vτz."""
    window = Grid(1.0, 50, 50, 1)
    length = 20.0
    operator = HalfSpaceOperator(window, SteadyMaterial(0.0, np.array([1.0]), np.array([length])))
    pressure = np.zeros(window.shape)
    pressure[90, 1] = 1.0
    z = np.linspace(0.0, 40.0, 400_001)
    for cell in (10, 60):
        distance = np.hypot(window.x[cell] + length * z - window.x[90], 1.0)
        expected = np.trapezoid(np.exp(-z) / distance, z) / np.pi
        # The load is seen from one cell to the side at the nearest: its shape matters by a few percent.
        assert operator(pressure)[cell, 0] == pytest.approx(expected, rel=0.03)


def test_elastic_solid_does_not_dissipate() -> None:
    operator = HalfSpaceOperator(WINDOW, SteadyMaterial(1.0, np.empty(0), np.empty(0)))
    pressure = np.random.default_rng(4).random(WINDOW.shape)
    assert operator.dissipated_force(pressure) == 0.0


def graded_panels(end: float, smallest: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights of a composite Gauss rule on 0 … end, its panels halving towards zero."""
    points, weights = np.polynomial.legendre.leggauss(20)
    count = int(np.ceil(np.log2(end / smallest)))
    edges = np.concatenate([[0.0], end * 0.5 ** np.arange(count, -1.0, -1.0)])
    half = 0.5 * np.diff(edges)[:, None]
    return (edges[:-1, None] + half * (1.0 + points)).ravel(), (half * weights).ravel()


def loss_weight(material: SteadyMaterial, qx: np.ndarray, spacing: float) -> np.ndarray:
    """2 q_x (−Im S(−q_x v)) of the energy integral; on cells, with second differences for a part of each mode."""
    bent = bent_share(material.memory_lengths / spacing) if spacing > 0.0 else np.zeros(len(material.compliances))
    differences = np.sinc(qx * spacing / (2.0 * np.pi)) ** 2
    loss = sum(
        (1.0 - share + share * differences) * c * qx * length / (1.0 + (qx * length) ** 2)
        for c, length, share in zip(material.compliances, material.memory_lengths, bent, strict=True)
    )
    return 2.0 * qx * loss


def spread(qx: np.ndarray, qy: np.ndarray, spacing: float) -> np.ndarray:
    """Fourier transform of a cell of unit pressure per unit of area, h² left out."""
    return np.sinc(qx * spacing / (2.0 * np.pi)) * np.sinc(qy * spacing / (2.0 * np.pi))


def energy_integral(material: SteadyMaterial, spacing: float = 0.0) -> float:
    """∫ d²q/(4π²) 2 q_x (−Im S)/|q| |p̂|² for the Gaussian pressure exp(−r²/2), in polar coordinates.

    With a spacing, for the Gaussian's values spread over cells, wavenumbers near zero only.
    """
    q, q_weight = graded_panels(9.0, 1e-12)
    theta, theta_weight = graded_panels(0.5 * np.pi, 1e-12)
    q, q_weight = q[:, None], q_weight[:, None]
    qx, qy = q * np.sin(theta), q * np.cos(theta)  # graded towards q_x = 0, where long memories act
    transform = 2.0 * np.pi * np.exp(-0.5 * q**2)
    integrand = loss_weight(material, qx, spacing) * transform**2 * spread(qx, qy, spacing)  # d²q/|q| = dq dθ
    return 4.0 * float(np.sum(q_weight * theta_weight * integrand)) / (4.0 * np.pi**2)


def aliased_energy(material: SteadyMaterial, spacing: float, reach: int = 40) -> float:
    """Return what the cells' edges add to the energy integral: all other points of the reciprocal lattice."""
    points, weights = np.polynomial.legendre.leggauss(24)
    k, weight = 6.0 * points, 6.0 * weights
    transform = 4.0 * np.pi**2 * np.exp(-(k[:, None] ** 2) - k**2) * weight[:, None] * weight
    lattice = 2.0 * np.pi / spacing * np.arange(-reach, reach + 1.0)
    total = 0.0
    for gx in lattice:
        for gy in lattice[lattice >= 0.0]:
            if gx == gy == 0.0:
                continue
            qx, qy = (gx + k)[:, None], gy + k
            twice = 1.0 if gy == 0.0 else 2.0
            density = loss_weight(material, qx, spacing) / np.hypot(qx, qy) * spread(qx, qy, spacing)
            total += twice * float(np.sum(density * transform))
    return total / (4.0 * np.pi**2)


def gaussian_energy(material: SteadyMaterial, spacing: float) -> float:
    cells = round(8.0 / spacing)
    window = Grid(spacing, cells, cells, cells)
    pressure = np.exp(-0.5 * (window.x[:, None] ** 2 + window.y**2))
    return HalfSpaceOperator(window, material).dissipated_force(pressure)


ENERGY_CASES = [
    *(SteadyMaterial(0.1, np.array([0.9]), np.array([length])) for length in (1e-6, 0.02, 0.1)),
    *(SteadyMaterial(0.1, np.array([0.9]), np.array([length])) for length in (1.0, 30.0, 1e8)),
    SIX_MODES,
]


@pytest.mark.parametrize(
    "material",
    [ENERGY_CASES[3], *slow(ENERGY_CASES[0]), *apart(*ENERGY_CASES[1:3], *ENERGY_CASES[4:-1]), *slow(ENERGY_CASES[-1])],
    ids=lambda m: f"{len(m.compliances)}-{m.memory_lengths[0]:g}",
)
def test_dissipated_energy_is_the_fourier_integral(material: SteadyMaterial) -> None:
    spacing = 0.25
    expected = energy_integral(material, spacing) + aliased_energy(material, spacing)
    # The Gaussian is 1e-14 at the window's edge.  The lattice sum ends at its 40th neighbours, which leaves
    # about 1e-3 of an aliased part of at most 2e-2.
    assert gaussian_energy(material, spacing) == pytest.approx(expected, rel=2e-5)


def test_dissipated_energy_of_a_smooth_pressure_converges() -> None:
    material = ENERGY_CASES[3]  # memory as long as the Gaussian is wide
    exact = energy_integral(material)
    errors = [abs(gaussian_energy(material, spacing) / exact - 1.0) for spacing in (0.5, 0.25, 0.125)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    # A cell spreads its pressure over its square, (q h)²/24 of the result, and bends are found from second differences,
    # (q h)²/12: second order.
    assert np.all(orders > 1.5)
    assert errors[-1] < 2e-3


def test_dissipated_energy_of_short_memories_is_proportional_to_them() -> None:
    # Memories of 1e-6 to 1.2e-3 cells, on both sides of the switch to the leading term.
    lengths = 0.25 * np.array([1e-6, 1e-4, 0.99e-3, 1.01e-3, 1.2e-3])
    forces = [gaussian_energy(SteadyMaterial(0.1, np.array([1.0]), np.array([one])), 0.25) for one in lengths]
    # Of the order of the memory in cells: that is what a finite memory takes from its leading term.
    np.testing.assert_allclose(forces / lengths, forces[0] / lengths[0], rtol=1e-3)


def test_dissipated_force_is_the_work_on_the_slopes() -> None:
    """From overlaps of the pressure, as from a product: a quadratic form is half of its gradient times its argument."""
    operator = HalfSpaceOperator(WINDOW, SIX_MODES)
    pressure = np.random.default_rng(6).random(WINDOW.shape)
    by_product = 0.5 * float(np.vdot(operator.dissipated_force_gradient(pressure), pressure))
    assert operator.dissipated_force(pressure) == pytest.approx(by_product, rel=1e-12)


def test_products_are_counted() -> None:
    operator = HalfSpaceOperator(WINDOW, ONE_MODE)
    operator.dissipated_force(operator(np.ones(WINDOW.shape)))
    assert operator.products == 1


@pytest.mark.parametrize("aspect", [0.25, 3.0])
def test_rectangular_cells_answer_as_the_smaller_squares_they_are_made_of(aspect: float) -> None:
    wide = aspect > 1.0
    window = Grid(0.3 if wide else 1.2, 6, 5, 4, aspect)
    squares = Grid(0.3, 6, 5, 12) if wide else Grid(0.3, 24, 20, 4)
    pressure = np.random.default_rng(6).random(window.shape)
    parts = (1, 3) if wide else (4, 1)
    fine = np.kron(pressure, np.ones(parts))
    found = HalfSpaceOperator(window, SIX_MODES)(pressure)
    displacement = HalfSpaceOperator(squares, SIX_MODES)(fine)
    if wide:
        np.testing.assert_allclose(found, displacement[:, 1::3], rtol=1e-9)  # both kernels: 1e-11 of the largest
    else:
        # The rectangle's centre lies on an edge between two squares: half a square behind the one ahead of it.
        behind = HalfSpaceOperator(squares, SIX_MODES, 0.5)(fine)
        np.testing.assert_allclose(found, behind[2::4], rtol=1e-9)
    # Energy is a sum over cell centres: it converges to the same, but is not the same on other cells.
    assert HalfSpaceOperator(window, SIX_MODES).dissipated_force(pressure) > 0.0


@pytest.mark.parametrize("aspect", [0.5, 2.0, 8.0])
def test_dissipated_energy_of_a_smooth_pressure_is_the_same_on_rectangles(aspect: float) -> None:
    material = ENERGY_CASES[3]
    spacing = 0.125 / max(1.0, aspect / 4.0)
    window = Grid.around(8.0, 8.0, 8.0, round(16.0 / (spacing * min(1.0, aspect))), aspect)
    pressure = np.exp(-0.5 * (window.x[:, None] ** 2 + window.y**2))
    # Cells spread the pressure over their length and width, at most 1/2 here: (q h)²/24 of the result each; and bends
    # along the motion are found from second differences, (q h)²/12.
    error = HalfSpaceOperator(window, material).dissipated_force(pressure) / energy_integral(material) - 1.0
    assert abs(error) < 0.1 * max(window.spacing, window.width) ** 2 + 1e-4


def test_corrections_in_single_precision_cost_no_digits(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are taken on fine grids, here on all: the contact is the same to the solver's tolerance of 1e-8."""
    rubber = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e8, tau=1e-2)
    asked = {"speed": 0.1, "load": 1.0, "grid": 128}
    double = vf.solve_steady(rubber, vf.Ball(radius=0.01), **asked)
    monkeypatch.setattr("viscofric.contact.operators.convolution._FEWEST_SINGLE", 0)
    single = vf.solve_steady(rubber, vf.Ball(radius=0.01), **asked)
    assert single.diagnostics.complementarity <= 1e-8
    assert single.friction_coefficient != double.friction_coefficient  # rounding tells that it was taken
    # Gaps of 1e-8 of the indentation, where either solve may end, move pressures by a hundred times that at most.
    np.testing.assert_allclose(single.pressure, double.pressure, atol=1e-6 * double.max_pressure)
    assert single.friction_coefficient == pytest.approx(double.friction_coefficient, rel=1e-6)


def test_even_indenters_are_solved_on_one_side_and_others_on_both(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same pressures to the tolerance, whichever; one that is tilted by a part in a billion is not even."""
    shapes: list[tuple[int, ...]] = []

    def watched(operator: HalfSpaceOperator, height: Array, *arguments: Any, **settings: Any) -> Any:
        shapes.append(height.shape)
        return solve_complementarity(operator, height, *arguments, **settings)

    monkeypatch.setattr(convolution, "solve_complementarity", watched)
    window = Grid(spacing=0.02, behind=70, ahead=64, beside=64)
    operator, y = HalfSpaceOperator(window, SIX_MODES), window.y
    height = 0.5 * (window.x[:, None] ** 2 + y**2)
    for load, indentation in ((4.0 / 3.0 / window.cell_area, None), (None, 0.8)):
        even, tilted = (
            solve_on_cells(operator, each, load, np.ones(window.shape), indentation=indentation, tolerance=1e-10)
            for each in (height, height + 1e-9 * y)
        )
        assert shapes[-2:] == [(134, 64), (134, 128)]
        assert is_even(even.pressure)
        assert even.converged
        assert even.load < 1e-12
        # Gaps of 1e-9 take pressures of 1e-9 over the compliance of a cell, which is some hundredths.
        np.testing.assert_allclose(even.pressure, tilted.pressure, atol=1e-6)
        assert even.indentation == pytest.approx(tilted.indentation, rel=1e-7)
    # Walls, beyond which the height is infinite, may be even too, and one side alone may have one.
    walls = np.where(np.abs(y) > 1.0, np.inf, height)
    assert is_even(walls)
    walls[:, 0] = 1.0
    assert not is_even(walls)


@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_dissipated_force_is_half_of_the_pressures_times_its_gradient(tilt: float) -> None:
    """It is a quadratic form of the pressures, also of those that are even, which take half of the FFTs."""
    window = Grid(spacing=0.1, behind=13, ahead=11, beside=9)
    operator = HalfSpaceOperator(window, SIX_MODES)
    pressure = np.random.default_rng(5).random((24, 9))
    pressure = both_halves(pressure) * (1.0 + tilt * window.y)
    assert is_even(pressure) is (tilt == 0.0)
    half = 0.5 * float(np.vdot(pressure, operator.dissipated_force_gradient(pressure)))
    assert operator.dissipated_force(pressure) == pytest.approx(half, rel=1e-12)
