"""Nothing freezes: while contacts are solved, the server answers at once, and uploads go on."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
import pytest

from web.test_kills import LONG, connect

if TYPE_CHECKING:
    from web.served_page import Server


@pytest.mark.apart
def test_server_answers_at_once_while_three_studies_are_solved(server: Server) -> None:
    connections = [connect(server, workers=1, workspace=f"workspace-reply-{number}") for number in range(3)]
    try:
        with server.client("workspace-reply") as client:
            end = time.monotonic() + 60.0
            while client.get("/api/status").json()["running"] < 3:
                assert time.monotonic() < end
                time.sleep(0.05)
            time.sleep(0.5)
            taken = []
            for number in range(20):
                begun = time.monotonic()
                if number % 4:
                    assert client.get("/api/status").json()["running"] >= 1
                else:
                    client.put("/api/files/large.csv", content=b"0" * 2_000_000)
                taken.append(time.monotonic() - begun)
                time.sleep(0.02)
            # 10 ms on a machine with nothing else to do, and the processes that solve are nicer than the server; asked
            # after them, it would take seconds.  A machine that is busy otherwise makes each of the two wait
            assert np.median(taken) < 0.5
            assert client.post("/api/jobs/export-run-file", json={"study": LONG}).text.count('"event":"result"') == 1
    finally:
        for connection in connections:
            connection.close()
