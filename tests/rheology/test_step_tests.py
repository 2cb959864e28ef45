"""Creep and relaxation tests: superposed like sweeps, with bands that contain planted truth, and spectra from them."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import planted_steps, synthetic_polymer
from viscofric.notes import codes
from viscofric.rheology.spectra.misfit import CreepMisfit, RelaxationMisfit
from viscofric.rheology.superposition.common_shifts import fitted
from viscofric.rheology.superposition.overlap import LogSweep, join
from viscofric.rheology.superposition.result import _noise, weights_of_averages
from viscofric.rheology.superposition.shift_problem import Gauge
from viscofric.step_tests import parts_of_decades

TIMES = np.logspace(-1.0, 2.0, 31)


def rubber() -> vf.RetardationSpectrum:
    """Three decades of retardation between 1 MPa and 100 MPa."""
    tau = np.logspace(-2.0, 2.0, 9)
    C = np.full(9, (1e-6 - 1e-8) / 9)
    return vf.RetardationSpectrum(1e6, 1e8, C, tau)


def curve(spectrum: vf.RetardationSpectrum, kind: str, noise: float = 0.0, time=TIMES) -> vf.readers.StepMasterCurve:
    true = spectrum.creep_compliance(time) if kind == "creep" else spectrum.relaxation_modulus(time)
    scatter = 1.0 + noise * np.random.default_rng(0).standard_normal(time.size)
    return vf.readers.StepMasterCurve(time, true * scatter, np.full(time.size, 300.0), 300.0, kind)


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"time": np.append(TIMES[:-1], TIMES[-2])}, "not-ascending"),
        ({"time": TIMES - TIMES[0]}, "wrong-length"),
        ({"response": TIMES[:-1]}, "wrong-length"),
        ({"response": ["3 MPa"] * 30 + ["1 1/MPa"]}, "wrong-unit"),
        ({"response": ["3 MPa"] * 31, "unit": "1/Pa"}, "wrong-unit"),
        ({"unit": "MPa"}, "wrong-choice"),
    ],
)
def test_columns_that_are_no_test_are_refused(change, code):
    with refused(code):
        vf.readers.StepTest(300.0, **{"time": TIMES, "response": TIMES} | change)


@pytest.mark.parametrize(("response", "unit", "kind"), [("3 MPa", "Pa", "relaxation"), ("3e12 1/MPa", "1/Pa", "creep")])
def test_a_response_with_units_is_in_si_and_belongs_to_tests_of_its_kind(response, unit, kind):
    warm = vf.readers.StepTest("27 degC", ["1 s", "1 min"], [response, response])
    assert (warm.unit, list(warm.response)) == (unit, [3e6, 3e6])
    assert vf.readers.StepTests((warm,), kind).thinned(2).tests[0].unit == unit
    with refused("wrong-unit"):
        vf.readers.StepTests((warm,), "creep" if kind == "relaxation" else "relaxation")
    other = "1 1/MPa" if kind == "relaxation" else "1 MPa"
    with refused("wrong-unit"):
        vf.readers.StepMasterCurve([1.0], [other], [300.0], 300.0, kind)


def test_shear_responses_become_tensile_ones():
    one = vf.readers.StepTest(300.0, TIMES, np.full(31, 3.0))
    creep = vf.readers.StepTests((one,), "creep", "shear").in_tension(0.5)
    relaxation = vf.readers.StepTests((one,), "relaxation", "shear").in_tension(0.5)
    assert creep.tests[0].response[0] == pytest.approx(1.0)
    assert relaxation.tests[0].response[0] == pytest.approx(9.0)
    assert (creep.deformation, len(creep.notes)) == ("tension", 1)
    compressed = vf.readers.StepTests((one,), "creep", "compression")
    assert compressed.in_tension(0.5) is compressed


def test_points_of_a_part_of_a_decade_are_averaged():
    dense = vf.readers.StepTest(300.0, np.arange(1.0, 2000.0), 1e-6 * np.arange(1.0, 2000.0) ** 0.3)
    thin = dense.thinned(20)
    assert len(thin) < 20 * 3.5
    np.testing.assert_allclose(thin.response, 1e-6 * thin.time**0.3, rtol=1e-12)  # a power law stays one
    sparse = vf.readers.StepTest(300.0, np.logspace(0.0, 3.0, 31), np.arange(1.0, 32.0))
    np.testing.assert_allclose(sparse.thinned(20).time, sparse.time)


def test_data_sets_have_units():
    tests = planted_steps(0)[0]
    points = tests.to_dataset()
    assert points.creep_compliance.attrs["units"] == "1/Pa"
    assert points.sizes["reading"] == sum(len(one) for one in tests.tests)
    assert points.attrs["kind"] == "creep"
    assert curve(rubber(), "relaxation").to_dataset().relaxation_modulus.attrs["units"] == "Pa"


@pytest.mark.parametrize("kind", ["creep", "relaxation"])
def test_laplace_inversion_is_exact(kind):
    spectrum = synthetic_polymer().spectrum
    time = np.logspace(-9.0, 6.0, 120)
    measured = curve(spectrum, kind, time=time)
    misfit = {"creep": CreepMisfit, "relaxation": RelaxationMisfit}[kind](1.0 / time[::-1], measured.modulus[::-1])
    assert np.max(np.abs(misfit.residual(misfit.compliance(spectrum)))) < 2e-8
    # Derivatives, by differences.
    tau, strengths = np.array(spectrum.tau), np.append(1.0 / spectrum.E_inf, spectrum.C)
    columns = misfit.columns(tau)
    jacobian = misfit.jacobian(columns @ strengths, columns)
    for place in (0, 5, 25):
        moved = strengths.copy()
        moved[place] *= 1.0 + 1e-5
        change = misfit.residual(columns @ strengths) - misfit.residual(columns @ moved)
        expected = jacobian[:, place] * 1e-5 * strengths[place]
        np.testing.assert_allclose(change, expected, rtol=1e-3, atol=1e-4 * np.abs(expected).max())
    moved = misfit.moved(misfit.relaxed(tau), np.array(spectrum.C), tau)
    later = misfit.relaxed(tau * np.exp(1e-5)) @ np.diag(spectrum.C)
    now = misfit.relaxed(tau) @ np.diag(spectrum.C)
    np.testing.assert_allclose((later - now) / 1e-5, moved, rtol=1e-3, atol=1e-5 * np.abs(moved).max())


@pytest.mark.parametrize("kind", ["creep", "relaxation"])
@pytest.mark.parametrize(
    ("method", "error"),
    [({}, 0.02), ({"method": "sparse"}, 0.04), ({"method": "regularised", "regularisation": 1e-3}, 0.03)],
)
def test_spectra_come_back(kind, method, error):
    planted = rubber()
    spectrum = vf.fit_retardation_spectrum(curve(planted, kind, time=np.logspace(-6.0, 3.0, 91)), **method)
    inside = np.logspace(-1.5, 0.5, 20)
    found, true = spectrum.complex_modulus(inside), planted.complex_modulus(inside)
    np.testing.assert_allclose(found.real, true.real, rtol=error)
    np.testing.assert_allclose(found.imag, true.imag, rtol=4.0 * error)
    assert spectrum.fit.rms_step < 0.005
    assert spectrum.fit.rms_storage is None
    assert spectrum.fit.frequency_range == pytest.approx((1e-3, 1e5 if kind == "creep" else 1e4))


@pytest.mark.parametrize(("kind", "reach"), [("creep", 0.1), ("relaxation", 0.01)])
def test_times_far_apart_leave_a_gap_above_what_the_later_ones_determine(kind, reach):
    # Processes faster than the later times have ended before these, as those faster than the first time.
    time = np.concatenate([np.geomspace(1e-2, 3e-2, 5), np.geomspace(1.0, 1e4, 33)])
    fit = vf.fit_retardation_spectrum(curve(rubber(), kind, time=time)).fit
    ((first, last),) = fit.gaps
    assert (first, last) == pytest.approx((reach / 1.0, 1.0 / 3e-2), rel=1e-12)
    # The early times span half a decade, less than such a test needs beyond its longest time.
    assert fit.frequency_range == pytest.approx((1e-4, last), rel=1e-12)
    assert fit.covers([0.9 * first, 2.0 * first, last]).tolist() == [True, False, True]
    whole = vf.fit_retardation_spectrum(curve(rubber(), kind, time=np.geomspace(1e-2, 1e4, 49))).fit
    assert (whole.gaps, whole.frequency_range[1]) == ((), pytest.approx(reach / 1e-2, rel=1e-12))


def test_a_flowing_creep_compliance_has_no_spectrum_for_contacts():
    flowing = curve(rubber(), "creep")
    liquid = vf.readers.StepMasterCurve(
        flowing.time, flowing.response + 1e-6 * flowing.time, flowing.temperature, flowing.reference, "creep"
    )
    with refused("liquid", vf.LiquidError, naming="100 s"):
        vf.fit_retardation_spectrum(liquid)
    noisy = curve(rubber(), "creep", 0.03)  # a solid stays one
    assert len(vf.fit_retardation_spectrum(noisy)) > 0


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["creep", "relaxation"])
def test_planted_shift_factors_come_back(kind):
    tests, material, reference = planted_steps(1, 0.005, kind=kind)
    fit = vf.superpose(tests, reference)
    factors = fit.shift_factors
    true = material.shift.at_reference(reference).log10(factors.temperatures)
    assert np.max(np.abs(factors.log10_values - true)) < 0.06
    assert np.all(factors.standard_errors[factors.temperatures != factors.reference] < 0.05)
    assert vf.rheology.check_superposition(fit).holds
    assert fit.check.to_dataset().attrs["verdict"] == "holds"
    assert fit.to_dataset().attrs["kind"] == kind
    assert "golub1973" in vf.citations(fit).keys
    assert fit.master_curve.kind == kind
    true = material.at(reference)
    response = true.creep_compliance if kind == "creep" else true.relaxation_modulus
    np.testing.assert_allclose(fit.master_curve.response, response(fit.master_curve.time), rtol=0.03)
    assert (
        pytest.approx(vf.superpose(tests, reference, shift=material.shift).shift_factors.law("wlf").C2, rel=0.2)
        == fit.shift_factors.law("wlf").C2
    )


def least_squares(tests: vf.readers.StepTests, reference: float) -> np.ndarray:
    """Return log10 α by least squares, which attributes a part of each offset to the shifts."""
    kelvin = np.array([one.temperature for one in tests.tests])
    logs = [LogSweep.of_step(one, tests.kind) for one in tests.tests]
    at_reference = np.where(np.abs(kelvin - reference) < 1e-6, 1.0, 0.0)
    gauge = Gauge(1.0 / kelvin, at_reference, at_reference, {})
    return fitted(logs, [join(colder, warmer) for colder, warmer in pairwise(logs)], gauge).values


@pytest.mark.slow
def test_offsets_of_whole_tests_hardly_move_the_shifts():
    """Tests off by 1 %, points by 0.5 %: steps follow from differences between points of a test, not from its level."""
    squares, scores = [], []
    for seed in range(4):
        tests, material, reference = planted_steps(seed, 0.005, offset=0.01)
        factors = vf.superpose(tests, reference).shift_factors
        true = material.shift.at_reference(reference).log10(factors.temperatures)
        away = factors.log10_values - true
        squares.append([np.mean(away**2), np.mean((least_squares(tests, factors.reference) - true) ** 2)])
        known = factors.standard_errors > 1e-9
        scores.append(away[known] / factors.standard_errors[known])
    found, by_least_squares = np.sqrt(np.mean(squares, axis=0))
    # The ratio is 0.31 over 60 other seeds, and 0.2 with these.
    assert found < 0.5 * by_least_squares
    # Errors within one fit move together: four fits have some 12 independent scores, whose spread is known to 20 %.
    assert np.sqrt(np.mean(np.square(scores))) == pytest.approx(1.0, abs=0.5)


@pytest.mark.parametrize(("kind", "power"), [("creep", -1.0), ("relaxation", 1.0)])
def test_errors_of_tests_include_a_vertical_shift_that_was_left_out(kind, power):
    """On the plateau ρT looks like a slope, along which α was said to be known."""
    tests, material, reference = planted_steps(1, name="polymer", kind=kind)
    rising = vf.rheology.DensityShift(reference)
    lifted = tuple(replace(one, response=one.response * rising(one.temperature) ** power) for one in tests.tests)
    raised = vf.readers.StepTests(lifted, kind)
    none, left_out, known = (
        vf.superpose(tests, reference),
        vf.superpose(raised, reference),
        vf.superpose(raised, reference, vertical="density"),
    )
    assert (codes(none.notes), codes(known.notes)) == (set(), set())
    assert codes(left_out.notes) == {"vertical-shift-left-out", "alpha-not-identified"}
    fitted_to = left_out.shift_factors
    away = fitted_to.log10_values - material.shift.at_reference(reference).log10(fitted_to.temperatures)
    assert np.all(np.abs(away) <= 1.96 * fitted_to.standard_errors)
    # Tests that exclude such a shift hardly have more than the errors of a known one: 1.0 to 1.3 times as large, since
    # these few leave open a tenth of T/T0.
    assert np.all(none.shift_factors.standard_errors <= 1.4 * known.shift_factors.standard_errors)


@pytest.mark.slow
def test_vertical_shifts_of_tests_are_fitted_beside_horizontal_ones():
    tests, material, reference = planted_steps(1, 0.003)
    rising = vf.rheology.DensityShift(reference)
    lifted = tuple(
        vf.readers.StepTest(one.temperature, one.time, one.response / rising(one.temperature)) for one in tests.tests
    )
    fit = vf.superpose(vf.readers.StepTests(lifted, "creep"), reference, vertical="free")
    away = fit.vertical_shift.log10_values - rising.log10(fit.shift_factors.temperatures)
    errors = fit.vertical_shift.standard_errors
    assert np.mean(np.abs(away[errors > 0]) < 2.5 * errors[errors > 0]) > 0.8
    assert not np.any(fit.offsets.covariance)  # part of b
    drawn = vf.sample_materials(fit, samples=20)
    assert drawn.materials[0].vertical_shift is not None
    known = vf.superpose(vf.readers.StepTests(lifted, "creep"), reference, vertical="density")
    np.testing.assert_allclose(
        known.shift_factors.log10_values,
        material.shift.at_reference(reference).log10(known.shift_factors.temperatures),
        atol=0.06,
    )


#: Readings every half second: one in each of the first parts of a decade, and more than a hundred in the last.
EVEN = np.linspace(0.1, 1000.0, 2000)


def test_averages_of_many_readings_count_for_more_as_far_as_these_are_independent():
    random, smooth = np.random.default_rng(0), 1e-6 * EVEN**0.2
    white = [vf.readers.StepTest(300.0, EVEN, smooth * (1 + 0.01 * random.standard_normal(2000))) for _ in range(3)]
    drifting = [replace(one, response=smooth * (1 + 0.01 * np.sin(3.0 * np.log(EVEN) + place)))
                for place, one in enumerate(white)]  # fmt: skip
    counts = parts_of_decades(EVEN, 20)[1][::-1]  # from the last part to the first
    for tests, most in ((white, 8.0), (drifting, 0.1)):  # of readings that share their error every one is as good
        for weights in weights_of_averages(tests, "creep"):
            ratio = weights[0] / weights[-1]
            assert ratio == pytest.approx((1.0 + 1.0 / most) / (1.0 / counts[0] + 1.0 / most), rel=0.3)
    sparse = [vf.readers.StepTest(300.0, TIMES, np.ones(31)) for _ in range(3)]
    assert weights_of_averages(sparse, "creep") == [None] * 3


@pytest.mark.apart
def test_errors_hold_for_readings_at_equal_intervals():
    """Every average once counted alike: intervals held 0.89 of α."""
    within = []
    for seed in range(10):
        tests, material, reference = planted_steps(seed, 0.01, name="polymer", time=EVEN)
        factors = vf.superpose(tests, reference).shift_factors
        away = factors.log10_values - material.shift.at_reference(reference).log10(factors.temperatures)
        known = factors.standard_errors > 1e-9
        within.append(np.abs(away[known]) < 1.96 * factors.standard_errors[known])
    assert np.mean(within) > 0.93  # 0.99 with these seeds


def test_the_slope_of_a_curve_is_no_noise_where_points_lie_unevenly():
    """Second differences took it for 2 % of noise, behind which a failure of superposition hid."""
    steep = vf.readers.StepTest(300.0, EVEN, 1e-6 * EVEN**0.3).thinned(20)
    assert _noise(LogSweep.of_step(steep, "creep")) < 1e-9


def test_tests_on_a_plateau_are_not_moved_apart():
    """A step ran off by seven decades, thirty times its error, where noise alone tells tests apart."""
    tau, law, random = np.logspace(-6.0, 6.0, 49), vf.WLF(8.0, 100.0, "20 degC"), np.random.default_rng(7)
    spectrum, time, tests = (
        vf.RelaxationSpectrum(1e6, 2e4 / np.sqrt(tau), tau).to_retardation(),
        np.linspace(1.0, 1000.0, 200),
        [],
    )
    for kelvin in np.arange(283.15, 318.0, 5.0):
        true = spectrum.creep_compliance(time / float(law(kelvin)))
        tests.append(vf.readers.StepTest(kelvin, time, true * (1.0 + 0.01 * random.standard_normal(time.size))))
    fit = vf.superpose(vf.readers.StepTests(tuple(tests), "creep"), "20 degC")
    factors, away = fit.shift_factors, fit.shift_factors.log10_values - law.log10(fit.shift_factors.temperatures)
    assert np.all(np.abs(away) <= 3.0 * factors.standard_errors)
    assert "alpha-not-identified" in codes(fit.notes)
    assert "no-overlap" not in codes(fit.notes)


def test_tests_of_other_materials_do_not_superpose():
    tests, _, reference = planted_steps(1, 0.005)
    bent = tuple(
        vf.readers.StepTest(one.temperature, one.time, one.response ** (1.0 + 0.03 * place))
        for place, one in enumerate(tests.tests)
    )
    fit = vf.superpose(vf.readers.StepTests(bent[:5], "creep"), bent[2].temperature)
    assert not fit.check.holds
    note = fit.check.sentences[0]
    assert note.code in ("superposition-fails", "superposition-roughly")
    assert note.values == {"figure_of_merit": fit.check.figure_of_merit, "vertical_shift": False}
    assert reference


def test_flow_is_noted():
    tests, _, reference = planted_steps(1, 0.005)
    liquid = tuple(
        vf.readers.StepTest(
            one.temperature, one.time, one.response * (1.0 + one.time / (1e4 * 10.0 ** -(0.06 * place)))
        )
        for place, one in enumerate(tests.tests)
    )
    assert "flow" not in [getattr(note, "code", "") for note in vf.superpose(tests, reference).notes]
    steep = (*liquid[:-1], vf.readers.StepTest(liquid[-1].temperature, liquid[-1].time, 1e-6 * liquid[-1].time ** 0.98))
    from viscofric.rheology.superposition.result import flowing

    assert [note.code for note in flowing(steep)] == ["flow"]
    # In the glass transition J may grow as steeply, but other tests are softer without growing so.
    last, below = steep[-1], 1e-3 * steep[0].response[0]
    transition = vf.readers.StepTest(250.0, last.time, below * (last.time / last.time[-1]) ** 0.95)
    assert flowing((transition, *tests.tests)) == []
    assert [note.code for note in flowing((transition,))] == ["flow"]


def test_arguments_for_two_moduli_are_refused():
    tests, _, reference = planted_steps(0)
    with refused("useless-weights"):
        vf.superpose(tests, reference, by="storage")
    with refused("too-few-isotherms", vf.SuperpositionError):
        vf.superpose(vf.readers.StepTests(tests.tests[:1], "creep"), reference)
    with refused("other-master-curve"):
        fit = vf.superpose(tests, reference)
        vf.sample_materials(fit, vf.fit_retardation_spectrum(curve(rubber(), "creep")), samples=20)


@pytest.mark.apart
@pytest.mark.parametrize(("kind", "noise", "seeds"), [("creep", 0.005, 12), ("relaxation", 0.02, 6)])
def test_bands_contain_what_was_planted(kind, noise, seeds):
    """As for sweeps; benchmarks/rheology counts over more problems."""
    inside: dict[str, list[float]] = {"alpha": [], "response": [], "storage": []}
    for seed in range(seeds):
        tests, material, reference = planted_steps(seed, noise, kind=kind)
        fit = vf.superpose(tests, reference)
        factors, time = fit.shift_factors, np.geomspace(*fit.master_curve.time[[0, -1]], 40)
        known = factors.standard_errors > 1e-9
        away = factors.log10_values - material.shift.at_reference(reference).log10(factors.temperatures)
        inside["alpha"].append(np.mean(np.abs(away[known]) < 1.96 * factors.standard_errors[known]))
        drawn = vf.sample_materials(fit, samples=60, seed=seed)
        true = material.at(reference)

        def response(spectrum, time=time):
            return spectrum.creep_compliance(time) if kind == "creep" else spectrum.relaxation_modulus(time)

        band = drawn.band(lambda one: response(one.spectrum))
        inside["response"].append(np.mean((response(true) >= band.lower) & (response(true) <= band.upper)))
        omega = 1.0 / time[4:-4]
        moduli = drawn.modulus_band(omega)
        storage = true.complex_modulus(omega).real
        inside["storage"].append(np.mean((storage >= moduli.lower.real) & (storage <= moduli.upper.real)))
    # Errors within one fit move together: over 12 seeds the mean differs by 0.04, over 6 by 0.06.
    for shares in inside.values():
        assert np.mean(shares) == pytest.approx(0.95, abs=0.09)


@pytest.mark.slow
def test_polystyrene_superposes_and_flows(real_data):
    celsius = (145, 160, 175, 190)
    creep = vf.read_step_tests(
        [real_data / "creep" / f"creep_ps{one}.csv" for one in celsius],
        deformation="shear",
        temperature=[f"{one} degC" for one in celsius],
        response_unit="1/Pa",
    )
    assert [len(one) for one in creep.tests] == [6981, 3599, 3599, 3598]
    assert codes(creep.notes) == {"time-without-unit", "repeats-averaged", "temperature-given"}
    fit = vf.superpose(creep, "160 degC")
    assert fit.check.holds
    assert fit.quality.joint < 0.02  # decades
    law = fit.shift_factors.law("wlf")
    # J. D. Ferry, Viscoelastic Properties of Polymers, 1980, Table 11-II: C1 = 13.7, C2 = 50 K at 100 °C, at 160 °C
    # 6.2 and 110 K.
    assert abs(law.C1 - 6.2) < 2.0 * law.standard_errors[0]
    assert abs(law.C2 - 110.0) < 2.0 * law.standard_errors[1]
    assert "flow" in [getattr(note, "code", "") for note in fit.notes]
    with refused("liquid", vf.LiquidError):
        vf.fit_retardation_spectrum(fit)
