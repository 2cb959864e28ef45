"""Derivatives of interpolated friction by the material's compliance.

Without units, g is a function of vτ over the length of the contact that varies smoothly along the curve.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

import numpy as np

from viscofric.friction.cases.interpolation import weights
from viscofric.friction.sensitivity import ROUNDING, ComplianceSensitivity, log_times

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.contact.free.scale import Scale
    from viscofric.friction.cases.case import Place
    from viscofric.friction.cases.record import Record
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


@dataclass(frozen=True, eq=False)
class Sensitivities:
    """The derivatives of the cases in one interval."""

    modes: RetardationSpectrum  # at the reference temperature
    places: Sequence[Place]  # of the cases
    log_tau: tuple[Array, ...]  # ln τ (times,) of each case at its temperature, of s
    slope: tuple[Array, ...]  # g (times,) of each case, Pa
    glass: Array  # (cases,), see `ComplianceSensitivity`
    load: Array  # (cases,)

    @classmethod
    def between(
        cls, nodes: Sequence[tuple[float, Record]], places: Sequence[Place], modes: RetardationSpectrum, units: Scale
    ) -> Self | None:
        """Interpolate between nodes, (s, record), of the polynomial; None if a node has no derivatives.

        `modes` are those at the reference temperature, `units` those of the nodes.
        """
        known = [record.sensitivity for _, record in nodes]
        found = [one for one in known if one is not None]
        if len(found) < len(known):
            return None
        at = np.array([s for s, _ in nodes])
        shares = weights(at, np.array([place.s for place in places]))
        # At the reference temperature, where all nodes are.
        log_tau = [log_times(modes, np.exp(-place.s)) for place in places]
        # vτ over the length is the same in the case and in the node.
        contact = np.concatenate([one + place.s for one, place in zip(log_tau, places, strict=True)])
        table = np.array([one.at(contact - s) for one, s in zip(found, at, strict=True)])
        ends = np.cumsum([len(one) for one in log_tau])[:-1]
        unit, scales = units.slope * units.stiffness, [place.units for place in places]
        per_case = np.array([own.slope * own.stiffness * place.b for own, place in zip(scales, places, strict=True)])
        per_case /= unit
        slopes = [
            factor * (share @ part)
            for factor, share, part in zip(per_case, shares, np.split(table, ends, axis=1), strict=True)
        ]
        lean = np.array([own.slope for own in scales]) / units.slope
        return cls(
            modes,
            places,
            tuple(one + place.log_alpha for one, place in zip(log_tau, places, strict=True)),
            tuple(slopes),
            per_case * (shares @ np.array([one.glass for one in found])),
            lean * (shares @ np.array([one.load for one in found])),
        )

    def complete(self, record: Record, row: int) -> Record:
        """Return the record of a case with its derivatives."""
        modes, place = self.modes, self.places[row]
        sensitivity = ComplianceSensitivity(
            friction=record.friction_coefficient,
            compliance_part=0.0,
            log_tau=self.log_tau[row],
            slope=self.slope[row],
            glass=float(self.glass[row]),
            load=float(self.load[row]),
            frequency=record.frequency,
        )
        # From the sensitivity itself, so that the material's own modes change nothing.
        own = _values_at(np.log(modes.tau) + place.log_alpha, sensitivity)
        part = (float(own @ modes.C) + sensitivity.glass / modes.E_inf) / place.b
        return replace(record, sensitivity=replace(sensitivity, compliance_part=part))


def _values_at(log_tau: Array, sensitivity: ComplianceSensitivity) -> Array:
    """Return g at known times if possible, without interpolation."""
    rows = np.minimum(np.searchsorted(sensitivity.log_tau, log_tau - ROUNDING), len(sensitivity.log_tau) - 1)
    if np.all(np.abs(sensitivity.log_tau[rows] - log_tau) <= ROUNDING):
        return sensitivity.slope[rows]
    return sensitivity.at(log_tau)
