"""``viscofric compare A B``: whether two results say the same, and where they differ."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import as_command
from viscofric.cli.errors import words_of
from viscofric.cli.files import CSV, DASH
from viscofric.cli.output import outputs, print_json, write_rows

if TYPE_CHECKING:
    from viscofric.study.results.compare import ResultsComparison, VariableDifference

DIFFERENT, TROUBLE = 1, 2
_MOST_SENTENCES = 12
_EXAMPLE = """\b
Example:
  viscofric compare before.results after.results --tolerance 1e-3
"""


@as_command("compare", epilog=_EXAMPLE)
@click.argument("first", type=click.Path(path_type=Path))
@click.argument("second", type=click.Path(path_type=Path))
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0.0),
    metavar="SHARE",
    help="Largest relative difference accepted as equal; 0: identical digits [default: twice the stated errors].",
)
@outputs("Write the table of differences (CSV); `-` prints it.", endings=CSV)
def command(first: Path, second: Path, tolerance: float | None, out: Path | None, as_json: bool) -> None:
    """Compare two results case by case: folders of studies, results.nc files or tables of friction curves (CSV).

    Exit status: 0 equal, 1 different, 2 not comparable, or a result is missing or damaged.
    """
    from viscofric.errors import ViscofricError
    from viscofric.study.results.results import compare_results

    try:
        found = compare_results(first, second, tolerance=tolerance)
        if out is not None:
            from viscofric.study.results.case_table import shown_place

            line = found.load_unit == "N/m"
            write_rows(out, [asdict(one) | {"where": shown_place(one.where, line)} for one in found.differences])
    except ViscofricError as error:
        click.echo(f"Error: {words_of(error)}", err=True)
        sys.exit(TROUBLE)
    if as_json:
        print_json(_record(first, second, found))
    elif out != DASH:
        _print(first, second, found)
    sys.exit(0 if found.equal else DIFFERENT)


def _print(first: Path, second: Path, found: ResultsComparison) -> None:
    from viscofric.showing import aligned

    click.echo(f"A  {first}\nB  {second}\n")
    only = f", {found.only_first} only in A, {found.only_second} only in B" if found.axes else ""
    click.echo(f"{found.cases} cases in common{only}")
    if found.solved_once:
        click.echo(f"{found.solved_once} of them solved in one only")
    sentences = [*found.axes, *found.provenance]
    for sentence in sentences[:_MOST_SENTENCES]:
        click.echo(sentence)
    if len(sentences) > _MOST_SENTENCES:
        click.echo(f"… and {len(sentences) - _MOST_SENTENCES} more differences of how they came about (--json has all)")
    if found.differences:
        click.echo()
        heading = ["", "largest", "rms", "in errors", "A", "B", "where"]
        rows = [_row(one, found.load_unit == "N/m") for one in found.differences]
        for words in aligned([heading, *rows]):
            click.echo(words)
    click.echo(f"\n{_verdict(found)}")


def _row(one: VariableDifference, line: bool) -> list[str]:
    from viscofric.report.texts.numbers import ABSENT, significant
    from viscofric.study.results.case_table import shown_place

    mark = "" if one.equal else " *"
    errors = ABSENT if one.in_errors is None else significant(one.in_errors, 2)
    where = shown_place(one.where, line) if one.largest else ABSENT
    unit = "" if one.unit == "1" else f" ({one.unit})"
    values = (f"{value:.6g}" for value in (one.first, one.second))
    return [f"{one.name}{unit}{mark}", f"{one.largest:.1e}", f"{one.rms:.1e}", errors, *values, where]


def _verdict(found: ResultsComparison) -> str:
    within = "twice the stated errors" if found.tolerance is None else f"a relative difference of {found.tolerance:g}"
    if found.equal:
        return f"The same within {within}."
    wrong = [one.name for one in found.differences if not one.equal]
    if wrong:
        return f"Different: {', '.join(wrong)} beyond {within} (marked *)."
    return f"Different cases; those in common are the same within {within}."


def _record(first: Path, second: Path, found: ResultsComparison) -> dict[str, Any]:
    return {
        "format": "viscofric comparison 1",
        "inputs": {"first": str(first), "second": str(second), "tolerance": found.tolerance},
        "equal": found.equal,
        **{name: value for name, value in asdict(found).items() if name != "tolerance"},
    }
