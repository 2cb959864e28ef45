"""`viscofric transient` and `impact` as users meet them: words, JSON, tables, drawings, and how they fail."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import xarray
from click.testing import CliRunner, Result

import viscofric as vf
from cli import calls
from cli.calls import refusal, succeed
from viscofric.cli import main, progress

RUBBER = ("--E0", "1 MPa", "--E-inf", "10 MPa", "--tau", "10 ms")
BALL = ("--ball", "10 mm")
PRESS = (*RUBBER, *BALL, "--load", "1 N", "--dwell", "0.1 s")
HIT = (*RUBBER, *BALL, "--mass", "33 g")
SOLID = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "10 ms")


record = cache(calls.record)


def lines(done: Result) -> dict[str, str]:
    found = (line.split("  ", 1) for line in done.stdout.replace("\n  ", "\n").splitlines() if "  " in line)
    return {one: value.strip() for one, value in found}


def test_json_holds_what_python_gives() -> None:
    found = record("transient", *PRESS, "--times", "1 ms, 0.1 s")
    run = vf.motion.solve_transient(
        SOLID, vf.Ball("10 mm"), vf.motion.History([0.0, 0.1], load=1.0), times=["1 ms", "0.1 s"]
    )
    results = found["results"]
    for name in ("time", "indentation", "contact_radius", "dissipated"):
        assert results[name] == getattr(run, name).tolist(), name
        assert results["units"][name] in ("s", "m", "J")
    assert found["inputs"]["history"] == {
        "time": [0.0, 0.1], "load": [1.0, 1.0], "position": [[0.0, 0.0], [0.0, 0.0]],
        "speed": [[0.0, 0.0], [0.0, 0.0]], "before": "untouched", "direction": [1.0, 0.0],
    }  # fmt: skip
    assert found["inputs"]["indenter"] == {"shape": "ball", "radius": 0.01, "elastic": None}
    assert (found["interrupted"], found["warnings"], found["steps"]) == (False, [], run.steps)


def test_words_show_the_end_and_the_energies() -> None:
    found = lines(succeed("transient", *PRESS))
    # a³ = (3/4)(1 − ν²) R F J(t) with J = 1e-6 (1 − 0.9 e^{−t/τ}) (Lee and Radok)
    radius = (0.75 * 0.75 * 0.01 * 1e-6 * (1.0 - 0.9 * np.exp(-10.0))) ** (1.0 / 3.0)
    assert float(found["contact radius"].split()[0]) == pytest.approx(1e3 * radius, rel=1e-3)
    stored, dissipated, work = (
        found[name].split() for name in ("stored energy", "dissipated energy", "work on the material")
    )
    assert {stored[-1], dissipated[-1], work[-1]} == {"µJ"}
    assert float(dissipated[2]) < 1e-2 * float(dissipated[0])  # ± the error of the energy
    assert float(stored[0]) + float(dissipated[0]) == pytest.approx(float(work[0]), rel=1e-3)


def test_a_load_may_rise_and_a_depth_be_held() -> None:
    found = record("transient", *RUBBER, *BALL, "--indentation", "0.1 mm", "--load-time", "10 ms", "--dwell", "50 ms")
    history = found["inputs"]["history"]
    assert (history["time"], history["indentation"]) == ([0.0, 0.01, pytest.approx(0.06)], [0.0, 1e-4, 1e-4])
    assert found["results"]["load"][-1] < max(found["results"]["load"])


def test_the_history_is_said_in_one_line() -> None:
    words = succeed("transient", *RUBBER, *BALL, "--load", "1 N", "--load-time", "10 ms", "--dwell", "0.1 s").stdout
    assert words.splitlines()[1].startswith("110 ms, load 0 N to 1 N, ")


def test_points_are_counted_and_the_temperature_is_the_reference() -> None:
    found = record(
        "transient", "--material", "synthetic fluoroelastomer", *BALL, "--load", "1 N", "--dwell", "1 ms", "--points", 3
    )
    assert found["results"]["time"] == [0.0, 5e-4, 1e-3]
    assert found["inputs"]["history"]["temperature"] == 2 * [vf.synthetic_fluoroelastomer().reference]


def test_histories_come_from_files(tmp_path: Path) -> None:
    path = tmp_path / "history.csv"
    path.write_text("clock (ms);F (N)\n0;0\n10;1\n110;1\n", encoding="utf-8")
    words = ("transient", *RUBBER, *BALL, "--history", path, "--history-column", "time=clock (ms)")
    found = record(*words, "--before", "at rest")
    assert found["inputs"]["history"]["time"] == pytest.approx([0.0, 0.01, 0.11], rel=1e-14)
    assert found["inputs"]["history"]["before"] == "at rest"
    ramp = record("transient", *PRESS, "--load-time", "10 ms")
    assert found["results"]["indentation"][-1] == pytest.approx(ramp["results"]["indentation"][-1], rel=1e-6)
    assert refusal(*words, "--load", "1 N")[:2] == (1, "give-one")
    assert refusal(*words[:-2])[:3] == (1, "missing-columns", "history.columns")
    assert refusal(*words, "--dwell", "1 s").status == 2
    assert refusal(*words, "--out", path)[:2] == (1, "is-input")


def test_tables_and_drawings_are_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscofric.report.figures.animation.FRAMES", 2)
    monkeypatch.setattr("viscofric.report.figures.animation._SECONDS", 1.0)
    drawings = [tmp_path / name for name in ("run.svg", "strip.png", "run.gif")]
    succeed(
        "transient", *PRESS, "--times", "1 ms, 0.1 s", "--out", tmp_path / "run.csv", "--picture", drawings[0],
        "--pressures", drawings[1], "--animation", drawings[2],
    )  # fmt: skip
    assert all(path.stat().st_size > 0 for path in drawings)
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True)
    assert table["time_s"].tolist() == [1e-3, 0.1]
    succeed("transient", *PRESS, "--times", "1 ms, 0.1 s", "-o", tmp_path / "run.nc", "--json")
    with xarray.open_dataset(tmp_path / "run.nc", engine="netcdf4") as data:
        assert data["indentation"].attrs["units"] == "m"
        np.testing.assert_allclose(data["indentation"], table["indentation_m"], rtol=1e-14)
    printed = succeed("transient", *PRESS, "--times", "1 ms", "--out", "-").stdout.splitlines()
    assert (len(printed), printed[0].split(",")[0]) == (2, "time (s)")


def test_strokes_go_forth_and_back(tmp_path: Path) -> None:
    words = (
        "transient", *RUBBER, "--cylinder", "10 mm", "--load", "200 N/m", "--dwell", "20 ms", "--slide", "1 mm",
        "--speed", "0.1 m/s", "--strokes", 2, "--accuracy", 0.1, "--times", "20 ms, 30 ms, 40 ms", "--coulomb", 0.2,
    )  # fmt: skip
    found = record(*words)
    history = vf.motion.History(
        [0, 0.02, 0.02, 0.03, 0.03, 0.04], load="200 N/m", speed=[0.0, 0.0, 0.1, 0.1, -0.1, -0.1]
    )
    inputs = found["inputs"]["history"]
    assert inputs["time"] == pytest.approx(history.time.tolist(), rel=1e-12)
    assert inputs["speed"] == history.speed.tolist()
    assert found["results"]["position_x"] == pytest.approx([0.0, 1e-3, 0.0], abs=1e-15)
    rest, forth, back = found["results"]["friction_coefficient"]
    # at rest nothing but rounding
    assert abs(rest) < 1e-9 < 0.05 < forth
    assert back == pytest.approx(-forth, rel=0.1)  # the sliding forgets the dwell after some contact widths
    assert found["results"]["total_friction"] == pytest.approx([0.2 + rest, forth - 0.2, back - 0.2])  # after each jump
    assert lines(succeed(*words))["friction coefficient of hysteresis and interface together"] == f"−{0.2 - back:.4g}"


@pytest.mark.slow
def test_a_rough_surface_slides_under_a_pressure_and_goes_on_from_its_state(tmp_path: Path) -> None:
    heights = 1e-6 * np.cos(2.0 * np.pi * np.arange(16) / 16)[:, None] * np.ones(4)
    np.save(tmp_path / "wave.npy", heights)
    surface = ("--surface", tmp_path / "wave.npy", "--spacing", "10 um", "--prepare", "periodic")
    words = (
        "transient", *RUBBER, *surface, "--pressure", "20 kPa", "--dwell", "1 ms", "--speed", "10 mm/s", "--accuracy",
        0.1,
    )  # fmt: skip
    begun = record(*words, "--slide", "10 um", "--save-state", tmp_path / "begun.npz")
    history = vf.motion.History([0.0, 1e-3, 1e-3, 2e-3], pressure="20 kPa", speed=[0.0, 0.0, 0.01, 0.01])
    run = vf.motion.solve_transient(SOLID, vf.contact.PeriodicSurface(heights, "10 um"), history, accuracy=0.1)
    assert begun["results"]["friction_coefficient"] == pytest.approx(run.friction_coefficient.tolist(), abs=1e-12)
    assert begun["inputs"]["indenter"]["points"] == [16, 4]
    again = record(*words, "--slide", "20 um", "--resume", tmp_path / "begun.npz")
    assert again["results"]["time"][: len(run.time)] == begun["results"]["time"]
    assert again["results"]["time"][-1] == pytest.approx(3e-3)
    said = succeed(*words, "--slide", "10 um")
    assert "mean pressure" in lines(said)
    assert "Note: " in said.stdout
    assert [note["code"] for note in begun["note_records"]] == ["errors-in-time"]
    assert refusal(*words[:-2], "--load", "1 N").status == 2
    assert refusal(*words[:-2], *BALL).status == 2
    assert refusal("transient", *PRESS, "--prepare", "window").status == 2
    assert refusal("transient", *RUBBER, *surface, "--load", "1 N", "--dwell", "1 s")[:2] == (1, "wrong-control")


@pytest.mark.slow
def test_a_contact_on_cells_goes_on_from_its_state(tmp_path: Path) -> None:
    words = ("transient", *RUBBER, "--cylinder", "10 mm", "--load", "1 kN/m", "--speed", "50 mm/s", "--accuracy", 0.05)
    record(*words, "--slide", "0.5 mm", "--save-state", tmp_path / "begun.npz")
    again = record(*words, "--slide", "1 mm", "--times", "20 ms", "--resume", tmp_path / "begun.npz")["results"]
    history = vf.motion.History([0.0, 0.02], load=1e3, speed=0.05)
    run = vf.motion.solve_transient(SOLID, vf.Cylinder("10 mm"), history, times=[0.02], accuracy=0.05)
    assert (0.01, again["time"][-1]) == (pytest.approx(again["time"][-2]), 0.02)
    away = abs(again["friction_force"][-1] - run.friction_force[-1])
    assert away <= again["friction_force_error"][-1] + run.errors.friction_force[-1]


def test_a_repeated_history_has_its_periodic_state(tmp_path: Path) -> None:
    phase = np.linspace(0.0, 2.0 * np.pi, 13)
    table = "".join(f"{t},{d}\n" for t, d in zip(phase / 100.0, 100.0 + 3.0 * np.sin(phase), strict=True))
    (tmp_path / "period.csv").write_text("t (s),depth (um)\n" + table, encoding="utf-8")
    words = ("transient", *RUBBER, *BALL, "--history", tmp_path / "period.csv", "--cycle", "--accuracy", 0.1)
    history = vf.motion.read_history(tmp_path / "period.csv")
    cycle = vf.motion.solve_cycle(SOLID, vf.Ball("10 mm"), history, accuracy=0.1)
    found = record(*words)["results"]
    assert (found["loss_stiffness"], found["periods"]) == (cycle.loss_stiffness, cycle.periods)
    said = lines(succeed(*words, "--picture", tmp_path / "cycle.svg"))
    assert float(said["loss tangent"].split(" ± ")[0]) == pytest.approx(cycle.loss_tangent, rel=0.02)
    assert found["loss_stiffness_error"] == cycle.loss_stiffness_error > 0.0
    assert float(said["energy per cycle"].split()[0]) > 0.0
    assert (tmp_path / "cycle.svg").stat().st_size > 0
    assert len(record(*words, "--points", 15)["results"]["time"]) == 15
    for option in (("--save-state", "a.npz"), ("--resume", "a.npz")):
        assert refusal(*words, *option).status == 2, option
    assert record(*words, "--coulomb", 0.3)["inputs"]["coulomb"] == 0.3
    assert refusal(*words, "--coulomb", 20)[:2] == (1, "out-of-range")
    assert refusal("transient", *PRESS, "--coulomb", 0.3, "--heating", "steel").status == 2
    assert refusal("transient", *PRESS, "--load-time", "1 ms", "--cycle")[:2] == (1, "not-a-period")


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interruption_keeps_what_was_found(
    number: signal.Signals, status: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    @contextmanager
    def impatient(words: str, *, quiet: bool) -> Iterator[Callable[[float, float], None]]:
        def show(reached: float, last: float) -> None:
            if reached > 0.5 * last:
                signal.raise_signal(number)

        yield show

    monkeypatch.setattr(progress, "time_bar", impatient)
    done = CliRunner().invoke(main, ["transient", *PRESS, "--out", str(tmp_path / "run.csv")])
    assert done.exit_code == status
    reached = np.loadtxt(tmp_path / "run.csv", delimiter=",", skiprows=1)[-1, 0]
    assert 0.05 < reached < 0.1
    assert f"{reached:.4g} s" in done.stderr
    assert f"{1e3 * reached:.4g}"[:4] in lines(done)["at the end"]


@pytest.mark.parametrize(
    ("arguments", "status", "code"),
    [
        ((*RUBBER, *BALL, "--load", "1 N"), 2, ""),  # no duration
        ((*RUBBER, *BALL, "--dwell", "1 s"), 2, ""),  # no load
        ((*PRESS, "--indentation", "1 mm"), 2, ""),
        ((*PRESS, "--load", "2 N"), 2, ""),  # given twice
        ((*PRESS, "--slide", "1 mm"), 2, ""),  # no speed
        ((*PRESS, "--strokes", 2), 2, ""),
        ((*PRESS, "--times", "1 ms", "--points", 3), 2, ""),
        ((*PRESS, "--history-sheet", "a"), 2, ""),
        ((*PRESS, "--animation", "a.mp4"), 2, ""),
        ((*PRESS, "--before", "sliding"), 1, "not-sliding"),
        ((*PRESS, "--history", "none.csv"), 2, ""),
    ],
    ids=lambda value: " ".join(map(str, value[-2:])) if isinstance(value, tuple) else "",
)
def test_mistakes_are_refused(
    arguments: tuple[object, ...], status: int, code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    found = refusal("transient", *arguments)
    assert (found.status, found.code) == (status, code), found


def test_one_impact_is_reported_with_its_rebounds(tmp_path: Path) -> None:
    words = ("impact", *HIT, "--speed", "0.1 m/s", "--gravity", "9.81 m/s^2", "--rebounds", 2, "--accuracy", 1e-2)
    found = record(*words)
    hit = vf.motion.solve_impact(
        SOLID, vf.Ball("10 mm"), mass="33 g", speed=0.1, gravity=9.81, rebounds=2, accuracy=1e-2
    )
    assert [one["restitution"] for one in found["contacts"]] == [one.restitution for one in hit.contacts]
    assert found["results"]["velocity"] == hit.velocity.tolist()
    assert (found["inputs"]["mass"], found["inputs"]["gravity"]) == (0.033, 9.81)
    done = succeed(*words, "--picture", tmp_path / "hit.svg", "--out", tmp_path / "hit.nc")
    assert done.stdout.count("\nrestitution") == len(hit.contacts)
    assert lines(done)["contact time"] == "without end (stays)"
    assert float(lines(done)["largest indentation"].split()[0]) > 0.0
    assert (tmp_path / "hit.svg").stat().st_size > 0
    with xarray.open_dataset(tmp_path / "hit.nc", engine="netcdf4") as data:
        assert data.attrs["contacts"] == len(hit.contacts)


def test_contacts_of_one_impact_are_told_apart() -> None:
    ball = ("--ball", "5 mm", "--mass", "10 g", "--speed", "0.1 m/s", "--gravity", "9.81 m/s^2", "--rebounds", 2)
    found = lines(succeed("impact", "--material", "synthetic fluoroelastomer", *ball, "--accuracy", 1e-2))
    assert found["contact 1"].startswith("0 s")
    assert found["contact 2"].endswith("ms after the first touch")


def test_several_impacts_are_a_curve(tmp_path: Path) -> None:
    words = ("impact", *HIT, "--speed", "0.1 m/s, 1 m/s")
    found = record(*words)
    assert found["results"]["speed"] == [0.1, 1.0]
    hit = vf.motion.solve_impact(SOLID, vf.Ball("10 mm"), mass="33 g", speed="0.1 m/s")
    assert found["results"]["restitution"][0] == hit.restitution
    done = succeed(*words, "--picture", tmp_path / "curve.svg", "--out", tmp_path / "curve.csv")
    assert (tmp_path / "curve.svg").stat().st_size > 0
    table = np.genfromtxt(tmp_path / "curve.csv", delimiter=",", names=True)
    assert table["restitution"].tolist() == found["results"]["restitution"]
    printed = [line.split() for line in done.stdout.splitlines() if "±" in line]
    assert [float(row[1]) for row in printed] == pytest.approx(found["results"]["restitution"], abs=1e-4)


@pytest.mark.parametrize(
    ("arguments", "status", "code"),
    [
        ((*HIT, "--speed", "1 m/s, 2 m/s", "--rebounds", 2), 2, ""),
        ((*HIT, "--speed", "1 m/s", "--layer", "1 mm"), 2, ""),
        ((*RUBBER, "--cylinder", "1 cm", "--mass", "1 g", "--speed", "1 m/s"), 1, "not-available"),
    ],
    ids=lambda value: " ".join(map(str, value[-2:])) if isinstance(value, tuple) else "",
)
def test_wrong_impacts_are_refused(arguments: tuple[object, ...], status: int, code: str) -> None:
    found = refusal("impact", *arguments)
    assert (found.status, found.code) == (status, code), found
