"""Measured rebounds over speed, and stiffness over frequency, at one temperature."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from viscofric.arguments import text
from viscofric.arrays import Array
from viscofric.data import read_only
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, wrong_argument
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, Quantity, positive, share, to_si, to_si_array
from viscofric.units import angular_frequency as frequency_of

#: Quantity -> unit, and long name.
OF_IMPACTS = {
    "restitution": ("1", "coefficient of restitution"),
    "contact_time": ("s", "contact time"),
    "peak_force": ("N", "largest force"),
    "indentation": ("m", "largest indentation"),
}
STIFFNESSES = {"storage_stiffness": ("N/m", "storage stiffness"), "loss_stiffness": ("N/m", "loss stiffness")}
#: Largest amplitude over the mean depth: the edge of the contact follows the oscillation, which lowers the loss
#: stiffness by 0.4 to 0.9 % at this amplitude, and by 1.4 to 2.7 % at a tenth of the depth (`solve_transient`).
LARGEST_AMPLITUDE = 0.03


@dataclass(frozen=True, eq=False)
class ReboundRecord(Plotted):
    """Impacts of an indenter of known mass at several speeds and one temperature.

    Parameters
    ----------
    speed : (n,) array of float, str or pint.Quantity
        At the first touch, m/s.
    temperature : float, str or pint.Quantity
        K if a plain number.
    mass : float, str or pint.Quantity
        Of the indenter, kg.
    error : float or mapping
        Relative standard error of the measured values, independent from value to value: one for all, or one for each
        quantity, such as ``{"restitution": 0.005, "contact_time": 0.02}``.
    restitution : (n,) array of float, optional
        Speed after the impact over that before it, above zero and at most 1.
    contact_time : (n,) array of float, str or pint.Quantity, optional
        s.
    peak_force : (n,) array of float, str or pint.Quantity, optional
        Largest force, N.
    indentation : (n,) array of float, str or pint.Quantity, optional
        Largest indentation, m.
    gravity : float, str or pint.Quantity
        Acceleration towards the material, m/s².
    source : str
        Origin, such as a file's name.

    Raises
    ------
    InputError
        If nothing was measured, columns differ in length, or a value is no number of the right unit above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> rebounds = vf.friction.ReboundRecord(
    ...     ["1 m/s", "2 m/s"],
    ...     "23 degC",
    ...     mass="33 g",
    ...     restitution=[0.62, 0.58],
    ...     contact_time=["2.1 ms", "1.9 ms"],
    ...     error=0.01,
    ... )
    >>> rebounds.quantities
    ('restitution', 'contact_time')
    """

    speed: Array
    temperature: float
    mass: float
    error: Mapping[str, float]
    restitution: Array | None
    contact_time: Array | None
    peak_force: Array | None
    indentation: Array | None
    gravity: float
    source: str

    def __init__(
        self,
        speed: Quantities,
        temperature: Quantity,
        *,
        mass: Quantity,
        error: float | Mapping[str, float],
        restitution: Quantities | None = None,
        contact_time: Quantities | None = None,
        peak_force: Quantities | None = None,
        indentation: Quantities | None = None,
        gravity: Quantity = 0.0,
        source: str = "",
    ) -> None:
        given = zip(OF_IMPACTS.items(), (restitution, contact_time, peak_force, indentation), strict=True)
        columns = {name: None if one is None else (one, unit) for (name, (unit, _)), one in given}
        _set_columns(self, {"speed": (speed, "m/s"), **columns}, "speed")
        if not self.quantities:
            raise InputError(
                "restitution: give it, or contact_time, peak_force or indentation; nothing was measured.",
                code="give-one",
                field="restitution",
            )
        if self.restitution is not None and np.any(self.restitution > 1.0):
            largest = float(self.restitution.max())
            raise InputError(
                f"restitution: {largest:g} is above 1, so that the rebound would gain energy; per cent have '%'.",
                code="out-of-range",
                field="restitution",
            )
        pull = to_si(gravity, "m/s**2", "gravity")
        if pull < 0.0:
            raise wrong_argument("gravity", gravity, "must not be below zero.", "negative", "gravity")
        object.__setattr__(self, "temperature", positive(temperature, "K", "temperature"))
        object.__setattr__(self, "mass", positive(mass, "kg", "mass"))
        object.__setattr__(self, "gravity", pull)
        object.__setattr__(self, "error", _errors(error, self.quantities))
        object.__setattr__(self, "source", text(source, "source"))

    def _shown(self) -> Rows:
        return (
            ("speed", self.speed, "m/s"),
            ("restitution", self.restitution),
            ("contact time", self.contact_time, "s"),
            ("largest force", self.peak_force, "N"),
            ("indentation", self.indentation, "m"),
            ("mass", self.mass, "kg"),
            ("temperature", self.temperature, "°C"),
            ("source", self.source or None),
        )

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of what was measured."""
        return tuple(name for name in OF_IMPACTS if getattr(self, name) is not None)

    def __len__(self) -> int:
        return len(self.speed)

    def to_dataset(self) -> Dataset:
        """Return the record as a labelled data set along ``speed`` (m/s).

        ``restitution``, ``contact_time`` (s), ``peak_force`` (N) and ``indentation`` (m), those measured; the
        attributes are ``temperature`` (K), ``mass`` (kg), ``gravity`` (m/s²), the relative errors and ``source``.
        """
        return dataset(
            "speed",
            {name: (getattr(self, name), *OF_IMPACTS[name]) for name in self.quantities},
            coordinates={"speed": (self.speed, "m/s", "speed of the impact")},
            attributes={
                "temperature": self.temperature, "mass": self.mass, "gravity": self.gravity,
                **{f"{name}_error": one for name, one in self.error.items()}, "source": self.source,
            },
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class OscillationRecord(Plotted):
    """Stiffness of small oscillations of an indenter about a constant depth, over frequency, at one temperature.

    Parameters
    ----------
    angular_frequency : (n,) array of float, str or pint.Quantity
        rad/s if plain numbers; text in hertz is multiplied by 2π.
    storage_stiffness, loss_stiffness : (n,) array of float, str or pint.Quantity
        Real and imaginary part of load over depth, N/m.
    temperature : float, str or pint.Quantity
        K if a plain number.
    indentation : float, str or pint.Quantity
        Mean depth, m, which no load before the oscillation has exceeded.
    amplitude : float, str or pint.Quantity
        Of the depth, m; up to 3 % of the mean depth, with which the stiffness is good to about 1 %.
    error : float or mapping
        Relative standard error of the stiffness: one for both, or ``{"storage_stiffness": 0.01, "loss_stiffness":
        0.03}``.
    source : str
        Origin, such as a file's name.

    Raises
    ------
    InputError
        If columns differ in length, a value is no number of the right unit above zero, or the amplitude is too large.

    Examples
    --------
    >>> import viscofric as vf
    >>> record = vf.friction.OscillationRecord(
    ...     ["1 Hz", "10 Hz"],
    ...     [9e3, 1.1e4],
    ...     [1.1e3, 1.8e3],
    ...     "23 degC",
    ...     indentation="100 um",
    ...     amplitude="3 um",
    ...     error=0.01,
    ... )
    >>> len(record)
    2
    """

    angular_frequency: Array
    storage_stiffness: Array
    loss_stiffness: Array
    temperature: float
    indentation: float
    amplitude: float
    error: Mapping[str, float]
    source: str

    def __init__(
        self,
        angular_frequency: Quantities,
        storage_stiffness: Quantities,
        loss_stiffness: Quantities,
        temperature: Quantity,
        *,
        indentation: Quantity,
        amplitude: Quantity,
        error: float | Mapping[str, float],
        source: str = "",
    ) -> None:
        omega = angular_frequency
        if isinstance(omega, str):
            omega = [omega]
        if isinstance(omega, (list, tuple)):
            omega = np.array([frequency_of(one, "angular_frequency") for one in omega])
        columns = {"storage_stiffness": (storage_stiffness, "N/m"), "loss_stiffness": (loss_stiffness, "N/m")}
        _set_columns(self, {"angular_frequency": (omega, "rad/s"), **columns}, "angular_frequency")
        depth, size = positive(indentation, "m", "indentation"), positive(amplitude, "m", "amplitude")
        if size > LARGEST_AMPLITUDE * depth * (1.0 + 1e-9):  # rounding of units
            raise wrong_argument(
                "amplitude",
                amplitude,
                f"above {LARGEST_AMPLITUDE:g} of the mean depth the contact radius "
                "oscillates too; give load and depth over time as an IndentationRecord.",
                "out-of-range",
                "amplitude",
            )
        object.__setattr__(self, "temperature", positive(temperature, "K", "temperature"))
        object.__setattr__(self, "indentation", depth)
        object.__setattr__(self, "amplitude", size)
        object.__setattr__(self, "error", _errors(error, tuple(STIFFNESSES)))
        object.__setattr__(self, "source", text(source, "source"))

    def __len__(self) -> int:
        return len(self.angular_frequency)

    def _shown(self) -> Rows:
        return (
            ("angular frequency", self.angular_frequency, "rad/s"),
            ("storage stiffness", self.storage_stiffness, "N/m"),
            ("loss stiffness", self.loss_stiffness, "N/m"),
            ("indentation", self.indentation, "m"),
            ("amplitude", self.amplitude, "m"),
            ("temperature", self.temperature, "°C"),
            ("source", self.source or None),
        )

    def to_dataset(self) -> Dataset:
        """Return the record as a labelled data set along ``angular_frequency`` (rad/s).

        ``storage_stiffness`` and ``loss_stiffness`` (N/m); the attributes are ``temperature`` (K), ``indentation`` and
        ``amplitude`` (m), the relative errors and ``source``.
        """
        return dataset(
            "angular_frequency",
            {name: (getattr(self, name), *words) for name, words in STIFFNESSES.items()},
            coordinates={"angular_frequency": (self.angular_frequency, "rad/s", "angular frequency")},
            attributes={
                "temperature": self.temperature, "indentation": self.indentation, "amplitude": self.amplitude,
                **{f"{name}_error": one for name, one in self.error.items()}, "source": self.source,
            },
        )  # fmt: skip


def _set_columns(record: object, columns: Mapping[str, tuple[Quantities, str] | None], first: str) -> None:
    """Set columns of a record in SI units, as long as the first one and above zero."""
    count = None
    for name, column in columns.items():
        values = None if column is None else to_si_array(*column, name)
        if values is not None:
            count = len(values) if name == first else count
            if len(values) != count or not count:
                raise InputError(
                    f"{name}: has {len(values)} values, {first} {count}; give as many.", code="wrong-length", field=name
                )
            if not np.all(values > 0.0):
                raise InputError(f"{name}: must be above zero everywhere.", code="not-positive", field=name)
            values = read_only(values, name)
        object.__setattr__(record, name, values)


def _errors(error: float | Mapping[str, float], quantities: tuple[str, ...]) -> dict[str, float]:
    """Return the relative standard error of every quantity."""
    each = dict(error) if isinstance(error, Mapping) else dict.fromkeys(quantities, error)
    if set(each) != set(quantities):
        raise InputError(
            f"error: has {', '.join(map(str, each)) or 'nothing'}; give one number, or one each for "
            f"{', '.join(quantities)}.",
            code="wrong-names",
            field="error",
        )
    return {name: share(each[name], "error", example=0.01) for name in quantities}
