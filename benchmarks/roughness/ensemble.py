"""Friction on an ensemble of rough surfaces: CPU seconds, and Persson's theory on the same spectrum beside it.

Usage: python benchmarks/roughness/ensemble.py [--points 512] [--speeds 12] [--seeds 8] [--workers 2]

The synthetic fluoroelastomer at 30 °C and 50 kPa on made self-affine surfaces: H = 0.8, period 1.024 mm, roll-off
0.25 mm, eight points in the shortest wave, rms slope 0.2.  CPU seconds are those of this process and of its workers.
"""

from __future__ import annotations

import argparse
import os
import time

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
import numpy as np

import viscofric as vf

PERIOD, ROLLOFF, SLOPE = 1.024e-3, 0.25e-3, 0.2


def cpu_seconds() -> float:
    spent = os.times()
    return spent.user + spent.system + spent.children_user + spent.children_system


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, value in (("points", 512), ("speeds", 12), ("seeds", 8), ("workers", 2)):
        parser.add_argument(f"--{name}", type=int, default=value)
    asked = parser.parse_args(arguments)
    rubber = vf.synthetic_fluoroelastomer()
    waves = {"longest": PERIOD, "rolloff": ROLLOFF, "shortest": 8.0 * PERIOD / asked.points, "rms_slope": SLOPE}
    grid = {"shape": (asked.points, asked.points), "spacing": PERIOD / asked.points}
    speeds = np.geomspace(1e-4, 10.0, asked.speeds)
    where = {"speeds": speeds, "temperatures": "30 degC", "pressure": "50 kPa"}
    cpu, wall = cpu_seconds(), time.perf_counter()
    roads = [vf.self_affine(0.8, **grid, **waves, seed=seed) for seed in range(asked.seeds)]
    found = vf.predict_rough_friction(rubber, roads, **where, workers=asked.workers)
    cpu, wall = cpu_seconds() - cpu, time.perf_counter() - wall
    contacts = asked.speeds * asked.seeds
    print(f"{contacts} contacts of {asked.points}² points: {cpu:.1f} s CPU ({cpu / contacts:.2f} s each), {wall:.1f} s")
    cpu = cpu_seconds()
    theory = vf.persson_theory(rubber, vf.roughness.PowerSpectrum.self_affine(0.8, **waves), **where)
    print(f"Persson's theory at {asked.speeds} speeds: {cpu_seconds() - cpu:.2f} s CPU")
    print("speed (m/s)   solved   theory  area solved   theory  stretch")
    for place, speed in enumerate(speeds):
        print(
            f"{speed:11.3g} {found.mean_friction_coefficient[0, place]:8.4f} "
            f"{theory.friction_coefficient[0, place]:8.4f} "
            f"{found.mean_area[0, place]:12.4f} {theory.contact_area_fraction[0, place]:8.4f} "
            f"{found.stretch[0, place].mean():8.3f}"
        )


if __name__ == "__main__":
    main()
