"""``viscofric export RESULTS --to FORMAT``: results for other programs."""

from __future__ import annotations

from pathlib import Path

import click

from viscofric.cli.errors import reported_errors
from viscofric.cli.files import DASH, check_ending

# format -> how its file's name ends
_ENDINGS = {"csv": ".csv", "excel": ".xlsx", "netcdf": ".nc", "zarr": ".zarr"}
_EXAMPLE = """\b
Example:
  viscofric export study.results --to excel
  viscofric export study.results --to csv -o - | head
"""


@click.command(name="export", epilog=_EXAMPLE)
@click.argument("results", type=click.Path(path_type=Path))
@click.option(
    "--to",
    "forms",
    required=True,
    multiple=True,
    type=click.Choice(list(_ENDINGS)),
    help="Output format; Excel has all tables, the others the cases. Repeat for several formats.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, allow_dash=True),
    help="Output file; `-` prints a csv [default: results.csv, results.xlsx, prediction.nc or "
    "prediction.zarr in the results folder].",
)
def command(results: Path, forms: tuple[str, ...], output: Path | None) -> None:
    """Export RESULTS, a study's results folder or its results.nc, to other formats.

    csv: a row for each case, units in the headings. excel: a workbook with a sheet for each table. netcdf, zarr:
    the cases over their axes, as labelled data.
    """
    forms = tuple(dict.fromkeys(forms))
    if output is not None and len(forms) > 1:
        raise click.BadParameter(
            "names one file, but several formats are requested; leave it out.", param_hint="--output"
        )
    if output == DASH and forms != ("csv",):
        raise click.BadParameter(f"{forms[0]} cannot be printed; name a file.", param_hint="--output")
    check_ending(output, "--output", (_ENDINGS[forms[0]],))
    with reported_errors():
        from viscofric.study import open_results
        from viscofric.study.results.columns import table_text
        from viscofric.study.results.export import FORMS

        found = open_results(results)
        if output == DASH:
            click.echo(table_text(found.dataset), nl=False)
            return
        for form in forms:
            click.echo(f"{form:<8} {found.export(FORMS[list(_ENDINGS).index(form)], output)}")
