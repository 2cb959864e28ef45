"""Whether the zero of the force cell that a user gives is the one that the configurations tell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.measurement.least_squares import regressors, told_apart
from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.friction.measurement.conditions import Condition
    from viscofric.friction.measurement.zeros import Zeros
    from viscofric.traction import TractionRuns

#: Conditions that tell a zero, fewer than which do not tell how well.
_FEWEST = 3
#: Standard errors that a given zero may lie away.
_AWAY = 3.0


def another_zero(runs: TractionRuns, groups: list[Condition], zeros: Zeros) -> list[str]:
    """Note a given zero that the sign configurations contradict.

    Parameters
    ----------
    runs : TractionRuns
    groups : list of Condition
    zeros : Zeros
    """
    if not zeros.given:
        return []
    told = np.array([_zero(runs, group) for group in groups if told_apart(group, offset=True, coulomb=True)])
    if told.size < _FEWEST:
        return []
    mean, error = float(told.mean()), float(told.std(ddof=1)) / np.sqrt(told.size)
    given = float(zeros.value[0])
    if abs(mean - given) <= _AWAY * np.hypot(error, zeros.error) + 1e-9 * abs(given):
        return []
    sentence = Note(
        "given-zero-contradicted",
        f"The zero of the force cell that was given, {given:.3g} N, is used, though the configurations at {told.size} "
        f"conditions tell another one, {mean:.3g} ± {error:.1g} N.",
    )
    return [sentence]


def _zero(runs: TractionRuns, group: Condition) -> float:
    """Return the zero that the readings of a condition tell, N."""
    design = regressors(group, offset=True, coulomb=True)
    design[:, 1:] *= runs.load[group.rows][:, None]
    return float(np.linalg.lstsq(design, runs.traction_force[group.rows])[0][0])
