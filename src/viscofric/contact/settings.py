"""Settings of a free contact, checked when they are made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypedDict

from viscofric.arguments import whole_number
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.bodies import Layer, checked_coulomb, half_space_coupling, indenter_compliance, unit_direction
from viscofric.errors import InputError, brief, wrong_argument
from viscofric.units import Quantity, checked_poisson_ratio, number

LEAST_FINEST = 128  # three grids, so that the friction has an error estimate
TIGHTEST, USUAL = 1e-13, 1e-8  # of the solver's tolerance
LOOSEST = 1e-3  # likewise, relative to the accuracy


class ContactOptions(TypedDict, total=False):
    """Settings of `viscofric.contact.steady.solve_steady` that may be passed on, by the same names."""

    layer: Layer | Quantity | None
    direction: Sequence[float]
    indenter_modulus: Quantity | None
    indenter_poisson_ratio: float
    tolerance: float | None
    finest: int | None
    window: Sequence[Quantity] | None
    grid: int | None
    backend: Backend | str
    coulomb: float


@dataclass(frozen=True, kw_only=True)
class ContactSettings:
    """Settings of a contact besides material, indenter, speed and load; see `viscofric.contact.steady.solve_steady`.

    Raises InputError if a value cannot be used, whatever the indenter.
    """

    accuracy: float = 1e-3
    tolerance: float | None = None  # 1e-8, or a thousandth of a smaller accuracy
    finest: int | None = None
    window: Sequence[Quantity] | None = None
    grid: int | None = None
    indenter_modulus: Quantity | None = None
    indenter_poisson_ratio: float = 0.3
    layer: Layer | None = None
    backend: Backend | str = "scipy"
    direction: Sequence[float] = (1.0, 0.0)
    coulomb: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "accuracy", number(self.accuracy, "accuracy"))
        ratio = checked_poisson_ratio(self.indenter_poisson_ratio, "indenter_poisson_ratio", above=-1.0)
        object.__setattr__(self, "indenter_poisson_ratio", ratio)
        least, loosest = TIGHTEST / LOOSEST, LOOSEST * self.accuracy
        if not least <= self.accuracy < 1.0:
            raise wrong_argument(
                "accuracy", self.accuracy, f"must be a number from {least:g} to below 1, such as 1e-3.", "out-of-range"
            )
        if self.tolerance is not None:
            object.__setattr__(self, "tolerance", number(self.tolerance, "tolerance"))
        if not TIGHTEST <= self.residual <= loosest:
            raise InputError(
                f"tolerance = {brief(self.tolerance)}: must be a number from {TIGHTEST:g} to {LOOSEST:g} times the "
                f"accuracy, which is {loosest:g} for accuracy = {self.accuracy:g}.",
                code="out-of-range",
                values={"argument": "tolerance"},
            )
        if self.finest is not None:
            whole_number(self.finest, "finest", LEAST_FINEST)
        if self.grid is not None:
            right = f"the number of cells along the window's longer edge, {LEAST_FINEST} or more"
            whole_number(self.grid, "grid", LEAST_FINEST, right=right)
        object.__setattr__(self, "layer", Layer.of(self.layer))
        object.__setattr__(self, "coulomb", checked_coulomb(self.coulomb))
        self._derived  # noqa: B018  raises where indenter, direction or backend cannot be used

    @property
    def residual(self) -> float:
        """The tolerance, as given or as the accuracy needs it."""
        return min(USUAL, LOOSEST * self.accuracy) if self.tolerance is None else self.tolerance

    @property
    def coarse_residual(self) -> float:
        """The tolerance of grids that are refined in any case: as the accuracy needs it, if that counts."""
        return self.residual if self.grid is not None else max(self.residual, LOOSEST * self.accuracy)

    @property
    def counterface(self) -> float:
        """(1 − ν_i²)/E_i of the indenter, 1/Pa; zero where it is rigid."""
        return self._derived[0]

    @property
    def counterface_coupling(self) -> float:
        """Normal displacement of the indenter by shear over that by pressure."""
        return half_space_coupling(self.indenter_poisson_ratio)

    @property
    def toward(self) -> tuple[float, float]:
        """Direction of the motion, of length one."""
        return self._derived[1]

    @property
    def where(self) -> Backend:
        """Arrays and FFTs that the contact is solved with."""
        return self._derived[2]

    @cached_property
    def _derived(self) -> tuple[float, tuple[float, float], Backend]:
        return (
            indenter_compliance(self.indenter_modulus, self.indenter_poisson_ratio),
            unit_direction(self.direction),
            Backend.of(self.backend),
        )
