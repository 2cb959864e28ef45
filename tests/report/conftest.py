"""A study's results made of plain formulas, no solver involved: what the report is tested on."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from viscofric import report
from viscofric.report.figures import saving
from viscofric.report.figures import study as drawing
from viscofric.rheology.cards.native import plain
from viscofric.rheology.shifts.laws import WLF

REFERENCE = 303.15  # K
C1, C2 = 10.04, 89.6  # WLF at the reference; K
ZERO = 273.15
RUN_FILE = 'title = "A rubber of formulas"\ndata_origin = "synthetic"\n[material]\ndma = "sweeps.csv"\n'


def log10_alpha(temperature: Any) -> Any:
    above = np.asarray(temperature) - REFERENCE
    return -C1 * above / (C2 + above)


def modulus(frequency: Any) -> Any:
    """Complex modulus of formulas, Pa: a plateau, a glass and a power law between."""
    return 3e6 * (1 + (1j * frequency / 10) ** 0.2) + 1.5e9 / (1 + 5e6 / (1j * frequency) ** 0.9)


def dataset(dim: str, columns: dict[str, tuple[Any, str, str]], attrs: dict[str, Any] | None = None) -> xr.Dataset:
    data = {
        name: (dim, np.atleast_1d(np.asarray(value)), {"units": unit, "long_name": long_name})
        for name, (value, unit, long_name) in columns.items()
    }
    return xr.Dataset(data, attrs=attrs)


def _dma() -> dict[str, xr.Dataset]:
    temperature, frequency = np.meshgrid(np.arange(-30.0, 101.0, 10.0) + ZERO, np.geomspace(0.63, 63, 9), indexing="ij")
    temperature, frequency = temperature.ravel(), frequency.ravel()
    rng = np.random.default_rng(1)
    E = modulus(10 ** log10_alpha(temperature) * frequency)
    storage, loss = E.real * rng.normal(1, 0.01, E.shape), E.imag * rng.normal(1, 0.01, E.shape)
    steps = np.unique(temperature)
    reduced = np.sort(10 ** log10_alpha(temperature) * frequency)
    order = np.argsort(10 ** log10_alpha(temperature) * frequency)
    wide = np.geomspace(reduced[0] / 30, reduced[-1] * 30, 200)
    moduli = {
        "storage_modulus": (storage, "Pa", "storage modulus"),
        "loss_modulus": (loss, "Pa", "loss modulus"),
    }
    moduli_in_order = {name: (value[order], unit, text) for name, (value, unit, text) in moduli.items()}
    factors = dataset(
        "temperature",
        {
            "log10_shift_factor": (
                np.where(steps < 250, 0.8, 1) * log10_alpha(steps),
                "1",
                "decadic logarithm of the shift factor",
            ),
            "standard_error": (0.002 * np.abs(steps - REFERENCE), "1", "standard error of log10 α"),
        },
        {
            "reference_temperature": REFERENCE,
            "shift_used": "measured",
            "isotherms_given": 14,
            "isotherms_used": 14,
            "temperatures_given": json.dumps(steps.tolist()),
            "overlap_rms_log10_storage": 0.0061,
            "overlap_rms_log10_loss": 0.0083,
            "overlap_holds": 1,
            "overlap_limit": 0.05,
        },
    ).assign_coords(temperature=("temperature", steps, {"units": "K", "long_name": "temperature"}))
    return {
        "isotherms": dataset(
            "reading",
            {
                "temperature": (temperature, "K", "temperature"),
                "angular_frequency": (frequency, "rad/s", "angular frequency"),
                **moduli,
            },
        ),
        "shift_factors": factors,
        "shift_law": dataset(
            "temperature",
            {
                "log10_shift_factor": (log10_alpha(steps), "1", "decadic logarithm of the shift factor"),
                "standard_error": (0.001 * np.abs(steps - REFERENCE), "1", "standard error of log10 α"),
            },
            {
                "law": "WLF",
                "rms": 0.31,
                "misfit_holds": 0,
                "misfit_limit": 0.1,
                "constants": json.dumps(plain(WLF(C1, C2, REFERENCE))),
                "wlf_C1": C1,
                "wlf_C2": C2,
                "wlf_C1_error": 0.05,
                "wlf_C2_error": 0.6,
            },
        ).assign_coords(temperature=("temperature", steps, {"units": "K", "long_name": "temperature"})),
        "master_curve": dataset(
            "reading",
            {
                "angular_frequency": (reduced, "rad/s", "reduced angular frequency"),
                **moduli_in_order,
                "temperature": (temperature[order], "K", "temperature of origin"),
                "fitted_storage_modulus": (modulus(reduced).real, "Pa", "fitted storage modulus"),
                "fitted_loss_modulus": (modulus(reduced).imag, "Pa", "fitted loss modulus"),
            },
            {"rms_log10_storage": 0.0052, "rms_log10_loss": 0.0071, "misfit_holds": 1, "misfit_limit": 0.05},
        ),
        "spectrum_curve": dataset(
            "angular_frequency",
            {
                "storage_modulus": (modulus(wide).real, "Pa", "storage modulus"),
                "loss_modulus": (modulus(wide).imag, "Pa", "loss modulus"),
            },
        ).assign_coords(angular_frequency=("angular_frequency", wide, {"units": "rad/s"})),
        "spectrum": dataset(
            "mode",
            {
                "retardation_time": (np.exp(np.arange(-8.0, 9.0)), "s", "retardation time"),
                "creep_coefficient": (1.37e-8 / (1 + np.arange(-8.0, 9.0) ** 2), "1/Pa", "creep coefficient"),
            },
            {
                "E0": 3.021e6,
                "E_inf": 1.507e9,
                "E0_remark": "extrapolated: beyond what was measured",
                "E_inf_remark": "reached by the measurement",
                "E_inf_at_limit": 0,
                "statements": json.dumps(["E0 lies below what the sweeps reach & is extrapolated."]),
            },
        ),
    }


def friction(reduced_speed: Any) -> Any:
    return 0.005 + 0.03 / (1 + (np.log10(reduced_speed) + 4) ** 2)


def prediction(speed: Any, temperature: Any, mu: Any) -> xr.Dataset:
    size = np.shape(speed)
    return dataset(
        "case",
        {
            "speed": (speed, "m/s", "speed"),
            "temperature": (temperature, "K", "temperature"),
            "load": (np.full(size, 25.0), "N", "normal load"),
            "friction_coefficient": (mu, "1", "viscoelastic friction coefficient"),
            "friction_error": (4e-4 * mu, "1", "numerical error"),
            "indentation": (0.61e-3 + 0.1 * mu * 1e-3, "m", "indentation"),
            "contact_area": (np.full(size, 1.57e-5), "m**2", "contact area"),
            "front": (np.full(size, 2.31e-3), "m", "front"),
            "rear": (np.full(size, 2.12e-3), "m", "rear"),
            "half_width": (np.full(size, 2.24e-3), "m", "half width"),
            "max_pressure": (2.3e6 + 1e6 * mu, "Pa", "largest pressure"),
            "energy_balance": (-3.1e-4 * np.ones(size), "1", "energy balance"),
            "complementarity": (4.2e-10 * np.ones(size), "1", "complementarity"),
            "cells": (np.full(size, 256), "1", "cells"),
            "products": (np.full(size, 83), "1", "products"),
            "within_measured_frequencies": (np.ones(size, dtype=int), "1", "within the measured frequencies"),
        },
    )


def over_axes(cases: xr.Dataset, axes: dict[str, Any]) -> xr.Dataset:
    """Return cases along `case`, the last axis running fastest, over their axes; the load is one for all."""
    shape = tuple(len(points) for points in axes.values())
    over = {name: (tuple(axes), part.values.reshape(shape), part.attrs) for name, part in cases.data_vars.items()}
    coordinates = {name: (name, points, cases[name].attrs) for name, points in axes.items()}
    numbers = {name: part for name, part in over.items() if name not in ("load", *axes)}
    return xr.Dataset(numbers, {**coordinates, "load": ((), 25.0, cases["load"].attrs)}).squeeze()


def _measured() -> dict[str, xr.Dataset]:
    temperature, speed = np.meshgrid(np.array([30.0, 60.0, 90.0]) + ZERO, np.geomspace(0.02, 0.2, 6), indexing="ij")
    temperature, speed = temperature.ravel(), speed.ravel()
    reduced = 10 ** log10_alpha(temperature) * speed
    mu = friction(reduced)
    found = mu * np.random.default_rng(2).normal(1, 0.03, mu.shape)
    flat = np.ones(mu.shape)
    measurement = dataset(
        "point",
        {
            "speed": (speed, "m/s", "speed"),
            "temperature": (temperature, "K", "temperature"),
            "load": (25.03 * flat, "N", "load"),
            "replicates": (np.full(mu.shape, 8), "1", "replicates"),
            "viscoelastic": (found, "1", "viscoelastic friction"),
            "viscoelastic_error": (0.05 * mu / 8**0.5, "1", "standard error"),
            "viscoelastic_scatter": (0.05 * mu, "1", "scatter"),
            "coulomb": (0.42 * flat, "1", "Coulomb friction"),
            "coulomb_error": (0.002 * flat, "1", "standard error"),
            "coulomb_scatter": (0.006 * flat, "1", "scatter"),
            "consistency": (1.1e-4 * flat, "1", "consistency"),
            "consistency_error": (2e-4 * flat, "1", "its error"),
            "reduced_speed": (reduced, "m/s", "reduced speed"),
            "predicted": (mu, "1", "predicted"),
            "predicted_error": (4e-4 * mu, "1", "error"),
            "within_measured_frequencies": (np.ones(mu.shape, dtype=int), "1", "within the measured frequencies"),
        },
    )
    agreement = dataset(
        "temperature",
        {
            "bias": ([0.011, -0.012, 0.013], "1", "mean relative difference, measured less predicted"),
            "rms": ([0.031, 0.032, 0.033], "1", "root mean square relative difference"),
            "share_within_error": ([1.0, 0.8333, 0.6667], "1", "share of points within twice the standard error"),
            "points": ([6, 6, 6], "1", "points"),
        },
        {"bias": 0.0041, "rms": 0.0322, "share_within_error": 0.8333, "points": 18, "left_out": 0},
    ).assign_coords(temperature=("temperature", np.array([30.0, 60.0, 90.0]) + ZERO, {"units": "K"}))
    return {"measurement": measurement, "agreement": agreement}


@pytest.fixture(scope="session")
def make_tree() -> Callable[..., xr.DataTree]:
    """Return a maker of results: with or without measurement, of any size, with any root attributes."""

    def make(measurement: bool = True, speeds: int = 7, temperatures: int = 3, **attrs: Any) -> xr.DataTree:
        axes = {"temperature": np.linspace(30.0, 90.0, temperatures) + ZERO, "speed": np.geomspace(0.02, 0.2, speeds)}
        temperature, speed = (one.ravel() for one in np.meshgrid(*axes.values(), indexing="ij"))
        groups = _dma()
        groups["prediction"] = over_axes(
            prediction(speed, temperature, friction(10 ** log10_alpha(temperature) * speed)), axes
        )
        reduced = np.geomspace(1e-7, 1.0, 41)
        groups["prediction_master"] = prediction(reduced, np.full(41, REFERENCE), friction(reduced))
        if measurement:
            groups |= _measured()
        root = {
            "title": "A rubber of formulas", "data_origin": "synthetic", "viscofric_version": "0.1.0",
            "created": "2026-11-21T12:00:00+00:00", "study_file": "study.toml", "study_text": RUN_FILE,
            "input_hashes": json.dumps({"sweeps.csv": "ab" * 32, "runs.csv": "cd" * 32}),
            "software": json.dumps({"python": "3.11.2", "numpy": "2.1.0"}),
            "notes": json.dumps(["sweeps.csv: 2 rows with a temperature of −999 °C were left out."]),
            "warnings": json.dumps(["The contact's half-width is 0.31 of the ball's radius."]),
            "failures": "[]", "deformation": "tension", "poisson_ratio": 0.5,
            "indenter": "ball of radius 9.525 mm", "indenter_radius": 9.525e-3,
            "frequency_range": np.array([1e-4, 1e6]), "load": 25.0, "accuracy": 1e-3, **attrs,
        }  # fmt: skip
        return xr.DataTree.from_dict({"/": xr.Dataset(attrs=root), **groups})

    return make


@pytest.fixture
def axes() -> Axes:
    return Figure().subplots()


@pytest.fixture
def unrendered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let figures be drawn, but not turned into images, which takes a hundred times as long; each is its own text."""

    def words(figure: Figure, form: str) -> bytes:
        texts = [text.get_text() for text in figure.findobj(Text)]
        points = [line.get_xydata() for line in figure.findobj(Line2D)]
        points += [np.asarray(markers.get_offsets()) for markers in figure.findobj(PathCollection)]
        return f"{form} {texts} {[array.tolist() for array in points]}".encode()

    monkeypatch.setattr(saving, "_encoded", words)


#: Of lines and points, of colours, and of moduli: the figures whose images are looked at.
RENDERED = ("friction_against_speed", "friction_map", "isotherms")


@pytest.fixture(scope="session")
def rendered(
    make_tree: Callable[..., xr.DataTree], tmp_path_factory: pytest.TempPathFactory
) -> tuple[list[Path], Path]:
    """Return the files of three figures of the usual results, and their report, as users get them; drawn once."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("FRICTION_FIGURES", "RUBBER_FIGURES"):
            figures = getattr(drawing, name)
            patch.setattr(drawing, name, {one: figures[one] for one in RENDERED if one in figures})
        return report.write_figures_and_report(make_tree(), tmp_path_factory.mktemp("rendered") / "new")


@pytest.fixture
def few_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw one figure of friction and one of the rubber, where it does not matter which."""
    for name in ("FRICTION_FIGURES", "RUBBER_FIGURES"):
        monkeypatch.setattr(drawing, name, dict(list(getattr(drawing, name).items())[:1]))


@pytest.fixture
def tree(make_tree: Callable[..., xr.DataTree]) -> xr.DataTree:
    """Return the usual results: three temperatures, with a measurement."""
    return make_tree()


UNITS = {"speed": "m/s", "temperature": "K", "load": "N", "radius": "m", "thickness": "m", "material": "1"}


@pytest.fixture
def make_sweep() -> Callable[..., xr.Dataset]:
    """Return a maker of labelled friction over any axes, from a formula with a maximum along the speed."""

    def make(axes: dict[str, Any], failed: tuple[int, ...] = (), **scalars: Any) -> xr.Dataset:
        grid = {
            name: np.asarray(
                np.arange(len(points)) if isinstance(points[0], str) else points, dtype=float
            ).reshape([-1 if place == index else 1 for index in range(len(axes))])
            for place, (name, points) in enumerate(axes.items())
        }  # fmt: skip
        speed, kelvin = grid.get("speed", 0.1), grid.get("temperature", REFERENCE)
        place = np.log10(speed) + log10_alpha(kelvin) + 3.0 + 0.5 * grid.get("material", 0.0)
        size = (grid.get("load", 25.0) / 25.0) ** (1 / 3) * (0.01 / grid.get("radius", 0.01)) ** (2 / 3)
        mu = (0.005 + 0.03 / (1.0 + place**2)) * size * (1.0 + 0.01 * grid.get("sample", 0.0))
        mu = np.broadcast_to(mu, [len(points) for points in axes.values()]).copy()
        mu.ravel()[list(failed)] = np.nan
        flat = np.isnan(mu)
        columns = {"friction_coefficient": mu, "friction_error": 4e-4 * mu, "cells": np.where(flat, np.nan, 256.0)}
        columns |= {"failed": flat.astype(float), "interpolated": (np.arange(mu.size) % 2.0).reshape(mu.shape)}
        coordinates = {name: (name, points, {"units": UNITS.get(name, "1")}) for name, points in axes.items()}
        coordinates |= {name: ((), value, {"units": UNITS.get(name, "1")}) for name, value in scalars.items()}
        return xr.Dataset({name: (tuple(axes), values) for name, values in columns.items()}, coordinates)

    return make


@pytest.fixture
def make_study(
    make_tree: Callable[..., xr.DataTree], make_sweep: Callable[..., xr.Dataset]
) -> Callable[..., xr.DataTree]:
    """Return a maker of results with friction over any axes."""

    def make(axes: dict[str, Any], failed: tuple[int, ...] = (), **attrs: Any) -> xr.DataTree:
        tree = make_tree(measurement=False, data_origin="measured", **attrs)
        scalars = {"load": 25.0, "temperature": 303.15, "speed": 0.1}
        scalars = {name: value for name, value in scalars.items() if name not in axes}
        friction = make_sweep(
            axes or {"speed": [0.1]}, failed, **{k: v for k, v in scalars.items() if k != "speed" or axes}
        )
        tree["prediction"] = xr.DataTree(friction if axes else friction.isel(speed=0))
        return tree

    return make
