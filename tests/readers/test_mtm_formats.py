"""Traction tests in binary files, in workbooks, with the words of an EHD rig, and in reduced tables."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples import pcs_binary
from readers.samples.workbook import write as write_workbook
from viscofric import read_mtm


@pytest.mark.parametrize("etm", [False, True])
def test_a_binary_file_is_read_like_its_text_export(tmp_path, etm):
    runs = read_mtm(pcs_binary.write(tmp_path, etm=etm, comments="long " * 60))
    assert runs.disc_speed == pytest.approx([0.110, 0.090, 0.210, 0.190, 0.110])
    assert runs.ball_speed == pytest.approx([0.090, 0.110, 0.190, 0.210, 0.090])
    assert runs.traction_force == pytest.approx([1.5, -0.7, 1.4, -0.8, 1.3])
    assert runs.load == pytest.approx(np.full(5, 25.0))
    assert runs.temperature - 273.15 == pytest.approx([30.1, 30.1, 30.2, 30.2, 30.1])
    assert runs.zero_force == pytest.approx(np.full(5, 0.25))
    assert runs.track_radius == pytest.approx(np.full(5, 0.021))
    assert [step.kind for step in runs.steps if step.readings] == ["Stribeck", "Timed"]
    assert runs.steps[1].started == "23/03/2018 10:11:45"
    assert noted(runs.notes, "steps-without-traction", "2 Mapper")


def test_a_torn_or_unknown_binary_file_is_refused_with_what_to_do(tmp_path):
    whole = pcs_binary.write(tmp_path).read_bytes()
    path = tmp_path / "torn.mtmd"
    path.write_bytes(whole[:-20])
    with refused("damaged"):
        read_mtm(path)
    head = pcs_binary.header(1)
    path.write_bytes(head + pcs_binary.step(7, "bidirectional", pcs_binary.with_ecr(pcs_binary.PAIRS)))
    with refused("damaged"):
        read_mtm(path)
    path.write_bytes(b"\x07" + whole[1:])
    with refused("unknown-format"):
        read_mtm(path)


EXPORT = """EHD2 Test Data File
Step 1 "film" started at 23/03/2018 10:10:45
Step type	Film	Step description	film
Rolling Speed (mm/s)	Average Film (nm)	Lube Temp (degC)
100	50	30

Step 2 "traction" started at 23/03/2018 10:11:45
Step type	Traction	Step description	slip
Zero traction force (N)	0.1467	(measured at the start of this step)
Rolling Speed (mm/s)	Traction Coeff (-)	Lube Temp (degC)	Pot Temp (degC)	Ball Load (N)	Ball Speed 1	Ball Speed 2	Disc Speed 1	Disc Speed 2	Traction Force 1 (N)	Traction Force 2 (N)	Traction Force (N)
100	0.044	30.1	30.2	25	90	110	110	90	1.5	-0.7	1.1
200	0.044	30.2	30.2	25	190	210	210	190	1.4	-0.8	1.1
"""  # noqa: E501 - a line of an export


def test_words_of_an_ehd_rig(tmp_path):
    path = tmp_path / "ehd.txt"
    path.write_text(EXPORT, encoding="utf-8")
    runs = read_mtm(path)
    assert runs.traction_force == pytest.approx([1.5, -0.7, 1.4, -0.8])
    assert runs.disc_speed == pytest.approx([0.110, 0.090, 0.210, 0.190])
    assert noted(runs.notes, "steps-without-traction", "1 Film")


@pytest.mark.slow
def test_an_export_saved_as_a_workbook(tmp_path):
    path = tmp_path / "ehd.txt"
    path.write_text(EXPORT, encoding="utf-8")

    def cell(text):
        try:
            return float(text)
        except ValueError:
            return text

    rows = [[cell(one) for one in line.split("\t")] for line in EXPORT.splitlines()]
    book = write_workbook(tmp_path / "ehd.xlsx", {"ehd": rows})
    known, found = read_mtm(path), read_mtm(book)
    for name in ("disc_speed", "ball_speed", "traction_force", "load", "temperature", "zero_force"):
        assert np.array_equal(getattr(known, name), getattr(found, name)), name
    twice = write_workbook(tmp_path / "two.xlsx", {"a": rows, "b": rows})
    with refused("several-tables"):
        read_mtm(twice)
    assert len(read_mtm(twice, sheet="b")) == len(known)


def test_a_reduced_table_of_rolling_speed_ratio_and_coefficient(tmp_path):
    header = "temperature (degC),load (N),rolling speed (mm/s),SRR (%),traction coefficient"
    rows = ["30,25,100,20,0.044", "30,25,100,-20,0.040", "30,25,200,10,0.05", "30,25,200,0,0.001"]
    path = tmp_path / "reduced.csv"
    path.write_text("\n".join([header, *rows]), encoding="utf-8")
    runs = read_mtm(path)
    assert runs.disc_speed == pytest.approx([0.110, 0.090, 0.210])
    assert runs.ball_speed == pytest.approx([0.090, 0.110, 0.190])
    assert runs.traction_force == pytest.approx([1.1, -1.0, 1.25])
    assert noted(runs.notes, "speeds-from-slip")
    assert noted(runs.notes, "traction-unsigned", "1 row")


def test_a_reduced_table_with_signs_and_sliding_speed(tmp_path):
    header = "T (degC),load (N),entrainment speed (mm/s),sliding speed (mm/s),traction coeff (-)"
    rows = ["30,25,100,20,0.044", "30,25,100,-20,-0.020", "30,25,200,0,0.001"]
    path = tmp_path / "reduced.csv"
    path.write_text("\n".join([header, *rows]), encoding="utf-8")
    runs = read_mtm(path)
    assert runs.disc_speed == pytest.approx([0.110, 0.090, 0.200])
    assert runs.traction_force == pytest.approx([1.1, -0.5, 0.025])
    assert noted(runs.notes, "traction-unsigned") == []


def test_columns_of_a_reduced_table_are_named(tmp_path):
    path = tmp_path / "reduced.csv"
    path.write_text("T (degC),load (N),U,S,mu\n30,25,100,20,0.044\n30,25,100,-20,0.04\n", encoding="utf-8")
    columns = {"rolling_speed": "U (mm/s)", "slide-to-roll ratio": "S (%)", "traction_coefficient": "mu"}
    assert read_mtm(path, columns=columns).disc_speed == pytest.approx([0.110, 0.090])


@pytest.mark.parametrize(
    ("header", "missing"),
    [
        ("T (degC),load (N),rolling speed (mm/s),traction force (N)", ["slide to roll ratio"]),
        ("T (degC),load (N),disc speed (mm/s),traction force (N)", ["ball speed"]),
        ("T (degC),rolling speed (mm/s),SRR (%),traction coefficient", ["load"]),
        ("T (degC),load (N),rolling speed (mm/s),SRR (%)", ["traction force"]),
    ],
)
def test_what_a_reduced_table_lacks_is_named(tmp_path, header, missing):
    path = tmp_path / "reduced.csv"
    path.write_text("\n".join([header, "30,25,100,20", "30,25,200,20"]), encoding="utf-8")
    with refused("missing-columns") as caught:
        read_mtm(path)
    assert caught.value.note.values["missing"] == missing
