"""``viscofric material ramp FILES``: glass transition of temperature ramps, and a material made of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from viscofric.cli.commands import as_command, quantity
from viscofric.cli.errors import print_notes
from viscofric.cli.files import FOLDER, Source
from viscofric.cli.keys import key, table_of
from viscofric.cli.output import outputs, print_json, print_written, typed_command
from viscofric.cli.rubber_options import column_options
from viscofric.notes import listed


@as_command("ramp")
@click.argument("files", nargs=-1, required=True, type=Source())
@column_options("'frequency=f in Hz'")
@key("material.modulus_unit", metavar="UNIT")
@key("material.deformation")
@click.option(
    "--direction", type=click.Choice(["heating", "cooling"]), help="Part of a file with both [default: heating]."
)
@quantity("--heating-rate", "RATE", "Heating rate, e.g. '3 K/min', for the note on thermal lag.")
@key(
    "material.reference_temperature",
    "--reference",
    metavar="T",
    help="Make a material with this reference temperature, e.g. '20 degC'.",
)
@click.option(
    "--law",
    type=click.Choice(["wlf", "arrhenius", "vft", "wlf+arrhenius"]),
    default="wlf",
    help="Shift law to fit; wlf+arrhenius if the ramps begin in the glass.",
)
@key("material.assumed_shift", metavar="LAW")
@key("material.poisson_ratio")
@key("material.name", help="Name of the material, for reports and cards.")
@outputs(
    "With --reference: folder for the results [default: FILE.material beside the first file].", FOLDER, synthetic=True
)
def command(files: tuple[Path, ...], as_json: bool, out: Path | None, **chosen: Any) -> None:
    """Print the frequencies and the glass transition of temperature ramps in FILES.

    With --reference, the ramps are superposed, and the folder has rubber.json, tables, figures and report.html.
    """
    from viscofric.cli.material.readings import described, read_kind
    from viscofric.rheology.ramps.result import glass_transition

    if chosen["reference"] is None and (out is not None or chosen["assumed_shift"] is not None):
        raise click.UsageError("--out and --assumed-shift need --reference.")
    reading = {name: chosen[name] for name in ("deformation", "modulus_unit", "columns", "sheet")}
    ramps = read_kind("ramps", files, reading | {name: chosen[name] for name in ("direction", "heating_rate")})
    peaks = [
        one
        for ramp in ramps.ramps
        for by in ("tan delta", "loss modulus")
        if (one := glass_transition(ramp, by)) is not None
    ]
    if as_json:
        record: dict[str, Any] = {
            "format": ramps.format,
            "deformation": ramps.deformation,
            "angular_frequency": ramps.angular_frequencies.tolist(),
            "temperature_range": list(ramps.temperature_range),
            "glass_transitions": [vars(one) for one in peaks],
            **listed("notes", ramps.notes),
        }
        print_json(record)
    else:
        click.echo("\n".join([*described("ramps", ramps, map(str, files))[1], *map(str, peaks)]))
        if chosen["reference"] is None:
            print_notes(ramps.notes)
    if chosen["reference"] is not None:
        _material(files, out, chosen, as_json)


def _material(files: tuple[Path, ...], out: Path | None, chosen: dict[str, Any], quiet: bool) -> None:
    """Superpose the ramps as a run file would, and say what was written."""
    from viscofric.report import write_figures_and_report
    from viscofric.study.rubber_results import run_material

    law = {} if chosen["assumed_shift"] else {"shift": chosen["law"]}
    folder = files[0].with_suffix(".material") if out is None else out
    results, rubber, written = run_material(
        table_of("material", chosen, ramps=[str(path) for path in files], **law),
        folder,
        title=chosen["name"] or f"Material from the temperature ramps in {files[0].name}",
        command=typed_command(),
        samples=0,
        synthetic=chosen["synthetic"],
    )
    figures, report = write_figures_and_report(results.tree, results.folder)
    print_notes(results.notes)
    click.echo(str(rubber.material.shift), err=quiet)
    print_written(*(("file", path) for path in written), ("report", report), figures=figures, err=quiet)
