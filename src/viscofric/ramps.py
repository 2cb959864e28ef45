"""Temperature ramps of a dynamic mechanical analyser: moduli against temperature at one or several frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array
from viscofric.data import (
    Deformation,
    Moduli,
    Origin,
    modulus_columns,
    reading_columns,
    set_columns,
    set_members,
    tensile_from_shear,
)
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.showing import Items, Plotted, Rows
from viscofric.units import Quantity, positive, shown_celsius, to_si
from viscofric.units import angular_frequency as to_rad_per_s


@dataclass(frozen=True, eq=False)
class TemperatureRamp(Moduli, Plotted):
    """Moduli at one frequency while the temperature changes.

    Parameters
    ----------
    angular_frequency : float or quantity
        rad/s, or text such as ``"1 Hz"``.
    temperature : (n,) array
        Ascending, K; whether the sample was heated or cooled is up to `TemperatureRamps`.
    storage_modulus, loss_modulus : (n,) array
        As measured (tensile or shear, see `TemperatureRamps.deformation`), positive, Pa.

    Examples
    --------
    >>> import viscofric as vf
    >>> ramp = vf.readers.TemperatureRamp("1 Hz", [253.15, 263.15, 273.15], [9e8, 2e8, 2e7], [5e7, 9e7, 1e7])
    >>> len(ramp), ramp.loss_tangent.round(2)
    (3, array([0.06, 0.45, 0.5 ]))
    """

    angular_frequency: float
    temperature: Array
    storage_modulus: Array
    loss_modulus: Array

    def __init__(
        self, angular_frequency: Quantity, temperature: object, storage_modulus: object, loss_modulus: object
    ) -> None:
        object.__setattr__(self, "angular_frequency", to_rad_per_s(angular_frequency, "angular_frequency of a ramp"))
        columns = {"temperature": temperature, "storage_modulus": storage_modulus, "loss_modulus": loss_modulus}
        vars(self).update(columns)
        set_columns(self, *columns, of="a ramp", per="temperature")
        if np.any(np.diff(self.temperature) < 0):
            raise InputError("the temperatures of a ramp must ascend.", code="not-ascending")

    def __len__(self) -> int:
        return len(self.temperature)

    def _shown(self) -> Rows:
        return (
            ("frequency", self.angular_frequency / (2.0 * np.pi), "Hz"),
            ("temperature", self.temperature, "°C"),
            ("storage modulus", self.storage_modulus, "Pa"),
            ("loss modulus", self.loss_modulus, "Pa"),
        )

    def to_dataset(self) -> Dataset:
        """Return the moduli along the dimension ``reading``.

        Returns
        -------
        xarray.Dataset
            ``temperature`` (K), ``storage_modulus`` and ``loss_modulus`` (Pa), ``loss_tangent``; the attribute
            ``angular_frequency`` (rad/s).
        """
        return dataset(
            "reading",
            {
                "temperature": (self.temperature, "K", "temperature"),
                **modulus_columns(self.storage_modulus, self.loss_modulus),
                "loss_tangent": (self.loss_tangent, "1", "loss tangent"),
            },
            attributes={"angular_frequency": self.angular_frequency},
        )


@dataclass(frozen=True, eq=False)
class TemperatureRamps(Origin, Plotted, Items[TemperatureRamp]):
    """Temperature ramps of one specimen, one for each frequency.

    Parameters
    ----------
    ramps : tuple of TemperatureRamp
        In ascending frequency.
    deformation : {"tension", "compression", "bending", "shear"}
        Whether the moduli are E (tension) or G (shear).
    heating_rate : float or None
        K/s, below zero for cooling; None where it is unknown.
    source : str
        Origin, such as a file's name.
    notes : tuple of str
        What the reader found doubtful, left out or averaged: one sentence each.
    format : str
        The recognised format in words; empty for ramps from no file.

    Examples
    --------
    >>> import viscofric as vf
    >>> ramp = vf.readers.TemperatureRamp("1 Hz", [253.15, 263.15, 273.15], [9e8, 2e8, 2e7], [5e7, 9e7, 1e7])
    >>> vf.readers.TemperatureRamps((ramp,), deformation="shear").in_tension(0.5).ramps[0].storage_modulus[
    ...     0
    ... ]  # E = 2(1+ν)G
    np.float64(2700000000.0)
    """

    ramps: tuple[TemperatureRamp, ...]
    deformation: Deformation = "tension"
    heating_rate: float | None = None
    source: str = ""
    notes: tuple[str, ...] = ()
    format: str = ""

    def __post_init__(self) -> None:
        self._check_origin("the ramps")
        set_members(self, "ramps", TemperatureRamp, lambda ramp: ramp.angular_frequency)
        if not self.ramps:
            raise InputError("ramps must hold at least one TemperatureRamp.", code="empty-list")
        if self.heating_rate is not None:
            object.__setattr__(self, "heating_rate", to_si(self.heating_rate, "K/s", "heating_rate"))
        if np.any(np.diff(self.angular_frequencies) <= 0.0):
            raise InputError("two ramps have the same frequency; join them to one.", code="given-twice")

    def _items(self) -> Sequence[TemperatureRamp]:
        return self.ramps

    def _shown(self) -> Rows:
        return (
            ("ramps", self.ramps),
            ("frequency", self.angular_frequencies / (2.0 * np.pi), "Hz"),
            ("temperature", self.temperature_range, "°C"),
            ("readings", sum(map(len, self.ramps))),
            *self._shown_origin(),
        )

    @property
    def angular_frequencies(self) -> Array:
        """Of the ramps, rad/s, ascending."""
        return np.array([ramp.angular_frequency for ramp in self.ramps])

    @property
    def temperature_range(self) -> tuple[float, float]:
        """Lowest and highest temperature, K."""
        return float(min(r.temperature[0] for r in self.ramps)), float(max(r.temperature[-1] for r in self.ramps))

    def between(self, lowest: Quantity, highest: Quantity) -> TemperatureRamps:
        """Return the points between two temperatures (K, or text such as ``"-40 degC"``)."""
        low, high = positive(lowest, "K", "lowest"), positive(highest, "K", "highest")
        cut = []
        for ramp in self.ramps:
            inside = (ramp.temperature >= low) & (ramp.temperature <= high)
            if np.any(inside):
                columns = (ramp.temperature, ramp.storage_modulus, ramp.loss_modulus)
                cut.append(TemperatureRamp(ramp.angular_frequency, *(column[inside] for column in columns)))
        if not cut:
            raise InputError(
                f"no point lies between {shown_celsius(low)} and {shown_celsius(high)} °C.", code="no-points"
            )
        return replace(self, ramps=tuple(cut))

    def in_tension(self, poisson_ratio: float) -> TemperatureRamps:
        """Return the ramps as tensile moduli, E = 2(1+ν)G if they were measured in shear."""
        if self.deformation != "shear":
            return self
        factor, note = tensile_from_shear(poisson_ratio)
        ramps = tuple(ramp._times(factor) for ramp in self.ramps)
        return replace(self, ramps=ramps, deformation="tension", notes=(*self.notes, note))

    def to_dataset(self) -> Dataset:
        """Return the points along the dimension ``reading``, ramp by ramp.

        Returns
        -------
        xarray.Dataset
            ``temperature`` (K), ``angular_frequency`` (rad/s), ``storage_modulus`` and ``loss_modulus`` (Pa); the
            attributes are ``deformation``, ``source``, ``format``, and ``heating_rate`` (K/s) where it is known.
        """
        counts = [len(one) for one in self.ramps]
        rate = {} if self.heating_rate is None else {"heating_rate": self.heating_rate}
        return dataset(
            "reading",
            reading_columns(
                np.concatenate([one.temperature for one in self.ramps]),
                np.repeat(self.angular_frequencies, counts),
                np.concatenate([one.storage_modulus for one in self.ramps]),
                np.concatenate([one.loss_modulus for one in self.ramps]),
            ),
            attributes=self._origin() | rate,
        )
