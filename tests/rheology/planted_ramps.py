"""Planted temperature ramps: moduli of a known material at some frequencies, with known noise."""

from __future__ import annotations

import numpy as np

import viscofric as vf
from rheology.planted import synthetic_polymer


def planted_ramps(seed, noise=0.01, *, material=None, hertz=(1.0, 10.0), celsius=None, alike=0.0):
    """Make ramps with multiplicative noise on E' and on E''; neighbours' errors may be correlated by `alike`."""
    material = material or synthetic_polymer()
    celsius = np.arange(-20.0, 101.0, 1.0) if celsius is None else np.asarray(celsius, dtype=float)
    random = np.random.default_rng(seed)
    ramps = []
    for number, frequency in enumerate(hertz):
        kelvin = celsius + 273.15 + (celsius[1] - celsius[0]) * number / len(hertz)  # one after the other
        modulus = material.spectrum.complex_modulus(2.0 * np.pi * frequency * material.shift(kelvin))
        errors = random.standard_normal((2, len(kelvin)))
        for place in range(1, len(kelvin)):
            errors[:, place] = alike * errors[:, place - 1] + np.sqrt(1.0 - alike**2) * errors[:, place]
        scatter = 1.0 + noise * errors
        ramps.append(
            vf.readers.TemperatureRamp(f"{frequency} Hz", kelvin, scatter[0] * modulus.real, scatter[1] * modulus.imag)
        )
    return vf.readers.TemperatureRamps(tuple(ramps), heating_rate=1.0 / 60.0)
