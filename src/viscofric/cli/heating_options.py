"""Options of contacts that their own friction heats."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import Decorator, together
from viscofric.cli.contact_options import NamedIndenter, elastic_record, option
from viscofric.cli.keys import key, keys_given, table_of
from viscofric.cli.rubber_options import NamedRubber, chosen_layer

if TYPE_CHECKING:
    from viscofric.heat.heating import Heating

_BODIES = (
    key(
        "heating.counterface",
        "--heating",
        metavar="COUNTERFACE",
        help="Solve at the temperature to which friction heats the contact. Thermal properties of the counterface: "
        "'steel' or 'PTFE' (typical handbook values), '46 W/m/K, 7810 kg/m^3, 475 J/kg/K', or with its diffusivity "
        "'46 W/m/K, 12 mm^2/s'.",
    ),
    key(
        "heating.rubber",
        "--heating-rubber",
        metavar="BODY",
        help="The same of the rubber [default: 'filled rubber', typical handbook values: 0.28 W/m/K, 1150 kg/m^3, "
        "1700 J/kg/K].",
    ),
    key(
        "heating.coulomb",
        "--heating-coulomb",
        metavar="μ",
        help="Coulomb friction that heats both faces [default: none, the viscoelastic loss alone].",
    ),
)
_STEADY = (
    key(
        "heating.slip",
        "--heating-slip",
        metavar="V",
        help="Sliding velocity between both faces, below zero where the counterface is the faster one [default: the "
        "speed of the contact].",
    ),
    click.option(
        "--heating-track",
        metavar="RADIUS,PASSES",
        help="Earlier passes on a circle: '23 mm,500', or '23 mm,inf' for the final state.",
    ),
    key("heating.average", "--heating-average"),
    key("heating.branch", "--heating-branch"),
)


def heating_options(*, steady: bool) -> Decorator:
    """Return a decorator that adds the options of heating, of steady contacts or of those over time."""
    return together(
        *_BODIES,
        *(_STEADY if steady else ()),
        heading="Heating",
    )


def chosen_heating(parameters: dict[str, Any]) -> Heating | None:
    """Return the heating that the options name, None without --heating."""
    given = keys_given("heating", parameters)
    track = parameters.get("heating_track")
    if parameters.get("heating") is None:
        if names := [*given, *(["track"] if track is not None else [])]:
            raise click.UsageError(f"{option(f'heating_{names[0]}')} needs --heating COUNTERFACE.")
        return None
    table = table_of("heating", parameters, **({} if track is None else _track(track)))
    heating: Heating = table.heating(table.coulomb[0], None if table.slip is None else table.slip[0])
    return heating


def _track(text: str) -> dict[str, Any]:
    from viscofric.units import positive

    radius, _, passes = text.partition(",")
    try:
        count = math.inf if passes.strip().lower() in ("inf", "∞") else int(passes)
    except ValueError:
        words = f"--heating-track {text!r}: give a radius and a number of passes, such as '23 mm,500' or '23 mm,inf'."
        raise click.UsageError(words) from None
    positive(radius, "m", "track_radius")
    return {"track_radius": radius, "passes": count} if count else {}


def contact_inputs(
    parameters: dict[str, Any], rubber: NamedRubber, shape: NamedIndenter, kelvin: float | None
) -> dict[str, Any]:
    """Return what is in contact in plain types, SI: the rubber with its modes at a temperature, indenter, and heat."""
    layer = chosen_layer(parameters)
    return {
        "material": rubber.record(kelvin),
        "layer": None if layer is None else {"thickness": layer.thickness, "bonded": layer.bonded},
        "indenter": shape.record | {"elastic": elastic_record(parameters)},
        "heating": _record(chosen_heating(parameters)),
    }


def _record(heating: Heating | None) -> dict[str, Any] | None:
    """Return the heating in plain types, SI; an infinite number of passes is the word."""
    if heating is None:
        return None
    bodies = {
        name: {one: float(getattr(body, one)) for one in ("conductivity", "diffusivity")} | {"name": body.name}
        for name, body in (("rubber", heating.rubber), ("counterface", heating.counterface))
    }
    others = {name: getattr(heating, name) for name in ("coulomb", "slip", "track_radius", "average", "branch")}
    return bodies | others | {"passes": "infinite" if math.isinf(heating.passes) else heating.passes}
