"""Job ``isotherm_misfit``: how badly one isotherm overlaps its neighbours, were its shift factor another."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import Field

from viscofric.datasets import plain
from viscofric.rheology.superposition.overlap import LogSweep, join_at
from viscofric.rheology.superposition.result import Superposition
from viscofric.study.run_file.tables import Temperature
from viscofric.web.jobs.context import Context, JobError, JobOptions
from viscofric.web.jobs.rubbers import made_rubber

#: An isotherm is named to this, K.
_NAMED = 0.05


class Options(JobOptions):
    """Which isotherm, and how far it may be dragged."""

    temperature: Temperature
    reach: float = Field(3.0, gt=0.0, le=10.0)
    step: float = Field(0.02, ge=0.005, le=1.0)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Slide one isotherm over its neighbours, which stay where they are; return the misfit (decades) at each place."""
    fit = made_rubber(study, context).fit
    if fit is None:
        raise JobError("Only isotherms of sweeps can be shifted; this rubber is made of none.", code="no-isotherms")
    temperatures = fit.shift_factors.temperatures
    place = int(np.argmin(np.abs(temperatures - options.temperature)))
    if abs(temperatures[place] - options.temperature) > _NAMED:
        raise JobError(
            f"None of the joined isotherms is at {options.temperature - 273.15:.1f} °C.", code="no-such-temperature"
        )
    half = round(options.reach / options.step)
    moved = options.step * np.arange(-half, half + 1)
    found = {
        "temperature": float(temperatures[place]),
        "log10_shift": float(fit.shift_factors.log10_values[place]),
        "moved": moved,
        "misfit": [_misfit(fit, place, float(by)) for by in moved],
    }
    return dict(plain(found))


def _misfit(fit: Superposition, place: int, moved: float) -> float:
    """Return the joint rms misfit of an isotherm with both its neighbours; NaN where it overlaps neither."""
    vertical, shifts = fit.vertical_shift, fit.shift_factors.log10_values
    squares = []
    for colder in (place - 1, place):
        if not 0 <= colder < len(shifts) - 1:
            continue
        cold, warm = (
            LogSweep.of(one, 0.0 if vertical is None else float(vertical.log10(one.temperature)))
            for one in fit.isotherms[colder : colder + 2]
        )
        step = float(shifts[colder] - shifts[colder + 1]) + (moved if colder == place else -moved)
        found = join_at(cold, warm, step)
        if np.isfinite(found.uncertainty):
            squares.append(found.misfit**2)
    return float(np.sqrt(np.mean(squares))) if squares else float("nan")
