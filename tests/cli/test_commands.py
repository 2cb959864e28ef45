"""The command line as users meet it: what it prints, what it writes, how it fails."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import tomllib
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from cli.calls import call, refusal, refusal_of, succeed
from marks import apart
from viscofric import open_results, report
from viscofric.cli.commands import NOT_ACCURATE
from viscofric.cli.run import print_outcome
from viscofric.notes import Note
from viscofric.study import execution
from viscofric.study.results.file import save_results

if TYPE_CHECKING:
    from click.testing import Result

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
[uncertainty]
draws = 0
"""


def write(folder: Path, *, dma: str | None = None, study: str = STUDY) -> Path:
    (folder / "dma.csv").write_text(
        (EXAMPLE / "dma.csv").read_text(encoding="utf-8") if dma is None else dma, encoding="utf-8"
    )
    (folder / "study.toml").write_text(study, encoding="utf-8")
    return folder / "study.toml"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Result, Path]:
    """Return what one run printed, and the folder of its results."""
    folder = tmp_path_factory.mktemp("once")
    return call("run", write(folder)), folder / "study.results"


@pytest.fixture(scope="module")
def once(run: tuple[Result, Path]) -> Path:
    """Return the results of one run, not to be changed."""
    assert run[0].exit_code == 0
    return run[1]


@pytest.fixture
def finished(once: Path, tmp_path: Path) -> Path:
    """Return a copy of the results of one run."""
    return shutil.copytree(once, tmp_path / "finished.results")


@pytest.mark.slow
def test_run_names_the_files_it_wrote(run: tuple[Result, Path]) -> None:
    result, _ = run
    assert result.exit_code == 0, result.output
    for words in ("figures ", "data ", "report "):
        paths = [line.split(maxsplit=1)[1] for line in result.stdout.splitlines() if line.startswith(words)]
        assert paths
        assert all(Path(path).stat().st_size > 0 for path in paths)


def sweeps(*rows: str) -> str:
    return "\n".join(["temperature (degC),frequency (Hz),storage modulus (MPa),loss modulus (MPa)", *rows])


@pytest.mark.parametrize(
    ("dma", "code"),
    [
        (sweeps("30,1,-1,0.1", "30,10,-1,0.1", "20,1,14,3"), "not-positive"),
        (sweeps("20,0.1,10,2", "20,1,14,3", "20,10,20,5"), "too-few-isotherms"),
        ("", "empty"),
    ],
    ids=["negative", "one isotherm", "empty"],
)
def test_bad_data_is_refused_with_its_file(tmp_path: Path, dma: str, code: str) -> None:
    found = refusal("run", write(tmp_path, dma=dma))
    assert (found.status, found.code) == (1, code), found
    assert str(tmp_path / "dma.csv") in found.sentence


def test_bad_run_files_are_refused_with_their_field(tmp_path: Path) -> None:
    found = refusal("run", write(tmp_path, study=STUDY.replace("speed =", "sped =")))
    assert found[:3] == (1, "unknown-key", "conditions.sped")


@pytest.mark.slow
@pytest.mark.parametrize(("notes", "lines"), [(3, 4), (5, 6), (6, 1)])
def test_few_notes_are_printed_once_and_many_are_counted(
    finished: Path, capsys: pytest.CaptureFixture[str], notes: int, lines: int
) -> None:
    results = open_results(finished)
    results.tree.attrs |= {
        "notes": json.dumps([f"At −{kelvin} °C." for kelvin in [*range(notes), 0]]),
        "failures": "[]",
        "warnings": "[]",
    }
    print_outcome(results)
    printed = capsys.readouterr().err.splitlines()
    assert len(printed) == lines
    assert printed[0].startswith(f"{notes} notes ")
    assert printed[1:] == [f"Note: At −{kelvin} °C." for kelvin in range(lines - 1)]


@pytest.mark.slow
def test_failures_of_one_reason_are_printed_on_one_line(finished: Path, capsys: pytest.CaptureFixture[str]) -> None:
    results = open_results(finished)
    reasons = [(f"{speed} reached.", f"−90 °C, {speed} mm/s") for speed in (20, 40, 80)]
    failures = [Note("accuracy-not-reached", *reason).record() for reason in reasons]
    warning = "In 3 of 9 cases, most of all at −90 °C, 20 mm/s: wide."
    results.tree.attrs |= {"notes": "[]", "failures": json.dumps(failures), "warnings": json.dumps([warning])}
    print_outcome(results)
    assert capsys.readouterr().err.splitlines() == [
        "Warning: In 3 of 9 cases, most of all at −90 °C, 20 mm/s: wide.",
        "Failed: 3 cases (−90 °C, 20 mm/s; −90 °C, 40 mm/s; −90 °C, 80 mm/s), the first: 20 reached.",
    ]


@pytest.mark.slow
def test_missed_accuracy_is_a_warning_and_a_number_and_no_failure(tmp_path: Path) -> None:
    surface = """
    [material]
    catalogue = "synthetic fluoroelastomer"
    [surface]
    hurst = 0.8
    rms_slope = 0.2
    rolloff = "250 um"
    shortest = "128 um"
    spacing = "16 um"
    points = 64
    seed = 1
    [conditions]
    pressure = "50 kPa"
    speed = ["1 mm/s", "1 m/s"]
    temperature = "30 degC"
    [solver]
    accuracy = 1e-3
    """
    result = call("run", write(tmp_path, study=surface), "--json")
    assert result.exit_code == NOT_ACCURATE, result.output
    finished = json.loads(result.stdout.splitlines()[-1])
    results = open_results(tmp_path / "study.results")
    cases = results.dataset
    beyond = int((cases["friction_error"] > 1e-3 * cases["friction_coefficient"]).sum())
    assert beyond > 0
    assert finished["beyond_accuracy"] == results.beyond_accuracy == beyond
    (warning,) = [note for note in results.warnings if note.code == "accuracy-missed"]
    assert warning in finished["warnings"]
    assert warning.record() in finished["warning_records"]
    assert result.stderr.count(warning.words("run_file")) == 1


@pytest.mark.slow
def test_check_of_results_names_what_is_damaged(finished: Path) -> None:
    succeed("check", "--results", finished)
    case = min((finished / "cases").glob("*.json"))
    case.write_text(case.read_text().replace("1", "2", 1))
    result = call("check", "--results", finished)
    assert result.exit_code == 1
    assert [line for line in result.stderr.splitlines() if str(case) in line] == result.stderr.splitlines()
    found = json.loads(call("check", "--results", finished, "--json").stdout)
    assert (found["cases"], list(found["damaged"])) == (1, [str(case)])
    for wrong in (["check"], ["check", finished, "--results", finished]):
        assert call(*wrong).exit_code == 2


@pytest.mark.slow
def test_results_that_are_removed_before_the_end_are_an_error(finished: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    results = open_results(finished)
    monkeypatch.setattr(execution, "run_study", lambda study, **how: results)
    monkeypatch.setattr(report, "write_figures_and_report", lambda tree, folder: ([], folder / "gone.html"))
    assert refusal("run", "study.toml")[:2] == (1, "removed")


def test_errors_are_reported_without_an_empty_line_before_them(tmp_path: Path) -> None:
    assert call("run", tmp_path / "study.toml").stderr.startswith("Error: ")


def test_nothing_asked_is_answered_with_the_help() -> None:
    result = call()
    assert result.exit_code == 0
    assert result.output == call("--help").output


def test_template_names_every_key_of_a_run_file() -> None:
    from viscofric.study.run_file.errors import keys
    from viscofric.study.run_file.study import TABLES, Study

    text = (EXAMPLE / "study.toml").read_text(encoding="utf-8")
    commented = ("# [", *(f"# {key} = " for table in TABLES.values() for key in keys(table)))
    behind_comments = "\n".join(
        line.removeprefix("# ") if line.startswith(commented) else line for line in text.splitlines()
    )
    written = tomllib.loads(behind_comments)
    # A surface stands in the place of an indenter, with some conditions of its own, in another starter file.
    surface = (EXAMPLE.parent / "templates" / "surface.toml").read_text(encoding="utf-8")
    for key in keys(Study):
        assert key in written or key == "surface"
        for name in keys(TABLES[key]) if key in TABLES else ():
            assert name in written.get(key, ()) or f"\n{name} = " in surface.replace("\n# ", "\n"), f"[{key}] {name}"


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
@pytest.mark.parametrize(
    ("sent", "status", "word"),
    [(signal.SIGTERM, 143, "Terminated."), *apart((signal.SIGINT, 130, "Interrupted."))],
)
def test_signals_end_a_run_with_one_sentence(tmp_path: Path, sent: signal.Signals, status: int, word: str) -> None:
    write(tmp_path)
    with subprocess.Popen(
        [sys.executable, "-m", "viscofric", "run", "study.toml"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # Where the tests run in the background of a shell, it has them ignore Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as program:
        try:
            assert program.stderr is not None
            program.stderr.readline()  # the first stage has begun
            program.send_signal(sent)
            _, errors = program.communicate(timeout=500)  # a second, but the machine may be busy
        finally:
            program.kill()
    assert program.returncode == status
    assert word in errors
    assert "Traceback" not in errors
    assert "Aborted" not in errors


@pytest.mark.slow
@pytest.mark.parametrize("place", ["viscofric.cli.report", "viscofric.report.figures.study"])
def test_interruption_while_modules_load_is_one_sentence(finished: Path, tmp_path: Path, place: str) -> None:
    (tmp_path / "interrupts.py").write_text(
        "import sys\n"
        "class Finder:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        f"        if name == {place!r}: raise KeyboardInterrupt\n"
        "sys.meta_path.insert(0, Finder())\n"
        "from viscofric.cli import main\n"
        f"main(['report', {finished.name!r}])\n"
    )
    done = subprocess.run([sys.executable, "interrupts.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 130, done.stderr
    assert done.stderr.strip() == "Interrupted."


@pytest.mark.apart
def test_matplotlib_writes_nothing_to_the_home_folder(finished: Path, tmp_path: Path) -> None:
    home = tmp_path / "home"
    home.mkdir()
    few = open_results(finished)
    for name in ("isotherms", "shift_factors", "master_curve", "prediction"):
        del few.tree[name]  # one figure is enough to make matplotlib look for its folders
    save_results(few.tree, finished)
    unset = {"HOME": str(home), "MPLCONFIGDIR": "", "XDG_CACHE_HOME": "", "XDG_CONFIG_HOME": ""}
    script = "import os; [os.environ.pop(name, None) for name in ('MPLCONFIGDIR', 'XDG_CACHE_HOME', 'XDG_CONFIG_HOME')]"
    script += "; from viscofric.cli import main; main(['report', 'finished.results'])"
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        env={**os.environ, **unset},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    if sys.prefix != sys.base_prefix and os.access(sys.prefix, os.W_OK):
        assert list(home.iterdir()) == []


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device here that is always full")
def test_output_to_a_full_disk_is_one_sentence() -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "viscofric", "material", "list"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert (done.returncode, done.stderr) == (1, "Error: the output: No space left on device.\n")


@pytest.mark.apart
def test_interruption_keeps_finished_cases(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(tmp_path, study=STUDY.replace('"100 mm/s"', '["100 mm/s", "200 mm/s"]'))
    from viscofric.study.running import executors

    attempt, calls = executors.attempt, []

    def interrupted(*arguments: object, **options: object) -> object:
        calls.append(arguments)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return attempt(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(executors, "attempt", interrupted)
    result = call("run", path)
    assert result.exit_code == 130
    assert "--resume" in result.stderr
    assert len(list((tmp_path / "study.results" / "cases").iterdir())) == 1
    monkeypatch.setattr(executors, "attempt", attempt)
    unfinished = refusal("run", path)
    assert (unfinished.status, unfinished.code) == (1, "not-empty")
    succeed("run", path, "--resume")
    assert refusal("run", path)[:2] == (1, "not-empty")


@pytest.mark.apart
def test_programs_are_reported_a_run_line_by_line(once: Path, tmp_path: Path) -> None:
    """Nothing else on standard output, and on standard error nothing but warnings."""
    study = write(tmp_path)
    shutil.copytree(once, tmp_path / "study.results")
    result = call("run", study, "--resume", "--json")
    assert result.exit_code == 0
    events = [json.loads(line) for line in result.stdout.splitlines()]
    assert [event["event"] for event in events[:2]] == ["started", "stage"]
    (finished,) = [event for event in events if event["event"] == "finished"]
    assert events[-1] == finished
    assert finished["failures"] == []
    assert all(Path(finished[name]).is_file() for name in ("data", "report"))
    stored = [event for event in events if event["event"] == "stored"]
    assert {event["stage"] for event in stored} == {"contacts"}
    assert len({event["key"] for event in stored}) == len(stored) == len(list(once.glob("cases/*.json")))
    quiet = call("run", study, "--resume", "--quiet")
    assert (quiet.exit_code, quiet.stdout) == (0, "")
    assert quiet.stderr == result.stderr
    failed = call("run", study, "--json")
    assert json.loads(failed.stdout.splitlines()[-1]) == {"event": "error", "message": refusal_of(failed).sentence}
