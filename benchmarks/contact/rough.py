"""Rough periodic contact beside its peers, on the same surfaces and in the same run.

Usage: python benchmarks/contact/rough.py [--sizes 512 1024] [--peers FOLDER] [--json FILE] [--limit SECONDS]

Elastic: E* = 1, H = 0.8, eight points per shortest wave, rms slope 1, mean pressure 0.05, complementarity 1e-8 of the
rms height.  Viscoelastic (viscofric alone): the same surface, 20 modes over five decades, E_inf/E0 = 100.
FOLDER is a virtual environment with ContactMechanics and tamaas in it, each of which may be missing.  ContactMechanics'
dual conjugate gradients solve for a given displacement: they are given that of viscofric's solution.  What every
tool leaves of gap and overlap is measured here, from its pressures.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests"))

import numpy as np  # noqa: E402

import viscofric as vf  # noqa: E402
from contact.made_surfaces import self_affine  # noqa: E402
from viscofric.contact.periodic.operator import PeriodicOperator  # noqa: E402
from viscofric.contact.periodic.solve import solve_periodic  # noqa: E402
from viscofric.contact.periodic.surface import PeriodicSurface  # noqa: E402
from viscofric.contact.periodic.transfer import SlidingSolid  # noqa: E402

PRESSURE = 0.05
VISCOELASTIC_PRESSURE = 0.1
TOLERANCE = 1e-8
PEERS = ("contact_mechanics", "tamaas")
ELASTIC = vf.Material(vf.RetardationSpectrum(1.0, 2.0, [0.5], [1.0]), poisson_ratio=0.0)
VISCOELASTIC = vf.Material(
    vf.RetardationSpectrum(1.0, 100.0, np.full(20, 0.99 / 20), np.logspace(-4, 1, 20)), poisson_ratio=0.0
)


def own(points: int, *, viscoelastic: bool) -> tuple[dict[str, Any], PeriodicSurface, vf.ContactSolution | Any]:
    """Solve with viscofric; the row, the surface and the solution."""
    surface = PeriodicSurface(self_affine(points), 1.0 / points)
    material, speed, pressure = (VISCOELASTIC, 1.0, VISCOELASTIC_PRESSURE) if viscoelastic else (ELASTIC, 0.0, PRESSURE)
    start = time.process_time()
    solution = solve_periodic(material, surface, speed=speed, pressure=pressure, tolerance=TOLERANCE)
    seconds = time.process_time() - start
    diagnostics = solution.diagnostics
    row = {
        "tool": "viscofric, viscoelastic" if viscoelastic else "viscofric",
        "points": points,
        "seconds": seconds,
        "iterations": diagnostics.linear_iterations + diagnostics.splitting_steps,
        "ffts": diagnostics.ffts,
        "single_ffts": diagnostics.single_ffts,
        "area": solution.contact_area_fraction,
        "residual": diagnostics.complementarity,
        "friction": solution.friction_coefficient,
    }
    return row, surface, solution


def peer(name: str, surface: PeriodicSurface, solution: Any, environment: Path, limit: float) -> list[dict[str, Any]]:
    """Have a peer solve the elastic contact in its environment; one row for each of its solvers."""
    points = surface.shape[0]
    python = environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    with tempfile.TemporaryDirectory() as folder:
        np.save(Path(folder) / "heights.npy", surface.z)
        # How deep the surface lies where its displacements are counted from their mean.
        given = {"pressure": PRESSURE, "level": solution.indentation - float(surface.z.max()), "tolerance": TOLERANCE}
        (Path(folder) / "given.json").write_text(json.dumps(given), encoding="utf-8")
        command = [str(python), str(HERE / "peers" / f"with_{name}.py"), folder]
        settings = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        try:
            done = subprocess.run(
                command, env={**os.environ, **settings}, capture_output=True, text=True, timeout=limit, check=False
            )
        except (subprocess.TimeoutExpired, OSError) as error:
            return [{"tool": name, "points": points, "error": type(error).__name__}]
        if done.returncode:
            reason = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1][:120]
            return [{"tool": name, "points": points, "error": reason}]
        rows = json.loads((Path(folder) / "answer.json").read_text(encoding="utf-8"))
        for row in rows:
            pressure = np.load(Path(folder) / row.pop("pressures"))
            row |= {"points": points, "area": float((pressure > 0.0).mean())}
            row |= {"residual": residual(pressure, surface), "mean_pressure": float(pressure.mean())}
    return rows


def residual(pressure: np.ndarray, surface: PeriodicSurface) -> float:
    """Largest gap under pressure, or overlap without it, over the rms height."""
    solid = SlidingSolid(ELASTIC.spectrum, 0.0, (0.0, 0.0))
    operator = PeriodicOperator(solid.transfer(surface.shape, surface.spacing), surface.shape)
    gap = operator(pressure) - surface.z
    loaded = pressure > 0.0
    gap -= gap[loaded].mean()
    return max(float(np.abs(gap[loaded]).max()), -float(gap.min())) / surface.rms_height


def show(rows: list[dict[str, Any]]) -> None:
    print(f"{'':46}{'points':>7}{'CPU s':>9}{'ratio':>8}{'steps':>7}{'FFTs':>7}{'area':>8}{'residual':>10}")
    for row in rows:
        if "error" in row:
            print(f"{row['tool']:46}{row['points']:7}  {row['error']}")
            continue
        print(
            f"{row['tool']:46}{row['points']:7}{row['seconds']:9.3f}{row['ratio']:8.3f}{row.get('iterations', '–'):>7}"
            f"{row.get('ffts', '–'):>7}{row['area']:8.4f}{row['residual']:10.1e}"
        )


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--peers", type=Path, help="virtual environment with ContactMechanics and tamaas")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--limit", type=float, default=900.0, help="seconds for each peer and size")
    options = parser.parse_args(arguments)
    own(64, viscoelastic=True)  # imports
    rows: list[dict[str, Any]] = []
    for points in options.sizes:
        elastic, surface, solution = own(points, viscoelastic=False)
        these = [elastic, own(points, viscoelastic=True)[0]]
        if options.peers:
            for name in PEERS:
                these += peer(name, surface, solution, options.peers, options.limit)
        for row in these:
            if "seconds" in row:
                row["ratio"] = row["seconds"] / elastic["seconds"]
        rows += these
    print("CPU time; ratio: to viscofric's elastic contact of the same size")
    show(rows)
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(rows, indent=1, ensure_ascii=False), encoding="utf-8")


if __name__ == "__main__":
    main()
