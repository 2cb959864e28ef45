"""One period of a contact in its periodic state: energy loss, stiffness of an oscillation, mean friction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray

    from viscofric.arrays import Array
    from viscofric.motion.solution import TransientSolution


@dataclass(frozen=True, eq=False)
class CycleSolution:
    """One period of a contact in its periodic state.

    Attributes
    ----------
    run : TransientSolution
        Forces, depth, contact and energies over the period, at every step taken; energies from its beginning.
    energy_per_cycle : float
        Dissipated in the material, J (J/m of a line contact, J/m² of a periodic surface).
    storage_stiffness, loss_stiffness : float or None
        Of an oscillation of load and depth without motion along the surface: real and imaginary part of the ratio of
        load and depth at the frequency of the period, N/m (Pa of a line contact, Pa/m of a periodic surface).  The loss
        is positive.
    mean_friction_coefficient : float or None
        Work of friction over that of a friction force as large as the load, along the same path; None without motion.
    periods : int
        Computed to find the state.
    change : float
        Distance from the repeating state, relative, by the norm of the energy stored in the memory.
    warnings : tuple of str
        One note for each assumption that is doubtful.
    """

    run: TransientSolution
    energy_per_cycle: float
    storage_stiffness: float | None
    loss_stiffness: float | None
    mean_friction_coefficient: float | None
    periods: int
    change: float
    warnings: tuple[str, ...] = ()

    @classmethod
    def of(cls, run: TransientSolution, control: str, periods: int, change: float) -> CycleSolution:
        """Return the numbers of a period."""
        moves = bool(np.any(run.position != run.position[0]))
        stiffness = None if moves else _stiffness(run, control)
        return cls(
            run=run,
            energy_per_cycle=float(run.dissipated[-1] - run.dissipated[0]),
            storage_stiffness=None if stiffness is None else stiffness.real,
            loss_stiffness=None if stiffness is None else stiffness.imag,
            mean_friction_coefficient=_mean_friction(run) if moves else None,
            periods=periods,
            change=change,
            warnings=run.warnings,
        )

    @property
    def loss_tangent(self) -> float | None:
        """Loss over storage stiffness."""
        if self.storage_stiffness is None or self.loss_stiffness is None:
            return None
        return self.loss_stiffness / self.storage_stiffness

    def to_dataset(self) -> xarray.Dataset:
        """Return the period along ``time`` (s), with the numbers of the cycle as attributes."""
        found = self.run.to_dataset()
        numbers = {
            "energy_per_cycle": self.energy_per_cycle,
            "storage_stiffness": self.storage_stiffness,
            "loss_stiffness": self.loss_stiffness,
            "mean_friction_coefficient": self.mean_friction_coefficient,
            "periods": self.periods,
            "change": self.change,
        }
        return found.assign_attrs({name: value for name, value in numbers.items() if value is not None})


def _stiffness(run: TransientSolution, control: str) -> complex | None:
    """Return the ratio of load and depth at the frequency of the period; None if what is prescribed is constant."""
    if np.ptp(run.load if control in ("load", "pressure") else run.indentation) == 0.0:
        return None
    return _harmonic(run.time, run.load) / _harmonic(run.time, run.indentation)


def _harmonic(time: Array, values: Array) -> complex:
    """Return ∫ f e^{−iωt} dt over the period of a function that is linear between its points.

    By parts: f is periodic, so that the integral is that of f' e^{−iωt}/(iω), exact on each piece; a jump adds its rise
    times e^{−iωt}/(iω).
    """
    omega = 2.0 * np.pi / (time[-1] - time[0])
    turned = np.exp(-1j * omega * (time - time[0]))
    steps, rises = np.diff(time), np.diff(values)
    moving = steps > 0.0
    slopes = np.divide(rises, steps, out=np.zeros_like(steps), where=moving)
    pieces = slopes * np.diff(turned) / (-1j * omega)
    jumps = np.where(moving, 0.0, rises) * turned[:-1]
    return complex((pieces.sum() + jumps.sum()) / (1j * omega))


def _mean_friction(run: TransientSolution) -> float:
    """Return ∮ F_t·ds over ∮ F_N |ds|, by the trapezoidal rule."""
    along = np.asarray(run.direction)
    across = np.array([-along[1], along[0]])
    forces = run.friction_force[:, None] * along + run.lateral_force[:, None] * across
    path = np.diff(run.position, axis=0)
    work = float((0.5 * (forces[1:] + forces[:-1]) * path).sum())
    largest = float((0.5 * (run.load[1:] + run.load[:-1]) * np.hypot(path[:, 0], path[:, 1])).sum())
    return work / largest if largest > 0.0 else 0.0
