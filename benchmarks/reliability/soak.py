"""Whether long use makes anything grow: many solves in one process, or an hour of the page under a scripted user.

Run with ``python benchmarks/reliability/soak.py solves`` or ``... page``; the latter needs ``pip install -e .[dev]``.
The exit status is 1 if memory, descriptors, threads, caches, processes or temporary files grew beyond `LIMITS`.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import socket
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx

    from web.served_page import Server

#: Growth after warm-up that still passes, from the first to the last sample along the line fitted to all.
LIMITS = {
    "memory (MB)": 20.0,
    "descriptors": 10.0,  # of the page, as many as connections happen to be open
    "threads": 2.0,
    "cached results": 2.0,
    "processes": 1.0,
    "memory of processes (MB)": 200.0,
    "temporary files": 60.0,
    "temporary files (MB)": 30.0,
}
_WARM_UP = 0.2  # of the samples, in which caches fill
_MB = 1e6
_LONGEST = 600.0  # s for a reply, on a machine that does other work
_REST = 1.0  # s at most between two actions of a user of the page


def grown(samples: list[dict[str, float]]) -> dict[str, float]:
    """Return the growth of each number after warm-up, by a straight line through the samples."""
    rest = samples[int(_WARM_UP * len(samples)) :]
    place = np.linspace(0.0, 1.0, len(rest))
    return {name: float(np.polyfit(place, [one[name] for one in rest], 1)[0]) for name in rest[0] if name in LIMITS}


def of_process(process: int | str) -> dict[str, float]:
    """Return resident memory, descriptors and threads of a process (Linux only)."""
    proc = Path("/proc") / str(process)
    status = dict(line.split(":\t", 1) for line in (proc / "status").read_text().splitlines() if ":\t" in line)
    return {
        "memory (MB)": int(status["VmRSS"].split()[0]) * 1024 / _MB,
        "descriptors": len(os.listdir(proc / "fd")),  # noqa: PTH208
        "threads": int(status["Threads"]),
    }


class Log:
    """Samples that are printed, and written as JSON lines, as they are taken."""

    def __init__(self, path: Path | None) -> None:
        self.samples: list[dict[str, float]] = []
        self._file = None if path is None else path.open("w", buffering=1)
        self._begun = time.monotonic()

    def take(self, done: int, sample: dict[str, float]) -> None:
        """Keep a sample."""
        self.samples.append({"done": done, "time (s)": round(time.monotonic() - self._begun, 1), **sample})
        line = json.dumps({name: round(value, 2) for name, value in self.samples[-1].items()})
        print(line, flush=True)
        if self._file is not None:
            self._file.write(line + "\n")

    def judge(self) -> int:
        """Print the growth of each number and its limit; return the exit status."""
        if len(self.samples) < 5:
            print("too few samples to judge growth")
            return 1
        found = grown(self.samples)
        for name, growth in found.items():
            print(f"{name:<28} grew by {growth:8.2f}   limit {LIMITS[name]:g}")
        return int(any(growth > LIMITS[name] for name, growth in found.items()))


def cached_results() -> int:
    """Return how many results the caches of the package hold."""
    caches: dict[int, Any] = {}
    for name, module in list(sys.modules.items()):
        if name.startswith("viscofric"):
            caches |= {id(one): one for one in vars(module).values() if hasattr(one, "cache_info")}
    return sum(cache.cache_info().currsize for cache in caches.values())


def solves(number: int, each: int, seconds: float, log: Log) -> int:
    """Solve contacts at random conditions in this process: lines at 1 %, with a ball and curves in between."""
    import viscofric as vf

    chance = random.Random(20261128)
    materials = [
        vf.Material.standard_linear_solid(E0=1e6, E_inf=contrast * 1e6, tau="1 ms") for contrast in (10.0, 30.0, 100.0)
    ]
    fitted = vf.synthetic_fluoroelastomer()
    end = time.monotonic() + seconds
    done = 0
    while done < number and time.monotonic() < end:
        speed, load = 10.0 ** chance.uniform(-3.0, 0.0), 10.0 ** chance.uniform(2.0, 3.5)
        if done % 500 == 250:
            speeds = speed * np.geomspace(0.1, 1.0, 5)
            vf.predict_friction(
                fitted, vf.Cylinder("10 mm"), speeds=speeds, temperatures="60 degC", load=load, accuracy=1e-2
            )
        elif done % 200 == 100:
            vf.solve_steady(fitted, vf.Ball("9.525 mm"), load=25.0, speed=speed, temperature="60 degC", accuracy=1e-2)
        else:
            indenter = vf.Cylinder(chance.uniform(5e-3, 2e-2))
            vf.solve_steady(chance.choice(materials), indenter, load=load, speed=speed, accuracy=1e-2, tolerance=1e-5)
        done += 1
        if done % each == 0:
            log.take(done, {**of_process("self"), "cached results": cached_results()})
    print(f"{done} solves")
    return log.judge()


class User:
    """A scripted user with some tabs and bad connections; each action is one of his methods."""

    def __init__(self, served: Server, seed: int) -> None:
        self.served, self.chance, self.counts = served, random.Random(seed), dict[str, int]()
        self.clients = [served.client(f"soak-tab-{seed}-{tab}", timeout=_LONGEST) for tab in range(2)]
        self.open: list[tuple[float, socket.socket]] = []
        host, port = served.base[7:].split(":")
        self.place = host, int(port)

    def fill(self) -> None:
        """Open as many tabs with files as half a server keeps, so that later ones replace them."""
        for _ in range(25):
            self.fresh_tab(self.clients[0])
            for _ in range(8):
                self.upload(self.clients[0])

    def act(self) -> None:
        """Do one thing at random, and close connections that were left open for 40 s."""
        weights = {
            self.solve: 6,
            self.check: 4,
            self.upload: 4,
            self.look: 4,
            self.cancel: 3,
            self.download: 2,
            self.read_slowly: 1,
            self.half_open: 2,
            self.refused: 1,
            self.fresh_tab: 1,
        }
        action: Callable[[httpx.Client], object] = self.chance.choices([*weights], [*weights.values()])[0]
        action(self.chance.choice(self.clients))
        self.counts[action.__name__] = self.counts.get(action.__name__, 0) + 1
        now = time.monotonic()
        for begun, connection in self.open[:]:
            if now - begun > 40.0 or len(self.open) > 30:
                connection.close()
                self.open.remove((begun, connection))

    def _study(self, points: int = 1) -> dict[str, Any]:
        speeds = {"from": "1 mm/s", "to": "1 m/s", "points": points, "spacing": "log"}
        return {
            "title": "Soak",
            "material": {"catalogue": "synthetic fluoroelastomer"},
            "indenter": {"shape": "ball", "radius": "9.525 mm"},
            "conditions": {"load": "25 N", "speed": speeds if points > 1 else "20 mm/s", "temperature": "60 degC"},
            "solver": {"accuracy": 1e-2},
        }

    def _job(self, client: httpx.Client, kind: str, study: dict[str, Any], **options: Any) -> dict[str, Any]:
        reply = client.post(f"/api/jobs/{kind}", json={"study": study, "options": options})
        assert reply.status_code == 200, reply.text
        found: dict[str, Any] = json.loads(reply.text.splitlines()[-1])
        return found

    def solve(self, client: httpx.Client) -> None:
        """Have a contact solved."""
        speed = 10.0 ** self.chance.uniform(-3.0, 0.0)
        found = self._job(client, "contact", self._study(), speed=speed, temperature=333.0)
        assert found["event"] == "result", found

    def check(self, client: httpx.Client) -> None:
        """Have a run file checked."""
        assert self._job(client, "export-run-file", self._study(7))["event"] == "result"

    def upload(self, client: httpx.Client) -> None:
        """Store the example, a file of 100 kB, and remove one."""
        client.post("/api/files/example").raise_for_status()
        client.put(f"/api/files/file{self.chance.randrange(8)}.csv", content=os.urandom(100_000)).raise_for_status()
        client.delete(f"/api/files/file{self.chance.randrange(8)}.csv")

    def look(self, client: httpx.Client) -> None:
        """Load parts of the page."""
        for path in ("/", "/api/start", "/api/status", "/api/files"):
            client.get(path).raise_for_status()

    def cancel(self, client: httpx.Client) -> None:
        """Begin a curve and go away, or stop it."""
        body = {"study": self._study(60), "options": {}}
        with client.stream("POST", "/api/jobs/curve", json=body) as reply:
            for line in reply.iter_lines():
                found = json.loads(line)
                if found["event"] == "started" and self.chance.random() < 0.5:
                    client.post(f"/api/jobs/{found['job']}/stop")
                elif found["event"] not in ("queued", "started"):
                    break

    def download(self, client: httpx.Client) -> None:
        """Have the run file exported and fetch what was made."""
        found = self._job(client, "export-run-file", self._study(), pack=True)
        assert found["event"] == "result", found
        name = found["result"]["download"]["name"]
        client.get(f"/api/downloads/{name}", params={"workspace": client.headers["X-Workspace"]}).raise_for_status()

    def _begin(self, client: httpx.Client, method: str, path: str, body: bytes, sent: int) -> None:
        head = (
            f"{method} {path} HTTP/1.1\r\nHost: {self.place[0]}:{self.place[1]}\r\n"
            f"Authorization: Bearer {self.served.token}\r\nX-Workspace: {client.headers['X-Workspace']}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
        )
        connection = socket.socket()
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        connection.settimeout(10.0)
        connection.connect(self.place)
        connection.sendall((head.encode() + body)[:sent] if sent else head.encode() + body)
        self.open.append((time.monotonic(), connection))

    def read_slowly(self, client: httpx.Client) -> None:
        """Request a job and much of the page, and read nothing of it."""
        options = {"speed": 0.02, "temperature": 333.0}
        body = json.dumps({"study": self._study(), "options": options}).encode()
        self._begin(client, "POST", "/api/jobs/contact", body, 0)
        self._begin(client, "GET", "/static/vendor/plotly-cartesian.min.js", b"", 0)

    def half_open(self, client: httpx.Client) -> None:
        """Send a part of a request."""
        self._begin(client, "PUT", "/api/files/half.csv", bytes(1000), self.chance.randrange(1, 600))

    def refused(self, client: httpx.Client) -> None:
        """Send what is refused."""
        assert client.post("/api/jobs/nothing", json={}).status_code == 404
        assert self._job(client, "contact", {"indenter": {"shape": "cube"}})["event"] == "error"

    def fresh_tab(self, client: httpx.Client) -> None:
        """Open a tab with a new workspace instead of one of the two."""
        client.close()
        place = self.clients.index(client)
        self.clients[place] = self.served.client(f"soak-{self.chance.randrange(10**9):09d}", timeout=_LONGEST)


def page(seconds: float, each: float, log: Log) -> int:
    """Serve the page to two scripted users, and watch the server, its processes and its temporary files."""
    from web.processes_left import started_by
    from web.served_page import started

    with tempfile.TemporaryDirectory() as folder, started(Path(folder)) as served:
        end = time.monotonic() + seconds
        failures: list[BaseException] = []
        users = [User(served, seed) for seed in range(2)]
        for user in users:
            user.fill()

        def use(user: User) -> None:
            try:
                while time.monotonic() < end:
                    user.act()
                    time.sleep(user.chance.uniform(0.0, _REST))
            except BaseException as error:  # noqa: BLE001 - it is raised in the main thread
                failures.append(error)

        threads = [threading.Thread(target=use, args=(user,), daemon=True) for user in users]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads) and not failures:
            time.sleep(each)
            children = started_by(served.process.pid)
            files = [path for path in Path(folder).rglob("*") if path.is_file()]
            log.take(
                sum(sum(user.counts.values()) for user in users),
                {
                    **of_process(served.process.pid),
                    "processes": len(children),
                    "memory of processes (MB)": sum(_memory(child) for child in children),
                    "temporary files": len(files),
                    "temporary files (MB)": sum(_size(path) for path in files) / _MB,
                },
            )
        for user in users:
            print(json.dumps(user.counts))
        if failures:
            raise failures[0]
        for user in users:
            for _, connection in user.open:
                connection.close()
        time.sleep(5.0)  # jobs that were left end
        with served.client() as client:
            print("at the end:", client.get("/api/status").json(), of_process(served.process.pid))
    return log.judge()


def _memory(process: int) -> float:
    try:
        return of_process(process)["memory (MB)"]
    except (OSError, KeyError):  # it ended meanwhile
        return 0.0


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


def main() -> None:
    """Run a soak and judge it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["solves", "page"])
    parser.add_argument("--number", type=int, default=100_000, help="solves")
    parser.add_argument("--seconds", type=float, default=3600.0, help="longest duration")
    parser.add_argument("--each", type=float, help="solves, or seconds, between samples [default: 1000, or 20]")
    parser.add_argument("--log", type=Path, help="also write the samples here, one JSON object a line")
    options = parser.parse_args()
    log = Log(options.log)
    if options.what == "solves":
        sys.exit(solves(options.number, int(options.each or 1000), options.seconds, log))
    sys.exit(page(options.seconds, options.each or 20.0, log))


if __name__ == "__main__":
    main()
