"""One period of a contact in its periodic state: energy loss, stiffness of an oscillation, mean friction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.datasets import Dataset
from viscofric.motion.period import Estimate, Found
from viscofric.motion.solution import TransientSolution
from viscofric.notes import Warned
from viscofric.showing import Plotted, Rows

#: Numbers with errors.
_NUMBERS = (
    "energy_per_cycle", "storage_stiffness", "loss_stiffness", "loss_tangent", "mean_friction_coefficient",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class CycleSolution(Warned, Plotted):
    """One period of a contact in its periodic state.

    Attributes
    ----------
    run : TransientSolution
        Forces, depth, contact and energies over the period, at every step taken; energies from its beginning.
    energy_per_cycle : float
        Dissipated in the material, J (J/m of a line contact, J/m² of a periodic surface).
    storage_stiffness, loss_stiffness, loss_tangent : float or None
        Of an oscillation of load and depth without motion along the surface: real and imaginary part of the ratio of
        load and depth at the frequency of the period, N/m (Pa of a line contact, Pa/m of a periodic surface), and their
        ratio.  The loss is positive.
    mean_friction_coefficient : float or None
        Work of friction over that of a friction force as large as the load, along the same path; None without motion.
    energy_per_cycle_error, storage_stiffness_error, loss_stiffness_error, loss_tangent_error, \
mean_friction_coefficient_error : float or None
        Estimated errors, absolute: by steps, springs or cells, and the distance from the periodic state.
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
    loss_tangent: float | None
    mean_friction_coefficient: float | None
    energy_per_cycle_error: float
    storage_stiffness_error: float | None
    loss_stiffness_error: float | None
    loss_tangent_error: float | None
    mean_friction_coefficient_error: float | None
    periods: int
    change: float
    warnings: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        stiffness = {"line": "Pa", "periodic": "Pa/m"}.get(self.run.geometry, "N/m")
        return (
            (
                "energy per cycle",
                self.energy_per_cycle,
                {"line": "J/m", "periodic": "J/m²"}.get(self.run.geometry, "J"),
                self.energy_per_cycle_error,
            ),
            ("friction coefficient, mean", self.mean_friction_coefficient, "", self.mean_friction_coefficient_error),
            ("loss tangent", self.loss_tangent, "", self.loss_tangent_error),
            ("storage stiffness", self.storage_stiffness, stiffness, self.storage_stiffness_error),
            ("loss stiffness", self.loss_stiffness, stiffness, self.loss_stiffness_error),
            ("periods computed", self.periods),
            ("times", self.run.time, "s"),
            ("warnings", self.warnings),
        )

    @classmethod
    def of(cls, run: TransientSolution, found: Found, control: str, periods: int) -> CycleSolution:
        """Return the numbers of a period, given at every step."""
        moves = bool(np.any(run.position != run.position[0]))
        prescribed = run.load if control in ("load", "pressure") else run.indentation
        numbers: dict[str, Estimate | None] = dict.fromkeys(_NUMBERS)
        numbers["energy_per_cycle"] = found.energy(run)
        if moves:
            numbers["mean_friction_coefficient"] = found.friction(run)
        elif np.ptp(prescribed) > 0.0:
            numbers |= dict(zip(_NUMBERS[1:4], found.stiffness(), strict=True))
        values = {name: None if one is None else one.value for name, one in numbers.items()}
        errors = {f"{name}_error": None if one is None else one.error for name, one in numbers.items()}
        return cls(run=run, **values, **errors, periods=periods, change=found.change, warnings=run.warnings)  # type: ignore[arg-type]

    def to_dataset(self) -> Dataset:
        """Return the period along ``time`` (s), with the numbers of the cycle and their errors as attributes."""
        names = (*_NUMBERS, *(f"{name}_error" for name in _NUMBERS), "periods", "change")
        numbers = {name: getattr(self, name) for name in names}
        return self.run.to_dataset().assign_attrs({name: one for name, one in numbers.items() if one is not None})
