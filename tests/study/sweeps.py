"""Sweeps with cases that nobody solved: their numbers follow from formulas, so that it is known where each belongs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import xarray

import viscofric as vf
from viscofric.datasets import dataset
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import ContactFields, Failure, Record
from viscofric.study.cases.sweep import Axis, Sweep
from viscofric.study.results.file import save_results
from viscofric.study.results.results import StudyResults, provenance
from viscofric.study.results.tree import field_groups, material_groups, prediction

#: Any numbers that a ball's contact might have.
RECORD = Record.of(
    speed=0.1,
    temperature=303.15,
    load=25.0,
    friction_coefficient=0.02,
    friction_error=1e-6,
    indentation=1e-4,
    indentation_error=1e-8,
    contact_area=1e-6,
    contact_area_error=1e-9,
    front=1e-3,
    rear=0.9e-3,
    half_width=1e-3,
    edge_error=1e-6,
    max_pressure=1e6,
    max_pressure_error=1e3,
    centre_of_pressure=1e-5,
    energy_balance=1e-4,
    complementarity=1e-9,
    cells=256,
    products=90,
)


def made_sweep(
    loads: Sequence[float] = (10.0, 25.0),
    radii: Sequence[float] = (0.005, 0.01),
    temperatures: Sequence[float] = (303.15, 333.15, 363.15),
    speeds: Sequence[float] = (0.02, 0.1, 0.2),
    materials: Sequence[str] = ("",),
    together: bool = True,
) -> Sweep:
    """Return a sweep of a ball, its loads and radii stepped together if asked for."""
    places: list[tuple[float, float]]
    if together:
        shape = [Axis("load_radius", {"load": tuple(loads), "radius": tuple(radii)})]
        places = list(zip(loads, radii, strict=True))
    else:
        shape = [Axis("radius", {"radius": tuple(radii)}), Axis("load", {"load": tuple(loads)})]
        places = [(load, radius) for radius in radii for load in loads]
    axes = (
        Axis("material", {"material": tuple(materials)}),
        Axis("sample", {"sample": (0,)}),
        *shape,
        Axis("temperature", {"temperature": tuple(temperatures)}),
        Axis("speed", {"speed": tuple(speeds)}),
    )
    cases = tuple(
        IndenterCase(number, vf.Ball(radius), temperature, speed, load)
        for number, (load, radius), temperature, speed in product(range(len(materials)), places, temperatures, speeds)
    )
    return Sweep(axes, cases)


def friction_of(case: Any) -> float:
    """Friction of a formula that no two cases share."""
    return (
        0.01
        + 1e-4 * (case.temperature - 273.15)
        - 1e-3 * float(np.log10(case.speed))
        + 1e-5 * case.load
        + 0.1 * case.indenter.radius
        + 0.5 * case.material
    )


def made_outcomes(sweep: Sweep, failed: Sequence[int] = (), fields: Sequence[int] = ()) -> list[Record | Failure]:
    """Return what became of each case: numbers of the formula, but for those that failed."""
    found: list[Record | Failure] = []
    for number, case in enumerate(sweep.cases):
        if number in failed:
            found.append(Failure("accuracy not reached.", f"case {number}"))
            continue
        place: dict[str, Any] = {"speed": case.speed, "temperature": case.temperature, "load": case.load}
        numbers = RECORD.numbers | place | {"friction_coefficient": friction_of(case)}
        record = replace(RECORD, numbers=numbers, interpolated=number % 2 == 1)
        if number in fields:
            x, y = np.linspace(-1e-3, 1e-3, 5), np.linspace(0.0, 1e-3, 3)
            pressure = np.add.outer(x, y) + number
            record = replace(record, fields=ContactFields(x, y, pressure, 1e-6 * pressure))
        found.append(record)
    return found


def made_results(
    folder: Path, sweep: Sweep | None = None, failed: Sequence[int] = (), stored: bool = True, **about: Any
) -> StudyResults:
    """Return results of a sweep, stored or only in memory: made-up cases, and a group of one or several materials."""
    sweep = sweep or made_sweep()
    outcomes = made_outcomes(sweep, failed, fields=[len(sweep.cases) - 1])
    materials = sweep.axes[0].columns["material"]
    groups, attributes = material_groups(
        [
            {
                "/spectrum": dataset(
                    "mode",
                    {"retardation_time": ([1e-3, 1.0], "s", ""), "creep_coefficient": ([1e-7, 2e-7], "1/Pa", "")},
                    attributes={
                        "E0": 3e6,
                        "error": np.nan,
                        "range": np.array([1.5, 2.5]),
                        "statements": '["One.", "Another."]',
                        "constants": '{"C1": 8.0}',
                    },
                )
            }
        ]
        * len(materials),
        [{"reference_temperature": 303.15} for name in materials],
    )
    tree = xarray.DataTree.from_dict(
        {**groups, "/prediction": prediction(sweep, outcomes), **field_groups(sweep, outcomes)}
    )
    tree.attrs = {
        "title": "made-up cases",
        "data_origin": "synthetic",
        "accuracy": 1e-3,
        "study_file": "study.toml",
        "study_text": 'title = "made-up cases"\n[conditions]\nload = "25 N"\n',
        "notes": "[]",
        "warnings": json.dumps(["=1+1 is no formula."]),
        "failures": json.dumps([str(outcome) for outcome in outcomes if isinstance(outcome, Failure)]),
        "input_hashes": json.dumps({"dma.csv": "0" * 64}),
        **attributes,
        **provenance(),
        **about,
    }
    if stored:
        save_results(tree, folder)
    return StudyResults(tree, folder)
