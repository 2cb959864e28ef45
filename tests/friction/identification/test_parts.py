"""The parts of an identification, each against what is known of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from friction.identification.planted import BALL, LOAD, RUBBER
from friction.synthetic_curves import curves_of
from refusals import refused
from viscofric.friction.curve_checks import moderated_variances
from viscofric.friction.identification.anchors import compliance, known_part, log_modulus
from viscofric.friction.identification.forward import FirstOrder
from viscofric.friction.identification.points import SharedErrors, usable_points
from viscofric.friction.identification.posterior import descend, draws, log_evidence
from viscofric.friction.identification.problem import Shifts, Smoothness
from viscofric.friction.measurement.assumed_coulomb import COULOMB_ASSUMED
from viscofric.notes import Note, codes
from viscofric.rheology.uncertainty.material_samples import MaterialSamples

SPECTRUM = RUBBER.modes_at()
COMPLIANCES = np.log([1.0 / SPECTRUM.E_inf, *SPECTRUM.C])
LOG_SPEED = np.log(np.geomspace(1e-3, 10.0, 9))


@pytest.mark.parametrize("indenter", [BALL, vf.Cylinder(radius=10e-3), vf.Cone(angle=0.1)])
def test_derivatives_of_first_order_friction_are_those_of_its_differences(indenter: vf.Ball) -> None:
    first = FirstOrder(indenter, LOAD, 0.75, SPECTRUM.tau)
    found = first(COMPLIANCES, LOG_SPEED)
    step = 1e-4
    for place in range(len(COMPLIANCES)):
        up, down = (first(COMPLIANCES + sign * step * np.eye(len(COMPLIANCES))[place], LOG_SPEED) for sign in (1, -1))
        # Second differences of smooth functions over a step of 1e-4, and Newton's steps that end at 1e-6 squared.
        slope = (up.log_friction - down.log_friction) / (2.0 * step)
        np.testing.assert_allclose(found.change[:, place], slope, atol=1e-6)
        slope = (up.log_radius - down.log_radius) / (2.0 * step)
        np.testing.assert_allclose(found.radius_change[:, place], slope, atol=1e-6)
    up, down = (first(COMPLIANCES, LOG_SPEED + sign * step) for sign in (1, -1))
    # The kernels' slope is a spline of its own, true to 1e-5.
    np.testing.assert_allclose(found.slope, (up.log_friction - down.log_friction) / (2.0 * step), atol=1e-5)


@pytest.mark.parametrize(("indenter", "load"), [(BALL, 5.0), (vf.Cylinder(radius=10e-3), 500.0)])
def test_friction_to_first_order_is_right_for_little_loss(indenter: vf.Ball, load: float) -> None:
    """With a hundredth of the compliance relaxing, what is left out is of second order: a few hundredths of it."""
    rubber = vf.Material.standard_linear_solid(E0=3e6, E_inf=3.03e6, tau=1e-2)
    modes = rubber.modes_at()
    solved = vf.solve_steady(rubber, indenter, speed=0.1, load=load)
    first = FirstOrder(indenter, load, 0.75, modes.tau)(np.log([1 / modes.E_inf, *modes.C]), np.log([0.1]))
    assert np.exp(first.log_friction[0]) == pytest.approx(solved.friction_coefficient, rel=0.01)
    assert np.exp(first.log_radius[0]) == pytest.approx(0.5 * (solved.front + solved.rear), rel=0.02)


def test_first_order_friction_does_not_depend_on_units() -> None:
    """Moduli times 1e6, lengths times 1e-3, times over 1e9: forces are those times 1, speeds times 1e6."""
    there = FirstOrder(vf.Ball(radius=10e-6), LOAD * 1e6 * 1e-6, 0.75, SPECTRUM.tau * 1e-9)
    here = FirstOrder(BALL, LOAD, 0.75, SPECTRUM.tau)
    scaled = there(COMPLIANCES - np.log(1e6), LOG_SPEED + np.log(1e-3 * 1e9))
    np.testing.assert_allclose(scaled.log_friction, here(COMPLIANCES, LOG_SPEED).log_friction, atol=1e-9)


@pytest.mark.parametrize("part", ["magnitude", "storage", "loss"])
def test_derivatives_of_moduli_are_those_of_their_differences(part: str) -> None:
    omega, step = np.log([0.1, 3.0, 200.0]), 1e-5

    def modulus(compliances: np.ndarray, log_frequency: np.ndarray) -> np.ndarray:
        S, change, _ = compliance(compliances, SPECTRUM.tau, log_frequency)
        return log_modulus(part, S, change)[0]

    S, change, slope = compliance(COMPLIANCES, SPECTRUM.tau, omega)
    moved = log_modulus(part, S, np.column_stack([change, slope]))[1]
    E = RUBBER.complex_modulus(np.exp(omega))
    planted = {"storage": E.real, "loss": E.imag, "magnitude": np.abs(E)}[part]
    np.testing.assert_allclose(np.exp(modulus(COMPLIANCES, omega)), planted)
    size = len(COMPLIANCES)
    for place in range(size + 1):
        away = step * np.eye(size + 1)[place]
        up, down = (modulus(COMPLIANCES + sign * away[:size], omega + sign * away[size]) for sign in (1, -1))
        np.testing.assert_allclose(moved[:, place], (up - down) / (2.0 * step), atol=1e-8)


def test_scatter_of_few_replicates_is_drawn_to_the_common_one() -> None:
    random = np.random.default_rng(2)
    freedom = np.full(400, 7)
    same = random.chisquare(7, 400) / 7.0
    pooled = moderated_variances(same, freedom)
    # Of one true variance the sample variances scatter by √(2/7) = 0.53; little of that may be left.
    assert np.std(np.log(pooled)) < 0.1
    assert np.mean(pooled) == pytest.approx(1.0, abs=0.05)  # 2800 degrees of freedom: ± 2.7 %
    true = np.where(np.arange(400) < 200, 1.0, 25.0)
    apart = moderated_variances(true * same, freedom)
    assert np.mean(np.log(apart / true) ** 2) < np.mean(np.log(same) ** 2)
    assert np.median(apart[200:]) / np.median(apart[:200]) > 10.0


@pytest.mark.parametrize("said", ["replicates", "freedom", "nothing"])
def test_means_weighed_by_errors_of_four_replicates_err_as_they_say(said: str) -> None:
    """Weighed by its own error, a point whose four replicates happen to agree counts for too much.

    The number of replicates is given, or seen in how their errors scatter.
    """
    speed, kelvin = np.tile(np.geomspace(0.01, 0.5, 9), 4), np.repeat([300.0, 310.0, 322.0, 336.0], 9)
    random, held, noted = np.random.default_rng(7), [], []
    for _ in range(300):
        values = speed**-0.2 * (1.0 + 0.03 * random.standard_normal((4, 36)))
        scatter = values.std(axis=0, ddof=1)
        measured = curves_of(speed, kelvin, values.mean(axis=0), 0.5 * scatter, load=LOAD)
        if said == "replicates":
            measured = replace(measured, replicates=np.full(36, 4))
        if said == "freedom":
            measured = replace(measured, viscoelastic_freedom=np.full(36, 3.0))
        points = usable_points(measured, BALL, None, 1e-4)
        noted.append(codes(points.notes) == {"inferred-freedom"})
        weight = points.error**-2.0
        away = float(weight @ (points.log_scale + 0.2 * np.log(speed)) / weight.sum())
        held.append(abs(away) < 1.96 * weight.sum() ** -0.5)
    # 300 shares of 95 % scatter by 1.3 %; own errors as weights hold 77 %.
    assert np.mean(held) == pytest.approx(0.95, abs=0.035)
    assert np.mean(noted) == pytest.approx(1.0 if said == "nothing" else 0.0, abs=0.02)


def test_errors_of_a_force_cell_are_drawn_to_one_force() -> None:
    """Friction over a decade, far from zero, with one error at all points: that of four replicates scatters by 40 %."""
    random, speed = np.random.default_rng(4), np.geomspace(0.01, 0.5, 40)
    friction = 0.02 * (speed / 0.01) ** 0.6
    found = 2e-4 * np.sqrt(random.chisquare(3, 40) / 3.0)
    curves = replace(curves_of(speed, np.full(40, 300.0), friction, found, load=LOAD), replicates=np.full(40, 4))
    points = usable_points(curves, BALL, None, 1e-9)
    # One variance of 120 degrees of freedom is known to 13 %, its root to 6.5 %: three of these.
    np.testing.assert_allclose(points.error * np.exp(points.log_scale), 2e-4, rtol=0.2)


def test_errors_that_follow_the_friction_are_taken_as_they_are() -> None:
    """Stated errors without scatter of their own, here of 1 % at slow and 3 % at fast speeds, are known."""
    speed = np.tile(np.geomspace(0.01, 0.5, 9), 2)
    stated = 0.01 * (speed / 0.01) ** 0.28
    curves = curves_of(speed, np.repeat([300.0, 310.0], 9), speed**-0.2, stated * speed**-0.2, load=LOAD)
    points = usable_points(curves, BALL, None, 1e-6)
    np.testing.assert_allclose(points.error, stated, rtol=1e-6)
    assert points.notes == ()


def test_draws_follow_a_density_that_is_not_normal() -> None:
    """Residuals x and y − x²/2: x is normal, y = x²/2 + n has the mean 1/2 and the variance 3/2."""

    def residuals(place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        x, y = place
        return np.array([x, y - 0.5 * x**2]), np.array([[1.0, 0.0], [-x, 1.0]])

    minimum = descend(residuals, np.array([2.0, -1.0]))
    assert minimum.settled
    np.testing.assert_allclose(minimum.place, 0.0, atol=1e-3)
    drawn = draws(residuals, minimum, 1000, np.random.default_rng(3))
    # Four standard errors of 1000 draws; the map from errors to draws is one to one here, so that they are exact.
    assert np.mean(drawn[:, 0]) == pytest.approx(0.0, abs=0.13)
    assert np.var(drawn[:, 0]) == pytest.approx(1.0, abs=0.2)
    assert np.mean(drawn[:, 1]) == pytest.approx(0.5, abs=0.16)
    assert np.var(drawn[:, 1]) == pytest.approx(1.5, abs=0.4)


def test_a_known_modulus_is_the_same_from_a_material_and_from_its_samples() -> None:
    """A material's errors are those stated; samples bring their own, with their correlation."""
    levels = 1.0 + 0.05 * np.random.default_rng(4).normal(size=80)
    materials = tuple(vf.Material(SPECTRUM.shifted(1.0, float(level)), RUBBER.shift) for level in levels)
    C = np.array([one.modes_at().C for one in materials])
    samples = MaterialSamples(materials, C, np.tile(SPECTRUM.tau, (80, 1)), (0.1, 10.0))
    found = known_part(samples, None, 0.02, 300.0)
    storage, loss = np.split(found.log_modulus, 2)
    assert found.temperature == RUBBER.reference
    assert len(found.log_frequency) == 9  # four per decade
    E = RUBBER.complex_modulus(np.exp(found.log_frequency))
    # The mean of 80 levels that scatter by 5 %: 0.6 %.
    np.testing.assert_allclose(storage, np.log(E.real), atol=0.025)
    np.testing.assert_allclose(loss, np.log(E.imag), atol=0.025)
    # All moduli move together: a change of level is one standard deviation, of shape many.
    assert np.linalg.norm(found.whitening @ np.full(18, 0.05)) == pytest.approx(1.0, rel=0.25)
    assert np.linalg.norm(found.whitening @ np.tile([0.05, -0.05], 9)) > 10.0
    alone = known_part(RUBBER, (0.1, 10.0), 0.02, 300.0).whitening
    np.testing.assert_allclose(alone, np.eye(18) / 0.02)
    # In a gap of the measurement they are known from no measurement.
    gaps = ((0.5, 5.0),)
    fitted = replace(SPECTRUM, fit=vf.rheology.SpectrumFit(0.01, 0.01, False, False, (0.1, 10.0), gaps=gaps))
    for prior in (replace(samples, gaps=gaps), vf.Material(fitted, RUBBER.shift)):
        found = known_part(prior, None, 0.02, 300.0)
        known = np.exp(found.log_frequency)
        assert (len(known), found.whitening.shape) == (5, (10, 10))
        assert not np.any((known > 0.5) & (known < 5.0))


def test_evidence_of_a_linear_problem_is_its_marginal_likelihood() -> None:
    """Y = x + n, x ~ N(0, s²): the marginal of y is N(0, 1 + s²)."""
    y = 1.7

    def evidence(s: float) -> float:
        minimum = descend(lambda x: (np.array([x[0] - y, x[0] / s]), np.array([[1.0], [1.0 / s]])), np.zeros(1))
        return log_evidence(minimum, -np.log(s))

    marginal = [-0.5 * y**2 / (1.0 + s**2) - 0.5 * np.log(1.0 + s**2) for s in (0.5, 3.0)]
    assert evidence(0.5) - evidence(3.0) == pytest.approx(marginal[0] - marginal[1], abs=1e-6)


def test_a_straight_spectrum_costs_the_prior_nothing_but_its_level_and_slope() -> None:
    tau = np.geomspace(1e-3, 1e3, 20)
    smooth = Smoothness(tau, 1e-6, (1e-2, 1e2), 0.1)
    power_law = smooth.middle + np.concatenate([[0.0], 0.4 * np.log(tau)])
    rows = smooth.matrix @ (power_law - smooth.middle)
    np.testing.assert_allclose(rows[3:], 0.0, atol=1e-9)
    assert rows @ rows == pytest.approx((0.4 / 0.7) ** 2, rel=1e-9)
    wave = power_law + np.concatenate([[0.0], np.sin(np.log(tau))])
    smoother = replace(smooth, roughness=0.01)
    costs = [float(np.linalg.norm(one.matrix @ (wave - one.middle))) for one in (smooth, smoother)]
    assert costs[0] < costs[1]


def test_points_of_a_ball_at_two_loads_are_those_of_one() -> None:
    """μ(v, F) = f^{1/3} μ(v f^{−1/3}, F0): both loads give the same point."""
    loads = np.repeat([2.0, 16.0], 3)
    speed = np.array([0.01, 0.02, 0.03])
    speeds = np.concatenate([speed, 2.0 * speed])
    both = curves_of(speeds, np.full(6, 300.0), speeds, 1e-4, load=loads)  # friction as large as the speed in m/s
    points = usable_points(both, BALL, None, 1e-4)
    np.testing.assert_allclose(points.log_speed[:3], points.log_speed[3:])
    np.testing.assert_allclose(points.log_scale[:3], points.log_scale[3:])
    assert points.load == pytest.approx(np.sqrt(2.0 * 16.0))
    profile = vf.Profile(np.linspace(-1e-3, 1e-3, 101) ** 2, spacing=2e-5)
    with refused("several-loads"):
        usable_points(replace(both, load_unit="N/m"), profile, None, 1e-4)


def test_points_that_cannot_be_used_are_reported() -> None:
    speed = np.geomspace(0.02, 0.2, 8)
    curves = curves_of(speed, np.full(8, 300.0), np.full(8, 0.01), 1e-4)
    exact = replace(curves, viscoelastic=0.01 * (speed != speed[2]), viscoelastic_error=np.zeros(8))
    with refused("friction-not-positive"):
        usable_points(exact, BALL, None, 1e-4)
    with refused("too-few-points"):
        usable_points(curves.select(np.arange(3)), BALL, None, 1e-4)
    with refused("load-unit"):
        usable_points(curves, vf.Cylinder(radius=0.01), None, 1e-4)
    unknown = replace(curves, viscoelastic_error=np.where(speed == speed[2], np.inf, 1e-4))
    points = usable_points(unknown, BALL, None, 1e-4)
    assert len(points) == 7
    assert points.notes[0].code == "points-without-error"
    assert points.notes[0].values == {"points": 1, "of": 8}


def test_friction_that_is_not_clear_of_zero_counts_as_it_is() -> None:
    """A point below zero, within its error, is data: μ itself is fitted there, whose error is normal, not ln μ."""
    speed, error = np.geomspace(0.02, 0.2, 8), 1e-3
    friction = np.where(speed == speed[2], -5e-4, 0.011)
    points = usable_points(curves_of(speed, np.full(8, 300.0), friction, error), BALL, None, 1e-6)
    missed, slope, _ = points.missed(np.log(np.full(8, 4e-3)), np.zeros(0))
    expected = np.where(friction < 0.0, 4e-3 - friction, 0.011 * np.log(4e-3 / 0.011))
    np.testing.assert_allclose(missed / points.error, expected / error, rtol=1e-4)
    np.testing.assert_allclose(slope / points.error, np.where(friction < 0.0, 4e-3, 0.011) / error, rtol=1e-4)
    np.testing.assert_allclose(
        points.at_one_load(curves_of(speed, np.full(8, 300.0), friction, error)).viscoelastic, friction
    )


def test_points_keep_their_weights_beside_one_near_zero() -> None:
    """Friction over three decades, known to 2 %: what is solved to 1 % adds this to each point, not to the largest."""
    speed, friction = np.geomspace(0.02, 0.2, 12), np.geomspace(1e-4, 0.1, 12)
    alone = usable_points(curves_of(speed, np.full(12, 300.0), friction, 0.02 * friction), BALL, None, 0.01)
    beside = np.append(friction, 1e-5)
    near = curves_of(np.append(speed, 0.01), np.full(13, 300.0), beside, np.append(0.02 * friction, 1e-5))
    points = usable_points(near, BALL, None, 0.01)
    np.testing.assert_allclose(points.error[:-1], alone.error, rtol=1e-9)
    assert points.error[-1] == pytest.approx(1.0, rel=1e-3)
    np.testing.assert_allclose(points.missed(points.log_scale + 0.3, np.zeros(0))[0][:-1], 0.3)


def test_errors_that_nobody_gave_are_those_of_the_scatter() -> None:
    """Power laws with 2 % of noise at nine temperatures of ten points: 63 degrees of freedom tell it to 9 %."""
    speed, kelvin = np.tile(np.geomspace(0.02, 0.2, 10), 9), np.repeat(np.linspace(300.0, 360.0, 9), 10)
    friction = 0.01 * speed**-0.2 * np.exp(0.02 * np.random.default_rng(5).standard_normal(90))
    bare = curves_of(speed, kelvin, friction, np.inf)
    points = usable_points(bare, BALL, None, 1e-4)
    assert len(points) == 90
    assert points.error[0] == pytest.approx(0.02, rel=0.3)  # three and a half times those 9 %
    np.testing.assert_allclose(points.error, points.error[0])
    assert points.notes[0].code == "errors-from-scatter"
    assert points.notes[0].values == {"relative_error": pytest.approx(points.error[0], rel=1e-3)}
    with refused("no-errors"):
        usable_points(bare.select(np.arange(0, 90, 5)), BALL, None, 1e-4)


def assuming(curves: vf.FrictionCurves, error: float, *senses: list[float]) -> vf.FrictionCurves:
    """Curves whose Coulomb friction of 0.05 was assumed, with its error, in parts with the disc faster or slower."""
    values = {"coulomb": 0.05, "error": error}
    notes = [Note(COULOMB_ASSUMED, f"Assumed, {some}.", values=values | {"senses": some}) for some in senses]
    columns = {"coulomb": 0.05, "coulomb_error": error, "coulomb_scatter": 0.0}
    return replace(curves, notes=tuple(notes), **{name: np.full(len(curves), one) for name, one in columns.items()})


def test_an_assumed_error_is_shared_and_leaves_the_scatter_of_the_replicates() -> None:
    """Three degrees of freedom of half of the variance are 3/(1/2)² of all of it by Welch's formula."""
    speed, own, error = np.geomspace(0.02, 0.2, 8), np.linspace(0.8e-4, 1.2e-4, 8), 1e-4
    alone = replace(curves_of(speed, np.full(8, 300.0), np.full(8, 0.01), own), viscoelastic_freedom=np.full(8, 3.0))
    together = replace(
        alone,
        viscoelastic_error=np.hypot(own, error),
        viscoelastic_freedom=3.0 * (1.0 + (error / own) ** 2) ** 2,
    )
    expected = usable_points(alone, BALL, None, 1e-6)
    points = usable_points(assuming(together, error, [1.0]), BALL, None, 1e-6)
    np.testing.assert_allclose(points.error, expected.error, rtol=1e-9)
    np.testing.assert_allclose(points.shared, np.full((8, 1), error / 0.01), rtol=1e-9)
    # Points that it did not reach have smaller errors than it.
    np.testing.assert_array_equal(usable_points(assuming(alone, 5e-4, [1.0]), BALL, None, 1e-6).shared, 0.0)


def test_an_assumed_error_is_not_in_errors_that_the_scatter_gives() -> None:
    speed, kelvin = np.tile(np.geomspace(0.02, 0.2, 10), 9), np.repeat(np.linspace(300.0, 360.0, 9), 10)
    friction = 0.01 * speed**-0.2 * np.exp(0.02 * np.random.default_rng(5).standard_normal(90))
    bare = curves_of(speed, kelvin, friction, np.inf)
    points = usable_points(assuming(bare, 1e-3, [1.0]), BALL, None, 1e-6)
    np.testing.assert_allclose(points.error, usable_points(bare, BALL, None, 1e-6).error)
    np.testing.assert_allclose(points.shared[:, 0], 1e-3 / friction)


def test_the_level_of_subtracted_friction_is_an_amount_and_other_errors_in_common_are_factors() -> None:
    """Friction over three decades, Coulomb friction of 0.2 its level wrong by up to 75 times μ."""
    speed, friction, coulomb, level = np.geomspace(0.02, 0.2, 8), np.geomspace(1e-4, 0.1, 8), np.full(8, 0.2), 0.025
    away = np.array([0.03, -1.5])  # of a common error, and of the level of Coulomb friction
    measured = friction * np.exp(0.02 * away[0]) + level * away[1] * coulomb
    curves = replace(
        curves_of(speed, np.full(8, 300.0), measured, 1e-3),
        coulomb=coulomb,
        coulomb_error=np.zeros(8),
        coulomb_scatter=np.zeros(8),
    )
    points = SharedErrors(common=0.02, coulomb_level=level).given_to(
        usable_points(curves, BALL, None, 1e-6), curves, None
    )
    assert 0 < np.count_nonzero(points.logarithmic) < 8
    np.testing.assert_allclose(points.missed(np.log(friction), away)[0], 0.0, atol=1e-12)
    for common in (away, np.array([0.03, -40.0])):  # the latter leave less than nothing, as a fit may try
        missed, by_friction, by_errors = points.missed(np.log(friction), common)
        rounding = 1e-9 * np.abs(missed) + 1e-8  # over the step; its square is less
        for place, step in enumerate(1e-6 * np.eye(2)):
            both = [points.missed(np.log(friction), common + sign * step)[0] for sign in (1.0, -1.0)]
            np.testing.assert_array_less(np.abs((both[0] - both[1]) / 2e-6 - by_errors[:, place]), rounding)
        both = [points.missed(np.log(friction) + step, common)[0] for step in (1e-6, -1e-6)]
        np.testing.assert_array_less(np.abs((both[0] - both[1]) / 2e-6 - by_friction), rounding)


@pytest.mark.parametrize("senses", [([-1.0, 1.0],), ([1.0], [-1.0]), ()])
def test_an_assumed_error_of_either_sign_is_not_shared(senses: tuple[list[float], ...]) -> None:
    curves = curves_of(np.geomspace(0.02, 0.2, 8), np.full(8, 300.0), np.full(8, 0.01), 2e-4)
    points = usable_points(assuming(curves, 1e-4, *senses), BALL, None, 1e-6)
    assert points.shared.shape == (8, 0)
    np.testing.assert_allclose(points.error, 0.02, rtol=1e-3)


def test_an_error_of_temperature_is_one_of_friction_by_its_slope() -> None:
    """By −0.4 (0.3 + 0.2 x), for 2 K and d ln α/dT = −0.2, where ln μ = 0.3 x + 0.1 x² of x = ln v."""
    speed = np.tile(np.geomspace(0.02, 0.5, 7), 2)
    x = np.log(speed)
    curves = curves_of(speed, np.repeat([300.0, 310.0], 7), np.exp(0.3 * x + 0.1 * x**2), 1e-3, load=LOAD)
    usable, errors = usable_points(curves, BALL, None, 1e-6), SharedErrors(temperature=2.0)
    points = errors.given_to(usable, curves, np.array([-0.2, -0.2]))
    moved = -0.4 * (0.3 + 0.2 * x)
    cold = np.repeat([True, False], 7)
    np.testing.assert_allclose(points.shared.T, [np.where(cold, moved, 0.0), np.where(cold, 0.0, moved)], atol=1e-9)
    with refused("no-shift-factors", naming=("temperature_error", "shift factors")):
        errors.given_to(usable, curves, Shifts.unknown(np.array([300.0]), 300.0).per_kelvin)


def test_slopes_of_shift_factors_are_those_of_their_law_at_each_temperature() -> None:
    """Those of WLF are −ln 10 C1 C2/(C2 + T − T0)²; also of one temperature, and at the ends of a table."""
    law, kelvin = vf.WLF(C1=9.0, C2=100.0, reference=320.0), np.array([290.0, 340.0])
    exact = -np.log(10.0) * 900.0 / (kelvin - 220.0) ** 2
    np.testing.assert_allclose(Shifts.known(kelvin, law).per_kelvin, exact, rtol=1e-5)  # (0.1 K/70 K)²
    np.testing.assert_allclose(Shifts.known(kelvin[:1], law).per_kelvin, exact[:1], rtol=1e-5)
    fine = np.linspace(290.0, 340.0, 51)
    table = vf.ShiftFactors(fine, law.log10(fine), 320.0)
    np.testing.assert_allclose(Shifts.unknown(kelvin, 320.0, table).per_kelvin, exact, rtol=2e-2)  # 1 K/70 K


def test_found_shifts_are_expected_where_the_curves_overlap() -> None:
    """Twelve of the standard errors about what overlap tells, and no less than 0.05 in ln α; the reference is exact."""
    kelvin = np.array([300.0, 310.0, 320.0])
    overlap = vf.ShiftFactors(kelvin, [0.0, -1.0, -1.8], 300.0, np.diag([0.0, 0.04, 0.01]) ** 2)
    shifts = Shifts.unknown(kelvin, 300.0, overlap)
    np.testing.assert_allclose(shifts.middle, np.log(10.0) * np.array([0.0, -1.0, -1.8]), atol=1e-12)
    covariance = np.linalg.inv(shifts.whitening.T @ shifts.whitening)
    expected = [1e-7, *np.hypot(12.0 * np.log(10.0) * np.array([0.04, 0.01]), 0.05)]
    np.testing.assert_allclose(np.sqrt(np.diag(covariance)), expected, rtol=1e-6)
