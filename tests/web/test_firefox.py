"""The page in a Firefox: the example's curve, all steps, a slider, undo, dark; no error of a script."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from web.every_input import STEPS
from web.firefox_tab import firefox_path, firefox_tab

if TYPE_CHECKING:
    from pathlib import Path

    from web.served_page import Server

pytestmark = pytest.mark.apart  # a browser
_SEEN = ".step:not([hidden])"
_AT_REST = "[...document.querySelectorAll('.progress:not([hidden])')].every((one) => one.classList.contains('done'))"
_STATUS = "document.querySelector('.live-status').textContent"
_STALE = f"[...document.querySelectorAll('{_SEEN} .stale')].map(({{ id }}) => id)"
_POINTS = (
    "document.querySelector('#figure-friction-curve .plot')?.data?."
    "filter(({ mode }) => mode === 'lines+markers').map(({ x }) => x.length) ?? []"
)


def test_page_works_in_firefox(server: Server, tmp_path: Path) -> None:
    path = firefox_path()
    if path is None:
        pytest.skip("no Firefox is on the path")
    with firefox_tab(path, tmp_path / "profile") as tab:
        tab.command("WebDriver:Navigate", url=server.address)
        tab.until(f"{_AT_REST} && JSON.stringify({_POINTS}) === '[25,25,25]'", 120.0)
        for step in (*STEPS, "export", "contact"):
            tab.value("document.querySelector(`#steps a[href='#${given[0]}']`).click()", step)
            tab.until(f"document.querySelector('#step-{step}:not([hidden]) .step-body > *') !== null")
            tab.until(f"{_AT_REST} && {_STALE}.length === 0", 60.0)
        tab.until(f"{_STATUS} === 'converged'", 60.0)
        before = tab.value("document.querySelector('.live-contact .value').textContent")
        tab.value(
            "(({ slider }) => { slider.value = '150'; slider.dispatchEvent(new Event('input', { bubbles: true })); "
            "slider.dispatchEvent(new Event('change', { bubbles: true })); })"
            "({ slider: document.getElementById('live-speed') })"
        )
        other = (
            f"document.querySelector('.live-contact .value').textContent !== {before!r} && {_STATUS} === 'converged'"
        )
        tab.until(other, 60.0)
        tab.value("document.querySelector('button[aria-label=Undo]').click()")
        tab.until(f"document.querySelector('.live-contact .value').textContent === {before!r}", 60.0)
        tab.value("document.querySelector('button[title=Dark]').click()")
        tab.until("document.documentElement.dataset.theme === 'dark'")
        paper = "getComputedStyle(document.querySelector('#figure-friction-curve .main-svg')).backgroundColor"
        tab.until(f"{paper} === 'rgb(27, 32, 37)'")
        assert tab.errors(server.base) == []
