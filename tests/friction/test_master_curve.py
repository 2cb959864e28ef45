"""Friction at several temperatures collapses onto one curve, which gives it at any speed and temperature."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from friction.made_runs import friction_curves
from refusals import refused
from viscofric.arrays import Array
from viscofric.friction.curve_checks import LEFT_OUT, scatter_of, with_tails
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting import master_curve
from viscofric.friction.shifting.shift import shift_friction
from viscofric.notes import codes, note_of
from viscofric.rheology.shifts.laws import WLF, Arrhenius
from viscofric.rheology.shifts.shift_factors import ShiftFactors

LAW = WLF(C1=8.86, C2=101.6, reference="50 degC")
# 20 to 200 mm/s in 10 steps; at 44, 50 and 56 °C neighbours overlap by half a decade.
SPEEDS = np.geomspace(0.02, 0.2, 10)
TEMPERATURES = np.array([317.15, 323.15, 329.15])


def friction(reduced_speed: Array) -> Array:
    """Bend by 1 per decade on a log-log plot, as the friction of a broad spectrum does at most."""
    return np.asarray(0.03 * 10.0 ** (-0.5 * np.log10(reduced_speed / 0.1) ** 2))


def peak(reduced_speed: Array) -> Array:
    """Rise and fall like the loss of one retardation time."""
    return np.asarray(0.06 / (reduced_speed / 0.1 + 0.1 / reduced_speed))


def shifted_curves(temperatures: Array = TEMPERATURES, noise: float = 0.0, seed: int = 1) -> FrictionCurves:
    speed, temperature = np.tile(SPEEDS, len(temperatures)), np.repeat(temperatures, len(SPEEDS))
    exact = friction(np.asarray(LAW(temperature)) * speed)
    random = np.random.default_rng(seed).standard_normal(exact.size)
    return friction_curves(speed, temperature, exact * (1.0 + noise * random), error=noise * exact)


def test_shifted_friction_collapses_onto_one_curve() -> None:
    """Eq. 10: every point of μ(v, T) = f(α(T) v) lies on f at its reduced speed, to rounding."""
    master = shift_friction(shifted_curves(), shift=LAW)
    np.testing.assert_allclose(master.friction_coefficient, friction(master.reduced_speed), rtol=1e-12)
    assert np.all(np.diff(master.reduced_speed) > 0)
    assert master.reference == 323.15
    warmest = master.temperature == 329.15
    np.testing.assert_allclose(master.reduced_speed[warmest], LAW(329.15) * SPEEDS, rtol=1e-12)


def test_another_reference_slides_the_curve() -> None:
    """α about T1 is α(T)/α(T1): the same friction at a speed and temperature."""
    here = shift_friction(shifted_curves(), shift=LAW)
    there = shift_friction(shifted_curves(), shift=LAW, reference="44 degC")
    np.testing.assert_allclose(there.reduced_speed * LAW(317.15), here.reduced_speed, rtol=1e-12)
    # The same regression on the same abscissae, but for rounding of them.
    assert there("100 mm/s", "47 degC") == pytest.approx(here("100 mm/s", "47 degC"), rel=1e-9)


@pytest.mark.parametrize(("curve", "accuracy"), [(friction, 0.005), (peak, 0.01)])
def test_a_single_smooth_curve_is_read_to_the_accuracy_stated(curve: object, accuracy: float) -> None:
    """As the docstring of FrictionMasterCurve states it, for 10 points per decade."""
    speed = np.geomspace(0.02, 0.2, 11)
    assert callable(curve)
    master = shift_friction(friction_curves(speed, np.full(11, 323.15), curve(speed)), shift=LAW)
    between = np.geomspace(0.02, 0.2, 301)
    np.testing.assert_allclose(master(between), curve(between), rtol=accuracy)


def test_friction_at_any_speed_and_temperature_comes_from_the_reduced_speed() -> None:
    master = shift_friction(shifted_curves(), shift=LAW)
    speeds, kelvin = np.array([0.05, 0.3, 0.01]), np.array([320.0, 328.0, 318.0])
    found = master(speeds, kelvin)
    np.testing.assert_allclose(found, friction(np.asarray(LAW(kelvin)) * speeds), rtol=0.005)
    assert found.shape == (3,)
    assert isinstance(master("50 mm/s", "47 degC"), float)
    assert master("50 mm/s") == pytest.approx(float(friction(np.array(0.05))), rel=0.005)
    assert master(speeds[:, None], kelvin[None, :1]).shape == (3, 1)
    assert master(["20 mm/s", "30 mm/s"]).shape == (2,)


@pytest.mark.slow
def test_smoothing_averages_noise_and_says_how_well() -> None:
    """Over many noisy tests the value at one place scatters by the standard error that is given there."""
    values, errors = [], []
    for seed in range(200):
        master = shift_friction(shifted_curves(noise=0.03, seed=seed), shift=LAW)
        values.append(master("0.1 m/s", "50 degC"))
        errors.append(master.standard_error("0.1 m/s", "50 degC"))
    # The standard deviation of 200 values is known to 5 %; three times that.
    assert np.std(values) == pytest.approx(np.mean(errors), rel=0.15)
    assert np.mean(errors) < 0.03 * 0.03
    assert np.mean(values) == pytest.approx(0.03, rel=0.005)


@pytest.mark.parametrize(("stated", "level"), [(0.0, 0.0), (0.1, 0.0), (1.0, 0.05)])
def test_errors_that_are_not_stated_or_shared_are_those_of_the_curve_too(stated: float, level: float) -> None:
    """Points that state a part of their noise, or share a level at each temperature: 95 % held 0, 16 and 58 %."""
    held = []
    for seed in range(60):
        curves = shifted_curves(noise=0.03, seed=seed)
        random = np.random.default_rng(1000 + seed).standard_normal(len(TEMPERATURES))
        levels = np.repeat(1.0 + level * random, len(SPEEDS))
        planted = replace(
            curves,
            viscoelastic=levels * curves.viscoelastic,
            viscoelastic_error=stated * curves.viscoelastic_error,
        )
        master = shift_friction(planted, shift=LAW, level_error=level)
        found, error = master([0.05, 0.1, 0.2]), master.standard_error([0.05, 0.1, 0.2])
        held.append(np.abs(found - friction(np.array([0.05, 0.1, 0.2]))) < 1.96 * error)
    # 180 places, of which some 60 to 120 are independent: 0.95 less three standard deviations.
    assert np.mean(held) == pytest.approx(0.95, abs=0.06)


def test_points_that_the_curve_goes_through_keep_their_errors() -> None:
    """Two speeds at each of three temperatures that do not overlap: distances from the curve are rounding."""
    law, speed, temperature = WLF(8.86, 101.6, 300.0), np.tile([0.01, 0.02], 3), np.repeat([300.0, 320.0, 340.0], 2)
    random = np.random.default_rng(0).standard_normal(6)
    exact = friction(np.asarray(law(temperature)) * speed)
    noisy = friction_curves(speed, temperature, exact * (1.0 + 0.03 * random), error=0.03 * exact)
    master = shift_friction(noisy, shift=law)
    np.testing.assert_allclose(
        master.standard_error(master.reduced_speed), 0.03 * friction(master.reduced_speed), rtol=1e-9
    )


@pytest.mark.parametrize(("stated", "replicates"), [(0.0, 0), (1.0, 0), (1.0, 3)])
def test_outliers_count_less(stated: float, replicates: int) -> None:
    """Beside points off by ten errors 95 % intervals held a third, and with errors of three replicates 80 % anyway."""
    warm, near, far, noted = np.arange(305.15, 342.0, 6.0), [], [], []
    for seed in range(40):
        random = np.random.default_rng(500 + seed)
        curves = shifted_curves(warm, noise=0.03, seed=seed)
        seen = np.sqrt(random.chisquare(replicates - 1, len(curves)) / (replicates - 1)) if replicates else 1.0
        outlier = int(random.integers(len(curves)))
        off = np.where(np.arange(len(curves)) == outlier, 1.0 + 0.3 * random.choice([-1.0, 1.0]), 1.0)
        master = shift_friction(
            replace(
                curves,
                viscoelastic=off * curves.viscoelastic,
                viscoelastic_error=stated * seen * curves.viscoelastic_error,
            ),
            shift=LAW,
        )
        noted += [note.values["speed"] for note in map(note_of, master.notes) if note.code == "outlying-points"]
        at = np.geomspace(1.05 * master.reduced_range[0], master.reduced_range[1] / 1.05, 25)
        held = np.abs(master(at) - friction(at)) < 1.96 * master.standard_error(at)
        away = np.abs(np.log10(at / float(LAW(curves.temperature[outlier]) * curves.speed[outlier])))
        near += held[away < 0.15].tolist()
        far += held[away > 0.4].tolist()
    assert len(noted) >= 36
    # Of some 40 independent places each: three standard deviations of 0.95, and at the ends outliers pass unseen.
    assert np.mean(near) > 0.84
    assert np.mean(far) > 0.9


@pytest.mark.parametrize("outliers", [0, 10])
def test_means_leave_out_a_quarter_of_outliers_and_lose_little_without(outliers: int) -> None:
    """Of normal scatter the variance grows by 2 %; with outliers to both sides the mean is that of the other points."""
    squares = []
    for seed in range(400):
        values = np.random.default_rng(seed).standard_normal(40)
        values[:outliers] += 20.0 * (-1.0) ** np.arange(outliers)

        def fit(larger: Array, _: float, values: Array = values) -> tuple[float, Array, float]:
            weight = 1.0 / larger
            mean, pull = float(weight @ values / weight.sum()), weight / weight.sum()
            left = values - mean
            away = left**2 / ((1.0 - pull) * (1.0 - pull + pull * larger))
            return mean, away / scatter_of(float(weight @ left**2), 39.0, larger, away), 1.0

        mean, larger, _ = with_tails(np.ones(40), fit)
        assert np.all(larger[:outliers] == LEFT_OUT)
        squares.append(mean**2 * (40 - outliers))
    # 400 squares of one degree of freedom scatter by 7 %; the samples are those of the mean itself without outliers.
    plain = [
        np.random.default_rng(seed).standard_normal(40)[outliers:].sum() ** 2 / (40 - outliers) for seed in range(400)
    ]
    assert np.mean(squares) < 1.05 * np.mean(plain)


def test_an_outlier_does_not_lose_temperatures() -> None:
    """Single points off by half lost 92 of 280 temperatures, and at the ends of their curves 39."""
    for seed in range(10):
        curves = shifted_curves(np.arange(305.15, 342.0, 6.0), noise=0.02, seed=seed)
        off = np.where(np.arange(len(curves)) == 10 * (seed % 7) + (4, 0, 9)[seed % 3], 2.0, 1.0)
        master = shift_friction(replace(curves, viscoelastic=off * curves.viscoelastic))
        assert len(master.shift_factors.temperatures) == 7
        assert "outlying-points" in codes(master.notes)


@pytest.mark.parametrize(("speeds", "size", "least"), [(10, 0.08, 0.68), (10, 0.2, 0.73), (6, 0.2, 0.55)])
def test_few_points_off_by_four_to_ten_errors_leave_intervals_right(speeds: int, size: float, least: float) -> None:
    """Three of 48 or 90: where they lie, 32, 81 and 0 % of the intervals of friction held."""
    celsius = np.linspace(10.0, 70.0, 9 if speeds == 10 else 8)
    speed = np.tile(np.geomspace(0.01, 1.0 if speeds == 10 else 0.6, speeds), len(celsius))
    law, kelvin = WLF(9.0, 110.0, 313.15), np.repeat(celsius + 273.15, speeds)
    exact = 0.02 + 0.25 * np.exp(-0.5 * ((np.log10(law(kelvin) * speed) + 1.5) / 1.3) ** 2)
    there = []
    for seed in range(16):
        random = np.random.default_rng(seed)
        coefficient = exact * (1.0 + 0.02 * random.standard_normal(len(speed)))
        off = random.choice(len(speed), 3, replace=False)
        coefficient[off] *= 1.0 + size * random.choice([-1.0, 1.0], 3)
        curves = friction_curves(speed, kelvin, coefficient, error=0.02 * exact)
        master = shift_friction(curves, shift=law)
        at = law(kelvin[off]) * speed[off]
        there += (np.abs(master(at) - exact[off]) < 1.96 * master.standard_error(at)).tolist()
    # Of 48 places 77, 87 and 71 % hold in longer trials; less 1.5 standard deviations.
    assert np.mean(there) > least


@pytest.mark.parametrize(("place", "off"), [(1, 0.5), (1, 1.5), (-2, 0.5), (-2, 1.5)])
def test_an_outlier_beside_an_end_is_not_taken_for_the_curve(place: int, off: float) -> None:
    """A curve hardly leaves the point at its end: this was left out for the outlier beside it, and nothing overlapped.

    95 % intervals of both shifts and 6 seeds hold 9 of 12 or more with a probability of 99.8 %.
    """
    speed, temperature = np.tile(np.geomspace(1e-3, 0.5, 25), 3), np.repeat([293.15, 303.15, 313.15], 25)
    law = Arrhenius("80 kJ/mol", "40 degC")
    exact = 0.05 + 0.3 * np.exp(-0.5 * ((np.log10(law(temperature) * speed) + 1.5) / 1.2) ** 2)
    away = []
    for seed in range(6):
        coefficient = exact * (1.0 + 0.01 * np.random.default_rng(seed).standard_normal(75))
        coefficient[25 + place % 25] *= off
        curves = friction_curves(speed, temperature, coefficient, error=0.01 * exact)
        factors = shift_friction(replace(curves, replicates=np.full(75, 9)), reference="40 degC").shift_factors
        assert len(factors.temperatures) == 3
        errors = np.sqrt(np.diag(factors.covariance))[:2]
        away += list(np.abs(factors.log10_values - law.log10(factors.temperatures))[:2] / errors)
    assert np.count_nonzero(np.array(away) < 1.96) >= 9


@pytest.mark.parametrize("shift", [LAW, None])
@pytest.mark.parametrize("said", ["replicates", "freedom", "nothing"])
def test_replicates_that_are_inferred_are_noted(said: str, shift: WLF | None) -> None:
    """As by `identify_material`, once, whether the shift factors are given or found."""
    curves, random = shifted_curves(np.arange(305.15, 342.0, 6.0), noise=0.03), np.random.default_rng(3)
    seen = np.sqrt(random.chisquare(3, len(curves)) / 3.0)
    few = replace(curves, viscoelastic_error=seen * curves.viscoelastic_error)
    if said == "replicates":
        few = replace(few, replicates=np.full(len(curves), 4))
    if said == "freedom":
        few = replace(few, viscoelastic_freedom=np.full(len(curves), 3.0))
    noted = [note.code for note in map(note_of, shift_friction(few, shift=shift).notes)]
    assert noted.count("inferred-freedom") == (1 if said == "nothing" else 0)
    assert "inferred-freedom" not in codes(shift_friction(curves, shift=shift).notes)
    # Near zero errors are averaged as what they are alike in, too.
    near = replace(
        few,
        viscoelastic=few.viscoelastic - 0.9 * few.viscoelastic.min(),
        viscoelastic_error=3.0 * few.viscoelastic_error,
    )
    assert ("inferred-freedom" in codes(shift_friction(near, shift=LAW).notes)) is (said == "nothing")


def test_points_off_a_curve_of_one_retardation_time_are_no_outliers() -> None:
    """The parabola is off by 1 % there, whatever the errors."""
    for noise in (0.0, 1e-4, 3e-3):
        curves = shifted_curves(np.arange(305.15, 342.0, 6.0), noise=noise)
        reduced = np.asarray(LAW(curves.temperature)) * curves.speed
        sharp = curves.viscoelastic / friction(reduced) * peak(reduced)
        assert codes(shift_friction(replace(curves, viscoelastic=sharp), shift=LAW).notes) == set()


@pytest.mark.parametrize(("stated", "noise"), [(0.0, 0.0), (0.0, 0.03), (np.inf, 0.0), (1.0, 0.03)])
def test_outliers_are_noted_by_their_part_of_friction_where_no_error_is_stated(stated: float, noise: float) -> None:
    """Of exact friction they lie off by 10¹⁴ times its rounding, which is no error of a measurement."""
    curves = shifted_curves(np.arange(305.15, 342.0, 6.0), noise=noise)
    error = np.full(len(curves), np.inf) if np.isinf(stated) else stated * curves.viscoelastic_error
    off = np.where(np.arange(len(curves)) == 35, 1.5, 1.0)
    master = shift_friction(
        replace(curves, viscoelastic=off * curves.viscoelastic, viscoelastic_error=error), shift=LAW
    )
    noted = [note for note in map(note_of, master.notes) if note.code == "outlying-points"]
    if np.isinf(stated):  # of unknown errors no distance is judged
        assert noted == []
    elif stated:
        # Three errors of the point, and two of the scatter of all, known to 9 %.
        assert noted[0].values["standard_errors"] == pytest.approx([0.5 / 0.03], abs=6.0)
        assert "relative" not in noted[0].values
    else:
        # Three standard errors of the point, whose weight is nearly zero.
        assert noted[0].values["relative"] == pytest.approx([0.5], abs=4.5 * noise + 0.005)
        assert "standard_errors" not in noted[0].values


@pytest.mark.parametrize("stated", [0.0, 1.0])
def test_one_outlier_does_not_widen_all_errors(stated: float) -> None:
    """A point twice too high in the middle of 70, with 3 % of noise elsewhere, widened all six- to ninefold."""
    curves = shifted_curves(np.arange(305.15, 342.0, 6.0), noise=0.03)
    curves = replace(curves, viscoelastic_error=stated * curves.viscoelastic_error)
    reduced = np.asarray(LAW(curves.temperature)) * curves.speed
    middle = np.argsort(reduced)[len(curves) // 2]
    spoilt = replace(curves, viscoelastic=np.where(np.arange(len(curves)) == middle, 2.0, 1.0) * curves.viscoelastic)
    clean, one = (shift_friction(each, shift=LAW).standard_error(reduced.max()) for each in (curves, spoilt))
    assert clean <= one < 1.2 * clean


def test_scatter_that_level_errors_explain_is_counted_once() -> None:
    """Levels of 10 % at three temperatures, stated as such, beside points of 0.1 %."""
    factors = []
    for seed in range(40):
        curves = shifted_curves(noise=0.001, seed=seed)
        levels = 1.0 + 0.1 * np.random.default_rng(1000 + seed).standard_normal(len(TEMPERATURES))
        planted = replace(curves, viscoelastic=np.repeat(levels, len(SPEEDS)) * curves.viscoelastic)
        master = shift_friction(planted, shift=LAW, level_error=0.1)
        # Of one temperature only: its level error, whatever the scatter about the curve elsewhere.
        lowest = master.reduced_speed[0]
        factors.append(master.standard_error(lowest) / master(lowest))
    assert np.median(factors) == pytest.approx(0.1, rel=0.05)


@pytest.fixture
def places(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Numbers of places smoothed together, filled in as this happens."""
    found: list[int] = []
    plain = master_curve.smoothing_weights

    def counting(points: Array, weights: Array, at: Array, bandwidth: float) -> Iterator[tuple[slice, slice, Array]]:
        found.append(at.size)
        return plain(points, weights, at, bandwidth)

    monkeypatch.setattr(master_curve, "smoothing_weights", counting)
    return found


def test_distances_of_many_points_are_found_once(places: list[int]) -> None:
    """The distances of all points from the curve cost a thousand times as much as one value."""
    speed = np.geomspace(0.001, 1.0, 500)
    master = shift_friction(friction_curves(speed, np.full(500, 323.15), friction(speed)), shift=LAW)
    for read in (master, master.standard_error, master.standard_error):
        read(0.1)
    assert places == [500, 1, 1, 1]


def test_many_outliers_of_many_points_are_found_without_smoothing_again(places: list[int]) -> None:
    """Of 250 points per decade 8 % are off by 50 %; one round for each in half a decade smoothed 25,000 places."""
    random, speed = np.random.default_rng(1), np.geomspace(1e-3, 10.0, 1000)
    off = random.permutation(1000) < 80
    noisy = peak(speed) * (1.0 + 0.02 * random.standard_normal(1000)) * np.where(off, 1.5, 1.0)
    master = shift_friction(friction_curves(speed, np.full(1000, 323.15), noisy, error=0.02 * noisy), shift=LAW)
    [note] = [one for one in map(note_of, master.notes) if one.code == "outlying-points"]
    # Off by 25 errors; of the others one may be, in one set in a hundred.
    np.testing.assert_array_equal(note.values["speed"], speed[off])
    assert places == [1000]


def test_overlap_is_exact_without_noise_and_shows_noise() -> None:
    exact = shift_friction(shifted_curves(), shift=LAW)
    # A cubic spline through 9 intervals of a decade; h⁴/384 of the fourth derivative, more at the ends.
    assert exact.overlap.rms == pytest.approx(0.0, abs=1e-3)
    assert exact.overlap.error == 0.0  # no errors were given
    noisy = shift_friction(shifted_curves(noise=0.02), shift=LAW)
    # Of some 20 points, and the spline averages a little: within 40 %.
    assert noisy.overlap.rms == pytest.approx(0.02 * np.sqrt(2), rel=0.4)
    assert noisy.overlap.error == pytest.approx(0.02 * np.sqrt(2), rel=0.05)
    assert noisy.overlap.sentence.code == "curves-coincide"
    assert noisy.overlap.sentence.values == {
        "rms": noisy.overlap.rms,
        "points": noisy.overlap.points,
        "expected": noisy.overlap.error,
    }


def test_overlap_reveals_wrong_shift_factors() -> None:
    right = shift_friction(shifted_curves(noise=0.01), shift=LAW)
    wrong = shift_friction(shifted_curves(noise=0.01), shift=Arrhenius("60 kJ/mol", "50 degC"))
    assert right.overlap.rms is not None
    assert wrong.overlap.rms is not None
    assert wrong.overlap.rms > 5 * right.overlap.rms


def test_without_overlap_it_says_so_and_bridges_no_gap() -> None:
    """The paper's temperatures are so far apart that a decade of speed leaves gaps between the curves."""
    master = shift_friction(shifted_curves(np.array([313.15, 338.15])), shift=LAW)
    assert master.overlap.rms is None
    assert master.overlap.points == 0
    assert codes([master.overlap.sentence]) == {"curves-apart"}
    assert len(master.stretches) == 2
    low, high = master.stretches[0][1], master.stretches[1][0]
    with refused("not-covered"):
        master(np.sqrt(low * high))
    inside = [end for stretch in master.stretches for end in stretch]
    # At the ends of stretches, on a flank of slope −1.8: the regression is true to 1 %.
    np.testing.assert_allclose(master(np.array(inside)), friction(np.array(inside)), rtol=0.01)


def test_beyond_the_range_it_refuses() -> None:
    master = shift_friction(shifted_curves(), shift=LAW)
    low, high = master.reduced_range
    assert np.all(np.isfinite(master(np.array([low, high]))))
    for reduced in (0.99 * low, 1.01 * high):
        with refused("not-covered"):
            master(reduced)


def test_few_points_are_joined_by_what_they_allow() -> None:
    """Two points make a line in log v, one a constant; three make a line too, not an unchecked parabola."""
    for count in (1, 2, 3):
        speed = SPEEDS[:count]
        master = shift_friction(
            friction_curves(speed, np.full(count, 323.15), 0.03 + 0.01 * np.log10(speed)), shift=LAW
        )
        place = float(np.sqrt(speed[0] * speed[-1]))
        # Three points weigh differently, but they lie on one line.
        assert master(place) == pytest.approx(0.03 + 0.01 * np.log10(place), rel=1e-9)


def test_unknown_errors_give_no_nan() -> None:
    curves = shifted_curves()
    error = np.full(len(curves), np.inf)
    master = shift_friction(
        friction_curves(curves.speed, curves.temperature, curves.viscoelastic, error=error), shift=LAW
    )
    assert master("0.1 m/s") == pytest.approx(0.03, rel=0.005)
    assert master.standard_error("0.1 m/s") == np.inf
    assert master.overlap.error == np.inf


@pytest.mark.parametrize("shift", [LAW, None])
def test_temperatures_that_scatter_about_nominal_ones_are_compared_as_these(shift: WLF | None) -> None:
    """A table has the temperature of each reading; no two are equal."""
    curves = shifted_curves(noise=0.001)
    scattered = curves.temperature + 0.1 * np.sin(np.arange(len(curves)))
    master = shift_friction(friction_curves(curves.speed, scattered, curves.viscoelastic), shift=shift)
    expected = shift_friction(curves, shift=LAW)
    assert master.overlap.points == pytest.approx(expected.overlap.points, abs=2)
    assert master.overlap.rms == pytest.approx(0.0, abs=0.02)
    steep = friction_curves(curves.speed, scattered, curves.speed**-1.5, error=1e-4)
    assert "too-steep" in codes(shift_friction(steep, shift=LAW).notes)


@pytest.mark.parametrize("error", [np.inf, 0.0])
@pytest.mark.parametrize(("power", "code"), [(-1.5, "too-steep"), (0.0, "constant-friction"), (-0.4, "")])
def test_friction_without_standard_errors_is_judged_by_its_scatter(error: float, power: float, code: str) -> None:
    """A single run has no errors, but 1 % of scatter is seen from one speed to the next."""
    curves = shifted_curves()
    scatter = 1.0 + 0.01 * np.random.default_rng(2).standard_normal(len(curves))
    once = friction_curves(curves.speed, curves.temperature, 0.02 * scatter * curves.speed**power, error=error)
    said = codes(shift_friction(once, shift=LAW).notes)
    assert {"too-steep", "constant-friction"} & said == {code} - {""}


def test_three_noisy_points_are_not_called_too_steep() -> None:
    """The scatter about a line through three has one degree of freedom."""
    three = friction_curves(SPEEDS[:3], np.full(3, 323.15), SPEEDS[:3] ** -1.4 * np.array([1.0, 1.02, 1.0]), error=0.0)
    assert "too-steep" not in codes(shift_friction(three, shift=LAW).notes)


def test_noise_of_few_replicates_is_not_negative_friction() -> None:
    """Without viscoelastic friction, a mean of 3 replicates lies 2 standard errors below zero at 9 % of the points."""
    curves, random, noted = shifted_curves(), np.random.default_rng(4), 0
    for _ in range(100):
        replicates = random.standard_normal((3, len(curves)))
        error = replicates.std(axis=0, ddof=1) / np.sqrt(3.0)
        few = replace(curves, viscoelastic=replicates.mean(axis=0), viscoelastic_error=error)
        few = replace(few, replicates=np.full(len(curves), 3))
        noted += "friction-below-zero" in codes(shift_friction(few, shift=LAW).notes)
    assert noted <= 9  # 2.5 expected
    negative = replace(few, viscoelastic=few.viscoelastic - 30.0)
    assert "friction-below-zero" in codes(shift_friction(negative, shift=LAW).notes)


def test_friction_of_pure_coulomb_friction_is_not_below_zero_by_rounding() -> None:
    curves = replace(shifted_curves(), viscoelastic=np.full(30, -1e-17), coulomb=np.full(30, 0.3))
    assert "friction-below-zero" not in codes(shift_friction(curves, shift=LAW).notes)


def test_different_loads_are_not_mixed() -> None:
    curves = friction_curves(SPEEDS, np.full(10, 323.15), np.full(10, 0.03), load=np.repeat([10.0, 25.0], 5))
    with refused("several-loads"):
        shift_friction(curves, shift=LAW)
    assert len(shift_friction(curves.at_load("25 N"), shift=LAW)) == 5


@pytest.mark.parametrize(
    ("speed", "temperature", "code"),
    [
        (-1.0, None, "not-positive"),
        ("1 kg", None, "wrong-unit"),
        ([0.1, 0.2], [320.0] * 3, "different-lengths"),
    ],
)
def test_senseless_places_are_refused(speed: object, temperature: object, code: str) -> None:
    master = shift_friction(shifted_curves(), shift=LAW)
    with refused(code):
        master(speed, temperature)  # type: ignore[arg-type]


def test_data_set_holds_the_points_along_the_reduced_speed() -> None:
    curves = shifted_curves(noise=0.01)
    master = shift_friction(curves, shift=LAW)
    data = master.to_dataset()
    assert data.attrs == {"reference_temperature": 323.15, "load": curves.load[0]}
    assert data["reduced_speed"].attrs["units"] == "m/s"
    np.testing.assert_array_equal(data["reduced_speed"], master.reduced_speed)
    order = np.argsort(LAW(curves.temperature) * curves.speed)
    np.testing.assert_array_equal(data["temperature"], curves.temperature[order])
    np.testing.assert_array_equal(data["viscoelastic"], curves.viscoelastic[order])
    np.testing.assert_array_equal(data["viscoelastic_error"], curves.viscoelastic_error[order])


def test_errors_of_shift_factors_move_points_of_other_temperatures_along_the_curve():
    speed, kelvin = np.tile(np.geomspace(0.01, 1.0, 21), 2), np.repeat([293.15, 333.15], 21)
    law = ShiftFactors([293.15, 333.15], [0.0, -2.5], 293.15, [[0.0, 0.0], [0.0, 0.04**2]])
    friction = 0.05 * (law(kelvin) * speed) ** 0.2
    small = 1e-6 * friction
    curves = FrictionCurves(speed, kelvin, np.full(42, 25.0), friction, small, small, np.ones(42))
    master = shift_friction(curves, shift=law)
    own, other = master.standard_error(0.1), master.standard_error(10.0**-3.5)  # points at 60 °C, seen from 20 °C
    assert own < 1e-5 * master(0.1)
    # 0.04 decades along a power of 0.2; the parabola and the difference for the slope are exact to a per cent.
    assert other == pytest.approx(0.2 * 0.04 * np.log(10.0) * master(10.0**-3.5), rel=0.01)
    assert master.standard_error(0.1, 333.15) < 1e-5 * master(0.1, 333.15)  # both move together
