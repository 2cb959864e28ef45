"""``viscofric report RESULTS``: figures and report again, from the stored results."""

from __future__ import annotations

from pathlib import Path

import click


@click.command(name="report")
@click.argument("results", type=click.Path(path_type=Path))
def command(results: Path) -> None:
    """Write figures and report of a finished study again, from its RESULTS folder."""
    from viscofric.errors import ViscofricError
    from viscofric.report import draw_figures, write_report
    from viscofric.study import open_results

    try:
        found = open_results(results)
        for figure in draw_figures(found.tree, found.folder / "figures"):
            click.echo(f"figure   {figure}")
        click.echo(f"report   {write_report(found.tree, found.folder)}")
    except ViscofricError as error:
        raise click.ClickException(str(error)) from error
