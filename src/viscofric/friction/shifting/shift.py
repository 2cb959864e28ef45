"""Shifting of friction curves of several temperatures onto one, by shift factors given or found from the curves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError, SuperpositionError
from viscofric.files import on_source
from viscofric.friction.curve_checks import error_freedom, implausible, shared_error
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.friction.measurement.zeros import ROUNDING
from viscofric.friction.shifting.collapse import collapse
from viscofric.friction.shifting.found_shifts import found_shifts
from viscofric.friction.shifting.isotherms import friction_isotherms
from viscofric.friction.shifting.load_rule import LoadRule
from viscofric.friction.shifting.master_curve import FrictionMasterCurve, reduced_decades
from viscofric.nominal import SAME_LOAD, nominal_rows
from viscofric.notes import Note, Remedy, codes, note_of
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.units import Quantity, positive

#: Probability of a note on negative friction where there is none.
BY_CHANCE = 0.025


def shift_friction(
    curves: FrictionCurves,
    *,
    shift: ShiftLaw | None = None,
    reference: Quantity | None = None,
    vertical_shift: VerticalShift | None = None,
    indenter: Indenter | None = None,
    load: Quantity | None = None,
    level_error: float = 0.0,
) -> FrictionMasterCurve:
    """Shift friction curves of several temperatures onto one master curve (Eq. 10).

    Without `shift` the shift factors are found from the curves alone: log μ is one smooth function of log(αv), a
    penalised spline whose smoothness follows from restricted maximum likelihood, and all α(T) are fitted at once.
    Points are weighted by their standard errors relative to each other; their scatter is estimated too, and has heavy
    tails: points more than two standard errors off count less by the square of their distance.  That of less than ten
    degrees of freedom is not taken to be below the standard errors.  Curves overlap only if some shift makes them
    coincide over two or more points of each, and moving them apart would contradict the points; a spline is never drawn
    across a gap.  From curves of 10 speeds at 9 temperatures with 1.8 % of scatter, the
    95 % intervals of α hold 95 %.

    Parameters
    ----------
    curves : FrictionCurves
        At one load, unless an indenter is given.
    shift : ShiftLaw or ShiftFactors, optional
        α(T), as of the material: ``rubber.shift``.  Found from the curves if left out.
    reference : float, str or pint.Quantity, optional
        Temperature of the master curve, K; if left out that of `shift`, or the middle one of the curves that overlap.
    vertical_shift : VerticalShift, optional
        b(T) of the modulus; 1 if left out.  Needs the indenter.
    indenter : Indenter, optional
        A Ball, Ellipsoid, Cylinder or Cone on a half-space: then friction at all loads is reduced to one by an exact
        rule (see `FrictionMasterCurve`), as μ(v, T, F) = μ(α(T) v, T0, F/b(T)).  It may be elastic where there is no
        vertical shift, and must be rigid where there is one.
    load : float, str or pint.Quantity, optional
        Of the master curve, with an indenter; the median of the curves' loads if left out.
    level_error : float
        Relative standard error of friction that all points of a temperature share, such as 0.01 for a force cell or
        for samples changed between temperatures, or the difference of runs at all speeds, which `separate` notes with
        its size; included in the covariance of the shift factors found, and in the error of friction read off.

    Returns
    -------
    FrictionMasterCurve
        With `shift_factors`, a `ShiftFactors` with covariance, to which laws are fitted as to those of a DMA.  Its
        notes name temperatures that were left out, points that lie off the curve and count less, and a number of
        replicates that was inferred from how their errors scatter.

    Raises
    ------
    SuperpositionError
        If the shift factors are to be found and no curves overlap, or friction is too flat.
    InputError
        If there are no curves, loads differ by more than 5 % without an indenter, the indenter has no load rule, or
        a temperature is one at which a given α is not known.

    Notes
    -----
    Curves that overlap marginally are found only if chance moved them together, so that their shift errs to one side.
    Their standard errors are enlarged accordingly, by up to 1.9, with a note.  95 % intervals then hold 80 to 96 %
    (otherwise 74 to 79 %) of the shifts of two temperatures of which one pair in four to six is found, 93 % of five
    temperatures with 10 % of scatter, and 96 to 98 % where friction changes by 0.03 decades per decade.

    Errors of α are those of points that scatter about the common curve independently of each other.  Friction slopes
    little (0.05 to 0.3 decades per decade), so that an error which all points of a temperature share moves its α by
    many times as much: 1 % of friction by 0.014 to 0.09 decades, and the vertical shift of rubber elasticity
    (`DensityShift`), left out from 30 to 90 °C, by 0.13.  The covariance holds such errors only as given by
    `level_error`; a law fitted to the factors adds their scatter about it.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> speed, temperature = np.tile(np.geomspace(0.02, 0.2, 10), 3), np.repeat([303.15, 308.15, 313.15], 10)
    >>> law = vf.WLF(C1=9.0, C2=100.0, reference=303.15)
    >>> friction = 0.01 * (1.0 + (law(temperature) * speed / 0.02) ** -0.4)  # made up
    >>> curves = vf.FrictionCurves(
    ...     speed, temperature, np.full(30, 25.0), friction, np.zeros(30), np.zeros(30), np.ones(30)
    ... )
    >>> found = vf.shift_friction(curves, reference="30 degC").shift_factors
    >>> (found.log10_values - law.log10(found.temperatures)).round(3) + 0.0
    array([0., 0., 0.])
    """
    _check(curves, shift, vertical_shift, indenter, load)
    unit = curves.load_unit
    rule = None if indenter is None else LoadRule.of(indenter)
    if indenter is not None and indenter.geometry.load_unit != unit:
        raise InputError(
            f"load of the friction curves is in {unit}, but a {indenter.noun} takes {indenter.geometry.load_unit}.",
            code="load-unit",
        )
    at_load = float(np.median(curves.load)) if load is None else positive(load, unit, "load")
    shared = shared_error(level_error, "level_error")
    kelvin = None if reference is None else positive(reference, "K", "reference")
    notes: tuple[str, ...] = ()
    found = shift is None
    if shift is None:
        # Whatever the reference of the vertical shift is, it moves all curves together.
        points = _at_one_load(curves, rule, at_load, vertical_shift)
        try:
            shift, members = found_shifts(friction_isotherms(points), kelvin, shared)
        except SuperpositionError as error:
            raise _with_outliers(error, curves) from None
        notes = (*error_freedom(points)[1], *shift.notes)
        shift = replace(shift, notes=(*shift.notes, *on_source(curves.source)))
        rows = nominal_rows(curves.temperature)
        curves = curves.select(np.sort(np.concatenate([rows[place] for place in members])))
    elif kelvin is not None:
        shift = shift.at_reference(kelvin)
    vertical = None if vertical_shift is None else vertical_shift.at_reference(shift.reference)
    points = _at_one_load(curves, rule, at_load, vertical)
    decades = reduced_decades(points, shift, found=found)
    order = np.argsort(decades, kind="stable")
    master = FrictionMasterCurve(
        reduced_speed=_frozen(10.0 ** decades[order]),
        temperature=_frozen(curves.temperature[order]),
        friction_coefficient=_frozen(points.viscoelastic[order]),
        friction_error=_frozen(points.viscoelastic_error[order]),
        friction_scatter=_frozen(points.viscoelastic_scatter[order]),
        reference=float(shift.reference),
        shift=shift,
        curves=curves,
        overlap=collapse(curves.temperature, decades, points.viscoelastic, points.viscoelastic_error),
        load=at_load,
        load_rule=rule,
        vertical_shift=vertical,
        found=found,
        notes=(*notes, *implausible(points), *_below_zero(curves)),
        level_error=shared,
    )
    # Not by replace(): the distances of all points from the curve are known now.
    own = (note for note in master.own_notes() if note.code not in codes(notes))
    object.__setattr__(master, "notes", (*master.notes, *own))
    return master


def _below_zero(curves: FrictionCurves) -> Iterator[Note]:
    """Yield the number of points of negative friction, which is impossible for rubber."""
    # As many as chance does not explain, of all points together (Y. Benjamini and Y. Hochberg, J. R. Stat. Soc. B 57
    # (1995) 289).
    from scipy.special import ndtr, stdtr

    # Separated from Coulomb friction without an error, it has that of rounding.
    rounding = ROUNDING * (0.0 if curves.coulomb is None else np.abs(curves.coulomb))
    below = np.minimum(curves.viscoelastic + rounding, 0.0)
    with np.errstate(divide="ignore"):
        errors = np.divide(below, curves.viscoelastic_error, out=np.zeros(len(curves)), where=below < 0.0)
    freedom = error_freedom(curves)[0]
    known = np.isfinite(freedom)
    chance = np.sort(np.where(known, stdtr(np.where(known, freedom, 1.0), errors), ndtr(errors)))
    allowed = BY_CHANCE * np.arange(1, len(curves) + 1) / len(curves)
    count = int(np.max(np.flatnonzero(chance <= allowed), initial=-1)) + 1
    if count:
        yield Note(
            "friction-below-zero",
            f"Viscoelastic friction is below zero at {count} of {len(curves)} points, by more than chance explains; "
            "that of rubber never is; check the signs of the forces.",
            values={"points": count, "of": len(curves)},
        )


def _at_one_load(
    curves: FrictionCurves, rule: LoadRule | None, load: float, vertical_shift: VerticalShift | None
) -> FrictionCurves:
    return curves if rule is None else rule.reduced(curves, load, vertical_shift)


def _check(curves: FrictionCurves, shift: Any, vertical_shift: Any, indenter: Any, load: Any) -> None:
    """Raise `InputError` for curves or arguments that cannot be used."""
    insist_on_curves(curves, "curves")
    if not len(curves):
        raise InputError("friction curves contain no points; there is nothing to shift.", code="no-points")
    insist_on(shift, "shift", ShiftLaw, type(None), right="a law (WLF, …), ShiftFactors or None, to find it")
    insist_on(
        vertical_shift,
        "vertical_shift",
        VerticalShift,
        type(None),
        right="a DensityShift, VerticalShiftFactors or None",
    )
    if indenter is not None:
        return
    if vertical_shift is not None or load is not None:
        name = "load" if vertical_shift is None else "vertical_shift"
        raise InputError(
            f"{name} of a friction master curve needs the indenter, from which the effect of load follows: "
            "shift_friction(…, indenter=Ball(radius=…)).",
            code="indenter-needed",
        )
    if curves.load.max() > (1.0 + SAME_LOAD) * curves.load.min():
        raise InputError(
            f"load of the friction curves runs from {curves.load.min():.3g} to {curves.load.max():.3g} "
            f"{curves.load_unit}, but a master curve holds at one load; ",
            code="several-loads",
            remedy=Remedy(
                "choose one with curves.at_load(), or give the indenter,",
                "give the ball (--ball),",
                "give the [indenter],",
                "give a ball,",
                "indenter",
            )
            + " with which loads are reduced to one.",
        )


def _with_outliers(error: SuperpositionError, curves: FrictionCurves) -> SuperpositionError:
    """Return an error on flat curves with the note on readings that were kept although far from the others, if any."""
    kept = [one for one in map(note_of, curves.notes) if one.code == "outliers" and one.remedy is not None]
    for one in kept if error.code == "curves-too-flat" else ():
        error = error.with_note(error.note.advising(f" {one.text}").advising(one.remedy or ""))
    return error


def _frozen(column: Array) -> Array:
    column.flags.writeable = False
    return column


def common_reference(curves: FrictionCurves, known: ShiftLaw | None) -> float | None:
    """Return the reference of known shift factors, K, where friction reaches it; None: that of the curves alone."""
    if known is None or not curves.temperature.min() <= known.reference <= curves.temperature.max():
        return None
    return float(known.reference)
