"""What every adapter does alike: read the task's CSV, time the work, write the answer as JSON.

An adapter is run in the peers' environment as ``python with_PEER.py TASK INPUT.csv OUTPUT.json``; it imports its peer
at the top, so that imports are not timed.
"""

from __future__ import annotations

import csv
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

#: Work that takes less than this is repeated, and the quickest time counts: the machine may be shared.
QUICK = 1.0  # CPU seconds
REPEATS = 5


class Sweep(NamedTuple):
    """One isotherm: °C, rad/s, Pa, Pa."""

    temperature: float
    angular_frequency: np.ndarray
    storage: np.ndarray
    loss: np.ndarray


def sweeps(path: Path) -> list[Sweep]:
    """Read isotherms, ascending in temperature, from columns T_C, omega, storage, loss."""
    rows = _numbers(path)
    temperatures = np.unique(rows[:, 0])
    return [Sweep(float(T), *rows[rows[:, 0] == T, 1:4].T) for T in temperatures]


def master_curve(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Read a master curve, ascending in frequency: rad/s, Pa, Pa."""
    omega, storage, loss = _numbers(path).T
    return omega, storage, loss


def _numbers(path: Path) -> np.ndarray:
    with path.open(encoding="utf-8", newline="") as lines:
        return np.array([[float(cell) for cell in row] for row in list(csv.reader(lines))[1:]])


def timed(work: Callable[[], Any]) -> tuple[Any, float]:
    """Do the work and return its result and the CPU seconds of this process that it took."""
    seconds = []
    while True:
        start = time.process_time()
        result = work()
        seconds.append(time.process_time() - start)
        if seconds[0] > QUICK or len(seconds) == REPEATS:
            return result, min(seconds)


def main(tasks: dict[str, Callable[[Path], dict[str, Any]]]) -> None:
    """Do the task that the command line names."""
    task, source, target = sys.argv[1:4]
    answer = tasks[task](Path(source))
    Path(target).write_text(json.dumps(answer, default=np.ndarray.tolist), encoding="utf-8")
