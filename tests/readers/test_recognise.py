"""The kind of a mechanical test is recognised by its content."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from cli.calls import succeed
from refusals import refused
from viscofric.errors import DataFileError
from viscofric.readers.recognise import by_kind, kind_of_test

DMA = "T (degC),f (Hz),E' (MPa),E'' (MPa)"
SWEEP = [f"{T},{f},5,0.5" for T in (20, 30) for f in (0.1, 1, 10)]
RAMP = [f"{T},1,{100 - T},5" for T in range(0, 60, 2)]
SAMPLES = {
    "dma": [DMA, *SWEEP],
    "ramps": [DMA, *RAMP],
    "amplitude": [f"{DMA},strain (%)", *(f"30,1,{5 - g},0.5,{10 ** (g - 2)}" for g in (0, 0.4, 0.8, 1.2, 1.6, 2, 2.4))],
    "creep": ["T (degC),t (s),D(t) (1/MPa)", *(f"20,{t},{0.1 + 0.01 * t}" for t in range(1, 9))],
    "relaxation": ["T (degC),t (s),E(t) (MPa)", *(f"20,{t},{9 - 0.1 * t}" for t in range(1, 9))],
}


def written(folder: Path, kind: str, name: str = "") -> Path:
    path = folder / (name or f"{kind}.csv")
    path.write_text("\n".join(SAMPLES[kind]) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("kind", SAMPLES)
def test_kinds_are_recognised_and_read(tmp_path: Path, kind: str) -> None:
    path = written(tmp_path, kind, "test.csv")
    assert kind_of_test(path) == kind
    done = succeed("material", "read", path, "--deformation", "tension", "--json")
    (found,) = json.loads(done.stdout)["tests"]
    assert (found["test"], found["deformation"]) == (kind, "tension")
    assert found["points"] == len(SAMPLES[kind]) - 1
    done = succeed("material", "read", path, "--deformation", "tension")


def test_files_are_sorted_by_kind(tmp_path: Path) -> None:
    paths = [written(tmp_path, kind) for kind in SAMPLES]
    assert by_kind(paths) == {kind: [path] for kind, path in zip(SAMPLES, paths, strict=True)}


def test_one_frequency_in_each_file_makes_sweeps_together(tmp_path: Path) -> None:
    rubber, paths = vf.synthetic_fluoroelastomer(), []
    for hertz in (0.1, 0.3, 1.0, 3.0, 10.0):
        moduli = {T: 1e-6 * rubber.complex_modulus(2.0 * np.pi * hertz, T + 273.15) for T in range(0, 60, 10)}
        rows = [f"{T},{hertz},{E.real},{E.imag}" for T, E in moduli.items()]
        paths.append(tmp_path / f"{hertz}.csv")
        paths[-1].write_text("\n".join([DMA, *rows]) + "\n", encoding="utf-8")
    assert kind_of_test(paths[0]) == "ramps"
    assert by_kind(paths) == {"dma": paths}


def test_a_modulus_of_unknown_kind_beside_a_frequency_is_no_relaxation(tmp_path: Path) -> None:
    path = tmp_path / "sweep.txt"
    path.write_text(
        "Time (min)\tTemp. (°C)\tFreq (Hz)\tModulus (Pa)\tTan Delta\n1\t20\t1\t5e6\t0.1\n", encoding="utf-8"
    )
    with pytest.raises(DataFileError) as caught:
        kind_of_test(path)
    assert caught.value.code == "missing-columns"


def test_sweeps_at_many_temperatures_with_one_given_are_no_ramps(tmp_path: Path) -> None:
    path = tmp_path / "sweeps.csv"
    rows = [f"{T},{f},{10.0 + f},1" for T in range(20, 90, 3) for f in (1, 2, 5, 10)]
    path.write_text("\n".join(["T (degC),f (Hz),E' (MPa),E'' (MPa)", *rows]), encoding="utf-8")
    assert kind_of_test(path) == "dma"
    with refused("temperature-not-needed"):
        kind_of_test(path, temperature="30 degC")


def test_what_is_no_test_has_the_error_of_sweeps(tmp_path: Path) -> None:
    path = tmp_path / "alpha.csv"
    path.write_text("T_C,log10_aT\n1,2\n3,0\n", encoding="utf-8")
    with refused("missing-columns", DataFileError) as caught:
        kind_of_test(path)
    assert caught.value.note.values["key"] == "material.columns"
    path.write_text("t (s),strain (%),T (degC)\n" + "".join(f"{t},1,20\n" for t in range(1, 9)), encoding="utf-8")
    with refused("no-kind", DataFileError):
        kind_of_test(path)


def test_units_are_asked_for_by_the_key_of_the_run_file(tmp_path: Path) -> None:
    path = tmp_path / "creep.csv"
    path.write_text("\n".join(SAMPLES["creep"]).replace(" (1/MPa)", ""), encoding="utf-8")
    assert kind_of_test(path) == "creep"
    with refused("no-unit", DataFileError) as caught:
        vf.read_step_tests(path, deformation="tension")
    assert caught.value.field == "material.modulus_unit"


def test_genuine_files_are_recognised(real_data: Path) -> None:
    assert by_kind(sorted((real_data / "creep").iterdir())) == {"creep": sorted((real_data / "creep").iterdir())}
    assert kind_of_test(real_data / "instruments" / "trios" / "creep_experiment.txt") == "creep"
    assert kind_of_test(real_data / "dma" / "acrylic_468mp.csv") == "dma"
