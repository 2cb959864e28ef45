"""Options of contacts that their own friction heats."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import Decorator, together
from viscofric.cli.contact_options import option
from viscofric.cli.errors import placed_at, typed_as

if TYPE_CHECKING:
    from viscofric.heat.heating import Heating
    from viscofric.thermal import ThermalProperties

_BODIES = (
    click.option(
        "--heating",
        metavar="COUNTERFACE",
        help="Solve at the temperature to which friction heats the contact. Thermal properties of the counterface: "
        "'steel' or 'PTFE' (typical handbook values), '46 W/m/K, 7810 kg/m^3, 475 J/kg/K', or with its diffusivity "
        "'46 W/m/K, 12 mm^2/s'.",
    ),
    click.option(
        "--heating-rubber",
        metavar="BODY",
        help="The same of the rubber [default: 'filled rubber', typical handbook values: 0.28 W/m/K, 1150 kg/m^3, "
        "1700 J/kg/K].",
    ),
    click.option(
        "--heating-coulomb",
        type=float,
        metavar="μ",
        help="Coulomb friction that heats both faces [default: none, the viscoelastic loss alone].",
    ),
)
_STEADY = (
    click.option(
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
    click.option(
        "--heating-average",
        type=click.Choice(("contact", "loss")),
        help="Mean rise that the rubber responds to: where the loss is released, or of its face [default: loss].",
    ),
    click.option(
        "--heating-branch",
        type=click.Choice(("cold", "hot")),
        help="State of a contact that has two: of a rising or of a falling speed [default: cold].",
    ),
)
_NAMES = ("rubber", "coulomb", "slip", "track", "average", "branch")


def heating_options(*, steady: bool) -> Decorator:
    """Return a decorator that adds the options of heating, of steady contacts or of those over time."""
    return together(
        *_BODIES,
        *(_STEADY if steady else ()),
        heading="Heating",
    )


def chosen_heating(parameters: dict[str, Any]) -> Heating | None:
    """Return the heating that the options name, None without --heating."""
    given = {name: parameters.get(f"heating_{name}") for name in _NAMES}
    known = {name: value for name, value in given.items() if value is not None}
    if parameters["heating"] is None:
        if known:
            raise click.UsageError(f"{option(f'heating_{next(iter(known))}')} needs --heating COUNTERFACE.")
        return None
    from viscofric.heat.heating import Heating

    rubber = _body(known.pop("rubber", "filled rubber"), "heating_rubber", "rubber")
    track = known.pop("track", None)
    counterface = _body(parameters["heating"], "heating", "counterface")
    names = {name: f"heating_{name}" for name in _NAMES} | dict.fromkeys(("track_radius", "passes"), "heating_track")
    with typed_as(names):
        return Heating(counterface=counterface, rubber=rubber, **known, **({} if track is None else _track(track)))


def _body(text: str, parameter: str, name: str) -> ThermalProperties:
    from viscofric.thermal import body_of

    with placed_at(option(parameter)):
        return body_of(text, name)


def _track(text: str) -> dict[str, Any]:
    radius, _, passes = text.partition(",")
    try:
        count = math.inf if passes.strip().lower() in ("inf", "∞") else int(passes)
    except ValueError:
        words = f"--heating-track {text!r}: give a radius and a number of passes, such as '23 mm,500' or '23 mm,inf'."
        raise click.UsageError(words) from None
    return {"track_radius": radius, "passes": count}


def heating_record(heating: Heating | None) -> dict[str, Any] | None:
    """Return the heating in plain types, SI; an infinite number of passes is the word."""
    if heating is None:
        return None
    bodies = {
        name: {one: float(getattr(body, one)) for one in ("conductivity", "diffusivity")} | {"name": body.name}
        for name, body in (("rubber", heating.rubber), ("counterface", heating.counterface))
    }
    others = {name: getattr(heating, name) for name in ("coulomb", "slip", "track_radius", "average", "branch")}
    return bodies | others | {"passes": "infinite" if math.isinf(heating.passes) else heating.passes}
