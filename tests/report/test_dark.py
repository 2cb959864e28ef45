"""A figure follows the page: on dark paper ink is light and lines stand out; areas keep the colours of their scale."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from base64 import b64encode
from importlib.resources import files
from pathlib import Path

import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.image import imread

from viscofric.report.figures.saving import adaptive


def drawn(colour: str) -> bytes:
    figure = Figure(figsize=(2.0, 2.0))
    axes = figure.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0], color=colour)
    axes.axhspan(0.2, 0.3, color="#440154", linewidth=0.0)
    target = io.BytesIO()
    figure.savefig(target, format="svg")
    return target.getvalue()


def test_light_page_shows_the_same_drawing() -> None:
    svg = drawn("#0072b2")
    both = adaptive(svg)
    sheet = re.search(rb"<style>@media \(prefers-color-scheme: dark\) \{.*?\}\}</style>", both)
    assert sheet
    assert both.replace(sheet[0], b"") == svg
    assert ET.fromstring(both).tag.endswith("svg")


@pytest.mark.parametrize("colour", ["#440154", "#472d7b", "#000080", "#010101"])
def test_lines_stand_out_from_dark_paper(colour: str) -> None:
    rule = rf'\[style\*="stroke: {colour}"\]{{stroke:(#[0-9a-f]{{6}})'
    (lighter,) = re.findall(rule, adaptive(drawn(colour)).decode())
    assert sum(to_rgb(lighter)) > sum(to_rgb(colour))


def test_light_lines_stay_as_they_are() -> None:
    assert "stroke: #fde725" not in adaptive(drawn("#fde725")).decode().partition("</style>")[0]


def test_areas_keep_the_colours_of_their_scale() -> None:
    sheet = adaptive(drawn("#0072b2")).decode().partition("</style>")[0]
    assert 'fill: #440154"' not in sheet


def test_what_is_no_drawing_is_left_alone() -> None:
    assert adaptive(b"svg ['text']") == b"svg ['text']"


@pytest.mark.apart
def test_a_printed_report_has_light_figures_where_the_screen_is_dark(tmp_path: Path) -> None:
    from web.browser_tab import chromium_path, launched

    path = chromium_path()
    if path is None:
        pytest.skip("no Chromium is on the path")
    style = files("viscofric.report").joinpath("report.css").read_text(encoding="utf-8")
    source = b64encode(adaptive(drawn("#0072b2"))).decode()
    body = f'<body><figure><img src="data:image/svg+xml;base64,{source}"></figure></body>'
    head = f'<head><meta name="color-scheme" content="light dark"><style>{style}</style></head>'
    (tmp_path / "page.html").write_text(f"<!doctype html><html>{head}{body}</html>", encoding="utf-8")
    corner = {}
    with launched(path) as browser:
        page = browser.new_page(color_scheme="dark")
        page.goto((tmp_path / "page.html").as_uri())
        for medium in ("screen", "print"):
            page.emulate_media(media=medium)
            shot = io.BytesIO(page.locator("img").screenshot(animations="disabled"))
            pixels = imread(shot)
            corner[medium] = float(pixels[10, 10, :3].mean())
    assert corner["screen"] < 0.3
    assert corner["print"] == 1.0
