"""That shift factors of friction and of a DMA coincide becomes a number with an error bar."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from importlib.resources import as_file, files

import numpy as np
import pytest

from friction.synthetic_curves import planted_law, synthetic_curves
from refusals import refused
from viscofric import read_dma
from viscofric.friction.shifting.shift import shift_friction
from viscofric.friction.shifting.shift_agreement import ShiftAgreement, compare_shift_factors
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.superposition.superpose import superpose

LAW = WLF(C1=9.0, C2=100.0, reference="30 degC")
KELVIN = 303.15 + np.array([0.0, 5.0, 10.0, 16.0, 22.0, 30.0, 38.0, 48.0, 60.0])
# From the reference on, independent steps add up.
STEPS = np.tril(np.ones((9, 9))) * (np.arange(9) > 0)


def factors(error: float, random: np.random.Generator, *, stretch: float = 1.0) -> ShiftFactors:
    """Draw shift factors whose steps scatter by an error, with the covariance that this makes."""
    exact = stretch * np.asarray(LAW.log10(KELVIN))
    scattered = exact + error * STEPS @ random.standard_normal(9)
    return ShiftFactors(KELVIN, scattered, 303.15, error**2 * STEPS @ STEPS.T)


@cache
def drawn(stretch: float) -> list[ShiftAgreement]:
    random = np.random.default_rng(5)
    return [compare_shift_factors(factors(0.02, random, stretch=stretch), factors(0.03, random)) for _ in range(200)]


@pytest.mark.slow
def test_p_is_uniform_where_both_are_the_same() -> None:
    """200 pairs: each fifth holds 40 ± 5.7; three and a half standard deviations."""
    counts, _ = np.histogram([one.p_value for one in drawn(1.0)], 5, (0.0, 1.0))
    assert np.all(np.abs(counts - 40) < 20)


@pytest.mark.slow
@pytest.mark.parametrize("stretch", [1.0, 1.1])
def test_the_slope_holds_what_its_error_says(stretch: float) -> None:
    """Errors of both counted, k neither leans to zero nor misses its interval more than in one of twenty."""
    agreements = drawn(stretch)
    slope = np.array([one.slope for one in agreements])
    inside = np.abs(slope - stretch) < 1.96 * np.array([one.slope_error for one in agreements])
    # The standard deviation of the share is 1.5 %; the error grows where points scatter, so that it may hold more.
    assert 0.905 <= inside.mean() <= 0.995
    assert slope.mean() == pytest.approx(stretch, abs=4 * slope.std() / np.sqrt(200))


def test_different_factors_are_distinguished() -> None:
    agreement = compare_shift_factors(factors(0.02, np.random.default_rng(1), stretch=1.3), LAW)
    assert agreement.p_value < 1e-6
    assert abs(agreement.slope - 1.3) < 4.0 * agreement.slope_error
    assert agreement.freedom == 8
    assert agreement.temperature[0] == pytest.approx(308.15)


def test_another_reference_changes_no_verdict() -> None:
    """χ² is the same about any measured temperature; about one between, one combination says nothing."""
    random = np.random.default_rng(2)
    found, other = factors(0.02, random), factors(0.03, random)
    about = compare_shift_factors(found, other)
    moved = compare_shift_factors(found.at_reference(KELVIN[4]), other)
    assert moved.chi2 == pytest.approx(about.chi2, rel=1e-4)
    between = compare_shift_factors(found.at_reference("60 degC"), other)
    assert between.freedom == 8
    assert between.temperature.size == 8
    amid = compare_shift_factors(found.at_reference("58 degC"), other)
    assert amid.freedom == 8
    assert amid.temperature.size == 9
    assert amid.chi2 == pytest.approx(about.chi2, rel=0.05)  # but for what interpolation does


@pytest.mark.slow
def test_friction_and_dma_of_one_rubber_agree() -> None:
    """The paper's claim, on the synthetic fluoroelastomer: both are measured with noise, and coincide within it."""
    with as_file(files("viscofric") / "example" / "dma.csv") as path:
        sweeps = read_dma(path)
    near = tuple(one for one in sweeps.isotherms if 293.0 < one.temperature < 374.0)
    dma = superpose(replace(sweeps, isotherms=near), "60 degC")
    friction = shift_friction(synthetic_curves(noise=0.05, seed=3), reference="60 degC")
    agreement = compare_shift_factors(friction, dma)
    assert agreement.p_value > 0.01
    assert abs(agreement.slope - 1.0) < 3.0 * agreement.slope_error
    assert agreement.slope_error < 0.03
    assert agreement.rms < 0.06
    assert agreement.chi2 == compare_shift_factors(friction, dma.shift_factors).chi2
    exact = compare_shift_factors(shift_friction(synthetic_curves()), planted_law())
    assert exact.slope == pytest.approx(1.0, abs=2e-3)
    # The rubber has that very law.
    assert compare_shift_factors(shift_friction(synthetic_curves()), synthetic_fluoroelastomer()).slope == exact.slope


def test_a_master_curve_shifted_by_a_law_holds_its_factors() -> None:
    """The table at the temperatures of the curves, with the law's covariance."""
    law = factors(0.02, np.random.default_rng(4)).law("wlf")
    master = shift_friction(synthetic_curves(30.0, 40.0, 52.0), shift=law)
    table = master.shift_factors
    np.testing.assert_allclose(table.log10_values, law.log10(table.temperatures), atol=1e-12)
    np.testing.assert_allclose(table.standard_errors, law.standard_error(table.temperatures), rtol=1e-9)
    assert not master.found
    assert compare_shift_factors(master, law).slope == pytest.approx(1.0, abs=1e-9)
    given = factors(0.02, np.random.default_rng(4))
    assert shift_friction(synthetic_curves(30.0), shift=given).shift_factors is given


def test_what_cannot_be_compared_is_refused() -> None:
    table = factors(0.02, np.random.default_rng(1))
    apart = ShiftFactors([303.15, 304.0], [0.0, -0.05], 303.15)
    with refused("nothing-to-compare"):
        compare_shift_factors(table, apart)


def test_factors_that_scatter_more_than_their_errors_say_widen_that_of_the_slope() -> None:
    """One unknown, n − 1 degrees of freedom; for equal independent errors k and its error are those of a textbook."""
    law = WLF(C1=9.0, C2=100.0, reference=303.15)
    kelvin = 303.15 + np.array([0.0, 10.0, 20.0, 30.0])
    x = np.asarray(law.log10(kelvin))
    y = x + np.array([0.0, 0.1, -0.1, 0.1])
    found = ShiftFactors(kelvin, y, 303.15, np.diag([0.0, 1e-4, 1e-4, 1e-4]))
    agreement = compare_shift_factors(found, law)
    slope = x @ y / (x @ x)
    deviation = np.sqrt(np.sum((y - slope * x) ** 2) / 2.0)
    # 1e-6 decades are added to the errors, 1e-8 of their squares.
    assert agreement.slope == pytest.approx(slope, rel=1e-6)
    assert agreement.slope_error == pytest.approx(deviation / np.sqrt(x @ x), rel=1e-6)


def test_data_set_has_all_temperatures_and_nan_where_the_other_is_unknown() -> None:
    found = factors(0.02, np.random.default_rng(3))
    other = ShiftFactors(KELVIN[:5], LAW.log10(KELVIN[:5]), 303.15)
    agreement = compare_shift_factors(found, other)
    data = agreement.to_dataset()
    np.testing.assert_allclose(data["temperature"], KELVIN)
    np.testing.assert_array_equal(data["log10_shift_factor"], found.log10_values)
    np.testing.assert_array_equal(data["standard_error"], found.standard_errors)
    np.testing.assert_allclose(data["known_log10_shift_factor"][:5], LAW.log10(KELVIN[:5]), atol=1e-12)
    assert np.all(np.isnan(data["known_log10_shift_factor"][5:]))
    assert data.attrs["reference_temperature"] == 303.15
    assert data.attrs["p_value"] == agreement.p_value
    exact = compare_shift_factors(found, LAW.at_reference("60 degC")).to_dataset()
    np.testing.assert_allclose(exact["known_log10_shift_factor"], LAW.log10(KELVIN), atol=1e-12)
    np.testing.assert_array_equal(exact["known_standard_error"], 0.0)
