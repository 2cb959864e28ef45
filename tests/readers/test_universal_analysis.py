"""Universal Analysis files of a Q800: synthetic ones, since no genuine DMA file of this layout is at hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from readers.refusal import noted, refused
from readers.samples import universal_analysis as q800
from readers.samples.rubber import points
from viscofric.errors import DataFileError
from viscofric.readers.dma.instruments import trios_json, trios_text, universal_analysis
from viscofric.readers.source import Source

POINTS = np.array(points()).T
#: Text is printed with nine digits.
PRINTED = 1e-8
#: Records hold single precision.
SINGLE = 2e-7


def source(path):
    return Source(str(path), path.read_bytes())


def read(path):
    found = source(path)
    assert universal_analysis.recognises(found)
    assert not trios_json.recognises(found)
    assert not trios_text.recognises(found)
    return universal_analysis.read(found)


def assert_planted(readings, rel, rows=slice(None)):
    temperature, frequency, storage, loss = (column[rows] for column in POINTS)
    # a temperature in kelvin adds 273.15 to what is printed
    assert readings.temperature == pytest.approx(temperature + 273.15, rel=rel)
    assert readings.angular_frequency == pytest.approx(2 * math.pi * frequency, rel=rel)
    assert readings.storage_modulus == pytest.approx(storage, rel=rel)
    assert readings.loss_modulus == pytest.approx(loss, rel=rel)
    assert readings.strain_amplitude == pytest.approx(np.full(len(temperature), q800.STRAIN / 100), rel=rel)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8", "utf-8-sig", "latin-1", "utf-16-le"])
@pytest.mark.parametrize("comma", [False, True])
def test_text_is_read_in_every_encoding_and_decimal_mark(tmp_path, encoding, comma):
    readings = read(q800.write_text(tmp_path, encoding=encoding, comma=comma))
    assert_planted(readings, PRINTED)
    assert readings.format == "TA Instruments Universal Analysis text"
    assert readings.step is None


def test_binary_records_are_read_up_to_the_negative_time(tmp_path):
    readings = read(q800.write_binary(tmp_path))
    assert_planted(readings, SINGLE)
    assert readings.format == "TA Instruments Q800 binary"
    assert readings.places[-1] == f"record {len(POINTS[0])}"
    assert readings.notes == ()


@settings(deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(order=st.permutations(q800.SIGNALS[1:]), binary=st.booleans())
def test_order_of_signals_is_taken_from_the_header(tmp_path, order, binary):
    signals = ("Time (min)", *order)
    write = q800.write_binary if binary else q800.write_text
    assert_planted(read(write(tmp_path, signals=signals)), SINGLE if binary else PRINTED)


def test_signals_are_known_in_other_languages(tmp_path):
    path = q800.write_text(tmp_path, encoding="utf-8")
    text = path.read_text(encoding="utf-8")
    german = {"Time (": "Zeit (", "Storage Modulus": "Speichermodul", "Loss Modulus": "Verlustmodul"}
    german |= {"Frequency (": "Frequenz (", "Temperature (": "Temperatur (", "Strain (": "Dehnung ("}
    for name, word in german.items():
        text = text.replace(name, word)
    path.write_text(text, encoding="utf-8")
    assert_planted(read(path), PRINTED)


def test_empty_cells_and_tabs_at_the_end_of_rows_do_no_harm(tmp_path):
    lines = q800.text_lines(events=())
    start = lines.index("StartOfData") + 1
    emptied = [line[: line.rindex("\t") + 1] for line in lines[start:]]  # the last signal is the position
    for rows in (emptied, [line + "\t" for line in lines[start:]]):
        path = tmp_path / "tabs.txt"
        path.write_text("\n".join([*lines[:start], *rows]), encoding="utf-8")
        readings = read(path)
        assert_planted(readings, PRINTED)
        assert readings.notes == ()


def test_rows_of_negative_time_are_events_and_no_points(tmp_path):
    readings = read(q800.write_text(tmp_path, events=(0, 5, 10)))
    assert_planted(readings, PRINTED)
    assert len(readings.notes) == len(noted(readings.notes, "events", "3 rows")) == 1
    # the event stands on the line before the sixth point: points 5 and 6 are two lines apart
    lines = [int(place.removeprefix("line ")) for place in readings.places]
    assert np.diff(lines).tolist() == [1, 1, 1, 1, 2, 1, 1, 1, 1, 2, 1, 1, 1, 1]
    printed = q800.text_lines(events=(0, 5, 10))
    assert printed[lines[0] - 1].split("\t")[1] == "-10"


@pytest.mark.parametrize(
    ("clamp", "deformation"),
    [
        ("Clamp: Tension: Film", "tension"),
        ("Clamp: Shear Sandwich", "shear"),
        ("Clamp: Dual Cantilever", "bending"),
        ("Clamp: Single Cantilever", "bending"),
        ("Clamp: 3-Point Bending", "bending"),
        ("Clamp: Compression", "compression"),
        ("no word of it", None),
    ],
)
def test_clamp_distinguishes_tension_from_shear(tmp_path, clamp, deformation):
    readings = read(q800.write_text(tmp_path, clamp=clamp))
    assert readings.deformation == deformation
    assert readings.said_by == (f"Xcomment {clamp!r}" if deformation else "")


def test_loss_modulus_may_be_given_by_tan_delta(tmp_path):
    signals = [name for name in q800.SIGNALS if not name.startswith("Loss")]
    readings = read(q800.write_text(tmp_path, signals=signals))
    assert_planted(readings, 3 * PRINTED)  # two printed numbers are multiplied
    assert noted(readings.notes, "loss-computed")


def test_units_are_those_of_the_header(tmp_path):
    lines = [line.replace("Modulus (MPa)", "Modulus (GPa)") for line in q800.text_lines()]
    path = tmp_path / "gpa.txt"
    path.write_text("\n".join(lines), encoding="utf-8")
    assert read(path).storage_modulus == pytest.approx(1e3 * POINTS[2], rel=PRINTED)
    path.write_text("\n".join(lines).replace("(GPa)", "(mm)"), encoding="utf-8")
    with refused("wrong-unit", None, "'Storage Modulus'", "'mm'", "'MPa'"):
        read(path)


def test_torn_last_row_is_left_out_and_noted(tmp_path):
    text = "\n".join(q800.text_lines(events=()))
    path = tmp_path / "torn.txt"
    path.write_text(text[: text.rindex("\t") - 3], encoding="utf-8")
    readings = read(path)
    assert_planted(readings, PRINTED, slice(-1))
    assert len(readings.notes) == 1
    assert noted(readings.notes, "cut-short", f"line {text.count(chr(10)) + 1}")


def test_torn_record_is_left_out_and_noted(tmp_path):
    path = q800.write_binary(tmp_path, closed=False)
    whole = path.read_bytes()
    assert noted(read(path).notes[:1], "cut-short")
    path.write_bytes(whole[:-3])
    readings = read(path)
    assert_planted(readings, SINGLE, slice(-1))
    assert len(readings.notes) == len(noted(readings.notes, "cut-short", f"Record {len(POINTS[0])}")) == 1


def test_records_behind_an_event_of_a_binary_file_are_reported(tmp_path):
    path = q800.write_binary(tmp_path, footer=b"")
    later = np.full(3 * len(q800.SIGNALS), 50.0, dtype="<f4")  # later than the last time, as data would be
    path.write_bytes(path.read_bytes() + later.tobytes())
    readings = read(path)
    assert_planted(readings, SINGLE)
    assert [note.values["records"] for note in noted(readings.notes[:1], "records-behind-end")] == [3]


def test_letters_that_look_like_the_end_of_the_header_are_passed_over(tmp_path):
    letters = "\u0d05\u0a00\u0c00\u0100"  # their bytes hold the marker, one byte off
    assert b"\r\0\n\0\f\0" in letters.encode("utf-16-le")
    assert_planted(read(q800.write_binary(tmp_path, method=letters)), SINGLE)


def test_points_that_do_not_oscillate_are_left_out_and_noted(tmp_path):
    lines = q800.text_lines(events=())
    cells = lines[-2].split("\t")
    cells[q800.SIGNALS.index("Frequency (Hz)")] = "0.0000000"
    lines[-2] = "\t".join(cells)
    cells = lines[-4].split("\t")
    cells[q800.SIGNALS.index("Loss Modulus (MPa)")] = "----"
    lines[-4] = "\t".join(cells)
    path = tmp_path / "idle.txt"
    path.write_text("\n".join(lines), encoding="utf-8")
    readings = read(path)
    n = len(POINTS[0])
    assert_planted(readings, PRINTED, [k for k in range(n) if k not in (n - 2, n - 4)])
    assert len(readings.notes) == 1
    assert noted(readings.notes, "points-left-out", "2 points")
    assert readings.notes[0].endswith(f"line {len(lines) - 3} and line {len(lines) - 1}.")


def test_negative_moduli_are_handed_on_as_printed(tmp_path):
    def negative():
        return [(*row[:3], -row[3]) if k == 3 else row for k, row in enumerate(points())]

    for path in (q800.write_text(tmp_path, of=negative), q800.write_binary(tmp_path, of=negative)):
        assert read(path).loss_modulus[3] == pytest.approx(-POINTS[3][3], rel=SINGLE)


def test_one_frequency_is_no_sweep_whatever_the_method_is_called(tmp_path):
    def ramp():
        return [(-50.0 + k, 1.0, 1e9, 1e8) for k in range(40)]

    with refused("no-frequency-sweep", None, "'Frequency ramp'"):
        read(q800.write_text(tmp_path, of=ramp, method="Frequency ramp"))
    # nor is a sweep none because the user's method has a name of another technique
    assert_planted(read(q800.write_text(tmp_path, method="small amplitude")), PRINTED)


def test_file_of_another_instrument_says_what_it_holds(tmp_path):
    signals = ("Time (min)", "Temperature (°C)", "Static Force (N)")
    with refused("missing-columns", None, "DMA Q800 V21.1 Build 51", "Time, Temperature, Static Force"):
        read(q800.write_text(tmp_path, signals=signals))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.replace("Nsig\t12", "Nsig\tmany"), "'Nsig many'; it must give the number of signals"),
        (lambda text: text.replace("Nsig\t12\n", ""), "no line 'Nsig'"),
        (lambda text: text.replace("Nsig\t12", "Nsig\t99"), "states 99 signals but has no line 'Sig13'"),
        (lambda text: text.replace("Sig1\tTime (min)", "Sig1\tIndex"), "the first signal is 'Index'"),
        (lambda text: text[: text.index("StartOfData")], "has no line 'StartOfData'"),
        (lambda text: text[: text.index("Nsig")], "has no line 'StartOfData'"),
        (lambda text: text.replace("StartOfData", "StartOfData\n1.0\t2.0"), "the row has 2 cells"),
        (lambda text: text.replace("\t0.0523", "\t0,0523"), "has a point, but other numbers of the file have a comma"),
        (lambda text: text[: text.index("StartOfData") + 11], "no frequency sweep"),
    ],
)
def test_broken_files_are_refused_in_one_sentence(tmp_path, change, message):
    path = tmp_path / "broken.txt"
    path.write_text(change("\n".join(q800.text_lines())), encoding="utf-8")
    with pytest.raises(DataFileError) as caught:
        read(path)
    assert message in str(caught.value)
    assert str(path) in str(caught.value)
