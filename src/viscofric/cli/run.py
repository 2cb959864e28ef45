"""``viscofric run STUDY.toml``: the main job."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from viscofric.cli import INTERRUPTED, TERMINATED, Terminated
from viscofric.cli.errors import tell_doubts

if TYPE_CHECKING:
    from viscofric.study import StudyResults

SOME_CASES_FAILED = 3
# As many notes and kinds of failure are printed; the report has them all.
_MOST_LINES = 5
# Checks that a study tells as warnings, notes or failures of its own.
_TOLD_OTHERWISE = ("Small strain", "Linear rubber", "Measured frequency range", "Isotherms used", "All cases solved")


@click.command(name="run")
@click.argument("study", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the results [default: STUDY.results beside the run file].",
)
def command(study: Path, output: Path | None) -> None:
    """Run a study: DMA sweeps in, friction, figures and a report out.

    STUDY is a run file (TOML).  Cases that the output folder already holds are not solved again, so an
    interrupted study continues where it stopped.
    """
    run_and_report(study, study.with_suffix(".results") if output is None else output)


def run_and_report(study: Path, output: Path) -> None:
    """Run a study, write its report, and name what was written; leaves the program where that failed."""
    try:
        from viscofric.cli.progress import TerminalProgress
        from viscofric.errors import ViscofricError
        from viscofric.report import write_figures_and_report
        from viscofric.study import run_study

        try:
            with TerminalProgress() as progress:
                results = run_study(study, output=output, progress=progress)
                progress("report", 0, 1)
                figures, report = write_figures_and_report(results.tree, results.folder)
                progress("report", 1, 1)
        except ViscofricError as error:
            raise click.ClickException(str(error)) from error
    except KeyboardInterrupt as stop:
        terminated = isinstance(stop, Terminated)
        kept = f" Finished cases are kept in {output}; the same command continues." if output.is_dir() else ""
        click.echo(("Terminated." if terminated else "Interrupted.") + kept, err=True)
        sys.exit(TERMINATED if terminated else INTERRUPTED)
    tell(results)
    for figure in figures:
        click.echo(f"figure   {figure}")
    click.echo(f"data     {results.folder / 'results.nc'}")
    click.echo(f"report   {report}")
    if results.failures:
        sys.exit(SOME_CASES_FAILED)


def tell(results: StudyResults) -> None:
    """Print notes, warnings and failures of a study: few of each, the report has them all."""
    from viscofric.report.messages import grouped_failures, readable

    notes = results.notes
    if len(notes) > _MOST_LINES:
        click.echo(f"{len(notes)} notes on the data: see the report.", err=True)
    elif notes:
        many = f"{len(notes)} notes" if len(notes) > 1 else "1 note"
        click.echo(f"{many} on the data, also in the report:", err=True)
        for note in notes:
            click.echo(f"Note: {readable(note)}", err=True)
    for warning in results.warnings:
        click.echo(f"Warning: {readable(warning)}", err=True)
    tell_doubts(results.tree, but=_TOLD_OTHERWISE)
    for line in grouped_failures(results.failures, _MOST_LINES):
        click.echo(f"Failed: {line}", err=True)
