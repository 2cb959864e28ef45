"""``viscofric run STUDY.toml``: the main job."""

from __future__ import annotations

import sys
from pathlib import Path

import click

SOME_CASES_FAILED = 3
INTERRUPTED = 130


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
    from viscofric.cli.progress import TerminalProgress
    from viscofric.errors import ViscofricError
    from viscofric.report import draw_figures, write_report
    from viscofric.study import run_study

    try:
        with TerminalProgress() as progress:
            results = run_study(study, output=output, progress=progress)
            progress("report", 0, 1)
            figures = draw_figures(results.tree, results.folder / "figures")
            report = write_report(results.tree, results.folder)
            progress("report", 1, 1)
    except ViscofricError as error:
        raise click.ClickException(str(error)) from error
    except KeyboardInterrupt:
        click.echo(f"Interrupted. Finished cases are kept in {output}; the same command continues.", err=True)
        sys.exit(INTERRUPTED)
    for warning in results.warnings:
        click.echo(f"Warning: {warning}", err=True)
    for figure in figures:
        click.echo(f"figure   {figure}")
    click.echo(f"data     {results.folder / 'results.nc'}")
    click.echo(f"report   {report}")
    if results.failures:
        for failure in results.failures:
            click.echo(f"Failed: {failure}", err=True)
        sys.exit(SOME_CASES_FAILED)
