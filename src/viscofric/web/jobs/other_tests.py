"""Temperature ramps, creep and relaxation tests as they were read, for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.datasets import plain
from viscofric.notes import listed
from viscofric.web.jobs.rubbers import notes_without_folder
from viscofric.web.jobs.spectrum_numbers import moduli

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.ramps import TemperatureRamps
    from viscofric.step_tests import StepTests
    from viscofric.study.run_file.material import MaterialTable
    from viscofric.web.jobs.rubbers import Folders

#: Points of a curve for each decade of time: no screen shows more.
_PER_DECADE = 40


def read_other(table: MaterialTable, folders: Folders, near: float) -> dict[str, Any]:
    """Return the ramps or the step tests of [material].

    Returns
    -------
    dict
        As of sweeps, with ``ramps`` or ``steps`` instead of isotherms: curves with ``temperature`` or
        ``angular_frequency``.

    Raises
    ------
    InputError
        If a file cannot be used; its field is the key of [material] that states what is missing.
    """
    from viscofric.study.make_rubber import read_ramps_of, read_steps_of

    common: dict[str, Any] = {"isotherms": [], "files": [], "flagged": [], "left_out": 0, "synthetic": False}
    if table.ramps is not None:
        ramps = read_ramps_of(table)
        asked = ["assumed_shift"] if len(ramps) == 1 else []
        low, high = ramps.temperature_range
        return common | {
            "source": "ramps",
            "format": ramps.format,
            "deformation": ramps.deformation,
            "left_open": [*_given(table), *asked],
            "ramps": _ramps(ramps),
            "reference": plain(round(float(np.clip(near, low, high)), 2)),
            **listed("notes", notes_without_folder(ramps.notes, folders)),
        }
    tests = read_steps_of(table)
    return common | {
        "source": tests.kind,
        "format": tests.format,
        "deformation": tests.deformation,
        "left_open": _given(table),
        "steps": step_curves(tests),
        "reference": plain(round(_nearest(tests.temperatures, near), 2)),
        **listed("notes", notes_without_folder(tests.notes, folders)),
    }


def step_curves(tests: StepTests) -> dict[str, Any]:
    """Return step tests as measured: the response over time at each temperature."""
    curves = [
        {"temperature": plain(one.temperature), "time": plain(one.time), "response": plain(one.response)}
        for one in tests.thinned(_PER_DECADE).tests
    ]
    points = sum(len(one) for one in tests.tests)
    return {"kind": tests.kind, "deformation": tests.deformation, "curves": curves, "points": points}


def _given(table: MaterialTable) -> list[str]:
    """Return the keys of [material] that the user gave, since the files leave them open."""
    return [name for name in ("deformation", "modulus_unit", "temperature") if getattr(table, name) is not None]


def _ramps(ramps: TemperatureRamps) -> list[dict[str, Any]]:
    return [
        moduli(one.temperature, one.storage_modulus + 1j * one.loss_modulus)
        | {"temperature": plain(one.temperature), "angular_frequency": plain(one.angular_frequency)}
        for one in ramps.ramps
    ]


def _nearest(temperatures: Array, near: float) -> float:
    return float(temperatures[np.argmin(np.abs(temperatures - near))])
