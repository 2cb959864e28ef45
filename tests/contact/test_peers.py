"""Elastic contacts beside other programs, where they are installed: the same cells, the same load.

ContactMechanics and Tamaas are looked for in this process's Python, then in the one that VISCOFRIC_PEERS names (a
virtual environment or its interpreter), then in what `benchmarks/contact/make_peers.sh` makes.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import viscofric as vf
from contact.made_surfaces import self_affine

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

BENCHMARKS = Path(__file__).resolve().parents[2] / "benchmarks" / "contact"
MODULES = {"contact_mechanics": "ContactMechanics", "tamaas": "tamaas"}
TOOLS = [pytest.param("contact_mechanics", marks=pytest.mark.slow), "tamaas"]  # the one takes seconds to import
TOLERANCE = 1e-10
ELASTIC = vf.Material(vf.RetardationSpectrum(1.0, 2.0, [0.5], [1.0]), poisson_ratio=0.0)  # E* = 1 at rest


def load_others() -> Any:
    spec = importlib.util.spec_from_file_location("contact_peers", BENCHMARKS / "others.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


others = load_others()


@cache
def python_with(module: str) -> Path | None:
    """Return an interpreter that has a module."""
    if importlib.util.find_spec(module) is not None:
        return Path(sys.executable)
    named = os.environ.get("VISCOFRIC_PEERS")
    for place in ([Path(named)] if named else []) + [others.DEFAULT_ENVIRONMENT]:
        python = place if place.is_file() else others.python_of(place)
        has_it = f"import importlib.util, sys; sys.exit(importlib.util.find_spec({module!r}) is None)"
        if python.is_file() and subprocess.run([str(python), "-c", has_it], check=False).returncode == 0:
            return python
    return None


def answer_of(tool: str, given: dict[str, Any], heights: Array) -> dict[str, Array]:
    python = python_with(MODULES[tool])
    if python is None:
        pytest.skip(
            f"{MODULES[tool]} is not installed: make it with benchmarks/contact/make_peers.sh, or name a Python "
            "that has it in VISCOFRIC_PEERS"
        )
    ((_, arrays),) = others.ask(tool, given, heights, python, 100.0)
    return arrays


def test_peers_that_are_named_but_not_there_are_reported() -> None:
    with pytest.raises(others.PeerError, match=r"make_peers\.sh"):
        others.ask("tamaas", {}, np.zeros((2, 2)), Path("no such python"), 1.0)


@pytest.mark.parametrize("tool", TOOLS)
def test_hertz_contact_on_a_free_half_space_is_that_of_other_programs(tool: str) -> None:
    radius, load = 1.0, 4.0 / 3.0 * 0.1**3  # a0 = 0.1
    ball = vf.Ball(radius=radius)
    ours = vf.solve_steady(ELASTIC, ball, speed=0.0, load=load, tolerance=TOLERANCE, accuracy=1e-3)
    cell = ours.diagnostics.spacing
    height = (ours.x[:, None] ** 2 + ours.y**2) / (2.0 * radius)
    size = [cell * cells for cells in ours.pressure.shape]
    given = {"boundary": "free", "size": size, "load": load, "tolerance": TOLERANCE}
    theirs = answer_of(tool, given, -height)
    # The same cells, the same rectangle integrals and load: what is left is both solvers' tolerance, 1e-10 of a depth,
    # which the stiffest waves of the grid turn into a hundred times more of the pressure.
    assert np.abs(theirs["pressure"] - ours.pressure).max() < 1e-7 * ours.max_pressure
    assert np.count_nonzero(theirs["pressure"] > 0.0) == np.count_nonzero(ours.pressure)
    gap = ours.displacement + height - ours.indentation
    assert np.abs(theirs["gap"] - gap).max() < 1e-8 * ours.indentation


@pytest.mark.parametrize("tool", TOOLS)
def test_rough_periodic_contact_is_that_of_other_programs(tool: str) -> None:
    surface = vf.contact.PeriodicSurface(self_affine(64, seed=3), 1.0 / 64)
    ours = vf.solve_periodic(ELASTIC, surface, speed=0.0, pressure=0.1, tolerance=TOLERANCE)
    given = {
        "boundary": "periodic",
        "size": surface.period,
        "pressure": 0.1,
        "level": ours.indentation - float(surface.z.max()),
        "tolerance": TOLERANCE,
    }
    theirs = answer_of(tool, given, surface.z)
    # All take 2/(E* q) for each wave of the grid: what is left is both solvers' tolerance, as above.
    assert 0.1 < ours.contact_area_fraction < 0.5
    assert np.abs(theirs["pressure"] - ours.pressure).max() < 1e-7 * ours.max_pressure
    assert np.mean(theirs["pressure"] > 0.0) == ours.contact_area_fraction
    assert np.abs(theirs["gap"] - ours.gap).max() < 1e-8 * surface.rms_height
    assert theirs["pressure"].mean() == pytest.approx(0.1, rel=1e-8)
