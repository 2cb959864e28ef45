"""Contacts over time and impacts: lines for people, plain types for other programs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscofric.motion.cycle_solution import CycleSolution
from viscofric.motion.history import History
from viscofric.motion.impact_solution import ImpactSolution, RestitutionCurve
from viscofric.motion.solution import TransientSolution
from viscofric.notes import Note
from viscofric.report.texts.numbers import degrees, length, prefixed, short, significant, with_error
from viscofric.showing import aligned

_ERRORS_IN_TIME = Note(
    "errors-in-time",
    "The stated errors (±) of a rough contact over time are those in time; they do not include those of the distance "
    "between the surface's points.",
)
#: Friction below this part of the largest load is rounding.
_ROUND_OFF = 1e-12
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
        low, high = float(history.temperature.min()), float(history.temperature.max())
        parts.append(degrees(low) if low == high else f"{degrees(low)} to {degrees(high)}")
    return ", ".join(parts)


def _range(values: Any, unit: str) -> str:
    low, high = float(np.min(values)), float(np.max(values))
    if low == high:
        return prefixed(high, None, unit)
    return f"{prefixed(low, None, unit)} to {prefixed(high, None, unit)}"


def notes_on_errors(run: TransientSolution) -> tuple[Note, ...]:
    """Return a note on what the stated errors do not include."""
    return (_ERRORS_IN_TIME,) if run.geometry == "periodic" else ()


def transient_lines(run: TransientSolution, seconds: float) -> list[tuple[str, str]]:
    """Return the main results of a contact over time, as pairs of name and value."""
    force, energy = _FORCES[run.geometry]
    slides = bool(np.any(run.position != run.position[0]))
    lines = [
        ("at the end", f"after {prefixed(float(run.time[-1] - run.time[0]), None, 's')}"),
        (
            "  mean pressure" if run.geometry == "periodic" else "  load",
            prefixed(float(run.load[-1]), float(run.errors.load[-1]), force),
        ),
        ("  indentation", length(float(run.indentation[-1]), float(run.errors.indentation[-1]))),
        *_contact(run),
    ]
    if slides:
        lines += [("  friction coefficient", _friction(run, -1)), ("largest friction", _largest(run))]
    if slides and run.interface_friction is not None:
        lines.insert(-1, ("  with Coulomb friction", significant(float(run.total[-1]), 4)))
    lines += _heat(run)
    lines += [
        ("work on the material", prefixed(float(run.work[-1]), None, energy)),
        ("  stored", prefixed(float(run.stored[-1]), None, energy)),
        ("  dissipated", prefixed(float(run.dissipated[-1]), float(run.errors.energy[-1]), energy)),
        ("  energy balance", f"{100.0 * run.energy_imbalance:.1g} % at most"),
        ("steps", f"{run.steps}, {run.rejected_steps} rejected; {len(run.time)} times returned"),
        ("time", f"{seconds:.2f} s"),
    ]
    return lines


def _heat(run: TransientSolution) -> list[tuple[str, str]]:
    """Return the lines of a contact that its own friction heats."""
    heat = run.heating
    if heat is None:
        return []
    most = int(np.argmax(heat.temperature_rise))
    error = float(heat.error[most] + heat.residual[most])
    when = prefixed(float(run.time[most] - run.time[0]), None, "s")
    return [
        ("largest rise of temperature", f"{with_error(float(heat.temperature_rise[most]), error)} K, after {when}"),
        ("  at the end", f"{short(float(heat.temperature_rise[-1]), 3)} K"),
    ]


def cycle_lines(cycle: CycleSolution, seconds: float) -> list[tuple[str, str]]:
    """Return the main results of a periodic state, as pairs of name and value."""
    force, energy = _FORCES[cycle.run.geometry]
    stiffness = {"N": "N/m", "N/m": "Pa", "Pa": "Pa/m"}[force]
    lines = [("energy per cycle", prefixed(cycle.energy_per_cycle, cycle.energy_per_cycle_error, energy))]
    if cycle.storage_stiffness is not None and cycle.loss_stiffness is not None and cycle.loss_tangent is not None:
        lines += [
            ("storage stiffness", prefixed(cycle.storage_stiffness, cycle.storage_stiffness_error, stiffness)),
            ("loss stiffness", prefixed(cycle.loss_stiffness, cycle.loss_stiffness_error, stiffness)),
            ("loss tangent", with_error(cycle.loss_tangent, cycle.loss_tangent_error or 0.0)),
        ]
    if cycle.mean_friction_coefficient is not None:
        mean = with_error(cycle.mean_friction_coefficient, cycle.mean_friction_coefficient_error or 0.0)
        lines.append(("mean friction coefficient", mean))
        lines.append(("largest friction", _largest(cycle.run)))
    return [
        *lines,
        ("energy balance", f"{100.0 * cycle.run.energy_imbalance:.1g} % at most"),
        ("periods", f"{cycle.periods}; the memory is {cycle.change:.1g} of its size away from the periodic state"),
        ("time", f"{seconds:.2f} s"),
    ]


def _contact(run: TransientSolution) -> list[tuple[str, str]]:
    """Return the lines of the contact at the end."""
    if run.contact_radius is not None:
        return [("  contact radius", length(float(run.contact_radius[-1])))]
    if run.front is None or run.rear is None:
        return [("  contact area fraction", f"{short(100.0 * float(run.contact_area[-1]))} %")]
    lines = [("  ahead of the axis", length(float(run.front[-1]))), ("  behind the axis", length(float(run.rear[-1])))]
    if run.half_width is not None:
        lines.append(("  half width across", length(float(run.half_width[-1]))))
    return lines


def _friction(run: TransientSolution, place: int) -> str:
    load = float(run.load[place])
    if load <= 0.0:
        return "– (no load)"
    if abs(float(run.friction_force[place])) <= _ROUND_OFF * load:
        return "0"
    return with_error(float(run.friction_coefficient[place]), float(run.errors.friction_force[place]) / load)


def _largest(run: TransientSolution) -> str:
    """Return the friction coefficient of largest magnitude, with its time and distance."""
    place = int(np.abs(run.friction_coefficient).argmax())
    steps = np.hypot(*np.diff(run.position[: place + 1], axis=0).T)
    after = prefixed(float(run.time[place] - run.time[0]), None, "s")
    return f"{_friction(run, place)} after {after} and {length(float(steps.sum()))}"


def impact_lines(hit: ImpactSolution, seconds: float) -> list[tuple[str, str]]:
    """Return the main results of an impact, as pairs of name and value."""
    lines: list[tuple[str, str]] = []
    for number, one in enumerate(hit.contacts, 1):
        stays = not math.isfinite(one.contact_time)
        if len(hit.contacts) > 1:
            lines.append((f"contact {number}", f"{prefixed(one.start, None, 's')} after the first touch"))
        lines += [
            ("restitution", "0 (stays)" if stays else with_error(one.restitution, one.restitution_error)),
            ("  speed", prefixed(one.speed, None, "m/s")),
            ("  contact time", "without end" if stays else prefixed(one.contact_time, None, "s")),
            ("  largest force", prefixed(one.peak_force, None, "N")),
            ("  largest indentation", length(one.largest_indentation)),
        ]
    balance = f"{100.0 * hit.run.energy_imbalance:.1g} % at most"
    return [*lines, ("energy balance", balance), ("time", f"{seconds:.2f} s")]


def restitution_lines(curve: RestitutionCurve) -> list[str]:
    """Return a table of the restitution: a line for each speed, a column for each temperature."""
    columns = [["speed (m/s)", *(significant(speed, 4) for speed in curve.speed.tolist())]]
    kelvins = [None] if curve.temperature is None else curve.temperature.tolist()
    for kelvin, row, errors in zip(kelvins, curve.restitution, curve.restitution_error, strict=True):
        heading = "restitution" if kelvin is None else f"e at {degrees(kelvin)}"
        columns.append([heading, *map(with_error, row.tolist(), errors.tolist())])
    return aligned(zip(*columns, strict=True))
