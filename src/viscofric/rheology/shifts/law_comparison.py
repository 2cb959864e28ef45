"""Comparison of shift laws for measured factors: all fits, the chosen law, and the certainty of the choice."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.shifts import law_fitting
from viscofric.rheology.shifts.law_fitting import LARGEST_DEGREE, TITLES, FactorTable
from viscofric.rheology.shifts.laws import WLF, InversePolynomial, ParametricLaw
from viscofric.showing import Plotted, Rows
from viscofric.units import shown_celsius

#: A kind of law: of shift factors, or of shear stress.
Law = TypeVar("Law")
#: A law within this of the lowest AIC has substantial support; among such laws, that of fewest constants is chosen …
SUPPORTED = 2.0
#: … and from this on, considerably less (K. P. Burnham, D. R. Anderson, Model Selection and Multimodel Inference,
#: 2nd ed. 2002, p. 70): laws that are nearer cannot be excluded.
EXCLUDED = 4.0
#: A polynomial has no physical basis and does not extrapolate.  It is chosen only where the laws of physics differ from
#: the factors by more than this, a quarter of α; real factors known to 0.005 decades follow no law to the last digit.
#: Laws that differ by less are equal.
LARGEST_SCATTER = 0.1  # decades
#: Laws are compared to this distance on either side of the factors.
BEYOND = 10.0  # K
#: AICs closer than this are equal.
ROUNDING = 1e-3
#: Probability of a note on factors off their course by chance, and the degrees of freedom that this needs.
BY_CHANCE, FEWEST_FREE = 0.01, 2
#: Distances of the poles of courses below the lowest temperature, K.  The one that fits best is chosen, and not counted
#: among the constants: the note comes a little late.
_BELOW = np.geomspace(10.0, 160.0, 17)
#: Laws that are compared, those of physics with the fewest constants first.
_COMPARED = ("arrhenius", "wlf", "wlf+arrhenius", "polynomial")


@dataclass(frozen=True)
class LawRow(Generic[Law]):
    """One law in a comparison."""

    kind: str  # as `ShiftFactors.law` or `ShearStress.law` takes it
    title: str  # as it is called in a sentence
    law: Law | None  # as fitted; None where it was refused
    constants: int  # number of constants
    # χ² by the measured covariance alone, of `freedom` expected; NaN where the law was refused.
    chi2: float = float("nan")
    # Number of differences of neighbouring factors, or of values of stress, less `constants`; 0 where the law passes
    # through all of them.
    freedom: int = 0
    # Independent scatter about the law, beyond the measured uncertainties, that makes the misfit plausible; decades.
    scatter: float = 0.0
    # Information criterion, −2 ln L + 2k with k constants, a glass transition counting for three; infinite where the
    # law was refused.
    aic: float = float("inf")
    # Akaike weight among the laws of physics, e^(−AIC/2) of a sum of one; zero for a polynomial that is not chosen.
    weight: float = 0.0
    refusal: str = ""  # why the law was refused; empty where it was fitted
    same_as: str = ""  # kind of the law that is the same curve in other constants; empty for most
    # Scatter of the levels of shear stress of the temperatures about the law, beyond the stated one; decades.
    level: float = 0.0

    @property
    def exact(self) -> bool:
        """Whether the law has as many constants as there are differences of factors, so that nothing tests it."""
        return self.law is not None and self.freedom == 0


@dataclass(frozen=True)
class LawComparison(Plotted, Generic[Law]):
    """Laws fitted to one table of shift factors or of shear stress, the best supported one, and why.

    Parameters
    ----------
    rows : tuple of LawRow
        Every law, the lowest AIC first, refused ones last.
    chosen : LawRow
        The row of `best`: of the laws of physics whose AIC is within 2 of their lowest, the one with the fewest
        constants; a polynomial only where that one misses the factors by more than 0.1 decades.
    notes : tuple of Note
        Why, and how sure the choice is, one sentence each.

    Notes
    -----
    The likelihood is Gaussian, with the full covariance of the factors.  As their errors are known, Akaike's
    criterion needs no correction for few temperatures.  On top comes an independent misfit of unknown size, over
    which the likelihood is averaged (`law_fitting.criterion`).

    References
    ----------
    H. Akaike, IEEE Trans. Autom. Control 19 (1974) 716, doi:10.1109/TAC.1974.1100705; K. P. Burnham, D. R. Anderson,
    Model Selection and Multimodel Inference, 2nd ed., Springer 2002.
    """

    rows: tuple[LawRow[Law], ...]
    chosen: LawRow[Law]
    notes: tuple[Note, ...]

    def _shown(self) -> Rows:
        return (
            ("chosen", str(self.chosen.law or self.chosen.title)),
            ("weight", self.chosen.weight, "%"),
            ("compared", ", ".join(one.title for one in self.rows)),
            ("notes", self.notes),
        )

    @property
    def best(self) -> Law:
        """The law that the table supports best, fitted."""
        assert self.chosen.law is not None
        return self.chosen.law

    @property
    def explanation(self) -> str:
        """The notes as one text."""
        return " ".join(self.notes)

    def to_dataset(self) -> Dataset:
        """Return the laws that could be fitted as a labelled data set.

        ``law``, ``constants``, ``information_criterion``, ``akaike_weight`` and ``law_scatter`` along ``fitted_law``.
        Attributes: ``chosen`` and ``explanation``; ``refused``, the other laws, each with the reason, as JSON.
        """
        fitted = [row for row in self.rows if row.law is not None]
        lowest = min(row.aic for row in fitted)
        weight = "Akaike weight among the laws of physics; zero for a polynomial that is not chosen"
        scatter = "scatter of log10 of the values about the law beyond their uncertainties"
        refused = {row.title: row.refusal for row in self.rows if row.law is None}
        return dataset(
            "fitted_law",
            {
                "law": ([row.title for row in fitted], "1", "law"),
                "constants": ([str(row.law) for row in fitted], "1", "constants of the law"),
                "information_criterion": (
                    [row.aic - lowest for row in fitted],
                    "1",
                    "Akaike information criterion above the lowest",
                ),
                "akaike_weight": ([row.weight for row in fitted], "1", weight),
                "law_scatter": ([row.scatter for row in fitted], "1", scatter),
            },
            attributes={
                "chosen": self.chosen.title,
                "explanation": self.explanation,
                "refused": json.dumps(refused, ensure_ascii=False),
            },
        )


def compare_laws(table: FactorTable) -> LawComparison[ParametricLaw]:
    """Fit every law to a table and choose; see `LawComparison`."""
    rows = [_row(kind, table) for kind in _COMPARED]
    fitted = [row for row in rows if row.law is not None]
    if not fitted:
        raise InputError(f"no shift law describes these factors: {rows[0].refusal}", code="no-law")
    kind = chosen_row(fitted).kind
    physical = [row for row in fitted if row.kind != "polynomial" or row.kind == kind]
    rows = weighted(rows, physical)
    by_kind = {row.kind: row for row in rows}
    every = sorted([*rows, _vft(by_kind["wlf"])], key=lambda row: row.aic)
    return LawComparison(tuple(every), by_kind[kind], tuple(_notes(by_kind[kind], rows, table)))


def course_notes(temperatures: Array, values: Array, covariance: Array) -> tuple[Note, ...]:
    """Return a note if one of n factors lies off the course of the others, or if all scatter about any course."""
    # Courses are polynomials in 1/(T − T₀), with the T₀ of several that suits best: those in 1/T alone do not follow
    # WLF near its pole. One temperature is off if the others without it scatter by so much less that chance explains it
    # in one table of a hundred (Student's t). At an end it may be a change of law.
    from scipy.special import gammaincc, stdtr

    degrees = [
        degree
        for degree in range(2, max(LARGEST_DEGREE, len(values) // 3) + 1)
        if len(values) - 2 - degree >= FEWEST_FREE
    ]

    def chance_of(degree: int, chi2: float) -> float:
        return float(gammaincc(0.5 * (len(values) - 1 - degree), 0.5 * chi2))

    factors = temperatures, values, covariance
    # One that suits is enough, and is most often found at once.
    if any(chance_of(degree, _course(*factors, degree, 0.0)[0]) >= BY_CHANCE for degree in degrees) or not degrees:
        return ()
    found, courses = [], []
    for degree in degrees:
        freedom = len(values) - 2 - degree
        tried = [(pole, *_course(*factors, degree, pole)) for pole in (0.0, *(temperatures.min() - _BELOW))]
        pole, whole, scatter, _ = min(tried, key=lambda one: one[1])
        courses.append((chance_of(degree, whole), -scatter))
        for place in range(1, len(values) - 1):
            others = np.arange(len(values)) != place
            kept = temperatures[others], values[others], covariance[np.ix_(others, others)]
            rest, _, course = _course(*kept, degree, pole)
            better = np.sqrt(max(whole - rest, 0.0) / max(1.0, rest / freedom))
            found.append((float(stdtr(freedom, -better)), place, course))
    likely, scatter = max(courses)
    if likely >= BY_CHANCE:
        return ()
    chance, place, course = min(found, key=lambda one: one[0])
    kelvin = float(temperatures[place])
    slope = float(np.diff(course(kelvin + np.array([-0.5, 0.5])))[0])
    if 2.0 * len(found) * chance < BY_CHANCE:
        away = float(values[place] - course(np.array([kelvin]))[0])
        text = (
            f"log10 α at {shown_celsius(kelvin)} °C lies {abs(away):.2g} decades off the course of the others, as if "
            f"its temperature were {abs(away / slope):.2g} K {'lower' if away * slope < 0.0 else 'higher'}: errors and "
            "bands do not include that; check this temperature, or leave it out."
        )
        return (Note("temperature-off", text, values={"temperature": kelvin, "decades": away, "kelvin": away / slope}),)
    decades, kelvin = abs(scatter), abs(scatter / slope)
    text = (
        f"log10 α scatters by {decades:.2g} decades about any smooth course, more than its errors explain, as errors "
        f"of {kelvin:.2g} K in the temperatures or an abrupt change of law would make it: errors and bands do not "
        "include that."
    )
    return (Note("factors-scatter", text, values={"decades": decades, "kelvin": kelvin}),)


def _course(
    temperatures: Array, values: Array, covariance: Array, degree: int, pole: float
) -> tuple[float, float, Callable[[Array], Array]]:
    """Return χ² and scatter of values about a polynomial in 1/(T − pole), and the polynomial."""
    middle = float(temperatures.mean())
    table = FactorTable.of(temperatures, values, covariance, middle)
    whiten = table.whitening(law_fitting.SMALLEST_MISFIT**2)

    def powers(kelvin: Array) -> Array:
        place = (kelvin - middle) / (kelvin - pole)  # linear in the inverse
        return np.stack([place**power for power in range(1, degree + 1)], axis=-1)

    found = law_fitting.linear(whiten(powers(temperatures)), whiten(values))
    rest = values - powers(temperatures) @ found.parameters
    # Values that are hardly known show hardly anything of the level, and of the scatter of the others.
    square = np.median((rest - np.median(rest)) ** 2) + law_fitting.SMALLEST_MISFIT**2
    known = 1.0 / (np.diag(covariance) + square)
    level = float(np.average(rest, weights=known))
    freedom = len(values) - 1 - degree
    scatter = math.sqrt(np.average((rest - level) ** 2, weights=known) * len(values) / freedom)
    return found.chi2, scatter, lambda kelvin: np.asarray(level + powers(kelvin) @ found.parameters)


def weighted(rows: Iterable[LawRow[Law]], compared: Iterable[LawRow[Law]]) -> list[LawRow[Law]]:
    """Return rows with Akaike's weights among those compared."""
    kinds = {row.kind: row.aic for row in compared}
    likelihood = {kind: float(np.exp(0.5 * (min(kinds.values()) - aic))) for kind, aic in kinds.items()}
    total = sum(likelihood.values())
    return [replace(row, weight=likelihood[row.kind] / total) if row.kind in likelihood else row for row in rows]


def polynomial(table: FactorTable) -> InversePolynomial:
    """Fit polynomials of degree 2 to 4 and return the one of the lowest AIC; degree 1 is the Arrhenius law."""
    row = _polynomial_row(table)
    if not isinstance(row.law, InversePolynomial):
        raise InputError(row.refusal, code="no-law")
    return row.law


def _row(kind: str, table: FactorTable, degree: int | None = None) -> LawRow[ParametricLaw]:
    if kind == "polynomial" and degree is None:
        return _polynomial_row(table)
    try:
        law, chi2, scatter, *_ = law_fitting.fitted(kind, table, degree)
    except InputError as error:
        return LawRow(kind, TITLES[kind], None, 0, refusal=str(error))
    size = len(law.parameters)
    title = f"polynomial of degree {degree}" if degree else law.title
    aic = law_fitting.criterion(law, table)
    return LawRow(kind, title, law, size, chi2, len(table) - size, scatter, aic)


def _polynomial_row(table: FactorTable) -> LawRow[ParametricLaw]:
    degrees = [_row("polynomial", table, degree) for degree in range(2, LARGEST_DEGREE + 1)]
    return min(degrees, key=lambda row: row.aic)


def _vft(wlf: LawRow[ParametricLaw]) -> LawRow[ParametricLaw]:
    """Return the row of the VFT law, which is the same curve as the WLF law and no separate candidate."""
    refused: LawRow[ParametricLaw] = LawRow(
        "vft", TITLES["vft"], None, wlf.constants, refusal=wlf.refusal, same_as="wlf"
    )
    if not isinstance(wlf.law, WLF):
        return refused
    try:
        return replace(wlf, kind="vft", title=TITLES["vft"], law=wlf.law.to_vft(), same_as="wlf")
    except InputError as error:
        return replace(refused, refusal=str(error))


def chosen_row(fitted: list[LawRow[Law]]) -> LawRow[Law]:
    """Choose the law of physics with the fewest constants that is supported, or a polynomial where all fail."""
    laws = [row for row in fitted if row.kind != "polynomial"]
    lowest = min((row.aic for row in laws), default=float("inf"))
    supported = [row for row in laws if row.aic <= lowest + SUPPORTED]
    chosen = min(supported, key=lambda row: row.constants, default=fitted[0])
    empirical = next((row for row in fitted if row.kind == "polynomial"), chosen)
    if chosen.scatter > LARGEST_SCATTER and empirical.aic < lowest - EXCLUDED:
        return empirical
    return chosen


def _notes(chosen: LawRow[ParametricLaw], rows: list[LawRow[ParametricLaw]], table: FactorTable) -> Iterator[Note]:
    """Yield the reason for the chosen law, the certainty of the choice, and the remaining misfit, in sentences."""
    fitted = [row for row in rows if row.law is not None]
    others = sorted((row for row in fitted if row is not chosen), key=lambda row: row.aic)
    reasons = [_no_reason(row, chosen) for row in others if row.aic < chosen.aic - ROUNDING]
    others = [row for row in others if row.kind != "polynomial"]
    if reasons:
        first = f"{chosen.title} is taken: {', and '.join(reasons)}."
    elif not others:
        first = f"{chosen.title} is the only law of physics that can be fitted to these shift factors."
    else:
        gap = others[0].aic - chosen.aic
        first = f"{chosen.title} describes these shift factors best: its AIC is lower by {gap:.2g} than that of "
        first += f"{others[0].title}, the next."
    yield Note("law-chosen", first[0].upper() + first[1:])
    if chosen.exact:
        text = f"It has as many constants as there are steps between the {len(table) + 1} temperatures, so that it "
        text += "passes through all factors and nothing tests it"
        usual = "; its errors hold WLF laws usual for rubbers" if chosen.kind == "arrhenius" else ""
        yield Note("law-exact", f"{text}{usual}.")
    if chosen.law is not None and chosen.kind != "polynomial":
        yield from law_fitting.undetermined(chosen.law, chosen.law.parameters, chosen.law.covariance)
    for row in others:
        if chosen.kind != "polynomial" and row.aic <= chosen.aic + EXCLUDED:
            yield _rivalry(chosen, row, table)
    stated = float(np.sqrt(np.median(table.variance)))
    if stated <= 2.0 * law_fitting.SMALLEST_ERROR:
        text = f"The factors have no standard errors; laws are taken to hold to about {law_fitting.USUAL_MISFIT:g} "
        yield Note("factors-without-errors", text + "decades.")
    elif chosen.scatter > stated:
        text = f"The factors scatter about it by {chosen.scatter:.2g} decades, more than the uncertainty of about "
        text += f"{stated:.2g} from one temperature to the next explains; the standard errors of the factors add up "
        yield Note("law-scatter", text + "from the reference.")
    if any(row.kind == "wlf" for row in fitted):
        yield Note(
            "vft-is-wlf", "VFT is the same curve as WLF with other constants; it is not counted as a separate law."
        )


def _rivalry(chosen: LawRow[ParametricLaw], rival: LawRow[ParametricLaw], table: FactorTable) -> Note:
    """Return a sentence on the difference of a law that cannot be excluded from the chosen one."""
    low, high = float(table.temperatures[0]), float(table.temperatures[-1])
    laws = [row.law.unbounded() for row in (chosen, rival) if row.law is not None]
    coldest = max(low - BEYOND, min(low, max(law.extrapolation_limits[0] for law in laws) + 1.0))
    kelvin = np.stack([np.linspace(low, high, 81), np.linspace(coldest, high + BEYOND, 81)])
    apart = np.abs(laws[0].log10(kelvin) - laws[1].log10(kelvin))
    inside = float(apart[0].max())
    far = f"{inside:.2g} decades between the temperatures and {float(apart.max()):.2g} up to {BEYOND:g} K beyond them"
    weights = f"Akaike weights {chosen.weight:.2f} and {rival.weight:.2f}"
    if float(apart.max()) <= LARGEST_SCATTER:
        return Note("laws-alike", f"{rival.title} cannot be excluded ({weights}) and differs by at most {far}.")
    return Note(
        "laws-undecided",
        f"The factors cannot decide between {chosen.title} and {rival.title} ({weights}), which differ by up to {far}; "
        "more temperatures, or a wider range of them, would.",
    )


def _no_reason(row: LawRow[Law], chosen: LawRow[Law]) -> str:
    """Return the reason for not choosing a law with a lower AIC, in a sentence."""
    gap = f"{chosen.aic - row.aic:.2g}"
    if row.kind == "polynomial":
        return f"a {row.title} has an AIC lower by {gap}, but describes without explaining"
    return f"{row.title} has an AIC lower by {gap}, which does not pay for more constants"
