"""Standard errors of shift factors: counted degrees of freedom, alike residuals, plateaus, laws and given tables."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.stats import linregress

import viscofric as vf
from rheology.planted import planted_sweeps, synthetic_polymer, synthetic_soft_rubber
from viscofric.data import Isotherm, IsothermalSweeps
from viscofric.notes import codes
from viscofric.rheology.shifts import law_fitting
from viscofric.rheology.superposition.common_shifts import fitted
from viscofric.rheology.superposition.isotherm_offsets import (
    BEFORE,
    BEFORE_TREND,
    SIZES,
    TRENDS,
    IsothermOffsets,
    OffsetSizes,
    estimated,
)
from viscofric.rheology.superposition.overlap import LogSweep, join, join_at
from viscofric.rheology.superposition.shift_problem import BEND, Gauge, ShiftProblem, continued, continued_covariance
from viscofric.rheology.superposition.step_profiles import StepProfiles, sampled

STEP = 0.5  # decades of α between neighbours of the power law
EXPONENT = 0.5  # of its moduli
FEW = np.array([0.0, 0.5, 1.0])  # decades of frequency: three points a sweep
NOISE = 0.01


def power_law_sweeps(seed, isotherms):
    """Sweep E' = E'' ∝ (α ω)^½ at 0, 10, … °C, by half a decade of α from one to the next."""
    random = np.random.default_rng(seed)
    found = []
    for place in range(isotherms):
        modulus = 1e7 * 10.0 ** (EXPONENT * (FEW - STEP * place))
        storage, loss = modulus * np.exp(NOISE * random.standard_normal((2, FEW.size)))
        found.append(Isotherm(273.15 + 10.0 * place, 10.0**FEW, storage, loss))
    return IsothermalSweeps(tuple(found))


def exact_covariance(isotherms):
    """Return the covariance of log10 α about the coldest isotherm, by linear least squares.

    Unknown are the shifts of all but the coldest, and a parabola of log E' and one of log E'', which is what remains
    of a smooth curve whose third derivative vanishes.
    """
    decades = (FEW[None, :] - STEP * np.arange(isotherms)[:, None]).ravel()
    parabola = np.vander(decades - decades.mean(), 3)
    moved = EXPONENT * np.repeat(np.eye(isotherms)[:, 1:], FEW.size, axis=0)
    nothing = np.zeros_like(parabola)
    jacobian = np.block([[moved, parabola, nothing], [moved, nothing, parabola]])
    inverse = np.linalg.inv(jacobian.T @ jacobian)
    return (NOISE / np.log(10.0)) ** 2 * inverse[: isotherms - 1, : isotherms - 1]


def from_points_alone(sweeps):
    """Return the standard errors of log10 α about the coldest isotherm that the scatter of the points makes."""
    logs = [LogSweep.of(one) for one in sweeps.isotherms]
    weights = np.eye(len(logs))[0]
    gauge = Gauge(1.0 / np.array([one.temperature for one in sweeps.isotherms]), weights, weights, {})
    found = fitted(logs, [join(colder, warmer) for colder, warmer in pairwise(logs)], gauge)
    return np.sqrt(np.diag(found.covariance))


@pytest.mark.apart
def test_few_points_leave_as_many_degrees_of_freedom_as_there_are_beyond_shifts_and_curves():
    """Eight sweeps of three points: 48 values less 6 coefficients less 7 shifts are 35, not 42."""
    isotherms = 8
    exact = np.diag(exact_covariance(isotherms))
    ratios, with_offsets = [], []
    for seed in range(40):
        sweeps = power_law_sweeps(seed, isotherms)
        ratios.append(np.mean(from_points_alone(sweeps)[1:] ** 2 / exact))
        factors = vf.superpose(sweeps, "0 degC").shift_factors
        with_offsets.append(np.mean(factors.standard_errors[1:] ** 2 / exact))
    # A variance from 35 degrees of freedom is known to √(2/35) = 24 %, the mean of 40 to 4 %; three of that.  Shifts
    # left uncounted make 35/42 = 0.83 of it.
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.12)
    # Power laws show nothing of offsets that E' and E'' share, for shifts take their place: of the variance before any
    # sweep is seen, half is that of the mean of both offsets, of the isotherm and of the coldest one each.  Nor do they
    # show a vertical shift that was left out.
    trend = np.log10(factors.temperatures / factors.reference)[1:] ** 2 * (BEFORE_TREND @ TRENDS**2)
    unseen = np.mean(1.0 + (BEFORE @ SIZES**2 / BEFORE.sum() + trend) / EXPONENT**2 / exact)
    assert 0.6 * unseen < np.mean(with_offsets) < 1.1 * unseen


def along_sweeps(random, size, points, alike):
    """Return errors of unit variance, (size, points), of first-order autoregression along the points."""
    errors = random.standard_normal((size, points))
    for place in range(1, points):
        errors[:, place] = alike * errors[:, place - 1] + np.sqrt(1.0 - alike**2) * errors[:, place]
    return errors


@pytest.mark.apart
def test_errors_alike_along_a_sweep_widen_the_standard_errors():
    """Points whose errors are 0.7 alike count for (1 − 0.7)/(1 + 0.7) of as many independent ones.

    Sweeps are dense, so that the common curves cannot follow such errors.
    """
    exact = planted_sweeps(0, 0.0, celsius=np.arange(20.0, 91.0, 10.0), frequencies=np.logspace(-1, 1, 81))
    scores = []
    for seed in range(20):
        random = np.random.default_rng(seed)
        noisy = []
        for one in exact.sweeps.isotherms:
            storage, loss = np.exp(NOISE * along_sweeps(random, 2, len(one), 0.7))
            moduli = storage * one.storage_modulus, loss * one.loss_modulus
            noisy.append(Isotherm(one.temperature, one.angular_frequency, *moduli))
        factors = vf.superpose(IsothermalSweeps(tuple(noisy)), "50 degC").shift_factors
        away = factors.log10_values - exact.log10_alpha(factors.temperatures, "50 degC")
        known = factors.standard_errors > 1e-9
        scores.append(away[known] / factors.standard_errors[known])
    # One fit has some three independent scores: the standard deviation of 60 is known to 0.09, three of that and a
    # little.  Taken for independent, the points would give √(1.7/0.3) = 2.4.  The means of such sweeps differ as
    # offsets of 0.3 % would; that these are not excluded makes 0.55 of 1.1.
    assert 0.4 < np.std(scores) < 1.3


@pytest.mark.parametrize("shared", [False, True], ids=["E' and E'' apart", "shared"])
def test_offsets_of_whole_isotherms_are_found_and_carried_into_the_errors(shared):
    """Isotherms off by 2 %, points by 1 %: the errors of α are those of the offsets, several times those of points."""
    sizes, scores, errors = [], [], []
    for seed in range(4):
        planted = planted_sweeps(seed, NOISE, offset=0.02, shared=shared, celsius=np.arange(0.0, 161.0, 10.0))
        fit = vf.superpose(planted.sweeps, "30 degC")
        factors = fit.shift_factors
        known = factors.standard_errors > 1e-9
        away = factors.log10_values - planted.log10_alpha(factors.temperatures, "30 degC")
        scores.append(away[known] / factors.standard_errors[known])
        sizes.append(fit.offsets.standard_deviations * np.log(10.0))
        errors.append(np.median(factors.standard_errors[known]))
    # 17 isotherms less their shifts leave some 12 values of each modulus: a size known to 20 %, the mean of 4 to 10 %.
    assert np.mean(sizes, axis=0) == pytest.approx([0.02, 0.02], rel=0.3)
    # 64 scores, a third of them independent: their spread is known to 15 %, two of that.  Points alone: above 1.8.
    # Errors are larger than those of the size planted, for sizes that are not excluded count, too.
    assert 0.55 < np.std(scores) < 1.35
    # Offsets of 2 % against a mean of 17 points of 1 %: the errors are up to √(1 + (0.02/0.01)² 17) = 8 times as large.
    calm = planted_sweeps(0, NOISE, celsius=np.arange(0.0, 161.0, 10.0)).sweeps
    points = vf.superpose(calm, "30 degC").shift_factors.standard_errors
    assert 2.0 < np.mean(errors) / np.median(points) < 8.0


@pytest.mark.apart
def test_offsets_beside_a_free_vertical_shift_keep_errors_where_they_are_found_too_small():
    """Sweeps fix the size of offsets badly there: where 1 % is found to be less, errors must not follow all the way."""
    found, scores = [], []
    rubber = {"material": synthetic_soft_rubber(), "celsius": np.arange(-30.0, 91.0, 10.0)}
    for seed in range(20):
        rising = vf.rheology.DensityShift("20 degC").log10
        frequencies = np.logspace(-2.0, 2.0, 21)
        planted = planted_sweeps(seed, 0.005, **rubber, frequencies=frequencies, log10_b=rising, offset=0.01)
        fit = vf.superpose(planted.sweeps, "20 degC", vertical="free")
        factors = fit.shift_factors
        known = factors.standard_errors > 1e-9
        away = factors.log10_values - planted.log10_alpha(factors.temperatures, "20 degC")
        found.append(fit.offsets.standard_deviations[0])
        scores.append(away[known] / factors.standard_errors[known])
    least = np.argsort(found)[:5]
    # 2.0 with errors that count on none as with a known vertical shift, and 1.2 for all twenty.
    assert np.sqrt(np.mean(np.array(scores)[least] ** 2)) < 1.5
    assert 0.7 < np.sqrt(np.mean(np.square(scores))) < 1.1


@pytest.mark.parametrize("tied", [False, True], ids=["b known", "b fitted"])
def test_sweeps_that_show_nothing_of_offsets_leave_them_as_likely_as_before(tied):
    isotherms = 3
    found = estimated(1e-6 * np.eye(1 + 2 * isotherms), np.zeros(1 + 2 * isotherms), np.eye(1), tied=tied)
    assert found.sizes.probability.sum() == pytest.approx(1.0, abs=1e-12)
    if tied:
        without = np.all(found.sizes.deviations == 0.0, axis=1)
        assert found.sizes.probability[without].sum() == pytest.approx(0.3 / 1.3, rel=1e-6)
    else:  # a half-Cauchy density of scale 0.01 decades; the cells end at 10^-0.1 and 10^1.1 of it
        small = np.all(found.sizes.deviations < 0.0099, axis=1)
        part = np.arctan(10.0**-0.1) / np.arctan(10.0**1.1)
        assert found.sizes.probability @ small == pytest.approx(part**2, rel=1e-6)
    mean = found.sizes.probability @ found.sizes.deviations**2
    assert np.diag(found.covariance) == pytest.approx([mean.mean()] * 2, rel=1e-9)


def test_drawn_offsets_have_any_of_their_sizes_and_shifts_follow_them():
    """Two sizes, 1 and 7, their mean variance 25: errors keep their covariance but for the tails that they get."""
    isotherms, samples = 2, 40_000
    sizes = OffsetSizes(np.array([[1.0, 1.0], [7.0, 7.0]]), np.array([0.5, 0.5]))
    follow = np.array([[0.0, 0.0, 0.0, 0.0], [0.5, -0.5, 0.25, 0.0]])  # of log10 α with the offsets
    own = np.diag([0.0, 4.0])
    offsets = 25.0 * np.eye(2 * isotherms)
    shared = np.concatenate([follow @ offsets, np.zeros((2, 4))])  # b is not fitted
    known = IsothermOffsets(25.0 * np.eye(2), shared, sizes)
    covariance = np.block([[own + follow @ offsets @ follow.T, shared[:2]], [shared[:2].T, offsets]])
    random = np.random.default_rng(0)
    values, vectors = np.linalg.eigh(covariance)
    errors = random.standard_normal((samples, 6)) @ (vectors * np.sqrt(np.maximum(values, 0.0))).T
    drawn = known.resized(random, errors)
    # A variance of 40 000 with kurtosis 5.8 is known to √(4.8/40 000) = 1.1 %; four of that.
    np.testing.assert_allclose(np.cov(drawn.T), covariance, atol=0.045 * 25.0)
    kurtosis = np.mean(drawn[:, 2:] ** 4, axis=0) / np.mean(drawn[:, 2:] ** 2, axis=0) ** 2
    np.testing.assert_allclose(kurtosis, 3.0 * (0.5 * 1.0 + 0.5 * 49.0**2) / 25.0**2, rtol=0.05)  # 5.8, normal 3
    # What of the shifts' errors follows no offset stays as it was.
    np.testing.assert_allclose(
        drawn[:, :2] - drawn[:, 2:] @ follow.T, errors[:, :2] - errors[:, 2:] @ follow.T, atol=1e-9
    )


def test_sweeps_without_offsets_keep_the_errors_of_their_points():
    ratios = []
    for seed in range(6):
        sweeps = planted_sweeps(seed, NOISE, celsius=np.arange(0.0, 91.0, 10.0)).sweeps
        errors = vf.superpose(sweeps, "0 degC").shift_factors.standard_errors[1:]
        ratios.append(np.median(errors / from_points_alone(sweeps)[1:]))
    # What ten isotherms cannot exclude: a few tenths of a per cent, as large as the noise of a mean of 17 points.
    assert 0.95 < np.mean(ratios) < 1.4


@pytest.mark.slow
def test_a_step_that_is_not_fixed_has_an_error_of_its_own_size(real_data):
    """The vendor's factors of an adhesive: E' alone asks for its coldest step, 2.9 decades, E'' for half of it."""
    sweeps = vf.read_dma(real_data / "dma" / "adhesive_ems_ca.csv", deformation="tension")
    vendor = vf.read_shift_factors(real_data / "dma" / "adhesive_ems_ca__vendor_shift.csv")
    for vertical in (None, "free"):
        fit = vf.superpose(sweeps, "25 degC", vertical=vertical)
        table = fit.shift_factors
        away = np.diff(table.log10_values - vendor.log10_values)
        steps = np.diff(np.eye(len(table.temperatures)), axis=0)
        error = np.sqrt(np.diag(steps @ table.covariance @ steps.T))
        assert abs(away[0]) < 2.0 * error[0]  # 13.6 of them with the curvature at the best joint overlap
        # E'' alone asks for 1.7 decades from 62 to 70 °C, E' for 0.3, both with a free vertical shift for 2.6.
        # Isotherms drift with and without one, so that errors hold half of the other model: 3.4 of them without.
        assert abs(away[15]) < 2.0 * error[15]
        assert fit.unidentified[0] == pytest.approx((223.17, 230.66), abs=0.01)
        assert "alpha-not-identified" in codes(fit.notes)
        assert not fit.check.holds


def test_profiles_agree_with_the_curvature_where_the_likelihood_is_a_parabola():
    polymer = {"celsius": np.arange(-25.0, 61.0, 5.0), "frequencies": np.logspace(-2, 2, 21)}
    sweeps = planted_sweeps(0, NOISE, material=synthetic_polymer(), **polymer).sweeps
    about = vf.superpose(sweeps, "-25 degC")
    ratio = about.shift_factors.standard_errors[1:] / from_points_alone(sweeps)[1:]
    # Four decades a sweep fix every step to 0.003 decades; offsets that are not excluded add some per cent.
    assert np.all((ratio > 0.9) & (ratio < 1.3))
    assert about.unidentified == ()


@pytest.mark.slow
def test_the_vendors_factors_of_an_adhesive_are_those_of_its_storage_modulus_alone(real_data):
    """They join E' without a vertical shift; E'' asks for less, so that they are no truth for a joint fit."""
    sweeps = vf.read_dma(real_data / "dma" / "adhesive_ems_ca.csv", deformation="tension")
    vendor = vf.read_shift_factors(real_data / "dma" / "adhesive_ems_ca__vendor_shift.csv")
    logs = [LogSweep.of(one) for one in sweeps.isotherms]
    joins = [join(colder, warmer) for colder, warmer in pairwise(logs)]
    weights = np.eye(len(logs))[10]  # 25 °C
    gauge = Gauge(1.0 / vendor.temperatures, weights, weights, {})
    steps = np.diff(np.eye(len(logs)), axis=0)
    inside = []
    for modulus in (0, 1):
        alone = [LogSweep(one.frequency, one.moduli[:, [modulus]]) for one in logs]
        found = fitted(alone, joins, gauge)
        errors = np.sqrt(np.diag(steps @ found.covariance @ steps.T))
        inside.append(np.abs(steps @ (found.values - vendor.log10_values)) < 1.96 * errors)
    assert np.mean(inside[0]) >= 0.9  # 19 or 20 of 20
    assert np.mean(inside[1]) < 0.6
    # Beside the vendor's factors, a free vertical shift brings E' no closer than half as close as beside fitted ones.
    given = vf.superpose(sweeps, "25 degC", vertical="free", shift=vendor).quality
    assert given.storage > 1.5 * vf.superpose(sweeps, "25 degC", vertical="free").quality.storage


def test_heavy_tails_of_a_likelihood_widen_errors_that_its_curvature_gives():
    """Student's distribution of five degrees of freedom has twice the variance that its curvature shows."""
    curvature = np.diag([5.0 / 6.0, 0.0, 1.0])  # the second is held, the third a parabola

    def likelihood(moved):
        return 6.0 * np.log1p(moved[:, 0] ** 2 / 5.0) + moved[:, 2] ** 2

    found = sampled(likelihood, np.zeros(3), curvature)
    assert found == pytest.approx(np.diag([5.0 / 3.0, 0.0, 1.0]), abs=0.15)  # 2000 draws
    assert not np.any(found[1])


def test_a_likelihood_does_not_depend_on_what_else_is_evaluated():
    """Splines that no point reaches change nothing, wherever other shifts spread the points."""
    sweeps = planted_sweeps(0, NOISE, celsius=np.arange(20.0, 61.0, 10.0)).sweeps
    logs = [LogSweep.of(one) for one in sweeps.isotherms]
    joins = [join(colder, warmer) for colder, warmer in pairwise(logs)]
    weights = np.eye(len(logs))[0]
    gauge = Gauge(1.0 / np.array([one.temperature for one in sweeps.isotherms]), weights, weights, {})
    problem = ShiftProblem(logs, joins, gauge)
    shifts = -np.concatenate([[0.0], np.cumsum([one.step for one in joins])])
    profiles = StepProfiles(problem, problem.smoothers(shifts), logs, 0.01**2 * np.eye(2 * len(logs)))
    far = shifts + np.array([0.0, 0.0, 0.0, 3.0, 6.0])
    apart = [*profiles(shifts[None]), *profiles(far[None])]
    # The ridge that keeps splines solvable makes 1e-4; an interval ends where the likelihood has changed by 3.8.
    assert profiles(np.array([shifts, far])) == pytest.approx(apart, rel=0.0, abs=1e-3)
    assert apart[1] - apart[0] > 1000.0


def plateau_gauge(size, reference):
    """Isotherms at equal steps in 1/T, α = 1 at one of them."""
    inverse = 1.0 / 300.0 - 1e-4 * np.arange(size)
    weights = np.eye(size)[reference]
    return Gauge(inverse, weights, weights, {})


@pytest.mark.parametrize("hot", [True, False], ids=["hot end", "cold end"])
def test_errors_grow_over_a_plateau_as_a_rate_that_wanders(hot):
    """The rate of 1.5 errs by the part BEND more in every step, also in the first: shifts by √1, √5 = √(1 + 4), √14."""
    reported = -1.5 * np.arange(4.0)
    if hot:
        place = plateau_gauge(7, 1), 0, 4
        values, covariance = continued(reported, *place), continued_covariance(np.zeros((4, 4)), reported, *place)
        beyond, expected = slice(4, 7), -1.5 * np.arange(4.0, 7.0)
        shift = values - values[0]
    else:
        place = plateau_gauge(7, 5), 3, 7
        values, covariance = continued(reported, *place), continued_covariance(np.zeros((4, 4)), reported, *place)
        values, covariance = values[::-1], covariance[::-1, ::-1]
        beyond, expected = slice(4, 7), 1.5 * np.arange(4.0, 7.0)
        shift = values - values[0]
    assert shift[beyond] == pytest.approx(expected, rel=1e-9)
    errors = np.sqrt(np.diag(covariance))
    # Rounding only: the factors that were told are exact here.
    assert errors[:4] == pytest.approx(0.0, abs=1e-12)
    assert errors[beyond] == pytest.approx(1.5 * BEND * np.sqrt([1.0, 5.0, 14.0]), rel=1e-9)
    # What the first step errs is in the second twice.
    assert covariance[4, 5] == pytest.approx(2.0 * (1.5 * BEND) ** 2, rel=1e-9)


@pytest.mark.parametrize(("count", "wider"), [(5, 2.0), (40, 1.05)])
def test_a_law_fitted_to_bare_values_has_the_errors_of_a_regression_line(count, wider):
    """Without errors of its own, log10 α over 1/T is a line whose scatter is known from n − 2 residuals."""
    random = np.random.default_rng(4)
    kelvin = np.linspace(280.0, 350.0, count) + random.uniform(-1.0, 1.0, count)
    values = vf.Arrhenius("120 kJ/mol", 300.0).log10(kelvin) + 0.05 * random.standard_normal(count)
    law = vf.ShiftFactors(kelvin, values, 300.0).law("arrhenius")
    line = linregress(1.0 / kelvin, values)
    [constant], [error] = law.parameters, law.standard_errors
    # Few residuals determine neither their size nor whether they bend along temperature.
    assert 1.0 < error / constant / (line.stderr / line.slope) < wider
    assert constant == pytest.approx(line.slope * np.log(10.0) * 8.314462618, rel=1e-6)


@pytest.mark.apart
def test_scatter_added_to_a_law_counts_its_two_constants():
    """WLF to six values: χ² is brought to 6 − 1 − 2 = 3, of which three residuals exclude no bends."""
    random = np.random.default_rng(1)
    kelvin = np.arange(290.0, 391.0, 20.0)
    truth, none = vf.WLF(9.0, 110.0, 310.0), np.zeros((kelvin.size, kelvin.size))
    differences = np.diff(np.eye(kelvin.size), axis=0)
    whitened = np.linalg.solve(np.linalg.cholesky(differences @ differences.T), differences @ truth.gradient(kelvin))
    exact = 0.01 * np.sqrt(np.diag(np.linalg.inv(whitened.T @ whitened)))
    squares, ratios = [], []
    for _ in range(60):
        values = truth.log10(kelvin) + 0.01 * random.standard_normal(kelvin.size)
        table = law_fitting.FactorTable.of(kelvin, values, none, 310.0)
        law, _, scatter, _ = law_fitting.fitted("wlf", table)
        squares.append((scatter / 0.01) ** 2)
        ratios.append(np.array(law.standard_errors) / exact)
    # Variances from 3 residuals are known to √(2/3), the mean of 60 to 11 %; counting 5 makes 0.6 of them.
    assert np.mean(squares) == pytest.approx(1.0, abs=0.25)
    # Deviations that bend would change the constants more than scatter of the same size does.
    assert np.all(np.mean(np.square(ratios), axis=0) > 0.75)
    assert np.all(np.mean(np.square(ratios), axis=0) < 6.0)


def test_a_given_table_lends_each_sweep_the_error_of_its_own_temperature():
    sweeps = planted_sweeps(0, 0.01, celsius=[40.0, 50.0, 65.0]).sweeps
    kelvin = np.arange(0.0, 81.0, 10.0) + 273.15
    errors = 0.01 * np.arange(9.0)[::-1]
    errors[4] = 0.0  # the reference, 40 °C
    values = vf.synthetic_fluoroelastomer().shift.at_reference("40 degC").log10(kelvin)
    table = vf.ShiftFactors(kelvin, values, "40 degC", np.diag(errors**2))
    fit = vf.superpose(sweeps, "40 degC", shift=table)
    # 65 °C lies between 60 °C (0.02) and 70 °C (0.01), by the weight w of the former in 1/T.
    first, second, between = 1.0 / 333.15, 1.0 / 343.15, 1.0 / 338.15
    w = (between - second) / (first - second)
    assert fit.shift_factors.standard_errors[:2] == pytest.approx([0.0, 0.03], abs=1e-12)
    assert fit.shift_factors.standard_errors[2] == pytest.approx(np.hypot(0.02 * w, 0.01 * (1.0 - w)), rel=1e-9)


def test_the_error_of_a_join_falls_with_the_slope_and_the_points():
    """Straight lines of slope s, misfit m at n points of two moduli: the step is known to m/(s √(2n))."""
    decades = np.linspace(0.0, 2.0, 9)
    zigzag = 0.02 * (-1.0) ** np.arange(9)
    for slope in (0.25, 0.5):
        straight = np.stack([slope * decades, slope * decades], axis=1)
        found = join_at(LogSweep(decades, straight), LogSweep(decades, straight + zigzag[:, None]), 0.0)
        assert found.misfit == pytest.approx(0.02, rel=1e-9)
        assert found.uncertainty == pytest.approx(0.02 / (slope * np.sqrt(18.0)), rel=1e-9)


def test_an_arrhenius_law_bends_no_trend_however_the_temperatures_are_spaced():
    kelvin = np.array([280.0, 284.0, 296.0, 300.0, 320.0, 323.0])
    values = vf.Arrhenius("150 kJ/mol", 300.0).log10(kelvin)
    decades = np.linspace(-1.0, 1.0, 9)
    logs = [LogSweep(decades, 7.0 + 0.3 * (decades + one)[:, None] * np.ones(2)) for one in values]
    joins = [join(colder, warmer) for colder, warmer in pairwise(logs)]
    weights = np.eye(6)[3]
    problem = ShiftProblem(logs, joins, Gauge(1.0 / kelvin, weights, weights, {}))
    trends = problem.prior[5:] @ values
    assert len(trends) == 4
    # Straight in 1/T but for rounding.
    assert trends == pytest.approx(0.0, abs=1e-9)
    curved = problem.prior[5:] @ vf.WLF(9.0, 60.0, 300.0).log10(kelvin)
    assert np.abs(curved).max() > 0.1
