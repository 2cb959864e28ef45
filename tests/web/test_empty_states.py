"""Steps and figures without data say what to do, and are there from the start."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from web.every_input import STATE, STEPS, at_rest

if TYPE_CHECKING:
    from web.browser_tab import Tab

pytestmark = pytest.mark.apart  # a browser
#: The words of a figure that is seen and has no data, by the id of the figure.
_EMPTY = """Object.fromEntries([...document.querySelectorAll('.step:not([hidden]) .figure')]
  .filter((one) => one.checkVisibility() && !one.querySelector('.plot-empty').hidden)
  .map((one) => [one.id.replace('figure-', ''), one.querySelector('.plot-empty').textContent]))"""
_SAYS_WHAT_TO_DO = re.compile(r"\b(drop|add|choose|press|see)\b", re.IGNORECASE)
_FROM_THE_START = {
    "sweeps": {"isotherms-storage-modulus", "isotherms-loss-modulus"},
    "shift": {"shifted-isotherms", "shift-factors", "superposition-diagram"},
    "spectrum": {"modulus", "loss-tangent", "modes"},
    "contact": {"friction-curve", "pressure-map", "pressure-profile", "surface-profile"},
    "motion": {"motion-pressure", "motion-load", "motion-indentation", "motion-contact"},
    "measurement": {"measured-friction", "friction-master-curve", "friction-shift-factors"},
}


def test_without_any_material_each_step_shows_its_figures_and_says_what_to_do(tab: Tab) -> None:
    tab.value(f"{STATE}.set('material', undefined)")
    for step in STEPS:
        tab.step(step)
        at_rest(tab)
        found = tab.value(_EMPTY)
        assert set(found) == _FROM_THE_START[step], step
        for name, words in found.items():
            assert _SAYS_WHAT_TO_DO.search(words), (name, words)
        tab.screenshot(f"empty-{step}")
        # what is wrong is said once, in the words of the page
        said = tab.value(
            "[...document.querySelectorAll('.notes.error li')]"
            ".filter((one) => one.checkVisibility()).map((one) => one.textContent)"
        )
        assert [words for words in said if "no material yet" in words] == said[:1], said
        assert not any("[" in words for words in said), said  # no key of a run file
    assert "Nothing is read yet" in tab.text("#step-sweeps .notes.note")
    assert "traction test" in tab.text("#step-measurement .card:last-child")


def test_a_figure_that_an_error_keeps_empty_does_not_ask_for_data_that_are_there(tab: Tab) -> None:
    tab.step("sweeps")
    found = {}
    for material in ("undefined", "{dma: 'none.csv', reference_temperature: '30 degC'}"):
        tab.value(f"{STATE}.set('material', {material})")
        for step in ("sweeps", "shift", "spectrum"):
            tab.step(step)
            at_rest(tab)
            found[material, step] = set(tab.value(_EMPTY).values())
    without, wrong = (
        set.union(*[words for (one, _), words in found.items() if (one == "undefined") is no]) for no in (True, False)
    )
    assert len(wrong) == 1, wrong
    assert not wrong & without


def test_a_predefined_material_leaves_room_for_sweeps(tab: Tab) -> None:
    tab.step("shift")
    at_rest(tab)
    assert {"shifted-isotherms", "superposition-diagram"} <= set(tab.value(_EMPTY))
    tab.page.get_by_role("button", name="Add DMA sweeps").click()
    assert tab.value(f"{STATE}.step") == "sweeps"
    tab.page.get_by_text("Drop tests here, or choose files").wait_for()
