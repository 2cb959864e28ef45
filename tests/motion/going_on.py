"""Runs that are interrupted and go on, and what they are compared in."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf

RUBBER = vf.Material(vf.RetardationSpectrum("1 MPa", "10 MPa", [3e-7, 3e-7, 3e-7], [1e-3, 1e-2, 1.0]))
BALL = vf.Ball("10 mm")


def broad_rubber() -> vf.Material:
    """Return a rubber of 40 modes over 16 decades, of which each history merges those that it does not resolve."""
    tau = np.geomspace(1e-9, 1e7, 40)
    return vf.Material(vf.RetardationSpectrum("1 MPa", "20 MPa", tau**0.1 / (tau**0.1).sum() * 9.5e-7, tau))


def stopped_after(count: int):
    """Return a callback that interrupts the run after so many steps."""
    calls: list[float] = []

    def stop(reached: float, end: float) -> None:
        calls.append(reached)
        if len(calls) == count:
            raise KeyboardInterrupt

    return stop


def same(one: vf.motion.TransientSolution, two: vf.motion.TransientSolution, rel: float = 1e-12) -> None:
    """Both took the same steps: equal but for rounding."""
    assert one.time.tolist() == two.time.tolist()
    for name in ("load", "indentation", "friction_force", "contact_area", "work", "stored", "dissipated"):
        wanted = getattr(two, name)
        assert getattr(one, name) == pytest.approx(wanted, rel=rel, abs=rel * float(np.abs(wanted).max())), name
    for name, scale in (("energy", two.work), ("friction_force", two.load)):
        error, wanted = getattr(one.errors, name), getattr(two.errors, name)
        assert error == pytest.approx(wanted, rel=1e-6, abs=1e-12 * float(np.abs(scale).max())), name
    assert (one.steps, one.interrupted) == (two.steps, False)
