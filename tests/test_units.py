"""Quantities as people write them: one plain number and one unit, or a sentence that says what is wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import viscofric as vf
from refusals import refused
from viscofric.errors import InputError
from viscofric.units import (
    _COMMON,
    angular_frequency,
    conversion,
    in_either,
    in_si,
    kelvin_hint,
    plain,
    positive,
    registry,
    shown_celsius,
    shown_number,
    to_si,
    to_si_array,
)


@pytest.mark.parametrize(
    ("text", "unit", "number"),
    [
        ("9.525 mm", "m", 9.525e-3),
        ("9.525mm", "m", 9.525e-3),
        (" 5.  mm ", "m", 5e-3),
        ("-.5e-3 m", "m", -5e-4),
        ("−18 °C", "K", 255.15),
        ("60 ℃", "K", 333.15),
        ("68 degF", "K", 293.15),
        ("5 N/mm²", "Pa", 5e6),
        ("5 N/mm^2", "Pa", 5e6),
        ("5 N/mm**2", "Pa", 5e6),
        ("10 m·s⁻¹", "m/s", 10.0),
        ("10 m s^-1", "m/s", 10.0),
        ("10 m*s^(-1)", "m/s", 10.0),
        ("5 µm", "m", 5e-6),
        ("5 μm", "m", 5e-6),
        ("8 J/(mol K)", "J/mol/K", 8.0),
        ("3 1/s", "Hz", 3.0),
        ("51.6 delta_degC", "delta_degC", 51.6),
        ("51.6 K", "delta_degC", 51.6),
        ("0.5", "dimensionless", 0.5),
    ],
)
def test_one_number_and_one_unit_are_understood(text, unit, number):
    assert to_si(text, unit) == pytest.approx(number, rel=1e-12)  # rounding of the conversion


@pytest.mark.parametrize(("unit", "text"), [(unit, text) for unit, common in _COMMON.items() for text in common])
def test_units_that_are_read_without_pint_are_those_of_pint(unit: str, text: str) -> None:
    with_pint = registry().Quantity(12.34, text).to(unit).magnitude
    assert to_si(f"12.34 {text}", unit) == pytest.approx(with_pint, rel=4e-16)  # rounding


@pytest.mark.parametrize(
    ("text", "unit", "refusal"),
    [
        ("9,525 mm", "m", ("decimal-comma", "'9.525 mm'", "'9525 mm'")),
        ("25,5 N", "N", ("decimal-comma", "'25.5 N'")),
        (",5 N", "N", ("decimal-comma", "'0.5 N'")),
        ("5,5", "m", ("decimal-comma", "'5.5 mm'")),
        ("1,000", "m", ("decimal-comma", "'1.000 mm'", "'1000 mm'")),
        ("0,5", "dimensionless", ("decimal-comma", "'0.5'")),
        ("1 000 N", "N", ("thousands-separators", "'1000 N'")),
        ("1,000.5 N", "N", ("thousands-separators", "'1000.5 N'")),
        ("1,234,567 N", "N", ("thousands-separators", "'1234567 N'")),
        ("5 N + 3 N", "N", ("not-a-number",)),
        ("2*3 mm", "m", ("not-a-number",)),
        ("20, 200 mm/s", "m/s", ("not-a-number",)),
        ("2,5 mm/s, 10 mm/s", "m/s", ("not-a-number",)),  # '2.5 mm/s, 10 mm/s' would be refused too
        ("1_000 N", "N", ("not-a-number",)),
        ("٣ N", "N", ("not-a-number",)),
        ("mm", "m", ("no-number",)),
        ("25", "N", ("no-unit",)),
        ("5 Pas", "Pa", ("wrong-unit",)),  # no plural of pascal
        ("5 kNs", "N", ("wrong-unit",)),
        ("5 cPas", "Pa", ("wrong-unit",)),
        ("", "N", ("empty",)),
        ("1e400 N", "N", ("not-finite",)),
        ("5 foo", "N", ("unknown-unit", "'foo'")),
        ("5 kg", "N", ("wrong-unit", "'25 N'")),
        ("60 C", "K", ("wrong-unit", "'60 degC'")),
        ("140 F", "K", ("wrong-unit", "'140 degF'")),
        ("5 MPA", "Pa", ("unknown-unit", "'5 MPa'")),
        ("5 kpa", "Pa", ("unknown-unit", "'5 kPa'")),
        ("20 delta_degC", "K", ("temperature-difference",)),
        ("51.6 degC", "delta_degC", ("not-a-temperature-difference",)),
        ("17 K", "dimensionless", ("wrong-unit", "0.5")),
    ],
)
def test_what_is_not_one_number_and_one_unit_is_refused_in_one_sentence(text, unit, refusal):
    with refused(refusal[0], naming=refusal[1:]) as caught:
        to_si(text, unit, "radius")
    assert str(caught.value).startswith(f"radius = {text!r}: ")
    assert "\n" not in str(caught.value)


@pytest.mark.timeout(60)  # evaluated, each of these would take longer than the universe has
@pytest.mark.parametrize(
    "text", ["9**9**9 N", "5 (Pa**9**9**9)", "5 Pa**9**9**9", "5 ((Pa^9)^9)^9", "5 N^99", "9" * 10**5]
)
def test_text_is_never_evaluated(text):
    with pytest.raises(InputError):
        to_si(text, "N")


@pytest.mark.timeout(60)
def test_units_of_headings_are_not_evaluated_either():
    assert conversion("°C", "K") == pytest.approx((1.0, 273.15))
    assert conversion("N/mm²", "Pa") == pytest.approx((1e6, 0.0))
    for text in ("(Pa**9**9**9)", "Pa + Pa", "2 Pa", "Pa" * 30, "delta_degC"):
        with pytest.raises(InputError):
            conversion(text, "K" if "deg" in text else "Pa")


@pytest.mark.parametrize("value", [True, False, np.True_, None, [1.0], "N", object()])
def test_what_is_not_a_number_is_refused(value):
    with refused("load"):
        to_si(value, "N", "load")
    with refused("not-a-number", naming="value"):
        to_si(True, "dimensionless")


def test_temperature_differences_and_temperatures_are_kept_apart():
    quantity = registry().Quantity
    assert to_si(quantity(20.0, "degC"), "K") == pytest.approx(293.15)
    assert to_si(quantity(20.0, "delta_degC"), "delta_degC") == pytest.approx(20.0)
    with refused("temperature-difference"):
        to_si(quantity(20.0, "delta_degC"), "K")
    with refused("not-a-temperature-difference"):
        to_si(quantity(20.0, "degC"), "delta_degC")


def test_lists_arrays_and_quantities_become_arrays():
    quantity = registry().Quantity
    assert to_si_array(["1 mm", 2.0], "m") == pytest.approx([1e-3, 2.0])
    assert to_si_array("1 mm", "m") == pytest.approx([1e-3])
    assert to_si_array(quantity(np.array([20.0, 30.0]), "degC"), "K") == pytest.approx([293.15, 303.15])
    assert to_si_array(quantity(5.0, "mm"), "m") == pytest.approx([5e-3])
    with refused("wrong-unit", naming="value"):
        to_si_array(quantity(np.array([5.0]), "N"), "m")
    for wrong in ([True], None):
        with refused("not-a-number", naming="value"):
            to_si_array(wrong, "m")


def test_positive_insists():
    with refused("not-positive", naming="load = '0 N'"):
        positive("0 N", "N", "load")
    with refused("not-positive", naming="temperature = '-300 degC'"):
        positive("-300 degC", "K", "temperature")
    with refused("too-small", naming="load = 1e-300"):
        positive(1e-300, "N", "load")


def test_the_hint_to_write_degrees_comes_with_small_numbers_only():
    assert kelvin_hint(300.0).python == "."
    assert "write '60 degC'" in kelvin_hint(60.0).python
    assert kelvin_hint(60.0).shell == kelvin_hint(60.0).page == "."  # texts have their unit there


@pytest.mark.parametrize(
    ("kelvin", "form", "text"),
    [(243.15, "z.1f", "−30.0"), (273.12, "z.1f", "0.0"), (295.65, "z.4g", "22.5"), (60.0, "z.0f", "−213")],
)
def test_temperatures_in_sentences_have_true_minus_signs(kelvin, form, text):
    assert shown_celsius(kelvin, form) == text


def test_only_the_sign_of_a_number_becomes_a_minus_sign():
    assert shown_number(-1.5e-7, ".3g") == "−1.5e-07"
    assert shown_number(-0.25, "+.1%") == "−25.0%"
    assert shown_number(0.25, "+.1%") == "+25.0%"


def test_hertz_count_two_pi_radians_each():
    assert angular_frequency("10 Hz", "frequency") == pytest.approx(20.0 * math.pi, rel=1e-15)
    assert angular_frequency("2 kHz", "frequency") == pytest.approx(4000.0 * math.pi, rel=1e-15)
    assert angular_frequency("10 rad/s", "frequency") == pytest.approx(10.0, rel=1e-15)
    assert angular_frequency(10.0, "frequency") == 10.0


@pytest.mark.parametrize("wrong", ["10", "10 1/s", "10 s", "0 Hz", "-1 rad/s", "ten Hz", "10 rad"])
def test_what_is_no_frequency_is_refused(wrong):
    with refused("frequency"):
        angular_frequency(wrong, "frequency")


@pytest.mark.parametrize("as_text", [True, False])
def test_a_hertz_is_two_pi_radians_per_second_whoever_says_it(as_text: bool) -> None:
    """Pint treats the radian as a pure number, and would read one hertz as one radian per second."""
    given = str if as_text else registry().Quantity
    assert angular_frequency(given("2 kHz"), "f") == pytest.approx(4e3 * math.pi)
    assert angular_frequency(given("2 rad/s"), "f") == 2.0
    assert to_si(given("1 rad/s"), "Hz") == pytest.approx(0.5 / math.pi)
    assert to_si(given("3 Hz"), "Hz") == 3.0
    assert to_si(given("60 rpm"), "rad/s") == pytest.approx(2.0 * math.pi)
    with refused("wrong-unit"):
        angular_frequency(given("2 1/s"), "f")


@pytest.mark.parametrize("values", [["1 Hz", "10 Hz"], ("1 Hz", 20.0 * math.pi), np.array(["1 Hz", "10 Hz"])])
def test_a_column_takes_text_with_units_among_numbers(values: object) -> None:
    np.testing.assert_allclose(in_si(values, "rad/s", "omega"), [2.0 * math.pi, 20.0 * math.pi])


def test_an_array_of_xarray_is_read_in_the_unit_that_it_states() -> None:
    speeds = xr.DataArray([10.0, 100.0], attrs={"units": "mm/s"})
    assert to_si_array(speeds, "m/s") == pytest.approx([0.01, 0.1], rel=1e-15)  # one rounding
    assert to_si(speeds[1], "m/s") == pytest.approx(0.1, rel=1e-15)
    assert in_si(speeds, "m/s", "speeds") == pytest.approx([0.01, 0.1], rel=1e-15)
    assert in_either(speeds, ("Pa", "m/s"), "speeds")[1] == "m/s"
    with refused("wrong-unit", naming="speeds"):
        in_si(speeds, "Pa", "speeds")
    with refused("unknown-unit", naming="speeds"):
        to_si_array(speeds.assign_attrs(units="banana"), "m/s", "speeds")


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(12.0, 1, "10"), (9.6, 1, "10"), (99.96, 2, "100"), (-0.0961, 1, "−0.1"), (4.44, 2, "4.4"), (2e6, 2, "2e+06")],
)
def test_numbers_up_to_a_million_are_shown_without_a_power_of_ten(value: float, digits: int, text: str) -> None:
    assert plain(value, digits) == text


def test_an_array_of_xarray_without_a_unit_holds_plain_numbers() -> None:
    for attributes in ({}, {"units": "1"}, {"units": ""}):
        assert to_si_array(xr.DataArray([0.5], attrs=attributes), "m/s") == [0.5]
    missing = xr.DataArray([0.5, np.nan], attrs={"units": "m/s"})
    assert np.isnan(in_si(missing, "m/s", "slip", missing=True)[1])


def test_plain_columns_stay_as_they_are_and_wrong_units_are_refused() -> None:
    plain = np.array([1.0, np.inf])
    assert in_si(plain, "s", "time", infinite=True) is plain
    for wrong, code in ((["1 m", "2 m"], "wrong-unit"), ("1", "no-unit"), (["1 s", None], "not-a-number")):
        with refused(code):
            in_si(wrong, "s", "time")


def test_measurements_take_text_with_units() -> None:
    hertz, moduli, loss = ["1 Hz", "10 Hz"], ["1 MPa", "2 MPa"], ["0.1 MPa", "0.2 MPa"]
    omega = 2.0 * math.pi * np.array([1.0, 10.0])
    isotherm = vf.Isotherm("30 degC", hertz, moduli, loss)
    assert isotherm.storage_modulus.tolist() == [1e6, 2e6]
    master = vf.readers.MasterCurve(hertz, moduli, loss, ["30 degC"] * 2, "30 degC")
    np.testing.assert_allclose(master.angular_frequency, omega)
    table = vf.rheology.ModulusTable(["1 Hz", "10 Hz", "100 Hz", "1 kHz"], ["1 MPa", *moduli, "3 MPa"], ["0.1 MPa"] * 4)
    np.testing.assert_allclose(table.loss_modulus_values, 1e5)
    spectrum = vf.RelaxationSpectrum("1 MPa", ["9 MPa"], ["1 ms"])
    assert spectrum.E.tolist() == [9e6]
    assert spectrum.complex_modulus("1 Hz") == pytest.approx(complex(spectrum.complex_modulus(2.0 * math.pi)))
    assert float(spectrum.relaxation_modulus("1 ms")) == pytest.approx(float(spectrum.relaxation_modulus(1e-3)))
    curves = vf.FrictionCurves(["10 mm/s"], ["30 degC"], ["2 N/mm"], [0.1], [0.0], [0.0], [1], load_unit="N/m")
    assert (curves.speed[0], curves.load[0]) == (0.01, 2000.0)
    law = vf.rheology.KrausLaw("6 MPa", "1.5 MPa", 0.02, 0.6, "0.9 MPa", "0.2 MPa", "10 Hz", "60 degC")
    assert (law.critical_strain, law.storage_linear) == (0.02, 6e6)
    heights = vf.Topography([["1 um", "2 um"], ["1 um", "2 um"]], "10 um").heights
    np.testing.assert_allclose(heights, [[1e-6, 2e-6]] * 2)


@pytest.mark.filterwarnings("error")
def test_numbers_whose_cubes_overflow_are_refused_and_those_nearer_to_zero_are_zero_in_arrays_too() -> None:
    load = np.array([1.0, 1e300])
    with pytest.raises(InputError) as found:
        vf.motion.History(time=[0.0, 1.0], load=load)
    assert found.value.code == "too-large"
    with pytest.raises(InputError) as found:
        vf.readers.TractionRuns([0.1] * 2, [0.05] * 2, load, [1.0] * 2, [300.0] * 2, [1, 2])
    assert found.value.code == "too-large"
    material = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    assert to_si(-1e-320, "m/s") == 0.0
    assert vf.solve_steady(material, vf.Ball("10 mm"), speed=1e-320, load=0.1, accuracy=0.1).friction_coefficient == 0.0
    history = vf.motion.History(time=[0.0, 1e-310, 1.0], load=np.array([1.0, 1e-310, 1e100]))
    assert history.time.tolist() == [0.0, 0.0, 1.0]
    assert history.load.tolist() == [1.0, 0.0, 1e100]


@pytest.mark.filterwarnings("error")
def test_a_time_too_small_for_computations_is_the_start_of_a_history() -> None:
    material = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    dwell = vf.motion.History(time=[0.0, 1.0], load=0.1)
    run = vf.motion.solve_transient(material, vf.Ball("10 mm"), dwell, times=[5e-324, 1.0], accuracy=0.1)
    assert run.time.tolist() == [0.0, 1.0]
