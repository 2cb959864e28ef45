"""Excel workbooks: read like text tables, and hostile ones refused before they take memory or time."""

from __future__ import annotations

import io
import sys
import time
import zipfile

import pytest

from readers.failing_parsers import dying, endless
from readers.refusal import noted, refused
from readers.samples.workbook import HEADER, one_sheet, rows, write
from viscofric import read_dma, read_friction_curves
from viscofric.errors import DataFileError
from viscofric.processes import LimitedProcess
from viscofric.readers import parse_workbook, workbook
from viscofric.readers.source import Source

POINTS = [[20, 1, 5, 0.5], [20, 10, 6, 0.7]]


def opened(path):
    return Source(str(path), path.read_bytes())


def changed(path, part, replace):
    """Write a workbook anew with one part of its archive changed."""
    old, new = zipfile.ZipFile(path), io.BytesIO()
    with zipfile.ZipFile(new, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in old.namelist():
            data = old.read(name)
            archive.writestr(name, replace(data) if name == part else data)
    old.close()
    path.write_bytes(new.getvalue())
    return path


def test_the_sheet_with_moduli_is_found(tmp_path):
    sweeps = read_dma(one_sheet(tmp_path))
    assert len(sweeps) == 3
    assert sweeps.format == "Excel workbook"
    assert sweeps.deformation == "tension"


def test_names_and_units_may_stand_in_two_rows_below_a_title(tmp_path):
    sheet = [["Sweeps of a synthetic rubber"], [], ["T", "f", "E'", "E''"], ["°C", "Hz", "MPa", "MPa"], *POINTS]
    sweeps = read_dma(write(tmp_path / "a.xlsx", {"DMA": sheet}))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6])


RHEOMETER = ["Temperature", "Angular frequency", "Storage modulus", "Loss modulus"]
UNITS = ["°C", "rad/s", "MPa", "MPa"]


@pytest.mark.parametrize(
    ("details", "columns", "deformation"),
    [
        ([["Filename", "a.tri"], ["Geometry name", "25mm parallel plate, Peltier plate Steel"]], [], "shear"),
        ([["Measuring System:", "PP25-SN12345"]], [], "shear"),
        ([["Clamp: dual cantilever"]], [], "bending"),
        ([["Filename", "a.tri"]], [("Oscillation torque", "µN.m")], "shear"),
        ([["Filename", "a.tri"]], [("Torque", "mN·m")], "shear"),
        ([["Filename", "a.tri"]], [("Shear strain", "%")], "shear"),
        ([["Geometry name", "15 mm parallel plate"]], [("Oscillation force", "N")], None),  # plates that compress
        ([["Geometry name", "15 mm parallel plate, compression"]], [], None),
        ([["Filename", "shear.tri"]], [], None),
    ],
)
def test_geometry_or_torque_decides_between_tension_and_shear(tmp_path, details, columns, deformation):
    # as TRIOS and RheoCompass write workbooks: a sheet of details, then names and units of one step
    names, units = (
        [*first, *more] for first, more in ((RHEOMETER, [c[0] for c in columns]), (UNITS, [c[1] for c in columns]))
    )
    step = [["Frequency sweep - 1"], names, units, *([*point, *[0.5] * len(columns)] for point in POINTS)]
    path = write(tmp_path / "a.xlsx", {"Details": details, "Frequency sweep - 1": step})
    if deformation is None:
        with pytest.raises(DataFileError, check=lambda error: error.code == "no-deformation"):
            read_dma(path)
        assert read_dma(path, deformation="tension").deformation == "tension"
    else:
        assert read_dma(path).deformation == deformation


def test_numbers_may_be_text_with_a_decimal_comma_beside_true_numbers(tmp_path):
    sheet = [HEADER, [20, 0.5, "5,5", "0,5"], [20, "1,5", 6.25, 0.7]]
    isotherm = read_dma(write(tmp_path / "a.xlsx", {"DMA": sheet})).isotherms[0]
    assert isotherm.storage_modulus == pytest.approx([5.5e6, 6.25e6])
    assert isotherm.angular_frequency == pytest.approx([3.14159265, 9.42477796])


def test_a_wrong_cell_is_named_by_sheet_and_row(tmp_path):
    path = write(tmp_path / "a.xlsx", {"DMA": [[], HEADER, *POINTS, [20, 20, "five", 0.5]]})
    with refused("not-a-number", 5, "'five'"):
        read_dma(path)
    left_out = write(tmp_path / "b.xlsx", {"DMA": [HEADER, *POINTS, [20, 20, 7, -0.5]]})
    assert noted(read_dma(left_out).notes, "points-left-out", "Sheet 'DMA', row 4")


def test_sheets_of_several_temperatures_are_joined_and_others_refused(tmp_path):
    warm = [[30, f, E / 2, loss] for _, f, E, loss in POINTS]
    apart = write(tmp_path / "a.xlsx", {"20": [HEADER, *POINTS], "30": [HEADER, *warm], "shift": [["T (°C)", "aT"]]})
    sweeps = read_dma(apart)
    assert sweeps.temperatures - 273.15 == pytest.approx([20.0, 30.0])
    assert noted(sweeps.notes, "sheets-as-temperatures", "'20', '30'")
    twice = write(tmp_path / "b.xlsx", {"A": [HEADER, *POINTS, *warm], "B": [HEADER, *warm]})
    with refused("several-tables", None, "'A'", "20.0 to 30.0 °C", "'B'", "30.0 to 30.0 °C"):
        read_dma(twice)


def test_remarks_beside_the_table_need_no_heading(tmp_path):
    path = write(
        tmp_path / "a.xlsx", {"a": [HEADER, *([*row, "", "slipped?" * (n == 1)] for n, row in enumerate(POINTS))]}
    )
    assert len(read_dma(path).isotherms[0]) == len(POINTS)


def test_sheets_of_tension_and_shear_are_refused_with_what_each_holds(tmp_path):
    shear = [[*HEADER[:2], "G' (MPa)", "G'' (MPa)"], *([T, f, E / 3, loss / 3] for T, f, E, loss in POINTS)]
    path = write(tmp_path / "both.xlsx", {"E": [HEADER, *POINTS], "G": shear})
    with refused("several-tables", None, "'E' (tension,", "'G' (shear,"):
        read_dma(path)
    assert read_dma(path, sheet="G").deformation == "shear"


def test_the_name_of_a_sheet_may_show_the_temperature(tmp_path):
    sheets = {f"{T} °C": [HEADER[1:], [1, 5 - T / 20, 0.5], [2, 6 - T / 20, 0.6]] for T in (-10, 20)}
    sweeps = read_dma(write(tmp_path / "a.xlsx", sheets))
    assert sweeps.temperatures - 273.15 == pytest.approx([-10.0, 20.0])
    assert noted(sweeps.notes, "temperature-from-name", "sheet's")


def test_a_workbook_without_moduli_is_refused_with_its_sheets(tmp_path):
    with refused("missing-columns", None, "'A'", "'B'"):
        read_dma(write(tmp_path / "a.xlsx", {"A": [["x"]], "B": []}))


@pytest.mark.slow
def test_an_ordinary_workbook_is_quick(tmp_path):
    path = one_sheet(tmp_path)
    read_dma(path)  # imports
    best = min(_seconds(read_dma, path) for _ in range(5))
    assert best < 0.3  # s; a process that parses takes about 0.04 s, more on a busy machine


def _seconds(function, *arguments):
    start = time.perf_counter()
    function(*arguments)
    return time.perf_counter() - start


def test_a_workbook_is_parsed_once(tmp_path, monkeypatch):
    source = opened(one_sheet(tmp_path))
    assert workbook.sheet_names(source) == ("Notes", "DMA")
    monkeypatch.setattr(workbook, "_APART", None)
    assert len(workbook.sheets(source)["DMA"]) == len(rows())


def test_a_cell_in_the_last_corner_does_not_take_the_memory_of_all(tmp_path):
    # as it stands, a parser would make room for 17 thousand million cells: 549 GB
    def far(data):
        return data.replace(b"</sheetData>", b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>')

    path = changed(write(tmp_path / "far.xlsx", {"DMA": rows()}), "xl/worksheets/sheet1.xml", far)
    with refused("too-large", None, "1.72e+10 cells"):
        read_dma(path)


def test_a_cell_far_off_is_refused_though_its_name_is_hidden(tmp_path):
    # letters written as entities are the same cell to a parser of XML; the limit of memory holds
    def far(data):
        cell = b'<row r="1048576"><c r="&#88;FD1048576"><v>1</v></c></row></sheetData>'
        return data.replace(b"</sheetData>", cell)

    path = changed(write(tmp_path / "far.xlsx", {"DMA": rows()}), "xl/worksheets/sheet1.xml", far)
    with pytest.raises(DataFileError, check=lambda error: error.code in ("too-large", "damaged")):
        read_dma(path)


@pytest.mark.slow
def test_an_archive_that_unpacks_to_gigabytes_is_refused(tmp_path):
    path = write(tmp_path / "bomb.xlsx", {"DMA": rows()})
    changed(path, "xl/worksheets/sheet1.xml", lambda data: data + b" " * 60_000_000)
    assert path.stat().st_size < 200_000
    with refused("too-large", None, "60 MB"):
        read_dma(path)


def test_a_parser_that_does_not_end_is_ended(tmp_path, monkeypatch):
    monkeypatch.setattr(workbook, "parsed", endless)
    monkeypatch.setattr(workbook, "_APART", LimitedProcess(0.2, workbook.LARGEST_MEMORY))
    with refused("too-slow"):
        workbook.sheets(opened(one_sheet(tmp_path)))


def test_a_parser_that_dies_is_an_error_like_any_other(tmp_path, monkeypatch):
    monkeypatch.setattr(workbook, "parsed", dying)
    with refused("damaged"):
        workbook.sheets(opened(one_sheet(tmp_path)))
    assert workbook.sheet_names(opened(one_sheet(tmp_path))) == ()


@pytest.mark.parametrize("start", workbook.MAGIC)
def test_what_only_begins_like_a_workbook_is_refused(tmp_path, start):
    path = tmp_path / "junk.xls"
    path.write_bytes(start + bytes(1000))
    with refused("damaged"):
        read_dma(path)


def test_a_protected_workbook_and_other_archives_are_refused(tmp_path):
    path = tmp_path / "archive.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "no workbook")
    with refused("damaged"):
        read_dma(path)


def test_real_workbooks_of_the_old_kind_are_opened(real_data):
    sheets = workbook.sheets(opened(real_data / "instruments" / "eplexor" / "freq_Eplexor_raw.xls"))
    assert list(sheets) == ["Exported Data", "Data header"]
    assert sheets["Exported Data"][0][:2] == ["Nr", "F stat."]
    assert sheets["Exported Data"][2][:2] == [1.0, -28.9258]


def test_a_truth_value_is_no_number(tmp_path):
    path = write(tmp_path / "a.xlsx", {"DMA": [HEADER, *POINTS, [20, 20, True, 0.5]]})
    with refused("not-a-number", 4, "'TRUE'"):
        read_dma(path)


def test_a_hidden_sheet_with_moduli_is_reported(tmp_path):
    import xlsxwriter

    path = tmp_path / "hidden.xlsx"
    with xlsxwriter.Workbook(str(path)) as book:
        for name, celsius in (("DMA", 20), ("old", 60), ("lists", None)):
            sheet = book.add_worksheet(name)
            cells = [["only", "words"]] if celsius is None else [HEADER, *([celsius, *rest] for _, *rest in POINTS)]
            for number, row in enumerate(cells):
                sheet.write_row(number, 0, row)
            if name != "DMA":
                sheet.hide()
    assert noted(read_dma(path).notes, "hidden-sheet", "'old'")


def test_long_texts_are_cut_before_they_take_memory(tmp_path):
    long = [["", "", "", "", "x" * 30_000] for _ in range(50)]
    cells = workbook.sheets(opened(write(tmp_path / "a.xlsx", {"DMA": [HEADER, *POINTS, *long]})))["DMA"]
    assert len(cells[3][4]) == parse_workbook.LONGEST_TEXT


def test_more_cells_than_any_measurement_are_refused(monkeypatch, tmp_path):
    monkeypatch.setattr(parse_workbook, "LARGEST_ANSWER", 100)
    with refused("too-large"):
        parse_workbook.parsed("a.xlsx", one_sheet(tmp_path).read_bytes())


@pytest.mark.parametrize("python", ["", "/no/such/python"])
def test_a_python_that_does_not_start_is_reported(tmp_path, monkeypatch, python):
    path = one_sheet(tmp_path)
    workbook._APART.close()
    monkeypatch.setattr(sys, "executable", python)
    with refused("no-parser"):
        read_dma(path)


def test_a_missing_package_is_not_blamed_on_the_file(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "python_calamine", None)
    with refused("package-missing"):
        parse_workbook.parsed("a.xlsx", one_sheet(tmp_path).read_bytes())


@pytest.mark.parametrize("unit", [" (%)", ""])
def test_cells_that_excel_shows_as_per_cent_are_read_as_shown(tmp_path, unit):
    import xlsxwriter

    path = tmp_path / "curves.xlsx"
    heading = ["specimen", "speed (mm/s)", "temperature (degC)", "load (N)", f"viscoelastic friction{unit}"]
    with xlsxwriter.Workbook(str(path)) as book:
        book.add_worksheet("a").write_row(0, 0, ["nothing"])
        sheet = book.add_worksheet("μ & more")
        sheet.write_row(1, 0, heading)
        for row, (text, format_of) in enumerate((("10", "0.0%"), ("20", "0%"), ("3,5", '0.00" "%')), start=2):
            sheet.write_row(row, 0, ["A", text, 30, 25])
            sheet.write_number(row, 4, 0.031, book.add_format({"num_format": format_of}))
    curves = read_friction_curves(path)
    assert curves.viscoelastic == pytest.approx([0.031] * 3, rel=1e-14)
    assert curves.speed == pytest.approx([0.01, 0.02, 0.0035])
