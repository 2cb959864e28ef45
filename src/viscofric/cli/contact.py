"""What the options of a command put in contact: a rubber or a layer of it, a body, and the heat of their friction."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import Decorator, quantity, together
from viscofric.cli.contact_options import chosen_body, elastic_settings, inputs_of, option
from viscofric.cli.files import refuse_to_overwrite
from viscofric.cli.keys import key, keys_given, table_of
from viscofric.cli.output import is_synthetic
from viscofric.cli.rubber_options import chosen_layer, chosen_rubber

if TYPE_CHECKING:
    from pathlib import Path

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
    quantity(
        "--heating-track",
        "RADIUS,PASSES",
        "Earlier passes on a circle: '23 mm,500', or '23 mm,inf' for the final state.",
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


class Contact:
    """What the options of a command put in contact; `settings` are arguments of the solvers.

    Raises before anything is read where a file to be written, one of `targets`, is one of the inputs.
    """

    def __init__(self, parameters: dict[str, Any], *targets: Path | None) -> None:
        self._inputs = inputs_of(parameters)
        refuse_to_overwrite(self._inputs, *targets)
        self.rubber, self.body = chosen_rubber(parameters), chosen_body(parameters)
        self.layer, self.heating = chosen_layer(parameters), chosen_heating(parameters)
        self.elastic = elastic_settings(parameters)
        self._others: dict[str, Any] = {
            name: parameters[name] for name in ("coulomb", "accuracy", "backend") if name in parameters
        }
        self.settings = {"layer": self.layer, **self.elastic, **self._others}

    @property
    def name(self) -> str:
        """What is in contact, in words."""
        words = f"{self.body.words} on "
        if self.layer is None:
            return words + self.rubber.name
        from viscofric.report.texts.numbers import length

        base = "bonded" if self.layer.bonded else "sliding on its base"
        return f"{words}a layer of {self.rubber.name}, {length(float(self.layer.thickness))} thick, {base}"

    @property
    def title(self) -> str:
        """Its name, marked where the rubber is made up."""
        return self.name + (" (SYNTHETIC, not measured)" if self.rubber.synthetic else "")

    @property
    def synthetic(self) -> bool:
        """Whether the rubber is synthetic, or a file of it or of the body says so."""
        return is_synthetic(self.rubber.synthetic, self._inputs)

    def record(self, kelvin: float | None) -> dict[str, Any]:
        """Return it in plain types, SI: the rubber with its modes at a temperature, the body, and the heat."""
        from viscofric.units import to_si

        layer, modulus = self.layer, self.elastic["indenter_modulus"]
        elastic = {"poisson_ratio": self.elastic["indenter_poisson_ratio"]}
        return {
            "material": self.rubber.record(kelvin),
            "layer": None if layer is None else {"thickness": layer.thickness, "bonded": layer.bonded},
            "indenter": self.body.record
            | {"elastic": None if modulus is None else {"modulus": to_si(modulus, "Pa"), **elastic}},
            "heating": _record(self.heating),
            **self._others,
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
