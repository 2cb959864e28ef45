"""How much work random rough contacts take, from easy to nearly impossible ones: FFTs on the finest grid.

Usage: python benchmarks/contact/random_rough.py [--contacts 200] [--seed 8] [--json FILE]

64² to 256² points; 1 to 24 modes at random over seven decades, E_inf/E0 from 2 to 1e4; Hurst exponents from 0.3 to 1, 3
to 16 points in the shortest wave; speeds over six decades, loads over four, along x or any direction; one in five on a
layer, every other one on oblong cells.  A contact that is not solved is counted, not left out.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any, NamedTuple

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
from collections.abc import Sequence

import measuring
import numpy as np
import problems  # noqa: F401  (where the tests' surfaces are found)

import viscofric as vf
from contact.made_surfaces import self_affine

COLUMNS = (
    ("contacts", "contacts", "d"),
    ("not solved", "failed", "d"),
    ("CPU s", "seconds", ".1f"),
    ("median", "median", ".0f"),
    ("90 %", "most", ".0f"),
    ("largest", "largest", ".0f"),
    ("over 1000", "over", "d"),
    ("all FFTs", "total", "d"),
)


class Contact(NamedTuple):
    """A rubber, a surface and its shortest wave in points, and how one slides over the other."""

    material: vf.Material
    heights: np.ndarray
    spacing: tuple[float, float]
    shortest: float
    motion: dict[str, Any]

    @property
    def surface(self) -> vf.contact.PeriodicSurface:
        """The surface of its heights."""
        return vf.contact.PeriodicSurface(self.heights, self.spacing)


def draw(random: np.random.Generator, seed: int, sizes: Sequence[int] = (64, 96, 128, 192, 256)) -> Contact:
    """Draw a contact on a surface with one of some numbers of points along each axis."""
    points, modes = int(random.choice(sizes)), int(random.integers(1, 25))
    ratio = 10.0 ** random.uniform(0.3, 4.0)
    tau = 10.0 ** np.sort(random.uniform(-5.0, 2.0, modes))
    shares = random.dirichlet(np.ones(modes))
    rubber = vf.Material(vf.RetardationSpectrum(1.0, ratio, shares * (1.0 - 1.0 / ratio), tau), poisson_ratio=0.5)
    hurst, shortest = random.uniform(0.3, 1.0), float(random.choice([3.0, 4.0, 8.0, 16.0]))
    z = self_affine(points, seed=seed, hurst=hurst, points_per_shortest_wave=shortest)
    angle = random.choice([0.0, 0.0, random.uniform(0.0, 2.0 * np.pi)])
    motion: dict[str, Any] = {
        "speed": 10.0 ** random.uniform(-2.0, 4.0),
        "pressure": 10.0 ** random.uniform(-3.0, 1.0),
        "direction": (np.cos(angle), np.sin(angle)),
        "layer": vf.Layer(thickness=10.0 ** random.uniform(-2.0, 0.0)) if random.random() < 0.2 else None,
    }
    return Contact(rubber, z, (1.0 / points, random.choice([1.0, 0.7]) / points), shortest, motion)


def measure(contacts: int, seed: int) -> dict[str, Any]:
    """Solve random contacts; return counts of their FFTs on the finest grid."""
    random = np.random.default_rng(seed)
    ffts, failed, spent = [], 0, 0.0
    for number in range(contacts):
        drawn = draw(random, number)
        material, surface, motion = drawn.material, drawn.surface, drawn.motion
        try:
            solution, seconds = measuring.cpu_seconds(lambda: vf.solve_periodic(material, surface, **motion))  # noqa: B023
        except vf.ConvergenceError:
            failed += 1
            continue
        ffts.append(solution.diagnostics.ffts)
        spent += seconds
    counts = np.array(ffts)
    return {
        "case": f"seed {seed}", "contacts": contacts, "failed": failed, "seconds": spent,
        "median": float(np.median(counts)), "most": float(np.quantile(counts, 0.9)), "largest": float(counts.max()),
        "over": int((counts > 1000).sum()), "total": int(counts.sum()),
    }  # fmt: skip


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--contacts", type=int, default=200)
    parser.add_argument("--seed", type=int, default=8)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    row = measure(options.contacts, options.seed)
    measuring.print_table("FFTs on the finest grid of random rough contacts", [row], COLUMNS)
    measuring.write_json(options.json, {"rows": [row]})


if __name__ == "__main__":
    main()
