"""Where the cases of a study lie, in words: temperature and speed, and all else that varies."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.units import celsius, plain, told_speed

if TYPE_CHECKING:
    from viscofric.study.cases.case import Case
    from viscofric.study.sweep import Axis, Sweep

_RATE = ("temperature", "speed")
_COUNTED = ("sample", "seed")


def shown(name: str, value: float | str, line: bool = False) -> str:
    """Return one value of an axis in the unit that people use for it.

    Parameters
    ----------
    name : str
        Of the coordinate.
    value : float or str
        SI.
    line : bool
        Whether the contact is one along a line, and the load per length.
    """
    if isinstance(value, str):
        return value
    if name == "temperature":
        return f"{plain(celsius(value), 5)} °C"
    if name in ("angle", "direction"):
        return f"{plain(math.degrees(value))}°"
    if name == "pressure":
        return f"{plain(value / 1e3)} kPa"
    if name == "load":
        return f"{plain(value / 1e3)} N/mm" if line else f"{plain(value)} N"
    if name == "speed":
        return told_speed(value)
    return f"{value:g}" if name in _COUNTED else f"{plain(1e3 * value)} mm"


def place(case: Case) -> str:
    """Say at which temperature and speed a case lies."""
    return f"{plain(celsius(case.temperature))} °C, {told_speed(case.speed)}"


def place_in(sweep: Sweep, number: int) -> str:
    """Say where a case of a sweep lies: its temperature and speed, and its place on every other axis."""
    return ", ".join([place(sweep.cases[number]), *others_in(sweep, number)])


def others_in(sweep: Sweep, number: int) -> list[str]:
    """Say where a case of a sweep lies on every axis but those of temperature and speed."""
    case = sweep.cases[number]
    points = np.unravel_index(number, sweep.shape)
    return [
        words
        for axis, point in zip(sweep.axes, points, strict=True)
        if len(axis) > 1
        for words in _others(axis, int(point), case.geometry == "line")
    ]


def _others(axis: Axis, point: int, line: bool) -> list[str]:
    told = []
    for name, values in axis.columns.items():
        if name in _RATE or (name == "sample" and values[point] == 0):
            continue
        words = shown(name, values[point], line)
        told.append(words if name in ("material", "load") else f"{name.replace('_', ' ')} {words}")
    return told
