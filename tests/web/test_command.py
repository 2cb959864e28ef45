"""``viscofric web``: the printed address, a taken port, an end that leaves nothing, what is missing in a sentence."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from typing import TYPE_CHECKING

import pytest
from click.testing import CliRunner

import viscofric.web.server as module
from viscofric.cli import main
from viscofric.study import load_study
from web.processes_left import ended, started_by
from web.served_page import STUDY, started

if TYPE_CHECKING:
    from pathlib import Path


def left_in(folder: Path) -> list[str]:
    return [path.name for path in folder.glob("viscofric-web-*")]


_MORE = (signal.SIGTERM, signal.SIGHUP)


@pytest.mark.parametrize("kind", [signal.SIGINT, *(pytest.param(one, marks=pytest.mark.slow) for one in _MORE)])
def test_interrupt_ends_it_at_once_with_nothing_left(tmp_path: Path, kind: signal.Signals) -> None:
    """Also while a job is at work, and an idle connection is open."""
    with started(tmp_path) as served, served.client() as client:
        children = started_by(served.process.pid)
        assert len(children) == 1
        answers: list[str] = []
        solving = threading.Thread(
            target=lambda: answers.append(client.post("/api/jobs/check", json={"study": STUDY}).text)
        )
        solving.start()
        deadline = time.monotonic() + 10.0
        with served.client() as other:
            while other.get("/api/status").json()["running"] == 0 and solving.is_alive():
                assert time.monotonic() < deadline
        assert left_in(tmp_path)
        served.process.send_signal(kind)
        begun = time.monotonic()
        assert served.process.wait(10.0) == 0
        assert time.monotonic() - begun < 5.0
        solving.join(5.0)
        assert json.loads(answers[0].splitlines()[-1])["event"] in ("error", "result")  # it may just have been done
        assert ended(children, within=0.5)
    assert left_in(tmp_path) == []


@pytest.mark.slow
def test_interrupt_while_it_starts_is_quick_too(tmp_path: Path) -> None:
    program = (
        "import sys; sys.argv = 'viscofric web --no-browser --port 0'.split(); import viscofric.cli as c; c.main()"
    )
    for delay in (0.3, 0.6, 0.9):
        process = subprocess.Popen(
            [sys.executable, "-c", program],
            env={**os.environ, "TMPDIR": str(tmp_path)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        time.sleep(delay)
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=10.0)
        assert process.returncode in (0, 130)
        assert "Traceback" not in said
    assert left_in(tmp_path) == []


def test_taken_port_is_replaced_by_a_free_one(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with started(tmp_path, "--port", str(port)) as served:
            assert served.base != f"http://127.0.0.1:{port}"
            with served.client() as client:
                assert client.get("/api/status").status_code == 200


def test_run_file_is_what_the_page_opens_with(tmp_path: Path) -> None:
    folder = tmp_path / "study"
    done = CliRunner().invoke(main, ["new", str(folder)])
    assert done.exit_code == 0
    with started(tmp_path / "t", "--port", "0", str(folder / "study.toml")) as served, served.client() as client:
        study = client.get("/api/start").json()["study"]
        assert study["title"] == load_study(folder / "study.toml").title
        assert [one["name"] for one in client.get("/api/files").json()] == ["dma.csv", "mtm.csv"]
        client.delete("/api/files/dma.csv")
        assert "no such file" in client.post("/api/jobs/check", json={"study": study}).text
    assert (folder / "dma.csv").exists()


def test_other_hosts_are_warned_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "serve", lambda *arguments, **more: None)
    done = CliRunner().invoke(main, ["web", "--host", "0.0.0.0", "--no-browser"])
    assert done.exit_code == 0
    assert "Warning: at 0.0.0.0, other machines can reach the page" in done.stderr
    assert "Warning" not in CliRunner().invoke(main, ["web", "--no-browser"]).output


def test_browser_is_opened_unless_it_is_not_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted: list[bool] = []
    monkeypatch.setattr(module, "serve", lambda *arguments, browser, **more: wanted.append(browser))
    for arguments in (["web"], ["web", "--no-browser"]):
        assert CliRunner().invoke(main, arguments).exit_code == 0
    assert wanted == [True, False]


@pytest.mark.parametrize("missing", ["fastapi", "uvicorn", "tomli_w"])
def test_missing_extra_is_named_in_a_sentence(tmp_path: Path, missing: str) -> None:
    program = f"import sys; sys.modules[{missing!r}] = None; from viscofric.cli import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", program, "web", "--no-browser", "--port", "0"],
        env={**os.environ, "TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stdout == ""
    assert 'pip install "viscofric[web]"' in done.stderr
    assert done.stderr.count("\n") == 1
    assert left_in(tmp_path) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nothing.toml"], "nothing.toml: no such file."),
        (["--host", "192.0.2.1"], "cannot be served at 192.0.2.1"),
        (["--host", "no such host"], "cannot be served at no such host"),
    ],
)
def test_what_cannot_be_served_is_told_in_a_sentence(arguments: list[str], words: str) -> None:
    done = CliRunner().invoke(main, ["web", "--no-browser", *arguments])
    assert done.exit_code == 1
    assert words in done.stderr
    assert "page http" not in done.stdout
