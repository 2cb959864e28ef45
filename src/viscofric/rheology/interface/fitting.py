"""Fit of laws of shear stress to measured values, and their comparison, by the fit of shift laws (`law_fitting`)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import InputError, check_choice
from viscofric.notes import Note, note_of
from viscofric.rheology.interface.law import (
    ConstantShearStress,
    EyringShearStress,
    GaussianShearStress,
    InterfaceLaw,
    PowerShearStress,
)
from viscofric.rheology.shifts.law_comparison import EXCLUDED, LawComparison, LawRow, chosen_row, weighted
from viscofric.rheology.shifts.law_fitting import (
    SMALLEST_ERROR,
    Solution,
    Table,
    Whitening,
    criterion_of,
    least_squares,
    linear,
    plausible,
    solved,
    undetermined,
)
from viscofric.rheology.shifts.laws import Arrhenius
from viscofric.rheology.shifts.parametric_law import student_factor
from viscofric.rheology.shifts.shift_law import ShiftLaw

#: Kinds of law as `ShearStress.law` takes them, those of fewest constants first.
KINDS = {law.kind: law for law in (ConstantShearStress, PowerShearStress, EyringShearStress, GaussianShearStress)}
#: Starting values: activation energies, J/mol, and decades of a law's speed about those measured.
_ENERGIES = np.geomspace(5e3, 5e5, 25)
_SPEEDS = np.arange(-8.0, 3.5, 0.5)
#: Above that of any activated process of a polymer, even near its glass transition, J/mol.
_LARGEST_ENERGY = 2e6
#: A maximum farther from the measured speeds is none, decades.
_FARTHEST = 15.0
#: How far beyond the measured speeds laws that cannot be told apart are compared, decades.
_BEYOND = 1.0
_ALIKE = 0.05  # decades
#: Errors of the levels of temperatures that are sought, decades, and the rise of ln L from which on there is one: of
#: twenty tests without any, one has it.
_LEVELS = (1e-3, 1.0)
_SEEN = 1.35
#: Levels are sought to this part of them, by laws made linear about the constants found, so many times at most.
_ALIKE_LEVELS = 0.1
_ROUNDS = 5
#: Most fits with stresses near zero about those of the fit before, and the relative change of these that is none.
_SETTLING, _SETTLED = 50, 1e-3


StressRow: TypeAlias = LawRow[InterfaceLaw]


@dataclass(frozen=True, eq=False)
class StressTable(Table):
    """Shear stress (values are its log10) over slip speed and temperature."""

    speed: Array  # (n,), log10 of m/s
    kelvin: Array  # (n,)
    pressures: tuple[float, float] | None = None  # lowest and highest mean pressure of the contacts, Pa
    level: float = 0.0  # error that all values of a temperature share, beyond the covariance, decades
    # returns the table with stresses near zero made linear about others (n,); None where all are clear of zero
    about: Callable[[Array], StressTable] | None = None

    @classmethod
    def of(cls, speed: Array, kelvin: Array, values: Array, covariance: Array, log_volume: float = 0.0) -> StressTable:
        """Prepare values (n,) with their covariance (n, n)."""
        variance, axes = np.linalg.eigh(covariance)
        return cls(values, axes.T, np.maximum(variance, 0.0) + SMALLEST_ERROR**2, log_volume, speed, kelvin)

    @cached_property
    def together(self) -> Array:
        """What an error of each of k temperatures gives to the combinations, (n, k)."""
        return np.asarray(self.turn @ (self.kelvin[:, None] == np.unique(self.kelvin)))

    def levelled(self, level: float) -> StressTable:
        """Return the table with a further error (decades) that all values of a temperature share."""
        other = replace(self, level=level)
        other.__dict__["together"] = self.together  # of the same values
        return other

    def whitening(self, added: float) -> Whitening:
        """Include the levels of temperatures: an addition of as many dimensions as there are temperatures."""
        own = super().whitening(added)
        if self.level == 0.0:
            return own
        axes, sizes, _ = np.linalg.svd(own.of_turned(self.level * self.together), full_matrices=False)
        return replace(own, axes=axes, sizes=sizes)


class _Family:
    """A law to be fitted to a table: with a given shift, or with the activation energy of its own if `energy`."""

    surcharge = 0
    positive = True

    def __init__(self, kind: str, table: StressTable, shift: ShiftLaw | None, reference: float, energy: bool) -> None:
        self.kind, self.kelvin, self.shift, self.reference = kind, table.kelvin, shift, reference
        self.pressures = table.pressures
        self.x = table.speed + (0.0 if shift is None else np.asarray(shift.log10(table.kelvin)))
        # ∂log10 α/∂Ea; constant stress does not depend on it
        own = energy and kind != "constant"
        self.y = Arrhenius(1.0, reference).gradient(table.kelvin)[:, 0] if own else None
        self.size = len(KINDS[kind]._adjusted) + own

    def law(self, parameters: Array, covariance: Array | None = None) -> InterfaceLaw:
        """Return the law; with a covariance, as one fitted to the table."""
        shift = self.shift
        fitted = None if covariance is None else (float(self.kelvin.min()), float(self.kelvin.max()))
        if self.y is not None:
            if not parameters[-1] < _LARGEST_ENERGY:
                raise _not_described(self.kind)
            spread = None if covariance is None else covariance[-1:, -1:]
            shift = Arrhenius(float(parameters[-1]), self.reference, spread, fitted)
        x = self._reduced(parameters)
        return self._made(
            parameters,
            shift=shift,
            covariance=covariance,
            fitted_temperatures=fitted,
            fitted_pressures=None if covariance is None else self.pressures,
            fitted_speeds=None if covariance is None else (float(10.0 ** x.min()), float(10.0 ** x.max())),
        )

    def _made(self, parameters: Array, **rest: object) -> InterfaceLaw:
        law = KINDS[self.kind]
        return law(**dict(zip(law._adjusted, parameters.tolist(), strict=False)), **rest)  # type: ignore[arg-type]

    def _reduced(self, parameters: Array) -> Array:
        return self.x if self.y is None else self.x + parameters[-1] * self.y

    def values(self, parameters: Array) -> Array:
        """Return log10 τ_s, (n,)."""
        return self._made(parameters)._log10(self._reduced(parameters), self.kelvin)

    def gradient(self, parameters: Array) -> Array:
        """Return the derivatives of log10 τ_s by the constants, (n, size)."""
        law, x = self._made(parameters), self._reduced(parameters)
        own = law._gradient(x)
        return own if self.y is None else np.column_stack([own, law._slope(x) * self.y])

    def start(self, values: Array) -> Array:
        """Scan activation energies and, for Eyring's law, speeds; the rest follows by plain least squares."""
        energies = [0.0] if self.y is None else _ENERGIES.tolist()
        trials = [trial for energy in energies for trial in self._trials(values, energy)]
        if not trials:
            raise InputError("shear stress has no maximum over speed: no Gaussian law describes it.", code="no-law")
        found = min(trials, key=lambda trial: trial[0])[1]
        return np.array(found if self.y is not None else found[:-1])

    def _trials(self, values: Array, energy: float) -> list[tuple[float, list[float]]]:
        """Return misfits with constants and energy."""
        x = self.x if self.y is None else self.x + energy * self.y
        if self.kind == "gaussian":
            middle = float(x.mean())
            bend, slope, level = np.polyfit(x - middle, values, 2)
            if bend >= 0.0:
                return []
            misfit = float(np.sum((values - np.polyval([bend, slope, level], x - middle)) ** 2))
            place, width = -0.5 * slope / bend, float(np.sqrt(-0.5 / (np.log(10.0) * bend)))
            if abs(place) > _FARTHEST:  # the stress hardly bends over these reduced speeds
                return []
            peak = float(level + 0.5 * slope * place)
            return [(misfit, [10.0**peak, 10.0 ** (middle + float(place)), width, energy])]
        trials = []
        for place in float(x.mean()) + _SPEEDS:
            shape = EyringShearStress(1e-27, 10.0**place)._log10(x, self.kelvin)
            level = float(np.mean(values - shape))
            trials.append((float(np.sum((values - shape - level) ** 2)), [1e-27 * 10.0**-level, 10.0**place, energy]))
        return trials


class _LinearFamily(_Family):
    """Constant stress, and a power of speed: linear in log10 τ, the exponent n, and n times the activation energy."""

    positive = False

    def gradient(self, parameters: Array) -> Array:
        """Return the columns (n, size) of the linear constants."""
        columns = [np.ones(self.x.shape)]
        if self.kind == "power":
            columns.append(self.x - self.x.mean())
            columns += [] if self.y is None else [self.y]
        return np.column_stack(columns)

    def start(self, values: Array) -> Array:
        """Return any constants: the problem is linear; refused where one speed does not fix the exponent."""
        if self.kind == "power" and np.ptp(self.x) <= SMALLEST_ERROR:
            raise _not_described(self.kind)
        return np.zeros(self.size)

    def law(self, parameters: Array, covariance: Array | None = None) -> InterfaceLaw:
        """Return the law from its linear constants and their covariance."""
        stress = 10.0 ** float(parameters[0])
        own, slope = [stress, *parameters[1:]], np.eye(self.size)
        slope[0, 0] = np.log(10.0) * stress
        if self.y is not None:
            exponent, product = float(parameters[1]), float(parameters[2])
            if not exponent * product > 0.0:
                raise InputError(
                    "shear stress over temperature contradicts that over speed: α of a power law would rise with "
                    "temperature.",
                    code="no-law",
                )
            own[2] = product / exponent
            slope[2, 1:] = -product / exponent**2, 1.0 / exponent
        return super().law(np.array(own), None if covariance is None else slope @ covariance @ slope.T)

    def _made(self, parameters: Array, **rest: object) -> InterfaceLaw:
        if self.kind == "power":
            rest["speed"] = float(10.0 ** self.x.mean())
        return super()._made(parameters, **rest)


def fit_stress(kind: str, table: StressTable, shift: ShiftLaw | None, reference: float, energy: bool) -> StressRow:
    """Fit one law; see `ShearStress.law`."""
    found, stress = _fitted(kind, table, shift, reference, energy), np.empty(0)
    if table.about is None:
        return found
    for _ in range(_SETTLING):
        assert found.law is not None
        last, stress = stress, found.law(10.0**table.speed, table.kelvin)
        if last.size and np.max(np.abs(np.log(stress / last))) < _SETTLED:
            return found
        found = _fitted(kind, table.about(stress), shift, reference, energy)
    raise _not_described(kind)


def _fitted(kind: str, table: StressTable, shift: ShiftLaw | None, reference: float, energy: bool) -> StressRow:
    check_choice(kind, "law", *KINDS)
    linear = kind in ("constant", "power")
    family = (_LinearFamily if linear else _Family)(kind, table, shift, reference, energy)
    freedom = len(table) - family.size
    if freedom < 0:
        raise InputError(
            f"{len(table)} values of shear stress are too few to fit {kind!r}; give {family.size} or more.",
            code="too-few-points",
        )
    otherwise = _not_described(kind)
    found, chi2, scatter = solved(family, table, otherwise)
    try:
        level, student = _level(family, table, found.parameters, chi2)
    except np.linalg.LinAlgError:
        raise otherwise from None
    if level > 0.0:
        found, _, scatter = solved(family, table.levelled(student * level), otherwise)
    aic = criterion_of(family, table.levelled(level), found.parameters) + (2.0 if level > 0.0 else 0.0)
    wider = student_factor(freedom) if scatter > 0.0 else 1.0
    law = family.law(found.parameters, wider**2 * found.covariance)
    notes = [*_misfit(level, scatter)]
    if family.positive:
        notes += undetermined(law, found.parameters, law.covariance)
    law = replace(law, notes=tuple(notes))
    return LawRow(kind, law.title, law, family.size, chi2, freedom, scatter, aic, level=level)


def _level(family: _Family, table: StressTable, first: Array, chi2: float) -> tuple[float, float]:
    """Return the error (decades) that values of a temperature share beyond the stated ones, zero if none is seen.

    And the factor with which normal 95 % intervals by it are those of Student's t.  `first` and `chi2` are of the fit
    without such an error.
    """
    from scipy.optimize import minimize_scalar

    # Differences of temperatures that the law, with its activation energy, does not describe.
    freedom = np.unique(table.kelvin).size - 1 - (family.y is not None)
    if freedom < 1 or chi2 <= len(table) - family.size:
        return 0.0, 1.0

    bound = np.log(_LEVELS)
    about = _About.of(family, table, first)
    without, level = about.likelihood(0.0)[0], 0.0
    for _ in range(_ROUNDS):
        found = minimize_scalar(
            lambda log, about=about: -about.likelihood(float(np.exp(log)))[0],
            bounds=(float(bound[0]), float(bound[1])),
            method="bounded",
            options={"xatol": _ALIKE_LEVELS},
        )
        last, level = level, float(np.exp(found.x))
        if not family.positive or abs(level - last) <= 2.0 * _ALIKE_LEVELS * level:
            break
        # Not linear: the same about the constants with that level.
        scatter = about.likelihood(level)[1]
        about = _About.of(family, table, least_squares(family, table.levelled(level), first, scatter**2).parameters)
    if about.likelihood(level)[0] < without + _SEEN:
        return 0.0, 1.0
    return level, student_factor(freedom)


class _About(NamedTuple):
    """A law made linear at some constants: combinations of its slopes by them, and of its misfit."""

    table: StressTable
    slopes: Array
    misfit: Array

    @classmethod
    def of(cls, family: _Family, table: StressTable, parameters: Array) -> _About:
        """Make a law linear at its constants, by their logarithms if these are sought."""
        slopes, misfit = family.gradient(parameters), table.values
        if family.positive:
            slopes = slopes * parameters
            misfit = misfit - family.values(parameters)
        return cls(table, table.turn @ slopes, table.turn @ misfit)

    def likelihood(self, level: float) -> tuple[float, float]:
        """Return ln of the restricted likelihood, and the scatter (decades), with a level of temperatures."""
        levelled = self.table.levelled(level)
        freedom = len(self.misfit) - self.slopes.shape[1]

        def fit(_: Solution | None, added: float) -> Solution:
            whiten = levelled.whitening(added)
            return linear(whiten.of_turned(self.slopes), whiten.of_turned(self.misfit))

        found, scatter = fit(None, 0.0), 0.0
        if found.chi2 > freedom:
            found, scatter = plausible(fit, found, freedom)
        spread = float(np.linalg.slogdet(found.covariance)[1])
        return 0.5 * (spread - found.chi2 - levelled.whitening(scatter**2).log_det), scatter


def _not_described(kind: str) -> InputError:
    return InputError(
        f"the shear stress does not fix the constants of the {KINDS[kind].title} law; take another law, or measure "
        "over a wider range of speeds or temperatures.",
        code="no-law",
    )


def compare_stress_laws(
    table: StressTable, shift: ShiftLaw | None, reference: float, energy: bool
) -> LawComparison[InterfaceLaw]:
    """Fit every law and choose, as laws of shift factors are chosen; see `LawComparison`."""
    rows = [_row(kind, table, shift, reference, energy) for kind in KINDS]
    fitted = [row for row in rows if row.law is not None]
    kind = chosen_row(fitted).kind
    rows = sorted(weighted(rows, fitted), key=lambda row: row.aic)
    chosen = next(row for row in rows if row.kind == kind)
    notes = _notes(chosen, [row for row in rows if row.law is not None], table)
    return LawComparison(tuple(rows), chosen, tuple(notes))


def _row(kind: str, table: StressTable, shift: ShiftLaw | None, reference: float, energy: bool) -> StressRow:
    try:
        return fit_stress(kind, table, shift, reference, energy)
    except InputError as error:
        return LawRow(kind, KINDS[kind].title, None, 0, refusal=str(error))


def _notes(chosen: StressRow, rows: list[StressRow], table: StressTable) -> Iterator[Note]:
    """Yield why a law was chosen, which others cannot be excluded, and the remaining misfit."""
    others = [row for row in rows if row is not chosen]
    better = [row for row in others if row.aic < chosen.aic]
    if better:
        first = f"its AIC is within {chosen.aic - better[0].aic:.2g} of the lowest, and it has fewer constants"
    elif others:
        first = f"its AIC is lower by {others[0].aic - chosen.aic:.2g} than that of the next, {others[0].title}"
    else:
        first = "no other law can be fitted"
    yield Note("law-chosen", f"The law of shear stress is: {chosen.title}; {first}.")
    yield from (_rivalry(chosen, row, table) for row in others if row.aic <= chosen.aic + EXCLUDED)
    assert chosen.law is not None
    yield from map(note_of, chosen.law.notes)


def _misfit(level: float, scatter: float) -> Iterator[Note]:
    """Yield by how much points miss a law beyond their stated errors."""
    if level > 0.0:
        text = f"Temperatures differ in level from the law by {100.0 * (10.0**level - 1.0):.2g} % more than "
        text += "stated (level_error); the errors of the law include it."
        yield Note("level-scatter", text, values={"level": level})
    if scatter > 0.0:
        text = f"Shear stress scatters about the law by {100.0 * (10.0**scatter - 1.0):.2g} % more than its stated "
        text += "errors explain; the errors of the law include it."
        yield Note("law-scatter", text, values={"scatter": scatter})


def _rivalry(chosen: StressRow, rival: StressRow, table: StressTable) -> Note:
    """Return a sentence on the difference of a law that cannot be excluded."""
    assert chosen.law is not None
    assert rival.law is not None
    kelvin = float(np.median(table.kelvin))
    middle = table.speed[np.abs(table.kelvin - kelvin) == np.abs(table.kelvin - kelvin).min()]
    low, high = float(middle.min()), float(middle.max())
    decades = np.linspace(low - _BEYOND, high + _BEYOND, 81)
    apart = np.abs(np.log10(chosen.law(10.0**decades, kelvin) / rival.law(10.0**decades, kelvin)))
    inside, beyond = (
        100.0 * (10.0 ** float(part.max()) - 1.0) for part in (apart[(decades >= low) & (decades <= high)], apart)
    )
    weights = f"Akaike weights {chosen.weight:.2f} and {rival.weight:.2f}"
    code = "laws-alike" if float(apart.max()) <= _ALIKE else "laws-undecided"
    return Note(
        code,
        f"{rival.title} cannot be excluded ({weights}); the two differ by up to {inside:.2g} % at the measured speeds "
        f"and {beyond:.2g} % up to a decade beyond them.",
        values={"inside": inside, "beyond": beyond},
    )
