"""The measurement step in a real browser: files in, friction beside its prediction, one curve, the rubber behind it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

import viscofric as vf
from web.friction_workspace import curves

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, Locator

    from web.browser_tab import Tab
    from web.served_page import Server

pytestmark = pytest.mark.apart
_SECONDS = 60.0  # at most, on a machine that does other work too
_STEP = "#step-measurement"


@pytest.fixture
def tab(browser: Browser, server: Server) -> Iterator[Tab]:
    """Open the page at this step, so that no other one computes; contacts are solved roughly."""
    from web.browser_tab import tab

    with tab(browser, server, "#measurement") as opened:
        opened.page.wait_for_selector(f"{_STEP} .drop")
        opened.value("page.state.state.set('solver.accuracy', 0.05)")
        yield opened


def drop(tab: Tab, *paths: Path) -> None:
    tab.page.set_input_files(f"{_STEP} input[type=file]", [str(path) for path in paths])


def names_of_curves(tab: Tab, figure: str) -> list[str]:
    """Return what is drawn in a figure: the names of its curves, without the edges of their bands."""
    found = tab.value(
        "Array.from(document.querySelector(given[0])?.data ?? [], (one) => one.name)", f"#figure-{figure} .plot"
    )
    return [name for name in found if name]


def until_drawn(tab: Tab, figure: str, curves: int) -> None:
    place = f"#figure-{figure} .plot"
    tab.until(
        f"(document.querySelector('{place}')?.data ?? []).filter((one) => one.name).length === {curves}", _SECONDS
    )


def part(tab: Tab, title: str) -> Locator:
    heading = tab.page.get_by_role("heading", name=title, exact=True)
    return tab.page.locator(f"{_STEP} section.card").filter(has=heading)


def test_columns_that_are_not_understood_are_asked(tab: Tab, tmp_path: Path) -> None:
    rows = [
        f"{T},25,{s * v},{s * v - 0.1 * r * v},{s * 0.3 + r * 1.2}"
        for T in (30, 60)
        for v in (20, 60)
        for s in (-1, 1)
        for r in (-1, 1)
    ]
    strange = tmp_path / "strange.csv"
    strange.write_text("\n".join(["T (degC),load (N),V1,ball speed (mm/s),traction force (N)", *rows, ""]))
    drop(tab, strange)
    step = tab.page.locator(_STEP)
    step.get_by_label("Column of the disc speed").select_option(label="V1")
    step.get_by_label("Unit of the disc speed").fill("mm/s")
    step.get_by_role("button", name="Read with these columns").click()
    tab.until("page.jobs.result('measured')?.runs === true", _SECONDS)
    assert tab.value("page.state.state.get('measurement')") == {
        "mtm": "strange.csv",
        "columns": {"disc_speed": "V1 (mm/s)"},
    }
    step.get_by_role("button", name="Clear the column names").click()
    step.get_by_label("Column of the disc speed").wait_for()


def test_a_value_of_all_rows_is_asked(tab: Tab, tmp_path: Path) -> None:
    wide = tmp_path / "wide.csv"
    rows = [f"{v},{0.02 * v**0.2},{0.01 * v**0.2}" for v in (1, 3, 10, 30, 100)]
    wide.write_text("\n".join(["speed (mm/s),viscoelastic friction 25 °C,viscoelastic friction 40 °C", *rows, ""]))
    drop(tab, wide)
    step = tab.page.locator(_STEP)
    step.get_by_label("Column of the load").select_option(label="– one value for all rows –")
    step.get_by_label("Unit of the load").fill("25 N")
    step.get_by_role("button", name="Read with these columns").click()
    tab.until("page.jobs.result('measured')?.runs === false", _SECONDS)
    assert tab.value("page.state.state.get('measurement')") == {"curves": "wide.csv", "columns": {"load": "= 25 N"}}
    step.get_by_role("button", name="Clear the column names").click()
    step.get_by_label("Column of the load").wait_for()
    assert tab.value("page.state.state.get('measurement.curves')") == "wide.csv"


def test_the_example_from_its_file_to_the_rubber_behind_it(tab: Tab) -> None:
    assert "Drop the files" in tab.text("#figure-measured-friction .plot-empty")
    tab.page.get_by_role("button", name="Use the synthetic example").click()
    until_drawn(tab, "measured-friction", 12)
    assert sorted(names_of_curves(tab, "measured-friction")) == sorted(
        f"{warm} °C{word}".replace(" °C", "\N{NO-BREAK SPACE}°C")
        for warm in (10, 20, 30, 45, 65, 90)
        for word in ("", ", predicted")
    )
    facts = part(tab, "Measured friction").inner_text()
    assert re.search(r"readings\s+1,?\s?248", facts)
    assert "synthetic data" in facts
    assert "configurations: passed" in facts
    agreement = part(tab, "Measured against predicted").inner_text()
    assert re.search(r"\b78 points\b.*\b0\.\d %", agreement)
    for figure in ("coulomb-friction", "four-runs", "force-cell-zero"):
        until_drawn(tab, figure, 6)
    until_drawn(tab, "friction-master-curve", 7)
    assert re.fullmatch(r"78 points, predicted to [01]\.\d+.%", tab.text('#steps a[href="#measurement"] .step-summary'))

    behind = part(tab, "Material identified from friction")
    behind.get_by_role("button", name="Identify the material").click()  # waits until the shift factors are suggested
    assert behind.get_by_label("Shift factors").input_value() == "friction"  # its curves overlap
    until_drawn(tab, "identified-modulus", 6)
    assert "Anchored to |E| =" in behind.inner_text()
    tab.screenshot("measurement-example")
    assert tab.findings() == []
    behind.get_by_role("button", name="Use this material on the page").click()
    tab.until("page.state.state.get('material.file') === 'rubber_from_friction.json'")
    tab.page.set_viewport_size({"width": 390, "height": 844})
    tab.until("document.documentElement.scrollWidth <= innerWidth")
    tab.screenshot("measurement-phone")


def test_curves_alone_are_shifted_without_any_rubber(tab: Tab, tmp_path: Path) -> None:
    path = tmp_path / "curves.csv"
    vf.write_friction_curves(curves(), path)
    tab.value("page.state.state.set('material', {file: 'a rubber that is not there.json'})")
    drop(tab, path)
    master = part(tab, "Friction master curve")
    master.get_by_label("Compare with").select_option("nothing", timeout=1e3 * _SECONDS)
    until_drawn(tab, "friction-shift-factors", 2)
    assert "WLF" in master.inner_text()
    assert not any("predicted" in name for name in names_of_curves(tab, "measured-friction"))
    with tab.page.expect_download() as download:
        master.get_by_role("link", name="Shift factors (CSV)").click()
    factors = vf.read_shift_factors(download.value.path())
    assert len(factors.temperatures) == 5


def test_what_is_wrong_stands_beside_its_field_and_identifying_can_be_cancelled(tab: Tab, tmp_path: Path) -> None:
    tab.page.get_by_role("button", name="Use the synthetic example").click()
    until_drawn(tab, "measured-friction", 12)
    behind = part(tab, "Material identified from friction")
    behind.get_by_label("Anchor (fixes").select_option("modulus")
    behind.get_by_role("button", name="Identify the material").click()
    behind.locator(".field-error", has_text="its modulus is missing").wait_for(timeout=1e3 * _SECONDS)
    assert behind.get_by_role("button", name="Go to").count() == 0  # its field is here
    behind.get_by_label("Anchor (fixes").select_option("nothing")
    behind.get_by_role("button", name="Identify the material").click()  # waits until the shift factors are suggested
    assert behind.get_by_label("Shift factors").input_value() == "friction"
    behind.get_by_text(re.compile(r"step \d+, contact")).wait_for(timeout=1e3 * _SECONDS)
    behind.get_by_role("button", name="Cancel").click()
    behind.get_by_text("Cancelled.").wait_for(timeout=1e3 * _SECONDS)

    part(tab, "Measured friction").get_by_text("More: zero").click()
    zero = tab.page.get_by_label("Zero of the force cell", exact=True)
    zero.fill("5 mm")
    zero.press("Tab")
    tab.page.get_by_text("has the wrong kind of unit", exact=False).first.wait_for(timeout=1e3 * _SECONDS)
    zero.fill("0.12")
    zero.press("Tab")
    tab.until("page.state.state.get('measurement.zero') === '0.12 N'")
    until_drawn(tab, "four-runs", 6)
    other = tmp_path / "nothing.csv"
    other.write_text("this is, no table\n", encoding="utf-8")
    drop(tab, other)
    part(tab, "Measured friction").locator(".notes.error").get_by_text("nothing.csv").wait_for(timeout=1e3 * _SECONDS)


def test_a_real_export_that_cannot_be_separated_says_what_to_do(tab: Tab, real_data: Path) -> None:
    drop(tab, real_data / "mtm" / "demo-mtm-output.txt")
    card = part(tab, "Measured friction")
    card.get_by_text("by “Steps to leave out”: 2").wait_for(timeout=1e3 * _SECONDS)
    steps = card.get_by_label("Steps to leave out")
    steps.fill("2")
    steps.press("Tab")
    card.get_by_text("(“Assumed Coulomb friction”)").wait_for(timeout=1e3 * _SECONDS)
    card.get_by_label("Assumed Coulomb friction").fill("constant")
    card.get_by_label("Assumed Coulomb friction").press("Tab")
    zero = card.get_by_label("Zero of the force cell", exact=True)
    zero.fill("0")
    zero.press("Tab")
    tab.until("page.jobs.result('measured')?.curves?.length > 0", _SECONDS)
    tab.screenshot("measurement-real")
