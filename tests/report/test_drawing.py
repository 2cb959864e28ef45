"""Figures as files: the right ones, valid, the same every time, and honest about synthetic data."""

from __future__ import annotations

import struct
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
import pytest

from refusals import refused
from viscofric import report
from viscofric.errors import DataFileError
from viscofric.report.figures import saving
from viscofric.report.figures import study as drawing

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import xarray as xr
    from matplotlib.figure import Figure

NAMES = [
    "friction_against_speed",
    "friction_map",
    "friction_master_curve",
    "coulomb_friction",
    "convergence",
    "master_curve",
    "spectrum",
    "shift_factors",
    "superposition",
    "isotherms",
]


def png_size(content: bytes) -> tuple[int, int]:
    assert content.startswith(b"\x89PNG\r\n\x1a\n")
    assert content.endswith(b"IEND\xaeB`\x82")
    width, height = struct.unpack(">II", content[16:24])
    return width, height


@pytest.mark.slow
def test_figures_are_written_as_png_and_svg(rendered: tuple[list[Path], Path]) -> None:
    paths, _ = rendered
    names = ("friction_against_speed", "friction_map", "isotherms")
    assert [path.name for path in paths] == [f"{name}.{form}" for name in names for form in ("png", "svg")]
    for path in paths:
        if path.suffix == ".png":
            width, height = png_size(path.read_bytes())
            assert width > 1000
            assert height > 700
        else:
            assert ET.fromstring(path.read_text("utf-8")).tag == "{http://www.w3.org/2000/svg}svg"


@pytest.mark.slow
def test_same_results_give_the_same_bytes(
    make_tree: Callable[..., xr.DataTree], monkeypatch: pytest.MonkeyPatch
) -> None:
    name = "friction_against_speed"
    monkeypatch.setattr(drawing, "FRICTION_FIGURES", {name: drawing.FRICTION_FIGURES[name]})
    monkeypatch.setattr(drawing, "RUBBER_FIGURES", {})
    first, second = (drawing.figure_images(make_tree()) for _ in range(2))
    assert list(first) == [name]
    assert first == second


@dataclass
class Words:
    """What stands in all figures of results, and whether drawing them changed the settings of matplotlib."""

    names: list[str]
    texts: list[list[str]]
    legends: list[str]
    settings_kept: bool


@pytest.fixture(scope="module")
def words(make_tree: Callable[..., xr.DataTree]) -> dict[str, Words]:
    """Draw all figures of results of either origin, without turning them into images, once for all tests."""

    def drawn(origin: str) -> Words:
        found = Words([], [], [], True)

        def read(figure: Figure, form: str) -> bytes:
            found.texts.append([text.get_text() for axes in figure.axes for text in axes.texts])
            legends = [axes.get_legend() for axes in figure.axes]
            found.legends += [
                text.get_text() for one in legends if one is not None for text in (one.get_title(), *one.get_texts())
            ]
            return b""

        before = dict(matplotlib.rcParams)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(saving, "_encoded", read)
            found.names = list(drawing.figure_images(make_tree(data_origin=origin), ("svg",)))
        found.settings_kept = dict(matplotlib.rcParams) == before
        return found

    return {origin: drawn(origin) for origin in ("synthetic", "measured")}


@pytest.mark.slow
def test_drawing_leaves_matplotlibs_settings_alone(words: dict[str, Words]) -> None:
    assert all(one.settings_kept for one in words.values())


@pytest.mark.slow
def test_figures_of_synthetic_data_say_so(words: dict[str, Words]) -> None:
    for origin, found in words.items():
        assert found.names == NAMES
        assert len(found.texts) == len(NAMES)
        assert all(("synthetic data" in texts) == (origin == "synthetic") for texts in found.texts)


@pytest.mark.slow
def test_legends_of_synthetic_data_call_nothing_measured(words: dict[str, Words]) -> None:
    legends = words["synthetic"].legends
    assert any("synthetic ± scatter" in text for text in legends)
    assert not any("measured" in text for text in legends)


@pytest.mark.usefixtures("unrendered", "few_figures")
def test_figures_that_cannot_be_written_are_reported(tree: xr.DataTree, tmp_path: Path) -> None:
    (tmp_path / "figures").write_text("a file where the folder should be")
    with refused("not-written", DataFileError):
        report.draw_figures(tree, tmp_path / "figures")


def test_results_without_an_origin_count_as_synthetic(tree: xr.DataTree) -> None:
    del tree.attrs["data_origin"]
    assert drawing.is_synthetic(tree)


@pytest.mark.slow
@pytest.mark.usefixtures("unrendered")
def test_figures_that_the_results_lack_are_left_out(tree: xr.DataTree, tmp_path: Path) -> None:
    for name in ("isotherms", "prediction_master", "measurement"):
        del tree[name]
    names = {path.stem for path in report.draw_figures(tree, tmp_path)}
    assert names == {
        "shift_factors",
        "master_curve",
        "spectrum",
        "friction_against_speed",
        "friction_map",
        "convergence",
    }


@pytest.mark.apart
@pytest.mark.usefixtures("unrendered")
def test_figures_survive_the_round_trip_through_a_file(tree: xr.DataTree, tmp_path: Path) -> None:
    import xarray as xr

    tree.to_netcdf(tmp_path / "results.nc", engine="netcdf4")
    with xr.open_datatree(tmp_path / "results.nc", engine="netcdf4") as stored:
        again = stored.load()
    assert drawing.figure_images(again, ("svg",)) == drawing.figure_images(tree, ("svg",))


@pytest.mark.slow
def test_all_cases_failed_is_still_drawn(tree: xr.DataTree, monkeypatch: pytest.MonkeyPatch) -> None:
    of_friction = NAMES[:4]
    monkeypatch.setattr(drawing, "FRICTION_FIGURES", {name: drawing.FRICTION_FIGURES[name] for name in of_friction})
    monkeypatch.setattr(drawing, "RUBBER_FIGURES", {})
    for name in ("prediction", "prediction_master"):
        part = tree[name].to_dataset()
        part["friction_coefficient"] = part["friction_coefficient"] * np.nan
        tree[name].dataset = part
    # What was measured is shown all the same.
    assert list(drawing.figure_images(tree, ("svg",))) == [
        "friction_against_speed",
        "friction_master_curve",
        "coulomb_friction",
    ]


def test_every_figure_of_friction_has_its_place_in_the_report() -> None:
    import xarray as xr

    from viscofric.report import html

    placed = {name for _, names in html._groups(xr.DataTree()) for name in names}
    assert set(drawing.FRICTION_FIGURES) <= placed | set(html._ANSWER)
