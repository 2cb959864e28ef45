"""TRIOS exports: genuine rheometer files where they are at hand, and synthetic ones of every layout."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from readers.refusal import noted, refused
from readers.samples import trios
from readers.samples.rubber import points
from viscofric import read_dma
from viscofric.readers.dma.instruments import trios_json, trios_text, universal_analysis
from viscofric.readers.source import Source

POINTS = np.array(points()).T
#: Fifteen digits are printed; a unit is converted.
PRINTED = 1e-13
WRITERS = {
    "lims": trios.write_lims,
    "short": trios.write_short,
    "csv": trios.write_csv,
    "json": trios.write_json,
}


def read(path, **reported):
    found = Source(str(path), path.read_bytes(), **reported)
    ours = [one for one in (universal_analysis, trios_json, trios_text) if one.recognises(found)]
    assert len(ours) == 1
    return ours[0].read(found)


def assert_planted(readings, rows=slice(None)):
    temperature, frequency, storage, loss = (column[rows] for column in POINTS)
    assert readings.temperature == pytest.approx(temperature + 273.15, rel=PRINTED)
    assert readings.angular_frequency == pytest.approx(2 * math.pi * frequency, rel=PRINTED)
    assert readings.storage_modulus == pytest.approx(storage, rel=PRINTED)
    assert readings.loss_modulus == pytest.approx(loss, rel=PRINTED)
    assert readings.strain_amplitude == pytest.approx((0.1 + 0.01 * frequency) / 100, rel=PRINTED)


def test_genuine_frequency_sweep_among_other_techniques(real_data):
    readings = read(real_data / "instruments/trios/multi_technique_LIMS.txt")
    assert len(readings) == 29
    assert readings.deformation == "shear"
    assert "'Oscillation torque'" in readings.said_by
    assert set(readings.step) == {2}
    # the numbers of lines 204 and 205 of the file, MPa and % there
    assert readings.places[:2] == ("line 204", "line 205")
    assert readings.temperature[0] == pytest.approx(273.15 + 25.0062007904053, rel=PRINTED)
    assert readings.angular_frequency[0] == pytest.approx(628.318542480469, rel=PRINTED)
    assert readings.storage_modulus[0] == pytest.approx(0.017995853515625e6, rel=PRINTED)
    assert readings.loss_modulus[0] == pytest.approx(-0.00116959899902344e6, rel=PRINTED)
    assert readings.strain_amplitude[0] == pytest.approx(1.00769631081605e-2, rel=PRINTED)
    assert len(readings.notes) == 1
    assert noted(readings.notes, "no-frequency-sweep", "2 steps", "'Amplitude sweep - 1' and 'Flow ramp - 3'")


def test_genuine_flow_curves_are_refused_with_what_they_hold(real_data):
    steps = "'Peak hold - 1', 'Temperature ramp - 2', 'Temperature ramp - 3' and 'Temperature ramp - 4', without moduli"
    with refused("no-frequency-sweep", None, steps):
        read(real_data / "instruments/trios/trios_short_export.txt")


def test_genuine_strain_sweep_in_json_is_refused_with_what_it_holds(real_data):
    with refused("no-frequency-sweep", None, "'Amplitude - 1'"):
        read(real_data / "instruments/trios/tadatakit_dataset.json")


def test_genuine_json_is_read_to_the_last_digit(real_data):
    text = (real_data / "instruments/trios/tadatakit_dataset.json").read_text(encoding="utf-8")
    renamed = text.replace("Amplitude - 1", "Frequency - 1")  # a strain sweep
    readings = trios_json.read(Source("renamed", renamed.encode()))
    assert readings.storage_modulus == pytest.approx([27083.798828125, 26741.224609375], rel=PRINTED)
    assert readings.strain_amplitude == pytest.approx([2.99004350381438e-5, 3.7615707697114e-5], rel=PRINTED)
    assert readings.deformation == "shear"


@pytest.mark.parametrize("layout", WRITERS)
def test_planted_moduli_are_read_from_every_layout(tmp_path, layout):
    readings = read(WRITERS[layout](tmp_path))
    assert_planted(readings)
    assert readings.deformation == "shear"
    first = 1 if layout == "json" else 2  # after a creep test
    assert readings.step.tolist() == [first] * 5 + [first + 1] * 5 + [first + 2] * 5
    if layout != "json":
        assert len(readings.notes) == 1
        assert noted(readings.notes, "no-frequency-sweep", "1 step", "'Creep - 1'")


@pytest.mark.parametrize("layout", ["lims", "short", "json"])
@pytest.mark.parametrize("unit", ["MPa", "Pa", "kPa", "dyne/cm²"])
def test_unit_of_the_moduli_is_that_of_the_file(tmp_path, layout, unit):
    assert_planted(read(WRITERS[layout](tmp_path, unit=unit)))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_encodings_do_not_matter(tmp_path, encoding):
    assert_planted(read(trios.write_lims(tmp_path, encoding=encoding)))
    assert_planted(read(trios.write_short(tmp_path, encoding=encoding)))


def test_decimal_commas(tmp_path):
    assert_planted(read(trios.write_short(tmp_path, comma=True)))
    assert_planted(read(trios.write_csv(tmp_path, comma=True)))  # quoted
    assert_planted(read(trios.write_csv(tmp_path, comma=True, delimiter=";")))
    path = trios.write_csv(tmp_path, comma=True)
    path.write_text(path.read_text(encoding="utf-8-sig").replace('"', ""), encoding="utf-8")
    with refused("row-length", 20, "'Frequency sweep - 2'", "12 columns"):
        read(path)


#: Names as other formats have them in German.
GERMAN = {
    "Storage modulus": "Speichermodul",
    "Loss modulus": "Verlustmodul",
    "Angular frequency": "Kreisfrequenz",
    "Frequency": "Frequenz",
    "Temperature": "Temperatur",
    "Oscillation strain": "Dehnungsamplitude",
}


def test_columns_are_known_in_the_words_of_all_formats(tmp_path):
    path = trios.write_lims(tmp_path)
    text = path.read_text(encoding="utf-8-sig")
    for name, word in GERMAN.items():
        text = text.replace(f"\t{name}", f"\t{word}")
    path.write_text(text, encoding="utf-8")
    assert_planted(read(path))


@settings(deadline=None, max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(order=st.permutations(list(trios.COLUMNS)), layout=st.sampled_from(["lims", "json"]))
def test_columns_stand_in_any_order(tmp_path, order, layout):
    assert_planted(read(WRITERS[layout](tmp_path, names=tuple(order))))


@pytest.mark.parametrize(
    ("geometry", "deformation", "said_by"),
    [
        ("Tension fixture (rectangle)", "tension", "{} 'Tension fixture (rectangle)'"),
        ("35 mm dual cantilever", "bending", "{} '35 mm dual cantilever'"),
        ("15 mm compression clamp", "compression", "{} '15 mm compression clamp'"),
        ("Shear sandwich", "shear", "{} 'Shear sandwich'"),
        ("25 mm parallel plate", "shear", "{} '25 mm parallel plate'"),
        ("25 mm parallel plate, axial", None, ""),  # plates shear in rotation and compress in axial oscillation
    ],
)
@pytest.mark.parametrize("layout", ["lims", "json"])
def test_geometry_distinguishes_tension_from_shear(tmp_path, layout, geometry, deformation, said_by):
    names = tuple(name for name in trios.COLUMNS if name != "Oscillation torque")
    readings = read(WRITERS[layout](tmp_path, geometry=geometry, names=names))
    assert readings.deformation == deformation
    assert readings.said_by == said_by.format("Name" if layout == "lims" else "Geometry Name")


def test_force_beside_a_torque_leaves_the_deformation_open(tmp_path):
    path = trios.write_lims(tmp_path)
    path.write_bytes(path.read_bytes().replace(b"Step time", b"Oscillation force"))
    assert read(path).deformation is None


def without(path, column, step):
    """Take a column out of one of the steps of an export for LIMS, counted from 0, the creep test."""
    before, *steps = path.read_text(encoding="utf-8-sig").split("[Step]")
    lines = [line.split("\t") for line in steps[step].splitlines()]
    place = next(line.index(column) for line in lines if column in line)
    steps[step] = "\n".join("\t".join(line[:place] + line[place + 1 :]) for line in lines) + "\n"
    path.write_text("[Step]".join([before, *steps]), encoding="utf-8")
    return path


@pytest.mark.parametrize("also", [(), ("Oscillation force",)])
@pytest.mark.parametrize("geometry", ["25.0mm parallel plate", "own"])
def test_steps_in_torsion_do_not_state_the_deformation_of_axial_ones(tmp_path, monkeypatch, geometry, also):
    force = ("N", lambda T, f, a, b: 2.0)
    monkeypatch.setitem(trios.COLUMNS, "Oscillation force", force)
    names = tuple(name for name in trios.COLUMNS if name not in {"Oscillation force"} - {*also})
    path = without(trios.write_lims(tmp_path, geometry=geometry, names=names), "Oscillation torque", 3)
    for step in (1, 2) if also else ():
        without(path, "Oscillation force", step)
    readings = read(path)
    assert_planted(readings)
    assert readings.deformation == ("shear" if "plate" in geometry and not also else None)


def test_step_whose_moduli_are_tensile_contradicts_one_in_torsion(tmp_path):
    path = without(trios.write_lims(tmp_path, geometry="own"), "Oscillation torque", 3)
    before, last = path.read_text(encoding="utf-8").rsplit("[Step]", 1)
    path.write_text(f"{before}[Step]{last.replace('Storage modulus', 'Tensile storage modulus')}", encoding="utf-8")
    with refused("deformation-contradicts"):
        read(path)


@pytest.mark.parametrize("number", ["", "-1.5"])
def test_step_with_few_usable_points_does_not_refuse_the_others(tmp_path, number):
    path = trios.write_lims(tmp_path)
    before, last = path.read_text(encoding="utf-8-sig").rsplit("[Step]", 1)
    storage = 1 + list(trios.COLUMNS).index("Storage modulus")
    lines = [line.split("\t") for line in last.splitlines()]
    for line in [line for line in lines if line[0] == "Data point"][:3]:
        line[storage] = number
    path.write_text(f"{before}[Step]" + "\n".join(map("\t".join, lines)) + "\n", encoding="utf-8")
    sweeps = read_dma(path)
    assert sum(len(one.storage_modulus) for one in sweeps.isotherms) == 12
    assert noted(sweeps.notes, "points-left-out", "3 points")


def test_strain_without_a_unit_is_not_read(tmp_path):
    path = trios.write_lims(tmp_path)
    path.write_text(path.read_text(encoding="utf-8-sig").replace("\t%\t", "\t\t"), encoding="utf-8")
    readings = read(path)
    assert readings.strain_amplitude is None
    assert len(noted(readings.notes, "strain-amplitude-not-read", "'Oscillation strain'")) == 1


def test_several_frequencies_of_an_amplitude_sweep_are_no_frequency_sweep(tmp_path):
    path = trios.write_lims(tmp_path)
    text = path.read_text(encoding="utf-8-sig").replace("Frequency sweep (10.0", "Amplitude sweep (10.0")
    path.write_text(text, encoding="utf-8")
    readings = read(path)
    assert_planted(readings, [k for k in range(15) if POINTS[0][k] != 10.0])
    assert noted(readings.notes, "no-frequency-sweep", "2 steps", "'Creep - 1' and 'Amplitude sweep (10.0 °C)'")


def test_one_step_of_all_temperatures_is_a_sweep_where_it_holds_several_frequencies(tmp_path):
    path = trios.write_lims(tmp_path)
    text = path.read_text(encoding="utf-8-sig").replace("Frequency sweep (", "Temperature sweep (")
    path.write_text(text, encoding="utf-8")
    assert_planted(read(path))

    def one_frequency():
        return [(T, 1.0, a, b) for T, _, a, b in points()]

    path = trios.write_lims(tmp_path, of=one_frequency)
    text = path.read_text(encoding="utf-8-sig").replace("Frequency sweep (", "Temperature ramp (")
    path.write_text(text, encoding="utf-8")
    with refused("no-frequency-sweep", None, "'Temperature ramp (-10.0 °C)'"):
        read(path)


def test_cut_file_says_how_many_points_are_missing(tmp_path):
    path = trios.write_lims(tmp_path)
    text = path.read_text(encoding="utf-8-sig")
    path.write_text(text[: text.rindex("Data point")], encoding="utf-8")
    readings = read(path)
    assert_planted(readings, slice(-1))
    assert noted(readings.notes, "points-missing", "'Frequency sweep (30.0 °C)'", "5 points", "4")


def test_number_torn_at_the_end_of_a_file_is_not_read(tmp_path):
    names = ("Temperature", "Frequency", "Storage modulus", "Oscillation strain", "Loss modulus", "Step time")
    path = trios.write_lims(tmp_path, names=names)
    text = path.read_text(encoding="utf-8-sig").rstrip("\r\n")
    text = text[: text.rindex("\t") - 6]  # within the last loss modulus, which still looks like a number
    path.write_text(text, encoding="utf-8")
    assert float(text[text.rindex("\t") :]) != pytest.approx(POINTS[3][-1], rel=1e-12)
    readings = read(path)
    assert_planted(readings, slice(-1))
    assert noted(readings.notes, "points-left-out", "1 point")


def test_cells_that_are_no_numbers_leave_their_point_out(tmp_path):
    path = trios.write_lims(tmp_path)
    for word in ("inf", "1_000", "0x12", ""):
        lines = path.read_text(encoding="utf-8-sig").split("\n")
        row = next(k for k, line in enumerate(lines) if line.startswith("Data point\t590"))
        cells = lines[row].split("\t")
        cells[1 + list(trios.COLUMNS).index("Storage modulus")] = word
        other = tmp_path / "odd.txt"
        other.write_text("\n".join([*lines[:row], "\t".join(cells), *lines[row + 1 :]]), encoding="utf-8")
        readings = read(other)
        assert_planted(readings, slice(1, None))
        assert any(note.endswith(f": line {row + 1}.") for note in noted(readings.notes, "points-left-out"))


def test_temperature_and_unit_may_be_given_where_the_file_has_none(tmp_path):
    names = tuple(name for name in trios.COLUMNS if name != "Temperature")
    path = trios.write_lims(tmp_path, names=names)
    with refused("no-temperature", None, "'Frequency sweep (-10.0 °C)'", "temperature"):
        read(path)
    assert np.all(read(path, temperature=300.0).temperature == 300.0)
    with refused("temperature-not-needed"):
        read(trios.write_lims(tmp_path), temperature=300.0)
    with refused("unit-not-needed"):
        read_dma(trios.write_lims(tmp_path), modulus_unit="MPa")
    path = trios.write_json(tmp_path)
    bare = tmp_path / "bare.json"
    bare.write_text(path.read_text(encoding="utf-8").replace('"Name": "MPa"', '"Name": ""'), encoding="utf-8")
    with refused("no-unit", None, "'MPa'"):
        read(bare)
    assert_planted(read(bare, modulus_unit="MPa"))


def test_contradicting_frequencies_are_refused(tmp_path):
    path = trios.write_lims(tmp_path)
    path.write_text(path.read_text(encoding="utf-8-sig").replace("Hz", "kHz"), encoding="utf-8")
    with refused("columns-contradict"):
        read(path)


def test_hertz_alone_and_radians_alone_mean_the_same(tmp_path):
    for missing in ("Frequency", "Angular frequency"):
        names = tuple(name for name in trios.COLUMNS if name != missing)
        assert_planted(read(trios.write_lims(tmp_path, names=names)))
        assert_planted(read(trios.write_json(tmp_path, names=names)))


def test_angular_frequency_without_a_unit_is_in_radians(tmp_path):
    path = trios.write_lims(tmp_path)
    path.write_text(path.read_text(encoding="utf-8-sig").replace("rad/s", ""), encoding="utf-8")
    readings = read(path)
    assert_planted(readings)
    assert noted(readings.notes, "frequency-without-unit", "'Angular frequency'")


def test_loss_modulus_may_be_given_by_tan_delta(tmp_path):
    readings = read(trios.write_lims(tmp_path, names=tuple(name for name in trios.COLUMNS if name != "Loss modulus")))
    assert_planted(readings)
    assert noted(readings.notes, "loss-computed")


def test_json_of_original_results_needs_no_note_and_goes_before_processed_ones(tmp_path):
    assert read(trios.write_json(tmp_path, section="Original")).notes == ()
    both = trios.document(section="Original")
    softer = trios.document(of=lambda: [(T, f, a / 2, b / 2) for T, f, a, b in points()])
    both["Results"] |= softer["Results"]
    path = tmp_path / "both.json"
    path.write_text(json.dumps(both), encoding="utf-8")
    readings = read(path)
    assert_planted(readings)
    assert readings.places[0] == "original results, row 1"
    processed = read(trios.write_json(tmp_path))
    assert len(processed.notes) == len(noted(processed.notes, "processed-results")) == 1
    both["Results"]["Original"]["Classification"] = {"Id": "Transformed", "Description": "Data resulting from a change"}
    path.write_text(json.dumps(both), encoding="utf-8")
    assert read(path).notes[0].values == {"description": "Data resulting from a change"}


def test_json_may_lack_what_the_schema_requires(tmp_path):
    document = trios.document()
    path = tmp_path / "odd.json"
    del document["Sample"], document["Schema"]["Url"], document["Operators"]
    document["Results"]["Processed"]["Rows"][3]["A column without header"] = 1.0
    path.write_text(json.dumps(document), encoding="utf-8")
    assert_planted(read(path))
    document["Results"]["Raw"] = document["Results"].pop("Processed")
    path.write_text(json.dumps(document), encoding="utf-8")
    assert_planted(read(path))


def test_columns_of_one_step_of_json_say_nothing_of_another(tmp_path):
    names = tuple(name for name in trios.COLUMNS if name != "Oscillation torque")
    document = trios.document(geometry="own", names=names)
    results = document["Results"]["Processed"]
    one = "a8b61200-ae3f-40a9-831e-899999999999"
    results["ResultsSteps"].append({"Id": one, "Name": "Torque - 4"})
    key = "Oscillation torque_µN.m"
    unit = {"Name": "µN.m"}
    results["ColumnHeaders"][key] = {"DisplayName": "Oscillation torque", "ValueType": "Number", "Unit": unit}
    results["Rows"].append({key: 1.0, "Temperature_°C": 20.0, "Results Step Id": one})
    path = tmp_path / "mixed.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    readings = read(path)
    assert_planted(readings)
    assert readings.deformation is None
    assert noted(readings.notes, "no-frequency-sweep", "'Torque - 4'")


@pytest.mark.parametrize(
    ("change", "refusal"),
    [
        (lambda text: text[: len(text) // 2], ("damaged", 205)),
        (lambda text: text.replace('"Results"', '"Other"'), ("no-points", None, "Original, Raw, Processed")),
        (
            lambda text: text.replace("MPa", "mm"),
            ("wrong-unit", None, "'Storage modulus'", "'Frequency sweep - 1'", "'mm'"),
        ),
        (lambda text: text.replace('"Rows"', '"Lines"'), ("no-frequency-sweep",)),
        (lambda text: '{"TRIOSJSONExportSchema": ' + 100_000 * "[", ("damaged", None, "too deeply")),
    ],
)
def test_broken_json_is_refused_in_one_sentence(tmp_path, change, refusal):
    path = trios.write_json(tmp_path)
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
    with refused(*refusal):
        read(path)


def test_other_tables_and_json_are_not_taken_for_trios():
    for data in (
        b"",
        b"{}",
        b'{"a": 1}',
        b"Filename\n",
        b"T (C),f (Hz),E' (MPa),E'' (MPa)\n1,2,3,4\n",
        b"\xff\xfe\x00",
    ):
        found = Source("other", data)
        assert not any(one.recognises(found) for one in (universal_analysis, trios_json, trios_text))
