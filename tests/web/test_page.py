"""The page in a real browser: light, private, usable without a mouse and without eyes, and it forgets nothing."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from web.browser_tab import tab as opened_tab
from web.every_input import STEPS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

_LARGEST_PAGE = 700_000  # bytes over the wire, all steps
_MOST_REQUESTS = 30
_ALL = (*STEPS, "export")


def test_page_is_light_and_asks_no_other_host(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server) as tab:
        tab.until("Boolean(window.Plotly)")
        tab.page.wait_for_selector("#step-contact .figure")
        # what is computed comes from /api/jobs and is no part of the page
        begun = [path for path, _ in tab.requested if not path.startswith("/api/jobs/")]
        assert len(begun) <= _MOST_REQUESTS, begun
        for step in STEPS:
            tab.step(step)
    fetched = [(path, size) for path, size in tab.requested if not path.startswith("/api/jobs/")]
    assert sum(size for _, size in fetched) <= _LARGEST_PAGE
    # that no other host was asked, and nothing was blocked by the content security policy, is what every tab minds
    assert any(path.endswith("plotly-cartesian.min.js") for path, _ in fetched)


def test_keyboard_reaches_steps_and_focus_goes_to_their_heading(tab: Tab) -> None:
    press = tab.page.keyboard.press
    focused = "document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent"
    order = []
    for _ in range(6 + len(STEPS) + 2):
        press("Tab")
        order.append(tab.value(focused))
    # undo and redo are disabled: nothing has been changed
    skip, brand, save, opens, units, theme, *steps, first = order
    assert (skip, save, opens, units) == ("Skip to content", "Save project", "Open project", "Units")
    assert brand.startswith("viscofric")
    assert "change to" in theme
    titles = tab.value("given.map((step) => page.state.page.steps.get(step).title)", *_ALL)
    numbered = [f"{at + 1}{title}" for at, title in enumerate(titles)]
    assert [one[: len(title)] for one, title in zip(steps, numbered, strict=True)] == numbered
    assert tab.value("document.activeElement.closest('#step-export') !== null"), first  # then the content
    tab.page.focus(".skip")
    press("Enter")
    tab.page.focus('#steps a[href="#sweeps"]')
    press("Enter")
    assert tab.value("document.activeElement.textContent") == tab.text("#title-sweeps")
    assert tab.page.title() == f"{tab.text('#title-sweeps')} · viscofric"
    assert tab.value("document.querySelectorAll('[aria-current=step]').length") == 1
    tab.page.go_back()
    tab.page.wait_for_selector("#step-export:not([hidden])")
    assert tab.page.title() == "Export · viscofric"


def test_changes_are_checked_undone_and_survive_a_reload(tab: Tab) -> None:
    page = tab.page
    assert tab.text("#synthetic") == "synthetic data"
    page.get_by_text("run file: 75 cases").wait_for()  # in the list of steps
    page.get_by_label("Accuracy of friction").fill("5")
    page.get_by_label("Title of the study and report").fill("My ball")
    page.get_by_label("Title of the study and report").press("Enter")
    page.wait_for_selector(".field-error:not([hidden])")
    error = page.get_by_label("Accuracy of friction").locator("xpath=..").locator(".field-error")
    assert "0.1" in error.inner_text()
    described = page.get_by_label("Accuracy of friction").get_attribute("aria-describedby") or ""
    assert error.get_attribute("id") in described.split()
    assert page.get_by_label("Accuracy of friction").get_attribute("aria-invalid") == "true"
    page.get_by_role("button", name="Save project").click()
    tab.until("document.getElementById('announcements').textContent.startsWith('Error: ')")

    page.reload()
    page.wait_for_selector("pre .heading")
    assert page.get_by_label("Title of the study and report").input_value() == "My ball"
    page.get_by_role("button", name="Undo").click()
    page.get_by_role("button", name="Undo").click()
    assert page.get_by_role("button", name="Undo").is_disabled()
    page.wait_for_selector(".field-error", state="hidden")
    tab.until("document.querySelector('pre').textContent.includes('accuracy = 0.01')")
    tab.until("document.getElementById('announcements').textContent === 'Undone.'")
    page.get_by_role("button", name="Redo").click()
    assert page.get_by_label("Accuracy of friction").input_value() == "5"


def test_a_number_has_no_more_digits_than_its_error_leaves(tab: Tab) -> None:
    def shown(*arguments: str) -> list[str]:
        return tab.value(f"page.units.showWithError({', '.join(arguments)}).map((one) => one.replace('\\u00a0', ' '))")

    assert shown("9.861e-6", "0.23e-6", "'area'", "4") == ["9.86 mm²", "0.23 mm²"]
    assert shown("9.438e9", "1.0418e10", "'modulus'") == ["9000 MPa", "10000 MPa"]
    assert shown("1.8162e-3", "4.2e-5", "'length'", "4") == ["1.816 mm", "0.042 mm"]
    assert shown("0.0128", "null", "'plain'") == ["0.0128", ""]


def test_units_are_the_users_and_are_remembered(tab: Tab) -> None:
    shown = "[page.units.show(0.02, 'speed'), page.units.show(303.15, 'temperature'), page.units.show(2e6, 'modulus')]"
    assert tab.value(shown) == ["20\u00a0mm/s", "30\u00a0°C", "2\u00a0MPa"]
    tab.page.get_by_role("button", name="Units").click()
    tab.page.get_by_role("button", name="SI").click()
    tab.page.locator("#unit-temperature").select_option("°F")
    tab.page.reload()
    tab.page.wait_for_selector("#steps [aria-current]")
    assert tab.value(shown) == ["0.02\u00a0m/s", "86\u00a0°F", "2×10⁶\u00a0Pa"]
    # there and back, through the words of a run file, of all units that the menu offers
    far = tab.value(
        """page.units.choices().flatMap(({kind, units}) => units.map((unit) => {
          page.units.choose(kind, unit);
          const back = page.units.parse(page.units.words(412.5, kind, 12), kind);
          return [kind, unit, Math.abs(back / 412.5 - 1)];
        })).filter(([, , error]) => !(error < 1e-11))"""
    )
    assert far == []  # words have twelve digits


_SPEEDS = """(({render, html}, {Form}, place = document.createElement('form')) => {
  document.querySelector('#step-export').append(place);
  render(html`<${Form} of=${[{path: 'conditions.speed', label: 'Speed', as: 'range', kind: 'speed'}]} />`, place);
})(page.reactive, page.fields)"""


def test_a_decimal_comma_is_no_list_and_a_list_needs_no_other_form(tab: Tab) -> None:
    tab.value("page.state.state.set('conditions.speed', ['1 mm/s', '2 mm/s'])")
    tab.value(_SPEEDS)
    place = tab.page.locator("#step-export form").last
    for typed, taken in (
        ("2,5 mm/s; 10 mm/s", ["2,5 mm/s", "10 mm/s"]),
        ("2,5 mm/s, 10", ["2,5 mm/s", "10 mm/s"]),
        ("20 mm/s", ["20 mm/s"]),
        ("2,5 mm/s", "2,5 mm/s"),  # the field has one value now
        ("5, 7 mm/s", ["5 mm/s", "7 mm/s"]),
        ("5 mm/s,7 mm/s", ["5 mm/s", "7 mm/s"]),
    ):
        box = place.locator("input[type=text]").first
        box.fill(typed)
        box.press("Tab")
        assert tab.value("page.state.state.get('conditions.speed')") == taken, typed


@pytest.fixture(scope="module")
def drawing(browser: Browser, server: Server) -> Iterator[Tab]:
    """Have a tab in which figures are drawn."""
    with opened_tab(browser, server, "#export") as tab:
        yield tab


_FIGURE = """(({render, html}, figure, place = document.createElement('div')) => {
  document.querySelector('#step-export').append(place);
  render(html`<${page.figures.Figure} ...${figure} />`, place);
})(page.reactive, {
  id: 'drawn', title: 'Two curves', caption: 'Of a test', hint: 'Click it', synthetic: true,
  x: {label: 'speed', kind: 'speed', log: true}, y: {label: 'friction'},
  traces: [303.15, 363.15].map((temperature) => ({name: page.units.show(temperature, 'temperature'), temperature,
    x: [0.001, 0.1], y: [0.01, 0.02], lower: [0.009, 0.018], upper: [0.011, null]}))})"""


def test_figures_come_with_their_numbers_and_as_files(drawing: Tab) -> None:
    drawing.value(_FIGURE)
    figure = drawing.page.locator("#figure-drawn")
    figure.locator(".main-svg").first.wait_for()
    label = figure.locator(".plot").get_attribute("aria-label") or ""
    assert "friction against speed. 30\u00a0°C: 0.01 to 0.02 for speed 1\u00a0mm/s to 100\u00a0mm/s" in label
    figure.get_by_role("button", name="Table").click()
    assert figure.locator("tbody tr").count() == 2
    assert figure.locator("tbody tr").first.locator("td").first.inner_text() == "1"
    files = {}
    for form in ("CSV", "SVG", "PNG"):
        with drawing.page.expect_download() as download:
            figure.get_by_role("button", name=form).click()
        assert download.value.suggested_filename == f"drawn.{form.lower()}"
        files[form] = download.value.path().read_bytes()
    rows = files["CSV"].decode().splitlines()
    assert rows[0] == "# Two curves (synthetic material)"
    assert rows[1] == "# Of a test"  # what can be done on the page is no remark of a file
    assert "Click it" in figure.locator("figcaption").inner_text()
    assert rows[2].startswith('speed (mm/s),"friction, 30\u00a0°C","lower friction, 30\u00a0°C"')
    assert rows[4] == "100,0.02,0.018,,0.02,0.018,"
    assert b"Two curves" in files["SVG"]
    assert b"synthetic data" in files["SVG"]
    assert files["SVG"].startswith(b"<svg")
    assert files["PNG"].startswith(b"\x89PNG")
    # as wide as is asked for, twice over for sharp prints
    assert int.from_bytes(files["PNG"][16:20], "big") == 1800


def test_a_file_of_a_figure_is_light_or_dark_as_the_page(drawing: Tab) -> None:
    drawing.value(_FIGURE.replace("'drawn'", "'filed'"))
    figure = drawing.page.locator("#figure-filed")
    figure.locator(".main-svg").first.wait_for()
    for scheme, paper in (("dark", b"rgb(27, 32, 37)"), ("light", b"rgb(255, 255, 255)")):
        drawing.page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
        with drawing.page.expect_download() as download:
            figure.get_by_role("button", name="SVG").click()
        assert b"fill: " + paper in download.value.path().read_bytes()


def test_the_title_of_a_file_stands_above_all_rows_of_its_legend(drawing: Tab) -> None:
    long = _FIGURE.replace("'drawn'", "'titled'").replace(
        "page.units.show(temperature, 'temperature')", "'a'.repeat(90)"
    )
    drawing.value(long)
    figure = drawing.page.locator("#figure-titled")
    figure.locator(".main-svg").first.wait_for()
    with drawing.page.expect_download() as download:
        figure.get_by_role("button", name="SVG").click()
    file = drawing.page.context.new_page()
    file.set_content(download.value.path().read_text(encoding="utf-8"))
    boxes = file.evaluate(
        """Array.from(document.querySelectorAll('text'), (one) => {
          const { top, bottom } = one.getBoundingClientRect();
          return [one.textContent, [top, bottom]];
        })"""
    )
    file.close()
    (title,) = [rows for text, rows in boxes if text == "Two curves"]
    names = [rows for text, rows in boxes if set(text) == {"a"}]
    assert names[0][1] <= names[1][0]  # two rows
    assert 0.0 <= title[0] < title[1] <= names[0][0]


def test_figures_follow_light_dark_and_units(drawing: Tab) -> None:
    drawing.value(_FIGURE.replace("'drawn'", "'again'"))
    drawing.page.wait_for_selector("#figure-again .main-svg")

    def drawn() -> tuple[str, str]:
        svg = drawing.page.locator("#figure-again svg.main-svg").first
        return svg.get_attribute("style") or "", drawing.text("#figure-again .xtitle")

    light, label = drawn()
    assert label == "speed (mm/s)"
    assert "255, 255, 255" in light
    drawing.page.get_by_role("button", name=re.compile("change to dark")).click()
    drawing.value("page.units.choose('speed', 'm/s')")
    drawing.until("document.querySelector('#figure-again .xtitle')?.textContent === 'speed (m/s)'")
    dark, _ = drawn()
    assert "255, 255, 255" not in dark
    drawing.page.reload()
    drawing.page.wait_for_selector("#steps [aria-current]")
    assert drawing.value("page.figures.isDark()")


def test_temperatures_have_one_colour_each_from_cold_blue_to_warm_red(drawing: Tab) -> None:
    colour = "((all) => all.map((one) => page.figures.temperatureColour(one, all, false)))(given)"
    assert drawing.value(colour, 303.15, 333.15, 363.15) == ["#0072b2", "#009e73", "#d55e00"]  # as in reports
    many = drawing.value(colour, *range(243, 503, 10))
    assert len(set(many)) == len(many)

    def redness(text: str) -> int:
        return int(text[1:3], 16) - int(text[5:7], 16)

    assert redness(many[0]) < 0 < redness(many[-1])
