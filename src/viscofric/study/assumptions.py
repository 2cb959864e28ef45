"""Assumptions of the predictions, checked for the cases of a study and for those at measured points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.friction.assumption_check import AssumptionCheck, assumptions_dataset
from viscofric.friction.assumptions import check_assumptions
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import Record
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import MadeSurface, surface_of
from viscofric.friction.coulomb import with_interface
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, Reader, Remedy, note_of
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.study.contacts import Contacts, Solved
from viscofric.study.run_file.study import Study
from viscofric.study.study_rubber import curves_of

# Checks with a warning of the run; others have warnings of single contacts, or are harmless.
_WARNED_OF = ("half-space", "uncoupled")
_HEATED = Remedy("; this is the isothermal friction, the results also have that with heating.")


def assumptions(found: Sequence[AssumptionCheck], reader: Reader = "run_file") -> dict[str, Dataset]:
    """Return the checks as a group of results, in the words of a reader; none without checks."""
    return {"/assumptions": assumptions_dataset(found, reader)} if found else {}


def assumption_warnings(found: Sequence[AssumptionCheck]) -> list[Note]:
    """Return warnings about rubber that is no half-space, and Coulomb friction that couples to pressure."""
    return [
        note_of(check.sentence).coded(check.name)
        for check in found
        if check.name in _WARNED_OF and check.holds is False
    ]


def assumption_checks(
    contacts: Contacts, requested: Solved, at_points: Solved, law: InterfaceLaw | None
) -> list[AssumptionCheck]:
    """Check thickness, small strain, shear and warming of all contacts, and return the worst check of each kind."""
    if contacts.study.indenter is None:
        return _surface_checks(contacts.study, requested.of_records)
    alike: dict[object, list[tuple[IndenterCase, Record]]] = {}
    for case, record in zip(requested.of_records, requested.records, strict=True):
        alike.setdefault(case.alike, []).append((case, record))
    found: dict[str, AssumptionCheck] = {}
    # The largest contact first: if the thickness is unknown, it is the worst.
    for pairs in sorted(alike.values(), key=lambda pairs: -max(_reach(record) for _, record in pairs)):
        records = [record for _, record in pairs]
        curves = curves_of(records, pairs[0][0].indenter.geometry.load_unit)
        _keep_worst(found, _checked(contacts, pairs[0][0], curves, records, law))
    if at_points.records and contacts.measured is not None:
        solved = np.array([not hasattr(outcome, "reason") for outcome in at_points.outcomes], dtype=bool)
        curves = contacts.measured.curves.select(solved)
        _keep_worst(found, _checked(contacts, at_points.of_records[0], curves, at_points.records, law))
    return list(found.values())


def _checked(
    contacts: Contacts, case: IndenterCase, curves: FrictionCurves, records: list[Record], law: InterfaceLaw | None
) -> Iterable[AssumptionCheck]:
    """Check contacts of one material, shape and load, with the thermal properties of the run file if it has any."""
    study = contacts.study
    reach = np.array([_reach(record) for record in records])
    material = contacts.rubbers[case.material].material
    settings: dict[str, Any] = {"thickness": study.conditions.thickness, "layer": case.layer, "contact_radius": reach}
    if study.heating is not None:
        settings |= {"rubber": study.heating.rubber, "counterbody": study.heating.counterface}
    checks = check_assumptions(material, case.indenter, _rubbed(curves, study, law), **settings)
    heated = study.heating is not None and (study.interface is None or law is not None)
    return (_beside_heated(check) if heated else check for check in checks)


def _rubbed(curves: FrictionCurves, study: Study, law: InterfaceLaw | None) -> FrictionCurves:
    """Return curves with the Coulomb friction of [interface] or [heating], the largest of several; not of measured."""
    heating = study.heating
    if curves.coulomb is not None:
        return curves
    if law is not None and study.interface is not None and curves.mean_pressure is not None:
        try:
            return with_interface(curves, law, study.interface.slip)
        except InputError:  # a note says where the law is not known
            return curves
    if heating is None or max(heating.coulomb) == 0.0:
        return curves
    slip = curves.speed if heating.slip is None else np.full(len(curves), max(heating.slip))
    return replace(curves, coulomb=np.full(len(curves), max(heating.coulomb)), slip=slip)


def _beside_heated(check: AssumptionCheck) -> AssumptionCheck:
    """Return a check of isothermal friction in a study that also has the heated one."""
    note = note_of(check.sentence)
    if note.code != "warming" or note.remedy is None:
        return check
    return replace(check, sentence=Note(note.code, note.text, note.where, _HEATED, note.values))


def _reach(record: Record) -> float:
    """Return half the contact's length or its half-width, whichever is larger, m."""
    along, across = 0.5 * (record.front + record.rear), record.half_width
    return max(along, across) if np.isfinite(across) else along


def _keep_worst(found: dict[str, AssumptionCheck], checks: Iterable[AssumptionCheck]) -> None:
    """Keep, of two checks of the same assumption, the one farther beyond its limit."""
    for check in checks:
        known = found.setdefault(check.name, check)
        if (check.holds is not False, -_share(check)) < (known.holds is not False, -_share(known)):
            found[check.name] = check


def _share(check: AssumptionCheck) -> float:
    return (check.value or 0.0) / (check.limit or 1.0)


# The compliance of a wave as long as a bonded or sliding layer is thick is that of a half-space within 1 %.
_THICKEST_WAVE = 1.0


def _surface_checks(study: Study, cases: Sequence[SurfaceCase]) -> list[AssumptionCheck]:
    """Check whether the rubber is a half-space for the longest wave; warnings of the contacts report steep slopes."""
    thickness = study.conditions.thickness
    if thickness is None or not cases:
        return []
    period = max(n * d for n, d in zip(*_grid(cases[0]), strict=True) if n > 1)
    longest = cases[0].surface.wavelengths[1] if isinstance(cases[0].surface, MadeSurface) else period
    value = longest / thickness
    holds = value <= _THICKEST_WAVE
    sentence = Note(
        "longest-wave",
        f"The longest wave of the surface, {1e3 * longest:.3g} mm, is {value:.2g} times as long as the rubber is "
        "thick; "
        + ("the rubber is a half-space for it." if holds else "give the rubber's thickness as a [layer] instead."),
        values={"wavelength": longest, "thickness": thickness},
    )
    return [AssumptionCheck.of("half-space", holds, sentence, value, _THICKEST_WAVE)]


def _grid(case: SurfaceCase) -> tuple[tuple[int, int], tuple[float, float]]:
    surface = surface_of(case.surface)
    return surface.shape, surface.spacing
