"""The data sets of a material of a study: measured points, shift factors, master curve, spectrum."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from viscofric.datasets import Dataset
from viscofric.rheology.shifts.parametric_law import law_misfit
from viscofric.rheology.shifts.vertical_shift import with_vertical_shift
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.superposition.joint import of_all_kinds
from viscofric.rheology.superposition.result import PER_DECADE, StepSuperposition, Superposition
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.step_tests import StepMasterCurve, StepTests
from viscofric.study.rubber import Rubber


def rubber_groups(rubber: Rubber, samples: MaterialSamples | None = None) -> dict[str, Dataset]:
    """Return the data sets of a material; `samples` give the bands of its moduli."""
    groups: dict[str, Dataset] = {}
    fit, spectrum = rubber.fit, rubber.material.spectrum
    if fit is not None and rubber.sweeps is not None:
        isotherms = rubber.sweeps.in_tension(rubber.material.poisson_ratio).to_dataset()
        groups["/isotherms"] = isotherms.drop_attrs(deep=False).drop_vars("strain_amplitude", errors="ignore")
        groups["/shift_factors"] = _factors(rubber, fit, rubber.sweeps.temperatures)
        groups["/superposition"] = fit.check.to_dataset()
    if rubber.step_curve is not None and rubber.step_tests is not None:
        groups = _step_groups(rubber, rubber.step_tests, rubber.step_curve) | groups
    if rubber.ramps is not None:
        groups["/ramps"] = rubber.ramps.to_dataset()
    if rubber.payne is not None:
        groups["/amplitude_sweep"] = rubber.payne.to_dataset()
    curve, fitted = rubber.master_curve if fit is None else fit.master_curve, _fitted(rubber)
    if curve is not None and isinstance(fitted, RetardationSpectrum) and fitted.fit is not None:
        groups["/master_curve"] = fitted.master_curve_dataset(curve)
    elif curve is not None:  # of a liquid, which has no spectrum
        groups["/master_curve"] = curve.to_dataset()
    if rubber.laws is not None:
        groups["/laws"] = rubber.laws.to_dataset()
    if rubber.law is not None:
        groups["/shift_law"] = _shift_law(rubber)
    if isinstance(spectrum, RetardationSpectrum):
        wide = _wide(spectrum)
        groups["/spectrum"] = spectrum.to_dataset()
        moduli = spectrum.modulus_dataset(wide)
        groups["/spectrum_curve"] = moduli if samples is None else moduli.assign(samples.to_dataset(wide).data_vars)
    for data in groups.values():
        if "source" in data.attrs:  # results are passed on, and say nothing of the folders of one machine
            data.attrs["source"] = Path(str(data.attrs["source"])).name
    return groups


def _fitted(rubber: Rubber) -> RetardationSpectrum | ModulusTable:
    """Return the spectrum that was fitted, at small strain."""
    return (rubber.linear or rubber.material).spectrum


def _step_groups(rubber: Rubber, tests: StepTests, curve: StepMasterCurve) -> dict[str, Dataset]:
    """Return the data sets of creep or relaxation tests: tensile points, master curve, shift factors and check."""
    used = tests.in_tension(rubber.material.poisson_ratio).thinned(PER_DECADE)
    spectrum, fit = _fitted(rubber), rubber.step_fit
    superposed = {}
    if fit is not None:
        superposed["/shift_factors"] = _factors(rubber, fit, tests.temperatures)
        superposed["/superposition"] = fit.check.to_dataset()
    return {
        "/step_tests": used.to_dataset(),
        **superposed,
        "/step_master_curve": spectrum.step_curve_dataset(curve)
        if isinstance(spectrum, RetardationSpectrum)
        else curve.to_dataset(),
    }


def _factors(rubber: Rubber, fit: Superposition | StepSuperposition, temperatures: Any) -> Dataset:
    """Return shift factors, of all tests where there are several kinds, with the overlap of one kind."""
    found = fit.to_dataset()
    if (joint := rubber.joint) is not None:
        common = with_vertical_shift(joint.to_dataset(), joint.vertical_shift, joint.shift_factors.temperatures)
        found = common.assign_attrs(found.attrs | {"isotherms_used": len(joint.shift_factors.temperatures)})
        assert rubber.sweeps is not None
        assert rubber.step_tests is not None
        temperatures = of_all_kinds([rubber.sweeps.temperatures, rubber.step_tests.temperatures])
    given = np.unique(temperatures)
    return found.assign_attrs(
        shift_used=rubber.shift_used,
        shift_origin=rubber.shift_origin,
        isotherms_given=len(given),
        temperatures_given=json.dumps(given.tolist()),
    )


def _shift_law(rubber: Rubber) -> Dataset:
    """Return the law over the temperatures that it was fitted to, or 50 K about its reference."""
    law = rubber.law
    assert law is not None
    ends = law.fitted_range or (law.reference - 50.0, law.reference + 50.0)
    misfit: dict[str, float] = {}
    if (fit := rubber.superposed) is not None:
        factors = fit.shift_factors
        ends = float(factors.temperatures[0]), float(factors.temperatures[-1])
        misfit = law_misfit(law, factors.temperatures, factors.log10_values)
    kelvin = np.linspace(max(ends[0], law.extrapolation_limits[0] + 1.0), ends[1], 201)
    return law.to_dataset(kelvin).assign_attrs(misfit)


def _wide(spectrum: RetardationSpectrum) -> Any:
    """Return angular frequencies to two decades beyond the measured ones, or beyond the modes."""
    low, high = (1.0 / spectrum.tau.max(), 1.0 / spectrum.tau.min()) if len(spectrum) else (1.0, 1.0)
    if spectrum.fit is not None:
        low, high = spectrum.fit.frequency_range
    return np.geomspace(low / 100.0, high * 100.0, 600)
