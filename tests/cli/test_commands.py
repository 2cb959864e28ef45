"""The command line as users meet it: what it prints, what it writes, how it fails."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from viscofric.cli import main

EXAMPLE = Path(str(files("viscofric"))) / "example"
STUDY = """
[material]
dma = "dma.csv"
deformation = "tension"
reference_temperature = "30 degC"
[indenter]
radius = "9.525 mm"
[conditions]
load = "25 N"
speed = "100 mm/s"
temperature = "90 degC"
[solver]
accuracy = 1e-2
master_curve_points = 2
"""


def call(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def write(folder: Path, *, dma: str | None = None, study: str = STUDY) -> Path:
    (folder / "dma.csv").write_text(
        (EXAMPLE / "dma.csv").read_text(encoding="utf-8") if dma is None else dma, encoding="utf-8"
    )
    (folder / "study.toml").write_text(study, encoding="utf-8")
    return folder / "study.toml"


def told(result: Result) -> str:
    """Return the one sentence that a failed call printed."""
    assert result.exit_code == 1, result.output
    assert "Traceback" not in result.output
    (line,) = [line for line in result.output.splitlines() if line.startswith("Error: ")]
    return line


def test_run_names_the_files_it_wrote(tmp_path: Path) -> None:
    result = call("run", write(tmp_path))
    assert result.exit_code == 0, result.output
    for words in ("figure ", "data ", "report "):
        paths = [line.split(maxsplit=1)[1] for line in result.stdout.splitlines() if line.startswith(words)]
        assert paths
        assert all(Path(path).stat().st_size > 0 for path in paths)
    again = call("report", tmp_path / "study.results")
    assert again.exit_code == 0, again.output


def test_new_writes_a_study_that_runs_and_overwrites_nothing(tmp_path: Path) -> None:
    result = call("new", tmp_path / "mine")
    assert result.exit_code == 0, result.output
    assert {path.name for path in (tmp_path / "mine").iterdir()} == {"study.toml", "dma.csv", "mtm.csv"}
    assert "already holds" in told(call("new", tmp_path / "mine"))


def sweeps(*rows: str) -> str:
    return "\n".join(["temperature (degC),frequency (Hz),storage modulus (MPa),loss modulus (MPa)", *rows])


TWO_ISOTHERMS = (
    "20,0.1,10,2", "20,1,14,3", "20,10,20,5", "30,0.1,7,1.2", "30,1,10,2", "30,10,14,3",
)  # fmt: skip


@pytest.mark.parametrize(
    ("dma", "words"),
    [
        (sweeps("30,1,-1,0.1", *TWO_ISOTHERMS), ["dma.csv", "line 2", "storage"]),
        (sweeps("30,1,nan,0.1", *TWO_ISOTHERMS), ["dma.csv", "line 2"]),
        (sweeps("30,1,,0.1", *TWO_ISOTHERMS), ["dma.csv", "line 2"]),
        (sweeps(*TWO_ISOTHERMS).replace("(MPa)", "(mm)"), ["dma.csv", "mm"]),
        (sweeps(*TWO_ISOTHERMS[:3]), ["dma.csv", "isotherm"]),
        (sweeps("20,0.1,1000,20", "20,1,1010,20", "90,0.1,2,0.02", "90,1,2.02,0.02"), ["dma.csv", "overlap"]),
        ("", ["dma.csv"]),
        ("\x00\x01\x02", ["dma.csv"]),
    ],
    ids=["negative", "nan", "empty cell", "wrong unit", "one isotherm", "no overlap", "empty", "binary"],
)
def test_bad_data_is_told_in_one_sentence(tmp_path: Path, dma: str, words: list[str]) -> None:
    sentence = told(call("run", write(tmp_path, dma=dma)))
    for word in words:
        assert word in sentence


@pytest.mark.parametrize(
    ("good", "bad", "word"),
    [
        ('"25 N"', '"0 N"', "above zero"),
        ('"100 mm/s"', '"0 mm/s"', "above zero"),
        ('speed = "100 mm/s"', 'sped = "100 mm/s"', "did you mean 'speed'"),
        ('"90 degC"', '"400 degC"', "outside"),
        ('dma = "dma.csv"', 'dma = "other.csv"', "no such file"),
    ],
)
def test_bad_run_files_are_told_in_one_sentence(tmp_path: Path, good: str, bad: str, word: str) -> None:
    assert good in STUDY
    assert word in told(call("run", write(tmp_path, study=STUDY.replace(good, bad))))


def test_missing_run_file_is_told(tmp_path: Path) -> None:
    assert "no such file" in told(call("run", tmp_path / "study.toml"))


def test_shuffled_and_repeated_rows_are_accepted_with_a_note(tmp_path: Path) -> None:
    lines = (EXAMPLE / "dma.csv").read_text(encoding="utf-8").splitlines()
    header = [line for line in lines if line.startswith(("#", "temperature"))]
    rows = [line for line in lines if line not in header]
    shuffled = "\n".join([*header, *rows[::-1], rows[0]])
    result = call("run", write(tmp_path, dma=shuffled))
    assert result.exit_code == 0, result.output
    from viscofric.study import open_results

    notes = open_results(tmp_path / "study.results").tree.attrs["notes"]
    assert "sorted" in notes
    assert "averaged" in notes


def test_unknown_command_suggests_the_nearest() -> None:
    result = call("rnu")
    assert result.exit_code == 2
    assert "Did you mean 'run'?" in result.output


def test_interruption_keeps_finished_cases(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(tmp_path, study=STUDY.replace('"100 mm/s"', '["100 mm/s", "200 mm/s"]'))
    from viscofric.study import execution

    solve, calls = execution.solve_steady, []

    def interrupted(*arguments: object, **options: object) -> object:
        calls.append(arguments)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return solve(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(execution, "solve_steady", interrupted)
    result = call("run", path)
    assert result.exit_code == 130
    assert "Finished cases are kept" in result.output
    assert len(list((tmp_path / "study.results" / "cases").iterdir())) == 1
