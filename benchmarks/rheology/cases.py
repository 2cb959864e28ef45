"""What the benchmark works on: measured sweeps from outside the checkout, planted ones that are always there."""

from __future__ import annotations

import csv
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import viscofric as vf

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "rheology"))
from planted import Planted, planted_sweeps, synthetic_polymer  # noqa: E402

if TYPE_CHECKING:
    from viscofric.data import IsothermalSweeps, MasterCurve

REFERENCE = 293.15  # K


@dataclass(frozen=True)
class Case:
    """Sweeps to be shifted: a name, tensile isotherms, and the truth where it was planted."""

    name: str
    sweeps: IsothermalSweeps
    truth: Planted | None = None

    @property
    def reference(self) -> float:
        """Measured temperature nearest to 20 °C, K: some peers know no other references."""
        temperatures = self.sweeps.temperatures
        return float(temperatures[np.argmin(np.abs(temperatures - REFERENCE))])


#: Rubbers whose sweeps are planted.
MATERIALS = {"synthetic fluoroelastomer": vf.synthetic_fluoroelastomer, "synthetic polymer": synthetic_polymer}


def planted_case(seed: int = 0, material: str = "synthetic fluoroelastomer") -> Case:
    """Return synthetic sweeps with 1 % noise, 26 isotherms, whose true shifts and moduli are known."""
    planted = planted_sweeps(seed, 0.01, material=MATERIALS[material]())
    return Case(f"planted {material}, 1 % noise", planted.sweeps, planted)


def measured_case() -> Case | str:
    """Return the acrylic 468MP, or why it is not there."""
    folder = Path(os.environ.get("VISCOFRIC_REAL_DATA", ROOT / ".." / "shared" / "data"))
    path = folder / "dma" / "acrylic_468mp.csv"
    if not path.is_file():
        return "acrylic 468MP: no dma/acrylic_468mp.csv in the folder that VISCOFRIC_REAL_DATA names"
    return Case("acrylic 468MP", vf.read_dma(path, deformation="shear").in_tension(0.5))


def write_sweeps(sweeps: IsothermalSweeps, path: Path) -> None:
    """Write isotherms for the adapters: °C, rad/s, Pa, Pa."""
    rows = [
        (isotherm.temperature - 273.15, *row)
        for isotherm in sweeps.isotherms
        for row in zip(isotherm.angular_frequency, isotherm.storage_modulus, isotherm.loss_modulus, strict=True)
    ]
    _write(path, ("T_C", "omega", "storage", "loss"), rows)


def write_master_curve(curve: MasterCurve, path: Path) -> None:
    """Write a master curve for the adapters: rad/s, Pa, Pa."""
    rows = zip(curve.angular_frequency, curve.storage_modulus, curve.loss_modulus, strict=True)
    _write(path, ("omega", "storage", "loss"), list(rows))


def _write(path: Path, names: tuple[str, ...], rows: list[tuple[float, ...]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        writer.writerows([f"{float(number):.17g}" for number in row] for row in rows)
