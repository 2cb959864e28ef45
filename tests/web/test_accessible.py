"""Every step unfolded, in each look, of the inputs as they are and of earlier ones: nothing serious for axe."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from web.browser_tab import tab as opened_tab
from web.every_input import STATE, STEPS, STUDY, at_rest, example

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

pytestmark = pytest.mark.apart  # a browser, and axe on every step
LOOKS: dict[str, dict[str, Any]] = {
    "light": {"color_scheme": "light"},
    "dark": {"color_scheme": "dark"},
    "phone": {"viewport": {"width": 390, "height": 844}, "has_touch": True},
}
#: Opens all that is folded in the step that is seen.
UNFOLD = "[...document.querySelectorAll('.step:not([hidden]) details')].forEach((one) => (one.open = true))"


def look_at(tab: Tab, name: str) -> list[str]:
    """Return what is wrong with the step that is seen."""
    tab.until("document.getAnimations().length === 0")
    tab.screenshot(f"look-{name}")
    wide = tab.value("document.documentElement.scrollWidth - innerWidth")
    return [f"{name}: {one}" for one in [*tab.findings(), *([f"{wide} px too wide"] if wide > 0 else [])]]


@pytest.mark.parametrize("look", LOOKS)
def test_every_step_is_accessible(browser: Browser, server: Server, look: str) -> None:
    with opened_tab(browser, server, "#export", **LOOKS[look]) as tab:
        example(tab, STUDY)
        tab.step("motion")
        tab.page.get_by_role("button", name="Solve", exact=True).click()
        found = []
        for step in (*STEPS, "export"):
            tab.step(step)
            tab.value(f"({UNFOLD}, null)")
            at_rest(tab)
            found += look_at(tab, f"{look}-{step}")
        # figures of earlier inputs are grey, and are to be read all the same; so are notes of what is on its way
        tab.page.route("**/api/jobs/*", lambda _: None)
        tab.value(f"{STATE}.change(given[0])", {"material.spectrum": "regularised", "measurement.zero": "0.05 N"})
        for step in STEPS:
            tab.step(step)
            tab.page.locator(".step:not([hidden]) .figure.stale >> visible=true").first.wait_for()
            found += look_at(tab, f"{look}-grey-{step}")
        assert found == []
