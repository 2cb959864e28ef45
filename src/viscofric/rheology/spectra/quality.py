"""Quality of a fitted spectrum: its misfit to the measurement, and which of its plateaus are extrapolated."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscofric.datasets import Dataset, dataset
from viscofric.notes import Note, dumped, records
from viscofric.rheology.spectra.response import shown_modulus
from viscofric.showing import Rows, Shown, short

_EXTRAPOLATED = "extrapolated: beyond what was measured"
_BEYOND_FRICTION = "extrapolated: beyond the range of the friction"
#: Methods of spectra that were inferred from friction, and from indentation.
FROM_FRICTION, FROM_INDENTATION = "friction", "indentation"
_BEYOND_INDENTATION = "extrapolated: beyond the range of the indentation"
_REACHED = "reached by the measurement"
#: Code of the note on contacts at frequencies at which the material was not measured.
BEYOND = "beyond-measured"
#: How codes of notes begin that concern all results from a spectrum.
DOUBTS = ("superposition-", "kramers-kronig-", "spectrum-misfit")
_LITTLE = 0.01  # part of the friction that may rest on the extrapolated modulus without a note
_ROUNDING = 1e-6  # frequencies beyond the measured ones by this part of them were measured
#: Neighbouring frequencies this many decades apart leave a gap: across wider ones E'' of a fit with 1 % noise is off by
#: 10 to 40 % where a single process lies within.
WIDE_GAP = 1.1
#: A spectrum fits what was measured if it is off by this at most.
LARGEST_MISFIT = 0.05  # decades, rms of E' and of E''


class KnownFrequencies:
    """Angular frequencies at which a material is known, rad/s: a range with gaps."""

    frequency_range: tuple[float, float]
    gaps: tuple[tuple[float, float], ...] = ()

    def covers(self, frequency: ArrayLike) -> Any:
        """Whether each angular frequency is known, rad/s; the elastic limits, 0 and infinity, need no frequency."""
        value = np.asarray(frequency, dtype=float)
        return covers(self.frequency_range, value, self.gaps) | (value == 0.0) | np.isinf(value)

    def beyond(self, frequency: ArrayLike, what: str = "frequency v/a") -> tuple[Note, ...]:
        """Return a note on contacts whose frequency, one or (n,), rad/s, is not known; `what` it is."""
        every = np.atleast_1d(np.asarray(frequency, dtype=float))
        beyond = every[~self.covers(every)]
        if not beyond.size:
            return ()
        first, last = float(beyond.min()), float(beyond.max())
        at = "T" if every.size == 1 else f"At {beyond.size} of {every.size} points t"
        subject = f"{at}he contact's {what}, {first:.3g}{'' if first == last else f' to {last:.3g}'} rad/s, lies"
        return (self.beyond_note(subject, points=beyond.size, of=every.size, lowest=first, highest=last),)

    def beyond_part(self, share: float) -> tuple[Note, ...]:
        """Return a note on the part of a rough contact's friction at frequencies that are not known."""
        if share <= _LITTLE:
            return ()
        return (
            self.beyond_note(f"For {share:.0%} of the friction the frequencies 2πv/λ of the pressure lie", share=share),
        )

    def beyond_note(self, subject: str, **values: float) -> Note:
        """Return the note on results at frequencies that are not known; `subject` begins its sentence."""
        low, high = self.frequency_range
        said = (
            f"{subject} {'outside' if self.gaps else 'beyond'} those at which the material was {self._known_by}, "
            f"{shown_range(self.frequency_range, self.gaps)}: the result there rests on the extrapolated "
            f"{'or interpolated ' if self.gaps else ''}modulus, and its limits on spectra that end or go on there; "
            "both may be far from the truth."
        )
        return Note(BEYOND, said, values={**values, "low": low, "high": high})

    @property
    def _known_by(self) -> str:
        return "measured"


@dataclass(frozen=True)
class FrequenciesOfModes(KnownFrequencies):
    """Those of the modes of a spectrum whose measurement is unknown."""

    frequency_range: tuple[float, float]

    def beyond_note(self, subject: str, **values: float) -> Note:
        """Return the note on results that are the tail of a single mode; `subject` begins its sentence."""
        low, high = self.frequency_range
        said = f"{subject} beyond those of the material's modes, {shown_range(self.frequency_range)}: the result there "
        said += "is the tail of a single mode, and may be far from the truth."
        return Note(BEYOND, said, values={**values, "low": low, "high": high})


@dataclass(frozen=True)
class SpectrumFit(KnownFrequencies, Shown):
    """Quality of the fit of a spectrum to a master curve.

    Parameters
    ----------
    rms_storage, rms_loss : float or None
        Root mean square of the difference of log10 E', and of log10 E''; decades.  None where no modulus was measured.
    E0_extrapolated : bool
        Whether the rubber plateau lies outside the measurement: E' at the lowest measured frequency exceeds
        E0 by more than 5 %, or the measured loss tangent there is above 0.1.
    E_inf_extrapolated : bool
        Likewise the glass: E_inf exceeds E' at the highest frequency by more than 5 %, or the loss tangent
        there is above 0.1.
    frequency_range : tuple of float
        Lowest and highest reduced angular frequency measured, or identified, rad/s; beyond them the
        spectrum extrapolates.  Creep from a time t on counts up to 0.1/t, relaxation up to 0.01/t: faster processes are
        part of E''(ω), but no longer of the step response.
    notes : tuple of str
        The same in sentences.
    method : str
        How it was fitted: "non-negative", "regularised" or "sparse", or "friction" or "indentation" where it was
        identified from one of these; empty where that is not known.
    modes : int
        Number of modes that have compliance.
    tau_ratio : float or None
        Ratio of neighbouring retardation times; None where they were free.
    regularisation : float or None
        Strength λ with which the spectrum was smoothed; None where it was not.
    measured_storage : tuple of float or None
        Smallest and largest E' measured, Pa; None where they are not known.
    E_inf_at_limit : bool
        Whether E_inf is the largest that the fit allows, 30 times the largest measured E': the measurement does not
        reach it, and it is no result.
    E0_missed, E_inf_missed : bool
        Whether E0 lies above the softest measured E', or E_inf below the stiffest, by more than 5 %: the fit does not
        follow these points.
    rms_step : float or None
        Root mean square of the difference of log10 of a creep compliance or relaxation modulus, decades, where the
        spectrum was fitted to one.
    gaps : tuple of (float, float)
        Parts of `frequency_range`, wider than 1.1 decades, in which nothing was measured, rad/s: between isotherms that
        do not overlap, joined by a given shift.  The spectrum interpolates there.  Step tests before one count as
        those at the upper end of `frequency_range`.
    """

    rms_storage: float | None
    rms_loss: float | None
    E0_extrapolated: bool
    E_inf_extrapolated: bool
    frequency_range: tuple[float, float]
    notes: tuple[str, ...] = ()
    method: str = ""
    modes: int = 0
    tau_ratio: float | None = None
    regularisation: float | None = None
    measured_storage: tuple[float, float] | None = None
    E_inf_at_limit: bool = False
    E0_missed: bool = False
    E_inf_missed: bool = False
    rms_step: float | None = None
    gaps: tuple[tuple[float, float], ...] = ()

    def _shown(self) -> Rows:
        return (
            ("method", self.method or None),
            ("modes", self.modes),
            ("misfit of the storage modulus", self.rms_storage, "decades"),
            ("of the loss modulus", self.rms_loss, "decades"),
            ("of step tests", self.rms_step, "decades"),
            ("measured", self.frequency_range, "rad/s"),
            *(("not measured", gap, "rad/s") for gap in self.gaps),
            ("E0 extrapolated", self.E0_extrapolated),
            ("E_inf extrapolated", self.E_inf_extrapolated),
            ("notes", self.notes),
        )

    def shifted(self, alpha: float, b: float) -> SpectrumFit:
        """Return the same for the spectrum at a temperature with factors α and b; notes describe the original fit."""
        low, high = self.frequency_range
        measured = self.measured_storage
        return replace(
            self,
            frequency_range=(low / alpha, high / alpha),
            gaps=tuple((first / alpha, last / alpha) for first, last in self.gaps),
            measured_storage=None if measured is None else (b * measured[0], b * measured[1]),
        )

    @property
    def doubts(self) -> tuple[Note, ...]:
        """The notes that what was measured contradicts itself, or that the spectrum does not follow it."""
        notes = [note for note in self.notes if isinstance(note, Note)]
        return tuple(note for note in notes if note.code.startswith(DOUBTS))

    @property
    def from_friction(self) -> bool:
        """Whether the spectrum was identified from friction, without a modulus measured."""
        return self.method == FROM_FRICTION

    @property
    def from_contact(self) -> bool:
        """Whether the spectrum was identified from friction or indentation, without a master curve."""
        return self.method in (FROM_FRICTION, FROM_INDENTATION)

    @property
    def _known_by(self) -> str:
        return "identified" if self.from_contact else "measured"

    @property
    def E0_remark(self) -> str:
        """Short remark on how well E0 is known."""
        if self.E0_missed:
            return f"the fit lies above the smallest measured modulus{self._measured(0)}"
        return self._beyond if self.E0_extrapolated else _REACHED

    @property
    def E_inf_remark(self) -> str:
        """Short remark on how well E_inf is known."""
        if self.E_inf_at_limit:
            return "not known: the measurement does not reach it, and the fit stopped at 30 times the largest modulus"
        if self.E_inf_missed:
            return f"the fit lies below the largest measured modulus{self._measured(1)}"
        return self._beyond if self.E_inf_extrapolated else _REACHED

    @property
    def modulus_misfit(self) -> dict[str, float]:
        """What data sets of the master curve say of the fit: rms misfits, decades, and whether they are small."""
        return _misfit(rms_log10_storage=self.rms_storage, rms_log10_loss=self.rms_loss)

    @property
    def step_misfit(self) -> dict[str, float]:
        """The same for data sets of a creep compliance or relaxation modulus."""
        return _misfit(rms_log10_step=self.rms_step)

    @property
    def attributes(self) -> dict[str, Any]:
        """What data sets of the spectrum say of the fit."""
        return {
            "E0_remark": self.E0_remark,
            "E_inf_remark": self.E_inf_remark,
            "E_inf_at_limit": int(self.E_inf_at_limit),
            "statements": dumped(records(self.notes)),
        }

    def to_dataset(self) -> Dataset:
        """Return the numbers of the fit.

        ``rms_log10_storage``, ``rms_log10_loss`` and ``rms_log10_step`` (decades), ``modes``, ``tau_ratio``,
        ``regularisation`` and ``measured_storage`` (Pa), where they are known; ``frequency_range`` and, along ``gap``
        and ``end``, ``gaps`` in it (rad/s); the attributes ``method``, ``E0_extrapolated``, ``E_inf_extrapolated``,
        ``E0_remark``, ``E_inf_remark``, ``E_inf_at_limit``, ``statements``, the notes (JSON).
        """
        known: dict[str, tuple[Any, str, str]] = {
            "rms_log10_storage": (self.rms_storage, "1", "rms misfit of log10 of the storage modulus"),
            "rms_log10_loss": (self.rms_loss, "1", "rms misfit of log10 of the loss modulus"),
            "rms_log10_step": (self.rms_step, "1", "rms misfit of log10 of the step response"),
            "modes": (self.modes, "1", "number of modes with compliance"),
            "tau_ratio": (self.tau_ratio, "1", "ratio of neighbouring retardation times"),
            "regularisation": (self.regularisation, "1", "strength of the smoothing"),
            "frequency_range": (self.frequency_range, "rad/s", "lowest and highest measured angular frequency"),
            "measured_storage": (self.measured_storage, "Pa", "smallest and largest measured storage modulus"),
        }
        extrapolated = {
            "E0_extrapolated": int(self.E0_extrapolated),
            "E_inf_extrapolated": int(self.E_inf_extrapolated),
        }
        found = dataset(
            "end",
            {name: entry for name, entry in known.items() if entry[0] is not None},
            attributes={"method": self.method, **extrapolated, **self.attributes},
        )
        if self.gaps:
            about = {"units": "rad/s", "long_name": "lowest and highest angular frequency of gaps in the measured ones"}
            found["gaps"] = (("gap", "end"), np.array(self.gaps), about)
        return found

    @property
    def _beyond(self) -> str:
        beyond = {FROM_FRICTION: _BEYOND_FRICTION, FROM_INDENTATION: _BEYOND_INDENTATION}
        return beyond.get(self.method, _EXTRAPOLATED)

    def _measured(self, end: int) -> str:
        return "" if self.measured_storage is None else f", {shown_modulus(self.measured_storage[end])}"


def covers(
    frequency_range: tuple[float, float], frequency: ArrayLike, gaps: tuple[tuple[float, float], ...] = ()
) -> Any:
    """Whether each angular frequency lies in a measured range, and in no gap of it, rad/s; one, or of any shape."""
    value = np.asarray(frequency, dtype=float)
    inside = (frequency_range[0] * (1.0 - _ROUNDING) <= value) & (value <= frequency_range[1] * (1.0 + _ROUNDING))
    for first, last in gaps:
        inside &= (value <= first * (1.0 + _ROUNDING)) | (last * (1.0 - _ROUNDING) <= value)
    return inside


def gaps_between(frequency: ArrayLike) -> tuple[tuple[float, float], ...]:
    """Return the gaps (`WIDE_GAP`) between neighbours of measured angular frequencies (n,), rad/s, in any order."""
    ascending = np.sort(np.asarray(frequency, dtype=float))
    wide = np.flatnonzero(np.diff(np.log10(ascending)) > WIDE_GAP)
    return tuple((float(ascending[row]), float(ascending[row + 1])) for row in wide)


def shown_range(frequency_range: tuple[float, float], gaps: tuple[tuple[float, float], ...] = ()) -> str:
    """Return a range of angular frequencies, rad/s, and its gaps in words."""
    low, high = frequency_range
    without = " or ".join(f"{short(first, 3)} to {short(last, 3)}" for first, last in gaps)
    return f"{short(low, 3)} to {short(high, 3)} rad/s{f', but not at {without} rad/s' if gaps else ''}"


def _misfit(**rms: float | None) -> dict[str, float]:
    known = {name: value for name, value in rms.items() if value is not None}
    if not known:
        return {}
    return {**known, "misfit_holds": int(max(known.values()) <= LARGEST_MISFIT), "misfit_limit": LARGEST_MISFIT}
