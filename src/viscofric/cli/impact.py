"""``viscofric impact``: restitution of a falling indenter, at one or several speeds and temperatures."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import CONDITIONS, as_command, together
from viscofric.cli.contact import Contact
from viscofric.cli.contact_options import elastic_options, indenter_options
from viscofric.cli.errors import print_notes
from viscofric.cli.files import DATA, write_dataset
from viscofric.cli.keys import key
from viscofric.cli.output import answer, drawing, json_record, outputs, print_pairs, write_files
from viscofric.cli.rubber_options import rubber_options
from viscofric.cli.speed_options import chosen_speeds, chosen_temperatures, speed_options

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.motion.impact_solution import ImpactSolution, RestitutionCurve


_EXAMPLE = """\b
Examples:
  viscofric impact --material "synthetic fluoroelastomer" --ball "5 mm" --mass "4 g" \\
      --speed "1 m/s" --temperature "20 degC" --gravity "9.81 m/s^2" --rebounds 3
  viscofric impact --material "synthetic fluoroelastomer" --ball "5 mm" --mass "4 g" \\
      --speed "1 m/s" --temperature "-20 degC, 0 degC, 20 degC" --picture rebound.svg
"""


@as_command("impact", epilog=_EXAMPLE)
@rubber_options
@indenter_options
@together(
    key("impact.mass", metavar="M", required=True, type=str),
    speed_options("Speed at the first touch"),
    key(
        "impact.gravity",
        metavar="G",
        type=str,
        help="Acceleration towards the material, e.g. '9.81 m/s^2' [default: none].",
    ),
    click.option(
        "--rebounds",
        type=click.IntRange(1, 1000),
        default=1,
        help="Largest number of contacts; several need --gravity.",
    ),
    heading=CONDITIONS,
)
@elastic_options
@click.option("--accuracy", default=1e-4, help="Target error of the restitution, absolute.")
@outputs(
    "Write the contact over time, or the curve of several (.csv or .nc); `-` prints it.",
    endings=DATA,
    picture="Draw the contact over time, or the restitution of several",
)
def command(out: Path | None, picture: Path | None, **parameters: Any) -> None:
    """Solve the impact of a body of revolution on thick rubber: restitution, contact time, largest force.

    Quantities carry their unit. Several speeds or temperatures give the restitution curve.
    """
    contact = Contact(parameters, out, picture)
    speeds = chosen_speeds(parameters)
    reference = contact.rubber.material.reference
    kelvins = chosen_temperatures(parameters) or (None if reference is None else [reference])
    several = len(speeds) > 1 or len(kelvins or []) > 1
    if several and parameters["rebounds"] > 1:
        raise click.UsageError("--rebounds is for one speed and one temperature.")
    began = time.perf_counter()
    result = _solved(contact, speeds, kelvins, parameters)
    seconds = time.perf_counter() - began

    def record() -> dict[str, Any]:
        from viscofric.units import to_si

        gravity = 0.0 if parameters["gravity"] is None else to_si(parameters["gravity"], "m/s**2")
        inputs = contact.record(None if kelvins is None else kelvins[0]) | {"rebounds": parameters["rebounds"]}
        inputs |= {"mass": to_si(parameters["mass"], "kg"), "gravity": gravity}
        inputs |= {"speed": speeds, "temperature": kelvins}
        contacts = [one._asdict() for one in getattr(result, "contacts", ())]
        return json_record(
            "impact 2", inputs, result.to_dataset(), contacts=contacts, seconds=seconds, warnings=result.warnings
        )

    answer(record, lambda: _print(f"{contact.title}, {parameters['mass']}\n", result, seconds), indent=None)
    write_files(
        ("data", out, lambda path: write_dataset(path, result.to_dataset())),
        ("picture", picture, drawing("pressures.impact_figure", result, contact.name, mark=contact.synthetic)),
    )
    print_notes(result.warnings, word="Warning")


def _solved(
    contact: Contact, speeds: list[float], kelvins: list[float] | None, parameters: dict[str, Any]
) -> ImpactSolution | RestitutionCurve:
    from viscofric.motion.impact import restitution_curve, solve_impact

    material, indenter = contact.rubber.material, contact.body.indenter
    settings = {
        "mass": parameters["mass"],
        "gravity": 0.0 if parameters["gravity"] is None else parameters["gravity"],
        "accuracy": parameters["accuracy"],
        **contact.elastic,
    }
    if len(speeds) == 1 and len(kelvins or [None]) == 1:
        one = None if kelvins is None else kelvins[0]
        return solve_impact(
            material, indenter, speed=speeds[0], rebounds=parameters["rebounds"], temperature=one, **settings
        )
    return restitution_curve(material, indenter, speeds=speeds, temperatures=kelvins, **settings)


def _print(title: str, result: ImpactSolution | RestitutionCurve, seconds: float) -> None:
    from viscofric.motion.impact_solution import RestitutionCurve
    from viscofric.report.texts.motion import impact_lines, restitution_lines

    click.echo(title)
    if isinstance(result, RestitutionCurve):
        click.echo("\n".join(restitution_lines(result)))
    else:
        print_pairs(impact_lines(result, seconds))
