"""Overlap of neighbouring isotherms: where two sweeps join, and how well a set of shifts joins all.

Given shift factors may all be wrong by one factor.  Then no pair of neighbours stands out, and no plot without the
frequency (`consistency`) shows it; `own_shifts` compares with the best overlap of each pair.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.data import Isotherm
from viscofric.datasets import Dataset, dataset
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.showing import Rows, Shown
from viscofric.step_tests import StepKind, StepTest

#: Sweeps are slid along each other in steps of this many decades …
STEP = 0.02
#: … while at least this part of the shorter one lies over the other.
SMALLEST_OVERLAP = 0.1
#: Steps that differ by more than this and join equally well show a plateau.
FLAT = 0.5  # decades
#: Neighbours whose misfit is this many times the typical one do not superpose; see `failures`.
FAILURE = 5.0
#: … and at least this, more than interpolation between sparse points or the grid of steps can cause.
SMALLEST_FAILURE = 0.03  # decades
#: Where sweeps are joined pair by pair, the best steps of E' and of E'' differ by about this.
PAIR_UNCERTAINTY = 0.5  # decades
SMALLEST_NOISE = 1e-6  # decades; keeps noise-free data from dividing by zero
#: Half of normal errors are smaller than this many standard deviations …
QUARTILE = 0.6745
#: … which fewer points, or a smaller part of a sweep, do not show; and number of steps that are tried.
FEWEST_OF_MOST, PART_OF_MOST, STEPS_OF_MOST = 4, 0.4, 201
#: Sides of an interval that differ by more than this factor are not those of a parabola with noise.
LOPSIDED = 1.5


@dataclass(frozen=True, eq=False)
class LogSweep:
    """One isotherm in logarithms."""

    frequency: Array  # (n,), or speed
    moduli: Array  # (n, 2), storage and loss; of fits other quantities too, in any number of columns
    weights: Array | None = None  # (n,), inverse variances of the points relative to each other

    @classmethod
    def of_step(cls, test: StepTest, kind: StepKind, weights: Array | None = None) -> LogSweep:
        """Take base-10 logarithms of the rate 1/t, ascending, and of the relaxation modulus or 1/J(t); 1/s and Pa."""
        response = np.log10(test.response)[::-1, None]
        return cls(-np.log10(test.time)[::-1], -response if kind == "creep" else response, weights)

    @classmethod
    def of(cls, isotherm: Isotherm, log10_b: float = 0.0) -> LogSweep:
        """Return base-10 logarithms of an isotherm in rad/s and Pa, minus a vertical shift."""
        moduli = np.stack([isotherm.storage_modulus, isotherm.loss_modulus], axis=1)
        return cls(np.log10(isotherm.angular_frequency), np.log10(moduli) - log10_b)

    def __len__(self) -> int:
        return len(self.frequency)

    def at(self, frequency: Array) -> Array:
        """Interpolate log moduli linearly in log frequency; returns the shape of `frequency` and (2,)."""
        return np.stack([np.interp(frequency, self.frequency, column) for column in self.moduli.T], axis=-1)

    def covers(self, frequency: Array) -> Mask:
        """Return which frequencies lie within the sweep."""
        inside: Mask = (frequency >= self.frequency[0]) & (frequency <= self.frequency[-1])
        return inside


@dataclass(frozen=True)
class Join:
    """Best joint overlap of two sweeps."""

    step: float  # log10 α of the colder minus that of the warmer
    misfit: float  # joint rms √((ΔE'² + ΔE''²)/2) of the log moduli where they overlap, decades
    # Standard error of the step if the misfit is one error of each modulus, constant along the overlap: half of the
    # interval of steps whose χ² is within 1.96² of the best, over 1.96; or, if greater, the root mean square of the
    # differences from the best steps of E' and of E'' alone.
    uncertainty: float
    # Whether most of the points overlap, and some are so far off that the misfit does not show it.
    of_most: bool = False


def join(colder: LogSweep, warmer: LogSweep, noise: float = 0.0) -> Join:
    """Slide one sweep along the other and find where their quantities (E' and E'') overlap best, jointly."""
    # A misfit below `noise`, decades, is chance, as of two points that overlap: the uncertainty is that of `noise`.
    # The colder one is compared at its own points, as in `OverlapQuality`. Where the data do not fix the step (a
    # plateau), the smallest of the equally good steps is taken.
    lowest, highest = steps_that_overlap(colder, warmer)
    steps = np.linspace(lowest, highest, max(3, int((highest - lowest) / STEP)))
    frequency = colder.frequency + steps[:, None]
    inside = warmer.covers(frequency)
    columns = colder.moduli.shape[1]
    count = columns * np.sum(inside, axis=1)
    squares = np.stack(
        [
            np.sum((inside * (np.interp(frequency, warmer.frequency, there) - here)) ** 2, axis=1)
            for here, there in zip(colder.moduli.T, warmer.moduli.T, strict=True)
        ],
        axis=1,
    )
    misfit = np.sqrt(np.sum(squares, axis=1) / np.maximum(count, 1))
    misfit[count < 2 * columns] = np.inf  # two points of each modulus are the least that show a curve
    best = int(np.argmin(misfit))
    as_good = steps[misfit <= 1.05 * misfit[best] + 1e-4]
    if np.ptp(as_good) > FLAT:
        best = int(np.argmin(np.abs(steps - as_good[np.argmin(np.abs(as_good))])))
    if misfit[best] == np.inf:
        return Join(float(steps[best]), np.inf, np.inf)
    found = join_at(colder, warmer, float(steps[best]))
    allowed = max(found.misfit + SMALLEST_NOISE, noise) ** 2 * (1.0 + LEVEL_95**2 / columns)
    half = allowed_half_width(steps - found.step, misfit**2, allowed)
    means = np.where(np.isfinite(misfit)[:, None], squares, np.inf) / np.maximum(count, 1)[:, None]
    away = steps[np.argmin(means, axis=0)] - found.step
    return replace(found, uncertainty=max(found.uncertainty, half / LEVEL_95, float(np.sqrt(np.mean(away**2)))))


def join_of_most(colder: LogSweep, warmer: LogSweep, largest: float) -> Join | None:
    """Join two sweeps by most of their points, whatever the others are; None where these differ by more than given."""
    steps = np.linspace(*steps_that_overlap(colder, warmer), STEPS_OF_MOST)
    frequency = colder.frequency + steps[:, None]
    away = np.abs(warmer.at(frequency) - colder.moduli)
    inside = warmer.covers(frequency)
    away[~inside] = np.nan
    enough = np.count_nonzero(inside, axis=1) >= max(FEWEST_OF_MOST, PART_OF_MOST * min(len(colder), len(warmer)))
    if not np.any(enough):
        return None
    scatter = np.max(np.nanmedian(away[enough], axis=1), axis=1) / QUARTILE
    best = int(np.argmin(scatter))
    found = join_at(colder, warmer, float(steps[enough][best]))
    wide = replace(found, uncertainty=max(found.uncertainty, PAIR_UNCERTAINTY), of_most=True)
    return wide if scatter[best] <= largest else None


def steps_that_overlap(colder: LogSweep, warmer: LogSweep) -> tuple[float, float]:
    """Return the smallest and the largest step at which two sweeps overlap."""
    margin = SMALLEST_OVERLAP * float(min(np.ptp(colder.frequency), np.ptp(warmer.frequency)))
    return (
        float(warmer.frequency[0] - colder.frequency[-1]) + margin,
        float(warmer.frequency[-1] - colder.frequency[0]) - margin,
    )


def allowed_half_width(moves: Array, rise: Array, threshold: float) -> float:
    """Return half of the interval about zero of moves, ascending, whose rise is below a threshold."""
    # It is the root mean square of the two sides where these differ by no more than noise explains, else the wider
    # side. Between moves the root of the rise is interpolated linearly, which is exact for a parabola about zero.
    allowed = np.flatnonzero(rise <= threshold)
    ends = []
    for last, beyond in ((allowed[0], allowed[0] - 1), (allowed[-1], allowed[-1] + 1)):
        end = moves[last]
        if 0 <= beyond < len(moves) and np.isfinite(rise[beyond]):
            low, high = np.sqrt(max(rise[last], 0.0)), np.sqrt(rise[beyond])
            end = end + (moves[beyond] - end) * (np.sqrt(threshold) - low) / (high - low)
        ends.append(abs(float(end)))
    narrow, wide = sorted(ends)
    return wide if wide > LOPSIDED * narrow else float(np.hypot(narrow, wide) / np.sqrt(2.0))


def join_at(colder: LogSweep, warmer: LogSweep, step: float) -> Join:
    """Return the overlap of two sweeps at a given step; the uncertainty is infinite where they do not overlap."""
    frequency = colder.frequency + step
    inside = warmer.covers(frequency)
    if not np.any(inside):
        return Join(step, 0.0, np.inf)
    differences = warmer.at(frequency[inside]) - colder.moduli[inside]
    misfit = float(np.sqrt(np.mean(differences**2)))
    slope = np.gradient(colder.moduli, colder.frequency, axis=0)[inside]
    return Join(step, misfit, misfit / max(float(np.linalg.norm(slope)), 1e-6))


def failures(joins: list[Join]) -> list[int]:
    """Return the indices of joins where superposition itself fails: misfits many times the typical one."""
    limit = max(FAILURE * (float(np.median([found.misfit for found in joins])) + SMALLEST_NOISE), SMALLEST_FAILURE)
    return [place for place, found in enumerate(joins) if found.misfit > limit]


def parted(sweeps: list[LogSweep], log10_shifts: Array) -> list[int]:
    """Return neighbours that shifts move apart: they overlap by less than `steps_that_overlap` has it."""
    steps = log10_shifts[:-1] - log10_shifts[1:]
    limits = np.array([steps_that_overlap(colder, warmer) for colder, warmer in pairwise(sweeps)])
    return [int(place) for place in np.flatnonzero((steps < limits[:, 0]) | (steps > limits[:, 1]))]


#: Isotherms overlap well if they differ by this at most.
LARGEST_OVERLAP = 0.05  # decades, rms of E' and of E''


@dataclass(frozen=True)
class OverlapQuality(Shown):
    """How well shifted isotherms overlap with their neighbours.

    Each isotherm, shifted, is compared at its own points with the next warmer one where their reduced
    frequencies overlap (linear interpolation in log–log).

    Parameters
    ----------
    storage, loss : float
        Root mean square of the difference of log10 E', and of log10 E'', over all neighbours; decades.  Of step tests,
        which have one curve for each temperature, both are that of log10 J or log10 E.
    points : int
        Number of points compared.
    neighbours : int
        Number of pairs of neighbouring isotherms.
    gaps : tuple of int
        Places of the pairs that do not overlap once shifted, counted from the coldest: nothing tests the shift there.
    """

    storage: float
    loss: float
    points: int
    neighbours: int = 0
    gaps: tuple[int, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("misfit of the storage modulus", self.storage, "decades"),
            ("of the loss modulus", self.loss, "decades"),
            ("points", self.points),
            ("neighbours", self.neighbours),
            ("without overlap", self.without_overlap),
        )

    @property
    def without_overlap(self) -> int:
        """Number of pairs of neighbours that do not overlap once shifted."""
        return len(self.gaps)

    @property
    def joint(self) -> float:
        """√((storage² + loss²)/2), decades."""
        return float(np.sqrt(0.5 * (self.storage**2 + self.loss**2)))

    @property
    def holds(self) -> bool:
        """Whether all neighbours overlap, and differ by 0.05 decades (rms) at most."""
        return max(self.storage, self.loss) <= LARGEST_OVERLAP and not self.gaps

    @property
    def attributes(self) -> dict[str, float]:
        """What data sets of shift factors say of the overlap, besides its misfits."""
        return {
            "neighbours": self.neighbours,
            "neighbours_without_overlap": self.without_overlap,
            "overlap_holds": int(self.holds),
            "overlap_limit": LARGEST_OVERLAP,
        }

    def to_dataset(self) -> Dataset:
        """Return the misfits as single numbers.

        ``overlap_rms_log10_storage`` and ``overlap_rms_log10_loss`` (decades), ``points``, ``neighbours`` and
        ``neighbours_without_overlap``.
        """
        rms = "rms difference of log10 of the {} modulus where shifted isotherms overlap"
        return dataset(
            (),
            {
                "overlap_rms_log10_storage": (self.storage, "1", rms.format("storage")),
                "overlap_rms_log10_loss": (self.loss, "1", rms.format("loss")),
                "points": (self.points, "1", "number of points compared"),
                "neighbours": (self.neighbours, "1", "number of pairs of neighbouring isotherms"),
                "neighbours_without_overlap": (self.without_overlap, "1", "number of pairs that do not overlap"),
            },
        )


def overlap_quality(sweeps: list[LogSweep], log10_shifts: Array) -> OverlapQuality:
    """Compare every shifted isotherm with its warmer neighbour; see `OverlapQuality`."""
    differences = [np.empty((0, sweeps[0].moduli.shape[1]))]
    gaps = []
    for place, (colder, warmer) in enumerate(pairwise(sweeps)):
        frequency = colder.frequency + log10_shifts[place] - log10_shifts[place + 1]
        inside = warmer.covers(frequency)
        differences.append(warmer.at(frequency[inside]) - colder.moduli[inside])
        if not np.any(inside):
            gaps.append(place)
    every = np.concatenate(differences)
    pairs = len(sweeps) - 1
    if not len(every):
        return OverlapQuality(0.0, 0.0, 0, pairs, tuple(gaps))
    rms = np.sqrt(np.mean(every**2, axis=0))
    return OverlapQuality(float(rms[0]), float(rms[-1]), len(every), pairs, tuple(gaps))


#: Factors are wrong if the misfit of neighbours exceeds that at their best overlap this many times: 1.0 to 1.2 times
#: for factors fitted to real sweeps (an acrylic, an adhesive, a foam, an EVA that melts), 1.2 to 1.9 for WLF laws
#: fitted to such factors (3.6 for the foam, which follows no such law), and 2.1 to 7.8 for the factors with log10 α too
#: large by 40 %.
BADLY = 2.0


@dataclass(frozen=True)
class OwnShifts:
    """Misfit of neighbours as they are shifted, and the misfit when each pair is shifted to its best overlap."""

    # Joint rms misfit of log10 E' and log10 E'', root mean square over the pairs that overlap as they are shifted;
    # decades. Zero where none does.
    misfit: float
    attainable: float  # the same with each of these pairs at its best overlap

    @property
    def wrong(self) -> bool:
        """Whether other shift factors would join the isotherms clearly better."""
        return self.misfit > max(BADLY * self.attainable, SMALLEST_FAILURE)

    @property
    def clause(self) -> str:
        """The result as a part of a sentence."""
        return (
            f"shifted by them neighbouring sweeps miss each other by {self.misfit:.2g} decades (rms) where they "
            f"overlap, and each pair shifted for itself by {self.attainable:.2g}"
        )


def own_shifts(sweeps: Sequence[LogSweep], log10_shifts: Array) -> OwnShifts:
    """Compare the misfit of sweeps, shifted by log10 α (n,), with that of the best overlap of each pair."""
    shifted, best = [], []
    for place, (colder, warmer) in enumerate(pairwise(sweeps)):
        there = join_at(colder, warmer, float(log10_shifts[place] - log10_shifts[place + 1]))
        own = join(colder, warmer)
        if np.isfinite(there.uncertainty) and np.isfinite(own.misfit):
            shifted.append(there.misfit)
            best.append(min(own.misfit, there.misfit))  # the steps that `join` tries are coarse
    if not shifted:
        return OwnShifts(0.0, 0.0)
    return OwnShifts(*(float(np.sqrt(np.mean(np.square(one)))) for one in (shifted, best)))
