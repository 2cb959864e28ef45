"""Time–temperature superposition: isotherms shifted onto one master curve at a reference temperature."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict, Unpack, overload

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.data import Isotherm, IsothermalSweeps, MasterCurve
from viscofric.errors import InputError
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift, known_vertical
from viscofric.rheology.superposition.joined_isotherms import STEP, JoinedIsotherms, Quantities, ShiftBy
from viscofric.rheology.superposition.joint import JointSuperposition, insist_on_kinds, joined_kinds
from viscofric.rheology.superposition.overlap import LogSweep
from viscofric.rheology.superposition.result import (
    PER_DECADE,
    StepSuperposition,
    Superposition,
    flowing,
    weights_of_averages,
)
from viscofric.rheology.superposition.shifted_isotherms import shifted_isotherms
from viscofric.step_tests import StepKind, StepMasterCurve, StepTest, StepTests
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, checked_poisson_ratio, positive


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
    beside a free one too, half of that to the shifts without.  Below what drift shows, a vertical shift
    that is left out moves α by more than its errors: what follows ρT, from −30 to 90 °C, by up to 0.13 decades; what it
    costs is the difference to a second superposition, with ``vertical="density"``.

    Of step tests log J(t), or log E(t), is brought onto one curve over log t, by the same fit.  Its points are averaged
    over twentieths of a decade of time first: instruments record far more of them at long times, with errors that are
    alike.  The weight of an average grows with its number of readings, as far as their errors are independent, up to
    that of eight.  One curve for each temperature shows less than E' and E'': offsets of isotherms are found as far as
    the curve bends, and where it is a power law, they are taken for shifts.  The shifts are the most likely ones with
    offsets of the size found (`step_profiles`).  With ``vertical="free"`` offsets are part of b.

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
        read = sweeps.in_tension(ratio)
        tests = read.thinned(PER_DECADE)
        weights_of = weights_of_averages(read.tests, tests.kind)
        logs = [LogSweep.of_step(one, tests.kind, own) for one, own in zip(tests.tests, weights_of, strict=True)]
        steps, found = shifted_isotherms(tests.tests, logs, kelvin, known, vertical == "free", shift, fixed, STEP)
        found["notes"] = (*tests.notes, *found["notes"], *(flowing(steps.isotherms) if tests.kind == "creep" else []))
        return StepSuperposition(master_curve=_step_master_curve(steps, found["shift_factors"], tests.kind), **found)
    assert isinstance(sweeps, IsothermalSweeps)
    tensile = sweeps.in_tension(ratio)
    quantities = Quantities.chosen(by, weights)
    quantities.insist_on_use(vertical, shift)
    logs = [LogSweep.of(isotherm) for isotherm in tensile.isotherms]
    joined, found = shifted_isotherms(
        tensile.isotherms, logs, kelvin, known, vertical == "free", shift, fixed, quantities
    )
    found["notes"] = (*tensile.notes, *quantities.notes, *found["notes"])
    unequal = None if weights is None else (float(quantities.weights[0]), float(quantities.weights[1]))
    curve = _master_curve(joined, found["shift_factors"])
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
