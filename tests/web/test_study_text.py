"""The page's document as a run file: the same tables, the same words, and what is wrong beside its field."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from refusals import refused
from viscofric.study.run_file.study import load_study
from viscofric.web.start import FIRST_STUDY, start
from viscofric.web.study_text import RUN_FILE, DocumentError, study_of, study_text

_WORDS = st.text(st.characters(codec="utf-8"), max_size=20)
_SCALARS = st.booleans() | st.integers(-(10**12), 10**12) | st.floats(allow_nan=False) | _WORDS
_VALUES = st.recursive(
    _SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(_WORDS.filter(bool), inner, max_size=3),
    max_leaves=8,
)
_TABLES = st.dictionaries(_WORDS.filter(bool), _VALUES, max_size=4)
_DOCUMENTS = st.dictionaries(
    st.sampled_from(["title", "material", "conditions", "solver", "unknown key", "ρ"]),
    _TABLES | st.lists(_TABLES, min_size=1, max_size=3) | _SCALARS,
    max_size=5,
)


def changed(**tables: Any) -> dict[str, Any]:
    return {**FIRST_STUDY, **tables}


@pytest.mark.apart
@settings(max_examples=30)
@given(_DOCUMENTS)
def test_text_says_the_same_as_the_document(document: dict[str, Any]) -> None:
    assert tomllib.loads(study_text(document)) == document


def test_first_study_is_a_run_file_that_says_it_is_synthetic(tmp_path: Path) -> None:
    text, study = study_of(FIRST_STUDY, tmp_path)
    assert study.data_origin == "synthetic"
    assert len(study.sweep().cases) == 75  # 25 speeds at three temperatures
    (tmp_path / RUN_FILE).write_text(text, encoding="utf-8")
    assert load_study(tmp_path / RUN_FILE) == study


def test_tables_stand_in_the_order_of_the_documentation_and_ranges_on_one_line() -> None:
    backwards = {key: dict(reversed(one.items())) if isinstance(one, dict) else one for key, one in FIRST_STUDY.items()}
    text = study_text(dict(reversed(backwards.items())))
    words = ("title", "[material]", "[indenter]", "shape", "radius", "[conditions]", "load", "speed", "temperature")
    places = [text.index(word) for word in words]
    assert places == sorted(places)
    assert 'speed = { from = "1 mm/s", to = "10 m/s", points = 25, spacing = "log" }\n' in text


def test_every_mistake_stands_beside_its_field(tmp_path: Path) -> None:
    conditions = {"load": "25 X", "speed": {"from": "1 mm/s", "to": "3"}, "temperature": ["30 degC", "warm"]}
    with pytest.raises(DocumentError) as caught:
        study_of(changed(conditions=conditions, layer={"thicknes": "2 mm"}), tmp_path)
    assert {one.where: one.code for one in caught.value.mistakes} == {
        "layer.thicknes": "unknown-key",
        "conditions.load": "unknown-unit",
        "conditions.speed.to": "no-unit",
        "conditions.speed.points": "missing",
        "conditions.temperature[1]": "no-number",
    }
    assert str(tmp_path) not in str(caught.value)


@pytest.mark.parametrize(
    ("document", "field"),
    [
        (changed(conditions={**FIRST_STUDY["conditions"], "load": None}), "conditions.load"),
        (changed(title="\ud800"), None),
        (changed(material={"dma": "../dma.csv", "reference_temperature": "30 degC"}), None),
        (changed(material=[[[[[[[[[[[[["deep"]]]]]]]]]]]]]), "material"),
    ],
    ids=["null", "half a character", "folder above", "deep"],
)
def test_what_no_run_file_of_the_page_can_hold_is_refused(
    document: dict[str, Any], field: str | None, tmp_path: Path
) -> None:
    with pytest.raises(DocumentError) as caught:
        study_of(document, tmp_path)
    assert caught.value.field == field


@pytest.mark.parametrize("name", ["study.toml", "Study.TOML"])
def test_data_file_with_the_name_of_the_run_file_is_refused(name: str, tmp_path: Path) -> None:
    """Packed together, one would replace the other."""
    (tmp_path / name).write_text("1\n")
    with refused("name-of-run-file", DocumentError, naming=name):
        study_of(changed(material={"file": name}), tmp_path)


def test_a_fresh_page_distinguishes_the_synthetic_rubber_from_published_ones() -> None:
    reported = start()
    synthetic = {one["name"]: one["synthetic"] for one in reported["catalogue"]}
    assert {"synthetic fluoroelastomer", "VHB 4910"} <= set(synthetic)
    assert synthetic == {name: name.startswith("synthetic") for name in synthetic}
    assert all(one["description"] for one in reported["catalogue"])
    assert start({"title": "mine"})["study"] == {"title": "mine"}


def test_without_a_material_the_page_says_where_one_comes_from(tmp_path: Path) -> None:
    without = {name: table for name, table in FIRST_STUDY.items() if name != "material"}
    with pytest.raises(DocumentError) as error:
        study_of({**without, "conditions": {**FIRST_STUDY["conditions"], "load": "10 X"}}, tmp_path)
    assert {one.where: one.code for one in error.value.mistakes}["material"] == "no-material"
    assert {one.where for one in error.value.mistakes} == {"material", "conditions.load"}
