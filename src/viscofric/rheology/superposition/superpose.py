"""Time–temperature superposition: isotherms shifted onto one master curve at a reference temperature."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal, TypedDict, Unpack, overload

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.data import Isotherm, IsothermalSweeps, MasterCurve
from viscofric.errors import InputError
from viscofric.files import of_synthetic
from viscofric.notes import Note, Remedy
from viscofric.rheology.shifts.law_comparison import course_notes
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors, known_vertical
from viscofric.rheology.superposition.common_shifts import CommonShifts, common_shifts
from viscofric.rheology.superposition.consistency import drift, neighbour_distances
from viscofric.rheology.superposition.isotherm_offsets import TRENDS
from viscofric.rheology.superposition.joined_isotherms import (
    BOTH,
    STEP,
    JoinedIsotherms,
    Quantities,
    ShiftBy,
    Tested,
    as_given,
    join_isotherms,
    on_gaps,
    ranges,
    shown,
    steps_at,
    usable,
)
from viscofric.rheology.superposition.joint import JointSuperposition, insist_on_kinds, joined_kinds
from viscofric.rheology.superposition.overlap import (
    PAIR_UNCERTAINTY,
    LogSweep,
    overlap_quality,
    own_shifts,
)
from viscofric.rheology.superposition.result import (
    PER_DECADE,
    StepSuperposition,
    Superposition,
    flowing,
    weights_of_averages,
)
from viscofric.rheology.superposition.shift_problem import Gauge
from viscofric.step_tests import StepKind, StepMasterCurve, StepTest, StepTests
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, checked_poisson_ratio, kelvin_hint, positive, shown_celsius, to_si


class Options(TypedDict, total=False):
    """The keywords of `superpose`, for its overloads."""

    vertical: Literal["free", "density"] | VerticalShift | None
    shift: ShiftLaw | None
    fixed: Mapping[Any, float] | None
    by: ShiftBy
    weights: Sequence[float] | None


# fmt: off
@overload
def superpose(
    sweeps: IsothermalSweeps, reference: Quantity, poisson_ratio: float = ..., **options: Unpack[Options]
) -> Superposition: ...
@overload
def superpose(
    sweeps: StepTests, reference: Quantity, poisson_ratio: float = ..., **options: Unpack[Options]
) -> StepSuperposition: ...
@overload
def superpose(
    sweeps: Sequence[IsothermalSweeps | StepTests], reference: Quantity, poisson_ratio: float = ...,
    **options: Unpack[Options],
) -> JointSuperposition: ...
# fmt: on
@one_blas_thread
def superpose(
    sweeps: IsothermalSweeps | StepTests | Sequence[IsothermalSweeps | StepTests],
    reference: Quantity,
    poisson_ratio: float = 0.5,
    *,
    vertical: Literal["free", "density"] | VerticalShift | None = None,
    shift: ShiftLaw | None = None,
    fixed: Mapping[Any, float] | None = None,
    by: ShiftBy = "both",
    weights: Sequence[float] | None = None,
) -> Superposition | StepSuperposition | JointSuperposition:
    """Shift isotherms onto one master curve, by E' and E'' jointly, all at once.

    E(ω, T) = b(T) E(α(T) ω, reference); of creep and relaxation tests J(t, T) = J(t/α(T), reference)/b(T) and
    E(t, T) = b(T) E(t/α(T), reference).

    Parameters
    ----------
    sweeps : IsothermalSweeps or StepTests, or a list of them
        At least two isotherms that overlap.  Several kinds of tests of one material in a list have one table of shift
        factors; the reference must lie within the temperatures of each.
    reference : float or quantity
        Temperature of the master curve, measured or in between (or at most half a kelvin outside); K, or
        text such as ``"30 degC"``.
    poisson_ratio : float
        Turns shear moduli into tensile ones, E = 2(1+ν)G; without effect on moduli measured in tension.
    vertical : {"free", "density"} or VerticalShift, optional
        None leaves b = 1.  ``"density"`` takes b = ρT/(ρ0 T0) with the expansivity of natural rubber, and a
        `VerticalShift` is taken as it is: ``DensityShift("30 degC", expansion=0)`` is b = T/T0.  ``"free"``
        fits one b for every isotherm, together with α.
    shift : ShiftLaw or ShiftFactors, optional
        Taken as it is, about the reference, instead of a fit.  No isotherm is left out then.
    fixed : mapping of temperature to float, optional
        log10 α, about the reference, of isotherms that are not to be fitted: ``{"60 degC": -2.1}``.  They are
        held exactly, the others are fitted around them.  The isotherm at the reference has 0 and needs no mention;
        where the reference lies between two isotherms, at most one of the two can be fixed.
    by : {"both", "storage", "loss", "loss-tangent"}
        What is brought onto common curves: log E' and log E'' (the default), one of the two alone, or log tan δ, which
        no vertical shift changes.
    weights : (float, float), optional
        Of the squared residuals of log E' and of log E'', relative to each other; equal by default.

    Returns
    -------
    Superposition, StepSuperposition of step tests, or JointSuperposition of several kinds

    Raises
    ------
    SuperpositionError
        If there are fewer than two isotherms, one has fewer than two points, or neighbours do not overlap.  A
        single isotherm at the cold or the hot end that does not reach the others is left out, with a note.
    InputError
        If what is given are no sweeps, the reference lies outside the temperatures that were joined, ν outside 0 to
        0.5, a given shift does not hold at one of the temperatures, a fixed temperature is not that of an isotherm
        (to a quarter of the distance to its neighbours), or `by` and `weights` do not go with the other choices.

    Notes
    -----
    Neighbours are first joined pair by pair, then all shifts are refined together against common curves of
    log E' and log E'' (`common_shifts`), to which every measured point counts once.  How well an overlap
    identifies a shift is thereby its weight.  tan δ has no term of its own: log tan δ is the difference of the
    two, so it is fitted already, and it would count the same points twice.  Where one of the moduli is known to be
    wrong, as by inertia or by clamping, `by` and `weights` leave it out or let it count for less; all else is the same,
    and a note says which.  The errors include offsets of isotherms as both moduli show them, since one alone hardly
    does; where these exceed 6 %, the other modulus is taken to be wrong, and the offsets are those of the one.
    Vertical shifts cancel in tan δ: ``"free"`` ones are fitted to both moduli in a second
    superposition with these shift factors as `shift`.

    A shift along a plateau cannot be seen.  There log10 α follows the trend of its neighbours in 1/T,
    has a standard error that grows from step to step, and a note names the temperatures.  With free
    vertical shifts any straight part of the curves hides a sum of both, so each log10 b is drawn to that of its
    neighbours, with 0.03 decades, which is three times what ρT makes of 10 K.  A note says where little more than
    this is known of b.

    Standard errors hold the scatter of points about the common curves; offsets of whole isotherms, as from clamping
    anew, whose variance is found from the overlaps (`offsets`); and what the likelihood of each step leaves open when
    it is followed far from the best fit, be it over a plateau or to a second minimum (`step_profiles`).  Steps that
    are not fixed are in `unidentified`, and a note names them.  With isotherms off by 1 to 2 %, 95 % intervals of α
    hold some 95 % of planted factors (`benchmarks/rheology`).  An error of temperature is an error of α itself, and is
    not in them; a note names a temperature that is off the course of the others, or says that all scatter about it.
    With a free vertical shift, offsets that E' and E'' share are part of b.

    Where isotherms drift to one side (`SuperpositionCheck.drift`), a vertical shift may be missing, or none describes
    them.  Then half of the squared difference to the shifts beside a free one counts as variance of α; where they drift
    beside a free one too, half of that to the shifts without.

    Without a requested vertical shift, errors of α include one in proportion to temperature, from none to b = T/T0 and,
    as far as the isotherms ask for it, beyond or below: its size squared, averaged over its likelihood.  A note names
    it where the isotherms show it (`vertical-shift-left-out`).  Of 105 random rubbers whose ρT was left out, 84 were
    noted, and 95 % intervals held 99 % of α and 94 % of α of fitted laws; of 164 sets of step tests 60, 92 and 94 %.
    A vertical shift of another course, as of crystals that melt, is included in part (77 % of α).

    Of step tests log J(t), or log E(t), is brought onto one curve over log t, by the same fit.  Its points are averaged
    over twentieths of a decade of time first: instruments record far more of them at long times, with errors that are
    alike.  The weight of an average grows with its number of readings, as far as their errors are independent, up to
    that of eight.  One curve for each temperature shows less than E' and E'': offsets of isotherms are found as far as
    the curve bends, and where it is a power law, they are taken for shifts.  The shifts are the most likely ones,
    averaged over the sizes that offsets may have (`step_profiles`).  With ``vertical="free"`` offsets are part of b.

    Given or fixed factors that join the isotherms clearly worse than shifts of their own would are mentioned in a note.

    Values given with `shift` carry no uncertainty here, unless they are `ShiftFactors` with a covariance.  Where the
    reference lies between isotherms, α = 1 there by the interpolation that `ShiftFactors` makes: given values
    are moved together by what that differs from the law.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic
    >>> sweeps = vf.read_dma(path, deformation="tension")
    >>> fit = vf.superpose(sweeps, reference="30 degC")
    >>> f"{fit.shift_factors.log10('60 degC'):.1f} ± {fit.shift_factors.standard_error('60 degC'):.2f}"
    '-2.1 ± 0.02'
    """
    if isinstance(sweeps, (list, tuple)):
        insist_on_kinds(sweeps, vertical, shift, fixed)
        both: Any = {"by": by, "weights": weights}
        alone = [
            superpose(
                one, reference, poisson_ratio, vertical=vertical, **(both if isinstance(one, IsothermalSweeps) else {})
            )
            for one in sweeps
        ]
        return joined_kinds(alone, positive(reference, "K", "reference"))
    right = "IsothermalSweeps or StepTests; read them with read_dma(…), as in superpose(read_dma('a.csv'), '20 degC')"
    insist_on(sweeps, "sweeps", IsothermalSweeps, StepTests, right=right)
    kelvin = positive(reference, "K", "reference")
    ratio = checked_poisson_ratio(poisson_ratio)
    insist_on(shift, "shift", ShiftLaw, type(None), right="a shift law, ShiftFactors or None")
    insist_on(fixed, "fixed", Mapping, type(None), right="a mapping of temperatures to log10 α")
    if shift is not None and fixed:
        raise InputError(
            "shift and fixed: give one of them; with shift no factor is left to be fitted.", code="give-one"
        )
    known = known_vertical(vertical, kelvin, free=True)
    if isinstance(sweeps, StepTests):
        if by != "both" or weights is not None:
            raise InputError(
                "by and weights choose between E' and E''; step tests have one curve for each temperature.",
                field="by",
                code="useless-weights",
            )
        read, made_up = sweeps.in_tension(ratio), of_synthetic(sweeps.notes)
        tests = read.thinned(PER_DECADE)
        weights_of = weights_of_averages(read.tests, tests.kind)
        logs = [LogSweep.of_step(one, tests.kind, own) for one, own in zip(tests.tests, weights_of, strict=True)]
        steps, found = shifted_isotherms(
            tests.tests, logs, kelvin, known, vertical == "free", shift, fixed, STEP, made_up
        )
        found["notes"] = (*tests.notes, *found["notes"], *(flowing(steps.isotherms) if tests.kind == "creep" else []))
        steps_curve = _step_master_curve(steps, found["shift_factors"], tests.kind)
        return StepSuperposition(master_curve=replace(steps_curve, notes=made_up), **found)
    assert isinstance(sweeps, IsothermalSweeps)
    tensile, made_up = sweeps.in_tension(ratio), of_synthetic(sweeps.notes)
    quantities = Quantities.chosen(by, weights)
    quantities.insist_on_use(vertical, shift)
    logs = [LogSweep.of(isotherm) for isotherm in tensile.isotherms]
    joined, found = shifted_isotherms(
        tensile.isotherms, logs, kelvin, known, vertical == "free", shift, fixed, quantities, made_up
    )
    found["notes"] = (*tensile.notes, *quantities.notes, *found["notes"])
    unequal = None if weights is None else (float(quantities.weights[0]), float(quantities.weights[1]))
    curve = replace(_master_curve(joined, found["shift_factors"]), notes=made_up)
    return Superposition(master_curve=curve, shifted_by=quantities.by, weights=unequal, **found)


def _master_curve(joined: JoinedIsotherms[Isotherm], factors: ShiftFactors) -> MasterCurve:
    """Return all points, moved along both axes."""
    frequency, logs, kelvin = _moved(joined, factors)
    order = np.argsort(frequency, kind="stable")
    moduli = 10.0 ** logs[order]
    return MasterCurve(10.0 ** frequency[order], moduli[:, 0], moduli[:, 1], kelvin[order], factors.reference)


def _step_master_curve(joined: JoinedIsotherms[StepTest], factors: ShiftFactors, kind: StepKind) -> StepMasterCurve:
    """Return all points, moved along both axes."""
    rate, logs, kelvin = _moved(joined, factors)
    order = np.argsort(-rate, kind="stable")
    response = 10.0 ** (-logs[order, 0] if kind == "creep" else logs[order, 0])
    return StepMasterCurve(10.0 ** -rate[order], response, kelvin[order], factors.reference, kind)


def _moved(joined: JoinedIsotherms[Any], factors: ShiftFactors) -> tuple[Array, Array, Array]:
    """Return log10 of the reduced frequency, logarithms of the moduli, and the temperature, of all points."""
    shifts = zip(joined.logs, factors.log10_values, strict=True)
    frequency = np.concatenate([sweep.frequency + shift for sweep, shift in shifts])
    kelvin = np.repeat([i.temperature for i in joined.isotherms], [len(i) for i in joined.isotherms])
    return frequency, np.concatenate([sweep.moduli for sweep in joined.logs]), kelvin


#: A temperature is that of an isotherm within this part of the distance to the next one.
NEAR = 0.25
#: Where the reference lies between isotherms, iteration fixes factors relative to its interpolated zero, to this.
EXACT = 1e-9  # decades
REPETITIONS = 12
#: A law close to its pole moves sweeps farther than this, beyond the largest floating-point number.
LARGEST_SHIFT = 100.0  # decades


def held_places(fixed: Mapping[Any, float], temperatures: Array, reference: float) -> dict[int, float]:
    """Return log10 α by the index of the isotherm, of fixed factors by temperature as users write it."""
    held: dict[int, float] = {}
    for wanted, value in fixed.items():
        kelvin = positive(wanted, "K", "temperature of a fixed shift factor")
        log10_alpha = to_si(value, "dimensionless", f"shift factor fixed at {shown(kelvin)}")
        place = int(np.argmin(np.abs(temperatures - kelvin)))
        gap = float(np.min(np.abs(np.delete(temperatures, place) - temperatures[place])))
        if abs(temperatures[place] - kelvin) > NEAR * gap:
            raise InputError(
                f"a shift factor is fixed at {shown(kelvin)}, where none of the joined isotherms is; the nearest is at "
                f"{shown(temperatures[place])}.",
                code="no-such-temperature",
            )
        if place in held:
            raise InputError(
                f"two shift factors are fixed for the isotherm at {shown(temperatures[place])}; give one.",
                code="given-twice",
            )
        held[place] = log10_alpha
    around = np.flatnonzero(weights_between(temperatures, np.array([reference])))
    if len(around) == 1 and held.get(int(around[0]), 0.0) != 0.0:
        raise InputError(
            f"a shift factor is fixed at {shown(reference)}, which is the reference, where log10 α is 0; leave it out.",
            code="is-reference",
        )
    if len(around) > 1 and all(int(place) in held for place in around):
        raise InputError(
            f"the reference, {shown(reference)}, lies between two isotherms whose shift factors are both fixed; "
            "fix one of them only.",
            code="reference-fixed",
        )
    return held


def fitted_shifts(
    joined: JoinedIsotherms[Any],
    reference: float,
    held: dict[int, float],
    free: bool,
    quantities: Quantities = BOTH,
    left_out: bool = False,
) -> CommonShifts:
    """Fit all shifts except those `held` (log10 α by index); with `free`, vertical shifts too.  See `common_shifts`."""
    temperatures, sweeps = _temperatures(joined), joined.logs
    around = _gauge(temperatures, reference, held, free, left_out)
    if not held or np.max(around.weights) == 1.0:
        return common_shifts(sweeps, joined.joins, around, quantities)
    # `ShiftFactors` interpolates by a cubic, whose zero differs from that of the straight line in the fit.
    moved = 0.0
    for _ in range(REPETITIONS):
        shifted = {place: value + moved for place, value in held.items()}
        found = common_shifts(sweeps, joined.joins, replace(around, held=shifted), quantities)
        table = ShiftFactors(temperatures, found.values, reference)
        before, moved = moved, float(found.values[0] - table.log10_values[0])
        if abs(moved - before) < EXACT:
            break
    return found


def given_shifts(joined: JoinedIsotherms[Any], reference: float, shift: ShiftLaw, free: bool) -> CommonShifts:
    """Return the shifts of a law or table; with `free`, fit vertical ones."""
    temperatures = _temperatures(joined)
    values = np.array(shift.log10(temperatures))
    farthest = int(np.argmax(np.abs(values)))
    if abs(values[farthest]) > LARGEST_SHIFT:
        raise InputError(
            f"the given shift factors move the sweep at {shown(temperatures[farthest])} by "
            f"{values[farthest]:.0f} decades from the reference, {shown(reference)}: their law does not hold there.",
            code="out-of-range",
        )
    nothing = np.zeros((len(values), len(values)))
    covariance = nothing
    if isinstance(shift, ShiftFactors):
        weights = weights_between(shift.temperatures, temperatures)
        covariance = weights @ shift.covariance @ weights.T
    if not free:
        return CommonShifts(values, covariance, np.zeros(len(values)), nothing, nothing)
    gauge = _gauge(temperatures, reference, dict(enumerate(values)), free)
    found = common_shifts(joined.logs, joined.joins, gauge)
    return CommonShifts(values, covariance, found.vertical, found.vertical_covariance, nothing)


def _temperatures(joined: JoinedIsotherms[Any]) -> Array:
    return np.array([isotherm.temperature for isotherm in joined.isotherms])


def _gauge(temperatures: Array, reference: float, held: dict[int, float], free: bool, left_out: bool = False) -> Gauge:
    weights = weights_between(temperatures, np.array([reference]))[0]
    vertical = np.array([np.interp(reference, temperatures, unit) for unit in np.eye(len(temperatures))])
    return Gauge(1.0 / temperatures, weights, vertical, held, free, left_out)


#: Weight of the alternative model, with a free vertical shift or without one, where isotherms drift.
OTHER_MODEL = 0.5


def shifted_isotherms(
    isotherms: tuple[Tested, ...],
    logs: list[LogSweep],
    kelvin: float,
    known: VerticalShift | None,
    free: bool,
    shift: ShiftLaw | None,
    fixed: Mapping[Any, float] | None,
    quantities: Quantities,
    made_up: tuple[Note, ...],
) -> tuple[JoinedIsotherms[Tested], dict[str, Any]]:
    """Join and shift isotherms given by their logarithms; `known` is b(T) where it is not fitted.

    Returns them free of the vertical shift, and the attributes of a `Superposed` but for its master curve.  Factors
    that are found have the notes `made_up` on synthetic data.
    """
    usable(isotherms)
    levels = [0.0 if known is None else known.log10(isotherm.temperature) for isotherm in isotherms]
    logs = [replace(one, moduli=one.moduli - by) for one, by in zip(logs, levels, strict=True)]
    joined: JoinedIsotherms[Tested]
    if shift is None:
        joined = join_isotherms(isotherms, logs, quantities)
    else:
        joined = as_given(isotherms, logs, shift.at_reference(kelvin))
    temperatures = np.array([isotherm.temperature for isotherm in joined.isotherms])
    if not temperatures[0] - NOMINAL <= kelvin <= temperatures[-1] + NOMINAL:
        raise InputError(
            f"reference = {shown_celsius(kelvin)} °C lies outside the joined isotherms, "
            f"{shown(temperatures[0])} to {shown(temperatures[-1])}",
            code="reference-outside",
            remedy=kelvin_hint(kelvin) + "".join(f" {note}" for note in joined.notes),
        )
    if shift is None:
        held = held_places(fixed or {}, temperatures, kelvin)
        left_out = known is None and not free and quantities.by != "loss-tangent"
        found = fitted_shifts(joined, kelvin, held, free, quantities, left_out)
        log10_b = found.vertical if known is None else np.asarray(known.log10(temperatures))
        if quantities.by != "loss-tangent" and _drifts(joined.isotherms, log10_b):
            found = _between_models(found, fitted_shifts(joined, kelvin, held, not free, quantities), free)
    else:
        found = given_shifts(joined, kelvin, shift.at_reference(kelvin), free)
    made_up = made_up if shift is None else of_synthetic(getattr(shift, "notes", ()))
    factors = ShiftFactors(temperatures, found.values, kelvin, found.covariance, made_up)
    unidentified: tuple[tuple[float, float], ...] = ()
    notes = [*joined.notes, *joined.disagreements(given=shift is not None)]
    if shift is None:
        notes += _on_steps(temperatures, found, len(quantities.weights))
        unidentified = steps_at(temperatures, unidentified_places(found))
        if found.offsets is not None and found.offsets.left_out is not None:
            notes += found.offsets.left_out.notes(temperatures[0], temperatures[-1], DENSITY_OR_FREE)
        if not fixed:
            notes += course_notes(temperatures, found.values, found.covariance)
    if free:
        known = VerticalShiftFactors(temperatures, found.vertical, kelvin, found.vertical_covariance)
        joined = joined.less(known.log10_values)
        notes += _on_vertical(temperatures, found.vertical_covariance)
    if (shift is not None or fixed) and (own := own_shifts(joined.logs, factors.log10_values)).wrong:
        said = f"The given shift factors do not join the isotherms: {own.clause}."
        notes.append(Note("given-factors-wrong", said))
    quality = overlap_quality(joined.logs, factors.log10_values)
    notes += on_gaps(temperatures, quality)
    return joined, {
        "shift_factors": factors,
        "quality": quality,
        "notes": tuple(notes),
        "isotherms": joined.isotherms,
        "vertical_shift": known,
        "cross_covariance": found.cross_covariance if free else None,
        "offsets": found.offsets,
        "unidentified": unidentified,
    }


def _drifts(isotherms: Sequence[Isotherm | StepTest], log10_b: Array) -> bool:
    """Return whether sweeps drift to one side; step tests, of one quantity, cannot be compared without their shifts."""
    sweeps = [one for one in isotherms if isinstance(one, Isotherm)]
    return bool(sweeps) and drift(neighbour_distances(sweeps, log10_b)) is not None


def _between_models(found: CommonShifts, other: CommonShifts, free: bool) -> CommonShifts:
    """Add the difference of the alternative model to the errors: with a free vertical shift, or without if `free`."""
    # Isotherms that drift contradict the requested model; each of the two models is given half of the weight, so that
    # their difference adds half its square to the variance (S. T. Buckland et al., Biometrics 53 (1997) 603). Of the
    # difference of each step, only the part beyond the uncertainty of the free model counts, and beyond what a vertical
    # shift in proportion to temperature explains, which the errors include.
    loose = found if free else other
    nearest = int(np.argmin(np.abs(found.values) + np.diag(found.covariance)))

    def away(difference: Array, covariance: Array) -> Array:
        steps = np.diff(difference)
        steps = np.sign(steps) * np.sqrt(np.maximum(steps**2 - errors_of_steps(covariance) ** 2, 0.0))
        total = np.concatenate([[0.0], np.cumsum(steps)])
        return np.asarray(total - total[nearest])

    left_out = None if found.offsets is None else found.offsets.left_out
    explained = 0.0 if left_out is None else left_out.probability @ TRENDS * left_out.follow
    horizontal = away(other.values - found.values + explained, loose.covariance)
    changed = replace(found, covariance=found.covariance + OTHER_MODEL * np.outer(horizontal, horizontal))
    if not free:
        return changed
    vertical = away(other.vertical - found.vertical, loose.vertical_covariance)
    return replace(
        changed,
        vertical_covariance=found.vertical_covariance + OTHER_MODEL * np.outer(vertical, vertical),
        cross_covariance=found.cross_covariance + OTHER_MODEL * np.outer(horizontal, vertical),
    )


DENSITY_OR_FREE = Remedy(
    ' Compare vertical="density" and "free".',
    " Compare --vertical-shift density and free.",
    ' Compare vertical_shift = "density" and "free" under [material].',
    " Compare the choices of “Vertical shift b(T)”.",
)
#: Steps of log10 α with a larger standard error are not identified by the isotherms …
UNIDENTIFIED = 0.3  # decades
#: … nor are those with a larger one than this whose sign is not known …
SIGN_UNKNOWN = 0.1  # decades
#: … nor steps of log10 b with a larger one, which is mostly that of their prior.
VERTICAL_UNIDENTIFIED = 0.02  # decades


def _on_steps(temperatures: Array, found: CommonShifts, quantities: int) -> Iterator[Note]:
    """Yield notes on neighbours that a common curve moved apart, and on steps of α that are not identified."""
    if found.parted:
        disagree = cure = ""
        if quantities > 1:
            disagree = ", or E' and E'' do not agree on the shift"
            cure = ", and look for loss moduli that the instrument itself makes, as a resonance does at its highest "
            cure += "frequencies"
        yield Note(
            "joined-by-pairs",
            f"The isotherms from {ranges(steps_at(temperatures, found.parted))} were joined pair by pair: one common "
            f"curve would move them apart, as where they overlap little{disagree}; each step there is uncertain by "
            f"{PAIR_UNCERTAINTY:g} decades or more. Measure closer temperatures{cure}.",
        )
    places = unidentified_places(found)
    if places:
        yield Note(
            "alpha-not-identified",
            f"α is not identified from {ranges(steps_at(temperatures, places))}: the isotherms there join about as "
            "well over a wide range of shifts, as where moduli change too little for their scatter (standard error of "
            f"a step up to {max(errors_of_steps(found.covariance)[places]):.1g} decades).",
        )


def _on_vertical(temperatures: Array, covariance: Array) -> Iterator[Note]:
    """Yield a note on the temperatures between which the isotherms do not determine b."""
    errors = errors_of_steps(covariance)
    places = np.flatnonzero(errors > VERTICAL_UNIDENTIFIED)
    if places.size:
        yield Note(
            "vertical-not-identified",
            f"b is not identified from {ranges(steps_at(temperatures, places))}: there the isotherms do not separate "
            f"it from α (standard error of a step up to {100.0 * (10.0 ** errors[places].max() - 1.0):.0f} %).",
        )


def unidentified_places(found: CommonShifts) -> list[int]:
    """Return the indices of steps of log10 α that the isotherms do not determine."""
    errors = errors_of_steps(found.covariance)
    either_sign = (errors > SIGN_UNKNOWN) & (np.abs(np.diff(found.values)) < 2.0 * errors)
    return [int(place) for place in np.flatnonzero((errors > UNIDENTIFIED) | either_sign)]


def errors_of_steps(covariance: Array) -> Array:
    """Return the standard errors of differences between neighbours."""
    variance = np.diag(covariance)
    return np.sqrt(np.maximum(variance[1:] + variance[:-1] - 2.0 * np.diag(covariance, 1), 0.0))
