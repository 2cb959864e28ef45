"""The last step of the page in a real browser: the study run, cancelled, finished, and what is downloaded."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import viscofric

if TYPE_CHECKING:
    from web.browser_tab import Tab

_FINISHED = {
    "downloads": [{"name": "report.html", "title": "report", "size": 911_137}],
    "cases": 75,
    "summary": "75 cases, results ready",
    "failed": 1,
    "key_numbers": [{"label": "cases", "value": "75", "kind": "plain", "remark": "1 failed"}],
    "failures": ["30 °C, 1 mm/s: it did not converge."],
    "warnings": [],
    "notes": ["The rubber is synthetic."],
    "synthetic": True,
}


def packed_study(path: Path) -> dict[str, Any]:
    """Return the run file of an archive, as a browser is given files."""
    with zipfile.ZipFile(path) as packed:
        return {"name": "mine.toml", "mimeType": "text/plain", "buffer": packed.read("study.toml")}


def closing(tab: Tab) -> bool:
    """Return whether the page asks before it is closed."""
    return not tab.value("window.dispatchEvent(new Event('beforeunload', { cancelable: true }))")


@pytest.mark.apart
def test_study_is_cancelled_finished_and_downloaded_in_the_page(tab: Tab) -> None:
    page = tab.page
    page.get_by_role("button", name="Run the whole study").click()
    page.get_by_text("solving contacts").wait_for()
    page.get_by_role("button", name="Cancel").click()
    page.get_by_text("Cancelled; solved contacts are kept").wait_for()
    with page.expect_download() as download:
        page.get_by_role("button", name="Save project").click()
    with zipfile.ZipFile(download.value.path()) as packed:
        assert packed.namelist() == ["study.toml"]
    assert not closing(tab)

    taken = packed_study(download.value.path())
    page.get_by_label("Title of the study and report").fill("Another")
    page.get_by_label("Title of the study and report").press("Enter")
    assert closing(tab)
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="Open project").click()
    chooser.value.set_files(files=[taken])
    tab.until("page.state.state.get('title') === 'Friction of a synthetic fluoroelastomer'")
    assert not closing(tab)

    # the end of a run, without the minute that its report takes
    reported = [
        {"event": "progress", "done": 1, "total": 2, "label": "solving"},
        {"event": "result", "result": _FINISHED},
    ]
    body = "".join(json.dumps(one) + "\n" for one in reported)
    page.route("**/api/jobs/export-study", lambda route: route.fulfill(body=body))
    page.get_by_role("button", name="Run the whole study").click()
    link = page.get_by_role("link", name="report.html")
    assert (link.get_attribute("href") or "").startswith("/api/downloads/report.html?workspace=")
    assert "75 cases, results ready" in tab.text("#steps")
    tab.until("document.getElementById('announcements').textContent.startsWith('The study is finished: 75 cases, 1')")
    assert tab.findings() == []
    tab.screenshot("export-finished")
    tab.value("page.state.state.set('title', 'A third')")
    page.get_by_text("The study has changed; run it again").wait_for()
    assert link.count() == 0


def test_card_of_measured_shift_factors_offers_a_law(tab: Tab) -> None:
    """SYNTHETIC sweeps, shifted as measured: Abaqus takes no table of the factors."""
    page = tab.page
    sweeps = (Path(viscofric.__file__).parent / "example" / "dma.csv").read_text(encoding="utf-8")
    tab.value("await (await import('/static/js/api.js')).uploadFiles([new File([given[0]], 'dma.csv')])", sweeps)
    tab.value("page.state.state.set('material', {dma: ['dma.csv'], reference_temperature: '30 degC'})")
    card = page.get_by_role("group", name="Card")
    page.get_by_role("button", name="Write the card").click()
    page.get_by_text("choose a law under “Shift law” to write it").wait_for()
    assert "*TRS" not in card.inner_text()
    page.get_by_label("Shift law").select_option("wlf")
    page.get_by_role("button", name="Write the card").click()
    page.get_by_text("*TRS, DEFINITION=WLF").wait_for()
    assert page.get_by_text("choose a law under “Shift law” to write it").count() == 0
