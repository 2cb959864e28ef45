"""What is taken from the page: a run file that repeats its numbers, cards of the rubber, the whole study."""

from __future__ import annotations

import shutil
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.errors import DataFileError, StudyError
from viscofric.report.texts.checks import all_checks
from viscofric.rheology.cards import read_card
from viscofric.web.jobs import curve, export_card, export_run_file, export_study, open_run_file
from viscofric.web.jobs.rubbers import made_rubber
from viscofric.web.study_text import DocumentError
from web.contact_studies import BALL, Desk
from web.rubber_workspace import EXAMPLE

#: Numbers of the page have six digits.
ROUNDING = 1e-5

SWEEPS: dict[str, Any] = {
    **BALL,
    "data_origin": "synthetic",
    "material": {"dma": "dma.csv", "deformation": "tension", "reference_temperature": "30 degC"},
    "conditions": {"load": "25 N", "speed": ["20 mm/s", "200 mm/s"], "temperature": "60 degC"},
    "solver": {"accuracy": 0.1, "master_curve_points": 3},
    "uncertainty": {"draws": 0},
}


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    made = Desk(tmp_path)
    (made.context.files / "dma.csv").write_bytes(EXAMPLE.read_bytes())
    return made


def unpacked(desk: Desk, folder: Path) -> Path:
    """Return the run file of the packed study, in a folder that holds nothing else but what was packed with it."""
    found = desk.run(export_run_file, SWEEPS, pack=True)
    with zipfile.ZipFile(desk.context.downloads / found["download"]["name"]) as packed:
        packed.extractall(folder)
    return folder / "study.toml"


def test_a_packed_study_is_opened_with_its_data(desk: Desk, tmp_path: Path) -> None:
    packed = desk.context.downloads / desk.run(export_run_file, SWEEPS, pack=True)["download"]["name"]
    (tmp_path / "other").mkdir()
    other = Desk(tmp_path / "other")
    shutil.copyfile(packed, other.context.files / "study.zip")
    found = other.run(open_run_file, {}, archive="study.zip")
    assert found == {"study": SWEEPS, "missing": [], "files": ["dma.csv"]}
    assert [one.name for one in other.context.files.iterdir()] == ["dma.csv"]  # the archive has gone
    assert (other.context.files / "dma.csv").read_bytes() == EXAMPLE.read_bytes()


def test_an_archive_that_is_none_or_leads_out_of_the_folder_is_refused(desk: Desk) -> None:
    def refuses(code: str, **entries: bytes) -> None:
        with zipfile.ZipFile(desk.context.files / "own.zip", "w", zipfile.ZIP_DEFLATED) as packed:
            for name, content in entries.items():
                packed.writestr(name, content)
        with refused(code):
            desk.run(open_run_file, {}, archive="own.zip")

    refuses("no-run-file", **{"dma.csv": b"1"})
    refuses("not-a-name", **{"study.toml": b"", "con.csv": b"1"})
    refuses("too-large", **{"study.toml": b"", "bomb.csv": bytes(21_000_000)})
    refuses("damaged", **{"study.toml": b"\xff"})
    (desk.context.files / "own.zip").write_bytes(b"PK no archive")
    with refused("damaged"):
        desk.run(open_run_file, {}, archive="own.zip")
    with refused("not-a-name"):
        desk.run(open_run_file, {}, archive="../dma.csv")
    with zipfile.ZipFile(desk.context.files / "own.zip", "w") as packed:
        packed.writestr("../../outside/dma2.csv", b"1")
        packed.writestr("folder/study.toml", b"title = 'of a folder'")
    found = desk.run(open_run_file, {}, archive="own.zip")
    assert (found["study"], found["files"]) == ({"title": "of a folder"}, ["dma2.csv"])
    assert (desk.context.files / "dma2.csv").is_file()


def test_packed_run_file_has_its_data_with_it_and_is_the_same_each_time(desk: Desk, tmp_path: Path) -> None:
    path = unpacked(desk, tmp_path / "elsewhere")
    assert sorted(one.name for one in path.parent.iterdir()) == ["dma.csv", "study.toml"]
    assert (path.parent / "dma.csv").read_bytes() == EXAMPLE.read_bytes()
    study = vf.load_study(path)
    assert study.inputs == (path.parent / "dma.csv",)
    assert study.conditions.speed == (0.02, 0.2)
    first = (desk.context.downloads / "study.zip").read_bytes()
    assert desk.run(export_run_file, SWEEPS, pack=True)["download"]["size"] == len(first)
    assert (desk.context.downloads / "study.zip").read_bytes() == first


def test_run_file_is_reported_with_its_cases_its_files_and_what_is_wrong(desk: Desk) -> None:
    sound = desk.run(export_run_file, SWEEPS)
    assert tomllib.loads(sound["text"]) == SWEEPS
    assert (sound["problems"], sound["cases"], sound["files"]) == ([], 2, ["dma.csv"])
    missing = desk.run(export_run_file, {**SWEEPS, "material": {**SWEEPS["material"], "dma": ["dma.csv", "two.csv"]}})
    (problem,) = missing["problems"]
    assert problem["field"] == "material.dma"
    assert "two.csv" in problem["message"]
    (problem,) = desk.run(export_run_file, {**SWEEPS, "history": {"file": "over_time.csv"}})["problems"]
    assert problem["field"] == "history.file"
    wrong = desk.run(export_run_file, {**SWEEPS, "indenter": {"shape": "bal", "radius": "9.525 mm"}})
    assert [one["field"] for one in wrong["problems"]] == ["indenter"]
    assert 'shape = "bal"' in wrong["text"]
    with refused("union-tag-invalid", DocumentError, naming="'ball'"):
        desk.run(export_run_file, {**SWEEPS, "indenter": {"shape": "bal", "radius": "9.525 mm"}}, pack=True)


def test_run_file_that_was_taken_away_can_be_brought_back(desk: Desk) -> None:
    text = desk.run(export_run_file, SWEEPS)["text"]
    assert desk.run(open_run_file, {}, text=text) == {"study": SWEEPS, "missing": [], "files": []}
    moved = text.replace('"dma.csv"', r"""["C:\\sweeps\\dma.csv", "../more/two.csv", "*.txt"]""")
    found = desk.run(open_run_file, {}, text="\ufeff" + moved)
    assert found["study"]["material"]["dma"] == ["dma.csv", "two.csv", "*.txt"]
    assert found["missing"] == ["two.csv", "*.txt"]
    with refused("not-toml", StudyError, naming="study.toml"):
        desk.run(open_run_file, {}, text="[material]\nthis is no TOML")
    with refused("too-deep", StudyError):
        desk.run(open_run_file, {}, text=f"deep{'.x' * 20_000} = 1")
    for name, reported in [("/", ""), ("..", ".."), ("x" * 300, "x" * 300), ("a\\u0000b", "a\0b"), ("[", "[")]:
        assert desk.run(open_run_file, {}, text=f'material.dma = "{name}"')["missing"] == [reported]


@pytest.mark.parametrize(("form", "unit"), [("abaqus", "MPa"), ("ansys", "MPa"), ("comsol", "Pa"), ("json", "Pa")])
def test_card_holds_the_rubber_of_the_page(form: str, unit: str, desk: Desk) -> None:
    found = desk.run(export_card, BALL, format=form, poisson_ratio=0.499, modulus_unit=unit)
    path = desk.context.downloads / found["download"]["name"]
    assert path.read_text(encoding="utf-8") == found["text"]
    assert found["download"]["size"] == path.stat().st_size
    card, page = read_card(path), made_rubber(BALL, desk.context).material
    omega = np.geomspace(1e-3, 1e6, 10)
    # a Prony series in fifteen digits, back to retardation
    np.testing.assert_allclose(card.complex_modulus(omega), page.complex_modulus(omega), rtol=1e-6)


def test_what_a_program_cannot_take_is_reported_in_a_sentence(desk: Desk) -> None:
    with refused("too-many-modes", naming=("18", "17")):
        desk.run(export_card, BALL, format="ls-dyna", poisson_ratio=0.499, density="1800 kg/m^3")
    with refused("wrong-unit", naming="density"):
        desk.run(export_card, BALL, format="abaqus", density="1800 kg")
    measured = desk.run(export_card, SWEEPS, format="abaqus")
    assert "“Shift law”" in " ".join(measured["notes"])
    assert "*TRS" not in measured["text"]
    fitted = desk.run(export_card, SWEEPS, format="abaqus", law="wlf")
    assert "*TRS, DEFINITION=WLF" in fitted["text"]
    assert fitted["notes"] == []


def test_a_file_that_is_gone_is_named(desk: Desk) -> None:
    (desk.context.files / "dma.csv").unlink()
    with refused("no-file", DataFileError, naming="dma.csv"):
        desk.run(export_study, SWEEPS)


@pytest.mark.apart
def test_whole_study_has_the_numbers_of_page_and_command_line_and_takes_up_where_it_was(
    desk: Desk, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # figures are drawn, but not turned into images, most of the time of a quick study; tests of the report look at them
    monkeypatch.setattr("viscofric.report.figures.saving._encoded", lambda figure, form: form.encode())
    path = unpacked(desk, tmp_path / "elsewhere")
    stored = vf.run_study(path)
    shown, asked = desk.run(curve, SWEEPS), stored.dataset
    np.testing.assert_allclose(shown["friction"], asked["friction_coefficient"].values.ravel(), rtol=ROUNDING)
    np.testing.assert_allclose(shown["error"], asked["friction_error"].values.ravel(), rtol=ROUNDING)

    # as a run that was stopped leaves it
    shutil.copytree(stored.folder / "cases", desk.context.cache / "study" / "study.results" / "cases")
    found = desk.run(export_study, SWEEPS, workers=1)
    assert (found["cases"], found["failed"], found["synthetic"]) == (2, 0, True)
    labels = [message["label"] for event, message in desk.reported if event == "progress"]
    assert any(label.startswith("solving contacts") for label in labels)
    assert labels[-1] == "drawing figures and report"
    doubtful = {check.sentence for check in all_checks(stored.tree) if check.verdict == "warning"}
    assert doubtful
    assert doubtful <= set(found["warnings"])

    downloads = desk.context.downloads
    names = [one["name"] for one in found["downloads"]]
    assert names == ["report.html", "results.nc", "results.csv", "results.xlsx", "figures.zip"]
    assert all(one["size"] == (downloads / one["name"]).stat().st_size > 0 for one in found["downloads"])
    assert "A ball on a synthetic rubber" in (downloads / "report.html").read_text(encoding="utf-8")
    compared = vf.compare_results(stored.folder, downloads / "results.nc", tolerance=0.0)
    assert compared.equal
    assert compared.cases == 2
    with zipfile.ZipFile(downloads / "figures.zip") as pictures:
        assert {name.rpartition(".")[2] for name in pictures.namelist()} == {"png", "svg"}
