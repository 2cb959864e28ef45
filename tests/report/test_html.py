"""The report is one harmless, complete page, the same for the same results."""

from __future__ import annotations

import base64
import json
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from typing import TYPE_CHECKING

import numpy as np
import pytest

from refusals import refused
from viscofric import report
from viscofric.errors import DataFileError
from viscofric.notes import table_in
from viscofric.report import html
from viscofric.report.texts.friction_tables import agreement_table, detail_tables, friction_at_a_glance
from viscofric.report.texts.study import scope

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import xarray as xr

VOID = {"meta", "img", "br", "hr", "link", "input"}
HOSTILE = "<script>alert('x')</script> & \"quotes\" \x07"


class Page(HTMLParser):
    """What a page holds: tags in balance, ids, cells, headings, images, and all its text."""

    def __init__(self, source: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.cells: list[str] = []
        self.text = ""
        self.feed(source)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag in ("td", "th"):
            self.cells.append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" in self.open:
            return
        self.text += data
        if self.open[-1:] in (["td"], ["th"]):
            self.cells[-1] += data

    def attributes(self, name: str) -> list[str]:
        return [found for _, attrs in self.tags if (found := attrs.get(name)) is not None]

    def count(self, tag: str) -> int:
        return sum(name == tag for name, _ in self.tags)


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the figures out, where a test looks at the page's words only."""
    monkeypatch.setattr(html, "figure_images", lambda *_: {})


def write(tree: xr.DataTree, folder: Path) -> tuple[str, Page]:
    path = report.write_report(tree, folder)
    assert path == folder / "report.html"
    source = path.read_text("utf-8")
    return source, Page(source)


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered")
def test_page_has_every_part(tree: xr.DataTree, tmp_path: Path) -> None:
    _, page = write(tree, tmp_path)
    ids = page.attributes("id")
    assert len(ids) == len(set(ids))
    assert {"scope", "answer", "checks", "figures", "tables", "reproduce"} <= set(ids)
    assert {f"figure-{name}" for name in ("friction_against_speed", "master_curve", "isotherms")} <= set(ids)
    assert page.count("img") == 10
    assert all(page.attributes("alt"))


@pytest.mark.slow
def test_page_loads_nothing_from_elsewhere(rendered: tuple[list[Path], Path]) -> None:
    source = rendered[1].read_text("utf-8")
    page = Page(source)
    assert not {"script", "link", "iframe", "object", "embed", "base"} & {tag for tag, _ in page.tags}
    ids = page.attributes("id")
    assert all(address.removeprefix("#") in ids for address in page.attributes("href"))
    images = page.attributes("src")
    assert all(address.startswith("data:image/svg+xml;base64,") for address in images)
    assert "://" not in re.sub(r"base64,[A-Za-z0-9+/=]+", "", source)
    assert not re.search(r"url\(|@import", source)
    for address in images:
        svg = base64.b64decode(address.partition("base64,")[2], validate=True)
        assert ET.fromstring(svg).tag.endswith("svg")
        assert b"<script" not in svg


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered", "few_figures")
def test_figures_drawn_once_are_those_of_the_files_and_of_the_report(tree: xr.DataTree, tmp_path: Path) -> None:
    paths, page = report.write_figures_and_report(tree, tmp_path / "once")
    apart = report.draw_figures(tree, tmp_path / "apart" / "figures")
    assert [path.name for path in paths] == [path.name for path in apart]
    assert len(paths) == 4  # two figures, each in two formats
    assert all(one.read_bytes() == other.read_bytes() for one, other in zip(paths, apart, strict=True))
    assert page.read_bytes() == report.write_report(tree, tmp_path / "apart").read_bytes()


@pytest.mark.usefixtures("undrawn")
def test_tables_hold_every_number(tree: xr.DataTree, tmp_path: Path) -> None:
    _, page = write(tree, tmp_path)
    tables = [friction_at_a_glance(tree), agreement_table(tree), *detail_tables(tree)]
    tables = [table for table in tables if table is not None]
    assert [table.key for table in tables] == [
        "at-a-glance",
        "agreement",
        "prediction",
        "measured-and-predicted",
        "prediction-master",
        "shift-factors",
        "spectrum",
    ]
    hashes = [
        "input file",
        "SHA-256",
        *(text for pair in table_in(tree.attrs, "input_hashes").items() for text in pair),
    ]
    expected = hashes
    for table in tables:
        # Of a long table the first rows are shown before all of them.
        parts = [table.rows] if len(table.rows) <= 12 else [table.rows[:5], table.rows]
        expected += [cell for part in parts for row in [table.headings, *part] for cell in row]
    assert page.cells == expected
    friction = tree["prediction"]["friction_coefficient"].values
    for value in friction.flat:
        assert np.any([cell == f"{value:#.4g}" for cell in page.cells])


def test_rows_of_a_table_keep_the_numbers_together(tree: xr.DataTree) -> None:
    (prediction,) = [table for table in detail_tables(tree) if table.key == "prediction"]
    assert len(prediction.rows) == 21
    first = dict(zip(prediction.headings, prediction.rows[0], strict=True))
    assert first["temperature"] == "30 °C"
    assert first["speed (mm/s)"] == "20.00"
    assert first["contact area (mm²)"] == "15.70"
    assert prediction.headings.index("energy balance") == prediction.headings.index("numerical error") + 1
    assert first["max pressure (MPa)"] == "2.310"
    assert first["cells"] == "256"


def test_every_number_of_the_results_is_in_the_table_with_its_meaning(tree: xr.DataTree) -> None:
    results = tree.copy()
    total = (results["prediction"]["friction_coefficient"] + 0.3).assign_attrs(long_name="of both")
    results["prediction/total_friction"] = total
    (table,) = [one for one in detail_tables(results) if one.key == "prediction"]
    assert table.headings[-1] == "total friction"
    assert "total friction: of both" in table.note


@pytest.mark.usefixtures("undrawn")
def test_answer_names_the_key_numbers(tree: xr.DataTree, tmp_path: Path) -> None:
    _, page = write(tree, tmp_path)
    text = page.text.replace("\N{NO-BREAK SPACE}", " ")
    for said in (
        "10.040 ± 0.050",
        "89.60 ± 0.60 K",
        "3.02 MPa",
        "extrapolated: beyond what was measured",
        "1.51 GPa",
        "3.2 %",
        "+0.4 % on average",
        "83.3 % of the points within twice the standard error",
        "against a ball of radius 9.525 mm under 25 N, at 20 to 200 mm/s and 30 °C, 60 °C and 90 °C",
        "in tension",
        "E0 lies below what the sweeps reach & is extrapolated.",
    ):
        assert said in text, said


@pytest.mark.usefixtures("undrawn")
def test_words_of_the_input_are_repeated_as_they_are(tree: xr.DataTree, tmp_path: Path) -> None:
    _, page = write(tree, tmp_path)
    for words in (*json.loads(tree.attrs["notes"]), *json.loads(tree.attrs["warnings"])):
        assert words in page.text
    assert tree.attrs["study_text"] in page.text
    assert "viscofric run study.toml" in page.text
    assert "ab" * 32 in page.cells
    assert "numpy 2.1.0" in page.text


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize(("origin", "banner"), [("synthetic", True), ("measured", False)])
def test_synthetic_data_are_announced_first(
    make_tree: Callable[..., xr.DataTree], tmp_path: Path, origin: str, banner: bool
) -> None:
    _, page = write(make_tree(data_origin=origin), tmp_path)
    assert ("Synthetic data" in page.text) == banner
    if banner:
        assert page.text.index("Synthetic data:") < page.text.index(scope(make_tree(data_origin=origin))[0][:30])


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered")
def test_page_without_measurement_does_not_speak_of_one(make_tree: Callable[..., xr.DataTree], tmp_path: Path) -> None:
    _, page = write(make_tree(measurement=False, data_origin="measured"), tmp_path)
    ids = page.attributes("id")
    assert "table-agreement" not in ids
    assert "table-measured-and-predicted" not in ids
    assert "Prediction minus measurement" not in page.text
    assert "Coulomb" not in page.text


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered")
def test_page_of_one_case(make_tree: Callable[..., xr.DataTree], tmp_path: Path) -> None:
    _, page = write(make_tree(measurement=False, speeds=1, temperatures=1), tmp_path)
    text = page.text.replace("\N{NO-BREAK SPACE}", " ")
    assert "at 20 mm/s and 30 °C" in text
    assert "All 41 rows" in text
    assert "figure-friction_against_speed" not in page.attributes("id")


@pytest.mark.usefixtures("undrawn")
def test_page_of_nothing_but_failures(make_tree: Callable[..., xr.DataTree], tmp_path: Path) -> None:
    tree = make_tree(measurement=False, failures=json.dumps(["30 °C, 20 mm/s: accuracy not reached."]))
    for name in list(tree.children):
        del tree[name]
    _, page = write(tree, tmp_path)
    assert "30 °C, 20 mm/s: accuracy not reached." in page.text
    assert "figures" not in page.attributes("id")
    assert "tables" not in page.attributes("id")


@pytest.mark.usefixtures("undrawn")
def test_hostile_text_is_harmless(make_tree: Callable[..., xr.DataTree], tmp_path: Path) -> None:
    lists = dict.fromkeys(("notes", "warnings", "failures"), json.dumps([HOSTILE]))
    tables = dict.fromkeys(("input_hashes", "software"), json.dumps({HOSTILE: HOSTILE}))
    names = ["title", "indenter", "deformation", "created", "viscofric_version", "study_file", "study_text"]
    words = dict.fromkeys(names, HOSTILE)
    tree = make_tree(**lists, **tables, **words)
    tree["spectrum"].attrs["statements"] = json.dumps([HOSTILE])
    source, page = write(tree, tmp_path)
    assert page.count("script") == 0
    assert "<script" not in source
    assert "\x07" not in source
    assert page.text.count(HOSTILE.replace("\x07", "")) >= 10


@pytest.mark.usefixtures("undrawn")
def test_study_file_with_a_space_is_quoted_in_the_command(
    make_tree: Callable[..., xr.DataTree], tmp_path: Path
) -> None:
    _, page = write(make_tree(study_file="my study.toml"), tmp_path)
    assert "viscofric run 'my study.toml'" in page.text


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered", "few_figures")
def test_same_results_give_the_same_page(make_tree: Callable[..., xr.DataTree], tmp_path: Path) -> None:
    first = report.write_report(make_tree(), tmp_path / "one").read_bytes()
    assert report.write_report(make_tree(), tmp_path / "two").read_bytes() == first


def test_many_speeds_are_thinned_at_a_glance_only(make_tree: Callable[..., xr.DataTree]) -> None:
    tree = make_tree(speeds=30)
    glance = friction_at_a_glance(tree)
    assert glance is not None
    assert len(glance.rows) == 10


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered", "few_figures")
def test_report_that_cannot_be_written_is_reported(tree: xr.DataTree, tmp_path: Path) -> None:
    (tmp_path / "report.html").mkdir()
    with refused("not-written", DataFileError, naming="report.html"):
        report.write_report(tree, tmp_path)
