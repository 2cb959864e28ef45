"""Job ``agreement``: measured friction beside the prediction for the page's rubber and ball."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.datasets import DataTree, plain
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import listed, note_of, notes_in
from viscofric.report.data import predicted
from viscofric.report.results import group, nominal_temperatures, reference_temperature, remarks, sentences, values
from viscofric.report.sweeps import cases_of
from viscofric.report.texts.checks import CIRCULAR, friction_checks
from viscofric.report.texts.friction_tables import agreement_table
from viscofric.report.texts.study import AGREEMENT, key_numbers
from viscofric.study.contacts import Contacts
from viscofric.study.execution import tree_of
from viscofric.study.measurement import Measurement
from viscofric.study.running.executors import Processes
from viscofric.study.running.running import run_plan
from viscofric.study.running.store import CaseStore
from viscofric.web.figures.friction import agreement_figures
from viscofric.web.figures.spec import number
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.friction_data import by_temperature, drawn_line, measured_points, table_record, texts
from viscofric.web.jobs.friction_input import friction_curves, measured
from viscofric.web.jobs.rubbers import study_rubber
from viscofric.web.study_text import study_of

#: Tables of the run file that the comparison rests on; other tables belong to other steps.
_TABLES = ("material", "indenter", "surface", "layer", "measurement", "solver", "uncertainty", "data_origin")
#: Predicted lines reach so far beyond the measured speeds, as a factor, with so many points.
_BEYOND, _POINTS = 1.25, 25
_CASES = "friction cases"


Options = JobOptions


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Predict friction where and how it was measured; return both by temperature, and how well they agree."""
    curves = friction_curves(study, context)
    context.progress(0, 1, "Building the material")
    contacts = _contacts(_as_measured(study, curves), curves, context)

    with Processes() as executor:
        run_plan(contacts.plan, CaseStore(context.cache / _CASES), executor, context.show)
    # What is to be said of the rubber and of the measurement, other steps say.
    rubber = contacts.rubbers[0]
    reply = _reply(tree_of(contacts, reader="page")) | listed("notes", dict.fromkeys(rubber.bands.notes), "page")
    if rubber.rubber.from_friction:
        reply |= listed("warnings", [CIRCULAR, *map(note_of, reply["warning_records"])], "page")
    numbers: dict[str, Any] = plain(reply | {"synthetic": measured(study, context).synthetic})
    return numbers | {"figures": agreement_figures(numbers, plain(measured_points(curves)))}


def _as_measured(study: dict[str, Any], curves: FrictionCurves) -> dict[str, Any]:
    """Return a study of the conditions that were measured."""
    requested = {name: study[name] for name in _TABLES if name in study}
    conditions = {
        "load": f"{float(np.median(curves.load)):.9g} {curves.load_unit}",
        "speed": {
            "from": f"{curves.speed.min() / _BEYOND:.9g} m/s",
            "to": f"{curves.speed.max() * _BEYOND:.9g} m/s",
            "points": _POINTS,
            "spacing": "log",
        },
        "temperature": [f"{float(kelvin):.9g} K" for kelvin in nominal_temperatures(curves.temperature)],
    }
    thickness = study.get("conditions", {}).get("thickness")
    if thickness is not None:
        conditions["thickness"] = thickness
    solver = {**requested.get("solver", {}), "cases": "curves"}
    uncertainty = {**requested.get("uncertainty", {}), "members": 0}
    tables = {"conditions": conditions, "solver": solver, "uncertainty": uncertainty, "outputs": {"fields": "none"}}
    return {**requested, **tables}


def _contacts(requested: dict[str, Any], curves: FrictionCurves, context: Context) -> Contacts:
    """Return the contacts to solve, of the requested and the measured conditions."""
    _, checked = study_of(requested, context.files)
    rubber = study_rubber(requested, context, checked.conditions.temperature)
    ball: Any = checked.sweep().cases[0]
    load = float(checked.conditions.load[0])
    return Contacts(checked, [rubber], Measurement(curves, rubber.material, ball.indenter, load))


def _reply(tree: DataTree) -> dict[str, Any]:
    requested, along, agreement = (group(tree, name) for name in ("prediction", "prediction_master", "agreement"))
    assert requested is not None
    lines = predicted(cases_of(requested))
    kinds = {"friction": lines.friction, "lower": lines.lower, "upper": lines.upper, "extrapolated": lines.extrapolated}
    about = [one for one in key_numbers(tree) if one.name == AGREEMENT]
    said = [] if agreement is None else sentences(agreement.attrs, "sentences")
    at_reference = None
    if along is not None:
        at_reference = {"reference": reference_temperature(tree), **(drawn_line(predicted(along)) or {})}
    return {
        "points": _points(tree),
        "lines": by_temperature(lines.temperature, lines.speed, **kinds),
        "along": at_reference,
        "sentences": texts(said),
        "summary": f"predicted to {about[0].value}" if about else "",
        "key_numbers": [number(one.name, one.value, remark=one.remark) for one in about],
        "table": table_record(agreement_table(tree)),
        "checks": [one.record("page") for one in friction_checks(tree)],
        "band": lines.has_band,
        **listed("warnings", dict.fromkeys(notes_in(tree.attrs, "warnings")), "page"),
        **listed("failures", dict.fromkeys(notes_in(tree.attrs, "failures")), "page"),
    }


def _points(tree: DataTree) -> list[dict[str, Any]]:
    """Return measured points beside their prediction, with what is doubtful about each."""
    points = group(tree, "measurement")
    assert points is not None
    friction, found = values(points, "viscoelastic"), values(points, "predicted")
    return by_temperature(
        values(points, "temperature"),
        values(points, "speed"),
        measured=friction,
        predicted=found,
        lower=values(points, "predicted_lower"),
        upper=values(points, "predicted_upper"),
        difference=np.divide(found, friction, out=np.full(found.shape, np.nan), where=friction > 0.0) - 1.0,
        reduced_speed=values(points, "reduced_speed"),
        remark=np.array(["; ".join(words) for words in remarks(tree, points)], dtype=object),
    )
