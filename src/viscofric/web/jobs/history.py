"""Job ``history``: the page's history as [history] of the study, and that of the study as the page's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscofric.datasets import plain
from viscofric.errors import DataFileError
from viscofric.files import write_atomically
from viscofric.motion.history import History
from viscofric.study.histories import case_histories, checked_table
from viscofric.study.run_file.study import Study
from viscofric.web.jobs.combinations import of_combination, page_sweep
from viscofric.web.jobs.context import Context, JobError
from viscofric.web.jobs.motion import MOST_ROWS, Rows
from viscofric.web.study_text import study_of

#: Name of the table of a history that is none of stages.
TABLE = "history_of_the_page.csv"
_DIGITS = 9
_UNITS = {"load": "N", "indentation": "m", "pressure": "Pa", "gap": "m"}


class Options(Rows):
    """The page's history; without rows, that of the study is wanted."""


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Return the page's history as [history]: stages, or a table; without rows, that of the study."""
    if not options.rows:
        return _of_study(study_of(study, context.files)[1])
    history = options.history()
    stages = _stages(history)
    if stages is not None:
        table = {**stages, "before": options.before}
        study_of({**study, "history": table}, context.files)
        return {"history": table}
    table = {"file": TABLE, "before": options.before}
    _, checked = study_of({**study, "history": table}, context.files)
    line = checked.indenter is not None and checked.indenter.LINE
    unit = "N/m" if line and options.control == "load" else _UNITS[options.control]
    text = f"time (s),{options.control} ({unit}),{options.path} ({'m/s' if options.path == 'speed' else 'm'})\n"
    text += "".join(f"{row.time!r},{row.value!r},{row.along!r}\n" for row in options.rows)
    write_atomically(context.files / TABLE, text.encode())
    assert checked.history is not None
    checked_table(checked.history, checked)
    return {"history": table}


def _of_study(study: Study) -> dict[str, Any]:
    """Return the history of the first case of a study as the page has it."""
    table = study.history
    if table is None:
        raise JobError("The study has no history.", "history", code="no-history")
    case = of_combination(page_sweep(study), 0)
    history = case_histories(study, table)(case, table.dwell[0])
    if len(history.time) > MOST_ROWS:
        words = f"The history has {len(history.time)} points; the page shows {MOST_ROWS} at most."
        raise DataFileError(str(table.file), words, code="too-many-points")
    path = "position" if history.speed is None and history.moves else "speed"
    moving = history.position if path == "position" else history.speed
    along = np.zeros(len(history.time)) if moving is None else moving @ np.asarray(history.direction)
    columns = [history.time, getattr(history, history.control), along]
    return {
        "rows": plain(np.stack(columns, axis=1).tolist(), _DIGITS),
        "control": history.control,
        "path": path,
        "before": history.before,
    }


def _stages(history: History) -> dict[str, Any] | None:
    """Return a history as stages: load put on, dwell, equal strokes forth and back; None if it is another."""
    load = history.load if history.pressure is None else history.pressure
    if load is None:
        return None
    time, position = history.time, history.position[:, 0]
    speed = history.speed[:, 0] if history.speed is not None else None
    parts = []  # duration, loads and speeds at both ends
    for one in np.flatnonzero(np.diff(time) > 0.0):
        duration = float(time[one + 1] - time[one])
        mean = float(position[one + 1] - position[one]) / duration
        ends = (mean, mean) if speed is None else (float(speed[one]), float(speed[one + 1]))
        parts.append((duration, (float(load[one]), float(load[one + 1])), ends))
    highest = float(load.max())
    found: dict[str, Any] = {}
    if parts[0][1] == (0.0, highest) and parts[0][2] == (0.0, 0.0):
        found["load_time"] = f"{parts.pop(0)[0]:.9g} s"
    if highest == 0.0 or any(loads != (highest, highest) for _, loads, _ in parts):
        return None
    dwell = 0.0
    while parts and parts[0][2] == (0.0, 0.0):
        dwell += parts.pop(0)[0]
    if dwell or not (found or parts):
        found["dwell"] = f"{dwell:.9g} s"
    if parts:
        duration, _, (first, _) = parts[0]
        strokes = [(duration, first if number % 2 == 0 else -first) for number in range(len(parts))]
        same = all(
            ends[0] == ends[1] and math.isclose(lasts, each, rel_tol=1e-6) and math.isclose(ends[0], v, rel_tol=1e-6)
            for (lasts, _, ends), (each, v) in zip(parts, strokes, strict=True)
        )
        if not same or first <= 0.0:
            return None
        found["slide"] = f"{duration * first:.9g} m"
        found |= {"strokes": len(parts)} if len(parts) > 1 else {}
    return found
