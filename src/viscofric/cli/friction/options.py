"""Options that several commands on friction share: how tribometer files are separated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Callable

_SEPARATION = (
    click.option(
        "--zero",
        metavar="FORCE",
        help="Reading of the force cell without traction, such as '0.1 N' [default: found from reversed motion].",
    ),
    click.option(
        "--speed-tolerance",
        type=float,
        default=0.05,
        show_default=True,
        help="Relative gap that parts nominal speeds, slips and loads.",
    ),
    click.option(
        "--temperature-tolerance",
        metavar="DT",
        default="1 delta_degC",
        show_default=True,
        help="Gap that parts nominal temperatures.",
    ),
)


def separation_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the settings of `viscofric.friction.measurement.tribometry.separate`."""
    for option in reversed(_SEPARATION):
        function = option(function)
    return function


def settings_of(asked: dict[str, Any]) -> dict[str, Any]:
    """Return the settings of the separation among what was asked for."""
    return {name: asked[name] for name in ("zero", "speed_tolerance", "temperature_tolerance")}
