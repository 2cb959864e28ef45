"""Rough periodic contact beside its peers, on the same surfaces and in the same run.

Usage: python benchmarks/contact/rough.py [--sizes 512 1024] [--peers [FOLDER]] [--tools tamaas] [--limit SECONDS]
       [--json FILE]

Elastic: E* = 1, H = 0.8, eight points per shortest wave, rms slope 1, mean pressure 0.05, complementarity 1e-8 of the
rms height.  Viscoelastic (viscofric alone): the same surface, 20 modes over five decades, E_inf/E0 = 100.
FOLDER is a virtual environment with ContactMechanics and tamaas in it, by default the one that make_peers.sh makes;
each of them may be missing.  ContactMechanics' dual conjugate gradients solve for a given displacement: they are given
that of viscofric's solution.  What every tool leaves of gap and overlap is measured here, from its pressures.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import numpy as np
import others
import problems

import viscofric as vf
from viscofric.contact.periodic.operator import PeriodicOperator
from viscofric.contact.periodic.transfer import SlidingSolid

COLUMNS = (
    ("CPU s", "seconds", ".3f"),
    ("ratio", "ratio", ".3f"),
    ("FFT pairs", "fft_pairs", ".1f"),
    ("steps", "iterations", "d"),
    ("FFTs", "ffts", "d"),
    ("area", "area", ".4f"),
    ("residual", "residual", ".1e"),
)


def own(
    surface: vf.contact.PeriodicSurface, *, viscoelastic: bool
) -> tuple[dict[str, Any], vf.contact.PeriodicSolution]:
    """Solve with viscofric."""
    solve = problems.viscoelastic_rough if viscoelastic else problems.elastic_rough
    solution, seconds = measuring.cpu_seconds(lambda: solve(surface))
    diagnostics = solution.diagnostics
    row = {
        "case": "viscofric, viscoelastic" if viscoelastic else "viscofric, elastic",
        "points": surface.shape[0],
        "seconds": seconds,
        "fft_pairs": seconds / measuring.seconds_per_pair(surface.shape),
        "iterations": diagnostics.linear_iterations + diagnostics.splitting_steps,
        "ffts": diagnostics.ffts,
        "single_ffts": diagnostics.single_ffts,
        "area": solution.contact_area_fraction,
        "residual": diagnostics.complementarity,
        "friction": solution.friction_coefficient,
    }
    return row, solution


def peer(
    tool: str,
    surface: vf.contact.PeriodicSurface,
    solution: vf.contact.PeriodicSolution,
    environment: Path,
    limit: float,
) -> list[dict[str, Any]]:
    """Have a peer solve the elastic contact in its environment; one row for each of its solvers."""
    given = {
        "boundary": "periodic",
        "size": surface.period,
        "pressure": problems.PRESSURE,
        # How deep the surface lies where its displacements are counted from their mean.
        "level": solution.indentation - float(surface.z.max()),
        "tolerance": problems.TOLERANCE,
    }
    points = surface.shape[0]
    try:
        answers = others.ask(tool, given, surface.z, others.python_of(environment), limit)
    except others.PeerError as error:
        return [{"case": tool, "points": points, "error": str(error)}]
    return [
        {
            "case": row.pop("tool"),
            "points": points,
            **row,
            "area": float((arrays["pressure"] > 0.0).mean()),
            "residual": residual(arrays["pressure"], surface),
            "mean_pressure": float(arrays["pressure"].mean()),
        }
        for row, arrays in answers
    ]


def residual(pressure: np.ndarray, surface: vf.contact.PeriodicSurface) -> float:
    """Largest gap under pressure, or overlap without it, over the rms height."""
    solid = SlidingSolid(problems.ELASTIC.spectrum, 0.0, (0.0, 0.0))
    operator = PeriodicOperator(solid.transfer(surface.shape, surface.spacing), surface.shape)
    gap = operator(pressure) - surface.z
    loaded = pressure > 0.0
    gap -= gap[loaded].mean()
    return max(float(np.abs(gap[loaded]).max()), -float(gap.min())) / surface.rms_height


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument(
        "--peers", type=Path, nargs="?", const=others.DEFAULT_ENVIRONMENT, help="run the peers too, from this folder"
    )
    parser.add_argument("--tools", nargs="+", choices=others.TOOLS, default=others.TOOLS, help="which of the peers")
    parser.add_argument("--limit", type=float, default=900.0, help="seconds for each peer and size")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    own(problems.rough_surface(64), viscoelastic=True)  # imports
    rows: list[dict[str, Any]] = []
    for points in options.sizes:
        surface = problems.rough_surface(points)
        elastic, solution = own(surface, viscoelastic=False)
        these = [elastic, own(surface, viscoelastic=True)[0]]
        if options.peers:
            for tool in options.tools:
                these += peer(tool, surface, solution, options.peers, options.limit)
        for row in these:
            if "seconds" in row:
                row["ratio"] = row["seconds"] / elastic["seconds"]
        rows += these
        title = f"rough periodic contact, {points} x {points}; ratio: to viscofric's elastic one"
        measuring.print_table(title, these, COLUMNS)
        measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
