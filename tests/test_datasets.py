"""Labelled data sets carry units and names, and become JSON without a NaN."""

import functools
import inspect
import json

import numpy as np
import pytest

import viscofric as vf
from test_docstrings import PUBLIC
from viscofric.contact.indenters.indenter import Indenter
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
    curve = vf.readers.MasterCurve([0.1, 10.0], [3e6, 4e6], [3e5, 6e5], [303.15, 300.0], 303.15)
    found = curve.to_dataset()
    assert list(found.data_vars) == ["temperature", "angular_frequency", "storage_modulus", "loss_modulus"]
    assert found["loss_modulus"].attrs == {"units": "Pa", "long_name": "loss modulus"}
    assert found["temperature"].values.tolist() == [303.15, 300.0]
    assert found.attrs == {"reference_temperature": 303.15}


def test_traction_runs_leave_out_what_was_not_recorded():
    runs = vf.readers.TractionRuns(
        [0.1, 0.1], [0.15, 0.05], [1.0, 2.0], [25.0, 25.0], [303.15, 303.15], [1, 1], step=[1, 2]
    )
    found = runs.to_dataset()
    names = ["disc_speed", "ball_speed", "traction_force", "load", "temperature", "replicate", "step"]
    assert list(found.data_vars) == names
    assert found["traction_force"].attrs["units"] == "N"
    assert found["step"].values.tolist() == [1, 2]


#: Classes that are no results: what users put in, settings, texts, and trees of data sets.
INPUTS = {
    "Backend",
    "CatalogueEntry",
    "Card",
    "Citations",
    "ContactAnchor",
    "History",
    "Layer",
    "ModulusAnchor",
}
INPUTS |= {"Heating", "MovingHeatSource", "PeriodicSurface", "Study", "ThermalProperties"}
#: Parts of results, whose numbers lie in the data set of the whole.
PARTS = {
    "Diagnostics": "ContactSolution",
    "ImpactContact": "ImpactSolution",
    "PeriodicDiagnostics": "PeriodicSolution",
    "StepTest": "StepTests",
    "TractionStep": "TractionRuns",
    "TransientErrors": "TransientSolution",
}


def test_every_public_result_has_a_data_set():
    classes = {name: found for name, found in PUBLIC.items() if inspect.isclass(found)}
    results = {name for name, found in classes.items() if not issubclass(found, (Exception, Indenter))}
    without = {name for name in results if not hasattr(classes[name], "to_dataset")}
    assert without == INPUTS | PARTS.keys()
    assert all(hasattr(classes[whole], "to_dataset") for whole in PARTS.values())


@functools.cache
def small_results():
    """Results that are quickly made, without their own tests of data sets."""
    kelvin = np.arange(253.0, 323.0, 2.0)
    rubber = vf.synthetic_fluoroelastomer()
    modulus = rubber.spectrum.complex_modulus(2.0 * np.pi * rubber.shift(kelvin))
    ramp = vf.readers.TemperatureRamp("1 Hz", kelvin, modulus.real, modulus.imag)
    law = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear")
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    contact = {"speed": "1 m/s", "load": "100 N/m", "measured_at": 1e-3, "accuracy": 0.1}
    return {
        "isotherm": vf.Isotherm(280.0, [1.0, 10.0], [2e6, 3e6], [2e5, 3e5], strain_amplitude=[1e-3, 1e-3]),
        "ramp": ramp,
        "peak": vf.rheology.glass_transition(ramp, "loss modulus"),
        "ramp check": vf.rheology.RampCheck(0.01, 0.005, (0.001, -0.002)),
        "overlap": vf.rheology.OverlapQuality(0.01, 0.02, 5, 2, (1,)),
        "fit": vf.rheology.SpectrumFit(
            0.01, None, True, False, (1.0, 1e3), method="sparse", measured_storage=(1e6, 1e9)
        ),
        "law": law,
        "range": vf.rheology.LinearRange(0.05, 0.01, 1e-4),
        "at strain": vf.friction.solve_at_contact_strain(solid, law, vf.Cylinder("10 mm"), **contact),
    }


def test_each_number_of_a_result_has_unit_and_name_and_is_json():
    for name, result in small_results().items():
        found = result.to_dataset()
        assert found.data_vars, name
        for number in found.variables.values():
            assert number.attrs["units"], name
            assert number.attrs["long_name"], name
        json.dumps(record(found), allow_nan=False)


def test_data_sets_of_small_results_hold_their_numbers():
    found = {name: result.to_dataset() for name, result in small_results().items()}
    assert found["isotherm"]["loss_tangent"].values.tolist() == [0.1, 0.1]
    assert found["isotherm"].attrs == {"temperature": 280.0}
    assert found["peak"]["height"].attrs["units"] == "Pa"
    assert float(found["peak"]["temperature"]) == pytest.approx(260.25, abs=1.0)  # K, as the example of the docs
    assert found["ramp check"]["offset"].values.tolist() == [0.001, -0.002]
    assert found["ramp check"].attrs["holds"] == 1
    assert int(found["overlap"]["neighbours_without_overlap"]) == 1
    assert found["fit"]["frequency_range"].values.tolist() == [1.0, 1e3]
    assert "rms_log10_loss" not in found["fit"]
    half = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear").to_dataset([0.0, 0.02])
    np.testing.assert_allclose(half["storage_modulus"], [6e6, 3.75e6])
    assert (half.attrs["critical_strain"], half.attrs["deformation"]) == (0.02, "shear")
    both = found["at strain"]["friction_coefficient"]
    assert both.dims == ("moduli",)
    assert both.attrs["units"] == "1"
    assert float(both[1]) != float(both[0]) > 0.0
