"""A material without a spectrum: E' and E'' in a table, read between its frequencies by monotone interpolation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from viscofric.arguments import insist_on, numbers, sentences
from viscofric.data import MasterCurve
from viscofric.errors import InputError, check_choice
from viscofric.rheology.spectra.response import FrequencyResponse, checked_shift
from viscofric.units import to_si

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array, ComplexArray


#: What a table says beyond its ends.
Extrapolation: TypeAlias = Literal["refuse", "plateau"]

#: A frequency beyond an end by no more than rounding is that end.
_ROUNDING = 1e-12  # of ln ω


@dataclass(frozen=True, eq=False)
class ModulusTable(FrequencyResponse):
    """Complex modulus of a rubber at one temperature as a table.

    Between its frequencies ln E' and ln E'' are interpolated monotonically in ln ω (F. N. Fritsch, J. Butland, SIAM
    J. Sci. Stat. Comput. 5 (1984) 300): no overshoot, no negative modulus, and the same curve in any unit.  Negative
    frequencies give the conjugate.  E' and E'' are interpolated each by itself, so that they obey Kramers and
    Kronig only as well as the table does.

    Parameters
    ----------
    angular_frequency : (n,) array
        Ascending, above zero, at least two, rad/s.
    storage_modulus, loss_modulus : (n,) array
        Tensile, above zero, Pa.
    extrapolate : {"refuse", "plateau"}
        What lies beyond the table, ω = 0 included.  ``"refuse"`` raises.  ``"plateau"`` takes the ends for
        plateaus: E' stays what it is there, and E'' falls as ω below and as 1/ω above, as it does beyond the
        last of a solid's relaxations; an assumption, for those who know that nothing relaxes there.
    notes : tuple of str
        What was averaged or left out when it was made, one sentence each.

    Raises
    ------
    InputError
        If a value is not above zero, the arrays differ in length, or the frequencies do not ascend.

    Examples
    --------
    >>> import viscofric as vf
    >>> table = vf.ModulusTable([0.1, 1.0, 10.0], [3.0e6, 3.4e6, 4.0e6], [0.30e6, 0.41e6, 0.62e6])
    >>> complex(table.complex_modulus(1.0).round(3))
    (3400000+410000j)
    """

    angular_frequency: Array
    storage_modulus_values: Array
    loss_modulus_values: Array
    extrapolate: Extrapolation
    notes: tuple[str, ...]

    def __init__(
        self,
        angular_frequency: ArrayLike,
        storage_modulus: ArrayLike,
        loss_modulus: ArrayLike,
        extrapolate: Extrapolation = "refuse",
        notes: tuple[str, ...] = (),
    ) -> None:
        omega = _column(angular_frequency, "angular_frequency")
        object.__setattr__(self, "angular_frequency", omega)
        object.__setattr__(self, "storage_modulus_values", _column(storage_modulus, "storage_modulus"))
        object.__setattr__(self, "loss_modulus_values", _column(loss_modulus, "loss_modulus"))
        object.__setattr__(self, "extrapolate", extrapolate)
        object.__setattr__(self, "notes", sentences(notes, "notes of a modulus table"))
        sizes = len(omega), len(self.storage_modulus_values), len(self.loss_modulus_values)
        if len(set(sizes)) > 1:
            raise InputError(
                "a modulus table must have as many frequencies as storage and loss moduli: there are "
                f"{sizes[0]}, {sizes[1]} and {sizes[2]}."
            )
        if sizes[0] < 2 or np.any(np.diff(omega) <= 0.0):
            raise InputError("angular_frequency of a modulus table must ascend without repeats, two at least.")
        check_choice(extrapolate, "extrapolate", "refuse", "plateau")

    def __repr__(self) -> str:
        low, high = self.angular_frequency[[0, -1]]
        return f"ModulusTable({len(self.angular_frequency)} frequencies, {low:.3g} to {high:.3g} rad/s)"

    @classmethod
    def from_master_curve(
        cls, master_curve: MasterCurve, *, resolution: float = 0.05, extrapolate: Extrapolation = "refuse"
    ) -> ModulusTable:
        """Return the table of a master curve, points that lie too close to each other averaged.

        Parameters
        ----------
        master_curve : MasterCurve
            At least two points further apart than `resolution`.
        resolution : float
            Points that lie within so many decades of frequency of each other are averaged, by their logarithms;
            those of different isotherms scatter about each other, and are not to be interpolated one by one.
        extrapolate : {"refuse", "plateau"}
            As for the table.

        Raises
        ------
        InputError
            If the resolution is below zero, or one point only is left.
        """
        insist_on(master_curve, "master_curve", MasterCurve)
        decades = to_si(resolution, "dimensionless", "resolution")
        if decades < 0.0:
            raise InputError(f"resolution = {resolution!r}: must be a number of decades, not below zero.")
        log_omega = np.log(master_curve.angular_frequency)
        width, groups, first = decades * np.log(10.0) + _ROUNDING, [], 0
        for index in range(len(log_omega)):
            if log_omega[index] - log_omega[first] > width:
                first = index
            groups.append(first)
        _, place = np.unique(groups, return_inverse=True)
        count = np.bincount(place)
        omega, storage, loss = (
            np.exp(np.bincount(place, weights=np.log(values)) / count)
            for values in (master_curve.angular_frequency, master_curve.storage_modulus, master_curve.loss_modulus)
        )
        note = (
            f"{len(log_omega)} points of the master curve were averaged to {len(count)}, those within "
            f"{decades:g} decade of frequency together."
        )
        return cls(omega, storage, loss, extrapolate, (note,) if len(count) < len(log_omega) else ())

    def __len__(self) -> int:
        return len(self.angular_frequency)

    def to_dataset(self) -> xarray.Dataset:
        """Return ``storage_modulus`` and ``loss_modulus`` (Pa) along ``angular_frequency`` (rad/s), as tabulated."""
        return self.modulus_dataset(self.angular_frequency)

    @property
    def E0(self) -> float:
        """Rubber modulus E(0), Pa; only where the ends are taken for plateaus."""
        return float(self.complex_modulus(0.0).real)

    @property
    def E_inf(self) -> float:
        """Glass modulus E(∞), Pa; only where the ends are taken for plateaus."""
        return float(self.complex_modulus(np.inf).real)

    @cached_property
    def _curves(self) -> tuple[Any, Any]:
        from scipy.interpolate import PchipInterpolator

        log_omega = np.log(self.angular_frequency)
        return (
            PchipInterpolator(log_omega, np.log(self.storage_modulus_values)),
            PchipInterpolator(log_omega, np.log(self.loss_modulus_values)),
        )

    def complex_modulus(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return E(ω) = E' + iE'', Pa, in the shape of `angular_frequency` (rad/s, any sign).

        Raises
        ------
        InputError
            If a frequency lies outside the table and the table refuses that, or is NaN.
        """
        signed = numbers(angular_frequency, "angular_frequency", infinite=True)
        omega = np.abs(signed)
        low, high = float(self.angular_frequency[0]), float(self.angular_frequency[-1])
        outside = ~((omega >= low * (1.0 - _ROUNDING)) & (omega <= high * (1.0 + _ROUNDING)))
        if self.extrapolate == "refuse" and np.any(outside):
            wanted = float(np.ravel(omega[outside])[0])
            raise InputError(
                f"angular frequency = {wanted:.4g} rad/s lies outside the table's {low:.4g} to {high:.4g} rad/s; "
                "ModulusTable(…, extrapolate='plateau') takes its ends for plateaus, a spectrum is fitted to go beyond."
            )
        inside = np.clip(omega, low, high)
        log_inside = np.clip(np.log(inside), np.log(low), np.log(high))
        storage, loss = (np.exp(curve(log_inside)) for curve in self._curves)
        loss = loss * np.where(omega < low, omega / low, high / np.maximum(omega, high))
        return np.asarray(storage + 1j * np.sign(signed) * loss)

    def compliance(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return S(ω) = 1/E(ω), 1/Pa, in the shape of `angular_frequency` (rad/s, any sign)."""
        return np.asarray(1.0 / self.complex_modulus(angular_frequency))

    def shifted(self, alpha: float, b: float = 1.0) -> ModulusTable:
        """Return the table at a temperature with shift factor α (and vertical shift b).

        From E(ω, T) = b E(αω, T0): every frequency is divided by α, every modulus multiplied by b.
        """
        alpha, b = checked_shift(alpha, b)
        return ModulusTable(
            self.angular_frequency / alpha,
            b * self.storage_modulus_values,
            b * self.loss_modulus_values,
            self.extrapolate,
            self.notes,
        )


def _column(values: ArrayLike, name: str) -> Array:
    column = np.atleast_1d(np.array(numbers(values, name)))
    if column.ndim != 1 or not np.all(column > 0.0):
        raise InputError(f"{name} of a modulus table must be one row of finite numbers above zero.")
    column.flags.writeable = False
    return column
