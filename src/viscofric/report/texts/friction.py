"""Traction runs and friction curves: tables and lines for people, plain types for other programs."""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.curves import FrictionCurves
from viscofric.nominal import SAME_TEMPERATURE, parted
from viscofric.report.texts.numbers import in_doubt, several, significant, spanned
from viscofric.report.texts.tables import text_table
from viscofric.traction import TractionRuns
from viscofric.units import shown_celsius


def friction_table(curves: FrictionCurves) -> list[str]:
    """Return friction against speed and temperature as lines of a table."""
    data = curves.points_dataset()
    measured = data.get("within_measured_frequencies")
    if measured is not None and (measured == 0).any():
        data["beyond"] = ("point", np.where(measured == 0, "*", ""))
    if in_doubt(curves.notes) and "viscoelastic_lower" not in data:
        data = data.drop_vars("viscoelastic_error", errors="ignore")
        data["viscoelastic"] = "point", [significant(one, 2) for one in curves.viscoelastic.tolist()]
    if np.all(curves.replicates == 1):
        data = data.drop_vars("replicates")
    return text_table(
        data,
        ("temperature", "T (°C)"),
        ("speed", "speed (mm/s)"),
        ("slip", "slip (mm/s)"),
        ("load", f"load ({curves.load_unit})"),
        ("replicates", "n"),
        ("viscoelastic", "viscoelastic"),
        ("beyond", ""),
        ("isothermal_friction", "isothermal"),
        ("temperature_rise", "rise (K)"),
        ("coulomb", "Coulomb"),
        ("consistency", "residual"),
    )


def friction_lines(curves: FrictionCurves) -> list[tuple[str, str]]:
    """Return what is to be said of separated friction as a whole, as pairs of name and value."""
    lines = []
    if curves.offset is not None:
        lines.append(("zero of the force cell", f"{spanned(curves.offset)} N"))
    if curves.assumption:
        lines.append(("assumed", curves.assumption))
    if (check := curves.consistency_check) is not None:
        lines.append(("residual", str(check)))
    return lines


_MOST_TEMPERATURES = 8
#: Relative to the speed of the disc; slip below it is that of pure rolling.
_ROLLING = 1e-3
#: Sign of the disc's speed and of the slip -> number of the configuration; C. Putignano et al., Tribol. Int. 100 (2016)
#: 338, Eq. 9.
_CONFIGURATIONS = {(-1, -1): "I", (-1, 1): "II", (1, -1): "III", (1, 1): "IV"}


def runs_lines(runs: TractionRuns) -> list[tuple[str, str]]:
    """Return what traction runs hold, as pairs of name and value."""
    steps = f" in {len(runs.steps)} steps" if len(runs.steps) > 1 else ""
    slip = runs.disc_speed - runs.ball_speed
    return [
        ("readings", f"{len(runs)}{steps}"),
        ("temperatures", _temperatures(runs.temperature)),
        ("speed of the disc", f"{spanned(1e3 * np.abs(runs.disc_speed))} mm/s{_both(runs.disc_speed)}"),
        ("slip", f"{spanned(1e3 * np.abs(slip))} mm/s{_both(slip)}"),
        ("load", f"{spanned(runs.load)} N"),
        ("sign configurations", _configurations(runs.disc_speed, slip)),
    ]


def _temperatures(kelvin: Array) -> str:
    shown = [shown_celsius(float(kelvin[rows].mean())) for rows in parted(kelvin, SAME_TEMPERATURE)]
    if len(shown) > _MOST_TEMPERATURES:
        return f"{len(shown)} from {shown[0]} to {shown[-1]} °C"
    return f"{several(shown)} °C"


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
