"""The built-in synthetic data: made by the script in the repository, from contacts that others confirm."""

from __future__ import annotations

import importlib.util
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import viscofric as vf
from contact.dense_reference import dense_friction

if TYPE_CHECKING:
    from types import ModuleType

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = Path(str(files("viscofric"))) / "example"
PLANTED = ROOT / "tests" / "data" / "planted_friction.csv"


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_example", ROOT / "scripts" / "make_synthetic_example.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def planted() -> np.ndarray:
    return np.loadtxt(PLANTED, delimiter=",", skiprows=3)


@pytest.mark.parametrize("name", ["dma.csv", "mtm.csv"])
def test_the_script_makes_the_files_that_are_shipped(script: ModuleType, tmp_path: Path, name: str) -> None:
    if name == "dma.csv":
        script.make_dma(tmp_path / name)
    else:
        script.make_mtm(tmp_path / name, PLANTED)
    made, shipped = ((folder / name).read_text(encoding="utf-8").splitlines() for folder in (tmp_path, EXAMPLE))
    assert [line for line in made if line[0] in "#t"] == [line for line in shipped if line[0] in "#t"]
    # The last of six digits may round the other way on another machine.
    np.testing.assert_allclose(
        *(np.loadtxt(lines, delimiter=",", skiprows=len(lines) - 300) for lines in (made, shipped)), rtol=2e-5
    )


@pytest.mark.parametrize("name", ["dma.csv", "mtm.csv", "study.toml"])
def test_synthetic_data_say_that_they_are(name: str) -> None:
    assert "SYNTHETIC" in (EXAMPLE / name).read_text(encoding="utf-8").splitlines()[0]


def test_planted_friction_obeys_the_energy_balance() -> None:
    friction, from_dissipation, error = planted()[:, 2:].T
    # Solved to 1e-4; the balance of pressure and dissipation was among the criteria.
    assert np.all(error <= 1e-4 * friction)
    np.testing.assert_allclose(from_dissipation, friction, rtol=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("row", [0, 10, 19, 29])
def test_planted_friction_agrees_with_an_independent_solution(row: int) -> None:
    temperature, speed, friction = planted()[row, :3]
    spectrum = vf.synthetic_fluoroelastomer().at(f"{temperature} degC")
    independent, _ = dense_friction(
        spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, 0.5, 9.525e-3, 25.0, speed, cells=20
    )
    # 20 cells across a contact whose friction is a small lean of the pressure: up to 1 % of discretisation.
    assert independent == pytest.approx(friction, rel=0.015)
