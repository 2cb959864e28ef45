"""The ball of Carbone and Putignano, Fig. 12, at the three speeds of slippy's test: friction, stated error, CPU time.

Usage: python benchmarks/contact/sliding_ball.py

slippy's `ViscoElasticSliding` is newer than its latest release on PyPI (0.5.2), so that it cannot be installed here.
Its test (slippy/contact/tests/test_viscoelastic_sliding.py in FrictionTribologyEnigma/slippy) prints no friction; it
requires the tolerances of the table, on 255² points over 6 mm and, at the highest speed, 511² over 12 mm.
"""

from __future__ import annotations

import os
import time

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
import viscofric as vf
from viscofric.contact.reference import hertz_ball
from viscofric.verification.published.contacts import BALL_LOAD, BALL_POINTS, BALL_RADIUS, BALL_TAU


def rows(accuracy: float = 1e-3) -> list[tuple[float, float, float, float, float, float]]:
    """Return vτ/a0, published μ, slippy's tolerance, μ, its stated error, and CPU seconds."""
    material = vf.Material.standard_linear_solid(1e6, 1e7, BALL_TAU, 0.3)
    a0 = hertz_ball(BALL_LOAD, BALL_RADIUS, 1e6, 0.3).radius
    found = []
    for memory, published, tolerance in BALL_POINTS:
        began = time.process_time()
        solution = vf.solve_steady(
            material, vf.Ball(BALL_RADIUS), speed=memory * a0 / BALL_TAU, load=BALL_LOAD, accuracy=accuracy
        )
        seconds = time.process_time() - began
        friction = solution.friction_coefficient
        found.append((memory, published, tolerance, friction, solution.diagnostics.friction_error, seconds))
    return found


def main() -> None:
    rows()  # the first call imports and plans
    print(f"{'vτ/a0':>8} {'published':>10} {'slippy within':>14} {'viscofric':>10} {'± error':>9} {'CPU s':>7}")
    for memory, published, tolerance, friction, error, seconds in rows():
        print(f"{memory:8.4g} {published:10.5f} {tolerance:14.0%} {friction:10.5f} {error:9.1e} {seconds:7.3f}")


if __name__ == "__main__":
    main()
