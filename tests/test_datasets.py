"""Labelled data sets carry units and names, and become JSON without a NaN."""

import json

import numpy as np

import viscofric as vf
from viscofric.datasets import dataset, record

FACTORS = dataset(
    "temperature",
    {
        "log10_shift_factor": (np.array([1.5, np.nan]), "1", "decadic logarithm of the shift factor"),
        "standard_error": None,
    },
    coordinates={"temperature": ([293.15, 313.15], "K", "temperature")},
    attributes={"reference_temperature": 313.15, "law": None},
)


def test_a_data_set_carries_units_and_leaves_out_what_is_none():
    assert list(FACTORS.data_vars) == ["log10_shift_factor"]
    assert FACTORS["temperature"].attrs == {"units": "K", "long_name": "temperature"}
    assert FACTORS.attrs == {"reference_temperature": 313.15}


def test_a_record_is_json_with_units_and_null_for_nan():
    found = record(FACTORS)
    assert json.loads(json.dumps(found, allow_nan=False)) == {
        "reference_temperature": 313.15,
        "log10_shift_factor": [1.5, None],
        "temperature": [293.15, 313.15],
        "units": {"log10_shift_factor": "1", "temperature": "K"},
    }


def test_sweeps_become_one_row_per_reading_named_as_in_the_results_of_studies():
    cold = vf.Isotherm(280.0, [1.0, 10.0], [2e6, 3e6], [2e5, 3e5])
    warm = vf.Isotherm(300.0, [1.0], [1e6], [1e5], strain_amplitude=[1e-3])
    found = vf.IsothermalSweeps((warm, cold), deformation="shear", source="dma.csv").to_dataset()
    assert found["temperature"].values.tolist() == [280.0, 280.0, 300.0]
    assert found["storage_modulus"].values.tolist() == [2e6, 3e6, 1e6]
    np.testing.assert_array_equal(found["strain_amplitude"], [np.nan, np.nan, 1e-3])
    assert found.attrs == {"deformation": "shear", "source": "dma.csv", "format": ""}
    for name, unit in (("temperature", "K"), ("angular_frequency", "rad/s"), ("storage_modulus", "Pa")):
        assert found[name].attrs == {"units": unit, "long_name": name.replace("_", " ")}
    assert "strain_amplitude" not in vf.IsothermalSweeps((cold,)).to_dataset()
    assert vf.IsothermalSweeps(()).to_dataset().sizes == {"reading": 0}


def test_a_master_curve_carries_its_reference_temperature():
    curve = vf.MasterCurve([0.1, 10.0], [3e6, 4e6], [3e5, 6e5], [303.15, 300.0], 303.15)
    found = curve.to_dataset()
    assert list(found.data_vars) == ["temperature", "angular_frequency", "storage_modulus", "loss_modulus"]
    assert found["loss_modulus"].attrs == {"units": "Pa", "long_name": "loss modulus"}
    assert found["temperature"].values.tolist() == [303.15, 300.0]
    assert found.attrs == {"reference_temperature": 303.15}


def test_traction_runs_leave_out_what_was_not_recorded():
    runs = vf.TractionRuns([0.1, 0.1], [0.15, 0.05], [1.0, 2.0], [25.0, 25.0], [303.15, 303.15], [1, 1], step=[1, 2])
    found = runs.to_dataset()
    names = ["disc_speed", "ball_speed", "traction_force", "load", "temperature", "replicate", "step"]
    assert list(found.data_vars) == names
    assert found["traction_force"].attrs["units"] == "N"
    assert found["step"].values.tolist() == [1, 2]
