"""``viscofric run STUDY.toml``: the main job."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli import INTERRUPTED, TERMINATED, Terminated
from viscofric.cli.commands import NOT_ACCURATE, SOME_CASES_FAILED, as_command
from viscofric.cli.errors import print_doubtful_checks, print_notes
from viscofric.cli.files import FOLDER
from viscofric.cli.output import RUN_JSON, outputs, print_written
from viscofric.notes import listed

if TYPE_CHECKING:
    from viscofric.study.results.results import StudyResults

#: Checks of the numbers themselves; others judge the assumptions and the data.
_NUMERICAL = ("Accuracy", "Energy balance", "Contact conditions")
# As many notes and kinds of failure are printed; the report has them all.
_MOST_LINES = 5
# Checks that a study reports as warnings, notes or failures of its own.
_REPORTED_OTHERWISE = (
    "Small strain",
    "Linear viscoelasticity",
    "Half-space",
    "Measured frequency range",
    "Isotherms used",
    "All cases solved",
    "Accuracy",
)


@as_command("run")
@click.argument("study", type=click.Path(path_type=Path))
@click.option(
    "--resume",
    is_flag=True,
    help="Continue in a folder with results: solved contacts are reused, even if the run file has changed.",
)
@click.option(
    "--finished-only",
    is_flag=True,
    help="Solve nothing; write results and report of the contacts that an interrupted run has solved.",
)
@click.option("--workers", type=click.IntRange(min=1), metavar="N", help="Number of processes on this machine.")
@click.option("--scheduler", metavar="ADDRESS", help="Address of a Dask scheduler, e.g. tcp://10.0.0.1:8786.")
@click.option("-q", "--quiet", is_flag=True, help="Print only errors, warnings and failed cases.")
@outputs("Folder for the results [default: STUDY.results beside the run file].", FOLDER, json=RUN_JSON)
def command(study: Path, out: Path | None, **how: Any) -> None:
    """Run a study: from DMA sweeps to friction, figures and a report.

    STUDY is a run file (TOML). Every contact is stored as soon as it is solved: --resume continues an interrupted
    study, with identical results. The results do not depend on the number of workers.
    """
    run_and_report(study, study.with_suffix(".results") if out is None else out, **how)


def run_and_report(study: Path, output: Path, *, as_json: bool = False, quiet: bool = False, **how: Any) -> None:
    """Run a study, write its report, and name what was written; leaves the program where that failed."""
    try:
        from viscofric.cli.progress import JsonProgress, Silent, TerminalProgress
        from viscofric.errors import ViscofricError
        from viscofric.report import write_figures_and_report
        from viscofric.study.execution import run_study
        from viscofric.study.running.running import Event

        listener = JsonProgress(sys.stdout) if as_json else Silent() if quiet else TerminalProgress()
        try:
            with listener as progress:
                progress.write("started", study=str(study), folder=str(output))
                results = run_study(study, output=output, progress=progress, **how)
                progress(Event("stage", stage="report", done=0, total=1))
                figures, report = write_figures_and_report(results.tree, results.folder)
                progress(Event("stage", stage="report", done=1, total=1))
                _insist_on(Path(results.folder / "results.nc"), report, *figures)
        except ViscofricError as error:
            # A full disk, for one, ends a study as an interrupt does.
            said = error.listing("run_file") + (_kept(output) if error.code == "not-written" else "")
            listener.write("error", message=said)
            raise click.ClickException(said) from error
        except KeyboardInterrupt as stop:
            listener.write("terminated" if isinstance(stop, Terminated) else "interrupted", folder=str(output))
            raise
    except KeyboardInterrupt as stop:
        terminated = isinstance(stop, Terminated)
        click.echo(("Terminated." if terminated else "Interrupted.") + _kept(output), err=True)
        sys.exit(TERMINATED if terminated else INTERRUPTED)
    listener.write("finished", **outcome_record(results, figures, report))
    print_outcome(results, quiet=quiet or as_json)
    if not (quiet or as_json):
        data = results.folder / "results.nc"
        print_written(("data", data), ("report", report), figures=figures)
    if status := status_of(results):
        sys.exit(status)


def outcome_record(results: StudyResults, figures: list[Path], report: Path) -> dict[str, Any]:
    """Return the failures, warnings, notes and checks of a study, and the files of its report, in plain types."""
    from viscofric.report.texts.checks import all_checks

    return {
        **listed("failures", results.failures),
        **listed("warnings", results.warnings),
        **listed("notes", results.notes),
        "checks": [check.record("run_file") for check in all_checks(results.tree)],
        "beyond_accuracy": results.beyond_accuracy if "prediction" in results.tree.children else 0,
        "exit_status": status_of(results),
        "figures": figures,
        "data": results.folder / "results.nc",
        "report": report,
    }


def status_of(results: StudyResults) -> int:
    """Return the exit status of results: failed cases, or a numerical check that is not met."""
    from viscofric.report.texts.checks import all_checks

    if results.failures:
        return SOME_CASES_FAILED
    checks = all_checks(results.tree)
    unmet = (check.verdict == "failed" or (check.name in _NUMERICAL and check.holds is False) for check in checks)
    return NOT_ACCURATE if any(unmet) else 0


def _insist_on(*written: Path) -> None:
    """Raise `DataFileError` if a file that was written is there no more."""
    from viscofric.errors import DataFileError

    for path in written:
        if not path.is_file():
            raise DataFileError(
                path, "was removed while the study ran; run it again, and leave its folder alone.", code="removed"
            )


def _kept(output: Path) -> str:
    """Say what a study that ended too early leaves, and what goes on with it."""
    solved = sum(1 for _ in output.glob("cases/*.json")) if output.is_dir() else 0
    contacts = "1 contact that is" if solved == 1 else f"{solved} contacts that are"
    return f" {output} keeps the {contacts} solved; the same command with --resume continues." if solved else ""


def print_outcome(results: StudyResults, quiet: bool = False) -> None:
    """Print notes (unless it is to be quiet), warnings and failures: few of each, the report has them all."""
    from viscofric.report.texts.study import grouped_failures

    notes = () if quiet else tuple(dict.fromkeys(results.notes))
    if len(notes) > _MOST_LINES:
        click.echo(f"{len(notes)} notes on the data: see the report.", err=True)
    elif notes:
        many = f"{len(notes)} notes" if len(notes) > 1 else "1 note"
        click.echo(f"{many} on the data, also in the report:", err=True)
        print_notes(notes, "run_file")
    print_notes(results.warnings, "run_file", word="Warning")
    print_doubtful_checks(results.tree, but=_REPORTED_OTHERWISE)
    for line in grouped_failures(results.failures, _MOST_LINES):
        click.echo(f"Failed: {line}", err=True)
