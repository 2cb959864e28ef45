"""Runs of a study that are killed (SIGKILL) at random moments and resumed, with an account of what was solved when.

Each run is a process of its own, forked from one that has everything imported, which takes a moment only.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any, Self

STUDY = """
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "9.525 mm"
[conditions]
load = "5 N"
speed = {{ from = "1 mm/s", to = "1 m/s", points = {points} }}
temperature = ["30 degC", "60 degC"]
[solver]
accuracy = 5e-2
cases = "{cases}"
master_curve_points = 3
[uncertainty]
draws = 0
[outputs]
fields = "none"
"""


@dataclass
class Account:
    """Contacts of each run: begun, and solved and stored."""

    begun: list[set[str]] = field(default_factory=list)
    solved: list[set[str]] = field(default_factory=list)

    def read(self, events: list[dict[str, Any]]) -> None:
        """Take up the events of one run."""
        self.begun.append({event["key"] for event in events if event["event"] == "solving"})
        self.solved.append({event["key"] for event in events if event["event"] == "solved"})

    def check(self, workers: int) -> None:
        """See that no contact was begun again that had been stored, and that few were in hand when a run ended."""
        stored: set[str] = set()
        for begun, solved in zip(self.begun, self.solved, strict=True):
            assert not begun & stored
            # Those in hand, and with several workers one each that was stored, or begun, before anybody could be told.
            assert len(begun - solved) <= workers + 1
            stored |= solved

    @property
    def again(self) -> int:
        """How many contacts were begun more than once."""
        return sum(map(len, self.begun)) - len(set().union(*self.begun))


class Runs:
    """A process that has everything imported, and forks another one for each run of a study."""

    def __enter__(self) -> Self:
        self._program = subprocess.Popen(
            [sys.executable, __file__],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        )
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._program.kill()
        self._program.communicate()

    def run(self, study: Path, folder: Path, workers: int, after: int | None, wait: float) -> tuple[int, list[Any]]:
        """Run a study; kill it a moment after one of its events (by number), or not at all.

        Returns
        -------
        status : int
            Of the run; 0 if it came to its end.
        events : list of dict
        """
        assert self._program.stdin is not None
        assert self._program.stdout is not None
        self._program.stdin.write(json.dumps([str(study), str(folder), workers]) + "\n")
        self._program.stdin.flush()
        process = int(self._program.stdout.readline())
        events: list[Any] = []
        for line in self._program.stdout:
            with contextlib.suppress(ValueError):  # a line that was cut
                event = json.loads(line)
                if event["event"] == "ended":
                    return event["status"], events
                if event["event"] != "stored":
                    events.append(event)
            if after is not None and len(events) > after:
                time.sleep(wait)
                os.kill(process, signal.SIGKILL)
                after = None
        raise AssertionError("the process that starts the runs ended")


def killed_and_resumed(
    runs: Runs, study: Path, folder: Path, kills: int, workers: int, seed: int, contacts: int
) -> Account:
    """Kill runs at random moments, a few of them after the last contact, until one comes to its end.

    Parameters
    ----------
    contacts : int
        Of the study, which are spread over the kills.

    Notes
    -----
    A machine that does other work may let a run come to its end before it is killed; one run at least is killed.
    """
    chance, account = random.Random(seed), Account()
    # Half a dozen events come before the first contact, two for each; half of the contacts are left for the last run.
    most = 6 + contacts // kills
    for _ in range(kills):
        after, wait = chance.randint(0, most), chance.uniform(0.0, 0.05)
        status, events = runs.run(study, folder, workers, after, wait)
        account.read(events)
        if status != -signal.SIGKILL:
            assert status == 0
            assert len(account.begun) > 1, "there was nothing to kill: give it more to solve"
            return account
    status, events = runs.run(study, folder, workers, None, 0.0)
    assert status == 0
    account.read(events)
    return account


def _start_runs() -> None:
    """Fork a process for each line of standard input, which names a study, a folder and a number of workers."""
    from pathlib import Path

    from viscofric.study.execution import run_study

    for line in sys.stdin:
        study, folder, workers = json.loads(line)
        process = os.fork()
        if process == 0:
            sys.stdout.write(f"{os.getpid()}\n")
            run_study(
                study,
                output=Path(folder),
                resume=True,
                workers=workers,
                progress=lambda event: print(json.dumps(event.as_dict()), flush=True),
            )
            sys.stdout.flush()
            os._exit(0)
        _, status = os.waitpid(process, 0)
        print("\n" + json.dumps({"event": "ended", "status": os.waitstatus_to_exitcode(status)}), flush=True)


if __name__ == "__main__":
    _start_runs()
