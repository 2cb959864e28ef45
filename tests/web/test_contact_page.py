"""The step with which the page opens, in a real browser: a curve that fills in, a contact that follows its sliders."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import pytest

from web.browser_tab import tab as opened_tab

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

CURVE, MAP = "#figure-friction-curve", "#figure-pressure-map"
_DRAWN = f"(document.querySelector('{CURVE} .plot').data ?? [])"


def curves(tab: Tab) -> dict[str, list[float | None]]:
    """Return what is drawn of friction: by its name, the values of each curve."""
    return dict(tab.value(f"{_DRAWN}.filter((one) => one.name).map((one) => [one.name, Array.from(one.y)])"))


def finished(tab: Tab) -> None:
    """Wait until the friction curve is there to its end, and the live contact is sharp."""
    tab.until("page.jobs.result('curve') !== null && page.figures.areDrawn()", 60.0)
    tab.until("document.querySelector('.live-status').textContent === 'converged'", 60.0)


def requested(tab: Tab) -> int:
    """Return the number of contacts requested."""
    return sum(path == "/api/jobs/contact" for path, _ in tab.requested)


def drag(tab: Tab, name: str, *places: int) -> None:
    """Move a slider from place to place, as quickly as a hand would."""
    tab.page.evaluate(
        """async ([id, places]) => {
          const slider = document.getElementById(id);
          for (const place of places) {
            slider.value = String(place);
            slider.dispatchEvent(new Event("input", { bubbles: true }));
            await new Promise((resolve) => setTimeout(resolve, 10));
          }
        }""",
        [f"live-{name}", list(places)],
    )


#: Small enough that its curve is there at once.
SMALL = {
    "title": "A ball on a synthetic rubber",
    "data_origin": "synthetic",
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": {"load": "25 N", "speed": ["10 mm/s", "100 mm/s"], "temperature": ["30 degC", "60 degC"]},
    "solver": {"accuracy": 0.1, "cases": "each", "master_curve_points": 2},
    "outputs": {"fields": "none"},
}
CONTACT = "page.jobs.result('contact')"


@pytest.mark.apart
def test_page_opens_with_a_friction_curve_and_a_contact_that_follows_sliders(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server) as tab:
        _look_and_move(tab)


def _look_and_move(tab: Tab) -> None:
    finished(tab)
    tab.until(f"{_DRAWN}.length > 3")
    found = curves(tab)
    assert {"30\u00a0°C", "60\u00a0°C", "90\u00a0°C", "live contact"} <= set(found)
    assert all(len(found[f"{celsius}\u00a0°C"]) == 25 for celsius in (30, 60, 90))
    result = tab.value("page.jobs.result('curve')")
    assert found["30\u00a0°C"] == result["friction"][:25]
    assert len(found.get("doubtful", ())) == sum(map(bool, result["doubts"]))
    assert "75 points" in tab.text("#step-contact .progress-text")
    friction = tab.value(CONTACT)["numbers"]["friction_coefficient"]["value"]
    assert found["live contact"] == [friction]
    # Words follow the numbers: 60 °C, 100 mm/s.
    assert tab.page.input_value(".live-number >> nth=0") == "100\u00a0mm/s"
    assert f"μ = {friction:.3g}" in tab.text(".why")
    assert "not recovered" in tab.text(".why")
    # The leading edge of the map is on the right, and farther from the axis.
    x = tab.value(f"document.querySelector('{MAP} .plot').data[0].x")
    assert max(x) > -min(x) > 0.0
    definition = tab.page.get_by_role("note").get_by_text("Friction force over load")
    assert not definition.is_visible()
    tab.page.get_by_role("button", name="Viscoelastic friction coefficient", exact=True).click()
    definition.wait_for()
    assert tab.findings() == []
    tab.screenshot("contact-1400-light")
    tab.page.keyboard.press("Escape")
    definition.wait_for(state="hidden")

    before = requested(tab)
    drag(tab, "speed", *range(100, 300, 4))
    tab.until(f"Math.abs(Math.log10({CONTACT}?.speed) - (-4 + 296 / 400 * 6)) < 0.01")
    finished(tab)
    for _ in range(50):  # requests are counted once their end is told
        if requested(tab) > before:
            break
        tab.page.wait_for_timeout(100)
    assert 1 <= requested(tab) - before < 40  # 50 places
    tab.page.fill(".live-number >> nth=1", "45")
    tab.page.press(".live-number >> nth=1", "Enter")
    tab.until(f"{CONTACT}?.temperature === 318.15")
    assert tab.page.get_attribute("#live-temperature", "aria-valuetext") == "45\u00a0°C"
    # A point of the curve is clicked.
    point = tab.page.locator(f"{CURVE} .scatterlayer .trace").first.locator(".point").nth(12)
    point.scroll_into_view_if_needed()
    box = point.bounding_box()
    assert box is not None
    tab.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    tab.until(f"{CONTACT}?.temperature === 303.15 && Math.abs({CONTACT}?.speed - 0.1) < 1e-6")


_FOLLOW = """async (given) => {
  const { Job } = await import("/static/js/jobs.js");
  const { computed, effect, signal } = await import("/static/js/reactive.js");
  const requested = [], shown = [], failures = [];
  const until = async (holds) => {
    while (!holds()) await new Promise((resolve) => setTimeout(resolve, 1));
  };
  const honest = window.fetch;
  let pending = null;
  window.fetch = async (address, asked) => {
    // the page asks on its own, too, how many cases the run file has
    if (!String(address).endsWith("/followed")) return honest(address, asked);
    const { body, signal: gone } = asked;
    const { position, stages } = JSON.parse(body).options;
    requested.push([stages, position]);
    const mine = (pending = { gone });
    await until(() => mine.answered || gone.aborted);
    gone.throwIfAborted();
    if (position === 13) return new Response(JSON.stringify({ event: "error", message: "unlucky" }) + "\\n");
    const result = { stage: stages === "coarse" && position === 7 ? "sharp" : stages, position };
    return new Response(JSON.stringify({ event: "result", result }) + "\\n");
  };
  const position = signal(null);
  const inputs = () => (position.value === null ? null : { study: {}, options: { position: position.value } });
  const job = new Job("followed", { drafts: true, wait: 0, inputs }).start();
  const results = computed(() => job.result);
  const stop = effect(() => results.value && shown.push([results.value.stage, results.value.position]));
  const fails = effect(() => job.error && failures.push(job.error.message));
  const begun = () => pending && !pending.answered && !pending.gone.aborted;
  for (const step of given) {
    if (typeof step === "number") position.value = step;
    else if (step === "failure") await until(() => job.error);
    else await until(begun);
    if (step === "answer") pending.answered = true;
  }
  await until(() => !job.moving.value);
  for (const end of [stop, fails]) end();
  position.value = null;
  window.fetch = honest;
  return { requested, shown, failures };
}"""


def followed(tab: Tab, *steps: int | str) -> Any:
    """Want positions (numbers), await a request or a failure, answer a request; return what was requested and shown."""
    return tab.page.evaluate(_FOLLOW, list(steps))


def test_of_positions_that_come_too_fast_the_last_one_counts(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server, "#export") as tab:  # where nothing is solved
        _follow_all(tab)


def _follow_all(tab: Tab) -> None:
    found = followed(tab, 1, "request", 2, 3, 4, "answer", "answer", "answer")
    assert found["requested"] == [["coarse", 1], ["coarse", 4], ["sharp", 4]]
    assert found["shown"] == [["coarse", 1], ["coarse", 4], ["sharp", 4]]
    # Sharpening that is overtaken is given up; what is sharp at once is not sharpened.
    found = followed(tab, 5, "answer", "request", 7, "answer")
    assert found["requested"] == [["coarse", 5], ["sharp", 5], ["coarse", 7]]
    assert found["shown"] == [["coarse", 5], ["sharp", 7]]
    # An error is told where it is the newest position's, and does not stop the slider.
    found = followed(tab, 13, "request", 1, "answer", "answer", "answer")
    assert found["failures"] == []
    found = followed(tab, 13, "answer", "failure", 1, "answer", "answer")
    assert found["failures"] == ["unlucky"]
    assert found["shown"][-1] == ["sharp", 1]


@pytest.mark.exhaustive
def test_what_is_changed_is_solved_again(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server, "#export", viewport={"width": 390, "height": 850}, color_scheme="dark") as tab:
        tab.value(f"page.state.state.replace({json.dumps(SMALL)})")
        tab.step("contact")
        finished(tab)
        _keep_and_change(tab)
        _change_shapes(tab)
        _make_a_mistake(tab)
        assert tab.page.evaluate("document.documentElement.scrollWidth") <= 390
        for figure in tab.page.locator("#step-contact .figure:visible .plot").all():
            assert re.search(r"(against|map of) .*numbers are in the table", figure.get_attribute("aria-label") or "")
        tab.screenshot("contact-390-dark")


def _keep_and_change(tab: Tab) -> None:
    cold, warm = "30\u00a0°C", "60\u00a0°C"
    tab.until(f"{_DRAWN}.some((one) => one.name === '{cold}')")
    old = curves(tab)
    tab.page.get_by_role("button", name="Keep for comparison").click()
    tab.until(f"{_DRAWN}.some((one) => one.name === 'kept')")
    load = tab.page.get_by_role("textbox", name="Load", exact=True)
    load.fill("5 N")
    load.press("Enter")
    tab.until(f"{_DRAWN}.some((one) => one.name === '{cold}' && one.y[0] !== {old[cold][0]})")
    finished(tab)
    now = curves(tab)
    assert now["kept"] == old[warm]  # the last one drawn
    assert now[cold][0] < old[cold][0]  # type: ignore[operator]  # the same ball, less deep
    tab.page.get_by_label("Against", exact=True).select_option("shifted")
    tab.until(f"document.querySelector('{CURVE} .xtitle').textContent.startsWith('α(T)·v at 30')")
    assert "master curve" in curves(tab)


def _change_shapes(tab: Tab) -> None:
    study = "page.state.state.study"
    tab.page.select_option("#contact-shape", "cylinder")
    assert tab.value(f"[{study}.indenter.shape, {study}.conditions.load]") == ["cylinder", "2 N/mm"]
    tab.until(f"{CONTACT}?.kind === 'line'")
    tab.page.wait_for_selector(MAP, state="hidden")
    tab.page.select_option("#contact-shape", "made")
    assert tab.value(f"[{study}.indenter, {study}.conditions.load, {study}.surface.hurst]") == [None, None, 0.8]
    tab.until(f"{CONTACT}?.kind === 'rough' && page.jobs.result('curve')?.kind === 'rough'")
    assert "Contact area fraction" in tab.text("#step-contact .key-numbers")
    tab.until(f"{_DRAWN}.some((one) => one.error_y?.array)")
    tab.page.select_option("#contact-shape", "ball")
    assert tab.value(f"[{study}.indenter.radius, {study}.conditions.load]") == ["9.525 mm", "5 N"]
    assert tab.value(f"{study}.surface ?? null") is None
    finished(tab)


def _make_a_mistake(tab: Tab) -> None:
    radius = tab.page.get_by_label("Radius", exact=True)
    radius.fill("9 kg")
    radius.press("Enter")
    tab.until("document.querySelector('#step-contact .field.wrong .field-error')?.textContent.includes('kg')")
    tab.until("Boolean(document.querySelector('.live-contact .stale'))")
    assert "Fix the marked field to update the " in tab.text("#step-contact .notes.error:not([hidden])")
    radius.fill("5 mm")
    radius.press("Enter")
    tab.until(
        "!document.querySelector('.live-contact .stale') && !document.querySelector('#step-contact .field.wrong')"
    )
    finished(tab)


@pytest.mark.apart
def test_a_cancelled_curve_keeps_its_points_and_is_resumed(browser: Browser, server: Server) -> None:
    speeds = {"from": "1 mm/s", "to": "10 m/s", "points": 60, "spacing": "log"}
    conditions = {**SMALL["conditions"], "speed": speeds}  # type: ignore[dict-item]
    points = f"({_DRAWN}.find((one) => one.name === '30\u00a0°C')?.y ?? []).filter((one) => one !== null).length"
    with opened_tab(browser, server, "#export") as tab:
        tab.value("page.state.state.replace(given[0])", {**SMALL, "conditions": conditions})
        tab.step("contact")
        tab.until(f"{points} > 5", 60.0)
        card = tab.page.locator("#step-contact .progress")
        card.get_by_role("button", name="Cancel").click()
        card.get_by_text("Cancelled.").wait_for()
        kept = tab.value(points)
        assert 5 < kept < 60
        assert tab.value("page.jobs.result('curve')") is None
        tab.screenshot("contact-cancelled")
        tab.page.wait_for_timeout(1000)
        assert tab.value(points) == kept  # nothing is computed meanwhile
        card.get_by_role("button", name="Resume").click()
        tab.until(f"{points} === 60 && page.jobs.result('curve') !== null", 120.0)
        # a failed run has no numbers: those of the inputs before are grey
        radius = tab.page.get_by_label("Radius", exact=True)
        radius.fill("9 kg")
        radius.press("Enter")
        tab.until("document.querySelector('#step-contact .field.wrong .field-error')?.textContent.includes('kg')")
        shown = "[...document.querySelectorAll('#step-contact [data-inputs]')]"
        tab.until(f"{shown}.length > 3 && {shown}.every((one) => one.closest('.stale'))")


@pytest.mark.apart
def test_a_drag_of_the_load_is_followed_and_is_one_step_of_undo(browser: Browser, server: Server) -> None:
    with opened_tab(browser, server, "#export") as tab:
        tab.value(f"page.state.state.replace({json.dumps(SMALL)})")
        tab.step("contact")
        finished(tab)
        before = tab.value(CONTACT)["numbers"]["indentation"]["value"]
        slider = tab.page.get_by_label("Load: slider")
        for place in (240, 260, 280):
            slider.evaluate(
                "(one, at) => { one.value = at; one.dispatchEvent(new Event('input', { bubbles: true })); }", place
            )
        slider.dispatch_event("change")
        load = "page.state.state.get('conditions.load')"
        assert tab.value(load) == "158 N"  # 400 places from 0.01 N to 10 kN
        finished(tab)
        after = tab.value(CONTACT)["numbers"]["indentation"]["value"]
        assert after > 2.0 * before
        tab.value("page.state.state.undo()")
        assert tab.value(load) == "25 N"
        speed = "page.state.state.view('contact.position').speed"
        before = tab.value(speed)
        drag(tab, "speed", 300, 320)
        assert tab.value(speed) > before
        tab.value("page.state.state.undo()")
        assert tab.value(speed) == before


@pytest.mark.apart
def test_heated_friction_is_drawn_beside_the_isothermal_one(browser: Browser, server: Server) -> None:
    """Of a cylinder, which is soon solved; the heat is that of an interface, whose law is chosen on the page."""
    line = {"indenter": {"shape": "cylinder", "radius": "10 mm"}}
    conditions = {"load": "0.5 N/mm", "speed": ["50 mm/s", "200 mm/s"], "temperature": "60 degC"}
    with opened_tab(browser, server) as tab:
        tab.value(f"page.state.state.replace({json.dumps({**SMALL, **line, 'conditions': conditions})})")
        finished(tab)
        tab.page.get_by_label("Friction of a dry interface").check()
        tab.page.get_by_label("Law of the shear stress").select_option(label="constant")
        tab.page.get_by_label("Friction heats the contact").check()
        counterface = tab.page.get_by_label("Thermal properties of the indenter")
        counterface.fill("PTFE")
        counterface.press("Enter")
        tab.until("Boolean(page.jobs.result('curve')?.heated_friction)", 120.0)
        tab.page.get_by_label("Shown").select_option("heated_friction")
        tab.until(f"{_DRAWN}.filter((one) => one.y.length === 2).length === 2")
        drawn = tab.value(f"{_DRAWN}.filter((one) => one.y.length === 2).map((one) => Array.from(one.y))")
        found = tab.value("page.jobs.result('curve')")
        assert drawn == [found["heated_friction"], found["friction"]]
        assert all(one > 0.0 for one in found["temperature_rise"])
        tab.page.get_by_label("Shown").select_option("temperature_rise")
        tab.until(f"{_DRAWN}.filter((one) => one.y.length === 2).length === 3")
        assert "Thin dashes: by Coulomb friction. Thin dots: by the loss." in tab.text(f"{CURVE} .figure-caption")
        tab.page.locator(CURVE).get_by_role("button", name="Table").click()
        heads = tab.page.locator(f"{CURVE} th").all_text_contents()
        assert len(set(heads)) == len(heads) == 5  # speed, rise, its error, and both parts
        tab.screenshot("contact-heated")
        tab.page.get_by_label("Shown").select_option("total_friction")
        tab.page.set_viewport_size({"width": 390, "height": 900})
        # The label of the axis, hysteresis and interface together, is no higher than the figure.
        height = "document.querySelector(given[0]).getBoundingClientRect().height"
        tab.until(f"document.querySelector('{CURVE} .ytitle').textContent.includes('together')")
        tab.page.wait_for_timeout(500)
        assert tab.value(height, f"{CURVE} .ytitle") < tab.value(height, f"{CURVE} .plot")
