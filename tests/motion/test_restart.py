"""Runs that go on from a stored state: the numbers are those of one run without a pause."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from motion.going_on import BALL, RUBBER, broad_rubber, same, stopped_after
from refusals import refused
from viscofric.errors import DataFileError

WHOLE = vf.motion.History([0.0, 0.02, 0.02, 0.04], load=[0.0, 1.0, 0.5, 0.2])
X = 2.0 * np.pi * np.arange(24) / 24.0
WAVE = vf.contact.PeriodicSurface(1e-6 * (np.cos(X) + 0.3 * np.cos(2.0 * X + 1.0)), 1e-3 / 24.0)
SLIDING = vf.motion.History([0.0, 2e-3, 2e-3, 5e-3], pressure=1e3, speed=[0.0, 0.0, 0.05, 0.05])


@pytest.mark.parametrize(
    ("steps", "times"), [(1, None), (17, [0.0, 0.01, 0.02, 0.02, 0.03, 0.04]), (43, None), (30, [0.03, 0.04])]
)
def test_an_interrupted_run_of_springs_goes_on_from_a_file(tmp_path: Path, steps: int, times: list[float] | None):
    whole = vf.motion.solve_transient(RUBBER, BALL, WHOLE, times=times)
    part = vf.motion.solve_transient(RUBBER, BALL, WHOLE, times=times, progress=stopped_after(steps))
    assert part.interrupted
    part.save_state(tmp_path / "part.npz")
    again = vf.motion.solve_transient(RUBBER, BALL, WHOLE, times=times, resume=tmp_path / "part.npz")
    same(again, whole)
    assert again.pressure_at(0.04).values == pytest.approx(whole.pressure_at(0.04).values)


def test_a_jump_is_taken_once_where_a_run_is_interrupted_within_its_rounding():
    """Ten days after the start, times closer to the jump than 1e-10 s are those of the jump."""
    rubber = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ns")
    history = vf.motion.History([0.0, 1e6, 1e6, 1e6 + 1e-6], load=[1.0, 1.0, 2.0, 2.0])
    late: list[float] = []

    def stop(reached: float, end: float) -> None:
        late.extend([reached] if reached >= 1e6 else [])
        if len(late) == 2:
            raise KeyboardInterrupt

    begun = vf.motion.solve_transient(rubber, BALL, history, progress=stop)
    assert begun.interrupted
    assert late[-1] == 1e6
    same(
        vf.motion.solve_transient(rubber, BALL, history, resume=begun), vf.motion.solve_transient(rubber, BALL, history)
    )


def test_an_interruption_at_a_kink_loses_nothing():
    """The last step before the jump is the one that is interrupted."""
    reached: list[float] = []
    whole = vf.motion.solve_transient(RUBBER, BALL, WHOLE, progress=lambda now, end: reached.append(now))
    part = vf.motion.solve_transient(RUBBER, BALL, WHOLE, progress=stopped_after(reached.index(0.02) + 1))
    same(vf.motion.solve_transient(RUBBER, BALL, WHOLE, resume=part), whole)


def test_an_interrupted_run_of_waves_goes_on_from_a_file(tmp_path: Path):
    whole = vf.motion.solve_transient(RUBBER, WAVE, SLIDING, accuracy=1e-2)
    part = vf.motion.solve_transient(RUBBER, WAVE, SLIDING, accuracy=1e-2, progress=stopped_after(whole.steps // 2))
    part.save_state(tmp_path / "part.npz")
    same(vf.motion.solve_transient(RUBBER, WAVE, SLIDING, accuracy=1e-2, resume=tmp_path / "part.npz"), whole, rel=1e-9)


def test_modes_merged_for_waves_serve_twice_the_time():
    """Beyond that they differ from the material by more than is allowed."""
    broad = broad_rubber()
    moved = [vf.motion.History([0.0, end], pressure=2e3, speed=0.1, before="sliding") for end in (0.05, 0.1, 5.0)]
    part = vf.motion.solve_transient(broad, WAVE, moved[0], accuracy=1e-2, progress=stopped_after(1))
    further = vf.motion.solve_transient(
        broad_rubber(), WAVE, moved[1], accuracy=1e-2, resume=part, progress=stopped_after(1)
    )
    assert further.steps > part.steps
    with refused("merged-modes"):
        vf.motion.solve_transient(broad, WAVE, moved[2], accuracy=1e-2, resume=part)


def test_a_run_goes_on_under_a_larger_load():
    """More springs are added beyond those that were touched: as solved at once, to the accuracy."""
    dwell = vf.motion.History([0.0, 0.02], load=0.1)
    longer = vf.motion.History([0.0, 0.02, 0.04], load=[0.1, 0.1, 4.0])
    at_once = vf.motion.solve_transient(RUBBER, BALL, longer, times=[0.02, 0.03, 0.04])
    first = vf.motion.solve_transient(RUBBER, BALL, dwell, times=[0.02])
    run = vf.motion.solve_transient(RUBBER, BALL, longer, times=[0.02, 0.03, 0.04], resume=first)
    assert run.time.tolist() == [0.02, 0.03, 0.04]
    assert run.indentation == pytest.approx(at_once.indentation, rel=1e-4)
    assert run.contact_radius == pytest.approx(at_once.contact_radius, rel=1e-3)
    assert run.dissipated == pytest.approx(at_once.dissipated, abs=3e-4 * at_once.dissipated.max())
    further = vf.motion.History([0.0, 0.02, 0.04, 0.04, 0.05], load=[0.1, 0.1, 4.0, 8.0, 8.0])
    again = vf.motion.solve_transient(RUBBER, BALL, further, times=[0.05], resume=run)
    assert again.time.tolist() == [0.02, 0.03, 0.04, 0.05]
    whole = vf.motion.solve_transient(RUBBER, BALL, further, times=[0.05])
    assert again.indentation[-1] == pytest.approx(whole.indentation[-1], rel=1e-4)
    assert again.energy_imbalance < 1e-4


def test_what_cannot_go_on_is_refused(tmp_path: Path):
    run = vf.motion.solve_transient(RUBBER, BALL, vf.motion.History([0.0, 0.02], load=1.0), times=[0.02])
    longer = vf.motion.History([0.0, 0.04], load=1.0)
    other = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    for code, material, indenter, history in (
        ("not-the-same", other, BALL, longer),
        ("not-the-same", RUBBER, vf.Ball("11 mm"), longer),
        ("not-the-same", RUBBER, BALL, vf.motion.History([0.0, 0.04], load=1.1)),
        ("not-the-same", RUBBER, BALL, vf.motion.History([0.0, 0.01], load=1.0)),
        ("not-the-same", RUBBER, BALL, vf.motion.History([0.0, 0.04], indentation=1e-4)),
        ("not-the-same", RUBBER, BALL, vf.motion.History([0.0, 0.04], load=1.0, speed=[0.0, 1.0])),
        ("not-available", RUBBER, WAVE, SLIDING),
    ):
        with refused(code):
            vf.motion.solve_transient(material, indenter, history, resume=run)
    with refused("not-the-same"):
        vf.motion.solve_transient(RUBBER, BALL, longer, resume=run, accuracy=1e-2)
    (tmp_path / "other.npz").write_bytes(b"no archive")
    with refused("not-a-state", DataFileError):
        vf.motion.solve_transient(RUBBER, BALL, longer, resume=tmp_path / "other.npz")
    np.savez(tmp_path / "numbers.npz", format="numbers")
    with refused("not-a-state", DataFileError):
        vf.motion.solve_transient(RUBBER, BALL, longer, resume=tmp_path / "numbers.npz")
