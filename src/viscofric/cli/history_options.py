"""Options of a history: load or depth, dwell and slide, or a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import quantity, together
from viscofric.cli.contact_options import chosen_direction, load_option, option
from viscofric.cli.files import Source
from viscofric.cli.keys import key
from viscofric.cli.rubber_options import column_options
from viscofric.cli.speed_options import list_of

if TYPE_CHECKING:
    from viscofric.motion.history import History

_MOST_POINTS = 100_000
#: Times of the curve beside an animation.
_OF_CURVE = 120
#: Options that a file of the history replaces.
_STAGES = ("load_time", "dwell", "slide", "strokes")
_CONTROLS = ("load", "indentation", "pressure")
history_options = together(
    click.option(
        "--history",
        type=Source(),
        metavar="FILE",
        help="History as a table (CSV or .xlsx): time, load or indentation, position or speed, temperature; units in "
        "the headings.",
    ),
    column_options("'load=Fz (N)'", "history-", "With --history: ", table="history."),
    load_option(),
    quantity("--indentation", "DEPTH", "Indentation (depth of the lowest point), instead of --load."),
    quantity("--pressure", "P", "Mean pressure on a rough surface, instead of --load."),
    quantity("--load-time", "TIME", "Time in which load, indentation or pressure rise from zero [default: at once]."),
    quantity("--dwell", "TIME", "Time at rest before the sliding, e.g. '0.1 s' [default: none]."),
    quantity("--slide", "LENGTH", "Length of the path, e.g. '20 mm' [default: no sliding]."),
    key("history.strokes", type=click.IntRange(1, 10_000)),
    quantity("--speed", "V", "Sliding speed, e.g. '100 mm/s'."),
    quantity("--temperature", "T", "Temperature, e.g. '60 degC' [default: the material's reference]."),
    key("history.before"),
    quantity("--times", "T,T,…", "Times to report, e.g. '1 ms, 10 ms' [default: all steps]."),
    click.option(
        "--points",
        type=click.IntRange(2, _MOST_POINTS),
        help="Number of times to report, instead of --times; dense after each change of load or speed.",
    ),
    heading="History",
)


def chosen_history(parameters: dict[str, Any], line: bool, reference: float | None) -> History:
    """Return the history of the options, for a line contact or another one, at the material's reference by default."""
    if parameters["history"] is not None:
        return _from_file(parameters, reference)
    for name in ("history_columns", "history_sheet"):
        if parameters[name]:
            raise click.UsageError(f"{option(name).removesuffix('s')} is for --history only.")
    return _from_stages(parameters, line, reference)


def chosen_times(parameters: dict[str, Any], history: History, *, film: bool) -> Any:
    """Return the times to report, s; None: all steps.  Of an animation by default also evenly spaced ones."""
    from viscofric.motion.history import dense_times

    if parameters["times"] is not None and parameters["points"] is not None:
        raise click.UsageError("--times and --points are both given; give one of them.")
    if parameters["points"] is not None:
        return dense_times(history, parameters["points"])
    if parameters["times"] is None:
        return _film(history) if film else None
    return list_of(parameters["times"])


def _film(history: History) -> list[float]:
    """Return times of a curve and of the frames beside it."""
    import numpy as np

    from viscofric.motion.history import dense_times
    from viscofric.report.figures.animation import FRAMES

    curve = dense_times(history, len(history.time) + _OF_CURVE)
    frames = np.linspace(curve[0], curve[-1], FRAMES + 1)
    return sorted([*curve, *np.setdiff1d(frames, curve).tolist()])


def _from_file(parameters: dict[str, Any], reference: float | None) -> History:
    from viscofric.motion.history_files import read_history

    for name in _STAGES:
        if parameters[name] is not None:
            raise click.UsageError(f"{option(name)} and --history are both given; the file has the whole history.")
    names = (*_CONTROLS, "speed", "temperature", "before")
    settings = {name: parameters[name] for name in names if parameters[name] is not None}
    settings |= {
        "direction": chosen_direction(parameters["direction"]),
        "columns": parameters["history_columns"],
        "sheet": parameters["history_sheet"],
    }
    history = read_history(parameters["history"], **settings)
    if history.temperature is not None or reference is None:
        return history
    return read_history(parameters["history"], **{**settings, "temperature": reference})


def _from_stages(parameters: dict[str, Any], line: bool, reference: float | None) -> History:
    """Return a load put on at once or in some time, a dwell, and a slide forth and back."""
    from viscofric.motion.history import CONTROLS, staged_history
    from viscofric.units import positive, to_si

    given = {name: parameters[name] for name in _CONTROLS if parameters[name] is not None}
    if len(given) != 1:
        raise click.UsageError("give one of --load, --indentation and --pressure, or --history.")
    ((control, text),) = given.items()
    value = to_si(text, "N/m" if control == "load" and line else CONTROLS[control], control)
    if (parameters["slide"] is None) != (parameters["speed"] is None):
        raise click.UsageError("--slide and --speed belong together: the length of the path, and how fast it is.")
    if parameters["strokes"] is not None and parameters["slide"] is None:
        raise click.UsageError("--strokes is for --slide only.")
    stages = {
        name: positive(parameters[name], stage_unit, name)
        for name, stage_unit in (("load_time", "s"), ("dwell", "s"), ("slide", "m"), ("speed", "m/s"))
        if parameters[name] is not None
    }
    if not stages:
        raise click.UsageError("the history has no duration; give --dwell, --load-time, or --slide with --speed.")
    return staged_history(
        control,
        value,
        **stages,
        strokes=parameters["strokes"] or 1,
        temperature=reference
        if parameters["temperature"] is None
        else positive(parameters["temperature"], "K", "temperature"),
        before=parameters["before"] or "untouched",
        direction=chosen_direction(parameters["direction"]),
    )
