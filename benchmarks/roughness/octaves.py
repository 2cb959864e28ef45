"""How Persson's theory and solved contacts differ with the number of octaves of roughness and with the contact area.

    python benchmarks/roughness/octaves.py --shortest 32 16 8 4 --seeds 3

The SYNTHETIC tread rubber at 20 °C and 0.4 MPa on generated self-affine surfaces: H = 0.8, period 256 µm, roll-off
64 µm.  Each shorter wavelength adds an octave to the same surfaces, whose rms slope grows; it is 0.3 with waves down to
2 µm.  Grids have eight points in the shortest wave, and 256² at least.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

import viscofric as vf

PERIOD, ROLLOFF, FINEST, SLOPE = 256e-6, 64e-6, 2e-6, 0.3
SPEEDS = (1e-6, 1e-3, 0.03, 1.0, 10.0)


def compare(shortest: float, seeds: int) -> list[dict[str, Any]]:
    """Return a row for each speed."""
    rubber = vf.catalogue_material("synthetic tread rubber")
    waves = {"rolloff": ROLLOFF, "shortest": shortest}
    all_waves = {"longest": PERIOD, "rolloff": ROLLOFF, "shortest": FINEST, "rms_slope": SLOPE}
    slope = float(vf.roughness.PowerSpectrum.self_affine(0.8, **all_waves).rms_slope(shortest=shortest))
    spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest=PERIOD, **waves, rms_slope=slope)
    points = max(256, round(8 * PERIOD / shortest))
    grid = {"shape": (points, points), "spacing": PERIOD / points, "rms_slope": slope}
    tracks = [vf.self_affine(0.8, **grid, **waves, seed=seed) for seed in range(seeds)]
    asked = {"speeds": SPEEDS, "temperatures": "20 degC", "pressure": "0.4 MPa"}
    solved = vf.predict_rough_friction(rubber, tracks, **asked)
    half, full = (vf.persson_theory(rubber, spectrum, **asked, gamma=gamma) for gamma in (0.5, 1.0))
    return [
        {
            "shortest": shortest,
            "slope": slope,
            "speed": speed,
            "area": float(solved.mean_area[0, place]),
            "friction": float(solved.mean_friction_coefficient[0, place]),
            "grid": float(np.mean(solved.friction_error[0, place]) / solved.mean_friction_coefficient[0, place]),
            "area_ratio": float(half.contact_area_fraction[0, place] / solved.mean_area[0, place]),
            "half_ratio": float(half.friction_coefficient[0, place] / solved.mean_friction_coefficient[0, place]),
            "full_ratio": float(full.friction_coefficient[0, place] / solved.mean_friction_coefficient[0, place]),
        }
        for place, speed in enumerate(SPEEDS)
    ]


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shortest", type=float, nargs="+", default=[32.0, 16.0, 8.0, 4.0], help="wavelengths, µm")
    parser.add_argument("--seeds", type=int, default=3, help="surfaces (default 3)")
    parser.add_argument("--json", type=Path, help="file for the numbers")
    asked = parser.parse_args(arguments)
    rows = []
    print("shortest  slope  speed     A/A0    μ       grid    theory over solution: A, μ (γ = ½), μ (γ = 1)")
    for micrometres in asked.shortest:
        for row in compare(1e-6 * micrometres, asked.seeds):
            rows.append(row)
            print(
                f"{micrometres:5g} µm  {row['slope']:5.3f}  {row['speed']:5.0e}  {row['area']:7.4f}  "
                f"{row['friction']:6.4f}  {100 * row['grid']:4.1f} %  {row['area_ratio']:5.2f}  "
                f"{row['half_ratio']:5.2f}  {row['full_ratio']:5.2f}",
                flush=True,
            )
    if asked.json:
        asked.json.write_text(json.dumps({"rows": rows}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
