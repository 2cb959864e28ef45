"""Server, process or connection killed at any moment: no process is left, and what is left alive goes on."""

from __future__ import annotations

import json
import os
import random
import signal
import socket
import time
from pathlib import Path

import pytest

from web.processes_left import PROC, ended, started_by
from web.served_page import STUDY, Server, started

SPEEDS = {"from": "1 mm/s", "to": "10 m/s", "points": 200, "spacing": "log"}
#: A study of many contacts.
LONG = {**STUDY, "conditions": {**STUDY["conditions"], "speed": SPEEDS}, "solver": {"accuracy": 1e-4}}

_END = 30.0  # s; a moment, but for a machine that does other work
SERVER_FIRST = 1  # a seed with which the server is killed


def connect(served: Server, workers: int, workspace: str = "workspace-kill") -> socket.socket:
    """Begin to solve a study on a bare connection."""
    host, port = served.base[7:].split(":")
    body = json.dumps({"study": LONG, "options": {"workers": workers}}).encode()
    head = (
        f"POST /api/jobs/export-study HTTP/1.1\r\nHost: {host}:{port}\r\nAuthorization: Bearer {served.token}\r\n"
        f"X-Workspace: {workspace}\r\nContent-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
    )
    connection = socket.create_connection((host, int(port)), timeout=10.0)
    connection.sendall(head.encode() + body)
    return connection


def kill_at_random(served: Server, chance: random.Random) -> list[int]:
    """Kill one of the three at a moment by chance; return the processes that must be gone.

    These are those that were killed, and those that they had started.
    """
    what = chance.choice(["server", "child", "connection"])
    connections = [connect(served, workers=chance.randint(1, 2)) for _ in range(chance.randint(1, 3))]
    time.sleep(chance.uniform(0.0, 0.8))
    known = started_by(served.process.pid)
    own = {child: started_by(child) for child in known}
    gone: list[int] = []
    if what == "server":
        served.process.send_signal(signal.SIGKILL)
        gone = [served.process.pid, *known, *(one for several in own.values() for one in several)]
    elif what == "child":
        killed = chance.choice(known)
        os.kill(killed, signal.SIGKILL)
        gone = [killed, *own[killed]]
    for connection in connections:
        connection.close()
    return gone


def check_kills(tmp_path: Path, times: int, seed: int) -> None:
    if not PROC.is_dir():
        pytest.skip("needs /proc to find processes")
    chance = random.Random(seed)
    left = times
    while left:
        with started(tmp_path) as served:
            everything: set[int] = set()
            while left and served.process.poll() is None:
                left -= 1
                gone = kill_at_random(served, chance)
                everything |= {*gone, *started_by(served.process.pid)}
                assert ended(gone, within=_END)
                if served.process.poll() is None:
                    settle(served)
        assert ended([*everything], within=_END)
    with started(tmp_path) as served:
        assert len(list(tmp_path.glob("viscofric-web-*"))) == 1  # those of killed servers are gone


def settle(served: Server) -> None:
    """Wait until nothing is at work any more; then work goes on.

    It takes two seconds at most, but for processes that still load, which answer when they have.
    """
    with served.client() as client:
        end = time.monotonic() + 60.0
        while client.get("/api/status").json()["running"]:
            assert time.monotonic() < end
            time.sleep(0.05)
        assert '"result"' in client.post("/api/jobs/export-run-file", json={"study": STUDY}).text


def test_killed_server_leaves_no_process(tmp_path: Path) -> None:
    check_kills(tmp_path, times=1, seed=SERVER_FIRST)


@pytest.mark.apart
def test_kills_at_random_leave_no_process(tmp_path: Path) -> None:
    """As many as VISCOFRIC_KILLS says; twenty take half a minute on a machine with nothing else to do."""
    check_kills(tmp_path, times=int(os.environ.get("VISCOFRIC_KILLS", "4")), seed=20261122)
