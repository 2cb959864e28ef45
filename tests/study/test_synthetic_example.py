"""The built-in synthetic data: made by the script in the repository, from contacts that others confirm."""

from __future__ import annotations

import importlib.util
import sys
from importlib.resources import files
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import viscofric as vf
from contact.dense_reference import dense_friction
from marks import apart

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(str(files("viscofric")))
TESTS = ("example", "paper")


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_example", ROOT / "scripts" / "make_synthetic_example.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses look for its names
    spec.loader.exec_module(module)
    return module


def planted(test: str) -> np.ndarray:
    return np.loadtxt(ROOT / "tests" / "data" / f"planted_{test}_friction.csv", delimiter=",", skiprows=3)


@pytest.mark.parametrize("test", TESTS)
@pytest.mark.parametrize("name", ["dma.csv", "mtm.csv"])
def test_the_script_makes_the_files_that_are_shipped(script: ModuleType, tmp_path: Path, name: str, test: str) -> None:
    about = getattr(script, test.upper())
    (script.make_dma if name == "dma.csv" else script.make_mtm)(about, tmp_path / name)
    folders = (tmp_path, PACKAGE / about.folder)
    made, shipped = ((folder / name).read_text(encoding="utf-8").splitlines() for folder in folders)
    assert [line for line in made if line[0] in "#t"] == [line for line in shipped if line[0] in "#t"]
    # The last of six digits may round the other way on another machine.
    np.testing.assert_allclose(
        *(np.loadtxt(lines, delimiter=",", skiprows=len(lines) - 300) for lines in (made, shipped)), rtol=2e-5
    )


@pytest.mark.parametrize("folder", ["example", "templates/paper"])
@pytest.mark.parametrize("name", ["dma.csv", "mtm.csv", "study.toml"])
def test_synthetic_data_say_that_they_are(name: str, folder: str) -> None:
    assert "SYNTHETIC" in (PACKAGE / folder / name).read_text(encoding="utf-8").splitlines()[0]


@pytest.mark.parametrize("test", TESTS)
def test_planted_friction_obeys_the_energy_balance(test: str) -> None:
    friction, from_dissipation, error = planted(test)[:, 2:5].T
    # Solved to 1e-4; the balance of pressure and dissipation was among the criteria.
    assert np.all(error <= 1e-4 * friction)
    np.testing.assert_allclose(from_dissipation, friction, rtol=2e-4)  # each of the two has an error of up to 1e-4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("test", "load", "row"),
    [("paper", 25.0, 19), ("example", 10.0, 65), *apart(("paper", 25.0, 0), ("example", 10.0, 12))],
)
def test_planted_friction_agrees_with_an_independent_solution(test: str, load: float, row: int) -> None:
    temperature, speed, friction = planted(test)[row, :3]
    spectrum = vf.synthetic_fluoroelastomer().at(f"{temperature} degC")
    independent, _ = dense_friction(
        spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, 0.5, 9.525e-3, load, speed, cells=20
    )
    # 20 cells across a contact whose friction is a small lean of the pressure: up to 1 % of discretisation.
    assert independent == pytest.approx(friction, rel=0.015)
