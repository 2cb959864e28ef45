"""Derivatives of the friction coefficient: against differences on the same cells, closed forms and similarity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from marks import apart, slow
from refusals import refused
from viscofric.contact.bodies import Layer
from viscofric.contact.derivatives.adjoint import friction_adjoint
from viscofric.contact.derivatives.moving_cells import Motion
from viscofric.contact.free.balance import lag, lag_changes
from viscofric.contact.free.geometry import LINE, POINT
from viscofric.contact.free.grids import Grid
from viscofric.contact.free.nested import find_window
from viscofric.contact.free.problem import Control, Problem
from viscofric.contact.free.stage import Stage
from viscofric.contact.indenters.shapes import Ball, Cone, Cylinder
from viscofric.contact.influence.layer_potentials import LayerCell
from viscofric.contact.influence.line import HalfSpaceStrip, line_memory_influence
from viscofric.contact.influence.mixtures import memory_influence
from viscofric.contact.influence.moments import correlation, memory_moments
from viscofric.contact.influence.potentials import HalfSpaceCell
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.contact.operators.half_space import HalfSpaceOperator
from viscofric.contact.operators.layer import ScaledLayer
from viscofric.contact.reference import hunter_line
from viscofric.contact.steady import solve_steady
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.contact.derivatives.friction import FrictionDerivatives
    from viscofric.contact.free.geometry import Geometry
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.contact.influence.potentials import CellPotential

    Array = NDArray[np.float64]

BALL, CYLINDER = Ball(radius=10e-3), Cylinder(radius=10e-3)
LENGTHS = np.geomspace(1e-7, 1e9, 17)


def material(C: list[float], tau: list[float], E_inf: float = 2e7) -> Material:
    E0 = 1.0 / (1.0 / E_inf + sum(C))
    return Material(RetardationSpectrum(E0, E_inf, C, tau))


def solved(
    C: list[float], tau: list[float], *, E_inf: float = 2e7, indenter: Indenter = BALL, **given_: float
) -> FrictionDerivatives:
    arguments = {"speed": 0.5, "load": 1.0 if indenter is BALL else 100.0} | given_
    solution = solve_steady(material(C, tau, E_inf), indenter, derivatives=True, **arguments)  # type: ignore[arg-type]
    assert solution.derivatives is not None
    return solution.derivatives


@dataclass(frozen=True)
class Paraboloid:
    """x²/2 + y²/2, or less along y, in units of the Hertz contact."""

    along_y: float = 1.0
    has_tip: bool = False

    def height(self, x: Array, y: Array) -> Array:
        return 0.5 * (x**2 + self.along_y * y**2)

    def slope(self, x: Array, y: Array) -> Array:
        return x + 0.0 * y


ROUND, WIDE = Paraboloid(), Paraboloid(along_y=0.02)


def central_difference(function: Callable[[float], Array], step: float) -> Array:
    """Five-point rule: the error is of fourth order."""
    near, far = function(step) - function(-step), function(2.0 * step) - function(-2.0 * step)
    return (8.0 * near - far) / (12.0 * step)


def test_correlation_gathers_all_pairs_of_cells_at_one_distance() -> None:
    rng = np.random.default_rng(1)
    a, b = rng.normal(size=(2, 4, 7))
    found = correlation(a, b)
    expected = np.zeros_like(found)
    for i, j in np.ndindex(a.shape):
        for k, m in np.ndindex(b.shape):
            expected[i - k + 3, abs(j - m)] += a[i, j] * b[k, m]
    assert found == pytest.approx(expected, abs=1e-13)  # rounding


@pytest.mark.parametrize("shift", [0.0, 0.3])
@pytest.mark.parametrize("cell", [HalfSpaceCell(), HalfSpaceCell(4.0), LayerCell(3.0, True, 0.3, 2.0)])
def test_moments_are_sums_of_influence_coefficients_and_change_with_the_memory(
    cell: CellPotential, shift: float
) -> None:
    weights = np.random.default_rng(2).normal(size=(2, 29, 20))

    def sums(logarithm: float) -> Array:
        lengths = LENGTHS * np.exp(logarithm)
        modes = np.eye(len(lengths))
        found = memory_influence((15, 20), modes, lengths, shift, potential=cell)
        return np.asarray(np.einsum("kij,mij->km", weights, found))

    moments, sensitivities = memory_moments(weights, LENGTHS, shift, cell)
    assert moments == pytest.approx(sums(0.0), abs=1e-12)  # the same rule
    # The coefficients are right to about 1e-11, which the difference divides by its step.
    assert sensitivities == pytest.approx(central_difference(sums, 1e-3), abs=2e-8)


@pytest.mark.parametrize("length", [1e-3, 0.3, 5.0, 1e4])
def test_moments_of_a_strip_are_those_of_the_closed_form(length: float) -> None:
    x = np.arange(-40.0, 41.0) - 0.2
    weights = np.random.default_rng(3).normal(size=81)

    def sums(logarithm: float) -> Array:
        return np.array([weights @ line_memory_influence(x, length * np.exp(logarithm))[0]])

    moments, sensitivities = memory_moments(weights[None, :, None], np.array([length]), 0.2, HalfSpaceStrip())
    assert moments[0] == pytest.approx(sums(0.0), rel=1e-11, abs=1e-11)
    assert sensitivities[0] == pytest.approx(central_difference(sums, 1e-3), rel=1e-8, abs=1e-9)  # of fourth order


@pytest.mark.parametrize("counterface", [0.0, 0.1])
def test_lag_of_what_cells_leave_out_changes_with_the_material(counterface: float) -> None:
    solid = SteadyMaterial(0.05, np.array([0.2, 0.3, 0.4]), np.array([1e-3, 0.2, 3.0]), counterface)
    rear, glassy, compliances, lengths = lag_changes(solid, 0.02, 3.0, 0.4)

    def change(name: str, place: int | None = None) -> float:
        unit = 1.0 if place is None else np.eye(3)[place]

        def moved(step: float) -> Array:
            there = replace(solid, **{name: getattr(solid, name) * (1.0 + step * unit)})
            return np.array(lag(there, 0.02, 3.0, 0.4))

        return float(central_difference(moved, 1e-3))

    by_rear = central_difference(lambda step: np.array(lag(solid, 0.02, 3.0, 0.4 + step)), 1e-3)
    assert rear == pytest.approx(float(by_rear), rel=1e-8)
    assert glassy * solid.glassy == pytest.approx(change("glassy"), rel=1e-8)  # differences of fourth order
    for k in range(3):
        assert compliances[k] * solid.compliances[k] == pytest.approx(change("compliances", k), rel=1e-8)
        assert lengths[k] * solid.memory_lengths[k] == pytest.approx(change("memory_lengths", k), rel=1e-8)


@cache
def converged(
    geometry: Geometry, held: str, k: float, length: float, shape: Paraboloid = ROUND, layered: bool = False
) -> Stage:
    """Solve on the window's first grid, as exactly as doubles allow."""
    compliances = (1.0 - 1.0 / k) * np.array([0.6, 0.4])
    solid = SteadyMaterial(1.0 / k, compliances, np.array([0.2 * length, length]), 0.1 if layered else 0.0)
    control = Control(load=geometry.parabolic_load) if held == "load" else Control(indentation=1.0)
    layer = ScaledLayer(0.8, bonded=True, poisson_ratio=0.45) if layered else None
    if layer is not None:
        # In plane strain, without a counterface: a given indentation then has a meaning.
        solid = replace(solid, counterface=0.0 if held == "indentation" else 0.1)
        geometry = layer.geometry(geometry, solid.counterface)
    problem = Problem(geometry, solid, shape, control, 1e-13, layer=layer)
    return find_window(problem, problem.first_size)


def friction(stage: Stage, way: str, **changed: float | Array) -> float:
    """Friction coefficient of a neighbouring problem on the same cells, which stay in contact."""
    held = changed.pop("held", None)
    solid = replace(stage.operator.material, **changed)  # type: ignore[arg-type]
    control = stage.problem.control
    if held is not None:
        control = Control(load=held) if control.indentation is None else Control(indentation=held)  # type: ignore[arg-type]
    operator = stage.problem.geometry.operator(stage.window, solid, stage.operator.shift)
    x = stage.window.x - stage.operator.shift * stage.window.spacing
    height = stage.problem.shape.height(x[:, None], stage.window.y)
    result = control.solve(operator, height, stage.result.pressure, 1e-13)
    assert result.converged
    assert np.array_equal(result.pressure > 0.0, stage.result.pressure > 0.0)
    there = Stage(stage.problem, stage.window, operator, result)
    return there.energy_friction if way == "balance" else there.pressure_friction


@pytest.mark.parametrize("way", ["pressure", "balance"])
@pytest.mark.parametrize(
    ("geometry", "held", "k", "length", "shape", "layered"),
    [
        (POINT, "load", 10.0, 2.0, ROUND, False),
        (POINT, "indentation", 10.0, 2.0, ROUND, False),
        (POINT, "load", 300.0, 1.0, ROUND, False),
        *slow((POINT, "load", 4.0, 0.5, WIDE, False), (POINT, "load", 4.0, 0.5, WIDE, True)),
        (POINT, "indentation", 10.0, 2.0, ROUND, True),
        (LINE, "load", 10.0, 2.0, ROUND, False),
        (LINE, "load", 300.0, 1.0, ROUND, False),
        (LINE, "load", 10.0, 2.0, ROUND, True),
        (LINE, "indentation", 10.0, 2.0, ROUND, True),
    ],
)
def test_derivatives_are_those_of_the_solution_on_its_cells(
    geometry: Geometry, held: str, k: float, length: float, shape: Paraboloid, layered: bool, way: str
) -> None:
    stage = converged(geometry, held, k, length, shape, layered)
    assert (stage.operator.shift > 0.0) == (k > 100.0)  # both where the gap is looked at behind the centres and not
    assert (stage.window.width > stage.window.spacing) == (shape is WIDE)
    geometry = stage.problem.geometry
    solid, gradient = stage.operator.material, friction_adjoint(stage, way).gradient  # type: ignore[arg-type]
    depth = 1.0 if held == "indentation" else geometry.parabolic_load
    step = 1e-5
    first = np.array([1.0, 0.0])

    def difference(change: Callable[[float], dict[str, float | Array]]) -> float:
        up, down = friction(stage, way, **change(step)), friction(stage, way, **change(-step))
        return (up - down) / (2.0 * step)

    found = {
        "glassy": gradient.glassy * solid.glassy,
        "held": gradient.held * depth,
        "compliance": gradient.compliances[0] * solid.compliances[0],
        "memory": gradient.memory_lengths[0] * solid.memory_lengths[0],
    }
    expected = {
        "glassy": difference(lambda e: {"glassy": solid.glassy * (1.0 + e)}),
        "held": difference(lambda e: {"held": depth * (1.0 + e)}),
        "compliance": difference(lambda e: {"compliances": solid.compliances * (1.0 + e * first)}),
        "memory": difference(lambda e: {"memory_lengths": solid.memory_lengths * (1.0 + e * first)}),
    }
    # The solver leaves 1e-13 of the indentation, which the difference divides by its step; its own error is step².
    assert found == pytest.approx(expected, rel=1e-6, abs=3e-8)


@pytest.mark.parametrize("geometry", [POINT, LINE], ids=lambda geometry: geometry.name)
def test_contact_grows_with_its_load_as_hertz_says(geometry: Geometry) -> None:
    stage = converged(geometry, "load", 10.0, 1e-3)
    motion = Motion.of(stage)
    # a ∝ F^(1/3) under a ball, F^(1/2) under a cylinder; the contact is some twenty cells wide, one of which is 5 %.
    assert motion.growth.held * geometry.parabolic_load == pytest.approx(1.0 / (geometry.dimension + 1.0), rel=0.1)
    # It lags by less than the memory, 1e-3, so that little of it moves.
    assert abs(motion.shift.held) < 1e-3


@pytest.mark.parametrize(
    ("k", "length"), [(10.0, 1.0), *slow((10.0, 1e-3), (1000.0, 0.1)), *apart((2.0, 0.5), (100.0, 0.01), (100.0, 10.0))]
)
@pytest.mark.slow
def test_line_contact_has_the_derivatives_of_hunters_closed_form(k: float, length: float) -> None:
    E0, ratio, radius, load = 1e6, 0.5, 10e-3, 100.0
    E_inf, C = k * E0, (1.0 - 1.0 / k) / E0
    a0 = hunter_line(load, radius, E0, E_inf, 1e-3, 1.0, ratio).hertz.half_width

    def exact(C: float, E_inf: float, tau: float, load: float) -> float:
        E0 = 1.0 / (1.0 / E_inf + C)
        return hunter_line(load, radius, E0, E_inf, tau, 1.0, ratio).friction_coefficient

    tau = length * a0
    solution = solve_steady(
        Material(RetardationSpectrum(E0, E_inf, [C], [tau]), poisson_ratio=ratio),
        Cylinder(radius=radius),
        speed=1.0,
        load=load,
        derivatives=True,
    )
    assert solution.derivatives is not None
    found = solution.derivatives.logarithmic
    point = np.array([C, E_inf, tau, load])

    def change(place: int) -> float:
        away = np.zeros(4)
        away[place] = 1e-4
        return (exact(*(point * (1.0 + away))) - exact(*(point * (1.0 - away)))) / 2e-4

    values = np.array([found.C[0], found.E_inf, found.tau[0], found.load or 0.0])
    exactly = np.array([change(place) for place in range(4)])
    assert np.abs(values - exactly).max() <= solution.derivatives.error
    # On cells that stay where they are, it would be 0.01 to 0.1: with an error of 1e-4 that changes from cell to cell.
    assert np.abs(values - exactly).max() <= 4e-3 * np.abs(exactly).max()


@pytest.mark.parametrize(
    ("layer", "accuracy", "near"),
    # Of μ = 0.058: the two solutions are right to less than 5e-5 of it, which the step of 0.12 divides, and the step's
    # own error is 6e-4 of the third derivative.
    [*slow((None, 1e-3, 1.5e-4), (Layer(thickness=1e-3), 1e-3, 1.5e-4)), *apart((None, 3e-4, 8e-5))],
)
def test_ball_has_the_derivatives_of_its_friction_over_finite_steps(
    layer: Layer | None, accuracy: float, near: float
) -> None:
    rubber = Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)

    def over(name: str) -> float:
        up, down = (
            solve_steady(rubber, BALL, accuracy=accuracy, layer=layer, **({"speed": 1.0, "load": 1.0} | {name: value}))  # type: ignore[arg-type]
            for value in (1.06, 1.0 / 1.06)
        )
        return (up.friction_coefficient - down.friction_coefficient) / (2.0 * np.log(1.06))

    found = solved([0.9e-6], [1e-3], E_inf=1e7, speed=1.0, accuracy=accuracy, layer=layer).logarithmic  # type: ignore[arg-type]
    assert found.speed == pytest.approx(over("speed"), abs=near)
    assert found.load == pytest.approx(over("load"), abs=near)


@pytest.mark.slow
def test_cone_has_the_derivatives_of_its_friction_over_finite_steps() -> None:
    """Its tip stays where it is in its cells: where they shift with the contact, it is 5 % off and the error 2 %."""
    rubber, cone = Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3), Cone("5 deg")

    def friction_at(speed: float) -> float:
        return solve_steady(rubber, cone, speed=speed, load=1.0).friction_coefficient

    # The two solutions are right to 3e-4, which the step of 0.2 divides; the step's own error is less.
    over = (friction_at(0.33) - friction_at(0.3 / 1.1)) / (2.0 * np.log(1.1))
    found = solve_steady(rubber, cone, speed=0.3, load=1.0, derivatives=True).derivatives
    assert found is not None
    assert found.logarithmic.speed == pytest.approx(over, rel=4e-3)
    assert abs(found.logarithmic.speed - over) <= found.error
    # μ depends on v/a alone, and a ∝ √F: the same but for what grids know.
    assert found.logarithmic.load == pytest.approx(-0.5 * found.logarithmic.speed, abs=found.error)


@pytest.mark.slow
@settings(max_examples=4, deadline=None)
@given(
    shares=st.lists(st.floats(0.05, 1.0), min_size=1, max_size=4),
    decades=st.lists(st.floats(-5.0, -1.0), min_size=4, max_size=4, unique=True),
    k=st.floats(1.5, 30.0),
    way=st.sampled_from(["load", "indentation"]),
)
def test_similarity_ties_the_derivatives_together(
    shares: list[float], decades: list[float], k: float, way: str
) -> None:
    E_inf = k * 1e6
    C = np.array(shares) / sum(shares) * (1e-6 - 1.0 / E_inf)
    tau = 10.0 ** np.array(decades[: len(C)])
    held = {"load": 1.0} if way == "load" else {"indentation": 5e-5}
    rubber = Material(RetardationSpectrum(1e6, E_inf, C, tau))
    solution = solve_steady(rubber, BALL, speed=0.3, accuracy=0.1, derivatives=True, **held)  # type: ignore[arg-type]
    assert solution.derivatives is not None
    found = solution.derivatives.logarithmic
    # Stiffness and load have one effect whatever the shape; at a given depth stiffness has none.  Exactly so on the
    # cells; the adjoint problem is solved to 1e-8.
    size = np.abs(found.C).sum() + abs(found.E_inf)
    assert found.C.sum() - found.E_inf == pytest.approx(found.load or 0.0, abs=1e-7 * size)
    assert found.speed == pytest.approx(found.tau.sum(), rel=1e-12)
    if found.load is not None:
        # For a ball μ = (a0/R) Φ(v/a0), which a grid knows only as well as the derivatives settle.
        expected = (solution.friction_coefficient - found.speed) / 3.0
        assert found.load == pytest.approx(expected, abs=3.0 * solution.derivatives.error)


@pytest.mark.slow
def test_modes_that_are_split_or_empty_share_their_derivative() -> None:
    whole = solved([6e-7, 3e-7], [1e-3, 1e-4], accuracy=0.1)
    parts = solved([4e-7, 3e-7, 2e-7, 0.0], [1e-3, 1e-4, 1e-3, 1e-4], accuracy=0.1)
    near = {"rel": 1e-6}  # the tolerance of the two solutions, 1e-8, in derivatives
    assert list(parts.C) == pytest.approx(whole.C[[0, 1, 0, 1]], **near)
    assert parts.tau == pytest.approx(whole.tau[[0, 1, 0, 1]] * [2 / 3, 1.0, 1 / 3, 0.0], **near)
    assert parts.E_inf == pytest.approx(whole.E_inf, **near)
    assert parts.load == pytest.approx(whole.load, **near)


def test_reversed_motion_reverses_friction_but_not_its_derivative_with_speed() -> None:
    ahead, back = (solved([6e-7], [1e-3], indenter=CYLINDER, speed=speed, accuracy=0.1) for speed in (0.5, -0.5))
    assert list(back.C) == pytest.approx(-ahead.C)
    assert back.tau == pytest.approx(-ahead.tau)
    assert (back.E_inf, back.load) == pytest.approx((-ahead.E_inf, -(ahead.load or 0.0)))
    assert back.speed == pytest.approx(ahead.speed)


def test_elastic_indenter_is_a_part_of_the_glass() -> None:
    modulus = 1e7
    counter = (1.0 - 0.3**2) / modulus / (1.0 - 0.5**2)  # as a compliance of the rubber
    rigid = solved([6e-7], [1e-3], E_inf=1.0 / (1.0 / 2e7 + counter), indenter=CYLINDER, accuracy=0.1)
    elastic = solved([6e-7], [1e-3], E_inf=2e7, indenter=CYLINDER, indenter_modulus=modulus, accuracy=0.1)
    near = {"rel": 1e-6}  # the tolerance of the two solutions, 1e-8, in derivatives
    assert list(elastic.C) == pytest.approx(rigid.C, **near)
    assert elastic.load == pytest.approx(rigid.load, **near)
    assert elastic.E_inf * (2e7) ** 2 == pytest.approx(rigid.E_inf / (1.0 / 2e7 + counter) ** 2, **near)


def test_units_do_not_matter() -> None:
    def log_derivatives(length: float, time: float, modulus: float) -> Array:
        spectrum = RetardationSpectrum(1e6 * modulus, 1e7 * modulus, [0.9e-6 / modulus], [1e-3 * time])
        solution = solve_steady(
            Material(spectrum),
            Cylinder(10e-3 * length),
            speed=0.5 * length / time,
            load=100.0 * modulus * length,
            accuracy=0.1,
            derivatives=True,
        )
        assert solution.derivatives is not None
        one = solution.derivatives
        plain = np.array([one.C[0] / modulus, one.E_inf * modulus, one.tau[0] * time, one.speed * length / time])
        return np.append(plain, (one.load or 0.0) * modulus * length)

    assert log_derivatives(1e-3, 1e9, 1e6) == pytest.approx(log_derivatives(1.0, 1.0, 1.0), rel=1e-6)


@pytest.mark.parametrize("speed", [0.0, np.inf])
def test_elastic_limits_are_refused(speed: float) -> None:
    with refused("elastic-limit"):
        solved([6e-7], [1e-3], speed=speed)


@pytest.mark.slow
def test_layer_is_a_half_space_where_it_is_thick() -> None:
    thick, half = (solved([6e-7], [1e-3], accuracy=0.1, layer=layer) for layer in (Layer(thickness=1e3), None))  # type: ignore[arg-type]
    near = {"rel": 1e-5}  # the contact's size over the thickness, 1e-6, and the tolerance of the solutions
    assert list(thick.C) == pytest.approx(half.C, **near)
    assert (thick.E_inf, thick.speed, thick.load) == pytest.approx((half.E_inf, half.speed, half.load), **near)


def test_transposed_operator_has_the_transposed_matrix() -> None:
    solid = SteadyMaterial(0.1, np.array([0.5, 0.4]), np.array([0.3, 5.0]))
    operator = HalfSpaceOperator(Grid(0.1, 5, 7, 4), solid, shift=0.2)
    a, b = np.random.default_rng(4).normal(size=(2, 12, 8))
    assert np.vdot(operator.transposed()(a), b) == pytest.approx(np.vdot(a, operator(b)), rel=1e-12)
    assert np.vdot(operator.transposed().precondition(a), b) == pytest.approx(
        np.vdot(a, operator.precondition(b)), rel=1e-12
    )
    # A quadratic form: exact for any step.
    slope = (operator.dissipated_force(a + b) - operator.dissipated_force(a - b)) / 2.0
    assert np.vdot(operator.dissipated_force_gradient(a), b) == pytest.approx(slope, rel=1e-10)


def test_other_arrays_give_the_same_derivatives() -> None:
    pytest.importorskip("array_api_strict")
    arguments = {"indenter": CYLINDER, "accuracy": 0.1, "tolerance": 1e-11}
    usual, strict = (solved([6e-7], [1e-3], **arguments, backend=name) for name in ("scipy", "array_api_strict"))  # type: ignore[arg-type]
    assert (strict.C[0], strict.E_inf, strict.speed, strict.load) == pytest.approx(
        (usual.C[0], usual.E_inf, usual.speed, usual.load),
        rel=1e-6,  # the adjoint problem is solved to 1e-8
    )


def test_derivatives_are_left_out_unless_asked_for() -> None:
    solution = solve_steady(material([6e-7], [1e-3]), BALL, speed=0.5, load=1.0, accuracy=0.1)
    assert solution.derivatives is None
