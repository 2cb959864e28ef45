"""What readers and studies say to users of Python or the shell is said on the page in the page's own words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import viscofric as vf
from viscofric.study.material_table import MaterialTable
from viscofric.study.rubber import make_rubber
from viscofric.web.jobs.page_words import page_words

if TYPE_CHECKING:
    from pathlib import Path

_ROWS = [f"{T},{f},{2.0 * f**0.2 * 10 ** (-0.01 * T)},0.3" for T in (20, 30, 40) for f in (0.1, 0.3, 1, 3, 10)]
_TESTS = ["temperature (degC),disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)", "20,100,90,25,0.4"]


def written(folder: Path, *lines: str) -> Path:
    path = folder / "data.csv"
    path.write_text("\n".join([*lines, ""]))
    return path


@pytest.mark.parametrize(
    ("head", "place", "field"),
    [
        ("T (degC),f (Hz),storage modulus,loss modulus", "under “Data” which unit", "material.modulus_unit"),
        (
            "T (degC),f (Hz),storage modulus (MPa),loss modulus (MPa)",
            "under “Data” which it was",
            "material.deformation",
        ),
    ],
)
def test_what_a_file_leaves_open_is_asked_on_the_page(head: str, place: str, field: str, tmp_path: Path) -> None:
    path = written(tmp_path, head, *_ROWS)
    with pytest.raises(vf.ViscofricError) as told:
        make_rubber(MaterialTable.model_validate({"dma": str(path), "reference_temperature": "30 degC"}))
    words, asked = page_words(str(told.value))
    assert place in words
    assert "shell" not in words
    assert "modulus_unit" not in words
    assert asked == field


def test_files_of_the_other_kind_are_sent_to_their_step(tmp_path: Path) -> None:
    with pytest.raises(vf.ViscofricError) as told:
        vf.read_dma(written(tmp_path, *_TESTS))
    assert page_words(str(told.value))[0].endswith("; drop it under “Measurement”.")
    with pytest.raises(vf.ViscofricError) as told:
        vf.read_mtm(written(tmp_path, "T (degC),f (Hz),storage modulus (MPa),loss modulus (MPa)", *_ROWS))
    assert page_words(str(told.value))[0].endswith("; drop it under “Data”.")


def test_other_sentences_stay_as_they_are() -> None:
    assert page_words("The load must be above zero.") == ("The load must be above zero.", None)
