"""Options of a contact besides rubber, indenter and speed: shared by the commands that solve one or many."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Callable

_OPTIONS = (
    click.option(
        "--direction",
        metavar="ANGLE|DX,DY",
        default="1,0",
        show_default=True,
        help="Direction of motion in the indenter's axes: angle from x towards y, e.g. '30 deg', or a vector '0,1'.",
    ),
    click.option(
        "--indenter-modulus", metavar="E", help="Modulus of an elastic indenter, e.g. '200 GPa' [default: rigid]."
    ),
    click.option(
        "--indenter-poisson-ratio",
        type=float,
        metavar="ν",
        help="Poisson's ratio of an elastic indenter [default: 0.3].",
    ),
    click.option(
        "--accuracy", type=float, default=1e-3, show_default=True, help="Target relative error of the friction."
    ),
    click.option(
        "--backend", default="scipy", show_default=True, help="Array and FFT library, e.g. ducc0 or torch:cuda."
    ),
)


def contact_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a contact."""
    for one in reversed(_OPTIONS):
        function = one(function)
    return function


def inputs_of(asked: dict[str, Any]) -> list[Path]:
    """Return the files that rubber and indenter are read from."""
    rubber = [] if asked["material"] is None else [Path(asked["material"])]
    shapes = [path for path in (asked["height_map"], asked["profile"]) if path is not None]
    return [path for path in (*rubber, *asked["dma"], *shapes) if path.is_file()]


def contact_settings(asked: dict[str, Any]) -> dict[str, Any]:
    """Return the settings of `solve_steady` that the options ask for.

    Raises
    ------
    click.UsageError
        If something is given that goes with something else, or the direction is none.
    InputError
        If a quantity has no unit.
    """
    if asked["indenter_poisson_ratio"] is not None and asked["indenter_modulus"] is None:
        raise click.UsageError("--indenter-poisson-ratio is for --indenter-modulus only; a rigid indenter has none.")
    ratio = asked["indenter_poisson_ratio"]
    return {
        "direction": chosen_direction(asked["direction"]),
        "indenter_modulus": asked["indenter_modulus"],
        "indenter_poisson_ratio": 0.3 if ratio is None else float(ratio),
        "accuracy": asked["accuracy"],
        "backend": asked["backend"],
    }


def chosen_direction(text: str) -> tuple[float, float]:
    """Return the direction of the motion that an angle or two components name.

    Raises
    ------
    click.UsageError
        If it is neither.
    InputError
        If the angle has no unit.
    """
    if "," in text:
        try:
            x, y = (float(part) for part in text.split(","))
        except ValueError:
            raise click.UsageError(f"--direction {text!r}: give an angle, '30 deg', or two numbers, '0,1'.") from None
        return x, y
    from viscofric.units import to_si

    angle = to_si(text, "rad", "direction")
    # So that a right angle is one, and 180° is motion along x.
    return round(math.cos(angle), 15), round(math.sin(angle), 15)
