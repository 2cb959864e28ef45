"""hermes-rheo: its master curve, its Maxwell modes, and pyReSpect as it ships it (pyReSpect is not on PyPI)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from exchange import Sweep, main, master_curve, sweeps, timed
from hermes_rheo._vendor.pyrespect_freq import ReSpect, ReSpectConfig
from hermes_rheo.transforms.automated_mastercurve import AutomatedMasterCurve
from hermes_rheo.transforms.fit_model import MultiModeMaxwellModel
from piblin.data import Measurement, MeasurementSet
from piblin.data.datasets.abc.split_datasets.one_dimensional_composite_dataset import OneDimensionalCompositeDataset


def _measurement(sweep: Sweep) -> Measurement:
    temperature = np.full(sweep.angular_frequency.shape, sweep.temperature)
    dataset = OneDimensionalCompositeDataset(
        data_arrays=[sweep.angular_frequency, sweep.storage, sweep.loss, temperature],
        data_array_names=["angular frequency", "storage modulus", "loss modulus", "temperature"],
        data_array_units=["rad/s", "Pa", "Pa", "°C"],
        default_independent_name="angular frequency",
        default_dependent_name="storage modulus",
        source="sweeps",
    )
    return Measurement(datasets=[dataset], conditions={"temperature": sweep.temperature}, details={})


def shift_factors(path: Path) -> dict[str, Any]:
    given = sweeps(path)
    measurements = MeasurementSet([_measurement(sweep) for sweep in given])
    temperatures = np.array([sweep.temperature for sweep in given])
    reference = int(np.argmin(np.abs(temperatures - 20.0)))
    made, seconds = timed(lambda: AutomatedMasterCurve(state="temperature").apply_to(measurements))
    log10 = np.log10(np.array(made.master_curve.hparams[0], dtype=float))
    return {"log10": log10 - log10[reference], "seconds": seconds}


def _maxwell(path: Path, modes: int) -> dict[str, Any]:
    omega, storage, loss = master_curve(path)
    model, seconds = timed(
        lambda: MultiModeMaxwellModel(n_modes=modes, equilibrium_modulus=True).fit(omega, storage, loss)
    )
    return {
        "E0": model.equilibrium_modulus_value,
        "E": model.G_modes,
        "tau": model.tau_modes,
        "seconds": seconds,
    }


def pyrespect(path: Path) -> dict[str, Any]:
    data = master_curve(path)
    solver, seconds = timed(lambda: ReSpect(ReSpectConfig(plateau=True)).fit(data))
    found = solver.discrete
    return {"E0": float(found.G0), "E": found.g, "tau": found.tau, "seconds": seconds}


if __name__ == "__main__":
    main(
        {
            "shift": shift_factors,
            "spectrum, 16 modes": lambda path: _maxwell(path, 16),
            "spectrum, 30 modes": lambda path: _maxwell(path, 30),
            "pyrespect": pyrespect,
        }
    )
