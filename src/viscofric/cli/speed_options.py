"""Options of several speeds and temperatures, for curves over both."""

from __future__ import annotations

import re
from typing import Any

import click
import numpy as np

from viscofric.cli.commands import Decorator, together

_MOST_POINTS = 10_000


def speed_options(speed: str) -> Decorator:
    """Return a decorator that adds the options of several speeds, named by `speed`, and temperatures."""
    return together(
        click.option(
            "--speed",
            "speeds",
            required=True,
            multiple=True,
            metavar="V",
            help=f"{speed}, list ('20 mm/s, 50 mm/s') or range ('1 mm/s to 1 m/s').",
        ),
        click.option(
            "--points",
            type=click.IntRange(2, _MOST_POINTS),
            default=13,
            help="Number of speeds of a range, evenly spaced in log v.",
        ),
        click.option(
            "--temperature",
            "temperatures",
            multiple=True,
            metavar="T",
            help="Temperature or list, e.g. '30 degC, 60 degC' [default: the material's reference].",
        ),
    )


#: Between the ends of a range: "1 mm/s to 1 m/s", and other ways in which people write it.
_BETWEEN = re.compile(r"\s(?:to|-|–)\s|\s*(?:\.{2,3}|…)\s*")

#: Between the values of a list; between two digits, a comma is a decimal one, which units refuse.
_COMMA = re.compile(r"(?<!\d),|,(?!\d)")


def list_of(text: str) -> list[str]:
    """Return the quantities of a list: '20 mm/s, 50 mm/s'."""
    return [one.strip() for one in _COMMA.split(text)]


def chosen_speeds(parameters: dict[str, Any]) -> list[float]:
    """Return the speeds (m/s) of the options."""
    return [speed for text in parameters["speeds"] for speed in _speeds(text, parameters["points"])]


def chosen_temperatures(parameters: dict[str, Any]) -> list[float]:
    """Return the temperatures (K) of the options."""
    from viscofric.units import positive

    return [positive(one, "K", "--temperature") for text in parameters["temperatures"] for one in list_of(text)]


def _speeds(text: str, points: int) -> list[float]:
    """Return the speeds that a list or a range names."""
    from viscofric.units import positive

    ends = [end.strip() for end in _BETWEEN.split(text)]
    if len(ends) == 1:
        return [positive(one, "m/s", "--speed") for one in list_of(text)]
    if len(ends) > 2:
        raise click.BadParameter(f"{text!r}: a range has two ends: '1 mm/s to 1 m/s'.", param_hint="--speed")
    first, last = (positive(end, "m/s", "--speed") for end in ends)
    if first == last:
        raise click.BadParameter(f"{text!r}: the range has one speed only; give it alone.", param_hint="--speed")
    return [float(speed) for speed in np.geomspace(first, last, points)]
