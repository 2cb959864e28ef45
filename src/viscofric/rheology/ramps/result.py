"""The result of a superposition of temperature ramps, and whether they fall on one curve."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from viscofric.data import MasterCurve
from viscofric.datasets import Dataset, dataset
from viscofric.ramps import TemperatureRamps
from viscofric.rheology.ramps.glass_transition import GlassTransition
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.rheology.superposition.consistency import REPRODUCIBILITY
from viscofric.rheology.superposition.kramers_kronig import KramersKronig
from viscofric.showing import Plotted, Rows, Shown


@dataclass(frozen=True)
class RampCheck(Shown):
    """Whether ramps at several frequencies fall on one curve.

    Parameters
    ----------
    between : float
        Scatter of log10 E' and log10 E'' about the curves that all ramps share, decades (rms).
    within : float
        Scatter of each ramp about its own curves, decades (rms).
    offsets : tuple of float
        Mean distance of each ramp from the common curves, decades, positive where its moduli are larger; the larger one
        of log10 E' and log10 E''.
    """

    between: float
    within: float
    offsets: tuple[float, ...]

    def _shown(self) -> Rows:
        return (
            ("holds", self.holds),
            ("scatter about common curves", self.between, "decades"),
            ("about own curves", self.within, "decades"),
            ("ramps", len(self.offsets)),
        )

    @property
    def holds(self) -> bool:
        """Whether the ramps miss each other by no more than moduli usually repeat to, 0.02 decades."""
        return self.between**2 - self.within**2 <= REPRODUCIBILITY**2

    @property
    def sentence(self) -> str:
        """The verdict in a plain sentence."""
        verdict = "fall on one curve" if self.holds else "do not fall on one curve"
        own = f", and by {self.within:.2g} about curves of their own" if self.within < self.between else ""
        return (
            f"The ramps of {len(self.offsets)} frequencies {verdict}: they scatter by {self.between:.2g} decades about "
            f"common curves of E' and E''{own} (good up to {REPRODUCIBILITY:g} on top of their own)."
        )

    def to_dataset(self) -> Dataset:
        """Return the distances along the dimension ``ramp``, with the verdict as attributes.

        ``offset``, ``between`` and ``within`` (decades); the attributes ``holds`` (1 or 0) and ``sentence``.
        """
        return dataset(
            "ramp",
            {
                "offset": (self.offsets, "1", "mean distance of log10 of the moduli from the common curves"),
                "between": (self.between, "1", "scatter of log10 of the moduli about the common curves"),
                "within": (self.within, "1", "scatter of log10 of the moduli about the curves of each ramp"),
            },
            attributes=self._verdict,
        )

    @property
    def _verdict(self) -> dict[str, Any]:
        return {"holds": int(self.holds), "sentence": self.sentence}


@dataclass(frozen=True, eq=False)
class RampSuperposition(Plotted):
    """The result of `superpose_ramps`.

    Parameters
    ----------
    shift : ShiftLaw
        α(T) about the reference: fitted, with the covariance of its constants, or assumed.
    shift_factors : ShiftFactors
        The same as a table over the temperatures of the ramps, with the covariance that follows.
    master_curve : MasterCurve
        Tensile, at the reference: E(ω, T)/b(T) against α(T) ω, with the temperature of every point.
    ramps : TemperatureRamps
        What was superposed, tensile and as measured.
    glass_transitions : tuple of GlassTransition
        Peaks of tan δ and of E'' of every ramp that has them.
    assumption : str
        Where α(T) was assumed: what it is, in words; empty where it was found from the ramps.
    check : RampCheck or None
        Whether the ramps fall on one curve; None for one frequency.
    causality : KramersKronig or None
        Agreement of E' with E'' on the master curve: the only test of an assumed law at one frequency.
    vertical_shift : VerticalShift or None
        b(T), where one was requested.
    notes : tuple of str
        What the reader noted, what was left out or assumed, and what is doubtful: one sentence each.
    """

    shift: ShiftLaw
    shift_factors: ShiftFactors
    master_curve: MasterCurve
    ramps: TemperatureRamps
    glass_transitions: tuple[GlassTransition, ...] = ()
    assumption: str = ""
    check: RampCheck | None = None
    causality: KramersKronig | None = None
    vertical_shift: VerticalShift | None = None
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("ramps", len(self.ramps.ramps)),
            ("temperature", self.ramps.temperature_range, "°C"),
            ("shift", self.assumption or str(self.shift)),
            ("shift is", "assumed" if self.assumption else "measured"),
            ("reference", self.shift_factors.reference, "°C"),
            ("notes", self.notes),
        )

    def to_dataset(self) -> Dataset:
        """Return the points along ``reading`` as `TemperatureRamps.to_dataset` does, with α(T).

        ``log10_shift_factor`` in addition; among the attributes the reference (K), the assumption, the verdict of the
        check, and the peaks (JSON).
        """
        found = self.ramps.to_dataset()
        peaks = [{"by": one.by, **vars(one)} for one in self.glass_transitions]
        values = dataset(
            "reading",
            {"log10_shift_factor": (self.shift.log10(found["temperature"].values), "1", "log10 of the shift factor")},
        )
        return found.assign(values.data_vars).assign_attrs(
            {
                "reference_temperature": self.master_curve.reference,
                "assumption": self.assumption,
                "law": str(self.shift),
                "glass_transitions": json.dumps(peaks),
                **({} if self.check is None else self.check._verdict),
            }
        )
