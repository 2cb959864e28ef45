"""Identification of a material from its friction at several speeds and temperatures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from viscofric.arguments import insist_on, insist_on_function, text, whole_number
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter, insist_on_round_edges
from viscofric.errors import InputError, wrong_argument
from viscofric.friction.curve_checks import shared_error
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.friction.identification.anchors import (
    Anchor,
    ContactAnchor,
    Known,
    ModulusAnchor,
    ModulusObservation,
    known_part,
)
from viscofric.friction.identification.conclusions import Outcome, conclude
from viscofric.friction.identification.forward import CorrectedFriction, FirstOrder
from viscofric.friction.identification.iteration import identify
from viscofric.friction.identification.points import Points, SharedErrors, usable_points
from viscofric.friction.identification.problem import OVERLAPPING, Problem, Shifts, Smoothness
from viscofric.friction.identification.result import IdentifiedMaterial, synthetic_notes
from viscofric.friction.identification.solving import Contacts
from viscofric.friction.shifting.found_shifts import CURVE_LEFT_OUT
from viscofric.friction.shifting.shift import shift_friction
from viscofric.nominal import SAME_TEMPERATURE, nominal_rows
from viscofric.notes import Note, codes
from viscofric.processes import Workers
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, checked_poisson_ratio, positive, share, shown_celsius, to_si

#: Usual error of solved contacts, as a part of the requested accuracy.
SOLVED_ERROR = 0.25
LEVELS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
#: Limits of what is asked for.
FEWEST_SAMPLES, FEWEST_MODES, MOST = 20, 8, 10**6
#: A smaller slope d ln μ/d ln v counts as this where errors in common move a curve along it.
LEAST_SLOPE = 0.05
#: Slope of the indenter at the contact's edge for a first guess of the level, and the standard deviation of ln |E|
#: about it where nothing is known: for a ball, slopes from 0.06 to 0.4 are within two standard deviations.
GUESSED_SLOPE = 0.15
GUESSED_SPREAD = 1.5
#: Largest relative errors in common: their effect is taken to first order.
LARGEST_SHARED = 0.2


@one_blas_thread
def identify_material(
    curves: FrictionCurves,
    *,
    indenter: Indenter,
    load: Quantity | None = None,
    shift: ShiftLaw | None = None,
    anchor: Anchor | Sequence[Anchor] | None = None,
    prior: Known | None = None,
    prior_band: tuple[Quantity, Quantity] | None = None,
    prior_error: Quantity = 0.02,
    level_error: Quantity = 0.0,
    common_error: Quantity = 0.0,
    drift_error: Quantity = 0.0,
    coulomb_level_error: Quantity = 0.0,
    temperature_error: Quantity = 0.0,
    reference: Quantity | None = None,
    poisson_ratio: Quantity = 0.5,
    modes: int = 30,
    levels: Sequence[float] = LEVELS,
    limit: Quantity = 0.05,
    samples: int = 200,
    seed: int = 0,
    accuracy: Quantity = 1e-3,
    name: str = "identified from friction",
    progress: Callable[[int, int, int], object] | None = None,
    workers: int = 1,
) -> IdentifiedMaterial:
    """Identify the retardation spectrum, and α(T), from friction.

    Parameters
    ----------
    curves : FrictionCurves
        Measured; points of infinite error are left out.
    indenter : Indenter
        Used for the measurement; rigid, on a half-space.
    load : float, str or pint.Quantity, optional
        Normal load of all points, N (of a line contact, N/m) if a plain number; each point has its own without it.
        Loads may differ for a Ball, an Ellipsoid, a Cone and a Cylinder, whose contacts are similar.
    shift : ShiftLaw, optional
        α(T), as from a DMA, with its covariance where it has one; found from the friction if left out.
    anchor : ModulusAnchor, ContactAnchor or several of them, optional
        Measurements that fix the magnitude of the modulus, which friction alone hardly determines.
    prior : Material, MaterialSamples or MasterCurve, optional
        E(ω) known over a part of the frequencies; it fixes the magnitude too.
    prior_band : (low, high), optional
        Angular frequencies at the prior's reference over which it is known, rad/s if plain numbers; by default those
        that it was measured or fitted at.
    prior_error : float or str
        Relative standard error of E' and E'' of the prior, four values of each per decade; samples have their own.
    level_error : float or str
        Relative standard error of friction that all points of a temperature share, another one at each temperature,
        such as 0.01 for samples changed between temperatures, or the difference of runs that `separate` notes.
    common_error : float or str
        Relative standard error of friction that all points share, such as of the calibration of force and load.
    drift_error : float or str
        Relative standard error of friction per decade of speed, the same at all temperatures.
    coulomb_level_error : float or str
        Relative standard error, shared by all points, of the Coulomb friction of the curves, which was subtracted.
        Without it, the standard error of one that `separate` was told to assume.
    temperature_error : float, str or pint.Quantity
        Standard error of every temperature of the rubber in the contact, K, at most 20 K, another one at each
        temperature.  Of friction at one temperature it needs `shift`.
    reference : float, str or pint.Quantity, optional
        Temperature at which the material is described, K if a plain number; without it, that of `shift`, or of the
        shift factors that are found.
    poisson_ratio : float or str
        Of the rubber.
    modes : int
        Retardation times; more are taken where these would be more than 0.4 decades apart.
    levels : sequence of float
        Without anchor and prior: factors of the modulus for which the best material is sought.
    limit : float or str
        Largest relative standard error of an identified modulus.
    samples : int
        Materials drawn from the posterior density.
    seed : int
        Of the draws.
    accuracy : float or str
        Relative error of each solved contact that is aimed at.
    name : str
        Of the material.
    progress : callable, optional
        Called as ``progress(step, done, total)`` after every contact of a step; there are three to five steps as a
        rule, and one for each level of the family.
    workers : int
        Processes that solve contacts.

    Returns
    -------
    IdentifiedMaterial

    Raises
    ------
    InputError
        If a value cannot be used, points are too few, friction without an error is not above zero, loads differ where
        contacts are not similar, or α(T) is neither given nor to be found because curves do not overlap.
    ConvergenceError
        If contacts cannot be solved, or the identification does not settle.

    Notes
    -----
    The unknowns are ln C_k on a geometric grid of τ that reaches 1.9 decades beyond the contact's frequencies, ln E_inf
    (faster modes act as a spring) and ln α.  The squared residuals of ln μ, of anchors and of the prior are minimised,
    with a random walk of second order over ln C as prior of the spectrum, of a level and slope that hardly matter; its
    roughness is averaged by the evidence.  ln μ is that of solved contacts with their adjoint derivatives at four
    reduced speeds per decade; between them, and for neighbouring materials, the difference between contacts and
    friction to first order in the loss is interpolated, and contacts are solved again until convergence, the first ones
    to 1 % only.  A step that does not improve the fit as predicted is shortened (a trust region).  The uncertainty is
    that of fits to other errors, of the measurement and of the prior (randomised maximum likelihood).

    Where some friction is within four standard errors of zero, or below, μ itself is fitted of points within ten.
    Errors of the points are taken as independent.  Those of replicates are moderated towards a common scatter.  Points
    more than two standard errors off the others weigh less by the square of their distance; those off by more than
    chance explains, if they are a tenth at most, have a note.  Errors that points share cannot be seen in the
    residuals: a fit follows them.  Those that are given (`level_error` …) are
    unknowns with these standard errors, and widen all bands; others are not in the bands.  Contacts are solved
    without shear: a note gives the effect of measured Coulomb friction on a half-space of the Poisson ratio; for thin
    rubber call `check_assumptions` with the material found, and its thickness.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="2 MPa", E_inf="6 MPa", tau="10 ms")
    >>> ball = vf.Ball(radius="10 mm")
    >>> response = [
    ...     vf.solve_steady(rubber, ball, speed=v, load="5 N", accuracy=1e-2).friction_coefficient
    ...     for v in np.geomspace(0.02, 2.0, 6)
    ... ]
    >>> known = np.full(6, 0.01) * response
    >>> curves = vf.FrictionCurves(
    ...     np.geomspace(0.02, 2.0, 6),
    ...     np.full(6, 300.0),
    ...     np.full(6, 5.0),
    ...     response,
    ...     known,
    ...     np.zeros(6),
    ...     np.ones(6, int),
    ... )
    >>> anchor = vf.friction.ModulusAnchor("3 MPa", "60 rad/s", temperature=300.0)
    >>> found = vf.identify_material(curves, indenter=ball, anchor=anchor, accuracy=3e-2, samples=20)
    >>> found.anchored
    True
    """
    insist_on_curves(curves, "curves")
    insist_on_indenter(indenter)
    insist_on_round_edges(indenter)
    poisson_ratio = checked_poisson_ratio(poisson_ratio)
    check_counts(modes, samples, seed)
    limit, prior_error, accuracy = (
        share(value, label, example=0.01)
        for label, value in (("limit", limit), ("prior_error", prior_error), ("accuracy", accuracy))
    )
    errors = SharedErrors(
        level=shared_error(level_error, "level_error"),
        common=shared_error(common_error, "common_error"),
        drift=shared_error(drift_error, "drift_error"),
        coulomb_level=shared_error(coulomb_level_error, "coulomb_level_error"),
        temperature=deviation(temperature_error, "delta_degC", "temperature_error"),
    )
    levels = _checked_levels(levels)
    text(name, "name")
    insist_on_function(progress, "progress")
    anchors = alone_or_many(anchor)
    assumed = errors.coulomb_level == 0.0
    points = usable_points(curves, indenter, load, SOLVED_ERROR * accuracy, assumed=assumed)
    kelvin = None if reference is None else positive(reference, "K", "reference")
    points, shifts = shifts_of(points, curves, shift, kelvin, [float(one.temperature) for one in anchors])
    notes = dict.fromkeys((*points.notes, *synthetic_notes(curves.source, shift, prior)))
    points = replace(errors.given_to(points, curves, shifts.per_kelvin), notes=tuple(notes))
    shifts = as_shared_errors_allow(points, shifts)
    moduli = [ModulusObservation.of(one) for one in anchors if isinstance(one, ModulusAnchor)]
    if prior is None and prior_band is not None:
        raise wrong_argument("prior_band", prior_band, "belongs to a prior; give it too.", "no-prior")
    if prior is not None:
        moduli.append(known_part(prior, prior_band, prior_error, shifts.reference))
    sizes = tuple(one for one in anchors if isinstance(one, ContactAnchor))
    with Workers(workers) as processes:
        contacts = Contacts(indenter, poisson_ratio, points.load, processes, sizes, progress)
        problem = problem_of(points, shifts, tuple(moduli), contacts, modes)
        try:
            fits, iterations = identify(problem, contacts.solved, problem.start, accuracy)
        except InputError as error:
            raise _with_cause(error, points) from None
        outcome = Outcome(curves, problem, fits, iterations, contacts, accuracy, shift, name, bool(moduli or sizes))
        return conclude(outcome, limit=limit, samples=samples, seed=seed, levels=levels)


def _with_cause(error: InputError, points: Points) -> InputError:
    """Return an error of a contact wider than the indenter with what leads materials there; others as they are."""
    if error.code != "beyond-indenter":
        return error
    largest = float(np.max(points.friction * np.exp(points.log_scale)))
    also = (
        f" It is the contact of a material that the friction, up to {largest:.2g} of the load, leads to: check load, "
        "indenter and anchor, and subtract friction other than the viscoelastic one."
    )
    return error.with_note(error.note.advising(also))


def _checked_levels(levels: Sequence[float]) -> tuple[float, ...]:
    if not isinstance(levels, (tuple, list)):
        raise wrong_argument(
            "levels", levels, "must be factors of the modulus, such as (0.5, 1.0, 2.0).", "not-a-number"
        )
    return tuple(positive(one, "dimensionless", "levels") for one in levels)


def deviation(value: Quantity, unit: str, name: str) -> float:
    """Return a standard deviation, zero or above; a part, or a temperature, is not large."""
    found = to_si(value, unit, name)
    most, to = {"dimensionless": (LARGEST_SHARED, f" to {LARGEST_SHARED:g}"), "delta_degC": (20.0, " to 20 K")}.get(
        unit, (np.inf, " on")
    )
    if not 0.0 <= found <= most:
        words = f"must be a standard deviation from 0{to}."
        raise wrong_argument(name, value, words, "out-of-range", name)
    return float(found)


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
        insist_on(one, "anchor", ModulusAnchor, ContactAnchor)
    return anchors


def shifts_of(
    points: Points, curves: FrictionCurves, shift: ShiftLaw | None, reference: float | None, others: Sequence[float]
) -> tuple[Points, Shifts]:
    """Return the shifts as unknowns, and the points at temperatures whose shifts are known or can be found."""
    # `reference` is the one requested, K; `others` are the temperatures of anchors, K.
    if shift is not None:
        insist_on(shift, "shift", ShiftLaw, right="a law (WLF, …) or ShiftFactors")
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
                f"{wanted} was not measured, only {shown_celsius(only)} °C was; give the shift factors.",
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
        count = int(np.count_nonzero(~kept))
        said = f"{count} points of temperatures without shift factors were left out."
        notes = (*notes, *found.notes, Note("points-left-out", said, values={"points": count}))
    chosen = replace(points.chosen(kept), temperatures=found.temperatures, number=number[kept], notes=notes)
    return chosen, Shifts.unknown(found.temperatures, nearest, found)


def as_shared_errors_allow(points: Points, shifts: Shifts) -> Shifts:
    """Return shifts that may differ from the overlap's as the errors allow that points have in common."""
    # An error moves the curve of a temperature along a slope by as much as it differs there from a line over all
    # points: a line in the reduced speed tilts the master curve and moves no curve along it.
    # One larger than friction itself moves its logarithm by one at most.
    shared = np.clip(points.shared, -1.0, 1.0)
    if not shared.shape[1] or not shifts.found or len(shifts.middle) == 1:
        return shifts
    lines = np.stack([np.ones(len(points)), points.log_speed + shifts.middle[points.number]], axis=1)
    away = shared - lines @ np.linalg.lstsq(lines, shared, rcond=None)[0]
    moved = np.zeros(len(shifts.middle))
    for one in np.unique(points.number):
        rows = points.number == one
        speed = points.log_speed[rows] - points.log_speed[rows].mean()
        slope = abs(float(speed @ points.log_scale[rows])) / max(float(speed @ speed), 1e-300)
        moved[one] = OVERLAPPING * np.linalg.norm(away[rows].mean(axis=0)) / max(slope, LEAST_SLOPE)
    moved[shifts.temperatures == shifts.reference] = 0.0
    return shifts.widened(moved)


def _not_among(reference: float, found: ShiftFactors, points: Points) -> InputError:
    """Return an error on a reference without α, because it was not measured or its curve does not overlap."""
    shown = ", ".join(shown_celsius(float(one)) for one in found.temperatures)
    wanted = f"{shown_celsius(reference)} °C"
    if np.abs(points.temperatures - reference).min() > SAME_TEMPERATURE:
        return InputError(
            f"reference = {wanted} was not measured, and α(T) is to be found; choose one of {shown} °C: its shift "
            "factors describe the material at another.",
            code="no-such-temperature",
        )
    why = "; ".join(f"{note[0].lower()}{note[1:-1]}" for note in found.notes if codes([note]) == {CURVE_LEFT_OUT})
    return InputError(
        f"reference = {wanted}: α(T) is to be found, and {why}; choose one of {shown} °C, give "
        "the shift factors, or measure there over more speeds.",
        code="no-such-temperature",
    )


def problem_of(
    points: Points, shifts: Shifts, moduli: tuple[ModulusObservation, ...], contacts: Contacts, modes: int
) -> Problem:
    """Return the problem to first order in the loss, on a grid of retardation times about the contact's frequencies."""
    plane_strain = 1.0 - contacts.poisson_ratio**2
    compliance = _first_guess(moduli, contacts, plane_strain)
    radius = Scale.for_load(contacts.indenter, 1.0 / (plane_strain * compliance), points.load).length
    log_frequency = points.log_speed + shifts.middle[points.number] - np.log(radius)
    inside = -float(log_frequency.max()), -float(log_frequency.min())
    if not moduli and not contacts.anchors:
        middle = -0.5 * sum(inside), shifts.reference
        moduli = (ModulusObservation.single(*middle, -np.log(compliance), GUESSED_SPREAD, "magnitude"),)
    smoothness = Smoothness.about(*inside, compliance, modes)
    return Problem(
        friction=CorrectedFriction(FirstOrder(contacts.indenter, points.load, plane_strain, smoothness.tau)),
        points=points,
        moduli=moduli,
        shifts=shifts,
        smoothness=smoothness,
    )


def _first_guess(moduli: tuple[ModulusObservation, ...], contacts: Contacts, plane_strain: float) -> float:
    """Return a compliance, 1/Pa: that of the known moduli, or that of a contact of moderate slope."""
    if moduli:
        return float(np.exp(-np.mean(np.concatenate([one.log_modulus for one in moduli]))))
    logarithms = np.linspace(np.log(1e-3), np.log(1e15), 181)
    slopes = [Scale.for_load(contacts.indenter, float(np.exp(one)), contacts.load).slope for one in logarithms]
    # Slopes fall as stiffness rises; a cone's is constant.
    place = int(np.argmin(np.abs(np.log(np.array(slopes) / GUESSED_SLOPE))))
    return float(np.exp(-logarithms[place])) / plane_strain
