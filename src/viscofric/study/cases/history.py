"""One case of a study over time: what is solved, and the stored part of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from viscofric.motion.history import dense_times
from viscofric.motion.solve import solve_transient
from viscofric.rheology.material import Material
from viscofric.study.cases.record import Column, HistoryRecord

if TYPE_CHECKING:
    from viscofric.motion.history import History
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


def solve_history(
    modes: RetardationSpectrum,
    poisson_ratio: float,
    *,
    history: History,
    points: int,
    fields: bool = False,
    **contact: Any,
) -> HistoryRecord:
    """Solve the contact of an indenter over time.

    Parameters
    ----------
    modes : RetardationSpectrum
        Of the material at the contact's temperature.
    history : History
        Without a temperature.
    points : int
        Number of times, see `dense_times`.
    fields : bool
        Not used: there are none.
    **contact
        Further arguments of `solve_transient`, SI.
    """
    times = dense_times(history, points)
    run = solve_transient(Material(modes, poisson_ratio=poisson_ratio), history=history, times=times, **contact)
    if run.interrupted:  # a part of a history is no result
        raise KeyboardInterrupt
    data = run.to_dataset()
    columns = {
        str(name): Column(one.values.tolist(), str(one.attrs["units"]), str(one.attrs["long_name"]))
        for name, one in data.variables.items()
    }
    return HistoryRecord({}, tuple(map(str, run.warnings)), columns=columns)
