"""Text tables that are not what they seem: mixed decimals, strange files, old code pages."""

from __future__ import annotations

import math
import os
import sys

import pytest

from readers.refusal import refused
from readers.samples import workbook
from readers.written import write
from viscofric import files, read_dma, read_friction_curves
from viscofric.notes import codes
from viscofric.readers.dma.names import temperature_in_name

HEADER = "temperature (degC);frequency (Hz);tensile storage modulus (MPa);tensile loss modulus (MPa)"


@pytest.mark.parametrize(
    ("rows", "line", "cell"),
    [
        (["20;0,1;5;0,5", "20;1;1.234;0,5"], 3, "1.234"),  # a thousand, or one and a quarter?
        (["20;0.1;5;0.5", "20;1;1,23;0.5"], 2, "0.1"),
        (["20;0.1;5;0.5", "20;1;1.234,5;0.5"], 2, "0.1"),
        (["20;1;1,234.5;1", "20;2;0,123;1"], 2, "1,234.5"),  # no thousands begin with a zero
        (["20;1;1.234,5;1", "20;2;0.123;1"], 2, "1.234,5"),
        (["20;1;1.234,5;1", "20;2;1.234e-2;1"], 2, "1.234,5"),
    ],
)
def test_points_and_commas_in_one_file_are_refused(tmp_path, rows, line, cell):
    with refused("mixed-decimals", line, repr(cell)):
        read_dma(write(tmp_path, HEADER, *rows))


def test_decimal_commas_in_columns_without_a_unit_alone(tmp_path):
    heading = "speed (mm/s);temperature (degC);load (N);viscoelastic friction"
    curves = read_friction_curves(write(tmp_path, heading, "20;30;25;0,02", "40;30;25;0,0175"))
    assert curves.viscoelastic.tolist() == [0.02, 0.0175]


def test_quoted_cells_may_have_decimal_commas_between_commas(tmp_path):
    rows = ['"20","0,1","5,5","0,5"', '"20","1,0","6,5","0,5"']
    sweeps = read_dma(write(tmp_path, HEADER.replace(";", ","), *rows))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])
    with refused("ambiguous-decimals", 2, "'5,500'"):
        read_dma(write(tmp_path, HEADER.replace(";", ","), '"20","1","5,500","0"'))


def test_headings_may_be_wrapped(tmp_path):
    cells = HEADER.replace("frequency ", "frequency\n").replace(" storage ", "\nstorage\n").split(";")
    header = ";".join(f'"{cell}"' for cell in cells)
    sweeps = read_dma(write(tmp_path, header, "20;0,1;5,5;0,5", "20;1;6,5;0,5"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])
    book = {"a": [cells, [20, 0.1, 5.5, 0.5], [20, 1, 6.5, 0.5]]}
    assert len(read_dma(workbook.write(tmp_path / "a.xlsx", book)).isotherms[0]) == 2
    with refused("not-a-number", 2 + header.count("\n"), "'x'"):  # lines are counted as they are in the file
        read_dma(write(tmp_path, header, "20;x;5,5;0,5"))
    sweeps = read_dma(write(tmp_path, "T (°C);f (Hz);E' (MPa);E\" (MPa)", '20;1;5;"0,5"', "20;2;6;0,5"))  # no quotation
    assert len(sweeps.isotherms[0]) == 2


@pytest.mark.parametrize("sign", ["-", "−"])
@pytest.mark.parametrize("degree", ["°C", "ºC", "˚C", "℃"])
def test_signs_that_look_alike_are_the_same(tmp_path, sign, degree):
    header = HEADER.replace("(degC)", f"({degree})")
    sweeps = read_dma(write(tmp_path, header, f"{sign}20;0.1;5.5;0.5", f"{sign}20;1;6.5;0.5"))
    assert sweeps.temperatures == pytest.approx([253.15])


@pytest.mark.parametrize("line", ["sep=;", '"sep=;"', "SEP=;"])
def test_a_line_that_shows_excel_the_delimiter_is_no_header(tmp_path, line):
    sweeps = read_dma(write(tmp_path, line, HEADER, "20;0,1;5,5;0,5", "20;1;6,5;0,5"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


@pytest.mark.parametrize("mark", ["#", "# ", "%", "% ", "// ", "! "])
@pytest.mark.parametrize("end", ["End of data", "*** Ende ***", "[EOF]", "// ---"])
def test_lines_under_a_mark_of_remarks_and_the_end_of_data_are_no_rows(tmp_path, mark, end):
    rows = ["20;1;5.5;0.5", f"{mark}cooled", "20;2;6.5;0.5", end]
    for head in (HEADER, mark + HEADER):
        sweeps = read_dma(write(tmp_path, f"{mark}film of NR", head, *rows))
        assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


def test_points_in_columns_that_are_not_read_contradict_no_commas(tmp_path):
    sweeps = read_dma(write(tmp_path, HEADER + ";sample;t (s)", "20;1;5,5;0,5;1.1;2.5", "20;2;6,5;0,5;1.2;3.5"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


@pytest.mark.parametrize(("cell", "number"), [("1.234,5", 1234.5), ("1,234.5", 1234.5), ("12.345.678", 12345678.0)])
def test_numbers_of_a_workbook_are_what_they_are_beside_any_text(tmp_path, cell, number):
    rows = [HEADER.split(";"), [20, 1, cell, 1.234], [20, 2, cell, 2.345]]
    sweeps = read_dma(workbook.write(tmp_path / "sweep.xlsx", {"sheet": rows}))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx(2 * [1e6 * number])
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([1.234e6, 2.345e6])


@pytest.mark.parametrize("first", ["End", "Fin", "%RH", "% elongation", "!", "# cycles"])
@pytest.mark.parametrize("delimiter", [";", "\t", "xlsx"])
def test_headings_and_flags_that_begin_as_remarks_do_are_of_the_table(tmp_path, first, delimiter):
    rows = [["", first, *HEADER.split(";")], ["", "!bad", 20, 1, 5.5, 0.5], ["", "", 20, 2, 6.5, 0.5]]
    if delimiter == "xlsx":
        path = workbook.write(tmp_path / "sweep.xlsx", {"sheet": rows})
    else:
        path = write(tmp_path, *(delimiter.join(map(str, row)).lstrip(delimiter) for row in rows[:2]))
    assert read_dma(path).isotherms[0].storage_modulus[0] == pytest.approx(5.5e6)


def test_units_that_blanks_part_may_begin_with_per_cent(tmp_path):
    path = write(tmp_path, "strain T f E' E''", "% °C Hz MPa MPa", "0.1 20 1 5.5 0.5", "0.1 20 2 6.5 0.5")
    assert read_dma(path).isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


@pytest.mark.parametrize("last", ["End of data; 12 points", "Operator: AB"])
def test_other_words_below_a_table_are_refused(tmp_path, last):
    with refused("row-length", 4):
        read_dma(write(tmp_path, HEADER, "20;1;5.5;0.5", "20;2;6.5;0.5", last))


@pytest.mark.parametrize(("heading", "unit"), [("% strain", ""), ("strain", "%")])
@pytest.mark.parametrize("delimiter", [";", "\t", ",", "xlsx"])
def test_a_row_that_begins_with_per_cent_is_no_remark(tmp_path, heading, unit, delimiter):
    rows = [
        [heading, "T", "f", "E'", "E''"],
        [unit, "°C", "Hz", "MPa", "MPa"],
        [0.1, 20, 1, 5.5, 0.5],
        [0.1, 20, 2, 6.5, 0.5],
    ]
    if delimiter == "xlsx":
        path = workbook.write(tmp_path / "sweep.xlsx", {"sheet": rows})
    else:
        path = write(tmp_path, *(delimiter.join(map(str, row)) for row in rows))
    assert read_dma(path).isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


@pytest.mark.parametrize(
    ("name", "kelvin"),
    [
        *(("0 - 5 °C", None), ("NR 10 – 15 °C", None), ("T = 0 to 5 °C", None), ("Sweep 3 - 25 °C", 298.15)),
        *(("NR60 - 25 °C", 298.15), ("SBR 1500 - 25 °C", 298.15), ("T = - 25 °C", 248.15), ("NR - 25 °C", 298.15)),
        *(("-40 - -5 °C", None), ("-40 to -20 °C", None), ("Test 23 ± 2 °C", None), ("NR 23 +/- 2 °C", None)),
        *(("between 10 and 25 °C", None), ("#3 - 25 °C", 298.15), ("Film #3 - 25 °C", 298.15)),
        *(("Measurement 3 - 25 °C", 298.15), ("Test 4 - -25 °C", 248.15), ("T -5 °C", 268.15)),
        *(("10:30 - 25 °C", 298.15), ("2020-01-02 - 25 °C", 298.15), ("Batch 12 - 25 °C", 298.15)),
    ],
)
def test_the_end_of_a_range_is_no_temperature(name, kelvin):
    assert temperature_in_name(name) == pytest.approx(kelvin)


@pytest.mark.parametrize("heading", ["E' / 10^6 Pa", "E' in 10⁶ Pa", "E', 10^6 Pa", "E' (10^6 Pa)", "E' 10**6 Pa"])
def test_a_power_of_ten_before_a_unit_belongs_to_it(tmp_path, heading):
    sweeps = read_dma(write(tmp_path, f"T_C;f_Hz;{heading};tan δ", "20;1;5.5;0.5", "20;2;6.5;0.5"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


def test_quoted_headings_may_be_parted_by_single_blanks(tmp_path):
    head = """"T (°C)" "f (Hz)" "storage modulus E' (MPa)" "tan δ" """
    sweeps = read_dma(write(tmp_path, head, "20 1 5.5 0.5", "20 2 6.5 0.5"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


def test_words_may_stand_behind_numbers_parted_by_blanks(tmp_path):
    head = "T (°C)  f (Hz)  E' (MPa)  E'' (MPa)  remark"
    sweeps = read_dma(write(tmp_path, head, "20  1  5.5  0.5  good", "20  2  6.5  0.5  good"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


@pytest.mark.parametrize("unit", ["log Hz", "log10 Hz", "lg(Hz)"])
@pytest.mark.parametrize("in_row", [True, False])
def test_a_unit_may_be_that_of_a_logarithm(tmp_path, unit, in_row):
    head = ["T;f;E';E''", f"°C;{unit};MPa;MPa"] if in_row else [f"T (°C);f [{unit}];E' (MPa);E'' (MPa)"]
    sweeps = read_dma(write(tmp_path, *head, "20;0;5.5;0.5", "20;1;6.5;0.5"))
    assert sweeps.isotherms[0].angular_frequency == pytest.approx([2 * math.pi, 20 * math.pi])
    assert ("decadic-logarithms" in codes(sweeps.notes)) == unit.startswith("log ")


def test_a_comma_in_a_remark_is_no_decimal_comma(tmp_path):
    sweeps = read_dma(write(tmp_path, HEADER + ";remark", "20;0.1;5.5;0.5;1,2", "20;1;6.5;0.5;"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5.5e6, 6.5e6])


def test_primes_of_the_windows_code_page_are_read(tmp_path):
    header = "T (°C);f (Hz);E’ (MPa);E” (MPa)"
    sweeps = read_dma(write(tmp_path, header, "20;1;5;0.5", "20;2;6;0.5", encoding="cp1252"))
    assert sweeps.deformation == "tension"
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([5e5, 5e5])


def test_a_monstrous_cell_is_refused(tmp_path):
    with refused("row-length", 2) as caught:
        read_dma(write(tmp_path, HEADER, "2" * 140_000 + ";1;5;0.5"))
    assert len(str(caught.value)) < 500


def test_a_name_that_no_file_can_have_is_refused():
    with refused("not-a-name"):
        read_dma("sweeps\0.csv")


@pytest.mark.timeout(60)  # read, they would never end
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")
def test_devices_and_pipes_are_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in ("/dev/zero", tmp_path / "pipe"):
        with refused("not-a-file"):
            read_dma(path)


def test_a_file_too_large_for_measurements_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "LARGEST_TABLE", 10)
    with refused("too-large"):
        read_dma(write(tmp_path, HEADER, "20;1;5;0.5"))


@pytest.mark.parametrize("label", ["Mean", "Std. dev.", "Mittelwert", "SD (n = 3)"])
def test_summaries_below_measurements_are_refused(tmp_path, label):
    heading = "specimen;speed (mm/s);temperature (degC);load (N);viscoelastic friction"
    rows = ["A;20;30;25;0.02", "B;20;30;25;0.03", f"{label};20;30;25;0.007"]
    with refused("summary-row", 4, repr(label)):
        read_friction_curves(write(tmp_path, heading, *rows))
    with refused("summary-row", 3, repr(label)):
        read_dma(write(tmp_path, f"{HEADER};", "20;0.1;5;0.5;A", f"20;0.1;5;0.5;{label}"))


def test_of_means_and_their_scatter_the_scatter_is_refused(tmp_path):
    heading = "row;speed (mm/s);temperature (degC);load (N);viscoelastic friction"
    with refused("summary-row", 3, "'Std'"):
        read_friction_curves(write(tmp_path, heading, "Mean;20;30;25;0.02", "Std;20;30;25;0.001"))


def test_rows_that_are_all_means_are_measurements(tmp_path):
    heading = "row;speed (mm/s);temperature (degC);load (N);viscoelastic friction"
    curves = read_friction_curves(write(tmp_path, heading, "mean;20;30;25;0.02", "Mean;40;30;25;0.0175"))
    assert curves.viscoelastic.tolist() == [0.02, 0.0175]


def test_cells_in_per_cent_are_read_in_columns_of_ratios_alone(tmp_path):
    heading = "speed (mm/s);temperature (degC);load (N);viscoelastic friction"
    assert read_friction_curves(write(tmp_path, heading, "20;30;25;3,1 %")).viscoelastic == pytest.approx([0.031])
    with refused("not-a-number", 2, "'25 %'"):
        read_friction_curves(write(tmp_path, heading, "20;30;25 %;0.02"))
    with refused("ambiguous-decimals", 2, "'3,125 %'"):
        read_friction_curves(write(tmp_path, heading, "20;30;25;3,125 %"))
