"""A figure follows the page: on dark paper ink is light, in print it is dark."""

from __future__ import annotations

import io
from base64 import b64encode
from importlib.resources import files
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread


def drawn(colour: str) -> bytes:
    figure = Figure(figsize=(2.0, 2.0))
    axes = figure.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0], color=colour)
    axes.axhspan(0.2, 0.3, color="#440154", linewidth=0.0)
    target = io.BytesIO()
    figure.savefig(target, format="svg")
    return target.getvalue()


@pytest.mark.apart
def test_a_printed_report_has_light_figures_where_the_screen_is_dark(tmp_path: Path) -> None:
    from web.browser_tab import chromium_path, launched

    path = chromium_path()
    if path is None:
        pytest.skip("no Chromium is on the path")
    style = files("viscofric.report").joinpath("report.css").read_text(encoding="utf-8")
    source = b64encode(drawn("#0072b2")).decode()
    body = f'<body><figure><img src="data:image/svg+xml;base64,{source}"></figure></body>'
    head = f'<head><meta name="color-scheme" content="light dark"><style>{style}</style></head>'
    (tmp_path / "page.html").write_text(f"<!doctype html><html>{head}{body}</html>", encoding="utf-8")
    corner, edge = {}, {}
    with launched(path) as browser:
        page = browser.new_page(color_scheme="dark")
        page.goto((tmp_path / "page.html").as_uri())
        for medium in ("screen", "print"):
            page.emulate_media(media=medium)
            shot = io.BytesIO(page.locator("img").screenshot(animations="disabled"))
            pixels = imread(shot)
            corner[medium] = float(pixels[10, 10, :3].mean())
            edge[medium] = float(pixels[len(pixels) // 2, 0, :3].mean())
    assert corner["screen"] < 0.3
    assert corner["print"] == 1.0
    assert corner["screen"] < edge["screen"] < 0.4  # its border is as faint as on paper
