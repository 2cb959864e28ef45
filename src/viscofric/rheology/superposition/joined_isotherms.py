"""Overlap of isotherms by the quantities chosen: neighbours joined, single ones at the ends left out, gaps refused."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Generic, Literal, TypeAlias, TypeVar

import numpy as np

from viscofric.arguments import numbers
from viscofric.arrays import Array
from viscofric.data import Isotherm
from viscofric.errors import InputError, SuperpositionError, check_choice
from viscofric.notes import Note, Remedy
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.superposition.overlap import (
    Join,
    LogSweep,
    OverlapQuality,
    failures,
    join,
    join_at,
    join_of_most,
)
from viscofric.step_tests import StepTest
from viscofric.units import shown_celsius

ShiftBy: TypeAlias = Literal["both", "storage", "loss", "loss-tangent"]
#: Quantities as combinations (m, 2) of log E' and log E'', and their names.
_SEEN: dict[str, tuple[list[list[float]], str]] = {
    "both": ([[1.0, 0.0], [0.0, 1.0]], "E' and E''"),
    "storage": ([[1.0, 0.0]], "E' alone"),
    "loss": ([[0.0, 1.0]], "E'' alone"),
    "loss-tangent": ([[-1.0, 1.0]], "tan δ alone"),
}


@dataclass(frozen=True, eq=False)
class Quantities:
    """The m quantities of an isotherm that a fit of shifts compares."""

    by: ShiftBy
    seen: Array  # (m, 2), each as a combination of log E' and log E''; (1, 1) for step tests, which have one quantity
    weights: Array  # (m,), of their squared residuals; their mean is 1

    @classmethod
    def chosen(cls, by: str = "both", weights: Any = None) -> Quantities:
        """Return a choice; InputError if unknown, or if the weights are not two positive numbers for E' and E''."""
        check_choice(by, "by", *_SEEN)
        seen = np.array(_SEEN[by][0])
        if weights is None:
            return cls(by, seen, np.ones(len(seen)))  # type: ignore[arg-type]
        if by != "both":
            raise InputError(
                f"weights are for E' and E'' together, and α is found from {_SEEN[by][1]}; leave them out.",
                field="weights",
                code="useless-weights",
            )
        values = numbers(weights, "weights")
        if values.shape != (2,) or not np.all((values > 0.0) & np.isfinite(values)):
            raise InputError(
                "weights must be two positive numbers, of log E' and of log E''; for one of the two alone, "
                "choose by='storage' or by='loss'.",
                field="weights",
                code="wrong-weights",
            )
        return cls("both", seen, values / values.mean())

    @property
    def joint(self) -> bool:
        """Whether E' and E'' both take part."""
        return self.by == "both"

    @property
    def onto_moduli(self) -> Array:
        """Smallest offsets of log E' and log E'' per offset of each quantity, (2, m)."""
        return np.asarray(np.linalg.pinv(self.seen))

    @property
    def alone(self) -> bool:
        """Whether one quantity is shifted where two moduli were measured."""
        return bool(len(self.seen) < self.seen.shape[1])

    def of(self, sweeps: list[LogSweep]) -> list[LogSweep]:
        """Return the quantities of isotherms given by log E' and log E''."""
        return [LogSweep(one.frequency, one.moduli @ self.seen.T, one.weights) for one in sweeps]

    def insist_on_use(self, vertical: object, shift: object) -> None:
        """Raise an error for a choice without effect beside the other arguments of `superpose`."""
        if shift is not None and self.notes:
            raise InputError(
                "shift and by (or weights): give one of them; with shift no factor is left to be fitted.",
                code="give-one",
            )
        if self.by == "loss-tangent" and vertical == "free":
            raise InputError(
                "vertical shifts cancel in tan δ, so that none can be fitted to it.",
                code="no-vertical-in-tangent",
                remedy=Remedy(
                    " Find α first, and fit b to both moduli then: superpose(sweeps, T, shift=fit.shift_factors, "
                    "vertical='free').",
                    " Shift by both moduli, or without a vertical shift.",
                ),
            )

    @property
    def notes(self) -> tuple[Note, ...]:
        """Notes on a choice other than the default."""
        if not self.joint:
            return (Note("shifted-by", f"α was found from {_SEEN[self.by][1]}, as requested."),)
        if self.weights[0] != self.weights[-1]:
            storage, loss = self.weights
            return (
                Note(
                    "shifted-by",
                    f"α was found from E' and E'' with the weights {storage:.3g} and {loss:.3g}, as requested.",
                ),
            )
        return ()


#: E' and E'' with equal weights.
BOTH = Quantities.chosen()
#: The quantity of creep and relaxation tests: log of a modulus, 1/J(t) or E(t), over the rate 1/t.
STEP = Quantities("both", np.ones((1, 1)), np.ones(1))


# What to do with sweeps at one temperature.
_ONE_SWEEP = " For one temperature alone, " + Remedy(
    "read it with read_master_curve.",
    "give it to material fit --master-curve.",
    "give it as master_curve under [material].",
    "choose “A master curve” as “Source of the material”.",
)
_ONE_TEST = Remedy(" For one temperature alone, make it a readers.StepMasterCurve.", "")
#: A measurement at one temperature.
Tested = TypeVar("Tested", Isotherm, StepTest)
#: Neighbours whose moduli cannot be brought closer than this (decades, joint rms) are not joined.
LARGEST_MISFIT = 0.15


@dataclass(frozen=True, eq=False)
class JoinedIsotherms(Generic[Tested]):
    """Isotherms that overlap, and how they join."""

    isotherms: tuple[Tested, ...]  # ascending in temperature
    logs: list[LogSweep]  # their logarithms, without a given vertical shift
    joins: list[Join]  # of each with the next warmer one
    notes: tuple[str, ...]  # what was left out

    def less(self, log10_b: Array) -> JoinedIsotherms[Tested]:
        """Return the same with vertical shifts subtracted from the logarithms."""
        logs = [LogSweep(sweep.frequency, sweep.moduli - one) for sweep, one in zip(self.logs, log10_b, strict=True)]
        return replace(self, logs=logs)

    def disagreements(self, *, given: bool = False) -> tuple[str, ...]:
        """Return a note on each pair of neighbours that does not superpose, with fitted or given shift factors."""
        how = (
            "with the given shift factors."
            if given
            else "many times what is typical here; they were joined where they overlap best, with a large uncertainty."
        )
        return tuple(
            Note(
                "sweeps-disagree",
                f"The isotherms at {shown(self.isotherms[place].temperature)} and "
                f"{shown(self.isotherms[place + 1].temperature)} disagree by {self.joins[place].misfit:.2g} decades, "
                f"{how}",
            )
            for place in failures(self.joins)
        )


def shown(kelvin: float) -> str:
    """Return a temperature as text for users."""
    return f"{shown_celsius(kelvin)} °C"


def ranges(steps: Iterable[tuple[float, float]]) -> str:
    """Return steps from a colder to a warmer temperature, ascending, as ranges in words, adjacent ones joined."""
    runs: list[list[float]] = []
    for colder, warmer in steps:
        if runs and runs[-1][1] == colder:
            runs[-1][1] = warmer
        else:
            runs.append([colder, warmer])
    return ", ".join(f"{shown(colder)} to {shown(warmer)}" for colder, warmer in runs)


def steps_at(temperatures: Array, places: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return the two temperatures of each step from one isotherm to the next."""
    return tuple((float(temperatures[place]), float(temperatures[place + 1])) for place in places)


def on_gaps(temperatures: Array, quality: OverlapQuality) -> list[Note]:
    """Return a note on the neighbours that do not overlap once shifted, none where all do."""
    if not quality.gaps:
        return []
    sentence = (
        f"{quality.without_overlap} of {quality.neighbours} pairs of neighbouring isotherms do not overlap once "
        f"shifted, from {ranges(steps_at(temperatures, quality.gaps))}: nothing measured tests the shift there."
    )
    return [Note("no-overlap", sentence)]


def usable(isotherms: Sequence[Isotherm | StepTest]) -> None:
    """Raise SuperpositionError unless there are at least two isotherms of at least two points."""
    if len(isotherms) < 2:
        raise SuperpositionError(
            f"{len(isotherms)} isotherm cannot be superposed; at least two are needed.",
            code="too-few-isotherms",
            remedy=_ONE_SWEEP if any(isinstance(one, Isotherm) for one in isotherms) else _ONE_TEST,
        )
    for isotherm in isotherms:
        if len(isotherm) < 2:
            raise SuperpositionError(
                f"the isotherm at {shown(isotherm.temperature)} has only one usable point; two or more are needed.",
                code="too-few-frequencies",
            )
    for colder, warmer in pairwise(isotherms):
        if not colder.temperature < warmer.temperature:
            raise SuperpositionError(
                f"two isotherms are at {shown(colder.temperature)}; merge them or leave one out.",
                code="same-temperature",
            )


def join_isotherms(
    isotherms: tuple[Tested, ...], logs: list[LogSweep], quantities: Quantities = BOTH
) -> JoinedIsotherms[Tested]:
    """Join neighbours by their quantities, and leave out single isotherms at the ends that overlap no other."""
    joins = [join(colder, warmer) for colder, warmer in pairwise(quantities.of(logs))]
    for place, (colder, warmer) in enumerate(pairwise(quantities.of(logs))):
        if joins[place].misfit > LARGEST_MISFIT:
            joins[place] = join_of_most(colder, warmer, LARGEST_MISFIT) or joins[place]
    joined = np.array([found.misfit <= LARGEST_MISFIT or found.of_most for found in joins])
    if not joined.any():
        raise SuperpositionError(_gap(isotherms, 0), code="no-overlap")
    first, last = int(np.argmax(joined)), len(joined) - int(np.argmax(joined[::-1]))
    broken = np.flatnonzero(~joined[first:last])
    if broken.size:
        steps = [(isotherms[place].temperature, isotherms[place + 1].temperature) for place in np.flatnonzero(joined)]
        keep = f"keep one of the ranges within which isotherms overlap ({ranges(steps)}) and delete the others, or "
        raise SuperpositionError(_gap(isotherms, first + int(broken[0]), keep), code="no-overlap")
    notes = tuple(
        Note("left-out", f"The isotherm at {shown(isotherms[place].temperature)} was left out: {_gap(isotherms, gap)}")
        for place, gap in [(p, p) for p in range(first)] + [(p, p - 1) for p in range(last + 1, len(isotherms))]
    )
    temperatures = np.array([one.temperature for one in isotherms])
    if of_most := steps_at(temperatures, [place for place in range(first, last) if joins[place].of_most]):
        said = f"The isotherms from {ranges(of_most)} were joined by most of their points, for others are far off: "
        notes += (Note("points-far-off", f"{said}errors are large; look for outliers among the readings."),)
    inside = slice(first, last + 1)
    return JoinedIsotherms(isotherms[inside], logs[inside], joins[first:last], notes)


def as_given(isotherms: tuple[Tested, ...], logs: list[LogSweep], shift: ShiftLaw) -> JoinedIsotherms[Tested]:
    """Compare all neighbours at given shift factors; InputError if the shift is invalid at one of the temperatures."""
    values = [shift.log10(isotherm.temperature) for isotherm in isotherms]
    steps = [colder - warmer for colder, warmer in pairwise(values)]
    joins = [join_at(colder, warmer, step) for (colder, warmer), step in zip(pairwise(logs), steps, strict=True)]
    return JoinedIsotherms(isotherms, logs, joins, ())


def _gap(isotherms: Sequence[Isotherm | StepTest], place: int, remedy: str = "") -> str:
    colder, warmer = isotherms[place], isotherms[place + 1]
    return (
        f"the isotherms at {shown(colder.temperature)} and {shown(warmer.temperature)} do not overlap "
        f"(no shift brings their moduli within {LARGEST_MISFIT:g} decades of each other); "
        f"{remedy}measure in between, or over more frequencies or times."
    )
