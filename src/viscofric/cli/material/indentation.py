"""``viscofric material indentation FILES``: a material identified from indentation tests."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.contact_options import chosen_indenter, elastic_options, indenter_options
from viscofric.cli.errors import reported_errors
from viscofric.cli.files import CSV, FILE, JSON, Source, check_ending, refuse_to_overwrite
from viscofric.cli.rubber_options import column_options

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.friction.identification.indentation.record import Control

_EXAMPLE = """\b
Example:
  viscofric material indentation creep.csv --control load --ball "10 mm" \\
      --temperature "23 degC" --out rubber.json
"""


@click.command(name="indentation", epilog=_EXAMPLE)
@click.argument("files", nargs=-1, required=True, type=Source())
@click.option(
    "--control",
    type=click.Choice(["load", "indentation"]),
    required=True,
    help="Prescribed quantity: load (creep) or indentation (relaxation).",
)
@indenter_options
@elastic_options
@click.option(
    "--temperature",
    "temperatures",
    metavar="T",
    multiple=True,
    help="Temperature of a file without this column, e.g. '23 degC'; one for all files, or repeated for each.",
)
@column_options("'load=Fz (N)'")
@click.option("--error", metavar="SIZE", help="Standard error of the response, e.g. '0.1 um' [default: found].")
@click.option("--start", metavar="TIME", help="Time of the first contact [default: that of the first row].")
@click.option("--reference", metavar="T", help="Reference temperature of the material, e.g. '30 degC'.")
@click.option("--poisson-ratio", type=float, default=0.5, show_default=True, help="Poisson's ratio, 0 to 0.5.")
@click.option("--modes", type=int, default=30, show_default=True, help="Least number of retardation times.")
@click.option("--samples", type=int, default=200, show_default=True, help="Number of uncertainty samples.")
@click.option("--seed", type=int, default=0, show_default=True, help="Random seed of the samples.")
@click.option("--name", default="identified from indentation", show_default=True, help="Name of the material.")
@click.option("--out", type=FILE, help="Write the material (JSON), for `solve`, run files and `material`.")
@click.option("--csv", "table", type=FILE, help="Write the moduli with their 95 % limits (CSV).")
@click.option("--json", "as_json", is_flag=True, help="Print the moduli and the notes as JSON, in SI units.")
def command(
    files: tuple[Path, ...],
    control: Control,
    temperatures: tuple[str, ...],
    columns: dict[str, str],
    sheet: str | None,
    error: str | None,
    start: str | None,
    out: Path | None,
    table: Path | None,
    as_json: bool,
    **parameters: Any,
) -> None:
    """Identify a material from indentation tests in FILES: creep, relaxation, ramps and holds.

    FILES are tables of time, load and indentation, with units in the headings.
    """
    check_ending(out, "--out", JSON)
    check_ending(table, "--csv", CSV)
    for target in (out, table):
        if target is not None:
            refuse_to_overwrite(target, files)
    if len(temperatures) not in (0, 1, len(files)):
        raise click.UsageError(f"--temperature is given {len(temperatures)} times for {len(files)} files.")
    with reported_errors():
        from viscofric.datasets import record
        from viscofric.friction.identification.indentation.identify import identify_from_indentation
        from viscofric.friction.identification.indentation.record import read_indentation
        from viscofric.notes import listed
        from viscofric.rheology.cards import write_card

        shape = chosen_indenter(parameters)
        kelvin = temperatures if len(temperatures) == len(files) else (temperatures or (None,)) * len(files)
        records = [
            read_indentation(
                path, control=control, temperature=at, error=error, start=start, columns=columns, sheet=sheet
            )
            for path, at in zip(files, kelvin, strict=True)
        ]
        names = ("reference", "poisson_ratio", "indenter_modulus", "modes", "samples", "seed", "name")
        settings = {name: parameters[name] for name in names}
        if parameters["indenter_poisson_ratio"] is not None:
            settings["indenter_poisson_ratio"] = parameters["indenter_poisson_ratio"]
        found = identify_from_indentation(records, shape.indenter, **settings)
        data = found.to_dataset()
        if as_json:
            said = {"results": record(data), **listed("notes", found.notes)}
            click.echo(json.dumps(said, indent=2, ensure_ascii=False, allow_nan=False))
        else:
            click.echo(str(found))
        if out is not None:
            write_card(found.material, out, format="json")
            click.echo(f"material {out}", err=as_json)
        if table is not None:
            data.to_dataframe().to_csv(table)
            click.echo(f"table    {table}", err=as_json)
