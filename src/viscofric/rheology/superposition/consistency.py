"""Whether time–temperature superposition holds: comparison of neighbouring isotherms, and of E' with E''."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Isotherm, MasterCurve
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.notes import Note, Remedy
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.superposition.joined_isotherms import ranges
from viscofric.rheology.superposition.kramers_kronig import KramersKronig, kramers_kronig
from viscofric.rheology.superposition.overlap import LogSweep, OverlapQuality, OwnShifts, own_shifts
from viscofric.rheology.superposition.van_gurp_palmen import Drift, NeighbourDistance, drift, neighbour_distances
from viscofric.showing import Plotted, Rows, Shown
from viscofric.units import shown_celsius

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

    def _dataset(self, temperatures: Array, sentences: Sequence[str], **more: Any) -> Dataset:
        return dataset(
            "isotherm",
            {"temperature": (temperatures, "K", "temperature")},
            attributes={
                "verdict": self.verdict,
                "holds": int(self.holds),
                "roughly": int(self.roughly),
                "figure_of_merit": self.figure_of_merit,
                "sentences": json.dumps(list(sentences), ensure_ascii=False),
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
    figure = max(_rms(ratio), float(np.max(ratio, initial=0.0)) / ONE_PAIR)
    logs = [LogSweep.of(one, float(by)) for one, by in zip(isotherms, log10_b, strict=True)]
    own = own_shifts(logs, shift_factors.log10_values)
    try:
        causality = kramers_kronig(master_curve)
        causal_sentence = causality.sentence
    except InputError as reason:
        causality, causal_sentence = None, f"E' was not tested against E'': {reason}"
    drifting = drift(neighbours)
    verdict = _verdict(neighbours, figure, drifting, unidentified, own)
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
        *_gaps(isotherms, quality),
        causal_sentence,
    )
    return SuperpositionCheck(
        neighbours,
        figure,
        _rms(distance),
        _median(error),
        quality.joint,
        causality,
        *_points(isotherms, log10_b),
        sentences,
        verdict,
        drifting,
    )


def _rms(values: Array) -> float:
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


def _verdict(
    neighbours: tuple[NeighbourDistance, ...],
    figure: float,
    drifting: Drift | None,
    unidentified: tuple[tuple[float, float], ...],
    own: OwnShifts,
) -> Verdict:
    """Return the worst verdict of the single checks."""
    if not neighbours:
        return "untested"
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
    between, noise = _rms(distance), _median(np.array([pair.standard_error for pair in neighbours]))
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
        f"{_decades(abs(found.distance))} ± {found.standard_error:.1g} over {found.neighbours} neighbours"
    )


def _overlap(figure: float, misfit: float) -> tuple[str, ...]:
    if figure <= LARGEST_FIGURE:
        return ()
    sentence = (
        f"The shifted isotherms miss each other by {_decades(misfit)} (joint rms) where they overlap: the master curve "
        "is a compromise."
    )
    return (sentence,)


def _gaps(isotherms: tuple[Isotherm, ...], quality: OverlapQuality) -> tuple[str, ...]:
    """Return a note that isotherms without overlap are not tested."""
    if not quality.gaps:
        return ()
    at = [isotherms[place : place + 2] for place in quality.gaps[:_NAMED]]
    where = ", ".join(_pair(one.temperature, other.temperature) for one, other in at)
    more = " and others" if quality.without_overlap > _NAMED else ""
    sentence = (
        f"{quality.without_overlap} of {quality.neighbours} pairs of neighbours do not overlap once shifted (between "
        f"{where}{more}): there no overlap tests the shift factors."
    )
    return (sentence,)


def _decades(value: float) -> str:
    factor = 10.0**value
    return f"{value:.2g} decades ({f'{100.0 * (factor - 1.0):.2g} %' if factor < 2.0 else f'a factor of {factor:.2g}'})"
