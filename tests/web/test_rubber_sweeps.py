"""What the page says of files of sweeps: what they were taken for, what they hold, what was flagged, what is asked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import viscofric as vf
from refusals import refused
from viscofric import read_dma
from viscofric.web.jobs import recognise
from viscofric.web.jobs.context import Context, JobError
from web.rubber_workspace import EXAMPLE, SWEEPS, done, workspace_with

HERTZ = np.geomspace(0.1, 10.0, 9)


@pytest.fixture
def workspace(tmp_path: Path) -> Context:
    return workspace_with(tmp_path, EXAMPLE)


def table(head: str, temperatures: tuple[float, ...] = (20.0, 30.0), spoil: dict[int, str] | None = None) -> str:
    """Return a text table of a smooth rubber in MPa; rows of `spoil` have another storage modulus."""
    rows = []
    for celsius in temperatures:
        for hertz in HERTZ:
            storage = 10.0 * hertz**0.2 * 10.0 ** (-0.01 * celsius)
            stored = (spoil or {}).get(len(rows), f"{storage:.6g}")
            cells = [f"{celsius:g}"] if "T" in head else []
            rows.append(",".join([*cells, f"{hertz:.6g}", stored, f"{0.1 * storage:.6g}"]))
    return "\n".join([head, *rows, ""])


def test_synthetic_example_is_reported_as_the_reader_takes_it(workspace: Context) -> None:
    found = done("sweeps", workspace, {"dma": "dma.csv"})
    sweeps = read_dma(EXAMPLE)
    assert found["source"] == "dma"
    assert found["notes"] == list(sweeps.notes)
    assert [one["name"] for one in found["files"]] == ["dma.csv"]
    assert found["files"][0]["format"] == "delimited text"
    assert found["files"][0]["deformation"] == "tension"
    assert found["files"][0]["readings"] == sum(len(one) for one in sweeps.isotherms) == 442
    assert found["reference"] == 303.15
    assert found["left_open"] == []
    assert found["flagged"] == []
    for reported, read in zip(found["isotherms"], sweeps.isotherms, strict=True):
        # numbers are sent with six digits
        np.testing.assert_allclose(reported["angular_frequency"], read.angular_frequency, rtol=5e-6)
        np.testing.assert_allclose(reported["loss_tangent"], read.loss_modulus / read.storage_modulus, rtol=5e-6)


@pytest.mark.parametrize(
    ("remark", "made_up"),
    [
        ("# SYNTHETIC data", True),
        ("# data: synthetic", True),
        ("# SYNTHETIC: friction of an assumed material", True),
        ("# a synthetic rubber, measured", False),
        ("", False),
    ],
)
def test_sweeps_that_say_that_they_were_made_up_are_called_synthetic(
    workspace: Context, remark: str, made_up: bool
) -> None:
    rows = table("T (degC),f (Hz),E' (MPa),E'' (MPa)")
    (workspace.files / "own.csv").write_text(f"{remark}\n{rows}")
    job = recognise.Options(files=["own.csv"])
    assert recognise.run({}, job, workspace) == {"kinds": {"dma": ["own.csv"]}, "synthetic": made_up}


def test_left_out_readings_and_outliers_are_flagged_with_their_place(workspace: Context) -> None:
    text = table("T (degC),f (Hz),E' (MPa),E'' (MPa)", (20.0, 30.0, 40.0), {3: "-1", 13: "60"})
    (workspace.files / "spoilt.csv").write_text(text)
    found = done("sweeps", workspace, {"dma": "spoilt.csv"})
    left_out, outlier = found["flagged"]
    assert left_out["why"] == "left out"
    assert left_out["place"] == "line 5"
    assert left_out["storage_modulus"] == -1e6
    assert found["left_out"] == 1
    assert "storage modulus" in outlier["why"]
    assert outlier["place"] == "line 15"
    assert outlier["storage_modulus"] == 60e6


def test_tension_or_shear_is_asked_where_no_file_says_it(workspace: Context) -> None:
    (workspace.files / "plain.csv").write_text(table("T (degC),f (Hz),storage modulus (MPa),loss modulus (MPa)"))
    assert done("sweeps", workspace, {"dma": "plain.csv"})["left_open"] == ["deformation"]
    answered = done("sweeps", workspace, {"dma": "plain.csv", "deformation": "shear"})
    assert answered["left_open"] == ["deformation"]
    assert answered["deformation"] == "shear"


def test_unit_that_is_missing_is_asked_at_its_field(workspace: Context) -> None:
    (workspace.files / "bare.csv").write_text(table("T (degC),f (Hz),E',E''"))
    with refused("no-unit", JobError, naming="bare.csv") as caught:
        done("sweeps", workspace, {"dma": "bare.csv"})
    assert (caught.value.code, caught.value.field) == ("no-unit", "material.modulus_unit")
    found = done("sweeps", workspace, {"dma": "bare.csv", "modulus_unit": "MPa"})
    assert found["left_open"] == ["modulus_unit"]


def test_temperature_that_is_missing_is_asked_at_its_field(workspace: Context) -> None:
    (workspace.files / "sweep.csv").write_text(table("f (Hz),E' (MPa),E'' (MPa)", (20.0,)))
    with pytest.raises(JobError) as caught:
        done("sweeps", workspace, {"dma": "sweep.csv"})
    assert (caught.value.code, caught.value.field) == ("no-temperature", "material.temperature")
    found = done("sweeps", workspace, {"dma": "sweep.csv", "temperature": "20 degC"})
    assert found["left_open"] == ["temperature"]
    assert found["isotherms"][0]["temperature"] == 293.15


def test_what_is_no_sweep_is_reported_by_its_name_alone(workspace: Context) -> None:
    (workspace.files / "letter.txt").write_text("Dear colleagues,\n")
    with refused("unknown-format", JobError, naming="letter.txt") as caught:
        done("sweeps", workspace, {"dma": "letter.txt"})
    assert caught.value.field == "material.dma"


@pytest.mark.parametrize(
    ("name", "synthetic", "words"),
    [
        ("synthetic fluoroelastomer", True, "not a measurement"),
        ("PVB interlayer", False, "Van Duser"),
        ("VHB 4910", False, "Chester"),
    ],
)
def test_catalogue_shows_its_sources(workspace: Context, name: str, synthetic: bool, words: str) -> None:
    found = done("sweeps", workspace, {"catalogue": name})
    assert found["source"] == "catalogue"
    assert found["synthetic"] is synthetic
    assert words in " ".join(found["about"])


def test_ready_rubber_and_master_curve_are_taken_too(workspace: Context) -> None:
    import viscofric as vf

    vf.write_card(vf.catalogue_material("PVB interlayer"), workspace.files / "rubber.json", "json")
    found = done("sweeps", workspace, {"file": "rubber.json"})
    assert found["source"] == "file"
    assert found["name"].startswith("PVB interlayer")
    assert found["reference"] == pytest.approx(293.15)
    (workspace.files / "master.csv").write_text(table("f (Hz),E' (MPa),E'' (MPa)", (20.0,)))
    curve = {"master_curve": "master.csv", "reference_temperature": "20 degC"}
    assert done("sweeps", workspace, curve)["source"] == "master_curve"


@pytest.mark.parametrize(
    ("pattern", "taken_for", "deformation", "isotherms", "left_open"),
    [
        ("instruments/mettler/glassy_network/*.txt", "Mettler", "tension", 22, []),
        ("instruments/rad_per_s_tsv/foam*.csv", "delimited text", "tension", 19, ["deformation", "modulus_unit"]),
    ],
)
def test_files_of_instruments_are_recognised(
    real_data: Path,
    tmp_path: Path,
    pattern: str,
    taken_for: str,
    deformation: str,
    isotherms: int,
    left_open: list[str],
) -> None:
    files = sorted(real_data.glob(pattern))
    assert files
    material: dict[str, Any] = {"dma": [file.name for file in files]}
    if "modulus_unit" in left_open:
        material["modulus_unit"] = "MPa"
    found = done("sweeps", workspace_with(tmp_path, *files), material)
    assert taken_for in found["format"]
    assert found["deformation"] == deformation
    assert len(found["isotherms"]) == isotherms
    assert found["left_open"] == left_open
    assert [one["name"] for one in found["files"]] == material["dma"]


def test_sweeps_need_no_reference_but_take_one(workspace: Context) -> None:
    assert done("sweeps", workspace, SWEEPS)["isotherms"] == done("sweeps", workspace, {"dma": "dma.csv"})["isotherms"]


def test_files_that_differ_where_they_should_agree_are_asked_about(workspace: Context) -> None:
    head = "T (degC),f (Hz),E' (MPa),E'' (MPa)"
    for name, factor, temperatures in (("a", 1.0, (20.0, 30.0)), ("b", 1.3, (30.0, 40.0)), ("c", 1.0, (50.0, 60.0))):
        rows = [row.split(",") for row in table(head, temperatures).splitlines()[1:]]
        scaled = [f"{t},{f},{factor * float(storage)},{factor * float(loss)}" for t, f, storage, loss in rows]
        (workspace.files / f"{name}.csv").write_text("\n".join([head, *scaled, ""]))

    def asked(*names: str) -> tuple[Any, set[str]]:
        found = done("sweeps", workspace, {"dma": [f"{name}.csv" for name in names], "deformation": "tension"})
        return found["specimens"], {record["code"] for record in found["note_records"]}

    specimens, notes = asked("a", "b", "c")
    assert specimens["files"] == ["a.csv", "b.csv"]
    assert specimens["temperature"] == 303.15
    assert specimens["difference"] == pytest.approx(0.3 / 1.15, rel=1e-5)  # of the mean; the tables have six digits
    assert "repeats-differ" not in notes  # the question stands for it
    assert "averaged" in notes
    assert asked("a", "c")[0] is None
    # a file that contradicts itself is no question of files: its note stays
    (workspace.files / "d.csv").write_text(
        (workspace.files / "a.csv").read_text()
        + "".join(line + "\n" for line in (workspace.files / "b.csv").read_text().splitlines()[1:])
    )
    specimens, notes = asked("d")
    assert specimens is None
    assert "repeats-differ" in notes


def test_swapped_moduli_are_recognised(workspace: Context) -> None:
    rubber, codes = vf.catalogue_material("synthetic fluoroelastomer"), {}
    for name in ("sound", "swapped"):
        rows = ["T (degC),f (Hz),E' (MPa),E'' (MPa)"]
        for celsius in (-20.0, -10.0, 0.0, 20.0, 60.0, 100.0):
            modulus = 1e-6 * rubber.complex_modulus(2.0 * np.pi * HERTZ, celsius + 273.15)
            columns = [modulus.real, modulus.imag][:: 1 if name == "sound" else -1]
            rows += [f"{celsius},{f},{one},{two}" for f, one, two in zip(HERTZ, *columns, strict=True)]
        (workspace.files / f"{name}.csv").write_text("\n".join([*rows, ""]))
        found = done("sweeps", workspace, {"dma": f"{name}.csv", "deformation": "tension"})
        codes[name] = {record["code"] for record in found["note_records"]}
    assert "columns-swapped" in codes["swapped"] - codes["sound"]


def test_sheets_that_overlap_are_named(workspace: Context) -> None:
    book = openpyxl.Workbook()
    for name in ("first", "second"):
        sheet = book.create_sheet(name)
        for line in table("T (degC),f (Hz),E' (MPa),E'' (MPa)").splitlines():
            sheet.append([float(cell) if cell[0].isdigit() else cell for cell in line.split(",")])
    book.remove(book.worksheets[0])
    book.save(workspace.files / "book.xlsx")
    with refused("several-tables", JobError, naming="first") as caught:
        done("sweeps", workspace, {"dma": "book.xlsx", "deformation": "tension"})
    assert (caught.value.field, dict(caught.value.note.values)) == ("material.sheet", {"sheets": ["first", "second"]})
