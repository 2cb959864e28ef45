"""Heat that earlier passes leave on a circular track, against moving point sources and the steady ring."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.heat import track

RUBBER = vf.ThermalProperties(0.3, 1200.0, 1500.0, "rubber")
RING, SPEED = 0.023, 0.1
PERIOD = 2.0 * np.pi * RING / SPEED


def rise(passes: Any, **settings: Any) -> np.ndarray:
    given = {"radius": 1e-3, "track_radius": RING, "speed": SPEED, **settings}
    return vf.heat.track_temperature(0.1, RUBBER, passes=passes, **given)


def test_passes_equal_a_point_that_runs_along_the_circle() -> None:
    """Instantaneous point sources, Q dt/(4ρc (πκt)^3/2) exp(−c²/4κt) at the chord c; a pass takes 1e-4 of its age."""
    kappa, node, weight = RUBBER.diffusivity, *np.polynomial.legendre.leggauss(200)
    expected = 0.0
    for n in range(1, 41):
        half = 8.0 * np.sqrt(4.0 * kappa * n * PERIOD) / SPEED
        t = n * PERIOD + half * node
        chord = 2.0 * RING * np.sin(0.5 * SPEED * t / RING)
        left = np.exp(-np.square(chord) / (4.0 * kappa * t)) / (4.0 * RUBBER.volume_heat * (np.pi * kappa * t) ** 1.5)
        expected += 0.1 * half * float(weight @ left)
    assert rise([40], radius=1e-6)[0] == pytest.approx(expected, rel=1e-4)


def test_many_passes_are_summed_as_each_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """The integral over passes from 64 on errs by 1/(24 · 64²) of one pass."""
    counts = [0, 1, 63, 64, 65, 66, 3000]
    found = rise(counts)
    assert found[0] == 0.0
    assert np.all(np.diff(found) > 0.0)
    monkeypatch.setattr(track, "_ONE_BY_ONE", 3000)
    assert found == pytest.approx(rise(counts), rel=5e-6)


def test_a_track_ends_at_the_steady_ring() -> None:
    """The rise of a thin steady ring grows as Q/(2π²Rk) ln(R/a); relative deviations are of the order (a/R)²."""
    wide, narrow = rise([math.inf], radius=2e-3), rise([math.inf], radius=1e-3)
    assert narrow > wide
    fast = {"speed": 1e4, "radius": 1e-3}  # a ring without turns
    difference = rise([math.inf], **fast) - rise([math.inf], **fast | {"radius": 2e-3})
    assert difference[0] == pytest.approx(0.1 / (2.0 * np.pi**2 * RING * 0.3) * math.log(2.0), rel=2e-3)
    # The mean of ln d between two places distributed as the chords of a disc is −1/4 − ln 2: Wigner's semicircle.
    even = rise([math.inf], **fast, distribution="uniform")
    ring = 0.1 / (2.0 * np.pi**2 * RING * 0.3) * (math.log(8.0 * RING / 1e-3) + 0.25 + math.log(2.0))
    assert even[0] == pytest.approx(ring, rel=2e-3)
    assert rise([1e14])[0] == pytest.approx(narrow[0], rel=1e-5)


def test_layers_hold_the_heat_or_let_it_go() -> None:
    """A base that passes no heat keeps it in the plate, one at constant temperature takes it."""
    thick = rise([10, 1000])
    assert rise([10, 1000], thickness=10.0) == pytest.approx(thick, rel=1e-12)
    sink, held = (rise([10, 1000], thickness=5e-3, base=base) for base in ("isothermal", "insulated"))
    assert sink[1] < thick[1] < held[1]
    assert rise([10_000, math.inf], thickness=5e-3)[1] == pytest.approx(rise([10_000], thickness=5e-3)[0], rel=1e-6)
    with refused("no-steady-state"):
        rise([math.inf], thickness=5e-3, base="insulated")


@pytest.mark.parametrize("given", [{"passes": [0.5]}, {"passes": [-1]}, {"passes": [1], "radius": 0.01}])
def test_what_the_formula_does_not_describe_is_refused(given: dict[str, Any]) -> None:
    with refused("out-of-range"):
        rise(given.pop("passes"), **given)
