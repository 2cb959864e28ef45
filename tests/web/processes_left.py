"""Which processes there are, and whether they end in time."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

PROC = Path("/proc")


def alive(process: int) -> bool:
    """Whether a process runs; one that ended and was not asked about yet does not."""
    try:
        return (PROC / str(process) / "stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except (FileNotFoundError, ProcessLookupError):
        return False


def started_by(parent: int, naming: str = "") -> list[int]:
    """Return the processes that a process started and that run still, those with a word in their command line."""
    if not PROC.is_dir():
        pytest.skip("needs /proc to find processes")
    found = []
    for entry in os.listdir(PROC):  # noqa: PTH208 - their number changes meanwhile
        if entry.isdecimal():
            try:
                mother = int((PROC / entry / "stat").read_text().rpartition(")")[2].split()[1])
                words = (PROC / entry / "cmdline").read_text()
            except (FileNotFoundError, ProcessLookupError):
                continue
            if mother == parent and naming in words and alive(int(entry)):
                found.append(int(entry))
    return found


def ended(processes: list[int], within: float) -> bool:
    """Wait for processes to end; return whether they did in time."""
    end = time.monotonic() + within
    while any(map(alive, processes)) and time.monotonic() < end:
        time.sleep(0.02)
    return not any(map(alive, processes))
