"""Options that several commands on friction share: how tribometer files are separated."""

from __future__ import annotations

from typing import Any

import click

from viscofric.cli.output import together
from viscofric.cli.rubber_options import column_options

#: Settings of `viscofric.friction.measurement.tribometry.separate`.
separation_options = together(
    column_options("'disc_speed=V1 (mm/s)'"),
    click.option(
        "--zero",
        metavar="FORCE",
        help="Zero offset of the force cell, e.g. '0.1 N' [default: found from reversed motion, or as recorded].",
    ),
    click.option("--zero-error", metavar="FORCE", help="Standard error of --zero."),
    click.option(
        "--coulomb",
        metavar="NUMBER|constant",
        help="Assumed Coulomb friction if the slip has one direction only: a coefficient, or 'constant' over "
        "the speed.",
    ),
    click.option("--coulomb-error", type=float, metavar="NUMBER", help="Standard error of --coulomb."),
    click.option(
        "--except-steps",
        metavar="NUMBERS",
        help="Steps of the test to leave out, e.g. '1,3', because load or temperature was not steady.",
    ),
    click.option("--leave-out-outliers", is_flag=True, help="Leave out outliers."),
    click.option(
        "--speed-tolerance",
        type=float,
        default=0.05,
        show_default=True,
        help="Relative gap between different nominal speeds and slips.",
    ),
    click.option(
        "--temperature-tolerance",
        metavar="DT",
        default="1 delta_degC",
        show_default=True,
        help="Gap between different nominal temperatures.",
    ),
)


#: Settings of a separation of which nothing was chosen.
_DEFAULTS: dict[str, Any] = {
    "columns": {},
    "sheet": None,
    "zero": None,
    "coulomb": None,
    "outliers": "keep",
    "speed_tolerance": 0.05,
    "temperature_tolerance": "1 delta_degC",
    "except_steps": None,
}
#: Setting -> its option, where that is not its name.
_TYPED = {"outliers": "leave-out-outliers", "columns": "column"}


def settings_of(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return the settings of `viscofric.cli.friction_sources.separated` among the parameters of a command."""
    for name in ("zero", "coulomb"):
        if parameters[f"{name}_error"] is not None and parameters[name] is None:
            raise click.UsageError(f"--{name}-error is the standard error of --{name}, which is not given.")
    coulomb: Any = parameters["coulomb"]
    if coulomb is not None and coulomb != "constant":
        try:
            coulomb = float(coulomb)
        except ValueError:
            raise click.BadParameter(
                f"{coulomb!r}: must be a coefficient, such as 0.05, or the word 'constant'.", param_hint="--coulomb"
            ) from None
        if parameters["coulomb_error"] is not None:
            coulomb = (coulomb, parameters["coulomb_error"])
    elif parameters["coulomb_error"] is not None:
        raise click.UsageError("--coulomb-error goes with a number, not with 'constant'.")
    return {name: parameters[name] for name in ("columns", "sheet") if parameters[name]} | {
        "zero": parameters["zero"]
        if parameters["zero_error"] is None
        else (parameters["zero"], parameters["zero_error"]),
        "coulomb": coulomb,
        "outliers": "leave out" if parameters["leave_out_outliers"] else "keep",
        "speed_tolerance": parameters["speed_tolerance"],
        "temperature_tolerance": parameters["temperature_tolerance"],
        "except_steps": _steps(parameters["except_steps"]),
    }


def _steps(text: str | None) -> list[int] | None:
    if text is None:
        return None
    try:
        return [int(number) for number in text.split(",")]
    except ValueError:
        raise click.BadParameter(
            f"{text!r}: must be numbers of steps, such as '2' or '1,3'.", param_hint="--except-steps"
        ) from None


def refuse_settings(settings: dict[str, Any], table: object) -> None:
    """Stop where something was chosen of a separation that has nothing to separate."""
    chosen = [name for name, value in settings.items() if value != _DEFAULTS[name]]
    if chosen:
        options = " and ".join(f"--{_TYPED.get(name, name.replace('_', '-'))}" for name in chosen)
        raise click.UsageError(f"{options}: only runs are separated; {table} holds friction curves, which are already.")
