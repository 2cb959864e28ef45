"""What readers and studies say to users of Python or the shell is said on the page in the page's own words."""

from __future__ import annotations

import ast
import math
import re
from pathlib import Path
from typing import Any

import pytest

import viscofric as vf
from viscofric.study.make_rubber import make_rubber
from viscofric.study.run_file.errors import keys
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.study import TABLES
from viscofric.web.jobs.context import beside_field
from viscofric.web.start import FORMS
from viscofric.web.study_text import DocumentError, study_of
from viscofric.web.workspace import Workspace

_ROWS = [f"{T},{f},{2.0 * f**0.2 * 10 ** (-0.01 * T)},0.3" for T in (20, 30, 40) for f in (0.1, 0.3, 1, 3, 10)]
_TESTS = ["temperature (degC),disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)", "20,100,90,25,0.4"]


def written(folder: Path, *lines: str) -> Path:
    path = folder / "data.csv"
    path.write_text("\n".join([*lines, ""]))
    return path


@pytest.mark.parametrize(
    ("head", "place", "field"),
    [
        ("T (degC),f (Hz),storage modulus,loss modulus", "“Unit of the moduli”", "material.modulus_unit"),
        ("T (degC),f (Hz),storage modulus (MPa),loss modulus (MPa)", "“Measured in”", "material.deformation"),
    ],
)
def test_what_a_file_leaves_open_is_asked_on_the_page(head: str, place: str, field: str, tmp_path: Path) -> None:
    path = written(tmp_path, head, *_ROWS)
    with pytest.raises(vf.ViscofricError) as caught:
        make_rubber(MaterialTable.model_validate({"dma": str(path), "reference_temperature": "30 degC"}))
    words = caught.value.words("page")
    assert place in words
    assert "modulus_unit" not in words
    assert "deformation=" not in words
    assert caught.value.field == field


def test_files_of_the_other_kind_are_sent_to_their_step(tmp_path: Path) -> None:
    with pytest.raises(vf.ViscofricError) as caught:
        vf.read_dma(written(tmp_path, *_TESTS))
    assert caught.value.words("page").endswith("; drop it under “Measurement”.")
    with pytest.raises(vf.ViscofricError) as caught:
        vf.read_mtm(written(tmp_path, "T (degC),f (Hz),storage modulus (MPa),loss modulus (MPa)", *_ROWS))
    assert caught.value.words("page").endswith("; drop it at the step “Data”.")


_HEATING, _LAYER = {"counterface": "steel"}, {"thickness": "2 mm"}
_INTERFACE = {"law": "constant", "stress": "1 MPa"}


@pytest.mark.parametrize(
    ("tables", "fields"),
    [
        ({"heating": {**_HEATING, "passes": 3}}, ["heating.passes"]),
        ({"heating": {**_HEATING, "track_radius": "2 cm"}}, ["heating.track_radius"]),
        ({"heating": _HEATING, "layer": _LAYER}, ["heating"]),
        (
            {"heating": {**_HEATING, "coulomb": 0.2, "slip": "1 m/s"}, "interface": _INTERFACE},
            ["heating.coulomb", "heating.slip"],
        ),
        ({"interface": {"law": "best"}}, ["interface"]),
        ({"interface": {**_INTERFACE, "law": "best"}}, ["interface.law"]),
        ({"interface": {"law": "power", "stress": "1 MPa"}}, ["interface.exponent", "interface.speed"]),
        ({"history": {"dwell": "0 s"}}, ["history.dwell"]),
        ({"history": {"dwell": "1 s", "strokes": 2}}, ["history.strokes"]),
    ],
)
def test_contradictions_are_at_their_fields_without_keys_of_run_files(
    tables: dict[str, Any], fields: list[str], tmp_path: Path
) -> None:
    study = {
        "material": {"catalogue": "synthetic fluoroelastomer"},
        "indenter": {"shape": "ball", "radius": "9 mm"},
        "conditions": {"load": "2 N", "speed": "1 m/s", "temperature": "30 degC"},
    }
    with pytest.raises(DocumentError) as caught:
        study_of({**study, **tables}, tmp_path)
    found = [beside_field(one) for one in caught.value.mistakes]
    assert [one["field"] for one in found] == fields
    assert not any(re.search(r"[\[_=]", one["message"]) for one in found)


def test_the_final_state_of_a_track_can_be_asked_for_in_json(tmp_path: Path) -> None:
    document = {
        "material": {"catalogue": "synthetic fluoroelastomer"},
        "indenter": {"shape": "ball", "radius": "9 mm"},
        "conditions": {"load": "2 N", "speed": "1 m/s", "temperature": "30 degC"},
        "heating": {**_HEATING, "passes": "inf", "track_radius": "2 cm"},
    }
    heating = study_of(document, tmp_path)[1].heating
    assert heating is not None
    assert heating.passes == math.inf


def test_every_field_of_the_page_that_a_remedy_names_is_there() -> None:
    """A label that changes in the page's forms or scripts changes in the remedies."""
    source = Path(vf.__file__).parent
    scripts = "".join(path.read_text("utf-8") for path in (source / "web/static/js").rglob("*.js"))
    named = {
        (call.args[0].value, call.args[1].value)
        for path in source.rglob("*.py")
        for call in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "setting"
        if all(isinstance(one, ast.Constant) for one in call.args[:2])
    }
    assert len(named) >= 5
    written = re.sub(r'label="', 'label: "', scripts)
    in_forms = {(field["path"], field["label"]) for fields in FORMS.values() for field in fields}
    assert [label for _, label in named - in_forms if f'label: "{label}"' not in written] == []
    assert [field for field, _ in named if field.partition(".")[2] not in keys(TABLES[field.partition(".")[0]])] == []


def test_all_notes_of_jobs_are_in_the_words_of_the_page() -> None:
    folder = Path(vf.__file__).parent / "web" / "jobs"
    calls = [
        (path.name, ast.unparse(call))
        for path in folder.glob("*.py")
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "listed"
    ]
    assert len(calls) > 10
    assert [one for one in calls if not one[1].endswith(", 'page')")] == []


@pytest.mark.parametrize(("limit", "most"), [("MOST_FILES", 1), ("_MOST_BYTES", 10)])
def test_too_many_files_are_refused_with_what_the_page_can_do(
    limit: str, most: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    workspace = Workspace(tmp_path)
    workspace.store("a", b"0" * 10)
    monkeypatch.setattr(f"viscofric.web.workspace.{limit}", most)
    with pytest.raises(vf.ViscofricError) as caught:
        workspace.store("b", b"0")
    buttons = re.findall("“([^”]*)”", caught.value.words("page"))
    header = (Path(vf.__file__).parent / "web" / "static" / "js" / "header.js").read_text(encoding="utf-8")
    assert buttons
    assert [one for one in buttons if f"<span>{one}</span>" not in header] == []
