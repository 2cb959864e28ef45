"""Ellipsoid, cone, flat punch, height map, given indentation, elastic indenter: elastic limits, speeds, refusals."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from gallery import BALL_RADIUS, HERTZ_RADIUS, LOAD, POISSON_RATIO, RUBBER_MODULUS, SPEED, standard_linear_solid
from marks import slow
from refusals import refused
from viscofric.contact.free.grids import Extent
from viscofric.contact.free.scale import Scale, root
from viscofric.contact.indenters.height_map import HeightMap, Profile
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, Cone, Cylinder, Ellipsoid, FlatPunch
from viscofric.contact.reference import flat_punch, hertz_ellipse, sneddon_cone
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.notes import codes, note_of
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

RUBBER = standard_linear_solid(10.0, 1.0).material
SPECTRUM = RUBBER.spectrum
STIFFNESS = RUBBER_MODULUS / (1.0 - POISSON_RATIO**2)
ELLIPSOID = Ellipsoid(radius_x=BALL_RADIUS, radius_y=4.0 * BALL_RADIUS)
CONE = Cone(angle="5 deg")
PUNCH = FlatPunch(radius=HERTZ_RADIUS)

#: Half a side of the map, and the distance of its points.
MAP_HALF, MAP_STEP = 1.5e-3, 5e-5


def map_points() -> tuple[np.ndarray, np.ndarray]:
    one = np.arange(-MAP_HALF, MAP_HALF + 0.5 * MAP_STEP, MAP_STEP)
    return one[:, None], one


def rough_map() -> np.ndarray:
    """Heights of a ball with waves of a few micrometres and no symmetry along x, m."""
    x, y = map_points()
    waves = 2e-6 * np.cos(1.1e4 * x + 0.3) * np.cos(9e3 * y) + 1e-6 * np.sin(6e3 * x)
    return np.asarray((x**2 + y**2) / (2.0 * BALL_RADIUS) + waves)


# --- elastic limits -------------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "modulus_ratio"), [(0.0, 1.0), (math.inf, 10.0)], ids=["v = 0", "v = ∞"])
@pytest.mark.parametrize("ratio", [0.25, 1.5, 20.0])
def test_ellipsoid_makes_hertz_elliptic_contact(speed: float, modulus_ratio: float, ratio: float) -> None:
    indenter = Ellipsoid(radius_x=BALL_RADIUS, radius_y=ratio * BALL_RADIUS)
    hertz = hertz_ellipse(LOAD, BALL_RADIUS, ratio * BALL_RADIUS, modulus_ratio * RUBBER_MODULUS, POISSON_RATIO)
    solution = solve_steady(RUBBER, indenter, speed=speed, load=LOAD)
    cell = solution.diagnostics.spacing
    # Edges to a fifth of a cell; the shorter axis has 30 cells at least.
    assert solution.front == pytest.approx(hertz.semi_axis_x, abs=0.2 * cell)
    assert solution.rear == pytest.approx(hertz.semi_axis_x, abs=0.2 * cell)
    width = solution.y[1] - solution.y[0]
    assert solution.half_width == pytest.approx(hertz.semi_axis_y, abs=0.2 * width)
    assert solution.contact_area == pytest.approx(math.pi * hertz.semi_axis_x * hertz.semi_axis_y, rel=0.01)
    assert solution.indentation == pytest.approx(hertz.indentation, rel=0.001)  # second order, 30 cells
    assert solution.max_pressure == pytest.approx(hertz.max_pressure, rel=0.002)
    assert abs(solution.friction_coefficient) < 1e-12  # symmetric: round-off


@pytest.mark.parametrize(("speed", "modulus_ratio"), [(0.0, 1.0), (math.inf, 10.0)], ids=["v = 0", "v = ∞"])
def test_cone_makes_sneddons_contact(speed: float, modulus_ratio: float) -> None:
    sneddon = sneddon_cone(LOAD, math.tan(math.radians(5.0)), modulus_ratio * RUBBER_MODULUS, POISSON_RATIO)
    solution = solve_steady(RUBBER, CONE, speed=speed, load=LOAD)
    assert solution.indentation == pytest.approx(sneddon.indentation, rel=1e-3)  # 128 cells
    for edge in (solution.front, solution.rear, solution.half_width):
        assert edge == pytest.approx(sneddon.radius, abs=0.2 * solution.diagnostics.spacing)
    assert solution.contact_area == pytest.approx(math.pi * sneddon.radius**2, rel=5e-3)
    # Its pressure is infinite at the tip, as the logarithm of the distance: no grid has a largest one, and what a
    # billionth of a cell would see is within the error.
    assert not solution.diagnostics.peak_resolved
    beyond = float(sneddon.pressure(np.array(1e-9 * solution.diagnostics.spacing)))
    assert 2.0 * solution.max_pressure < beyond < solution.max_pressure + solution.diagnostics.max_pressure_error
    assert abs(solution.friction_coefficient) < 1e-12


@pytest.mark.parametrize(("speed", "modulus_ratio"), [(0.0, 1.0), (math.inf, 10.0)], ids=["v = 0", "v = ∞"])
def test_flat_punch_is_sneddons(speed: float, modulus_ratio: float) -> None:
    depth = 1e-5
    known = flat_punch(depth, HERTZ_RADIUS, modulus_ratio * RUBBER_MODULUS, POISSON_RATIO)
    solution = solve_steady(RUBBER, PUNCH, speed=speed, indentation=depth)
    assert solution.indentation == depth
    # The edge is a staircase and its pressure infinite: first order in the cell, of which the radius has 49.
    assert solution.load == pytest.approx(known.load, rel=0.01)
    assert solution.contact_area == pytest.approx(math.pi * HERTZ_RADIUS**2, rel=0.02)
    assert not solution.diagnostics.peak_resolved
    middle = solution.pressure[np.ix_(np.abs(solution.x) < 1e-4, np.abs(solution.y) < 1e-4)]
    pressure = known.load / (2.0 * math.pi * HERTZ_RADIUS**2)  # at the centre; 2 % more at a fifth of the radius
    assert middle.mean() == pytest.approx(pressure, rel=0.03)
    held = solve_steady(RUBBER, PUNCH, speed=speed, load=solution.load)
    assert held.indentation == pytest.approx(depth, rel=2e-3)  # each on its own grid, a staircase of its own


def test_errors_of_the_elastic_load_fall_with_the_grid() -> None:
    known = sneddon_cone(LOAD, math.tan(math.radians(5.0)), RUBBER_MODULUS, POISSON_RATIO)
    solution = solve_steady(RUBBER, CONE, speed=1e-4 * SPEED, load=LOAD, accuracy=0.01)
    indentations = np.array([level.indentation for level in solution.diagnostics.levels])
    errors = np.abs(indentations / known.indentation - 1.0)
    # At this speed the contact is elastic to 1e-4, the first grid is off by more, the last is not.
    assert errors[-1] < 5e-4
    assert errors[-1] < 0.5 * errors[0] or errors[0] < 5e-4


# --- slow and fast, by laws of their own ----------------------------------------------------------

CREEP = RUBBER_MODULUS * float(np.dot(SPECTRUM.C, SPECTRUM.tau))  # Σ C_k τ_k E0, s
FORGETTING = float(SPECTRUM.E_inf * np.sum(SPECTRUM.C / SPECTRUM.tau))  # Σ C_k E∞/τ_k, 1/s


@pytest.mark.parametrize("ratio", [0.25, 4.0])
def test_slow_ellipsoid_feels_its_curvature_along_the_motion(ratio: float) -> None:
    """F_t = v ΣC_kτ_kE0 ∫ p ∂²h/∂x² dA: for v → 0 the paraboloid's curvature along x alone."""
    speed = 1e-4 * SPEED
    indenter = Ellipsoid(radius_x=BALL_RADIUS, radius_y=ratio * BALL_RADIUS)
    solution = solve_steady(RUBBER, indenter, speed=speed, load=LOAD, accuracy=5e-3)
    # The accuracy asked for; the law's next term is about l log l = 1e-3.
    assert solution.friction_coefficient == pytest.approx(speed * CREEP / BALL_RADIUS, rel=7e-3)


@pytest.mark.parametrize(
    ("indenter", "share"),
    [(ELLIPSOID, 4.0 / 5.0), (CONE, 2.0 / 3.0)],
    ids=["ellipsoid", "cone"],
)
def test_fast_contacts_forget_slowly(indenter: Indenter, share: float) -> None:
    """For v → ∞ friction is μ = ΣC_kE∞/(vτ_k) ∫ p u dA/F, p and u those of the elastic contact at E∞.

    The integral is F δ times 2/(m + 1) for a load that grows as the m-th power of the indentation.
    """
    speed = 1e5 * SPEED
    fast = solve_steady(RUBBER, indenter, speed=speed, load=LOAD, accuracy=1e-3)
    glass = solve_steady(RUBBER, indenter, speed=math.inf, load=LOAD)
    law = share * glass.indentation * FORGETTING / speed
    # The accuracy asked for; the law's next term is k/l ln(l/k) = 1e-3.
    assert fast.friction_coefficient == pytest.approx(law, rel=4e-3)


# --- viscoelastic contacts: two ways to the friction, refinement, mirror ---------------------------

VISCOELASTIC: dict[str, Indenter] = {
    "ellipsoid across": ELLIPSOID,
    "ellipsoid along": Ellipsoid(radius_x=8.0 * BALL_RADIUS, radius_y=BALL_RADIUS),
    "cone": CONE,
    "height map": HeightMap(rough_map(), spacing=MAP_STEP),
}


@pytest.mark.parametrize("name", [*slow("ellipsoid across", "ellipsoid along"), "cone", *slow("height map")])
def test_friction_and_dissipated_energy_agree(name: str) -> None:
    accuracy = 2e-3
    coarse = solve_steady(RUBBER, VISCOELASTIC[name], speed=SPEED, load=LOAD, accuracy=accuracy)
    fine = solve_steady(RUBBER, VISCOELASTIC[name], speed=SPEED, load=LOAD, accuracy=0.25 * accuracy)
    assert abs(fine.diagnostics.energy) <= accuracy
    assert coarse.friction_coefficient == pytest.approx(fine.friction_coefficient, rel=1.25 * accuracy)
    assert fine.diagnostics.friction_error <= 0.25 * accuracy * fine.friction_coefficient
    assert coarse.indentation == pytest.approx(fine.indentation, rel=0.005)  # 128 cells at least
    assert fine.load == pytest.approx(LOAD, rel=1e-12)  # scaled to the load: round-off


@pytest.mark.parametrize("speed", [1e-6 * SPEED, SPEED, -1e3 * SPEED])
def test_a_sharp_edge_is_refused_in_motion(speed: float) -> None:
    with refused("sharp-edge"):
        solve_steady(RUBBER, PUNCH, speed=speed, load=LOAD)


@pytest.mark.parametrize("name", ["ellipsoid across", "cone", *slow("ellipsoid along", "height map")])
def test_mirrored_shapes_make_mirrored_contacts(name: str) -> None:
    indenter = VISCOELASTIC[name]
    mirrored = HeightMap(rough_map()[::-1], MAP_STEP) if isinstance(indenter, HeightMap) else indenter
    there = solve_steady(RUBBER, indenter, speed=SPEED, load=LOAD, accuracy=0.01)
    back = solve_steady(RUBBER, mirrored, speed=-SPEED, load=LOAD, accuracy=0.01)
    # The same problem but for the rounding of a mirrored spline, solved to 1e-8.
    assert back.friction_coefficient == pytest.approx(-there.friction_coefficient, rel=1e-5)
    assert (back.front, back.rear) == pytest.approx((there.front, there.rear), rel=1e-5)
    assert back.centre_of_pressure == pytest.approx(-there.centre_of_pressure, rel=1e-5)
    np.testing.assert_allclose(back.pressure, there.pressure[::-1], atol=1e-4 * there.max_pressure)


def test_friction_of_an_asymmetric_surface_depends_on_the_direction() -> None:
    indenter = VISCOELASTIC["height map"]
    there, back = (solve_steady(RUBBER, indenter, speed=v, load=LOAD, accuracy=0.01) for v in (SPEED, -SPEED))
    assert back.friction_coefficient < 0.0 < there.friction_coefficient
    assert abs(back.friction_coefficient + there.friction_coefficient) > 0.03 * there.friction_coefficient


@pytest.mark.parametrize("name", ["ellipsoid across", "cone", *slow("ellipsoid along", "height map")])
def test_units_do_not_matter_to_any_shape(name: str) -> None:
    moduli, lengths, times = 1e6, 1e-3, 1e9
    scaled: dict[str, Indenter] = {
        "ellipsoid across": Ellipsoid(lengths * BALL_RADIUS, 4.0 * lengths * BALL_RADIUS),
        "ellipsoid along": Ellipsoid(8.0 * lengths * BALL_RADIUS, lengths * BALL_RADIUS),
        "cone": CONE,
        "height map": HeightMap(lengths * rough_map(), spacing=lengths * MAP_STEP),
    }
    rubber = Material(
        RetardationSpectrum(
            E0=moduli * SPECTRUM.E0,
            E_inf=moduli * SPECTRUM.E_inf,
            C=SPECTRUM.C / moduli,
            tau=times * SPECTRUM.tau,
        )
    )
    here = solve_steady(RUBBER, VISCOELASTIC[name], speed=SPEED, load=LOAD, accuracy=0.01)
    there = solve_steady(
        rubber, scaled[name], speed=SPEED * lengths / times, load=LOAD * moduli * lengths**2, accuracy=0.01
    )
    # Rounding of the inputs, through one and the same sequence of steps.
    assert there.friction_coefficient == pytest.approx(here.friction_coefficient, rel=1e-7)
    assert there.indentation == pytest.approx(lengths * here.indentation, rel=1e-7)
    assert there.contact_area == pytest.approx(lengths**2 * here.contact_area, rel=1e-6)


# --- the same thing said in two ways --------------------------------------------------------------


def same(one: ContactSolution, other: ContactSolution, rel: float) -> None:
    for name in ("friction_coefficient", "load", "indentation", "front", "rear", "half_width", "contact_area"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=rel), name


@pytest.mark.parametrize(
    "surface",
    [Ball(BALL_RADIUS), Cylinder(BALL_RADIUS), ELLIPSOID, CONE, HeightMap(rough_map(), MAP_STEP)],
    ids=lambda one: one.noun,
)
def test_slopes_are_derivatives_of_the_heights(surface: Indenter) -> None:
    """Along the motion friction is made of them, across it the lateral force."""
    x, y = np.random.default_rng(1).uniform(0.1 * MAP_HALF, 0.6 * MAP_HALF, (2, 20))
    step = 1e-7  # m: waves of some 0.1 mm leave (step/0.1 mm)² = 1e-6 of their slopes of 0.02
    along = (surface.height(x + step, y) - surface.height(x - step, y)) / (2.0 * step)
    across = (surface.height(x, y + step) - surface.height(x, y - step)) / (2.0 * step)
    np.testing.assert_allclose(surface.slope(x, y), along, atol=1e-7)
    np.testing.assert_allclose(surface.slope_across(x, y), across, atol=1e-7)


def test_round_ellipsoid_is_a_ball() -> None:
    ball = solve_steady(RUBBER, Ball(BALL_RADIUS), speed=SPEED, load=LOAD)
    same(solve_steady(RUBBER, Ellipsoid(BALL_RADIUS, "10 mm"), speed=SPEED, load=LOAD), ball, 1e-9)  # round-off


def test_height_map_of_a_ball_is_a_ball() -> None:
    x, y = map_points()
    z = (x**2 + y**2) / (2.0 * BALL_RADIUS)
    given = {"speed": SPEED, "load": LOAD, "tolerance": 1e-10}
    ball = solve_steady(RUBBER, Ball(BALL_RADIUS), **given)
    # A bicubic spline through a paraboloid is the paraboloid: round-off, and the solver's tolerance.
    same(solve_steady(RUBBER, HeightMap(z, MAP_STEP), **given), ball, 1e-7)
    # Off centre, from another level, every other point across.
    part = HeightMap(z[8:, 2::2] - 3.0, spacing=(MAP_STEP, "0.1 mm"))
    same(solve_steady(RUBBER, part, **given), ball, 1e-6)  # and the rounding of 3 m


@pytest.mark.parametrize("noise", [0.0, 1e-9, 1e-6])
def test_noise_that_bends_a_measured_surface_is_noted(noise: float) -> None:
    """Between points 50 µm apart a ball rises by 0.1 µm; noise of 1 µm bends it many times as much."""
    x, y = map_points()
    z = (x**2 + y**2) / (2.0 * BALL_RADIUS) + noise * np.random.default_rng(1).normal(size=(len(x), len(y)))
    for indenter, load in ((HeightMap(z, MAP_STEP), LOAD), (Profile(z[:, len(y) // 2], MAP_STEP), 100.0)):
        found = solve_steady(RUBBER, indenter, speed=SPEED, load=load, accuracy=0.05)
        ratios = [note.values["ratio"] for note in map(note_of, found.warnings) if note.code == "heights-unresolved"]
        assert len(ratios) == (noise > 1e-8)
        assert all(2.0 < ratio < 4.5 for ratio in ratios)  # 4 for noise alone


@pytest.mark.parametrize("surface", [CONE, Ball(BALL_RADIUS)], ids=lambda one: one.noun)
def test_smooth_surfaces_and_kinks_are_resolved(surface: Indenter) -> None:
    for first in (0, 1):  # the kink on a point of either parity; facets are straight but for rounding
        ridge = Profile(0.05 * np.abs(MAP_STEP * np.arange(first - 40, 41)), MAP_STEP)
        assert ridge.resolution_warning(Extent(1e-3, 1e-3, 0.0)) is None
        assert ridge.resolution_warning(Extent(1.5e-3, -5e-4, 0.0)) is None
    x, y = map_points()
    found = solve_steady(RUBBER, HeightMap(surface.height(x, y), MAP_STEP), speed=SPEED, load=LOAD, accuracy=0.05)
    assert "heights-unresolved" not in codes(found.warnings)


@pytest.mark.parametrize("indenter", [Ball(BALL_RADIUS), ELLIPSOID, CONE], ids=lambda one: one.noun)
def test_given_indentation_is_the_inverse_of_a_given_load(indenter: Indenter) -> None:
    accuracy = 1e-3
    pressed = solve_steady(RUBBER, indenter, speed=SPEED, load=LOAD, accuracy=accuracy)
    pushed = solve_steady(RUBBER, indenter, speed=SPEED, indentation=pressed.indentation, accuracy=accuracy)
    # Other units, hence other grids, each with its own error: of the indentation 1e-4, of the load 3/2 or 2 of it.
    assert pushed.load == pytest.approx(pressed.load, rel=1e-3)
    assert pushed.indentation == pytest.approx(pressed.indentation, rel=1e-12)
    assert pushed.friction_coefficient == pytest.approx(pressed.friction_coefficient, rel=2.0 * accuracy)
    assert pushed.diagnostics.indentation_error == 0.0
    assert 0.0 < pushed.diagnostics.load_error < 0.01 * LOAD
    assert pressed.diagnostics.load_error < 1e-12 * LOAD


@pytest.mark.slow
def test_elastic_indenter_adds_its_compliance() -> None:
    """Two bodies in series are one with (1−ν²)/E0 + c and (1−ν²)/E∞ + c: a softer rubber on a rigid ball."""
    modulus, ratio = 2.5e6, 0.3
    both = solve_steady(
        RUBBER, Ball(BALL_RADIUS), speed=SPEED, load=LOAD, indenter_modulus=modulus, indenter_poisson_ratio=ratio
    )
    extra = (1.0 - ratio**2) / modulus / (1.0 - POISSON_RATIO**2)
    softer = RetardationSpectrum(
        E0=1.0 / (1.0 / SPECTRUM.E0 + extra), E_inf=1.0 / (1.0 / SPECTRUM.E_inf + extra), C=SPECTRUM.C, tau=SPECTRUM.tau
    )
    one = solve_steady(Material(softer, poisson_ratio=POISSON_RATIO), Ball(BALL_RADIUS), speed=SPEED, load=LOAD)
    same(both, one, 1e-9)  # the same numbers in another order
    rigid = solve_steady(RUBBER, Ball(BALL_RADIUS), speed=SPEED, load=LOAD)
    steel = solve_steady(RUBBER, Ball(BALL_RADIUS), speed=SPEED, load=LOAD, indenter_modulus="1e9 GPa")
    same(steel, rigid, 1e-8)  # 1e-12 of the compliance, and the solver's tolerance
    assert both.friction_coefficient < rigid.friction_coefficient


def test_elastic_indenter_in_the_limits_of_speed() -> None:
    modulus = 2.0 * RUBBER_MODULUS
    for speed, plateau in ((0.0, RUBBER_MODULUS), (math.inf, 10.0 * RUBBER_MODULUS)):
        found = solve_steady(
            RUBBER, Ball(BALL_RADIUS), speed=speed, load=LOAD, indenter_modulus=modulus, indenter_poisson_ratio=0.5
        )
        series = 0.75 / (0.75 / plateau + 0.75 / modulus)
        hertz = hertz_ellipse(LOAD, BALL_RADIUS, BALL_RADIUS, series, POISSON_RATIO)
        assert found.indentation == pytest.approx(hertz.indentation, rel=0.0005)  # 128 cells


@pytest.mark.parametrize(
    ("indenter", "length"),
    [
        (Ball(BALL_RADIUS), HERTZ_RADIUS),
        (Ellipsoid(BALL_RADIUS, BALL_RADIUS), HERTZ_RADIUS),
        (Cylinder(BALL_RADIUS), math.sqrt(4.0 * LOAD * BALL_RADIUS / (math.pi * STIFFNESS))),
        (PUNCH, HERTZ_RADIUS),
    ],
    ids=lambda one: getattr(one, "noun", ""),
)
def test_contacts_are_solved_in_units_of_their_own_size(indenter: Indenter, length: float) -> None:
    scale = Scale.for_load(indenter, STIFFNESS, LOAD)
    assert scale.length == pytest.approx(length, rel=1e-12)  # bisected to the last digits
    assert scale.force * indenter.geometry.parabolic_load == pytest.approx(LOAD, rel=1e-12)


# --- what is refused or doubtful ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "about"),
    [
        ({}, "give-one"),
        ({"indentation": 0.0}, "indentation"),
        ({"indentation": "5 N"}, "indentation"),
        ({"indentation": 0.1, "speed": 0.0}, "beyond-indenter"),
        ({"load": 1.0, "indenter_modulus": -1.0}, "indenter_modulus"),
        ({"load": 1.0, "indenter_modulus": 1e9, "indenter_poisson_ratio": 0.7}, "indenter_poisson_ratio"),
        ({"load": 1.0, "finest": 16}, "finest"),
    ],
    ids=str,
)
def test_unusable_ways_to_hold_a_ball_are_refused(arguments: dict[str, float | str], about: str) -> None:
    with refused(about):
        solve_steady(RUBBER, Ball(BALL_RADIUS), **{"speed": SPEED, **arguments})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("make", "about"),
    [
        (lambda: Ellipsoid(0.0, 1.0), "radius_x"),
        (lambda: Ellipsoid(1.0, "3 s"), "radius_y"),
        (lambda: Cylinder("-1 mm"), "radius"),
        (lambda: Cone("95 deg"), "angle"),
        (lambda: Cone(0.0), "angle"),
        (lambda: HeightMap(np.zeros(9), 1.0), "z"),
        (lambda: HeightMap(np.zeros((9, 3)), 1.0), "z"),
        (lambda: HeightMap(np.zeros((9, 9)), (1.0, 1.0, 1.0)), "spacing"),
        (lambda: HeightMap(np.zeros((9, 9)), -1.0), "spacing"),
        (lambda: Profile(np.zeros((9, 9)), 1.0), "z"),
        (lambda: Profile(np.zeros(9), "1 N"), "spacing"),
    ],
)
def test_indenters_without_a_shape_are_refused(make, about: str) -> None:
    with refused(about):
        make()


def test_flat_surface_is_refused() -> None:
    with refused("flat"):
        solve_steady(RUBBER, HeightMap(np.zeros((9, 9)), 1e-4), speed=SPEED, load=LOAD)


def test_contact_beyond_the_height_map_is_refused() -> None:
    small = HeightMap(rough_map()[20:-20, 20:-20], MAP_STEP)
    with refused("beyond-indenter"):
        solve_steady(RUBBER, small, speed=SPEED, load=LOAD)


@pytest.mark.parametrize(
    ("indenter", "arguments", "reported"),
    [
        (Cone("20 deg"), {"load": LOAD}, ("slope", 0.36)),
        (Ellipsoid(BALL_RADIUS, 0.1 * BALL_RADIUS), {"load": 10.0 * LOAD}, ("slope", None)),
        (PUNCH, {"indentation": 0.4 * HERTZ_RADIUS}, ("slope", 0.4)),
        (HeightMap(rough_map() * 15.0, MAP_STEP), {"load": LOAD}, ("slope", None)),
    ],
    ids=["cone", "ellipsoid", "punch", "map"],
)
def test_steep_indenters_are_a_warning(
    indenter: Indenter, arguments: dict[str, float], reported: tuple[str, float | None]
) -> None:
    solution = solve_steady(RUBBER, indenter, speed=0.0, **arguments)
    (warning,) = solution.warnings
    assert warning.code == "large-strain"
    name, size = reported
    assert warning.values[name] > warning.values["limit"] == 0.3
    assert size is None or warning.values[name] == pytest.approx(size, abs=5e-3)


def test_steepness_is_that_of_the_spline_through_few_heights() -> None:
    """Of eight points a wave, where differences of neighbours would be a tenth smaller, and below the limit."""
    x = 1e-4 * np.arange(-7, 8)
    waves = 0.32 * 8e-4 / (2.0 * np.pi) * (1.0 - np.cos(2.0 * np.pi * x / 8e-4))
    for indenter in (Profile(waves, 1e-4), HeightMap(np.add.outer(waves, 1e-3 * waves), 1e-4)):
        warning = indenter.strain_warning(Extent(4e-4, 4e-4, 4e-4), 1e-5)
        assert warning is not None
        assert warning.values["slope"] == pytest.approx(0.32, rel=5e-3)  # of the spline, whose error is 0.25 %


def test_gentle_indenters_are_none() -> None:
    assert solve_steady(RUBBER, CONE, speed=0.0, load=LOAD).warnings == ()
    assert solve_steady(RUBBER, VISCOELASTIC["height map"], speed=0.0, load=LOAD).warnings == ()


@pytest.mark.parametrize("speed", [0.0, 0.3 * SPEED, SPEED])
def test_what_was_given_comes_back_to_the_last_digit(speed: float) -> None:
    # Tables group cases by their load: the rounding of a sum of pressures would make many loads of one.
    ball = Ball(BALL_RADIUS)
    under_load = solve_steady(RUBBER, ball, speed=speed, load=LOAD, accuracy=0.05)
    assert under_load.load == LOAD
    pressed = solve_steady(RUBBER, ball, speed=speed, indentation=under_load.indentation, accuracy=0.05)
    assert pressed.indentation == under_load.indentation
    # The same contact, found from its load and from its depth; both to the accuracy of coarse grids.
    assert pressed.load == pytest.approx(LOAD, rel=0.05)


@pytest.mark.parametrize(
    ("function", "zero"),
    [
        (lambda x: 2.0 * x - 1.0, 0.5),
        (lambda x: min(x, 0.5 * x + 0.5) - 2.0, 3.0),
        (lambda x: math.inf if x > 2.0 else x - 1.25, 1.25),  # beyond the edge of a map
        (lambda x: math.inf if x > 2.0 else -1e-3, 2.0),
        (lambda x: -700.0 if x < 2.0 else x - 1.5, 2.0),
    ],
    ids=["power", "two powers", "height map", "punch", "flat bottom"],
)
def test_size_of_a_contact_is_found_to_rounding(function: Callable[[float], float], zero: float) -> None:
    assert root(function, -50.0, 9.0) == pytest.approx(zero, rel=3e-15)  # rounding
