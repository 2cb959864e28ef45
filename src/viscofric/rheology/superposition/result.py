"""The result of a superposition of isotherms, and whether superposition holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, Generic, TypeVar, overload

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.data import Isotherm, MasterCurve
from viscofric.datasets import Dataset
from viscofric.notes import Note
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift, with_vertical_shift
from viscofric.rheology.superposition import consistency
from viscofric.rheology.superposition.consistency import (
    LARGEST_FIGURE,
    REPRODUCIBILITY,
    Judged,
    SuperpositionCheck,
    Verdict,
)
from viscofric.rheology.superposition.isotherm_offsets import IsothermOffsets
from viscofric.rheology.superposition.joined_isotherms import ShiftBy, Tested, ranges, shown
from viscofric.rheology.superposition.overlap import SMALLEST_NOISE, LogSweep, OverlapQuality, join, own_shifts
from viscofric.showing import Plotted, Rows
from viscofric.step_tests import StepKind, StepMasterCurve, StepTest, parts_of_decades
from viscofric.threads import one_blas_thread
from viscofric.units import shown_number

#: Points of a test are averaged over so many equal parts of each decade of time.
PER_DECADE = 20
#: Neighbours within this distance show noise, and no curvature; at least so many.
NEAR = 2.5 / PER_DECADE
LEAST_READINGS = 20
#: An average counts for no more independent readings than these: slow errors, as of a drift, stay in it unseen.
MOST_INDEPENDENT = 8.0
#: J grows in proportion to time in flow; over the last half decade of a test as this power at least …
FLOW = 0.9
HALF_DECADE = 0.5
#: … by a straight line through so many points or more.
LEAST_POINTS = 4


@dataclass(frozen=True, eq=False)
class StepCheck(Judged):
    """Whether creep or relaxation tests are one material at shifted times.

    Parameters
    ----------
    distances : (n − 1,) array
        How far neighbouring tests miss each other where they overlap best, each pair with a shift of its own, beyond
        the noise of their points: rms of log10 of the response, decades.
    figure_of_merit : float
        Root mean square over neighbours of their distance over what noise (95 %) and the reproducibility of such
        measurements (0.02 decades, 5 %) explain together; or a third of the largest of these ratios, if that is more.
        Superposition holds up to 1.
    overlap_misfit : float
        The rms misfit of the shifted tests where they overlap, decades.
    verdict : str
        ``"holds"``; ``"other factors"``: it does, but the shift factors do not join the tests; ``"not identified"``:
        the tests do not fix every step of α; ``"roughly"`` or ``"fails"``: they lie farther apart.
    sentences : tuple of str
        The verdict in plain words; the first is a `Note` whose code is ``"superposition-"`` and the verdict.
    temperatures : (n,) array
        Of the tests, K.

    Notes
    -----
    Sweeps are compared in tan δ against abs(E), which no shift changes.  A step test has one curve; a pair is compared
    at the shift that suits it best, so that only a difference in shape shows.
    """

    distances: Array
    figure_of_merit: float
    overlap_misfit: float
    verdict: Verdict
    sentences: tuple[str, ...]
    temperatures: Array

    def _shown(self) -> Rows:
        return (
            ("verdict", self.verdict),
            ("figure of merit", self.figure_of_merit),
            ("overlap misfit", self.overlap_misfit, "decades"),
            ("temperature", self.temperatures, "°C"),
        )

    def to_dataset(self) -> Dataset:
        """Return the temperatures (K) of the tests as a labelled data set, with the verdict as attributes."""
        return self._dataset(self.temperatures, self.sentences)


#: The master curve of one kind of tests.
Curve = TypeVar("Curve", MasterCurve, StepMasterCurve)


@dataclass(frozen=True, eq=False)
class Superposed(Plotted, Generic[Curve, Tested]):
    """What superpositions of sweeps and of step tests have in common; `Superposition` describes the attributes."""

    shift_factors: ShiftFactors
    master_curve: Curve
    quality: OverlapQuality
    notes: tuple[str, ...] = ()
    isotherms: tuple[Tested, ...] = ()
    vertical_shift: VerticalShift | None = None
    cross_covariance: Array | None = None
    offsets: IsothermOffsets | None = None
    unidentified: tuple[tuple[float, float], ...] = ()

    def _shown(self) -> Rows:
        return (
            ("temperature", self.shift_factors.temperatures, "°C"),
            ("reference", self.shift_factors.reference, "°C"),
            ("log10 α", self.shift_factors.log10_values),
            ("overlap misfit", self.quality.joint, "decades"),
            ("superposition", self.check.verdict),
        )

    @property
    def check(self) -> Judged:
        """Whether superposition holds."""
        raise NotImplementedError

    def _attributes(self) -> dict[str, Any]:
        """Return what data sets say of the overlap."""
        raise NotImplementedError

    def to_dataset(self) -> Dataset:
        """Return shift factors, vertical shift and overlap of the isotherms as a labelled data set.

        ``log10_shift_factor`` and ``standard_error`` along ``temperature`` (K), and ``log10_vertical_shift`` and
        ``vertical_standard_error`` where there is a vertical shift; rms misfits of the overlaps (decades) among the
        attributes.
        """
        found = self.shift_factors.to_dataset()
        found.attrs |= {"isotherms_used": len(self.shift_factors.temperatures), **self._attributes()}
        return with_vertical_shift(found, self.vertical_shift, self.shift_factors.temperatures)


@dataclass(frozen=True, eq=False)
class StepSuperposition(Superposed[StepMasterCurve, StepTest]):
    """The result of `superpose` of creep or relaxation tests; the attributes of `Superposition` but the last two.

    Attributes
    ----------
    master_curve : StepMasterCurve
        Tensile, at the reference, free of vertical shift: b(T) J(t, T) or E(t, T)/b(T) against t/α(T).
    quality : OverlapQuality
        How well neighbours overlap: `joint` is the rms of log10 of the response.
    isotherms : tuple of StepTest
        Those that were joined, tensile, averaged over twentieths of a decade of time, in ascending temperature: one for
        each entry of `shift_factors.temperatures`.
    """

    def _shown(self) -> Rows:
        return (
            ("tests", f"{len(self.isotherms)} of {self.master_curve.kind}"),
            *super()._shown(),
            ("notes", self.notes),
        )

    def _attributes(self) -> dict[str, Any]:
        quality = self.quality
        return {"kind": self.master_curve.kind, "overlap_rms_log10": quality.joint, **quality.attributes}

    @cached_property
    @one_blas_thread
    def check(self) -> StepCheck:
        """Whether superposition holds, evaluated at first use."""
        factors, vertical = self.shift_factors, self.vertical_shift
        temperatures = factors.temperatures
        levels = np.zeros(len(temperatures)) if vertical is None else np.asarray(vertical.log10(temperatures))
        logs = [LogSweep.of_step(one, self.master_curve.kind) for one in self.isotherms]
        logs = [LogSweep(one.frequency, one.moduli - by) for one, by in zip(logs, levels, strict=True)]
        noise = np.array([_noise(one) for one in logs])
        both = np.hypot(noise[1:], noise[:-1])
        misfits = np.array([join(colder, warmer).misfit for colder, warmer in pairwise(logs)])
        distances = np.sqrt(np.maximum(misfits**2 - both**2, 0.0))
        ratio = distances / np.hypot(REPRODUCIBILITY, LEVEL_95 * both / np.sqrt(LEAST_POINTS))
        figure = consistency.figure_of_merit(ratio)
        own = own_shifts(logs, factors.log10_values)
        verdict = consistency.verdict_of(figure, None, self.unidentified, own)
        apart = (
            f"neighbouring tests, each pair with its own shift, miss each other by "
            f"{consistency.rms(distances):.2g} decades (rms) beyond their noise (figure of merit "
            f"{figure:.2g}, good if ≤ {LARGEST_FIGURE:g})"
        )
        said = {
            "holds": f"Superposition holds: {apart}.",
            "other factors": f"Superposition holds, but not with these shift factors: {own.clause}; {apart}.",
            "not identified": f"Superposition is tested only in part: α is not identified from "
            f"{ranges(self.unidentified)}; elsewhere {apart}.",
            "roughly": f"Superposition holds only roughly: {apart}.",
            "fails": f"Superposition does not hold: {apart}.",
        }[verdict]
        values = {"figure_of_merit": float(figure), "vertical_shift": vertical is not None}
        note = Note(f"superposition-{verdict.replace(' ', '-')}", said, values=values)
        return StepCheck(distances, figure, self.quality.joint, verdict, (note,), temperatures)


def _noise(sweep: LogSweep) -> float:
    """Return the standard deviation of points about a smooth curve, from their distances to their neighbours' lines."""
    if len(sweep) <= LEAST_POINTS:
        return 0.0
    made = np.sum(_shares(sweep.frequency) ** 2, axis=0)
    return float(np.sqrt(np.mean(_off_lines(sweep) ** 2 / made)))


def _shares(places: Array) -> Array:
    """Return the shares (3, n − 2) of three successive points in the distance of the middle one to the others' line."""
    early = (places[2:] - places[1:-1]) / (places[2:] - places[:-2])
    return np.stack([-early, np.ones_like(early), early - 1.0])


def _off_lines(sweep: LogSweep) -> Array:
    """Return the distances (n − 2,) of points to the lines through their neighbours, in which smooth curves vanish."""
    shares, values = _shares(sweep.frequency), sweep.moduli[:, 0]
    return np.asarray(shares[0] * values[:-2] + shares[1] * values[1:-1] + shares[2] * values[2:])


def weights_of_averages(tests: Sequence[StepTest], kind: StepKind) -> list[Array | None]:
    """Return inverse variances of the points of averaged tests relative to each other, from the readings in each."""
    # Readings at equal intervals of time put one into the first parts of a decade and hundreds into the last. An
    # average of n has the variance white/n + common: the first from what readings scatter about the lines through
    # their neighbours, the second, that of errors which neighbouring readings share, from the averages' own scatter.
    # Without weights 95 % intervals of α held 75 to 87 % of planted factors.
    readings, averages, expected, counts = [], [], [], []
    for test in tests:
        parts = 1.0 / parts_of_decades(test.time, PER_DECADE)[1][::-1]
        readings.append(_noise_near(LogSweep.of_step(test, kind))[0])
        squares, mean = _noise_near(LogSweep.of_step(test.thinned(PER_DECADE), kind), parts)
        averages.append(squares)
        expected.append(mean)
        counts.append(parts)
    if min(sum(map(len, readings)), sum(map(len, averages))) < LEAST_READINGS:
        return [None] * len(tests)
    white = float(np.mean(np.concatenate(readings)))
    rest = float(np.mean(np.concatenate(averages)) - white * np.mean(np.concatenate(expected)))
    common = max(rest, white / MOST_INDEPENDENT, SMALLEST_NOISE**2)
    inverse = [1.0 / (white * parts + common) for parts in counts]
    usual = float(np.mean(np.concatenate(inverse)))
    return [one / usual for one in inverse]


def _noise_near(sweep: LogSweep, variances: Array | None = None) -> tuple[Array, Array]:
    """Return estimates (m,) of the variance of points with near neighbours, and their expectation for `variances`."""
    shares = _shares(sweep.frequency) ** 2
    near = sweep.frequency[2:] - sweep.frequency[:-2] < NEAR
    squares = _off_lines(sweep) ** 2 / np.sum(shares, axis=0)
    if variances is None:
        return squares[near], np.ones(np.count_nonzero(near))
    expected = shares[0] * variances[:-2] + shares[1] * variances[1:-1] + shares[2] * variances[2:]
    return squares[near], (expected / np.sum(shares, axis=0))[near]


def flowing(tests: Sequence[StepTest]) -> list[str]:
    """Name the temperatures where creep tests end in flow, in one sentence; the glass transition can look like it."""
    ends = [(one.temperature, one.response[-1], _last_power(one)) for one in tests]
    # In flow J is above that of all tests which end otherwise: below, it rises towards the rubber.
    rubbery = max((J for _, J, power in ends if power <= FLOW), default=0.0)
    found = {kelvin: power for kelvin, J, power in ends if power > FLOW and rubbery < J}
    if not found:
        return []
    warmest = max(found)
    where = ", ".join(shown(kelvin) for kelvin in found)
    said = (
        f"The sample flows, or is in its glass transition, at {where}: at the longest times J grows as "
        f"t^{shown_number(found[warmest], '.2f')} ({shown(warmest)})"
    )
    return [Note("flow", f"{said}. A liquid has no E0; contacts need a material with one.")]


def _last_power(test: StepTest) -> float:
    """Return d log J/d log t over the last half decade; 0 where too few points show it."""
    time = np.log10(test.time)
    last = time >= time[-1] - HALF_DECADE
    if np.count_nonzero(last) < LEAST_POINTS:
        return 0.0
    return float(np.polyfit(time[last], np.log10(test.response[last]), 1)[0])


@dataclass(frozen=True, eq=False)
class Superposition(Superposed[MasterCurve, Isotherm]):
    """The result of `superpose`.

    Parameters
    ----------
    shift_factors : ShiftFactors
        α at the temperatures that were joined, with standard errors.
    master_curve : MasterCurve
        Tensile, at the reference, free of vertical shift: E(ω, T)/b(T) against α(T) ω.
    quality : OverlapQuality
        How well neighbours overlap: rms of log10 E' and of log10 E''.
    notes : tuple of str
        What the reader noted, and what was converted, left out or not identified here: one sentence each.
    isotherms : tuple of Isotherm
        Those that were joined, tensile and as measured (no vertical shift taken off), in ascending temperature:
        one for each entry of `shift_factors.temperatures`.
    vertical_shift : VerticalShift or None
        b(T), where one was requested.
    cross_covariance : (n, n) array or None
        Of log10 α (rows) with log10 b (columns), where b was fitted.
    offsets : IsothermOffsets or None
        How far whole isotherms are off, found from their overlaps where shifts were fitted.
    unidentified : tuple of (float, float)
        Colder and warmer temperature (K) of the steps of α that the sweeps do not fix.
    shifted_by : {"both", "storage", "loss", "loss-tangent"}
        The quantities that α was found from.
    weights : (float, float) or None
        Of log E' and log E'', with mean 1, where they were given.
    """

    shifted_by: ShiftBy = "both"
    weights: tuple[float, float] | None = None

    def _shown(self) -> Rows:
        return (
            ("isotherms", len(self.isotherms)),
            *super()._shown(),
            ("E' and E''", "consistent" if self.check.consistent else "inconsistent (Kramers–Kronig)"),
            ("vertical shift", None if self.vertical_shift is None else type(self.vertical_shift).__name__),
            ("notes", self.notes),
        )

    @property
    def reduced_isotherms(self) -> tuple[Isotherm, ...]:
        """The isotherms as they lie on the master curve: moduli over b(T) at α(T) ω."""
        b = np.ones(len(self.isotherms))
        if self.vertical_shift is not None:
            b = 10.0 ** np.asarray(self.vertical_shift.log10(self.shift_factors.temperatures))
        return tuple(
            replace(
                one,
                angular_frequency=10.0**shift * one.angular_frequency,
                storage_modulus=one.storage_modulus / factor,
                loss_modulus=one.loss_modulus / factor,
            )
            for one, shift, factor in zip(self.isotherms, self.shift_factors.log10_values, b, strict=True)
        )

    def _attributes(self) -> dict[str, Any]:
        quality = self.quality
        return {
            "overlap_rms_log10_storage": quality.storage,
            "overlap_rms_log10_loss": quality.loss,
            **quality.attributes,
            "shifted_by": self.shifted_by,
            **({} if self.weights is None else {"shift_weights": list(self.weights)}),
        }

    @cached_property
    @one_blas_thread
    def check(self) -> SuperpositionCheck:
        """Whether superposition holds, evaluated at first use; see `check_superposition`."""
        return consistency.check(
            self.isotherms, self.shift_factors, self.vertical_shift, self.unidentified, self.quality, self.master_curve
        )


@overload
def check_superposition(fit: Superposition) -> SuperpositionCheck: ...
@overload
def check_superposition(fit: StepSuperposition) -> StepCheck: ...
def check_superposition(fit: Superposition | StepSuperposition) -> SuperpositionCheck | StepCheck:
    """Say whether time–temperature superposition holds, and whether E' and E'' belong to each other.

    Parameters
    ----------
    fit : Superposition or StepSuperposition
        As `superpose` returns it.

    Returns
    -------
    SuperpositionCheck, or StepCheck of step tests

    Raises
    ------
    InputError
        If `fit` is no superposition.

    Notes
    -----
    Isotherms that superpose lie on one curve of tan δ against |E*|, whatever their shifts (H. C. Booij, J. H. M.
    Palmen, Theoretical and Applied Rheology, 1992, 321; M. van Gurp, J. Palmen, Rheol. Bull. 67 (1998) 5).  Each is
    compared with its neighbour, at right angles to that curve, so that plateaus, where it runs steeply, count as
    well; the noise is the scatter of each isotherm about its own smooth curve.  Distances within reproducibility that
    add up over a run of isotherms are no errors of single isotherms: a vertical shift is missing, or superposition
    fails slowly (`Drift`).

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic
    >>> sweeps = vf.read_dma(path, deformation="tension")
    >>> fit = vf.superpose(sweeps, reference="30 degC")
    >>> vf.rheology.check_superposition(fit).holds
    True
    """
    insist_on(fit, "fit", Superposition, StepSuperposition, right="what superpose(…) returned")
    return fit.check
