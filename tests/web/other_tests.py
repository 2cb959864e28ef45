"""Creep tests, sweeps, temperature ramps and an amplitude sweep, synthetic, as tables."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import viscofric as vf
from rheology.planted import write_amplitudes, write_moduli


def creep(folder: Path, celsius: tuple[float, ...] = (0.0, 10.0, 20.0)) -> Path:
    """Write creep tests in tension, which the file does not state."""
    rubber, time = vf.synthetic_fluoroelastomer(), np.logspace(0.0, 3.0, 25)
    rows = ["T (degC),t (s),J(t) (1/MPa)"]
    for one in celsius:
        response = 1e6 * rubber.at(one + 273.15).creep_compliance(time)
        rows += [f"{one},{t:.8g},{J:.8g}" for t, J in zip(time, response, strict=True)]
    path = folder / "creep.csv"
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def sweeps(folder: Path, celsius: tuple[float, ...] = (-5.0, 0.0, 5.0, 10.0)) -> Path:
    """Write sweeps over two decades."""
    rubber = vf.synthetic_fluoroelastomer()
    return write_moduli(folder / "sweeps.csv", rubber.complex_modulus, celsius, np.logspace(-1.0, 1.0, 13))


def ramp(folder: Path, *hertz: float) -> Path:
    """Write a ramp from -30 to 80 °C at some frequencies."""
    rubber = vf.synthetic_fluoroelastomer()
    return write_moduli(folder / "ramp.csv", rubber.complex_modulus, np.arange(-30.0, 80.0, 2.0), hertz)


def amplitudes(folder: Path) -> Path:
    """Write an amplitude sweep at 10 Hz and 60 °C."""
    law = vf.rheology.KrausLaw(6e6, 3e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "tension")
    return write_amplitudes(folder / "payne.csv", law, np.geomspace(5e-4, 0.5, 25))
