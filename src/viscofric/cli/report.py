"""``viscofric report RESULTS``: figures and report again, from the stored results."""

from __future__ import annotations

from pathlib import Path

import click


@click.command(name="report")
@click.argument("results", type=click.Path(path_type=Path))
@click.option(
    "--output",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for report.html and figures [default: RESULTS].",
)
def command(results: Path, output: Path | None) -> None:
    """Write figures and report of a study again, from its RESULTS folder."""
    from viscofric.errors import ViscofricError
    from viscofric.report import write_figures_and_report
    from viscofric.study import open_results

    try:
        found = open_results(results)
        figures, report = write_figures_and_report(found.tree, found.folder if output is None else output)
        for figure in figures:
            click.echo(f"figure   {figure}")
        click.echo(f"report   {report}")
    except ViscofricError as error:
        raise click.ClickException(str(error)) from error
