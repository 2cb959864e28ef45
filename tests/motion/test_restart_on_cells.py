"""Runs on cells that go on: each of the last two grids continues from the state that it has reached."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from marks import apart, slow
from motion.going_on import BALL, RUBBER, broad_rubber, same, stopped_after
from refusals import refused
from viscofric.errors import DataFileError
from viscofric.notes import codes, note_of

CYLINDER = vf.Cylinder("10 mm")
TIMES = [0.01, 0.02, 0.03, 0.04]
THERE_AND_BACK = {"time": [0.0, 0.02, 0.04], "load": [1.0, 1.0, 1.0], "position": [0.0, 1e-3, 2e-4]}
#: Indenter, history, layer.
CASES = {
    "cylinder": (CYLINDER, {**THERE_AND_BACK, "load": [1e3, 1e3, 1e3]}, None),
    "far memory": (CYLINDER, {**THERE_AND_BACK, "load": [200.0, 200.0, 200.0], "position": [0.0, 8e-3, 4e-3]}, None),
    "ball": (BALL, THERE_AND_BACK, None),
    "ellipsoid": (vf.Ellipsoid("10 mm", "20 mm"), THERE_AND_BACK, None),
    "layer": (BALL, THERE_AND_BACK, vf.Layer("1 mm")),
    "lost": (
        BALL,
        {
            "time": [0.0, 0.015, 0.025, 0.04],
            "indentation": [0.0, 5e-5, -2e-5, 4e-5],
            "position": [0.0, 5e-4, 1e-3, 2e-3],
        },
        None,
    ),
    "slid": (CYLINDER, {"time": [0.0, 0.04], "load": [1e3, 1e3], "speed": [0.05, 0.01], "before": "sliding"}, None),
}


def history(name: str, end: float = 0.04) -> vf.motion.History:
    """Return the history of a case, up to a time."""
    given = CASES[name][1]
    kept = [*(time for time in given["time"] if time < end), end]
    columns = {
        one: np.interp(kept, given["time"], given[one])
        for one in ("load", "indentation", "position", "speed")
        if one in given
    }
    return vf.motion.History(kept, before=given.get("before", "untouched"), **columns)


def solved(name: str, end: float = 0.04, *, times=TIMES, **more) -> vf.motion.TransientSolution:
    indenter, _, layer = CASES[name]
    asked = None if times is None else [time for time in times if time <= end]
    return vf.motion.solve_transient(
        RUBBER, indenter, history(name, end), layer=layer, accuracy=5e-2, times=asked, **more
    )  # fmt: skip


@cache
def whole(name: str) -> tuple[vf.motion.TransientSolution, int]:
    """Return a run in one go, and the number of its steps on all grids."""
    steps: list[float] = []
    return solved(name, progress=lambda now, end: steps.append(now)), len(steps)


PARTS = [*slow(("cylinder", 0.7))]
MORE = [("cylinder", 0.02), ("slid", 0.6), ("cylinder", 0.3), ("far memory", 0.95)] + [
    (name, part) for name in ("ball", "ellipsoid", "layer", "lost") for part in (0.02, 0.4, 0.6, 0.95)
]


@pytest.mark.parametrize(("name", "part"), [*PARTS, *apart(*MORE)])
def test_an_interrupted_run_goes_on_from_a_file(tmp_path: Path, name: str, part: float):
    """Interrupted on the first grid or on the second one, by parts of all steps."""
    run, steps = whole(name)
    begun = solved(name, progress=stopped_after(max(1, int(part * steps))))
    assert begun.interrupted
    if name == "far memory":
        assert begun._restart.track.reached.pair.fine.state.past.pieces
    if name == "slid":
        assert begun._restart.track.reached.pair.fine.state.wake is not None
    begun.save_state(tmp_path / "begun.npz")
    again = solved(name, resume=tmp_path / "begun.npz")
    same(again, run)
    assert again.pressure_at(0.04).values == pytest.approx(run.pressure_at(0.04).values)


@pytest.mark.parametrize(("name", "part"), slow(("cylinder", 0.8)))
def test_a_run_of_all_steps_goes_on(name: str, part: float):
    steps: list[float] = []
    run = solved(name, times=None, progress=lambda now, end: steps.append(now))
    begun = solved(name, times=None, progress=stopped_after(int(part * len(steps))))
    same(solved(name, times=None, resume=begun), run)


#: Before, at and after a reversal; on cells that were left long ago; while the contact is lost.
ENDS = slow(("cylinder", 0.013), ("cylinder", 0.02))
MORE_ENDS = [("cylinder", 0.021), ("far memory", 0.036), ("far memory", 0.025)] + [
    (name, end) for name in ("ellipsoid", "layer") for end in (0.005, 0.013, 0.02, 0.033)
]
MORE_ENDS += [("ball", 0.013), ("ball", 0.02), ("ball", 0.033), ("slid", 0.025)]
MORE_ENDS += [("lost", end) for end in (0.012, 0.021, 0.025, 0.035)]


@pytest.mark.parametrize(("name", "end"), [*ENDS, *apart(*MORE_ENDS)])
def test_a_longer_history_goes_on_to_the_stated_errors(name: str, end: float):
    """Steps and grids differ from those of one run, so that both errors add."""
    run, _ = whole(name)
    begun = solved(name, end, times=[*(time for time in TIMES if time < end), end])
    again = solved(name, resume=begun)
    rows = [int(np.argmin(np.abs(again.time - time))) for time in TIMES]
    assert again.time[rows].tolist() == TIMES
    assert end in again.time
    pairs = {"load": "load", "friction_force": "friction_force"}
    if CASES[name][0] is not CYLINDER:  # depths of a line contact depend on the distance that they are measured from
        pairs |= {"indentation": "indentation", "dissipated": "energy"}
    for value, error in pairs.items():
        one, two = getattr(again, value)[rows], getattr(run, value)
        both = getattr(again.errors, error)[rows] + getattr(run.errors, error)
        assert np.all(np.abs(one - two) <= both + 1e-12 * np.abs(two).max()), value
    assert again.energy_imbalance < 2e-2  # the accuracy is 5e-2
    assert np.all(
        np.abs(again.errors.friction_force) <= 0.05 * max(again.friction_force.max(), 1e-3 * again.load.max())
    )


@pytest.mark.slow
def test_a_run_that_is_interrupted_twice_goes_on():
    """First on the finer grid, then while the coarser one follows the longer history: its results end earlier."""
    begun = solved("cylinder", 0.03)
    further = solved("cylinder", resume=begun, progress=stopped_after(2))
    assert further.interrupted
    assert further.time.tolist() == [0.01, 0.02, 0.03]
    assert further.friction_force == pytest.approx(begun.friction_force)
    coarse, fine = (one.track.reached.time for one in further._restart.marches)
    assert coarse > fine == 0.03
    same(solved("cylinder", resume=further), solved("cylinder", resume=begun))


@pytest.mark.slow
def test_an_interruption_before_the_first_step_of_a_finer_grid_keeps_the_coarser_one():
    run, steps = whole("cylinder")
    coarse, fine = (one.track.steps for one in run._restart.marches)
    assert coarse + fine + 1 == steps  # the end of all
    begun = solved("cylinder", progress=stopped_after(coarse + 1))
    assert begun.time.tolist() == TIMES
    assert begun.interrupted
    assert "one-grid" in codes(begun.warnings)
    same(solved("cylinder", resume=begun), run)


@pytest.mark.apart
def test_a_normal_motion_that_goes_on_by_sliding_is_solved_again_on_cells(tmp_path: Path):
    slides = vf.motion.History([0.0, 0.02, 0.03], load=1.0, position=[0.0, 0.0, 1e-3])
    pressed = vf.motion.solve_transient(
        RUBBER, BALL, vf.motion.History([0.0, 0.02], load=1.0), times=[0.01, 0.02], accuracy=5e-2
    )
    pressed.save_state(tmp_path / "pressed.npz")
    again = vf.motion.solve_transient(
        RUBBER, BALL, slides, accuracy=5e-2, times=[0.03], resume=tmp_path / "pressed.npz"
    )  # fmt: skip
    at_once = vf.motion.solve_transient(RUBBER, BALL, slides, accuracy=5e-2, times=[0.01, 0.02, 0.03])
    assert codes(again.warnings) >= {"solved-again"}
    same(again, at_once)
    known = pressed.indentation  # by springs
    assert np.all(np.abs(again.indentation[:2] - known) <= again.errors.indentation[:2] + pressed.errors.indentation)
    jumps = vf.motion.History([0.0, 0.02, 0.02, 0.03], load=[1.0, 1.0, 2.0, 2.0], position=[0.0, 0.0, 0.0, 1e-3])
    both = vf.motion.solve_transient(RUBBER, BALL, jumps, accuracy=5e-2, times=[0.03], resume=pressed)
    assert both.time.tolist() == [0.01, 0.02, 0.02, 0.03]
    assert both.load == pytest.approx([1.0, 1.0, 2.0, 2.0])


@pytest.mark.slow
def test_what_cannot_go_on_is_refused(tmp_path: Path):
    begun = solved("cylinder", 0.02)
    longer = history("cylinder")
    hard = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    for code, material, indenter, wanted, layer in (
        ("not-the-same", hard, CYLINDER, longer, None),
        ("not-the-same", RUBBER, vf.Cylinder("11 mm"), longer, None),
        ("not-the-same", RUBBER, CYLINDER, longer, vf.Layer("5 mm")),
        ("not-the-same", RUBBER, CYLINDER, vf.motion.History([0.0, 0.04], load=1e3, speed=0.06), None),
        ("not-the-same", RUBBER, CYLINDER, vf.motion.History([0.0, 0.01], load=1e3, speed=0.05), None),
    ):
        with refused(code):
            vf.motion.solve_transient(material, indenter, wanted, resume=begun, accuracy=5e-2, layer=layer)
    interrupted = solved("cylinder", progress=stopped_after(int(0.6 * whole("cylinder")[1])))
    with refused("other-times"):
        solved("cylinder", resume=interrupted, times=[0.01, 0.037, 0.04])
    begun.save_state(tmp_path / "begun.npz")
    with np.load(tmp_path / "begun.npz") as stored:
        kept = {name: stored[name] for name in stored.files if name != "0"}
    np.savez(tmp_path / "less.npz", **kept)
    with refused("not-a-state", DataFileError):
        solved("cylinder", resume=tmp_path / "less.npz")


@pytest.mark.slow
def test_modes_that_were_merged_for_a_short_history_are_refused_in_a_long_one():
    broad = broad_rubber()
    moved = [vf.motion.History([0.0, end], load=1e3, speed=0.05) for end in (0.02, 0.04, 20.0)]
    begun = vf.motion.solve_transient(broad, CYLINDER, moved[0], accuracy=5e-2, times=[0.02])
    further = vf.motion.solve_transient(broad, CYLINDER, moved[1], accuracy=5e-2, times=[0.04], resume=begun)
    assert further.time.tolist() == [0.02, 0.04]
    with refused("merged-modes"):
        vf.motion.solve_transient(broad, CYLINDER, moved[2], accuracy=5e-2, times=[20.0], resume=begun)


@pytest.mark.parametrize(
    ("before", "temperatures"), [("untouched", None), ("at rest", None), ("at rest", ["20 degC", "40 degC", "20 degC"])]
)
def test_depths_and_energies_of_a_longer_path_are_those_of_one_run(before: str, temperatures: list[str] | None):
    """The longer path and the larger load measure the line contact from farther points, also in its past."""
    times, load, speed = [0.0, 0.01, 0.02], [100.0, 300.0, 500.0], [0.02, 0.02, 0.1]
    law = None if temperatures is None else vf.WLF(C1=8.0, C2="100 K", reference="20 degC")
    rubber = RUBBER if law is None else vf.Material(RUBBER.spectrum, shift=law, poisson_ratio=0.5)

    def run(count: int, **more):
        kelvin = None if temperatures is None else temperatures[:count]
        given = vf.motion.History(
            times[:count], load=load[:count], speed=speed[:count], temperature=kelvin, before=before
        )
        return vf.motion.solve_transient(rubber, CYLINDER, given, accuracy=0.1, times=times[1:count], **more)

    known, found = run(3), run(3, resume=run(2))
    for name, error in {
        "indentation": "indentation",
        "dissipated": "energy",
        "stored": "energy",
        "work": "energy",
    }.items():
        one, two = getattr(known, name), getattr(found, name)
        assert np.all(np.abs(one - two) < getattr(known.errors, error) + getattr(found.errors, error)), name
        assert two == pytest.approx(one, rel=1e-2)  # a tenth of the accuracy; by one level instead of the other 20 %
    assert found.energy_imbalance < 1e-2
    assert [note.values for note in map(note_of, found.warnings)] == [
        note.values for note in map(note_of, known.warnings)
    ]
