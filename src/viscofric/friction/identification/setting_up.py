"""Set-up of an identification: unknown shifts and moduli, the grid of retardation times, the first guess."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import whole_number
from viscofric.contact.free.scale import Scale
from viscofric.errors import InputError
from viscofric.friction.identification.anchors import Anchor, ContactAnchor, ModulusAnchor
from viscofric.friction.identification.forward import CorrectedFriction, FirstOrder
from viscofric.friction.identification.moduli import ModulusObservation
from viscofric.friction.identification.problem import OVERLAPPING, Problem, Shifts, Smoothness
from viscofric.friction.shifting.found_shifts import LEFT_OUT
from viscofric.friction.shifting.shift import shift_friction
from viscofric.nominal import SAME_TEMPERATURE, nominal_rows
from viscofric.notes import codes
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.identification.moduli import Block
    from viscofric.friction.identification.points import Points
    from viscofric.friction.identification.solving import Contacts
    from viscofric.rheology.shifts.shift_factors import ShiftFactors


#: Limits of what is asked for.
FEWEST_SAMPLES, FEWEST_MODES, MOST = 20, 8, 10**6
#: A smaller slope d ln μ/d ln v counts as this where errors in common move a curve along it.
LEAST_SLOPE = 0.05
#: Slope of the indenter at the contact's edge for a first guess of the level, and the standard deviation of ln |E|
#: about it where nothing is known: for a ball, slopes from 0.06 to 0.4 are within two standard deviations.
GUESSED_SLOPE = 0.15
GUESSED_SPREAD = 1.5


def check_counts(modes: int, samples: int, seed: int) -> None:
    """Raise `InputError` for numbers of modes and of samples, or a seed, that cannot be used."""
    whole_number(modes, "modes", FEWEST_MODES, MOST)
    whole_number(samples, "samples", FEWEST_SAMPLES, MOST)
    whole_number(seed, "seed", 0)


def alone_or_many(anchor: Anchor | Sequence[Anchor] | None) -> tuple[Anchor, ...]:
    """Return anchors as a tuple; InputError if something else is among them."""
    if anchor is None:
        return ()
    anchors = tuple(anchor) if isinstance(anchor, (list, tuple)) else (anchor,)
    for one in anchors:
        if not isinstance(one, (ModulusAnchor, ContactAnchor)):
            raise InputError(
                f"anchor must be a ModulusAnchor or a ContactAnchor, not {type(one).__name__}.", code="wrong-type"
            )
    return anchors


def shifts_of(
    points: Points, curves: FrictionCurves, shift: ShiftLaw | None, reference: float | None, others: Sequence[float]
) -> tuple[Points, Shifts]:
    """Return the shifts as unknowns, and the points at temperatures whose shifts are known or can be found.

    `reference` is the one requested, K; `others` are the temperatures of anchors, K.  Raises InputError if the shift is
    no shift law, or not known at a temperature; if it is to be found and curves do not overlap, or the reference was
    not measured.
    """
    if shift is not None:
        if not isinstance(shift, ShiftLaw):
            raise InputError(
                f"shift must be a law (WLF, …) or ShiftFactors, not {type(shift).__name__}.", code="wrong-type"
            )
        law = shift if reference is None else shift.at_reference(reference)
        everywhere = np.unique(np.concatenate([points.temperatures, [law.reference], others]))
        number = np.searchsorted(everywhere, points.temperatures)[points.number]
        return replace(points, temperatures=everywhere, number=number), Shifts.known(everywhere, law)
    if len(nominal_rows(points.temperatures)) == 1:
        only = float(points.temperatures[points.number].mean())
        points = replace(points, temperatures=np.array([only]), number=np.zeros_like(points.number))
        if reference is not None and abs(reference - only) > SAME_TEMPERATURE:
            wanted = f"reference = {shown_celsius(reference)} °C"
            raise InputError(
                f"{wanted} was not measured, only {shown_celsius(only)} °C was; give shift=.",
                code="no-such-temperature",
            )
        return points, Shifts.unknown(points.temperatures, only)
    # Points are at one load already, where contacts at different loads are similar.
    alike = points.at_one_load(curves)
    found = shift_friction(alike).shift_factors
    away = np.abs(points.temperatures[points.number][:, None] - found.temperatures)
    number, kept = away.argmin(axis=1), away.min(axis=1) <= SAME_TEMPERATURE
    middle = float(found.reference) if reference is None else reference
    nearest = float(found.temperatures[np.argmin(np.abs(found.temperatures - middle))])
    if reference is not None and abs(nearest - reference) > SAME_TEMPERATURE:
        raise _not_among(reference, found, points)
    notes = points.notes
    if not kept.all():
        notes = (*notes, *found.notes, f"{np.count_nonzero(~kept)} points were left out with them.")
    chosen = replace(points.chosen(kept), temperatures=found.temperatures, number=number[kept], notes=notes)
    return chosen, Shifts.unknown(found.temperatures, nearest, found)


def with_shared_errors(points: Points, shifts: Shifts, shared: Array) -> tuple[Points, Shifts]:
    """Return points with more errors in common (n, k), and shifts that may differ as these allow from the overlap's.

    An error moves the curve of a temperature along a slope by as much as it differs there from a line over all points:
    a line in the reduced speed tilts the master curve and moves no curve along it.
    """
    shared = np.hstack([points.shared, shared])
    points = replace(points, shared=shared)
    if not shared.shape[1] or not shifts.found or len(shifts.middle) == 1:
        return points, shifts
    lines = np.stack([np.ones(len(points)), points.log_speed + shifts.middle[points.number]], axis=1)
    away = shared - lines @ np.linalg.lstsq(lines, shared, rcond=None)[0]
    moved = np.zeros(len(shifts.middle))
    for one in np.unique(points.number):
        rows = points.number == one
        speed = points.log_speed[rows] - points.log_speed[rows].mean()
        slope = abs(float(speed @ points.log_friction[rows])) / max(float(speed @ speed), 1e-300)
        moved[one] = OVERLAPPING * np.linalg.norm(away[rows].mean(axis=0)) / max(slope, LEAST_SLOPE)
    moved[shifts.temperatures == shifts.reference] = 0.0
    return points, shifts.widened(moved)


def _not_among(reference: float, found: ShiftFactors, points: Points) -> InputError:
    """Return an error on a reference without α, because it was not measured or its curve does not overlap."""
    shown = ", ".join(shown_celsius(float(one)) for one in found.temperatures)
    wanted = f"{shown_celsius(reference)} °C"
    if np.abs(points.temperatures - reference).min() > SAME_TEMPERATURE:
        return InputError(
            f"reference = {wanted} was not measured, and α(T) is to be found; choose one of {shown} °C, and describe "
            "the material at another with its at_reference().",
            code="no-such-temperature",
        )
    why = "; ".join(f"{note[0].lower()}{note[1:-1]}" for note in found.notes if codes([note]) == {LEFT_OUT})
    return InputError(
        f"reference = {wanted}: α(T) is to be found, and {why}; choose one of {shown} °C, give "
        "shift=, or measure there over more speeds.",
        code="no-such-temperature",
    )


def problem_of(points: Points, shifts: Shifts, moduli: tuple[Block, ...], contacts: Contacts, modes: int) -> Problem:
    """Return the problem to first order in the loss, on a grid of retardation times about the contact's frequencies."""
    plane_strain = 1.0 - contacts.poisson_ratio**2
    compliance = _first_guess(moduli, contacts, plane_strain)
    radius = Scale.for_load(contacts.indenter, 1.0 / (plane_strain * compliance), points.load).length
    log_frequency = points.log_speed + shifts.middle[points.number] - np.log(radius)
    inside = -float(log_frequency.max()), -float(log_frequency.min())
    if not moduli and not contacts.anchors:
        moduli = (_guess(-0.5 * sum(inside), shifts.reference, compliance),)
    smoothness = Smoothness.about(*inside, compliance, modes)
    return Problem(
        friction=CorrectedFriction(FirstOrder(contacts.indenter, points.load, plane_strain, smoothness.tau)),
        points=points,
        moduli=moduli,
        shifts=shifts,
        smoothness=smoothness,
    )


def _guess(log_frequency: float, temperature: float, compliance: float) -> Block:
    level = ModulusObservation(np.array([log_frequency]), temperature, "magnitude", np.array([-np.log(compliance)]))
    return (level,), np.array([[1.0 / GUESSED_SPREAD]])


def _first_guess(moduli: tuple[Block, ...], contacts: Contacts, plane_strain: float) -> float:
    """Return a compliance, 1/Pa: that of the known moduli, or that of a contact of moderate slope."""
    if moduli:
        return float(np.exp(-np.mean(np.concatenate([one.log_modulus for together, _ in moduli for one in together]))))
    logarithms = np.linspace(np.log(1e-3), np.log(1e15), 181)
    slopes = [Scale.for_load(contacts.indenter, float(np.exp(one)), contacts.load).slope for one in logarithms]
    # Slopes fall as stiffness rises; a cone's is constant.
    place = int(np.argmin(np.abs(np.log(np.array(slopes) / GUESSED_SLOPE))))
    return float(np.exp(-logarithms[place])) / plane_strain
