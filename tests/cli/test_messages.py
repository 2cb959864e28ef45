"""The wording of the command line: what a command says on standard error, and phrases of help and tables."""

from __future__ import annotations

import shlex
import shutil
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path

import pytest

from cli.calls import call, refusal
from cli.friction_files import curves, runs
from study.sweeps import made_results, made_sweep
from viscofric.cli.new import template_text

SOLID = "--E0 '1 MPa' --E-inf '10 MPa' --tau '1 ms'"
RUBBER = "--material 'synthetic fluoroelastomer'"
BALL = "--ball '10 mm' --speed '1 m/s' --load '1 N'"
COARSE = "--ball '9.525 mm' --load '25 N' --accuracy 0.02"
ANCHOR = "--anchor-modulus '2.287 MPa' --anchor-frequency '60 rad/s' --anchor-temperature '300 K'"
SOLVE = f"solve {SOLID} {BALL} --accuracy 0.05"
ELLIPSOID = SOLVE.replace("--ball '10 mm'", "--ellipsoid '10 mm,30 mm'")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the files that the commands name."""
    folder = tmp_path_factory.mktemp("words")
    runs(folder / "runs.csv")
    runs(folder / "back.csv", signs=(-1,))
    curves(folder / "curves.csv")
    curves(folder / "exact.csv", noise=0.0)
    curves(folder / "apart.csv", [303.15, 363.15])
    shutil.copy(str(files("viscofric") / "example" / "dma.csv"), folder)
    (folder / "sweep.toml").write_text(template_text("sweep"), encoding="utf-8")
    cold = template_text("ball").replace('"30 degC", ', '"-60 degC", ', 1)
    (folder / "cold.toml").write_text(cold, encoding="utf-8")
    (folder / "shift.csv").write_text("temperature (degC),a_T\n-30,1e5\n30,1\n120,1e-3\n", encoding="utf-8")
    (folder / "taken").mkdir()
    (folder / "taken" / "study.toml").touch()
    made_results(folder / "a", failed=[2])
    made_results(folder / "b", made_sweep(loads=(10.0, 30.0)), accuracy=1e-2)
    return folder


def _refusals() -> Iterator[tuple[str, int, str]]:
    """Yield command, status and sentence of ``refusals.txt``."""
    text = (Path(__file__).parent / "refusals.txt").read_text(encoding="utf-8")
    for block in text.strip().split("\n\n")[1:]:
        command, said = block.split("\n")
        status, sentence = said.split(" ", 1)
        yield command.removeprefix("$ ").format(**globals()), int(status), sentence


@pytest.mark.parametrize(("command", "status", "sentence"), _refusals())
def test_a_refusal_says(
    command: str, status: int, sentence: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    found = refusal(*shlex.split(command))
    assert (found.status, found.sentence) == (status, sentence)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "phrases"),
    [
        ("", ["143 terminated"]),
        (SOLVE, ["viscoelastic friction coefficient", "centre of pressure along", "not resolved: at least"]),
        (
            f"solve {RUBBER} --ball '9 mm' --speed '0.1 m/s' --load '60 N' --temperature '60 degC' --accuracy 0.05",
            ["SYNTHETIC", "60 °C", "Warning: The contact extends"],
        ),
        ("material list", ["SYNTHETIC"]),
        ("material read dma.csv", ["24 isotherms", "moduli in tension"]),
        ("measure runs.csv", ["zero of the force cell", "of 6 points"]),
        ("measure runs.csv --coulomb 45", ["Note: The given Coulomb friction is not used"]),
        ("master exact.csv", ["from the scatter of the points about one curve"]),
        ("master curves.csv --shift 'synthetic fluoroelastomer'", ["of the modulus"]),
        (
            "master apart.csv --shift 'synthetic fluoroelastomer' --reference '30 degC'",
            ["No shift factors from friction"],
        ),
        (
            "check sweep.toml",
            [
                "cases      744 = 2 materials × 3 loads with radius × 4 temperatures × 31 speeds",
                "load 2.5 N to 40 N, radius 3 mm to 12 mm (3)",
                "report.html, results.csv, results.xlsx",
                "SYNTHETIC",
                "seconds on one core",
                "Note: Read as delimited text.",
            ],
        ),
        ("compare a a/results.nc --tolerance 0", ["18 cases in common", "The same within a relative difference of 0."]),
        (
            "compare a b",
            [
                "9 cases in common, 9 only in A, 9 only in B",
                "1 of them solved in one only",
                "The load has other values",
                "Another accuracy: 0.001 and 0.01.",
            ],
        ),
    ],
)
def test_output_contains(command: str, phrases: list[str], folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    words = call(*shlex.split(command)).output
    assert [phrase for phrase in phrases if phrase not in words] == [], words
