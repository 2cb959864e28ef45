"""Predictions at many speeds and temperatures, interpolated between the contacts of their curve."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from viscofric.contact.settings import ContactSettings
from viscofric.errors import ConvergenceError, InputError, ViscofricError
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import solve
from viscofric.friction.planning.plan import plan_cases
from viscofric.processes import Workers, call_all
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import positive

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from viscofric.friction.cases.solving import Task
    from viscofric.friction.planning.plan import Plan
    from viscofric.rheology.material import Material

# What is not a setting of a contact, and the settings that its place on a curve depends on.
_OF_CONTACT = {"material", "indenter", "speed", "load", "temperature", "accuracy"}
_OF_CURVES = {"layer", "indenter_modulus", "indenter_poisson_ratio"}


def shared_records(
    material: Material,
    contacts: Sequence[dict[str, Any]],
    *,
    sensitive: bool,
    workers: int | Workers,
    report: Callable[[int], None],
) -> list[Record] | None:
    """Return the records of contacts, arguments of `solve_steady` each; None where each is better solved by itself.

    That is so for few contacts, a table of moduli, and settings that belong to one grid or direction.

    Raises
    ------
    InputError, ConvergenceError
        Of the first contact that cannot be solved, and cannot be interpolated either.
    """
    accuracy = contacts[0]["accuracy"]
    given = {name: value for name, value in contacts[0].items() if name not in _OF_CONTACT}
    settings, usual = ContactSettings(accuracy=accuracy, **given), ContactSettings(accuracy=accuracy)
    special = any(not _same(getattr(settings, name), getattr(usual, name)) for name in given.keys() - _OF_CURVES)
    if special or material.shift is None or not isinstance(material.spectrum, RetardationSpectrum):
        return None
    modulus = settings.indenter_modulus
    body: dict[str, Any] = {
        "layer": settings.layer,
        "modulus": None if modulus is None else positive(modulus, "Pa", "indenter_modulus"),
        "poisson_ratio": settings.indenter_poisson_ratio,
    }
    of_case = ("indenter", "speed", "load", "temperature")
    cases = [IndenterCase(0, **{name: contact[name] for name in of_case}, **body) for contact in contacts]
    plan = plan_cases(cases, [material], accuracy=accuracy, sensitive=sensitive)
    if not plan.shares:
        return None
    errors: dict[str, ViscofricError] = {}
    if isinstance(workers, Workers):
        found = _carried_out(plan, workers, report, errors)
    else:
        with Workers(workers) as alone:
            found = _carried_out(plan, alone, report, errors)
    complete = not sensitive or all(record.sensitivity is not None for record in found)
    return found if complete else None


def _same(value: object, usual: object) -> bool:
    return value is usual or (isinstance(value, int | float | str | tuple) and value == usual)


def _carried_out(
    plan: Plan, workers: Workers, report: Callable[[int], None], errors: dict[str, ViscofricError]
) -> list[Record]:
    """Solve the contacts of a plan wave by wave; report the cases known, and those begun of the present wave."""
    most = 0

    def told(known: int, solved: int) -> None:
        nonlocal most
        most = max(most, min(known + solved, plan.total - 1))
        report(most)

    while tasks := plan.wanted():
        before = plan.done
        calls = [{"task": task} for task in tasks]
        outcomes = call_all(_attempt, calls, workers=workers, progress=partial(told, before))
        for task, outcome in zip(tasks, outcomes, strict=True):
            if isinstance(outcome, ViscofricError):
                errors[str(outcome)] = outcome
                plan.receive(task.key, Failure.of(outcome, task.label))
            else:
                plan.receive(task.key, outcome)
    found: list[Record] = []
    for outcome in plan.found():
        if isinstance(outcome, Failure):
            raise errors.get(outcome.reason, InputError(outcome.reason, code=outcome.code))
        found.append(outcome)
    report(plan.total)
    return found


def _attempt(task: Task) -> Record | ViscofricError:
    """Return the record of a task, or its error: of a curve's contact it is no failure of the cases."""
    try:
        return solve(task)
    except (ConvergenceError, InputError) as error:
        return error
