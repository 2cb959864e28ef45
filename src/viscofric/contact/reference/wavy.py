"""Wavy surfaces on a half-space: Westergaard's waves, Johnson's crossed waves, and full contact at any speed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.reference._checks import plane_strain_modulus
from viscofric.errors import InputError
from viscofric.units import Quantity, checked_poisson_ratio, positive


@dataclass(frozen=True)
class WavyContact:
    """Elastic contact with the waves of height Δ(1 − cos 2πx/λ)."""

    mean_pressure: float  # p̄, Pa
    full_contact_pressure: float  # p* = πE*Δ/λ, the mean pressure from which on contact is full, Pa
    wavelength: float  # λ, m
    half_width: float  # a, half the width of the contact on each crest, m; λ/2 in full contact
    max_pressure: float  # on the crests, Pa

    @property
    def area_fraction(self) -> float:
        """Real over apparent area of contact."""
        return 2.0 * self.half_width / self.wavelength

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure at x from a crest, in m; Pa."""
        angle = np.pi * np.asarray(x, dtype=float) / self.wavelength
        if self.mean_pressure >= self.full_contact_pressure:
            return np.asarray(self.mean_pressure + self.full_contact_pressure * np.cos(2.0 * angle))
        filled = self.mean_pressure / self.full_contact_pressure  # sin²(πa/λ)
        open_part = np.sqrt(np.maximum(0.0, filled - np.sin(angle) ** 2))
        return np.asarray(2.0 * self.mean_pressure / filled * np.abs(np.cos(angle)) * open_part)


def westergaard(
    mean_pressure: Quantity, amplitude: Quantity, wavelength: Quantity, modulus: Quantity, poisson_ratio: float
) -> WavyContact:
    """Westergaard's solution for parallel waves on an elastic half-space, partial or full contact.

    p̄ in Pa, Δ (half the height from trough to crest) in m, λ in m, E in Pa.  H. M. Westergaard, J. Appl. Mech. 6
    (1939) A49; K. L. Johnson, Contact Mechanics (1985), Sec. 13.2.  Raises InputError if a value is not above zero, or
    Poisson's ratio not between 0 and 0.5.
    """
    mean, length = positive(mean_pressure, "Pa", "mean_pressure"), positive(wavelength, "m", "wavelength")
    full = math.pi * plane_strain_modulus(modulus, poisson_ratio) * positive(amplitude, "m", "amplitude") / length
    if mean >= full:
        return WavyContact(mean, full, length, 0.5 * length, mean + full)
    half_width = length / math.pi * math.asin(math.sqrt(mean / full))
    return WavyContact(mean, full, length, half_width, 2.0 * math.sqrt(mean * full))


@dataclass(frozen=True)
class CrossedWaves:
    """Elastic contact with crossed waves of height Δ(1 − cos(2πx/λ) cos(2πy/λ)): the limits known in closed form."""

    full_contact_pressure: float  # p* = √2 πE*Δ/λ, the mean pressure from which on contact is full, Pa
    wavelength: float  # λ, m; there are two crests on each area λ²

    def area_fraction_at_low_pressure(self, mean_pressure: float) -> float:
        """Area fraction for p̄ ≪ p*, each crest a contact of Hertz: π (3p̄/(8πp*))^(2/3)."""
        crest = 3.0 * mean_pressure / (8.0 * math.pi * self.full_contact_pressure)
        return math.pi * math.pow(crest, 2.0 / 3.0)

    def area_fraction_at_high_pressure(self, mean_pressure: float) -> float:
        """Area fraction for p̄ just below p*, each trough a round opening: 1 − 3/(2π) (1 − p̄/p*)."""
        return 1.0 - 1.5 / math.pi * (1.0 - mean_pressure / self.full_contact_pressure)


def crossed_waves(amplitude: Quantity, wavelength: Quantity, modulus: Quantity, poisson_ratio: float) -> CrossedWaves:
    """Full contact and both asymptotes of partial contact for crossed waves on an elastic half-space.

    Δ in m, λ in m, E in Pa.  K. L. Johnson, J. A. Greenwood, J. G. Higginson, Int. J. Mech. Sci. 27 (1985) 383,
    doi:10.1016/0020-7403(85)90029-3.  Raises InputError if a value is not above zero, or Poisson's ratio not between 0
    and 0.5.
    """
    length, height = positive(wavelength, "m", "wavelength"), positive(amplitude, "m", "amplitude")
    full = math.sqrt(2.0) * math.pi * plane_strain_modulus(modulus, poisson_ratio) * height / length
    return CrossedWaves(full, length)


@dataclass(frozen=True)
class FullContactWave:
    """Parallel waves of height Δ(1 − cos qx) in full contact with a viscoelastic half-space, moving towards +x."""

    mean_pressure: float  # p̄, Pa
    in_phase: float  # of p = p̄ + in_phase cos qx + out_of_phase sin qx, Pa: the part of E'
    out_of_phase: float  # Pa, the part of E''
    wavenumber: float  # q = 2π/λ, 1/m
    friction_coefficient: float  # μ = (qΔ)² E''(qv)/(4(1−ν²) p̄)

    @property
    def full_contact_pressure(self) -> float:
        """Least mean pressure of full contact, qΔ |E(qv)|/(2(1−ν²)), Pa."""
        return math.hypot(self.in_phase, self.out_of_phase)

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure at x ahead of a crest, in m; Pa."""
        angle = self.wavenumber * np.asarray(x, dtype=float)
        return np.asarray(self.mean_pressure + self.in_phase * np.cos(angle) + self.out_of_phase * np.sin(angle))


def full_contact_wave(
    mean_pressure: Quantity,
    amplitude: Quantity,
    wavelength: Quantity,
    complex_modulus: complex,
    poisson_ratio: float,
) -> FullContactWave:
    """Full contact of parallel waves that slide over a viscoelastic half-space, exactly, at any speed.

    p̄ in Pa, Δ and λ in m; `complex_modulus` is E(ω) at ω = 2πv/λ, Pa, with E'' ≥ 0 as its imaginary part.  u = const +
    Δ cos qx gives p̂ = q E(−qv) û/(2(1−ν²)), with E(−ω) = E' − iE''; and F_t is the mean of p ∂h/∂x.

    Raises InputError if a value is not above zero, the loss modulus is negative, Poisson's ratio is not between 0 and
    0.5, or contact is not full at this mean pressure.
    """
    mean = positive(mean_pressure, "Pa", "mean_pressure")
    q = 2.0 * math.pi / positive(wavelength, "m", "wavelength")
    steepness = q * positive(amplitude, "m", "amplitude")
    modulus = complex(complex_modulus)
    if modulus.real <= 0.0 or modulus.imag < 0.0:
        raise InputError(
            f"complex_modulus = {modulus}: E' must be above zero and E'' not below it.", code="not-positive"
        )
    wave = steepness * modulus / (2.0 * (1.0 - checked_poisson_ratio(poisson_ratio) ** 2))
    if abs(wave) > mean:
        raise InputError(
            f"mean_pressure = {mean:g} Pa: contact is full from {abs(wave):g} Pa on only.", code="partial-contact"
        )
    return FullContactWave(mean, wave.real, wave.imag, q, 0.5 * steepness * wave.imag / mean)
