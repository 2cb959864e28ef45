"""The solvers as the checks call them: with the arrays and FFTs that are being checked."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

from viscofric.contact import steady
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic import solve as periodic
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.solution import ContactSolution
from viscofric.rheology.material import Material

_checked: ContextVar[Backend | None] = ContextVar("backend that is checked", default=None)


@contextmanager
def checking(backend: Backend | str) -> Iterator[None]:
    """Make the solvers below use a backend; InputError if there is no such library or device."""
    token = _checked.set(Backend.of(backend))
    try:
        yield
    finally:
        _checked.reset(token)


def backend() -> Backend:
    """Return the backend that is checked; SciPy's FFTs on NumPy arrays unless another was chosen."""
    return _checked.get() or Backend()


def solve_steady(material: Material, indenter: Indenter, **settings: Any) -> ContactSolution:
    """Solve a single contact; see `viscofric.contact.steady.solve_steady`."""
    return steady.solve_steady(material, indenter, backend=backend(), **settings)


def solve_periodic(material: Material, surface: PeriodicSurface, **settings: Any) -> PeriodicSolution:
    """Solve a periodic contact; see `viscofric.contact.periodic.solve.solve_periodic`."""
    return periodic.solve_periodic(material, surface, backend=backend(), **settings)
