"""What the page shows is of its inputs: figures hidden while something changed are drawn when they are seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from web.browser_tab import tab as opened_tab
from web.every_input import AT_REST, SEEN, STATE, STUDY

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

#: One change of each input, and the steps with figures that depend on it.
RUBBER, ALL = ("shift", "spectrum", "contact", "measurement"), ("sweeps", "shift", "spectrum", "contact", "measurement")
CHANGES: list[tuple[dict[str, Any], tuple[str, ...]]] = [
    ({"material": {"catalogue": "synthetic fluoroelastomer"}}, ("sweeps", "spectrum", "contact", "measurement")),
    ({"material": {**STUDY["material"], "reference_temperature": "40 degC"}}, ALL),
    ({"material.reference_temperature": "60 degC"}, RUBBER),
    ({"material.vertical_shift": "free"}, RUBBER),
    ({"material.tau_ratio": 5}, ("spectrum", "contact", "measurement")),
    ({"indenter.radius": "5 mm"}, ("contact", "measurement")),
    ({"conditions.load": "10 N"}, ("contact",)),
    ({"conditions.temperature": ["60 degC", "90 degC"]}, ("contact",)),
    ({"measurement.zero": "0.05 N"}, ("measurement",)),
]


def figures_of(tab: Tab, step: str) -> dict[str, Any]:
    """Return what is seen of a step once nothing changes any more."""
    tab.step(step)
    before: dict[str, Any] = {}
    for _ in range(60):
        tab.page.wait_for_timeout(400)
        rests = tab.value(AT_REST)  # asked first: what is seen comes after
        now = tab.value(SEEN)
        current = bool(now) and all(one["inputs"] and not one["stale"] for one in now.values())
        if current and now == before and rests:
            return now
        before = now
    raise AssertionError(f"{step} did not come to rest: {before}")


def test_a_figure_that_changes_while_it_is_hidden_is_drawn_when_it_is_seen(tab: Tab) -> None:
    drawn = tab.value(
        """await (async () => {
          const place = document.createElement('div');
          document.getElementById('main').append(place);
          const frame = () => new Promise((resolve) => setTimeout(resolve, 150));
          const { render, html } = page.reactive;
          const draw = (y) => render(html`<${page.figures.Figure} id="hidden" title="hidden" x=${{}} y=${{}}
            traces=${[{ name: 'friction', x: [1, 2], y }]} />`, place);
          draw([1, 2]);
          const shown = () => Array.from(place.querySelector('.plot').data[0].y);
          while (!place.querySelector('.plot').data) await frame();
          const before = shown();
          place.hidden = true;
          await frame();
          draw([3, 4]);
          await frame();
          place.hidden = false;
          await frame();
          await frame();
          const after = shown();
          render(null, place);
          place.remove();
          return [before, after];
        })()"""
    )
    assert drawn == [[1, 2], [3, 4]]


def test_results_of_earlier_inputs_are_grey_until_the_inputs_are_theirs_again(tab: Tab) -> None:
    def grey(change: str) -> bool:
        return tab.value(f"({change}, page.jobs.isStale(window.numbers))")

    tab.value(
        """(() => {
          const study = () => page.state.state.study;
          const job = new page.jobs.Job('measured-again', { name: 'curve', inputs: () => ({ study: study() }) });
          window.show = () => job.put({ study: study() }, (window.numbers = {}));
        })()"""
    )
    load = f"{STATE}.set('conditions.load', '25 N')"
    assert not grey(f"{load}, window.show()")
    assert not grey(f"{STATE}.set('title', 'another title')")  # no number depends on it
    assert grey(f"{STATE}.set('conditions.load', '26 N')")
    assert not grey(load)
    assert grey(f"{STATE}.set('conditions.load', '26 N')")
    assert not grey(f"{STATE}.undo()")
    assert not grey(f"{STATE}.set('material', {{ file: 'rubber.json' }}), window.show()")
    assert grey(f"{STATE}.renew(['rubber.json'])")  # other contents under the same name


@pytest.mark.apart
@pytest.mark.parametrize("hidden", ALL)
def test_figures_hidden_while_inputs_change_are_those_of_a_fresh_page(
    browser: Browser, server: Server, hidden: str
) -> None:
    with opened_tab(browser, server, "#export") as tab:
        tab.value("await (await import('/static/js/api.js')).useExample()")
        tab.value(f"{STATE}.replace(given[0])", STUDY)
        before = figures_of(tab, hidden)
        for change, steps in CHANGES:
            tab.step("export")
            tab.value(f"{STATE}.change(given[0])", change)
            if hidden not in steps:
                continue
            now = figures_of(tab, hidden)
            inputs_before, inputs_now = ({name: one["inputs"] for name, one in some.items()} for some in (before, now))
            assert inputs_now != inputs_before, change
            before = now
        last = figures_of(tab, hidden)
        study, position = tab.value(f"[{STATE}.study, {STATE}.view('contact.position', null)]")
    with opened_tab(browser, server, "#export") as fresh:
        fresh.value("await (await import('/static/js/api.js')).useExample()")
        fresh.value(f"{STATE}.replace(given[0]), {STATE}.setView('contact.position', given[1])", study, position)
        assert figures_of(fresh, hidden) == last


@pytest.mark.apart
def test_a_file_with_other_contents_under_the_same_name_is_read_again(tab: Tab) -> None:
    upload = """await (await import('/static/js/api.js')).uploadFiles(
        [new File([given[0]], 'again.csv', {type: 'text/csv'})])"""

    def sweeps(scale: float) -> str:
        rows = [
            f"{celsius},{hertz},{scale * 3e6 * (1 + hertz / 10) * (1 - celsius / 300)},{scale * 3e5 * (1 + hertz / 20)}"
            for celsius in (20, 40)
            for hertz in (0.1, 1, 10)
        ]
        return "\n".join(["temperature (degC),frequency (Hz),E' (Pa),E'' (Pa)", *rows])

    def highest() -> float:
        figures_of(tab, "sweeps")
        return tab.value(
            "Math.max(...document.querySelector('#figure-isotherms-storage-modulus .plot')"
            ".data.flatMap((one) => [...one.y]))"
        )

    tab.value(upload, sweeps(1.0))
    tab.value(
        f"{STATE}.replace(given[0])", {**STUDY, "material": {"dma": "again.csv", "reference_temperature": "20 degC"}}
    )
    before = highest()
    tab.value(upload, sweeps(2.0))
    assert highest() == pytest.approx(2.0 * before)
