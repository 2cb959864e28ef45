"""The least-squares problem of an identification: friction, moduli and contacts measured, and what was expected."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.identification.anchors import SolvedContact
    from viscofric.friction.identification.forward import CorrectedFriction
    from viscofric.friction.identification.moduli import ModulusObservation
    from viscofric.friction.identification.points import Points
    from viscofric.friction.identification.shifts import Shifts
    from viscofric.friction.identification.smoothness import Smoothness


@dataclass(frozen=True, eq=False)
class Observations:
    """What was measured.

    Attributes
    ----------
    points : Points
    moduli : tuple of (tuple of ModulusObservation, (n, n) array)
        Observations that err together, and what whitens their errors.
    """

    points: Points
    moduli: tuple[tuple[tuple[ModulusObservation, ...], Array], ...] = ()


@dataclass(frozen=True, eq=False)
class Problem:
    """Residuals of standard deviation one in the unknowns: compliances (1 + m,), then ln α (t,).

    Attributes
    ----------
    friction : CorrectedFriction
    observations : Observations
    shifts : Shifts
    smoothness : Smoothness
    contacts : tuple of SolvedContact
        Contacts whose size was measured.
    """

    friction: CorrectedFriction
    observations: Observations
    shifts: Shifts
    smoothness: Smoothness
    contacts: tuple[SolvedContact, ...] = ()

    @property
    def modes(self) -> int:
        """Number of unknowns that are compliances."""
        return len(self.smoothness.tau) + 1

    @cached_property
    def metric(self) -> Array:
        """What was expected of the unknowns as a matrix of normal equations (p, p): it damps steps (`descend`)."""
        A, W = self.smoothness.matrix, self.shifts.whitening
        size = self.modes + len(self.shifts.middle)
        result = np.zeros((size, size))
        result[: self.modes, : self.modes], result[self.modes :, self.modes :] = A.T @ A, W.T @ W
        return result

    def blurred(self, error: float) -> Problem:
        """Return the problem with so large an error of ln μ at every point besides its own."""
        points = replace(self.observations.points, error=np.hypot(self.observations.points.error, error))
        return replace(self, observations=replace(self.observations, points=points))

    def split(self, unknowns: Array) -> tuple[Array, Array]:
        """Return compliances and ln α."""
        return unknowns[: self.modes], unknowns[self.modes :]

    def log_friction(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the modelled ln μ of every point (n,), and its derivatives (n, p)."""
        compliances, log_alpha = self.split(unknowns)
        points = self.observations.points
        value, change, slope = self.friction(compliances, points.log_speed + log_alpha[points.number], points.log_load)
        moved = np.zeros((len(points), len(log_alpha)))
        moved[np.arange(len(points)), points.number] = slope
        return value, np.concatenate([change, moved], axis=1)

    def measured(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the residuals of what was measured (r,), friction first, and their derivatives (r, p)."""
        compliances, log_alpha = self.split(unknowns)
        points = self.observations.points
        value, change = self.log_friction(unknowns)
        values = [(value - points.log_friction) / points.error]
        changes = [change / points.error[:, None]]
        for together, whitening in self.observations.moduli:
            found = [self._modulus(one, compliances, log_alpha) for one in together]
            values.append(whitening @ np.concatenate([away for away, _ in found]))
            changes.append(whitening @ np.concatenate([moved for _, moved in found]))
        for contact in self.contacts:
            row = self.shifts.row(contact.temperature)
            away, moved, slope = contact.away(compliances, float(row @ log_alpha))
            values.append(np.array([away]))
            changes.append(np.concatenate([moved, slope * row])[None, :])
        return np.concatenate(values), np.concatenate(changes)

    def __call__(self, unknowns: Array) -> tuple[Array, Array]:
        """Return all residuals (r,), those of the prior last, and their derivatives (r, p)."""
        compliances, log_alpha = self.split(unknowns)
        values, changes = self.measured(unknowns)
        A, W = self.smoothness.matrix, self.shifts.whitening
        expected = np.zeros((len(A) + len(W), len(unknowns)))
        expected[: len(A), : self.modes], expected[len(A) :, self.modes :] = A, W
        away = np.concatenate([A @ (compliances - self.smoothness.middle), W @ (log_alpha - self.shifts.middle)])
        return np.concatenate([values, away]), np.concatenate([changes, expected])

    def _modulus(self, one: ModulusObservation, compliances: Array, log_alpha: Array) -> tuple[Array, Array]:
        row = self.shifts.row(one.temperature)
        away, moved, slope = one.away(compliances, self.smoothness.tau, float(row @ log_alpha))
        return away, np.concatenate([moved, slope[:, None] * row], axis=1)
