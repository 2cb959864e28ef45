"""Contacts over time and impacts: lines for people, plain types for other programs."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.heat.result import TransientHeating
from viscofric.motion.cycle_solution import CycleSolution
from viscofric.motion.history import History
from viscofric.motion.impact_solution import ImpactSolution, RestitutionCurve
from viscofric.motion.solution import TransientSolution
from viscofric.notes import Note
from viscofric.report.texts.numbers import AFTER_PLUS_MINUS, degrees, length, prefixed, significant, with_error
from viscofric.showing import aligned, texts

_ERRORS_IN_TIME = Note(
    "errors-in-time",
    "The stated errors (±) of a rough contact over time are those in time; they do not include those of the distance "
    "between the surface's points.",
)
_FORCES = {"point": ("N", "J"), "line": ("N/m", "J/m"), "periodic": ("Pa", "J/m²")}


def history_words(history: History, geometry: str) -> str:
    """Return a history in one line: duration, load or depth, distance and temperature."""
    duration = float(history.time[-1] - history.time[0])
    units = {"load": _FORCES[geometry][0], "indentation": "m", "pressure": "Pa", "gap": "m"}
    values = getattr(history, history.control)
    way = float(np.hypot(*np.diff(history.position, axis=0).T).sum())
    parts = [
        prefixed(duration, None, "s"),
        f"{history.control} {_range(values, units[history.control])}",
        f"path {length(way)}" if way else "no sliding",
    ]
    if history.temperature is not None:
        ends = (float(history.temperature.min()), float(history.temperature.max()))
        parts.append(" to ".join(dict.fromkeys(map(degrees, ends))))
    return ", ".join(parts)


def _range(values: Any, unit: str) -> str:
    return " to ".join(dict.fromkeys(prefixed(float(end), None, unit) for end in (np.min(values), np.max(values))))


def notes_on_errors(run: TransientSolution) -> tuple[Note, ...]:
    """Return a note on what the stated errors do not include."""
    return (_ERRORS_IN_TIME,) if run.geometry == "periodic" else ()


#: Columns that say where the indenter is and the like, and what does not exist without sliding.
_NOT_SHOWN = {"position_x", "position_y", "temperature", "lateral_force"}
_OF_SLIDING = ("friction", "interface", "total")


def transient_lines(run: TransientSolution, seconds: float) -> list[tuple[str, str]]:
    """Return a contact at the end of its time, and its work, as pairs of name and value."""
    data = run.to_dataset().isel(time=-1)
    slides = bool(np.any(run.position != run.position[0]))
    last: dict[str, Any] = {str(name): one for name, one in data.data_vars.items() if name not in _NOT_SHOWN}
    errors = {name: one.item() for name, one in last.items() if name.endswith("_error")}
    errors |= {"friction_coefficient_error": run.friction_error[-1], "dissipated_error": run.errors.energy[-1]}
    rows = [
        (one.attrs["long_name"], one.item(), one.attrs["units"], errors.get(f"{name}_error"))
        for name, one in last.items()
        if not name.endswith("_error") and (slides or not name.startswith(_OF_SLIDING))
    ]
    return [
        ("at the end", f"after {prefixed(float(run.time[-1] - run.time[0]), None, 's')}"),
        *texts(rows),
        *([("largest viscoelastic friction", _largest(run))] if slides else []),
        *([] if run.heating is None else [("largest rise of temperature", _hottest(run, run.heating))]),
        ("energy balance", f"{100.0 * run.energy_imbalance:.1g} % at most"),
        ("steps", f"{run.steps}, {run.rejected_steps} rejected; {len(run.time)} times returned"),
        ("time", f"{seconds:.2f} s"),
        AFTER_PLUS_MINUS,
    ]


def cycle_lines(cycle: CycleSolution, seconds: float) -> list[tuple[str, str]]:
    """Return the main results of a periodic state, as pairs of name and value."""
    return [
        *texts(cycle._shown()),
        *([] if cycle.mean_friction_coefficient is None else [("largest viscoelastic friction", _largest(cycle.run))]),
        ("energy balance", f"{100.0 * cycle.run.energy_imbalance:.1g} % at most"),
        ("memory", f"{cycle.change:.1g} of its size away from the periodic state"),
        ("time", f"{seconds:.2f} s"),
        AFTER_PLUS_MINUS,
    ]


def _largest(run: TransientSolution) -> str:
    friction, after, way = largest_friction(run.friction_coefficient, run.friction_error, run.time, run.position)
    return f"{friction} after {after} and {length(way)}"


def largest_friction(friction: Array, error: Array, time: Array, position: Array) -> tuple[str, str, float]:
    """Return the friction coefficient of largest magnitude with its error, its time, and the distance slid (m).

    The error includes the largest rise of a parabola between the times.
    """
    size = np.abs(friction)
    place = int(size.argmax())
    around = size[max(place - 1, 0) : place + 2]
    between = 0.25 * np.ptp(around) if 0 < place < len(size) - 1 else 0.0
    way = np.hypot(*np.diff(position[: place + 1], axis=0).T).sum()
    after = prefixed(float(time[place] - time[0]), None, "s")
    return with_error(float(friction[place]), float(np.hypot(error[place], between))), after, float(way)


def _hottest(run: TransientSolution, heat: TransientHeating) -> str:
    """Return the largest rise of temperature with its time."""
    most = int(heat.temperature_rise.argmax())
    rise = with_error(float(heat.temperature_rise[most]), float(heat.error[most] + heat.residual[most]))
    return f"{rise} K after {prefixed(float(run.time[most] - run.time[0]), None, 's')}"


def impact_lines(hit: ImpactSolution, seconds: float) -> list[tuple[str, str]]:
    """Return each contact of an impact, as pairs of name and value."""
    contacts: list[tuple[str, str]] = []
    for number, one in enumerate(hit.contacts, 1):
        if len(hit.contacts) > 1:
            contacts.append((f"contact {number}", f"{prefixed(one.start, None, 's')} after the first touch"))
        contacts += texts(one._shown())
    balance = f"{100.0 * hit.run.energy_imbalance:.1g} % at most"
    return [*contacts, ("energy balance", balance), ("time", f"{seconds:.2f} s"), AFTER_PLUS_MINUS]


def restitution_lines(curve: RestitutionCurve) -> list[str]:
    """Return a table of the restitution: a line for each speed, a column for each temperature."""
    columns = [["speed (m/s)", *(significant(speed, 4) for speed in curve.speed.tolist())]]
    kelvins = [None] if curve.temperature is None else curve.temperature.tolist()
    for kelvin, row, errors in zip(kelvins, curve.restitution, curve.restitution_error, strict=True):
        heading = "restitution" if kelvin is None else f"e at {degrees(kelvin)}"
        columns.append([heading, *map(with_error, row.tolist(), errors.tolist())])
    return aligned(zip(*columns, strict=True))
