"""``viscofric friction …``: what the commands print and write, and how they fail."""

from __future__ import annotations

import json
import re
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import viscofric as vf
from viscofric.cli import main

if TYPE_CHECKING:
    from pathlib import Path

COULOMB, ZERO_FORCE = 0.05, 0.3
HEADER = "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)"


def call(*words: object) -> Result:
    return CliRunner().invoke(main, ["friction", *map(str, words)], standalone_mode=True)


def viscoelastic(celsius: float, speed: float) -> float:
    """Friction of a formula; mm/s."""
    return 0.01 + 2e-4 * celsius - 0.002 * float(np.log10(speed))


def runs(
    path: Path, signs: tuple[int, ...] = (-1, 1), replicates: int = 2, noise: float = 0.0, load: float = 25.0
) -> Path:
    """Write runs of the formula: both slips for each of the signs of the disc speed."""
    random = np.random.default_rng(3)
    rows = [HEADER]
    for celsius, speed, replicate, sign, slip in product(
        (30.0, 60.0), (20.0, 60.0, 200.0), range(1, replicates + 1), signs, (-1, 1)
    ):
        force = ZERO_FORCE + load * (COULOMB * slip + viscoelastic(celsius, speed) * sign)
        force += noise * random.standard_normal()
        rows.append(f"{celsius},{replicate},{sign * speed},{sign * speed - 0.1 * slip * speed},{load},{force!r}")
    path.write_text("\n".join(rows), encoding="utf-8")
    return path


def record(*words: object) -> dict[str, Any]:
    done = call(*words, "--json")
    assert done.exit_code == 0, done.output
    found: dict[str, Any] = json.loads(done.stdout, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    return found


def test_separate_gives_what_python_gives(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", noise=0.01)
    found, curves = record("separate", path), vf.separate(vf.read_mtm(path))
    assert found["format"] == "viscofric friction curves 1"
    for name in ("speed", "temperature", "load", "viscoelastic", "viscoelastic_error", "coulomb", "consistency"):
        assert [point[name] for point in found["points"]] == getattr(curves, name).tolist(), name
    assert set(found["units"]) == set(found["points"][0])
    assert found["inputs"]["runs"] == [str(path)]


def test_separate_prints_each_condition_with_its_friction(tmp_path: Path) -> None:
    done = call("separate", runs(tmp_path / "runs.csv", noise=0.01))
    assert done.exit_code == 0, done.output
    heading, *rows = done.stdout.split("\n\n")[0].splitlines()
    assert heading.split()[:4] == ["T", "(°C)", "speed", "(mm/s)"]
    assert len(rows) == 6
    for row, (celsius, speed) in zip(rows, product((30.0, 60.0), (20.0, 60.0, 200.0)), strict=True):
        cells = row.split()
        assert float(cells[0]) == celsius
        assert float(cells[1]) == pytest.approx(speed, rel=1e-3)  # four digits are printed
        # 0.01 N of noise over 25 N; four readings and two replicates leave 1/√8 of it, of which four times.
        assert float(cells[5]) == pytest.approx(viscoelastic(celsius, speed), abs=4 * 0.01 / 25 / np.sqrt(8))
    assert re.search(r"zero of the force cell  0\.(29|30)", done.stdout)
    assert "of 6 points" in done.stdout


def test_what_cannot_be_known_is_null_and_a_question_mark(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", signs=(1,), replicates=1)
    found = record("separate", path, "--zero", "0.3 N")
    point = found["points"][0]
    assert point["viscoelastic_error"] is None
    assert point["viscoelastic"] == pytest.approx(viscoelastic(30.0, 20.0), rel=1e-9)  # no noise
    assert point["coulomb"] == pytest.approx(COULOMB, rel=1e-9)
    assert "consistency" not in point
    assert found["inputs"]["zero"] == "0.3 N"
    assert call("separate", path, "--zero", "0.3 N").exit_code == 0


def test_several_files_make_one_test(tmp_path: Path) -> None:
    back, forth = runs(tmp_path / "back.csv", signs=(-1,)), runs(tmp_path / "forth.csv", signs=(1,))
    assert "the signs of the velocities do not tell" in call("separate", back).output
    # One test was measured in two files: forwards in one, backwards in the other.
    found = record("separate", back, forth)
    np.testing.assert_allclose([point["offset"] for point in found["points"]], ZERO_FORCE, rtol=1e-9)  # no noise


def test_separate_draws_a_picture_and_calls_made_data_synthetic(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv")
    done = call("separate", path, "--picture", tmp_path / "curves.svg", "--synthetic")
    assert done.exit_code == 0, done.output
    assert done.stdout.splitlines()[-1] == f"picture  {tmp_path / 'curves.svg'}"
    assert (tmp_path / "curves.svg").stat().st_size > 0


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["separate"], 2, "Missing argument"),
        (["separate", "nothing.csv"], 1, "nothing.csv: no such file"),
        (["separate", "runs.csv", "--zero", "0.1 mm"], 1, "wrong kind of unit"),
        (["separate", "runs.csv", "--speed-tolerance", "2"], 1, "between 0 and 1"),
        (["separate", "runs.csv", "--picture", "a.txt"], 2, "must end in .png, .svg, .pdf"),
        (["separate", "runs.svg", "--picture", "runs.svg"], 1, "would be overwritten"),
        (["separat"], 2, "Did you mean 'separate'?"),
    ],
)
def test_mistakes_are_one_sentence(
    words: list[object], status: int, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    runs(tmp_path / "runs.csv")
    done = call(*words)
    assert done.exit_code == status, done.output
    assert told in done.output
    assert "Traceback" not in done.output
    assert len([line for line in done.output.splitlines() if line.startswith("Error: ")]) == 1


def test_nothing_asked_is_answered_with_the_help() -> None:
    assert call().output == call("--help").output
