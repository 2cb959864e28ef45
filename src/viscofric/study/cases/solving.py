"""One contact of a study solved: from everything that decides its numbers to its record, and the key of its file."""

from __future__ import annotations

import functools
import hashlib
import json
from dataclasses import dataclass, field, fields, is_dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.steady import solve_steady
from viscofric.errors import ConvergenceError
from viscofric.friction.sensitivity import solve_with_sensitivity
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.study.cases.record import indenter_record, surface_record
from viscofric.study.cases.surfaces import surface_of, unit_vector

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from importlib.resources.abc import Traversable

    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.contact.periodic.surface import PeriodicSurface
    from viscofric.study.cases.record import Record
    from viscofric.study.cases.surfaces import SurfaceSource


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


def key_of(arguments: Mapping[str, Any]) -> str:
    """Return a name for a contact that changes with any argument that could change its answer."""
    described = {name: written(value) for name, value in arguments.items()}
    text = json.dumps({"solver": solver_fingerprint(), **described}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@functools.lru_cache(maxsize=64)  # many tasks have the same modes
def modes_written(modes: RetardationSpectrum) -> str:
    """Return what changes with any of the modes."""
    digest = hashlib.sha256(np.array([modes.E0, modes.E_inf]).tobytes())
    for column in (modes.C, modes.tau):
        digest.update(np.ascontiguousarray(column).tobytes())
    return digest.hexdigest()


def written(value: Any) -> object:
    """Return a value in plain types that change with it: of modes and arrays, a digest; of shapes, all their fields."""
    if isinstance(value, RetardationSpectrum):
        return modes_written(value)
    if isinstance(value, np.ndarray):
        return [value.shape, hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()]
    if hasattr(value, "described"):  # a surface, by what its heights are made from
        return value.described()
    if is_dataclass(value):
        return [type(value).__name__, *((entry.name, written(getattr(value, entry.name))) for entry in fields(value))]
    return value.item() if isinstance(value, np.generic) else value


#: Files of other rooms that decide what is kept of a contact.
_OWN = {
    "friction": ("sensitivity.py",),
    "study": ("cases/solving.py", "cases/record.py", "cases/surfaces.py"),
}


@functools.cache
def solver_fingerprint() -> str:
    """Return what changes with any line of the solver, so that cases of an older one are not taken for new."""
    digest = hashlib.sha256()
    for room in ("contact", "roughness", "readers/topography"):
        for name, source in _sources(files("viscofric") / room):
            digest.update(name.encode() + b"\0" + source)
    for room, names in _OWN.items():
        for name in names:
            digest.update((files("viscofric") / room / name).read_bytes())
    return digest.hexdigest()


def _sources(folder: Traversable, path: str = "") -> Iterator[tuple[str, bytes]]:
    """Yield names and texts of the Python files in a folder of a package and in those below it."""
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        name = f"{path}/{entry.name}"
        if entry.is_dir():
            yield from _sources(entry, name)
        elif entry.name.endswith(".py"):
            yield name, entry.read_bytes()
