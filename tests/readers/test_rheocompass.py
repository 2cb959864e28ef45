"""RheoCompass exports: the sweeps among the intervals, in any language and encoding (synthetic files throughout)."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples.rheocompass import ENGLISH, FRENCH, GERMAN, LANGUAGES, SAMPLES, lines
from readers.samples.rubber import points
from viscofric.errors import DataFileError
from viscofric.readers.dma.instruments import rheocompass
from viscofric.readers.source import Source


def written(text, encoding="utf-16", **reported):
    body = text if isinstance(text, str) else "\n".join(text) + "\n"
    return Source("export.csv", body.encode(encoding), **reported)


def table(readings):
    columns = [readings.temperature - 273.15, readings.angular_frequency / (2 * np.pi)]
    columns += [readings.storage_modulus, readings.loss_modulus]
    return np.column_stack(columns)[np.lexsort((readings.angular_frequency, readings.temperature))]


def sweep(rows, columns=("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus"), units=None):
    """Return an export of one interval."""
    units = units or ("[°C]", "[rad/s]", "[Pa]", "[Pa]")
    head = [f"Interval and data points:\t1\t{len(rows)}", "\t".join(["Interval data:", "Point No.", *columns]), "\t"]
    body = ["\t".join(["", str(number), *row]) for number, row in enumerate(rows, start=1)]
    return [*head, "\t".join(["", "", *units]), *body]


ROWS = [["25.0", "1", "1000", "100"], ["25.0", "10", "2000", "200"]]


@pytest.mark.parametrize("name", LANGUAGES)
def test_planted_moduli_come_back_in_every_language(tmp_path, name):
    path = SAMPLES[f"rheocompass {name}"](tmp_path)
    source = Source(str(path), path.read_bytes())
    assert rheocompass.recognises(source)
    readings = rheocompass.read(source)
    assert np.allclose(table(readings), np.array(points()), rtol=1e-7)  # eight digits are printed
    assert np.allclose(readings.strain_amplitude, 1e-3, rtol=1e-12)  # 0.1 %
    assert readings.deformation == "shear"
    assert LANGUAGES[name].strain in readings.said_by
    assert readings.step.tolist() == [0] * 5 + [1] * 5 + [2] * 5


def test_other_intervals_are_passed_over_with_one_note():
    readings = rheocompass.read(written(lines(FRENCH)))
    assert len(noted(readings.notes, "no-frequency-sweep")) == 1
    assert noted(readings.notes, "no-frequency-sweep", "2 intervals")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "utf-8", "utf-8-sig", "cp1252"])
def test_encoding_does_not_matter(encoding):
    body = "\n".join(lines(GERMAN)) + "\n"
    if encoding == "utf-16-be":
        body = "\ufeff" + body
    assert np.allclose(table(rheocompass.read(written(body, encoding))), np.array(points()), rtol=1e-7)


@pytest.mark.parametrize("mark", ["\t", ";"])
def test_delimiter_is_that_of_the_file(mark):
    text = [line.replace("\t", mark) for line in lines(GERMAN)]
    assert np.allclose(table(rheocompass.read(written(text))), np.array(points()), rtol=1e-7)


def test_thousands_are_distinguished_from_decimals():
    english = sweep([["25.0", "1", "1,234.5", "1,000"], ["25.0", "10", "12,345.6", "200"]])
    german = sweep([["25,0", "1", "1.234,5", "1.000"], ["25,0", "10", "12.345,6", "200"]])
    for text in (english, german):
        readings = rheocompass.read(written(text))
        assert readings.storage_modulus.tolist() == [1234.5, 12345.6]
        assert readings.loss_modulus.tolist() == [1000.0, 200.0]


def test_point_and_comma_that_contradict_are_refused():
    with refused("mixed-decimals", 5):
        rheocompass.read(written(sweep([["25.0", "1", "1000,5", "100"], ["25.0", "10", "2000.5", "200"]])))


def test_thousands_that_may_be_decimals_are_refused():
    with refused("mixed-decimals", 5):  # 1.500 may be 1500
        rheocompass.read(written(sweep([["25,0", "1", "1.500", "100"], ["25,0", "10", "1.600", "200"]])))


def test_frequency_in_hertz_is_turned_into_radians():
    columns = ("Temperature", "Frequency", "Storage Modulus", "Loss Modulus")
    readings = rheocompass.read(written(sweep(ROWS, columns, ("[°C]", "[Hz]", "[Pa]", "[Pa]"))))
    assert np.allclose(readings.angular_frequency, [2 * np.pi, 20 * np.pi], rtol=1e-12)


def test_angular_frequency_without_a_unit_is_in_radians():
    readings = rheocompass.read(written(sweep(ROWS, units=("[°C]", "[]", "[Pa]", "[Pa]"))))
    assert readings.angular_frequency.tolist() == [1.0, 10.0]
    assert noted(readings.notes, "frequency-without-unit", "'Angular Frequency'")


@pytest.mark.parametrize(("unit", "factor"), [("[1]", 1.0), ("[%]", 0.01)])
def test_strain_is_a_fraction(unit, factor):
    columns = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Shear Strain")
    rows = [[*row, "0.5"] for row in ROWS]
    readings = rheocompass.read(written(sweep(rows, columns, ("[°C]", "[rad/s]", "[Pa]", "[Pa]", unit))))
    assert np.allclose(readings.strain_amplitude, 0.5 * factor, rtol=1e-12)


def test_names_that_show_no_deformation_leave_it_open():
    assert rheocompass.read(written(sweep(ROWS))).deformation is None


def test_measuring_system_or_torque_says_shear():
    assert rheocompass.read(written(["Measuring system:\tCP50-1", *sweep(ROWS)])).deformation == "shear"
    columns = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Torque")
    rows = [[*row, "0.5"] for row in ROWS]
    readings = rheocompass.read(written(sweep(rows, columns, ("[°C]", "[rad/s]", "[Pa]", "[Pa]", "[mN·m]"))))
    assert readings.deformation == "shear"


AXIAL = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Force")
NEWTON = ("[°C]", "[rad/s]", "[Pa]", "[Pa]", "[N]")


@pytest.mark.parametrize(
    ("head", "column", "unit", "second", "deformation"),
    [
        ([], "Torque", "[mN·m]", ROWS, None),
        (["Measuring system:\tPP25"], "Torque", "[mN·m]", AXIAL, None),
        ([], "Shear Strain", "[%]", AXIAL, None),
        ([], "Shear Strain", "[%]", ROWS, "shear"),
    ],
)
def test_deformation_is_decided_from_all_intervals(head, column, unit, second, deformation):
    columns = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", column)
    rows = [[*row, "0.5"] for row in ROWS]
    first = sweep(rows, columns, ("[°C]", "[rad/s]", "[Pa]", "[Pa]", unit))
    axial = sweep(rows, AXIAL, NEWTON) if second is AXIAL else sweep(ROWS)
    assert rheocompass.read(written([*head, *first, *axial])).deformation == deformation


def test_interval_with_few_usable_points_does_not_refuse_the_others():
    bad = sweep([["30.0", "1", "-5", "100"], ["30.0", "5", "-7", "100"], ["30.0", "10", "2000", "200"]])
    readings = rheocompass.read(written([*sweep([*ROWS, ["25.0", "100", "3000", "300"]]), *bad]))
    assert readings.storage_modulus.tolist() == [1000.0, 2000.0, 3000.0, -5.0, -7.0, 2000.0]


@pytest.mark.parametrize("unit", ["[]", "[°]"])
def test_strain_without_a_known_unit_is_not_read(unit):
    columns = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Shear Strain")
    rows = [[*row, "0.5"] for row in ROWS]
    readings = rheocompass.read(written(sweep(rows, columns, ("[°C]", "[rad/s]", "[Pa]", "[Pa]", unit))))
    assert readings.strain_amplitude is None
    assert len(noted(readings.notes, "strain-amplitude-not-read", "'Shear Strain'")) == 1


@pytest.mark.parametrize("unit", ["[1]", "[-]"])
def test_loss_factor_must_agree_with_the_moduli(unit):
    columns = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Loss Factor")
    text = sweep([[*row, "0.7"] for row in ROWS], columns, ("[°C]", "[rad/s]", "[Pa]", "[Pa]", unit))
    with refused("columns-contradict", None, "0.7"):
        rheocompass.read(written(text))


@pytest.mark.parametrize("times", [("1,234", "2,345"), ("1,5", "2,5"), ("1.5", "2,5")])
def test_columns_that_are_not_needed_may_have_any_separators(times):
    columns = ("Temperature", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Time")
    rows = [[*row, time] for row, time in zip(ROWS, times, strict=True)]
    readings = rheocompass.read(written(sweep(rows, columns, ("[°C]", "[rad/s]", "[Pa]", "[Pa]", "[s]"))))
    assert readings.storage_modulus.tolist() == [1000.0, 2000.0]


def test_tensile_names_are_known():
    columns = ("Temperature", "Angular Frequency", "Tensile Storage Modulus", "Tensile Loss Modulus")
    assert rheocompass.read(written(sweep(ROWS, columns))).deformation == "tension"


def test_temperature_that_was_not_exported_is_asked_for():
    text = sweep(
        [row[1:] for row in ROWS], ("Angular Frequency", "Storage Modulus", "Loss Modulus"), ("[rad/s]", "[Pa]", "[Pa]")
    )
    with refused("no-temperature", None, "interval in line 1"):
        rheocompass.read(written(text))
    assert rheocompass.read(written(text, temperature=300.0)).temperature.tolist() == [300.0, 300.0]


def test_marked_points_and_wave_forms_are_no_points():
    text = sweep([*ROWS, ["25.0", "100", "9", "9"]])
    text[-1] = text[-1].replace("\t3\t", "\t3 (invalide)\t")
    text.insert(-1, "\t\t\t\t\t\t0.1\t0.2")
    readings = rheocompass.read(written(text))
    assert len(readings) == 2
    assert noted(readings.notes, "points-left-out", "1 point", "marked")


def test_point_without_modulus_is_left_out_and_reported():
    readings = rheocompass.read(written(sweep([*ROWS, ["25.0", "100", "", "9"]])))
    assert len(readings) == 2
    assert noted(readings.notes, "points-left-out", "empty", "line 7")


def test_interval_stopped_early_is_reported():
    text = sweep(ROWS)
    text[0] = "Interval and data points:\t1\t20"
    assert noted(rheocompass.read(written(text)).notes, "points-missing", "20 points", "18")


@pytest.mark.parametrize("cut", [3, 8, 200])
def test_file_that_breaks_off_is_refused(cut):
    whole = "\n".join(lines(ENGLISH)).rstrip("\n\t")
    with pytest.raises(DataFileError):
        rheocompass.read(written(whole[: len(whole) - len("\t0.1\tDy_auto") - cut]))


@pytest.mark.parametrize(
    ("row", "refusal"),
    [
        (["-300", "5", "1000", "100"], ("not-positive", 5)),
        (["25.0", "5", "10oo", "100"], ("not-a-number", 5, "'10oo'", "'Storage Modulus'")),
    ],
)
def test_damaged_cell_is_reported(row, refusal):
    with refused(*refusal):
        rheocompass.read(written(sweep([row, *ROWS])))


def test_unit_of_another_kind_is_reported():
    with refused("wrong-unit", None, "interval in line 1", "'Storage Modulus'", "'N'"):
        rheocompass.read(written(sweep(ROWS, units=("[°C]", "[rad/s]", "[N]", "[Pa]"))))
    with refused("wrong-unit", None, "interval in line 1", "'Angular Frequency'", "'Hz'"):
        rheocompass.read(written(sweep(ROWS, units=("[°C]", "[Hz]", "[Pa]", "[Pa]"))))


def test_export_without_sweep_is_refused_with_its_columns():
    with refused("no-frequency-sweep", None, "1", "'Shear Rate'"):
        rheocompass.read(written(sweep(ROWS, ("Temperature", "Shear Rate", "Shear Stress", "Viscosity"))))


def test_interval_without_units_is_refused():
    text = sweep(ROWS)
    del text[3]
    with refused("no-unit", 2):
        rheocompass.read(written(text))
