"""Files that version 0.1.0 wrote open in this version, with the same numbers, and damage is noticed.

A version that changes a format adds its files to `tests/data/stored`; those here stay as they are.
"""

from __future__ import annotations

import contextlib
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from study.sweeps import RECORD, friction_of, made_sweep
from viscofric.friction.curve_files import read_friction_curves
from viscofric.study.results.file import DIGEST
from viscofric.study.running.folder import check_results
from viscofric.study.running.store import CaseStore

STORED = Path(__file__).parent / "data" / "stored"
KEY = "0" * 32


def test_results_open() -> None:
    results = vf.open_results(STORED / "results")
    assert results.tree.attrs[DIGEST]
    assert results.tree.attrs["viscofric_version"]
    found = results.dataset["friction_coefficient"].values.ravel()
    expected = np.array([friction_of(case) for case in made_sweep().cases])
    assert np.isnan(found).sum() == 1
    np.testing.assert_allclose(np.sort(found[np.isfinite(found)]), np.sort(np.delete(expected, 2)))


def test_stored_cases_open_and_have_checksums() -> None:
    case = CaseStore(STORED / "results" / "cases").get(KEY)
    assert getattr(case, "numbers", None) == RECORD.numbers
    checked = check_results(STORED / "results")
    assert (checked.cases, checked.finished, checked.damaged) == (1, True, {})


def test_a_material_opens() -> None:
    material, now = vf.read_card(STORED / "material.json"), vf.synthetic_fluoroelastomer()
    assert material.complex_modulus(10.0, "60 degC") == pytest.approx(now.complex_modulus(10.0, "60 degC"))


def test_friction_curves_open() -> None:
    curves = read_friction_curves(STORED / "curves.csv")
    np.testing.assert_allclose(curves.viscoelastic, [0.01305858432235433, 0.007868371247727825], rtol=1e-6)
    assert curves.load_unit == "N"


def test_the_state_of_a_run_is_resumed() -> None:
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    longer = vf.motion.History(time=[0.0, 0.1, 0.2], load=["1 N", "1 N", "3 N"])
    about = {"times": ["0.2 s"]}
    resumed = vf.motion.solve_transient(rubber, vf.Ball("10 mm"), longer, resume=STORED / "state.npz", **about)
    whole = vf.motion.solve_transient(rubber, vf.Ball("10 mm"), longer, **about)
    np.testing.assert_allclose(resumed.indentation[-1], whole.indentation[-1], rtol=2e-3)


def test_changed_numbers_of_a_state_are_noticed(tmp_path: Path) -> None:
    with np.load(STORED / "state.npz") as stored:
        arrays = {name: stored[name] for name in stored.files}
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    history, path = vf.motion.History(time=[0.0, 0.1, 0.2], load=["1 N", "1 N", "3 N"]), tmp_path / "state.npz"
    np.savez_compressed(path, **arrays | {"1": arrays["1"] + 1e-9})
    with refused("not-a-state"):
        vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=["0.2 s"], resume=path)
    np.savez_compressed(path, **arrays | {"format": np.asarray("viscofric state 2")})
    with refused("other-version"):
        vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=["0.2 s"], resume=path)


def test_a_changed_byte_of_results_is_noticed(tmp_path: Path) -> None:
    shutil.copytree(STORED / "results", tmp_path / "results")
    path = tmp_path / "results" / "cases" / f"{KEY}.json"
    path.write_bytes(path.read_bytes().replace(b"0.02", b"0.03", 1))
    assert list(check_results(tmp_path / "results").damaged) == [path]


def test_results_without_a_checksum_are_damaged(tmp_path: Path) -> None:
    shutil.copytree(STORED / "results", tmp_path / "results")
    path = tmp_path / "results" / "results.nc"
    with h5py.File(path, "r+") as file:
        del file.attrs[DIGEST]
    assert list(check_results(tmp_path / "results").damaged) == [path]
    with refused("damaged"):
        vf.open_results(path)


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    "name", ["results/results.nc", f"results/cases/{KEY}.json", "material.json", "curves.csv", "state.npz"]
)
def test_mutated_files_are_refused_or_read_whole(name: str, tmp_path: Path) -> None:
    """Bytes flipped, removed and repeated at random: an error of viscofric, or a result; nothing else."""
    from viscofric.errors import ViscofricError

    content = (STORED / name).read_bytes()
    chance = np.random.default_rng(1)
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    path = tmp_path / Path(name).name
    for _ in range(200):
        changed = bytearray(content)
        for place in chance.integers(0, len(content), 1 + int(chance.integers(4))).tolist():
            match int(chance.integers(3)):
                case 0:
                    changed[place % len(changed)] ^= 1 << int(chance.integers(8))
                case 1:
                    del changed[place : place + int(chance.integers(1, 100))]
                case _:
                    changed[place:place] = changed[place : place + 20]
        path.write_bytes(bytes(changed))
        with contextlib.suppress(ViscofricError):
            match path.suffix:
                case ".nc":
                    _ = vf.open_results(path).dataset
                case ".npz":
                    history = vf.motion.History(time=[0.0, 0.1], load="1 N")
                    vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=["0.1 s"], resume=path)
                case ".csv":
                    read_friction_curves(path)
                case _ if name == "material.json":
                    vf.read_card(path)
                case _:
                    CaseStore(tmp_path).get(KEY)
