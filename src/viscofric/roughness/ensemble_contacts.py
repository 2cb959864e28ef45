"""Contacts of an ensemble of rough surfaces: solved in any process, with their numbers kept."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.contact.heated_curve import heat_columns, solve_states
from viscofric.contact.periodic.heating import ACCURACY, PeriodicThermalContact
from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.errors import ConvergenceError
from viscofric.processes import at_work
from viscofric.roughness.patches import contact_statistics

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from viscofric.arrays import Array
    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.heat.heating import Heating
    from viscofric.notes import Note
    from viscofric.processes import Workers
    from viscofric.rheology.interface.law import InterfaceLaw


class Numbers(NamedTuple):
    """Results of one contact."""

    friction_coefficient: float
    friction_error: float
    contact_area_fraction: float
    corrected_area_fraction: float
    stretch: float


class OnDisk(NamedTuple):
    """A surface in a file, which every process reads for itself: each contact handed over would hold a copy."""

    path: Path
    spacing: tuple[float, float]

    def read(self) -> PeriodicSurface:
        """Return the surface."""
        return PeriodicSurface(np.load(self.path), self.spacing)


def on_disk(
    surfaces: Sequence[tuple[str, PeriodicSurface]], folder: Path
) -> list[tuple[str, PeriodicSurface | OnDisk]]:
    """Return named surfaces as files in a folder."""
    found: list[tuple[str, PeriodicSurface | OnDisk]] = []
    for name, surface in surfaces:
        path = folder / f"{len(found)}.npy"
        np.save(path, surface.z)
        found.append((name, OnDisk(path, surface.spacing)))
    return found


def solve_one(name: str, surface: PeriodicSurface | OnDisk, **call: Any) -> Numbers:
    """Solve one contact of an ensemble, in whatever process; keep its numbers."""
    return _numbers(_solution(name, surface, **call))


def _solution(name: str, surface: PeriodicSurface | OnDisk, **call: Any) -> PeriodicSolution:
    try:
        return solve_periodic(surface=surface.read() if isinstance(surface, OnDisk) else surface, **call)
    except ConvergenceError as error:
        raise error.at(f"surface {name!r} at {call['speed']:g} m/s") from None


#: Statistics of the solution that was asked for last: of heated contacts their area is needed first.
_statistics = functools.lru_cache(maxsize=1)(contact_statistics)


def _numbers(solution: PeriodicSolution) -> Numbers:
    described = _statistics(solution)
    return Numbers(
        solution.friction_coefficient,
        solution.diagnostics.friction_error,
        described.area_fraction,
        described.corrected_area_fraction,
        described.stretch,
    )


@dataclass(frozen=True)
class _ThermalContact(PeriodicThermalContact):
    """Contact of an ensemble, of whose solutions only numbers are kept."""

    def area(self, solution: PeriodicSolution) -> float:
        """Return the corrected contact area over the nominal one."""
        return _statistics(solution).corrected_area_fraction

    def kept(self, solution: PeriodicSolution) -> Numbers:
        """Return the numbers of a solution."""
        return _numbers(solution)


def _isothermal(
    call: dict[str, Any], name: str, surface: PeriodicSurface | OnDisk, speed: float, kelvin: float, _: float
) -> PeriodicSolution:
    return _solution(name, surface, **call, speed=speed, temperature=kelvin)


def predict_heated(
    call: dict[str, Any],
    contacts: Sequence[dict[str, Any]],
    heating: Heating,
    interface: InterfaceLaw | None,
    workers: int | Workers,
    report: Callable[[int], None],
) -> tuple[list[Numbers], dict[str, Array], tuple[Note, ...]]:
    """Return numbers of all contacts at the temperature that they heat to, the columns of the heat, and notes.

    `contacts` have name, surface, speed and temperature each; `call` has the other arguments of `solve_periodic`.
    """
    curves: dict[tuple[int, float, bool], list[int]] = {}
    for row, one in enumerate(contacts):
        backwards = one["speed"] < 0.0  # where a surface is another one
        curves.setdefault((id(one["surface"]), one["temperature"], backwards), []).append(row)
    solve = [functools.partial(_isothermal, call, one["name"], one["surface"]) for one in contacts]
    every = [
        _ThermalContact(call["material"], heating, one["temperature"], one["speed"], isothermal, interface)
        for one, isothermal in zip(contacts, solve, strict=True)
    ]
    with at_work(workers) as processes:
        found = solve_states([[every[row] for row in rows] for rows in curves.values()], ACCURACY, processes, report)
    order = np.argsort([row for rows in curves.values() for row in rows])
    states = [found[row] for row in order]
    notes = dict.fromkeys(note for one in states for note in one.notes if note.code == "states-beyond")
    return [one.wanted.solution for one in states], heat_columns(states), tuple(notes)
