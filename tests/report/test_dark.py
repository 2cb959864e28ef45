"""Figures keep their colours where the screen is dark: an inverted scale of colours would show highs as lows."""

from __future__ import annotations

import io
from base64 import b64encode
from importlib.resources import files
from pathlib import Path

import numpy as np
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
def test_figures_of_a_report_have_the_colours_of_their_files_on_a_dark_screen_and_in_print(tmp_path: Path) -> None:
    from web.browser_tab import chromium_path, launched

    path = chromium_path()
    if path is None:
        pytest.skip("no Chromium is on the path")
    style = files("viscofric.report").joinpath("report.css").read_text(encoding="utf-8")
    source = b64encode(drawn("#0072b2")).decode()
    body = f'<body><figure><img src="data:image/svg+xml;base64,{source}"></figure></body>'
    head = f'<head><meta name="color-scheme" content="light dark"><style>{style}</style></head>'
    (tmp_path / "page.html").write_text(f"<!doctype html><html>{head}{body}</html>", encoding="utf-8")
    dark = {}
    with launched(path) as browser:
        page = browser.new_page(color_scheme="dark")
        page.goto((tmp_path / "page.html").as_uri())
        for medium in ("screen", "print"):
            page.emulate_media(media=medium)
            pixels = imread(io.BytesIO(page.locator("img").screenshot(animations="disabled")))[:, :, :3]
            assert pixels[10, 10].min() == 1.0  # paper
            dark[medium] = pixels.reshape(-1, 3)[np.argmin(pixels.sum(axis=2))]
    assert dark["screen"] == pytest.approx([0.0, 0.0, 0.0], abs=0.1)  # ink
    assert dark["print"] == pytest.approx(dark["screen"], abs=0.1)
