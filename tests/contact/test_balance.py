"""What cells leave out of the dissipated energy, and that the friction's error estimate covers its true error."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from gallery import HERTZ_RADIUS, broad_spectrum_37, low_speed_friction, standard_linear_solid
from marks import apart, slow
from viscofric.contact.free import balance
from viscofric.contact.free.balance import lag, openings
from viscofric.contact.free.estimates import FEWEST_GRIDS, FRICTION_FLOOR, friction_estimate
from viscofric.contact.free.geometry import LINE, POINT, Geometry
from viscofric.contact.free.grids import Grid
from viscofric.contact.free.nested import find_window, refine
from viscofric.contact.free.problem import Control, Problem
from viscofric.contact.free.stage import Stage
from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.operators.convolution import SteadyMaterial, bent_share, second_difference
from viscofric.contact.reference import hunter_line

INDENTERS = {POINT.name: Ball(radius=1.0), LINE.name: Cylinder(radius=1.0)}


def contact(geometry: Geometry, modulus_ratio: float, shares: list[float], memory_lengths: list[float]) -> Problem:
    """Return a ball or a cylinder of unit radius in units of the Hertz contact at E0."""
    compliances = (1.0 - 1.0 / modulus_ratio) * np.asarray(shares) / np.sum(shares)
    solid = SteadyMaterial(1.0 / modulus_ratio, compliances, np.asarray(memory_lengths))
    return Problem(geometry, solid, INDENTERS[geometry.name], Control(load=geometry.parabolic_load), 1e-9)


def coarse_stage(problem: Problem) -> Stage:
    return find_window(problem, problem.first_size)


# --- the identity ---------------------------------------------------------------------------------


@pytest.mark.parametrize("geometry", [POINT, LINE], ids=lambda geometry: geometry.name)
def test_bends_of_the_surface_balance_those_of_the_indenter(geometry: Geometry) -> None:
    """−∫ p ∂²u/∂x² dA is the load over the radius, but for the gap that opens in the edge cells."""
    stage = coarse_stage(contact(geometry, 10.0, [1.0, 2.0], [0.02, 0.5]))
    assert stage.operator.shift == 0.0
    window, pressure = stage.window, stage.result.pressure
    bends = second_difference(stage.result.displacement) / window.spacing**2
    balanced = -window.cell_area * float(np.vdot(pressure[1:-1], bends)) / stage.load
    assert 0.01 < stage.opening < 0.2  # the identity is off by that much on 32 cells
    # The gap under the pressures is zero to 1e-9 of the indentation; differences over h² ≈ 1e-2 of a0².
    assert balanced + stage.opening == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("geometry", [POINT, LINE], ids=lambda geometry: geometry.name)
@pytest.mark.parametrize("modulus_ratio", [1.1, 1000.0])
def test_short_memories_are_right_on_the_coarsest_grid(geometry: Geometry, modulus_ratio: float) -> None:
    lengths = [1e-6, 3e-6, 2e-5]
    stage = coarse_stage(contact(geometry, modulus_ratio, [3.0, 2.0, 1.0], lengths))
    law = float(stage.problem.solid.compliances @ np.asarray(lengths))  # (v/R) Σ C_k τ_k E0
    # The law's next term is about the longest memory over the contact; the dissipation alone is 4 % off.
    assert stage.energy_friction == pytest.approx(law, rel=5e-5)
    dissipated = stage.operator.dissipated_force(stage.result.pressure) / stage.load
    assert dissipated != pytest.approx(law, rel=0.01)


def test_openings_count_gaps_ahead_of_and_behind_pressures() -> None:
    pressure, gap = np.zeros((6, 4)), np.full((6, 4), 5.0)
    pressure[2, 1], pressure[3, 1] = 2.0, 3.0
    gap[2:4, 1] = 1e-9  # what the solver's tolerance leaves under pressure counts for nothing
    gap[1, 1], gap[4, 1] = 0.5, 0.25
    assert openings(Grid(0.1, 3, 3, 2), pressure, gap) == pytest.approx((3.0 * 0.25, 2.0 * 0.5))
    strip = Grid(0.1, 3, 3)
    assert openings(strip, pressure[:, 1:2], gap[:, 1:2]) == pytest.approx((30.0 * 0.25, 20.0 * 0.5))


def test_lag_of_waves_left_out() -> None:
    short = SteadyMaterial(0.2, np.array([0.5, 0.3]), np.array([1e-7, 3e-7]))
    # All memories far below the cell: their mean, whatever the cut; the next term is λ = 3e-7.
    for cut in (2.0, 3.0, 5.0):
        assert lag(short, 1.0, cut, 0.5) == pytest.approx(0.5e-7 + 0.9e-7, rel=1e-5)
    longer = SteadyMaterial(0.2, np.array([0.8]), np.array([0.5]))
    lags = [lag(longer, 1.0, cut, 0.5) for cut in (2.0, 3.0, 5.0)]
    assert lags[0] > lags[1] > lags[2] > 0.0  # shorter waves find the mode less compliant
    assert lag(SteadyMaterial(1.0, np.empty(0), np.empty(0)), 1.0, 1.0, 0.5) == 0.0


@pytest.mark.parametrize("length", [1e-3, 0.1, 1.0, 3.0])
def test_lag_of_either_edge_is_the_integral_over_its_waves(length: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Waves of the pressure: at the trailing edge those of a square root, at the leading one over the compliance."""
    monkeypatch.setattr(balance, "_LESS", 0.0)  # which is of cells, not of waves
    solid, cut = SteadyMaterial(0.02, np.array([0.4, 0.04]), np.array([length, 0.1 * length])), 3.0
    logarithm, step = np.linspace(-30.0, 30.0, 6001, retstep=True)  # trapezoids: exact to rounding for what fades
    wave = np.exp(logarithm)
    weight = step * wave / (cut**2 + wave**2)
    loss = (bent_share(solid.memory_lengths) * solid.compliances * solid.memory_lengths) @ (
        1.0 / (1.0 + np.outer(solid.memory_lengths, wave) ** 2)
    )
    symbol = solid.symbol(wave)
    rear = (weight @ loss) / (weight @ symbol.real)
    assert lag(solid, 1.0, cut, 1.0) == pytest.approx(rear, rel=1e-9)
    front = (weight @ (loss / np.abs(symbol) ** 2)) / (weight @ (symbol.real / np.abs(symbol) ** 2))
    # Modes that are found from slopes are parted from the others where they are far apart.
    rough = 1e-9 if length < 1e-2 else 5e-2
    assert lag(solid, 1.0, cut, 0.0) == pytest.approx(front, rel=rough)


@pytest.mark.parametrize("length", [2e-3, 2e-2, 8e-2])  # a tenth of a cell, one cell and four cells
def test_cells_leave_out_of_hertz_contact_what_the_closed_form_says(length: float) -> None:
    """A weak mode leaves it as it is: F = (16/(π l)) ∫ j(q)² (1 − 1/√(1 + q²l²)) dq, j the transform of pressure."""
    stage = refine(coarse_stage(contact(POINT, 1.0 + 1e-6, [1.0], [length])), 0.5, 128)[-1]
    wave = 0.01 * (np.arange(200_000) + 0.5)  # what lies beyond is 1e-5 of the result
    square = ((np.sin(wave) - wave * np.cos(wave)) / wave**3) ** 2
    known = 0.16 / (math.pi * length) * float(square @ (1.0 - 1.0 / np.sqrt(1.0 + (length * wave) ** 2)))
    weak = float(stage.problem.solid.compliances[0])
    left_out = weak * known / stage.load - stage.operator.dissipated_force(stage.result.pressure) / stage.load
    assert left_out > 1e-4 * weak * known
    # How the edge lies in its cells: on 128 and 256 cells it is 0.2 to 5 %; with q_c = 3.2 alone, 16 % at four cells.
    assert stage.lag * stage.opening == pytest.approx(left_out, rel=0.08)


def test_bent_share_fades_for_long_memories() -> None:
    share = bent_share(np.array([1e-8, 10.0, 1e8]))
    np.testing.assert_allclose(share, [1.0, 0.5, 0.0], atol=1e-12)


# --- errors and their estimates -------------------------------------------------------------------


@pytest.mark.parametrize("modulus_ratio", [*slow(1.1), *apart(10.0), *slow(1e4)])
def test_error_estimate_covers_the_true_error_of_the_line_contact(modulus_ratio: float) -> None:
    """On every grid, from memories far shorter than a cell to far longer than the contact."""
    for decade in range(-4, 5):
        memory_length = 10.0**decade
        problem = contact(LINE, modulus_ratio, [1.0], [memory_length])
        known = hunter_line(LINE.parabolic_load, 1.0, 1.0, modulus_ratio, memory_length, 1.0, 0.0).friction_coefficient
        stages = refine(coarse_stage(problem), 1e-3, 8192)
        for count in range(FEWEST_GRIDS, len(stages) + 1):
            value, error = friction_estimate(stages[:count])
            # The solver's tolerance of 1e-9, over slopes that are 1e-3 of the contact's at the least.
            assert abs(value - known) <= error + 1e-6 * known


@pytest.mark.parametrize("slenderness", [5.0, 20.0])
@pytest.mark.parametrize("accuracy", [0.02, 1e-3])
def test_error_estimate_holds_on_thin_incompressible_layers(slenderness: float, accuracy: float) -> None:
    """Their pressure is no square root at the edge, as the balance takes it to be, but nearly a square."""
    modulus, size, radius, memory_length = 1e6, 1e-3, 1e-2, 1e-7
    thickness = size / slenderness
    rubber = vf.Material.standard_linear_solid(E0=modulus, E_inf=10.0 * modulus, tau=1e-3)
    solution = vf.solve_steady(
        rubber, vf.Cylinder(radius), speed=memory_length / 1e-3, layer=vf.Layer(thickness), accuracy=accuracy,
        load=2.0 * modulus * size**5 / (45.0 * radius * thickness**3),
    )  # fmt: skip
    law = 0.9 * memory_length / radius  # (v/R) Σ C_k τ_k E0, on whatever the memory is short against
    # The law's next term is about the memory over the contact, 1e-4, and a logarithm.
    assert abs(solution.friction_coefficient - law) <= solution.diagnostics.friction_error + 3e-4 * law


def test_low_speed_takes_no_fine_grid() -> None:
    problem = broad_spectrum_37(1.1e-3)
    solution = problem.solve()
    assert len(solution.diagnostics.levels) == 3
    # The accuracy asked for, and the law's next term, of the order of the longest memory, 1e-3.
    assert solution.friction_coefficient == pytest.approx(low_speed_friction(problem), rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize("modulus_ratio", [1.1, *apart(100.0), 1e4])
def test_every_speed_is_solved_on_a_grid_of_moderate_size(modulus_ratio: float) -> None:
    for decade in (-6, -4, -3, -1, 0, 1, 2, 4, 6):
        memory = 10.0**decade
        problem = standard_linear_solid(modulus_ratio, memory)
        solution = problem.solve(accuracy=1e-3)
        floor = FRICTION_FLOOR * HERTZ_RADIUS / float(problem.ball.radius)  # type: ignore[arg-type]
        assert solution.diagnostics.friction_error <= 1e-3 * max(solution.friction_coefficient, floor)
        assert max(solution.diagnostics.shape) <= 256
        if decade <= -3:
            # The next term is of what Hertz's edges do to a mode whose memory is short (see `balance`).
            law = low_speed_friction(problem) * (1.0 - 2.0 / math.pi * (1.0 + 1.0 / modulus_ratio) * memory)
            assert abs(solution.friction_coefficient - law) <= solution.diagnostics.friction_error + memory**2 * law
