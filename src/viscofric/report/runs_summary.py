"""Traction runs in words: what was recognised in the files of a tribometer."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.nominal import SAME_TEMPERATURE, numbered
from viscofric.report.numbers import several, short
from viscofric.units import celsius

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.traction import TractionRuns


_MOST_TEMPERATURES = 8
#: Relative to the speed of the disc; slip below it is that of pure rolling.
_ROLLING = 1e-3
#: Sign of the disc's speed and of the slip -> the paper's number of the configuration.
_CONFIGURATIONS = {(-1, -1): "I", (-1, 1): "II", (1, -1): "III", (1, 1): "IV"}


def runs_lines(runs: TractionRuns) -> list[tuple[str, str]]:
    """Return what traction runs hold, as pairs of name and value.

    Parameters
    ----------
    runs : TractionRuns
        With at least one reading.
    """
    steps = f" in {len(runs.steps)} steps" if len(runs.steps) > 1 else ""
    slip = runs.disc_speed - runs.ball_speed
    return [
        ("readings", f"{len(runs)}{steps}"),
        ("temperatures", _temperatures(runs.temperature)),
        ("speed of the disc", f"{_range(1e3 * np.abs(runs.disc_speed))} mm/s{_both(runs.disc_speed)}"),
        ("slip", f"{_range(1e3 * np.abs(slip))} mm/s{_both(slip)}"),
        ("load", f"{_range(runs.load)} N"),
        ("sign configurations", _configurations(runs.disc_speed, slip)),
    ]


def _temperatures(kelvin: Array) -> str:
    labels = numbered(kelvin, np.full(kelvin.shape, SAME_TEMPERATURE))
    means = np.bincount(labels, kelvin) / np.bincount(labels)
    told = [f"{celsius(float(mean)):z.1f}".replace("-", "−") for mean in means]
    if len(told) > _MOST_TEMPERATURES:
        return f"{len(told)} from {told[0]} to {told[-1]} °C"
    return f"{several(told)} °C"


def _range(values: Array) -> str:
    low, high = short(float(values.min()), 3), short(float(values.max()), 3)
    return low if low == high else f"{low} to {high}"


def _both(velocity: Array) -> str:
    return ", both directions" if velocity.min() < 0.0 < velocity.max() else ""


def _configurations(disc: Array, slip: Array) -> str:
    """Return how many readings there are of each combination of signs."""
    rolls = np.abs(slip) <= _ROLLING * np.abs(disc)
    signs = zip(np.sign(disc[~rolls]).astype(int).tolist(), np.sign(slip[~rolls]).astype(int).tolist(), strict=True)
    found = [_CONFIGURATIONS.get(pair, "") for pair in signs]
    counts = {name: found.count(name) for name in _CONFIGURATIONS.values() if name in found}
    said = [f"{name}: {count} readings" for name, count in counts.items()]
    said += [f"pure rolling: {int(rolls.sum())} readings"] * bool(rolls.any())
    whole = "all four" if len(counts) == len(_CONFIGURATIONS) else f"{len(counts)} of four"
    return f"{whole} ({', '.join(said)})"
