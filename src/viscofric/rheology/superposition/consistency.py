"""Whether time–temperature superposition holds: comparison of neighbouring isotherms, and of E' with E''."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal, TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Isotherm, MasterCurve
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.notes import Note, Remedy, dumped, note_of, records
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.superposition.joined_isotherms import LARGEST_MISFIT, on_gaps, ranges
from viscofric.rheology.superposition.kramers_kronig import KramersKronig, kramers_kronig
from viscofric.rheology.superposition.overlap import LogSweep, OverlapQuality, OwnShifts, own_shifts
from viscofric.showing import Plotted, Rows, Shown, with_error
from viscofric.units import shown_celsius

# Plotted as tan δ against |E*| (H. C. Booij, J. H. M. Palmen, Theoretical and Applied Rheology, 1992, 321; M. van
# Gurp, J. Palmen, Rheol. Bull. 67 (1998) 5, with δ instead), isotherms that superpose lie on one curve, whatever their
# shift factors are.

#: Degree of the curve of an isotherm of two or three decades, by its number of points.
_DEGREE = ((8, 3), (5, 2), (2, 1))  # (points, degree)
#: Number of segments of the curve for distances from it; their length causes an error below 1e-4 decades.
_SEGMENTS = 40
_KNOTS = np.linspace(-1.0, 1.0, _SEGMENTS + 1)
#: Points are compared with an isotherm whose values of both quantities end this far from them at most; two sweeps whose
#: moduli differ by more than half of it at every shift are not joined.
FARTHEST = 2.0 * LARGEST_MISFIT  # decades
#: Isotherms drift apart if at least this many neighbours lie to the same side of each other on the whole …
RUN = 3
#: … by more than this in sum, the difference of two isotherms that repeat to 0.02 decades …
DRIFT = 0.045  # decades
#: … and by more than this many standard errors.  A single distance counts at most as this part of the above: one faulty
#: sweep is no drift.
SURE = 6.0
LARGEST_PART = 2.0 / 3.0


@dataclass(frozen=True)
class Drift:
    """A run of isotherms that move apart to one side, which errors of single isotherms do not explain."""

    colder: float  # ends of the run, K
    warmer: float
    # Sum of the signed distances of neighbours, decades; above zero where tan δ falls with temperature at the same
    # |E*|.
    distance: float
    standard_error: float  # of the sum, decades
    neighbours: int  # pairs of neighbours in the run


@dataclass(frozen=True)
class NeighbourDistance:
    """Distance of two neighbouring isotherms in log tan δ against log |E*|."""

    colder: float  # their temperatures, K
    warmer: float
    # Mean distance at right angles to the curve, decades; above zero where the colder one has the greater tan δ.
    distance: float
    standard_error: float  # of the distance, from the scatter of each isotherm about its own smooth curve; decades
    points: int  # measured points of both isotherms within the range of the other's curve


@dataclass(frozen=True, eq=False)
class _Curve:
    """One isotherm as a smooth curve (log |E*|, log tan δ) of a parameter from −1 to 1."""

    temperature: float
    basis: Array  # (n, m)
    coefficients: Array  # (m, 2)
    inverse: Array  # (m, m)
    scatter: Array  # (2,)

    @cached_property
    def points(self) -> Array:
        """The curve at the measured parameters (n, 2)."""
        return np.asarray(self.basis @ self.coefficients)

    @cached_property
    def line(self) -> Array:
        """The curve at the ends of its segments."""
        return np.asarray(self.rows(_KNOTS) @ self.coefficients)

    @classmethod
    def of(cls, isotherm: Isotherm, log10_b: float) -> _Curve:
        decades = np.log10(isotherm.angular_frequency)
        parameter = 2.0 * (decades - decades[0]) / np.ptp(decades) - 1.0
        count = len(decades)
        degree = next(degree for points, degree in _DEGREE if count >= points)
        basis = _legendre(parameter, degree)
        size = np.log10(np.hypot(isotherm.storage_modulus, isotherm.loss_modulus)) - log10_b
        points = np.stack([size, np.log10(isotherm.loss_modulus / isotherm.storage_modulus)], axis=1)
        inverse = np.asarray(np.linalg.inv(basis.T @ basis), dtype=float)
        coefficients = inverse @ (basis.T @ points)
        freedom = max(count - degree - 1, 1)
        scatter = np.sqrt(np.sum((points - basis @ coefficients) ** 2, axis=0) / freedom)
        return cls(isotherm.temperature, basis, coefficients, inverse, scatter)

    def rows(self, parameter: Array) -> Array:
        """Return the basis at other parameters."""
        return _legendre(parameter, self.basis.shape[1] - 1)

    def variance(self, normals: Array, rows: Array) -> float:
        """Return the variance of the mean of the curve's components along normals (k, 2) at basis rows (k, m)."""
        weights = (normals[:, :, None] * rows[:, None, :]).mean(axis=0)
        return float(np.einsum("c,ci,ij,cj->", self.scatter**2, weights, self.inverse, weights))


def _legendre(x: Array, degree: int) -> Array:
    """Return Legendre polynomials up to a degree, 3 at most, in columns."""
    every = [np.ones_like(x), x, 1.5 * x**2 - 0.5, (2.5 * x**2 - 1.5) * x]
    return np.asarray(np.stack(every[: degree + 1], axis=1), dtype=float)


def neighbour_distances(isotherms: Sequence[Isotherm], log10_b: Array) -> tuple[NeighbourDistance, ...]:
    """Compare each isotherm, moduli over b, with its next warmer neighbour where they have a common range."""
    curves = [_Curve.of(isotherm, float(b)) for isotherm, b in zip(isotherms, log10_b, strict=True)]
    found = []
    for colder, warmer in pairwise(curves):
        forth, back = _distances(colder, warmer), _distances(warmer, colder)
        both = [(forth[0], forth[1]), (-back[0], back[1])]
        seen = [one for one, points in zip(both, (forth[2], back[2]), strict=True) if points]
        if seen:
            distance, error = np.mean(seen, axis=0)  # of the same noise: the two errors do not average out
            points = forth[2] + back[2]
            found.append(
                NeighbourDistance(colder.temperature, warmer.temperature, float(distance), float(error), points)
            )
    return tuple(found)


def drift(neighbours: Sequence[NeighbourDistance]) -> Drift | None:
    """Return the largest drift, or None where there is none."""
    # Errors of single isotherms cancel in the sum over a run, except for its two ends; changes with temperature add up:
    # a missing vertical shift, a second relaxation, a sample that changes. All runs are evaluated. Errors σ of single
    # isotherms make the differences of consecutive distances scatter by √6 σ, and a sum over a run by √2 σ.
    distances = np.array([pair.distance for pair in neighbours])
    single = float(np.mean(np.diff(distances) ** 2)) / 6.0 if len(distances) > 1 else 0.0
    found = None
    for first in range(len(neighbours)):
        total, distance, variance = 0.0, 0.0, 0.0
        for count, pair in enumerate(neighbours[first:], 1):
            if count > 1 and pair.colder != neighbours[first + count - 2].warmer:
                break
            total += float(np.clip(pair.distance, -LARGEST_PART * DRIFT, LARGEST_PART * DRIFT))
            distance += pair.distance
            variance += pair.standard_error**2
            largest = DRIFT if found is None else abs(found.distance)
            error = float(np.sqrt(max(variance, 2.0 * single)))
            if count >= RUN and abs(total) > DRIFT and abs(distance) > max(largest, SURE * error):
                found = Drift(neighbours[first].colder, pair.warmer, distance, error, count)
    return found


def _distances(one: _Curve, other: _Curve) -> tuple[float, float, int]:
    """Return the mean distance of one smoothed isotherm from the other, its standard error, and number of points."""
    line, points = other.line, one.points
    along = np.diff(line, axis=0)
    length = np.sum(along**2, axis=1) + 1e-300
    away = points[:, None, :] - line[None, :-1, :]
    place = np.sum(away * along, axis=2) / length
    offset = away - np.minimum(np.maximum(place, 0.0), 1.0)[..., None] * along
    nearest = np.argmin(np.sum(offset**2, axis=2), axis=1)
    each = np.arange(len(points))
    place = place[each, nearest]
    # A foot beyond an end of the other curve: no comparison. Nor of points far from all of it, to which the bend of a
    # curve at its end may turn.
    beside = ~(((nearest == 0) & (place < 0.0)) | ((nearest == _SEGMENTS - 1) & (place > 1.0)))
    beside &= np.all((points >= line.min(axis=0) - FARTHEST) & (points <= line.max(axis=0) + FARTHEST), axis=1)
    if np.count_nonzero(beside) < 2:
        return 0.0, 0.0, 0
    tangent = along[nearest] / np.sqrt(length[nearest])[:, None]
    normals = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    normals = (normals * np.where(normals[:, 1:] < 0.0, -1.0, 1.0))[beside]
    distance = float(np.mean(np.sum(offset[each, nearest][beside] * normals, axis=1)))
    feet = other.rows((_KNOTS[nearest] + place * (_KNOTS[1] - _KNOTS[0]))[beside])
    variance = one.variance(normals, one.basis[beside]) + other.variance(normals, feet)
    return distance, float(np.sqrt(variance)), int(np.count_nonzero(beside))


Verdict: TypeAlias = Literal["holds", "other factors", "not identified", "doubtful", "roughly", "fails", "untested"]

#: Two sweeps of one sample agree no better than this, noise apart: the moduli of one analyser, clamp and sample
#: repeat to about 5 %.  Distances of neighbouring isotherms (rms): an acrylic 0.016 (a median of 0.002, one
#: glassy sweep aside), an NBR/PVC foam 0.015, a filled adhesive 0.029, an EVA that melts 0.080; rubbers planted
#: with 0.3, 1 and 3 % noise 0.002, 0.002 and 0.005.
REPRODUCIBILITY = 0.02  # decades
#: Up to this, noise and reproducibility explain the distances of neighbours on the whole.
LARGEST_FIGURE = 1.0
#: Up to this it holds only roughly: a master curve of such sweeps (the adhesive has 1.2) is useful, but its error
#: exceeds their reproducibility.
ROUGH_FIGURE = 2.0
#: A single pair may differ by this many times more: one faulty sweep is no failure of superposition (the worst pair of
#: the acrylic has 2.4, that of the foam 1.5, of the EVA 7).
ONE_PAIR = 3.0
_FEWER = Remedy(" Superpose fewer temperatures.")
_FREE_OR_FEWER = Remedy(
    ' Superpose with vertical="free", or fewer temperatures.',
    " Superpose with --vertical-shift free, or fewer temperatures.",
    ' Superpose with vertical_shift = "free" under [material], or fewer temperatures.',
    " Set “Vertical shift b(T)” to “fitted”, or superpose fewer temperatures.",
)
#: Number of the worst pairs that are named in the sentences.
_NAMED = 3


class Judged(Shown):
    """What checks of sweeps and of step tests have in common: the verdict."""

    verdict: Verdict
    figure_of_merit: float
    sentences: tuple[str, ...]

    @property
    def consistent(self) -> bool:
        """Whether the moduli belong to each other: true of one curve, which has no second one to contradict it."""
        return True

    @property
    def roughly(self) -> bool:
        """Whether superposition holds only roughly: the figure of merit is above 1, and not above 2."""
        return self.verdict == "roughly"

    @property
    def holds(self) -> bool:
        """Whether superposition holds within noise and the reproducibility of measurements, wherever it was tested.

        False where isotherms drift to one side, or where sweeps do not fix a step of α.
        """
        return self.verdict in ("holds", "other factors")

    @property
    def doubts(self) -> tuple[Note, ...]:
        """Notes that superposition does not hold, or that E' and E'' do not belong to each other; none where all do."""
        said = [*(() if self.holds else self.sentences[:1]), *(() if self.consistent else self.sentences[-1:])]
        return tuple(map(note_of, said))

    def _dataset(self, temperatures: Array, sentences: Sequence[str], **more: Any) -> Dataset:
        return dataset(
            "isotherm",
            {"temperature": (temperatures, "K", "temperature")},
            attributes={
                "verdict": self.verdict,
                "holds": int(self.holds),
                "roughly": int(self.roughly),
                "figure_of_merit": self.figure_of_merit,
                "sentences": dumped(records(sentences)),
                **more,
            },
        )


@dataclass(frozen=True, eq=False)
class SuperpositionCheck(Judged, Plotted):
    """Whether the isotherms of a superposition are one material at shifted frequencies.

    Parameters
    ----------
    neighbours : tuple of NeighbourDistance
        Every pair of neighbouring isotherms that can be compared without a shift along the frequency.
    figure_of_merit : float
        Root mean square over neighbours of their distance in log tan δ against log |E*|, each over what noise (95 %)
        and the reproducibility of such measurements (0.02 decades, 5 %) explain together; or a third of the largest
        of these ratios, if that is more.  Superposition holds up to 1; zero where no neighbours can be compared.
    between : float
        Root mean square of these distances, decades.
    within : float
        Median of their standard errors, from the noise within isotherms; decades.
    overlap_misfit : float
        Joint rms misfit of the shifted isotherms where they overlap, decades; as `OverlapQuality.joint`.
    kramers_kronig : KramersKronig or None
        Agreement of E' with E'' on the master curve; None where it is too short to test.
    storage_modulus, loss_modulus, temperature : (n,) array
        Of the points of all isotherms, one isotherm after the other: moduli over the vertical shift, Pa, and K.
    sentences : tuple of str
        The verdict in plain words; the first is a `Note` whose code is ``"superposition-"`` and the verdict.
    verdict : str
        ``"holds"``; ``"other factors"``: it does, but the shift factors do not join the isotherms; ``"not
        identified"``: the sweeps do not fix every step of α (`Superposition.unidentified`); ``"doubtful"``: neighbours
        lie within reproducibility, but isotherms drift to one side (`drift`); ``"roughly"`` or ``"fails"``: they lie
        farther apart; ``"untested"``.
    drift : Drift or None
        The largest run of isotherms that move to one side of each other by more than their errors.

    Notes
    -----
    `holds` concerns superposition alone, whatever the shift factors; `sentences` mention wrong ones.  A loss modulus
    that is wrong alike at all temperatures superposes well; `kramers_kronig` finds it.
    """

    neighbours: tuple[NeighbourDistance, ...]
    figure_of_merit: float
    between: float
    within: float
    overlap_misfit: float
    kramers_kronig: KramersKronig | None
    storage_modulus: Array
    loss_modulus: Array
    temperature: Array
    sentences: tuple[str, ...]
    verdict: Verdict
    drift: Drift | None = None

    def _shown(self) -> Rows:
        return (
            ("verdict", self.verdict),
            ("figure of merit", self.figure_of_merit),
            ("scatter between isotherms", self.between, "decades"),
            ("within isotherms", self.within, "decades"),
            ("overlap misfit", self.overlap_misfit, "decades"),
            ("sentences", self.sentences),
        )

    @property
    def consistent(self) -> bool:
        """Whether E' and E'' belong to each other; True where that was not tested."""
        return self.kramers_kronig is None or self.kramers_kronig.holds

    def to_dataset(self) -> Dataset:
        """Return the temperatures (K) of the isotherms as a labelled data set, with the verdict as attributes."""
        *holding, causality = self.sentences
        kelvin = np.unique(self.temperature)
        return self._dataset(kelvin, holding, consistent=int(self.consistent), causality=causality)


def check(
    isotherms: tuple[Isotherm, ...],
    shift_factors: ShiftFactors,
    vertical_shift: VerticalShift | None,
    unidentified: tuple[tuple[float, float], ...],
    quality: OverlapQuality,
    master_curve: MasterCurve,
) -> SuperpositionCheck:
    """Check isotherms with their factors, vertical shift and overlap, as `Superposition` has them."""
    temperatures = shift_factors.temperatures
    log10_b = np.zeros(len(temperatures)) if vertical_shift is None else np.asarray(vertical_shift.log10(temperatures))
    neighbours = neighbour_distances(isotherms, log10_b)
    distance = np.array([pair.distance for pair in neighbours])
    error = np.array([pair.standard_error for pair in neighbours])
    explained = np.hypot(REPRODUCIBILITY, LEVEL_95 * error)
    ratio = np.abs(distance) / explained
    figure = figure_of_merit(ratio)
    logs = [LogSweep.of(one, float(by)) for one, by in zip(isotherms, log10_b, strict=True)]
    own = own_shifts(logs, shift_factors.log10_values)
    try:
        causality = kramers_kronig(master_curve)
        causal_sentence = Note(f"kramers-kronig-{'holds' if causality.holds else 'fails'}", causality.sentence)
    except InputError as reason:
        causality = None
        causal_sentence = Note("kramers-kronig-untested", f"E' was not tested against E'': {reason}")
    drifting = drift(neighbours)
    verdict = verdict_of(figure, drifting, unidentified, own) if neighbours else "untested"
    headline, *others = _words(verdict, neighbours, figure, ratio, own, drifting, unidentified, vertical_shift)
    free = isinstance(vertical_shift, VerticalShiftFactors)
    sentences = (
        Note(
            f"superposition-{verdict.replace(' ', '-')}",
            headline,
            remedy=(_FEWER if free else _FREE_OR_FEWER) if verdict == "doubtful" else None,
            values={"figure_of_merit": float(figure), "vertical_shift": vertical_shift is not None},
        ),
        *others,
        *_overlap(figure, quality.joint),
        *on_gaps(temperatures, quality),
        causal_sentence,
    )
    return SuperpositionCheck(
        neighbours,
        figure,
        rms(distance),
        _median(error),
        quality.joint,
        causality,
        *_points(isotherms, log10_b),
        sentences,
        verdict,
        drifting,
    )


def rms(values: Array) -> float:
    """Return the root of the mean square, 0 of nothing."""
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def _median(values: Array) -> float:
    return float(np.median(values)) if values.size else 0.0


def _points(isotherms: tuple[Isotherm, ...], log10_b: Array) -> tuple[Array, Array, Array]:
    """Return E' and E'' of all isotherms without their vertical shift, and the temperature of each."""
    b = 10.0**log10_b
    storage = np.concatenate([one.storage_modulus / by for one, by in zip(isotherms, b, strict=True)])
    loss = np.concatenate([one.loss_modulus / by for one, by in zip(isotherms, b, strict=True)])
    temperature = np.concatenate([np.full(len(one), one.temperature) for one in isotherms])
    return storage, loss, temperature


def figure_of_merit(ratio: Array) -> float:
    """Return the rms of distances over what explains them, or what one of them alone says."""
    return max(rms(ratio), float(np.max(ratio, initial=0.0)) / ONE_PAIR)


def verdict_of(
    figure: float, drifting: Drift | None, unidentified: tuple[tuple[float, float], ...], own: OwnShifts
) -> Verdict:
    """Return the worst verdict of the single checks."""
    if figure > LARGEST_FIGURE:
        return "fails" if figure > ROUGH_FIGURE else "roughly"
    if drifting is not None:
        return "doubtful"
    if unidentified:
        return "not identified"
    return "other factors" if own.wrong else "holds"


def _words(
    verdict: Verdict,
    neighbours: tuple[NeighbourDistance, ...],
    figure: float,
    ratio: Array,
    own: OwnShifts,
    drifting: Drift | None,
    unidentified: tuple[tuple[float, float], ...],
    vertical_shift: VerticalShift | None,
) -> tuple[str, ...]:
    """Return sentences on whether superposition holds, in general and with these shift factors."""
    wrong = (f"The shift factors do not join the isotherms: {own.clause}.",) if own.wrong else ()
    if verdict == "untested":
        sentence = (
            "Superposition was not tested: no two neighbouring isotherms overlap in a plot of tan δ against |E*|."
        )
        return sentence, *wrong
    distance = np.array([pair.distance for pair in neighbours])
    between, noise = rms(distance), _median(np.array([pair.standard_error for pair in neighbours]))
    apart = f"neighbouring isotherms lie {_decades(between)} apart (rms) in tan δ against |E*|"
    merit = f"figure of merit {figure:.2g}, good if ≤ {LARGEST_FIGURE:g}"
    drifts = () if drifting is None else (f"F{_drift(drifting)[1:]}.",)
    if verdict in ("roughly", "fails"):
        worst = [neighbours[place] for place in np.argsort(-ratio)[:_NAMED] if ratio[place] > LARGEST_FIGURE]
        where = ", ".join(_pair(pair.colder, pair.warmer) for pair in worst)
        cure = "" if vertical_shift else "; a free vertical shift may correct this if only the modulus changes"
        how = "does not hold" if verdict == "fails" else "holds only roughly"
        sentence = (
            f"Superposition {how}: {apart} ({merit}, above {ROUGH_FIGURE:g} as failed), whatever the shift factors, "
            f"most of all between {where}{cure}."
        )
        return sentence, *drifts, *wrong
    if drifting is not None:
        return f"Superposition is doubtful: {_drift(drifting)}, although {apart} ({merit}).", *wrong
    beyond = "" if between <= LEVEL_95 * noise else f"; the noise is {noise:.1g} decades, so that some of it is real"
    if verdict == "not identified":
        where = ranges(unidentified)
        sentence = (
            f"Superposition is tested only in part: α is not identified from {where}, where the sweeps join about as "
            f"well over a wide range of shifts; elsewhere {apart} ({merit}{beyond})."
        )
        return sentence, *wrong
    if own.wrong:
        apart = f"{apart}, whatever the shift factors"
        return (f"Superposition holds, but not with these shift factors: {own.clause}; {apart} ({merit}{beyond}).",)
    return (f"Superposition holds: {apart} ({merit}{beyond}).",)


def _pair(colder: float, warmer: float) -> str:
    return f"{shown_celsius(colder, 'z.0f')} and {shown_celsius(warmer, 'z.0f')} °C"


def _drift(found: Drift) -> str:
    colder, warmer = (shown_celsius(end, "z.0f") for end in (found.colder, found.warmer))
    return (
        f"from {colder} to {warmer} °C isotherms move steadily to one side in tan δ against |E*|, by "
        f"{with_error(abs(found.distance), found.standard_error)} decades over {found.neighbours} neighbours"
    )


def _overlap(figure: float, misfit: float) -> tuple[str, ...]:
    if figure <= LARGEST_FIGURE:
        return ()
    sentence = (
        f"The shifted isotherms miss each other by {_decades(misfit)} (joint rms) where they overlap: the master curve "
        "is a compromise."
    )
    return (sentence,)


def _decades(value: float) -> str:
    factor = 10.0**value
    return f"{value:.2g} decades ({f'{100.0 * (factor - 1.0):.2g} %' if factor < 2.0 else f'a factor of {factor:.2g}'})"
