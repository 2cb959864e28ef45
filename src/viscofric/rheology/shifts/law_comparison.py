"""Which shift law measured factors support: all of them fitted, and chosen by an information criterion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.shifts import law_fitting
from viscofric.rheology.shifts.law_families import LARGEST_DEGREE, TITLES
from viscofric.rheology.shifts.laws import WLF, InversePolynomial

if TYPE_CHECKING:
    from viscofric.rheology.shifts.law_fitting import FactorTable
    from viscofric.rheology.shifts.laws import ParametricLaw

#: A law within this of the lowest AICc is still supported (K. P. Burnham, D. R. Anderson, Model Selection and
#: Multimodel Inference, 2nd ed. 2002, p. 70: from 4 on "considerably less").  Among such, fewer constants win.
SUPPORTED = 4.0
#: A polynomial explains nothing and says nothing beyond its data.  It is chosen only where the laws of physics miss
#: the factors by more than this, a quarter of α; real factors known to 0.005 decades follow none to the last digit.
LARGEST_SCATTER = 0.1  # decades
#: Laws that are compared, those of physics with the fewest constants first.
_COMPARED = ("arrhenius", "wlf", "wlf+arrhenius", "polynomial")


@dataclass(frozen=True)
class LawRow:
    """One law in a comparison.

    Parameters
    ----------
    kind : str
        As `ShiftFactors.law` takes it.
    title : str
        As it is called in a sentence.
    law : ParametricLaw or None
        As fitted; None where it was refused.
    constants : int
        Number of constants; the excess scatter comes on top.
    chi2 : float
        χ² by the measured covariance alone, of `freedom` expected; NaN where the law was refused.
    freedom : int
        Number of differences of neighbouring factors less `constants`.
    scatter : float
        Independent scatter about the law, beyond the measured uncertainties, of greatest likelihood; decades.
    aicc : float
        Information criterion, −2 ln L + 2k + 2k(k + 1)/(N − k − 1), with k = constants + 1 for the scatter; infinite
        where the law was refused.
    refusal : str
        Why the law was refused; empty where it was fitted.
    same_as : str
        Kind of the law that is the same curve in other constants; empty for most.
    """

    kind: str
    title: str
    law: ParametricLaw | None
    constants: int
    chi2: float = float("nan")
    freedom: int = 0
    scatter: float = 0.0
    aicc: float = float("inf")
    refusal: str = ""
    same_as: str = ""


@dataclass(frozen=True)
class LawComparison:
    """Shift laws fitted to one table, the best supported one, and why.

    Parameters
    ----------
    rows : tuple of LawRow
        Every law, the lowest AICc first, refused ones last.
    chosen : LawRow
        The row of `best`: of the laws of physics whose AICc is within 4 of their lowest, the one with the fewest
        constants, but none that needs scatter beyond the stated errors where another of them needs none; a polynomial
        only where that one misses the factors by more than 0.1 decades.
    explanation : str
        One to three plain sentences.

    Notes
    -----
    N. Sugiura, Commun. Stat. Theory Methods 7 (1978) 13; C. M. Hurvich, C.-L. Tsai, Biometrika 76 (1989) 297.
    The likelihood is Gaussian, with the full covariance of the factors and, on top, independent scatter of one
    size in each, which is one more constant of every law.
    """

    rows: tuple[LawRow, ...]
    chosen: LawRow
    explanation: str

    @property
    def best(self) -> ParametricLaw:
        """The law that the table supports best, fitted."""
        assert self.chosen.law is not None
        return self.chosen.law


def compare_laws(table: FactorTable) -> LawComparison:
    """Fit every law to a table and choose; see `LawComparison`."""
    rows = {kind: _row(kind, table) for kind in _COMPARED}
    fitted = [row for row in rows.values() if row.law is not None]
    if not fitted:
        raise InputError(f"no shift law describes these factors: {rows['arrhenius'].refusal}")
    chosen = _chosen(fitted, _stated(table))
    every = sorted([*rows.values(), _vft(rows["wlf"])], key=lambda row: row.aicc)
    return LawComparison(tuple(every), chosen, _explanation(chosen, fitted, rows["wlf"], table))


def polynomial(table: FactorTable) -> InversePolynomial:
    """Fit polynomials of degree 2 to 4 and return the one of the lowest AICc; degree 1 is the Arrhenius law.

    Raises
    ------
    InputError
        If none of them falls with temperature throughout, or the temperatures are too few.
    """
    row = _polynomial_row(table)
    if not isinstance(row.law, InversePolynomial):
        raise InputError(row.refusal)
    return row.law


def _row(kind: str, table: FactorTable, degree: int | None = None) -> LawRow:
    if kind == "polynomial" and degree is None:
        return _polynomial_row(table)
    try:
        law = law_fitting.fit(kind, table, degree)
    except InputError as error:
        return LawRow(kind, TITLES[kind], None, 0, refusal=str(error))
    size = len(law.parameters)
    found = law_fitting.likelihood(law, table)
    title = f"polynomial of degree {degree}" if degree else law.title
    freedom = len(table) - size
    aicc = _aicc(found.deviance, size + 1, len(table))
    if not np.isfinite(aicc):
        few = f"{len(table) + 1} temperatures are too few to compare the {title} law; give {size + 4} or more."
        return LawRow(kind, title, None, size, refusal=few)
    return LawRow(kind, title, law, size, law_fitting.chi_squared(law, table), freedom, found.scatter, aicc)


def _polynomial_row(table: FactorTable) -> LawRow:
    degrees = [_row("polynomial", table, degree) for degree in range(2, LARGEST_DEGREE + 1)]
    return min(degrees, key=lambda row: row.aicc)


def _aicc(deviance: float, constants: int, count: int) -> float:
    left = count - constants - 1
    if left <= 0:
        return float("inf")
    return deviance + 2.0 * constants + 2.0 * constants * (constants + 1) / left


def _vft(wlf: LawRow) -> LawRow:
    """Return the row of the VFT law, which is the WLF curve and no candidate of its own."""
    if not isinstance(wlf.law, WLF):
        return LawRow("vft", TITLES["vft"], None, wlf.constants, refusal=wlf.refusal, same_as="wlf")
    try:
        law = wlf.law.to_vft()
    except InputError as error:
        return LawRow("vft", TITLES["vft"], None, wlf.constants, refusal=str(error), same_as="wlf")
    return LawRow("vft", law.title, law, wlf.constants, wlf.chi2, wlf.freedom, wlf.scatter, wlf.aicc, same_as="wlf")


def _stated(table: FactorTable) -> float:
    """Return the usual standard error of the factors, decades."""
    return float(np.sqrt(np.median(table.variance)))


def _chosen(fitted: list[LawRow], stated: float) -> LawRow:
    """Choose the law of physics with the fewest constants that is supported, or a polynomial where all fail."""
    laws = [row for row in fitted if row.kind != "polynomial"]
    lowest = min((row.aicc for row in laws), default=float("inf"))
    supported = [row for row in laws if row.aicc <= lowest + SUPPORTED]
    # With few temperatures AICc pays more for one constant less than for errors that are met.
    supported = [row for row in supported if row.scatter <= stated] or supported
    chosen = min(supported, key=lambda row: row.constants, default=fitted[0])
    empirical = next((row for row in fitted if row.kind == "polynomial"), chosen)
    if chosen.scatter > LARGEST_SCATTER and empirical.aicc < lowest - SUPPORTED:
        return empirical
    return chosen


def _explanation(chosen: LawRow, fitted: list[LawRow], wlf: LawRow, table: FactorTable) -> str:
    others = sorted((row for row in fitted if row is not chosen), key=lambda row: row.aicc)
    if not others:
        first = f"{chosen.title} is the only law that can be fitted to these shift factors."
    elif chosen.aicc <= others[0].aicc:
        gap = others[0].aicc - chosen.aicc
        first = f"{chosen.title} describes these shift factors best: its AICc is lower by {gap:.2g} than that of "
        first += f"{others[0].title}, the next."
    else:
        reasons = [_no_reason(row, chosen) for row in others if row.aicc < chosen.aicc]
        first = f"{chosen.title} is taken: {', and '.join(reasons)}."
    sentences = [first[0].upper() + first[1:]]
    if wlf.law is not None:
        sentences.append("VFT is the same curve as WLF in other constants, and no candidate of its own.")
    stated = _stated(table)
    if chosen.scatter > stated:
        sentences.append(
            f"The factors scatter about it by {chosen.scatter:.2g} decades, more than their uncertainties of about "
            f"{stated:.2g} explain."
        )
    return " ".join(sentences)


def _no_reason(row: LawRow, chosen: LawRow) -> str:
    """Say why a law with a lower AICc was not taken."""
    gap = f"{chosen.aicc - row.aicc:.2g}"
    if row.kind == "polynomial":
        return f"the AICc of a {row.title} is lower by {gap}, but describes without explaining"
    return f"the AICc of {row.title} is lower by {gap}, which does not pay for more constants"
