"""``viscofric report RESULTS``: figures and report again, from the stored results."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from viscofric.cli.commands import as_command
from viscofric.cli.files import FOLDER
from viscofric.cli.output import outputs, print_json, print_written


@as_command("report", reader="run_file")
@click.argument("results", type=click.Path(path_type=Path))
@outputs(
    "Folder for report.html and figures [default: RESULTS].",
    FOLDER,
    json="Print the written files, and what the report says of failed cases and checks, as JSON.",
)
def command(results: Path, out: Path | None, as_json: bool) -> None:
    """Write figures and report of a study again, from its RESULTS folder; the exit status is that of `run`."""
    from viscofric.cli.run import outcome_record, print_outcome, status_of
    from viscofric.report import write_figures_and_report
    from viscofric.study.results.results import open_results

    found = open_results(results)
    figures, report = write_figures_and_report(found.tree, found.folder if out is None else out)
    print_outcome(found, quiet=True)
    if as_json:
        print_json(outcome_record(found, figures, report))
    else:
        print_written(("report", report), figures=figures)
    sys.exit(status_of(found))
