"""DMA tables as people write them: read alike whatever their dress, refused clearly where wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from readers.refusal import noted, refused
from readers.written import write
from viscofric import read_mtm
from viscofric.errors import DataFileError
from viscofric.notes import codes, note_of
from viscofric.readers.dma.read import trace_dma

HEADER = "temperature (degC),frequency (Hz),storage modulus (MPa),loss modulus (MPa)"
ROWS = ["20,1,5,0.5", "20,10,6,0.7", "30,1,4,0.4", "30,10,5,0.6"]


def read_dma(*paths, **asked):
    """Read tables that need not say whether they are of tension or of shear."""
    return trace_dma(*paths, **asked).sweeps


def assert_is_the_table(sweeps):
    # Unit conversion is exact to rounding.
    assert sweeps.temperatures == pytest.approx([293.15, 303.15], rel=1e-12)
    for isotherm in sweeps.isotherms:
        assert isotherm.angular_frequency == pytest.approx([2 * math.pi, 20 * math.pi], rel=1e-12)
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6], rel=1e-12)
    assert sweeps.isotherms[1].loss_modulus == pytest.approx([4e5, 6e5], rel=1e-12)


@pytest.mark.parametrize(
    "header",
    [
        HEADER,
        "T_C,f_Hz,storage_MPa,loss_MPa",
        "T [degC],f [Hz],E' [MPa],E'' [MPa]",
        "T / °C,f / Hz,E' / MPa,E\" / MPa",
        "Temperature (°C),Frequency (Hz),Storage Modulus (MPa),Loss Modulus (MPa)",
        "temperature (C),freq (Hz),E′ (N/mm²),E″ (N/mm2)",
    ],
)
def test_headers_are_read_in_many_spellings(tmp_path, header):
    assert_is_the_table(read_dma(write(tmp_path, "# a comment", header, "", *ROWS)))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_encoding_and_delimiter_do_not_matter(tmp_path, encoding, delimiter):
    lines = [line.replace(",", delimiter) for line in ["T (°C),f (Hz),E' (MPa),E'' (MPa)", *ROWS]]
    assert_is_the_table(read_dma(write(tmp_path, *lines, encoding=encoding)))


@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_decimal_commas_are_read_where_the_comma_is_free(tmp_path, delimiter):
    lines = [line.replace(",", delimiter).replace(".", ",") for line in [HEADER, *ROWS]]
    assert_is_the_table(read_dma(write(tmp_path, *lines)))


def test_angular_frequency_is_not_taken_for_hertz(tmp_path):
    rows = ["20,1,5,0.5", "20,10,6,0.7"]
    for heading in ("angular frequency (rad/s)", "omega (1/s)", "frequency (rad/s)"):
        sweeps = read_dma(write(tmp_path, HEADER.replace("frequency (Hz)", heading), *rows))
        assert sweeps.isotherms[0].angular_frequency == pytest.approx([1.0, 10.0], rel=1e-12)
    with refused("wrong-unit", None, "'rad/s'"):
        read_dma(write(tmp_path, HEADER.replace("frequency (Hz)", "angular frequency (Hz)"), *rows))


def test_kelvin_and_fahrenheit_are_absolute_temperatures(tmp_path):
    for heading, value in (("T (K)", "293.15"), ("T (°F)", "68"), ("T (F)", "68")):
        lines = [HEADER.replace("temperature (degC)", heading), f"{value},1,5,0.5", f"{value},2,6,0.6"]
        # 68 °F is 20 °C; only rounding is left
        assert read_dma(write(tmp_path, *lines)).temperatures == pytest.approx([293.15], rel=1e-12)


def test_order_and_repeats_of_rows_do_not_matter_and_are_noted(tmp_path):
    plain = read_dma(write(tmp_path, HEADER, *ROWS))
    shuffled = read_dma(write(tmp_path, HEADER, ROWS[3], ROWS[2], ROWS[1], ROWS[0], ROWS[0]))
    assert_is_the_table(plain)
    assert_is_the_table(shuffled)
    assert len(noted(shuffled.notes, "sorted")) == 2  # rows by frequency, isotherms by temperature
    assert noted(shuffled.notes, "averaged", "1 repeated frequency at 20.0 °C")


def test_many_isotherms_share_one_note(tmp_path):
    rows = [f"{temperature},{f},5,0.5" for temperature in (0.04, -0.04, 10, 20, 30, 40) for f in (2, 1, 1)]
    rows[:6] = ["-0.04,2,5,0.5", "-0.04,1,5,0.5", "-0.04,1,5,0.5"]
    notes = read_dma(write(tmp_path, HEADER, *rows)).notes
    (by_frequency,), (averaged,) = noted(notes, "sorted"), noted(notes, "averaged")
    kelvin = pytest.approx(273.15 + np.array([0.0, 10.0, 20.0, 30.0, 40.0]), abs=0.05)
    assert by_frequency.values["temperatures"] == averaged.values["temperatures"] == kelvin
    assert averaged.values["repeated"] == 5


def test_two_columns_of_frequency_must_agree(tmp_path):
    header = HEADER.replace("frequency (Hz)", "frequency (Hz),angular frequency (rad/s)")
    agreeing = write(tmp_path, header, "20,1,6.28,5,0.5", "20,10,62.8,6,0.7")
    assert read_dma(agreeing).isotherms[0].angular_frequency == pytest.approx([6.28, 62.8], rel=1e-12)
    with refused("columns-contradict", 3, "10", "'frequency (Hz)'"):
        read_dma(write(tmp_path, header, "20,1,6.28,5,0.5", "20,10,10,6,0.7"))


@pytest.mark.parametrize(
    ("header", "rows", "doubt"),
    [
        (HEADER, ["293,1,5,0.5", "313,1,5,0.5"], ("implausible-temperature", "293 to 313", "kelvin")),
        (HEADER, ["253,1,5,0.5", "423,1,5,0.5"], ("implausible-temperature", "253 to 423", "kelvin")),
        (HEADER.replace("degC", "K"), ["20,1,5,0.5", "40,1,5,0.5"], ("implausible-temperature", "20 to 40", "°C")),
        (HEADER.replace("degC", "K"), ["60,1,5,0.5", "100,1,5,0.5"], ("implausible-temperature", "60 to 100", "°C")),
        (HEADER.replace("MPa", "Pa"), ["20,1,0.5,0.1"], ("implausible-modulus", "0.5 Pa", "line 2")),
        # 5 MPa to 1.5 GPa through the transition, in Pa
        (
            HEADER.replace("MPa", "Pa"),
            ["-40,1,1500,30", "0,1,90,80", "20,1,5,0.5"],
            ("implausible-modulus", "5 to 1.5e+03"),
        ),
        (HEADER.replace("MPa", "GPa"), ["20,1,5e5,0.1"], ("implausible-modulus", "'storage modulus (GPa)'")),
    ],
)
def test_what_looks_like_a_wrong_unit_is_noted(tmp_path, header, rows, doubt):
    assert noted(read_dma(write(tmp_path, header, *rows)).notes, *doubt)
    plain = codes(read_dma(write(tmp_path, HEADER, *ROWS)).notes)
    assert not plain & {"implausible-temperature", "implausible-modulus"}


@pytest.mark.parametrize(
    ("glass", "doubtful"),
    [(6.0, False), (2e5, False), (1.5, True), (2e6, True)],  # MPa: a foam, a carbon composite, GPa and kPa as MPa
)
def test_a_glass_is_doubtful_where_its_unit_is_wrong_by_a_thousand(tmp_path, glass, doubtful):
    rows = [f"{celsius},1,{part * glass},{part * loss * glass}" for celsius, part, loss in _TRANSITION]
    assert ("implausible-modulus" in codes(read_dma(write(tmp_path, HEADER, *rows)).notes)) == doubtful


#: °C, E' over that of the glass, tan δ.
_TRANSITION = ((-40, 1.0, 0.02), (0, 0.06, 0.9), (20, 3e-3, 0.1))


def test_repeated_readings_are_averaged(tmp_path):
    sweeps = read_dma(write(tmp_path, HEADER, "20,1,4,0.4", "20,1,6,0.8", "20,2,7,0.9"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 7e6])
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([6e5, 9e5])


def test_isotherms_are_reported_by_gaps_in_measured_temperature(tmp_path):
    sweeps = read_dma(write(tmp_path, HEADER, "19.8,1,5,1", "20.3,2,5,1", "24.9,1,4,1", "25.2,2,4,1"))
    assert sweeps.temperatures - 273.15 == pytest.approx([20.05, 25.05])  # their means


def test_a_loss_modulus_below_zero_is_left_out_and_named(tmp_path):
    sweeps = read_dma(write(tmp_path, HEADER, *ROWS, "30,20,7,-0.1"))
    assert_is_the_table(sweeps)
    assert len(noted(sweeps.notes, "points-left-out")) == 1
    assert noted(sweeps.notes, "points-left-out", "Line 6", "loss modulus", "−1e+05 Pa at 30.0 °C, 20 Hz")
    several = read_dma(write(tmp_path, HEADER, *ROWS, "30,20,7,-0.1", "30,30,7,0"))
    assert_is_the_table(several)
    assert len(noted(several.notes, "points-left-out")) == 1
    assert noted(several.notes, "points-left-out", "2 points", "loss moduli", "lines 6 and 7; at 30.0 °C")


@pytest.mark.parametrize("cell", ["", "---", "-", "NaN", "n/a", "#N/A"])
def test_cells_that_say_there_is_no_number_are_left_out_and_named(tmp_path, cell):
    sweeps = read_dma(write(tmp_path, HEADER, *ROWS, f"30,20,{cell},0.7"))
    assert_is_the_table(sweeps)
    assert noted(sweeps.notes, "points-left-out", "Line 6", "missing")


def test_the_header_says_tension_or_shear(tmp_path):
    shear = HEADER.replace("storage modulus", "G'").replace("loss modulus", "G''")
    assert read_dma(write(tmp_path, shear, *ROWS)).deformation == "shear"
    assert read_dma(write(tmp_path, shear.replace("G", "E"), *ROWS)).deformation == "tension"
    with refused("deformation-contradicts"):
        read_dma(write(tmp_path, shear, *ROWS), deformation="tension")
    with refused("deformation-contradicts"):
        read_dma(write(tmp_path, shear.replace("G''", "E''"), *ROWS))


def test_without_a_word_in_the_file_the_deformation_is_asked_for(tmp_path):
    path = write(tmp_path, HEADER, *ROWS)
    assert read_dma(path, deformation="shear").deformation == "shear"
    assert read_dma(path, deformation="tension").deformation == "tension"
    with pytest.raises(DataFileError, check=lambda error: error.code == "no-deformation"):
        vf.read_dma(path)
    assert not trace_dma(path).deformation_known  # shown with the question
    assert trace_dma(path, deformation="shear").deformation_known
    with refused("wrong-choice", None, "'tension'", "'shear'"):
        read_dma(path, deformation="torsion")


@pytest.mark.parametrize(
    ("lines", "refusal"),
    [
        (
            [HEADER, "20,1,nan,0.5"],
            ("not-a-number", 2, "'nan'", "'storage modulus (MPa)'"),
        ),
        ([HEADER, "20,1,5,0.5", "20,inf,5,0.5"], ("not-a-number", 3, "'inf'")),
        ([HEADER, "20,1,,0.5"], ("empty-cell", 2)),
        ([HEADER, "20,1,1_000,0.5"], ("not-a-number", 2, "'1_000'")),
        ([HEADER, "20,-1,5,0.5"], ("not-positive", 2, "-1")),
        ([HEADER, "-300,1,5,0.5"], ("not-positive", 2)),
        ([HEADER, "20,1,5,-0.5"], ("points-unusable",)),
        ([HEADER], ("no-points",)),
        (
            [HEADER.replace(" (MPa)", ""), *ROWS],
            ("no-unit", None, "'storage modulus'", "'storage modulus (MPa)'"),
        ),
        ([HEADER.replace("(Hz)", "(kg)"), *ROWS], ("wrong-unit", None, "'kg'", "'Hz'", "'rad/s'")),
        ([HEADER.replace("degC", "Pa"), *ROWS], ("wrong-unit", None, "'temperature (Pa)'", "'Pa'")),
        (
            [HEADER.replace("loss modulus", "tan delta"), *ROWS],
            ("missing-columns", None, "loss modulus", "tan delta"),
        ),
        ([HEADER.replace("loss", "storage"), *ROWS], ("ambiguous-columns", None, "storage modulus")),
        (["just text"], ("unknown-format",)),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(tmp_path, lines, refusal):
    path = write(tmp_path, *lines)
    with refused(*refusal) as caught:
        read_dma(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_file_folder_and_binary_are_distinguished(tmp_path):
    with refused("no-file"):
        read_dma(tmp_path / "absent.csv")
    with refused("folder"):
        read_dma(tmp_path)
    (tmp_path / "image.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(256)))
    with refused("unknown-format"):
        read_dma(tmp_path / "image.png")


def test_the_two_kinds_of_table_are_not_mistaken_for_each_other(tmp_path):
    dma = write(tmp_path, HEADER, *ROWS)
    mtm = write(
        tmp_path,
        "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)",
        "30,1,100,90,25,0.4",
        name="mtm.csv",
    )
    with pytest.raises(DataFileError, check=lambda error: error.code == "traction-runs"):
        read_dma(mtm)
    with pytest.raises(DataFileError, check=lambda error: error.code == "dma-sweeps"):
        read_mtm(dma)


def test_real_sweeps_are_read_with_the_bad_point_named(real_data):
    sweeps = read_dma(real_data / "dma" / "acrylic_468mp.csv", deformation="shear")
    assert len(sweeps) == 20
    assert sum(map(len, sweeps.isotherms)) == 339
    assert len(noted(sweeps.notes, "points-left-out", "−40.0 °C, 20 Hz")) == 1


@pytest.mark.parametrize(
    ("names", "units"),
    [
        ("T,f,E_stor,E_loss", "C,Hz,MPa,MPa"),
        ("Temperature,Frequency,Storage modulus,Loss modulus", "[°C],[Hz],[N/mm²],[N/mm²]"),
        ("T,f,E',E''", "degC, Hz, MPa, MPa"),
    ],
)
def test_names_and_units_may_stand_in_two_rows(tmp_path, names, units):
    assert_is_the_table(read_dma(write(tmp_path, names, units, *ROWS)))
    assert_is_the_table(read_dma(write(tmp_path, names, units, *ROWS, encoding="utf-8-sig")))


@pytest.mark.parametrize(
    ("names", "units"),
    [
        (HEADER, "°C,Hz,MPa,MPa"),
        (HEADER, "[C],[HZ],[N/mm²],"),
        ("T,f (Hz),E' (MPa),E'' (MPa)", "°C,,,"),
        ("T,f,E',E'' (MPa)", "°C,Hz,MPa,MPa"),
    ],
)
def test_units_may_stand_in_headings_and_in_the_row_below(tmp_path, names, units):
    assert_is_the_table(read_dma(write(tmp_path, names, units, *ROWS)))


@pytest.mark.parametrize("units", ["°C,Hz,MPa,MPa", "[°C],[Hz],[MPa],[MPa]"])
def test_symbols_may_stand_between_names_and_units(tmp_path, units):
    names = "Temperature,Frequency,Storage modulus,Loss modulus"
    assert_is_the_table(read_dma(write(tmp_path, names, "T,f,E',E''", units, *ROWS)))
    assert_is_the_table(read_dma(write(tmp_path, HEADER, "T,f,E',E''", *ROWS)))


@pytest.mark.parametrize(
    ("units", "refusal"),
    [
        ("°C,Hz,MPa,kPa", ("units-contradict", 2, "'MPa'", "'kPa'")),
        ("°C,rad/s,MPa,MPa", ("units-contradict", 2, "'Hz'", "'rad/s'")),
        ("K,Hz,MPa,MPa", ("units-contradict", 2, "'degC'", "'K'")),
        ("25 °C,1 Hz,5 MPa,1 MPa", ("not-a-number", 2, "'1 Hz'")),  # values, not units
    ],
)
def test_units_in_headings_and_in_the_row_below_must_agree(tmp_path, units, refusal):
    with refused(*refusal):
        read_dma(write(tmp_path, HEADER, units, *ROWS))


@pytest.mark.parametrize(
    "header",
    [
        "Temperatur (°C);Frequenz (Hz);Speichermodul (MPa);Verlustmodul (MPa)",
        "Température (°C);Fréquence (Hz);Module de conservation (MPa);Module de perte (MPa)",
        "Temperatura (°C);Frecuencia (Hz);Módulo de almacenamiento (MPa);Módulo de pérdida (MPa)",
        "Temperatura (°C);Frequenza (Hz);Modulo conservativo (MPa);Modulo dissipativo (MPa)",
        "Temperatura (°C);Frequência (Hz);Módulo de armazenamento (MPa);Módulo de perda (MPa)",
        "Temperatuur (°C);Frequentie (Hz);Opslagmodulus (MPa);Verliesmodulus (MPa)",
        "温度 (°C);频率 (Hz);储能模量 (MPa);损耗模量 (MPa)",
        "样品温度（℃）;测试频率（Hz）;弹性模量E'（MPa）;损耗模量（MPa）",
        "試料温度(℃);測定周波数(Hz);貯蔵弾性率 E'(MPa);損失弾性率 (E'')(MPa)",
        "온도 (°C);주파수 (Hz);저장 탄성률 (MPa);손실탄성률 (MPa)",
        "Sıcaklık (°C);Frekans (Hz);Depolama modülü (MPa);Kayıp modülü (MPa)",
        "Teplota [°C];Frekvence [Hz];Paměťový modul [MPa];Ztrátový modul [MPa]",
        "Temp. [°C];Freq. [Hz];E'-Modul [MPa];E''-Modul [MPa]",
        "Temp., Deg C;Frequency, Hz;Storage Modulus (E'), MPa;Loss Modulus (E''), MPa",
    ],
)
def test_columns_are_known_in_the_users_language(tmp_path, header):
    lines = [header, *(row.replace(",", ";").replace(".", ",") for row in ROWS)]
    assert_is_the_table(read_dma(write(tmp_path, *lines)))
    if header.isascii() or header.encode("latin-1", "ignore").decode("latin-1") == header:
        assert_is_the_table(read_dma(write(tmp_path, *lines, encoding="latin-1")))


def test_logarithms_of_frequencies_beside_these_are_not_read(tmp_path):
    header = "T_C;f (Hz);log f;E' (MPa);E'' (MPa)"
    rows = [f"{T};{f};9;{rest}" for T, f, rest in (row.replace(",", ";").split(";", 2) for row in ROWS)]
    assert_is_the_table(read_dma(write(tmp_path, header, *rows)))


@pytest.mark.parametrize(
    "title", ["Temperature (°C): {}", "Temperature [°C] = {}", "Temperature : {} [°C]", "T,{} (°C)"]
)
def test_the_unit_of_a_title_may_stand_in_brackets(tmp_path, title):
    own = ["f (Hz),E' (MPa),E'' (MPa)", "1,5,0.5", "10,6,0.7"]
    path = write(tmp_path, title.format("20.00"), *own, title.format("-40"), *own)
    assert read_dma(path).temperatures - 273.15 == pytest.approx([-40.0, 20.0])


def test_angular_frequency_is_known_in_the_users_language(tmp_path):
    rows = ["20;1;5;0,5", "20;10;6;0,7"]
    for name in ("Kreisfrequenz", "pulsation", "frecuencia angular"):
        header = f"Temperatur (°C);{name} (rad/s);Speichermodul (MPa);Verlustmodul (MPa)"
        sweeps = read_dma(write(tmp_path, header, *rows))
        assert sweeps.isotherms[0].angular_frequency == pytest.approx([1.0, 10.0], rel=1e-12)


def test_shear_and_tension_are_reported_in_the_users_language(tmp_path):
    header = "Temperatur (°C);Frequenz (Hz);Speicherschubmodul (MPa);Verlustschubmodul (MPa)"
    assert read_dma(write(tmp_path, header, *(row.replace(",", ";") for row in ROWS))).deformation == "shear"


@pytest.mark.parametrize(
    ("names", "row", "computed"),
    [
        ("storage modulus (MPa),tan delta", "8,0.75", True),  # 8, 6, 10: a right triangle
        ("loss modulus (MPa),tan δ", "6,0.75", True),
        ("loss modulus (MPa),tan δ (-)", "6,0.75", True),
        ("|E*| (MPa),loss factor", "10,0.75", True),
        ("storage modulus (MPa),loss modulus (MPa),tan delta", "8,6,0.75", False),
    ],
)
def test_the_loss_tangent_stands_for_a_modulus_that_is_missing(tmp_path, names, row, computed):
    sweeps = read_dma(write(tmp_path, f"T (degC),f (Hz),{names}", f"20,1,{row}", f"20,2,{row}"))
    # exact formulas; rounding only
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([8e6, 8e6], rel=1e-12)
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([6e6, 6e6], rel=1e-12)
    assert bool(codes(sweeps.notes) & {"loss-computed", "storage-computed", "moduli-computed"}) == computed


def degrees(row):
    """Return a row of `ROWS` with |E*| and the loss angle in degrees."""
    T, f, storage, loss = map(float, row.split(","))
    return f"{T},{f},{math.hypot(storage, loss)!r},{math.degrees(math.atan2(loss, storage))!r}"


def test_an_angle_in_another_unit_is_refused_and_a_single_one_beyond_ninety_degrees_left_out(tmp_path):
    rows = [*map(degrees, ROWS), "30,20,6,-0.3"]
    sweeps = read_dma(write(tmp_path, "T (°C),f (Hz),E* (MPa),phase (°)", *rows))
    assert_is_the_table(sweeps)
    with refused("out-of-range", 2):
        read_dma(write(tmp_path, "T (°C),f (Hz),E* (MPa),phase (rad)", *rows))
    with refused("no-unit"):
        read_dma(write(tmp_path, "T (°C),f (Hz),E* (MPa),phase", *rows))


@pytest.mark.parametrize(
    ("header", "base", "assumed"),
    [
        ("T (°C),log f (Hz),log E' (MPa),log E'' (MPa)", 10.0, True),
        ("T (°C),log10(f/Hz),lg(E') (MPa),log10 E'' / MPa", 10.0, False),
        ("T (°C),ln(f/Hz),ln(E' [MPa]),ln E'' (MPa)", math.e, False),
    ],
)
def test_logarithms_of_frequency_and_moduli_are_read(tmp_path, header, base, assumed):
    rows = [[float(cell) for cell in row.split(",")] for row in ROWS]
    lines = [",".join(repr(one) for one in (T, *(math.log(value, base) for value in rest))) for T, *rest in rows]
    sweeps = read_dma(write(tmp_path, header, *lines))
    assert_is_the_table(sweeps)
    assert ("decadic-logarithms" in codes(sweeps.notes)) == assumed


def test_headings_of_rubber_process_analysers_and_metravib_are_known(tmp_path):
    rows = [row.split(",") for row in ROWS]
    in_cycles = [",".join([T, str(60.0 * float(f)), *rest]) for T, f, *rest in rows]
    assert_is_the_table(read_dma(write(tmp_path, "Temp [°C],Freq. [cpm],G' [MPa],G'' [MPa]", *in_cycles)))
    assert_is_the_table(
        read_dma(write(tmp_path, "Temp Cel,Freq Hz,Young modulus E' (MPa),Loss modulus E'' (MPa)", *ROWS))
    )


def test_strain_amplitudes_are_kept_as_fractions(tmp_path):
    rows = [f"{row},{amplitude}" for row, amplitude in zip(ROWS, (0.1, 0.1, 0.1, "---"), strict=True)]
    first, second = read_dma(write(tmp_path, HEADER + ",strain amplitude (%)", *rows)).isotherms
    assert first.strain_amplitude == pytest.approx([1e-3, 1e-3])
    assert second.strain_amplitude == pytest.approx([1e-3, np.nan], nan_ok=True)


def test_lines_above_the_header_are_passed_over_but_not_numbers(tmp_path):
    above = ["Report 12", "Operator;nobody", "Sample, synthetic, 2 mm"]
    assert_is_the_table(read_dma(write(tmp_path, *above, HEADER, *ROWS)))
    with refused("numbers-above-header", 2):
        read_dma(write(tmp_path, "Report 12", ROWS[0], HEADER, *ROWS[1:]))


@pytest.mark.parametrize("blanks", [" ", "   "])
def test_columns_may_be_parted_by_blanks(tmp_path, blanks):
    rows = [f"  {row.replace(',', blanks)}  " for row in ROWS]
    assert_is_the_table(read_dma(write(tmp_path, "T_C f_Hz E'_MPa E''_MPa", *rows)))
    assert_is_the_table(read_dma(write(tmp_path, "T (°C)   f (Hz)   E' (MPa)   E'' (MPa)", *rows)))
    prose = ["We swept the frequency and found the storage modulus", "20 1 5 0.5"]
    with refused("missing-columns", None, "'#4'"):
        read_dma(write(tmp_path, *prose))


def test_the_measured_temperature_counts_before_that_of_the_programme(tmp_path):
    header = HEADER.replace("temperature", "set temperature") + ",temperature (degC)"
    rows = [f"{row},{float(row[:2]) + 1.5}" for row in ROWS]
    assert read_dma(write(tmp_path, header, *rows)).temperatures == pytest.approx([294.65, 304.65])
    assert_is_the_table(read_dma(write(tmp_path, HEADER.replace("temperature", "set temperature"), *ROWS)))


def test_tables_put_one_below_the_other_may_repeat_their_header(tmp_path):
    assert_is_the_table(read_dma(write(tmp_path, HEADER, *ROWS[:2], HEADER, *ROWS[2:])))


def test_a_modulus_without_unit_is_read_in_the_unit_that_is_given(tmp_path):
    bare = HEADER.replace(" (MPa)", "")
    with pytest.raises(DataFileError, check=lambda error: error.code == "no-unit"):
        read_dma(write(tmp_path, bare, *ROWS))
    sweeps = read_dma(write(tmp_path, bare, *ROWS), modulus_unit="MPa")
    assert_is_the_table(sweeps)
    assert noted(sweeps.notes, "modulus-unit-given", "MPa")
    with refused("unit-not-needed"):
        read_dma(write(tmp_path, HEADER, *ROWS), modulus_unit="MPa")
    with refused("wrong-unit", None, "modulus_unit"):
        read_dma(write(tmp_path, bare, *ROWS), modulus_unit="mm")


def test_a_temperature_is_given_or_reported_by_the_name_of_the_file(tmp_path):
    lines = ["frequency (Hz),E' (MPa),E'' (MPa)", "1,5,0.5", "2,6,0.6"]
    reported = read_dma(write(tmp_path, *lines, name="foam_-25C.csv"))
    assert reported.temperatures == pytest.approx([248.15])
    assert noted(reported.notes, "temperature-from-name", "file's")
    given = read_dma(write(tmp_path, *lines, name="foam_30C.csv"), temperature="-25 degC")
    assert given.temperatures == pytest.approx([248.15])
    assert noted(given.notes, "temperature-given")
    for name in ("foam.csv", "foam-25C.csv", "foam_20C_to_30C.csv"):  # none, a minus or a dash, two
        with pytest.raises(DataFileError, check=lambda error: error.code == "no-temperature"):
            read_dma(write(tmp_path, *lines, name=name))
    with refused("temperature-not-needed"):
        read_dma(write(tmp_path, HEADER, *ROWS), temperature="20 degC")


def test_temperatures_may_be_given_for_each_file(tmp_path):
    lines = ["frequency (Hz),E' (MPa),E'' (MPa)", "1,5,0.5", "2,6,0.6"]
    first = write(tmp_path, *lines, name="a.csv")
    second = write(tmp_path, *lines, "3,7,0.7", name="b.csv")
    third = write(tmp_path, HEADER.replace("storage", "tensile storage"), "50,1,5,0.5", "50,2,6,0.6", name="c.csv")
    sweeps = read_dma([first, second], third, temperature=["20 degC", 303.15, None])
    assert sweeps.temperatures == pytest.approx([293.15, 303.15, 323.15])
    for one_for_all in ("20 degC", ["20 degC"]):
        assert read_dma([first, second], temperature=one_for_all).temperatures == pytest.approx([293.15])
    with refused("wrong-count", None, "2 values", "3 files"):
        read_dma(first, second, third, temperature=["20 degC", "30 degC"])
    with refused("looks-like-celsius", None, "'20 degC'"):
        read_dma(first, second, temperature=20)


def test_a_master_curve_is_sent_to_its_own_reader(tmp_path):
    rows = [f"1e{power},5,0.5" for power in range(-6, 6)]
    with pytest.raises(DataFileError, check=lambda error: error.code == "master-curve"):
        read_dma(write(tmp_path, "f (Hz),E' (MPa),E'' (MPa)", *rows, name="foam_20C.csv"))


def test_foam_with_rad_per_s_and_temperatures_in_the_names_of_its_files(real_data):
    files = sorted((real_data / "instruments" / "rad_per_s_tsv").glob("*C.csv"))
    with pytest.raises(DataFileError, check=lambda error: error.code == "no-unit"):
        read_dma(files)
    sweeps = read_dma(files, modulus_unit="MPa", deformation="shear")
    assert len(sweeps) == 19
    assert [len(one) for one in sweeps.isotherms] == [11] * 19
    assert sweeps.temperatures[[0, 1, -1]] - 273.15 == pytest.approx([-35.0, -30.0, 60.0])
    assert sweeps.isotherms[2].angular_frequency[:2] == pytest.approx([0.3, 0.475468])  # at -25 °C
    assert sweeps.isotherms[2].storage_modulus[0] == pytest.approx(77.6574e6)
    assert sweeps.isotherms[2].loss_modulus[0] == pytest.approx(3.57905e6)
    assert len(sweeps.notes) <= 8


def test_the_layout_of_two_rows_of_a_real_file(real_data):
    sweeps = read_dma(real_data / "instruments" / "two_row_csv" / "freq_user_raw.csv")
    assert [len(one) for one in sweeps.isotherms] == [10] * 21
    assert sweeps.deformation == "tension"
    assert sweeps.isotherms[0].angular_frequency[0] == pytest.approx(2 * math.pi * 0.1)
    assert sweeps.isotherms[0].storage_modulus[0] == pytest.approx(8097.175545e6)
    assert sweeps.isotherms[0].loss_modulus[0] == pytest.approx(93.07449045e6)


@pytest.mark.parametrize(
    ("name", "isotherms", "points", "outliers"),
    [
        ("acrylic_468mp", 20, 339, ["2 loss moduli"]),
        ("adhesive_ems_ca", 21, 210, []),
        ("eva_shear", 19, 183, ["2 storage moduli", "2 loss moduli"]),
        ("vinyl_nitrile_foam", 19, 209, ["The loss modulus at −35.0"]),
    ],
)
def test_real_tables_are_read_and_few_of_their_points_are_doubted(real_data, name, isotherms, points, outliers):
    sweeps = read_dma(real_data / "dma" / f"{name}.csv")
    assert len(sweeps) == isotherms
    assert sum(map(len, sweeps.isotherms)) == points
    doubted = noted(sweeps.notes, "outlying-modulus")
    assert len(doubted) == len(outliers)
    assert all(note.startswith(start) for note, start in zip(doubted, outliers, strict=True))


@pytest.mark.parametrize("other", ["E' 2 (MPa)", "temperature 2 (degC)"])
def test_numbered_columns_that_are_not_read_are_named(tmp_path, other):
    """A second sweep beside the first, or a second thermometer."""
    sweeps = read_dma(write(tmp_path, f"{HEADER},{other}", *(f"{row},21" for row in ROWS)))
    assert_is_the_table(sweeps)
    assert noted(sweeps.notes, "unused-columns", repr(other))


@pytest.mark.parametrize(
    "titles",
    [
        ("Temperature: {} °C",) * 2,
        ("T (°C);{}",) * 2,
        ("{} °C; 0,1 %", "Sweep 2 @ {}C"),
    ],
)
@pytest.mark.parametrize("extra", ["", "\n°C;MPa;MPa"])
def test_a_line_above_each_table_gives_its_temperature(tmp_path, titles, extra):
    lines = ["Rubber 7; tested at 23 °C"]
    for title, kelvin in zip(titles, ("-20", "30"), strict=True):
        head = "f;E';E''\nHz;MPa;MPa" if extra else "f (Hz);E' (MPa);E'' (MPa)"
        lines += [title.format(kelvin), head, "0,1;5;0,5", "1;6;0,6", ""]
    sweeps = read_dma(write(tmp_path, *lines))
    assert sweeps.temperatures - 273.15 == pytest.approx([-20.0, 30.0])
    assert "temperature-from-title" in codes(sweeps.notes)
    with refused("no-temperature"):  # one table has none
        read_dma(write(tmp_path, *(line.replace(titles[1].format("30"), "Sweep 2") for line in lines)))


def test_words_above_one_table_are_not_its_temperature(tmp_path):
    lines = ["NBR 70, conditioned at 23 °C", "f (Hz);E' (MPa);E'' (MPa)", "0,1;5;0,5", "1;6;0,6"]
    sweeps = read_dma(write(tmp_path, *lines), temperature="30 degC")
    assert sweeps.temperatures - 273.15 == pytest.approx([30.0])


@pytest.mark.parametrize(
    ("titles", "joined"),
    [
        (("Sample A", "Sample B"), True),
        (("A, 20 °C", "B, 30 °C"), True),
        (("T = 20 °C", "T = 30 °C"), False),
        (("Operator: X", ""), False),  # a header on each page
        (("Rubber 7", "Rubber 7"), False),
        (("Frequency sweep - 1", "Frequency sweep - 2"), False),
        (("Step 1: 20 °C", "Step 2: 30 °C"), False),
        (("Temperature;20", "Temperature;30"), False),
        (("Page 1 of 2; 2026-11-29 10:15", "Page 2 of 2; 2026-11-29 10:16"), False),
    ],
)
def test_tables_with_other_words_above_them_may_be_of_other_specimens(tmp_path, titles, joined):
    parts = [[title, "T (°C);f (Hz);E' (MPa);E'' (MPa)"] for title in titles]
    rows = [["20;1;5;0.5", "20;10;6;0.7"], ["30;1;4;0.4", "30;10;5;0.6"]]
    sweeps = read_dma(write(tmp_path, *parts[0], *rows[0], *parts[1], *rows[1]))
    assert_is_the_table(sweeps)
    assert ("tables-joined" in codes(sweeps.notes)) == joined


@pytest.mark.parametrize(
    ("above", "header"),
    [
        (";20 °C;;30 °C;", "f (Hz);E' (MPa);E'' (MPa);E' (MPa);E'' (MPa)"),
        ("T [K];293,15;;303,15;", "f;E';E'';E';E''\nHz;MPa;MPa;MPa;MPa"),
    ],
)
def test_sweeps_beside_each_other_have_their_temperature_above(tmp_path, above, header):
    rows = ["1;5;0,5;4;0,4", "10;6;0,7;5;0,6"]
    path = write(tmp_path, "Rubber 7", above, header, *rows)
    sweeps = read_dma(path)
    assert_is_the_table(sweeps)
    assert "temperature-from-title" in codes(sweeps.notes)
    short = read_dma(write(tmp_path, above, header, *rows, "100;7;0,8;;"))  # one sweep is longer
    assert [len(one) for one in short.isotherms] == [3, 2]
    for missing in (";sample A;;30 °C;", "Rubber 7"):
        with refused("ambiguous-columns", None, "'#2'"):
            read_dma(write(tmp_path, missing, header, *rows))


@pytest.mark.parametrize(
    "heading",
    [
        *(
            "{} {} °C (MPa)",
            "{} [MPa], {} °C",
            "{}({}°C) [MPa]",
            "{}_{}C_MPa",
            "{} @ {} degC (MPa)",
            "{}(T={}°C) [MPa]",
        ),
        *("{1} °C: {0} (MPa)", "{} {}°C/MPa"),
    ],
)
@pytest.mark.parametrize("order", [(0, 1, 2, 3), (0, 2, 1, 3), (2, 3, 0, 1)])
def test_headings_give_the_temperatures_of_sweeps_beside_each_other(tmp_path, heading, order):
    names = [heading.format(modulus, celsius) for celsius in (20, 30) for modulus in ("E'", "E''")]
    rows = [["5", "0.5", "4", "0.4"], ["6", "0.7", "5", "0.6"]]
    lines = [";".join([f, *(row[place] for place in order)]) for f, row in zip(("1", "10"), rows, strict=True)]
    header = ";".join(["f (Hz)", *(names[place] for place in order)])
    sweeps = read_dma(write(tmp_path, header, *lines))
    assert_is_the_table(sweeps)
    assert "temperature-from-title" in codes(sweeps.notes)
    one = read_dma(write(tmp_path, ";".join(["f (Hz)", *names[:2]]), "1;5;0.5", "10;6;0.7"))
    assert one.temperatures - 273.15 == pytest.approx([20.0])


@pytest.mark.parametrize(
    ("above", "header"),
    [
        (";", "f (Hz);E' 20 °C (MPa);E'' 20 °C (MPa);E' 30 °C (MPa)"),  # one without its E''
        (";", "f (Hz);E' 20 °C (MPa);E'' 20 °C (MPa);E' 30 °C (kPa);E'' 30 °C (kPa)"),
        (";20 °C;;30 °C;;40 °C", "f (Hz);E' (MPa);E'' (MPa);E' (MPa);E'' (MPa);E' (MPa)"),  # one without its E''
        (";20 °C;;;30 °C;", "f (Hz);E' (MPa);E'' (MPa);tan δ;E' (MPa);E'' (MPa)"),  # of the first alone
        (";20 °C;;30 °C;", "f (Hz);E' (MPa);E'' (MPa);G' (MPa);G'' (MPa)"),
        (";20 °C;;30 °C;", "f (Hz);E' (MPa);E'' (MPa);lg E' (MPa);lg E'' (MPa)"),
        (";A, 20 °C;;B, 20 °C;", "f (Hz);E' (MPa);E'' (MPa);E' (MPa);E'' (MPa)"),  # two specimens
    ],
)
def test_what_differs_beside_each_other_is_not_taken_apart(tmp_path, above, header):
    rows = ["1;5;0,5;4;0,4;3", "10;6;0,7;5;0,6;4"]
    cells = header.count(";") + 1
    with pytest.raises(DataFileError) as caught:
        read_dma(write(tmp_path, above, header, *(";".join(row.split(";")[:cells]) for row in rows)))
    assert caught.value.code in {"ambiguous-columns", "deformation-contradicts"}


@pytest.mark.parametrize("words", ["at 3 K/min", "2K-PUR", "(1 and 25 °C)", "- 50 °C"])
def test_headings_with_other_numbers_are_not_understood(tmp_path, words):
    with refused("dash-or-minus" if words == "- 50 °C" else "missing-columns"):
        read_dma(write(tmp_path, f"f (Hz);E' {words} (MPa);E'' {words} (MPa)", "1;5;0.5", "10;6;0.7"))


def test_a_file_of_two_components_is_not_as_cold_as_two_kelvin(tmp_path):
    with refused("no-temperature"):
        read_dma(write(tmp_path, "f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "10;6;0.7", name="PUR_2K.csv"))


@pytest.mark.parametrize(
    "lines",
    [
        ["f (Hz);E' 20 °C (MPa);E'' 20 °C (MPa);E' 30 °C (MPa);E'' 30 °C (MPa)", "1;5;0.5;4;0.4", "10;6;0.7;5;0.6"],
        ["T = 20 °C", "f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "T = 30 °C", "f (Hz);E' (MPa);E'' (MPa)", "1;4;0.4"],
        # One of two tables states none, and was read at 25 °C with the other.
        ["T = 20 °C", "f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "later", "f (Hz);E' (MPa);E'' (MPa)", "1;4;0.4"],
    ],
)
def test_a_given_temperature_does_not_replace_those_of_the_file(tmp_path, lines):
    with refused("temperature-not-needed"):
        read_dma(write(tmp_path, *lines), temperature="25 degC")
    with pytest.raises(DataFileError) as caught:
        read_dma(write(tmp_path, *lines), columns={"temperature": "= 25 degC"})
    assert caught.value.code in {"value-not-needed", "missing-columns"}


@pytest.mark.parametrize(
    ("header", "celsius"),
    [
        ("f (Hz);-25 °C E' (MPa);-25 °C E'' (MPa);25 °C E' (MPa);25 °C E'' (MPa)", [-25.0, 25.0]),
        (
            "f (Hz);E' (T = - 25 °C) [MPa];E'' (T = - 25 °C) [MPa];E' (T = 25 °C) [MPa];E'' (T = 25 °C) [MPa]",
            [-25.0, 25.0],
        ),
        ("f (Hz);E' 25 °C (MPa);E'' 25 °C (MPa);E' 40 °C (MPa);tan δ 60 °C", None),
        ("f (Hz);E' 25 °C (MPa);E'' 25 °C (MPa);E' - 40 °C (MPa);E'' - 40 °C (MPa)", None),
    ],
)
def test_no_temperature_of_a_heading_is_lost(tmp_path, header, celsius):
    path = write(tmp_path, header, "1;5;0.5;4;0.4", "10;6;0.7;5;0.6")
    if celsius is None:
        with pytest.raises(DataFileError):
            read_dma(path)
    else:
        assert read_dma(path).temperatures - 273.15 == pytest.approx(celsius)


def test_a_side_column_of_another_temperature_is_not_read(tmp_path):
    header = "f (Hz);E' 25 °C (MPa);tan d 25 °C;E' 40 °C (MPa);tan d 40 °C;tan d 60 °C"
    sweeps = read_dma(write(tmp_path, header, "1;5;0.5;4;0.4;0.3", "10;6;0.7;5;0.6;0.3"))
    assert sweeps.temperatures - 273.15 == pytest.approx([25.0, 40.0])


def test_a_dash_between_blanks_is_no_minus_sign_above_a_table(tmp_path):
    lines = [["NR - 25 °C", "NR – 40 °C"], "f (Hz);E' (MPa);E'' (MPa)"]
    sweeps = read_dma(write(tmp_path, lines[0][0], lines[1], "1;5;0.5", lines[0][1], lines[1], "1;4;0.4"))
    assert sweeps.temperatures - 273.15 == pytest.approx([25.0, 40.0])


def test_titled_columns_beside_plain_ones_are_not_read(tmp_path):
    header = "f (Hz);E' (MPa);E'' (MPa);E' 40 °C (MPa);E'' 40 °C (MPa)"
    sweeps = read_dma(write(tmp_path, header, "1;5;0.5;4;0.4", "10;6;0.7;5;0.6"), temperature="25 degC")
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6])
    side = write(tmp_path, "f (Hz);E' (MPa);E'' (MPa);strain 25 °C (%)", "1;5;0.5;1", "10;6;0.7;1", name="x_40C.csv")
    assert read_dma(side).temperatures - 273.15 == pytest.approx([40.0])


def test_a_temperature_in_a_heading_does_not_count_beside_a_column_of_temperatures(tmp_path):
    rows = ["20;1;5;0.5;9", "20;10;6;0.7;9", "30;1;4;0.4;9", "30;10;5;0.6;9"]
    assert_is_the_table(read_dma(write(tmp_path, "T (°C);f (Hz);E' (MPa);E'' (MPa);E' 25 °C (MPa)", *rows)))


@pytest.mark.parametrize("unit", ["%", "-", "gon"])
def test_a_phase_angle_is_in_degrees_or_radian(tmp_path, unit):
    with pytest.raises(DataFileError) as caught:
        read_dma(write(tmp_path, f"T (°C),f (Hz),|E*| (MPa),delta ({unit})", "20,1,5,0.1", "20,2,6,0.1"))
    assert caught.value.code in {"wrong-unit", "no-unit"}


@pytest.mark.parametrize(
    ("heading", "degrees"),
    [("phase angle (°)", True), ("δ [deg]", True), ("Phasenwinkel (Grad)", True), ("delta (rad)", False)],
)
def test_the_phase_angle_stands_for_the_loss_tangent(tmp_path, heading, degrees):
    rows = []
    for T, f, storage, loss in (map(float, row.split(",")) for row in ROWS):
        angle = np.arctan2(loss, storage)
        rows.append(f"{T},{f},{np.hypot(storage, loss):.17g},{np.degrees(angle) if degrees else angle:.17g}")
    assert_is_the_table(read_dma(write(tmp_path, f"T (°C),f (Hz),|E*| (MPa),{heading}", *rows)))
    with refused("no-unit"):
        read_dma(write(tmp_path, "T (°C),f (Hz),|E*| (MPa),delta", *rows))


def test_means_of_other_quantities_are_not_read(tmp_path):
    header = "T (°C),f (Hz),mean strain (%),E' (MPa),E'' (MPa)"  # static, not the amplitude
    rows = [",".join([T, f, "10", *rest]) for T, f, *rest in (row.split(",") for row in ROWS)]
    sweeps = read_dma(write(tmp_path, header, *rows))
    assert_is_the_table(sweeps)
    assert all(one.strain_amplitude is None for one in sweeps.isotherms)


def test_means_are_noted_and_need_no_column_of_temperature(tmp_path):
    rows = [",".join(row.split(",")[1:]) for row in ROWS[:2]]
    path = write(tmp_path, "f (Hz),E' mean (MPa),E'' mean (MPa)", *rows)
    sweeps = vf.read_dma(path, temperature=293.15)
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6])
    assert "means-read" in codes(sweeps.notes)


def test_columns_of_means_count_where_there_are_no_others(tmp_path):
    header = "T (°C),f (Hz),E' mean (MPa),E' std (MPa),Mean E'' (MPa),E'' std (MPa)"
    rows = [",".join([T, f, storage, "9", loss, "9"]) for T, f, storage, loss in (row.split(",") for row in ROWS)]
    assert_is_the_table(read_dma(write(tmp_path, header, *rows)))
    both = f"{HEADER},average storage modulus (MPa)"
    assert_is_the_table(read_dma(write(tmp_path, both, *(f"{row},9" for row in ROWS))))


def test_words_that_may_tell_specimens_apart_are_named(tmp_path):
    rows = [f"{row},{word}" for row, word in zip(ROWS, "ABAB", strict=True)]
    sweeps = read_dma(write(tmp_path, f"{HEADER},sample", *rows))
    assert noted(sweeps.notes, "unused-columns", "'sample'", "'A' and 'B'")
    for words in ("AAAA", "A  A", "ABCD"):  # one specimen, and remarks
        rows = [f"{row},{word}" for row, word in zip(ROWS, words, strict=True)]
        assert "unused-columns" not in codes(read_dma(write(tmp_path, f"{HEADER},sample", *rows)).notes)


@pytest.mark.parametrize("heading", ["Specimen No.", "样品名称", "试样编号", "試料名", "試験片番号", "시편"])
def test_specimens_at_the_same_temperature_and_frequency_are_not_averaged(tmp_path, heading):
    both = [f"{row},{word}" for word in ("A", "B") for row in ROWS]
    with pytest.raises(vf.DataFileError) as caught:
        read_dma(write(tmp_path, f"{HEADER},{heading}", *both))
    assert caught.value.code == "several-specimens"
    repeated = read_dma(write(tmp_path, f"{HEADER},Specimen No.", *(f"{row},A" for row in ROWS * 2)))
    assert "averaged" in codes(repeated.notes)


@pytest.mark.parametrize(
    ("headings", "kind"),
    [
        ("J' (1/GPa),J'' (1/GPa)", "shear"),
        ("D' (1/GPa),D'' (1/GPa)", "tension"),
        ("D'' (1/GPa),tan δ", "tension"),
        ("storage compliance (1/GPa),loss factor (%)", "tension"),
    ],
)
def test_compliances_are_read_as_the_moduli_of_their_inverse(tmp_path, headings, kind):
    rows = []
    for row in ROWS:
        T, f, storage, loss = map(float, row.split(","))
        J = 1e3 / complex(storage, loss)  # 1/GPa
        of = {"J'": J.real, "D'": J.real, "storage compliance": J.real, "J''": -J.imag, "D''": -J.imag}
        of |= {"tan δ": loss / storage, "loss factor": 100 * loss / storage}
        rows.append(",".join([repr(T), repr(f), *(repr(of[one.split(" (")[0]]) for one in headings.split(","))]))
    sweeps = vf.read_dma(
        write(tmp_path, f"T (°C),f (Hz),{headings}", *rows),
        deformation="tension" if headings.startswith("storage") else None,
    )
    assert sweeps.deformation == kind
    assert "moduli-computed" in codes(sweeps.notes)
    assert_is_the_table(sweeps)


@pytest.mark.parametrize(
    "header",
    [
        "T (deg. C),F (Hz),Module élastique E' (MPa),Module visqueux E'' (MPa)",
        "温度（℃）,频率（Ｈｚ）,E'（MPa）,E''（MPa）",
    ],
)
def test_symbols_behind_names_and_wide_brackets_are_read(tmp_path, header):
    assert_is_the_table(read_dma(write(tmp_path, header, *ROWS)))


@pytest.mark.parametrize("page", ["gb18030", "cp932"])
def test_headings_in_code_pages_of_east_asia_are_read(tmp_path, page):
    path = tmp_path / "table.csv"
    frequency = {"gb18030": "频率", "cp932": "周波数"}[page]
    path.write_bytes("\n".join([f"温度 (K),{frequency} (Hz),E' (MPa),E'' (MPa)", *_in_kelvin()]).encode(page))
    assert_is_the_table(read_dma(path))


def _in_kelvin():
    cells = (row.split(",", 1) for row in ROWS)
    return [f"{float(celsius) + 273.15},{rest}" for celsius, rest in cells]


def test_two_columns_of_strain_amplitude_are_named(tmp_path):
    sweeps = read_dma(write(tmp_path, f"{HEADER},strain (%),dynamic strain (%)", *(f"{row},1,2" for row in ROWS)))
    assert sweeps.isotherms[0].strain_amplitude == pytest.approx([0.02, 0.02])  # not the static one
    sweeps = read_dma(write(tmp_path, f"{HEADER},strain (%),deformation (%)", *(f"{row},1,2" for row in ROWS)))
    assert "strain-amplitude-not-read" in codes(sweeps.notes)
    assert all(isotherm.strain_amplitude is None for isotherm in sweeps.isotherms)


@pytest.mark.parametrize("heading", ["LN2 chamber temperature (°C)", "LOGGED temperature (°C)", "lgr T (°C)"])
def test_names_of_the_user_that_begin_like_logarithms_are_none(tmp_path, heading):
    path = write(tmp_path, HEADER.replace("temperature (degC)", heading), *ROWS)
    assert_is_the_table(read_dma(path, columns={"temperature": heading}))


HEADING = "T (°C);f (Hz);E' (MPa);E'' (MPa)"


@pytest.mark.parametrize("header", [[HEADING], []])
@pytest.mark.parametrize("titles", [("Sample A", "Sample B"), ("Specimen: NR;", "Specimen: SBR;"), ("", "Sample B;;;")])
def test_specimens_below_each_other_are_not_averaged(tmp_path, titles, header):
    rows = ["20;1;5;0.5", "20;10;6;0.7"]
    with refused("several-specimens", None, "Sample B" if "SBR" not in titles[1] else "SBR"):
        read_dma(write(tmp_path, titles[0], HEADING, *rows, titles[1], *header, *rows))
    with refused("several-specimens"):  # the temperature stands nearer
        own = ["f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "10;6;0.7"]
        read_dma(write(tmp_path, "Sample A", "T = 20 °C", *own, "Sample B", "T = 20 °C", *own))


@pytest.mark.parametrize(
    "titles",
    [
        ("up", "down"),
        ("Sweep up", "Sweep down"),
        ("NR, forward", "NR, reverse"),
        ("Run 1 (up)", "Run 2 (down)"),
        ("aufwärts", "abwärts"),
    ],
)
def test_sweeps_up_and_down_are_of_one_specimen(tmp_path, titles):
    rows = ["20;1;5;0.5", "20;10;6;0.7"]
    sweeps = read_dma(write(tmp_path, titles[0], HEADING, *rows, titles[1], HEADING, *reversed(rows)))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6])
    assert {"measured-again", "averaged"} <= set(codes(sweeps.notes))
    with refused("several-specimens", None, "'NR'", "'SBR'"):
        read_dma(write(tmp_path, "NR up", HEADING, *rows, "SBR down", HEADING, *rows))


def test_a_title_keeps_the_brackets_of_its_specimen(tmp_path):
    own = ["f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "10;6;0.7"]
    titles = ("Sample A (fresh) 20 °C", "Sample B [aged] (20 °C)")
    with refused("several-specimens", None, "'Sample A (fresh)'", "'Sample B [aged]'"):
        read_dma(write(tmp_path, titles[0], *own, titles[1], *own))


@pytest.mark.parametrize("words", [("Frequency sweep 1",), ("Run 1", "Strain 0.1 %")])
def test_other_lines_beside_that_of_the_temperature_leave_tables_as_they_are(tmp_path, words):
    own = ["f (Hz);E' (MPa);E'' (MPa)", "1;5;0.5", "10;6;0.7"]
    for before, after in ((words, ()), ((), words), (words, words)):
        lines = [line for T in (20, 40) for line in (*before, f"Temperature {T} °C", *after, *own)]
        assert read_dma(write(tmp_path, *lines)).temperatures - 273.15 == pytest.approx([20.0, 40.0])


def test_lines_of_words_between_rows_state_their_temperature(tmp_path):
    rows = [f"{f};{5 + n};0.5" for n, f in enumerate((1, 10, 100))]
    for second in ("T = 40 °C", "Temperature: 40 °C;;", "Temperature (°C);40"):
        path = write(tmp_path, "T = 20 °C", "f (Hz);E' (MPa);E'' (MPa)", *rows, second, *rows)
        assert read_dma(path).temperatures - 273.15 == pytest.approx([20.0, 40.0])


def test_a_temperature_in_the_first_row_of_a_block_holds_for_all_of_it(tmp_path):
    rows = [f"{T if n == 0 else ''};{f};{5 + n};0.5" for T in (20, 40) for n, f in enumerate((1, 10, 100))]
    sweeps = read_dma(write(tmp_path, HEADING, *rows))
    assert sweeps.temperatures - 273.15 == pytest.approx([20.0, 40.0])
    assert "value-spread" in codes(sweeps.notes)
    with refused("points-unusable"):  # a reading now and then, of a ramp
        read_dma(write(tmp_path, HEADING, *(";".join([row.split(";")[0], "1", *row.split(";")[2:]]) for row in rows)))
    with refused("points-unusable"):  # whose are the first rows?
        read_dma(write(tmp_path, HEADING, *[f";{row.partition(';')[2]}" for row in rows[:2]], *rows[2:]))


def test_a_second_heading_is_refused_where_it_begins(tmp_path):
    second = "f (Hz);T (°C);E' (MPa);E'' (MPa)"
    with refused("several-tables", 3):
        read_dma(write(tmp_path, HEADING, "20;1;5;0.5", second, "1;30;4;0.4"))
    again = [HEADING, "20;1;5;0.5", "20;10;6;0.7", HEADING.replace(" ", "  "), "30;1;4;0.4", "30;10;5;0.6"]
    assert_is_the_table(read_dma(write(tmp_path, *again)))


@pytest.mark.parametrize("heading", ["E' (mPa)", "E' [mPa]", "E'_mPa"])
def test_moduli_in_millipascals_are_in_megapascals(tmp_path, heading):
    sweeps = read_dma(write(tmp_path, HEADING.replace("E' (MPa)", heading), "20;1;5;0.5", "20;10;6;0.7"))
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e6, 6e6])
    assert "unit-assumed" in codes(sweeps.notes)


def test_a_loss_tangent_in_per_cent_without_its_unit_is_seen(tmp_path):
    heading, rows = "T (°C);f (Hz);E' (MPa);tan delta", ["20;1;5;10", "20;10;6;12"]
    with refused("no-unit", None, "'tan delta (%)'"):
        read_dma(write(tmp_path, heading, *rows))
    assert read_dma(write(tmp_path, f"{heading} (-)", *rows)).isotherms[0].loss_modulus == pytest.approx([50e6, 72e6])
    beside = read_dma(write(tmp_path, f"{HEADING};tan delta", "20;1;5;0.5;10", "20;10;6;0.72;12"))
    assert beside.isotherms[0].loss_modulus == pytest.approx([0.5e6, 0.72e6])


@pytest.mark.parametrize(
    ("storage", "tangent"),
    [
        ("Modulus E' (MPa)", "tg δ"),
        ("Ep (MPa)", "tg delta"),
        ("E prime (MPa)", "tanδ"),
        ("貯蔵弾性率E'(MPa)", "損失正接tanδ"),
        ("E' 貯蔵弾性率 (MPa)", "tan δ 損失正接"),
        ("Young modulus E' (MPa)", "loss factor"),
        ("module d'Young E' (MPa)", "tan d"),
    ],
)
def test_symbols_stand_beside_words_of_any_script(tmp_path, storage, tangent):
    rows = ["20;1;5;0.1", "20;10;6;0.2"]
    sweeps = read_dma(write(tmp_path, f"T (°C);f (Hertz);{storage};{tangent}", *rows))
    assert sweeps.deformation == "tension"
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([0.5e6, 1.2e6])


def test_a_column_that_may_be_the_temperature_is_asked_for(tmp_path):
    lines = ["Upper Temp. [°C];f (Hz);G' (kPa);G'' (kPa)", "60;1;5;0.5", "60;10;6;0.7"]
    path = write(tmp_path, *lines, name="rubber_25C.csv")
    for what_to_do in ("'Upper Temp. [°C]'", "give temperature = "):
        with refused("missing-columns", None, what_to_do):
            read_dma(path)
    named = read_dma(path, columns={"temperature": "Upper Temp. [°C]"})
    assert named.temperatures - 273.15 == pytest.approx([60.0])
    assert read_dma(path, temperature="62 degC").temperatures - 273.15 == pytest.approx([62.0])


@pytest.mark.parametrize(
    ("head", "columns"),
    [
        (["f (Hz),E' (MPa),f (Hz),E'' (MPa)"], {}),
        (["f1 (Hz),E' (MPa),f2 (Hz),E'' (MPa)"], {}),
        (["f (Hz),E' (MPa),f 2 (Hz),E'' (MPa)"], {}),
        (["f1 (Hz),E' (MPa),f2 (Hz),E'' (MPa)"], {"frequency": "f1 (Hz)"}),
        (["E',,E'',", "X,Y,X,Y"], {"frequency": "#1 (Hz)", "storage_modulus": "#2 (MPa)", "loss_modulus": "#4 (MPa)"}),
    ],
)
def test_digitised_curves_of_both_moduli_may_have_their_own_frequencies(tmp_path, head, columns):
    first, second = np.logspace(-2.0, 2.0, 9), np.logspace(-1.9, 2.1, 17)
    curves = [[f"{f:.9g},{2.0 * f**0.2:.9g}" for f in first], [f"{f:.9g},{0.7 * f**0.3:.9g}" for f in second]]
    rows = [f"{curves[0][n] if n < len(first) else ','},{right}" for n, right in enumerate(curves[1])]
    sweeps = read_dma(write(tmp_path, *head, *rows), temperature="20 degC", columns=columns)
    assert "curves-interpolated" in codes(sweeps.notes)
    one = sweeps.isotherms[0]
    frequency = one.angular_frequency / (2.0 * math.pi)
    assert frequency == pytest.approx(first[1:], rel=1e-8)  # the first one is below those of E''
    # Power laws are straight lines between logarithms.
    assert one.storage_modulus == pytest.approx(2e6 * frequency**0.2, rel=1e-8)
    assert one.loss_modulus == pytest.approx(7e5 * frequency**0.3, rel=1e-8)


def test_each_of_three_digitised_curves_may_have_its_own_frequencies(tmp_path):
    f = np.logspace(-1.0, 2.0, 13)
    columns = zip(f, 2.0 * f**0.2, 1.1 * f, (1.1 * f) ** 0.3, 1.2 * f, 0.5 * (1.2 * f) ** 0.1, strict=True)
    lines = [
        "f (Hz),E' (MPa),f (Hz),E'' (MPa),f (Hz),tan δ",
        *(",".join(map(repr, map(float, row))) for row in columns),
    ]
    one = read_dma(write(tmp_path, *lines), temperature="20 degC").isotherms[0]
    frequency = one.angular_frequency / (2.0 * math.pi)
    assert frequency == pytest.approx(f[1:], rel=1e-8)
    assert one.loss_modulus == pytest.approx(1e6 * frequency**0.3, rel=1e-8)  # tan δ agrees, or it would be refused


@pytest.mark.parametrize(
    ("header", "columns"),
    [
        ("f storage (Hz),E' (MPa),f loss (Hz),E'' (MPa)", {"frequency": "f storage (Hz)"}),
        ("f (Hz),E' (MPa),f loss (Hz),E'' (MPa)", {}),
        ("f (Hz),E' (MPa),ω (rad/s),E'' (MPa)", {"frequency": "f (Hz)"}),
        ("f1 (Hz),f2 (Hz),E' (MPa),E'' (MPa)", {}),
        ("f (Hz),E' (MPa),E'' (MPa),f2 (Hz)", {}),
    ],
)
def test_frequencies_of_which_some_may_be_those_of_another_modulus_are_refused(tmp_path, header, columns):
    with refused("ambiguous-columns"):
        read_dma(
            write(tmp_path, header, *(f"{f},5,{1.5 * f},0.5" for f in (1, 2, 4))),
            temperature="20 degC",
            columns=columns,
        )
    behind = "E' (MPa),f (Hz),E'' (MPa),f (Hz)"
    with refused("ambiguous-columns"):
        read_dma(write(tmp_path, behind, "5,1,0.5,2", "6,2,0.7,4"), temperature="20 degC", columns={"frequency": "#2"})


@pytest.mark.parametrize(("given", "missing"), [(None, ["frequency", "temperature"]), ("20 degC", ["frequency"])])
def test_a_missing_frequency_is_named_first_and_a_given_temperature_is_not(tmp_path, given, missing):
    with pytest.raises(DataFileError) as caught:
        read_dma(write(tmp_path, "x,E' (MPa),E'' (MPa)", "1,5,0.5", "2,6,0.7"), temperature=given)
    assert (caught.value.code, caught.value.note.values["missing"]) == ("missing-columns", missing)


def test_points_of_a_digitised_curve_that_are_not_above_zero_are_counted(tmp_path):
    rows = [f"{f},2,{1.1 * f},{0.0 if f == 10 else 0.5}" for f in (1, 3, 10, 30, 100)]
    sweeps = read_dma(write(tmp_path, "f (Hz),E' (MPa),f (Hz),E'' (MPa)", *rows), temperature="20 degC")
    (note,) = [one for one in map(note_of, sweeps.notes) if one.code == "curves-interpolated"]
    assert note.values["not_positive"] == 1


def test_points_that_may_part_thousands_are_refused(tmp_path):
    def lines(mark):
        return [f"20;{f};{1500 + 400 * f:,};{100 + 300 * f:,}".replace(",", mark) for f in (1, 2, 3, 5, 7)]

    head = "T (°C);f (Hz);E' (kPa);E'' (kPa)"
    with refused("ambiguous-decimals"):
        read_dma(write(tmp_path, head, *lines(".")))
    plain, decided = (read_dma(write(tmp_path, head, *some)) for some in (lines(""), [*lines("."), "20;9;5.000.000;1"]))
    assert decided.isotherms[0].storage_modulus[:5] == pytest.approx(plain.isotherms[0].storage_modulus, rel=1e-12)


@pytest.mark.parametrize(
    ("mark", "head", "noted"), [(";", 1.0, True), ("\t", 1.0, True), (",", 1.0, False), (";", 0.1, False)]
)
def test_points_that_are_all_before_three_digits_are_noted(tmp_path, mark, head, noted):
    rows = [(f, f"{12.345 + f:.3f}", f"{head * (1.234 + f):.3f}") for f in (1, 2, 3, 5)]  # "0.223" is no thousand
    lines = [mark.join(map(str, row)) for row in [("f (Hz)", "E' (MPa)", "E'' (MPa)"), *rows]]
    sweeps = read_dma(write(tmp_path, *lines), temperature="20 degC")
    assert sweeps.isotherms[0].storage_modulus[0] == pytest.approx(13.345e6, rel=1e-12)
    assert ("decimals-assumed" in codes(sweeps.notes)) == noted


@pytest.mark.parametrize(("heading", "noted"), [("tan δ", True), ("tan δ (-)", False)])
def test_a_large_loss_tangent_without_a_unit_is_noted(tmp_path, heading, noted):
    rows = [f"{f},5,{1.1 + 0.1 * f:.3g}" for f in (1, 2, 4)]
    sweeps = read_dma(write(tmp_path, f"f (Hz),E' (MPa),{heading}", *rows), temperature="20 degC")
    assert sweeps.isotherms[0].loss_modulus == pytest.approx([6e6, 6.5e6, 7.5e6], rel=1e-12)
    assert ("tangent-without-unit" in codes(sweeps.notes)) == noted


@pytest.mark.parametrize("unit", ["MHZ", "mhz"])
def test_a_unit_of_either_milli_or_mega_is_asked_for(tmp_path, unit):
    with refused("wrong-unit"):
        read_dma(write(tmp_path, f"T (°C),f ({unit}),E' (MPa),E'' (MPa)", *ROWS))


def test_digitised_curves_of_a_ramp_may_have_their_own_temperatures(tmp_path):
    kelvin = np.arange(-40.0, 40.0, 2.0)
    rows = [f"{T},{math.exp(-0.05 * T):.9g},{T + 1},{math.exp(-0.02 * (T + 1)):.9g}" for T in kelvin]
    path = write(tmp_path, "T (°C),E' (MPa),T (°C),E'' (MPa)", *rows)
    for named in ({}, {"temperature": "#1"}):
        ramps = vf.read_ramps(path, columns={"frequency": "= 1 Hz", **named})
        assert "curves-interpolated" in codes(ramps.notes)
        ramp = ramps.ramps[0]
        # Exponentials are straight lines in log E'' over T.
        assert ramp.loss_modulus == pytest.approx(1e6 * np.exp(-0.02 * (ramp.temperature - 273.15)), rel=1e-8)


def test_curves_of_several_temperatures_with_frequencies_of_their_own_are_refused(tmp_path):
    rows = [f"{T},{f},5,{1.5 * f},0.5" for T in (20, 40) for f in (1, 10, 100)]
    path = write(tmp_path, "T (°C),f (Hz),E' (MPa),f (Hz),E'' (MPa)", *rows)
    for columns in (None, {"frequency": "#2"}):
        with refused("ambiguous-columns", None, '"E\' (MPa)" and "E\'\' (MPa)"'):
            read_dma(path, columns=columns)


def test_moduli_in_different_units_by_mistake_are_noted(tmp_path):
    sweeps = read_dma(write(tmp_path, "T (°C),f (Hz),E' (MPa),E'' (Pa)", *ROWS))
    assert "implausible-loss" in codes(sweeps.notes)


def test_a_second_column_of_a_modulus_that_is_not_read_is_noted(tmp_path):
    rows = [f"{row},7,300" for row in ROWS]
    sweeps = read_dma(write(tmp_path, f"{HEADER},storage modulus corrected (MPa),stress (kPa)", *rows))
    assert_is_the_table(sweeps)
    assert noted(sweeps.notes, "unused-columns", "'storage modulus corrected (MPa)';")


def test_measured_temperatures_count_before_those_of_the_programme(tmp_path):
    lines = ["Target temperature (°C),Measured temperature (°C),f (Hz),E' (MPa),E'' (MPa)"]
    assert_is_the_table(read_dma(write(tmp_path, *lines, *(f"99,{row}" for row in ROWS))))


@pytest.mark.parametrize("name", ["EPDM 70 - 20 °C.csv", "EPDM-20C.csv"])
def test_a_name_with_a_dash_before_its_temperature_is_not_read(tmp_path, name):
    path = write(tmp_path, "f (Hz),E' (MPa),E'' (MPa)", "1,5,0.5", "10,6,0.7", name=name)
    with refused("no-temperature", None, repr(path.stem)):
        read_dma(path)
