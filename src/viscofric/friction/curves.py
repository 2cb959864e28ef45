"""Friction coefficients against speed and temperature, measured or predicted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, Self, cast

import numpy as np

from viscofric.arguments import insist_on, sentences, text
from viscofric.arrays import Array, Integers, Mask
from viscofric.checks import Check
from viscofric.contact.solution import ContactSolution
from viscofric.data import picked, read_only, whole_numbers, with_rows
from viscofric.datasets import Dataset, dataset, on_grid
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.files import marked
from viscofric.friction.cases.record import columns_of
from viscofric.friction.curve_words import LABELS, LOADS
from viscofric.friction.intervals import consistency_check, half_widths
from viscofric.nominal import SAME_LOAD, SAME_TEMPERATURE, nominal_rows
from viscofric.notes import note_attributes
from viscofric.rheology.interface.friction import total_error
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantity, positive, share, shown_celsius

_REQUIRED = ("speed", "temperature", "load", "viscoelastic", "viscoelastic_error", "viscoelastic_scatter")
_COORDINATES = ("speed", "temperature", "load", "slip")


@dataclass(frozen=True, eq=False)
class FrictionCurves(Plotted):
    """Viscoelastic (and Coulomb) friction coefficients, one entry per speed and temperature.

    An infinite standard error means that the number could not be found from the data.

    Attributes
    ----------
    speed : (n,) array
        Speed at which the rubber is deformed, above zero, m/s.
    temperature : (n,) array
        K.
    load : (n,) array
        Normal load (mean over the readings where measured), in `load_unit`.
    viscoelastic : (n,) array
        Viscoelastic friction coefficient.
    viscoelastic_error : (n,) array
        Standard error of the mean where measured, numerical error estimate where predicted.
    viscoelastic_scatter : (n,) array
        Standard deviation over the replicates, pooled where these are few (zero where predicted).
    replicates : (n,) array of int
        Repetitions behind each entry (1 where predicted).
    coulomb, coulomb_error, coulomb_scatter : (n,) array or None
        The same for the Coulomb friction coefficient, of a measurement, of a prediction with an interface, or as given
        with heating, without an error; None where it is not known.
    consistency, consistency_error : (n,) array or None
        Residual of the four sign configurations, which have three unknowns, (F_I − F_II + F_III − F_IV)/4 over the
        load, and its standard error: zero within that error in a sound measurement.  None where predicted or not
        available.
    source : str
    notes : tuple of str
        One sentence each.
    slip : (n,) array or None
        Magnitude of the sliding velocity, m/s; None where predicted without Coulomb friction.
    offset : (n,) array or None
        Zero reading of the force cell, N; None where predicted.
    load_unit : {"N", "N/m"}
        That of the load: of a line contact it is per length.
    material_error : (n,) array or None
        Standard error of predicted friction due to the errors of the material, of spectrum and shift factors.
    viscoelastic_lower, viscoelastic_upper : (n,) array or None
        95 % limits of predicted friction due to the errors of the material.
    within_measured_frequencies : (n,) array or None
        0 for contacts at frequencies that were not measured, where friction and its limits belong to an extrapolated
        or, in gaps of the measurement, interpolated modulus; 1 for others.  None where friction was measured, or where
        no contact is known to be such.
    viscoelastic_freedom, coulomb_freedom : (n,) array or None
        Degrees of freedom behind the standard errors of measured friction, infinite where these are known exactly;
        `interval` uses them.
    mean_pressure, mean_pressure_error : (n,) array or None
        Load over contact area of solved contacts, and its error estimate, Pa; None where measured.
    assumption : str
        The assumption behind the viscoelastic friction, in one sentence; empty where there is none.

    Raises
    ------
    InputError
        If a column has the wrong length, a value is not finite, or a speed, temperature or load is not
        above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> n = 3
    >>> curves = vf.FrictionCurves(
    ...     speed=np.array([0.02, 0.06, 0.2]),
    ...     temperature=np.full(n, 333.15),
    ...     load=np.full(n, 25.0),
    ...     viscoelastic=np.array([0.025, 0.020, 0.016]),
    ...     viscoelastic_error=np.full(n, 2e-4),
    ...     viscoelastic_scatter=np.full(n, 6e-4),
    ...     replicates=np.full(n, 9),
    ... )
    >>> curves.select(curves.speed > 0.05).viscoelastic
    array([0.02 , 0.016])
    """

    speed: Array
    temperature: Array
    load: Array
    viscoelastic: Array
    viscoelastic_error: Array
    viscoelastic_scatter: Array
    replicates: Integers
    coulomb: Array | None = None
    coulomb_error: Array | None = None
    coulomb_scatter: Array | None = None
    consistency: Array | None = None
    consistency_error: Array | None = None
    source: str = ""
    notes: tuple[str, ...] = ()
    slip: Array | None = None
    offset: Array | None = None
    load_unit: str = "N"
    material_error: Array | None = None
    viscoelastic_lower: Array | None = None
    viscoelastic_upper: Array | None = None
    viscoelastic_freedom: Array | None = None
    coulomb_freedom: Array | None = None
    assumption: str = ""
    mean_pressure: Array | None = None
    mean_pressure_error: Array | None = None
    within_measured_frequencies: Array | None = None

    def __post_init__(self) -> None:
        check_choice(self.load_unit, "load_unit", "N", "N/m")
        shape = (read_only(self.speed, "speed of friction curves").size,)
        units = {name: unit.replace("1", "dimensionless") for name, (unit, _) in LABELS.items() if name != "replicates"}
        for name, unit in {**units, "load": self.load_unit}.items():
            if name in _REQUIRED or getattr(self, name) is not None:
                object.__setattr__(self, name, _column(getattr(self, name), name, shape, unit))
        replicates = whole_numbers(self.replicates, "replicates of friction curves")
        if replicates.shape != shape:
            raise InputError("replicates of friction curves must hold one whole number per speed.", code="wrong-length")
        object.__setattr__(self, "replicates", replicates)
        for name in ("source", "assumption"):
            text(getattr(self, name), f"{name} of friction curves")
        object.__setattr__(self, "notes", sentences(self.notes, "notes of friction curves"))
        for name in ("speed", "temperature", "load"):
            if not np.all(getattr(self, name) > 0.0):
                raise InputError(f"{name} of friction curves must be above zero everywhere.", code="not-positive")

    def __len__(self) -> int:
        return len(self.speed)

    def _shown(self) -> Rows:
        return (
            ("speed", self.speed, "m/s"),
            ("temperature", self.temperatures, "°C"),
            ("load", self.load, self.load_unit),
            ("viscoelastic friction", self.viscoelastic),
            ("its error", self.viscoelastic_error),
            ("Coulomb friction", self.coulomb),
            ("error by the material", self.material_error),
            ("replicates", self.replicates),
            ("source", self.source or None),
            ("notes", self.notes),
        )

    @property
    def temperatures(self) -> Array:
        """The different temperatures, K, ascending."""
        return np.unique(self.temperature)

    @property
    def speeds(self) -> Array:
        """The different speeds, m/s, ascending."""
        return np.unique(self.speed)

    @property
    def friction_coefficient(self) -> Array:
        """`viscoelastic`, (n,): the friction coefficient under the name that it has in single contacts."""
        return self.viscoelastic

    @property
    def friction_error(self) -> Array:
        """`viscoelastic_error`, (n,), under the name that it has in single contacts."""
        return self.viscoelastic_error

    @property
    def interface_friction(self) -> Array | None:
        """`coulomb`, (n,): the part of the interface under the name that it has on rough surfaces."""
        return self.coulomb

    @property
    def interface_error(self) -> Array | None:
        """`coulomb_error`, (n,), under the name that it has on rough surfaces."""
        return self.coulomb_error

    @property
    def total(self) -> Array:
        """Viscoelastic plus Coulomb friction, (n,): friction where the rubber is deformed in the direction of slip.

        Raises `InputError` where no Coulomb friction is known.
        """
        if self.coulomb is None:
            raise InputError(
                "these friction curves have no Coulomb friction; give predict_friction() an interface, or heating with "
                "coulomb.",
                code="no-coulomb",
            )
        return self.viscoelastic + self.coulomb

    @property
    def total_error(self) -> Array | None:
        """Standard error of `total`, (n,), from those of both parts and of the material; None where not known."""
        by_material = [] if self.material_error is None else [self.material_error]
        return total_error(self.viscoelastic_error, self.coulomb_error, *by_material)

    @property
    def consistency_check(self) -> Check | None:
        """Whether the sign configurations of the test agree within their errors; None where that is unknown."""
        if self.consistency is None or self.consistency_error is None:
            return None
        return consistency_check(self.consistency, self.consistency_error, self.viscoelastic_freedom)

    @classmethod
    def from_solutions(cls, solutions: Iterable[ContactSolution], *, source: str = "predicted") -> FrictionCurves:
        """Collect the friction of solved contacts.

        Parameters
        ----------
        solutions : iterable of ContactSolution
            Each with a temperature and a finite speed other than zero; a negative one is treated as its mirror
            image.
        source : str

        Returns
        -------
        FrictionCurves
            In the order of the solutions, with their numerical error estimates and their warnings as notes.

        Raises
        ------
        InputError
            If a solution has no temperature, its speed is zero or infinite, or point and line contacts are mixed.
        """
        return cls(**columns_of(solutions), source=source)

    def interval(
        self, level: float = 0.95, *, of: Literal["viscoelastic", "coulomb"] = "viscoelastic"
    ) -> tuple[Array, Array]:
        """Return the confidence limits of a measured friction coefficient.

        Student's t with the degrees of freedom behind the standard errors; normal where these are not known.

        Parameters
        ----------
        level : float
            Probability between the limits, between 0 and 1.
        of : {"viscoelastic", "coulomb"}

        Returns
        -------
        lower, upper : (n,) array
            Infinite where the standard error is, or has much less than one degree of freedom.

        Raises
        ------
        InputError
            If the level is not between 0 and 1, or there is no such coefficient.
        """
        level = share(level, "level", example=0.95)
        check_choice(of, "of", "viscoelastic", "coulomb")
        value, error, freedom = (getattr(self, name) for name in (of, f"{of}_error", f"{of}_freedom"))
        if value is None or error is None:
            raise wrong_argument(
                "of", of, "these friction curves have no such coefficient with a standard error.", "not-known"
            )
        half = half_widths(error, freedom, level)
        return value - half, value + half

    def select(self, keep: Mask | Integers) -> FrictionCurves:
        """Return some of the entries, with the same notes and source.

        Parameters
        ----------
        keep : (n,) array of bool, or array of int
            Mask of the entries, or their indices in the order wanted.

        Raises
        ------
        InputError
            If a mask has another length, or there is no such entry.
        """
        return with_rows(self, picked(keep, len(self), "entries"))

    def at_temperature(self, temperature: Quantity) -> FrictionCurves:
        """Return the entries at one temperature, in ascending speed.

        Parameters
        ----------
        temperature : float, str or pint.Quantity
            K if a plain number.  The nearest available temperature is used, if within 1 K; where measured, with all
            that scatter about the same nominal one (less than 1 K apart).

        Raises
        ------
        InputError
            If there is none so near.
        """
        wanted = positive(temperature, "K", "temperature")
        there = self.temperatures
        if not there.size or np.min(np.abs(there - wanted)) > SAME_TEMPERATURE:
            known = ", ".join(shown_celsius(float(one)) for one in there) or "none"
            raise InputError(
                f"temperature = {shown_celsius(wanted)} °C: there is no friction curve within "
                f"{SAME_TEMPERATURE:g} K of it; known temperatures: {known} °C.",
                code="no-such-temperature",
                values={"known": there.tolist()},
            )
        nearest = there[np.argmin(np.abs(there - wanted))]
        # Measured temperatures scatter about a nominal one; those of solved contacts are exact.
        groups = nominal_rows(self.temperature) if self.mean_pressure is None else []
        exact = np.flatnonzero(self.temperature == nearest)
        rows = next((rows for rows in groups if exact[0] in rows), exact)
        return self.select(rows[np.argsort(self.speed[rows], kind="stable")])

    def at_load(self, load: Quantity) -> FrictionCurves:
        """Return the entries whose load is within 5 % of the one given.

        Parameters
        ----------
        load : float, str or pint.Quantity
            In `load_unit` if a plain number.

        Raises
        ------
        InputError
            If there are none.
        """
        unit = self.load_unit
        wanted = positive(load, unit, "load")
        keep = np.abs(self.load - wanted) <= SAME_LOAD * wanted
        if not np.any(keep):
            loads = f"run from {self.load.min():.3g} to {self.load.max():.3g} {unit}" if len(self) else "are none"
            raise InputError(
                f"load = {wanted:g} {unit}: no entry is within 5 % of it; the loads {loads}.", code="no-such-load"
            )
        return self.select(keep)

    def __iter__(self) -> Iterator[Self]:
        """Iterate over the entries, each as curves of one point."""
        return (self[place] for place in range(len(self)))

    def __getitem__(self, keep: int | slice | Mask | Integers) -> Self:
        """Return some of the entries: ``curves[0]``, ``curves[:5]``, ``curves[curves.speed > 0.05]``; see `select`."""
        return cast("Self", self.select(np.atleast_1d(np.arange(len(self))[keep])))

    def to_dataset(self) -> Dataset:
        """Return the curves as a labelled data set, with units and long names.

        Over ``temperature`` and ``speed`` where there is one entry for each pair of them, over ``load``,
        ``temperature`` and ``speed`` where there is one for each three, and else along ``point``, as `points_dataset`
        returns it.  Speed, temperature, load and slip are coordinates; source, notes and assumption are attributes.
        """
        points = self.points_dataset()
        found = on_grid(points, "temperature", "speed")
        found = on_grid(points, "load", "temperature", "speed") if found is None else found
        return points if found is None else found

    def points_dataset(self) -> Dataset:
        """Return the curves as a labelled data set along ``point``, one for each entry, in their order."""
        labels = LABELS | {"load": (self.load_unit, LOADS[self.load_unit])}
        columns = {
            name: (getattr(self, name), *label) for name, label in labels.items() if getattr(self, name) is not None
        }
        return dataset(
            "point",
            {name: column for name, column in columns.items() if name not in _COORDINATES},
            coordinates={name: columns[name] for name in _COORDINATES if name in columns},
            attributes={"source": self.source, "notes": "", "assumption": str(self.assumption)}
            | note_attributes(self.notes),
        )


def is_predicted(curves: FrictionCurves) -> bool:
    """Whether curves were predicted, also if they were written and read again."""
    return curves.source in ("predicted", marked("predicted", synthetic=True))


def insist_on_curves(given: object, name: str) -> FrictionCurves:
    """Return friction curves; raise `InputError` for anything else, such as runs not yet separated."""
    insist_on(given, name, FrictionCurves, right="FrictionCurves, as separate() gives them")
    return given  # type: ignore[return-value]


def _column(values: object, name: str, shape: tuple[int, ...], unit: str) -> Array:
    column = read_only(values, f"{name} of friction curves", unit)
    if column.shape != shape:
        raise InputError(f"{name} of friction curves must hold one value per speed.", code="wrong-length")
    if name.endswith(("_error", "_scatter", "_freedom")):
        if not np.all(column >= 0.0):
            raise InputError(f"{name} of friction curves must be zero or above everywhere.", code="negative")
    elif not np.all(np.isfinite(column)):
        raise InputError(f"{name} of friction curves must be finite everywhere.", code="not-finite")
    return column
