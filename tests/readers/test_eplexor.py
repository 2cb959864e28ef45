"""Eplexor workbooks: sweeps as measured, and master curves taken apart into the sweeps that they were made of."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples.eplexor import SAMPLES, SHIFTS, master_tables, raw_tables, save
from readers.samples.rubber import FREQUENCIES, TEMPERATURES, points
from viscofric.readers.dma.instruments import eplexor
from viscofric.readers.dma.instruments.eplexor import isotherm_of_each_row, programmed_frequencies
from viscofric.readers.source import Source


def source(path):
    return Source(str(path), path.read_bytes())


def read(path):
    return eplexor.read(source(path))


def table(readings):
    """Return °C, Hz and Pa of each point, by temperature and frequency."""
    columns = [readings.temperature - 273.15, readings.angular_frequency / (2 * np.pi)]
    columns += [readings.storage_modulus, readings.loss_modulus]
    return np.column_stack(columns)[np.lexsort((readings.angular_frequency, np.round(readings.temperature)))]


def saved(folder, tables):
    return save(folder / "changed.xlsx", tables)


def test_planted_moduli_come_back(tmp_path):
    readings = read(SAMPLES["eplexor raw"](tmp_path))
    found, planted = table(readings), np.array(points())
    assert np.allclose(found[:, 0], planted[:, 0], rtol=0.0, atol=0.0201)  # the sample scatters by 0.02 K
    assert np.allclose(found[:, 1:], planted[:, 1:], rtol=1e-12)  # cells are doubles
    assert readings.deformation == "tension"
    assert "E'" in readings.said_by
    assert np.allclose(readings.strain_amplitude, 5e-4, rtol=1e-12)  # 0.05 %
    assert readings.places[0] == "sheet 'Exported Data', row 3"


def test_missing_number_in_a_column_that_is_not_needed_does_no_harm(tmp_path):
    tables = raw_tables()
    assert tables["Exported Data"][3][1] == "---"
    assert len(read(saved(tmp_path, tables))) == len(points())


def test_row_without_modulus_is_left_out_and_reported(tmp_path):
    tables = raw_tables()
    tables["Exported Data"][4][6] = "---"
    readings = read(saved(tmp_path, tables))
    assert len(readings) == len(points()) - 1
    assert noted(readings.notes, "points-left-out", "row 5")


def test_rows_without_modulus_may_be_most_of_the_sheet(tmp_path):
    tables = raw_tables()
    for row in tables["Exported Data"][4:]:
        row[6] = "---"
    readings = read(saved(tmp_path, tables))
    assert readings.storage_modulus.tolist() == pytest.approx([point[2] for point in points()[:2]], rel=1e-12)


def test_strain_without_a_unit_is_not_read(tmp_path):
    tables = raw_tables()
    tables["Exported Data"][1][2] = ""
    readings = read(saved(tmp_path, tables))
    assert readings.strain_amplitude is None
    assert noted(readings.notes, "strain-amplitude-not-read", "'Strain dyn'")


def test_row_without_strain_keeps_its_moduli(tmp_path):
    tables = raw_tables()
    tables["Exported Data"][2][2] = "---"
    amplitude = read(saved(tmp_path, tables)).strain_amplitude
    assert np.isnan(amplitude[0])
    assert np.all(amplitude[1:] > 0)


def test_shear_moduli_are_named_so(tmp_path):
    readings = read(saved(tmp_path, raw_tables("G")))
    assert readings.deformation == "shear"
    assert "G'" in readings.said_by


def test_master_curve_is_taken_apart_into_its_isotherms(tmp_path):
    readings = read(SAMPLES["eplexor master"](tmp_path))
    assert np.allclose(table(readings), np.array(points()), rtol=1e-12, atol=1e-10)
    assert "master curve" in readings.format
    assert noted(readings.notes, "master-curve-taken-apart", "3 isotherms")
    assert len(set(readings.step.tolist())) == 3


def test_time_decides_where_two_shifts_fit(tmp_path):
    # The coldest isotherm is shifted by three steps of the programme: its first point looks like the fourth of another.
    assert SHIFTS[TEMPERATURES[0]] == 1.5
    tables = master_tables()
    time = tables["Exported Data"][0].index("Time")
    for row in tables["Exported Data"]:
        del row[time]
    with refused("master-curve-inseparable", None, "'Time'"):
        read(saved(tmp_path, tables))


def test_frequency_that_no_shift_explains_is_refused(tmp_path):
    tables = master_tables()
    tables["Exported Data"][4][4] *= 1.2
    with refused("master-curve-inseparable", None, "row 5"):
        read(saved(tmp_path, tables))


@pytest.mark.parametrize(("lost", "reported"), [("Shiftlist", "Shiftlist"), ("Data header", "range of frequencies")])
def test_master_curve_that_cannot_be_taken_apart_is_refused(tmp_path, lost, reported):
    tables = master_tables()
    del tables[lost]
    with refused("master-curve-inseparable", None, "10.0 °C", reported):
        read(saved(tmp_path, tables))


def test_single_isotherm_is_no_master_curve(tmp_path):
    tables = raw_tables()
    for row in tables["Exported Data"][2:]:
        row[5] = 10.0
    assert read(saved(tmp_path, tables)).step is None


def test_list_may_name_isotherms_without_rows(tmp_path):
    tables = master_tables()
    tables["Shiftlist"].append([-40.0, 4.02, ""])
    assert noted(read(saved(tmp_path, tables)).notes, "temperatures-without-rows", "−40.0 °C")


@pytest.mark.parametrize(
    ("row", "column", "cell", "refusal"),
    [
        (1, 6, "N", ("wrong-unit", None, '"E\'"', "'Exported Data'", "'N'")),
        (3, 7, "low", ("not-a-number", 4, "'low'", "\"E''\"")),
    ],
)
def test_damaged_sheet_is_reported(tmp_path, row, column, cell, refusal):
    tables = raw_tables()
    tables["Exported Data"][row][column] = cell
    with refused(*refusal):
        read(saved(tmp_path, tables))


def test_loss_modulus_may_be_given_by_tan_delta(tmp_path):
    tables = raw_tables()
    tables["Exported Data"][0][7] = "loss"
    readings = read(saved(tmp_path, tables))
    assert np.allclose(table(readings)[:, 3], np.array(points())[:, 3], rtol=1e-12)
    assert noted(readings.notes, "loss-computed")


def test_damaged_list_is_reported(tmp_path):
    tables = master_tables()
    tables["Shiftlist"][4][1] = "much"
    with refused("shift-list", None, "'Shiftlist'", "row 5"):
        read(saved(tmp_path, tables))


@pytest.mark.parametrize(
    ("low", "high", "density", "expected"),
    [
        (0.1, 10.0, 2.0, FREQUENCIES),
        (0.1, 100.0, 3.0, 10.0 ** (np.arange(10) / 3 - 1)),
        (1.0, 30.0, 2.0, [1.0, 10**0.5, 10.0, 30.0]),  # the last step is cut short
        (1.0, 1.0, 2.0, None),
        (0.0, 1.0, 2.0, None),
        (1.0, "many", 2.0, None),
    ],
)
def test_programme_is_read_from_the_header(low, high, density, expected):
    header = [["", "Frequency range:", "", "Frequency increment:"], ["Values:", low, high, density]]
    found = programmed_frequencies({"Data header": header})
    if expected is None:
        assert found is None
    else:
        assert np.allclose(found, expected, rtol=1e-5)  # FREQUENCIES carry six digits


def test_table_of_any_length_is_bounded():
    with refused("too-large"):
        isotherm_of_each_row(np.ones(10_000), None, np.zeros(1000), np.ones(2), "x.xls", [])


def test_genuine_sweeps_are_read_as_printed(real_data):
    readings = read(real_data / "instruments" / "eplexor" / "freq_Eplexor_raw.xls")
    assert len(readings) == 210
    assert readings.deformation == "tension"
    assert readings.temperature[0] == pytest.approx(-49.9612 + 273.15, abs=1e-9)
    assert readings.storage_modulus[0] == pytest.approx(8097.1755453452715e6, rel=1e-12)
    assert readings.loss_modulus[0] == pytest.approx(93.0744904454984e6, rel=1e-12)
    assert readings.strain_amplitude[0] == pytest.approx(1.8433441662706006e-5, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "undone", "rows", "isotherms", "deformation"),
    [
        ("freq_Eplexor_master.xls", "adhesive_ems_ca.csv", 210, 21, "tension"),
        ("freq_Eplexor_master_shear.xls", "eva_shear.csv", 183, 19, "shear"),
    ],
)
def test_genuine_master_curves_come_apart(real_data, name, undone, rows, isotherms, deformation):
    readings = read(real_data / "instruments" / "eplexor" / name)
    assert len(readings) == rows
    assert readings.deformation == deformation
    assert np.unique(readings.temperature).size == isotherms
    independent = np.loadtxt(real_data / "dma" / undone, delimiter=",", skiprows=1)
    independent = independent[np.lexsort((independent[:, 1], np.round(independent[:, 0])))]
    found = table(readings) / [1.0, 1.0, 1e6, 1e6]
    # That table holds eight digits and nominal frequencies, the workbook frequencies of six digits.
    assert np.allclose(found, independent, rtol=3e-6, atol=1e-9)


def test_genuine_master_curve_has_the_programme_of_the_genuine_sweeps(real_data):
    # Of another specimen of the same adhesive: the same frequencies, and temperatures within some tenths of a kelvin.
    folder = real_data / "instruments" / "eplexor"
    raw, master = read(folder / "freq_Eplexor_raw.xls"), read(folder / "freq_Eplexor_master.xls")
    assert np.allclose(master.angular_frequency, raw.angular_frequency, rtol=1e-9)
    assert np.max(np.abs(master.temperature - raw.temperature)) < 0.5


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_shifts_of_whole_steps_lose_no_isotherm(tmp_path, monkeypatch, sign):
    # every row of the middle isotherm fits another one too
    for T, shift in zip(TEMPERATURES, (1.0, 0.0, -1.0), strict=True):
        monkeypatch.setitem(SHIFTS, T, shift)
    tables = master_tables()
    for row in tables["Shiftlist"][3:]:
        row[1] *= sign
    with refused("master-curve-inseparable"):
        read(saved(tmp_path, tables))


def test_shifts_of_the_other_sign_are_refused(tmp_path, monkeypatch):
    for T, shift in zip(TEMPERATURES, (-1.26, 0.0, 1.26), strict=True):
        monkeypatch.setitem(SHIFTS, T, shift)
    with refused("shift-list-contradicts", None, "'Shiftlist'"):
        read(saved(tmp_path, master_tables()))


def test_rows_go_with_their_like_not_with_the_next_in_time():
    # the third isotherm, half a step off, was measured next to the first
    frequency = 10.0 ** np.array([0.0, 1.0, 2.0, 0.5, 1.5, 2.5, 1.0, 2.0, 3.0])
    time = np.array([0.0, 10.0, 5.0, 11.0, 12.0, 13.0, 28.0, 29.0, 30.0])
    found = isotherm_of_each_row(frequency, time, np.array([0.0, 1.0, 0.5]), np.array([1.0, 10.0, 100.0]), "x", [])
    assert found.tolist() == [0, 0, 0, 2, 2, 2, 1, 1, 1]


def test_list_in_kelvin_needs_its_unit(tmp_path):
    tables = master_tables()
    for row in tables["Shiftlist"][3:]:
        row[0] += 273.15
    with refused("shift-list-contradicts", None, "283.1 °C", "10.0 °C"):
        read(saved(tmp_path, tables))
    tables["Shiftlist"][2][0] = "Temp. [K]"
    assert np.allclose(table(read(saved(tmp_path, tables))), np.array(points()), rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize("shift", [301.0, -301.0])
def test_shift_that_no_number_holds_is_refused(tmp_path, shift):
    tables = master_tables()
    tables["Shiftlist"].append([-40.0, shift, ""])
    with refused("shift-list", None, "row 7"):
        read(saved(tmp_path, tables))
