"""Identification of a material from indentation over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import get_args

import numpy as np

from viscofric.arguments import insist_on, text
from viscofric.arrays import Array
from viscofric.contact.bodies import indenter_compliance
from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter
from viscofric.errors import InputError
from viscofric.friction.identification.identify import check_counts, deviation
from viscofric.friction.identification.indentation.conclusions import conclude
from viscofric.friction.identification.indentation.contact import Shared
from viscofric.friction.identification.indentation.problem import IndentationProblem, fitted_by_springs
from viscofric.friction.identification.indentation.result import MaterialFromIndentation
from viscofric.friction.identification.indentation.setting_up import Record, problem_of, shifts_of, usable_records
from viscofric.friction.identification.iteration import Weighed, freedom_of, misfit, most_evident, weighed
from viscofric.friction.identification.posterior import descend
from viscofric.motion.springs import is_body_of_revolution
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, checked_poisson_ratio, positive, share

#: Errors are estimated again from the residuals while they change by more than this, up to this many times.
SETTLED, PASSES = 0.05, 4
#: Smallest relative error of a response, from discretisation in time.
LEAST_ERROR = 1e-4


@one_blas_thread
def identify_from_indentation(
    records: Record | Sequence[Record],
    indenter: Indenter,
    *,
    shift: ShiftLaw | None = None,
    reference: Quantity | None = None,
    poisson_ratio: float = 0.5,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: float = 0.3,
    radius_error: float = 0.0,
    load_error: float = 0.0,
    zero_error: Quantity = 0.0,
    modes: int = 30,
    limit: float = 0.05,
    samples: int = 200,
    seed: int = 0,
    name: str = "identified from indentation",
) -> MaterialFromIndentation:
    """Identify the retardation spectrum, and α(T), from indentation tests and rebounds.

    Creep (the depth after a step of load), relaxation (the load after a step of depth), and any other load and depth
    over time, such as ramps, unloading and oscillations; stiffness over frequency; restitution, contact time, largest
    force and depth of impacts.

    Parameters
    ----------
    records : IndentationRecord, OscillationRecord, ReboundRecord, ModulusAnchor, or list of them
        Each at a point of the material that was never in contact before.
    indenter : Indenter
        A body of revolution: Ball, Cone or FlatPunch.
    shift : ShiftLaw, optional
        α(T), e.g. from DMA, with its covariance if known.  If omitted, it is found by superposition of the
        temperatures.
    reference : float, str or pint.Quantity, optional
        Temperature at which the material is described, K if a plain number; if omitted, that of `shift`, or the middle
        one of the records.
    poisson_ratio : float
        Of the rubber, constant.
    indenter_modulus : float, str or pint.Quantity, optional
        Young's modulus of an elastic indenter, Pa if a plain number; rigid without it.
    indenter_poisson_ratio : float
        Of an elastic indenter.
    radius_error, load_error : float
        Relative standard deviations of the indenter's radius and of the load cell's gain, which all records share;
        0, by default: taken as exact.
    zero_error : float, str or pint.Quantity
        Standard deviation of the zero of the depth, m, of its own for every record; 0, by default: taken as exact.
    modes : int
        Number of retardation times; more are used if these would be more than 0.4 decades apart.
    limit : float
        Largest relative standard error of an identified modulus.
    samples : int
        Number of materials drawn from the posterior density.
    seed : int
        Of the draws.
    name : str
        Of the material.

    Returns
    -------
    MaterialFromIndentation

    Raises
    ------
    InputError
        If a value cannot be used, a record has too few clear rows, the level of the modulus does not follow from the
        records, or α(T) is neither given nor to be found because the temperatures do not overlap.
    ConvergenceError
        If the fit does not converge.

    Notes
    -----
    While the contact of a body of revolution grows, its record is linear in J(t), or in E(t) (E. H. Lee, J. R. M.
    Radok, J. Appl. Mech. 27 (1960) 438): for a ball δ^{3/2}(t) = (3/4)(1−ν²)/√R ∫J(t−s)dF(s) and
    F(t) = (4/3)√R/(1−ν²) ∫E(t−s)dδ^{3/2}(s).  Records in which the contact shrinks, and impacts, are solved by springs
    with memory, as by `solve_transient` and `solve_impact`, with their derivatives by every mode; contacts are solved
    again for the material found until it no longer changes.  The stiffness of small oscillations is 2a E(ω)/(1−ν²).
    What was prescribed is taken as exact and linear between the rows.
    ln of the response is fitted, averaged over twentieths of a decade of time since what was prescribed last changed
    its slope, with the prior, the evidence and the samples of `identify_material`: unknowns are ln C_k, ln E_inf and
    ln α, and the errors in common with the standard deviations given.  Several temperatures are first fitted one by
    one, their J(t) is superposed as creep tests are, and the factors are then refined together with the spectrum.

    Assumed are a half-space, small strain, no friction and no adhesion in the contact, and of impacts no waves.
    Bands leave out errors in common that are not given: 1 % of the radius is 0.5 % of the modulus, 1 % of the depth
    1.5 %.

    Examples
    --------
    A known material, and a synthetic creep test of it with a ball:

    >>> import numpy as np
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> time = np.geomspace(0.01, 100.0, 60)
    >>> J = rubber.at("30 degC").creep_compliance(time)
    >>> scatter = 1.0 + 0.005 * np.random.default_rng(1).standard_normal(60)
    >>> depth = (0.75 * 0.75 / np.sqrt(0.01) * J * 2.0) ** (2 / 3) * scatter  # 2 N, R = 10 mm
    >>> creep = vf.friction.IndentationRecord(time, np.full(60, 2.0), depth, "30 degC", control="load", start=0.0)
    >>> found = vf.identify_from_indentation(creep, vf.Ball("10 mm"), samples=20)
    >>> ratio = found.material.complex_modulus(1.0) / rubber.complex_modulus(1.0, "30 degC")
    >>> bool(abs(ratio - 1.0) < 0.05)
    True
    """
    several = _checked(records, indenter, shift)
    shared = Shared(
        deviation(radius_error, "dimensionless", "radius_error"),
        deviation(load_error, "dimensionless", "load_error"),
        deviation(zero_error, "m", "zero_error"),
    )
    ratio = checked_poisson_ratio(poisson_ratio)
    check_counts(modes, samples, seed)
    limit = share(limit, "limit", example=0.05)
    text(name, "name")
    kelvin = None if reference is None else positive(reference, "K", "reference")
    plane_strain = 1.0 - ratio**2
    extra = indenter_compliance(indenter_modulus, indenter_poisson_ratio) / plane_strain
    usable = usable_records(several, indenter, shared)
    usable, shifts = shifts_of(usable, shift, kelvin, plane_strain, extra)
    problem = problem_of(usable, shifts, plane_strain, extra, modes, shared)
    fits, scale = _fitted(problem)
    return conclude(
        usable, fits, scale, shift=shift, poisson_ratio=ratio, name=name, limit=limit, samples=samples, seed=seed
    )


def _checked(records: object, indenter: object, shift: object) -> tuple[Record, ...]:
    several = tuple(records) if isinstance(records, (list, tuple)) else (records,)
    if not several:
        raise InputError("records: none given.", code="too-few-points", field="records")
    for one in several:
        insist_on(one, "records", *get_args(Record), right="an IndentationRecord, or a list of records")
    insist_on(shift, "shift", ShiftLaw, type(None), right="a shift law, ShiftFactors or None")
    insist_on_indenter(indenter)
    assert isinstance(indenter, Indenter)
    if not is_body_of_revolution(indenter):
        raise InputError(
            f"indenter: a {indenter.noun} is no body of revolution, whose growing contact is known in closed form; use "
            "a Ball, Cone or FlatPunch.",
            code="no-revolution",
            field="indenter",
        )
    return several


def _fitted(problem: IndentationProblem) -> tuple[list[Weighed[IndentationProblem]], float]:
    """Fit at every roughness, with errors found from the residuals or enlarged; return the factor of the latter too."""
    fits = _settled(problem, problem.start)
    unknown = np.repeat([one.error is None for one in problem.contacts], [len(one) for one in problem.contacts])
    for _ in range(PASSES if np.any(unknown) else 0):
        best = most_evident(fits)
        errors = np.where(unknown, _errors(best), best.problem.errors)
        changed = float(np.max(np.abs(np.log(errors / best.problem.errors))))
        fits = _settled(best.problem.with_errors(errors), best.minimum.place)
        if changed < SETTLED:
            break
    if np.all(unknown):
        return fits, 1.0
    given, scale = most_evident(fits).problem.errors, 1.0
    for _ in range(PASSES):
        best = most_evident(fits)
        away = best.problem.measured(best.minimum.place)[0]
        ratio, doubtful = misfit(best, away, ~unknown)
        if scale == 1.0 and not doubtful:
            break
        scale *= max(float(np.sqrt(ratio)), 1.0 / scale)
        larger = np.where(unknown, given, scale * given)
        fits = _settled(best.problem.with_errors(larger), best.minimum.place)
        if abs(ratio - 1.0) < 2.0 * SETTLED:
            break
    return fits, scale


def _settled(problem: IndentationProblem, start: Array) -> list[Weighed[IndentationProblem]]:
    """Return the fits at every roughness, from responses that are solved for their material."""
    if not any(contact.by_springs for contact in problem.contacts):
        return weighed(problem, descend(problem, start, metric=problem.metric).place)
    return fitted_by_springs(problem, start)


def _errors(best: Weighed[IndentationProblem]) -> Array:
    """Return errors of the size of the residuals for every record; they vary with the number of averaged rows only."""
    problem = best.problem
    away = problem.measured(best.minimum.place)[0] * problem.errors
    left = max(freedom_of(best, len(away)), 1.0) / len(away)
    found = np.empty(len(away))
    for contact, rows in zip(problem.contacts, problem.rows, strict=True):
        size = float(np.sqrt(np.mean(away[rows] ** 2 * contact.count) / left))
        found[rows] = np.maximum(size / np.sqrt(contact.count), LEAST_ERROR)
    return found
