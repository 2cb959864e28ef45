"""Tables in which headings state the conditions of the numbers below them, and headings of several rows."""

from __future__ import annotations

import datetime
import math
from collections.abc import Iterable, Sequence
from itertools import cycle, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from readers.refusal import noted, refused
from readers.samples import workbook
from readers.written import write
from viscofric.errors import DataFileError
from viscofric.friction.curve_files import holds_friction_curves
from viscofric.notes import codes

SPEEDS, CELSIUS, LOADS = (1.0, 12.5, 100.0), (20.0, 40.0, 60.0), (5.0, 10.0, 20.0)
#: Delimiter, decimal mark and encoding of texts; a workbook.
FORMS = {
    "semicolons": (";", ",", "utf-8"),
    "tabs": ("\t", ",", "utf-16"),
    "commas": (",", ".", "utf-8-sig"),
    "code page": (";", ".", "cp1252"),
    "no mark": ("\t", ".", "utf-16-le"),
    "workbook": ("", "", ""),
}
Rows = Sequence[Sequence[object]]


def in_forms(names: str, cases: Iterable[Any]) -> pytest.MarkDecorator:
    """Have each case in a workbook, and in one of the texts, which are turned into cells before headings are read."""
    texts = cycle(form for form in FORMS if form != "workbook")
    several = [case if "," in names else (case,) for case in cases]
    forms = [(*case, form) for case in several for form in (next(texts), "workbook")]
    return pytest.mark.parametrize(f"{names}, form", forms)


def coefficient(speed: float, celsius: float, load: float) -> float:
    return round(0.2 + 0.05 * math.log10(speed) + celsius / 500 - load / 300, 4)


def everywhere(
    speeds: Sequence[float] = SPEEDS, celsius: Sequence[float] = CELSIUS, loads: Sequence[float] = LOADS
) -> list[tuple[float, ...]]:
    return sorted((v, T, F, coefficient(v, T, F)) for v in speeds for T in celsius for F in loads)


def saved(folder: Path, rows: Rows, form: str = "semicolons", merged: Sequence[tuple[int, int, int, int]] = ()) -> Path:
    """Write rows as a text, or as a workbook with merged cells (first and last row and column)."""
    if form == "workbook":
        import xlsxwriter

        path = folder / "table.xlsx"
        with xlsxwriter.Workbook(str(path)) as book:
            sheet = book.add_worksheet("data")
            for place, row in enumerate(rows):
                sheet.write_row(place, 0, row)
            for top, left, bottom, right in merged:
                sheet.merge_range(top, left, bottom, right, rows[top][left])
        return path
    delimiter, mark, encoding = FORMS[form]
    shown = [[f"{cell:g}".replace(".", mark) if isinstance(cell, float) else str(cell) for cell in row] for row in rows]
    lines = [delimiter.join(f'"{cell}"' if delimiter in cell else cell for cell in row) for row in shown]
    path = folder / "table.csv"
    path.write_bytes("\r\n".join(lines).encode(encoding))
    return path


def points(curves: vf.FrictionCurves) -> list[tuple[float, ...]]:
    columns = (1e3 * curves.speed, curves.temperature - 273.15, curves.load, curves.viscoelastic)
    return sorted(tuple(round(float(one), 6) for one in row) for row in zip(*columns, strict=True))


def assert_read(path: Path, expected: list[tuple[float, ...]], **given: str) -> vf.FrictionCurves:
    curves = vf.read_friction_curves(path, columns=given)
    assert np.allclose(points(curves), expected, rtol=1e-9, atol=1e-9)
    return curves


@in_forms(
    "heading",
    [
        "{:g} °C",
        "T = {:g} °C",
        "COF {:g} °C",
        "µ @ {:g} °C",
        "mu, {:g}°C",
        "{:g} °C COF",
        "COF_{:g}C",
        "COF [-] {:g} °C",
    ],
)
def test_temperatures_in_headings(tmp_path: Path, form: str, heading: str) -> None:
    rows = [["speed (mm/s)", *map(heading.format, CELSIUS)]]
    rows += [[v, *(coefficient(v, T, 10.0) for T in CELSIUS)] for v in SPEEDS]
    curves = assert_read(saved(tmp_path, rows, form), everywhere(loads=[10.0]), load="= 10 N")
    assert "temperature-from-title" in codes(curves.notes)
    assert ("quantity-assumed" in codes(curves.notes)) == (heading in ("{:g} °C", "T = {:g} °C"))


@in_forms(
    "heading",
    [
        "{:g} N",
        "F = {:g} N",
        "COF {:g} N",
        "µ @ {:g} N",
        "Load {:g} N",
        "COF (load {:g} N)",
        "mu Fn={:g}N",
        "COF {:g} N (-)",
    ],
)
def test_loads_in_headings(tmp_path: Path, form: str, heading: str) -> None:
    rows = [["v [µm/s]", *map(heading.format, LOADS)]]
    rows += [[1e3 * v, *(coefficient(v, 20.0, F) for F in LOADS)] for v in SPEEDS]
    path = saved(tmp_path, rows, form)
    curves = assert_read(path, everywhere(celsius=[20.0]), temperature="= 20 degC")
    assert "load-from-title" in codes(curves.notes)
    assert holds_friction_curves(path)


@in_forms(
    "heading",
    [
        "{T:g} °C, {F:g} N",
        "COF {T:g} °C {F:g} N",
        "COF ({F:g} N, {T:g} °C)",
        "{F:g} N / {T:g} °C",
        "COF_{T:g}C_{F:g}N",
        "{T:g} °C/{F:g} N",
        "COF @ {F:g} N and {T:g} °C",
    ],
)
def test_temperature_and_load_in_each_heading(tmp_path: Path, form: str, heading: str) -> None:
    pairs = [(T, F) for T in CELSIUS for F in LOADS]
    rows = [["speed (mm/s)", *(heading.format(T=T, F=F) for T, F in pairs)]]
    rows += [[v, *(coefficient(v, *pair) for pair in pairs)] for v in SPEEDS]
    assert_read(saved(tmp_path, rows, form), everywhere())


@in_forms("heading", ["{:g} mm/s", "v = {:g} mm/s", "COF @ {:g} mm/s"])
def test_speeds_in_headings_and_temperatures_or_loads_below_each_other(tmp_path: Path, form: str, heading: str) -> None:
    rows = [["Temperature (°C)", *map(heading.format, SPEEDS)]]
    warm = [[T, *(coefficient(v, T, 10.0) for v in SPEEDS)] for T in CELSIUS]
    assert_read(saved(tmp_path, [*rows, *warm], form), everywhere(loads=[10.0]), load="= 10 N")
    rows[0][0] = "Load, N"
    loaded = [[F, *(coefficient(v, 20.0, F) for v in SPEEDS)] for F in LOADS]
    assert_read(saved(tmp_path, [*rows, *loaded], form), everywhere(celsius=[20.0]), temperature="= 20 degC")


@in_forms("above, units", product(("Temperature {:g} °C", "{:g} °C", "T = {:g} °C"), ("row", "headings")))
def test_a_temperature_above_speed_load_and_friction(tmp_path: Path, form: str, above: str, units: str) -> None:
    """Three rows of headings, the first of merged cells, with an empty column between the sets."""
    names = [["speed", "load", "COF"], ["mm/s", "N", "-"]] if units == "row" else [["speed (mm/s)", "load (N)", "COF"]]
    rows: list[list[object]] = [["Friction of a synthetic rubber"]]
    rows.append([cell for T in CELSIUS for cell in (above.format(T), "", "", "")])
    rows += [[*line, ""] * len(CELSIUS) for line in names]
    rows += [
        [cell for T in CELSIUS for cell in (v, F, coefficient(v, T, F), "")] for v in SPEEDS for F in LOADS
    ]  # fmt: skip
    path = saved(tmp_path, rows, form, [(1, left, 1, left + 2) for left in (0, 4, 8)])
    assert_read(path, everywhere())


@in_forms(
    "conditions, first",
    product(
        (("{:g} °C", "{:g} N"), ("COF {:g} °C", "Load {:g} N"), ("COF {:g} °C", "COF {:g} N")),
        (("", "speed (mm/s)"), ("speed (mm/s)", ""), ("speed", "mm/s")),
    ),
)
def test_conditions_in_two_rows(tmp_path: Path, form: str, conditions: tuple[str, str], first: tuple[str, str]) -> None:
    """The heading of the first column is above, below, or in both rows; merged cells stand for those behind them."""
    above, below = conditions
    pairs = [(T, F) for T in CELSIUS for F in LOADS]
    rows: list[list[object]] = [[first[0], *(cell for T in CELSIUS for cell in (above.format(T), "", ""))]]
    rows.append([first[1], *(below.format(F) for _, F in pairs)])
    rows += [[v, *(coefficient(v, *pair) for pair in pairs)] for v in SPEEDS]
    merged = [(0, left, 0, left + 2) for left in (1, 4, 7)]
    if first == ("speed (mm/s)", ""):
        merged.append((0, 0, 1, 0))
    assert_read(saved(tmp_path, rows, form, merged), everywhere())


@pytest.mark.parametrize(
    "header",
    [
        [["", "load (N)", "", ""], ["speed (mm/s)", *LOADS]],
        [["load (N)", *LOADS], ["speed (mm/s)", "COF", "COF", "COF"]],
        [["Load (N)"], ["", *LOADS], ["speed (mm/s)", "COF", "COF", "COF"]],
        [["", "COF", "", ""], ["", "load (N)", "", ""], ["speed (mm/s)", *LOADS]],
        [["speed", *LOADS], ["mm/s", "N", "N", "N"]],
        [["speed", "COF", "", ""], ["mm/s", "5 N", "10 N", "20 N"]],
        [["Date", "2026-01-02"], ["Operator", "nobody"], ["speed (mm/s)", "5 N", "10 N", "20 N"]],
        [["speed (mm/s)", "COF 5 N", "COF 0.01 kN", "COF 2e1 N"]],
    ],
)
@pytest.mark.parametrize("form", ["semicolons", "workbook"])
def test_loads_as_numbers_under_their_name(tmp_path: Path, header: Rows, form: str) -> None:
    rows = [*header, *([v, *(coefficient(v, 20.0, F) for F in LOADS)] for v in SPEEDS)]
    assert_read(saved(tmp_path, rows, form), everywhere(celsius=[20.0]), temperature="= 20 degC")


@pytest.mark.parametrize(
    "above",
    [
        [["Load: 10 N"], ["Temperature: 20 °C"]],
        [["Load (N)", 10.0], ["T [°C]", 20.0]],
        [["Load: 10 N", "Temperature = 20 °C"]],
        [["# Load: 10 N"], ["# Temperature [°C]: 20"]],
        [["Load", 10.0, "N"], ["Temperature", 20.0, "°C"], ["Preload", "7 N"]],
        [["Load : 10.00 [N]"], ["Temperature : 20.00 [°C]"], ["Radius : 10.00 [mm]"]],
        [["Applied load = 10 N; Temperature: 20 (°C)"]],
    ],
)
def test_what_lines_above_a_table_state_alone_holds_for_all_rows(tmp_path: Path, above: Rows) -> None:
    rows = [*above, ["speed (mm/s)", "COF", "remark"], *([v, coefficient(v, 20.0, 10.0), ""] for v in SPEEDS)]
    curves = assert_read(saved(tmp_path, rows), everywhere(celsius=[20.0], loads=[10.0]))
    assert codes(curves.notes) & {"value-from-above", "load-from-title"}
    with pytest.raises(DataFileError) as caught:
        vf.read_friction_curves(saved(tmp_path, [["Load: 5 N"], *rows]))
    assert caught.value.code in {"missing-columns", "values-contradict"}


@pytest.mark.parametrize("first", ["# Load: 5 N\n", ""])
@pytest.mark.parametrize("count", [3, 400])
def test_a_remark_between_rows_does_not_state_the_load_of_all(tmp_path: Path, first: str, count: int) -> None:
    rows = "".join(f"{v},20,0.{v}\n" for v in range(1, count))
    path = tmp_path / "table.csv"
    path.write_text(f"{first}v (mm/s),T (degC),COF\n{rows}# Load: 10 N\n{rows}")
    with refused("missing-columns"):
        vf.read_friction_curves(path)


def test_a_line_above_a_table_states_its_speed(tmp_path: Path) -> None:
    rows = [["Linear speed : 1.00 [cm/s]"], ["T (°C)", "F (N)", "Reibbeiwert"], [20.0, 5.0, 0.3], [40.0, 5.0, 0.2]]
    assert vf.read_friction_curves(saved(tmp_path, rows)).speed == pytest.approx([0.01, 0.01])


SPEED = "speed (mm/s)"


@pytest.mark.parametrize(
    ("above", "header", "code"),
    [
        # a line above is none of the headings: columns and what they state are kept
        (["Load", "10 N"], [SPEED, "temperature (°C)", "load (N)", "COF 20 °C", "COF 40 °C"], "missing-columns"),
        (["Load 10 N, Temperature 20 °C"], [SPEED, "temperature (°C)", "COF", "preload (N)"], "missing-columns"),
        (["Humidity", "50 %", "20 °C"], [SPEED, "COF 5 N", "COF 20 N"], "missing-columns"),
        # what may not be the condition of all rows
        (["Load: 5 N", "10 N"], [SPEED, "temperature (°C)", "COF"], "missing-columns"),
        (["Sample", "F 5 N"], [SPEED, "temperature (°C)", "COF"], "missing-columns"),
        (["Load: 1,000 N"], [SPEED, "temperature (°C)", "COF"], "ambiguous-decimals"),
        (["Speed: 10 mm/s"], ["u (mm/s)", "temperature (°C)", "load (N)", "COF"], "ambiguous-columns"),
        (["Temperature: 20 °C"], [SPEED, "chamber (°C)", "load (N)", "COF"], "ambiguous-columns"),
    ],
)
@pytest.mark.parametrize("between", [[], [["Operator: nobody"]]])
def test_lines_above_a_table_replace_none_of_its_columns(
    tmp_path: Path, above: list[str], header: list[str], code: str, between: Rows
) -> None:
    rows = [[1.0, 20.0, 0.1, 0.2, 0.3][: len(header)], [10.0, 40.0, 0.2, 0.3, 0.4][: len(header)]]
    with refused(code):
        vf.read_friction_curves(saved(tmp_path, [above, *between, header, *rows]))


@pytest.mark.parametrize(
    ("header", "code", "named"),
    [
        ([[SPEED, 5.0, 10.0]], "number-without-unit", "'5' and '10'"),
        ([[f"{SPEED} \\ load (N)", 5.0, 10.0]], "number-without-unit", "'5' and '10'"),  # the one or the other
        ([[SPEED, "COF 5", "COF 10"]], "number-without-unit", "'COF 5 N'"),
        ([[SPEED, "COF 5 N 10 N", "COF 10 N 20 N"]], "two-values", "10 N"),
        ([[SPEED, "5 N 10 N", "10 N 20 N"]], "two-values", "10 N"),
        ([[SPEED, "COF 5 N", "COF 0.005 kN"]], "ambiguous-columns", "'COF 0.005 kN'"),
        ([[SPEED, "COF 5 N", "COF 5 N"]], "ambiguous-columns", "'COF 5 N'"),
        ([[SPEED, "COF 5 kg", "COF 10 N"]], "ambiguous-columns", "'COF 5 kg'"),  # weights, or loads as they are
        ([[SPEED, "5 N", "10 N"], ["mm/s", "N", "N"]], "wrong-unit", "'5 N'"),
        ([["", "Friction force (N)", ""], [SPEED, "5 N", "10 N"]], "quantity-unknown", "'Friction force (N)'"),
        ([["", "temperature rise", ""], [SPEED, "5 N", "10 N"]], "quantity-unknown", "'temperature rise'"),
        ([["Reibkraft", "", ""], [SPEED, "5 N", "10 N"]], "quantity-unknown", "'Reibkraft'"),
        ([[SPEED, "wear force 5 N (N)", "wear force 10 N (N)"]], "missing-columns", "'wear force 5 N (N)'"),
        ([[SPEED, "NR 5 N", "SBR 5 N"]], "missing-columns", "'NR 5 N'"),
        ([[SPEED, "µ static 5 N", "µ kinetic 5 N"]], "missing-columns", "'µ static 5 N'"),
        ([[SPEED, "COF 0.2 MPa", "COF 0.4 MPa"]], "missing-columns", "'COF 0.2 MPa'"),
        ([["time (s)", "5 N", "10 N"]], "missing-columns", "'time (s)'"),
        ([["Load", 5.0, 10.0], [SPEED, "COF", "COF"]], "number-without-unit", "'5 N'"),
        ([["", 5.0, 10.0], [SPEED, "COF", "COF"]], "number-without-unit", "'5 N'"),
    ],
)
def test_headings_that_may_be_read_in_two_ways_are_refused(tmp_path: Path, header: Rows, code: str, named: str) -> None:
    path = saved(tmp_path, [*header, [1.0, 0.1, 0.2], [10.0, 0.2, 0.3]])
    with refused(code, None, named):
        vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})


def test_marks_of_thousands_in_headings_are_refused(tmp_path: Path) -> None:
    path = saved(tmp_path, [[SPEED, "COF 1,000 N", "COF 2,500 N"], [1.0, 0.1, 0.2]])
    with refused("ambiguous-decimals", None, "'1,000'"):
        vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})


@pytest.mark.parametrize("form", ["semicolons", "workbook"])
def test_tables_of_several_temperatures_below_each_other_may_be_wide(tmp_path: Path, form: str) -> None:
    header = ["speed (mm/s)", *(f"COF {F:g} N" for F in LOADS)]
    rows: list[list[object]] = []
    for T in CELSIUS:
        rows += [[f"T = {T:g} °C"], header, *([v, *(coefficient(v, T, F) for F in LOADS)] for v in SPEEDS)]
    assert_read(saved(tmp_path, rows, form), everywhere())


def test_lines_between_rows_do_not_state_other_conditions_than_the_headings(tmp_path: Path) -> None:
    header, row = ["specimen", "speed (mm/s)", "load (N)", "COF"], ["A", 1.0, 5.0, 0.1]
    with refused("values-contradict", 4, "'T = 40 °C'"):
        path = saved(tmp_path, [["T = 20 °C", "", "", ""], header, row, ["T = 40 °C", "", "", ""], row])
        vf.read_friction_curves(path)
    with refused("values-contradict", 3, "'Load: 10 N'"):
        path = saved(tmp_path, [["specimen", "speed (mm/s)", "COF 5 N"], row[:3], ["Load: 10 N", "", ""], row[:3]])
        vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})
    with refused("values-contradict", 3, "'Load: 10 N'"):
        between = ["Load: 10 N", "was 20 N", ""]
        path = saved(tmp_path, [["specimen", "speed (mm/s)", "COF 5 N"], row[:3], between, row[:3]])
        vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})


def test_columns_of_two_compounds_beside_each_other_are_not_joined(tmp_path: Path) -> None:
    rows = [["", "NR", "SBR"], ["speed (mm/s)", "COF 5 N", "COF 10 N"], [1.0, 0.1, 0.2]]
    with refused("several-tables"):
        vf.read_friction_curves(saved(tmp_path, rows), columns={"temperature": "= 20 degC"})


def test_specimens_with_names_like_quantities_lose_no_row(tmp_path: Path) -> None:
    rows = [["T", 1.0, 5.0, 0.1], ["T", 2.0, 5.0, 0.2], ["T", 3.0, 5.0, 0.3]]
    columns = {"speed": "#2 (mm/s)", "load": "#3 (N)", "viscoelastic_friction": "#4", "temperature": "= 20 degC"}
    assert len(vf.read_friction_curves(saved(tmp_path, rows), columns=columns)) == 3


def test_numbers_too_large_for_friction_are_not_read_under_loads_alone(tmp_path: Path) -> None:
    path = saved(tmp_path, [[SPEED, "5 N", "10 N"], [1.0, 1.5, 3.1]])  # perhaps forces
    with refused("quantity-unknown"):
        vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})


def test_a_dash_before_a_temperature_is_no_minus_sign(tmp_path: Path) -> None:
    below = [1.0, 0.1, 0.2]
    with refused("dash-or-minus", None, "'COF-10 °C'"):
        vf.read_friction_curves(saved(tmp_path, [[SPEED, "COF-10 °C", "COF-25 °C"], below]), columns={"load": "= 5 N"})
    curves = vf.read_friction_curves(saved(tmp_path, [[SPEED, "−10 °C", "-25 °C"], below]), columns={"load": "= 5 N"})
    assert curves.temperature == pytest.approx([263.15, 248.15])


@in_forms("more", [[], ["# remark"], [""] * 4, ["run 3 was repeated", "", "", "", "", ""]])
def test_other_columns_and_rows_do_not_disturb(tmp_path: Path, form: str, more: list[object]) -> None:
    date = datetime.date(2026, 11, 29)
    rows: list[list[object]] = [["date", "speed (mm/s)", "COF 5 N", "COF 10 N", "", "remark"]]
    rows += [[str(date), v, *(coefficient(v, 20.0, F) for F in LOADS[:2]), "", "ok"] for v in SPEEDS]
    rows.insert(2, more)
    path = saved(tmp_path, rows, form)
    curves = assert_read(path, everywhere(celsius=[20.0], loads=LOADS[:2]), temperature="= 20 degC")
    assert noted(curves.notes, "unused-columns", "'date'", "'remark'")


@in_forms("label, place", product(("Total", "Mean", "Summe", "max"), (0, 1)))
def test_rows_that_sum_up_others_are_refused(tmp_path: Path, form: str, label: str, place: int) -> None:
    rows: list[list[object]] = [["specimen", "speed (mm/s)", "COF 5 N"], ["A", 1.0, 0.1], ["B", 2.0, 0.2]]
    rows.append([label if place == 0 else "", label if place == 1 else 3.0, 0.3])
    with refused("summary-row", 4, repr(label)):
        vf.read_friction_curves(saved(tmp_path, rows, form), columns={"temperature": "= 20 degC"})


def test_merged_cells_hold_for_the_rows_and_numbers_beside_and_below_them(tmp_path: Path) -> None:
    header = ["temperature (°C)", "load (N)", "speed (mm/s)", "COF"]
    rows: list[list[object]] = [header, *([T if n == 0 else "", 10.0, v, coefficient(v, T, 10.0)]
                                          for T in CELSIUS for n, v in enumerate(SPEEDS))]  # fmt: skip
    merged = [(1 + 3 * n, 0, 3 + 3 * n, 0) for n in range(3)]
    assert_read(saved(tmp_path, rows, "workbook", merged), everywhere(loads=[10.0]))
    apart = saved(tmp_path, rows)
    assert "value-spread" in codes(assert_read(apart, everywhere(loads=[10.0])).notes)
    rows[1][0], rows[2][0] = "", CELSIUS[0]
    with refused("empty-cell", 2):
        vf.read_friction_curves(saved(tmp_path, rows))


def test_merged_cells_in_per_cent_are_read_as_shown(tmp_path: Path) -> None:
    import xlsxwriter

    path = tmp_path / "table.xlsx"
    with xlsxwriter.Workbook(str(path)) as book:
        sheet, shown = book.add_worksheet("data"), book.add_format({"num_format": "0.0%"})
        sheet.write_row(0, 0, ["speed (mm/s)", "load (N)", "temperature (°C)", "COF (%)"])
        for row in (1, 2):
            sheet.write_row(row, 0, [row, 10, 20])
        sheet.merge_range(1, 3, 2, 3, 0.15, shown)
    assert vf.read_friction_curves(path).viscoelastic == pytest.approx([0.15, 0.15])


DMA_ROWS = [[1.0, 5.0, 0.5, 4.0, 0.4], [10.0, 6.0, 0.6, 5.0, 0.5]]


@in_forms(
    "header, order",
    [
        ([["f (Hz)", "E' 20°C (MPa)", "E'' 20°C (MPa)", "E' 40°C (MPa)", "E'' 40°C (MPa)"]], "1234"),
        ([["", "Temperature 20 °C", "", "Temperature 40 °C", ""], ["f", "E'", "E''", "E'", "E''"],
          ["Hz", "MPa", "MPa", "MPa", "MPa"]], "1234"),
        ([["f", "E'", "E''", "E'", "E''"], ["", "20 °C", "20 °C", "40 °C", "40 °C"],
          ["Hz", "MPa", "MPa", "MPa", "MPa"]], "1234"),
        ([["", "E' (MPa)", "", "E'' (MPa)", ""], ["f (Hz)", "20 °C", "40 °C", "20 °C", "40 °C"]], "1324"),
        ([["T (°C)", 20.0, "", 40.0, ""], ["f (Hz)", "E' (MPa)", "E'' (MPa)", "E' (MPa)", "E'' (MPa)"]], "1234"),
        ([["f (Hz)", "20 °C", "", "40 °C", ""], ["Hz", "E' (MPa)", "E'' (MPa)", "E' (MPa)", "E'' (MPa)"]], "1234"),
        ([["f (Hz)", "E' 68 °F (MPa)", "E'' 68 °F (MPa)", "E' 313.15 K (MPa)", "E'' 313.15 K (MPa)"]], "1234"),
    ],
)  # fmt: skip
def test_sweeps_beside_each_other(tmp_path: Path, form: str, header: Rows, order: str) -> None:
    rows = [*header, *([row[0], *(row[int(place)] for place in order)] for row in DMA_ROWS)]
    sweeps = vf.read_dma(saved(tmp_path, rows, form), deformation="tension")
    assert sweeps.temperatures - 273.15 == pytest.approx([20.0, 40.0])
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6])
    assert sweeps.isotherms[1].loss_modulus == pytest.approx([4e5, 5e5])


def test_columns_are_named_by_their_place_in_the_file(tmp_path: Path) -> None:
    rows = [["Temperature (°C)", 20.0], ["f (Hz)", "E' (MPa)", "E'' (MPa)", "E' (MPa)", "E'' (MPa)"], *DMA_ROWS]
    with refused("ambiguous-columns", None, "'#2'"):
        vf.read_dma(saved(tmp_path, rows), deformation="tension")


def test_traction_runs_beside_each_other(tmp_path: Path) -> None:
    header = ["rolling speed (mm/s)", "SRR (%)", "µ 40 °C 20 N", "µ 100 °C 20 N"]
    runs = vf.read_mtm(saved(tmp_path, [header, [100.0, 50.0, 0.1, 0.2], [200.0, -50.0, 0.1, 0.2]]))
    assert runs.temperature - 273.15 == pytest.approx([40.0, 40.0, 100.0, 100.0])
    assert runs.load == pytest.approx([20.0] * 4)
    assert runs.traction_force == pytest.approx([2.0, -2.0, 4.0, -4.0])
    above = [["", "20 N", "", "40 N", ""], [*header[:2], "µ", "SRR (%)", "µ"], [100.0, 50.0, 0.1, 50.0, 0.2]]
    runs = vf.read_mtm(saved(tmp_path, above), columns={"temperature": "= 40 degC"})
    assert runs.load == pytest.approx([20.0, 40.0])


def test_step_tests_beside_each_other(tmp_path: Path) -> None:
    rows = [["t (s)", "J 20 °C (1/MPa)", "J 40 °C (1/MPa)"], *([float(t), 1 + t / 10, 2 + t / 10] for t in range(1, 7))]
    tests = vf.read_step_tests(saved(tmp_path, rows), deformation="tension")
    assert [test.temperature - 273.15 for test in tests.tests] == pytest.approx([20.0, 40.0])
    assert tests.tests[1].response == pytest.approx([1e-6 * (2 + t / 10) for t in range(1, 7)])


FORCES = {"N": 1.0, "kN": 1e3, "daN": 10.0, "kgf": 9.80665, "kp": 9.80665, "gf": 9.80665e-3, "lbf": 4.4482216152605}


WEIGHTS = {"kg": 9.80665, "g": 9.80665e-3}


@pytest.mark.parametrize("heading", ["load ({})", "load [{}]", "load / {}", "load, {}", "load\n{}"])
def test_loads_in_older_units_and_masses_as_weights(tmp_path: Path, heading: str) -> None:
    for unit, newton in (FORCES | WEIGHTS).items():
        load, _, below = heading.format(unit).partition("\n")
        rows = [["speed (mm/s)", "T (°C)", load, "COF"], ["mm/s", "°C", below, "-"], [1.0, 20.0, 3.0, 0.1]]
        curves = vf.read_friction_curves(saved(tmp_path, rows if below else [rows[0], rows[2]]))
        assert curves.load == pytest.approx([3.0 * newton], rel=1e-12), unit
        assert ("mass-as-load" in codes(curves.notes)) == (unit in WEIGHTS), unit


@pytest.mark.parametrize("heading", ["v ({})", "v [{}]", "v / {}", "v / ({})", "v/[{}]", "v, {}"])
def test_units_of_speed_in_brackets_or_behind_a_mark(tmp_path: Path, heading: str) -> None:
    # the micro sign, and the Greek letter
    for unit, metres in (("µm/s", 1e-6), ("μm/s", 1e-6), ("mm/s", 1e-3), ("cm/s", 0.01), ("m/min", 1 / 60)):
        rows = [[heading.format(unit), "T (K)", "load (N)", "COF"], [3.0, 293.15, 5.0, 0.1]]
        assert vf.read_friction_curves(saved(tmp_path, rows)).speed == pytest.approx([3.0 * metres], rel=1e-12), unit


@pytest.mark.parametrize("unit", ["rpm", "1/min", "U/min", "min⁻¹"])
def test_revolutions_need_the_radius_of_the_track(tmp_path: Path, unit: str) -> None:
    header = [f"speed ({unit})", "T (°C)", "load (N)", "COF"]
    with refused("revolutions", None, "'track radius (mm)'"):
        vf.read_friction_curves(saved(tmp_path, [header, [60.0, 20.0, 5.0, 0.1]]))
    rows = [[*header, "track radius (mm)"], [60.0, 20.0, 5.0, 0.1, 20.0]]
    curves = vf.read_friction_curves(saved(tmp_path, rows))
    assert curves.speed == pytest.approx([2 * math.pi * 0.02], rel=1e-12)
    assert "unused-columns" not in codes(curves.notes)
    runs = [["disc speed (mm/s)", f"ball speed ({unit})", "T (°C)", "load (N)", "traction force (N)"], [60.0] * 5]
    with refused("revolutions", None, f"'ball speed ({unit})'"):
        vf.read_mtm(saved(tmp_path, runs))


@pytest.mark.parametrize(
    ("cell", "number"),
    [
        ("1,0E-03", 1e-3),
        ("1,0E−03", 1e-3),
        ("1 234,5", 1234.5),
        ("1\u00a0234,5", 1234.5),
        ("1\u202f234\u202f567,5", 1234567.5),
        ("1'234,5", 1234.5),
        ("1.234,5", 1234.5),
        ("1.234.567,5", 1234567.5),
    ],
)
def test_blanks_apostrophes_and_points_part_thousands(tmp_path: Path, cell: str, number: float) -> None:
    rows = [["speed (mm/s)", "temperature (°C)", "load (N)", "COF"], [cell, 20.0, 5.0, 0.5]]
    assert vf.read_friction_curves(saved(tmp_path, rows)).speed == pytest.approx([1e-3 * number], rel=1e-12)


@pytest.mark.parametrize("cell", ["1,234.5", "1.234,5", "1'234.5"])
def test_a_number_with_both_marks_decides_which_parts_thousands(tmp_path: Path, cell: str) -> None:
    head = "speed (mm/s);temperature (°C);load (N);COF"
    path = write(tmp_path, head, f"{cell};20;5;1", f"{cell[0]}{cell[1]}000;20;5;1")
    assert vf.read_friction_curves(path).speed == pytest.approx([1.2345, 1.0])


@pytest.mark.parametrize(("cell", "number"), [("1,234,567", 1234567.0), ("1.234.567", 1234567.0)])
def test_two_equal_marks_part_thousands(tmp_path: Path, cell: str, number: float) -> None:
    path = write(tmp_path, "speed (mm/s);temperature (°C);load (N);COF", f"{cell};20;5;1")
    assert vf.read_friction_curves(path).speed == pytest.approx([1e-3 * number])


@pytest.mark.parametrize("sign", ["-", "−", "–"])
def test_minus_signs_before_numbers(tmp_path: Path, sign: str) -> None:
    rows = [["speed (mm/s)", "T (°C)", "load (N)", "COF"], [1.0, f"{sign}10,5", 5.0, 0.5]]
    assert vf.read_friction_curves(saved(tmp_path, rows)).temperature == pytest.approx([262.65])


def test_a_workbook_of_several_sheets_is_read_by_the_one_chosen(tmp_path: Path) -> None:
    wide = [["speed (mm/s)", "COF 5 N", "COF 10 N"], [1, 0.1, 0.2]]
    path = workbook.write(tmp_path / "a.xlsx", {"NR": wide, "SBR": [wide[0], [1, 0.3, 0.4]], "log": [["by", "hand"]]})
    with refused("several-tables", None, "'NR'", "'SBR'"):
        vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})
    curves = vf.read_friction_curves(path, columns={"temperature": "= 20 degC"}, sheet="SBR")
    assert curves.viscoelastic == pytest.approx([0.3, 0.4])


def test_specimens_at_one_condition_are_not_one_friction_curve(tmp_path: Path) -> None:
    rows = [[label, v, 20.0, 10.0, 0.1] for label in "AB" for v in SPEEDS]
    header = ["sample", "speed (mm s-1)", "temperature (°C)", "load (N)", "kinetic COF"]
    with refused("several-specimens", None, "'sample'", "'A' and 'B'"):
        vf.read_friction_curves(saved(tmp_path, [header, *rows]))
    alike = vf.read_friction_curves(saved(tmp_path, [header, *(["A", *row[1:]] for row in rows)]))
    assert alike.speed == pytest.approx(1e-3 * np.array([*SPEEDS, *SPEEDS]))
