"""Results of a converged identification: enlarged errors, bands, the family of levels, the material's origin."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.assumption_check import ContactSize
from viscofric.friction.coulomb import check_coupling
from viscofric.friction.curve_checks import (
    LEAST_FREEDOM,
    LEFT_OUT,
    MEAN_SQUARE,
    MOST_OVER_MEDIAN,
    implausible,
    outliers,
    outlying_points,
    with_tails,
)
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.finite_thickness import check_half_space
from viscofric.friction.identification.drawn_materials import Findings, level_family, limits
from viscofric.friction.identification.iteration import Weighed, freedom_of, leverage_of, misfit, most_evident, weighed
from viscofric.friction.identification.posterior import correlation, too_small
from viscofric.friction.identification.problem import Problem
from viscofric.friction.identification.result import (
    LAYER,
    NOTHING_IDENTIFIED,
    IdentifiedBand,
    IdentifiedMaterial,
    LevelFit,
    log_magnitudes,
    with_origin,
)
from viscofric.friction.identification.solving import Contacts
from viscofric.notes import Note, Remedy, codes
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.uncertainty.material_samples import MaterialSamples

#: What to do where errors are shared.
SHARED = Remedy(
    "; give the shared part as common_error, level_error, drift_error, coulomb_level_error or temperature_error.",
    "; give the shared part as --common-error, --level-error, --drift-error, --coulomb-level-error or "
    "--temperature-error.",
    page="; viscofric identify has options for the shared part.",
)
#: Residuals this many times as large as the errors, and larger than the limit of identification, indicate a model that
#: fails, not scatter: if successive residuals are correlated, and in any case.
MODEL_FAILS, MODEL_FAILS_ANYHOW = 3.0, 10.0
#: Successive residuals are correlated from this many standard deviations of von Neumann's ratio on.
FOLLOWING = 3.0
#: The given moduli contradict the friction if the fit differs from them by more standard errors.
CONTRADICTED = 4.0
#: Bands of moduli end at this factor beyond the contact's frequencies v/a: Hertz's pressure has waves up to 3/a.
BEYOND = 3.0


@dataclass(frozen=True, eq=False)
class Outcome:
    """A converged identification."""

    curves: FrictionCurves
    start: Problem  # as set up
    fits: list[Weighed[Problem]]
    iterations: int
    contacts: Contacts
    accuracy: float  # of the contacts
    shift: ShiftLaw | None  # as given
    name: str  # of the material
    anchored: bool  # whether anything fixes the level of the modulus


def conclude(outcome: Outcome, *, limit: float, samples: int, seed: int, levels: Sequence[float]) -> IdentifiedMaterial:
    """Return the result; see `identify_material` for the arguments."""
    fits, away, error_scale = _with_tails(outcome.fits)
    best = most_evident(fits)
    low, high = _frequencies(best)
    ratio, anchored = outcome.contacts.poisson_ratio, outcome.anchored
    found = Findings(
        fits, (low, high), shift=outcome.shift, poisson_ratio=ratio, name=outcome.name, samples=samples, seed=seed
    )
    middle, drawn, points = found.middle, found.drawn, best.problem.points
    measured = outcome.curves.select(points.rows)
    of_outliers = outlying_points(measured.speed, measured.temperature, away)
    doubts = tuple(_doubts(outcome, error_scale, best, limit))
    bands = [
        IdentifiedBand(middle, middle, limit, not anchored)
        if codes(doubts) & NOTHING_IDENTIFIED
        else found.band(part, (low / BEYOND, high * BEYOND), limit, relative=not anchored)
        for part in ("magnitude", "storage", "loss")
    ]
    family: tuple[LevelFit, ...] = ()
    if not anchored:
        family = level_family(found, outcome.contacts, levels, outcome.iterations + 1, outcome.accuracy)
    of_anchors = _anchor_notes(best, drawn, middle, limit) if anchored else ()
    fitted, residuals = _fitted(outcome, found)
    common = found.common(bands, residuals, error_scale)
    thickness, coupling = _contacts(outcome, common["material"])
    level_range = limits(np.abs([one.complex_modulus(middle) for one in drawn.materials]))
    result = IdentifiedMaterial(
        **common,
        anchored=anchored,
        level_range=(float(level_range[0]), float(level_range[1])),
        family=family,
        friction=fitted,
        residuals=residuals,
        iterations=outcome.iterations,
        half_space_thickness=thickness,
        notes=(*points.notes, *of_outliers, *doubts, *coupling, *of_anchors),
    )
    return replace(result, material=with_origin(result, outcome.curves.source))


def _with_tails(fits: list[Weighed[Problem]]) -> tuple[list[Weighed[Problem]], Array, float]:
    """Give points far from the others less weight, enlarge errors that the residuals exceed, and fit again.

    Also returns by how many standard errors each outlier (n,) lies off, zero for other points, and the factor of the
    errors.
    """
    best = most_evident(fits)
    errors = best.problem.point_errors
    factors, scale = np.ones(len(errors)), 1.0

    def fit(larger: Array, before: float) -> tuple[Weighed[Problem], Array, float]:
        nonlocal best, fits, factors, scale
        if np.any(before * larger != factors):
            factors = before * larger
            fits = weighed(best.problem.with_errors(errors * np.sqrt(factors)), best.minimum.place)
            best = most_evident(fits)
        own = np.maximum(1.0 - leverage_of(best, len(errors)), LEAST_FREEDOM)
        away = np.sqrt(before) * _residuals(best)
        # Squared distances from the fit to the others, over their expectation: the point itself has its stated error.
        squares = larger * away**2 / (own * (own + (1.0 - own) * larger))
        ratio, doubtful = misfit(best, away / np.sqrt(MEAN_SQUARE), larger < LEFT_OUT)
        scale = max(min(ratio, MOST_OVER_MEDIAN * float(np.median(squares))), 1.0) if doubtful else 1.0
        return best, squares, scale

    best, larger, squares = with_tails(np.ones(len(errors)), fit)
    _, outlying = outliers(squares, larger, freedom_of(best, len(errors)), 1.0)
    return fits, np.where(outlying, np.sqrt(squares), 0.0), float(np.sqrt(scale))


def _contacts(outcome: Outcome, material: Material) -> tuple[float, tuple[str, ...]]:
    """Return the thickness of rubber that serves, m, and a note where Coulomb friction changes friction by too much."""
    points, indenter = outcome.start.points, outcome.contacts.indenter
    measured = points.at_one_load(outcome.curves)
    measured = replace(measured, load=points.forces, load_unit=indenter.geometry.load_unit)
    sizes = ContactSize.all_of(material, indenter, measured)
    coupled = check_coupling(measured, material, None, [(one.smallest, one.smallest) for one in sizes])
    notes = () if coupled is None or coupled.holds else (coupled.sentence,)
    return float(check_half_space(material, measured, sizes, None, LAYER).values["thickness_for_friction"]), notes


def _doubts(outcome: Outcome, error_scale: float, best: Weighed[Problem], limit: float) -> Iterator[Note]:
    """Yield notes on doubts about the residuals and the friction."""
    points, away = outcome.start.points, _residuals(best)
    with_shared = replace(points, error=np.hypot(points.error, np.linalg.norm(points.shared, axis=1)))
    implausible_friction = implausible(with_shared.at_one_load(outcome.curves))
    yield from implausible_friction
    if error_scale == 1.0:
        if not implausible_friction and "errors-from-scatter" not in codes(points.notes):
            example = "as that of an assumed Coulomb friction"
            yield from too_small(away, freedom_of(best, len(points)), example, SHARED)
        return
    scaled = f"The residuals are {error_scale:.2g} times larger than the standard errors of the friction"
    follow = _follow_each_other(best, away)
    missed = float(np.sqrt(np.mean((away * best.problem.points.error) ** 2)))
    if missed > limit and error_scale > (MODEL_FAILS if follow else MODEL_FAILS_ANYHOW):
        yield Note(
            "not-one-rubber",
            f"{scaled}, and {100.0 * missed:.2g} % of it: no linear rubber of a smooth spectrum has this friction, and "
            "nothing is identified, however narrow the bands of the nearest one; check the measurement, the load and "
            "the indenter.",
        )
    elif follow:
        yield Note(
            "structured-residuals",
            f"{scaled}, which were multiplied by that, and are correlated along the speed: they are not scatter, and "
            "the bands are too narrow.",
        )
    else:
        yield Note(
            "errors-enlarged",
            f"{scaled}, which were multiplied by that: they are too small, or one shifted material does not describe "
            "all of the points.",
        )


def _residuals(best: Weighed[Problem]) -> Array:
    """Return modelled minus measured ln μ of every point, over its error."""
    return best.problem.measured(best.minimum.place)[0][: len(best.problem.points)]


def _follow_each_other(best: Weighed[Problem], residuals: Array) -> bool:
    """Whether successive residuals are correlated, in the order of reduced speed, or temperature by temperature."""
    points, (_, log_alpha) = best.problem.points, best.problem.split(best.minimum.place)
    reduced = points.log_speed + log_alpha[points.number]
    orders = (np.argsort(reduced, kind="stable"), np.lexsort((points.log_speed, points.number)))
    return max(correlation(residuals[order]) for order in orders) > FOLLOWING


def _anchor_notes(best: Weighed[Problem], drawn: MaterialSamples, middle: float, limit: float) -> Iterator[Note]:
    """Yield notes on anchors that do not determine the level, or contradict the friction or each other."""
    spread = float(np.std(log_magnitudes(drawn, middle), ddof=1))
    if spread > limit:
        yield Note(
            "level-not-fixed",
            "The anchor or prior does not fix the level of the modulus at the frequencies of the friction: the "
            f"standard error of |E| at {middle:.2g} rad/s is {100.0 * spread:.2g} %; give an anchor near there.",
            values={"frequency": middle, "standard_error": spread},
        )
    points = len(best.problem.points)
    away = float(np.max(np.abs(best.problem.measured(best.minimum.place)[0][points:]), initial=0.0))
    if away > CONTRADICTED:
        yield Note(
            "anchor-contradicted",
            f"The anchor or prior differs from the fit by {away:.2g} of its standard errors: it contradicts the "
            "friction or itself.",
            values={"standard_errors": away},
        )


def _frequencies(best: Weighed[Problem]) -> tuple[float, float]:
    """Return the lowest and the highest of the contacts' frequencies v/a at the reference, rad/s."""
    problem = best.problem
    compliances, log_alpha = problem.split(best.minimum.place)
    points = problem.points
    reduced = points.log_speed + log_alpha[points.number]
    ends = np.array([reduced.min(), reduced.max()])
    low, high = np.exp(ends - problem.friction.first(compliances, ends).log_radius)
    return float(low), float(high)


def _fitted(outcome: Outcome, findings: Findings[Problem]) -> tuple[FrictionCurves, Array]:
    """Return the friction of the identified material at the points, and the residuals over the standard errors."""
    problem, place = findings.best.problem, findings.best.minimum.place
    points = problem.points
    value, _ = problem.modelled(place)
    drawn = np.array([problem.modelled(row)[0] for row in findings.rows])
    lower, upper = np.exp(limits(drawn) + points.raised)
    friction = np.exp(value + points.raised)
    measured = outcome.curves.select(points.rows)
    solved = problem.friction.solved
    relative = 0.0 if solved is None else float(solved.error.max())
    curves = FrictionCurves(
        speed=measured.speed,
        temperature=measured.temperature,
        load=points.forces,
        viscoelastic=friction,
        viscoelastic_error=relative * friction,
        viscoelastic_scatter=np.zeros(len(friction)),
        replicates=np.ones(len(friction), dtype=np.int64),
        source="identified material",
        load_unit=outcome.contacts.indenter.geometry.load_unit,
        material_error=drawn.std(axis=0, ddof=1) * friction,
        viscoelastic_lower=lower,
        viscoelastic_upper=upper,
    )
    return curves, -problem.missed(place)[0] / points.error
