"""Labelled data sets carry units and names, and become JSON without a NaN."""

import json

import numpy as np

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
