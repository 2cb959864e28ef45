"""``viscofric export RESULTS --to FORMAT``: results for other programs."""

from __future__ import annotations

from pathlib import Path

import click

from viscofric.cli.commands import as_command
from viscofric.cli.files import DASH, Written, check_ending
from viscofric.cli.output import outputs, print_json, print_written

# format -> how its file's name ends
_ENDINGS = {"csv": ".csv", "excel": ".xlsx", "netcdf": ".nc"}
_EXAMPLE = """\b
Example:
  viscofric export study.results --to excel
  viscofric export study.results --to csv -o - | head
"""


@as_command("export", epilog=_EXAMPLE)
@click.argument("results", type=click.Path(path_type=Path))
@click.option(
    "--to",
    "forms",
    multiple=True,
    type=click.Choice(list(_ENDINGS)),
    help="Output format; Excel has all tables, the others the cases. Repeat for several formats [default: that of "
    "--out].",
)
@outputs(
    "Output file; `-` prints a csv [default: results.csv, results.xlsx, or prediction.nc in the results folder].",
    Written(allow_dash=True),
    json="Print the written files as JSON.",
)
def command(results: Path, forms: tuple[str, ...], out: Path | None, as_json: bool) -> None:
    """Export RESULTS, a study's results folder or its results.nc, to other formats.

    csv: a row for each case, units in the headings. excel: a workbook with a sheet for each table. netcdf: the
    cases over their axes, as labelled data.
    """
    forms = tuple(dict.fromkeys(forms)) or _by_ending(out)
    if out is not None and len(forms) > 1:
        raise click.BadParameter("names one file, but several formats are requested; leave it out.", param_hint="--out")
    if out == DASH and forms != ("csv",):
        raise click.BadParameter(f"{forms[0]} cannot be printed; name a file.", param_hint="--out")
    check_ending(out, "--out", (_ENDINGS[forms[0]],))
    from viscofric.study.results.columns import table_text
    from viscofric.study.results.export import FORMS
    from viscofric.study.results.file import OTHER_CASES
    from viscofric.study.results.results import open_results

    found = open_results(results)
    others = [words for group, words in OTHER_CASES.items() if group in found.tree.children]
    if others and forms != ("excel",):
        click.echo(f"Only the workbook (--to excel) has {', '.join(others)}.", err=True)
    if out == DASH:
        click.echo(table_text(found.dataset), nl=False)
        return
    written = {form: found.export(FORMS[list(_ENDINGS).index(form)], out) for form in forms}
    if as_json:
        print_json({"results": results, "files": written})
    else:
        print_written(*written.items())


def _by_ending(out: Path | None) -> tuple[str, ...]:
    """Return the format that the name of the output ends with."""
    if out == DASH:
        return ("csv",)
    found = tuple(form for form, ending in _ENDINGS.items() if out is not None and out.suffix.lower() == ending)
    if not found:
        raise click.UsageError(f"give --to, one of {', '.join(_ENDINGS)}, or --out with the ending of one.")
    return found
