"""What the page shows of one contact: numbers with their errors, what is doubtful, and pictures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from viscofric.datasets import plain
from viscofric.web.jobs.contact_pictures import Asked, around, outline, pressure_map, profile, shown, surface_profile

if TYPE_CHECKING:
    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.contact.solution import ContactSolution
    from viscofric.study.cases.indenter_case import IndenterCase
    from viscofric.study.cases.surface_case import SurfaceCase

_DIGITS = 6


def told(asked: Asked, solution: ContactSolution | PeriodicSolution, *, sharp: bool) -> dict[str, Any]:
    """Return everything that the page shows of a contact, as JSON holds it, SI.

    Parameters
    ----------
    asked : Asked
    solution : ContactSolution or PeriodicSolution
    sharp : bool
        Whether it is to the study's accuracy.

    Returns
    -------
    dict
        ``stage`` ("coarse" or "sharp"), ``kind`` ("point", "line" or "rough"), ``speed``, ``temperature``,
        ``direction`` (rad, of the motion in the map), ``numbers`` (each ``value`` and ``error``), ``peak_resolved``,
        ``map`` (null of line contacts; ``pressure`` has a row for each y), ``outline`` (closed lines), ``profile``,
        ``warnings``.  Of the numbers, ``within`` is 1 where the rubber was measured at the contact's frequencies, 0
        where it is extrapolated, null where that is not known.
    """
    case = asked.case
    known = asked.rubber.frequency_range is not None
    within = asked.rubber.is_within(case, case.record(solution)) if known else None
    shared: dict[str, Any] = {
        "stage": "sharp" if sharp else "coarse",
        "speed": case.speed,
        "temperature": case.temperature,
        "warnings": [*solution.warnings, *_doubts(asked, within)],
    }
    tell: Any = _of_surface if case.geometry == "rough" else _of_indenter
    found: dict[str, Any] = tell(asked, case, solution)
    found["numbers"]["within"] = _with_error(None if within is None else float(within))
    return shared | found


def _doubts(asked: Asked, within: bool | None) -> list[str]:
    """Tell where the rubber is extrapolated, in temperature or in frequency."""
    # What is doubtful about the rubber as such is told by other steps.
    said: list[str] = [note for note in asked.rubber.doubts([asked.case.temperature]) if note.code == "extrapolated"]
    if within is False:
        rough = asked.case.geometry == "rough"
        what = "Frequencies 2πv/λ of its waves lie" if rough else "The frequency v/a lies"
        said.append(
            f"{what} beyond those at which the rubber was measured: the friction rests on the extrapolated spectrum."
        )
    return said


def _of_indenter(asked: Asked, case: IndenterCase, solution: ContactSolution) -> dict[str, Any]:
    line = solution.geometry == "line"
    return {
        "kind": solution.geometry,
        "direction": 0.0,
        "numbers": _numbers(asked, case, solution),
        "peak_resolved": solution.diagnostics.peak_resolved,
        "map": None if line else pressure_map(*around(solution)),
        "outline": [] if line else outline(solution.x, solution.y, solution.pressure),
        "profile": shown(profile(asked, case, solution)),
    }


def _of_surface(asked: Asked, case: SurfaceCase, solution: PeriodicSolution) -> dict[str, Any]:
    line = solution.pressure.shape[1] == 1
    shortest, longest = case.surface.wavelengths
    return {
        "kind": "rough",
        "direction": math.atan2(solution.direction[1], solution.direction[0]),
        "numbers": plain(
            {
                "friction_coefficient": _with_error(solution.friction_coefficient, solution.diagnostics.friction_error),
                "lateral_friction_coefficient": _with_error(solution.lateral_friction_coefficient),
                "pressure": _with_error(solution.mean_pressure),
                "contact_area_fraction": _with_error(solution.contact_area_fraction),
                "mean_gap": _with_error(solution.mean_gap),
                "max_pressure": _with_error(solution.max_pressure),
                "mean_contact_pressure": _with_error(solution.mean_pressure / solution.contact_area_fraction),
                "power": _with_error(solution.friction_coefficient * solution.mean_pressure * case.speed),
                "energy_balance": _with_error(solution.diagnostics.energy),
                "slowest_frequency": _with_error(2.0 * math.pi * case.speed / longest),
                "fastest_frequency": _with_error(2.0 * math.pi * case.speed / shortest),
                **_rubber_at(asked, 2.0 * math.pi * case.speed / shortest),
                "points": _with_error(max(solution.pressure.shape)),
                "points_asked": _with_error(max(case.surface.shape)),
            },
            _DIGITS,
        ),
        "peak_resolved": None,
        "map": None if line else pressure_map(solution.x, solution.y, solution.pressure),
        "outline": [],
        "profile": shown(surface_profile(solution)),
    }


def _with_error(value: float | None, error: float | None = None) -> dict[str, float | None]:
    return {"value": value, "error": error}


def _numbers(asked: Asked, case: IndenterCase, solution: ContactSolution) -> dict[str, Any]:
    found = solution.diagnostics
    length = solution.front + solution.rear
    frequency = case.speed / (0.5 * length)
    half = solution.half_width if math.isfinite(solution.half_width) else 0.5 * length
    force = solution.friction_coefficient * solution.load
    return dict(
        plain(
            {
                "friction_coefficient": _with_error(solution.friction_coefficient, found.friction_error),
                "load": _with_error(solution.load),
                "friction_force": _with_error(force, found.friction_error * solution.load),
                "power": _with_error(force * case.speed, found.friction_error * solution.load * case.speed),
                "indentation": _with_error(solution.indentation, found.indentation_error),
                "contact_area": _with_error(solution.contact_area, found.contact_area_error),
                "front": _with_error(solution.front, found.edge_error),
                "rear": _with_error(solution.rear, found.edge_error),
                "half_width": _with_error(solution.half_width, found.edge_error),
                "max_pressure": _with_error(solution.max_pressure, found.max_pressure_error),
                "mean_pressure": _with_error(solution.load / solution.contact_area),
                "centre_of_pressure": _with_error(solution.centre_of_pressure),
                "reach": _with_error(max(half, solution.front, solution.rear) / case.indenter.reach),
                "energy_balance": _with_error(found.energy),
                "frequency": _with_error(frequency),
                **_rubber_at(asked, frequency),
                "cells": _with_error(max(found.shape)),
            },
            _DIGITS,
        )
    )


def _rubber_at(asked: Asked, frequency: float) -> dict[str, Any]:
    """Tell what the rubber is at a frequency (rad/s) and the contact's temperature."""
    rubber, temperature = asked.rubber, asked.case.temperature
    modulus = complex(rubber.material.modes_at(temperature).complex_modulus(frequency))
    alpha = float(rubber.shift(temperature))
    return {
        "storage_modulus": _with_error(modulus.real),
        "loss_factor": _with_error(modulus.imag / modulus.real),
        "shift_factor": _with_error(alpha),
        "reduced_frequency": _with_error(alpha * frequency),
        "reduced_speed": _with_error(alpha * asked.case.speed),
    }
