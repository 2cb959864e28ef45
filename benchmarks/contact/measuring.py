"""What the contact benchmarks share: CPU time, the unit of an FFT pair, peak memory, tables and JSON."""

from __future__ import annotations

import gc
import json
import os
import platform
import time
import tracemalloc
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import scipy
import scipy.fft

import viscofric

Result = TypeVar("Result")
#: Heading of a column, its key in a row, its format.
Column = tuple[str, str, str]


def cpu_seconds(work: Callable[[], Result]) -> tuple[Result, float]:
    """Do some work; return what it gives and the CPU seconds that this process spent."""
    start = time.process_time()
    result = work()
    return result, time.process_time() - start


def padded_shape(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape in which a window of cells is convolved without wrapping around."""
    return tuple(scipy.fft.next_fast_len(2 * cells - 1, real=True) for cells in shape)


def seconds_per_pair(shape: tuple[int, ...]) -> float:
    """CPU seconds for a forward and an inverse real FFT (SciPy, one thread), the least of several."""
    values = np.random.default_rng(0).random(shape)
    return min(cpu_seconds(lambda: scipy.fft.irfft2(scipy.fft.rfft2(values), shape))[1] for _ in range(5))


def peak_bytes(work: Callable[[], Result]) -> tuple[Result, int]:
    """Do some work; return what it gives and the most memory that its arrays took at any time.

    Slower than the work alone: not to be timed.
    """
    gc.collect()
    tracemalloc.start()
    try:
        result = work()
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    return result, peak


def growth(points: Sequence[float], seconds: Sequence[float]) -> float:
    """Return the exponent of time in the number of points, by least squares of the logarithms."""
    return float(np.polyfit(np.log(points), np.log(seconds), 1)[0])


def print_table(title: str, rows: Sequence[dict[str, Any]], columns: Sequence[Column]) -> None:
    """Print rows, each with a name under "case", as a table; a row with an "error" says that instead."""
    width = max([len(row["case"]) for row in rows] + [12]) + 2
    print(f"\n{title}")
    print(" " * width + "".join(f"{heading:>{_width(heading)}}" for heading, _, _ in columns))
    for row in rows:
        if "error" in row:
            print(f"{row['case']:{width}}{row['error']}", flush=True)
            continue
        print(
            f"{row['case']:{width}}"
            + "".join(f"{_shown(row.get(key), form):>{_width(heading)}}" for heading, key, form in columns),
            flush=True,
        )


def _width(heading: str) -> int:
    return max(len(heading), 9) + 2


def _shown(value: Any, form: str) -> str:
    return "–" if value is None else format(value, form)


def write_json(path: Path | None, results: dict[str, Any]) -> None:
    """Write results with the versions and the machine that they were measured with; nothing without a path."""
    if path is None:
        return
    measured_with = {
        "viscofric": viscofric.__version__,
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "python": platform.python_version(),
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps({"measured_with": measured_with, **results}, indent=1, ensure_ascii=False)
    path.write_text(text, encoding="utf-8")
