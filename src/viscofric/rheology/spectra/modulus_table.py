"""A material without a spectrum: E' and E'' in a table, interpolated; and retardation modes fitted to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import insist_on, sentences
from viscofric.arrays import Array, ComplexArray
from viscofric.data import MasterCurve
from viscofric.datasets import Dataset
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.notes import Note
from viscofric.rheology.spectra.fit_verdict import judged, solid_modes
from viscofric.rheology.spectra.misfit import ModulusMisfit
from viscofric.rheology.spectra.mode_fits import joint_error, lattice, nonnegative_modes
from viscofric.rheology.spectra.response import FrequencyResponse, checked_shift
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.spectrum_fit import as_spectrum
from viscofric.showing import Items, Rows, rows_of
from viscofric.threads import one_blas_thread
from viscofric.units import in_si, to_si

#: Extrapolation of a table beyond its ends.
Extrapolation: TypeAlias = Literal["refuse", "plateau"]

#: A frequency beyond an end by less than this is that end.
_ROUNDING = 1e-12  # of ln ω


@dataclass(frozen=True, eq=False)
class ModulusTable(FrequencyResponse, Items[tuple[float, float, float]]):
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
    >>> table = vf.rheology.ModulusTable([0.1, 1.0, 10.0], [3.0e6, 3.4e6, 4.0e6], [0.30e6, 0.41e6, 0.62e6])
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
                f"{sizes[0]}, {sizes[1]} and {sizes[2]}.",
                code="wrong-length",
            )
        if sizes[0] < 2 or np.any(np.diff(omega) <= 0.0):
            raise InputError(
                "angular_frequency of a modulus table must ascend without repeats, two at least.", code="not-ascending"
            )
        check_choice(extrapolate, "extrapolate", "refuse", "plateau")

    def _shown(self) -> Rows:
        return (
            ("angular frequency", self.angular_frequency, "rad/s"),
            ("storage modulus", self.storage_modulus_values, "Pa"),
            ("loss modulus", self.loss_modulus_values, "Pa"),
            ("outside", self.extrapolate),
            ("notes", self.notes),
        )

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
            raise wrong_argument(
                "resolution", resolution, "must be a number of decades, not below zero.", "not-positive"
            )
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
        note = Note(
            "points-averaged",
            f"{len(log_omega)} points of the master curve were averaged to {len(count)}, those within "
            f"{decades:g} decade of frequency together.",
            values={"points": len(log_omega), "averaged": len(count), "decades": decades},
        )
        return cls(omega, storage, loss, extrapolate, (note,) if len(count) < len(log_omega) else ())

    def _items(self) -> Sequence[tuple[float, float, float]]:
        return rows_of(self.angular_frequency, self.storage_modulus_values, self.loss_modulus_values)

    def to_dataset(self) -> Dataset:
        """Return ``storage_modulus`` and ``loss_modulus`` (Pa) along ``angular_frequency`` (rad/s), as tabulated."""
        return self.modulus_dataset(self.angular_frequency)

    @property
    def E0(self) -> float:
        """Rubber modulus E(0), Pa; only where the ends are treated as plateaus."""
        return float(self.complex_modulus(0.0).real)

    @property
    def E_inf(self) -> float:
        """Glass modulus E(∞), Pa; only where the ends are treated as plateaus."""
        return float(self.complex_modulus(np.inf).real)

    @property
    def known_frequencies(self) -> None:
        """None: outside the table it has no modulus, or one that it was told to extrapolate."""
        return None

    @cached_property
    def _curves(self) -> tuple[Any, Any]:
        from scipy.interpolate import PchipInterpolator

        log_omega = np.log(self.angular_frequency)
        return (
            PchipInterpolator(log_omega, np.log(self.storage_modulus_values)),
            PchipInterpolator(log_omega, np.log(self.loss_modulus_values)),
        )

    def complex_modulus(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return E(ω) = E' + iE'', Pa.

        Parameters
        ----------
        angular_frequency : array_like
            rad/s, of any sign.

        Returns
        -------
        complex array
            In the shape of `angular_frequency`.

        Raises
        ------
        InputError
            If a frequency is outside the table and not to be extrapolated, or is NaN.
        """
        signed = in_si(angular_frequency, "rad/s", "angular_frequency", infinite=True)
        omega = np.abs(signed)
        low, high = float(self.angular_frequency[0]), float(self.angular_frequency[-1])
        outside = ~((omega >= low * (1.0 - _ROUNDING)) & (omega <= high * (1.0 + _ROUNDING)))
        if self.extrapolate == "refuse" and np.any(outside):
            wanted = float(np.ravel(omega[outside])[0])
            raise InputError(
                f"angular frequency = {wanted:.4g} rad/s lies outside the table's {low:.4g} to {high:.4g} rad/s; "
                "extrapolate='plateau' treats its ends as plateaus, and a fitted spectrum goes beyond.",
                code="outside-table",
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
        """Return the table at another temperature.

        From E(ω, T) = b E(αω, T0): every frequency is divided by α, every modulus multiplied by b.

        Parameters
        ----------
        alpha, b : float
            Shift factor and vertical shift there.

        Raises
        ------
        InputError
            If one is not above zero and finite.
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
    column = np.atleast_1d(np.array(in_si(values, "rad/s" if name == "angular_frequency" else "Pa", name)))
    if column.ndim != 1 or not np.all(column > 0.0):
        raise InputError(
            f"{name} of a modulus table must be one row of finite numbers above zero.", code="not-a-number"
        )
    column.flags.writeable = False
    return column


#: Largest joint rms error of log10 E' and log10 E'' of modes that represent a table: 12 %.
LARGEST_ERROR = 0.05
#: Ratios of neighbouring retardation times, each lattice tried only near the modes of the one before.  The error of a
#: time between two of the last is (ln ratio)²/8 = 2e-4.
RATIOS = (2.0, 2.0**0.25, 2.0**0.0625)
#: Joint error at which no finer lattice is tried.
CLOSE = 1e-6
#: Where a table treats its ends as plateaus, decades beyond over which they are fitted, and points per decade.
PLATEAU_DECADES, PLATEAU_POINTS = 2, 5
#: A table has no temperature; the assessment of a fit does not depend on it.
ANY_TEMPERATURE = 298.15


@one_blas_thread
def modes_of_table(table: ModulusTable) -> RetardationSpectrum:
    """Fit retardation modes to a table of at least four frequencies, with plateaus where the table has them."""
    # The sum of squares of the errors of ln E' and ln E'' is minimised over C ≥ 0 on a coarse lattice of times, then on
    # finer ones near the modes found, so that a few sharp modes are fitted as well as a broad spectrum.
    curve = _as_curve(table)
    if len(table) < 4:
        raise InputError(
            f"a modulus table of {len(table)} frequencies is too short for retardation modes; give 4 or more.",
            code="too-short",
        )
    misfit = ModulusMisfit(curve.angular_frequency, curve.complex_modulus)
    modes = nonnegative_modes(misfit, lattice(misfit, RATIOS[0]))
    error = joint_error(misfit, modes)
    for coarse, fine in pairwise(RATIOS):
        if error <= CLOSE:
            break
        tau, known = lattice(misfit, fine), modes.tau[modes.C > 0.0]
        near = np.abs(np.log(tau)[:, None] - np.log(known)).min(axis=1, initial=np.inf) <= 1.01 * np.log(coarse)
        closer = nonnegative_modes(misfit, tau[near])
        if (smaller := joint_error(misfit, closer)) < error:
            modes, error = closer, smaller
    if not error <= LARGEST_ERROR:
        solid_modes(misfit, lattice(misfit, RATIOS[0]), curve)  # raises LiquidError
        raise InputError(
            f"no retardation modes describe this table of moduli: the best leave an rms error of {error:.2g} decades "
            f"of E' and E'', more than {LARGEST_ERROR:g}, so that they are not one material's; smooth the table, or "
            "fit a spectrum to its master curve with fit_retardation_spectrum(…).",
            code="no-modes",
        )
    return judged(as_spectrum(modes), curve, method="non-negative")


def what_was_fitted(spectrum: RetardationSpectrum) -> tuple[str, ...]:
    """Return sentences that modes represent a table, and with which misfit."""
    fit = spectrum.fit
    if fit is None or fit.rms_storage is None or fit.rms_loss is None:
        return ()
    stands = Note(
        "modes-fitted",
        f"The material is a table of moduli, to which {fit.modes} retardation modes were fitted: rms errors of "
        f"{fit.rms_storage:.2g} decades of E' and {fit.rms_loss:.2g} of E''.",
        values={"modes": fit.modes, "rms_storage": fit.rms_storage, "rms_loss": fit.rms_loss},
    )
    return (stands, *fit.notes)


def _as_curve(table: ModulusTable) -> MasterCurve:
    omega = table.angular_frequency
    if table.extrapolate == "plateau":
        beyond = 10.0 ** (np.arange(1, PLATEAU_DECADES * PLATEAU_POINTS + 1) / PLATEAU_POINTS)
        omega = np.concatenate([omega[0] / beyond[::-1], omega, omega[-1] * beyond])
    modulus = table.complex_modulus(omega)
    return MasterCurve(omega, modulus.real, modulus.imag, np.full(len(omega), ANY_TEMPERATURE), ANY_TEMPERATURE)
