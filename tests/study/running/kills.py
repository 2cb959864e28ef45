"""Runs that are killed at random moments and resumed, with an account of what was solved when."""

from __future__ import annotations

import json
import random
import subprocess
import sys
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

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

    def read(self, lines: list[str]) -> None:
        """Take up the events of one run, the last line of which may be cut."""
        events = []
        for line in lines:
            try:
                events.append(json.loads(line))
            except ValueError:
                assert line == lines[-1]
        self.begun.append({event["key"] for event in events if event["event"] == "solving"})
        self.solved.append({event["key"] for event in events if event["event"] == "solved"})

    def check(self, workers: int) -> None:
        """See that no contact was begun again that had been stored, and that few were in hand when a run ended."""
        stored: set[str] = set()
        for begun, solved in zip(self.begun, self.solved, strict=True):
            assert not begun & stored
            # Those in hand, and one that was stored just before anybody could be told.
            assert len(begun - solved) <= workers + 1
            stored |= solved


def run(study: Path, folder: Path, workers: int) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "viscofric", "run", str(study), "-o", str(folder), "--resume", "--json"]
    return subprocess.Popen(
        [*command, "--workers", str(workers)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )


def killed_and_resumed(study: Path, folder: Path, kills: int, workers: int, seed: int, apart: float) -> Account:
    """Kill runs at random moments after their first contact, until one comes to its end."""
    chance, account = random.Random(seed), Account()
    for _ in range(kills):
        program = run(study, folder, workers)
        assert program.stdout is not None
        lines = []
        for line in program.stdout:
            lines.append(line)
            if '"solving"' in line:
                break
        time.sleep(chance.uniform(0.0, apart))
        program.kill()
        lines += program.stdout.readlines()
        program.stdout.close()
        assert program.wait() != 0, "there was nothing left to kill: give it more to solve"
        account.read(lines)
    program = run(study, folder, workers)
    output, _ = program.communicate()
    assert program.returncode == 0
    account.read(output.splitlines())
    return account
