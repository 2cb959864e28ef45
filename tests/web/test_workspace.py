"""Files of a tab: plain names, bounds, no other tab's; nothing stays behind, even of servers that were killed."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import aclosing, closing
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from refusals import refused
from viscofric.errors import InputError
from viscofric.web import workspace as module
from viscofric.web.child import make_room
from viscofric.web.workspace import Workspace, Workspaces, checked_name, remove_stale
from web.own_loop import run_apart

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

    import httpx

    from web.served_page import Server


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Have temporary folders made here."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


@pytest.mark.parametrize(
    "name", ["sweeps.csv", "Messung 3 (60 °C).xlsx", "動的粘弾性.txt", "a" * 146 + ".csv", "no-suffix"]
)
def test_plain_names_are_kept(client: httpx.Client, name: str) -> None:
    from urllib.parse import quote

    assert client.put(f"/api/files/{quote(name)}", content=b"1").json() == {"name": name, "size": 1}
    assert client.get("/api/files").json() == [{"name": name, "size": 1}]
    assert client.delete(f"/api/files/{quote(name)}").status_code == 204
    assert client.delete(f"/api/files/{quote(name)}").status_code == 404
    assert client.get("/api/files").json() == []


@pytest.mark.parametrize(
    "name",
    [
        *("..", ".", ".hidden", "a/b", "a\\b", "C:x", "a*.csv", "what?", "a\0b", "a\nb", " a", "a ", "a.", ""),
        *("CON", "nul.txt", "a\u202ecsv.exe", "a\u200b", "\ud800", "a" * 151, "é" * 76),
    ],
)
def test_other_names_are_refused_in_a_sentence(name: str) -> None:
    with pytest.raises(InputError) as caught:
        checked_name(name)
    assert caught.value.code in ("not-a-name", "too-long")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("path", ["..%2f..%2fx", "%2e%2e", "a%00b", "a%5cb", "CON", "%ff%fe", "x%2fy"])
@pytest.mark.parametrize("method", ["PUT", "DELETE", "GET"])
def test_no_address_leads_out_of_the_workspace(client: httpx.Client, path: str, method: str) -> None:
    home = "downloads" if method == "GET" else "files"
    answer = client.request(method, f"/api/{home}/{path}?workspace=workspace-of-tests", content=b"x")
    assert answer.status_code in (404, 405, 422)
    assert "message" in answer.json()
    assert client.get("/api/files").json() == []


def test_composed_and_decomposed_letters_are_the_same_name(client: httpx.Client) -> None:
    assert client.put("/api/files/e%CC%81.csv", content=b"1").json()["name"] == "\u00e9.csv"


def test_tabs_do_not_see_each_others_files(server: Server) -> None:
    with server.client("workspace-first") as first, server.client("workspace-second") as second:
        first.post("/api/files/example")
        assert [one["name"] for one in first.get("/api/files").json()] == ["dma.csv", "mtm.csv"]
        assert second.get("/api/files").json() == []
        study = {"material": {"dma": "dma.csv", "reference_temperature": "30 degC"}}
        study |= {"indenter": {"shape": "ball", "radius": "1 mm"}}
        study |= {"conditions": {"load": "1 N", "speed": "1 m/s", "temperature": "60 degC"}}
        replies = (one.post("/api/jobs/export-run-file", json={"study": study}).text for one in (first, second))
        assert ['"problems":[]' in reply.replace(": ", ":") for reply in replies] == [True, False]


@pytest.mark.parametrize("key", [None, "", "short", "../../etc", "a" * 65, "with space", "ümlaut-workspace"])
def test_workspace_must_have_a_name(server: Server, key: str | None) -> None:
    with server.client() as client:
        client.headers.pop("X-Workspace")
        headers = {} if key is None else {"X-Workspace": key.encode()}
        assert client.get("/api/files", headers=headers).status_code == 422
        assert client.get("/api/downloads/x", params={} if key is None else {"workspace": key}).status_code == 422


def test_number_and_size_of_files_have_bounds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    workspace = Workspace(tmp_path)
    monkeypatch.setattr(module, "MOST_FILES", 3)
    monkeypatch.setattr(module, "_MOST_BYTES", 100)
    workspace.store("a", b"0" * 40)
    workspace.store("b", b"0" * 40)
    with refused("no-space"):
        workspace.store("c", b"0" * 40)
    workspace.store("b", b"0" * 10)
    workspace.store("c", b"")
    with refused("too-many-files"):
        workspace.store("d", b"")
    workspace.store("c", b"1")
    with refused("too-large", naming="20 MB"):
        workspace.store("c", b"0" * 20_000_001)
    assert workspace.listing() == [("a", 40), ("b", 10), ("c", 1)]
    assert len(os.listdir(workspace.files)) == 3  # noqa: PTH208 - nothing half written stays


def test_workspace_that_rested_longest_makes_room(temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_MOST_WORKSPACES", 2)
    given = temporary / "given.csv"
    given.write_text("1")
    spaces = Workspaces({"data.csv": given})
    try:
        first, second = spaces.get("first-workspace"), spaces.get("Second-workspace")
        assert first.listing() == [("data.csv", 1)]
        assert spaces.get("first-workspace") is first
        spaces.get("second-workspace")  # another one: case counts
        assert first.files.exists()
        assert not second.files.exists()
    finally:
        spaces.close()
    assert not spaces.root.exists()


def test_workspace_with_a_job_at_work_makes_no_room(temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_MOST_WORKSPACES", 2)

    async def reported() -> AsyncIterator[bytes]:
        yield b"queued"
        yield b"started"

    async def work() -> None:
        with closing(Workspaces()) as spaces:
            first, second = spaces.get("first-workspace"), spaces.get("second-workspace")
            async with aclosing(first.while_at_work(reported())) as lines:
                assert await anext(lines) == b"queued"
                spaces.get("third-workspace")
                assert first.folder.exists()
                assert not second.folder.exists()
                third = spaces.get("third-workspace").while_at_work(reported())
                async with aclosing(third):
                    await anext(third)
                    with refused("too-many-tabs"):
                        spaces.get("fourth-workspace")
            spaces.get("fourth-workspace")  # the job was let go of
            assert len([one for one in spaces.root.iterdir() if one.is_dir()]) == 2

    run_apart(work())


def test_first_requests_of_a_tab_at_once_get_one_workspace(temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A second one would copy the given files anew, while the job of the first reads them."""
    given = temporary / "given.csv"
    given.write_text("1")
    copied: list[Path] = []

    def slowly(source: Path, target: Path) -> None:
        time.sleep(0.02)
        copied.append(target)
        target.write_bytes(source.read_bytes())

    monkeypatch.setattr(module.shutil, "copyfile", slowly)
    with closing(Workspaces({"data.csv": given})) as spaces, ThreadPoolExecutor(8) as several:
        found = list(several.map(lambda _: spaces.get("same-workspace"), range(8)))
        assert len({id(one) for one in found}) == 1
        assert copied == [found[0].files / "data.csv"]


def test_nobody_else_can_look_into_the_folders(temporary: Path) -> None:
    with closing(Workspaces()) as spaces:
        spaces.get("some-workspace").store("data.csv", b"1")
        assert os.name == "nt" or spaces.root.stat().st_mode & 0o077 == 0


def test_oldest_of_what_jobs_keep_makes_room(tmp_path: Path) -> None:
    places = [tmp_path, tmp_path / "cases", tmp_path / "friction cases", tmp_path / "study" / "study.results" / "cases"]
    kept = []
    for age, folder in enumerate(places):
        folder.mkdir(parents=True, exist_ok=True)
        kept.append(folder / ("rubber.pickle" if folder is tmp_path else "case.json"))
        kept[-1].write_bytes(b"0" * 100)
        os.utime(kept[-1], (time.time() - 1000.0 * (age + 1),) * 2)
    other = tmp_path / "study" / "dma.csv"
    other.write_bytes(b"0" * 1_000)
    make_room(tmp_path, most=400)
    assert all(path.exists() for path in kept)
    make_room(tmp_path, most=250)
    assert [path.exists() for path in kept] == [True, True, False, False]
    make_room(tmp_path, most=0, young=1500.0)
    assert [path.exists() for path in kept] == [True, False, False, False]  # it may be of a job at work
    assert other.exists()


def test_folders_of_killed_servers_are_removed_at_the_next_start(temporary: Path) -> None:
    living = Workspaces()
    try:
        program = (
            "import os, signal, sys, tempfile; tempfile.tempdir = sys.argv[1]\n"
            "from viscofric.web.workspace import Workspaces\n"
            "print(Workspaces().root, flush=True); os.kill(os.getpid(), signal.SIGKILL)"
        )
        done = subprocess.run([sys.executable, "-c", program, temporary], capture_output=True, text=True, check=False)
        killed = Path(done.stdout.strip())
        assert killed.is_dir()
        fresh, old, foreign = (temporary / f"viscofric-web-{name}" for name in ("fresh", "old", "foreign"))
        fresh.mkdir()
        old.mkdir()
        os.utime(old, (time.time() - 3600.0,) * 2)
        foreign.symlink_to(temporary)
        remove_stale()
        assert not killed.exists()
        assert not old.exists()
        assert fresh.exists()  # it may be just being made
        assert living.root.exists()
        assert foreign.exists()
    finally:
        living.close()
