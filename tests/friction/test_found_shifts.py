"""Shift factors come out of friction curves alone, with the errors that they have, or are refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from friction.synthetic_curves import curves_of, noisy, planted_law, synthetic_curves
from refusals import refused
from viscofric.arrays import Array
from viscofric.contact.indenters.shapes import Ball
from viscofric.errors import SuperpositionError
from viscofric.files import SYNTHETIC
from viscofric.friction.curve_checks import Decades
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.prediction import predict_friction
from viscofric.friction.shifting.found_shifts import CURVE_LEFT_OUT, widened, widening
from viscofric.friction.shifting.isotherms import friction_isotherms
from viscofric.friction.shifting.placement import scan_pairs
from viscofric.friction.shifting.shift import shift_friction
from viscofric.friction.shifting.shift_agreement import compare_shift_factors
from viscofric.notes import Note, Remedy, codes
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.shifts.laws import WLF, ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.superposition.common_curve import Basis

LAW = WLF(C1=8.86, C2=101.6, reference="50 degC")
SPEEDS = np.geomspace(0.02, 0.2, 10)
# 5 % in eight replicates.
NOISE = 0.05


def power(reduced: Array) -> Array:
    return np.asarray(0.02 * (reduced / 0.1) ** -0.25)


def peak(reduced: Array) -> Array:
    """Rise and fall like the loss of one retardation time."""
    return np.asarray(0.06 / (reduced / 0.1 + 0.1 / reduced))


def double_peak(reduced: Array) -> Array:
    """Two maxima of equal height, two decades apart."""
    return peak(reduced) + peak(reduced / 100.0)


def constant(reduced: Array) -> Array:
    return np.full(reduced.shape, 0.02)


def made(
    friction: Callable[[Array], Array],
    *celsius: float,
    speeds: Array = SPEEDS,
    noise: float = 0.0,
    seed: int = 1,
) -> FrictionCurves:
    temperature = np.repeat(np.array(celsius) + 273.15, len(speeds))
    speed = np.tile(speeds, len(celsius))
    exact = friction(np.asarray(LAW(temperature)) * speed)
    if noise == 0.0:
        return curves_of(speed, temperature, exact, 0.0)
    return noisy(speed, temperature, exact, noise, np.random.default_rng(seed))


def deviation(factors: ShiftFactors, law: ShiftLaw = LAW) -> Array:
    return np.asarray(factors.log10_values - law.at_reference(factors.reference).log10(factors.temperatures))


def test_the_synthetic_friction_is_what_the_solver_gives() -> None:
    """The file of the tests, solved to 1e-4, against a contact solved anew to 1e-3."""
    curves = synthetic_curves(46.0)
    again = predict_friction(
        synthetic_fluoroelastomer(),
        Ball(radius="9.525 mm"),
        speeds=float(curves.speed[4]),
        temperatures="46 degC",
        load="25 N",
        accuracy=1e-3,
    )
    assert again.viscoelastic[0] == pytest.approx(curves.viscoelastic[4], rel=1e-3)


def test_planted_shift_factors_are_found_without_noise() -> None:
    """To 0.001 decades where 0.01 is asked: the spline between knots is the only error."""
    master = shift_friction(synthetic_curves())
    factors = master.shift_factors
    assert master.found
    assert master.notes == ()
    assert len(factors.temperatures) == 9
    np.testing.assert_allclose(deviation(factors, planted_law()), 0.0, atol=1e-3)
    assert master.overlap.rms == pytest.approx(0.0, abs=1e-3)
    law, planted = factors.law("wlf"), planted_law().at_reference(factors.reference)
    assert law.log10("70 degC") == pytest.approx(planted.log10("70 degC"), abs=2e-3)
    # Read half way between temperatures: what is found serves like what is given.
    given_law = shift_friction(synthetic_curves(), shift=planted_law())
    assert master("0.1 m/s", "56 degC") == pytest.approx(given_law("0.1 m/s", "56 degC"), rel=3e-3)


@pytest.mark.apart
def test_95_per_cent_intervals_hold_95_per_cent() -> None:
    """1000 seeds hold 94.9 % of each α and 94.5 % of all together, and none raises a false alarm."""
    law = planted_law()
    inside, slopes, together = [], [], []
    for seed in range(100):
        master = shift_friction(synthetic_curves(noise=NOISE, seed=seed))
        assert CURVE_LEFT_OUT not in codes(master.notes)
        factors = master.shift_factors
        away = factors.temperatures != factors.reference
        inside.append(np.abs(deviation(factors, law))[away] < 1.96 * factors.standard_errors[away])
        agreement = compare_shift_factors(master, law)
        slopes.append(abs(agreement.slope - 1.0) < 1.96 * agreement.slope_error)
        together.append(agreement.p_value > 0.05)
    # The standard deviation of 100 independent values is 2.2 %, that of 800 correlated ones less.
    assert np.mean(inside) >= 0.90
    assert np.mean(slopes) >= 0.89
    assert np.mean(together) >= 0.89


def test_curves_without_an_end_are_read_with_the_basis_of_the_whole_curve(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of five comparisons of a pair had its own, which took most of the time."""
    read = []
    whole = Basis.at  # without derivatives it reads curves; with these it draws them
    monkeypatch.setattr(Basis, "at", lambda *given, **orders: (read.extend(orders), whole(*given, **orders))[1])
    shift_friction(made(power, 20.0, 25.0, 30.0, noise=0.01))
    assert len(read) == 2 * 3  # of three pairs


def test_curves_of_one_temperature_share_their_knots_and_roughness(monkeypatch: pytest.MonkeyPatch) -> None:
    """They depend on the speeds only, and each round, with other weights, and each curve without an end had its own."""
    made_of = []
    whole = Basis.of
    monkeypatch.setattr(Basis, "of", lambda *given: (made_of.append(len(given[0])), whole(*given))[1])
    isotherms = friction_isotherms(made(power, 20.0, 25.0, 30.0, noise=0.01))
    scan_pairs(isotherms, 1.0)
    assert made_of == [len(one) for one in isotherms]


@pytest.mark.parametrize("true", [3.0, 4.0, 8.0])
def test_what_is_found_because_chance_moved_it_has_the_error_that_takes(true: float) -> None:
    """Distances of δ ± 1 are found above 3: about δ they scatter by less than the widened variances say, not by 1."""
    drawn = true + np.random.default_rng(1).standard_normal(4000)
    found = drawn[drawn > 3.0][:400]
    wide = np.array([widening(float(one)) for one in found])
    off = (found - true) ** 2 / wide
    # 95.4 % of normal numbers lie within 2; five standard deviations of the share of 400, 1 %.
    assert np.mean(off <= 4.0) > 0.90
    if true == 8.0:
        assert np.median(wide) < 1.02
    else:
        assert wide.max() > 2.0


def test_widened_steps_keep_the_reference_and_the_other_steps() -> None:
    independent = np.diag([0.01, 0.04])  # squared errors of two steps
    to_values = np.array([[1.0, 0.0], [0.0, 0.0], [0.0, -1.0]])  # from the middle one
    covariance = to_values @ independent @ to_values.T
    wider = widened(covariance, np.array([1.0, 4.0]), np.array([0.0, 1.0, 0.0]))
    np.testing.assert_allclose(wider, to_values @ np.diag([0.01, 0.16]) @ to_values.T, atol=1e-15)


@pytest.mark.slow
def test_shifts_of_marginal_overlap_are_reported_and_their_errors_hold() -> None:
    """Of two temperatures that are found once in four times: when chance moved them together."""
    off, reported = [], 0
    for seed in range(100):
        curves = made(power, 50.0, 60.0, speeds=np.geomspace(0.02, 0.2, 8), noise=0.05, seed=seed)
        try:
            master = shift_friction(curves, reference="50 degC")
        except SuperpositionError:
            continue
        off.append(deviation(master.shift_factors)[1] / master.shift_factors.standard_errors[1])
        reported += "marginal-overlap" in codes(master.notes)
    assert 15 <= len(off) <= 45
    assert reported >= 0.8 * len(off)
    assert np.mean(np.abs(off) <= 1.96) >= 0.9
    # Without what having been found says of them they are off by 0.85 standard errors on average.
    assert abs(np.mean(off)) < 0.7


@pytest.mark.parametrize("noise", [0.0, 1e-3])
def test_exact_friction_keeps_its_points_about_a_maximum(noise: float) -> None:
    """The curve of few points is off by more than they scatter: four of nine temperatures were left out."""
    celsius = range(26, 75, 6)
    curves = made(peak, *celsius, speeds=np.geomspace(0.02, 0.8, 9), noise=noise)
    factors = shift_friction(curves).shift_factors
    assert len(factors.temperatures) == len(celsius)
    away = factors.standard_errors > 0.0
    # Three standard errors; without noise the curve itself is off, by a thousandth of a decade.
    assert np.all(np.abs(deviation(factors))[away] < 3.0 * factors.standard_errors[away])
    assert np.all(np.abs(deviation(factors)) < 2e-3)


@pytest.mark.slow
def test_a_fifth_of_points_far_off_hardly_changes_shift_factors() -> None:
    """By 30 to 60 %, where scatter is 1.8 %: no shift factors were found in most of such tests."""
    away, errors = [], []
    for seed in range(5):
        curves, random = synthetic_curves(noise=0.05, seed=seed), np.random.default_rng(seed)
        off = np.ones(len(curves))
        off[random.choice(len(curves), 18, replace=False)] += random.choice([-1.0, 1.0], 18) * random.uniform(
            0.3, 0.6, 18
        )
        factors = shift_friction(replace(curves, viscoelastic=off * curves.viscoelastic)).shift_factors
        right = planted_law().at_reference(factors.reference).log10(factors.temperatures)
        others = factors.standard_errors > 0.0
        away += [*(factors.log10_values - right)[others]]
        errors += [*factors.standard_errors[others]]
    assert len(away) >= 32  # of 40 temperatures besides the references; half of the points of some are off
    # 0.027 decades without outliers, of which 72 of 90 points are left, unevenly.
    assert np.sqrt(np.mean(np.square(away))) < 0.04
    # 95 %, less three standard deviations of 32 factors that a test's common errors make half as many.
    assert np.mean(np.abs(away) < 1.96 * np.array(errors)) > 0.79


def test_errors_that_a_temperature_shares_are_counted_if_reported() -> None:
    """Levels off by 1 % move α by many times what the scatter of the points does; told of, intervals hold again."""
    law = planted_law()
    inside: dict[float, list[bool]] = {0.0: [], 0.01: []}
    for seed in range(20):
        plain = synthetic_curves(30.0, 35.0, 40.0, noise=0.01, seed=seed)
        level = np.repeat(1.0 + 0.01 * np.random.default_rng(seed).standard_normal(3), 10)
        curves = replace(plain, viscoelastic=level * plain.viscoelastic)
        for reported, found in inside.items():
            factors = shift_friction(curves, level_error=reported, reference="30 degC").shift_factors
            found += list(np.abs(deviation(factors, law))[1:] < 1.96 * factors.standard_errors[1:])
    # 40 values, some of them correlated: 95 % to within three of their standard deviations, 4 %.
    assert np.mean(inside[0.01]) > 0.83
    assert np.mean(inside[0.0]) < 0.6
    with refused("level-error"):
        shift_friction(curves, level_error=-0.1)


@pytest.mark.parametrize("noise", [0.0, NOISE])
def test_the_papers_three_temperatures_do_not_overlap(noise: float) -> None:
    """30, 60 and 90 °C over one decade leave gaps: no number, whatever the noise."""
    for seed in range(10):
        with refused("no-overlap", SuperpositionError):
            shift_friction(synthetic_curves(30.0, 60.0, 90.0, noise=noise, seed=seed))


def test_a_temperature_that_reaches_no_other_is_left_out_and_reported() -> None:
    for seed in range(5):
        master = shift_friction(synthetic_curves(30.0, 35.0, 40.0, 90.0, noise=NOISE, seed=seed))
        np.testing.assert_allclose(master.shift_factors.temperatures, [303.15, 308.15, 313.15])
        (note,) = master.notes
        assert note.code == CURVE_LEFT_OUT
        assert note.values == {"temperature": 363.15}
        assert set(master.temperature) == {303.15, 308.15, 313.15}
        assert len(master.curves) == 30


def test_of_two_groups_that_of_the_reference_counts() -> None:
    curves = synthetic_curves(30.0, 35.0, 78.0, 90.0)
    cold, hot = (shift_friction(curves, reference=reference) for reference in ("32 degC", "90 degC"))
    np.testing.assert_allclose(cold.shift_factors.temperatures, [303.15, 308.15])
    np.testing.assert_allclose(hot.shift_factors.temperatures, [351.15, 363.15])
    assert cold.reference == pytest.approx(305.15)
    with refused("reference-not-covered", SuperpositionError):
        shift_friction(curves, reference="60 degC")
    with refused("reference-outside"):
        shift_friction(curves, reference="20 degC")


@pytest.mark.parametrize("noise", [0.0, NOISE])
def test_friction_that_does_not_depend_on_speed_shows_no_shift(noise: float) -> None:
    """One false alarm in 20 would be too many; 60 seeds of each of two gave none."""
    for seed in range(20 if noise else 1):
        with pytest.raises(SuperpositionError) as caught:
            shift_friction(made(constant, 30.0, 40.0, 50.0, noise=noise, seed=seed))
        assert caught.value.code in ("curves-too-flat", "no-overlap")
    with refused("curves-too-flat", SuperpositionError):
        shift_friction(made(constant, 30.0, 40.0, noise=noise))


@pytest.mark.slow
def test_what_chance_makes_of_constant_friction_is_refused() -> None:
    """Of many pairs of curves without slope some seem to overlap: what they join must not be one constant."""
    for seed in range(20):
        curves = made(
            constant, *np.arange(30.0, 111.0, 10.0), speeds=np.geomspace(0.02, 0.2, 8), noise=NOISE, seed=seed
        )
        with refused("curves-too-flat", SuperpositionError):
            shift_friction(curves)


@pytest.mark.parametrize("friction", [power, peak, double_peak])
@pytest.mark.slow
def test_curves_with_and_without_maxima_are_joined(friction: Callable[[Array], Array]) -> None:
    """Where one flank could pass for another, the curves of all temperatures together decide."""
    celsius = (32.0, 38.0, 44.0, 50.0, 56.0, 62.0, 68.0)
    exact = shift_friction(made(friction, *celsius)).shift_factors
    np.testing.assert_allclose(deviation(exact), 0.0, atol=0.01)
    found = [shift_friction(made(friction, *celsius, noise=NOISE, seed=seed)).shift_factors for seed in range(5)]
    for factors in found:
        assert len(factors.temperatures) == 7
        away = factors.standard_errors > 0.0
        # 30 values within 4 standard errors: one in 500 such tests would fail by chance.
        assert np.all(np.abs(deviation(factors))[away] < 4.0 * factors.standard_errors[away])


def test_curves_that_fit_in_two_places_are_not_placed() -> None:
    """Friction that repeats itself in every decade, over two decades of speed, coincides one decade further on too."""

    def repeating(reduced: Array) -> Array:
        return np.asarray(0.02 * (1.0 + 0.3 * np.sin(2.0 * np.pi * np.log10(reduced))))

    curves = made(repeating, 48.0, 50.0, speeds=np.geomspace(0.002, 0.2, 25))
    with refused("curves-fit-twice", SuperpositionError):
        shift_friction(curves)


@pytest.mark.parametrize("level", [0.05, 0.1])
@pytest.mark.slow
def test_flanks_of_two_maxima_are_not_taken_for_one(level: float) -> None:
    """In noise those of temperatures far apart look alike, but what was measured in between says that they are not."""

    def unequal(reduced: Array) -> Array:
        place = np.log10(reduced / 0.01)
        return np.asarray(
            0.01 + 0.03 * np.exp(-(((place + 1.5) / 0.6) ** 2)) + 0.02 * np.exp(-(((place - 1) / 0.6) ** 2))
        )

    celsius = (30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0)
    for seed in range(6):
        curves = made(unequal, *celsius, speeds=np.geomspace(0.02, 0.4, 8), noise=np.sqrt(8.0) * level, seed=seed)
        try:
            factors = shift_friction(curves).shift_factors
        except SuperpositionError:
            continue
        # Flanks mistaken for each other are wrong by one to three decades, everything else by a tenth or two.
        assert np.abs(deviation(factors)).max() < 0.6


def test_opposite_flanks_of_a_maximum_do_not_overlap() -> None:
    """38 and 62 °C lie on either side, with friction in the same range, and have no point of the curve in common."""
    curves = made(peak, 38.0, 62.0)
    with refused("no-overlap", SuperpositionError):
        shift_friction(curves)


@pytest.mark.parametrize(
    ("curves", "code"),
    [
        (made(power, 50.0), "one-temperature"),
        (made(power, 44.0, 50.0, speeds=np.array([0.1])), "one-speed"),
        (made(power, 50.0, 64.0), "no-overlap"),  # by less than one point
        (made(power, 44.0, 56.0, speeds=np.array([0.02, 0.2])), "no-overlap"),  # by none
    ],
)
def test_too_little_is_refused(curves: FrictionCurves, code: str) -> None:
    with refused(code, SuperpositionError):
        shift_friction(curves)


def test_an_alpha_that_rises_with_temperature_is_refused() -> None:
    """Temperatures that were mixed up make curves that coincide, the wrong way."""
    right = made(power, 44.0, 50.0)
    mixed_up = curves_of(right.speed, right.temperature[::-1], right.viscoelastic, 0.0)
    with refused("shift-factors-rise", SuperpositionError):
        shift_friction(mixed_up)


def test_all_temperatures_are_reported() -> None:
    with refused("curves-too-flat", SuperpositionError) as caught:
        shift_friction(made(constant, *np.arange(30.0, 49.0, 2.0)))
    np.testing.assert_allclose(caught.value.note.values["temperatures"], 273.15 + np.arange(30.0, 49.0, 2.0))


@pytest.mark.parametrize("source", ["friction.csv (synthetic)", "friction.csv"])
def test_shift_factors_of_synthetic_friction_say_so(source: str) -> None:
    found = shift_friction(replace(made(power, 44.0, 50.0), source=source)).shift_factors
    assert (SYNTHETIC in codes(found.notes)) == ("synthetic" in source)


@pytest.mark.parametrize("remedy", [Remedy(" Leave it out."), None])
def test_a_refusal_of_flat_curves_names_readings_that_were_kept_although_far_off(remedy: Remedy | None) -> None:
    far = Note("outliers", "One reading is far off.", remedy=remedy)
    with refused("curves-too-flat", SuperpositionError) as caught:
        shift_friction(replace(made(constant, 30.0, 34.0), notes=(far,)))
    assert str(caught.value).endswith(" One reading is far off. Leave it out.") == (remedy is not None)


def test_an_overlap_of_one_point_is_none() -> None:
    """At α = 10^-1 the last speed of the colder is the first of the warmer: nothing tests how steep they are there."""
    speed, temperature = np.tile(SPEEDS, 2), np.repeat([320.0, 335.0], 10)
    friction = power(speed * np.where(temperature > 330.0, 0.1, 1.0))
    with refused("no-overlap", SuperpositionError):
        shift_friction(curves_of(speed, temperature, friction, 0.0))


def test_two_temperatures_are_enough() -> None:
    exact = shift_friction(made(power, 44.0, 50.0), reference="44 degC").shift_factors
    np.testing.assert_allclose(deviation(exact), 0.0, atol=1e-3)
    few = shift_friction(made(power, 48.0, 50.0, speeds=np.array([0.02, 0.06, 0.2]))).shift_factors
    np.testing.assert_allclose(deviation(few), 0.0, atol=0.01)


def test_points_of_one_temperature_to_half_a_kelvin_are_one_curve() -> None:
    curves = made(power, 44.0, 50.0, 56.0)
    wobble = 0.2 * np.random.default_rng(1).uniform(-1.0, 1.0, len(curves))
    master = shift_friction(curves_of(curves.speed, curves.temperature + wobble, curves.viscoelastic, 0.0))
    assert len(master.shift_factors.temperatures) == 3
    np.testing.assert_allclose(master.shift_factors.temperatures, [317.15, 323.15, 329.15], atol=0.2)


def test_equal_speeds_count_once_each_by_their_errors() -> None:
    """Curves with every point twice, of half the variance each, give the same factors."""
    once = made(power, 44.0, 50.0, 56.0, noise=NOISE)
    twice = curves_of(
        np.tile(once.speed, 2),
        np.tile(once.temperature, 2),
        np.tile(once.viscoelastic, 2),
        np.tile(once.viscoelastic_error, 2),
        replicates=8,
    )
    one, other = shift_friction(once).shift_factors, shift_friction(twice).shift_factors
    np.testing.assert_allclose(one.log10_values, other.log10_values, atol=1e-6)
    np.testing.assert_allclose(one.standard_errors, other.standard_errors, rtol=1e-3)


def test_unknown_errors_and_friction_near_zero_are_fitted_too() -> None:
    """Without errors all points count alike; with friction about zero it is fitted as it is, not its logarithm."""
    curves = made(power, 44.0, 50.0, 56.0, noise=NOISE)
    unknown = curves_of(curves.speed, curves.temperature, curves.viscoelastic, np.inf, replicates=1)
    factors = shift_friction(unknown).shift_factors
    assert np.all(np.abs(deviation(factors)) < 0.2)
    assert np.all(np.isfinite(factors.covariance))
    about_zero = curves_of(curves.speed, curves.temperature, curves.viscoelastic - 0.015, 0.0003)
    found = shift_friction(about_zero).shift_factors
    assert np.any(about_zero.viscoelastic < 0.0)
    assert np.all(np.abs(deviation(found)) < 4.0 * found.standard_errors + 1e-9)


@pytest.mark.parametrize(("value", "error"), [(1.5e-5, 1e-5), (-1e-5, 1e-5), (2e-3, 3e-3), (0.0, 0.0)])
def test_a_point_near_zero_leaves_the_others_on_their_logarithms(value: float, error: float) -> None:
    """Friction over three decades: one point, known well or badly, moves no factor by a third of its error."""
    curves = made(
        lambda reduced: 2e-3 * reduced**0.9, 44.0, 50.0, 56.0, speeds=np.geomspace(0.002, 0.2, 9), noise=NOISE
    )
    least = int(np.argmin(curves.viscoelastic))
    friction, errors = curves.viscoelastic.copy(), curves.viscoelastic_error.copy()
    friction[least], errors[least] = value, error
    beside = replace(curves, viscoelastic=friction, viscoelastic_error=errors)
    one, other = (shift_friction(some, reference="50 degC").shift_factors for some in (curves, beside))
    np.testing.assert_array_less(np.abs(one.log10_values - other.log10_values)[[0, 2]], one.standard_errors[[0, 2]] / 3)
    np.testing.assert_allclose(other.standard_errors, one.standard_errors, rtol=0.3)  # the last point is wrong


def test_few_points_that_happen_to_agree_keep_their_stated_errors() -> None:
    """Two temperatures of three speeds have one degree of freedom: what they scatter by may be a third of 3 %."""
    exact = made(lambda reduced: 2e-3 * reduced**0.9, 44.0, 46.0, speeds=np.geomspace(0.02, 0.2, 3))
    least = 0.03 / np.log(10.0) * np.sqrt(2.0 / 3.0) / 0.9  # of the step between two means of three points
    for seed in range(8):
        scatter = 1.0 + 0.03 * np.random.default_rng(seed).standard_normal(6)
        stated = replace(exact, viscoelastic=exact.viscoelastic * scatter, viscoelastic_error=0.03 * exact.viscoelastic)
        assert shift_friction(stated, reference="44 degC").shift_factors.standard_errors[1] > least


def test_friction_of_few_speeds_that_is_the_same_within_its_errors_is_refused() -> None:
    """Three speeds have no scatter of their own: the stated errors tell that nothing is known but noise about zero."""
    curves = made(constant, 44.0, 50.0, 56.0, speeds=SPEEDS[:3])
    noise = 1e-3 * np.array([-0.8, 0.33, 1.6, 0.1, -0.2, 2.5, -0.7, 1.1, -0.4])
    with refused("curves-too-flat", SuperpositionError):
        shift_friction(replace(curves, viscoelastic=noise, viscoelastic_error=np.full(9, 1e-3)))


@given(st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=6), st.floats(1e-6, 1.0))
def test_the_scale_is_the_logarithm_far_above_zero_and_linear_about_it(values: list[float], zero: float) -> None:
    """Errors on it are those of its slope; values come back; 100 times above zero it is ln to 1e-4."""
    scale, some = Decades(zero), zero * np.array(values)
    # Of 1e3 below zero the place has 1e-3 of the size of what is subtracted, and this is rounded to 1e-16.
    np.testing.assert_allclose(scale.value(scale(some)), some, rtol=1e-9, atol=1e-9 * zero)
    step = 1e-4 * scale.unit(some)
    np.testing.assert_allclose(
        (scale(some + step) - scale(some - step)) / (2.0 * step) * scale.unit(some) * np.log(10.0), 1.0, rtol=1e-6
    )
    np.testing.assert_allclose(scale(np.array([100.0 * zero])), np.log10(100.0 * zero), atol=5e-5)


@settings(max_examples=10, deadline=None)
@given(st.floats(-3.0, 3.0), st.floats(-2.0, 2.0), st.integers(0, 3))
@pytest.mark.slow
def test_units_and_order_do_not_matter(speed: float, friction: float, seed: int) -> None:
    """Other units of speed, other friction by a factor (another radius), rows in any order: the same α and errors."""
    plain = made(power, 44.0, 50.0, 56.0, noise=NOISE)
    order = np.random.default_rng(seed).permutation(len(plain))
    other = curves_of(
        10.0**speed * plain.speed[order],
        plain.temperature[order],
        10.0**friction * plain.viscoelastic[order],
        10.0**friction * plain.viscoelastic_error[order],
        replicates=8,
    )
    one, two = shift_friction(plain).shift_factors, shift_friction(other).shift_factors
    # Rounding may choose the neighbouring one of the smoothing parameters, which are a quarter of a decade apart.
    np.testing.assert_allclose(two.log10_values, one.log10_values, atol=2e-3)
    np.testing.assert_allclose(two.standard_errors, one.standard_errors, rtol=0.05, atol=1e-9)
