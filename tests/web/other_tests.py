"""Creep tests, sweeps, temperature ramps and an amplitude sweep, synthetic, as tables."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import viscofric as vf

_DMA = "T (degC),f (Hz),E' (MPa),E'' (MPa)"


def _write(path: Path, rows: list[str]) -> Path:
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def creep(folder: Path, celsius: tuple[float, ...] = (0.0, 10.0, 20.0)) -> Path:
    """Write creep tests in tension, which the file does not state."""
    rubber, time = vf.synthetic_fluoroelastomer(), np.logspace(0.0, 3.0, 25)
    rows = ["T (degC),t (s),J(t) (1/MPa)"]
    for one in celsius:
        response = 1e6 * rubber.at(one + 273.15).creep_compliance(time)
        rows += [f"{one},{t:.8g},{J:.8g}" for t, J in zip(time, response, strict=True)]
    return _write(folder / "creep.csv", rows)


def sweeps(folder: Path, celsius: tuple[float, ...] = (-5.0, 0.0, 5.0, 10.0)) -> Path:
    """Write sweeps over two decades."""
    rubber, hertz = vf.synthetic_fluoroelastomer(), np.logspace(-1.0, 1.0, 13)
    rows = [_DMA]
    for one in celsius:
        E = 1e-6 * rubber.complex_modulus(2.0 * np.pi * hertz, one + 273.15)
        rows += [f"{one},{f:.8g},{e.real:.8g},{e.imag:.8g}" for f, e in zip(hertz, E, strict=True)]
    return _write(folder / "sweeps.csv", rows)


def ramp(folder: Path, *hertz: float) -> Path:
    """Write a ramp from -30 to 80 °C at some frequencies."""
    rubber, rows = vf.synthetic_fluoroelastomer(), [_DMA]
    for one in np.arange(-30.0, 80.0, 2.0):
        moduli = {f: 1e-6 * rubber.complex_modulus(2.0 * np.pi * f, one + 273.15) for f in hertz}
        rows += [f"{one},{f},{E.real:.8g},{E.imag:.8g}" for f, E in moduli.items()]
    return _write(folder / "ramp.csv", rows)


def amplitudes(folder: Path) -> Path:
    """Write an amplitude sweep at 10 Hz and 60 °C."""
    law = vf.rheology.KrausLaw(6e6, 3e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "tension")
    rows = ["T (degC),f (Hz),strain (%),E' (MPa),E'' (MPa)"]
    for strain in np.geomspace(5e-4, 0.5, 25):
        E = 1e-6 * law.complex_modulus(strain)
        rows.append(f"60,10,{100.0 * strain:.8g},{E.real:.8g},{E.imag:.8g}")
    return _write(folder / "payne.csv", rows)
