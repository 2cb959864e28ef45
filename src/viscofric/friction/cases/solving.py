"""The solution of one contact of a study, and the key of its file."""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.steady import solve_steady
from viscofric.errors import ConvergenceError
from viscofric.friction.cases.record import Record, indenter_record, surface_record
from viscofric.friction.cases.surfaces import TOLERANCE, SurfaceSource, surface_of, unit_vector
from viscofric.friction.sensitivity import solve_with_sensitivity
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable


@dataclass(frozen=True, eq=False)
class Task:
    """One contact to be solved."""

    verb: Callable[..., Record]  # such as `solve_indenter` or `solve_surface`
    arguments: dict[str, Any]  # of the verb: everything that determines the result
    label: str = ""  # for people: "30 °C, 20 mm/s"

    @functools.cached_property
    def key(self) -> str:
        """A hash of the arguments and of the solver's source."""
        return key_of(self.arguments)

    @property
    def fields(self) -> bool:
        """Whether its record has fields."""
        return bool(self.arguments.get("fields"))


def solve(task: Task) -> Record:
    """Solve one contact; the result is the same to the last bit in any process."""
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
    """Solve the contact of an indenter, with further arguments of `solve_steady`, SI."""
    # The temperature (K) is only recorded, as the modes are those at this temperature. If the derivatives of friction
    # by the material's compliance cannot be found, the record has none.
    rubber = Material(modes, poisson_ratio=poisson_ratio)
    if sensitive:
        try:
            solution, sensitivity = solve_with_sensitivity(rubber, temperature=None, **contact)
            return indenter_record(solution, temperature, sensitivity, fields)
        except ConvergenceError:  # possibly of the derivatives: friction itself matters more than its band
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
    """Solve the contact of a rough surface, with `direction` (rad) from x towards y; see `solve_indenter`."""
    solution = surface_solution(modes, poisson_ratio, surface_of(surface), direction, **contact)
    return surface_record(solution, temperature, fields)


def surface_solution(
    modes: RetardationSpectrum, poisson_ratio: float, surface: PeriodicSurface, direction: float, **contact: Any
) -> PeriodicSolution:
    """Return the whole solution of the contact of a rough surface; see `solve_surface`."""
    rubber, toward = Material(modes, poisson_ratio=poisson_ratio), unit_vector(direction)
    return solve_periodic(rubber, surface, direction=toward, tolerance=TOLERANCE, **contact)


def key_of(arguments: Mapping[str, Any]) -> str:
    """Return a hash of everything that determines the result of a contact."""
    described = {name: written(value) for name, value in arguments.items()}
    text = json.dumps({"solver": solver_fingerprint(), **described}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@functools.lru_cache(maxsize=64)  # many tasks have the same modes
def modes_written(modes: RetardationSpectrum) -> str:
    """Return a digest of the modes."""
    digest = hashlib.sha256(np.array([modes.E0, modes.E_inf]).tobytes())
    for column in (modes.C, modes.tau):
        digest.update(np.ascontiguousarray(column).tobytes())
    return digest.hexdigest()


def written(value: Any) -> object:
    """Return a value in plain types: modes and arrays as digests, shapes as all their fields."""
    if isinstance(value, RetardationSpectrum):
        return modes_written(value)
    if isinstance(value, np.ndarray):
        return [value.shape, hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()]
    if callable(getattr(value, "described", None)):  # a surface, by what its heights are made from
        return value.described()
    if isinstance(value, list | tuple):
        return [written(one) for one in value]
    if is_dataclass(value):
        return [type(value).__name__, *((entry.name, written(getattr(value, entry.name))) for entry in fields(value))]
    return value.item() if isinstance(value, np.generic) else value


#: Rooms, and files outside them, that determine the records.
_ROOMS = ("heat", "rheology/shifts", "rheology/interface", "contact", "motion", "roughness", "readers/topography")
_OWN = {
    "friction": (
        *("sensitivity.py", "prediction.py", "heating.py", "coulomb.py"),
        *("cases/solving.py", "cases/record.py", "cases/surfaces.py"),
    ),
    "study": ("cases/history.py", "cases/heating.py"),
}


@functools.cache
def solver_fingerprint() -> str:
    """Return a digest of the solver's source, so that stored cases of another version are not reused."""
    digest = hashlib.sha256()
    for room in _ROOMS:
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
