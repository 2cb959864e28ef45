"""Predictions at many speeds and temperatures, interpolated between the contacts of their curve."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, cast

from viscofric.contact.settings import ContactSettings
from viscofric.errors import ConvergenceError, InputError, ViscofricError
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import solve
from viscofric.friction.planning.plan import Plan
from viscofric.processes import Workers, at_work, call_all
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import positive

# What is not a setting of a contact, and the settings that its place on a curve depends on.
_OF_CONTACT = {"material", "indenter", "speed", "load", "temperature", "accuracy"}
_OF_CURVES = {"layer", "indenter_modulus", "indenter_poisson_ratio"}


def places_of(contacts: Sequence[dict[str, Any]]) -> list[tuple[float, float]]:
    """Return the speeds and temperatures of contacts."""
    return [(contact["speed"], contact["temperature"]) for contact in contacts]


@dataclass(eq=False)
class SharedContacts:
    """Contacts that differ in speed and temperature only, interpolated between those on their curve.

    What has been solved is kept for further contacts.  A call raises InputError or ConvergenceError of the first
    contact that cannot be solved, and cannot be interpolated either; `outcomes` returns it.
    """

    material: Material
    case: IndenterCase
    accuracy: float
    sensitive: bool
    workers: int | Workers
    report: Callable[[int], None]
    _known: dict[str, Record | ViscofricError] = field(default_factory=dict)
    _asked: list[IndenterCase] = field(default_factory=list)

    @classmethod
    def of(
        cls,
        material: Material,
        contacts: Sequence[dict[str, Any]],
        workers: int | Workers,
        report: Callable[[int], None],
        *,
        sensitive: bool = False,
    ) -> SharedContacts | None:
        """Return the shared contacts of which these, arguments of `solve_steady` each, are some."""
        # None where each is better solved by itself: for few contacts, a table of moduli, and settings that belong to
        # one grid or direction.
        first = contacts[0]
        accuracy = first["accuracy"]
        given = {name: value for name, value in first.items() if name not in _OF_CONTACT}
        settings, usual = ContactSettings(accuracy=accuracy, **given), ContactSettings(accuracy=accuracy)
        if settings.residual == usual.residual:
            usual = replace(usual, tolerance=settings.tolerance)
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
        case = IndenterCase(0, **{name: first[name] for name in of_case}, **body)
        found = cls(material, case, accuracy, sensitive, workers, report)
        return found if found._plan(found._cases(places_of(contacts))).shares else None

    def __call__(self, places: Sequence[tuple[float, float]]) -> list[Record]:
        """Return the records of contacts at speeds, m/s, and temperatures, K."""
        outcomes = self.outcomes(places)
        for one in outcomes:
            if isinstance(one, ViscofricError):
                raise one
        return cast("list[Record]", outcomes)

    def outcomes(self, places: Sequence[tuple[float, float]]) -> list[Record | ViscofricError]:
        """Return the records of contacts, or their errors."""
        cases = self._cases(places)
        # Contacts asked for before make the curve worth its nodes, which are known.
        plan = self._plan([*cases, *self._asked])
        self._asked += cases
        with at_work(self.workers) as processes:
            self._carry_out(plan, processes)
        errors = {str(one): one for one in self._known.values() if isinstance(one, ViscofricError)}
        found = [
            errors.get(one.reason, InputError(one.reason, code=one.code)) if isinstance(one, Failure) else one
            for one in plan.found()[: len(cases)]
        ]
        self.report(plan.total)
        return found

    def _cases(self, places: Sequence[tuple[float, float]]) -> list[IndenterCase]:
        return [replace(self.case, speed=speed, temperature=kelvin) for speed, kelvin in places]

    def _plan(self, cases: Sequence[IndenterCase]) -> Plan:
        return Plan(cases, [self.material], accuracy=self.accuracy, sensitive=self.sensitive)

    def _carry_out(self, plan: Plan, workers: Workers) -> None:
        """Solve the contacts of a plan wave by wave; report the cases known, and those begun of the present wave."""
        most = 0

        def told(known: int, solved: int) -> None:
            nonlocal most
            most = max(most, min(known + solved, plan.total - 1))
            self.report(most)

        while tasks := plan.wanted():
            new = [task for task in tasks if task.key not in self._known]
            calls = [{"function": solve, "task": task} for task in new]
            outcomes = call_all(attempt, calls, workers=workers, progress=partial(told, plan.done))
            self._known |= {task.key: outcome for task, outcome in zip(new, outcomes, strict=True)}
            for task in tasks:
                outcome = self._known[task.key]
                failed = isinstance(outcome, ViscofricError)
                plan.receive(task.key, Failure.of(outcome, task.label) if failed else outcome)  # type: ignore[arg-type]


def _same(value: object, usual: object) -> bool:
    return value is usual or (isinstance(value, int | float | str | tuple) and value == usual)


def attempt(function: Callable[..., Record], **arguments: Any) -> Record | ViscofricError:
    """Return the record of a contact, or its error: of a curve's contact it is no failure of the cases."""
    try:
        return function(**arguments)
    except (ConvergenceError, InputError) as error:
        return error
