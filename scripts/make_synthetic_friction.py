"""Make tests/data/synthetic_friction_curves.csv: friction of the synthetic fluoroelastomer, whose curves overlap.

Nothing in it is measured.  At the nine temperatures neighbouring curves overlap in reduced speed, so that the shift
factors can be found from them alone.  90 contacts solved to 1e-4, some minutes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import viscofric as vf

PATH = Path(__file__).resolve().parent.parent / "tests" / "data" / "synthetic_friction_curves.csv"
SPEEDS = np.geomspace(0.02, 0.2, 10)  # m/s
TEMPERATURES = ("30 degC", "35 degC", "40 degC", "46 degC", "52 degC", "60 degC", "68 degC", "78 degC", "90 degC")
BALL_RADIUS = 9.525e-3  # m
LOAD = 25.0  # N
ACCURACY = 1e-4


def main() -> None:
    """Solve the contacts and write their friction."""
    curves = vf.predict_friction(
        vf.synthetic_fluoroelastomer(),
        vf.Ball(radius=BALL_RADIUS),
        speeds=SPEEDS,
        temperatures=TEMPERATURES,
        load=LOAD,
        accuracy=ACCURACY,
        progress=lambda done, total: print(f"{done} of {total} contacts", flush=True),
    )
    lines = [
        f"# SYNTHETIC: friction of the assumed material synthetic_fluoroelastomer, solved to {ACCURACY:g}; a ball of",
        f"# radius {1e3 * BALL_RADIUS:g} mm under {LOAD:g} N.  Made by scripts/make_synthetic_friction.py.",
        "temperature (K),speed (m/s),friction,error estimate",
    ]
    for row in range(len(curves)):
        friction, error = curves.viscoelastic[row], curves.viscoelastic_error[row]
        lines.append(f"{curves.temperature[row]:.2f},{curves.speed[row]:.17g},{friction:.8g},{error:.2g}")
    PATH.parent.mkdir(parents=True, exist_ok=True)
    PATH.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
