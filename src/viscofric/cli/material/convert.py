"""``viscofric material convert RUBBER OUTPUT``: a rubber as a material card of another program."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import Decorator, as_command, quantity
from viscofric.cli.errors import print_notes, typed_as
from viscofric.cli.files import WRITTEN, refuse_to_overwrite
from viscofric.cli.output import outputs, print_json, print_written

if TYPE_CHECKING:
    from viscofric.rheology.cards import CardFormat, CardLaw

CARD_LAWS = ("best", "wlf", "vft", "arrhenius")
FORMATS = ("abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "json")


def reading(unit: str, words: str) -> Decorator:
    """Return a decorator that adds the option of a unit of the card that is read."""
    return click.option(f"--read-{unit}", metavar="UNIT", help=words)


@as_command("convert")
@click.argument("rubber", metavar="MATERIAL")
@click.argument("output", required=False, type=WRITTEN)
@click.option("--format", "form", type=click.Choice(FORMATS), required=True, help="Format of the card.")
@click.option(
    "--poisson-ratio",
    type=float,
    help="Poisson's ratio of the card instead of the material's; ANSYS and LS-DYNA do not accept 0.5.",
)
@click.option(
    "--modulus-unit",
    type=click.Choice(["Pa", "MPa"]),
    default="Pa",
    help="Units of Abaqus, ANSYS and LS-DYNA cards; MPa goes with mm, s and tonne.",
)
@click.option(
    "--temperature-unit",
    type=click.Choice(["K", "degC"]),
    default="K",
    help="Temperatures of Abaqus, ANSYS and LS-DYNA cards.",
)
@click.option(
    "--domain",
    type=click.Choice(["time", "frequency"]),
    default="time",
    help="Analysis of Abaqus cards: in time (Prony series) or in frequency.",
)
@click.option("--material-id", default=1, help="Number of the material in ANSYS and LS-DYNA cards.")
@reading("modulus-unit", "Unit of moduli in MATERIAL, a card that does not state it, such as 'MPa'.")
@reading("time-unit", "The same of times, such as 'ms'.")
@reading("temperature-unit", "The same of temperatures, such as 'degC'.")
@quantity("--density", "RHO", "Density, e.g. '1100 kg/m^3'; required for LS-DYNA.")
@click.option(
    "--card-law",
    type=click.Choice(CARD_LAWS),
    help="Shift law fitted to a table of shift factors, written instead of it.",
)
@outputs("File to write, instead of OUTPUT.", WRITTEN, json="Print the written file and the notes as JSON.")
def command(
    rubber: str,
    output: Path | None,
    out: Path | None,
    as_json: bool,
    form: CardFormat,
    card_law: CardLaw | None,
    read_modulus_unit: str | None,
    read_time_unit: str | None,
    read_temperature_unit: str | None,
    **more: Any,
) -> None:
    """Write MATERIAL as a material card of another program to the file OUTPUT.

    MATERIAL is a material file (JSON, or a card of any of these programs), or a catalogue name.
    """
    from viscofric.cli.rubber_options import find_rubber
    from viscofric.notes import listed, warned
    from viscofric.rheology.cards import write_card

    target = output or out
    if target is None or (output is not None and out is not None):
        raise click.UsageError("give the file to write, OUTPUT or --out, once.")
    refuse_to_overwrite([Path(rubber)], target)
    units = {
        "modulus_unit": read_modulus_unit,
        "time_unit": read_time_unit,
        "temperature_unit": read_temperature_unit,
    }
    with typed_as({name: f"read_{name}" for name in units}):
        material = find_rubber(rubber, "rubber", **units)
    with warned() as notes:
        write_card(material, target, format=form, law=card_law, **more)
    if as_json:
        print_json({"card": target, "format": form, **listed("notes", notes)})
    else:
        print_written(("card", target))
    print_notes(notes)
