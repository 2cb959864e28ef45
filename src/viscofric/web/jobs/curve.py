"""Job ``curve``: friction over speeds and temperatures, sent point by point while it is solved; then its warnings."""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np

from viscofric.contact.solution import ERRORS, OF_THE_SOLVER
from viscofric.datasets import Dataset, DataTree, plain
from viscofric.friction.assumption_check import assumption_checks_of
from viscofric.friction.cases.case import Case
from viscofric.friction.cases.record import ENDLESS, MEANING, Failure, Record
from viscofric.notes import Note, listed, notes_in
from viscofric.report.results import group, values
from viscofric.study.contacts import Contacts, Solved, missed_accuracy, nothing_solved
from viscofric.study.execution import tree_of
from viscofric.study.heating import Heatings
from viscofric.study.interface import StudyInterface, study_interface
from viscofric.study.results.tree import meaning_of
from viscofric.study.run_file.study import Study
from viscofric.study.running.executors import Processes
from viscofric.study.running.running import Event, run_plan
from viscofric.study.running.store import CaseStore
from viscofric.study.study_rubber import StudyRubber
from viscofric.web.figures.spec import Spec, axis, axis_in, quantity
from viscofric.web.jobs.combinations import combinations, of_material, page_sweep
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.rubbers import study_rubber
from viscofric.web.study_text import study_of

_BETWEEN_PARTS = 0.12  # s
_DIGITS = 6
_MOST_REASONS = 5
#: Numbers of a case that are not offered: what the solver did, and what the case was given.
_NOT_OFFERED = {*OF_THE_SOLVER, *ERRORS.values(), "interpolation_error", "speed", "temperature", "load", "pressure"}
#: Columns of the results -> those of the page.
_NAMES = {
    "friction_coefficient": "friction",
    "friction_error": "error",
    "friction_lower": "lower",
    "friction_upper": "upper",
}
_ERRORS = ERRORS | {"interface_friction": "interface_error"}
_HEATED = {
    "heated_friction": axis("friction coefficient μ with heating"),
    "temperature_rise": axis("rise of temperature (K)"),
}
#: Columns of cases with heating, by those of their group.
_OF_HEATING = {
    **{name: name for name in ("temperature_rise", "temperature_rise_error", "coulomb_rise", "loss_rise")},
    "friction_coefficient": "heated_friction",
    "interface_friction": "interface_friction",
    "total_friction": "total_friction",
}
#: What is doubtful about a case, in words: codes of notes on contacts, and what is found here.
_DOUBTS = {
    "extrapolated": "it depends on frequencies at which the material was not measured",
    "shift": "the shift factor is extrapolated beyond the temperatures that its law was fitted to",
    "large-strain": "the contact is wide or steep: the small-strain assumption is doubtful",
    "deep-in-layer": "the indentation is not small beside the thickness of the layer",
    "heights-unresolved": "the points of the surface do not resolve its peaks",
    "adhesion": "adhesion, which is left out, may matter",
    "quasi-static": "inertia, which is left out, may matter",
    "inaccurate": "its estimated numerical error exceeds the requested accuracy",
}
#: Drawn beside a quantity: column, dashes and words.
_BESIDE = {
    "heated_friction": [("friction", "6px,4px", "isothermal")],
    "temperature_rise": [("coulomb_rise", "6px,4px", "by Coulomb friction"), ("loss_rise", "2px,3px", "by the loss")],
}


Options = JobOptions


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Solve all cases of a study, as ``viscofric run`` does, without its measurement.

    The first part has ``layout`` (see `_layout`); those that follow have ``cases`` (numbers), ``friction`` and
    ``known``: whether it is to the accuracy already, or lies between contacts that may be too far apart.
    """
    _, checked = study_of(study, context.files)
    contacts = _contacts(checked, study, context)
    layout = _layout(contacts)
    context.part({"layout": layout})
    progress = _Sender(contacts, context)
    store = CaseStore(context.cache / "cases")
    store.prepare()
    with Processes() as executor:
        run_plan(contacts.plan, store, executor, progress)
        requested = contacts.results()[0]
        if not requested.records:
            raise nothing_solved(requested.failures[0].note)
        interface = study_interface(contacts) if _is_given(checked) else StudyInterface(None, {}, _left_out(checked))
        heatings = Heatings.of(checked, contacts.sweep, contacts.plan.rubbers, interface.law)
        if heatings is not None:
            run_plan(heatings, store, executor, context.show)
    tree = tree_of(contacts, (), () if heatings is None else (heatings,), interface, "page")
    checks = group(tree, "assumptions")
    failures, heated = [one.note for one in requested.failures], [] if heatings is None else heatings.failures
    found = {**layout, "lower": None, "upper": None, **columns(tree), "doubts": doubts(contacts, requested)}
    return {
        **found,
        **_parts(found),
        "master": master_curve(tree),
        **listed("failures", [*failures, *heated], "page"),
        "missing": _missing(failures, heated, len(found["speed"])),
        **listed("warnings", notes_in(tree.attrs, "warnings"), "page"),
        **listed("notes", notes_in(tree.attrs, "notes"), "page"),
        "checks": plain([one.record("page") for one in (assumption_checks_of(checks) if checks else ())]),
    }


def _left_out(study: Study) -> list[Note]:
    """Return the note on an interface whose law the measurement gives."""
    words = "The interface is fitted to the measurement when the study is run."
    return [] if study.interface is None else [Note("fitted-interface", words)]


def _missing(failures: list[Note], heated: list[Note], count: int) -> list[str]:
    """Return how many of the cases have no solution, and why, also of heated curves, those of one reason together."""
    if not failures and not heated:
        return []
    from viscofric.report.texts.study import grouped_failures

    said = [f"{len(failures)} of {count} conditions have no solution."] if failures else []
    return [*said, *grouped_failures([*failures, *heated], _MOST_REASONS, "page")]


def _contacts(checked: Study, study: dict[str, Any], context: Context) -> Contacts:
    page_sweep(checked)  # refuses what is too much
    bare = checked.uncertainty.model_copy(update={"members": 0})
    checked = checked.model_copy(update={"uncertainty": bare, "measurement": None})
    tables = {**study, "uncertainty": checked.applied_uncertainty.model_dump(mode="json")}
    temperatures = checked.conditions.temperature
    rubbers = [
        study_rubber(of_material(tables, number), context, temperatures) for number in range(len(checked.materials))
    ]
    return Contacts(checked, rubbers, None)


def _layout(contacts: Contacts) -> dict[str, Any]:
    """Return the cases, their ``quantities`` with axes, and ``curves``: cases by combination and temperature."""
    cases, rubbers = contacts.sweep.cases, contacts.rubbers
    numbers, words = combinations(contacts.sweep)
    alpha = {(case.material, case.temperature): float(rubbers[case.material].shift(case.temperature)) for case in cases}
    study = contacts.study
    heated = study.heating is not None and (study.interface is None or _is_given(study))
    kind = contacts.sweep.geometry
    layout: dict[str, Any] = {
        "kind": kind,
        "accuracy": study.solver.accuracy,
        "reference": plain(rubbers[0].shift.reference),
        "combinations": words,
        "combination": [numbers[case.alike] for case in cases],
        "temperature": plain([case.temperature for case in cases], 9),
        "speed": plain([case.speed for case in cases], 9),
        "reduced_speed": plain([alpha[case.material, case.temperature] * case.speed for case in cases], 9),
    }
    quantities = {"friction": axis("friction coefficient μ")}
    shown = [name for name in MEANING[contacts.sweep.geometry] if name not in _NOT_OFFERED]
    shown = [name for name in shown if name not in _NAMES and not (kind == "line" and name in ENDLESS)]
    shown += ["interface_friction", "total_friction"] if _is_given(study) else []
    meaning = meaning_of(contacts.sweep.geometry)
    quantities |= {name: axis_in(*meaning[name]) for name in shown}
    quantities |= _HEATED if heated else {}
    rows: dict[tuple[int, float], list[int]] = {}
    for at, key in enumerate(zip(layout["combination"], layout["temperature"], strict=True)):
        rows.setdefault(key, []).append(at)
    curves = [
        {"combination": number, "temperature": kelvin, "rows": sorted(some, key=layout["speed"].__getitem__)}
        for (number, kelvin), some in sorted(rows.items())
    ]
    return layout | {"quantities": quantities, "curves": curves}


def _parts(found: dict[str, Any]) -> dict[str, Any]:
    """Return ``parts``, the columns drawn of each quantity, ``remarks``, doubts of each case, and ``summary``."""
    band: Spec = {"lower": "lower", "upper": "upper"} if any(one is not None for one in found["lower"] or ()) else {}
    parts = {}
    for name in found["quantities"]:
        main: Spec = {"y": name, "mode": "lines+markers", "size": 6, "text": "remarks"}
        if name == "friction":
            main |= band or {"error": "error"}
        error = _ERRORS.get(name, f"{name}_error")
        if name != "friction" and error in found:
            main |= {"error": error}
        style: Spec = {"mode": "lines", "width": 1.2, "legend": False}
        beside = [{**style, "y": other, "dash": dash, "words": words} for other, dash, words in _BESIDE.get(name, [])]
        parts[name] = [main, *beside]
    remarks = ["<br>".join(_DOUBTS.get(word, word.replace("-", " ")) for word in words) for words in found["doubts"]]
    known = [one for one in found["friction"] if one is not None]
    summary = f"μ {quantity(min(known), digits=2)} to {quantity(max(known), digits=2)}" if known else ""
    return {"parts": parts, "remarks": remarks, "summary": summary}


def _is_given(study: Study) -> bool:
    """Whether there is an interface whose law is known without a measurement."""
    return study.interface is not None and study.interface.is_given


class _Sender:
    """Hands over what is known of the cases while they are solved, each number once."""

    def __init__(self, contacts: Contacts, context: Context) -> None:
        self._contacts, self._context = contacts, context
        self._sent: dict[int, tuple[float, bool]] = {}
        self._last = -math.inf

    def __call__(self, event: Event) -> None:
        if event.event not in ("solved", "stored", "failed"):
            return
        if not self._sent or time.monotonic() - self._last > _BETWEEN_PARTS:
            self._send_new()
            self._last = time.monotonic()
        # What lies between contacts that may be too far apart counts half.
        done = sum(1.0 if known else 0.5 for _, known in self._sent.values())
        self._context.progress(done, len(self._contacts.sweep.cases), event.label or "")

    def _send_new(self) -> None:
        new: list[tuple[int, float, bool]] = []
        for number, outcome, known in self._contacts.plan.so_far():
            # After the requested cases come those along the master curve.
            if number >= len(self._contacts.sweep.cases) or isinstance(outcome, Failure):
                continue
            found = float(f"{outcome.friction_coefficient:.{_DIGITS}g}"), known
            if self._sent.get(number) != found:
                self._sent[number] = found
                new.append((number, *found))
        if new:
            cases, friction, known_ones = zip(*new, strict=True)
            self._context.part({"cases": list(cases), "friction": list(friction), "known": list(known_ones)})


def columns(tree: DataTree) -> dict[str, Any]:
    """Return what is known of all cases, each number a column named as in the results, but for `_NAMES`."""
    cases, heated = tree["prediction"].to_dataset(), group(tree, "heating")
    names = [str(name) for name in cases.data_vars if name not in (*OF_THE_SOLVER, "failed")]
    found: dict[str, Any] = {_NAMES.get(name, name): values(cases, name) for name in names}
    if heated is not None:  # of the first Coulomb friction and slip
        first = heated.isel({name: 0 for name in ("coulomb", "slip") if name in heated.dims})
        found |= {own: values(first, name) for name, own in _OF_HEATING.items() if name in first}
        found.pop("interface_error", None)  # of the isothermal contact
    found = {name: plain(column.ravel(), _DIGITS) for name, column in found.items()}
    return found | {"interpolated": [value == 1.0 for value in found["interpolated"]]}


def doubts(contacts: Contacts, requested: Solved) -> list[list[str]]:
    """Return what is doubtful about each case, in words of `_DOUBTS`."""
    missed = iter(missed_accuracy(requested, contacts.study)[0])
    return [
        ["failed"] if isinstance(outcome, Failure) else _doubts(contacts, case, outcome, inaccurate=bool(next(missed)))
        for case, outcome in zip(requested.cases, requested.outcomes, strict=True)
    ]


def _doubts(contacts: Contacts, case: Case, outcome: Record, *, inaccurate: bool) -> list[str]:
    """Name what is doubtful about a point."""
    rubber: StudyRubber = contacts.rubbers[case.material]
    found = {note.code for note in outcome.warnings}
    found |= {
        name
        for name, doubtful in {
            "extrapolated": rubber.is_within(case, outcome) is False,
            "shift": bool(np.any(rubber.shift.extrapolates(np.array([case.temperature])))),
            "inaccurate": inaccurate,
        }.items()
        if doubtful
    }
    return sorted(found, key=[*_DOUBTS, *found].index)


def master_curve(tree: DataTree) -> dict[str, Any] | None:
    """Return friction along the master curve, at the reference temperature; None where there is more than one."""
    along: Dataset | None = group(tree, "prediction_master")
    if along is None:
        return None
    names = {"speed": "reduced_speed"} | _NAMES
    found = {own: values(along, name) for name, own in names.items() if name in along}
    return {"lower": None, "upper": None} | {name: plain(column, _DIGITS) for name, column in found.items()}
