"""What the benchmark works on: measured sweeps from outside the checkout, planted ones that are always there."""

from __future__ import annotations

import csv
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import viscofric as vf

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "rheology"))
from planted import (  # noqa: E402
    FAMILIES,
    FREQUENCIES,
    PROGRAMME,
    STEP_PROGRAMMES,
    Planted,
    planted_steps,
    planted_sweeps,
    random_sweeps,
    synthetic_polymer,
    synthetic_soft_rubber,
)

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
MATERIALS = {
    "synthetic fluoroelastomer": vf.synthetic_fluoroelastomer,
    "synthetic polymer": synthetic_polymer,
    "synthetic soft rubber": synthetic_soft_rubber,
}
#: Temperatures (°C) and frequencies (Hz) at which sweeps with offsets are planted, and the reference.
PROGRAMMES = {
    "synthetic fluoroelastomer": (PROGRAMME, FREQUENCIES, "30 degC"),
    "synthetic polymer": (np.arange(-25.0, 101.0, 5.0), np.logspace(-2, 2, 21), "25 degC"),
    "synthetic soft rubber": (np.arange(-30.0, 91.0, 10.0), np.logspace(-2, 2, 21), "20 degC"),
}


def offset_problems() -> list[dict[str, Any]]:
    """Return problems of sweeps with noise of their points and offsets of whole isotherms."""
    found = []
    for material in PROGRAMMES:
        for noise, offset, shared in (
            (0.005, 0.0, False),
            (0.02, 0.0, False),
            (0.005, 0.01, False),
            (0.02, 0.01, False),
            (0.01, 0.02, False),
            (0.01, 0.02, True),
        ):
            found.append({"material": material, "noise": noise, "offset": offset, "shared": shared})
        found.append({"material": material, "noise": 0.005, "offset": 0.01, "vertical": "free", "rising": True})
        found.append({"material": material, "noise": 0.005, "offset": 0.0, "vertical": "free", "rising": True})
        found.append({"material": material, "noise": 0.005, "offset": 0.0, "rising": True})
        found += [
            {"material": material, "noise": 0.005, "offset": 0.01, "by": by}
            for by in ("storage", "loss", "loss-tangent")
        ]
    for one in found:
        how = "shared " if one.get("shared") else ""
        b = f", b = ρT {'fitted' if 'vertical' in one else 'left out'}" if one.get("rising") else ""
        short = one["material"].removeprefix("synthetic ")
        by = f", by {one['by']}" if "by" in one else ""
        one["title"] = f"{short}: {one['noise']:.1%}, {how}{one['offset']:.0%}{b}{by}"
    return found


def offset_case(problem: dict[str, Any], seed: int) -> tuple[Planted, str]:
    """Return planted sweeps of such a problem, and the reference."""
    celsius, frequencies, reference = PROGRAMMES[problem["material"]]
    shift = {"log10_b": vf.rheology.DensityShift(reference).log10} if problem.get("rising") else {}
    planted = planted_sweeps(
        seed,
        problem["noise"],
        material=MATERIALS[problem["material"]](),
        celsius=celsius,
        frequencies=frequencies,
        offset=problem["offset"],
        shared=problem.get("shared", False),
        **shift,
    )
    return planted, reference


def edge_problems() -> list[dict[str, Any]]:
    """Return families of random rubbers, without offsets of isotherms and with 3 %."""
    return [
        {"family": family, "offset": offset, "title": f"{family}, {offset:.0%} offsets"}
        for offset in (0.0, 0.03)
        for family in FAMILIES
    ]


def edge_case(problem: dict[str, Any], seed: int) -> tuple[Planted, float]:
    """Return sweeps of a random rubber, and the temperature of a middle isotherm as the reference, K."""
    planted = random_sweeps(seed, problem["family"], offset=problem["offset"])
    temperatures = planted.sweeps.temperatures
    return planted, float(temperatures[len(temperatures) // 2])


def step_problems() -> list[dict[str, Any]]:
    """Return problems of creep and relaxation tests with noise of their points and offsets of whole tests."""
    return [
        {
            "name": name,
            "kind": kind,
            "noise": noise,
            "offset": offset,
            "title": f"{kind}, {name}: {noise:.1%}, {offset:.0%}",
        }
        for kind in ("creep", "relaxation")
        for name in STEP_PROGRAMMES
        for noise, offset in ((0.005, 0.0), (0.02, 0.0), (0.005, 0.01))
    ]


def step_case(problem: dict[str, Any], seed: int) -> tuple[Any, vf.Material, str]:
    """Return planted tests of such a problem, the true material, and the reference."""
    return planted_steps(seed, problem["noise"], name=problem["name"], kind=problem["kind"], offset=problem["offset"])


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
