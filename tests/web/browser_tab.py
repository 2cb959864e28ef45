"""A tab of a real Chromium on the page, which counts what it asks for and minds what goes wrong."""

from __future__ import annotations

import os
import shutil
import time
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Page

    from web.served_page import Server

_NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
_QUIET = ("--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run")
#: Of axe's findings, these are errors.
SERIOUS = ("serious", "critical")


def chromium_path() -> str | None:
    """Return where a Chromium is, if there is one."""
    return next((found for name in _NAMES if (found := shutil.which(name))), None)


@contextmanager
def launched(path: str) -> Iterator[Browser]:
    """Have a headless Chromium."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", *_QUIET])
        try:
            yield browser
        finally:
            browser.close()


@dataclass
class Tab:
    """An open page.

    Parameters
    ----------
    page : Page
    wrong : list of str
        Errors on the console and of scripts, answers that say no, requests to other hosts.
    requested : list of tuple
        Addresses that were asked for, and the bytes that came over the wire.
    """

    page: Page
    wrong: list[str] = field(default_factory=list)
    requested: list[tuple[str, int]] = field(default_factory=list)

    def step(self, name: str) -> None:
        """Go to a step, and wait until it is there."""
        self.page.click(f'#steps a[href="#{name}"]')
        self.page.wait_for_selector(f"#step-{name}:not([hidden]) .step-body > *")

    def text(self, selector: str) -> str:
        """Return the text of an element."""
        return self.page.text_content(selector) or ""

    def until(self, expression: str, seconds: float = 20.0) -> None:
        """Wait until JavaScript finds something to be true; the page's policy keeps playwright from waiting itself."""
        end = time.monotonic() + seconds
        while not self.value(expression):
            assert time.monotonic() < end, f"it never came true: {expression}"
            self.page.wait_for_timeout(150)  # asking costs time, too

    def value(self, expression: str, *arguments: Any) -> Any:
        """Return what JavaScript finds; ``page`` holds modules: state, jobs, units, figures, fields, reactive."""
        modules = "const page = {}; for (const name of ['state', 'jobs', 'units', 'figures', 'fields', 'reactive']) "
        modules += "page[name] = await import(`/static/js/${name}.js`);"
        answer = f"(async () => {{ {modules} return ({expression}); }})()"
        # The window holds the promise: browsers may forget one that nothing in the page waits for.
        return self.page.evaluate(f"(given) => window.answer = {answer}", list(arguments))

    def findings(self) -> list[str]:
        """Return what axe finds serious."""
        found = Axe().run(self.page, options={"resultTypes": ["violations"]}).response["violations"]
        return [
            f"{one['id']}: {one['help']}: {[node['target'] for node in one['nodes']]}"
            for one in found
            if one["impact"] in SERIOUS
        ]

    def screenshot(self, name: str) -> None:
        """Keep a picture, where a folder for it is named."""
        if folder := os.environ.get("VISCOFRIC_SCREENSHOTS"):
            Path(folder).mkdir(parents=True, exist_ok=True)
            self.page.screenshot(path=Path(folder) / f"{name}.png", full_page=True)


@contextmanager
def tab(browser: Browser, server: Server, path: str = "", **context: Any) -> Iterator[Tab]:
    """Open the page in a tab with a memory of its own; what goes wrong there fails the test.

    Parameters
    ----------
    browser : Browser
    server : Server
    path : str
        Of the address, such as ``#export``.
    **context
        As of playwright's ``new_context``: viewport, color_scheme …
    """
    memory = browser.new_context(**{"viewport": {"width": 1400, "height": 900}, **context})
    try:
        opened = Tab(memory.new_page())
        _mind(opened, server)
        opened.page.goto(f"{server.address}{path}")
        opened.page.wait_for_selector("#steps [aria-current]")
        yield opened
        assert not opened.wrong, opened.wrong
    finally:
        memory.close()


def _mind(opened: Tab, server: Server) -> None:
    page, wrong = opened.page, opened.wrong
    page.on("console", lambda message: wrong.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: wrong.append(str(error)))

    def mind_request(request: Any) -> None:
        if not request.url.startswith((server.base, "data:", "blob:")):
            wrong.append(f"asked for {request.url}")

    def count(request: Any) -> None:
        if request.url.startswith(server.base):
            opened.requested.append((request.url.removeprefix(server.base), request.sizes()["responseBodySize"]))

    page.on("request", mind_request)
    page.on("requestfinished", count)
