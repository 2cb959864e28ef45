"""Fixtures of the page."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from web.served_page import Server, started

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx


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
