"""``viscofric solve``: one steady contact, in words, as JSON, as a picture."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import CONDITIONS, CONTACT, as_command, exit_if_beyond, quantity, together
from viscofric.cli.contact import Contact, heating_options
from viscofric.cli.contact_options import chosen_direction, contact_options, indenter_options, load_option
from viscofric.cli.errors import print_notes
from viscofric.cli.files import DATA, write_fields
from viscofric.cli.output import answer, drawing, json_record, outputs, print_pairs, write_files
from viscofric.cli.rubber_options import layer_options, rubber_options
from viscofric.cli.speed_options import list_of
from viscofric.contact.settings import ContactSettings

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.contact.solution import ContactSolution
    from viscofric.notes import Note

_INFINITE = ("inf", "infinite", "infinity", "∞")
#: Options that are settings of `solve_steady` as they stand.
_SETTINGS = ("load", "indentation", "temperature", "tolerance", "finest", "grid", "derivatives")

_EXAMPLE = """\b
Example:
  viscofric solve --material "synthetic fluoroelastomer" --ball "9.525 mm" \\
      --speed "100 mm/s" --load "25 N" --temperature "60 degC"
"""


@as_command("solve", epilog=_EXAMPLE)
@rubber_options
@layer_options
@indenter_options
@together(
    quantity("--speed", "V", "Speed, e.g. '100 mm/s'; '0 m/s' and 'infinite' are the elastic limits.", required=True),
    load_option("; or --indentation"),
    quantity("--indentation", "DEPTH", "Indentation (depth of the lowest point), instead of --load."),
    quantity("--temperature", "T", "Temperature, e.g. '60 degC' [default: the material's reference]."),
    heading=CONDITIONS,
)
@contact_options
@together(
    click.option(
        "--tolerance",
        type=float,
        help="Largest residual gap or overlap over the indentation [default: 1e-8, or less if the accuracy needs it].",
    ),
    click.option("--finest", type=int, help="Largest number of cells along the window's longer edge."),
    click.option(
        "--grid",
        type=int,
        metavar="CELLS",
        help="Number of cells along the window's longer edge, instead of --accuracy.",
    ),
    quantity(
        "--window", "REAR,FRONT,SIDE", "Window of the cells, from the axis: '3 mm,3 mm,3 mm' [default: automatic]."
    ),
    click.option(
        "--derivatives", is_flag=True, help="Also compute the derivatives of friction by speed, load and each mode."
    ),
    heading=CONTACT,
)
@heating_options(steady=True)
@outputs(
    "Write pressure and displacement (.nc or .csv); `-` prints the table.",
    endings=DATA,
    picture="Draw pressure and profile",
)
def command(picture: Path | None, out: Path | None, **parameters: Any) -> None:
    """Solve one steady contact of an indenter that slides or rolls over rubber.

    Quantities carry their unit. Every result has its estimated discretisation error.
    """
    if (parameters["load"] is None) == (parameters["indentation"] is None):
        raise click.UsageError("give either --load or --indentation, one of them.")
    from viscofric.contact.steady import solve_steady
    from viscofric.rheology.material import known_at

    contact = Contact(parameters, picture, out)
    material, indenter = contact.rubber.material, contact.body.indenter
    settings = {name: parameters[name] for name in _SETTINGS} | contact.settings | {"heating": contact.heating}
    settings["direction"] = chosen_direction(parameters["direction"])
    settings["window"] = parameters["window"] and list_of(parameters["window"])
    if contact.heating is not None and parameters["temperature"] is None:
        settings["temperature"] = material.reference
    assumed: tuple[Note, ...] = ()
    if settings["temperature"] is not None:
        material, _, assumed = known_at(material, settings["temperature"])
        contact.rubber = contact.rubber._replace(material=material)
    began = time.perf_counter()
    solution = solve_steady(material, indenter, speed=_speed(parameters["speed"]), **settings)
    solution = replace(solution, warnings=(*assumed, *solution.warnings))
    seconds = time.perf_counter() - began

    def record() -> dict[str, Any]:
        levels = [level._asdict() for level in solution.diagnostics.levels]
        return json_record(
            "contact 2",
            _inputs(parameters, contact, solution),
            solution.to_dataset().drop_dims(("x", "y")),
            warnings=solution.warnings,
            derivatives=solution.derivatives and solution.derivatives.to_dataset(),
            diagnostics=vars(solution.diagnostics) | {"levels": levels},
            seconds=seconds,
        )

    answer(record, lambda: _print(contact, solution, seconds))
    draw = drawing("contact.contact_figure", solution, indenter, contact.name, mark=contact.synthetic)
    write_files(("picture", picture, draw), ("fields", out, lambda path: write_fields(path, solution)))
    if parameters["grid"] is None:
        exit_if_beyond(parameters["accuracy"], solution.friction_coefficient, solution.diagnostics.friction_error)


def _speed(text: str) -> float | str:
    plain = text.strip().lower()
    if plain.removeprefix("-").removeprefix("+") in _INFINITE:
        return -math.inf if plain.startswith("-") else math.inf
    return text


def _inputs(parameters: dict[str, Any], contact: Contact, solution: ContactSolution) -> dict[str, Any]:
    """Return the request, in SI units; an infinite speed is the word."""
    from viscofric.units import to_si

    return {
        **contact.record(solution.temperature),
        "speed": solution.speed if math.isfinite(solution.speed) else "infinite",
        "direction": list(solution.direction),
        "held": "load" if parameters["load"] is not None else "indentation",
        "load": solution.load if parameters["load"] is not None else None,
        "indentation": solution.indentation if parameters["indentation"] is not None else None,
        "temperature": solution.temperature,
        "tolerance": ContactSettings(accuracy=parameters["accuracy"], tolerance=parameters["tolerance"]).residual,
        "finest": parameters["finest"],
        "grid": parameters["grid"],
        "window": parameters["window"] and [to_si(length, "m") for length in list_of(parameters["window"])],
        "derivatives": parameters["derivatives"],
    }


def _print(contact: Contact, solution: ContactSolution, seconds: float) -> None:
    from viscofric.report.texts.contact import contact_lines, derivative_lines
    from viscofric.report.texts.numbers import prefixed
    from viscofric.units import shown_celsius, shown_number

    speed = "at infinite speed" if math.isinf(solution.speed) else f"at {prefixed(solution.speed, None, 'm/s')}"
    if solution.direction != (1.0, 0.0):
        angle = math.degrees(math.atan2(solution.direction[1], solution.direction[0]))
        speed += f" towards {shown_number(angle, 'z.4g')}° from its x axis"
    where = "" if solution.temperature is None else f", {shown_celsius(solution.temperature, 'z.4g')} °C"
    click.echo(f"{contact.title}, {speed}{where}")
    click.echo()
    print_pairs(contact_lines(solution, seconds))
    if solution.derivatives is not None:
        click.echo()
        click.echo("\n".join(derivative_lines(solution, contact.rubber.material.modes_at(solution.temperature))))
    print_notes(solution.warnings, word="Warning")
