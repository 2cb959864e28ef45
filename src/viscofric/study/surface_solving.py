"""One contact of a study on a rough surface, from everything that decides its answer to what is kept of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from viscofric.contact.periodic.solve import solve_periodic
from viscofric.rheology.material import Material
from viscofric.study.keys import case_key, modes_written, written
from viscofric.study.surface_record import SurfaceRecord
from viscofric.study.surface_source import surface_of, unit_vector

if TYPE_CHECKING:
    from viscofric.contact.layers import Layer
    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.contact.periodic.surface import PeriodicSurface
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.study.surface_source import SurfaceSource

# Complementarity asked for: far less than what the grid does to friction, whatever the accuracy asked for.
_TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False)
class SurfaceTask:
    """One contact on a rough surface to be solved.

    Attributes
    ----------
    modes : RetardationSpectrum
        Of the rubber at the contact's temperature.
    poisson_ratio : float
    surface : MadeSurface or ScannedSurface
        What its heights are made from, which each process does for itself.
    speed, pressure : float
        m/s; mean pressure, Pa.
    temperature : float
        K; it is written down only, as the modes are those of this temperature.
    direction : float
        Of the motion, from x towards y, rad.
    layer : Layer or None
    surface_modulus : float or None
        Pa; a rigid surface without.
    surface_poisson_ratio : float
    fields : bool
        Whether to keep the fields.
    label : str
        For people: "30 °C, 20 mm/s, seed 1".
    key : str
        A name that changes with anything that could change the answer, and with any line of the solver.
    """

    modes: RetardationSpectrum
    poisson_ratio: float
    surface: SurfaceSource
    speed: float
    pressure: float
    temperature: float
    direction: float = 0.0
    layer: Layer | None = None
    surface_modulus: float | None = None
    surface_poisson_ratio: float = 0.3
    fields: bool = False
    label: str = ""
    key: str = field(init=False, default="")

    def __post_init__(self) -> None:
        # How the modes were found is much to send about, and does not matter to the answer.
        if self.modes.fit is not None:
            object.__setattr__(self, "modes", replace(self.modes, fit=None))
        object.__setattr__(self, "key", self._key())

    def _key(self) -> str:
        return case_key(
            {
                "modes": modes_written(self.modes),
                "poisson_ratio": self.poisson_ratio,
                "surface": self.surface.described(),
                "layer": None if self.layer is None else written(self.layer),
                "speed": self.speed,
                "pressure": self.pressure,
                "direction": self.direction,
                "temperature": self.temperature,
                "surface_modulus": self.surface_modulus,
                "surface_poisson_ratio": self.surface_poisson_ratio,
                "fields": self.fields,
            }
        )

    def solve(self) -> SurfaceRecord:
        """Solve it; see `viscofric.study.solving.solve`."""
        return SurfaceRecord.of(self.solution(), self.temperature, self.fields)

    def solution(self, surface: PeriodicSurface | None = None) -> PeriodicSolution:
        """Solve it, and return all that was found instead of what is kept of it; see `solve_periodic`.

        Parameters
        ----------
        surface : PeriodicSurface, optional
            That is taken instead, such as a coarser likeness.
        """
        return solve_periodic(
            Material(self.modes, poisson_ratio=self.poisson_ratio),
            surface_of(self.surface) if surface is None else surface,
            speed=self.speed,
            pressure=self.pressure,
            direction=unit_vector(self.direction),
            layer=self.layer,
            indenter_modulus=self.surface_modulus,
            indenter_poisson_ratio=self.surface_poisson_ratio,
            tolerance=_TOLERANCE,
        )
