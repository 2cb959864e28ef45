"""``viscofric solve``: one steady contact, in words, as JSON, as a picture."""

from __future__ import annotations

import json
import math
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.contact_options import (
    chosen_direction,
    chosen_indenter,
    chosen_layer,
    chosen_rubber,
    contact_options,
)
from viscofric.cli.errors import told
from viscofric.cli.files import PICTURES, check_ending, refuse_to_overwrite

if TYPE_CHECKING:
    from viscofric.cli.contact_options import NamedIndenter, NamedRubber
    from viscofric.contact.layers import Layer
    from viscofric.contact.solution import ContactSolution

_FILE = click.Path(path_type=Path, dir_okay=False)
_FIELDS = (".nc", ".csv")
_INFINITE = ("inf", "infinite", "infinity", "∞")
#: Options that are settings of `solve_steady` as they stand.
_SETTINGS = (
    "load",
    "indentation",
    "temperature",
    "indenter_modulus",
    "accuracy",
    "tolerance",
    "finest",
    "grid",
    "backend",
    "derivatives",
)

_EXAMPLE = """\b
Such as
  viscofric solve --material "synthetic fluoroelastomer" --ball "9.525 mm" \\
      --speed "100 mm/s" --load "25 N" --temperature "60 degC"
"""


@click.command(name="solve", epilog=_EXAMPLE)
@contact_options
@click.option("--speed", required=True, metavar="V", help="Such as '100 mm/s'; '0 m/s' and 'infinite' are elastic.")
@click.option(
    "--direction",
    metavar="ANGLE|DX,DY",
    default="1,0",
    show_default=True,
    help="Of the motion over the indenter's own axes: from its x towards its y, such as '30 deg' or '0,1'.",
)
@click.option(
    "--load", metavar="F", help="Such as '25 N'; of a line contact per length, '1 kN/m'.  It or --indentation."
)
@click.option("--indentation", metavar="DEPTH", help="Instead of the load: depth of the lowest point.")
@click.option("--temperature", metavar="T", help="Such as '60 degC' [default: the rubber's reference].")
@click.option("--indenter-modulus", metavar="E", help="Of an elastic indenter, such as '200 GPa' [default: rigid].")
@click.option("--indenter-poisson-ratio", type=float, metavar="ν", help="Of an elastic indenter [default: 0.3].")
@click.option("--accuracy", type=float, default=1e-3, show_default=True, help="Relative error of the friction.")
@click.option("--tolerance", type=float, default=1e-8, show_default=True, help="Gap left, over the indentation.")
@click.option("--finest", type=int, help="Most cells along the window's longer edge.")
@click.option(
    "--grid", type=int, metavar="CELLS", help="Along the longer edge, instead of those that the accuracy needs."
)
@click.option(
    "--window", metavar="REAR,FRONT,SIDE", help="Of the cells, from the axis: '3 mm,3 mm,3 mm' [default: found]."
)
@click.option("--backend", default="scipy", show_default=True, help="Arrays and FFTs, such as ducc0 or torch:cuda.")
@click.option("--derivatives", is_flag=True, help="How the friction changes with speed, load and each mode.")
@click.option("--json", "as_json", is_flag=True, help="Print inputs, results and diagnostics as JSON, in SI units.")
@click.option("--picture", type=_FILE, help="Draw pressure and profile (PNG, SVG or PDF).")
@click.option("-o", "--output", type=_FILE, help="Write pressure and displacement (.nc or .csv).")
def command(as_json: bool, picture: Path | None, output: Path | None, **asked: Any) -> None:
    """Solve one steady contact of an indenter that slides or rolls over a rubber.

    Quantities carry their unit.  Every result comes with the error that the refinement of the grid lets expect.
    """
    check_ending(picture, "--picture", PICTURES)
    check_ending(output, "--output", _FIELDS)
    read = [path for path in (asked["height_map"], asked["profile"]) if path is not None]
    if asked["material"] is not None and Path(asked["material"]).is_file():
        read.append(Path(asked["material"]))
    for target in (picture, output):
        if target is not None:
            refuse_to_overwrite(target, read)
    if (asked["load"] is None) == (asked["indentation"] is None):
        raise click.UsageError("give either --load or --indentation, one of them.")
    if asked["indenter_poisson_ratio"] is not None and asked["indenter_modulus"] is None:
        raise click.UsageError("--indenter-poisson-ratio is for --indenter-modulus only; a rigid indenter has none.")
    with told():
        from viscofric.contact.steady import solve_steady

        rubber, shape = chosen_rubber(asked), chosen_indenter(asked)
        settings = {name: asked[name] for name in _SETTINGS}
        settings |= {"layer": chosen_layer(asked), "direction": chosen_direction(asked["direction"])}
        settings["indenter_poisson_ratio"] = _poisson_ratio(asked)
        settings["window"] = asked["window"] and [length.strip() for length in asked["window"].split(",")]
        began = time.perf_counter()
        solution = solve_steady(rubber.material, shape.indenter, speed=_speed(asked["speed"]), **settings)
        seconds = time.perf_counter() - began
        solution = replace(solution, warnings=(*solution.warnings, *_beyond_known(rubber, solution)))
        name = _named(rubber, shape, settings["layer"])
        if as_json:
            from viscofric.report.contact_summary import contact_record

            record = contact_record(_inputs(asked, rubber, shape, solution), solution, seconds)
            click.echo(json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False))
        else:
            _tell(name, rubber, solution, seconds)
        for written in _write(name, rubber, shape, solution, picture, output):
            click.echo(written, err=as_json)


def _poisson_ratio(asked: dict[str, Any]) -> float:
    """Of the indenter."""
    return 0.3 if asked["indenter_poisson_ratio"] is None else float(asked["indenter_poisson_ratio"])


def _speed(text: str) -> float | str:
    plain = text.strip().lower()
    if plain.removeprefix("-").removeprefix("+") in _INFINITE:
        return -math.inf if plain.startswith("-") else math.inf
    return text


def _beyond_known(rubber: NamedRubber, solution: ContactSolution) -> tuple[str, ...]:
    """Tell where the contact asks the rubber for frequencies at which its modulus is extrapolated."""
    from viscofric.rheology.spectra.modulus_table import ModulusTable

    fit = getattr(rubber.material.modes_at(solution.temperature), "fit", None)
    if fit is None or isinstance(rubber.material.spectrum, ModulusTable):  # a table tells it by itself
        return ()
    low, high = fit.frequency_range
    frequency = abs(solution.speed) / (0.5 * (solution.front + solution.rear))
    if frequency == 0.0 or math.isinf(frequency) or low <= frequency <= high:
        return ()
    known = "identified from friction" if fit.from_friction else "measured"
    said = (
        f"the contact's frequency v/a, {frequency:.3g} rad/s, lies beyond those at which the rubber was {known}, "
        f"{low:.3g} to {high:.3g} rad/s at this temperature: the friction rests on the extrapolated modulus."
    )
    return (said,)


def _inputs(
    asked: dict[str, Any], rubber: NamedRubber, shape: NamedIndenter, solution: ContactSolution
) -> dict[str, Any]:
    """Return what was asked for, in SI units; an infinite speed is the word."""
    from viscofric.units import to_si

    spectrum = rubber.material.modes_at(solution.temperature)
    modulus, layer = asked["indenter_modulus"], chosen_layer(asked)
    elastic = None
    if modulus is not None:
        elastic = {"modulus": to_si(modulus, "Pa"), "poisson_ratio": _poisson_ratio(asked)}
    return {
        "material": {
            "name": rubber.name,
            "synthetic": rubber.synthetic,
            "poisson_ratio": rubber.material.poisson_ratio,
            "modes": len(spectrum),
            "E0": spectrum.E0,
            "E_inf": spectrum.E_inf,
            "C": [float(one) for one in spectrum.C],
            "tau": [float(one) for one in spectrum.tau],
        },
        "layer": None if layer is None else {"thickness": layer.thickness, "bonded": layer.bonded},
        "indenter": shape.record | {"elastic": elastic},
        "speed": solution.speed if math.isfinite(solution.speed) else "infinite",
        "direction": list(solution.direction),
        "held": "load" if asked["load"] is not None else "indentation",
        "load": solution.load if asked["load"] is not None else None,
        "indentation": solution.indentation if asked["indentation"] is not None else None,
        "temperature": solution.temperature,
        "accuracy": asked["accuracy"],
        "tolerance": asked["tolerance"],
        "finest": asked["finest"],
        "grid": asked["grid"],
        "window": asked["window"] and [to_si(length.strip(), "m") for length in asked["window"].split(",")],
        "backend": asked["backend"],
        "derivatives": asked["derivatives"],
    }


def _named(rubber: NamedRubber, shape: NamedIndenter, layer: Layer | None) -> str:
    """Return what is in contact, in words."""
    if layer is None:
        return f"{shape.words} on {rubber.name}"
    from viscofric.report.numbers import length

    base = "bonded" if layer.bonded else "sliding on its base"
    return f"{shape.words} on a layer of {rubber.name}, {length(float(layer.thickness))} thick, {base}"


def _tell(name: str, rubber: NamedRubber, solution: ContactSolution, seconds: float) -> None:
    from viscofric.report.contact_derivatives import derivative_lines
    from viscofric.report.contact_summary import contact_lines
    from viscofric.report.numbers import prefixed
    from viscofric.units import celsius

    speed = "at infinite speed" if math.isinf(solution.speed) else f"at {prefixed(solution.speed, None, 'm/s')}"
    if solution.direction != (1.0, 0.0):
        angle = math.degrees(math.atan2(solution.direction[1], solution.direction[0]))
        speed += f" towards {angle:z.4g}° from its x axis".replace("-", "−")
    where = "" if solution.temperature is None else f", {celsius(solution.temperature):z.4g} °C"
    synthetic = " (SYNTHETIC, not measured)" if rubber.synthetic else ""
    click.echo(f"{name}{synthetic}, {speed}{where}")
    click.echo()
    lines = contact_lines(solution, seconds)
    width = max(len(quantity) for quantity, _ in lines)
    for quantity, value in lines:
        click.echo(f"{quantity:<{width}}  {value}")
    if solution.derivatives is not None:
        click.echo()
        for line in derivative_lines(solution, rubber.material.modes_at(solution.temperature)):
            click.echo(line)
    for warning in solution.warnings:
        click.echo(f"Warning: {warning}", err=True)


def _write(
    name: str,
    rubber: NamedRubber,
    shape: NamedIndenter,
    solution: ContactSolution,
    picture: Path | None,
    output: Path | None,
) -> list[str]:
    """Write the files that were asked for, and return what to say of them."""
    said = []
    if picture is not None:
        from viscofric.report.contact_figures import draw_contact

        draw_contact(picture, solution, shape.indenter, title=name, synthetic=rubber.synthetic)
        said.append(f"picture  {picture}")
    if output is not None:
        from viscofric.report.contact_fields import write_fields

        write_fields(output, solution)
        said.append(f"fields   {output}")
    return said
