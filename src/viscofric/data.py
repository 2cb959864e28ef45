"""What readers hand over: typed, immutable measurements in SI units, with notes on what was doubtful."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.steps import TractionStep, summarised
from viscofric.units import positive

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    Array: TypeAlias = NDArray[np.float64]

#: How a dynamic mechanical analyser deformed its sample.
Deformation: TypeAlias = Literal["tension", "shear"]


def _column(values: object) -> Array:
    """Return a read-only float copy, so that frozen measurements stay frozen."""
    column = np.array(values, dtype=float)
    column.flags.writeable = False
    return column


@dataclass(frozen=True, eq=False)
class Isotherm:
    """One frequency sweep at one temperature.

    Parameters
    ----------
    temperature : float
        Mean measured temperature, K.
    angular_frequency : (n,) array
        Ascending, without repeats, rad/s.
    storage_modulus, loss_modulus : (n,) array
        As measured (tensile or shear, see `IsothermalSweeps.deformation`), positive, Pa.
    strain_amplitude : (n,) array, optional
        Of the oscillation, as a fraction (0.01 is 1 %); NaN where it was not recorded.
    """

    temperature: float
    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    strain_amplitude: Array | None = None

    def __post_init__(self) -> None:
        for name in ("angular_frequency", "storage_modulus", "loss_modulus"):
            column = _column(getattr(self, name))
            if column.shape != (np.size(self.angular_frequency),) or not np.all(column > 0):
                raise InputError(f"{name} of an isotherm must be one row of positive numbers, one per frequency.")
            object.__setattr__(self, name, column)
        if np.any(np.diff(self.angular_frequency) <= 0):
            raise InputError("the frequencies of an isotherm must ascend without repeats.")
        if self.strain_amplitude is not None:
            amplitude = _column(self.strain_amplitude)
            if amplitude.shape != self.angular_frequency.shape or np.any(amplitude < 0):
                raise InputError("strain_amplitude of an isotherm must be one fraction per frequency, none below zero.")
            object.__setattr__(self, "strain_amplitude", amplitude)

    def __len__(self) -> int:
        return len(self.angular_frequency)


@dataclass(frozen=True, eq=False)
class IsothermalSweeps:
    """Frequency sweeps of a dynamic mechanical analyser at several temperatures.

    Parameters
    ----------
    isotherms : tuple of Isotherm
        In ascending temperature.
    deformation : {"tension", "shear"}
        Whether the moduli are E (tension) or G (shear).
    source : str
        Where they came from (a file's name).
    notes : tuple of str
        What the reader found doubtful, left out, sorted or averaged: one sentence each.
    format : str
        What the reader took the file for, in words; empty for sweeps that no file holds.
    deformation_told : bool
        Whether a file or a person said what `deformation` is; False where it was assumed.
    """

    isotherms: tuple[Isotherm, ...]
    deformation: Deformation = "tension"
    source: str = ""
    notes: tuple[str, ...] = ()
    format: str = ""
    deformation_told: bool = True

    def __post_init__(self) -> None:
        if self.deformation not in ("tension", "shear"):
            raise InputError(f"deformation = {self.deformation!r}: must be 'tension' or 'shear'.")
        object.__setattr__(self, "isotherms", tuple(sorted(self.isotherms, key=lambda sweep: sweep.temperature)))

    def __len__(self) -> int:
        return len(self.isotherms)

    @property
    def temperatures(self) -> Array:
        """Temperatures of the isotherms, K, ascending."""
        return np.array([sweep.temperature for sweep in self.isotherms])

    def in_tension(self, poisson_ratio: float) -> IsothermalSweeps:
        """Return the sweeps as tensile moduli, E = 2(1+ν)G if they were measured in shear."""
        if self.deformation == "tension":
            return self
        factor = 2.0 * (1.0 + poisson_ratio)
        isotherms = tuple(
            replace(
                sweep,
                storage_modulus=factor * sweep.storage_modulus,
                loss_modulus=factor * sweep.loss_modulus,
            )
            for sweep in self.isotherms
        )
        note = f"Shear moduli turned into tensile ones by E = 2(1+ν)G with ν = {poisson_ratio:g}."
        return replace(self, isotherms=isotherms, deformation="tension", notes=(*self.notes, note))


@dataclass(frozen=True, eq=False)
class MasterCurve:
    """Tensile modulus at one reference temperature, every measured point moved by its isotherm's shift.

    Parameters
    ----------
    angular_frequency : (n,) array
        Reduced, α(T) ω, ascending, rad/s.
    storage_modulus, loss_modulus : (n,) array
        Pa.
    temperature : (n,) array
        Of the isotherm that each point comes from, K.
    reference : float
        K.
    """

    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    temperature: Array
    reference: float

    def __post_init__(self) -> None:
        shape = np.shape(self.angular_frequency)
        for name in ("angular_frequency", "storage_modulus", "loss_modulus", "temperature"):
            column = _column(getattr(self, name))
            if column.ndim != 1 or column.shape != shape or not np.all((column > 0) & np.isfinite(column)):
                raise InputError(f"{name} of a master curve must be one row of positive numbers, one per point.")
            object.__setattr__(self, name, column)
        object.__setattr__(self, "reference", positive(self.reference, "K", "reference"))
        if np.any(np.diff(self.angular_frequency) < 0):
            raise InputError("the frequencies of a master curve must ascend.")

    def __len__(self) -> int:
        return len(self.angular_frequency)

    @property
    def complex_modulus(self) -> NDArray[np.complex128]:
        """E' + iE'', Pa."""
        return np.asarray(self.storage_modulus + 1j * self.loss_modulus)

    @property
    def loss_tangent(self) -> Array:
        """E''/E'."""
        return np.asarray(self.loss_modulus / self.storage_modulus)


@dataclass(frozen=True, eq=False)
class TractionRuns:
    """Traction measurements of a mini-traction machine, one row per reading.

    Velocities are signed: the sign of `disc_speed` is the direction in which the rubber is deformed, the
    sign of ``disc_speed - ball_speed`` that of sliding.

    Parameters
    ----------
    disc_speed, ball_speed : (n,) array
        Signed surface velocities, m/s.
    traction_force : (n,) array
        Signed force on the ball's force cell, zero reading included, N.
    load : (n,) array
        Measured normal load, N.
    temperature : (n,) array
        K.
    replicate : (n,) array of int
        Number of the repetition that a row belongs to.
    source : str
        Where they came from.
    notes : tuple of str
        What the reader found doubtful or changed: one sentence each.
    zero_force : (n,) array, optional
        Reading of the force cell without traction, N; NaN where it was not recorded.
    time : (n,) array, optional
        Since the first reading, s; NaN where it was not recorded.
    step : (n,) array of int, optional
        Number of the step of the test that a row belongs to, counted through all files.
    track_radius : (n,) array, optional
        Of the ball's track on the disc, m; NaN where it was not recorded.
    steps : tuple of TractionStep
        What the files say of the steps, which `step` numbers; counts and means are taken from the rows, and steps
        without rows are left out.
    """

    disc_speed: Array
    ball_speed: Array
    traction_force: Array
    load: Array
    temperature: Array
    replicate: NDArray[np.int64]
    source: str = ""
    notes: tuple[str, ...] = ()
    zero_force: Array | None = None
    time: Array | None = None
    step: NDArray[np.int64] | None = None
    track_radius: Array | None = None
    steps: tuple[TractionStep, ...] = ()

    def __post_init__(self) -> None:
        rows = np.size(self.disc_speed)
        for name in ("disc_speed", "ball_speed", "traction_force", "load", "temperature"):
            column = _column(getattr(self, name))
            if column.shape != (rows,) or not np.all(np.isfinite(column)):
                raise InputError(f"{name} of traction runs must be one row of finite numbers, one per reading.")
            object.__setattr__(self, name, column)
        for name in ("zero_force", "time", "track_radius"):
            if getattr(self, name) is None:
                continue
            column = _column(getattr(self, name))
            if column.shape != (rows,) or np.any(np.isinf(column)):
                raise InputError(
                    f"{name} of traction runs must hold one number per reading, NaN where it is not known."
                )
            object.__setattr__(self, name, column)
        for name in ("replicate", "step"):
            if getattr(self, name) is None and name == "step":
                continue
            numbers = np.array(getattr(self, name), dtype=np.int64)
            if numbers.shape != (rows,):
                raise InputError(f"{name} of traction runs must hold one whole number per reading.")
            numbers.flags.writeable = False
            object.__setattr__(self, name, numbers)
        if rows and not np.all(self.load > 0):
            raise InputError("load of traction runs must be above zero in every reading.")
        object.__setattr__(self, "steps", summarised(self, self.steps))

    def __len__(self) -> int:
        return len(self.disc_speed)

    def select(
        self,
        rows: ArrayLike | None = None,
        *,
        steps: int | Sequence[int] | None = None,
        except_steps: int | Sequence[int] | None = None,
    ) -> TractionRuns:
        """Return some of the readings: ``runs.select(runs.temperature > 330)``, ``runs.select(steps=[2, 4])``.

        Parameters
        ----------
        rows : (n,) array of bool, or array of int, optional
            Which readings to keep, or their places; if left out, all.
        steps, except_steps : int or sequence of int, optional
            Numbers of the steps to keep, or to leave out, of these readings.

        Returns
        -------
        TractionRuns
            With a note on how many readings it holds; times and replicate numbers stay as they are.

        Raises
        ------
        InputError
            If nothing is selected, `rows` does not fit the readings, or there are no such steps.
        """
        chosen = np.arange(len(self)) if rows is None else np.asarray(rows)
        if chosen.dtype == bool and chosen.shape == (len(self),):
            chosen = np.flatnonzero(chosen)
        elif chosen.ndim != 1 or not np.issubdtype(chosen.dtype, np.integer):
            raise InputError(f"select needs true or false for each of the {len(self)} readings, or their places.")
        if chosen.size and (chosen.min() < -len(self) or chosen.max() >= len(self)):
            raise InputError(f"select names a reading beyond the {len(self)} that there are.")
        for name, wanted, keep in (("steps", steps, True), ("except_steps", except_steps, False)):
            if wanted is not None:
                chosen = chosen[self._in_steps(name, wanted)[chosen] == keep]
        if not chosen.size:
            raise InputError("select would leave no reading; see steps for what there is.")
        columns: dict[str, Any] = {
            column.name: value[chosen]
            for column in fields(self)
            if isinstance(value := getattr(self, column.name), np.ndarray)
        }
        note = f"{chosen.size} of {len(self)} readings are selected."
        return replace(self, **columns, notes=(*self.notes, note))

    def _in_steps(self, name: str, wanted: int | Sequence[int]) -> NDArray[np.bool_]:
        """Tell which readings belong to some steps, all of which there must be."""
        if self.step is None:
            raise InputError(f"{name} = {wanted!r}: these traction runs do not say what steps they are of.")
        numbers = np.atleast_1d(np.asarray(wanted))
        known = np.isin(numbers, self.step)
        if not np.all(known):
            raise InputError(
                f"{name} = {wanted!r}: there is no step {numbers[~known][0]}; steps go from {self.step.min()} to "
                f"{self.step.max()}."
            )
        return np.isin(self.step, numbers)
