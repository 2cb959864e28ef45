"""Master curves that others made, with the temperature that they hold for."""

from __future__ import annotations

import math

import numpy as np
import pytest

from readers.refusal import refused
from readers.samples.workbook import write as write_workbook
from readers.written import write
from viscofric.data import MasterCurve
from viscofric.errors import DataFileError, InputError
from viscofric.readers.dma.master_curves import read_master_curve
from viscofric.readers.dma.read import read_dma
from viscofric.study.rubber_results import write_master_curve

ROWS = ["1e-3,5,0.5", "1e3,9,0.7", "1,6,0.9"]


def test_a_text_table_is_sorted_and_carries_its_reference(tmp_path):
    curve = read_master_curve(write(tmp_path, "f,E_stor,E_loss", "Hz, MPa, MPa", *ROWS), "25 degC")
    assert curve.reference == pytest.approx(298.15)
    assert curve.angular_frequency == pytest.approx(2 * math.pi * np.array([1e-3, 1.0, 1e3]))
    assert curve.storage_modulus == pytest.approx([5e6, 6e6, 9e6])
    assert curve.loss_modulus == pytest.approx([5e5, 9e5, 7e5])
    assert curve.temperature == pytest.approx([298.15] * 3)


def test_temperatures_of_the_isotherms_are_kept_where_a_column_shows_them(tmp_path):
    lines = ["f (Hz),E' (MPa),E'' (MPa),T (°C)", *(f"{row},{T}" for row, T in zip(ROWS, (60, -20, 25), strict=True))]
    curve = read_master_curve(write(tmp_path, *lines), 298.15)
    assert curve.temperature - 273.15 == pytest.approx([60.0, 25.0, -20.0])


def test_shear_moduli_become_tensile_ones(tmp_path):
    path = write(tmp_path, "ω (rad/s),G' (MPa),G'' (MPa)", *ROWS)
    assert read_master_curve(path, 298.15).storage_modulus[0] == pytest.approx(15e6)  # 2(1 + 0.5) G
    assert read_master_curve(path, 298.15, poisson_ratio=0.4).storage_modulus[0] == pytest.approx(14e6)
    with refused("deformation-contradicts"):
        read_master_curve(path, 298.15, "tension")


def test_nothing_is_assumed_of_the_deformation(tmp_path):
    path = write(tmp_path, "f (Hz),storage modulus (MPa),loss modulus (MPa)", *ROWS)
    with pytest.raises(DataFileError, check=lambda error: error.code == "no-deformation"):
        read_master_curve(path, 298.15)
    assert read_master_curve(path, 298.15, "shear").storage_modulus[0] == pytest.approx(15e6)


def test_a_workbook_and_a_unit_that_is_given(tmp_path):
    cells = [["f (Hz)", "E'", "E''"], *([float(cell) for cell in row.split(",")] for row in ROWS)]
    path = write_workbook(tmp_path / "master.xlsx", {"25 C": cells})
    curve = read_master_curve(path, "25 degC", modulus_unit="MPa")
    assert curve.storage_modulus == pytest.approx([5e6, 6e6, 9e6])
    with refused("no-unit"):
        read_master_curve(path, "25 degC")
    two = write_workbook(tmp_path / "two.xlsx", {"A": cells, "B": cells})
    with refused("several-tables", None, "'A'", "'B'"):
        read_master_curve(two, "25 degC", modulus_unit="MPa")


def test_a_master_curve_of_reptate_holds_for_its_own_temperature(tmp_path):
    path = write(tmp_path, "T=-35;Mw=2.4;chem=PI;", " 1E0 2E3 3E4 -29.9 0 ", " 1E-1 1E3 1E4 -20.0 0 ", name="a.tts")
    curve = read_master_curve(path, "-35 degC")
    assert curve.angular_frequency == pytest.approx([0.1, 1.0])
    assert curve.storage_modulus == pytest.approx([3e3, 6e3])  # 3 G
    assert curve.temperature == pytest.approx([238.15, 238.15])
    with pytest.raises(DataFileError, check=lambda error: error.code == "other-reference"):
        read_master_curve(path, "25 degC")


def test_a_master_curve_that_a_fit_has_written_is_read_again(tmp_path):
    curve = MasterCurve([1e-3, 1.0, 1e3], [5e6, 6e6, 9e6], [0.5e6, 0.9e6, 0.7e6], [333.15, 303.15, 253.15], 303.15)
    path = write_master_curve(curve, tmp_path / "master_curve.csv")
    again = read_master_curve(path, "30 degC")
    for name in ("angular_frequency", "storage_modulus", "loss_modulus", "temperature"):
        assert getattr(again, name) == pytest.approx(getattr(curve, name), rel=1e-9)
    with pytest.raises(DataFileError, check=lambda error: error.code == "other-reference"):
        read_master_curve(path, "25 degC")
    with pytest.raises(DataFileError, check=lambda error: error.code == "master-curve"):
        read_dma(path, temperature="30 degC")


@pytest.mark.parametrize(
    "lines",
    [
        ["T = 25 °C;;", "f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "T = 50 °C;;", "f (Hz);E' (MPa);E'' (MPa)", "1;4;0.4"],
        [";25 °C;;50 °C;", "f (Hz);E' (MPa);E'' (MPa);E' (MPa);E'' (MPa)", "1;5;0.5;4;0.4", "10;6;0.6;5;0.5"],
        ["f (Hz);E' 25 °C (MPa);E'' 25 °C (MPa);E' 50 °C (MPa);E'' 50 °C (MPa)", "1;5;0.5;4;0.4", "10;6;0.6;5;0.5"],
        ["f (Hz);E' 50 °C (MPa);E'' 50 °C (MPa)", "1;5;0.5", "10;6;0.6"],
    ],
    ids=["below", "beside", "in headings", "of another temperature"],
)
def test_sweeps_of_several_temperatures_are_no_master_curve(tmp_path, lines):
    with refused("dma-sweeps"):
        read_master_curve(write(tmp_path, *lines), "25 degC")


def test_headings_of_a_master_curve_may_state_its_reference(tmp_path):
    rows = ["1;5;0.5", "10;6;0.6"]
    curve = read_master_curve(write(tmp_path, "f (Hz);E' at 25 °C (MPa);E'' at 25 °C (MPa)", *rows), "25 degC")
    assert curve.storage_modulus == pytest.approx([5e6, 6e6])


def test_master_curves_of_two_materials_below_each_other_are_refused(tmp_path):
    header = "f (Hz);E' (MPa);E'' (MPa)"
    with refused("several-tables"):
        read_master_curve(write(tmp_path, "Material A;;", header, "1;5;0.5", "Material B;;", header, "2;9;0.9"), 300.0)
    pages = read_master_curve(write(tmp_path, header, "1;5;0.5", header, "2;9;0.9"), 300.0)  # a header on each page
    assert pages.storage_modulus == pytest.approx([5e6, 9e6])


def test_sweeps_in_one_table_are_no_master_curve(tmp_path):
    head = "T (°C),f (Hz),E' (MPa),E'' (MPa)"
    sweeps = [f"{T},{f},{10 - 0.1 * T + math.log10(f)},1" for T in (0, 30, 60) for f in (1, 10, 100)]
    with refused("dma-sweeps"):
        read_master_curve(write(tmp_path, head, *sweeps), "30 degC")
    # Shift factors of whole decades bring isotherms to equal frequencies, with equal moduli.
    shifted = [
        f"{T},{f * 10 ** (1 - T / 30)},{10 + math.log10(f) - T / 30},1" for T in (0, 30, 60) for f in (1, 10, 100)
    ]
    assert len(read_master_curve(write(tmp_path, head, *shifted), "30 degC").angular_frequency) == 9


def test_a_temperature_is_not_missed_in_a_master_curve(tmp_path):
    with refused("missing-columns") as caught:
        read_master_curve(write(tmp_path, "scaled f (Hz),E' (MPa),E'' (MPa)", *ROWS), "30 degC")
    assert caught.value.note.values["missing"] == ["frequency"]


def test_sweeps_from_glass_to_plateau_are_no_master_curve(tmp_path):
    # Most neighbouring isotherms differ by less than a twentieth; those of glass and rubber by a factor of a thousand.
    head = "T (°C),f (Hz),E' (MPa),E'' (MPa)"
    levels = {-60: 2100, -50: 2050, -40: 2000, -30: 400, -20: 20, -10: 2.2, 0: 2.1, 10: 2.05, 20: 2}
    sweeps = [f"{T},{f},{level * f**0.01:.6g},1" for T, level in levels.items() for f in (1, 10, 100)]
    with refused("dma-sweeps"):
        read_master_curve(write(tmp_path, head, *sweeps), "30 degC")


@pytest.mark.parametrize(
    "line",
    ["# Tref = 60 °C", "Reference temperature: 60 °C", "Tref (°C),60", "Master curve, Tref = 60,0 C", "T0: 333.15 K"],
)
def test_a_reference_in_other_words_may_not_contradict_the_one_given(tmp_path, line):
    path = write(tmp_path, line, "f (Hz),E' (MPa),E'' (MPa)", *ROWS)
    assert read_master_curve(path, "60 degC").reference == pytest.approx(333.15)
    with refused("other-reference"):
        read_master_curve(path, "25 degC")


@pytest.mark.parametrize("minus", "-−–")
def test_a_reference_below_zero_may_have_any_minus_sign(tmp_path, minus):
    path = write(tmp_path, f"# Tref: {minus}10 °C", "f (Hz),E' (MPa),E'' (MPa)", *ROWS)
    assert read_master_curve(path, "-10 degC").reference == pytest.approx(263.15)


def test_logarithms_of_a_base_that_is_not_stated_are_refused(tmp_path):
    rows = ["-3,0.7,-0.3", "3,0.95,-0.15", "0,0.78,-0.05"]
    with refused("logarithm-unknown"):
        read_master_curve(write(tmp_path, "log f (Hz),log E' (MPa),log E'' (MPa)", *rows), "25 degC")
    curve = read_master_curve(write(tmp_path, "log10 f (Hz),lg E' (MPa),log10 E'' (MPa)", *rows), "25 degC")
    assert curve.angular_frequency == pytest.approx(2 * math.pi * np.array([1e-3, 1.0, 1e3]))
    assert curve.storage_modulus == pytest.approx(1e6 * 10.0 ** np.array([0.7, 0.78, 0.95]))


def test_reduced_frequencies_count_before_measured_ones(tmp_path):
    lines = ["reduced frequency (Hz),frequency (Hz),T (°C),E' (MPa),E'' (MPa)", "1,10,40,5,0.5", "20,10,20,6,0.6"]
    path = write(tmp_path, *lines)
    assert read_master_curve(path, "30 degC").angular_frequency == pytest.approx(2 * math.pi * np.array([1.0, 20.0]))
    assert read_dma(write(tmp_path, lines[0], "1,10,40,5,0.5", "2,20,40,6,0.6")).isotherms[0].angular_frequency == (
        pytest.approx(2 * math.pi * np.array([10.0, 20.0]))
    )


@pytest.mark.parametrize(
    "name", ["ω·aT", "aT·ω", "aT*ω", "ω a_T", "omega × aT", "ω_red", "ω_r", "Reduced angular frequency"]
)
def test_reduced_frequencies_are_known_by_their_symbols(tmp_path, name):
    path = write(tmp_path, f"{name} (rad/s),E' (MPa),E'' (MPa)", "1,5,0.5", "20,6,0.6")
    assert read_master_curve(path, "30 degC").angular_frequency == pytest.approx([1.0, 20.0])
    with refused("master-curve"):
        read_dma(path, temperature="30 degC")


@pytest.mark.parametrize(("row", "refusal"), [("1,0,1", ("not-positive", 5)), ("1,5,", ("not-positive", 5))])
def test_a_value_that_is_missing_or_not_above_zero_is_refused(tmp_path, row, refusal):
    with refused(*refusal):
        read_master_curve(write(tmp_path, "f (Hz),E' (MPa),E'' (MPa)", *ROWS, row), 298.15)


def test_arguments_that_make_no_sense_are_refused(tmp_path):
    path = write(tmp_path, "f (Hz),E' (MPa),E'' (MPa)", *ROWS)
    for wrong in ({"deformation": "torsion"}, {"poisson_ratio": 0.6}, {"modulus_unit": "mm"}):
        with pytest.raises(InputError):
            read_master_curve(path, 298.15, **wrong)
    with refused("no-number", None, "reference"):
        read_master_curve(path, "cold")


def test_a_real_master_curve(real_data):
    curve = read_master_curve(real_data / "instruments" / "two_row_csv" / "freq_user_master.csv", "25 degC")
    assert len(curve) == 206
    assert curve.angular_frequency[0] == pytest.approx(2 * math.pi * 1e-12)
    assert curve.storage_modulus[0] == pytest.approx(88.79651575665739e6)
    assert curve.loss_modulus[0] == pytest.approx(10.502460140936773e6)


def test_specimens_of_one_table_are_not_one_master_curve(tmp_path):
    rows = ["A;1;5;0.5", "A;10;6;0.6", "B;3;9;0.9"]
    with refused("several-specimens", 4, "'A' and 'B'"):
        read_master_curve(write(tmp_path, "specimen;f (Hz);E' (MPa);E'' (MPa)", *rows), 300.0)


def test_millipascals_of_a_master_curve_are_asked_for(tmp_path):
    with refused("wrong-unit", None, "'mPa'"):  # a master curve has no notes
        read_master_curve(write(tmp_path, "f (Hz);E' (mPa);E'' (mPa)", "1;5;0.5", "10;6;0.6"), 300.0)
