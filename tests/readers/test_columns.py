"""Headings that are not understood: named by the user, or refused with all that a program needs to ask for them."""

from __future__ import annotations

import math
import pickle
import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viscofric as vf
from readers.refusal import noted, refused
from readers.samples.workbook import write as write_workbook
from readers.test_dma_csv import ROWS, assert_is_the_table
from readers.written import write
from viscofric import read_dma, read_mtm
from viscofric.errors import DataFileError
from viscofric.notes import codes, note_of
from viscofric.readers.headings import heading
from viscofric.readers.source import fraction_of, to_rad_per_second, unit_conversion

NAMES = {"temperature": "Chamber", "frequency": "v1", "storage_modulus": "Alpha", "loss_modulus": "Beta"}
HALF = {"temperature": "Chamber (degC)", "frequency": "v1 (Hz)"}


def read(path, **asked):
    return read_dma(path, deformation="tension", **asked)


def mapped(*headings):
    """Return headings by quantity: temperature, frequency, storage and loss modulus."""
    return dict(zip(NAMES, headings, strict=True))


@pytest.mark.parametrize(
    ("header", "columns"),
    [
        ("A (degC),v1 (Hz),B (MPa),C (MPa)", mapped("A (degC)", "v1 (Hz)", "B (MPa)", "C (MPa)")),
        ("Chamber,v1,Alpha,Beta", mapped("chamber (°C)", "V1 (Hz)", "ALPHA [MPa]", "beta (MPa)")),
        ("Chamber,v1,Alpha,Beta", {"storage modulus": "Alpha (MPa)", "loss-modulus": "Beta (MPa)"} | HALF),
        # units of the file that are wrong, or in the row below
        ("T (K?),v1 [cycles],a,b", mapped("T (K?) (degC)", "v1 [cycles] (Hz)", "a (MPa)", "b (MPa)")),
        ("Chamber,v1,Alpha,Beta\n°C,Hz,MPa,MPa", NAMES),
        # one is named, the others are understood
        ("T_C,v1,E' (MPa),E'' (MPa)", {"frequency": "v1 (Hz)"}),
        ("T_C,omega,E' (MPa),E'' (MPa)", {"frequency": "omega (Hz)"}),
        ("T_C,f (Hz),E' (MPa),loss (MPa),E'' (GPa)", {"loss_modulus": "loss (MPa)"}),
        # by number, with a header and without
        ("x,x,x,x", mapped("#1 (degC)", "#2 (Hz)", "#3 (MPa)", "# 4 (MPa)")),
        ("# exported by hand", mapped("#1 (degC)", "#2 (Hz)", "#3 (MPa)", "#4 (MPa)")),
    ],
)
def test_headings_are_named_by_the_user(tmp_path, header, columns):
    rows = [f"{row},1" if header.count(",") == 4 else row for row in ROWS]
    assert_is_the_table(read(write(tmp_path, header, *rows), columns=columns))


def test_a_header_that_is_not_understood_is_refused_with_headings_and_missing_quantities(tmp_path):
    path = write(tmp_path, "Sample,A7", "Chamber (degC),v1 (Hz),E' (MPa),Beta", *ROWS)
    with refused("missing-columns", None, "'Beta'") as caught:
        read_dma(path)
    error = pickle.loads(pickle.dumps(caught.value))
    values = error.note.values
    assert values["headings"] == ["Chamber (degC)", "v1 (Hz)", "E' (MPa)", "Beta"]
    assert values["missing"] == ["frequency"]
    assert values["known"] == {"storage modulus": "E' (MPa)"}
    assert values["key"] == error.field == "material.columns"
    assert note_of(error.note.record()).values == values
    for reader, word in (("python", "columns={"), ("shell", "--column"), ("run_file", "[material]")):
        assert word in error.remedy.words(reader)
    named = {"frequency": "v1 (Hz)", "temperature": "Chamber (degC)", "loss_modulus": "Beta (MPa)"}
    assert_is_the_table(read_dma(path, columns=named))


@pytest.mark.parametrize(
    ("header", "code", "missing"),
    [
        ("T_C,f_Hz,E'_MPa,Beta", "missing-columns", ["loss modulus"]),
        ("T_C,f,E'_MPa,E''_MPa", "no-unit", []),
        ("T_C,f_Hz,E',E''", "no-unit", []),
        ("T_C,f_Hz,E' (furlong),E''_MPa", "wrong-unit", []),
        ("T_C,f_Hz,E'_MPa,E'_MPa", "missing-columns", ["loss modulus"]),
    ],
)
def test_every_error_about_a_header_lists_it(tmp_path, header, code, missing):
    with pytest.raises(DataFileError) as caught:
        read_dma(write(tmp_path, header, *ROWS))
    values = caught.value.note.values
    assert caught.value.code in (code, "ambiguous-columns")
    assert values["headings"] == header.split(",")
    assert set(missing) >= set(values["missing"])


def test_numbers_without_a_header_are_offered_by_their_place(tmp_path):
    with refused("missing-columns") as caught:
        read_dma(write(tmp_path, *ROWS))
    assert caught.value.note.values["headings"] == ["#1", "#2", "#3", "#4"]


@pytest.mark.parametrize(
    ("said", "unit", "base"), [("log f1", " (Hz)", 10), ("lg(f1/Hz)", "", 10), ("ln f1", " (Hz)", math.e)]
)
def test_a_column_that_the_user_names_may_hold_logarithms(tmp_path, said, unit, base):
    path = write(
        tmp_path, f"T (degC),{said}{unit},E' (MPa),E'' (MPa)", "20,1,5,0.5", "20,2,6,0.7", "30,1,4,.4", "30,2,5,.6"
    )
    sweeps = read_dma(path, columns={"frequency": said + unit})
    assert sweeps.isotherms[0].angular_frequency == pytest.approx(
        [2 * math.pi * base, 2 * math.pi * base**2], rel=1e-12
    )
    assert bool(noted(sweeps.notes, "decadic-logarithms")) == said.startswith("log")


def test_logarithms_of_times_are_read_and_those_of_speeds_of_runs_are_refused(tmp_path):
    creep = write(tmp_path, "T (degC),log t (s),J (1/MPa)", *(f"20,{n},{n}" for n in range(1, 6)))
    tests = vf.read_step_tests(creep, deformation="tension", columns={"time": "log t (s)"})
    assert tests.tests[0].time == pytest.approx([10, 100, 1000, 1e4, 1e5])
    runs = write(
        tmp_path, "T_C,log v (mm/s),ball speed (mm/s),load (N),traction force (N)", "30,2,95,25,1", "30,1,90,25,1"
    )
    with refused("logarithm-unknown"):
        read_mtm(runs, columns={"disc_speed": "log v (mm/s)"})
    plain = write(tmp_path, "T (degC),Logger time (s),J (1/MPa)", *(f"20,{n},{n}" for n in range(1, 6)))
    tests = vf.read_step_tests(plain, deformation="tension", columns={"time": "Logger time (s)"})
    assert tests.tests[0].time == pytest.approx([1, 2, 3, 4, 5])


def test_wrong_mappings_are_refused(tmp_path):
    path = write(tmp_path, "T_C,f_Hz,E'_MPa,E''_MPa", *ROWS)
    with refused("unknown-quantity", None, "colour", "storage_modulus"):
        read_dma(path, columns={"colour": "red"})
    with refused("wrong-columns"):
        read_dma(path, columns={"frequency": 3})
    with refused("wrong-columns"):
        read_dma(path, columns=["frequency"])
    with refused("no-column", None, "'v9'", "'f_Hz'") as caught:
        read_dma(path, columns={"frequency": "v9"})
    assert caught.value.note.values["headings"] == ["T_C", "f_Hz", "E'_MPa", "E''_MPa"]
    with refused("no-column"):
        read_dma(path, columns={"frequency": "#9 (Hz)"})
    with refused("no-sheet"):
        read_dma(path, sheet="DMA")
    with refused("wrong-sheet"):
        read_dma(path, sheet=1)


@pytest.mark.slow
def test_one_sheet_is_chosen(tmp_path):
    points = [[float(cell) for cell in row.split(",")] for row in ROWS]
    header = ["T (degC)", "f (Hz)", "E' (MPa)", "E'' (MPa)"]
    other = [[T, f, 2 * E, E2] for T, f, E, E2 in points]
    path = write_workbook(tmp_path / "a.xlsx", {"run 1": [header, *points], "run 2": [header, *other], "log": [["x"]]})
    with refused("several-tables") as caught:
        read_dma(path)
    assert caught.value.field == "material.sheet"
    assert_is_the_table(read_dma(path, sheet="run 1"))
    assert read_dma(path, sheet="run 2").isotherms[0].storage_modulus == pytest.approx([10e6, 12e6])
    with refused("no-sheet", None, "'run 1'") as caught:
        read_dma(path, sheet="run 3")
    assert caught.value.note.values["sheets"] == ["run 1", "run 2", "log"]
    with refused("missing-columns") as caught:
        read_dma(path, sheet="log")
    renamed = [["Chamber", "v1", "Alpha", "Beta"], ["°C", "Hz", "MPa", "MPa"]]
    strange = write_workbook(tmp_path / "b.xlsx", {"notes": [["by", "hand"]], "data": [*renamed, *points]})
    with refused("missing-columns", None, "'data'") as caught:
        read_dma(strange)
    assert caught.value.note.values["headings"] == renamed[0]
    assert caught.value.note.values["sheets"] == ["notes", "data"]
    assert_is_the_table(read(strange, columns=NAMES))


def test_columns_of_traction_runs_and_their_workbooks(tmp_path):
    header = "V1 (mm/s),V2 (mm/s),traction force (N),load (N),T_C"
    rows = ["22,18,0.5,25,30", "18,22,-0.5,25,30"]
    with refused("missing-columns") as caught:
        read_mtm(write(tmp_path, header, *rows))
    assert caught.value.note.values["missing"] == ["disc speed", "ball speed"]
    assert caught.value.note.values["key"] == "measurement.columns"
    columns = {"disc_speed": "V1 (mm/s)", "ball speed": "V2 (mm/s)"}
    runs = read_mtm(write(tmp_path, header, *rows), columns=columns)
    assert runs.disc_speed == pytest.approx([0.022, 0.018])
    cells = [header.split(","), *([float(cell) for cell in row.split(",")] for row in rows)]
    book = write_workbook(tmp_path / "runs.xlsx", {"a": cells, "b": [["x"]]})
    assert np.array_equal(read_mtm(book, columns=columns, sheet="a").ball_speed, runs.ball_speed)
    twice = write_workbook(tmp_path / "twice.xlsx", {"a": cells, "b": cells})
    with refused("several-tables") as caught:
        read_mtm(twice, columns=columns)
    assert caught.value.field == "measurement.sheet"


def test_columns_of_a_master_curve(tmp_path):
    path = write(tmp_path, "w,A,B", "0.1,3,0.2", "10,4,0.5", name="curve.csv")
    columns = {"frequency": "w (rad/s)", "storage_modulus": "A (MPa)", "loss_modulus": "B (MPa)"}
    curve = vf.read_master_curve(path, "30 degC", deformation="tension", columns=columns)
    assert curve.angular_frequency == pytest.approx([0.1, 10.0])
    assert curve.storage_modulus == pytest.approx([3e6, 4e6])


@pytest.mark.parametrize(
    ("text", "name", "unit"),
    [
        ("freq_hz", "freq", "hz"),
        ("G_storage_pa", "G storage", "pa"),
        ("f in Hz", "f", "Hz"),
        ("Speichermodul in MPa", "Speichermodul", "MPa"),
        ("Temperature, °C", "Temperature", "°C"),
        ("omega_rad_s", "omega", "rad_s"),
        ("omega rad/s", "omega", "rad/s"),
        ("E' psi", "E'", "psi"),
        ("temp c", "temp", "c"),
        ("T_C", "T", "C"),
        ("F_n", "F n", ""),
        ("x in y", "x in y", ""),
        ("tan δ", "tan δ", ""),
        ("tan(δ)", "tan(δ)", ""),
        ("log10(f)", "log10(f)", ""),
        ("log(f) (Hz)", "log(f)", "Hz"),
        ("a (T)", "a (T)", ""),
        ("a (m/s)", "a", "m/s"),
        ("temperatura (T)", "temperatura", "T"),
        ("ω / rad/s", "ω", "rad/s"),
    ],
)
def test_names_and_units_of_headings(text, name, unit):
    assert (heading(text).name, heading(text).unit) == (name, unit)


@pytest.mark.parametrize(
    ("header", "factor"),
    [
        ("t_c,freq_hz,e_storage_mpa,e_loss_mpa", 1.0),
        ("TEMPERATURE (DEGC),FREQUENCY (HZ),STORAGE MODULUS (MPA),LOSS MODULUS (MPA)", 1.0),
        ("T in °C,f in Hz,E' in MPa,E'' in MPa", 1.0),
        ("Temp,Freq,E',E''\nC,hz,PSI,psi", 6894.757293168361e-6),
        ("T [°C],f [Hz],E' [dyn/cm²],E'' [dynes/cm^2]", 1e-7),
        ("T [°C],f [Hz],E' [kgf/mm²],E'' [kgf/mm2]", 9.80665),
        ("T [°C],f [Hz],E' [10^6 Pa],E'' (×10⁶ Pa)", 1.0),
        ("T [°C],f [Hz],E' (E+03 kPa),E'' [10**3 kPa]", 1.0),
        ("T,f,E',E''\n<°C>,<Hz>,<1E5 Pa>,{10⁵ Pa}", 0.1),
        ("Temperature: Deg C,Frequency: Hz,E' {MPa},E'' <MPa>", 1.0),
        ("Температура (°С),Частота (Гц),Модуль накопления (МПа),Модуль потерь (МПа)", 1.0),
        ("T [°C],f [Hz],E' [kgf/cm²],E'' [kp/cm²]", 0.0980665),
        ("T [°C],f [Hz],E' [ksi],E'' [KSI]", 6.894757293168361),
        ("StorageTemp,Temperature (C),Frequency (Hz),StorageModulus (MPa),LossModulus (MPa)", 1.0),
    ],
)
def test_units_without_regard_to_case_and_older_ones(tmp_path, header, factor):
    rows = [f"0,{row}" if header.startswith("StorageTemp") else row for row in ROWS]
    sweeps = read(write(tmp_path, header, *rows))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6 * factor, 6e6 * factor], rel=1e-9)


@pytest.mark.parametrize("unit", ["10^-6 Pa", "×10⁻⁶ Pa", "106 Pa", "10^6"])
def test_powers_of_ten_that_may_be_factors_are_refused(tmp_path, unit):
    with refused("wrong-unit", None, unit):
        read(write(tmp_path, f"T [°C],f [Hz],E' [{unit}],E'' [{unit}]", *ROWS))


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("%", 1e-2),
        ("10⁻³", 1e-3),
        ("x10^-3", 1e-3),
        ("E-3", 1e-3),
        ("‰", 1e-3),
        ("no units", 1.0),
        ("dimensionless", 1.0),
    ],
)
def test_units_of_ratios(tmp_path, unit, factor):
    rows = ["20,1,5,0.1,0.2", "20,10,6,0.1,0.4"]
    sweeps = read(write(tmp_path, f"T_C,f_Hz,E' (MPa),tan δ ({unit}),strain ({unit})", *rows))
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([5e5 * factor, 6e5 * factor], rel=1e-12)
    assert sweeps.isotherms[0].strain_amplitude == pytest.approx([0.2 * factor, 0.4 * factor], rel=1e-12)
    # "(×10³)" may mean that the numbers were multiplied
    assert fraction_of("×10³") is fraction_of("kPa") is None


def test_a_column_of_least_values_is_none_in_minutes():
    assert (heading("COF min").unit, heading("t min").unit, heading("Zeit min").unit) == ("", "min", "min")


@pytest.mark.parametrize("tangent", ["tan(δ)", "tan (delta) (-)", "tan_delta", "Loss-Factor [1]"])
def test_loss_tangent_is_read_in_many_spellings(tmp_path, tangent):
    rows = ["20,1,5,0.1", "20,10,6,0.1"]
    sweeps = read(write(tmp_path, f"T_C,f_Hz,E' (MPa),{tangent}", *rows))
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([5e5, 6e5], rel=1e-12)


def test_case_counts_where_both_spellings_are_units():
    assert unit_conversion("mN", "N")[0] == pytest.approx(1e-3)
    assert unit_conversion("MN", "N")[0] == pytest.approx(1e6)
    assert unit_conversion("mpa", "Pa")[0] == pytest.approx(1e6)
    assert to_rad_per_second("mHz", angular=False) == pytest.approx(2e-3 * math.pi)
    assert to_rad_per_second("RAD/S", angular=True) == 1.0


LAYOUTS = st.fixed_dictionaries(
    {
        "order": st.permutations(range(5)),
        "delimiter": st.sampled_from(["\t", ";", ","]),
        "units": st.sampled_from(["bracket", "slash", "in", "row", "mapped"]),
        "headings": st.lists(st.text("ABCDEFGHxyz_ ()#/'", min_size=1, max_size=12), min_size=5, max_size=5),
        "above": st.lists(st.sampled_from(["", "Sample: A7", "run;2", "# remark, 3", "Operator\tnobody"]), max_size=4),
        "blank": st.lists(st.integers(0, 20), max_size=40),
        "comma": st.booleans(),
        "encoding": st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]),
        "seed": st.integers(0, 10**6),
    }
)


@settings(max_examples=40, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(layout=LAYOUTS)
@pytest.mark.slow
def test_any_layout_gives_the_same_numbers_where_the_user_names_its_columns(tmp_path, layout):
    """Headings without any sense, units anywhere, rows of nothing between: named by place, the numbers come back."""
    random = np.random.default_rng(layout["seed"])
    kelvin = np.repeat([253.15, 293.15, 333.15], 6)
    hertz = np.tile(np.geomspace(0.1, 30.0, 6), 3)
    storage, loss = 10.0 ** random.uniform(0, 3, 18), 10.0 ** random.uniform(-1, 2, 18)
    columns = [kelvin - 273.15, hertz, storage, loss, random.uniform(0, 1, 18)]
    units, names = ["degC", "Hz", "MPa", "MPa", ""], list(NAMES)
    mark, comma = layout["delimiter"], layout["comma"] and layout["delimiter"] != ","
    forms = {"bracket": "{} ({})", "slash": "{} / {}", "in": "{} in {}"}
    headings = [f"q{n}{''.join(text.split(mark))}" for n, text in enumerate(layout["headings"])]
    form = forms.get(layout["units"], "{}")
    shown = [
        form.format(re.sub(r"[^A-Za-z0-9]", "", one), u) if u else one for one, u in zip(headings, units, strict=True)
    ]
    rows = [[f"{column[n]:.9g}" for column in columns] for n in range(18)]
    lines = [mark.join(shown[place] for place in layout["order"])]
    if layout["units"] == "row":
        lines.append(mark.join(units[place] for place in layout["order"]))
    for n, row in enumerate(rows):
        lines += [mark * 4] * layout["blank"].count(n)
        lines.append(mark.join(row[place] for place in layout["order"]).replace(*((".", ",") if comma else ("", ""))))
    path = tmp_path / "any.csv"
    path.write_bytes("\n".join([*layout["above"], *lines]).encode(layout["encoding"]))
    given = layout["units"] == "mapped"
    asked = {
        name: f"#{layout['order'].index(n) + 1}" + (f" ({units[n]})" if given else "") for n, name in enumerate(names)
    }
    sweeps = read_dma(path, deformation="tension", columns=asked)
    assert sweeps.temperatures == pytest.approx([253.15, 293.15, 333.15])
    found = np.concatenate([one.storage_modulus for one in sweeps.isotherms])
    assert found == pytest.approx(1e6 * storage, rel=1e-8)
    assert np.concatenate([one.loss_modulus for one in sweeps.isotherms]) == pytest.approx(1e6 * loss, rel=1e-8)


def test_the_user_gives_a_value_of_all_rows(tmp_path):
    path = write(tmp_path, "f (Hz);T (°C);E' (MPa);E'' (MPa)", "1;;5;0,5", "10;;6;0,7")  # none in its column
    assert read_dma(path, columns={"temperature": "=25,5 degC"}).temperatures == pytest.approx([298.65], rel=1e-12)
    path = write(tmp_path, "f (Hz);E' (MPa);E'' (MPa)", "1;5;0,5", "10;6;0,7")
    sweeps = read_dma(path, columns={"temperature": "=25,5 degC"})
    assert sweeps.temperatures == pytest.approx([298.65], rel=1e-12)
    header = "disc speed (mm/s),ball speed (mm/s),traction force (N)"
    path = write(tmp_path, header, "100,50,2", "60,90,-2", name="runs.csv")
    runs = read_mtm(path, columns={"load": "= 20 N", "temperature": "= 40 degC"})
    assert runs.load == pytest.approx([20.0, 20.0])
    assert runs.temperature == pytest.approx([313.15, 313.15])


@pytest.mark.parametrize(("said", "kelvin"), [("= −10 °C", 263.15), ("= 1,000 K", None), ("=", None)])
def test_minus_signs_and_thousands_of_a_value_of_all_rows(tmp_path, said, kelvin):
    path = write(tmp_path, "E'", "f (Hz);E' (MPa);E'' (MPa)", "1;5;0,5", "10;6;0,7")
    if kelvin is None:
        with refused("wrong-columns"):
            read_dma(path, columns={"temperature": said})
    else:
        assert read_dma(path, columns={"temperature": said}).temperatures == pytest.approx([kelvin])


@pytest.mark.parametrize("mark", ["%", "#", "//"])
@pytest.mark.parametrize("between", [" ", "\t", ", "])
def test_headings_and_units_may_stand_behind_marks_of_remarks(tmp_path, mark, between):
    lines = [["T", "f", "E'", "E''"], ["°C", "Hz", "MPa", "MPa"], ["20", "1", "5", "0.5"], ["20", "10", "6", "0.7"]]
    rows = [between.join(cells) for cells in lines]
    sweeps = vf.read_dma(write(tmp_path, f"{mark} {rows[0]}", f"{mark} {rows[1]}", *rows[2:]))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6], rel=1e-12)


@pytest.mark.parametrize("head", ["T (°C) f (Hz) E' (MPa) E'' (MPa)", "# T [°C] f [Hz] E'[MPa] E'' [MPa]"])
def test_single_blanks_part_headings_with_units_in_brackets(tmp_path, head):
    sweeps = vf.read_dma(write(tmp_path, head, "20 1 5 0.5", "20 10 6 0.7"))
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([5e5, 7e5], rel=1e-12)
    with refused("row-length"):
        vf.read_dma(
            write(tmp_path, "T (°C) f (Hz) storage modulus (MPa) loss modulus (MPa)", "20 1 5 0.5", "20 10 6 1")
        )


def test_a_header_in_a_remark(tmp_path):
    path = write(tmp_path, "# by numpy.savetxt", "# T_C f_Hz E'_MPa E''_MPa", *[row.replace(",", " ") for row in ROWS])
    assert_is_the_table(read_dma(path))


def test_blank_rows_may_outnumber_data(tmp_path):
    blank = [",,,"] * 20 + ["25,,,"] * 20
    path = write(tmp_path, "T_C,f_Hz,E'_MPa,E''_MPa", *blank, *ROWS, *blank)
    sweeps = read_dma(path)
    assert_is_the_table(sweeps)
    assert noted(sweeps.notes, "empty-rows", "40 rows")


def test_a_named_heading_may_not_state_another_temperature_than_the_one_given(tmp_path):
    rows = ["1,10,1,8,0.8", "2,11,1,9,0.9", "3,12,1,10,1"]
    path = write(tmp_path, "f (Hz),E' 25 °C (MPa),E'' 25 °C (MPa),E' 60 °C (MPa),E'' 60 °C (MPa)", *rows)
    named = {"storage_modulus": "E' 60 °C (MPa)", "loss_modulus": "E'' 60 °C (MPa)"}
    with refused("temperatures-contradict"):
        read_dma(path, columns=named, temperature="25 degC")
    sweeps = read_dma(path, columns=named, temperature="60 degC")
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([8e6, 9e6, 10e6])


@pytest.mark.parametrize("other", ["Rotational speed (rpm)", "|COF|", "Applied load (N)", "Test temperature (degC)"])
def test_columns_that_repeat_a_quantity_in_other_terms_are_not_read(tmp_path, other):
    path = write(tmp_path, f"v (mm/s),T (degC),F (N),COF,{other}", "1,20,10,0.2,7", "10,20,10,0.3,8")
    curves = vf.read_friction_curves(path)
    found = (curves.speed[0], curves.temperature[0], curves.load[0], curves.viscoelastic[0])
    assert found == pytest.approx((1e-3, 293.15, 10.0, 0.2))
    assert "unused-columns" in codes(curves.notes)


@pytest.mark.parametrize("text", ["Time min", "Duration, min", "时间 min", "Δt min", "Dauer min"])
def test_times_in_minutes_without_brackets_are_read(text):
    assert heading(text).unit == "min"


@pytest.mark.parametrize("text", ["COF min", "E' min"])
def test_minima_are_not_in_minutes(text):
    assert heading(text).unit == ""
