"""What a mechanical test holds, in lines and in plain types."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from viscofric.notes import listed
from viscofric.showing import aligned
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path

    from viscofric.readers.recognise import TestKind


def read_kind(kind: TestKind, files: Sequence[Path], reading: dict[str, Any]) -> Any:
    """Return the test of a kind in files, with the options of `reading_options`."""
    from viscofric.readers.dma.ramps import read_amplitude_sweep, read_ramps
    from viscofric.readers.dma.read import read_dma
    from viscofric.readers.steps.read import read_step_tests

    chosen = {name: value for name, value in reading.items() if value}
    temperature = chosen.pop("temperature", None)
    if kind in ("creep", "relaxation"):
        unit = {"response_unit": chosen.pop("modulus_unit")} if "modulus_unit" in chosen else {}
        return read_step_tests(*files, kind=kind, temperature=temperature, **unit, **chosen)
    if kind == "ramps":
        if temperature:
            raise click.UsageError("--temperature is for tests at one temperature; ramps hold their own.")
        return read_ramps(*files, **chosen)
    if kind == "amplitude":
        return read_amplitude_sweep(*files, temperature=temperature, **chosen)
    return read_dma(*files, temperature=temperature, **chosen)


_STEP = ("temperature", "points", "time")
#: Kind of test -> what its rows are, where it has them, and their quantities.
_CONTENT: dict[TestKind, tuple[str, Callable[[Any], Iterable[Any]], tuple[str, ...]]] = {
    "dma": (
        "isotherms",
        lambda test: test.isotherms,
        ("temperature", "points", "angular_frequency", "storage_modulus", "loss_tangent"),
    ),
    "ramps": (
        "frequencies",
        lambda test: test.ramps,
        ("angular_frequency", "points", "temperature", "storage_modulus", "loss_tangent"),
    ),
    "amplitude": (
        "amplitudes",
        lambda test: [test],
        ("temperature", "angular_frequency", "points", "strain_amplitude", "storage_modulus", "loss_tangent"),
    ),
    "creep": ("creep_tests", lambda test: test.tests, (*_STEP, "creep_compliance")),
    "relaxation": ("relaxation_tests", lambda test: test.tests, (*_STEP, "relaxation_modulus")),
}
#: Words of several -> the word of one, if not without its s.
_ONE = {"frequencies": "frequency"}
#: Quantity -> heading (in tension, in shear), factor and offset to what is printed.
_PRINTED = {
    "temperature": (("T (°C)",), 1.0, -273.15),
    "points": (("points",), 1, 0),
    "angular_frequency": (("f (Hz)",), 1.0 / (2.0 * math.pi), 0.0),
    "storage_modulus": (("E' (MPa)", "G' (MPa)"), 1e-6, 0.0),
    "loss_tangent": (("tan δ",), 1.0, 0.0),
    "strain_amplitude": (("strain (%)",), 100.0, 0.0),
    "time": (("t (s)",), 1.0, 0.0),
    "creep_compliance": (("D(t) (1/MPa)", "J(t) (1/MPa)"), 1e6, 0.0),
    "relaxation_modulus": (("E(t) (MPa)", "G(t) (MPa)"), 1e-6, 0.0),
}


def described(kind: TestKind, test: Any, files: Iterable[str]) -> tuple[dict[str, Any], list[str]]:
    """Return a test as a record in SI units, and in lines."""
    noun, parts, names = _CONTENT[kind]
    rows = [{name: _value(one, name) for name in names} for one in parts(test)]
    found: dict[str, Any] = {
        "test": kind,
        "files": [*files],
        "format": test.format,
        "deformation": test.deformation,
        "points": sum(row["points"] for row in rows),
        noun: rows,
        **listed("notes", test.notes),
    }
    what = "moduli" if kind not in ("creep", "relaxation") else "responses"
    words = noun.replace("_", " ")
    several = f"{len(rows)} {words}" if len(rows) != 1 else f"1 {_ONE.get(words, words.removesuffix('s'))}"
    count = "an amplitude sweep" if kind == "amplitude" else several
    lines = [f"{test.format}; {what} in {test.deformation}; {count}"]
    shear = test.deformation == "shear"
    cells = [[_PRINTED[name][0][-1 if shear else 0] for name in names]]
    cells += [[_cell(name, value) for name, value in row.items()] for row in rows]
    return found, [*lines, *aligned(cells)]


def _value(one: Any, name: str) -> Any:
    """Return a quantity of a part of a test: a number, or both ends of its range."""
    if name == "points":
        return len(one)
    if name == "loss_tangent":
        values = one.loss_modulus / one.storage_modulus
    else:
        values = getattr(one, "response" if name in ("creep_compliance", "relaxation_modulus") else name)
    return [float(np.min(values)), float(np.max(values))] if np.ndim(values) else values


def _cell(name: str, value: Any) -> str:
    """Return a quantity as it is printed."""
    *_, factor, offset = _PRINTED[name]
    if isinstance(value, list):
        return " to ".join(f"{factor * one + offset:.3g}" for one in value)
    if name == "temperature":
        return f"{celsius(value):z.1f}"
    return str(value) if isinstance(value, int) else f"{factor * value + offset:.3g}"
