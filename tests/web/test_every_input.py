"""Every input × every step that is hidden while it changes × every figure; and walks through the page at random."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

import pytest

from viscofric.web.start import FORMS
from web.browser_tab import tab as opened_tab
from web.every_input import INPUTS, OTHERS, STATE, STEPS, STUDY, at_rest, example, wrong_figures
from web.run_file_schema import keys

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

pytestmark = pytest.mark.apart  # a browser
_MORE = [pytest.param(first, marks=pytest.mark.exhaustive) for first in range(10, 100, 10)]


def change(tab: Tab, path: str, value: Any) -> None:
    """Change an input while all figures are hidden, and see that those of other inputs are grey at once."""
    tab.step("export")
    tab.value(f"{STATE}.set(given[0], given[1])", path, value)
    assert wrong_figures(tab) == [], path


def test_no_field_of_the_page_is_left_out(tab: Tab) -> None:
    for step in STEPS:
        tab.step(step)
        tab.page.wait_for_selector(f"#step-{step} .card")
    in_forms = {field["path"] for fields in FORMS.values() for field in fields}
    of_study = {path for path in in_forms if not path.startswith("@")} | set(tab.value("page.fields.paths()"))
    assert of_study - set(INPUTS) - set(OTHERS) == set()


def test_no_key_of_the_run_file_is_left_out() -> None:
    assert keys() - set(INPUTS) - set(OTHERS) == set()


def drawn(tab: Tab, step: str) -> dict[str, Any]:
    """Go to a step and have its figures drawn; return them."""
    tab.step(step)
    if step == "motion":
        tab.page.get_by_role("button", name="Solve", exact=True).click()
    found = at_rest(tab)
    assert any(one["inputs"] for one in found.values())
    assert not any(one["stale"] for one in found.values())
    return found


@pytest.mark.parametrize("hidden", STEPS)
def test_no_figure_of_other_inputs_is_left(browser: Browser, server: Server, hidden: str) -> None:
    with opened_tab(browser, server, "#export") as tab:
        example(tab, STUDY)
        before = drawn(tab, hidden)
        for path, value in INPUTS.items():
            change(tab, path, value)
            tab.step(hidden)
            now = at_rest(tab)
            assert wrong_figures(tab) == [], path
            # what the user has solved by hand waits, in grey, for the user
            assert hidden == "motion" or not any(one["stale"] for one in now.values()), path
            tab.value(f"{STATE}.undo()")
            assert wrong_figures(tab) == [], path
        assert at_rest(tab) == before


def test_inputs_of_other_studies_leave_no_figure_of_theirs(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server, "#export") as tab:
        example(tab, STUDY)
        before = {step: drawn(tab, step) for step in STEPS}
        for path, value in OTHERS.items():
            change(tab, path, value)
            tab.value(f"{STATE}.undo()")
            assert wrong_figures(tab) == [], path
        for step, figures in before.items():
            tab.step(step)
            assert at_rest(tab) == figures


#: Solved in a moment, so that walks meet results as well as what is on its way.
LIGHT = {**STUDY, "material": {"catalogue": "synthetic fluoroelastomer"}}


def walk(tab: Tab, seed: int, length: int = 12) -> None:
    """Go through the page at random; no figure is ever other than it says."""
    chance = random.Random(seed)
    tab.value(f"{STATE}.replace(given[0])", LIGHT)
    seen = [tab.value(f"{STATE}.step")]  # steps, to the one that Back leaves
    for _ in range(length):
        path, value = chance.choice([*INPUTS.items(), *OTHERS.items()])
        step = chance.choice([one for one in STEPS if one != seen[-1]])
        to_step = f"document.querySelector('#steps a[href=\"#{step}\"]').click()"
        ways = {
            f"{STATE}.set(given[0], given[1])": 5,
            f"{STATE}.undo()": 2,
            f"{STATE}.redo()": 1,
            "history.back()": 1 if len(seen) > 1 else 0,
            to_step: 3,
            f"page.units.choose('{chance.choice(['SI', 'engineering', 'imperial'])}')": 1,
            f"page.figures.chooseTheme('{chance.choice(['light', 'dark'])}')": 1,
            f"{STATE}.setView('contact.position', {{ speed: {chance.uniform(0.01, 0.1)}, temperature: 310 }})": 2,
        }
        (way,) = chance.choices(list(ways), list(ways.values()))
        tab.value(f"({way}, null)", path, value)
        if way == to_step:
            seen.append(step)
        elif way == "history.back()":
            seen.pop()
            tab.until(f"{STATE}.step === '{seen[-1]}'")
        assert wrong_figures(tab) == [], (seed, way, path)
        tab.page.wait_for_timeout(chance.choice([0, 50, 400]))
        assert wrong_figures(tab) == [], (seed, way, path)


@pytest.mark.parametrize("first", [0, *_MORE])
def test_walks_at_random_leave_no_figure_of_other_inputs(browser: Browser, server: Server, first: int) -> None:
    with opened_tab(browser, server, "#export") as tab:
        example(tab, LIGHT)
        for seed in range(first, first + 10):
            walk(tab, seed)
        tab.value(f"{STATE}.replace(given[0])", LIGHT)
        at_rest(tab)
        assert wrong_figures(tab) == []
