"""The wording of the command line: what a command says on standard error, and phrases of help and tables."""

from __future__ import annotations

import shlex
import shutil
from importlib.resources import files
from pathlib import Path

import pytest
from click.testing import CliRunner

from cli.friction_files import curves, runs
from cli.refusals import refusal
from study.sweeps import made_results, made_sweep
from viscofric.cli import main
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
    (folder / "taken").mkdir()
    (folder / "taken" / "study.toml").touch()
    made_results(folder / "a", failed=[2])
    made_results(folder / "b", made_sweep(loads=(10.0, 30.0)), accuracy=1e-2)
    return folder


@pytest.mark.parametrize(
    ("command", "status", "sentence"),
    [
        (f"solve {SOLID} {BALL} --indentation '1 mm'", 2, "give either --load or --indentation, one of them."),
        (
            f"solve {SOLID} {BALL} --indenter-poisson-ratio 0.4",
            2,
            "--indenter-poisson-ratio is for --indenter-modulus only; a rigid indenter has none.",
        ),
        (f"solve {SOLID} {BALL} --height-unit um", 2, "--height-unit is for --height-map and --profile only."),
        (f"solve {SOLID} {BALL} --cone '5 deg'", 2, "--ball and --cone are both given; there is one indenter."),
        (
            f"solve {SOLID} --speed '1 m/s' --load '1 N'",
            2,
            ("no indenter is given; give --ball, --cylinder, --ellipsoid, --cone, --punch, --height-map, --profile."),
        ),
        (f"solve {BALL}", 2, "no material is given; give --material, --dma, or --E0, --E-inf and --tau."),
        (
            f"solve {SOLID} --material 'VHB 4910' {BALL}",
            2,
            "--material and --E0 are both given; the rubber comes from one of them.",
        ),
        (
            f"solve {SOLID} --ellipsoid '10 mm' --speed '1 m/s' --load '1 N'",
            2,
            "--ellipsoid '10 mm': give two radii, along x and y: '10 mm,40 mm'.",
        ),
        (f"solve {SOLID} {BALL} --spacing '1 um'", 2, "--spacing is for --height-map and --profile only."),
        (f"solve {SOLID} {BALL} --sliding-base", 2, "--sliding-base is for --layer only; a half-space has no base."),
        (
            f"solve --material dma.csv {BALL}",
            1,
            (
                "dma.csv: is not a material card. Supported are Abaqus, ANSYS and LS-DYNA cards with a Prony "
                "series, COMSOL parameters, and material files of viscofric (JSON or CSV); `viscofric material "
                "fit` makes one from DMA sweeps."
            ),
        ),
        (
            f"solve {SOLID} {BALL} --direction 1,2,3",
            2,
            "--direction '1,2,3': give an angle, '30 deg', or two numbers, '0,1'.",
        ),
        (
            f"solve {SOLID} {BALL} --picture a.gif",
            2,
            "Invalid value for --picture: a.gif: must end in .png, .svg, .pdf.",
        ),
        (f"solve {SOLID} {BALL} -o a.txt", 2, "Invalid value for --out: a.txt: must end in .nc, .csv."),
        (
            f"curve {RUBBER} --dma dma.csv {COARSE} --speed '1 m/s'",
            2,
            "--material and --dma are both given; the rubber comes from one of them.",
        ),
        (f"curve {RUBBER} --reference '20 degC' {COARSE} --speed '1 m/s'", 2, "--reference is for --dma only."),
        (
            f"curve --dma dma.csv {COARSE} --speed '1 m/s'",
            2,
            "--dma needs --reference, the temperature of its master curve, such as '30 degC'.",
        ),
        (
            f"curve {RUBBER} {COARSE} --speed '1 m'",
            1,
            "--speed = '1 m': has the wrong kind of unit (meter); write, for example, '100 mm/s'.",
        ),
        (
            f"curve {RUBBER} {COARSE} --speed '0 m/s'",
            1,
            "--speed = '0 m/s': must be above zero; write, for example, '100 mm/s'.",
        ),
        (
            f"curve {RUBBER} {COARSE} --speed '1 m/s to 2 m/s to 3 m/s'",
            2,
            "Invalid value for --speed: '1 m/s to 2 m/s to 3 m/s': a range has two ends: '1 mm/s to 1 m/s'.",
        ),
        (
            f"curve {RUBBER} {COARSE} --speed '1 m/s' --samples 20",
            2,
            "--samples needs a material fitted to sweeps: --dma, or a run file.",
        ),
        (
            f"curve {SOLID} {COARSE} --speed '1 m/s' --temperature '20 degC, 30 degC'",
            2,
            "this rubber has no shift factors and is valid at one temperature only; give one --temperature.",
        ),
        (
            f"curve {RUBBER} {COARSE} --speed '1 m/s' --out curves.txt",
            2,
            "Invalid value for --out: curves.txt: must end in .csv.",
        ),
        (
            "identify curves.csv --ball '10 mm' --anchor-modulus '2 MPa'",
            2,
            "--anchor-modulus needs --anchor-frequency too.",
        ),
        (
            "identify curves.csv --ball '10 mm' --anchor-load '2 N'",
            2,
            "--anchor-load is of an anchor; give --anchor-modulus or a contact's size.",
        ),
        (
            f"identify curves.csv --ball '10 mm' --anchor-area '2 mm^2' {ANCHOR}",
            2,
            "--anchor-modulus and --anchor-area are both given; one anchor is enough.",
        ),
        (
            f"identify curves.csv --ball '10 mm' --anchor-load '2 N' {ANCHOR}",
            2,
            "--anchor-load does not belong to --anchor-modulus.",
        ),
        (
            "identify curves.csv --ball '10 mm' --prior-band '1 Hz,2 Hz'",
            2,
            "--prior-band is the band of a --prior, which is not given.",
        ),
        (
            "identify curves.csv --ball '10 mm' --out rubber.csv",
            2,
            "Invalid value for --out: rubber.csv: must end in .json.",
        ),
        (
            "identify curves.csv --ball '10 mm' --beside rubber.json",
            2,
            "--beside is drawn into the --picture; give --picture too.",
        ),
        ("measure", 2, "Missing argument 'RUNS...'."),
        ("measure runs.csv --picture a.txt", 2, "Invalid value for --picture: a.txt: must end in .png, .svg, .pdf."),
        (
            "measure runs.csv --coulomb much",
            1,
            "--coulomb: 'much' is neither a friction coefficient, such as 0.05, nor the word 'constant'.",
        ),
        (
            "measure runs.csv --zero-error '0.1 N'",
            1,
            "--zero-error is the standard error of zero, which is not given.",
        ),
        (
            "measure runs.csv --coulomb constant --coulomb-error 0.1",
            1,
            "--coulomb-error is the standard error of a coulomb number, which is not given.",
        ),
        (
            "measure runs.csv --except-steps two",
            2,
            "Invalid value for --except-steps: 'two': must be numbers of steps, such as '2' or '1,3'.",
        ),
        ("measure runs.csv --except-steps 2", 1, "--except-steps 2: these traction runs have no numbers of steps."),
        ("measure runs.csv --out runs.csv", 1, "runs.csv is an input and would be overwritten; choose another name."),
        ("measur", 2, "No such command 'measur'. Did you mean 'measure'?"),
        (
            "master curves.csv --zero '0.1 N'",
            1,
            "--zero cannot be chosen for friction curves, which are already separated.",
        ),
        (
            "master curves.csv --leave-out-outliers",
            1,
            "--leave-out-outliers cannot be chosen for friction curves, which are already separated.",
        ),
        (
            "identify curves.csv --ball '1 mm' --speed-tolerance 0.2",
            1,
            "--speed-tolerance cannot be chosen for friction curves, which are already separated.",
        ),
        ("master curves.csv --out alpha.json", 2, "Invalid value for --out: alpha.json: must end in .csv."),
        (
            "master curves.csv --out curves.csv",
            1,
            "curves.csv is an input and would be overwritten; choose another name.",
        ),
        (
            "material fit dma.csv --reference '30 degC' --fix cold",
            2,
            "Invalid value for --fix: 'cold': write temperature and decadic logarithm, such as '-20 degC=4.2'.",
        ),
        ("material fitt", 2, "No such command 'fitt'. Did you mean 'fit'?"),
        (
            "export results --to xml",
            2,
            "Invalid value for '--to': 'xml' is not one of 'csv', 'excel', 'netcdf', 'zarr'.",
        ),
        ("export results --to excel -o a.csv", 2, "Invalid value for --out: a.csv: must end in .xlsx."),
        ("export results --to excel -o -", 2, "Invalid value for --out: excel cannot be printed; name a file."),
        (
            "export results --to csv --to excel -o a.csv",
            2,
            "Invalid value for --out: names one file, but several formats are requested; leave it out.",
        ),
        ("new", 2, "give the FOLDER to write the study into, or - to print its run file."),
        ("new taken", 1, "taken already holds study.toml; choose another folder."),
        (
            "master apart.csv --shift 'synthetic fluoroelastomer' --out alpha.csv",
            1,
            "alpha.csv is not written: friction determines no shift factors.",
        ),
        ("rnu", 2, "No such command 'rnu'. Did you mean 'run'?"),
        ("run study.toml", 1, "study.toml: no such file."),
    ],
)
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
        (SOLVE, ["friction coefficient", "centre of pressure", "ahead of the axis", "not resolved"]),
        (SOLVE.replace("1 m/s", "inf"), ["0 (elastic: no dissipation)", "on the axis"]),
        (
            f"{ELLIPSOID} --direction '30 deg'",
            ["(a force to the right is needed to keep the direction)"],
        ),
        (
            f"{ELLIPSOID} --direction '-30 deg'",
            ["force to the left"],
        ),
        (SOLVE + " --direction 1,1", ["lateral friction      0 (no lateral force)"]),
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
                "tables (csv), tables (excel)",
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
    words = CliRunner().invoke(main, shlex.split(command)).output
    assert [phrase for phrase in phrases if phrase not in words] == [], words
