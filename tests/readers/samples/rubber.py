"""Moduli of one synthetic rubber, so that every sample file holds the same physics."""

from __future__ import annotations

import numpy as np

SAMPLES: dict = {}

TEMPERATURES = (-10.0, 10.0, 30.0)  # °C
FREQUENCIES = tuple(float(f) for f in np.round(np.geomspace(0.1, 10.0, 5), 6))  # Hz


def moduli(temperature: float, frequency: float) -> tuple[float, float]:
    """Return storage and loss modulus, Pa, of a broad synthetic relaxation that a shift of WLF's form moves."""
    shift = -8.0 * (temperature - 10.0) / (100.0 + temperature - 10.0)
    z = (2j * np.pi * frequency * 10.0**shift * 1e-2) ** 0.4
    modulus = 3e6 + 1e9 * z / (1.0 + z)
    return float(modulus.real), float(modulus.imag)


def points() -> list[tuple[float, float, float, float]]:
    """Return temperature (°C), frequency (Hz), storage and loss modulus (Pa) of every point."""
    return [(T, f, *moduli(T, f)) for T in TEMPERATURES for f in FREQUENCIES]
