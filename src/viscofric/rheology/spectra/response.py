"""The base of all descriptions of a material by its complex modulus: E', E'', tan δ, and the densities H and L."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array, ComplexArray
from viscofric.data import modulus_columns
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.showing import Plotted
from viscofric.units import in_si, positive


class FrequencyResponse(Plotted, ABC):
    """A linear viscoelastic solid or liquid at one temperature, known by E(ω) (convention e^{+iωt})."""

    @abstractmethod
    def complex_modulus(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return E(ω) = E' + iE'', Pa, in the shape of `angular_frequency` (rad/s)."""

    @abstractmethod
    def compliance(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return S(ω) = 1/E(ω), 1/Pa, in the shape of `angular_frequency` (rad/s, any sign)."""

    def storage_modulus(self, angular_frequency: ArrayLike) -> Array:
        """Return E'(ω), Pa."""
        return np.asarray(self.complex_modulus(angular_frequency).real)

    def loss_modulus(self, angular_frequency: ArrayLike) -> Array:
        """Return E''(ω), Pa."""
        return np.asarray(self.complex_modulus(angular_frequency).imag)

    def loss_tangent(self, angular_frequency: ArrayLike) -> Array:
        """Return tan δ = E''/E'."""
        modulus = self.complex_modulus(angular_frequency)
        return np.asarray(modulus.imag / modulus.real)

    def modulus_dataset(self, angular_frequency: ArrayLike) -> Dataset:
        """Return E' and E'' (Pa) over angular frequencies (n,), rad/s, as a labelled data set.

        ``storage_modulus`` and ``loss_modulus`` (Pa) along ``angular_frequency``.
        """
        omega = np.ravel(in_si(angular_frequency, "rad/s", "angular_frequency"))
        modulus = self.complex_modulus(omega)
        return dataset(
            "angular_frequency",
            modulus_columns(modulus.real, modulus.imag),
            coordinates={"angular_frequency": (omega, "rad/s", "angular frequency")},
        )

    def relaxation_density(self, time: ArrayLike) -> Array:
        """Return the relaxation spectrum H(ln τ), Pa, estimated from the modulus at ω = 1/τ.

        H is defined by E(t) = E0 + ∫ H(τ) exp(−t/τ) d ln τ.  The estimate is

            H(τ) ≈ (2/π) E''(ω) cos δ(ω),    ω = 1/τ,

        which is exact where H follows a power of τ, and shows a bell 1.1 decades wide at half its height in place
        of a single mode.  It makes discrete modes, tables and measurements comparable; a series' own modes are
        drawn as E_k divided by the logarithm of the ratio of their times.

        Parameters
        ----------
        time : array_like
            Relaxation times, above zero, s.

        References
        ----------
        H. C. Booij, J. H. M. Palmen, Rheol. Acta 21 (1982) 376.
        """
        modulus = self.complex_modulus(1.0 / _times(time))
        return np.asarray(2.0 / math.pi * modulus.imag * modulus.real / np.abs(modulus))

    def retardation_density(self, time: ArrayLike) -> Array:
        """Return the retardation spectrum L(ln τ), 1/Pa, estimated from the compliance at ω = 1/τ.

        L is defined by J(t) = 1/E_inf + ∫ L(τ) (1 − exp(−t/τ)) d ln τ (+ t/η for a liquid).  The estimate is
        (2/π) J''(ω) cos δ(ω) with J'' = −Im S, as exact and as smoothed as `relaxation_density`.  For a liquid
        it contains its flow.

        Parameters
        ----------
        time : array_like
            Retardation times, above zero, s.
        """
        compliance = self.compliance(1.0 / _times(time))
        return np.asarray(-2.0 / math.pi * compliance.imag * compliance.real / np.abs(compliance))


def _times(values: ArrayLike) -> Array:
    time = in_si(values, "s", "time")
    if not np.all(time > 0.0):
        raise InputError(
            "times of a relaxation or retardation density must be above zero and finite, in s.", code="not-positive"
        )
    return time


def checked_times(values: ArrayLike, name: str) -> Array:
    """Return the times of a step response; InputError if one is below zero."""
    time = in_si(values, "s", "time", infinite=True)
    if not np.all(time >= 0.0):
        raise InputError(f"time of a {name} must not be below zero, nor NaN.", code="not-positive")
    return time


def checked_shift(alpha: float, b: float) -> tuple[float, float]:
    """Return shift factors; InputError unless they are above zero and finite."""
    return positive(alpha, "dimensionless", "alpha"), positive(b, "dimensionless", "b")


def shown_modulus(modulus: float) -> str:
    """Return a modulus in Pa as text for users."""
    for unit, size in (("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)):
        if modulus >= size:
            return f"{modulus / size:.4g} {unit}"
    return f"{modulus:.4g} Pa"
