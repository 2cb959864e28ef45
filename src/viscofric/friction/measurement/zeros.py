"""The zero of the force cell where it is known: given by the user, or recorded with the readings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Indices, Integers
from viscofric.errors import wrong_argument
from viscofric.friction.measurement.conditions import Condition
from viscofric.notes import Note
from viscofric.showing import with_error
from viscofric.traction import TractionRuns
from viscofric.units import Quantity, shown_number, to_si

ROUNDING = 1e-9  # relative; smaller deviations come from rounding
# Fewer recordings do not distinguish a drift from scatter.
_FEWEST_FOR_DRIFT = 8
# Standard deviations that the ratio of von Neumann is below its mean where values drift.
_DRIFTS = 3.0
#: Fewest conditions that determine a zero with its error.
_FEWEST = 3
#: Largest deviation of a given zero, in standard errors.
_AWAY = 3.0


@dataclass(frozen=True, eq=False)
class Zeros:
    """Zero of the force cell behind each reading, and its uncertainty."""

    value: Array  # (n,), N; NaN where it is not known
    recording: Integers  # (n,), number of the recording that each reading's zero comes from
    error: float  # standard error of one recording, N; zero where it is not known
    freedom: float  # degrees of freedom of the error
    given: bool  # given by the user, and so used at all conditions
    recordings: Array  # (k,), the recordings in the order of the test

    @classmethod
    def known(cls, runs: TractionRuns, zero: Quantity | tuple[Quantity, Quantity] | None) -> Zeros:
        """Return the given zero, or the recorded ones, or none."""
        if zero is not None:
            value, error = zero if isinstance(zero, tuple) and len(zero) == 2 else (zero, 0.0)
            newton, deviation = to_si(value, "N", "zero"), to_si(error, "N", "standard error of zero")
            if deviation < 0.0:
                raise wrong_argument("standard error of zero", error, "must be zero or above.", "negative")
            each, once = np.full(len(runs), newton), np.zeros(len(runs), dtype=np.int64)
            return cls(each, once, deviation, np.inf, True, np.array([newton]))
        if runs.zero_force is None:
            none = np.full(len(runs), np.nan)
            return cls(none, np.zeros(len(runs), dtype=np.int64), 0.0, np.inf, False, np.empty(0))
        return cls._recorded(runs, runs.zero_force)

    @classmethod
    def _recorded(cls, runs: TractionRuns, zero: Array) -> Zeros:
        """Collect the recordings in the order of the test; equal ones in succession are one."""
        # A single recording's error is √(½ mean (z_{k+1} − z_k)²), which includes its scatter and the drift until the
        # next recording, but no slow drift. For k recordings that only scatter it has 2(k−1)²/(3k−4) degrees of freedom
        # (J. von Neumann et al., Annals of Mathematical Statistics 12, 153–162, 1941).
        key = runs.step if runs.step is not None else runs.time
        order = np.arange(len(runs)) if key is None else np.argsort(key, kind="stable")
        order = order[np.isfinite(zero[order])]
        ordered = zero[order]
        starts = np.concatenate([[True], np.diff(ordered) != 0.0])[: order.size]
        recording = np.zeros(len(runs), dtype=np.int64)
        recording[order] = np.cumsum(starts) - 1
        recordings = ordered[starts]
        count = recordings.size
        if count < 2:
            return cls(zero, recording, 0.0, np.inf, False, recordings)
        error = float(np.sqrt(0.5 * np.mean(np.diff(recordings) ** 2)))
        return cls(zero, recording, error, 2.0 * (count - 1) ** 2 / (3 * count - 4), False, recordings)

    def of(self, group: Condition) -> Array:
        """Zero behind each reading of a condition, N, NaN where not known."""
        return self.value[group.rows]

    def mean(self, group: Condition) -> float:
        """Mean over a condition's readings, N."""
        return float(self.of(group).mean())

    def covers(self, group: Condition) -> bool:
        """Whether the zero is known behind every reading of a condition."""
        return bool(np.all(np.isfinite(self.of(group))))

    def variance(self, group: Condition, operator: Array, part: Indices | None) -> Array:
        """Return the variance of coefficients (4,) = `operator` @ readings due to the errors of the recordings."""
        # The scatter of parts of the readings (numbered by `part`), which gives the errors, includes this variance if
        # each part has its own recording, and nothing of it if they share one. The included part is subtracted.
        _, which = np.unique(self.recording[group.rows], return_inverse=True)
        recordings = int(which.max()) + 1
        left = np.array([np.sum(np.bincount(which, row) ** 2) for row in operator])
        if part is not None:
            parts = int(part.max()) + 1
            among = part * recordings + which
            squares = np.array([np.sum(np.bincount(among, row) ** 2) for row in operator])
            # The variance of the mean expected from the scatter of its terms, minus that of their common part.
            left = np.maximum(left - (parts * squares - left) / (parts - 1), 0.0)
        return self.error**2 * left

    def fitted(self, group: Condition, *, coulomb: bool) -> bool:
        """Whether a condition's zero is fitted: it is not given, and the signs determine it."""
        return not self.given and group.determines(offset=True, coulomb=coulomb)

    def suffices(self, group: Condition, *, coulomb: bool) -> bool:
        """Whether viscoelastic (and Coulomb) friction can be separated, with the zero as it is known."""
        return self.fitted(group, coulomb=coulomb) or (
            self.covers(group) and group.determines(offset=False, coulomb=coulomb)
        )

    def notes(self, groups: list[Condition], used: list[Condition]) -> Iterator[Note]:
        """Yield a note on viscoelastic friction that depends on a recorded zero."""
        if self.given or not used:
            return
        load = float(np.mean([group.load for group in used]))
        values: dict[str, float] = {"conditions": len(used), "of": len(groups), "recordings": self.recordings.size}
        said = ", of one recording, whose error is not in the standard errors of viscoelastic friction."
        if self.recordings.size > 1:
            values["error"] = self.error
            said = (
                f", whose {self.recordings.size} recordings scatter by {self.error:.2g} N ({self.error / load:.2g} of "
                "the load); this is in the standard errors of viscoelastic friction."
            )
        where = f"At {len(used)} of {len(groups)} conditions the zero of the force cell is the recorded one"
        yield Note("recorded-zero", where + said, values=values)

    def drift(self, load: float) -> Iterator[Note]:
        """Yield a note on recordings that drift."""
        if wanders(self.recordings):
            first, last = float(self.recordings[0]), float(self.recordings[-1])
            span = float(np.ptp(self.recordings))
            yield Note(
                "recorded-zero-drifts",
                f"The recorded zero of the force cell drifts, from {shown_number(first, '.3g')} N at first to "
                f"{shown_number(last, '.3g')} N at last, within {span:.2g} N ({span / load:.2g} of the load).",
                values={"first": first, "last": last, "span": span, "of_load": span / load},
            )


def wanders(values: Array) -> bool:
    """Whether successive values are closer than by chance, so that they drift."""
    # The mean square of their successive differences over their variance is about 2 for independent ones, with variance
    # 4(n−2)/(n²−1) (von Neumann, Annals of Mathematical Statistics 12, 367–395, 1941).
    count = values.size
    if count < _FEWEST_FOR_DRIFT or np.ptp(values) <= ROUNDING * np.abs(values).max():
        return False
    centred = values - values.mean()
    ratio = float(np.sum(np.diff(values) ** 2) / (count - 1) / np.mean(centred**2))
    return ratio < 2.0 - _DRIFTS * 2.0 * math.sqrt((count - 2.0) / (count**2 - 1.0))


def another_zero(runs: TractionRuns, groups: list[Condition], zeros: Zeros) -> Iterator[Note]:
    """Yield a note on a given zero that the sign configurations contradict."""
    if not zeros.given:
        return
    fitted = np.array([_zero(runs, group) for group in groups if group.determines(offset=True, coulomb=True)])
    if fitted.size < _FEWEST:
        return
    mean, error = float(fitted.mean()), float(fitted.std(ddof=1)) / np.sqrt(fitted.size)
    given = float(zeros.value[0])
    if abs(mean - given) > _AWAY * np.hypot(error, zeros.error) + ROUNDING * float(runs.load.max()):
        yield Note(
            "given-zero-contradicted",
            f"The given zero of the force cell, {shown_number(given, '.3g')} N, is used, though the configurations at "
            f"{fitted.size} conditions give another one, {with_error(mean, error)} N.",
            values={"given": given, "fitted": mean, "error": float(error), "conditions": fitted.size},
        )


def _zero(runs: TractionRuns, group: Condition) -> float:
    """Return the zero from the readings of a condition, N."""
    design = group.regressors(offset=True, coulomb=True)
    design[:, 1:] *= runs.load[group.rows][:, None]
    return float(np.linalg.lstsq(design, runs.traction_force[group.rows])[0][0])
