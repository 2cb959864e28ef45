"""One contact of a study, from everything that decides its answer to what is kept of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from viscofric.contact.steady import solve_steady
from viscofric.errors import ConvergenceError
from viscofric.friction.sensitivity import solve_with_sensitivity
from viscofric.rheology.material import Material
from viscofric.study.keys import case_key, modes_written, written
from viscofric.study.record import CaseRecord

if TYPE_CHECKING:
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.contact.layers import Layer
    from viscofric.contact.solution import ContactSolution
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.study.record import Record
    from viscofric.study.surface_solving import SurfaceTask


@dataclass(frozen=True, eq=False)
class Task:
    """One contact to be solved.

    Attributes
    ----------
    modes : RetardationSpectrum
        Of the rubber at the contact's temperature.
    poisson_ratio : float
    indenter : Indenter
    speed, load : float
        m/s, and N (N/m for a line contact).
    temperature : float
        K; it is written down only, as the modes are those of this temperature.
    accuracy : float
        Of the friction coefficient, relative.
    layer : Layer or None
    indenter_modulus : float or None
        Pa; a rigid indenter without.
    indenter_poisson_ratio : float
    sensitive : bool
        Whether to find how friction answers to the rubber's compliance.
    fields : bool
        Whether to keep the fields.
    label : str
        For people: "30 °C, 20 mm/s".
    key : str
        A name that changes with anything that could change the answer, and with any line of the solver.
    """

    modes: RetardationSpectrum
    poisson_ratio: float
    indenter: Indenter
    speed: float
    load: float
    temperature: float
    accuracy: float
    layer: Layer | None = None
    indenter_modulus: float | None = None
    indenter_poisson_ratio: float = 0.3
    sensitive: bool = False
    fields: bool = False
    label: str = ""
    key: str = field(init=False, default="")

    def __post_init__(self) -> None:
        # How the modes were found is much to send about, and does not matter to the answer.
        if self.modes.fit is not None:
            object.__setattr__(self, "modes", replace(self.modes, fit=None))
        object.__setattr__(self, "key", self._key())

    def _key(self) -> str:
        described: dict[str, object] = {
            "modes": modes_written(self.modes),
            "poisson_ratio": self.poisson_ratio,
            "indenter": written(self.indenter),
            "layer": None if self.layer is None else written(self.layer),
            "speed": self.speed,
            "load": self.load,
            "temperature": self.temperature,
            "indenter_modulus": self.indenter_modulus,
            "indenter_poisson_ratio": self.indenter_poisson_ratio,
            "accuracy": self.accuracy,
            "sensitive": self.sensitive,
            "fields": self.fields,
        }
        return case_key(described)

    def solve(self) -> CaseRecord:
        """Solve it; see `solve`."""
        if self.sensitive:
            try:
                solution, sensitivity = solve_with_sensitivity(
                    self._material, self.indenter, temperature=None, **self._contact
                )
                return CaseRecord.of(solution, self.temperature, sensitivity, self.fields)
            except ConvergenceError:  # of the derivatives, maybe: friction itself counts more than its band
                pass
        return CaseRecord.of(self.solution(), self.temperature, with_fields=self.fields)

    def solution(self) -> ContactSolution:
        """Solve it, and return all that was found instead of what is kept of it; see `solve_steady`."""
        return solve_steady(self._material, self.indenter, **self._contact)

    @property
    def _material(self) -> Material:
        return Material(self.modes, poisson_ratio=self.poisson_ratio)

    @property
    def _contact(self) -> dict[str, Any]:
        return {
            "speed": self.speed,
            "load": self.load,
            "accuracy": self.accuracy,
            "layer": self.layer,
            "indenter_modulus": self.indenter_modulus,
            "indenter_poisson_ratio": self.indenter_poisson_ratio,
        }


def solve(task: Task | SurfaceTask) -> Record:
    """Solve one contact.

    Parameters
    ----------
    task : Task or SurfaceTask

    Returns
    -------
    CaseRecord or SurfaceRecord
        The same to the last bit in whatever process.  Without a sensitivity where friction was found but not how it
        answers to the rubber.

    Raises
    ------
    InputError, ConvergenceError
        As of `solve_steady`, or `solve_periodic`.
    """
    return task.solve()
