"""Figures in a real browser: drawn as results say, in the user's units, with the picked isotherm strong in all."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest

from web.browser_tab import tab as opened_tab

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

NBSP = "\N{NO-BREAK SPACE}"
_DRAW = """(({render, html}, id, result, place = document.createElement('div')) => {
  document.querySelector('#step-export').append(place);
  const study = page.state.state.study;
  new page.jobs.Job(id, { inputs: () => ({ study }) }).put({ study }, result);
  render(html`<${page.figures.Figure} id=${id} of=${result} />`, place);
})(page.reactive, ...given)"""


@pytest.fixture(scope="module")
def tab(browser: Browser, server: Server) -> Iterator[Tab]:
    """Have a tab in which figures are drawn."""
    with opened_tab(browser, server, "#export") as opened:
        yield opened


def figure(name: str, x: dict[str, Any], traces: list[dict[str, Any]]) -> dict[str, Any]:
    return {"figures": {name: {"title": name, "x": x, "y": {"label": "friction"}, "traces": traces}}}


def at_temperatures(name: str, *kelvin: float) -> dict[str, Any]:
    """Return a result with one curve at each temperature."""
    curves = [
        {"speed": [0.001, 0.01, 0.1], "friction": [0.01 * at, 0.02 * at, 0.03 * at]} for at in range(1, 1 + len(kelvin))
    ]
    traces = [
        {"x": f"curves[{at}].speed", "y": f"curves[{at}].friction", "mode": "lines+markers", "temperature": one}
        for at, one in enumerate(kelvin)
    ]
    return {"curves": curves, **figure(name, {"label": "speed", "kind": "speed", "log": True}, traces)}


def draw(tab: Tab, name: str, result: dict[str, Any]) -> str:
    """Draw a figure of a result; return an expression of its plot."""
    tab.value(_DRAW, name, result)
    plot = f"document.querySelector('#figure-{name} .plot')"
    tab.until(f"page.figures.areDrawn() && {plot}.data?.length > 0")
    return plot


def test_columns_are_read_from_the_result_and_named_after_their_temperature(tab: Tab) -> None:
    plot = draw(tab, "columns", at_temperatures("columns", 303.15, 363.15))
    assert tab.value(f"{plot}.data.map((one) => one.name)") == [f"30{NBSP}°C", f"90{NBSP}°C"]
    assert tab.value(f"Array.from({plot}.data[0].x)") == pytest.approx([1.0, 10.0, 100.0])  # mm/s
    assert tab.value(f"Array.from({plot}.data[1].y)") == pytest.approx([0.02, 0.04, 0.06])


def test_an_isotherm_picked_in_one_figure_is_strong_in_all(tab: Tab) -> None:
    kelvin = (303.15, 333.15, 363.15)
    plots = [draw(tab, name, at_temperatures(name, *kelvin)) for name in ("one", "other")]

    def look(plot: str) -> list[list[float]]:
        tab.until("page.figures.areDrawn()")
        return tab.value(f"{plot}.data.map((one) => [one.opacity, one.line.width])")

    before = [look(plot) for plot in plots]
    assert before[0] == before[1] == [[1, 2]] * 3

    def click() -> None:
        """Click on the middle point of the second curve of the first figure."""
        tab.page.locator("#figure-one .plot").scroll_into_view_if_needed()
        x, y = tab.value(
            f"""(({{ data, _fullLayout: {{ xaxis, yaxis }} }}, box) => [
              box.left + xaxis._offset + xaxis.d2p(data[1].x[1]), box.top + yaxis._offset + yaxis.d2p(data[1].y[1])])(
              {plots[0]}, {plots[0]}.getBoundingClientRect())"""
        )
        tab.page.mouse.move(x, y)
        tab.page.mouse.click(x, y)

    click()
    tab.until("Math.abs(page.figures.picked() - 333.15) < 1e-9")
    for plot in plots:
        (cold, _), (opacity, width), (warm, _) = look(plot)
        assert opacity == 1
        assert width > 2
        assert cold == warm < 0.5
    assert f"60{NBSP}°C picked" in tab.text("#figure-other figcaption")
    tab.page.locator("#figure-other").get_by_role("button", name="picked").click()
    tab.until("page.figures.picked() === null")
    assert [look(plot) for plot in plots] == before


def test_more_than_six_temperatures_have_a_colour_bar_instead_of_a_legend(tab: Tab) -> None:
    def shown(count: int) -> tuple[bool, list[Any]]:
        kelvin = [303.15 + 10.0 * at for at in range(count)]
        plot = draw(tab, f"bar-{count}", at_temperatures(f"bar-{count}", *kelvin))
        bars = tab.value(
            f"{plot}.data.filter((one) => one.marker?.showscale).map(({{ marker }}) => [marker.cmin, marker.cmax])"
        )
        return tab.value(f"{plot}.layout.showlegend"), bars

    assert shown(6) == (True, [])
    legend, ((low, high),) = shown(7)
    assert not legend
    assert (low, high) == (pytest.approx(30.0, abs=0.06), pytest.approx(90.0, abs=0.06))  # °C, to a tenth of a degree


def test_axes_name_the_quantity_that_their_unit_has(tab: Tab) -> None:
    omega = {"label": "reduced {frequency} α {omega}", "kind": "angular_frequency", "log": True}
    plot = draw(tab, "axes", figure("axes", omega, [{"x": [2.0, 20.0, 200.0], "y": [1.0, 2.0, 3.0]}]))
    title, values = f"{plot}.layout.xaxis.title.text", f"Array.from({plot}.data[0].x)"
    assert tab.value(title) == "reduced frequency α f (Hz)"
    in_hertz = tab.value(values)
    tab.value("page.units.choose('frequency', 'rad/s')")
    tab.until(f"{title} === 'reduced angular frequency α ω (rad/s)'")
    assert tab.value(values) == pytest.approx([2.0, 20.0, 200.0])
    assert in_hertz == pytest.approx([one / (2.0 * math.pi) for one in (2.0, 20.0, 200.0)])
    tab.value("page.units.choose('frequency', 'Hz')")


def test_ticks_of_a_log_axis_are_read_at_once(tab: Tab) -> None:
    speed = {"label": "speed", "kind": "speed", "log": True}
    plot = draw(tab, "ticks", figure("ticks", speed, [{"x": [0.02, 0.2], "y": [1.0, 2.0]}]))
    assert {"20", "50", "100", "200"} <= set(tab.value(f"{plot}.layout.xaxis.ticktext"))


def test_a_printed_page_has_no_buttons_and_dark_ink(tab: Tab) -> None:
    controls = "button:not(.term), .button, .drop, input[type=range], .progress, nav, details:not([open])"
    seen = f"[...document.querySelectorAll('{controls}')].filter((one) => one.checkVisibility()).length"
    ink = "getComputedStyle(document.querySelector('.step:not([hidden]) h1')).color"
    tab.page.get_by_role("button", name="change to dark").click()
    assert tab.value(ink) == "rgb(228, 232, 236)"
    for step in ("contact", "sweeps", "motion", "measurement", "export"):
        tab.step(step)
        assert tab.value(seen) > 0
        tab.page.emulate_media(media="print")
        assert tab.value(seen) == 0, step
        assert tab.value(ink) == "rgb(29, 35, 41)", step
        tab.page.emulate_media(media="screen")
