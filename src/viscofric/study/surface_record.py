"""What is kept of one contact on a rough surface, and records of any kind read back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

from viscofric.study.record import CaseRecord, ContactFields, Record

if TYPE_CHECKING:
    from viscofric.contact.periodic.solution import PeriodicSolution


@dataclass(frozen=True, kw_only=True)
class SurfaceRecord(Record):
    """The numbers of one contact on a rough surface, all SI; see `PeriodicSolution` and `Record`.

    Attributes
    ----------
    pressure : float
        Mean pressure, Pa.
    lateral_friction_coefficient : float
        Force across the motion over the load.
    contact_area_fraction : float
        Points under pressure over all.
    mean_gap : float
        m.
    """

    pressure: float
    lateral_friction_coefficient: float
    contact_area_fraction: float
    mean_gap: float

    @classmethod
    def of(cls, solution: PeriodicSolution, temperature: float, with_fields: bool = False) -> Self:
        """Take the numbers out of a solution, and its fields where they are wanted."""
        diagnostics = solution.diagnostics
        kept = ContactFields(solution.x, solution.y, solution.pressure, solution.displacement) if with_fields else None
        return cls(
            speed=solution.speed,
            temperature=temperature,
            pressure=solution.mean_pressure,
            friction_coefficient=solution.friction_coefficient,
            friction_error=diagnostics.friction_error,
            lateral_friction_coefficient=solution.lateral_friction_coefficient,
            contact_area_fraction=solution.contact_area_fraction,
            mean_gap=solution.mean_gap,
            max_pressure=solution.max_pressure,
            energy_balance=diagnostics.energy,
            complementarity=diagnostics.complementarity,
            cells=max(solution.pressure.shape),
            products=diagnostics.products,
            warnings=solution.warnings,
            fields=kept,
        )


def read_record(values: dict[str, Any]) -> Record:
    """Make a record of its `values`, as JSON's reader returns them; without fields.

    Raises
    ------
    ValueError, TypeError, KeyError
        If it is something else.
    """
    kind = SurfaceRecord if "contact_area_fraction" in values else CaseRecord
    return kind.from_values(values)
