"""What FFTs and arrays of other libraries save: the same contacts with every backend that is present, in one run.

Usage: python benchmarks/contact/backends.py [--sizes 256 512 1024] [--backends scipy ducc0 torch:cuda ...]
           [--repeats 3] [--clock wall|cpu] [--json FILE]

Per size, the times of a pair of real FFTs (forward and inverse) of the whole grid, of a zero-padded convolution on a
window of that size, and of a whole periodic rough contact: elastic, and viscoelastic with 20 modes over five decades
and E_inf/E0 = 100.  Once, of a ball on 25 modes to an accuracy of 3e-4.  The least of several times; in brackets
over that of the first backend.  A name may end in xN for N threads of the FFTs, as in scipyx2.  Solvers count the same
FFTs whatever computes them, but for the digits of the last one or two; where they do not, it is told.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "tests")]

import measuring  # noqa: E402
import numpy as np  # noqa: E402
import scipy.fft  # noqa: E402

import viscofric as vf  # noqa: E402
from contact.made_surfaces import self_affine  # noqa: E402
from gallery import broad_spectrum_25  # noqa: E402

if TYPE_CHECKING:
    from collections.abc import Callable

BACKENDS = ("scipy", "scipyx2", "ducc0", "ducc0x2", "torch:cpu", "torch:cuda", "cupy")
MODES = vf.RetardationSpectrum(1.0, 100.0, np.full(20, 0.99 / 20), np.logspace(-4, 1, 20))
RUBBER = vf.Material(MODES, poisson_ratio=0.0)
BALL_ACCURACY = 3e-4


def backend_of(name: str) -> vf.contact.Backend:
    library, threads = re.fullmatch(r"(.*?)(?:x(\d+))?", name).groups()  # type: ignore[union-attr]
    return vf.contact.Backend(library, threads=int(threads)) if threads else vf.contact.Backend(library)


class Stopwatch:
    """Takes the least time of some repetitions after a first one, which plans and compiles."""

    def __init__(self, clock: Callable[[], float], repeats: int) -> None:
        self.clock, self.repeats = clock, repeats

    def __call__(self, work: Callable[[], Any]) -> tuple[float, Any]:
        """Seconds, and what came out."""
        found, times = work(), []
        for _ in range(self.repeats):
            start = self.clock()
            found = work()
            times.append(self.clock() - start)
        return min(times), found


def transforms(backend: vf.contact.Backend, points: int, least: Stopwatch) -> dict[str, float]:
    """Seconds of a pair of FFTs, and of a padded convolution."""
    shape = (points, points)
    padded = (scipy.fft.next_fast_len(2 * points - 1), scipy.fft.next_fast_len(2 * points - 1, real=True))
    values = backend.asarray(np.random.default_rng(0).random(shape))
    spectrum = backend.transforms.forward_padded(values, padded)

    def pair() -> float:
        found = backend.transforms.inverse(backend.transforms.forward(values), shape)
        return float(found[0, 0])  # waits for the device

    def convolution() -> float:
        waves = backend.transforms.forward_padded(values, padded)
        waves *= spectrum
        return float(backend.transforms.inverse_cropped(waves, padded, shape)[0, 0])

    return {"FFT pair": least(pair)[0], "padded product": least(convolution)[0]}


def measure(name: str, points: int, least: Stopwatch) -> dict[str, Any]:
    """One row of the table."""
    backend = backend_of(name)
    surface = vf.contact.PeriodicSurface(self_affine(points), 1.0 / points)
    row: dict[str, Any] = {"backend": name, "points": points, **transforms(backend, points, least)}
    for what, speed, pressure in (("elastic", 0.0, 0.05), ("viscoelastic", 1.0, 0.1)):
        row[what], solution = least(
            lambda speed=speed, pressure=pressure: vf.solve_periodic(
                RUBBER, surface, speed=speed, pressure=pressure, backend=backend
            )
        )
        row["FFTs"] = row.get("FFTs", 0) + solution.diagnostics.ffts
    return row


def measure_ball(name: str, least: Stopwatch) -> dict[str, Any]:
    """Row of the ball."""
    backend, problem = backend_of(name), broad_spectrum_25(1.0)
    seconds, solution = least(lambda: problem.solve(accuracy=BALL_ACCURACY, backend=backend))
    diagnostics = solution.diagnostics
    return {"backend": name, "points": max(diagnostics.shape), "ball": seconds, "products": diagnostics.products}


def show(row: dict[str, Any], first: dict[str, Any], columns: tuple[str, ...], count: str) -> None:
    cells = (f"{1e3 * row[one]:11.2f} ({row[one] / first[one]:5.2f})" for one in columns)
    print(f"{row['points']:7} {row['backend']:12}" + "".join(f"{cell:>20}" for cell in cells) + f"{row[count]:10}")
    if abs(row[count] - first[count]) > 0.1 * first[count]:
        print(f"{row['backend']} takes another number of {count} than {first['backend']}", file=sys.stderr)


def table(
    names: list[str], row_of: Callable[[str], dict[str, Any]], columns: tuple[str, ...], count: str
) -> list[dict[str, Any]]:
    """Measure and show one row after the other."""
    rows: list[dict[str, Any]] = []
    for name in names:
        rows.append(row_of(name))
        show(rows[-1], rows[0], columns, count)
    return rows


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--backends", nargs="+", default=list(BACKENDS), help="the first is the measure of the others")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--clock", choices=["wall", "cpu"], default="wall", help="the second adds up threads")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    least = Stopwatch(time.perf_counter if options.clock == "wall" else time.process_time, options.repeats)
    present = []
    for name in options.backends:
        try:
            backend_of(name)
            present.append(name)
        except vf.InputError as error:
            print(f"left out: {error}")
    columns = ("FFT pair", "padded product", "elastic", "viscoelastic")
    print(f"ms of {'wall' if options.clock == 'wall' else 'CPU'} time, in brackets over that of {present[0]}")
    print(f"{'points':>7} {'backend':12}" + "".join(f"{column:>20}" for column in columns) + f"{'FFTs':>10}")
    rows = []
    for points in options.sizes:
        rows += table(present, lambda name, points=points: measure(name, points, least), columns, "FFTs")
    print(f"Ball, 25 modes, accuracy {BALL_ACCURACY:g}\n{'cells':>7} {'backend':12}{'whole solve':>20}{'products':>10}")
    rows += table(present, lambda name: measure_ball(name, least), ("ball",), "products")
    measuring.write_json(options.json, {"clock": options.clock, "rows": rows})


if __name__ == "__main__":
    main()
