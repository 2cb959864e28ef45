"""Job ``sweeps``: what the rubber's files were taken for, what they hold, and what was flagged in them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import plain, record
from viscofric.errors import DataFileError, InputError
from viscofric.files import says_synthetic
from viscofric.notes import listed, note_of
from viscofric.ramps import TemperatureRamps
from viscofric.readers.dma.checks import outliers
from viscofric.readers.dma.isotherms import REPEATS_DIFFER, TracedSweeps
from viscofric.readers.dma.read import trace_dma
from viscofric.readers.dma.readings import Readings
from viscofric.step_tests import StepTests
from viscofric.study.make_rubber import how_read, read_ramps_of, read_steps_of
from viscofric.study.run_file.material import MaterialTable
from viscofric.web.figures.sweeps import sweeps_view
from viscofric.web.jobs.context import Context, JobError, JobOptions
from viscofric.web.jobs.rubbers import checked_tables, made_rubber
from viscofric.web.jobs.spectrum_numbers import moduli

#: More readings that were left out are counted, not drawn.
_MOST_FLAGGED = 2_000
#: A reference is proposed near this temperature, where the sweeps have one.
_USUAL_REFERENCE = 303.15  # K
_DIGITS = 6
#: Keys of [material] for tests.
_TESTS = {"dma", "ramps", "creep", "relaxation"}
#: What stands in for a reference that is not chosen yet: reading needs none.
_ANY_REFERENCE = "30 degC"


Options = JobOptions


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Read what [material] names, which needs no reference temperature yet."""
    table, _ = checked_tables(_with_reference(study), context)
    found = _read(table, study, context)
    return found | {"range": _measured_range(found)} | sweeps_view(found, table.deformation)


def _measured_range(found: dict[str, Any]) -> list[float] | None:
    """Return the lowest and the highest measured temperature, K."""
    curves = found.get("ramps") or found.get("isotherms") or (found.get("steps") or {}).get("curves") or []
    kelvin = [float(value) for one in curves for value in np.ravel(one["temperature"])]
    return [min(kelvin), max(kelvin)] if kelvin else None


def _read(table: MaterialTable, study: dict[str, Any], context: Context) -> dict[str, Any]:
    if table.dma is None and not (table.ramps or table.steps):
        return _other(table, study, context)
    try:
        if table.dma is None:
            return _read_other(table)
        beside = {"steps": _step_curves(read_steps_of(table))} if table.steps else {}
        traced = trace_dma(*table.dma, **how_read(table))
    except InputError as error:
        raise JobError(error.note, error.field or "material.dma") from None
    return _of_sweeps(table, traced) | beside


def _with_reference(study: dict[str, Any]) -> dict[str, Any]:
    material = study.get("material")
    if isinstance(material, dict) and _TESTS & material.keys():
        return {**study, "material": {"reference_temperature": _ANY_REFERENCE, **material}}
    return study


def _of_sweeps(table: MaterialTable, traced: TracedSweeps) -> dict[str, Any]:
    sweeps, specimens = traced.sweeps, _specimens(traced)
    notes = [note for note in sweeps.notes if specimens is None or note_of(note).code != "repeats-differ"]
    nearest = _nearest(sweeps.temperatures)
    return {
        "source": "dma",
        "format": sweeps.format,
        "deformation": sweeps.deformation,
        "files": [_file(one) for one in traced.readings],
        "left_open": _left_open(table, traced.readings),
        "isotherms": [record(one.to_dataset(), _DIGITS) for one in sweeps.isotherms],
        "flagged": [*_left_out(traced), *_outliers(traced)],
        "left_out": int(traced.left_out.size),
        **listed("notes", notes, "page"),
        "specimens": specimens,
        "reference": plain(round(nearest, 2)),
        "synthetic": any(map(says_synthetic, table.inputs)),
    }


def _specimens(traced: TracedSweeps) -> dict[str, Any] | None:
    """Return the files that differ at one temperature and frequency, by how much at most and at which temperature."""
    points = traced.points
    size = np.hypot(points.storage_modulus, points.loss_modulus)
    differing: set[int] = set()
    worst, kelvin = 0.0, 0.0
    for one in traced.isotherms:
        for rows in one.origins:
            files = np.unique(points.file[rows])
            means = [float(np.mean(size[rows][points.file[rows] == file])) for file in files]
            apart = float(np.ptp(means) / np.mean(means))
            if apart > REPEATS_DIFFER:
                differing.update(files.tolist())
                worst, kelvin = max((worst, kelvin), (apart, float(one.isotherm.temperature)))
    if not differing:
        return None
    names = [Path(traced.readings[file].source).name for file in sorted(differing)]
    return {"files": names, "difference": plain(worst), "temperature": plain(kelvin)}


def _file(readings: Readings) -> dict[str, Any]:
    return {
        "name": Path(readings.source).name,
        "format": readings.format,
        "deformation": readings.deformation,
        "readings": len(readings),
        "temperature": _range(readings.temperature),
        "angular_frequency": _range(readings.angular_frequency),
    }


def _range(values: Any) -> list[float] | None:
    sound = values[np.isfinite(values) & (values > 0.0)]
    return [plain(float(sound.min())), plain(float(sound.max()))] if sound.size else None


def _left_open(table: MaterialTable, readings: Sequence[Readings]) -> list[str]:
    """Return the keys of [material] that the files leave to the user, whether or not he has given them."""
    requested = []
    if all(one.deformation is None for one in readings):
        requested.append("deformation")
    if any(one.lacks_unit for one in readings):
        requested.append("modulus_unit")
    if table.temperature is not None:
        requested.append("temperature")
    return requested


def _left_out(traced: TracedSweeps) -> list[dict[str, Any]]:
    points = traced.points
    return [
        _flagged("left out", points.places[row], points, row, float(points.temperature[row]))
        for row in traced.left_out[:_MOST_FLAGGED].tolist()
    ]


def _outliers(traced: TracedSweeps) -> list[dict[str, Any]]:
    found = []
    for name in ("storage", "loss"):
        for number, row in outliers(traced.sweeps.isotherms, name):
            one = traced.sweeps.isotherms[number]
            origins = next(each for each in traced.isotherms if each.isotherm is one).origins[row]
            place = traced.points.named(origins.tolist())
            found.append(
                _flagged(f"far off its neighbours ({name} modulus), kept", place, one, row, float(one.temperature))
            )
    return found


def _flagged(why: str, place: str, columns: Any, row: int, temperature: float) -> dict[str, Any]:
    """Return one reading with the reason why it is flagged; `columns` has its frequency and moduli."""
    names = ("angular_frequency", "storage_modulus", "loss_modulus")
    values = {name: plain(float(getattr(columns, name)[row])) for name in names}
    return {"why": why, "place": place, "temperature": plain(temperature), **values}


def _other(table: MaterialTable, study: dict[str, Any], context: Context) -> dict[str, Any]:
    """Tell of a rubber that needs no sweeps: a master curve, a card, one of the catalogue."""
    from viscofric.rheology.catalogue import catalogue_entry

    try:
        rubber = made_rubber(study, context)
    except DataFileError as error:
        key = "file" if table.file is not None else "master_curve"
        raise JobError(error.note, (error.field if key == "master_curve" else None) or f"material.{key}") from None
    source = "catalogue" if table.catalogue else "file" if table.file else "master_curve"
    about = []
    if table.catalogue:
        entry = catalogue_entry(table.catalogue)
        about = [entry.holds, entry.remarks, entry.citation]
    return {
        "source": source,
        "name": rubber.material.name,
        "about": about or [text for text in (rubber.source, rubber.material.citation) if text],
        **listed("notes", rubber.notes, "page"),
        "synthetic": rubber.synthetic,
        "reference": None if rubber.material.reference is None else plain(rubber.material.reference),
        "isotherms": [],
        "flagged": [],
        "left_open": ["deformation"] if table.master_curve and table.deformation else [],
    }


#: Points of a curve for each decade of time: no screen shows more.
_PER_DECADE = 40


def _read_other(table: MaterialTable) -> dict[str, Any]:
    """Return the ramps or step tests of [material]; the field of an `InputError` is the key of what is not stated."""
    common: dict[str, Any] = {"isotherms": [], "files": [], "flagged": [], "left_out": 0}
    common["synthetic"] = any(map(says_synthetic, table.inputs))
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
            "reference": plain(round(float(np.clip(_USUAL_REFERENCE, low, high)), 2)),
            **listed("notes", ramps.notes, "page"),
        }
    tests = read_steps_of(table)
    return common | {
        "source": tests.kind,
        "format": tests.format,
        "deformation": tests.deformation,
        "left_open": _given(table),
        "steps": _step_curves(tests),
        "reference": plain(round(_nearest(tests.temperatures), 2)),
        **listed("notes", tests.notes, "page"),
    }


def _step_curves(tests: StepTests) -> dict[str, Any]:
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
        plain(
            moduli(one.temperature, one.storage_modulus + 1j * one.loss_modulus)
            | {"temperature": one.temperature, "angular_frequency": one.angular_frequency}
        )
        for one in ramps.ramps
    ]


def _nearest(temperatures: Array) -> float:
    return float(temperatures[np.argmin(np.abs(temperatures - _USUAL_REFERENCE))])
