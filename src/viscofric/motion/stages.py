"""Histories of three stages: loading (or indenting), dwell, and sliding back and forth."""

from __future__ import annotations

from collections.abc import Sequence

from viscofric.errors import InputError
from viscofric.motion.history import History


def staged_history(
    control: str,
    value: float,
    *,
    load_time: float = 0.0,
    dwell: float = 0.0,
    slide: float = 0.0,
    speed: float = 0.0,
    strokes: int = 1,
    temperature: float | None = None,
    before: str = "untouched",
    direction: Sequence[float] = (1.0, 0.0),
) -> History:
    """Return the history of loading (or indenting), dwell and sliding; SI."""
    # The load or depth rises to `value` in `load_time`, in a step if that is zero. Each of the `strokes`, in
    # alternating directions, has the length `slide`, m; zero: no sliding.
    time, values, speeds = [0.0], [0.0 if load_time else value], [0.0]

    def stage(duration: float, at: float) -> None:
        """Append a stage; a change of speed is a jump, and the first stage sets the first speed."""
        if at != speeds[-1] and len(time) > 1:
            time.append(time[-1])
            values.append(value)
            speeds.append(at)
        speeds[-1] = at
        time.append(time[-1] + duration)
        values.append(value)
        speeds.append(at)

    for duration in (load_time, dwell):
        if duration:
            stage(duration, 0.0)
    if slide:
        for stroke in range(strokes):
            stage(slide / speed, speed if stroke % 2 == 0 else -speed)
    if len(time) == 1:
        raise InputError("the history has no duration; give it a dwell, or a path and a speed.", code="too-few-points")
    return History(time, **{control: values}, speed=speeds, temperature=temperature, before=before, direction=direction)
