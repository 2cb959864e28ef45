"""Set-up of an identification from indentation: usable records, their temperatures, shifts and retardation times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.grids import Extent
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, FlatPunch
from viscofric.errors import InputError, SuperpositionError
from viscofric.friction.identification.anchors import ModulusAnchor
from viscofric.friction.identification.indentation.contact import EXACT, Contact, Known, Shared
from viscofric.friction.identification.indentation.growing import growing
from viscofric.friction.identification.indentation.impacts import Impacts
from viscofric.friction.identification.indentation.moving import Moving
from viscofric.friction.identification.indentation.problem import IndentationProblem, fitted_by_springs
from viscofric.friction.identification.indentation.record import IndentationRecord
from viscofric.friction.identification.indentation.rows import Reduced, shrinks, usable_rows
from viscofric.friction.identification.indentation.tables import OscillationRecord, ReboundRecord
from viscofric.friction.identification.iteration import most_evident
from viscofric.friction.identification.posterior import descend
from viscofric.friction.identification.problem import Shifts, Smoothness
from viscofric.friction.identification.solving import spectrum_of
from viscofric.motion.springs import elastic_radius
from viscofric.nominal import SAME_TEMPERATURE, numbered
from viscofric.notes import Note
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.superposition.superpose import superpose
from viscofric.step_tests import StepTest, StepTests
from viscofric.units import shown_celsius

Record: TypeAlias = IndentationRecord | ReboundRecord | OscillationRecord | ModulusAnchor

#: Relative error of responses whose error is not given, for the first fit.
FIRST_ERROR = 0.01
#: Fewest averaged rows of a record.
LEAST_POINTS = 5
#: Times per decade at which J(t) of one temperature is superposed.
SUPERPOSED = 10


@dataclass(frozen=True, eq=False)
class Usable:
    """Records with the contacts that can be used, and the temperatures of these."""

    records: tuple[Record, ...]
    contacts: tuple[Contact, ...]
    temperatures: Array  # (t,), ascending, K
    number: tuple[int, ...]  # of each record's temperature
    notes: tuple[Note, ...]

    def chosen(self, kept: Sequence[int], notes: Sequence[Note] = ()) -> Usable:
        """Return the records at some of the temperatures, by their numbers."""
        rows = [row for row, number in enumerate(self.number) if number in kept]
        renumbered = tuple(list(kept).index(self.number[row]) for row in rows)
        return Usable(
            tuple(self.records[row] for row in rows), tuple(self.contacts[row] for row in rows),
            self.temperatures[list(kept)], renumbered, (*self.notes, *notes),
        )  # fmt: skip


def usable_records(records: Sequence[Record], indenter: Indenter, shared: Shared) -> Usable:
    """Return the contacts of the records; InputError if a record has too few usable rows."""
    contacts, notes, deepest = [], [], 0.0
    by_radius = _by_radius(indenter) if shared.radius > 0.0 else 0.0
    for number, record in enumerate(records, 1):
        if isinstance(record, IndentationRecord):
            contact, unclear = _of_rows(record, number, indenter, shared, by_radius)
            deepest = max(deepest, float(np.max(record.indentation)))
            contacts.append(contact)
            if unclear:
                said = (
                    f"Record {number}: {unclear} of {len(record)} rows were left out, as the response is not clearly "
                    "above its scatter or, at the end of the contact, above 5 % of its largest value."
                )
                notes.append(Note("unclear-left-out", said, values={"record": number, "rows": unclear}))
        elif isinstance(record, ReboundRecord):
            contacts.append(Impacts.of(record, indenter, shared))
        elif isinstance(record, OscillationRecord):
            contacts.append(_of_stiffness(record, indenter, shared))
            deepest = max(deepest, record.indentation)
        else:
            frequency, modulus = (np.array([float(one)]) for one in (record.angular_frequency, record.modulus))
            contacts.append(Known.of(frequency, {f"{record.part}_modulus": (modulus, record.error)}))
    if deepest > 0.0:
        widest = Reduced(indenter, deepest).radius
        strained = indenter.strain_warning(Extent(widest, widest, widest), deepest)
        if strained is not None:
            notes.append(strained)
    kelvin = np.array([float(record.temperature) for record in records])
    labels = numbered(kelvin, np.full(len(kelvin), SAME_TEMPERATURE))
    temperatures = np.array([kelvin[labels == label].mean() for label in range(int(labels.max()) + 1)])
    return Usable(tuple(records), tuple(contacts), temperatures, tuple(int(one) for one in labels), tuple(notes))


def _of_rows(
    record: IndentationRecord, number: int, indenter: Indenter, shared: Shared, by_radius: float
) -> tuple[Contact, int]:
    """Return the contact of a record over time, and the number of its rows left out."""
    largest = float(np.max(record.indentation))
    if largest <= 0.0 or float(np.max(record.load)) <= 0.0:
        raise InputError(
            f"record {number}: its load or its indentation is never above zero.", code="no-contact", field="records"
        )
    reduced = Reduced(indenter, largest)
    end = len(record) if indenter.has_walls else shrinks(record)
    rows = usable_rows(record, reduced, end)
    count = 0 if rows is None else len(rows)
    if rows is None or count < LEAST_POINTS:
        raise InputError(
            f"record {number}: in only {count} averaged rows the response is clearly above its scatter; at least "
            f"{LEAST_POINTS} are needed.",
            code="no-clear-response",
            field="records",
        )
    if end < len(record):
        return Moving(**vars(rows), indenter=indenter, reduced=reduced, shared=shared), rows.unclear
    return growing(rows, reduced, shared, by_radius), rows.unclear


def _of_stiffness(record: OscillationRecord, indenter: Indenter, shared: Shared) -> Known:
    """Return the contact of an oscillation about a depth."""
    depth = record.indentation
    radius = elastic_radius(indenter, depth, None, 1.0)
    step = 1e-4
    by_depth = np.log(elastic_radius(indenter, depth * (1.0 + step), None, 1.0) / radius) / (step * depth)
    # At a given depth a body of revolution with n parts of X by its radius has a contact radius ∝ R^n.
    by_radius = _by_radius(indenter) if shared.radius > 0.0 else 0.0
    values = {name: (getattr(record, name), record.error[name]) for name in ("storage_stiffness", "loss_stiffness")}
    contact = {"diameter": 2.0 * radius, "by_radius": by_radius, "by_depth": float(by_depth), "shared": shared}
    return Known.of(record.angular_frequency, values, **contact)


def _by_radius(indenter: Indenter) -> float:
    """Return d ln X/d ln R at a given depth; InputError if the indenter has no radius."""
    if not isinstance(indenter, (Ball, FlatPunch)):
        raise InputError(
            f"radius_error: a {indenter.noun} has no radius; leave it out.", code="no-radius", field="radius_error"
        )
    return 0.5 if isinstance(indenter, Ball) else 1.0


def problem_of(
    usable: Usable, shifts: Shifts, plane_strain: float, extra: float, modes: int, shared: Shared = EXACT
) -> IndentationProblem:
    """Return the problem on a grid of retardation times about the measured times."""
    alpha = shifts.middle[list(usable.number)]
    low = min(np.log(one.lags[0]) - by for one, by in zip(usable.contacts, alpha, strict=True))
    high = max(np.log(one.lags[1]) - by for one, by in zip(usable.contacts, alpha, strict=True))
    smoothness = Smoothness.about(low, high, _first_guess(usable.contacts, plane_strain), modes)
    errors = np.concatenate(
        [FIRST_ERROR / np.sqrt(one.count) if one.error is None else one.error for one in usable.contacts]
    )
    return IndentationProblem(
        shifts, smoothness, usable.contacts, usable.number, errors, plane_strain, extra, shared
    )  # fmt: skip


def _first_guess(contacts: Sequence[Contact], plane_strain: float) -> float:
    """Return the mean of the compliances of elastic contacts, 1/Pa; InputError if none shows."""
    logs = [log - np.log(plane_strain) for one in contacts if (log := one.log_elastic) is not None]
    logs += [-np.log(one.response[0]) for one in contacts if isinstance(one, Known) and one.diameter is None]
    if not logs:
        raise InputError(
            "records: the restitution alone does not determine the level of the modulus; measure the contact times, "
            "the largest forces or the depths too, or add another record or a ModulusAnchor.",
            code="level-unknown",
            field="records",
        )
    return float(np.exp(np.mean(logs)))


def shifts_of(
    usable: Usable, shift: ShiftLaw | None, reference: float | None, plane_strain: float, extra: float
) -> tuple[Usable, Shifts]:
    """Return the shifts as unknowns, and the records at temperatures whose shifts are known or can be found."""
    kelvin = usable.temperatures
    if shift is not None:
        law = shift if reference is None else shift.at_reference(reference)
        everywhere = np.unique(np.append(kelvin, law.reference))
        places = np.searchsorted(everywhere, kelvin)
        number = tuple(int(places[one]) for one in usable.number)
        return replace(usable, temperatures=everywhere, number=number), Shifts.known(everywhere, law)
    nearest = int(np.argmin(np.abs(kelvin - (np.median(kelvin) if reference is None else reference))))
    if reference is not None and abs(kelvin[nearest] - reference) > SAME_TEMPERATURE:
        measured = ", ".join(shown_celsius(float(one)) for one in kelvin)
        raise InputError(
            f"reference = {shown_celsius(reference)} °C was not measured, only {measured} °C; give the shift "
            "factors, or choose one of these: its shift factors describe the material at another.",
            code="no-such-temperature",
            field="reference",
        )
    if len(kelvin) == 1:
        return usable, Shifts.unknown(kelvin, float(kelvin[0]))
    alone = [_creep(usable.chosen([place]), plane_strain, extra) for place in range(len(kelvin))]
    try:
        found = superpose(StepTests(tuple(alone), kind="creep"), float(kelvin[nearest]))
    except SuperpositionError as error:
        raise InputError(
            f"records: α(T) is to be found, and J(t) of the temperatures does not overlap: {error}", code="no-overlap",
            field="records",
        ) from None  # fmt: skip
    kept = [
        place
        for place, one in enumerate(kelvin)
        if np.abs(found.shift_factors.temperatures - one).min() <= 0.5 * SAME_TEMPERATURE
    ]
    notes = [note for note in found.notes if isinstance(note, Note)]
    usable = usable.chosen(kept, notes)
    return usable, Shifts.unknown(usable.temperatures, float(kelvin[nearest]), found.shift_factors)


def _creep(usable: Usable, plane_strain: float, extra: float) -> StepTest:
    """Return J(t) of the records at one temperature over the measured times, fitted without the other records."""
    kelvin = float(usable.temperatures[0])
    problem = problem_of(usable, Shifts.unknown(usable.temperatures, kelvin), plane_strain, extra, 0)
    if any(one.by_springs for one in usable.contacts):
        place = most_evident(fitted_by_springs(problem, problem.start)).minimum.place
    else:
        place = descend(problem, problem.start, metric=problem.metric).place
    spectrum = spectrum_of(problem.split(place)[0], problem.smoothness.tau)
    low = min(one.lags[0] for one in usable.contacts)
    high = max(one.lags[1] for one in usable.contacts)
    time = np.geomspace(low, high, max(LEAST_POINTS, int(SUPERPOSED * np.log10(high / low)) + 1))
    return StepTest(kelvin, time, spectrum.creep_compliance(time))
