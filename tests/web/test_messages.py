"""What readers and studies say to users of Python or the shell is said on the page in the page's own words."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import viscofric as vf
from viscofric.study.make_rubber import make_rubber
from viscofric.study.run_file.errors import keys
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.study import TABLES

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


def test_every_field_of_the_page_that_a_remedy_names_is_there() -> None:
    """A label that changes in the page's scripts changes in the remedies."""
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
    assert [label for _, label in named if f'label: "{label}"' not in scripts] == []
    assert [field for field, _ in named if field.partition(".")[2] not in keys(TABLES[field.partition(".")[0]])] == []
