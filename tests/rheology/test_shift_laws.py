"""Shift laws: what they say about temperature, whatever reference and units they are written in."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from refusals import refused
from viscofric import WLF, Arrhenius, ShiftFactors, WLFArrhenius
from viscofric.errors import InputError
from viscofric.rheology.shifts.laws import VFT, InversePolynomial
from viscofric.rheology.shifts.vertical_shift import VerticalShiftFactors

LAWS = [
    WLF(C1=17.44, C2=51.6, reference="-18 degC"),
    Arrhenius(activation_energy="120 kJ/mol", reference="20 degC"),
    WLFArrhenius(C1=17.44, C2=51.6, glass_transition="-18 degC", reference="30 degC"),
    ShiftFactors(["0 degC", "30 degC", "60 degC", "100 degC"], [3.0, 0.5, -1.0, -2.0], "30 degC"),
    VFT(B=900.0, T0="-70 degC", reference="30 degC"),
    InversePolynomial([6e3, 2e6, 4e9], "30 degC", ("0 degC", "100 degC")),
]
by_name = pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
ROUNDING = 1e-11  # sums of terms of order ten in double precision


@by_name
def test_shift_factor_is_one_at_the_reference_and_falls_as_temperature_rises(law):
    assert law.log10(law.reference) == pytest.approx(0.0, abs=ROUNDING)
    assert law(law.reference) == pytest.approx(1.0, abs=10 * ROUNDING)
    temperatures = np.linspace(273.15, 373.15, 101)
    assert np.all(np.diff(law.log10(temperatures)) < 0)


@by_name
@given(reference=st.floats(275.0, 370.0), temperature=st.floats(275.0, 370.0))
def test_another_reference_only_moves_the_law(law, reference, temperature):
    moved = law.at_reference(reference)
    assert moved.reference == reference
    assert moved.log10(temperature) == pytest.approx(law.log10(temperature) - law.log10(reference), abs=ROUNDING)


def test_wlf_keeps_its_invariants_when_the_reference_moves():
    law = WLF(C1=17.44, C2=51.6, reference="-18 degC")
    moved = law.at_reference("20 degC")
    assert pytest.approx(law.C1 * law.C2, rel=1e-13) == moved.C1 * moved.C2
    assert moved.pole == pytest.approx(law.pole, rel=1e-13)
    assert pytest.approx((10.04, 89.6), abs=0.005) == (moved.C1, moved.C2)  # as printed, two decimals


def test_wlf_has_no_reference_below_its_pole():
    with refused("below-pole"):
        LAWS[0].at_reference("-80 degC")


def test_wlf_and_arrhenius_join_with_one_slope_at_the_glass_transition():
    law = LAWS[2]
    transition, step = law.glass_transition, 1e-4  # K: differences are then good to about 1e-6
    below = (law.log10(transition) - law.log10(transition - step)) / step
    above = (law.log10(transition + step) - law.log10(transition)) / step
    assert below == pytest.approx(above, rel=1e-5)
    assert below == pytest.approx(-law.C1 / law.C2, rel=1e-5)
    arrhenius = Arrhenius(law.activation_energy, transition)
    assert law.log10("-60 degC") - law.log10(transition) == pytest.approx(arrhenius.log10("-60 degC"), rel=1e-12)
    assert law.log10("90 degC") == pytest.approx(law.above.at_reference("30 degC").log10("90 degC"), rel=1e-12)


def test_arrhenius_slope_is_the_activation_energy():
    law = Arrhenius("120 kJ/mol", "20 degC")
    slope = law.log10(1 / (1 / 293.15 + 1e-5)) / 1e-5
    assert slope == pytest.approx(120e3 / (8.314462618 * math.log(10)), rel=1e-9)


def test_text_numbers_and_lists_mean_the_same():
    law = LAWS[0]
    assert law("30 degC") == law(303.15)
    assert law(["30 degC", "50 degC"]) == pytest.approx(law(np.array([303.15, 323.15])))
    assert isinstance(law(300.0), float)


@pytest.mark.parametrize(
    "make",
    [
        lambda: WLF(C1=-1, C2=50, reference=300),
        lambda: WLF(C1=10, C2=0, reference=300),
        lambda: WLF(C1=10, C2=50, reference="30 MPa"),
        lambda: Arrhenius("-3 kJ/mol", 300),
        lambda: ShiftFactors([300.0], [0.0], 300.0),
        lambda: ShiftFactors([300.0, 290.0], [0.0, 1.0], 300.0),
        lambda: ShiftFactors([290.0, 300.0], [1.0, np.nan], 300.0),
        lambda: ShiftFactors([290.0, 300.0], [1.0, 0.0], 310.0),
    ],
)
def test_meaningless_constants_are_refused(make):
    with pytest.raises(InputError):
        make()


def test_measured_shift_factors_are_exact_at_their_nodes():
    table = LAWS[3]
    assert table.log10(table.temperatures) == pytest.approx([2.5, 0.0, -1.5, -2.5], abs=ROUNDING)


@pytest.mark.parametrize("kind", ["wlf", "arrhenius", "wlf+arrhenius"])
def test_an_exact_table_gives_its_law_back(kind):
    law = {"wlf": LAWS[0].at_reference("30 degC"), "arrhenius": LAWS[1], "wlf+arrhenius": LAWS[2]}[kind]
    start = -60.0 if kind == "wlf+arrhenius" else 0.0
    temperatures = np.arange(start, 121.0, 10.0) + 273.15
    fitted = ShiftFactors(temperatures, law.log10(temperatures), law.reference).law(kind)
    # The fit stops at a relative change of 1e-8; the joined law has three constants and loses some digits.
    assert fitted.log10(temperatures) == pytest.approx(law.log10(temperatures), abs=1e-5)
    assert fitted.reference == law.reference


def test_law_constants_lie_within_their_standard_errors():
    truth = WLF(C1=9.0, C2=100.0, reference="30 degC")
    temperatures = np.arange(0.0, 121.0, 10.0) + 273.15
    random = np.random.default_rng(5)
    errors = np.where(temperatures == truth.reference, 0.0, 0.01)
    scores = []
    for _ in range(40):
        values = truth.log10(temperatures) + errors * random.standard_normal(temperatures.size)
        law = ShiftFactors(temperatures, values, truth.reference, np.diag(errors**2)).law("wlf")
        scores.append((np.array([law.C1, law.C2]) - [9.0, 100.0]) / law.standard_errors)
    # 40 draws: the mean square of a standard normal is 1 ± 0.22 (one sigma); three sigma allowed.  It is less, since
    # the factors cannot exclude that the law misses them by as much as their errors, which is usual.
    assert np.all(np.mean(np.square(scores), axis=0) < 1.7)
    assert np.all(np.mean(np.square(scores), axis=0) > 0.2)


@pytest.mark.parametrize("bend", [-0.04, 0.04])
def test_constants_of_a_law_that_the_residuals_bend_about_hold_those_of_other_temperatures(bend):
    """C2 changes along temperature by a few per cent: each stretch has other constants than the whole."""
    kelvin = np.arange(0.0, 151.0, 10.0) + 273.15
    away = kelvin - 303.15
    values = -9.0 * away / (100.0 + away * (1.0 + bend * np.tanh(away / 50.0)))
    walk = np.where(np.outer(away, away) > 0.0, np.minimum.outer(np.abs(away), np.abs(away)), 0.0) / 10.0
    table = ShiftFactors(kelvin, values, 303.15, 0.002**2 * walk)  # 0.002 decades from one temperature to the next
    whole = table.law("wlf")
    assert whole.standard_errors[1] > 2.0  # K; an independent scatter of the same size makes it 0.4
    colder = ShiftFactors(kelvin[:9], values[:9], 303.15, table.covariance[:9, :9]).law("wlf")
    for part in (colder, table.law("wlf", above=kelvin[5])):
        assert np.all(np.abs(whole.parameters - part.parameters) < 2.0 * np.array(whole.standard_errors))


@pytest.mark.parametrize("steps", [[-40.0, -39.0, 30.0, 60.0], [0.0, 1.0, 60.0]])
def test_errors_of_a_law_are_finite_for_few_uneven_temperatures(steps):
    """Residuals of one or two degrees of freedom hardly show any correlation along temperature."""
    kelvin = np.array(steps) + 273.15
    for covariance in (None, np.ones((len(steps), len(steps)))):
        table = ShiftFactors(
            kelvin, Arrhenius(1e5, kelvin[0]).log10(kelvin) + 1e-3 * np.sin(kelvin), kelvin[0], covariance
        )
        law = table.law("arrhenius")
        assert np.all(np.isfinite(law.covariance))
        assert np.all(law.covariance == law.covariance.T)


def test_misfit_of_a_law_widens_its_standard_errors():
    temperatures = np.arange(-60.0, 121.0, 10.0) + 273.15
    table = ShiftFactors(temperatures, LAWS[2].log10(temperatures), LAWS[2].reference, np.eye(19) * 1e-8)
    whole, part = table.law("wlf"), table.law("wlf", above="-18 degC")
    assert whole.standard_errors[1] > 100 * part.standard_errors[1]  # WLF does not hold below Tg
    assert pytest.approx((9.035, 99.6), rel=1e-3) == (part.C1, part.C2)


def test_what_no_law_describes_is_refused():
    temperatures = np.arange(0.0, 101.0, 10.0) + 273.15
    rising = ShiftFactors(temperatures, 0.01 * (temperatures - 300.0), 300.0)
    for kind in ("wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial"):
        with pytest.raises(InputError):
            rising.law(kind)


def test_uncertainty_of_wlf_constants_follows_the_reference():
    """C1' and C2' about the new reference, differentiated by central differences, off-diagonal terms and all."""
    covariance = np.array([[0.09, 0.5], [0.5, 4.0]])
    law = WLF(C1=9.0, C2=100.0, reference="30 degC", covariance=covariance)
    step = 1e-4

    def moved(C1, C2):
        there = WLF(C1, C2, law.reference).at_reference("70 degC")
        return np.array([there.C1, there.C2])

    slopes = [
        (moved(law.C1 + a, law.C2 + b) - moved(law.C1 - a, law.C2 - b)) / (2 * step) for a, b in ((step, 0), (0, step))
    ]
    jacobian = np.stack(slopes, axis=1)
    # Central differences are good to step² / C2² and to the rounding 1e-15 / step.
    assert law.at_reference("70 degC").covariance == pytest.approx(jacobian @ covariance @ jacobian.T, rel=1e-8)
    back = law.at_reference("70 degC").at_reference("30 degC")
    assert back.covariance == pytest.approx(covariance, rel=1e-12)


def test_celsius_given_as_a_plain_number_is_met_with_help():
    with refused("below-pole", naming="'60 degC'"):
        LAWS[0](60.0)


def test_standard_error_between_temperatures_is_carried_through_the_interpolation():
    covariance = np.array([[0.04, 0.0, 0.01], [0.0, 0.0, 0.0], [0.01, 0.0, 0.09]])
    table = ShiftFactors(["0 degC", "30 degC", "60 degC"], [2.5, 0.0, -1.5], "30 degC", covariance)
    assert table.standard_error(table.temperatures) == pytest.approx([0.2, 0.0, 0.3], abs=ROUNDING)
    assert table.standard_error("30 degC") == pytest.approx(0.0, abs=ROUNDING)
    half = 1.0 / (0.5 / 303.15 + 0.5 / 333.15)  # half-way in 1/T between a known and an unknown value
    assert table.standard_error(half) == pytest.approx(0.15, rel=1e-9)
    moved = table.at_reference("60 degC")
    assert moved.standard_error("0 degC") == pytest.approx(np.sqrt(0.04 + 0.09 - 2 * 0.01), rel=1e-9)
    with refused("outside-measured"):
        table.standard_error("70 degC")


def test_laws_are_equal_if_their_constants_are():
    exact = LAWS[0].at_reference("30 degC")
    temperatures = np.arange(0.0, 121.0, 10.0) + 273.15
    fitted = ShiftFactors(temperatures, exact.log10(temperatures), exact.reference).law("wlf")
    assert fitted == WLF(fitted.C1, fitted.C2, fitted.reference)
    assert fitted != WLF(fitted.C1, fitted.C2 + 1.0, fitted.reference)
    assert fitted.standard_errors[0] == pytest.approx(np.sqrt(fitted.covariance[0, 0]))
    assert WLF(9.0, 100.0, 300.0).standard_errors is None
    for kind, count in (("arrhenius", 1), ("vft", 2), ("polynomial", 2)):
        assert len(ShiftFactors(temperatures, exact.log10(temperatures), 303.15).law(kind).standard_errors) >= count


def test_half_a_kelvin_beyond_its_ends_a_table_goes_straight_on():
    table = ShiftFactors([293.15, 313.15, 333.13], [1.0, 0.0, -0.8], "40 degC")
    # What was measured at 59.98 °C answers at 60 °C; the slope there is some −0.04 decades per kelvin.
    assert -0.04 < (table.log10("60 degC") - table.log10_values[-1]) / 0.02 < -0.03
    assert table.log10(292.75) > table.log10_values[0]
    assert table.at_reference("60 degC").log10("60 degC") == pytest.approx(0.0, abs=1e-12)
    with refused("outside-measured"):
        table.log10("60.6 degC")
    vertical = VerticalShiftFactors([293.15, 333.13], [0.0, 0.02], 293.15)
    assert vertical.log10("60 degC") == pytest.approx(0.02, abs=1e-12)


def test_laws_are_written_with_constants_units_and_errors():
    law = WLF(8.956, 126.6, "20 degC", covariance=[[0.094**2, 0.0], [0.0, 1.2**2]])
    assert str(law) == "WLF: C1 = 8.956 ± 0.094, C2 = 126.6 ± 1.2 K about 20.0 °C"
    assert str(Arrhenius("120 kJ/mol", "20 degC")) == "Arrhenius: Ea = 120 kJ/mol about 20.0 °C"
    assert str(law.to_vft()) == "VFT: B = 1134 ± 16 K, T0 = −106.6 ± 1.2 °C about 20.0 °C"
    joined = WLFArrhenius(14.0, 78.0, "-18 degC", "20 degC")
    assert str(joined) == "WLF–Arrhenius: C1 = 14, C2 = 78 K, Tg = −18 °C; α = 1 at 20.0 °C"
    curve = InversePolynomial([5994.0, 2.568e6], "20 degC", (280.0, 330.0), np.diag([27.0**2, 4.9e4**2]))
    assert str(curve) == "polynomial: c1 = 5994 ± 27 K, c2 = (2.568 ± 0.049)e6 K^2 about 20.0 °C"
