"""The step “Motion in time” in a real browser: a history edited, dragged, solved, stopped and refused; an impact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from web.browser_tab import tab as opened_tab
from web.contact_studies import ROUGH

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

pytestmark = pytest.mark.apart  # a browser
_STEP = "#step-motion"
_HISTORY = "page.state.state.view('motion')"


def solved(tab: Tab) -> None:
    tab.page.get_by_role("button", name="Solve", exact=True).click()
    tab.until(f"document.querySelector('{_STEP} .progress').classList.contains('done')", 60.0)


def test_a_history_is_edited_dragged_and_solved(tab: Tab) -> None:
    page = tab.page
    tab.step("motion")
    assert tab.value(f"{_HISTORY}.rows") == [[0, 0, 0], [0.1, 10, 0], [1.1, 10, 0]]
    load = page.get_by_label("Load of point 3")
    load.fill("20 mN")
    load.press("Tab")
    assert tab.value(f"{_HISTORY}.rows[2]") == [1.1, 0.02, 0]
    page.get_by_role("button", name="Undo").click()
    assert tab.value(f"{_HISTORY}.rows[2]") == [1.1, 10, 0]
    assert load.input_value() == "10"
    page.get_by_role("button", name="Redo").click()
    assert tab.value(f"{_HISTORY}.rows[2]") == [1.1, 0.02, 0]
    load.fill("soon")
    load.press("Tab")
    assert load.get_attribute("aria-invalid") == "true"
    assert tab.value(f"{_HISTORY}.rows[2]") == [1.1, 0.02, 0]
    load.fill("20")
    load.press("Tab")
    place = page.locator(f"{_STEP} circle").nth(1).bounding_box()
    assert place is not None
    page.mouse.move(place["x"] + 3, place["y"] + 3)
    page.mouse.down()
    page.mouse.move(place["x"] + 103, place["y"] - 20)
    page.mouse.up()
    rows = tab.value(f"{_HISTORY}.rows")
    assert 0.1 < rows[1][0] < 0.5
    assert 10.0 < rows[1][1] < 20.0
    assert float(page.get_by_label("Load of point 2").input_value()) == rows[1][1]

    page.get_by_text("History of the study").click()
    solved(tab)
    found = tab.value("page.jobs.result('motion')")
    assert found["method"] == "springs"
    assert found["load"][-1] == pytest.approx(20.0, rel=1e-6)
    tab.until("document.querySelector('#figure-motion-indentation .plot').data?.length > 0")
    assert not page.locator("#figure-motion-friction").is_visible()
    assert tab.findings() == []
    assert tab.value("document.documentElement.scrollWidth - innerWidth") <= 0
    tab.screenshot("motion-hold")

    page.get_by_role("button", name="Use in the study").click()
    tab.until(
        "page.state.state.get('history')?.file !== undefined || document.querySelector('details .notes.error li')"
    )
    assert tab.value("page.state.state.get('history')") is None  # a table of one load and speed; the study has 25
    page.get_by_label("Example").select_option("start")
    page.get_by_role("button", name="Use in the study").click()
    tab.until("page.state.state.get('history')?.slide !== undefined")
    tab.until("page.jobs.result('export-run-file')?.text.includes('[history]')")
    drawn = tab.value(f"{_HISTORY}.rows")
    page.get_by_label("Dwell, one or several").fill("0.1, 1")
    page.get_by_label("Dwell, one or several").press("Tab")
    tab.until("page.jobs.result('export-run-file')?.text.includes('dwell = [')")
    page.get_by_role("button", name="Show the study’s").click()
    tab.until(f"{_HISTORY}.rows[1][0] === 0.1")
    assert len(tab.value(f"{_HISTORY}.rows")) == len(drawn) == 4
    tab.screenshot("motion-study")
    page.get_by_role("button", name="Remove from the study").click()

    # another history: the results are of earlier inputs, and a wrong one is marked in its row
    time = page.get_by_label("Time of point 4")
    time.fill("0.05")
    time.press("Tab")
    assert page.locator("#figure-motion-load.stale").count() == 1
    for theme in ("dark", "light"):
        page.get_by_role("button", name=f"change to {theme}").click()
        page.mouse.move(0, 0)
        tab.until("document.getAnimations().length === 0")
        assert tab.findings() == [], theme
        tab.screenshot(f"motion-stale-{theme}")
    solved(tab)
    page.locator(f"{_STEP} .notes.error:not([hidden])").first.wait_for()
    assert page.get_by_label("Time of point 4").get_attribute("aria-invalid") == "true"


_TIME = "Time of the pressure"
_DRAWN = "Array.from(document.querySelector('#figure-motion-pressure .plot').data[0].y)"


def expected(tab: Tab, at: int) -> list[float]:
    """Return the pressure of a time in the user's unit."""
    found: list[float] = tab.value(
        "page.units.number(page.jobs.newest('motion').animation.pressure[given[0]], 'pressure')", at
    )
    return found


@pytest.mark.parametrize("moves", [True, False])
def test_the_pressure_is_played_and_reached_by_keyboard(browser: Browser, server: Server, moves: bool) -> None:
    look: dict[str, Any] = {"color_scheme": "dark", "reduced_motion": "no-preference" if moves else "reduce"}
    with opened_tab(browser, server, "#motion", **look) as tab:
        page, slider = tab.page, tab.page.get_by_label(_TIME)
        assert slider.is_disabled()  # there is nothing to play
        assert "press Solve" in tab.text("#figure-motion-pressure .plot-empty")
        solved(tab)
        last = tab.value("page.jobs.newest('motion').animation.time.length") - 1
        assert slider.input_value() == "0"
        for key, at in (("End", last), ("ArrowLeft", last - 1), ("Home", 0)):
            slider.press(key)
            tab.until("page.figures.areDrawn()")
            assert slider.input_value() == str(at)
            assert tab.value(_DRAWN) == pytest.approx(expected(tab, at))
        page.get_by_role("button", name="Play" if moves else "Next", exact=True).press("Enter")
        if moves:
            page.get_by_role("button", name="Pause", exact=True).wait_for()
            tab.until(f"Number(document.querySelector('[aria-label=\"{_TIME}\"]').value) > 0")
            page.get_by_role("button", name="Pause", exact=True).press("Space")
            paused = slider.input_value()
            page.wait_for_timeout(300)
            assert 0 < int(slider.input_value()) == int(paused) < last
            page.get_by_role("button", name="Play", exact=True).click()
            tab.until(f"document.querySelector('[aria-label=\"{_TIME}\"]').value === '{last}'")
            page.get_by_role("button", name="Play", exact=True).wait_for()  # it stops at the end
        else:
            page.wait_for_timeout(300)
            assert 0 < int(slider.input_value()) < last  # one step, without a motion
        tab.until("page.figures.areDrawn()")
        assert tab.value(_DRAWN) == pytest.approx(expected(tab, int(slider.input_value())))
        assert "255, 255, 255" not in (
            page.locator("#figure-motion-pressure svg.main-svg").first.get_attribute("style") or ""
        )
        assert tab.findings() == []
        tab.screenshot(f"motion-pressure-{'dark' if moves else 'reduced'}")


def test_a_mass_hits_the_material(tab: Tab) -> None:
    tab.step("motion")
    tab.page.get_by_label("Example").select_option("impact")
    tab.page.get_by_label("Speed (m/s)").fill("0.5")
    tab.page.get_by_label("Speed (m/s)").press("Tab")
    solved(tab)
    assert 0.0 < tab.value("page.jobs.result('motion').contacts[0].restitution") < 1.0
    assert "restitution 0." in tab.text('#steps a[href="#motion"] .step-summary')
    tab.screenshot("motion-impact")


def test_a_rough_surface_goes_back_and_forth_until_it_is_stopped(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server, "#export") as tab:
        tab.value("page.state.state.replace(given[0])", ROUGH)
        tab.step("motion")
        tab.page.get_by_label("Example").select_option("back")
        tab.page.get_by_label("Motion given as").select_option("position")
        positions = [row[2] for row in tab.value(f"{_HISTORY}.rows")]
        assert positions[0] == positions[-1] == 0.0 < max(positions)
        tab.page.get_by_role("button", name="Solve", exact=True).click()
        tab.until(f"document.querySelector('{_STEP} progress').value > 1e-3", 60.0)
        tab.page.get_by_role("button", name="Cancel").click()
        tab.page.get_by_text("Stopped; the results end after").wait_for(timeout=30_000)
        found = tab.value("page.jobs.result('motion')")
        assert found["interrupted"] == 1
        assert 0.0 < found["time"][-1] < tab.value(f"{_HISTORY}.rows").pop()[0]
        tab.screenshot("motion-stopped")
