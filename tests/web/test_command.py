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
from pathlib import Path

import pytest

import viscofric.web.server as module
from cli.calls import call, succeed
from viscofric import load_study
from web.processes_left import ended, started_by
from web.served_page import STUDY, started


def left_in(folder: Path) -> list[str]:
    return [path.name for path in folder.glob("viscofric-web-*")]


@pytest.mark.parametrize("kind", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.apart)])
def test_interrupt_ends_it_at_once_with_nothing_left(tmp_path: Path, kind: signal.Signals) -> None:
    """Also while a job is at work, and an idle connection is open."""
    with started(tmp_path) as served, served.client() as client:
        children = started_by(served.process.pid)
        assert len(children) == 1
        answers: list[str] = []
        solving = threading.Thread(
            target=lambda: answers.append(client.post("/api/jobs/export-run-file", json={"study": STUDY}).text)
        )
        solving.start()
        deadline = time.monotonic() + 60.0
        with served.client() as other:
            while other.get("/api/status").json()["running"] == 0 and solving.is_alive():
                assert time.monotonic() < deadline
        assert left_in(tmp_path)
        served.process.send_signal(kind)
        # at once: within the two seconds that connections have to finish, and far below what the study takes
        assert served.process.wait(30.0) == 0
        solving.join(30.0)
        assert json.loads(answers[0].splitlines()[-1])["event"] in ("error", "result")  # it may just have been done
        assert ended(children, within=10.0)
    assert left_in(tmp_path) == []


#: Interrupts itself where it is about to load a module; Python drops what is raised as it collects garbage.
_INTERRUPTED = """
import signal, sys
from viscofric.cli import main

signal.signal(signal.SIGINT, signal.default_int_handler)  # where tests run in the background, it may be ignored

class Collected:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)

class Moment:
    def find_spec(self, name, *_):
        if name == {module!r}:
            sys.meta_path.remove(self)
            {interrupt}

sys.unraisablehook = lambda dropped: None
sys.meta_path.insert(0, Moment())
main(["web", "--no-browser", "--port", "0"])
"""


@pytest.mark.parametrize(
    ("module", "interrupt"),
    [
        pytest.param("viscofric.web.server", "signal.raise_signal(signal.SIGINT)", id="before it begins"),
        pytest.param("viscofric.web.app", "signal.raise_signal(signal.SIGINT)", id="with a process started"),
        pytest.param("viscofric.web.app", "Collected()", id="as garbage is collected"),
    ],
)
def test_interrupt_while_it_starts_ends_it_too(tmp_path: Path, module: str, interrupt: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", _INTERRUPTED.format(module=module, interrupt=interrupt)],
        env={**os.environ, "TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
        timeout=60.0,
    )
    assert done.returncode == 130
    assert done.stderr.strip() == "Interrupted."
    assert left_in(tmp_path) == []


def test_signals_stop_what_is_served_and_are_given_back() -> None:
    kinds = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = [signal.getsignal(kind) for kind in kinds]
    for kind in kinds:
        called: list[str] = []
        with module._stopped_by_signals() as stopping:
            with pytest.raises(KeyboardInterrupt):
                signal.raise_signal(kind)
            assert stopping.requested
            stopping += [lambda: called.append("server"), lambda: called.append("children")]  # noqa: B023
            signal.raise_signal(kind)
        assert called == ["server", "children"]
    assert [signal.getsignal(kind) for kind in kinds] == before


def test_taken_port_is_replaced_by_a_free_one(monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with module.bound("127.0.0.1", port) as listening:
            free = listening.getsockname()[1]
            assert free != port
            with socket.create_connection(("127.0.0.1", free), timeout=10.0):
                pass
    monkeypatch.setattr(
        module, "serve", lambda *arguments, on_start, **more: on_start(f"http://127.0.0.1:{free}/", free)
    )
    done = call("web", "--no-browser", "--port", port)
    assert len(done.stderr.splitlines()) == 1
    assert str(port) in done.stderr
    assert str(free) in done.stderr
    assert f"page http://127.0.0.1:{free}/" in done.stdout


@pytest.mark.apart
def test_run_file_is_what_the_page_opens_with(tmp_path: Path) -> None:
    folder = tmp_path / "study"
    succeed("new", folder)
    with started(tmp_path / "t", "--port", "0", str(folder / "study.toml")) as served, served.client() as client:
        study = client.get("/api/start").json()["study"]
        assert study["title"] == load_study(folder / "study.toml").title
        assert [one["name"] for one in client.get("/api/files").json()] == ["dma.csv", "mtm.csv"]
        client.delete("/api/files/dma.csv")
        reply = client.post("/api/jobs/export-run-file", json={"study": study}).text.replace(": ", ":")
        assert '"result"' in reply
        assert '"problems":[]' not in reply
    assert (folder / "dma.csv").exists()


def test_other_hosts_are_warned_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "serve", lambda *arguments, **more: None)
    done = succeed("web", "--host", "0.0.0.0", "--no-browser")
    assert "Warning: " in done.stderr
    assert "0.0.0.0" in done.stderr
    assert "Warning" not in call("web", "--no-browser").output


def test_browser_is_opened_unless_it_is_not_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted: list[bool] = []
    monkeypatch.setattr(module, "serve", lambda *arguments, browser, **more: wanted.append(browser))
    for arguments in (["web"], ["web", "--no-browser"]):
        succeed(*arguments)
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
def test_what_cannot_be_served_is_reported_in_a_sentence(arguments: list[str], words: str) -> None:
    done = call("web", "--no-browser", *arguments)
    assert done.exit_code == 1
    assert words in done.stderr
    assert "page http" not in done.stdout
