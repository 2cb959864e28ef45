"""What a mechanical test holds, in lines and in plain types."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.notes import listed
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from viscofric.amplitudes import AmplitudeSweep
    from viscofric.data import IsothermalSweeps
    from viscofric.ramps import TemperatureRamps
    from viscofric.readers.recognise import TestKind
    from viscofric.step_tests import StepTests


def read_kind(kind: TestKind, files: Sequence[Path], reading: dict[str, Any]) -> Any:
    """Return the test of a kind in files, with the options of `reading_options`."""
    from viscofric.readers.dma.amplitudes import read_amplitude_sweep
    from viscofric.readers.dma.ramps import read_ramps
    from viscofric.readers.dma.read import read_dma
    from viscofric.readers.steps.read import read_step_tests

    chosen = {name: value for name, value in reading.items() if value}
    temperature = chosen.pop("temperature", None)
    if kind in ("creep", "relaxation"):
        unit = {"response_unit": chosen.pop("modulus_unit")} if "modulus_unit" in chosen else {}
        return read_step_tests(*files, kind=kind, temperature=temperature, **unit, **chosen)
    if kind == "ramps":
        return read_ramps(*files, **chosen)
    if kind == "amplitude":
        return read_amplitude_sweep(*files, temperature=temperature, **chosen)
    return read_dma(*files, temperature=temperature, **chosen)


def described(kind: TestKind, test: Any, files: Iterable[str]) -> tuple[dict[str, Any], list[str]]:
    """Return a test as a record in SI units, and in lines."""
    columns, rows = _CONTENT[kind](test)
    found: dict[str, Any] = {
        "test": kind,
        "files": [*files],
        "format": test.format,
        "deformation": test.deformation,
        "points": sum(row["points"] for row in rows),
        _ROWS[kind]: rows,
        **listed("notes", test.notes),
    }
    what = "moduli" if kind not in ("creep", "relaxation") else "responses"
    count = "an amplitude sweep" if kind == "amplitude" else f"{len(rows)} {_ROWS[kind].replace('_', ' ')}"
    lines = [f"{test.format}; {what} in {test.deformation}; {count}"]
    lines.append("  ".join(f"{name:>{width}}" for name, width in columns))
    for row in rows:
        cells = [_cell(value, width) for value, (_, width) in zip(_shown(row), columns, strict=True)]
        lines.append("  ".join(cells))
    return found, lines


#: Kind -> what its rows are.
_ROWS: dict[TestKind, str] = {
    "dma": "isotherms",
    "ramps": "frequencies",
    "amplitude": "amplitudes",
    "creep": "creep_tests",
    "relaxation": "relaxation_tests",
}
#: Quantity -> factor and offset to what is printed.
_PRINTED = {
    "temperature": (1.0, -273.15),
    "angular_frequency": (1.0 / (2.0 * math.pi), 0.0),
    "storage_modulus": (1e-6, 0.0),
    "relaxation_modulus": (1e-6, 0.0),
    "creep_compliance": (1e6, 0.0),
    "strain_amplitude": (100.0, 0.0),
}


def _sweeps(test: IsothermalSweeps) -> tuple[list[tuple[str, int]], list[dict[str, Any]]]:
    letter = "G" if test.deformation == "shear" else "E"
    columns = [("T (°C)", 8), ("points", 6), ("f (Hz)", 19), (f"{letter}' (MPa)", 19), ("tan δ", 15)]
    rows = [
        {
            "temperature": one.temperature,
            "points": len(one),
            "angular_frequency": _span(one.angular_frequency),
            "storage_modulus": _span(one.storage_modulus),
            "loss_tangent": _span(one.loss_modulus / one.storage_modulus),
        }
        for one in test.isotherms
    ]
    return columns, rows


def _ramps(test: TemperatureRamps) -> tuple[list[tuple[str, int]], list[dict[str, Any]]]:
    letter = "G" if test.deformation == "shear" else "E"
    columns = [("f (Hz)", 8), ("points", 6), ("T (°C)", 16), (f"{letter}' (MPa)", 19), ("tan δ", 15)]
    rows = [
        {
            "angular_frequency": one.angular_frequency,
            "points": len(one),
            "temperature": _span(one.temperature),
            "storage_modulus": _span(one.storage_modulus),
            "loss_tangent": _span(one.loss_tangent),
        }
        for one in test.ramps
    ]
    return columns, rows


def _amplitudes(test: AmplitudeSweep) -> tuple[list[tuple[str, int]], list[dict[str, Any]]]:
    letter = "G" if test.deformation == "shear" else "E"
    columns = [("T (°C)", 8), ("f (Hz)", 8), ("points", 6), ("strain (%)", 19), (f"{letter}' (MPa)", 19), ("tan δ", 15)]
    row = {
        "temperature": test.temperature,
        "angular_frequency": test.angular_frequency,
        "points": len(test),
        "strain_amplitude": _span(test.strain_amplitude),
        "storage_modulus": _span(test.storage_modulus),
        "loss_tangent": _span(test.loss_modulus / test.storage_modulus),
    }
    return columns, [row]


def _steps(test: StepTests) -> tuple[list[tuple[str, int]], list[dict[str, Any]]]:
    creep = test.kind == "creep"
    letter = ("J" if creep else "G") if test.deformation == "shear" else ("D" if creep else "E")
    columns = [("T (°C)", 8), ("points", 6), ("t (s)", 19), (f"{letter}(t) ({'1/MPa' if creep else 'MPa'})", 21)]
    name = "creep_compliance" if creep else "relaxation_modulus"
    rows = [
        {"temperature": one.temperature, "points": len(one), "time": _span(one.time), name: _span(one.response)}
        for one in test.tests
    ]
    return columns, rows


_CONTENT: dict[TestKind, Any] = {
    "dma": _sweeps,
    "ramps": _ramps,
    "amplitude": _amplitudes,
    "creep": _steps,
    "relaxation": _steps,
}


def _span(values: Any) -> list[float]:
    return [float(np.min(values)), float(np.max(values))]


def _shown(row: dict[str, Any]) -> list[Any]:
    return [_in_print(name, value) for name, value in row.items()]


def _in_print(name: str, value: Any) -> Any:
    if name == "temperature":
        return [celsius(one) for one in value] if isinstance(value, list) else f"{celsius(value):z.1f}"
    factor, offset = _PRINTED.get(name, (1.0, 0.0))
    if isinstance(value, list):
        return [factor * one + offset for one in value]
    return value if name == "points" else factor * value + offset


def _cell(value: Any, width: int) -> str:
    if isinstance(value, list):
        value = f"{value[0]:.3g} to {value[1]:.3g}"
    elif isinstance(value, float):
        value = f"{value:.3g}"
    return f"{value:>{width}}"
