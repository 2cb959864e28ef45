"""Friction coefficients against speed and temperature, measured or predicted, and their prediction."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.steady import solve_steady
from viscofric.errors import InputError
from viscofric.processes import call_all
from viscofric.units import Quantities, Quantity, celsius, positive, to_si_array

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import xarray
    from numpy.typing import NDArray

    from viscofric.contact.indenters import Ball
    from viscofric.contact.solution import ContactSolution
    from viscofric.rheology.material import Material

    Array: TypeAlias = NDArray[np.float64]

#: A temperature or load that is asked for finds the curves at the nearest one, if it is no further off than
#: this.
SAME_TEMPERATURE = 1.0  # K
SAME_LOAD = 0.05  # relative

_REQUIRED = ("speed", "temperature", "load", "viscoelastic", "viscoelastic_error", "viscoelastic_scatter")
_OPTIONAL = (
    "coulomb",
    "coulomb_error",
    "coulomb_scatter",
    "consistency",
    "consistency_error",
    "slip",
    "offset",
)

# name -> (unit, what it is), for labelled data
_LABELS = {
    "speed": ("m/s", "speed at which the rubber is deformed"),
    "temperature": ("K", "temperature"),
    "load": ("N", "normal load"),
    "viscoelastic": ("1", "viscoelastic friction coefficient"),
    "viscoelastic_error": ("1", "standard error of the viscoelastic friction coefficient"),
    "viscoelastic_scatter": ("1", "standard deviation of viscoelastic friction over the replicates"),
    "replicates": ("1", "number of replicates"),
    "coulomb": ("1", "Coulomb friction coefficient"),
    "coulomb_error": ("1", "standard error of the Coulomb friction coefficient"),
    "coulomb_scatter": ("1", "standard deviation of Coulomb friction over the replicates"),
    "consistency": ("1", "what the sign configurations leave over, relative to the load"),
    "consistency_error": ("1", "standard error of the consistency"),
    "slip": ("m/s", "magnitude of the sliding velocity"),
    "offset": ("N", "zero reading of the force cell"),
}


@dataclass(frozen=True, eq=False)
class FrictionCurves:
    """Viscoelastic (and Coulomb) friction coefficients, one entry per speed and temperature.

    An infinite standard error says that the number beside it could not be found from the data.

    Attributes
    ----------
    speed : (n,) array
        Speed at which the rubber is deformed, above zero, m/s.
    temperature : (n,) array
        K.
    load : (n,) array
        Normal load (mean over the readings where measured), N.
    viscoelastic : (n,) array
        Viscoelastic friction coefficient.
    viscoelastic_error : (n,) array
        Standard error of the mean where measured, numerical error estimate where predicted.
    viscoelastic_scatter : (n,) array
        Standard deviation over the replicates (zero where predicted).
    replicates : (n,) array of int
        Repetitions behind each entry (1 where predicted).
    coulomb, coulomb_error, coulomb_scatter : (n,) array or None
        The same for the Coulomb friction coefficient; None where predicted.
    consistency, consistency_error : (n,) array or None
        What four sign configurations leave over of three unknowns, (F_I − F_II + F_III − F_IV)/4 over the
        load, and its standard error: zero within it in a sound measurement.  None where predicted or not
        available.
    source : str
    notes : tuple of str
        One sentence each.
    slip : (n,) array or None
        Magnitude of the sliding velocity, m/s; None where predicted.
    offset : (n,) array or None
        Zero reading of the force cell, N; None where predicted.

    Raises
    ------
    InputError
        If a column has the wrong length, a value is not finite, or a speed, temperature or load is not
        above zero.
    """

    speed: Array
    temperature: Array
    load: Array
    viscoelastic: Array
    viscoelastic_error: Array
    viscoelastic_scatter: Array
    replicates: NDArray[np.int64]
    coulomb: Array | None = None
    coulomb_error: Array | None = None
    coulomb_scatter: Array | None = None
    consistency: Array | None = None
    consistency_error: Array | None = None
    source: str = ""
    notes: tuple[str, ...] = ()
    slip: Array | None = None
    offset: Array | None = None

    def __post_init__(self) -> None:
        shape = (np.size(self.speed),)
        for name in (*_REQUIRED, *_OPTIONAL):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, _column(getattr(self, name), name, shape))
        replicates = np.array(self.replicates, dtype=np.int64)
        if replicates.shape != shape:
            raise InputError("replicates of friction curves must hold one whole number per speed.")
        replicates.flags.writeable = False
        object.__setattr__(self, "replicates", replicates)
        for name in ("speed", "temperature", "load"):
            if not np.all(getattr(self, name) > 0.0):
                raise InputError(f"{name} of friction curves must be above zero everywhere.")

    def __len__(self) -> int:
        return len(self.speed)

    @property
    def temperatures(self) -> Array:
        """The different temperatures, K, ascending."""
        return np.unique(self.temperature)

    @property
    def speeds(self) -> Array:
        """The different speeds, m/s, ascending."""
        return np.unique(self.speed)

    @classmethod
    def from_solutions(cls, solutions: Iterable[ContactSolution], *, source: str = "predicted") -> FrictionCurves:
        """Collect the friction of solved contacts.

        Parameters
        ----------
        solutions : iterable of ContactSolution
            Each with a temperature and a finite speed other than zero; a negative one counts as its mirror
            image.
        source : str

        Returns
        -------
        FrictionCurves
            In the order of the solutions, with their numerical error estimates and their warnings as notes.

        Raises
        ------
        InputError
            If a solution has no temperature, or its speed is zero or infinite.
        """
        solved = tuple(solutions)
        for solution in solved:
            if solution.temperature is None:
                raise InputError("temperature of a contact solution is missing; friction curves need one.")
            if solution.speed == 0.0 or not math.isfinite(solution.speed):
                raise InputError(f"speed = {solution.speed:g} m/s of a solution must be finite and not zero.")
        return cls(
            speed=np.array([abs(solution.speed) for solution in solved]),
            temperature=np.array([solution.temperature for solution in solved], dtype=float),
            load=np.array([solution.load for solution in solved]),
            viscoelastic=np.array([math.copysign(1.0, s.speed) * s.friction_coefficient for s in solved]),
            viscoelastic_error=np.array([solution.diagnostics.friction_error for solution in solved]),
            viscoelastic_scatter=np.zeros(len(solved)),
            replicates=np.ones(len(solved), dtype=np.int64),
            source=source,
            notes=_warnings(solved),
        )

    def select(self, keep: NDArray[np.bool_] | NDArray[np.int64]) -> FrictionCurves:
        """Return the entries that a mask or row numbers pick, in that order; notes and source stay."""
        columns = {
            field.name: getattr(self, field.name)[keep]
            for field in fields(self)
            if isinstance(getattr(self, field.name), np.ndarray)
        }
        return replace(self, **columns)

    def at_temperature(self, temperature: Quantity) -> FrictionCurves:
        """Return the entries at one temperature, in ascending speed.

        Parameters
        ----------
        temperature : float, str or pint.Quantity
            K if a plain number.  The nearest temperature there is counts, if it is within 1 K.

        Raises
        ------
        InputError
            If there is none so near.
        """
        wanted = positive(temperature, "K", "temperature")
        there = self.temperatures
        if not there.size or np.min(np.abs(there - wanted)) > SAME_TEMPERATURE:
            known = ", ".join(f"{celsius(float(one)):.1f}" for one in there) or "none"
            raise InputError(
                f"temperature = {celsius(wanted):.1f} °C: there is no friction curve within "
                f"{SAME_TEMPERATURE:g} K of it; those there are at {known} °C."
            )
        nearest = there[np.argmin(np.abs(there - wanted))]
        rows = np.flatnonzero(self.temperature == nearest)
        return self.select(rows[np.argsort(self.speed[rows], kind="stable")])

    def at_load(self, load: Quantity) -> FrictionCurves:
        """Return the entries whose load is within 5 % of the one given.

        Parameters
        ----------
        load : float, str or pint.Quantity
            N if a plain number.

        Raises
        ------
        InputError
            If there are none.
        """
        wanted = positive(load, "N", "load")
        keep = np.abs(self.load - wanted) <= SAME_LOAD * wanted
        if not np.any(keep):
            loads = f"run from {self.load.min():.3g} to {self.load.max():.3g} N" if len(self) else "are none"
            raise InputError(f"load = {wanted:g} N: no entry is within 5 % of it; the loads {loads}.")
        return self.select(keep)

    def to_dataset(self) -> xarray.Dataset:
        """Return the curves as a labelled data set along ``point``, units and names in its attributes."""
        import xarray

        columns = {
            name: ("point", getattr(self, name), {"units": unit, "long_name": long_name})
            for name, (unit, long_name) in _LABELS.items()
            if getattr(self, name) is not None
        }
        names = [name for name in ("speed", "temperature", "load", "slip") if name in columns]
        coordinates = {name: columns.pop(name) for name in names}
        return xarray.Dataset(
            columns, coords=coordinates, attrs={"source": self.source, "notes": "\n".join(self.notes)}
        )


def _column(values: object, name: str, shape: tuple[int, ...]) -> Array:
    column = np.array(values, dtype=float)
    if column.shape != shape:
        raise InputError(f"{name} of friction curves must hold one value per speed.")
    if name.endswith(("_error", "_scatter")):
        if not np.all(column >= 0.0):
            raise InputError(f"{name} of friction curves must be zero or above everywhere.")
    elif not np.all(np.isfinite(column)):
        raise InputError(f"{name} of friction curves must be finite everywhere.")
    column.flags.writeable = False
    return column


def _warnings(solutions: tuple[ContactSolution, ...]) -> tuple[str, ...]:
    """Say once what many solutions warn of."""
    warned = [solution for solution in solutions if solution.warnings]
    if not warned:
        return ()
    different = {warning for solution in warned for warning in solution.warnings}
    if len(different) <= 1:
        return (f"In {len(warned)} of {len(solutions)} contacts: {warned[0].warnings[0]}",)
    worst = max(warned, key=lambda solution: solution.half_width)
    return tuple(
        f"In {len(warned)} of {len(solutions)} contacts there are warnings; that of the widest one: {warning}"
        for warning in worst.warnings
    )


def predict_friction(
    material: Material,
    indenter: Ball,
    *,
    speeds: Quantities,
    temperatures: Quantities,
    load: Quantity,
    accuracy: float = 1e-3,
    workers: int = 1,
    progress: Callable[[int, int], object] | None = None,
) -> FrictionCurves:
    """Predict the viscoelastic friction at every one of the speeds and temperatures by solving the contact.

    Parameters
    ----------
    material : Material
        With a shift law.
    indenter : Ball
    speeds : float, str, pint.Quantity, or an array or list of them
        Speeds at which the rubber is deformed, above zero; m/s if plain numbers.
    temperatures : float, str, pint.Quantity, or an array or list of them
        K if plain numbers.
    load : float, str or pint.Quantity
        Normal load, N if a plain number.
    accuracy : float
        Relative error of each friction coefficient that is aimed at; see `solve_steady`.
    workers : int
        Processes that share the contacts out among them; the result is the same to the last digit.
    progress : callable, optional
        Called as ``progress(done, total)`` before the first and after every contact.

    Returns
    -------
    FrictionCurves
        Temperature after temperature in the order given, each with all speeds.

    Raises
    ------
    InputError
        If a value cannot be used.
    ConvergenceError
        If a contact cannot be solved to the accuracy.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> curves = vf.predict_friction(
    ...     rubber,
    ...     vf.Ball(radius="9.525 mm"),
    ...     speeds=["20 mm/s", "200 mm/s"],
    ...     temperatures="60 degC",
    ...     load="25 N",
    ... )
    >>> curves.viscoelastic.round(3)
    array([0.025, 0.016])
    """
    velocities = to_si_array(speeds, "m/s", "speeds")
    kelvins = to_si_array(temperatures, "K", "temperatures")
    force = positive(load, "N", "load")
    for name, values, unit in (("speeds", velocities, "m/s"), ("temperatures", kelvins, "K")):
        if not values.size:
            raise InputError(f"{name} must hold at least one value.")
        if not np.all(values > 0.0):
            raise InputError(f"{name} must be above zero everywhere, but one is {values.min():g} {unit}.")
    contacts = [
        {
            "material": material,
            "indenter": indenter,
            "speed": float(velocity),
            "load": force,
            "temperature": float(kelvin),
            "accuracy": accuracy,
        }
        for kelvin in kelvins
        for velocity in velocities
    ]

    def tell(done: int) -> None:
        if progress is not None:
            progress(done, len(contacts))

    tell(0)
    solutions: list[ContactSolution] = call_all(solve_steady, contacts, workers=workers, progress=tell)
    return FrictionCurves.from_solutions(solutions)
