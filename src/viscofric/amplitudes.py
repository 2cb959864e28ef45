"""Amplitude sweeps: moduli against the amplitude of the strain, at one frequency and one temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Deformation, Origin, modulus_columns, set_columns, tensile_from_shear
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, Quantity, angular_frequency, positive, shown_celsius


@dataclass(frozen=True, eq=False)
class AmplitudeSweep(Origin, Plotted):
    """Moduli of one specimen at growing amplitudes of the strain.

    Parameters
    ----------
    strain_amplitude : (n,) array
        Of the oscillation, ascending, as a fraction (0.01 is 1 %).
    storage_modulus, loss_modulus : (n,) array
        As measured, positive, Pa.
    angular_frequency : float or quantity
        rad/s, or text such as ``"10 Hz"``.
    temperature : float or quantity
        K, or text such as ``"60 degC"``.
    deformation : {"tension", "compression", "bending", "shear"}
        Whether the moduli are E and the strain is that of tension, or G and a shear.
    source : str
        Origin, such as a file's name.
    notes : tuple of str
        What the reader found doubtful, left out or averaged: one sentence each.
    format : str
        The recognised format in words; empty for a sweep from no file.

    Examples
    --------
    >>> import viscofric as vf
    >>> sweep = vf.readers.AmplitudeSweep(
    ...     [1e-3, 1e-2, 1e-1], [5e6, 4e6, 2e6], [4e5, 6e5, 3e5], "10 Hz", "60 degC", "shear"
    ... )
    >>> sweep.in_tension(0.5).storage_modulus  # E = 2(1+ν)G
    array([15000000., 12000000.,  6000000.])
    """

    strain_amplitude: Array
    storage_modulus: Array
    loss_modulus: Array
    angular_frequency: float
    temperature: float
    deformation: Deformation = "tension"
    source: str = ""
    notes: tuple[str, ...] = ()
    format: str = ""

    if TYPE_CHECKING:  # what is given, converted when made

        def __init__(
            self,
            strain_amplitude: Quantities,
            storage_modulus: Quantities,
            loss_modulus: Quantities,
            angular_frequency: Quantity,
            temperature: Quantity,
            deformation: Deformation = "tension",
            source: str = "",
            notes: tuple[str, ...] = (),
            format: str = "",  # noqa: A002
        ) -> None: ...

    def __post_init__(self) -> None:
        self._check_origin("the sweep")
        columns = ("strain_amplitude", "storage_modulus", "loss_modulus")
        set_columns(self, *columns, of="an amplitude sweep", per="amplitude")
        if np.any(np.diff(self.strain_amplitude) <= 0.0):
            raise InputError("the amplitudes of an amplitude sweep must ascend without repeats.", code="not-ascending")
        frequency = angular_frequency(self.angular_frequency, "angular_frequency of an amplitude sweep")
        object.__setattr__(self, "angular_frequency", frequency)
        object.__setattr__(self, "temperature", positive(self.temperature, "K", "temperature of an amplitude sweep"))

    def __len__(self) -> int:
        return len(self.strain_amplitude)

    def _shown(self) -> Rows:
        return (
            ("strain amplitude", self.strain_amplitude, "%"),
            ("storage modulus", self.storage_modulus, "Pa"),
            ("frequency", self.angular_frequency / (2.0 * np.pi), "Hz"),
            ("temperature", self.temperature, "°C"),
            ("deformation", self.deformation),
            ("notes", self.notes),
        )

    def __str__(self) -> str:
        """Return amplitudes, frequency, temperature and deformation as a line of text."""
        low, high = 100.0 * self.strain_amplitude[[0, -1]]
        hertz = self.angular_frequency / (2.0 * np.pi)
        return f"{low:.3g} to {high:.3g} % at {hertz:.3g} Hz, {shown_celsius(self.temperature)} °C, {self.deformation}"

    def in_tension(self, poisson_ratio: float) -> AmplitudeSweep:
        """Return the sweep as tensile moduli and strains of tension, E = 2(1+ν)G and ε = γ/√3, if it was in shear.

        A tension and a shear of these amplitudes have the same energy of distortion.
        """
        if self.deformation != "shear":
            return self
        factor, note = tensile_from_shear(poisson_ratio, more=", strains by ε = γ/√3")
        return replace(
            self,
            strain_amplitude=self.strain_amplitude / np.sqrt(3.0),
            storage_modulus=factor * self.storage_modulus,
            loss_modulus=factor * self.loss_modulus,
            deformation="tension",
            notes=(*self.notes, note),
        )

    def to_dataset(self) -> Dataset:
        """Return the moduli along ``strain_amplitude``.

        Returns
        -------
        xarray.Dataset
            ``storage_modulus`` and ``loss_modulus`` (Pa); the attributes are ``angular_frequency`` (rad/s),
            ``temperature`` (K), ``deformation``, ``source`` and ``format``.
        """
        return dataset(
            "strain_amplitude",
            modulus_columns(self.storage_modulus, self.loss_modulus),
            coordinates={"strain_amplitude": (self.strain_amplitude, "1", "strain amplitude")},
            attributes={"angular_frequency": self.angular_frequency, "temperature": self.temperature} | self._origin(),
        )
