"""The page, served by a process of its own as ``viscofric web`` does it, and what tests ask it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx

STUDY = {
    "title": "A ball on a synthetic rubber",
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": {"load": "25 N", "speed": "20 mm/s", "temperature": "60 degC"},
    "solver": {"accuracy": 1e-2},
}
_ADDRESS = re.compile(r"page (http://127\.0\.0\.1:(\d+)/\?token=(\S+))")


@dataclass(frozen=True)
class Server:
    """A page that is served.

    Parameters
    ----------
    process : Popen
    address : str
        What the user opens, token and all.
    base : str
        Address without a path.
    token : str
    temporary : Path
        Where it keeps its temporary files.
    """

    process: subprocess.Popen[str]
    address: str
    base: str
    token: str
    temporary: Path

    def client(self, workspace: str = "workspace-of-tests", **more: Any) -> httpx.Client:
        """Return what asks the server, as a tab would."""
        headers = {"Authorization": f"Bearer {self.token}", "X-Workspace": workspace}
        return httpx.Client(base_url=self.base, headers=headers, trust_env=False, **{"timeout": 60.0, **more})


@contextmanager
def started(temporary: Path, *arguments: str) -> Iterator[Server]:
    """Serve the page, by default at a port that is free; its end is waited for."""
    temporary.mkdir(exist_ok=True, parents=True)
    process = subprocess.Popen(
        [sys.executable, "-m", "viscofric", "web", "--no-browser", *(arguments or ("--port", "0"))],
        env={**os.environ, "TMPDIR": str(temporary), "PYTHONUNBUFFERED": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdout is not None
    reader = None
    try:
        said = ""
        for line in process.stdout:
            said += line
            if found := _ADDRESS.search(line):
                break
        else:
            raise AssertionError(f"the page was not served:\n{said}")
        # what it says later must not fill the pipe
        reader = threading.Thread(target=process.stdout.read, daemon=True)
        reader.start()
        yield Server(process, found[1], f"http://127.0.0.1:{found[2]}", found[3], temporary)
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        if reader is not None:
            reader.join(10)
        process.stdout.close()


def messages_of(
    client: httpx.Client, kind: str, study: dict[str, Any] | None = None, **options: Any
) -> list[dict[str, Any]]:
    """Have a job done; return all that was told of it."""
    answer = client.post(f"/api/jobs/{kind}", json={"study": STUDY if study is None else study, "options": options})
    assert answer.status_code == 200, answer.text
    return [json.loads(line) for line in answer.text.splitlines()]
