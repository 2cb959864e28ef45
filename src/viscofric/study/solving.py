"""One contact of a study solved: from everything that decides its answer to what is kept of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.steady import solve_steady
from viscofric.errors import ConvergenceError
from viscofric.friction.sensitivity import solve_with_sensitivity
from viscofric.rheology.material import Material
from viscofric.study.cases.keys import key_of
from viscofric.study.record import indenter_record, surface_record
from viscofric.study.surface_source import surface_of, unit_vector

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.contact.periodic.surface import PeriodicSurface
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.study.record import Record
    from viscofric.study.surface_source import SurfaceSource

# Complementarity asked for of rough surfaces: far less than what the grid does to friction, whatever the accuracy.
_TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False)
class Task:
    """One contact to be solved.

    Attributes
    ----------
    verb : callable
        `solve_indenter` or `solve_surface`.
    arguments : dict
        Of the verb: all that decides the answer.
    label : str
        For people: "30 °C, 20 mm/s".
    key : str
        A name that changes with any argument that could change the answer, and with any line of the solver.
    """

    verb: Callable[..., Record]
    arguments: dict[str, Any]
    label: str = ""
    key: str = field(init=False, default="")

    def __post_init__(self) -> None:
        object.__setattr__(self, "key", key_of(self.arguments))

    @property
    def fields(self) -> bool:
        """Whether its record has fields."""
        return bool(self.arguments["fields"])


def solve(task: Task) -> Record:
    """Solve one contact.

    Returns
    -------
    Record
        The same to the last bit in whatever process.

    Raises
    ------
    InputError, ConvergenceError
        As of `solve_steady`, or `solve_periodic`.
    """
    return task.verb(**task.arguments)


def solve_indenter(
    modes: RetardationSpectrum,
    poisson_ratio: float,
    *,
    temperature: float,
    sensitive: bool = False,
    fields: bool = False,
    **contact: Any,
) -> Record:
    """Solve the contact of an indenter.

    Parameters
    ----------
    modes : RetardationSpectrum
        Of the rubber at the contact's temperature.
    poisson_ratio : float
    temperature : float
        K; it is written down only, as the modes are those of this temperature.
    sensitive : bool
        Whether to find how friction answers to the rubber's compliance.  Where friction is found but not that, the
        record is one without.
    fields : bool
        Whether to keep the fields.
    **contact
        Indenter, speed, load, accuracy, layer and modulus of `solve_steady`, SI.
    """
    rubber = Material(modes, poisson_ratio=poisson_ratio)
    if sensitive:
        try:
            solution, sensitivity = solve_with_sensitivity(rubber, temperature=None, **contact)
            return indenter_record(solution, temperature, sensitivity, fields)
        except ConvergenceError:  # of the derivatives, maybe: friction itself counts more than its band
            pass
    return indenter_record(solve_steady(rubber, **contact), temperature, with_fields=fields)


def solve_surface(
    modes: RetardationSpectrum,
    poisson_ratio: float,
    surface: SurfaceSource,
    *,
    temperature: float,
    direction: float = 0.0,
    fields: bool = False,
    **contact: Any,
) -> Record:
    """Solve the contact of a rough surface.

    Parameters
    ----------
    modes, poisson_ratio, temperature, fields
        See `solve_indenter`.
    surface : MadeSurface or ScannedSurface
        What its heights are made from, which each process does for itself.
    direction : float
        Of the motion, from x towards y, rad.
    **contact
        Speed, pressure, layer and modulus of `solve_periodic`, SI.
    """
    solution = surface_solution(modes, poisson_ratio, surface_of(surface), direction, **contact)
    return surface_record(solution, temperature, fields)


def surface_solution(
    modes: RetardationSpectrum, poisson_ratio: float, surface: PeriodicSurface, direction: float, **contact: Any
) -> PeriodicSolution:
    """Return all that is found of the contact of a rough surface; see `solve_surface`."""
    rubber, toward = Material(modes, poisson_ratio=poisson_ratio), unit_vector(direction)
    return solve_periodic(rubber, surface, direction=toward, tolerance=_TOLERANCE, **contact)
