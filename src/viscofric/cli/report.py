"""``viscofric report RESULTS``: figures and report again, from the stored results."""

from __future__ import annotations

from pathlib import Path

import click


@click.command(name="report")
@click.argument("results", type=click.Path(path_type=Path))
def command(results: Path) -> None:
    """Write figures and report of a finished study again, from its RESULTS folder."""
    from viscofric.errors import ViscofricError
    from viscofric.report import write_figures_and_report
    from viscofric.study import open_results

    try:
        found = open_results(results)
        figures, report = write_figures_and_report(found.tree, found.folder)
        for figure in figures:
            click.echo(f"figure   {figure}")
        click.echo(f"report   {report}")
    except ViscofricError as error:
        raise click.ClickException(str(error)) from error
