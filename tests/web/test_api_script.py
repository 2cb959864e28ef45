"""What the page's scripts ask of the server: jobs with their errors, cancelling, more at once than there are places."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import pytest

from web.served_page import STUDY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Page

    from web.served_page import Server

SPEEDS = {"from": "1 mm/s", "to": "10 m/s", "points": 200, "spacing": "log"}
#: Contacts for a minute or more.
LONG = {**STUDY, "conditions": {**STUDY["conditions"], "speed": SPEEDS}, "solver": {"accuracy": 1e-4}}


@pytest.fixture
def tab(browser: Browser, server: Server) -> Iterator[Page]:
    """Open the page at its last step, which computes nothing."""
    with browser.new_context() as memory:
        page = memory.new_page()
        page.goto(f"{server.address}#export")
        yield page


def script(tab: Page, body: str, *given: Any) -> Any:
    """Run a script that knows ``api``."""
    return tab.evaluate(f"async (given) => {{ const api = await import('/static/js/api.js'); {body} }}", list(given))


def test_job_is_answered_and_its_errors_name_the_field(tab: Page) -> None:
    found = script(tab, "return api.runJob('export-run-file', {study: given[0]})", STUDY)
    assert found["cases"] == 1
    wrong = {**STUDY, "conditions": {**STUDY["conditions"], "load": "25 mm"}}
    caught = "try { await api.runJob('curve', {study: given[0]}) } catch (e) { return [e.name, e.message, e.field] }"
    name, message, field = script(tab, caught, wrong)
    assert (name, field) == ("JobError", "conditions.load")
    assert "25 mm" in message


def test_more_jobs_than_places_are_all_answered(tab: Page) -> None:
    jobs = "return Promise.all(Array.from({length: 9}, () => api.runJob('export-run-file', {study: given[0]})))"
    assert [one["cases"] for one in script(tab, jobs, STUDY)] == [1] * 9


@pytest.mark.apart
def test_cancelled_jobs_free_their_processes(tab: Page, server: Server) -> None:
    begin = """
        const stop = new AbortController();
        window.stopped = [];
        const part = new Promise((resolve) => {
            for (let number = 0; number < 6; number += 1)
                api.runJob("curve", {study: given[0]}, {signal: stop.signal, onProgress: resolve, onPart: resolve})
                    .catch((error) => window.stopped.push(error.name));
        });
        await part;
        stop.abort();
        """
    script(tab, begin, LONG)
    begun = time.monotonic()
    with server.client() as client:
        while client.get("/api/status").json()["running"]:
            assert time.monotonic() - begun < 30.0  # two seconds, and more for a busy machine; the study takes longer
            time.sleep(0.02)
    assert script(tab, "return window.stopped") == ["AbortError"] * 6
    assert script(tab, "return api.runJob('export-run-file', {study: given[0]})", STUDY)["cases"] == 1


@pytest.mark.apart
def test_tab_that_is_closed_cancels_its_jobs(tab: Page, server: Server) -> None:
    begin = "await new Promise((go) => { api.runJob('export-study', {study: given[0]}, {onProgress: go}); })"
    script(tab, begin, LONG)
    tab.close()
    begun = time.monotonic()
    with server.client() as client:
        while client.get("/api/status").json()["running"]:
            assert time.monotonic() - begun < 30.0
            time.sleep(0.02)


def test_files_are_uploaded_to_the_tabs_own_folder(tab: Page, server: Server) -> None:
    upload = 'return api.uploadFiles([new File(["1"], "Messung 3 (60 °C).csv"), new File(["22"], "b.csv")])'
    names = script(tab, upload)
    assert names == ["Messung 3 (60 °C).csv", "b.csv"]
    with server.client(script(tab, "return JSON.parse(sessionStorage['viscofric.workspace'])")) as client:
        assert client.get("/api/files").json() == [{"name": names[0], "size": 1}, {"name": "b.csv", "size": 2}]
        for name in names:
            client.delete(f"/api/files/{name}")
        assert client.get("/api/files").json() == []
    caught = "try { await api.uploadFiles([{name: 'a', size: 3e7}]) } catch (error) { return error.message }"
    assert script(tab, caught) == "a has 30 MB; the limit is 20 MB."
