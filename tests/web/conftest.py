"""Fixtures of the page."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from web.served_page import Server, started

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from playwright.sync_api import Browser

    from web.browser_tab import Tab


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """Serve the page, once for all tests of a process; each takes a workspace of its own."""
    with started(tmp_path_factory.mktemp("web")) as served:
        yield served


@pytest.fixture
def client(server: Server, request: pytest.FixtureRequest) -> Iterator[httpx.Client]:
    """Return what asks the server, in a workspace of the test's own."""
    name = re.sub(r"\W", "-", request.node.name, flags=re.ASCII)[-56:]
    with server.client(f"test-{name}") as asking:
        yield asking


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Have a Chromium, once for all tests of a process; skip the test where there is none."""
    from web.browser_tab import chromium_path, launched

    path = chromium_path()
    if path is None:
        pytest.skip("no Chromium is on the path")
    with launched(path) as found:
        yield found


@pytest.fixture
def tab(browser: Browser, server: Server) -> Iterator[Tab]:
    """Open the page, wide and light, at its last step, which computes nothing; errors on its console fail the test."""
    from web.browser_tab import tab

    with tab(browser, server, "#export") as opened:
        yield opened
