"""Time–temperature superposition: isotherms shifted onto one master curve at a reference temperature."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from viscofric.arguments import insist_on
from viscofric.data import IsothermalSweeps, MasterCurve
from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShift, VerticalShiftFactors
from viscofric.rheology.superposition.held_shifts import fitted_shifts, given_shifts, held_places
from viscofric.rheology.superposition.joined_isotherms import (
    JoinedIsotherms,
    as_given,
    join_isotherms,
    ranges,
    shown,
    usable,
)
from viscofric.rheology.superposition.overlap import (
    PAIR_UNCERTAINTY,
    LogSweep,
    OverlapQuality,
    overlap_quality,
    own_shifts,
)
from viscofric.rheology.superposition.quantity import Quantities
from viscofric.rheology.superposition.result import Superposition
from viscofric.rheology.superposition.van_gurp_palmen import drift, neighbour_distances
from viscofric.threads import one_blas_thread
from viscofric.units import checked_poisson_ratio, kelvin_hint, positive, shown_celsius

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from viscofric.arrays import Array
    from viscofric.rheology.superposition.common_shifts import CommonShifts
    from viscofric.rheology.superposition.quantity import ShiftBy
    from viscofric.units import Quantity


#: Weight of the other model, with a free vertical shift or without one, where isotherms drift.
OTHER_MODEL = 0.5
#: Steps of log10 α with a larger standard error are not identified by the sweeps …
UNIDENTIFIED = 0.3  # decades
#: … nor are those with a larger one than this whose sign is not known …
SIGN_UNKNOWN = 0.1  # decades
#: … nor steps of log10 b with a larger one, which is mostly what was assumed of them.
VERTICAL_UNIDENTIFIED = 0.02  # decades


@one_blas_thread
def superpose(
    sweeps: IsothermalSweeps,
    reference: Quantity,
    poisson_ratio: float = 0.5,
    *,
    vertical: Literal["free", "density"] | VerticalShift | None = None,
    shift: ShiftLaw | None = None,
    fixed: Mapping[Any, float] | None = None,
    by: ShiftBy = "both",
    weights: Sequence[float] | None = None,
) -> Superposition:
    """Shift isotherms onto one master curve, by E' and E'' jointly, all at once.

    E(ω, T) = b(T) E(α(T) ω, reference).

    Parameters
    ----------
    sweeps : IsothermalSweeps
        At least two isotherms that overlap.
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
    Superposition

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
    and a note says which.  Vertical shifts cancel in tan δ: ``"free"`` ones are fitted to both moduli in a second
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
    not in them.  With a free vertical shift, offsets that E' and E'' share are part of b.

    Where isotherms drift to one side (`SuperpositionCheck.drift`), a vertical shift may be missing, or none describes
    them.  Then half of the squared difference to the shifts beside a free one counts as variance of α; where they drift
    beside a free one too, half of that to the shifts without.  Below what drift shows, a vertical shift
    that is left out moves α by more than its errors: what follows ρT, from −30 to 90 °C, by up to 0.13 decades; what it
    costs is the difference to a second superposition, with ``vertical="density"``.

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
    if not isinstance(sweeps, IsothermalSweeps):
        raise InputError(
            f"sweeps must be IsothermalSweeps, not {type(sweeps).__name__}; read them with read_dma(…), as in "
            "superpose(read_dma('sweeps.csv'), '20 degC').",
            code="wrong-type",
        )
    kelvin = positive(reference, "K", "reference")
    ratio = checked_poisson_ratio(poisson_ratio)
    insist_on(shift, "shift", ShiftLaw, type(None), right="a shift law, ShiftFactors or None")
    insist_on(fixed, "fixed", Mapping, type(None), right="a mapping of temperatures to log10 α")
    if shift is not None and fixed:
        raise InputError(
            "shift and fixed: give one of them; with shift no factor is left to be fitted.", code="give-one"
        )
    tensile = sweeps.in_tension(ratio)
    usable(tensile.isotherms)
    quantities = Quantities.chosen(by, weights)
    known = _known_vertical(vertical, kelvin)
    quantities.insist_on_use(vertical, shift)
    logs = [
        LogSweep.of(isotherm, 0.0 if known is None else known.log10(isotherm.temperature))
        for isotherm in tensile.isotherms
    ]
    if shift is None:
        joined = join_isotherms(tensile.isotherms, logs, quantities)
    else:
        joined = as_given(tensile.isotherms, logs, shift.at_reference(kelvin))
    temperatures = np.array([isotherm.temperature for isotherm in joined.isotherms])
    if not temperatures[0] - NOMINAL <= kelvin <= temperatures[-1] + NOMINAL:
        raise InputError(
            f"reference = {shown_celsius(kelvin)} °C lies outside the joined isotherms, "
            f"{shown(temperatures[0])} to {shown(temperatures[-1])}{kelvin_hint(kelvin)}. "
            f"{' '.join(joined.notes)}".rstrip(),
            code="reference-outside",
        )
    free = vertical == "free"
    if shift is None:
        held = held_places(fixed or {}, temperatures, kelvin)
        found = fitted_shifts(joined, kelvin, held, free, quantities)
        log10_b = found.vertical if known is None else np.asarray(known.log10(temperatures))
        if by != "loss-tangent" and drift(neighbour_distances(joined.isotherms, log10_b)) is not None:
            found = _between_models(found, fitted_shifts(joined, kelvin, held, not free, quantities), free)
    else:
        found = given_shifts(joined, kelvin, shift.at_reference(kelvin), free)
    factors = ShiftFactors(temperatures, found.values, kelvin, found.covariance)
    unidentified: tuple[tuple[float, float], ...] = ()
    notes = [*tensile.notes, *quantities.notes, *joined.notes, *joined.disagreements(given=shift is not None)]
    if shift is None:
        notes += _joined_by_pairs(temperatures, found.parted)
        places = _unidentified(found.values, found.covariance)
        unidentified = _steps(temperatures, places)
        notes += _unidentified_steps(unidentified, max(_errors_of_steps(found.covariance)[places], default=0.0))
    if free:
        known = VerticalShiftFactors(temperatures, found.vertical, kelvin, found.vertical_covariance)
        joined = joined.less(known.log10_values)
        notes += _unidentified_vertical(temperatures, found.vertical_covariance)
    if shift is not None or fixed:
        notes += _badly_given(joined.logs, factors.log10_values)
    quality = overlap_quality(joined.logs, factors.log10_values)
    notes += _without_overlap(temperatures, quality)
    return Superposition(
        factors,
        _master_curve(joined, factors),
        quality,
        tuple(notes),
        joined.isotherms,
        known,
        found.cross_covariance if free else None,
        found.offsets,
        unidentified,
        quantities.by,
        None if weights is None else (float(quantities.weights[0]), float(quantities.weights[1])),
    )


def _between_models(found: CommonShifts, other: CommonShifts, free: bool) -> CommonShifts:
    """Add to the errors what the other model would change: a free vertical shift, or none if `free`.

    Isotherms that drift contradict the model that was asked for; each of the two models is given half of the weight, so
    that about one the other is off by their difference with a variance of half its square (S. T. Buckland et al.,
    Biometrics 53 (1997) 603).  Differences count step by step, as far as they exceed what is not known of the free one.
    """
    loose = found if free else other
    nearest = int(np.argmin(np.abs(found.values) + np.diag(found.covariance)))

    def away(difference: Array, covariance: Array) -> Array:
        steps = np.diff(difference)
        steps = np.sign(steps) * np.sqrt(np.maximum(steps**2 - _errors_of_steps(covariance) ** 2, 0.0))
        total = np.concatenate([[0.0], np.cumsum(steps)])
        return np.asarray(total - total[nearest])

    horizontal = away(other.values - found.values, loose.covariance)
    changed = replace(found, covariance=found.covariance + OTHER_MODEL * np.outer(horizontal, horizontal))
    if not free:
        return changed
    vertical = away(other.vertical - found.vertical, loose.vertical_covariance)
    return replace(
        changed,
        vertical_covariance=found.vertical_covariance + OTHER_MODEL * np.outer(vertical, vertical),
        cross_covariance=found.cross_covariance + OTHER_MODEL * np.outer(horizontal, vertical),
    )


def _known_vertical(vertical: Literal["free", "density"] | VerticalShift | None, kelvin: float) -> VerticalShift | None:
    """Return b(T) where it need not be fitted."""
    if isinstance(vertical, VerticalShift):
        return vertical.at_reference(kelvin)
    if vertical == "density":
        return DensityShift(kelvin)
    if vertical not in (None, "free"):
        raise InputError(
            f"vertical shift {vertical!r}: must be 'free', 'density', a VerticalShift or None.", code="wrong-choice"
        )
    return None


def _badly_given(logs: list[LogSweep], log10_shifts: Array) -> list[str]:
    """Say in a sentence that the shift factors that were given join the isotherms badly on the whole."""
    found = own_shifts(logs, log10_shifts)
    text = f"The given shift factors do not join the isotherms: {found.clause}."
    return [Note("given-factors-wrong", text)] if found.wrong else []


def _joined_by_pairs(temperatures: Array, places: tuple[int, ...]) -> list[str]:
    """Name the temperatures where a common curve moved neighbours past each other, in one sentence."""
    if not places:
        return []
    sentence = (
        f"The sweeps from {ranges(_steps(temperatures, places))} were joined pair by pair: one common curve would "
        "move them past each other although their storage moduli overlap, because E' and E'' do not agree on the "
        f"shift; each step there is uncertain by {PAIR_UNCERTAINTY:g} decades or more. Look for loss moduli that "
        "the instrument itself makes, as a resonance does at its highest frequencies."
    )
    return [Note("joined-by-pairs", sentence)]


def _without_overlap(temperatures: Array, quality: OverlapQuality) -> list[str]:
    """Name the neighbours that do not overlap once shifted, in one sentence."""
    if not quality.gaps:
        return []
    sentence = (
        f"{quality.without_overlap} of {quality.neighbours} pairs of neighbouring sweeps do not overlap once shifted, "
        f"from {ranges(_steps(temperatures, quality.gaps))}: nothing measured tests the shift there."
    )
    return [Note("no-overlap", sentence)]


def _unidentified(values: Array, covariance: Array) -> list[int]:
    """Return the places of steps of log10 α that the sweeps do not fix."""
    errors = _errors_of_steps(covariance)
    either_sign = (errors > SIGN_UNKNOWN) & (np.abs(np.diff(values)) < 2.0 * errors)
    return [int(place) for place in np.flatnonzero((errors > UNIDENTIFIED) | either_sign)]


def _unidentified_steps(steps: tuple[tuple[float, float], ...], error: float) -> list[str]:
    """Name the temperatures between which the sweeps do not fix α, in one sentence."""
    if not steps:
        return []
    sentence = (
        f"α is not identified from {ranges(steps)}: the sweeps there join about as well over a wide range of shifts, "
        "as where moduli change too little with frequency for their scatter (standard error of a step up to "
        f"{error:.1g} decades)."
    )
    return [Note("alpha-not-identified", sentence)]


def _unidentified_vertical(temperatures: Array, covariance: Array) -> list[str]:
    """Name the temperatures between which the sweeps do not fix b, in one sentence."""
    errors = _errors_of_steps(covariance)
    places = np.flatnonzero(errors > VERTICAL_UNIDENTIFIED)
    if not places.size:
        return []
    sentence = (
        f"b is not identified from {ranges(_steps(temperatures, places))}: there the sweeps do not separate it from α "
        f"(standard error of a step up to {100.0 * (10.0 ** errors[places].max() - 1.0):.0f} %)."
    )
    return [Note("vertical-not-identified", sentence)]


def _steps(temperatures: Array, places: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return the two temperatures of each step."""
    return tuple((float(temperatures[place]), float(temperatures[place + 1])) for place in places)


def _errors_of_steps(covariance: Array) -> Array:
    """Return the standard errors of differences between neighbours."""
    variance = np.diag(covariance)
    return np.sqrt(np.maximum(variance[1:] + variance[:-1] - 2.0 * np.diag(covariance, 1), 0.0))


def _master_curve(joined: JoinedIsotherms, shift_factors: ShiftFactors) -> MasterCurve:
    """Collect all points, moved along both axes."""
    shifts = zip(joined.logs, shift_factors.log10_values, strict=True)
    frequency = np.concatenate([sweep.frequency + shift for sweep, shift in shifts])
    order = np.argsort(frequency, kind="stable")
    moduli = 10.0 ** np.concatenate([sweep.moduli for sweep in joined.logs])[order]
    temperature = np.repeat([i.temperature for i in joined.isotherms], [len(i) for i in joined.isotherms])
    return MasterCurve(
        10.0 ** frequency[order], moduli[:, 0], moduli[:, 1], temperature[order], shift_factors.reference
    )
