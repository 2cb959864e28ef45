"""What is kept of one contact of a study: its numbers, or why there are none."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Self, TypeAlias

import numpy as np

from viscofric.friction.sensitivity import ComplianceSensitivity

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.solution import ContactSolution

    Array: TypeAlias = NDArray[np.float64]


class ContactFields(NamedTuple):
    """Fields of one contact; see `viscofric.contact.solution.ContactSolution`.

    Attributes
    ----------
    x, y : (nx,) and (ny,) array
        m.
    pressure, displacement : (nx, ny) array
        Pa, and m into the solid.
    """

    x: Array
    y: Array
    pressure: Array
    displacement: Array


@dataclass(frozen=True)
class Failure:
    """A case without an answer.

    Attributes
    ----------
    reason : str
        One sentence.
    label : str
        Which case it was, for people.
    """

    reason: str
    label: str

    def __str__(self) -> str:
        return f"{self.label}: {self.reason}"


@dataclass(frozen=True, kw_only=True)
class Record:
    """What the numbers of every contact have in common, all SI.

    Attributes
    ----------
    speed, temperature : float
        m/s, K.
    friction_coefficient, friction_error : float
    max_pressure : float
        Pa.
    energy_balance, complementarity : float
        Residuals of the solution; where the contact is interpolated, the largest of those that it lies between.
    cells, products : int
        Along the longer edge of the window, or of the period, and products with the influence matrix, or with its
        transfer function; none where it is interpolated.
    warnings : tuple of str
    interpolated : bool
        Whether it was not solved, but lies between contacts that were.
    interpolation_error : float
        What that adds to the error of the friction coefficient, which holds it.
    fields : ContactFields or None
        Where they are wanted; kept apart from the other numbers on disk.
    """

    speed: float
    temperature: float
    friction_coefficient: float
    friction_error: float
    max_pressure: float
    energy_balance: float
    complementarity: float
    cells: int
    products: int
    warnings: tuple[str, ...] = ()
    interpolated: bool = False
    interpolation_error: float = 0.0
    fields: ContactFields | None = field(default=None, repr=False, compare=False)

    @classmethod
    def numbers(cls) -> tuple[str, ...]:
        """Return the names of those attributes that are single numbers."""
        other = ("warnings", "sensitivity", "interpolated", "fields")
        return tuple(field.name for field in fields(cls) if field.name not in other)

    @classmethod
    def from_values(cls, values: dict[str, Any]) -> Self:
        """Make a record of its `values`, as JSON's reader returns them; without fields.

        Raises
        ------
        ValueError, TypeError, KeyError
            If it is something else.
        """
        record = cls(**{**values, "warnings": tuple(values["warnings"])})
        if not all(isinstance(text, str) for text in record.warnings) or not isinstance(record.interpolated, bool):
            raise TypeError("warnings are no texts.")
        if not all(is_number(getattr(record, name)) for name in cls.numbers() if name not in cls.ENDLESS):
            raise ValueError("a number is none.")
        return record

    #: Numbers that may be infinite.
    ENDLESS: ClassVar[tuple[str, ...]] = ()

    def values(self) -> dict[str, Any]:
        """Return everything but the fields, in types that JSON keeps to the last digit."""
        return {field.name: getattr(self, field.name) for field in fields(self) if field.name != "fields"}


@dataclass(frozen=True, kw_only=True)
class CaseRecord(Record):
    """The numbers of one indenter's contact, all SI; see `ContactSolution`, `Diagnostics` and `Record`.

    Attributes
    ----------
    load : float
        N (N/m of a line contact).
    indentation, indentation_error : float
        m.
    contact_area, contact_area_error : float
        m²; the width, m, of a line contact.
    front, rear, half_width : float
        m; the half width of a line contact is infinite.
    edge_error : float
        Of the three, m.
    max_pressure_error : float
        Pa.
    centre_of_pressure : float
        Ahead of the axis, m.
    sensitivity : ComplianceSensitivity or None
        How friction answers to the rubber's compliance, where bands are wanted.
    """

    load: float
    indentation: float
    indentation_error: float
    contact_area: float
    contact_area_error: float
    front: float
    rear: float
    half_width: float
    edge_error: float
    max_pressure_error: float
    centre_of_pressure: float
    sensitivity: ComplianceSensitivity | None = None
    ENDLESS: ClassVar[tuple[str, ...]] = ("half_width",)

    @classmethod
    def of(
        cls,
        solution: ContactSolution,
        temperature: float,
        sensitivity: ComplianceSensitivity | None = None,
        with_fields: bool = False,
    ) -> CaseRecord:
        """Take the numbers out of a solution, and its fields where they are wanted."""
        diagnostics = solution.diagnostics
        kept = ContactFields(solution.x, solution.y, solution.pressure, solution.displacement) if with_fields else None
        return cls(
            speed=solution.speed,
            temperature=temperature,
            load=solution.load,
            friction_coefficient=solution.friction_coefficient,
            friction_error=diagnostics.friction_error,
            indentation=solution.indentation,
            indentation_error=diagnostics.indentation_error,
            contact_area=solution.contact_area,
            contact_area_error=diagnostics.contact_area_error,
            front=solution.front,
            rear=solution.rear,
            half_width=solution.half_width,
            edge_error=diagnostics.edge_error,
            max_pressure=solution.max_pressure,
            max_pressure_error=diagnostics.max_pressure_error,
            centre_of_pressure=solution.centre_of_pressure,
            energy_balance=diagnostics.energy,
            complementarity=diagnostics.complementarity,
            cells=max(diagnostics.shape),
            products=diagnostics.products,
            warnings=solution.warnings,
            sensitivity=sensitivity,
            fields=kept,
        )

    @property
    def frequency(self) -> float:
        """Speed over half the contact's length, rad/s."""
        return self.speed / (0.5 * (self.front + self.rear))

    @classmethod
    def from_values(cls, values: dict[str, Any]) -> Self:
        """Make a record of its `values`, as JSON's reader returns them; without fields.

        Raises
        ------
        ValueError, TypeError, KeyError
            If it is something else.
        """
        sensitivity = values["sensitivity"]
        if sensitivity is not None:
            columns = {name: np.array(sensitivity[name], dtype=float) for name in _COLUMNS}
            sensitivity = ComplianceSensitivity(**{**sensitivity, **columns})
        record = super().from_values({**values, "sensitivity": sensitivity})
        if not _is_sound(sensitivity):
            raise ValueError("a number is none.")
        if not (is_number(record.half_width) or record.half_width == math.inf):
            raise ValueError("the half width is none.")
        return record

    def values(self) -> dict[str, Any]:
        """Return everything but the fields."""
        values = super().values()
        if self.sensitivity is not None:
            told = {field.name: getattr(self.sensitivity, field.name) for field in fields(self.sensitivity)}
            values["sensitivity"] = told | {name: told[name].tolist() for name in _COLUMNS}
        return values


#: Attributes of an indenter's record that are single numbers.
NUMBERS = CaseRecord.numbers()
# Arrays of a sensitivity.
_COLUMNS = ("log_tau", "slope")


def is_number(value: object) -> bool:
    """Whether it is a finite number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _is_sound(sensitivity: ComplianceSensitivity | None) -> bool:
    """Whether all numbers of a sensitivity are finite, and its columns belong together."""
    if sensitivity is None:
        return True
    single = [field.name for field in fields(sensitivity) if field.name not in _COLUMNS]
    columns = [getattr(sensitivity, name) for name in _COLUMNS]
    return all(is_number(getattr(sensitivity, name)) for name in single) and all(
        column.ndim == 1 and column.size > 1 and column.size == columns[0].size and np.all(np.isfinite(column))
        for column in columns
    )
