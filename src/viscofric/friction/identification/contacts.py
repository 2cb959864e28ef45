"""The size of a solved contact and how it follows the rubber, for anchors that are contacts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.steady import solve_steady
from viscofric.friction.identification.forward import FirstOrder
from viscofric.rheology.material import Material

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.identification.anchors import ContactAnchor
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


#: Change of the load for the slope of a size: its error is the square of it, that of the solutions over it.
_LOAD_STEP = 0.05


@dataclass(frozen=True, eq=False)
class SolvedContact:
    """ln of the size of a contact near a rubber for which it was solved.

    Notes
    -----
    A half-space's contact under a rigid indenter depends on load × compliance, so that two solved loads tell how a
    size follows the level of all compliances.  How it is shared out among the modes is that of the contact radius to
    first order (`FirstOrder`): Hertz's contact at the contact's own frequency.  The size itself is exact at the
    rubber that was solved, so that only the step of an iteration, and the standard errors, rest on it.
    """

    anchor: ContactAnchor
    first: FirstOrder
    compliances: Array
    log_alpha: float
    log_size: float
    level: float

    @classmethod
    def of(
        cls,
        anchor: ContactAnchor,
        indenter: Indenter,
        spectrum: RetardationSpectrum,
        poisson_ratio: float,
        accuracy: float,
        compliances: Array,
        log_alpha: float,
    ) -> SolvedContact:
        """Solve the contact of a rubber whose `compliances` are those of `spectrum`."""
        sizes = []
        for factor in (1.0, 1.0 + _LOAD_STEP, 1.0 / (1.0 + _LOAD_STEP)):
            solution = solve_steady(
                Material(spectrum, poisson_ratio=poisson_ratio),
                indenter,
                speed=float(anchor.speed) * float(np.exp(log_alpha)),
                load=float(anchor.load) * factor,
                accuracy=accuracy,
            )
            sizes.append(np.log(anchor.of(solution)))
        level = (sizes[1] - sizes[2]) / (2.0 * np.log1p(_LOAD_STEP))
        first = FirstOrder(indenter, float(anchor.load), 1.0 - poisson_ratio**2, np.array(spectrum.tau))
        return cls(anchor, first, compliances, log_alpha, float(sizes[0]), float(level))

    @property
    def temperature(self) -> float:
        """Of the anchor, K."""
        return float(self.anchor.temperature)

    def away(self, compliances: Array, log_alpha: float) -> tuple[float, Array, float]:
        """Return (modelled less measured)/error, and its derivatives by the compliances (1 + m,) and by ln α."""
        log_speed = np.log(float(self.anchor.speed)) + np.array([self.log_alpha, log_alpha])
        before = self.first(self.compliances, log_speed[:1])
        now = self.first(compliances, log_speed[1:])
        by_radius = self.level / float(before.radius_change[0].sum())
        modelled = self.log_size + by_radius * float(now.log_radius[0] - before.log_radius[0])
        error = self.anchor.error
        return (
            (modelled - float(np.log(self.anchor.value))) / error,
            by_radius * now.radius_change[0] / error,
            by_radius * float(now.radius_slope[0]) / error,
        )
