"""Job ``curve``: friction over speeds and temperatures, sent point by point while it is solved; then its warnings."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from viscofric.datasets import plain
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.planning.plan import Outcome
from viscofric.notes import Note, listed
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.study.assumptions import assumption_checks
from viscofric.study.contacts import Contacts, Solved, doubts, missed_accuracy, nothing_solved
from viscofric.study.heating import NO_LAW, Heatings
from viscofric.study.interface import interface_columns, study_interface
from viscofric.study.run_file.study import Study
from viscofric.study.running.executors import Processes
from viscofric.study.running.running import Event, Plan, run_plan
from viscofric.study.running.store import CaseStore
from viscofric.study.study_rubber import StudyRubber, band_columns
from viscofric.web.figures.spec import Spec, axis, quantity
from viscofric.web.jobs.combinations import combinations, of_material, page_sweep
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.rubbers import study_rubber
from viscofric.web.study_text import study_of

_BETWEEN_PARTS = 0.12  # s
_DIGITS = 6
_MOST_REASONS = 5
#: Quantities of cases; those in `_ROUGH` are a rough surface's, those in `_SMOOTH` an indenter's.
_QUANTITIES = {
    "friction": axis("friction coefficient μ"),
    "indentation": axis("indentation", "length"),
    "contact_area": axis("contact area", "area"),
    "contact_area_fraction": axis("contact area fraction"),
    "max_pressure": axis("maximum pressure", "pressure"),
    "mean_gap": axis("mean gap", "length"),
    "heated_friction": axis("friction coefficient μ with heating"),
    "temperature_rise": axis("rise of temperature (K)"),
    "interface_friction": axis("friction coefficient of the interface"),
    "total_friction": axis("total friction coefficient"),
}
_ROUGH, _SMOOTH = ("contact_area_fraction", "mean_gap"), ("indentation", "contact_area")
_OF_TABLES = ("interface_friction", "total_friction", "heated_friction", "temperature_rise")
_DOUBTS = {
    "extrapolated": "it depends on frequencies at which the material was not measured",
    "shift": "the shift factor is extrapolated beyond the temperatures that its law was fitted to",
    "strain": "the contact is wide or steep: the small-strain assumption is doubtful",
    "unresolved": "the points of the surface do not resolve its peaks",
    "adhesion": "adhesion, which is left out, may matter",
    "inertia": "inertia, which is left out, may matter",
    "inaccurate": "its estimated numerical error exceeds the requested accuracy",
}
#: Of notes on contacts, by code; others are about large strain.
_OF_CODES = {"heights-unresolved": "unresolved", "adhesion": "adhesion", "quasi-static": "inertia"}
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
        requested, at_points, along = contacts.results()
        more, said, law = _of_tables(contacts, requested, lambda plan: run_plan(plan, store, executor, context.show))
    if not requested.records:
        raise nothing_solved(requested.failures[0].note)
    found = {**layout, **columns(contacts, requested), **more}
    return {
        **found,
        **_parts(found),
        "master": master_curve(contacts, along),
        **listed("failures", [one.note for one in requested.failures], "page"),
        "missing": _missing([one.note for one in requested.failures], len(found["speed"])),
        **listed(
            "warnings",
            [
                *(note for one in contacts.rubbers for note in one.doubts(checked.conditions.temperature)),
                *doubts((requested,), contacts.rubbers),
                *missed_accuracy(requested, checked)[1],
            ],
            "page",
        ),
        **listed("notes", [*_notes(contacts, checked), *said], "page"),
        "checks": plain([one.record("page") for one in assumption_checks(contacts, requested, at_points, law)]),
    }


def _missing(failures: list[Note], count: int) -> list[str]:
    """Return how many of the cases have no solution, and why, those of one reason together."""
    if not failures:
        return []
    from viscofric.report.texts.study import grouped_failures

    said = f"{len(failures)} of {count} conditions have no solution."
    return [said, *grouped_failures(failures, _MOST_REASONS, "page")]


def _contacts(checked: Study, study: dict[str, Any], context: Context) -> Contacts:
    page_sweep(checked)  # refuses what is too much
    bare = checked.uncertainty.model_copy(update={"members": 0, **({} if checked.indenter else {"draws": 0})})
    checked = checked.model_copy(update={"uncertainty": bare, "measurement": None})
    tables = {**study, "uncertainty": bare.model_dump(mode="json")}
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
    kind = "rough" if study.indenter is None else "line" if study.indenter.LINE else "point"
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
    extra = [
        *(("interface_friction", "total_friction") if _is_given(study) else ()),
        *(("heated_friction", "temperature_rise") if heated else ()),
    ]
    others = [*(_SMOOTH if kind == "rough" else _ROUGH), *(name for name in _OF_TABLES if name not in extra)]
    quantities = {name: about for name, about in _QUANTITIES.items() if name not in others}
    if kind == "line":
        quantities["contact_area"] = axis("contact width", "length")
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
        if f"{name}_error" in found:
            main |= {"error": f"{name}_error"}
        style: Spec = {"mode": "lines", "width": 1.2, "legend": False}
        beside = [{**style, "y": other, "dash": dash, "text": words} for other, dash, words in _BESIDE.get(name, [])]
        parts[name] = [main, *beside]
    remarks = ["<br>".join(_DOUBTS.get(word, word) for word in words) for words in found["doubts"]]
    known = [one for one in found["friction"] if one is not None]
    summary = f"μ {quantity(min(known), digits=2)} to {quantity(max(known), digits=2)}" if known else ""
    return {"parts": parts, "remarks": remarks, "summary": summary}


def _is_given(study: Study) -> bool:
    """Whether there is an interface whose law is known without a measurement."""
    return study.interface is not None and study.interface.is_given


def _of_tables(
    contacts: Contacts, requested: Solved, solve: Callable[[Plan], object]
) -> tuple[dict[str, Any], list[Note], InterfaceLaw | None]:
    """Return what [interface] and [heating] add to all cases, each number a column, notes, and the interface's law."""
    study, rows = contacts.study, [not isinstance(one, Failure) for one in requested.outcomes]
    found: dict[str, Any] = {}
    law: InterfaceLaw | None = None
    said: list[Note] = []
    if _is_given(study):
        interface = study_interface(contacts)
        rubbed = interface_columns(contacts, interface, requested)
        law, said = interface.law, [*interface.notes, *rubbed.notes]
        for name in ("interface_friction", "total_friction"):
            column = np.full(len(rows), np.nan)
            column[rows] = rubbed.columns.get(name, np.nan)
            found[name] = column
    elif study.interface is not None:
        said.append(Note("fitted-interface", "The interface is fitted to the measurement when the study is run."))
        said += [NO_LAW] if study.heating is not None else []
    heatings = Heatings.of(study, contacts.sweep, contacts.plan.rubbers, law)
    if heatings is not None:
        solve(heatings)
        warm = {name: values[:, 0, 0] for name, values in heatings.columns_of_cases().items()}
        names = ("temperature_rise", "temperature_rise_error", "coulomb_rise", "loss_rise")
        found |= {name: warm[name] for name in names if name in warm}
        found |= {"heated_friction": warm["friction_coefficient"]} if warm else {}
        if law is not None and warm:
            found["interface_friction"] = warm["interface_friction"]
            found["total_friction"] = warm["friction_coefficient"] + warm["interface_friction"]
        said += [*heatings.failures, *heatings.warnings]
    return {name: plain(column, _DIGITS) for name, column in found.items()}, said, law


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


def _notes(contacts: Contacts, study: Study) -> list[str]:
    notes = [note for one in contacts.rubbers for note in one.notes]
    return list(dict.fromkeys([*notes, *study.notes]))


#: Numbers of a contact besides its friction, where it has them.
_COLUMNS = (
    "indentation",
    "contact_area",
    "front",
    "rear",
    "max_pressure",
    "centre_of_pressure",
    "contact_area_fraction",
    "mean_gap",
)


def columns(contacts: Contacts, requested: Solved) -> dict[str, Any]:
    """Return what is known of all cases, each number a column."""
    bands = band_columns(contacts.rubbers, requested.of_records, requested.records)
    rows = [number for number, outcome in enumerate(requested.outcomes) if not isinstance(outcome, Failure)]
    missed = np.zeros(len(requested.cases), dtype=bool)
    missed[rows] = missed_accuracy(requested, contacts.study)[0]

    def column(values: Iterable[float]) -> Any:
        whole = np.full(len(requested.cases), np.nan)
        whole[rows] = list(values)
        return plain(whole, _DIGITS)

    records = requested.records
    found = {
        "friction": column(one.friction_coefficient for one in records),
        "error": column(one.friction_error for one in records),
        "interpolated": [getattr(outcome, "interpolated", False) for outcome in requested.outcomes],
        "lower": None if bands is None else column(bands.viscoelastic_lower),
        "upper": None if bands is None else column(bands.viscoelastic_upper),
        "doubts": [
            _doubts(contacts, case, outcome, inaccurate=bool(one))
            for case, outcome, one in zip(requested.cases, requested.outcomes, missed, strict=True)
        ],
    }
    has = [name for name in _COLUMNS if hasattr(records[0], name)]
    return found | {name: column(getattr(one, name) for one in records) for name in has}


def _doubts(contacts: Contacts, case: Any, outcome: Outcome, *, inaccurate: bool) -> list[str]:
    """Name what is doubtful about a point."""
    if isinstance(outcome, Failure):
        return ["failed"]
    rubber: StudyRubber = contacts.rubbers[case.material]
    found = {_OF_CODES.get(note.code, "strain") for note in outcome.warnings}
    found |= {
        name
        for name, doubtful in {
            "extrapolated": rubber.is_within(case, outcome) is False,
            "shift": bool(np.any(rubber.shift.extrapolates(np.array([case.temperature])))),
            "inaccurate": inaccurate,
        }.items()
        if doubtful
    }
    return [name for name in _DOUBTS if name in found]


def master_curve(contacts: Contacts, along: Solved) -> dict[str, Any] | None:
    """Return friction along the master curve, at the reference temperature; None where there is more than one."""
    if not along.records:
        return None
    records: list[Record] = along.records
    curves = contacts.rubbers[0].bands.curves(records)
    shown = {
        "reduced_speed": curves.speed,
        "friction": curves.viscoelastic,
        "lower": curves.viscoelastic_lower,
        "upper": curves.viscoelastic_upper,
    }
    return {name: None if values is None else plain(values, _DIGITS) for name, values in shown.items()}
