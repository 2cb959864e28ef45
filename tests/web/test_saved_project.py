"""A study that is saved and opened in another browser has the same numbers on all steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from web.browser_tab import tab as opened_tab
from web.every_input import STEPS, STUDY, at_rest, example

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

#: Of one step: all numbers that are seen in words, and what its figures show.
_WORDS = """[...document.querySelectorAll('.step:not([hidden]) :is(.key-numbers, .more-numbers, .notes, .files, .why)')]
  .map((one) => one.textContent)"""


#: Labels of numbers without a definition.
_UNDEFINED = """[...document.querySelectorAll('.step:not([hidden]) :is(.key-numbers dt, .more-numbers td:first-child)')]
  .filter((one) => !one.querySelector('.term')).map((one) => one.textContent)"""


def shown(tab: Tab) -> dict[str, Any]:
    """Return the numbers of each step once it computes nothing more: words, figures, and what its fields contain."""
    found = {}
    for step in STEPS:
        tab.step(step)
        if step == "motion":
            tab.page.get_by_role("button", name="Solve", exact=True).click()
        seen = at_rest(tab, 90.0)
        assert any(figure["inputs"] for figure in seen.values()), step
        # the name of inputs counts how often a tab got a file; all else is compared
        figures = {name: {key: value for key, value in one.items() if key != "inputs"} for name, one in seen.items()}
        assert tab.value(_UNDEFINED) == [], step
        fields = tab.value(
            "[...document.querySelectorAll('.step:not([hidden]) :is(input, select)')].map((one) => one.value)"
        )
        found[step] = (tab.value(_WORDS), figures, fields)
    return found


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_a_saved_study_has_the_same_numbers_in_another_browser(
    browser: Browser, server: Server, tmp_path: Path
) -> None:
    packed = tmp_path / "study.zip"
    with opened_tab(browser, server, "#export") as tab:
        example(tab, {**STUDY, "solver": {**STUDY["solver"], "accuracy": 0.05}})
        before = shown(tab)
        tab.step("export")
        with tab.page.expect_download() as download:
            tab.page.get_by_role("button", name="Save project").click()
        download.value.save_as(packed)
        study = tab.value("page.state.state.study")
    with opened_tab(browser, server, "#export") as fresh:
        assert fresh.value("page.state.state.study") != study
        with fresh.page.expect_file_chooser() as chooser:
            fresh.page.get_by_role("button", name="Open project").click()
        chooser.value.set_files(packed)
        fresh.until("document.getElementById('announcements').textContent.startsWith('study.zip is opened')")
        assert fresh.value("page.state.state.study") == study
        after = shown(fresh)
    for step in STEPS:
        assert after[step] == before[step], step
