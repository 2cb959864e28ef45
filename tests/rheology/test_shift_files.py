"""Shift factors in files: what is saved comes back, other programs' tables are read, signs are not guessed."""

from __future__ import annotations

import numpy as np
import pytest

from readers.samples import eplexor, workbook
from refusals import refused
from viscofric.errors import DataFileError
from viscofric.notes import codes
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_files import read_shift_factors, read_vendor_law

CELSIUS = np.array([-20.0, 0.0, 20.0, 40.0])
LOG10 = np.array([4.0, 1.5, 0.0, -1.0])


def written(folder, text, name="shifts.csv", encoding="utf-8"):
    path = folder / name
    path.write_bytes(text.encode(encoding))
    return path


def table(header, scale=LOG10, temperatures=CELSIUS, mark=","):
    rows = [f"{T!r}{mark}{value!r}" for T, value in zip(map(float, temperatures), map(float, scale), strict=True)]
    return "\n".join([header, *rows]) + "\n"


def test_columns_that_are_not_read_are_named(tmp_path):
    path = written(tmp_path, "T (degC),log aT,log bT,std\n0,1.5,0.01,0.1\n20,0,0,0.1\n40,-1,-0.01,0.1\n")
    (note,) = (one for one in read_shift_factors(path).notes if one.code == "unused-columns")
    assert note.values == {"headings": ["log bT", "std"]}
    saved = tmp_path / "saved.csv"
    ShiftFactors(CELSIUS + 273.15, LOG10, 293.15, 0.01 * np.eye(4)).save(saved)
    assert "unused-columns" not in codes(read_shift_factors(saved).notes)


@pytest.mark.parametrize(("heading", "rows"), [("aT", ("100,10", "1,0")), ("ln aT", ("4.60517,0.1", "0,0"))])
def test_standard_errors_are_those_of_their_column(tmp_path, heading, rows):
    """An error of 10 % of α is 0.043 decades; it was read as 10, or 0.1, decades."""
    path = written(tmp_path, f"T (degC),{heading},standard error\n0,{rows[0]}\n20,{rows[1]}\n")
    found = read_shift_factors(path)
    assert found.standard_errors == pytest.approx([0.1 / np.log(10.0), 0.0])
    assert "errors-of-column" in codes(found.notes)


@pytest.mark.parametrize(("unit", "value"), [("decades", 0.05), ("log10", 0.05), ("%", 5.0 * np.log(10.0))])
def test_standard_errors_have_the_unit_of_their_heading(tmp_path, unit, value):
    path = written(tmp_path, f"T (degC),aT,standard error ({unit})\n0,100,{value}\n20,1,0\n")
    found = read_shift_factors(path)
    assert found.standard_errors == pytest.approx([0.05, 0.0])
    assert "errors-of-column" not in codes(found.notes)


@pytest.mark.parametrize("reference", [283.15, 293.15, 288.6180339887])
def test_saved_factors_come_back_with_their_covariance(tmp_path, reference):
    rng = np.random.default_rng(1)
    kelvin = 273.15 + np.sort(rng.uniform(-60.0, 90.0, 12))
    kelvin[[0, -1]] = 200.1, 371.7
    root = rng.normal(size=(12, 12))
    saved = ShiftFactors(kelvin, np.sort(rng.normal(0.0, 5.0, 12))[::-1], reference, 1e-3 * root @ root.T)
    saved.save(tmp_path / "saved.csv")
    found = read_shift_factors(tmp_path / "saved.csv")
    # Values are moved by what rounding leaves at the reference; all else is exact.
    assert np.allclose(found.log10_values, saved.log10_values, rtol=0.0, atol=1e-14)
    assert np.array_equal(found.temperatures, saved.temperatures)
    assert found.reference == saved.reference
    assert np.array_equal(found.covariance, saved.covariance)


def test_notes_are_saved_with_the_factors(tmp_path):
    notes = ("The shift factor at 20.0 °C was corrected by hand.", "reference (degC): 3 is no reference here.")
    ShiftFactors(CELSIUS + 273.15, LOG10, 293.15, notes=notes).save(tmp_path / "saved.csv")
    found = read_shift_factors(tmp_path / "saved.csv")
    assert found.notes == notes
    assert found.reference == 293.15


def test_table_without_uncertainty_is_reported(tmp_path):
    assert "factors-exact" in codes(read_shift_factors(written(tmp_path, table("T_C,aT", 10**LOG10))).notes)


def test_saved_file_is_readable_text(tmp_path):
    factors = ShiftFactors(CELSIUS + 273.15, LOG10, 293.15, np.diag([0.04, 0.01, 0.0, 0.09]))
    factors.save(tmp_path / "saved.csv")
    lines = (tmp_path / "saved.csv").read_text(encoding="utf-8").splitlines()
    assert lines[:2] == ["# viscofric shift factors", "# reference (degC): 20.0"]
    assert lines[2] == "temperature (degC),log10 shift factor,standard error,cov 1,cov 2,cov 3,cov 4"
    assert lines[3] == "-20.0,4.0,0.2,0.04,0.0,0.0,0.0"


@pytest.mark.parametrize(
    ("header", "scale"),
    [
        ("T_C,log10_aT", LOG10),
        ("T,log_aT\nC,-", LOG10),
        ("T,log_aT\n°C,", LOG10),
        ("T (degC),log aT", LOG10),
        ("Temperature [°C],log10(aT)", LOG10),
        ("T_C,lg a(T)", LOG10),
        ("T_C,ln aT", LOG10 * np.log(10.0)),
        ("T_C,aT", 10.0**LOG10),
        ("T_C,alpha (-)", 10.0**LOG10),
        ("# Tref 99 C\nT_C,log_a_T", LOG10),
        ("T_C,a_T", 10.0**LOG10),
        ("T_C,a(T)", 10.0**LOG10),
        ("T_C,alpha_T (-)", 10.0**LOG10),
        ("T_C,α(T)", 10.0**LOG10),
        ("T_C,shift.factor", 10.0**LOG10),
        ("T_C,lgaT", LOG10),
        ("T_C,lnaT", LOG10 * np.log(10.0)),
        ("T_C,ln(a_T)", LOG10 * np.log(10.0)),
        ("T_C,log10(a(T))", LOG10),
        ("T_C,log_10[aT] (-)", LOG10),
        ("T,log10(aT)\n°C,-", LOG10),
        ("T,log10(a(T)) (-)\n°C,-", LOG10),
        ("T,a(T)\nC,", 10.0**LOG10),
    ],
)
@pytest.mark.parametrize("mark", [",", "\t"])
def test_tables_of_other_programs_are_read(tmp_path, header, scale, mark):
    path = written(tmp_path, table(header.replace(",", mark), scale, mark=mark), encoding="utf-8-sig")
    found = read_shift_factors(path)
    assert np.allclose(found.temperatures, CELSIUS + 273.15, rtol=1e-14)
    assert np.allclose(found.log10_values, LOG10, rtol=0.0, atol=1e-12)  # of a logarithm of a power
    assert found.reference == pytest.approx(293.15, abs=1e-9)
    assert not found.covariance.any()


@pytest.mark.parametrize("other", ["log10(bT)", "log(f)", "log10(E')", "ln(x) (-)", "bT"])
def test_logarithms_of_other_quantities_are_ignored(tmp_path, other):
    for heads in (f"log10(aT),{other}", f"{other},log10(aT)"):
        values = np.stack([LOG10, LOG10**2][:: 1 if heads.startswith("log10(aT)") else -1], axis=1)
        rows = [f"{T},{one},{two}" for T, (one, two) in zip(CELSIUS, values, strict=True)]
        found = read_shift_factors(written(tmp_path, "\n".join([f"T_C,{heads}", *rows])))
        assert found.log10_values.tolist() == LOG10.tolist()


@pytest.mark.parametrize(
    ("comment", "celsius"),
    [
        ("# The reference (degC): 40", 40.0),
        ("# of the fit, reference (C): 0.0 ", 0.0),
        ("#reference (K): 313.15", 40.0),
        ("# preference (degC): 40", 20.0),
    ],
)
def test_reference_in_a_comment_is_read(tmp_path, comment, celsius):
    found = read_shift_factors(written(tmp_path, table(f"{comment}\nT_C,log10_aT")))
    assert found.reference == pytest.approx(celsius + 273.15, abs=1e-9)


@pytest.mark.parametrize(("unit", "printed"), [("K", CELSIUS + 273.15), ("F", CELSIUS * 1.8 + 32.0)])
def test_unit_of_temperature_is_heeded(tmp_path, unit, printed):
    found = read_shift_factors(written(tmp_path, table(f"T_{unit},log10_aT", temperatures=printed)))
    assert np.allclose(found.temperatures, CELSIUS + 273.15, rtol=1e-12)


def test_decimal_comma_is_read(tmp_path):
    text = table("T_C;log10_aT", mark=";").replace(".", ",")
    assert read_shift_factors(written(tmp_path, text)).log10_values.tolist() == LOG10.tolist()


def test_descending_temperatures_are_sorted_with_their_covariance(tmp_path):
    ascending = table("T_C,log10_aT,standard error").splitlines()
    rows = [f"{row},{0.1 * place:g}" for place, row in enumerate(ascending[1:])]
    up = read_shift_factors(written(tmp_path, "\n".join([ascending[0], *rows])))
    down = read_shift_factors(written(tmp_path, "\n".join([ascending[0], *rows[::-1]])))
    assert np.array_equal(up.temperatures, down.temperatures)
    assert np.array_equal(up.log10_values, down.log10_values)
    assert np.allclose(up.standard_errors, [0.0, 0.1, 0.2, 0.3], rtol=1e-12)
    assert np.array_equal(up.covariance, down.covariance)


def test_columns_of_covariance_follow_their_rows(tmp_path):
    covariance = np.array([[4.0, 1.0, 0.5], [1.0, 9.0, 2.0], [0.5, 2.0, 16.0]])
    factors = ShiftFactors([260.0, 280.0, 300.0], [3.0, 1.0, 0.0], 300.0, covariance)
    factors.save(tmp_path / "saved.csv")
    lines = (tmp_path / "saved.csv").read_text(encoding="utf-8").splitlines()
    # Rows turned round, with the columns of covariance numbered as the rows now stand.
    turned = [line.split(",") for line in lines[:2:-1]]
    text = [*lines[:3], *(",".join([*cells[:3], *cells[:2:-1]]) for cells in turned)]
    found = read_shift_factors(written(tmp_path, "\n".join(text)))
    assert np.array_equal(found.covariance, covariance)


def test_reference_is_found_between_rows(tmp_path):
    found = read_shift_factors(written(tmp_path, table("T_C,log10_aT", LOG10 - 0.7)))
    assert 273.15 < found.reference < 293.15
    assert "reference-interpolated" in codes(found.notes)
    # The table keeps its values: the zero of the very interpolation that reads it is the reference.
    assert np.allclose(found.log10_values, LOG10 - 0.7, rtol=0.0, atol=1e-9)


def test_reference_can_be_chosen(tmp_path):
    path = written(tmp_path, table("T_C,log10_aT"))
    found = read_shift_factors(path, "0 degC")
    assert found.reference == 273.15
    assert np.allclose(found.log10_values, LOG10 - 1.5, rtol=0.0, atol=1e-14)


def test_table_without_zero_is_read_with_a_reference(tmp_path):
    path = written(tmp_path, table("T_C,log10_aT", LOG10 + 2.0))
    assert np.allclose(read_shift_factors(path, 293.15).log10_values, LOG10, rtol=0.0, atol=1e-14)


def test_reference_outside_the_table_is_refused(tmp_path):
    with refused("outside-measured"):
        read_shift_factors(written(tmp_path, table("T_C,log10_aT")), "90 degC")


def test_rising_table_may_be_said_to_be_inverse(tmp_path):
    path = written(tmp_path, table("T_C,log10_aT", -LOG10))
    assert np.array_equal(read_shift_factors(path, inverse=True).log10_values, LOG10)
    with refused("factors-fall", DataFileError):
        read_shift_factors(written(tmp_path, table("T_C,log10_aT")), inverse=True)


@pytest.mark.parametrize(
    ("text", "refusal"),
    [
        ("", ("empty",)),
        ("T_C,log10_aT\n", ("no-points",)),
        ("T_C,log10(f)\n1,2\n3,0\n", ("missing-columns", "'log10(f)'", "'log10 aT'")),
        ("T_C,log_aT\n1,2\n3,zero\n", ("not-a-number", "line 3", "'zero'", "'log_aT'")),
        ("T_C,log_aT\n1,2\n3,nan\n", ("not-a-number", "line 3", "'nan'")),
        ("T_C,log_aT\n1,0\n", ("wrong-length",)),
        ("T_C,log_aT\n-300,1\n1,0\n", ("wrong-length",)),
        ("T_C,log_aT\n1,1e200\n2,0\n", ("out-of-range", "line 2", "300")),
        ("# reference (degC): 80\nT_C,log_aT\n1,1\n2,0\n", ("no-reference",)),
        ("# reference (degC): -\nT_C,log_aT\n1,1\n2,0\n", ("no-reference", "line 1")),
        ("# by hand\n# reference (furlong): 1\nT_C,log_aT\n1,1\n2,0\n", ("no-reference", "line 2")),
    ],
)
def test_damaged_tables_are_reported(tmp_path, text, refusal):
    with refused(refusal[0], DataFileError, naming=refusal[1:]):
        read_shift_factors(written(tmp_path, text))


def test_file_that_cannot_be_written_is_reported(tmp_path):
    factors = ShiftFactors(CELSIUS + 273.15, LOG10, 293.15)
    with refused("not-written", DataFileError):
        factors.save(tmp_path / "nowhere" / "saved.csv")


@pytest.mark.slow
def test_list_of_a_workbook_is_read(tmp_path):
    path = eplexor.SAMPLES["eplexor master"](tmp_path)
    found = read_shift_factors(path)
    assert found.temperatures.tolist() == [263.15, 283.15, 303.15]
    assert found.log10_values.tolist() == [1.5, 0.0, -1.26]
    assert found.reference == 283.15
    law = read_vendor_law(path)
    assert (law.C1, law.C2, law.reference) == (8.0, 100.0, 283.15)


def test_workbook_without_a_list_is_refused(tmp_path):
    path = eplexor.SAMPLES["eplexor raw"](tmp_path)
    with refused("no-shift-list", DataFileError):
        read_shift_factors(path)
    with refused("no-shift-list", DataFileError):
        read_vendor_law(path)


def test_genuine_workbook_agrees_with_its_table(real_data):
    workbook = real_data / "instruments" / "eplexor" / "freq_Eplexor_master.xls"
    found = read_shift_factors(workbook)
    listed = read_shift_factors(real_data / "dma" / "adhesive_ems_ca__vendor_shift.csv")
    assert np.allclose(found.temperatures, listed.temperatures, rtol=0.0, atol=1e-3)  # six digits
    assert np.allclose(found.log10_values, listed.log10_values, rtol=0.0, atol=1e-12)
    assert found.reference == pytest.approx(24.97374 + 273.15, abs=1e-9)
    assert found.log10_values[0] == pytest.approx(15.6, abs=1e-12)
    law = read_vendor_law(workbook)
    assert (law.C1, law.C2, law.reference) == (13.5, 141.19, 298.15)
    # The vendor's own fit, where it was made: above the reference it keeps to its table.
    warm = found.temperatures > law.reference
    assert np.max(np.abs(law.log10(found.temperatures[warm]) - found.log10_values[warm])) < 1.0


@pytest.mark.parametrize(
    ("name", "rows", "reference", "coldest"),
    [
        ("dma/eva_shear__vendor_shift.csv", 23, -30.004, 11.76),
        ("instruments/two_row_csv/freq_user_master__shift_factors.csv", 21, -5.0, 12.75),
        ("instruments/two_row_csv/time_user_raw__shift_factors.csv", 21, 3.0, 12.341761942568635),
    ],
)
def test_genuine_tables_are_read(real_data, name, rows, reference, coldest):
    found = read_shift_factors(real_data / name)
    assert found.temperatures.size == rows
    assert found.reference == pytest.approx(reference + 273.15, abs=1e-9)
    assert found.log10_values[0] == pytest.approx(coldest, abs=1e-12)


@pytest.mark.parametrize(("name", "values"), [("log10_shift_factor", LOG10), ("shift_factor", 10.0**LOG10)])
def test_columns_of_factors_are_named(tmp_path, name, values):
    path = written(tmp_path, "fit of\n" + table("Ofen;v2", values, mark=";"))
    with refused("missing-columns", DataFileError) as caught:
        read_shift_factors(written(tmp_path, table("Ofen;v2", values, mark=";"), "plain.csv"))
    assert caught.value.field == "material.shift_factor_columns"
    found = read_shift_factors(path, columns={"temperature": "ofen (degC)", name: "#2"})
    assert np.allclose(found.log10_values, LOG10, rtol=0.0, atol=1e-13)
    assert found.temperatures.tolist() == (CELSIUS + 273.15).tolist()
    with refused("unknown-quantity"):
        read_shift_factors(path, columns={"colour": "red"})


def test_factors_of_a_workbook_have_standard_errors(tmp_path):
    rows = [["T (degC)", "log10 aT", "standard error"], *([T, one, 0.1] for T, one in zip(CELSIUS, LOG10, strict=True))]
    path = workbook.write(tmp_path / "factors.xlsx", {"Notes": [["synthetic"]], "aT": rows})
    for found in (read_shift_factors(path), read_shift_factors(path, sheet="aT")):
        assert found.log10_values.tolist() == LOG10.tolist()
        assert np.allclose(found.covariance, 0.01 * np.eye(4), rtol=1e-14, atol=0.0)
