"""The output of readers: typed, immutable measurements in SI units, with notes on what is doubtful."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Literal, Self, TypeAlias, TypeVar

import numpy as np

from viscofric.arguments import insist_on, numbers, sentences, text
from viscofric.arrays import Array, ComplexArray, Integers
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, check_choice
from viscofric.notes import Note
from viscofric.showing import Items, Plotted, Rows, rows_of
from viscofric.units import Quantities, Quantity, checked_poisson_ratio, in_si, positive

Found = TypeVar("Found")

#: How a dynamic mechanical analyser deformed its sample.
Deformation: TypeAlias = Literal["tension", "compression", "bending", "shear"]
DEFORMATIONS: tuple[Deformation, ...] = ("tension", "compression", "bending", "shear")


def tensile_from_shear(poisson_ratio: float, what: str = "moduli", more: str = "") -> tuple[float, Note]:
    """Return the factor from a shear modulus to a tensile one, 2(1+ν), and the note that says so; `more` ends it."""
    ratio = checked_poisson_ratio(poisson_ratio, above=-1.0)
    said = f"Shear {what} converted to tensile ones by E = 2(1+ν)G with ν = {ratio:g}{more}."
    return 2.0 * (1.0 + ratio), Note("tensile-from-shear", said)


#: Larger whole numbers are not exact as floats.
_LARGEST_WHOLE = 2**53


#: Quantity that the name of a column begins with -> its unit, in which text and quantities are converted.
_UNITS = {
    "angular_frequency": "rad/s",
    "storage_modulus": "Pa",
    "loss_modulus": "Pa",
    "temperature": "K",
    "time": "s",
    "speed": "m/s",
    "disc_speed": "m/s",
    "ball_speed": "m/s",
    "slip": "m/s",
    "load": "N",
    "traction_force": "N",
    "zero_force": "N",
    "offset": "N",
    "track_radius": "m",
    "mean_pressure": "Pa",
    "mean_pressure_error": "Pa",
    "strain_amplitude": "dimensionless",
}


def read_only(values: object, name: str = "a column of measurements", unit: str = "") -> Array:
    """Return a read-only float copy, so that frozen measurements stay frozen; errors use the name.

    Text and quantities are converted to the unit, or that of the quantity that the name begins with.
    """
    unit = unit or _UNITS.get(name.split(maxsplit=1)[0], "")
    column = np.array(
        in_si(values, unit, name, infinite=True, missing=True)
        if unit
        else numbers(values, name, infinite=True, missing=True)
    )
    column.flags.writeable = False
    return column


def positive_column(values: object, name: str, shape: tuple[int, ...], per: str) -> Array:
    """Return a read-only row of positive numbers of a shape, one per `per`; errors use the name."""
    column = np.atleast_1d(read_only(values, name))
    if column.ndim != 1 or column.shape != shape or not np.all((column > 0) & np.isfinite(column)):
        raise InputError(f"{name} must be one row of positive numbers, one per {per}.", code="wrong-length")
    column.flags.writeable = False
    return column


def whole_numbers(values: object, name: str) -> Integers:
    """Return a read-only copy as whole numbers."""
    column = read_only(values, name)
    if not np.all(np.abs(column) < _LARGEST_WHOLE) or np.any(column != np.rint(column)):
        raise InputError(f"{name} must hold whole numbers.", code="not-a-whole-number")
    numbers = column.astype(np.int64)
    numbers.flags.writeable = False
    return numbers


def picked(rows: object, count: int, noun: str) -> Integers:
    """Return the places of rows that a mask, or places, select."""
    try:
        places = np.array(None) if np.ma.is_masked(rows) else np.asarray(rows)
    except ValueError:
        places = np.array(None)
    if places.shape == (0,):
        return np.empty(0, dtype=np.int64)
    if places.dtype == bool and places.shape == (count,):
        return np.flatnonzero(places)
    if places.ndim != 1 or not np.issubdtype(places.dtype, np.integer):
        raise InputError(
            f"select needs true or false for each of the {count} {noun}, or their places.", code="wrong-selection"
        )
    if places.min() < -count or places.max() >= count:
        raise InputError(f"select names a place beyond the {count} {noun}.", code="wrong-selection")
    return places.astype(np.int64)


def with_rows(found: Found, rows: Any) -> Found:
    """Return a dataclass with some entries of all its arrays."""
    columns = {one.name: getattr(found, one.name) for one in fields(found)}  # type: ignore[arg-type]
    chosen = {name: column[rows] for name, column in columns.items() if isinstance(column, np.ndarray)}
    return replace(found, **chosen)  # type: ignore[type-var]


def set_columns(measured: object, *names: str, of: str, per: str) -> None:
    """Set columns of a frozen measurement to read-only rows of positive numbers, as many as the first has."""
    shape = np.atleast_1d(read_only(getattr(measured, names[0]), f"{names[0]} of {of}")).shape
    for name in names:
        object.__setattr__(measured, name, positive_column(getattr(measured, name), f"{name} of {of}", shape, per))


def set_members(measured: object, name: str, kind: type, key: Callable[[Any], float]) -> None:
    """Set the members of a frozen collection of measurements, of one kind, in ascending order of a key."""
    members = getattr(measured, name)
    insist_on(members, name, tuple, list, right=f"a tuple of {kind.__name__}")
    for one in members:
        insist_on(one, f"one of the {name}", kind)
    object.__setattr__(measured, name, tuple(sorted(members, key=key)))


class Moduli:
    """Storage and loss modulus of a measurement."""

    storage_modulus: Array
    loss_modulus: Array

    @property
    def loss_tangent(self) -> Array:
        """E''/E' (or G''/G')."""
        return np.asarray(self.loss_modulus / self.storage_modulus)

    def _times(self, factor: float) -> Self:
        """Return the same with both moduli multiplied."""
        moduli: dict[str, Any] = {name: factor * getattr(self, name) for name in ("storage_modulus", "loss_modulus")}
        return replace(self, **moduli)  # type: ignore[type-var]


class Origin:
    """The deformation, the source and the notes of measurements."""

    deformation: Deformation
    source: str
    notes: tuple[str, ...]
    format: str

    def _check_origin(self, of: str) -> None:
        check_choice(self.deformation, "deformation", *DEFORMATIONS)
        for name in ("source", "format"):
            text(getattr(self, name), f"{name} of {of}")
        object.__setattr__(self, "notes", sentences(self.notes, f"notes of {of}"))

    def _shown_origin(self) -> Rows:
        return (
            ("deformation", self.deformation),
            ("format", self.format or None),
            ("source", self.source or None),
            ("notes", self.notes),
        )

    def _origin(self) -> dict[str, str]:
        """Return attributes of data sets."""
        return {"deformation": self.deformation, "source": self.source, "format": self.format}


@dataclass(frozen=True, eq=False)
class Isotherm(Moduli, Plotted, Items[tuple[float, float, float]]):
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

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> omega = 2.0 * np.pi * np.array([0.1, 1.0, 10.0])
    >>> warm = vf.Isotherm(298.15, omega, np.array([3.1e6, 3.4e6, 4.0e6]), np.array([0.30e6, 0.41e6, 0.62e6]))
    """

    temperature: float
    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    strain_amplitude: Array | None = None

    if TYPE_CHECKING:  # what is given, converted when made

        def __init__(
            self,
            temperature: Quantity,
            angular_frequency: Quantities,
            storage_modulus: Quantities,
            loss_modulus: Quantities,
            strain_amplitude: Quantities | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "temperature", positive(self.temperature, "K", "temperature of an isotherm"))
        set_columns(self, "angular_frequency", "storage_modulus", "loss_modulus", of="an isotherm", per="frequency")
        if np.any(np.diff(self.angular_frequency) <= 0):
            raise InputError("the frequencies of an isotherm must ascend without repeats.", code="not-ascending")
        if self.strain_amplitude is not None:
            amplitude = read_only(self.strain_amplitude, "strain_amplitude of an isotherm")
            if amplitude.shape != self.angular_frequency.shape or np.any((amplitude < 0) | np.isinf(amplitude)):
                raise InputError(
                    "strain_amplitude of an isotherm must be one fraction per frequency, none below zero.",
                    code="wrong-length",
                )
            object.__setattr__(self, "strain_amplitude", amplitude)

    def _items(self) -> Sequence[tuple[float, float, float]]:
        return rows_of(self.angular_frequency, self.storage_modulus, self.loss_modulus)

    def _shown(self) -> Rows:
        return (
            ("temperature", self.temperature, "°C"),
            ("angular frequency", self.angular_frequency, "rad/s"),
            ("storage modulus", self.storage_modulus, "Pa"),
            ("loss modulus", self.loss_modulus, "Pa"),
            ("strain amplitude", self.strain_amplitude, "%"),
        )

    def to_dataset(self) -> Dataset:
        """Return the moduli along ``angular_frequency``.

        Returns
        -------
        xarray.Dataset
            ``storage_modulus`` and ``loss_modulus`` (Pa), ``loss_tangent``, and ``strain_amplitude`` if it was
            recorded; the attribute ``temperature`` (K).
        """
        amplitude = self.strain_amplitude
        return dataset(
            "angular_frequency",
            {
                **modulus_columns(self.storage_modulus, self.loss_modulus),
                "loss_tangent": (self.loss_tangent, "1", "loss tangent"),
                "strain_amplitude": None if amplitude is None else (amplitude, "1", "strain amplitude"),
            },
            coordinates={"angular_frequency": (self.angular_frequency, "rad/s", "angular frequency")},
            attributes={"temperature": self.temperature},
        )


@dataclass(frozen=True, eq=False)
class IsothermalSweeps(Origin, Plotted, Items[Isotherm]):
    """Frequency sweeps of a dynamic mechanical analyser at several temperatures.

    Parameters
    ----------
    isotherms : tuple of Isotherm
        In ascending temperature.
    deformation : {"tension", "compression", "bending", "shear"}
        Whether the moduli are G (shear) or E (all others).
    source : str
        Origin, such as a file's name.
    notes : tuple of str
        What the reader found doubtful, left out, sorted or averaged: one sentence each.
    format : str
        The recognised format in words; empty for sweeps from no file.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> omega = 2.0 * np.pi * np.array([0.1, 1.0, 10.0])
    >>> warm = vf.Isotherm(298.15, omega, np.array([1.0e6, 1.1e6, 1.3e6]), np.array([0.10e6, 0.14e6, 0.20e6]))
    >>> sweeps = vf.IsothermalSweeps((warm,), deformation="shear")
    >>> sweeps.in_tension(0.5).isotherms[0].storage_modulus  # E = 2(1+ν)G
    array([3000000., 3300000., 3900000.])
    """

    isotherms: tuple[Isotherm, ...]
    deformation: Deformation = "tension"
    source: str = ""
    notes: tuple[str, ...] = ()
    format: str = ""

    def __post_init__(self) -> None:
        self._check_origin("the sweeps")
        set_members(self, "isotherms", Isotherm, lambda sweep: sweep.temperature)

    def _items(self) -> Sequence[Isotherm]:
        return self.isotherms

    def _shown(self) -> Rows:
        return (
            ("isotherms", self.isotherms),
            ("readings", sum(map(len, self.isotherms))),
            ("temperature", self.temperatures, "°C"),
            *self._shown_origin(),
        )

    @property
    def temperatures(self) -> Array:
        """Temperatures of the isotherms, K, ascending."""
        return np.array([sweep.temperature for sweep in self.isotherms])

    def in_tension(self, poisson_ratio: float) -> IsothermalSweeps:
        """Return the sweeps as tensile moduli, E = 2(1+ν)G if they were measured in shear."""
        if self.deformation != "shear":
            return self
        factor, note = tensile_from_shear(poisson_ratio)
        isotherms = tuple(sweep._times(factor) for sweep in self.isotherms)
        return replace(self, isotherms=isotherms, deformation="tension", notes=(*self.notes, note))

    def to_dataset(self) -> Dataset:
        """Return the points along the dimension ``reading``, isotherm by isotherm.

        Returns
        -------
        xarray.Dataset
            ``temperature`` (K), ``angular_frequency`` (rad/s), ``storage_modulus`` and ``loss_modulus`` (Pa), and
            ``strain_amplitude`` if it was recorded; the attributes are ``deformation``, ``source`` and ``format``.
        """
        amplitudes = [
            np.full(len(one), np.nan) if one.strain_amplitude is None else one.strain_amplitude
            for one in self.isotherms
        ]
        recorded = any(one.strain_amplitude is not None for one in self.isotherms)
        return dataset(
            "reading",
            reading_columns(
                np.repeat(self.temperatures, [len(one) for one in self.isotherms]),
                _joined([one.angular_frequency for one in self.isotherms]),
                _joined([one.storage_modulus for one in self.isotherms]),
                _joined([one.loss_modulus for one in self.isotherms]),
            )
            | {"strain_amplitude": (_joined(amplitudes), "1", "strain amplitude") if recorded else None},
            attributes=self._origin(),
        )


@dataclass(frozen=True, eq=False)
class MasterCurve(Moduli, Plotted, Items[tuple[float, float, float]]):
    """Tensile modulus at one reference temperature, every measured point shifted by its isotherm's shift factor.

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
    notes : tuple of str
        What is behind the curve, such as synthetic measurements.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> curve = vf.readers.MasterCurve(
    ...     np.array([0.1, 10.0]), np.array([3e6, 4e6]), np.array([3e5, 6e5]), np.full(2, 303.15), 303.15
    ... )
    """

    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    temperature: Array
    reference: float
    notes: tuple[str, ...] = ()

    if TYPE_CHECKING:  # what is given, converted when made

        def __init__(
            self,
            angular_frequency: Quantities,
            storage_modulus: Quantities,
            loss_modulus: Quantities,
            temperature: Quantities,
            reference: Quantity,
            notes: tuple[str, ...] = (),
        ) -> None: ...

    def __post_init__(self) -> None:
        columns = ("angular_frequency", "storage_modulus", "loss_modulus", "temperature")
        set_columns(self, *columns, of="a master curve", per="point")
        object.__setattr__(self, "reference", positive(self.reference, "K", "reference"))
        object.__setattr__(self, "notes", sentences(self.notes, "notes of a master curve"))
        if np.any(np.diff(self.angular_frequency) < 0):
            raise InputError("the frequencies of a master curve must ascend.", code="not-ascending")

    def _items(self) -> Sequence[tuple[float, float, float]]:
        return rows_of(self.angular_frequency, self.storage_modulus, self.loss_modulus)

    def _shown(self) -> Rows:
        return (
            ("angular frequency", self.angular_frequency, "rad/s"),
            ("storage modulus", self.storage_modulus, "Pa"),
            ("loss modulus", self.loss_modulus, "Pa"),
            ("measured at", self.temperature, "°C"),
            ("reference", self.reference, "°C"),
            ("notes", self.notes),
        )

    @property
    def complex_modulus(self) -> ComplexArray:
        """E' + iE'', Pa."""
        return np.asarray(self.storage_modulus + 1j * self.loss_modulus)

    def to_dataset(self) -> Dataset:
        """Return the points along the dimension ``reading``.

        Returns
        -------
        xarray.Dataset
            ``temperature`` (K), ``angular_frequency`` (rad/s), ``storage_modulus`` and ``loss_modulus`` (Pa); the
            attribute ``reference_temperature`` (K).
        """
        return dataset(
            "reading",
            reading_columns(self.temperature, self.angular_frequency, self.storage_modulus, self.loss_modulus),
            attributes={"reference_temperature": self.reference},
        )


def _joined(columns: list[Array]) -> Array:
    return np.concatenate([np.empty(0), *columns])


def modulus_columns(storage_modulus: Array, loss_modulus: Array) -> dict[str, tuple[Array, str, str]]:
    """Return two columns of a data set."""
    return {
        "storage_modulus": (storage_modulus, "Pa", "storage modulus"),
        "loss_modulus": (loss_modulus, "Pa", "loss modulus"),
    }


def reading_columns(
    temperature: Array, angular_frequency: Array, storage_modulus: Array, loss_modulus: Array
) -> dict[str, tuple[Array, str, str] | None]:
    """Return the columns of a data set of readings, each with its temperature and its frequency."""
    return {
        "temperature": (temperature, "K", "temperature"),
        "angular_frequency": (angular_frequency, "rad/s", "angular frequency"),
        **modulus_columns(storage_modulus, loss_modulus),
    }
