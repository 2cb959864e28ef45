"""``viscofric material indentation FILES``: a material identified from indentation tests."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from viscofric.cli.commands import as_command, quantity
from viscofric.cli.contact_options import chosen_indenter, elastic_options, elastic_settings, indenter_options
from viscofric.cli.errors import typed_as
from viscofric.cli.files import CSV, WRITTEN, Source, check_ending, refuse_to_overwrite
from viscofric.cli.friction_sources import is_of_synthetic
from viscofric.cli.identify import chosen_beside, chosen_shift, identified_options
from viscofric.cli.output import answer, drawing, is_synthetic, write_files
from viscofric.cli.rubber_options import column_options

_EXAMPLE = """\b
Example:
  viscofric material indentation creep.csv --control load --ball "10 mm" \\
      --temperature "23 degC" --out rubber.json
"""


@as_command("indentation", epilog=_EXAMPLE)
@click.argument("files", nargs=-1, required=True, type=Source())
@click.option(
    "--control",
    type=click.Choice(["load", "indentation"]),
    help="Prescribed quantity of load and indentation over time.",
)
@quantity("--depth", "DEPTH", "Mean depth; FILES are tables of frequency and stiffness, e.g. '100 um'.")
@quantity("--amplitude", "DEPTH", "Amplitude of the depth about --depth, e.g. '2 um'.")
@quantity("--mass", "MASS", "Mass of the indenter; FILES are tables of rebounds, e.g. '33 g'.")
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
@quantity(
    "--error",
    "SIZE",
    "Standard error of the response, e.g. '0.1 um' [default: found]; relative, e.g. 0.01, with --mass or --depth.",
)
@quantity("--start", "TIME", "Time of the first contact [default: that of the first row].")
@click.option("--radius-error", default=0.0, help="Standard error of the indenter's radius, relative.")
@click.option("--load-error", default=0.0, help="Relative standard error of the load cell's gain.")
@quantity("--zero-error", "DEPTH", "Standard error of the zero of the depth.", default="0 m")
@click.option("--csv", "table", type=WRITTEN, help="Write the moduli with their 95 % limits (CSV).")
@identified_options("identified from indentation", "Draw the moduli with their limits, and every fit")
def command(
    files: tuple[Path, ...],
    temperatures: tuple[str, ...],
    out: Path | None,
    table: Path | None,
    picture: Path | None,
    synthetic: bool,
    **parameters: Any,
) -> None:
    """Identify a material from indentation tests and rebounds in FILES.

    FILES are tables with units in the headings: of time, load and indentation (--control); of frequency, storage and
    loss stiffness (--depth); or of speed, and restitution, contact time, peak force or indentation (--mass).
    """
    check_ending(table, "--csv", CSV)
    refuse_to_overwrite(files, out, table, picture)
    if len(temperatures) not in (0, 1, len(files)):
        raise click.UsageError(f"--temperature is given {len(temperatures)} times for {len(files)} files.")
    if sum(parameters[name] is not None for name in ("control", "depth", "mass")) != 1:
        raise click.UsageError("give one of --control, --depth and --mass.")
    from viscofric.datasets import record
    from viscofric.friction.identification.indentation.identify import identify_from_indentation
    from viscofric.notes import listed
    from viscofric.rheology.cards import write_card

    shape = chosen_indenter(parameters)
    known = chosen_beside(parameters, picture)
    kelvin = temperatures if len(temperatures) == len(files) else (temperatures or (None,)) * len(files)
    records = [one for path, at in zip(files, kelvin, strict=True) for one in _records(path, at, parameters)]
    found = identify_from_indentation(records, shape.indenter, **_settings(parameters))
    made_up = found.material.synthetic or is_synthetic(synthetic, files) or is_of_synthetic(parameters["shift"])
    material = replace(found.material, synthetic=made_up)
    data = found.to_dataset()
    answer(lambda: {"results": record(data), **listed("notes", found.notes)}, lambda: click.echo(str(found)))
    write_files(
        ("material", out, lambda path: write_card(material, path, format="json")),
        ("table", table, data.to_dataframe().to_csv),
        ("picture", picture, drawing("identified.indentation_figure", found, known, mark=made_up)),
    )


def _records(path: Path, temperature: str | None, parameters: dict[str, Any]) -> list[Any]:
    """Return the records of a file."""
    from viscofric.friction.identification.indentation.reading import read_indentation, read_oscillation, read_rebound

    common = {name: parameters[name] for name in ("columns", "sheet")} | {"temperature": temperature}
    if parameters["control"] is not None:
        return [read_indentation(path, **common, **{name: parameters[name] for name in ("control", "error", "start")})]
    if parameters["error"] is None:
        raise click.UsageError("--error is the relative standard error of the values, e.g. 0.01; give it.")
    if parameters["mass"] is not None:
        return read_rebound(path, mass=parameters["mass"], error=parameters["error"], **common)
    if parameters["amplitude"] is None:
        raise click.UsageError("--depth needs the --amplitude of the oscillation.")
    given = {name: parameters[name] for name in ("amplitude", "error")}
    with typed_as({"indentation": "depth"}):
        return read_oscillation(path, indentation=parameters["depth"], **given, **common)


def _settings(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return the arguments of `identify_from_indentation`."""
    errors = ("radius_error", "load_error", "zero_error")
    names = ("reference", "poisson_ratio", "modes", "samples", "seed", "name", *errors)
    return {name: parameters[name] for name in names} | elastic_settings(parameters) | chosen_shift(parameters)
