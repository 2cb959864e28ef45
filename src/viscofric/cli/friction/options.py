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
        help="Reading of the force cell without traction, such as '0.1 N' [default: found from reversed motion, or as "
        "recorded].",
    ),
    click.option("--zero-error", metavar="FORCE", help="Standard error of --zero."),
    click.option(
        "--coulomb",
        metavar="NUMBER|constant",
        help="What to assume of Coulomb friction where slip has one direction only: its coefficient, or 'constant' "
        "over the speed.",
    ),
    click.option("--coulomb-error", type=float, metavar="NUMBER", help="Standard error of the --coulomb number."),
    click.option("--leave-out-outliers", is_flag=True, help="Leave out readings far from the others of their kind."),
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
    """Return the settings of the separation among what was asked for.

    Raises
    ------
    click.UsageError
        If an error is given without its value, or the Coulomb friction is neither a number nor the word.
    """
    for name in ("zero", "coulomb"):
        if asked[f"{name}_error"] is not None and asked[name] is None:
            raise click.UsageError(f"--{name}-error is the standard error of --{name}, which is not given.")
    coulomb: Any = asked["coulomb"]
    if coulomb is not None and coulomb != "constant":
        try:
            coulomb = float(coulomb)
        except ValueError:
            raise click.BadParameter(
                f"{coulomb!r}: must be a coefficient, such as 0.05, or the word 'constant'.", param_hint="--coulomb"
            ) from None
        if asked["coulomb_error"] is not None:
            coulomb = (coulomb, asked["coulomb_error"])
    elif asked["coulomb_error"] is not None:
        raise click.UsageError("--coulomb-error goes with a number, not with 'constant'.")
    return {
        "zero": asked["zero"] if asked["zero_error"] is None else (asked["zero"], asked["zero_error"]),
        "coulomb": coulomb,
        "outliers": "leave out" if asked["leave_out_outliers"] else "keep",
        "speed_tolerance": asked["speed_tolerance"],
        "temperature_tolerance": asked["temperature_tolerance"],
    }
