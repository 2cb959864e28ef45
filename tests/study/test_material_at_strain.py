"""A material of a run file scaled to a strain by an amplitude sweep."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import write_amplitudes
from viscofric.notes import codes
from viscofric.study.make_rubber import make_rubber
from viscofric.study.rubber_datasets import rubber_groups
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.study import validated
from viscofric.study.study_rubber import FrictionBands

LAW = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "tension")


@pytest.fixture
def sweep(tmp_path: Path) -> str:
    """Write a synthetic amplitude sweep without noise."""
    return str(write_amplitudes(tmp_path / "payne.csv", LAW, np.geomspace(5e-4, 0.5, 25)))


CATALOGUE = {"catalogue": "synthetic fluoroelastomer"}


def test_a_run_file_scales_its_material_to_a_strain(sweep: str) -> None:
    made = make_rubber(
        validated(MaterialTable, CATALOGUE | {"amplitude_sweep": sweep, "strain": 0.05, "measured_at": 0.001})
    )
    expected = vf.rheology.material_at_strain(vf.synthetic_fluoroelastomer(), LAW, 0.05, measured_at=0.001)
    omega = np.array([1.0, 62.8, 1e4])
    # constants fitted to data of 16 digits
    np.testing.assert_allclose(
        made.material.complex_modulus(omega, "60 degC"), expected.complex_modulus(omega, "60 degC"), rtol=1e-5
    )
    assert "scaled-to-strain" in codes(made.notes)
    assert made.attributes["tensile_strain"] == 0.05
    assert made.linear is not None
    assert rubber_groups(made)["/amplitude_sweep"].sizes["strain_amplitude"] == 25
    bands = FrictionBands(made, 20)
    assert bands.samples is None
    assert "no-bands" in codes(bands.notes)


def test_without_a_strain_the_material_is_as_it_was(sweep: str) -> None:
    made = make_rubber(validated(MaterialTable, CATALOGUE | {"amplitude_sweep": sweep}))
    assert made.linear is None
    assert made.payne is not None
    assert made.payne.law.constants == pytest.approx(LAW.constants, rel=1e-4)
    assert "no-strain" in codes(made.notes)


def test_keys_state_what_the_file_of_an_amplitude_sweep_leaves_open(tmp_path: Path) -> None:
    bare, known = tmp_path / "bare.csv", np.geomspace(5e-4, 0.5, 25)
    moduli = LAW.complex_modulus(known)
    rows = [f"{10.0},{a},{E.real},{E.imag}" for a, E in zip(known, moduli, strict=True)]
    bare.write_text("\n".join(["frequency (Hz),column four (1),storage modulus,loss modulus", *rows]), encoding="utf-8")
    keys = {"deformation": "tension", "modulus_unit": "Pa", "temperature": "60 degC"}
    keys |= {"columns": {"strain_amplitude": "column four (1)"}}
    chosen = CATALOGUE | {"amplitude_sweep": str(bare)}
    sweep = make_rubber(validated(MaterialTable, chosen | keys)).payne.sweep
    assert (sweep.deformation, sweep.temperature) == ("tension", pytest.approx(333.15))
    np.testing.assert_allclose(sweep.storage_modulus, moduli.real)
    for name, code in zip(keys, ("no-deformation", "no-unit", "no-temperature", "missing-columns"), strict=True):
        with refused(code, vf.DataFileError):
            make_rubber(validated(MaterialTable, chosen | {key: one for key, one in keys.items() if key != name}))
    with refused("contradiction", vf.StudyError):  # without an amplitude sweep, nothing is left open
        validated(MaterialTable, CATALOGUE | keys)


def test_a_strain_needs_an_amplitude_sweep() -> None:
    with refused("contradiction", vf.StudyError):
        validated(MaterialTable, CATALOGUE | {"strain": 0.05})
