"""A tab whose program ends and is started again goes on with its files, and says so once."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import viscofric
from web.browser_tab import tab as opened_tab
from web.served_page import started

if TYPE_CHECKING:
    from playwright.sync_api import Browser

_RUBBER = "page.jobs.result('rubber')"
_SAID = "document.querySelector('#main').innerText.split('was started again').length - 1"


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_a_tab_goes_on_when_its_program_was_started_again(browser: Browser, tmp_path: Path) -> None:
    sweeps = (Path(viscofric.__file__).parent / "example" / "dma.csv").read_text(encoding="utf-8")
    with started(tmp_path / "first") as first, opened_tab(browser, first, "#shift") as tab:
        upload = "await (await import('/static/js/api.js')).uploadFiles([new File([given[0]], 'my sweeps.csv')])"
        tab.value(upload, sweeps)
        tab.value("page.state.state.set('material', {dma: ['my sweeps.csv'], reference_temperature: '30 degC'})")
        tab.until(f"{_RUBBER} !== null", 60.0)
        before = tab.value(f"{_RUBBER}.summary")
        first.process.kill()
        first.process.wait()
        tab.value("page.state.state.set('material.reference_temperature', '60 degC')")
        tab.until("page.jobs.errors().length > 0")
        port = first.base.rpartition(":")[2]
        with started(tmp_path / "second", "--port", port) as second:
            assert second.base == first.base
            # the user opens what the program printed, in another tab
            tab.page.context.new_page().goto(second.address)
            tab.until(f"{_RUBBER} !== null", 60.0)
            assert tab.value("page.jobs.errors()") == []
            assert tab.value(_SAID) == 1
            tab.value("page.state.state.set('material.reference_temperature', '30 degC')")
            tab.until(f"{_RUBBER} !== null", 60.0)
            assert tab.value(f"{_RUBBER}.summary") == before
            assert tab.value(_SAID) == 0
        # what the browser itself says of answers that ended or never came, or came before the new address was opened
        tab.wrong[:] = [one for one in tab.wrong if not one.startswith("Failed to load resource")]
