"""How far a fitted law may be asked: as far as it is known, and no farther than it is trusted."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from refusals import refused
from viscofric import ShiftFactors
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, WLFArrhenius

WARM = np.arange(0.0, 121.0, 10.0) + 273.15
LOW, HIGH = WARM[0], WARM[-1]


def fitted(kind="wlf", error=0.01, law=None, temperatures=WARM):
    law = law or {"arrhenius": Arrhenius("120 kJ/mol", "30 degC")}.get(kind, WLF(9.0, 100.0, "30 degC"))
    covariance = error**2 * np.eye(len(temperatures))
    return ShiftFactors(temperatures, law.log10(temperatures), law.reference, covariance).law(kind)


def test_a_well_known_law_reaches_fifty_kelvin_up_and_twenty_down():
    law = fitted()
    assert law.fitted_range == (LOW, HIGH)
    assert law.extrapolation_limits == pytest.approx((LOW - 20.0, HIGH + 50.0))
    assert np.isfinite(law.log10(HIGH + 49.9))
    assert np.isfinite(law.log10(LOW - 19.9))
    with refused("outside-fitted"):
        law.log10("180 degC")
    with refused("outside-fitted"):
        law.log10("-25 degC")
    with refused("outside-fitted"):
        law(["20 degC", "180 degC"])


def test_a_poorly_known_law_reaches_as_far_as_it_is_known_to_half_a_decade():
    law = fitted(error=0.25)
    low, _ = law.extrapolation_limits
    assert LOW - 20.0 < low < LOW
    # The uncertainty of the step from the end of the fit: that of a law with its reference there.
    doubt = 1.96 * law.unbounded().at_reference(LOW).standard_error(low)
    assert doubt == pytest.approx(0.5, rel=0.01)  # interpolated between points 0.2 K apart
    with refused("outside-fitted"):
        law.log10(low - 1.0)


@pytest.mark.parametrize("law", [fitted(error=0.25), fitted("arrhenius", temperatures=WARM[2:5:2])])
def test_limits_do_not_depend_on_the_reference(law):
    for reference in ("20 degC", "40 degC", law.extrapolation_limits[1]):
        assert law.at_reference(reference).extrapolation_limits == pytest.approx(law.extrapolation_limits, rel=1e-6)


def test_a_law_does_not_come_near_its_pole():
    law = fitted(law=WLF(9.0, 70.0, "30 degC"), error=0.001)  # the pole is 40 K below the coldest isotherm
    assert law.extrapolation_limits[0] == pytest.approx(law.pole + 30.0)
    with refused("outside-fitted"):
        law.log10(law.pole + 25.0)
    close = fitted(law=WLF(9.0, 50.0, "30 degC"), error=0.001)  # 20 K
    assert close.extrapolation_limits[0] == pytest.approx(LOW)
    assert np.isfinite(close.log10(LOW))


def test_who_knows_better_lifts_the_limit():
    law = fitted().unbounded()
    assert law.extrapolation_limits == (pytest.approx(law.pole), np.inf)
    assert law.log10("300 degC") < law.log10("170 degC")
    assert law.fitted_range == (LOW, HIGH)
    assert law.extrapolates("300 degC")
    with refused("below-pole"):
        law.log10(law.pole - 1.0)


def test_a_law_that_was_typed_in_is_bounded_by_its_pole_alone():
    law = WLF(9.0, 100.0, "30 degC")
    assert law.extrapolation_limits == (pytest.approx(203.15), np.inf)
    assert Arrhenius("120 kJ/mol", "30 degC").extrapolation_limits == (0.0, np.inf)
    assert law.log10("400 degC") < 0.0
    assert not law.extrapolates("400 degC")
    with refused("no-covariance"):
        law.standard_error("40 degC")


def test_mere_extrapolation_can_be_asked():
    law = fitted()
    asked = np.array([LOW - 5.0, LOW, 300.0, HIGH, HIGH + 5.0])
    assert law.extrapolates(asked).tolist() == [True, False, False, False, True]
    assert law.extrapolates("-5 degC") is True
    table = ShiftFactors(WARM, law.log10(WARM), 303.15)
    assert not table.extrapolates(asked[1:4]).any()


@pytest.mark.parametrize("kind", ["wlf", "vft", "arrhenius", "wlf+arrhenius", "polynomial"])
def test_bounds_survive_pickling_and_a_change_of_reference(kind):
    joined = WLFArrhenius(17.44, 51.6, "-18 degC", "30 degC")
    wide = np.arange(-60.0, 121.0, 10.0) + 273.15
    law = fitted(kind, law=joined, temperatures=wide) if kind == "wlf+arrhenius" else fitted(kind)
    again = pickle.loads(pickle.dumps(law))
    assert again == law
    assert again.extrapolation_limits == law.extrapolation_limits
    moved = law.at_reference("50 degC")
    assert moved.fitted_range == law.fitted_range
    assert moved.extrapolation_limits == pytest.approx(law.extrapolation_limits, rel=1e-6)
    assert moved.standard_error("50 degC") == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("kind", ["wlf", "vft", "arrhenius", "wlf+arrhenius", "polynomial"])
def test_uncertainty_is_that_of_the_constants_carried_on(kind):
    """The delta method against draws of the constants, small ones so that the law is linear in them."""
    joined = WLFArrhenius(17.44, 51.6, "-18 degC", "30 degC")
    wide = np.arange(-60.0, 121.0, 10.0) + 273.15
    law = fitted(kind, 1e-4, joined, wide) if kind == "wlf+arrhenius" else fitted(kind, 1e-4)
    assert law.standard_error(law.reference) == 0.0
    random = np.random.default_rng(0)
    draws = random.multivariate_normal(law.parameters, law.covariance, size=800, method="cholesky")
    asked = np.array([278.0, 320.0, 360.0, 390.0, *([220.0, 245.0] if kind == "wlf+arrhenius" else [])])
    values = np.array([law.with_parameters(draw).log10(asked) for draw in draws])
    # 800 draws tell a standard deviation to 2.5 % (one sigma).
    assert values.std(axis=0) == pytest.approx(law.standard_error(asked), rel=0.1)
    for column, step in enumerate(1e-6 * law.parameters):
        change = np.zeros(len(law.parameters))
        change[column] = step
        slope = law.with_parameters(law.parameters + change).log10(asked)
        slope = (slope - law.with_parameters(law.parameters - change).log10(asked)) / (2 * step)
        # Central differences are good to a relative 1e-6 here.
        assert law.gradient(asked)[:, column] == pytest.approx(slope, rel=1e-5, abs=1e-12)


def test_a_polynomial_is_silent_outside_its_temperatures():
    law = fitted("polynomial")
    # Half a kelvin is the difference of a nominal temperature from a measured one.
    assert law.extrapolation_limits == (LOW - 0.5, HIGH + 0.5)
    assert np.isfinite(law.log10(HIGH + 0.4))
    with refused("outside-fitted"):
        law.log10(HIGH + 0.6)
    with refused("polynomial-without-range"):
        law.unbounded()
    with refused("polynomial-without-range"):
        InversePolynomial([5e3], 303.15, None)


def test_a_polynomial_that_turns_is_refused():
    with refused("law-rises"):
        InversePolynomial([1e3, 3e6], "30 degC", ("0 degC", "120 degC"))
    # The derivative c1 + 2 c2 x has its zero at x = −1e3/6e6: between 1/T at 30 and at 46 °C.
    InversePolynomial([1e3, 3e6], "30 degC", ("0 degC", "45 degC"))
    with refused("law-rises"):
        InversePolynomial([1e3, 3e6], "30 degC", ("0 degC", "48 degC"))


def test_wlf_and_vft_turn_into_each_other_exactly():
    wlf = fitted("wlf", 0.05)
    vft = wlf.to_vft()
    assert isinstance(vft, VFT)
    assert pytest.approx((wlf.C1 * wlf.C2, wlf.reference - wlf.C2), rel=1e-14) == (vft.B, vft.T0)
    back = vft.to_wlf()
    assert pytest.approx((wlf.C1, wlf.C2), rel=1e-13) == (back.C1, back.C2)
    assert back.covariance == pytest.approx(wlf.covariance, rel=1e-9)
    asked = np.linspace(LOW, HIGH, 30)
    assert vft.log10(asked) == pytest.approx(wlf.log10(asked), abs=1e-12)
    assert vft.standard_error(asked) == pytest.approx(wlf.standard_error(asked), rel=1e-9, abs=1e-14)
    assert vft.at_reference("60 degC").log10("90 degC") == pytest.approx(
        wlf.at_reference("60 degC").log10("90 degC"), abs=1e-12
    )
    with refused("no-law"):
        WLF(50.0, 400.0, 300.0).to_vft()
