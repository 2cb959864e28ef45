"""Columns of friction curves from solved contacts, with the warnings of many contacts as few notes."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from viscofric.contact.solution import ContactSolution
from viscofric.errors import InputError
from viscofric.notes import note_of
from viscofric.units import shown_number


def columns_of(solutions: Iterable[ContactSolution]) -> dict[str, Any]:
    """Return what `FrictionCurves.from_solutions` needs of contacts, one entry each; see there."""
    given: object = solutions
    solved = tuple(given) if isinstance(given, Iterable) and given is not np.ma.masked else (given,)
    for solution in solved:
        if not isinstance(solution, ContactSolution):
            raise InputError(
                f"solutions must be ContactSolutions, as solve_steady() gives them, not {type(solution).__name__}.",
                code="not-solutions",
            )
        if solution.temperature is None:
            raise InputError(
                "temperature of a contact solution is missing; friction curves need one.", code="no-temperature"
            )
        if solution.speed == 0.0 or not math.isfinite(solution.speed):
            raise InputError(
                f"speed = {shown_number(solution.speed, 'g')} m/s of a solution must be finite and not zero.",
                code="no-speed",
            )
    units = {"N/m" if solution.geometry == "line" else "N" for solution in solved}
    if len(units) > 1:
        raise InputError(
            "solutions of point contacts and of line contacts, whose loads are per length, do not form one curve.",
            code="mixed-geometries",
        )
    return {
        "speed": np.array([abs(solution.speed) for solution in solved]),
        "temperature": np.array([solution.temperature for solution in solved], dtype=float),
        "load": np.array([solution.load for solution in solved]),
        "viscoelastic": np.array([math.copysign(1.0, s.speed) * s.friction_coefficient for s in solved]),
        "viscoelastic_error": np.array([solution.diagnostics.friction_error for solution in solved]),
        "viscoelastic_scatter": np.zeros(len(solved)),
        "replicates": np.ones(len(solved), dtype=np.int64),
        "mean_pressure": np.array([solution.mean_pressure for solution in solved]),
        "mean_pressure_error": np.array(
            [s.mean_pressure * s.diagnostics.contact_area_error / s.contact_area for s in solved]
        ),
        "notes": _warnings(solved),
        "load_unit": units.pop() if units else "N",
    }


def _warnings(solutions: tuple[ContactSolution, ...]) -> tuple[str, ...]:
    """Return the warnings of many solutions, each once."""
    warned = [solution for solution in solutions if solution.warnings]
    if not warned:
        return ()
    counted = {"contacts": len(warned), "of": len(solutions)}
    different = {warning for solution in warned for warning in solution.warnings}
    if len(different) <= 1:
        return (note_of(warned[0].warnings[0]).at(f"In {len(warned)} of {len(solutions)} contacts").valued(**counted),)
    worst = max(warned, key=lambda solution: solution.half_width)
    return tuple(
        note_of(warning)
        .at(f"In {len(warned)} of {len(solutions)} contacts there are warnings; that of the widest one")
        .valued(**counted)
        for warning in worst.warnings
    )
